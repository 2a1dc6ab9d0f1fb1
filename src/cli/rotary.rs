//! `camgen rotary`: solve, check, write, report.

use super::args::RotaryArgs;
use super::cut::{self, Cut};
use super::{Failure, Outcome};
use camgen::cam::rotary::Rotary;
use camgen::drawing::{self, Entity, Layer, sheet};
use camgen::output::dxf;
use camgen::output::files::Output;

pub(super) fn run(args: &RotaryArgs) -> Result<Outcome, Failure> {
    let (mut machine, machine_name) = args.common.machine()?;
    let rpm = args.common.one_speed(&machine)?;
    let (tolerance, files) = (args.common.tolerance(), &args.files);
    let template = cut::template(files)?;
    if let Some(radius) = args.cutter {
        // The cutter that is asked for is the one that has to get in.
        let limit = &mut machine.limits.cutter_radius;
        *limit = Some(limit.map_or(radius, |other| other.max(radius)));
    }
    let rotary = Rotary::solve(&machine, rpm).map_err(Failure::new)?;
    let stem = files.stem(&machine_name, "rotary", rpm);
    let cutter = || -> Result<Vec<Output>, Failure> {
        let Some(radius) = args.cutter else { return Ok(Vec::new()) };
        let path = drawing::cutter_path(&rotary, radius, tolerance).map_err(Failure::new)?;
        let entities = [(Layer::CutterPath, Entity::Polyline(path.contour))];
        Ok(vec![Output { name: format!("{stem}-cutter.dxf"), bytes: dxf::write(&entities, files.dxf_version) }])
    };
    cut::cut(&Cut {
        cam: &rotary,
        common: &args.common,
        files,
        template: &template,
        stem: &stem,
        part: &|| drawing::part(&rotary, files.fit(tolerance)),
        report: &|part, rolled, findings| drawing::report(&rotary, part, rolled, tolerance, findings),
        sheet: &|part, report| sheet::disc(&rotary, part, report),
        table: &|| drawing::table(&rotary, files.samples),
        more: &cutter,
    })
}
