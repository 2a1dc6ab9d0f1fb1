//! The point table: one list of columns, walked for every kind of cam.
//!
//! A row holds what a cam knows at one place, in the units of the table; what a cam does not have stays empty, and so does the
//! column. A new column is one function and one line in [`COLUMNS`]; a domain adds its own to a row.

use camgen_kernel::motion::Jet;
use nalgebra::{Vector2, Vector3};
use std::f64::consts::TAU;
use std::fmt;
use std::sync::Arc;

/// What is known at one place of a cam: millimetres, degrees, newtons; derivatives by the parameter in radians.
#[derive(Debug, Clone, Default)]
pub struct Row {
    /// Cam angle.
    pub cam_deg: Option<f64>,
    /// Position in a motion program, metres or radians.
    pub position: Option<f64>,
    /// Lift in metres, of a cam that turns.
    pub lift: Option<Jet>,
    /// Piece of the motion, and the parameter in it, of which the lift of a cam that turns is.
    pub at: Option<(usize, f64)>,
    /// Lift in radians, of a cam under a swinging follower.
    pub swing: Option<Jet>,
    /// Parameter of the motion of a cam that does not turn, m.
    pub parameter: Option<f64>,
    /// What moves behind the follower, where its load knows that.
    pub load: Option<Arc<dyn LoadState>>,
    /// A point of the follower's curve.
    pub curve: Option<Vector2<f64>>,
    /// A point of the profile.
    pub profile: Option<Vector2<f64>>,
    /// Angle between the follower's path and the normal.
    pub pressure_angle_deg: Option<f64>,
    /// Signed radius of curvature of the follower's curve, convex positive.
    pub curve_radius: Option<f64>,
    /// Signed radius of curvature of the profile, convex positive.
    pub profile_radius: Option<f64>,
    /// Forces of a turning cam.
    pub force: Option<ForceRow>,
    /// What only a body has whose sections differ.
    pub surface: Option<SurfaceRow>,
    /// Velocity and acceleration of the follower on the written outline, by the angle of the shaft; NaN where it is not in
    /// touch.
    pub cut: Option<[f64; 2]>,
    /// Size of the residual force with the lift as cut, N, of a cam that turns under a load.
    pub residual_cut: Option<f64>,
    /// Torque of a second disc on the same shaft, N·m.
    pub torque_of_second: Option<f64>,
    /// Where a flat face is touched, from its stem or its pivot.
    pub face: Option<f64>,
    /// Whether the follower swings.
    pub swings: bool,
    /// Whether rates are by the travel of a plate, m per m, and not by the angle of a shaft.
    pub by_travel: bool,
    /// What a domain adds, in the order of its columns.
    pub added: Vec<(&'static AddedColumn, f64)>,
}

/// A column that a domain adds.
#[derive(Debug, PartialEq, Eq)]
pub struct AddedColumn {
    /// Its name, with its unit.
    pub name: &'static str,
    /// The column of [`COLUMNS`] after which it comes.
    pub after: &'static str,
}

/// What moves behind the follower of a cam, at a place of its motion.
pub trait LoadState: fmt::Debug + Send + Sync {
    /// Force that presses the follower onto the cam along its path, N.
    fn pressing(&self) -> f64;

    /// Size of the residual force with the follower `moved` (m) along its path from where the motion puts it, N.
    fn residual(&self, moved: f64) -> f64;

    /// What it adds to the row of the table at a place of a turn.
    fn columns(&self, at: &TurnAngles) -> Vec<(&'static AddedColumn, f64)>;
}

/// Forces of a turning cam at a place.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ForceRow {
    /// Along the follower's path.
    pub path: f64,
    /// On the camshaft, N·m.
    pub torque: f64,
    /// Along the normal, where it is known.
    pub contact: Option<f64>,
}

/// A surface at a place.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SurfaceRow {
    /// Place along the axis.
    pub z: f64,
    /// Speed of its section, rpm.
    pub rpm: f64,
    /// Slope of the lift along the axis.
    pub lift_per_z: f64,
    /// Where the sphere touches.
    pub contact: Vector3<f64>,
    /// How far the normal leans along the axis.
    pub axial_angle_deg: f64,
    /// Sharpest principal radius of curvature of the pitch surface.
    pub principal_radius: f64,
    /// Component of the force along the axis.
    pub axial_force: f64,
}

/// A column of every kind of cam: its name, with its unit, and its value; `None` for a cam that does not have it.
pub type CamColumn = (&'static str, fn(&Row) -> Option<f64>);

/// Every column but those of domains, in the order of the table.
pub const COLUMNS: &[CamColumn] = &[
    ("z_mm", |row| Some(row.surface?.z)),
    ("cam_deg", |row| row.cam_deg),
    ("position_mm", |row| row.lift.and(row.position).map(|position| 1e3 * position)),
    ("position_deg", |row| row.swing.and(row.position).map(f64::to_degrees)),
    // Rounding at the lowest point must not give a negative lift.
    ("lift_mm", |row| Some(1e3 * row.lift?.s.max(0.0))),
    ("lift_deg", |row| Some(row.swing?.s.max(0.0).to_degrees())),
    ("velocity_rad_per_rad", |row| Some(row.swing?.ds)),
    ("acceleration_rad_per_rad2", |row| Some(row.swing?.dds)),
    ("jerk_rad_per_rad3", |row| Some(row.swing?.ddds)),
    ("velocity_mm_per_rad", |row| Some(1e3 * row.lift?.ds)),
    ("acceleration_mm_per_rad2", |row| Some(1e3 * row.lift?.dds)),
    ("jerk_mm_per_rad3", |row| Some(1e3 * row.lift?.ddds)),
    ("pitch_x_mm", |row| Some(row.curve?.x)),
    ("pitch_y_mm", |row| Some(row.curve?.y)),
    ("profile_x_mm", |row| Some(row.profile?.x)),
    ("profile_y_mm", |row| Some(row.profile?.y)),
    ("pressure_angle_deg", |row| row.pressure_angle_deg),
    ("pitch_curvature_radius_mm", |row| row.curve_radius),
    ("profile_curvature_radius_mm", |row| row.profile_radius),
    ("roller_force_n", |row| Some(row.force?.path)),
    ("torque_nm", |row| Some(row.force?.torque)),
    ("contact_force_n", |row| row.force?.contact),
    ("rpm", |row| Some(row.surface?.rpm)),
    ("lift_per_z", |row| Some(row.surface?.lift_per_z)),
    ("contact_x_mm", |row| Some(row.surface?.contact.x)),
    ("contact_y_mm", |row| Some(row.surface?.contact.y)),
    ("contact_z_mm", |row| Some(row.surface?.contact.z)),
    ("axial_angle_deg", |row| Some(row.surface?.axial_angle_deg)),
    ("principal_curvature_radius_mm", |row| Some(row.surface?.principal_radius)),
    ("axial_force_n", |row| Some(row.surface?.axial_force)),
    ("velocity_cut_mm_per_mm", |row| row.cut.filter(|_| row.by_travel).map(|[velocity, _]| velocity)),
    ("acceleration_cut_mm_per_mm2", |row| {
        row.cut.filter(|_| row.by_travel).map(|[_, acceleration]| 1e-3 * acceleration)
    }),
    ("velocity_cut_mm_per_rad", |row| by_angle(row).map(|[velocity, _]| 1e3 * velocity)),
    ("acceleration_cut_mm_per_rad2", |row| by_angle(row).map(|[_, acceleration]| 1e3 * acceleration)),
    ("velocity_cut_rad_per_rad", |row| row.cut.filter(|_| row.swings).map(|[velocity, _]| velocity)),
    ("acceleration_cut_rad_per_rad2", |row| row.cut.filter(|_| row.swings).map(|[_, acceleration]| acceleration)),
    ("residual_cut_n", |row| row.residual_cut),
    ("compensator_torque_nm", |row| row.torque_of_second),
    ("torque_left_nm", |row| Some(row.force?.torque + row.torque_of_second?)),
    ("face_mm", |row| row.face),
];

/// The rates as cut of a follower on a straight path by the angle of the shaft.
fn by_angle(row: &Row) -> Option<[f64; 2]> {
    row.cut.filter(|_| !row.swings && !row.by_travel)
}

/// In the names of columns of what the follower does on the outline as cut: nothing where it is not in touch.
const AS_CUT: &str = "_cut_";

/// A table of numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Names of the columns, with their units.
    pub columns: Vec<&'static str>,
    /// Rows, each as long as `columns`.
    pub rows: Vec<Vec<f64>>,
    /// For each column whether a row may have no value in it; the value is NaN then.
    pub may_lack: Vec<bool>,
    /// A column of words before the others, with its name: a word for each row.
    pub words: Option<(&'static str, Vec<String>)>,
    /// Further columns of words between the others.
    pub more_words: Vec<WordColumn>,
}

/// A column of words.
#[derive(Debug, Clone, PartialEq)]
pub struct WordColumn {
    /// Its name.
    pub name: &'static str,
    /// The column of numbers before which it stands.
    pub before: &'static str,
    /// A word for each row.
    pub words: Vec<String>,
}

/// A column of a table.
#[derive(Debug, Clone, Copy)]
pub struct Column {
    /// Its name, with its unit.
    pub name: &'static str,
    source: ColumnSource,
}

#[derive(Debug, Clone, Copy)]
enum ColumnSource {
    Every(fn(&Row) -> Option<f64>),
    /// Place among what the domain adds to each row.
    Added(usize),
}

/// The columns that a cam has.
#[must_use]
pub fn columns(rows: &[Row]) -> Vec<Column> {
    let Some(first) = rows.first() else { return Vec::new() };
    let mut all = Vec::new();
    for (name, of) in COLUMNS {
        if of(first).is_some() {
            all.push(Column { name, source: ColumnSource::Every(*of) });
        }
        let behind = first.added.iter().enumerate().filter(|(_, (column, _))| column.after == *name);
        all.extend(behind.map(|(at, (column, _))| Column { name: column.name, source: ColumnSource::Added(at) }));
    }
    all
}

/// The value of a row in a column, NaN where there is none.
#[must_use]
pub fn value(row: &Row, column: &Column) -> f64 {
    let value = match column.source {
        ColumnSource::Every(of) => of(row),
        ColumnSource::Added(at) => row.added.get(at).map(|(_, value)| *value),
    };
    // A negative zero is zero.
    value.unwrap_or(f64::NAN) + 0.0
}

/// The value of a row in the column of a name; `None` where its cam does not have the column.
#[must_use]
pub fn named_value(row: &Row, name: &str) -> Option<f64> {
    let own = COLUMNS.iter().find(|(column, _)| *column == name).and_then(|(_, of)| of(row));
    let mut added = row.added.iter().filter(|(column, _)| column.name == name).map(|(_, value)| *value);
    // A negative zero is zero.
    own.or_else(|| added.next()).map(|value| value + 0.0)
}

/// Whether a row may have no value in a column.
#[must_use]
pub fn may_lack(column: &Column) -> bool {
    column.name.contains(AS_CUT)
}

impl Table {
    /// The rows of a cam under the columns that it has.
    #[must_use]
    pub fn from_rows(rows: &[Row]) -> Self {
        let columns = columns(rows);
        Self {
            columns: columns.iter().map(|column| column.name).collect(),
            rows: rows.iter().map(|row| columns.iter().map(|column| value(row, column)).collect()).collect(),
            may_lack: columns.iter().map(may_lack).collect(),
            words: None,
            more_words: Vec::new(),
        }
    }

    /// Without those of some columns that no row has a value of.
    #[must_use]
    pub fn without_unknown(mut self, some: &[&str]) -> Self {
        fn kept<T>(all: &mut Vec<T>, keep: &[bool]) {
            let mut keep = keep.iter();
            all.retain(|_| keep.next().copied().unwrap_or(true));
        }
        let known = |column: usize| self.rows.iter().any(|row| row.get(column).is_some_and(|value| !value.is_nan()));
        let keep: Vec<bool> =
            self.columns.iter().enumerate().map(|(at, name)| !some.contains(name) || known(at)).collect();
        kept(&mut self.columns, &keep);
        kept(&mut self.may_lack, &keep);
        self.rows.iter_mut().for_each(|row| kept(row, &keep));
        self
    }

    /// Rows of anything but a cam, under the names of the columns.
    #[must_use]
    pub fn listed<T>(listed: &[ListedColumn<T>], rows: &[T]) -> Self {
        Self {
            columns: listed.iter().map(|(name, _)| *name).collect(),
            rows: rows.iter().map(|row| listed.iter().map(|(_, value)| value(row) + 0.0).collect()).collect(),
            may_lack: vec![true; listed.len()],
            words: None,
            more_words: Vec::new(),
        }
    }
}

/// The name of a value with its unit, and the value of a row.
pub type ListedColumn<T> = (&'static str, fn(&T) -> f64);

/// The angles of a row of the table of a turning cam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TurnAngles {
    /// Cam angle, degrees in [0, 360).
    pub cam_deg: f64,
    /// Cam angle in radians: at the start of a lobe exactly the number at which its motion starts.
    pub angle: f64,
    /// Crank angle of a cam with a lobe for each turn of the crank, degrees in [0, 360).
    pub crank_deg: f64,
}

/// The row `index` of `rows` in a turn of a cam of so many lobes, all at least 1. Whole turns of the crank are taken off as
/// whole numbers: an angle in degrees would lose the round ones.
#[must_use]
pub fn turned(index: u32, rows: u32, lobes: u32) -> TurnAngles {
    let (rows, lobes) = (rows.max(1), lobes.max(1));
    let degrees = |index: f64| 360.0 * index / f64::from(rows);
    let (whole, part) = {
        let (turns, each) = (u64::from(index) * u64::from(lobes), u64::from(rows));
        (turns / each, turns % each)
    };
    #[expect(clippy::cast_precision_loss, reason = "fewer than 2^32 rows and lobes")]
    let (whole, crank_deg) = (whole as f64, degrees(part as f64));
    let angle = TAU * whole / f64::from(lobes) + crank_deg.to_radians() / f64::from(lobes);
    TurnAngles { cam_deg: degrees(f64::from(index)), angle, crank_deg }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_of_lobes_count_the_crank_in_whole_turns() {
        for (rows, lobes) in [(720, 1), (720, 3), (700, 7), (17, 4), (1, 2)] {
            for index in 0..rows {
                let at = turned(index, rows, lobes);
                assert!((0.0..360.0).contains(&at.crank_deg) && (0.0..360.0).contains(&at.cam_deg), "{at:?}");
                assert!((at.angle - at.cam_deg.to_radians()).abs() < 2e-15, "{at:?}");
                let turns = (f64::from(lobes) * at.cam_deg - at.crank_deg) / 360.0;
                assert!((turns - turns.round()).abs() < 1e-14 * f64::from(lobes), "{at:?}");
            }
        }
        let third = turned(240, 720, 3);
        assert_eq!((third.cam_deg, third.crank_deg, third.angle), (120.0, 0.0, TAU / 3.0));
    }

    #[test]
    fn a_cam_has_every_column_once() {
        let turning = Row {
            cam_deg: Some(1.0),
            position: Some(1.0),
            lift: Some(Jet::default()),
            curve: Some(Vector2::zeros()),
            profile: Some(Vector2::zeros()),
            pressure_angle_deg: Some(1.0),
            curve_radius: Some(1.0),
            profile_radius: Some(1.0),
            force: Some(ForceRow { contact: Some(1.0), ..ForceRow::default() }),
            surface: Some(SurfaceRow::default()),
            cut: Some([1.0; 2]),
            residual_cut: Some(1.0),
            torque_of_second: Some(1.0),
            face: Some(1.0),
            ..Row::default()
        };
        let travelling = Row { by_travel: true, ..turning.clone() };
        let swinging = Row { lift: None, swing: Some(Jet::default()), swings: true, ..turning.clone() };
        let mut all: Vec<&str> = Vec::new();
        for row in [turning, swinging, travelling] {
            let columns = Table::from_rows(&[row]).columns;
            let mut names = columns.clone();
            names.sort_unstable();
            names.dedup();
            assert_eq!(names.len(), columns.len(), "{columns:?}");
            all.extend(names);
        }
        assert!(COLUMNS.iter().all(|(name, _)| all.contains(name)), "every column belongs to some cam");
        assert!(Table::from_rows(&[]).columns.is_empty());
    }

    #[test]
    fn columns_of_a_domain_stand_where_they_belong() {
        const FIRST: AddedColumn = AddedColumn { name: "x_mm", after: "cam_deg" };
        const NEXT: AddedColumn = AddedColumn { name: "dx_mm", after: "cam_deg" };
        let row =
            |x: f64| Row { lift: Some(Jet::default()), added: vec![(&FIRST, x), (&NEXT, -0.0)], ..Row::default() };
        let table = Table::from_rows(&[row(1.0), row(2.0)]);
        assert_eq!(table.columns[..3], ["x_mm", "dx_mm", "lift_mm"]);
        assert_eq!(table.rows[1][..2], [2.0, 0.0]);
        assert!(table.rows[1][1].is_sign_positive());
    }
}
