//! The program as a user meets it: exit codes, messages, files.

#![allow(clippy::expect_used, clippy::panic, missing_docs, reason = "a test fails loudly")]

use assert_cmd::Command;
use serde_json::Value;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

struct Run {
    code: i32,
    out: String,
    err: String,
    directory: TempDir,
}

/// Runs camgen in an empty directory.
fn camgen(args: &[&str]) -> Run {
    camgen_in(tempfile::tempdir().expect("a directory"), args)
}

fn camgen_in(directory: TempDir, args: &[&str]) -> Run {
    camgen_on(None, directory, args)
}

/// On a number of threads.
fn camgen_on(threads: Option<&str>, directory: TempDir, args: &[&str]) -> Run {
    let output = Command::cargo_bin("camgen")
        .expect("the program")
        .envs(threads.map(|threads| ("RAYON_NUM_THREADS", threads)))
        .current_dir(directory.path())
        .args(args)
        .output()
        .expect("it runs");
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).expect("UTF-8");
    Run { code: output.status.code().expect("a code"), out: text(&output.stdout), err: text(&output.stderr), directory }
}

/// Every file below a directory.
fn files(directory: &Path) -> Vec<String> {
    let mut found = Vec::new();
    for entry in fs::read_dir(directory).expect("a directory") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            found.extend(files(&path));
        } else {
            found.push(path.file_name().expect("a name").to_string_lossy().into_owned());
        }
    }
    found.sort();
    found
}

fn report(run: &Run) -> Value {
    serde_json::from_str(&run.out).unwrap_or_else(|e| panic!("{e}: {}", run.out))
}

#[test]
fn the_main_job() {
    let run = camgen(&["rotary", "--rpm", "35"]);
    assert_eq!(run.code, 0, "{}", run.err);
    let stem = "dpi-rotary-35rpm";
    let expected = ["csv", "dxf", "step", "svg"].map(|extension| format!("{stem}.{extension}"));
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
fn a_plate_is_written_with_the_names_of_the_contract() {
    let run = camgen(&["translating", "--rpm", "35", "--samples", "9"]);
    assert_eq!(run.code, 0, "{}", run.err);
    let expected = ["csv", "dxf", "step", "svg"].map(|extension| format!("dpi-translating-35rpm.{extension}"));
    assert_eq!(files(run.directory.path()), expected);
    let csv = fs::read_to_string(run.directory.path().join("output/dpi-translating-35rpm.csv")).expect("a table");
    let header =
        "x_mm,dx_mm,psi_deg,alpha_deg,pitch_x_mm,pitch_y_mm,profile_x_mm,profile_y_mm,roller_force_n,residual_return_n";
    assert!(csv.starts_with(header), "{csv}");
    let rows: Vec<Vec<f64>> =
        csv.lines().skip(1).map(|line| line.split(',').map(|cell| cell.parse().expect("a number")).collect()).collect();
    assert_eq!(rows.len(), 10);
    for (x, dx) in [(20.0, -1.151_334_7), (60.0, -7.199_936_8), (120.0, -24.872_067_8), (180.0, -51.537_927_9)] {
        assert!(rows.iter().any(|row| row[0] == x && (row[1] - dx).abs() < 6e-8), "{x}: {rows:?}");
    }
    let run = camgen(&["translating", "--json", "--balance", "mean", "--set", "buffer.column=return"]);
    let report = report(&run);
    let force = &report["force"];
    let (braking, back) = (force["residual_braking_max_n"].as_f64(), force["residual_return_max_n"].as_f64());
    let (braking, back) = (braking.expect("a force"), back.expect("a force"));
    assert!((braking - back).abs() < 1e-6 * braking && report["command"] == "translating", "{report}");
    assert!(report["law"]["equation_18"]["breaks"].as_array().is_some_and(|breaks| !breaks.is_empty()), "{report}");
}

#[test]
fn walls_of_a_plate_and_flags_that_do_not_go_together_are_told() {
    for (args, code, part) in [
        (vec!["--set", "translating.bottom_arm=40mm"], 2, "grows without bound near x = 14"),
        (vec!["--set", "buffer.lead=5mm"], 2, "knows no lead"),
        (vec!["--stations", "18"], 2, "belongs to --solver paper"),
        (vec!["--solver", "paper", "--stations", "1"], 2, "2..=1000000"),
        (vec!["--rpm", "20,35"], 2, "one speed, not 2"),
        (vec!["--set", "translating.plate_height=90mm"], 1, "translating.plate_height must exceed 98.595"),
        (vec!["--set", "translating.delta=30deg"], 1, "a check failed"),
    ] {
        let run = camgen(&[&["translating"], &args[..]].concat());
        assert_eq!(run.code, code, "{args:?}: {}", run.err);
        assert!(run.err.contains(part), "{args:?}: {}", run.err);
        assert!(files(run.directory.path()).is_empty(), "{args:?}");
    }
}

/// The paper's solver with 18 stations misses by a millimetre: `check` sees that the plate is not the law's.
#[test]
fn a_plate_is_checked_against_the_law() {
    for balance in ["return", "mean"] {
        let made = camgen(&["translating", "--name", "plate", "--out", ".", "--balance", balance]);
        assert_eq!(made.code, 0, "{}", made.err);
        let checked = camgen_in(made.directory, &["check", "plate.dxf", "--cam", "translating", "--balance", balance]);
        assert_eq!(checked.code, 0, "{}", checked.out);
    }
    for (stations, code) in [(None, 0), (Some("18"), 1)] {
        let solver = stations.map_or(vec![], |stations| vec!["--solver", "paper", "--stations", stations]);
        let made = camgen(&[&["translating", "--name", "plate", "--out", "."], &solver[..]].concat());
        assert_eq!(made.code, 0, "{}", made.err);
        let checked = camgen_in(made.directory, &["check", "plate.dxf", "--cam", "translating"]);
        assert_eq!(checked.code, code, "{}", checked.out);
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
        assert!(["pass", "fail", "info"].contains(&finding["verdict"].as_str().expect("a verdict")));
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
         profile_curvature_radius_mm,roller_force_n,torque_nm,contact_force_n"
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
    assert_eq!(files(forced.directory.path()).len(), 4);
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
    assert_eq!(files(camgen(&[&undercut[..], &["--force"]].concat()).directory.path()).len(), 4);

    let sets = ["cam.base_radius=1mm", "cam.lever=10", "follower.roller.radius=300mm", "cam.bore_radius=0.5mm"];
    let folded: Vec<&str> =
        ["rotary", "--force"].into_iter().chain(sets.iter().flat_map(|set| ["--set", set])).collect();
    let run = camgen(&folded);
    assert_eq!(run.code, 1);
    assert!(run.err.contains("folds over itself") && run.err.contains("with --force neither"), "{}", run.err);
    assert!(files(run.directory.path()).is_empty());
}

#[test]
fn a_cutter_gets_its_own_file_or_is_told_where_it_does_not_get_in() {
    let run = camgen(&["rotary", "--cutter", "8mm", "--format", "dxf"]);
    assert_eq!(run.code, 0, "{}", run.out);
    assert_eq!(files(run.directory.path()), ["dpi-rotary-35rpm-cutter.dxf", "dpi-rotary-35rpm.dxf"]);
    let path = fs::read_to_string(run.directory.path().join("output/dpi-rotary-35rpm-cutter.dxf")).expect("the file");
    assert!(path.contains("CUTTER_PATH") && !path.contains("CAM_PROFILE"));
    let run = camgen(&["rotary", "--cutter", "400mm"]);
    assert_eq!(run.code, 1);
    assert!(run.out.contains("FAIL  cutter_radius") && files(run.directory.path()).is_empty(), "{}", run.out);
    assert_eq!(camgen(&["rotary", "--cutter", "8"]).code, 2);
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
        (&["--set", "bed.mass"], &["no `=`"]),
        (&["--set", "buffer.end_pressure=0.9at"], &["end_pressure must be above ambient_pressure: 0.9at ≤ 1 at"]),
        (
            &["--set", "cam.bore_radius=80mm", "--set", "cam.base_radius=75mm"],
            &["bore_radius must be below base_radius"],
        ),
        (&["--set", "transition.width=120deg"], &["more than one turn"]),
        (&["--set", "cam.cam_turns_per_crank_turn=2"], &["more than one turn"]),
        (&["--set", "cam.base_radius=1000m"], &["more than a drawing holds"]),
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

#[test]
fn an_output_directory_that_cannot_be_is_told_and_old_files_stay() {
    let directory = tempfile::tempdir().expect("a directory");
    fs::write(directory.path().join("taken"), "mine").expect("written");
    let run = camgen_in(directory, &["rotary", "--out", "taken"]);
    assert_eq!(run.code, 2);
    assert!(run.err.contains("cannot make the directory `taken`") && run.err.contains("--out"), "{}", run.err);
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
    assert!(run.err.contains("needs cam.thickness") && !run.directory.path().join("solid").exists(), "{}", run.err);
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

/// Files of a conoid, the same on one thread and on four.
#[test]
fn a_conoid_has_a_cut_for_each_speed_and_the_same_bytes_on_any_number_of_threads() {
    let args =
        ["conoid", "--rpm", "20,25,30,35", "--name", "c", "--samples", "36", "--format", "dxf,svg,step,csv,json,stl"];
    let on = |threads| camgen_on(Some(threads), tempfile::tempdir().expect("a directory"), &args);
    let (one, four) = (on("1"), on("4"));
    assert_eq!(one.code, 0, "{}", one.err);
    assert_eq!(one.out, four.out);
    let expected =
        ["c-20rpm.dxf", "c-25rpm.dxf", "c-30rpm.dxf", "c-35rpm.dxf", "c.csv", "c.json", "c.step", "c.stl", "c.svg"];
    assert_eq!(files(one.directory.path()), expected);
    for name in expected {
        let read = |run: &Run| fs::read(run.directory.path().join("output").join(name)).expect("a file");
        assert!(read(&one) == read(&four), "{name}");
    }
    let csv = fs::read_to_string(one.directory.path().join("output/c.csv")).expect("a table");
    assert!(csv.starts_with("z_mm,cam_deg,crank_deg,x_mm,dx_mm,lift_mm,"), "{csv}");
    assert!(!csv.contains("NaN") && csv.lines().count() == 1 + 4 * 36);
    let stl = fs::read(one.directory.path().join("output/c.stl")).expect("a mesh");
    let count = u32::from_le_bytes([stl[80], stl[81], stl[82], stl[83]]);
    assert_eq!(stl.len(), 84 + 50 * usize::try_from(count).expect("small"));
}

/// Every edge of the mesh is used once in either direction: it is closed and turned one way.
#[test]
fn the_mesh_of_a_conoid_is_closed() {
    for bore in [&[][..], &["--set", "cam.rotation=ccw"]] {
        let run = camgen(&[&["conoid", "--rpm", "20,35", "--name", "c", "--format", "stl"], bore].concat());
        assert_eq!(run.code, 0, "{}", run.err);
        let stl = fs::read(run.directory.path().join("output/c.stl")).expect("a mesh");
        let mut edges = std::collections::HashMap::new();
        let mut volume = 0.0;
        for triangle in stl[84..].chunks(50) {
            let corner = |i: usize| -> [f32; 3] {
                std::array::from_fn(|k| {
                    let at = 12 + 12 * i + 4 * k;
                    f32::from_le_bytes([triangle[at], triangle[at + 1], triangle[at + 2], triangle[at + 3]])
                })
            };
            let corners = [corner(0), corner(1), corner(2)];
            let [a, b, c] = corners.map(|p| p.map(f64::from));
            volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
                + a[2] * (b[0] * c[1] - b[1] * c[0]))
                / 6.0;
            for i in 0..3 {
                let key = |p: [f32; 3]| p.map(f32::to_bits);
                *edges.entry((key(corners[i]), key(corners[(i + 1) % 3]))).or_insert(0) += 1;
            }
        }
        assert!(edges.iter().all(|((a, b), n)| *n == 1 && edges.get(&(*b, *a)) == Some(&1)));
        assert!((volume / 6.3e6 - 1.0).abs() < 0.01, "{volume}");
    }
}

#[test]
fn what_makes_no_conoid_is_told() {
    for (args, code, part) in [
        (vec!["--rpm", "20..35"], 2, "needs --residual"),
        (vec!["--rpm", "35..20", "--residual", "2N"], 2, "from the slower to the faster"),
        (vec!["--rpm", "20,20,35"], 2, "asked for twice"),
        (vec!["--rpm", "20,35", "--residual", "2mm"], 2, "a force has one of"),
        (vec!["--rpm", "20,35", "--set", "transition.kind=none"], 2, "have a corner"),
        (vec!["--rpm", "20,25,30,35", "--set", "conoid.axial_travel=5mm"], 2, "no base radius keeps the limits"),
        (vec!["--rpm", "20,35", "--residual", "2N"], 1, "a check failed"),
        (vec!["--rpm", "20,35", "--set", "cam.base_radius=50mm"], 1, "a check failed"),
        (
            vec!["--rpm", "20,35", "--set", "follower.roller.crown=cylinder", "--set", "follower.roller.width=20mm"],
            1,
            "a check failed",
        ),
        (vec!["--rpm", "20,35", "--set", "conoid.overhang=1mm"], 1, "a check failed"),
    ] {
        let run = camgen(&[&["conoid"], &args[..]].concat());
        assert_eq!(run.code, code, "{args:?}: {} {}", run.err, run.out);
        assert!(run.err.contains(part), "{args:?}: {}", run.err);
        assert!(files(run.directory.path()).is_empty(), "{args:?}");
    }
    let rotary = camgen(&["rotary", "--format", "stl"]);
    assert!(rotary.code == 2 && rotary.err.contains("for a conoid"), "{}", rotary.err);
    let found = camgen(&["conoid", "--rpm", "20..35", "--residual", "2N", "--json", "--format", "csv"]);
    let report = report(&found);
    assert_eq!(report["rpm"], serde_json::json!([20.0, 25.0, 30.0, 35.0]));
    assert!(report["between"]["residual_max_n"].as_f64().is_some_and(|force| force < 2.0), "{report}");
}

/// The ladder gets finer from row to row: less is left, more arcs are laid; the advice keeps the limit.
#[test]
fn trade_measures_a_ladder_and_advises() {
    for (kind, rows) in [("rotary", 9), ("translating", 17)] {
        let run = camgen(&["trade", kind, "--json", "--residual", "5N"]);
        assert_eq!(run.code, 0, "{}", run.err);
        let report = report(&run);
        let found = report["rows"].as_array().expect("rows");
        assert_eq!(found.len(), rows, "{report}");
        let of = |row: &Value, key: &str| row[key].as_f64().unwrap_or_else(|| panic!("{key}: {row}"));
        assert!(of(&found[8], "residual_n") < 0.05 * of(&found[0], "residual_n"));
        assert!(found[..9].windows(2).all(|pair| of(&pair[0], "arcs") <= of(&pair[1], "arcs")));
        assert!(found.iter().all(|row| of(row, "total_us") > 0.0 && of(row, "bytes") > 1e4));
        assert!(report["advice"].as_str().is_some_and(|advice| advice.contains("cheapest")), "{report}");
        let stem = format!("dpi-trade-{kind}-35rpm");
        assert_eq!(files(run.directory.path()), [format!("{stem}.csv"), format!("{stem}.svg")]);
    }
    assert_eq!(camgen(&["trade", "conoid"]).code, 2);
}

#[test]
fn sides_and_named_accuracies() {
    let arcs = |args: &[&str]| {
        let run = camgen(&[&["rotary", "--json", "--format", "dxf"], args].concat());
        assert_eq!(run.code, 0, "{args:?}: {}", run.err);
        let report = report(&run);
        let gap = report["rolling"]["gap_mm"].as_f64().expect("a gap");
        (report["outline"]["arcs"].as_u64().expect("a count"), gap)
    };
    let (draft, standard, fine) =
        (arcs(&["--accuracy", "draft"]), arcs(&["--accuracy", "standard"]), arcs(&["--accuracy", "fine"]));
    assert!(draft.0 < standard.0 && standard.0 < fine.0);
    assert_eq!(standard, arcs(&[]));
    // Metal in the way is a negative gap, metal missing a positive one.
    assert!(arcs(&["--side", "outside"]).1 < 0.0 && arcs(&["--side", "inside"]).1 > 0.0);
    for side in ["outside", "inside"] {
        assert_eq!(camgen(&["translating", "--side", side]).code, 0);
        assert_eq!(camgen(&["conoid", "--rpm", "20,35", "--side", side]).code, 0);
    }
    assert_eq!(camgen(&["rotary", "--accuracy", "fine", "--tolerance", "5um"]).code, 2);
}

/// The pictures in the README are the pictures the program makes.
#[test]
fn the_pictures_in_the_readme_are_current() {
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden");
    for (command, rpm, name) in [
        ("rotary", "35", "dpi-rotary-35rpm.svg"),
        ("translating", "35", "dpi-translating-35rpm.svg"),
        ("conoid", "20,25,30,35", "dpi-conoid-20-25-30-35rpm.svg"),
    ] {
        let run = camgen(&[command, "--rpm", rpm, "--format", "svg"]);
        let made = fs::read_to_string(run.directory.path().join("output").join(name)).expect("the file");
        let kept = fs::read_to_string(golden.join(name)).expect("kept");
        assert!(made == kept, "{name} has changed: look at it, and if it is right copy it to tests/golden");
    }
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
    assert_eq!(camgen(&[]).code, 2);
}
