//! Triangles of a conoid on the splines of its flank.

use super::Flank;
use nalgebra::Vector3;

/// Triangles of a conoid, counter-clockwise seen from outside, mm.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    /// Corners.
    pub triangles: Vec<[Vector3<f64>; 3]>,
}

/// Rings of a mesh along the axis, and points of a patch along a ring.
const RINGS: u32 = 48;
const RING_POINTS: u32 = 24;

impl Mesh {
    /// A grid on the flank, caps, and the wall of a round bore (radius in mm) or, without one, caps to the axis.
    #[must_use]
    pub fn new(flank: &Flank, bore_radius: Option<f64>) -> Self {
        let ring = |ring: u32| -> Vec<Vector3<f64>> {
            let share = f64::from(ring) / f64::from(RINGS);
            let points = flank.patches.iter().flat_map(|patch| {
                let [(u0, u1), (v0, v1)] = patch.range();
                (0..RING_POINTS).map(move |i| {
                    let [point, ..] = patch.point_and_slopes(
                        u0 + (u1 - u0) * f64::from(i) / f64::from(RING_POINTS),
                        v0 + (v1 - v0) * share,
                    );
                    point
                })
            });
            points.collect()
        };
        let rings: Vec<Vec<Vector3<f64>>> = (0..=RINGS).map(ring).collect();
        let mut triangles = Vec::new();
        let mut band = |a: &[Vector3<f64>], b: &[Vector3<f64>]| {
            let next = |list: &[Vector3<f64>], i: usize| list.get((i + 1) % list.len()).copied();
            for (i, (p, q)) in a.iter().zip(b).enumerate() {
                let (Some(p1), Some(q1)) = (next(a, i), next(b, i)) else { continue };
                for corners in [[*p, p1, q1], [*p, q1, *q]] {
                    // At the axis a band is a fan: half of its triangles have no area.
                    let [a, b, c] = corners;
                    if (b - a).cross(&(c - a)).norm_squared() > 0.0 {
                        triangles.push(corners);
                    }
                }
            }
        };
        for (a, b) in rings.iter().zip(rings.iter().skip(1)) {
            band(a, b);
        }
        let hole = |ring: &[Vector3<f64>]| -> Vec<Vector3<f64>> {
            let radius = bore_radius.unwrap_or(0.0);
            ring.iter()
                .map(|p| {
                    let out = p.xy().normalize() * radius;
                    Vector3::new(out.x, out.y, p.z)
                })
                .collect()
        };
        if let (Some(first), Some(last)) = (rings.first(), rings.last()) {
            let (under, above) = (hole(first), hole(last));
            band(&under, first);
            band(last, &above);
            if bore_radius.is_some() {
                band(&above, &under);
            }
        }
        Self { triangles }
    }
}
