//! Numerical stability at the extremes: closed forms against 60-digit arithmetic over random and log-spaced inputs, and
//! geometry where it degenerates. Every line of the table is a worst case; `cargo test --test stability -- --nocapture`.

#![allow(clippy::expect_used, clippy::panic, clippy::print_stdout, missing_docs, reason = "a test fails loudly")]

#[path = "common/random.rs"]
mod random;

use camgen::buffer::balance::{Balance, Column, column_for};
use camgen::buffer::{Bed, Cylinder, regime};
use camgen::cam::rotary::Rotary;
use camgen::cam::{Curves, Frame, extremes};
use camgen::checks::rolling;
use camgen::drawing::{self, arcs, outline};
use camgen::follower::{Follower, TranslatingRoller};
use camgen::law::{EccentricCircle, Law, Reversal, ReversalLaw, Transition};
use camgen::machine::Machine;
use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use nalgebra::Vector2;
use random::Random;

type Big = FBig<HalfEven, 2>;

fn big(value: f64) -> Big {
    Big::try_from(value).expect("finite").with_precision(200).value()
}

fn number(value: &Big) -> f64 {
    value.to_f64().value()
}

fn ulp(value: f64) -> f64 {
    f64::from_bits(value.abs().to_bits() + 1) - value.abs()
}

/// The worst of a quantity so far, and where.
struct Worst {
    name: &'static str,
    unit: &'static str,
    value: f64,
    place: String,
}

impl Worst {
    fn new(name: &'static str, unit: &'static str) -> Self {
        Self { name, unit, value: 0.0, place: String::new() }
    }

    fn see(&mut self, value: f64, place: impl FnOnce() -> String) {
        assert!(!value.is_nan(), "{}: not a number at {}", self.name, place());
        if value > self.value {
            (self.value, self.place) = (value, place());
        }
    }

    fn told(&self, bound: f64) {
        println!("{:<44} {:>10.3e} {:<14} {}", self.name, self.value, self.unit, self.place);
        assert!(self.value <= bound, "{}: {:e} at {}", self.name, self.value, self.place);
    }
}

/// A buffer anywhere in the legal domain.
struct Sample {
    q: f64,
    k: f64,
    r: f64,
    x: f64,
    loading: f64,
}

fn sample(random: &mut Random) -> Sample {
    let q = 1.0 + random.log_between(1e-8, 200.0);
    let k = if random.next() < 0.2 { 1.0 } else { 1.0 + random.log_between(1e-12, 4.0) };
    let r = random.log_between(1e-4, 2.0);
    let share = random.log_between(1e-14, 1.0);
    let x = if random.next() < 0.5 { r * share } else { r - r * share };
    Sample { q, k, r, x: x.clamp(0.0, r), loading: (q - 1.0) / r }
}

/// (1 + A x)^(−1/k) and A x of the numbers as they are.
fn shrink(loading: f64, k: f64, x: f64) -> (Big, Big) {
    let load = big(loading) * big(x);
    ((-(big(1.0) + &load).ln() / big(k)).exp(), load)
}

/// Δx, its derivatives, the pressure and the columns, 2500 random buffers with matched, returning and given columns.
#[test]
fn the_buffer_over_its_whole_domain() {
    let mut random = Random(3);
    let mut small = Worst::new("Δx for x ≤ 1 mm, matched and return", "ulp of Δx");
    let mut large = Worst::new("Δx beyond, every column", "ulp of L");
    let mut slope = Worst::new("dΔx/dx", "of c");
    let mut second = Worst::new("d²Δx/dx²", "relative");
    let mut third = Worst::new("d³Δx/dx³", "relative");
    let mut pressure = Worst::new("pressure ratio at the balanced bottom", "relative");
    let mut length = Worst::new("column L by (7), L_p by (14)", "relative");
    for _ in 0..2500 {
        let Sample { q, k, r, x, loading } = sample(&mut random);
        let column = match random.next() {
            share if share < 0.35 => Column::Matched,
            share if share < 0.7 => Column::Return,
            _ => Column::Length(k / loading * random.log_between(0.3, 5.0)),
        };
        let balance = Balance::new(loading, k, r, column, 0.0);
        let place =
            || format!("q − 1 = {:.2e}, k − 1 = {:.1e}, r = {r:.2e}, x = {x:.3e}, {column:?}", q - 1.0, k - 1.0);
        let (whole, _) = shrink(loading, k, r);
        let exact_length = match column {
            Column::Matched => big(k) / big(loading),
            Column::Return => big(r) / (big(1.0) - &whole),
            Column::Length(length) => big(length),
        };
        let (part, load) = shrink(loading, k, x);
        let exact = &exact_length * (big(1.0) - &part) - big(x);
        let off = number(&(big(balance.displacement(x)) - &exact)).abs();
        let given = matches!(column, Column::Length(_));
        if x <= 1e-3 && !given && x > 0.0 {
            small.see(off / ulp(number(&exact)), place);
        }
        // Beside half an ulp of the result itself, which exceeds that of L where x is many times L.
        large.see((off - 0.5 * ulp(number(&exact))).max(0.0) / ulp(balance.column), place);

        let base = big(1.0) + &load;
        let c = &exact_length * big(loading) / big(k);
        let power = &part / &base;
        let steeper = big(1.0) / big(k) + big(1.0);
        let got = balance.bottom(x, r - x);
        slope.see(number(&((big(got.slope) - (&c * &power - big(1.0))) / &c)).abs(), place);
        let exact_second = -(&c * big(loading) * &steeper * &power) / &base;
        second.see(number(&((big(got.second) - &exact_second) / &exact_second)).abs(), place);
        let exact_third = -(&exact_second * big(loading) * (&steeper + big(1.0))) / &base;
        third.see(number(&((big(got.third) - &exact_third) / &exact_third)).abs(), place);
        let ratio = balance.pressure_ratio(x, balance.displacement(x));
        pressure.see(number(&((big(ratio) - &base) / &base)).abs(), place);
        let by_7 = column_for(r, loading * r, k);
        let exact_7 = big(r) / (big(1.0) - (-(big(1.0) + big(loading * r)).ln() / big(k)).exp());
        length.see(number(&((big(by_7) - &exact_7) / &exact_7)).abs(), place);
    }
    println!("{:<44} {:>10} {:<14} where", "quantity", "worst", "in");
    // Half an ulp is what rounding the exact result costs; the goal is 2.
    small.told(0.51);
    large.told(2.0);
    slope.told(1e-14);
    second.told(1e-14);
    third.told(2e-14);
    pressure.told(1e-14);
    length.told(1e-14);
}

/// The reset column and the added volume (14), (15) between 1 % and 10 times the design speed.
#[test]
fn the_reset_at_other_speeds() {
    let mut random = Random(5);
    let mut volume = Worst::new("V_add by (15)", "of 2 F L");
    let bed = Bed { mass: 978.2, crank_radius: 0.18, crank_turns_per_main_shaft_turn: 3.0 };
    for _ in 0..400 {
        let (q, k) = (1.0 + random.log_between(1e-3, 50.0), 1.0 + random.log_between(1e-3, 1.0));
        let cylinder = Cylinder::sized(&bed, 35.0, k, 98_066.5, q * 98_066.5);
        let design = Balance::new(cylinder.loading(35.0), k, 0.18, Column::Matched, 0.0);
        let rpm = 35.0 * random.log_between(0.01, 10.0);
        let found = regime::reset(&design, &cylinder, rpm);
        let load = cylinder.loading(rpm) * 0.18;
        let shortening = 0.18 + design.displacement(0.18);
        let exact = big(shortening) / (big(1.0) - (-(big(1.0) + big(load)).ln() / big(k)).exp());
        let exact = (exact - big(design.column)) * big(2.0) * big(cylinder.piston_area);
        let size = 2.0 * cylinder.piston_area * design.column.max(found.column);
        volume.see(number(&(big(found.added_volume) - exact)).abs() / size, || {
            format!("q {q:.3}, k {k:.3}, {rpm:.2} rpm")
        });
    }
    volume.told(1e-14);
}

/// The eccentric circle has everything in closed form, from a thousandth of a millimetre to a kilometre.
#[test]
fn geometry_over_nine_decades() {
    let mut point = Worst::new("offset point, curvature radius 1e-6…1e3 m", "of the radius");
    let mut curvature = Worst::new("curvature", "relative");
    let mut angle = Worst::new("pressure angle", "rad");
    for decade in -6..=3 {
        let radius = libm::pow(10.0, f64::from(decade));
        let eccentric = 0.3 * radius;
        for share in [1e-9, 0.5, 1.0 - 1e-9, 1.0 - 1e-15] {
            let roller = share * radius;
            let follower = TranslatingRoller::new(radius - eccentric, 0.0, roller);
            let curves = Curves { law: EccentricCircle::new(eccentric, radius), follower };
            for i in 0..180 {
                let at = f64::from(2 * i).to_radians();
                let place = || format!("radius {radius:e} m, roller {share} of it, {}°", 2 * i);
                let (contact, profile) = (curves.contact(0, at), curves.profile(0, at));
                let away = (profile.point - Vector2::new(eccentric, 0.0)).norm();
                point.see((away - (radius - roller)).abs() / radius, place);
                curvature.see((contact.pitch.curvature * radius - 1.0).abs(), place);
                let sine = -eccentric / radius * libm::sin(at);
                angle.see((contact.pressure_angle - libm::asin(sine)).abs(), place);
            }
        }
    }
    point.told(1e-14);
    curvature.told(1e-12);
    angle.told(1e-14);
}

/// A plane vector of 60 digits.
type Plane = [Big; 2];

fn plus(a: &Plane, b: &Plane, share: &Big) -> Plane {
    [&a[0] + &b[0] * share, &a[1] + &b[1] * share]
}

fn cross(a: &Plane, b: &Plane) -> Big {
    &a[0] * &b[1] - &a[1] * &b[0]
}

fn dot(a: &Plane, b: &Plane) -> Big {
    &a[0] * &b[0] + &a[1] * &b[1]
}

/// Lift of a balance law and its three derivatives by the cam angle, from (10) or the paper's column, differentiated by
/// hand: nothing of the code's own forms.
fn exact_lift(law: &ReversalLaw, buffer: &Sample, column: Column, angle: f64) -> [Big; 4] {
    let (lever, ratio, r) = (big(law.lever), big(law.ratio), big(buffer.r));
    let (sin, cos) = (big(angle) / &ratio).sin_cos();
    let (x, x1) = (&r * &sin, &r * &cos);
    let (a, p) = (big(buffer.loading), big(1.0) / big(buffer.k));
    let power = |u: &Big| (-(&p * (big(1.0) + u).ln())).exp();
    let length = match column {
        Column::Return => &r / (big(1.0) - power(&(&a * &r))),
        _ => big(buffer.k) / &a,
    };
    let base = big(1.0) + &a * &x;
    let shrunk = power(&(&a * &x));
    let value = &length * (big(1.0) - &shrunk) - &x;
    // A matched bottom goes down all the way, a returning one starts and ends lowest.
    let lowest = match column {
        Column::Return => big(0.0),
        _ => &length * (big(1.0) - power(&(&a * &r))) - &r,
    };
    let steep = &length * &a * &p * &shrunk / &base;
    let slope = &steep - big(1.0);
    let second = -(&steep * &a * (&p + big(1.0))) / &base;
    let third = -(&second * &a * (&p + big(2.0))) / &base;
    let ds = &slope * &x1;
    let dds = &second * &x1 * &x1 - &slope * &x;
    let ddds = &third * &x1 * &x1 * &x1 - big(3.0) * &second * &x1 * &x - &slope * &x1;
    let by = &lever / &ratio;
    [(value - lowest) * &lever, ds * &by, dds * &by / &ratio, ddds * &by / &ratio / &ratio]
}

/// Pitch curve, its curvature and their change, the profile and the pressure angle of 600 random cams with a roller in
/// line or offset, against 60 digits from the law on.
#[test]
fn geometry_of_random_cams() {
    let mut random = Random(11);
    let mut point = Worst::new("pitch and profile point", "of radius and path");
    let mut bend = Worst::new("curvature of the pitch curve", "of κ + 1/R");
    let mut change = Worst::new("its derivative by the arc length", "of its terms");
    let mut angle = Worst::new("pressure angle of random cams", "rad");
    for _ in 0..600 {
        let buffer = sample(&mut random);
        let column = if random.next() < 0.5 { Column::Matched } else { Column::Return };
        let balance = Balance::new(buffer.loading, buffer.k, buffer.r, column, 0.0);
        let (lever, ratio) = (random.log_between(0.05, 20.0), random.log_between(0.2, 1.9));
        let motion = Reversal::new(ReversalLaw { balance, lever, ratio, transition: Transition::None }).expect("fits");
        let prime = random.log_between(1e-3, 1e3);
        let offset = if random.next() < 0.5 { 0.0 } else { prime * (1.8 * random.next() - 0.9) };
        let roller = prime * random.log_between(1e-3, 0.9);
        let share = if random.next() < 0.5 { random.log_between(1e-12, 1.0) } else { random.next() };
        let theta = ratio * std::f64::consts::FRAC_PI_2 * share;
        let place = || {
            format!("{column:?}, q − 1 = {:.1e}, r {:.1e}, R_p {prime:.1e}, θ {theta:.3e}", buffer.q - 1.0, buffer.r)
        };
        let exact = exact_lift(motion.law(), &buffer, column, theta);
        let curves = Curves { law: motion, follower: TranslatingRoller::new(prime, offset, roller) };
        let (piece, theta) = curves.law.locate(theta);
        let (contact, profile) = (curves.contact(piece, theta), curves.profile(piece, theta));

        let [s, ds, dds, ddds] = &exact;
        let (sin, cos) = big(theta).sin_cos();
        let (along, across) = ([cos.clone(), sin.clone()], [-sin, cos]);
        let e = big(offset);
        let u = (big(prime) * big(prime) - &e * &e).sqrt() + s;
        let zero = [big(0.0), big(0.0)];
        let vector = |a: &Big, b: &Big| plus(&plus(&zero, &along, a), &across, b);
        let centre = vector(&u, &e);
        let first = vector(&(ds - &e), &u);
        let second = vector(&(dds - &u), &(big(2.0) * ds - &e));
        let third = vector(&(ddds - big(3.0) * ds + &e), &(big(3.0) * dds - &u));
        let speed = dot(&first, &first).sqrt();
        let normal = [&first[1] / &speed, -&first[0] / &speed];
        let cube = &speed * &speed * &speed;
        let kappa = cross(&first, &second) / &cube;
        let parts = [cross(&first, &third) / &cube, big(3.0) * &kappa * dot(&first, &second) / (&speed * &speed)];
        let slope = (&parts[0] - &parts[1]) / &speed;

        let size = number(&dot(&centre, &centre).sqrt());
        let off = |got: Vector2<f64>, wanted: &Plane| {
            [number(&(big(got.x) - &wanted[0])), number(&(big(got.y) - &wanted[1]))]
                .map(f64::abs)
                .into_iter()
                .fold(0.0, f64::max)
        };
        let on_profile = plus(&centre, &normal, &-big(roller));
        // The angle is rounded, and with it x: a roller path of many radii is off by its own rounding.
        let path = size + lever * buffer.r * (1.0 + balance.start_slope);
        point.see(off(contact.pitch.point, &centre).max(off(profile.point, &on_profile)) / path, place);
        let curvature = number(&kappa);
        let error = number(&(big(contact.pitch.curvature) - &kappa)).abs();
        bend.see(error / (curvature.abs() + 1.0 / size), place);
        let error = number(&(big(contact.pitch.curvature_slope) - &slope)).abs();
        let terms = (number(&parts[0]).abs() + number(&parts[1]).abs()) / number(&speed);
        change.see(error / (terms + 1.0 / (size * size)), place);
        let (sine, cosine) = big(contact.pressure_angle).sin_cos();
        // From the normal to û, counted with the turn.
        let [x, y] = [dot(&along, &normal), cross(&along, &normal)].map(|value| number(&value));
        angle.see((number(&sine) + y).abs().max((number(&cosine) - x).abs()), place);
    }
    point.told(1e-14);
    bend.told(1e-13);
    change.told(1e-12);
    angle.told(1e-14);
}

/// Arcs of radii from 1e-3 to 1e7 mm, almost straight ones, and half circles, to the tolerance or refused by name.
#[test]
fn arcs_of_every_radius() {
    let mut worst = Worst::new("arc fit of a circle, radius 1e-3…1e7 mm", "of the radius");
    for decade in -3..=7 {
        let radius = libm::pow(10.0, f64::from(decade));
        for sweep in [1e-4, 1e-3, 1.0, std::f64::consts::PI] {
            let circle = |t: f64| Frame {
                point: Vector2::new(radius * libm::cos(t), radius * libm::sin(t)),
                tangent: Vector2::new(-libm::sin(t), libm::cos(t)),
                speed: radius,
                curvature: 1.0 / radius,
                curvature_slope: 0.0,
            };
            let chain = arcs::fit(circle, (0.0, sweep), 1e-9 * radius).expect("a chain");
            assert_eq!(chain.joints.len(), 1, "{radius} {sweep}");
            worst.see(chain.deviation / radius, || format!("radius {radius:e} mm, {sweep} rad"));
        }
    }
    worst.told(1e-15);
}

/// The default cam at tolerances from a millimetre to a picometre: kept, or refused by name.
#[test]
fn tolerances_over_nine_decades() {
    let machine = Machine::load("dpi", &[]).expect("valid").0;
    let rotary = Rotary::solve(&machine, 35.0).expect("a cam");
    println!("{:>12} {:>8} {:>10} {:>14} {:>14}", "tolerance/mm", "arcs", "N*", "deviation/tol", "arcs·tol^(1/3)");
    for decade in -9..=0 {
        let tolerance = libm::pow(10.0, f64::from(decade));
        let drawn = outline::profile(&rotary.curves, 1e-3 * tolerance).expect("an outline");
        let count = drawn.contour.vertices.len();
        #[expect(clippy::cast_precision_loss, reason = "a few thousand arcs")]
        let scaled = count as f64 * libm::cbrt(tolerance);
        println!(
            "{tolerance:>12e} {count:>8} {:>10.1} {:>14.4} {scaled:>14.3}",
            drawn.best_possible,
            drawn.deviation / tolerance
        );
        assert!(drawn.deviation <= tolerance);
        if tolerance < 1e-6 {
            // SEEN alone costs 0.4 %.
            assert!(f64::from(u32::try_from(count).expect("few")) < 1.01 * drawn.best_possible, "{tolerance}: {count}");
        }
        let breaks = drawn.contour.tangent_breaks();
        assert!(breaks.iter().all(|turn| turn.abs() < 1e-9), "{tolerance}");
    }
    assert!(outline::profile(&rotary.curves, 1e-16).is_err());
}

/// Every smooth piece of six cams from 0.1 mm to 0.1 µm: at most ⌈N*⌉ + 2 arcs, and hardly ever more than ⌈N*⌉ + 1, what
/// an exact tangent at both ends costs.
#[test]
fn arcs_near_the_limit() {
    let mut more_than_best = std::collections::BTreeMap::new();
    for overrides in [
        "cam.lever=1",
        "buffer.column=return",
        "transition.kind=none",
        "transition.kind=blend",
        "follower.roller.offset=20mm",
        "cam.lever=0.3",
    ] {
        let machine = Machine::load("dpi", &[overrides.into()]).expect("valid").0;
        let cam = Rotary::solve(&machine, 35.0).expect("a cam");
        for step in 0..=24 {
            let tolerance = 0.1 * libm::pow(10.0, -0.125 * f64::from(step));
            for (index, piece) in cam.curves.law.pieces().iter().enumerate().filter(|(_, piece)| !piece.dwell) {
                let curve = |angle: f64| cam.curves.profile(index, angle).scaled(1e3);
                let chain = arcs::fit(curve, (piece.start, piece.end), tolerance).expect("a chain");
                #[expect(clippy::cast_possible_truncation, reason = "a few hundred arcs")]
                let more = i32::try_from(chain.joints.len()).expect("few") - chain.best_possible.ceil() as i32;
                assert!(more <= 2, "{overrides} at {tolerance:e} mm: {more} more than {}", chain.best_possible);
                assert!(chain.deviation <= tolerance);
                *more_than_best.entry(more).or_insert(0) += 1;
            }
        }
    }
    println!("arcs beyond N* rounded up: pieces {more_than_best:?}");
    assert!(more_than_best.get(&2).is_none_or(|pieces| 10 * pieces <= more_than_best.values().sum::<i32>()));
}

/// Where the profile almost has a cusp, where a transition almost vanishes, where the cam is as large as a drawing can be:
/// an outline that keeps its tolerance and on which the roller rolls, or an error that says why.
#[test]
fn cams_at_the_edge() {
    let solve = |overrides: &[String]| {
        let machine = Machine::load("dpi", overrides).expect("valid").0;
        Rotary::solve(&machine, 35.0)
    };
    let base = solve(&["cam.base_radius=90mm".into()]).expect("a cam");
    let prime = base.curves.follower.prime_radius();
    let sharpest = 1.0 / extremes::convex_pitch_curvature(&base.curves).value;
    let ulp_less = f64::from_bits(sharpest.to_bits() - 1);
    for (roller, what) in
        [(ulp_less, "an ulp below"), (sharpest * (1.0 - 1e-9), "1e-9 below"), (sharpest * 1.01, "1 % above")]
    {
        let curves = Curves { law: &base.curves.law, follower: TranslatingRoller::new(prime, 0.0, roller) };
        let result = outline::profile(&curves, 5e-6);
        println!(
            "roller {what} the sharpest radius: {}",
            match &result {
                Ok(outline) => format!("{} arcs, {:.2e} mm off", outline.contour.vertices.len(), outline.deviation),
                Err(error) => error.to_string(),
            }
        );
        if let Ok(outline) = result {
            assert!(outline.deviation <= 0.005 && curves.follower.roller_radius() == roller);
        }
    }
    for width in ["1e-9 deg", "2e-7 deg", "1e-6 deg", "1e-5 deg", "1e-3 deg", "1 deg", "90 deg"] {
        let cam = solve(&[format!("transition.width={width}")]).expect("a cam");
        let part = drawing::part(&cam, 5e-6);
        match part {
            Ok(part) => {
                let rolled = rolling::roll(&cam, &part.outline.contour, 0.005);
                println!(
                    "transition {width}: {} arcs, gap {:.2e} mm",
                    part.outline.contour.vertices.len(),
                    rolled.gap_mm
                );
                assert!(rolled.gap_mm.abs() <= 0.005, "{width}: {}", rolled.gap_mm);
            }
            // A wall of the cam, not of the fit.
            Err(error) => assert!(error.to_string().contains("folds over itself"), "transition {width}: {error}"),
        }
    }
    for radius in ["1 um", "1000 mm", "100 m", "999 m", "1000 m"] {
        let cam = solve(&[format!("cam.base_radius={radius}"), "cam.bore_radius=0.5um".into()]).expect("a cam");
        match drawing::part(&cam, 5e-6) {
            Ok(part) => println!(
                "base radius {radius}: {} arcs, {:.2e} mm off",
                part.outline.contour.vertices.len(),
                part.outline.deviation
            ),
            Err(error) => {
                println!("base radius {radius}: {error}");
                // No room for the lift, and no room on a drawing: nothing else is a wall.
                assert!(["1 um", "1000 m"].contains(&radius), "{radius}: {error}");
            }
        }
        assert!(cam.curves.law.pieces().len() > 3);
    }
}
