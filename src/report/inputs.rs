//! The hash of everything that determines a part, which its files carry: files with the same hash are of the same part.

use crate::document::Input;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::fmt;

/// Hexadecimal digits of a hash: of a million parts two have the same with a probability of 0.2 %.
const DIGITS: usize = 12;

/// From which inputs a part was made, and by which version of camgen.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Inputs {
    /// The first twelve hexadecimal digits of SHA-256 of the inputs.
    pub hash: String,
    /// Version of camgen.
    pub camgen: String,
}

impl Inputs {
    /// Of all inputs, whatever their order.
    #[must_use]
    pub fn of(inputs: &[Input]) -> Self {
        let mut lines: Vec<(&str, &str)> = inputs.iter().map(|input| (&*input.key, &*input.value)).collect();
        lines.sort_unstable();
        // A JSON text: no value can look like the next key.
        let text = serde_json::to_string(&lines).unwrap_or_default();
        let mut hash = sha256(text.as_bytes());
        hash.truncate(DIGITS);
        Self { hash, camgen: env!("CARGO_PKG_VERSION").into() }
    }
}

impl fmt::Display for Inputs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "camgen {}, inputs {}", self.camgen, self.hash)
    }
}

/// SHA-256 in hexadecimal digits.
#[must_use]
pub fn sha256(bytes: &[u8]) -> String {
    let digits = |byte: u8| [byte >> 4, byte & 0xf].map(|digit| char::from_digit(digit.into(), 16).unwrap_or_default());
    Sha256::digest(bytes).iter().flat_map(|byte| digits(*byte)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_is_of_keys_and_values_in_any_order() {
        let [a, b] = [Input::number("a", 1.0), Input::quantity("b", 0.03, ("mm", 1e-3))];
        assert_eq!(b.typed, "30 mm");
        let hash = |inputs: &[Input]| Inputs::of(inputs).hash;
        let both = hash(&[a.clone(), b.clone()]);
        assert_eq!(both.len(), 12);
        assert_eq!(both, hash(&[b.clone(), a.clone()]));
        assert_eq!(both, hash(&[a.clone(), Input::new("b", "0.03", "3 cm")]), "as typed does not matter");
        assert_ne!(both, hash(&[a.clone(), Input::number("b", 0.030_000_000_000_000_002)]));
        assert_ne!(both, hash(&[a.clone(), Input::number("c", 0.03)]));
        assert_ne!(hash(&[Input::word("a", "1\nb=2")]), hash(&[a, Input::number("b", 2.0)]));
        assert_eq!(sha256(b"abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad", "FIPS 180-4");
    }
}
