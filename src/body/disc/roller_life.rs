//! The bearing of a roller on its cam: life, speed and slip.
//!
//! The equivalent load is the mean over the turns of the roller, P = [∮ Nᵖ |n| dθ/∮ |n| dθ]^(1/p), of the force N along the normal and the turns n of
//! the roller for a turn of the cam; the life L10 is (C/P)ᵖ million turns (ISO 281:2007, with the rating C of a track roller). A roller that is to
//! turn faster or slower needs a moment at its rim: it slips where J |dn/dθ| ω² exceeds μ N r. Friction in the bearing is left out.

use super::{Disc, Hold};
use crate::check::{Check, CheckExplanation, CheckScope, Measure, Measures, Subject};
use crate::machine::BearingData;
use crate::numeric::{quadrature, root};
use crate::profile::Worst;
use crate::profile::extremes::stretches;
use crate::report::{Bound, Section, Verdict, degrees, shown};
use serde::Serialize;
use std::f64::consts::TAU;

/// The check of the life.
pub const LIFE: Check = Check {
    name: "roller_life",
    on: CheckScope::Cam,
    unit: "h",
    about: "The life L10 of the bearing of the roller, which nine of ten bearings reach, under the forces of a turn and the turns that the roller makes in it.",
    explained: CheckExplanation {
        bound: Bound::AtLeast,
        formula: "L10 = (C/P)^p 10⁶/(60 n), P = [∮ N^p |n| dθ/∮ |n| dθ]^(1/p), with the mean speed n of the roller (ISO 281:2007)",
        usual: "`limits.roller_life`; 20,000 to 30,000 h for machines that run one shift (catalogues of bearings)",
        change: "a larger roller or `dynamic_rating`, less mass or preload, a larger `cam.base_radius`, or a slower cam",
    },
};

/// The check of the speed.
pub const SPEED: Check = Check {
    name: "roller_speed",
    on: CheckScope::Cam,
    unit: "rpm",
    about: "The largest speed of the roller about its own axis.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "largest | ± |C'|/r − 1 − τψ' | over the turn, times the speed of the cam; the other sign on a flank around the roller",
        usual: "`limiting_speed` of the bearing, from its catalogue",
        change: "a larger roller, a smaller `cam.base_radius`, or a slower cam",
    },
};

/// The check of slip.
pub const SLIP: Check = Check {
    name: "roller_slip",
    on: CheckScope::Cam,
    unit: "1",
    about: "The largest share of the friction between roller and cam that is needed to change the spin of the roller: above 1 it slips and wears a flat.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "max J ω² |dn/dθ|/(μ N r) where the roller is pressed on; without friction in its bearing",
        usual: "1, up to which the roller rolls everywhere",
        change: "a lighter rim, more preload, or a larger `cam.base_radius`; a warning only, since most cams with rests slip for a moment",
    },
};

/// Panels of a stretch over which loads are integrated, and cells in which a force changes its sign once each.
const PANELS: u32 = 32;
const CELLS: u32 = 128;
/// A force below this share of the largest presses nothing on.
const PRESSED: f64 = 1e-6;

/// What the bearing of a roller goes through in a turn of the cam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollerDuty {
    /// Mean turns of the roller, without their sign, for a turn of the cam.
    pub mean_turns: f64,
    /// Equivalent load P, N.
    pub equivalent_load: f64,
    /// Largest force along the normal, N.
    pub largest_load: f64,
    /// Largest |turns| for a turn of the cam, and where.
    pub fastest: Worst,
    /// Life, h, where the speed of the cam is known.
    pub life: Option<f64>,
}

/// The section `roller_bearing`.
#[derive(Debug, Serialize)]
struct BearingSection {
    mean_turns: f64,
    equivalent_load_n: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    life_h: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    mean_rpm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    largest_rpm: Option<f64>,
    fastest_at_deg: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    static_safety: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    slip: Option<f64>,
}

impl Disc {
    /// Force along the normal with its sign, N, and turns of the roller for a turn of the cam on the flank on which the force holds it.
    fn load_and_turns(&self, piece: usize, at: f64) -> Option<(f64, f64)> {
        let curves = self.curves();
        let contact = curves.contact(piece, at);
        let signed = self.signed_normal_force((piece, at), &contact)?;
        let side = if self.hold == Hold::Flanks && signed < 0.0 { -1.0 } else { 1.0 };
        let touch = curves.touch(piece, at);
        Some((signed, side * touch.curve.speed / curves.offset() - touch.drive_turn))
    }

    /// The stretches of a turn on which force and spin are smooth.
    fn smooth_loads(&self) -> Vec<(usize, (f64, f64))> {
        let acting = self.acting();
        let pieces = self.motion.distinct().iter().enumerate();
        let all = pieces.flat_map(|(index, piece)| stretches(piece, &acting).into_iter().map(move |of| (index, of)));
        let cut = |(piece, (from, to)): (usize, (f64, f64))| {
            let force = |at: f64| self.load_and_turns(piece, at).map_or(f64::NAN, |(force, _)| force);
            let inside = root::sign_changes(force, (from, to), CELLS).into_iter().filter(|at| from < *at && *at < to);
            let ends: Vec<f64> = std::iter::once(from).chain(inside).chain([to]).collect();
            let parts: Vec<_> =
                ends.iter().copied().zip(ends.iter().copied().skip(1)).map(|part| (piece, part)).collect();
            parts
        };
        all.flat_map(cut).collect()
    }

    /// What the bearing of its roller goes through in a turn; `None` where no bearing or no force is given, or the follower jams.
    #[must_use]
    pub fn roller_duty(&self) -> Option<RollerDuty> {
        let bearing = self.machine.bearing()?;
        self.pressing()?;
        self.curves().roller_radius()?;
        let largest_load = self.largest_contact_force()?;
        let exponent = bearing.exponent;
        let (mut turns, mut worn, mut turned) = (0.0, 0.0, 0.0);
        for (piece, range) in self.smooth_loads() {
            let of = |at: f64| {
                self.load_and_turns(piece, at).map_or((f64::NAN, f64::NAN), |(_, n)| {
                    (self.normal_force(piece, at).unwrap_or(f64::NAN) / largest_load.max(f64::MIN_POSITIVE), n.abs())
                })
            };
            turns += quadrature::integrate(|at| of(at).1, range, PANELS);
            worn += quadrature::integrate(
                |at| {
                    let (load, turns) = of(at);
                    libm::pow(load, exponent) * turns
                },
                range,
                PANELS,
            );
            turned += range.1 - range.0;
        }
        let equivalent_load = largest_load * libm::pow(worn / turns, 1.0 / exponent);
        let mean_turns = turns / turned;
        let fastest = self.largest_force(|piece, at| self.load_and_turns(piece, at).map_or(f64::NAN, |(_, n)| n.abs()));
        let life = self.rpm.map(|rpm| {
            let turns_per_hour = 60.0 * rpm * mean_turns;
            libm::pow(bearing.dynamic_rating / equivalent_load, exponent) * 1e6 / turns_per_hour
        });
        Some(RollerDuty { mean_turns, equivalent_load, largest_load, fastest, life })
    }

    /// The largest share of the friction that the roller needs to follow the cam, and where; `None` where the inertia of its rim, the speed or a force
    /// is not given.
    #[must_use]
    pub fn roller_slip(&self) -> Option<Worst> {
        let (bearing, speed) = (self.machine.bearing()?, self.speed?);
        let (inertia, radius, curves) = (bearing.inertia?, self.curves().roller_radius()?, self.curves());
        let pressed = PRESSED * self.largest_contact_force()?;
        let share = |piece: usize, at: f64| {
            let lift = curves.motion.jet(piece, at);
            let Some(([speed_slope, turn_slope], (force, _))) =
                curves.follower.speed_slopes(&lift).zip(self.load_and_turns(piece, at))
            else {
                return f64::NAN;
            };
            let side = if self.hold == Hold::Flanks && force < 0.0 { -1.0 } else { 1.0 };
            let slope = (side * speed_slope / curves.offset() - turn_slope).abs();
            let force = self.normal_force(piece, at).unwrap_or(f64::NAN);
            if force <= pressed { 0.0 } else { inertia * speed * speed * slope / (bearing.friction * force * radius) }
        };
        Some(self.largest_force(share))
    }

    /// The measures of the bearing of its roller.
    pub(super) fn measured_in_bearing(&self, of: &mut Measures<'_>, subject: &Subject<'_>) {
        let Some(bearing) = self.machine.bearing() else { return };
        of.add(&LIFE, |_| self.life_measure(&bearing));
        of.add(&SPEED, |_| {
            let (duty, rpm) = self.roller_duty().zip(self.rpm)?;
            Some(SPEED.measure(rpm * duty.fastest.value, bearing.limiting_speed).at(subject, &duty.fastest))
        });
        of.add(&SLIP, |_| {
            let worst = self.roller_slip()?;
            let verdict = if worst.value <= 1.0 { Verdict::Pass } else { Verdict::Warn };
            Some(SLIP.measure(worst.value, Some(1.0)).judged(verdict).at(subject, &worst))
        });
    }

    fn life_measure(&self, bearing: &BearingData) -> Measure {
        let limit = self.machine.limits.roller_life;
        let Some(duty) = self.roller_duty() else {
            return LIFE.unknown("no force is known: give the mass of the follower and motion.rpm, or a spring");
        };
        let Some(life) = duty.life else { return LIFE.unknown("there is no speed: give motion.rpm or --rpm") };
        let kept = limit.is_none_or(|limit| life >= limit);
        let needed = limit.filter(|_| !kept).map(|limit| {
            let rating = bearing.dynamic_rating * libm::pow(limit / life, 1.0 / bearing.exponent);
            format!("; a dynamic_rating of {} kN would keep it", shown((rating / 10.0).ceil() / 100.0))
        });
        let note = format!("equivalent load {} N{}", shown(duty.equivalent_load), needed.unwrap_or_default());
        LIFE.measure(life, limit).noted(note)
    }

    /// The section `roller_bearing` where the file gives one.
    pub(super) fn bearing_section(&self) -> Option<Section> {
        let (bearing, duty) = (self.machine.bearing()?, self.roller_duty()?);
        let slip = self.roller_slip();
        let section = BearingSection {
            mean_turns: duty.mean_turns,
            equivalent_load_n: duty.equivalent_load,
            life_h: duty.life,
            mean_rpm: self.rpm.map(|rpm| rpm * duty.mean_turns),
            largest_rpm: self.rpm.map(|rpm| rpm * duty.fastest.value),
            fastest_at_deg: degrees(duty.fastest.at.rem_euclid(TAU)),
            static_safety: bearing.static_rating.map(|rating| rating / duty.largest_load),
            slip: slip.map(|worst| worst.value),
        };
        let life = section.life_h.map_or(String::new(), |life| format!("; life L10 {} h", shown(life)));
        let mut words = vec![format!(
            "equivalent load on the bearing of the roller {} N, {} turns for a turn of the cam{life}",
            shown(section.equivalent_load_n),
            shown(section.mean_turns)
        )];
        if let Some((mean, largest)) = section.mean_rpm.zip(section.largest_rpm) {
            let at = section.fastest_at_deg;
            words.push(format!("roller at {} rpm, at most {} rpm at {at:.3}°", shown(mean), shown(largest)));
        }
        words.extend(section.static_safety.map(|safety| format!("static safety C0/N {}", shown(safety))));
        words.extend(slip.map(|worst| {
            let (share, at) = (shown(worst.value), degrees(worst.at.rem_euclid(TAU)));
            format!("to follow the cam the roller needs up to {share} of the friction, at {at:.3}°")
        }));
        Some(Section::new("roller_bearing", &section).with_words(words))
    }
}
