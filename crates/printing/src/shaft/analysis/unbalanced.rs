//! The unbalance of all that turns with the shaft, and the permissible one by ISO 21940-11.

use super::Measure;
use crate::shaft::checks::UNBALANCE;
use crate::shaft::mechanics::Shaft;
use crate::shaft::mechanics::unbalance::{self, Unbalance};
use camgen_cams::report::{degrees, shown};
use camgen_kernel::refusal::Refusal;
use serde::Serialize;

/// Gram millimetres in a kilogram metre.
const G_MM: f64 = 1e6;

/// The unbalance as seen in the plane of a bearing.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(super) struct Plane {
    at_mm: f64,
    unbalance_g_mm: f64,
    deg: f64,
    permissible_g_mm: Option<f64>,
}

/// The figures of the unbalance.
pub(super) struct UnbalanceFigures {
    pub(super) g_mm: f64,
    pub(super) deg: f64,
    pub(super) permissible_g_mm: Option<f64>,
    pub(super) planes: Vec<Plane>,
    /// Its centrifugal force, N; `None` where no speed is known.
    force: Option<f64>,
    /// e ω, mm/s.
    runs: Option<f64>,
    grade: Option<f64>,
}

impl UnbalanceFigures {
    /// The figures of the discs of a shaft with its cam, at a speed (rad/s); the grade is in mm/s.
    pub(super) fn new(shaft: &Shaft, speed: Option<f64>, grade: Option<f64>) -> Result<Self, Refusal> {
        let all: Vec<Unbalance> =
            shaft.discs().iter().map(|disc| Unbalance { at: disc.at, vector: disc.unbalance }).collect();
        let ([x, y], mass) = (unbalance::resultant(&all), shaft.mass());
        let size = libm::hypot(x, y);
        let speed = speed.filter(|speed| *speed > 0.0);
        let permissible = grade.zip(speed).map(|(grade, speed)| unbalance::permissible(grade, mass, speed));
        let places = shaft.supports().iter().map(|support| support.at);
        let (low, high) = places.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), at| (a.min(at), b.max(at)));
        let split = unbalance::split(&all, low, high)?;
        let shares = unbalance::shares(centre_of_mass(shaft), low, high)?;
        let mut planes = Vec::new();
        for ((at, [x, y]), share) in [low, high].into_iter().zip(split).zip(shares) {
            planes.push(Plane {
                at_mm: 1e3 * at,
                unbalance_g_mm: G_MM * libm::hypot(x, y),
                deg: degrees(libm::atan2(y, x)),
                permissible_g_mm: permissible.map(|permissible| G_MM * share * permissible),
            });
        }
        Ok(Self {
            g_mm: G_MM * size,
            deg: if size > 0.0 { degrees(libm::atan2(y, x)) } else { 0.0 },
            permissible_g_mm: permissible.map(|permissible| G_MM * permissible),
            planes,
            force: speed.map(|speed| size * speed * speed),
            runs: speed.map(|speed| 1e3 * size / mass * speed),
            grade,
        })
    }

    pub(super) fn describe(&self) -> String {
        let force = self.force.map_or(String::new(), |force| format!("; its centrifugal force is {force:.2} N"));
        format!("unbalance {} g·mm at {:.2}° of the cam{force}", shown(self.g_mm), self.deg)
    }

    pub(super) fn measure(&self) -> Measure {
        let grade = self.runs.map(|runs| match unbalance::grade_of(1e-3 * runs) {
            Some(grade) => format!("it runs at e ω = {runs:.3} mm/s, grade G {}", shown(grade)),
            None => format!("it runs at e ω = {runs:.3} mm/s, beyond every grade"),
        });
        let asked = self.grade.filter(|_| self.permissible_g_mm.is_some_and(|most| self.g_mm > most));
        let note = match (grade, asked) {
            (Some(grade), Some(asked)) => Some(format!(
                "{grade}; G {} needs a correction of {:.1} g·mm opposite, at {:.2}°",
                shown(asked),
                self.g_mm,
                (self.deg + 180.0) % 360.0
            )),
            (grade, _) => grade,
        };
        UNBALANCE.measure(self.g_mm, self.permissible_g_mm).noted(note)
    }
}

/// Place of the centre of mass along the shaft, m.
fn centre_of_mass(shaft: &Shaft) -> f64 {
    let segments = shaft.segments().iter().scan(0.0, |left, segment| {
        let middle = *left + 0.5 * segment.length;
        *left += segment.length;
        Some((middle, segment.mass()))
    });
    let discs = shaft.discs().iter().map(|disc| (disc.at, disc.mass));
    let (moment, mass) =
        segments.chain(discs).fold((0.0, 0.0), |(moment, mass), (at, own)| (moment + at * own, mass + own));
    if mass > 0.0 { moment / mass } else { 0.5 * shaft.length() }
}
