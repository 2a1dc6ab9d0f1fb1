//! The press behind a cam as it moves: bottom, air, piston, bed and crank. Only one cylinder of the pair is shown.

use super::{Cover, range};
use crate::buffer::Cylinder;
use crate::buffer::crank_law::CrankLaw;
use crate::geometry::MILLIMETRES;
use crate::report::mechanism::{Rigid, Track, circle, rectangle};
use nalgebra::Vector2;

/// Pascals in a bar.
const BAR: f64 = 1e5;

/// Sizes of a cylinder and its bed, mm and Pa.
#[derive(Debug, Clone, Copy)]
pub(in crate::body) struct Buffer {
    stroke: f64,
    lead: f64,
    column: f64,
    bore: f64,
    ambient: f64,
    /// A crank in a slot of the bed moves it.
    yoke: bool,
}

impl Buffer {
    /// Of a cylinder under a law.
    pub(in crate::body) fn new(cylinder: &Cylinder, law: &CrankLaw) -> Self {
        Self {
            stroke: MILLIMETRES * law.stroke(),
            lead: MILLIMETRES * law.lead(),
            column: MILLIMETRES * law.column(),
            bore: MILLIMETRES * cylinder.bore(),
            ambient: cylinder.ambient_pressure,
            yoke: matches!(law, CrankLaw::Yoke(_)),
        }
    }

    /// Length of the air at the start of the compression, mm.
    pub(in crate::body) fn column(&self) -> f64 {
        self.column
    }

    /// The crank radius, mm.
    pub(in crate::body) fn stroke(&self) -> f64 {
        self.stroke
    }

    /// The bore, mm.
    pub(in crate::body) fn bore(&self) -> f64 {
        self.bore
    }

    /// Length of piston and rod in front of the bed, mm.
    pub(in crate::body) fn rod(&self) -> f64 {
        self.piston() + 1.08 * self.stroke + self.lead
    }

    fn piston(&self) -> f64 {
        0.05 * self.bore + 0.02 * self.stroke
    }
}

/// The press at a sample.
#[derive(Debug, Clone, Copy)]
pub(in crate::body) struct Stand {
    /// Crank angle, rad, 0 at the start of a reversal, growing over all turns.
    pub(in crate::body) crank: f64,
    /// How far the bed has run into the buffer, in strokes; negative before and after the reversal.
    pub(in crate::body) overrun: f64,
    /// Δx of the bottom, m.
    pub(in crate::body) bottom: f64,
    /// p/p0 in the cylinder.
    pub(in crate::body) ratio: f64,
}

/// The buffer with its bottom at a place (mm) where Δx is 0: cylinder, air, bottom, bed with piston. The bed has a slot for the
/// pin of the crank where `crank` is set.
pub(in crate::body) fn buffer(
    buffer: &Buffer,
    stands: &[Stand],
    place: Vector2<f64>,
    body: (f64, f64),
    cover: &mut Cover,
) -> Vec<Rigid> {
    let half = 0.5 * buffer.bore;
    let thick = 0.04 * buffer.bore + 0.02 * buffer.stroke;
    let bottoms: Vec<f64> = stands.iter().map(|stand| place.x + MILLIMETRES * stand.bottom).collect();
    let open = place.x + buffer.column - buffer.lead;
    let pistons: Vec<f64> = stands.iter().map(|stand| open - buffer.stroke * stand.overrun).collect();
    let lengths: Vec<f64> = bottoms.iter().zip(&pistons).map(|(bottom, piston)| piston - bottom).collect();
    let pressures: Vec<f64> = stands.iter().map(|stand| stand.ratio * buffer.ambient / BAR).collect();
    let (nearest, _) = range(bottoms.iter().copied());
    let end = place.x + buffer.column;
    let wall = 0.025 * buffer.bore;
    let barrel = [-1.0, 1.0].map(|side| {
        let (inner, outer) = (place.y + side * half, place.y + side * (half + wall));
        rectangle((nearest - thick, end), (inner, outer))
    });
    cover.add((nearest - thick, end), (place.y - half - 5.0 * wall, place.y + half + 2.5 * wall));
    let below = place.y - half - 1.6 * wall;
    let y = Track::Still(place.y);
    let air = Rigid {
        stretch: lengths.into(),
        pressure_bar: Some(pressures.into()),
        ..Rigid::new("air", vec![rectangle((0.0, 1.0), (-half, half))]).at(bottoms.clone(), y.clone())
    };
    let bottom = Rigid::new("bottom", vec![rectangle((-thick, 0.0), (-half, half))]);
    let rod = 0.05 * buffer.bore;
    let head = rectangle((0.0, buffer.piston()), (-0.985 * half, 0.985 * half));
    let shapes = vec![
        head,
        rectangle((buffer.piston(), buffer.rod()), (-rod, rod)),
        rectangle((buffer.rod(), buffer.rod() + body.1), (-half, half)),
    ];
    let (name_x, name_y) = (buffer.rod() + 0.5 * body.1, below - place.y);
    vec![
        air,
        Rigid::new("cylinder", barrel.to_vec()).named("air cylinder", place.x + 0.5 * buffer.column, below),
        bottom.at(bottoms, y.clone()).named("bottom", -0.5 * thick, name_y),
        Rigid::new("bed", shapes).at(pistons, y).named("bed", name_x, name_y),
    ]
}

/// What the follower of a turning cam drives, mm.
#[derive(Debug)]
pub(super) struct Driven {
    /// Centres of the roller.
    pub(super) rollers: Vec<Vector2<f64>>,
    /// Its radius.
    pub(super) radius: f64,
    /// Roller travel per bottom travel.
    pub(super) lever: f64,
}

/// The press behind the roller of a cam that reaches so far (mm): rod or lever, cylinder, bed and crank.
pub(super) fn behind(of: &Buffer, stands: &[Stand], driven: &Driven, reach: f64, cover: &mut Cover) -> Vec<Rigid> {
    let (low, high) = range(driven.rollers.iter().map(|p| p.x));
    let line_y = driven.rollers.first().map_or(0.0, |p| p.y);
    let clear = (reach - low).max(0.0) + 1.6 * driven.radius;
    let half = 0.22 * driven.radius;
    let rollers: Vec<f64> = driven.rollers.iter().map(|p| p.x).collect();
    let thick = 0.04 * of.bore + 0.02 * of.stroke;
    let bottoms: Vec<f64> = stands.iter().map(|stand| MILLIMETRES * stand.bottom).collect();
    let mut parts = Vec::new();
    let place = if driven.lever == 1.0 {
        parts.push(Rigid::new("follower", vec![rectangle((0.0, clear), (-half, half))]).at(rollers.clone(), line_y));
        // The bottom stands a rod's length behind the roller.
        let apart = rollers.iter().zip(&bottoms).map(|(roller, bottom)| roller - bottom);
        Vector2::new(apart.fold(f64::NEG_INFINITY, f64::max) + clear + thick, line_y)
    } else {
        let (bar, place) = lever(driven, (low, high), clear, &bottoms, thick);
        parts.extend(bar);
        place
    };
    let width = 0.5 * of.stroke;
    parts.extend(buffer(of, stands, place, (of.rod(), width), cover));
    if of.yoke {
        parts.extend(crank(of, stands, place, width, cover));
    }
    parts
}

/// A slotted lever between the rods of roller and bottom: with straight rods its two travels have one ratio everywhere.
fn lever(
    driven: &Driven,
    (low, high): (f64, f64),
    clear: f64,
    bottoms: &[f64],
    thick: f64,
) -> (Vec<Rigid>, Vector2<f64>) {
    let line_y = driven.rollers.first().map_or(0.0, |p| p.y);
    let (middle, travel) = (0.5 * (low + high), high - low);
    // From the pivot to the line of the roller, and to that of the bottom.
    let longer = 1.5 * low.max(travel).max(travel / driven.lever);
    let (to_roller, to_bottom) = (longer * driven.lever.min(1.0), longer * (1.0 / driven.lever).min(1.0));
    let (x, pivot_y, bottom_y) = (middle + clear, line_y + to_roller, line_y + to_roller - to_bottom);
    let turns: Vec<f64> = driven.rollers.iter().map(|p| libm::atan2(p.x - middle, to_roller).to_degrees()).collect();
    let half = 0.22 * driven.radius;
    let rollers: Vec<f64> = driven.rollers.iter().map(|p| p.x).collect();
    let (least, most) = range(bottoms.iter().copied());
    let rod = 0.8 * clear + (most - least);
    let place = Vector2::new(x + rod + thick - 0.5 * (least + most), bottom_y);
    let ends: Vec<f64> = bottoms.iter().map(|bottom| place.x - thick - rod + bottom).collect();
    let bar = rectangle((-half, half), (-1.12 * longer, 0.5 * half));
    let parts = vec![
        Rigid::new("follower", vec![rectangle((0.0, clear), (-half, half)), circle(clear, 0.0, 1.2 * half)])
            .at(rollers, line_y),
        Rigid::new("follower", vec![rectangle((0.0, rod), (-half, half)), circle(0.0, 0.0, 1.2 * half)])
            .at(ends, bottom_y),
        Rigid::new("follower", vec![bar]).at(x, pivot_y).turned(turns),
        Rigid::new("ground", vec![circle(x, pivot_y, 1.6 * half)]).named("lever", x, pivot_y + 8.0 * half),
    ];
    (parts, place)
}

/// The crank whose pin carries the bed through its reversal, in a slot of the bed.
fn crank(of: &Buffer, stands: &[Stand], place: Vector2<f64>, width: f64, cover: &mut Cover) -> Vec<Rigid> {
    let x = place.x + of.column - of.lead + of.rod() + 0.5 * width;
    let pin = 0.055 * of.stroke;
    let turn: Vec<f64> = stands.iter().map(|stand| 90.0 + stand.crank.to_degrees()).collect();
    cover.add((x, x + of.stroke + pin), (place.y - of.stroke - pin, place.y + of.stroke + pin));
    let arm = vec![
        rectangle((pin, of.stroke - pin), (-0.45 * pin, 0.45 * pin)),
        circle(of.stroke, 0.0, pin),
        circle(0.0, 0.0, pin),
    ];
    vec![
        Rigid::new("ghost", vec![circle(x, place.y, of.stroke)]),
        Rigid::new("crank", arm).at(x, place.y).turned(turn).named("crank", 0.0, -1.6 * pin),
    ]
}
