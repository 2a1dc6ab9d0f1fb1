//! Reads tables for servo drives: rows of a CSV file, or the points of a declaration in structured text.

use camgen_kernel::units::LengthUnit;

/// A table as it was read: master in degrees, slave in mm or degrees, velocity and acceleration by the master.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ServoRows {
    /// Whether the slave is in degrees, where the file says so.
    pub swings: bool,
    /// Whether the drive goes straight from row to row, whose velocity and acceleration are then nothing.
    pub straight: bool,
    /// The unit of length of the file; the rows are in millimetres.
    pub units: LengthUnit,
    /// The rows.
    pub rows: Vec<[f64; 4]>,
}

impl ServoRows {
    /// With a slave in millimetres that was read in a unit.
    fn scaled(mut self, units: LengthUnit) -> Self {
        for value in self.rows.iter_mut().flat_map(|row| row.iter_mut().skip(1)) {
            *value *= units.millimetres();
        }
        self.units = units;
        self
    }
}

/// The names of the four numbers of a point in the structures of CODESYS and TwinCAT.
const NAMES: [[&str; 4]; 2] = [["dX", "dY", "dV", "dA"], ["MasterPos", "SlavePos", "SlaveVelo", "SlaveAcc"]];
/// What the header of a CSV table begins with.
const CSV_HEAD: &str = "master_deg,slave_";
/// The columns of a table of a slave in mm, of one in degrees, and of one in inches.
const CSV_HEADS: [&str; 3] = [
    "master_deg,slave_mm,velocity_mm_per_deg,acceleration_mm_per_deg2",
    "master_deg,slave_deg,velocity_deg_per_deg,acceleration_deg_per_deg2",
    "master_deg,slave_in,velocity_in_per_deg,acceleration_in_per_deg2",
];
/// What begins and ends the lines of a table of the controls of ISG, and what its units are.
const BEGIN: &str = "Begintable";
const END: &str = "EndTable";
const TEN_THOUSANDTH: f64 = 1e-4;
/// What a head says of a slave in degrees.
const SWINGS: &str = "slave: deg";
/// What a head says of a slave in inches.
const INCHES: &str = "slave: in;";
/// Most rows.
const MOST_ROWS: usize = 1_000_000;

/// Whether bytes are a table for a servo drive.
pub(super) fn is_servo(bytes: &[u8]) -> bool {
    let text = String::from_utf8_lossy(bytes);
    text.lines().take(60).any(|line| {
        let line = line.trim_start();
        line.starts_with(CSV_HEAD)
            || line == BEGIN
            || line.contains("SMC_CAMXYVA")
            || line.contains("MC_MotionFunctionPoint")
    })
}

/// Reads a table.
///
/// # Errors
/// A sentence when it is not one, or its master does not ascend.
pub fn read(bytes: &[u8]) -> Result<ServoRows, String> {
    let text = std::str::from_utf8(bytes).map_err(|error| error.to_string())?;
    let has = |what: &str| text.lines().any(|line| line.trim_start().starts_with(what));
    let read = match (has(CSV_HEAD), has(BEGIN)) {
        (true, _) => rows(text)?,
        (_, true) => equal_parts(text)?,
        _ => points(text)?,
    };
    match read.rows.windows(2).find(|pair| !(pair[0][0] < pair[1][0])) {
        Some(pair) => Err(format!("the master does not ascend at {} deg", pair[1][0])),
        None if read.rows.len() < 2 => Err("it has fewer than two rows".to_owned()),
        None => Ok(read),
    }
}

fn finite(text: &str) -> Option<f64> {
    text.trim().parse().ok().filter(|number: &f64| number.is_finite())
}

fn rows(text: &str) -> Result<ServoRows, String> {
    let (mut read, mut units) = (ServoRows::default(), LengthUnit::Millimetre);
    for line in text.lines().filter(|line| !line.starts_with('#') && !line.is_empty()) {
        if line.starts_with(CSV_HEAD) {
            read.swings = line == CSV_HEADS[1];
            units = if line == CSV_HEADS[2] { LengthUnit::Inch } else { LengthUnit::Millimetre };
            if !CSV_HEADS.contains(&line) {
                return Err(format!("its columns are not {}", CSV_HEADS.join(" or ")));
            }
            continue;
        }
        let cells: Vec<Option<f64>> = line.split(',').map(finite).collect();
        match cells.as_slice() {
            [Some(x), Some(y), Some(v), Some(a)] if read.rows.len() < MOST_ROWS => {
                read.rows.push([*x, *y, *v, *a]);
            }
            _ => return Err(format!("`{}` is not a row of four numbers", line.chars().take(60).collect::<String>())),
        }
    }
    Ok(read.scaled(units))
}

/// A table of one column of the controls of ISG: positions at equal parts of the turn, with straight lines between them, closed by the first.
fn equal_parts(text: &str) -> Result<ServoRows, String> {
    let code: Vec<&str> = text.lines().map(|line| line.split('#').next().unwrap_or_default().trim()).collect();
    let begin = code.iter().position(|line| *line == BEGIN).unwrap_or(0);
    let (head, rest) = code.split_at(begin);
    let stated = |name: &str| {
        let pairs = head.iter().filter_map(|line| line.split_once('='));
        pairs.filter(|(own, _)| own.trim().replace(' ', "") == name).map(|(_, value)| value.trim()).next_back()
    };
    for (name, due) in [("Tabletype", "3"), ("Functiontype", "1")] {
        match stated(name) {
            Some(found) if found == due => {}
            Some(found) => {
                return Err(format!("its {name} is {found}: only {due}, one column with straight lines, is read"));
            }
            None => return Err(format!("it does not state its {name}")),
        }
    }
    let lines: Vec<&str> = rest.iter().skip(1).copied().filter(|line| !line.is_empty()).collect();
    let Some((&END, lines)) = lines.split_last() else { return Err(format!("it has no end ({END})")) };
    let position = |line: &&str| {
        let number = finite(&line.replace(',', "."))
            .ok_or_else(|| format!("`{}` is not a position", line.chars().take(40).collect::<String>()));
        number.map(|number| TEN_THOUSANDTH * number)
    };
    let positions: Vec<f64> = lines.iter().map(position).collect::<Result<_, _>>()?;
    if stated("Lines").and_then(finite) != Some(count(positions.len())) || positions.len() > MOST_ROWS {
        return Err(format!("it states another number of Lines than {}", positions.len()));
    }
    let closed = positions.iter().chain(positions.first()).enumerate();
    let row = |(index, position): (usize, &f64)| [360.0 * count(index) / count(positions.len()), *position, 0.0, 0.0];
    let rows = closed.map(row).collect();
    Ok(ServoRows { swings: text.contains(SWINGS), straight: true, units: LengthUnit::Millimetre, rows })
}

/// The points `(name := value, …)` of a declaration; comments are skipped.
fn points(text: &str) -> Result<ServoRows, String> {
    let (mut code, mut comments, mut rest) = (String::new(), String::new(), text);
    while let Some((before, after)) = rest.split_once("(*") {
        code.push_str(before);
        let (comment, behind) = after.split_once("*)").ok_or("a comment does not end")?;
        comments.push_str(comment);
        rest = behind;
    }
    code.push_str(rest);
    let names = NAMES.iter().find(|names| code.contains(names[0])).ok_or("it has no points")?;
    let mut read = ServoRows { swings: comments.contains(SWINGS), ..ServoRows::default() };
    for part in code.split('(').skip(1) {
        let Some((inside, _)) = part.split_once(')') else { continue };
        let value = |name: &str| {
            let mut fields = inside.split(',').filter_map(|field| field.split_once(":="));
            fields.find(|(own, _)| own.trim() == name).and_then(|(_, value)| finite(value))
        };
        if inside.contains(names[0]) {
            let all = names.map(value);
            let [Some(x), Some(y), Some(v), Some(a)] = all else {
                return Err(format!("point {} has not four numbers", read.rows.len() + 1));
            };
            read.rows.push([x, y, v, a]);
        }
    }
    declared(&code, &read.rows)?;
    let bounds = code.split("ARRAY[").nth(1).and_then(|rest| rest.split_once(']')).map(|(bounds, _)| bounds);
    let bounds = bounds.and_then(|bounds| bounds.split_once("..")).ok_or("the array has no bounds")?;
    match (bounds.0.trim().parse::<usize>(), bounds.1.trim().parse::<usize>()) {
        (Ok(first), Ok(last)) if last + 1 == first + read.rows.len() => {
            let inches = comments.contains(INCHES);
            Ok(read.scaled(if inches { LengthUnit::Inch } else { LengthUnit::Millimetre }))
        }
        _ => Err(format!("the array is declared for another number of points than {}", read.rows.len())),
    }
}

/// Whether what a declaration says of its points is so: their kind, their number, the turn, and the order of the points.
fn declared(code: &str, rows: &[[f64; 4]]) -> Result<(), String> {
    let values = |name: &'static str| {
        let is_name = move |before: &str| before.trim_end().ends_with(name);
        let parts: Vec<&str> = code.split(":=").collect();
        let pairs: Vec<(&str, &str)> = parts.iter().copied().zip(parts.iter().copied().skip(1)).collect();
        let value =
            |after: &str| after.trim_start().split([',', ')', ';']).next().unwrap_or_default().trim().to_owned();
        pairs.into_iter().filter(|(before, _)| is_name(before)).map(|(_, after)| value(after)).collect::<Vec<String>>()
    };
    let last = rows.last().map_or(f64::NAN, |row| row[0]);
    let numbers =
        [("xStart", rows.first().map_or(f64::NAN, |row| row[0])), ("xEnd", last), ("nElements", count(rows.len()))];
    for (name, due) in numbers {
        if let Some(wrong) = values(name).iter().find(|value| finite(value) != Some(due)) {
            return Err(format!("{name} is {wrong}, and the points have {due}"));
        }
    }
    let words = [
        ("byType", "SMC_CAM_TYPE.XYVA"),
        ("FunctionType", "MOTIONFUNCTYPE_POLYNOM5_MM"),
        ("PointType", "MOTIONPOINTTYPE_MOTION"),
    ];
    for (name, due) in words {
        if let Some(wrong) = values(name).iter().find(|value| *value != due) {
            return Err(format!("{name} is {wrong}, and the points are those of {due}"));
        }
    }
    let numbered = |name: &'static str, due: fn(usize, usize) -> usize| {
        let found = values(name);
        let total = found.len();
        let wrong = found.iter().enumerate().find(|(index, value)| finite(value) != Some(count(due(*index, total))));
        wrong.map_or(Ok(()), |(index, value)| Err(format!("{name} of point {} is {value}", index + 1)))
    };
    numbered("PointIndex", |index, _| index + 1)?;
    numbered("RelIndexNextPoint", |index, total| usize::from(index + 1 < total))
}

#[expect(clippy::cast_precision_loss, reason = "at most a million points")]
fn count(number: usize) -> f64 {
    number as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_read_as_they_are_written_by_anybody() {
        let csv =
            "# a head\nmaster_deg,slave_deg,velocity_deg_per_deg,acceleration_deg_per_deg2\n0,1,2,3\n90.5,-1e-3,0,4\n";
        let rows = vec![[0.0, 1.0, 2.0, 3.0], [90.5, -1e-3, 0.0, 4.0]];
        assert_eq!(read(csv.as_bytes()), Ok(ServoRows { swings: true, rows: rows.clone(), ..ServoRows::default() }));
        let st = "(* slave: mm *)\nVAR_GLOBAL\nA : ARRAY[0..1] OF SMC_CAMXYVA := [(dX := 0, dY:=1, dV:= 2 ,dA := 3),\n\
                  (dX := 90.5, dY := -1E-3, dV := 0, dA := 4)];\nEND_VAR\n";
        assert_eq!(read(st.as_bytes()), Ok(ServoRows { rows, ..ServoRows::default() }));
        let inches = read(st.replace("slave: mm", "slave: in;").as_bytes()).expect("a table in inches");
        assert_eq!(inches.rows[0], [0.0, 25.4, 50.8, 25.4 * 3.0]);
        assert!(is_servo(st.as_bytes()) && is_servo(csv.as_bytes()) && !is_servo(b"x_mm,y_mm\n"));
        for (from, to, why) in [
            ("0..1", "0..2", "another number"),
            ("90.5", "-1", "ascend"),
            ("dA := 4", "dA := x", "four numbers"),
            ("*)", "", "comment"),
        ] {
            let found = read(st.replace(from, to).as_bytes());
            assert!(found.as_ref().is_err_and(|found| found.contains(why)), "{from}: {found:?}");
        }
        assert!(read(csv.replace("90.5", "NaN").as_bytes()).is_err());
    }

    #[test]
    fn a_table_of_equal_parts_is_read_in_its_units_and_closes() {
        let text = "Tablename = A # name\nTable-ID = 402\nTabletype = 3\nFunctiontype = 1 # LINEAR\nLines = 2 # slave: mm\nBegintable\n0\n15000,5\nEndTable\n";
        let read_rows = read(text.as_bytes()).expect("a table");
        assert_eq!(read_rows.rows, [[0.0, 0.0, 0.0, 0.0], [180.0, 1.50005, 0.0, 0.0], [360.0, 0.0, 0.0, 0.0]]);
        assert!(read_rows.straight && !read_rows.swings && is_servo(text.as_bytes()));
        for (from, to, why) in [
            ("Lines = 2", "Lines = 3", "another number"),
            ("Functiontype = 1", "Functiontype = 5", "Functiontype is 5"),
            ("Tabletype = 3\n", "", "Tabletype"),
            ("EndTable", "", "no end"),
            ("15000,5", "x", "not a position"),
        ] {
            let found = read(text.replace(from, to).as_bytes());
            assert!(found.as_ref().is_err_and(|found| found.contains(why)), "{to}: {found:?}");
        }
    }
}
