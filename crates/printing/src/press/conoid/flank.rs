//! The flank of a conoid as bicubic B-spline patches in millimetres, within a tolerance of the exact surface.
//!
//! The surface is cut at stations along the axis; each cut is interpolated over the cam angle by cubic splines whose ends
//! have the exact tangents, the cuts along the axis by a not-a-knot spline. Both are linear, so the control points follow
//! one direction after the other. A patch ends where the law has a break and at the latest after 30°: then even a reader
//! that integrates edge by edge finds the mass.

use super::{AllStrips, Conoid};
use camgen_cams::body::Flank;
use camgen_cams::machine::Rotation;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::solid::SplineSurface;
use camgen_kernel::numeric::extremum::larger;
use camgen_kernel::numeric::parallel;
use camgen_kernel::numeric::spline::{Spline, bspline_knots};
use camgen_kernel::refusal::Refusal;
use nalgebra::Vector2;
use truck_modeling::Point3;

/// Points and slopes of one cam angle at the stations.
type StationColumn = (Vec<Vector2<f64>>, Vec<Vector2<f64>>);

/// Longest patch, rad.
const LONGEST: f64 = std::f64::consts::PI / 6.0;
/// Spans of a patch and stations between two sections to begin with, and how often either is doubled.
const SPANS: u32 = 4;
const STATIONS: u32 = 2;
const DOUBLINGS: u32 = 6;
/// The most spans of a patch.
const LARGEST: u32 = SPANS << (DOUBLINGS - 1);
/// Share of the tolerance the splines may take at the points where they are compared, the middles of the spans: between
/// those the error of a cubic interpolant is no more than a quarter larger.
const SHARE: f64 = 0.6;

/// A stretch of the drawing's polar angle within one piece of the law.
#[derive(Debug, Clone, Copy)]
struct AngleStretch {
    piece: usize,
    start: f64,
    end: f64,
}

/// The exact surface as it lies in the drawing.
struct ExactFlank<'a> {
    conoid: &'a Conoid,
    turned: bool,
}

impl ExactFlank<'_> {
    /// The lifts of the sections at the angle u.
    fn lifts(&self, piece: usize, u: f64) -> AllStrips {
        self.conoid.all_lifts(piece, if self.turned { -u } else { u })
    }

    /// Point (mm), derivative by the angle and outward normal in the plane, where the cut at z (mm) has the angle u, at which the
    /// sections have these lifts.
    fn at(&self, lifts: &AllStrips, u: f64, z: f64) -> (Vector2<f64>, Vector2<f64>, Vector2<f64>) {
        let angle = if self.turned { -u } else { u };
        let nowhere = Vector2::new(f64::NAN, f64::NAN);
        let Some((frame, ..)) = self.conoid.cut_of(lifts, angle, z / MILLIMETRES) else {
            return (nowhere, nowhere, nowhere);
        };
        let mirrored = |v: Vector2<f64>| if self.turned { Vector2::new(v.x, -v.y) } else { v };
        let sense = if self.turned { -1.0 } else { 1.0 };
        let slope = frame.tangent * (sense * frame.speed * MILLIMETRES);
        (mirrored(frame.point * MILLIMETRES), mirrored(slope), mirrored(frame.outward()))
    }

    fn stretches(&self) -> Vec<AngleStretch> {
        let of_piece = |(piece, span): (usize, &camgen_kernel::motion::Piece)| {
            let count = ((span.end - span.start) / LONGEST - 1e-9).ceil().max(1.0);
            let mut stretches = Vec::new();
            let mut i = 0.0;
            while i < count {
                let place = |share: f64| span.start + (span.end - span.start) * share / count;
                stretches.push(AngleStretch {
                    piece,
                    start: place(i),
                    end: if i + 1.0 < count { place(i + 1.0) } else { span.end },
                });
                i += 1.0;
            }
            stretches
        };
        let stretches: Vec<AngleStretch> = self.conoid.pieces().iter().enumerate().flat_map(of_piece).collect();
        if self.turned {
            let mirror = |s: &AngleStretch| AngleStretch { piece: s.piece, start: -s.end, end: -s.start };
            stretches.iter().rev().map(mirror).collect()
        } else {
            stretches
        }
    }
}

/// Places along the axis (mm) at which the surface is cut: the sections, `parts` to each interval, and the ends.
fn stations(conoid: &Conoid, parts: u32) -> Vec<f64> {
    let (low, high) = conoid.ends();
    let mut joints: Vec<f64> = conoid.positions.iter().copied().chain([low, high]).collect();
    joints.sort_by(f64::total_cmp);
    joints.dedup();
    let pairs = joints.iter().zip(joints.iter().skip(1));
    let inner = pairs.flat_map(|(a, b)| (0..parts).map(move |i| a + (b - a) * f64::from(i) / f64::from(parts)));
    inner.chain(joints.last().copied()).map(|z| MILLIMETRES * z).collect()
}

/// The flank of a conoid within `tolerance` (mm).
///
/// # Errors
/// [`Refusal`] when the tolerance is finer than splines of a reasonable size can keep.
pub fn flank(conoid: &Conoid, tolerance: f64) -> Result<Flank, Refusal> {
    let exact = ExactFlank { conoid, turned: conoid.machine.cam.rotation == Rotation::CounterClockwise };
    let stretches = exact.stretches();
    let (mut spans, mut parts) = (SPANS, STATIONS);
    let mut found = f64::INFINITY;
    for _ in 0..DOUBLINGS {
        let places = stations(conoid, parts);
        let patches: Vec<SplineSurface> = parallel::map(&stretches, |s| patch(&exact, *s, spans, &places));
        let pairs: Vec<(AngleStretch, &SplineSurface)> = stretches.iter().copied().zip(&patches).collect();
        let worst: Vec<[f64; 2]> = parallel::map(&pairs, |(stretch, patch)| deviation(&exact, *stretch, patch));
        let [along, across] = worst.iter().fold([0.0_f64; 2], |[a, b], [c, d]| [larger(a, *c), larger(b, *d)]);
        found = larger(along, across);
        if found <= SHARE * tolerance {
            let volume = patches.iter().map(volume).sum();
            return Ok(Flank { patches, deviation: found, volume });
        }
        if !(along <= 0.5 * SHARE * tolerance) {
            spans *= 2;
        }
        if !(across <= 0.5 * SHARE * tolerance) {
            parts *= 2;
        }
    }
    Err(Refusal::new(format!(
        "the flank of the solid would need more than {LARGEST} spline spans between two breaks or sections: they keep \
         {found:.2e} mm \
         where {:e} mm are required",
        SHARE * tolerance
    ))
    .remedy(format!("give a tolerance of {:.1e} mm, or leave out the solid (--format dxf,csv)", 2.0 * found / SHARE)))
}

/// One patch: `spans` spans over the angle, a station for each of `places` along the axis.
fn patch(exact: &ExactFlank<'_>, stretch: AngleStretch, spans: u32, places: &[f64]) -> SplineSurface {
    let angle = |i: u32| {
        if i == spans {
            stretch.end
        } else {
            stretch.start + (stretch.end - stretch.start) * f64::from(i) / f64::from(spans)
        }
    };
    let angles: Vec<f64> = (0..=spans).map(angle).collect();
    // Control values along the axis of a quantity known at the stations.
    let along_axis = |values: &[f64]| Spline::not_a_knot(places, values).controls();
    let column = |u: &f64| -> StationColumn {
        let lifts = exact.lifts(stretch.piece, *u);
        places.iter().map(|z| exact.at(&lifts, *u, *z)).map(|(p, d, _)| (p, d)).unzip()
    };
    let columns: Vec<StationColumn> = angles.iter().map(column).collect();
    let component = |vectors: &[Vector2<f64>], axis: usize| -> Vec<f64> {
        along_axis(&vectors.iter().map(|v| v.get(axis).copied().unwrap_or(f64::NAN)).collect::<Vec<f64>>())
    };
    let heights = along_axis(places);
    let mut controls = vec![vec![Point3::new(0.0, 0.0, 0.0); heights.len()]; angles.len() + 2];
    for axis in 0..2 {
        let values: Vec<Vec<f64>> = columns.iter().map(|(points, _)| component(points, axis)).collect();
        let slope =
            |column: Option<&StationColumn>| column.map(|(_, slopes)| component(slopes, axis)).unwrap_or_default();
        let (first, last) = (slope(columns.first()), slope(columns.last()));
        for (v, z) in heights.iter().enumerate() {
            let at = |list: &Vec<f64>| list.get(v).copied().unwrap_or(f64::NAN);
            let row: Vec<f64> = values.iter().map(at).collect();
            let around = Spline::clamped(&angles, &row, (at(&first), at(&last))).controls();
            for (u, value) in around.into_iter().enumerate() {
                if let Some(point) = controls.get_mut(u).and_then(|row| row.get_mut(v)) {
                    *if axis == 0 { &mut point.x } else { &mut point.y } = value;
                    point.z = *z;
                }
            }
        }
    }
    SplineSurface { u: bspline_knots(&angles), v: bspline_knots(places), controls }
}

/// Largest distance of a patch from the exact surface at the middles of its spans, along the normal in the plane of the
/// cut: between the angles on the stations, and between the stations.
fn deviation(exact: &ExactFlank<'_>, stretch: AngleStretch, patch: &SplineSurface) -> [f64; 2] {
    let joints =
        |knots: &[f64]| -> Vec<f64> { knots.get(3..knots.len().saturating_sub(3)).unwrap_or_default().to_vec() };
    let middles =
        |list: &[f64]| -> Vec<f64> { list.iter().zip(list.iter().skip(1)).map(|(a, b)| 0.5 * (a + b)).collect() };
    let (angles, places) = (joints(&patch.u), joints(&patch.v));
    let off = |lifts: &AllStrips, u: f64, v: f64| {
        let (point, _, normal) = exact.at(lifts, u, v);
        let [found, ..] = patch.point_and_slopes(u, v);
        (found.xy() - point).dot(&normal).abs()
    };
    let over = |angles: &[f64], places: &[f64]| {
        let at_angle = |u: &f64| {
            let lifts = exact.lifts(stretch.piece, *u);
            places.iter().map(|v| off(&lifts, *u, *v)).fold(0.0, larger)
        };
        angles.iter().map(at_angle).fold(0.0, larger)
    };
    let both = over(&middles(&angles), &middles(&places));
    [over(&middles(&angles), &places), larger(over(&angles, &middles(&places)), both)]
}

/// Abscissae and weights of Gauss' rule with four points on [0, 1]: exact to the seventh power, and the integrand has the
/// fifth and the sixth (Abramowitz & Stegun, table 25.4).
const GAUSS: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// Volume between a patch and the axis, mm³: ∫∫ (x y_u − y x_u)/2 du dv, since v is the height.
fn volume(patch: &SplineSurface) -> f64 {
    let spans = |knots: &[f64]| -> Vec<(f64, f64)> {
        knots.iter().zip(knots.iter().skip(1)).filter(|(a, b)| a < b).map(|(a, b)| (*a, b - a)).collect()
    };
    let mut volume = 0.0;
    for (u, width) in spans(&patch.u) {
        for (v, height) in spans(&patch.v) {
            for (a, wa) in GAUSS {
                for (b, wb) in GAUSS {
                    let [p, d, _] = patch.point_and_slopes(u + a * width, v + b * height);
                    volume += 0.5 * (p.x * d.y - p.y * d.x) * wa * wb * width * height;
                }
            }
        }
    }
    volume
}
