//! The analysis: the residual force of a cam in machines with deviations, as built and after a reset of the screw.

use super::card;
use super::fault::{Fault, FrozenBuffer};
use super::losses::{BedWay, LossyReversal};
use super::monte_carlo::{self, Sampling};
use super::plot;
use super::propagation::{self, Corners};
use super::report::{BandsReport, FaultReport, LossReport, ScatterReport, UsefulRange, rows};
use super::reset::ScrewRule;
use super::settings::{self, VariableRange};
use super::tables;
use super::typed::TypedFault;
use crate::press::MachineOfPress;
use crate::press::buffer::Cylinder;
use crate::press::cams;
use crate::press::checks::{column, fixed_bottom};
use crate::press::columns::CUBIC;
use crate::press::load::ColumnAtSpeed;
use crate::press::machine::PressCams;
use crate::press::report::CylinderMeasures;
use camgen_cams::analysis::{Analysis, Picture};
use camgen_cams::body::Kind;
use camgen_cams::check::Measure;
use camgen_cams::machine::Machine;
use camgen_cams::report::Speeds;
use camgen_cams::report::diagram::{Diagram, PlottedValue, diagram};
use camgen_kernel::document::{Input, NamedChoice};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::refusal::Refusal;

/// What is left of a cam in practice.
pub const KIND: Kind = Kind { command: "scatter", noun: "scatter of a press", keys: cams::SCATTER };

/// A press with the cam that is cut for a speed.
pub(super) fn cam_of(machine: &Machine, rpm: f64) -> Result<(FrozenBuffer, Cylinder), Refusal> {
    let press = machine.press()?;
    let (law, cylinder) = (press.rotary_law(rpm)?, press.cylinder());
    Ok((FrozenBuffer::of_law(&law, &cylinder), cylinder))
}

/// Force that 19 of 20 drawn presses stay below with the screw set as the file says, N, and that rule; `None` where no press can be drawn.
#[must_use]
pub fn left_in_practice(machine: &Machine, rpm: f64) -> Option<(f64, ScrewRule)> {
    let (cam, _) = cam_of(machine, rpm).ok()?;
    let cams = PressCams::of(machine);
    let left = monte_carlo::left_in_practice(&cam, &cams.scatter, cams.losses.bed_friction).ok()??;
    Some((left.reset, cams.scatter.rule))
}

/// What the bands leave together and each alone.
pub(super) fn bands_of(cam: &FrozenBuffer, sampling: &Sampling, levelled: bool) -> Result<BandsReport, Refusal> {
    let Sampling { half_widths, distribution, .. } = sampling;
    let [strong, weak] = Corners::new(cam, half_widths).worst(cam)?;
    Ok(BandsReport {
        parameters: rows(&propagation::bands(cam, half_widths, *distribution, levelled)?),
        worst_weak_n: weak.value,
        worst_weak_at_mm: MILLIMETRES * weak.at,
        worst_strong_n: strong.value,
        worst_strong_at_mm: MILLIMETRES * strong.at,
        linear_bound_n: propagation::linear_bound(cam, half_widths),
        sigma_n: libm::sqrt(propagation::variance(cam, half_widths, *distribution)),
    })
}

/// What one machine leaves.
fn fault_of(cam: &FrozenBuffer, typed: &TypedFault, cylinder: &Cylinder) -> Result<FaultReport, Refusal> {
    let (fault, still) = (typed.fault, Fault { phase: 0.0, ..typed.fault });
    let (load, length) = (cam.end_load(), cam.end_length());
    let worst = cam.worst(&fault)?;
    let [end, level] = [ScrewRule::End, ScrewRule::Level].map(|rule| {
        let column = cam.setting(&still, rule)? + typed.screw;
        Ok::<_, Refusal>((column, cam.worst(&fault.with_column(column))?))
    });
    let ((end, after_end), (level, after_level)) = (end?, level?);
    let [with_port, lead] = cam.reset_of_column_and_port(&still)?;
    let set = Fault { column: with_port + typed.screw, lead, ..fault };
    let end_force = cam.residual(&still, load, length);
    let end_air = fault.square * load - end_force / cam.unit_force + fault.ambient;
    Ok(FaultReport {
        v: fault.variable(),
        residual_n: worst.value,
        residual_at_mm: MILLIMETRES * worst.at,
        residual_at_end_n: end_force,
        end_pressure_pa: cylinder.ambient_pressure * end_air,
        column_end_mm: MILLIMETRES * end,
        screw_end_mm: MILLIMETRES * (end - fault.column),
        added_volume_end_mm3: CUBIC * cylinder.volume(end),
        added_volume_end_each_mm3: CUBIC * cylinder.piston_area * end,
        residual_end_n: after_end.value,
        residual_end_at_mm: MILLIMETRES * after_end.at,
        column_level_mm: MILLIMETRES * level,
        screw_level_mm: MILLIMETRES * (level - fault.column),
        residual_level_n: after_level.value.abs(),
        column_with_port_mm: MILLIMETRES * with_port,
        lead_with_port_mm: MILLIMETRES * lead,
        screw_with_port_mm: MILLIMETRES * (with_port - fault.column),
        port_mm: MILLIMETRES * (lead - fault.lead),
        residual_with_port_n: cam.worst(&set)?.value,
    })
}

/// What a reversal with losses leaves.
pub(in crate::press) fn lost_in(reversal: &LossyReversal) -> LossReport {
    let ([on_way_in, back], half_loop) =
        ([BedWay::In, BedWay::Back].map(|way| reversal.worst(way)), reversal.largest_half_loop());
    let fixed = reversal.with_fixed_bottom().ok();
    let [fixed_on_way_in, fixed_back] =
        [BedWay::In, BedWay::Back].map(|way| fixed.as_ref().map(|fixed| fixed.worst(way).value));
    LossReport {
        residual_in_fixed_bottom_n: fixed_on_way_in,
        residual_back_fixed_bottom_n: fixed_back,
        residual_in_n: on_way_in.value,
        residual_in_at_mm: MILLIMETRES * on_way_in.at,
        residual_back_n: back.value,
        residual_back_at_mm: MILLIMETRES * back.at,
        half_loop_n: half_loop.value,
        half_loop_at_mm: MILLIMETRES * half_loop.at,
        work_lost_j: reversal.work_lost(),
        air_left: reversal.air_left(),
    }
}

/// What is left of the cam of a machine that is cut for a speed of its main shaft (rpm): in one true machine, `KEY=VALUE` each as after
/// `--fault`, and in presses that are drawn.
///
/// ```
/// use camgen::domains::press::machine::PressCams;
/// use camgen::domains::press::scatter::analysis::analysis;
/// use camgen::{Judged, Machine};
///
/// // A forme heavier by a twentieth of the moving mass.
/// let (machine, _) = Machine::load("dpi", &[])?;
/// let sampling = PressCams::of(&machine).scatter;
/// let judged = Judged::new(analysis(&machine, 35.0, &["mass=5%".to_owned()], &sampling)?);
/// let scatter = judged.report().section("scatter").expect("a section").clone();
/// assert!((scatter["fault"]["residual_n"].as_f64().unwrap() - 1064.4).abs() < 0.1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`Refusal`] when the file has no press under a yoke, a fault is none, or no column balances a press.
pub fn analysis(machine: &Machine, rpm: f64, faults: &[String], sampling: &Sampling) -> Result<Analysis, Refusal> {
    let (cam, cylinder) = cam_of(machine, rpm)?;
    let press = machine.press()?;
    let typed = TypedFault::read(faults, press, rpm)?;
    let bands = bands_of(&cam, sampling, true)?;
    let samples = monte_carlo::draw(&cam, sampling, PressCams::of(machine).losses.bed_friction)?;
    let percentiles = tables::percentiles(&samples, sampling.rule);
    let settings = tables::settings(&cam, &cylinder, rpm, sampling.rule)?;
    let useful = settings::useful(&cam, sampling.rule);
    let fault = typed.is_any().then(|| fault_of(&cam, &typed, &cylinder)).transpose()?;
    let losses = PressCams::of(machine).losses;
    let reversal = LossyReversal::new(&cam, &typed.fault, &losses)?;
    let lost = losses.is_any().then(|| lost_in(&reversal));
    let places = tables::places(&cam, &reversal, &sampling.half_widths);
    let report = ScatterReport {
        cam_rpm: rpm,
        column_length_mm: MILLIMETRES * cam.column,
        cylinders: CylinderMeasures::new(cylinder.piston_area),
        reset: sampling.rule.word(),
        distribution: sampling.distribution.word(),
        samples: sampling.samples,
        seed: sampling.seed,
        residual_fixed_bottom_max_n: cylinder.residual_fixed_bottom(&press.bottom_law(rpm)),
        fault,
        losses: lost,
        bands,
        percentiles: &percentiles,
        useful: UsefulRange::new(useful, rpm, sampling.rule),
        settings: &settings,
    };
    let column = column::measure_of_analysis(&[ColumnAtSpeed { length: cam.column, rpm }], machine);
    let measures =
        column.into_iter().chain(measures_of(&report, typed.fault.variable(), useful, sampling.rule)).collect();
    Ok(Analysis {
        kind: &KIND,
        variant: "",
        machine: machine.name().to_owned(),
        speeds: Speeds::One(rpm),
        inputs: inputs(machine, rpm, &typed, sampling),
        sections: vec![report.section()],
        measures,
        notes: machine.idle_key_notes(KIND.keys, KIND.noun),
        picture: Picture::CurvesWithCard(
            plot::plot(&plot::ScatterFigures {
                machine: machine.name(),
                rpm,
                ranked: report.bands.ranked(),
                percentiles: &percentiles,
                samples: sampling.samples,
                rule: sampling.rule,
            }),
            card::settings_card(press, machine.name(), &report),
        ),
        mechanism: None,
        document: None,
        tables: vec![
            tables::of_parameters(&report.bands.parameters),
            tables::of_percentiles(&percentiles),
            tables::of_settings(&settings, sampling.rule),
            tables::of_places(&places),
        ],
        by: &[],
        along: "crank_deg",
        diagrams: DIAGRAMS,
        not_modelled: NOT_MODELLED.to_vec(),
    })
}

/// What checks judge, in their order.
fn measures_of(report: &ScatterReport<'_>, variable: f64, useful: VariableRange, rule: ScrewRule) -> Vec<Measure> {
    let lost = report.losses.as_ref().map(|lost| {
        let fixed = lost.residual_fixed_bottom_n().unwrap_or(report.residual_fixed_bottom_max_n);
        [fixed_bottom::half_of_loop(lost.half_loop_n, fixed), fixed_bottom::with_losses(lost.residual_n(), fixed)]
    });
    std::iter::once(fixed_bottom::over_draws(report.percentiles))
        .chain(lost.into_iter().flatten())
        .chain([fixed_bottom::at_setting(variable, useful, rule)])
        .collect()
}

/// Everything that determines the analysis: flags that are given replace keys of the file.
fn inputs(machine: &Machine, rpm: f64, typed: &TypedFault, sampling: &Sampling) -> Vec<Input> {
    #[expect(clippy::cast_precision_loss, reason = "a seed of a flag may lose digits here, and is told in the section")]
    let seed = Input::number("scatter.seed", sampling.seed as f64);
    let flags = [
        Input::word("scatter.reset", sampling.rule.word()),
        Input::word("scatter.distribution", sampling.distribution.word()),
        Input::number("scatter.samples", f64::from(sampling.samples)),
        seed,
    ];
    let of_file = machine.inputs(KIND.keys);
    let of_file = of_file.into_iter().filter(|input| flags.iter().all(|flag| flag.key != input.key));
    let mut inputs = vec![Input::word("command", KIND.command)];
    inputs.extend(of_file);
    inputs.extend(flags.clone());
    inputs.push(Input::number("rpm", rpm));
    inputs.extend(typed.inputs.iter().cloned());
    inputs
}

const DIAGRAMS: &[Diagram] = &[
    diagram(
        "scatter-bounds",
        "Residual force of the worst presses, and of this one",
        &[
            ("mean", "this machine, mean of both ways"),
            ("half_loop", "half of the loop"),
            ("weak", "weakest air"),
            ("strong", "strongest air"),
        ],
        &[],
        PlottedValue::Itself,
    ),
    diagram(
        "scatter-parameters",
        "Effect of the half width of each parameter",
        &[
            ("polytropic_exponent", "exponent"),
            ("ambient_pressure", "ambient pressure"),
            ("mass", "mass"),
            ("speed", "speed"),
            ("column", "column"),
            ("lead", "lead"),
            ("air_lost", "air lost"),
            ("closing_pressure", "closing pressure"),
            ("phase", "phase"),
            ("screw", "screw"),
        ],
        &[],
        PlottedValue::Itself,
    ),
];

const NOT_MODELLED: &[&str] = &[
    "The transition before the reversal, and what the outline as cut misses: `camgen rotary` reports both.",
    "The deflection of the camshaft: `camgen shaft` reports it.",
    "Parameters that depend on each other: each is drawn for itself.",
];
