//! The program as a user meets it: exit codes, messages, files.

use crate::common::program::{Run, camgen, camgen_in, files, report};
use std::fs;

#[test]
fn the_main_job() {
    let run = camgen(&["rotary", "--rpm", "35"]);
    assert_eq!(run.code, 0, "{}", run.err);
    let stem = "dpi-rotary-35rpm";
    let expected = ["-review.svg", ".csv", ".dxf", ".step", ".svg"].map(|ending| format!("{stem}{ending}"));
    assert_eq!(files(run.directory.path()), expected);
    assert!(run.out.contains("pressure_angle") && run.err.is_empty(), "{} {}", run.out, run.err);
    assert!(run.directory.path().join("output").is_dir());
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    for command in ["rotary", "translating"] {
        let all = [command, "--format", "dxf,svg,step,csv,json"];
        let (first, second) = (camgen(&all), camgen(&all));
        assert_eq!(first.out, second.out);
        for name in files(first.directory.path()) {
            let read = |run: &Run| fs::read(run.directory.path().join("output").join(&name)).expect("a file");
            assert_eq!(read(&first), read(&second), "{name}");
        }
    }
}

#[test]
fn the_report_has_the_names_of_the_contract() {
    let run = camgen(&["rotary", "--rpm", "35", "--json", "--format", "json"]);
    let report = report(&run);
    assert_eq!(report["schema"], 1);
    assert_eq!(report["command"], "rotary");
    assert_eq!(report["machine"], "DPI flat-bed press, 2 at");
    for (table, keys) in [
        ("cam", vec!["prime_radius_mm", "base_radius_mm", "roller_radius_mm", "max_lift_mm", "area_mm2", "mass_kg"]),
        ("law", vec!["dx_max_mm", "dx_max_at_x_mm", "column_length_mm", "piston_area_mm2", "bore_mm"]),
        ("outline", vec!["arcs", "lines", "deviation_max_mm", "tangent_break_max_deg"]),
        ("force", vec!["inertia_max_n", "residual_max_n", "residual_fixed_bottom_max_n", "residual_share"]),
        ("rolling", vec!["gap_mm", "gap_cam_deg", "lift_error_max_mm", "lift_error_q99_mm", "double_contacts"]),
    ] {
        for key in keys {
            assert!(report[table][key].is_number(), "{table}.{key}: {}", report[table]);
        }
    }
    for finding in report["checks"].as_array().expect("checks") {
        assert!(finding["check"].is_string() && finding["unit"].is_string(), "{finding}");
        assert!(["pass", "fail", "warn", "info"].contains(&finding["verdict"].as_str().expect("a verdict")));
    }
    // The number the customer buys the cam for: what is left of the force with the cam as written.
    assert!(report["force"]["residual_share"].as_f64().expect("a number") <= 1e-3);
    assert!((report["law"]["column_length_mm"].as_f64().expect("a number") - 243.0).abs() < 1e-12);
    assert!((report["law"]["dx_max_mm"].as_f64().expect("a number") + 82.42).abs() < 5e-3);
    let file = fs::read_to_string(run.directory.path().join("output/dpi-rotary-35rpm.json")).expect("the file");
    assert_eq!(file, run.out);
}

#[test]
fn the_table_has_the_columns_and_the_golden_rows() {
    let run = camgen(&["rotary", "--format", "csv", "--quiet", "--samples", "360"]);
    assert!(run.out.is_empty());
    let text = fs::read_to_string(run.directory.path().join("output/dpi-rotary-35rpm.csv")).expect("the file");
    let mut lines = text.lines();
    assert_eq!(
        lines.next().expect("a header"),
        "cam_deg,crank_deg,x_mm,dx_mm,lift_mm,velocity_mm_per_rad,acceleration_mm_per_rad2,jerk_mm_per_rad3,\
         pitch_x_mm,pitch_y_mm,profile_x_mm,profile_y_mm,pressure_angle_deg,pitch_curvature_radius_mm,\
         profile_curvature_radius_mm,roller_force_n,torque_nm,contact_force_n,\
         velocity_cut_mm_per_rad,acceleration_cut_mm_per_rad2,\
         inertia_n,air_n,air_fixed_bottom_n,residual_n,residual_cut_n"
    );
    let rows: Vec<Vec<f64>> =
        lines.map(|line| line.split(',').map(|cell| cell.parse().expect("a number")).collect()).collect();
    assert_eq!(rows.len(), 360);
    for (degrees, dx) in [(10, -4.079_160_952_276_448_7), (30, -26.956_817_407_290_616), (60, -65.967_446_120_940_684)]
    {
        assert_eq!(rows[degrees][0], f64::from(u32::try_from(degrees).expect("small")));
        assert!((rows[degrees][3] / dx - 1.0).abs() < 1e-13, "{degrees}: {}", rows[degrees][3]);
    }
    assert_eq!((rows[0][2], rows[0][3], rows[90][4]), (0.0, 0.0, 0.0));
    assert_eq!(rows[200][2], 0.0, "no overrun outside the reversal");
    // Force along the path is the inertia force while the law balances: 21288 N at x = r.
    assert!((rows[90][15] - 21_288.1).abs() < 0.1, "{}", rows[90][15]);
    assert!((rows[90][16]).abs() < 1e-9 && rows[45][16] < 0.0, "torque falls with the lift");
}

#[test]
fn a_counter_clockwise_cam_is_the_mirror_image() {
    let csv = |rotation: &str| {
        let run = camgen(&["rotary", "--set", rotation, "--set", "follower.roller.offset=10mm", "--format", "csv,dxf"]);
        assert_eq!(run.code, 0, "{}", run.err);
        fs::read_to_string(run.directory.path().join("output/dpi-rotary-35rpm.csv")).expect("the file")
    };
    let (cw, ccw) = (csv("cam.rotation=cw"), csv("cam.rotation=ccw"));
    for (a, b) in cw.lines().zip(ccw.lines()).skip(1) {
        let cells = |line: &str| line.split(',').map(|c| c.parse().expect("a number")).collect::<Vec<f64>>();
        let (a, b) = (cells(a), cells(b));
        assert_eq!((a[8], a[9], a[10], a[11]), (b[8], -b[9] + 0.0, b[10], -b[11] + 0.0));
        assert_eq!(a[..8], b[..8]);
    }
}

#[test]
fn a_cam_that_breaks_a_limit_is_refused_with_the_radius_that_would_pass() {
    let refused = ["rotary", "dpi-paper", "--set", "cam.base_radius=200mm"];
    let run = camgen(&refused);
    assert_eq!(run.code, 1);
    assert!(run.out.contains("FAIL  pressure_angle") && run.err.contains("nothing was written"), "{}", run.out);
    assert!(files(run.directory.path()).is_empty());
    let base = run.out.split("a base radius of ").nth(1).and_then(|t| t.split(" mm").next()).expect("a radius");
    let passing = camgen(&["rotary", "dpi-paper", "--set", &format!("cam.base_radius={base}mm")]);
    assert_eq!(passing.code, 0, "{}", passing.out);

    let forced = camgen(&[&refused[..], &["--force"]].concat());
    assert_eq!(forced.code, 1);
    assert_eq!(files(forced.directory.path()).len(), 5);
    assert_eq!(camgen(&["rotary", "dpi-paper"]).code, 0, "with an automatic radius it is huge, and passes");
}

/// What could be cut of an undercut cam is shown by force, with the motion that is lost; a cam that folds up is not.
#[test]
fn an_undercut_cam_is_told_what_it_loses() {
    let undercut = ["rotary", "--set", "cam.base_radius=30mm", "--set", "follower.roller.radius=80mm"];
    let run = camgen(&undercut);
    assert_eq!(run.code, 1);
    assert!(run.out.contains("FAIL  undercut") && run.out.contains("motion is lost from 358."), "{}", run.out);
    assert!(run.out.contains("FAIL  rolling") && run.out.contains("metal is missing"), "{}", run.out);
    assert!(files(run.directory.path()).is_empty());
    assert_eq!(files(camgen(&[&undercut[..], &["--force"]].concat()).directory.path()).len(), 5);

    // A slight one has its crossing, too, and its loss.
    let slight = ["rotary", "--force", "--set", "cam.base_radius=32mm", "--set", "follower.roller.radius=67mm"];
    let run = camgen(&slight);
    assert!(run.out.contains("0.389°, 0.000011 mm") && files(run.directory.path()).len() == 5, "{}", run.out);

    // Under this plate the branches would meet beyond the end of the stroke.
    let sets = ["translating.roller_radius=400mm", "translating.plate_height=900mm"];
    let folded: Vec<&str> =
        ["translating", "--force"].into_iter().chain(sets.iter().flat_map(|set| ["--set", set])).collect();
    let run = camgen(&folded);
    assert_eq!(run.code, 1);
    assert!(run.err.contains("folds over itself") && run.err.contains("--force cannot help"), "{}", run.err);
    assert!(files(run.directory.path()).is_empty());
}

#[test]
fn a_cutter_gets_its_own_file_or_is_told_where_it_does_not_get_in() {
    let run = camgen(&["rotary", "--cutter-diameter", "8mm", "--format", "dxf"]);
    assert_eq!(run.code, 0, "{}", run.out);
    assert_eq!(files(run.directory.path()), ["dpi-rotary-35rpm-cutter.dxf", "dpi-rotary-35rpm.dxf"]);
    let path = fs::read_to_string(run.directory.path().join("output/dpi-rotary-35rpm-cutter.dxf")).expect("the file");
    assert!(path.contains("CUTTER_PATH") && !path.contains("CAM_PROFILE"));
    assert!(path.lines().nth(1).is_some_and(|comment| comment.ends_with("cutter of diameter 8 mm")), "{path}");
    // Every figure of the path is that of half the diameter.
    let by_radius = camgen(&["rotary", "--cutter-radius", "4mm", "--format", "dxf"]);
    let other = fs::read_to_string(by_radius.directory.path().join("output/dpi-rotary-35rpm-cutter.dxf"));
    assert_eq!(other.expect("the file"), path);
    assert!(run.out.contains("cutter Ø8 mm along"), "{}", run.out);
    let run = camgen(&["rotary", "--cutter-radius", "400mm", "--set", "cam.base_radius=69mm"]);
    assert_eq!(run.code, 1);
    assert!(run.out.contains("FAIL  cutter_radius") && files(run.directory.path()).is_empty(), "{}", run.out);
    for wrong in [
        &["--cutter-diameter", "8"][..],
        &["--cutter-diameter", "2100mm"],
        &["--cutter-radius", "1100mm"],
        &["--cutter-radius", "4mm", "--cutter-diameter", "8mm"],
    ] {
        assert_eq!(camgen(&[&["rotary"][..], wrong].concat()).code, 2, "{wrong:?}");
    }
}

/// A cutter is bought by its diameter and moves by its radius: a length alone says neither.
#[test]
fn a_cutter_without_diameter_or_radius_is_asked_for_one() {
    for (words, diameter, radius) in [
        (&["--cutter", "8mm"][..], "--cutter-diameter 8mm", "--cutter-radius 8mm"),
        (&["--cutter=5 mm"], "--cutter-diameter 5 mm", "--cutter-radius 5 mm"),
        (&["--cutter"], "--cutter-diameter 8mm", "--cutter-radius 8mm"),
        (&["--cutter", "--dry-run"], "--cutter-diameter", "--cutter-radius"),
    ] {
        for command in [&["rotary"][..], &["make", "feeder"]] {
            let run = camgen(&[command, words].concat());
            assert!(run.code == 2 && run.err.contains(diameter) && run.err.contains(radius), "{words:?}: {}", run.err);
            assert!(files(run.directory.path()).is_empty(), "{words:?}");
        }
    }
    let help = camgen(&["make", "--help"]).out;
    assert!(
        help.contains("--cutter-diameter") && help.contains("--cutter-radius") && !help.contains("--cutter <"),
        "{help}"
    );
}

/// Exit 2, a message with the place and the remedy, no file, no panic.
#[test]
fn bad_input_is_told_and_writes_nothing() {
    let cases: &[(&[&str], &[&str])] = &[
        (&["--set", "bed.mass=978.2"], &["bed.mass", "has no unit", "kg, lb"]),
        (&["--set", "bed.mass=978.2 mm"], &["unit of length, not of mass", "kg, lb"]),
        (&["--set", "bed.mass=-1kg"], &["must be above 0 kg"]),
        (&["--set", "bed.mass=0kg"], &["must be above 0 kg"]),
        (&["--set", "bed.mass=NaN kg"], &["not a finite number"]),
        (&["--set", "bed.mass=1e300kg"], &["at most"]),
        (&["--set", "bed.mass=1e999kg"], &["not a finite number"]),
        (&["--set", "bed.mas=1kg"], &["unknown key `bed.mas`", "did you mean `bed.mass`?"]),
        (&["--set", "bed.mass"], &["`=` is missing"]),
        (&["--set", "buffer.end_pressure=0.9at"], &["end_pressure must be above ambient_pressure: 0.9at ≤ 1 at"]),
        (
            &["--set", "cam.bore_radius=80mm", "--set", "cam.base_radius=75mm"],
            &["bore_radius must be below base_radius"],
        ),
        (
            &["--set", "cam.bore_radius=104mm", "--set", "cam.base_radius=10.4cm"],
            &["bore_radius must be below base_radius: 104mm ≥ 10.4cm"],
        ),
        (&["--set", "transition.width=120deg"], &["more than one turn"]),
        (
            &["--set", "cam.cam_turns_per_crank_turn=2"],
            &[
                "would be in the wrong position at the next reversal",
                "1/n with n equal lobes",
                "the nearest of these is 1",
            ],
        ),
        (&["--set", "cam.cam_turns_per_crank_turn=0.8"], &["would be in the wrong position at the next reversal"]),
        (&["--set", "cam.cam_turns_per_crank_turn=0.333"], &["the nearest of these is 0.333333"]),
        (&["--set", "cam.cam_turns_per_crank_turn=0.001"], &["the nearest of these is 0.01"]),
        (&["--set", "cam.base_radius=1000m"], &["more than the largest coordinate of a drawing"]),
        (&["--rpm", "0"], &["at least 0.001"]),
        (&["--rpm", "-35"], &["at least 0.001"]),
        (&["--rpm", "1e-300"], &["at least 0.001"]),
        (&["--rpm", "nan"], &["not a finite number"]),
        (&["--rpm", "fast"], &["does not start with a number"]),
        (&["--rpm", "1e9"], &["at most 100000"]),
        (&["--rpm", "30,35"], &["one speed"]),
        (&["--tolerance", "5"], &["has no unit", "um, mm"]),
        (&["--tolerance", "0um"], &["above 0"]),
        (&["--tolerance", "-1um"], &["above 0"]),
        (&["--tolerance", "1m"], &["at most 0.001 m"]),
        (&["--tolerance", "1e-15mm"], &["cannot be kept"]),
        (&["--format", "dwg"], &["one of dxf, svg, step, csv, json"]),
        (&["--dxf-version", "r14"], &["one of r12, r2000, r2010, r2013"]),
        (&["--samples", "0"], &["--samples"]),
        (&["--name", "../x"], &["no path separators"]),
        (&["--template", "no.svg"], &["cannot read the template"]),
        (&["--no-such-flag"], &["--no-such-flag"]),
        (&["no-such.toml"], &["cannot read the machine file `no-such.toml`", "dpi-paper"]),
        (&["."], &["directory"]),
    ];
    for (args, parts) in cases {
        let run = camgen(&[&["rotary"], *args].concat());
        assert_eq!(run.code, 2, "{args:?}: {}{}", run.out, run.err);
        for part in *parts {
            assert!(run.err.contains(part), "{args:?}: no {part:?} in\n{}", run.err);
        }
        assert!(!run.err.contains("panicked"), "{args:?}: {}", run.err);
        assert!(files(run.directory.path()).is_empty(), "{args:?}");
    }
}

#[test]
fn a_faulty_file_is_told_by_line_column_and_caret() {
    let directory = tempfile::tempdir().expect("a directory");
    let shown = camgen(&["machines", "show", "dpi"]);
    assert_eq!(shown.code, 0);
    let faulty = shown.out.replace("thickness = \"30 mm\"", "thicknes = \"30\"").replace("\"978.2 kg\"", "978.2");
    fs::write(directory.path().join("press.toml"), &faulty).expect("written");
    let run = camgen_in(directory, &["rotary", "press.toml"]);
    assert_eq!(run.code, 2);
    for part in ["press.toml:7:8", "| ^^^^^", "kg, lb", "unknown key `cam.thicknes`", "did you mean `cam.thickness`?"] {
        assert!(run.err.contains(part), "no {part:?} in\n{}", run.err);
    }
}

#[test]
fn a_shown_machine_is_a_file_to_start_from() {
    let directory = tempfile::tempdir().expect("a directory");
    fs::write(directory.path().join("press.toml"), camgen(&["machines", "show", "dpi"]).out).expect("written");
    let run = camgen_in(directory, &["rotary", "press.toml", "--format", "dxf", "--out", "a/b"]);
    assert_eq!(run.code, 0, "{}", run.err);
    let own = fs::read(run.directory.path().join("a/b/press-rotary-35rpm.dxf")).expect("the file");
    let embedded = camgen(&["rotary", "--format", "dxf"]);
    let embedded = fs::read(embedded.directory.path().join("output/dpi-rotary-35rpm.dxf")).expect("the file");
    assert_eq!(own, embedded);
    assert!(camgen(&["machines"]).out.contains("dpi-paper"));
    assert_eq!(camgen(&["machines", "show", "x"]).code, 2);
}

/// Each runs with the command that is listed with it, and another command for cams names that one.
#[test]
fn every_embedded_machine_is_listed_with_its_command() {
    for line in camgen(&["machines"]).out.lines() {
        let mut words = line.split_whitespace();
        let (name, command) = (words.next().expect("a name"), words.next().expect("a command"));
        let run = camgen(&[command, name, "--dry-run"]);
        // The brake of the paper does not hold its web: its check fails.
        assert!(run.code < 2, "{line}: {}", run.err);
        if !["make", "rotary"].contains(&command) {
            let other = camgen(&["make", name]);
            assert_eq!(other.code, 2, "{line}");
            assert!(other.err.contains(&format!("camgen {command} {name}")), "{line}: {}", other.err);
        }
    }
}

#[test]
fn an_output_directory_that_cannot_be_is_told_and_old_files_stay() {
    let directory = tempfile::tempdir().expect("a directory");
    fs::write(directory.path().join("taken"), "mine").expect("written");
    let run = camgen_in(directory, &["rotary", "--out", "taken"]);
    assert_eq!(run.code, 2);
    assert!(
        run.err.contains("cannot create or write the directory `taken`") && run.err.contains("--out"),
        "{}",
        run.err
    );
    assert_eq!(fs::read_to_string(run.directory.path().join("taken")).expect("mine"), "mine");

    let directory = tempfile::tempdir().expect("a directory");
    let out = directory.path().join("output");
    fs::create_dir_all(out.join("dpi-rotary-35rpm.svg")).expect("in the way");
    fs::write(out.join("dpi-rotary-35rpm.dxf"), "old").expect("written");
    let run = camgen_in(directory, &["rotary"]);
    assert_eq!(run.code, 2);
    assert_eq!(files(run.directory.path()), ["dpi-rotary-35rpm.dxf"]);
    let kept = run.directory.path().join("output/dpi-rotary-35rpm.dxf");
    assert_eq!(fs::read_to_string(kept).expect("old"), "old");
}

/// A dry run never writes, so the message of a failed check describes the run without --dry-run.
#[test]
fn a_failed_check_of_a_dry_run_says_what_would_be_written() {
    for args in [&["rotary", "--set", "limits.contact_stress=1MPa"][..], &["regimes", "--rpm", "40"]] {
        let wet = camgen(args);
        assert!(wet.code == 1 && wet.err.contains("nothing was written"), "{args:?}: {}", wet.err);
        let dry = camgen(&[args, &["--dry-run"]].concat());
        assert!(
            dry.code == 1 && dry.err.contains("without --dry-run no file would be written"),
            "{args:?}: {}",
            dry.err
        );
        assert!(!dry.err.contains("nothing was written"), "{args:?}: {}", dry.err);
    }
}

/// No key gives a plane cam the mesh of a conoid, so the message asks for none.
#[test]
fn a_format_of_another_body_is_left_out() {
    let run = camgen(&["make", "feeder", "--format", "stl"]);
    assert_eq!(run.code, 2);
    assert!(run.err.contains("stl is for a conoid; use step for a plane cam; leave stl out"), "{}", run.err);
    assert!(!run.err.contains("give what is missing"), "{}", run.err);
}

#[test]
fn without_a_thickness_there_is_no_solid() {
    let directory = tempfile::tempdir().expect("a directory");
    let flat = camgen(&["machines", "show", "dpi"]).out.replace("thickness = \"30 mm\"", "");
    fs::write(directory.path().join("flat.toml"), flat).expect("written");
    let run = camgen_in(directory, &["rotary", "flat.toml"]);
    assert_eq!(run.code, 0, "{}", run.err);
    assert!(run.err.contains("no STEP file: cam.thickness is not given"), "{}", run.err);
    let run = camgen_in(run.directory, &["rotary", "flat.toml", "--format", "step", "--out", "solid"]);
    assert_eq!(run.code, 2);
    assert!(
        run.err.contains("no step file: cam.thickness is not given") && !run.directory.path().join("solid").exists(),
        "{}",
        run.err
    );
}

#[test]
fn a_template_of_one_s_own_is_filled_in() {
    let directory = tempfile::tempdir().expect("a directory");
    let template =
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{{left}} {{top}} {{width}} {{height}}\">{{drawing}}</svg>";
    fs::write(directory.path().join("mine.svg"), template).expect("written");
    let run = camgen_in(directory, &["rotary", "--template", "mine.svg", "--format", "svg"]);
    assert_eq!(run.code, 0, "{}", run.err);
    let text = fs::read_to_string(run.directory.path().join("output/dpi-rotary-35rpm.svg")).expect("the file");
    assert!(text.contains("id=\"profile\"") && !text.contains("{{"));
}

/// A template of somebody else is refused where it names files or has no bound, and nothing is written.
#[test]
fn a_hostile_template_is_refused() {
    let mask = |i: u32| format!("<mask id=\"c{i}\"><g mask=\"url(#c{0})\"/><g mask=\"url(#c{0})\"/></mask>", i - 1);
    let masks = (1..20).map(mask).collect::<Vec<_>>().concat();
    for (inside, part) in [
        ("<image xlink:href=\"/etc/passwd\" width=\"9\" height=\"9\"/>".to_owned(), "`/etc/passwd`"),
        ("\n<filter id=\"f\"><feTurbulence numOctaves=\"100\"/></filter>".to_owned(), "<filter> at line 2"),
        (masks, "<mask>"),
        ("{{drawing}}".to_owned(), "2 times"),
    ] {
        for format in ["svg", "pdf"] {
            let directory = tempfile::tempdir().expect("a directory");
            let head = "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\">";
            fs::write(directory.path().join("mine.svg"), format!("{head}{inside}{{{{drawing}}}}</svg>"))
                .expect("written");
            let run = camgen_in(directory, &["rotary", "--template", "mine.svg", "--format", format]);
            assert!(run.code == 2 && run.err.contains(part), "{inside}: {}", run.err);
            assert!(!run.directory.path().join("output").exists(), "{inside}");
        }
    }
}

/// A user mends a file in one go: every fault is told at its line, and nothing is written.
#[test]
fn all_faults_of_a_file_are_told_at_once() {
    let directory = tempfile::tempdir().expect("a directory");
    let faulty = [
        "name = \"press\"",
        "colour = \"red\"",
        "[bed]",
        "mass = \"978.2\"",
        "crank_radius = \"-180 mm\"",
        "[follower.roller]",
        "radius = \"30 furlongs\"",
        "[cam]",
        "material = \"steal\"",
    ];
    fs::write(directory.path().join("faulty.toml"), faulty.join("\n")).expect("written");
    let run = camgen_in(directory, &["rotary", "faulty.toml"]);
    assert_eq!(run.code, 2, "{}", run.err);
    for part in [
        "faulty.toml:2:1",
        "unknown key `colour`",
        "faulty.toml:4:8",
        "`978.2` has no unit",
        "faulty.toml:5:16",
        "must be above 0 mm",
        "faulty.toml:7:10",
        "unknown unit `furlongs`",
        "faulty.toml:9:12",
        "`cam.material` cannot be \"steal\"",
        "missing key `buffer.ambient_pressure`",
        "missing key `buffer.end_pressure`",
    ] {
        assert!(run.err.contains(part), "no {part:?} in\n{}", run.err);
    }
    assert_eq!(files(run.directory.path()), ["faulty.toml"]);
}

#[test]
fn a_file_without_a_press_makes_no_cam_of_a_press() {
    for command in ["rotary", "translating", "conoid"] {
        let run = on_lifter(&[command, "lifter.toml"]);
        assert_eq!(run.code, 2, "{command}: {}", run.err);
        for part in ["describes no press", "[bed], [buffer] and [design]", "camgen make"] {
            assert!(run.err.contains(part), "{command}: no {part:?} in\n{}", run.err);
        }
        assert_eq!(files(run.directory.path()), ["lifter.toml"], "{command}");
    }
    let run = camgen(&["make", "dpi"]);
    assert_eq!(run.code, 2, "{}", run.err);
    assert!(run.err.contains("no motion") && run.err.contains("[[motion.segment]]"), "{}", run.err);
    let run = camgen(&["make"]);
    assert_eq!(run.code, 2, "{}", run.err);
    for name in ["feeder", "lever", "valve"] {
        assert!(run.err.contains(&format!("\n  {name} ")), "{}", run.err);
    }
}

/// The lifter beside the tests, in the directory of the run.
fn on_lifter(args: &[&str]) -> Run {
    let directory = tempfile::tempdir().expect("a directory");
    fs::write(directory.path().join("lifter.toml"), include_str!("common/lifter.toml")).expect("written");
    camgen_in(directory, args)
}

#[test]
fn a_motion_program_becomes_a_cam() {
    let run = on_lifter(&["make", "lifter.toml", "--out", "out", "--samples", "360", "--json"]);
    assert_eq!(run.code, 0, "{}", run.err);
    let expected = ["-review.svg", ".csv", ".dxf", ".step", ".svg"].map(|ending| format!("lifter-make-120rpm{ending}"));
    assert_eq!(files(&run.directory.path().join("out")), expected);
    let report = report(&run);
    assert_eq!((&report["command"], &report["rpm"]), (&"make".into(), &120.0.into()), "{report}");
    assert!(report["law"].is_null() && report["notes"].is_null(), "{report}");
    let csv = fs::read_to_string(run.directory.path().join("out/lifter-make-120rpm.csv")).expect("a table");
    let header: Vec<&str> = csv.lines().next().expect("a header").split(',').collect();
    for column in ["crank_deg", "x_mm", "dx_mm"] {
        assert!(!header.contains(&column), "{column} is of a press: {header:?}");
    }
    let rows: Vec<Vec<f64>> =
        csv.lines().skip(1).map(|line| line.split(',').map(|cell| cell.parse().expect("a number")).collect()).collect();
    let lift = header.iter().position(|name| *name == "lift_mm").expect("a lift");
    // Half way up, at rest, and half way down by the cycloid, over the 180 degrees that are left.
    for (degrees, expected) in [(0, 0.0), (60, 10.0), (120, 20.0), (150, 20.0), (270, 10.0)] {
        assert!((rows[degrees][lift] - expected).abs() < 1e-12, "{degrees}: {:?}", rows[degrees]);
    }
}

/// The cut file of a motion program is its cam, also unasked, and not that of another lift.
#[test]
fn the_cam_of_a_motion_program_is_checked() {
    let mut directory = on_lifter(&["make", "lifter.toml", "--name", "cam", "--out", ".", "--format", "dxf"]).directory;
    for (args, code) in [(&[][..], 0), (&["--cam", "make"], 0), (&["--set", "motion.segment[0].to=20.05mm"], 1)] {
        let run = camgen_in(directory, &[&["check", "cam.dxf", "lifter.toml"], args].concat());
        assert_eq!(run.code, code, "{args:?}: {}{}", run.out, run.err);
        directory = run.directory;
    }
}

/// An undercut profile under a flat face has its sheet when it is forced, and the exit code of a failed check.
#[test]
fn a_forced_flat_face_has_a_sheet() {
    let directory = tempfile::tempdir().expect("a directory");
    let lifter = include_str!("common/lifter.toml");
    let start = lifter.find("[follower").expect("a follower");
    let end = lifter[start..].find("\n[").map_or(lifter.len(), |at| start + at + 1);
    let flat = [&lifter[..start], "[follower.flat]\n", &lifter[end..]].concat();
    fs::write(directory.path().join("flat.toml"), flat).expect("written");
    let args = ["make", "flat.toml", "--set", "cam.base_radius=5mm", "--force", "--name", "cam", "--out", "out"];
    let run = camgen_in(directory, &args);
    assert_eq!(run.code, 1, "{}", run.err);
    assert!(run.out.contains("FAIL  undercut"), "{}", run.out);
    assert_eq!(
        files(&run.directory.path().join("out")),
        ["cam-review.svg", "cam.csv", "cam.dxf", "cam.step", "cam.svg"]
    );
}

/// Names of formats and versions as the programs that read them write them.
#[test]
fn formats_and_versions_may_be_in_capitals() {
    let run = camgen(&["rotary", "--format", "DXF,Json", "--dxf-version", "R12", "--name", "cam", "--out", "out"]);
    assert_eq!(run.code, 0, "{}", run.err);
    let out = run.directory.path().join("out");
    assert_eq!(files(&out), ["cam.dxf", "cam.json"]);
    assert!(fs::read_to_string(out.join("cam.dxf")).expect("a drawing").contains("AC1009"));
}

/// A limit that nothing keeps: every kind of cam of a press knows the force on its roller.
#[test]
fn a_contact_that_bears_too_much_is_refused() {
    for args in [&["rotary"][..], &["translating"], &["conoid", "--rpm", "20,35"]] {
        let run = camgen(&[args, &["--set", "limits.contact_stress=1MPa"]].concat());
        assert_eq!(run.code, 1, "{args:?}: {}", run.err);
        assert!(run.out.contains("FAIL  contact_stress"), "{args:?}: {}", run.out);
        assert!(run.err.contains("nothing was written") && files(run.directory.path()).is_empty(), "{args:?}");
    }
}

#[test]
fn a_key_without_effect_is_told() {
    let told = "`cam.balance` has no effect on a conoid";
    let args = ["conoid", "--rpm", "20,35", "--format", "csv", "--set", "cam.balance=40mm .. 60mm"];
    let run = camgen(&args);
    assert_eq!(run.code, 0, "{}", run.err);
    assert!(run.out.contains(told), "{}", run.out);
    let run = camgen(&[&args[..], &["--json"]].concat());
    assert_eq!(report(&run)["notes"], serde_json::json!([told]), "{}", run.out);
    let run = camgen(&["conoid", "--rpm", "20,35", "--format", "csv", "--json"]);
    assert!(report(&run)["notes"].is_null(), "nothing to tell: {}", run.out);
}

#[test]
fn the_template_makes_a_cam() {
    let shown = camgen(&["init"]);
    assert_eq!(shown.code, 0, "{}", shown.err);
    let directory = tempfile::tempdir().expect("a directory");
    fs::write(directory.path().join("mine.toml"), &shown.out).expect("written");
    let run = camgen_in(directory, &["rotary", "mine.toml", "--out", "out"]);
    assert_eq!(run.code, 0, "{} {}", run.out, run.err);
    // It tells no thickness, so there is no solid.
    let expected = ["-review.svg", ".csv", ".dxf", ".svg"].map(|ending| format!("mine-rotary-35rpm{ending}"));
    assert_eq!(files(&run.directory.path().join("out")), expected);
}

#[test]
fn the_schema_is_json() {
    let run = camgen(&["schema"]);
    assert_eq!(run.code, 0, "{}", run.err);
    let schema = report(&run);
    assert_eq!(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
    for table in ["bed", "buffer", "motion", "follower", "cam", "limits"] {
        assert!(schema["properties"][table].is_object(), "{table}: {schema}");
    }
}

#[test]
fn a_check_is_explained_by_name() {
    let run = camgen(&["explain", "rolling"]);
    assert_eq!(run.code, 0, "{}", run.err);
    assert!(run.out.starts_with("rolling\n") && run.out.contains("gap"), "{}", run.out);
    let run = camgen(&["explain", "nonsense"]);
    assert_eq!(run.code, 2);
    assert!(run.out.is_empty() && run.err.contains("no such check") && run.err.contains("rolling"), "{}", run.err);
}

#[test]
fn help_and_version_are_there() {
    assert!(camgen(&["--version"]).out.starts_with("camgen "));
    let help = camgen(&["rotary", "--help"]).out;
    for flag in [
        "--rpm",
        "--tolerance",
        "--set",
        "--format",
        "--out",
        "--name",
        "--dxf-version",
        "--samples",
        "--force",
        "--json",
    ] {
        assert!(help.contains(flag), "{flag}");
    }
    let alone = camgen(&[]);
    assert_eq!(alone.code, 0);
    assert!(alone.out.lines().count() <= 40 && alone.out.lines().all(|line| line.len() <= 100), "{}", alone.out);
}
