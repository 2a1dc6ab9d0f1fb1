//! The motion diagram: it agrees with the table, shows what is infinite, and nothing on it overlaps.

use crate::sheets::faults;
use camgen::body::motion_diagram::motion_diagram;
use camgen::domains::press::SpecOfPress;
use camgen::pipeline::Proven;
use camgen::report::motion_diagram::{MotionDiagram, figure};
use camgen::report::sheet::{Sheet, SheetShape};
use camgen::write::{diagram, svg};
use camgen::{ExactOn, Machine, Solver, Spec, Writing};

/// Rows of the table that the diagram is compared with.
const ROWS: u32 = 14_400;
/// Between two rows a value changes by at most this share of the largest.
const BETWEEN_ROWS: f64 = 6e-3;

fn proven(command: &str, machine: &str, overrides: &[&str]) -> Proven {
    let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
    let machine = Machine::load(machine, &overrides).expect("valid").0;
    let spec = match command {
        "rotary" => Spec::rotary(machine, 35.0),
        "translating" => Spec::translating(machine, 35.0, Solver::Ode { tolerance: 1e-12 }, ExactOn::Braking),
        _ => Spec::of_program(machine, None).expect("a motion"),
    };
    spec.solve().expect("a cam").draw(5e-6).expect("drawn").prove().expect("proved")
}

fn of(proven: &Proven) -> MotionDiagram {
    motion_diagram(proven.body(), Some(&proven.outlines()[0].contour)).expect("a motion")
}

fn sheet(proven: &Proven) -> Sheet {
    let report = proven.lazy_report();
    let rendering = proven.rendering(&report, 72, svg::TEMPLATE).expect("an outline");
    diagram::sheet(&rendering).expect("drawn").expect("a motion")
}

fn texts(sheet: &Sheet) -> Vec<String> {
    let shapes = sheet.groups.iter().flat_map(|group| &group.shapes);
    shapes
        .filter_map(|shape| if let SheetShape::Text { text, .. } = shape { Some(text.clone()) } else { None })
        .collect()
}

/// Motions given as a whole, with steps and at rest between them.
const FOURIER: &str = "name = \"waves\"\n[motion]\nrpm = 200\nstart = \"0 mm\"\nfourier = { cos = [-6, 2, -1], sin = [1] }\n\
    [follower.roller]\nradius = \"8 mm\"\n[cam]\nbase_radius = \"auto\"\n";
const STEPS: &str = "name = \"steps\"\n[motion]\nstart = \"0 mm\"\n[[motion.segment]]\nlaw = \"parabola\"\nto = \"10 mm\"\nover = \"90 deg\"\n\
    [[motion.segment]]\nlaw = \"dwell\"\nover = \"90 deg\"\n[[motion.segment]]\nlaw = \"parabola\"\nto = \"0 mm\"\nover = \"120 deg\"\n\
    [[motion.segment]]\nlaw = \"dwell\"\n[follower.roller]\nradius = \"8 mm\"\n[cam]\nbase_radius = \"60 mm\"\n[limits]\ncontinuity = 1\n";

fn written(name: &str, text: &str) -> String {
    let file = std::env::temp_dir().join(format!("camgen-diagram-{}-{name}.toml", std::process::id()));
    std::fs::write(&file, text).expect("written");
    file.display().to_string()
}

/// The extremes that the diagram marks are those of the table, and its labels say them.
#[test]
fn its_extremes_are_those_of_the_table() {
    let (waves, steps) = (written("waves", FOURIER), written("steps", STEPS));
    for (command, machine) in [
        ("make", "feeder"),
        ("make", "lever"),
        ("make", "valve"),
        ("rotary", "dpi"),
        ("make", &*waves),
        ("make", &*steps),
    ] {
        let proven = proven(command, machine, &[]);
        let (diagram, all) = (of(&proven), texts(&sheet(&proven)));
        let table = camgen::pipeline::ProvenAssembly::from(proven).table(ROWS);
        assert!(diagram.panels.len() >= 6, "{machine}: {}", diagram.panels.len());
        for panel in &diagram.panels {
            let (name, factor) = panel.column;
            let index = table.columns.iter().position(|column| *column == name).expect("a column");
            let values: Vec<f64> = table.rows.iter().map(|row| factor * row[index]).collect();
            let size =
                values.iter().filter(|value| value.is_finite()).fold(0.0_f64, |size, value| size.max(value.abs()));
            for extreme in panel.extremes.iter().filter(|extreme| extreme.overall) {
                let (sign, what) = (if extreme.upwards { 1.0 } else { -1.0 }, format!("{machine} {name} {extreme:?}"));
                // Of a radius the sharpest place of each sign.
                let of = |value: f64| if panel.radius { 1.0 / value } else { value };
                let scale = if panel.radius { of(extreme.value).abs() } else { size };
                let found = values.iter().map(|value| sign * of(*value)).fold(f64::NEG_INFINITY, f64::max);
                let shown = sign * of(extreme.value);
                assert!(shown - found > -1e-9 * scale && shown - found < BETWEEN_ROWS * scale, "{what}: {found}");
                // Its place is that of the table too: the row next to it has the value, from one side or the other.
                #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a row")]
                let row = (extreme.place / 360.0 * f64::from(ROWS)).round() as usize;
                let near = [row + ROWS as usize - 1, row, row + 1].map(|row| sign * of(values[row % values.len()]));
                assert!(near.iter().any(|value| (value - shown).abs() < BETWEEN_ROWS * scale), "{what}: {near:?}");
                let label = diagram.words(panel, extreme);
                assert!(label.contains(&figure(extreme.value.abs())), "{what}: {label}");
                assert!(all.iter().any(|text| text.contains(&label)), "{what}: no label {label}");
            }
        }
    }
}

/// Of a plate the table has the overrun; the diagram has the run-up before it as well.
#[test]
fn a_plate_is_shown_over_its_travel() {
    let proven = proven("translating", "dpi", &[]);
    let diagram = of(&proven);
    let table = camgen::pipeline::ProvenAssembly::from(proven).table(3600);
    let column = |name: &str| table.columns.iter().position(|column| *column == name).expect("a column");
    let last = table.rows.last().expect("rows")[column("x_mm")];
    assert!(diagram.range.0 < 0.0 && (diagram.range.1 - last).abs() < 1e-9, "{:?}", diagram.range);
    for panel in &diagram.panels {
        let (name, factor) = panel.column;
        let rows = table.rows.iter().map(|row| factor * row[column(name)]);
        // Before the overrun the plate has another jerk, also where it begins.
        let after = panel.law.iter().filter(|run| run.first().is_some_and(|[place, _]| *place > -1e-9));
        let points = || after.clone().flatten().filter(|[_, value]| value.is_finite());
        for sign in [1.0, -1.0] {
            let most = |value: f64, next: f64| value.max(sign * next);
            let (table, shown) = (
                rows.clone().filter(|value| value.is_finite()).fold(f64::NEG_INFINITY, most),
                points().map(|[_, value]| *value).fold(f64::NEG_INFINITY, most),
            );
            assert!((table - shown).abs() < 2e-2 * table.abs().max(1e-9), "{name} {sign}: {table} {shown}");
        }
    }
}

/// A step of the acceleration is an upright line, and the jerk is infinite there, with the sign of the step.
#[test]
fn steps_and_infinite_values_are_shown() {
    let file = written("impulses", STEPS);
    let diagram = of(&proven("make", &file, &[]));
    let panel = |name: &str| diagram.panels.iter().find(|panel| panel.name == name).expect("a panel");
    assert!(panel("Acceleration").impulses.is_empty());
    let impulses: Vec<(f64, bool)> =
        panel("Jerk").impulses.iter().map(|impulse| (impulse.place.round(), impulse.upwards)).collect();
    assert_eq!(impulses, [(45.0, false), (90.0, true), (180.0, false), (240.0, true), (300.0, false), (0.0, true)]);
    let ends = |at: f64| -> Vec<f64> {
        let runs = panel("Acceleration").law.iter();
        let near =
            runs.flat_map(|run| [run.first(), run.last()]).flatten().filter(|[place, _]| (place - at).abs() < 1e-6);
        near.map(|[_, value]| *value).collect()
    };
    let steps = ends(45.0);
    assert!(steps.len() == 2 && steps[0] > 0.0 && (steps[0] + steps[1]).abs() < 1e-9 * steps[0], "{steps:?}");
    assert_eq!(
        diagram.segments.iter().map(|segment| &*segment.name).collect::<Vec<_>>(),
        ["parabola", "dwell", "parabola", "dwell"]
    );
    // Neither a mass nor a spring is given.
    assert!(diagram.panels.iter().all(|panel| !["N", "N·m"].contains(&panel.unit)));
    assert_eq!(panel("Velocity").unit, "mm/rad");
}

/// Nothing on the sheet overlaps or is struck by a line.
#[test]
fn nothing_overlaps_on_the_diagram() {
    let (waves, steps) = (written("shown", FOURIER), written("stepped", STEPS));
    for (command, machine, overrides) in [
        ("make", "feeder", &[][..]),
        ("make", "lever", &[]),
        ("make", "valve", &[]),
        ("make", &*waves, &[]),
        ("make", &*steps, &[]),
        ("rotary", "dpi", &[]),
        ("rotary", "dpi", &["transition.kind=none", "limits.continuity=0"]),
        ("rotary", "dpi", &["cam.rotation=ccw", "cam.cam_turns_per_crank_turn=0.5"]),
        ("translating", "dpi", &[]),
    ] {
        let found = faults(&sheet(&proven(command, machine, overrides)));
        assert!(found.is_empty(), "{command} {machine} {overrides:?}: {found:#?}");
    }
}

/// The second page of a PDF, and a file of its own.
#[test]
fn the_diagram_is_a_page_and_a_file() {
    let mut writing = Writing::to("unused", "feeder");
    writing.formats = Some(vec!["diagram".into(), "pdf".into()]);
    let files = proven("make", "feeder", &[]).files(&writing).expect("files");
    let text = String::from_utf8(files.bytes("feeder-diagram.svg").expect("an SVG").to_vec()).expect("UTF-8");
    assert!(text.contains("motion diagram") && text.contains(">\n1/1\n<"), "its title block");
    if let Some(pdf) = files.bytes("feeder.pdf") {
        assert_eq!(String::from_utf8_lossy(pdf).matches("/MediaBox").count(), 3, "three pages");
    }
}

/// Every law under three followers, in short and long segments, with small and large lifts: 200 diagrams.
#[test]
fn nothing_overlaps_whatever_the_law() {
    let feeder = proven("make", "feeder", &[]);
    let report = feeder.report();
    let facts = feeder.body().view(feeder.drawn().expect("a drawing")).expect("a view").facts;
    let followers = [
        ("mm", "[follower.roller]\nradius = \"9 mm\"\nmass = \"0.3 kg\"\npreload = \"150 N\"\n"),
        ("mm", "[follower.flat]\n"),
        ("deg", "[follower.swinging-roller]\nradius = \"10 mm\"\narm = \"900 mm\"\npivot_distance = \"1100 mm\"\n"),
    ];
    let mut shown = 0;
    for law in camgen::motion::laws::LAWS.iter().filter(|law| law.serves_rests()) {
        for (unit, follower) in followers {
            for (rise, dwell, lift, speed) in
                [(4.0, 3.0, 0.5, ""), (100.0, 2.0, 20.0, "rpm = 600\n"), (70.5, 120.25, 12.3, "rpm = 3\n")]
            {
                let segment = |law: &str, over: f64, to: f64| {
                    format!("[[motion.segment]]\nlaw = \"{law}\"\nover = \"{over} deg\"\nto = \"{to} {unit}\"\n")
                };
                let text = format!(
                    "name = \"{}\"\n[motion]\n{speed}start = \"0 {unit}\"\n{}[[motion.segment]]\nlaw = \"dwell\"\nover = \"{dwell} deg\"\n\
                     {}[[motion.segment]]\nlaw = \"dwell\"\n{follower}[cam]\nbase_radius = \"400 mm\"\n",
                    law.name,
                    segment(law.name, rise, lift),
                    segment(law.name, rise + 9.0, 0.0)
                );
                let machine = Machine::from_toml("case", &text, &[]).expect("valid");
                let cam = Spec::of_program(machine, None).expect("a motion").solve().expect("a cam");
                let diagram = motion_diagram(cam.body(), None).expect("a motion");
                let found =
                    faults(&camgen::report::motion_diagram::sheet(&diagram, &report, &facts, "±0.005 mm", "1/1"));
                assert!(found.is_empty(), "{text}: {found:#?}");
                shown += 1;
            }
        }
    }
    assert!(shown > 150, "{shown}");
}
