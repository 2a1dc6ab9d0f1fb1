//! The tables of points as they are in their files: interpolated as their heads say, against closed forms and the exact curves.

use crate::common::program::{self, camgen, camgen_in, files};
use camgen::body::{PointCurve, Points, RateTolerance};
use camgen::domains::press::SpecOfPress;
use camgen::geometry::points::{Interpolant, PointCoordinates, PointInterpolation, PointStep};
use camgen::motion::EccentricCircle;
use camgen::pipeline::Cam;
use camgen::profile::followed::FollowerOnChain;
use camgen::tool_files::points::{largest_errors, motion_errors, read};
use camgen::{Machine, Proven, Request, Spec, Verdict, Writing};
use nalgebra::Vector2;
use std::f64::consts::TAU;

const LIFTER: &str = include_str!("common/lifter.toml");

fn all() -> Vec<Points> {
    let mut all = Vec::new();
    for given in [PointCurve::Profile, PointCurve::Centre, PointCurve::Cutter] {
        for form in [PointCoordinates::Polar, PointCoordinates::Plane] {
            for step in [PointStep::Angle, PointStep::Chord] {
                for between in [PointInterpolation::Linear, PointInterpolation::Cubic] {
                    all.push(Points { curve: given, form: Some(form), step: Some(step), between });
                }
            }
        }
    }
    all
}

fn request(points: Points, cutter: Option<f64>, tolerance: f64) -> Request {
    Request { points: Some(points), cutter_radius: cutter, ..Request::within(tolerance) }
}

/// The bytes of a table.
fn table(proven: &Proven) -> String {
    let found = proven.findings().iter().find(|finding| finding.check == "points").expect("checked");
    assert_eq!(found.verdict, Verdict::Pass, "{found:?}");
    let writing = Writing { force: true, ..Writing::to("nowhere", "cam").formats(&["points"]) };
    let set = proven.files(&writing).expect("files");
    String::from_utf8(set.bytes("-points.csv").expect("a table").to_vec()).expect("text")
}

/// Points of what a control makes of a file, with those it was not asked for left out: many in every interval.
fn interpolated(text: &str) -> Vec<Vector2<f64>> {
    let table = read(text.as_bytes()).expect("a table");
    let curve = Interpolant::new(&table.rows, table.form, table.between, table.closed);
    let of = |interval: usize| {
        let (from, to) = curve.range(interval).expect("an interval");
        let at = |i: u32| curve.point_at(interval, from + (to - from) * f64::from(i) / 16.0).expect("a point").point;
        (0..16).filter(move |_| from < to).map(at).collect::<Vec<_>>()
    };
    (0..curve.count()).flat_map(of).collect()
}

fn told(text: &str, key: &str) -> String {
    let line = text.lines().find_map(|line| line.strip_prefix(&format!("# {key}: ")));
    line.unwrap_or_else(|| panic!("no {key}\n{text}")).to_owned()
}

/// Under a roller the eccentric circle is a circle about (e, 0), so are its profile and the path of any cutter.
#[test]
fn every_table_of_an_eccentric_circle_lies_on_its_circle() {
    let (e, rho, roller, cutter) = (0.012, 0.06, 0.015, 0.008);
    for clockwise in [true, false] {
        let builder = Spec::builder("eccentric").roller(roller).base_radius(rho - e - roller);
        let builder = if clockwise { builder } else { builder.counter_clockwise() };
        let cam = builder.motion(EccentricCircle::new(e, rho)).expect("in range").solve().expect("a cam");
        for points in all() {
            for tolerance in [50e-6, 2e-6] {
                let proven =
                    cam.draw(request(points, Some(cutter), tolerance)).expect("drawn").prove().expect("proved");
                let text = table(&proven);
                let radius = match points.curve {
                    PointCurve::Profile => rho - roller,
                    PointCurve::Centre => rho,
                    PointCurve::Cutter => rho - roller + cutter,
                };
                let off = |point: &Vector2<f64>| ((point - Vector2::new(1e3 * e, 0.0)).norm() - 1e3 * radius).abs();
                let worst = interpolated(&text).iter().map(off).fold(0.0, f64::max);
                let error: f64 = told(&text, "error_mm").parse().expect("a number");
                assert!(worst <= error + 1e-9 && error <= 1e3 * tolerance, "{points:?}: {worst} {error}");
                assert!(worst >= 0.95 * error, "{points:?}: {worst} far below {error}");
            }
        }
    }
}

/// Every row stands on the exact curve, and angles are even to the last digit.
#[test]
fn rows_stand_on_the_exact_curve() {
    for clockwise in [true, false] {
        let rotation = if clockwise { "cam.rotation=cw" } else { "cam.rotation=ccw" };
        let overrides = [rotation.to_owned(), "follower.roller.offset=12mm".to_owned()];
        let cam = Spec::rotary(Machine::load("dpi", &overrides).expect("valid").0, 35.0).solve().expect("a cam");
        let curves = camgen::body::curves(cam.body()).expect("plane");
        for points in all() {
            let text = table(&cam.draw(request(points, Some(0.01), 5e-6)).expect("drawn").prove().expect("proved"));
            let rows = read(text.as_bytes()).expect("a table").rows;
            assert_eq!(rows.first().map(|row| row[1]), rows.last().map(|row| row[1]), "closed");
            let inwards = match points.curve {
                PointCurve::Profile => curves.offset(),
                PointCurve::Centre => 0.0,
                PointCurve::Cutter => curves.offset() - 0.01,
            };
            // A cloud of exact points, as dense as a micrometre squared over the radius needs.
            let cloud: Vec<Vector2<f64>> = (0..200_000)
                .map(|i| {
                    let (piece, at) = curves.motion.locate(TAU * f64::from(i) / 2e5);
                    curves.touch(piece, at).curve.offset_inward(inwards).point * 1e3
                })
                .collect();
            let mut by_angle: Vec<(f64, Vector2<f64>)> =
                cloud.iter().map(|point| (libm::atan2(point.y, point.x).rem_euclid(TAU), *point)).collect();
            by_angle.sort_by(|a, b| a.0.total_cmp(&b.0));
            for (index, row) in rows.iter().enumerate() {
                let point = match points.form {
                    Some(PointCoordinates::Polar) => {
                        let angle = row[0].to_radians();
                        Vector2::new(row[1] * libm::cos(angle), row[1] * libm::sin(angle))
                    }
                    _ => Vector2::new(row[0], if clockwise { row[1] } else { -row[1] }),
                };
                let angle = libm::atan2(point.y, point.x).rem_euclid(TAU);
                let near = by_angle.partition_point(|(other, _)| *other < angle);
                let count = by_angle.len();
                let (a, b) = (by_angle[(near + count - 1) % count].1, by_angle[near % count].1);
                let off = (b - a).perp(&(point - a)).abs() / (b - a).norm();
                assert!(off < 1e-7, "{points:?} row {index}: {off}");
                if (points.form, points.step) == (Some(PointCoordinates::Polar), Some(PointStep::Angle)) {
                    let number = |count: usize| f64::from(u32::try_from(count).expect("few"));
                    let even = 360.0 * number(index) / number(rows.len() - 1);
                    assert!((row[0] - even).abs() <= 1e-12, "row {index}");
                }
            }
        }
    }
}

/// Where the cam has corners the table has them too, and the dwell is a dwell.
#[test]
fn corners_and_dwells_are_kept() {
    let overrides = ["buffer.column=return".to_owned(), "transition.kind=none".to_owned()];
    let cam = Spec::rotary(Machine::load("dpi", &overrides).expect("valid").0, 35.0).solve().expect("a cam");
    for points in all().into_iter().filter(|points| points.form == Some(PointCoordinates::Polar)) {
        let text = table(&cam.draw(request(points, Some(0.008), 5e-6)).expect("drawn").prove().expect("proved"));
        let rows = read(text.as_bytes()).expect("a table").rows;
        let resting: Vec<f64> = rows.iter().filter(|row| row[0] > 181.0 && row[0] < 359.0).map(|row| row[1]).collect();
        assert!(!resting.is_empty() && resting.iter().all(|radius| *radius == resting[0]), "{points:?} {resting:?}");
        let doubles = rows.iter().zip(rows.iter().skip(1)).filter(|(row, next)| row == next).count();
        // Profile and path of the cutter turn on an arc about the corner.
        let expected =
            if points.curve == PointCurve::Centre && points.between == PointInterpolation::Cubic { 2 } else { 0 };
        let corners = told(&text, "corners");
        assert_eq!(corners == "none", points.curve != PointCurve::Centre, "{points:?} {corners}");
        // The corner at 0° is the start of the table.
        assert_eq!(doubles, expected, "{points:?}\n{text}");
    }
}

/// An undercut cam that is forced has the envelope that exists, with its edge.
#[test]
fn an_undercut_profile_is_its_envelope() {
    let overrides = ["cam.base_radius=40mm".to_owned(), "follower.roller.radius=60mm".to_owned()];
    let cam = Spec::rotary(Machine::load("dpi", &overrides).expect("valid").0, 35.0).solve().expect("a cam");
    let boundary = cam.body().boundary(&cam.body().cuts()[0]).expect("an envelope").expect("a profile");
    let edges = (0..boundary.stretches().len()).filter(|index| boundary.starts_at_corner(*index)).count();
    for points in all().into_iter().filter(|points| points.curve == PointCurve::Profile) {
        let proven = cam.draw(request(points, None, 5e-6)).expect("drawn").prove().expect("proved");
        assert!(!proven.passed());
        let text = table(&proven);
        assert!(edges == 0 || told(&text, "corners").starts_with(&edges.to_string()), "{text}");
    }
}

#[test]
fn every_kind_of_cam_has_its_files() {
    let run = camgen(&["rotary", "--format", "points"]);
    assert_eq!(
        (run.code, files(run.directory.path())),
        (0, vec!["dpi-rotary-35rpm-points.csv".to_owned()]),
        "{}",
        run.err
    );
    let again = camgen(&["rotary", "--format", "points"]);
    let bytes = |run: &program::Run| std::fs::read(run.directory.path().join("output/dpi-rotary-35rpm-points.csv"));
    assert_eq!(bytes(&run).expect("a file"), bytes(&again).expect("a file"));
    let run = camgen(&["conoid", "--rpm", "20,35", "--format", "points", "--points-as", "xy"]);
    let names = ["dpi-conoid-20-35rpm-20rpm-points.csv", "dpi-conoid-20-35rpm-35rpm-points.csv"];
    assert_eq!((run.code, files(run.directory.path())), (0, names.map(str::to_owned).to_vec()), "{}", run.err);
    for between in ["linear", "cubic"] {
        for of in ["profile", "centre"] {
            let run = camgen(&["translating", "--format", "points", "--points-of", of, "--points-between", between]);
            assert_eq!(run.code, 0, "{}", run.err);
            let path = run.directory.path().join("output/dpi-translating-35rpm-points.csv");
            let text = std::fs::read_to_string(path).expect("a file");
            assert!(told(&text, "closed").starts_with("no") && told(&text, "given").contains("upper"), "{text}");
            assert!(read(text.as_bytes()).expect("a table").rows.iter().all(|row| row[1] > 0.0), "{text}");
        }
    }
    let directory = tempfile::tempdir().expect("a directory");
    std::fs::write(directory.path().join("lifter.toml"), LIFTER).expect("written");
    let words = ["make", "lifter.toml", "--format", "points", "--points-of", "cutter", "--cutter-diameter", "8mm"];
    let run = camgen_in(directory, &words);
    assert_eq!(run.code, 0, "{}", run.err);
    let path = run.directory.path().join("output/lifter-make-120rpm-points.csv");
    let text = std::fs::read_to_string(path).expect("a file");
    assert_eq!(told(&text, "given"), "path of the centre of a cutter or wheel of radius 4.0 mm");
    assert_eq!(told(&text, "machine"), "lifter");
    assert_eq!(program::report(&camgen(&["rotary", "--format", "points", "--json"]))["checks"][0]["verdict"], "pass");
}

/// What makes no sense is refused with its reason, and nothing is written.
#[test]
fn what_has_no_table_is_refused() {
    let with = |command: &str, words: &[&str]| {
        let head: Vec<&str> = command.split(' ').collect();
        let run = camgen(&[&head[..], &["--format", "points"], words].concat());
        assert!(files(run.directory.path()).is_empty(), "{words:?}");
        (run.code, run.out + &run.err)
    };
    for (command, words, why) in [
        ("translating", &["--points-as", "polar"][..], "no angle"),
        ("translating", &["--points-step", "angle"], "no angle"),
        ("translating", &["--points-of", "cutter"], "--cutter-diameter"),
        ("conoid --rpm 20,35", &["--points-of", "cutter"], "does not touch at the section"),
        ("rotary", &["--points-of", "cutter"], "--cutter-radius"),
        ("rotary", &["--side", "inside"], "--side"),
        ("rotary", &["--points-as", "cartesian"], "possible values"),
        ("rotary", &["--tolerance", "0.000001um"], "1000000 points"),
    ] {
        let (code, text) = with(command, words);
        assert!(code == 2 && text.contains(why), "{command} {words:?}: {code} {text}");
    }
    let (code, text) =
        with("rotary --set cam.base_radius=69mm", &["--points-of", "cutter", "--cutter-radius", "400mm"]);
    assert!(code == 1 && text.contains("FAIL  points") && text.contains("FAIL  cutter_radius"), "{text}");
    let run = camgen(&["rotary", "--points-as", "xy"]);
    assert!(run.code == 2 && run.err.contains("--format points"), "{}", run.err);
    // The library tells the same where the table was not drawn with the cam.
    let cam = Spec::rotary(Machine::load("dpi", &[]).expect("valid").0, 35.0).solve().expect("a cam");
    let proven = cam.draw(5e-6).expect("drawn").prove().expect("proved");
    let none = proven.files(&Writing::to("nowhere", "cam").formats(&["points"])).expect_err("no table");
    assert!(none.to_string().contains("points"), "{none}");
}

/// A flat face has no centre; its profile has a table like any other.
#[test]
fn a_flat_face_has_a_profile_only() {
    let (head, _) = LIFTER.split_once("[follower.roller]").expect("a follower");
    let text = format!("{head}[follower.flat]\n");
    let machine = Machine::from_toml("lifter.toml", &text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let (motion, rpm) = machine.motion().expect("a motion");
    let cam = Spec::of_motion(machine, motion, rpm).solve().expect("a cam");
    for points in all() {
        let drawing = cam.draw(request(points, Some(0.005), 5e-6));
        if points.curve == PointCurve::Centre {
            assert!(drawing.expect_err("no centre").to_string().contains("flat face"));
        } else {
            let text = table(&drawing.expect("drawn").prove().expect("proved"));
            assert!(told(&text, "tolerance_mm") == "0.005", "{text}");
        }
    }
}

fn cubic() -> impl Iterator<Item = Points> {
    all().into_iter().filter(|points| points.between == PointInterpolation::Cubic)
}

fn number(text: &str, key: &str) -> f64 {
    told(text, key).parse().unwrap_or_else(|error| panic!("{key}: {error}"))
}

/// A program of one's own.
fn own(text: &str) -> Cam {
    let machine = Machine::from_toml("own.toml", text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let (motion, rpm) = machine.motion().expect("a motion");
    Spec::of_motion(machine, motion, rpm).solve().expect("a cam")
}

fn press(overrides: &[&str]) -> Cam {
    let overrides: Vec<String> = overrides.iter().map(|word| (*word).to_owned()).collect();
    Spec::rotary(Machine::load("dpi", &overrides).expect("valid").0, 35.0).solve().expect("a cam")
}

fn with_follower(table: &str) -> String {
    let (head, tail) = LIFTER.split_once("[follower.roller]").expect("a follower");
    let (_, cam) = tail.split_once("[cam]").expect("a cam");
    format!("{head}{table}\n[cam]{cam}")
}

/// Every table with cubic interpolation keeps what is asked, whatever it gives; in x and y the roller on its edges, found by
/// another way, feels the same on the profile.
#[test]
fn cubic_tables_keep_velocity_and_acceleration() {
    let swinging = "[follower.swinging-roller]\nradius = \"10 mm\"\narm = \"90 mm\"\npivot_distance = \"110 mm\"";
    let swinging = with_follower(swinging).replace("\"20 mm\"", "\"12 deg\"").replace("\"0 mm\"", "\"0 deg\"");
    let cams = [
        press(&[]),
        press(&["transition.kind=blend", "follower.roller.offset=12mm", "cam.rotation=ccw"]),
        press(&["transition.kind=none"]),
        own(LIFTER),
        own(&swinging),
        own(&with_follower("[follower.flat]\n")),
    ];
    for (number_of, cam) in cams.iter().enumerate() {
        let curves = camgen::body::curves(cam.body()).expect("plane");
        let face = camgen::body::radius_of_roller(cam.body()).is_none();
        let [velocity, acceleration] = cam.body().largest_rates();
        let unit = if number_of == 4 { 1.0 } else { 1e3 };
        for points in cubic().filter(|points| !(face && points.curve == PointCurve::Centre)) {
            for shares in [[None, Some(0.05)], [Some(0.0005), Some(0.01)]] {
                let rates = shares.map(|share| share.map(RateTolerance::Share));
                let request = Request { rates, ..request(points, cutter_of(points), 5e-6) };
                let proven = cam.draw(request).unwrap_or_else(|error| panic!("{number_of} {points:?}: {error}"));
                let text = table(&proven.prove().expect("proved"));
                let per = if number_of == 4 { "rad_per_rad" } else { "mm_per_rad" };
                let told = [
                    number(&text, &format!("velocity_error_{per}")) / unit,
                    number(&text, &format!("acceleration_error_{per}2")) / unit,
                ];
                let kept = [shares[0].map(|share| share * velocity), shares[1].map(|share| share * acceleration)];
                for (told, kept) in told.iter().zip(kept) {
                    assert!(
                        kept.is_none_or(|kept| *told <= kept * (1.0 + 1e-6)),
                        "{number_of} {points:?} {told} {kept:?}"
                    );
                }
                let keeps =
                    if shares[0].is_some() { "distance, velocity, acceleration" } else { "distance, acceleration" };
                assert_eq!(told_keeps(&text), keeps, "{number_of} {points:?}");
                if (points.curve, points.form) == (PointCurve::Profile, Some(PointCoordinates::Plane)) {
                    let read = read(text.as_bytes()).expect("a table");
                    let turned = cam.body().cuts()[0].mirrored == [true];
                    let flip = |row: &[f64; 2]| if turned { [row[0], -row[1]] } else { *row };
                    let rows: Vec<[f64; 2]> = read.rows.iter().map(flip).collect();
                    let edges = Interpolant::new(&rows, read.form, read.between, read.closed).edges().expect("edges");
                    let errors = FollowerOnChain::new(curves, &edges).errors();
                    // Where one spline ends and the next begins the outline turns a little: a step of the velocity.
                    let (compared, near) = if text.contains("# jumps") { (1, 5e-3) } else { (2, 1e-3) };
                    let found = [errors.velocity.value, errors.acceleration.value];
                    for (told, found) in told.iter().zip(found).take(compared) {
                        assert!(
                            (told / found - 1.0).abs() < near,
                            "{number_of} {points:?}: told {told}, found {found}"
                        );
                    }
                }
            }
        }
    }
}

fn cutter_of(points: Points) -> Option<f64> {
    (points.curve == PointCurve::Cutter).then_some(0.008)
}

fn told_keeps(text: &str) -> String {
    told(text, "keeps")
}

/// The path of the centre of a centred roller in polar coordinates is the lift itself: the errors are those of the spline's own
/// derivatives.
#[test]
fn a_polar_path_of_a_centred_roller_is_its_lift() {
    let cam = press(&[]);
    let curves = camgen::body::curves(cam.body()).expect("plane");
    for step in [PointStep::Angle, PointStep::Chord] {
        let points = Points {
            curve: PointCurve::Centre,
            form: Some(PointCoordinates::Polar),
            step: Some(step),
            between: PointInterpolation::Cubic,
        };
        let rates = [None, Some(RateTolerance::Share(0.02))];
        let request = Request { rates, ..request(points, None, 5e-6) };
        let text = table(&cam.draw(request).expect("drawn").prove().expect("proved"));
        let rows = read(text.as_bytes()).expect("a table").rows;
        let knots: Vec<f64> = rows.iter().map(|row| row[0].to_radians()).collect();
        let radii: Vec<f64> = rows.iter().map(|row| row[1]).collect();
        let spline = camgen::numeric::spline::Spline::periodic(&knots, &radii);
        let mut worst = [0.0_f64; 2];
        for i in 0..4_000_000 {
            let angle = TAU * f64::from(i) / 4e6;
            let (piece, inside) = curves.motion.locate(angle);
            let (law, [_, slope, bend, _]) = (curves.motion.jet(piece, inside), spline.values_at(angle));
            worst = [worst[0].max((slope - 1e3 * law.ds).abs()), worst[1].max((bend - 1e3 * law.dds).abs())];
        }
        let told = [number(&text, "velocity_error_mm_per_rad"), number(&text, "acceleration_error_mm_per_rad2")];
        for (told, worst) in told.iter().zip(worst) {
            assert!(worst <= told * (1.0 + 1e-9) && worst > told * (1.0 - 1e-3), "{step:?}: {told} {worst}");
        }
    }
}

/// A control that goes straight keeps a velocity, and no acceleration: asked for, that is an error; by default it is said.
#[test]
fn linear_tables_keep_the_velocity_alone() {
    let cam = press(&[]);
    let [velocity, _] = cam.body().largest_rates();
    for points in all() {
        if points.between == PointInterpolation::Cubic {
            continue;
        }
        let asked = |share: f64| [Some(RateTolerance::Share(share)), None];
        let text = |rates, strict| {
            let request = Request { rates, strict, ..request(points, cutter_of(points), 5e-6) };
            table(&cam.draw(request).expect("drawn").prove().expect("proved"))
        };
        let loose = text([None, Some(RateTolerance::Share(0.05))], [true, false]);
        assert!(told(&loose, "not_kept").starts_with("acceleration") && told_keeps(&loose) == "distance", "{loose}");
        let kept = text(asked(0.02), [true, false]);
        assert!(number(&kept, "velocity_error_mm_per_rad") <= 20.0 * velocity, "{points:?}");
        assert_eq!(told_keeps(&kept), "distance, velocity");
        let closer =
            points.step == Some(PointStep::Angle) && number(&loose, "velocity_error_mm_per_rad") > 20.0 * velocity;
        assert!(!closer || number(&kept, "rows") > number(&loose, "rows"), "{points:?}");
        let rates = [None, Some(RateTolerance::Share(0.05))];
        let why = cam.draw(Request { rates, ..request(points, cutter_of(points), 5e-6) }).expect_err("no acceleration");
        assert!(why.to_string().contains("--points-between cubic"), "{why}");
    }
    let words = ["rotary", "--format", "points", "--tolerance-acceleration", "5%"];
    let run = camgen(&words);
    assert!(
        run.code == 2 && run.err.contains("velocity jumps") && files(run.directory.path()).is_empty(),
        "{}",
        run.err
    );
    // A tolerance of the velocity does not make the default of the acceleration a demand.
    let run = camgen(&["rotary", "--format", "points", "--tolerance-velocity", "2%", "--json"]);
    let report = program::report(&run);
    assert_eq!((run.code, &report["points"][0]["interpolation"]), (0, &"linear".into()), "{}", run.err);
    assert!(
        report["points"][0]["velocity_error_mm_per_rad"].as_f64().is_some_and(|error| error <= 0.02 * 1e3 * velocity)
    );
    assert!(report["points"][0]["acceleration_error_mm_per_rad2"].is_null());
}

/// Where the acceleration jumps one spline ends and the next begins; without a tolerance of it they need not.
#[test]
fn splines_end_where_the_acceleration_jumps() {
    let harmonic = own(&LIFTER.replace("3-4-5", "harmonic"));
    for (cam, jumps) in [(press(&["transition.kind=none"]), 2), (harmonic, 2)] {
        for points in cubic() {
            let text = |rates| {
                let request = Request { rates, ..request(points, cutter_of(points), 5e-6) };
                table(&cam.draw(request).expect("drawn").prove().expect("proved"))
            };
            let kept = text([None, Some(RateTolerance::Share(0.02))]);
            assert!(told(&kept, "jumps").starts_with(&jumps.to_string()), "{points:?}\n{kept}");
            let rows = read(kept.as_bytes()).expect("a table").rows;
            assert_eq!(rows.iter().zip(rows.iter().skip(1)).filter(|(row, next)| row == next).count(), jumps);
            let loose = text([None; 2]);
            assert!(!loose.contains("# jumps"), "{points:?}");
            assert!(number(&loose, "acceleration_error_mm_per_rad2") > number(&kept, "acceleration_error_mm_per_rad2"));
        }
    }
}

/// Infinite accelerations of the motion itself cannot be kept, and are not told.
#[test]
fn a_jump_of_the_velocity_is_said() {
    let cam = press(&["buffer.column=return", "transition.kind=none"]);
    for points in cubic() {
        let rates = [None, Some(RateTolerance::Share(0.05))];
        let asked = Request { rates, ..request(points, cutter_of(points), 5e-6) };
        let why = cam.draw(asked).expect_err("no acceleration").to_string();
        assert!(why.contains("velocity of the motion jumps"), "{why}");
        let text = table(&cam.draw(Request { strict: [false; 2], ..asked }).expect("drawn").prove().expect("proved"));
        assert!(told(&text, "felt").contains("not known") && told_keeps(&text) == "distance", "{text}");
    }
}

/// What the head tells is felt of the rows as read, and a row that somebody moved is felt.
#[test]
fn a_moved_row_is_felt() {
    let cam = press(&[]);
    for points in cubic() {
        let rates = [None, Some(RateTolerance::Share(0.05))];
        let request = Request { rates, ..request(points, cutter_of(points), 5e-6) };
        let text = table(&cam.draw(request).expect("drawn").prove().expect("proved"));
        let read = read(text.as_bytes()).expect("a table");
        let feel = motion_errors(cam.body(), &cam.body().cuts()[0], points.curve, Some(0.008)).expect("it can be told");
        let felt = |rows: &[[f64; 2]]| {
            let curve = Interpolant::new(rows, read.form, read.between, read.closed);
            largest_errors(&*feel, &curve, read.between).map(|error| 1e3 * error)
        };
        let told = [number(&text, "velocity_error_mm_per_rad"), number(&text, "acceleration_error_mm_per_rad2")];
        for (told, found) in told.iter().zip(felt(&read.rows)) {
            assert!((told - found).abs() <= 1e-9 * told, "{points:?}: {told} {found}");
        }
        let mut moved = read.rows.clone();
        moved[4][1] += 0.2;
        assert!(felt(&moved)[1] > 1.05 * told[1], "{points:?}: {:?} {told:?}", felt(&moved));
    }
}

/// The note tells what the head of the file tells, and the place is that where the curve is farthest from the exact one.
#[test]
fn the_check_tells_rates_and_the_place_of_the_worst() {
    let cam = own(LIFTER);
    let curves = camgen::body::curves(cam.body()).expect("plane");
    let exact: Vec<_> = (0..36_000)
        .map(|i| {
            let (piece, angle) = curves.motion.locate(TAU * f64::from(i) / 36e3);
            curves.touch(piece, angle).curve
        })
        .collect();
    for between in [PointInterpolation::Linear, PointInterpolation::Cubic] {
        let points = Points {
            curve: PointCurve::Centre,
            form: Some(PointCoordinates::Plane),
            step: Some(PointStep::Angle),
            between,
        };
        let proven = cam.draw(request(points, None, 2e-5)).expect("drawn").prove().expect("proved");
        let found = proven.findings().iter().find(|finding| finding.check == "points").expect("checked").clone();
        let text = table(&proven);
        let note = found.note_words();
        let velocity = note.split("the velocity off by ").nth(1).and_then(|rest| rest.split(' ').next()).expect(&note);
        let velocity: f64 = velocity.parse().expect("a number");
        assert!((velocity / number(&text, "velocity_error_mm_per_rad") - 1.0).abs() < 1e-3, "{note}");
        if between == PointInterpolation::Cubic {
            assert!(note.contains(", the acceleration by ") && !note.contains("is not kept"), "{note}");
            continue;
        }
        assert!(note.contains("the acceleration is not kept where the control moves in straight lines"), "{note}");
        let rows = read(text.as_bytes()).expect("a table").rows;
        let chords = rows.windows(2).map(|pair| {
            let [a, b] = [pair[0], pair[1]].map(Vector2::from);
            let middle = 0.5 * (a + b);
            let near = exact.iter().map(|point| (point.point * 1e3 - middle, point));
            let (away, nearest) =
                near.min_by(|a, b| a.0.norm_squared().total_cmp(&b.0.norm_squared())).expect("points");
            (away.dot(&nearest.outward()).abs(), middle, (b - a).norm())
        });
        let chords: Vec<_> = chords.collect();
        let worst = chords.iter().map(|chord| chord.0).fold(0.0, f64::max);
        assert!((worst / found.value - 1.0).abs() < 0.02, "{worst} {}", found.value);
        let (piece, angle) = curves.motion.locate(found.place.cam_deg.expect("a place").to_radians());
        let told = curves.touch(piece, angle).curve.point * 1e3;
        let there = |(off, middle, chord): &(f64, Vector2<f64>, f64)| {
            *off > 0.99 * worst && (told - middle).norm() < 0.05 * chord
        };
        let top: Vec<_> = chords.iter().filter(|chord| chord.0 > 0.99 * worst).collect();
        assert!(chords.iter().any(there), "{told:?}: {top:?}");
    }
}
