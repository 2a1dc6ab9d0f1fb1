//! What the motion diagram of a cam shows: the columns of its table, piece by piece, with their largest and least values.

use super::{Body, curves_of};
use crate::report::motion_diagram::{
    DiagramExtreme, DiagramPanel, DiagramRun, DiagramSegment, Impulse, MotionDiagram, figure,
};
use crate::report::shown;
use crate::table::{self, Row};
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::motion::{Jet, Motion, NamedStretch, Quantity};
use camgen_kernel::numeric::extremum;
use camgen_kernel::profile::followed::FollowerOnChain;
use camgen_kernel::units::{self, LengthUnit};
use std::f64::consts::TAU;

/// Places of a turn or a travel, and least places of a stretch, at which values are taken.
const PLACES: f64 = 1440.0;
const LEAST: u32 = 8;
/// Most places of a stretch, and about so many in all where the motion has many pieces.
const MOST: f64 = 20_000.0;
const MOST_IN_ALL: f64 = 6000.0;
/// Places of what is cut lie no farther apart than this share of the motion.
const CUT_SHARE: f64 = 1.0 / 720.0;
/// Of more segments than this only the largest and least values of the whole are marked.
const MOST_SEGMENTS: usize = 16;
/// Share of the largest value below which a difference is rounding, and a value of a segment is not worth a mark.
const ROUNDING: f64 = 1e-7;
const WORTH: f64 = 0.02;
/// Share of the height of a panel from which a difference between motion and outline can be seen.
const SEEN: f64 = 0.012;
/// Values of a length from which they are shown a thousand times the unit.
const LARGE: f64 = 1e5;

/// A quantity of the diagram, in the order from the top: its name, and the column that has it. Of several with one rank that the cam has
/// the first is shown.
struct ShownColumn {
    rank: u32,
    name: &'static str,
    column: &'static str,
}

const fn shown_column(rank: u32, name: &'static str, column: &'static str) -> ShownColumn {
    ShownColumn { rank, name, column }
}

/// Ranks of the rates, which are derivatives of each other.
const VELOCITY: u32 = 1;
const ACCELERATION: u32 = 2;
const JERK: u32 = 3;
const PRESSURE_ANGLE: u32 = 4;
const RADIUS: u32 = 5;
const FORCE: u32 = 6;

const LIFT_MM: ShownColumn = shown_column(0, "Lift", "lift_mm");

const SHOWN: &[ShownColumn] = &[
    LIFT_MM,
    shown_column(0, "Lift", "lift_deg"),
    shown_column(VELOCITY, "Velocity", "velocity_mm_per_rad"),
    shown_column(VELOCITY, "Velocity", "velocity_rad_per_rad"),
    shown_column(VELOCITY, "Velocity", "velocity_mm_per_mm"),
    shown_column(ACCELERATION, "Acceleration", "acceleration_mm_per_rad2"),
    shown_column(ACCELERATION, "Acceleration", "acceleration_rad_per_rad2"),
    shown_column(ACCELERATION, "Acceleration", "acceleration_mm_per_mm2"),
    shown_column(JERK, "Jerk", "jerk_mm_per_rad3"),
    shown_column(JERK, "Jerk", "jerk_rad_per_rad3"),
    shown_column(JERK, "Jerk", "jerk_mm_per_mm3"),
    shown_column(PRESSURE_ANGLE, "Pressure angle", "pressure_angle_deg"),
    shown_column(RADIUS, "Radius of curvature of the profile", "profile_curvature_radius_mm"),
    shown_column(FORCE, "Contact force along the normal", "contact_force_n"),
    shown_column(FORCE, "Roller force along the normal", "roller_force_n"),
    shown_column(7, "Torque of the shaft", "torque_nm"),
];

/// A stretch on which every quantity is smooth.
struct SmoothRun {
    piece: usize,
    /// Whole turns before it, rad.
    turns: f64,
    /// Parameters, and the values of the columns there.
    at: Vec<(f64, Vec<f64>)>,
    /// The named stretch it is in.
    segment: usize,
}

/// The diagram of a body as it is made.
struct DiagramSource<'a> {
    body: &'a dyn Body,
    motion: &'a dyn Motion,
    shown: Vec<&'static ShownColumn>,
    stretches: Vec<NamedStretch>,
}

/// The motion diagram of a body, with what is cut on an outline as written; `None` of a body whose sections differ.
#[must_use]
pub fn motion_diagram(body: &dyn Body, outline: Option<&Contour>) -> Option<MotionDiagram> {
    let motion = body.follower_motion()?;
    let (piece, (from, _)) = body.smooth_stretches().first().copied()?;
    let source =
        DiagramSource { body, motion, shown: chosen(&body.row_on(piece, from)?), stretches: motion.named_stretches() };
    let runs = source.runs();
    let cut = outline.zip(curves_of(body)).map(|(outline, curves)| {
        let mirrored = body.cuts().first().map_or(&[][..], |cut| cut.mirrored);
        FollowerOnChain::on(curves, outline, mirrored).lifts(CUT_SHARE)
    });
    let panel = |index: usize| source.panel(index, &runs, cut.as_deref().unwrap_or_default());
    let is_zero =
        |panel: &DiagramPanel| panel.impulses.is_empty() && !panel.law.iter().flatten().any(|[_, value]| *value != 0.0);
    let (zero, panels): (Vec<DiagramPanel>, Vec<DiagramPanel>) = (0..source.shown.len()).map(panel).partition(is_zero);
    let nothing = zero.iter().map(|panel| format!("{} is 0 throughout.", panel.name));
    let turns = motion.period().is_some();
    let (first, last) = motion.range();
    Some(MotionDiagram {
        places: match (turns, motion.is_by_travel(), source.units()) {
            (true, ..) => "cam angle θ, degrees",
            (false, true, LengthUnit::Millimetre) => "travel x of the plate, mm",
            (false, true, LengthUnit::Inch) => "travel x of the plate, in",
            (false, false, LengthUnit::Millimetre) => "overrun x of the bed, mm",
            (false, false, LengthUnit::Inch) => "overrun x of the bed, in",
        },
        turns,
        units: source.units(),
        range: if turns { (0.0, 360.0) } else { (source.place(first, 0.0), source.place(last, 0.0)) },
        segments: source.segments(),
        panels,
        notes: source.notes().into_iter().chain(nothing).collect(),
    })
}

/// What is shown of the columns that a row has, one of each rank.
fn chosen(row: &Row) -> Vec<&'static ShownColumn> {
    let mut found: Vec<&'static ShownColumn> = Vec::new();
    for shown in SHOWN {
        let known = found.last().is_some_and(|last| last.rank == shown.rank);
        if !known && table::named_value(row, shown.column).is_some() {
            found.push(shown);
        }
    }
    found
}

impl DiagramSource<'_> {
    /// Whether the motion repeats itself after a turn.
    fn turns(&self) -> bool {
        self.motion.period().is_some()
    }

    /// The place of a parameter after so many turns (rad): degrees of the turn, or millimetres.
    fn place(&self, parameter: f64, turns: f64) -> f64 {
        if self.turns() {
            (parameter - turns).to_degrees().clamp(0.0, 360.0)
        } else {
            self.units().of_mm(1e3 * parameter) + 0.0
        }
    }

    fn units(&self) -> LengthUnit {
        self.body.machine().units()
    }

    /// Every column at a parameter of a piece.
    fn values(&self, piece: usize, parameter: f64) -> Vec<f64> {
        let Some(row) = self.body.row_on(piece, parameter) else { return vec![f64::NAN; self.shown.len()] };
        self.shown.iter().map(|shown| table::named_value(&row, shown.column).unwrap_or(f64::NAN)).collect()
    }

    /// The smooth stretches on which a follower runs, cut where a turn begins, in the order of their places.
    fn runs(&self) -> Vec<SmoothRun> {
        let mut runs: Vec<SmoothRun> = Vec::new();
        for (piece, (from, to)) in self.body.smooth_stretches() {
            if !self.motion.is_rolled(piece) {
                continue;
            }
            let mut cuts = vec![from];
            if self.turns() {
                let inside = (-2..=2).map(|turn| TAU * f64::from(turn)).filter(|cut| from < *cut && *cut < to);
                cuts.extend(inside);
            }
            cuts.push(to);
            runs.extend(cuts.windows(2).filter_map(|ends| self.run(piece, (*ends.first()?, *ends.last()?))));
        }
        runs.sort_by(|a, b| self.start(a).total_cmp(&self.start(b)));
        runs
    }

    fn start(&self, run: &SmoothRun) -> f64 {
        run.at.first().map_or(0.0, |(at, _)| self.place(*at, run.turns))
    }

    fn run(&self, piece: usize, (from, to): (f64, f64)) -> Option<SmoothRun> {
        let (first, last) = self.motion.range();
        let share = (to - from) / (last - first);
        // Of many short pieces fewer places are enough: together they are as dense.
        #[expect(clippy::cast_precision_loss, reason = "some thousand pieces")]
        let most = (MOST_IN_ALL / self.motion.pieces().len().max(1) as f64).max(2.0);
        let least = f64::from(LEAST.max(2 * self.motion.cells(piece))).min(most);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most some thousand")]
        let count = (PLACES * share).ceil().clamp(least, MOST) as u32;
        let middle = 0.5 * (from + to);
        let turns = if self.turns() { TAU * (middle / TAU).floor() } else { 0.0 };
        let at = extremum::between_cells((from, to), count).map(|at| (at, self.values(piece, at))).collect();
        let segment = self.stretches.iter().position(|stretch| middle <= stretch.to).unwrap_or(0);
        (to > from).then_some(SmoothRun { piece, turns, at, segment })
    }

    /// The segments in the order of their places: one that goes over the start of a turn is in two parts.
    fn segments(&self) -> Vec<DiagramSegment> {
        let mut all = Vec::new();
        let level = |at: f64, later: bool| {
            let pieces = self.motion.pieces();
            let here = |piece: &camgen_kernel::motion::Piece| if later { piece.start == at } else { piece.end == at };
            pieces.iter().position(here).map_or(f64::NAN, |piece| self.motion.jet(piece, at).s)
        };
        for (index, NamedStretch { from, to, name }) in self.stretches.iter().enumerate() {
            let (piece, middle) = self.motion.locate(0.5 * (from + to));
            let lifts = [level(*from, true), self.motion.jet(piece, middle).s, level(*to, false)];
            let travel = self.travel(lifts);
            let segment = |range: (f64, f64)| DiagramSegment {
                number: index + 1,
                range,
                name: name.clone(),
                travel: travel.clone(),
            };
            if !self.turns() {
                all.push(segment((self.place(*from, 0.0), self.place(*to, 0.0))));
                continue;
            }
            let turns = TAU * (from / TAU).floor();
            all.push(segment((self.place(*from, turns), self.place(*to, turns))));
            if *to - turns > TAU * (1.0 + ROUNDING) {
                all.push(segment((0.0, self.place(*to, turns + TAU))));
            }
        }
        all.sort_by(|a, b| a.range.0.total_cmp(&b.range.0));
        all
    }

    /// "lift 0 to 30 mm", of the lifts at the start, in the middle and at the end.
    fn travel(&self, lifts: [f64; 3]) -> String {
        let (size, unit) = match (self.motion.quantity(), self.units()) {
            (Quantity::Angle, _) => (1.0_f64.to_degrees(), "°"),
            (_, LengthUnit::Millimetre) => (1e3, " mm"),
            (_, LengthUnit::Inch) => (self.units().of_mm(1e3), " in"),
        };
        let [from, middle, to] = lifts.map(|lift| figure(((size * lift.max(0.0)) * 1e4).round() / 1e4));
        match (from == to, from == middle) {
            (false, _) => format!("lift {from} to {to}{unit}"),
            (true, true) => format!("lift {to}{unit}"),
            (true, false) => format!("from lift {from} back to {to}{unit}"),
        }
    }

    fn panel(&self, index: usize, runs: &[SmoothRun], cut: &[Vec<(f64, Jet, Jet)>]) -> DiagramPanel {
        let shown = self.shown.get(index).map_or(&LIFT_MM, |shown| *shown);
        let value = |values: &[f64]| values.get(index).copied().unwrap_or(f64::NAN);
        let (size, _) = size_of(runs.iter().flat_map(|run| &run.at).map(|(_, values)| value(values)));
        let (unit, factor) = in_units(unit(shown.column, self.body.shaft_speed(), size), self.units());
        let law: Vec<DiagramRun> = runs
            .iter()
            .map(|run| run.at.iter().map(|(at, values)| [self.place(*at, run.turns), factor * value(values)]).collect())
            .collect();
        let cut = self.cut(shown, factor, cut, &law);
        DiagramPanel {
            name: self.panel_name(shown),
            unit,
            column: (shown.column, factor),
            radius: shown.rank == RADIUS,
            extremes: self.extremes(index, factor, runs),
            impulses: self.impulses(shown.rank, runs),
            law,
            cut,
        }
    }

    /// The name of a column, with the follower that it is of where the cam has several.
    fn panel_name(&self, shown: &ShownColumn) -> String {
        let follower = self.body.row_follower().filter(|_| (PRESSURE_ANGLE..=FORCE).contains(&shown.rank));
        follower.map_or_else(|| shown.name.into(), |follower| format!("{}, {}", shown.name, follower.name))
    }

    /// The motion as cut, where the difference from the motion itself can be seen.
    fn cut(
        &self,
        shown: &ShownColumn,
        factor: f64,
        cut: &[Vec<(f64, Jet, Jet)>],
        law: &[DiagramRun],
    ) -> Vec<DiagramRun> {
        let scale = factor
            * match (shown.rank, self.motion.quantity()) {
                (VELOCITY, Quantity::Length) if self.motion.is_by_travel() => 1.0,
                (ACCELERATION, Quantity::Length) if self.motion.is_by_travel() => 1e-3,
                (0, Quantity::Angle) => 1.0_f64.to_degrees(),
                (0..=ACCELERATION, Quantity::Length) => 1e3,
                (0..=ACCELERATION, Quantity::Angle) => 1.0,
                _ => return Vec::new(),
            };
        let of = |jet: &Jet| scale * [jet.s, jet.ds, jet.dds].get(shown.rank as usize).copied().unwrap_or(f64::NAN);
        let (_, [low, high]) = size_of(law.iter().flatten().map(|[_, value]| *value).chain([0.0]));
        let apart = cut.iter().flatten().map(|(_, law, cut)| (of(law) - of(cut)).abs()).fold(0.0, f64::max);
        if !(apart > SEEN * (high - low)) {
            return Vec::new();
        }
        let mut runs: Vec<DiagramRun> = cut.iter().flat_map(|points| self.turned(points, &of)).collect();
        let start = |run: &DiagramRun| run.first().map_or(0.0, |[at, _]| *at);
        runs.sort_by(|a, b| start(a).total_cmp(&start(b)));
        runs
    }

    /// The points of a stretch of the outline, in two runs where a turn begins in it.
    fn turned(&self, points: &[(f64, Jet, Jet)], of: &impl Fn(&Jet) -> f64) -> Vec<DiagramRun> {
        let mut runs: Vec<DiagramRun> = Vec::new();
        let mut before: Option<(f64, f64)> = None;
        for (from, to) in points.iter().zip(points.iter().skip(1)) {
            let middle = 0.5 * (from.0 + to.0);
            let turns = if self.turns() { TAU * (middle / TAU).floor() } else { 0.0 };
            let [start, end] = [from, to].map(|(at, _, cut)| [self.place(*at, turns), of(cut)]);
            match runs.last_mut().filter(|_| before == Some((from.0, turns))) {
                Some(run) => run.push(end),
                None => runs.push(vec![start, end]),
            }
            before = Some((to.0, turns));
        }
        runs
    }

    /// The largest and the least value of the whole and of each segment.
    fn extremes(&self, index: usize, factor: f64, runs: &[SmoothRun]) -> Vec<DiagramExtreme> {
        let rank = self.shown.get(index).map_or(0, |shown| shown.rank);
        let search = ExtremeSearch { source: self, index, radius: rank == RADIUS, runs };
        let (size, _) = size_of(search.all());
        let many = self.stretches.len() > MOST_SEGMENTS;
        let count = if many || rank == 0 { 0 } else { self.stretches.len() };
        let mut found: Vec<DiagramExtreme> = Vec::new();
        for upwards in [true, false] {
            // The lowest lift is 0 and where the follower rests.
            let overall = search.best(upwards, |_| true).filter(|_| upwards || rank != 0);
            let most = overall.map_or(0.0, |(_, value)| value.abs());
            let overall = overall.filter(|_| size > 0.0);
            let of_segment = |segment: usize| search.best(upwards, |run| run.segment == segment);
            let parts = (0..count).filter_map(of_segment).filter(|(at, value)| search.is_a_peak(*at, *value, most));
            let all = overall.map(|found| (found, true)).into_iter().chain(parts.map(|found| (found, false)));
            for (((run, at), value), overall) in all {
                let place = runs.get(run).map_or(0.0, |run| self.place(at, run.turns));
                let value = if value.abs() > ROUNDING * size { value } else { 0.0 };
                let value = factor * if rank == RADIUS { 1.0 / value } else { value };
                if found.iter().all(|known| known.upwards != upwards || (known.place - place).abs() > 1e-6) {
                    found.push(DiagramExtreme { place, value, upwards, overall });
                }
            }
        }
        found
    }

    /// Where a quantity is infinite for an instant because the one that it is the derivative of jumps.
    fn impulses(&self, rank: u32, runs: &[SmoothRun]) -> Vec<Impulse> {
        if !(ACCELERATION..=JERK).contains(&rank) {
            return Vec::new();
        }
        let jumping = (VELOCITY..rank).filter_map(|rank| self.shown.iter().position(|shown| shown.rank == rank));
        let mut found: Vec<Impulse> = Vec::new();
        for index in jumping {
            let value = |values: Option<&(f64, Vec<f64>)>| values.and_then(|(_, values)| values.get(index)).copied();
            let (size, _) = size_of(runs.iter().flat_map(|run| &run.at).filter_map(|at| value(Some(at))));
            for (before, after) in runs.iter().zip(runs.iter().cycle().skip(1)) {
                let Some((at, _)) = before.at.last() else { continue };
                let (end, start) = (self.place(*at, before.turns), self.start(after));
                let meets = (end - start).abs() < ROUNDING || (self.turns() && end - start > 360.0 - ROUNDING);
                let jump =
                    value(after.at.first()).zip(value(before.at.last())).map_or(0.0, |(after, before)| after - before);
                if meets && jump.abs() > 1e-6 * size && found.iter().all(|known| (known.place - start).abs() > ROUNDING)
                {
                    found.push(Impulse { place: start, upwards: jump > 0.0 });
                }
            }
        }
        found
    }

    fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        let shaft = if self.turns() { "cam" } else { "crank" };
        notes.push(match self.body.shaft_speed() {
            None if self.motion.is_by_travel() => {
                "Velocity, acceleration and jerk by the travel of the plate: its speed is not given.".into()
            }
            Some(speed) => format!(
                "By time, with the {shaft} at {} rpm, ω = {} rad/s: velocity, acceleration and jerk over ω, ω² and ω³ are those per rad.",
                shown(units::rpm(speed)),
                figure(speed)
            ),
            None => format!("Velocity, acceleration and jerk by the angle of the {shaft}: its speed is not given."),
        });
        notes.extend(self.body.row_follower().map(|follower| {
            format!(
                "Pressure angle, radius of curvature and contact force are those of the {}; the greatest pressure angle of all followers is {}°.",
                follower.name,
                shown(follower.greatest_pressure_angle.to_degrees())
            )
        }));
        let has = |rank: u32| self.shown.iter().any(|shown| shown.rank == rank);
        if !has(FORCE) {
            notes.push("No force on the follower is known: contact force and torque are left out.".into());
        }
        notes
    }
}

/// Largest size of values, and the least and the largest of them; of those that are finite.
fn size_of(values: impl Iterator<Item = f64>) -> (f64, [f64; 2]) {
    let [low, high] = values
        .filter(|value| value.is_finite())
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)]);
    if low > high { (0.0, [0.0; 2]) } else { (high.max(-low), [low, high]) }
}

/// A unit of lengths and the factor to it in the unit of the diagram.
fn in_units((name, factor): (&'static str, f64), units: LengthUnit) -> (&'static str, f64) {
    if units == LengthUnit::Millimetre {
        return (name, factor);
    }
    let metre = 1e3;
    let (inch, millimetres, power) = match name {
        "mm" => ("in", 1.0, 1),
        "mm/rad" => ("in/rad", 1.0, 1),
        "mm/rad²" => ("in/rad²", 1.0, 1),
        "mm/rad³" => ("in/rad³", 1.0, 1),
        "mm/s" => ("in/s", 1.0, 1),
        "m/s" => ("in/s", metre, 1),
        "mm/s²" => ("in/s²", 1.0, 1),
        "m/s²" => ("in/s²", metre, 1),
        "mm/s³" => ("in/s³", 1.0, 1),
        "m/s³" => ("in/s³", metre, 1),
        "mm/mm" => ("in/in", 1.0, 0),
        "mm/mm²" => ("in/in²", 1.0, -1),
        "mm/mm³" => ("in/in³", 1.0, -2),
        other => (other, 1.0, 0),
    };
    (inch, units.of_mm_to(millimetres * factor, power))
}

/// The unit of a column in the diagram, and the factor of its values: by time where the speed of the shaft is known, rad/s.
fn unit(column: &str, speed: Option<f64>, size: f64) -> (&'static str, f64) {
    let by_time = |order: i32, of_time: [&'static str; 2], by_angle: &'static str| match speed {
        None => (by_angle, 1.0),
        Some(speed) => {
            let factor = speed.powi(order);
            let [usual, large] = of_time;
            if size * factor >= LARGE && usual != large { (large, 1e-3 * factor) } else { (usual, factor) }
        }
    };
    match column {
        "lift_deg" | "pressure_angle_deg" => ("°", 1.0),
        "velocity_mm_per_rad" => by_time(1, ["mm/s", "m/s"], "mm/rad"),
        "velocity_rad_per_rad" => by_time(1, ["rad/s"; 2], "rad/rad"),
        "acceleration_mm_per_rad2" => by_time(2, ["mm/s²", "m/s²"], "mm/rad²"),
        "acceleration_rad_per_rad2" => by_time(2, ["rad/s²"; 2], "rad/rad²"),
        "velocity_mm_per_mm" => ("mm/mm", 1.0),
        "acceleration_mm_per_mm2" => ("mm/mm²", 1.0),
        "jerk_mm_per_mm3" => ("mm/mm³", 1.0),
        "jerk_mm_per_rad3" => by_time(3, ["mm/s³", "m/s³"], "mm/rad³"),
        "jerk_rad_per_rad3" => by_time(3, ["rad/s³"; 2], "rad/rad³"),
        "contact_force_n" | "roller_force_n" if size >= LARGE => ("kN", 1e-3),
        "contact_force_n" | "roller_force_n" => ("N", 1.0),
        "torque_nm" if size >= LARGE => ("kN·m", 1e-3),
        "torque_nm" => ("N·m", 1.0),
        _ => ("mm", 1.0),
    }
}

/// The search of the extremes of one column.
struct ExtremeSearch<'a> {
    source: &'a DiagramSource<'a>,
    index: usize,
    /// Of a radius the curvature is searched.
    radius: bool,
    runs: &'a [SmoothRun],
}

/// A run and a parameter in it.
type RunPlace = (usize, f64);

impl ExtremeSearch<'_> {
    fn of(&self, values: &[f64]) -> f64 {
        let value = values.get(self.index).copied().unwrap_or(f64::NAN);
        if self.radius { 1.0 / value } else { value }
    }

    /// Every value.
    fn all(&self) -> impl Iterator<Item = f64> {
        self.runs.iter().flat_map(|run| &run.at).map(|(_, values)| self.of(values))
    }

    /// The largest, or the least, value over some of the runs; of a curvature one of this sign.
    fn best(&self, upwards: bool, searched: impl Fn(&SmoothRun) -> bool) -> Option<(RunPlace, f64)> {
        let sign = if upwards { 1.0 } else { -1.0 };
        let mut best: Option<(RunPlace, f64)> = None;
        for (number, run) in self.runs.iter().enumerate().filter(|(_, run)| searched(run)) {
            let highest = |best: Option<(usize, f64)>, (index, value): (usize, f64)| {
                // The first of equals.
                let higher = best.is_none_or(|(_, known)| value > known + 1e-9 * known.abs());
                if higher { Some((index, value)) } else { best }
            };
            let values = run.at.iter().map(|(_, values)| sign * self.of(values)).enumerate();
            let Some((index, value)) = values.filter(|(_, value)| value.is_finite()).fold(None, highest) else {
                continue;
            };
            let found = self.refined(number, run, (index, value), sign);
            if best.is_none_or(|(_, known)| found.1 > known + 1e-9 * known.abs()) {
                best = Some(found);
            }
        }
        best.map(|(place, value)| (place, sign * value)).filter(|(_, value)| !self.radius || sign * value > 0.0)
    }

    /// The highest value near that of a place of a run.
    fn refined(&self, number: usize, run: &SmoothRun, (index, value): (usize, f64), sign: f64) -> (RunPlace, f64) {
        let parameter = |index: usize| run.at.get(index.min(run.at.len().saturating_sub(1))).map_or(0.0, |(at, _)| *at);
        let (from, to) = (parameter(index.saturating_sub(1)), parameter(index + 1));
        let at = |parameter: f64| sign * self.of(&self.source.values(run.piece, parameter));
        let found = extremum::largest_without_slope(at, (from, to), 2, extremum::TO_ROUNDING);
        if found.value > value + 1e-12 * value.abs() {
            ((number, found.at), found.value)
        } else {
            ((number, parameter(index)), value)
        }
    }

    /// Whether a value of a segment is higher, or lower, than what is next to it, and large enough to be marked.
    fn is_a_peak(&self, (number, at): RunPlace, value: f64, most: f64) -> bool {
        let Some(run) = self.runs.get(number).filter(|_| value.abs() > WORTH * most) else { return false };
        let ends = [run.at.first(), run.at.last()].map(|end| end.map_or(f64::NAN, |(at, _)| *at));
        let neighbour = |index: usize, first: bool| {
            let run = self.runs.get(index % self.runs.len().max(1))?;
            if first { run.at.first() } else { run.at.last() }
        };
        let before = number + self.runs.len() - 1;
        let next_to = match ends {
            [first, _] if at == first => neighbour(before, false),
            [_, last] if at == last => neighbour(number + 1, true),
            _ => return true,
        };
        // At the end of a stretch only a step makes a peak.
        next_to.is_some_and(|(_, values)| {
            let beyond = self.of(values);
            (beyond - value).abs() > 1e-6 * most && beyond.abs() < value.abs()
        })
    }
}
