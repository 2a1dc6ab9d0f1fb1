//! `check` of sections of a conoid: each file holds the section for its speed and no other.

use crate::common::program::{self, Run, camgen, camgen_in, report};

/// Checks a file of the directory in which another run left it.
fn check(run: Run, args: &[&str]) -> Run {
    camgen_in(run.directory, &[&["check"], args].concat())
}

#[test]
fn a_section_of_a_conoid_is_that_of_its_speed_alone() {
    let ways = [vec![], vec!["--set", "cam.rotation=ccw"], vec!["--set", "conoid.mode=fixed"]];
    for way in ways {
        let conoid = [&["--rpm", "20,27.5,35"], &way[..]].concat();
        let mut run = camgen(&[&["conoid", "--out", ".", "--name", "c", "--format", "dxf"], &conoid[..]].concat());
        assert_eq!(run.code, 0, "{}", run.err);
        for (of, asked) in [("20", "20"), ("27.5", "27.5"), ("35", "35"), ("20", "27.5"), ("27.5", "35"), ("35", "20")]
        {
            let file = format!("c-{of}rpm.dxf");
            run = check(run, &[&[&*file, "--cam", "conoid", "--json", "--section", asked], &conoid[..]].concat());
            let report = report(&run);
            assert_eq!(run.code, i32::from(of != asked), "{way:?} {of} as {asked}: {report}");
            assert_eq!(report["section"]["rpm"].as_f64().map(|rpm| rpm.to_string()).as_deref(), Some(asked));
            let rolling = report["checks"].as_array().expect("checks").iter().find(|c| c["check"] == "rolling");
            assert_eq!(rolling.expect("rolled")["verdict"], if of == asked { "pass" } else { "fail" }, "{report}");
        }
        // Made for other speeds the same section stands elsewhere along the axis, on another flank.
        let other = ["c-27.5rpm.dxf", "--cam", "conoid", "--section", "27.5", "--rpm", "20,27.5,40"];
        run = check(run, &[&other, &way[..]].concat());
        assert_eq!(run.code, 1, "{way:?}: {}", run.out);
    }
}

#[test]
fn a_section_that_is_not_there_is_told() {
    let mut run = camgen(&["conoid", "--rpm", "20,35", "--out", ".", "--name", "c", "--format", "dxf"]);
    assert_eq!(run.code, 0, "{}", run.err);
    let conoid = ["c-20rpm.dxf", "--cam", "conoid", "--rpm", "20,35"];
    for (args, told) in [
        (conoid.to_vec(), "has a file for each; give one of 20, 35 rpm"),
        ([&conoid[..], &["--section", "26"]].concat(), "no section for 26 rpm; give one of 20, 35 rpm"),
        (vec!["c-20rpm.dxf", "dpi", "--section", "20"], "has one outline for all its height"),
        (vec!["c-20rpm.dxf", "--cam", "conoid", "--rpm", "20..35", "--section", "20"], "needs --residual"),
        ([&conoid[..], &["--section", "twenty"]].concat(), "invalid value"),
    ] {
        run = check(run, &args);
        assert_eq!(run.code, 2, "{args:?}: {}", run.out);
        assert!(run.err.contains(told), "{args:?}: {}", run.err);
    }
    // One speed has one section, which need not be named.
    let one = camgen(&["conoid", "--rpm", "35", "--out", ".", "--name", "c", "--format", "dxf"]);
    assert_eq!(check(one, &["c-35rpm.dxf", "--cam", "conoid", "--rpm", "35"]).code, 0);
}

/// The names of files tell a speed with six digits at the most.
#[test]
fn sections_of_a_range_are_found_by_the_speeds_of_their_names() {
    let range = ["--rpm", "20..35", "--residual", "2N"];
    let made = camgen(&[&["conoid", "--json", "--out", ".", "--name", "c", "--format", "dxf"], &range[..]].concat());
    assert_eq!(made.code, 0, "{}", made.err);
    let written = program::files(made.directory.path());
    let odd = written.iter().find(|name| name.contains('.') && !name.starts_with("c-20rpm")).expect("sections").clone();
    let rpm = odd.trim_start_matches("c-").trim_end_matches("rpm.dxf").to_owned();
    let short: String = rpm.chars().take(7).collect();
    let run = check(made, &[&[&*odd, "--cam", "conoid", "--section", &short], &range[..]].concat());
    assert_eq!(run.code, 0, "{odd} {short}: {} {}", run.out, run.err);
}

/// What the follower may feel is demanded of a file where somebody asks for it, and only warned of by default.
#[test]
fn a_file_is_refused_for_what_its_follower_feels_where_that_is_asked() {
    let mut run =
        camgen(&["rotary", "--tolerance-acceleration", "none", "--out", ".", "--name", "c", "--format", "dxf"]);
    assert_eq!(run.code, 0, "{}", run.err);
    for (asked, code, verdict) in [
        (vec![], 0, "warn"),
        (vec!["--tolerance-acceleration", "none"], 0, "warn"),
        (vec!["--accuracy", "standard"], 0, "warn"),
        (vec!["--tolerance-acceleration", "5%"], 1, "fail"),
        (vec!["--tolerance-acceleration", "70mm/rad2"], 1, "fail"),
        (vec!["--tolerance-acceleration", "90mm/rad2"], 0, "warn"),
        (vec!["--tolerance-velocity", "0.5mm/rad"], 1, "fail"),
        (vec!["--tolerance-velocity", "0.55mm/rad"], 0, "warn"),
    ] {
        run = check(run, &[&["c.dxf", "--json"], &asked[..]].concat());
        let report = report(&run);
        let checks = report["checks"].as_array().expect("checks");
        let acceleration = checks.iter().find(|c| c["check"] == "acceleration").expect("felt");
        assert_eq!((run.code, acceleration["verdict"].as_str()), (code, Some(verdict)), "{asked:?}: {acceleration}");
    }
    let run = check(run, &["c.dxf", "--tolerance-acceleration", "5rad/rad2"]);
    assert!(run.code == 2 && run.err.contains("mm/rad2"), "{}", run.err);
    // A solid of sections is not rolled on.
    let conoid = ["--rpm", "20,35"];
    let made = camgen(&[&["conoid", "--out", ".", "--name", "c", "--format", "step"], &conoid[..]].concat());
    assert_eq!(made.code, 0, "{}", made.err);
    let solid = [&["c.step", "--cam", "conoid"], &conoid[..]].concat();
    let run = check(made, &[&solid[..], &["--tolerance-acceleration", "5%"]].concat());
    assert!(run.code == 2 && run.err.contains("give the DXF file of a section"), "{}", run.err);
    assert_eq!(check(run, &[&solid[..], &["--tolerance-acceleration", "none"]].concat()).code, 0);
}

/// A record holds a radius that was given by its diameter as it was typed; the design is read from it where the file is gone.
#[test]
fn a_design_with_diameters_is_found_by_its_record() {
    let text = include_str!("common/lifter.toml").replace("radius = \"10 mm\"", "diameter = \"20 mm\"")
        + "bore_diameter = \"16 mm\"\n";
    let made = crate::common::program::make(&text, &["--out", "out", "--name", "cam"]);
    assert_eq!(made.code, 0, "{}", made.err);
    std::fs::remove_file(made.directory.path().join("cam.toml")).expect("a design");
    let checked = crate::common::program::camgen_in(made.directory, &["check", "out/cam.dxf"]);
    assert!(checked.code == 0 && checked.out.contains("found in the record"), "{}{}", checked.out, checked.err);
}
