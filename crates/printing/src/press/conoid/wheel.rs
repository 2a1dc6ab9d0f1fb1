//! A conoid whose shift follows v, `conoid.shift = "v"`: one hand wheel for speed, forme and weather.
//!
//! With M the mass ratio times the squared speed ratio, and π the ratio of the ambient pressures, the residual force is
//! U π [v u − ((L/(L − x − Δx))^k − 1)], v = M/π: the law of a section depends on v alone, and so do the column and, but for the factor π, the residual
//! between two sections. So one position along the axis balances mass, speed and weather together.

use super::{Conoid, bottom_law_at};
use crate::press::machine::Shift;
use camgen_cams::report::ReportLine;
use camgen_cams::report::{Section, shown};
use camgen_kernel::geometry::MILLIMETRES;
use serde::Serialize;

/// Settings of the wheel that are listed, from the slowest section to the fastest.
const SETTINGS: u32 = 12;

/// Where the cam is for a variable v, and the screw with it.
#[derive(Debug, Serialize)]
struct WheelSetting {
    v: f64,
    /// Of the main shaft, with the mass and the ambient pressure of the machine file.
    rpm: f64,
    z_mm: f64,
    column_length_mm: f64,
    /// Of the bed, at the design speed and the ambient pressure of the file.
    mass_kg: f64,
}

/// The section's values.
#[derive(Debug, Serialize)]
struct Wheel {
    v_min: f64,
    v_max: f64,
    settings: Vec<WheelSetting>,
}

/// The section on the wheel; `None` where the shift follows the speed alone.
pub(super) fn section(conoid: &Conoid) -> Option<Section> {
    if conoid.data.shift != Shift::Variable {
        return None;
    }
    let (first, last) = (*conoid.speeds.first()?, *conoid.speeds.last()?);
    // Of one speed every setting is the same.
    let steps = if first < last { SETTINGS } else { 0 };
    let settings: Vec<WheelSetting> = (0..=steps)
        .map(|step| {
            let share = f64::from(step) / f64::from(SETTINGS);
            let rpm = match step {
                0 => first,
                SETTINGS => last,
                _ => libm::sqrt(first * first + share * (last - first) * (last + first)),
            };
            setting(conoid, rpm)
        })
        .collect();
    let ends = settings.first().map(|setting| setting.v).zip(settings.last().map(|setting| setting.v));
    let (v_min, v_max) = ends?;
    let wheel = Wheel { v_min, v_max, settings };
    let words = wheel.describe(conoid.press.design_rpm);
    Some(Section::new("wheel", &wheel).with_words(words))
}

/// v of a speed with the mass and the ambient pressure of the machine file.
pub(super) fn variable(conoid: &Conoid, rpm: f64) -> f64 {
    let ratio = rpm / conoid.press.design_rpm;
    ratio * ratio
}

fn setting(conoid: &Conoid, rpm: f64) -> WheelSetting {
    let v = variable(conoid, rpm);
    WheelSetting {
        v,
        rpm,
        z_mm: MILLIMETRES * conoid.position(rpm),
        column_length_mm: MILLIMETRES * bottom_law_at(&conoid.press, &conoid.data, rpm).column(),
        mass_kg: conoid.press.bed.mass * v,
    }
}

impl Wheel {
    fn describe(&self, design: f64) -> Vec<ReportLine> {
        let mut words: Vec<ReportLine> = vec![
            format!(
                "the shift follows v = (n/n_c)² (m/m_c)/(p0/p0_c), n_c = {} rpm, m_c and p0_c of the file: v from {} to {} balances speed, forme and \
                 weather together, exactly at the sections",
                shown(design),
                shown(self.v_min),
                shown(self.v_max)
            )
            .into(),
            ReportLine::row(format!(
                "{:>8} {:>9} {:>9} {:>11} {:>25}",
                "v", "z/mm", "rpm", "column/mm", "or moving mass at n_c/kg"
            )),
        ];
        words.extend(self.settings.iter().map(|setting| {
            ReportLine::row(format!(
                "{:>8.4} {:>9.3} {:>9.3} {:>11.3} {:>25.1}",
                setting.v, setting.z_mm, setting.rpm, setting.column_length_mm, setting.mass_kg
            ))
        }));
        words
    }
}
