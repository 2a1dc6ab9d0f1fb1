//! What holds for every entry of a table of the library, whatever it is: laws, followers, checks, formats, columns, bodies.
//! A new entry is held to the same as soon as it stands in its table.

use crate::common::program::{camgen, camgen_in, files, report};
use camgen::analysis;
use camgen::body::{Kind, Request};
use camgen::catalogue::{analyses, checks, kinds};
use camgen::check::CheckScope;
use camgen::document::Key;
use camgen::document::Presence::Required;
#[cfg(feature = "brake")]
use camgen::domains::brake::{self, BrakeMachine, BrakeOutput};
use camgen::domains::press::SpecOfPress;
use camgen::domains::press::buffer::regime::Reset;
use camgen::domains::press::machine::DriveMachine;
use camgen::domains::press::motion::equation_18::{ExactOn, Solver};
use camgen::domains::press::wedge::LAW_TOLERANCE;
use camgen::domains::shaft::machine::ShaftMachine;
use camgen::domains::{linkage, press, shaft};
use camgen::follower::{FOLLOWERS, FollowerKind};
use camgen::geometry::lead_in::{LeadIn, LeadInForm};
use camgen::machine::Machine;
use camgen::motion::laws::{LAWS, LINE};
use camgen::pipeline::{Assembly, Cam, Error, Judged, Proven, Spec, Writing};
use camgen::report::{Report, Verdict};
use camgen::table::COLUMNS;
use camgen::tool_files::{formats, formats_by_name, requested};
use camgen::write::FormatSelection;
use std::fs;

const LIFTER: &str = include_str!("common/lifter.toml");
const TOLERANCE: f64 = 5e-6;
const SPEEDS: [f64; 2] = [20.0, 35.0];
const SPRING: [&str; 2] = ["compensator.spring_rate=100N/mm", "compensator.preload=10kN"];

fn lifter(text: &str, overrides: &[&str]) -> Spec {
    let overrides: Vec<String> = overrides.iter().map(|&set| set.to_owned()).collect();
    let machine = Machine::from_toml("lifter.toml", text, &overrides).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let (motion, rpm) = machine.motion().expect("a motion");
    Spec::of_motion(machine, motion, rpm)
}

/// A turret that is moved on.
const INDEXER: &str = include_str!("../../profiles/indexer.toml");

/// A cam of each kind. A new kind of body needs a line here.
fn cam_of(kind: &Kind, overrides: &[&str]) -> Cam {
    let owned: Vec<String> = overrides.iter().map(|&set| set.to_owned()).collect();
    let dpi = || Machine::load("dpi", &owned).unwrap_or_else(|error| panic!("{error}")).0;
    let spec = match kind.command {
        "rotary" => Spec::rotary(dpi(), 35.0),
        "compensator" => {
            let sets = SPRING.map(str::to_owned).into_iter().chain(owned.iter().cloned()).collect::<Vec<_>>();
            Spec::compensator(Machine::load("dpi", &sets).unwrap_or_else(|error| panic!("{error}")).0, 35.0)
        }
        "counter" => {
            let sets = [&["cam.body=conjugate"], overrides].concat().into_iter().map(str::to_owned).collect::<Vec<_>>();
            let machine = Machine::from_toml("lifter.toml", LIFTER, &sets).unwrap_or_else(|error| panic!("{error}"));
            Spec::made_with_program(machine, None, "counter").expect("a motion")
        }
        "translating" => Spec::translating(dpi(), 35.0, Solver::Ode { tolerance: LAW_TOLERANCE }, ExactOn::Braking),
        "conoid" => Spec::conoid(dpi(), SPEEDS.to_vec(), None),
        "make" => {
            let own: &[&str] = match kind.keys {
                "groove" => &["cam.body=groove", "cam.groove_depth=6mm", "cam.clearance=0.05mm"],
                "ring" => &["cam.body=ring", "follower.roller.preload=100N"],
                "conjugate" => &["cam.body=conjugate"],
                "rib" => &["cam.body=rib", "cam.roller_distance=30mm"],
                "yoke" => &["cam.body=yoke"],
                "barrel" => &["cam.body=barrel", "cam.groove_depth=8mm", "cam.outer_radius=auto"],
                "tapered-barrel" => &["cam.body=tapered-barrel", "cam.groove_depth=8mm", "cam.outer_radius=auto"],
                "wedge" => &["cam.body=wedge", "follower.roller.preload=100N"],
                _ => &[],
            };
            // The second half turn of a yoke follows from the first.
            let first_half = LIFTER.replace("[[motion.segment]]\nto = \"0 mm\"\n", "");
            // A plate travels by a length for each degree.
            let plate = LIFTER.replace("rpm = 120", "stroke = \"360 mm\"").replace(" deg\"", " mm\"");
            let text = match kind.keys {
                "yoke" => &first_half,
                "wedge" => &plate,
                "globoid" => INDEXER,
                _ => LIFTER,
            };
            lifter(text, &[own, overrides].concat())
        }
        #[cfg(feature = "brake")]
        "brake-cam" => {
            let brake = BrakeMachine::load(camgen::catalogue::catalogue(), "roll", &owned, BrakeOutput::Disc)
                .unwrap_or_else(|error| panic!("{error}"))
                .0;
            let motion = std::sync::Arc::new(brake.brake_disc().expect("a law"));
            brake::spec(&brake, motion).expect("a disc")
        }
        other => panic!("no cam of the kind {other} here"),
    };
    let cam = spec.solve().unwrap_or_else(|error| panic!("{}: {error}", kind.command));
    assert_eq!(cam.body().kind(), kind);
    cam
}

/// The lifter under every follower, each described by the keys its table asks for and no others.
fn cams_of_followers() -> Vec<(&'static str, Cam)> {
    let (head, _) = LIFTER.split_once("[follower.roller]").expect("a follower");
    let in_degrees = head.replace(" mm", " deg");
    let cam_of = |kind: &FollowerKind| {
        let section = kind.section;
        let key = |key: &Key| match key.presence {
            Required(example) => format!("{} = {}\n", key.name, key.in_toml(example)),
            _ => String::new(),
        };
        let keys: String = section.keys.iter().map(key).collect();
        // It takes a lift in millimetres or in degrees.
        let solved = [head, &in_degrees].map(|motion| {
            let text = format!("{motion}[{}]\n{keys}", section.path);
            let machine = Machine::from_toml("lifter.toml", &text, &[]).map_err(|error| error.to_string())?;
            let (motion, rpm) = machine.motion().ok_or("no motion")?;
            Spec::of_motion(machine, motion, rpm).solve().map_err(|error| error.to_string())
        });
        match solved {
            [Ok(cam), _] | [_, Ok(cam)] => (section.path, cam),
            [Err(length), Err(angle)] => panic!("[{}]\nin millimetres: {length}\nin degrees: {angle}", section.path),
        }
    };
    FOLLOWERS.iter().map(cam_of).collect()
}

/// The kinds that a command makes by itself: the compensating cam is made with the cam whose torque it takes, the disc of a brake with
/// the figures of the brake.
fn commands() -> impl Iterator<Item = &'static Kind> {
    kinds().filter(|kind| kind.command == kind.keys && kind.command != "brake-cam")
}

/// The same cam as a user asks for it.
fn command_of(kind: &Kind) -> Vec<&'static str> {
    match kind.command {
        "make" => vec!["make", "lifter.toml"],
        "conoid" => vec!["conoid", "--rpm", "20,35"],
        command => vec![command],
    }
}

/// A cam of a press with the one that takes its torque.
fn two_discs() -> Assembly {
    let machine = Machine::load("dpi", &SPRING.map(str::to_owned)).expect("valid").0;
    Spec::rotary(machine, 35.0).assemble().expect("two discs")
}

fn report_of(cam: &Cam) -> Report {
    let request = Request { flank: true, ..Request::within(TOLERANCE) };
    cam.draw(request).expect("an outline").prove().expect("a proof").report()
}

fn names_are_distinct(mut names: Vec<&str>) {
    let all = names.len();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), all, "{names:?}");
}

#[test]
fn every_format_is_written_for_every_cam_it_fits_and_refused_for_the_others() {
    for kind in commands() {
        let cam = cam_of(kind, &[]);
        for format in formats_by_name() {
            let directory = tempfile::tempdir().expect("a directory");
            fs::write(directory.path().join("lifter.toml"), LIFTER).expect("written");
            let rest = ["--name", "cam", "--out", "out", "--json", "--format", format.name];
            let run = camgen_in(directory, &[&command_of(kind)[..], &rest].concat());
            let what = format!("{} of a {}: {}", format.name, kind.noun, run.err);
            let out = run.directory.path().join("out");
            if let Some(why) = format.unfit(cam.body()) {
                assert_eq!(run.code, 2, "{what}");
                assert!(run.err.contains(why) && run.err.contains(format.name), "{what}");
                assert!(!out.exists(), "{what}");
                continue;
            }
            assert_eq!(run.code, 0, "{what}");
            let proven = cam.draw(only(format.name)).expect("a drawing").prove().expect("a proof");
            let endings = proven.endings(&format).expect("an outline");
            let mut expected: Vec<String> = endings.iter().map(|ending| format!("cam{ending}")).collect();
            expected.sort();
            assert!(!expected.is_empty(), "{what}");
            assert_eq!(files(&out), expected, "{what}");
            assert_eq!(report(&run)["files"].as_array().map(Vec::len), Some(expected.len()), "{what}");
            for file in expected {
                assert!(fs::metadata(out.join(&file)).expect("a file").len() > 100, "{file}: {what}");
            }
        }
    }
}

#[cfg(feature = "brake")]
fn brake(sets: &[&str]) -> analysis::Analysis {
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    // The paper's round numbers fail their own check.
    let name = if sets.is_empty() { "roll-level" } else { "roll" };
    let brake = BrakeMachine::load(camgen::catalogue::catalogue(), name, &sets, BrakeOutput::Figures).expect("valid").0;
    brake::analysis::analysis(&brake, &brake::analysis::BrakeRequest::default(), None).expect("a brake")
}

/// An analysis of each kind. A new kind needs a line here.
fn analysis_of(kind: &Kind) -> analysis::Analysis {
    let press = || Machine::load("dpi", &[]).expect("valid").0;
    let found = match kind.command {
        "regimes" => press::analysis::regimes::analysis(&press(), 35.0, &SPEEDS, Reset::End).expect("a press"),
        "scatter" => {
            let press =
                Machine::load("dpi", &["scatter.samples=100".into(), "buffer.leak=1%".into()]).expect("valid").0;
            let sampling = press::machine::PressCams::of(&press).scatter;
            press::scatter::analysis::analysis(&press, 35.0, &["mass=5%".into()], &sampling).expect("a press")
        }
        "spring" => press::analysis::spring::analysis(&press(), &SPEEDS, &[], None).expect("a press"),
        "drive" => {
            let drive = DriveMachine::load("dp", &[]).expect("valid").0;
            press::analysis::drive::analysis(&drive, press::analysis::drive::DriveSolver::Energy, 0.1)
                .expect("it closes")
        }
        "linkage" => {
            let six_bar = Machine::load("dpi-six-bar", &[]).expect("valid").0;
            linkage::analysis::analysis(&six_bar, 35.0, None).expect("a linkage")
        }
        "shaft" => {
            let shaft = ShaftMachine::load("dpi-shaft", &[]).expect("valid").0;
            let asked = shaft::analysis::ShaftOptions { sweep: Some((1e8, 1e9)), ..Default::default() };
            shaft::analysis::analysis(&shaft, &asked).expect("a shaft")
        }
        #[cfg(feature = "brake")]
        "brake" => brake(&[]),
        "size" => {
            let feeder = Machine::load("feeder", &[]).expect("valid").0;
            analysis::size::analysis(&feeder, &[analysis::size::FreeDimension::Offset], None).expect("a size")
        }
        "laws" => {
            let valve = Machine::load("valve", &[]).expect("valid").0;
            analysis::laws::analysis(Some(&valve), &analysis::laws::LawsOptions::default()).expect("laws")
        }
        "compare" => {
            let cam = lifter(LIFTER, &[]).solve().expect("a cam");
            let table = cam.draw(TOLERANCE).expect("drawn").prove().expect("proved").table(90);
            let column = |name: &str| table.columns.iter().position(|column| *column == name).expect("a column");
            let (x, y) = (column("profile_x_mm"), column("profile_y_mm"));
            let text: Vec<String> = table.rows.iter().map(|row| format!("{} {}", row[x], row[y])).collect();
            let points = analysis::compare::measured::read(&text.join("\n")).expect("points");
            let options =
                analysis::compare::ComparisonOptions { ball: 0.0, fit: analysis::compare::ComparisonFit::Centre };
            let cut = cam.body().cuts()[0];
            analysis::compare::analysis(cam.body(), &cut, &points, options).expect("a comparison")
        }
        "import" => {
            let lift = |degree: u32| 10.0 - 10.0 * f64::from(degree).to_radians().cos();
            let rows: Vec<String> = (0..360).map(|degree| format!("{degree},{:.5}\n", lift(degree))).collect();
            let rows = rows.concat();
            let directory = tempfile::tempdir().expect("a directory");
            let path = directory.path().join("lift.csv");
            std::fs::write(&path, format!("deg,mm\n{rows}")).expect("written");
            let options = analysis::import::ImportOptions { name: "lift".into(), spline: true, ..Default::default() };
            let frame = analysis::import::frame(&options).expect("a follower");
            let table = [format!("motion.table={}", path.display())];
            let rows =
                camgen::catalogue::lift_table(&frame, &table, &camgen::document::InputFiles::default()).expect("rows");
            analysis::import::analysis(&analysis::import::ImportSource::Table(rows), &options).expect("a design")
        }
        "trade" => {
            let shaft = ShaftMachine::load("dpi-shaft", &[]).expect("valid").0;
            let start = std::time::Instant::now();
            shaft::analysis::trade::analysis(&shaft, &|| start.elapsed()).expect("a shaft")
        }
        other => panic!("no analysis of the kind {other} here"),
    };
    assert_eq!(found.kind, kind);
    found
}

/// A format has files for an analysis, or is refused by name with those that it can have.
#[test]
fn every_format_is_written_for_every_analysis_that_has_it_and_refused_for_the_others() {
    // The other kinds of `trade` measure for seconds and have the same tables.
    for kind in analyses().filter(|kind| kind.command != "trade" || **kind == shaft::analysis::trade::KIND) {
        let judged = Judged::new(analysis_of(kind));
        for format in formats_by_name() {
            let writing = Writing::to("out", "found").formats(&[format.name]);
            let endings = format.of_analysis().map_or_else(Vec::new, |of| (of.endings)(judged.analysis()));
            let what = format!("{} of {}", format.name, kind.noun);
            match judged.files(&writing) {
                Ok(set) => {
                    let names: Vec<&str> = set.outputs().iter().map(|output| &*output.name).collect();
                    let expected: Vec<String> = endings.iter().map(|ending| format!("found{ending}")).collect();
                    assert_eq!(names, expected, "{what}");
                    assert!(!names.is_empty() && set.outputs().iter().all(|output| output.bytes.len() > 100), "{what}");
                }
                Err(Error::NoSuchFormat { name, known }) => {
                    assert!(endings.is_empty() && name == format.name, "{what}");
                    assert!(!known.split(", ").any(|other| other == name), "{what}: {known}");
                }
                Err(other) => panic!("{what}: {other}"),
            }
        }
    }
}

/// What is asked of the library is told as the program tells it, and the usual formats are those that fit.
#[test]
fn formats_are_chosen_by_what_fits() {
    names_are_distinct(formats().map(|format| format.name).collect());
    for kind in kinds() {
        let cam = cam_of(kind, &[]);
        let (chosen, left_out) = Writing::to("out", "cam").chosen(cam.body()).expect("the usual ones");
        for format in formats() {
            let is_chosen = chosen.iter().any(|other| other.name == format.name);
            let unfit = format.unfit(cam.body());
            let usual =
                format.when == FormatSelection::Drawn || (format.when == FormatSelection::Usual && unfit.is_none());
            assert_eq!(is_chosen, usual, "{} of a {}", format.name, kind.noun);
            if format.when == FormatSelection::Usual && unfit.is_some() {
                assert!(left_out.iter().any(|(name, _)| *name == format.name), "{} of a {}", format.name, kind.noun);
            }
        }
        let asked = Writing::to("out", "cam").formats(&["dwg"]).chosen(cam.body());
        assert!(matches!(asked, Err(Error::NoSuchFormat { ref name, .. }) if name == "dwg"), "{asked:?}");
    }
}

/// The columns of every kind of cam stand in the order of the list, and every column belongs to some cam.
#[test]
fn every_column_belongs_to_some_cam_and_every_cell_is_a_number() {
    let order: Vec<&str> = COLUMNS.iter().map(|(name, _)| *name).collect();
    let mut seen: Vec<&str> = Vec::new();
    let of_kinds = kinds().map(|kind| (kind.noun, cam_of(kind, &[])));
    let alone = of_kinds.chain(cams_of_followers()).map(|(what, cam)| (what, Assembly::from(cam)));
    for (what, cam) in alone.chain([("rotary cam with its compensator", two_discs())]) {
        let proven = cam.draw(TOLERANCE).expect("an outline").prove().expect("a proof");
        let table = proven.table(36);
        let mut rest = order.iter();
        // Those of a domain stand between them: a plate has its force and a wedge its motion at other places than a disc.
        let elsewhere =
            ["roller_force_n", "lift_mm", "velocity_mm_per_rad", "acceleration_mm_per_rad2", "jerk_mm_per_rad3"];
        let of_every_cam = |column: &&&str| order.contains(column) && !elsewhere.contains(column);
        for column in table.columns.iter().filter(of_every_cam) {
            assert!(rest.any(|name| name == column), "{what}: {column} is out of order: {:?}", table.columns);
        }
        assert!(table.rows.len() >= 36, "{what}: {} rows", table.rows.len());
        for row in &table.rows {
            assert_eq!(row.len(), table.columns.len(), "{what}");
            assert!(row.iter().all(|cell| !cell.is_nan()), "{what}: {row:?}");
        }
        seen.extend(&table.columns);
    }
    for name in order {
        assert!(seen.contains(&name), "no cam has the column {name}");
    }
}

/// A cam with a lead-in.
fn led() -> Proven {
    let lead_in = Some(LeadIn { form: LeadInForm::Arc, size: 0.004 });
    let led = Request { lead_in, ..Request::within(TOLERANCE) };
    lifter(LIFTER, &[]).solve().expect("a cam").draw(led).expect("drawn").prove().expect("proved")
}

/// A request for a drawing with one format.
fn only(format: &str) -> Request {
    let every = of_every_tool();
    Request {
        flank: true,
        points: every.points.filter(|_| format == "points"),
        milling: every.milling.filter(|_| format == "gcode"),
        formats: requested(&[format]),
        inspection: every.inspection.filter(|_| format == "inspect"),
        gauge: every.gauge.filter(|_| format == "gauge"),
        ..Request::within(TOLERANCE)
    }
}

/// A request for every file of a tool.
fn of_every_tool() -> Request {
    Request {
        cutter_radius: Some(0.01),
        points: Some(camgen::body::Points::default()),
        milling: Some(camgen::body::Milling::default()),
        formats: requested(&formats_by_name().map(|format| format.name).collect::<Vec<_>>()),
        inspection: Some(camgen::body::Inspection { ball_radius: 1.5e-3 }),
        gauge: Some(camgen::body::Gauge::Flat),
        ..Request::within(TOLERANCE)
    }
}

/// What `check` reports on the tables and the solid of a cam.
fn reports_on_files(made: &Cam) -> Vec<(String, Report)> {
    let kind = made.body().kind();
    let mut reports = Vec::new();
    let request = camgen::Request { flank: true, ..camgen::Request::within(TOLERANCE) };
    let proven = made.draw(request).expect("drawn").prove().expect("a proof");
    let writing = camgen::Writing { force: true, ..camgen::Writing::to("nowhere", "cam").formats(&["step", "csv"]) };
    let set = proven.files(&writing).expect("a solid");
    for table in set
        .outputs()
        .iter()
        .filter(|output| std::path::Path::new(&output.name).extension().is_some_and(|ending| ending == "csv"))
    {
        let report = made.check(&table.bytes, TOLERANCE).expect("a table");
        assert!(report.passed(), "{} {}: {report:?}", kind.noun, table.name);
        reports.push((format!("table of a {} as a file", kind.noun), report));
    }
    let report = made.check(set.bytes("step").expect("a solid"), TOLERANCE).expect("a STEP file");
    assert!(report.passed(), "{}: {report:?}", kind.noun);
    reports.push((format!("solid of a {} as a file", kind.noun), report));
    reports
}

/// A cam of a known hardness, presses that scatter and lose, and springs that are described.
fn reports_on_presses() -> Vec<(String, Report)> {
    let hard = Machine::load("dpi", &["cam.hardness=600".into()]).expect("valid").0;
    let hard = report_of(&Spec::rotary(hard, 35.0).solve().expect("a cam"));
    let springs = Machine::load("dpi", &["spring_buffer.body.stress=700MPa".into()]).expect("valid").0;
    let springs = press::analysis::spring::analysis(&springs, &SPEEDS, &[], None).expect("springs");
    let analyses = [analysis_of(&press::scatter::analysis::KIND), springs];
    let analyses = analyses.map(|of| (of.kind.noun.to_owned(), Judged::new(of).report()));
    std::iter::once(("a hard cam".to_owned(), hard)).chain(analyses).collect()
}

/// Every check is reached by some cam or some file, and is found in the order of the list, the worst verdicts first.
#[test]
fn every_check_is_run_for_some_cam() {
    names_are_distinct(checks().map(|check| check.name).collect());
    let order: Vec<&str> = checks().map(|check| check.name).collect();
    let two = two_discs().draw(TOLERANCE).expect("outlines").prove().expect("a proof");
    let mut reports = vec![("two discs".into(), two.report())];
    let press = Machine::load("dpi", &[]).expect("valid").0;
    let regimes = press::analysis::regimes::analysis(&press, 35.0, &SPEEDS, Reset::End).expect("a press");
    let drive = DriveMachine::load("dp", &[]).expect("valid").0;
    let drive =
        press::analysis::drive::analysis(&drive, press::analysis::drive::DriveSolver::Energy, 0.1).expect("it closes");
    let six_bar = Machine::load("dpi-six-bar", &[]).expect("valid").0;
    let linkage = linkage::analysis::analysis(&six_bar, 35.0, None).expect("a linkage");
    let shaft = analysis_of(&shaft::analysis::KIND);
    reports.extend(reports_on_presses());
    reports.extend([regimes, drive, linkage, shaft].map(|of| (of.kind.noun.to_owned(), Judged::new(of).report())));
    #[cfg(feature = "brake")]
    for set in ["brake.model=printed", "brake.mode=no-slip"] {
        reports.push((set.to_owned(), Judged::new(brake(&[set])).report()));
    }
    for kind in kinds() {
        let crowned = ["follower.roller.crown=cylinder", "follower.roller.width=20mm", "cam.balance=40mm .. 85mm"];
        let cam = cam_of(kind, &crowned);
        reports.push((format!("{} as made", kind.noun), report_of(&cam)));
        if camgen::body::curves(cam.body()).is_some() {
            let made = cam_of(kind, &[]);
            let proven = made.draw(TOLERANCE).expect("an outline").prove().expect("a proof");
            let report = made.check(&proven.cut_files()[0], TOLERANCE).expect("a DXF file");
            assert!(report.passed(), "{}: {report:?}", kind.noun);
            reports.push((format!("{} as a file", kind.noun), report));
        }
        let made = cam_of(kind, &[]);
        if kind.command == "rotary" {
            let request = of_every_tool();
            let proven = made.draw(request).expect("drawn").prove().expect("a proof");
            reports.push((
                format!("{} with the path of a cutter, points, a program, a table for a drive and places", kind.noun),
                proven.report(),
            ));
        }
        reports.extend(reports_on_files(&made));
    }
    let dynamics = [
        "follower.roller.mass=2kg",
        "spring.preload=200N",
        "guide.friction=0.1",
        "guide.span=60mm",
        "vibration.natural_frequency=40Hz",
        "follower.roller.bearing.dynamic_rating=20kN",
        "follower.roller.bearing.inertia=0.00002kg*m2",
    ];
    let hub =
        lifter(LIFTER, &["cam.hub.diameter=20mm", "cam.hub.length=10mm", "cam.thickness=12mm"]).solve().expect("a cam");
    reports.extend(reports_on_files(&hub));
    let moving = lifter(LIFTER, &dynamics).solve().expect("a cam");
    reports.push(("lifter with spring, guide and train".into(), report_of(&moving)));
    reports.push(("lifter with a lead-in".into(), led().report()));
    let pair = lifter(LIFTER, &["cam.body=conjugate"]).assemble().expect("two discs");
    reports.push(("conjugate discs".into(), pair.draw(TOLERANCE).expect("drawn").prove().expect("proved").report()));
    let arm = Machine::load("lever", &["limits.pivot_clearance=1 mm".to_owned()]).expect("valid").0;
    let arm = Spec::of_program(arm, None).expect("a motion").solve().expect("a cam");
    reports.push(("lever with a clearance".into(), report_of(&arm)));
    let (head, _) = LIFTER.split_once("[[motion.segment]]").expect("segments");
    let rows = tempfile::tempdir().expect("a folder");
    fs::write(rows.path().join("lift.csv"), include_str!("common/rows/rounded.csv")).expect("written");
    let measured = rows.path().join("measured.toml");
    fs::write(&measured, format!("{head}table = \"lift.csv\"\n[follower.roller]\nradius = \"10 mm\"\n"))
        .expect("written");
    let measured = Machine::load(&measured.display().to_string(), &[]).unwrap_or_else(|error| panic!("{error}")).0;
    let measured = Spec::of_program(measured, None).expect("a motion").solve().expect("a cam");
    reports.push(("measured rows".into(), report_of(&measured)));
    reports.push(("an old cam".into(), Judged::new(analysis_of(&analysis::import::KIND)).report()));
    reports.push(("a measured cam".into(), Judged::new(analysis_of(&analysis::compare::KIND)).report()));
    reports.extend(cams_of_followers().iter().map(|(path, cam)| ((*path).to_owned(), report_of(cam))));
    let mut seen: Vec<String> = Vec::new();
    for (what, report) in &reports {
        let mut rest = order.iter();
        let (mut rank, mut last) = (0, None);
        for finding in &report.checks {
            // Failures, then warnings, then the rest, each in the order of the list.
            if finding.verdict.rank() > rank {
                (rest, rank) = (order.iter(), finding.verdict.rank());
            }
            assert_eq!(finding.verdict.rank(), rank, "{what}: {} is shown too late", finding.check);
            // A body of several flanks has one finding for each.
            let again = last == Some(&finding.check);
            let known = again || rest.any(|name| *name == finding.check);
            assert!(known, "{what}: {} is unknown or out of order", finding.check);
            last = Some(&finding.check);
            // Whoever is refused is told why.
            let failed = finding.verdict == Verdict::Fail;
            assert!(!failed || finding.limit.is_some() || finding.note.is_some(), "{what}: {finding:?}");
            seen.push(finding.check.to_string());
        }
    }
    for check in checks() {
        assert!(seen.iter().any(|name| name == check.name), "no cam here is checked for {}", check.name);
        let of_a_file = |what: &str| what.ends_with("as a file");
        let on_cams = reports.iter().filter(|(what, _)| !of_a_file(what));
        if check.on == CheckScope::File {
            let mut names = on_cams.flat_map(|(_, report)| &report.checks).map(|finding| &*finding.check);
            assert!(!names.any(|name| name == check.name), "{} is for files", check.name);
        }
    }
}

#[test]
fn every_check_is_explained() {
    let all = camgen(&["explain", "--verbose"]);
    assert_eq!(all.code, 0, "{}", all.err);
    for check in checks() {
        let run = camgen(&["explain", check.name]);
        assert_eq!(run.code, 0, "{}: {}", check.name, run.err);
        assert!(run.out.starts_with(check.name) && run.out.contains(check.about), "{}", run.out);
        let told = check.explained;
        for (what, text) in [("how", told.formula), ("limit", told.usual), ("change", told.change)] {
            assert!(run.out.contains(text), "{}: {what}", check.name);
            assert!(text.len() > 5 && !text.ends_with('.'), "{}: {what}: {text}", check.name);
        }
        assert!(all.out.lines().any(|line| line.starts_with(check.name)), "{} is not among all", check.name);
        // A sentence.
        assert!(check.about.len() > 20 && check.about.ends_with('.'), "{}: {}", check.name, check.about);
    }
}

/// A cam by every law, rolled on as written: the law's own derivatives are proved where the law stands.
#[test]
fn every_law_makes_a_cam_that_gives_it() {
    names_are_distinct(LAWS.iter().map(|law| law.name).collect());
    for law in LAWS.iter().filter(|law| law.serves_rests()) {
        let cam = lifter(
            LIFTER,
            &[&format!("motion.segment[0].law={}", law.name), &format!("motion.segment[2].law={}", law.name)],
        );
        let cam = cam.solve().unwrap_or_else(|error| panic!("{}: {error}", law.name));
        let proven = cam.draw(TOLERANCE).expect("an outline").prove().expect("a proof");
        assert!(proven.passed(), "{}: {:?}", law.name, proven.findings());
        let gap = proven.rolled().expect("a plane cam is rolled on").gap_mm;
        assert!(gap.abs() <= 1e3 * TOLERANCE, "{}: {gap} mm", law.name);
        let table = proven.table(2);
        let lift = table.columns.iter().position(|name| *name == "lift_mm").expect("a lift");
        let last = table.rows[1][lift];
        assert!((last - 20.0).abs() < 1e-12, "{}: at half a turn the lift is {last} mm", law.name);
    }
    let unknown = Machine::from_toml("lifter.toml", &LIFTER.replace("3-4-5", "cycloid"), &[]).expect_err("no such law");
    for law in LAWS {
        assert!(unknown.to_string().contains(law.name), "{unknown}");
        let alone = Machine::from_toml("lifter.toml", &LIFTER.replace("3-4-5", law.name), &[]);
        let told = alone.err().map(|error| error.to_string()).unwrap_or_default();
        // A line is an impact, which the check of the whole program refuses.
        let refused = !law.serves_rests() && law.name != LINE;
        assert_eq!(told.contains("cannot start and end at rest"), refused, "{}: {told}", law.name);
    }
}

/// A follower described by what its table asks for, and nothing else, makes a cam.
#[test]
fn every_follower_makes_a_cam_of_its_required_keys() {
    for (name, cam) in cams_of_followers() {
        let proven = cam.draw(TOLERANCE).expect("an outline").prove().expect("a proof");
        assert!(proven.passed(), "{name}: {:?}", proven.findings());
        let gap = proven.rolled().expect("a plane cam is rolled on").gap_mm;
        assert!(gap.abs() <= 1e3 * TOLERANCE, "{name}: {gap} mm");
    }
}

#[test]
fn every_kind_is_a_command() {
    let all = || kinds().chain(analyses());
    names_are_distinct(all().map(|kind| kind.noun).collect());
    for kind in commands().chain(analyses()) {
        assert_eq!(camgen(&[kind.command, "--help"]).code, 0, "{}", kind.command);
    }
}
