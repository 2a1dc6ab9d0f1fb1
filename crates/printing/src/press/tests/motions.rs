//! The motions of a press keep what every motion keeps.

use crate::press::buffer::bottom_law::{BottomLaw, ColumnRule};
use crate::press::motion::{Reversal, ReversalLaw, Transition};
use camgen_kernel::motion::contract::{Named, kept_by};

fn bottom_law(q: f64, column: ColumnRule, lead: f64) -> BottomLaw {
    BottomLaw::new((q - 1.0) / 0.18, 1.35, 0.18, column, lead)
}

#[test]
fn reversals_keep_the_contract() {
    let mut motions: Vec<Named> = Vec::new();
    let width = 20.0_f64.to_radians();
    for (q, column) in [(2.0, ColumnRule::Matched), (5.0, ColumnRule::Return), (2.0, ColumnRule::Length(0.2))] {
        for transition in [Transition::None, Transition::RunUp { width }, Transition::Blend { width }] {
            for lobes in [1, 2, 3] {
                let law = ReversalLaw { bottom_law: bottom_law(q, column, 0.0).into(), lever: 1.5, lobes, transition };
                let name = format!("{column:?} {transition:?}, {lobes} lobes");
                motions.push((name, Box::new(Reversal::new(law).expect("fits into a turn"))));
            }
        }
    }
    let transition = Transition::RunUp { width };
    let law =
        ReversalLaw { bottom_law: bottom_law(2.0, ColumnRule::Matched, 0.01).into(), lever: 1.0, lobes: 1, transition };
    motions.push(("lead".into(), Box::new(Reversal::new(law).expect("fits"))));
    let mirrored = kept_by(&motions);
    assert!(mirrored > 10, "{mirrored}");
}
