//! The press behind a cam as it moves: bottom, air, piston, bed and crank. Only one cylinder of the pair is shown.

use crate::press::MachineOfPress;
use crate::press::buffer::Cylinder;
use crate::press::buffer::crank_law::CrankLaw;
use crate::press::motion::Reversal;
use camgen_cams::body::picture::{Cover, DrivenMechanism, FollowerTrack, range};
use camgen_cams::machine::Machine;
use camgen_cams::report::mechanism::{CoordinateTrack, RigidPart, circle, rectangle};
use camgen_cams::table::turned;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::Motion;
use nalgebra::Vector2;
use std::f64::consts::TAU;

/// Pascals in a bar.
const BAR: f64 = 1e5;

/// Sizes of a cylinder and its bed, mm and Pa.
#[derive(Debug, Clone, Copy)]
pub(super) struct BufferPicture {
    stroke: f64,
    lead: f64,
    column: f64,
    bore: f64,
    ambient: f64,
    /// A crank in a slot of the bed moves it.
    yoke: bool,
}

impl BufferPicture {
    /// The sizes of a cylinder under a law.
    pub(super) fn new(cylinder: &Cylinder, law: &CrankLaw) -> Self {
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
    pub(super) fn column(&self) -> f64 {
        self.column
    }

    /// The crank radius, mm.
    pub(super) fn stroke(&self) -> f64 {
        self.stroke
    }

    /// The bore, mm.
    pub(super) fn bore(&self) -> f64 {
        self.bore
    }

    /// Length of piston and rod in front of the bed, mm.
    pub(super) fn rod(&self) -> f64 {
        self.piston() + 1.08 * self.stroke + self.lead
    }

    fn piston(&self) -> f64 {
        0.05 * self.bore + 0.02 * self.stroke
    }
}

/// The press at a sample.
#[derive(Debug, Clone, Copy)]
pub(super) struct PressPose {
    /// Crank angle, rad, 0 at the start of a reversal, growing over all turns.
    pub(super) crank: f64,
    /// Overrun of the bed into the buffer, in strokes; negative before and after the reversal.
    pub(super) overrun: f64,
    /// Δx of the bottom, m.
    pub(super) bottom: f64,
    /// p/p0 in the cylinder.
    pub(super) ratio: f64,
}

/// The press at equal steps of a turn of the cam, and at its end.
pub(super) fn press_poses(reversal: &Reversal, law: &CrankLaw, lobes: u32, samples: u32) -> Vec<PressPose> {
    let mut poses = Vec::new();
    for index in 0..=samples {
        let (at, wrapped) = (turned(index, samples, lobes), index >= samples);
        let (piece, angle) = reversal.locate(if wrapped { 0.0 } else { at.angle });
        let state = reversal.state(piece, angle);
        let crank = f64::from(lobes) * if wrapped { TAU } else { at.angle };
        let (bottom, ratio) = (state.displacement, state.pressure_ratio);
        poses.push(PressPose { crank, overrun: law.place(crank), bottom, ratio });
    }
    poses
}

/// The buffer with its bottom at a point (mm) where Δx is 0: cylinder, air, bottom, piston and bed of a width.
pub(super) fn buffer(
    buffer: &BufferPicture,
    poses: &[PressPose],
    place: Vector2<f64>,
    width: f64,
    cover: &mut Cover,
) -> Vec<RigidPart> {
    let half = 0.5 * buffer.bore;
    let thick = 0.04 * buffer.bore + 0.02 * buffer.stroke;
    let bottoms: Vec<f64> = poses.iter().map(|pose| place.x + MILLIMETRES * pose.bottom).collect();
    let open = place.x + buffer.column - buffer.lead;
    let pistons: Vec<f64> = poses.iter().map(|pose| open - buffer.stroke * pose.overrun).collect();
    let lengths: Vec<f64> = bottoms.iter().zip(&pistons).map(|(bottom, piston)| piston - bottom).collect();
    let pressures: Vec<f64> = poses.iter().map(|pose| pose.ratio * buffer.ambient / BAR).collect();
    let (nearest, _) = range(bottoms.iter().copied());
    let end = place.x + buffer.column;
    let wall = 0.025 * buffer.bore;
    let barrel = [-1.0, 1.0].map(|side| {
        let (inner, outer) = (place.y + side * half, place.y + side * (half + wall));
        rectangle((nearest - thick, end), (inner, outer))
    });
    cover.add((nearest - thick, end), (place.y - half - 5.0 * wall, place.y + half + 2.5 * wall));
    let below = place.y - half - 1.6 * wall;
    let y = CoordinateTrack::Still(place.y);
    let air = RigidPart {
        stretch: lengths.into(),
        pressure_bar: Some(pressures.into()),
        ..RigidPart::new("air", vec![rectangle((0.0, 1.0), (-half, half))]).at(bottoms.clone(), y.clone())
    };
    let bottom = RigidPart::new("bottom", vec![rectangle((-thick, 0.0), (-half, half))]);
    let rod = 0.05 * buffer.bore;
    let head = rectangle((0.0, buffer.piston()), (-0.985 * half, 0.985 * half));
    let shapes = vec![
        head,
        rectangle((buffer.piston(), buffer.rod()), (-rod, rod)),
        rectangle((buffer.rod(), buffer.rod() + width), (-half, half)),
    ];
    let (name_x, name_y) = (buffer.rod() + 0.5 * width, below - place.y);
    vec![
        air,
        RigidPart::new("cylinder", barrel.to_vec()).named("air cylinder", place.x + 0.5 * buffer.column, below),
        bottom.at(bottoms, y.clone()).named("bottom", -0.5 * thick, name_y),
        RigidPart::new("bed", shapes).at(pistons, y).named("bed", name_x, name_y),
    ]
}

/// The press behind the follower of a turning cam.
#[derive(Debug)]
pub(super) struct PressPicture {
    pub(super) buffer: BufferPicture,
    /// At each sample.
    pub(super) poses: Vec<PressPose>,
    /// Roller travel per bottom travel.
    pub(super) lever: f64,
    /// Whether a linkage other than a yoke moves the bed.
    pub(super) under_a_linkage: bool,
}

impl DrivenMechanism for PressPicture {
    fn shapes(&self, driven: &FollowerTrack, cover: &mut Cover) -> Vec<RigidPart> {
        behind(&self.buffer, &self.poses, driven, self.lever, cover)
    }

    fn notes(&self) -> Vec<String> {
        simplifications(self.under_a_linkage)
    }
}

/// Rod or lever, cylinder, bed and crank, with the travel of the roller per travel of the bottom.
fn behind(
    of: &BufferPicture,
    poses: &[PressPose],
    driven: &FollowerTrack,
    ratio: f64,
    cover: &mut Cover,
) -> Vec<RigidPart> {
    let (low, _) = range(driven.rollers.iter().map(|p| p.x));
    let line_y = driven.rollers.first().map_or(0.0, |p| p.y);
    let clear = (driven.reach - low).max(0.0) + 1.6 * driven.radius;
    let half = 0.22 * driven.radius;
    let rollers: Vec<f64> = driven.rollers.iter().map(|p| p.x).collect();
    let thick = 0.04 * of.bore + 0.02 * of.stroke;
    let bottoms: Vec<f64> = poses.iter().map(|pose| MILLIMETRES * pose.bottom).collect();
    let mut parts = Vec::new();
    let place = if ratio == 1.0 {
        parts
            .push(RigidPart::new("follower", vec![rectangle((0.0, clear), (-half, half))]).at(rollers.clone(), line_y));
        // The bottom is a rod's length behind the roller.
        let apart = rollers.iter().zip(&bottoms).map(|(roller, bottom)| roller - bottom);
        Vector2::new(apart.fold(f64::NEG_INFINITY, f64::max) + clear + thick, line_y)
    } else {
        let (bar, place) = lever(driven, ratio, clear, &bottoms, thick);
        parts.extend(bar);
        place
    };
    let width = 0.5 * of.stroke;
    parts.extend(buffer(of, poses, place, width, cover));
    if of.yoke {
        parts.extend(crank(of, poses, place, width, cover));
    }
    parts
}

/// A slotted lever between the rods of roller and bottom: with straight rods its two travels have one ratio everywhere.
fn lever(
    driven: &FollowerTrack,
    ratio: f64,
    clear: f64,
    bottoms: &[f64],
    thick: f64,
) -> (Vec<RigidPart>, Vector2<f64>) {
    let (low, high) = range(driven.rollers.iter().map(|p| p.x));
    let line_y = driven.rollers.first().map_or(0.0, |p| p.y);
    let (middle, travel) = (0.5 * (low + high), high - low);
    // From the pivot to the lines of the roller and of the bottom.
    let longer = 1.5 * low.max(travel).max(travel / ratio);
    let (to_roller, to_bottom) = (longer * ratio.min(1.0), longer * (1.0 / ratio).min(1.0));
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
        RigidPart::new("follower", vec![rectangle((0.0, clear), (-half, half)), circle(clear, 0.0, 1.2 * half)])
            .at(rollers, line_y),
        RigidPart::new("follower", vec![rectangle((0.0, rod), (-half, half)), circle(0.0, 0.0, 1.2 * half)])
            .at(ends, bottom_y),
        RigidPart::new("follower", vec![bar]).at(x, pivot_y).turned(turns),
        RigidPart::new("ground", vec![circle(x, pivot_y, 1.6 * half)]).named("lever", x, pivot_y + 8.0 * half),
    ];
    (parts, place)
}

/// The crank whose pin carries the bed through its reversal, in a slot of the bed.
fn crank(
    of: &BufferPicture,
    poses: &[PressPose],
    place: Vector2<f64>,
    width: f64,
    cover: &mut Cover,
) -> Vec<RigidPart> {
    let x = place.x + of.column - of.lead + of.rod() + 0.5 * width;
    let pin = 0.055 * of.stroke;
    let turn: Vec<f64> = poses.iter().map(|pose| 90.0 + pose.crank.to_degrees()).collect();
    cover.add((x, x + of.stroke + pin), (place.y - of.stroke - pin, place.y + of.stroke + pin));
    let arm = vec![
        rectangle((pin, of.stroke - pin), (-0.45 * pin, 0.45 * pin)),
        circle(of.stroke, 0.0, pin),
        circle(0.0, 0.0, pin),
    ];
    vec![
        RigidPart::new("ghost", vec![circle(x, place.y, of.stroke)]),
        RigidPart::new("crank", arm).at(x, place.y).turned(turn).named("crank", 0.0, -1.6 * pin),
    ]
}

/// What is simplified in the picture of a press.
pub(super) fn simplifications(under_a_linkage: bool) -> Vec<String> {
    if under_a_linkage {
        return vec![
            "Cam, roller, bottom, air column and overrun are to one scale; rods, lever and bed are schematic.".into(),
            "One cylinder of the pair is shown. The linkage that moves the bed is not: `camgen linkage` shows it."
                .into(),
        ];
    }
    vec![
        "Cam, roller, bottom, air column and overrun are to one scale; rods, lever and bed are schematic.".into(),
        "One cylinder of the pair is shown; between its reversals the bed leaves the picture.".into(),
    ]
}

/// What is not modelled of a press.
const OF_A_PRESS: &[&str] = &[
    "Air: it follows p·v^k = const without leakage or exchange of heat; k is that of the machine file.",
    "The bed between its reversals: it runs evenly, and its reversal at the other end is another cam's.",
];

/// What is not modelled of a press whose bed is moved by a linkage.
const UNDER_A_LINKAGE: &[&str] = &[
    "Air: it follows p·v^k = const without leakage or exchange of heat; k is that of the machine file.",
    "The other end of the bed's stroke: its buffers have a cam of their own (--end).",
    "Between its reversals the cylinders are open: how they are opened and closed is not modelled.",
];

/// What is not modelled of the press of a machine.
pub(super) fn not_modelled_of(machine: &Machine) -> &'static [&'static str] {
    if machine.end().is_some() { UNDER_A_LINKAGE } else { OF_A_PRESS }
}
