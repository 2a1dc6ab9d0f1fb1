//! A cam as it is cut, in a machine that differs from the one it was cut for.
//!
//! Without a difference the air column has the length L w at every overrun, w = (1 + u)^(−1/k), u = A x, and balances the bed. The
//! bottom is where the cam puts it, so that w belongs to the overrun in every machine. In a machine that differs
//!
//! ```text
//! r = U [M u − π (τ (s/(w + t))^κ − 1)],   s = f (1 + d),   t = d − ε        > 0: the air is too weak, the crank carries the rest
//! ```
//!
//! with U = 2 p0 F, d = ΔL/L and ε = Δe/L. Air that is left in the cylinder keeps p (v/mass)^κ.

use super::bed_path::BedPath;
use super::error::ScatterError;
use crate::press::buffer::Cylinder;
use crate::press::buffer::bottom_law::{BottomLaw, column_for};
use crate::press::buffer::crank_law::{CrankLaw, LinkageLaw};
use crate::press::buffer::level_air::LevelAir;
use camgen_kernel::numeric::extremum::{self, Extremum};
use camgen_kernel::numeric::root;
use std::f64::consts::FRAC_PI_2;

/// Cells of the braking half in which the largest residual force with a phase error is searched.
const CELLS: u32 = 64;

/// A machine that differs. Ratios are true value / value that the cam was cut for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fault {
    /// M: mass ratio times the square of the speed ratio.
    pub square: f64,
    /// π: ratio of the ambient pressures.
    pub ambient: f64,
    /// κ: the true exponent.
    pub exponent: f64,
    /// τ: pressure where the port closes, over the true ambient pressure.
    pub closing: f64,
    /// f: share of the air that is left.
    pub air: f64,
    /// ΔL: how much longer the column is, m.
    pub column: f64,
    /// Δe: how much earlier the port shuts, m.
    pub lead: f64,
    /// How far the cam is ahead, rad of the crank.
    pub phase: f64,
}

impl Fault {
    /// The machine the cam was cut for, with the exponent k.
    #[must_use]
    pub fn none(exponent: f64) -> Self {
        Self { square: 1.0, ambient: 1.0, exponent, closing: 1.0, air: 1.0, column: 0.0, lead: 0.0, phase: 0.0 }
    }

    /// v = M/π, the one variable of mass, speed and ambient pressure.
    #[must_use]
    pub fn variable(&self) -> f64 {
        self.square / self.ambient
    }

    /// With this change of the column, m.
    #[must_use]
    pub fn with_column(self, column: f64) -> Self {
        Self { column, ..self }
    }
}

/// τ (s/w)^κ: the pressure over the ambient one, on the way in, of air that filled the column with its share s and now has the length w.
fn compressed(fault: &Fault, s: f64, w: f64) -> f64 {
    fault.closing * libm::exp(fault.exponent * libm::log(s / w))
}

/// A buffer whose bottom keeps its design position in every machine: moved by the cam, or fixed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrozenBuffer {
    /// U = 2 p0 F, N.
    pub unit_force: f64,
    /// k, for which it was made.
    pub exponent: f64,
    /// L, m.
    pub column: f64,
    /// How the bed moves.
    pub path: BedPath,
    /// Load at the dead point.
    end_load: f64,
    /// Load at which the air is shortest: the largest one of a cam.
    peak_load: f64,
    /// Air with a loop that the cam levels. Forces are then the mean of both ways: the half of their difference no screw can change.
    pub level: Option<LevelAir>,
}

impl FrozenBuffer {
    /// The buffer of a cam for this law.
    #[must_use]
    pub fn of_cam(law: &BottomLaw, cylinder: &Cylinder) -> Self {
        Self {
            unit_force: cylinder.unit_force(),
            exponent: law.exponent,
            column: law.column,
            path: BedPath::Yoke { loading: law.loading, stroke: law.stroke },
            end_load: law.loading * law.stroke,
            peak_load: law.loading * law.stroke,
            level: law.level,
        }
    }

    /// The buffer of a cam for the law of any bed.
    #[must_use]
    pub fn of_law(law: &CrankLaw, cylinder: &Cylinder) -> Self {
        match law {
            CrankLaw::Yoke(law) => Self::of_cam(law, cylinder),
            CrankLaw::Linkage(law) => Self::of_linkage(law, cylinder),
        }
    }

    fn of_linkage(law: &LinkageLaw, cylinder: &Cylinder) -> Self {
        Self {
            unit_force: cylinder.unit_force(),
            exponent: law.exponent,
            column: law.column,
            path: BedPath::Linkage(*law),
            end_load: law.loading * law.end.at(law.end.dead()).deceleration()[0],
            peak_load: law.loading * law.end.largest_deceleration().value,
            level: None,
        }
    }

    /// The same cylinder with a fixed bottom, its column by (7).
    #[must_use]
    pub fn with_fixed_bottom(&self) -> Self {
        let column = column_for(self.path.stroke(), self.end_load(), self.exponent);
        Self { column, level: None, peak_load: self.end_load(), ..*self }
    }

    /// Load at the dead point: `u_r` = A r under a yoke.
    #[must_use]
    pub fn end_load(&self) -> f64 {
        self.end_load
    }

    /// w of a cam at a load u.
    #[must_use]
    pub fn length(&self, load: f64) -> f64 {
        match &self.level {
            Some(air) => air.length(load),
            None => libm::exp(-libm::log1p(load) / self.exponent),
        }
    }

    /// −dw/du of a cam at a load u.
    #[must_use]
    pub fn fall(&self, load: f64) -> f64 {
        match &self.level {
            Some(air) => -air.derivatives(load)[1],
            None => self.length(load) / (self.exponent * (1.0 + load)),
        }
    }

    /// `w_r`, of a cam and of the fixed bottom.
    #[must_use]
    pub fn end_length(&self) -> f64 {
        libm::exp(-libm::log1p(self.end_load()) / self.exponent)
    }

    /// w where the air is shortest.
    pub(super) fn shortest_length(&self) -> f64 {
        libm::exp(-libm::log1p(self.peak_load) / self.exponent)
    }

    /// Exponent of the air on its way back in a machine that differs, where the cam levels a loop: never below the exponent of the way in.
    fn expansion(air: &LevelAir, fault: &Fault) -> f64 {
        air.expansion.max(fault.exponent)
    }

    /// Pressures in and back over the ambient one, each with its slope by the length w, where the air has the length L (w + t).
    fn ways(&self, air: &LevelAir, fault: &Fault, length: f64) -> [[f64; 2]; 2] {
        let ([s, t], kappa, expansion) = (self.air(fault), fault.exponent, Self::expansion(air, fault));
        let (end, length) = (self.end_length() + t, length + t);
        let on_way_in = compressed(fault, s, length - t + t);
        let back = compressed(fault, s, end - t + t) * libm::exp(expansion * libm::log(end / length));
        [[on_way_in, -kappa * on_way_in / length], [back, -expansion * back / length]]
    }

    /// u of a cam where the air has the length L w.
    fn load(&self, length: f64) -> f64 {
        libm::expm1(-self.exponent * libm::log(length))
    }

    /// s and t.
    fn air(&self, fault: &Fault) -> [f64; 2] {
        let longer = fault.column / self.column;
        [fault.air * (1.0 + longer), longer - fault.lead / self.column]
    }

    /// Residual force at a load u where the undisturbed air has the length L w, N, without the phase error.
    #[must_use]
    pub fn residual(&self, fault: &Fault, load: f64, length: f64) -> f64 {
        let [s, t] = self.air(fault);
        let pressure = match &self.level {
            Some(air) => {
                let [[on_way_in, _], [back, _]] = self.ways(air, fault, length);
                0.5 * (on_way_in + back)
            }
            None => compressed(fault, s, length + t),
        };
        self.unit_force * (fault.square * load - fault.ambient * (pressure - 1.0))
    }

    /// That force over the stations of the crank, the loads and lengths of `at`, its largest size with the phase error and the friction
    /// of the bed (N) both ways.
    #[must_use]
    pub fn largest_at(&self, fault: &Fault, at: &[Station], friction: f64) -> f64 {
        let mut largest = 0.0_f64;
        if self.level.is_some() {
            for station in at {
                let phase = (self.unit_force * fault.phase * station.phase - friction).abs();
                largest = largest.max(self.residual(fault, station.load, station.length).abs() + phase);
            }
            return largest;
        }
        let friction = friction / self.unit_force;
        let [s, t] = self.air(fault);
        let (log_s, weight) = (libm::log(s), fault.ambient * fault.closing);
        for station in at {
            let air = weight * libm::exp(fault.exponent * (log_s - libm::log(station.length + t))) - fault.ambient;
            let (force, phase) = (fault.square * station.load - air, fault.phase * station.phase);
            largest = largest.max(match &self.path {
                BedPath::Yoke { .. } => force.abs() + (phase - friction).abs(),
                BedPath::Linkage(law) if station.angle > law.end.dead() => (force + phase + friction).abs(),
                BedPath::Linkage(_) => (force + phase - friction).abs(),
            });
        }
        self.unit_force * largest
    }

    /// Largest |residual force| over the stroke of a fixed bottom under a yoke, N, without the phase error.
    ///
    /// The air length is L (w + t) with w = 1 − u/(A L), so the force is concave in u, with its maximum at
    /// w + t = (π τ κ s^κ/(M A L))^(1/(κ+1)).
    #[must_use]
    pub fn largest_of_fixed(&self, fault: &Fault) -> f64 {
        let ([s, t], kappa, column) = (self.air(fault), fault.exponent, self.path.loading() * self.column);
        let scale = fault.ambient * fault.closing * kappa / (fault.square * column);
        let top = libm::exp((libm::log(scale) + kappa * libm::log(s)) / (kappa + 1.0)) - t;
        let loads = [0.0, (column * (1.0 - top)).clamp(0.0, self.end_load()), self.end_load()];
        loads.map(|load| self.residual(fault, load, 1.0 - load / column).abs()).into_iter().fold(0.0, f64::max)
    }

    /// Refuses a machine whose column is used up.
    pub(super) fn fits(&self, fault: &Fault) -> Result<(), ScatterError> {
        let [s, t] = self.air(fault);
        let left = self.shortest_length() + t;
        if left > 0.0 && s > 0.0 {
            return Ok(());
        }
        Err(ScatterError::ColumnUsedUp { short_mm: -1e3 * self.column * left.min(s) })
    }

    /// Least and largest residual force of a cam over the stroke, N, with the overrun x, m; without the phase error.
    ///
    /// dr/dw = 0 where (κ+1) ln(w+t) − (k+1) ln w = ln(π τ κ s^κ/(k M)). The left side turns at `w0 = (k+1) t/(κ−k)` at most, so
    /// that either part has one root at most.
    ///
    /// # Errors
    /// When the column is used up.
    pub fn extremes(&self, fault: &Fault) -> Result<[Extremum; 2], ScatterError> {
        let by_load = self.extremes_by_load(fault)?;
        Ok(by_load.map(|found| Extremum { at: self.path.overrun_of(found.at), ..found }))
    }

    /// As [`Self::extremes`], with the load u instead of the overrun.
    pub(super) fn extremes_by_load(&self, fault: &Fault) -> Result<[Extremum; 2], ScatterError> {
        self.fits(fault)?;
        if self.level.is_some() {
            return Ok(self.extremes_of_mean(fault));
        }
        let ([s, t], k, kappa) = (self.air(fault), self.exponent, fault.exponent);
        let scale = fault.ambient * fault.closing * kappa / (k * fault.square);
        let level = libm::log(scale) + kappa * libm::log(s);
        let end = self.shortest_length();
        let turn = Some((k + 1.0) * t / (kappa - k)).filter(|turn| *turn > end && *turn < 1.0);
        let parts = [Some(end), turn, Some(1.0)];
        let edges: Vec<f64> = parts.into_iter().flatten().collect();
        let stationary = edges.array_windows().filter_map(|[low, high]| {
            let found = root::bracketed(
                |w| (kappa + 1.0) * libm::log(w + t) - (k + 1.0) * libm::log(w) - level,
                *low,
                *high,
                0.0,
            );
            found.ok()
        });
        let places = [1.0, end].into_iter().chain(stationary);
        let mut found: Vec<Extremum> = places
            .map(|w| {
                let load = if w == end { self.peak_load } else { self.load(w) };
                Extremum { at: load, value: self.residual(fault, load, w) }
            })
            .collect();
        found.sort_by(|a, b| a.value.total_cmp(&b.value));
        match found[..] {
            [least, .., largest] => Ok([least, largest]),
            _ => Err(ScatterError::ColumnUsedUp { short_mm: 0.0 }),
        }
    }

    /// Least and largest mean of both ways, by a search over the crank.
    fn extremes_of_mean(&self, fault: &Fault) -> [Extremum; 2] {
        [-1.0, 1.0].map(|sign| {
            let found = extremum::largest(
                |at| {
                    let load = self.load_of_yoke(at);
                    sign * self.residual(fault, load, self.length(load))
                },
                |at| sign * self.slope(fault, self.load_of_yoke(at)) * self.end_load() * libm::cos(at),
                (0.0, FRAC_PI_2),
                CELLS,
            );
            Extremum { at: self.load_of_yoke(found.at), value: sign * found.value }
        })
    }

    /// u at a crank angle of the way in under a yoke, exact at the dead point.
    fn load_of_yoke(&self, at: f64) -> f64 {
        if at == FRAC_PI_2 { self.end_load() } else { self.end_load() * libm::sin(at) }
    }

    /// The residual force of a cam of largest size, N, signed, with the overrun x, m, and the phase error in the worse direction.
    ///
    /// # Errors
    /// When the column is used up.
    pub fn worst(&self, fault: &Fault) -> Result<Extremum, ScatterError> {
        let [least, largest] = self.extremes_by_load(fault)?;
        if fault.phase == 0.0 {
            let worst = if -least.value > largest.value { least } else { largest };
            return Ok(Extremum { at: self.path.overrun_of(worst.at), ..worst });
        }
        let [above, below] = [1.0, -1.0].map(|sign| self.extreme_with_phase(fault, 1.0, sign));
        if let BedPath::Linkage(_) = self.path {
            return Ok(if above.value > -below.value { above } else { below });
        }
        let [above_on_return, below_on_return] = [1.0, -1.0].map(|sign| self.extreme_with_phase(fault, -1.0, sign));
        let all = [above, below, above_on_return, below_on_return];
        let still = Extremum { at: self.path.overrun_of(largest.at), ..largest };
        Ok(all.into_iter().fold(still, |best, next| if next.value.abs() > best.value.abs() { next } else { best }))
    }

    /// The largest residual force with the phase error for a sign of 1, the least for −1, N, with the overrun x, m; `way` is 1 on the
    /// way in and −1 back.
    fn extreme_with_phase(&self, fault: &Fault, way: f64, sign: f64) -> Extremum {
        let found = extremum::largest(
            |at| {
                let (load, phase) = (self.path.load_at(at), way * fault.phase * self.phase_force(at)[0]);
                sign * (self.residual(fault, load, self.length(load)) + phase)
            },
            |at| {
                let by_load = self.slope(fault, self.path.load_at(at)) * self.path.load_slope(at);
                sign * (by_load + way * fault.phase * self.phase_force(at)[1])
            },
            (0.0, self.path.reach()),
            CELLS,
        );
        Extremum { at: self.path.overrun_at(found.at), value: sign * found.value }
    }

    /// dr/du, N.
    fn slope(&self, fault: &Fault, load: f64) -> f64 {
        let ([s, t], w) = (self.air(fault), self.length(load));
        if let Some(air) = &self.level {
            let [[_, on_way_in], [_, back]] = self.ways(air, fault, w);
            return self.unit_force * (fault.square + 0.5 * fault.ambient * (on_way_in + back) * self.fall(load));
        }
        let pressure = compressed(fault, s, w + t);
        let fall = self.fall(load);
        self.unit_force * (fault.square - fault.ambient * pressure * fault.exponent * fall / (w + t))
    }

    /// The force of a phase error under a linkage, N a radian of the crank, and its slope by the crank angle: the bottom of a cam that is ahead
    /// stands Δx' a radian nearer, −U k (1 + u)^(1+p) Δx'/L.
    fn phase_force_of_linkage(&self, law: &LinkageLaw, angle: f64) -> [f64; 2] {
        let (k, p) = (self.exponent, 1.0 / self.exponent);
        let (_, [a, a1], [_, first, second]) = law.travels(angle);
        let (load, slope) = (law.loading * a.max(0.0), law.loading * a1);
        let scale = -self.unit_force * k / self.column;
        let log = libm::log1p(load);
        let (power, growth) = (libm::exp((1.0 + p) * log), (1.0 + p) * libm::exp(p * log) * slope);
        [scale * power * first, scale * (growth * first + power * second)]
    }

    /// Residual force on the way in for a cam that is ahead, N a radian of the crank, to first order, and its slope by the crank angle;
    /// opposite on the way back: U k (r/L) cos φ [(1+u)^(1+p) − c], c = L A/k. Under a linkage for the whole reversal, with its sign.
    #[must_use]
    pub fn phase_force(&self, angle: f64) -> [f64; 2] {
        if let BedPath::Linkage(law) = &self.path {
            return self.phase_force_of_linkage(law, angle);
        }
        let (k, (sin, cos)) = (self.exponent, (libm::sin(angle), libm::cos(angle)));
        let power = 1.0 + 1.0 / k;
        let load = self.end_load() * sin;
        if let Some(air) = &self.level {
            // The mean of both ways: −dP/dw = 2 (1 + u)'/w', which is −1/w' of the mean.
            let [_, first, second, ..] = air.derivatives(load);
            let (grown, growth) = (-1.0 / first - self.column * self.path.loading(), second / (first * first));
            let scale = self.unit_force * self.path.stroke() / self.column;
            return [scale * cos * grown, scale * (cos * cos * growth * self.end_load() - sin * grown)];
        }
        let grown = libm::exp(power * libm::log1p(load)) - self.column * self.path.loading() / k;
        let scale = self.unit_force * k * self.path.stroke() / self.column;
        let growth = power * libm::exp((power - 1.0) * libm::log1p(load)) * self.end_load() * cos;
        [scale * cos * grown, scale * (cos * growth - sin * grown)]
    }
}

/// A crank angle at which a buffer is evaluated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Station {
    /// Crank angle φ, rad.
    pub angle: f64,
    /// u.
    pub load: f64,
    /// w.
    pub length: f64,
    /// The force of a phase error of a radian over U.
    pub phase: f64,
}

/// Steps of half a degree in the braking half; as many in the whole reversal under a linkage.
pub const STEPS: u32 = 180;

impl FrozenBuffer {
    /// A crank angle of the way in, rad, with a cam.
    #[must_use]
    pub fn station_of_cam(&self, angle: f64) -> Station {
        let load = self.path.load_at(angle);
        Station { angle, load, length: self.length(load), phase: self.phase_force(angle)[0] / self.unit_force }
    }

    /// A crank angle of the way in, rad, with a fixed bottom, w = 1 − x/L.
    #[must_use]
    pub fn station_of_fixed_bottom(&self, angle: f64) -> Station {
        let load = self.path.load_at(angle);
        let shorter = match self.path {
            BedPath::Yoke { .. } => load / (self.path.loading() * self.column),
            BedPath::Linkage(_) => self.path.overrun_at(angle) / self.column,
        };
        Station { angle, load, length: 1.0 - shorter, phase: 0.0 }
    }

    /// The crank angles of the stations, rad.
    fn angles(&self) -> impl Iterator<Item = f64> {
        let reach = self.path.reach();
        let evenly = (0..STEPS).map(move |step| reach * f64::from(step) / f64::from(STEPS));
        let turning = match self.path {
            BedPath::Yoke { .. } => None,
            BedPath::Linkage(_) => Some([self.path.dead(), self.path.peak()]),
        };
        evenly.chain([reach]).chain(turning.into_iter().flatten())
    }

    /// The stations φ = 0, ½ … 90° of a cam.
    #[must_use]
    pub fn stations_of_cam(&self) -> Vec<Station> {
        self.angles().map(|angle| self.station_of_cam(angle)).collect()
    }

    /// The stations of a fixed bottom.
    #[must_use]
    pub fn stations_of_fixed_bottom(&self) -> Vec<Station> {
        self.angles().map(|angle| self.station_of_fixed_bottom(angle)).collect()
    }
}

impl FrozenBuffer {
    /// The largest size of the force of a phase error of a radian over the stroke, N, and the crank angle, rad.
    #[must_use]
    pub fn largest_phase_force(&self) -> Extremum {
        if let BedPath::Linkage(_) = self.path {
            return self.largest_phase_force_of_linkage();
        }
        let [with, against] = [1.0, -1.0].map(|sign| {
            extremum::largest(
                |at| sign * self.phase_force(at)[0],
                |at| sign * self.phase_force(at)[1],
                (0.0, self.path.reach()),
                CELLS,
            )
        });
        if with.value > against.value { with } else { against }
    }

    /// The largest value over the angles of a reversal, and the root of the slope between its neighbours.
    fn largest_phase_force_of_linkage(&self) -> Extremum {
        let cell = self.path.reach() / f64::from(CELLS);
        let at = (0..=CELLS).map(|cells| cell * f64::from(cells));
        let sizes = at.map(|at| (at, self.phase_force(at)[0].abs()));
        let (at, value) = sizes.fold((0.0, 0.0), |best, next| if next.1 > best.1 { next } else { best });
        let (low, high) = ((at - cell).max(0.0), (at + cell).min(self.path.reach()));
        let top = root::bracketed(|at| self.phase_force(at)[1], low, high, 0.0).ok();
        let top = top.map(|at| Extremum { at, value: self.phase_force(at)[0].abs() });
        top.filter(|top| top.value > value).unwrap_or(Extremum { at, value })
    }
}
