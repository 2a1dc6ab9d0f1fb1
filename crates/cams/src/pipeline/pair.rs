//! What two discs of a pair do together: how they close on their rollers, and their solids in one file.

use super::{AssemblyReport, Error, Proven};
use crate::body::Body;
use crate::body::closure::{Closure, Pairing};
use crate::body::conjugate::{self, MAIN_NAME};
use crate::check::Measure;
use crate::report::Section;
use crate::verify::WrittenOutline;
use crate::write::step_assembly::{self, PlacedSolid};
use camgen_kernel::geometry::MILLIMETRES;

/// The name of the file of both solids after the stem.
const PAIR: &str = "-pair.step";

/// The report on a pair.
#[derive(Debug)]
pub(super) struct PairReport;

fn closure(first: (&dyn Body, &[WrittenOutline]), others: &[(String, Proven)]) -> Option<Closure> {
    let (_, counter) = others.first()?;
    let second = (counter.body(), &counter.outlines().first()?.contour);
    Closure::of((first.0, &first.1.first()?.contour), second, (Pairing::Opposite, counter.tolerance_mm()))
}

impl AssemblyReport for PairReport {
    fn measures(&self, first: (&dyn Body, &[WrittenOutline]), others: &[(String, Proven)]) -> Vec<Measure> {
        vec![Closure::measure(closure(first, others).as_ref(), first.0)]
    }

    fn sections(&self, first: &Proven, others: &[(String, Proven)]) -> Vec<Section> {
        let counter = others.first().map(|(_, counter)| (counter.body(), counter.findings()));
        let found = closure((first.body(), first.outlines()), others).zip(counter);
        found.map(|(found, counter)| conjugate::section(&found, first.body(), counter)).into_iter().collect()
    }

    fn file_names(&self, first: &Proven, formats: &[&str]) -> Vec<&'static str> {
        let solid = first.body().machine().cam.thickness.is_some() && formats.contains(&"step");
        solid.then_some(PAIR).into_iter().collect()
    }

    /// The discs next to each other on the shaft, each a product of its name.
    fn files(
        &self,
        first: &Proven,
        others: &[(String, Proven)],
        (title, mark, created): (&str, &str, Option<u64>),
    ) -> Result<Vec<Vec<u8>>, Error> {
        let thickness = MILLIMETRES * first.body().machine().cam.thickness.unwrap_or(0.0);
        let mut placed = Vec::new();
        let mut z = 0.0;
        for (name, cam) in std::iter::once((MAIN_NAME, first)).chain(others.iter().map(|(name, cam)| (&**name, cam))) {
            let part = cam.drawn().and_then(|drawn| drawn.parts.first());
            if let Some(part) = part {
                let solid = part.solid(thickness).map_err(Error::Format)?;
                placed.push(PlacedSolid { name: format!("{title} {name}"), solid, z });
            }
            z += thickness;
        }
        Ok(vec![step_assembly::write(&placed, title, created, mark)])
    }
}
