//! Forces, jump speed, power, vibration and guide of a motion program as a user describes them.

use crate::common::program::{camgen, files, make, number, report};
use serde_json::Value;
use std::f64::consts::TAU;
use std::fs;

/// Rise 30 mm, dwell, return, dwell, whose forces and harmonics are known with 40 digits.
const KNOWN: &str = r#"name = "known"
[motion]
rpm = 300
start = "0 mm"
[[motion.segment]]
law = "modified-sine"
over = "120 deg"
to = "30 mm"
[[motion.segment]]
law = "dwell"
over = "30 deg"
[[motion.segment]]
law = "3-4-5"
over = "150 deg"
to = "0 mm"
[[motion.segment]]
law = "dwell"
[follower.roller]
radius = "15 mm"
offset = "12 mm"
mass = "2.5 kg"
[cam]
base_radius = "55 mm"
thickness = "15 mm"
material = "steel"
[spring]
rate = "8 N/mm"
preload = "600 N"
"#;

const GUIDE: &str = "[guide]\nfriction = 0.15\nspan = \"60 mm\"\noverhang = \"30 mm\"\n";
const TRAIN: &str = "[vibration]\nnatural_frequency = \"37.5 Hz\"\n";

/// The same angles and laws with 20° of swing.
fn swinging(follower: &str, spring: &str) -> String {
    let (motion, _) = KNOWN.split_once("[follower.roller]").expect("a follower");
    let motion = motion.replace("\"0 mm\"", "\"0 deg\"").replace("\"30 mm\"", "\"12 deg\"");
    format!("{motion}{follower}\n[cam]\nbase_radius = \"50 mm\"\nthickness = \"15 mm\"\nmaterial = \"steel\"\n{spring}")
}

const LEVER: &str = "[follower.swinging-roller]\nradius = \"16 mm\"\narm = \"110 mm\"\npivot_distance = \"140 mm\"\n\
                     inertia = \"0.03 kg*m2\"";
const FACE: &str =
    "[follower.swinging-flat]\npivot_distance = \"150 mm\"\nface_offset = \"8 mm\"\ninertia = \"0.03 kg*m2\"";
const TORSION: &str =
    "[spring]\nrate = \"50 N*m/rad\"\npreload = \"40 N*m\"\ndamping = \"0.3 N*m*s/rad\"\nload = \"2 N*m\"\n";

fn told(text: &str) -> Value {
    let run = make(text, &["--dry-run", "--json"]);
    assert!(run.code < 2, "{}{}", run.out, run.err);
    report(&run)
}

fn near(found: f64, known: f64, share: f64) {
    assert!((found - known).abs() <= share * known.abs().max(1e-3), "{found}, not {known}");
}

fn finding<'a>(report: &'a Value, check: &str) -> Option<&'a Value> {
    report["checks"].as_array().expect("checks").iter().find(|found| found["check"] == check)
}

fn found<'a>(report: &'a Value, check: &str) -> &'a Value {
    finding(report, check).unwrap_or_else(|| panic!("no {check} in {}", report["checks"]))
}

/// The table of a cam: a column by its name.
fn columns(text: &str, samples: usize) -> impl Fn(&str) -> Vec<f64> + use<> {
    let made = make(text, &["--samples", &samples.to_string(), "--format", "csv", "--force"]);
    assert!(made.code < 2, "{}{}", made.out, made.err);
    let directory = made.directory.path().join("output");
    let file = fs::read_dir(directory).expect("files").map(|file| file.expect("a file").path());
    let file = file.into_iter().find(|path| path.extension().is_some_and(|end| end == "csv")).expect("a table");
    let csv = fs::read_to_string(file).expect("a table");
    let names: Vec<String> = csv.lines().next().expect("names").split(',').map(str::to_owned).collect();
    let rows: Vec<Vec<f64>> =
        csv.lines().skip(1).map(|row| row.split(',').map(|cell| cell.parse().expect("a number")).collect()).collect();
    move |name| {
        let at = names.iter().position(|other| other == name).unwrap_or_else(|| panic!("no {name} in {names:?}"));
        rows.iter().map(|row| row[at]).collect()
    }
}

/// 61.2048588757684 rad/s at 102.4033°; and with what a failing check names the cam passes.
#[test]
fn the_jump_speed_is_as_known_and_its_remedy_holds() {
    let soft = KNOWN.replace("600 N", "120 N");
    let report = told(&soft);
    let jump = found(&report, "jump_speed");
    near(number(&jump["value"]), 584.463_349_879_224_3, 1e-14);
    near(number(&jump["cam_deg"]), 102.4033, 1e-6);
    near(number(&report["dynamics"]["jump_rpm"]) * TAU / 60.0, 61.204_858_875_768_4, 1e-14);
    assert_eq!((jump["verdict"].as_str(), number(&jump["limit"])), (Some("pass"), 300.0));

    let quick = soft.replace("rpm = 300", "rpm = 700");
    let report = told(&quick);
    for check in ["jump_speed", "force_closure"] {
        assert_eq!(found(&report, check)["verdict"], "fail", "{check}");
    }
    let note = found(&report, "jump_speed")["note"].as_str().expect("a remedy").to_owned();
    let (key, _) = note.split_once(" would hold it").expect(&note);
    let preload = key.strip_prefix("follower.roller.").expect(key);
    let held = told(&quick.replace("mass = \"2.5 kg\"", &format!("mass = \"2.5 kg\"\n{preload}")));
    for check in ["jump_speed", "force_closure"] {
        assert_eq!(found(&held, check)["verdict"], "pass", "{preload}: {held}");
    }

    let margin = told(&format!("{soft}[limits]\njump_margin = 2\n"));
    assert_eq!(found(&margin, "jump_speed")["verdict"], "fail");
    let still = told(&soft.replace("rpm = 300\n", ""));
    assert_eq!(found(&still, "jump_speed")["verdict"], "info");
    near(number(&found(&still, "jump_speed")["value"]), 584.463_349_879_224_3, 1e-14);
    let light = told(&soft.replace("mass = \"2.5 kg\"\n", ""));
    assert!(found(&light, "jump_speed")["note"].as_str().is_some_and(|note| note.contains("mass is not given")));
}

/// With a damper the follower leaves the cam where the least of m ω² s'' + c ω s' + k s + F0 of the table is 0.
#[test]
fn a_damped_follower_jumps_where_its_least_force_is_none() {
    let damped = KNOWN.replace("600 N", "120 N") + "damping = \"60 N*s/m\"\n";
    let speed = number(&found(&told(&damped), "jump_speed")["value"]);
    assert!(speed < 700.0, "{speed}");
    let least = |rpm: f64| {
        number(&found(&told(&damped.replace("rpm = 300", &format!("rpm = {rpm}"))), "force_closure")["value"])
    };
    assert!(least(speed).abs() < 1e-6, "{}", least(speed));
    assert!(least(0.99 * speed) > 0.0 && least(1.01 * speed) < 0.0);
}

/// Mean 0, 21.6 J = k h²/2 + F0 h; the flywheel from these; the mean spin of the roller.
#[test]
fn torque_work_and_spin_are_as_known() {
    let report = told(&format!("{KNOWN}[flywheel]\nfluctuation = 0.02\n"));
    let dynamics = &report["dynamics"];
    assert_eq!(number(&dynamics["torque_mean_nm"]), 0.0);
    near(number(&dynamics["work_fluctuation_j"]), 21.6, 1e-13);
    let speed = 300.0 * TAU / 60.0;
    near(number(&dynamics["flywheel_kg_m2"]), 21.6 / (0.02 * speed * speed), 1e-12);
    near(number(&dynamics["power_max_w"]), speed * number(&dynamics["torque_max_nm"]), 1e-14);
    near(number(&report["cam"]["roller_turns"][0]), 4.639_175_794_751_565, 1e-14);
    // A damper takes c ω ∮s'² dθ/2π: by the table of velocities, whose sum over a turn is exact but for its jumps of the jerk.
    let damped = format!("{KNOWN}damping = \"100 N*s/m\"\n");
    let square: f64 = columns(&damped, 360)("velocity_mm_per_rad").iter().map(|v| v * v * 1e-6).sum();
    near(number(&told(&damped)["dynamics"]["torque_mean_nm"]), 100.0 * speed * square / 360.0, 1e-6);
}

/// Of each follower that swings: the torque by the work of the moment, and the force along the normal by the work of that force, whose
/// travel is that of the profile's point along its normal, from positions in the table alone.
#[test]
fn forces_of_swinging_followers_do_the_work_of_their_moment() {
    // The tangent by neighbouring points is exact to the square of their distance.
    const ROWS: usize = 3600;
    let speed = 300.0 * TAU / 60.0;
    for (follower, leading) in [(LEVER, false), (LEVER, true), (FACE, false), (FACE, true)] {
        let follower = if leading { format!("{follower}\nside = \"leading\"") } else { follower.to_owned() };
        let column = columns(&swinging(&follower, TORSION), ROWS);
        let [lift, velocity, acceleration] =
            ["lift_deg", "velocity_rad_per_rad", "acceleration_rad_per_rad2"].map(&column);
        let [torque, contact] = ["torque_nm", "contact_force_n"].map(&column);
        let [x, y] = ["profile_x_mm", "profile_y_mm"].map(&column);
        for i in 0..ROWS {
            let moment =
                42.0 + 50.0 * lift[i].to_radians() + 0.3 * speed * velocity[i] + 0.03 * speed * speed * acceleration[i];
            near(torque[i], moment * velocity[i], 1e-11);
            // The lever of the normal about the shaft: N (x t_x + y t_y) is the torque of the force on the cam.
            let (before, after) = ((i + ROWS - 1) % ROWS, (i + 1) % ROWS);
            let (tx, ty) = (x[after] - x[before], y[after] - y[before]);
            let lever = 1e-3 * (x[i] * tx + y[i] * ty) / tx.hypot(ty);
            assert!(
                (contact[i] * lever - torque[i]).abs() < 2e-3,
                "{follower} at {i}: {} {}",
                contact[i] * lever,
                torque[i]
            );
        }
        let report = told(&swinging(&follower, TORSION));
        for check in ["force_closure", "contact_stress", "jump_speed"] {
            assert_eq!(found(&report, check)["verdict"], "pass", "{follower}: {}", found(&report, check));
        }
    }
}

/// N (cos α − μ Σ|R|/N) = F while it is lifted, and the work of shaft and friction balance: the mean torque is what friction takes.
#[test]
fn friction_of_a_guide_takes_its_work_and_may_jam() {
    let guided = format!("{KNOWN}{GUIDE}");
    let column = columns(&guided, 360);
    let [contact, path, angle, velocity, torque] =
        ["contact_force_n", "roller_force_n", "pressure_angle_deg", "velocity_mm_per_rad", "torque_nm"].map(&column);
    let mut taken = 0.0;
    for i in 0..360 {
        let alpha = angle[i].to_radians();
        let friction = 0.15 * alpha.sin().abs() * 2.0;
        let sign = if velocity[i] < 0.0 { -1.0 } else { 1.0 };
        // A row where the follower begins to go down belongs to the way down.
        if velocity[i] != 0.0 {
            near(contact[i] * (alpha.cos() - sign * friction), path[i], 1e-12);
            near(torque[i], 1e-3 * contact[i] * alpha.cos() * velocity[i], 1e-12);
        }
        taken += contact[i] * friction * (1e-3 * velocity[i]).abs() / 360.0;
    }
    let report = told(&guided);
    near(number(&report["dynamics"]["torque_mean_nm"]), taken, 1e-3);
    assert_eq!(found(&report, "guide")["verdict"], "pass");
    let jammed = told(
        &guided
            .replace("0.15", "0.8")
            .replace("overhang = \"30 mm\"", "overhang = \"90 mm\"")
            .replace("\"55 mm\"", "\"15 mm\""),
    );
    let found = found(&jammed, "guide");
    assert_eq!(found["verdict"], "fail", "{found}");
    assert!(found["note"].as_str().is_some_and(|note| note.contains("guide.span")), "{found}");
    assert!(finding(&told(KNOWN), "guide").is_none());
}

/// Values of 40-digit arithmetic, and what the waves of the known program are.
#[test]
fn vibration_is_as_known() {
    let report = told(&format!("{KNOWN}{TRAIN}damping = 0.1\n"));
    let movements = report["vibration"]["movements"].as_array().expect("movements");
    assert_eq!(movements.len(), 2);
    let rise = &movements[0];
    assert_eq!((number(&rise["from_deg"]), number(&rise["to_deg"])), (0.0, 120.0));
    near(number(&rise["period_ratio"]), 2.5, 1e-14);
    near(number(&rise["residual"]), 0.029_147_440_745_917_69, 1e-13);
    assert!(number(&rise["residual_worst"]) >= number(&rise["residual"]));
    let check = found(&report, "vibration");
    assert_eq!((check["verdict"].as_str(), &check["value"]), (Some("info"), &rise["residual"]));
    let harmonics = &report["harmonics"];
    near(number(&harmonics["mean"]), 13.75, 1e-14);
    assert_eq!(harmonics["cos"].as_array().map(Vec::len), Some(20));
    near(number(&harmonics["sin"][4]), 0.057_752_858_655_138_32, 1e-12);
    let orders: Vec<f64> =
        report["vibration"]["resonances"].as_array().expect("some").iter().map(|at| number(&at["order"])).collect();
    assert_eq!(orders, [8.0, 7.0]);

    let limited = format!("{KNOWN}{TRAIN}[limits]\nresidual = 0.01\n");
    assert_eq!(found(&told(&limited), "vibration")["verdict"], "fail");
    let still = told(&limited.replace("rpm = 300\n", ""));
    assert!(found(&still, "vibration")["note"].as_str().is_some_and(|note| note.contains("motion.rpm")));
    let absent = told(KNOWN);
    assert!(finding(&absent, "vibration").is_none() && absent["vibration"].is_null() && absent["harmonics"].is_null());
}

/// The deviation turn after turn, against the moving load followed step by step until nothing changes.
#[test]
fn the_deviation_is_that_of_a_load_that_is_followed() {
    let text = format!("{KNOWN}{TRAIN}damping = 0.15\n");
    let column = columns(&text, 360);
    let lift = column("lift_mm");
    // Between samples of a degree the lift is straight, and the load moves by the closed form of one step.
    let (steps, ratio, damping) = (360, 7.5, 0.15);
    let step = TAU / 360.0;
    let (mut x, mut v, mut largest) = (0.0_f64, 0.0_f64, 0.0_f64);
    let fine = 200;
    for turn in 0..12 {
        for i in 0..steps {
            let (from, to) = (lift[i], lift[(i + 1) % steps]);
            for j in 0..fine {
                let y = from + (to - from) * (f64::from(j) + 0.5) / f64::from(fine);
                let h = step / f64::from(fine);
                // Velocity first, then place: symplectic, with an error of the first order in h.
                v += h * (ratio * ratio * (y - x) - 2.0 * damping * ratio * v);
                x += h * v;
                if turn == 11 {
                    largest = largest.max((x - y).abs());
                }
            }
        }
    }
    near(number(&told(&text)["vibration"]["deviation_max"]), largest, 3e-3);
}

/// A crown presses harder than a straight rim, the harder the smaller its radius; a thickness is not asked for.
#[test]
fn a_crowned_roller_touches_in_an_ellipse() {
    let stress = |crown: &str| {
        let text = KNOWN.replace("radius = \"15 mm\"", &format!("radius = \"15 mm\"\n{crown}"));
        number(&found(&told(&text.replace("thickness = \"15 mm\"\n", "")), "contact_stress")["value"])
    };
    let (flat, round) = (stress("crown_radius = \"2 m\""), stress("crown_radius = \"200 mm\""));
    let line = number(&found(&told(KNOWN), "contact_stress")["value"]);
    assert!(line < flat && flat < round, "{line} {flat} {round}");
}

#[test]
fn what_does_not_fit_the_follower_is_told_at_its_place() {
    for (text, parts) in [
        (
            KNOWN.replace("8 N/mm", "8 N*m/rad"),
            &[
                "spring.rate is a torsional stiffness",
                "[follower.roller] moves on a straight path",
                "N/mm",
                "cam.toml:27:8",
            ][..],
        ),
        (
            swinging(LEVER, "[spring]\npreload = \"20 N\"\n"),
            &["spring.preload is a force", "[follower.swinging-roller] swings", "N*m"],
        ),
        (swinging(LEVER, GUIDE), &["a guide belongs to a straight path", "[follower.swinging-roller] swings"]),
        (KNOWN.replace("8 N/mm", "8 N"), &["`N` is a unit of force", "stiffness or torsional stiffness"]),
        (KNOWN.replace("8 N/mm", "-8 N/mm"), &["`spring.rate` must be at least 0 N/mm"]),
        (format!("{KNOWN}{TRAIN}damping = 1.5\n"), &["`vibration.damping` must be at most"]),
        (format!("{KNOWN}[vibration]\nnatural_frequency = \"40 s\"\n"), &["not of frequency", "Hz, kHz"]),
        (format!("{KNOWN}[guide]\nfriction = 0.1\n"), &["missing key `guide.span`"]),
    ] {
        let run = make(&text, &[]);
        assert_eq!(run.code, 2, "{parts:?}: {}{}", run.out, run.err);
        for part in parts {
            assert!(run.err.contains(part), "no {part:?} in\n{}", run.err);
        }
        assert_eq!(files(run.directory.path()), ["cam.toml"]);
    }
}

/// What is not given is not run, costs nothing, and is said.
#[test]
fn what_is_not_given_is_said() {
    let bare = told(
        &KNOWN.replace("mass = \"2.5 kg\"\n", "").replace("[spring]\nrate = \"8 N/mm\"\npreload = \"600 N\"\n", ""),
    );
    let closure = found(&bare, "force_closure");
    assert_eq!(closure["verdict"], "info");
    assert!(closure["note"].as_str().is_some_and(|note| note.contains("[spring]")), "{closure}");
    for check in ["jump_speed", "vibration", "guide"] {
        assert!(finding(&bare, check).is_none(), "{check}");
    }
    assert!(bare["dynamics"].is_null());
    let still = told(&KNOWN.replace("rpm = 300\n", ""));
    assert!(still["dynamics"]["power_max_w"].is_null(), "{}", still["dynamics"]);
    near(number(&still["dynamics"]["work_fluctuation_j"]), 21.6, 1e-13);
}

/// The machines to start from have forces, under every kind of carrier.
#[test]
fn embedded_programs_have_forces() {
    for name in ["feeder", "lever", "valve"] {
        let run = camgen(&["make", name, "--dry-run", "--json"]);
        assert_eq!(run.code, 0, "{name}: {}", run.err);
        let report = report(&run);
        for check in ["force_closure", "jump_speed", "contact_stress"] {
            assert_eq!(found(&report, check)["verdict"], "pass", "{name}: {check}");
        }
        assert!(number(&report["dynamics"]["torque_max_nm"]) > 0.0, "{name}");
    }
}
