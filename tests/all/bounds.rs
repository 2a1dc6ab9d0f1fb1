//! Work has bounds: what would take minutes or gigabytes is refused at once, with the bound.

use crate::common::program::{finding, make, report, run};

/// Numbers of a list, evenly between two.
fn listed(count: u32, (low, high): (f64, f64), unit: &str) -> String {
    let at = |i: u32| format!("{}{unit}", low + (high - low) * f64::from(i) / f64::from(count));
    (0..count).map(at).collect::<Vec<String>>().join(",")
}

#[track_caller]
fn refused(args: &[&str], bound: &str) {
    let refused = run(2, args);
    assert!(refused.err.contains(bound), "{}", refused.err);
    assert!(!refused.directory.path().join("output").exists());
}

#[test]
fn lists_have_bounds() {
    refused(
        &["conoid", "--rpm", &listed(101, (20.0, 40.0), "")],
        "101 speeds of a conoid are asked for; give at most 100",
    );
    refused(&["regimes", "--set", &format!("regimes.rpm=[{}]", listed(1001, (10.0, 40.0), ""))], "give at most 1000");
    let stiffnesses = listed(40, (200.0, 400.0), "N/mm");
    refused(&["spring", "--stiffness", &stiffnesses, "--rpm", &listed(26, (10.0, 30.0), "")], "1040 springs");
    refused(
        &["translating", "--solver", "paper", "--stations", "300001"],
        "300001 stations are asked for; give at most 300000",
    );
}

/// Many speeds are named in files by the first and the last.
#[test]
fn names_of_many_speeds_fit_a_file_system() {
    let made =
        run(0, &["regimes", "--set", &format!("regimes.rpm=[{}]", listed(60, (20.0, 35.0), "")), "--format", "csv"]);
    assert!(made.directory.path().join("output/dpi-regimes-20-34.75rpm.csv").exists(), "{}", made.out);
}

/// A size is looked for up to a kilometre.
#[test]
fn no_cam_is_larger_than_a_drawing() {
    refused(
        &["size", "feeder", "--free", "offset", "--set", "limits.pressure_angle=1e-12deg"],
        "limits.pressure_angle = \"",
    );
}

/// An acceleration that no outline of a control keeps is told as that, with the arcs that it would need, and not tried.
#[test]
fn an_acceleration_out_of_reach_is_not_tried() {
    let made = run(1, &["rotary", "--tolerance-acceleration", "0.0001%", "--json", "--dry-run"]);
    let report = report(&made);
    let found = finding(&report, "acceleration");
    assert_eq!(found["verdict"], "fail");
    assert!(found["note"].as_str().is_some_and(|note| note.contains("too many for a control")), "{found}");
}

/// A motion of many waves is drawn to its distance where the usual accuracy of the acceleration would take too many arcs.
#[test]
fn many_waves_are_drawn_to_their_distance() {
    let text = "name = \"waves\"\n[motion]\nrpm = 100\nstart = \"0 mm\"\nformula = \"5*cos(th)+sin(5000*th)*0.000001\"\n\
                [follower.roller]\nradius = \"10 mm\"\n[cam]\nbase_radius = \"60 mm\"\n";
    let made = make(text, &["--json", "--dry-run"]);
    assert_eq!(made.code, 0, "{}{}", made.out, made.err);
    assert_eq!(finding(&report(&made), "acceleration")["verdict"], "warn");
}

/// Of many segments a size is refused at once where the place of the follower is free.
#[test]
fn a_free_place_takes_few_segments() {
    let segment = |i: u32| {
        let to = if i.is_multiple_of(2) { 0.1 } else { 0.0 };
        format!("[[motion.segment]]\nlaw = \"cycloidal\"\nover = \"1.7 deg\"\nto = \"{to} mm\"\n")
    };
    let segments: String = (0..208).map(segment).collect();
    let text = format!(
        "name = \"many\"\n[motion]\nrpm = 60\nstart = \"0 mm\"\n{segments}[[motion.segment]]\nlaw = \"dwell\"\n\
         [follower.roller]\nradius = \"2 mm\"\noffset = \"auto\"\n[cam]\nbase_radius = \"auto\"\n"
    );
    let made = make(&text, &["--dry-run"]);
    assert_eq!(made.code, 2, "{}", made.out);
    assert!(made.err.contains("209 segments of a motion whose follower has a free place"), "{}", made.err);
}
