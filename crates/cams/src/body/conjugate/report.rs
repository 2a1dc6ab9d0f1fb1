//! The section of the report on a pair of conjugate discs.

use crate::body::closure::Closure;
use crate::body::{Body, curves};
use crate::report::{Finding, Section, Topic, shown};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::Quantity;
use camgen_kernel::profile::lifts;
use camgen_kernel::text::{DIGITS, Length, Text, nominal, text};

/// The checks of the counter disc that the report on both names; its own sheet has all.
const NAMED: [&str; 4] = ["pressure_angle", "undercut", "wall", "contact_stress"];

/// The section of the report on a pair, with what the checks of its counter disc found.
pub(crate) fn section(found: &Closure, main: &dyn Body, (counter_body, checks): (&dyn Body, &[Finding])) -> Section {
    let of = curves(counter_body).map(|curves| (curves, curves.follower.prime_radius().unwrap_or(f64::NAN)));
    let (roller, prime) = of.map_or((f64::NAN, f64::NAN), |(curves, prime)| (curves.offset(), prime));
    let [roller, prime] = [roller, prime].map(|length| MILLIMETRES * length);
    let value = serde_json::json!({
        "counter_prime_radius_mm": prime,
        "counter_base_radius_mm": prime - roller,
        "counter_roller_radius_mm": roller,
        "closure": found,
    });
    let size = text!(
        "counter disc: base radius {}, roller Ø{}, prime radius {}",
        Length::mm(prime - roller),
        Length::mm(2.0 * roller),
        Length::mm(prime)
    );
    let swings = curves(counter_body).is_some_and(|curves| curves.motion.quantity() == Quantity::Angle);
    let along = if swings { "along the arc of the first roller" } else { "along the path" };
    let sum = text!(
        "both lifts as written add up to the largest within {} to {} {}",
        Length::mm(found.play_mm).bare(),
        Length::mm(found.pinch_mm),
        along
    );
    let named = |name: &&str| {
        let found = checks.iter().find(|found| found.check == *name && found.value.is_finite())?;
        Some(text!("{} {}", *name, found.value_text()))
    };
    let checks: Vec<Text> = NAMED.iter().filter_map(named).collect();
    let checks = text!("checks of the counter disc, which its own sheet has in full: {}", Text::joined(checks, ", "));
    let words = [Some(size), spacing(main, counter_body), Some(sum), Some(checks)];
    let counter = text!("base R{}, roller Ø{}", Length::mm(prime - roller).brief(), Length::mm(2.0 * roller).nominal());
    let apart = rollers_apart(main, counter_body).map(|apart| match apart {
        Apart::Angle(angle) => text!("arms {}° apart", nominal(angle.to_degrees(), DIGITS)),
        Apart::Length(length) => text!("rollers {} apart", Length::mm(MILLIMETRES * length).brief()),
    });
    Section::new("conjugate", &value)
        .with_words(words.into_iter().flatten().collect::<Vec<Text>>())
        .with_fact(Topic::new(15, "counter disc"), counter.and(", ", apart))
}

/// How the two rollers are set on their follower.
pub(crate) fn spacing(main: &dyn Body, counter: &dyn Body) -> Option<Text> {
    Some(match rollers_apart(main, counter)? {
        Apart::Angle(angle) => text!("the arms of the two rollers include {}°", shown(angle.to_degrees())),
        Apart::Length(length) => {
            text!("the two rollers are {} apart along the path", Length::mm(MILLIMETRES * length))
        }
    })
}

/// How far apart two rollers are on their follower: rad of two arms, m along a path.
enum Apart {
    Angle(f64),
    Length(f64),
}

fn rollers_apart(main: &dyn Body, counter: &dyn Body) -> Option<Apart> {
    let (main, counter) = (curves(main)?, curves(counter)?);
    let apart = super::lowest(main.follower)? + super::lowest(counter.follower)? + lifts(main.motion).1;
    Some(match main.motion.quantity() {
        Quantity::Angle => Apart::Angle(apart),
        Quantity::Length => Apart::Length(apart),
    })
}
