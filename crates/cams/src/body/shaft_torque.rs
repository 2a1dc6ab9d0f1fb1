//! Torque and power of a camshaft over a turn, and the flywheel that evens its speed.

use crate::machine::Machine;
use crate::report::{Fact, Section, Topic, degrees, shown};
use camgen_kernel::numeric::{quadrature, root};
use camgen_kernel::profile::Worst;
use camgen_kernel::text::{Value, text};
use camgen_kernel::units;
use serde::Serialize;

/// Cells of a stretch in which the torque crosses its mean once each.
const CELLS: u32 = 128;
/// Panels of a stretch over which the torque is integrated: 1e-15 of ten half waves.
const PANELS: u32 = 16;
/// Panels of a stretch of a torque with kinks: 1e-7 of it.
const KINKED_PANELS: u32 = 256;
/// Share of the largest torque below which the mean is rounding.
const ROUNDING: f64 = 1e-11;

/// The figures of the section that need the force along the normal, and those that need the speed at which the follower leaves the cam.
pub(super) const OF_CONTACT_FORCE: [&str; 3] =
    ["dynamics.contact_force_max_n", "dynamics.contact_force_max_at_deg", "dynamics.contact_force_min_n"];
pub(super) const OF_JUMP: [&str; 2] = ["dynamics.jump_rpm", "dynamics.jump_at_deg"];
/// Those that need the torque over the whole turn.
pub(super) const OF_TURN: [&str; 6] = [
    "dynamics.torque_mean_nm",
    "dynamics.torque_min_nm",
    "dynamics.torque_min_at_deg",
    "dynamics.power_mean_w",
    "dynamics.work_fluctuation_j",
    "dynamics.flywheel_kg_m2",
];

/// The section `dynamics`. Power and work need the speed of the cam.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
struct DynamicsSection {
    #[serde(skip_serializing_if = "Option::is_none")]
    torque_mean_nm: Option<f64>,
    torque_max_nm: f64,
    torque_max_at_deg: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    torque_min_nm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    torque_min_at_deg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    power_mean_w: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    power_max_w: Option<f64>,
    /// Largest less smallest of ∮(T − T̄) dθ.
    #[serde(skip_serializing_if = "Option::is_none")]
    work_fluctuation_j: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    flywheel_kg_m2: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    contact_force_max_n: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    contact_force_max_at_deg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    contact_force_min_n: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    jump_rpm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    jump_at_deg: Option<f64>,
}

/// The torque of the shaft over a turn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShaftTorque {
    /// Mean torque, N·m.
    pub mean: f64,
    /// Largest, and where.
    pub largest: Worst,
    /// Least, and where.
    pub least: Worst,
    /// Largest less smallest work of what exceeds the mean, J.
    pub fluctuation: f64,
}

/// A torque over the smooth stretches of a turn.
pub(super) struct TorqueOverTurn<'a> {
    /// The torque, N·m.
    pub(super) torque: &'a dyn Fn(usize, f64) -> f64,
    /// Stretches between whose ends it is smooth, each with its piece.
    pub(super) stretches: &'a [(usize, (f64, f64))],
    /// Whether it has kinks between them.
    pub(super) has_kinks: bool,
    /// Whether everything is given back over the turn, so that the mean is 0.
    pub(super) gives_back: bool,
}

impl TorqueOverTurn<'_> {
    /// What the shaft does over a turn, with the largest torque and the largest of the other sign, as a positive number; `None` where the follower jams.
    pub(super) fn shaft(&self, [largest, opposite]: [Worst; 2]) -> Option<ShaftTorque> {
        if !(largest.value.is_finite() && opposite.value.is_finite()) {
            return None;
        }
        let panels = if self.has_kinks { KINKED_PANELS } else { PANELS };
        let work = |of: &(usize, (f64, f64))| quadrature::integrate(|at| (self.torque)(of.0, at), of.1, panels);
        let turn: f64 = self.stretches.iter().map(|(_, (from, to))| to - from).sum();
        let mean = self.stretches.iter().map(work).sum::<f64>() / turn;
        // A conservative follower gives everything back: what is left of the sum is rounding.
        let size = largest.value.max(opposite.value);
        let mean = if !self.gives_back || mean.abs() > ROUNDING * size { mean } else { 0.0 };
        let (mut sum, mut low, mut high) = (0.0_f64, 0.0_f64, 0.0_f64);
        for (piece, range) in self.stretches {
            let above = |at: f64| (self.torque)(*piece, at) - mean;
            for part in crossings(&above, *range).windows(2) {
                let &[from, to] = part else { continue };
                sum += quadrature::integrate(above, (from, to), panels);
                (low, high) = (low.min(sum), high.max(sum));
            }
        }
        let least = Worst { value: -opposite.value, ..opposite };
        Some(ShaftTorque { mean, largest, least, fluctuation: high - low })
    }
}

/// What the section `dynamics` is made of.
pub(super) struct DynamicsFigures<'a> {
    pub(super) machine: &'a Machine,
    /// Angular speed of the cam, rad/s, where it is known.
    pub(super) speed: Option<f64>,
    /// Largest torque of the shaft, and where.
    pub(super) largest_torque: Worst,
    /// The torque over the turn; `None` where only the largest is wanted.
    pub(super) torque: Option<ShaftTorque>,
    /// Largest and least force along the normal, N; the largest infinite where the follower jams. `None` where they are not wanted.
    pub(super) force: Option<[Worst; 2]>,
    /// Angular speed of the cam at which the follower first leaves it, rad/s, and where.
    pub(super) jump: Option<Worst>,
    /// Whether the cam holds the follower from both sides.
    pub(super) is_closed: bool,
}

impl DynamicsFigures<'_> {
    /// The section.
    pub(super) fn section(&self) -> Section {
        let Self { machine, speed, largest_torque, torque, jump, .. } = *self;
        let [force, least] = [0, 1].map(|end| self.force.map(|force| force[end]));
        let flywheel = machine.fluctuation().zip(speed);
        let figures = DynamicsSection {
            torque_mean_nm: torque.map(|torque| torque.mean),
            torque_max_nm: largest_torque.value,
            torque_max_at_deg: degrees(largest_torque.at),
            torque_min_nm: torque.map(|torque| torque.least.value),
            torque_min_at_deg: torque.map(|torque| degrees(torque.least.at)),
            power_mean_w: speed.zip(torque).map(|(speed, torque)| speed * torque.mean),
            power_max_w: speed.map(|speed| speed * largest_torque.value),
            work_fluctuation_j: torque.map(|torque| torque.fluctuation),
            flywheel_kg_m2: flywheel
                .zip(torque)
                .map(|((share, speed), torque)| torque.fluctuation / (share * speed * speed)),
            contact_force_max_n: force.map(|force| force.value).filter(|force| force.is_finite()),
            contact_force_max_at_deg: force.map(|force| degrees(force.at)),
            contact_force_min_n: least.map(|least| least.value),
            jump_rpm: jump.map(|jump| units::rpm(jump.value)),
            jump_at_deg: jump.map(|jump| degrees(jump.at)),
        };
        Section::new("dynamics", &figures).with_words(self.words(&figures)).with_facts(self.facts(&figures))
    }

    fn facts(&self, figures: &DynamicsSection) -> Vec<Fact> {
        let mut facts = Vec::new();
        if let Some((most, least)) = figures.contact_force_max_n.zip(figures.contact_force_min_n) {
            let low = Value::brief_number(least);
            let text = if least > 0.0 || self.is_closed {
                text!("{} to {} along the normal", low, Value::brief(most, "N"))
            } else {
                text!("up to {} along the normal; the follower leaves the cam", Value::brief(most, "N"))
            };
            facts.push(Fact::new(Topic::FORCE, text));
        }
        if let Some(torque) = &self.torque {
            let range =
                text!("{} to {}", Value::brief_number(torque.least.value), Value::brief(torque.largest.value, "N·m"));
            let power = figures.power_max_w.map(|most| text!("peak {}", Value::brief(most, "W")));
            let range = range.and(", ", power).and("; ", "friction is not counted");
            facts.push(Fact::new(Topic::TORQUE, range));
        }
        facts
    }

    fn words(&self, figures: &DynamicsSection) -> Vec<String> {
        let Some(torque) = &self.torque else { return Vec::new() };
        let mut words = vec![format!(
            "torque of the shaft from {} N·m at {:.3}° to {} N·m at {:.3}°, mean {} N·m",
            shown(torque.least.value),
            degrees(torque.least.at),
            shown(figures.torque_max_nm),
            figures.torque_max_at_deg,
            shown(torque.mean)
        )];
        if let Some((mean, most)) = figures.power_mean_w.zip(figures.power_max_w) {
            words.push(format!("power at most {} W, mean {} W", shown(most), shown(mean)));
        } else {
            words.push("without motion.rpm or --rpm inertia and damping are left out, and no power is reported".into());
        }
        let flywheel = match (figures.flywheel_kg_m2, self.machine.fluctuation()) {
            (Some(inertia), Some(share)) => {
                format!("; {} kg·m² on the shaft keeps its speed within {}", shown(inertia), shown(share))
            }
            (None, Some(_)) => "; the flywheel needs motion.rpm or --rpm".into(),
            _ => String::new(),
        };
        words.push(format!("work of the speed fluctuation {} J{flywheel}", shown(torque.fluctuation)));
        let force = figures.contact_force_max_n.zip(figures.contact_force_max_at_deg).zip(figures.contact_force_min_n);
        words.extend(force.map(|((most, at), least)| {
            format!("force along the normal up to {} N at {at:.3}°, least {} N", shown(most), shown(least))
        }));
        if figures.contact_force_min_n.is_some_and(|least| least <= 0.0) && !self.is_closed {
            words.push("the follower leaves the cam: torque, power and work are as if it were held on it".into());
        }
        words
    }
}

/// The ends of a range and where a function changes its sign in it.
fn crossings(function: &dyn Fn(f64) -> f64, (low, high): (f64, f64)) -> Vec<f64> {
    let inside = root::sign_changes(function, (low, high), CELLS).into_iter().filter(|at| low < *at && *at < high);
    std::iter::once(low).chain(inside).chain([high]).collect()
}
