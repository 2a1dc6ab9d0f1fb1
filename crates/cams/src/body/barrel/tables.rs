//! The tables of a barrel: sections of both flanks on cylinders, and the places of a tool on a machine with four axes.

use super::{Barrel, BarrelLine, BarrelRoller};
use crate::body::swept::{FlankSide, RollerLine};
use crate::table::{ListedColumn, Table, turned};
use camgen_kernel::geometry::MILLIMETRES;

/// Cylinders on which the flanks are listed, from the floor to the outside.
const CYLINDERS: u32 = 4;

/// Both flanks on a cylinder: angle, °, and height, mm.
struct SectionRow {
    cam_deg: f64,
    radius_mm: f64,
    upper: [f64; 2],
    lower: [f64; 2],
}

const SECTIONS: &[ListedColumn<SectionRow>] = &[
    ("cam_deg", |row| row.cam_deg),
    ("radius_mm", |row| row.radius_mm),
    ("upper_deg", |row| row.upper[0]),
    ("upper_z_mm", |row| row.upper[1]),
    ("lower_deg", |row| row.lower[0]),
    ("lower_z_mm", |row| row.lower[1]),
];

/// A place of a tool on a machine with four axes.
struct ToolRow {
    pass: f64,
    tool_mm: f64,
    a_deg: f64,
    y_mm: f64,
    z_mm: f64,
    missed_mm: f64,
}

const FOUR_AXES: &[ListedColumn<ToolRow>] = &[
    ("pass", |row| row.pass),
    ("tool_mm", |row| row.tool_mm),
    ("a_deg", |row| row.a_deg),
    ("y_mm", |row| row.y_mm),
    ("z_mm", |row| row.z_mm),
    ("missed_mm", |row| row.missed_mm),
];

impl<R: BarrelRoller> Barrel<R> {
    /// Both flanks on a few cylinders: the cam angle of the roller, the radius, and angle and height of each flank there.
    pub(super) fn sections_table(&self, samples: u32) -> Table {
        let mut rows = Vec::new();
        for ring in 0..=CYLINDERS {
            let share = f64::from(ring) / f64::from(CYLINDERS);
            let radius = if ring == CYLINDERS { self.outer } else { self.floor() + self.depth * share };
            for index in 0..samples {
                let at = turned(index, samples, self.groove.motion.lobes());
                let place = self.groove.motion.locate(at.angle);
                let edge = |side| {
                    let found = self.edge(side, radius, place);
                    found.map_or([f64::NAN; 2], |found| {
                        [self.groove.sense() * (at.cam_deg + found.ahead.to_degrees()), MILLIMETRES * found.height]
                    })
                };
                let (upper, lower) = (edge(FlankSide::Upper), edge(FlankSide::Lower));
                rows.push(SectionRow { cam_deg: at.cam_deg, radius_mm: MILLIMETRES * radius, upper, lower });
            }
        }
        Table::listed(SECTIONS, &rows)
    }

    /// Places of the tool's axis, which meets the cam's axis or passes it at an offset: the angle of the cam, and across and along in the frame of the machine.
    /// A tool of the width of the groove, which is meant where none is given, runs in the middle between both flanks; a smaller one along either flank, which it touches exactly in the
    /// middle of the groove's depth.
    pub(super) fn four_axes_table(&self, samples: u32, tool: Option<f64>) -> Table {
        let passes = self.groove.passes(tool);
        let radius = passes.radius;
        let middle = self.half_deep();
        let mut rows = Vec::new();
        for (pass, side) in passes.flanks.iter().enumerate() {
            for index in 0..samples {
                let at = turned(index, samples, self.groove.motion.lobes());
                let (piece, angle) = self.groove.motion.locate(at.angle);
                let axis = self.axis(piece, angle);
                let (sin, cos) = axis.point(axis.axis().at_distance(middle)).slope;
                let away = self.groove.tool_offset(*side, radius);
                let across = self.groove.sense() * (axis.axis().across[0] - away * sin);
                let along = axis.axis().along[0] + away * cos;
                let missed = side
                    .map_or(0.0, |side| self.missed_by_tool(&axis, self.groove.signed(side).abs() - radius, middle));
                #[expect(clippy::cast_precision_loss, reason = "two passes")]
                let number = (pass + 1) as f64;
                let [y_mm, z_mm, missed_mm] = [across, along, missed].map(|length| MILLIMETRES * length);
                rows.push(ToolRow {
                    pass: number,
                    tool_mm: 2.0 * MILLIMETRES * radius,
                    a_deg: self.groove.sense() * at.cam_deg,
                    y_mm,
                    z_mm,
                    missed_mm,
                });
            }
        }
        Table::listed(FOUR_AXES, &rows)
    }

    /// What a tool leaves of a flank at the ends of its depth, m, where it stands so much (m) nearer to the flank than the roller: it touches the flank
    /// exactly at one place along its axis, and the normals elsewhere differ from that one.
    fn missed_by_tool(&self, axis: &R::Line, nearer: f64, exact: f64) -> f64 {
        let slope = |from_axis: f64| axis.point(axis.axis().at_distance(from_axis)).slope;
        let at_exact = slope(exact);
        let missed = [self.floor(), self.outer].map(|from_axis| {
            let there = slope(from_axis);
            nearer * (1.0 - (there.0 * at_exact.0 + there.1 * at_exact.1))
        });
        missed.into_iter().fold(0.0, f64::max)
    }
}
