//! A cam that turns once in n turns of the crank carries n equal lobes and stands right at every reversal.

use camgen::domains::press::SpecOfPress;
use camgen::machine::Machine;
use camgen::pipeline::{Cam, Spec};
use camgen::report::{Verdict, passed};
use camgen::table::Table;
use std::f64::consts::TAU;

const SAMPLES: u32 = 720;

fn cam(turns: &str, overrides: &[&str]) -> Cam {
    let mut all = vec![format!("cam.cam_turns_per_crank_turn={turns}")];
    all.extend(overrides.iter().map(|&text| text.to_owned()));
    let machine = Machine::load("dpi", &all).expect("valid").0;
    Spec::rotary(machine, 35.0).solve().expect("a cam")
}

fn column(table: &Table, name: &str) -> Vec<f64> {
    let index = table.columns.iter().position(|column| *column == name).expect("a column");
    table.rows.iter().map(|row| row[index]).collect()
}

/// Lift, bed and bottom of n lobes at θ are those of one lobe at the crank angle n θ, row by row; both from the tables.
#[test]
fn the_rows_are_those_of_one_lobe_at_n_times_the_angle() {
    for overrides in [&[][..], &["buffer.column=return", "transition.kind=none"], &["buffer.lead=5mm"]] {
        let one = Table::from_rows(&cam("1", overrides).body().rows(SAMPLES));
        for (turns, lobes) in [("0.5", 2_usize), ("0.3333", 3), ("0.25", 4)] {
            let many = Table::from_rows(&cam(turns, overrides).body().rows(SAMPLES));
            for name in ["crank_deg", "x_mm", "dx_mm", "lift_mm"] {
                let (found, known) = (column(&many, name), column(&one, name));
                for (index, value) in found.iter().enumerate() {
                    let same = known[index * lobes % known.len()];
                    // Millimetres and degrees: a few roundings of an angle times n on 180 mm a radian.
                    assert!((value - same).abs() < 1e-11, "{overrides:?} {turns}, {name}, row {index}: {value} {same}");
                }
            }
            // By the cam angle the motion is n times as steep.
            let n = f64::from(u32::try_from(lobes).expect("few"));
            let (found, known) = (column(&many, "velocity_mm_per_rad"), column(&one, "velocity_mm_per_rad"));
            for (index, value) in found.iter().enumerate() {
                let same = n * known[index * lobes % known.len()];
                assert!((value - same).abs() < 1e-9, "{turns}, row {index}: {value} {same}");
            }
        }
    }
}

/// The outline is the same after a turn by 2π/n, every check passes, worst places lie in the first lobe, and nothing is left
/// to balance.
#[test]
fn n_lobes_are_a_cam() {
    for (turns, lobes) in [("0.5", 2_u32), ("0.3333", 3), ("0.25", 4)] {
        let cam = cam(turns, &["follower.roller.offset=8mm", "cam.rotation=ccw"]);
        let motion = camgen::body::curves(cam.body()).expect("a disc").motion;
        assert_eq!(motion.lobes(), lobes);
        let proven = cam.draw(5e-6).expect("drawn").prove().expect("proved");
        assert!(passed(proven.findings()), "{turns}: {:?}", proven.findings());
        let first_lobe = motion.distinct();
        let (start, end) = (first_lobe[0].start, first_lobe[first_lobe.len() - 1].end);
        for finding in proven.findings().iter().filter(|f| ["pressure_angle", "undercut"].contains(&&*f.check)) {
            let at = finding.place.cam_deg.expect("a place").to_radians();
            let inside = |at: f64| (start - 1e-9..=end + 1e-9).contains(&at);
            assert!(inside(at) || inside(at - TAU), "{finding:?} in {start} to {end}");
        }
        let part = &proven.drawn().expect("a drawing").parts[0];
        let (area, moment) = part.area_and_moment();
        // Each lobe is fitted by itself: they differ by the rounding of the fit.
        assert!(moment.norm() < 1e-6 * area, "{turns}: {moment} of {area}");
        assert!(
            cam.body()
                .sections(&camgen::body::DrawingEvidence { drawn: None, rolled: &[], tolerance_mm: 5e-3, wanted: None })
                .iter()
                .any(|section| section.key == "cam"
                    && section.value.get("lobes").and_then(serde_json::Value::as_u64) == Some(u64::from(lobes)))
        );
    }
    let conoid = |turns: &str| {
        let machine = Machine::load("dpi", &[format!("cam.cam_turns_per_crank_turn={turns}")]).expect("valid").0;
        Spec::conoid(machine, vec![20.0, 35.0], None).solve().expect("a conoid")
    };
    let solved = conoid("0.5");
    let proven = solved.draw(5e-6).expect("drawn").prove().expect("proved");
    let fails = proven.findings().iter().filter(|finding| finding.verdict == Verdict::Fail).count();
    assert_eq!(fails, 0, "{:?}", proven.findings());
    let lift = |turns: &str| column(&Table::from_rows(&conoid(turns).body().rows(SAMPLES)), "lift_mm");
    let (one, two) = (lift("1"), lift("0.5"));
    for (index, value) in two.iter().enumerate() {
        let section = index / SAMPLES as usize * SAMPLES as usize;
        assert!((value - one[section + 2 * (index - section) % SAMPLES as usize]).abs() < 1e-11, "row {index}");
    }
}

/// All else would be in the wrong position at the next reversal.
#[test]
fn other_ratios_are_refused() {
    for turns in ["0.8", "2", "1.0002", "0.33", "0.333", "0.9", "3", "0.009", "1e-9"] {
        let error =
            Machine::load("dpi", &[format!("cam.cam_turns_per_crank_turn={turns}")]).expect_err(turns).to_string();
        assert!(error.contains("be in the wrong position at the next reversal") && error.contains("1/n"), "{error}");
    }
    for (turns, lobes) in [("1", 1), ("0.99995", 1), ("0.3333", 3), ("0.33333333", 3), ("0.142857", 7), ("0.01", 100)] {
        let wide = cam(turns, &["limits.pressure_angle=80deg"]);
        assert_eq!(camgen::body::curves(wide.body()).expect("a disc").motion.lobes(), lobes);
    }
}
