//! What every swept cam has: a motion, rollers, and flanks at a distance from their centre lines.

use super::flanks::FlankSide;
use crate::body::part;
use crate::machine::{Machine, Rotation};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::motion::Motion;
use camgen_kernel::refusal::Refusal;
use camgen_kernel::units;
use std::sync::Arc;

/// Cells of a piece in which figures are searched.
pub(crate) const CELLS: u32 = 32;
/// Rounding of a diameter that was typed.
const ROUNDING: f64 = 1e-12;

/// The grooves of a swept cam.
#[derive(Debug, Clone)]
pub(crate) struct SweptGroove {
    pub(crate) machine: Arc<Machine>,
    pub(crate) motion: Arc<dyn Motion>,
    /// Radius of a roller, m.
    pub(crate) roller: f64,
    /// Of the flanks above and below from the centre line of a roller, m.
    pub(crate) distances: [f64; 2],
    /// Speed of the cam, rpm, where it is known.
    pub(crate) rpm: Option<f64>,
}

/// The passes of a tool through a groove, each along a flank or in the middle between both.
pub(crate) struct ToolPasses {
    /// Radius of the tool, m.
    pub(crate) radius: f64,
    pub(crate) flanks: &'static [Option<FlankSide>],
}

impl SweptGroove {
    /// The grooves for rollers of a radius, m, with the clearance of a machine.
    pub(crate) fn new(machine: &Machine, motion: &Arc<dyn Motion>, rpm: Option<f64>, roller: f64) -> Self {
        let track = machine.cam.track;
        let inside = track.clearance * track.clearance_share;
        Self {
            machine: Arc::new(machine.clone()),
            motion: Arc::clone(motion),
            roller,
            distances: [roller + track.clearance - inside, roller + inside],
            rpm,
        }
    }

    /// The refusal of a motion whose velocity jumps: a groove has no corners.
    ///
    /// # Errors
    /// [`Refusal`] with the cam angle of a jump.
    pub(crate) fn refuse_jumps(&self) -> Result<(), Refusal> {
        let pieces = self.motion.pieces();
        let after = pieces.iter().enumerate().cycle().skip(1);
        for ((index, piece), (next, start)) in pieces.iter().enumerate().zip(after) {
            let [before, behind] = [self.motion.jet(index, piece.end), self.motion.jet(next, start.start)];
            let scale = before.ds.abs().max(behind.ds.abs()).max(1e-3);
            if (before.ds - behind.ds).abs() > 1e-9 * scale {
                let what = "the velocity of the follower jumps, and a groove has no corners";
                let remedy = "give other states or laws of the segments that meet there";
                return Err(Refusal::new(what).at(format!("{:.3} deg", piece.end.to_degrees())).remedy(remedy));
            }
        }
        Ok(())
    }

    /// Places of all pieces, a few to each: the piece and the cam angle.
    pub(crate) fn places(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.motion.pieces().iter().enumerate().flat_map(|(index, piece)| {
            let (start, end) = (piece.start, piece.end);
            (0..=CELLS).map(move |i| (index, start + (end - start) * f64::from(i) / f64::from(CELLS)))
        })
    }

    /// Signed distance of a flank from the centre line, m: positive above.
    pub(crate) fn signed(&self, flank: FlankSide) -> f64 {
        match flank {
            FlankSide::Upper => self.distances[0],
            FlankSide::Lower => -self.distances[1],
        }
    }

    /// Distance of the farther flank, m.
    pub(crate) fn farther(&self) -> f64 {
        self.distances[0].max(self.distances[1])
    }

    /// Width of the groove, m.
    pub(crate) fn width(&self) -> f64 {
        self.distances.iter().sum()
    }

    /// Radius of a tool as wide as the groove, m.
    pub(crate) fn widest_tool(&self) -> f64 {
        0.5 * self.width()
    }

    /// The passes of a tool of a radius, m: one in the middle of the groove if it fills it, which is meant where none is given, else one along either flank.
    pub(crate) fn passes(&self, tool: Option<f64>) -> ToolPasses {
        let half = self.widest_tool();
        match tool.filter(|tool| *tool < half * (1.0 - ROUNDING)) {
            Some(radius) => ToolPasses { radius, flanks: &[Some(FlankSide::Upper), Some(FlankSide::Lower)] },
            None => ToolPasses { radius: half, flanks: &[None] },
        }
    }

    /// Distance of the axis of a tool of a radius (m) above the roller's centre line, m: next to a flank, or in the middle between both.
    pub(crate) fn tool_offset(&self, flank: Option<FlankSide>, tool: f64) -> f64 {
        flank.map_or(0.5 * (self.distances[0] - self.distances[1]), |flank| {
            let distance = self.signed(flank);
            distance - distance.signum() * tool
        })
    }

    /// Angular speed of the cam, rad/s.
    pub(crate) fn speed(&self) -> Option<f64> {
        self.rpm.map(units::rad_per_s)
    }

    /// Whether the cam turns clockwise.
    pub(crate) fn is_clockwise(&self) -> bool {
        self.machine.cam.rotation == Rotation::Clockwise
    }

    /// 1 where the drawing is that of a cam that turns clockwise, −1 where it is mirrored.
    pub(crate) fn sense(&self) -> f64 {
        if self.is_clockwise() { 1.0 } else { -1.0 }
    }

    /// The bore as a contour with the metal on its left.
    pub(crate) fn holes(&self) -> Vec<Contour> {
        part::bore(&self.machine).iter().map(|bore| bore.contour().reversed()).collect()
    }

    /// Mass of a volume of the cam, mm³, in kg.
    pub(crate) fn mass(&self, volume: f64) -> f64 {
        volume / (MILLIMETRES * MILLIMETRES * MILLIMETRES) * self.machine.cam.density()
    }
}
