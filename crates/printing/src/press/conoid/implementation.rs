//! The conoid as a [`Body`], for checks, drawings, tables and reports.

use super::{AllStrips, Conoid, KIND, SectionCut, checks, flank, mechanism, report, sheet};
use crate::press::checks::balanced::of_balance;
use crate::press::checks::contact_life;
use crate::press::columns::{self, BalanceRow};
use crate::press::motion::{Reversal, ReversalState};
use crate::press::picture::not_modelled_of;
use camgen_cams::body::figures::with_subject;
use camgen_cams::body::part::{self, Part, point_as_turned};
use camgen_cams::body::picture::RIGID;
use camgen_cams::body::{
    Body, Cut, DrawError, DrawingEvidence, Drawn, Figures, Kind, Layer, Request, Surface, mirrored,
};
use camgen_cams::check::Measures;
use camgen_cams::machine::{Machine, Rotation};
use camgen_cams::report::mechanism::MovingMechanism;
use camgen_cams::report::sheet::SheetView;
use camgen_cams::report::{Section, Shaft, Speeds};
use camgen_cams::table::{ForceRow, Row, SurfaceRow, TurnAngles, turned};
use camgen_kernel::geometry::boundary::{Boundary, BoundaryStretch};
use camgen_kernel::geometry::contour::{Contour, Vertex};
use camgen_kernel::geometry::{ChainTolerance, CurvePoint, Entity, MILLIMETRES, radius_of_curvature};
use camgen_kernel::motion::{Jet, Motion, Piece};
use camgen_kernel::numeric::parallel;
use camgen_kernel::profile::envelope::NoEnvelope;
use camgen_kernel::profile::outline::{self, Fit, MotionTolerance, Outline, OutlineError};
use camgen_kernel::profile::{Contact, boundary, extremes, followed};
use camgen_kernel::refusal::Refusal;
use camgen_kernel::text::{Length, Text, text};
use nalgebra::{Vector2, Vector3};
use std::f64::consts::TAU;

/// Share of the error of the heading that is seen where the arcs are compared with a cut.
const SEEN_AT_NODES: f64 = 0.99;

/// A normal that leans more than this along the axis, rad, makes sections that arcs can hardly follow: 89°.
const STEEPEST: f64 = 89.0 * std::f64::consts::PI / 180.0;

/// Where the surface folds along the axis a cut has no point.
const BROKEN: CurvePoint = CurvePoint {
    point: Vector2::new(f64::NAN, f64::NAN),
    tangent: Vector2::new(f64::NAN, f64::NAN),
    speed: f64::NAN,
    curvature: f64::NAN,
    curvature_slope: f64::NAN,
};

/// A cut offset from the exact one, and the tolerance of its heading and curvature as for a plane outline: the sphere's path
/// makes the same angle with the normal of the cut.
fn cut_within(frame: CurvePoint, angle: f64, motion: MotionTolerance) -> (CurvePoint, ChainTolerance) {
    let path = Vector2::new(libm::cos(angle), libm::sin(angle));
    (frame, outline::allowed(&frame, frame.outward().dot(&path), 1.0, motion))
}

impl Conoid {
    /// Whether the cut at z (m) is a circle over a piece: a dwell that does not lean along the axis.
    fn is_round(&self, index: usize, piece: &Piece, z: f64) -> bool {
        piece.dwell && self.lift(index, piece.start, z)[0][1] == 0.0
    }

    /// The cut at z (m) as an outline, of a clockwise cam.
    fn section(&self, z: f64, fit: Fit) -> Result<Outline, OutlineError> {
        let (shift, tolerance) = fit.band();
        let within_band = Fit { tolerance, ..fit };
        let asked = MotionTolerance { velocity: SEEN_AT_NODES * fit.motion.velocity, ..fit.motion };
        let pieces = self.pieces();
        if let Some(corner) = extremes::corners(self.plane_of(&self.slice(z))).first() {
            let what = "a crowned roller needs a smooth surface, and the sections of the conoid have a corner";
            let refusal = Refusal::new(what).at(format!("{:.3} deg", corner.at.to_degrees()));
            return Err(refusal.remedy("use transition.kind = \"run-up\" or \"blend\", and no buffer.lead").into());
        }
        outline::check_drawing_size(pieces, |piece, angle| self.cut_within_band(piece, angle, z, shift))?;
        let first = pieces.iter().position(|piece| piece.dwell).unwrap_or(0);
        let mut outline = Outline::empty();
        for (index, piece) in pieces.iter().enumerate().cycle().skip(first).take(pieces.len()) {
            // A dwell that does not lean along the axis is a circle; one that does is nearly one.
            let round = self.is_round(index, piece, z);
            for range in outline::parts(&Piece { dwell: round, ..*piece }, &[], Some(TAU)) {
                if round {
                    let start = self.cut_within_band(index, range.0, z, shift);
                    let bulge = libm::tan(0.25 * (range.1 - range.0));
                    outline.contour.vertices.push(Vertex::new(start.point, bulge));
                } else {
                    outline.add_piece(
                        |angle| cut_within(self.cut_within_band(index, angle, z, shift), angle, asked),
                        range,
                        &within_band,
                    )?;
                }
            }
        }
        Ok(outline.measured_from_exact(shift))
    }

    /// The cut at z (m), mm, offset inward by a shift, m.
    fn cut_within_band(&self, piece: usize, angle: f64, z: f64, shift: f64) -> CurvePoint {
        self.cut(piece, angle, z).map_or(BROKEN, |(frame, _)| frame.offset_inward(shift).scaled(MILLIMETRES))
    }

    /// Why a section cannot be laid where the surface is nearly across the axis: there its cuts jump from one side of the
    /// sphere to the other within a tiny cam angle.
    fn too_steep(&self) -> String {
        let lean = self.largest_lean();
        // The slope along the axis falls as the travel grows.
        let travel = self.data.axial_travel * libm::tan(lean) / libm::tan(STEEPEST);
        format!(
            "no section can be drawn, because the normal leans {:.3}° along the axis and no arcs follow a section where it leans more \
             than {:.0}°: conoid.axial_travel = \"{:.0} mm\" or a smaller cam.lever would reduce the lean",
            lean.to_degrees(),
            STEEPEST.to_degrees(),
            (MILLIMETRES * travel).ceil()
        )
    }

    /// The exact cut at z (m), mm, of a clockwise cam or mirrored for a counter-clockwise cam.
    pub(super) fn exact_cut(&self, z: f64, turned: bool) -> Boundary<'_> {
        let mut stretches: Vec<BoundaryStretch> = Vec::new();
        for (index, piece) in self.pieces().iter().enumerate() {
            let round = self.is_round(index, piece, z);
            stretches.extend(boundary::cut(index, &Piece { dwell: round, ..*piece }, piece.start, piece.end, false));
        }
        if turned {
            stretches = mirrored(&stretches);
        }
        Boundary::new(
            Box::new(move |piece, angle| {
                self.cut(piece, angle, z).map_or(BROKEN, |(frame, _)| frame.scaled(MILLIMETRES))
            }),
            &stretches,
        )
    }

    /// The exact path of the roller's centre with the cam at z (m), mm, of a clockwise cam.
    pub(super) fn exact_centre(&self, z: f64) -> Boundary<'_> {
        let slice = self.slice(z);
        let stretches = boundary::of_centre(self.plane_of(&slice));
        Boundary::new(
            Box::new(move |piece, angle| self.plane_of(&slice).touch(piece, angle).curve.scaled(MILLIMETRES)),
            &stretches,
        )
    }

    fn draw_parts(&self, fit: Fit) -> Result<Vec<Part>, OutlineError> {
        let parts = parallel::map(&self.sections_cut(), |cut| {
            let part = Part::turning(&self.machine, self.section(cut.z, fit)?);
            Ok(Part { rpm: Some(cut.rpm), z: cut.z, ..part })
        });
        parts.into_iter().collect()
    }

    fn row(&self, cut: SectionCut<'_>, at: &TurnAngles, lifts: &AllStrips) -> Row {
        let SectionCut { rpm, z, section } = cut;
        let (piece, angle) = section.locate(at.angle);
        let (state, lift) = (section.state(piece, angle), self.lift_of(lifts, z));
        let contact = self.contact_of(&lift, angle, z);
        let jet = Jet { s: lift[0][0], ds: lift[1][0], dds: lift[2][0], ddds: lift[3][0] };
        let in_plane = Contact::new(&self.follower, angle, jet);
        let cut = self.cut_of(lifts, angle, z).map(|(frame, ..)| frame);
        let force = self.path_force(section, rpm, piece, angle);
        let touch = point_as_turned(&self.machine, contact.point.xy() * MILLIMETRES);
        let nowhere = Vector2::new(f64::NAN, f64::NAN);
        let bed = columns::of_bed(Some(at.crank_deg), MILLIMETRES * state.overrun, MILLIMETRES * state.displacement);
        Row {
            cam_deg: Some(at.cam_deg),
            lift: Some(jet),
            curve: Some(point_as_turned(&self.machine, contact.centre.xy() * MILLIMETRES)),
            profile: Some(cut.map_or(nowhere, |frame| point_as_turned(&self.machine, frame.point * MILLIMETRES))),
            pressure_angle_deg: Some(in_plane.pressure_angle.to_degrees()),
            curve_radius: Some(radius_of_curvature(in_plane.curve.curvature)),
            profile_radius: Some(cut.map_or(f64::NAN, |frame| radius_of_curvature(frame.curvature))),
            force: Some(ForceRow { path: force, torque: force * lift[1][0], contact: None }),
            added: [bed, self.balance_row(section, &state).columns()].concat(),
            surface: Some(SurfaceRow {
                z: MILLIMETRES * z,
                rpm,
                lift_per_z: lift[0][1],
                contact: Vector3::new(touch.x, touch.y, MILLIMETRES * contact.point.z),
                axial_angle_deg: libm::asin(-contact.normal.z).to_degrees(),
                principal_radius: radius_of_curvature(self.curvatures_of(&lift).0),
                axial_force: -force * lift[0][1],
            }),
            ..Row::default()
        }
    }
}

impl Conoid {
    /// The force balance at the speed of a section.
    fn balance_row(&self, section: &Reversal, state: &ReversalState) -> BalanceRow {
        let law = &section.law().bottom_law;
        crate::press::load::balance_row(&self.cylinder, law, state)
    }
}

impl Body for Conoid {
    fn kind(&self) -> &'static Kind {
        &KIND
    }

    fn machine(&self) -> &Machine {
        &self.machine
    }

    fn speeds(&self) -> Speeds {
        Speeds::Several(self.sections_cut().iter().map(|cut| cut.rpm).collect())
    }

    fn shaft(&self) -> Option<Shaft> {
        self.press.bed.shaft("camshaft", self.lobes)
    }

    fn cuts(&self) -> Vec<Cut<'_>> {
        let mirrored: &[bool] = if self.machine.cam.rotation == Rotation::Clockwise { &[false] } else { &[true] };
        self.sections_cut()
            .into_iter()
            .map(|cut| Cut {
                name: "",
                layer: Layer::CamProfile,
                depth: None,
                z: cut.z,
                rpm: Some(cut.rpm),
                curves: None,
                mirrored,
                worst: None,
            })
            .collect()
    }

    fn surface(&self) -> Option<&dyn Surface> {
        Some(self)
    }

    fn along_axis(&self, z: f64) -> Option<Text> {
        (self.speeds.first() != self.speeds.last()).then(|| text!("at z = {}", Length::mm(MILLIMETRES * z).decimals(3)))
    }

    fn holes_within(&self, _outline: &Contour) -> Vec<Entity> {
        // Its sections are not balanced one by one.
        part::bore(&self.machine).into_iter().collect()
    }

    fn parameter_at(&self, point: Vector2<f64>) -> f64 {
        libm::atan2(point_as_turned(&self.machine, point).y, point.x)
    }

    fn largest_rates(&self) -> [f64; 2] {
        let rates = self.sections.iter().map(|section| followed::largest_rates(section));
        rates.fold([0.0; 2], |[v, a], [w, b]| [v.max(w), a.max(b)])
    }

    fn measures(&self, of: &mut Measures<'_>) {
        with_subject(self, |subject| {
            self.measured(of, subject);
            of.add(&checks::AXIAL_FORCE, |_| checks::axial_force(self, subject));
            of.add(&checks::AXIAL_REACH, |_| checks::axial_reach(self, subject));
            of.add(&checks::CYLINDER_CONTACT, |written| checks::cylinder_contact(self, written.tolerance_mm, subject));
            of.add(&checks::BETWEEN_SECTIONS, |_| checks::between_sections(self));
            of_balance(self, of, subject);
            of.add(&contact_life::CHECK, |_| contact_life::measure(self.contact_stress(), self.touching(), subject));
        });
    }

    /// The cut at z.
    fn boundary<'a>(&'a self, cut: &Cut<'a>) -> Result<Option<Boundary<'a>>, NoEnvelope> {
        Ok(Some(self.exact_cut(cut.z, cut.mirrored == [true])))
    }

    fn draw(&self, request: &Request) -> Result<Drawn, DrawError> {
        let parts = self.draw_parts(request.fit).map_err(|error| match error {
            OutlineError::Fit(_) | OutlineError::Undercut(_)
                if self.sharpest_smooth().value * self.roller.radius >= 1.0 =>
            {
                let why =
                    "the surface folds over itself: the roller is larger than the pitch surface's radius of curvature";
                DrawError::NoOutline(why.to_owned())
            }
            OutlineError::Fit(_) if self.largest_lean() > STEEPEST => DrawError::NoOutline(self.too_steep()),
            other => other.into(),
        })?;
        let tolerance = request.fit.tolerance_mm();
        let flank = request.flank.then(|| flank::flank(self, tolerance)).transpose()?;
        Ok(Drawn { flank, ..Drawn::of(parts) })
    }

    fn height(&self) -> Option<(f64, f64)> {
        let (low, high) = self.ends();
        Some((MILLIMETRES * low, MILLIMETRES * high))
    }

    /// `samples` rows for each speed, at 360 i/samples degrees.
    fn rows(&self, samples: u32) -> Vec<Row> {
        // What the sections do at an angle is the same for the rows of all of them.
        let indices: Vec<u32> = (0..samples).collect();
        let places: Vec<(TurnAngles, AllStrips)> = parallel::map(&indices, |i| {
            let at = turned(*i, samples, self.lobes);
            let (piece, angle) = self.sections.first().map_or((0, at.angle), |section| section.locate(at.angle));
            (at, self.all_lifts(piece, angle))
        });
        let rows: Vec<Vec<Row>> = parallel::map(&self.sections_cut(), |cut| {
            places.iter().map(|(at, lifts)| self.row(*cut, at, lifts)).collect()
        });
        rows.into_iter().flatten().collect()
    }

    fn sections(&self, found: &DrawingEvidence<'_>) -> Vec<Section> {
        report::sections(self, found)
    }

    fn mechanism(&self, drawn: &Drawn, samples: u32) -> MovingMechanism {
        mechanism::build(self, drawn, samples)
    }

    fn not_modelled(&self) -> Vec<&'static str> {
        [RIGID, not_modelled_of(&self.machine), mechanism::NOT_MODELLED].concat()
    }

    fn view(&self, drawn: &Drawn) -> Result<SheetView, OutlineError> {
        Ok(sheet::view(self, drawn))
    }
}
