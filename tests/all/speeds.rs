//! Speed-dependent motions, for each way to give the speed.

use crate::common::program::{make, report};

const PER_SECOND: &str = r#"
name = "per second"
[motion]
rpm = 100
start = "0 mm"
[[motion.segment]]
law = "polynomial"
over = "60 deg"
to = "10 mm"
[[motion.segment]]
law = "constant-velocity"
velocity = "0.3 m/s"
over = "40 deg"
[[motion.segment]]
law = "polynomial"
to = "0 mm"
[follower.roller]
radius = "10 mm"
[cam]
base_radius = "60 mm"
[limits]
"#;

/// A velocity per second is read at the speed in use, from `--rpm` or `motion.rpm`.
#[test]
fn rates_per_second_are_those_at_the_speed_that_is_used() {
    let motion =
        |args: &[&str]| report(&make(PER_SECOND, &[&["--dry-run", "--json"], args].concat()))["motion"].clone();
    let (by_flag, by_key, of_file) = (motion(&["--rpm", "200"]), motion(&["--set", "motion.rpm=200"]), motion(&[]));
    assert!(by_flag == by_key && by_flag != of_file && !by_flag.is_null(), "{by_flag} {by_key}");
}

/// A faulty speed is one fault: it is not also reported as missing.
#[test]
fn a_faulty_speed_is_one_fault() {
    let run = make(PER_SECOND, &["--dry-run", "--set", "motion.rpm=-5"]);
    assert!(
        run.code == 2 && run.err.contains("must be at least 0.001") && !run.err.contains("needs motion.rpm"),
        "{}",
        run.err
    );
}
