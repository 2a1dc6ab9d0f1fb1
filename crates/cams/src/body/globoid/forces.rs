//! The rollers of a turret under force.

use super::contact::TurretLine;
use super::{Flank, Globoid};
use crate::body::in_groove::{GrooveContact, InGroove};
use camgen_kernel::motion::Motion;

impl Globoid {
    fn contact(&self, roller: i32, line: &TurretLine, length: f64) -> GrooveContact {
        let middle = self.turret.arm;
        let point = line.point(middle);
        let (tilt, lean) = point.slope;
        // The flank that lifts lies below.
        let curvatures = [Flank::Lower, Flank::Upper].map(|flank| {
            let distance = self.signed(flank);
            let of = |v: f64| line.reduced_curvature(&line.point(v), distance) - distance.abs().recip();
            let [outside, reached] = self.touched();
            self.roller.recip() + of(outside).max(of(middle)).max(of(reached))
        });
        let (sin, cos) = libm::sincos(line.angle[0]);
        GrooveContact {
            roller,
            length,
            pressure_angle: libm::atan2(tilt, lean),
            leverage: middle,
            curvatures,
            by_path: [point.speed, line.speed_slope(&point)].map(|speed| speed / self.roller),
            carrier_turn: [sin, cos * line.angle[1]],
        }
    }
}

impl InGroove for Globoid {
    fn motion(&self) -> &dyn Motion {
        &*self.motion
    }

    fn rpm(&self) -> Option<f64> {
        self.rpm
    }

    fn roller(&self) -> f64 {
        self.roller
    }

    /// The rollers that touch over their whole reach; if none, those with centre lines between the ends that touch at all.
    fn contacts(&self, (piece, angle): (usize, f64), lifting: bool) -> Vec<GrooveContact> {
        let flank = if lifting { Flank::Lower } else { Flank::Upper };
        let lines = || self.rollers().map(|roller| (roller, self.line((piece, angle, 0.0), f64::from(roller))));
        let whole: Vec<GrooveContact> = lines()
            .filter(|(_, line)| self.touches_wholly(line, flank))
            .map(|(roller, line)| self.contact(roller, &line, self.length_of_contact(&line, flank)))
            .collect();
        if !whole.is_empty() {
            return whole;
        }
        let between = lines().filter(|(_, line)| line.angle[0].abs() <= self.end_angle);
        let touching = between.map(|(roller, line)| (roller, line, self.length_of_contact(&line, flank)));
        touching
            .filter(|(_, _, length)| *length > 0.0)
            .map(|(roller, line, length)| self.contact(roller, &line, length))
            .collect()
    }

    fn share_of_turns(&self) -> f64 {
        f64::from(self.turret.rollers).recip()
    }
}
