//! The files of a body whose flanks a roller sweeps in space, as read from their bytes.

use super::patches::{ExactFlank, FlankDeviation, of_patches};
use crate::body::{Body, Layer, SweptFlanks};
use crate::reading::step::{FlankShape, SolidForm, StepFile, form, read};
use crate::reading::{Chain, FileUnit, INCHES, Reading, read_with_outline};
use camgen_kernel::geometry::nurbs::NurbsSurface;
use camgen_kernel::profile::Worst;
use camgen_kernel::refusal::Refusal;
use camgen_kernel::units::LengthUnit;
use nalgebra::Vector3;

/// Share of the tolerance by which rims may leave the floor and the outside, at least the uncertainty that STEP files state, mm.
const REACH_SHARE: f64 = 0.1;
const UNCERTAINTY: f64 = 1e-6;

/// The files of such a body as read; `None` where there is none.
#[derive(Debug, Clone, Default)]
pub struct WrittenSwept {
    pub(super) solid: Option<SweptSolid>,
    pub(super) developed: Option<Developed>,
}

/// A solid as read, and what rolling past its patches shows.
#[derive(Debug, Clone)]
pub(super) struct SweptSolid {
    pub(super) file: StepFile,
    pub(super) form: SolidForm,
    /// Of the flanks whose metal lies above and below the roller.
    pub(super) rolled: [FlankDeviation; 2],
}

/// The curves of a developed view as read.
#[derive(Debug, Clone)]
pub(super) struct Developed {
    pub(super) curves: Vec<(Layer, Vec<Chain>)>,
    /// What else is wrong with the file, a sentence each.
    pub(super) faults: Vec<String>,
}

impl WrittenSwept {
    /// What is read of both of its files.
    #[must_use]
    pub fn with(self, other: Self) -> Self {
        Self { solid: self.solid.or(other.solid), developed: self.developed.or(other.developed) }
    }

    /// What is read of a DXF file.
    ///
    /// # Errors
    /// [`Refusal`] when the bytes are not a DXF file.
    pub fn of_unrolled(body: &dyn Body, bytes: &[u8], join: f64) -> Result<Self, Refusal> {
        let mut curves = Vec::new();
        let mut faults = Vec::new();
        for (layer, _) in body.swept().map(SweptFlanks::developed).unwrap_or_default() {
            let reading = read_with_outline(bytes, join, Some(layer.name()))?;
            if curves.is_empty() {
                faults = faults_of(body, &reading);
                faults.extend(fault_of_blank(body, &reading));
            }
            curves.push((layer, reading.chains));
        }
        Ok(Self { developed: Some(Developed { curves, faults }), solid: None })
    }

    /// What is read of a STEP file.
    ///
    /// # Errors
    /// [`Refusal`] when the bytes are not a STEP file.
    pub fn of_solid(body: &dyn Body, bytes: &[u8], tolerance_mm: f64) -> Result<Self, Refusal> {
        let file = read(bytes)?;
        let reach = (REACH_SHARE * tolerance_mm).max(UNCERTAINTY);
        let form = form(&file.boundary, FlankShape::Swept, reach);
        let Some(exact) = body.swept() else { return Ok(Self::default()) };
        let is_upper = |patch: &NurbsSurface| exact.miss(middle(patch)).outward.z < 0.0;
        let (upper, lower): (Vec<_>, Vec<_>) = form.patches.iter().cloned().partition(|(patch, _)| is_upper(patch));
        let rolled = [upper, lower].map(|patches| {
            let found = of_patches(&patches, &Rolled(exact), tolerance_mm);
            if patches.is_empty() { FlankDeviation { bound: f64::INFINITY, ..found } } else { found }
        });
        Ok(Self { solid: Some(SweptSolid { file, form, rolled }), developed: None })
    }
}

/// What is wrong with a DXF file beside its curves.
fn faults_of(body: &dyn Body, reading: &Reading) -> Vec<String> {
    let mut faults = Vec::new();
    match reading.unit {
        FileUnit::Other(INCHES) if body.machine().units() == LengthUnit::Inch => {}
        FileUnit::Other(name) => faults.push(format!("the file is in {name}, not in millimetres")),
        FileUnit::Millimetres | FileUnit::Unstated | FileUnit::UnstatedEnglish => {}
    }
    faults.extend(reading.unreadable.iter().take(3).map(ToString::to_string));
    let twice = reading.duplicates.len() + reading.points.len();
    if twice > 0 {
        faults.push(format!("{twice} segments lie on another one or have no length"));
    }
    let known = [Layer::FlankUpper, Layer::FlankLower, Layer::Pitch, Layer::Blank];
    let strange = reading.others.iter().filter(|chain| !known.iter().any(|layer| chain.on_layer(layer.name())));
    faults.extend(strange.take(3).map(|chain| format!("{} would be cut and is no part of the view", chain.names())));
    faults
}

/// Ends of the developed blank are this near to their places, mm.
const BLANK: f64 = 1e-3;

/// What is wrong with the edge of the developed blank, which is one rectangle.
fn fault_of_blank(body: &dyn Body, reading: &Reading) -> Option<String> {
    let exact = body.swept()?;
    let (low, high) = exact.form().ends;
    let ends: Vec<f64> = exact
        .developed()
        .iter()
        .filter(|(layer, _)| *layer == Layer::Pitch)
        .flat_map(|(_, ends)| ends.map(|end| end.x))
        .collect();
    let around = std::f64::consts::TAU * exact.form().rim;
    let on_blank: Vec<&Chain> = reading.others.iter().filter(|chain| chain.on_layer(Layer::Blank.name())).collect();
    let wrong = |why: &str| Some(format!("the edge of the blank on layer {} {why}", Layer::Blank.name()));
    let [chain] = on_blank.as_slice() else { return wrong("is not one rectangle") };
    let lines = chain.edges.iter().all(|edge| edge.segment().is_some_and(|segment| segment.bulge == 0.0));
    if !chain.closed || !lines || chain.edges.len() != 4 {
        return wrong("is not one rectangle");
    }
    let extents = chain.contour().extents();
    let size = extents.size();
    let left = ends.iter().copied().fold(f64::INFINITY, f64::min);
    let offset_of_pitch = (left - extents.least.x).abs();
    let off = (size.x - around).abs().max((extents.least.y - low).abs()).max((extents.largest.y - high).abs());
    if off <= BLANK && offset_of_pitch <= 0.5 * around { None } else { wrong("is elsewhere or of another size") }
}

/// A point in the middle of a patch.
fn middle(patch: &NurbsSurface) -> Vector3<f64> {
    let of = |range: (f64, f64)| 0.5 * (range.0 + range.1);
    patch.point_and_slopes(of(patch.u.range()), of(patch.v.range()))[0]
}

/// The exact flanks by the roller rolled past a point.
struct Rolled<'a>(&'a dyn SweptFlanks);

impl ExactFlank for Rolled<'_> {
    fn deviation(&self, point: Vector3<f64>, normal: Vector3<f64>) -> (Worst, f64) {
        let miss = self.0.miss(point);
        (Worst { value: miss.value, at: miss.at, z: 0.0 }, miss.outward.dot(&normal))
    }
}
