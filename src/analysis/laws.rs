//! Every law of motion at the numbers of a design: peaks, and with a file what each makes of its cam.

mod told;

use super::Analysis;
use crate::body::disc::Disc;
use crate::body::{Body, Kind};
use crate::document::{Input, LengthOrAngle, cams};
use crate::geometry::MILLIMETRES;
use crate::machine::Machine;
use crate::motion::laws::{Curve, End, LAWS, Law, LawError, Task};
use crate::motion::program::Program;
use crate::motion::{Motion, Quantity};
use crate::numeric::parallel;
use crate::report::Speeds;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Laws of motion.
pub const KIND: Kind = Kind { command: "laws", noun: "laws of motion", keys: cams::MAKE };

/// Travel and cam angle of the segment when neither flags nor a file give them, m and degrees.
const USUAL: (f64, f64) = (0.03, 120.0);
/// Harmonics that are told.
const HARMONICS: u32 = 8;
/// About a ratio of rise time to natural period the worst residual is looked for within this share.
const ABOUT: f64 = 0.2;

/// What is asked for.
#[derive(Debug, Clone, Default)]
pub struct Asked {
    /// Travel of the segment; of the largest one of the file when absent, else 30 mm.
    pub lift: Option<LengthOrAngle>,
    /// Cam angle that it takes, rad; of the same segment when absent, else 120°.
    pub over: Option<f64>,
    /// Speed of the cam, rpm; that of the file when absent.
    pub rpm: Option<f64>,
    /// The column by which the laws are sorted.
    pub sort: Option<String>,
}

/// Why the laws are not compared.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LawsError {
    /// The file has no motion.
    #[error("the machine file has no [motion]: `camgen laws` compares laws for what `camgen make` cuts")]
    NoMotion,
    /// No segment can take another law.
    #[error("no segment of the program leads from rest to rest: there is none that takes another law")]
    NoRise,
    /// A length for an angle, or the other way round.
    #[error("--lift is {lift}, but the motion of the file is {motion}")]
    WrongQuantity {
        /// What was given.
        lift: &'static str,
        /// What the file has.
        motion: &'static str,
    },
    /// There is no such column.
    #[error("there is no column `{found}` to sort by; one of {known}")]
    NoColumn {
        /// As given.
        found: String,
        /// Those that there are.
        known: String,
    },
}

/// The segment that every law moves.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Rise {
    quantity: Quantity,
    /// m or rad.
    lift: f64,
    /// rad.
    over: f64,
    /// Angular speed of the cam, rad/s.
    speed: Option<f64>,
    /// Rise time over the natural period.
    periods: Option<f64>,
}

/// What is told of a law; what is not known is NaN. Derivatives are by the cam angle, m or rad per rad.
#[derive(Debug, Clone)]
struct Row {
    law: &'static Law,
    curve: Curve,
    /// Cv, Ca, Cj, C(va) and ∫a².
    coefficients: [f64; 5],
    efficiency: f64,
    /// Of what a load swings by behind the rise, over it: at the ratio, and the worst about it.
    residual: [f64; 2],
    rise: Rise,
    cam: Option<OfCam>,
}

/// What a law makes of the cam of a file.
#[derive(Debug, Clone, PartialEq)]
struct OfCam {
    pressure_angle: f64,
    convex_radius: f64,
    prime_radius: f64,
    smallest_prime_radius: f64,
    contact_force: f64,
    torque: f64,
    jump: f64,
    /// Amplitudes of the first waves of a turn, m or rad.
    harmonics: Vec<f64>,
}

impl Rise {
    fn of(program: Option<&Program>, asked: &Asked, machine: Option<&Machine>) -> Result<Self, LawsError> {
        let own = program.map(|program| program.largest_rise().ok_or(LawsError::NoRise)).transpose()?;
        let (lift, over) = own.unwrap_or((USUAL.0, USUAL.1.to_radians()));
        let (asked_quantity, lift) = match asked.lift {
            Some(LengthOrAngle::Length(lift)) => (Some(Quantity::Length), lift),
            Some(LengthOrAngle::Angle(lift)) => (Some(Quantity::Angle), lift),
            None => (None, lift),
        };
        let of_file = program.map(Motion::quantity);
        if let (Some(asked), Some(own)) = (asked_quantity, of_file)
            && asked != own
        {
            return Err(LawsError::WrongQuantity { lift: asked.words(), motion: own.words() });
        }
        let rpm = asked.rpm.or(program.and_then(Program::rpm));
        let over = asked.over.unwrap_or(over);
        let speed = rpm.map(|rpm| rpm * TAU / 60.0);
        let frequency = machine.and_then(Machine::vibration).map(|vibration| vibration.natural_frequency);
        let periods = speed.zip(frequency).map(|(speed, frequency)| over / speed * frequency);
        Ok(Self { quantity: asked_quantity.or(of_file).unwrap_or(Quantity::Length), lift, over, speed, periods })
    }
}

/// The curve of a law from rest to rest; where it has none from rest to a turn, or its straight line.
fn curve(law: &Law) -> Result<Curve, LawError> {
    let tasks = [Task::default(), Task::between(End::Rest, End::Turn)];
    tasks.iter().find_map(|task| law.solve(task).ok()).map_or_else(|| Ok(Curve::line()), Ok)
}

fn row(law: &'static Law, rise: Rise, cam: Option<OfCam>) -> Option<Row> {
    let curve = curve(law).ok()?;
    let peaks = curve.peaks();
    // A jump of the velocity at the ends is an impact, one of the acceleration a jerk without bound.
    let jumps = |order: usize, peak: f64| {
        let ends = [curve.at(0, 0.0), curve.at(curve.parts().saturating_sub(1), 1.0)];
        let turns = !law.serves_rests();
        ends.iter()
            .take(if turns { 1 } else { 2 })
            .any(|end| end.get(order).is_some_and(|value| value.abs() > 1e-9 * peak))
    };
    let impact = jumps(1, peaks.velocity.value);
    let or = |jumps: bool, value: f64| if jumps { f64::INFINITY } else { value };
    let acceleration = or(impact, peaks.acceleration.value);
    let jerk = or(impact || jumps(2, peaks.acceleration.value), peaks.jerk.value);
    let residual = rise.periods.filter(|_| law.serves_rests()).map_or([f64::NAN; 2], |periods| {
        let about = (1.0 - ABOUT) * periods..(1.0 + ABOUT) * periods;
        [curve.residual(periods), curve.largest_residual(about).value]
    });
    Some(Row {
        law,
        coefficients: [
            peaks.velocity.value,
            acceleration,
            jerk,
            or(impact, peaks.torque.value),
            or(impact, peaks.square),
        ],
        efficiency: curve.efficiency_of(&peaks).unwrap_or(f64::NAN),
        residual,
        curve,
        rise,
        cam,
    })
}

/// What a law makes of the cam of a machine; `None` where the law does not serve its program, or there is no such cam.
fn of_cam(machine: &Machine, program: &Program, law: &'static Law, rpm: Option<f64>) -> Option<OfCam> {
    let program = program.with_law(law)?;
    let waves = program.harmonics(HARMONICS).waves;
    let harmonics = waves.iter().map(|[cosine, sine]| libm::hypot(*cosine, *sine)).collect();
    let disc = Disc::of_motion(machine, Arc::new(program), rpm).ok()?;
    let jump = disc.jump().and_then(Result::ok).map_or(f64::NAN, |jump| jump.value);
    let most = |found: Option<f64>| found.unwrap_or(f64::NAN);
    Some(OfCam {
        pressure_angle: disc.pressure_angle().value,
        convex_radius: disc.least_rolled_radius().value,
        prime_radius: disc.prime_radius(),
        smallest_prime_radius: most(disc.smallest_prime_radius()),
        contact_force: most(disc.largest_contact_force()),
        torque: most(disc.torque_max().map(|torque| torque.value)),
        jump,
        harmonics,
    })
}

/// Every law at the numbers of a file, or of the flags alone.
///
/// # Errors
/// [`LawsError`] when the file has no motion, none of its segments leads from rest to rest, or there is no column to sort by.
pub fn analysis(machine: Option<&Machine>, asked: &Asked) -> Result<Analysis, LawsError> {
    let program = machine.map(|machine| machine.program().ok_or(LawsError::NoMotion)).transpose()?;
    let rise = Rise::of(program, asked, machine)?;
    let rpm = asked.rpm.or(program.and_then(Program::rpm));
    let laws: Vec<&'static Law> = LAWS.iter().collect();
    let made = parallel::map(&laws, |&law| {
        let cam = machine.zip(program).and_then(|(machine, program)| of_cam(machine, program, law, rpm));
        row(law, rise, cam)
    });
    let mut rows: Vec<Row> = made.into_iter().flatten().collect();
    let sorted_by = told::sort(&mut rows, asked.sort.as_deref())?;
    let name = machine.map_or("laws", Machine::name);
    let mut inputs = vec![Input::word("command", KIND.command)];
    inputs.extend(machine.iter().flat_map(|machine| machine.inputs(KIND.keys)));
    inputs.extend(rpm.map(|rpm| Input::number("rpm", rpm)));
    let unit = if rise.quantity == Quantity::Length { ("mm", 1e-3) } else { ("deg", 1.0_f64.to_radians()) };
    inputs.push(Input::quantity("lift", rise.lift, unit));
    inputs.push(Input::quantity("over", rise.over, ("deg", 1.0_f64.to_radians())));
    inputs.push(Input::word("sort", sorted_by));
    Ok(Analysis {
        kind: &KIND,
        machine: name.to_owned(),
        speeds: rpm.map_or(Speeds::Any(()), Speeds::One),
        inputs,
        sections: vec![told::section(&rows, rise, machine.is_some())],
        measures: Vec::new(),
        notes: machine.map(|machine| machine.idle_keys_told(KIND.keys, KIND.noun)).unwrap_or_default(),
        plot: told::plot(name, &rows, rise),
        mechanism: None,
        document: None,
        tables: vec![("", told::table(&rows))],
        by: &[],
        along: "cv",
        not_modelled: Vec::new(),
    })
}

/// A length in millimetres.
fn mm(length: f64) -> f64 {
    MILLIMETRES * length
}
