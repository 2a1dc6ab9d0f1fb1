//! Life of the roller of a rotary cam, by the rating of its catalogue (ISO 281).
//!
//! The roller runs off the profile, so that the mean of its load is one over the length of it:
//!
//! ```text
//! P_m^(10/3) = ∮ F^(10/3) ds/∮ ds,   L10 = (C/P_m)^(10/3) 10⁶ turns of the roller,   ∮ ds/(2π r_f) of them a turn of the cam
//! ```

use super::machine::PressCams;
use camgen_cams::body::Body;
use camgen_cams::body::disc::Disc;
use camgen_cams::body::roller_bearing::LIFE;
use camgen_cams::check::Measure;
use camgen_cams::report::{Section, shown};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::numeric::quadrature;
use camgen_kernel::profile::extremes::stretches;
use camgen_kernel::text::text;
use serde::Serialize;
use std::f64::consts::TAU;

/// Exponent of the life of roller bearings (ISO 281).
const EXPONENT: f64 = 10.0 / 3.0;
/// Share of the rating up to which ISO 281 holds: beyond, the surfaces yield.
const HEAVY: f64 = 0.5;
/// Panels of a stretch, of eight points each.
const PANELS: u32 = 64;

/// What the roller of a cam lasts.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct RollerLife {
    pub load_rating_n: f64,
    /// P_m.
    pub mean_load_n: f64,
    pub profile_length_mm: f64,
    /// Turns of the roller for a turn of the cam.
    pub roller_turns_per_cam_turn: f64,
    /// L10: nine of ten rollers reach it.
    pub life_roller_turns: f64,
    pub life_cam_turns: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub life_h: Option<f64>,
}

/// The life of the roller of a disc of a press; `None` where the file gives no rating, or a force is not known.
#[must_use]
pub fn of_disc(disc: &Disc) -> Option<RollerLife> {
    let rating = PressCams::of(disc.machine()).load_rating?;
    let (curves, lobes) = (disc.curves(), f64::from(disc.curves().motion.lobes().max(1)));
    let radius = curves.roller_radius()?;
    let largest = disc.largest_contact_force().filter(|force| *force > 0.0)?;
    let acting = disc.acting();
    let (mut length, mut worn) = (0.0, 0.0);
    let pieces = curves.motion.pieces().len() / curves.motion.lobes().max(1) as usize;
    for (index, piece) in curves.motion.pieces().iter().enumerate().take(pieces) {
        for stretch in stretches(piece, &acting) {
            length += quadrature::integrate(|at| curves.profile(index, at).speed.abs(), stretch, PANELS);
            worn += quadrature::integrate(
                |at| {
                    // In the force over its largest nothing overflows.
                    let share = disc.normal_force(index, at).unwrap_or(f64::NAN).max(0.0) / largest;
                    libm::pow(share, EXPONENT) * curves.profile(index, at).speed.abs()
                },
                stretch,
                PANELS,
            );
        }
    }
    let mean = largest * libm::pow(worn / length, 1.0 / EXPONENT);
    let turns = lobes * length / (TAU * radius);
    let life = 1e6 * libm::pow(rating / mean, EXPONENT);
    let hours = disc.shaft_speed().map(|speed| life / turns * TAU / speed / 3600.0);
    Some(RollerLife {
        load_rating_n: rating,
        mean_load_n: mean,
        profile_length_mm: MILLIMETRES * lobes * length,
        roller_turns_per_cam_turn: turns,
        life_roller_turns: life,
        life_cam_turns: life / turns,
        life_h: hours,
    })
    .filter(|life| life.mean_load_n.is_finite())
}

/// The measure of the hours that the roller of a disc lasts; `None` where neither a rating nor a limit is given.
#[must_use]
pub fn measure(disc: &Disc) -> Option<Measure> {
    let limit = disc.machine().limits.roller_life;
    if PressCams::of(disc.machine()).load_rating.is_none() {
        return limit.map(|_| LIFE.unknown("limits.roller_life is given without follower.roller.load_rating"));
    }
    of_disc(disc)?.measure(limit)
}

impl RollerLife {
    /// The measure of the hours against their limit; `None` where the speed is not known.
    #[must_use]
    pub fn measure(&self, limit: Option<f64>) -> Option<Measure> {
        let hours = self.life_h?;
        let needed = limit.filter(|limit| hours < *limit).map(|limit| {
            let rating = self.load_rating_n * libm::pow(limit / hours, 1.0 / EXPONENT);
            text!("a follower.roller.load_rating of {} kN would keep it", shown((rating / 10.0).ceil() / 100.0))
        });
        let note = text!("mean load {} N", shown(self.mean_load_n)).and("; ", needed);
        Some(LIFE.measure(hours, limit).noted(note))
    }

    /// The section of the report.
    #[must_use]
    pub fn section(&self) -> Section {
        let hours = self.life_h.map_or(String::new(), |hours| format!(", {} h", shown(hours)));
        let words = format!(
            "L10 of the roller {} million of its turns, {} million turns of the cam{hours}: mean load {} N, rating {} N; {} turns a turn of the cam",
            shown(1e-6 * self.life_roller_turns),
            shown(1e-6 * self.life_cam_turns),
            shown(self.mean_load_n),
            shown(self.load_rating_n),
            shown(self.roller_turns_per_cam_turn)
        );
        let heavy = self.mean_load_n > HEAVY * self.load_rating_n;
        let heavy = heavy.then(|| {
            "the mean load is above half of the rating: ISO 281 does not hold there, and the roller lasts less"
                .to_owned()
        });
        Section::new("roller_life", self).with_words(std::iter::once(words).chain(heavy).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::press::rotary::rotary;
    use camgen_cams::machine::Machine;

    /// By 34-digit arithmetic, outside of the project, for a profile that is 1.4 µm longer where no force acts: two millionths of the length.
    #[test]
    fn golden_life() {
        let of = |sets: &[&str]| {
            let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
            let machine = Machine::load("dpi", &sets).expect("valid").0;
            of_disc(&rotary(&machine, 35.0).expect("a disc").disc)
        };
        let life = of(&["follower.roller.load_rating=100 kN"]).expect("a life");
        assert!((life.profile_length_mm / 841.124_813 - 1.0).abs() < 2e-6, "{life:?}");
        assert!((life.mean_load_n / 13_488.471_12 - 1.0).abs() < 1e-6, "{life:?}");
        assert!((life.life_roller_turns / 794.555_512_9e6 - 1.0).abs() < 2e-6, "{life:?}");
        // With that length the mean is the golden one to its last digit.
        let mean = life.mean_load_n * libm::pow(life.profile_length_mm / 841.124_813, 0.3);
        assert!((mean / 13_488.471_12 - 1.0).abs() < 1e-9, "{mean}");
        assert!((life.roller_turns_per_cam_turn * TAU * 30.0 / life.profile_length_mm - 1.0).abs() < 1e-14);
        let twice = of(&["follower.roller.load_rating=200 kN"]).expect("a life");
        assert!((twice.life_cam_turns / life.life_cam_turns - libm::pow(2.0, EXPONENT)).abs() < 1e-12);
        // 105 turns of the crank in a minute.
        assert!((life.life_h.expect("hours") * 60.0 * 105.0 / life.life_cam_turns - 1.0).abs() < 1e-12);
        assert_eq!(of(&[]), None);
        let lobes = of(&["follower.roller.load_rating=100 kN", "cam.cam_turns_per_crank_turn=0.5"]).expect("a life");
        assert!(lobes.profile_length_mm > life.profile_length_mm && lobes.life_cam_turns < life.life_cam_turns);
    }
}
