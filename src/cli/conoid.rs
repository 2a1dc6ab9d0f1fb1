//! `camgen conoid`: solve the sections, check, write, report.

use super::args::{ConoidArgs, STL, Speed};
use super::{Failure, Outcome, cut, print, tell, text};
use camgen::cam::between::{self, Residual};
use camgen::cam::conoid::{Conoid, Interpolation, Measures};
use camgen::checks;
use camgen::checks::conoid::{Subject, WrittenSection};
use camgen::drawing::conoid::{ConoidReport, Found, cuts, report, sections, table};
use camgen::drawing::flank::{self, Flank};
use camgen::drawing::outline::{MILLIMETRES, OutlineError};
use camgen::drawing::solid::conical;
use camgen::drawing::{Part, sheet};
use camgen::machine::Machine;
use camgen::output::files::{Output, write_all};
use camgen::output::formats::DEFAULT_FORMATS;
use camgen::output::number::shortest;
use camgen::output::proof::{self, Written};
use camgen::output::{csv, json, step, stl, svg};

/// More speeds than these are named by the first and the last.
const MOST_NAMED: usize = 6;

pub(super) fn run(args: &ConoidArgs) -> Result<Outcome, Failure> {
    let (machine, machine_name) = args.common.machine()?;
    let files = &args.files;
    let template = cut::template(files)?;
    let (conoid, left, speeds) = solve(args, &machine)?;
    let wanted = |name: &str| match &files.format {
        Some(asked) => asked.contains(&name),
        None => DEFAULT_FORMATS.contains(&name),
    };
    let tolerance = args.common.tolerance();
    let measures = Measures::new(&conoid);
    let (parts, refusal) = match sections(&conoid, files.fit(tolerance)) {
        Ok(parts) => (Some(parts), None),
        Err(OutlineError::Fit(_) | OutlineError::Undercut(_)) if measures.undercut(machine.roller.radius) => {
            (None, Some("the surface folds over itself where the roller is larger than it".to_owned()))
        }
        Err(error) => return Err(Failure::new(error)),
    };
    let written: Option<Vec<Written>> = parts
        .as_ref()
        .map(|parts| parts.iter().map(|part| proof::write(part, files.dxf_version)).collect())
        .transpose()
        .map_err(Failure::new)?;
    // The flank is drawn when somebody wants it, and proved when it is.
    let solid_wanted = wanted("step") || wanted(STL);
    let flank = if parts.is_some() && solid_wanted {
        Some(flank::flank(&conoid, MILLIMETRES * tolerance).map_err(Failure::new)?)
    } else {
        None
    };
    let places = cuts(&conoid);
    let outlines: Vec<WrittenSection<'_>> = places
        .iter()
        .zip(written.iter().flatten())
        .map(|((rpm, z), written)| WrittenSection { rpm: *rpm, z: *z, outline: &written.outline })
        .collect();
    let findings = checks::conoid::run(&Subject {
        conoid: &conoid,
        measures: &measures,
        sections: &outlines,
        flank_gap: flank.as_ref().map(|flank| flank::roll(&conoid, flank)),
        between: (left, args.residual),
        tolerance_mm: MILLIMETRES * tolerance,
    });
    let passed = checks::passed(&findings);
    let found = Found {
        parts: parts.as_deref(),
        flank: flank.as_ref(),
        between: (left, between::residual(&conoid, Interpolation::Straight)),
        measures: &measures,
    };
    let mut report = report(&conoid, &found, findings);
    match (&parts, &written) {
        (Some(parts), Some(written)) if passed || files.force => {
            let stem = files.name.clone().unwrap_or_else(|| format!("{machine_name}-conoid-{speeds}rpm"));
            let job = Job { args, conoid: &conoid, parts, written, flank: flank.as_ref(), stem, template };
            job.write(&mut report, &wanted)?;
        }
        (Some(_), _) => tell("refused: a check failed, nothing was written (--force writes all the same)"),
        (None, _) => {
            let why = refusal.unwrap_or_default();
            tell(&format!("refused: {why}; nothing was written, with --force neither"));
        }
    }
    if args.common.json {
        let bytes = json::write(&report).map_err(Failure::new)?;
        print(&String::from_utf8_lossy(&bytes))?;
    } else if !args.common.quiet {
        print(&text::conoid_report(&report, args.common.colour()))?;
    }
    Ok(if passed { Outcome::Fine } else { Outcome::CheckFailed })
}

/// The cam, what it leaves between its sections, and the speeds as its files are named by.
fn solve(args: &ConoidArgs, machine: &Machine) -> Result<(Conoid, Residual, String), Failure> {
    let one = |speed: &Speed| match speed {
        Speed::One(rpm) => Ok(*rpm),
        Speed::Range(..) => Err(Failure("give one range A..B, or a list of speeds".into())),
    };
    if let [Speed::Range(from, to)] = args.common.rpm.as_slice() {
        let Some(limit) = args.residual else {
            let why = "a range of speeds needs --residual, the force that may be left between the sections, e.g. 2N";
            return Err(Failure(why.into()));
        };
        let (conoid, left) = between::fewest(machine, (*from, *to), limit).map_err(Failure::new)?;
        return Ok((conoid, left, format!("{}-{}", shortest(*from), shortest(*to))));
    }
    let mut speeds: Vec<f64> = args.common.rpm.iter().map(one).collect::<Result<_, _>>()?;
    if speeds.is_empty() {
        speeds.push(machine.design_rpm);
    }
    let conoid = Conoid::solve(machine, &speeds).map_err(Failure::new)?;
    let left = between::residual(&conoid, Interpolation::Smooth);
    let names: Vec<String> = cuts(&conoid).iter().map(|(rpm, _)| shortest(*rpm)).collect();
    let name = match names.as_slice() {
        [first, .., last] if names.len() > MOST_NAMED => format!("{first}-{last}"),
        _ => names.join("-"),
    };
    Ok((conoid, left, name))
}

/// A conoid ready to be written.
struct Job<'a> {
    args: &'a ConoidArgs,
    conoid: &'a Conoid,
    parts: &'a [Part],
    written: &'a [Written],
    flank: Option<&'a Flank>,
    stem: String,
    template: String,
}

impl Job<'_> {
    fn write(&self, report: &mut ConoidReport, wanted: &dyn Fn(&str) -> bool) -> Result<(), Failure> {
        let (files, stem) = (&self.args.files, &self.stem);
        let mut names: Vec<(String, &str)> = Vec::new();
        if wanted("dxf") {
            let rpm = cuts(self.conoid);
            names.extend(rpm.iter().map(|(rpm, _)| (format!("{stem}-{}rpm.dxf", shortest(*rpm)), "dxf")));
        }
        let others = ["svg", "step", "csv", "json", STL];
        names.extend(others.iter().filter(|name| wanted(name)).map(|name| (format!("{stem}.{name}"), *name)));
        report.files = names.iter().map(|(name, _)| files.out.join(name).display().to_string()).collect();
        let mut sections = self.written.iter();
        let mut outputs = Vec::with_capacity(names.len());
        for (name, format) in names {
            let bytes = match format {
                "dxf" => sections.next().map(|written| written.bytes.clone()).unwrap_or_default(),
                "svg" => {
                    svg::write(&sheet::conoid(self.conoid, self.parts, report), &self.template).map_err(Failure::new)?
                }
                "step" => self.step(report)?,
                "csv" => csv::write(&table(self.conoid, files.samples)),
                "json" => json::write(report).map_err(Failure::new)?,
                _ => self.stl(),
            };
            outputs.push(Output { name, bytes });
        }
        write_all(&files.out, &outputs).map_err(Failure::new)?;
        Ok(())
    }

    fn step(&self, report: &ConoidReport) -> Result<Vec<u8>, Failure> {
        let Some(flank) = self.flank else { return Ok(Vec::new()) };
        let (low, high) = self.conoid.ends();
        let holes: Vec<_> = self.parts.first().map(Part::holes).unwrap_or_default();
        let holes: Vec<_> = holes.iter().map(|hole| hole.contour().reversed()).collect();
        let ends = (MILLIMETRES * low, MILLIMETRES * high);
        let solid = conical(&flank.patches, &holes, ends, flank.volume).map_err(Failure::new)?;
        Ok(step::write(&solid, &sheet::conoid_title(report)))
    }

    fn stl(&self) -> Vec<u8> {
        let bore = self.conoid.machine.cam.bore_radius.map(|radius| MILLIMETRES * radius);
        self.flank.map(|flank| stl::write(flank, bore)).unwrap_or_default()
    }
}
