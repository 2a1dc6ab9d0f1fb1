//! The values that parts of a cam contribute to a report, with their words.

use super::Section;
use super::sheet::rounded;
use serde::{Deserialize, Serialize};

/// Four decimals at the most, without trailing zeros; small values keep four digits, tiny ones two.
#[must_use]
pub fn shown(value: f64) -> String {
    let size = value.abs();
    let decimals = if size < 1e-6 && size > 0.0 {
        return format!("{value:.1e}");
    } else if size < 0.1 {
        1e6
    } else {
        1e4
    };
    format!("{}", (value * decimals).round() / decimals)
}

/// What a cam of several lobes is told to be.
#[must_use]
pub fn lobes_words(lobes: u32) -> String {
    format!("{lobes} equal lobes, 1/{lobes} turn per turn of the crank")
}

/// Measures of a plane cam. What a kind of cam does not have is left out.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct CamMeasures {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub prime_radius_mm: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub base_radius_mm: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub roller_radius_mm: Option<f64>,
    /// Of a follower on a straight path.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_lift_mm: Option<f64>,
    /// Of a swinging follower.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_lift_deg: Option<f64>,
    /// The smallest prime radius that keeps every limit, before rounding.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub smallest_prime_radius_mm: Option<f64>,
    /// Where a flat face is touched, from its stem or its pivot: least and most.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub face_mm: Option<[f64; 2]>,
    /// Turns of a roller about its own axis for a turn of the cam of a motion program: mean and most.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub roller_turns: Option<[f64; 2]>,
    /// Equal lobes of a press's cam, one for each turn of the crank in a turn of the cam.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lobes: Option<u32>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plate: Option<PlateMeasures>,
    #[serde(flatten)]
    pub weight: Weight,
}

/// Area, mass and centre of mass of a part.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct Weight {
    /// Of the metal: outline less bore and holes.
    pub area_mm2: Option<f64>,
    pub mass_kg: Option<f64>,
    pub centre_of_mass_mm: Option<[f64; 2]>,
    /// Static unbalance about the shaft, with the holes that balance it, if any.
    pub unbalance_g_mm: Option<f64>,
}

/// Measures of a plate on the bed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct PlateMeasures {
    pub length_mm: f64,
    pub height_mm: f64,
    pub thinnest_mm: f64,
    pub thinnest_at_x_mm: f64,
    /// Of the roller's centre from the bed's axis where Δx = 0: what the pitch curve of (21) starts from.
    pub axis_distance_mm: f64,
}

impl CamMeasures {
    /// The section `cam`.
    #[must_use]
    pub fn section(&self) -> Section {
        let mut words = vec![self.size()];
        let lobes = self.lobes.filter(|lobes| *lobes > 1).map(lobes_words);
        words.extend(lobes.clone());
        let on_face = |[least, most]: [f64; 2]| format!("touches the face from {} to {} mm", shown(least), shown(most));
        words.extend(self.face_mm.map(on_face));
        let spin = |[mean, most]: [f64; 2]| {
            format!(
                "the roller turns {} times for a turn of the cam, at up to {} times its speed",
                shown(mean),
                shown(most)
            )
        };
        words.extend(self.roller_turns.map(spin));
        if let Some(area) = self.weight.area_mm2 {
            let mass =
                self.weight.mass_kg.map_or_else(|| "no thickness given".into(), |mass| format!("mass {mass:.3} kg"));
            let unbalance = self.weight.unbalance_g_mm;
            let unbalance = unbalance.map_or(String::new(), |unbalance| format!(", unbalance {unbalance:.0} g·mm"));
            words.push(format!("area {area:.1} mm², {mass}{unbalance}"));
        }
        let of = self.roller_radius_mm.map_or(String::new(), |radius| format!(", roller {} mm", rounded(radius)));
        let mut figures = vec![match (&self.plate, self.base_radius_mm) {
            (Some(plate), _) => format!(
                "plate {} × {} mm, {:.2} mm where thinnest{of}",
                rounded(plate.length_mm),
                rounded(plate.height_mm),
                plate.thinnest_mm
            ),
            (None, base) => format!("base radius {} mm{of}", rounded(base.unwrap_or(f64::NAN))),
        }];
        figures.push(self.lift());
        figures.extend(lobes);
        figures.extend(self.weight.mass_kg.map(|mass| format!("mass {mass:.2} kg")));
        Section::new("cam", self).with_words(words).with_figures(figures)
    }

    fn lift(&self) -> String {
        match (self.max_lift_mm, self.max_lift_deg) {
            (_, Some(degrees)) => format!("lift {degrees:.3}°"),
            (lift, None) => format!("lift {:.3} mm", lift.unwrap_or(f64::NAN)),
        }
    }

    fn size(&self) -> String {
        let roller = self.roller_radius_mm.map_or(String::new(), |radius| format!(", roller {} mm", shown(radius)));
        if let Some(plate) = &self.plate {
            return format!(
                "plate {:.2} × {} mm, {:.3} mm where it is thinnest (x = {:.2} mm){roller}, {}",
                plate.length_mm,
                shown(plate.height_mm),
                plate.thinnest_mm,
                plate.thinnest_at_x_mm,
                self.lift()
            );
        }
        let smallest = self
            .smallest_prime_radius_mm
            .map_or_else(|| "no radius keeps the limits".into(), |radius| format!("smallest possible {radius:.3} mm"));
        format!(
            "base radius {} mm{roller}, prime radius {} mm ({smallest}), {}",
            shown(self.base_radius_mm.unwrap_or(f64::NAN)),
            shown(self.prime_radius_mm.unwrap_or(f64::NAN)),
            self.lift()
        )
    }
}

/// The law of the press: the air and what the bottom of the cylinders does.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct AirLaw {
    /// The Δx of largest size, signed.
    pub dx_max_mm: f64,
    pub dx_max_at_x_mm: f64,
    pub column_length_mm: f64,
    pub piston_area_mm2: f64,
    pub bore_mm: f64,
    /// The slope dΔx/dx at the start of the reversal; c − 1 for a disc cam.
    pub start_slope: f64,
    /// Jump of the bottom's velocity at the start of the reversal.
    pub velocity_jump_mm_per_rad: f64,
    /// The larger jump is that at the end of the reversal.
    #[serde(skip)]
    pub jumps_at_end: bool,
    /// Where a blend closes the air column at ambient pressure: the crank angle at which it starts to move the bottom.
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
    /// Overrun at the dead point, and what is left of it at the end of the reversal.
    pub overrun_mm: f64,
    pub overrun_left_mm: f64,
}

impl ReversalOfBed {
    /// The section `reversal`.
    #[must_use]
    pub fn section(&self) -> Section {
        let words = self.words();
        Section::new("reversal", self).with_figures(vec![words.clone()]).with_words(vec![words])
    }

    fn words(&self) -> String {
        let left = if self.overrun_left_mm.abs() < 1e-9 {
            String::new()
        } else {
            format!("; it ends {:.3} mm from where it starts", self.overrun_left_mm)
        };
        format!(
            "{} end: reversal from {:.3}° of the crank over {:.3}°, dead point {:.3}° after its start, overrun {:.3} mm{left}",
            self.end, self.start_deg, self.angle_deg, self.dead_point_deg, self.overrun_mm
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
    /// The direction of the bed in which the forces balance.
    pub balance: String,
    /// Where the law of the slope changes.
    pub breaks: Vec<Break>,
}

/// A place where the law of the slope changes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct Break {
    pub x_mm: f64,
    /// What the bottom does from there on while x grows: "rising", "falling", or "stuck" where the lever sticks.
    pub then: String,
}

impl AirLaw {
    /// The section `law`.
    #[must_use]
    pub fn section(&self) -> Section {
        let mut words = vec![format!(
            "Δx {:.3} mm at x = {:.2} mm, air column {:.3} mm, bore {:.2} mm",
            self.dx_max_mm, self.dx_max_at_x_mm, self.column_length_mm, self.bore_mm
        )];
        if self.velocity_jump_mm_per_rad != 0.0 {
            words.push(format!(
                "its velocity jumps by {:.2} mm/rad of crank at the {} of the reversal",
                self.velocity_jump_mm_per_rad,
                if self.jumps_at_end { "end" } else { "start" }
            ));
        }
        if let Some(degrees) = self.column_closed_at_crank_deg {
            words.push(format!(
                "the air column is taken as closed at ambient pressure where the blend starts, {}° of the crank",
                shown(degrees)
            ));
        }
        if let Some(solved) = &self.equation_18 {
            words.push(solved.words(self.start_slope));
            let then = |at: &Break| format!("{} from x = {:.3} mm", at.then, at.x_mm);
            if !solved.breaks.is_empty() {
                let breaks: Vec<String> = solved.breaks.iter().map(then).collect();
                words.push(format!("the bottom is {}", breaks.join(", ")));
            }
        }
        let figures = vec![
            format!("air column {:.3} mm", self.column_length_mm),
            format!("Δx {:.3} mm at x = {:.2} mm", self.dx_max_mm, self.dx_max_at_x_mm),
        ];
        Section::new("law", self).with_words(words).with_figures(figures)
    }
}

impl Equation18 {
    fn words(&self, start_slope: f64) -> String {
        let how = match (self.stations, self.tolerance_mm) {
            (Some(stations), _) => format!("{stations} stations"),
            (None, tolerance) => {
                format!("{} steps to {:e} mm", self.steps.unwrap_or(0), tolerance.unwrap_or(f64::NAN))
            }
        };
        format!(
            "equation (18) by {} in {how}, efficiency {}, forces balanced: {}, slope at the start {start_slope:.8}",
            self.solver, self.efficiency_model, self.balance
        )
    }
}

/// The outline of a plane cam.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct OutlineMeasures {
    pub arcs: usize,
    pub lines: usize,
    /// Of an outline of splines: how many, of how many spans together, and how many spans by theory.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub splines: Option<usize>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spans: Option<usize>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spans_by_theory: Option<f64>,
    pub deviation_max_mm: f64,
    pub tangent_break_max_deg: f64,
    pub tolerance_mm: f64,
    /// N*, the least possible number of tangent arcs, dwells not counted.
    pub arcs_best_possible: f64,
    pub arcs_over_best_possible: Option<f64>,
    /// The same for the velocity alone, where it has a tolerance.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub arcs_best_possible_velocity: Option<f64>,
    /// The same for the acceleration alone, where it has a tolerance.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub arcs_best_possible_acceleration: Option<f64>,
    pub length_mm: f64,
}

impl OutlineMeasures {
    /// The section `outline`.
    #[must_use]
    pub fn section(&self) -> Section {
        let ratio = self.arcs_over_best_possible.map_or(String::new(), |ratio| format!(" × {ratio:.2}"));
        let also =
            |what: &str, best: Option<f64>| best.map_or(String::new(), |best| format!(", {best:.1} for the {what}"));
        let also = also("velocity", self.arcs_best_possible_velocity)
            + &also("acceleration", self.arcs_best_possible_acceleration);
        let (arcs, lines) = (self.arcs, self.lines);
        let (what, short) = match (self.splines, self.spans) {
            (Some(splines), Some(spans)) => (
                format!(
                    "{splines} splines of {spans} spans (by theory {:.1}), {arcs} arcs and {lines} lines",
                    self.spans_by_theory.unwrap_or(f64::NAN)
                ),
                format!("{splines} splines of {spans} spans"),
            ),
            _ => (
                format!("{arcs} arcs and {lines} lines (best possible {:.1}{ratio}{also})", self.arcs_best_possible),
                format!("{arcs} arcs"),
            ),
        };
        let words = vec![format!(
            "{what}, {:.4} µm from the exact curve, tolerance {} µm",
            1e3 * self.deviation_max_mm,
            shown(1e3 * self.tolerance_mm)
        )];
        let figure = format!("{short}, {:.3} µm from the exact curve", 1e3 * self.deviation_max_mm);
        Section::new("outline", self).with_words(words).with_figures(vec![figure])
    }
}

/// Forces of a plane cam.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct Forces {
    pub inertia_max_n: f64,
    /// Largest |inertia − air| over the reversal with the lift as rolled on the written outline, or, where nothing was
    /// rolled, of the law.
    pub residual_max_n: f64,
    pub residual_share: f64,
    pub residual_fixed_bottom_max_n: f64,
    #[serde(default, flatten)]
    pub by_way: Option<ResidualByWay>,
    /// Along the roller's path; with preload and inertia of the follower where they are given.
    pub roller_force_max_n: f64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub torque_max_nm: Option<f64>,
}

/// Residual force of a plate's motion while the bed is braked and while it is accelerated back, also as shares of the
/// largest inertia.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the names say it, with their units")]
pub struct ResidualByWay {
    pub residual_braking_max_n: f64,
    pub residual_braking_share: f64,
    pub residual_return_max_n: f64,
    pub residual_return_share: f64,
    pub residual_return_at_x_mm: f64,
}

impl Forces {
    /// The section `force`.
    #[must_use]
    pub fn section(&self) -> Section {
        let mut words = vec![format!(
            "inertia {:.1} N; inertia less air {} N ({:.4} %) with this cam, {:.1} N with a fixed bottom",
            self.inertia_max_n,
            shown(self.residual_max_n),
            100.0 * self.residual_share,
            self.residual_fixed_bottom_max_n
        )];
        words.push(match self.torque_max_nm {
            Some(torque) => {
                format!("roller {:.1} N along its path, camshaft {torque:.1} N·m at the most", self.roller_force_max_n)
            }
            None => format!("each roller {:.1} N along the normal at the most", self.roller_force_max_n),
        });
        let mut figures = vec![
            format!("inertia {:.0} N, residual {:.2} N", self.inertia_max_n, self.residual_max_n),
            format!("fixed bottom would leave {:.0} N", self.residual_fixed_bottom_max_n),
        ];
        if let Some(way) = &self.by_way {
            words.push(format!(
                "the law leaves {} N ({:.2e} %) braking, {:.1} N ({:.2} %) on the way back at x = {:.2} mm",
                shown(way.residual_braking_max_n),
                100.0 * way.residual_braking_max_n / self.inertia_max_n,
                way.residual_return_max_n,
                100.0 * way.residual_return_max_n / self.inertia_max_n,
                way.residual_return_at_x_mm
            ));
            figures.push(format!(
                "residual {:.0} N braking, {:.0} N on the way back",
                way.residual_braking_max_n, way.residual_return_max_n
            ));
        }
        Section::new("force", self).with_words(words).with_figures(figures)
    }
}
