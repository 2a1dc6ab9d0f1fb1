//! A cam whose elastic load makes the motion of the program: `[motion.polydyne]`.
//!
//! The load, damped against the frame, follows ẍ + 2ζω_n ẋ + ω_n² x = ω_n² y. For it to move as s(θ) the cam's motion is
//! y = s + 2ζq s' + q² s'' with q = Ω/ω_n, by exact derivatives; it has two continuous derivatives less than s.

use super::keys::{DAMPING, NATURAL_FREQUENCY, OWN_RPM, POLYDYNE, RPM, SECTION};
use super::{EndState, Jump, Program, ProgramSegment, ROUNDING};
use crate::document::Reader;
use std::f64::consts::TAU;

/// An elastic load at the end of a follower.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Polydyne {
    /// Angular speed of the cam over the natural one: q.
    pub ratio: f64,
    /// Share of the critical damping: ζ.
    pub damping: f64,
}

/// The program with its load, where the file describes one.
pub(super) fn read(reader: &Reader<'_>, program: Program) -> Option<Program> {
    let Some(table) = reader.find(&POLYDYNE) else { return Some(program) };
    if program.stroke().is_some() {
        let message = "a polydyne cam is made for the speed of its shaft, and a plate has none".to_owned();
        table.fail(&NATURAL_FREQUENCY, message, Some("leave [motion.polydyne] out".into()));
        return None;
    }
    let rpm = if table.has(&OWN_RPM) { Some(table.get(&OWN_RPM)?) } else { program.rpm };
    let Some(rpm) = rpm else {
        if reader.find(&SECTION).is_some_and(|motion| motion.has(&RPM)) {
            return None;
        }
        let help = "add rpm here, or motion.rpm";
        table.fail(&OWN_RPM, "a polydyne cam is made for one speed".into(), Some(help.into()));
        return None;
    };
    let load = Polydyne { ratio: rpm / 60.0 / table.get(&NATURAL_FREQUENCY)?, damping: table.get(&DAMPING)? };
    match program.polydyne(load) {
        Ok(program) => Some(program),
        Err(jump) => {
            let what = ["velocity", "acceleration"].get(jump.order as usize - 1).unwrap_or(&"jerk");
            let message = format!(
                "the {what} of the load jumps at {:.6} deg: no cam can move it this way without an impact",
                jump.at.to_degrees()
            );
            let help = "a polydyne cam needs a motion with continuous jerk: 4-5-6-7, 5-6-7-8-9, polynomials with jerk = 0 at their ends, or one formula";
            table.fail(&NATURAL_FREQUENCY, message, Some(help.into()));
            None
        }
    }
}

impl Program {
    /// The motion of the cam under which an elastic load moves as this program.
    ///
    /// # Errors
    /// The jump of this program, which must be continuous up to its jerk.
    pub fn polydyne(&self, load: Polydyne) -> Result<Self, Jump> {
        if let Some(jump) = self.jump() {
            return Err(jump);
        }
        let mut program = Self {
            rpm: self.rpm,
            load: Some(load),
            rows: self.rows.clone(),
            stroke: self.stroke,
            ..Self::empty(self.quantity, self.lobes)
        };
        let whole = self.stroke.unwrap_or(TAU / f64::from(self.lobes));
        let first = self.segments.first().map_or(0.0, |segment| segment.start);
        let ends = self.segments.iter().skip(1).map(|segment| segment.start).chain([first + whole]);
        for (segment, end) in self.segments.iter().zip(ends) {
            program.add(loaded(segment, load), end);
        }
        program.repeat(whole);
        Ok(program.with_lowest())
    }
}

/// A segment of the cam's motion.
fn loaded(segment: &ProgramSegment, load: Polydyne) -> ProgramSegment {
    let (width, ratio) = (segment.width, load.ratio);
    let Some(curve) = &segment.curve else { return segment.clone() };
    let curve = curve.loaded(2.0 * load.damping * ratio / width, ratio * ratio / (width * width));
    let (peaks, last) = (curve.peaks(), curve.parts().saturating_sub(1));
    let ends = [(0, 0.0), (last, 1.0)].map(|(part, x)| {
        let [_, velocity, acceleration, _] = curve.values_at(part, x);
        let [velocity, acceleration] = [(velocity, peaks.velocity.value), (acceleration, peaks.acceleration.value)]
            .map(|(value, peak)| if value.abs() > ROUNDING * peak { value * segment.travel } else { 0.0 });
        EndState { velocity: velocity / width, acceleration: acceleration / (width * width), ..EndState::default() }
    });
    let to = segment.from + segment.travel * curve.values_at(last, 1.0)[0];
    let to = if segment.whole { segment.from } else { to };
    ProgramSegment { curve: Some(curve), ends, to, ..segment.clone() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::laws::named;
    use crate::motion::{Motion, Quantity};

    /// 30 mm in 120° by 4-5-6-7, q = 0.1, ζ = 0.05, at 40°: a value of 40-digit arithmetic.
    #[test]
    fn the_cam_of_a_load_is_the_known_one() {
        let third = TAU / 3.0;
        let segments =
            [(named("4-5-6-7"), third, 0.03), (None, 0.5, 0.03), (named("5-6-7-8-9"), 2.0, 0.0), (None, 0.0, 0.0)];
        let program = Program::new(Quantity::Length, 0.0, &segments).expect("a program");
        let load = Polydyne { ratio: 0.1, damping: 0.05 };
        let cam = program.polydyne(load).expect("continuous to the jerk");
        let origin = cam.origin().expect("a program");
        let ends = cam.segments().iter().map(|segment| segment.positions);
        for (found, known) in ends.zip([(0.0, 0.03), (0.03, 0.03), (0.03, 0.0), (0.0, 0.0)]) {
            assert!((found.0 - known.0).abs() + (found.1 - known.1).abs() < 1e-15, "{found:?} {known:?}");
        }
        let (piece, angle) = cam.locate(40.0_f64.to_radians());
        let found = 1e3 * (cam.jet(piece, angle).s + origin);
        assert!((found - 5.891_800_890_792_68).abs() < 1e-13, "{found}");
        // The load that this cam drives: x from y = x + 2ζq x' + q² x'' at every place, by the derivatives of the program.
        for degrees in 1..360 {
            let (piece, angle) = cam.locate(f64::from(degrees).to_radians());
            let y = cam.jet(piece, angle);
            let (piece, angle) = program.locate(angle);
            let s = program.jet(piece, angle);
            assert!((y.s + origin - (s.s + 0.01 * s.ds + 0.01 * s.dds)).abs() < 1e-15, "{degrees}");
            assert!((y.ds - (s.ds + 0.01 * s.dds + 0.01 * s.ddds)).abs() < 1e-15, "{degrees}");
        }
        assert_eq!(cam.jump().map(|jump| jump.order), Some(2));
        let cycloidal =
            Program::new(Quantity::Length, 0.0, &[(named("cycloidal"), 3.0, 0.03), (named("4-5-6-7"), 0.0, 0.0)])
                .expect("a program");
        assert_eq!(cycloidal.polydyne(load).expect_err("the jerk jumps").order, 3);
    }
}
