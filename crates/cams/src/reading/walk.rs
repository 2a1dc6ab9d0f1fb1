//! Everything that would be cut: the visible entities of model space, including those of inserted blocks.

use super::contents::{DxfContents, LayerState, folded};
use super::curve::EdgeRun;
use super::limits::WorkCount;
use super::placement::BlockPlacement;
use super::record::{EntityFault, EntityRecord, fault};
use super::shape::{self, EntityShape, ShapePiece};
use super::shown::shown;
use super::{EntitySource, Hidden, StrayEntity, few, not_finite};
use camgen_kernel::geometry::contour::{Edge, Segment};
use camgen_kernel::refusal::Refusal;
use nalgebra::{Vector2, Vector3};
use std::collections::{BTreeMap, BTreeSet};

/// Deepest nesting of blocks: no drawing needs more.
const DEEPEST: usize = 32;
/// Most things of one kind that are reported one by one.
const MOST_REPORTED: usize = 1_000;

/// What one entity cuts, placed in the drawing.
#[derive(Debug)]
pub(super) struct EntityCut {
    /// In a row, each starting where the one before ends.
    pub(super) edges: Vec<Edge>,
    /// Index of its source.
    pub(super) source: usize,
    /// Least and largest height.
    heights: (f64, f64),
}

/// The state while entities are visited, and the results.
pub(super) struct EntityWalk<'c> {
    contents: &'c DxfContents<'c>,
    /// Largest distance of arcs from curves, mm.
    within: f64,
    /// Name of the layer of the outline.
    outline: &'c str,
    /// Whether entities are cut that are not visible.
    hidden_ones: Hidden,
    pub(super) effort: WorkCount,
    /// The blocks that are being inserted, one within the other.
    open: Vec<Vec<u8>>,
    known_sources: BTreeMap<EntitySource, usize>,
    pub(super) cuts: Vec<EntityCut>,
    pub(super) sources: Vec<EntitySource>,
    pub(super) unreadable: Vec<StrayEntity>,
    pub(super) information: Vec<StrayEntity>,
    pub(super) remarks: Vec<String>,
    /// Layers with visible entities, and layers with hidden ones.
    pub(super) layers: BTreeSet<String>,
    pub(super) hidden: BTreeSet<String>,
    pub(super) curves: usize,
    thick: BTreeSet<String>,
}

/// Where entities are placed, and what they inherit from the block's insertion.
#[derive(Clone, Copy)]
struct InsertionContext<'c> {
    placement: BlockPlacement,
    /// The layer of entities on layer 0 of the block; `None` outside of blocks.
    layer: Option<&'c [u8]>,
}

impl<'c> EntityWalk<'c> {
    /// Everything that would be cut from a file, in millimetres, curves as arcs within a distance (mm), with the layer of the outline.
    ///
    /// # Errors
    /// [`Refusal`] where a number of an entity is not a number.
    pub(super) fn over(
        contents: &'c DxfContents<'c>,
        outline: &'c str,
        within: f64,
        hidden_ones: Hidden,
    ) -> Result<Self, Refusal> {
        let mut walk = Self {
            contents,
            within,
            outline,
            hidden_ones,
            effort: WorkCount::default(),
            open: Vec::new(),
            known_sources: BTreeMap::new(),
            cuts: Vec::new(),
            sources: Vec::new(),
            unreadable: Vec::new(),
            information: Vec::new(),
            remarks: Vec::new(),
            layers: BTreeSet::new(),
            hidden: BTreeSet::new(),
            curves: 0,
            thick: BTreeSet::new(),
        };
        let placement = BlockPlacement::of(Vector3::repeat(contents.scale), 0.0, Vector3::zeros());
        walk.entities(&contents.records, InsertionContext { placement, layer: None })?;
        if !walk.thick.is_empty() {
            let kinds: Vec<String> = walk.thick.iter().cloned().collect();
            walk.remarks.push(format!("with a thickness, cut as the curve at its base: {}", few(&kinds)));
        }
        Ok(walk)
    }

    fn entities(&mut self, records: &'c [EntityRecord<'c>], context: InsertionContext<'c>) -> Result<(), Refusal> {
        let mut index = 0;
        while let Some(record) = records.get(index) {
            index += 1;
            // The vertices of a polyline follow it.
            let first = index;
            if record.is("POLYLINE") {
                while records.get(index).is_some_and(|next| next.is("VERTEX")) {
                    index += 1;
                }
            }
            let vertices = records.get(first..index).unwrap_or_default();
            let ended = records.get(index).is_some_and(|next| next.is("SEQEND"));
            self.count(record, vertices)?;
            match self.entity(record, (vertices, ended), context) {
                Ok(()) => {}
                Err(EntityFault::File(error)) => return Err(error),
                Err(EntityFault::Entity(why)) => {
                    let kind = record.kind();
                    self.report(record, context, (&kind, &why));
                }
            }
        }
        Ok(())
    }

    /// Counts an entity, or the insertion of a block, with the vertices that follow it.
    fn count(&mut self, record: &EntityRecord<'c>, vertices: &[EntityRecord<'c>]) -> Result<(), Refusal> {
        let groups = vertices.iter().map(|vertex| 1 + vertex.groups.len()).sum::<usize>();
        self.effort.entity(record.groups.len() + groups)
    }

    fn layer_of(record: &EntityRecord<'c>, context: InsertionContext<'c>) -> &'c [u8] {
        match (record.layer(), context.layer) {
            (b"0", Some(inherited)) => inherited,
            (own, _) => own,
        }
    }

    /// Reports something visible that cannot be read as a cut.
    fn report(&mut self, record: &EntityRecord<'c>, context: InsertionContext<'c>, (kind, why): (&str, &str)) {
        if self.unreadable.len() < MOST_REPORTED {
            self.unreadable.push(StrayEntity {
                kind: kind.to_owned(),
                why: why.to_owned(),
                layer: shown(Self::layer_of(record, context)),
                place: context.placement.point(record.approximate_place()),
            });
        }
    }

    fn state(&self, layer: &[u8]) -> LayerState {
        self.contents.layers.get(&folded(layer)).copied().unwrap_or_default()
    }

    fn entity(
        &mut self,
        record: &EntityRecord<'c>,
        (vertices, ended): (&'c [EntityRecord<'c>], bool),
        context: InsertionContext<'c>,
    ) -> Result<(), EntityFault> {
        // Entities in paper space are not cut.
        if record.is("SEQEND") || context.layer.is_none() && record.in_paper_space()? {
            return Ok(());
        }
        let layer = Self::layer_of(record, context);
        let (state, inserts) = (self.state(layer), record.is("INSERT"));
        // On a layer that is off, entities of a block on layers of their own are still visible.
        if !record.visible()? || state.frozen || state.off && !inserts {
            self.hidden.insert(shown(layer));
            if self.hidden_ones == Hidden::Skipped {
                return Ok(());
            }
        }
        if inserts {
            return self.insert(record, layer, context);
        }
        self.layers.insert(shown(layer));
        if shape::is_information(record) {
            if layer.eq_ignore_ascii_case(self.outline.as_bytes()) && self.information.len() < MOST_REPORTED {
                let place = context.placement.point(record.approximate_place());
                self.information.push(StrayEntity {
                    kind: record.kind(),
                    why: String::new(),
                    layer: shown(layer),
                    place,
                });
            }
            return Ok(());
        }
        if record.is("POLYLINE") && !ended {
            return fault("does not end with SEQEND");
        }
        // A side has a point of its own, and is not made where there are too many.
        self.effort.check_room(record.all(10).count().max(record.all(11).count()).max(vertices.len()))?;
        let Some(shape) = shape::shape(record, vertices)? else {
            return fault("is of a kind of which camgen does not know whether it is cut");
        };
        if shape.width > 0.0 {
            self.report(
                record,
                context,
                (&record.kind(), &format!("is drawn {} mm wide", self.contents.scale * shape.width)),
            );
        }
        if record.real(39, 0.0)? != 0.0 {
            self.thick.insert(format!("{} on layer {}", record.kind(), shown(layer)));
        }
        let source = self.source(EntitySource { kind: record.kind(), layer: shown(layer) });
        self.cut(&shape, source, context.placement)
    }

    fn source(&mut self, source: EntitySource) -> usize {
        if let Some(index) = self.known_sources.get(&source) {
            return *index;
        }
        self.sources.push(source.clone());
        self.known_sources.insert(source, self.sources.len() - 1);
        self.sources.len() - 1
    }

    /// Places what an entity cuts in the drawing.
    fn cut(&mut self, shape: &EntityShape, source: usize, placement: BlockPlacement) -> Result<(), EntityFault> {
        self.effort.check_room(shape.pieces.len())?;
        let placement = if shape.from_behind { placement.after(&BlockPlacement::from_behind()) } else { placement };
        let (keeps_circles, mirrors) = (placement.keeps_circles(), placement.mirrors());
        let mut strand = EdgeRun::default();
        let mapped =
            |curve: &super::curve::Bezier| curve.mapped(placement.point(Vector2::zeros()), |v| placement.direction(v));
        let mut curves = Vec::new();
        for piece in &shape.pieces {
            match piece {
                ShapePiece::Segment(segment) if segment.bulge == 0.0 || keeps_circles => {
                    let bulge = if mirrors { -segment.bulge } else { segment.bulge };
                    let (start, end) = (placement.point(segment.start), placement.point(segment.end));
                    strand.edges.push(Edge::Segment(Segment { start, end, bulge }));
                }
                ShapePiece::Segment(segment) => {
                    curves.push(segment);
                    let arcs: Vec<_> = shape::as_curves(segment).iter().map(mapped).collect();
                    strand.follow(&arcs, self.within, &mut self.effort)?;
                }
                ShapePiece::Curve(curve) => strand.follow(&[mapped(curve)], self.within, &mut self.effort)?,
            }
        }
        let inexact = |piece: &ShapePiece| matches!(piece, ShapePiece::Curve(curve) if curve.exact().is_none());
        if !curves.is_empty() || shape.pieces.iter().any(inexact) {
            self.curves += 1;
        }
        if !strand.edges.iter().all(Edge::is_finite) {
            return Err(EntityFault::File(not_finite()));
        }
        self.effort.segments(strand.edges.len())?;
        let heights = shape.heights.iter().map(|height| placement.height(*height));
        let heights = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), z| (low.min(z), high.max(z)));
        self.cuts.push(EntityCut { edges: strand.edges, source, heights });
        Ok(())
    }

    /// An INSERT: its block, once for each row and column.
    fn insert(
        &mut self,
        record: &EntityRecord<'c>,
        layer: &'c [u8],
        context: InsertionContext<'c>,
    ) -> Result<(), EntityFault> {
        let Some(name) = record.one(2)?.map(|name| folded(name.text())) else { return fault("names no block") };
        let shown_name = shown(&name);
        let contents = self.contents;
        let Some(block) = contents.blocks.get(&name) else {
            return fault(format!("inserts the block {shown_name}, which the file does not contain"));
        };
        if block.external {
            return fault(format!("inserts {shown_name}, which is in another file"));
        }
        if block.ambiguous {
            return fault(format!("inserts the block {shown_name}, which the file contains twice"));
        }
        if self.open.len() >= DEEPEST || self.open.contains(&name) {
            return fault(format!("inserts the block {shown_name}, which contains itself or is nested too deep"));
        }
        let base = if block.head.all(10).next().is_some() { block.head.point(10)? } else { Vector3::zeros() };
        let scale = Vector3::new(record.real(41, 1.0)?, record.real(42, 1.0)?, record.real(43, 1.0)?);
        let (at, angle) = (record.point(10)?, record.real(50, 0.0)?.to_radians());
        let turned = BlockPlacement::of(Vector3::repeat(1.0), angle, Vector3::zeros());
        let (columns, rows) = (record.whole(70, 1)?.max(1), record.whole(71, 1)?.max(1));
        let (wide, high) = (record.real(44, 0.0)?, record.real(45, 0.0)?);
        let outer = if record.is_seen_from_behind()? {
            context.placement.after(&BlockPlacement::from_behind())
        } else {
            context.placement
        };
        self.open.push(name);
        let mut placed = || -> Result<(), EntityFault> {
            for row in 0..rows {
                for column in 0..columns {
                    self.count(record, &[])?;
                    #[expect(clippy::cast_precision_loss, reason = "below the limit of entities")]
                    let offset = turned.direction(Vector2::new(column as f64 * wide, row as f64 * high));
                    let there = BlockPlacement::of(scale, angle, at + Vector3::new(offset.x, offset.y, 0.0));
                    let placement = outer.after(&there).after(&BlockPlacement::moved(-base));
                    if !placement.is_finite() {
                        return Err(EntityFault::File(not_finite()));
                    }
                    if placement.is_degenerate() {
                        return fault("is scaled by 0");
                    }
                    self.entities(&block.records, InsertionContext { placement, layer: Some(layer) })?;
                }
            }
            Ok(())
        };
        let result = placed();
        self.open.pop();
        result
    }

    /// Parts that are not at the height of the rest, reported, and the height of the rest.
    pub(super) fn heights(&mut self, reach: f64) -> f64 {
        let on_outline =
            |cut: &&EntityCut| self.sources.get(cut.source).is_some_and(|source| source.on_layer(self.outline));
        let first = self.cuts.iter().find(on_outline).or(self.cuts.first());
        let common = first.map_or(0.0, |cut| cut.heights.0);
        let off = |z: f64| (z - common).abs() > reach;
        let mut strays = Vec::new();
        for cut in self.cuts.iter().filter(|cut| off(cut.heights.0) || off(cut.heights.1)) {
            let EntitySource { kind, layer } = self.sources.get(cut.source).cloned().unwrap_or_default();
            let (low, high) = (cut.heights.0 - common, cut.heights.1 - common);
            let why = if high - low > reach {
                format!("runs from {low} to {high} mm above the rest")
            } else {
                format!("lies {low} mm above the rest")
            };
            let place = cut.edges.first().map_or_else(Vector2::zeros, Edge::middle);
            strays.push(StrayEntity { kind, why, layer, place });
            if strays.len() >= MOST_REPORTED {
                break;
            }
        }
        self.unreadable.extend(strays);
        common
    }
}
