//! What two discs of a pair do together: how they close on their rollers, and their solids in one file.

use super::{AssemblyReport, Error, Proven, Writing};
use crate::body::closure::{Closure, Pairing};
use crate::body::conjugate::{self, MAIN_NAME};
use crate::body::part_drawing::pair::{PairedDisc, of_pair};
use crate::body::{Body, Part};
use crate::check::Measure;
use crate::report::Section;
use crate::report::sheet::{SheetExtras, SheetKind, compose};
use crate::verify::WrittenOutline;
use crate::write::step_assembly::{self, PlacedSolid};
use crate::write::svg;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::refusal::Refusal;

/// The names of the file of both solids and of the drawing of both discs after the stem.
const SOLIDS: &str = "-pair.step";
const SHEET: &str = "-pair.svg";

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
        let has_thickness = first.body().machine().cam.thickness.is_some();
        let files = [("step", SOLIDS), ("svg", SHEET)];
        files
            .into_iter()
            .filter(|(format, _)| has_thickness && formats.contains(format))
            .map(|(_, name)| name)
            .collect()
    }

    fn files(
        &self,
        first: &Proven,
        others: &[(String, Proven)],
        (title, mark): (&str, &str),
        writing: &Writing,
    ) -> Result<Vec<Vec<u8>>, Error> {
        let (formats, _) = writing.chosen(first.body())?;
        let formats: Vec<&str> = formats.iter().map(|format| format.name).collect();
        let discs: Vec<(&str, &Proven)> =
            std::iter::once((MAIN_NAME, first)).chain(others.iter().map(|(name, cam)| (&**name, cam))).collect();
        let mut files = Vec::new();
        for name in self.file_names(first, &formats) {
            files.push(if name == SOLIDS {
                solids(&discs, (title, mark), writing.created)?
            } else {
                sheet(&discs, mark, writing)?
            });
        }
        Ok(files)
    }
}

/// The discs next to each other on the shaft, each a product of its name.
fn solids(discs: &[(&str, &Proven)], (title, mark): (&str, &str), created: Option<u64>) -> Result<Vec<u8>, Error> {
    let mut placed = Vec::new();
    let mut z = 0.0;
    for (name, cam) in discs {
        let thickness = MILLIMETRES * cam.body().machine().cam.thickness.unwrap_or(0.0);
        if let Some(part) = cam.drawn().and_then(|drawn| drawn.parts.first()) {
            let solid = part.solid(thickness).map_err(Error::Format)?;
            placed.push(PlacedSolid { name: format!("{title} {name}"), solid, z });
        }
        z += thickness;
    }
    Ok(step_assembly::write(&placed, title, created, mark))
}

/// The drawing of both discs together.
fn sheet(discs: &[(&str, &Proven)], mark: &str, writing: &Writing) -> Result<Vec<u8>, Error> {
    let drawn = |(name, cam): &(&str, &Proven)| {
        let part = cam.drawn()?.parts.first()?.clone();
        let mass = part.weight(cam.body().machine()).mass_kg;
        Some(((*name).to_owned(), part, mass))
    };
    let parts: Vec<(String, Part, Option<f64>)> = discs.iter().filter_map(drawn).collect();
    let (Some((_, first)), [main, counter]) = (discs.first(), &parts[..]) else {
        return Err(Error::Format(Refusal::new("a pair has two discs")));
    };
    let paired = [main, counter].map(|(name, part, mass)| PairedDisc {
        name,
        part,
        drawing: format!("{}-{name}.svg", writing.stem),
        mass: *mass,
    });
    let drawn = first.drawn().ok_or_else(|| Error::NoOutline("a disc has no outline".into()))?;
    let review = first.body().view(drawn).map_err(|error| Error::Format(Refusal::of(error)))?;
    let rollers = review.groups.into_iter().filter(|group| group.class == "roller").collect();
    let view = of_pair(first.body().machine(), &paired, rollers);
    let report = first.report();
    let extras = SheetExtras {
        kind: SheetKind::Pair,
        files: &[],
        file_deviates: "",
        number: "1/1",
        traces: &[],
        checks: &[],
        passed_otherwise: 0,
    };
    svg::fill(&compose(&view, &report, &extras), &writing.template, true, mark).map_err(Error::Format)
}
