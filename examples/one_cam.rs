//! One cam from an embedded machine to files: `cargo run --example one_cam`.

#![allow(clippy::print_stdout, reason = "an example shows what it found")]

use camgen::{Machine, Spec, SpecOfPress, Writing};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (machine, name) = Machine::load("dpi", &["follower.roller.radius=25mm".to_owned()])?;
    let cam = Spec::rotary(machine, 35.0).solve()?;
    let proven = cam.draw(5e-6)?.prove()?;
    for finding in proven.findings() {
        // A check that was not run has no value.
        let value = if finding.value.is_nan() { "–".to_owned() } else { format!("{:.4}", finding.value) };
        println!("{:<18} {value:>12} {:<4} {:?}", finding.check, finding.unit, finding.verdict);
    }
    // Refused with an error when a check has failed.
    let directory = std::env::temp_dir().join("camgen-one-cam");
    let report = proven.files(&Writing { overwrite: true, ..Writing::to(directory, name) })?.commit()?;
    println!("{}: {}", report.title(), report.files.join(", "));
    Ok(())
}
