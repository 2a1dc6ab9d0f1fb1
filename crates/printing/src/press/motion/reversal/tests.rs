//! Joints, refusals, lobes and exact ends of the motion of a press.

use super::*;
use crate::press::bed_motion::{End, Linkage, StrokeEnd};
use crate::press::buffer::bottom_law::ColumnRule;
use crate::press::buffer::crank_law::LinkageLaw;
use std::f64::consts::PI;

fn law(column: ColumnRule, lead: f64, transition: Transition) -> ReversalLaw {
    let bottom_law = BottomLaw::new(1.0 / 0.18, 1.35, 0.18, column, lead);
    ReversalLaw { bottom_law: bottom_law.into(), lever: 1.0, lobes: 1, transition }
}

/// Under any linkage, with any lead: no jump at any joint, and none of the slope where a run-up promises it; a retreat may meet the
/// law at an angle, as under a yoke.
#[test]
fn joints_are_smooth_under_any_linkage() {
    let mut mechanisms = crate::press::bed_motion::tests::Random(11);
    let mut early = 0;
    for round in 0..300_u32 {
        let (drag_link, slider) = mechanisms.six_bar();
        let linkage = if round % 3 == 0 { Linkage::CrankSlider(slider) } else { Linkage::SixBar(drag_link, slider) };
        let end = if round % 2 == 0 { End::Outer } else { End::Inner };
        let Some(end) = StrokeEnd::new(linkage, 0.18, end) else { continue };
        let lead = [0.0, 0.003, 0.02][round as usize % 3];
        early += u32::from(lead > 0.0 && end.overrun_at_end() < -lead);
        let loading = 1.0 / end.largest_deceleration().value;
        for transition in [Transition::None, Transition::RunUp { width: 0.1 }, Transition::Blend { width: 0.1 }] {
            let bottom_law = CrankLaw::Linkage(LinkageLaw::new(loading, 1.35, end, ColumnRule::Matched, lead));
            let law = ReversalLaw { bottom_law, lever: 1.0, lobes: 1, transition };
            let Ok(motion) = Reversal::new(law) else { continue };
            let pieces = motion.pieces();
            let mut jump = 0.0_f64;
            for i in 0..pieces.len() {
                let next = (i + 1) % pieces.len();
                let (a, b) = (motion.jet(i, pieces[i].end), motion.jet(next, pieces[next].start));
                if motion.follows_law(i) || motion.follows_law(next) {
                    jump = jump.max((a.ds - b.ds).abs());
                }
                assert!((a.s - b.s).abs() < 1e-13, "{linkage:?} {lead} {transition:?}: {a:?} {b:?}");
                if transition != Transition::None && lead == 0.0 {
                    assert!((a.ds - b.ds).abs() < 1e-12, "{linkage:?} {transition:?}: {a:?} {b:?}");
                }
            }
            let told = motion.velocity_jump().0.abs();
            assert!((told - jump).abs() < 1e-9, "{linkage:?} {lead} {transition:?}: {told} is not {jump}");
        }
    }
    assert!(early > 5, "{early} reversals end with the piston out of the column");
}

#[test]
fn the_run_up_costs_the_known_extra_lift() {
    for (degrees, drop) in [(20.0_f64, 0.0019), (30.0, 0.0043)] {
        let width = degrees.to_radians();
        let motion = Reversal::new(law(ColumnRule::Matched, 0.0, Transition::RunUp { width })).expect("fits");
        let dwell = motion.pieces().iter().position(|p| p.dwell).expect("a dwell");
        let level = motion.bottom(dwell, 4.0).s;
        assert!((level + drop).abs() < 5e-5, "{degrees}°: {level}");
    }
}

/// Value, slope and acceleration are continuous wherever the transition promises it.
#[test]
fn joints_are_smooth_with_a_run_up_and_with_a_blend() {
    let width = 0.3;
    for column in [ColumnRule::Matched, ColumnRule::Return, ColumnRule::Length(0.2)] {
        for transition in [Transition::RunUp { width }, Transition::Blend { width }] {
            let motion = Reversal::new(law(column, 0.0, transition)).expect("fits");
            let pieces = motion.pieces();
            for i in 0..pieces.len() {
                let next = (i + 1) % pieces.len();
                let (a, b) = (motion.jet(i, pieces[i].end), motion.jet(next, pieces[next].start));
                for (left, right) in [(a.s, b.s), (a.ds, b.ds), (a.dds, b.dds)] {
                    assert!((left - right).abs() < 1e-14, "{column:?} {transition:?}: {a:?} {b:?}");
                }
            }
        }
    }
}

#[test]
fn a_blend_costs_the_known_residual() {
    for (degrees, share) in [(15.0_f64, 0.0004), (30.0, 0.0021)] {
        let width = degrees.to_radians();
        let motion = Reversal::new(law(ColumnRule::Matched, 0.0, Transition::Blend { width })).expect("fits");
        let mut worst = 0.0_f64;
        for i in 0..=2000 {
            let (piece, angle) = motion.locate(width * f64::from(i) / 2000.0);
            let state = motion.state(piece, angle);
            worst = worst.max((state.overrun / 0.18 - (state.pressure_ratio - 1.0)).abs());
        }
        assert!((worst - share).abs() < 5e-5, "{degrees}°: {worst}");
    }
}

#[test]
fn what_does_not_fit_is_refused() {
    for lobes in [1, 2, 3] {
        let wide = ReversalLaw { lobes, ..law(ColumnRule::Matched, 0.0, Transition::RunUp { width: 1.6 }) };
        let error = Reversal::new(wide).expect_err("too wide");
        assert!(error.what.ends_with("deg of the crank, more than one turn"), "{lobes} lobes: {error}");
    }
    let what = |lead: f64, width: f64| {
        Reversal::new(law(ColumnRule::Matched, lead, Transition::Blend { width })).expect_err("refused").what
    };
    assert!(what(0.01, 0.3).starts_with("a lead needs the bottom to retreat before the reversal"));
    assert!(what(0.0, 3.2).ends_with("deg reaches past the middle of the reversal"));
    let full = law(ColumnRule::Matched, 0.0, Transition::RunUp { width: 0.5 * PI });
    let motion = Reversal::new(full).expect("transitions as long as the rest of the turn leave no dwell");
    assert!(motion.pieces().iter().all(|p| !p.dwell));
}

/// n lobes are the one lobe n times, each derivative as much larger: an independent look at the angle n θ.
#[test]
fn n_lobes_repeat_the_motion_of_one() {
    for transition in [Transition::None, Transition::RunUp { width: 0.35 }, Transition::Blend { width: 0.3 }] {
        let one = Reversal::new(law(ColumnRule::Matched, 0.0, transition)).expect("fits");
        for lobes in [2_u32, 3, 4, 7, 30] {
            let n = f64::from(lobes);
            let many = Reversal::new(ReversalLaw { lobes, ..*one.law() }).expect("fits");
            assert_eq!(many.pieces().len(), one.pieces().len() * lobes as usize);
            assert_eq!(many.lowest(), one.lowest());
            for i in 0..3600 {
                // Off the breaks, where either side is right.
                let angle = (f64::from(i) + 0.37) * TAU / 3600.0;
                let (piece, inside) = many.locate(angle);
                let (same, crank) = one.locate((n * angle) % TAU);
                let (found, known) = (many.jet(piece, inside), one.jet(same, crank));
                // n θ is rounded where θ is not: 2π n ε of crank angle, on jets whose next derivative is at most that
                // of a ramp's jerk, below 400 m/rad⁴.
                for (found, known) in [
                    (found.s, known.s),
                    (found.ds / n, known.ds),
                    (found.dds / (n * n), known.dds),
                    (found.ddds / (n * n * n), known.ddds),
                ] {
                    assert!((found - known).abs() < 2e-15 * n * 400.0, "{lobes} at {angle}: {found} {known}");
                }
                let (state, known) = (many.state(piece, inside), one.state(same, crank));
                assert!((state.crank - known.crank).abs() < 2e-15 * n * 4.0, "{state:?} {known:?}");
                assert!((state.overrun - known.overrun).abs() < 1e-15 * n);
            }
            for (index, piece) in many.pieces().iter().enumerate() {
                let of_one = index % one.pieces().len();
                for (at, by_one) in [(piece.start, one.pieces()[of_one].start), (piece.end, one.pieces()[of_one].end)] {
                    assert_eq!(many.bottom(index, at).s.to_bits(), one.bottom(of_one, by_one).s.to_bits(), "{lobes}");
                }
            }
        }
    }
}

#[test]
fn the_ends_of_the_reversal_are_exact() {
    let motion = Reversal::new(law(ColumnRule::Return, 0.0, Transition::None)).expect("fits");
    for degrees in [0.0_f64, 90.0, 180.0] {
        let (piece, angle) = motion.locate(degrees.to_radians());
        assert_eq!(motion.state(piece, angle).displacement, 0.0, "{degrees}°");
    }
    let with_lead = Reversal::new(law(ColumnRule::Matched, 0.02, Transition::RunUp { width: 0.3 })).expect("fits");
    let (piece, angle) = with_lead.locate(0.0);
    assert_eq!(with_lead.state(piece, angle).displacement, -0.02);
    let (piece, angle) = with_lead.locate(TAU - 0.02 / 0.18);
    assert!(with_lead.state(piece, angle).displacement.abs() < 1e-15, "the retreat starts at 0");
}

/// Under a crank and rod in line both ends of the reversal are alike: the jump is reported at its start.
#[test]
fn a_symmetric_motion_jumps_at_its_start() {
    let slider = crate::press::bed_motion::Slider { rod_ratio: 4.0, offset_ratio: 0.0 };
    for end in [End::Outer, End::Inner] {
        let end = StrokeEnd::new(Linkage::CrankSlider(slider), 0.18, end).expect("two reversals");
        let loading = 1.0 / end.largest_deceleration().value;
        let bottom_law = CrankLaw::Linkage(LinkageLaw::new(loading, 1.35, end, ColumnRule::Return, 0.0));
        let law = ReversalLaw { bottom_law, lever: 1.0, lobes: 1, transition: Transition::None };
        let (jump, at_end) = Reversal::new(law).expect("fits").velocity_jump();
        assert!(jump.abs() > 1e-3 && !at_end, "{jump} {at_end}");
    }
}
