//! Is this file that cam? `cargo run --example check_dxf -- FILE.dxf`; without a file one is made, and then one with a fault.

#![allow(clippy::print_stdout, reason = "an example shows what it found")]

use camgen::{Machine, Report, Spec, SpecOfPress};

fn told(name: &str, report: &Report) {
    println!("{name}: {}", if report.passed() { "is this cam" } else { "is NOT this cam" });
    for finding in report.checks.iter().filter(|finding| finding.verdict == camgen::Verdict::Fail) {
        println!("  {} {} {} at {}", finding.check, finding.value, finding.unit, finding.place);
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (machine, _) = Machine::load("dpi", &[])?;
    let cam = Spec::rotary(machine, 35.0).solve()?;
    if let Some(path) = std::env::args().nth(1) {
        let bytes = std::fs::read(&path)?;
        told(&path, &cam.check(&bytes, 5e-6)?);
        return Ok(());
    }
    let proven = cam.draw(5e-6)?.prove()?;
    let good = proven.cut_files().first().ok_or("no file")?.clone();
    let report = cam.check(&good, 5e-6)?;
    told("the file as written", &report);
    assert!(report.passed());

    // The same cam cut for another speed.
    let (machine, _) = Machine::load("dpi", &[])?;
    let other = Spec::rotary(machine, 34.0).solve()?;
    let report = other.check(&good, 5e-6)?;
    told("the same file for 34 rpm", &report);
    assert!(!report.passed());
    Ok(())
}
