//! What a machine file describes, in SI units.

use super::press::{NoPress, NoRoller, Press};
use crate::follower::Follower;
use crate::motion::Transition;
use crate::motion::equation_18::EfficiencyModel;
use std::sync::Arc;

/// How the cam turns, seen in the drawing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rotation {
    /// Clockwise: the cam angle grows counter-clockwise in the drawing.
    Clockwise,
    /// Counter-clockwise: the drawing is mirrored about X.
    CounterClockwise,
}

/// Material of a cam, for its mass.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Material {
    /// Carbon and low-alloy steel.
    Steel,
    /// Grey cast iron.
    CastIron,
    /// Tin bronze.
    Bronze,
    /// Wrought aluminium alloy.
    Aluminium,
}

impl Material {
    /// E/(1 − ν²), Pa, customary values.
    #[must_use]
    pub fn contact_modulus(self) -> f64 {
        let (modulus, poisson): (f64, f64) = match self {
            Material::Steel => (210e9, 0.30),
            Material::CastIron => (110e9, 0.26),
            Material::Bronze => (110e9, 0.34),
            Material::Aluminium => (70e9, 0.33),
        };
        modulus / (1.0 - poisson * poisson)
    }

    /// Density, kg/m³, customary values.
    #[must_use]
    pub fn density(self) -> f64 {
        match self {
            Material::Steel => 7850.0,
            Material::CastIron => 7200.0,
            Material::Bronze => 8800.0,
            Material::Aluminium => 2700.0,
        }
    }
}

/// The disc of a rotary cam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CamData {
    /// Turns of the cam for one turn of the crank.
    pub turns_per_crank_turn: f64,
    /// Roller travel per bottom travel.
    pub lever: f64,
    /// Base radius, m; `None` is `auto`.
    pub base_radius: Option<f64>,
    /// Thickness, m.
    pub thickness: Option<f64>,
    /// Radius of the bore, m.
    pub bore_radius: Option<f64>,
    /// Keyway in the bore.
    pub keyway: Option<Keyway>,
    /// Material; steel where only the mass asks.
    pub material: Option<Material>,
    /// Band of radii in which holes may balance the disc, m.
    pub balance: Option<(f64, f64)>,
    /// How it turns.
    pub rotation: Rotation,
}

/// A keyway in the bore.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Keyway {
    /// Width, m.
    pub width: f64,
    /// Depth beyond the bore, m.
    pub depth: f64,
    /// Cam angle of its middle, rad.
    pub angle: f64,
}

impl CamData {
    /// How far bore and keyway reach from the shaft, m; `None` without a bore.
    #[must_use]
    pub fn bore_reach(&self) -> Option<f64> {
        let bore = self.bore_radius?;
        Some(self.keyway.map_or(bore, |keyway| {
            let (out, half) = (bore + keyway.depth, 0.5 * keyway.width);
            (out * out + half * half).sqrt()
        }))
    }

    /// Density of the disc, kg/m³.
    #[must_use]
    pub fn density(&self) -> f64 {
        self.material.unwrap_or(Material::Steel).density()
    }
}

/// Shape of a roller's rim along its axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Crown {
    /// A sphere of the roller's radius.
    Sphere,
    /// Straight.
    Cylinder,
}

/// The follower.
#[derive(Debug, Clone)]
pub struct FollowerData {
    /// The follower itself, not yet made for a size.
    pub shape: Arc<dyn Follower>,
    /// Mass that moves with it along its path, kg.
    pub mass: Option<f64>,
    /// Force that presses it onto the cam beside the load, N.
    pub preload: Option<f64>,
    /// What only a translating roller has.
    pub roller: Option<RollerData>,
}

/// The translating roller.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollerData {
    /// Radius, m.
    pub radius: f64,
    /// Offset of its path from the shaft, m.
    pub offset: f64,
    /// Shape of its rim on a conoid.
    pub crown: Crown,
    /// Width of a cylindrical rim, m.
    pub width: Option<f64>,
}

/// The cam plate on the bed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TranslatingData {
    /// Arm of the roller l1, m.
    pub roller_arm: f64,
    /// Arm of the bottom l2, m.
    pub bottom_arm: f64,
    /// Angle Δ between the roller's velocity and the line of the bed at ψ = 0, rad.
    pub delta: f64,
    /// Friction angle ρ, rad.
    pub friction_angle: f64,
    /// Efficiency η.
    pub efficiency: f64,
    /// Model of the efficiency.
    pub efficiency_model: EfficiencyModel,
    /// Radius of the roller, m.
    pub roller_radius: f64,
    /// Height of the plate over both flanks where it is highest, m; by itself when not given.
    pub plate_height: Option<f64>,
}

/// What the column does at each speed of a conoid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ConoidMode {
    /// Reset by (14).
    Adjusted,
    /// Stays.
    Fixed,
}

/// How the conoid shifts with the speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shift {
    /// z linear in n.
    Linear,
    /// z linear in n².
    Square,
}

/// The cam for many speeds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConoidData {
    /// Axial travel between the extreme speeds, m.
    pub axial_travel: f64,
    /// What the column does.
    pub mode: ConoidMode,
    /// How the cam shifts.
    pub shift: Shift,
    /// What the cam is longer at either end, m.
    pub overhang: f64,
}

/// What a cam must keep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Largest |pressure angle|, rad.
    pub pressure_angle: f64,
    /// Smallest convex radius of the pitch curve over the roller radius.
    pub min_convex_pitch_radius_over_roller: f64,
    /// Radius of the tool that must get into the concave parts, m.
    pub cutter_radius: Option<f64>,
    /// Least metal between bore and profile, m.
    pub wall: f64,
    /// Largest pressure in the contact of roller and cam, Pa.
    pub contact_stress: Option<f64>,
}

/// A machine in SI units, every value in range.
#[derive(Debug, Clone)]
pub struct Machine {
    /// What the sheet and the report call it.
    pub(crate) name: String,
    /// The press, when described.
    pub(crate) press: Option<Press>,
    /// Follower.
    pub(crate) follower: FollowerData,
    /// Disc.
    pub(crate) cam: CamData,
    /// Transition.
    pub(crate) transition: Transition,
    /// Plate on the bed, when described.
    pub(crate) translating: Option<TranslatingData>,
    /// Conoid, when described.
    pub(crate) conoid: Option<ConoidData>,
    /// Limits.
    pub(crate) limits: Limits,
}

impl Machine {
    /// What reports call it.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The press.
    ///
    /// # Errors
    /// [`NoPress`] when the machine file describes none.
    pub fn press(&self) -> Result<&Press, NoPress> {
        self.press.as_ref().ok_or(NoPress)
    }

    /// Asks that a cutter of a radius (m) gets into the hollows too.
    pub fn ask_for_cutter(&mut self, radius: f64) {
        let limit = &mut self.limits.cutter_radius;
        *limit = Some(limit.map_or(radius, |other| other.max(radius)));
    }

    /// The translating roller.
    ///
    /// # Errors
    /// [`NoRoller`] when the follower is another one.
    pub fn roller(&self) -> Result<&RollerData, NoRoller> {
        self.follower.roller.as_ref().ok_or(NoRoller)
    }

    /// Keys that were given and have no effect on a kind of cam, a sentence each.
    #[must_use]
    pub(crate) fn without_effect(&self, _kind: &crate::body::Kind) -> Vec<String> {
        Vec::new()
    }
}
