//! One design: from the values of the keys to a line of figures.

use super::figures::{Plan, figure_at};
use super::parameter::{ParameterValue, SPEED};
use super::specification::Study;
use crate::body::{DrawingEvidence, Request};
use crate::check::{AsWritten, Check, Measures, Walls};
use crate::machine::{Machine, MachineError, valid_rpm};
use crate::pipeline::{Assembly, AssemblyDrawing, Writing};
use crate::tool_files::Format;
use crate::verify;
use crate::write::number::shortest;
use camgen_kernel::geometry::MILLIMETRES;
use serde_json::Value;

/// The columns before and after those of the study.
const ROW: &str = "row";
pub(super) const FEASIBLE: &str = "feasible";
pub(super) const FAULT: &str = "fault";

/// Rounding of a figure, as a share: that of a change of units.
const ROUNDING: f64 = 1e-14;

/// Why a design has no figures, as one line.
fn line(why: &str) -> String {
    why.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The faults of a machine file without the lines that they quote.
fn faults(error: &MachineError) -> String {
    let faults = error.faults.iter().map(|fault| match &fault.help {
        Some(help) => format!("{}; {help}", fault.message),
        None => fault.message.clone(),
    });
    faults.collect::<Vec<_>>().join("; ")
}

/// A text as a cell: in quotes where a reader of tables would otherwise take it for several cells or for a formula.
fn cell(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) || text.starts_with(['=', '+', '-', '@']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

/// A figure as a cell; empty where there is none.
fn of_figure(value: Option<&Value>) -> String {
    match value {
        Some(Value::Number(number)) => number.as_f64().map_or_else(String::new, shortest),
        Some(Value::Bool(truth)) => truth.to_string(),
        Some(Value::String(text)) => cell(&line(text)),
        _ => String::new(),
    }
}

impl Study {
    /// The names of the columns, with the end of the line.
    #[must_use]
    pub fn header(&self) -> String {
        let feasible = (!self.constraints.is_empty()).then(|| FEASIBLE.to_owned());
        let all = std::iter::once(ROW.to_owned())
            .chain(self.parameters.iter().map(|parameter| cell(&parameter.column())))
            .chain(self.columns.iter().map(|column| cell(column)))
            .chain(feasible)
            .chain([FAULT.to_owned()]);
        all.collect::<Vec<_>>().join(",") + "\n"
    }

    /// The overrides of a design as `--set` takes them, and its speed as `--rpm` does.
    #[must_use]
    pub fn overrides(&self, values: &[ParameterValue]) -> (Vec<String>, Option<f64>) {
        let (mut all, mut rpm) = (self.set.clone(), self.rpm);
        for (parameter, value) in self.parameters.iter().zip(values) {
            if parameter.key == SPEED {
                rpm = value.number;
            } else {
                all.push(format!("{}={}", parameter.key, value.typed));
            }
        }
        (all, rpm)
    }

    /// The solved cam of a design, with those that are made with it.
    fn assembly(&self, values: &[ParameterValue]) -> Result<Assembly, String> {
        let (overrides, rpm) = self.overrides(values);
        let rpm = rpm.map(valid_rpm).transpose()?;
        let machine = Machine::of_source(&self.base, &overrides).map_err(|error| faults(&error))?;
        let spec = self.command.spec(machine, rpm.as_slice()).map_err(|why| why.to_string())?;
        spec.assemble().map_err(|why| why.to_string())
    }

    /// The figures of a solved cam.
    fn solved(&self, assembly: &Assembly, plan: &Plan) -> Value {
        let body = assembly.first().body();
        let tolerance_mm = MILLIMETRES * self.tolerance;
        let sections = if plan.wants_sections() {
            body.sections(&DrawingEvidence { drawn: None, rolled: &[], tolerance_mm, wanted: plan.paths() })
        } else {
            Vec::new()
        };
        let wanted = |check: &Check| plan.wants_check(check.name, check.on);
        let walls = Walls::default();
        let written = AsWritten { rolled: None, outlines: &[], foreign: false, tolerance_mm, walls, size_mm: None };
        let mut measures = Measures::new(&wanted, written);
        body.measures(&mut measures);
        plan.figures(sections, &verify::judge(&measures.found()), None)
    }

    /// The figures of a proved cam, and why it has no outline, where it has none.
    fn proven(&self, assembly: &Assembly, plan: &Plan) -> Result<(Value, Option<String>), String> {
        let formats = Writing::to("", "").chosen(assembly.first().body());
        let flank = formats.is_ok_and(|(formats, _)| formats.iter().any(Format::shows_flank));
        let request = Request { flank, ..Request::usual(self.tolerance) };
        let proven = assembly.draw(request).and_then(AssemblyDrawing::prove).map_err(|why| why.to_string())?;
        let no_outline = proven.no_outline().map(|why| format!("there is no outline: {why}"));
        let sections = if plan.wants_sections() { proven.sections(plan.paths()) } else { Vec::new() };
        Ok((plan.figures(sections, proven.findings(), Some(proven.passed())), no_outline))
    }

    /// The figures of a design before and after it is drawn; `None` where it has none.
    pub(super) fn both_reports(&self, row: u64) -> Option<(Value, Value)> {
        let assembly = self.assembly(&self.values(row)).ok()?;
        let whole = Plan::whole();
        let (proven, no_outline) = self.proven(&assembly, &whole).ok()?;
        no_outline.is_none().then(|| (self.solved(&assembly, &whole), proven))
    }

    /// The figures of a design, and why some of them are missing.
    fn figures(&self, values: &[ParameterValue]) -> (Value, Option<String>) {
        let assembly = match self.assembly(values) {
            Ok(assembly) => assembly,
            Err(why) => return (Value::Null, Some(why)),
        };
        if !self.plan.proves {
            return (self.solved(&assembly, &self.plan), None);
        }
        self.proven(&assembly, &self.plan).unwrap_or_else(|why| (Value::Null, Some(why)))
    }

    /// Whether the figures keep every constraint.
    fn keeps(&self, figures: &[Option<&Value>]) -> bool {
        self.constraints.iter().all(|constraint| {
            let value = figures.get(constraint.column).copied().flatten();
            // A truth is 1 or 0. A figure in millimetres may differ from the number that was typed by its rounding.
            let value = value
                .and_then(|value| value.as_f64().or_else(|| value.as_bool().map(|truth| f64::from(u8::from(truth)))));
            let ((least, most), slack) = (constraint.within, |limit: f64| ROUNDING * limit.abs());
            value.is_some_and(|value| {
                (least == f64::NEG_INFINITY || least - slack(least) <= value)
                    && (most == f64::INFINITY || value <= most + slack(most))
            })
        })
    }

    /// Writes the line of a design.
    pub(super) fn write_row(&self, row: u64, out: &mut Vec<u8>) {
        let values = self.values(row);
        let (found, why) = self.figures(&values);
        let figures: Vec<Option<&Value>> = self.columns.iter().map(|path| figure_at(&found, path)).collect();
        let mut text = row.to_string();
        for value in &values {
            text.push(',');
            text.push_str(&value.number.map_or_else(|| cell(&value.typed), shortest));
        }
        for figure in &figures {
            text.push(',');
            text.push_str(&of_figure(*figure));
        }
        if !self.constraints.is_empty() {
            text.push_str(if self.keeps(&figures) { ",true" } else { ",false" });
        }
        text.push(',');
        text.push_str(&cell(&line(&why.unwrap_or_default())));
        text.push('\n');
        out.extend_from_slice(text.as_bytes());
    }
}
