//! The table of keys as data, for fields and sliders: what a value of each may be, its range, its units and what it means.

use crate::catalogue::catalogue;
use camgen_kernel::document::{Key, KeyForm, KeySection, Occurrence, Presence, ValueRange};
use camgen_kernel::motion::laws::{LAWS, LawCurve, LawTask};
use camgen_kernel::units::{self, Dimension};
use serde_json::{Map, Value, json};

/// Every table with its keys, and the units of each dimension with their sizes in SI.
pub(super) fn table() -> Value {
    let mut units = Map::new();
    let sections: Vec<Value> =
        catalogue().keys.sections.iter().map(|section| section_of(section, &mut units)).collect();
    json!({"sections": sections, "units": units, "laws": laws()})
}

fn section_of(section: &KeySection, units: &mut Map<String, Value>) -> Value {
    let keys: Vec<Value> = section.keys.iter().map(|key| key_of(section, key, units)).collect();
    json!({"path": section.path, "about": section.about, "repeated": section.occurs == Occurrence::Repeated, "keys": keys})
}

fn key_of(section: &KeySection, key: &Key, units: &mut Map<String, Value>) -> Value {
    let (kind, example) = match key.presence {
        Presence::Required(text) | Presence::RequiredUnless(_, text) => ("required", text),
        Presence::Default(text) => ("default", text),
        Presence::Optional(text) => ("optional", text),
    };
    let mut field = json!({
        "name": key.name, "about": key.about, "presence": kind, "example": example,
        "cams": catalogue().keys.listed(section.cams_of(key)), "halves": key.halved,
    });
    let ranges: Vec<Value> = key.form.ranges().into_iter().map(|range| range_of(range, units)).collect();
    if !ranges.is_empty() {
        field["ranges"] = Value::from(ranges);
    }
    match key.form {
        KeyForm::Words(words) | KeyForm::WordsOrQuantity(words, ..) => field["words"] = json!(words),
        KeyForm::Boolean => field["words"] = json!(["true", "false"]),
        KeyForm::Columns => field["file"] = Value::Bool(true),
        KeyForm::Text
        | KeyForm::TextOrNumber
        | KeyForm::Number(_)
        | KeyForm::Share(_)
        | KeyForm::Numbers(_)
        | KeyForm::Texts
        | KeyForm::Quantity(..)
        | KeyForm::LengthOrAngle(..)
        | KeyForm::AngleOrLength(..)
        | KeyForm::LengthAngleOrShare(..)
        | KeyForm::Either(..)
        | KeyForm::Band(..)
        | KeyForm::Pair(..)
        | KeyForm::Points(..) => {}
    }
    field
}

fn range_of(range: ValueRange, units: &mut Map<String, Value>) -> Value {
    let name = range.dimension.map(|dimension| dimension.to_string());
    if let (Some(dimension), Some(name)) = (range.dimension, &name) {
        units.entry(name.clone()).or_insert_with(|| units_of(dimension));
    }
    let (low, high) = range.bounds.ends();
    json!({"dimension": name, "low": low, "high": high})
}

/// The units of a dimension, in all their spellings, with their sizes in SI.
fn units_of(dimension: Dimension) -> Value {
    let symbols = dimension.unit_list();
    let all = symbols.split(", ").map(str::to_owned).chain(dimension.spellings().map(str::to_owned));
    let sizes = all.filter_map(|symbol| {
        let quantity = units::parse(&format!("1 {symbol}"), dimension).ok()?;
        Some((symbol, json!(quantity.si)))
    });
    Value::Object(sizes.collect())
}

/// Places of the picture of a law.
const PICTURED: u32 = 24;

/// The laws from rest to rest: the name, the largest velocity, acceleration and jerk for a travel of 1 over a width of 1 (`null` where the one before
/// jumps, at a rest too), and its lift, velocity and acceleration at even places.
fn laws() -> Vec<Value> {
    let laws = LAWS.iter().filter(|law| law.serves_rests()).filter_map(|law| {
        let curve = law.solve(&LawTask::default()).ok()?;
        let peaks = curve.peaks();
        let values = [peaks.velocity.value, peaks.acceleration.value, peaks.jerk.value];
        // The acceleration is infinite where the velocity jumps (continuity 0), the jerk where the acceleration does (1).
        let bounded = [true, law.continuity >= 1, law.continuity >= 2];
        let peaks = [0, 1, 2].map(|order| (bounded[order] && values[order].is_finite()).then_some(values[order]));
        let shapes = [0, 1, 2].map(|order| shape(&curve, order));
        Some(json!({"name": law.name, "peaks": peaks, "shapes": shapes}))
    });
    laws.collect()
}

/// A derivative of a law at even places, rounded for a picture.
fn shape(curve: &LawCurve, order: u32) -> Vec<f64> {
    let values = (0..=PICTURED).map(|place| {
        let x = f64::from(place) / f64::from(PICTURED);
        (1e3 * curve.derivative(curve.part_of(x), x, order)).round() / 1e3
    });
    values.collect()
}
