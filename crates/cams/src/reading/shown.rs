//! Names of a file as messages show them.

use camgen_kernel::document;

/// Most characters of a name in a message.
const MOST_SHOWN: usize = 80;

/// The name of a layer or a block, as a message shows it.
pub(super) fn shown(name: &[u8]) -> String {
    document::shown(&String::from_utf8_lossy(name), MOST_SHOWN)
}
