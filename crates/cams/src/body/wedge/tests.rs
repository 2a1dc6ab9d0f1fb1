//! The plate against closed forms and values of 16 digits.

use super::*;
use crate::body::Request;
use crate::pipeline::{Cam, Error, Spec};
use camgen_kernel::motion::program::Program;
use camgen_kernel::motion::{Jet, Piece, laws};

/// A file of a plate with these segments and keys of `[cam]`.
fn file(stroke: &str, segments: &str, cam: &str) -> String {
    format!(
        "name = \"plate\"\n[motion]\nstroke = \"{stroke}\"\nstart = \"0 mm\"\n{segments}\n[follower.roller]\nradius = \"12 mm\"\n\
         [cam]\nbody = \"wedge\"\n{cam}\n[limits]\npressure_angle = \"60 deg\"\n"
    )
}

fn solved(text: &str) -> Result<Cam, Error> {
    let machine = Machine::from_toml("plate.toml", text, &[])?;
    Spec::of_program(machine, None).expect("a motion").solve()
}

/// The message of a file that is refused.
fn refused(text: &str) -> String {
    solved(text).map(|_| ()).expect_err("a refusal").to_string()
}

const RISE: &str = "[[motion.segment]]\nlaw = \"cycloidal\"\nover = \"80 mm\"\nto = \"25 mm\"";

/// Golden G22: cycloidal 25 over 80 mm, d 20°, r 12, x 30: pitch, profile, α, ρ.
#[test]
fn the_known_plate_is_made_to_the_digits_given() {
    let cam = solved(&file("80 mm", RISE, "drive_angle = \"20 deg\"")).expect("a plate");
    let curves = crate::body::curves(cam.body()).expect("plane");
    let (piece, x) = curves.motion.locate(0.03);
    let contact = curves.contact(piece, x);
    let profile = curves.profile(piece, x).point;
    let pitch = contact.curve.point;
    let known = [
        (1e3 * pitch.x, 32.244_169_107_770_36),
        (1e3 * pitch.y, -6.165_803_949_036_686),
        (1e3 * profile.x, 36.927_994_807_350_86),
        (1e3 * profile.y, 4.882_353_219_285_516),
        (contact.pressure_angle.to_degrees(), 42.974_338_036_362_74),
        (1e3 / contact.curve.curvature, -129.903_369_989_701_7),
    ];
    for (found, wanted) in known {
        assert!((found - wanted).abs() < 2e-13 * wanted.abs().max(10.0), "{found} {wanted}");
    }
}

/// A harmonic of one hill over a travel.
#[derive(Debug)]
struct Hill;

impl Motion for Hill {
    fn pieces(&self) -> &[Piece] {
        &[Piece { start: 0.01, end: 0.11, dwell: false }]
    }

    fn jet(&self, _: usize, x: f64) -> Jet {
        let k = std::f64::consts::TAU / 0.1;
        let (sin, cos) = libm::sincos(k * (x - 0.01));
        Jet { s: 0.004 * (1.0 - cos), ds: 0.004 * k * sin, dds: 0.004 * k * k * cos, ddds: -0.004 * k * k * k * sin }
    }

    fn period(&self) -> Option<f64> {
        None
    }
}

/// A motion of one's own from x = 10 mm on, that returns to where it began: length, height and pressure angle in closed form.
#[test]
fn a_motion_of_ones_own_is_a_plate() {
    let spec = Spec::builder("hill").roller(0.01).set("cam.body", "wedge").motion(Hill).expect("a machine");
    let cam = spec.solve().expect("a plate");
    assert!(cam.draw(5e-6).expect("drawn").prove().expect("proved").passed());
    let machine = cam.body().machine().clone();
    let wedge = Wedge::of(&machine, &(Arc::new(Hill) as Arc<dyn Motion>)).expect("a plate");
    assert!((wedge.length() - 0.12).abs() < 1e-12 && (wedge.height() - 0.018).abs() < 1e-12, "{wedge:?}");
    let steepest = 0.004 * std::f64::consts::TAU / 0.1;
    assert!((wedge.pressure_angle().value - libm::atan(steepest)).abs() < 1e-12);
    assert!((wedge.max_lift() - 0.008).abs() < 1e-15);
    // Its range needs no turn, and one of a turn needs no plate.
    let turn = Program::new(
        Quantity::Length,
        0.0,
        &[(laws::named("cycloidal"), 1.0, 0.01), (laws::named("cycloidal"), 1.0, 0.0)],
    )
    .expect("a program");
    let why = Wedge::of(&machine, &(Arc::new(turn) as Arc<dyn Motion>)).expect_err("a turn").to_string();
    assert!(why.contains("does not turn"), "{why}");
    let disc = Spec::builder("hill").roller(0.01).motion(Hill).expect("a machine").solve().expect_err("no disc");
    assert!(disc.to_string().contains("cam.body = \"wedge\""), "{disc}");
}

/// β ≥ Cv h/tan α across, and at the inclination d a slope of tan α cos d − sin d.
#[test]
fn the_shortest_stroke_keeps_the_limit_exactly() {
    for drive in [0.0_f64, 15.0, -20.0] {
        let cam = file("80 mm", RISE, &format!("drive_angle = \"{drive} deg\"")).replace("60 deg", "40 deg");
        let cam = solved(&cam).expect("a plate");
        let machine = cam.body().machine().clone();
        let (motion, _) = machine.motion().expect("a motion");
        let wedge = Wedge::of(&machine, &motion).expect("a plate");
        let share = wedge.shortest_share([2.0 * 0.025 / 0.08, 0.0]).expect("a length");
        let (sin, cos) = libm::sincos(drive.to_radians());
        let wanted = 2.0 * 0.025 / 0.08 / (libm::tan(40_f64.to_radians()) * cos - sin);
        assert!((share - wanted).abs() < 1e-14, "{drive}: {share} {wanted}");
        let longer: Arc<dyn Motion> = Arc::new(Stretched::new(Arc::clone(&motion), share));
        let worst = Wedge::of(&machine, &longer).expect("a plate").pressure_angles()[0].value;
        assert!((worst - 40_f64.to_radians()).abs() < 1e-9, "{drive}: {}", worst.to_degrees());
    }
}

/// Length, height and run-in as they are chosen, and as they are given.
#[test]
fn sizes_are_chosen_or_given() {
    let of = |cam: &str| {
        let cam =
            solved(&file("100 mm", &format!("{RISE}\n[[motion.segment]]\nlaw = \"dwell\""), cam)).expect("a plate");
        let machine = cam.body().machine().clone();
        let wedge = Wedge::of(&machine, &machine.motion().expect("a motion").0).expect("a plate");
        [wedge.length(), wedge.height(), wedge.run_in(), wedge.thinnest.0].map(|length| (1e6 * length).round() / 1e3)
    };
    // 12 mm of run-in and run-out about the stroke; the lift and the radius of the roller.
    assert_eq!(of(""), [124.0, 37.0, 12.0, 12.0]);
    assert_eq!(of("length = \"150.5 mm\"\nheight = \"40 mm\"\nrun_in = \"20 mm\""), [150.5, 40.0, 20.0, 15.0]);
    let short = refused(&file("80 mm", RISE, "length = \"90 mm\""));
    assert!(short.contains("ends 2 mm before its motion does") && short.contains("at least 92 mm"), "{short}");
    let through = solved(&file("80 mm", RISE, "height = \"20 mm\"")).expect("a plate");
    let through = through.body().draw(&Request::within(5e-6)).map(|_| ()).expect_err("no outline");
    assert!(through.to_string().contains("cam.height must exceed 25.000 mm"), "{through}");
}

/// What has no meaning for a plate is refused with the reason.
#[test]
fn what_a_plate_does_not_have_is_refused() {
    let usual = file("80 mm", RISE, "");
    for (from, to, why) in [
        ("80 mm\"\nto", "80 deg\"\nto", "`over` is an angle, but a plate travels"),
        ("stroke = \"80 mm\"\n", "", "needs the travel over which it goes"),
        ("stroke =", "rpm = 60\nstroke =", "`rpm` is for a cam that turns"),
        ("stroke =", "repeat = 2\nstroke =", "`repeat` is for a cam that turns"),
        ("stroke =", "at = \"10 deg\"\nstroke =", "`at` is for a cam that turns"),
        ("body = \"wedge\"", "body = \"disc\"", "`stroke` is the travel of a plate, but the cam turns"),
        ("[follower.roller]\nradius = \"12 mm\"", "[follower.flat]", "keeps one direction"),
        ("radius = \"12 mm\"", "radius = \"12 mm\"\noffset = \"3 mm\"", "has no shaft"),
        ("radius = \"12 mm\"", "radius = \"12 mm\"\nmass = \"2 kg\"", "speed of the plate"),
        (
            "[follower.roller]\nradius = \"12 mm\"",
            "[follower.swinging-roller]\nradius = \"12 mm\"\narm = \"100 mm\"\npivot_distance = \"120 mm\"",
            "along a straight path",
        ),
        ("[cam]", "[spring]\ndamping = \"2 N*s/m\"\n[cam]", "damping acts by the speed"),
        ("[cam]", "[guide]\nfriction = 0.1\nspan = \"60 mm\"\n[cam]", "the guide"),
        ("[cam]", "[vibration]\nnatural_frequency = \"40 Hz\"\n[cam]", "vibration acts by the speed"),
        ("[cam]", "[flywheel]\nfluctuation = 0.02\n[cam]", "no shaft for a flywheel"),
        ("[cam]", "[follower.roller.bearing]\ndynamic_rating = \"20 kN\"\n[cam]", "life of a bearing"),
        ("[limits]", "[limits]\njump_margin = 2", "`limits.jump_margin`"),
        ("[limits]", "[limits]\npivot_clearance = \"2 mm\"", "swings"),
        ("start = \"0 mm\"", "start = \"0 mm\"\npolydyne = { natural_frequency = \"40 Hz\" }", "a plate has none"),
        ("to = \"25 mm\"", "to = \"25 mm\"\nvelocity = \"0.1 mm/deg\"", "along its travel"),
        ("over = \"80 mm\"", "over = \"70 mm\"", "10.000000 mm are missing"),
        ("over = \"80 mm\"", "until = \"90 mm\"", "10.000000 mm too much"),
    ] {
        let changed = usual.replace(from, to);
        assert_ne!(changed, usual, "{from}");
        let found = refused(&changed);
        assert!(found.contains(why), "{to}: {found}");
    }
    let points = "points = [[\"0 mm\", \"0 mm\"], [\"40 mm\", \"9 mm\"], [\"80 mm\", \"12 mm\"]]";
    let whole = refused(&file("80 mm", points, ""));
    assert!(whole.contains("closes after a turn"), "{whole}");
}

/// Laws, polynomials, splines, formulas and rates by length give what they say.
#[test]
fn a_program_by_length_is_what_its_segments_say() {
    let segments = "[[motion.segment]]\nlaw = \"polynomial\"\nover = \"40 mm\"\nto = \"8 mm\"\nvelocity = \"0.4 mm/mm\"\n\
                    [[motion.segment]]\nlaw = \"constant-velocity\"\nto = \"16 mm\"\nvelocity = \"0.4 mm/mm\"\n\
                    [[motion.segment]]\nlaw = \"spline\"\nuntil = \"110 mm\"\nto = \"26 mm\"\npoints = [[\"80 mm\", \"23 mm\"]]\n\
                    [[motion.segment]]\nlaw = \"formula\"\nformula = \"x^3*(10-15*x+6*x^2)\"\nto = \"20 mm\"";
    let cam = solved(&file("150 mm", segments, "")).expect("a plate");
    let motion = crate::body::curves(cam.body()).expect("plane").motion;
    let at = |x: f64| {
        let (piece, x) = motion.locate(1e-3 * x);
        let jet = motion.jet(piece, x);
        [1e3 * jet.s, jet.ds]
    };
    for (x, lift, slope) in [
        (0.0, 0.0, 0.0),
        (40.0, 8.0, 0.4),
        (50.0, 12.0, 0.4),
        (60.0, 16.0, 0.4),
        (110.0, 26.0, 0.0),
        (150.0, 20.0, 0.0),
    ] {
        let [s, v] = at(x);
        assert!((s - lift).abs() < 1e-10 && (v - slope).abs() < 1e-12, "{x}: {s} {v}");
    }
    assert!((at(80.0)[0] - 23.0).abs() < 1e-10 && (at(130.0)[0] - 23.0).abs() < 1e-10);
    // Over the whole stroke, x in the unit of start.
    let cam = solved(&file("100 mm", "formula = \"10*(1-cos(pi*x/100))\"", "")).expect("a plate");
    let curves = crate::body::curves(cam.body()).expect("plane");
    let (piece, x) = curves.motion.locate(0.05);
    let jet = curves.motion.jet(piece, x);
    assert!((jet.s - 0.01).abs() < 1e-15 && (jet.ds - 0.1 * std::f64::consts::PI).abs() < 1e-13, "{jet:?}");
}

/// A plate whose every limit is kept by the stroke that its remedy names.
#[test]
fn the_stroke_of_the_remedy_passes() {
    let text = file("50 mm", &RISE.replace("80 mm", "50 mm"), "").replace("60 deg", "30 deg");
    let machine = Machine::from_toml("plate.toml", &text, &[]).expect("a machine");
    let wedge = Wedge::of(&machine, &machine.motion().expect("a motion").0).expect("a plate");
    let remedy = wedge.remedy().expect("a remedy").to_string();
    let stroke: f64 =
        remedy.split('"').nth(1).and_then(|text| text.strip_suffix(" mm")?.parse().ok()).expect("a stroke");
    // 2 · 25/tan 30° = 86.6 mm.
    assert!(stroke >= 87.0, "{remedy}");
    let longer = text.replace("50 mm", &format!("{stroke} mm"));
    let machine = Machine::from_toml("plate.toml", &longer, &[]).expect("a machine");
    let wedge = Wedge::of(&machine, &machine.motion().expect("a motion").0).expect("a plate");
    assert_eq!(broken_limit(&wedge), None, "{remedy}");
}
