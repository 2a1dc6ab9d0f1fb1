//! The torque on a shaft, with the followers where outlines as written put them.

use super::Body;
use crate::geometry::contour::Contour;
use crate::profile::followed::Followed;
use crate::report::trace::Trace;

/// Places of a stretch of an outline at which the largest torque is looked for.
const PLACES: u32 = 8;
/// Places of a stretch at which a torque is shown.
const SHOWN: u32 = 4;

/// How far within a stretch its first and last place lie, as a share of it.
const INSET: f64 = 1e-6;

/// A disc that turns, and its outline, mm.
pub type Cut<'a> = (&'a dyn Body, &'a Contour);

/// The follower of a disc on its outline; `None` of what is no disc.
pub(super) fn followed((body, outline): Cut<'_>) -> Option<Followed<'_>> {
    Some(Followed::on(body.plane()?, outline, body.mirrored()))
}

/// A disc whose follower is on its outline.
struct Turning<'a> {
    body: &'a dyn Body,
    followed: &'a Followed<'a>,
}

impl<'a> Turning<'a> {
    /// `None` where it does not turn.
    fn new(body: &'a dyn Body, followed: &'a Followed<'a>) -> Option<Self> {
        body.plane()?.motion.period()?;
        Some(Self { body, followed })
    }

    /// Torque by the law, and force along the follower's path times the slope that the normal gives where it touches, N·m; `None` where
    /// the force is not known or the follower is not in touch.
    fn torques(&self, angle: f64) -> Option<[f64; 2]> {
        let motion = self.body.plane()?.motion;
        let at = motion.locate(angle);
        let lift = motion.jet(at.0, at.1);
        let [force, law] = self.body.force_and_torque_of(at, lift)?;
        Some([law, force * self.followed.beside_law(angle, Some((at, lift)))?.ds])
    }

    fn torque(&self, angle: f64) -> Option<f64> {
        self.torques(angle).map(|[_, cut]| cut)
    }

    /// Places of its stretches, from a hair behind the one end to a hair before the other.
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
pub fn left(first: Cut<'_>, second: Cut<'_>) -> Option<f64> {
    let (on_first, on_second) = (followed(first)?, followed(second)?);
    let (one, two) = (Turning::new(first.0, &on_first)?, Turning::new(second.0, &on_second)?);
    let both = |angle: f64| Some((one.torque(angle)? + two.torque(angle)?).abs());
    let mut all = one.places(PLACES).chain(two.places(PLACES)).map(both);
    all.try_fold(0.0_f64, |largest, torque| Some(largest.max(torque?)))
}

/// The torque of the shaft of a disc by its law, and as cut; with a second disc on the same shaft that of both as cut. `None` where no
/// force is known.
pub(super) fn trace(body: &dyn Body, on_outline: &Followed<'_>, second: Option<Cut<'_>>) -> Option<Trace> {
    body.force_and_torque(0.0)?;
    let one = Turning::new(body, on_outline)?;
    let on_second = second.and_then(followed);
    let two = match second {
        Some((second, _)) => Some(Turning::new(second, on_second.as_ref()?)?),
        None => None,
    };
    let point = |angle: f64| {
        let [law, cut] = one.torques(angle)?;
        let beside = two.as_ref().map_or(Some(0.0), |two| two.torque(angle))?;
        Some([angle.to_degrees(), law, cut + beside])
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
