//! Reads lists of places for a measuring machine: the CSV file, plain lines of numbers, and DMIS (ISO 22093).

use camgen_kernel::units::LengthUnit;
use nalgebra::Vector2;

/// A place as it was read, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReadPlace {
    /// Cam angle, degrees; of a form without it that of its number among all places.
    pub cam_deg: f64,
    /// The place.
    pub point: Vector2<f64>,
    /// The normal.
    pub normal: Vector2<f64>,
    /// The centre of the ball; the place itself in a form without a ball.
    pub ball: Vector2<f64>,
    /// How far the profile may lie along the normal, where the form has it.
    pub zone: Option<[f64; 2]>,
    /// Radius of curvature of the profile, where the form has it.
    pub curvature_radius: Option<f64>,
}

/// What the header of a list begins with.
const HEAD: &str = "no,cam_deg,polar_deg,radius_mm,x_mm,y_mm,normal_x,normal_y,ball_x_mm,ball_y_mm,";
/// The header of a list in inches.
const INCH_HEAD: &str = "no,cam_deg,polar_deg,radius_in,x_in,y_in,normal_x,normal_y,ball_x_in,ball_y_in,";
/// The columns behind them, of which a list may have none.
const OTHER_COLUMNS: [&str; 3] = ["lower", "upper", "curvature_radius"];
/// The line that plain lines of numbers in inches begin with.
pub(super) const PLAIN_INCHES: &str = "# units: inches";
/// The statement that begins a DMIS program.
const DMIS: &str = "DMISMN/";
/// Most places.
const MOST_PLACES: usize = 100_000;
/// Numbers of six decimals that differ by less are equal.
const SAME: f64 = 1e-6;

/// Whether bytes are a list, in any of its forms.
pub(super) fn is_inspection(bytes: &[u8]) -> bool {
    let text = String::from_utf8_lossy(bytes);
    let Some(first) = text.lines().map(str::trim).find(|line| !line.is_empty() && !line.starts_with(['#', '$'])) else {
        return false;
    };
    first.starts_with(HEAD)
        || first.starts_with(INCH_HEAD)
        || first.starts_with(DMIS)
        || plain(first).is_some_and(|place| place[0] == 1.0)
}

/// Reads a list.
///
/// # Errors
/// A sentence when it is not one.
pub fn read(bytes: &[u8]) -> Result<Vec<ReadPlace>, String> {
    let text = std::str::from_utf8(bytes).map_err(|error| error.to_string())?;
    let mut lines = text.lines().filter(|line| !line.starts_with('#') && !line.trim().is_empty());
    let all = match lines.next() {
        Some(line) if line.starts_with(HEAD) => {
            refuse_other_columns(line, HEAD, LengthUnit::Millimetre)?;
            rows(lines, LengthUnit::Millimetre)?
        }
        Some(line) if line.starts_with(INCH_HEAD) => {
            refuse_other_columns(line, INCH_HEAD, LengthUnit::Inch)?;
            rows(lines, LengthUnit::Inch)?
        }
        Some(_) if text.lines().any(|line| line.trim_start().starts_with(DMIS)) => dmis(text)?,
        Some(line) if plain(line).is_some() => {
            let inches = text.lines().any(|line| line.trim_end() == PLAIN_INCHES);
            let units = if inches { LengthUnit::Inch } else { LengthUnit::Millimetre };
            in_millimetres(numbered(std::iter::once(line).chain(lines))?, units)
        }
        _ => return Err("the line that names the columns is missing".into()),
    };
    if all.len() > MOST_PLACES { Err(format!("it has more than {MOST_PLACES} places")) } else { Ok(all) }
}

/// Refuses a header that goes on with other columns than those of a list, or in another unit than it begins.
fn refuse_other_columns(line: &str, begin: &str, units: LengthUnit) -> Result<(), String> {
    let others = line.strip_prefix(begin).unwrap_or_default().trim_end();
    let names = others.split(',').filter(|name| !name.is_empty());
    let due = OTHER_COLUMNS.map(|name| format!("{name}_{}", units.symbol()));
    match names.zip(&due).find(|(name, due)| name != due) {
        Some((name, due)) => Err(format!("the column `{}` stands where `{due}` belongs", shortened(name))),
        None => Ok(()),
    }
}

/// Places that were read in a unit.
fn in_millimetres(mut all: Vec<ReadPlace>, units: LengthUnit) -> Vec<ReadPlace> {
    let scale = units.millimetres();
    for place in &mut all {
        place.point *= scale;
        place.ball *= scale;
        place.zone = place.zone.map(|zone| zone.map(|length| scale * length));
        place.curvature_radius = place.curvature_radius.map(|radius| scale * radius);
    }
    all
}

/// The rows of the CSV file in a unit.
fn rows<'t>(lines: impl Iterator<Item = &'t str>, units: LengthUnit) -> Result<Vec<ReadPlace>, String> {
    Ok(in_millimetres(lines.enumerate().map(row).collect::<Result<_, _>>()?, units))
}

/// A row of the CSV file.
fn row((index, line): (usize, &str)) -> Result<ReadPlace, String> {
    let numbers: Option<Vec<f64>> = line.split(',').map(|cell| cell.trim().parse().ok()).collect();
    let numbers = numbers.unwrap_or_default();
    let [number, cam_deg, polar, radius, x, y, normal_x, normal_y, ball_x, ball_y, rest @ ..] = numbers.as_slice()
    else {
        return Err(format!("row {} has not the numbers of a place", index + 1));
    };
    let (sin, cos) = libm::sincos(polar.to_radians());
    let point = Vector2::new(*x, *y);
    if !counted(index, *number) || (Vector2::new(cos, sin) * *radius - point).norm() > SAME {
        return Err(format!("row {} contradicts itself", index + 1));
    }
    let (normal, ball) = (Vector2::new(*normal_x, *normal_y), Vector2::new(*ball_x, *ball_y));
    let zone = if let [lower, upper, ..] = rest { Some([*lower, *upper]) } else { None };
    Ok(ReadPlace { cam_deg: *cam_deg, point, normal, ball, zone, curvature_radius: rest.get(2).copied() })
}

/// Whether a place has the number that is due.
fn counted(index: usize, number: f64) -> bool {
    u32::try_from(index + 1).is_ok_and(|own| f64::from(own) == number)
}

/// The numbers of a plain line: number, place, normal.
fn plain(line: &str) -> Option<[f64; 7]> {
    let numbers: Option<Vec<f64>> = line.split_ascii_whitespace().map(|cell| cell.parse().ok()).collect();
    numbers?.try_into().ok()
}

/// Plain lines of numbers.
fn numbered<'t>(lines: impl Iterator<Item = &'t str>) -> Result<Vec<ReadPlace>, String> {
    let place = |(index, line): (usize, &str)| {
        let found = plain(line).filter(|numbers| counted(index, numbers[0]));
        let [_, x, y, z, i, j, k] =
            found.ok_or_else(|| format!("line {} is not a place with its number", index + 1))?;
        flat(&format!("line {}", index + 1), [x, y, z, i, j, k])
    };
    in_turn(lines.enumerate().map(place).collect::<Result<_, _>>()?)
}

/// A place in the plane of the drawing.
fn flat(what: &str, [x, y, z, i, j, k]: [f64; 6]) -> Result<ReadPlace, String> {
    if z != 0.0 || k != 0.0 || ![x, y, i, j].into_iter().all(f64::is_finite) {
        return Err(format!("{what} does not lie in the plane of the drawing"));
    }
    let point = Vector2::new(x, y);
    Ok(ReadPlace {
        cam_deg: f64::NAN,
        point,
        normal: Vector2::new(i, j),
        ball: point,
        zone: None,
        curvature_radius: None,
    })
}

/// Places without an angle: one for each equal part of a turn.
fn in_turn(mut all: Vec<ReadPlace>) -> Result<Vec<ReadPlace>, String> {
    #[expect(clippy::cast_precision_loss, reason = "at most a hundred thousand places")]
    let (count, number) = (all.len() as f64, |index: usize| index as f64);
    for (index, place) in all.iter_mut().enumerate() {
        place.cam_deg = 360.0 * number(index) / count;
    }
    Ok(all)
}

/// The points of a DMIS program: each is defined (`FEAT/POINT`) and measured in one touch (`PTMEAS`) at the same place and normal.
fn dmis(text: &str) -> Result<Vec<ReadPlace>, String> {
    let mut all: Vec<ReadPlace> = Vec::new();
    let (mut units, mut ended) = (None, false);
    // The label that is to be measured, and whether it was touched.
    let mut open: Option<(String, [f64; 6], u8)> = None;
    for (line, statement) in statements(text) {
        let refused = |why: &str| Err(format!("line {line}: {why}"));
        if ended {
            return refused("there is more behind ENDFIL");
        }
        let (word, rest) = statement.split_once('/').unwrap_or((statement.as_str(), ""));
        let cells: Vec<&str> = rest.split(',').collect();
        match (word, cells.as_slice(), &mut open) {
            ("DMISMN", _, _) => {}
            ("UNITS", _, _) if units.is_some() => return refused("the unit is stated twice"),
            ("UNITS", ["MM", ..], _) => units = Some(LengthUnit::Millimetre),
            ("UNITS", ["INCH", ..], _) => units = Some(LengthUnit::Inch),
            ("UNITS", ..) => return refused("the unit is neither the millimetre nor the inch"),
            _ if units.is_none() => return refused("the unit is not stated before it (UNITS/MM or UNITS/INCH)"),
            ("ENDFIL", _, None) => ended = true,
            (feature, ["POINT", "CART", numbers @ ..], None) if feature.ends_with("=FEAT") => {
                let label = feature.trim_end_matches("=FEAT").to_owned();
                let place = six(numbers).ok_or_else(|| format!("line {line}: a point has a place and a normal"))?;
                open = Some((label, place, 0));
            }
            ("MEAS", ["POINT", label, "1"], Some((own, _, step @ 0))) if own == label => *step = 1,
            ("PTMEAS", ["CART", numbers @ ..], Some((_, place, step @ 1))) => match six(numbers) {
                Some(touched) if touched == *place => *step = 2,
                _ => return refused("the point is touched at another place than it is defined at"),
            },
            ("ENDMES", _, Some((label, place, 2))) => {
                if *label != format!("F(P{})", all.len() + 1) {
                    return Err(format!("line {line}: {label} is not the next number of a point"));
                }
                all.push(flat(label, *place)?);
                open = None;
            }
            _ => {
                return Err(format!("line {line}: `{}` is not a statement of a list of points", shortened(&statement)));
            }
        }
    }
    match (units, ended && open.is_none()) {
        (Some(units), true) => Ok(in_millimetres(in_turn(all)?, units)),
        (None, _) => Err("it does not state its unit (UNITS/MM or UNITS/INCH)".into()),
        (_, false) => Err("it has no end (ENDFIL)".into()),
    }
}

/// The statements with their lines, without blanks and comments; `$` at the end of a line goes on in the next.
fn statements(text: &str) -> Vec<(usize, String)> {
    let (mut all, mut begun) = (Vec::new(), String::new());
    for (index, line) in text.lines().enumerate() {
        let line = line.split("$$").next().unwrap_or_default().trim();
        let (part, goes_on) = line.strip_suffix('$').map_or((line, false), |part| (part, true));
        begun.push_str(part);
        if !goes_on && !begun.is_empty() {
            let statement: String = begun.chars().filter(|c| !c.is_whitespace()).collect();
            all.push((index + 1, statement.to_ascii_uppercase()));
            begun.clear();
        }
    }
    all.extend((!begun.is_empty()).then_some((text.lines().count(), begun)));
    all
}

fn six(cells: &[&str]) -> Option<[f64; 6]> {
    let numbers: Option<Vec<f64>> = cells.iter().map(|cell| cell.parse().ok()).collect();
    numbers?.try_into().ok()
}

fn shortened(text: &str) -> String {
    text.chars().take(40).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const POINTS: &str = "DMISMN/'CAM',05.2\n$$ a comment\nUNITS/MM,ANGDEC\nF(P1)=FEAT/POINT,CART,10.0,0.0,0.0,$\n1.0,0.0,0.0\nMEAS/POINT,F(P1),1\n\
                          PTMEAS/CART, 10.0,0.0,0.0, 1.0,0.0,0.0\nENDMES\nF(P2)=FEAT/POINT,CART,-10.0,0.0,0.0,-1.0,0.0,0.0\nMEAS/POINT,F(P2),1\n\
                          PTMEAS/CART,-10.0,0.0,0.0,-1.0,0.0,0.0\nENDMES\nENDFIL\n";

    #[test]
    fn points_of_dmis_and_plain_lines_are_the_same_places() {
        let dmis = read(POINTS.as_bytes()).expect("points");
        let lines = read(b"1 10.0 0.0 0.0 1.0 0.0 0.0\n2 -10.0 0.0 0.0 -1.0 0.0 0.0\n").expect("points");
        assert_eq!(dmis, lines);
        assert_eq!((dmis[1].cam_deg, dmis[1].point.x, dmis[1].normal.x), (180.0, -10.0, -1.0));
        assert!(
            is_inspection(POINTS.as_bytes()) && is_inspection(b"1 10 0 0 1 0 0\n") && !is_inspection(b"  0\nSECTION\n")
        );
    }

    #[test]
    fn a_program_that_would_measure_elsewhere_is_refused_with_its_line() {
        for (from, to, why) in [
            ("UNITS/MM", "UNITS/FEET", "line 3"),
            ("UNITS/MM,ANGDEC\n", "UNITS/MM,ANGDEC\nUNITS/INCH,ANGDEC\n", "twice"),
            ("UNITS/MM,ANGDEC\n", "", "UNITS/MM"),
            ("PTMEAS/CART, 10.0", "PTMEAS/CART, 10.1", "another place"),
            ("F(P2),1", "F(P1),1", "not a statement"),
            ("ENDFIL\n", "", "ENDFIL"),
            ("F(P1)=FEAT", "D(1)=TRANS/XORIG,3\nF(P1)=FEAT", "line 4"),
            ("10.0,0.0,0.0,$\n1.0", "10.0,0.0,3.0,$\n1.0", "another place"),
        ] {
            let found = read(POINTS.replacen(from, to, 1).as_bytes());
            assert!(found.as_ref().is_err_and(|found| found.contains(why)), "{to}: {found:?}");
        }
        assert!(read(b"1 10 0 0 1 0 0\n3 9 0 0 1 0 0\n").is_err_and(|why| why.contains("line 2")));
    }
}
