//! Any text as a quantity of every dimension: a finite number, which is the same again in its own words.
#![no_main]

use camgen::units::{Dimension, parse, parse_bare};
use libfuzzer_sys::fuzz_target;

const DIMENSIONS: [Dimension; 8] = [
    Dimension::Length,
    Dimension::Angle,
    Dimension::Mass,
    Dimension::Pressure,
    Dimension::Force,
    Dimension::Time,
    Dimension::Stiffness,
    Dimension::Frequency,
];

fuzz_target!(|text: &str| {
    for dimension in DIMENSIONS {
        if let Ok(quantity) = parse(text, dimension) {
            assert!(quantity.si.is_finite(), "{text}");
            let again = parse(&quantity.in_same_unit(quantity.si), dimension).expect("its own words");
            // Numbers next to 0 have fewer digits.
            assert!((again.si - quantity.si).abs() <= 1e-9 * quantity.si.abs() + 1e-290, "{text}: {} {}", again.si, quantity.si);
        }
    }
    if let Ok(number) = parse_bare(text) {
        assert!(number.is_finite(), "{text}");
    }
});
