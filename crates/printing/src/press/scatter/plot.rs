//! The scatter on paper: bars of what each parameter leaves alone, as built and after a reset, and ranges of what all leave together.

use super::parameter::Parameter;
use super::reset::ScrewRule;
use super::tables::{CAM, FIXED, ParameterRow, PercentileRow};
use camgen_cams::report::plot::{BarChart, BarRow, PictureColour, Plot, SpanChart, SpanRow, figure};
use camgen_kernel::document::NamedChoice;

/// A screw travel below this is none, mm.
const NO_TRAVEL: f64 = 0.05;
/// A share of the variance below this is not told apart.
const SMALL_SHARE: f64 = 0.01;
/// The percentile of the answer.
const MOST: f64 = 95.0;

/// What the picture is made from.
pub(super) struct ScatterFigures<'a> {
    pub(super) machine: &'a str,
    pub(super) rpm: f64,
    /// The parameters, that which leaves most as built first.
    pub(super) ranked: Vec<&'a ParameterRow>,
    pub(super) percentiles: &'a [PercentileRow],
    pub(super) samples: u32,
    pub(super) rule: ScrewRule,
}

/// Size of the residual force after the reset of a rule, N.
fn after_reset(row: &ParameterRow, rule: ScrewRule) -> f64 {
    match rule {
        ScrewRule::None => f64::NAN,
        ScrewRule::End => row.residual_end_n.abs(),
        ScrewRule::Level => row.residual_level_n.unwrap_or(f64::NAN).abs(),
    }
}

/// Travel of the screw by a rule, mm.
fn travel(row: &ParameterRow, rule: ScrewRule) -> f64 {
    match rule {
        ScrewRule::None => f64::NAN,
        ScrewRule::End => row.column_end_mm,
        ScrewRule::Level => row.column_level_mm.unwrap_or(f64::NAN),
    }
}

/// The name of a parameter for a person.
fn name(parameter: &str) -> String {
    match Parameter::named(parameter) {
        Some(Parameter::Exponent) => "exponent of the air".into(),
        Some(Parameter::Mass) => "mass of the bed".into(),
        Some(Parameter::Column) => "air column".into(),
        Some(Parameter::Phase) => "phase of the cam".into(),
        Some(Parameter::Screw) => "setting of the screw".into(),
        _ => parameter.replace('_', " "),
    }
}

fn bar(row: &ParameterRow, rule: ScrewRule) -> BarRow {
    let half_width = row.half_width_words().replace(" deg", "°");
    let moved = travel(row, rule);
    let share = row.share_of_variance;
    let cell = match moved {
        moved if !(moved.abs() >= NO_TRAVEL) => "–".to_owned(),
        moved if moved > 0.0 => format!("+{}", figure((10.0 * moved).round() / 10.0)),
        moved => figure((10.0 * moved).round() / 10.0),
    };
    let share_text =
        if share < SMALL_SHARE { "below 1 %".to_owned() } else { format!("{} %", figure((100.0 * share).round())) };
    BarRow {
        name: name(row.parameter),
        note: if row.parameter == Parameter::AirLost.name() { half_width } else { format!("±{half_width}") },
        before: row.residual_n.abs(),
        after: after_reset(row, rule),
        cell,
        share: Some((share, share_text)),
    }
}

/// Half, 95 and 99 of 100 presses, for a body with a reset, N.
fn percentiles_of(rows: &[PercentileRow], body: &str, reset: &str) -> Option<[f64; 3]> {
    let at = |percentile: f64| {
        let mut of_body = rows.iter().filter(|row| row.body == body && row.reset == reset);
        of_body.find(|row| row.percentile == percentile).map(|row| row.residual_n)
    };
    let most = at(MOST)?;
    Some([at(50.0)?, most, at(99.0).unwrap_or(most)])
}

/// What the screw makes of the scatter.
fn headline(figures: &ScatterFigures<'_>, [built, reset, fixed]: [Option<[f64; 3]>; 3]) -> String {
    let most = |values: Option<[f64; 3]>| values.map(|[_, most, _]| most);
    let largest = figures.ranked.first();
    match (most(built), most(reset), most(fixed)) {
        (_, Some(reset), Some(fixed)) if reset >= fixed => {
            format!(
                "A fixed bottom is better: {} N with the cam, {} N without, in 95 of 100 presses",
                figure(reset),
                figure(fixed)
            )
        }
        (Some(built), Some(reset), _) if reset < built => {
            format!("Reset the screw: 95 of 100 presses then leave less than {} N", figure(reset))
        }
        (Some(built), ..) => format!("95 of 100 presses leave less than {} N as built", figure(built)),
        _ => largest.map_or_else(String::new, |row| {
            format!("The {} leaves most: {} N alone", name(row.parameter), figure(row.residual_n.abs()))
        }),
    }
}

/// Bars and ranges of the scatter.
pub(super) fn plot(figures: &ScatterFigures<'_>) -> Plot {
    let rule = figures.rule;
    let of_fixed = if rule == ScrewRule::None { "none" } else { "end" };
    let built = percentiles_of(figures.percentiles, CAM, "none");
    let reset = percentiles_of(figures.percentiles, CAM, rule.word()).filter(|_| rule != ScrewRule::None);
    let fixed = percentiles_of(figures.percentiles, FIXED, of_fixed);
    let span = |name: &str, values: Option<[f64; 3]>, colour: usize| {
        let values = values?;
        let text = format!("{} N", figure(values[1]));
        Some(SpanRow { name: name.into(), values, text, colour: PictureColour::Line(colour) })
    };
    let fixed_name = if rule == ScrewRule::None { "fixed bottom" } else { "fixed bottom, reset" };
    let rows = [span("cam, screw reset", reset, 0), span("cam, as built", built, 4), span(fixed_name, fixed, 1)];
    let rows: Vec<SpanRow> = rows.into_iter().flatten().collect();
    let all = |values: Option<[f64; 3]>, what: &str| {
        values.map(|[_, most, _]| format!("{what} {} N", figure(most))).into_iter()
    };
    let others: Vec<String> = all(built, "as built").chain(all(fixed, "with a fixed bottom")).collect();
    let others = if others.is_empty() { String::new() } else { format!(": {}", others.join(", ")) };
    Plot {
        title: headline(figures, [built, reset, fixed]),
        subtitle: format!(
            "{}, {} rpm{others} ({} presses drawn, reset rule “{}”)",
            figures.machine,
            figure(figures.rpm),
            figure(f64::from(figures.samples)),
            rule.word()
        ),
        bars: Some(BarChart {
            name: "Force left by one band alone, N".into(),
            keys: ["as built".into(), "with the screw reset (its travel at the right)".into()],
            heads: ["screw, mm".into(), "share of the scatter".into()],
            rows: figures.ranked.iter().map(|row| bar(row, rule)).collect(),
        }),
        spans: (!rows.is_empty()).then(|| SpanChart {
            name: "All bands at once, N: half of the presses, 95 of 100 (large dot) and 99 of 100 leave less".into(),
            limit: fixed.map(|[_, most, _]| (most, "worse than no cam".to_owned())),
            rows,
        }),
        ..Plot::default()
    }
}
