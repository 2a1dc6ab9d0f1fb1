//! The shaft cut into panels: one section each, with no support, disc or requested position inside.

use super::{Beam, Shaft, ShaftSegment};

/// Positions nearer to one another than this part of the length are one: a support given at the end of a segment by
/// its decimal number differs from the sum of the lengths by rounding, and a panel of that width would be noise.
pub(super) const SAME_PLACE: f64 = 1e-12;

/// A piece of the shaft with one section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Panel {
    /// Left end, m.
    pub(super) at: f64,
    /// m.
    pub(super) length: f64,
    /// EJ, N m².
    pub(super) bending: f64,
    /// 1/(κGA), 1/N; 0 for an Euler beam.
    pub(super) shear: f64,
    /// ρA, kg/m.
    pub(super) mass: f64,
    /// ρJ, kg m; 0 for an Euler beam.
    pub(super) rotary: f64,
    /// ρ/(κG), s²/m²: the square of the slowness of shear waves; 0 for an Euler beam.
    slowness: f64,
}

impl Panel {
    fn new(segment: &ShaftSegment, beam: Beam, at: f64, length: f64) -> Self {
        let (area, second_moment) = (segment.area(), segment.second_moment());
        let shear = match beam {
            Beam::Timoshenko => 1.0 / (segment.shear_coefficient() * segment.shear_modulus() * area),
            Beam::Euler => 0.0,
        };
        let rotary = if beam == Beam::Timoshenko { segment.density * second_moment } else { 0.0 };
        Self {
            at,
            length,
            bending: segment.modulus * second_moment,
            shear,
            mass: segment.density * area,
            rotary,
            slowness: segment.density * area * shear,
        }
    }

    /// How much of a wave of ω, rad/s, lies on the panel, rad: bending l (ρA ω²/EJ)^¼, and shear l ω √(ρ/κG), which is
    /// the larger on a panel shorter than it is thick.
    pub(super) fn waves(&self, omega: f64) -> f64 {
        let bending = self.length * (self.mass / self.bending).sqrt().sqrt() * omega.sqrt();
        bending.max(self.length * omega * self.slowness.sqrt())
    }

    /// Cut in equal pieces.
    fn pieces(self, count: u32) -> impl Iterator<Item = Self> {
        let length = self.length / f64::from(count);
        (0..count).map(move |k| Self { at: self.at + length * f64::from(k), length, ..self })
    }
}

/// The panels of a shaft from left to right, and the cuts between them: panel k lies between the cuts k and k + 1.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Panels {
    pub(super) panels: Vec<Panel>,
    /// One more than panels, rising.
    pub(super) cuts: Vec<f64>,
}

impl Panels {
    /// Cut at every change of section, support, disc and at these positions.
    pub(super) fn new(shaft: &Shaft, places: &[f64]) -> Self {
        let same = SAME_PLACE * shaft.length();
        let asked = places.iter().copied();
        let mut inside: Vec<f64> =
            shaft.supports().iter().map(|s| s.at).chain(shaft.discs().iter().map(|d| d.at)).chain(asked).collect();
        inside.sort_by(f64::total_cmp);
        let mut panels = Vec::new();
        let mut left = 0.0;
        for segment in shaft.segments() {
            let right = left + segment.length;
            let mut at = left;
            for place in inside.iter().filter(|place| **place > left && **place < right - same) {
                if *place > at + same {
                    panels.push(Panel::new(segment, shaft.beam(), at, place - at));
                    at = *place;
                }
            }
            // The rest of the segment, at its full length where nothing cut it.
            let rest = if at == left { segment.length } else { right - at };
            panels.push(Panel::new(segment, shaft.beam(), at, rest));
            left = right;
        }
        Self::from_panels(panels)
    }

    fn from_panels(panels: Vec<Panel>) -> Self {
        let last = panels.last().map(|panel| panel.at + panel.length);
        let cuts = panels.iter().map(|panel| panel.at).chain(last).collect();
        Self { panels, cuts }
    }

    /// The nearest cut to a position at which one was made.
    pub(super) fn cut(&self, place: f64) -> usize {
        let right = self.cuts.partition_point(|cut| *cut < place);
        let left = right.saturating_sub(1);
        let [to_left, to_right] =
            [left, right].map(|cut| self.cuts.get(cut).map_or(f64::INFINITY, |at| (at - place).abs()));
        if to_left <= to_right { left } else { right }
    }

    /// Position of a cut, m.
    pub(super) fn position(&self, cut: usize) -> f64 {
        self.cuts.get(cut).copied().unwrap_or(0.0)
    }

    /// The largest [`Panel::waves`].
    pub(super) fn waves(&self, omega: f64) -> f64 {
        self.panels.iter().map(|panel| panel.waves(omega)).fold(0.0, f64::max)
    }

    /// With every panel that holds more than `most` rad of a wave of ω cut into as many equal pieces as it needs; `None` if
    /// that makes more than [`MOST_CUT`].
    pub(super) fn cut_to(&self, omega: f64, most: f64) -> Option<Self> {
        let mut pieces = Vec::with_capacity(self.panels.len());
        for panel in &self.panels {
            let waves = panel.waves(omega);
            let count = (1..=MOST_CUT).find(|n| waves <= most * f64::from(*n))?;
            pieces.extend(panel.pieces(count));
            if pieces.len() > MOST_CUT as usize {
                return None;
            }
        }
        Some(Self::from_panels(pieces))
    }
}

/// Panels with those that are cut for the waves they hold: twice as many as a shaft may have of itself.
const MOST_CUT: u32 = 100;
