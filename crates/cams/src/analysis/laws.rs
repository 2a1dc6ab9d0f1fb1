//! Every law of motion at the numbers of a design: peaks, and with a file the figures of the cam.

mod report;

use super::{Analysis, Picture};
use crate::body::{Figures, Kind, needs_base_circle, sized_disc};
use crate::machine::Machine;
use crate::report::Speeds;
use camgen_kernel::document::{Input, LengthOrAngle, cams};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::laws::{LAWS, Law, LawCurve, LawTask, SegmentEnd};
use camgen_kernel::motion::program::{Program, SegmentSummary};
use camgen_kernel::motion::{Motion, Quantity};
use camgen_kernel::numeric::parallel;
use camgen_kernel::refusal::Refusal;
use camgen_kernel::units;
use std::sync::Arc;

/// Laws of motion.
pub const KIND: Kind = Kind { command: "laws", noun: "laws of motion", keys: cams::MAKE };

/// Travel and cam angle of the segment when neither flags nor a file give them, m and degrees.
const USUAL: (f64, f64) = (0.03, 120.0);
/// Number of harmonics in the report.
const HARMONICS: u32 = 8;
/// About a ratio of rise time to natural period the worst residual is looked for within this share.
const ABOUT: f64 = 0.2;

/// What laws are compared for.
#[derive(Debug, Clone, Default)]
pub struct LawsOptions {
    /// Travel of the segment; of the largest one of the file when absent, else 30 mm.
    pub lift: Option<LengthOrAngle>,
    /// Cam angle that it takes, rad; of that segment when absent, else 120°.
    pub over: Option<f64>,
    /// Speed of the cam, rpm; that of the file when absent.
    pub rpm: Option<f64>,
    /// The column by which the laws are sorted; by the peak acceleration when absent, those whose acceleration jumps last.
    pub sort: Option<String>,
    /// The laws that are compared; all when it is empty.
    pub laws: Vec<&'static Law>,
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

/// The figures of a law; what is not known is NaN. Derivatives are by the cam angle, m or rad per rad.
#[derive(Debug, Clone)]
struct LawRow {
    law: &'static Law,
    curve: LawCurve,
    /// Cv, Ca, Cj, C(va) and ∫a².
    coefficients: [f64; 5],
    efficiency: f64,
    /// Residual vibration of a load after the rise, over the lift: at the ratio, and the worst about it.
    residual: [f64; 2],
    rise: Rise,
    cam: Option<LawCamFigures>,
}

/// What a law makes of the cam of a file.
#[derive(Debug, Clone, PartialEq)]
struct LawCamFigures {
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

fn without_motion() -> Refusal {
    Refusal::new("the machine file has no [motion]")
        .remedy("give the file of a cam that `camgen make` cuts, or no file")
}

fn without_rise() -> Refusal {
    Refusal::new("no segment of the program leads from rest to rest").remedy("only such a segment can take another law")
}

impl Rise {
    fn of(program: Option<&Program>, asked: &LawsOptions, machine: Option<&Machine>) -> Result<Self, Refusal> {
        let own = match program {
            Some(program) => Some(program.largest_rise().ok_or_else(without_rise)?),
            None => None,
        };
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
            let (lift, motion) = (asked.words(), own.words());
            return Err(Refusal::new(format!("--lift is {lift}, but the motion of the file is {motion}")));
        }
        let rpm = asked.rpm.or(program.and_then(Program::rpm));
        let over = asked.over.unwrap_or(over);
        let speed = rpm.map(units::rad_per_s);
        let frequency = machine.and_then(Machine::vibration).map(|vibration| vibration.natural_frequency);
        let periods = speed.zip(frequency).map(|(speed, frequency)| over / speed * frequency);
        Ok(Self { quantity: asked_quantity.or(of_file).unwrap_or(Quantity::Length), lift, over, speed, periods })
    }
}

/// The law of the largest rise of a program.
fn own_law(program: &Program) -> Option<&'static str> {
    let travel = |segment: &&SegmentSummary| (segment.positions.1 - segment.positions.0).abs();
    let moves = program.segments().iter().filter(|segment| !segment.whole && travel(segment) > 0.0);
    moves.reduce(|best, next| if travel(&next) > travel(&best) { next } else { best }).map(|segment| segment.law)
}

/// The curve of a law from rest to rest; where it has none from rest to a turn, or its straight line.
fn curve(law: &Law) -> LawCurve {
    let tasks = [LawTask::default(), LawTask::between(SegmentEnd::Rest, SegmentEnd::Turn)];
    tasks.iter().find_map(|task| law.solve(task).ok()).unwrap_or_else(LawCurve::line)
}

fn row(law: &'static Law, rise: Rise, cam: Option<LawCamFigures>) -> LawRow {
    let curve = curve(law);
    let peaks = curve.peaks();
    // A jump of the velocity at the ends is an impact, one of the acceleration a jerk without bound.
    let jumps = |order: usize, peak: f64| {
        let ends = [curve.values_at(0, 0.0), curve.values_at(curve.parts().saturating_sub(1), 1.0)];
        ends.iter().any(|end| end.get(order).is_some_and(|value| value.abs() > 1e-9 * peak))
    };
    let impact = jumps(1, peaks.velocity.value);
    let or = |jumps: bool, value: f64| if jumps { f64::INFINITY } else { value };
    let acceleration = or(impact, peaks.acceleration.value);
    let jerk = or(impact || jumps(2, peaks.acceleration.value), peaks.jerk.value);
    let residual = rise.periods.filter(|_| law.serves_rests()).map_or([f64::NAN; 2], |periods| {
        let about = (1.0 - ABOUT) * periods..(1.0 + ABOUT) * periods;
        [curve.residual(periods), curve.largest_residual(about).value]
    });
    LawRow {
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
    }
}

/// What a law makes of the cam of a machine; `None` where the law does not serve its program, or there is no such cam.
fn of_cam(machine: &Machine, program: &Program, law: &'static Law, rpm: Option<f64>) -> Option<LawCamFigures> {
    let program = program.with_law(law)?;
    let waves = program.harmonics(HARMONICS).waves;
    let harmonics = waves.iter().map(|[cosine, sine]| libm::hypot(*cosine, *sine)).collect();
    let motion: Arc<dyn Motion> = Arc::new(program);
    let disc = sized_disc(machine, &motion, rpm).ok()?;
    let jump = disc.jump().and_then(Result::ok).map_or(f64::NAN, |jump| jump.value);
    let most = |found: Option<f64>| found.unwrap_or(f64::NAN);
    Some(LawCamFigures {
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
/// ```
/// # use camgen_cams as camgen;
/// use camgen::analysis::laws::{self, LawsOptions};
///
/// let all = laws::analysis(None, &LawsOptions { over: Some(1.5), rpm: Some(200.0), ..LawsOptions::default() })?;
/// let (_, table) = &all.tables[0];
/// assert!(table.rows.len() > 20 && table.columns.contains(&"cv"));
/// # Ok::<(), camgen::Refusal>(())
/// ```
///
/// # Errors
/// [`Refusal`] when the file has no motion, none of its segments leads from rest to rest, or there is no column to sort by.
pub fn analysis(machine: Option<&Machine>, asked: &LawsOptions) -> Result<Analysis, Refusal> {
    let machine = machine.map(|machine| machine.at_rpm(asked.rpm)).transpose()?;
    let machine = machine.as_ref();
    let program = match machine {
        Some(machine) => Some(machine.program().ok_or_else(without_motion)?),
        None => None,
    };
    if program.is_some_and(|program| program.stroke().is_some()) {
        let what = "laws are compared over an angle of a cam that turns, and this motion is by the travel of a plate";
        return Err(Refusal::new(what)
            .remedy("give --lift and --over without a file: cv, ca and cj are those of any length too"));
    }
    if let Some(machine) = machine {
        needs_base_circle(machine, "the cam of `camgen laws`")?;
    }
    let rise = Rise::of(program, asked, machine)?;
    let rpm = asked.rpm.or(program.and_then(Program::rpm));
    let all = || LAWS.iter().collect::<Vec<&'static Law>>();
    let laws = if asked.laws.is_empty() { all() } else { asked.laws.clone() };
    let mut rows = parallel::map(&laws, |&law| {
        let cam = machine.zip(program).and_then(|(machine, program)| of_cam(machine, program, law, rpm));
        row(law, rise, cam)
    });
    let own = program.and_then(own_law);
    let sorted_by = report::sort(&mut rows, asked.sort.as_deref())?;
    let name = machine.map_or("laws", Machine::name);
    let mut inputs = vec![Input::word("command", KIND.command)];
    inputs.extend(machine.iter().flat_map(|machine| machine.inputs(KIND.keys)));
    inputs.extend(rpm.map(|rpm| Input::number("rpm", rpm)));
    let unit = if rise.quantity == Quantity::Length { ("mm", 1e-3) } else { ("deg", 1.0_f64.to_radians()) };
    inputs.push(Input::quantity("lift", rise.lift, unit));
    inputs.push(Input::quantity("over", rise.over, ("deg", 1.0_f64.to_radians())));
    inputs.push(Input::word("sort", sorted_by));
    let named = asked.laws.iter().map(|law| law.name).collect::<Vec<_>>().join(" ");
    inputs.extend((!named.is_empty()).then(|| Input::word("laws", named)));
    Ok(Analysis {
        kind: &KIND,
        variant: "",
        machine: name.to_owned(),
        speeds: rpm.map_or(Speeds::Any(()), Speeds::One),
        inputs,
        sections: vec![report::section(&rows, rise, machine.is_some(), own)],
        measures: Vec::new(),
        notes: machine.map(|machine| machine.idle_key_notes(KIND.keys, KIND.noun)).unwrap_or_default(),
        picture: Picture::Curves(report::plot(name, &rows, rise, own)),
        mechanism: None,
        document: None,
        tables: vec![("", report::table(&rows))],
        by: &[],
        along: "cv",
        diagrams: &[],
        not_modelled: Vec::new(),
    })
}

/// A length in millimetres.
fn mm(length: f64) -> f64 {
    MILLIMETRES * length
}
