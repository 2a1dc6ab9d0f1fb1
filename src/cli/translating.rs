//! `camgen translating`: solve, check, write, report.

use super::args::{SolverKind, TranslatingArgs};
use super::cut::{self, Cut};
use super::{Failure, Outcome};
use camgen::cam::plate::{LAW_TOLERANCE, Plate};
use camgen::drawing::{self, sheet};
use camgen::law::translating::Solver;

/// Stations of the paper's solver when none are asked for: its error is then a hundredth of a millimetre.
const STATIONS: u32 = 1800;

pub(super) fn run(args: &TranslatingArgs) -> Result<Outcome, Failure> {
    let (machine, machine_name) = args.common.machine()?;
    let rpm = args.common.one_speed(&machine)?;
    let (tolerance, files) = (args.common.tolerance(), &args.files);
    let template = cut::template(files)?;
    let solver = match (args.solver, args.stations) {
        (SolverKind::Paper, stations) => Solver::Paper { stations: stations.unwrap_or(STATIONS) },
        (SolverKind::Ode, None) => Solver::Ode { tolerance: LAW_TOLERANCE },
        (SolverKind::Ode, Some(_)) => {
            return Err(Failure("--stations belongs to --solver paper; the solver ode chooses its own steps".into()));
        }
    };
    let plate = Plate::solve(&machine, rpm, solver, args.balance.exact()).map_err(Failure::new)?;
    cut::cut(&Cut {
        cam: &plate,
        common: &args.common,
        files,
        template: &template,
        stem: &files.stem(&machine_name, "translating", rpm),
        part: &|| drawing::plate_part(&plate, files.fit(tolerance)),
        report: &|part, rolled, findings| drawing::plate_report(&plate, part, rolled, tolerance, findings),
        sheet: &|part, report| sheet::plate(&plate, part, report),
        table: &|| drawing::plate_table(&plate, files.samples),
        more: &|| Ok(Vec::new()),
    })
}
