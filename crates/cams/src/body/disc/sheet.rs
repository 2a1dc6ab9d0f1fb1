//! What the review sheet of a disc cam shows.

use super::{Disc, shop_views};
use crate::body::figures;
use crate::body::part::{as_turned, point_as_turned};
use crate::body::sheet::{PATH_OVER_RADIUS, axes, bore, lost_motion, overall, pressure_angle, roller, turning};
use crate::body::{Body, Drawn, Figures, Part, conjugate};
use crate::report::sheet::Dimensions;
use crate::report::sheet::{Mark, ShapeGroup, SheetShape, SheetView, TitleFacts, extents_of};
use camgen_kernel::follower::Element;
use camgen_kernel::geometry::contour::{Contour, Edge, Extents, Vertex};
use camgen_kernel::geometry::{Entity, MILLIMETRES, polar};
use camgen_kernel::profile::envelope;
use camgen_kernel::profile::outline::{OutlineError, pitch};
use camgen_kernel::text::Text;
use camgen_kernel::units::LengthUnit;
use nalgebra::Vector2;

/// Half the length at which a flat face is shown, over the base radius.
const FACE_OVER_BASE: f64 = 0.8;
/// Points of a stretch of lost motion.
const LOST_POINTS: u32 = 48;

const NOWHERE: Extents = Extents { least: Vector2::new(0.0, 0.0), largest: Vector2::new(0.0, 0.0) };

/// The view of a disc cam on the review sheet, with the roller of the disc that has the body's worst pressure angle.
///
/// # Errors
/// [`OutlineError`] when the pitch curve cannot be drawn.
pub(super) fn view(disc: &Disc, steepest: &Disc, drawn: &Drawn) -> Result<SheetView, OutlineError> {
    // A flat face and a knife edge have no pitch curve: their curve is the profile, which may be undercut.
    let part = drawn.parts.first();
    let pitch_curve = match disc.roller_radius() {
        Some(radius) => Some(pitch_curve(disc, part, MILLIMETRES * radius)?),
        None => None,
    };
    let units = disc.machine.units();
    let outline = part.map_or(NOWHERE, Part::extents);
    let (prime, base) = (MILLIMETRES * disc.prime_radius(), MILLIMETRES * disc.base_radius());
    let profile = part.map(|part| SheetShape::Entity(Entity::Polyline(part.outline.contour.clone())));
    let holes = part.map_or_else(Vec::new, |part| part.holes().into_iter().map(SheetShape::Entity).collect());
    let group = ShapeGroup::new;
    let crossed = pitch_curve.as_ref().map_or(outline, |curve| curve.extents().with(&outline));
    let mut groups = vec![
        group("profile", "profile", profile.into_iter().collect()).with_legend(),
        group("bore", "bore", holes),
        group("axis", shop_views::zero_of(disc), axes(&crossed)).with_legend(),
        circle(("base-circle", "base circle"), base, units),
    ];
    if let Some(pitch_curve) = pitch_curve {
        groups.push(circle(("prime-circle", "prime circle"), prime, units));
        let curve = vec![SheetShape::Entity(Entity::Polyline(pitch_curve))];
        groups.push(group("pitch-curve", "pitch curve", curve).with_legend());
    }
    groups.extend(part.and_then(shop_views::lead_in));
    groups.extend(lost_motion(lost(disc)));
    let (shapes, angle) = worst_place(steepest);
    groups.push(group("roller", "follower at its worst pressure angle", shapes).with_legend());
    let (arms, arm_marks) = shop_views::arm(disc);
    let (side, side_marks) = shop_views::side_view(disc, part, &extents_of(&groups).with(&outline));
    groups.extend(arms.into_iter().chain(side));
    let zero = disc.duty.as_ref().map_or("θ = 0", |duty| duty.angle_origin());
    let at_zero =
        part.and_then(|part| polar::outermost(&part.outline.contour, &[Vector2::x()]).pop().flatten()).unwrap_or(base);
    let marks = [
        overall(&outline, units),
        bore(&disc.machine, part.and_then(|part| part.balancing.as_ref())),
        turning(&disc.machine, base, at_zero, zero),
        angle,
        farthest(part.map(|part| &part.outline.contour), units).into_iter().collect(),
        arm_marks,
        side_marks,
        part.map_or_else(Vec::new, |part| shop_views::of_profile(disc, &part.outline)),
    ];
    Ok(SheetView {
        groups,
        marks: marks.into_iter().flatten().collect(),
        tables: Vec::new(),
        facts: TitleFacts::of(&disc.machine, part.and_then(|part| part.weight(&disc.machine).mass_kg)),
        notes: rollers_of_pair(disc).into_iter().collect(),
        lost: if disc.least_radius().value <= disc.curves().offset().abs() {
            figures::lost_motion(disc.curves(), &|at| disc.place(at))
        } else {
            Vec::new()
        },
    })
}

/// How a pair sets its rollers, for the main disc.
fn rollers_of_pair(disc: &Disc) -> Option<Text> {
    let (counter, _) = disc.other.as_ref()?;
    conjugate::spacing(disc, &**counter)
}

/// A circle about the shaft with its radius, mm, in the legend.
fn circle((class, name): (&'static str, &str), radius: f64, units: LengthUnit) -> ShapeGroup {
    let shapes = vec![SheetShape::Entity(Entity::Circle(Vector2::zeros(), radius))];
    ShapeGroup::new(class, format!("{name} R {}", units.dimension(radius)), shapes).with_legend()
}

/// Largest distance of an outline from the exact one, mm, at which its parallel is shown: a fifth of a thin pen.
const SHOWN: f64 = 0.05;
/// Least radius of an arc of the pitch curve, mm, that is taken from the outline: within it the roller turns about its centre.
const LEAST_RADIUS: f64 = 1e-3;
/// Largest turn of a joint without a corner, rad.
const SMOOTH: f64 = 1e-6;

/// The follower's curve in the drawing: of an outline of tangent arcs and lines, arcs and lines about the same centres, else
/// fitted anew.
fn pitch_curve(disc: &Disc, part: Option<&Part>, radius: f64) -> Result<Contour, OutlineError> {
    // The flanks of a groove may be farther from the roller's centre than its radius.
    match part
        .filter(|part| part.track.is_none() && part.outline.deviation <= SHOWN)
        .and_then(|part| offset_outline(&part.outline.contour, radius))
    {
        Some(curve) => Ok(curve),
        None => Ok(as_turned(&disc.machine, pitch(disc.curves())?.contour)),
    }
}

/// The parallel so far outside a contour of tangent arcs and lines that has the metal on its left; `None` of any other.
fn offset_outline(contour: &Contour, distance: f64) -> Option<Contour> {
    if contour.tangent_breaks().iter().any(|turn| turn.abs() > SMOOTH) {
        return None;
    }
    let moved = |edge: Edge| {
        let segment = edge.segment()?;
        let left = segment.bulge > 0.0;
        // A line has an infinite radius.
        if !left && segment.radius().abs() < distance + LEAST_RADIUS {
            return None;
        }
        let tangent = segment.start_tangent();
        Some(Vertex::new(segment.start + Vector2::new(tangent.y, -tangent.x) * distance, segment.bulge))
    };
    Some(Contour { vertices: contour.edges().map(moved).collect::<Option<_>>()? })
}

/// The largest radius of the outline.
fn farthest(outline: Option<&Contour>, units: LengthUnit) -> Option<Mark> {
    let points = outline?.edges().map(|edge| edge.start());
    let to = points.max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
    Some(Mark::Radius { centre: Vector2::zeros(), to, text: format!("R {}", units.dimension(to.norm())) })
}

/// Radius of the roller, mm, or half the length at which a flat face is shown.
fn shown_radius(disc: &Disc) -> f64 {
    disc.roller_radius().map_or(FACE_OVER_BASE * MILLIMETRES * disc.base_radius(), |radius| MILLIMETRES * radius)
}

/// The follower where the pressure angle is worst, with its path and the normal of the cam, and the angle between them.
fn worst_place(disc: &Disc) -> (Vec<SheetShape>, Vec<Mark>) {
    let curves = disc.curves();
    let worst = disc.pressure_angle();
    let (piece, angle) = curves.motion.locate(worst.at);
    let contact = curves.contact(piece, angle);
    let turned = |vector| point_as_turned(&disc.machine, vector);
    let (centre, radius) = (turned(contact.curve.point * MILLIMETRES), shown_radius(disc));
    let degrees = disc.place(worst.at).cam_deg.unwrap_or(0.0);
    let text = format!("α = {:.2}° at θ = {degrees:.2}°", worst.value.to_degrees());
    let (drive, along) = (turned(contact.drive), turned(contact.curve.tangent));
    let outward = turned(contact.curve.outward());
    match curves.element() {
        Element::Roller { radius: 0.0 } => {
            let shapes = vec![
                SheetShape::Line(centre, centre + drive * radius),
                SheetShape::Line(centre, centre + outward * radius),
            ];
            (shapes, pressure_angle(centre, drive, outward, radius / (1.0 + PATH_OVER_RADIUS), text))
        }
        Element::Roller { .. } => {
            (roller(centre, drive, outward, radius), pressure_angle(centre, drive, outward, radius, text))
        }
        Element::Face => {
            let shapes = vec![
                SheetShape::Line(centre - along * radius, centre + along * radius),
                SheetShape::Line(centre, centre + drive * radius),
            ];
            let label = Mark::Label { class: "roller", at: centre + drive * radius, towards: drive, text };
            (shapes, vec![label])
        }
    }
}

/// The stretches of the follower's curve on which the follower loses its motion, mm.
fn lost(disc: &Disc) -> Vec<Vec<Vector2<f64>>> {
    let curves = disc.curves();
    if disc.least_radius().value > curves.offset().abs() {
        return Vec::new();
    }
    let losses = envelope::losses(curves).unwrap_or_default();
    let at = |parameter: f64| {
        let (piece, angle) = curves.motion.locate(parameter);
        point_as_turned(&disc.machine, curves.contact(piece, angle).curve.point * MILLIMETRES)
    };
    let stretch = |loss: &envelope::UndercutLoss| {
        let share = |step: u32| f64::from(step) / f64::from(LOST_POINTS);
        (0..=LOST_POINTS).map(|step| at(loss.from + (loss.to - loss.from) * share(step))).collect()
    };
    losses.iter().map(stretch).collect()
}
