//! The tables of a globoid: places of both flanks of each groove, and those of a tool on two rotary axes.

use super::{End, FlankCurve, Globoid};
use crate::body::swept::{FlankSide, RollerLine};
use crate::table::{ListedColumn, Table};
use camgen_kernel::geometry::MILLIMETRES;
use std::f64::consts::TAU;

/// Distances from the turret's axis at which the flanks are listed, from the floor to the outside.
const TUBES: u32 = 4;

/// A place of a flank.
struct SectionRow {
    groove: f64,
    flank: f64,
    cam_deg: f64,
    from_turret_mm: f64,
    polar_deg: f64,
    radius_mm: f64,
    z_mm: f64,
}

const SECTIONS: &[ListedColumn<SectionRow>] = &[
    ("groove", |row| row.groove),
    ("flank", |row| row.flank),
    ("cam_deg", |row| row.cam_deg),
    ("from_turret_mm", |row| row.from_turret_mm),
    ("polar_deg", |row| row.polar_deg),
    ("radius_mm", |row| row.radius_mm),
    ("z_mm", |row| row.z_mm),
];

/// A place of a tool as a roller.
struct ToolRow {
    groove: f64,
    tool_mm: f64,
    a_deg: f64,
    b_deg: f64,
    y_mm: f64,
    w_mm: f64,
    tip_mm: f64,
    missed_mm: f64,
}

const TWO_AXES: &[ListedColumn<ToolRow>] = &[
    ("groove", |row| row.groove),
    ("tool_mm", |row| row.tool_mm),
    ("a_deg", |row| row.a_deg),
    ("b_deg", |row| row.b_deg),
    ("y_mm", |row| row.y_mm),
    ("w_mm", |row| row.w_mm),
    ("tip_mm", |row| row.tip_mm),
    ("missed_mm", |row| row.missed_mm),
];

impl Globoid {
    /// Cam angles, a step apart, at which a flank of a groove lies between the ends.
    fn angles(&self, curve: FlankCurve, samples: u32) -> Vec<f64> {
        let ends = [End::Bottom, End::Top].map(|end| self.passes(curve, end));
        let [Some(from), Some(to)] = ends else { return Vec::new() };
        let step = TAU / f64::from(samples.max(1));
        let mut angles = vec![from];
        let mut i = (from / step).floor() + 1.0;
        while i * step < to {
            angles.push(i * step);
            i += 1.0;
        }
        angles.push(to);
        angles
    }

    /// Places of both flanks of every groove at a few distances from the turret's axis.
    pub(super) fn sections_table(&self, samples: u32) -> Table {
        let mut rows = Vec::new();
        for groove in 0..self.turret.advance {
            let roller = f64::from(groove);
            for ring in 0..=TUBES {
                let share = f64::from(ring) / f64::from(TUBES);
                let from_turret = self.floor + (self.outside - self.floor) * share;
                for (flank, sign) in [(FlankSide::Upper, 1.0), (FlankSide::Lower, -1.0)] {
                    let curve = FlankCurve { flank, roller, from_turret };
                    for angle in self.angles(curve, samples) {
                        let Some(found) = self.edge(curve, angle) else { continue };
                        rows.push(SectionRow {
                            groove: roller + 1.0,
                            flank: sign,
                            cam_deg: angle.to_degrees(),
                            from_turret_mm: MILLIMETRES * from_turret,
                            polar_deg: self.groove.sense() * (angle + found.ahead()).to_degrees(),
                            radius_mm: MILLIMETRES * found.radius(),
                            z_mm: MILLIMETRES * found.place.z,
                        });
                    }
                }
            }
        }
        Table::listed(SECTIONS, &rows)
    }

    /// Places of a tool that is carried like a roller, about the axis of the turret: the angles of cam and tool, and how far the tool's axis stands beside the
    /// centre line of the roller, across (y) and upwards (w). A tool as wide as the groove, which is meant where none is given, runs in the middle
    /// between both flanks; a smaller one along either flank, which it touches exactly in the middle of the groove's depth.
    pub(super) fn two_axes_table(&self, samples: u32, tool: Option<f64>) -> Table {
        let passes = self.groove.passes(tool);
        let step = TAU / f64::from(samples.max(1));
        let mut rows = Vec::new();
        for groove in 0..self.turret.advance {
            let roller = f64::from(groove);
            let [enters, leaves] =
                [(FlankSide::Upper, End::Bottom), (FlankSide::Lower, End::Top)].map(|(flank, end)| {
                    self.passes(FlankCurve { flank, roller, from_turret: self.floor }, end).unwrap_or(f64::NAN)
                });
            for flank in passes.flanks {
                let away = self.groove.tool_offset(*flank, passes.radius);
                let mut i = (enters / step).floor();
                while (i - 1.0) * step < leaves {
                    rows.push(self.tool_row(i * step, roller, away, passes.radius));
                    i += 1.0;
                }
            }
        }
        Table::listed(TWO_AXES, &rows)
    }

    /// A tool of a radius at a distance from the centre line of a roller, along the normal of the flank in the middle of the groove's depth.
    fn tool_row(&self, angle: f64, roller: f64, away: f64, radius: f64) -> ToolRow {
        let line = self.line_at(angle, roller);
        let slope = |from: f64| line.point(from).slope;
        let (sin, cos) = slope(0.5 * (self.outside + self.floor));
        let missed = [self.outside, self.floor].map(|from| {
            let there = slope(from);
            away.abs() * (1.0 - (there.0 * sin + there.1 * cos))
        });
        let [tool_mm, y_mm, w_mm, tip_mm, missed_mm] =
            [2.0 * radius, -self.groove.sense() * away * sin, away * cos, self.floor, missed[0].max(missed[1])]
                .map(|length| MILLIMETRES * length);
        ToolRow {
            groove: roller + 1.0,
            tool_mm,
            a_deg: self.groove.sense() * angle.to_degrees(),
            b_deg: line.angle[0].to_degrees(),
            y_mm,
            w_mm,
            tip_mm,
            missed_mm,
        }
    }
}
