//! Why no base radius keeps the limits of a disc, and a change with which one does: each is tried before it is named.

use super::Disc;
use camgen_kernel::follower::Element;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::profile::size::{self, NoRadius, SizeLimits, SmallestSize};
use camgen_kernel::refusal::Refusal;
use camgen_kernel::text::{KeyChange, Remedy, text};

/// Halvings of a limit that is relaxed until a size keeps it.
const HALVINGS: u32 = 12;
/// Largest pressure angle that is tried, rad.
const STEEPEST: f64 = 1.55;
/// Sizes above the smallest at which a larger bore is tried.
const SIZES: u32 = 8;
/// A tenth of a degree and a hundredth of a ratio or a millimetre: limits are named in these.
const TENTHS: f64 = 10.0;
const HUNDREDTHS: f64 = 100.0;
/// By how much a radius must be above that of the roller, as a share.
const ABOVE: f64 = 1e-6;

impl Disc {
    /// The refusal where no base radius keeps the limits: it names the limit that alone prevents it, and a value with which a size is found.
    pub(super) fn without_radius(&self) -> Refusal {
        let required = self.required();
        let (least, offset) = (self.follower.prime_radii().0.max(super::size::LEAST_PRIME), self.curves().offset());
        let sharpest =
            if let Element::Roller { radius } = self.follower.element() { radius * (1.0 + ABOVE) } else { 0.0 };
        let causes: [&dyn Fn() -> Option<Refusal>; 3] = [
            &|| self.solved(&SizeLimits { least, ..required }).and_then(|smallest| self.without_bore(smallest, offset)),
            &|| self.without_angle(&required),
            &|| self.without_curvature(&required, sharpest, offset),
        ];
        causes.iter().find_map(|cause| cause()).unwrap_or_else(|| {
            let all = SizeLimits { pressure_angles: [f64::INFINITY; 2], convex_radius: sharpest, least };
            let what = if self.solved(&all).is_some() {
                "no base radius keeps the limits of pressure angle, curvature and bore together"
            } else {
                "no base radius keeps the limits: on any cam in reach of the follower the profile folds over itself"
            };
            Refusal::new(what).remedy("give a longer rise, a lower lift or another follower")
        })
    }

    fn solved(&self, required: &SizeLimits) -> Option<SmallestSize> {
        size::smallest(&*self.motion, &*self.follower, required).ok()
    }

    /// The bore alone: a smaller one that leaves the wall.
    fn without_bore(&self, smallest: SmallestSize, offset: f64) -> Option<Refusal> {
        let (cam, limits) = (&self.machine.cam, &self.machine.limits);
        let (bore, required) = (cam.bore_radius?, self.required());
        // The largest size in reach that passes.
        let growth = required.least / smallest.prime_radius;
        let at = |step: u32| smallest.prime_radius * libm::pow(growth, f64::from(step) / f64::from(SIZES));
        let larger = (1..SIZES).rev().find_map(|step| self.solved(&SizeLimits { least: at(step), ..required }));
        let base = larger.unwrap_or(smallest).prime_radius - offset;
        let leaves = |bore: f64| bore + limits.least_wall(Some(bore)) <= base;
        let (mut fits, mut too_large) = (0.0, bore);
        for _ in 0..2 * HALVINGS {
            let middle = 0.5 * (fits + too_large);
            *(if leaves(middle) { &mut fits } else { &mut too_large }) = middle;
        }
        let fits = (TENTHS * MILLIMETRES * fits).floor() / TENTHS;
        let (bore_mm, wall_mm) = (MILLIMETRES * bore, MILLIMETRES * limits.least_wall(Some(bore)));
        let (needed, base_mm) = (MILLIMETRES * (required.least - offset), MILLIMETRES * base);
        let what = format!(
            "{NoRadius}: about a bore of radius {bore_mm} mm with {wall_mm:.3} mm of wall it must be at least {needed:.3} mm, but the \
             follower works only up to about {base_mm:.3} mm"
        );
        let refusal = Refusal::new(what);
        let change = KeyChange::new("cam.bore_radius", format!("{fits} mm"));
        Some(if fits > 0.0 { refusal.remedy(text!("{} would pass", Remedy::new([change]))) } else { refusal })
    }

    /// The pressure angle alone: the least limit that a size keeps.
    fn without_angle(&self, required: &SizeLimits) -> Option<Refusal> {
        let with = |limit: f64| {
            let pressure_angles = required.pressure_angles.map(|own| own.max(limit));
            self.solved(&SizeLimits { pressure_angles, ..*required })
        };
        with(f64::INFINITY)?;
        let mut broken = required.pressure_angles.into_iter().fold(0.0, f64::max);
        let what = format!(
            "{NoRadius}: on every cam that keeps the others the pressure angle exceeds {} deg",
            (TENTHS * broken.to_degrees()).round() / TENTHS
        );
        let refusal = Refusal::new(what);
        if with(STEEPEST).is_none() {
            return Some(refusal.remedy("give a longer rise, a lower lift or another arm"));
        }
        let mut kept = STEEPEST;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (broken + kept);
            *(if with(middle).is_some() { &mut kept } else { &mut broken }) = middle;
        }
        let limit = (TENTHS * kept.to_degrees()).ceil() / TENTHS;
        let key = KeyChange::new("limits.pressure_angle", format!("{limit} deg"));
        let remedy = if self.machine.limits.pressure_angle_return.is_some() {
            let words = format!("{key} and limits.pressure_angle_return as much");
            let of_return = KeyChange::new("limits.pressure_angle_return", key.value.clone());
            Remedy::new([key, of_return]).in_words(words)
        } else {
            Remedy::new([key])
        };
        Some(refusal.remedy(text!("{} would pass; a longer rise lowers the angle", remedy)))
    }

    /// The curvature alone: the largest limit that a size keeps.
    fn without_curvature(&self, required: &SizeLimits, sharpest: f64, offset: f64) -> Option<Refusal> {
        let with = |convex_radius: f64| self.solved(&SizeLimits { convex_radius, ..*required });
        with(sharpest)?;
        let (mut kept, mut broken) = (sharpest, required.convex_radius);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (kept + broken);
            *(if with(middle).is_some() { &mut kept } else { &mut broken }) = middle;
        }
        let limits = &self.machine.limits;
        let by_ratio = offset > 0.0 && limits.min_convex_radius.is_none();
        let key = if by_ratio {
            let ratio = (HUNDREDTHS * kept / offset).floor() / HUNDREDTHS;
            KeyChange::new("limits.min_convex_pitch_radius_over_roller", ratio.to_string())
        } else {
            let radius = (HUNDREDTHS * MILLIMETRES * (kept - offset)).floor() / HUNDREDTHS;
            KeyChange::new("limits.min_convex_radius", format!("{radius} mm"))
        };
        let what = format!("{NoRadius}: the profile is too sharp on every cam in reach of the follower");
        Some(Refusal::new(what).remedy(text!(
            "{} would pass; a smaller roller or a smoother law too, where they bend it less",
            Remedy::new([key])
        )))
    }
}
