//! The law from one section to the next: between two sections the splines along the axis are cubics, given by the lifts of the
//! two and by the slopes there, so that a point costs two laws instead of one for each section.
//!
//! A slope is a sum over all sections with fixed shares. Over a grid, where many axial positions are requested at one cam angle,
//! the laws of all sections are evaluated once; for one position the slopes come from Chebyshev series over the cam angle, one for each
//! section and derivative, which agree with those sums to the rounding of the lift.

use super::{Conoid, Partials};
use camgen_kernel::motion::{Jet, Piece};
use camgen_kernel::numeric::chebyshev_series::{ChebyshevSeries, SeriesGroup};
use camgen_kernel::numeric::parallel;
use camgen_kernel::numeric::spline::cubic_at;
use std::cell::{Cell, OnceCell};

/// Most sections whose laws cost less than the series of their slopes.
const FEW_SECTIONS: usize = 8;
/// Terms of the series to begin with, and how often they are doubled; beyond, the sums are used.
const TERMS: u32 = 24;
const DOUBLINGS: u32 = 5;
/// So many of the last terms must be small.
const LAST: usize = 3;
/// Largest error of a derivative of the lift by the slopes, as a share: a slope enters with no more than 4/27 of the distance of the sections.
const RESOLVED: f64 = 1e-15;
/// Share of that below which the last terms are left out.
const NEGLIGIBLE: f64 = 0.1;

/// The cubics of the lift and its derivatives by the cam angle between two neighbouring sections, by the variable of the splines from the
/// first of the two on: of all four the constants, then the factors of the first power, and so on.
pub type Cubics = [[f64; 4]; 4];

/// The lift of a section at a cam angle.
#[derive(Debug, Clone, Copy)]
struct SectionLift {
    lift: Jet,
    /// Slope along the axis, in the variable of the splines.
    slope: Jet,
}

/// The cubics over a strip of this width from one section to the next.
fn cubics(low: SectionLift, high: SectionLift, width: f64) -> Cubics {
    let [low, high, low_slope, high_slope] = [low.lift, high.lift, low.slope, high.slope].map(orders);
    let mean: [f64; 4] = std::array::from_fn(|order| (high[order] - low[order]) / width);
    [
        low,
        low_slope,
        std::array::from_fn(|order| (3.0 * mean[order] - 2.0 * low_slope[order] - high_slope[order]) / width),
        std::array::from_fn(|order| (low_slope[order] + high_slope[order] - 2.0 * mean[order]) / (width * width)),
    ]
}

/// Value and derivatives of a jet.
fn orders(jet: Jet) -> [f64; 4] {
    [jet.s, jet.ds, jet.dds, jet.ddds]
}

/// The lifts of the sections at a cam angle.
pub trait Strips: std::fmt::Debug {
    /// The cubics from a section to the next, by the number of the first.
    fn cubics(&self, interval: usize) -> Cubics;
}

/// The lifts between all sections at a cam angle, for many axial positions.
#[derive(Debug, Clone)]
pub struct AllStrips(Vec<Cubics>);

impl Strips for AllStrips {
    fn cubics(&self, interval: usize) -> Cubics {
        self.0.get(interval).copied().unwrap_or([[f64::NAN; 4]; 4])
    }
}

/// The lifts at a cam angle near some axial positions, found when they are requested.
#[derive(Debug)]
pub struct StripsNear<'a> {
    conoid: &'a Conoid,
    piece: usize,
    angle: f64,
    all: OnceCell<AllStrips>,
    /// The last request: mostly the next one too.
    last: Cell<Option<(usize, Cubics)>>,
}

impl Strips for StripsNear<'_> {
    fn cubics(&self, interval: usize) -> Cubics {
        if let Some((_, cubics)) = self.last.get().filter(|(known, _)| *known == interval) {
            return cubics;
        }
        let (conoid, piece, angle) = (self.conoid, self.piece, self.angle);
        let cubics = match conoid.slope_series() {
            Some(series) => {
                let [low, high] = [interval, interval + 1].map(|section| SectionLift {
                    lift: conoid.lift_of_section(section, piece, angle),
                    slope: series.slope(piece, section, angle),
                });
                cubics(low, high, conoid.weights.width_of(interval))
            }
            None => self.all.get_or_init(|| conoid.all_lifts(piece, angle)).cubics(interval),
        };
        self.last.set(Some((interval, cubics)));
        cubics
    }
}

/// The slopes of the lift along the axis at every section, as series over each piece of the motion.
#[derive(Debug, Clone)]
pub(super) struct SlopeSeries {
    pieces: Vec<Vec<SeriesGroup<4>>>,
}

impl SlopeSeries {
    fn slope(&self, piece: usize, section: usize, angle: f64) -> Jet {
        let series = self.pieces.get(piece).and_then(|sections| sections.get(section));
        let [s, ds, dds, ddds] = series.map_or([f64::NAN; 4], |series| series.values_at(angle));
        Jet { s, ds, dds, ddds }
    }
}

impl Conoid {
    /// Lift of a section at a cam angle, counted from the common lowest point.
    fn lift_of_section(&self, section: usize, piece: usize, angle: f64) -> Jet {
        let bottom = self.sections.get(section).map_or_else(Jet::default, |section| section.bottom(piece, angle));
        Jet { s: bottom.s - self.lowest, ..bottom }.scaled(self.lever)
    }

    /// The lifts at a cam angle, for a few axial positions: they depend neither on that position nor on the prime radius.
    #[must_use]
    pub fn lifts(&self, piece: usize, angle: f64) -> StripsNear<'_> {
        StripsNear { conoid: self, piece, angle, all: OnceCell::new(), last: Cell::new(None) }
    }

    /// The lifts at a cam angle, for many axial positions.
    #[must_use]
    pub fn all_lifts(&self, piece: usize, angle: f64) -> AllStrips {
        let sections = self.sections_at(piece, angle);
        let pairs = sections.array_windows().enumerate();
        AllStrips(pairs.map(|(interval, [low, high])| cubics(*low, *high, self.weights.width_of(interval))).collect())
    }

    /// Every section at a cam angle.
    fn sections_at(&self, piece: usize, angle: f64) -> Vec<SectionLift> {
        let lifts: Vec<Jet> = (0..self.sections.len()).map(|index| self.lift_of_section(index, piece, angle)).collect();
        let slopes = self.weights.slopes(&lifts);
        lifts.into_iter().zip(slopes).map(|(lift, slope)| SectionLift { lift, slope }).collect()
    }

    /// Lift at an axial position (m), with its derivatives, at the cam angle of these lifts of the sections.
    #[must_use]
    pub fn lift_of<L: Strips + ?Sized>(&self, lifts: &L, z: f64) -> Partials {
        let (interval, [t, t1, t2, t3]) = self.weights.place(z);
        let [a, b, c, d] = lifts.cubics(interval);
        let mut partials = [[0.0; 4]; 4];
        for order in 0..4 {
            let [w, w1, w2, w3] = cubic_at(&[a[order], b[order], c[order], d[order]], t);
            // Faà di Bruno's rule.
            partials[order] = [w, w1 * t1, w2 * t1 * t1 + w1 * t2, w3 * t1 * t1 * t1 + 3.0 * w2 * t1 * t2 + w1 * t3];
        }
        partials
    }

    /// The series of the slopes, where they cost less than the laws of all sections and are as good.
    fn slope_series(&self) -> Option<&SlopeSeries> {
        let found = self.found.slopes.get_or_init(|| {
            if self.sections.len() <= FEW_SECTIONS {
                return None;
            }
            let pieces = self.pieces().iter().enumerate().map(|(piece, span)| self.slopes_of(piece, *span));
            Some(SlopeSeries { pieces: pieces.collect::<Option<_>>()? })
        });
        found.as_ref()
    }

    /// The series on a piece, section by section; `None` where they do not resolve the slopes.
    fn slopes_of(&self, piece: usize, span: Piece) -> Option<Vec<SeriesGroup<4>>> {
        let range = (span.start, span.end);
        let terms = (0..DOUBLINGS).map(|doubling| if span.dwell { 1 } else { TERMS << doubling });
        terms.take(if span.dwell { 1 } else { usize::MAX }).find_map(|terms| {
            let places = ChebyshevSeries::points(range, terms);
            let all = parallel::map(&places, |angle| self.sections_at(piece, *angle));
            // Of each derivative, the largest size over all sections.
            let mut largest = [0.0_f64; 4];
            for section in all.iter().flatten() {
                largest.iter_mut().zip(orders(section.lift)).for_each(|(most, value)| *most = most.max(value.abs()));
            }
            let sections: Vec<usize> = (0..self.sections.len()).collect();
            let series = parallel::map(&sections, |section| {
                let at_angles = all.iter().map(|sections| sections.get(*section));
                let slopes: Vec<[f64; 4]> =
                    at_angles.map(|section| section.map_or([0.0; 4], |section| orders(section.slope))).collect();
                let allowed = largest.map(|most| RESOLVED * most / self.weights.width_at(*section));
                let series = SeriesGroup::through(range, &slopes);
                let resolved = span.dwell || series.last(LAST).iter().zip(allowed).all(|(last, most)| *last <= most);
                resolved.then(|| series.without_terms_below(allowed.map(|most| NEGLIGIBLE * most)))
            });
            series.into_iter().collect()
        })
    }
}
