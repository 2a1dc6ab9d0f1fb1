//! Lists of places for a measuring machine: a CSV file, and the same places as plain lines of numbers that measuring programs import.

use super::number::{plain, shortest};
use super::{Format, FormatSelection, of_outlines};
use crate::body::Body;
use crate::body::inspection::{self, InspectionList};
use crate::refusal::Refusal;

/// The lists of every outline, as they were proved: `-inspect.csv`, and `-inspect.txt` as lines of `no x y z nx ny nz`.
pub const FORMAT: Format = Format {
    name: "inspect",
    when: FormatSelection::Asked,
    flank: false,
    unfit: inspection::unfit,
    endings: |drawn| {
        let tables = of_outlines(drawn, "-inspect.csv");
        tables.into_iter().chain(of_outlines(drawn, "-inspect.txt")).collect()
    },
    write: |cam| match cam.inspections {
        [] => Err(Refusal::new("no list of places was requested with the drawing")),
        proved => {
            let tables = proved.iter().map(|(table, _)| table.clone());
            Ok(tables.chain(proved.iter().map(|(_, plain)| plain.clone())).collect())
        }
    },
    of_analysis: None,
};

/// Decimals of the plain list, mm.
const DECIMALS: usize = 6;

/// A list as its two files, under a mark.
#[must_use]
pub fn write(body: &dyn Body, list: &InspectionList, mark: &str) -> (Vec<u8>, Vec<u8>) {
    let mut table = format!(
        "# {mark}\n# machine: {}\n# units: mm, degrees\n# ball_radius_mm: {}\n# normal: unit vector out of the metal; the ball touches at x, y\n\
         # lower_mm, upper_mm: zone of the deviation along the normal\n\
         no,cam_deg,polar_deg,radius_mm,x_mm,y_mm,normal_x,normal_y,ball_x_mm,ball_y_mm,lower_mm,upper_mm,curvature_radius_mm\n",
        body.machine().name().replace(['\n', '\r'], " "),
        shortest(list.ball_radius)
    );
    let mut lines = String::new();
    for (index, place) in list.places.iter().enumerate() {
        let (point, normal) = (place.point, place.normal);
        let ball = point + normal * list.ball_radius;
        let of_place =
            [place.cam_deg, place.polar_deg, point.norm(), point.x, point.y, normal.x, normal.y, ball.x, ball.y];
        let zone = [-list.zone, list.zone, place.radius];
        let cells: Vec<String> = of_place.into_iter().chain(zone).map(shortest).collect();
        table.push_str(&format!("{},{}\n", index + 1, cells.join(",")));
        let numbers = [point.x, point.y, 0.0, normal.x, normal.y, 0.0].map(|number| plain(number, DECIMALS));
        lines.push_str(&format!("{} {}\n", index + 1, numbers.join(" ")));
    }
    (table.into_bytes(), lines.into_bytes())
}
