//! Outlines of the discs of a press.

use crate::press::{MachineOfPress, rotary};
use camgen_cams::body::disc::Disc;
use camgen_cams::machine::Machine;
use camgen_cams::verify::rolling;
use camgen_kernel::follower::{FlatFace, TranslatingRoller};
use camgen_kernel::motion::EccentricCircle;
use camgen_kernel::profile::outline::{Fit, OutlineError, Side, profile};
use camgen_kernel::profile::{Curves, envelope};

fn disc(overrides: &[&str]) -> Disc {
    let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
    let machine = Machine::load("dpi", &overrides).expect("valid").0;
    rotary::disc(&machine, machine.press().expect("a press").design_rpm).expect("a cam")
}

#[test]
fn an_eccentric_circle_is_two_half_circles() {
    let (e, rho, roller) = (0.012, 0.06, 0.015);
    let curves =
        Curves { motion: &EccentricCircle::new(e, rho), follower: &TranslatingRoller::new(rho - e, 0.0, roller) };
    let outline = profile(curves, 5e-6).expect("an outline");
    assert_eq!(outline.contour.vertices.len(), 2);
    assert!(outline.deviation < 1e-12, "{}", outline.deviation);
    for segment in outline.contour.segments().expect("arcs") {
        assert!((segment.radius() - 45.0).abs() < 1e-12);
        assert!((segment.bulge - 1.0).abs() < 1e-12);
    }
}

/// Over the tolerances of the issue: arcs against the limit, tangency, and the deviation that was promised.
#[test]
fn the_reference_outline_is_short_smooth_and_true() {
    for overrides in [vec![], vec!["buffer.column=return"], vec!["follower.roller.offset=20mm"]] {
        let cam = disc(&overrides);
        for tolerance in [0.1, 0.01, 0.005, 1e-3, 1e-4, 5e-5] {
            let outline = profile(cam.curves(), 1e-3 * tolerance).expect("an outline");
            let breaks = outline.contour.tangent_breaks();
            assert!(outline.deviation <= tolerance);
            assert!(breaks.iter().all(|turn| turn.abs() < 1e-9), "{breaks:?}");
            assert!(outline.contour.area_and_centroid().0 > 0.0);
            #[expect(clippy::cast_precision_loss, reason = "small")]
            let arcs = outline.contour.vertices.len() as f64;
            let limit = outline.best_possible;
            // Three smooth pieces and a dwell: each smooth piece may round up and take two arcs more.
            assert!(arcs <= limit + 10.0, "{tolerance}: {arcs} arcs, N* {limit:.2}");
        }
    }
}

#[test]
fn a_concave_corner_is_an_arc_of_the_roller_and_a_convex_one_undercut() {
    let cam = disc(&["buffer.column=return", "transition.kind=none"]);
    let outline = profile(cam.curves(), 5e-6).expect("an outline");
    let of_roller =
        outline.contour.segments().expect("arcs").iter().filter(|s| (s.radius() + 30.0).abs() < 1e-9).count();
    assert_eq!(of_roller, 2);
    assert!(outline.contour.tangent_breaks().iter().all(|turn| turn.abs() < 1e-9));
    // The loop is left out: one edge a side, and the roller dropped onto it nowhere meets more metal than the law.
    for overrides in [
        vec!["buffer.column=200mm", "transition.kind=none"],
        vec!["cam.base_radius=30mm", "follower.roller.radius=80mm"],
    ] {
        let cam = disc(&overrides);
        let outline = profile(cam.curves(), 5e-6).expect("an outline");
        let edges: Vec<f64> = outline.contour.tangent_breaks().into_iter().filter(|turn| turn.abs() > 1e-9).collect();
        assert_eq!(edges.len(), 2, "{overrides:?}: {edges:?}");
        assert!(edges.iter().all(|turn| *turn > 0.0), "{edges:?}");
        let losses = envelope::losses(cam.curves()).expect("loops");
        let rolled = rolling::roll(&cam, (cam.curves(), &[false]), &outline.contour, 0.005);
        assert!((rolled.gap_mm - 1e3 * losses[0].lost).abs() < 0.3 * rolled.gap_mm, "{rolled:?} {losses:?}");
        let lift = rolled.lift_error_max_mm.expect("it touches");
        let lost = losses.iter().map(|l| 1e3 * l.lost).fold(0.0, f64::max);
        assert!((lift - lost).abs() < 0.006, "{lift} {lost}");
    }
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    // A face on a cam smaller than its law requires turns back over half of it.
    let wave = EccentricCircle::new(0.1, 0.01);
    let swallowed = Curves { motion: &wave, follower: &FlatFace::new(1e-3) };
    assert!(matches!(profile(swallowed, 0.005), Err(OutlineError::Undercut(_))), "{:?}", profile(swallowed, 0.005));
    let huge = disc(&["cam.base_radius=1000m"]);
    let error = profile(huge.curves(), 0.005).expect_err("too large").to_string();
    assert!(error.starts_with("the cam would reach 1000") && error.contains("the largest coordinate"), "{error}");
    let cam = disc(&[]);
    assert!(matches!(profile(cam.curves(), 1e-16), Err(OutlineError::Part { .. })));
}

/// At a concave corner the roller turns in place, its centre in that of the arc: the distance from there is the radius, whatever
/// the direction rounding gives the nearest point.
#[test]
fn a_roller_in_a_corner_of_its_own_radius_touches_it() {
    for (offset, lead) in [(-28.9924, 7.0), (-28.9924, 3.0), (11.37, 7.0), (0.0, 1.234), (25.0, 12.5)] {
        let cam = disc(&[&format!("follower.roller.offset={offset}mm"), &format!("buffer.lead={lead}mm")]);
        let outline = profile(cam.curves(), 5e-10).expect("an outline");
        let rolled = rolling::roll(&cam, (cam.curves(), &[false]), &outline.contour, 5e-7);
        assert!(rolled.gap_mm.abs() <= 5e-7, "{offset} {lead}: {rolled:?}");
    }
}

/// Outside of an edge that hardly turns the arc about it would be too short for a reader.
#[test]
fn no_arc_about_an_edge_is_too_short_to_be_read() {
    for beyond in [1e-11, 1e-8, 1e-5, 1e-2] {
        let roller = 66.523_885_130_629_4 + beyond;
        let cam =
            disc(&[&format!("follower.roller.radius={roller}mm"), &format!("cam.base_radius={}mm", 99.0 - roller)]);
        let outline = profile(cam.curves(), Fit { side: Side::Outside, ..Fit::from(1.4e-7) }).expect("an outline");
        let shortest = outline.contour.edges().map(|edge| edge.length()).fold(f64::INFINITY, f64::min);
        assert!(shortest > 5e-6, "{beyond}: {shortest:e}");
    }
}
