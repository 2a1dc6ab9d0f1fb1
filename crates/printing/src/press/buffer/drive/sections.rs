//! The paper's own solution of the drive-speed law (Voloshchak & Denis, equations (6)–(15)): the deceleration w = P/m is taken as
//! linear in the crank angle over sections of Δφ, with its exact values at their ends.
//!
//! It is of second order in Δφ. At the last node, φ' = 90°, the speed is the root of a radicand over cos φ' = 0; the chord of a
//! convex force lies above it, so the sections take too much energy and the radicand is negative there.

use super::{Drive, Phase};
use std::f64::consts::FRAC_PI_2;

/// Speed of the crank at a node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NodeSpeed {
    /// ω, rad/s.
    Omega(f64),
    /// The bed has no speed left: the radicand, 1/s², is negative.
    Negative {
        /// ω² in phase 1, ω² cos² φ' in phase 2.
        radicand: f64,
    },
    /// At φ' = 90° the radicand, 1/s², is left over a cosine of 0.
    Unbounded {
        /// ω² cos² φ'.
        radicand: f64,
    },
}

impl NodeSpeed {
    /// ω, rad/s, where there is one.
    #[must_use]
    pub fn omega(self) -> Option<f64> {
        match self {
            NodeSpeed::Omega(omega) => Some(omega),
            NodeSpeed::Negative { .. } | NodeSpeed::Unbounded { .. } => None,
        }
    }
}

/// The end of a section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionEnd {
    /// The phase.
    pub phase: Phase,
    /// Angle within the phase, rad.
    pub angle: f64,
    /// Overrun of the bed, m.
    pub x: f64,
    /// Deceleration w = P/m, m/s².
    pub deceleration: f64,
    /// Speed of the crank.
    pub speed: NodeSpeed,
}

/// ω1² of (12) for a section of phase 1.
fn lead_section(square: f64, w0: f64, w1: f64, step: f64, crank_radius: f64) -> f64 {
    square - 2.0 * step / crank_radius * (w0 + 0.5 * (w1 - w0))
}

/// ω1² cos² φ1 of (14), (15) for a section of phase 2 from ω0² cos² φ0.
fn crank_section(square: f64, w0: f64, w1: f64, from: f64, to: f64, crank_radius: f64) -> f64 {
    let (step, first) = (to - from, 2.0 * w0 / crank_radius);
    let second = 2.0 * (w1 - w0) / (crank_radius * step);
    let constant = square + first * libm::sin(from) + second * libm::cos(from);
    constant - first * libm::sin(to) - second * (step * libm::sin(to) + libm::cos(to))
}

/// The nodes of both phases for sections of `step` rad > 0; the last section of a phase is the rest of it. The list ends at a
/// node without speed.
#[must_use]
pub fn sections(drive: &Drive, step: f64) -> Vec<SectionEnd> {
    let machine = &drive.machine;
    let (r, lead) = (machine.crank_radius, machine.lead_angle);
    let mut square = drive.omega_before() * drive.omega_before();
    let start = SectionEnd {
        phase: Phase::Lead,
        angle: 0.0,
        x: 0.0,
        deceleration: 0.0,
        speed: NodeSpeed::Omega(drive.omega_before()),
    };
    let mut nodes = vec![start];
    let mut last = start;
    for angle in ends(lead, step) {
        let x = r * angle;
        let w = drive.force(x) / machine.bed_mass;
        square = lead_section(square, last.deceleration, w, angle - last.angle, r);
        let speed =
            if square > 0.0 { NodeSpeed::Omega(square.sqrt()) } else { NodeSpeed::Negative { radicand: square } };
        last = SectionEnd { phase: Phase::Lead, angle, x, deceleration: w, speed };
        nodes.push(last);
        if !(square > 0.0) {
            return nodes;
        }
    }
    last.angle = 0.0;
    for angle in ends(FRAC_PI_2, step) {
        let x = r * lead + r * libm::sin(angle);
        let w = drive.force(x) / machine.bed_mass;
        square = crank_section(square, last.deceleration, w, last.angle, angle, r);
        let speed = if square < 0.0 {
            NodeSpeed::Negative { radicand: square }
        } else if angle == FRAC_PI_2 {
            NodeSpeed::Unbounded { radicand: square }
        } else {
            NodeSpeed::Omega(square.sqrt() / libm::cos(angle))
        };
        last = SectionEnd { phase: Phase::Crank, angle, x, deceleration: w, speed };
        nodes.push(last);
        if !(square >= 0.0) {
            return nodes;
        }
    }
    nodes
}

/// The ends of sections of `step` over a phase, the phase's own end last; none for a phase without length or a step that is not
/// above 0.
fn ends(whole: f64, step: f64) -> impl Iterator<Item = f64> {
    // A billionth of a section is rounding of the number of sections.
    let count = if step > 0.0 && whole > 0.0 { (whole / step - 1e-9).ceil().max(1.0) } else { 0.0 };
    let mut section = 0.0;
    std::iter::from_fn(move || {
        if !(section < count) {
            return None;
        }
        section += 1.0;
        Some(if section < count { section * step } else { whole })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::press::buffer::drive::BufferedBed;

    fn reference() -> Drive {
        let machine = BufferedBed {
            bed_mass: 1255.2512,
            crank_radius: 0.18,
            lead_angle: 60.0_f64.to_radians(),
            bed_speed: 1.6,
            column: 0.485,
            ambient_pressure: 98_066.5,
            exponent: 1.3,
        };
        Drive::by_closing(machine).expect("closes")
    }

    fn omega(nodes: &[SectionEnd], phase: Phase, degrees: f64) -> f64 {
        let near = |node: &&SectionEnd| node.phase == phase && (node.angle - degrees.to_radians()).abs() < 1e-9;
        nodes.iter().find(near).and_then(|node| node.speed.omega()).expect("a node with a speed")
    }

    #[test]
    fn golden_numbers() {
        let nodes = sections(&reference(), 10.0_f64.to_radians());
        assert_eq!(nodes.len(), 16);
        // To the digits given.
        assert!((omega(&nodes, Phase::Lead, 60.0) - 8.244_408_655_204_7).abs() < 2e-13);
        assert!((omega(&nodes, Phase::Crank, 30.0) - 7.994_830_524).abs() < 5.1e-10);
        let NodeSpeed::Negative { radicand } = nodes[15].speed else { panic!("{:?}", nodes[15]) };
        assert!((radicand + 0.183_469_69).abs() < 5.1e-9, "{radicand}");
        let exact =
            |phase: Phase, degrees: f64| reference().at_phase(phase, degrees.to_radians()).expect("moves").omega;
        let error = |phase: Phase, degrees: f64| 100.0 * (omega(&nodes, phase, degrees) / exact(phase, degrees) - 1.0);
        assert!((error(Phase::Lead, 60.0) + 0.054).abs() < 5.1e-4);
        assert!((error(Phase::Crank, 30.0) + 0.18).abs() < 5.1e-3);
        assert!((error(Phase::Crank, 80.0) + 4.4).abs() < 0.051);
    }

    /// Second order: a step of half the size leaves a quarter of the error.
    #[test]
    fn its_order_is_two() {
        let drive = reference();
        let error = |step: f64, phase: Phase, degrees: f64| {
            let exact = drive.at_phase(phase, degrees.to_radians()).expect("moves").omega;
            100.0 * (omega(&sections(&drive, step.to_radians()), phase, degrees) / exact - 1.0)
        };
        for (step, percent, digits) in [(10.0, -0.0543, 5.1e-5), (5.0, -0.0136, 5.1e-5), (1.0, -0.000_54, 5.1e-6)] {
            assert!((error(step, Phase::Lead, 60.0) - percent).abs() < digits, "{step}°");
        }
        for (phase, degrees) in [(Phase::Lead, 60.0), (Phase::Crank, 40.0), (Phase::Crank, 80.0)] {
            let order = libm::log2(error(1.0, phase, degrees) / error(0.5, phase, degrees));
            assert!((order - 2.0).abs() < 0.01, "{phase:?} {degrees}°: {order}");
        }
    }

    /// (12) from 8.8889 rad/s with the decelerations as printed, in cm and with the printed factor 0.0194.
    #[test]
    fn the_paper_s_table_by_its_own_formula() {
        let printed = [0.0, 23.4, 50.7, 82.0, 122.5, 171.0, 232.0];
        let chain = [8.8761, 8.8356, 8.7624, 8.6485, 8.4824, 8.2489];
        let mut square = (160.0_f64 / 18.0) * (160.0 / 18.0);
        for (pair, omega) in printed.windows(2).zip(chain) {
            square = lead_section(square, pair[0], pair[1], 10.0_f64.to_radians(), 18.0);
            assert!((square.sqrt() - omega).abs() < 5.1e-5, "{} is not {omega}", square.sqrt());
        }
        assert!((2.0 * 10.0_f64.to_radians() / 18.0 - 0.0194).abs() < 5.1e-5);
    }

    /// A last section that is shorter, none without lead, a machine that stops in phase 1, and a step that is none.
    #[test]
    fn sections_end_where_the_phases_do() {
        let drive = reference();
        let nodes = sections(&drive, 0.4);
        let last = |phase: Phase| nodes.iter().rfind(|node| node.phase == phase).expect("a node").angle;
        assert_eq!((last(Phase::Lead), last(Phase::Crank)), (drive.machine.lead_angle, FRAC_PI_2));
        assert_eq!(nodes.len(), 1 + 3 + 4);
        let direct = Drive::by_closing(BufferedBed { lead_angle: 0.0, ..drive.machine }).expect("closes");
        assert_eq!(sections(&direct, 0.4).len(), 1 + 4);
        let hard = Drive::open(drive.machine, 1.0).expect("inputs have a meaning");
        let stopped = sections(&hard, 0.1);
        assert!(matches!(stopped[stopped.len() - 1].speed, NodeSpeed::Negative { radicand } if radicand < 0.0));
        let weak = Drive::open(drive.machine, 0.9 * drive.piston_area).expect("inputs have a meaning");
        let past = sections(&weak, 0.1);
        assert!(matches!(past[past.len() - 1].speed, NodeSpeed::Unbounded { radicand } if radicand > 0.0));
        assert_eq!(sections(&drive, 0.0).len(), 1);
        assert_eq!(sections(&drive, f64::NAN).len(), 1);
    }
}
