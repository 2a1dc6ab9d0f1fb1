//! A globoid cam: a hollow round body whose grooves move a turret with rollers on, by so many rollers in a turn. It is the cam of an indexer.
//!
//! The axes of cam and turret cross at right angles at a distance. The axes of the rollers point away from that of the turret, and each roller passes through a
//! groove from one end of the cam to the other. Both flanks follow from its motion exactly (`contact`). Outside and floor are parts of two tori about the
//! turret, the ends are cones about it.

mod contact;
mod flank;
mod forces;
mod implementation;
pub mod measures;
mod mechanism;
mod report;
mod rolling;
mod sheet;
mod swept;
mod tables;

use super::Kind;
use super::swept::refuse_jumps;
use crate::machine::{Machine, Rotation, TurretData};
use camgen_kernel::document::cams;
use camgen_kernel::follower::Element;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::{Jet, Motion};
use camgen_kernel::numeric::extremum::{self, Extremum};
use camgen_kernel::numeric::root;
use camgen_kernel::profile::Worst;
use camgen_kernel::refusal::Refusal;
use contact::{FlankPoint, TurretLine};
use std::f64::consts::TAU;
use std::sync::Arc;

/// The globoid of any motion that indexes.
pub const GLOBOID: Kind = Kind { command: cams::MAKE, noun: "globoid cam", keys: cams::GLOBOID };

/// Cells of a piece in which figures are searched, and golden sections to a place.
const CELLS: u32 = 32;
const SECTIONS: u32 = 50;
/// The turret rests, or does not turn back, where its rate over its index is below this, 1/rad.
const LEVEL: f64 = 1e-9;
/// Largest angle of a conical end that is chosen, rad: beyond, it is nearly a cylinder.
const LARGEST_END: f64 = 75.0 * std::f64::consts::PI / 180.0;
/// A resting roller's flank stays this far off the end, rad.
const FREE: f64 = 0.2 * std::f64::consts::PI / 180.0;

/// A globoid cam.
#[derive(Debug, Clone)]
pub struct Globoid {
    machine: Arc<Machine>,
    motion: Arc<dyn Motion>,
    turret: TurretData,
    /// Radius of a roller, m.
    roller: f64,
    /// Of the flanks above and below from the centre line of a roller, m.
    distances: [f64; 2],
    /// Distances from the turret's axis, m: of the outside, of the inner end of a roller's reach, and of the floor.
    outside: f64,
    reached: f64,
    floor: f64,
    /// Angle about the turret at which the first roller stands at the start of the motion, rad.
    first: f64,
    /// Angle about the turret from the middle of the cam to its ends, rad.
    end_angle: f64,
    /// Speed of the cam, rpm, where it is known.
    rpm: Option<f64>,
}

/// A flank of a groove.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Flank {
    /// Its metal lies above the roller.
    Upper,
    /// Its metal lies below.
    Lower,
}

impl Flank {
    const BOTH: [Self; 2] = [Self::Upper, Self::Lower];
}

/// An end of the cam.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum End {
    /// Where rollers enter.
    Bottom,
    /// Where they leave.
    Top,
}

impl End {
    fn sign(self) -> f64 {
        if self == Self::Top { 1.0 } else { -1.0 }
    }
}

impl Globoid {
    /// The globoid of a motion, at a speed of the cam (rpm) where it is known.
    ///
    /// # Errors
    /// [`Refusal`] when the turret turns back, its velocity jumps, or the cam has no room for its grooves.
    pub fn of(machine: &Machine, motion: &Arc<dyn Motion>, rpm: Option<f64>) -> Result<Self, Refusal> {
        let track = machine.cam.track;
        let Element::Roller { radius } = machine.follower.shape.element() else { return Err(needs_a_turret()) };
        let turret = track.turret.ok_or_else(needs_a_turret)?;
        let depth = track.groove_depth.ok_or_else(|| {
            Refusal::new("a globoid needs the depth of its grooves").remedy("give cam.groove_depth, e.g. \"12 mm\"")
        })?;
        let reach = track.barrel.roller_height.unwrap_or(depth);
        let inside = track.clearance * track.clearance_share;
        let outside = turret.arm - 0.5 * reach;
        let mut found = Self {
            machine: Arc::new(machine.clone()),
            motion: Arc::clone(motion),
            turret,
            roller: radius,
            distances: [radius + track.clearance - inside, radius + inside],
            outside,
            reached: outside + reach,
            floor: outside + depth,
            first: 0.0,
            end_angle: turret.end_angle.unwrap_or(f64::NAN),
            rpm,
        };
        found.first = found.start();
        refuse_jumps(&**motion)?;
        found.refuse_motion()?;
        found.refuse_size(depth, reach)?;
        if turret.end_angle.is_none() {
            found.end_angle = found.chosen_end()?;
        }
        found.refuse_ends()?;
        found.refuse_what_leaves()?;
        Ok(found)
    }

    /// This globoid with its turret at another distance, m; `None` where no globoid is possible there.
    fn at_distance(&self, distance: f64) -> Option<Self> {
        let mut machine = Machine::clone(&self.machine);
        machine.cam.track.turret = Some(TurretData { distance, ..self.turret });
        Self::of(&machine, &self.motion, self.rpm).ok()
    }

    /// Where the first roller stands at the start, less the lift there: a rib or a groove is in the middle.
    fn start(&self) -> f64 {
        let at_rest = if self.turret.rests_in_groove { 0.0 } else { -0.5 * self.turret.pitch() };
        at_rest - self.motion.jet(0, self.motion.range().0).s
    }

    /// The refusal of a turret that turns back.
    fn refuse_motion(&self) -> Result<(), Refusal> {
        let slowest = self.motion_extreme(|jet| -jet.ds);
        let small = LEVEL * self.turret.index();
        if slowest.value > small {
            let what = "the turret turns back, and a roller would enter its groove twice";
            let remedy = "give a motion that only moves on";
            return Err(Refusal::new(what).at(format!("{:.3} deg", slowest.at.to_degrees())).remedy(remedy));
        }
        Ok(())
    }

    /// The refusal of measures that leave no room.
    fn refuse_size(&self, depth: f64, reach: f64) -> Result<(), Refusal> {
        let [deep, reached] = [depth, reach].map(|length| MILLIMETRES * length);
        if !(self.outside > 0.0) {
            let what =
                format!("rollers that reach {reached:.3} mm into the grooves would begin behind the turret's axis");
            return Err(Refusal::new(what).remedy("give a larger cam.arm or a smaller cam.roller_height"));
        }
        if self.floor >= self.turret.distance {
            let what = format!("grooves of {deep:.3} mm reach the axis of the cam");
            return Err(Refusal::new(what)
                .remedy("give a larger cam.turret_distance, or a smaller cam.arm or cam.groove_depth"));
        }
        let widest = self.distances[0].max(self.distances[1]);
        let between = 2.0 * self.outside * libm::sin(0.5 * self.turret.pitch());
        let both = self.distances[0] + self.distances[1];
        if widest >= self.outside || both >= between {
            let [between, both] = [between, both].map(|length| MILLIMETRES * length);
            let what =
                format!("grooves {both:.3} mm wide leave no rib between rollers {between:.3} mm apart on the outside");
            return Err(Refusal::new(what).remedy("give smaller or fewer rollers, or a larger cam.arm"));
        }
        Ok(())
    }

    /// The turret angles at which the first roller rests, rad, as they come in a turn.
    fn rests(&self) -> Vec<f64> {
        let small = LEVEL * self.turret.index();
        let pieces = self.motion.pieces().iter().enumerate();
        let ends = pieces.flat_map(|(index, piece)| [(index, piece.start), (index, piece.end)]);
        let jets = ends.map(|(index, angle)| self.motion.jet(index, angle)).filter(|jet| jet.ds.abs() <= small);
        let mut found: Vec<f64> = jets.map(|jet| self.first + jet.s).collect();
        found.dedup_by(|a, b| (*a - *b).abs() < FREE);
        found
    }

    /// How near (rad) a resting flank comes to an end at an angle, as a positive number where none lies across it.
    fn freedom(&self, end_angle: f64) -> f64 {
        let pitch = self.turret.pitch();
        let mut least = f64::INFINITY;
        for rest in self.rests() {
            for (distance, sign) in [(self.distances[0], 1.0), (self.distances[1], -1.0)] {
                // In the plane through the axis: from where a flank leaves the outside to where it leaves the floor.
                let [outer, floor] = [self.outside, self.floor].map(|from| rest + sign * libm::asin(distance / from));
                for end in [end_angle, -end_angle] {
                    let apart = |angle: f64| {
                        let turns = ((end - angle) / pitch).round();
                        end - angle - turns * pitch
                    };
                    let (a, b) = (apart(outer), apart(floor));
                    let across = (a < 0.0) != (b < 0.0) && (a - b).abs() < 0.5 * pitch;
                    least = least.min(if across { 0.0 } else { a.abs().min(b.abs()) });
                }
            }
        }
        least
    }

    /// The angle of the ends in the middle between two resting rollers, rad.
    fn chosen_end(&self) -> Result<f64, Refusal> {
        let pitch = self.turret.pitch();
        let shares = if self.turret.rests_in_groove { [1.5, 0.5, 1.0] } else { [1.0, 1.5, 0.75] };
        let usual = shares.map(|share| share * pitch);
        let candidates = usual.into_iter().filter(|angle| *angle <= LARGEST_END).chain([LARGEST_END]);
        let free: Vec<f64> = candidates.filter(|angle| self.freedom(*angle) > FREE).collect();
        // Of those that keep a roller on each flank throughout.
        let meshes = |angle: &&f64| Self { end_angle: **angle, ..self.clone() }.least_touching().0 >= 1.0;
        free.iter().find(meshes).or(free.first()).copied().ok_or_else(|| {
            Refusal::new("at every customary angle of the ends a resting roller lies across an end")
                .remedy("give cam.end_angle, smaller rollers, or a dwell elsewhere")
        })
    }

    /// The refusal of ends across which a roller rests.
    fn refuse_ends(&self) -> Result<(), Refusal> {
        if self.freedom(self.end_angle) > FREE {
            return Ok(());
        }
        let refusal = Refusal::new(format!(
            "the flank of a resting roller lies across the end of the cam at {:.3} deg about the turret",
            self.end_angle.to_degrees()
        ));
        Err(match self.chosen_end() {
            Ok(angle) => refusal.remedy(format!("give cam.end_angle = \"{:.3} deg\", or \"auto\"", angle.to_degrees())),
            Err(_) => refusal.remedy("give another cam.end_angle"),
        })
    }

    /// The refusal of flanks that do not reach from the floor to the outside.
    fn refuse_what_leaves(&self) -> Result<(), Refusal> {
        for (piece, angle) in self.places() {
            for roller in self.rollers() {
                let line = self.line((piece, angle, 0.0), f64::from(roller));
                if line.angle[0].abs() > self.end_angle {
                    continue;
                }
                let known =
                    |from: f64| Flank::BOTH.iter().all(|flank| line.at_distance(self.signed(*flank), from).is_some());
                if !(known(self.floor) && known(self.outside)) {
                    let what = "a flank of a groove does not reach from its floor to the outside: the rollers are too large for the cam";
                    return Err(Refusal::new(what)
                        .at(format!("{:.3} deg", angle.to_degrees()))
                        .remedy("give a larger cam.turret_distance or smaller rollers"));
                }
            }
        }
        Ok(())
    }

    /// Places of all pieces, a few to each.
    fn places(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        let of = |(index, piece): (usize, &camgen_kernel::motion::Piece)| {
            let (start, end) = (piece.start, piece.end);
            (0..=CELLS).map(move |i| (index, start + (end - start) * f64::from(i) / f64::from(CELLS)))
        };
        self.motion.pieces().iter().enumerate().flat_map(of)
    }

    /// Numbers of rollers, the first being 0 and the next behind it 1, that may touch the cam during the turn of the motion.
    fn rollers(&self) -> std::ops::RangeInclusive<i32> {
        let pitch = self.turret.pitch();
        #[expect(clippy::cast_possible_truncation, reason = "a few rollers")]
        let count = |angle: f64| (angle / pitch).ceil() as i32;
        let reach = self.end_angle + 0.5 * pitch;
        -count(reach)..=count(reach + self.turret.index())
    }

    /// The centre line of a roller at a place: piece, cam angle in it, and turns beyond it.
    fn line(&self, (piece, angle, turns): (usize, f64, f64), roller: f64) -> TurretLine {
        let jet = self.motion.jet(piece, angle);
        let moved = turns * self.turret.index() - roller * self.turret.pitch();
        TurretLine { distance: self.turret.distance, angle: [self.first + jet.s + moved, jet.ds, jet.dds] }
    }

    /// The centre line of a roller at a cam angle of any turn.
    fn line_at(&self, angle: f64, roller: f64) -> TurretLine {
        let (piece, inside) = self.motion.locate(angle);
        self.line((piece, inside, ((angle - inside) / TAU).round()), roller)
    }

    /// The largest of a value of the motion.
    fn motion_extreme(&self, value: impl Fn(&Jet) -> f64) -> Worst {
        let of = |(index, piece): (usize, &camgen_kernel::motion::Piece)| {
            let at = |angle: f64| value(&self.motion.jet(index, angle));
            extremum::largest_without_slope(at, (piece.start, piece.end), CELLS, SECTIONS)
        };
        let found =
            self.motion.pieces().iter().enumerate().map(of).reduce(|a, b| if b.value > a.value { b } else { a });
        found.map_or(Worst::NONE, |Extremum { value, at, .. }| Worst { value, at, z: 0.0 })
    }

    /// The largest of a value of the centre lines of all rollers that touch the cam.
    fn largest(&self, value: impl Fn(&TurretLine) -> f64 + Sync) -> Worst {
        let reach = self.end_angle + libm::asin(self.distances[0].max(self.distances[1]) / self.outside);
        let of_roller = |roller: &i32| {
            let of = |(index, piece): (usize, &camgen_kernel::motion::Piece)| {
                let at = |angle: f64| {
                    let line = self.line((index, angle, 0.0), f64::from(*roller));
                    if line.angle[0].abs() <= reach { value(&line) } else { f64::NEG_INFINITY }
                };
                extremum::largest_without_slope(at, (piece.start, piece.end), CELLS, SECTIONS)
            };
            let pieces = self.motion.pieces().iter().enumerate();
            pieces.map(of).reduce(|a, b| if b.value > a.value { b } else { a })
        };
        let rollers: Vec<i32> = self.rollers().collect();
        let found = camgen_kernel::numeric::parallel::map(&rollers, of_roller);
        let largest = found.into_iter().flatten().reduce(|a, b| if b.value > a.value { b } else { a });
        largest.map_or(Worst::NONE, |Extremum { value, at, .. }| Worst { value, at, z: 0.0 })
    }

    /// Signed distance of a flank from the centre line, m: positive above.
    fn signed(&self, flank: Flank) -> f64 {
        match flank {
            Flank::Upper => self.distances[0],
            Flank::Lower => -self.distances[1],
        }
    }

    /// A flank of a roller's groove at a distance from the turret's axis and a cam angle of any turn.
    fn edge(&self, flank: Flank, from_turret: f64, (angle, roller): (f64, f64)) -> Option<FlankPoint> {
        self.line_at(angle, roller).at_distance(self.signed(flank), from_turret)
    }

    /// The cam angle at which the flank of a roller passes an end of the cam at a distance from the turret's axis; `None` where it does not.
    fn passes(&self, flank: Flank, end: End, (from_turret, roller): (f64, f64)) -> Option<f64> {
        let due = end.sign() * self.end_angle;
        let off = |angle: f64| {
            let found = self.edge(flank, from_turret, (angle, roller));
            found.map_or(f64::NAN, |found| found.about_turret(self.turret.distance) - due)
        };
        // Which turn of the cam brings the roller there, and between which joints of the motion.
        let spread = self.signed(flank).signum() * libm::asin(self.signed(flank).abs() / from_turret);
        let target = due - spread - self.first + roller * self.turret.pitch();
        let turn = (target / self.turret.index()).floor();
        for turns in [turn, turn - 1.0, turn + 1.0] {
            for piece in self.motion.pieces().iter().filter(|piece| !piece.dwell) {
                let (low, high) = (piece.start + turns * TAU, piece.end + turns * TAU);
                if off(low) < 0.0 && off(high) >= 0.0 {
                    return root::bracketed(off, low, high, 0.0).ok();
                }
            }
        }
        None
    }

    /// Distances from the turret's axis between which a roller touches the flanks, m.
    fn touched(&self) -> [f64; 2] {
        [self.outside, self.reached]
    }

    /// Largest pressure angle, rad, anywhere along the rollers that touch.
    fn pressure_angle(&self) -> Worst {
        self.largest(|line| {
            self.touched()
                .map(|v| line.point(v).slope)
                .into_iter()
                .map(|(sin, cos)| libm::atan2(sin, cos))
                .fold(0.0, f64::max)
        })
    }

    /// Smallest distance from the centre line at which a flank self-intersects, m, over the grooves' depth: taken between the points at which the flank
    /// itself meets the outside and the floor, even if the centre line meets them beyond the ends of the cam.
    fn least_fold(&self) -> Worst {
        let sharpest = self.largest(|line| {
            let of = |flank: Flank, from_turret: f64| {
                let distance = self.signed(flank);
                let found = line.at_distance(distance, from_turret);
                line.folds_at(&found.map_or_else(|| line.point(from_turret), |found| found.line), distance.signum())
            };
            let folds = Flank::BOTH.map(|flank| of(flank, self.outside).min(of(flank, self.floor)));
            folds.into_iter().map(f64::recip).fold(0.0, f64::max)
        });
        Worst { value: sharpest.value.recip(), ..sharpest }
    }

    /// 1 where the drawing is that of a cam that turns clockwise, −1 where it is mirrored.
    fn sense(&self) -> f64 {
        if self.is_clockwise() { 1.0 } else { -1.0 }
    }

    fn is_clockwise(&self) -> bool {
        self.machine.cam.rotation == Rotation::Clockwise
    }

    /// Radius and height of a rim of an end, m: on the outside or on the floor.
    fn rim(&self, from_turret: f64) -> (f64, f64) {
        let (sin, cos) = libm::sincos(self.end_angle);
        (self.turret.distance - from_turret * cos, from_turret * sin)
    }

    /// Angular speed of the cam, rad/s.
    fn speed(&self) -> Option<f64> {
        self.rpm.map(|rpm| rpm * TAU / 60.0)
    }
}

fn needs_a_turret() -> Refusal {
    Refusal::new("a globoid needs a turret with rollers")
        .remedy("give [follower.roller] with its radius, cam.turret_distance, cam.arm and cam.rollers")
}

#[cfg(test)]
mod tests;
