//! The plate on the bed as a [`Body`], for checks, drawings, tables and reports.

use super::{KIND, Wedge, mechanism, mirrored_about_axis, roller_clearance, sheet};
use crate::press::MachineOfPress;
use crate::press::balance::reversal_of_bed;
use crate::press::checks::balanced::of_balance;
use crate::press::columns::{self, BalanceRow, WedgeRow};
use crate::press::load::{air_law, balance_of, closed_at};
use crate::press::motion::equation_18::{BedDirection, BottomMotion, EfficiencyModel, ExactOn, Solver, Trend};
use crate::press::picture::not_modelled_of;
use crate::press::report::{
    AirLaw, Equation18, ForceMeasures, PlateMeasures, ResidualByDirection, SlopeBreak, WedgeMeasures,
};
use camgen_cams::body::figures::with_subject;
use camgen_cams::body::part::Part;
use camgen_cams::body::picture::RIGID;
use camgen_cams::body::{
    Body, CORNER_REACH, Cut, DrawError, DrawingEvidence, Drawn, Figures, Kind, LoadAsCut, Request, exact, mirrored,
};
use camgen_cams::check::Measures;
use camgen_cams::machine::Machine;
use camgen_cams::report::mechanism::MovingMechanism;
use camgen_cams::report::sheet::SheetView;
use camgen_cams::report::{Place, Section, Shaft, Speeds};
use camgen_cams::table::Row;
use camgen_kernel::document::NamedChoice;
use camgen_kernel::geometry::boundary::{Boundary, BoundaryStretch};
use camgen_kernel::geometry::contour::{Contour, Edge, Segment, Vertex};
use camgen_kernel::geometry::{MILLIMETRES, radius_of_curvature};
use camgen_kernel::motion::{Jet, Motion};
use camgen_kernel::profile::boundary;
use camgen_kernel::profile::envelope::NoEnvelope;
use camgen_kernel::profile::outline::{self, Fit, Outline, OutlineError};
use camgen_kernel::refusal::Refusal;
use nalgebra::Vector2;

/// Readers drop shorter segments, mm.
const SHORTEST: f64 = 1e-6;

impl Wedge {
    /// The plate as an outline: lower flank, straight run-out, end, the upper flank as its mirror image, other end.
    fn outline(&self, fit: Fit) -> Result<Outline, DrawError> {
        if !(self.thinnest > 0.0) {
            let [thinnest, x, least] =
                [self.thinnest, self.thinnest_at, self.height - self.thinnest].map(|length| MILLIMETRES * length);
            let refusal = Refusal::new(format!("the flanks of the plate would cross by {:.3} mm", -thinnest))
                .at(format!("x = {x:.3} mm"));
            let remedy = format!("translating.plate_height must exceed {least:.3} mm");
            return Err(DrawError::NoOutline(refusal.remedy(remedy).to_string()));
        }
        let curves = self.curves();
        let (flank, shift) = outline::profile_within(curves, fit).map_err(|error| match error {
            OutlineError::Undercut(_) => DrawError::NoOutline(error.to_string()),
            other => other.into(),
        })?;
        let mut lower = flank.contour.vertices;
        let last = self.motion.pieces().len().saturating_sub(1);
        let contact = curves.contact(last, self.stroke()).curve;
        let (outward, tangent) = (contact.outward(), contact.tangent);
        let end = contact.offset_inward(curves.offset() + shift).point * MILLIMETRES;
        // The flank offset from the exact one ends on the same end of the plate; a short run-out may end before that one does.
        let back = outward * shift - tangent * (shift * outward.x / tangent.x);
        let run_out = self.run_out() * MILLIMETRES - back * MILLIMETRES;
        let there = (run_out - end).dot(&tangent) > SHORTEST;
        lower.extend(std::iter::once(end).chain(there.then_some(run_out)).map(|point| Vertex::new(point, 0.0)));
        // The edges of the flank, its end left out, and their mirror images run the other way.
        let last = lower.last().map(|vertex| vertex.point);
        let flank_edges: Vec<Edge> = Contour { vertices: lower }.edges().collect();
        let own = flank_edges.len().saturating_sub(1);
        let first = flank_edges.first().map(Edge::start);
        let mut vertices = Contour::from_edges(flank_edges.iter().take(own).copied()).vertices;
        vertices.extend(last.map(|point| Vertex::new(point, 0.0)));
        vertices.extend(Contour::from_edges(flank_edges.iter().take(own).rev().map(Edge::mirrored_about_x)).vertices);
        vertices.extend(first.map(|point| Vertex::new(mirrored_about_axis(point), 0.0)));
        Ok(Outline {
            contour: Contour { vertices },
            deviation: flank.deviation,
            best_possible: 2.0 * flank.best_possible,
            best_for: flank.best_for.map(|best| 2.0 * best),
            lead_in: None,
        })
    }

    /// The pitch curve of the lower flank, for viewing.
    pub(super) fn pitch_curve(&self) -> Result<Vec<Segment>, OutlineError> {
        let mut vertices = outline::pitch(self.curves())?.contour.vertices;
        let last = self.motion.pieces().len().saturating_sub(1);
        let end = self.curves().contact(last, self.stroke()).curve.point * MILLIMETRES;
        vertices.push(Vertex::new(end, 0.0));
        // A pitch curve is laid as arcs.
        let pairs = vertices.array_windows();
        let arcs = pairs.filter_map(|[a, b]| Some(Segment { start: a.point, end: b.point, bulge: a.bulge()? }));
        Ok(arcs.collect())
    }

    fn law(&self) -> AirLaw {
        let mechanism = self.mechanism();
        let (dx_max_at_x, dx_max) = self.largest_displacement();
        AirLaw {
            start_slope: self.motion.motion().at(0.0, false)[1],
            velocity_jump_mm_per_rad: MILLIMETRES * self.stroke() * self.motion.slope_jump(),
            column_closed_at_crank_deg: closed_at(self.machine.transition()),
            equation_18: Some(self.solved()),
            ..air_law(&self.cylinder, mechanism.bottom_law.by_crank(), dx_max_at_x, dx_max)
        }
    }

    fn solved(&self) -> Equation18 {
        let motion = self.motion.motion();
        let (solver, tolerance_mm, stations) = match self.solver {
            Solver::Ode { tolerance } => ("ode", Some(MILLIMETRES * tolerance), None),
            Solver::Paper { stations } => ("paper", None, Some(stations)),
        };
        let model = match self.mechanism().model {
            EfficiencyModel::Consistent => "consistent",
            EfficiencyModel::Printed => "printed",
        };
        let exact_on = self.mechanism().exact_on.word();
        Equation18 {
            solver: solver.into(),
            tolerance_mm,
            stations,
            steps: match motion {
                BottomMotion::Ode(solution) => Some(solution.steps()),
                BottomMotion::Paper(_) => None,
            },
            efficiency_model: model.into(),
            friction_angle_deg: self.mechanism().friction_angle.to_degrees(),
            efficiency: self.mechanism().efficiency,
            balance: exact_on.into(),
            breaks: motion
                .breaks()
                .iter()
                .map(|b| {
                    let then = match b.then {
                        Trend::Rising => "rising",
                        Trend::Falling => "falling",
                        Trend::Stuck => "stuck",
                    };
                    SlopeBreak { x_mm: MILLIMETRES * b.x, then: then.into() }
                })
                .collect(),
        }
    }

    fn forces(&self, rolled: Option<f64>) -> ForceMeasures {
        let [braking, back] = [BedDirection::Braking, BedDirection::Return].map(|way| self.residual_max(way));
        let inertia = self.inertia_max();
        let back_at = back.at;
        let (braking, back) = (braking.value, back.value);
        let of_law = match self.mechanism().exact_on {
            ExactOn::Braking => braking,
            ExactOn::Return => back,
            ExactOn::Mean => braking.max(back),
        };
        let residual_max_n = rolled.unwrap_or(of_law);
        ForceMeasures {
            inertia_max_n: inertia,
            residual_max_n,
            residual_share: residual_max_n / inertia,
            residual_fixed_bottom_max_n: self.residual_fixed_bottom(),
            by_direction: Some(ResidualByDirection {
                residual_braking_max_n: braking,
                residual_braking_share: braking / inertia,
                residual_return_max_n: back,
                residual_return_share: back / inertia,
                residual_return_at_x_mm: MILLIMETRES * back_at,
            }),
            roller_force_max_n: self.roller_force_max(),
            torque_max_nm: None,
        }
    }

    /// A bed position in millimetres, as a row of the table; points of the upper flank.
    fn row(&self, x_mm: f64) -> Row {
        let (piece, x) = self.motion.locate(x_mm / MILLIMETRES);
        self.row_at(x_mm, piece, x)
    }

    fn row_at(&self, x_mm: f64, piece: usize, x: f64) -> Row {
        let bottom = self.motion.bottom(piece, x);
        let contact = self.curves().contact(piece, x);
        let profile = contact.curve.offset_inward(self.data.roller_radius);
        let wedge = WedgeRow {
            lift: self.by_crank(x, contact.lift),
            psi_deg: self.mechanism().psi(bottom.s).to_degrees(),
            alpha_deg: self.mechanism().slope_angle(bottom.s, bottom.ds).to_degrees(),
            slope: bottom.ds,
            roller_force: self.roller_force(piece, x, BedDirection::Braking),
            residual_return: self.residual(piece, x, BedDirection::Return),
            residual_braking: self.residual(piece, x, BedDirection::Braking),
        };
        let bed = columns::of_bed(None, x_mm, MILLIMETRES * bottom.s);
        let balance = self.balance_row(x, bottom.s);
        Row {
            parameter: Some(x_mm / MILLIMETRES),
            curve: Some(mirrored_about_axis(contact.curve.point) * MILLIMETRES),
            profile: Some(mirrored_about_axis(profile.point) * MILLIMETRES),
            pressure_angle_deg: Some(contact.pressure_angle.to_degrees()),
            curve_radius: Some(radius_of_curvature(contact.curve.curvature)),
            profile_radius: Some(radius_of_curvature(profile.curvature)),
            added: [bed, wedge.columns(), balance.columns()].concat(),
            ..Row::default()
        }
    }
}

impl Wedge {
    /// Inertia and air; in (18) the plate takes part in the balance, whose residuals are in the plate's own columns.
    pub(super) fn balance_row(&self, x: f64, bottom: f64) -> BalanceRow {
        let law = &self.mechanism().bottom_law;
        let ratio = if x < 0.0 { 1.0 } else { 1.0 + self.mechanism().air(x, bottom) };
        let over = x.max(0.0);
        let inertia = self.cylinder.unit_force() * law.loading() * law.deceleration(over);
        let balance = balance_of(&self.cylinder, x >= 0.0, inertia, law.air_of_fixed_bottom(over), ratio);
        BalanceRow { residual: None, ..balance }
    }

    /// A jet by x as one by the angle of the crank.
    pub(super) fn by_crank(&self, x: f64, jet: Jet) -> Jet {
        let [first, second, third] = self.mechanism().bottom_law.pace(x);
        Jet {
            s: jet.s,
            ds: jet.ds * first,
            dds: jet.dds * first * first + jet.ds * second,
            ddds: jet.ddds * first * first * first + 3.0 * jet.dds * first * second + jet.ds * third,
        }
    }
}

impl Body for Wedge {
    fn kind(&self) -> &'static Kind {
        &KIND
    }

    fn machine(&self) -> &Machine {
        &self.machine
    }

    fn speeds(&self) -> Speeds {
        Speeds::One(self.rpm)
    }

    fn cuts(&self) -> Vec<Cut<'_>> {
        vec![Cut::plane(self.curves(), &[false, true], &self.worst)]
    }

    fn place(&self, x: f64) -> Place {
        Place::at_overrun(x)
    }

    fn shaft_speed(&self) -> Option<f64> {
        Some(self.crank_speed)
    }

    fn shaft(&self) -> Option<Shaft> {
        self.machine.press().ok()?.bed.shaft("crank", 1)
    }

    fn parameter_at(&self, point: Vector2<f64>) -> f64 {
        point.x
    }

    /// Those of its two straight ends.
    fn corner_within(&self, point: Vector2<f64>, reach: f64) -> bool {
        // The upper flank is the mirror image of the lower.
        let mut corners = [self.start(), self.run_out()].into_iter();
        corners.any(|corner| libm::hypot(point.x - corner.x, point.y.abs() - corner.y.abs()) <= reach)
    }

    fn measures(&self, of: &mut Measures<'_>) {
        with_subject(self, |subject| {
            self.measured(of, subject);
            of.add(&roller_clearance::CHECK, |_| roller_clearance::measure(self, subject));
            of_balance(self, of, subject);
        });
    }

    fn load(&self) -> Option<&dyn LoadAsCut> {
        Some(self)
    }

    fn edges(&self) -> Vec<[Vector2<f64>; 2]> {
        let (start, run_out) = (self.start(), self.run_out());
        let end = self.curves().profile(self.motion.pieces().len().saturating_sub(1), self.stroke()).point;
        let [upper_start, upper_run_out, upper_end] = [start, run_out, end].map(mirrored_about_axis);
        vec![[start, upper_start], [run_out, upper_run_out], [end, run_out], [upper_end, upper_run_out]]
    }

    /// Lower flank, run-out, end, the upper flank as the mirror image of the lower; the other end closes the loop.
    fn boundary<'a>(&'a self, cut: &Cut<'a>) -> Result<Option<Boundary<'a>>, NoEnvelope> {
        let curves = self.curves();
        let mut lower = boundary::stretches(curves, cut.is_undercut())?;
        let last = self.motion.pieces().len().saturating_sub(1);
        let (end, run_out) = (curves.profile(last, self.stroke()).point, self.run_out());
        let run_out = Segment { start: end * MILLIMETRES, end: run_out * MILLIMETRES, bulge: 0.0 };
        lower.push(BoundaryStretch::of_segment(run_out));
        let upper = mirrored(&lower);
        Ok(Some(exact(curves, &[lower, upper].concat())))
    }

    fn draw(&self, request: &Request) -> Result<Drawn, DrawError> {
        let part = Part::solid_plate(self.outline(request.fit)?);
        Ok(Drawn::of(vec![part]))
    }

    /// `samples` + 1 rows over the overrun, at equal steps of x with both ends.
    fn rows(&self, samples: u32) -> Vec<Row> {
        let stroke_mm = MILLIMETRES * self.stroke();
        (0..=samples).map(|i| self.row(stroke_mm * (f64::from(i) / f64::from(samples)))).collect()
    }

    fn row_on(&self, piece: usize, parameter: f64) -> Option<Row> {
        Some(self.row_at(MILLIMETRES * parameter, piece, parameter))
    }

    fn sections(&self, found: &DrawingEvidence<'_>) -> Vec<Section> {
        let part = found.drawn.and_then(|drawn| drawn.parts.first());
        let plate = PlateMeasures {
            length_mm: MILLIMETRES * (self.run_out().x - self.start().x),
            height_mm: MILLIMETRES * self.height,
            thinnest_mm: MILLIMETRES * self.thinnest,
            thinnest_at_x_mm: MILLIMETRES * self.thinnest_at,
            axis_distance_mm: MILLIMETRES * self.follower.axis_distance,
        };
        let mut weight = part.map(|part| part.weight(&self.machine)).unwrap_or_default();
        // A plate does not turn.
        weight.unbalance_g_mm = None;
        let cam = WedgeMeasures {
            roller_radius_mm: MILLIMETRES * self.data.roller_radius,
            max_lift_mm: MILLIMETRES * self.max_lift(),
            plate,
            weight,
        };
        // The corners of a plate's ends are intended.
        let reach = CORNER_REACH * found.tolerance_mm / MILLIMETRES;
        let outline = part.map(|part| {
            let measures = part.measures(found.tolerance_mm, |point| self.corner_within(point / MILLIMETRES, reach));
            measures.section()
        });
        let mut sections = vec![cam.section(), self.law().section()];
        sections.extend(reversal_of_bed(&self.machine));
        sections.extend(self.scatter());
        sections.extend([
            outline.unwrap_or_else(|| Section::new("outline", &())),
            Section::new("rolling", &found.rolled.first()),
            self.forces(found.rolled.first().map(|rolled| rolled.residual_max_n)).section(),
        ]);
        sections
    }

    fn mechanism(&self, drawn: &Drawn, samples: u32) -> MovingMechanism {
        mechanism::build(self, drawn, samples)
    }

    fn not_modelled(&self) -> Vec<&'static str> {
        [RIGID, not_modelled_of(&self.machine), mechanism::NOT_MODELLED].concat()
    }

    fn view(&self, drawn: &Drawn) -> Result<SheetView, OutlineError> {
        sheet::view(self, drawn)
    }
}
