//! The values that parts of a cam contribute to a report, with their words.

use super::Section;
use super::figures::shown;
use super::sheet::rounded;
use serde::{Deserialize, Serialize};

/// The words for a cam of several lobes.
#[must_use]
pub fn lobes_words(lobes: u32) -> String {
    format!("{lobes} equal lobes, 1/{lobes} turn per turn of the crank")
}

/// Measures of a plane cam; those that a kind of cam does not have are absent.
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
    /// Where the cam touches a flat face, from its stem or its pivot: smallest and largest distance.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub face_mm: Option<[f64; 2]>,
    /// Turns of a roller about its own axis per turn of the cam of a motion program: mean and largest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub roller_turns: Option<[f64; 2]>,
    /// Equal lobes of a press's cam, one for each turn of the crank in a turn of the cam.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lobes: Option<u32>,
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

impl Weight {
    /// Area, mass and unbalance, for a reader.
    #[must_use]
    pub fn words(&self) -> Option<String> {
        let mass = self.mass_kg.map_or_else(|| "no thickness given".into(), |mass| format!("mass {} kg", shown(mass)));
        let unbalance = self
            .unbalance_g_mm
            .map_or(String::new(), |unbalance| format!(", unbalance {} g·mm", shown(unbalance.round())));
        Some(format!("area {} mm², {mass}{unbalance}", shown(self.area_mm2?)))
    }

    /// The mass, for the sheet.
    #[must_use]
    pub fn figure(&self) -> Option<String> {
        self.mass_kg.map(|mass| format!("mass {mass:.2} kg"))
    }
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
                "the roller turns {} times per turn of the cam, at up to {} times the speed of the cam",
                shown(mean),
                shown(most)
            )
        };
        words.extend(self.roller_turns.map(spin));
        words.extend(self.weight.words());
        let of =
            self.roller_radius_mm.map_or(String::new(), |radius| format!(", roller Ø{} mm", rounded(2.0 * radius)));
        let base = rounded(self.base_radius_mm.unwrap_or(f64::NAN));
        let mut figures = vec![format!("base radius {base} mm{of}")];
        figures.push(self.lift());
        figures.extend(lobes);
        figures.extend(self.weight.figure());
        Section::new("cam", self).with_words(words).with_figures(figures)
    }

    fn lift(&self) -> String {
        match (self.max_lift_mm, self.max_lift_deg) {
            (_, Some(degrees)) => format!("lift {degrees:.3}°"),
            (lift, None) => format!("lift {:.3} mm", lift.unwrap_or(f64::NAN)),
        }
    }

    fn size(&self) -> String {
        let roller =
            self.roller_radius_mm.map_or(String::new(), |radius| format!(", roller Ø{} mm", shown(2.0 * radius)));
        let smallest = self.smallest_prime_radius_mm.map_or_else(
            || "no radius keeps the limits".into(),
            |radius| format!("smallest possible {} mm", shown(radius)),
        );
        format!(
            "base radius {} mm{roller}, prime radius {} mm ({smallest}), {}",
            shown(self.base_radius_mm.unwrap_or(f64::NAN)),
            shown(self.prime_radius_mm.unwrap_or(f64::NAN)),
            self.lift()
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
    /// N* for the velocity alone, where it has a tolerance.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub arcs_best_possible_velocity: Option<f64>,
    /// N* for the acceleration alone, where it has a tolerance.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub arcs_best_possible_acceleration: Option<f64>,
    pub length_mm: f64,
}

/// A best possible number of arcs that rounds to 0: arcs and lines are the exact outline.
const NO_ARCS: f64 = 0.05;

impl OutlineMeasures {
    fn best_possible_words(&self) -> String {
        if self.arcs_best_possible < NO_ARCS {
            return "those of the exact outline".into();
        }
        let ratio = self.arcs_over_best_possible.map_or(String::new(), |ratio| format!(" × {ratio:.2}"));
        let also =
            |what: &str, best: Option<f64>| best.map_or(String::new(), |best| format!(", {best:.1} for the {what}"));
        let velocity = also("velocity", self.arcs_best_possible_velocity);
        let acceleration = also("acceleration", self.arcs_best_possible_acceleration);
        format!("best possible {:.1}{ratio}{velocity}{acceleration}", self.arcs_best_possible)
    }

    /// The section `outline`.
    #[must_use]
    pub fn section(&self) -> Section {
        let (arcs, lines) = (self.arcs, self.lines);
        let (what, short) = match (self.splines, self.spans) {
            (Some(splines), Some(spans)) => (
                format!(
                    "{splines} splines of {spans} spans (by theory {:.1}), {arcs} arcs and {lines} lines",
                    self.spans_by_theory.unwrap_or(f64::NAN)
                ),
                format!("{splines} splines of {spans} spans"),
            ),
            _ => (format!("{arcs} arcs and {lines} lines ({})", self.best_possible_words()), format!("{arcs} arcs")),
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
