//! One entity as its groups, and the values of its numbers.

use super::groups::{DxfGroup, GroupValue, TYPE};
use super::shown::shown;
use camgen_kernel::refusal::Refusal;
use nalgebra::{Vector2, Vector3};

/// Group codes that every entity has.
const LAYER: i32 = 8;
const INVISIBLE: i32 = 60;
const PAPER_SPACE: i32 = 67;
/// First code of the extrusion direction.
const EXTRUSION: i32 = 210;

/// Marks to which class of an entity the groups behind it belong.
const CLASS: i32 = 100;
/// The class of what every entity has.
const EVERY: &[u8] = b"AcDbEntity";

/// Whether a group belongs to the shape of an entity: points, numbers, angles, flags, counts.
fn is_of_shape(code: i32) -> bool {
    matches!(code, 10..=13 | 20..=23 | 30..=33 | 38..=45 | 50 | 51 | 70 | 71 | 90)
}

/// Largest tilt of an entity's plane: rounding of a unit vector.
const TILT: f64 = 1e-9;

/// An entity.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct EntityRecord<'g> {
    /// Its kind as in the file.
    kind: &'g [u8],
    /// Its groups after the kind.
    pub(super) groups: &'g [DxfGroup<'g>],
}

/// Why an entity is not read.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum EntityFault {
    /// The file cannot be read.
    File(Refusal),
    /// The entity cannot be cut, in words that follow its name: "has no radius".
    Entity(String),
}

impl From<Refusal> for EntityFault {
    fn from(error: Refusal) -> Self {
        EntityFault::File(error)
    }
}

/// A fault of an entity, in words that follow its name.
pub(super) fn fault<T>(words: impl Into<String>) -> Result<T, EntityFault> {
    Err(EntityFault::Entity(words.into()))
}

impl<'g> EntityRecord<'g> {
    /// From its groups, of which the first is the kind; `None` without a kind.
    pub(super) fn of(groups: &'g [DxfGroup<'g>]) -> Option<Self> {
        let (first, groups) = groups.split_first().filter(|(first, _)| first.code == TYPE)?;
        Some(Self { kind: first.value.text(), groups })
    }

    /// Whether it is of a kind; other readers accept small letters, too.
    pub(super) fn is(&self, kind: &str) -> bool {
        self.kind.eq_ignore_ascii_case(kind.as_bytes())
    }

    pub(super) fn is_one_of(&self, kinds: &[&str]) -> bool {
        kinds.iter().any(|kind| self.is(kind))
    }

    /// A class in it that is none of these, or a part of its shape before its own class: other readers leave out what belongs to it.
    pub(super) fn outside_its_class(&self, classes: &[&str]) -> Option<String> {
        let is_own = |name: &[u8]| classes.iter().any(|class| name.eq_ignore_ascii_case(class.as_bytes()));
        let marked = self.groups.iter().any(|group| group.code == CLASS && is_own(group.value.text()));
        let mut within = false;
        for DxfGroup { code, value } in self.groups {
            if *code == CLASS {
                within = is_own(value.text());
                if !within && !value.text().eq_ignore_ascii_case(EVERY) {
                    return Some(shown(value.text()));
                }
            } else if marked && !within && is_of_shape(*code) {
                return Some(shown(EVERY));
            }
        }
        None
    }

    /// Its kind in capitals.
    pub(super) fn kind(&self) -> String {
        shown(&self.kind.to_ascii_uppercase())
    }

    /// The name of its layer.
    pub(super) fn layer(&self) -> &'g [u8] {
        self.first(LAYER).map_or(b"0", GroupValue::text)
    }

    /// Whether it is visible, apart from its layer.
    pub(super) fn visible(&self) -> Result<bool, Refusal> {
        Ok(self.first(INVISIBLE).map_or(Ok(0), GroupValue::whole)? != 1)
    }

    pub(super) fn in_paper_space(&self) -> Result<bool, Refusal> {
        Ok(self.first(PAPER_SPACE).map_or(Ok(0), GroupValue::whole)? == 1)
    }

    fn first(&self, code: i32) -> Option<GroupValue<'g>> {
        self.groups.iter().find(|group| group.code == code).map(|group| group.value)
    }

    /// The values of a code, in their order.
    pub(super) fn all(&self, code: i32) -> impl Iterator<Item = GroupValue<'g>> + '_ {
        self.groups.iter().filter(move |group| group.code == code).map(|group| group.value)
    }

    /// The value of a code that occurs at most once.
    pub(super) fn one(&self, code: i32) -> Result<Option<GroupValue<'g>>, EntityFault> {
        let mut all = self.all(code);
        match (all.next(), all.next()) {
            // Some readers take the first, some the last.
            (Some(_), Some(_)) => fault(format!("has group {code} twice")),
            (one, _) => Ok(one),
        }
    }

    /// The number of a code, or a default where the code is missing.
    pub(super) fn real(&self, code: i32, default: f64) -> Result<f64, EntityFault> {
        Ok(self.one(code)?.map_or(Ok(default), GroupValue::real)?)
    }

    /// The number of a code that is required.
    pub(super) fn required_real(&self, code: i32) -> Result<f64, EntityFault> {
        match self.one(code)? {
            Some(value) => Ok(value.real()?),
            None => fault(format!("has no group {code}")),
        }
    }

    pub(super) fn whole(&self, code: i32, default: i64) -> Result<i64, EntityFault> {
        Ok(self.one(code)?.map_or(Ok(default), GroupValue::whole)?)
    }

    /// Numbers of a code that may occur many times.
    pub(super) fn reals(&self, code: i32) -> Result<Vec<f64>, Refusal> {
        self.all(code).map(GroupValue::real).collect()
    }

    /// The point that starts with a code, its height 0 where that is missing.
    pub(super) fn point(&self, code: i32) -> Result<Vector3<f64>, EntityFault> {
        Ok(Vector3::new(self.required_real(code)?, self.required_real(code + 10)?, self.real(code + 20, 0.0)?))
    }

    /// The points that start with a code.
    pub(super) fn points(&self, code: i32) -> Result<Vec<Vector3<f64>>, EntityFault> {
        let mut points: Vec<[Option<f64>; 3]> = Vec::new();
        for group in self.groups {
            let axis = match group.code - code {
                0 => 0,
                10 => 1,
                20 => 2,
                _ => continue,
            };
            if axis == 0 {
                points.push([None; 3]);
            }
            let Some(place) = points.last_mut().and_then(|point| point.get_mut(axis)) else { continue };
            if place.replace(group.value.real()?).is_some() {
                return fault(format!("has group {} twice for a point", group.code));
            }
        }
        let point = |[x, y, z]: [Option<f64>; 3]| match (x, y) {
            (Some(x), Some(y)) => Ok(Vector3::new(x, y, z.unwrap_or(0.0))),
            _ => fault("has a point with x but without y"),
        };
        points.into_iter().map(point).collect()
    }

    /// Its approximate place, as far as that is known without knowing its kind.
    pub(super) fn approximate_place(&self) -> Vector2<f64> {
        let number = |code| self.first(code).and_then(|value| value.real().ok()).unwrap_or(0.0);
        Vector2::new(number(10), number(20))
    }

    /// Whether it is seen from behind (extrusion along −Z, as mirroring leaves it).
    pub(super) fn is_seen_from_behind(&self) -> Result<bool, EntityFault> {
        let (x, y) = (self.real(EXTRUSION, 0.0)?, self.real(EXTRUSION + 10, 0.0)?);
        let z = self.real(EXTRUSION + 20, if x == 0.0 && y == 0.0 { 1.0 } else { 0.0 })?;
        if x == 0.0 && y == 0.0 && z == 0.0 {
            return fault("has an extrusion without a direction, (0, 0, 0)");
        }
        if x.abs() + y.abs() > TILT * z.abs() {
            return fault("does not lie in the plane of the drawing");
        }
        Ok(z < 0.0)
    }
}
