//! Spline patches as read from a file, compared with an exact surface, with a bound for the places between the samples.
//!
//! On a cell, a share of a knot span no longer than 15 mm, the deviation is a polynomial of the patch's degrees less a surface so smooth there that
//! one degree more represents it. A polynomial of degree m is nowhere larger than 1/cos(m π/2n) times its largest size at the n Chebyshev places
//! (H. Ehlich, K. Zeller, Schwankung von Polynomen zwischen Gitterpunkten, 1964). The places are doubled until the bound keeps the limit, or a sample
//! breaks it.

use camgen_kernel::geometry::nurbs::NurbsSurface as Patch;
use camgen_kernel::numeric::parallel;
use camgen_kernel::profile::Worst;
use nalgebra::Vector3;
use std::f64::consts::PI;

/// Longest side of a cell, mm: on a tenth of a radian and less the exact surface is as smooth as its splines.
const CELL: f64 = 15.0;
/// Most cells along a span: no cam has a span of a metre.
const MOST_CELLS: f64 = 64.0;
/// Places along a cell at first, and how often they are doubled.
pub(super) const PLACES: u32 = 8;
pub(super) const DOUBLINGS: u32 = 3;
/// The bound may exceed the tolerance by this factor, that of the finest places.
pub(super) const SLACK: f64 = 1.01;
/// Least cosine between the normal of a patch and that of the exact surface: a patch within a tolerance of it is not folded.
const SAME_SIDE: f64 = 0.9;

/// The exact flank of which a patch is a part.
pub(super) trait ExactFlank: Sync {
    /// The deviation of a point (mm) of a patch with this normal, positive where metal is missing, with the cam angle and the place along the axis
    /// there; and the cosine between the normals.
    fn deviation(&self, point: Vector3<f64>, normal: Vector3<f64>) -> (Worst, f64);
}

/// The result for a cell or for the whole flank.
#[derive(Debug, Clone, Copy)]
pub(super) struct FlankDeviation {
    /// The largest deviation, mm.
    pub(super) worst: Worst,
    /// What it is at most between the places, mm.
    pub(super) bound: f64,
    /// How many places were looked at.
    pub(super) samples: usize,
    /// Whether a patch is folded, or its normal points into the metal.
    pub(super) folded: bool,
}

impl FlankDeviation {
    pub(super) const NONE: Self =
        Self { worst: Worst { value: 0.0, at: 0.0, z: 0.0 }, bound: 0.0, samples: 0, folded: false };

    pub(super) fn with(self, other: Self) -> Self {
        // Where the deviation is not a number, it is the largest.
        let larger = !(other.worst.value.abs() <= self.worst.value.abs());
        Self {
            worst: if larger { other.worst } else { self.worst },
            bound: if other.bound <= self.bound { self.bound } else { other.bound },
            samples: self.samples + other.samples,
            folded: self.folded || other.folded,
        }
    }
}

/// A part of a knot span in both directions.
pub(super) struct SpanCell<'a> {
    pub(super) patch: &'a Patch,
    /// The patch's own normal points out of the metal.
    pub(super) outward: bool,
    pub(super) u: (f64, f64),
    pub(super) v: (f64, f64),
}

impl SpanCell<'_> {
    /// The deviation at n by n Chebyshev places, with the bound for the places between.
    pub(super) fn at_places(&self, exact: &dyn ExactFlank, n: u32) -> FlankDeviation {
        let place = |range: (f64, f64), i: u32| {
            let share = 0.5 - 0.5 * libm::cos(PI * (f64::from(i) + 0.5) / f64::from(n));
            range.0 + (range.1 - range.0) * share
        };
        let sense = if self.outward { 1.0 } else { -1.0 };
        let mut found = FlankDeviation::NONE;
        for i in 0..n {
            for j in 0..n {
                let [point, by_u, by_v] = self.patch.point_and_slopes(place(self.u, i), place(self.v, j));
                let normal = by_u.cross(&by_v).normalize() * sense;
                let (worst, cosine) = exact.deviation(point, normal);
                let folded = !(cosine >= SAME_SIDE);
                found = found.with(FlankDeviation { worst, bound: 0.0, samples: 1, folded });
            }
        }
        let growth = |degree: usize| {
            #[expect(clippy::cast_precision_loss, reason = "a degree of at most 25")]
            let angle = PI * (degree + 1) as f64 / (2.0 * f64::from(n));
            if angle < 0.5 * PI { 1.0 / libm::cos(angle) } else { f64::INFINITY }
        };
        let bound = found.worst.value.abs() * growth(self.patch.u.degree) * growth(self.patch.v.degree);
        FlankDeviation { bound, ..found }
    }

    /// The deviation with as many places as the decision needs.
    pub(super) fn found(&self, exact: &dyn ExactFlank, tolerance: f64) -> FlankDeviation {
        self.refined(self.at_places(exact, PLACES), exact, tolerance)
    }

    /// Refines the result at the first places.
    fn refined(&self, first: FlankDeviation, exact: &dyn ExactFlank, tolerance: f64) -> FlankDeviation {
        let mut found = first;
        for doubling in 1..=DOUBLINGS {
            let decided = found.bound <= tolerance || !(found.worst.value.abs() <= tolerance);
            if decided || found.folded {
                break;
            }
            let samples = found.samples;
            found = self.at_places(exact, PLACES << doubling);
            found.samples += samples;
        }
        found
    }
}

/// The knot spans of a patch.
fn spans(patch: &Patch, outward: bool) -> Vec<SpanCell<'_>> {
    let across = patch.v.spans();
    let with = |u: (f64, f64)| across.iter().map(move |v| SpanCell { patch, outward, u, v: *v });
    patch.u.spans().into_iter().flat_map(with).collect()
}

/// The result for a knot span, cell by cell; a span that fails at its first places is not refined.
fn of_span(span: &SpanCell<'_>, exact: &dyn ExactFlank, tolerance: f64) -> FlankDeviation {
    let whole = span.at_places(exact, PLACES);
    if whole.folded || !(whole.worst.value.abs() <= tolerance) {
        return whole;
    }
    let (u, v) = (span.u, span.v);
    let corner = |a: f64, b: f64| span.patch.point_and_slopes(a, b)[0];
    let [a, b, c, d] = [corner(u.0, v.0), corner(u.1, v.0), corner(u.0, v.1), corner(u.1, v.1)];
    let count = |first: f64, second: f64| (first.max(second) / CELL).ceil().clamp(1.0, MOST_CELLS);
    let (along, across) = (count((b - a).norm(), (d - c).norm()), count((c - a).norm(), (d - b).norm()));
    if along.max(across) == 1.0 {
        return span.refined(whole, exact, tolerance);
    }
    let part = |range: (f64, f64), of: f64, i: f64| {
        let place = |share: f64| range.0 + (range.1 - range.0) * share;
        (place(i / of), place((i + 1.0) / of))
    };
    let mut found = FlankDeviation::NONE;
    let (mut i, mut j) = (0.0, 0.0);
    while i < along {
        let cell = SpanCell { u: part(u, along, i), v: part(v, across, j), ..*span };
        found = found.with(cell.found(exact, tolerance));
        j += 1.0;
        if j >= across {
            (i, j) = (i + 1.0, 0.0);
        }
    }
    found
}

/// The result for patches, each with whether its own normal points out of the metal, within a tolerance, mm.
pub(super) fn of_patches(patches: &[(Patch, bool)], exact: &dyn ExactFlank, tolerance: f64) -> FlankDeviation {
    let spans: Vec<SpanCell<'_>> = patches.iter().flat_map(|(patch, outward)| spans(patch, *outward)).collect();
    let all: Vec<FlankDeviation> = parallel::map(&spans, |span| of_span(span, exact, tolerance));
    all.into_iter().fold(FlankDeviation::NONE, FlankDeviation::with)
}
