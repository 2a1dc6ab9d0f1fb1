//! The conoid as a [`Body`]: what checks, drawings, tables and reports use of it.

use super::{AllStrips, Conoid, KIND, flank, mechanism, report, sheet};
use crate::body::balance::Balance;
use crate::body::part::{self, Part, point_as_turned};
use crate::body::picture::{RIGID, of_its_press};
use crate::body::{
    Body, DrawError, Drawn, Found, Kind, Request, broken_limit, mirrored, no_radius, passing, radius_of, stress,
};
use crate::geometry::boundary::{Boundary, Stretch};
use crate::geometry::contour::{Contour, Vertex};
use crate::geometry::{Allowed, CurvePoint, Entity, MILLIMETRES};
use crate::load::{self, RunUp};
use crate::machine::{Machine, Rotation};
use crate::motion::{Jet, Motion, Piece, Reversal, State};
use crate::numeric::parallel;
use crate::profile::envelope::NoEnvelope;
use crate::profile::outline::{self, Fit, MotionTolerance, Outline, OutlineError};
use crate::profile::size::rounded_up;
use crate::profile::{Contact, Curves, Worst, boundary, extremes, followed};
use crate::report::mechanism::Mechanism;
use crate::report::sheet::View;
use crate::report::{Section, Speeds};
use crate::table::{BalanceRow, BedRow, ForceRow, Row, SurfaceRow, Turned, turned};
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

/// A cut beside the exact one with what its heading and curvature may miss, as those of a plane outline: the sphere's path
/// makes the same angle with the normal of the cut.
fn cut_within(frame: CurvePoint, angle: f64, motion: MotionTolerance) -> (CurvePoint, Allowed) {
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
        let frame = |piece: usize, angle: f64| {
            self.cut(piece, angle, z).map_or(BROKEN, |(frame, _)| frame.offset_inward(shift).scaled(MILLIMETRES))
        };
        let pieces = self.pieces();
        if let Some(corner) = extremes::corners(self.plane_of(&self.slice(z))).first() {
            return Err(OutlineError::Corner { cam_deg: corner.at.to_degrees() });
        }
        outline::fits_a_drawing(pieces, frame)?;
        let first = pieces.iter().position(|piece| piece.dwell).unwrap_or(0);
        let mut outline = Outline::empty();
        for (index, piece) in pieces.iter().enumerate().cycle().skip(first).take(pieces.len()) {
            // A dwell that does not lean along the axis is a circle; one that does is nearly one.
            let round = self.is_round(index, piece, z);
            for range in outline::parts(&Piece { dwell: round, ..*piece }, &[], Some(TAU)) {
                if round {
                    let bulge = libm::tan(0.25 * (range.1 - range.0));
                    outline.contour.vertices.push(Vertex::new(frame(index, range.0).point, bulge));
                } else {
                    let within = |angle| cut_within(frame(index, angle), angle, asked);
                    outline.lay(within, range, &within_band)?;
                }
            }
        }
        Ok(outline.counted_from_exact(shift))
    }

    /// Why a section cannot be laid where the surface is nearly across the axis: there its cuts jump from one side of the
    /// sphere to the other within a hair of the cam angle.
    fn too_steep(&self) -> String {
        let lean = self.largest_lean();
        // The slope along the axis falls as the travel grows.
        let travel = self.data.axial_travel * libm::tan(lean) / libm::tan(STEEPEST);
        format!(
            "no section can be laid, since the normal leans {:.3}° along the axis and no arcs follow a section where it leans more \
             than {:.0}°: conoid.axial_travel = \"{:.0} mm\" would make it less, or a smaller cam.lever",
            lean.to_degrees(),
            STEEPEST.to_degrees(),
            (MILLIMETRES * travel).ceil()
        )
    }

    /// The exact cut at z (m), mm, of a clockwise cam or mirrored as that of one that turns counter-clockwise.
    pub(in crate::body) fn cut_at(&self, z: f64, turned: bool) -> Boundary<'_> {
        let cut = move |piece: usize, angle: f64| {
            self.cut(piece, angle, z).map_or(BROKEN, |(frame, _)| frame.scaled(MILLIMETRES))
        };
        let of_piece = |(index, piece): (usize, &Piece)| {
            let round = self.is_round(index, piece, z);
            boundary::cut(index, &Piece { dwell: round, ..*piece }, (piece.start, piece.end), false)
        };
        let stretches: Vec<Stretch> = self.pieces().iter().enumerate().flat_map(of_piece).collect();
        Boundary::new(Box::new(cut), &if turned { mirrored(&stretches) } else { stretches })
    }

    /// The exact path of the roller's centre with the cam at z (m), mm, of a clockwise cam.
    pub(in crate::body) fn centre_at(&self, z: f64) -> Boundary<'_> {
        let slice = self.slice(z);
        let stretches = boundary::of_centre(self.plane_of(&slice));
        let centre =
            move |piece: usize, angle: f64| self.plane_of(&slice).touch(piece, angle).curve.scaled(MILLIMETRES);
        Boundary::new(Box::new(centre), &stretches)
    }

    fn draw_parts(&self, fit: Fit) -> Result<Vec<Part>, OutlineError> {
        let part = |(rpm, z, _): &(f64, f64, &Reversal)| {
            let part = Part::turning(&self.machine, self.section(*z, fit)?);
            Ok(Part { rpm: Some(*rpm), z: *z, ..part })
        };
        parallel::map(&self.cuts(), part).into_iter().collect()
    }

    fn row(&self, (rpm, z, section): (f64, f64, &Reversal), (at, lifts): &(Turned, AllStrips)) -> Row {
        let (piece, angle) = section.locate(at.angle);
        let (state, lift) = (section.state(piece, angle), self.lift_of(lifts, z));
        let contact = self.contact_of(&lift, angle, z);
        let jet = Jet { s: lift[0][0], ds: lift[1][0], dds: lift[2][0], ddds: lift[3][0] };
        let in_plane = Contact::of(&self.follower, angle, jet);
        let cut = self.cut_of(lifts, angle, z).map(|(frame, ..)| frame);
        let force = self.path_force(section, rpm, piece, angle);
        let turned = |point: Vector2<f64>| point_as_turned(&self.machine, point * MILLIMETRES);
        let touch = turned(contact.point.xy());
        let nowhere = Vector2::new(f64::NAN, f64::NAN);
        Row {
            cam_deg: Some(at.cam_deg),
            lift: Some(jet),
            bed: Some(BedRow {
                crank_deg: Some(at.crank_deg),
                x: MILLIMETRES * state.overrun,
                dx: MILLIMETRES * state.displacement,
            }),
            curve: Some(turned(contact.centre.xy())),
            profile: Some(cut.map_or(nowhere, |frame| turned(frame.point))),
            pressure_angle_deg: Some(in_plane.pressure_angle.to_degrees()),
            curve_radius: Some(MILLIMETRES / in_plane.curve.curvature),
            profile_radius: Some(cut.map_or(f64::NAN, |frame| MILLIMETRES / frame.curvature)),
            force: Some(ForceRow { path: force, torque: force * lift[1][0], contact: None }),
            balance: Some(self.balance_row(section, &state)),
            surface: Some(SurfaceRow {
                z: MILLIMETRES * z,
                rpm,
                lift_per_z: lift[0][1],
                contact: Vector3::new(touch.x, touch.y, MILLIMETRES * contact.point.z),
                axial_angle_deg: libm::asin(-contact.normal.z).to_degrees(),
                principal_radius: MILLIMETRES / self.curvatures_of(&lift).0,
                axial_force: -force * lift[0][1],
            }),
            ..Row::default()
        }
    }
}

impl Conoid {
    /// The force balance at the speed of a section.
    fn balance_row(&self, section: &Reversal, state: &State) -> BalanceRow {
        let law = &section.law().bottom_law;
        load::balance_row(&self.cylinder, law, state)
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
        Speeds::Several(self.cuts().iter().map(|(rpm, ..)| *rpm).collect())
    }

    fn plane(&self) -> Option<Curves<'_>> {
        None
    }

    fn spatial(&self) -> Option<&Conoid> {
        Some(self)
    }

    fn along_axis(&self, z: f64) -> Option<String> {
        (self.speeds.first() != self.speeds.last()).then(|| format!("at z = {:.3} mm", MILLIMETRES * z))
    }

    fn holes_within(&self, _outline: &Contour) -> Vec<Entity> {
        // Its sections are not balanced one by one.
        part::bore(&self.machine).into_iter().collect()
    }

    fn parameter_at(&self, point: Vector2<f64>) -> f64 {
        libm::atan2(point_as_turned(&self.machine, point).y, point.x)
    }

    fn mirrored(&self) -> &'static [bool] {
        match self.machine.cam.rotation {
            Rotation::Clockwise => &[false],
            Rotation::CounterClockwise => &[true],
        }
    }

    /// The angle between the roller's path and the normal of the section, over every place where the roller may stand.
    fn pressure_angles(&self) -> [Worst; 2] {
        let largest = self.worst(|conoid, place| {
            let (height, slope) = conoid.height_and_slope(&place.partials);
            libm::atan2(slope, height).abs()
        });
        [largest, Worst::NONE]
    }

    /// By the principal curvatures of the pitch surface.
    fn least_radius(&self) -> Worst {
        let corner = |z: &f64| {
            let corners = extremes::corners(self.plane_of(&self.slice(*z)));
            corners.iter().find(|c| c.turn > 0.0).map(|c| Worst { value: 0.0, at: c.at, z: *z })
        };
        self.positions.iter().find_map(corner).unwrap_or_else(|| radius_of(self.sharpest_smooth()))
    }

    /// The largest ball that fits into the concave parts of the cam's surface.
    fn hollow(&self) -> Option<Worst> {
        let hollow = self.worst_of_metal(|conoid, partials| -conoid.curvatures_of(partials).1);
        (hollow.value > 0.0).then(|| Worst { value: 1.0 / hollow.value + self.roller.radius, ..hollow })
    }

    fn roller_radius(&self) -> Option<f64> {
        Some(self.roller.radius)
    }

    /// Metal between the bore and the nearest place of the surface.
    fn wall(&self) -> Option<(f64, Option<Worst>)> {
        let bore = self.machine.cam.bore_reach()?;
        let nearest = self.smallest_radius();
        Some((nearest.value - bore, Some(nearest)))
    }

    fn contact_force(&self, _: (usize, f64), _: &Contact) -> Option<f64> {
        None
    }

    /// Of the sphere of the roller on the surface, at the speed of each section.
    fn contact_stress(&self) -> Option<Worst> {
        let material = self.machine.cam.material?;
        let radius = self.roller.radius;
        // The cube of the pressure is smooth where the force vanishes.
        let cubed = self.worst_of_sections(|section, rpm, z, piece, angle| {
            let contact = self.contact(piece, angle, z);
            let path = contact.normal.x * libm::cos(angle) + contact.normal.y * libm::sin(angle);
            let force = self.path_force(section, rpm, piece, angle).max(0.0) / path;
            // The cam's own surface lies a roller's radius inside the pitch surface.
            let (first, second) = self.principal_curvatures(piece, angle, z);
            let inside = |curvature: f64| curvature / (1.0 - curvature * radius);
            let stress = stress::of_sphere(force, radius, (inside(first), inside(second)), material);
            stress * stress * stress
        });
        Some(Worst { value: libm::cbrt(cubed.value), ..cubed })
    }

    fn largest_lifting_force(&self) -> Worst {
        self.worst_of_sections(|section, rpm, _, piece, angle| -self.path_force(section, rpm, piece, angle))
    }

    fn unbalanced(&self, _: usize, _: f64, _: f64, _: Vector2<f64>) -> f64 {
        0.0
    }

    fn largest_rates(&self) -> [f64; 2] {
        let larger = |[v, a]: [f64; 2], [w, b]: [f64; 2]| [v.max(w), a.max(b)];
        self.sections.iter().map(|section| followed::largest_rates(section)).fold([0.0; 2], larger)
    }

    fn balance(&self) -> Option<Balance> {
        Some(self.forces_balanced())
    }

    fn residual_of_motion(&self) -> Worst {
        let left = self.left();
        Worst { value: left.force, at: left.angle, z: self.position(left.rpm) }
    }

    fn least_air(&self) -> Option<Worst> {
        Some(self.air())
    }

    fn run_up(&self) -> Option<RunUp> {
        self.ramp()
    }

    fn stress_remedies(&self, _: f64, limit: f64) -> Vec<String> {
        self.roller_for_stress(limit).into_iter().collect()
    }

    fn remedy(&self) -> Option<String> {
        let base = rounded_up(self.smallest_prime_radius? - self.roller.radius);
        let mut other = self.clone();
        other.resize(base + self.roller.radius);
        Some(if broken_limit(&other).is_none() { passing(base) } else { no_radius(None) })
    }

    /// The cut at z.
    fn boundary(&self, z: f64) -> Result<Option<Boundary<'_>>, NoEnvelope> {
        Ok(Some(self.cut_at(z, self.mirrored() == [true])))
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
            other => DrawError::Outline(other),
        })?;
        let tolerance = MILLIMETRES * request.fit.tolerance;
        let flank = request.flank.then(|| flank::flank(self, tolerance)).transpose()?;
        Ok(Drawn { parts, flank, cutter_path: None })
    }

    fn height(&self) -> Option<(f64, f64)> {
        let (low, high) = self.ends();
        Some((MILLIMETRES * low, MILLIMETRES * high))
    }

    /// `samples` rows for each speed, at 360 i/samples degrees.
    fn rows(&self, samples: u32) -> Vec<Row> {
        let at = |i: &u32| {
            let at = turned(*i, samples, self.machine.cam.lobes);
            let (piece, angle) = self.sections.first().map_or((0, at.angle), |section| section.locate(at.angle));
            (at, self.all_lifts(piece, angle))
        };
        // What the sections do at an angle is the same for the rows of all of them.
        let places: Vec<(Turned, AllStrips)> = parallel::map(&(0..samples).collect::<Vec<u32>>(), at);
        let rows =
            |cut: &(f64, f64, &Reversal)| -> Vec<Row> { places.iter().map(|place| self.row(*cut, place)).collect() };
        parallel::map(&self.cuts(), rows).into_iter().flatten().collect()
    }

    fn sections(&self, found: &Found<'_>) -> Vec<Section> {
        report::sections(self, found)
    }

    fn mechanism(&self, drawn: &Drawn, samples: u32) -> Mechanism {
        mechanism::of(self, drawn, samples)
    }

    fn not_modelled(&self) -> Vec<&'static str> {
        [RIGID, of_its_press(&self.machine), mechanism::NOT_MODELLED].concat()
    }

    fn view(&self, drawn: &Drawn) -> Result<View, OutlineError> {
        Ok(sheet::view(self, drawn))
    }
}
