//! One entity as its groups, and what its numbers are.

use super::ReadError;
use super::contents::shown;
use super::groups::{Group, TYPE, Value};
use nalgebra::{Vector2, Vector3};

/// Group codes that every entity has.
const LAYER: i32 = 8;
const INVISIBLE: i32 = 60;
const PAPER_SPACE: i32 = 67;
/// First code of the direction that is "up" to the entity.
const EXTRUSION: i32 = 210;

/// Largest tilt of an entity's plane: rounding of a unit vector.
const TILT: f64 = 1e-9;

/// An entity.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Record<'g> {
    /// Its kind as the file has it.
    kind: &'g [u8],
    /// Its groups after the kind.
    pub(super) groups: &'g [Group<'g>],
}

/// Why an entity is not read.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Fault {
    /// The file is none.
    File(ReadError),
    /// The entity is not what could be cut, in words that follow its name: "has no radius".
    Entity(String),
}

impl From<ReadError> for Fault {
    fn from(error: ReadError) -> Self {
        Fault::File(error)
    }
}

/// A fault of an entity, in words that follow its name.
pub(super) fn fault<T>(words: impl Into<String>) -> Result<T, Fault> {
    Err(Fault::Entity(words.into()))
}

impl<'g> Record<'g> {
    /// From its groups, the kind the first of them; none where no kind is told.
    pub(super) fn of(groups: &'g [Group<'g>]) -> Option<Self> {
        let (first, groups) = groups.split_first().filter(|(first, _)| first.code == TYPE)?;
        Some(Self { kind: first.value.text(), groups })
    }

    /// Whether it is of a kind; other readers take small letters for the same.
    pub(super) fn is(&self, kind: &str) -> bool {
        self.kind.eq_ignore_ascii_case(kind.as_bytes())
    }

    pub(super) fn is_one_of(&self, kinds: &[&str]) -> bool {
        kinds.iter().any(|kind| self.is(kind))
    }

    /// Its kind in capitals.
    pub(super) fn kind(&self) -> String {
        shown(&self.kind.to_ascii_uppercase())
    }

    /// The name of its layer.
    pub(super) fn layer(&self) -> &'g [u8] {
        self.first(LAYER).map_or(b"0", Value::text)
    }

    /// Whether it is seen, its layer aside.
    pub(super) fn visible(&self) -> Result<bool, ReadError> {
        Ok(self.first(INVISIBLE).map_or(Ok(0), Value::whole)? != 1)
    }

    pub(super) fn in_paper_space(&self) -> Result<bool, ReadError> {
        Ok(self.first(PAPER_SPACE).map_or(Ok(0), Value::whole)? == 1)
    }

    fn first(&self, code: i32) -> Option<Value<'g>> {
        self.groups.iter().find(|group| group.code == code).map(|group| group.value)
    }

    /// The values of a code, in their order.
    pub(super) fn all(&self, code: i32) -> impl Iterator<Item = Value<'g>> + '_ {
        self.groups.iter().filter(move |group| group.code == code).map(|group| group.value)
    }

    /// The value of a code that stands once or not at all.
    pub(super) fn one(&self, code: i32) -> Result<Option<Value<'g>>, Fault> {
        let mut all = self.all(code);
        match (all.next(), all.next()) {
            // Some readers take the first, some the last.
            (Some(_), Some(_)) => fault(format!("tells group {code} twice")),
            (one, _) => Ok(one),
        }
    }

    /// The number of a code, or else what it is when it is not told.
    pub(super) fn real(&self, code: i32, untold: f64) -> Result<f64, Fault> {
        Ok(self.one(code)?.map_or(Ok(untold), Value::real)?)
    }

    /// The number of a code that must be told.
    pub(super) fn needed(&self, code: i32) -> Result<f64, Fault> {
        match self.one(code)? {
            Some(value) => Ok(value.real()?),
            None => fault(format!("does not tell its group {code}")),
        }
    }

    pub(super) fn whole(&self, code: i32, untold: i64) -> Result<i64, Fault> {
        Ok(self.one(code)?.map_or(Ok(untold), Value::whole)?)
    }

    /// Numbers of a code that may stand many times.
    pub(super) fn reals(&self, code: i32) -> Result<Vec<f64>, ReadError> {
        self.all(code).map(Value::real).collect()
    }

    /// The point that starts with a code, its height 0 when it is not told.
    pub(super) fn point(&self, code: i32) -> Result<Vector3<f64>, Fault> {
        Ok(Vector3::new(self.needed(code)?, self.needed(code + 10)?, self.real(code + 20, 0.0)?))
    }

    /// The points that start with a code.
    pub(super) fn points(&self, code: i32) -> Result<Vec<Vector3<f64>>, Fault> {
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
                return fault(format!("tells group {} twice for a point", group.code));
            }
        }
        let point = |[x, y, z]: [Option<f64>; 3]| match (x, y) {
            (Some(x), Some(y)) => Ok(Vector3::new(x, y, z.unwrap_or(0.0))),
            _ => fault("has a point of which only x is told"),
        };
        points.into_iter().map(point).collect()
    }

    /// Where it lies, as far as can be told without knowing its kind.
    pub(super) fn somewhere(&self) -> Vector2<f64> {
        let number = |code| self.first(code).and_then(|value| value.real().ok()).unwrap_or(0.0);
        Vector2::new(number(10), number(20))
    }

    /// Whether it is seen from behind (extrusion along −Z, as mirroring leaves it).
    pub(super) fn is_seen_from_behind(&self) -> Result<bool, Fault> {
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
