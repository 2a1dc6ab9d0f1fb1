//! What several modules of tests share.

pub(crate) mod big;
pub(crate) mod lines;
pub(crate) mod program;
pub(crate) mod random;
pub(crate) mod source;
pub(crate) mod stored;
pub(crate) mod worst;
