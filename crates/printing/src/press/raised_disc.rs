//! A disc that is cut higher, so that its follower keeps the law on a shaft that deflects.
//!
//! Under load the follower is to be where the law has it, under the force Φ of the law, independent of the shaft. So the cam
//! is cut higher by
//!
//! ```text
//! z = Φ [C (1 + tan² α) + s'²/k_t]
//! ```
//!
//! with pressure angle α and slope s' of the cam as it is cut, z and all: a fixed point, found at the points of a Chebyshev series
//! over the reversal. Before and after it the transitions meet that shape.

use super::machine::{Press, only_under_a_yoke};
use super::motion::RaiseSeries;
use super::scatter::error::ScatterError;
use crate::press::MachineOfPress;
use camgen_cams::body::disc::Disc;
use camgen_cams::body::{Body, ShaftCompliance};
use camgen_cams::machine::Machine;
use camgen_cams::report::Section;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::numeric::chebyshev_series::ChebyshevSeries;
use camgen_kernel::refusal::Refusal;
use camgen_kernel::text::{Length, LengthKind, Text, text};
use serde_json::json;
use std::sync::Arc;

/// Terms of the series, and the share of its largest below which one is rounding.
const TERMS: u32 = 40;
const ROUNDING: f64 = 1e-15;
/// Fixed points are tried so often; they agree to a hundredth of a nanometre.
const ROUNDS: usize = 24;
const AGREED: f64 = 1e-11;

/// The compliance of the shaft at its cam, if the cam is compensated for it; or why it is unknown.
#[derive(Debug, Clone, PartialEq)]
pub struct CutForShaft(pub Result<ShaftCompliance, String>);

/// The disc that keeps a law over a crank angle (rad) on a shaft with this compliance, from the one that is cut for a rigid shaft: `cut`
/// makes it from what the bottom is raised by. Where it is cut for its train, the bottom is raised by that too.
///
/// # Errors
/// [`Refusal`] where the shaft deflects too much.
pub(super) fn cut_for(
    of_law: &Disc,
    angle: f64,
    lever: f64,
    shaft: &ShaftCompliance,
    train: Option<&RaiseSeries>,
    cut: impl Fn(Arc<RaiseSeries>) -> Result<Disc, Refusal>,
) -> Result<Arc<RaiseSeries>, Refusal> {
    let range = (0.0, angle);
    let points = ChebyshevSeries::points(range, TERMS);
    let (mut shape, mut before) = (of_law.clone(), vec![0.0; points.len()]);
    for _ in 0..ROUNDS {
        let mut heights = Vec::with_capacity(points.len());
        for crank in &points {
            let of_train = train.map_or(0.0, |train| train.at(*crank)[0]);
            heights.push(of_train + height(of_law, &shape, *crank, shaft) / lever);
        }
        let apart = heights.iter().zip(&before).map(|(new, old)| (new - old).abs()).fold(0.0, f64::max);
        let raise = Arc::new(RaiseSeries::new(&ChebyshevSeries::through(range, &heights, ROUNDING)));
        if apart * lever < AGREED {
            return Ok(raise);
        }
        shape = cut(raise)?;
        before = heights;
    }
    Err(Refusal::new(
        "the cam cannot be cut for its shaft (shaft.compensate): what bending and twist take off the lift grows \
         faster than it can be put on",
    )
    .remedy("make the shaft thicker, or put the drive (shaft.drive_at) nearer to the cam"))
}

/// By how much the bottom is raised for the train of a machine, m ω² x/c at the overrun x; `None` where no cam is cut for it.
///
/// # Errors
/// [`Refusal`] under a linkage, and where the train gives way faster than the bed comes.
pub(super) fn for_train(machine: &Machine, rpm: f64) -> Result<Option<Arc<RaiseSeries>>, Refusal> {
    let press = machine.press()?;
    let Some(stiffness) = press.compensated_train else { return Ok(None) };
    let law = press.bottom_law(rpm);
    if law.of_yoke().is_none() {
        return Err(only_under_a_yoke(
            "a cam is cut for its train",
            "the force is no function of the place of the bed",
        ));
    }
    let Some(share) = press.train_gives(rpm) else {
        let speed = press.bed.crank_speed(rpm);
        return Err(ScatterError::TrainTooSoft { stiffness, needed: press.bed.mass * speed * speed }.into());
    };
    let range = (0.0, law.angle());
    let heights: Vec<f64> =
        ChebyshevSeries::points(range, TERMS).iter().map(|crank| share * law.bed(*crank)[0]).collect();
    Ok(Some(Arc::new(RaiseSeries::new(&ChebyshevSeries::through(range, &heights, ROUNDING)))))
}

/// How much higher a cam must be cut at a crank angle of its first reversal, m of lift, by the shape of the one that is cut.
fn height(of_law: &Disc, cut: &Disc, crank: f64, shaft: &ShaftCompliance) -> f64 {
    let (motion, shape) = (of_law.curves().motion, cut.curves());
    let angle = crank / f64::from(motion.lobes());
    let (piece, inside) = motion.locate(angle);
    let force = of_law.path_force(piece, inside).unwrap_or(0.0).max(0.0);
    let (piece, inside) = shape.motion.locate(angle);
    let contact = shape.contact(piece, inside);
    let lean = libm::tan(contact.pressure_angle);
    force * (shaft.compliance * (1.0 + lean * lean) + shaft.twist * contact.lift.ds * contact.lift.ds)
}

/// The section of the report on how much higher than its law a disc is cut for its train.
pub(super) fn train_section(press: &Press, rpm: f64, lever: f64) -> Option<Section> {
    let mm = MILLIMETRES * lever * press.train_gives(rpm)? * press.bed.crank_radius;
    let words = text!(
        "cut up to {} higher, at the dead point, for the train that gives way (cam.compensate_train): the forces balance at this speed; play of \
         the train is taken by the screw",
        Length::mm(mm).decimals(4)
    );
    let figure = text!("cut up to {} higher for its train", Length::mm(mm).decimals(4));
    Some(
        Section::new("cut_for_train", &json!({"raised_max_mm": mm})).with_words(vec![words]).with_figures(vec![figure]),
    )
}

/// What the twist of the shaft leaves because its angle is finite, m: the lift at the twisted angle less that on the tangent.
fn left_by_twist(disc: &Disc) -> f64 {
    let Some(CutForShaft(Ok(shaft))) = disc.machine().part() else { return 0.0 };
    let motion = disc.curves().motion;
    let largest = disc.largest_force(|piece, angle| {
        let lift = motion.jet(piece, angle);
        let twisted = shaft.twist * disc.path_force(piece, angle).unwrap_or(0.0) * lift.ds;
        let (there, inside) = motion.locate(angle - twisted);
        (motion.jet(there, inside).s - (lift.s - twisted * lift.ds)).abs()
    });
    largest.value
}

/// The section of the report on how much higher than its law a disc is cut.
pub(super) fn section(disc: &Disc) -> Section {
    let highest = disc.largest_force(|piece, angle| disc.added_lift(piece, angle));
    let mm = MILLIMETRES * highest.value;
    let left = MILLIMETRES * left_by_twist(disc);
    let value = json!({"raised_max_mm": mm, "raised_cam_deg": highest.at.to_degrees(), "left_by_twist_mm": left});
    let finite = if left > 0.0 {
        text!(
            "; bending and twist are those of small angles, and the finite angle of the twist leaves {}",
            Length::new(1e3 * left, &LengthKind::UM).decimals(2)
        )
    } else {
        Text::default()
    };
    let words = text!(
        "cut up to {} higher, at {}°, for the shaft of the file (shaft.compensate): its follower keeps the law under load \
         at this speed, and would be that much too high on a rigid shaft; forces are those under load{}",
        Length::mm(mm).decimals(4),
        format_args!("{:.3}", highest.at.to_degrees()),
        finite
    );
    let figure = text!("cut up to {} higher for its shaft", Length::mm(mm).decimals(4));
    Section::new("cut_for_shaft", &value).with_words(vec![words]).with_figures(vec![figure])
}
