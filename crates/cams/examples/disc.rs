//! A disc from two laws of motion to its files, with the kernel and the cams alone: `cargo run --package camgen-cams --example disc`.

#![allow(clippy::print_stdout, reason = "an example shows what it found")]

use camgen_cams::{Error, Spec, Writing};
use camgen_kernel::{Program, Quantity, law};
use std::f64::consts::PI;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Up 20 mm in 90°, rest for 30°, down in 120°, rest.
    let (up, down) = (law("cycloidal")?, law("3-4-5")?);
    let segments = [
        (Some(up), PI / 2.0, 0.02),
        (None, PI / 6.0, 0.02),
        (Some(down), 2.0 * PI / 3.0, 0.0),
        (None, 2.0 * PI / 3.0, 0.0),
    ];
    let motion = Program::new(Quantity::Length, 0.0, &segments).map_err(Error::Solve)?;
    let cam = Spec::builder("lifter").roller(0.012).bore_radius(0.010).thickness(0.016).motion(motion)?.solve()?;
    let proven = cam.draw(5e-6)?.prove()?;
    for finding in proven.findings() {
        println!("{:<18} {:>10.4} {:<4} {:?}", finding.check, finding.value, finding.unit, finding.verdict);
    }
    // Refused with an error when a check has failed.
    let directory = std::env::temp_dir().join("camgen-disc");
    let writing = Writing { overwrite: true, ..Writing::to(directory, "lifter").formats(&["dxf", "step", "csv"]) };
    let report = proven.files(&writing)?.commit()?;
    println!("{}: {}", report.title(), report.files.join(", "));
    Ok(())
}
