//! The motion of a follower on the outline of such a disc.

use crate::brake::disc_motion::tests::disc;
use camgen_kernel::follower::TranslatingRoller;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::{Jet, Motion, Piece};
use camgen_kernel::profile::Curves;
use camgen_kernel::profile::followed::*;
use camgen_kernel::profile::outline::{self, Fit, MotionTolerance};

/// Velocity and acceleration that the outline is asked to keep, m/rad and m/rad².
const ASKED: MotionTolerance = MotionTolerance { velocity: 1e-4, acceleration: 5e-3 };

/// The disc of a brake under a roller, as drawn with its edges; `spoilt` moves the vertex nearest to a place (rad).
fn errors(spoilt: Option<f64>) -> (ErrorsOnChain, Vec<[f64; 3]>) {
    let (motion, follower) = (disc(), TranslatingRoller::new(0.05, 0.0, 0.01));
    let curves = Curves { motion: &motion, follower: &follower };
    let fit = Fit { motion: ASKED, ..Fit::from(5e-6) };
    let mut contour = outline::profile(curves, fit).expect("an outline").contour;
    if let Some(at) = spoilt {
        let place = curves.profile(motion.locate(at).0, at).point * MILLIMETRES;
        let away = |index: &usize| (contour.vertices[*index].point - place).norm();
        let nearest = (0..contour.vertices.len()).min_by(|a, b| away(a).total_cmp(&away(b))).expect("vertices");
        contour.vertices[nearest].point *= 1.001;
    }
    let followed = FollowerOnChain::on(curves, &contour, &[false]);
    (followed.errors(), followed.accelerations(0.01))
}

#[test]
fn what_no_follower_runs_on_is_not_felt() {
    let working = disc().pieces()[0];
    let (drawn, trace) = errors(None);
    assert!(drawn.velocity.value <= ASKED.velocity * (1.0 + 1e-6), "{drawn:?}");
    assert!(drawn.acceleration.value <= ASKED.acceleration * (1.0 + 1e-6), "{drawn:?}");
    assert!(trace.iter().all(|[at, ..]| (working.start - 1e-8..=working.end + 1e-8).contains(at)));
    assert!(trace.len() > 70, "{}", trace.len());

    assert_eq!(errors(Some(5.5)).0, drawn, "on the closing stretch");
    let felt = errors(Some(2.0)).0;
    assert!(felt.acceleration.value > 2.0 * drawn.acceleration.value, "{felt:?}");
}

/// The quintic is by far the quicker: the largest of the law are those of the working stretch alone.
#[test]
fn the_largest_rates_are_those_of_the_working_stretch() {
    let motion = disc();
    let [velocity, acceleration] = largest_rates(&motion);
    let sampled = |piece: usize, of: fn(Jet) -> f64| {
        let Piece { start, end, .. } = motion.pieces()[piece];
        (0..=1000)
            .map(|i| of(motion.jet(piece, start + (end - start) * f64::from(i) / 1000.0)).abs())
            .fold(0.0, f64::max)
    };
    for (largest, of) in [(velocity, (|jet| jet.ds) as fn(Jet) -> f64), (acceleration, |jet| jet.dds)] {
        assert!((largest / sampled(0, of) - 1.0).abs() < 1e-5, "{largest}");
        assert!(sampled(1, of) > 2.0 * largest, "{largest}");
    }
}
