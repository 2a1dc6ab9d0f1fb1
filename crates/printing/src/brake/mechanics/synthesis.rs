//! Frames that hold the web tension without a disc, or whose tension depends least on friction.
//!
//! The eight coordinates of pivot, pulleys and centre of gravity are searched by differential evolution (R. Storn, K. Price, Journal
//! of Global Optimization 11 (1997) 341–359, DE/rand/1/bin) and polished by the simplex of J. A. Nelder and R. Mead (The Computer
//! Journal 7 (1965) 308–313). Random numbers are SplitMix64 of a seed: equal seeds give equal frames.
//!
//! What is found holds the tension by keeping the wrap and the ratio of the arms, as the paper's footnote requires; it does not
//! compensate friction. The least sensitive frames have the pivot beyond the slack span, where friction lifts the belt; they too leave
//! more than half of the effect. No frame removes the effect of friction: the tension must still be measured.

use super::belt::distance;
use super::error::{millimetres, positive, shrinking};
use super::{Brake, BrakeFrame, PaperRoll, RollRotation};
use camgen_kernel::refusal::Refusal;
use nalgebra::Vector2;

/// Steps of the roll on which a frame is judged while it is searched: the tension of a smooth frame has two or three extremes.
const STATIONS: u32 = 16;

/// Number of candidates, for eight coordinates.
const POPULATION: usize = 48;

/// Share of the difference of two candidates that is added to a third, and share of the coordinates that are replaced.
const DIFFERENCE: f64 = 0.6;
const TAKEN: f64 = 0.9;

/// Rounds of the simplex after the search; it ends sooner where its corners agree to this much.
const POLISH: usize = 1500;
const AGREED: f64 = 1e-12;

/// The cost of a frame that cannot follow the whole roll, plus the share it misses: more than any frame that can.
const WALLED: f64 = 1e3;

/// The coordinates.
type Coordinates = [f64; 8];

/// The aim of a design.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FrameAim {
    /// Least spread of the tension over the roll.
    Level,
    /// Least spread of the tension over the roll and a range of friction coefficients together.
    Robust {
        /// Least friction.
        from: f64,
        /// Largest friction.
        to: f64,
    },
}

/// The task.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrameTask {
    /// The roll.
    pub roll: PaperRoll,
    /// f.
    pub friction: f64,
    /// Its direction of rotation.
    pub rotation: RollRotation,
    /// Radius of the pulleys, m.
    pub pulley_radius: f64,
    /// Limit of every coordinate, m; above the largest radius and the pulleys.
    pub reach: f64,
    /// Least distance between pulley and roll, and between pivot and full roll, m.
    pub clearance: f64,
    /// The aim.
    pub aim: FrameAim,
    /// Generations of the search: 300 find a level frame.
    pub generations: u32,
    /// Seed of the random numbers.
    pub seed: u64,
}

/// A frame that was found.
#[derive(Debug, Clone)]
pub struct DesignedBrake {
    /// The brake with the frame.
    pub brake: Brake,
    /// (largest − least tension)/largest, over the radii, and over the frictions of [`FrameAim::Robust`].
    pub spread: f64,
}

struct SplitMix(u64);

impl SplitMix {
    /// The upper 32 bits of the next number.
    fn next(&mut self) -> u32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        u32::try_from((z ^ (z >> 31)) >> 32).unwrap_or(0)
    }

    /// 0…1, without 1.
    fn unit(&mut self) -> f64 {
        f64::from(self.next()) / (f64::from(u32::MAX) + 1.0)
    }

    fn below(&mut self, count: usize) -> usize {
        usize::try_from(self.next()).unwrap_or(0) % count.max(1)
    }
}

/// How much less than the least a distance is.
fn shortfall(distance: f64, least: f64) -> f64 {
    (least - distance).max(0.0)
}

/// A frame of the search with its cost.
#[derive(Debug, Clone, Copy)]
struct Candidate {
    cost: f64,
    genes: Coordinates,
}

impl FrameTask {
    fn candidate(&self, genes: Coordinates) -> Candidate {
        Candidate { cost: self.cost(&genes), genes }
    }

    fn frame(&self, genes: &Coordinates) -> BrakeFrame {
        let [ox, oy, rx, ry, lx, ly, gx, gy] = *genes;
        BrakeFrame {
            pivot: [ox, oy],
            right_pulley: [rx, ry],
            left_pulley: [lx, ly],
            centre_of_gravity: [gx, gy],
            pulley_radius: self.pulley_radius,
        }
    }

    /// How far a frame exceeds the reach or its parts are too close, m.
    fn excess(&self, genes: &Coordinates) -> f64 {
        let BrakeFrame { pivot, right_pulley, left_pulley, .. } = self.frame(genes);
        let [pivot, right, left] = [pivot, right_pulley, left_pulley].map(Vector2::from);
        let roll = self.roll.largest_radius + self.clearance;
        let out: f64 = genes.iter().map(|value| (value.abs() - self.reach).max(0.0)).sum();
        let axis = Vector2::zeros();
        out + shortfall(distance(pivot, axis), roll)
            + shortfall(distance(right, axis), roll + self.pulley_radius)
            + shortfall(distance(left, axis), roll + self.pulley_radius)
            + shortfall(distance(right, left), 2.0 * self.pulley_radius + self.clearance)
    }

    /// The cost to be minimised.
    fn cost(&self, genes: &Coordinates) -> f64 {
        let excess = self.excess(genes);
        if excess > 0.0 {
            return WALLED * (2.0 + excess);
        }
        let friction = match self.aim {
            FrameAim::Level => self.friction,
            FrameAim::Robust { to, .. } => to,
        };
        match Brake::with_stations(self.frame(genes), self.roll, friction, self.rotation, STATIONS) {
            Ok(brake) => self.spread(&brake),
            Err(wall) => {
                let radius = wall.radius().unwrap_or(self.roll.largest_radius);
                WALLED * (1.0 + (radius - self.roll.smallest_radius) / self.roll.largest_radius)
            }
        }
    }

    /// (largest − least)/largest at the stations of a walk, the last of which is at most a step beyond the roll.
    fn spread(&self, brake: &Brake) -> f64 {
        let end = brake.at(self.roll.smallest_radius).ok();
        let inside = brake.places.iter().take(brake.places.len().saturating_sub(1)).map(|place| brake.pose(place));
        let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
        for pose in inside.chain(end) {
            for friction in self.frictions() {
                let tension = super::tension_of_moment(pose.h1, &pose, friction);
                let jams = !(pose.resisting_arm(friction) > 0.0);
                (least, most) = (least.min(tension), if jams { f64::INFINITY } else { most.max(tension) });
            }
        }
        if most.is_finite() { (most - least) / most } else { WALLED }
    }

    fn frictions(&self) -> [f64; 2] {
        match self.aim {
            FrameAim::Level => [self.friction; 2],
            FrameAim::Robust { from, to } => [from, to],
        }
    }
}

/// (largest − least tension)/largest of a brake, over the radii, and over the frictions of [`FrameAim::Robust`].
#[must_use]
pub fn spread(task: &FrameTask, brake: &Brake) -> f64 {
    task.spread(brake)
}

/// The best frame found.
///
/// # Errors
/// [`Refusal`] of a number of the task or of the order of the radii, and where no frame within the reach follows the whole roll.
pub fn synthesise(task: &FrameTask) -> Result<DesignedBrake, Refusal> {
    let [from, to] = task.frictions();
    let PaperRoll { largest_radius: largest, smallest_radius: smallest } = task.roll;
    let numbers = [
        ("friction", task.friction),
        ("least friction", from),
        ("largest friction", to),
        ("pulley radius", task.pulley_radius),
        ("reach", task.reach),
        ("clearance", task.clearance),
        ("largest radius", largest),
        ("smallest radius", smallest),
    ];
    numbers.into_iter().try_for_each(|(name, value)| positive(name, value))?;
    shrinking(&task.roll)?;
    let mut best = polished(task, evolved(task));
    // A second simplex from the end of the first: the first may have collapsed in a narrow valley.
    best = polished(task, best);
    let brake = Brake::new(task.frame(&best.genes), task.roll, task.friction, task.rotation);
    let Some(brake) = brake.ok().filter(|_| best.cost < WALLED) else {
        let reach = millimetres(task.reach);
        return Err(Refusal::new(format!("no frame within {reach} mm of the axis of the roll brakes the whole roll"))
            .remedy("allow a larger reach, or smaller pulleys"));
    };
    let spread = task.spread(&brake);
    Ok(DesignedBrake { brake, spread })
}

/// Differential evolution; the best candidate of the last generation.
fn evolved(task: &FrameTask) -> Candidate {
    let mut random = SplitMix(task.seed);
    let mut all: Vec<Candidate> = (0..POPULATION)
        .map(|_| task.candidate(std::array::from_fn(|_| task.reach * (2.0 * random.unit() - 1.0))))
        .collect();
    for _ in 0..task.generations {
        for index in 0..POPULATION {
            let [base, more, less] =
                [(); 3].map(|()| all.get(random.below(POPULATION)).map_or([0.0; 8], |picked| picked.genes));
            let Some(Candidate { cost, mut genes }) = all.get(index).copied() else { continue };
            let surely = random.below(genes.len());
            let mutants =
                base.iter().zip(&more).zip(&less).map(|((base, more), less)| base + DIFFERENCE * (more - less));
            for (at, (gene, mutant)) in genes.iter_mut().zip(mutants).enumerate() {
                if at == surely || random.unit() < TAKEN {
                    *gene = mutant;
                }
            }
            let new = task.candidate(genes);
            if let Some(old) = all.get_mut(index).filter(|_| new.cost <= cost) {
                *old = new;
            }
        }
    }
    let best = all.into_iter().min_by(|a, b| a.cost.total_cmp(&b.cost));
    best.unwrap_or(Candidate { cost: f64::INFINITY, genes: [0.0; 8] })
}

/// A point on the line from one through another, by a multiple of their distance.
fn on_line(from: &Coordinates, through: &Coordinates, multiple: f64) -> Coordinates {
    let mut point = *from;
    for (value, other) in point.iter_mut().zip(through) {
        *value += multiple * (other - *value);
    }
    point
}

/// Nelder and Mead's simplex about a point.
fn polished(task: &FrameTask, start: Candidate) -> Candidate {
    let size = 0.02 * task.reach;
    let mut corners = Vec::with_capacity(start.genes.len() + 1);
    for index in 0..start.genes.len() {
        let mut genes = start.genes;
        genes.iter_mut().skip(index).take(1).for_each(|value| *value += size);
        corners.push(task.candidate(genes));
    }
    corners.push(start);
    for _ in 0..POLISH {
        corners.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        let (Some(best), Some(worst)) = (corners.first().copied(), corners.pop()) else { return start };
        if worst.cost - best.cost < AGREED {
            return best;
        }
        let mut middle: Coordinates = [0.0; 8];
        for corner in &corners {
            for (sum, value) in middle.iter_mut().zip(&corner.genes) {
                *sum += value / 8.0;
            }
        }
        let second = corners.last().map_or(worst.cost, |corner| corner.cost);
        let mirrored = task.candidate(on_line(&worst.genes, &middle, 2.0));
        let new = if mirrored.cost < best.cost {
            let further = task.candidate(on_line(&worst.genes, &middle, 3.0));
            if further.cost < mirrored.cost { further } else { mirrored }
        } else if mirrored.cost < second {
            mirrored
        } else {
            let multiple = if mirrored.cost < worst.cost { 1.5 } else { 0.5 };
            task.candidate(on_line(&worst.genes, &middle, multiple))
        };
        if new.cost < worst.cost {
            corners.push(new);
        } else {
            for corner in corners.iter_mut().skip(1) {
                *corner = task.candidate(on_line(&corner.genes, &best.genes, 0.5));
            }
            corners.push(task.candidate(on_line(&worst.genes, &best.genes, 0.5)));
        }
    }
    corners.into_iter().min_by(|a, b| a.cost.total_cmp(&b.cost)).unwrap_or(start)
}
