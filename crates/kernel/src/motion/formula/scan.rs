//! Where a formula has no value or no derivative, and how often it turns.
//!
//! Each operation that is not defined everywhere has a guard: the denominator of a quotient, the argument of a logarithm or a root,
//! 1 − a² of an arcsine, the cosine under a tangent. It is evaluated with its slope on a grid; where it changes its sign between two
//! places, or comes nearest to 0 there, that place is found by bisection and evaluated as well.

use super::FormulaTape;
use crate::numeric::series::tape::{ElementaryFunction, SeriesRows, TapeOperation};

/// Cells of the grid: every whole degree of a turn, and every simple share of a segment, is a place of it.
const CELLS: u32 = 2520;
/// The value and the derivatives up to the jerk.
const ORDERS: usize = 4;
/// A derivative of this share of its largest value is rounding.
const ROUNDING: f64 = 1e-9;
/// Bisections of a cell to rounding.
const BISECTIONS: u32 = 50;
/// Most cells that are bisected, which bounds the time.
const MOST_BISECTED: u32 = 300;
/// A guard this much smaller than near it counts as 0.
const NOTHING: f64 = 1e-12;

/// The result of a scan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scan {
    /// Smallest and largest value.
    pub range: (f64, f64),
    /// Changes of sign of a derivative up to the jerk, if it changed everywhere as often as where it changes most.
    pub turns: u32,
}

/// A place without a value or derivative.
#[derive(Debug, Clone, PartialEq)]
pub struct Singularity {
    /// The variable there.
    pub place: f64,
    /// The character of the text, from 1.
    pub at: usize,
    /// What happens there.
    pub what: String,
}

/// A value that must not vanish, or must not be negative.
#[derive(Debug, Clone, Copy)]
struct Guard {
    value: f64,
    slope: f64,
    /// It may be negative too.
    signed: bool,
}

/// A place with the series of all operations.
struct Evaluation<'t> {
    text: &'t FormulaTape,
    place: f64,
    rows: SeriesRows<'t>,
}

impl<'t> Evaluation<'t> {
    fn new(text: &'t FormulaTape, place: f64) -> Self {
        Self { text, place, rows: text.tape.rows(place, ORDERS) }
    }

    /// The value of the argument of an operation.
    fn argument(&self, operation: TapeOperation) -> Option<f64> {
        let term = operation.arguments().into_iter().flatten().last()?;
        self.rows.series(term).first().copied()
    }

    /// The guard of an operation, where it has one.
    fn guard(&self, operation: TapeOperation) -> Option<Guard> {
        let (TapeOperation::Quotient(_, term) | TapeOperation::Of(_, term)) = operation else { return None };
        let (value, slope) = match self.rows.series(term) {
            [value, slope, ..] => (*value, *slope),
            _ => (0.0, 0.0),
        };
        match operation {
            TapeOperation::Quotient(..) => Some(Guard { value, slope, signed: true }),
            TapeOperation::Of(ElementaryFunction::Logarithm | ElementaryFunction::Power(_), _) => {
                Some(Guard { value, slope, signed: false })
            }
            TapeOperation::Of(ElementaryFunction::ArcSine | ElementaryFunction::ArcCosine, _) => {
                let inside = (1.0 - value) * (1.0 + value);
                Some(Guard { value: inside, slope: -2.0 * value * slope, signed: false })
            }
            TapeOperation::Of(ElementaryFunction::Tangent, _) => {
                let (sine, cosine) = libm::sincos(value);
                Some(Guard { value: cosine, slope: -sine * slope, signed: true })
            }
            _ => None,
        }
    }

    /// The first operation without a value or derivative here.
    fn fault(&self) -> Option<Singularity> {
        let placed = self.text.tape.operations.iter().zip(&self.text.characters);
        let ((operation, at), row) =
            placed.zip(self.rows.iter()).find(|(_, row)| row.iter().any(|value| !value.is_finite()))?;
        let valued = row.first().is_some_and(|value| value.is_finite());
        let argument = self.argument(*operation).unwrap_or(f64::NAN);
        Some(Singularity { place: self.place, at: *at, what: describe(*operation, argument, valued) })
    }
}

/// What is wrong with an operation of an argument, which may have a value without derivatives.
fn describe(operation: TapeOperation, argument: f64, valued: bool) -> String {
    let name = match operation {
        TapeOperation::Quotient(..) => return "a division by 0".into(),
        TapeOperation::Of(ElementaryFunction::Logarithm, _) => "the logarithm",
        TapeOperation::Of(ElementaryFunction::Power(0.5), _) => "the square root",
        TapeOperation::Of(ElementaryFunction::Power(_), _) => "the power, which is not whole,",
        TapeOperation::Of(ElementaryFunction::ArcSine, _) => "the arcsine",
        TapeOperation::Of(ElementaryFunction::ArcCosine, _) => "the arccosine",
        TapeOperation::Of(ElementaryFunction::Tangent, _) => "the tangent",
        _ => return "the value or a derivative up to the third is infinite".into(),
    };
    let without = if valued { "has no finite derivative up to the third" } else { "has no value" };
    format!("{name} of {argument} {without}")
}

pub(super) fn scan(text: &FormulaTape, low: f64, high: f64) -> Result<Scan, Singularity> {
    let mut found = Scan { range: (f64::INFINITY, f64::NEG_INFINITY), turns: 0 };
    let mut derivatives: [Vec<f64>; ORDERS - 1] = Default::default();
    let mut bisected = 0;
    let mut before: Option<Evaluation> = None;
    for cell in 0..=CELLS {
        let place = if cell == CELLS { high } else { low + (high - low) * (f64::from(cell) / f64::from(CELLS)) };
        let here = Evaluation::new(text, place);
        if let Some(before) = &before {
            between(before, &here, &mut bisected)?;
        }
        if let Some(singular) = here.fault() {
            return Err(singular);
        }
        let row = here.rows.result();
        let value = row.first().copied().unwrap_or(0.0);
        found.range = (found.range.0.min(value), found.range.1.max(value));
        for (all, derivative) in derivatives.iter_mut().zip(row.iter().skip(1)) {
            all.push(*derivative);
        }
        before = Some(here);
    }
    found.turns = derivatives.iter().map(|values| turns(values)).max().unwrap_or(0);
    Ok(found)
}

/// How many of the shortest distance between two changes of sign fit into the grid, ignoring rounding; 1 with one change, 0 without.
fn turns(values: &[f64]) -> u32 {
    let least = ROUNDING * values.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
    let mut last: Option<(u32, f64)> = None;
    let (mut change, mut shortest): (Option<f64>, f64) = (None, f64::INFINITY);
    for (cell, value) in (0_u32..).zip(values).filter(|(_, value)| value.abs() > least) {
        if let Some((before, other)) = last.filter(|(_, other)| other * value < 0.0) {
            let at = f64::from(before) + f64::from(cell - before) * (other / (other - value));
            shortest = change.map_or(shortest, |change| shortest.min(at - change));
            change = Some(at);
        }
        last = Some((cell, *value));
    }
    if shortest.is_infinite() {
        return u32::from(change.is_some());
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between its bounds")]
    let turns = (f64::from(CELLS) / shortest).round().clamp(1.0, f64::from(CELLS)) as u32;
    turns
}

/// Looks for a guard that vanishes between two places.
fn between(left: &Evaluation, right: &Evaluation, bisected: &mut u32) -> Result<(), Singularity> {
    let text = left.text;
    for (operation, at) in text.tape.operations.iter().zip(&text.characters) {
        let (Some(a), Some(b)) = (left.guard(*operation), right.guard(*operation)) else { continue };
        let crosses = a.value * b.value < 0.0;
        let dips = a.value * a.slope < 0.0 && b.value * b.slope > 0.0;
        if !(crosses || dips) || *bisected >= MOST_BISECTED {
            continue;
        }
        *bisected += 1;
        let (mut low, mut high) = (left.place, right.place);
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            let ahead = Evaluation::new(text, middle)
                .guard(*operation)
                .is_some_and(|found| if crosses { found.value * a.value > 0.0 } else { found.slope * a.slope > 0.0 });
            if ahead { low = middle } else { high = middle }
        }
        let here = Evaluation::new(text, high);
        let least = here.guard(*operation).map_or(0.0, |found| found.value);
        let vanishes = if a.signed { least.abs() } else { least } <= NOTHING * a.value.abs().min(b.value.abs());
        // Where the argument of a root crosses 0 the next place of the grid has no value.
        if crosses || vanishes || here.fault().is_some() {
            let outside = if a.signed { 0.0 } else { least.min(0.0) };
            let what = describe(*operation, here.argument(*operation).unwrap_or(outside), false);
            let fault = here.fault().map_or(what, |fault| fault.what);
            return Err(Singularity { place: here.place, at: *at, what: fault });
        }
    }
    Ok(())
}
