//! The wedge cam of the press (a linear cam): the plate that rides on the bed, for a speed.

mod sheet;

use super::part::Part;
use super::{Body, DrawError, Drawn, Found, Kind, Request, largest, stress};
use crate::buffer::Cylinder;
use crate::follower::BellCrank;
use crate::geometry::MILLIMETRES;
use crate::geometry::contour::{Contour, Segment, Vertex};
use crate::load::air_law;
use crate::machine::{Machine, NoPress, TranslatingData};
use crate::motion::equation_18::{
    BottomMotion, EfficiencyModel, ExactOn, Mechanism, Solver, Trend, Way, WedgeMotionError,
};
use crate::motion::{Motion, WedgeMotion};
use crate::numeric::extremum;
use crate::profile::outline::{self, Fit, Outline, OutlineError};
use crate::profile::{Curves, Worst, envelope};
use crate::report::sheet::Sheet;
use crate::report::{
    AirLaw, Break, CamMeasures, Equation18, Forces, Place, PlateMeasures, Report, ResidualByWay, Section, Speeds,
};
use crate::table::{BedRow, PlateRow, Row};
use nalgebra::Vector2;
use std::sync::Arc;

/// The plate on the bed.
pub const KIND: Kind = Kind { command: "translating", noun: "translating cam" };

/// Absolute tolerance of Δx, m, when nothing else is asked for: a thousandth of a nanometre. The outline adds its own,
/// a million times larger.
pub const LAW_TOLERANCE: f64 = 1e-15;

/// Flat before the run-in and straight run-out after the stroke, as shares of the roller radius: room for the roller to
/// stand on, and for the contact not to end on an edge.
const FLAT_OVER_ROLLER: f64 = 1.0;
const RUN_OUT_OVER_ROLLER: f64 = 0.1;

/// What is nearer to an end of the plate than this is the end, m.
const END_WIDTH: f64 = 1e-4;

/// Whole millimetres a height that was not given is rounded up to, m.
const HEIGHT_STEP: f64 = 1e-3;

/// A cam plate for one speed.
#[derive(Debug, Clone)]
pub struct Wedge {
    machine: Arc<Machine>,
    data: TranslatingData,
    rpm: f64,
    /// Angular speed ω of the crank, rad/s.
    crank_speed: f64,
    cylinder: Cylinder,
    solver: Solver,
    /// Motion and follower of the lower flank; the upper one is its mirror image.
    motion: WedgeMotion,
    follower: BellCrank,
    /// Height of the plate, m.
    height: f64,
    /// Height where it is thinnest, m; not positive where the flanks would cross.
    thinnest: f64,
    /// Where it is thinnest, overrun in m.
    thinnest_at: f64,
}

/// Why there is no plate.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum WedgeError {
    /// The machine file does not describe one.
    #[error("the machine file has no [translating] table: a plate needs roller_arm, bottom_arm and delta")]
    NotDescribed,
    /// It describes no press.
    #[error(transparent)]
    NoPress(#[from] NoPress),
    /// (18) has no lead.
    #[error("equation (18) knows no lead: set buffer.lead to \"0 mm\" for a translating cam")]
    Lead,
    /// The motion.
    #[error(transparent)]
    Motion(#[from] WedgeMotionError),
}

impl Wedge {
    /// Solves (18) and sizes the plate.
    ///
    /// # Errors
    /// [`WedgeError`] when the machine has no plate or (18) no answer.
    pub fn solve(machine: &Machine, rpm: f64, solver: Solver, exact_on: ExactOn) -> Result<Self, WedgeError> {
        let (data, press) = (machine.translating.ok_or(WedgeError::NotDescribed)?, machine.press()?);
        if press.lead > 0.0 {
            return Err(WedgeError::Lead);
        }
        let bottom_law = press.bottom_law(rpm);
        let mechanism = Mechanism {
            bottom_law,
            bottom_arm: data.bottom_arm,
            arm_ratio: data.bottom_arm / data.roller_arm,
            delta: data.delta,
            friction_angle: data.friction_angle,
            efficiency: data.efficiency,
            model: data.efficiency_model,
            exact_on,
        };
        let flat = FLAT_OVER_ROLLER * data.roller_radius;
        let motion = WedgeMotion::new(mechanism, solver, machine.transition, flat)?;
        let follower = BellCrank {
            roller_arm: data.roller_arm,
            bottom_arm: data.bottom_arm,
            delta: data.delta,
            lowest: motion.lowest(),
            axis_distance: 0.0,
            roller_radius: data.roller_radius,
        };
        let mut plate = Self {
            machine: Arc::new(machine.clone()),
            data,
            rpm,
            crank_speed: press.bed.crank_speed(rpm),
            cylinder: press.cylinder(),
            solver,
            motion,
            follower,
            height: 0.0,
            thinnest: 0.0,
            thinnest_at: 0.0,
        };
        plate.place_axis();
        Ok(plate)
    }

    /// Puts the bed's axis where the plate gets its height, and finds where it is thinnest.
    fn place_axis(&mut self) {
        let up = |piece: usize, x: f64| -self.curves().profile(piece, x).point.y;
        let highest = largest(self.curves(), up);
        let lowest = largest(self.curves(), |piece, x| -up(piece, x));
        let run_out = -self.run_out().y;
        let high = highest.value.max(run_out);
        let (low, at) = if run_out < -lowest.value { (run_out, self.stroke()) } else { (-lowest.value, lowest.at) };
        self.height = self.data.plate_height.unwrap_or_else(|| {
            let least = self.machine.limits.wall.max(self.data.roller_radius);
            ((2.0 * (high - low) + least) / HEIGHT_STEP).ceil() * HEIGHT_STEP
        });
        self.follower.axis_distance = 0.5 * self.height - high;
        self.thinnest = self.height - 2.0 * (high - low);
        self.thinnest_at = at;
    }

    /// Motion and follower of the lower flank.
    #[must_use]
    pub fn curves(&self) -> Curves<'_> {
        Curves { motion: &self.motion, follower: &self.follower }
    }

    /// The motion.
    #[must_use]
    pub fn motion(&self) -> &WedgeMotion {
        &self.motion
    }

    /// Where the lower flank starts, m.
    #[must_use]
    pub fn start(&self) -> Vector2<f64> {
        self.curves().profile(0, self.motion.range().0).point
    }

    /// Where the straight run-out of the lower flank ends, m.
    #[must_use]
    pub fn run_out(&self) -> Vector2<f64> {
        let last = self.motion.pieces().len().saturating_sub(1);
        let end = self.curves().profile(last, self.stroke());
        end.point + end.tangent * (RUN_OUT_OVER_ROLLER * self.data.roller_radius)
    }

    /// The whole overrun r, m.
    #[must_use]
    pub fn stroke(&self) -> f64 {
        self.mechanism().bottom_law.stroke
    }

    /// The machine of (18).
    #[must_use]
    pub fn mechanism(&self) -> &Mechanism {
        self.motion.mechanism()
    }

    /// Largest lift, m.
    #[must_use]
    pub fn max_lift(&self) -> f64 {
        largest(self.curves(), |piece, x| self.motion.jet(piece, x).s).value
    }

    /// The Δx of largest size over the stroke: (x, Δx), both m.
    #[must_use]
    pub fn largest_displacement(&self) -> (f64, f64) {
        let motion = self.motion.motion();
        let size = |x: f64| motion.at(x, false)[0].abs();
        let worst = extremum::largest_without_slope(size, (0.0, self.stroke()), 256, extremum::TO_ROUNDING);
        (worst.at, motion.at(worst.at, false)[0])
    }

    /// Inertia force of the bed at its largest, N.
    #[must_use]
    pub fn inertia_max(&self) -> f64 {
        self.cylinder.largest_load(&self.mechanism().bottom_law)
    }

    /// Left side less right side of (18), N, on a way of the bed; 0 before the reversal.
    #[must_use]
    pub fn residual(&self, piece: usize, x: f64, way: Way) -> f64 {
        self.cylinder.unit_force() * self.motion.residual(piece, x, way)
    }

    /// Residual of largest size on a way of the bed, N, and the overrun where it is, m.
    #[must_use]
    pub fn residual_max(&self, way: Way) -> (f64, f64) {
        let worst = largest(self.curves(), |piece, x| self.residual(piece, x, way).abs());
        (worst.value, worst.at)
    }

    /// What a plain buffer with fixed bottom and column by (7) would leave at this speed, N.
    #[must_use]
    pub fn residual_fixed_bottom(&self) -> f64 {
        self.cylinder.residual_fixed_bottom(&self.mechanism().bottom_law)
    }

    /// Normal force of one roller on its flank on a way of the bed, N, equation (17); 0 before the reversal.
    #[must_use]
    pub fn roller_force(&self, piece: usize, x: f64, way: Way) -> f64 {
        if x <= 0.0 {
            return 0.0;
        }
        let bottom = self.motion.bottom(piece, x);
        0.5 * self.cylinder.unit_force()
            * self.mechanism().normal_force(self.motion.trend(piece, x), way, x, bottom.s, bottom.ds)
    }

    /// Largest of these on either way, N.
    #[must_use]
    pub fn roller_force_max(&self) -> f64 {
        largest(self.curves(), |piece, x| self.normal_force(piece, x)).value
    }

    /// The way on which the forces were to balance, or both.
    #[must_use]
    pub fn balanced_ways(&self) -> &'static [Way] {
        match self.mechanism().exact_on {
            ExactOn::Braking => &[Way::Braking],
            ExactOn::Return => &[Way::Return],
            ExactOn::Mean => &[Way::Braking, Way::Return],
        }
    }

    /// Normal force of a roller on its flank on the worse way of the bed, N.
    fn normal_force(&self, piece: usize, x: f64) -> f64 {
        let [braking, back] = [Way::Braking, Way::Return].map(|way| self.roller_force(piece, x, way));
        braking.max(back).max(0.0)
    }

    /// Force that presses a roller onto its flank along its path, N: the air's share by the lever, preload, and the inertia of
    /// what moves with the roller, whose path is l1 ψ and whose time is that of the bed, x'' = −ω² x, at constant speed before
    /// the reversal.
    fn path_force(&self, piece: usize, x: f64) -> f64 {
        let follower = &self.machine.follower;
        let bottom = self.motion.bottom(piece, x);
        let (arm, sine) = (self.data.bottom_arm, bottom.s / self.data.bottom_arm);
        let cosine = ((1.0 - sine) * (1.0 + sine)).sqrt();
        let first = bottom.ds / (arm * cosine);
        let second = (bottom.dds / arm + sine * first * first) / cosine;
        let omega = self.crank_speed;
        let (r, over) = (self.stroke(), x.max(0.0));
        let (speed_squared, slowing) = (omega * omega * (r - over) * (r + over), omega * omega * over);
        let inertia = follower.mass.unwrap_or(0.0) * self.data.roller_arm * (second * speed_squared - first * slowing);
        let air = if x > 0.0 { self.mechanism().air(x, bottom.s) } else { 0.0 };
        let by_air = 0.5 * self.cylinder.unit_force() * air * self.mechanism().arm_ratio * cosine;
        by_air + follower.preload.unwrap_or(0.0) + inertia
    }

    /// The plate as an outline: lower flank, straight run-out, end, the upper flank as its mirror image, other end.
    fn outline(&self, fit: Fit) -> Result<Outline, OutlineError> {
        let (shift, half) = fit.band();
        if !(self.thinnest > 0.0) {
            return Err(OutlineError::Thin {
                thinnest_mm: MILLIMETRES * self.thinnest,
                x_mm: MILLIMETRES * self.thinnest_at,
                least_mm: MILLIMETRES * (self.height - self.thinnest),
            });
        }
        let curves = self.curves();
        let distance = curves.offset() + shift;
        let flank = outline::parallel(curves, distance, half, &envelope::losses(curves)?)?.from_exact(shift);
        let mut lower = flank.contour.vertices;
        let last = self.motion.pieces().len().saturating_sub(1);
        let contact = curves.contact(last, self.stroke()).curve;
        let end = contact.offset_inward(distance).point * MILLIMETRES;
        let run_out = self.run_out() * MILLIMETRES - contact.outward() * (MILLIMETRES * shift);
        lower.extend([end, run_out].map(|point| Vertex { point, bulge: 0.0 }));
        // Mirrored and run the other way a segment keeps its bulge, which then belongs to its other end.
        let bulges = lower.iter().map(|vertex| vertex.bulge);
        let bulges: Vec<f64> = std::iter::once(0.0).chain(bulges).collect();
        let mirror =
            |(vertex, bulge): (&Vertex, f64)| Vertex { point: Vector2::new(vertex.point.x, -vertex.point.y), bulge };
        let upper: Vec<Vertex> = lower.iter().zip(bulges).rev().map(mirror).collect();
        lower.extend(upper);
        Ok(Outline {
            contour: Contour { vertices: lower },
            deviation: flank.deviation,
            best_possible: 2.0 * flank.best_possible,
        })
    }

    /// The pitch curve of the lower flank, for the eye.
    fn pitch_curve(&self) -> Result<Vec<Segment>, OutlineError> {
        let mut vertices = outline::pitch(self.curves())?.contour.vertices;
        let last = self.motion.pieces().len().saturating_sub(1);
        let end = self.curves().contact(last, self.stroke()).curve.point * MILLIMETRES;
        vertices.push(Vertex { point: end, bulge: 0.0 });
        let pairs = vertices.iter().zip(vertices.iter().skip(1));
        Ok(pairs.map(|(a, b)| Segment { start: a.point, end: b.point, bulge: a.bulge }).collect())
    }

    fn law(&self) -> AirLaw {
        let mechanism = self.mechanism();
        AirLaw {
            start_slope: self.motion.motion().at(0.0, false)[1],
            velocity_jump_mm_per_rad: MILLIMETRES * self.stroke() * self.motion.slope_jump(),
            equation_18: Some(self.solved()),
            ..air_law(&self.cylinder, &mechanism.bottom_law, self.largest_displacement())
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
        let ((braking, _), (back, back_at)) = (self.residual_max(Way::Braking), self.residual_max(Way::Return));
        let inertia = self.inertia_max();
        let of_law = if self.balanced_ways() == [Way::Return] { back } else { braking };
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
            plate: Some(PlateRow {
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

    fn parameter_at(&self, point: Vector2<f64>) -> f64 {
        point.x
    }

    fn ends_at(&self, point: Vector2<f64>) -> bool {
        point.x < self.start().x + END_WIDTH || point.x > self.run_out().x - END_WIDTH
    }

    fn mirrored(&self) -> &'static [bool] {
        &[false, true]
    }

    fn roller_radius(&self) -> Option<f64> {
        Some(self.data.roller_radius)
    }

    fn contact_force(&self, piece: usize, x: f64) -> Option<f64> {
        Some(self.normal_force(piece, x))
    }

    fn contact_stress(&self) -> Option<Worst> {
        stress::of_lines(self, self.curves(), &self.machine)
    }

    fn least_closing_force(&self) -> Option<Worst> {
        let follower = &self.machine.follower;
        if follower.mass.is_none() && follower.preload.is_none() {
            return None;
        }
        let least = largest(self.curves(), |piece, x| -self.path_force(piece, x));
        Some(Worst { value: -least.value, ..least })
    }

    /// On the ways that were to balance. The roller moves on its arm l1, the bottom on l2; the slope is the flank's where
    /// the roller touches, dΔx/dx = C σ with tan α of the normal.
    fn unbalanced(&self, piece: usize, x: f64, moved: f64, normal: Vector2<f64>) -> f64 {
        if x <= 0.0 {
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

    fn draw(&self, request: &Request) -> Result<Drawn, DrawError> {
        let outline = self.outline(request.fit).map_err(|error| match error {
            OutlineError::Undercut(_) | OutlineError::Thin { .. } => DrawError::NoOutline(error.to_string()),
            other => DrawError::Outline(other),
        })?;
        Ok(Drawn { parts: vec![Part::solid_plate(outline)], flank: None, cutter_path: None })
    }

    /// `samples` + 1 rows over the overrun, at x = r i/samples with both ends.
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
            max_lift_mm: MILLIMETRES * self.max_lift(),
            plate: Some(plate),
            weight,
            ..CamMeasures::default()
        };
        // The corners of a plate's ends are meant.
        let outline =
            part.map(|part| part.measures(found.tolerance_mm, |point| self.ends_at(point / MILLIMETRES)).section());
        vec![
            cam.section(),
            self.law().section(),
            outline.unwrap_or_else(|| Section::new("outline", &())),
            Section::new("rolling", &found.rolled),
            self.forces(found.rolled.map(|rolled| rolled.residual_max_n)).section(),
        ]
    }

    fn sheet(&self, drawn: &Drawn, report: &Report) -> Result<Sheet, OutlineError> {
        sheet::sheet(self, drawn, report)
    }
}

#[cfg(test)]
mod tests;
