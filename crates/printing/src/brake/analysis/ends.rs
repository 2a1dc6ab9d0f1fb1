//! The paper's own sizing from the two ends of the roll, equations (7) to (10), without a frame.

use super::{Analysis, BrakeMachine, KIND, curves, sections};
use crate::brake::checks::{BELT_RANGE, WEB_STRESS};
use crate::brake::mechanics::ends::{Regulation, RollEnds};
use camgen_cams::analysis::Picture;
use camgen_cams::check::Measure;
use camgen_cams::report::plot::{Plot, figure};
use camgen_cams::report::{Section, Speeds};
use camgen_cams::table::{ListedColumn, Table};
use camgen_kernel::document::Input;
use camgen_kernel::refusal::Refusal;
use serde::Serialize;

/// One end of the roll.
struct EndRow {
    wrap: f64,
    k: f64,
    press: f64,
    belt_speed: f64,
    /// K N of a stationary belt, N.
    standing: f64,
}

const COLUMNS: &[ListedColumn<EndRow>] = &[
    ("wrap_deg", |row| row.wrap.to_degrees()),
    ("k", |row| row.k),
    ("press_force_n", |row| row.press),
    ("belt_speed_ratio", |row| row.belt_speed),
    ("tension_standing_belt_n", |row| row.standing),
];

/// The section `ends`.
#[derive(Debug, Serialize)]
struct EndFigures {
    k_full: f64,
    k_run_down: f64,
    press_full_n: f64,
    press_run_down_n: f64,
    belt_speed_ratio_full: f64,
    belt_speed_ratio_run_down: f64,
    belt_speed_range: f64,
    belt_speed_range_of_slip: f64,
    tension_in_truth_n: f64,
}

/// The analysis for the two ends of the roll.
pub(super) fn analysis(machine: &BrakeMachine, ends: &RollEnds) -> Result<Analysis, Refusal> {
    let data = &machine.data;
    let slip = 1.0 - data.belt_speed_ratio;
    let regulation = ends.regulation(data.tension, slip)?;
    let (full, run_down) = ends.coefficients();
    let figures = EndFigures {
        k_full: full,
        k_run_down: run_down,
        press_full_n: regulation.press_full,
        press_run_down_n: regulation.press_empty,
        belt_speed_ratio_full: regulation.belt_speed_full,
        belt_speed_ratio_run_down: regulation.belt_speed_empty,
        belt_speed_range: regulation.range,
        belt_speed_range_of_slip: ends.range_of_slip(),
        // With both spans equally tight the moment about the roll is K N, at any speed of the belt.
        tension_in_truth_n: full * regulation.press_full,
    };
    let mut inputs = vec![Input::word("command", KIND.command)];
    inputs.extend(machine.inputs().iter().cloned());
    let mut sections = vec![Section::new("ends", &figures).with_words(describe(&figures))];
    sections.extend(sections::web(data, None));
    Ok(Analysis {
        kind: &KIND,
        variant: "",
        machine: machine.name().to_owned(),
        speeds: Speeds::Any(()),
        inputs,
        sections,
        measures: measures(machine, &regulation),
        notes: vec!["without [brake.frame] only the paper's equations (7) to (10) are evaluated".into()],
        picture: Picture::Curves(Plot {
            title: format!(
                "The belt's grip K falls from {} on the full roll to {} on the run-down one",
                figure(figures.k_full.max(figures.k_run_down)),
                figure(figures.k_full.min(figures.k_run_down))
            ),
            subtitle: format!("{}: the two ends of the roll by equations (7) to (10)", machine.name()),
            own: vec![
                curves::coefficient(data.friction, &ends.wraps()),
                curves::by_belt_speed(data, figures.tension_in_truth_n),
            ],
            ..Plot::default()
        }),
        mechanism: None,
        document: None,
        tables: vec![("", Table::listed(COLUMNS, &rows(ends, &regulation)))],
        by: &[],
        along: "wrap_deg",
        diagrams: curves::DIAGRAMS,
        not_modelled: vec![
            "The frame: without its arms the moment of the friction about the pivot is neglected, equation (3).",
        ],
    })
}

fn rows(ends: &RollEnds, regulation: &Regulation) -> [EndRow; 2] {
    let ([full, run_down], (k_full, k_run_down)) = (ends.wraps(), ends.coefficients());
    [
        EndRow {
            wrap: full,
            k: k_full,
            press: regulation.press_full,
            belt_speed: regulation.belt_speed_full,
            standing: k_full * regulation.press_full,
        },
        EndRow {
            wrap: run_down,
            k: k_run_down,
            press: regulation.press_empty,
            belt_speed: regulation.belt_speed_empty,
            standing: k_run_down * regulation.press_empty,
        },
    ]
}

fn measures(machine: &BrakeMachine, regulation: &Regulation) -> Vec<Measure> {
    let (first, last) = (regulation.belt_speed_full, regulation.belt_speed_empty);
    let note = format!("V_z/V by (9): {first:.6} on the full roll, {last:.6} on the run-down roll");
    let mut all = vec![BELT_RANGE.measure(first.min(last), Some(0.0)).noted(note)];
    let limit = machine.limits.web_stress.map(|limit| 1e-6 * limit);
    all.extend(machine.data.web.map(|web| WEB_STRESS.measure(1e-6 * web.stress(machine.data.tension), limit)));
    all
}

fn describe(figures: &EndFigures) -> Vec<String> {
    vec![
        format!("(7) K {:.6} on the full roll, {:.6} on the run-down roll", figures.k_full, figures.k_run_down),
        format!(
            "(8) press force G h1/h2 {:.2} N on the full roll, {:.2} N on the run-down roll; (9) V_z/V {:.6} on the run-down roll",
            figures.press_full_n, figures.press_run_down_n, figures.belt_speed_ratio_run_down
        ),
        format!(
            "(10) range {:.4} % of V, {:.4} % of the starting slip",
            100.0 * figures.belt_speed_range,
            100.0 * figures.belt_speed_range_of_slip
        ),
        format!(
            "in fact the speed of a slipping belt regulates nothing: that press force makes a tension of {:.2} N",
            figures.tension_in_truth_n
        ),
    ]
}
