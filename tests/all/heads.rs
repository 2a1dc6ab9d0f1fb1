//! Heads of files: every line is read, and an altered one is refused with its line.

use crate::common::program::{Run, camgen_in, files};

/// A line of a head with its first number increased by one, then with another last word.
fn altered(text: &str) -> Vec<String> {
    let value = text.find(": ").unwrap_or(0);
    let digit = text[value..].find(|c: char| c.is_ascii_digit()).map(|at| value + at);
    let number = digit.and_then(|from| {
        let rest = &text[from..];
        let end = rest.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(rest.len());
        let number = rest[..end].trim_end_matches('.').parse::<f64>().ok()?;
        Some(format!("{}{}{}", &text[..from], number + 1.0, &rest[rest[..end].trim_end_matches('.').len()..]))
    });
    let (start, last) = text.rsplit_once(' ').unwrap_or(("", text));
    let word =
        if last.parse::<f64>().is_ok() { None } else { Some(format!("{start} {}another", &last[..last.len() / 2])) };
    number.into_iter().chain(word).collect()
}

/// The lines of a head with the beginning of their statement, without camgen's mark and the settings of a drive.
fn head(name: &str, text: &str) -> Vec<(usize, usize)> {
    let lines = text.lines().enumerate();
    let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending);
    let begins = |line: &str| match ending {
        "st" => line.starts_with("   ").then_some(3),
        "dmi" => line.strip_prefix("$$ ").map(|_| 3),
        _ if name.ends_with("-isg.txt") => line.find("# ").map(|at| at + 2),
        _ => line.strip_prefix("# ").map(|_| 2),
    };
    let own = lines.take_while(|(_, line)| !line.starts_with("VAR_GLOBAL"));
    own.filter_map(|(index, line)| Some((index, begins(line)?)))
        .filter(|(index, at)| {
            let statement = text.lines().nth(*index).map_or("", |line| &line[*at..]);
            // A check without the same options does not know the requested values.
            !["camgen ", "velocity_tolerance", "acceleration_tolerance"].iter().any(|word| statement.starts_with(word))
        })
        .collect()
}

#[track_caller]
fn every_line_is_judged(design: &str, make: &[&str], check: &[&str]) -> usize {
    let directory = tempfile::tempdir().expect("a directory");
    let words = ["make", design, "--name", "cam", "--out", ".", "--force"];
    let mut run: Run = camgen_in(directory, &[&words, make].concat());
    assert!(run.code < 2, "{design} {make:?}: {}", run.err);
    let mut count = 0;
    for name in files(run.directory.path()) {
        if ![".st", ".csv", ".dmi", "-isg.txt"].iter().any(|ending| name.ends_with(ending)) || name == "cam.csv" {
            continue;
        }
        let text = std::fs::read_to_string(run.directory.path().join(&name)).expect("a file");
        let judge = |directory, text: &str| {
            let directory: tempfile::TempDir = directory;
            std::fs::write(directory.path().join(&name), text).expect("written");
            camgen_in(directory, &[&["check", &name, design], check].concat())
        };
        run = judge(run.directory, &text);
        assert_eq!(run.code, 0, "{design} {name}: {}{}", run.out, run.err);
        for (index, at) in head(&name, &text) {
            let line = text.lines().nth(index).expect("a line");
            for other in altered(&line[at..]) {
                let with = |(own, kept): (usize, &str)| {
                    if own == index { format!("{}{other}\n", &line[..at]) } else { format!("{kept}\n") }
                };
                run = judge(run.directory, &text.lines().enumerate().map(with).collect::<String>());
                let said = format!("{}{}", run.out, run.err);
                assert!(run.code == 1 || run.code == 2, "{design} {name} passes with `{other}`: {said}");
                // Statements about units or form contradict the numbers first.
                let numbers = ["follower", "slave", "interpolation", "closed", "ball", "given", "points"];
                let named = said.contains(&format!("line {}", index + 1));
                assert!(named || numbers.iter().any(|word| other.contains(word)), "{design} {name} `{other}`: {said}");
                count += 1;
            }
        }
    }
    count
}

#[test]
fn an_altered_line_of_a_head_is_refused() {
    let servo = "servo-csv,servo-xyva,servo-twincat,servo-isg";
    let all = format!("points,gauge,inspect,{servo}");
    // One or two alterations of each statement.
    assert!(every_line_is_judged("feeder", &["--format", &all], &[]) >= 60);
    assert!(every_line_is_judged("lever", &["--format", servo], &[]) >= 28);
    assert!(every_line_is_judged("wedge", &["--format", "points"], &[]) >= 18);
}

#[test]
fn an_altered_line_of_another_table_of_points_is_refused() {
    let cubic = ["--format", "points", "--points-between", "cubic", "--points-as", "xy", "--points-step", "chord"];
    let cutter = ["--format", "points", "--points-of", "cutter", "--cutter-diameter", "8mm"];
    for (design, make) in [("feeder", &cubic[..]), ("valve", &["--format", "points"]), ("lever", &cutter)] {
        assert!(every_line_is_judged(design, make, &[]) > 20, "{design}");
    }
}

/// Lines added by a shop, a missing head, and a table checked within a coarser tolerance.
#[test]
fn other_lines_of_a_head_are_remarks() {
    let directory = tempfile::tempdir().expect("a directory");
    let words = ["make", "feeder", "--name", "cam", "--out", ".", "--format", "points,gauge,servo-csv,inspect"];
    let mut run = camgen_in(directory, &words);
    assert_eq!(run.code, 0, "{}", run.err);
    for name in ["cam-points.csv", "cam-gauge.csv", "cam-servo.csv", "cam-inspect.csv"] {
        let path = run.directory.path().join(name);
        let text = std::fs::read_to_string(&path).expect("a file");
        let needed = |line: &&str| ["gauge_follower", "interpolation", "closed"].iter().any(|word| line.contains(word));
        let bare: Vec<&str> = text.lines().filter(|line| !line.starts_with('#') || needed(line)).collect();
        let bare = bare.join("\n") + "\n";
        for (other, more) in
            [(format!("# measured by Bob: twice\n{text}"), &[][..]), (bare, &[]), (text, &["--tolerance", "10um"])]
        {
            std::fs::write(run.directory.path().join(name), other).expect("written");
            run = camgen_in(run.directory, &[&["check", name, "feeder"], more].concat());
            assert_eq!(run.code, 0, "{name} {more:?}: {}{}", run.out, run.err);
        }
    }
    // The rows of an inspection list have the zone of the drawing.
    run = camgen_in(run.directory, &["check", "cam-inspect.csv", "feeder", "--set", "cam.profile_tolerance=0.01mm"]);
    assert!(run.code == 1 && run.out.contains("the zone is not ±0.005 mm"), "{}{}", run.out, run.err);
}

/// Plain inspection lines state their unit, in any spelling, or nothing.
#[test]
fn plain_lines_of_places_may_state_their_unit() {
    for (units, own, others, wrong) in [
        ("mm", "", &["", "# units: millimetres, degrees\n", "# measured by Bob: twice\n"][..], "# units: inch\n"),
        ("inch", "# units: inches\n", &["# units: inches\n# units: inch\n"], "# units: inches\n# units: mm\n"),
    ] {
        let directory = tempfile::tempdir().expect("a directory");
        let words = ["make", "feeder", "--name", "cam", "--out", ".", "--format", "inspect", "--units", units];
        let mut run = camgen_in(directory, &words);
        assert_eq!(run.code, 0, "{}", run.err);
        let path = run.directory.path().join("cam-inspect.txt");
        let text = std::fs::read_to_string(&path).expect("a file");
        let rows = text.strip_prefix(own).expect("its unit").to_owned();
        for (head, code) in others.iter().map(|head| (*head, 0)).chain([(own, 0), (wrong, 1)]) {
            std::fs::write(&path, format!("{head}{rows}")).expect("written");
            run = camgen_in(run.directory, &["check", "cam-inspect.txt", "feeder"]);
            assert_eq!(run.code, code, "{head}: {}{}", run.out, run.err);
        }
    }
}

/// A key or a column in another unit than the file, and rows that do not go round, are refused.
#[test]
fn other_units_and_angles_are_refused() {
    let directory = tempfile::tempdir().expect("a directory");
    let run = camgen_in(directory, &["make", "feeder", "--name", "cam", "--out", ".", "--format", "points,inspect"]);
    assert_eq!(run.code, 0, "{}", run.err);
    let mut directory = run.directory;
    for (name, from, to, told) in [
        ("cam-points.csv", "# tolerance_mm: ", "# tolerance_in: ", "states `tolerance_in: "),
        ("cam-points.csv", "# velocity_error_mm_", "# velocity_error_in_", "states `velocity_error_in_per_rad"),
        ("cam-points.csv", "\n360.0,", "\n0.0,", "is at 0 degrees"),
        ("cam-points.csv", "\n360.0,", "\n-360.0,", "is at -360 degrees"),
        ("cam-inspect.csv", "lower_mm,upper_mm,", "lower_in,upper_in,", "`lower_in` stands where `lower_mm` belongs"),
        ("cam-inspect.csv", ",curvature_radius_mm", ",curvature_radius_in", "`curvature_radius_in` stands where"),
        ("cam-inspect.csv", "# lower_mm, upper_mm:", "# lower_in, upper_in:", "states `lower_in, upper_in"),
    ] {
        let path = directory.path().join(name);
        let text = std::fs::read_to_string(&path).expect("a file");
        let altered = text.replacen(from, to, 1);
        assert_ne!(altered, text, "{name} {from}");
        std::fs::write(&path, altered).expect("written");
        let run = camgen_in(directory, &["check", name, "feeder"]);
        assert!(run.code != 0 && (run.out.clone() + &run.err).contains(told), "{to}: {}{}", run.out, run.err);
        std::fs::write(&path, text).expect("written");
        directory = run.directory;
    }
}
