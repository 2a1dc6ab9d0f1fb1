//! Any text as the formula of a motion: values, or a reason, without end to neither.
#![no_main]

use camgen::motion::formula::Formula;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    if text.len() > 400 {
        return;
    }
    if let Ok(formula) = Formula::parse(text, "th") {
        if formula.scanned(0.0, 1.0).is_ok() {
            assert!(formula.values_at(0.5).iter().all(|value| value.is_finite()), "{text}");
        }
    }
});
