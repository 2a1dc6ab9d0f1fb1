//! How many turns the surface of a cam withstands before it pits.

use crate::press::machine::PressCams;
use camgen_cams::check::contact_stress::ContactKind;
use camgen_cams::check::{Check, CheckExplanation, CheckScope, Measure, Subject};
use camgen_cams::report::{Bound, Verdict, shown};
use camgen_kernel::profile::Worst;

/// The check.
pub const CHECK: Check = Check {
    name: "contact_life",
    on: CheckScope::Cam,
    unit: "1",
    about: "Turns of the cam until its surface pits, where the hardness is given: a contact a turn under the largest pressure. No reliability is published with the \
            formula: it is an estimate.",
    explained: CheckExplanation {
        bound: Bound::AtLeast,
        formula: "N = 1e8 (S/p)^(1/0.056), S = 2.76 HB − 70 MPa, p the largest pressure after Hertz; good for 1e4 to 1e10 contacts (Shigley's Mechanical \
                  Engineering Design, 9th ed., §6–16, the exponent of AGMA)",
        usual: "`limits.life`; without it the figure is only reported. Below 1e4 the surface is not for running contact",
        change: "a harder cam (`cam.hardness`), a larger or wider roller, a larger `cam.base_radius`",
    },
};

/// Contact strength by the hardness, MPa: slope and offset, at 1e8 contacts.
const STRENGTH: (f64, f64) = (2.76, 70.0);
/// Contacts of that strength, and the exponent.
const CONTACTS: f64 = 1e8;
const EXPONENT: f64 = 0.056;
/// Contacts between which the formula is good.
const GOOD: (f64, f64) = (1e4, 1e10);

/// Contacts that a surface of a Brinell hardness withstands under a pressure, Pa.
#[must_use]
pub fn contacts(hardness: f64, pressure: f64) -> f64 {
    let strength = 1e6 * (STRENGTH.0 * hardness - STRENGTH.1).max(0.0);
    CONTACTS * libm::pow(strength / pressure, 1.0 / EXPONENT)
}

/// The measure of the largest pressure, Pa; `None` where neither hardness nor life is given.
#[must_use]
pub fn measure(largest: Option<Worst>, contact: ContactKind, subject: &Subject<'_>) -> Option<Measure> {
    let cams = PressCams::of(subject.machine);
    let Some(hardness) = cams.hardness else {
        return cams.life.map(|_| CHECK.unknown("limits.life is given without cam.hardness"));
    };
    let Some(worst) = largest else {
        return Some(CHECK.unknown("the pressure is not known: cam.thickness and cam.material are not both given"));
    };
    let turns = contacts(hardness, worst.value);
    let pressure = format!("HB {} under {} MPa", shown(hardness), shown(1e-6 * worst.value));
    let (verdict, note) = match cams.life {
        _ if turns < GOOD.0 => (Verdict::Fail, format!("{pressure}: not for running contact")),
        Some(life) if turns < life => (Verdict::Fail, pressure),
        None => (Verdict::Info, pressure),
        Some(_) if turns > GOOD.1 => (Verdict::Pass, format!("{pressure}: beyond the 1e10 contacts of the formula")),
        Some(_) => (Verdict::Pass, pressure),
    };
    // In a point the pressure is held from all sides, and the formula of a line is only a hint.
    let verdict = if contact != ContactKind::Line && verdict == Verdict::Fail { Verdict::Warn } else { verdict };
    Some(CHECK.measure(turns, cams.life).judged(verdict).noted(note).at(subject, &worst))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By 34-digit arithmetic, outside of the project.
    #[test]
    fn golden_lives() {
        assert!((contacts(600.0, 991.603_403_7e6) / 4.387_683_093e11 - 1.0).abs() < 1e-8);
        assert!((contacts(600.0, 4107e6) - 4.18).abs() < 5e-3);
    }
}
