//! Every key of the table: it reaches the machine, it is described, and templates, machine files and the schema have it.

use super::*;
use crate::press::MachineOfPress;
use std::collections::BTreeSet;

/// Every key with a value that is not the one it has in the profile, default or absence.
const OTHERS: &[(&str, &str)] = &[
    ("name", "another"),
    ("bed.mass", "900 kg"),
    ("bed.crank_radius", "170 mm"),
    ("bed.crank_turns_per_main_shaft_turn", "2"),
    ("linkage.kind", "crank-slider"),
    ("linkage.rod_ratio", "4"),
    ("linkage.rod", "600 mm"),
    ("linkage.offset_ratio", "0.1"),
    ("linkage.offset", "10 mm"),
    ("linkage.base_ratio", "0.2"),
    ("linkage.coupler_ratio", "0.9"),
    ("linkage.follower_ratio", "0.7"),
    ("linkage.follower_angle", "170 deg"),
    ("linkage.base_angle", "10 deg"),
    ("linkage.driving_crank", "200 mm"),
    ("buffer.polytropic_exponent", "1.4"),
    ("buffer.ambient_pressure", "1.1 at"),
    ("buffer.end_pressure", "3 at"),
    ("buffer.column", "200 mm"),
    ("buffer.lead", "1 mm"),
    ("buffer.expansion_exponent", "1.38"),
    ("buffer.balance", "level"),
    ("buffer.leak", "2 %"),
    ("buffer.piston_friction", "3 %"),
    ("bed.friction", "400 N"),
    ("cam.train_stiffness", "2e8 N/m"),
    ("cam.compensate_train", "true"),
    ("cam.play", "0.2 mm"),
    ("cam.hardness", "500"),
    ("compensator.rpm", "[22, 28]"),
    ("limits.life", "2e8"),
    ("design.rpm", "30"),
    ("motion.rpm", "120"),
    ("motion.start", "5 mm"),
    ("motion.at", "10 deg"),
    ("motion.repeat", "2"),
    ("motion.stroke", "110 mm"),
    ("motion.measured_at", "roller"),
    ("motion.output_arm", "160 mm"),
    ("motion.formula", "9*(1-cos(th))"),
    ("motion.points", "[[0 deg, 0 mm], [120 deg, 21 mm], [240 deg, 5 mm]]"),
    ("motion.degree", "3"),
    ("motion.table", "other.csv"),
    ("motion.columns", "[1, 3]"),
    ("motion.unit", "in"),
    ("motion.scale", "2"),
    ("motion.ratio", "0.9"),
    ("motion.step", "50 deg"),
    ("motion.lift", "9 mm"),
    ("motion.over", "300 deg"),
    ("motion.mirror", "true"),
    ("motion.rest", "dwell"),
    ("motion.shape", "monotonic"),
    ("motion.smooth", "1 mm"),
    ("motion.fourier.cos", "[-9]"),
    ("motion.fourier.sin", "[2]"),
    ("motion.polydyne.natural_frequency", "50 Hz"),
    ("motion.polydyne.damping", "0.1"),
    ("motion.polydyne.rpm", "130"),
    ("motion.segment[0].law", "harmonic"),
    ("motion.segment[0].over", "170 deg"),
    ("motion.segment[0].until", "170 deg"),
    ("motion.segment[0].to", "10 mm"),
    ("motion.segment[0].by", "10 mm"),
    ("motion.segment[0].start", "free"),
    ("motion.segment[0].velocity", "1 mm/deg"),
    ("motion.segment[0].acceleration", "2 mm/rad2"),
    ("motion.segment[0].jerk", "3 mm/rad3"),
    ("motion.segment[0].end", "turn"),
    ("motion.segment[0].inflection", "0.4"),
    ("motion.segment[0].fractions", "[0.3, 0.2, 0.3, 0.2]"),
    ("motion.segment[0].line", "0.4"),
    ("motion.segment[0].amplitudes", "[7, 1, -2]"),
    ("motion.segment[0].ramp", "0.2"),
    ("motion.segment[0].formula", "x^4"),
    ("motion.segment[0].points", "[[30 deg, 4 mm], [60 deg, 16 mm]]"),
    ("motion.segment[0].table", "other-law.csv"),
    ("motion.segment[0].ends", "rest"),
    ("motion.segment[0].shape", "monotonic"),
    ("motion.segment[0].smooth", "1 mm"),
    ("motion.segment[0].minimise", "peak-jerk"),
    ("motion.segment[0].degree", "11"),
    ("motion.segment[0].ratio", "3.7"),
    ("motion.segment[0].robust", "true"),
    ("follower.roller.radius", "25 mm"),
    ("follower.roller.offset", "5 mm"),
    ("follower.roller.mass", "40 kg"),
    ("follower.roller.preload", "1600 N"),
    ("follower.roller.load_rating", "80 kN"),
    ("follower.roller.crown", "cylinder"),
    ("follower.roller.width", "20 mm"),
    ("follower.roller.crown_radius", "400 mm"),
    ("follower.roller.diameter", "50 mm"),
    ("follower.roller.crown_diameter", "800 mm"),
    ("follower.swinging-roller.radius", "20 mm"),
    ("follower.swinging-roller.arm", "100 mm"),
    ("follower.swinging-roller.pivot_distance", "150 mm"),
    ("follower.swinging-roller.side", "leading"),
    ("follower.swinging-roller.inertia", "0.03 kg*m2"),
    ("follower.swinging-roller.crown_radius", "400 mm"),
    ("follower.swinging-roller.diameter", "40 mm"),
    ("follower.swinging-roller.crown_diameter", "800 mm"),
    ("follower.roller.bearing.dynamic_rating", "21 kN"),
    ("follower.roller.bearing.static_rating", "23 kN"),
    ("follower.roller.bearing.exponent", "3"),
    ("follower.roller.bearing.limiting_speed", "5000"),
    ("follower.roller.bearing.inertia", "0.00003 kg*m2"),
    ("follower.roller.bearing.friction", "0.05"),
    ("follower.swinging-roller.bearing.dynamic_rating", "21 kN"),
    ("follower.swinging-roller.bearing.static_rating", "23 kN"),
    ("follower.swinging-roller.bearing.exponent", "3"),
    ("follower.swinging-roller.bearing.limiting_speed", "5000"),
    ("follower.swinging-roller.bearing.inertia", "0.00003 kg*m2"),
    ("follower.swinging-roller.bearing.friction", "0.05"),
    ("follower.flat.tilt", "10 deg"),
    ("follower.flat.offset", "5 mm"),
    ("follower.flat.width", "50 mm"),
    ("follower.flat.mass", "40 kg"),
    ("follower.flat.preload", "1600 N"),
    ("follower.swinging-flat.pivot_distance", "160 mm"),
    ("follower.swinging-flat.face_offset", "5 mm"),
    ("follower.swinging-flat.side", "leading"),
    ("follower.swinging-flat.width", "50 mm"),
    ("follower.swinging-flat.inertia", "0.03 kg*m2"),
    ("follower.knife.offset", "5 mm"),
    ("follower.knife.mass", "40 kg"),
    ("follower.knife.preload", "1600 N"),
    ("spring.rate", "9 N/mm"),
    ("spring.preload", "130 N"),
    ("spring.damping", "30 N*s/m"),
    ("spring.load", "-20 N"),
    ("guide.friction", "0.2"),
    ("guide.span", "70 mm"),
    ("guide.overhang", "20 mm"),
    ("vibration.natural_frequency", "50 Hz"),
    ("vibration.damping", "0.05"),
    ("vibration.damping_against", "follower"),
    ("flywheel.fluctuation", "0.01"),
    ("as_made.roller_radius", "3 um"),
    ("as_made.centre_distance", "-20 um"),
    ("as_made.offset", "20 um"),
    ("as_made.eccentricity", "15 um"),
    ("as_made.eccentricity_at", "40 deg"),
    ("as_made.angle", "0.1 deg"),
    ("as_made.wear", "5 um"),
    ("as_made.waviness", "2 um"),
    ("as_made.waves_from", "20"),
    ("as_made.waves_to", "60"),
    ("as_made.draw", "0.7"),
    ("as_made.speed", "1 %"),
    ("as_made.load", "-2 %"),
    ("cam.cam_turns_per_crank_turn", "0.5"),
    ("cam.lever", "2"),
    ("cam.base_radius", "90 mm"),
    ("cam.thickness", "20 mm"),
    ("cam.bore_radius", "20 mm"),
    ("cam.material", "bronze"),
    ("cam.contact_limit", "900 MPa"),
    ("cam.base_diameter", "180 mm"),
    ("cam.bore_diameter", "40 mm"),
    ("cam.balance", "40 mm .. 85 mm"),
    ("cam.profile_tolerance", "0.05 mm"),
    ("cam.hub.diameter", "70 mm"),
    ("cam.hub.length", "22 mm"),
    ("cam.hub.side", "both"),
    ("cam.timing_mark.form", "line"),
    ("cam.timing_mark.angle", "20 deg"),
    ("cam.timing_mark.circle_diameter", "90 mm"),
    ("cam.timing_mark.diameter", "7 mm"),
    ("cam.timing_mark.fit", "H7"),
    ("cam.timing_mark.length", "9 mm"),
    ("cam.timing_mark.depth", "3 mm"),
    ("cam.chamfer", "2 mm"),
    ("cam.split", "80 deg"),
    ("cam.holes[0].diameter", "7 mm"),
    ("cam.holes[0].circle_diameter", "90 mm"),
    ("cam.holes[0].count", "3"),
    ("cam.holes[0].angle", "20 deg"),
    ("cam.holes[0].fit", "H7"),
    ("cam.holes[0].purpose", "timing"),
    ("cam.rotation", "ccw"),
    ("cam.body", "conjugate"),
    ("cam.outer_radius", "190 mm"),
    ("cam.blank_radius", "180 mm"),
    ("cam.clearance", "0.1 mm"),
    ("cam.clearance_share", "0.5"),
    ("cam.groove_depth", "8 mm"),
    ("cam.roller_height", "7 mm"),
    ("cam.blank_length", "90 mm"),
    ("cam.roller_half_angle", "12 deg"),
    ("cam.turret_distance", "125 mm"),
    ("cam.arm", "69 mm"),
    ("cam.rollers", "9"),
    ("cam.advance", "2"),
    ("cam.rests_on", "groove"),
    ("cam.end_angle", "50 deg"),
    ("cam.turret_inertia", "0.3 kg*m2"),
    ("cam.roller_distance", "50 mm"),
    ("cam.breadth", "150 mm"),
    ("cam.length", "170 mm"),
    ("cam.height", "60 mm"),
    ("cam.run_in", "30 mm"),
    ("cam.drive_angle", "12 deg"),
    ("cam.counter.radius", "19 mm"),
    ("cam.counter.diameter", "37 mm"),
    ("cam.counter.arm", "90 mm"),
    ("cam.counter.distance", "200 mm"),
    ("cam.counter.included_angle", "80 deg"),
    ("cam.counter.preload", "90 N"),
    ("cam.keyway.width", "9 mm"),
    ("cam.keyway.depth", "4 mm"),
    ("cam.keyway.angle", "90 deg"),
    ("cam.keyway.fit", "P9"),
    ("cam.bore_fit", "F7"),
    ("transition.kind", "blend"),
    ("transition.width", "10 deg"),
    ("translating.roller_arm", "200 mm"),
    ("translating.bottom_arm", "200 mm"),
    ("translating.delta", "80 deg"),
    ("translating.friction_angle", "2 deg"),
    ("translating.efficiency", "0.9"),
    ("translating.efficiency_model", "printed"),
    ("translating.balance", "braking"),
    ("translating.roller_radius", "20 mm"),
    ("translating.roller_diameter", "40 mm"),
    ("translating.plate_height", "130 mm"),
    ("conoid.axial_travel", "100 mm"),
    ("conoid.mode", "fixed"),
    ("conoid.shift", "square"),
    ("conoid.overhang", "3 mm"),
    ("compensator.spring_rate", "90 N/mm"),
    ("compensator.preload", "9 kN"),
    ("compensator.roller_radius", "20 mm"),
    ("compensator.roller_diameter", "40 mm"),
    ("compensator.base_diameter", "180 mm"),
    ("compensator.base_radius", "90 mm"),
    ("compensator.angle", "90 deg"),
    ("compensator.mass", "40 kg"),
    ("shaft.beam", "euler"),
    ("shaft.cam_at", "140 mm"),
    ("shaft.drive_at", "10 mm"),
    ("shaft.compensate", "true"),
    ("shaft.segment[0].length", "310 mm"),
    ("shaft.segment[0].diameter", "60 mm"),
    ("shaft.segment[0].bore", "10 mm"),
    ("shaft.segment[0].material", "bronze"),
    ("shaft.segment[0].modulus", "200 GPa"),
    ("shaft.segment[0].density", "7800 kg/m3"),
    ("shaft.segment[0].poisson", "0.31"),
    ("shaft.support[0].at", "30 mm"),
    ("shaft.support[0].stiffness", "rigid"),
    ("shaft.disc[0].at", "100 mm"),
    ("shaft.disc[0].mass", "3 kg"),
    ("shaft.disc[1].diameter", "130 mm"),
    ("shaft.disc[1].bore", "20 mm"),
    ("shaft.disc[1].width", "30 mm"),
    ("shaft.disc[1].material", "bronze"),
    ("shaft.disc[0].diametral_inertia", "0.003 kg*m2"),
    ("shaft.disc[0].polar_inertia", "0.003 kg*m2"),
    ("shaft.disc[0].unbalance", "10 g*mm"),
    ("shaft.disc[2].angle", "10 deg"),
    ("regimes.rpm", "[20, 25]"),
    ("regimes.reset", "half"),
    ("spring_buffer.stiffness", "100 N/mm"),
    ("spring_buffer.body.index", "8"),
    ("spring_buffer.body.stress", "600 MPa"),
    ("spring_buffer.body.wire", "17 mm"),
    ("spring_buffer.body.coil", "100 mm"),
    ("scatter.polytropic_exponent", "0.04"),
    ("scatter.ambient_pressure", "2 %"),
    ("scatter.mass", "4 %"),
    ("scatter.speed", "2 %"),
    ("scatter.column", "2 mm"),
    ("scatter.lead", "0.3 mm"),
    ("scatter.air_lost", "2 %"),
    ("scatter.closing_pressure", "2 %"),
    ("scatter.phase", "0.2 deg"),
    ("scatter.screw", "0.2 mm"),
    ("scatter.distribution", "normal"),
    ("scatter.samples", "100"),
    ("scatter.seed", "2"),
    ("scatter.reset", "level"),
    ("limits.pressure_angle", "29 deg"),
    ("limits.pressure_angle_return", "40 deg"),
    ("limits.min_convex_pitch_radius_over_roller", "3"),
    ("limits.min_convex_radius", "5 mm"),
    ("limits.cutter_radius", "9 mm"),
    ("limits.cutter_diameter", "18 mm"),
    ("limits.wall", "4 mm"),
    ("limits.size", "1 m"),
    ("limits.column", "1 m"),
    ("limits.pivot_clearance", "20 mm"),
    ("limits.contact_stress", "1200 MPa"),
    ("limits.residual_share", "0.02"),
    ("limits.acceleration_share", "0.02"),
    ("limits.continuity", "2"),
    ("limits.jump_margin", "1.5"),
    ("limits.residual", "0.005"),
    ("limits.roller_life", "30000"),
    ("limits.overshoot", "0.2 mm"),
    ("limits.transmission_angle", "40 deg"),
    ("limits.rod_angle", "25 deg"),
    ("limits.link_ratio", "0.6"),
    ("limits.critical_speed_ratio", "0.6"),
    ("limits.lift_error", "0.2 mm"),
    ("limits.support_slope", "0.002 rad"),
    ("limits.balance_grade", "6.3"),
    ("title.owner", "Works"),
    ("title.part_number", "7"),
    ("title.revision", "B"),
    ("title.date", "2026-01-02"),
    ("title.designer", "A. B."),
    ("title.approved", "C. D."),
    ("title.general_tolerance", "ISO 2768-fH"),
    ("title.surface_roughness", "Ra 1.6"),
    ("title.hardness", "60 HRC"),
    ("title.case_depth", "1 mm"),
    ("title.heat_treatment", "nitrided"),
    ("title.edges", "sharp"),
    ("title.profile_tolerance", "0.04 mm"),
    ("title.lift_tolerance", "0.05 mm"),
    ("cut.controller", "heidenhain"),
    ("cut.form", "polar"),
    ("cut.decimals", "5"),
    ("cut.header", "[\"G55\"]"),
    ("cut.after_tool", "[\"M1\"]"),
    ("cut.footer", "[\"M1\"]"),
    ("cut.safe_height", "60 mm"),
    ("cut.coolant", "flood"),
    ("cut.arcs", "false"),
    ("cut.entry", "plunge"),
    ("cut.blank_margin", "5 mm"),
    ("cut.allowance", "0.2 mm"),
    ("cut.finish_passes", "2"),
    ("cut.preamble", "[\"G55\"]"),
    ("cut.postamble", "[\"M2\"]"),
    ("cut.feed", "500 mm/min"),
    ("cut.plunge_feed", "50 mm/min"),
    ("cut.spindle", "1200"),
    ("cut.tool", "7"),
    ("cut.program", "12"),
    ("cut.depth", "8 mm"),
    ("cut.depth_per_pass", "2 mm"),
    ("cut.overrun", "0.5 mm"),
    ("cut.clearance", "20 mm"),
    ("cut.home", "-2 mm"),
    ("cut.direction", "conventional"),
    ("cut.compensation", "control"),
    ("output.units", "inch"),
];

/// A shaft with every part, behind a press.
const SHAFT: &str = "\n[shaft]\ncam_at = \"150 mm\"\n[[shaft.segment]]\nlength = \"300 mm\"\ndiameter = \"50 mm\"\n\
                     [[shaft.support]]\nat = \"20 mm\"\nstiffness = \"5e8 N/m\"\n\
                     [[shaft.support]]\nat = \"280 mm\"\nstiffness = \"5e8 N/m\"\n\
                     [[shaft.disc]]\nat = \"290 mm\"\nmass = \"2 kg\"\ndiametral_inertia = \"0.002 kg*m2\"\npolar_inertia = \"0.002 kg*m2\"\n\
                     [[shaft.disc]]\nat = \"290 mm\"\ndiameter = \"120 mm\"\nwidth = \"20 mm\"\n\
                     [[shaft.disc]]\nat = \"290 mm\"\nmass = \"2 kg\"\nunbalance = \"9 g*mm\"\n";

/// What moves behind a follower on a straight path.
const DYNAMICS: &str = "\n[guide]\nfriction = 0.1\nspan = \"60 mm\"\n[vibration]\nnatural_frequency = \"40 Hz\"\n\
                        [flywheel]\nfluctuation = 0.02\n";

fn every_key() -> Vec<String> {
    catalogue().keys.sections.iter().flat_map(|section| section.keys.iter().map(|key| section.path_of(key))).collect()
}

/// All of a machine but the list of keys that were given. What the follower and the motion are, only their text tells.
fn alike(machine: Machine) -> String {
    format!("{:#?}", machine.without_given())
}

/// Keys that only a globoid has.
const OF_A_TURRET: [&str; 7] = [
    "cam.turret_distance",
    "cam.arm",
    "cam.rollers",
    "cam.advance",
    "cam.rests_on",
    "cam.end_angle",
    "cam.turret_inertia",
];

/// A file of a press and a motion program, with the follower that a key belongs to, or a roller.
fn file_for(path: &str) -> String {
    if OF_A_TURRET.contains(&path) {
        return include_str!("../../../cams/profiles/indexer.toml").to_owned();
    }
    let of = |kind: &&FollowerKind| path.strip_prefix(kind.section.path).is_some_and(|rest| rest.starts_with('.'));
    let of_arc = ["motion.measured_at", "motion.output_arm"].contains(&path);
    let of_arms = ["cam.counter.arm", "cam.counter.included_angle"].contains(&path);
    let usual = if of_arc || of_arms { &FOLLOWERS[1] } else { &FOLLOWERS[0] };
    let section = FOLLOWERS.iter().find(of).unwrap_or(usual).section;
    let required = |key: &Key| match key.presence {
        Required(example) => format!("{} = {}\n", key.name, key.in_toml(example)),
        _ => String::new(),
    };
    let keys: String = section.keys.iter().map(required).collect();
    let press = without(catalogue().embedded[0].toml, "follower.roller");
    // A cylindrical crown asks for a width.
    let width = if section.path == "follower.roller" { "width = \"10 mm\"\n" } else { "" };
    // A rod and an offset as lengths take the place of the ratios.
    let rod = if path == "linkage.rod" { "rod = \"540 mm\"\n" } else { "rod_ratio = 3\n" };
    let drag_link = "base_ratio = 0.1\ncoupler_ratio = 0.8\nfollower_ratio = 0.6\n";
    let six_bar = format!("[linkage]\nkind = \"six-bar\"\n{rod}{drag_link}");
    let linkage = if path.starts_with("linkage.") { six_bar } else { String::new() };
    let compensator = "[compensator]\nspring_rate = \"100 N/mm\"\npreload = \"10 kN\"\n";
    let keyway = "[cam.keyway]\nwidth = \"8 mm\"\ndepth = \"3 mm\"\n";
    // The cam sits on the shaft with its own bore only.
    let press = if path == "shaft.segment[0].diameter" {
        press.replace("bore_radius = \"25 mm\"", "bore_radius = \"30 mm\"")
    } else {
        press
    };
    let shaft = match path {
        _ if path.starts_with("shaft.") => SHAFT,
        _ if path.starts_with("cam.hub.") => "[cam.hub]\ndiameter = \"60 mm\"\nlength = \"20 mm\"\n",
        // Each form has keys of its own.
        "cam.timing_mark.length" => "[cam.timing_mark]\nform = \"line\"\ncircle_diameter = \"80 mm\"\n",
        "cam.timing_mark.depth" => "[cam.timing_mark]\nform = \"notch\"\n",
        _ if path.starts_with("cam.timing_mark.") => "[cam.timing_mark]\ncircle_diameter = \"80 mm\"\n",
        _ if path.starts_with("cam.holes") => "[[cam.holes]]\ndiameter = \"6 mm\"\ncircle_diameter = \"80 mm\"\n",
        _ => "",
    };
    let bearing = path
        .rsplit_once(".bearing.")
        .map_or(String::new(), |(own, _)| format!("[{own}.bearing]\ndynamic_rating = \"20 kN\"\n"));
    // Wire and coils are given together, in the place of the index.
    let springs = match path.strip_prefix("spring_buffer.body.") {
        Some("wire" | "coil") => "[spring_buffer.body]\nstress = \"700 MPa\"\nwire = \"18 mm\"\ncoil = \"108 mm\"\n",
        Some(_) => "[spring_buffer.body]\nstress = \"700 MPa\"\n",
        None => "",
    };
    let of_plate = path == "motion.stroke";
    let dynamics = if path.starts_with("follower.") || of_arc || of_arms || of_plate { "" } else { DYNAMICS };
    let press = match path {
        _ if of_plate => press.replace("\n[cam]\n", "\n[cam]\nbody = \"wedge\"\n"),
        "cam.timing_mark.depth" | "cam.timing_mark.form" => {
            press.replace("\n[cam]\n", "\n[cam]\nbody = \"groove\"\ngroove_depth = \"6 mm\"\n")
        }
        _ => press,
    };
    let motion = match FOLLOWERS.iter().find(|kind| kind.section.path == section.path) {
        Some(kind) if kind.swings() && !of_arc => motion_for(path).replace(" mm\"", " deg\""),
        _ => motion_for(path),
    };
    format!(
        "{press}\n{keyway}{linkage}{compensator}{springs}[{}]\n{keys}{width}{bearing}{motion}{dynamics}{shaft}",
        section.path
    )
}

/// A motion program in which a key of a segment means something.
fn motion_for(path: &str) -> String {
    let key = path.rsplit('.').next().unwrap_or_default();
    let form = |keys: &str| format!("\n[motion]\nstart = \"0 mm\"\n{keys}\n");
    let of_law = |law: &str| MOTION.replace("[[motion.segment]]\n", &format!("[[motion.segment]]\nlaw = \"{law}\"\n"));
    match key {
        _ if !path.starts_with("motion") => MOTION.to_owned(),
        "measured_at" | "output_arm" => {
            MOTION.replace("start =", "measured_at = \"output\"\noutput_arm = \"150 mm\"\nstart =")
        }
        "stroke" => PLATE.to_owned(),
        "until" => MOTION.replace("over =", "until ="),
        "by" => MOTION.replacen("to =", "by =", 1),
        "repeat" => MOTION.replace("180 deg", "90 deg"),
        "acceleration" | "jerk" => of_law("polynomial"),
        "start" if path.starts_with("motion.segment") => of_law("polynomial"),
        "fractions" => of_law("scca"),
        "line" => of_law("sine-line"),
        "amplitudes" => of_law("triple-harmonic"),
        "ramp" => of_law("s-curve"),
        "formula" if path.starts_with("motion.segment") => of_law("formula\"\nformula = \"x^2"),
        "formula" => form("formula = \"10*(1-cos(th))\""),
        "points" | "shape" | "smooth" if path.starts_with("motion.segment") => {
            MOTION.replacen("over", "law = \"spline\"\npoints = [[\"50 deg\", \"5 mm\"]]\nover", 1)
        }
        "minimise" | "degree" if path.starts_with("motion.segment") => {
            of_law("polynomial\"\ndegree = 9\nminimise = \"peak-acceleration")
        }
        "points" | "degree" | "rest" | "shape" | "smooth" => form(POINTS),
        "mirror" => form(&format!("{HALF}\nrest = \"dwell\"")),
        "columns" => form("table = \"wide.csv\"\ncolumns = [1, 2]"),
        "table" | "unit" | "scale" if !path.starts_with("motion.segment") => form("table = \"lift.csv\""),
        "ratio" if path == "motion.ratio" => form("table = \"lift.csv\""),
        "step" => form("table = \"list.csv\"\nstep = \"60 deg\"\nrest = \"dwell\""),
        "lift" => form("table = \"shares.csv\"\nlift = \"8 mm\""),
        "over" if path == "motion.over" => form("table = \"turns.csv\"\nover = \"360 deg\"\nrest = \"dwell\""),
        "ratio" | "robust" => of_law("polynomial\"\ndegree = 9\nratio = 2.5\nminimise = \"residual"),
        "table" | "ends" if path.starts_with("motion.segment") => of_law("table\"\ntable = \"law.csv"),
        "natural_frequency" | "damping" | "rpm" if path.starts_with("motion.polydyne") => {
            form("formula = \"10*(1-cos(th))\"\npolydyne = { natural_frequency = \"40 Hz\", rpm = 120 }")
        }
        "cos" | "sin" => form("fourier = { cos = [-10], sin = [1] }"),
        _ => MOTION.to_owned(),
    }
}

/// The motion of a plate.
const PLATE: &str = "\n[motion]\nstroke = \"100 mm\"\nstart = \"0 mm\"\n[[motion.segment]]\nover = \"80 mm\"\nto = \"20 mm\"\n\
                     [[motion.segment]]\nlaw = \"dwell\"\n";

/// Points that end where they begin.
const POINTS: &str =
    "points = [[\"0 deg\", \"0 mm\"], [\"90 deg\", \"9 mm\"], [\"180 deg\", \"5 mm\"], [\"270 deg\", \"0 mm\"]]";

/// Points that are a lobe, or half of one.
const HALF: &str = "points = [[\"0 deg\", \"0 mm\"], [\"40 deg\", \"4 mm\"], [\"80 deg\", \"9 mm\"], [\"120 deg\", \"5 mm\"], [\"160 deg\", \"0 mm\"]]";

/// A text as a machine; one that names tables as a file beside them.
fn read(text: &str, sets: &[String]) -> Result<Machine, MachineError> {
    if !text.contains(".csv\"") {
        return Machine::from_toml("press.toml", text, sets);
    }
    let folder = tempfile::tempdir().expect("a folder");
    let turns = [("lift.csv", "0,0\n90,9\n200,3\n"), ("other.csv", "0,0\n90,8\n200,3\n360,0\n")];
    let more = [
        ("wide.csv", "0,0,1\n90,9,8\n200,3,4\n"),
        ("list.csv", "0\n4\n9\n3\n0\n"),
        ("shares.csv", "0,0\n90,1\n200,0.3\n"),
        ("turns.csv", "0,0\n0.2,3\n0.5,9\n0.8,4\n1,0\n"),
    ];
    let laws = [("law.csv", "0 0\n0.4 0.5\n1 1\n"), ("other-law.csv", "0 0\n0.4 0.6\n1 1\n")];
    for (name, rows) in turns.into_iter().chain(more).chain(laws).chain([("press.toml", text)]) {
        std::fs::write(folder.path().join(name), rows).expect("written");
    }
    Machine::load(&folder.path().join("press.toml").display().to_string(), sets).map(|(machine, _)| machine)
}

/// A file without one of its tables.
fn without(text: &str, table: &str) -> String {
    let header = format!("[{table}]");
    let mut inside = false;
    let kept = text.lines().filter(|line| {
        if line.starts_with('[') {
            inside = line.starts_with(&header);
        }
        !inside
    });
    kept.collect::<Vec<_>>().join("\n")
}

#[test]
fn every_key_of_the_table_reaches_the_machine() {
    let open = |key: &str| ["[0]", "[1]", "[2]"].iter().fold(key.to_owned(), |key, index| key.replace(index, "[]"));
    let mut keys: Vec<String> = OTHERS.iter().map(|(key, _)| open(key)).collect();
    // A drive and a brake are read by themselves.
    let of_a_brake = ["limits.tension_spread", "limits.web_stress"];
    let apart = |key: &str| key.starts_with("drive.") || key.starts_with("brake.") || of_a_brake.contains(&key);
    let mut all: Vec<String> = every_key().into_iter().filter(|key| !apart(key)).collect();
    keys.sort();
    all.sort();
    assert_eq!(keys, all);
    for (key, value) in OTHERS {
        let text = file_for(key);
        let with = |sets: &[String]| {
            let text = if sets.is_empty() {
                text.replace("bore_radius = \"30 mm\"", "bore_radius = \"25 mm\"")
            } else {
                text.clone()
            };
            read(&text, sets).unwrap_or_else(|error| panic!("{sets:?}: {error}"))
        };
        let mut sets = vec![format!("{key}={value}")];
        if *key == "motion.start" {
            // A motion ends where it starts.
            sets.push("motion.segment[1].to=5 mm".into());
        }
        // A turn of a globoid moves its turret on by whole rollers; a cam is cut for a train of known stiffness.
        match *key {
            "cam.rollers" => sets.push("motion.segment[0].to=40 deg".into()),
            "cam.compensate_train" => sets.push("cam.train_stiffness=1e8 N/m".into()),
            "cam.advance" => sets.push("motion.segment[0].to=90 deg".into()),
            _ => {}
        }
        let other = with(&sets);
        assert!(other.given().contains(&(*key).to_owned()), "{key}");
        assert_ne!(alike(other), alike(with(&[])), "{key}");
    }
}

#[test]
fn every_word_of_a_key_reads() {
    for section in &catalogue().keys.sections {
        for key in section.keys {
            let (KeyForm::Words(words) | KeyForm::WordsOrQuantity(words, ..)) = key.form else { continue };
            for word in words {
                let path = section.path_of(key);
                // The first disc has a mass, the second a size.
                let index = if path == "shaft.disc[].material" { "[1]" } else { "[0]" };
                let set = format!("{}={word}", path.replace("[]", index));
                // A yoke has no links.
                let text = match *word {
                    _ if OF_A_TURRET.contains(&path.as_str()) => file_for(&path),
                    "globoid" => file_for("cam.rollers").replace("body = \"globoid\"\n", ""),
                    "yoke" => without(&file_for(&path), "linkage"),
                    "residual" => file_for(&path).replace("over =", "ratio = 2.5\nover ="),
                    "pivot" => file_for(&path)
                        .replace("to = \"20 mm\"", "to = \"20 deg\"")
                        .replace("\"0 mm\"\n", "\"0 deg\"\n"),
                    "groove" | "barrel" | "tapered-barrel" => {
                        file_for(&path).replace("\n[cam]\n", "\n[cam]\ngroove_depth = \"5 mm\"\n")
                    }
                    "wedge" => file_for("motion.stroke"),
                    // Its roller runs where a bore would be.
                    "ring" | "rib" => {
                        let text = without(&file_for(&path), "cam.keyway");
                        let text = text.replace("\n[cam]\n", "\n[cam]\nroller_distance = \"90 mm\"\n");
                        text.lines().filter(|line| !line.starts_with("bore_")).collect::<Vec<_>>().join("\n")
                    }
                    "moving" => file_for(&path).replace("over =", "velocity = \"1 mm/deg\"\nover ="),
                    _ => file_for(&path),
                };
                let read = read(&text, std::slice::from_ref(&set));
                assert!(read.is_ok(), "{set}: {}", read.expect_err("a fault"));
            }
        }
    }
}

#[test]
fn every_key_tells_what_it_is_and_for_which_cams() {
    let described =
        |path: &str| catalogue().keys.sections.iter().any(|section| section.path == path && !section.about.is_empty());
    for section in &catalogue().keys.sections {
        // A table may be put together from several; one of them describes it.
        assert!(section.path.is_empty() || described(section.path), "{}", section.path);
        for key in section.keys {
            assert!(!key.about.is_empty() && !key.presence.text().is_empty(), "{}", section.path_of(key));
            for cam in &catalogue().keys.listed(section.cams_of(key)) {
                let known =
                    |name: &&str| kinds().chain(analyses()).any(|kind| kind.command == *name || kind.keys == *name);
                assert!(known(cam), "{}: {cam}", section.path_of(key));
            }
        }
    }
}

#[test]
fn defaults_are_what_they_were() {
    let toml = "name = \"x\"\n[bed]\nmass = \"1 kg\"\ncrank_radius = \"1 m\"\n[buffer]\nambient_pressure = \"1 at\"\n\
                end_pressure = \"2 at\"\n[follower.roller]\nradius = \"30 mm\"\n[translating]\nroller_arm = \"1 m\"\n\
                bottom_arm = \"1 m\"\ndelta = \"90 deg\"\n[conoid]\naxial_travel = \"1 m\"\n";
    let machine = Machine::from_toml("least.toml", toml, &[]).expect("valid");
    let press = machine.press().expect("a press");
    assert_eq!((press.polytropic_exponent, press.column, press.lead), (1.35, AirColumn::Of(ColumnRule::Matched), 0.0));
    assert_eq!((press.bed.crank_turns_per_main_shaft_turn, press.design_rpm), (3.0, 35.0));
    let roller = RollerData { radius: 0.03, offset: 0.0, crown: Crown::Sphere, width: None };
    assert_eq!(machine.roller().expect("a roller"), &roller);
    assert_eq!((machine.follower.mass, machine.follower.preload), (None, None));
    let cams = PressCams::of(&machine);
    assert_eq!((cams.lobes, cams.lever, machine.cam.base_radius), (1, 1.0, None));
    assert_eq!((machine.cam.thickness, machine.cam.material, machine.cam.rotation), (None, None, Rotation::Clockwise));
    assert_eq!(cams.transition, Transition::RunUp { width: std::f64::consts::PI / 9.0 });
    let plate = cams.translating.expect("a plate");
    assert_eq!((plate.friction_angle, plate.efficiency, plate.roller_radius), (0.0, 1.0, 0.03));
    assert_eq!((plate.efficiency_model, plate.plate_height), (EfficiencyModel::Consistent, None));
    let conoid = cams.conoid.expect("a conoid");
    assert_eq!((conoid.mode, conoid.shift, conoid.overhang), (ConoidMode::Adjusted, Shift::Linear, None));
    let limits = machine.limits;
    assert_eq!(limits.pressure_angle, Some(std::f64::consts::PI / 6.0));
    assert_eq!((limits.min_convex_pitch_radius_over_roller, limits.wall), (2.0, None));
    assert_eq!((limits.cutter_radius, limits.contact_stress), (None, None));
}

/// A text with its commented keys and tables live.
fn with_everything(text: &str) -> String {
    let live = |line: &str| {
        let code = line.strip_prefix("# ").unwrap_or(line);
        let table = code.starts_with('[') && code.contains(']');
        let key = code.split_once(" = ").is_some_and(|(name, _)| !name.is_empty() && !name.contains(' '));
        if table || key { code.to_owned() } else { line.to_owned() }
    };
    text.lines().map(live).collect::<Vec<_>>().join("\n")
}

/// A text without the diameters that may be given in the place of radii: both together are a fault.
fn without_diameters(text: &str) -> String {
    let mut table = String::new();
    let kept = text.lines().filter(|line| {
        if let Some(header) = line.strip_prefix('[') {
            table = header.trim_start_matches('[').split(']').next().unwrap_or_default().to_owned();
        }
        let name = line.split(" = ").next().unwrap_or_default();
        let of_table = catalogue().keys.sections.iter().filter(|section| section.path == table);
        !of_table.flat_map(|section| section.keys).any(|key| key.name == name && key.halved.is_some())
    });
    kept.collect::<Vec<_>>().join("\n")
}

#[test]
fn the_template_is_written_from_the_table() {
    let stored = include_str!("../../../../templates/machine.toml");
    let made = template(catalogue());
    assert!(stored == made, "templates/machine.toml should be:\n{made}");
    let machine = Machine::from_toml("template", stored, &[]).expect("it reads");
    let own: Vec<&str> =
        catalogue().embedded[0].toml.lines().filter(|line| !line.trim_start().starts_with("material")).collect();
    let dpi = Machine::from_toml("dpi", &own.join("\n"), &["name=my press".to_owned()]).expect("valid");
    let cams = PressCams { translating: None, conoid: None, ..PressCams::of(&dpi).clone() };
    let mut expected = dpi.with_part(Some(cams));
    expected.cam = CamData { thickness: None, bore_radius: None, material: None, ..expected.cam };
    expected.limits = Limits { cutter_radius: None, wall: None, ..expected.limits };
    assert_eq!(alike(machine), alike(expected));
}

/// The template has the keys of every domain; it and the profiles of presses read with any of their followers.
#[test]
fn template_has_every_key() {
    let sections = catalogue().keys.sections.iter();
    let keys: BTreeSet<String> = sections
        .flat_map(|section| section.keys.iter().filter(|key| key.halved.is_none()).map(|key| section.path_of(key)))
        .collect();
    let template = template(catalogue());
    let presses = catalogue().embedded.iter().filter(|machine| {
        !["\n[drive]", "\n[shaft]", "\n[motion]", "\n[brake]"].iter().any(|table| machine.toml.contains(table))
    });
    let profiles = presses.map(|machine| (machine.name, machine.toml));
    for (name, text) in profiles.chain([("template", template.as_str())]) {
        let text = without_diameters(&with_everything(text));
        // Of a linkage, a shaft and a motion not all keys go together; spring and guide are of a straight path.
        let apart = [
            "spring",
            "guide",
            "cam.counter",
            "linkage",
            "shaft",
            "[shaft.segment]",
            "[shaft.support]",
            "[shaft.disc]",
            "motion",
            "motion.fourier",
            "motion.polydyne",
            "[motion.segment]",
        ];
        let read_with = |text: &str| {
            let text = apart.iter().fold(text.to_owned(), |text, table| without(&text, table));
            Machine::from_toml(name, &text, &[])
        };
        if name == "template" {
            let sections: Vec<KeySection> =
                catalogue().keys.sections.iter().map(|section| KeySection { cams: &[], ..**section }).collect();
            let sections: Vec<&KeySection> = sections.iter().collect();
            let given = Reader::new(name, &text, &[], &sections).given(true);
            let given: BTreeSet<String> = given.iter().map(|key| key.replace("[0]", "[]")).collect();
            let differing: Vec<&String> = given.symmetric_difference(&keys).collect();
            assert!(differing.is_empty(), "in one of the two only: {differing:?}");
        }
        // It reads with any one of its followers.
        let stands = |kind: &&FollowerKind| text.contains(&format!("[{}]", kind.section.path));
        for kind in FOLLOWERS.iter().filter(stands) {
            let others = FOLLOWERS.iter().filter(|other| other.section.path != kind.section.path);
            let text = others.fold(text.clone(), |text, other| {
                without(&without(&text, other.section.path), &format!("{}.bearing", other.section.path))
            });
            read_with(&text).unwrap_or_else(|error| panic!("[{}]: {error}", kind.section.path));
        }
    }
}

#[test]
fn the_schema_has_every_key() {
    let schema = schema(catalogue());
    for path in every_key() {
        let key = path.split('.').fold(&schema, |table, name| match name.strip_suffix("[]") {
            Some(name) => &table["properties"][name]["items"],
            None => &table["properties"][name],
        });
        assert!(key["description"].is_string(), "{path}: {key}");
    }
    // A press is described as a whole or not at all, and a follower by one table of several.
    assert_eq!(schema["required"], serde_json::json!(["name", "follower"]));
    let follower = &schema["properties"]["follower"];
    assert_eq!((&follower["minProperties"], &follower["maxProperties"]), (&1.into(), &1.into()));
    assert_eq!(schema["properties"]["bed"]["required"], serde_json::json!(["mass", "crank_radius"]));
    let either = serde_json::json!({ "oneOf": [{ "required": ["radius"] }, { "required": ["diameter"] }] });
    assert_eq!(schema["properties"]["follower"]["properties"]["roller"]["allOf"][0], either);
    assert_eq!(schema["properties"]["cam"]["additionalProperties"], false);
}

/// Common misspellings of a key: a letter missing, doubled, wrong or swapped, other capitals and signs, the last word shortened.
fn misspellings(path: &str) -> Vec<String> {
    let (table, name) = path.rsplit_once('.').unwrap_or(("", path));
    let letters: Vec<char> = name.chars().collect();
    let middle = letters.len() / 2;
    let replaced = |at: usize, by: &[char]| -> String {
        letters[..at].iter().chain(by).chain(&letters[(at + 1).min(letters.len())..]).collect()
    };
    let mut swapped = letters.clone();
    swapped.swap(middle - 1, middle);
    let (front, last) = name.rsplit_once('_').map_or(("", name), |(front, last)| (front, last));
    let shortened = |length: usize| {
        let short: String = last.chars().take(length).collect();
        if front.is_empty() { short } else { format!("{front}_{short}") }
    };
    let mut all = vec![
        replaced(middle, &[]),
        replaced(middle, &[letters[middle], letters[middle]]),
        replaced(middle, &['q']),
        swapped.into_iter().collect(),
        format!("{name}s"),
        name.to_uppercase(),
        name.replace('_', "-"),
    ];
    if last.len() > 5 {
        all.extend([shortened(3), shortened(4)]);
    }
    all.into_iter().map(|name| if table.is_empty() { name } else { format!("{table}.{name}") }).collect()
}

#[test]
fn misspelt_keys_are_answered_with_the_key_that_was_meant() {
    let keys: Vec<String> = every_key().into_iter().filter(|key| !key.contains('[') && last_letters(key) > 3).collect();
    let (mut asked, mut wrong) = (0, Vec::new());
    for key in &keys {
        for typed in misspellings(key).into_iter().filter(|typed| !every_key().contains(typed)) {
            asked += 1;
            let answer = message(&[&format!("{typed}=1")]);
            if !answer.contains(&format!("`{key}`")) {
                let said = answer.split("did you mean").nth(1).unwrap_or("nothing").trim().to_owned();
                wrong.push(format!("{typed}: {said}"));
            }
        }
    }
    // A shortened word can belong to two keys.
    assert!(asked > 1000 && wrong.len() * 50 < asked, "{} of {asked}:\n{}", wrong.len(), wrong.join("\n"));
}

fn last_letters(key: &str) -> usize {
    key.rsplit('.').next().map_or(0, |name| name.chars().count())
}
