//! The paper's own sizing from the two ends of the roll, equations (7) to (10), without a frame.

use super::{Analysis, BELT_RANGE, BrakeMachine, KIND, Measure, WEB_STRESS, curves, told};
use crate::brake::BrakeError;
use crate::brake::ends::{Ends, Regulation};
use crate::document::Input;
use crate::report::plot::Plot;
use crate::report::{Section, Speeds};
use crate::table::{Table, Told};
use serde::Serialize;

/// One end of the roll.
struct Row {
    wrap: f64,
    k: f64,
    press: f64,
    belt_speed: f64,
    /// K N of a standing belt, N.
    standing: f64,
}

const TOLD: &[Told<Row>] = &[
    ("wrap_deg", |row| row.wrap.to_degrees()),
    ("k", |row| row.k),
    ("press_force_n", |row| row.press),
    ("belt_speed_ratio", |row| row.belt_speed),
    ("tension_standing_belt_n", |row| row.standing),
];

/// The section `ends`.
#[derive(Debug, Serialize)]
struct Figures {
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

/// Of the two ends.
pub(super) fn analysis(machine: &BrakeMachine, ends: &Ends) -> Result<Analysis, BrakeError> {
    let data = &machine.data;
    let slip = 1.0 - data.belt_speed_ratio;
    let regulation = ends.regulation(data.tension, slip)?;
    let (full, run_down) = ends.coefficients();
    let told = Figures {
        k_full: full,
        k_run_down: run_down,
        press_full_n: regulation.press_full,
        press_run_down_n: regulation.press_empty,
        belt_speed_ratio_full: regulation.belt_speed_full,
        belt_speed_ratio_run_down: regulation.belt_speed_empty,
        belt_speed_range: regulation.range,
        belt_speed_range_of_slip: ends.range_of_slip(),
        // With both spans equally tight the moment about the roll is K N, whatever the belt's speed.
        tension_in_truth_n: full * regulation.press_full,
    };
    let mut inputs = vec![Input::word("command", KIND.command)];
    inputs.extend(machine.inputs().iter().cloned());
    let mut sections = vec![Section::new("ends", &told).with_words(words(&told))];
    sections.extend(told::web(data, None));
    Ok(Analysis {
        kind: &KIND,
        machine: machine.name().to_owned(),
        speeds: Speeds::Any(()),
        inputs,
        sections,
        measures: measures(machine, &regulation),
        notes: vec!["without [brake.frame] only the paper's equations (7) to (10) are told".into()],
        plot: Plot {
            title: format!("{}: the two ends of the roll by equations (7) to (10)", machine.name()),
            own: vec![
                curves::coefficient(data.friction, &ends.wraps()),
                curves::by_belt_speed(data, told.tension_in_truth_n),
            ],
            ..Plot::default()
        },
        mechanism: None,
        document: None,
        tables: vec![("", Table::listed(TOLD, &rows(ends, &regulation)))],
        by: &[],
        along: "wrap_deg",
        not_modelled: vec![
            "The frame: without its arms the moment of the friction about the pivot is left out, equation (3).",
        ],
    })
}

fn rows(ends: &Ends, regulation: &Regulation) -> [Row; 2] {
    let ([full, run_down], (k_full, k_run_down)) = (ends.wraps(), ends.coefficients());
    let row = |wrap, k, press, belt_speed| Row { wrap, k, press, belt_speed, standing: k * press };
    [
        row(full, k_full, regulation.press_full, regulation.belt_speed_full),
        row(run_down, k_run_down, regulation.press_empty, regulation.belt_speed_empty),
    ]
}

fn measures(machine: &BrakeMachine, regulation: &Regulation) -> Vec<Measure> {
    let (first, last) = (regulation.belt_speed_full, regulation.belt_speed_empty);
    let note = format!("V_z/V by (9): {first:.6} on the full roll, {last:.6} where it has run down");
    let mut all =
        vec![Measure { check: BELT_RANGE, value: first.min(last), limit: Some(0.0), unit: "1", note: Some(note) }];
    all.extend(machine.data.web.map(|web| Measure {
        check: WEB_STRESS,
        value: 1e-6 * web.stress(machine.data.tension),
        limit: machine.limits.web_stress.map(|limit| 1e-6 * limit),
        unit: "MPa",
        note: None,
    }));
    all
}

fn words(told: &Figures) -> Vec<String> {
    vec![
        format!("(7) K {:.9} on the full roll, {:.9} where it has run down", told.k_full, told.k_run_down),
        format!(
            "(8) press force G h1/h2 {:.6} N, {:.6} N at the end; (9) V_z/V {:.9} at the end",
            told.press_full_n, told.press_run_down_n, told.belt_speed_ratio_run_down
        ),
        format!(
            "(10) range {:.4} % of V, {:.4} % of the starting slip",
            100.0 * told.belt_speed_range,
            100.0 * told.belt_speed_range_of_slip
        ),
        format!(
            "in truth a slipping belt's speed regulates nothing: that press force brakes with {:.2} N",
            told.tension_in_truth_n
        ),
    ]
}
