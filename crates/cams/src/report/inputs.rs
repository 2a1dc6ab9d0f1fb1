//! The hash of everything that determines a part, written into its files: files with the same hash belong to the same part.

use camgen_kernel::document::Input;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::fmt;

/// Hexadecimal digits of a hash: among a million parts two have the same one with a probability of 0.2 %.
const DIGITS: usize = 12;

/// The hash of the inputs of a part, and the version of camgen that made it.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Inputs {
    /// The first twelve hexadecimal digits of SHA-256 of the inputs.
    pub hash: String,
    /// Version of camgen.
    pub camgen: String,
}

impl Inputs {
    /// The hash of all inputs, in any order.
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

/// What stands before the hash in the mark of a file.
const BEFORE: &str = ", inputs ";
/// The mark stands within so many bytes from the start of a file.
const MARKED: usize = 4096;

impl Inputs {
    /// The hash that camgen has written into a file, where it has one.
    #[must_use]
    pub fn hash_in(bytes: &[u8]) -> Option<String> {
        let head = String::from_utf8_lossy(bytes.get(..MARKED).unwrap_or(bytes)).into_owned();
        let (_, after) = head.split_once("camgen ")?.1.split_once(BEFORE)?;
        let hash = after.get(..DIGITS)?;
        hash.bytes().all(|digit| digit.is_ascii_digit() || (b'a'..=b'f').contains(&digit)).then(|| hash.to_owned())
    }
}

impl fmt::Display for Inputs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "camgen {}{BEFORE}{}", self.camgen, self.hash)
    }
}

/// SHA-256 in hexadecimal digits.
#[must_use]
pub fn sha256(bytes: &[u8]) -> String {
    hexadecimal(&Sha256::digest(bytes))
}

/// Bytes as hexadecimal digits.
#[must_use]
pub fn hexadecimal(bytes: &[u8]) -> String {
    let digits = |byte: u8| [byte >> 4, byte & 0xf].map(|digit| char::from_digit(digit.into(), 16).unwrap_or_default());
    bytes.iter().flat_map(|byte| digits(*byte)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_of_a_file_is_read_back() {
        let inputs = Inputs::of(&[Input::number("a", 1.0)]);
        let marked = |mark: &str| Inputs::hash_in(format!("999\n{mark}\n  0\nSECTION\n").as_bytes());
        assert_eq!(marked(&inputs.to_string()), Some(inputs.hash.clone()));
        assert_eq!(marked(&format!("a press, {inputs}, a check failed")), Some(inputs.hash));
        for other in ["camgen 1.0", "camgen 1.0, inputs 12", "camgen 1.0, inputs 0123456789zz", "inputs 0123456789ab"] {
            assert_eq!(marked(other), None, "{other}");
        }
    }

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
