//! The proof of a file that was edited, or written by another program.

use super::{Cam, Error, diagnosis, report};
use crate::body::Request;
use crate::geometry::MILLIMETRES;
use crate::reading::step::{Flank, Loop};
use crate::reading::{self, Chain, step};
use crate::report::{Inputs, Report, Section};
use crate::verify::{self, Evidence, WrittenOutline, WrittenSolid, join_reach, rolling, shell_reach};
use serde::Serialize;

/// File names tell a speed with six digits: to half of the last of them it is the same speed.
const SAME_SPEED: f64 = 5e-6;

/// The section of a conoid that a file should hold.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
struct OfSection {
    rpm: f64,
    z_mm: f64,
    /// The same in metres.
    #[serde(skip)]
    z: f64,
}

impl Cam {
    /// Whether a DXF file, also one that was edited or written by another program, holds the outline of this cam within a
    /// tolerance (m, or with what the follower may feel, a [`Request`]), or a STEP file its solid. A conoid of several sections is
    /// cut from several DXF files: see [`Cam::check_section`].
    ///
    /// # Errors
    /// [`Error::Read`] when the bytes are not a DXF file, [`Error::Step`] when they begin as a STEP file and are none;
    /// [`Error::Section`] for a DXF file and a conoid of several sections, and for its solid where errors of the motion are asked for;
    /// [`Error::Rate`] when the follower does not have such a
    /// velocity or acceleration.
    pub fn check(&self, bytes: &[u8], request: impl Into<Request>) -> Result<Report, Error> {
        let request = request.into();
        if step::is_step(bytes) {
            return self.check_solid(bytes, &request);
        }
        let section = self.section(None)?;
        self.check_outline(bytes, section, &request)
    }

    /// Whether a DXF file holds the section of this conoid for a speed (rpm, one of those it was solved for, or as a file name
    /// tells it, to six digits), within a tolerance (m, or a [`Request`]).
    ///
    /// # Errors
    /// [`Error::Read`] when the bytes are not a DXF file; [`Error::Section`] when the cam has no such section; [`Error::Rate`] as
    /// for [`Cam::check`].
    pub fn check_section(&self, bytes: &[u8], rpm: f64, request: impl Into<Request>) -> Result<Report, Error> {
        let request = request.into();
        let section = self.section(Some(rpm))?;
        if step::is_step(bytes) {
            return Err(Error::Section("a STEP file holds the solid of all sections".into()));
        }
        self.check_outline(bytes, section, &request)
    }

    /// The section that is asked for, where there are sections.
    fn section(&self, asked: Option<f64>) -> Result<Option<OfSection>, Error> {
        let noun = self.body().kind().noun;
        let Some(conoid) = self.body().spatial() else {
            let why =
                asked.map(|_| Error::Section(format!("a {noun} has one outline for all its height, and no sections")));
            return why.map_or(Ok(None), Err);
        };
        let all: Vec<OfSection> =
            conoid.cuts().iter().map(|(rpm, z, _)| OfSection { rpm: *rpm, z_mm: MILLIMETRES * z, z: *z }).collect();
        let known: Vec<String> = all.iter().map(|section| section.rpm.to_string()).collect();
        let known = known.join(", ");
        match (asked, all.as_slice()) {
            (None, [only]) => Ok(Some(*only)),
            (None, _) => Err(Error::Section(format!(
                "a {noun} of several sections has a file for each: tell which, one of {known} rpm"
            ))),
            (Some(rpm), _) => {
                let found = all.iter().find(|section| (section.rpm - rpm).abs() <= SAME_SPEED * rpm).copied();
                found
                    .map(Some)
                    .ok_or_else(|| Error::Section(format!("there is no section for {rpm} rpm; one of {known} rpm")))
            }
        }
    }

    fn check_outline(&self, bytes: &[u8], section: Option<OfSection>, request: &Request) -> Result<Report, Error> {
        let tolerance_mm = MILLIMETRES * request.fit.tolerance;
        let motion = request.resolved(self.body())?.fit.motion;
        let reading = reading::read(bytes, join_reach(tolerance_mm))?;
        let z = section.map_or(0.0, |section| section.z);
        let outlines: Vec<WrittenOutline> = match reading.chains.as_slice() {
            [chain] if chain.closed => {
                let found = chain.contour();
                // The direction in which another program wrote the outline does not change the part.
                let turns_left = found.area_and_centroid().0 > 0.0;
                let contour = if turns_left { found } else { chain.reversed().contour() };
                vec![WrittenOutline { z, contour, beside: reading.beside.clone() }]
            }
            _ => Vec::new(),
        };
        let body = self.body();
        let curves = body.plane().zip(outlines.first());
        let rolled = curves.map(|(curves, outline)| rolling::roll(body, curves, &outline.contour, tolerance_mm));
        let checks = verify::run(&Evidence {
            body,
            drawn: None,
            outlines: &outlines,
            rolled: rolled.as_ref(),
            foreign: Some(&reading),
            cutter_path: None,
            points: None,
            compensator: None,
            solid: None,
            tolerance_mm,
            motion,
            strict: request.strict,
        });
        let mut sections = vec![Section::new("cam", &body.kind().noun)];
        sections.extend(section.map(|section| Section::new("section", &section)));
        sections.push(Section::new("rolling", &rolled));
        let found = outlines.first().map(|outline| &outline.contour);
        sections.extend(diagnosis::of(
            self,
            section.map(|section| section.rpm),
            found,
            (&checks, request.fit.tolerance),
        ));
        let whole = report(body, Inputs::of(&self.inputs_for(request)), sections, checks);
        let noun = match section {
            Some(section) => format!("section for {} rpm of a {}", section.rpm, whole.noun).into(),
            None => whole.noun.clone(),
        };
        Ok(Report { command: "check".into(), noun, ..whole })
    }

    fn check_solid(&self, bytes: &[u8], request: &Request) -> Result<Report, Error> {
        let tolerance_mm = MILLIMETRES * request.fit.tolerance;
        let motion = request.resolved(self.body())?.fit.motion;
        let body = self.body();
        let asked = request.rates.iter().zip(request.strict).any(|(rate, strict)| rate.is_some() && strict);
        if asked && body.spatial().is_some() {
            let noun = body.kind().noun;
            return Err(Error::Section(format!(
                "what the follower feels is found on the DXF files of the sections, not on the solid of a {noun}"
            )));
        }
        let file = step::read(bytes)?;
        let flank = if body.spatial().is_some() { Flank::Patches } else { Flank::Upright };
        let form = step::form(&file.boundary, flank, shell_reach(tolerance_mm));
        let outer = |run: &Loop| match run {
            Loop::Contour(contour) if contour.area_and_centroid().0 > 0.0 => Some(contour.clone()),
            _ => None,
        };
        let hole = |run: &Loop| match run {
            Loop::Contour(contour) if !(contour.area_and_centroid().0 > 0.0) => Some(Chain::of(&contour.reversed())),
            _ => None,
        };
        let outlines: Vec<WrittenOutline> = match form.under.iter().filter_map(outer).collect::<Vec<_>>().as_slice() {
            [contour] if body.plane().is_some() => {
                let beside = form.under.iter().filter_map(hole).collect();
                vec![WrittenOutline { z: 0.0, contour: contour.clone(), beside }]
            }
            _ => Vec::new(),
        };
        let curves = body.plane().zip(outlines.first());
        let rolled = curves.map(|(curves, outline)| rolling::roll(body, curves, &outline.contour, tolerance_mm));
        let solid = WrittenSolid { file, form };
        let checks = verify::run(&Evidence {
            body,
            drawn: None,
            outlines: &outlines,
            rolled: rolled.as_ref(),
            foreign: None,
            solid: Some(&solid),
            cutter_path: None,
            points: None,
            compensator: None,
            tolerance_mm,
            motion,
            strict: request.strict,
        });
        let sections = vec![Section::new("cam", &body.kind().noun), Section::new("rolling", &rolled)];
        let whole = report(body, Inputs::of(&self.inputs_for(request)), sections, checks);
        let noun = format!("solid of a {}", whole.noun).into();
        Ok(Report { command: "check".into(), noun, ..whole })
    }
}
