//! A specification put together in code: the keys of a machine file as methods, checked by the same table.

mod follower;
mod forces;
mod limits;

pub use follower::{
    ArmSide, FlatFaceFollower, KnifeEdgeFollower, PlaceChoice, RollerFollower, SwingingFaceFollower,
    SwingingRollerFollower,
};

use super::{Error, Spec};
use crate::machine::{Keyway, Machine, MachineError, Material, SpringData, Title, valid_rpm};
use crate::write::number::{shortest, with_unit};
use camgen_kernel::document::FileFault;
use camgen_kernel::motion::Motion;
use std::sync::Arc;

/// What messages call a machine that was put together in code.
pub const SOURCE: &str = "the builder";

/// A machine put together in code, from [`Spec::builder`]. Each method sets keys of a machine file and no method checks its value:
/// [`Builder::machine`] and [`Builder::motion`] report everything that is missing or out of range, all at once, by the name of its key.
///
/// Numbers are in SI units: lengths in metres, angles in radians, forces in newtons. What is not set has the default of the machine file.
///
/// A lever with a roller, on a motion that is implemented here:
///
/// ```
/// # use camgen_cams as camgen;
/// use camgen::{Jet, Keyway, Material, Motion, Piece, Quantity, Spec, SpringData, SwingingRollerFollower};
/// use std::f64::consts::TAU;
///
/// /// A swing of 12° and back, once in a turn.
/// #[derive(Debug)]
/// struct Rocking;
///
/// impl Motion for Rocking {
///     fn pieces(&self) -> &[Piece] {
///         &[Piece { start: 0.0, end: TAU, dwell: false }]
///     }
///
///     fn jet(&self, _piece: usize, angle: f64) -> Jet {
///         let (sin, cos) = angle.sin_cos();
///         Jet { s: 1.0 - cos, ds: sin, dds: cos, ddds: -sin }.scaled(6.0_f64.to_radians())
///     }
///
///     fn quantity(&self) -> Quantity {
///         Quantity::Angle
///     }
/// }
///
/// let cam = Spec::builder("rocker")
///     .swinging_roller(SwingingRollerFollower {
///         radius: 0.016,
///         arm: 0.110,
///         pivot_distance: 0.140.into(),
///         inertia: Some(0.012),
///         ..Default::default()
///     })
///     .spring(SpringData { rate: 40.0, preload: 30.0, ..Default::default() })
///     .bore_radius(0.012)
///     .keyway(Keyway { width: 0.004, depth: 0.0018, angle: 0.0 })
///     .thickness(0.015)
///     .material(Material::Steel)
///     .rpm(60.0)
///     .motion(Rocking)?
///     .solve()?;
/// assert!(cam.draw(10e-6)?.prove()?.passed());
/// # Ok::<(), camgen::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Builder {
    name: String,
    /// Keys with their values, as after `--set`.
    keys: Vec<String>,
    /// Tables that may be repeated, as in a machine file.
    tables: String,
    /// Its units depend on the follower.
    spring: Option<SpringData>,
    rpm: Option<f64>,
}

impl Spec {
    /// A specification put together in code instead of in a file.
    ///
    /// ```
    /// # use camgen_cams as camgen;
    /// use camgen::{Program, Quantity, Spec, law};
    /// use std::f64::consts::PI;
    ///
    /// let (up, down) = (Some(law("cycloidal")?), Some(law("3-4-5")?));
    /// let motion = Program::new(Quantity::Length, 0.0, &[(up, PI, 0.010), (down, PI, 0.0)])?;
    /// let spec = Spec::builder("pusher").roller(0.010).bore_radius(0.008).motion(motion)?;
    /// assert_eq!(spec.machine().name(), "pusher");
    /// # Ok::<(), camgen::Error>(())
    /// ```
    #[must_use]
    pub fn builder(name: &str) -> Builder {
        Builder::new(name)
    }
}

impl Builder {
    pub(super) fn new(name: &str) -> Self {
        Self { name: name.to_owned(), keys: Vec::new(), tables: String::new(), spring: None, rpm: None }
    }

    /// Sets any key by its dotted path, with a value as in `--set`: `set("cam.material", "steel")`. For keys that have a method of their own
    /// prefer that.
    #[must_use]
    pub fn set(mut self, key: &str, value: &str) -> Self {
        self.keys.push(format!("{key}={value}"));
        self
    }

    /// Sets a key to a number with a unit; a key without a value keeps its default.
    #[must_use]
    pub fn quantity(self, key: &str, value: impl Into<Option<f64>>, unit: &str) -> Self {
        match value.into() {
            Some(value) => self.set(key, &with_unit(value, unit)),
            None => self,
        }
    }

    /// Sets a key to a length, m.
    #[must_use]
    pub fn length(self, key: &str, metres: impl Into<Option<f64>>) -> Self {
        self.quantity(key, metres, "m")
    }

    /// Sets a key to an angle, rad.
    #[must_use]
    pub fn angle(self, key: &str, radians: impl Into<Option<f64>>) -> Self {
        self.quantity(key, radians, "rad")
    }

    /// Sets a key to a bare number.
    #[must_use]
    pub fn number(self, key: &str, value: impl Into<Option<f64>>) -> Self {
        match value.into() {
            Some(value) => self.set(key, &shortest(value)),
            None => self,
        }
    }

    /// Adds one table of an array of tables, with its keys and their values as in [`Builder::set`]:
    /// `add_table("shaft.support", &[("at", "20 mm"), ("stiffness", "rigid")])`.
    #[must_use]
    pub fn add_table(mut self, table: &str, keys: &[(&str, &str)]) -> Self {
        self.tables.push_str(&format!("[[{table}]]\n"));
        let line = |(key, value): &(&str, &str)| format!("{key} = {}\n", in_toml(value));
        self.tables.extend(keys.iter().map(line));
        self
    }

    /// Base radius, m; without it the smallest is taken that keeps the limits, in whole millimetres.
    #[must_use]
    pub fn base_radius(self, radius: f64) -> Self {
        self.length("cam.base_radius", radius)
    }

    /// Thickness of the disc, m: for a solid, for its mass and for the contact stress.
    #[must_use]
    pub fn thickness(self, thickness: f64) -> Self {
        self.length("cam.thickness", thickness)
    }

    /// Radius of the bore, m.
    #[must_use]
    pub fn bore_radius(self, radius: f64) -> Self {
        self.length("cam.bore_radius", radius)
    }

    /// A keyway in the bore.
    #[must_use]
    pub fn keyway(self, keyway: Keyway) -> Self {
        let Keyway { width, depth, angle } = keyway;
        self.length("cam.keyway.width", width).length("cam.keyway.depth", depth).angle("cam.keyway.angle", angle)
    }

    /// Material of the cam, for its mass and the contact stress.
    #[must_use]
    pub fn material(self, material: Material) -> Self {
        self.set("cam.material", material.name())
    }

    /// Holes that balance the disc, between two radii, m.
    #[must_use]
    pub fn balancing_holes(self, inner: f64, outer: f64) -> Self {
        self.set("cam.balance", &format!("{} .. {}", with_unit(inner, "m"), with_unit(outer, "m")))
    }

    /// The cam turns counter-clockwise in the drawing.
    #[must_use]
    pub fn counter_clockwise(self) -> Self {
        self.set("cam.rotation", "ccw")
    }

    /// The texts of the title block of the review sheet.
    #[must_use]
    pub fn title(self, title: &Title) -> Self {
        let texts = [
            ("owner", &title.owner),
            ("part_number", &title.part_number),
            ("revision", &title.revision),
            ("date", &title.date),
            ("designer", &title.designer),
            ("approved", &title.approved),
            ("general_tolerance", &title.general_tolerance),
            ("surface_roughness", &title.surface_roughness),
        ];
        texts.into_iter().fold(self, |builder, (key, text)| match text {
            Some(text) => builder.set(&format!("title.{key}"), text),
            None => builder,
        })
    }

    /// Speed of the cam for [`Builder::motion`], rpm: forces, contact stress and vibration need it.
    #[must_use]
    pub fn rpm(self, rpm: f64) -> Self {
        Self { rpm: Some(rpm), ..self }
    }

    /// The machine, every value in range: for a [`Spec`] other than that of [`Builder::motion`], and for analyses.
    ///
    /// ```
    /// # use camgen_cams as camgen;
    /// use camgen::{Error, Spec};
    ///
    /// let wrong = Spec::builder("too thin").knife_edge(Default::default()).thickness(0.0).wall(-0.01);
    /// let Err(Error::Machine(error)) = wrong.machine() else { panic!("two values are out of range") };
    /// assert_eq!(error.faults.len(), 2);
    /// assert!(error.faults[0].message.contains("cam.thickness"), "{error}");
    /// ```
    ///
    /// # Errors
    /// [`Error::Machine`] with all faults.
    pub fn machine(self) -> Result<Machine, Error> {
        let (text, keys) = self.into_source();
        Ok(Machine::from_toml(SOURCE, &text, &keys)?)
    }

    /// The text of a machine file, and the keys that are set in addition: for machines of a domain that are read in another way.
    #[must_use]
    pub fn into_source(self) -> (String, Vec<String>) {
        let mut keys = self.keys;
        if let Some(spring) = self.spring {
            forces::push_spring(&mut keys, &spring);
        }
        (format!("name = {}\n{}", in_toml(&self.name), self.tables), keys)
    }

    /// A disc cam for a [`Program`](crate::Program) or a motion of your own, at the speed of [`Builder::rpm`] where that is given.
    ///
    /// # Errors
    /// [`Error::Machine`] with all faults.
    pub fn motion(self, motion: impl Motion + 'static) -> Result<Spec, Error> {
        let rpm = self.rpm.map(valid_rpm).transpose().map_err(|message| MachineError {
            faults: vec![FileFault { key: Some("rpm".into()), message, help: None, place: None }],
        })?;
        Ok(Spec::of_motion(self.machine()?, Arc::new(motion), rpm))
    }
}

/// A text as TOML writes it. A TOML text may hold the same characters as one of JSON, which escapes them in the same way.
fn in_toml(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}
