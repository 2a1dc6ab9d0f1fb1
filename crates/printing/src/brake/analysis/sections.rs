//! Sections of the report on a brake: the frame at both ends, the tension, the printed equations, power, web.

use super::TensionDisc;
use super::braking::{LoadedBrake, TensionRange};
use crate::brake::BrakeDisc;
use crate::brake::machine::{BeltMode, BrakeData, BrakeModel};
use crate::brake::mechanics::{FramePose, PaperRoll, Web};
use camgen_cams::report::{Fact, Section, Topic, shown};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::text::{DIGITS, Length, Text, Value, nominal, text};
use serde::Serialize;

/// Change of the friction for which tensions are also reported, as a share.
pub(super) const FRICTION_CHANGE: f64 = 0.2;
/// Modulus of newsprint, Pa, as the paper has it.
const NEWSPRINT: [f64; 2] = [4000e6, 5000e6];

/// The frame at one end of the roll.
#[derive(Debug, Serialize)]
struct FrameEnd {
    roll_radius_mm: f64,
    frame_deg: f64,
    wrap_deg: f64,
    k: f64,
    weight_arm_mm: f64,
    press_arm_mm: f64,
    tight_arm_mm: f64,
    slack_arm_mm: f64,
    tension_n: f64,
    tension_printed_n: f64,
    belt_slack_n: f64,
    belt_tight_n: f64,
    friction_sensitivity: f64,
}

fn end(braking: &LoadedBrake<'_>, pose: &FramePose) -> FrameEnd {
    let tension = braking.tension(pose);
    let (slack, tight) = braking.belt_tensions(pose);
    FrameEnd {
        roll_radius_mm: MILLIMETRES * pose.radius,
        // The full roll is at 0, not at −0.
        frame_deg: pose.theta.to_degrees() + 0.0,
        wrap_deg: pose.wrap.to_degrees(),
        k: pose.k,
        weight_arm_mm: MILLIMETRES * pose.h1,
        press_arm_mm: MILLIMETRES * pose.h2,
        tight_arm_mm: MILLIMETRES * pose.q_tight,
        slack_arm_mm: MILLIMETRES * pose.q_slack,
        tension_n: tension,
        tension_printed_n: braking.brake.tension_printed(braking.printed_weight, pose),
        belt_slack_n: slack,
        belt_tight_n: tight,
        friction_sensitivity: braking.sensitivity(pose),
    }
}

/// The frame at the full and at the run-down roll.
pub(super) fn frame(braking: &LoadedBrake<'_>) -> Section {
    let ends = [0, 1].map(|index| braking.ends.get(index).map(|pose| end(braking, pose)));
    let words = ends.iter().flatten().map(|end| {
        text!(
            "at {}: frame {}°, wrap {}°, K {}; arms: weight {}, press {}, tight span {}, slack span {}",
            Length::mm(end.roll_radius_mm).decimals(0),
            format_args!("{:.3}", end.frame_deg),
            format_args!("{:.3}", end.wrap_deg),
            format_args!("{:.6}", end.k),
            format_args!("{:.2}", end.weight_arm_mm),
            format_args!("{:.2}", end.press_arm_mm),
            format_args!("{:.2}", end.tight_arm_mm),
            Length::mm(end.slack_arm_mm).decimals(2)
        )
    });
    let words = words.collect();
    Section::new("frame", &ends).with_words(words)
}

/// Another friction, and the tension at both ends with it; `None` where the brake jams.
#[derive(Debug, Serialize)]
struct OtherFriction {
    friction: f64,
    tension_full_n: Option<f64>,
    tension_run_down_n: Option<f64>,
}

/// The section `brake`.
#[derive(Debug, Serialize)]
struct BrakeFigures {
    model: &'static str,
    mode: &'static str,
    weight_n: f64,
    weight_exact_n: f64,
    weight_printed_n: f64,
    belt_length_mm: f64,
    tension_wanted_n: f64,
    tension_least_n: f64,
    tension_least_roll_radius_mm: f64,
    tension_largest_n: f64,
    tension_largest_roll_radius_mm: f64,
    tension_spread: f64,
    other_friction: Vec<OtherFriction>,
}

fn facts_of_brake(figures: &BrakeFigures) -> Vec<Fact> {
    let weight = text!(
        "{}; {} on the full roll need {}",
        Value::brief(figures.weight_n, "N"),
        Value::brief(figures.tension_wanted_n, "N"),
        Value::brief(figures.weight_exact_n, "N")
    );
    let tension = text!(
        "{} at {} to {} at {} of the roll",
        Value::brief(figures.tension_least_n, "N"),
        Length::mm(figures.tension_least_roll_radius_mm).brief(),
        Value::brief(figures.tension_largest_n, "N"),
        Length::mm(figures.tension_largest_roll_radius_mm).brief()
    );
    let other = figures.other_friction.iter().filter_map(|other| {
        Some(text!(
            "{} leaves {} to {}",
            nominal(other.friction, DIGITS),
            Value::brief_number(other.tension_run_down_n?),
            Value::brief(other.tension_full_n?, "N")
        ))
    });
    let friction = Text::joined(other, ", ");
    let friction = (!friction.is_empty()).then(|| Fact::new(Topic::new(30, "friction"), friction));
    let facts = [
        Some(Fact::new(Topic::new(10, "weight"), weight)),
        Some(Fact::new(Topic::new(20, "tension"), tension)),
        friction,
    ];
    facts.into_iter().flatten().collect()
}

/// Weight, tension over the roll, and the effect of friction on it.
pub(super) fn brake(braking: &LoadedBrake<'_>, tensions: &TensionRange) -> Section {
    let [full, _] = &braking.ends;
    let TensionRange { least, largest } = tensions;
    let figures = BrakeFigures {
        model: if braking.data.model == BrakeModel::Consistent { "consistent" } else { "printed" },
        mode: if braking.data.mode == BeltMode::Slip { "slip" } else { "no-slip" },
        weight_n: braking.weight,
        weight_exact_n: braking.brake.weight_for(braking.data.tension, full),
        weight_printed_n: braking.brake.weight_for_printed(braking.data.tension, full),
        belt_length_mm: MILLIMETRES * braking.brake.belt_length(),
        tension_wanted_n: braking.data.tension,
        tension_least_n: least.value,
        tension_least_roll_radius_mm: MILLIMETRES * least.at,
        tension_largest_n: largest.value,
        tension_largest_roll_radius_mm: MILLIMETRES * largest.at,
        tension_spread: super::spread(least.value, largest.value),
        other_friction: vec![
            other_friction(braking, 1.0 - FRICTION_CHANGE),
            other_friction(braking, 1.0 + FRICTION_CHANGE),
        ],
    };
    Section::new("brake", &figures).with_words(describe_brake(&figures)).with_facts(facts_of_brake(&figures))
}

/// The tensions with another friction, as a share of the brake's own.
fn other_friction(braking: &LoadedBrake<'_>, share: f64) -> OtherFriction {
    let [full, run_down] = &braking.ends;
    let friction = braking.brake.friction() * share;
    OtherFriction {
        friction,
        tension_full_n: braking.tension_with(full, friction),
        tension_run_down_n: braking.tension_with(run_down, friction),
    }
}

fn newtons_or_jams(tension: Option<f64>) -> String {
    tension.map_or("the brake jams".to_owned(), |tension| format!("{tension:.2} N"))
}

fn describe_brake(figures: &BrakeFigures) -> Vec<Text> {
    let mut lines = vec![
        text!(
            "weight {} N; {} N on the full roll needs {} N, or {} N by the printed moment (5)",
            format_args!("{:.2}", figures.weight_n),
            figures.tension_wanted_n,
            format_args!("{:.2}", figures.weight_exact_n),
            format_args!("{:.2}", figures.weight_printed_n)
        ),
        text!(
            "web tension from {} N at {} to {} N at {}: {} % of the largest",
            format_args!("{:.2}", figures.tension_least_n),
            Length::mm(figures.tension_least_roll_radius_mm).decimals(1),
            format_args!("{:.2}", figures.tension_largest_n),
            Length::mm(figures.tension_largest_roll_radius_mm).decimals(1),
            format_args!("{:.3}", 100.0 * figures.tension_spread)
        ),
    ];
    lines.extend(figures.other_friction.iter().map(|other| {
        text!(
            "with a friction of {}: {} on the full roll, {} on the run-down roll",
            format_args!("{:.3}", other.friction),
            newtons_or_jams(other.tension_full_n),
            newtons_or_jams(other.tension_run_down_n)
        )
    }));
    lines
}

/// The regulation by (8), (9) and (10), and its real effect.
#[derive(Debug, Serialize)]
struct PrintedFigures {
    /// (8), N.
    press_full_n: f64,
    weight_by_8_n: f64,
    belt_speed_ratio_full: f64,
    /// (9).
    belt_speed_ratio_run_down: f64,
    /// (10), of V.
    belt_speed_range: f64,
    /// The range as a share of the starting slip.
    belt_speed_range_of_slip: f64,
    /// The tension that this weight really makes.
    tension_in_truth_n: f64,
    tension_in_truth_run_down_n: f64,
}

/// The paper's regulation of a slipping belt, and its real effect.
pub(super) fn printed(braking: &LoadedBrake<'_>) -> Section {
    let ([full, run_down], wanted) = (&braking.ends, braking.data.tension);
    let slip = 1.0 - braking.data.belt_speed_ratio;
    let weight = braking.brake.weight_for_printed(wanted, full) / slip;
    let by_9 = 1.0 - wanted / braking.brake.tension_printed(weight, run_down);
    let figures = PrintedFigures {
        press_full_n: weight * full.h1 / full.h2,
        weight_by_8_n: weight,
        belt_speed_ratio_full: braking.data.belt_speed_ratio,
        belt_speed_ratio_run_down: by_9,
        belt_speed_range: by_9 - braking.data.belt_speed_ratio,
        belt_speed_range_of_slip: (braking.data.belt_speed_ratio - by_9) / slip,
        tension_in_truth_n: braking.brake.tension(weight, full),
        tension_in_truth_run_down_n: braking.brake.tension(weight, run_down),
    };
    let words = vec![
        text!(
            "(8) press force {} N, weight {} N at V_z/V = {}; (9) V_z/V = {} on the run-down roll; (10) range {} % of V",
            format_args!("{:.2}", figures.press_full_n),
            format_args!("{:.2}", weight),
            figures.belt_speed_ratio_full,
            format_args!("{:.6}", by_9),
            format_args!("{:.3}", 100.0 * figures.belt_speed_range)
        ),
        text!(
            "in fact the speed of a slipping belt regulates nothing: that weight makes {} N on the full roll, and {} N on the run-down roll",
            format_args!("{:.2}", figures.tension_in_truth_n),
            format_args!("{:.2}", figures.tension_in_truth_run_down_n)
        ),
    ];
    Section::new("printed", &figures).with_words(words)
}

/// The section `web`.
#[derive(Debug, Serialize)]
struct WebFigures {
    stress_mpa: f64,
    strain: f64,
    belt_speed_ratio_printed: f64,
    belt_speed_ratio_exact: f64,
    speed_sensitivity: f64,
    stretch_mm: Option<f64>,
    /// With the modulus of newsprint at a fixed speed of the belt.
    tension_4000_mpa_n: f64,
    tension_5000_mpa_n: f64,
    belt_power_w: f64,
    heat_w: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    roll_inertia_kg_m2: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    acceleration_tension_n: Option<f64>,
}

/// Stress, strain and power of the web at the wanted tension, and the inertia of a roll.
pub(super) fn web(data: &BrakeData, roll: Option<&PaperRoll>) -> Option<Section> {
    let (web, wanted) = (data.web.as_ref()?, data.tension);
    let exact = web.belt_speed(wanted);
    let ratio = super::braking::belt_speed(data);
    let (belt, heat) = web.powers(wanted, ratio);
    let [soft, stiff] = NEWSPRINT.map(|modulus| Web { modulus, ..*web }.tension(exact));
    let dense = roll.zip(data.density);
    let inertia = dense.map(|(roll, density)| web.inertia(density, roll.largest_radius, roll.smallest_radius));
    let speeding = inertia.zip(roll).filter(|_| data.acceleration > 0.0);
    let speeding =
        speeding.map(|(inertia, roll)| web.acceleration_tension(inertia, roll.largest_radius, data.acceleration));
    let figures = WebFigures {
        stress_mpa: 1e-6 * web.stress(wanted),
        strain: web.strain(wanted),
        belt_speed_ratio_printed: web.belt_speed_printed(wanted),
        belt_speed_ratio_exact: exact,
        speed_sensitivity: web.sensitivity(wanted),
        stretch_mm: web.stretch(wanted).map(|stretch| MILLIMETRES * stretch),
        tension_4000_mpa_n: soft,
        tension_5000_mpa_n: stiff,
        belt_power_w: belt,
        heat_w: heat,
        roll_inertia_kg_m2: inertia,
        acceleration_tension_n: speeding,
    };
    let mut words = vec![
        text!(
            "stress {} MPa at {} N; of {} W of power {} W go to the belt drive and {} W become heat",
            format_args!("{:.4}", figures.stress_mpa),
            wanted,
            format_args!("{:.1}", belt + heat),
            format_args!("{:.1}", belt),
            format_args!("{:.1}", heat)
        ),
        text!(
            "without slip V_z/V = {} (printed (14): {}); a change of it by 0.01 % changes the tension by {} %",
            format_args!("{:.6}", exact),
            format_args!("{:.6}", figures.belt_speed_ratio_printed),
            format_args!("{:.2}", 0.01 * figures.speed_sensitivity)
        ),
    ];
    words.extend(
        figures.stretch_mm.map(|stretch| text!("stretch to the printing nip (15) {}", Length::mm(stretch).decimals(4))),
    );
    words.extend(speeding.zip(inertia).map(|(tension, inertia)| {
        text!(
            "speeding up at {} adds {} N on the full roll ({} kg·m²), and less as it runs down",
            Value::from(format!("{} m/s²", data.acceleration)),
            format_args!("{:.3}", tension),
            format_args!("{:.3}", inertia)
        )
    }));
    Some(Section::new("web", &figures).with_words(words))
}

/// The section `disc`.
#[derive(Debug, Serialize)]
struct DiscFigures {
    turns_per_frame_turn: f64,
    cam_end_deg: f64,
    work_j: f64,
    lift_full_mm: f64,
    lift_largest_mm: f64,
    spring_force_max_n: f64,
    moment_run_down_nm: f64,
    tension_as_cut_least_n: Option<f64>,
    tension_as_cut_largest_n: Option<f64>,
    tension_as_cut_error_max_n: Option<f64>,
}

/// Lift of the law at a radius of the roll, mm.
fn lift_mm(disc: &BrakeDisc, radius: f64) -> f64 {
    super::of_disc(disc, radius).map_or(f64::NAN, |(_, _, lift)| MILLIMETRES * lift)
}

/// The disc that holds the tension, by its law and as cut.
pub(super) fn disc(braking: &LoadedBrake<'_>, held: &TensionDisc<'_>) -> Section {
    let (disc, wanted) = (held.disc, braking.data.tension);
    let [_, run_down] = &braking.ends;
    let roll = braking.brake.roll();
    let top = braking.radii(super::PLACES).map(|radius| lift_mm(disc, radius)).fold(0.0, f64::max);
    let cut = held.as_cut;
    let figures = DiscFigures {
        turns_per_frame_turn: disc.holding().turns_per_frame_turn(),
        cam_end_deg: disc.holding().total_angle().to_degrees(),
        work_j: disc.stored(),
        lift_full_mm: lift_mm(disc, roll.largest_radius),
        lift_largest_mm: top,
        spring_force_max_n: disc.law().spring_force(top / MILLIMETRES),
        moment_run_down_nm: disc.holding().moment(run_down),
        tension_as_cut_least_n: cut.map(|cut| cut.least.tension),
        tension_as_cut_largest_n: cut.map(|cut| cut.largest.tension),
        tension_as_cut_error_max_n: cut.map(|cut| (cut.largest.tension - wanted).max(wanted - cut.least.tension)),
    };
    let mut words = vec![
        text!(
            "a disc that turns {} times as far as the frame, to {}°, takes {} J from its spring; lift {} on the full roll",
            shown(figures.turns_per_frame_turn),
            shown(figures.cam_end_deg),
            shown(figures.work_j),
            Length::mm(figures.lift_full_mm)
        ),
        text!(
            "spring at most {} N; moment on the frame {} N·m on the run-down roll",
            shown(figures.spring_force_max_n),
            shown(figures.moment_run_down_nm)
        ),
    ];
    words.extend(cut.map(|cut| {
        text!(
            "as cut the web tension is between {} and {} N over the whole roll",
            format_args!("{:.3}", cut.least.tension),
            format_args!("{:.3}", cut.largest.tension)
        )
    }));
    words.push(
        "it compensates the change of the radius, not of the friction: another friction changes the tension as stated above".into(),
    );
    Section::new("disc", &figures).with_words(words)
}
