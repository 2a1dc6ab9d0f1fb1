//! Any machine in range gives a cam that keeps its promises, or an error that names the wall; never a NaN, never a panic.

use camgen::Refusal;
use camgen::domains::press::rotary;
use camgen::geometry::solid;
use camgen::machine::Machine;
use camgen::pipeline::Spec;
use camgen::profile::envelope;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// Log-uniform between two powers of ten.
fn decades(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low..high).prop_map(|power| 10_f64.powf(power))
}

fn overrides() -> impl Strategy<Value = Vec<String>> {
    let column = prop_oneof![
        Just("matched".to_owned()),
        Just("return".to_owned()),
        (50.0..2000.0_f64).prop_map(|length| format!("{length}mm")),
    ];
    let transition = prop_oneof![Just("none"), Just("run-up"), Just("blend")];
    (
        (decades(-4.0, 2.0), 1.0..2.0_f64, column, decades(-1.0, 3.0), decades(0.0, 3.0)),
        (transition, 0.01..89.0_f64, -0.9..0.9_f64, decades(-1.5, 1.0), 1..=8_u32),
    )
        .prop_map(|((excess, k, column, roller, radius), (kind, width, offset, lever, lobes))| {
            vec![
                format!("buffer.end_pressure={} at", 1.0 + excess),
                format!("buffer.polytropic_exponent={k}"),
                format!("buffer.column={column}"),
                format!("follower.roller.radius={roller}mm"),
                format!("follower.roller.offset={}mm", offset * roller),
                format!("bed.crank_radius={radius}mm"),
                format!("transition.kind={kind}"),
                format!("transition.width={width}deg"),
                format!("cam.lever={lever}"),
                format!("cam.cam_turns_per_crank_turn={}", 1.0 / f64::from(lobes)),
            ]
        })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, rng_seed: RngSeed::Fixed(1), ..ProptestConfig::default() })]

    #[test]
    fn any_machine_gives_a_true_cam_or_a_named_wall(overrides in overrides(), rpm in 5.0..100.0_f64) {
        let machine = Machine::load("dpi", &overrides).expect("in range").0;
        let Ok(disc) = rotary::disc(&machine, rpm) else { return Ok(()) };
        let max_lift = disc.max_lift();
        let cam = Spec::new(machine, move |_| Ok::<_, Refusal>(disc)).solve().expect("solved before");
        let curves = camgen::body::curves(cam.body()).expect("a disc");
        for (index, piece) in curves.motion.pieces().iter().enumerate() {
            for step in 0..=20 {
                let angle = piece.start + (piece.end - piece.start) * f64::from(step) / 20.0;
                let contact = curves.contact(index, angle);
                prop_assert!(contact.lift.s.is_finite() && contact.pressure_angle.is_finite(), "{contact:?}");
                prop_assert!(contact.lift.s >= -1e-12 * max_lift, "{contact:?}");
            }
        }
        let tolerance = 1e-5;
        let proven = match cam.draw(tolerance) {
            Ok(drawing) => drawing.prove().map_err(|error| TestCaseError::fail(error.to_string()))?,
            Err(error) => {
                prop_assert!(!error.to_string().contains("NaN"), "{error}");
                return Ok(());
            }
        };
        if let Some(drawn) = proven.drawn() {
            let part = &drawn.parts[0];
            let contour = &part.outline.contour;
            prop_assert!(part.outline.deviation <= 1e3 * tolerance);
            // About a corner of its path a roller turns by an arc, which is left out where readers would drop it, below 1e-5 mm.
            let seen = (1e-5 / (1e3 * curves.offset())).max(1e-6);
            let kinks: Vec<f64> = contour.tangent_breaks().into_iter().filter(|turn| turn.abs() > seen).collect();
            let losses = envelope::losses(curves).expect("drawn, so they were found");
            // An undercut leaves an edge for each loop, outwards; nothing else has a kink.
            prop_assert!(kinks.len() <= losses.len() && kinks.iter().all(|turn| *turn > 0.0), "{kinks:?} {losses:?}");
            let body = part.solid(30.0).map_err(|error| TestCaseError::fail(error.to_string()))?;
            // An arc so flat that its radius is a thousand kilometres has a centre known to a nanometre: the
            // uncertainty the STEP file states.
            prop_assert!(solid::largest_gap(&body.boundary) <= 1e-6, "{}", solid::largest_gap(&body.boundary));
            let (outline, rolled) = (&proven.outlines()[0].contour, proven.rolled().expect("a plane cam is rolled on"));
            // Coordinates have twelve decimals and 52 bits.
            let rounding = 2e-12 + 1e-14 * outline.extents().size().max();
            if losses.is_empty() {
                prop_assert!(rolled.gap_mm.abs() <= 1e3 * tolerance + rounding, "{rolled:?}");
                prop_assert!(rolled.chord_difference_mm <= rolled.chord_sagitta_mm + rounding, "{rolled:?}");
            } else {
                prop_assert!(rolled.gap_mm >= -1e3 * tolerance - rounding, "no metal is in the way: {rolled:?}");
            }
            prop_assert!(contour.area_and_centroid().0 > 0.0);
            prop_assert!(contour.vertices.iter().all(|v| v.point.iter().all(|c| c.is_finite()) && v.bulge().is_some_and(f64::is_finite)));
        } else {
            let why = proven.no_outline().unwrap_or_default();
            prop_assert!(!why.is_empty() && !why.contains("NaN"), "{why}");
        }
    }
}
