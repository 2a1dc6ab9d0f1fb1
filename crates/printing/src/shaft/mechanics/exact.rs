//! Critical speeds, deflection and response by unit loads: Birger's equation as an eigenproblem of forces.
//!
//! The masses of the bent shaft make loads ω² W y; a load basis of Legendre polynomials on every panel, with the forces and
//! couples of the discs, has the columns S of `columns`. Then
//!
//! ```text
//! W = diag   ρA of a line of force, g ρJ of couples (Timoshenko only), m of a disc's force, I_t − γ I_p of its couple
//!     planar γ = 0, g = 1      forward γ = 1, g = −1      backward γ = −1, g = 3
//! 1/ω² = the positive eigenvalues of B = S W Sᵀ     (of √W SᵀS √W, smaller, where no W is negative)
//! steady response at Ω:  (I − Ω² B) v = S f
//! ```
//!
//! Negative W (forward whirl) is right and stays; negative eigenvalues are not critical speeds. Nothing is discretised but the
//! load, whose series converges like that of an entire function: see `GUARD`.

use super::columns::{ForceColumn, Frame, LoadSource};
use super::curve::DeflectionCurve;
use super::eigen::TridiagonalForm;
use super::error::{out_of_range, without_mass};
use super::panels::Panels;
use super::{Beam, MOST_MODES, MOST_ORDER, MOST_RATIO, Shaft, ShaftError, Whirl, valid};
use camgen_kernel::refusal::Refusal;
use nalgebra::{DMatrix, DVector};

/// Order beyond the largest wave of a panel, z rad: order ⌈z⌉ + 6 leaves 2e-14 of a speed, + 4 1e-10, + 2 1e-6 (measured).
const GUARD: usize = 6;

/// The order tried first, to see the waves, where there are panels enough: it gives a speed to a few per cent.
const LEAST_ORDER: usize = 2;

/// A panel with more of a wave, rad, is cut: two orders of half the size are cheaper than one, and better conditioned.
const MOST_WAVES: f64 = 12.0;

/// Below this part of the largest eigenvalue is rounding and no mode: some hundred times ε.
const NOTHING: f64 = 1e-13;

/// A critical speed and how the shaft bends at it.
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    /// ω, rad/s.
    pub speed: f64,
    /// Largest |y| +1.
    pub shape: DeflectionCurve,
}

/// The lowest critical speeds.
#[derive(Debug, Clone, PartialEq)]
pub struct Modes {
    /// Rising.
    pub modes: Vec<Mode>,
    /// Load polynomials of a panel.
    pub order: usize,
    /// Number of panels.
    pub panels: usize,
}

/// The `count` lowest critical speeds, rising, with their modes.
///
/// `order` fixes the order of the load polynomials, for a study of its error; `None` takes as many as leave rounding only,
/// and cuts panels that hold many waves.
///
/// # Errors
/// A mode that does not exist or is lost in rounding, no mass, an order out of range: [`ShaftError`].
pub fn modes(shaft: &Shaft, whirl: Whirl, count: usize, order: Option<usize>) -> Result<Modes, ShaftError> {
    if count > MOST_MODES {
        return Err(Refusal::new(format!("{count} modes are asked for"))
            .remedy(format!("{MOST_MODES} can be found at most"))
            .into());
    }
    let mut panels = Panels::new(shaft, &[]);
    if let Some(order) = order {
        if !(1..=MOST_ORDER).contains(&order) {
            return Err(Refusal::new(format!("the order is {order}"))
                .remedy(format!("it must be 1…{MOST_ORDER}"))
                .into());
        }
        return EigenProblem::new(shaft, panels, order, whirl)?.modes(count, shaft);
    }
    let heavy = panels.panels.iter().filter(|panel| panel.mass > 0.0).count();
    let mut order = first_order(heavy, count);
    for _ in 0..REFINEMENTS {
        let problem = EigenProblem::new(shaft, panels.clone(), order, whirl)?;
        // A coarse load puts the highest modes too high, by any factor: then more of it comes before more panels.
        let Some(cut) = panels.cut_to(problem.highest(count), MOST_WAVES) else {
            order = MOST_ORDER;
            continue;
        };
        let wanted = carrying(cut.waves(problem.highest(count)));
        if wanted <= order && cut.panels.len() == panels.panels.len() {
            return problem.modes(count, shaft);
        }
        (panels, order) = (cut, wanted.max(order));
    }
    Err(ShaftError::ModeTooHigh { mode: count.max(1) })
}

/// Solutions at most. The first gives the waves to a few per cent, the second to rounding; a third comes where the first was so
/// coarse that it saw fewer.
const REFINEMENTS: usize = 8;

/// The order of the first solution: as much as carries `count` half waves on so many panels alike, each with mass.
fn first_order(panels: usize, count: usize) -> usize {
    match panels {
        0 => 0,
        _ => (LEAST_ORDER..MOST_ORDER).find(|order| order * panels >= 4 * count).unwrap_or(MOST_ORDER),
    }
}

/// The order that carries so much of a wave, rad, to rounding; none is wanted where nothing has mass.
fn carrying(waves: f64) -> usize {
    if waves > 0.0 { GUARD + upward(waves) } else { 0 }
}

/// ⌈x⌉ as a count.
fn upward(x: f64) -> usize {
    (0..=64_u32).find(|n| f64::from(*n) >= x).map_or(64, |n| n as usize)
}

/// The loads that masses make, each with what makes it; none without.
fn loads(shaft: &Shaft, panels: &Panels, order: usize, whirl: Whirl) -> Vec<(LoadSource, f64)> {
    let gamma = whirl.gamma();
    // The polar inertia of a round section is twice its diametral one.
    let g = 1.0 - 2.0 * gamma;
    let mut loads = Vec::new();
    for (panel, section) in panels.panels.iter().enumerate() {
        loads.extend((0..order).map(|k| (LoadSource::Line { panel, k }, section.mass)));
        if shaft.beam() == Beam::Timoshenko {
            loads.extend((0..order).map(|k| (LoadSource::Couples { panel, k }, g * section.rotary)));
        }
    }
    for disc in shaft.discs() {
        let cut = panels.cut(disc.at);
        loads.push((LoadSource::Force { cut }, disc.mass));
        loads.push((LoadSource::Couple { cut }, disc.diametral_inertia - gamma * disc.polar_inertia));
    }
    loads.retain(|(_, weight)| *weight != 0.0);
    loads
}

/// S and W.
fn matrix(shaft: &Shaft, frame: &Frame, whirl: Whirl) -> (DMatrix<f64>, Vec<f64>) {
    let loads = loads(shaft, &frame.panels, frame.order(), whirl);
    let mut entries = Vec::with_capacity(frame.inner() * loads.len());
    for (source, _) in &loads {
        entries.extend(frame.column(*source).into_iter().take(frame.inner()));
    }
    let weights: Vec<f64> = loads.iter().map(|(_, weight)| *weight).collect();
    (DMatrix::from_vec(frame.inner(), weights.len(), entries), weights)
}

/// Every column times the function of its weight.
fn weighted(matrix: &DMatrix<f64>, weights: &[f64], of: impl Fn(f64) -> f64) -> DMatrix<f64> {
    let mut scaled = matrix.clone();
    for (mut column, weight) in scaled.column_iter_mut().zip(weights) {
        column *= of(*weight);
    }
    scaled
}

/// The eigenproblem of one set of loads.
struct EigenProblem {
    frame: Frame,
    spectrum: TridiagonalForm,
    /// S √W, for the eigenvalues of √W SᵀS √W.
    rooted: Option<DMatrix<f64>>,
    /// The largest size of an eigenvalue, also of the negative ones: what rounding is measured by.
    size: f64,
}

impl EigenProblem {
    fn new(shaft: &Shaft, panels: Panels, order: usize, whirl: Whirl) -> Result<Self, ShaftError> {
        let frame = Frame::new(shaft, panels, order);
        let (s, weights) = matrix(shaft, &frame, whirl);
        if s.iter().all(|entry| *entry == 0.0) {
            return Err(without_mass().into());
        }
        let gram = weights.iter().all(|weight| *weight >= 0.0) && weights.len() <= frame.inner();
        let rooted = gram.then(|| weighted(&s, &weights, f64::sqrt));
        let symmetric = match &rooted {
            Some(rooted) => rooted.transpose() * rooted,
            None => weighted(&s, &weights, |weight| weight) * s.transpose(),
        };
        let spectrum = TridiagonalForm::new(&symmetric).ok_or_else(out_of_range)?;
        let size = spectrum.size();
        Ok(Self { frame, spectrum, rooted, size })
    }

    /// The smallest eigenvalue that is reported.
    fn wall(&self) -> f64 {
        self.size / (MOST_RATIO * MOST_RATIO)
    }

    /// ω of the highest of `count` modes, or of the highest there is; never above the wall.
    fn highest(&self, count: usize) -> f64 {
        self.spectrum.last_of(count, self.wall()).map_or(0.0, |value| 1.0 / value.sqrt())
    }

    /// The first `count` modes, or why there are fewer.
    fn modes(&self, count: usize, shaft: &Shaft) -> Result<Modes, ShaftError> {
        let values = self.spectrum.largest(count, self.wall());
        if values.len() < count {
            let exist = self.spectrum.largest(count, NOTHING * self.size).len();
            // A shaft with a mass of its own has modes without end; one without only the modes of its discs.
            let endless = shaft.segments().iter().any(|segment| segment.density > 0.0);
            return Err(if endless || values.len() < exist {
                ShaftError::ModeTooHigh { mode: values.len() + 1 }
            } else if exist == 0 {
                without_mass().into()
            } else {
                ShaftError::NoSuchMode { asked: count, exist }
            });
        }
        let vectors = self.spectrum.vectors(&values).into_iter();
        let modes = values.iter().zip(vectors).map(|(value, vector)| {
            let forces = match &self.rooted {
                Some(rooted) => rooted * vector,
                None => vector,
            };
            Mode { speed: 1.0 / value.sqrt(), shape: self.frame.curve(forces.as_slice()).normalized() }
        });
        Ok(Modes { modes: modes.collect(), order: self.frame.order(), panels: self.frame.panels.panels.len() })
    }
}

/// The shaft under 1 N at one position, at rest.
#[derive(Debug, Clone, PartialEq)]
pub struct Statics {
    /// Deflection, m/N, and slope, rad/N.
    pub curve: DeflectionCurve,
    /// Force of the shaft on every support, N per N, in the order of the supports; their sum is 1.
    pub reactions: Vec<f64>,
    compliance: f64,
}

impl Statics {
    /// Under 1 N at `at`, m from the left end.
    ///
    /// # Errors
    /// A position beyond the shaft.
    pub fn new(shaft: &Shaft, at: f64) -> Result<Self, Refusal> {
        valid::within("the load", at, shaft.length())?;
        let frame = Frame::new(shaft, Panels::new(shaft, &[at]), 0);
        let column = frame.column(LoadSource::Force { cut: frame.panels.cut(at) });
        let reactions: Vec<f64> = column.iter().skip(frame.inner()).map(|force| -force).collect();
        let compliance = frame.dot(&column, &column);
        if !compliance.is_finite() {
            return Err(out_of_range());
        }
        Ok(Self { curve: frame.curve(&column), reactions, compliance })
    }

    /// Deflection at x, m/N: by Maxwell also that at the load under 1 N at x.
    #[must_use]
    pub fn compliance(&self, x: f64) -> f64 {
        self.curve.evaluate(x)[0]
    }

    /// Deflection of the load, m/N, supports included: from the energy, never negative.
    #[must_use]
    pub fn own_compliance(&self) -> f64 {
        self.compliance
    }
}

/// The shaft turning with its unbalances, bent by them and turning as bent: two directions that turn with it.
#[derive(Debug, Clone, PartialEq)]
pub struct Response {
    curves: [DeflectionCurve; 2],
    /// Force of the shaft on every support, N, in the order of the supports.
    pub support_forces: Vec<[f64; 2]>,
}

impl Response {
    /// Deflection, m, at x, in the two directions of [`ShaftDisc::unbalance`](super::ShaftDisc::unbalance).
    #[must_use]
    pub fn deflection_at(&self, x: f64) -> [f64; 2] {
        self.curves.each_ref().map(|curve| curve.evaluate(x)[0])
    }

    /// Slope, rad, at x, in the same directions.
    #[must_use]
    pub fn slope_at(&self, x: f64) -> [f64; 2] {
        self.curves.each_ref().map(|curve| curve.evaluate(x)[1])
    }
}

/// Steady response to the unbalances of the discs at `speed`, rad/s, without damping: forward whirl.
///
/// # Errors
/// A speed below 0, or one at which the response has no bound.
pub fn response(shaft: &Shaft, speed: f64) -> Result<Response, Refusal> {
    if !(speed >= 0.0 && speed.is_finite()) {
        return Err(Refusal::new(format!("the speed is {speed} rad/s")).remedy("it must be a number of at least 0"));
    }
    let panels = Panels::new(shaft, &[]).cut_to(speed, MOST_WAVES).ok_or_else(|| {
        let what = format!("{speed} rad/s is so far above every critical speed that the response is lost in rounding");
        Refusal::new(what).remedy("give a lower speed")
    })?;
    let order = carrying(panels.waves(speed));
    let frame = Frame::new(shaft, panels, order);
    let (square, inner) = (speed * speed, frame.inner());
    let made: Vec<(ForceColumn, f64)> = loads(shaft, &frame.panels, order, Whirl::Forward)
        .into_iter()
        .map(|(source, weight)| (frame.column(source), weight))
        .collect();
    let mut system = DMatrix::identity(inner, inner);
    for (column, weight) in &made {
        let column = DVector::from_iterator(inner, column.iter().copied().take(inner));
        system.ger(-square * weight, &column, &column, 1.0);
    }
    let factors = system.lu();
    let mut responses = [ForceColumn::new(), ForceColumn::new()];
    for (direction, response) in responses.iter_mut().enumerate() {
        let mut forces = vec![0.0; inner + shaft.supports().len()];
        for disc in shaft.discs() {
            let unbalance = disc.unbalance.get(direction).copied().unwrap_or(0.0);
            gather(
                &mut forces,
                unbalance * square,
                &frame.column(LoadSource::Force { cut: frame.panels.cut(disc.at) }),
            );
        }
        let mut inside = DVector::from_iterator(inner, forces.iter().copied().take(inner));
        if !factors.solve_mut(&mut inside) || !inside.iter().all(|force| force.is_finite()) {
            let what = format!("{speed} rad/s is a critical speed, where the steady response has no bound");
            return Err(Refusal::new(what).remedy("give another speed"));
        }
        let inside: ForceColumn = inside.iter().copied().collect();
        // What the masses add, also at the rigid supports, which have no row of their own.
        for (column, weight) in &made {
            gather(&mut forces, square * weight * frame.dot(column, &inside), column);
        }
        *response = inside.into_iter().chain(forces.into_iter().skip(inner)).collect();
    }
    let [x, y] = responses;
    let on_supports = x.iter().zip(&y).skip(inner).map(|(x, y)| [-x, -y]).collect();
    Ok(Response { curves: [frame.curve(&x), frame.curve(&y)], support_forces: on_supports })
}

/// Adds a column times a factor.
fn gather(sum: &mut [f64], factor: f64, column: &[f64]) {
    if factor != 0.0 {
        sum.iter_mut().zip(column).for_each(|(sum, entry)| *sum += factor * entry);
    }
}
