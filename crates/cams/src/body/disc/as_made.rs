//! What a cam does that is not made as drawn: another roller, a pivot out of place, a profile off its shaft, waves, wear.
//!
//! To first order. The surface of the cam lies higher by n along its outward normal where the follower touches, or the follower
//! lies so much too far in: the follower moves by n/cos α along its path, α the pressure angle. What is left out is n²/(2ρ), ρ the
//! radius of curvature of the pitch curve: 2 nm for 10 µm at 25 mm. With β the angle from the normal to the path, and τ = κℓ the rate
//! at which the normal turns,
//!
//! ```text
//! Δs = n g,  Δs' = n' g + n g',  Δs'' = n'' g + 2 n' g' + n g'',  g = 1/cos β,
//! g' = g tan β β',  g'' = g (β'² (1 + 2 tan² β) + tan β β'')
//! ```
//!
//! An error of the angle on the shaft is a lift that comes earlier.

use super::Disc;
use crate::body::stress::RollerContact;
use crate::machine::AsMadeData;
use crate::report::{Section, shown};
use camgen_kernel::follower::Element;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::{Jet, Quantity};
use camgen_kernel::profile::{Contact, Curves};
use camgen_kernel::text::{Length, LengthKind, Text, Value, text};
use nalgebra::Vector2;
use serde::Serialize;
use siphasher::sip::SipHasher13;
use std::f64::consts::{SQRT_2, TAU};
use std::hash::Hasher;

/// Places of a turn, and of each of its waves: the largest value is missed by less than (π/64)²/2 of a wave.
const PLACES: f64 = 1440.0;
const PLACES_OF_A_WAVE: f64 = 64.0;

/// The section of the report. Errors are along the path of the follower where it touches.
#[derive(Debug, Serialize)]
struct AsMade {
    lift_error_low_mm: f64,
    lift_error_high_mm: f64,
    /// Of either sign.
    lift_error_max_mm: f64,
    lift_error_max_cam_deg: f64,
    /// Highest less lowest: what a follower that is set anew keeps of it.
    lift_error_range_mm: f64,
    lift_error_rms_mm: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    acceleration_error_max_m_per_s2: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    acceleration_error_max_rad_per_s2: Option<f64>,
    /// The force that the balance of a press leaves, with the follower where it is.
    #[serde(skip_serializing_if = "Option::is_none")]
    residual_max_n: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    contact_force_max_n: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    contact_force_min_n: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    contact_stress_max_mpa: Option<f64>,
}

/// A value and its first two derivatives by the cam angle.
type Rates = [f64; 3];

fn sum(a: Rates, b: Rates) -> Rates {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

fn product(a: Rates, b: Rates) -> Rates {
    [a[0] * b[0], a[1] * b[0] + a[0] * b[1], a[2] * b[0] + 2.0 * a[1] * b[1] + a[0] * b[2]]
}

/// A wave of the profile: how many in a turn, and cosine and sine of its phase, times its height in metres.
struct Wave {
    count: u32,
    along: [f64; 2],
}

/// The waves of a profile, of the same height each: together they have the root mean square that is given.
fn waves(of: &AsMadeData) -> Vec<Wave> {
    let (from, to) = of.waves;
    if of.waviness == 0.0 {
        return Vec::new();
    }
    let height = of.waviness * SQRT_2 / f64::from(to - from + 1).sqrt();
    let wave = |count: u32| {
        let mut hasher = SipHasher13::new_with_keys(of.draw.to_bits(), 0);
        hasher.write_u32(count);
        #[expect(clippy::cast_precision_loss, reason = "53 bits")]
        let phase = TAU * (hasher.finish() >> 11) as f64 / (1_u64 << 53) as f64;
        let (sine, cosine) = libm::sincos(phase);
        Wave { count, along: [height * cosine, height * sine] }
    };
    (from..=to).map(wave).collect()
}

/// Sum of waves A cos(kθ) − B sin(kθ), and its rates, m. Neighbours have counts that follow each other.
fn waved(waves: &[Wave], angle: f64) -> Rates {
    let Some(first) = waves.first() else { return [0.0; 3] };
    let (sine, cosine) = libm::sincos(angle);
    let (mut s, mut c) = libm::sincos(f64::from(first.count) * angle);
    let mut all = [0.0; 3];
    for Wave { count, along: [a, b] } in waves {
        let k = f64::from(*count);
        let (value, slope) = (a * c - b * s, -k * (a * s + b * c));
        all = sum(all, [value, slope, -k * k * value]);
        (c, s) = (c * cosine - s * sine, s * cosine + c * sine);
    }
    all
}

/// The follower at a place of a disc that is made exactly.
struct Place<'a> {
    disc: &'a Disc,
    at: (usize, f64),
    contact: Contact,
    /// How much farther the cam has turned than the lobe on which the place lies, rad.
    lobe: f64,
}

impl Place<'_> {
    fn curves(&self) -> Curves<'_> {
        self.disc.curves()
    }

    /// Rate at which the outward normal turns, and its slope; the slope of that of the angle from the normal to the path. `None` where
    /// they are not known.
    fn turns(&self) -> Option<[f64; 3]> {
        let (curve, lift) = (&self.contact.curve, &self.contact.lift);
        if let Element::Face = self.curves().element() {
            // The normal of a face on a straight path turns with the cam; where the face of an arm touches has no known rate.
            return (self.curves().motion.quantity() == Quantity::Length).then_some([1.0, 0.0, 0.0]);
        }
        let [speed_slope, drive_slope] = self.curves().follower.speed_slopes(lift)?;
        let turn = curve.curvature * curve.speed;
        let slope = curve.curvature_slope * curve.speed * curve.speed + curve.curvature * speed_slope;
        Some([turn, slope, drive_slope - slope])
    }

    /// Travel along the path for what lies along the normal, 1/cos β.
    fn along_path(&self, turns: Option<[f64; 3]>) -> Rates {
        let (beta, slope) = (self.contact.pressure_angle, self.contact.pressure_angle_slope);
        let (secant, tangent) = (1.0 / libm::cos(beta), libm::tan(beta));
        match (self.curves().element(), turns) {
            (Element::Face, Some(_)) => [secant, 0.0, 0.0],
            (Element::Roller { .. }, Some([_, _, second])) => [
                secant,
                secant * tangent * slope,
                secant * (slope * slope * (1.0 + 2.0 * tangent * tangent) + tangent * second),
            ],
            (_, None) => [secant, f64::NAN, f64::NAN],
        }
    }

    /// The outward normal along a vector that is the same in the cam, or turns with the machine, and its rates.
    fn normal_along(&self, vector: Vector2<f64>, turning: bool, turns: Option<[f64; 3]>) -> Rates {
        let (normal, tangent) = (self.contact.curve.outward(), self.contact.curve.tangent);
        let [turn, turn_slope, _] = turns.unwrap_or([f64::NAN; 3]);
        let first = tangent * turn;
        let second = tangent * turn_slope - normal * (turn * turn);
        let [along, along_first, along_second] = [normal, first, second].map(|normal| vector.dot(&normal));
        if !turning {
            return [along, along_first, along_second];
        }
        let turned = Vector2::new(-vector.y, vector.x);
        [along, along_first + turned.dot(&normal), along_second + 2.0 * turned.dot(&first) - along]
    }

    /// By how much the surfaces of cam and roller are too high along the outward normal, m.
    fn error_of_surfaces(&self, of: &AsMadeData, waves: &[Wave]) -> Rates {
        let side = self.curves().metal_side();
        let wave = waved(waves, self.at.1 + self.lobe);
        sum([of.roller_radius - of.wear, 0.0, 0.0], wave).map(|rate| side * rate)
    }

    /// By how much the surface is too high along its outward normal, or the follower too far in, m.
    fn error_along_normal(&self, of: &AsMadeData, waves: &[Wave], turns: Option<[f64; 3]>) -> Rates {
        let metal = self.error_of_surfaces(of, waves);
        let fixed = |size: f64, direction: f64, turning: bool| {
            let (sine, cosine) = libm::sincos(direction);
            self.normal_along(Vector2::new(cosine, sine) * size, turning, turns)
        };
        let mut all = metal;
        if of.eccentricity != 0.0 {
            all = sum(all, fixed(of.eccentricity, of.eccentricity_at - self.lobe, false));
        }
        if of.centre_distance != 0.0 {
            all = sum(all, fixed(-of.centre_distance, self.at.1, true));
        }
        if of.offset != 0.0 {
            all = sum(all, fixed(-of.offset, self.at.1 + 0.25 * TAU, true));
        }
        all
    }

    /// The error of the lift, m or rad, with its rates, and that of the follower along its path, m.
    fn error(&self, of: &AsMadeData, waves: &[Wave]) -> (Jet, f64) {
        let (turns, lift) = (self.turns(), &self.contact.lift);
        let along = product(self.error_along_normal(of, waves, turns), self.along_path(turns));
        let leverage = self.curves().follower.leverage(lift);
        let ahead = [lift.ds, lift.dds, lift.ddds].map(|rate| of.angle * rate);
        let [s, ds, dds] = sum(along.map(|rate| rate / leverage), ahead);
        (Jet { s, ds, dds, ddds: 0.0 }, s * leverage)
    }

    /// The contact with the lift that the surfaces of cam and roller give as they are made. Where the cam sits and where the follower is
    /// moves the contact along the cam, and changes neither the shape that it runs over nor, to first order, the forces.
    fn on_surfaces(&self, of: &AsMadeData, waves: &[Wave]) -> Contact {
        let along = product(self.error_of_surfaces(of, waves), self.along_path(self.turns()));
        let [s, ds, dds] = along.map(|rate| rate / self.curves().follower.leverage(&self.contact.lift));
        Contact { lift: self.contact.lift.plus(Jet { s, ds, dds, ddds: 0.0 }), ..self.contact }
    }

    /// Curvature of the worn and wavy profile, 1/m, convex positive; `None` where it is too hollow for what runs on it.
    fn curvature(&self, of: &AsMadeData, waves: &[Wave]) -> Option<f64> {
        let (curves, curve) = (self.curves(), &self.contact.curve);
        let [wave, slope, second] = waved(waves, self.at.1 + self.lobe);
        let height = wave - of.wear;
        if let Element::Face = curves.element() {
            // Under a face the radius is p + p'', p the distance of the face from the shaft.
            let radius = curve.speed + height + second;
            return (curve.speed <= 0.0 || radius > 0.0).then(|| 1.0 / radius);
        }
        let profile = curve.offset_inward(curves.offset());
        let speed_slope = curves.follower.speed_slopes(&self.contact.lift).map_or(0.0, |[slope, _]| slope);
        let profile_slope = speed_slope * (1.0 - curve.curvature * curves.offset())
            - curves.offset() * curve.curvature_slope * curve.speed * curve.speed;
        // The second derivative of the wave by the length along the profile.
        let along = (second - slope * profile_slope / profile.speed) / (profile.speed * profile.speed);
        let own = curves.metal_side() * profile.curvature;
        let curvature = own / (1.0 + own * height) - along;
        (curvature + self.roller() > 0.0).then_some(curvature)
    }

    /// Curvature of the roller, 1/m.
    fn roller(&self) -> f64 {
        self.curves().roller_radius().map_or(0.0, |radius| 1.0 / radius)
    }

    /// Pressure of the contact under a force along the normal, Pa; `None` where it is not known.
    fn pressure(&self, curvature: f64, force: f64, larger_by: f64) -> Option<f64> {
        let machine = &self.disc.machine;
        let material = machine.cam.material?.class;
        let roller = self.curves().roller_radius().map_or(0.0, |radius| 1.0 / (radius + larger_by));
        let curvature = (roller + curvature).max(0.0);
        let (crown, length) = (machine.follower.crown_radius, machine.cam.contact_length());
        RollerContact { curvature, crown, length }.pressure(force, material)
    }
}

/// Largest and smallest of some values.
#[derive(Clone, Copy)]
struct Extremes {
    low: f64,
    high: f64,
}

impl Extremes {
    const NONE: Self = Self { low: f64::INFINITY, high: f64::NEG_INFINITY };

    fn with(self, value: f64) -> Self {
        Self { low: self.low.min(value), high: self.high.max(value) }
    }

    fn found(self) -> Option<Self> {
        (self.low <= self.high).then_some(self)
    }
}

/// What is found on a turn.
struct Turn {
    /// Errors along the path, m, and where the largest is, rad.
    path: Extremes,
    largest: (f64, f64),
    squares: f64,
    places: f64,
    acceleration: f64,
    residual: f64,
    force: Extremes,
    stress: f64,
    /// Whether waves turn the profile too hollow for what runs on it, which then rides on their crests.
    on_crests: bool,
}

impl Turn {
    fn on(disc: &Disc, of: &AsMadeData) -> Self {
        let (curves, waves) = (disc.curves(), waves(of));
        let dense = if waves.is_empty() { 0.0 } else { PLACES_OF_A_WAVE * f64::from(of.waves.1) };
        let count = PLACES.max(dense);
        let mut turn = Self {
            path: Extremes::NONE,
            largest: (0.0, 0.0),
            squares: 0.0,
            places: 0.0,
            acceleration: 0.0,
            residual: 0.0,
            force: Extremes::NONE,
            stress: 0.0,
            on_crests: false,
        };
        let mut index = 0.0;
        while index < count {
            let angle = TAU * index / count;
            index += 1.0;
            let (piece, inside) = curves.motion.locate(angle);
            if curves.motion.is_rolled(piece) {
                let contact = curves.contact(piece, inside);
                turn.add(&Place { disc, at: (piece, inside), contact, lobe: angle - inside }, of, &waves);
            }
        }
        turn
    }

    fn add(&mut self, place: &Place<'_>, of: &AsMadeData, waves: &[Wave]) {
        let (error, moved) = place.error(of, waves);
        let ratios = [1.0 + of.speed, 1.0 + of.load];
        self.path = self.path.with(moved);
        if moved.abs() > self.largest.0 {
            self.largest = (moved.abs(), place.at.1 + place.lobe);
        }
        self.squares += moved * moved;
        self.places += 1.0;
        self.acceleration = larger(self.acceleration, error.dds.abs());
        if let Some(residual) = place.disc.residual_as_made(place.at, (moved, ratios)) {
            self.residual = self.residual.max(residual.abs());
        }
        let made = place.on_surfaces(of, waves);
        let curvature = place.curvature(of, waves);
        self.on_crests |= curvature.is_none();
        let Some(force) = place.disc.normal_force_as_made(place.at, &made, (moved, ratios)) else { return };
        self.force = self.force.with(force);
        let pressed = place.pressure(curvature.unwrap_or(0.0), place.disc.borne(force), of.roller_radius);
        self.stress = pressed.map_or(f64::NAN, |pressure| larger(self.stress, pressure));
    }
}

/// The larger of two numbers, NaN where either is NaN.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

impl Disc {
    /// The section on the errors that its file gives; `None` where it gives none.
    pub(super) fn as_made(&self) -> Option<Section> {
        let of = self.machine.as_made.as_ref()?;
        let turn = Turn::on(self, of);
        let (path, largest) = (turn.path.found()?, turn.largest);
        let speed = self.speed.map(|speed| speed * (1.0 + of.speed));
        let acceleration = speed.map(|speed| turn.acceleration * speed * speed).filter(|value| value.is_finite());
        let swings = self.motion.quantity() == Quantity::Angle;
        let force = turn.force.found().filter(|_| !turn.on_crests);
        let acceleration = acceleration.filter(|_| !turn.on_crests);
        let found = AsMade {
            lift_error_low_mm: MILLIMETRES * path.low,
            lift_error_high_mm: MILLIMETRES * path.high,
            lift_error_max_mm: MILLIMETRES * largest.0,
            lift_error_max_cam_deg: largest.1.to_degrees(),
            lift_error_range_mm: MILLIMETRES * (path.high - path.low),
            lift_error_rms_mm: MILLIMETRES * (turn.squares / turn.places).sqrt(),
            acceleration_error_max_m_per_s2: acceleration.filter(|_| !swings),
            acceleration_error_max_rad_per_s2: acceleration.filter(|_| swings),
            residual_max_n: self.is_balanced().then_some(turn.residual),
            contact_force_max_n: force.map(|force| force.high).filter(|force| force.is_finite()),
            contact_force_min_n: force.map(|force| force.low).filter(|force| force.is_finite()),
            contact_stress_max_mpa: force.map(|_| 1e-6 * turn.stress).filter(|stress| stress.is_finite()),
        };
        Some(Section::new("as_made", &found).with_words(words(&found, (turn.on_crests, self.is_closed()))))
    }
}

fn words(found: &AsMade, (on_crests, is_closed): (bool, bool)) -> Vec<Text> {
    let mut words = vec![text!(
        "lift error {} to {} along the path ({} root mean square), largest at {}°",
        Length::mm(found.lift_error_low_mm).bare(),
        Length::mm(found.lift_error_high_mm),
        Length::mm(found.lift_error_rms_mm),
        shown(found.lift_error_max_cam_deg)
    )];
    let of_path = found.acceleration_error_max_m_per_s2.map(|value| Length::new(value, &LengthKind::M_PER_S2).into());
    let of_arm = found.acceleration_error_max_rad_per_s2.map(|value| format!("{} rad/s²", shown(value)).into());
    words.extend(
        of_path.or(of_arm).map(|value: Value| text!("error of the acceleration, by the shape, up to {}", value)),
    );
    words.extend(found.residual_max_n.map(|force| text!("residual force up to {} N", shown(force))));
    if let (Some(low), Some(high)) = (found.contact_force_min_n, found.contact_force_max_n) {
        let stress =
            found.contact_stress_max_mpa.map_or(String::new(), |stress| format!(", up to {} MPa", shown(stress)));
        words.push(text!("force along the normal {} to {} N{}", shown(low), shown(high), stress));
        if low <= 0.0 && !is_closed {
            words.push("the follower leaves the cam".into());
        }
    }
    if on_crests {
        words.push("waves make the profile so hollow that the follower rides on their crests: no acceleration and force is given".into());
    }
    words
}

#[cfg(test)]
mod tests;
