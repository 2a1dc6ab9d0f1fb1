//! Lists of places for a measuring machine: a CSV file, the same places as plain lines of numbers and as a DMIS program (ISO 22093), which
//! measuring programs import, and a sheet on which they are numbered.

use super::super::head::head_lines;
use super::plan::{InspectionList, InspectionPlace};
use super::read::PLAIN_INCHES;
use crate::body::Body;
use crate::report::sheet::Dimensions;
use crate::report::sheet::{Mark, PlaceTable, SheetExtras, SheetKind, compose};
use crate::write::number::{plain, shortest};
use crate::write::{Rendering, svg};
use camgen_kernel::refusal::Refusal;
use camgen_kernel::text::{Length, text};
use camgen_kernel::units::LengthUnit;
use std::sync::Arc;

/// The files of a list: a table, lines of `no x y z nx ny nz`, and a DMIS program.
pub(super) const ENDINGS: [&str; 3] = ["-inspect.csv", "-inspect.txt", "-inspect.dmi"];
/// Its sheet.
pub(super) const SHEET: &str = "-inspect.svg";

/// Decimals of the plain list and of the program, mm.
const DECIMALS: usize = 6;
/// Every how many places one is numbered on the sheet, and every how many are in its tables, the finest first.
const NUMBERED: usize = 10;
const LISTED: [usize; 4] = [5, 10, 20, 30];

/// A list as its files, in the order of their endings, under a mark.
pub(super) fn write(body: &dyn Body, list: &InspectionList, mark: &str) -> Vec<Vec<u8>> {
    let units = body.machine().units();
    let unit = units.symbol();
    let (dmis, decimals) = match units {
        LengthUnit::Millimetre => ("MM", DECIMALS),
        LengthUnit::Inch => ("INCH", DECIMALS + 2),
    };
    let head = head_lines("#", &statements(body, units, units.of_mm(list.ball_radius)));
    let mut table = format!(
        "# {mark}\n{head}no,cam_deg,polar_deg,radius_{unit},x_{unit},y_{unit},normal_x,normal_y,ball_x_{unit},ball_y_{unit},lower_{unit},upper_{unit},\
         curvature_radius_{unit}\n"
    );
    let head = head_lines("$$", &program_statements(body));
    let mut program = format!("DMISMN/'{mark}',05.2\n{head}UNITS/{dmis},ANGDEC\n");
    // Numbers alone do not say what they are: lines in millimetres have no head, those in inches state them.
    let mut lines = if units == LengthUnit::Inch { PLAIN_INCHES.to_owned() + "\n" } else { String::new() };
    for (index, place) in list.places.iter().enumerate() {
        let (number, point, normal) = (index + 1, units.of_mm(1.0) * place.point, place.normal);
        let ball = units.of_mm(1.0) * (place.point + normal * list.ball_radius);
        let of_place =
            [place.cam_deg, place.polar_deg, point.norm(), point.x, point.y, normal.x, normal.y, ball.x, ball.y];
        let zone = [-list.zone, list.zone, place.radius].map(|length| units.of_mm(length));
        let cells: Vec<String> = of_place.into_iter().chain(zone).map(shortest).collect();
        table.push_str(&format!("{number},{}\n", cells.join(",")));
        let numbers = [point.x, point.y, 0.0, normal.x, normal.y, 0.0].map(|number| plain(number, decimals));
        lines.push_str(&format!("{number} {}\n", numbers.join(" ")));
        let there = numbers.join(",");
        program.push_str(&format!(
            "F(P{number})=FEAT/POINT,CART,{there}\nMEAS/POINT,F(P{number}),1\nPTMEAS/CART,{there}\nENDMES\n"
        ));
    }
    program.push_str("ENDFIL\n");
    [table, lines, program].map(String::into_bytes).to_vec()
}

/// The statements in the head of a list as a table in a unit.
pub(super) fn statements(body: &dyn Body, units: LengthUnit, ball_radius: f64) -> Vec<String> {
    let unit = units.symbol();
    let name = if units == LengthUnit::Inch { "inches" } else { "mm" };
    vec![
        format!("machine: {}", machine(body)),
        format!("units: {name}, degrees"),
        format!("ball_radius_{unit}: {}", shortest(ball_radius)),
        "normal: unit vector out of the metal; the ball touches at x, y".to_owned(),
        format!("lower_{unit}, upper_{unit}: zone of the deviation along the normal"),
    ]
}

/// The statements in the head of a list as a DMIS program.
pub(super) fn program_statements(body: &dyn Body) -> Vec<String> {
    let name = machine(body).chars().filter(|c| (' '..='~').contains(c) && !"'$".contains(*c)).collect();
    vec![name, "X0 Y0 as in the drawing: the axis of the shaft; Z0 the plane of the drawing".to_owned()]
}

fn machine(body: &dyn Body) -> String {
    body.machine().name().replace(['\n', '\r'], " ")
}

/// The sheet of a list: the outline with its numbered places, and a table of them.
pub(super) fn sheet(cam: &Rendering<'_>, list: &InspectionList) -> Result<Vec<u8>, Refusal> {
    let mut view = cam.body.part_view(cam.drawn).map_err(Refusal::of)?;
    let numbered = list.places.iter().enumerate().step_by(NUMBERED);
    let label = |(index, place): (usize, &InspectionPlace)| Mark::Label {
        class: "dimensions",
        at: place.point,
        towards: place.normal,
        text: (index + 1).to_string(),
    };
    view.marks = numbered.map(label).collect();
    // Without the sign of a negative 0.
    let units = cam.report.units;
    let length = |value: f64| units.cell((value * 1e3).round() / 1e3 + 0.0);
    let cosine = |value: f64| format!("{:.3}", (value * 1e3).round() / 1e3 + 0.0);
    let cells = |(index, place): (usize, &InspectionPlace)| {
        let (point, normal) = (place.point, place.normal);
        let places = [length(point.x), length(point.y), cosine(normal.x), cosine(normal.y)];
        [vec![(index + 1).to_string()], places.to_vec()].concat()
    };
    let rows = PlaceTable::regular_rows(list.places.iter().enumerate().map(cells));
    let heads = ["no.", "x", "y", "nx", "ny"].map(str::to_owned).to_vec();
    let table = |every: &usize| {
        let title = format!("Places, every {every}th");
        PlaceTable { title, remarks: Vec::new(), heads: heads.clone(), rows: Arc::clone(&rows), every: *every }
    };
    view.tables = LISTED.iter().map(table).collect();
    view.notes = vec![text!(
        "{} places, one for each degree of the cam; ball Ø{}; zone ±{} along the normal",
        list.places.len(),
        Length::mm(2.0 * list.ball_radius),
        Length::mm(list.zone)
    )];
    let deviates = svg::deviation_words(&cam.fit, cam.report.units);
    let (checks, passed_otherwise) = svg::listed_checks(&cam.report.checks, cam.body.machine().catalogue());
    let extras = SheetExtras {
        kind: SheetKind::Inspection,
        files: &[],
        file_deviates: &deviates,
        number: "1/1",
        traces: &[],
        checks: &checks,
        passed_otherwise,
    };
    svg::fill(&compose(&view, cam.report, &extras), cam.template, true, &cam.report.mark())
}
