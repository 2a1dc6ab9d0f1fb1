//! A thousand cams in memory: which roller gives the smallest cam? `cargo run --release --example thousand_cams`, or with
//! another number behind it.

#![allow(clippy::print_stdout, reason = "an example shows what it found")]

use camgen::{Machine, Spec, SpecOfPress};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let count: u32 = std::env::args().nth(1).map_or(Ok(1000), |count| count.parse())?;
    let mut best: Option<(f64, f64)> = None;
    let mut refused = 0;
    for i in 0..count {
        let radius_mm = 10.0 + 40.0 * f64::from(i) / f64::from(count);
        let (machine, _) = Machine::load("dpi", &[format!("follower.roller.radius={radius_mm}mm")])?;
        let cam = Spec::rotary(machine, 35.0).solve()?;
        let proven = cam.draw(20e-6)?.prove()?;
        if !proven.passed() {
            refused += 1;
            continue;
        }
        let area =
            proven.drawn().and_then(|drawn| drawn.parts.first()).map_or(f64::NAN, |part| part.area_and_moment().0);
        if best.is_none_or(|(least, _)| area < least) {
            best = Some((area, radius_mm));
        }
    }
    let (area, radius) = best.ok_or("every cam was refused")?;
    println!("{count} cams, {refused} refused; the smallest has {area:.0} mm² with a roller of {radius:.2} mm");
    Ok(())
}
