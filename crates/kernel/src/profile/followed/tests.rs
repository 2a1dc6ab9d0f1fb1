use super::*;
use crate::follower::TranslatingRoller;
use crate::motion::Piece;

/// Waves on one piece: lift A sin(nθ), so that on a circle about the shaft, where the follower does not move, the motion itself is the error.
#[derive(Debug)]
struct Waves(f64);

/// The amplitude, m.
const AMPLITUDE: f64 = 1e-3;

impl Motion for Waves {
    fn pieces(&self) -> &[Piece] {
        &[Piece { start: 0.0, end: std::f64::consts::TAU, dwell: false }]
    }
    fn jet(&self, _: usize, angle: f64) -> Jet {
        let n = self.0;
        let (sin, cos) = libm::sincos(n * angle);
        let [s, ds, dds, ddds] = [sin, n * cos, -n * n * sin, -n * n * n * cos].map(|value| AMPLITUDE * value);
        Jet { s, ds, dds, ddds }
    }
}

/// An arc may run over whole waves, between whose ends, in whose middle and at whose quarters nothing is off.
#[test]
fn waves_over_one_arc_are_errors() {
    let follower = TranslatingRoller::new(0.05, 0.0, 0.01);
    for n in [1.0, 2.0, 4.0, 5.0] {
        let curves = Curves { motion: &Waves(n), follower: &follower };
        let errors =
            FollowerOnChain::new(curves, &Contour::circle(Vector2::zeros(), 40.0).edges().collect::<Vec<_>>()).errors();
        // The follower moves by less than 1e-17 m; the largest error is found by golden sections.
        assert!((errors.velocity.value / (n * AMPLITUDE) - 1.0).abs() < 1e-9, "{n}: {errors:?}");
        assert!((errors.acceleration.value / (n * n * AMPLITUDE) - 1.0).abs() < 1e-9, "{n}: {errors:?}");
    }
}
