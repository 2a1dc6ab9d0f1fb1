//! What a person meets at the terminal: help whose examples run, words that are nearly right, files that are not lost.

use crate::common::program::{Run, camgen, camgen_in, commands, files, report};
use std::f64::consts::TAU;
use std::fs;
use std::io::{BufRead, BufReader, Lines};
use std::path::Path;
use std::process::{Child, ChildStderr, Command, Stdio};
use std::time::Duration;

const LIFTER: &str = include_str!("common/lifter.toml");

/// The examples of a help, each with the line below it.
fn examples(help: &str) -> Vec<(String, String)> {
    let (_, text) = help.split_once("Examples:\n").expect("examples");
    let lines: Vec<&str> = text.lines().collect();
    let pairs = lines.windows(2).filter(|pair| pair[0].starts_with("  camgen "));
    pairs.map(|pair| (pair[0].trim().to_owned(), pair[1].trim().to_owned())).collect()
}

/// A directory with the files that examples name.
fn prepared() -> tempfile::TempDir {
    let directory = tempfile::tempdir().expect("a directory");
    fs::write(directory.path().join("lifter.toml"), LIFTER).expect("written");
    let run = camgen_in(directory, &["rotary", "--format", "dxf", "--name", "part", "--out", ".", "--quiet"]);
    assert_eq!(run.code, 0, "{}", run.err);
    // Its table has points of the profile.
    let table = ["make", "lifter.toml", "--format", "csv", "--name", "measured", "--out", ".", "--quiet"];
    let run = camgen_in(run.directory, &table);
    assert_eq!(run.code, 0, "{}", run.err);
    let table = fs::read_to_string(run.directory.path().join("measured.csv")).expect("a table");
    fs::write(run.directory.path().join("centres.csv"), ball_centres(&table, 3.0)).expect("written");
    fs::write(run.directory.path().join("lift.csv"), lift_table()).expect("written");
    run.directory
}

/// The centres of a ball of a radius, mm, that touches the profile of a table.
fn ball_centres(table: &str, radius: f64) -> String {
    let mut lines = table.lines();
    let heads: Vec<&str> = lines.next().expect("heads").split(',').collect();
    let columns = ["profile_x_mm", "profile_y_mm"].map(|name| heads.iter().position(|head| *head == name).expect(name));
    let places: Vec<[f64; 2]> = lines
        .map(|line| {
            let cells: Vec<&str> = line.split(',').collect();
            columns.map(|column| cells[column].parse().expect("a number"))
        })
        .collect();
    let count = places.len();
    let centre = |index: usize| {
        let ([ax, ay], [x, y], [bx, by]) =
            (places[(index + count - 1) % count], places[index], places[(index + 1) % count]);
        let (tx, ty) = (bx - ax, by - ay);
        let length = tx.hypot(ty);
        format!("{},{}\n", x + radius * ty / length, y - radius * tx / length)
    };
    format!("x,y\n{}", (0..count).map(centre).collect::<String>())
}

/// A lift table: up by a cycloid, a dwell, down, a dwell.
fn lift_table() -> String {
    let cycloid = |x: f64| x - (TAU * x).sin() / TAU;
    let row = |degree: u32| {
        let x = f64::from(degree) / 120.0;
        let lift = if degree < 120 {
            cycloid(x)
        } else if degree < 160 {
            1.0
        } else {
            cycloid((280.0 - f64::from(degree).min(280.0)) / 120.0)
        };
        format!("{degree},{:.4}\n", 20.0 * lift)
    };
    format!("deg,mm\n{}", (0..360).map(row).collect::<String>())
}

/// The page of camgen fits a screen and names every command.
#[test]
fn the_help_of_camgen_names_every_command() {
    let help = camgen(&["--help"]).out;
    let words: Vec<&str> = help.split_whitespace().collect();
    for name in commands() {
        assert!(words.contains(&name.as_str()), "{name} is not in the help: {help}");
    }
    assert!(help.lines().count() <= 25 && help.lines().all(|line| line.chars().count() <= 82), "{help}");
}

#[test]
fn every_example_of_every_help_runs() {
    let all = commands();
    assert!(all.len() >= 12, "{all:?}");
    for command in all {
        let help = camgen(&[&command, "--help"]).out;
        let examples = examples(&help);
        assert_eq!(examples.len(), 2, "{command}");
        for (line, told) in examples {
            let words: Vec<&str> = line.split_whitespace().skip(1).collect();
            let run = camgen_in(prepared(), &words);
            let expected = i32::from(told.starts_with("exit code 1"));
            assert_eq!(run.code, expected, "{line}: {}{}", run.out, run.err);
            assert!(!run.out.is_empty() || words[0] == "init", "{line}");
        }
    }
}

#[test]
fn words_that_are_nearly_right_are_named() {
    let cases: &[(&[&str], &str)] = &[
        (&["rotari"], "rotary"),
        (&["rotary", "dip"], "did you mean `dpi`?"),
        (&["rotary", "dpi-papr"], "did you mean `dpi-paper`?"),
        (&["make", "liftr.toml"], "did you mean `lifter.toml`?"),
        (&["rotary", "--format", "dxff"], "did you mean `dxf`?"),
        (&["rotary", "--dxf-version", "r2001"], "did you mean `r20"),
        (&["rotary", "--outline", "splin"], "spline"),
        (&["rotary", "--set", "cam.material=stel"], "did you mean \"steel\"?"),
        (&["make", "lifter.toml", "--set", "motion.segment[0].law=cycloid"], "did you mean \"cycloidal\"?"),
        (&["explain", "presure"], "did you mean `pressure_angle`?"),
        (&["machines", "show", "dpy"], "did you mean `dpi`?"),
        (&["man", "rotry"], "did you mean `rotary`?"),
    ];
    for (args, told) in cases {
        let run = camgen_in(prepared(), args);
        assert!(run.code == 2 && run.err.contains(told), "{args:?}: {}", run.err);
    }
}

#[test]
fn values_are_taken_in_any_case() {
    let hash = |args: &[&str]| {
        let run = camgen_in(prepared(), &[args, &["--json", "--dry-run"]].concat());
        assert_eq!(run.code, 0, "{args:?}: {}", run.err);
        report(&run)["inputs"]["hash"].clone()
    };
    for (any, usual) in [
        (vec!["rotary", "DPI"], vec!["rotary", "dpi"]),
        (vec!["rotary", "--outline", "SPLINE"], vec!["rotary", "--outline", "spline"]),
        (
            vec!["rotary", "--side", "Inside", "--dxf-version", "R2000", "--format", "DXF"],
            vec!["rotary", "--side", "inside"],
        ),
        (vec!["rotary", "--set", "cam.rotation=CCW"], vec!["rotary", "--set", "cam.rotation=ccw"]),
        (
            vec!["rotary", "--set", "limits.contact_stress=1500mpa"],
            vec!["rotary", "--set", "limits.contact_stress=1500MPa"],
        ),
        (vec!["rotary", "--tolerance-acceleration", "None"], vec!["rotary", "--tolerance-acceleration", "none"]),
        (vec!["translating", "--balance", "RETURN", "--solver", "Ode"], vec!["translating", "--balance", "return"]),
    ] {
        assert_eq!(hash(&any), hash(&usual), "{any:?}");
    }
    let law = ["make", "lifter.toml", "--dry-run", "--set", "motion.segment[0].law=Harmonic"];
    assert_eq!(camgen_in(prepared(), &law).code, 0);
}

fn rotary(directory: tempfile::TempDir, more: &[&str]) -> Run {
    camgen_in(directory, &[&["rotary", "--name", "cam", "--format", "dxf,csv"], more].concat())
}

/// Trying one value after another never stops; what differs from the last time is told.
#[test]
fn own_files_are_replaced_and_what_changed_is_told() {
    let run = rotary(prepared(), &[]);
    assert!(run.code == 0 && !run.out.contains("changed since"), "{}", run.out);
    let run = rotary(run.directory, &[]);
    assert!(run.code == 0 && !run.out.contains("changed since"), "{}", run.out);
    let run = rotary(run.directory, &["--rpm", "34", "--set", "follower.roller.radius=25mm"]);
    assert_eq!(run.code, 0, "{}", run.err);
    for told in ["rpm 35 → 34", "follower.roller.radius 30 mm → 25mm"] {
        assert!(run.out.contains(told), "{}", run.out);
    }
    // The same value in another unit is the same.
    let run = rotary(run.directory, &["--rpm", "34", "--set", "follower.roller.radius=2.5cm"]);
    assert!(run.code == 0 && !run.out.contains("changed since"), "{}", run.out);
    // The record changes no byte of a file.
    let fresh = rotary(prepared(), &["--rpm", "34", "--set", "follower.roller.radius=25mm"]);
    for name in ["cam.dxf", "cam.csv"] {
        let read = |run: &Run| fs::read(run.directory.path().join("output").join(name)).expect("a file");
        assert_eq!(read(&run), read(&fresh), "{name}");
    }
}

#[test]
fn files_of_others_are_never_replaced_without_being_asked() {
    let edited = |run: &Run| {
        let file = run.directory.path().join("output/cam.dxf");
        fs::write(&file, "mine").expect("edited");
        file
    };
    let run = rotary(prepared(), &[]);
    let file = edited(&run);
    let run = rotary(run.directory, &["--rpm", "34"]);
    assert!(run.code == 2 && run.err.contains("output/cam.dxf` was changed"), "{}", run.err);
    assert!(run.err.contains("--overwrite") && !run.err.contains("cam.csv"), "{}", run.err);
    assert_eq!(fs::read_to_string(&file).expect("a file"), "mine");
    assert_eq!(files(&run.directory.path().join("output")), ["cam.csv", "cam.dxf"]);
    let run = rotary(run.directory, &["--rpm", "34", "--overwrite"]);
    assert_eq!(run.code, 0, "{}", run.err);
    assert_eq!(rotary(run.directory, &[]).code, 0, "it is camgen's again");

    // A file that camgen has not written, and files of a run without a record.
    let run = rotary(prepared(), &[]);
    fs::remove_file(run.directory.path().join("output/.camgen.json")).expect("removed");
    let run = rotary(run.directory, &["--rpm", "34"]);
    assert!(run.code == 2 && run.err.contains("was not written by camgen"), "{}", run.err);
    let run = rotary(run.directory, &[]);
    assert_eq!(run.code, 0, "the same bytes: {}", run.err);
}

#[test]
fn a_dry_run_reports_and_writes_nothing() {
    let run = camgen(&["rotary", "--dry-run"]);
    assert!(run.code == 0 && run.out.contains("pressure_angle") && !run.out.contains("  files"), "{}", run.out);
    assert!(files(run.directory.path()).is_empty() && !run.directory.path().join("output").exists());
    let run = camgen(&["rotary", "dpi-paper", "--set", "cam.base_radius=200mm", "--dry-run", "--force"]);
    assert!(run.code == 1 && files(run.directory.path()).is_empty(), "{}", run.err);
}

#[test]
fn a_report_stands_in_columns() {
    let out = camgen(&["rotary", "--dry-run"]).out;
    let rows: Vec<&str> = out.lines().filter(|line| line.starts_with("    pass  ")).collect();
    assert!(rows.len() > 10, "{out}");
    let starts: Vec<usize> = rows.iter().filter_map(|row| row.find(" at ").or(row.find(" above "))).collect();
    assert!(starts.len() > 10 && starts.windows(2).all(|pair| pair[0] == pair[1]), "{out}");
    assert!(out.contains("at most 30 deg") && out.contains("above 0 mm") && out.contains("at least 60 mm"), "{out}");
    assert!(out.contains("  terms\n") && out.contains("inertia less air  residual force"), "{out}");
    assert!(!out.contains('\u{1b}'), "colour is for a terminal");
    let lifter = camgen_in(prepared(), &["make", "lifter.toml", "--dry-run"]).out;
    assert!(!lifter.contains("  bottom  "), "only the terms that occur: {lifter}");
}

/// Numbers of a text with more than six digits, or with an exponent of a program.
fn too_long(text: &str) -> Vec<&str> {
    let words = text.split(|c: char| c.is_whitespace() || "();,:×=%\"'".contains(c));
    let numbers = words.map(|word| word.trim_end_matches('°').trim_end_matches('.'));
    let is_long = |word: &&str| {
        let mantissa = word.split(['e', 'E']).next().unwrap_or_default();
        let digits = mantissa.chars().filter(char::is_ascii_digit).collect::<String>();
        word.contains('.')
            && word.parse::<f64>().is_ok()
            && (digits.trim_start_matches('0').len() > 6 || mantissa != *word)
    };
    numbers.filter(is_long).collect()
}

/// Figures in texts have six digits, and the last paragraph says what the model leaves out, as JSON does.
#[test]
fn a_report_has_figures_for_people_and_says_what_is_not_modelled() {
    assert_eq!(
        too_long("5.55e-14 %, 193986.6646 mm, 29.5089° (1.65e0 %), 0.004944 at 5.4.3"),
        ["5.55e-14", "193986.6646", "1.65e0"]
    );
    let commands: &[&[&str]] = &[
        &["rotary"],
        &["rotary", "dpi-paper"],
        &["translating"],
        &["conoid"],
        &["conoid", "--rpm", "20,35"],
        &["make", "lever"],
        &["make", "feeder"],
        &["brake", "roll-level"],
        &["brake", "roll", "--cam"],
        &["linkage"],
        &["drive"],
        &["shaft"],
        &["regimes"],
        &["spring"],
        &["scatter"],
        &["laws", "feeder"],
        &["size", "feeder"],
    ];
    for command in commands {
        let run = camgen(&[command, &["--dry-run"][..]].concat());
        assert_eq!(run.code, 0, "{command:?}: {}", run.err);
        assert!(too_long(&run.out).is_empty(), "{command:?}: {:?}", too_long(&run.out));
        let json = report(&camgen(&[command, &["--json", "--dry-run"][..]].concat()));
        let sentences = json["not_modelled"].as_array().map_or(&[][..], Vec::as_slice);
        let lines: Vec<String> =
            sentences.iter().map(|line| format!("    {}\n", line.as_str().expect("a text"))).collect();
        let (_, last) = run.out.rsplit_once("  not modelled\n").unwrap_or_default();
        let (paragraph, _) = last.split_once("  inputs ").unwrap_or_default();
        assert_eq!(paragraph, lines.concat(), "{command:?}");
        assert_eq!(lines.is_empty(), ["laws", "size"].contains(&command[0]), "{command:?}");
    }
}

#[test]
fn completions_and_pages_are_made_of_the_commands() {
    for shell in ["bash", "zsh", "fish", "elvish", "PowerShell"] {
        let run = camgen(&["completions", shell]);
        assert!(run.code == 0 && run.out.contains("translating") && run.out.contains("dxf-version"), "{shell}");
    }
    let page = camgen(&["man"]).out;
    assert!(page.contains(".TH camgen") && page.contains("translating"), "{page}");
    for command in commands() {
        let page = camgen(&["man", &command]).out;
        assert!(page.contains(&format!(".TH camgen-{command}")) && page.contains("Examples"), "{command}: {page}");
    }
}

#[test]
fn a_template_is_not_written_under_the_name_of_a_design_or_follower() {
    for (name, remedy) in [("feeder", "camgen machines show feeder"), ("swinging-roller", "--follower swinging-roller")]
    {
        let run = camgen(&["init", name]);
        assert_eq!(run.code, 2, "{}", run.err);
        assert!(run.err.contains(remedy), "{}", run.err);
        assert!(!run.directory.path().join(name).exists(), "{name}");
    }
}

#[test]
fn init_writes_a_file_and_never_replaces_one() {
    let run = camgen(&["init", "press.toml"]);
    assert!(run.code == 0 && run.out.is_empty(), "{}", run.err);
    let file = run.directory.path().join("press.toml");
    assert_eq!(fs::read_to_string(&file).expect("a file"), camgen(&["init"]).out);
    fs::write(&file, "mine").expect("edited");
    let run = camgen_in(run.directory, &["init", "press.toml"]);
    assert!(run.code == 2 && run.err.contains("is not replaced"), "{}", run.err);
    assert_eq!(fs::read_to_string(&file).expect("a file"), "mine");
}

/// A command that watches its files.
struct Watching {
    child: Child,
    messages: Lines<BufReader<ChildStderr>>,
}

impl Watching {
    fn start(directory: &Path, args: &[&str]) -> Self {
        let mut child = Command::new(env!("CARGO_BIN_EXE_camgen"))
            .current_dir(directory)
            .args(args)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("it runs");
        let messages = BufReader::new(child.stderr.take().expect("messages")).lines();
        Self { child, messages }
    }

    /// Its messages until it waits.
    fn until_it_waits(&mut self) -> String {
        let mut all = String::new();
        while !all.contains("waiting for changes") {
            all.push_str(&self.messages.next().expect("a message").expect("a line"));
        }
        all
    }

    /// Changes a file, and gives the messages of the run that follows.
    fn after_change(&mut self, file: &Path, text: &str) -> String {
        // The clock of a file system may be coarse.
        std::thread::sleep(Duration::from_millis(50));
        fs::write(file, text).expect("written");
        self.until_it_waits()
    }

    /// Ends it, and gives its reports.
    fn reports(mut self) -> String {
        self.child.kill().expect("ended");
        let mut out = String::new();
        std::io::Read::read_to_string(&mut self.child.stdout.take().expect("reports"), &mut out).expect("text");
        self.child.wait().expect("ended");
        out
    }
}

/// The command runs again after each change, also after a fault.
#[test]
fn a_watched_file_is_run_again_when_it_changes() {
    let directory = prepared();
    let file = directory.path().join("lifter.toml");
    let mut watching = Watching::start(directory.path(), &["make", "lifter.toml", "--watch", "--format", "dxf", "-v"]);
    watching.until_it_waits();
    assert!(watching.after_change(&file, &LIFTER.replace("20 mm", "20 mn")).contains("error:"));
    watching.after_change(&file, &LIFTER.replace("20 mm", "22 mm"));
    let out = watching.reports();
    assert!(out.contains("lift 20.000 mm") && out.contains("lift 22.000 mm"), "{out}");

    let run = camgen(&["rotary", "--watch"]);
    assert!(run.code == 2 && run.err.contains("--watch needs a file"), "{}", run.err);
}

/// A table that a machine file names is watched as well, also one that is not there yet.
#[test]
fn a_watched_table_is_read_again_when_it_changes() {
    let directory = tempfile::tempdir().expect("a directory");
    let text = "name = \"t\"\n[motion]\nstart = \"0 mm\"\ntable = \"rows.csv\"\n[follower.roller]\nradius = \"10 mm\"\n[cam]\nbase_radius = \"auto\"\n";
    fs::write(directory.path().join("cam.toml"), text).expect("written");
    let rows = |lift: f64| {
        let row = |angle: i32| format!("{angle}, {:.6}\n", 0.5 * lift * (1.0 - f64::from(angle).to_radians().cos()));
        (0..360).step_by(5).map(row).collect::<String>()
    };
    let mut watching =
        Watching::start(directory.path(), &["make", "cam.toml", "--rpm", "60", "--watch", "--dry-run", "-v"]);
    let first = watching.until_it_waits();
    assert!(first.contains("cannot read `rows.csv`") && first.contains("cam.toml, rows.csv"), "{first}");
    for lift in [10.0, 12.0] {
        watching.after_change(&directory.path().join("rows.csv"), &rows(lift));
    }
    let out = watching.reports();
    assert!(out.contains("lift 10.000 mm") && out.contains("lift 12.000 mm"), "{out}");
}

/// A watch that has written files ends at once with each signal that ends a program, and its files are whole.
#[cfg(unix)]
#[test]
fn a_signal_ends_a_watch_that_has_written() {
    use std::os::unix::process::ExitStatusExt as _;
    // What the tests themselves were started to ignore, as under nohup, stays ignored.
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let ignored = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0);
    let signals = [("INT", 2), ("TERM", 15), ("HUP", 1)];
    for (name, number) in signals.into_iter().filter(|(_, number)| (ignored >> (number - 1)) & 1 == 0) {
        let directory = prepared();
        let mut child = Command::new(env!("CARGO_BIN_EXE_camgen"))
            .current_dir(directory.path())
            .args(["make", "lifter.toml", "--watch", "--format", "dxf,csv", "--quiet"])
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .expect("it runs");
        let mut told = BufReader::new(child.stderr.take().expect("messages")).lines();
        assert!(told.any(|line| line.expect("a line").contains("waiting for changes")), "{name}");
        let sent = Command::new("kill").args([format!("-{name}"), child.id().to_string()]).status();
        assert!(sent.expect("kill").success());
        let until = std::time::Instant::now() + Duration::from_secs(20);
        let ended = loop {
            match child.try_wait().expect("a child") {
                Some(status) => break status,
                None if std::time::Instant::now() > until => {
                    child.kill().expect("ended");
                    panic!("SIG{name} did not end it");
                }
                None => std::thread::sleep(Duration::from_millis(20)),
            }
        };
        assert_eq!(ended.signal(), Some(number), "{ended:?}");
        let mut left: Vec<String> = fs::read_dir(directory.path().join("output"))
            .expect("files")
            .map(|entry| entry.expect("a file").file_name().to_string_lossy().into_owned())
            .collect();
        left.sort();
        assert!(left.iter().all(|file| file == ".camgen.json" || file.starts_with("lifter-make")), "{left:?}");
        assert_eq!(left.len(), 3, "{left:?}");
    }
}

/// Whoever opens a file of a cam that breaks a limit is told so, whichever file it is.
#[test]
fn files_of_a_cam_that_breaks_a_limit_say_so() {
    let run =
        camgen(&["rotary", "--set", "cam.base_radius=40mm", "--force", "--format", "dxf,step,svg", "--name", "bad"]);
    assert_eq!(run.code, 1, "{}", run.err);
    let good = camgen(&["rotary", "--format", "dxf,step,svg", "--name", "good"]);
    for ending in ["dxf", "step", "svg"] {
        let text = |run: &Run, stem: &str| {
            std::fs::read_to_string(run.directory.path().join(format!("output/{stem}.{ending}"))).expect("the file")
        };
        assert!(text(&run, "bad").contains("NOT FOR MANUFACTURE, failed: pressure_angle"), "{ending}");
        assert!(!text(&good, "good").contains("NOT FOR MANUFACTURE"), "{ending}");
    }
}

/// A file of somebody else in the place of the record is not replaced.
#[test]
fn a_record_of_somebody_else_is_kept() {
    let directory = tempfile::tempdir().expect("a directory");
    let record = directory.path().join("output/.camgen.json");
    std::fs::create_dir(directory.path().join("output")).expect("made");
    std::fs::write(&record, "{\"my\": \"settings\"}").expect("written");
    let run = camgen_in(directory, &["rotary", "--format", "dxf"]);
    assert_eq!(run.code, 2);
    assert!(run.err.contains(".camgen.json"), "{}", run.err);
    let kept = std::fs::read_to_string(run.directory.path().join("output/.camgen.json")).expect("kept");
    assert_eq!(kept, "{\"my\": \"settings\"}");
}

/// What a command reads, it does not replace, whatever flags say.
#[test]
fn inputs_are_not_replaced() {
    let directory = tempfile::tempdir().expect("a directory");
    let row = |i: u32| format!("{},{:.6}\n", 10 * i, 4.0 - 4.0 * f64::from(10 * i).to_radians().cos());
    let rows = (0..36).map(row).collect::<Vec<_>>().concat();
    let design = "name = \"h\"\n[motion]\nrpm = 100\nstart = \"0 mm\"\ntable = \"cam.csv\"\n[follower.roller]\nradius = \"10 mm\"\n[cam]\nbase_radius = \"40 mm\"\n";
    std::fs::write(directory.path().join("cam.csv"), &rows).expect("written");
    std::fs::write(directory.path().join("cam.toml"), design).expect("written");
    let mut directory = directory;
    for (words, input) in [
        ("make cam.toml --out . --name cam --format csv --overwrite", "cam.csv"),
        ("make cam.toml --out . --name cam --format csv", "cam.csv"),
        ("make cam.toml --out ../{} --name cam --format csv --overwrite --force", "cam.csv"),
        ("import cam.csv --out . --name cam --overwrite --format csv", "cam.csv"),
    ] {
        let folder = directory.path().file_name().expect("a name").to_string_lossy().into_owned();
        let words = words.replace("{}", &folder);
        let run = camgen_in(directory, &words.split(' ').collect::<Vec<_>>());
        let told = "was read as an input and is not replaced; nothing was written";
        assert!(run.code == 2 && run.err.contains(told) && run.err.contains(input), "{words}: {}{}", run.out, run.err);
        assert_eq!(std::fs::read_to_string(run.directory.path().join("cam.csv")).expect("a table"), rows, "{words}");
        directory = run.directory;
    }
    let run = camgen_in(directory, &["make", "cam.toml", "--out", ".", "--name", "other", "--format", "csv"]);
    assert!(run.code < 2, "{}{}", run.out, run.err);
}
