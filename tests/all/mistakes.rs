//! Mistakes of a new user: what is typed, and that the answer is what was meant.
//!
//! Each is refused with exit code 2 and one message: it names the place where there is one, says what was meant, and nothing is
//! written.

use crate::common::program::{Run, camgen_in, files};
use std::fs;

/// A lifter, with its faults: parts of the text, and what is typed in their place.
const LIFTER: &str = "name = \"lifter\"\n\n[motion]\nrpm = 120\nstart = \"0 mm\"\n\n[[motion.segment]]\nlaw = \"cycloidal\"\nover = \"90 deg\"\nto = \"20 mm\"\n\n[[motion.segment]]\nlaw = \"dwell\"\nover = \"30 deg\"\n\n[[motion.segment]]\nlaw = \"3-4-5\"\nover = \"120 deg\"\nto = \"0 mm\"\n\n[[motion.segment]]\nlaw = \"dwell\"\n\n[follower.roller]\nradius = \"12 mm\"\n\n[cam]\nbore_radius = \"10 mm\"\nthickness = \"15 mm\"\n";
/// A lever.
const LEVER: &str = "name = \"lever\"\n[motion]\nrpm = 120\nstart = \"0 deg\"\n[[motion.segment]]\nlaw = \"cycloidal\"\nover = \"120 deg\"\n\
                     to = \"20 deg\"\n[[motion.segment]]\nlaw = \"3-4-5\"\nover = \"120 deg\"\nto = \"0 deg\"\n[[motion.segment]]\n\
                     law = \"dwell\"\n[follower.swinging-roller]\nradius = \"12 mm\"\narm = \"110 mm\"\npivot_distance = \"140 mm\"\n\
                     [cam]\nbore_radius = \"10 mm\"\nthickness = \"15 mm\"\n";

/// What is in `cam.toml`.
enum Text {
    /// The lifter with a part replaced.
    Lifter(&'static str, &'static str),
    /// The lever with a part replaced.
    Lever(&'static str, &'static str),
    /// Another text.
    Whole(&'static str),
}
use Text::{Lever, Lifter, Whole};

impl Text {
    fn text(&self) -> String {
        match self {
            Lifter("", "") => LIFTER.to_owned(),
            Lever("", "") => LEVER.to_owned(),
            Lifter(from, to) => replaced(LIFTER, from, to),
            Lever(from, to) => replaced(LEVER, from, to),
            Whole(text) => (*text).to_owned(),
        }
    }
}

fn replaced(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "{from:?} is not in the text");
    text.replacen(from, to, 1)
}

/// A mistake: the file, the command line, what the answer contains, and what would be a wrong cause.
type Mistake = (Text, &'static str, &'static [&'static str], &'static [&'static str]);

const MAKE: &str = "make cam.toml";

fn run(text: &str, words: &str) -> Run {
    let directory = tempfile::tempdir().expect("a directory");
    fs::write(directory.path().join("cam.toml"), text).expect("written");
    fs::write(directory.path().join("part.dxf"), "0\nSECTION\n2\nENTITIES\n0\nENDSEC\n0\nEOF\n").expect("written");
    fs::write(directory.path().join("lift.csv"), "angle,lift\n0,0\n90,10\n180,0\n").expect("written");
    let words: Vec<&str> = words.split(' ').collect();
    camgen_in(directory, &words)
}

#[rustfmt::skip] // a line for each
const MISTAKES: &[Mistake] = &[
    (Lifter("radius = \"12 mm\"", "radius = \"12\""), MAKE, &["cam.toml:", "has no unit", "mm"], &[]),
    (Lifter("radius = \"12 mm\"", "radius = 12"), MAKE, &["`12` has no unit", "mm"], &["TOML"]),
    (Lifter("radius = \"12 mm\"", "radius = \"12,5 mm\""), MAKE, &["decimal point", "`12.5 mm`"], &["unknown unit"]),
    (Lifter("radius = \"12 mm\"", "radius = \"1/2 in\""), MAKE, &["fraction", "`0.5 in`"], &["unknown unit"]),
    (Lifter("radius = \"12 mm\"", "radius = \"Ø24 mm\""), MAKE, &["is a diameter", "without Ø"], &["start with a number"]),
    (Lifter("radius = \"12 mm\"", "radius = \"12 Mm\""), MAKE, &["unknown unit `Mm`", "mm"], &[]),
    (Lifter("radius = \"12 mm\"", "radius = \"12 kg\""), MAKE, &["unit of mass, not of length"], &[]),
    (Lifter("radius = \"12 mm\"", "radius = \"-12 mm\""), MAKE, &["must be above 0 mm"], &[]),
    (Lifter("radius = \"12 mm\"", "radius = 12 mm"), MAKE, &["needs quotes", "radius = \"12 mm\""], &[]),
    (Lifter("law = \"cycloidal\"", "law = cycloidal"), MAKE, &["needs quotes", "law = \"cycloidal\""], &[]),
    (Lifter("radius = \"12 mm\"", "radius: \"12 mm\""), MAKE, &["joined by =", "radius = \"12 mm\""], &[]),
    (Lifter("radius = \"12 mm\"", "radius \"12 mm\""), MAKE, &["joined by =", "radius = \"12 mm\""], &[]),
    (Lifter("radius = \"12 mm\"", "radius = “12 mm”"), MAKE, &["straight quotes", "radius = \"12 mm\""], &[]),
    (Lifter("rpm = 120", "rpm = 120,5"), MAKE, &["decimal point", "rpm = 120.5"], &[]),
    (Lifter("rpm = 120", "rpm = -250"), MAKE, &["above 0", "cam.rotation"], &[]),
    (Lifter("rpm = 120", "rpm = \"120 rpm\""), MAKE, &["bare number"], &[]),
    (Lifter("rpm = 120", "rpm ="), MAKE, &["`rpm` has no value"], &[]),
    (Lifter("rpm = 120", "// the speed\nrpm = 120"), MAKE, &["a comment begins with #"], &[]),
    (Lifter("radius = \"12 mm\"", "radus = \"12 mm\""), MAKE, &["unknown key `follower.roller.radus`", "did you mean `follower.roller.radius`"], &["missing key"]),
    (Lifter("radius = \"12 mm\"", "diamter = \"24 mm\""), MAKE, &["did you mean `follower.roller.diameter`"], &["missing key"]),
    (Lifter("radius = \"12 mm\"", "size = \"24 mm\""), MAKE, &["`follower.roller.radius` or `follower.roller.diameter`"], &["mass"]),
    (Lifter("radius = \"12 mm\"", "radius = \"12 mm\"\ndiameter = \"24 mm\""), MAKE, &["give `radius` or `diameter`, not both"], &[]),
    (Lifter("radius = \"12 mm\"", ""), MAKE, &["missing key `follower.roller.radius`", "radius = \"30 mm\", or diameter = \"60 mm\""], &[]),
    (Lifter("bore_radius = \"10 mm\"", "diameter = \"20 mm\""), MAKE, &["`cam.base_diameter` or `cam.bore_diameter`"], &["shaft.disc"]),
    (Lifter("bore_radius = \"10 mm\"", "bore = \"20 mm\""), MAKE, &["`cam.bore_radius` or `cam.bore_diameter`"], &["shaft"]),
    (Lifter("thickness = \"15 mm\"", "width = \"15 mm\""), MAKE, &["did you mean `cam.thickness`"], &[]),
    (Lifter("over = \"90 deg\"", "angle = \"90 deg\""), MAKE, &["did you mean `motion.segment[0].over`"], &["cam.keyway", "a segment has no"]),
    (Lifter("to = \"20 mm\"", "lift = \"20 mm\""), MAKE, &["did you mean `motion.segment[0].to`"], &["needs `to`"]),
    (Lifter("law = \"cycloidal\"", "type = \"cycloidal\""), MAKE, &["did you mean `motion.segment[0].law`"], &["linkage"]),
    (Lifter("rpm = 120", "speed = 120"), MAKE, &["did you mean `motion.rpm`"], &["brake"]),
    (Lifter("[follower.roller]", "[roller]"), MAKE, &["did you mean `follower.roller.radius`"], &["no follower"]),
    (Lifter("[cam]", "[camm]"), MAKE, &["did you mean `cam."], &[]),
    (Lifter("[cam]", "[disc]\n[cam]"), MAKE, &["unknown table `disc`"], &[]),
    (Lifter("[[motion.segment]]", "[motion.segment]"), MAKE, &["[[motion.segment]]"], &["invalid"]),
    (Whole("name = \"x\"\n[motion]\nstart = \"0 mm\"\n[motion.segment]\nover = \"180 deg\"\nto = \"9 mm\"\n[follower.roller]\nradius = \"9 mm\"\n"), MAKE, &["write [[motion.segment]]"], &[]),
    (Whole("name = \"x\"\n[motion]\nstart = \"0 mm\"\n[motion.segment]\nover = \"180 deg\"\nto = \"9 mm\"\n[motion.segment]\nto = \"0 mm\"\n[follower.roller]\nradius = \"9 mm\"\n"), MAKE, &["write [[motion.segment]], with two brackets"], &["duplicate key"]),
    (Lifter("[cam]", "[motion]\n[cam]"), MAKE, &["given more than once", "one header"], &[]),
    (Lifter("rpm = 120", "rpm = 120\nrpm = 130"), MAKE, &["`rpm` is given twice"], &[]),
    (Lifter("[follower.roller]", "[follower.flat]\n[follower.roller]"), MAKE, &["two followers"], &[]),
    (Lifter("law = \"cycloidal\"", "law = \"cycliodal\""), MAKE, &["there is no law \"cycliodal\"", "did you mean \"cycloidal\""], &[]),
    (Lifter("to = \"20 mm\"", "to = \"20 deg\""), MAKE, &["`to` is an angle, but motion.start is a length"], &[]),
    (Lifter("over = \"90 deg\"", "over = \"400 deg\""), MAKE, &["at most 360 deg"], &[]),
    (Lifter("over = \"90 deg\"", "over = \"250 deg\""), MAKE, &["already cover"], &[]),
    (Lifter("over = \"90 deg\"\n", ""), MAKE, &["a segment has no `over`"], &[]),
    (Lifter("to = \"0 mm\"", "to = \"5 mm\""), MAKE, &["does not end where it starts"], &[]),
    (Lifter("start = \"0 mm\"", "start = \"0 deg\""), MAKE, &["moves along a straight path", "start = \"0 mm\""], &[]),
    (Lever("start = \"0 deg\"", "start = \"0 mm\""), MAKE, &["swings", "measured_at = \"roller\""], &[]),
    (Lever("to = \"20 deg\"", "to = \"30 mm\""), MAKE, &["30 mm along the arc of the roller (arm 110 mm) is \"15.6261 deg\"", "measured_at"], &[]),
    (Lifter("start = \"0 mm\"", "start = \"0 mm\"\nmeasured_at = \"roller\""), MAKE, &["is for a swinging follower"], &[]),
    (Lever("start = \"0 deg\"", "start = \"0 deg\"\nmeasured_at = \"output\""), MAKE, &["add output_arm"], &[]),
    (Lifter("thickness = \"15 mm\"", "thickness = \"15 mm\"\nmaterial = \"steal\""), MAKE, &["did you mean \"steel\""], &[]),
    (Lifter("bore_radius = \"10 mm\"", "bore_radius = \"10 mm\"\nbase_radius = \"9 mm\""), MAKE, &["bore_radius must be below base_radius"], &[]),
    (Lifter("", ""), "make", &["needs a file with a motion", "feeder", "lever", "valve", "camgen init"], &["dpi has"]),
    (Lifter("", ""), "make cma.toml", &["cannot read", "did you mean `cam.toml`"], &[]),
    (Lifter("", ""), "make part.dxf", &["is a DXF drawing", "camgen check part.dxf --design"], &["TOML: "]),
    (Lifter("", ""), "make lift.csv", &["is a table of numbers", "[motion] table = \"lift.csv\""], &["TOML: "]),
    (Whole(""), MAKE, &["is an empty file", "camgen init"], &["missing key"]),
    (Lifter("", ""), "make cam.toml --cutter 8mm", &["--cutter-diameter 8mm", "--cutter-radius 8mm"], &[]),
    (Lifter("", ""), "make cam.toml --rpm 33,5", &["33.5", "decimal point"], &[]),
    (Lifter("", ""), "make cam.toml --rpm -250", &["above 0", "cam.rotation"], &[]),
    (Lifter("", ""), "make cam.toml --tolerance 5", &["has no unit", "um"], &[]),
    (Lifter("", ""), "make cam.toml --format dwg", &["no such format", "dxf"], &[]),
    (Lifter("", ""), "make cam.toml --set cam.thickness", &["`=` is missing"], &[]),
    (Lifter("", ""), "make cam.toml --set motion.segment.9.to=3mm", &["no such element", "4 of [[motion.segment]]"], &[]),
    (Lifter("", ""), "mak cam.toml", &["'make'"], &[]),
    (Lifter("", ""), "rotary cam.toml", &["[bed], [buffer] and [design]", "camgen make"], &[]),
    (Lifter("", ""), "trade rotray", &["did you mean `rotary`"], &["cannot read"]),
    (Lifter("", ""), "trade cam.toml --format dwg", &["dwg"], &[]),
    (Lifter("", ""), "check cam.toml", &["cam.toml"], &[]),
    (Lifter("", ""), "size", &["FILE"], &[]),
    (Lifter("", ""), "init --follower roler", &["did you mean `roller`"], &[]),
    (Lifter("", ""), "explain presure", &["did you mean"], &[]),
    (Lifter("", ""), "machines show levr", &["did you mean `lever`"], &[]),
];

#[test]
fn each_is_answered_with_what_was_meant() {
    assert!(MISTAKES.len() >= 60, "{}", MISTAKES.len());
    let mut wrong = Vec::new();
    for (text, words, says, not) in MISTAKES {
        let run = run(&text.text(), words);
        let told = &run.err;
        let missing: Vec<&&str> = says.iter().filter(|part| !told.contains(**part)).collect();
        let misleading: Vec<&&str> = not.iter().filter(|part| told.contains(**part)).collect();
        let written = files(run.directory.path()).len() > 3;
        if run.code != 2 || !missing.is_empty() || !misleading.is_empty() || written {
            wrong.push(format!(
                "{words}: code {}, without {missing:?}, with {misleading:?}\n{}{told}",
                run.code, run.out
            ));
        }
    }
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), MISTAKES.len(), wrong.join("\n"));
}

/// What the answers say to type is accepted.
#[test]
fn what_the_answers_say_is_right() {
    for (text, words) in [
        (Lifter("", ""), "make cam.toml --cutter-diameter 8mm"),
        (Lifter("", ""), "make cam.toml --cutter-radius 4mm"),
        (Lifter("radius = \"12 mm\"", "radius = \"0.5 in\""), MAKE),
        (Lifter("radius = \"12 mm\"", "diameter = \"24 mm\""), MAKE),
        (Lifter("start = \"0 mm\"", "start = \"0 mm\"\nat = \"10 deg\""), MAKE),
        (Lever("to = \"20 deg\"", "to = \"15.6261 deg\""), MAKE),
        (Lever("rpm = 120", "rpm = 120\nmeasured_at = \"roller\""), MAKE),
        (Lever("to = \"20 deg\"", "to = \"15.6261 deg\""), "size cam.toml --free pivot_distance"),
        (Lifter("", ""), "laws cam.toml --format csv"),
        (Whole(LIFTER), "make feeder"),
    ] {
        let run = run(&text.text(), &format!("{words} --dry-run -q"));
        assert_eq!(run.code, 0, "{words}: {}{}", run.out, run.err);
    }
}
