//! Barrels sized by `camgen make`: flanks that would fold at the floor, and developed views with curves ahead of the cam angle.

use crate::common::program::{finding, make, report};

const NEAR_RATIO_1: [&str; 2] =
    [include_str!("barrel_designs/near_ratio_1.toml"), include_str!("barrel_designs/near_ratio_2.toml")];
const FOLDS: [&str; 2] = [include_str!("barrel_designs/folds.toml"), include_str!("barrel_designs/steep.toml")];

/// With an arm about as long as its pivot distance the flanks do not advance at the rate of the cam angle; the distance from the exact curve is
/// still found.
#[test]
fn a_developed_view_of_an_arm_near_ratio_1_passes() {
    for text in NEAR_RATIO_1 {
        let report = report(&make(text, &["--dry-run", "--json"]));
        let found = finding(&report, "unrolled");
        assert!(found["verdict"] == "pass" && found["value"].as_f64().is_some_and(|value| value < 0.0045), "{found}");
    }
}

/// At a pressure angle a flank meets the floor nearer to the shaft than the roller's axis does and folds there first; `auto` gives a size at which no
/// check of the flanks fails.
#[test]
fn a_flank_that_folds_at_the_floor_is_undercut_and_auto_avoids_it() {
    for (text, outer) in FOLDS.iter().zip(["29 mm", "38 mm"]) {
        let sized = make(text, &["--dry-run", "--json"]);
        assert_eq!(sized.code, 0, "{}{}", sized.out, sized.err);
        let small = report(&make(text, &["--dry-run", "--json", "--set", &format!("cam.outer_radius={outer}")]));
        assert_eq!(finding(&small, "undercut")["verdict"], "fail", "{outer}");
    }
}
