//! The conoid: one cam for many speeds, shifted along its axis as the speed changes.
//!
//! The law is interpolated along the axis: s(θ, z) = Σ wⱼ(z) sⱼ(θ), sⱼ the lift of section j and wⱼ the cardinal
//! not-a-knot splines, so that all derivatives in both directions are exact. The roller is crowned, a sphere of radius
//! r: the surface of the cam is the offset of the pitch surface in space. With the roller's path û, its normal n̂, height
//! u = √(R_p² − ε²) + s, a = s_θ − ε, ℓ = √(a² + u²), cos α = u/ℓ and τ = s_z cos α:
//!
//! ```text
//! P = (u û + ε n̂, z),   N = (n, −τ)/√(1+τ²),   contact = P − r N = (C − r n/√(1+τ²), z + r τ/√(1+τ²))
//! ```
//!
//! n the normal of the plane pitch curve. A cut at z₀ is touched by the rollers at ζ(θ) with ζ + r τ/√(1+τ²) = z₀; its
//! tangent is that of the plane pitch curve at ζ, since the section of a surface lies across its normal.

mod surface;
mod worst;

pub use surface::SpatialContact;
pub use worst::{Measures, Worst};

use super::Curves;
use super::rotary::round_up;
use super::size::{self, Required};
use crate::buffer::Cylinder;
use crate::buffer::balance::{Balance, Column, column_for};
use crate::follower::TranslatingRoller;
use crate::law::{Jet, Law, LawError, Piece, Reversal, ReversalLaw};
use crate::machine::{ConoidData, ConoidMode, Machine, Shift};
use crate::numeric::spline::Spline;
use rayon::prelude::*;

/// Slices between two sections at which the surface is searched for its worst places.
const SLICES: u32 = 6;
/// Least distance of two sections over the axial travel: nearer, the splines along the axis multiply their roundings.
const LEAST_DISTANCE: f64 = 1e-3;
/// Halvings of the last growth: to a micrometre of a metre.
const BISECTIONS: u32 = 14;
/// Growth of the prime radius while the surface is too sharp along its axis, and how often it is tried.
const GROWTH: f64 = 1.01;
const GROWTHS: usize = 700;

/// Lift and its derivatives: `[m][n]` by θ m times and by z n times, up to order three in all.
pub type Partials = [[f64; 4]; 4];

/// How the law is interpolated between sections.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Interpolation {
    /// Not-a-knot cubic splines along the axis.
    Smooth,
    /// Straight strips from section to section, for comparison.
    Straight,
}

/// A cam for many speeds.
#[derive(Debug, Clone)]
pub struct Conoid {
    /// The machine it is for.
    pub machine: Machine,
    /// What the machine file tells of the conoid.
    pub data: ConoidData,
    /// The pair of cylinders.
    pub cylinder: Cylinder,
    /// Speeds of the main shaft, one for each section, rpm, rising.
    pub speeds: Vec<f64>,
    /// Place of each section along the axis, m.
    pub positions: Vec<f64>,
    /// Law of each section.
    pub sections: Vec<Reversal>,
    /// The follower, its prime radius common to all sections.
    pub follower: TranslatingRoller,
    /// Smallest prime radius that keeps every limit over the whole surface, m.
    pub smallest_prime_radius: Option<f64>,
    weights: Vec<Spline>,
    /// Δx at lift 0: the least of all sections, m.
    lowest: f64,
}

/// Why there is no conoid.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ConoidError {
    /// The machine file does not describe one.
    #[error("the machine file has no [conoid] table: a conoid needs axial_travel, mode and shift")]
    NotDescribed,
    /// Two sections would lie in one plane.
    #[error("the speed {rpm} is asked for twice among others; a section has one place along the axis")]
    Twice {
        /// The speed, rpm.
        rpm: f64,
    },
    /// Two sections would lie nearly in one plane.
    #[error(
        "the speeds {first} and {second} are too near to each other: their sections would lie {apart_mm:e} mm apart"
    )]
    TooNear {
        /// The slower, rpm.
        first: f64,
        /// The faster, rpm.
        second: f64,
        /// Their distance along the axis, mm.
        apart_mm: f64,
    },
    /// No speed at all.
    #[error("a conoid needs a speed")]
    NoSpeed,
    /// The motion does not go together.
    #[error("{0}; see transition.width, buffer.lead and cam.cam_turns_per_crank_turn")]
    Law(#[from] LawError),
    /// `auto` found nothing.
    #[error(
        "{0}: relax limits.pressure_angle or limits.min_convex_pitch_radius_over_roller, make conoid.axial_travel longer \
         (the surface may be too sharp along the axis), or give cam.base_radius"
    )]
    Size(#[from] size::NoRadius),
}

/// The law of a machine at a speed of a conoid.
#[must_use]
pub fn balance_at(machine: &Machine, data: &ConoidData, rpm: f64) -> Balance {
    let cylinder = machine.cylinder();
    let (k, r, lead) = (machine.polytropic_exponent, machine.bed.crank_radius, machine.lead);
    let with = |rpm: f64, column: Column| Balance::new(cylinder.loading(rpm), k, r, column, lead);
    let design = with(machine.design_rpm, machine.column);
    if rpm == machine.design_rpm {
        return design;
    }
    match data.mode {
        ConoidMode::Fixed => with(rpm, Column::Length(design.column)),
        // (14): the column is reset by its screw so that every section ends where the design does.
        ConoidMode::Adjusted => {
            let shortening = r + lead + design.displacement(r);
            with(rpm, Column::Length(column_for(shortening, cylinder.loading(rpm) * r, k)))
        }
    }
}

impl Conoid {
    /// Solves the sections and sizes the cam.
    ///
    /// # Errors
    /// [`ConoidError`] when the machine has no conoid, the speeds make none, or no radius keeps the limits.
    pub fn solve(machine: &Machine, speeds: &[f64]) -> Result<Self, ConoidError> {
        let mut conoid = Self::unsized_of(machine, speeds)?;
        let (roller, limits) = (machine.roller, machine.limits);
        let least_base = machine.cam.bore_reach().map_or(1e-3, |reach| reach + limits.wall);
        let required = Required {
            pressure_angle: limits.pressure_angle,
            convex_pitch_radius: limits.min_convex_pitch_radius_over_roller.max(1.0) * roller.radius,
            least: (least_base + roller.radius).max(roller.offset.abs() * (1.0 + 1e-6)),
        };
        let smallest = conoid.size(&required);
        let base = match machine.cam.base_radius {
            Some(base) => base,
            None => round_up(smallest? - roller.radius),
        };
        conoid.smallest_prime_radius = smallest.ok();
        conoid.follower = conoid.follower_at(base + roller.radius);
        Ok(conoid)
    }

    /// The laws of the sections and their interpolation, on a prime radius of a metre.
    ///
    /// # Errors
    /// [`ConoidError`] when the machine has no conoid or the speeds make none.
    pub fn unsized_of(machine: &Machine, speeds: &[f64]) -> Result<Self, ConoidError> {
        let data = machine.conoid.ok_or(ConoidError::NotDescribed)?;
        let mut speeds = speeds.to_vec();
        speeds.sort_by(f64::total_cmp);
        let (Some(&first), Some(&last)) = (speeds.first(), speeds.last()) else { return Err(ConoidError::NoSpeed) };
        if speeds.len() == 1 {
            speeds.push(first);
        }
        if first < last
            && let Some([rpm, _]) = speeds.windows(2).find(|pair| matches!(pair, [a, b] if a == b))
        {
            return Err(ConoidError::Twice { rpm: *rpm });
        }
        let law = |rpm: &f64| {
            Reversal::new(ReversalLaw {
                balance: balance_at(machine, &data, *rpm),
                lever: machine.cam.lever,
                ratio: machine.cam.turns_per_crank_turn,
                transition: machine.transition,
            })
        };
        let sections: Result<Vec<Reversal>, LawError> = speeds.iter().map(law).collect();
        let sections = sections?;
        let positions = if first < last {
            speeds.iter().map(|rpm| position(&data, (first, last), *rpm)).collect()
        } else {
            // Equal speeds: a prism, its sections evenly spaced.
            #[expect(clippy::cast_precision_loss, reason = "a few sections")]
            let place = |index: usize| data.axial_travel * index as f64 / (speeds.len() - 1) as f64;
            (0..speeds.len()).map(place).collect::<Vec<f64>>()
        };
        let pairs = positions.iter().zip(positions.iter().skip(1)).zip(speeds.iter().zip(speeds.iter().skip(1)));
        for ((a, b), (first, second)) in pairs {
            if b - a < LEAST_DISTANCE * data.axial_travel {
                return Err(ConoidError::TooNear { first: *first, second: *second, apart_mm: 1e3 * (b - a) });
            }
        }
        let unit = |index: usize| {
            let values: Vec<f64> = (0..speeds.len()).map(|other| f64::from(u8::from(other == index))).collect();
            Spline::not_a_knot(&positions, &values)
        };
        let weights = (0..speeds.len()).map(unit).collect();
        let lowest = sections.iter().map(Reversal::lowest).fold(f64::INFINITY, f64::min);
        let roller = machine.roller;
        Ok(Self {
            machine: machine.clone(),
            data,
            cylinder: machine.cylinder(),
            speeds,
            positions,
            sections,
            follower: TranslatingRoller::new(1.0, roller.offset, roller.radius),
            smallest_prime_radius: None,
            weights,
            lowest,
        })
    }

    fn follower_at(&self, prime_radius: f64) -> TranslatingRoller {
        TranslatingRoller::new(prime_radius, self.machine.roller.offset, self.machine.roller.radius)
    }

    /// The smallest prime radius that keeps the limits in every slice, and the curvature across them.
    fn size(&mut self, required: &Required) -> Result<f64, size::NoRadius> {
        let of_slice = |z: &f64| {
            let slice = self.slice(*z);
            size::smallest_prime_radius(&slice, |radius| self.follower_at(radius), required)
        };
        let radii: Result<Vec<f64>, _> = self.slices().par_iter().map(of_slice).collect();
        let mut radius = radii?.into_iter().fold(required.least, f64::max);
        let keeps = |conoid: &mut Self, radius: f64| {
            conoid.follower = conoid.follower_at(radius);
            conoid.sharpest().value * required.convex_pitch_radius <= 1.0 + 1e-9
        };
        if !keeps(self, radius) {
            let mut failing = radius;
            let grown = (0..GROWTHS).find_map(|_| {
                (failing, radius) = (radius, radius * GROWTH);
                keeps(self, radius).then_some(radius)
            });
            let mut passing = grown.ok_or(size::NoRadius)?;
            for _ in 0..BISECTIONS {
                let middle = 0.5 * (failing + passing);
                if keeps(self, middle) { passing = middle } else { failing = middle }
            }
            radius = passing;
        }
        // A flank that leans can reach nearer to the axis than the base radius.
        self.follower = self.follower_at(radius);
        let wall = required.least - self.machine.roller.radius - self.smallest_radius().value;
        Ok(if wall > 0.0 { radius + wall } else { radius })
    }

    /// Ends of the cam along its axis, m.
    #[must_use]
    pub fn ends(&self) -> (f64, f64) {
        (0.0 - self.data.overhang, self.data.axial_travel + self.data.overhang)
    }

    /// Base radius R_b, m.
    #[must_use]
    pub fn base_radius(&self) -> f64 {
        self.follower.prime_radius() - self.machine.roller.radius
    }

    /// Place along the axis for a speed, m.
    #[must_use]
    pub fn position(&self, rpm: f64) -> f64 {
        match (self.speeds.first(), self.speeds.last()) {
            (Some(first), Some(last)) if first < last => position(&self.data, (*first, *last), rpm),
            _ => 0.0,
        }
    }

    /// Δx at lift 0, m.
    #[must_use]
    pub fn lowest(&self) -> f64 {
        self.lowest
    }

    /// The pieces of a turn, the same for every section.
    #[must_use]
    pub fn pieces(&self) -> &[Piece] {
        self.sections.first().map_or(&[], |section| section.pieces())
    }

    /// Weights of the sections at z and their first three derivatives.
    fn weights_at(&self, z: f64) -> Vec<[f64; 4]> {
        self.weights.iter().map(|weight| weight.at(z)).collect()
    }

    /// Lifts of the sections at a cam angle, counted from the common lowest point.
    fn lifts(&self, piece: usize, angle: f64) -> Vec<Jet> {
        let lift = |section: &Reversal| {
            let bottom = section.bottom(piece, angle);
            Jet { s: bottom.s - self.lowest, ..bottom }.scaled(self.machine.cam.lever)
        };
        self.sections.iter().map(lift).collect()
    }

    fn partials(&self, lifts: &[Jet], z: f64) -> Partials {
        let mut partials = [[0.0; 4]; 4];
        for (lift, weight) in lifts.iter().zip(&self.weights) {
            let weight = weight.at(z);
            for (row, derivative) in partials.iter_mut().zip([lift.s, lift.ds, lift.dds, lift.ddds]) {
                for (slot, w) in row.iter_mut().zip(weight) {
                    *slot += w * derivative;
                }
            }
        }
        partials
    }

    /// Lift at a cam angle of a piece and a place along the axis (m), with its derivatives.
    #[must_use]
    pub fn lift(&self, piece: usize, angle: f64, z: f64) -> Partials {
        self.partials(&self.lifts(piece, angle), z)
    }

    /// Δx of the bottom, m, when a section z (m) of the surface is under the roller.
    #[must_use]
    pub fn displacement(&self, piece: usize, angle: f64, z: f64, interpolation: Interpolation) -> f64 {
        let bottoms = self.sections.iter().map(|section| section.bottom(piece, angle).s);
        match interpolation {
            Interpolation::Smooth => bottoms.zip(self.weights_at(z)).map(|(bottom, weight)| bottom * weight[0]).sum(),
            Interpolation::Straight => {
                let bottoms: Vec<f64> = bottoms.collect();
                let right = self.positions.partition_point(|place| *place <= z).clamp(1, self.positions.len() - 1);
                let at = |list: &[f64], index: usize| list.get(index).copied().unwrap_or(f64::NAN);
                let (a, b) = (at(&self.positions, right - 1), at(&self.positions, right));
                let share = (z - a) / (b - a);
                at(&bottoms, right - 1) * (1.0 - share) + at(&bottoms, right) * share
            }
        }
    }

    /// The law in one plane across the axis.
    #[must_use]
    pub fn slice(&self, z: f64) -> Slice<'_> {
        Slice { conoid: self, weights: self.weights_at(z).into_iter().map(|weight| weight[0]).collect() }
    }

    /// The curves of one plane, as if the roller were a disc in it.
    #[must_use]
    pub fn plane(&self, z: f64) -> Curves<Slice<'_>, TranslatingRoller> {
        Curves { law: self.slice(z), follower: self.follower }
    }

    /// Force between roller and cam along the roller's path at the speed of a section, N: the air's, and preload and
    /// inertia where they are given.
    #[must_use]
    pub fn roller_force(&self, section: &Reversal, rpm: f64, piece: usize, angle: f64) -> f64 {
        let air = self.cylinder.force(section.state(piece, angle).pressure_ratio) / self.machine.cam.lever;
        let inertia = self.machine.roller.mass.map_or(0.0, |mass| {
            let speed = self.machine.bed.crank_speed(rpm) * self.machine.cam.turns_per_crank_turn;
            mass * speed * speed * self.machine.cam.lever * section.bottom(piece, angle).dds
        });
        air + inertia + self.machine.roller.preload.unwrap_or(0.0)
    }
}

/// The law in one plane across the axis.
#[derive(Debug, Clone)]
pub struct Slice<'a> {
    conoid: &'a Conoid,
    weights: Vec<f64>,
}

impl Law for Slice<'_> {
    fn pieces(&self) -> &[Piece] {
        self.conoid.pieces()
    }

    fn jet(&self, piece: usize, angle: f64) -> Jet {
        let lifts = self.conoid.lifts(piece, angle);
        lifts.iter().zip(&self.weights).fold(Jet::default(), |sum, (lift, weight)| Jet {
            s: sum.s + weight * lift.s,
            ds: sum.ds + weight * lift.ds,
            dds: sum.dds + weight * lift.dds,
            ddds: sum.ddds + weight * lift.ddds,
        })
    }
}

/// z(n) between the slowest and the fastest speed.
fn position(data: &ConoidData, (first, last): (f64, f64), rpm: f64) -> f64 {
    let share = match data.shift {
        Shift::Linear => (rpm - first) / (last - first),
        Shift::Square => (rpm - first) * (rpm + first) / ((last - first) * (last + first)),
    };
    data.axial_travel * share
}

#[cfg(test)]
mod tests;
