//! The drive-speed law (Voloshchak & Denis): no cam; the drive slows down so that plain buffers alone brake the bed.
//!
//! Phase 1, crank angle φ from 0 to the lead angle: x = r φ, v = r ω. Phase 2, φ' from 0 to 90°: x = r φ_в + r sin φ',
//! v = r ω cos φ'. The paper integrates the motion by sections (see `sections`); without a force in the crank the
//! energy of the bed goes into the air, ½ m v² = ½ m v0² − W(x), which is exact for both phases.
//!
//! At φ' = 90° ω = v/(r cos φ') is finite only where the work over the whole stroke x_e = r (1 + φ_в) is the bed's energy: the
//! machine closes. Then with b = L − x_e and D = r (1 − sin φ'), the overrun that is left, for all of phase 2 without 0/0
//!
//! ```text
//! ω² = (4 p0 F/(m r)) [(L/b)^k g(D/b) − 1]/(2 − D/r),   g(δ) = (1 − (1+δ)^(1−k))/((k−1) δ)
//! ```
//!
//! of which the limit is √(P_end/(m r)). A machine that does not close adds (v0² − 2 W_end/m)/(r² cos² φ').

mod error;
mod machine;
mod sections;

pub use error::{ClosingRemedies, DriveError};
pub use machine::BufferedBed;
use machine::not_positive;
pub use sections::{NodeSpeed, SectionEnd, sections};

use super::bottom_law::{SERIES_LIMIT, g_divided_difference, g_minus_one};
use super::{bore_of, total_area};
use camgen_kernel::numeric::extremum::Extremum;
use camgen_kernel::numeric::{quadrature, root};
use std::f64::consts::{FRAC_PI_2, PI};

/// A given bore closes if the work over the stroke differs from the bed's energy by no more than this share of it; the rest is
/// dropped, with an error of the same size in ω² except near 90°, where the dropped term would grow without bound.
pub const CLOSING: f64 = 1e-9;

/// Panels of eight points for the time of a phase.
const PANELS: u32 = 32;

/// The two stretches of the braking.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// x = r φ.
    Lead,
    /// x = r φ_в + r sin φ'.
    Crank,
}

/// State of bed and crank at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DriveState {
    /// The phase.
    pub phase: Phase,
    /// Overrun of the bed, m.
    pub x: f64,
    /// Force of the pair of buffers, N.
    pub force: f64,
    /// Speed of the bed, m/s.
    pub velocity: f64,
    /// Speed of the crank ω, rad/s.
    pub omega: f64,
    /// dω/dφ, 1/s.
    pub omega_slope: f64,
}

impl DriveState {
    /// Speed of the motor, rpm, for its turns per turn of the crank: equation (16), n = (30/π) i ω.
    #[must_use]
    pub fn motor_rpm(&self, motor_ratio: f64) -> f64 {
        30.0 / PI * motor_ratio * self.omega
    }

    /// Torque, N·m, that a drive of an inertia J at the crank (kg·m²) needs for its own change of speed: J ω dω/dφ.
    #[must_use]
    pub fn torque(&self, inertia: f64) -> f64 {
        inertia * self.omega * self.omega_slope
    }
}

/// Least speed of the crank.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LeastSpeed {
    /// ω, rad/s.
    pub omega: f64,
    /// Angle φ' of phase 2, rad.
    pub phase_angle: f64,
    /// Drop from the speed before braking as a share of it, 0…1.
    pub drop: f64,
}

/// The law for one machine and one bore.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drive {
    /// Bed, crank and column.
    pub machine: BufferedBed,
    /// Area F of one piston, m².
    pub piston_area: f64,
    /// v0² − 2 W_end/m, m²/s²; exactly 0 for a machine that closes.
    misfit: f64,
}

impl Drive {
    /// The machine with the bore that closes.
    ///
    /// # Errors
    /// [`DriveError`] for inputs without a meaning and a column that the stroke uses up.
    pub fn by_closing(machine: BufferedBed) -> Result<Self, DriveError> {
        machine.check()?;
        Ok(Self { machine, piston_area: machine.closing_area(), misfit: 0.0 })
    }

    /// The machine with a given piston area, m², that must close to [`CLOSING`].
    ///
    /// # Errors
    /// [`DriveError`] as for [`Drive::by_closing`], and for a machine that does not close, with what would.
    pub fn with_area(machine: BufferedBed, piston_area: f64) -> Result<Self, DriveError> {
        let drive = Self::open(machine, piston_area)?;
        let (misfit, square) = (drive.misfit, machine.bed_speed * machine.bed_speed);
        if misfit.abs() <= CLOSING * square {
            return Ok(Self { misfit: 0.0, ..drive });
        }
        let remedies = ClosingRemedies {
            bore: bore_of(machine.closing_area()),
            column: machine.closing_column(piston_area),
            ambient_pressure: machine.closing_pressure(piston_area),
        };
        if misfit > 0.0 {
            return Err(DriveError::ArrivesWithSpeed { speed: misfit.sqrt(), remedies });
        }
        let stroke = machine.stroke();
        let x = root::bracketed(|x| machine.energy() - drive.work(x), 0.0, stroke, 0.0).unwrap_or(stroke);
        Err(DriveError::StopsEarly { x, stroke, remedies })
    }

    /// The machine with a given piston area, m², closed or not: its speed grows without bound towards 90°, or the bed stops
    /// before.
    ///
    /// # Errors
    /// [`DriveError`] as for [`Drive::by_closing`].
    pub fn open(machine: BufferedBed, piston_area: f64) -> Result<Self, DriveError> {
        machine.check()?;
        if !(piston_area > 0.0 && piston_area.is_finite()) {
            return Err(not_positive("piston area", piston_area).into());
        }
        let square = machine.bed_speed * machine.bed_speed;
        let misfit = square * ((machine.closing_area() - piston_area) / machine.closing_area());
        Ok(Self { machine, piston_area, misfit })
    }

    /// Bore of one cylinder, m.
    #[must_use]
    pub fn bore(&self) -> f64 {
        bore_of(self.piston_area)
    }

    fn unit_force(&self) -> f64 {
        self.machine.ambient_pressure * total_area(self.piston_area)
    }

    /// Force of the pair of buffers at an overrun x in [0, x_e], N: equations (1) and (2).
    #[must_use]
    pub fn force(&self, x: f64) -> f64 {
        self.unit_force() * libm::expm1(-self.machine.exponent * libm::log1p(-x / self.machine.column))
    }

    /// Work of the pair of buffers up to an overrun x in [0, x_e], J.
    #[must_use]
    pub fn work(&self, x: f64) -> f64 {
        let column = self.machine.column;
        self.unit_force() * column * machine::compression(x / column, self.machine.exponent)
    }

    /// Speed of the crank before braking, rad/s.
    #[must_use]
    pub fn omega_before(&self) -> f64 {
        self.machine.bed_speed / self.machine.crank_radius
    }

    /// The state at a crank angle in [0, φ_в + 90°] of the braking; `None` where the bed has stopped before.
    #[must_use]
    pub fn at(&self, crank: f64) -> Option<DriveState> {
        let lead = self.machine.lead_angle;
        if crank < lead { self.at_phase(Phase::Lead, crank) } else { self.at_phase(Phase::Crank, crank - lead) }
    }

    /// The state at an angle within a phase: 0…φ_в, or 0…90°.
    #[must_use]
    pub fn at_phase(&self, phase: Phase, angle: f64) -> Option<DriveState> {
        let machine = &self.machine;
        let (r, lead) = (machine.crank_radius, machine.lead_angle);
        let (x, omega, velocity) = match phase {
            Phase::Lead => {
                let omega = self.lead_omega(angle)?;
                (r * angle, omega, r * omega)
            }
            Phase::Crank => {
                let (omega, cos) = (self.crank_omega(angle)?, cosine(angle));
                (r * lead + r * libm::sin(angle), omega, r * omega * cos)
            }
        };
        let force = self.force(x);
        let omega_slope = match phase {
            Phase::Lead => -force / (machine.bed_mass * r * omega),
            Phase::Crank => self.crank_slope(angle, omega),
        };
        Some(DriveState { phase, x, force, velocity, omega, omega_slope })
    }

    fn lead_omega(&self, angle: f64) -> Option<f64> {
        let machine = &self.machine;
        let square =
            machine.bed_speed * machine.bed_speed - 2.0 * self.work(machine.crank_radius * angle) / machine.bed_mass;
        (square > 0.0).then(|| square.sqrt() / machine.crank_radius)
    }

    /// 4 p0 F/(m r), and the bracket of the law with its slope by D.
    fn bracket(&self, left: f64) -> (f64, f64, f64) {
        let machine = &self.machine;
        let (k, power) = (machine.exponent, machine.exponent - 1.0);
        let behind = machine.column - machine.stroke();
        let (end, delta) = (libm::exp(k * libm::log(machine.column / behind)), left / behind);
        let less = g_minus_one(delta, power);
        let slope = if delta < SERIES_LIMIT {
            -g_divided_difference(delta, delta, power)
        } else {
            (libm::exp(-k * libm::log1p(delta)) - 1.0 - less) / delta
        };
        let scale = 2.0 * self.unit_force() / (machine.bed_mass * machine.crank_radius);
        (scale, end - 1.0 + end * less, end * slope / behind)
    }

    /// The overrun that is left at an angle of phase 2, m.
    fn energy_left(&self, angle: f64) -> f64 {
        let half = libm::sin(0.5 * (FRAC_PI_2 - angle));
        2.0 * self.machine.crank_radius * half * half
    }

    fn crank_omega(&self, angle: f64) -> Option<f64> {
        let (r, left) = (self.machine.crank_radius, self.energy_left(angle));
        let (scale, bracket, _) = self.bracket(left);
        let closed = scale * bracket / (2.0 - left / r);
        let square = if self.misfit == 0.0 {
            closed
        } else {
            let reach = r * cosine(angle);
            closed + self.misfit / (reach * reach)
        };
        (square > 0.0 && square.is_finite()).then(|| square.sqrt())
    }

    /// dω/dφ' from ω² as a function of D, with dD/dφ' = −r cos φ'.
    fn crank_slope(&self, angle: f64, omega: f64) -> f64 {
        let (r, left, cos) = (self.machine.crank_radius, self.energy_left(angle), cosine(angle));
        let (scale, bracket, slope) = self.bracket(left);
        let share = 2.0 - left / r;
        let closed = -r * cos * scale * (slope + bracket / (r * share)) / share;
        let open =
            if self.misfit == 0.0 { 0.0 } else { 2.0 * self.misfit * libm::sin(angle) / (r * r * cos * cos * cos) };
        (closed + open) / (2.0 * omega)
    }

    /// Time of a phase up to an angle, s: ∫ dφ/ω; the part in which the bed moves.
    #[must_use]
    pub fn time_of(&self, phase: Phase, angle: f64) -> f64 {
        self.time_between(phase, 0.0, angle, PANELS)
    }

    /// Time between two angles of a phase, s, by `panels` panels of eight points. Over a whole phase [`Drive::time_of`] errs by less
    /// than 1e-10 for a machine that closes and is not compressed beyond a tenth of its column; an open machine's integrand has an end
    /// that is not smooth.
    #[must_use]
    pub fn time_between(&self, phase: Phase, from: f64, to: f64, panels: u32) -> f64 {
        quadrature::integrate(
            |angle| {
                let omega = match phase {
                    Phase::Lead => self.lead_omega(angle),
                    Phase::Crank => self.crank_omega(angle),
                };
                omega.map_or(0.0, |omega| 1.0 / omega)
            },
            (from, to),
            panels,
        )
    }

    /// Least speed of the crank of a machine that closes.
    ///
    /// ω falls through phase 1. In phase 2 dω/dφ' = 0 where (2 r − D) B' + B = 0, B the bracket; the left side rises with D, since
    /// its slope is (2 r − D) B'' and g is convex: one root, or the end of the stroke, or its start without lead.
    #[must_use]
    pub fn least_speed(&self) -> LeastSpeed {
        let r = self.machine.crank_radius;
        let left = if self.machine.lead_angle == 0.0 {
            r
        } else if self.fall_of_speed(0.0) >= 0.0 {
            0.0
        } else {
            root::bracketed(|left| self.fall_of_speed(left), 0.0, r, 0.0).unwrap_or(r)
        };
        let phase_angle = FRAC_PI_2 - 2.0 * libm::asin((0.5 * left / r).sqrt());
        let (scale, bracket, _) = self.bracket(left);
        let omega = (scale * bracket / (2.0 - left / r)).sqrt();
        LeastSpeed { omega, phase_angle, drop: 1.0 - omega / self.omega_before() }
    }

    /// (2 r − D) B' + B, which has the sign of −dω/dφ' where an overrun D, m, is left.
    fn fall_of_speed(&self, left: f64) -> f64 {
        let (_, bracket, slope) = self.bracket(left);
        (2.0 * self.machine.crank_radius - left) * slope + bracket
    }

    /// Greatest speed of the crank of a machine that closes, rad/s, and the crank angle of the braking: before it or at its end.
    #[must_use]
    pub fn greatest_speed(&self) -> Extremum {
        let end = self.crank_omega(FRAC_PI_2).unwrap_or(0.0);
        let before = Extremum { at: 0.0, value: self.omega_before() };
        if end > before.value { Extremum { at: self.machine.lead_angle + FRAC_PI_2, value: end } } else { before }
    }

    /// Energy, J, that goes back and forth in a drive of an inertia J at the crank (kg·m²): ½ J (ω_max² − ω_min²).
    #[must_use]
    pub fn energy_swing(&self, inertia: f64) -> f64 {
        let (most, least) = (self.greatest_speed().value, self.least_speed().omega);
        0.5 * inertia * (most - least) * (most + least)
    }
}

/// cos of an angle up to 90°: exactly 0 at the angle that means 90°.
fn cosine(angle: f64) -> f64 {
    libm::sin(FRAC_PI_2 - angle)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::press::buffer::tests::Random;
    use camgen_kernel::units::KILOGRAM_FORCE;

    fn dp(column: f64) -> BufferedBed {
        BufferedBed {
            bed_mass: 1255.2512,
            crank_radius: 0.18,
            lead_angle: 60.0_f64.to_radians(),
            bed_speed: 1.6,
            column,
            ambient_pressure: 98_066.5,
            exponent: 1.3,
        }
    }

    fn reference() -> Drive {
        Drive::by_closing(dp(0.485)).expect("closes")
    }

    /// Relative, to the fifteen digits given but for L − x_e, which is a quarter of L.
    fn close(got: f64, want: f64) {
        assert!((got / want - 1.0).abs() < 2e-14, "{got} is not {want}");
    }

    fn at(drive: &Drive, phase: Phase, degrees: f64) -> DriveState {
        drive.at_phase(phase, degrees.to_radians()).expect("the bed moves")
    }

    #[test]
    fn golden_numbers() {
        let drive = reference();
        close(drive.piston_area, 0.016_557_102_307_041_4);
        close(drive.bore(), 0.145_193_517_085_133);
        let end = drive.at(150.0_f64.to_radians()).expect("moves");
        close(end.force, 17_489.993_221_065_9);
        assert!((at(&drive, Phase::Lead, 60.0).force / KILOGRAM_FORCE - 296.682_12).abs() < 5.1e-6);
        assert!((at(&drive, Phase::Lead, 30.0).velocity - 1.577_168_262_08).abs() < 5.1e-12);
        assert!((at(&drive, Phase::Lead, 60.0).velocity - 1.484_799_404_68).abs() < 5.1e-12);
        close(at(&drive, Phase::Lead, 60.0).omega, 8.248_885_581_531_74);
        close(at(&drive, Phase::Crank, 0.0).omega, 8.248_885_581_531_74);
        close(at(&drive, Phase::Crank, 20.0).omega, 7.980_352_753_155_04);
        close(at(&drive, Phase::Crank, 45.0).omega, 8.190_136_649_424_67);
        close(at(&drive, Phase::Crank, 80.0).omega, 8.752_972_289_040_87);
        close(at(&drive, Phase::Crank, 90.0).omega, 8.798_188_154_997_71);
        assert_eq!((at(&drive, Phase::Crank, 90.0).velocity, at(&drive, Phase::Crank, 90.0).omega_slope), (0.0, 0.0));
        let least = drive.least_speed();
        close(least.omega, 7.978_916_158_956_72);
        // A place where the slope of a power vanishes, to the digits given.
        assert!(
            (least.phase_angle.to_degrees() - 21.721_318_226_3).abs() < 1e-10,
            "{}",
            least.phase_angle.to_degrees()
        );
        assert!((100.0 * least.drop - 10.237_193_211_7).abs() < 5.1e-11, "{}", least.drop);
        let (lead, crank) =
            (drive.time_of(Phase::Lead, drive.machine.lead_angle), drive.time_of(Phase::Crank, FRAC_PI_2));
        assert!((lead - 0.120_435_044_229_91).abs() < 1e-14, "{lead}");
        assert!((crank - 0.189_296_177_398_34).abs() < 1e-14, "{crank}");
        // The even motion: 150° at v0/r.
        assert!((150.0_f64.to_radians() / drive.omega_before() - 0.294_524_311_3).abs() < 5.1e-11);
        let swing = drive.energy_swing(2.0) / (drive.omega_before() * drive.omega_before());
        assert!((swing - 0.194).abs() < 5.1e-4, "{swing}");
        let open = Drive::open(dp(0.485), PI * 0.145 * 0.145 / 4.0).expect("inputs have a meaning");
        let share = open.work(open.machine.stroke()) / open.machine.energy();
        assert!((share - 0.997_336_132_809).abs() < 5.1e-13, "{share}");
    }

    /// The paper's table 1 compared with the exact speeds, and its lost table 2 with a column of 484.3 mm, whose forces are
    /// those of table 1.
    #[test]
    fn the_tables_of_the_paper() {
        let drive = Drive::by_closing(dp(0.4843)).expect("closes");
        assert!((1e3 * drive.bore() - 144.9).abs() < 0.051);
        let forces = [0.0, 30.0, 65.3, 107.1, 157.5, 219.2, 296.1];
        let speeds = [160.0, 159.77, 159.05, 157.72, 155.65, 152.66, 148.48];
        let printed = [160.0, 160.0, 159.0, 157.7, 155.6, 152.6, 149.0];
        let (mut degrees, ours) = (0.0, reference());
        for ((force, speed), printed) in forces.into_iter().zip(speeds).zip(printed) {
            let state = at(&drive, Phase::Lead, degrees);
            assert!(
                (state.force / KILOGRAM_FORCE - force).abs() < 0.051,
                "{degrees}°: {}",
                state.force / KILOGRAM_FORCE
            );
            let got = 100.0 * at(&ours, Phase::Lead, degrees).velocity;
            assert!((got - speed).abs() < 5.1e-3, "{degrees}°: {got}");
            assert!((got / printed - 1.0).abs() < 3.5e-3, "{degrees}°: slide rule, {got}");
            degrees += 10.0;
        }
        let motor = [1303.6, 1272.4, 1261.4, 1266.1, 1283.1, 1308.4, 1337.6, 1365.0, 1384.7, 1392.0];
        let mut degrees = 0.0;
        for rpm in motor {
            let got = 158.0 * at(&drive, Phase::Crank, degrees).omega;
            // The column of the fit is given to 0.05 mm, which moves the last of them by 0.3.
            assert!((got - rpm).abs() < 0.4, "{degrees}°: {got}");
            degrees += 10.0;
        }
        let least = drive.least_speed();
        assert!((100.0 * (1.0 - 158.0 * least.omega / 1400.0) - 9.92).abs() < 0.011);
        assert!((100.0 * least.drop - 10.20).abs() < 0.011 && (least.phase_angle.to_degrees() - 21.6).abs() < 0.051);
        // (16): 158 rpm for 1 rad/s is a ratio of 16.546.
        let state = at(&drive, Phase::Lead, 0.0);
        assert!((state.motor_rpm(16.546) / (158.0 * state.omega) - 1.0).abs() < 5e-5);
        assert!((state.torque(3.0) - 3.0 * state.omega * state.omega_slope).abs() < 1e-15);
    }

    #[test]
    fn a_machine_that_does_not_close_is_told_what_would() {
        for bore in [0.14, 0.145, 0.1452, 0.15, 0.2] {
            let area = PI * bore * bore / 4.0;
            let error = Drive::with_area(dp(0.485), area).expect_err("does not close");
            let open = Drive::open(dp(0.485), area).expect("inputs have a meaning");
            let remedies = match error {
                DriveError::ArrivesWithSpeed { speed, remedies } => {
                    assert!(bore < 0.145_19, "{error}");
                    let left = 2.0 * (open.machine.energy() - open.work(open.machine.stroke())) / 1255.2512;
                    assert!((speed * speed - left).abs() < 1e-14, "{speed}");
                    remedies
                }
                DriveError::StopsEarly { x, remedies, .. } => {
                    assert!(bore > 0.145_19, "{error}");
                    assert!((open.work(x) / open.machine.energy() - 1.0).abs() < 1e-13, "{x}");
                    assert_eq!(open.at(150.0_f64.to_radians()), None);
                    remedies
                }
                other => panic!("{other}"),
            };
            let column = remedies.column.expect("there is one");
            let closed = [
                (dp(0.485), PI * remedies.bore * remedies.bore / 4.0),
                (dp(column), area),
                (BufferedBed { ambient_pressure: remedies.ambient_pressure, ..dp(0.485) }, area),
            ];
            for (machine, area) in closed {
                assert!(Drive::with_area(machine, area).is_ok(), "{machine:?} {area}");
            }
        }
        let weak = BufferedBed { exponent: 1.0, ..dp(0.485) };
        assert_eq!(weak.closing_column(1e-6), None);
        let error = Drive::with_area(weak, 1e-6).expect_err("does not close");
        assert!(error.to_string().contains("no column"), "{error}");
    }

    #[test]
    fn refuses_inputs_without_a_meaning() {
        let cases = [
            BufferedBed { column: 0.36, ..dp(0.485) },
            BufferedBed { exponent: 0.9, ..dp(0.485) },
            BufferedBed { bed_mass: 0.0, ..dp(0.485) },
            BufferedBed { lead_angle: -0.1, ..dp(0.485) },
            BufferedBed { bed_speed: f64::NAN, ..dp(0.485) },
        ];
        for machine in cases {
            assert!(Drive::by_closing(machine).is_err(), "{machine:?}");
        }
        assert!(Drive::open(dp(0.485), 0.0).is_err());
    }

    /// 10 000 machines: the work of the closing bore is the bed's energy by quadrature of the force as printed, and ω of phase 2 is
    /// v/(r cos φ') by that work.
    #[test]
    fn closed_forms_are_what_quadrature_finds() {
        let mut random = Random(31);
        for round in 0..10_000 {
            let lead_angle = if round % 10 == 0 { 0.0 } else { random.between(0.0, 1.5) };
            let r = random.between(0.05, 0.5);
            let machine = BufferedBed {
                bed_mass: random.of_size(10.0, 1e4),
                crank_radius: r,
                lead_angle,
                bed_speed: random.of_size(0.1, 10.0),
                column: r * (1.0 + lead_angle) / random.between(0.05, 0.95),
                ambient_pressure: random.of_size(1e4, 1e6),
                exponent: if round % 7 == 0 { 1.0 } else { random.between(1.0, 2.0) },
            };
            let drive = Drive::by_closing(machine).expect("closes");
            let printed = |x: f64| {
                let ratio = libm::pow(machine.column / (machine.column - x), machine.exponent);
                2.0 * machine.ambient_pressure * drive.piston_area * (ratio - 1.0)
            };
            let stroke = machine.stroke();
            // By τ = −ln(1 − x/L) the force is a sum of exponentials, smooth however far the air is compressed.
            let between = |low: f64, high: f64| {
                let log = |x: f64| -libm::log1p(-x / machine.column);
                let by_log = |t: f64| printed(-machine.column * libm::expm1(-t)) * machine.column * libm::exp(-t);
                quadrature::integrate(by_log, (log(low), log(high)), 4)
            };
            let whole = between(0.0, stroke);
            assert!((whole / machine.energy() - 1.0).abs() < 1e-10, "{machine:?}: {whole}");
            let angle = random.between(0.0, 1.5);
            let state = drive.at_phase(Phase::Crank, angle).expect("moves");
            let rest = between(state.x, stroke);
            let speed = (2.0 * rest / machine.bed_mass).sqrt();
            // x is known to an ulp of the stroke, and what is left of it at 86° is 0.0025 r.
            assert!((state.velocity / speed - 1.0).abs() < 1e-10, "{machine:?} {angle}: {state:?} {speed}");
            let angle = random.between(0.0, lead_angle);
            let (state, work) = (drive.at(angle).expect("moves"), between(0.0, r * angle));
            let speed = (machine.bed_speed * machine.bed_speed - 2.0 * work / machine.bed_mass).sqrt();
            assert!((state.velocity / speed - 1.0).abs() < 1e-10, "{machine:?} {angle}: {state:?} {speed}");
        }
    }

    /// Slope of ω and least ω against differences and a scan, for closed and open machines.
    #[test]
    fn slopes_belong_to_the_speed() {
        let mut random = Random(37);
        let h = 1e-5;
        for round in 0..500 {
            let lead_angle = random.between(0.2, 1.5);
            let mut machine = dp(0.18 * (1.0 + lead_angle) / random.between(0.2, 0.9));
            machine.lead_angle = lead_angle;
            let closed = Drive::by_closing(machine).expect("closes");
            let drive = if round % 2 == 0 {
                closed
            } else {
                Drive::open(machine, 0.999 * closed.piston_area).expect("inputs have a meaning")
            };
            let omega = |phase: Phase, angle: f64| drive.at_phase(phase, angle).expect("moves").omega;
            for (phase, angle) in
                [(Phase::Lead, random.between(0.01, lead_angle)), (Phase::Crank, random.between(0.01, 1.4))]
            {
                let quotient = (omega(phase, angle + h) - omega(phase, angle - h)) / (2.0 * h);
                let slope = drive.at_phase(phase, angle).expect("moves").omega_slope;
                // h²/6 of the third derivative, which near a tight end is some thousand times ω, and 1e-16/h.
                assert!(
                    (slope - quotient).abs() < 1e-6 * (omega(phase, angle) + slope.abs()),
                    "{machine:?} {angle}: {slope} {quotient}"
                );
            }
            let least = closed.least_speed();
            for i in 0..=90 {
                let state = at(&closed, Phase::Crank, f64::from(i));
                assert!(state.omega >= least.omega * (1.0 - 1e-14), "{machine:?} {i}°: {least:?}");
            }
            let there = closed.at_phase(Phase::Crank, least.phase_angle).expect("moves");
            assert!((there.omega / least.omega - 1.0).abs() < 1e-13);
        }
    }
}
