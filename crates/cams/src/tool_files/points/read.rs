//! Reads tables of points for a control.

use crate::analysis::compare::measured::stated_radius;
use crate::body::PointCurve;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::points::{PointCoordinates, PointInterpolation, PointStep};
use camgen_kernel::units::LengthUnit;

/// Angles that differ by less are equal, degrees.
const SAME_ANGLE: f64 = 1e-9;
/// The columns of either form in either unit.
pub(super) const COLUMNS: [(&str, PointCoordinates, LengthUnit); 4] = [
    ("cam_deg,radius_mm", PointCoordinates::Polar, LengthUnit::Millimetre),
    ("x_mm,y_mm", PointCoordinates::Plane, LengthUnit::Millimetre),
    ("cam_deg,radius_in", PointCoordinates::Polar, LengthUnit::Inch),
    ("x_in,y_in", PointCoordinates::Plane, LengthUnit::Inch),
];
/// Words that the reader looks for.
const INTERPOLATION: &str = "# interpolation: ";
pub(super) const LINEAR: &str = "linear";
pub(super) const CUBIC: &str = "cubic";
const CLOSED: &str = "# closed: yes";

/// What the head of a file says of the curve and its places.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct StatedCurve {
    /// The curve.
    pub curve: PointCurve,
    /// Radius of the cutter whose centre it gives, m, where it is stated.
    pub cutter: Option<f64>,
    /// How its places were chosen.
    pub step: PointStep,
}

/// Whether bytes are those of a table of points, by the line that names its columns.
pub(super) fn is_points(bytes: &[u8]) -> bool {
    let columns = |line: &[u8]| COLUMNS.iter().any(|(columns, _, _)| columns.as_bytes() == line.trim_ascii_end());
    let mut lines = bytes.split(|byte| *byte == b'\n').skip_while(|line| line.starts_with(b"#"));
    lines.next().is_some_and(columns)
}

/// What the head of a file says; without a word it is the profile at equal angles.
pub(super) fn stated(bytes: &[u8]) -> StatedCurve {
    let text = String::from_utf8_lossy(bytes);
    let line = |key: &str| {
        let mut lines = text.lines().take_while(|line| line.starts_with('#'));
        lines.find_map(|line| line.strip_prefix("# ")?.strip_prefix(key)?.strip_prefix(": ")).unwrap_or_default()
    };
    let given = line("given");
    let curve = match given {
        _ if given.contains("cutter") => PointCurve::Cutter,
        _ if given.contains("roller") => PointCurve::Centre,
        _ => PointCurve::Profile,
    };
    let radius = stated_radius(given);
    let cutter = radius.filter(|_| curve == PointCurve::Cutter).map(|radius| radius / MILLIMETRES);
    let step = if line("points").contains("equal error") { PointStep::Chord } else { PointStep::Angle };
    StatedCurve { curve, cutter, step }
}

/// A table as a control reads it from a file, in millimetres.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadPoints {
    /// Its coordinates, by the names of its columns.
    pub form: PointCoordinates,
    /// The unit of the file, from its column names; the rows are in millimetres.
    pub units: LengthUnit,
    /// Its interpolation, by its head.
    pub between: PointInterpolation,
    /// Whether it closes, by its head.
    pub closed: bool,
    /// Its rows.
    pub rows: Vec<[f64; 2]>,
}

/// The table of a file.
///
/// # Errors
/// A sentence when the file is not a table of points.
pub fn read(bytes: &[u8]) -> Result<ReadPoints, String> {
    let text = std::str::from_utf8(bytes).map_err(|error| error.to_string())?;
    let (mut between, mut closed, mut head, mut rows) = (None, false, None, Vec::new());
    for line in text.lines() {
        if let Some(words) = line.strip_prefix(INTERPOLATION) {
            between = match words.split(',').next() {
                Some(LINEAR) => Some(PointInterpolation::Linear),
                Some(CUBIC) => Some(PointInterpolation::Cubic),
                _ => None,
            };
        }
        closed |= line.starts_with(CLOSED);
        match line {
            _ if line.starts_with('#') => {}
            line if COLUMNS.iter().any(|(columns, _, _)| *columns == line) => {
                head = COLUMNS.iter().find(|(columns, _, _)| *columns == line).map(|(_, form, unit)| (*form, *unit));
            }
            row => {
                let numbers = row.split_once(',').map(|(first, second)| (first.parse(), second.parse()));
                let Some((Ok(first), Ok(second))) = numbers else {
                    return Err(format!("`{row}` is not a row of two numbers"));
                };
                rows.push([first, second]);
            }
        }
    }
    match (head, between) {
        (Some((form, unit)), Some(between)) => {
            let first = if form == PointCoordinates::Polar { 1.0 } else { unit.millimetres() };
            let rows = rows.into_iter().map(|[a, b]: [f64; 2]| [first * a, unit.millimetres() * b]).collect();
            Ok(ReadPoints { form, units: unit, between, closed, rows })
        }
        (None, _) => Err("the line that names the columns is missing".into()),
        (_, None) => Err("the interpolation is not stated".into()),
    }
}

impl ReadPoints {
    /// Whether the angles of a polar table grow from row to row, and go once round where it is closed.
    ///
    /// # Errors
    /// A sentence with the row or the range of angles, degrees.
    pub fn goes_round(&self) -> Result<(), String> {
        if self.form != PointCoordinates::Polar {
            return Ok(());
        }
        let falls = self.rows.windows(2).position(|pair| matches!(pair, [[before, _], [next, _]] if !(next >= before)));
        if let Some((at, [angle, _])) = falls.and_then(|at| Some((at, self.rows.get(at + 1)?))) {
            return Err(format!("row {} is at {angle} degrees, which is less than that of the row before it", at + 2));
        }
        let (Some([first, _]), Some([last, _])) = (self.rows.first(), self.rows.last()) else { return Ok(()) };
        if self.closed && (last - first - 360.0).abs() > SAME_ANGLE {
            return Err(format!("the rows go from {first} to {last} degrees, which is not once round the shaft"));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_a_table_is_refused() {
        let good = "# interpolation: cubic, whatever\n# closed: yes, so\nx_mm,y_mm\n1.0,-2.5\n";
        let table = ReadPoints {
            form: PointCoordinates::Plane,
            units: LengthUnit::Millimetre,
            between: PointInterpolation::Cubic,
            closed: true,
            rows: vec![[1.0, -2.5]],
        };
        assert_eq!(read(good.as_bytes()), Ok(table));
        let inches = read(good.replace("_mm", "_in").as_bytes()).expect("a table in inches");
        assert_eq!((inches.form, inches.rows), (PointCoordinates::Plane, vec![[25.4, -63.5]]));
        assert!(read(good.replace("y_mm", "y_in").as_bytes()).is_err(), "two units");
        assert!(read(good.replace("cubic", "quintic").as_bytes()).is_err_and(|why| why.contains("interpolation")));
        assert!(read(good.replace("x_mm", "u_mm").as_bytes()).is_err_and(|why| why.contains("is not a row")));
        assert!(read(good.replace("-2.5", "").as_bytes()).is_err_and(|why| why.contains("1.0,")));
        assert!(read(b"# interpolation: linear, x\n").is_err_and(|why| why.contains("columns")));
        assert!(read(&[0xff, 0xfe]).is_err());
    }

    #[test]
    fn polar_angles_grow_over_the_whole_turn() {
        let read_turn = |last: &str| {
            let head = "# interpolation: linear, so\n# closed: yes, so\ncam_deg,radius_mm\n";
            let table = format!("{head}12.0,17.0\n130.0,18.0\n130.0,18.0\n250.0,17.0\n{last},17.0\n");
            read(table.as_bytes()).and_then(|read| read.goes_round())
        };
        assert!(read_turn("372.0").is_ok());
        for (last, part) in
            [("12.0", "row 5 is at 12"), ("-348.0", "row 5 is at -348"), ("360.0", "12 to 360"), ("732.0", "12 to 732")]
        {
            assert!(read_turn(last).is_err_and(|why| why.contains(part)), "{last}: {:?}", read_turn(last));
        }
    }
}
