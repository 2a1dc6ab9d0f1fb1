//! `camgen scatter` as a command: files with the columns that scripts rely on, the same bytes again, refusals that name their cause.

use crate::common::program::{Run, close, finding, number, report, run};
use std::fs;

fn text(run: &Run, ending: &str) -> String {
    let path = run.directory.path().join("output").join(format!("dpi-scatter-35rpm{ending}"));
    fs::read_to_string(path).expect("a file")
}

#[test]
fn its_files_have_the_columns_that_are_relied_on() {
    let told = run(0, &["scatter", "--samples", "500", "--seed", "7", "--format", "csv,svg"]);
    for (ending, head, rows) in [
        (
            ".csv",
            "parameter,half_width,unit,sensitivity_n,residual_n,residual_at_mm,column_end_mm,residual_end_n,residual_end_at_mm,\
             column_level_mm,residual_level_n,share_of_variance",
            10,
        ),
        ("-percentiles.csv", "body,reset,percentile,residual_n,low_n,high_n", 9),
        (
            "-settings.csv",
            "v,rpm,column_mm,added_volume_mm3,residual_n,residual_at_mm,fixed_column_mm,fixed_residual_n,reset,added_volume_each_mm3",
            23,
        ),
        ("-curves.csv", "x_mm,way,mean_n,half_loop_n,weak_n,strong_n,", 361),
    ] {
        let text = text(&told, ending);
        let mut lines = text.lines();
        let first = lines.next().expect("a head");
        assert!(first.starts_with(head), "{ending}: {first}");
        assert_eq!(lines.count(), rows, "{ending}");
    }
    let again = run(0, &["scatter", "--samples", "500", "--seed", "7", "--format", "csv,svg"]);
    for ending in [".csv", "-percentiles.csv", "-settings.csv", "-curves.csv", ".svg", "-card.svg"] {
        assert_eq!(text(&told, ending), text(&again, ending), "{ending}");
    }
    assert_eq!(text(&told, "-card.svg").matches("<svg").count(), 1);
}

/// Table and card follow `--reset` and name the rule; the card gives the number of cylinders that share the force.
#[test]
fn card_and_settings_follow_the_rule_of_the_screw() {
    let mut cards = Vec::new();
    for rule in ["none", "end", "level"] {
        let told = run(0, &["scatter", "--samples", "0", "--reset", rule, "--format", "csv,svg"]);
        let settings = text(&told, "-settings.csv");
        let rows: Vec<Vec<&str>> = settings.lines().map(|line| line.split(',').collect()).collect();
        let column = |name: &str| rows[0].iter().position(|head| *head == name).expect("a column");
        assert!(rows[1..].iter().all(|row| row[column("reset")] == rule), "{settings}");
        let card = text(&told, "-card.svg");
        assert!(
            card.contains(&format!("screw ({rule})")) && card.contains("2 cylinders, bore 371.747 mm each"),
            "{card}"
        );
        for row in &rows[1..] {
            let number = |name: &str| row[column(name)].parse::<f64>().expect("a number");
            let cell = format!("{:.2}", number("column_mm"));
            assert!(card.lines().any(|line| line.trim() == cell), "{rule} {row:?}");
            let [each, total] = ["added_volume_each_mm3", "added_volume_mm3"].map(number);
            assert!((2.0 * each - total).abs() <= 1e-12 * total.abs(), "{rule} {row:?}");
        }
        cards.push(card);
    }
    assert!(cards[0] != cards[1] && cards[1] != cards[2]);
}

/// For small bands the draws are those of the linear sum, within their sampling error; a shared thread pool changes no byte.
#[test]
fn small_bands_scatter_as_their_linear_sum() {
    let small: Vec<String> = [
        "polytropic_exponent=5e-5",
        "ambient_pressure=3e-5",
        "mass=5e-5",
        "speed=1e-5",
        "column=1e-3mm",
        "lead=0mm",
        "air_lost=0%",
        "closing_pressure=0%",
        "phase=0deg",
    ]
    .iter()
    .flat_map(|vary| ["--vary".to_owned(), (*vary).to_owned()])
    .collect();
    let mut args = vec!["scatter", "--samples", "20000", "--dry-run", "--json", "--distribution", "normal"];
    args.extend(small.iter().map(String::as_str));
    let scatter = report(&run(0, &args))["scatter"].clone();
    let sigma = number(&scatter["sigma_n"]);
    // Of a normal force the size is below 1.96 σ in 95 % of all presses; the percentile of 20 000 has an error of 1 %.
    let row = &scatter["percentiles"][1];
    assert_eq!(
        (row["body"].as_str(), row["reset"].as_str(), number(&row["percentile"])),
        (Some("cam"), Some("none"), 95.0)
    );
    let share = number(&row["residual_n"]) / (1.959_964 * sigma);
    assert!((share - 1.0).abs() < 0.02, "{share}");
    assert!(number(&row["low_n"]) < number(&row["residual_n"]) && number(&row["residual_n"]) < number(&row["high_n"]));
}

#[test]
fn one_machine_that_differs_is_told_and_judged() {
    let told =
        report(&run(0, &["scatter", "--fault", "polytropic_exponent=1.40", "--samples", "0", "--dry-run", "--json"]));
    let fault = &told["scatter"]["fault"];
    close(number(&fault["residual_n"]), -1_107.169_837, 1e-9);
    close(number(&fault["column_end_mm"]), 6.891_746_12, 1e-9);
    close(number(&fault["residual_level_n"]), 36.343_014_07, 1e-9);
    assert!(finding(&told, "scatter")["note"].as_str().is_some_and(|note| note.contains("--samples 0")));
    // At 20 rpm a fixed bottom with its own reset leaves less.
    let slow = run(1, &["scatter", "--fault", "speed=20rpm", "--samples", "0", "--reset", "level"]);
    assert!(slow.out.contains("FAIL  setting") && slow.out.contains("22.2 rpm"), "{}", slow.out);
    let losses = ["--set", "buffer.expansion_exponent=1.40", "--samples", "0", "--dry-run", "--json"];
    let told = report(&run(0, &[&["scatter"], &losses[..]].concat()));
    close(number(&told["scatter"]["losses"]["residual_back_n"]), 539.554_092_5, 1e-9);
    assert_eq!(finding(&told, "half_loop")["verdict"], "pass");
}

/// The screw is turned from where it is, and the friction of the bed is in the draws: no press leaves less.
#[test]
fn the_screw_is_turned_from_where_it_is_and_the_draws_have_friction() {
    let faults = ["scatter", "--fault", "mass=5%", "--fault", "column=-2mm", "--samples", "0", "--dry-run", "--json"];
    let fault = report(&run(0, &faults))["scatter"]["fault"].clone();
    close(number(&fault["column_end_mm"]), -6.390_795_147, 1e-9);
    close(number(&fault["screw_end_mm"]), -4.390_795_147, 1e-9);
    let rubbing = ["scatter", "--set", "bed.friction=480N", "--samples", "400", "--dry-run", "--json"];
    let told = report(&run(0, &rubbing));
    for row in told["scatter"]["percentiles"].as_array().expect("rows") {
        assert!(number(&row["residual_n"]) > 480.0, "{row}");
    }
    // With a port that shuts late the level setting leaves no more than that to the end.
    let late = report(&run(0, &["scatter", "--fault", "lead=-5mm", "--samples", "0", "--dry-run", "--json"]));
    let fault = &late["scatter"]["fault"];
    assert!(number(&fault["residual_level_n"]) <= number(&fault["residual_end_n"]).abs() * (1.0 + 1e-12), "{fault}");
}

#[test]
fn what_cannot_be_is_refused_with_its_cause() {
    for (args, why) in [
        (&["--fault", "polytropic_exponent=+0.05"][..], "write the true exponent"),
        (&["--vary", "mass=5%", "--vary", "mass=3%"], "given twice"),
        (&["--fault", "mas=5%"], "did you mean `mass`?"),
        (&["--fault", "mass"], "KEY=VALUE is expected"),
        (&["--fault", "mass=0.97"], "may be a ratio or a deviation"),
        (&["--fault", "mass=5%", "--fault", "mass=6%"], "given twice"),
        (&["--fault", "polytropic_exponent=4"], "the true exponent is from 1 to 3"),
        (&["--fault", "phase=6deg"], "within 5 deg"),
        (&["--fault", "column=-200mm"], "column used up"),
        (&["--fault", "mass=-90%", "--fault", "closing_pressure=90%"], "no column balances the end"),
        (&["--set", "buffer.expansion_exponent=1.3"], "expansion exponent below the compression's"),
        (&["--set", "cam.train_stiffness=1000 N/m"], "train too soft"),
        (&["--vary", "mass=80%"], "must be at most 50 %"),
        (&["--vary", "nothing=1"], "unknown key"),
        (&["--set", "scatter.samples=1.5"], "must be a whole number"),
    ] {
        let refused = run(2, &[&["scatter", "--samples", "0"], args].concat());
        assert!(refused.err.contains(why), "{args:?}: {}", refused.err);
        assert!(!refused.directory.path().join("output").exists());
    }
}

/// P95 in the report of a cam equals P95 of `camgen scatter`, under a yoke and at both ends of a linkage.
#[test]
fn report_of_a_cam_has_the_p95_of_the_draws() {
    let six_bar = |end| vec!["dpi-six-bar", "--end", end];
    for machine in [vec!["dpi"], vec!["dpi", "--set", "scatter.reset=level"], six_bar("outer"), six_bar("inner")] {
        let few = ["--set", "scatter.samples=2000", "--dry-run", "--json"];
        let of = |command: &'static str, more: &[&'static str]| {
            report(&run(0, &[&[command], &machine[..], &few, more].concat()))["scatter"].clone()
        };
        let (drawn, cam) = (of("scatter", &[]), of("rotary", &["--force"]));
        let p95 = |at: usize| number(&drawn["percentiles"][at]["residual_n"]);
        for (at, key) in [(1, "p95_as_built_n"), (4, "p95_reset_n"), (7, "p95_fixed_bottom_n")] {
            assert_eq!(number(&cam[key]), p95(at), "{machine:?} {key}: {cam}");
        }
        assert_eq!(cam["reset"], drawn["reset"]);
    }
}

/// A cam that levels a loop of the air is cut, proven and reported as any other, in both commands; without a loop it is refused.
#[test]
fn a_cam_that_levels_both_ways() {
    let level = ["--set", "buffer.balance=level", "--set", "buffer.expansion_exponent=1.40"];
    let files = ["rotary", "--format", "dxf,step,csv", "--json"];
    let cut = run(0, &[&files[..], &level].concat());
    let told = report(&cut);
    close(number(&told["law"]["column_length_mm"]), 249.749_633_6, 1e-9);
    close(number(&told["losses"]["lead_mm"]), 2.306_349_143, 1e-9);
    close(number(&told["losses"]["half_loop_n"]), 268.303_004_8, 1e-9);
    close(number(&told["losses"]["residual_in_n"]), -268.303_004_8, 1e-9);
    // As cut the outline adds little.
    let left = number(&told["force"]["residual_max_n"]);
    assert!((268.0..290.0).contains(&left), "{left}");
    let dxf = cut.directory.path().join("output/dpi-rotary-35rpm.dxf");
    let checked = run(0, &[&["check", dxf.to_str().expect("a path"), "--cam", "rotary"], &level[..]].concat());
    assert!(checked.out.contains("pass"), "{}", checked.out);
    // The outline of the other law is another one.
    run(1, &["check", dxf.to_str().expect("a path"), "--cam", "rotary"]);
    let told = report(&run(0, &[&["scatter", "--samples", "100", "--dry-run", "--json"], &level[..]].concat()));
    close(number(&told["scatter"]["losses"]["half_loop_n"]), 268.303_004_8, 1e-9);
    assert_eq!(finding(&told, "half_loop")["verdict"], "pass");
    for command in ["rotary", "scatter"] {
        for (sets, why) in [
            (&["--set", "buffer.balance=level"][..], "no lead for this loop"),
            (
                &["--set", "buffer.balance=level", "--set", "buffer.expansion_exponent=1.3"],
                "expansion exponent below the compression's",
            ),
            (&["--set", "buffer.balance=levl"], "level"),
        ] {
            let refused = run(2, &[&[command], sets].concat());
            assert!(refused.err.contains(why), "{command} {sets:?}: {}", refused.err);
            assert!(!refused.directory.path().join("output").exists());
        }
    }
}

/// Fixed bottoms without a cam, and the springs that a shop can buy.
#[test]
fn buffers_without_a_cam_and_standard_springs() {
    let plain = report(&run(0, &["regimes", "--without-cam", "--rpm", "25,35", "--dry-run", "--json"]));
    close(number(&plain["plain_buffers"]["speeds"][1]["residual_max_n"]), 3_185.745_9, 1e-7);
    let last = plain["plain_buffers"]["end_pressures"].as_array().expect("rows").last().expect("a row").clone();
    close(number(&last["residual_max_n"]), 7_155.125_152_58, 1e-9);
    run(2, &["regimes", "--without-cam", "--cut-for", "30"]);
    let linkage = run(2, &["regimes", "dpi-six-bar", "--without-cam"]);
    assert!(linkage.err.contains("for a yoke only"), "{}", linkage.err);
    let design = ["spring", "--design", "--set", "spring_buffer.body.stress=700MPa", "--dry-run", "--json"];
    let told = report(&run(0, &design));
    for spring in told["spring_bodies"]["springs"].as_array().expect("springs") {
        close(number(&spring["wire_mm"]), 18.0, 1e-12);
        assert!(number(&spring["stress_mpa"]) < 700.0 && number(&spring["free_length_mm"]) > 200.0, "{spring}");
    }
    let without = run(2, &["spring", "--design"]);
    assert!(without.err.contains("spring_buffer.body.stress") || without.err.contains("stress"), "{}", without.err);
    let soft = run(2, &["spring", "--stiffness", "60kgf/cm"]);
    assert!(soft.err.contains("springs of 58.8399 N/mm") && soft.err.contains("59.1335 N/mm"), "{}", soft.err);
}
