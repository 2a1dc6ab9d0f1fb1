//! Reads tables for servo drives: rows of a CSV file, or the points of a declaration in structured text.

/// A table as it was read: master in degrees, slave in mm or degrees, velocity and acceleration by the master.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ServoRows {
    /// Whether the slave is in degrees, where the file says so.
    pub swings: bool,
    /// The rows.
    pub rows: Vec<[f64; 4]>,
}

/// The names of the four numbers of a point in the structures of CODESYS and TwinCAT.
const NAMES: [[&str; 4]; 2] = [["dX", "dY", "dV", "dA"], ["MasterPos", "SlavePos", "SlaveVelo", "SlaveAcc"]];
/// What the header of a CSV table begins with.
const CSV_HEAD: &str = "master_deg,slave_";
/// The columns of a table of a slave in mm, and of one in degrees.
const CSV_HEADS: [&str; 2] = [
    "master_deg,slave_mm,velocity_mm_per_deg,acceleration_mm_per_deg2",
    "master_deg,slave_deg,velocity_deg_per_deg,acceleration_deg_per_deg2",
];
/// What a head says of a slave in degrees.
const SWINGS: &str = "slave: deg";
/// Most rows.
const MOST_ROWS: usize = 1_000_000;

/// Whether bytes are a table for a servo drive.
#[must_use]
pub fn is_servo(bytes: &[u8]) -> bool {
    let text = String::from_utf8_lossy(bytes);
    text.lines().take(60).any(|line| {
        let line = line.trim_start();
        line.starts_with(CSV_HEAD) || line.contains("SMC_CAMXYVA") || line.contains("MC_MotionFunctionPoint")
    })
}

/// Reads a table.
///
/// # Errors
/// A sentence when it is not one, or its master does not ascend.
pub fn read(bytes: &[u8]) -> Result<ServoRows, String> {
    let text = std::str::from_utf8(bytes).map_err(|error| error.to_string())?;
    let csv = text.lines().any(|line| line.starts_with(CSV_HEAD));
    let read = if csv { rows(text)? } else { points(text)? };
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
    let mut read = ServoRows::default();
    for line in text.lines().filter(|line| !line.starts_with('#') && !line.is_empty()) {
        if line.starts_with(CSV_HEAD) {
            read.swings = line == CSV_HEADS[1];
            if !CSV_HEADS.contains(&line) {
                return Err(format!("its columns are not {}", CSV_HEADS.join(" or ")));
            }
            continue;
        }
        let cells: Vec<Option<f64>> = line.split(',').map(finite).collect();
        match cells.as_slice() {
            [Some(x), Some(y), Some(v), Some(a)] if read.rows.len() < MOST_ROWS => read.rows.push([*x, *y, *v, *a]),
            _ => return Err(format!("`{}` is not a row of four numbers", line.chars().take(60).collect::<String>())),
        }
    }
    Ok(read)
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
    let mut read = ServoRows { swings: comments.contains(SWINGS), rows: Vec::new() };
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
        (Ok(first), Ok(last)) if last + 1 == first + read.rows.len() => Ok(read),
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
        assert_eq!(read(csv.as_bytes()), Ok(ServoRows { swings: true, rows: rows.clone() }));
        let st = "(* slave: mm *)\nVAR_GLOBAL\nA : ARRAY[0..1] OF SMC_CAMXYVA := [(dX := 0, dY:=1, dV:= 2 ,dA := 3),\n\
                  (dX := 90.5, dY := -1E-3, dV := 0, dA := 4)];\nEND_VAR\n";
        assert_eq!(read(st.as_bytes()), Ok(ServoRows { swings: false, rows }));
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
}
