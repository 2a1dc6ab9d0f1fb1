//! The torque on a shaft, with the followers where outlines as written put them.

use super::{Body, curves};
use crate::report::trace::Trace;
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::motion::Motion;
use camgen_kernel::profile::followed::FollowerOnChain;

/// Places of a stretch of an outline at which the largest torque is looked for.
const PLACES: u32 = 8;
/// Places of a stretch at which a torque is shown.
const SHOWN: u32 = 4;

/// How far within a stretch its first and last place lie, as a share of it.
const INSET: f64 = 1e-6;

/// A disc that turns, and its outline, mm.
pub type DiscOutline<'a> = (&'a dyn Body, &'a Contour);

/// The follower of a disc on its outline; `None` of a body that is not a disc.
pub(crate) fn followed((body, outline): DiscOutline<'_>) -> Option<FollowerOnChain<'_>> {
    let cut = *body.cuts().first()?;
    Some(FollowerOnChain::on(cut.curves?, outline, cut.mirrored))
}

/// Force of the cam on the follower along its path, N, or its moment about the pivot of one that swings, N·m, and the torque of the
/// shaft against it, N·m, at a cam angle; `None` where no force is known.
#[must_use]
pub fn force_and_torque(body: &dyn Body, angle: f64) -> Option<[f64; 2]> {
    let motion = curves(body)?.motion;
    let at = motion.locate(angle);
    body.load()?.force_and_torque(at, motion.jet(at.0, at.1))
}

/// Whether a disc that is made with another one takes a torque of its own from their shaft.
pub(crate) fn has_own_torque(body: &dyn Body) -> bool {
    body.load().is_some_and(|load| !load.is_of_another_disc())
}

/// A disc whose follower is on its outline.
struct TorqueOnOutline<'a> {
    body: &'a dyn Body,
    motion: &'a dyn Motion,
    followed: &'a FollowerOnChain<'a>,
}

impl<'a> TorqueOnOutline<'a> {
    /// `None` where it does not turn.
    fn new(body: &'a dyn Body, followed: &'a FollowerOnChain<'a>) -> Option<Self> {
        let motion = curves(body)?.motion;
        motion.period()?;
        Some(Self { body, motion, followed })
    }

    /// Torque by the law, and force along the follower's path times the slope that the normal gives where it touches, N·m; `None` where
    /// the force is not known or the follower is not in touch.
    fn torques(&self, angle: f64) -> Option<[f64; 2]> {
        let motion = self.motion;
        let at = motion.locate(angle);
        let lift = motion.jet(at.0, at.1);
        let [force, law] = self.body.load()?.force_and_torque(at, lift)?;
        Some([law, force * self.followed.at_known_lift(angle, Some((at, lift)))?.ds])
    }

    fn torque(&self, angle: f64) -> Option<f64> {
        self.torques(angle).map(|[_, cut]| cut)
    }

    /// Places of its stretches, from slightly after the one end to slightly before the other.
    fn places(&self, each: u32) -> impl Iterator<Item = f64> + '_ {
        self.followed.ranges().flat_map(move |(from, to)| {
            // At an end itself the force of one disc may have jumped already and that of the other not yet.
            let inset = INSET * (to - from);
            (0..=each).map(move |place| from + inset + (to - from - 2.0 * inset) * f64::from(place) / f64::from(each))
        })
    }
}

/// Largest torque that two discs on one shaft leave together as cut, N·m; `None` where a force is not known or a follower is not in
/// touch.
#[must_use]
pub fn remaining_torque(first: DiscOutline<'_>, second: DiscOutline<'_>) -> Option<f64> {
    let (on_first, on_second) = (followed(first)?, followed(second)?);
    let (one, two) = (TorqueOnOutline::new(first.0, &on_first)?, TorqueOnOutline::new(second.0, &on_second)?);
    let both = |angle: f64| Some((one.torque(angle)? + two.torque(angle)?).abs());
    let mut all = one.places(PLACES).chain(two.places(PLACES)).map(both);
    all.try_fold(0.0_f64, |largest, torque| Some(largest.max(torque?)))
}

/// The torque of the shaft of a disc by its law, and as cut; with a second disc on the same shaft that of both as cut. `None` where no
/// force is known.
pub(crate) fn trace(
    body: &dyn Body,
    on_outline: &FollowerOnChain<'_>,
    second: Option<DiscOutline<'_>>,
) -> Option<Trace> {
    force_and_torque(body, 0.0)?;
    let one = TorqueOnOutline::new(body, on_outline)?;
    let second = second.filter(|(second, _)| has_own_torque(*second));
    let on_second = second.and_then(followed);
    let two = match second {
        Some((second, _)) => Some(TorqueOnOutline::new(second, on_second.as_ref()?)?),
        None => None,
    };
    let point = |angle: f64| {
        let [law, cut] = one.torques(angle)?;
        let of_second = two.as_ref().map_or(Some(0.0), |two| two.torque(angle))?;
        Some([angle.to_degrees(), law, cut + of_second])
    };
    let lines = match &two {
        Some(_) => "without (thin), with the compensating cam as cut (bold)",
        None => "by the law (thin), as cut (bold)",
    };
    Some(Trace {
        head: format!("Torque on the shaft, N·m: {lines}"),
        places: "cam angle, deg",
        step: 30.0,
        period: Some(360.0),
        points: one.places(SHOWN).filter_map(point).collect(),
    })
}
