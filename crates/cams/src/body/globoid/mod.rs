//! A globoid cam: a hollow round body whose grooves move a turret with rollers on, by so many rollers in a turn. It is the cam of an indexer.
//!
//! The axes of cam and turret cross at right angles at a distance. The axes of the rollers point away from that of the turret, and each roller passes through a
//! groove from one end of the cam to the other. Both flanks follow from its motion exactly (`contact`). Outside and floor are parts of two tori about the
//! turret, the ends are cones about it.

mod contact;
mod drawing;
mod flank;
mod implementation;
pub mod measures;
mod mechanism;
mod report;
mod rolling;
mod sheet;
mod swept;
mod tables;

use super::Kind;
use super::swept::{FlankSide, SweptGroove, largest_of_motion};
use crate::machine::{Machine, TurretData};
use camgen_kernel::document::cams;
use camgen_kernel::follower::Element;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::{Jet, Motion};
use camgen_kernel::numeric::root;
use camgen_kernel::refusal::Refusal;
use contact::{FlankPoint, TurretLine};
use std::f64::consts::TAU;
use std::sync::Arc;

/// The globoid of any motion that indexes.
pub const GLOBOID: Kind = Kind { command: cams::MAKE, noun: "globoid cam", keys: cams::GLOBOID };

/// The turret rests, or does not turn back, where its rate over its index is below this, 1/rad.
const LEVEL: f64 = 1e-9;
/// Largest angle of a conical end that is chosen, rad: beyond, it is nearly a cylinder.
const LARGEST_END: f64 = 75.0 * std::f64::consts::PI / 180.0;
/// A resting roller's flank stays this far off the end, rad.
const FREE: f64 = 0.2 * std::f64::consts::PI / 180.0;

/// A globoid cam.
#[derive(Debug, Clone)]
pub struct Globoid {
    groove: SweptGroove,
    turret: TurretData,
    /// Distances from the turret's axis, m: of the outside, of the inner end of a roller's reach, and of the floor.
    outside: f64,
    reached: f64,
    floor: f64,
    /// Angle about the turret at which the first roller stands at the start of the motion, rad.
    first: f64,
    /// Angle about the turret from the middle of the cam to its ends, rad.
    end_angle: f64,
}

/// An end of the cam.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum End {
    /// Where rollers enter.
    Bottom,
    /// Where they leave.
    Top,
}

/// A curve of a groove: a flank of it at a distance from the turret's axis, m.
#[derive(Debug, Clone, Copy)]
struct FlankCurve {
    flank: FlankSide,
    /// The number of the roller that runs there.
    roller: f64,
    from_turret: f64,
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
        let outside = turret.arm - 0.5 * reach;
        let mut found = Self {
            groove: SweptGroove::new(machine, motion, rpm, radius),
            turret,
            outside,
            reached: outside + reach,
            floor: outside + depth,
            first: 0.0,
            end_angle: turret.end_angle.unwrap_or(f64::NAN),
        };
        found.first = found.start();
        found.groove.refuse_jumps()?;
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
        let mut machine = Machine::clone(&self.groove.machine);
        machine.cam.track.turret = Some(TurretData { distance, ..self.turret });
        Self::of(&machine, &self.groove.motion, self.groove.rpm).ok()
    }

    /// Where the first roller stands at the start, less the lift there: a rib or a groove is in the middle.
    fn start(&self) -> f64 {
        let at_rest = if self.turret.rests_in_groove { 0.0 } else { -0.5 * self.turret.pitch() };
        at_rest - self.groove.motion.jet(0, self.groove.motion.range().0).s
    }

    /// The refusal of a turret that turns back.
    fn refuse_motion(&self) -> Result<(), Refusal> {
        let slowest = largest_of_motion(&self.groove, |jet| -jet.ds);
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
        let widest = self.groove.farther();
        let between = 2.0 * self.outside * libm::sin(0.5 * self.turret.pitch());
        let both = self.groove.distances[0] + self.groove.distances[1];
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
        let pieces = self.groove.motion.pieces().iter().enumerate();
        let ends = pieces.flat_map(|(index, piece)| [(index, piece.start), (index, piece.end)]);
        let jets = ends.map(|(index, angle)| self.groove.motion.jet(index, angle)).filter(|jet| jet.ds.abs() <= small);
        let mut found: Vec<f64> = jets.map(|jet| self.first + jet.s).collect();
        found.dedup_by(|a, b| (*a - *b).abs() < FREE);
        found
    }

    /// How near (rad) a resting flank comes to an end at an angle, as a positive number where none lies across it.
    fn freedom(&self, end_angle: f64) -> f64 {
        let pitch = self.turret.pitch();
        let mut least = f64::INFINITY;
        for rest in self.rests() {
            for (distance, sign) in [(self.groove.distances[0], 1.0), (self.groove.distances[1], -1.0)] {
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
        for (piece, angle) in self.groove.places() {
            for roller in self.passing_rollers() {
                let line = self.line_in(piece, angle, 0.0, f64::from(roller));
                if line.angle[0].abs() > self.end_angle {
                    continue;
                }
                let known = |from: f64| {
                    FlankSide::BOTH.iter().all(|flank| line.at_distance(self.groove.signed(*flank), from).is_some())
                };
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

    /// Numbers of rollers, the first being 0 and the next behind it 1, that may touch the cam during the turn of the motion.
    fn passing_rollers(&self) -> std::ops::RangeInclusive<i32> {
        let pitch = self.turret.pitch();
        #[expect(clippy::cast_possible_truncation, reason = "a few rollers")]
        let count = |angle: f64| (angle / pitch).ceil() as i32;
        let reach = self.end_angle + 0.5 * pitch;
        -count(reach)..=count(reach + self.turret.index())
    }

    /// The centre line of a roller at a place: piece, cam angle in it, and turns beyond it.
    fn line_in(&self, piece: usize, angle: f64, turns: f64, roller: f64) -> TurretLine {
        self.line_at_lift(
            &self.groove.motion.jet(piece, angle),
            turns * self.turret.index() - roller * self.turret.pitch(),
        )
    }

    /// The centre line of a roller at a lift, moved by an angle from the first one in the first turn.
    fn line_at_lift(&self, lift: &Jet, moved: f64) -> TurretLine {
        TurretLine { distance: self.turret.distance, angle: [self.first + lift.s + moved, lift.ds, lift.dds] }
    }

    /// The centre line of a roller at a cam angle of any turn.
    fn line_at(&self, angle: f64, roller: f64) -> TurretLine {
        let (piece, inside) = self.groove.motion.locate(angle);
        self.line_in(piece, inside, ((angle - inside) / TAU).round(), roller)
    }

    /// A flank of a roller's groove at a distance from the turret's axis and a cam angle of any turn.
    fn edge(&self, curve: FlankCurve, angle: f64) -> Option<FlankPoint> {
        self.line_at(angle, curve.roller).at_distance(self.groove.signed(curve.flank), curve.from_turret)
    }

    /// The cam angle at which the flank of a roller passes an end of the cam at a distance from the turret's axis; `None` where it does not.
    fn passes(&self, curve: FlankCurve, end: End) -> Option<f64> {
        let FlankCurve { flank, roller, from_turret } = curve;
        let due = end.sign() * self.end_angle;
        let off = |angle: f64| {
            let found = self.edge(curve, angle);
            found.map_or(f64::NAN, |found| found.about_turret(self.turret.distance) - due)
        };
        // Which turn of the cam brings the roller there, and between which joints of the motion.
        let spread = self.groove.signed(flank).signum() * libm::asin(self.groove.signed(flank).abs() / from_turret);
        let target = due - spread - self.first + roller * self.turret.pitch();
        let turn = (target / self.turret.index()).floor();
        for turns in [turn, turn - 1.0, turn + 1.0] {
            for piece in self.groove.motion.pieces().iter().filter(|piece| !piece.dwell) {
                let (low, high) = (piece.start + turns * TAU, piece.end + turns * TAU);
                if off(low) < 0.0 && off(high) >= 0.0 {
                    return root::bracketed(off, low, high, 0.0).ok();
                }
            }
        }
        None
    }

    /// Radius and height of a rim of an end, m: on the outside or on the floor.
    fn rim(&self, from_turret: f64) -> (f64, f64) {
        let (sin, cos) = libm::sincos(self.end_angle);
        (self.turret.distance - from_turret * cos, from_turret * sin)
    }
}

fn needs_a_turret() -> Refusal {
    Refusal::new("a globoid needs a turret with rollers")
        .remedy("give [follower.roller] with its radius, cam.turret_distance, cam.arm and cam.rollers")
}

#[cfg(test)]
mod tests;
