//! Any bytes as a DXF file: its chains are finite, or the reader says why there are none.
#![no_main]

use camgen::reading::read;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(reading) = read(bytes, 1e-3) {
        for chain in reading.chains.iter().chain(&reading.others) {
            let (area, centroid) = chain.contour().area_and_centroid();
            assert!(!chain.closed || area.is_finite(), "{area} {centroid}");
        }
    }
});
