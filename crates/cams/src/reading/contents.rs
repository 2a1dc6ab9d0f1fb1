//! The parts of a DXF file: its unit, its layers, its blocks, and the entities of model space.

use super::groups::{DxfGroup, DxfSection, DxfSections, TYPE};
use super::limits::MOST_NAMES;
use super::record::EntityRecord;
use super::too_much;
use super::{FileUnit, INCHES, MANY_UNITS, UNKNOWN_UNIT};
use camgen_kernel::refusal::Refusal;
use std::collections::BTreeMap;

/// Group codes that are used here.
const NAME: i32 = 2;
const COLOUR: i32 = 62;
const VARIABLE: i32 = 9;
const FLAGS: i32 = 70;

/// Bits of the flags of a layer and of a block.
const FROZEN: i64 = 1;
const ANOTHER_FILE: i64 = 4 | 8 | 16;

/// The block that is model space itself.
const MODEL_SPACE: [&[u8]; 2] = [b"*model_space", b"$model_space"];

/// A name without distinction of capitals.
pub(super) fn folded(name: &[u8]) -> Vec<u8> {
    name.to_ascii_lowercase()
}

/// Whether the entities of a layer are visible.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct LayerState {
    /// Its colour is negative: its own entities are hidden, but those of blocks inserted on it may be visible.
    pub(super) off: bool,
    /// Everything on it is hidden, including blocks inserted on it.
    pub(super) frozen: bool,
}

/// A block.
#[derive(Debug, Default)]
pub(super) struct DxfBlock<'g> {
    /// Its `BLOCK` record, with the base point.
    pub(super) head: EntityRecord<'g>,
    pub(super) records: Vec<EntityRecord<'g>>,
    /// Its content is in another file.
    pub(super) external: bool,
    /// Another block has this name.
    pub(super) ambiguous: bool,
}

/// The contents of a file.
#[derive(Debug)]
pub(super) struct DxfContents<'g> {
    pub(super) unit: FileUnit,
    /// Millimetres in this unit.
    pub(super) scale: f64,
    /// By their folded names; a layer that is not listed is on.
    pub(super) layers: BTreeMap<Vec<u8>, LayerState>,
    /// By their folded names.
    pub(super) blocks: BTreeMap<Vec<u8>, DxfBlock<'g>>,
    /// The entities, including those of paper space.
    pub(super) records: Vec<EntityRecord<'g>>,
}

impl<'g> DxfContents<'g> {
    /// # Errors
    /// [`Refusal`] where a unit or the state of a layer is not a number.
    pub(super) fn of(kept: &'g DxfSections<'g>) -> Result<Self, Refusal> {
        let (layers, blocks) = (BTreeMap::new(), BTreeMap::new());
        let mut contents = Self { unit: FileUnit::Unstated, scale: 1.0, layers, blocks, records: Vec::new() };
        for (section, groups) in &kept.sections {
            match section {
                DxfSection::Header => contents.header(groups)?,
                DxfSection::Tables => contents.tables(groups)?,
                DxfSection::Blocks => contents.blocks(groups)?,
                DxfSection::Entities => contents.records.extend(records(groups)),
            }
            for (count, what) in [(contents.layers.len(), "layers"), (contents.blocks.len(), "blocks")] {
                if count > MOST_NAMES {
                    return Err(too_much(what, MOST_NAMES));
                }
            }
        }
        // Model space is also a block, and some programs leave its entities there.
        for name in MODEL_SPACE {
            contents.records.extend(contents.blocks.remove(name).into_iter().flat_map(|block| block.records));
        }
        Ok(contents)
    }

    fn header(&mut self, groups: &[DxfGroup<'_>]) -> Result<(), Refusal> {
        let (mut of_unit, mut of_system, mut english) = (false, false, false);
        // Where an entity begins the header is over for other readers.
        for DxfGroup { code, value } in groups.iter().take_while(|group| group.code != TYPE) {
            if *code == VARIABLE {
                (of_unit, of_system) = (value.text() == b"$INSUNITS", value.text() == b"$MEASUREMENT");
            } else if of_system && *code == FLAGS {
                english = value.whole()? == 0;
            } else if of_unit && *code == FLAGS {
                let found = unit(value.whole()?);
                let same = self.unit == FileUnit::Unstated || self.unit == found.0;
                (self.unit, self.scale) = if same { found } else { (FileUnit::Other(MANY_UNITS), 1.0) };
            }
        }
        if english && self.unit == FileUnit::Unstated {
            self.unit = FileUnit::UnstatedEnglish;
        }
        Ok(())
    }

    fn tables(&mut self, groups: &'g [DxfGroup<'g>]) -> Result<(), Refusal> {
        for record in records(groups).filter(|record| record.is("LAYER")) {
            let (mut name, mut state) = (None, LayerState::default());
            for DxfGroup { code, value } in record.groups {
                match *code {
                    NAME => name = Some(folded(value.text())),
                    COLOUR => state.off = value.whole()? < 0,
                    FLAGS => state.frozen = value.whole()? & FROZEN != 0,
                    _ => {}
                }
            }
            let Some(name) = name else { continue };
            // A layer that occurs twice is visible where one of them is.
            let known = self.layers.entry(name).or_insert(state);
            *known = LayerState { off: known.off && state.off, frozen: known.frozen && state.frozen };
        }
        Ok(())
    }

    fn blocks(&mut self, groups: &'g [DxfGroup<'g>]) -> Result<(), Refusal> {
        let mut open: Option<(Vec<u8>, DxfBlock<'g>)> = None;
        for record in records(groups) {
            if record.is("BLOCK") {
                self.add(open.take());
                let value = |code| record.groups.iter().find(|group| group.code == code).map(|group| group.value);
                let name = value(NAME).map(|name| folded(name.text())).unwrap_or_default();
                let flags = value(FLAGS).map_or(Ok(0), super::groups::GroupValue::whole)?;
                open =
                    Some((name, DxfBlock { head: record, external: flags & ANOTHER_FILE != 0, ..DxfBlock::default() }));
            } else if record.is("ENDBLK") {
                self.add(open.take());
            } else if let Some((_, block)) = &mut open {
                block.records.push(record);
            }
        }
        self.add(open);
        Ok(())
    }

    fn add(&mut self, block: Option<(Vec<u8>, DxfBlock<'g>)>) {
        let Some((name, block)) = block else { return };
        match self.blocks.get_mut(&name) {
            // The entities of both, in case it is model space.
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

/// The unit of a number of `$INSUNITS`, and its millimetres; 1 where they are not known.
fn unit(number: i64) -> (FileUnit, f64) {
    let (name, scale) = match number {
        0 => return (FileUnit::Unstated, 1.0),
        4 => return (FileUnit::Millimetres, 1.0),
        1 => (INCHES, 25.4),
        2 => ("feet", 304.8),
        5 => ("centimetres", 10.0),
        6 => ("metres", 1e3),
        8 => ("microinches", 25.4e-6),
        9 => ("mils", 25.4e-3),
        10 => ("yards", 914.4),
        12 => ("nanometres", 1e-6),
        13 => ("micrometres", 1e-3),
        14 => ("decimetres", 100.0),
        _ => (UNKNOWN_UNIT, 1.0),
    };
    (FileUnit::Other(name), scale)
}

/// The groups of a section, record by record; groups before the first record are left out.
fn records<'g>(groups: &'g [DxfGroup<'g>]) -> impl Iterator<Item = EntityRecord<'g>> {
    groups.chunk_by(|_, next| next.code != TYPE).filter_map(EntityRecord::of)
}
