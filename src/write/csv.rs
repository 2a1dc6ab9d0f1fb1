//! Tables as CSV: a header line, then numbers, the shortest that round-trip, unquoted.

use super::number::push_shortest;
use super::{Format, When, fits_all};
use crate::body::Body;
use crate::geometry::MILLIMETRES;
use crate::motion::Quantity;
use crate::profile::followed::Followed;
use crate::table::Table;
use crate::verify::WrittenOutline;

/// The point table.
pub const FORMAT: Format = Format {
    name: "csv",
    when: When::Usual,
    flank: false,
    unfit: fits_all,
    endings: |_| vec![".csv".into()],
    write: |cam| Ok(vec![write(&table(cam.body, cam.outlines, cam.samples))]),
};

/// The point table of a cam, with what its follower does on the outline as written.
#[must_use]
pub fn table(body: &dyn Body, outlines: &[WrittenOutline], samples: u32) -> Table {
    let mut rows = body.rows(samples);
    if let (Some(curves), Some(outline)) = (body.plane(), outlines.first()) {
        let motion = curves.motion;
        let followed = Followed::on(curves, &outline.contour, body.mirrored());
        for row in &mut rows {
            let place = row.cam_deg.map(f64::to_radians).or(row.bed.map(|bed| bed.x / MILLIMETRES));
            let cut = place.and_then(|place| {
                let (first, second) = motion.pace(place);
                let cut = followed.at(place)?;
                Some([cut.ds * first, cut.dds * first * first + cut.ds * second])
            });
            row.swings = motion.quantity() == Quantity::Angle;
            row.cut = Some(cut.unwrap_or([f64::NAN; 2]));
        }
    }
    Table::of(&rows)
}

/// The table as text with line feeds.
#[must_use]
pub fn write(table: &Table) -> Vec<u8> {
    let mut text = table.columns.join(",");
    text.push('\n');
    for row in &table.rows {
        for (index, value) in row.iter().enumerate() {
            if index > 0 {
                text.push(',');
            }
            push_shortest(&mut text, *value);
        }
        text.push('\n');
    }
    text.into_bytes()
}
