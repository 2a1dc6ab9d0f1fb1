//! The parts of a DXF file: its unit, its layers, its blocks, and the entities of model space.

use super::ReadError;
use super::Unit;
use super::groups::{Group, Kept, Section, TYPE};
use super::limits::MOST_NAMES;
use super::record::Record;
use crate::document;
use std::collections::BTreeMap;

/// Group codes with a meaning here.
const NAME: i32 = 2;
const COLOUR: i32 = 62;
const VARIABLE: i32 = 9;
const FLAGS: i32 = 70;

/// Bits of the flags of a layer and of a block.
const FROZEN: i64 = 1;
const ANOTHER_FILE: i64 = 4 | 8 | 16;

/// The block that is model space itself.
const MODEL_SPACE: [&[u8]; 2] = [b"*model_space", b"$model_space"];

/// A name without regard to capitals.
pub(super) fn folded(name: &[u8]) -> Vec<u8> {
    name.to_ascii_lowercase()
}

/// Whether the entities of a layer are seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct LayerState {
    /// Its colour is negative: its own entities are not seen, but those of blocks inserted on it may be.
    pub(super) off: bool,
    /// Nothing on it is seen, blocks inserted on it neither.
    pub(super) frozen: bool,
}

/// A block.
#[derive(Debug, Default)]
pub(super) struct Block<'g> {
    /// Its `BLOCK` record, with the base point.
    pub(super) head: Record<'g>,
    pub(super) records: Vec<Record<'g>>,
    /// What it holds stands in another file.
    pub(super) external: bool,
    /// Another block has its name.
    pub(super) ambiguous: bool,
}

/// What a file holds.
#[derive(Debug)]
pub(super) struct Contents<'g> {
    pub(super) unit: Unit,
    /// By their folded names; a layer that is not here is on.
    pub(super) layers: BTreeMap<Vec<u8>, LayerState>,
    /// By their folded names.
    pub(super) blocks: BTreeMap<Vec<u8>, Block<'g>>,
    /// The entities, those of paper space among them.
    pub(super) records: Vec<Record<'g>>,
}

impl<'g> Contents<'g> {
    /// # Errors
    /// [`ReadError`] where a unit or a layer is told by no number.
    pub(super) fn of(kept: &'g Kept<'g>) -> Result<Self, ReadError> {
        let mut contents =
            Self { unit: Unit::Untold, layers: BTreeMap::new(), blocks: BTreeMap::new(), records: Vec::new() };
        for (section, groups) in &kept.sections {
            match section {
                Section::Header => contents.header(groups)?,
                Section::Tables => contents.tables(groups)?,
                Section::Blocks => contents.blocks(groups)?,
                Section::Entities => contents.records.extend(records(groups)),
            }
            for (count, what) in [(contents.layers.len(), "layers"), (contents.blocks.len(), "blocks")] {
                if count > MOST_NAMES {
                    return Err(ReadError::TooMuch { what, most: MOST_NAMES });
                }
            }
        }
        // Model space is a block, too, and some programs leave its entities there.
        for name in MODEL_SPACE {
            contents.records.extend(contents.blocks.remove(name).into_iter().flat_map(|block| block.records));
        }
        Ok(contents)
    }

    fn header(&mut self, groups: &[Group<'_>]) -> Result<(), ReadError> {
        let mut of_unit = false;
        for Group { code, value } in groups {
            if *code == VARIABLE {
                of_unit = value.text() == b"$INSUNITS";
            } else if of_unit && *code == FLAGS {
                let found = unit(value.whole()?);
                let same = self.unit == Unit::Untold || self.unit == found;
                self.unit = if same { found } else { Unit::Other("more than one unit") };
            }
        }
        Ok(())
    }

    fn tables(&mut self, groups: &'g [Group<'g>]) -> Result<(), ReadError> {
        for record in records(groups).filter(|record| record.is("LAYER")) {
            let (mut name, mut state) = (None, LayerState::default());
            for Group { code, value } in record.groups {
                match *code {
                    NAME => name = Some(folded(value.text())),
                    COLOUR => state.off = value.whole()? < 0,
                    FLAGS => state.frozen = value.whole()? & FROZEN != 0,
                    _ => {}
                }
            }
            let Some(name) = name else { continue };
            // Told twice, it is seen where one of them is.
            let known = self.layers.entry(name).or_insert(state);
            *known = LayerState { off: known.off && state.off, frozen: known.frozen && state.frozen };
        }
        Ok(())
    }

    fn blocks(&mut self, groups: &'g [Group<'g>]) -> Result<(), ReadError> {
        let mut open: Option<(Vec<u8>, Block<'g>)> = None;
        for record in records(groups) {
            if record.is("BLOCK") {
                self.add(open.take());
                let value = |code| record.groups.iter().find(|group| group.code == code).map(|group| group.value);
                let name = value(NAME).map(|name| folded(name.text())).unwrap_or_default();
                let flags = value(FLAGS).map_or(Ok(0), super::groups::Value::whole)?;
                open = Some((name, Block { head: record, external: flags & ANOTHER_FILE != 0, ..Block::default() }));
            } else if record.is("ENDBLK") {
                self.add(open.take());
            } else if let Some((_, block)) = &mut open {
                block.records.push(record);
            }
        }
        self.add(open);
        Ok(())
    }

    fn add(&mut self, block: Option<(Vec<u8>, Block<'g>)>) {
        let Some((name, block)) = block else { return };
        match self.blocks.get_mut(&name) {
            // The entities of both, should it be model space.
            Some(known) => {
                known.ambiguous = true;
                known.records.extend(block.records);
            }
            None => {
                self.blocks.insert(name, block);
            }
        }
    }
}

/// The unit of a number of `$INSUNITS`.
fn unit(number: i64) -> Unit {
    match number {
        0 => Unit::Untold,
        1 => Unit::Other("inches"),
        4 => Unit::Millimetres,
        5 => Unit::Other("centimetres"),
        6 => Unit::Other("metres"),
        _ => Unit::Other("another unit than millimetres"),
    }
}

/// The groups of a section, record by record; what stands before the first is of none.
fn records<'g>(groups: &'g [Group<'g>]) -> impl Iterator<Item = Record<'g>> {
    groups.chunk_by(|_, next| next.code != TYPE).filter_map(Record::of)
}

/// Characters of a name that a message tells.
const MOST_SHOWN: usize = 80;

/// The name of a layer or a block, as a message tells it.
pub(super) fn shown(name: &[u8]) -> String {
    document::shown(&String::from_utf8_lossy(name), MOST_SHOWN)
}
