//! The record of a directory: which files camgen has written into it, and from what.
//!
//! In a directory with the sticky bit, as `/tmp`, a user cannot replace the files of others. There every user has a record of his own, the first
//! of `.camgen.json`, `.camgen-1.json` … whose name is free, and what others have recorded does not count.

use super::directory::{Directory, NameState};
use crate::report::hexadecimal;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use siphasher::sip128::{Hasher128, SipHasher13};
use std::collections::BTreeMap;
use std::hash::Hasher;
use std::io::{self, Read};

/// Name of the record in the directory of the files.
pub const RECORD: &str = ".camgen.json";
/// What the name of a further record begins and ends with, in a directory that users share.
const FURTHER: (&str, &str) = (".camgen-", ".json");
/// Largest record that is read, bytes: far above that of ten thousand cams.
pub(super) const LARGEST: u64 = 1 << 26;
/// Hexadecimal digits of SHA-256.
const SHA256_DIGITS: usize = 64;
/// Size of the read buffer, bytes.
const BUFFER: usize = 1 << 16;

/// The record of a directory.
#[derive(Debug, Default, Serialize, Deserialize)]
pub(super) struct DirectoryRecord {
    /// Digest of each file.
    pub(super) files: BTreeMap<String, String>,
    /// By stem and key, the value as it is compared and as it was typed.
    pub(super) inputs: BTreeMap<String, BTreeMap<String, (String, String)>>,
    /// Digest of the inputs that each file was made from.
    #[serde(default)]
    pub(super) made_from: BTreeMap<String, String>,
}

/// Whether a name is one of a record.
pub(super) fn is_record(name: &str) -> bool {
    let number = name.strip_prefix(FURTHER.0).and_then(|rest| rest.strip_suffix(FURTHER.1));
    name == RECORD || number.is_some_and(|number| !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit()))
}

/// The name of the user's record in a directory.
pub(super) fn record_name(directory: &Directory) -> io::Result<String> {
    if !directory.is_sticky()? {
        return Ok(RECORD.to_owned());
    }
    let mut names: Vec<String> = directory.names()?.into_iter().filter(|name| is_record(name)).collect();
    names.sort_by_key(|name| (name.len(), name.clone()));
    for name in &names {
        if matches!(directory.state_of(name)?, NameState::File(owned) if owned.is_own()) {
            return Ok(name.clone());
        }
    }
    let further = (1..=names.len()).map(|number| format!("{}{number}{}", FURTHER.0, FURTHER.1));
    let mut all = std::iter::once(RECORD.to_owned()).chain(further);
    // There is one name more than there are records.
    Ok(all.find(|name| !names.contains(name)).unwrap_or_else(|| RECORD.to_owned()))
}

impl DirectoryRecord {
    /// `None` where the file of that name is not a record; an empty record where there is no file.
    pub(super) fn read(directory: &Directory, name: &str) -> io::Result<Option<Self>> {
        match directory.state_of(name)? {
            NameState::Nothing => Ok(Some(Self::default())),
            NameState::File(_) => Ok(serde_json::from_slice(&directory.read(name, LARGEST)?).ok()),
            _ => Ok(None),
        }
    }

    /// Whether the file `there` is the one recorded under `name`; `None` if no file is recorded under it.
    pub(super) fn knows(&self, directory: &Directory, name: &str, there: &str) -> io::Result<Option<bool>> {
        let Some(recorded) = self.files.get(name) else { return Ok(None) };
        // Earlier versions recorded the SHA-256.
        let digest = if recorded.len() == SHA256_DIGITS { sha256_of } else { digest_of };
        digest(directory.file(there)?).map(|found| Some(found == *recorded))
    }
}

/// Digest of a file: SipHash-1-3 of 128 bits. It finds every edit except that of an attacker, who could change the record as well.
pub(super) fn file_digest(bytes: &[u8]) -> String {
    format!("{:032x}", SipHasher13::new().hash(bytes).as_u128())
}

/// [`file_digest`] of a file of any size.
pub(super) fn digest_of(file: impl Read) -> io::Result<String> {
    let mut hash = SipHasher13::new();
    each_block(file, u64::MAX, |block| hash.write(block))?;
    Ok(format!("{:032x}", hash.finish128().as_u128()))
}

fn sha256_of(file: impl Read) -> io::Result<String> {
    let mut hash = Sha256::new();
    each_block(file, u64::MAX, |block| hash.update(block))?;
    Ok(hexadecimal(&hash.finalize()))
}

/// Passes the first `length` bytes of a file to `take`; returns their number.
pub(super) fn each_block(file: impl Read, length: u64, mut take: impl FnMut(&[u8])) -> io::Result<u64> {
    let (mut file, mut buffer, mut read) = (file.take(length), vec![0; BUFFER], 0);
    loop {
        match file.read(&mut buffer) {
            Ok(0) => return Ok(read),
            Ok(count) => {
                take(buffer.get(..count).unwrap_or_default());
                read += count as u64;
            }
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
}
