//! Errors of manufacture as keys of a machine file: what a press leaves, and what is refused.

use crate::common::program::{close, number_of, report, run};

fn residual(keys: &[&str]) -> f64 {
    let mut words = vec!["rotary", "--dry-run", "--json"];
    words.extend(keys.iter().flat_map(|key| ["--set", key]));
    number_of(&report(&run(0, &words))["as_made"], "residual_max_n")
}

/// The largest residual forces are those of `scatter` at the end of the stroke: 1 % of speed, 3 % of the pressure, a bottom 1 µm off. The
/// forces balance where both grow alike. A place is missed by less than (π/1440)²/2 of them.
#[test]
fn a_press_leaves_what_scatter_tells() {
    close(residual(&["as_made.speed=1%"]), 427.889_919_4, 1e-4);
    close(residual(&["as_made.load=-3%"]), 638.641_670_7, 1e-4);
    let balanced = residual(&["as_made.speed=1%", "as_made.load=2.01%"]);
    assert!(balanced < 1e-6 * 21_288.0, "{balanced}");
    // 395256.1811 N/m at the dead point of the bed, where the path is along the normal; before it a roller is moved by up to 1/cos 30°.
    let of_roller = residual(&["as_made.roller_radius=1um"]);
    assert!((0.395_256..0.395_257 / 30.0_f64.to_radians().cos()).contains(&of_roller), "{of_roller}");
}

#[test]
fn what_has_no_meaning_is_refused() {
    let refused = |words: &[&str], why: &str| {
        let found = run(2, words);
        assert!(found.err.contains(why), "{words:?}: {}", found.err);
    };
    refused(&["make", "groove", "--set", "as_made.wear=5um"], "this is a groove");
    refused(&["make", "valve", "--set", "as_made.roller_radius=5um"], "no roller");
    refused(&["make", "feeder", "--set", "as_made.waves_from=60"], "larger than the largest");
    refused(&["make", "feeder", "--set", "as_made.waves_to=20.5"], "a whole number");
    refused(&["make", "feeder", "--set", "as_made.eccentricity=2mm"], "at most 1 mm");
}
