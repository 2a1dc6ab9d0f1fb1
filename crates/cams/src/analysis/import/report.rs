//! What is told of an import: the section of the report, the table, the picture, the check.

use super::DEVIATION;
use super::design::{told, told_of, unit};
use super::model::{LawParameter, Left, ModelLaw};
use super::motion::{FoundMotion, MOST_STRETCHES};
use super::positions::Positions;
use super::spline::position;
use crate::check::Measure;
use crate::report::plot::{CurveStroke, Plot, PlotCurve, PlotPanel, PlotPoint, figure};
use crate::report::{Place, Section, shown};
use crate::table::{ListedColumn, Table};
use camgen_kernel::follower::Follower;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::laws::SegmentEnd;
use camgen_kernel::motion::program::Program;
use camgen_kernel::motion::{Motion, Quantity};
use camgen_kernel::text::{Length, Text, Value, text};
use nalgebra::Vector2;
use serde::Serialize;

/// By how much residuals are drawn larger.
const ENLARGED: f64 = 500.0;
/// Laws that are told besides the one that was recognised.
const OTHERS: usize = 3;

/// What was imported, and the design of it.
#[derive(Debug)]
pub(super) struct Imported {
    /// "table", "outline" or "points".
    pub(super) form: &'static str,
    pub(super) rows: Positions,
    /// Of single positions, m or rad.
    pub(super) noise: f64,
    pub(super) deviation: f64,
    pub(super) rounding: f64,
    pub(super) found: FoundMotion,
    /// Travel of the follower for a unit of its position, m.
    pub(super) leverage: f64,
    /// Its follower, sized for the cam.
    pub(super) follower: Option<Box<dyn Follower>>,
    /// Where the centre of measured points is in their frame, mm.
    pub(super) shift: Option<Vector2<f64>>,
    /// By how much the cam was turned, rad.
    pub(super) turn: f64,
    pub(super) ball: f64,
    /// The widest gap of points, degrees.
    pub(super) widest: Option<f64>,
    pub(super) base_radius: Option<f64>,
    pub(super) told: Vec<String>,
    /// The design file.
    pub(super) text: String,
    /// What the design leaves.
    pub(super) left: Left,
    /// The design at each row: position, velocity and acceleration.
    pub(super) design: Vec<[f64; 3]>,
    /// Where it is farthest off.
    pub(super) worst: usize,
}

/// The section of the report.
#[derive(Debug, Serialize)]
struct ImportSection {
    form: &'static str,
    rows: usize,
    unit: &'static str,
    lift: f64,
    noise: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    rounding: Option<f64>,
    deviation: f64,
    /// Of the design from the imported positions.
    rms: f64,
    largest: f64,
    largest_mm: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    base_radius_mm: Option<f64>,
    turn_deg: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    centre_mm: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    ball_radius_mm: Option<f64>,
    largest_acceleration_per_rad2: f64,
    segments: Vec<SegmentSection>,
    design: String,
}

#[derive(Debug, Serialize)]
struct SegmentSection {
    law: &'static str,
    from_deg: f64,
    to_deg: f64,
    from: f64,
    to: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    inflection: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    line: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    ramp: Option<f64>,
    ends: [&'static str; 2],
    #[serde(skip_serializing_if = "Option::is_none")]
    rms: Option<f64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    others: Vec<OtherLaw>,
}

#[derive(Debug, Serialize)]
struct OtherLaw {
    law: &'static str,
    rms: f64,
}

/// A row of the table: the cam angle, degrees; imported, design, difference, velocity, acceleration.
struct ImportRow([f64; 6]);

const LENGTHS: &[ListedColumn<ImportRow>] = &[
    ("cam_deg", |row| row.0[0]),
    ("imported_position_mm", |row| row.0[1]),
    ("position_mm", |row| row.0[2]),
    ("residual_mm", |row| row.0[3]),
    ("velocity_mm_per_rad", |row| row.0[4]),
    ("acceleration_mm_per_rad2", |row| row.0[5]),
];
const ANGLES: &[ListedColumn<ImportRow>] = &[
    ("cam_deg", |row| row.0[0]),
    ("imported_position_deg", |row| row.0[1]),
    ("position_deg", |row| row.0[2]),
    ("residual_deg", |row| row.0[3]),
    ("velocity_rad_per_rad", |row| row.0[4]),
    ("acceleration_rad_per_rad2", |row| row.0[5]),
];

impl Imported {
    pub(super) fn new(form: &'static str, rows: Positions, noise: f64, deviation: f64, found: FoundMotion) -> Self {
        let left = found.model.left(&rows, (0, rows.len()));
        Self {
            form,
            rows,
            noise,
            deviation,
            rounding: 0.0,
            found,
            leverage: 1.0,
            follower: None,
            shift: None,
            turn: 0.0,
            ball: 0.0,
            widest: None,
            base_radius: None,
            told: Vec::new(),
            text: String::new(),
            left,
            design: Vec::new(),
            worst: 0,
        }
    }

    /// Stretches that follow no law.
    pub(super) fn splines(&self) -> usize {
        let unknown =
            self.found.model.segments.iter().filter(|segment| matches!(segment.law, ModelLaw::Unknown)).count();
        unknown.max(usize::from(self.found.whole))
    }

    /// Moves everything by an angle (rad) and a position (m or rad).
    pub(super) fn move_by(&mut self, angle: f64, position: f64) {
        self.rows.angles.iter_mut().for_each(|at| *at += angle);
        self.found.model.nodes.iter_mut().for_each(|at| *at += angle);
        self.rows.values.iter_mut().for_each(|value| *value += position);
        self.found.model.levels.iter_mut().for_each(|value| *value += position);
        self.turn += angle;
    }

    /// The lowest position.
    pub(super) fn lowest(&self) -> f64 {
        if self.found.whole {
            return self.rows.range().0;
        }
        let model = &self.found.model;
        let levels =
            model.segments.iter().flat_map(|segment| [segment.from, segment.to]).map(|level| model.level(level));
        levels.fold(f64::INFINITY, f64::min)
    }

    /// Compares the positions with the design.
    pub(super) fn compare(&mut self, program: &Program) {
        let at = |angle: f64| {
            let (piece, inside) = program.locate(angle);
            let jet = program.jet(piece, inside);
            [position(program, angle), jet.ds, jet.dds]
        };
        self.design = self.rows.angles.iter().map(|angle| at(*angle)).collect();
        let off: Vec<f64> =
            self.design.iter().zip(&self.rows.values).map(|(design, value)| design[0] - value).collect();
        self.worst = (0..off.len()).max_by(|a, b| off[*a].abs().total_cmp(&off[*b].abs())).unwrap_or(0);
        #[expect(clippy::cast_precision_loss, reason = "few positions")]
        let rms = (off.iter().map(|off| off * off).sum::<f64>() / off.len().max(1) as f64).sqrt();
        self.left = Left { rms, largest: off.iter().map(|off| off.abs()).fold(0.0, f64::max), count: off.len() };
    }

    /// How far a position of the design is off, m or rad.
    fn residual(&self, at: usize) -> f64 {
        self.design.get(at).map_or(f64::NAN, |design| design[0]) - self.rows.value(at)
    }

    fn in_mm(&self, value: f64) -> f64 {
        MILLIMETRES * self.leverage * value
    }

    pub(super) fn measure(&self) -> Measure {
        let row = self.rows.rows.get(self.worst).map_or(self.worst, |row| *row) + 1;
        let what = match self.form {
            "table" => "row",
            "points" => "point",
            _ => "place",
        };
        let measure = DEVIATION.measure(self.in_mm(self.left.largest), Some(self.in_mm(self.deviation)));
        measure.placed(Place::at_angle(self.rows.angle(self.worst))).noted(text!("{} {}", what, row))
    }

    pub(super) fn notes(&self, follower_given: bool) -> Vec<String> {
        let mut notes = self.told.clone();
        if !follower_given {
            notes.push("no follower was given: the design has a roller of 30 mm diameter to start from; --follower gives another".into());
        }
        if let Some(widest) = self.widest.filter(|widest| *widest > 5.0) {
            notes.push(format!("the points leave gaps of up to {} deg of the cam angle", shown(widest)));
        }
        notes
    }

    pub(super) fn table(&self) -> Table {
        let (_, size) = unit(self.rows.quantity);
        let rate = if self.rows.quantity == Quantity::Angle { 1.0 } else { size };
        let row = |at: usize| {
            let [s, v, a] = self.design.get(at).copied().unwrap_or([f64::NAN; 3]);
            let angle = self.rows.angle(at).rem_euclid(self.rows.fill).to_degrees();
            ImportRow([angle, self.rows.value(at) / size, s / size, self.residual(at) / size, v / rate, a / rate])
        };
        let mut rows: Vec<ImportRow> = (0..self.rows.len()).map(row).collect();
        rows.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]));
        Table::listed(if self.rows.quantity == Quantity::Angle { ANGLES } else { LENGTHS }, &rows)
    }

    pub(super) fn section(&self) -> Section {
        let (name, size) = unit(self.rows.quantity);
        let rate = if self.rows.quantity == Quantity::Angle { 1.0 } else { size };
        let (low, high) = self.rows.range();
        let turn = self.turn.to_degrees().rem_euclid(360.0);
        let value = ImportSection {
            form: self.form,
            rows: self.rows.len(),
            unit: name,
            lift: (high - low) / size,
            noise: self.noise / size,
            rounding: (self.rounding > 0.0).then_some(self.rounding / size),
            deviation: self.deviation / size,
            rms: self.left.rms / size,
            largest: self.left.largest / size,
            largest_mm: self.in_mm(self.left.largest),
            base_radius_mm: self.base_radius,
            turn_deg: if turn > 180.0 { turn - 360.0 } else { turn },
            centre_mm: self.shift.map(|shift| [shift.x, shift.y]),
            ball_radius_mm: (self.ball > 0.0).then_some(self.ball),
            largest_acceleration_per_rad2: self.design.iter().map(|design| design[2].abs()).fold(0.0, f64::max) / rate,
            segments: self.segments(),
            design: self.text.clone(),
        };
        Section::new("import", &value).with_words(self.words(&value))
    }

    fn segments(&self) -> Vec<SegmentSection> {
        if self.found.whole {
            return Vec::new();
        }
        let (model, (_, size)) = (&self.found.model, unit(self.rows.quantity));
        let of = |(at, segment): (usize, &super::model::ModelSegment)| {
            let told = self.found.segments.get(at);
            let fits = told.map_or(&[][..], |told| told.fits.as_slice());
            let (law, parameter, ends) = match segment.law {
                ModelLaw::Dwell => ("dwell", LawParameter::Usual, ["rest"; 2]),
                ModelLaw::Unknown => ("spline", LawParameter::Usual, ["rest"; 2]),
                ModelLaw::Law(law) => (
                    law.law.name,
                    law.parameter,
                    law.ends.map(|end| if end == SegmentEnd::Turn { "turn" } else { "rest" }),
                ),
            };
            let of = |wanted: fn(LawParameter) -> Option<f64>| wanted(parameter);
            SegmentSection {
                law,
                from_deg: model.start(at).to_degrees(),
                to_deg: model.end(at).to_degrees(),
                from: model.level(segment.from) / size,
                to: model.level(segment.to) / size,
                inflection: of(
                    |parameter| if let LawParameter::Inflection(share) = parameter { Some(share) } else { None },
                ),
                line: of(|parameter| if let LawParameter::Line(line) = parameter { Some(line) } else { None }),
                ramp: of(|parameter| if let LawParameter::Ramp(ramp) = parameter { Some(ramp) } else { None }),
                ends,
                rms: fits.first().filter(|(name, _)| *name == law).map(|(_, left)| left.rms / size),
                others: fits
                    .iter()
                    .filter(|(name, _)| *name != law)
                    .take(OTHERS)
                    .map(|(law, left)| OtherLaw { law, rms: left.rms / size })
                    .collect(),
            }
        };
        model.segments.iter().enumerate().map(of).collect()
    }

    fn words(&self, value: &ImportSection) -> Vec<Text> {
        let quantity = self.rows.quantity;
        let what = match self.form {
            "table" => "rows",
            "points" => "points",
            _ => "places of the outline",
        };
        let rounding = value.rounding.map(|step| text!(", rounded to {}", Value::with_unit(step, value.unit)));
        let mut words = vec![text!(
            "{} {}, lift {}{}, noise {}, deviation allowed {}",
            value.rows,
            what,
            Value::with_unit(value.lift, value.unit),
            rounding,
            told(quantity, self.noise),
            told(quantity, self.deviation)
        )];
        if let Some([x, y]) = value.centre_mm {
            words.push(text!(
                "turned by {}°, centre at {} and {} of the points",
                shown(value.turn_deg),
                Length::mm(x).bare(),
                Length::mm(y)
            ));
        }
        if let Some(radius) = value.base_radius_mm {
            words.push(text!("base radius {}", Length::mm(radius)));
        }
        if let Some(stretches) = self.found.unsought {
            words.push(text!(
                "{} rises and returns, laws are fitted to at most {}: the whole motion is a spline through points",
                stretches,
                MOST_STRETCHES
            ));
        } else if self.found.whole {
            words.push("no law and no dwell was found: the whole motion is a spline through points".into());
        }
        let model = &self.found.model;
        for (at, segment) in value.segments.iter().enumerate() {
            let told_segment = self.found.segments.get(at);
            let law = model.segments.get(at).map_or(ModelLaw::Dwell, |segment| segment.law);
            let fits = told_segment.map_or(&[][..], |told| told.fits.as_slice());
            let way = match segment.law {
                "dwell" => text!("dwell at {}", Value::with_unit(segment.from, value.unit)),
                law => text!(
                    "{} from {} to {}",
                    law,
                    Value::before_unit(segment.from, value.unit),
                    Value::with_unit(segment.to, value.unit)
                ),
            };
            let comment = told_of(quantity, fits, law);
            let comment = if comment.is_empty() { comment } else { format!(": {comment}") };
            words.push(text!("{}° to {}° {}{}", shown(segment.from_deg), shown(segment.to_deg), way, comment));
        }
        let rate = if quantity == Quantity::Angle { "rad/rad²" } else { "mm/rad²" };
        words.push(text!(
            "the design leaves {} rms, {} at most; largest acceleration {}",
            told(quantity, self.left.rms),
            told(quantity, self.left.largest),
            Value::with_unit(value.largest_acceleration_per_rad2, rate)
        ));
        words
    }

    pub(super) fn plot(&self, name: &str) -> Plot {
        let (unit, size) = unit(self.rows.quantity);
        let mut order: Vec<usize> = (0..self.rows.len()).collect();
        let angle = |at: usize| self.rows.angle(at).rem_euclid(self.rows.fill).to_degrees();
        order.sort_by(|a, b| angle(*a).total_cmp(&angle(*b)));
        let points = |value: &dyn Fn(usize) -> f64| order.iter().map(|at| [angle(*at), value(*at)]).collect::<Vec<_>>();
        let design = |at: usize| self.design.get(at).copied().unwrap_or([f64::NAN; 3]);
        let enlarged = points(&|at| (design(at)[0] - ENLARGED * self.residual(at)) / size);
        let lift = PlotPanel::new(
            format!("Position, {unit}"),
            vec![
                PlotCurve::grey("imported", points(&|at| self.rows.value(at) / size)),
                PlotCurve::new("design", 0, points(&|at| design(at)[0] / size)).stroked(CurveStroke::Thin),
                PlotCurve::new(format!("error × {ENLARGED}"), 1, enlarged).stroked(CurveStroke::Dashed),
            ],
        );
        let swings = self.rows.quantity == Quantity::Angle;
        let (fine, of_fine) = if swings { ("degrees", size) } else { ("µm", 1e-6) };
        let residuals = points(&|at| self.residual(at) / of_fine);
        let worst = residuals.iter().copied().reduce(|a, b| if b[1].abs() > a[1].abs() { b } else { a });
        let worst_text = |at: [f64; 2]| format!("{} {fine} at {}°", figure(at[1]), figure(at[0]));
        let residual = PlotPanel {
            points: worst.map(|at| PlotPoint::dot(at, 1, worst_text(at))).into_iter().collect(),
            ..PlotPanel::new(
                format!("Error of the fit, design less imported, {fine}"),
                vec![PlotCurve::new("", 1, residuals)],
            )
        };
        let rate = if swings { 1.0 } else { size };
        let per = if swings { "rad/rad²" } else { "mm/rad²" };
        let acceleration = PlotPanel::new(
            format!("Acceleration of the design, {per}"),
            vec![PlotCurve::new("", 0, points(&|at| design(at)[2] / rate))],
        );
        Plot {
            title: format!(
                "The design is {} off at most",
                worst.map_or_else(String::new, |at| format!("{} {fine}", figure(at[1].abs())))
            ),
            subtitle: format!("{name}: imported from a {}", self.form.trim_end_matches('s')),
            places: "cam angle, degrees".into(),
            panels: vec![lift, residual, acceleration],
            ..Plot::default()
        }
    }
}
