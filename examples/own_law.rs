//! A motion of one's own: a lift of two harmonics over the whole turn, `cargo run --example own_law`.

#![allow(clippy::print_stdout, reason = "an example shows what it found")]

use camgen::{Jet, Motion, Piece, Spec, Writing};
use std::f64::consts::TAU;

/// s = h [1 − cos θ − (cos 2θ − 1)/8]/2: smooth everywhere, so one piece.
#[derive(Debug)]
struct TwoHarmonics {
    lift: f64,
}

const TURN: [Piece; 1] = [Piece { start: 0.0, end: TAU, dwell: false }];

impl Motion for TwoHarmonics {
    fn pieces(&self) -> &[Piece] {
        &TURN
    }

    fn jet(&self, _piece: usize, angle: f64) -> Jet {
        let ((sin, cos), (sin2, cos2)) = (angle.sin_cos(), (2.0 * angle).sin_cos());
        Jet { s: 1.0 - cos - (cos2 - 1.0) / 8.0, ds: sin + sin2 / 4.0, dds: cos + cos2 / 2.0, ddds: -sin - sin2 }
            .scaled(0.5 * self.lift)
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let spec = Spec::builder("two harmonics")
        .roller(0.012)
        .bore_radius(0.010)
        .thickness(0.015)
        .pressure_angle(25.0_f64.to_radians())
        .motion(TwoHarmonics { lift: 0.020 })?;
    let cam = spec.solve()?;
    let proven = cam.draw(2e-6)?.prove()?;
    let writing = Writing::to(std::env::temp_dir().join("camgen-own-law"), "two-harmonics");
    // A directory of this example alone: what another run has left in it may go.
    let files = proven.files(&Writing { overwrite: true, ..writing })?;
    let report = files.commit()?;
    println!("{}", serde_json::to_string_pretty(&report)?);
    Ok(())
}
