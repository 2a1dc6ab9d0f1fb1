//! The first critical speed by the paper's integrals and iteration, on stations.
//!
//! Two supports at a < b anywhere, discs as point masses, no shear, no rotary inertia; the trapezoidal rule throughout, on
//! panels that end at every change of section, support and disc. (5) gives the moment, (6) the forces of the supports, (4)
//! with (6) the deflection z of the loads m y; ω² is Rayleigh's quotient of y and z.
//!
//! Of second order: on a uniform beam with rigid supports at its ends exactly n_N = n_1 [(2N/π) tan(π/2N)]², 1.645/N² too high.

use super::error::{out_of_range, without_mass};
use super::panels::{Panel, Panels};
use super::{MOST_STATIONS, Shaft};
use camgen_kernel::refusal::Refusal;

/// ω² has come to rest when a round moves it by less than this part of itself.
const REST: f64 = 1e-13;

/// More rounds than this mean that the ratio of the two lowest 1/ω², squared by the quotient, is within 1e-3 of 1.
const MOST_ROUNDS: usize = 10_000;

/// How far the start leans, over the length: a symmetric start misses a rocking mode on supports within the shaft.
const LEAN: f64 = 0.37;

/// A panel that ends on a station by its decimal number does so within the rounding of N l/L.
const ON_STATION: f64 = 1e-9;

/// The first critical speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Paper {
    /// rad/s.
    pub speed: f64,
    /// Number of rounds of the iteration.
    pub rounds: usize,
}

/// The first critical speed on about `stations` intervals: a panel of length l has ⌈N l/L⌉ equal ones.
///
/// # Errors
/// Other than two supports, stations out of range, no mass, an iteration without end.
pub fn first_critical(shaft: &Shaft, stations: usize) -> Result<Paper, Refusal> {
    if shaft.supports().len() != 2 {
        let found = shaft.supports().len();
        return Err(Refusal::new(format!("the shaft has {found} supports, and the paper's method is for two"))
            .remedy("use the exact method, which takes any number"));
    }
    if !(1..=MOST_STATIONS).contains(&stations) {
        return Err(
            Refusal::new(format!("{stations} stations")).remedy(format!("their number must be 1…{MOST_STATIONS}"))
        );
    }
    let line = Line::new(shaft, stations);
    let length = shaft.length();
    let mut y: Vec<f64> = line.stations.iter().map(|station| 1.0 + LEAN * station.x / length).collect();
    let mut last = 0.0_f64;
    for rounds in 1..=MOST_ROUNDS {
        let z = line.deflection(&y);
        let square = line.product(&y, &z) / line.product(&z, &z);
        if !(square > 0.0) {
            return Err(without_mass());
        }
        if !square.is_finite() {
            return Err(out_of_range());
        }
        if (square - last).abs() < REST * square {
            return Ok(Paper { speed: square.sqrt(), rounds });
        }
        last = square;
        let largest = z.iter().fold(0.0_f64, |most, z| most.max(z.abs()));
        y = z.into_iter().map(|z| z / largest).collect();
    }
    Err(Refusal::new(format!(
        "the iteration has not ended after {MOST_ROUNDS} rounds, because two critical speeds lie close together"
    ))
    .remedy("use the exact method, which tells them apart"))
}

/// An end of intervals.
#[derive(Debug, Clone, Copy)]
struct IntervalEnd {
    x: f64,
    /// Mass of the discs here, kg.
    disc: f64,
    /// Half of the intervals next to it, and the discs, kg.
    mass: f64,
}

/// Between two stations, with one section.
#[derive(Debug, Clone, Copy)]
struct Interval {
    length: f64,
    /// m, kg/m.
    mass: f64,
    /// 1/EJ, 1/(N m²).
    compliance: f64,
}

/// A support: its position, station and 1/k.
#[derive(Debug, Clone, Copy)]
struct SupportStation {
    at: f64,
    station: usize,
    yielding: f64,
}

struct Line {
    stations: Vec<IntervalEnd>,
    intervals: Vec<Interval>,
    /// Left, right.
    supports: [SupportStation; 2],
}

impl Line {
    fn new(shaft: &Shaft, stations: usize) -> Self {
        let panels = Panels::new(shaft, &[]);
        let per_length = f64::from(u32::try_from(stations).unwrap_or(u32::MAX)) / shaft.length();
        let mut line = Self { stations: Vec::new(), intervals: Vec::new(), supports: [NOWHERE; 2] };
        // The station of every cut.
        let mut station_of = vec![0];
        line.stations.push(IntervalEnd { x: 0.0, disc: 0.0, mass: 0.0 });
        for panel in &panels.panels {
            line.cut(panel, (per_length * panel.length - ON_STATION).ceil().max(1.0));
            station_of.push(line.intervals.len());
        }
        for disc in shaft.discs() {
            let station = station_of.get(panels.cut(disc.at)).copied().unwrap_or(0);
            if let Some(here) = line.stations.get_mut(station) {
                here.disc += disc.mass;
                here.mass += disc.mass;
            }
        }
        let mut held: Vec<SupportStation> = shaft
            .supports()
            .iter()
            .map(|support| {
                let cut = panels.cut(support.at);
                let yielding = support.stiffness.map_or(0.0, |k| 1.0 / k);
                let station = station_of.get(cut).copied().unwrap_or(0);
                SupportStation { at: panels.position(cut), station, yielding }
            })
            .collect();
        held.sort_by(|a, b| a.at.total_cmp(&b.at));
        for (place, held) in line.supports.iter_mut().zip(held) {
            *place = held;
        }
        line
    }

    fn cut(&mut self, panel: &Panel, count: f64) {
        let length = panel.length / count;
        let interval = Interval { length, mass: panel.mass, compliance: 1.0 / panel.bending };
        let half = 0.5 * panel.mass * length;
        let mut k = 0.0;
        while k < count {
            k += 1.0;
            if let Some(left) = self.stations.last_mut() {
                left.mass += half;
            }
            self.stations.push(IntervalEnd { x: panel.at + panel.length * (k / count), disc: 0.0, mass: half });
            self.intervals.push(interval);
        }
    }

    /// Σ m a b over the stations.
    fn product(&self, a: &[f64], b: &[f64]) -> f64 {
        self.stations.iter().zip(a.iter().zip(b)).map(|(station, (a, b))| station.mass * a * b).sum()
    }

    /// z of the loads m y.
    fn deflection(&self, y: &[f64]) -> Vec<f64> {
        let [a, b] = self.supports;
        let (free, total) = self.moments(y);
        let end = self.stations.last().map_or(0.0, |station| station.x);
        // The moment of the loads about x = 0 is F L − A2(L).
        let about = total * end - free.last().copied().unwrap_or(0.0);
        let second = -(about - total * a.at) / (b.at - a.at);
        let first = -total - second;
        let moment = free
            .iter()
            .zip(&self.stations)
            .map(|(free, station)| free + first * (station.x - a.at).max(0.0) + second * (station.x - b.at).max(0.0));
        let moment: Vec<f64> = moment.collect();
        let (mut slope, mut bent) = (0.0, 0.0);
        let mut z = Vec::with_capacity(moment.len());
        z.push(0.0);
        for (interval, (left, right)) in self.intervals.iter().zip(moment.iter().zip(moment.iter().skip(1))) {
            let next = slope + 0.5 * interval.length * interval.compliance * (left + right);
            bent += 0.5 * interval.length * (slope + next);
            slope = next;
            z.push(bent);
        }
        // c0 + c1 x: the supports stand where their forces put them.
        let [at_a, at_b] = [(a, first), (b, second)]
            .map(|(held, force)| -force * held.yielding - z.get(held.station).copied().unwrap_or(0.0));
        let rise = (at_b - at_a) / (b.at - a.at);
        z.iter().zip(&self.stations).map(|(z, station)| z + at_a + rise * (station.x - a.at)).collect()
    }

    /// A2 at every station, and A1(L): of the loads right of nothing.
    fn moments(&self, y: &[f64]) -> (Vec<f64>, f64) {
        let (mut force, mut moment) = (0.0, 0.0);
        let mut moments = Vec::with_capacity(y.len());
        let mut ends = self.stations.iter().zip(y);
        if let Some((station, y)) = ends.next() {
            force += station.disc * y;
        }
        moments.push(moment);
        let mut left = y.first().copied().unwrap_or(0.0);
        for (interval, (station, y)) in self.intervals.iter().zip(ends) {
            let next = force + 0.5 * interval.length * interval.mass * (left + y);
            moment += 0.5 * interval.length * (force + next);
            moments.push(moment);
            force = next + station.disc * y;
            left = *y;
        }
        (moments, force)
    }
}

const NOWHERE: SupportStation = SupportStation { at: 0.0, station: 0, yielding: 0.0 };
