//! The lift table of a gauge follower, compared with where the follower rests on the outline in the cut file.
//!
//! The rows are those that are read back from the bytes. On an arc the follower rests where the line from its centre through that of the arc meets
//! it, on a line where it touches it square, or on a vertex: each in closed form. Without a cut file the exact profile is followed.

use super::super::head::{self, lines_after};
use super::super::inspection::angle_of_place;
use super::plan::{rests_on, table, unfit};
use super::read::GaugeRows;
use super::write::statements;
use crate::body::{Body, Gauge, Request};
use crate::check::{Check, CheckExplanation, CheckScope};
use crate::machine::Rotation;
use crate::report::{Bound, Finding, Verdict, shown};
use crate::verify::{Evidence, place};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::contour::{Contour, Edge, Segment};
use camgen_kernel::text::{Length, Text, text};
use nalgebra::Vector2;

pub(super) const CHECK: Check = Check {
    name: "gauge",
    on: CheckScope::ToolFile,
    unit: "mm",
    about: "The largest difference between the rows of --format gauge, as they are in the file, and where the gauge follower rests on the outline in \
            the cut file, or, of a table that is checked, on the exact profile: across the profile, as a tolerance is.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "max |d(table) − d(outline)| cos α over the rows, α the pressure angle of the gauge follower",
        usual: "the tolerance",
        change: "write the table anew; where camgen itself refuses what it wrote, please report this",
    },
};

/// Places of a cubic edge on which a follower may rest.
const PLACES: u32 = 256;
/// Angles that differ by less are equal, degrees, and so are lifts, mm.
const SAME: f64 = 1e-6;

/// The finding on a table as it was read.
pub(super) fn judge(evidence: &Evidence<'_>, table: &Result<GaugeRows, String>) -> Finding {
    let limit = evidence.tolerance_mm;
    match table.as_ref().map_err(Clone::clone).and_then(|rows| judged(evidence, rows)) {
        Err(why) => Finding { note: Some(why.into()), ..CHECK.found(f64::INFINITY, Some(limit), Verdict::Fail) },
        Ok((value, at, words)) => {
            let found = CHECK.found(value, Some(limit), Verdict::of(value <= limit));
            Finding { note: Some(words), place: place(evidence.body, at), ..found }
        }
    }
}

/// The largest difference, where, and what was compared.
fn judged(evidence: &Evidence<'_>, read: &GaugeRows) -> Result<(f64, Vector2<f64>, Text), String> {
    let gauge = read.radius.map_or(Gauge::Flat, |radius| Gauge::Round(radius / MILLIMETRES));
    let lowest = read.rows.iter().map(|row| row[1]).fold(f64::INFINITY, f64::min);
    let exact = match evidence.outlines.first() {
        Some(_) => None,
        None => {
            Some(table(evidence.body, &Request { gauge: Some(gauge), ..Request::within(1e-6) }).ok_or_else(|| {
                let why = unfit(evidence.body).unwrap_or("the follower rests nowhere on it");
                format!("no gauge follower runs on this cam: {why}")
            })?)
        }
    };
    let flipped = evidence.body.machine().cam.rotation == Rotation::CounterClockwise;
    let mut worst = (0.0, Vector2::zeros());
    for (index, [cam_deg, distance, lift]) in read.rows.iter().enumerate() {
        let due = angle_of_place(index, read.rows.len());
        if (cam_deg - due).abs() > SAME {
            return Err(format!("row {} is at {cam_deg} deg and must be at {} deg", index + 1, shown(due)));
        }
        if (distance - lowest - lift).abs() > SAME {
            return Err(format!("row {}: the lift is not the distance less the least one", index + 1));
        }
        let turned = if flipped { -cam_deg } else { *cam_deg }.to_radians();
        let direction = Vector2::new(libm::cos(turned), libm::sin(turned));
        let (off, point) = match (evidence.outlines.first(), &exact) {
            (Some(outline), _) => {
                let (rests, point) =
                    resting(&outline.contour, gauge, direction).ok_or("it rests nowhere on the outline")?;
                ((distance - rests).abs() * steepness(gauge, point, direction, rests), point)
            }
            (None, Some(exact)) if exact.rows.len() == read.rows.len() => {
                let rests = exact.rows.get(index).map_or(f64::NAN, |row| row[1]);
                ((distance - rests).abs(), direction * rests)
            }
            _ => return Err(format!("it has {} rows, and a turn has 360", read.rows.len())),
        };
        if !(off <= worst.0) {
            worst = (off, point);
        }
    }
    let follower =
        read.radius.map_or(Text::from("a flat face"), |radius| text!("a ball or roller Ø{}", Length::mm(2.0 * radius)));
    let on = if exact.is_some() { "the exact profile" } else { "the outline as read from the cut file" };
    Ok((worst.0, worst.1, text!("{} rows of {} on {}", read.rows.len(), follower, on)))
}

/// The contradiction between the head of a gauge follower's lift table and the cam, if any.
pub(super) fn contradiction(body: &dyn Body, text: &str, read: &GaugeRows) -> Option<String> {
    let follower = read.radius.map_or(Gauge::Flat, |radius| Gauge::Round(radius / MILLIMETRES));
    head::contradiction(&lines_after(text, "#"), &statements(body, follower, read.units))
}

/// The cosine of the pressure angle of a follower that rests on a point.
fn steepness(gauge: Gauge, point: Vector2<f64>, direction: Vector2<f64>, rests: f64) -> f64 {
    match gauge {
        Gauge::Flat => 1.0,
        Gauge::Round(radius) => ((direction * rests - point).dot(&direction) / (MILLIMETRES * radius)).clamp(0.0, 1.0),
    }
}

/// Where a follower in a direction rests on an outline: the distance from the axis, and the point.
fn resting(outline: &Contour, gauge: Gauge, direction: Vector2<f64>) -> Option<(f64, Vector2<f64>)> {
    let mut best: Option<(f64, Vector2<f64>)> = None;
    let mut rest = |point: Vector2<f64>| {
        if let Some(distance) = rests_on(gauge, point, direction)
            && best.is_none_or(|(other, _)| distance > other)
        {
            best = Some((distance, point));
        }
    };
    for edge in outline.edges() {
        rest(edge.start());
        match edge {
            Edge::Segment(segment) if segment.bulge == 0.0 => {
                on_line(&segment, gauge, direction).into_iter().for_each(&mut rest);
            }
            Edge::Segment(segment) => on_arc(&segment, gauge, direction).into_iter().for_each(&mut rest),
            Edge::Cubic(cubic) => {
                (1..PLACES).for_each(|step| rest(cubic.point_and_tangent(f64::from(step) / f64::from(PLACES)).0));
            }
        }
    }
    best
}

/// Points of a line on which a follower may rest within it.
fn on_line(line: &Segment, gauge: Gauge, direction: Vector2<f64>) -> Vec<Vector2<f64>> {
    let Gauge::Round(radius) = gauge else { return Vec::new() };
    let (radius, chord) = (MILLIMETRES * radius, line.end - line.start);
    let along = chord.normalize();
    let normals = [Vector2::new(-along.y, along.x), Vector2::new(along.y, -along.x)];
    let touches = |normal: Vector2<f64>| {
        direction * ((line.start.dot(&normal) + radius) / direction.dot(&normal)) - normal * radius
    };
    let within = |point: &Vector2<f64>| (0.0..=chord.norm()).contains(&(point - line.start).dot(&along));
    normals.into_iter().map(touches).filter(within).collect()
}

/// Points of an arc on which a follower may rest within it.
fn on_arc(arc: &Segment, gauge: Gauge, direction: Vector2<f64>) -> Vec<Vector2<f64>> {
    let (centre, size) = (arc.centre(), arc.radius().abs());
    let chord = arc.end - arc.start;
    // An arc that turns left lies on the right of its chord.
    let within = |point: &Vector2<f64>| chord.perp(&(point - arc.start)) * arc.bulge <= 0.0;
    let towards: Vec<Vector2<f64>> = match gauge {
        Gauge::Flat => vec![direction],
        Gauge::Round(radius) => {
            let (along, across) = (centre.dot(&direction), direction.perp(&centre));
            let distances = [size + MILLIMETRES * radius, size - MILLIMETRES * radius].into_iter().flat_map(|reach| {
                let root = (reach * reach - across * across).sqrt();
                [along + root, along - root]
            });
            distances.map(|distance| (direction * distance - centre).normalize()).collect()
        }
    };
    let both = towards.iter().flat_map(|away| [centre + away * size, centre - away * size]);
    both.filter(|point| point.iter().all(|value| value.is_finite())).filter(within).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// An eccentric circle: every follower has a lift in closed form.
    #[test]
    fn followers_rest_on_an_eccentric_circle_where_the_closed_form_has_them() {
        let (eccentric, size) = (Vector2::new(3.0, 4.0), 20.0);
        let outline = Contour::circle(eccentric, size);
        for step in 0..36 {
            let angle = TAU * f64::from(step) / 36.0;
            let direction = Vector2::new(angle.cos(), angle.sin());
            let (along, across) = (eccentric.dot(&direction), direction.perp(&eccentric));
            for radius in [0.5, 3.0, 40.0] {
                let due = along + ((size + radius) * (size + radius) - across * across).sqrt();
                let found = resting(&outline, Gauge::Round(radius * 1e-3), direction).expect("rests").0;
                assert!((found - due).abs() < 1e-12, "{angle} {radius}: {found} {due}");
            }
            let flat = resting(&outline, Gauge::Flat, direction).expect("rests").0;
            assert!((flat - along - size).abs() < 1e-12);
        }
    }

    /// In a hollow a large roller rests on both of its ends, a small one on its ground.
    #[test]
    fn a_roller_that_is_too_large_for_a_hollow_rests_on_its_ends() {
        let vertex =
            |x: f64, y: f64, bulge: f64| camgen_kernel::geometry::contour::Vertex::new(Vector2::new(x, y), bulge);
        // A square of 40 mm whose right side has a quarter of a circle cut out of it, 5 mm deep at its chord of 20 mm.
        let deep = 0.5;
        let outline = Contour {
            vertices: vec![
                vertex(20.0, -10.0, -deep),
                vertex(20.0, 10.0, 0.0),
                vertex(20.0, 20.0, 0.0),
                vertex(-20.0, 20.0, 0.0),
                vertex(-20.0, -20.0, 0.0),
                vertex(20.0, -20.0, 0.0),
            ],
        };
        let hollow = Segment { start: Vector2::new(20.0, -10.0), end: Vector2::new(20.0, 10.0), bulge: -deep };
        let ground = hollow.middle().x;
        let rests = |radius: f64| resting(&outline, Gauge::Round(radius * 1e-3), Vector2::x()).expect("rests").0;
        assert!((rests(2.0) - ground - 2.0).abs() < 1e-12, "{} {ground}", rests(2.0));
        let large = hollow.radius().abs() * 2.0;
        assert!((rests(large) - 20.0 - (large * large - 100.0).sqrt()).abs() < 1e-12);
    }
}
