//! Sizes with their tolerance classes and limits, as a drawing states them, and the keyway with its frame.

use super::proposals::{BORE_FIT, KEYWAY_FIT, PROPOSED, SYMMETRY};
use crate::body::part_features::direction;
use crate::machine::fit::HoleFit;
use crate::machine::{Keyway, Machine, parallel_key};
use crate::report::sheet::{Dimensions, FeatureFrame, Mark, ToleranceSign, rounded};
use camgen_kernel::geometry::MILLIMETRES;
use nalgebra::Vector2;

/// Deviation of the depth of a keyway that is not one of DIN 6885-1, mm.
const DEEPER: f64 = 0.1;

/// A view along the axis on the sheet: its centre, and the directions of x and y of the part.
#[derive(Debug, Clone, Copy)]
pub(in crate::body) struct ViewPlacement {
    pub(in crate::body) centre: Vector2<f64>,
    pub(in crate::body) x: Vector2<f64>,
    pub(in crate::body) y: Vector2<f64>,
}

impl ViewPlacement {
    /// The view of the DXF file.
    pub(in crate::body) const FRONT: Self =
        Self { centre: Vector2::new(0.0, 0.0), x: Vector2::new(1.0, 0.0), y: Vector2::new(0.0, 1.0) };

    /// A direction of the part on the sheet.
    pub(in crate::body) fn turned(&self, direction: Vector2<f64>) -> Vector2<f64> {
        self.x * direction.x + self.y * direction.y
    }

    /// A point of the part on the sheet, mm.
    pub(in crate::body) fn at(&self, point: Vector2<f64>) -> Vector2<f64> {
        self.centre + self.turned(point)
    }
}

/// A size, mm, with its tolerance class and limits; a class that nobody has given is marked.
pub(in crate::body) fn fitted(machine: &Machine, size: f64, given: Option<HoleFit>, proposed: &str) -> String {
    let units = machine.units();
    let (fit, mark) = match given {
        Some(fit) => (Some(fit), ""),
        None => (proposed.parse::<HoleFit>().ok(), PROPOSED),
    };
    match fit.and_then(|fit| Some((fit, fit.deviations(size / MILLIMETRES)?))) {
        Some((fit, limits)) => {
            let limits = units.limits(limits.map(|limit| MILLIMETRES * limit));
            format!("{} {fit} {limits}{mark}", units.toleranced(size))
        }
        None => format!("{} {proposed}{mark}", units.dimension(size)),
    }
}

/// The bore with its tolerance class and limits.
pub(in crate::body) fn bore_words(machine: &Machine, bore: f64) -> String {
    format!("Ø{}", fitted(machine, 2.0 * MILLIMETRES * bore, machine.cam.bore_fit, BORE_FIT))
}

/// The width of the keyway with the frame of its symmetry and the datum that its middle plane is.
pub(in crate::body) fn keyway_frame(machine: &Machine, view: &ViewPlacement) -> Option<Mark> {
    let (bore, keyway) = (machine.cam.bore_radius?, machine.cam.keyway?);
    let along = direction(machine, keyway.angle);
    let side = Vector2::new(-along.y, along.x);
    let (out, half) = (MILLIMETRES * (bore + 0.5 * keyway.depth), 0.5 * MILLIMETRES * keyway.width);
    let size = fitted(machine, MILLIMETRES * keyway.width, machine.cam.keyway_fit, KEYWAY_FIT);
    let degrees = libm::atan2(along.y, along.x).to_degrees().rem_euclid(360.0);
    let above = if is_at_zero(machine, &keyway) { size } else { format!("{size} at ψ {}°", rounded(degrees)) };
    let places =
        [-1.0, 1.0].map(|way| (view.at(along * out + side * (way * half)), view.turned(along * 0.4 + side * way)));
    Some(Mark::Tolerance(FeatureFrame {
        places: places.to_vec(),
        above,
        sign: Some(ToleranceSign::Symmetry),
        cells: vec![machine.units().zone(SYMMETRY), "A".into()],
        behind: String::new(),
        datum: Some("B"),
    }))
}

/// Whether a keyway lies at ψ = 0, so that a section along ψ = 0 shows its depth.
pub(in crate::body) fn is_at_zero(machine: &Machine, keyway: &Keyway) -> bool {
    direction(machine, keyway.angle).x > 1.0 - 1e-9
}

/// From the far side of the bore to the bottom of its keyway, with the limits of DIN 6885-1 if it is that of a standard key.
pub(in crate::body) fn keyway_depth(machine: &Machine, bore: f64, keyway: &Keyway) -> String {
    let units = machine.units();
    let depth = MILLIMETRES * (2.0 * bore + keyway.depth);
    let standard = parallel_key::standard(2.0 * bore, keyway.width, keyway.depth);
    let (deeper, proposed) = standard.map_or((DEEPER, PROPOSED), |standard| (MILLIMETRES * standard.deeper, ""));
    format!("{} {}{proposed}", units.toleranced(depth), units.limits([0.0, deeper]))
}
