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
struct StationColumn {
    points: Vec<Vector2<f64>>,
    slopes: Vec<Vector2<f64>>,
}

/// A point of the exact flank in the drawing.
struct FlankPoint {
    /// mm.
    point: Vector2<f64>,
    /// Derivative with respect to the angle, mm/rad.
    slope: Vector2<f64>,
    /// Outward normal in the plane of the cut.
    normal: Vector2<f64>,
}

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

    /// The cut at z (mm) at the angle u, where the sections have these lifts.
    fn point(&self, lifts: &AllStrips, u: f64, z: f64) -> FlankPoint {
        let angle = if self.turned { -u } else { u };
        let Some((frame, ..)) = self.conoid.cut_of(lifts, angle, z / MILLIMETRES) else {
            let nowhere = Vector2::new(f64::NAN, f64::NAN);
            return FlankPoint { point: nowhere, slope: nowhere, normal: nowhere };
        };
        let sense = if self.turned { -1.0 } else { 1.0 };
        FlankPoint {
            point: self.mirrored(frame.point * MILLIMETRES),
            slope: self.mirrored(frame.tangent * (sense * frame.speed * MILLIMETRES)),
            normal: self.mirrored(frame.outward()),
        }
    }

    fn mirrored(&self, v: Vector2<f64>) -> Vector2<f64> {
        if self.turned { Vector2::new(v.x, -v.y) } else { v }
    }

    /// Points and slopes at the stations of an angle.
    fn column(&self, piece: usize, u: f64, stations: &[f64]) -> StationColumn {
        let lifts = self.lifts(piece, u);
        let (points, slopes) =
            stations.iter().map(|z| self.point(&lifts, u, *z)).map(|found| (found.point, found.slope)).unzip();
        StationColumn { points, slopes }
    }

    fn stretches(&self) -> Vec<AngleStretch> {
        let mut stretches = Vec::new();
        for (piece, span) in self.conoid.pieces().iter().enumerate() {
            let whole = span.end - span.start;
            let count = (whole / LONGEST - 1e-9).ceil().max(1.0);
            let mut i = 0.0;
            while i < count {
                let start = span.start + whole * i / count;
                let end = if i + 1.0 < count { span.start + whole * (i + 1.0) / count } else { span.end };
                stretches.push(AngleStretch { piece, start, end });
                i += 1.0;
            }
        }
        if self.turned {
            let mirrored = stretches.iter().rev();
            return mirrored.map(|s| AngleStretch { piece: s.piece, start: -s.end, end: -s.start }).collect();
        }
        stretches
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
    let mut angles: Vec<f64> =
        (0..spans).map(|i| stretch.start + (stretch.end - stretch.start) * f64::from(i) / f64::from(spans)).collect();
    angles.push(stretch.end);
    let columns: Vec<StationColumn> = angles.iter().map(|u| exact.column(stretch.piece, *u, places)).collect();
    let heights = Spline::not_a_knot(places, places).controls();
    let mut controls = vec![vec![Point3::new(0.0, 0.0, 0.0); heights.len()]; angles.len() + 2];
    for axis in 0..2 {
        let values: Vec<Vec<f64>> = columns.iter().map(|column| component(places, &column.points, axis)).collect();
        let [first, last] = [columns.first(), columns.last()]
            .map(|column| column.map(|column| component(places, &column.slopes, axis)).unwrap_or_default());
        for (v, z) in heights.iter().enumerate() {
            let row: Vec<f64> = values.iter().map(|list| entry(list, v)).collect();
            let around = Spline::clamped(&angles, &row, (entry(&first, v), entry(&last, v))).controls();
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

/// Control values along the axis of a component of vectors at the stations.
fn component(stations: &[f64], vectors: &[Vector2<f64>], axis: usize) -> Vec<f64> {
    let values: Vec<f64> = vectors.iter().map(|v| v.get(axis).copied().unwrap_or(f64::NAN)).collect();
    Spline::not_a_knot(stations, &values).controls()
}

fn entry(list: &[f64], index: usize) -> f64 {
    list.get(index).copied().unwrap_or(f64::NAN)
}

/// Largest distance of a patch from the exact surface at the middles of its spans, along the normal in the plane of the
/// cut: between the angles on the stations, and between the stations.
fn deviation(exact: &ExactFlank<'_>, stretch: AngleStretch, patch: &SplineSurface) -> [f64; 2] {
    let (angles, places) = (joints(&patch.u), joints(&patch.v));
    let (angles_between, places_between) = (middles(angles), middles(places));
    let both = distance(exact, stretch.piece, patch, &angles_between, &places_between);
    [
        distance(exact, stretch.piece, patch, &angles_between, places),
        larger(distance(exact, stretch.piece, patch, angles, &places_between), both),
    ]
}

/// The knots at which spans meet.
fn joints(knots: &[f64]) -> &[f64] {
    knots.get(3..knots.len().saturating_sub(3)).unwrap_or_default()
}

fn middles(list: &[f64]) -> Vec<f64> {
    list.iter().zip(list.iter().skip(1)).map(|(a, b)| 0.5 * (a + b)).collect()
}

/// Largest distance of a patch from the exact surface at these angles and axial positions (mm), mm.
fn distance(exact: &ExactFlank<'_>, piece: usize, patch: &SplineSurface, angles: &[f64], places: &[f64]) -> f64 {
    let mut largest = 0.0;
    for u in angles {
        let lifts = exact.lifts(piece, *u);
        for v in places {
            let FlankPoint { point, normal, .. } = exact.point(&lifts, *u, *v);
            let [found, ..] = patch.point_and_slopes(*u, *v);
            largest = larger(largest, (found.xy() - point).dot(&normal).abs());
        }
    }
    largest
}

/// Abscissae and weights of Gauss' rule with four points on [0, 1]: exact to the seventh power, and the integrand has the
/// fifth and the sixth (Abramowitz & Stegun, table 25.4).
const GAUSS: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// Start and width of every span.
fn spans(knots: &[f64]) -> Vec<(f64, f64)> {
    knots.iter().zip(knots.iter().skip(1)).filter(|(a, b)| a < b).map(|(a, b)| (*a, b - a)).collect()
}

/// Volume between a patch and the axis, mm³: ∫∫ (x y_u − y x_u)/2 du dv, since v is the height.
fn volume(patch: &SplineSurface) -> f64 {
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
