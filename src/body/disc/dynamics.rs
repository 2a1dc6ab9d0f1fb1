//! Torque and power of the shaft of a motion program, the flywheel that evens its speed, and the spin of a roller.

use super::Disc;
use crate::body::plane;
use crate::follower::Element;
use crate::numeric::{quadrature, root};
use crate::profile::Worst;
use crate::profile::extremes::{self, stretches};
use crate::report::{Section, degrees, shown};
use serde::Serialize;
use std::f64::consts::TAU;

/// Cells of a stretch in which the torque crosses its mean once each.
const CELLS: u32 = 128;
/// Panels of a stretch over which the torque is integrated: 1e-15 of ten half waves.
const PANELS: u32 = 16;
/// Panels of a stretch of a torque with kinks: 1e-7 of it.
const KINKED_PANELS: u32 = 256;
/// Panels of a piece over which the spin of a roller is integrated.
const SPIN_PANELS: u32 = 24;

/// The section `dynamics`. Power and work need the speed of the cam.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
struct DynamicsSection {
    torque_mean_nm: f64,
    torque_max_nm: f64,
    torque_max_at_deg: f64,
    torque_min_nm: f64,
    torque_min_at_deg: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    power_mean_w: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    power_max_w: Option<f64>,
    /// Largest less smallest of ∮(T − T̄) dθ.
    work_fluctuation_j: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    flywheel_kg_m2: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    contact_force_max_n: Option<f64>,
    contact_force_max_at_deg: f64,
    contact_force_min_n: f64,
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

/// Turns of a roller about its own axis for a turn of the cam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spin {
    /// Over the turn.
    pub mean: f64,
    /// The quickest, and where.
    pub largest: Worst,
}

impl Disc {
    /// What the shaft does over a turn; `None` where no force is known, or the follower jams.
    #[must_use]
    pub fn shaft_torque(&self) -> Option<ShaftTorque> {
        self.pressing()?;
        let torque = |piece: usize, angle: f64| self.torque(piece, angle);
        let largest = self.largest_force(torque);
        let least = self.largest_force(|piece, angle| -torque(piece, angle));
        if !(largest.value.is_finite() && least.value.is_finite()) {
            return None;
        }
        let acting = self.acting();
        let pieces = self.motion.distinct().iter().enumerate();
        let all: Vec<(usize, (f64, f64))> = pieces
            .flat_map(|(index, piece)| stretches(piece, &acting).into_iter().map(move |of| (index, of)))
            .collect();
        // The friction of a guide has kinks where a bearing changes sides.
        let panels = if self.program_follower.guide.is_some() { KINKED_PANELS } else { PANELS };
        let work = |of: &(usize, (f64, f64))| quadrature::integrate(|at| torque(of.0, at), of.1, panels);
        let turn: f64 = all.iter().map(|(_, (from, to))| to - from).sum();
        let mean = all.iter().map(work).sum::<f64>() / turn;
        // A conservative follower gives everything back: what is left of the sum is rounding.
        let size = largest.value.max(-least.value);
        let dissipates = self.program_follower.guide.is_some()
            || self.program_follower.spring.is_some_and(|spring| spring.damping > 0.0);
        let mean = if dissipates || self.load.is_some() || mean.abs() > ROUNDING * size { mean } else { 0.0 };
        let (mut sum, mut low, mut high) = (0.0_f64, 0.0_f64, 0.0_f64);
        for (piece, range) in all {
            for part in crossings(&|at| torque(piece, at) - mean, range).windows(2) {
                let &[from, to] = part else { continue };
                sum += quadrature::integrate(|at| torque(piece, at) - mean, (from, to), panels);
                (low, high) = (low.min(sum), high.max(sum));
            }
        }
        let least = Worst { value: -least.value, ..least };
        Some(ShaftTorque { mean, largest, least, fluctuation: high - low })
    }

    /// Largest force along the normal, N; `None` where none is known, or the follower jams.
    #[must_use]
    pub fn largest_contact_force(&self) -> Option<f64> {
        self.pressing()?;
        let force = self.largest_force(|piece, angle| self.normal_force(piece, angle).unwrap_or(f64::NAN)).value;
        Some(force).filter(|force| force.is_finite())
    }

    /// How a roller turns about its own axis on the cam, |C'|/r − 1 − τψ' for a turn of the cam, rolling: |C'|/r by the path of its centre, the
    /// rest by the turning of what carries it. `None` of any other follower, and of an edge.
    #[must_use]
    pub fn spin(&self) -> Option<Spin> {
        let Element::Roller { radius } = self.follower.element() else { return None };
        if radius == 0.0 {
            return None;
        }
        let curves = self.curves();
        let spin = |piece: usize, angle: f64| {
            let touch = curves.touch(piece, angle);
            touch.curve.speed / radius - touch.drive_turn
        };
        let of_piece = |(index, piece): (usize, &crate::motion::Piece)| {
            let panels = if piece.dwell { 1 } else { SPIN_PANELS };
            quadrature::integrate(|at| spin(index, at), (piece.start, piece.end), panels)
        };
        let turns: f64 = self.motion.distinct().iter().enumerate().map(of_piece).sum();
        let mean = turns * f64::from(self.motion.lobes()) / TAU;
        Some(Spin { mean, largest: plane(extremes::largest_smooth(curves, (&[], SPIN_MATTERS * mean), spin)) })
    }

    /// The section `dynamics` of a motion program whose forces are known.
    pub(super) fn dynamics(&self) -> Option<Section> {
        if !self.is_of_program() {
            return None;
        }
        let torque = self.shaft_torque()?;
        let normal = |piece: usize, angle: f64| self.normal_force(piece, angle).unwrap_or(f64::NAN);
        let (force, least) = (self.largest_force(normal), self.largest_force(|piece, angle| -normal(piece, angle)));
        let jump = self.jump().and_then(Result::ok).filter(|jump| jump.value.is_finite());
        let flywheel = self.machine.fluctuation().zip(self.speed);
        let figures = DynamicsSection {
            torque_mean_nm: torque.mean,
            torque_max_nm: torque.largest.value,
            torque_max_at_deg: degrees(torque.largest.at),
            torque_min_nm: torque.least.value,
            torque_min_at_deg: degrees(torque.least.at),
            power_mean_w: self.speed.map(|speed| speed * torque.mean),
            power_max_w: self.speed.map(|speed| speed * torque.largest.value),
            work_fluctuation_j: torque.fluctuation,
            flywheel_kg_m2: flywheel.map(|(share, speed)| torque.fluctuation / (share * speed * speed)),
            contact_force_max_n: Some(force.value).filter(|force| force.is_finite()),
            contact_force_max_at_deg: degrees(force.at),
            contact_force_min_n: -least.value,
            jump_rpm: jump.map(|jump| 60.0 * jump.value / TAU),
            jump_at_deg: jump.map(|jump| degrees(jump.at)),
        };
        Some(Section::new("dynamics", &figures).with_words(self.words(&figures)))
    }

    fn words(&self, figures: &DynamicsSection) -> Vec<String> {
        let mut words = vec![format!(
            "torque of the shaft from {} N·m at {:.3}° to {} N·m at {:.3}°, mean {} N·m",
            shown(figures.torque_min_nm),
            figures.torque_min_at_deg,
            shown(figures.torque_max_nm),
            figures.torque_max_at_deg,
            shown(figures.torque_mean_nm)
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
        words.push(format!("work of the speed fluctuation {} J{flywheel}", shown(figures.work_fluctuation_j)));
        let force = figures.contact_force_max_n.map(|force| {
            format!(
                "force along the normal up to {} N at {:.3}°, least {} N",
                shown(force),
                figures.contact_force_max_at_deg,
                shown(figures.contact_force_min_n)
            )
        });
        words.extend(force);
        if figures.contact_force_min_n <= 0.0 && !self.is_closed() {
            words.push("the follower leaves the cam: torque, power and work are as if it were held on it".into());
        }
        words
    }
}

/// Share of the largest torque below which the mean is rounding.
const ROUNDING: f64 = 1e-11;
/// Share of the mean spin below which a difference does not matter.
const SPIN_MATTERS: f64 = 1e-9;

/// The ends of a range and where a function changes its sign in it.
fn crossings(function: &dyn Fn(f64) -> f64, (low, high): (f64, f64)) -> Vec<f64> {
    let inside = root::sign_changes(function, (low, high), CELLS).into_iter().filter(|at| low < *at && *at < high);
    std::iter::once(low).chain(inside).chain([high]).collect()
}
