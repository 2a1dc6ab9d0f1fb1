//! The analyses of a press, and its compensating cam, as commands: figures known to many digits, refusals, files.

use crate::common::program::{self, Run, camgen_in, files, report, run};
use camgen::body::{RateTolerance, Request};
use camgen::domains::press::SpecOfPress;
use camgen::machine::Machine;
use camgen::pipeline::Spec;
use camgen::profile::outline::Fit;
use std::fs;
use std::path::{Path, PathBuf};

/// The rows of a CSV file by the names of their values.
fn table(path: &Path) -> Vec<Vec<(String, f64)>> {
    let text = fs::read_to_string(path).expect("a table");
    let mut lines = text.lines();
    let names: Vec<String> = lines.next().expect("a head").split(',').map(str::to_owned).collect();
    let row = |line: &str| {
        let values = line.split(',').map(|value| value.parse().expect("a number"));
        names.iter().cloned().zip(values).collect()
    };
    lines.map(row).collect()
}

fn of(row: &[(String, f64)], name: &str) -> f64 {
    row.iter().find(|(key, _)| key == name).unwrap_or_else(|| panic!("no {name}")).1
}

/// A file that a run has written.
fn file(run: &Run, name: &str) -> PathBuf {
    run.directory.path().join("output").join(name)
}

fn written(run: &Run) -> Vec<String> {
    let output = run.directory.path().join("output");
    if output.exists() { files(&output) } else { Vec::new() }
}

/// Relative: figures known to sixteen digits or more, through a few roundings of powers and logarithms.
fn close(found: f64, known: f64) {
    program::close(found, known, 1e-12);
}

#[test]
fn other_speeds_have_the_known_figures() {
    let told = run(0, &["regimes", "dpi-paper", "--rpm", "25,35"]);
    let rows = table(&file(&told, "dpi-paper-regimes-25-35rpm.csv"));
    let slow = &rows[0];
    close(of(slow, "column_length_mm"), 320.719_830_772_332_5);
    close(of(slow, "added_volume_mm3"), 3_378_954.210_537_855_6);
    close(of(slow, "residual_max_n"), 1_158.648_630_465_624_5);
    close(of(slow, "residual_at_mm"), 77.996_505_332_071_956);
    assert!((of(slow, "crank_torque_max_nm") - 190.6).abs() < 0.05);
    let own = ["residual_max_n", "added_volume_mm3", "lambda"].map(|name| of(&rows[1], name));
    assert_eq!(own, [0.0, 0.0, 1.0]);
    let curves = table(&file(&told, "dpi-paper-regimes-25-35rpm-curves.csv"));
    assert_eq!(curves.len(), 2 * 181);
    for row in &curves {
        let left = of(row, "inertia_n") - of(row, "air_n");
        assert!((left - of(row, "residual_n")).abs() < 1e-9, "{row:?}");
    }
    let level = run(0, &["regimes", "dpi-paper", "--rpm", "25", "--reset", "level", "--name", "level"]);
    let row = &table(&file(&level, "level.csv"))[0];
    close(of(row, "column_length_mm"), 331.338_130_448_643_1);
    // The two are equal where a root was solved to rounding of its argument.
    assert!((of(row, "residual_max_n") / 854.326_708_139_651_5 - 1.0).abs() < 1e-11);
    assert!((of(row, "end_residual_n") / 854.326_708_139_651_5 - 1.0).abs() < 1e-11);
    let svg = fs::read_to_string(file(&level, "level.svg")).expect("a plot");
    assert!(svg.contains("Largest force left over, N") && svg.contains("rpm: as cut"));
}

/// A report gives the number of cylinders, and area and volume of one and of all; together they hold the bed at the end of the stroke.
#[test]
fn reports_give_one_cylinder_and_all_of_them() {
    let number = |of: &serde_json::Value, key: &str| of[key].as_f64().unwrap_or_else(|| panic!("no {key}: {of}"));
    let conoid = ["conoid", "--rpm", "25,35", "--dry-run", "--json"];
    for (args, section) in [
        (&["rotary", "--dry-run", "--json"][..], "law"),
        (&["translating", "--dry-run", "--json"], "law"),
        (&conoid, "cylinders"),
        (&["regimes", "--rpm", "25", "--dry-run", "--json"], "regimes"),
        (&["regimes", "--without-cam", "--rpm", "25", "--dry-run", "--json"], "plain_buffers"),
        (&["spring", "--dry-run", "--json"], "spring"),
        (&["scatter", "--samples", "0", "--dry-run", "--json"], "scatter"),
    ] {
        let told = report(&run(0, args));
        let told = &told[section];
        let (count, bore, total) =
            (number(told, "cylinders"), number(told, "bore_mm"), number(told, "piston_area_total_mm2"));
        close(count * number(told, "piston_area_mm2"), total);
        close(count * std::f64::consts::PI * bore * bore / 4.0, total);
        // 21288.1 N at 2 at, 1 at above ambient.
        assert!((1e-6 * total * 98_066.5 / 21_288.1 - 1.0).abs() < 1e-5, "{args:?}: {total}");
    }
    let words = run(0, &["rotary", "--dry-run"]).out;
    assert!(
        words.contains("2 cylinders, bore 371.747 mm each, piston area 108539 mm² each, 217078 mm² in all"),
        "{words}"
    );
    let told = run(0, &["regimes", "--rpm", "25"]);
    let row = &table(&file(&told, "dpi-regimes-25rpm.csv"))[0];
    close(2.0 * of(row, "added_volume_each_mm3"), of(row, "added_volume_mm3"));
}

/// At 12 rpm a fixed bottom reset by the same rule has less residual force than the cam for 35 rpm.
#[test]
fn a_speed_at_which_a_fixed_bottom_is_better_warns() {
    for rule in ["end", "half", "level"] {
        let told = run(0, &["regimes", "--rpm", "12,30", "--reset", rule, "--dry-run"]);
        assert!(told.out.contains("WARN  fixed_bottom") && told.out.contains("at 12 rpm"), "{rule}: {}", told.out);
        for machine in ["dpi", "dpi-six-bar"] {
            let near = run(0, &["regimes", machine, "--rpm", "30,34", "--reset", rule, "--dry-run"]);
            assert!(near.out.contains("pass  fixed_bottom"), "{machine} {rule}: {}", near.out);
        }
    }
    // By (7), as in `camgen regimes --without-cam`.
    let rows = |args: &[&str]| report(&run(0, &[args, &["--rpm", "20", "--dry-run", "--json"]].concat()));
    for rule in ["end", "half", "level"] {
        let cam = rows(&["regimes", "--reset", rule])["regimes"]["speeds"][0].clone();
        let plain = rows(&["regimes", "--without-cam", "--reset", rule])["plain_buffers"]["speeds"][0].clone();
        for (of_cam, of_plain) in
            [("fixed_residual_max_n", "residual_max_n"), ("fixed_column_length_mm", "column_length_mm")]
        {
            close(cam[of_cam].as_f64().expect("a number"), plain[of_plain].as_f64().expect("a number"));
        }
    }
}

/// At a speed at which the outline misses the last micrometre of air, words replace a residual force of `inf`.
#[test]
fn a_bottom_that_hits_the_piston_is_told_in_words() {
    let told = run(1, &["rotary", "--rpm", "5000", "--dry-run"]).out;
    assert!(!told.split(|c: char| !c.is_alphanumeric()).any(|word| word == "inf" || word == "NaN"), "{told}");
    assert!(told.contains("the bottom hits the piston"), "{told}");
}

/// Equation (18) without friction keys is solved without friction, with a note in the report.
#[test]
fn a_plate_without_friction_keys_says_that_friction_is_omitted() {
    let omitted = |sets: &[&str]| {
        let told = run(0, &[&["translating", "--dry-run"], sets].concat()).out;
        told.lines().find(|line| line.contains("friction is omitted")).map(str::to_owned)
    };
    assert_eq!(omitted(&[]), None);
    let free = ["--set", "translating.friction_angle=0deg"];
    assert!(omitted(&free).is_some_and(|line| line.contains("roller") && !line.contains("bell crank")));
    let both = [&free[..], &["--set", "translating.efficiency=1"]].concat();
    assert!(omitted(&both).is_some_and(|line| line.contains("roller") && line.contains("bell crank")));
}

/// A lead does not change what is left at other speeds, nor at the cam's own: nothing.
#[test]
fn a_lead_changes_the_column_only() {
    let figures = |sets: &[&str]| {
        let args = [&["regimes", "dpi", "--rpm", "25,35", "--json", "--dry-run"], sets].concat();
        let report = report(&run(0, &args));
        let row = |index: usize| report["regimes"]["speeds"][index].clone();
        (row(0), row(1))
    };
    let (plain, own) = figures(&[]);
    let (led, own_led) = figures(&["--set", "buffer.lead=10mm"]);
    close(plain["residual_max_n"].as_f64().expect("a number"), 661.831_939_042_310_81);
    close(led["residual_max_n"].as_f64().expect("a number"), 661.831_939_042_310_81);
    for own in [&own, &own_led] {
        close(own["column_length_mm"].as_f64().expect("a number"), 243.0);
    }
    assert_eq!(own_led["residual_max_n"].as_f64(), Some(0.0));
}

/// Air cannot be taken away: above the cam's own speed only the screw is left, and nothing is written.
#[test]
fn a_faster_press_needs_the_screw() {
    let args = ["regimes", "dpi", "--rpm", "30,40"];
    let refused = run(1, &args);
    assert!(
        refused.out.contains("FAIL  added_volume") && refused.out.contains("211.450 mm for 40 rpm"),
        "{}",
        refused.out
    );
    assert!(written(&refused).is_empty());
    let forced = run(1, &[&args[..], &["--force"]].concat());
    assert_eq!(written(&forced).len(), 3);
    let faster = run(0, &[&args[..], &["--cut-for", "40", "--dry-run", "--json"]].concat());
    assert_eq!(report(&faster)["checks"][0]["check"], "added_volume");
    assert!(written(&faster).is_empty());
}

#[test]
fn springs_have_the_known_figures() {
    let springs = "68kgf/cm,82.5kgf/cm,165kgf/cm";
    let told = run(0, &["spring", "dpi-paper", "--stiffness", springs, "--rpm", "35,25"]);
    let rows = table(&file(&told, "dpi-paper-spring-35-25rpm.csv"));
    assert_eq!(rows.len(), 6);
    let (own, slow) = (&rows[0], &rows[1]);
    close(of(own, "spring_travel_mm"), 159.615_996_546_506_643);
    close(of(own, "air_length_mm"), 29.268_854_959_372_723_1);
    close(of(own, "residual_max_n"), 810.278_310_113_248_417);
    close(of(own, "residual_at_mm"), 65.237_433_593_405_764_3);
    close(of(slow, "air_length_mm"), 175.617_746_302_511_585);
    close(of(slow, "residual_max_n"), 1_410.793_459_670_098_66);
    assert!((of(slow, "screw_mm") - (175.618 - 29.269)).abs() < 1e-3);
    close(of(&rows[2], "residual_max_n"), 1_925.433_209_698_458_78);
    close(of(&rows[4], "residual_max_n"), 4_540.279_181_139_641_69);
    // The stiffness for a residual leaves it.
    let told = report(&run(0, &["spring", "dpi-paper", "--residual", "50kgf", "--dry-run", "--json"]));
    close(told["spring"]["settings"][0]["residual_max_n"].as_f64().expect("a number"), 50.0 * 9.806_65);
    for (args, why) in [
        (["--stiffness", "50kgf/cm"], "59.13"),
        (["--stiffness", "50mm"], "a unit of length, not of stiffness"),
        (["--residual", "8kN"], "7155.125"),
    ] {
        let refused = run(2, &[&["spring", "dpi-paper"], &args[..]].concat());
        assert!(refused.err.contains(why) && written(&refused).is_empty(), "{args:?}: {}", refused.err);
    }
}

#[test]
fn the_drive_has_the_known_figures() {
    let told = run(0, &["drive", "--step", "5deg"]);
    let rows = table(&file(&told, "dp-drive.csv"));
    let at = |degrees: f64| rows.iter().find(|row| of(row, "crank_deg") == degrees).expect("a row");
    close(of(at(30.0), "velocity_m_per_s"), 1.577_168_262_08);
    close(of(at(60.0), "omega_rad_per_s"), 8.248_885_581_531_74);
    close(of(at(80.0), "omega_rad_per_s"), 7.980_352_753_155_04);
    close(of(at(105.0), "omega_rad_per_s"), 8.190_136_649_424_67);
    close(of(at(150.0), "omega_rad_per_s"), 8.798_188_154_997_71);
    assert_eq!(of(at(60.0), "phase"), 1.0);
    let told = report(&run(0, &["drive", "--solver", "paper", "--dry-run", "--json"]));
    let drive = &told["drive"];
    close(drive["bore_mm"].as_f64().expect("a number"), 145.193_517_085_133);
    // Known to twelve decimals.
    assert!((drive["speed_drop"].as_f64().expect("a number") - 0.102_371_932_117).abs() < 1e-12);
    let paper = &drive["paper"];
    assert!((paper["failure_radicand_per_s2"].as_f64().expect("a number") + 0.183_469_69).abs() < 1e-8);
    assert!((paper["order"].as_f64().expect("a number") - 2.0).abs() < 0.01);
    for (bore, why) in [("145mm", "arrives at the end of its stroke with 0.0825"), ("160mm", "the bed stops at")] {
        let set = format!("drive.bore={bore}");
        let refused = run(1, &["drive", "--set", &set]);
        assert!(
            refused.out.contains(why) && refused.out.contains("a bore of 145.1935170851 mm of each cylinder closes it"),
            "{}",
            refused.out
        );
        assert!(written(&refused).is_empty());
    }
    assert!(run(2, &["drive", "--set", "buffer.column=300mm"]).err.contains("used up within the stroke"));
}

#[test]
fn a_linkage_has_the_known_figures() {
    let told = run(0, &["linkage", "--json"]);
    let figures = report(&told)["linkage"].clone();
    let number = |name: &str| figures[name].as_f64().unwrap_or_else(|| panic!("{name}"));
    close(number("c_plus"), 4.596_204_416_582_2);
    close(number("c_minus"), 4.519_792_585_881_9);
    close(number("w"), 4.467_893_312_283_2);
    assert!((number("inner_deg") - number("outer_deg") - 179.793_695_453_01).abs() < 1e-10);
    assert!((number("inertia_max_n") - 19_827.0).abs() < 0.5, "as the six-bar's table has it");
    let rows = table(&file(&told, "dpi-six-bar-linkage-35rpm.csv"));
    assert_eq!(rows.len(), 720);
    // Newton's law and power at every place.
    let omega = 3.5 * std::f64::consts::PI;
    for row in &rows {
        let force = 978.2 * of(row, "acceleration_m_per_s2");
        assert!((force + of(row, "inertia_n")).abs() < 1e-7);
        let power = force * of(row, "velocity_m_per_s");
        assert!((power - of(row, "power_w")).abs() < 1e-7 * 25_000.0);
        assert!((of(row, "velocity_m_per_s") - 1e-3 * omega * of(row, "velocity_mm_per_rad")).abs() < 1e-12);
        // The buffers of both ends balance it over the whole turn, to rounding.
        assert!(of(row, "residual_n").abs() < 1e-9 && of(row, "air_n") * of(row, "inertia_n") > -1e-9, "{row:?}");
    }
    let plain = report(&run(0, &["linkage", "dpi-crank-slider", "--dry-run", "--json"]));
    close(plain["linkage"]["c_plus"].as_f64().expect("a number"), 6.579_736_267_392_9);
    close(plain["linkage"]["k_c"].as_f64().expect("a number"), 1.911_519_489_723_9);
    let compensator = ["rotary", "dpi-six-bar", "--compensator", "spring_rate=100N/mm,preload=10kN"];
    for (args, why) in [(&["translating", "dpi-six-bar"][..], "moved by a linkage"), (&compensator, "does not mirror")]
    {
        let refused = run(2, args);
        assert!(refused.err.contains(why) && written(&refused).is_empty(), "{args:?}: {}", refused.err);
    }
    // Where the return mirrors the outward stroke a second disc takes nearly all of the torque.
    let second = ["rotary", "dpi-crank-slider", "--compensator", "spring_rate=100N/mm,preload=10kN", "--force"];
    let told = report(&run(0, &[&second[..], &["--dry-run", "--json"]].concat()));
    let of = |key: &str| told["compensator"][key].as_f64().unwrap_or_else(|| panic!("{key}: {}", told["compensator"]));
    assert!(of("torque_after_max_nm") < 0.05 * of("torque_before_max_nm"), "{}", told["compensator"]);
    // Springs at either end leave less than a fixed bottom does.
    for end in ["outer", "inner"] {
        let told = report(&run(0, &["spring", "dpi-six-bar", "--end", end, "--dry-run", "--json"]));
        let plain = told["spring"]["residual_fixed_bottom_max_n"].as_f64().expect("a number");
        for setting in told["spring"]["settings"].as_array().expect("a list") {
            assert!(setting["residual_max_n"].as_f64().expect("a number") < plain, "{end}: {setting} {plain}");
        }
    }
    for (goal, c) in [("equal", 5.016_901_073_051), ("symmetric", 4.554_830_706_734_38), ("least", 4.409_315_4)] {
        let told = report(&run(0, &["linkage", "dpi-crank-slider", "--synthesize", goal, "--dry-run", "--json"]));
        let figures = &told["linkage"];
        let found = figures["c_plus"].as_f64().expect("a number").max(figures["c_minus"].as_f64().expect("a number"));
        // The last to the digits known of it; none worse.
        assert!(found < c * (1.0 + 1e-6), "{goal}: {found}");
        // The design is what a file with it has.
        let design = &told["design"];
        let keys = [("base_ratio", ""), ("coupler_ratio", ""), ("follower_ratio", "")];
        let mut sets: Vec<String> =
            keys.iter().map(|(key, unit)| format!("linkage.{key}={}{unit}", design[*key])).collect();
        sets.push(format!("linkage.follower_angle={} deg", design["follower_angle_deg"]));
        let args: Vec<&str> = sets.iter().flat_map(|set| ["--set", set.as_str()]).collect();
        let again = report(&run(0, &[&["linkage", "--dry-run", "--json"], &args[..]].concat()));
        assert!(
            (again["linkage"]["c_plus"].as_f64().expect("a number") / figures["c_plus"].as_f64().expect("a number")
                - 1.0)
                .abs()
                < 1e-12
        );
    }
    let steep = run(1, &["linkage", "--set", "linkage.rod_ratio=1.5"]);
    assert!(steep.out.contains("FAIL  rod_angle"), "{}", steep.out);
    for (set, why) in [
        ("linkage.base_ratio=0.9", "would turn"),
        ("linkage.rod_ratio=0.9", "must be above 1"),
        ("linkage.rod=540mm", "this dimension is given twice, as a ratio and as a length"),
        ("linkage.kind=yoke", "a yoke has no rod and no drag link"),
    ] {
        let refused = run(2, &["linkage", "--set", set]);
        assert!(refused.err.contains(why), "{set}: {}", refused.err);
    }
}

/// The sheet has the mechanism with its letters and a ruler, the page a part for every link, and both are the same again.
#[test]
fn a_linkage_is_drawn_and_moves() {
    let made = run(0, &["linkage", "--format", "svg,html,pdf", "--name", "six"]);
    let text = |run: &Run, name: &str| fs::read_to_string(file(run, name)).expect("a file");
    let svg = text(&made, "six.svg");
    let letters: Vec<&str> =
        svg.split("id=\"letters-").skip(1).filter_map(|group| group.split("</g>").next()).collect();
    assert_eq!(letters.len(), 3);
    for letter in ["O1", "O2", "A", "B", "C", "D"] {
        let found: Vec<usize> = letters.iter().map(|of| of.matches(&format!(">\n{letter}\n<")).count()).collect();
        assert_eq!(found, [1, 1, 1], "{letter}");
    }
    for words in ["outer dead point", "inner dead point", "least transmission angle, 77.3644°", "K_c = 1"] {
        assert!(svg.contains(words), "{words}");
    }
    assert!(svg.contains("O1A is drawn as long as O2C, 180 mm"), "what is assumed is told");
    let html = text(&made, "six.html");
    let (_, behind) = html.split_once("type=\"application/json\">").expect("data");
    let data: serde_json::Value =
        serde_json::from_str(behind.split("</script>").next().expect("an end")).expect("JSON");
    let view = &data["cams"][0]["views"][0];
    let of_role =
        |role: &str| view["parts"].as_array().expect("parts").iter().filter(|part| part["role"] == role).count();
    assert_eq!([of_role("crank"), of_role("follower"), of_role("bed")], [2, 2, 1]);
    assert_eq!(view["at"].as_array().map(Vec::len), Some(721));
    assert_eq!(view["columns"]["x_mm"].as_array().map(Vec::len), Some(720));
    assert_eq!((&view["place"], &view["returns"]), (&"crank_deg".into(), &false.into()));
    assert!(fs::metadata(file(&made, "six.pdf")).expect("a PDF").len() > 10_000);
    let again = run(0, &["linkage", "--format", "svg,html,pdf", "--name", "six"]);
    for name in ["six.svg", "six.html", "six.pdf"] {
        assert!(
            fs::read(file(&made, name)).expect("a file") == fs::read(file(&again, name)).expect("a file"),
            "{name}"
        );
    }
    let args = ["--set", "linkage.driving_crank=100 mm", "--name", "plain", "--format", "svg,html"];
    let steep = run(0, &[&["linkage", "dpi-crank-slider"], &args[..]].concat());
    assert!(
        html.contains("\"id\":\"transmission\"") && !text(&steep, "plain.html").contains("\"id\":\"transmission\"")
    );
    let svg = text(&steep, "plain.svg");
    assert!(
        svg.contains("steepest rod, 19.4712°") && !svg.contains("K_c") && !svg.contains("drawn as long"),
        "no drag link"
    );
    let yoke = run(0, &["linkage", "dpi", "--set", "linkage.kind=yoke", "--format", "svg,toml,html", "--name", "yoke"]);
    assert!(text(&yoke, "yoke.toml").ends_with("[linkage]\nkind = \"yoke\"\n"));
}

/// A written table in the place of that of a machine file makes the same machine; no other analysis, and no cam, has one.
#[test]
fn the_table_of_a_linkage_can_be_pasted() {
    let own = include_str!("../../profiles/dpi-crank-slider.toml");
    let (head, rest) = own.split_once("[linkage]").expect("a table");
    let (_, behind) = rest.split_once("\n[").expect("another table");
    let goals: [&[&str]; 4] = [
        &[],
        &["--synthesize", "equal"],
        &["--synthesize", "least", "--keep", "symmetric"],
        &["--synthesize", "symmetric", "--set", "linkage.driving_crank=150 mm"],
    ];
    for goal in goals {
        let made =
            run(0, &[&["linkage", "dpi-crank-slider", "--format", "toml", "--name", "made", "--json"], goal].concat());
        assert_eq!(written(&made), ["made.toml"]);
        let before = report(&made)["linkage"].clone();
        let table = fs::read_to_string(file(&made, "made.toml")).expect("a table");
        let pasted = format!("{head}{table}\n[{behind}");
        fs::write(made.directory.path().join("pasted.toml"), &pasted).expect("written");
        let again = camgen_in(made.directory, &["linkage", "pasted.toml", "--dry-run", "--json"]);
        assert_eq!(again.code, 0, "{}\n{table}", again.err);
        let after = report(&again)["linkage"].clone();
        for (name, value) in before.as_object().expect("figures") {
            let (Some(value), Some(found)) = (value.as_f64(), after[name].as_f64()) else { continue };
            assert!((value - found).abs() <= 1e-11 * value.abs().max(1.0), "{name}: {found}, not {value}\n{table}");
        }
    }
    for (args, why) in [
        (["regimes", "dpi"], "no such format `toml`; one of svg, csv, json, html, pdf"),
        (["rotary", "dpi"], "no toml file: toml is for a linkage"),
    ] {
        let refused = run(2, &[&args[..], &["--format", "toml"]].concat());
        assert!(refused.err.contains(why) && written(&refused).is_empty(), "{args:?}: {}", refused.err);
    }
}

const SPRING: [&str; 2] = ["--compensator", "spring_rate=100N/mm,preload=10kN"];

#[test]
fn a_compensating_cam_takes_the_torque() {
    let made = run(0, &[&["rotary", "--rpm", "35", "--json"], &SPRING[..]].concat());
    let told = report(&made);
    let second = &told["compensator"];
    let number = |name: &str| second[name].as_f64().unwrap_or_else(|| panic!("{name}"));
    close(number("lift_max_mm"), 77.965_519_078_930_342_7);
    close(number("work_j"), 1_083.586_299_051_655_99);
    close(number("torque_before_max_nm"), 1_185.799_485_705_874_39);
    assert!(number("torque_after_max_nm") < 1e-9 * number("torque_before_max_nm"), "{second}");
    assert!(number("torque_as_cut_max_nm") < 0.015 * number("torque_before_max_nm"), "{second}");
    let slow =
        second["preload_by_rpm"].as_array().expect("a list").iter().find(|at| at["rpm"] == 25.0).expect("25 rpm");
    // Of the law known to nine digits; the largest is taken from two thousand places of a quarter turn.
    assert!((slow["torque_before_max_nm"].as_f64().expect("a number") / 637.870_234_784_720_117 - 1.0).abs() < 1e-6);
    assert!((slow["torque_unchanged_max_nm"].as_f64().expect("a number") / 550.750_992_947_320_793 - 1.0).abs() < 1e-6);
    assert!(slow["torque_after_max_nm"].as_f64().expect("a number") < 99.0);
    let mut names = written(&made);
    names.retain(|name| name.contains("-compensator."));
    assert_eq!(names.len(), 4, "{names:?}");
    assert_eq!(told["files"].as_array().map(Vec::len), Some(10), "those of both discs");
    let kept = run(0, &[&["rotary", "--format", "dxf,json"], &SPRING[..]].concat());
    let inside = fs::read_to_string(file(&kept, "dpi-rotary-35rpm.json")).expect("a report");
    assert_eq!(inside.matches("-compensator.").count(), 2, "its own report names the files of the second disc");
    let rows = table(&file(&made, "dpi-rotary-35rpm-compensator.csv"));
    for (degrees, lift) in [
        (10.0, 0.982_327_851_304_808_177),
        (30.0, 16.856_008_771_649_496_5),
        (60.0, 58.531_113_360_097_157_9),
        (90.0, 77.965_519_078_930_342_7),
    ] {
        let row = rows.iter().find(|row| of(row, "cam_deg") == degrees).expect("a row");
        close(of(row, "lift_mm"), lift);
    }
    let row = rows.iter().find(|row| of(row, "cam_deg") == 30.0).expect("a row");
    close(of(row, "velocity_mm_per_rad"), 71.888_357_896_597_821_8);
    close(of(row, "acceleration_mm_per_rad2"), 109.238_165_370_897_997);
    close(of(row, "jerk_mm_per_rad3"), -478.613_585_087_834_990);
    for row in table(&file(&made, "dpi-rotary-35rpm.csv")) {
        assert!(of(&row, "torque_left_nm").abs() < 1e-9, "{row:?}");
    }
    // Each file is that of its own disc, and not of the other.
    let keys = ["--set", "compensator.spring_rate=100N/mm", "--set", "compensator.preload=10kN"];
    let mut directory = made.directory;
    for (name, kind, code) in [
        ("output/dpi-rotary-35rpm.dxf", "rotary", 0),
        ("output/dpi-rotary-35rpm-compensator.dxf", "compensator", 0),
        ("output/dpi-rotary-35rpm-compensator.step", "compensator", 0),
        ("output/dpi-rotary-35rpm-compensator.dxf", "rotary", 1),
        ("output/dpi-rotary-35rpm.dxf", "compensator", 1),
    ] {
        let checked = camgen_in(directory, &[&["check", name, "--cam", kind], &keys[..]].concat());
        assert_eq!(checked.code, code, "{name} {kind}: {}{}", checked.out, checked.err);
        directory = checked.directory;
    }
}

/// What arcs leave of the torque falls as the tolerance to the power 2/3, and a tolerance of the velocity brings it below 0.2 %.
#[test]
fn the_torque_as_cut_falls_with_the_tolerance() {
    let sets = ["compensator.spring_rate=100N/mm", "compensator.preload=10kN"].map(str::to_owned);
    let (machine, _) = Machine::load("dpi", &sets).expect("valid");
    let cam = Spec::rotary(machine, 35.0).assemble().expect("a cam");
    let left = |request: Request| {
        let proven = cam.draw(request).expect("drawn").prove().expect("proved");
        let report = proven.report();
        let second = report.section("compensator").expect("a section");
        let arcs = [report.section("outline").expect("an outline"), &second["outline"]].map(|of| of["arcs"].as_f64());
        let share = second["torque_as_cut_max_nm"].as_f64().expect("a number") / 1_185.799_485_705_874_39;
        (share, arcs.into_iter().flatten().sum::<f64>())
    };
    let ladder: Vec<(f64, f64)> =
        [50e-6, 5e-6, 0.5e-6, 0.05e-6].into_iter().map(|tolerance| left(Request::within(tolerance))).collect();
    for (share, arcs) in &ladder {
        println!("{:.4} % of the torque with {arcs} arcs", 100.0 * share);
    }
    assert!(ladder[1].0 < 0.015);
    for pair in ladder.windows(2) {
        let ratio = pair[0].0 / pair[1].0;
        // 10^(2/3) = 4.64; the places of the joints differ from tolerance to tolerance.
        assert!((3.2..7.0).contains(&ratio), "{ratio}");
    }
    let rates = [Some(RateTolerance::Share(0.0005)), None];
    let (share, arcs) = left(Request { rates, ..Request::within(Fit::from(5e-6)) });
    println!("with a velocity tolerance of 0.05 %: {:.4} % with {arcs} arcs", 100.0 * share);
    assert!(share < 0.002, "{share}");
}

/// A broken limit of the second disc refuses both; without its table there is none.
#[test]
fn a_compensating_cam_is_judged_with_its_cam() {
    let keys = format!("{},base_radius=60mm", SPRING[1]);
    let args = ["rotary", "--compensator", &keys];
    let refused = run(1, &args);
    let out = &refused.out;
    assert!(out.contains("of the compensating cam: pressure_angle") && out.contains("would pass"), "{out}");
    assert!(written(&refused).is_empty());
    assert_eq!(written(&run(1, &[&args[..], &["--force"]].concat())).len(), 10);
    for (keys, why) in [
        ("spring_rate=100N/mm", "missing key `compensator.preload`"),
        ("spring_rate=100N/mm,preload=0N", "must be above 0"),
        ("rate=100N/mm", "unknown key `compensator.rate`"),
    ] {
        let refused = run(2, &["rotary", "--dry-run", "--compensator", keys]);
        assert!(refused.err.contains(why), "{}", refused.err);
    }
    let blow = [
        "rotary",
        "--set",
        "transition.kind=none",
        "--set",
        "buffer.column=return",
        "--set",
        "follower.roller.mass=20kg",
    ];
    let refused = run(2, &[&blow[..], &SPRING].concat());
    assert!(refused.err.contains("take the jump of its velocity at 180.000 deg"), "{}", refused.err);
    let made = run(0, &["rotary"]);
    let checked = camgen_in(made.directory, &["check", "output/dpi-rotary-35rpm.dxf", "--cam", "compensator"]);
    assert!(checked.code == 2 && checked.err.contains("describes no compensating cam"), "{}", checked.err);
}

/// The column of least torque, and what it costs.
#[test]
fn a_column_lowers_the_torque() {
    let sets = ["buffer.column=least-torque", "limits.pressure_angle=60deg"].map(str::to_owned);
    let (machine, _) = Machine::load("dpi", &sets).expect("valid");
    let cam = Spec::rotary(machine, 35.0).solve().expect("a cam");
    let report = cam.draw(5e-6).expect("drawn").prove().expect("proved").report();
    let number = |section: &str, name: &str| report.section(section).expect(section)[name].as_f64().expect(name);
    assert!((number("law", "column_length_mm") - 528.083).abs() < 5e-4);
    assert!((number("force", "torque_max_nm") - 442.28).abs() < 5e-3);
}
