//! The values that parts of a cam contribute to a report, with their words.

use super::shown;
use super::{Fact, Section, Topic};
use camgen_kernel::text::{DIGITS, Length, LengthKind, Text, Value, nominal, text};
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
    pub fn words(&self) -> Option<Text> {
        let mass = self.mass_kg.map_or_else(|| "no thickness given".into(), |mass| format!("mass {} kg", shown(mass)));
        let unbalance = self
            .unbalance_g_mm
            .map_or(String::new(), |unbalance| format!(", unbalance {} g·mm", shown(unbalance.round())));
        Some(text!("area {}, {}{}", Length::new(self.area_mm2?, &LengthKind::MM2), mass, unbalance))
    }

    /// The mass, for a summary.
    #[must_use]
    pub fn fact(&self) -> Option<Fact> {
        self.mass_kg.map(|mass| Fact::new(Topic::SIZE, Value::brief(mass, "kg")))
    }

    /// The mass, for the sheet.
    #[must_use]
    pub fn figure(&self) -> Option<Text> {
        self.mass_kg.map(|mass| text!("mass {} kg", format_args!("{mass:.2}")))
    }
}

impl CamMeasures {
    /// The section `cam`.
    #[must_use]
    pub fn section(&self) -> Section {
        let mut words = vec![self.size()];
        let lobes = self.lobes.filter(|lobes| *lobes > 1).map(lobes_words);
        words.extend(lobes.clone().map(Text::from));
        let on_face = |[least, most]: [f64; 2]| {
            text!("touches the face from {} to {}", Length::mm(least).bare(), Length::mm(most))
        };
        words.extend(self.face_mm.map(on_face));
        let spin = |[mean, most]: [f64; 2]| {
            text!(
                "the roller turns {} times per turn of the cam, at up to {} times the speed of the cam",
                shown(mean),
                shown(most)
            )
        };
        words.extend(self.roller_turns.map(spin));
        words.extend(self.weight.words());
        let of = self.roller_radius_mm.map(|radius| text!(", roller Ø{}", Length::mm(2.0 * radius).rounded()));
        let base = Length::mm(self.base_radius_mm.unwrap_or(f64::NAN)).rounded();
        let mut figures = vec![text!("base radius {}{}", base, of)];
        figures.push(self.lift());
        figures.extend(lobes.map(Text::from));
        figures.extend(self.weight.figure());
        Section::new("cam", self).with_words(words).with_figures(figures).with_facts(self.facts())
    }

    fn facts(&self) -> Vec<Fact> {
        let base = self.base_radius_mm.map(|radius| text!("base R{}", Length::mm(radius).nominal()));
        let roller = self.roller_radius_mm.map(|radius| text!("roller Ø{}", Length::mm(2.0 * radius).nominal()));
        let lobes = self.lobes.filter(|lobes| *lobes > 1).map(|lobes| text!("{} equal lobes", lobes));
        let lift = match (self.max_lift_mm, self.max_lift_deg) {
            (_, Some(degrees)) => text!("{}°", nominal(degrees, DIGITS)),
            (lift, None) => Value::from(Length::mm(lift.unwrap_or(f64::NAN)).brief()).into(),
        };
        let face = self.face_mm.map(|[least, most]| {
            text!("touches the face from {} to {}", Length::mm(least).bare().brief(), Length::mm(most).brief())
        });
        let size = [base, roller, lobes].into_iter().flatten().map(|text| Fact::new(Topic::SIZE, text));
        let lift = [Some(lift), face].into_iter().flatten().map(|text| Fact::new(Topic::LIFT, text));
        size.chain(self.weight.fact()).chain(lift).collect()
    }

    fn lift(&self) -> Text {
        match (self.max_lift_mm, self.max_lift_deg) {
            (_, Some(degrees)) => text!("lift {}°", format_args!("{degrees:.3}")),
            (lift, None) => text!("lift {}", Length::mm(lift.unwrap_or(f64::NAN)).decimals(3)),
        }
    }

    fn size(&self) -> Text {
        let roller = self.roller_radius_mm.map(|radius| text!(", roller Ø{}", Length::mm(2.0 * radius)));
        let smallest = self.smallest_prime_radius_mm.map_or_else(
            || Text::from("no radius keeps the limits"),
            |radius| text!("smallest possible {}", Length::mm(radius)),
        );
        text!(
            "base radius {}{}, prime radius {} ({}), {}",
            Length::mm(self.base_radius_mm.unwrap_or(f64::NAN)),
            roller,
            Length::mm(self.prime_radius_mm.unwrap_or(f64::NAN)),
            smallest,
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
        let deviation = Length::um_of_mm(self.deviation_max_mm);
        let words = vec![text!(
            "{}, {} from the exact curve, tolerance {}",
            what,
            deviation.clone().decimals(4),
            Length::um_of_mm(self.tolerance_mm)
        )];
        let figure = text!("{}, {} from the exact curve", short, deviation.decimals(3));
        Section::new("outline", self).with_words(words).with_figures(vec![figure])
    }
}
