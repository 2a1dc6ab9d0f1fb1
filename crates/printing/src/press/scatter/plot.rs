//! The curves of the scatter on paper.

use super::monte_carlo::Samples;
use super::parameter::Parameter;
use super::reset::ScrewRule;
use super::tables::{PercentileRow, PlaceRow, SettingRow};
use camgen_cams::report::plot::{self, Plot, PlotCurve, PlotPanel};
use camgen_cams::report::shown;
use camgen_kernel::document::NamedChoice;
use camgen_kernel::geometry::MILLIMETRES;

/// Points of a curve of a distribution.
const POINTS: usize = 200;

fn curve(name: &str, colour: usize, bold: bool, points: Vec<[f64; 2]>) -> PlotCurve {
    PlotCurve { name: name.into(), colour, bold, points }
}

/// The plot: effects of the half widths over the overrun, distributions with their P95, and the settings.
pub(super) fn plot(
    machine: &str,
    rpm: f64,
    places: &[PlaceRow],
    settings: &[SettingRow],
    samples: &Samples,
    percentiles: &[PercentileRow],
    rule: ScrewRule,
) -> Plot {
    let mut effects = Vec::new();
    for (index, parameter) in Parameter::ALL.into_iter().enumerate() {
        if parameter == Parameter::Screw {
            continue;
        }
        let braking = places.iter().filter(|place| !place.back);
        let points = braking.map(|place| [MILLIMETRES * place.x, place.effects.get(index).copied().unwrap_or(0.0)]);
        effects.push(curve(&parameter.name().replace('_', " "), index, true, points.collect()));
    }
    let mut own = Vec::new();
    if !samples.as_built.is_empty() {
        own.push(("largest residual force of a press, N".to_owned(), distributions(samples, percentiles)));
    }
    own.push(("v = (n/n_c)² (m/m_c) (p0/p0')".to_owned(), residuals(settings, rule)));
    own.push(("v = (n/n_c)² (m/m_c) (p0/p0')".to_owned(), columns(settings)));
    Plot {
        title: format!("{machine}: what is left of the cam for {} rpm in practice", shown(rpm)),
        places: "overrun x of the bed, mm".into(),
        panels: vec![PlotPanel {
            name: "Residual force of the half width of each parameter, N".into(),
            curves: effects,
        }],
        own,
        scheme: None,
    }
}

/// The shares of the presses that leave less, with a mark at P95.
fn distributions(samples: &Samples, percentiles: &[PercentileRow]) -> PlotPanel {
    let lists = [("as built", &samples.as_built), ("reset", &samples.reset), ("fixed bottom", &samples.fixed)];
    let mut curves = Vec::new();
    for (colour, (name, sorted)) in lists.into_iter().enumerate() {
        if sorted.is_empty() {
            continue;
        }
        #[expect(clippy::cast_precision_loss, reason = "a few hundred points")]
        let points = (0..=POINTS).filter_map(|step| {
            let size = sorted.get(step * (sorted.len() - 1) / POINTS)?;
            Some([*size, 100.0 * (step as f64 / POINTS as f64)])
        });
        let points = points.collect();
        curves.push(curve(name, colour, true, points));
    }
    for row in percentiles.iter().filter(|row| row.percentile == 95.0) {
        let colour = match (row.body, row.reset) {
            (super::tables::FIXED, _) => 2,
            (_, "none") => 0,
            _ => 1,
        };
        curves.push(curve("", colour, true, vec![[row.residual_n, 95.0]]));
    }
    PlotPanel { name: "Share of the presses that leave less, %; marks: P95".into(), curves }
}

fn over_variable(settings: &[SettingRow], value: fn(&SettingRow) -> f64) -> Vec<[f64; 2]> {
    settings.iter().map(|row| [row.v, value(row)]).collect()
}

/// Residual forces of both over the variable.
fn residuals(settings: &[SettingRow], rule: ScrewRule) -> PlotPanel {
    PlotPanel {
        name: format!("Residual force, reset of the screw: {}, N", rule.word()),
        curves: vec![
            curve("cam", 0, true, over_variable(settings, |row| row.residual_n)),
            curve("fixed bottom", plot::GREY, false, over_variable(settings, |row| row.fixed_residual_n)),
        ],
    }
}

/// The columns of both over the variable.
fn columns(settings: &[SettingRow]) -> PlotPanel {
    PlotPanel {
        name: "Air column, mm".into(),
        curves: vec![
            curve("cam", 0, true, over_variable(settings, |row| row.column_mm)),
            curve("fixed bottom", plot::GREY, false, over_variable(settings, |row| row.fixed_column_mm)),
        ],
    }
}
