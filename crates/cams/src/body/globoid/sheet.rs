//! What the review sheet of a globoid shows: the section of its blank with the turret, and a table of places of both flanks.

use super::mechanism::outline;
use super::{End, FlankCurve, Globoid};
use crate::body::swept::FlankSide;
use crate::body::swept::sheet::{bore_mark, dimension};
use crate::report::sheet::{Dimensions, Mark, PlaceTable, ShapeGroup, SheetShape, SheetView, rounded};
use camgen_kernel::geometry::{Entity, MILLIMETRES};
use nalgebra::Vector2;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Rows of the finest table of places.
const ROWS: u32 = 72;
/// What stands for a place beyond the ends.
const NOWHERE: &str = "–";

/// Adds what the review sheet shows.
pub(super) fn fill(globoid: &Globoid, view: &mut SheetView) {
    view.groups = section(globoid);
    view.tables = tables(globoid);
    let sense = if globoid.groove.is_clockwise() { "clockwise" } else { "counter-clockwise" };
    view.notes.push(
        format!(
            "Section through the axes of cam and turret. The cam turns {sense} seen from above; its rollers move up."
        )
        .into(),
    );
    view.notes.push(
        format!(
            "{} rollers; a turn of the cam moves the turret on by {}°.",
            globoid.turret.rollers,
            rounded(globoid.turret.index().to_degrees())
        )
        .into(),
    );
    marks(globoid, view);
}

/// The blank, its floor, the bore, the axes, and the rollers as they stand at the start.
fn section(globoid: &Globoid) -> Vec<ShapeGroup> {
    let [distance, floor] = [globoid.turret.distance, globoid.floor].map(|length| MILLIMETRES * length);
    let height = MILLIMETRES * globoid.rim(globoid.floor).1;
    let at = Vector2::new;
    let blank = [1.0, -1.0].map(|side| SheetShape::Path(outline(globoid, side))).to_vec();
    let (sin, cos) = libm::sincos(globoid.end_angle);
    let bottom = |side: f64| {
        let end = |way: f64| at(side * (distance - floor * cos), way * floor * sin);
        // Hollow, as the turret sees it.
        let bulge = -side * libm::tan(0.5 * globoid.end_angle);
        SheetShape::Arc(end(-1.0), end(1.0), bulge)
    };
    let mut rollers = Vec::new();
    for number in globoid.passing_rollers() {
        let angle = globoid.line_at(0.0, f64::from(number)).angle[0];
        if angle.abs() > globoid.end_angle {
            continue;
        }
        let (sin, cos) = libm::sincos(angle);
        let place = |along: f64, across: f64| {
            let (along, across) = (MILLIMETRES * along, MILLIMETRES * across);
            at(distance - along * cos + across * sin, along * sin + across * cos)
        };
        let [inner, outer, radius] = [globoid.outside, globoid.reached, globoid.groove.roller];
        let corners = [(inner, -radius), (outer, -radius), (outer, radius), (inner, radius), (inner, -radius)];
        rollers.push(SheetShape::Path(corners.map(|(a, b)| place(a, b)).to_vec()));
    }
    let bore = globoid.groove.machine.cam.bore_radius.map(|radius| MILLIMETRES * radius);
    let edges = bore.iter().flat_map(|radius| [*radius, -radius]);
    let hidden: Vec<SheetShape> = edges.map(|x| SheetShape::Line(at(x, -height), at(x, height))).collect();
    let beyond = 0.1 * distance;
    let turret = vec![SheetShape::Entity(Entity::Circle(at(distance, 0.0), 0.04 * distance))];
    let axes = vec![
        SheetShape::Line(at(0.0, -height - beyond), at(0.0, height + beyond)),
        SheetShape::Line(at(-beyond, 0.0), at(distance + beyond, 0.0)),
    ];
    vec![
        ShapeGroup { id: "blank".into(), ..ShapeGroup::new("side", "turned blank", blank).with_legend() },
        ShapeGroup {
            id: "floor".into(),
            ..ShapeGroup::new("hidden", "floor of the grooves, bore", vec![bottom(1.0), bottom(-1.0)])
        },
        ShapeGroup { id: "bore".into(), ..ShapeGroup::new("hidden", "hidden edges", hidden) },
        ShapeGroup::new("roller", "rollers at θ = 0", rollers).with_legend(),
        ShapeGroup { id: "turret".into(), ..ShapeGroup::new("pitch-curve", "axis of the turret", turret) },
        ShapeGroup::new("axis", "axes", axes).with_legend(),
    ]
}

/// The dimensions of the blank.
fn marks(globoid: &Globoid, view: &mut SheetView) {
    let units = globoid.groove.machine.units();
    let at = Vector2::new;
    let [distance, outside, floor] =
        [globoid.turret.distance, globoid.outside, globoid.floor].map(|length| MILLIMETRES * length);
    let (outer, outer_z) = globoid.rim(globoid.outside);
    let (outer, outer_z) = (MILLIMETRES * outer, MILLIMETRES * outer_z);
    let (rim, height) = globoid.rim(globoid.floor);
    let (rim, height) = (MILLIMETRES * rim, MILLIMETRES * height);
    let waist = distance - outside;
    let (up, down, left) = (at(0.0, 1.0), at(0.0, -1.0), at(-1.0, 0.0));
    view.marks.push(dimension(
        at(-outer, outer_z),
        at(outer, outer_z),
        up,
        format!("Ø{}", units.dimension(2.0 * outer)),
    ));
    view.marks.push(dimension(at(-rim, -height), at(rim, -height), down, format!("Ø{}", units.dimension(2.0 * rim))));
    view.marks.push(dimension(at(-outer, -height), at(-outer, height), left, units.dimension(2.0 * height)));
    view.marks.push(dimension(at(outer, -outer_z), at(outer, outer_z), at(1.0, 0.0), units.dimension(2.0 * outer_z)));
    view.marks.push(dimension(at(0.0, -height), at(distance, -height), down, units.dimension(distance)));
    view.marks.extend(bore_mark(&globoid.groove.machine, at(0.0, height)));
    let hollow = -0.5 * globoid.end_angle;
    let (sin, cos) = libm::sincos(hollow);
    view.marks.push(Mark::Label {
        class: "dimension",
        at: at(distance - outside * cos, outside * sin),
        towards: at(0.9, -0.4),
        text: format!("R{} about the turret, waist Ø{}", units.dimension(outside), units.dimension(2.0 * waist)),
    });
    let width = MILLIMETRES * globoid.groove.width();
    view.marks.push(Mark::Label {
        class: "dimension",
        at: at(-(distance - floor), 0.0),
        towards: at(-0.7, 0.7),
        text: format!("groove {} wide, floor R{} about the turret", units.dimension(width), units.dimension(floor)),
    });
}

/// Angle, radius and height of both flanks on the outside, from where the first groove enters to where it leaves; between the first and the last row of a rest
/// there are none.
pub(super) fn tables(globoid: &Globoid) -> Vec<PlaceTable> {
    let [Some(from), Some(to)] = [(FlankSide::Upper, End::Bottom), (FlankSide::Lower, End::Top)]
        .map(|(flank, end)| globoid.passes(FlankCurve { flank, roller: 0.0, from_turret: globoid.outside }, end))
    else {
        return Vec::new();
    };
    let units = globoid.groove.machine.units();
    // Whole steps of five degrees, as many as the groove is long.
    let step = TAU / f64::from(ROWS);
    let (first, last) = ((from / step).floor(), (to / step).ceil());
    let mut rows = Vec::new();
    let mut i = first;
    while i <= last {
        let angle = i * step;
        let mut cells = vec![rounded(angle.to_degrees())];
        for flank in FlankSide::BOTH {
            let found = globoid.edge(FlankCurve { flank, roller: 0.0, from_turret: globoid.outside }, angle);
            let inside = found.filter(|found| found.about_turret(globoid.turret.distance).abs() <= globoid.end_angle);
            cells.extend(match inside {
                Some(found) => [
                    format!("{:.3}", globoid.groove.sense() * (angle + found.ahead()).to_degrees()),
                    units.cell(MILLIMETRES * found.radius()),
                    units.cell(MILLIMETRES * found.place.z),
                ],
                None => [NOWHERE; 3].map(str::to_owned),
            });
        }
        if cells.iter().skip(1).any(|cell| cell != NOWHERE) {
            rows.push(cells);
        }
        i += 1.0;
    }
    let rows = without_rests(&rows);
    let rows = PlaceTable::regular_rows(rows);
    let group = ["ψ upper", "r upper", "z upper", "ψ lower", "r lower", "z lower"];
    let heads: Vec<String> = ["θ °"].into_iter().chain(group).map(str::to_owned).collect();
    let outside = units.dimension(MILLIMETRES * globoid.outside);
    let of = |every: usize| PlaceTable {
        title: format!(
            "Upper and lower flank of groove 1 at R {outside} about the turret (TED): polar angle ψ, °, radius r and height z, {}",
            units.symbol()
        ),
        remarks: Vec::new(),
        heads: heads.clone(),
        rows: Arc::clone(&rows),
        every,
    };
    [1, 2, 3, 6, 12].map(of).to_vec()
}

/// The rows without those between the first and the last of a rest, in which radius and height stay.
fn without_rests(rows: &[Vec<String>]) -> Vec<Vec<String>> {
    let place = |row: &Vec<String>| [2, 3, 5, 6].map(|cell| row.get(cell).cloned());
    let rests = |index: usize| {
        let same = |other: Option<usize>| {
            let pair = other.and_then(|other| Some((rows.get(other)?, rows.get(index)?)));
            pair.is_some_and(|(one, other)| place(one) == place(other))
        };
        same(index.checked_sub(1)) && same(Some(index + 1))
    };
    let kept: Vec<usize> = (0..rows.len()).filter(|index| !rests(*index)).collect();
    kept.into_iter().filter_map(|index| rows.get(index).cloned()).collect()
}
