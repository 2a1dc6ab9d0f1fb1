//! Any text as a machine file: it is read, or every fault of it is told in words that a terminal can show.
#![no_main]

use camgen::Machine;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    if let Err(error) = Machine::from_toml("fuzz.toml", text, &[]) {
        let told = error.to_string();
        assert!(!told.is_empty());
        assert!(!told.chars().any(|letter| letter.is_control() && letter != '\n'), "{told:?}");
    }
});
