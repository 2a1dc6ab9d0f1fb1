//! The rows of a lift table that a machine file names, as they are, without a curve through them.

use camgen_kernel::document::Reader;
use camgen_kernel::follower::{self, FollowerData};
use camgen_kernel::motion::program::rows::TableRows;
use camgen_kernel::motion::program::{FollowerMovement, read as program};

/// The rows for the follower of the file.
pub(crate) fn read(reader: &Reader<'_>) -> Option<TableRows> {
    let follower = follower::read(reader);
    let moves = follower.as_ref().map(|FollowerData { path, shape, arm, .. }| FollowerMovement {
        table: path,
        quantity: shape.quantity(),
        arm: *arm,
    });
    program::table_rows(reader, moves)
}
