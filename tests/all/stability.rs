//! Closed forms against 60-digit arithmetic over random and log-spaced inputs: law, pressure, columns, pitch curve, profile.
//! Every line of the table is a worst case; `cargo test --test all stability:: -- --nocapture`.

use crate::common::big::{Big, big, number, ulp};
use crate::common::random::Random;
use crate::common::worst::Worst;
use camgen::domains::press::buffer::bottom_law::{BottomLaw, ColumnRule, column_for};
use camgen::domains::press::buffer::{Bed, Cylinder, regime};
use camgen::domains::press::motion::{Reversal, ReversalLaw, Transition};
use camgen::follower::TranslatingRoller;
use camgen::motion::EccentricCircle;
use camgen::profile::Curves;
use nalgebra::Vector2;

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
            share if share < 0.35 => ColumnRule::Matched,
            share if share < 0.7 => ColumnRule::Return,
            _ => ColumnRule::Length(k / loading * random.log_between(0.3, 5.0)),
        };
        let bottom_law = BottomLaw::new(loading, k, r, column, 0.0);
        let place =
            || format!("q − 1 = {:.2e}, k − 1 = {:.1e}, r = {r:.2e}, x = {x:.3e}, {column:?}", q - 1.0, k - 1.0);
        let (whole, _) = shrink(loading, k, r);
        let exact_length = match column {
            ColumnRule::Matched => big(k) / big(loading),
            ColumnRule::Return => big(r) / (big(1.0) - &whole),
            ColumnRule::Length(length) => big(length),
        };
        let (part, load) = shrink(loading, k, x);
        let exact = &exact_length * (big(1.0) - &part) - big(x);
        let off = number(&(big(bottom_law.displacement(x)) - &exact)).abs();
        let given = matches!(column, ColumnRule::Length(_));
        if x <= 1e-3 && !given && x > 0.0 {
            small.see(off / ulp(number(&exact)), place);
        }
        // Beside half an ulp of the result itself, which exceeds that of L where x is many times L.
        large.see((off - 0.5 * ulp(number(&exact))).max(0.0) / ulp(bottom_law.column), place);

        let base = big(1.0) + &load;
        let c = &exact_length * big(loading) / big(k);
        let power = &part / &base;
        let steeper = big(1.0) / big(k) + big(1.0);
        let got = bottom_law.bottom(x, r - x);
        slope.see(number(&((big(got.slope) - (&c * &power - big(1.0))) / &c)).abs(), place);
        let exact_second = -(&c * big(loading) * &steeper * &power) / &base;
        second.see(number(&((big(got.second) - &exact_second) / &exact_second)).abs(), place);
        let exact_third = -(&exact_second * big(loading) * (&steeper + big(1.0))) / &base;
        third.see(number(&((big(got.third) - &exact_third) / &exact_third)).abs(), place);
        let ratio = bottom_law.pressure_ratio(x, bottom_law.displacement(x));
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
        let design = BottomLaw::new(cylinder.loading(35.0), k, 0.18, ColumnRule::Matched, 0.0);
        let rpm = 35.0 * random.log_between(0.01, 10.0);
        let found = regime::reset(&design.into(), &cylinder, rpm, regime::Reset::End);
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
            let curves = Curves { motion: &EccentricCircle::new(eccentric, radius), follower: &follower };
            for i in 0..180 {
                let at = f64::from(2 * i).to_radians();
                let place = || format!("radius {radius:e} m, roller {share} of it, {}°", 2 * i);
                let (contact, profile) = (curves.contact(0, at), curves.profile(0, at));
                let away = (profile.point - Vector2::new(eccentric, 0.0)).norm();
                point.see((away - (radius - roller)).abs() / radius, place);
                curvature.see((contact.curve.curvature * radius - 1.0).abs(), place);
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
fn exact_lift(law: &ReversalLaw, buffer: &Sample, column: ColumnRule, angle: f64) -> [Big; 4] {
    let (lever, ratio, r) = (big(law.lever), big(1.0) / big(f64::from(law.lobes)), big(buffer.r));
    let (sin, cos) = (big(angle) / &ratio).sin_cos();
    let (x, x1) = (&r * &sin, &r * &cos);
    let (a, p) = (big(buffer.loading), big(1.0) / big(buffer.k));
    let power = |u: &Big| (-(&p * (big(1.0) + u).ln())).exp();
    let length = match column {
        ColumnRule::Return => &r / (big(1.0) - power(&(&a * &r))),
        _ => big(buffer.k) / &a,
    };
    let base = big(1.0) + &a * &x;
    let shrunk = power(&(&a * &x));
    let value = &length * (big(1.0) - &shrunk) - &x;
    // A matched bottom goes down all the way, a returning one starts and ends lowest.
    let lowest = match column {
        ColumnRule::Return => big(0.0),
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
    let mut angle = Worst::new("pressure angle of random cams", "of path/radius");
    for case in 0..600_u32 {
        let buffer = sample(&mut random);
        let column = if random.next() < 0.5 { ColumnRule::Matched } else { ColumnRule::Return };
        let bottom_law = BottomLaw::new(buffer.loading, buffer.k, buffer.r, column, 0.0);
        let (lever, lobes) = (random.log_between(0.05, 20.0), 1 + case % 5);
        let motion =
            Reversal::new(ReversalLaw { bottom_law: bottom_law.into(), lever, lobes, transition: Transition::None })
                .expect("fits");
        let prime = random.log_between(1e-3, 1e3);
        let offset = if random.next() < 0.5 { 0.0 } else { prime * (1.8 * random.next() - 0.9) };
        let roller = prime * random.log_between(1e-3, 0.9);
        let share = if random.next() < 0.5 { random.log_between(1e-12, 1.0) } else { random.next() };
        let theta = std::f64::consts::FRAC_PI_2 / f64::from(lobes) * share;
        let place = || {
            format!("{column:?}, q − 1 = {:.1e}, r {:.1e}, R_p {prime:.1e}, θ {theta:.3e}", buffer.q - 1.0, buffer.r)
        };
        let exact = exact_lift(motion.law(), &buffer, column, theta);
        let follower = TranslatingRoller::new(prime, offset, roller);
        let curves = Curves { motion: &motion, follower: &follower };
        let (piece, theta) = curves.motion.locate(theta);
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
        let path = size + lever * buffer.r * (1.0 + bottom_law.start_slope);
        point.see(off(contact.curve.point, &centre).max(off(profile.point, &on_profile)) / path, place);
        let curvature = number(&kappa);
        let error = number(&(big(contact.curve.curvature) - &kappa)).abs();
        bend.see(error / (curvature.abs() + 1.0 / size), place);
        let error = number(&(big(contact.curve.curvature_slope) - &slope)).abs();
        let terms = (number(&parts[0]).abs() + number(&parts[1]).abs()) / number(&speed);
        change.see(error / (terms + 1.0 / (size * size)), place);
        let (sine, cosine) = big(contact.pressure_angle).sin_cos();
        // From the normal to û, counted with the turn.
        let [x, y] = [dot(&along, &normal), cross(&along, &normal)].map(|value| number(&value));
        // What the path is off turns the normal by its share of the radius.
        angle.see((number(&sine) + y).abs().max((number(&cosine) - x).abs()) * size / path, place);
    }
    point.told(1e-14);
    bend.told(1e-13);
    change.told(1e-12);
    angle.told(1e-14);
}
