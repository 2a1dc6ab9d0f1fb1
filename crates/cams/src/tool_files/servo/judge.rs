//! The motion that a drive makes of a written table, compared with the exact one.
//!
//! The rows are those that are read back from the bytes. Between two of them the drive runs on the polynomial of degree 5 that has position,
//! velocity and acceleration of both, here by its coefficients, or, on a table of positions alone, on a straight line. The comparison is at many places of every interval, on either side of every break.

use super::super::head::{self, HeadLine, lines_after, lines_in_comment, mismatch};
use super::plan::{VELOCITY_SHARE, advance, exact, largest_velocity};
use super::read::ServoRows;
use super::write::{isg_statements, statements};
use crate::body::Body;
use crate::check::{Check, CheckExplanation, CheckScope};
use crate::report::{Bound, Finding, Verdict, shown};
use crate::verify::Evidence;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::Quantity;
use std::f64::consts::TAU;

pub(super) const CHECK: Check = Check {
    name: "servo",
    on: CheckScope::ToolFile,
    unit: "mm",
    about: "The largest difference between the motion and what a drive makes of the table as it is in the file, by polynomials of degree 5 \
            between its rows; for an arm at the end of the arm. The velocity may be off by a thousandth of the largest.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "max |s(table) − s(motion)| over the turn",
        usual: "the tolerance",
        change: "a finer --tolerance, or another table where the file was edited",
    },
};

/// Places of an interval.
const PLACES: u32 = 24;
/// Two turns of the master, or the ends of the table, that differ by less are equal, degrees, and so are positions, as a share of the tolerance.
const SAME: f64 = 1e-9;
const CLOSES: f64 = 0.1;

/// The largest differences of a table.
struct ServoDifference {
    /// m or rad.
    position: f64,
    /// m or rad per rad.
    velocity: f64,
    /// Master, rad.
    at: f64,
}

/// A table as it was read, and what messages call it.
pub(super) struct WrittenServo {
    pub(super) format: &'static str,
    pub(super) table: Result<ServoRows, String>,
}

/// The finding on tables of a cam; none where there are none.
pub(super) fn judge(evidence: &Evidence<'_>, tables: &[WrittenServo]) -> Option<Finding> {
    let limit = evidence.tolerance_mm;
    let mut worst: Option<(f64, ServoDifference, String)> = None;
    for WrittenServo { format, table } in tables {
        let judged =
            table.as_ref().map_err(Clone::clone).and_then(|rows| Ok((judged(evidence.body, rows)?, rows.rows.len())));
        match judged {
            Err(why) => {
                let found = CHECK.found(f64::INFINITY, Some(limit), Verdict::Fail);
                return Some(Finding { note: Some(format!("{format}: {why}").into()), ..found });
            }
            Ok((found, rows)) => {
                let straight = table.as_ref().is_ok_and(|rows| rows.straight);
                let between = if straight { "straight lines" } else { "polynomials of degree 5" };
                let value = MILLIMETRES * found.position * evidence.body.leverage();
                let velocity = worst.as_ref().map_or(0.0, |worst| worst.1.velocity).max(found.velocity);
                if worst.as_ref().is_none_or(|worst| value > worst.0) {
                    worst = Some((value, found, format!("{rows} rows, {between} between them")));
                }
                // The largest of both over all tables.
                if let Some((_, found, _)) = &mut worst {
                    found.velocity = velocity;
                }
            }
        }
    }
    let (value, found, words) = worst?;
    let share = found.velocity / largest_velocity(evidence.body).max(f64::MIN_POSITIVE);
    let kept = value <= limit && share <= VELOCITY_SHARE;
    let allowed = if share > VELOCITY_SHARE { format!(", at most {VELOCITY_SHARE} is allowed") } else { String::new() };
    let note = format!("{words}; the velocity off by {} of the largest{allowed}", shown(share));
    let place = evidence.body.place(found.at);
    Some(Finding { place, note: Some(note.into()), ..CHECK.found(value, Some(limit), Verdict::of(kept)) })
}

/// A row in SI units.
fn state([master, slave, velocity, acceleration]: [f64; 4], swings: bool) -> (f64, [f64; 3]) {
    let (unit, turn) = (if swings { 1f64.to_radians() } else { 1.0 / MILLIMETRES }, 1f64.to_degrees());
    (master.to_radians(), [unit * slave, unit * velocity * turn, unit * acceleration * turn * turn])
}

fn judged(body: &dyn Body, read: &ServoRows) -> Result<ServoDifference, String> {
    let motion = body.follower_motion().ok_or("the cam has no motion of its own")?;
    let advance = advance(motion);
    if read.swings != (motion.quantity() == Quantity::Angle) {
        return Err("its slave is not in the unit of the follower".into());
    }
    let (Some(first), Some(last)) = (read.rows.first(), read.rows.last()) else { return Err("it has no rows".into()) };
    if first[0].abs() > SAME || (last[0] - 360.0).abs() > SAME {
        return Err(format!("its master runs from {} to {} deg, not from 0 to 360", first[0], last[0]));
    }
    let mut worst = ServoDifference { position: 0.0, velocity: 0.0, at: 0.0 };
    for pair in read.rows.windows(2) {
        let ((from, start), (to, end)) = (state(pair[0], read.swings), state(pair[1], read.swings));
        let coefficients = if read.straight {
            [start[0], end[0] - start[0], 0.0, 0.0, 0.0, 0.0]
        } else {
            quintic(start, end, to - from)
        };
        for step in 0..=PLACES {
            let share = f64::from(step) / f64::from(PLACES);
            let [position, velocity] = at(&coefficients, share, to - from);
            // At an end the value is that of the table alone; its two sides differ where the acceleration jumps, not in these.
            let master = (from + share * (to - from)).min(TAU);
            let (piece, angle) = motion.locate(master);
            let (exact, turns) = (exact(motion, piece, angle), ((master - angle) / TAU).round());
            let off = (position - exact.s - turns * advance).abs();
            if !(off <= worst.position) {
                worst = ServoDifference { position: off, at: angle, ..worst };
            }
            worst.velocity = worst.velocity.max((velocity - exact.ds).abs());
        }
    }
    let ends = first[1] - last[1] + if read.swings { advance.to_degrees() } else { MILLIMETRES * advance };
    let closes = CLOSES * MILLIMETRES * worst.position.max(SAME);
    if ends.abs() > closes.max(1e-6) {
        return Err(format!("its last row is off a turn behind its first by {}", shown(ends)));
    }
    Ok(worst)
}

/// The coefficients of the polynomial by the share of the interval.
fn quintic(start: [f64; 3], end: [f64; 3], length: f64) -> [f64; 6] {
    let [y, v, a] = [start[0], start[1] * length, start[2] * length * length];
    let rise = end[0] - y - v - 0.5 * a;
    let speed = end[1] * length - v - a;
    let bend = end[2] * length * length - a;
    [
        y,
        v,
        0.5 * a,
        10.0 * rise - 4.0 * speed + 0.5 * bend,
        -15.0 * rise + 7.0 * speed - bend,
        6.0 * rise - 3.0 * speed + 0.5 * bend,
    ]
}

/// Position and velocity at a share of the interval.
fn at(coefficients: &[f64; 6], share: f64, length: f64) -> [f64; 2] {
    let (mut value, mut slope) = (0.0, 0.0);
    for coefficient in coefficients.iter().rev() {
        slope = slope * share + value;
        value = value * share + coefficient;
    }
    [value, slope / length]
}

/// The contradiction between the head of a servo table and the cam, if any.
pub(super) fn contradiction(body: &dyn Body, text: &str, read: &ServoRows) -> Option<String> {
    if read.straight {
        return contradiction_of_equal_parts(text, read.swings);
    }
    let expected = statements(body, read.rows.len(), read.units);
    let found = if text.contains("(*") { lines_in_comment(text) } else { lines_after(text, "#") };
    head::contradiction(&found, &expected)
}

/// The contradiction in the comments after the settings of an ISG table. A comment of one word names the setting.
fn contradiction_of_equal_parts(text: &str, swings: bool) -> Option<String> {
    let [master, kind, function, slave] = isg_statements(swings);
    let due = [("Tabletype", kind), ("Functiontype", function)];
    let found: Vec<HeadLine<'_>> = text
        .lines()
        .take_while(|line| line.trim() != "Begintable")
        .enumerate()
        .filter_map(|(index, line)| Some(HeadLine { line: index + 1, text: line.split_once('#')?.1.trim() }))
        .collect();
    let misnamed = text.lines().enumerate().find_map(|(index, line)| {
        let (setting, comment) = line.split_once('#')?;
        let (_, due) = due.iter().find(|(name, _)| setting.trim_start().starts_with(name))?;
        let named = !comment.trim().is_empty() && !comment.trim().contains(' ');
        (named && comment.trim() != due).then(|| mismatch(index + 1, comment.trim(), due))
    });
    misnamed.or_else(|| head::contradiction(&found, &[master, slave]))
}
