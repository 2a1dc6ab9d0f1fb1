//! What rows cover of a turn: their order, the row that closes it, a half that is mirrored, a part that rests.

use super::file::looks_like_radians;
use super::{OF_DWELL, Origin, RestOfTurn, RowPlace, Rows, RowsFault, degrees};
use crate::numeric::scatter::median;
use std::f64::consts::TAU;

/// Typed angles that differ by less are equal, rad.
const SAME_ANGLE: f64 = 1e-12;
/// Positions that differ by less than this share of the largest are equal.
const SAME_PLACE: f64 = 1e-9;
/// Fewest rows of a turn.
const FEWEST: usize = 3;
/// Spacings that differ by less are equal.
const EVEN: f64 = 1.2;
/// Uneven rows may leave a gap of so many of their widest spacing.
const OF_UNEVEN: f64 = 1.5;
/// Rounding of the angles moves the row that closes the turn by at most this share of the least spacing.
const CLOSING: f64 = 0.2;

/// Rows that cover a turn or lobe: knots as shares of it from the first row on, the last one closing it.
pub(super) struct Turn {
    /// Cam angle of the first row, rad.
    pub(super) at: f64,
    /// Shares, from 0 to 1, one more than rows.
    pub(super) knots: Vec<f64>,
    /// Positions, the last that of the first row.
    pub(super) values: Vec<f64>,
    /// Whether an interval rests, one fewer than knots.
    pub(super) dwells: Vec<bool>,
    /// The usual interval, rad.
    pub(super) spacing: f64,
}

impl Turn {
    pub(super) fn knot(&self, index: usize) -> f64 {
        self.knots.get(index).copied().unwrap_or(1.0)
    }

    /// The turn or lobe of a width, rad, covered by rows.
    ///
    /// # Errors
    /// The fault of a row.
    pub(super) fn new(fill: f64, rows: &mut Rows, mirrored: bool, rest: Option<RestOfTurn>) -> Result<Self, RowsFault> {
        ordered(rows, fill)?;
        let fewest = if mirrored { 2 } else { FEWEST };
        if rows.points.len() < fewest {
            let (what, one) = rows.words();
            let message = format!("{what} needs at least {fewest} {one}, not {}", rows.points.len());
            return Err(RowsFault::new(rows.points.len().saturating_sub(1), message, format!("add {one}")));
        }
        if mirrored {
            mirror(rows, fill)?;
        }
        // Rounding of the angles moves the row that closes the turn.
        let least = pairs(&rows.points).map(|(a, b)| b.at - a.at).fold(f64::INFINITY, f64::min);
        let same = SAME_ANGLE.max((1.01 * rows.rounding_of_angles).min(CLOSING * least));
        let closes = closed(rows, fill, same)?;
        let (first, last) = rows.ends();
        let open = fill - (last.at - first.at);
        let size = rows.points.iter().map(|row| row.position.abs()).fold(0.0, f64::max);
        let equal = |a: f64, b: f64| (a - b).abs() <= SAME_PLACE * size;
        let widths: Vec<f64> = pairs(&rows.points).map(|(a, b)| b.at - a.at).collect();
        let rests = mirrored || rest == Some(RestOfTurn::Dwell);
        let covered = closes || open <= widest_allowed(rows, &equal) + same;
        if !covered && !rests {
            return Err(uncovered(rows, fill, open, equal(first.position, last.position)));
        }
        if !covered && !equal(first.position, last.position) {
            return Err(cannot_rest(&first, &last, open));
        }
        if rows.points.len() < FEWEST {
            return Err(too_few_behind_the_first(rows));
        }
        let spacing = median(&mut widths.clone());
        let ends = pairs(&rows.points).map(|(a, b)| (a.position, b.position, b.at - a.at));
        let ends = ends.chain([(last.position, first.position, open)]);
        let mut dwells: Vec<bool> =
            ends.map(|(from, to, width)| equal(from, to) && width > OF_DWELL * spacing).collect();
        // Asked for, or the rest of a mirrored lobe.
        let asked = rest.is_some() && open > same && equal(first.position, last.position);
        if let Some(last) = dwells.last_mut().filter(|_| !covered || asked) {
            *last = true;
        }
        let knots = rows.points.iter().map(|row| (row.at - first.at) / fill).chain([1.0]).collect();
        let values = rows.points.iter().map(|row| row.position).chain([first.position]).collect();
        Ok(Self { at: within_a_turn(first.at), knots, values, dwells, spacing })
    }

    /// The turn with its rows shifted by an angle, rad.
    pub(super) fn moved(self, by: f64) -> Self {
        Self { at: within_a_turn(self.at + by), ..self }
    }
}

/// An angle (rad) reduced to within one turn of 0, for reports.
fn within_a_turn(angle: f64) -> f64 {
    if angle.abs() >= TAU { libm::fmod(angle, TAU) } else { angle }
}

/// The ends of rows are at different positions, so that nothing can rest between them.
fn cannot_rest(first: &RowPlace, last: &RowPlace, open: f64) -> RowsFault {
    let message = format!(
        "the rows end at {} deg and begin at {} deg with different positions, so that the uncovered {} deg cannot rest",
        degrees(last.at),
        degrees(first.at),
        degrees(open)
    );
    RowsFault::new(last.row, message, "add rows up to equal positions at both ends".into())
}

/// Rows of which the last repeats the first are too few.
fn too_few_behind_the_first(rows: &Rows) -> RowsFault {
    let (what, one) = rows.words();
    let (single, count) = (one.trim_end_matches('s'), rows.points.len());
    let message = format!(
        "{what} needs at least {FEWEST} {one}, not {count}: {single} {} repeats the first, and the spline closes by itself",
        count + 1
    );
    RowsFault::new(0, message, format!("add {one}"))
}

fn pairs(points: &[RowPlace]) -> impl Iterator<Item = (&RowPlace, &RowPlace)> {
    points.iter().zip(points.iter().skip(1))
}

/// The widest gap in which the curve may close the turn by itself: one spacing, rests left out.
fn widest_allowed(rows: &Rows, equal: &impl Fn(f64, f64) -> bool) -> f64 {
    let moving = pairs(&rows.points).filter(|(a, b)| !equal(a.position, b.position));
    let moving: Vec<f64> = moving.map(|(a, b)| b.at - a.at).collect();
    let widths = if moving.is_empty() { pairs(&rows.points).map(|(a, b)| b.at - a.at).collect() } else { moving };
    let (least, most) =
        widths.iter().fold((f64::INFINITY, 0.0_f64), |(least, most), width| (least.min(*width), most.max(*width)));
    if most <= EVEN * least { most * (1.0 + 1e-6) } else { OF_UNEVEN * most }
}

/// The rows in the order of growing angles: a table may also fall all along, or go over the end of the turn once.
fn ordered(rows: &mut Rows, fill: f64) -> Result<(), RowsFault> {
    if rows.points.len() > 2 && pairs(&rows.points).all(|(a, b)| b.at < a.at) {
        rows.points.reverse();
    }
    let descents: Vec<usize> =
        (1..).zip(pairs(&rows.points)).filter(|(_, (a, b))| b.at - a.at <= SAME_ANGLE).map(|(at, _)| at).collect();
    if let ([at], Some(first), Some(last)) =
        (descents.as_slice(), rows.points.first().copied(), rows.points.last().copied())
    {
        let before = at.checked_sub(1).and_then(|before| rows.points.get(before)).map_or(0.0, |row| row.at);
        let next = rows.points.get(*at).map_or(0.0, |row| row.at);
        if before - next > 0.5 * fill && last.at < first.at + SAME_ANGLE {
            for row in rows.points.iter_mut().skip(*at) {
                row.at += fill;
            }
            rows.told.push(format!("the rows go over the end of the turn behind {} deg", degrees(before)));
            return Ok(());
        }
    }
    let Some(at) = descents.first() else { return Ok(()) };
    let (Some(row), Some(before)) = (rows.points.get(*at), at.checked_sub(1).and_then(|at| rows.points.get(at))) else {
        return Ok(());
    };
    let (here, before) = (degrees(row.at), degrees(before.at));
    if let Origin::File { .. } = rows.origin {
        let message = format!("{here} does not come after {before}: rows {at} and {} in degrees of the cam", at + 1);
        return Err(RowsFault::new(row.row, message, "sort the rows by their angle, each angle once".into()));
    }
    let (_, all) = rows.words();
    let one = all.trim_end_matches('s');
    let message = format!(
        "{one} {} at {:.6} deg does not come after {one} {at} at {:.6} deg",
        at + 1,
        row.at.to_degrees(),
        before
    );
    Err(RowsFault::new(*at, message, format!("give the {all} in order of increasing angle, each angle once")))
}

/// The other half of rows that are one, mirrored at its higher end.
fn mirror(rows: &mut Rows, fill: f64) -> Result<(), RowsFault> {
    let (first, last) = rows.ends();
    if last.at - first.at > 0.5 * fill * (1.0 + 1e-9) {
        let message = format!(
            "`mirror` takes rows of half a lobe, at most {} deg, but they cover {} deg",
            degrees(0.5 * fill),
            degrees(last.at - first.at)
        );
        let help = "remove `mirror`, or the rows of the other half".into();
        return Err(RowsFault { of_mirror: true, ..RowsFault::new(last.row, message, help) });
    }
    let at_last = last.position >= first.position;
    let nose = if at_last { last } else { first };
    let mut mirrored: Vec<RowPlace> =
        rows.points.iter().rev().map(|row| RowPlace { at: 2.0 * nose.at - row.at, ..*row }).collect();
    if at_last {
        rows.points.extend(mirrored.into_iter().skip(1));
    } else {
        mirrored.pop();
        mirrored.append(&mut rows.points);
        rows.points = mirrored;
    }
    rows.told.push(format!("mirrored at {} deg", degrees(nose.at)));
    Ok(())
}

/// Takes away rows that repeat others a turn before: the one that closes it, and what a list has beyond it; whether there are such.
fn closed(rows: &mut Rows, fill: f64, same: f64) -> Result<bool, RowsFault> {
    let (first, _) = rows.ends();
    let size = rows.points.iter().map(|row| row.position.abs()).fold(0.0, f64::max);
    let kept = rows.points.iter().take_while(|row| row.at - first.at < fill - same).count();
    let beyond: Vec<RowPlace> = rows.points.iter().skip(kept).copied().collect();
    for row in &beyond {
        let back = row.at - fill;
        let twin = rows.points.iter().find(|other| (other.at - back).abs() <= same);
        match twin {
            Some(twin) if (twin.position - row.position).abs() <= SAME_PLACE * size => {}
            Some(twin) if twin.row == first.row && beyond.len() == 1 => {
                let (name, one) = (rows.name(), rows.words().1.trim_end_matches('s'));
                let ends = if name == "table" { "does not end where it begins" } else { "do not end where they begin" };
                let message = format!(
                    "the {name} {ends}: {one} {} is {} deg after {one} {} and has another position",
                    row.row + 1,
                    degrees(fill),
                    first.row + 1
                );
                let help = "make both positions equal, or remove the last row".into();
                return Err(RowsFault::new(row.row, message, help));
            }
            _ => {
                let span = rows.points.last().map_or(0.0, |last| last.at - first.at);
                return Err(outside(rows, row, span, fill));
            }
        }
    }
    rows.points.truncate(kept);
    Ok(!beyond.is_empty())
}

/// Reports a row beyond the turn that does not repeat another.
fn outside(rows: &Rows, row: &RowPlace, span: f64, fill: f64) -> RowsFault {
    if !matches!(rows.origin, Origin::File { .. }) {
        let one = rows.words().1.trim_end_matches('s');
        let first = rows.points.first().map_or(0.0, |first| first.at);
        let message = format!("{one} {} at {:.6} deg is outside the turn or lobe", row.row + 1, row.at.to_degrees());
        let (low, high) = (first.to_degrees(), (first + fill).to_degrees());
        let help = format!("angles must be at least {low:.6} deg and below {high:.6} deg; the spline closes by itself");
        return RowsFault::new(row.row, message, help);
    }
    let message = format!(
        "row {} at {} deg is outside the turn or lobe: the rows cover {} deg, more than {} deg",
        row.row + 1,
        degrees(row.at),
        degrees(span),
        degrees(fill)
    );
    let turns = span / fill;
    let help = if (1.9..2.01).contains(&turns) {
        "ratio = 2 takes them as crank degrees of a four-stroke engine, two turns for one of the cam".to_owned()
    } else if turns > 40.0 && turns < 58.5 {
        "are these degrees under a heading or `unit` that says rad?".to_owned()
    } else {
        format!("angles must span at most {} deg; `ratio`, `unit` or `over` say what else they are", degrees(fill))
    };
    RowsFault::new(row.row, message, help)
}

/// Reports a part of the turn without rows, with what would complete it.
fn uncovered(rows: &Rows, fill: f64, open: f64, equal: bool) -> RowsFault {
    let (row, span) = (rows.points.last().map_or(0, |last| last.row), fill - open);
    let what = format!("{} deg of the turn are without rows", degrees(open));
    let what = if (fill - TAU).abs() > SAME_ANGLE { what.replace("turn", "lobe") } else { what };
    if let Origin::File { in_degrees: true, span, .. } = rows.origin {
        if looks_like_radians(span) {
            let message = format!("{what}: are these radians?");
            let help = "set unit = \"rad\", or write a heading such as \"angle (rad)\"";
            return RowsFault::new(row, message, help.into());
        }
        if (span - 1.0).abs() < 0.05 {
            let help = "over = \"360 deg\" says so; lift = \"8 mm\" makes shares of the positions";
            return RowsFault::new(row, format!("{what}: are these shares of the turn?"), help.into());
        }
    }
    let mut ways = Vec::new();
    if span <= 0.5 * fill * (1.0 + 1e-9) && !equal {
        ways.push("mirror = true makes a whole lobe of one half");
    }
    if equal {
        ways.push("rest = \"dwell\" keeps the position there");
    }
    ways.push(if ways.is_empty() { "add rows" } else { "or add rows" });
    RowsFault::new(
        row,
        format!("{what}: they end at {} deg", degrees(rows.points.last().map_or(0.0, |last| last.at))),
        ways.join(", "),
    )
}
