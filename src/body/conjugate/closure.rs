//! How the two discs of a pair close on their rollers, as they are in their files.
//!
//! At each cam angle the lifts that the two outlines really give are added up. The rollers of a rigid follower leave the largest lift for both: a
//! sum above it is metal that pinches them, a sum below it is play.

use crate::body::torque::followed;
use crate::body::{Body, curves};
use crate::check::{Check, CheckExplanation, CheckScope, Measure};
use crate::geometry::MILLIMETRES;
use crate::geometry::contour::Contour;
use crate::motion::Quantity;
use crate::numeric::extremum;
use crate::profile::{Worst, extremes, lifts};
use crate::report::{Bound, Section, shown};
use serde::Serialize;

/// The check.
pub const CHECK: Check = Check {
    name: "closure",
    on: CheckScope::Cam,
    unit: "mm",
    about: "The largest difference between the lifts that the two discs of a pair give together, as they are in their files, and the largest lift: the \
            rollers are pinched by it or have play.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "max |s₁ + s₂ − h| over the turn, along the path of the first roller, of the lifts that the written outlines give",
        usual: "two tolerances over the cosine of the largest pressure angle, one for each disc",
        change: "a finer --tolerance; `--side inside` leaves play and never pinches",
    },
};

/// Places of a piece between which the hills of the sum are found, a few to an arc of either outline, and how many are followed to the top.
const PLACES: u32 = 240;
const HILLS: usize = 4;
const SECTIONS: u32 = 40;

/// The sum of the lifts of a pair less the largest lift, along the path of the first roller.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Closure {
    /// The largest: the rollers are pinched by it, mm.
    pub pinch_mm: f64,
    /// Cam angle of the main disc.
    pub pinch_at_deg: f64,
    /// The least, where it is negative the play, mm.
    pub play_mm: f64,
    /// Cam angle of the main disc.
    pub play_at_deg: f64,
    /// What both tolerances permit, mm.
    pub permitted_mm: f64,
}

impl Closure {
    /// Of two discs with their written outlines (mm), each drawn within a tolerance, mm; `None` where a roller does not touch.
    #[must_use]
    pub fn of(main: (&dyn Body, &Contour), counter: (&dyn Body, &Contour), tolerance_mm: f64) -> Option<Self> {
        let (first, second) = (curves(main.0)?, curves(counter.0)?);
        let (on_first, on_second) = (followed(main)?, followed(counter)?);
        let top = lifts(first.motion).1;
        // On a straight path the second roller is on the other side of the shaft.
        let later = second.motion.range().0 - first.motion.range().0;
        let scale = |piece: usize, at: f64| MILLIMETRES * first.follower.leverage(&first.motion.jet(piece, at));
        let sum = |piece: usize, at: f64| {
            let lifts = on_first.at(at).zip(on_second.at(at + later));
            lifts.map_or(f64::NAN, |(one, two)| scale(piece, at) * (one.s + two.s - top))
        };
        let most = |sign: f64| {
            let of = |(index, piece): (usize, &crate::motion::Piece)| {
                extremum::largest_of_hills(
                    |at| sign * sum(index, at),
                    (piece.start, piece.end),
                    (PLACES, HILLS),
                    SECTIONS,
                )
            };
            let all = first.motion.pieces().iter().enumerate().map(of);
            all.reduce(|best, next| if next.value <= best.value { best } else { next })
        };
        let (pinch, play) = (most(1.0)?, most(-1.0)?);
        let steepest =
            [first, second].map(|curves| extremes::pressure_angle(curves).value).into_iter().fold(0.0, f64::max);
        let degrees = |at: f64| at.to_degrees().rem_euclid(360.0);
        Some(Self {
            pinch_mm: pinch.value,
            pinch_at_deg: degrees(pinch.at),
            play_mm: -play.value,
            play_at_deg: degrees(play.at),
            permitted_mm: 2.0 * tolerance_mm / libm::cos(steepest),
        })
        .filter(|found| found.pinch_mm.is_finite() && found.play_mm.is_finite())
    }

    /// Measure of it; unknown where a roller does not touch.
    #[must_use]
    pub fn measure(found: Option<&Self>, main: &dyn Body) -> Measure {
        let Some(found) = found else { return CHECK.unknown("a roller does not touch along its path") };
        let pinches = found.pinch_mm >= -found.play_mm;
        let (value, at) =
            if pinches { (found.pinch_mm, found.pinch_at_deg) } else { (-found.play_mm, found.play_at_deg) };
        let word = |sum: f64| if sum > 0.0 { "pinched by" } else { "loose by" };
        let [most, least] = [found.pinch_mm, found.play_mm].map(|sum| format!("{} {} mm", word(sum), shown(sum.abs())));
        let worst = Worst { value, at: at.to_radians(), z: 0.0 };
        let note =
            format!("the rollers are {most} at {:.3}°, {least} at {:.3}°", found.pinch_at_deg, found.play_at_deg);
        CHECK.measure(value, Some(found.permitted_mm)).placed(main.place(worst.at)).noted(note)
    }

    /// The section of the report on a pair.
    #[must_use]
    pub fn section(&self, counter: &dyn Body) -> Section {
        let of = curves(counter).map(|curves| (curves, curves.follower.prime_radius().unwrap_or(f64::NAN)));
        let (roller, prime) = of.map_or((f64::NAN, f64::NAN), |(curves, prime)| (curves.offset(), prime));
        let [roller, prime] = [roller, prime].map(|length| MILLIMETRES * length);
        let value = serde_json::json!({
            "counter_prime_radius_mm": prime,
            "counter_base_radius_mm": prime - roller,
            "counter_roller_radius_mm": roller,
            "closure": self,
        });
        let size = format!(
            "counter disc: base radius {} mm, roller Ø{} mm, prime radius {} mm",
            shown(prime - roller),
            shown(2.0 * roller),
            shown(prime)
        );
        let swings = curves(counter).is_some_and(|curves| curves.motion.quantity() == Quantity::Angle);
        let along = if swings { "along the arc of the first roller" } else { "along the path" };
        let sum = format!(
            "both lifts as written add up to the largest within {} to {} mm {along}",
            shown(self.play_mm),
            shown(self.pinch_mm)
        );
        Section::new("conjugate", &value).with_words(vec![size, sum])
    }
}
