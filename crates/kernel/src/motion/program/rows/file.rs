//! Rows of a file, in the forms in which people have them: which columns, in which units, shares, a list with a step.

use super::{Origin, RowPlace, Rows};
use crate::document::{
    Columns, Field, FileRow, HeadingUnit, LengthOrAngle, TableReader, UnclearHeading, derivative_in, is_lift,
    is_of_crank, is_radius,
};
use crate::motion::Quantity;
use crate::motion::program::context::ProgramContext;
use crate::motion::program::keys::{COLUMNS, LIFT, OVER_ROWS, RATIO_OF_ANGLES, SCALE, START, STEP, TABLE, UNIT};
use crate::units::{self, Dimension};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// A degree, rad.
const DEGREE: f64 = PI / 180.0;
/// Turns of a crank for each turn of the camshaft of a four-stroke engine.
const OF_CRANK: f64 = 2.0;
/// Shares may leave 0 to 1 by rounding.
const SHARE: f64 = 1e-6;

/// A unit: its symbol, and one of it in SI units or radians.
type Unit = (&'static str, f64);

fn dimension_of(quantity: Quantity) -> Dimension {
    if quantity == Quantity::Angle { Dimension::Angle } else { Dimension::Length }
}

/// The unit of `motion.start`.
fn unit_of_start(table: &TableReader<'_>, quantity: Quantity) -> Option<Unit> {
    Some(units::parse(&table.typed(&START), dimension_of(quantity)).ok()?.unit())
}

/// The units that the key `unit` gives to angles and positions.
fn units_given(table: &TableReader<'_>, quantity: Quantity) -> Option<[Option<Unit>; 2]> {
    let mut given = [None; 2];
    if !table.has(&UNIT) {
        return Some(given);
    }
    let typed = table.get(&UNIT)?;
    let words: Vec<&str> =
        typed.split(|c: char| c.is_whitespace() || matches!(c, ',' | ';')).filter(|word| !word.is_empty()).collect();
    let wanted = dimension_of(quantity);
    for (at, word) in words.iter().enumerate() {
        let Some(HeadingUnit::Quantity { dimension, symbol, size }) = HeadingUnit::of_word(word) else {
            let help = format!("one of {}, {}", wanted.unit_list(), Dimension::Angle.unit_list());
            table.fail(&UNIT, format!("`unit`: \"{word}\" is not a unit of a length or an angle"), Some(help));
            return None;
        };
        // One unit of a swing is that of its positions; of two the first is that of the angles.
        let of_position = dimension == wanted && (quantity == Quantity::Length || words.len() == 1 || at == 1);
        let slot = usize::from(of_position);
        let free = given.get(slot).is_some_and(Option::is_none);
        if !free || (slot == 0 && dimension != Dimension::Angle) || words.len() > 2 {
            let message = format!("`unit` = \"{typed}\" does not fit a motion of {}", quantity.words());
            let help =
                if quantity == Quantity::Angle { "e.g. unit = \"rad\"" } else { "e.g. unit = \"in\" or \"rad, in\"" };
            table.fail(&UNIT, message, Some(help.into()));
            return None;
        }
        if let Some(slot) = given.get_mut(slot) {
            *slot = Some((symbol, size));
        }
    }
    Some(given)
}

/// Which columns are read: of the angles, unless they follow from a step, and of the positions.
struct Chosen {
    angle: Option<usize>,
    position: usize,
}

/// A column by its heading or its number.
fn column(table: &TableReader<'_>, file: &Columns, name: &str) -> Option<usize> {
    let (headings, width) = (file.headings(), width(file));
    if let Ok(number) = units::parse_bare(name) {
        #[expect(clippy::cast_precision_loss, reason = "a row has few cells")]
        let found = (0..width).find(|at| (*at + 1) as f64 == number);
        if found.is_none() {
            let message = format!("`columns`: there is no column {name} in `{}`", file.name());
            table.fail(&COLUMNS, message, Some(format!("it has columns 1 to {width}")));
        }
        return found;
    }
    let wanted = name.trim().to_lowercase();
    let exact = headings.iter().position(|heading| heading.to_lowercase() == wanted);
    let found = exact
        .or_else(|| only_match(headings, |heading| without_unit(heading) == without_unit(name)))
        .or_else(|| only_match(headings, |heading| heading.to_lowercase().contains(&wanted)));
    if found.is_none() {
        let known: Vec<String> = headings.iter().map(|heading| format!("\"{heading}\"")).collect();
        let help = if known.is_empty() {
            format!("`{}` has no headings: give numbers, e.g. columns = [1, 2]", file.name())
        } else {
            format!("the headings are {}; a number from 1 works too", known.join(", "))
        };
        table.fail(&COLUMNS, format!("`columns`: no single column of `{}` is \"{name}\"", file.name()), Some(help));
    }
    found
}

fn width(file: &Columns) -> usize {
    file.rows.iter().map(FileRow::width).max().unwrap_or(0)
}

/// The one heading that matches.
fn only_match(headings: &[String], matches: impl Fn(&str) -> bool) -> Option<usize> {
    let mut found = headings.iter().enumerate().filter(|(_, heading)| matches(heading)).map(|(at, _)| at);
    found.next().filter(|_| found.next().is_none())
}

/// A heading up to its unit in brackets, in small letters.
fn without_unit(heading: &str) -> String {
    let bare = heading.split(['(', '[']).next().unwrap_or_default();
    bare.trim().trim_end_matches(',').to_lowercase()
}

/// The columns of a file.
fn chosen(table: &TableReader<'_>, file: &Columns, quantity: Quantity) -> Option<Chosen> {
    let (width, stepped) = (width(file), table.has(&STEP));
    if table.has(&COLUMNS) {
        let names = table.get(&COLUMNS)?;
        let found: Vec<usize> = names.iter().map(|name| column(table, file, name)).collect::<Option<_>>()?;
        return match found.as_slice() {
            [position] if stepped => Some(Chosen { angle: None, position: *position }),
            [angle, position] if !stepped && angle != position => {
                Some(Chosen { angle: Some(*angle), position: *position })
            }
            _ => {
                let help = "columns = [\"angle\", \"lift\"], or one column with step = \"1 deg\"";
                let message = "`columns` must name two different columns, or one where `step` gives the angles";
                table.fail(&COLUMNS, message.into(), Some(help.into()));
                None
            }
        };
    }
    if width == 1 || (stepped && file.rows.iter().all(|row| row.width() == 1 || row.with_decimal_comma().is_some())) {
        if stepped || is_grinder_list(file.name()) {
            return Some(Chosen { angle: None, position: 0 });
        }
        let read = file.rows.first().map_or_else(String::new, |row| row.shown(0));
        let message = format!("a row of `{}` is not two numbers: row 1 is `{read}`", file.name());
        table.fail_in(&TABLE, 0, message, Some("step = \"1 deg\" makes it a list with a row for each degree".into()));
        return None;
    }
    if stepped {
        let message = format!("`step` is for a list with one column, but `{}` has {width}", file.name());
        table.fail(&STEP, message, Some("name the one with columns = [2], or remove step".into()));
        return None;
    }
    // Without headings only two columns need no choice.
    let headings = file.headings();
    let most = if headings.is_empty() { 2 } else { headings.len() };
    if let Some((row, found)) = file.rows.iter().enumerate().find(|(_, row)| row.width() > most || row.width() < 2) {
        let message =
            format!("a row of `{}` is not two numbers: row {} has {} cells", file.name(), row + 1, found.width());
        let help = if found.width() < 2 {
            "each row is two numbers separated by `,`, `;`, a tab or blanks".to_owned()
        } else {
            "columns = [1, 2] takes the first two; decimal commas need `;`, a tab or blanks between the columns"
                .to_owned()
        };
        table.fail_in(&TABLE, row, message, Some(help));
        return None;
    }
    let [first, second] =
        [0, 1].map(|at| match headings.get(at).and_then(|heading| HeadingUnit::in_heading(heading)) {
            Some(HeadingUnit::Quantity { dimension, .. }) => Some(dimension),
            _ => None,
        });
    let swapped = quantity == Quantity::Length && first == Some(Dimension::Length) && second == Some(Dimension::Angle);
    let (angle, position) = if swapped { (1, 0) } else { (0, 1) };
    has_positions(table, file, position).then_some(Chosen { angle: Some(angle), position })
}

/// Names the columns that are not read, unless `columns` chose.
fn unread(table: &TableReader<'_>, file: &Columns, chosen: &Chosen) -> Option<String> {
    let unread = (0..width(file)).filter(|at| *at != chosen.position && Some(*at) != chosen.angle);
    let unread = unread.map(|at| match file.headings().get(at).filter(|heading| !heading.is_empty()) {
        Some(heading) => format!("{} (\"{heading}\")", at + 1),
        None => (at + 1).to_string(),
    });
    let unread: Vec<String> = unread.collect();
    let (columns, are) = if unread.len() == 1 { ("column", "is") } else { ("columns", "are") };
    (!unread.is_empty() && !table.has(&COLUMNS))
        .then(|| format!("{columns} {} of `{}` {are} not read", unread.join(", "), file.name()))
}

/// Whether the heading of a column that was not chosen says nothing else than positions.
fn has_positions(table: &TableReader<'_>, file: &Columns, position: usize) -> bool {
    let heading = file.headings().get(position).map_or("", String::as_str);
    if is_radius(heading) {
        let message = format!(
            "column {} of `{}` has radii, diameters or distances by its heading \"{heading}\", not lifts",
            position + 1,
            file.name()
        );
        let help = "`camgen import --as profile` or `--as pitch` makes a design of radii, under the heading radius_mm; columns = [1, 2] takes them as positions";
        table.fail(&TABLE, message, Some(help.into()));
        return false;
    }
    let Some(name) = derivative_in(heading) else { return true };
    let message = format!("column {} of `{}` is no position by its heading: {name}", position + 1, file.name());
    let help =
        "choose the columns of angle and position, e.g. columns = [1, 3], or columns = [1, 2] where these are right";
    table.fail(&TABLE, message, Some(help.into()));
    false
}

/// Lists of cam grinders have a row for each degree.
fn is_grinder_list(name: &str) -> bool {
    name.rsplit_once('.').is_some_and(|(_, ending)| ending.eq_ignore_ascii_case("s96"))
}

/// What a column is multiplied with, and in which words.
struct Factor {
    by: f64,
    /// Shares must lie between 0 and 1, or 0 and 100.
    most: Option<f64>,
}

/// The heading of a column that names a unit that cannot be used, or that contradicts a key.
fn contradiction<T>(
    table: &TableReader<'_>,
    key: &Field<T>,
    what: &str,
    heading: &str,
    of_key: &str,
    of_heading: &str,
) {
    let message = format!(
        "`{}` says {of_key} for the {what}, but the heading \"{heading}\" of the table says {of_heading}",
        key.key.name
    );
    table.fail(key, message, Some(format!("remove `{}`, or correct the heading", key.key.name)));
}

/// The unit of a heading, where keys do not say which it is, and how much one of it is.
fn unit_of_heading(
    table: &TableReader<'_>,
    what: &str,
    heading: &str,
    [has_unit, has_factor]: [bool; 2],
) -> Result<Option<HeadingUnit>, ()> {
    match HeadingUnit::read(heading) {
        Err(UnclearHeading::Unknown(_)) if has_unit || has_factor => Ok(None),
        Err(UnclearHeading::Factor(_) | UnclearHeading::Counts(_)) if has_factor => Ok(None),
        Err(why) => {
            let help = match why {
                UnclearHeading::Unknown(_) => "set unit = \"mm\", or correct the heading",
                UnclearHeading::Counts(_) if what == "positions" => {
                    "set scale, the travel per count, and unit = \"mm\": scale = 0.001 for 1000 counts per millimetre"
                }
                UnclearHeading::Factor(_) if what == "positions" => {
                    "scale says what they are multiplied with, with unit = \"mm\", e.g. scale = 0.01 for hundredths of a millimetre; or correct the heading"
                }
                UnclearHeading::Counts(_) | UnclearHeading::Factor(_) => {
                    "write the angles in degrees, and correct the heading"
                }
            };
            table.fail(&TABLE, format!("the heading \"{heading}\" of the {what} {why}"), Some(help.into()));
            Err(())
        }
        Ok(Some(HeadingUnit::Other(symbol))) => {
            let message = format!("the heading \"{heading}\" says that the {what} are in {symbol}");
            table.fail(
                &TABLE,
                message,
                Some("choose other columns, e.g. columns = [1, 2], or correct the heading".into()),
            );
            Err(())
        }
        Ok(unit) => Ok(unit),
    }
}

/// What the angles are multiplied with, rad of the cam.
fn of_angles(
    table: &TableReader<'_>,
    heading: &str,
    given: Option<Unit>,
    span: f64,
    fill: f64,
    told: &mut Vec<String>,
) -> Option<Factor> {
    let unit = unit_of_heading(table, "angles", heading, [given.is_some(), table.has(&RATIO_OF_ANGLES)]).ok()?;
    let by_heading = match unit {
        Some(HeadingUnit::Quantity { dimension: Dimension::Angle, symbol, size }) => Some((symbol, size)),
        Some(HeadingUnit::Quantity { symbol, .. }) => {
            let message = format!("the heading \"{heading}\" says that the angles are in {symbol}");
            let help = "columns = [2, 1] exchanges the columns, or choose them by their headings";
            table.fail(&TABLE, message, Some(help.into()));
            return None;
        }
        _ => None,
    };
    if table.has(&OVER_ROWS) {
        let over = table.get(&OVER_ROWS)?;
        if let Some((symbol, _)) = by_heading {
            contradiction(table, &OVER_ROWS, "angles", heading, "shares", symbol);
            return None;
        }
        if table.has(&RATIO_OF_ANGLES) || given.is_some() {
            let message = "with `over` the angles are shares from 0 to 1: `ratio` and `unit` have no meaning for them";
            table.fail(&OVER_ROWS, message.into(), Some("remove over, or the other key".into()));
            return None;
        }
        return Some(Factor { by: over, most: Some(1.0) });
    }
    if let (Some((symbol, size)), Some((other, other_size))) = (by_heading, given)
        && size != other_size
    {
        contradiction(table, &UNIT, "angles", heading, other, symbol);
        return None;
    }
    let size = by_heading.or(given).map_or(DEGREE, |(_, size)| size);
    if let Some((symbol, _)) = by_heading.filter(|(symbol, _)| *symbol != "deg") {
        told.push(format!("angles in {symbol}, by the heading \"{heading}\""));
    }
    let ratio = ratio_of(table, heading, by_heading.is_some(), span * size, fill, told)?;
    Some(Factor { by: size / ratio, most: None })
}

/// Turns of the shaft whose angles the rows have for each turn of the cam, by the key or the heading; `span` and `fill` are those of the rows and
/// of the turn, rad.
fn ratio_of(
    table: &TableReader<'_>,
    heading: &str,
    has_unit: bool,
    span: f64,
    fill: f64,
    told: &mut Vec<String>,
) -> Option<f64> {
    let (cam, crank) = (heading.to_lowercase().contains("cam") && !is_of_crank(heading), is_of_crank(heading));
    if table.has(&RATIO_OF_ANGLES) {
        let ratio = table.get(&RATIO_OF_ANGLES)?;
        if cam && ratio != 1.0 {
            contradiction(table, &RATIO_OF_ANGLES, "angles", heading, "those of another shaft", "those of the cam");
            return None;
        }
        return Some(ratio);
    }
    if !crank {
        return Some(1.0);
    }
    // A heading that only names the crank over rows of one whole turn leaves it open.
    let named = has_unit && !heading.to_lowercase().contains("angle");
    let whole = span <= fill * (1.0 + SHARE) && span > 0.9 * fill;
    let ratio = if named || !whole { OF_CRANK } else { 1.0 };
    let words = if ratio == 1.0 {
        "the rows cover one turn and are taken for that of the cam; ratio = 2 makes them crank degrees of a four-stroke engine"
    } else {
        "two turns of the crank are one of the cam, as ratio = 2 says"
    };
    told.push(format!("angles of a crank, by the heading \"{heading}\": {words}"));
    Some(ratio)
}

/// What shares of a lift are multiplied with; `of_one` tells that none of them is above 1.
fn of_lift(
    table: &TableReader<'_>,
    heading: &str,
    unit: Option<HeadingUnit>,
    has_unit: bool,
    quantity: Quantity,
    of_one: bool,
    told: &mut Vec<String>,
) -> Option<Factor> {
    let (found, lift) = crate::motion::program::context::value_of(table.get::<LengthOrAngle>(&LIFT)?, None);
    if found != quantity {
        let message = format!("`lift` is {}, but motion.start is {}", found.words(), quantity.words());
        table.fail(&LIFT, message, Some("give both as lengths, or both as angles".into()));
        return None;
    }
    if let Some(HeadingUnit::Quantity { symbol, .. }) = unit {
        contradiction(table, &LIFT, "positions", heading, "shares", symbol);
        return None;
    }
    if table.has(&SCALE) || has_unit {
        let message = "with `lift` the positions are shares from 0 to 1: `scale` and `unit` have no meaning for them";
        table.fail(&LIFT, message.into(), Some("remove lift, or the other key".into()));
        return None;
    }
    let percent = unit == Some(HeadingUnit::Percent);
    let (by, most) = if percent && !of_one { (0.01 * lift, 100.0) } else { (lift, 1.0) };
    if percent && of_one {
        told.push(format!("shares from 0 to 1, though the heading \"{heading}\" says percent"));
    }
    Some(Factor { by, most: Some(most) })
}

/// What the positions are multiplied with, m or rad.
fn of_positions(
    table: &TableReader<'_>,
    heading: &str,
    given: Option<Unit>,
    quantity: Quantity,
    largest: f64,
    told: &mut Vec<String>,
) -> Option<Factor> {
    let scale = if table.has(&SCALE) { table.get(&SCALE)? } else { 1.0 };
    if scale == 0.0 {
        table.fail(&SCALE, "`scale` cannot be 0".into(), Some("e.g. scale = 1.5".into()));
        return None;
    }
    let unit = unit_of_heading(table, "positions", heading, [given.is_some(), table.has(&SCALE)]).ok()?;
    // Shares of 1 stand under such a heading too.
    let percent = unit == Some(HeadingUnit::Percent);
    let of_one = largest <= 1.0 + SHARE;
    if table.has(&LIFT) {
        return of_lift(table, heading, unit, given.is_some(), quantity, of_one, told);
    }
    if percent && !table.has(&SCALE) && given.is_none() {
        let message =
            format!("the heading \"{heading}\" says that the positions are shares of a lift, which is not given");
        let help = "lift = \"8 mm\" gives it; where they are no percentages, unit = \"mm\" or scale says what they are";
        table.fail(&TABLE, message, Some(help.into()));
        return None;
    }
    let wanted = dimension_of(quantity);
    let by_heading = match unit {
        Some(HeadingUnit::Quantity { dimension, symbol, size }) if dimension == wanted => Some((symbol, size)),
        Some(HeadingUnit::Quantity { symbol, .. }) => {
            let message = format!(
                "the heading \"{heading}\" says that the positions are in {symbol}, but motion.start, \"{}\", is {}",
                table.typed(&START),
                quantity.words()
            );
            let help = "give motion.start as a position of the follower, choose columns, or correct the heading";
            table.fail(&TABLE, message, Some(help.into()));
            return None;
        }
        _ => None,
    };
    if let (Some((symbol, size)), Some((other, other_size))) = (by_heading, given)
        && size != other_size
    {
        contradiction(table, &UNIT, "positions", heading, other, symbol);
        return None;
    }
    let start = unit_of_start(table, quantity)?;
    if let Some((symbol, _)) = by_heading.filter(|(_, size)| *size != start.1) {
        told.push(format!("positions in {symbol}, by the heading \"{heading}\""));
    }
    let (_, size) = by_heading.or(given).unwrap_or(start);
    Some(Factor { by: scale * size, most: None })
}

/// Two numbers of each row of the first columns, for a table that needs no other key.
pub(in crate::motion::program) fn pairs(
    table: &TableReader<'_>,
    key: &Field<Arc<Columns>>,
    file: &Columns,
) -> Option<Vec<[f64; 2]>> {
    let mut rows = Vec::with_capacity(file.rows.len());
    for (at, row) in file.rows.iter().enumerate() {
        let numbers = row.number(0).zip(row.number(1)).filter(|_| row.width() == 2);
        let Some((first, second)) = numbers else {
            let message = format!("a row of `{}` is not two numbers", file.name());
            let help = "each row is two numbers separated by `,`, `;`, a tab or blanks; decimal commas need another separator than `,`";
            table.fail_in(key, at, message, Some(help.into()));
            return None;
        };
        rows.push([first, second]);
    }
    Some(rows)
}

/// The number of a cell, or its fault.
fn number_in(table: &TableReader<'_>, file: &Columns, row: usize, at: usize, what: &str) -> Option<f64> {
    let found = file.rows.get(row)?;
    if let Some(number) = found.number(at).filter(|number| number.is_finite()) {
        return Some(number);
    }
    let read = if found.cell(at).is_empty() { "nothing".to_owned() } else { format!("`{}`", found.shown(at)) };
    let message = format!(
        "a row of `{}` is not two numbers: row {} has {read} as {what}, in column {}",
        file.name(),
        row + 1,
        at + 1
    );
    let help = "write a number there, or choose other columns, e.g. columns = [1, 3]";
    table.fail_in(&TABLE, row, message, Some(help.into()));
    None
}

/// Angle and position of every row, as written; the angle of a list is the number of the row.
fn numbers(table: &TableReader<'_>, file: &Columns, angle: Option<usize>, position: usize) -> Option<Vec<[f64; 2]>> {
    let mut raw: Vec<[f64; 2]> = Vec::with_capacity(file.rows.len());
    for row in 0..file.rows.len() {
        let value = match file.rows.get(row).and_then(FileRow::with_decimal_comma).filter(|_| angle.is_none()) {
            Some(value) => value,
            None => number_in(table, file, row, position, "position")?,
        };
        #[expect(clippy::cast_precision_loss, reason = "at most 20000 rows")]
        let at = match angle {
            Some(angle) => number_in(table, file, row, angle, "angle")?,
            None => row as f64,
        };
        raw.push([at, value]);
    }
    Some(raw)
}

/// The rows of the file of `table`: cam angles from `at` on, rad, and positions, m or rad.
pub(in crate::motion::program) fn read(table: &TableReader<'_>, whole: ProgramContext) -> Option<Rows> {
    let file = table.get(&TABLE)?;
    let (quantity, arc) = whole.typed(table);
    let given = units_given(table, quantity)?;
    let chosen = chosen(table, &file, quantity)?;
    let mut told: Vec<String> = unread(table, &file, &chosen).into_iter().collect();
    let Chosen { angle, position } = chosen;
    let heading = |at: usize| file.headings().get(at).map_or("", String::as_str);
    let raw = numbers(table, &file, angle, position)?;
    let ends = raw.iter().map(|row| row[0]).fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
    let angles = if let Some(angle) = angle {
        of_angles(table, heading(angle), given[0], ends.1 - ends.0, whole.fill, &mut told)?
    } else {
        let ratio = if table.has(&RATIO_OF_ANGLES) { table.get(&RATIO_OF_ANGLES)? } else { 1.0 };
        let step = if table.has(&STEP) { table.get(&STEP)? } else { DEGREE };
        told.push(format!("a list with a row each {} deg", super::degrees(step / ratio)));
        Factor { by: step / ratio, most: None }
    };
    let largest = raw.iter().map(|row| row[1].abs()).fold(0.0, f64::max);
    // The heading of a list is its title.
    let of_position = if angle.is_some() { heading(position) } else { "" };
    let positions = of_positions(table, of_position, given[1], quantity, largest, &mut told)?;
    let by = positions.by / arc;
    for (row, [at, value]) in raw.iter().enumerate() {
        for (number, factor, key, kept) in [(*at, &angles, "over", angle.is_some()), (*value, &positions, "lift", true)]
        {
            if let Some(most) = factor.most.filter(|_| kept)
                && !(-SHARE * most..=most * (1.0 + SHARE)).contains(&number)
            {
                let message =
                    format!("row {} has {number}, but with `{key}` the column has shares from 0 to {most}", row + 1);
                table.fail_in(&TABLE, row, message, Some(format!("remove `{key}`, or give shares")));
                return None;
            }
        }
    }
    let rounding = |which: usize, by: f64| {
        let column: Vec<f64> = raw.iter().filter_map(|row| row.get(which).copied()).collect();
        by.abs() * super::rounding::step(&column)
    };
    let (of_angle, of_position) = (rounding(0, angles.by), rounding(1, by));
    let points = raw.iter().zip(&file.rows).zip(0..).map(|(([at, value], read), row)| RowPlace {
        at: angles.by * at,
        position: by * value,
        row,
        line: Some(read.line()),
    });
    let has_lifts = table.has(&COLUMNS) || table.has(&LIFT) || is_lift(heading(position));
    let bare = angle.is_some() && heading(angle.unwrap_or(0)).is_empty() && given[0].is_none();
    Some(Rows {
        points: points.collect(),
        rounding: of_position,
        rounding_of_angles: if angle.is_some() { of_angle } else { 0.0 },
        origin: Origin::File { in_degrees: bare || angles.by == DEGREE, span: ends.1 - ends.0, has_lifts },
        told,
    })
}

/// Whether a span of bare numbers, taken for degrees, would be a turn in radians.
pub(super) fn looks_like_radians(span: f64) -> bool {
    span > 0.75 * TAU && span < 1.02 * TAU
}
