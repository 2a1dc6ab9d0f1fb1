//! Plates, conoids and the ladder of accuracies as a user meets them.

use crate::common::program::{Run, camgen, camgen_in, camgen_on, files, report};
use serde_json::Value;
use std::fs;

#[test]
fn a_plate_is_written_with_the_names_of_the_contract() {
    let run = camgen(&["translating", "--rpm", "35", "--samples", "9"]);
    assert_eq!(run.code, 0, "{}", run.err);
    let expected =
        ["-review.svg", ".csv", ".dxf", ".step", ".svg"].map(|ending| format!("dpi-translating-35rpm{ending}"));
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
        (vec!["--set", "translating.bottom_arm=40mm"], 2, "lies along the flank) at x = 14"),
        (vec!["--set", "buffer.lead=5mm"], 2, "holds without a lead only"),
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
    // With less friction a plate for both directions is better than none in both.
    let light = ["--set", "translating.friction_angle=1deg", "--balance"];
    for balance in ["return", "mean"] {
        let made = camgen(&[&["translating", "--name", "plate", "--out", "."][..], &light, &[balance]].concat());
        assert_eq!(made.code, 0, "{}", made.err);
        let check = [&["check", "plate.dxf", "--cam", "translating"][..], &light, &[balance]].concat();
        let checked = camgen_in(made.directory, &check);
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

/// Under a crank-slider each end of the stroke has a plate of its own, and the rod is an input of it.
#[test]
fn a_crank_slider_moves_a_plate_at_either_end_and_an_offset_none() {
    let high = ["--set", "translating.plate_height=280mm", "--set", "limits.pressure_angle=40deg"];
    for (end, stroke, other) in [("outer", 156.124_242_481, "inner"), ("inner", 203.875_757_519, "outer")] {
        let args =
            [&["translating", "dpi-crank-slider", "--end", end, "--name", "plate", "--out", "."][..], &high].concat();
        let made = camgen(&args);
        assert_eq!(made.code, 0, "{}{}", made.out, made.err);
        let csv = fs::read_to_string(made.directory.path().join("plate.csv")).expect("a table");
        let last: f64 = csv.lines().last().and_then(|row| row.split(',').next()?.parse().ok()).expect("a place");
        assert!((last - stroke).abs() < 1e-6, "{end}: {last}");
        let check = |end: &'static str| {
            [&["check", "plate.dxf", "dpi-crank-slider", "--cam", "translating", "--end", end][..], &high].concat()
        };
        let checked = camgen_in(made.directory, &check(end));
        assert_eq!(checked.code, 0, "{}{}", checked.out, checked.err);
        let checked = camgen_in(checked.directory, &check(other));
        assert_eq!(checked.code, 1, "{}{}", checked.out, checked.err);
    }
    for (set, part) in [
        ("linkage.offset_ratio=0.1", "an offset"),
        ("transition.width=120deg", "below 106.824 deg, which the bed takes"),
    ] {
        let run = camgen(&["translating", "dpi-crank-slider", "--set", set]);
        assert_eq!(run.code, 2, "{set}: {}", run.err);
        assert!(run.err.contains(part) && files(run.directory.path()).is_empty(), "{set}: {}", run.err);
    }
    let idle = camgen(&["translating", "dpi-crank-slider", "--set", "linkage.rod_ratio=4", "--json"]);
    assert_eq!(idle.code, 0, "{}", idle.err);
    assert!(!idle.out.contains("has no effect"), "{}", idle.out);
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
    let expected = [
        "c-20rpm.dxf",
        "c-25rpm.dxf",
        "c-30rpm.dxf",
        "c-35rpm.dxf",
        "c-review.svg",
        "c.csv",
        "c.json",
        "c.step",
        "c.stl",
        "c.svg",
    ];
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
        assert!((volume / 6.61e6 - 1.0).abs() < 0.01, "{volume}");
    }
}

#[test]
fn what_makes_no_conoid_is_told() {
    for (args, code, part) in [
        (vec!["--rpm", "20..35"], 2, "needs --residual"),
        (vec!["--rpm", "35..20", "--residual", "2N"], 2, "from the slower to the faster"),
        (vec!["--rpm", "20,20,35"], 2, "is given twice"),
        (vec!["--rpm", "20,35", "--residual", "2mm"], 2, "a force has one of"),
        (vec!["--rpm", "20,35", "--set", "transition.kind=none"], 2, "have a corner"),
        (vec!["--rpm", "20,25,30,35", "--set", "conoid.axial_travel=5mm"], 2, "no base radius keeps the limits"),
        (vec!["--rpm", "20,35", "--residual", "2N"], 1, "a check failed"),
        (vec!["--rpm", "25..45", "--residual", "1e-9N"], 2, "give a --residual of at least"),
        (vec!["--rpm", "1..1e4", "--residual", "10N"], 2, "give a larger --residual"),
        (vec!["--rpm", "20,30,35", "--samples", "100000"], 2, "give --samples 66666 at most"),
        (vec!["--rpm", "20,35", "--samples", "10000000"], 2, "from 1 to 200000 rows"),
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

/// What is refused is refused for its own reason, and the remedy works.
#[test]
fn a_conoid_that_cannot_be_drawn_is_told_why() {
    let steep = ["conoid", "--tolerance", "0.911561mm", "--rpm", "22.71,42.15,52.89", "--format", "csv"];
    let sets = ["transition.width=57.7189deg", "cam.lever=426.31", "limits.pressure_angle=73.06deg"];
    let with = |more: &[&str]| {
        let all = sets.iter().chain(more).flat_map(|set| ["--set", set]);
        camgen(&steep.into_iter().chain(all).collect::<Vec<_>>())
    };
    let run = with(&[]);
    assert!(run.code == 1 && run.err.contains("leans 89.9"), "{}", run.err);
    let travel = run.err.split('"').nth(1).expect("a travel").replace(' ', "");
    let remedied = with(&[&format!("conoid.axial_travel={travel}")]);
    assert!(!remedied.err.contains("no section can be drawn"), "{}", remedied.err);
    let fine = camgen(&["conoid", "--tolerance", "1e-8mm", "--format", "step"]);
    assert!(fine.code == 2 && fine.err.contains("a tolerance of "), "{}", fine.err);
    let named =
        fine.err.split("a tolerance of ").nth(1).and_then(|rest| rest.split(" mm").next()).expect("a tolerance");
    let run = camgen(&["conoid", "--tolerance", &format!("{named}mm"), "--format", "step"]);
    assert_eq!(run.code, 0, "{named}: {}", run.err);
}

/// The sphere never rides on an edge: the overhang is found by itself, and one too short fails with a length that does.
#[test]
fn a_conoid_is_as_long_as_the_contact_needs() {
    let conoid = |set: &[&str]| {
        let args = ["conoid", "--rpm", "20,25,30,35", "--json", "--format", "csv"];
        let sets = set.iter().flat_map(|set| ["--set", set]);
        camgen(&args.into_iter().chain(sets).collect::<Vec<_>>())
    };
    let reach = |run: &Run| {
        let report = report(run);
        let findings = report["checks"].as_array().expect("checks").clone();
        (report, findings.into_iter().find(|finding| finding["check"] == "axial_reach").expect("axial_reach"))
    };
    let run = conoid(&[]);
    let (auto, finding) = reach(&run);
    assert_eq!((run.code, finding["verdict"].as_str(), finding["value"].as_f64()), (0, Some("pass"), Some(0.0)));
    assert_eq!(auto["cam"]["overhang_mm"], 3.0);
    assert_eq!((&auto["cam"]["z_min_mm"], &auto["cam"]["z_max_mm"]), (&(-3.0).into(), &123.0.into()));
    assert_eq!((&auto["sections"][0]["z_mm"], &auto["sections"][3]["z_mm"]), (&0.0.into(), &120.0.into()));
    for short in ["0mm", "2mm"] {
        let run = conoid(&[&format!("conoid.overhang={short}")]);
        let (_, finding) = reach(&run);
        assert_eq!((run.code, finding["verdict"].as_str()), (1, Some("fail")), "{short}: {finding}");
        let note = finding["note"].as_str().expect("a remedy");
        let named = note.split('"').nth(1).expect("a length");
        let remedied = conoid(&[&format!("conoid.overhang={named}")]);
        assert_eq!((named, remedied.code), ("3 mm", 0), "{note}: {}", remedied.err);
    }
}

/// The ladder gets finer from row to row: less is left, more arcs are laid; the advice keeps the limit.
#[test]
fn trade_measures_a_ladder_and_advises() {
    for (kind, rows) in [("rotary", 20), ("translating", 23)] {
        let run = camgen(&["trade", kind, "--json", "--residual", "5N"]);
        assert_eq!(run.code, 0, "{}", run.err);
        let report = report(&run);
        let found = report["rows"].as_array().expect("rows");
        assert_eq!(found.len(), rows, "{report}");
        let of = |row: &Value, key: &str| row[key].as_f64().unwrap_or_else(|| panic!("{key}: {row}"));
        assert!(of(&found[8], "residual_n") < 0.05 * of(&found[0], "residual_n"));
        assert!(found[..9].windows(2).all(|pair| of(&pair[0], "arcs") <= of(&pair[1], "arcs")));
        assert!(found.iter().all(|row| of(row, "total_us") > 0.0 && of(row, "bytes") > 1e3));
        // Arcs that keep the acceleration, splines of fewer pieces, and for a disc tables of points stand beside them.
        let named = |name: &str| found.iter().find(|row| row["setting"] == name).unwrap_or_else(|| panic!("no {name}"));
        let (standard, spline) = (named("5 µm, 5 % (standard)"), named("spline, 5 µm, 5 %"));
        for row in [standard, spline] {
            assert!(of(row, "acceleration_share") <= 0.05 && of(row, "rolled_mm") <= 0.005, "{row}");
        }
        assert!(of(spline, "pieces") < of(standard, "pieces"));
        if kind == "rotary" {
            assert!(of(named("points, cubic, 5 µm"), "rolled_mm") <= 0.005);
            let felt = named("points, cubic, 5 µm, 5 %");
            assert!(of(felt, "acceleration_share") <= 0.05 && of(felt, "rolled_mm") <= 0.005, "{felt}");
            assert!(of(named("points, cubic, 0.5 µm, 1 %"), "acceleration_share") <= 0.01);
            assert!(
                of(standard, "torque_error_nm") < of(&found[3], "torque_error_nm"),
                "it falls with the acceleration"
            );
        }
        assert!(report["advice"].as_str().is_some_and(|advice| advice.contains("cheapest")), "{report}");
        // The advice also keeps the default acceleration limit: a cam made with its flags passes.
        let advised = found.iter().find(|row| row["rank"] == 1).expect("an advice");
        assert!(of(advised, "acceleration_share") <= 0.05, "{advised}");
        // The stages add up to the total.
        for row in found {
            let stages = ["law_us", "outline_us", "checks_us", "dxf_us", "svg_us", "step_us", "csv_us"];
            let sum: f64 = stages.iter().filter_map(|stage| row[stage].as_f64()).sum();
            assert!((sum - of(row, "total_us")).abs() < 1e-6 * sum, "{row}");
        }
        let stem = format!("dpi-trade-{kind}-35rpm");
        assert_eq!(files(run.directory.path()), [format!("{stem}.csv"), format!("{stem}.svg")]);
    }
    assert_eq!(camgen(&["trade", "conoid"]).code, 2);
    assert_eq!(camgen(&["trade", "rotary", "--rpm", "20..35"]).code, 2);
    assert_eq!(camgen(&["trade", "--acceleration", "2mm/rad2"]).code, 2);
    let run = camgen(&["trade", "--json", "--residual", "5N", "--acceleration", "2%"]);
    let report = report(&run);
    let advice = report["advice"].as_str().expect("an advice");
    assert!(advice.starts_with("5 µm, 2 % "), "{advice}");
    // The flags, pasted, make a cam that keeps what was asked.
    let flags: Vec<&str> = report["flags"].as_str().expect("flags").split(' ').collect();
    let made = camgen(&[&["rotary", "--json", "--dry-run"], &flags[..]].concat());
    assert_eq!(made.code, 0, "{}", made.err);
    let made = self::report(&made);
    assert!(made["force"]["residual_max_n"].as_f64().is_some_and(|left| left <= 5.0), "{made}");
    let [error, of] = ["acceleration_error_max_mm_per_rad2", "acceleration_of_motion_max_mm_per_rad2"]
        .map(|key| made["rolling"][key].as_f64().expect("a number"));
    assert!(error <= 0.02 * of, "{error} {of}");
}

/// The advice does not depend on the clock, names the part of the machine that limits, and is there for every kind.
#[test]
fn trade_names_what_limits_and_knows_every_kind() {
    let once = || report(&camgen(&["trade", "rotary", "dpi-shaft", "--json", "--dry-run"]));
    let (first, second) = (once(), once());
    assert_eq!([&first["advice"], &first["flags"]], [&second["advice"], &second["flags"]]);
    let part = |name: &str| {
        let chain = first["chain"].as_array().expect("a chain");
        let found = chain.iter().find(|part| part["part"] == name).unwrap_or_else(|| panic!("no {name}: {chain:?}"));
        found["residual_n"].as_f64().expect("a force")
    };
    assert!((part("shaft") - 143.689).abs() < 1e-3 && part("outline") < 2.2 && part("scatter") > 400.0);
    let advice = first["advice"].as_str().expect("an advice");
    assert!(advice.contains("the outline is not what limits: the part `scatter`"), "{advice}");
    // A cam that is cut for its shaft leaves next to nothing there.
    let cut = ["trade", "rotary", "dpi-shaft", "--set", "shaft.compensate=true", "--json", "--dry-run"];
    let cut = report(&camgen(&cut));
    let shaft = cut["chain"].as_array().and_then(|chain| chain.iter().find(|part| part["part"] == "shaft").cloned());
    assert!(shaft.and_then(|part| part["residual_n"].as_f64()).is_some_and(|left| left < 1.0), "{cut}");
    let sections = report(&camgen(&["trade", "conoid", "--rpm", "20..35", "--residual", "1N", "--json", "--dry-run"]));
    assert_eq!(sections["flags"], "--rpm 20,25,30,35", "{sections}");
    // A cam that fails a check has no advice, and the check is named, also of a table of points and of sections.
    for (kind, check) in [("rotary", "contact_stress"), ("conoid", "contact_stress")] {
        let rpm: &[&str] = if kind == "conoid" { &["--rpm", "20..35"] } else { &[] };
        let limit = ["trade", kind, "--set", "limits.contact_stress=500MPa", "--json", "--dry-run"];
        let failing = self::report(&camgen(&[&limit[..], rpm].concat()));
        let advice = failing["advice"].as_str().expect("an advice");
        assert!(failing["flags"].is_null() && advice.contains(&format!("its check {check} fails")), "{advice}");
    }
    // A plate whose file asks for it leaves the same on both ways.
    let level = ["trade", "translating", "--set", "translating.balance=level", "--json", "--dry-run"];
    let level = self::report(&camgen(&level));
    let law = level["chain"][0].clone();
    assert!(law["part"] == "law" && (law["residual_n"].as_f64().expect("a force") - 3389.722).abs() < 1.0, "{law}");
    for wrong in [["trade", "shaft", "--residual", "2N"], ["trade", "shaft", "--rpm", "3"]] {
        assert_eq!(camgen(&wrong).code, 2, "{wrong:?}");
    }
}

/// A limit that no setting keeps: the tolerance matters all the same, and the setting that leaves least is named.
#[test]
fn trade_says_how_near_it_comes_and_how_sure_it_is() {
    let run = camgen(&["trade", "--json", "--residual", "1e-9N"]);
    assert_eq!(run.code, 0, "{}", run.err);
    let report = report(&run);
    let rows = report["rows"].as_array().expect("rows");
    let of = |row: &Value, key: &str| row[key].as_f64().unwrap_or_else(|| panic!("{key}: {row}"));
    let least = rows.iter().min_by(|a, b| of(a, "residual_n").total_cmp(&of(b, "residual_n"))).expect("a row");
    let advice = report["advice"].as_str().expect("an advice");
    assert!(advice.contains("leaves least") && !advice.contains("does not depend"), "{advice}");
    assert!(advice.contains(least["setting"].as_str().expect("a name")), "{advice}");
    for row in rows {
        let [sum, low, high] = ["total_us", "total_low_us", "total_high_us"].map(|key| of(row, key));
        assert!(0.0 < sum && sum <= low * (1.0 + 1e-9) && low <= high, "{row}");
    }
    assert!(report["rounds"].as_u64().is_some_and(|rounds| (1..=5).contains(&rounds)));
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

#[test]
fn tolerances_of_the_motion_are_read_and_refused() {
    for bad in ["5", "5%%", "-5%", "0%", "101%", "3 parsec", "2mm/rad", "nonsense", "nan%", "inf%", "5 rad/rad2"] {
        let run = camgen(&["rotary", "--tolerance-acceleration", bad]);
        assert_eq!(run.code, 2, "{bad}: {}", run.err);
        assert!(files(run.directory.path()).is_empty() && run.err.contains("error"), "{bad}: {}", run.err);
    }
    for good in ["5%", "20mm/rad2", "20 mm/rad²", "2m/s^2", "2000 mm/s2", "none"] {
        let run = camgen(&["rotary", "--format", "dxf", "--json", "--tolerance-acceleration", good]);
        assert_eq!(run.code, 0, "{good}: {}", run.err);
        let error = report(&run)["rolling"]["acceleration_error_max_mm_per_rad2"].as_f64().expect("a number");
        assert!(error <= 20.0 || good == "none", "{good}: {error}");
    }
    // A limit of the machine file refuses what the default only warns of.
    let coarse = ["rotary", "--format", "dxf", "--tolerance-acceleration", "none"];
    assert_eq!(camgen(&coarse).code, 0);
    assert_eq!(camgen(&[&coarse[..], &["--set", "limits.acceleration_share=0.2"]].concat()).code, 1);
    let velocity = camgen(&["rotary", "--format", "dxf", "--tolerance-velocity", "5mm/rad2"]);
    assert_eq!(velocity.code, 2, "{}", velocity.err);
}
