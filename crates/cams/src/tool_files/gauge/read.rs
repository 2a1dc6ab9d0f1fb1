//! Reads the lift table of a gauge follower.

use camgen_kernel::units::LengthUnit;

/// A table as it was read.
#[derive(Debug, Clone, PartialEq)]
pub struct GaugeRows {
    /// Radius of the ball or roller, mm; `None` of a flat face.
    pub radius: Option<f64>,
    /// The unit of length of the file.
    pub units: LengthUnit,
    /// Cam angle, degrees; distance of the centre, or of the face, from the axis, and lift, mm.
    pub rows: Vec<[f64; 3]>,
}

/// The columns in either unit.
pub(super) const COLUMNS: [(&str, LengthUnit); 2] =
    [("cam_deg,distance_mm,lift_mm", LengthUnit::Millimetre), ("cam_deg,distance_in,lift_in", LengthUnit::Inch)];
/// What the head says of the follower.
pub(super) const FOLLOWER: &str = "gauge_follower: ";
/// A ball or a roller, with its diameter and its unit.
pub(super) const ROUND: &str = "ball or roller, diameter_";
/// A flat face.
pub(super) const FLAT: &str = "flat face";
/// Most rows.
const MOST_ROWS: usize = 1_000_000;

/// The unit of a line that names the columns.
fn units(line: &str) -> Option<LengthUnit> {
    COLUMNS.iter().find(|(columns, _)| *columns == line.trim_end()).map(|(_, units)| *units)
}

/// Whether bytes are such a table.
pub(super) fn is_gauge(bytes: &[u8]) -> bool {
    String::from_utf8_lossy(bytes).lines().take(40).any(|line| units(line).is_some())
}

/// Reads a table.
///
/// # Errors
/// A sentence when it is not one.
pub fn read(bytes: &[u8]) -> Result<GaugeRows, String> {
    let text = std::str::from_utf8(bytes).map_err(|error| error.to_string())?;
    let follower = text
        .lines()
        .find_map(|line| line.strip_prefix("# ")?.strip_prefix(FOLLOWER))
        .ok_or("its head does not name the follower")?;
    let radius = match follower.trim_end().strip_prefix(ROUND) {
        Some(diameter) => {
            let in_units = [("mm ", LengthUnit::Millimetre), ("in ", LengthUnit::Inch)].into_iter();
            let mut found = in_units.filter_map(|(unit, of)| Some((of, diameter.strip_prefix(unit)?)));
            let found = found.next().and_then(|(unit, number)| Some(unit.millimetres() * number.parse::<f64>().ok()?));
            let diameter = found.filter(|diameter| *diameter > 0.0);
            Some(0.5 * diameter.ok_or("the diameter of its follower is not a number above 0")?)
        }
        None if follower.trim_end() == FLAT => None,
        None => return Err(format!("`{}` is not a gauge follower", follower.chars().take(40).collect::<String>())),
    };
    let mut lines = text.lines().filter(|line| !line.starts_with('#') && !line.is_empty());
    let units = lines.next().and_then(units).ok_or("the line that names the columns is missing")?;
    let scale = units.millimetres();
    let row = |(index, line): (usize, &str)| {
        let numbers: Option<Vec<f64>> = line.split(',').map(|cell| cell.trim().parse().ok()).collect();
        let finite = numbers.filter(|numbers| numbers.iter().all(|number| number.is_finite()));
        finite
            .and_then(|numbers| <[f64; 3]>::try_from(numbers).ok())
            .map(|[angle, distance, lift]| [angle, scale * distance, scale * lift])
            .ok_or_else(|| format!("row {} has not three numbers", index + 1))
    };
    let rows: Vec<[f64; 3]> = lines.take(MOST_ROWS).enumerate().map(row).collect::<Result<_, _>>()?;
    if rows.is_empty() { Err("it has no rows".into()) } else { Ok(GaugeRows { radius, units, rows }) }
}
