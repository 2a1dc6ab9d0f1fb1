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

use super::rotary::round_up;
use super::size::{self, Required};
use super::{Curves, Frame, extremes};
use crate::buffer::Cylinder;
use crate::buffer::balance::{Balance, Column, column_for};
use crate::follower::TranslatingRoller;
use crate::law::{Jet, Law, LawError, Piece, Reversal, ReversalLaw};
use crate::machine::{ConoidData, ConoidMode, Machine, Shift};
use crate::numeric::series::Series;
use crate::numeric::spline::Spline;
use nalgebra::{Vector2, Vector3};
use rayon::prelude::*;

/// Slices between two sections at which the surface is searched for its worst places.
const SLICES: u32 = 6;
/// Newton steps to the roller that touches a cut.
const CUT_STEPS: usize = 20;
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

    /// Places along the axis at which the roller may stand and the surface is looked at, m: the sections and some between
    /// them.
    #[must_use]
    pub fn slices(&self) -> Vec<f64> {
        let pairs = self.positions.iter().zip(self.positions.iter().skip(1));
        let between = pairs.flat_map(|(a, b)| (0..SLICES).map(move |i| a + (b - a) * f64::from(i) / f64::from(SLICES)));
        between.chain(self.positions.last().copied()).collect()
    }

    /// The same with the ends of the cam.
    fn slices_and_ends(&self) -> Vec<f64> {
        let (low, high) = self.ends();
        let mut all = self.slices();
        all.extend([low, high]);
        all.sort_by(f64::total_cmp);
        all.dedup();
        all
    }

    /// The same with places as far beyond the ends as the contact wanders: spheres there make the metal at the ends, though
    /// no roller ever stands there.
    fn slices_of_metal(&self) -> Vec<f64> {
        let mut all = self.slices_and_ends();
        let wander =
            self.worst_of(&all, |conoid, piece, angle, z| conoid.wander(&conoid.lift(piece, angle, z)).0.abs());
        let ((low, high), reach) = (self.ends(), wander.value);
        if reach > 0.0 {
            all.extend([low - reach, low - 0.5 * reach, high + 0.5 * reach, high + reach]);
        }
        all
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

    /// Where the sphere at a cam angle and a place along the axis touches, m: its centre, the unit normal out of the
    /// metal, the point of contact.
    #[must_use]
    pub fn contact(&self, piece: usize, angle: f64, z: f64) -> SpatialContact {
        let partials = self.lift(piece, angle, z);
        let (u, a) = self.height_and_slope(&partials);
        let axes = Axes::new(angle);
        let length = libm::hypot(a, u);
        let normal = axes.along * (u / length) - axes.across * (a / length);
        let taper = partials[0][1] * u / length;
        let stretch = (1.0 + taper * taper).sqrt();
        let centre = axes.along * u + axes.across * self.machine.roller.offset;
        let normal = Vector3::new(normal.x, normal.y, -taper) / stretch;
        let centre = Vector3::new(centre.x, centre.y, z);
        SpatialContact { centre, normal, point: centre - normal * self.machine.roller.radius, slope: partials[0][1] }
    }

    fn height_and_slope(&self, partials: &Partials) -> (f64, f64) {
        let (offset, prime) = (self.machine.roller.offset, self.follower.prime_radius());
        (((prime - offset) * (prime + offset)).sqrt() + partials[0][0], partials[1][0] - offset)
    }

    /// Largest and smallest principal curvature of the pitch surface, 1/m, convex positive.
    #[must_use]
    pub fn principal_curvatures(&self, piece: usize, angle: f64, z: f64) -> (f64, f64) {
        let p = self.lift(piece, angle, z);
        let offset = self.machine.roller.offset;
        let (u, a) = self.height_and_slope(&p);
        // In the basis along, across, axis.
        let normal = Vector3::new(u, -a, -u * p[0][1]);
        let by_angle = Vector3::new(a, u, 0.0);
        let by_axis = Vector3::new(p[0][1], 0.0, 1.0);
        let second = [
            Vector3::new(p[2][0] - u, 2.0 * p[1][0] - offset, 0.0),
            Vector3::new(p[1][1], p[0][1], 0.0),
            Vector3::new(p[0][2], 0.0, 0.0),
        ];
        let size = normal.norm();
        let [l, m, n] = second.map(|vector| -vector.dot(&normal) / size);
        let (e, f, g) = (by_angle.norm_squared(), by_angle.dot(&by_axis), by_axis.norm_squared());
        let area = e * g - f * f;
        let mean = 0.5 * (e * n - 2.0 * f * m + g * l) / area;
        let gauss = (l * n - m * m) / area;
        let apart = (mean * mean - gauss).max(0.0).sqrt();
        (mean + apart, mean - apart)
    }

    /// The sharpest convex place of the pitch surface: the curvature, 1/m.
    #[must_use]
    pub fn sharpest(&self) -> Worst {
        self.worst_of_metal(|conoid, piece, angle, z| conoid.principal_curvatures(piece, angle, z).0)
    }

    /// The largest value of something over all spheres that make the metal.
    #[must_use]
    pub fn worst_of_metal(&self, value: impl Fn(&Self, usize, f64, f64) -> f64 + Sync) -> Worst {
        self.worst_of(&self.slices_of_metal(), value)
    }

    /// The largest value of something over the surface: over every turn of the slices.
    #[must_use]
    pub fn worst(&self, value: impl Fn(&Self, usize, f64, f64) -> f64 + Sync) -> Worst {
        self.worst_of(&self.slices(), value)
    }

    fn worst_of(&self, slices: &[f64], value: impl Fn(&Self, usize, f64, f64) -> f64 + Sync) -> Worst {
        let in_slice = |z: &f64| {
            let plane = self.plane(*z);
            let found = extremes::largest_without_slope(&plane, |piece, angle| value(self, piece, angle, *z));
            Worst { value: found.value, angle: found.at, z: *z }
        };
        let all: Vec<Worst> = slices.par_iter().map(in_slice).collect();
        let none = Worst { value: f64::NEG_INFINITY, angle: 0.0, z: 0.0 };
        all.into_iter().fold(none, |best, next| if next.value > best.value { next } else { best })
    }

    /// The cut of the cam at z (m) where the roller at a cam angle of a piece touches it: a point of the section with
    /// its tangent and curvature, parametrised by the cam angle, and the place ζ of that roller. `None` where the
    /// surface folds along the axis.
    #[must_use]
    pub fn cut(&self, piece: usize, angle: f64, z: f64) -> Option<(Frame, f64)> {
        let lifts = self.lifts(piece, angle);
        let mut zeta = z;
        for _ in 0..CUT_STEPS {
            let (wander, slope) = self.wander(&self.partials(&lifts, zeta));
            // A surface that folds back along the axis has no single roller for the cut.
            if !(1.0 + slope > 0.0) {
                return None;
            }
            let step = (zeta + wander - z) / (1.0 + slope);
            zeta -= step;
            if step.abs() <= 1e-15 * (1.0 + z.abs()) {
                break;
            }
        }
        let partials = self.partials(&lifts, zeta);
        let axial = |first: f64, second: f64| self.along(&partials, angle, Series([zeta, first, second])).axial.0;
        // Each coefficient of ζ enters the coefficient of its power linearly.
        let (without, with) = (axial(0.0, 0.0)[1], axial(1.0, 0.0)[1]);
        let first = -without / (with - without);
        let (without, with) = (axial(first, 0.0)[2], axial(first, 1.0)[2]);
        let second = -without / (with - without);
        let along = self.along(&partials, angle, Series([zeta, first, second]));
        let [heading, turn, turn2] = along.heading.0;
        let [speed, speed1, _] = along.speed.0;
        let tangent = Vector2::new(libm::cos(heading), libm::sin(heading));
        let axes = Axes::new(angle);
        let centre = axes.along * along.height + axes.across * self.machine.roller.offset;
        let outward = Vector2::new(tangent.y, -tangent.x);
        let frame = Frame {
            point: centre - outward * along.reach,
            tangent,
            speed,
            curvature: turn / speed,
            curvature_slope: (2.0 * turn2 * speed - turn * speed1) / (speed * speed * speed),
        };
        Some((frame, zeta))
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

    /// The largest and the smallest of something over the turns of the sections, each at its own speed.
    #[must_use]
    pub fn worst_of_sections(&self, value: impl Fn(&Reversal, f64, f64, usize, f64) -> f64 + Sync) -> Worst {
        let of_section = |((section, rpm), z): ((&Reversal, &f64), &f64)| {
            let plane = self.plane(*z);
            let found = extremes::largest_without_slope(&plane, |piece, angle| value(section, *rpm, *z, piece, angle));
            Worst { value: found.value, angle: found.at, z: *z }
        };
        let all = self.sections.iter().zip(&self.speeds).zip(&self.positions).map(of_section);
        let none = Worst { value: f64::NEG_INFINITY, angle: 0.0, z: 0.0 };
        all.fold(none, |best, next| if next.value > best.value { next } else { best })
    }

    /// The axial component of the contact force that the drive of the shift must hold, N: the force along the path times
    /// the slope of the lift along the axis.
    #[must_use]
    pub fn axial_force(&self) -> Worst {
        self.worst_of_sections(|section, rpm, z, piece, angle| {
            (self.roller_force(section, rpm, piece, angle) * self.lift(piece, angle, z)[0][1]).abs()
        })
    }

    /// Largest lift over all sections, m.
    #[must_use]
    pub fn max_lift(&self) -> f64 {
        let highest = self.worst_of_sections(|section, _, _, piece, angle| section.bottom(piece, angle).s).value;
        (highest - self.lowest) * self.machine.cam.lever
    }

    /// By how much the plane offset of the pitch curve at z misses the cut there, m: from a point of the one along the
    /// normal of the other, its foot found by Newton's method.
    #[must_use]
    pub fn plane_offset_error(&self, z: f64) -> f64 {
        let plane = self.plane(z);
        let miss = |piece: usize, angle: f64| {
            let naive = plane.profile(piece, angle).point;
            let Some(span) = self.pieces().get(piece) else { return f64::NAN };
            let mut foot = angle;
            let mut left = f64::NAN;
            for _ in 0..4 {
                let Some((cut, _)) = self.cut(piece, foot, z) else { return f64::NAN };
                let away = naive - cut.point;
                left = away.dot(&cut.outward());
                foot = (foot + away.dot(&cut.tangent) / cut.speed).clamp(span.start, span.end);
            }
            left.abs()
        };
        extremes::largest_without_slope(&plane, miss).value
    }

    /// What follows from the lift along θ ↦ (θ, ζ(θ)), as series in θ.
    fn along(&self, p: &Partials, angle: f64, zeta: Series) -> Along {
        let [_, z1, z2] = zeta.0;
        let compose = |m: usize, n: usize| {
            let at = |m: usize, n: usize| p.get(m).and_then(|row| row.get(n)).copied().unwrap_or(0.0);
            Series([
                at(m, n),
                at(m + 1, n) + at(m, n + 1) * z1,
                0.5 * (at(m + 2, n) + 2.0 * at(m + 1, n + 1) * z1 + at(m, n + 2) * z1 * z1) + at(m, n + 1) * z2,
            ])
        };
        let (radius, offset) = (self.machine.roller.radius, self.machine.roller.offset);
        let (height, _) = self.height_and_slope(p);
        let (u, a, slope) = (
            compose(0, 0) + Series::constant(height - p[0][0]),
            compose(1, 0) - Series::constant(offset),
            compose(0, 1),
        );
        let length = (a * a + u * u).sqrt();
        let taper = slope * u / length;
        let stretch = (Series::constant(1.0) + taper * taper).sqrt();
        let axial = zeta + taper * radius / stretch;
        let heading = u.atan2(a) + Series([angle, 1.0, 0.0]);
        let reach = Series::constant(radius) / stretch;
        let speed = length + slope * zeta.slope() * a / length - reach * heading.slope();
        Along { axial, heading, speed, reach: reach.0[0], height: u.0[0] }
    }

    /// How far the contact lies from the roller's plane along the axis, r τ/√(1+τ²), m, and its derivative by z.
    fn wander(&self, p: &Partials) -> (f64, f64) {
        let (u, a) = self.height_and_slope(p);
        let length = libm::hypot(a, u);
        let (s_z, s_zz, a_z) = (p[0][1], p[0][2], p[1][1]);
        let taper = s_z * u / length;
        let by_axis = s_zz * u / length + s_z * (s_z / length - u * (a * a_z + u * s_z) / (length * length * length));
        let stretch = (1.0 + taper * taper).sqrt();
        let radius = self.machine.roller.radius;
        (radius * taper / stretch, radius * by_axis / (stretch * stretch * stretch))
    }

    /// Largest distance of the contact from the roller's plane along the axis, m.
    #[must_use]
    pub fn largest_wander(&self) -> Worst {
        let within = self.slices();
        self.worst_of(&within, |conoid, piece, angle, z| conoid.wander(&conoid.lift(piece, angle, z)).0.abs())
    }

    /// The smallest radius of the cam about its axis, m, and where it is.
    #[must_use]
    pub fn smallest_radius(&self) -> Worst {
        let within = self.slices_and_ends();
        let worst = self.worst_of(&within, |conoid, piece, angle, z| {
            conoid.cut(piece, angle, z).map_or(0.0, |(frame, _)| -frame.point.norm())
        });
        Worst { value: -worst.value, ..worst }
    }
}

/// Series along a cut.
struct Along {
    axial: Series,
    heading: Series,
    speed: Series,
    reach: f64,
    height: f64,
}

/// Directions of the roller's path and across it.
struct Axes {
    along: Vector2<f64>,
    across: Vector2<f64>,
}

impl Axes {
    fn new(angle: f64) -> Self {
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        Self { along: Vector2::new(cos, sin), across: Vector2::new(-sin, cos) }
    }
}

/// The sphere on the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpatialContact {
    /// Centre of the sphere, m.
    pub centre: Vector3<f64>,
    /// Unit normal out of the metal.
    pub normal: Vector3<f64>,
    /// Point of contact, m.
    pub point: Vector3<f64>,
    /// Slope of the lift along the axis.
    pub slope: f64,
}

/// The worst place of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Worst {
    /// The value there.
    pub value: f64,
    /// Cam angle, rad.
    pub angle: f64,
    /// Place along the axis, m.
    pub z: f64,
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
mod tests {
    use super::*;
    use crate::cam::rotary::Rotary;

    fn conoid(speeds: &[f64], overrides: &[&str]) -> Conoid {
        let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
        Conoid::solve(&Machine::load("dpi", &overrides).expect("valid").0, speeds).expect("a conoid")
    }

    #[test]
    fn equal_speeds_are_the_rotary_cam() {
        let rotary = Rotary::solve(&Machine::load("dpi", &[]).expect("valid").0, 35.0).expect("a cam");
        for speeds in [&[35.0][..], &[35.0, 35.0, 35.0]] {
            let prism = conoid(speeds, &[]);
            assert_eq!(prism.base_radius(), rotary.base_radius());
            for (piece, span) in rotary.curves.law.pieces().iter().enumerate() {
                for i in 0..=12 {
                    let angle = span.start + (span.end - span.start) * f64::from(i) / 12.0;
                    let (cut, zeta) = prism.cut(piece, angle, 0.05).expect("smooth");
                    let exact = rotary.curves.profile(piece, angle);
                    assert!((cut.point - exact.point).norm() < 1e-15 && (zeta - 0.05).abs() < 1e-15);
                    assert!((cut.curvature / exact.curvature - 1.0).abs() < 1e-12);
                    let slope = (cut.curvature_slope - exact.curvature_slope).abs();
                    assert!(slope < 1e-9 * (1.0 + exact.curvature_slope.abs()), "{cut:?} {exact:?}");
                    let (sharp, blunt) = prism.principal_curvatures(piece, angle, 0.05);
                    let plane = rotary.curves.contact(piece, angle).pitch.curvature;
                    assert!((sharp - plane.max(0.0)).abs() < 1e-11 && (blunt - plane.min(0.0)).abs() < 1e-11);
                }
            }
        }
    }

    /// Two speeds: straight lines along the axis, so that the lift is known everywhere.
    #[test]
    fn two_speeds_are_a_ruled_surface() {
        let pair = conoid(&[20.0, 35.0], &["conoid.mode=fixed"]);
        for i in 0..=36 {
            let (piece, angle) = pair.slice(0.0).locate(f64::from(10 * i).to_radians());
            let [slow, fast] = [0, 1].map(|j| pair.sections[j].bottom(piece, angle).s - pair.lowest());
            for share in [0.0, 0.3, 1.0] {
                let z = 0.12 * share;
                let lift = pair.lift(piece, angle, z);
                assert!((lift[0][0] - (slow + (fast - slow) * share)).abs() < 1e-15);
                assert!((lift[0][1] - (fast - slow) / 0.12).abs() < 1e-14 && lift[0][2].abs() < 1e-12);
                let contact = pair.contact(piece, angle, z);
                assert!(((contact.point - contact.centre).norm() - 0.03).abs() < 1e-16);
            }
        }
    }

    /// A cut is where the spheres touch it, has the derivatives it says it has, and lies across the normal.
    #[test]
    fn a_cut_has_its_derivatives() {
        let h = 1e-4;
        for overrides in
            [vec![], vec!["follower.roller.offset=20mm", "conoid.shift=square", "conoid.axial_travel=60mm"]]
        {
            let cam = conoid(&[20.0, 25.0, 30.0, 35.0], &overrides);
            for (piece, span) in cam.pieces().iter().enumerate() {
                for i in 1..12 {
                    let angle = span.start + (span.end - span.start) * f64::from(i) / 12.0;
                    for z in [0.0, 0.013, 0.033, 0.06] {
                        let cut = |n: f64| cam.cut(piece, angle + n * h, z).expect("smooth").0;
                        let (here, zeta) = cam.cut(piece, angle, z).expect("smooth");
                        let contact = cam.contact(piece, angle, zeta);
                        assert!((contact.point.z - z).abs() < 1e-15);
                        assert!((contact.point.xy() - here.point).norm() < 1e-15);
                        assert!(here.tangent.dot(&contact.normal.xy()).abs() < 1e-14);
                        let first = ((cut(1.0).point - cut(-1.0).point) * 8.0 - (cut(2.0).point - cut(-2.0).point))
                            / (12.0 * h);
                        assert!((first - here.tangent * here.speed).norm() < 1e-10, "{angle} {z}: {first} {here:?}");
                        let turn = |n: f64| here.tangent.perp(&cut(n).tangent);
                        let bend =
                            (8.0 * (turn(1.0) - turn(-1.0)) - (turn(2.0) - turn(-2.0))) / (12.0 * h * here.speed);
                        assert!((bend - here.curvature).abs() < 1e-8, "{angle} {z}: {bend} {here:?}");
                        let k = |n: f64| cut(n).curvature;
                        let slope = (8.0 * (k(1.0) - k(-1.0)) - (k(2.0) - k(-2.0))) / (12.0 * h * here.speed);
                        assert!((slope - here.curvature_slope).abs() < 1e-5 * (1.0 + slope.abs()), "{slope} {here:?}");
                    }
                }
            }
        }
    }

    /// Principal curvatures against the turn of the normal along the surface, by central differences.
    #[test]
    fn principal_curvatures_belong_to_the_surface() {
        let cam = conoid(&[20.0, 25.0, 30.0, 35.0], &["conoid.axial_travel=40mm"]);
        let h = 1e-5;
        for degrees in [5.0_f64, 60.0, 88.0, 130.0] {
            let (piece, angle) = cam.slice(0.0).locate(degrees.to_radians());
            let z = 0.017;
            let at = |a: f64, b: f64| cam.contact(piece, angle + a * h, z + b * h);
            let by = |f: fn(&SpatialContact) -> Vector3<f64>| {
                [(f(&at(1.0, 0.0)) - f(&at(-1.0, 0.0))) / (2.0 * h), (f(&at(0.0, 1.0)) - f(&at(0.0, -1.0))) / (2.0 * h)]
            };
            let ([pu, pv], [nu, nv]) = (by(|c| c.centre), by(|c| c.normal));
            let first = nalgebra::Matrix2::new(pu.dot(&pu), pu.dot(&pv), pu.dot(&pv), pv.dot(&pv));
            let second = nalgebra::Matrix2::new(pu.dot(&nu), pu.dot(&nv), pv.dot(&nu), pv.dot(&nv));
            let shape = first.try_inverse().expect("regular") * second;
            let (mean, gauss) = (0.5 * shape.trace(), shape.determinant());
            let apart = (mean * mean - gauss).sqrt();
            let (sharp, blunt) = cam.principal_curvatures(piece, angle, z);
            assert!(
                (sharp - mean - apart).abs() < 1e-5 && (blunt - mean + apart).abs() < 1e-5,
                "{degrees}: {sharp} {mean} {apart}"
            );
        }
    }

    #[test]
    fn the_adjusted_sections_end_where_the_design_does() {
        let cam = conoid(&[20.0, 25.0, 30.0, 35.0], &[]);
        for (section, slope) in cam.sections.iter().zip([0.694, 0.779, 0.881, 1.0]) {
            let end = section.law().balance.displacement(0.18);
            assert!((end + 0.082_42).abs() < 5e-6, "{end}");
            assert!((section.law().balance.start_slope + 1.0 - slope).abs() < 5e-4);
        }
        let fixed = conoid(&[20.0, 25.0, 30.0, 35.0], &["conoid.mode=fixed"]);
        for (section, slope) in fixed.sections.iter().zip([0.327, 0.510, 0.735, 1.0]) {
            assert!((section.law().balance.start_slope + 1.0 - slope).abs() < 5e-4);
        }
    }
}
