//! A disc that is cut higher, so that its follower keeps the law on a shaft that gives way.
//!
//! Under load the follower is to stand where the law has it; there the force Φ is that of the law, whatever the shaft does. So the cam
//! is cut higher by
//!
//! ```text
//! z = Φ [C (1 + tan² α) + s'²/k_t]
//! ```
//!
//! with pressure angle α and slope s' of the cam as it is cut, z and all: a fixed point, found at the points of a Chebyshev series
//! over the reversal. Before and behind it the transitions meet what is cut there.

use super::{Disc, DiscError};
use crate::body::Yielding;
use crate::geometry::MILLIMETRES;
use crate::machine::Machine;
use crate::motion::Raised;
use crate::numeric::chebyshev_series::ChebyshevSeries;
use crate::report::Section;
use crate::shaft::exact::Statics;
use serde_json::json;
use std::sync::Arc;

/// Terms of the series, and the share of its largest below which one is rounding.
const TERMS: u32 = 40;
const ROUNDING: f64 = 1e-15;
/// Fixed points are tried so often; they agree to a hundredth of a nanometre.
const ROUNDS: usize = 24;
const AGREED: f64 = 1e-11;

/// The shaft of a machine at its cam, where the cam is to be cut for it.
fn yielding(machine: &Machine) -> Option<Result<Yielding, DiscError>> {
    let data = machine.shaft().filter(|data| data.compensate)?;
    let at = data.cam_at?;
    let twist = data.drive_at.map_or(0.0, |drive| data.shaft.twist_compliance(drive, at));
    let statics = Statics::new(&data.shaft, at).map_err(|error| DiscError::Shaft(error.to_string()));
    Some(statics.map(|statics| Yielding { compliance: statics.own(), twist }))
}

impl Disc {
    /// The disc of a press, cut for its shaft where the file asks for that.
    pub(super) fn cut_for_its_shaft(self, machine: &Machine, rpm: f64) -> Result<Self, DiscError> {
        let Some(shaft) = yielding(machine).transpose()? else { return Ok(self) };
        let law = machine.press()?.bottom_law(rpm);
        let (range, lever) = ((0.0, law.angle()), machine.cam.lever);
        let points = ChebyshevSeries::points(range, TERMS);
        let (mut cut, mut before) = (self.clone(), vec![0.0; points.len()]);
        for _ in 0..ROUNDS {
            let heights: Vec<f64> = points.iter().map(|crank| self.height(&cut, *crank, &shaft) / lever).collect();
            let apart = heights.iter().zip(&before).map(|(new, old)| (new - old).abs()).fold(0.0, f64::max);
            let raised = Raised::new(&ChebyshevSeries::through(range, &heights, ROUNDING));
            cut = Self::of_reversal(machine, rpm, Some(Arc::new(raised)))?.sized()?;
            if apart * lever < AGREED {
                return Ok(cut);
            }
            before = heights;
        }
        Err(DiscError::TooSoft)
    }

    /// How much higher a cam must be cut at a crank angle of its first reversal, m of lift, by the shape of the one that is cut.
    fn height(&self, cut: &Self, crank: f64, shaft: &Yielding) -> f64 {
        let angle = crank / f64::from(self.motion.lobes());
        let (piece, inside) = self.motion.locate(angle);
        let force = self.path_force(piece, inside).unwrap_or(0.0).max(0.0);
        let (piece, inside) = cut.motion.locate(angle);
        let contact = cut.curves().contact(piece, inside);
        let lean = libm::tan(contact.pressure_angle);
        force * (shaft.compliance * (1.0 + lean * lean) + shaft.twist * contact.lift.ds * contact.lift.ds)
    }

    /// What the cam is cut higher than its law, as a section of the report; `None` where it is not cut for its shaft.
    pub(super) fn cut_higher(&self) -> Option<Section> {
        let load = self.load.as_ref().filter(|_| self.raised)?;
        let highest = self.largest_force(|piece, angle| load.raised(piece, angle));
        let mm = MILLIMETRES * highest.value;
        let value = json!({"raised_max_mm": mm, "raised_cam_deg": highest.at.to_degrees()});
        let words = format!(
            "cut up to {mm:.4} mm higher, at {:.3}°, for the shaft of the file (shaft.compensate): its follower keeps the law under load at \
             this speed, and stands that much too high on a rigid shaft; forces are those under load",
            highest.at.to_degrees()
        );
        let figure = format!("cut up to {mm:.4} mm higher for its shaft");
        Some(Section::new("cut_for_shaft", &value).with_words(vec![words]).with_figures(vec![figure]))
    }
}
