//! The section of the report on a pair of conjugate discs.

use crate::body::closure::Closure;
use crate::body::{Body, curves};
use crate::geometry::MILLIMETRES;
use crate::motion::Quantity;
use crate::report::{Section, shown};

/// The section of the report on a pair.
pub(crate) fn section(found: &Closure, counter: &dyn Body) -> Section {
    let of = curves(counter).map(|curves| (curves, curves.follower.prime_radius().unwrap_or(f64::NAN)));
    let (roller, prime) = of.map_or((f64::NAN, f64::NAN), |(curves, prime)| (curves.offset(), prime));
    let [roller, prime] = [roller, prime].map(|length| MILLIMETRES * length);
    let value = serde_json::json!({
        "counter_prime_radius_mm": prime,
        "counter_base_radius_mm": prime - roller,
        "counter_roller_radius_mm": roller,
        "closure": found,
    });
    let size = format!(
        "counter disc: base radius {} mm, roller Ø{} mm, prime radius {} mm",
        shown(prime - roller),
        shown(2.0 * roller),
        shown(prime)
    );
    let swings = curves(counter).is_some_and(|curves| curves.motion.quantity() == Quantity::Angle);
    let along = if swings { "along the arc of the first roller" } else { "along the path" };
    let sum = format!(
        "both lifts as written add up to the largest within {} to {} mm {along}",
        shown(found.play_mm),
        shown(found.pinch_mm)
    );
    Section::new("conjugate", &value).with_words(vec![size, sum])
}
