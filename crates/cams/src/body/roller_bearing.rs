//! The bearing of a roller on its cam: life, speed and slip.
//!
//! The equivalent load is the mean over the turns of the roller, P = [∮ Nᵖ |n| dθ/∮ |n| dθ]^(1/p), of the force N along the normal and the turns n of
//! the roller for a turn of the cam; the life L10 is (C/P)ᵖ million turns (ISO 281:2007, with the rating C of a track roller). A roller that is to
//! turn faster or slower needs a moment at its rim: it slips where J |dn/dθ| ω² exceeds μ N r. Friction in the bearing is left out.

use crate::check::{Check, CheckExplanation, CheckScope, Measure, Measures, Subject};
use crate::machine::{BearingData, Machine};
use crate::report::{Bound, Fact, Section, Topic, Verdict, degrees, shown};
use camgen_kernel::numeric::quadrature;
use camgen_kernel::profile::Worst;
use camgen_kernel::text::{KeyChange, Remedy, Value, text};
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
        formula: "largest | ± |C'|/r − 1 − τψ' | over the turn, times the speed of the cam; the other sign on a flank around the roller; τψ' is how fast an arm swings against \
                  the rotation of the cam, 0 on a straight path",
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
        usual: "1, up to which the roller rolls everywhere; between two flanks only where more than a hundredth of the largest force presses it on",
        change: "a lighter rim, more preload, or a larger cam; a warning only, since most cams with rests slip for a moment",
    },
};

/// Panels of a stretch over which loads are integrated.
const PANELS: u32 = 32;

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

/// The force along the normal, N, and the turns for a turn of the cam of every roller that is in touch at a place.
type Passing<'a> = &'a dyn Fn(usize, f64) -> Vec<(f64, f64)>;

/// What a roller goes through in a turn of the cam.
pub(super) struct RollingOverTurn<'a> {
    pub(super) bearing: BearingData,
    /// The speed of the cam, rpm.
    pub(super) rpm: Option<f64>,
    /// Stretches between whose ends load and turns are smooth, each with its piece.
    pub(super) stretches: &'a [(usize, (f64, f64))],
    pub(super) passing: Passing<'a>,
    /// Largest force along the normal, N.
    pub(super) largest_load: f64,
    /// Largest |turns| for a turn of the cam, and where.
    pub(super) fastest: Worst,
    /// Share of one roller in the turns of all that pass; 1 where there is one.
    pub(super) share: f64,
}

impl RollingOverTurn<'_> {
    /// The duty of a roller.
    pub(super) fn duty(&self) -> RollerDuty {
        let Self { bearing, largest_load, fastest, .. } = *self;
        let exponent = bearing.exponent;
        let (mut turns, mut worn, mut turned) = (0.0, 0.0, 0.0);
        for (piece, range) in self.stretches {
            let sum = |of: fn(f64, f64) -> f64, at: f64| {
                let relative = |(force, turns): (f64, f64)| (force / largest_load.max(f64::MIN_POSITIVE), turns.abs());
                let worn = |(load, turns): (f64, f64)| of(libm::pow(load, exponent), turns);
                (self.passing)(*piece, at).into_iter().map(relative).map(worn).sum::<f64>()
            };
            turns += quadrature::integrate(|at| sum(|_, turns| turns, at), *range, PANELS);
            worn += quadrature::integrate(|at| sum(|load, turns| load * turns, at), *range, PANELS);
            turned += range.1 - range.0;
        }
        let equivalent_load = largest_load * libm::pow(worn / turns, 1.0 / exponent);
        let mean_turns = self.share * turns / turned;
        let life = self.rpm.map(|rpm| {
            let turns_per_hour = 60.0 * rpm * mean_turns;
            libm::pow(bearing.dynamic_rating / equivalent_load, exponent) * 1e6 / turns_per_hour
        });
        RollerDuty { mean_turns, equivalent_load, largest_load, fastest, life }
    }
}

/// The bearing of the roller of a cam, for checks and the report.
pub(super) struct RollerBearing<'a> {
    pub(super) machine: &'a Machine,
    pub(super) bearing: BearingData,
    /// The speed of the cam, rpm.
    pub(super) rpm: Option<f64>,
    pub(super) duty: &'a dyn Fn() -> Option<RollerDuty>,
    /// The largest share of the friction that the roller needs to follow the cam, and where; `None` where it is not known.
    pub(super) slip: &'a dyn Fn() -> Option<Worst>,
}

impl RollerBearing<'_> {
    /// The measures.
    pub(super) fn measured(&self, of: &mut Measures<'_>, subject: &Subject<'_>) {
        of.add(&LIFE, |_| self.life_measure());
        of.add(&SPEED, |_| {
            let (duty, rpm) = (self.duty)().zip(self.rpm)?;
            Some(SPEED.measure(rpm * duty.fastest.value, self.bearing.limiting_speed).at(subject, &duty.fastest))
        });
        of.add(&SLIP, |_| {
            let worst = (self.slip)()?;
            let verdict = if worst.value <= 1.0 { Verdict::Pass } else { Verdict::Warn };
            Some(SLIP.measure(worst.value, Some(1.0)).judged(verdict).at(subject, &worst))
        });
    }

    fn life_measure(&self) -> Measure {
        let limit = self.machine.limits.roller_life;
        let Some(duty) = (self.duty)() else {
            return LIFE.unknown("no force is known: give the mass of the follower and motion.rpm, or a spring");
        };
        let Some(life) = duty.life else { return LIFE.unknown("there is no speed: give motion.rpm or --rpm") };
        let kept = limit.is_none_or(|limit| life >= limit);
        let needed = limit.filter(|_| !kept).map(|limit| {
            let rating = self.bearing.dynamic_rating * libm::pow(limit / life, 1.0 / self.bearing.exponent);
            let key = format!("{}.bearing.dynamic_rating", self.machine.follower.path);
            let change = KeyChange::new(key, format!("{} kN", shown((rating / 10.0).ceil() / 100.0)));
            text!("{} would keep it", Remedy::new([change]))
        });
        let note = text!("equivalent load {} N", shown(duty.equivalent_load)).and("; ", needed.unwrap_or_default());
        LIFE.measure(life, limit).noted(note)
    }
}

/// The section `roller_bearing` where the forces are known.
pub(super) fn section(found: &RollerBearing<'_>) -> Option<Section> {
    let (bearing, duty) = (found.bearing, (found.duty)()?);
    let slip = (found.slip)();
    let section = BearingSection {
        mean_turns: duty.mean_turns,
        equivalent_load_n: duty.equivalent_load,
        life_h: duty.life,
        mean_rpm: found.rpm.map(|rpm| rpm * duty.mean_turns),
        largest_rpm: found.rpm.map(|rpm| rpm * duty.fastest.value),
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
    let life = section.life_h.map(|life| text!("life L10 {}", Value::brief(life, "h")));
    let speed = section.largest_rpm.map(|rpm| text!("up to {}", Value::brief(rpm, "rpm")));
    let facts = [life, speed].into_iter().flatten().map(|text| Fact::new(Topic::ROLLER, text));
    Some(Section::new("roller_bearing", &section).with_words(words).with_facts(facts))
}
