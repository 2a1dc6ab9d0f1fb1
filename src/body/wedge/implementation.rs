//! The plate on the bed as a [`Body`]: what checks, drawings, tables and reports use of it.

use super::{KIND, Wedge, mechanism, sheet};
use crate::body::balance::Balance;
use crate::body::part::Part;
use crate::body::picture::{RIGID, of_its_press};
use crate::body::{
    Body, CORNER_REACH, DrawError, Drawn, Found, Kind, Request, WorstPlaces, exact, largest, mirrored, reversal_of_bed,
    stress,
};
use crate::geometry::MILLIMETRES;
use crate::geometry::boundary::{Boundary, Stretch};
use crate::geometry::contour::{Contour, Edge, Segment, Vertex};
use crate::load::{RunUp, air_law, balance_of, closed_at};
use crate::machine::Machine;
use crate::motion::equation_18::{BottomMotion, EfficiencyModel, ExactOn, Solver, Trend, Way};
use crate::motion::{Jet, Motion};
use crate::profile::envelope::NoEnvelope;
use crate::profile::outline::{self, Fit, Outline, OutlineError};
use crate::profile::{Contact, Curves, Worst, boundary};
use crate::report::mechanism::Mechanism;
use crate::report::sheet::View;
use crate::report::{
    AirLaw, Break, CamMeasures, Equation18, Forces, Place, PlateMeasures, ResidualByWay, Section, Speeds,
};
use crate::table::{BalanceRow, BedRow, PlateRow, Row};
use nalgebra::Vector2;

/// Readers drop shorter segments, mm.
const SHORTEST: f64 = 1e-6;

impl Wedge {
    /// The plate as an outline: lower flank, straight run-out, end, the upper flank as its mirror image, other end.
    fn outline(&self, fit: Fit) -> Result<Outline, OutlineError> {
        if !(self.thinnest > 0.0) {
            return Err(OutlineError::Thin {
                thinnest_mm: MILLIMETRES * self.thinnest,
                x_mm: MILLIMETRES * self.thinnest_at,
                least_mm: MILLIMETRES * (self.height - self.thinnest),
            });
        }
        let curves = self.curves();
        let (flank, shift) = outline::profile_within(curves, fit)?;
        let mut lower = flank.contour.vertices;
        let last = self.motion.pieces().len().saturating_sub(1);
        let contact = curves.contact(last, self.stroke()).curve;
        let (outward, tangent) = (contact.outward(), contact.tangent);
        let end = contact.offset_inward(curves.offset() + shift).point * MILLIMETRES;
        // The flank beside the exact one ends on the same end of the plate; a short run-out may end before that one does.
        let back = outward * shift - tangent * (shift * outward.x / tangent.x);
        let run_out = self.run_out() * MILLIMETRES - back * MILLIMETRES;
        let there = (run_out - end).dot(&tangent) > SHORTEST;
        lower.extend(std::iter::once(end).chain(there.then_some(run_out)).map(|point| Vertex::new(point, 0.0)));
        // The edges of the flank, its end left out, and their mirror images run the other way.
        let last = lower.last().map(|vertex| vertex.point);
        let flank_edges: Vec<Edge> = Contour { vertices: lower }.edges().collect();
        let own = flank_edges.len().saturating_sub(1);
        let first = flank_edges.first().map(Edge::start);
        let flip = |point: Vector2<f64>| Vector2::new(point.x, -point.y);
        let mut vertices = Contour::of(flank_edges.iter().take(own).copied()).vertices;
        vertices.extend(last.map(|point| Vertex::new(point, 0.0)));
        vertices.extend(Contour::of(flank_edges.iter().take(own).rev().map(Edge::mirrored_about_x)).vertices);
        vertices.extend(first.map(|point| Vertex::new(flip(point), 0.0)));
        Ok(Outline {
            contour: Contour { vertices },
            deviation: flank.deviation,
            best_possible: 2.0 * flank.best_possible,
            best_for: flank.best_for.map(|best| 2.0 * best),
        })
    }

    /// The pitch curve of the lower flank, for viewing.
    pub(super) fn pitch_curve(&self) -> Result<Vec<Segment>, OutlineError> {
        let mut vertices = outline::pitch(self.curves())?.contour.vertices;
        let last = self.motion.pieces().len().saturating_sub(1);
        let end = self.curves().contact(last, self.stroke()).curve.point * MILLIMETRES;
        vertices.push(Vertex::new(end, 0.0));
        let pairs = vertices.iter().zip(vertices.iter().skip(1));
        // A pitch curve is laid as arcs.
        let segment = |(a, b): (&Vertex, &Vertex)| Some(Segment { start: a.point, end: b.point, bulge: a.bulge()? });
        Ok(pairs.filter_map(segment).collect())
    }

    fn law(&self) -> AirLaw {
        let mechanism = self.mechanism();
        AirLaw {
            start_slope: self.motion.motion().at(0.0, false)[1],
            velocity_jump_mm_per_rad: MILLIMETRES * self.stroke() * self.motion.slope_jump(),
            column_closed_at_crank_deg: closed_at(self.machine.transition),
            equation_18: Some(self.solved()),
            ..air_law(&self.cylinder, mechanism.bottom_law.by_crank(), self.largest_displacement())
        }
    }

    fn solved(&self) -> Equation18 {
        let motion = self.motion.motion();
        let (solver, tolerance_mm, stations) = match self.solver {
            Solver::Ode { tolerance } => ("ode", Some(MILLIMETRES * tolerance), None),
            Solver::Paper { stations } => ("paper", None, Some(stations)),
        };
        let then = |trend: Trend| match trend {
            Trend::Rising => "rising",
            Trend::Falling => "falling",
            Trend::Stuck => "stuck",
        };
        let model = match self.mechanism().model {
            EfficiencyModel::Consistent => "consistent",
            EfficiencyModel::Printed => "printed",
        };
        let exact_on = match self.mechanism().exact_on {
            ExactOn::Braking => "braking",
            ExactOn::Return => "return",
            ExactOn::Mean => "mean",
        };
        Equation18 {
            solver: solver.into(),
            tolerance_mm,
            stations,
            steps: match motion {
                BottomMotion::Ode(solution) => Some(solution.steps()),
                BottomMotion::Paper(_) => None,
            },
            efficiency_model: model.into(),
            balance: exact_on.into(),
            breaks: motion
                .breaks()
                .iter()
                .map(|b| Break { x_mm: MILLIMETRES * b.x, then: then(b.then).into() })
                .collect(),
        }
    }

    fn forces(&self, rolled: Option<f64>) -> Forces {
        let [braking, back] = [Way::Braking, Way::Return].map(|way| self.residual_max(way));
        let inertia = self.inertia_max();
        let back_at = back.at;
        let (braking, back) = (braking.value, back.value);
        let of_law = match self.mechanism().exact_on {
            ExactOn::Braking => braking,
            ExactOn::Return => back,
            ExactOn::Mean => braking.max(back),
        };
        let residual_max_n = rolled.unwrap_or(of_law);
        Forces {
            inertia_max_n: inertia,
            residual_max_n,
            residual_share: residual_max_n / inertia,
            residual_fixed_bottom_max_n: self.residual_fixed_bottom(),
            by_way: Some(ResidualByWay {
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

    /// A place of the stroke in millimetres, as a row of the table; points of the upper flank.
    fn row(&self, x_mm: f64) -> Row {
        let (piece, x) = self.motion.locate(x_mm / MILLIMETRES);
        let bottom = self.motion.bottom(piece, x);
        let contact = self.curves().contact(piece, x);
        let profile = contact.curve.offset_inward(self.data.roller_radius);
        let upper = |point: Vector2<f64>| Vector2::new(MILLIMETRES * point.x, -MILLIMETRES * point.y);
        Row {
            bed: Some(BedRow { crank_deg: None, x: x_mm, dx: MILLIMETRES * bottom.s }),
            curve: Some(upper(contact.curve.point)),
            profile: Some(upper(profile.point)),
            pressure_angle_deg: Some(contact.pressure_angle.to_degrees()),
            curve_radius: Some(MILLIMETRES / contact.curve.curvature),
            profile_radius: Some(MILLIMETRES / profile.curvature),
            balance: Some(self.balance_row(x, bottom.s)),
            plate: Some(PlateRow {
                lift: self.by_crank(x, contact.lift),
                psi_deg: self.mechanism().psi(bottom.s).to_degrees(),
                alpha_deg: self.mechanism().slope_angle(bottom.s, bottom.ds).to_degrees(),
                slope: bottom.ds,
                roller_force: self.roller_force(piece, x, Way::Braking),
                residual_return: self.residual(piece, x, Way::Return),
                residual_braking: self.residual(piece, x, Way::Braking),
            }),
            ..Row::default()
        }
    }
}

impl Wedge {
    /// Inertia and air; in (18) the plate takes part in the balance, whose residuals stand in the plate's own columns.
    fn balance_row(&self, x: f64, bottom: f64) -> BalanceRow {
        let law = &self.mechanism().bottom_law;
        let ratio = if x < 0.0 { 1.0 } else { 1.0 + self.mechanism().air(x, bottom) };
        let over = x.max(0.0);
        let inertia = self.cylinder.unit_force() * law.loading() * law.deceleration(over);
        let balance = balance_of(&self.cylinder, x >= 0.0, (inertia, law.air_of_fixed_bottom(over)), ratio);
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

    fn plane(&self) -> Option<Curves<'_>> {
        Some(self.curves())
    }

    fn place(&self, x: f64) -> Place {
        Place::at_overrun(x)
    }

    fn shaft_speed(&self) -> Option<f64> {
        Some(self.crank_speed)
    }

    fn parameter_at(&self, point: Vector2<f64>) -> f64 {
        point.x
    }

    /// Those of its two straight ends.
    fn corner_within(&self, point: Vector2<f64>, reach: f64) -> bool {
        // The upper flank is the mirror image of the lower.
        let from = |corner: Vector2<f64>| libm::hypot(point.x - corner.x, point.y.abs() - corner.y.abs());
        [self.start(), self.run_out()].into_iter().any(|corner| from(corner) <= reach)
    }

    fn mirrored(&self) -> &'static [bool] {
        &[false, true]
    }

    fn worst_places(&self) -> Option<&WorstPlaces> {
        Some(&self.worst)
    }

    fn contact_force(&self, (piece, x): (usize, f64), _: &Contact) -> Option<f64> {
        Some(self.normal_force(piece, x))
    }

    fn contact_stress(&self) -> Option<Worst> {
        stress::of_lines(self, (self.curves(), &self.acting()), &self.machine)
    }

    fn largest_lifting_force(&self) -> Worst {
        self.largest_force(|piece, x| -self.path_force(piece, x))
    }

    /// In the directions in which the forces are to balance. The roller moves on its arm l1, the bottom on l2; the slope is
    /// that of the flank where the roller touches, dΔx/dx = C σ with tan α of the normal.
    fn unbalanced(&self, piece: usize, x: f64, moved: f64, normal: Vector2<f64>) -> f64 {
        if x < 0.0 {
            return 0.0;
        }
        let law = self.motion.bottom(piece, x);
        let mechanism = self.mechanism();
        let sine = law.s / self.data.bottom_arm;
        let bottom = law.s + moved * mechanism.arm_ratio * ((1.0 - sine) * (1.0 + sine)).sqrt();
        let theta = self.data.delta + mechanism.psi(bottom);
        // Out of the lower flank the normal is (−sin α, −cos α).
        let (sin_alpha, cos_alpha) = (-normal.x, -normal.y);
        let beyond = libm::sin(theta) * cos_alpha - libm::cos(theta) * sin_alpha;
        let sigma = sin_alpha / beyond;
        let cos_psi = libm::cos(theta - self.data.delta);
        let (side, slope) = (self.motion.trend(piece, x), mechanism.arm_ratio * cos_psi * sigma);
        let of = |way: &Way| (self.cylinder.unit_force() * mechanism.residual_on(side, x, bottom, slope, *way)).abs();
        self.balanced_ways().iter().map(of).fold(0.0, f64::max)
    }

    fn balance(&self) -> Option<Balance> {
        let mean = self.mechanism().exact_on == ExactOn::Mean;
        Some(Balance { inertia: self.inertia_max(), without_cam: self.residual_fixed_bottom(), mean })
    }

    fn residual_of_motion(&self) -> Worst {
        let of = |way: &Way| self.residual_max(*way);
        self.balanced_ways().iter().map(of).fold(Worst::NONE, Worst::or_larger)
    }

    fn residual_unbalanced_way(&self) -> Option<Worst> {
        self.other_way().map(|way| self.residual_max(way))
    }

    fn remedies_unbalanced_way(&self) -> Vec<String> {
        self.worth_while()
    }

    fn least_air(&self) -> Option<Worst> {
        Some(self.air())
    }

    fn run_up(&self) -> Option<RunUp> {
        self.ramp()
    }

    fn stress_remedies(&self, largest: f64, limit: f64) -> Vec<String> {
        stress::thickness_for(&self.machine, largest, limit).into_iter().collect()
    }

    fn wall(&self) -> Option<(f64, Option<Worst>)> {
        Some((self.thinnest, None))
    }

    fn roller_clearance(&self) -> Option<Worst> {
        let away = |piece: usize, x: f64| self.curves().contact(piece, x).curve.point.y;
        let nearest = largest(self.curves(), away);
        Some(Worst { value: 2.0 * (-nearest.value - self.data.roller_radius), ..nearest })
    }

    fn edges(&self) -> Vec<[Vector2<f64>; 2]> {
        let (start, run_out) = (self.start(), self.run_out());
        let end = self.curves().profile(self.motion.pieces().len().saturating_sub(1), self.stroke()).point;
        let mirror = |p: Vector2<f64>| Vector2::new(p.x, -p.y);
        vec![[start, mirror(start)], [run_out, mirror(run_out)], [end, run_out], [mirror(end), mirror(run_out)]]
    }

    /// Lower flank, run-out, end, the upper flank as the mirror image of the lower; the other end closes the loop.
    fn boundary(&self, _z: f64) -> Result<Option<Boundary<'_>>, NoEnvelope> {
        let curves = self.curves();
        let mut lower = boundary::stretches(curves, self.least_radius().value <= curves.offset())?;
        let last = self.motion.pieces().len().saturating_sub(1);
        let (end, run_out) = (curves.profile(last, self.stroke()).point, self.run_out());
        let run_out = Segment { start: end * MILLIMETRES, end: run_out * MILLIMETRES, bulge: 0.0 };
        lower.push(Stretch::of_segment(run_out));
        let upper = mirrored(&lower);
        Ok(Some(exact(curves, &[lower, upper].concat())))
    }

    fn draw(&self, request: &Request) -> Result<Drawn, DrawError> {
        let outline = self.outline(request.fit).map_err(|error| match error {
            OutlineError::Undercut(_) | OutlineError::Thin { .. } => DrawError::NoOutline(error.to_string()),
            other => DrawError::Outline(other),
        })?;
        Ok(Drawn { parts: vec![Part::solid_plate(outline)], flank: None, cutter_path: None })
    }

    /// `samples` + 1 rows over the overrun, at equal steps of x with both ends.
    fn rows(&self, samples: u32) -> Vec<Row> {
        let place = |i: u32| MILLIMETRES * self.stroke() * (f64::from(i) / f64::from(samples));
        (0..=samples).map(|i| self.row(place(i))).collect()
    }

    fn sections(&self, found: &Found<'_>) -> Vec<Section> {
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
        let cam = CamMeasures {
            roller_radius_mm: Some(MILLIMETRES * self.data.roller_radius),
            max_lift_mm: Some(MILLIMETRES * self.max_lift()),
            plate: Some(plate),
            weight,
            ..CamMeasures::default()
        };
        // The corners of a plate's ends are intended.
        let reach = CORNER_REACH * found.tolerance_mm / MILLIMETRES;
        let corner = |point: Vector2<f64>| self.corner_within(point / MILLIMETRES, reach);
        let outline = part.map(|part| part.measures(found.tolerance_mm, corner).section());
        let mut sections = vec![cam.section(), self.law().section()];
        sections.extend(reversal_of_bed(&self.machine));
        sections.extend([
            outline.unwrap_or_else(|| Section::new("outline", &())),
            Section::new("rolling", &found.rolled),
            self.forces(found.rolled.map(|rolled| rolled.residual_max_n)).section(),
        ]);
        sections
    }

    fn mechanism(&self, drawn: &Drawn, samples: u32) -> Mechanism {
        mechanism::of(self, drawn, samples)
    }

    fn not_modelled(&self) -> Vec<&'static str> {
        [RIGID, of_its_press(&self.machine), mechanism::NOT_MODELLED].concat()
    }

    fn view(&self, drawn: &Drawn) -> Result<View, OutlineError> {
        sheet::view(self, drawn)
    }
}
