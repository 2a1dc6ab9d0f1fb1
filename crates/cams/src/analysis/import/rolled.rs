//! The lift of a follower on an outline: rolled on its arcs and lines, exactly, with the first contact from outside.
//!
//! At a cam angle the follower comes down along its path until it touches. As the distance of a point from the outline changes by no more than the
//! point moves, a step by the gap never goes through it (sphere tracing); near the outline a step of Newton's method follows.

use super::positions::Positions;
use camgen_kernel::follower::{Element, Follower};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::geometry::edge_tree::{EdgeTree, NearestCache};
use camgen_kernel::motion::{Jet, Quantity};
use camgen_kernel::refusal::Refusal;
use std::f64::consts::{PI, TAU};

/// Cam angles at which the lift is found: every quarter of a degree.
const PLACES: u32 = 1440;
/// Most steps down, a gap that is none, mm, and steps of a face on an arm.
const STEPS: usize = 400;
const TOUCHING: f64 = 1e-10;
const FACE_STEPS: usize = 60;
/// Least rate at which the gap closes, over the travel.
const LEAST_COSINE: f64 = 0.02;
/// Step from which on a lift is looked for that is free of the outline, m or rad, and its growth.
const FIRST_UP: f64 = 1e-3;
const GROWS: f64 = 1.3;

/// A follower near the size of a cam: its lift counts from any prime radius.
pub(super) fn sized(follower: &dyn Follower, least_radius: f64) -> Result<Box<dyn Follower>, Refusal> {
    let (least, most) = follower.prime_radii();
    let wanted = least_radius + follower.element().offset();
    let inside = if most.is_finite() {
        wanted.clamp(least + 1e-3 * (most - least), most - 1e-3 * (most - least))
    } else {
        wanted.max(1.001 * least)
    };
    follower.sized(inside).ok_or_else(|| {
        Refusal::new(format!(
            "the follower does not reach a cam whose smallest radius is {:.4} mm",
            MILLIMETRES * least_radius
        ))
        .remedy("give the dimensions of the follower that ran on it")
    })
}

/// The lifts all round an outline (mm, as it lies in its file), for a cam that turns clockwise.
pub(super) fn on_outline(contour: &Contour, follower: &dyn Follower) -> Result<Positions, Refusal> {
    let tree = EdgeTree::new(contour);
    let origin = tree.nearest(nalgebra::Vector2::zeros()).filter(|nearest| nearest.left > 0.0);
    if origin.is_none() {
        let what = "the shaft, at (0, 0), does not lie within the outline";
        return Err(Refusal::new(what).remedy("move the drawing so that its origin is the shaft"));
    }
    let farthest = tree.edges().iter().map(|edge| edge.start().norm().max(edge.middle().norm())).fold(0.0, f64::max);
    let contact = OutlineContact { tree: &tree, follower, farthest };
    let mut cache = NearestCache::default();
    let (mut angles, mut values) = (Vec::new(), Vec::new());
    let mut last = None;
    for place in 0..PLACES {
        let angle = TAU * f64::from(place) / f64::from(PLACES);
        let lift = contact.lift(angle, last, &mut cache).ok_or_else(|| {
            Refusal::new("the follower does not touch the outline")
                .at(format!("a cam angle of {:.2} deg", angle.to_degrees()))
                .remedy("give the dimensions of the follower that ran on it, with its pivot and side")
        })?;
        last = Some(lift);
        angles.push(angle);
        values.push(lift);
    }
    let rows = (0..values.len()).collect();
    Ok(Positions { quantity: follower.quantity(), fill: TAU, angles, values, by_shift: Vec::new(), rows })
}

struct OutlineContact<'a> {
    tree: &'a EdgeTree,
    follower: &'a dyn Follower,
    /// Farthest place of the outline from the shaft, mm.
    farthest: f64,
}

impl OutlineContact<'_> {
    /// The lift at which the follower touches, m or rad, from one that is known nearby.
    fn lift(&self, angle: f64, near: Option<f64>, cache: &mut NearestCache) -> Option<f64> {
        match self.follower.element() {
            Element::Roller { .. } => self.roller(angle, near, cache),
            Element::Face => self.face(angle, near),
        }
    }

    /// The gap (mm) under a roller at a lift, by which it closes per unit of lift, and the largest such rate.
    fn gap(&self, (angle, turned): (f64, (f64, f64)), lift: f64, cache: &mut NearestCache) -> Option<(f64, f64, f64)> {
        let jet = Jet { s: lift, ..Jet::default() };
        let (point, drive) = self.follower.point_turned(angle, turned.0, turned.1, &jet);
        let (centre, radius) = (MILLIMETRES * point, MILLIMETRES * self.follower.element().offset());
        let nearest = self.tree.nearest_with_cache(centre, cache)?;
        let away = centre - nearest.foot;
        let outward = nalgebra::Vector2::new(nearest.tangent.y, -nearest.tangent.x);
        let normal = if away.norm() > 1e-9 && nearest.left < 0.0 { away.normalize() } else { outward };
        let most = MILLIMETRES * self.follower.leverage(&jet);
        Some((-nearest.left - radius, most * normal.dot(&drive), most))
    }

    fn roller(&self, angle: f64, near: Option<f64>, cache: &mut NearestCache) -> Option<f64> {
        let turned = libm::sincos(angle);
        let place = (angle, turned);
        // From a lift that is free of the outline, all the way out where none is known.
        let (_, most) = self.follower.reach();
        let (mut lift, mut step) = (near.unwrap_or(0.0), FIRST_UP);
        loop {
            let jet = Jet { s: lift, ..Jet::default() };
            let out = MILLIMETRES * self.follower.point_turned(angle, turned.0, turned.1, &jet).0.norm();
            let clear = out > self.farthest + MILLIMETRES * self.follower.element().offset();
            if clear || lift >= most {
                break;
            }
            (lift, step) = ((lift + step).min(most), GROWS * step);
        }
        for _ in 0..STEPS {
            let (gap, rate, most) = self.gap(place, lift, cache)?;
            if gap.abs() <= TOUCHING {
                return Some(lift);
            }
            // Newton's step goes through the outline only where it is curved: a negative gap then comes back.
            let newton = rate > 0.3 * most && gap.abs() < 0.2;
            lift -= if newton || (gap < 0.0 && rate > LEAST_COSINE * most) { gap / rate } else { gap.abs() / most };
            if !lift.is_finite() || lift < self.follower.reach().0 - PI {
                return None;
            }
        }
        None
    }

    /// A face touches where the outline reaches farthest along its normal.
    fn face(&self, angle: f64, near: Option<f64>) -> Option<f64> {
        let mut lift = near.unwrap_or(0.0);
        for _ in 0..FACE_STEPS {
            let jet = Jet { s: lift, ..Jet::default() };
            let curve = self.follower.touch(angle, &jet).curve;
            let normal = curve.outward();
            let gap = MILLIMETRES * curve.point.dot(&normal) - self.tree.farthest(normal)?;
            if gap.abs() <= TOUCHING {
                return Some(lift);
            }
            // The support of the outline changes with the normal of a face that swings: by its place along the face.
            let rate = MILLIMETRES * self.follower.on_face(&jet)?.along_normal;
            let change = 1e-7;
            let turned = Jet { s: lift + change, ..Jet::default() };
            let slope = if self.follower.quantity() == Quantity::Angle {
                let moved = self.follower.touch(angle, &turned).curve;
                let normal = moved.outward();
                ((MILLIMETRES * moved.point.dot(&normal) - self.tree.farthest(normal)?) - gap) / change
            } else {
                rate
            };
            lift -= gap / if slope > LEAST_COSINE * rate.abs() { slope } else { rate };
            let (least, most) = self.follower.reach();
            if !(least..=most).contains(&lift) {
                return None;
            }
        }
        None
    }
}

/// The base radius (m) of a cam on which a follower is at its lowest lift.
pub(super) fn base_radius(follower: &dyn Follower, lowest: f64) -> f64 {
    let curve = follower.touch(0.0, &Jet { s: lowest, ..Jet::default() }).curve;
    match follower.element() {
        Element::Roller { radius } => curve.point.norm() - radius,
        Element::Face => curve.point.dot(&curve.outward()),
    }
}
