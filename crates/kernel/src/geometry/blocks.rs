//! A chain of arcs and lines in the numbers that a control reads: ends and centres on a grid of decimals, each arc by its end and its centre.
//!
//! Each edge starts where the one before ended, on the grid, so that roundings do not add up. Of the centres on the grid next to that of the
//! arc the one is taken whose distances from both ends differ least: a control refuses an arc whose radii differ (0.005 mm and 0.1 % in
//! LinuxCNC, `CIRCLE_ERROR_CONST` of 0.01 mm in SINUMERIK, `circleDeviation` of at most 0.016 mm in HEIDENHAIN controls).

use super::contour::Segment;
use crate::units::LengthUnit;
use nalgebra::Vector2;

/// Larger radii than this are out of the range of some controls (FANUC: 99999.999 mm): such an arc is written as lines.
const LARGEST_RADIUS: f64 = 90_000.0;
/// Shorter arcs than so many steps of the grid are written as lines: their sense would be that of the rounding.
const SHORTEST_ARC: f64 = 20.0;
/// How far a line may lie from the arc that it replaces, in steps of the grid.
const SAGITTA: f64 = 0.25;
/// Most lines in the place of an arc.
const MOST_LINES: f64 = 1000.0;

/// A block of a program, which starts where the one before ends, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Block {
    /// A straight line.
    Line {
        /// Its end.
        to: Vector2<f64>,
    },
    /// An arc.
    Arc {
        /// Its end.
        to: Vector2<f64>,
        /// Its centre.
        centre: Vector2<f64>,
        /// Whether it turns left (G3).
        left: bool,
    },
}

impl Block {
    /// Its end, mm.
    #[must_use]
    pub fn to(&self) -> Vector2<f64> {
        match self {
            Self::Line { to } | Self::Arc { to, .. } => *to,
        }
    }
}

/// Numbers of so many decimals.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    per_unit: f64,
}

impl Grid {
    /// The numbers with so many decimals, at most 9.
    #[must_use]
    pub fn of_decimals(decimals: u32) -> Self {
        Self { per_unit: (0..decimals.min(9)).fold(1.0, |power, _| 10.0 * power) }
    }

    /// The lengths, mm, that are numbers with so many decimals of a unit.
    #[must_use]
    pub fn of_lengths(decimals: u32, units: LengthUnit) -> Self {
        Self { per_unit: units.of_mm(Self::of_decimals(decimals).per_unit) }
    }

    /// The distance between two numbers.
    #[must_use]
    pub fn step(&self) -> f64 {
        1.0 / self.per_unit
    }

    /// The nearest number.
    #[must_use]
    pub fn nearest(&self, value: f64) -> f64 {
        (value * self.per_unit).round() / self.per_unit
    }

    /// The nearest point.
    #[must_use]
    pub fn point(&self, point: Vector2<f64>) -> Vector2<f64> {
        point.map(|value| self.nearest(value))
    }

    /// The blocks of a chain of edges, each of which starts where the one before ends.
    #[must_use]
    pub fn blocks(&self, edges: &[Segment]) -> Vec<Block> {
        let mut blocks = Vec::with_capacity(edges.len());
        let Some(first) = edges.first() else { return blocks };
        let mut from = self.point(first.start);
        for edge in edges {
            let to = self.point(edge.end);
            if to != from {
                self.add(&mut blocks, &Segment { start: from, end: to, bulge: edge.bulge });
            }
            from = to;
        }
        blocks
    }

    /// Adds an edge whose ends are on the grid.
    fn add(self, blocks: &mut Vec<Block>, edge: &Segment) {
        let chord = (edge.end - edge.start).norm();
        let sagitta = 0.5 * chord * edge.bulge.abs();
        if edge.bulge == 0.0 || sagitta < SAGITTA * self.step() || chord < SHORTEST_ARC * self.step() {
            blocks.push(Block::Line { to: edge.end });
        } else if edge.radius().abs() > LARGEST_RADIUS {
            let count = (sagitta / (SAGITTA * self.step())).sqrt().ceil().min(MOST_LINES);
            let mut step = 1.0;
            while step < count {
                blocks.push(Block::Line { to: self.point(edge.point_and_tangent(step / count).0) });
                step += 1.0;
            }
            blocks.push(Block::Line { to: edge.end });
        } else {
            blocks.push(Block::Arc { to: edge.end, centre: self.centre(edge), left: edge.bulge > 0.0 });
        }
    }

    /// The centre on the grid of an arc whose ends are on it.
    fn centre(self, arc: &Segment) -> Vector2<f64> {
        let exact = arc.centre();
        let around = self.point(exact);
        let steps = [0.0, -self.step(), self.step()];
        let places = steps.iter().flat_map(|x| steps.iter().map(move |y| around + Vector2::new(*x, *y)));
        let best = places.min_by(|a, b| error_about(arc, *a).total_cmp(&error_about(arc, *b)));
        best.map_or(around, |centre| self.point(centre))
    }
}

/// How far a centre moves an arc with given ends: the difference of its radii, and how far its middle moves, mm.
fn error_about(arc: &Segment, centre: Vector2<f64>) -> f64 {
    let radii = (arc.start - centre).norm() - (arc.end - centre).norm();
    let radius = 0.5 * ((arc.start - centre).norm() + (arc.end - centre).norm());
    let middle = arc.middle() - centre;
    radii.abs() + 0.5 * (middle.norm() - radius).abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_and_centres_are_on_the_grid_and_the_radii_of_an_arc_are_equal() {
        let grid = Grid::of_decimals(3);
        let mut worst = 0.0_f64;
        for index in 0..2000 {
            let at = 0.37 * f64::from(index);
            let radius = 3.0 + 0.613 * f64::from(index);
            let sweep = 0.05 + 0.0007 * f64::from(index);
            let place = |angle: f64| Vector2::new(angle.cos(), angle.sin()) * radius + Vector2::new(11.1237, -4.4561);
            let arc = Segment { start: place(at), end: place(at + sweep), bulge: (0.25 * sweep).tan() };
            let blocks = grid.blocks(&[arc]);
            let [Block::Arc { to, centre, left: true }] = blocks.as_slice() else { panic!("{blocks:?}") };
            for value in [to.x, to.y, centre.x, centre.y] {
                assert_eq!(format!("{value:.3}").parse(), Ok(value));
            }
            let from = grid.point(arc.start);
            worst = worst.max(((from - centre).norm() - (to - centre).norm()).abs());
            let off = (arc.middle() - centre).norm() - 0.5 * ((from - centre).norm() + (to - centre).norm());
            assert!(off.abs() < 0.0015, "{off}");
        }
        assert!(worst < 0.0008, "{worst}");
    }

    #[test]
    fn what_a_control_cannot_turn_is_straight() {
        let grid = Grid::of_decimals(3);
        let end = Vector2::new(200.0, 0.0);
        let flat = Segment { start: Vector2::zeros(), end, bulge: 0.0005 };
        let blocks = grid.blocks(&[flat]);
        assert!(blocks.len() > 5 && blocks.iter().all(|block| matches!(block, Block::Line { .. })), "{blocks:?}");
        assert_eq!(blocks.last().map(Block::to), Some(end));
        let short = Segment { end: Vector2::new(0.01, 0.0), bulge: 0.9, ..flat };
        assert_eq!(grid.blocks(&[short]), [Block::Line { to: short.end }]);
        let none = Segment { end: Vector2::new(0.0004, 0.0), ..flat };
        assert_eq!(grid.blocks(&[none]), []);
    }
}
