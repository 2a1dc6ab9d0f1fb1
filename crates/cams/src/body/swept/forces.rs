//! The rollers under force.

use super::line::RollerLine;
use super::{FlankSide, SweptBody, TouchingRoller};
use crate::body::in_groove::{GrooveContact, InGroove};
use camgen_kernel::motion::{Jet, Motion};

impl<B: SweptBody> InGroove for B {
    fn motion(&self) -> &dyn Motion {
        &*self.groove().motion
    }

    fn rpm(&self) -> Option<f64> {
        self.groove().rpm
    }

    fn roller(&self) -> f64 {
        self.groove().roller
    }

    fn contacts(&self, (piece, angle): (usize, f64), lifting: bool) -> Vec<GrooveContact> {
        let lift = self.groove().motion.jet(piece, angle);
        let flank = if lifting { FlankSide::Lower } else { FlankSide::Upper };
        self.touching(&lift, flank).iter().map(|touching| contact(self, &lift, touching)).collect()
    }

    fn share_of_turns(&self) -> f64 {
        f64::from(self.roller_count()).recip()
    }
}

fn contact<B: SweptBody>(body: &B, lift: &Jet, touching: &TouchingRoller<B::Line>) -> GrooveContact {
    let TouchingRoller { roller, line, length } = touching;
    let groove = body.groove();
    let middle = body.middle(line);
    let [inner, outer] = body.touched(line);
    // The flank that lifts lies below.
    let curvatures = [FlankSide::Lower, FlankSide::Upper].map(|flank| {
        let distance = groove.signed(flank);
        let curvatures = [inner, middle, outer]
            .map(|v| line.curvature_under(&line.point(v), distance, line.radius_at(v, groove.roller)));
        curvatures.into_iter().fold(f64::NAN, f64::max)
    });
    let point = line.point(middle);
    GrooveContact {
        roller: *roller,
        length: *length * line.slant(),
        pressure_angle: line.normal_angle(body.pressure_angle(lift, line, middle)),
        leverage: body.way_of_lift(),
        curvatures,
        by_path: [point.speed, line.speed_slope(&point)].map(|speed| speed / line.radius_at(middle, groove.roller)),
        carrier_turn: body.carrier_turn(lift, line),
    }
}
