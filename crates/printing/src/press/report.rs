//! What the cams of a press report.

use super::buffer::{CYLINDERS, bore_of, total_area};
use camgen_cams::report::{Fact, Finding, OutlineMeasures, Rolled, Section, Topic, Verdict, Weight, shown};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::text::{Length, LengthKind, Text, Value, text};
use serde::{Deserialize, Serialize};

/// The cylinders and their air.
pub const BUFFERS: Topic = Topic::new(25, "buffers");
/// The force that the air leaves of the inertia.
pub const LEFT_OVER: Topic = Topic::new(110, "left over");
/// What is left of it where presses differ.
pub const IN_PRACTICE: Topic = Topic::new(120, "in practice");

/// How the cam does at other speeds.
pub const OTHER_SPEEDS: Topic = Topic::new(130, "speeds");

/// Measures of a plate on the bed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct PlateMeasures {
    pub length_mm: f64,
    pub height_mm: f64,
    pub thinnest_mm: f64,
    pub thinnest_at_x_mm: f64,
    /// Distance of the roller's centre from the bed's axis where Δx = 0: the start of the pitch curve of (21).
    pub axis_distance_mm: f64,
}

/// The section `cam` of a wedge.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct WedgeMeasures {
    pub roller_radius_mm: f64,
    pub max_lift_mm: f64,
    pub plate: PlateMeasures,
    #[serde(flatten)]
    pub weight: Weight,
}

impl WedgeMeasures {
    /// The section.
    #[must_use]
    pub fn section(&self) -> Section {
        let (plate, lift) = (&self.plate, text!("lift {}", Length::mm(self.max_lift_mm).decimals(3)));
        let mut words = vec![text!(
            "plate {} × {}, {} at its thinnest (x = {}), roller Ø{}, {}",
            Length::mm(plate.length_mm).decimals(2).bare(),
            Length::mm(plate.height_mm),
            Length::mm(plate.thinnest_mm).decimals(3),
            Length::mm(plate.thinnest_at_x_mm).decimals(2),
            Length::mm(2.0 * self.roller_radius_mm),
            &lift
        )];
        words.extend(self.weight.words());
        let size = text!(
            "plate {} × {}, {} at its thinnest, roller Ø{}",
            Length::mm(plate.length_mm).rounded().bare(),
            Length::mm(plate.height_mm).rounded(),
            Length::mm(plate.thinnest_mm).decimals(2),
            Length::mm(2.0 * self.roller_radius_mm).rounded()
        );
        let figures: Vec<Text> = [size, lift].into_iter().chain(self.weight.figure()).collect();
        let plate_fact = text!(
            "plate {} × {}, {} at its thinnest, roller Ø{}",
            Length::mm(plate.length_mm).nominal().bare(),
            Length::mm(plate.height_mm).nominal(),
            Length::mm(plate.thinnest_mm).brief(),
            Length::mm(2.0 * self.roller_radius_mm).nominal()
        );
        let lift = Value::from(Length::mm(self.max_lift_mm).brief());
        let facts = [Some(Fact::new(Topic::SIZE, plate_fact)), self.weight.fact(), Some(Fact::new(Topic::LIFT, lift))];
        Section::new("cam", self).with_words(words).with_figures(figures).with_facts(facts.into_iter().flatten())
    }
}

/// The cylinders at one end of the bed: count, size of one, total area.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct CylinderMeasures {
    pub cylinders: u32,
    /// Of one cylinder, like the bore.
    pub piston_area_mm2: f64,
    pub bore_mm: f64,
    pub piston_area_total_mm2: f64,
}

impl CylinderMeasures {
    /// From the area of one piston, m².
    #[must_use]
    pub fn new(piston_area: f64) -> Self {
        const SQUARE: f64 = MILLIMETRES * MILLIMETRES;
        Self {
            cylinders: CYLINDERS,
            piston_area_mm2: SQUARE * piston_area,
            bore_mm: MILLIMETRES * bore_of(piston_area),
            piston_area_total_mm2: SQUARE * total_area(piston_area),
        }
    }

    /// Count and bore.
    #[must_use]
    pub fn bore_words(&self) -> Text {
        text!("{} cylinders, bore {} each", self.cylinders, Length::mm(self.bore_mm))
    }

    /// Count, bore, and piston areas of one and of all.
    #[must_use]
    pub fn describe(&self) -> Text {
        text!(
            "{}, piston area {} each, {} in all",
            self.bore_words(),
            Length::new(self.piston_area_mm2, &LengthKind::MM2),
            Length::new(self.piston_area_total_mm2, &LengthKind::MM2)
        )
    }
}

/// The law of the press: the air and the motion of the bottom of the cylinders.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct AirLaw {
    /// The Δx of largest size, signed.
    pub dx_max_mm: f64,
    pub dx_max_at_x_mm: f64,
    pub column_length_mm: f64,
    #[serde(flatten)]
    pub cylinders: CylinderMeasures,
    /// The slope dΔx/dx at the start of the reversal; c − 1 for a disc cam.
    pub start_slope: f64,
    /// Jump of the bottom's velocity at the start of the reversal.
    pub velocity_jump_mm_per_rad: f64,
    /// The larger jump is that at the end of the reversal.
    #[serde(skip)]
    pub jumps_at_end: bool,
    /// Where a blend closes the air column at ambient pressure: the crank angle at which the bottom starts to move.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub column_closed_at_crank_deg: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub equation_18: Option<Equation18>,
}

/// The reversal of a bed at one end of its stroke; angles of the crank from its start.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct ReversalOfBed {
    /// "outer" or "inner".
    pub end: String,
    /// The driving crank where it starts, from the line of the slider.
    pub start_deg: f64,
    /// The crank angle it takes.
    pub angle_deg: f64,
    /// The dead point.
    pub dead_point_deg: f64,
    /// Where the bed is decelerated most.
    pub largest_deceleration_deg: f64,
    /// Overrun at the dead point, and the overrun at the end of the reversal.
    pub overrun_mm: f64,
    pub overrun_left_mm: f64,
}

impl ReversalOfBed {
    /// The section `reversal`.
    #[must_use]
    pub fn section(&self) -> Section {
        let words = self.describe();
        Section::new("reversal", self).with_figures(vec![words.clone()]).with_words(vec![words])
    }

    fn describe(&self) -> Text {
        let left = if self.overrun_left_mm.abs() < 1e-9 {
            Text::default()
        } else {
            text!("; it ends {} from where it starts", Length::mm(self.overrun_left_mm).decimals(3))
        };
        text!(
            "{} end: reversal from {}° of the crank over {}°, dead point {}° after its start, overrun {}{}",
            &self.end,
            format_args!("{:.3}", self.start_deg),
            format_args!("{:.3}", self.angle_deg),
            format_args!("{:.3}", self.dead_point_deg),
            Length::mm(self.overrun_mm).decimals(3),
            left
        )
    }
}

/// How equation (18) was solved.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct Equation18 {
    pub solver: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tolerance_mm: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stations: Option<u32>,
    /// Steps of the integrator.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub steps: Option<usize>,
    pub efficiency_model: String,
    #[serde(default)]
    pub friction_angle_deg: f64,
    #[serde(default)]
    pub efficiency: f64,
    /// The direction of the bed in which the forces balance.
    pub balance: String,
    /// Where the law of the slope changes.
    pub breaks: Vec<SlopeBreak>,
}

/// An overrun at which the law of the slope changes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct SlopeBreak {
    pub x_mm: f64,
    /// The state of the bottom from there on while x grows: "rising", "falling", or "stuck" where the lever sticks.
    pub then: String,
}

impl AirLaw {
    /// The section `law`.
    #[must_use]
    pub fn section(&self) -> Section {
        let mut words = vec![
            text!(
                "Δx {} at x = {}, air column {}",
                Length::mm(self.dx_max_mm),
                Length::mm(self.dx_max_at_x_mm),
                Length::mm(self.column_length_mm)
            ),
            self.cylinders.describe(),
        ];
        if self.velocity_jump_mm_per_rad != 0.0 {
            words.push(text!(
                "its velocity jumps by {} of crank at the {} of the reversal",
                Length::new(self.velocity_jump_mm_per_rad, &LengthKind::MM_PER_RAD).decimals(2),
                if self.jumps_at_end { "end" } else { "start" }
            ));
        }
        if let Some(degrees) = self.column_closed_at_crank_deg {
            words.push(text!(
                "the air column is taken as closed at ambient pressure where the blend starts, {}° of the crank",
                shown(degrees)
            ));
        }
        if let Some(solved) = &self.equation_18 {
            words.push(solved.describe(self.start_slope));
            words.extend(solved.omitted_friction());
            if !solved.breaks.is_empty() {
                let breaks: Vec<Text> = solved
                    .breaks
                    .iter()
                    .map(|at| text!("{} from x = {}", &at.then, Length::mm(at.x_mm).decimals(3)))
                    .collect();
                words.push(text!("the bottom is {}", Text::joined(breaks, ", ")));
            }
        }
        let figures = vec![
            text!("air column {}", Length::mm(self.column_length_mm).decimals(3)),
            text!(
                "Δx {} at x = {}",
                Length::mm(self.dx_max_mm).decimals(3),
                Length::mm(self.dx_max_at_x_mm).decimals(2)
            ),
            self.cylinders.bore_words(),
        ];
        let stroke = text!("over a stroke of {}", Length::mm(self.dx_max_at_x_mm).nominal());
        let air = text!(
            "{} cylinders, each: bore {}, air column {}",
            self.cylinders.cylinders,
            Length::mm(self.cylinders.bore_mm).brief(),
            Length::mm(self.column_length_mm).brief()
        );
        let facts = [Fact::new(Topic::LIFT, stroke), Fact::new(BUFFERS, air)];
        Section::new("law", self).with_words(words).with_figures(figures).with_facts(facts)
    }
}

/// Tolerance, mm, below which only the arithmetic limits the result.
const ROUNDING_MM: f64 = 1e-9;

impl Equation18 {
    /// Names the friction that the machine file omits.
    fn omitted_friction(&self) -> Option<Text> {
        let roller = (self.friction_angle_deg == 0.0).then_some("at the roller (translating.friction_angle is 0)");
        let crank = (self.efficiency == 1.0).then_some("in the bell crank (translating.efficiency is 1)");
        let omitted: Vec<&str> = roller.into_iter().chain(crank).collect();
        (!omitted.is_empty()).then(|| text!("friction is omitted {}", omitted.join(" and ")))
    }

    fn describe(&self, start_slope: f64) -> Text {
        let how = match (self.stations, self.tolerance_mm) {
            (Some(stations), _) => text!("{} stations", stations),
            (None, tolerance) => {
                let steps = self.steps.unwrap_or(0);
                match tolerance.filter(|tolerance| *tolerance > ROUNDING_MM) {
                    Some(tolerance) => text!("{} steps to {}", steps, Length::mm(tolerance)),
                    None => text!("{} steps to the last digits", steps),
                }
            }
        };
        text!(
            "equation (18) by {} in {}, efficiency {}, forces balanced: {}, slope at the start {}",
            &self.solver,
            how,
            &self.efficiency_model,
            &self.balance,
            shown(start_slope)
        )
    }
}

/// Forces of a plane cam.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct ForceMeasures {
    pub inertia_max_n: f64,
    /// Largest |inertia − air| over the reversal with the lift as rolled on the written outline, or, where nothing was
    /// rolled, of the law.
    pub residual_max_n: f64,
    pub residual_share: f64,
    pub residual_fixed_bottom_max_n: f64,
    #[serde(default, flatten)]
    pub by_direction: Option<ResidualByDirection>,
    /// Along the roller's path; with preload and inertia of the follower where they are given.
    pub roller_force_max_n: f64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub torque_max_nm: Option<f64>,
}

/// Residual force of a plate's motion while the bed is braked and while it is accelerated back, also as shares of the
/// largest inertia.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct ResidualByDirection {
    pub residual_braking_max_n: f64,
    pub residual_braking_share: f64,
    pub residual_return_max_n: f64,
    pub residual_return_share: f64,
    pub residual_return_at_x_mm: f64,
}

/// Text for a residual force that is not finite.
const UNBOUNDED: &str = "without bound (the bottom hits the piston)";

impl ForceMeasures {
    fn facts(&self) -> Vec<Fact> {
        let (inertia, fixed) =
            (Value::brief(self.inertia_max_n, "N"), Value::brief(self.residual_fixed_bottom_max_n, "N"));
        let left = match &self.by_direction {
            _ if !self.residual_max_n.is_finite() => Text::from(UNBOUNDED),
            Some(both) => text!(
                "{} while braking, {} on the return, of {}",
                Value::brief(both.residual_braking_max_n, "N"),
                Value::brief(both.residual_return_max_n, "N"),
                inertia
            ),
            None => text!("{} of {}", Value::brief(self.residual_max_n, "N"), inertia),
        };
        let roller = text!("{} on the roller", Value::brief(self.roller_force_max_n, "N"));
        let torque = self.torque_max_nm.map(|torque| text!("{} at the camshaft", Value::brief(torque, "N·m")));
        let left = text!("{}; a fixed bottom leaves {}", left, fixed);
        let torque = torque.map(|torque| Fact::new(Topic::TORQUE, torque));
        [Some(Fact::new(Topic::FORCE, roller)), torque, Some(Fact::new(LEFT_OVER, left))]
            .into_iter()
            .flatten()
            .collect()
    }

    fn residual_words(&self) -> Text {
        if self.residual_max_n.is_finite() {
            text!("{} N ({} %)", shown(self.residual_max_n), shown(100.0 * self.residual_share))
        } else {
            UNBOUNDED.into()
        }
    }

    /// The section `force`.
    #[must_use]
    pub fn section(&self) -> Section {
        let mut words = vec![text!(
            "inertia {} N; inertia less air {} with this cam, {} N with a fixed bottom",
            shown(self.inertia_max_n),
            self.residual_words(),
            shown(self.residual_fixed_bottom_max_n)
        )];
        words.push(match self.torque_max_nm {
            Some(torque) => {
                text!(
                    "roller at most {} N along its path, camshaft at most {} N·m",
                    format_args!("{:.1}", self.roller_force_max_n),
                    format_args!("{:.1}", torque)
                )
            }
            None => text!("each roller at most {} N along the normal", format_args!("{:.1}", self.roller_force_max_n)),
        });
        let mut figures = vec![
            if self.residual_max_n.is_finite() {
                text!(
                    "inertia {} N, residual {} N",
                    format_args!("{:.0}", self.inertia_max_n),
                    format_args!("{:.2}", self.residual_max_n)
                )
            } else {
                text!("inertia {} N, {}", format_args!("{:.0}", self.inertia_max_n), UNBOUNDED)
            },
            text!("a fixed bottom would leave {} N", format_args!("{:.0}", self.residual_fixed_bottom_max_n)),
        ];
        if let Some(both) = &self.by_direction {
            words.push(text!(
                "the law leaves {} N ({} %) while braking, and {} N ({} %) on the return, at x = {}",
                shown(both.residual_braking_max_n),
                shown(100.0 * both.residual_braking_max_n / self.inertia_max_n),
                shown(both.residual_return_max_n),
                shown(100.0 * both.residual_return_max_n / self.inertia_max_n),
                Length::mm(both.residual_return_at_x_mm)
            ));
            figures.push(text!(
                "residual {} N braking, {} N on the return",
                format_args!("{:.0}", both.residual_braking_max_n),
                format_args!("{:.0}", both.residual_return_max_n)
            ));
        }
        Section::new("force", self).with_words(words).with_figures(figures).with_facts(self.facts())
    }
}

/// The preload for another speed, and the torques there.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct PreloadAtSpeed {
    pub rpm: f64,
    pub preload_n: f64,
    pub torque_before_max_nm: f64,
    /// With the preload unchanged.
    pub torque_unchanged_max_nm: f64,
    pub torque_after_max_nm: f64,
}

/// The section `compensator`.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct Compensation {
    pub lift_max_mm: f64,
    pub prime_radius_mm: f64,
    pub base_radius_mm: f64,
    pub roller_radius_mm: f64,
    /// Position of its follower, from the first one in the direction of the cam angle.
    pub angle_deg: f64,
    /// The work that its spring stores and returns.
    pub work_j: f64,
    pub spring_force_max_n: f64,
    pub torque_before_max_nm: f64,
    /// By the law: rounding, or the inertia of its follower.
    pub torque_after_max_nm: f64,
    /// The torque that the losses of the machine file leave, by the law.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub torque_in_losses_max_nm: Option<f64>,
    /// Largest torque of both discs together, by the normals where the followers touch the written outlines.
    pub torque_as_cut_max_nm: Option<f64>,
    pub preload_by_rpm: Vec<PreloadAtSpeed>,
    pub outline: Option<OutlineMeasures>,
    pub rolling: Option<Rolled>,
    /// Every check of the second disc.
    pub checks: Vec<Finding>,
}

impl Compensation {
    /// The section.
    #[must_use]
    pub fn section(&self) -> Section {
        let as_cut = self.torque_as_cut_max_nm.map(|torque| {
            let share = 100.0 * torque / self.torque_before_max_nm;
            text!(", as cut {} N·m ({} %)", shown(torque), shown(share))
        });
        let in_losses = self.torque_in_losses_max_nm.map(|torque| {
            text!("the losses of the buffer leave up to {} N·m of it, which no spring takes", shown(torque))
        });
        let mut words = vec![
            text!(
                "second disc: prime radius {}, lift {}, roller Ø{}, follower at {}°",
                Length::mm(self.prime_radius_mm),
                Length::mm(self.lift_max_mm).decimals(3),
                Length::mm(2.0 * self.roller_radius_mm),
                shown(self.angle_deg)
            ),
            text!(
                "torque on the camshaft {} N·m without, {} N·m with it by the law{}",
                shown(self.torque_before_max_nm),
                shown(self.torque_after_max_nm),
                as_cut
            ),
            text!(
                "its spring stores {} J, at most {} N",
                format_args!("{:.2}", self.work_j),
                format_args!("{:.0}", self.spring_force_max_n)
            ),
        ];
        words.extend(in_losses);
        words.extend(self.preload_by_rpm.iter().map(|at| {
            text!(
                "{} rpm, column reset: {} N·m without, {} N·m with it, {} N·m with a preload of {} N",
                shown(at.rpm),
                format_args!("{:.1}", at.torque_before_max_nm),
                format_args!("{:.1}", at.torque_unchanged_max_nm),
                format_args!("{:.1}", at.torque_after_max_nm),
                format_args!("{:.0}", at.preload_n)
            )
        }));
        let broken = self.checks.iter().filter(|finding| matches!(finding.verdict, Verdict::Fail | Verdict::Warn));
        words.extend(broken.map(|finding| {
            let limit = finding.limit_text().map(|limit| text!(", {}", limit));
            let note = finding.note.as_ref().map(|note| text!("; {}", note));
            text!("{} {} {}{}{}", finding.verdict.word(), &*finding.check, finding.value_text(), limit, note)
        }));
        let figures =
            vec![text!("compensating cam: torque {} N·m without", format_args!("{:.1}", self.torque_before_max_nm))];
        Section::new("compensator", self).with_words(words).with_figures(figures)
    }
}
