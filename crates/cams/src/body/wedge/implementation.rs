//! The plate as a [`Body`], for checks, drawings, tables and reports.

use super::{WEDGE, Wedge, mechanism, report, sheet};
use crate::body::figures::with_subject;
use crate::body::part::Part;
use crate::body::{Body, Cut, DrawError, DrawingEvidence, Drawn, Figures, Kind, Request, exact};
use crate::check::Measures;
use crate::machine::Machine;
use crate::report::mechanism::MovingMechanism;
use crate::report::sheet::SheetView;
use crate::report::{Place, Section, Speeds};
use crate::table::{AddedColumn, Row};
use camgen_kernel::geometry::boundary::{Boundary, BoundaryStretch};
use camgen_kernel::geometry::contour::{Contour, Segment, Vertex};
use camgen_kernel::geometry::{MILLIMETRES, radius_of_curvature};
use camgen_kernel::motion::Motion;
use camgen_kernel::profile::boundary;
use camgen_kernel::profile::envelope::NoEnvelope;
use camgen_kernel::profile::outline::{self, Fit, Outline, OutlineError};
use camgen_kernel::refusal::Refusal;
use nalgebra::Vector2;

/// Readers drop shorter segments, mm.
const SHORTEST: f64 = 1e-6;

const TRAVEL: AddedColumn = AddedColumn { name: "x_mm", after: "cam_deg" };
const POSITION: AddedColumn = AddedColumn { name: "position_mm", after: "cam_deg" };
const LIFT: AddedColumn = AddedColumn { name: "lift_mm", after: "cam_deg" };
const VELOCITY: AddedColumn = AddedColumn { name: "velocity_mm_per_mm", after: "cam_deg" };
const ACCELERATION: AddedColumn = AddedColumn { name: "acceleration_mm_per_mm2", after: "cam_deg" };
const JERK: AddedColumn = AddedColumn { name: "jerk_mm_per_mm3", after: "cam_deg" };
const CONTACT_FORCE: AddedColumn = AddedColumn { name: "contact_force_n", after: "profile_curvature_radius_mm" };

impl Wedge {
    /// The plate as an outline: flank, run-out, end, back; the other end closes the loop.
    fn outline(&self, fit: Fit) -> Result<Outline, DrawError> {
        let (thinnest, at) = self.thinnest;
        if !(thinnest > 0.0) {
            let [thinnest, x, least] = [thinnest, at, self.height - thinnest].map(|length| MILLIMETRES * length);
            let refusal = Refusal::new(format!("the flanks of the plate would cross by {:.3} mm", -thinnest))
                .at(format!("x = {x:.3} mm"));
            return Err(DrawError::NoOutline(
                refusal.remedy(format!("cam.height must exceed {least:.3} mm")).to_string(),
            ));
        }
        let curves = self.curves();
        let (flank, shift) = outline::profile_within(curves, fit).map_err(|error| match error {
            OutlineError::Undercut(_) => DrawError::NoOutline(error.to_string()),
            OutlineError::Fit(_) | OutlineError::Part { .. } if self.least_radius().value <= curves.offset().abs() => {
                DrawError::NoOutline(error.to_string())
            }
            other => other.into(),
        })?;
        let mut vertices = flank.contour.vertices;
        let last = self.motion.pieces().len().saturating_sub(1);
        let contact = curves.contact(last, self.stroke().1).curve;
        let (outward, tangent) = (contact.outward(), contact.tangent);
        let end = contact.offset_inward(curves.offset() + shift).point * MILLIMETRES;
        // The flank offset from the exact one ends on the same end of the plate; a short run-out may end before that one does.
        let back = outward * shift - tangent * (shift * outward.x / tangent.x);
        let run_out = (self.run_out - back) * MILLIMETRES;
        let there = (run_out - end).dot(&tangent) > SHORTEST;
        let [_, _, _, far, near] = self.corners().map(|corner| corner * MILLIMETRES);
        let straight = std::iter::once(end).chain(there.then_some(run_out)).chain([far, near]);
        vertices.extend(straight.map(|point| Vertex::new(point, 0.0)));
        Ok(Outline {
            contour: Contour { vertices },
            deviation: flank.deviation,
            best_possible: flank.best_possible,
            best_for: flank.best_for,
            lead_in: None,
        })
    }

    /// A place of the travel in millimetres, as a row of the table.
    fn row(&self, x_mm: f64) -> Row {
        self.row_at(x_mm, self.motion.locate(x_mm / MILLIMETRES))
    }

    fn row_at(&self, x_mm: f64, (piece, x): (usize, f64)) -> Row {
        let contact = self.curves().contact(piece, x);
        let profile = contact.curve.offset_inward(self.curves().offset());
        let lift = contact.lift;
        let position = self.motion.origin().map(|origin| (&POSITION, MILLIMETRES * (origin + lift.s)));
        let rates = [
            (&LIFT, MILLIMETRES * lift.s.max(0.0)),
            (&VELOCITY, lift.ds),
            (&ACCELERATION, lift.dds / MILLIMETRES),
            (&JERK, lift.ddds / (MILLIMETRES * MILLIMETRES)),
        ];
        let force = self.pressing(lift.s).map(|force| (&CONTACT_FORCE, force / libm::cos(contact.pressure_angle)));
        Row {
            parameter: Some(x),
            at: Some((piece, x)),
            curve: Some(contact.curve.point * MILLIMETRES),
            profile: Some(profile.point * MILLIMETRES),
            pressure_angle_deg: Some(contact.pressure_angle.to_degrees()),
            curve_radius: Some(radius_of_curvature(contact.curve.curvature)),
            profile_radius: Some(radius_of_curvature(profile.curvature)),
            by_travel: true,
            added: std::iter::once((&TRAVEL, x_mm)).chain(position).chain(rates).chain(force).collect(),
            ..Row::default()
        }
    }
}

impl Body for Wedge {
    fn kind(&self) -> &'static Kind {
        &WEDGE
    }

    fn machine(&self) -> &Machine {
        &self.machine
    }

    fn speeds(&self) -> Speeds {
        Speeds::Any(())
    }

    fn cuts(&self) -> Vec<Cut<'_>> {
        vec![Cut::plane(self.curves(), &[false], &self.worst)]
    }

    fn place(&self, x: f64) -> Place {
        Place::at_overrun(x)
    }

    fn parameter_at(&self, point: Vector2<f64>) -> f64 {
        point.x
    }

    /// Those of its ends.
    fn corner_within(&self, point: Vector2<f64>, reach: f64) -> bool {
        let [start, _, run_out, far, near] = self.corners();
        [start, run_out, far, near].into_iter().any(|corner| (point - corner).norm() <= reach)
    }

    fn measures(&self, of: &mut Measures<'_>) {
        with_subject(self, |subject| self.measured(of, subject));
    }

    fn edges(&self) -> Vec<[Vector2<f64>; 2]> {
        let [start, end, run_out, far, near] = self.corners();
        vec![[end, run_out], [run_out, far], [far, near], [near, start]]
    }

    /// Flank, run-out, end and back; the other end closes the loop.
    fn boundary<'a>(&'a self, cut: &Cut<'a>) -> Result<Option<Boundary<'a>>, NoEnvelope> {
        let curves = self.curves();
        let mut all = boundary::stretches(curves, cut.is_undercut())?;
        let [_, end, run_out, far, near] = self.corners().map(|corner| corner * MILLIMETRES);
        for (start, end) in [(end, run_out), (run_out, far), (far, near)] {
            if (end - start).norm() > SHORTEST {
                all.push(BoundaryStretch::of_segment(Segment { start, end, bulge: 0.0 }));
            }
        }
        Ok(Some(exact(curves, &all)))
    }

    fn draw(&self, request: &Request) -> Result<Drawn, DrawError> {
        if request.cutter_radius.is_some() {
            let refusal = Refusal::new("the path of a cutter is drawn around cams that turn, not around a plate");
            return Err(refusal.remedy("leave the cutter out: the program runs along the profile with G41 or G42, and limits.cutter_radius checks that the cutter fits").into());
        }
        Ok(Drawn::of(vec![Part::solid_plate(self.outline(request.fit)?)]))
    }

    /// `samples` + 1 rows over the stroke, at equal steps of x with both ends.
    fn rows(&self, samples: u32) -> Vec<Row> {
        let (from, to) = self.stroke();
        let place = |i: u32| MILLIMETRES * (from + (to - from) * (f64::from(i) / f64::from(samples)));
        (0..=samples).map(|i| self.row(place(i))).collect()
    }

    fn row_on(&self, piece: usize, parameter: f64) -> Option<Row> {
        Some(self.row_at(MILLIMETRES * parameter, (piece, parameter)))
    }

    fn sections(&self, found: &DrawingEvidence<'_>) -> Vec<Section> {
        report::sections(self, found)
    }

    fn mechanism(&self, drawn: &Drawn, samples: u32) -> MovingMechanism {
        mechanism::of(self, drawn, samples)
    }

    fn not_modelled(&self) -> Vec<&'static str> {
        mechanism::not_modelled(self)
    }

    fn view(&self, drawn: &Drawn) -> Result<SheetView, OutlineError> {
        sheet::view(self, drawn)
    }
}
