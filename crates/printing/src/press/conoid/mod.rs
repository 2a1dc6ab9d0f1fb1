//! The conoid, a three-dimensional cam (camoid): one cam for many speeds, shifted along its axis as the speed changes.
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
//! n the normal of the plane pitch curve. A cut at z₀ is touched by the rollers at ζ(θ) with ζ + r τ/√(1+τ²) = z₀; it
//! has the tangent of the plane pitch curve at ζ, since the section of a surface lies across its normal.

mod as_surface;
mod balance;
pub mod between;
pub mod checks;
mod figures;
pub mod flank;
mod implementation;
mod interpolation;
mod loaded;
mod mechanism;
mod missed;
mod report;
mod search;
mod sheet;
mod strips;
mod surface;
mod wheel;
mod worst;

pub use missed::FollowerOnSection;
pub use search::SurfacePlace;
pub use strips::{AllStrips, Cubics, Strips, StripsNear};

use crate::press::MachineOfPress;
use crate::press::buffer::Cylinder;
use crate::press::buffer::bottom_law::{ColumnRule, column_for};
use crate::press::buffer::crank_law::CrankLaw;
use crate::press::cams;
use crate::press::machine::PressCams;
use crate::press::machine::{ConoidData, ConoidMode, Press, Shift};
use crate::press::motion::{Reversal, ReversalLaw};
use crate::press::rotary::with_keys_of_motion;
use between::Residual;
use camgen_cams::body::size_limits;
use camgen_cams::body::{Figures, Kind};
use camgen_cams::machine::{Machine, RollerData};
use camgen_kernel::follower::{Follower, TranslatingRoller};
use camgen_kernel::motion::{Jet, Motion, Piece};
use camgen_kernel::numeric::parallel;
use camgen_kernel::profile::size::{self, NoRadius, SizeLimits, rounded_up};
use camgen_kernel::profile::{Curves, Worst};
use camgen_kernel::refusal::{Refusal, WorkBound};
use interpolation::{Variable, Weights};
use std::sync::{Arc, OnceLock};

/// The cam for many speeds.
pub const KIND: Kind = Kind { command: "conoid", noun: "conoid", keys: cams::CONOID };

/// Sections of one cam.
const SECTIONS: WorkBound = WorkBound { what: "speeds of a conoid", most: 100 };
/// Slices between two sections at which the surface is evaluated.
const SLICES: u32 = 6;
/// Slices with which the search for the worst points begins: as many as [`SLICES`] while there are no more than [`MOST_SEARCHED`] in all, but at
/// least the section and the middle. Between two sections the second derivative along the axis is linear in the splines' variable, so that
/// the sharpest points lie at the sections.
const FEWEST_SLICES: u32 = 2;
const MOST_SEARCHED: u32 = 120;
/// Least distance of two sections over the axial travel: nearer, the splines along the axis multiply their roundings.
const LEAST_DISTANCE: f64 = 1e-3;
/// Halvings of the last growth: to a micrometre of a metre.
const BISECTIONS: u32 = 14;
/// Growth of the prime radius while the surface is too sharp along its axis, and how often it is tried.
const GROWTH: f64 = 1.01;
const GROWTHS: usize = 700;
/// Share of a limit that is rounding.
const SLACK: f64 = 1e-9;
/// How often the overhang is lengthened for a radius that was enlarged for it, before the longest is taken.
const OVERHANGS: usize = 16;
/// Rounding of an axial position, m.
pub const ROUNDING: f64 = 1e-12;

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
    machine: Arc<Machine>,
    press: Press,
    /// Lobes, and roller travel per bottom travel, of every section.
    lobes: u32,
    lever: f64,
    roller: RollerData,
    data: ConoidData,
    cylinder: Cylinder,
    /// Speeds of the main shaft, one for each section, rpm, rising.
    speeds: Vec<f64>,
    /// Place of each section along the axis, m.
    positions: Vec<f64>,
    /// Motion of each section.
    sections: Vec<Reversal>,
    /// The follower, its prime radius common to all sections.
    follower: TranslatingRoller,
    /// Smallest prime radius that keeps every limit over the whole surface, m.
    smallest_prime_radius: Option<f64>,
    weights: Weights,
    /// By how much the cam is longer than its axial travel at either end, m.
    overhang: f64,
    /// Δx at lift 0: the least of all sections, m.
    lowest: f64,
    /// Largest residual force allowed between the sections, N.
    residual_limit: Option<f64>,
    found: SurfaceExtremes,
}

/// A section of a conoid.
#[derive(Debug, Clone, Copy)]
pub struct SectionCut<'a> {
    /// Speed of the main shaft, rpm.
    pub rpm: f64,
    /// Position along the axis, m.
    pub z: f64,
    /// Its motion.
    pub section: &'a Reversal,
}

/// Extremes of the surface that checks and report need, searched once, on demand.
#[derive(Debug, Clone, Default)]
struct SurfaceExtremes {
    nodes: OnceLock<Vec<search::GridAngle>>,
    slopes: OnceLock<Option<strips::SlopeSeries>>,
    sharpest: OnceLock<Worst>,
    wander: OnceLock<Worst>,
    axial_force: OnceLock<Worst>,
    between: OnceLock<Residual>,
    strips: OnceLock<Residual>,
}

/// The law of a press at a speed of a conoid.
fn bottom_law_at(press: &Press, data: &ConoidData, rpm: f64) -> CrankLaw {
    let design = press.bottom_law(press.design_rpm);
    if rpm == press.design_rpm {
        return design;
    }
    match data.mode {
        ConoidMode::Fixed => press.with_column(rpm, ColumnRule::Length(design.column())),
        // (14): the column is reset by its screw so that every section ends where the design does.
        ConoidMode::Adjusted => {
            let a = press.largest_deceleration();
            let shortening = match &design {
                CrankLaw::Yoke(law) => a + press.lead + law.displacement(a),
                // x + Δx depends on the deceleration alone.
                CrankLaw::Linkage(law) => law.column - design.air_left(a),
            };
            let loading = press.cylinder().loading(rpm);
            press.with_column(rpm, ColumnRule::Length(column_for(shortening, loading * a, press.polytropic_exponent)))
        }
    }
}

/// The refusal if no base radius keeps the limits of a conoid.
fn without_radius(none: NoRadius) -> Refusal {
    Refusal::of(none).remedy(
        "relax limits.pressure_angle or limits.min_convex_pitch_radius_over_roller, make conoid.axial_travel longer \
         (the surface may be too sharp along the axis), or give cam.base_radius",
    )
}

impl Conoid {
    /// Solves the sections and sizes the cam.
    ///
    /// # Errors
    /// [`Refusal`] when the machine has no conoid, the speeds make none, or no radius keeps the limits.
    pub fn solve(machine: &Machine, speeds: &[f64]) -> Result<Self, Refusal> {
        Self::unsized_of(machine, speeds)?.interpolated()
    }

    /// With its prime radius, and its overhang where that is found by itself.
    fn sized(mut self) -> Result<Self, Refusal> {
        let radius = self.roller.radius;
        let smallest = self.smallest();
        let base = match self.machine.cam.base_radius {
            Some(base) => base,
            None => rounded_up(smallest.map_err(without_radius)? - radius),
        };
        self.smallest_prime_radius = smallest.ok();
        self.resize(base + radius);
        self.overhang = self.data.overhang.unwrap_or_else(|| self.needed_overhang());
        self.resize(base + radius);
        Ok(self)
    }

    /// The smallest prime radius that keeps the limits, with the overhang that its base radius in whole millimetres needs.
    ///
    /// The contact wanders farther on a larger cam, and a longer overhang may need a larger one: both grow until they agree.
    fn smallest(&mut self) -> Result<f64, NoRadius> {
        let required =
            size_limits(&self.machine.limits, (&self.machine.cam, self.machine.cam.bore_reach()), &self.follower);
        let in_slices = self.smallest_of_slices(&required)?;
        for _ in 0..OVERHANGS {
            let smallest = self.size(&required, in_slices)?;
            self.resize(rounded_up(smallest - self.roller.radius) + self.roller.radius);
            if self.data.overhang.is_some() || self.needed_overhang() <= self.overhang {
                return Ok(smallest);
            }
            self.overhang = self.needed_overhang();
        }
        // No contact wanders farther than the radius of the sphere.
        self.overhang = whole_millimetres(self.roller.radius);
        self.size(&required, in_slices)
    }

    /// The overhang in whole millimetres on which the contact stays while the roller is anywhere on the axial travel, m.
    #[must_use]
    pub fn needed_overhang(&self) -> f64 {
        whole_millimetres(self.reach().value)
    }

    /// With a limit for the residual force at the speeds between the sections, N.
    #[must_use]
    pub fn with_residual_limit(self, residual_limit: Option<f64>) -> Self {
        Self { residual_limit, ..self }
    }

    /// The limit for the residual force between the sections, N.
    #[must_use]
    pub fn residual_limit(&self) -> Option<f64> {
        self.residual_limit
    }

    /// On another prime radius; values found on the old surface are dropped, except those that do not depend on the radius.
    fn resize(&mut self, prime_radius: f64) {
        self.follower = TranslatingRoller::new(prime_radius, self.roller.offset, self.roller.radius);
        let found = std::mem::take(&mut self.found);
        let (between, strips, nodes, slopes) = (found.between, found.strips, found.nodes, found.slopes);
        self.found = SurfaceExtremes { nodes, slopes, between, strips, ..SurfaceExtremes::default() };
    }

    /// The laws of the sections and their interpolation, on a prime radius of a metre.
    ///
    /// # Errors
    /// [`Refusal`] when the machine has no conoid or the speeds make none.
    pub fn unsized_of(machine: &Machine, speeds: &[f64]) -> Result<Self, Refusal> {
        let cams = PressCams::of(machine);
        let data = cams.conoid.ok_or_else(|| {
            Refusal::new("the machine file has no [conoid] table").remedy("a conoid needs axial_travel, mode and shift")
        })?;
        let (press, roller) = (*machine.press()?, *machine.roller()?);
        SECTIONS.allow(speeds.len())?;
        let speeds = sorted(speeds)?;
        let mut sections = Vec::with_capacity(speeds.len());
        for rpm in &speeds {
            let law = ReversalLaw {
                bottom_law: bottom_law_at(&press, &data, *rpm),
                lever: cams.lever,
                lobes: cams.lobes,
                transition: cams.transition,
            };
            sections.push(Reversal::new(law).map_err(with_keys_of_motion)?);
        }
        let positions = positions(&data, &speeds)?;
        let weights = Weights::new(&positions, Variable::Place);
        let lowest = sections.iter().map(Reversal::lowest).fold(f64::INFINITY, f64::min);
        Ok(Self {
            machine: Arc::new(machine.clone()),
            press,
            lobes: cams.lobes,
            lever: cams.lever,
            roller,
            data,
            cylinder: press.cylinder(),
            speeds,
            positions,
            sections,
            follower: TranslatingRoller::new(1.0, roller.offset, roller.radius),
            smallest_prime_radius: None,
            weights,
            overhang: data.overhang.unwrap_or(0.0),
            lowest,
            residual_limit: None,
            found: SurfaceExtremes::default(),
        })
    }

    /// The smallest prime radius that keeps the limits in every slice of its axial travel.
    fn smallest_of_slices(&self, required: &SizeLimits) -> Result<f64, NoRadius> {
        let found = parallel::map(&self.searched(), |z| size::smallest(&self.slice(*z), &self.follower, required));
        let mut radius = required.least;
        for smallest in found {
            radius = radius.max(smallest?.prime_radius);
        }
        Ok(radius)
    }

    /// Smallest radius that keeps the limits on the whole surface, searched from the radius that keeps them in every slice.
    fn size(&mut self, required: &SizeLimits, in_slices: f64) -> Result<f64, NoRadius> {
        let mut radius = in_slices;
        // Where one radius was too sharp, the next one mostly is.
        let mut too_sharp: Option<Worst> = None;
        if !self.keeps_limits_at(radius, required, &mut too_sharp) {
            let mut failing = radius;
            let grown = (0..GROWTHS).find_map(|_| {
                (failing, radius) = (radius, radius * GROWTH);
                self.keeps_limits_at(radius, required, &mut too_sharp).then_some(radius)
            });
            let mut passing = grown.ok_or(NoRadius)?;
            for _ in 0..BISECTIONS {
                let middle = 0.5 * (failing + passing);
                if self.keeps_limits_at(middle, required, &mut too_sharp) {
                    passing = middle;
                } else {
                    failing = middle;
                }
            }
            radius = passing;
        }
        // A flank that leans can reach nearer to the axis than the base radius.
        self.resize(radius);
        let wall = required.least - self.roller.radius - self.smallest_radius().value;
        Ok(if wall > 0.0 { radius + wall } else { radius })
    }

    /// Whether the surface on a prime radius keeps the limits. `too_sharp` is where the last radius failed, and is tried first.
    fn keeps_limits_at(&mut self, radius: f64, required: &SizeLimits, too_sharp: &mut Option<Worst>) -> bool {
        self.resize(radius);
        if too_sharp.is_some_and(|place| is_too_sharp(self.sharpness(place.at, place.z), required)) {
            return false;
        }
        let sharpest = self.sharpest_smooth();
        *too_sharp = is_too_sharp(sharpest.value, required).then_some(sharpest);
        too_sharp.is_none() && self.pressure_angle().value <= required.pressure_angles[0] * (1.0 + SLACK)
    }

    /// Ends of the cam along its axis, m.
    #[must_use]
    pub fn ends(&self) -> (f64, f64) {
        (0.0 - self.overhang, self.data.axial_travel + self.overhang)
    }

    /// By how much the cam is longer than its axial travel at either end, m.
    #[must_use]
    pub fn overhang(&self) -> f64 {
        self.overhang
    }

    /// Prime radius, common to all sections, m.
    #[must_use]
    pub fn prime_radius(&self) -> f64 {
        self.follower.prime_radius().unwrap_or(f64::NAN)
    }

    /// Its table of the machine file.
    #[must_use]
    pub fn data(&self) -> &ConoidData {
        &self.data
    }

    /// Its roller, from the machine file.
    #[must_use]
    pub fn roller(&self) -> &RollerData {
        &self.roller
    }

    /// Base radius R_b, m.
    #[must_use]
    pub fn base_radius(&self) -> f64 {
        self.prime_radius() - self.roller.radius
    }

    /// Place along the axis for a speed, m.
    #[must_use]
    pub fn position(&self, rpm: f64) -> f64 {
        match (self.speeds.first(), self.speeds.last()) {
            (Some(first), Some(last)) if first < last => position(&self.data, *first, *last, rpm),
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
    #[cfg(test)]
    fn weights_at(&self, z: f64) -> Vec<[f64; 4]> {
        self.weights.jets_at(z).collect()
    }

    /// Lift at a cam angle of a piece and an axial position (m), with its derivatives.
    #[must_use]
    pub fn lift(&self, piece: usize, angle: f64, z: f64) -> Partials {
        self.lift_of(&self.lifts(piece, angle), z)
    }

    /// Δx of the bottom of every section at a cam angle, m.
    fn bottoms(&self, piece: usize, angle: f64) -> impl Iterator<Item = f64> + '_ {
        self.sections.iter().map(move |section| section.bottom(piece, angle).s)
    }

    /// Δx of the bottom, m, when a section z (m) of the surface is under the roller.
    #[must_use]
    pub fn displacement(&self, piece: usize, angle: f64, z: f64, interpolation: Interpolation) -> f64 {
        match interpolation {
            Interpolation::Smooth => {
                let shares = self.bottoms(piece, angle).zip(self.weights.jets_at(z));
                shares.map(|(bottom, weight)| bottom * weight[0]).sum()
            }
            Interpolation::Straight => {
                let right = self.positions.partition_point(|place| *place <= z).clamp(1, self.positions.len() - 1);
                let [(a, before), (b, after)] = [right - 1, right].map(|index| {
                    let section = self.sections.get(index);
                    let bottom = section.map_or(f64::NAN, |section| section.bottom(piece, angle).s);
                    (self.positions.get(index).copied().unwrap_or(f64::NAN), bottom)
                });
                let share = (z - a) / (b - a);
                before * (1.0 - share) + after * share
            }
        }
    }

    /// The law in one plane across the axis.
    #[must_use]
    pub fn slice(&self, z: f64) -> Slice<'_> {
        Slice { conoid: self, z, weights: self.weights.jets_at(z).map(|weight| weight[0]).collect() }
    }

    /// Motion and follower in one plane, as if the roller were a disc in it.
    #[must_use]
    pub fn plane_of<'a>(&'a self, slice: &'a Slice<'_>) -> Curves<'a> {
        Curves { motion: slice, follower: &self.follower }
    }

    /// Force between roller and cam along the roller's path at the speed of a section, N: the air, and preload and
    /// inertia of the follower where they are given.
    #[must_use]
    pub fn path_force(&self, section: &Reversal, rpm: f64, piece: usize, angle: f64) -> f64 {
        let (lever, follower) = (self.lever, &self.machine.follower);
        let air = self.cylinder.force(section.air(piece, angle, 0.0).map_or(1.0, |air| air.pressure_ratio)) / lever;
        let inertia = follower.mass.map_or(0.0, |mass| {
            let speed = self.press.bed.crank_speed(rpm) / f64::from(self.lobes);
            mass * speed * speed * lever * section.bottom(piece, angle).dds
        });
        air + inertia + follower.preload.unwrap_or(0.0)
    }

    /// Every section.
    fn all_sections(&self) -> impl Iterator<Item = SectionCut<'_>> {
        let all = self.speeds.iter().zip(&self.positions).zip(&self.sections);
        all.map(|((rpm, z), section)| SectionCut { rpm: *rpm, z: *z, section })
    }

    /// The sections that are cut: equal speeds have one.
    #[must_use]
    pub fn sections_cut(&self) -> Vec<SectionCut<'_>> {
        let mut cuts: Vec<SectionCut<'_>> = self.all_sections().collect();
        cuts.dedup_by(|later, first| later.rpm == first.rpm);
        cuts
    }

    /// Number of its sections.
    #[must_use]
    pub fn section_count(&self) -> usize {
        self.speeds.len()
    }

    /// The residual force at the speeds between the sections that straight strips from section to section would leave.
    #[must_use]
    pub fn residual_of_strips(&self) -> Residual {
        *self.found.strips.get_or_init(|| between::residual(self, Interpolation::Straight))
    }

    /// The residual force at the speeds between the sections.
    #[must_use]
    pub fn residual_between(&self) -> Residual {
        *self.found.between.get_or_init(|| between::residual(self, Interpolation::Smooth))
    }
}

/// The law in one plane across the axis.
#[derive(Debug, Clone)]
pub struct Slice<'a> {
    conoid: &'a Conoid,
    /// Place along the axis, m.
    z: f64,
    weights: Vec<f64>,
}

impl Slice<'_> {
    /// Δx of the bottom, m, with this section of the surface under the roller, where the bottoms of the sections are known.
    fn displacement_of(&self, bottoms: impl Iterator<Item = f64>) -> f64 {
        bottoms.zip(&self.weights).map(|(bottom, weight)| bottom * weight).sum()
    }
}

impl Motion for Slice<'_> {
    fn pieces(&self) -> &[Piece] {
        self.conoid.pieces()
    }

    fn lobes(&self) -> u32 {
        self.conoid.lobes
    }

    fn jet(&self, piece: usize, angle: f64) -> Jet {
        let [[s, ..], [ds, ..], [dds, ..], [ddds, ..]] = self.conoid.lift(piece, angle, self.z);
        Jet { s, ds, dds, ddds }
    }
}

fn is_too_sharp(curvature: f64, required: &SizeLimits) -> bool {
    !(curvature * required.convex_radius <= 1.0 + SLACK)
}

/// A length that is not negative in whole millimetres, m: the next but for rounding.
fn whole_millimetres(length: f64) -> f64 {
    (1e3 * (length - ROUNDING)).ceil().max(0.0) / 1e3
}

/// The speeds in their order; a single one makes a prism of two equal sections.
fn sorted(speeds: &[f64]) -> Result<Vec<f64>, Refusal> {
    let mut speeds = speeds.to_vec();
    speeds.sort_by(f64::total_cmp);
    let (Some(&first), Some(&last)) = (speeds.first(), speeds.last()) else {
        return Err(Refusal::new("a conoid needs at least one speed"));
    };
    if speeds.len() == 1 {
        speeds.push(first);
    }
    match speeds.windows(2).find(|pair| matches!(pair, [a, b] if a == b)) {
        Some([rpm, _]) if first < last => {
            Err(Refusal::new(format!("the speed {rpm} is given twice")).remedy("each speed has one section"))
        }
        _ => Ok(speeds),
    }
}

/// Places of the sections along the axis, m.
fn positions(data: &ConoidData, speeds: &[f64]) -> Result<Vec<f64>, Refusal> {
    let (first, last) = (speeds.first().copied().unwrap_or(0.0), speeds.last().copied().unwrap_or(0.0));
    let positions = if first < last {
        speeds.iter().map(|rpm| position(data, first, last, *rpm)).collect()
    } else {
        // Equal speeds: a prism, its sections evenly spaced.
        #[expect(clippy::cast_precision_loss, reason = "a few sections")]
        let evenly = (0..speeds.len()).map(|index| data.axial_travel * index as f64 / (speeds.len() - 1) as f64);
        evenly.collect::<Vec<f64>>()
    };
    let pairs = positions.iter().zip(positions.iter().skip(1)).zip(speeds.iter().zip(speeds.iter().skip(1)));
    for ((a, b), (first, second)) in pairs {
        if b - a < LEAST_DISTANCE * data.axial_travel {
            let apart = 1e3 * (b - a);
            return Err(Refusal::new(format!(
                "the speeds {first} and {second} are too close together: their sections would lie {apart:e} mm apart"
            ))
            .remedy("give speeds further apart"));
        }
    }
    Ok(positions)
}

/// z(n) between the slowest and the fastest speed, for the mass and the ambient pressure of the file.
fn position(data: &ConoidData, first: f64, last: f64, rpm: f64) -> f64 {
    let share = match data.shift {
        Shift::Linear => (rpm - first) / (last - first),
        Shift::Square | Shift::Variable => (rpm - first) * (rpm + first) / ((last - first) * (last + first)),
    };
    data.axial_travel * share
}

#[cfg(test)]
mod tests;
