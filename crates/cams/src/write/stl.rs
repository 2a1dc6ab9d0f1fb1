//! The conoid as a binary STL file in millimetres, for a first print: triangles on the exact surface.

use super::{FormatSelection, View};
use crate::body::Flank;
use crate::body::mesh::Mesh;
use camgen_kernel::geometry::MILLIMETRES;
use nalgebra::Vector3;

/// Triangles on the flank of a conoid.
pub const FORMAT: View = View {
    name: "stl",
    when: FormatSelection::Asked,
    flank: true,
    unfit: |body| body.surface().is_none().then_some("stl is for a conoid; use step for a plane cam"),
    endings: |_| vec![".stl".into()],
    write: |cam| {
        let bore = cam.body.machine().cam.bore_radius.map(|radius| MILLIMETRES * radius);
        let title = format!("millimetres, {}", cam.report.mark());
        Ok(cam.drawn.flank.iter().map(|flank| write(flank, bore, &title)).collect())
    },
    of_analysis: None,
};

/// Triangles as binary STL: 80 bytes of header, a count, 50 bytes a triangle.
#[must_use]
pub fn write(flank: &Flank, bore_radius: Option<f64>, title: &str) -> Vec<u8> {
    let mesh = Mesh::new(flank, bore_radius);
    let mut bytes = vec![b' '; 80];
    for (place, byte) in bytes.iter_mut().zip(title.bytes()) {
        *place = byte;
    }
    // Corners that coincide in single precision make no triangle.
    #[expect(clippy::cast_possible_truncation, reason = "STL holds single precision")]
    let single = |p: &Vector3<f64>| p.map(|value| value as f32);
    let whole = |[a, b, c]: &&[Vector3<f64>; 3]| {
        let (a, b, c) = (single(a), single(b), single(c));
        a != b && b != c && c != a
    };
    let triangles: Vec<&[Vector3<f64>; 3]> = mesh.triangles.iter().filter(whole).collect();
    bytes.extend(u32::try_from(triangles.len()).unwrap_or(u32::MAX).to_le_bytes());
    for corners in triangles {
        let [a, b, c] = corners;
        let normal = (b - a).cross(&(c - a)).normalize();
        for vector in [&normal, a, b, c] {
            for value in vector.iter() {
                #[expect(clippy::cast_possible_truncation, reason = "STL holds single precision")]
                bytes.extend((*value as f32).to_le_bytes());
            }
        }
        bytes.extend([0, 0]);
    }
    bytes
}
