//! Programs in words of a letter and a number: LinuxCNC, FANUC, SINUMERIK.

use super::dialect::{
    behind_its_number, behind_its_start, dialect, has_word, in_common_words, is_nothing, moves_the_profile, not_aborted,
};
use super::machine_state::MachineState;
use super::modal::{ModalWords, Situation, are_known, dwells, is_harmless, leaves, passed_over};
use super::words::{Word, at_line, counted, of, with_plain_codes, without_comments, words};
use super::{CutterProgram, CutterSide, MoveKind, NO_MOVE, RADII, ToolLength};
use crate::machine::Controller;
use camgen_kernel::refusal::Refusal;
use nalgebra::Vector2;

/// Reads a program; where its head does not say for which control it is, for that of its design.
pub(super) fn read(text: &str, design: Option<Controller>) -> Result<CutterProgram, Refusal> {
    let control = dialect(text, design);
    let (mut state, mut modal) = (MachineState::of(control), ModalWords::of(control, false));
    // FANUC reads nothing before the first `%`.
    let read = if control == Some(Controller::Fanuc) { behind_its_start(text) } else { text };
    let before = text.lines().count() - read.lines().count();
    for (index, whole) in read.lines().enumerate() {
        let line = before + index + 1;
        if modal.ended {
            continue;
        }
        not_aborted(line, whole, control)?;
        let block = without_comments(whole, control).ok_or_else(|| at_line(line, "a comment does not end"))?;
        let plain = with_plain_codes(block.trim());
        let typed = plain.as_str();
        path_mode_may_change(line, typed, (&state, control))?;
        state.path_mode.block(line, typed, control, modal.scale())?;
        state.readiness.path_mode(&state.path_mode);
        let block = in_common_words(typed, control);
        let block = block.as_str();
        if block.is_empty() || (block == "%" && !modal.begun) {
            continue;
        }
        if block == "%" {
            return Err(at_line(line, "`%` ends the program for the control, before M2 or M30"));
        }
        modal.begun = true;
        if let Some(skipped) = behind_its_number(block).strip_prefix('/') {
            may_be_skipped(line, skipped)?;
            continue;
        }
        if let Some(what) = moves_the_profile(block, control) {
            return Err(at_line(line, format!("the program {what}, and is then not the profile that it says")));
        }
        if is_nothing(block, control) {
            state.readiness.frames(block);
            continue;
        }
        if control == Some(Controller::Fanuc) {
            counted(line, block, modal.units())?;
        }
        let of_parameter = |word: &Word| word.0 == 'R' && control == Some(Controller::Sinumerik);
        if words(typed).is_some_and(|words| words.iter().any(of_parameter)) {
            let what = format!("R is a variable for SINUMERIK, not the radius of an arc: `{typed}`");
            return Err(at_line(line, what).remedy("write CR=5 for a radius of 5"));
        }
        match words(block) {
            Some(words) if are_known(&words, None) => run(line, &words, &mut state, &mut modal)?,
            found => {
                let of_machine =
                    found.as_ref().is_some_and(|words| words.iter().all(|(letter, _)| "NM".contains(*letter)));
                state.unknown(line, typed, of_machine)?;
                passed_over(line, block, control)?;
                // Datums such as G54.1 P1.
                state.readiness.block(&found.unwrap_or_default());
            }
        }
    }
    if modal.ended { state.program(control) } else { Err(Refusal::new("the program has no end (M2 or M30)")) }
}

/// Refuses another path mode while LinuxCNC keeps the cutter beside its path: it stops there.
fn path_mode_may_change(
    line: usize,
    block: &str,
    (state, control): (&MachineState, Option<Controller>),
) -> Result<(), Refusal> {
    let upper = block.to_ascii_uppercase();
    let changes = ["G61", "G61.1", "G64"].iter().any(|word| has_word(&upper, word));
    if changes && control == Some(Controller::LinuxCnc) && state.side != CutterSide::Centre {
        let what = "LinuxCNC stops at another path mode (G61, G64) while the cutter is kept beside its path";
        return Err(at_line(line, what).remedy("write it before G41 or G42"));
    }
    Ok(())
}

/// A block behind `/`, which the operator may leave out: only one that changes nothing of the cut may be there.
fn may_be_skipped(line: usize, block: &str) -> Result<(), Refusal> {
    let number = |c: char| c.is_ascii_digit();
    if words(block.trim_start_matches(number)).is_some_and(|words| is_harmless(&words)) {
        return Ok(());
    }
    let what = "a block that can be skipped (/) may run or not, and changes the cut";
    Err(at_line(line, what).remedy("remove the `/`, or the block"))
}

/// A block that goes to a place of the machine, such as `G91 G28 Z0`: only upwards, or with the cutter above the part.
fn to_the_machine(line: usize, words: &[Word], state: &mut MachineState) -> Result<(), Refusal> {
    let axes = ['X', 'Y', 'Z'].map(|axis| words.iter().any(|(letter, _)| *letter == axis));
    let knows_height = state.knows_height();
    state.readiness.leaves_by(line, (axes, words), knows_height);
    if state.side != CutterSide::Centre {
        return Err(at_line(line, "the cutter leaves for a place of the machine while it is kept beside its path"));
    }
    state.leave(line, axes)
}

/// Does what a block says: first what is modal, then its move.
fn run(line: usize, words: &[Word], state: &mut MachineState, modal: &mut ModalWords) -> Result<(), Refusal> {
    let is = |code: &f64| words.contains(&('G', *code));
    let leaves = leaves(words);
    // From below the face it leaves upwards alone, and is then above it.
    let is_deep = state.is_deep() && !leaves;
    modal.block(line, words, Situation { has_moved: state.has_moved(), is_deep })?;
    state.readiness.block(words);
    if leaves {
        to_the_machine(line, words, state)?;
    }
    (state.feed, state.side, state.cutting) = (modal.feed_mm(), modal.side, modal.cutting());
    if leaves {
        if let Some(z) = of(line, words, 'Z')?.filter(|_| words.contains(&('G', 53.0))) {
            state.retracts_to(line, modal.scale() * z);
            // On SINUMERIK the place of the machine counts with the length, unless D0.
            if modal.control == Some(Controller::Sinumerik) && state.cutting.length != ToolLength::Cancelled {
                state.moves_with_its_length(line);
            }
        }
        return Ok(());
    }
    if dwells(words) {
        return Ok(());
    }
    let of = |letter: char| of(line, words, letter).map(|number| number.map(|number| modal.scale() * number));
    let to = [of('X')?, of('Y')?, of('Z')?];
    let (i, j) = (of('I')?, of('J')?);
    // On a SINUMERIK these shift the datum by the coordinates that follow.
    if modal.control == Some(Controller::Sinumerik) && to != [None; 3] && (is(&58.0) || is(&59.0)) {
        return Err(at_line(line, "G58 and G59 with coordinates move the datum"));
    }
    let radius = of('R')?;
    if to == [None; 3] && i.is_none() && j.is_none() && radius.is_none() {
        return Ok(());
    }
    modal.is_stated(line)?;
    let kind = match (modal.motion, state.place()) {
        (Some(0), _) => MoveKind::Rapid,
        (Some(1), _) => MoveKind::Line,
        (Some(2 | 3), _) if radius.is_some() && (i.is_some() || j.is_some()) => {
            return Err(at_line(line, "an arc has a radius (R) and a centre (I, J)"));
        }
        (Some(way @ (2 | 3)), Some(place)) if i.is_some() || j.is_some() => {
            MoveKind::Arc { centre: place + Vector2::new(i.unwrap_or(0.0), j.unwrap_or(0.0)), left: way == 3 }
        }
        (Some(way @ (2 | 3)), Some(place)) if radius.is_some() => {
            let end = Vector2::new(to[0].unwrap_or(place.x), to[1].unwrap_or(place.y));
            MoveKind::Arc { centre: centre_of(line, (place, end), radius.unwrap_or(0.0), way == 3)?, left: way == 3 }
        }
        (Some(2 | 3), _) => return Err(at_line(line, "an arc has no centre (I, J) and no radius (R)")),
        _ => return Err(at_line(line, "the cutter is to move, and it is not stated how (G0 to G3)")),
    };
    if (i.is_some() || j.is_some() || radius.is_some()) && !matches!(kind, MoveKind::Arc { .. }) {
        return Err(at_line(line, "a straight move has a centre (I, J) or a radius (R)"));
    }
    state.go(line, kind, to)
}

/// The centre of an arc between two places with a radius: one above 0 turns by half a turn at most, one below 0 by more.
fn centre_of(
    line: usize,
    (start, end): (Vector2<f64>, Vector2<f64>),
    radius: f64,
    left: bool,
) -> Result<Vector2<f64>, Refusal> {
    let half = 0.5 * (end - start);
    let (chord, square) = (half.norm(), radius * radius - half.norm_squared());
    if chord < NO_MOVE {
        return Err(at_line(line, "an arc with a radius (R) ends where it begins").remedy("write its centre (I, J)"));
    }
    // Rounding of a half turn leaves the centre in the middle; controls take no more.
    if chord > radius.abs() + RADII {
        let what = format!("an arc with the radius {} mm ends {:.4} mm from its start", radius.abs(), 2.0 * chord);
        return Err(at_line(line, what));
    }
    let side = if left == (radius > 0.0) { 1.0 } else { -1.0 };
    Ok(start + half + side * square.max(0.0).sqrt() / chord * Vector2::new(-half.y, half.x))
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "G17 G21 G40 G90\n";

    fn why(body: &str) -> String {
        read(&format!("{HEAD}{body}\nM30\n"), None).expect_err("refused").to_string()
    }

    #[test]
    fn a_program_is_read_as_a_control_reads_it() {
        let program = format!(
            "%\nO1 (A (NESTED) NAME)\n{HEAD}n10 g0 z5. x10.y0 ; a comment\nG1Z-2.F100\nG3X-10.I-10.J0\nX10.I10.\nG0Z5.\nM30\nG91 X1\n"
        );
        let read = read(&program, None).expect("a program");
        assert_eq!(read.moves.len(), 4, "{read:?}");
        assert!(read.moves[0].is_upright() && read.moves[1].is_level());
        let turned: f64 = read.moves[1..3].iter().flat_map(CutterMove::segments).map(|arc| arc.sweep()).sum();
        assert!((turned - std::f64::consts::TAU).abs() < 1e-12, "{turned}");
    }

    use super::super::CutterMove;

    #[test]
    fn what_would_move_the_cutter_otherwise_is_refused_with_its_line() {
        let start = "G0 X0 Y0 Z5\nG1 Z-1 F100\n";
        let cases = [
            ("G91\n", "G91"),
            ("G20\n", "unit changes"),
            ("G70\n", "feeds are not"),
            ("G18\n", "plane"),
            ("G90.1\n", "absolute"),
            ("G2 X10 I5.1\n", "off its circle"),
            ("G2 X10\n", "no centre"),
            ("G2 X10 R4.9\n", "ends 10.0000 mm from its start"),
            ("G2 X0 R5\n", "ends where it begins"),
            ("G2 X10 I5 R5\n", "a radius (R) and a centre"),
            ("G1 X10 R5\n", "straight move has a centre"),
            ("/G1 X10\n", "can be skipped"),
            ("/2 G54\n", "can be skipped"),
            ("G1 X10 I5\n", "straight move has a centre"),
            ("G5 X10 I5\n", "not known"),
            ("G1 X=10\n", "not known"),
            ("G1 X10 X11\n", "twice"),
            ("G2 X10 I5 Z-2\n", "depth"),
        ];
        for (block, expected) in cases {
            let why = why(&format!("{start}{block}"));
            assert!(why.contains(expected) && why.contains("line 4"), "{block}: {why}");
        }
        assert!(why("G0 X0 Y0 Z5\nG1 Z-1").contains("feed"));
        assert!(why("G1 X1 F100").contains("place that is not known"));
        assert!(read("G21 G90\nG0 X1 Y1 Z1\nM30\n", None).is_err_and(|why| why.to_string().contains("G17")));
        assert!(read(&format!("{HEAD}G0 X1 Y1 Z1\n"), None).is_err_and(|why| why.to_string().contains("end")));
        let own = read(&format!("CYCLE832(0.01)\nG55\n{HEAD}G0 X1 Y1 Z1\nM30\n"), None).expect("passed over");
        assert_eq!(own.unknown, ["CYCLE832"]);
    }

    #[test]
    fn arcs_have_a_centre_or_a_radius() {
        let start = "G0 X3 Y4 Z5\nG1 Z-1 F100\n";
        let arc = |block: &str| {
            let read = read(&format!("{HEAD}{start}{block}\nG0 Z5\nM30\n"), None).expect(block);
            let MoveKind::Arc { centre, left } = read.moves[1].kind else { panic!("no arc: {block}") };
            let sweep: f64 =
                read.moves[1].segments().iter().map(camgen_kernel::geometry::contour::Segment::sweep).sum();
            (centre, left, sweep)
        };
        // A quarter and three quarters of the circle about 0, in both senses.
        for (by_radius, by_centre) in [
            ("G3 X-4 Y3 R5", "G3 X-4 Y3 I-3 J-4"),
            ("G2 X4 Y-3 R5", "G2 X4 Y-3 I-3 J-4"),
            ("G2 X-4 Y3 R-5", "G2 X-4 Y3 I-3 J-4"),
            ("G3 X4 Y-3 R-5", "G3 X4 Y-3 I-3 J-4"),
            ("G3 X-3 Y-4 R5", "G3 X-3 Y-4 I-3 J-4"),
        ] {
            let ((centre, left, sweep), (other, other_left, other_sweep)) = (arc(by_radius), arc(by_centre));
            assert!((centre - other).norm() < 1e-12 && left == other_left, "{by_radius}: {centre}");
            assert!((sweep - other_sweep).abs() < 1e-12, "{by_radius}: {sweep} {other_sweep}");
        }
    }

    #[test]
    fn words_of_a_control_are_those_of_the_others() {
        let own =
            "G17 G40 G90 G710\nG0 X=3 Y=4.0 Z5\n/M8\nN5 /1 M1\nG1 Z=-1 F=100\nG3 X=-4 Y3 CR=5\nG0 Z5\nRET\nG0 Z-9\n";
        let common = "G17 G40 G90 G710\nG0 X3 Y4 Z5\nM8\nM1\nG1 Z-1 F100\nG3 X-4 Y3 I-3 J-4\nG0 Z5\nM30\n";
        let (own, common) = (read(own, None).expect("read"), read(common, None).expect("read"));
        assert_eq!(own.moves.len(), 3);
        for (a, b) in own.moves.iter().zip(&common.moves) {
            assert!(a.from == b.from && a.to == b.to && (a.segments()[0].bulge - b.segments()[0].bulge).abs() < 1e-12);
        }
        let bare = "G17 G40 G90 G710\nG0 X3 Y4 Z5\nG1 Z-1 F100\nG3 X-4 Y3 R5\nG0 Z5\nM30\n";
        assert!(read(bare, None).is_err_and(|why| why.to_string().contains("write CR=5")));
        for block in ["G1 X=R1+2", "G1 X=AC(3)", "G3 X0 Y5 I=AC(0)"] {
            let text = format!("G17 G40 G90 G710\nG0 X3 Y4 Z5\nG1 Z-1 F100\n{block}\nG0 Z5\nM30\n");
            assert!(read(&text, None).is_err_and(|why| why.to_string().contains("not known")), "{block}");
        }
        // Before the first % FANUC reads nothing.
        let fanuc =
            "SENT BY DNC G1 X9\n%\nO7\nG17 G21 G40 G90\nG0 X0. Y0. Z5.\nG1 Z-1. F100.\nG1 X1 F100.\nG0 Z5.\nM30\n%\n";
        let why = read(fanuc, None).expect_err("increments").to_string();
        assert!(why.contains("X1 has no decimal point") && why.contains("line 7"), "{why}");
        assert!(read(&fanuc.replace("X1 ", "X1. "), None).is_ok());
    }

    #[test]
    fn a_number_without_a_point_is_one_of_increments_for_fanuc_alone() {
        let body = "G17 G21 G40 G90\nG0 X1.5 Y0 Z5.\nG1 Z-1. F100\nG1 X10\nG0 Z5.\nM30\n";
        assert!(read(body, None).is_ok() && read(&format!("G91.1\n{body}"), Some(Controller::Fanuc)).is_ok());
        for (text, design) in [(format!("%\nO0001\n{body}"), None), (body.to_owned(), Some(Controller::Fanuc))] {
            let why = read(&text, design).expect_err("increments").to_string();
            assert!(
                why.contains("X10 has no decimal point") && why.contains("0.01 mm") && why.contains("X10."),
                "{why}"
            );
            assert!(read(&text.replace("X10", "X10."), design).is_ok());
        }
    }

    #[test]
    fn a_cutter_is_kept_beside_its_path_by_a_radius_that_is_known() {
        let body = |head: &str, side: &str| {
            format!("{head}\nG0 X0. Y0. Z5.\nG1 Z-1. F100\n{side}\nG1 X10.\nG40\nG0 Z5.\nM30\n")
        };
        let of = |head: &str, side: &str| read(&body(head, side), None);
        let (fanuc, linuxcnc, sinumerik) = ("O1\nG17 G21 G40 G90", "G17 G21 G40 G90 G91.1", "G17 G40 G90 G710");
        for (head, why) in
            [(fanuc, "D00"), (linuxcnc, "spindle"), (sinumerik, "changes none"), ("G17 G21 G40 G90", "not know")]
        {
            let found = of(head, "G41").expect_err("no radius").to_string();
            assert!(found.contains(why) && found.contains("G41 D1"), "{found}");
            assert!(of(head, "G42 D0").is_err() && of(head, "G42 D3").is_ok());
            // LinuxCNC takes D with G41 and G42 alone.
            assert_eq!(of(&format!("{head} D2"), "G41").is_ok(), head != linuxcnc, "{head}");
            assert_eq!(of(&format!("{head}\nT1 M6"), "G41").is_ok(), head != fanuc, "{head}");
        }
    }

    #[test]
    fn a_feed_that_no_machine_runs_at_is_refused_with_its_number() {
        for (word, why) in
            [("", "not given"), ("F0", "0 mm/min"), ("F-5", "-5 mm/min"), ("F1000000000", "1000000000 mm/min")]
        {
            let found = why_of_feed(word);
            assert!(found.contains(why), "{word}: {found}");
        }
    }

    fn why_of_feed(word: &str) -> String {
        why(&format!("G0 X0 Y0 Z5\nG1 Z-1 {word}"))
    }

    #[test]
    fn what_moves_the_profile_is_refused_and_a_reference_point_is_not() {
        for block in ["G68 X0 Y0 R10", "G92 X1 Y0", "G10 L2 P1 X1", "G51 X0 Y0 P2", "G52 X1 Y1", "TRANS X1", "#5221=3"]
        {
            assert!(why(&format!("{block}\nG0 X0 Y0 Z5")).contains("line 2"), "{block}");
            assert!(why(&format!("G0 X0 Y0 Z5\n{block}")).contains("not the profile"), "{block}");
        }
        assert!(why("G710\nG58 X1\nG0 X0 Y0 Z5").contains("datum"));
        let home = "G91 G28 Z0\nG90 G69 G54\nG0 X0 Y0\nG43 Z5 H1\nG1 Z-1 F9\nG1 X9\nG0 Z5\nG91 G28 Z0";
        let found = read(&format!("{HEAD}{home}\nM30\n"), None).expect("a program");
        assert!(found.unknown.is_empty() && found.moves.len() == 3, "{found:?}");
        assert!(why("G0 X0 Y0 Z5\nG1 Z-1 F9\nG28 X0 Y0").contains("below the upper face"));
    }
}
