//! All that would be cut: the entities of model space that are seen, those of inserted blocks among them.

use super::contents::{Contents, LayerState, folded, shown};
use super::curve::Strand;
use super::limits::Effort;
use super::placement::Placement;
use super::record::{Fault, Record, fault};
use super::shape::{self, Piece, Shape};
use super::{OUTLINE_LAYER, ReadError, Source, Stray, few};
use crate::geometry::contour::{Edge, Segment};
use nalgebra::{Vector2, Vector3};
use std::collections::{BTreeMap, BTreeSet};

/// Blocks within blocks: no drawing needs more.
const DEEPEST: usize = 32;
/// Things of one sort that are told each for itself.
const MOST_TOLD: usize = 1_000;

/// What one entity cuts, where it lies in the drawing.
#[derive(Debug)]
pub(super) struct Cut {
    /// In a row, each from where the one before ends.
    pub(super) edges: Vec<Edge>,
    /// Index of its source.
    pub(super) source: usize,
    /// Least and largest height.
    heights: (f64, f64),
}

/// What is found on the way.
pub(super) struct Walk<'c> {
    contents: &'c Contents<'c>,
    /// How near arcs keep to curves, mm.
    within: f64,
    pub(super) effort: Effort,
    /// The blocks that are being inserted, one within the other.
    open: Vec<Vec<u8>>,
    known_sources: BTreeMap<Source, usize>,
    pub(super) cuts: Vec<Cut>,
    pub(super) sources: Vec<Source>,
    pub(super) unreadable: Vec<Stray>,
    pub(super) information: Vec<Stray>,
    pub(super) remarks: Vec<String>,
    /// Layers on which something is seen, and those on which something is not.
    pub(super) layers: BTreeSet<String>,
    pub(super) hidden: BTreeSet<String>,
    pub(super) curves: usize,
    thick: BTreeSet<String>,
}

/// Where entities come to lie, and what they inherit from the block's insertion.
#[derive(Clone, Copy)]
struct Context<'c> {
    placement: Placement,
    /// The layer of what is on layer 0 in the block; `None` outside of blocks.
    layer: Option<&'c [u8]>,
}

impl<'c> Walk<'c> {
    /// All that would be cut of a file, curves as arcs within a distance (mm).
    ///
    /// # Errors
    /// [`ReadError`] where a number of an entity is none.
    pub(super) fn over(contents: &'c Contents<'c>, within: f64) -> Result<Self, ReadError> {
        let mut walk = Self {
            contents,
            within,
            effort: Effort::default(),
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
        walk.entities(&contents.records, Context { placement: Placement::unchanged(), layer: None })?;
        if !walk.thick.is_empty() {
            let kinds: Vec<String> = walk.thick.iter().cloned().collect();
            walk.remarks.push(format!("a thickness is cut as the line it stands on: {}", few(&kinds)));
        }
        Ok(walk)
    }

    fn entities(&mut self, records: &'c [Record<'c>], context: Context<'c>) -> Result<(), ReadError> {
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
                Err(Fault::File(error)) => return Err(error),
                Err(Fault::Entity(why)) => {
                    let kind = record.kind();
                    self.tell(record, context, (&kind, &why));
                }
            }
        }
        Ok(())
    }

    /// Counts an entity, or the insertion of a block, with the vertices that follow it.
    fn count(&mut self, record: &Record<'c>, vertices: &[Record<'c>]) -> Result<(), ReadError> {
        let groups = vertices.iter().map(|vertex| 1 + vertex.groups.len()).sum::<usize>();
        self.effort.entity(record.groups.len() + groups)
    }

    fn layer_of(record: &Record<'c>, context: Context<'c>) -> &'c [u8] {
        match (record.layer(), context.layer) {
            (b"0", Some(inherited)) => inherited,
            (own, _) => own,
        }
    }

    /// Something that is seen and cannot be read as a cut.
    fn tell(&mut self, record: &Record<'c>, context: Context<'c>, (kind, why): (&str, &str)) {
        if self.unreadable.len() < MOST_TOLD {
            self.unreadable.push(Stray {
                kind: kind.to_owned(),
                why: why.to_owned(),
                layer: shown(Self::layer_of(record, context)),
                place: context.placement.point(record.somewhere()),
            });
        }
    }

    fn state(&self, layer: &[u8]) -> LayerState {
        self.contents.layers.get(&folded(layer)).copied().unwrap_or_default()
    }

    fn entity(
        &mut self,
        record: &Record<'c>,
        (vertices, ended): (&'c [Record<'c>], bool),
        context: Context<'c>,
    ) -> Result<(), Fault> {
        // What lies in paper space is not cut.
        if record.is("SEQEND") || context.layer.is_none() && record.in_paper_space()? {
            return Ok(());
        }
        let layer = Self::layer_of(record, context);
        let (state, inserts) = (self.state(layer), record.is("INSERT"));
        // On a layer that is off what a block holds on layers of its own is still seen.
        if !record.visible()? || state.frozen || state.off && !inserts {
            self.hidden.insert(shown(layer));
            return Ok(());
        }
        if inserts {
            return self.insert(record, layer, context);
        }
        self.layers.insert(shown(layer));
        if shape::is_information(record) {
            if layer.eq_ignore_ascii_case(OUTLINE_LAYER.as_bytes()) && self.information.len() < MOST_TOLD {
                let place = context.placement.point(record.somewhere());
                self.information.push(Stray { kind: record.kind(), why: String::new(), layer: shown(layer), place });
            }
            return Ok(());
        }
        if record.is("POLYLINE") && !ended {
            return fault("does not end with SEQEND");
        }
        // A side has a point of its own, and is not made where there are too many.
        self.effort.has_room(record.all(10).count().max(record.all(11).count()).max(vertices.len()))?;
        let Some(shape) = shape::shape(record, vertices)? else {
            return fault("is nothing that is known to be cut, and nothing that is known not to be");
        };
        if shape.width > 0.0 {
            self.tell(record, context, (&record.kind(), &format!("is drawn {} mm wide", shape.width)));
        }
        if record.real(39, 0.0)? != 0.0 {
            self.thick.insert(format!("{} on layer {}", record.kind(), shown(layer)));
        }
        let source = self.source(Source { kind: record.kind(), layer: shown(layer) });
        self.cut(&shape, source, context.placement)
    }

    fn source(&mut self, source: Source) -> usize {
        if let Some(index) = self.known_sources.get(&source) {
            return *index;
        }
        self.sources.push(source.clone());
        self.known_sources.insert(source, self.sources.len() - 1);
        self.sources.len() - 1
    }

    /// Puts what an entity cuts in its place in the drawing.
    fn cut(&mut self, shape: &Shape, source: usize, placement: Placement) -> Result<(), Fault> {
        self.effort.has_room(shape.pieces.len())?;
        let placement = if shape.from_behind { placement.after(&Placement::from_behind()) } else { placement };
        let (keeps_circles, mirrors) = (placement.keeps_circles(), placement.mirrors());
        let mut strand = Strand::default();
        let mapped =
            |curve: &super::curve::Bezier| curve.mapped(placement.point(Vector2::zeros()), |v| placement.direction(v));
        let mut curves = Vec::new();
        for piece in &shape.pieces {
            match piece {
                Piece::Segment(segment) if segment.bulge == 0.0 || keeps_circles => {
                    let bulge = if mirrors { -segment.bulge } else { segment.bulge };
                    let (start, end) = (placement.point(segment.start), placement.point(segment.end));
                    strand.edges.push(Edge::Segment(Segment { start, end, bulge }));
                }
                Piece::Segment(segment) => {
                    curves.push(segment);
                    let arcs: Vec<_> = shape::as_curves(segment).iter().map(mapped).collect();
                    strand.follow(&arcs, self.within, &mut self.effort)?;
                }
                Piece::Curve(curve) => strand.follow(&[mapped(curve)], self.within, &mut self.effort)?,
            }
        }
        let inexact = |piece: &Piece| matches!(piece, Piece::Curve(curve) if curve.exact().is_none());
        if !curves.is_empty() || shape.pieces.iter().any(inexact) {
            self.curves += 1;
        }
        if !strand.edges.iter().all(Edge::is_finite) {
            return Err(Fault::File(ReadError::NotFinite));
        }
        self.effort.segments(strand.edges.len())?;
        let heights = shape.heights.iter().map(|height| placement.height(*height));
        let heights = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), z| (low.min(z), high.max(z)));
        self.cuts.push(Cut { edges: strand.edges, source, heights });
        Ok(())
    }

    /// An INSERT: its block, once for each row and column.
    fn insert(&mut self, record: &Record<'c>, layer: &'c [u8], context: Context<'c>) -> Result<(), Fault> {
        let Some(name) = record.one(2)?.map(|name| folded(name.text())) else { return fault("names no block") };
        let shown_name = shown(&name);
        let contents = self.contents;
        let Some(block) = contents.blocks.get(&name) else {
            return fault(format!("inserts the block {shown_name}, which the file does not have"));
        };
        if block.external {
            return fault(format!("inserts {shown_name}, which stands in another file"));
        }
        if block.ambiguous {
            return fault(format!("inserts the block {shown_name}, of which the file has two"));
        }
        if self.open.len() >= DEEPEST || self.open.contains(&name) {
            return fault(format!("inserts the block {shown_name}, which holds itself or is nested too deep"));
        }
        let base = if block.head.all(10).next().is_some() { block.head.point(10)? } else { Vector3::zeros() };
        let scale = Vector3::new(record.real(41, 1.0)?, record.real(42, 1.0)?, record.real(43, 1.0)?);
        let (at, angle) = (record.point(10)?, record.real(50, 0.0)?.to_radians());
        let turned = Placement::of(Vector3::repeat(1.0), angle, Vector3::zeros());
        let (columns, rows) = (record.whole(70, 1)?.max(1), record.whole(71, 1)?.max(1));
        let (wide, high) = (record.real(44, 0.0)?, record.real(45, 0.0)?);
        let outer = if record.is_seen_from_behind()? {
            context.placement.after(&Placement::from_behind())
        } else {
            context.placement
        };
        self.open.push(name);
        let mut placed = || -> Result<(), Fault> {
            for row in 0..rows {
                for column in 0..columns {
                    self.count(record, &[])?;
                    #[expect(clippy::cast_precision_loss, reason = "below the limit of entities")]
                    let offset = turned.direction(Vector2::new(column as f64 * wide, row as f64 * high));
                    let there = Placement::of(scale, angle, at + Vector3::new(offset.x, offset.y, 0.0));
                    let placement = outer.after(&there).after(&Placement::moved(-base));
                    if !placement.is_finite() {
                        return Err(Fault::File(ReadError::NotFinite));
                    }
                    if placement.flattens() {
                        return fault("is scaled to nothing");
                    }
                    self.entities(&block.records, Context { placement, layer: Some(layer) })?;
                }
            }
            Ok(())
        };
        let result = placed();
        self.open.pop();
        result
    }

    /// What does not lie at the height of the rest, told, and the height of the rest.
    pub(super) fn heights(&mut self, reach: f64) -> f64 {
        let on_outline = |cut: &&Cut| self.sources.get(cut.source).is_some_and(Source::on_outline);
        let first = self.cuts.iter().find(on_outline).or(self.cuts.first());
        let common = first.map_or(0.0, |cut| cut.heights.0);
        let off = |z: f64| (z - common).abs() > reach;
        let mut told = Vec::new();
        for cut in self.cuts.iter().filter(|cut| off(cut.heights.0) || off(cut.heights.1)) {
            let Source { kind, layer } = self.sources.get(cut.source).cloned().unwrap_or_default();
            let (low, high) = (cut.heights.0 - common, cut.heights.1 - common);
            let why = if high - low > reach {
                format!("runs from {low} to {high} mm above the rest")
            } else {
                format!("lies {low} mm above the rest")
            };
            let place = cut.edges.first().map_or_else(Vector2::zeros, Edge::middle);
            told.push(Stray { kind, why, layer, place });
            if told.len() >= MOST_TOLD {
                break;
            }
        }
        self.unreadable.extend(told);
        common
    }
}
