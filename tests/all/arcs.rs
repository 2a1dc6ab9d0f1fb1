//! The outline as arcs where it degenerates, and against the least possible number of them.
//! Every line of the table is a worst case; `cargo test --test all arcs:: -- --nocapture`.

use crate::common::worst::Worst;
use camgen::domains::press::SpecOfPress;
use camgen::domains::press::rotary;
use camgen::follower::TranslatingRoller;
use camgen::geometry::{CurvePoint, arcs};
use camgen::machine::Machine;
use camgen::pipeline::Spec;
use camgen::profile::{Curves, extremes, outline};
use nalgebra::Vector2;

/// Arcs of radii from 1e-3 to 1e7 mm, almost straight ones, and half circles, to the tolerance or refused by name.
#[test]
fn arcs_of_every_radius() {
    let mut worst = Worst::new("arc fit of a circle, radius 1e-3…1e7 mm", "of the radius");
    for decade in -3..=7 {
        let radius = libm::pow(10.0, f64::from(decade));
        for sweep in [1e-4, 1e-3, 1.0, std::f64::consts::PI] {
            let circle = |t: f64| CurvePoint {
                point: Vector2::new(radius * libm::cos(t), radius * libm::sin(t)),
                tangent: Vector2::new(-libm::sin(t), libm::cos(t)),
                speed: radius,
                curvature: 1.0 / radius,
                curvature_slope: 0.0,
            };
            let chain = arcs::fit(circle, (0.0, sweep), 1e-9 * radius).expect("a chain");
            assert_eq!(chain.joints.len(), 1, "{radius} {sweep}");
            worst.see(chain.deviation / radius, || format!("radius {radius:e} mm, {sweep} rad"));
        }
    }
    worst.told(1e-15);
}

/// The default cam at tolerances from a millimetre to a picometre: kept, or refused by name.
#[test]
fn tolerances_over_nine_decades() {
    let machine = Machine::load("dpi", &[]).expect("valid").0;
    let rotary = rotary::disc(&machine, 35.0).expect("a cam");
    println!("{:>12} {:>8} {:>10} {:>14} {:>14}", "tolerance/mm", "arcs", "N*", "deviation/tol", "arcs·tol^(1/3)");
    for decade in -9..=0 {
        let tolerance = libm::pow(10.0, f64::from(decade));
        let drawn = outline::profile(rotary.curves(), 1e-3 * tolerance).expect("an outline");
        let count = drawn.contour.vertices.len();
        #[expect(clippy::cast_precision_loss, reason = "a few thousand arcs")]
        let scaled = count as f64 * libm::cbrt(tolerance);
        println!(
            "{tolerance:>12e} {count:>8} {:>10.1} {:>14.4} {scaled:>14.3}",
            drawn.best_possible,
            drawn.deviation / tolerance
        );
        assert!(drawn.deviation <= tolerance);
        if tolerance < 1e-6 {
            // SEEN alone costs 0.4 %.
            assert!(f64::from(u32::try_from(count).expect("few")) < 1.01 * drawn.best_possible, "{tolerance}: {count}");
        }
        let breaks = drawn.contour.tangent_breaks();
        assert!(breaks.iter().all(|turn| turn.abs() < 1e-9), "{tolerance}");
    }
    assert!(outline::profile(rotary.curves(), 1e-16).is_err());
}

/// Every smooth piece of six cams from 0.1 mm to 0.1 µm: at most ⌈N*⌉ + 2 arcs, and hardly ever more than ⌈N*⌉ + 1, what
/// an exact tangent at both ends costs.
#[test]
fn arcs_near_the_limit() {
    let mut more_than_best = std::collections::BTreeMap::new();
    for overrides in [
        "cam.lever=1",
        "buffer.column=return",
        "transition.kind=none",
        "transition.kind=blend",
        "follower.roller.offset=20mm",
        "cam.lever=0.3",
    ] {
        let machine = Machine::load("dpi", &[overrides.into()]).expect("valid").0;
        let cam = rotary::disc(&machine, 35.0).expect("a cam");
        for step in 0..=24 {
            let tolerance = 0.1 * libm::pow(10.0, -0.125 * f64::from(step));
            for (index, piece) in cam.curves().motion.pieces().iter().enumerate().filter(|(_, piece)| !piece.dwell) {
                let curve = |angle: f64| cam.curves().profile(index, angle).scaled(1e3);
                let chain = arcs::fit(curve, (piece.start, piece.end), tolerance).expect("a chain");
                #[expect(clippy::cast_possible_truncation, reason = "a few hundred arcs")]
                let more = i32::try_from(chain.joints.len()).expect("few") - chain.best_possible.ceil() as i32;
                assert!(more <= 2, "{overrides} at {tolerance:e} mm: {more} more than {}", chain.best_possible);
                assert!(chain.deviation <= tolerance);
                *more_than_best.entry(more).or_insert(0) += 1;
            }
        }
    }
    println!("arcs beyond N* rounded up: pieces {more_than_best:?}");
    assert!(more_than_best.get(&2).is_none_or(|pieces| 10 * pieces <= more_than_best.values().sum::<i32>()));
}

/// Where the profile almost has a cusp, where a transition almost vanishes, where the cam is as large as a drawing can be:
/// an outline that keeps its tolerance and on which the roller rolls, or an error that says why.
#[test]
fn cams_at_the_edge() {
    let solve = |overrides: &[String]| {
        let machine = Machine::load("dpi", overrides).expect("valid").0;
        rotary::disc(&machine, 35.0)
    };
    let base = solve(&["cam.base_radius=90mm".into()]).expect("a cam");
    let prime = base.prime_radius();
    let sharpest = 1.0 / extremes::convex_curvature(base.curves()).value;
    let ulp_less = f64::from_bits(sharpest.to_bits() - 1);
    for (roller, what) in
        [(ulp_less, "an ulp below"), (sharpest * (1.0 - 1e-9), "1e-9 below"), (sharpest * 1.01, "1 % above")]
    {
        let follower = TranslatingRoller::new(prime, 0.0, roller);
        let curves = Curves { motion: base.curves().motion, follower: &follower };
        let result = outline::profile(curves, 5e-6);
        println!(
            "roller {what} the sharpest radius: {}",
            match &result {
                Ok(outline) => format!("{} arcs, {:.2e} mm off", outline.contour.vertices.len(), outline.deviation),
                Err(error) => error.to_string(),
            }
        );
        if let Ok(outline) = result {
            assert!(outline.deviation <= 0.005 && curves.offset() == roller);
        }
    }
    let spec = |overrides: &[String]| Spec::rotary(Machine::load("dpi", overrides).expect("valid").0, 35.0);
    for width in ["1e-9 deg", "2e-7 deg", "1e-6 deg", "1e-5 deg", "1e-3 deg", "1 deg", "90 deg"] {
        let cam = spec(&[format!("transition.width={width}")]).solve().expect("a cam");
        let proven = cam.draw(5e-6).and_then(camgen::pipeline::Drawing::prove).expect("a proof");
        match (proven.rolled(), proven.no_outline()) {
            (Some(rolled), _) => {
                let arcs = proven.outlines()[0].contour.vertices.len();
                println!("transition {width}: {arcs} arcs, gap {:.2e} mm", rolled.gap_mm);
                assert!(rolled.gap_mm.abs() <= 0.005, "{width}: {}", rolled.gap_mm);
            }
            // A wall of the cam, not of the fit.
            (None, why) => assert!(why.is_some_and(|why| why.contains("folds over itself")), "{width}: {why:?}"),
        }
    }
    for radius in ["1 um", "1000 mm", "100 m", "999 m", "1000 m"] {
        let cam = spec(&[format!("cam.base_radius={radius}"), "cam.bore_radius=0.5um".into()]).solve().expect("a cam");
        let drawn = cam.draw(5e-6);
        let part = drawn.as_ref().ok().and_then(|drawing| drawing.drawn()).map(|drawn| &drawn.parts[0].outline);
        if let Some(outline) = part {
            let arcs = outline.contour.vertices.len();
            println!("base radius {radius}: {arcs} arcs, {:.2e} mm off", outline.deviation);
        } else {
            println!("base radius {radius}: {:?}", drawn.map(|_| "no outline"));
            // No room for the lift, and no room on a drawing: nothing else is a wall.
            assert!(["1 um", "1000 m"].contains(&radius), "{radius} is drawn");
        }
        assert!(camgen::body::curves(cam.body()).expect("a disc").motion.pieces().len() > 3);
    }
}
