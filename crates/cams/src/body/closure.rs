//! How the two outlines between which a rigid follower is held close on it, as they are in the file.
//!
//! At each cam angle the lifts that the two outlines really give are added up, each counted outwards from the metal. What the rigid follower
//! leaves for both is their sum: more of it is metal that pinches the follower, less of it is play.

use crate::body::torque::followed;
use crate::body::{Body, curves};
use crate::check::{Check, CheckExplanation, CheckScope, Measure};
use crate::report::Bound;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::numeric::extremum;
use camgen_kernel::profile::{Worst, extremes, lifts};
use camgen_kernel::text::{Length, text};
use serde::Serialize;

/// The check.
pub const CHECK: Check = Check {
    name: "closure",
    on: CheckScope::Motion,
    unit: "mm",
    about: "The largest difference between the lifts that the two flanks of a form-closed cam (conjugate discs, rib, yoke) give together, as they \
            are in the file, and what a rigid follower leaves for both: it is pinched by it or has play.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "max |s₁ + s₂ − h| over the turn, along the path of the first roller, of the lifts that the written outlines give; of a rib |s₁ − s₂|",
        usual: "two tolerances over the cosine of the largest pressure angle, one for each flank",
        change: "a finer --tolerance; `--side inside` leaves play and never pinches",
    },
};

/// Places of a piece between which the hills of the sum are found, a few to an arc of either outline, and how many are followed to the top.
const PLACES: u32 = 240;
const HILLS: usize = 4;
const SECTIONS: u32 = 40;

/// How the lifts on two outlines belong together.
#[derive(Debug, Clone, Copy)]
pub enum Pairing {
    /// Either follower goes up as the other goes down: s₁ + s₂ is the largest lift.
    Opposite,
    /// Both go together, on either side of a wall: s₁ − s₂ is 0.
    Together,
}

/// The sum of the lifts less what a rigid follower leaves for both, along the path of the first roller.
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
    /// Of two discs with their written outlines (mm), each drawn within a tolerance, mm; `None` where a follower does not touch.
    #[must_use]
    pub fn of(
        main: (&dyn Body, &Contour),
        counter: (&dyn Body, &Contour),
        (pairing, tolerance_mm): (Pairing, f64),
    ) -> Option<Self> {
        let (first, second) = (curves(main.0)?, curves(counter.0)?);
        let (on_first, on_second) = (followed(main)?, followed(counter)?);
        let (sign, top) = match pairing {
            Pairing::Opposite => (1.0, lifts(first.motion).1),
            Pairing::Together => (-1.0, 0.0),
        };
        // On a straight path the second roller of a pair is on the other side of the shaft.
        let later = second.motion.range().0 - first.motion.range().0;
        let scale = |piece: usize, at: f64| MILLIMETRES * first.follower.leverage(&first.motion.jet(piece, at));
        let sum = |piece: usize, at: f64| {
            let lifts = on_first.jet_at(at).zip(on_second.jet_at(at + later));
            lifts.map_or(f64::NAN, |(one, two)| scale(piece, at) * (one.s + sign * two.s - top))
        };
        let most = |sign: f64| {
            let of = |(index, piece): (usize, &camgen_kernel::motion::Piece)| {
                extremum::largest_of_hills(
                    |at| sign * sum(index, at),
                    (piece.start, piece.end),
                    PLACES,
                    HILLS,
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
        let Some(found) = found else { return CHECK.unknown("the follower does not touch along its path") };
        let pinches = found.pinch_mm >= -found.play_mm;
        let (value, at) =
            if pinches { (found.pinch_mm, found.pinch_at_deg) } else { (-found.play_mm, found.play_at_deg) };
        let word = |sum: f64| if sum > 0.0 { "pinched by" } else { "loose by" };
        let [most, least] = [found.pinch_mm, found.play_mm].map(|sum| text!("{} {}", word(sum), Length::mm(sum.abs())));
        let worst = Worst { value, at: at.to_radians(), z: 0.0 };
        let note = text!(
            "the follower is {} at {}°, {} at {}°",
            most,
            format_args!("{:.3}", found.pinch_at_deg),
            least,
            format_args!("{:.3}", found.play_at_deg)
        );
        CHECK.measure(value, Some(found.permitted_mm)).placed(main.place(worst.at)).noted(note)
    }
}
