//! Points measured on a cam, from a table: x and y, or angle and radius.

use camgen_kernel::document::{HeadingUnit, NamedChoice, is_diameter, is_lift, parts};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::refusal::Refusal;
use camgen_kernel::units::Dimension;
use nalgebra::Vector2;

/// Most rows that are read, and the largest coordinate, mm.
const MOST_ROWS: usize = 200_000;
const LARGEST: f64 = 1e5;
/// Fewest points with which anything can be compared.
const FEWEST: usize = 8;
/// Characters of a cell that a message repeats.
const REPEATED: usize = 20;
/// Radii nearer than this are one, mm.
const SAME_RADIUS: f64 = 1e-6;
/// Millimetres in an inch.
const INCH: f64 = 25.4;
/// What the head of the table of a gauge follower begins with, and its columns of angles, distances and lifts in either unit.
const GAUGE_FOLLOWER: &str = "gauge_follower:";
const GAUGE_COLUMNS: [([&str; 3], f64); 2] =
    [(["cam_deg", "distance_mm", "lift_mm"], 1.0), (["cam_deg", "distance_in", "lift_in"], INCH)];

/// Which columns have the points, and what their numbers are in millimetres or radians.
#[derive(Debug, Clone, Copy, PartialEq)]
enum PointColumns {
    /// x and y, each by its column and its unit in mm.
    Plane([(usize, f64); 2]),
    /// Angle, by its unit in rad, and radius.
    Polar([(usize, f64); 2]),
}

/// The curve on which points lie.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PointsOf {
    /// The profile.
    Profile,
    /// The path of the roller's centre.
    Centre,
    /// The path of the centre of a cutter or wheel.
    Tool,
    /// The path of the ball of a gauge, by the angle against the rotation of the cam.
    Gauge,
}

impl NamedChoice for PointsOf {
    const ALL: &'static [(&'static str, Self)] =
        &[("profile", Self::Profile), ("centre", Self::Centre), ("center", Self::Centre)];
}

/// Properties of a table of points.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PointsStated {
    /// Its headings name the columns of points.
    pub has_columns: bool,
    /// It has angles and radii.
    pub is_polar: bool,
    /// On which curve they lie, by the head of a file of camgen or the headings of the columns that are read.
    pub of: Option<PointsOf>,
    /// Radius of the cutter, wheel or ball on whose path they lie, mm, by that head.
    pub tool: Option<f64>,
    /// The cam turns counter-clockwise, by that head, and angles are against its rotation.
    pub turns_back: bool,
}

impl PointsStated {
    /// Radius (mm) of the ball whose centres the points are: as given, or as the table states that of its cutter, wheel or gauge.
    ///
    /// # Errors
    /// [`Refusal`] where the two differ, or the table has such points and nobody states the radius.
    pub fn ball(&self, given: Option<f64>) -> Result<Option<f64>, Refusal> {
        let curve = match self.of {
            Some(PointsOf::Tool) => "the path of the centre of a cutter or wheel",
            Some(PointsOf::Gauge) => "the path of the ball of a gauge",
            _ => return Ok(given),
        };
        match (given, self.tool) {
            (Some(given), Some(stated)) if (given - stated).abs() > SAME_RADIUS => {
                let what =
                    format!("the table gives {curve} of radius {stated} mm by its head, but --ball is {given} mm");
                Err(Refusal::new(what).remedy("leave --ball out"))
            }
            (None, None) => {
                let what = format!("the table gives {curve} by its head, but not the radius");
                Err(Refusal::new(what).remedy("give the radius with --ball"))
            }
            (given, stated) => Ok(stated.or(given)),
        }
    }
}

/// Reads the properties of a table from its headings, and from its head if camgen wrote it.
#[must_use]
pub fn stated(text: &str) -> PointsStated {
    let text = text.trim_start_matches('\u{feff}');
    let head = |key: &str| text.lines().find_map(|line| line.strip_prefix('#')?.trim().strip_prefix(key));
    let lines = || text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
    let first: Vec<(usize, &str)> = lines().take(1).map(|line| (1, line)).collect();
    let names: Vec<String> = first
        .first()
        .map_or_else(Vec::new, |(_, line)| split(line, separator_of(&first)).into_iter().map(str::to_owned).collect());
    let columns = named(&names).ok();
    let is_polar = matches!(columns, Some(PointColumns::Polar(_)));
    let has_columns = columns.is_some();
    let read = match columns {
        Some(PointColumns::Plane([(x, _), (y, _)])) => vec![x, y],
        Some(PointColumns::Polar([_, (radius, _)])) => vec![radius],
        None => Vec::new(),
    };
    let by_heading = || read.iter().filter_map(|at| names.get(*at)).find_map(|name| of_words(name));
    let gauge = head(GAUGE_FOLLOWER);
    let is_gauge = gauge.is_some() || gauge_columns(&names).is_some();
    let given = head("given:");
    let of = if is_gauge { Some(PointsOf::Gauge) } else { given.and_then(of_words).or_else(by_heading) };
    let tool = match gauge {
        Some(follower) => follower.split_once("diameter_").and_then(|(_, size)| in_unit(size)).map(|size| 0.5 * size),
        None => given.and_then(stated_radius).filter(|_| of == Some(PointsOf::Tool)),
    };
    let turns_back = is_polar && head("rotation:").is_some_and(|rotation| rotation.contains("counter-clockwise"));
    PointsStated { has_columns, is_polar, of, tool, turns_back }
}

/// The radius (mm) that the head of a file of points states of a roller, a cutter or a wheel: `of radius 15.0 mm`.
#[must_use]
pub fn stated_radius(given: &str) -> Option<f64> {
    let mut words = given.split_once("radius ")?.1.split([' ', ',']);
    let number = words.next()?.parse::<f64>().ok()?;
    Some(number * if words.next() == Some("in") { INCH } else { 1.0 })
}

/// A length behind its unit, `mm 3`, in mm.
fn in_unit(text: &str) -> Option<f64> {
    let (unit, number) = text.trim().split_once(' ')?;
    let size = match unit {
        "mm" => 1.0,
        "in" => INCH,
        _ => return None,
    };
    number.trim().parse::<f64>().ok().filter(|number| *number > 0.0).map(|number| number * size)
}

/// The curve named in `words`.
fn of_words(text: &str) -> Option<PointsOf> {
    let lower = text.to_lowercase();
    let has = |words: &[&str]| words.iter().any(|word| lower.contains(word));
    if has(&["cutter", "wheel"]) {
        Some(PointsOf::Tool)
    } else if has(&["centre", "center", "pitch", "roller", "mittelpunkt"]) {
        Some(PointsOf::Centre)
    } else {
        has(&["profile", "profil", "contour", "kontur", "surface"]).then_some(PointsOf::Profile)
    }
}

/// The points of a table, mm, with the line of each.
///
/// Columns are separated by semicolons, tabs, commas or blanks; with semicolons or tabs a number may have a decimal comma. A line of names says which
/// columns are `x` and `y`, or `angle` (`polar`, `phi`) and `radius` (`r`), with a unit behind the name (`x_mm`, `x in`, `angle_rad`); millimetres and
/// degrees where none is given. Without names the first two columns are x and y, the second and the third where the first counts the rows. Lines that
/// begin with # are left out.
///
/// # Errors
/// [`Refusal`] with the line of the first cell that is no number, or when there are too few points or too many.
pub fn read(text: &str) -> Result<Vec<Vector2<f64>>, Refusal> {
    read_rows(text, false)
}

/// The points of a table whose first two columns are angles in degrees and radii in millimetres, or as its headings say. Headings of two columns need not
/// name them.
///
/// # Errors
/// As [`read`].
pub fn read_radii(text: &str) -> Result<Vec<Vector2<f64>>, Refusal> {
    read_rows(text, true)
}

fn read_rows(text: &str, radii: bool) -> Result<Vec<Vector2<f64>>, Refusal> {
    // The mark that some programs put before UTF-8.
    let text = text.trim_start_matches('\u{feff}');
    if text.lines().any(|line| line.starts_with('#') && line.contains(GAUGE_FOLLOWER) && line.contains("flat")) {
        let what = "the table has distances of the flat face of a gauge, which are not those of points";
        return Err(Refusal::new(what).remedy("import its lifts: --columns cam_deg,lift_mm --follower flat"));
    }
    let lines = text.lines().enumerate().map(|(index, line)| (index + 1, line.trim()));
    let lines: Vec<(usize, &str)> = lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('#')).collect();
    let separator = separator_of(&lines);
    let cells = |line: &str| -> Vec<String> { split(line, separator).into_iter().map(str::to_owned).collect() };
    let (names, rows) = match lines.split_first() {
        Some(((_, first), rest)) if cells(first).iter().any(|cell| number(cell).is_none()) => {
            (Some(cells(first)), rest)
        }
        _ => (None, &lines[..]),
    };
    if rows.len() > MOST_ROWS {
        return Err(Refusal::new(format!("the table has more than {MOST_ROWS} rows")).remedy("measure fewer points"));
    }
    let columns = match &names {
        Some(names) => named(names).or_else(|why| two_columns(names).filter(|_| radii).ok_or(why))?,
        None if radii => PointColumns::Polar([(0, 1.0_f64.to_radians()), (1, 1.0)]),
        None => PointColumns::Plane(if counts(rows, separator) { [(1, 1.0), (2, 1.0)] } else { [(0, 1.0), (1, 1.0)] }),
    };
    let points = rows.iter().map(|(line, text)| point(&cells(text), columns, *line));
    let points = points.collect::<Result<Vec<_>, _>>()?;
    if points.len() < FEWEST {
        let what = format!("the table has {} points", points.len());
        return Err(Refusal::new(what).remedy(format!("give at least {FEWEST}, all round the cam")));
    }
    Ok(points)
}

/// Whether a table is one of points rather than of lifts, where nobody says so: by the names of its columns, or, without names, because its first
/// column goes back and forth through 0 as x does. The table of a cam itself has both; a follower that is given (`rolled`) is there to be rolled.
#[must_use]
pub fn looks_like_points(text: &str, rolled: bool) -> bool {
    let text = text.trim_start_matches('\u{feff}');
    let lines: Vec<(usize, &str)> = text
        .lines()
        .enumerate()
        .map(|(index, line)| (index + 1, line.trim()))
        .filter(|(_, line)| !line.is_empty() && !line.starts_with('#'))
        .collect();
    let separator = separator_of(&lines);
    let Some((_, first)) = lines.first() else { return false };
    let names: Vec<String> = split(first, separator).into_iter().map(str::to_owned).collect();
    if names.iter().any(|cell| number(cell).is_none()) {
        let both = names.iter().any(|name| name.contains("cam_deg"));
        let lift =
            names.iter().any(|name| ["lift", "position", "rise"].iter().any(|word| name.to_lowercase().contains(word)));
        return named(&names).is_ok() && (rolled || !(both && lift));
    }
    let at = usize::from(counts(&lines, separator));
    let column: Vec<f64> = lines.iter().filter_map(|(_, line)| number(split(line, separator).get(at)?)).collect();
    let way = |up: bool| column.iter().zip(column.iter().skip(1)).filter(|(a, b)| (b > a) == up && a != b).count();
    let signs = column.iter().any(|x| *x > 0.0) && column.iter().any(|x| *x < 0.0);
    signs && way(true).min(way(false)) * 8 > column.len()
}

fn separator_of(lines: &[(usize, &str)]) -> Option<char> {
    [';', '\t', ','].into_iter().find(|sign| lines.first().is_some_and(|(_, line)| line.contains(*sign)))
}

fn split(line: &str, separator: Option<char>) -> Vec<&str> {
    match separator {
        Some(sign) => parts(line, sign).into_iter().map(str::trim).collect(),
        None => line.split_whitespace().collect(),
    }
}

/// The number of a cell, with a decimal point or, which between commas only a cell in quotes can have, a decimal comma.
fn number(cell: &str) -> Option<f64> {
    cell.trim_matches('"').replace(',', ".").parse::<f64>().ok().filter(|value| value.is_finite())
}

/// Whether the first of three columns or more counts the rows.
fn counts(rows: &[(usize, &str)], separator: Option<char>) -> bool {
    let first = |text: &str| number(split(text, separator).first()?);
    let wide = rows.first().is_some_and(|(_, text)| split(text, separator).len() > 2);
    let all: Vec<Option<f64>> = rows.iter().map(|(_, text)| first(text)).collect();
    let by_one = |pair: &[Option<f64>]| matches!(pair, [Some(a), Some(b)] if *b - *a == 1.0);
    wide && all.windows(2).all(by_one)
}

/// Words behind the name of a column that say nothing else than that it is measured.
const MEASURED_WORDS: [&str; 6] = ["act", "actual", "measured", "meas", "ist", "pos"];

/// The angles and distances of the table of a gauge follower, by the names of its columns.
fn gauge_columns(names: &[String]) -> Option<PointColumns> {
    let (_, size) = GAUGE_COLUMNS.iter().find(|(columns, _)| columns.iter().eq(names.iter()))?;
    Some(PointColumns::Polar([(0, 1.0_f64.to_radians()), (1, *size)]))
}

/// The two columns of a table that is said to have radii, by the units in their headings; `None` where a heading says something else.
fn two_columns(names: &[String]) -> Option<PointColumns> {
    let [angle, radius] = names else { return None };
    if is_lift(radius) || is_diameter(radius) {
        return None;
    }
    let size = |name: &str, wanted: Dimension| match HeadingUnit::read(name) {
        Ok(Some(HeadingUnit::Quantity { dimension, size, .. })) if dimension == wanted => Some(Some(size)),
        Ok(None) => Some(None),
        _ => None,
    };
    let of_angle = size(angle, Dimension::Angle)?.unwrap_or(1.0_f64.to_radians());
    let of_radius = size(radius, Dimension::Length)?.map_or(1.0, |size| MILLIMETRES * size);
    Some(PointColumns::Polar([(0, of_angle), (1, of_radius)]))
}

/// The columns by their names.
fn named(names: &[String]) -> Result<PointColumns, Refusal> {
    if let Some(columns) = gauge_columns(names) {
        return Ok(columns);
    }
    let plain: Vec<String> = names.iter().map(|name| name.trim_matches('"').trim().to_lowercase()).collect();
    // The table of a cam itself has its profile among other places.
    let own = |name: &str, size: f64| plain.iter().position(|other| other == name).map(|index| (index, size));
    for (x, y, size) in [("profile_x_mm", "profile_y_mm", 1.0), ("profile_x_in", "profile_y_in", INCH)] {
        if let (Some(x), Some(y)) = (own(x, size), own(y, size)) {
            return Ok(PointColumns::Plane([x, y]));
        }
    }
    let length: &[(&str, f64)] = &[("mm", 1.0), ("in", INCH), ("inch", INCH), ("\"", INCH)];
    let angle: &[(&str, f64)] = &[("deg", 1.0_f64.to_radians()), ("°", 1.0_f64.to_radians()), ("rad", 1.0)];
    let find = |words: &[&str], units: &[(&str, f64)]| column(&plain, words, units);
    if let (Some(x), Some(y)) = (find(&["x"], length)?, find(&["y"], length)?) {
        return Ok(PointColumns::Plane([x, y]));
    }
    let at = find(&["angle", "polar", "phi", "psi", "theta", "winkel", "cam", "deg"], angle)?;
    let radius = match find(&["radius", "r"], length)? {
        None => {
            find(&["pitch", "profile", "profil", "roller", "centre", "center", "contour", "radial", "rho"], length)?
        }
        found => found,
    };
    if let (Some(at), Some(radius)) = (at, radius) {
        return Ok(PointColumns::Polar([at, radius]));
    }
    let shown: Vec<&str> = names.iter().map(String::as_str).take(8).collect();
    let what = format!("the table has no columns of points among {}", shown.join(", "));
    Err(Refusal::new(what).remedy("name them x and y, or angle and radius"))
}

/// The one column whose name is one of these words, with a unit or a word for what is measured behind it, and its unit; the first unit is that of a
/// name without one.
fn column(plain: &[String], words: &[&str], units: &[(&str, f64)]) -> Result<Option<(usize, f64)>, Refusal> {
    let mut found = Vec::new();
    let mut strange = None;
    for (index, name) in plain.iter().enumerate() {
        let mut parts = name
            .split(|sign: char| !(sign.is_alphanumeric() || sign == '"' || sign == '°'))
            .filter(|part| !part.is_empty());
        if !parts.next().is_some_and(|first| words.contains(&first)) {
            continue;
        }
        let rest: Vec<&str> = parts
            .filter(|part| !MEASURED_WORDS.contains(part) && !["radius", "angle", "polar"].contains(part))
            .collect();
        let unit = match rest.as_slice() {
            [] => units.first().map(|(_, size)| *size),
            [unit] => units.iter().find(|(word, _)| word == unit).map(|(_, size)| *size),
            _ => None,
        };
        match unit {
            Some(unit) => found.push((index, unit)),
            None => strange = Some(name.clone()),
        }
    }
    let known: Vec<&str> = units.iter().map(|(word, _)| *word).collect();
    match (found.as_slice(), strange) {
        ([one], _) => Ok(Some(*one)),
        ([], None) => Ok(None),
        ([], Some(name)) => {
            let what = format!("the column `{name}` has no unit that is known, or is not what was measured");
            Err(Refusal::new(what).remedy(format!(
                "name it {0}, or {0} with {1}",
                words.first().unwrap_or(&"x"),
                known.join(", ")
            )))
        }
        _ => {
            let what = format!("several columns are named {}", words.join(" or "));
            Err(Refusal::new(what).remedy("keep those of the measured points"))
        }
    }
}

fn point(cells: &[String], wanted: PointColumns, line: usize) -> Result<Vector2<f64>, Refusal> {
    let cell = |(index, unit): (usize, f64)| {
        let text = cells.get(index).map_or("", String::as_str);
        number(text).map(|value| value * unit).ok_or_else(|| {
            let shown: String = text.chars().take(REPEATED).collect();
            let what = if text.is_empty() {
                format!("a row has {} columns, and column {} is needed", cells.len(), index + 1)
            } else {
                format!("`{shown}` is not a number")
            };
            Refusal::new(what).at(format!("line {line}")).remedy("give a number in each row, or begin the line with #")
        })
    };
    let found = match wanted {
        PointColumns::Plane([x, y]) => Vector2::new(cell(x)?, cell(y)?),
        PointColumns::Polar([at, radius]) => {
            let (sin, cos) = libm::sincos(cell(at)?);
            Vector2::new(cos, sin) * cell(radius)?
        }
    };
    if found.norm() > LARGEST {
        let what = format!("a point is {:.3e} mm from the shaft", found.norm());
        return Err(Refusal::new(what).at(format!("line {line}")).remedy("give millimetres"));
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROWS: [[f64; 2]; 8] =
        [[1.0, 2.0], [3.0, 4.5], [5.0, 6.0], [7.0, 8.0], [9.0, 1.0], [2.0, 3.0], [4.0, 5.0], [6.0, 7.0]];

    fn written(head: &str, row: impl Fn(usize, [f64; 2]) -> String) -> String {
        let rows = ROWS.iter().enumerate().map(|(index, pair)| row(index, *pair));
        std::iter::once(head.to_owned()).chain(rows).collect::<Vec<_>>().join("\n")
    }

    #[test]
    fn tables_are_read_in_the_forms_in_which_people_have_them() {
        let expected: Vec<Vector2<f64>> = ROWS.iter().map(|[x, y]| Vector2::new(*x, *y)).collect();
        for text in [
            written("# measured", |_, [x, y]| format!("{x} {y}")),
            written("", |_, [x, y]| format!("{x}, {y}")),
            written("", |index, [x, y]| format!("{} {x} {y}", index + 1)),
            written("no,x_mm,y_mm,dev", |index, [x, y]| format!("{index},{x},{y},0.1")),
            written("x;y", |_, [x, y]| format!("{x};{y}").replace('.', ",")),
            written("Y (mm)\tX (mm)", |_, [x, y]| format!("{y}\t{x}").replace('.', ",")),
            written("\u{feff}x_nom,y_nom,x_act,y_act", |_, [x, y]| format!("1,2,{x},{y}")),
            written("x_in,y_in", |_, [x, y]| format!("{},{}", x / INCH, y / INCH)),
            written("polar_deg,radius_mm", |_, [x, y]| {
                format!("{},{}", libm::atan2(y, x).to_degrees(), libm::hypot(x, y))
            }),
        ] {
            let found = read(&text).unwrap_or_else(|error| panic!("{text}: {error}"));
            let off = found.iter().zip(&expected).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
            assert!(found.len() == expected.len() && off < 1e-12, "{text}: {found:?}");
        }
    }

    #[test]
    fn what_is_no_table_of_points_is_refused_with_its_line() {
        for (text, told) in [
            (written("x,y", |index, [x, y]| if index == 3 { "7,eight".into() } else { format!("{x},{y}") }), "line 5"),
            (written("x,y", |index, [x, y]| if index == 2 { "5".into() } else { format!("{x},{y}") }), "line 4"),
            ("1 2\n3 4\n".to_owned(), "2 points"),
            (written("a,b", |_, [x, y]| format!("{x},{y}")), "no columns of points"),
            (written("x,y", |_, [x, _]| format!("{x},1e9")), "from the shaft"),
            (written("x_um,y_um", |_, [x, y]| format!("{x},{y}")), "`x_um`"),
            (written("x,y,x_mm,y_mm", |_, [x, y]| format!("{x},{y},{x},{y}")), "several columns"),
        ] {
            let error = read(&text).expect_err("refused").to_string();
            assert!(error.contains(told), "{error}");
        }
    }
}
