//! Loads as columns of the internal forces they make, scaled so that the product of two columns is a compliance.
//!
//! By the theorem of Maxwell and Mohr, the deflection that load b makes at load a is
//!
//! ```text
//! c_aᵀ c_b = ∫ M_a M_b/(EJ) dx + ∫ Q_a Q_b/(κGA) dx + Σ R_a R_b/k
//! ```
//!
//! M and Q of a panel are polynomials, and Legendre polynomials are orthogonal: the rows of a column are the coefficients
//! √(l/(EJ(2k+1))) μ_k of M, √(l/(κGA(2k+1))) q_k of Q, and R_j/√k_j of every elastic support. A rigid support has no row.
//!
//! The internal forces by EJψ′ = M, y′ = ψ + Q/(κGA), Q′ = −load, M′ = −Q − couples. A load is first held by two supports a
//! and b, which statics allows. The forces of the others minimise the energy (Castigliano): a column is taken to what is left
//! of it with the columns of unit forces at those supports, least squares by an orthonormal basis.

use super::curve::{CurvePiece, DeflectionCurve};
use super::legendre::{self, odd};
use super::panels::{Panel, Panels};
use super::{Beam, Shaft};

/// A load before it is held: its resultant, and what it makes in a beam that is held at the right end only.
#[derive(Debug, Clone, Default)]
struct BeamLoad {
    /// Resultant, N.
    force: f64,
    /// Moment about the support a, N m.
    moment: f64,
    /// On the panels from this one on, M = jump + rise (x − start) and Q = −force.
    from: usize,
    start: f64,
    jump: f64,
    rise: f64,
    /// Inside its own panel: Legendre coefficients of M and Q.
    inside: Option<(usize, Vec<f64>, Vec<f64>)>,
}

/// A unit load on a shaft.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum LoadSource {
    /// A force per length, √((2k + 1)/l) P_k on a panel: orthonormal.
    Line { panel: usize, k: usize },
    /// Couples per length on a panel, with that polynomial.
    Couples { panel: usize, k: usize },
    /// 1 N at a cut.
    Force { cut: usize },
    /// 1 N m at a cut, that turns as ψ does.
    Couple { cut: usize },
}

/// The scaled internal forces of a load; behind them, at [`Frame::inner`], the force of every support on the shaft, N.
pub(super) type ForceColumn = Vec<f64>;

/// One of the supports, at its cut.
#[derive(Debug, Clone, Copy)]
struct SupportCut {
    cut: usize,
    at: f64,
    /// √k and the row of its force, of an elastic one.
    spring: Option<(f64, usize)>,
}

/// A shaft that makes columns of loads.
#[derive(Debug, Clone)]
pub(super) struct Frame {
    pub(super) panels: Panels,
    /// Load polynomials of a panel: degrees below this.
    order: usize,
    /// Whether Q has rows.
    shear: bool,
    supports: Vec<SupportCut>,
    /// a and b, of the supports.
    base: [usize; 2],
    /// Rows of internal forces.
    inner: usize,
    /// Orthonormal columns of unit forces at the supports other than a and b.
    redundant: Vec<ForceColumn>,
}

impl Frame {
    pub(super) fn new(shaft: &Shaft, panels: Panels, order: usize) -> Self {
        let shear = shaft.beam() == Beam::Timoshenko;
        let mut inner = panels.panels.len() * stride(order, shear);
        let mut supports = Vec::with_capacity(shaft.supports().len());
        for support in shaft.supports() {
            let cut = panels.cut(support.at);
            let spring = support.stiffness.map(|k| (k.sqrt(), inner));
            inner += usize::from(spring.is_some());
            supports.push(SupportCut { cut, at: panels.position(cut), spring });
        }
        let base = base(shaft, &supports);
        let mut frame = Self { panels, order, shear, supports, base, inner, redundant: Vec::new() };
        frame.hold();
        frame
    }

    /// Rows of internal forces; a column goes on with the forces of the supports.
    pub(super) fn inner(&self) -> usize {
        self.inner
    }

    pub(super) fn order(&self) -> usize {
        self.order
    }

    /// The columns of unit forces at the supports other than a and b, made orthonormal.
    fn hold(&mut self) {
        for support in (0..self.supports.len()).filter(|support| !self.base.contains(support)) {
            let Some(held) = self.supports.get(support).copied() else { continue };
            let mut column = self.column_of(&self.load(LoadSource::Force { cut: held.cut }));
            if let Some(force) = column.get_mut(self.inner + support) {
                *force += 1.0;
            }
            if let Some((root, row)) = held.spring
                && let Some(entry) = column.get_mut(row)
            {
                *entry += 1.0 / root;
            }
            self.relieve(&mut column);
            let norm = self.dot(&column, &column).sqrt();
            if norm > 0.0 {
                for entry in &mut column {
                    *entry /= norm;
                }
                self.redundant.push(column);
            }
        }
    }

    /// The product of two columns: of compliance.
    pub(super) fn dot(&self, a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).take(self.inner).map(|(a, b)| a * b).sum()
    }

    /// Subtracts the share of the supports other than a and b; twice, since once leaves the rounding of a large column.
    fn relieve(&self, column: &mut [f64]) {
        for _ in 0..2 {
            for basis in &self.redundant {
                let share = self.dot(basis, column);
                if share != 0.0 {
                    column.iter_mut().zip(basis).for_each(|(entry, b)| *entry -= share * b);
                }
            }
        }
    }

    /// The column of a load.
    pub(super) fn column(&self, source: LoadSource) -> ForceColumn {
        let mut column = self.column_of(&self.load(source));
        self.relieve(&mut column);
        column
    }

    /// Place of a base support and its number.
    fn base_at(&self, end: usize) -> (usize, Option<&SupportCut>) {
        let support = self.base.get(end).copied().unwrap_or(0);
        (support, self.supports.get(support))
    }

    fn load(&self, source: LoadSource) -> BeamLoad {
        let a = self.base_at(0).1.map_or(0.0, |held| held.at);
        match source {
            LoadSource::Force { cut } => {
                let start = self.panels.position(cut);
                BeamLoad { force: 1.0, moment: start - a, from: cut, start, rise: 1.0, ..BeamLoad::default() }
            }
            LoadSource::Couple { cut } => BeamLoad { moment: 1.0, from: cut, jump: -1.0, ..BeamLoad::default() },
            LoadSource::Line { panel, k } => self.distributed(panel, k, a, false),
            LoadSource::Couples { panel, k } => self.distributed(panel, k, a, true),
        }
    }

    fn distributed(&self, panel: usize, k: usize, a: f64, couples: bool) -> BeamLoad {
        let (start, length) = self.panels.panels.get(panel).map_or((0.0, 0.0), |p| (p.at + p.length, p.length));
        let scale = (odd(k) / length).sqrt();
        let unit: Vec<f64> = (0..=k).map(|j| if j == k { scale } else { 0.0 }).collect();
        // f l I1, the sum of the load up to ξ.
        let sum: Vec<f64> = legendre::integral(&unit).iter().map(|c| c * length).collect();
        // P_k has a sum on its panel for k = 0 only, and a moment for k = 0 and 1; beyond, the ends cancel exactly.
        let total = if k == 0 { legendre::end(&sum) } else { 0.0 };
        if couples {
            let inside = Some((panel, sum.iter().map(|c| -c).collect(), Vec::new()));
            return BeamLoad { moment: total, from: panel + 1, start, jump: -total, inside, ..BeamLoad::default() };
        }
        let moments: Vec<f64> = legendre::integral(&sum).iter().map(|c| c * length).collect();
        let arm = if k < 2 { legendre::end(&moments) } else { 0.0 };
        BeamLoad {
            force: total,
            moment: total * (start - a) - arm,
            from: panel + 1,
            start,
            jump: arm,
            rise: total,
            inside: Some((panel, moments, sum.iter().map(|c| -c).collect())),
        }
    }

    /// The column of a load held by a and b alone.
    fn column_of(&self, load: &BeamLoad) -> ForceColumn {
        let mut column = vec![0.0; self.inner + self.supports.len()];
        let ((a, left), (b, right)) = (self.base_at(0), self.base_at(1));
        let (Some(left), Some(right)) = (left, right) else { return column };
        let second = -load.moment / (right.at - left.at);
        let first = -load.force - second;
        for (support, held, force) in [(a, left, first), (b, right, second)] {
            if let Some(entry) = column.get_mut(self.inner + support) {
                *entry = force;
            }
            if let Some((root, row)) = held.spring
                && let Some(entry) = column.get_mut(row)
            {
                *entry = force / root;
            }
        }
        let rows = column.chunks_exact_mut(stride(self.order, self.shear));
        for ((index, panel), rows) in self.panels.panels.iter().enumerate().zip(rows) {
            let own = load.inside.as_ref().filter(|(own, ..)| *own == index);
            let (mut mean, mut rise, mut shear) = (0.0, 0.0, 0.0);
            let middle = panel.at + 0.5 * panel.length;
            if index >= load.from {
                mean += load.jump + load.rise * (middle - load.start);
                rise += load.rise;
                shear -= load.force;
            }
            for (held, force) in [(left, first), (right, second)] {
                if index >= held.cut {
                    mean += force * (middle - held.at);
                    rise += force;
                    shear -= force;
                }
            }
            let (moments, forces) = own.map_or((&[][..], &[][..]), |(_, m, q)| (m.as_slice(), q.as_slice()));
            let (of_moment, of_force) = rows.split_at_mut((self.order + 2).min(rows.len()));
            write(of_moment, moments, mean, 0.5 * panel.length * rise, panel.length / panel.bending);
            write(of_force, forces, shear, 0.0, panel.length * panel.shear);
        }
        column
    }

    /// The bent shaft that goes with these internal forces.
    pub(super) fn curve(&self, forces: &[f64]) -> DeflectionCurve {
        let mut pieces = Vec::with_capacity(self.panels.panels.len());
        let (mut turn, mut deflection) = (0.0, 0.0);
        for (panel, rows) in self.panels.panels.iter().zip(forces.chunks_exact(stride(self.order, self.shear))) {
            let piece = self.piece(panel, rows, deflection, turn);
            (deflection, turn) = (legendre::end(&piece.deflection), legendre::end(&piece.slope));
            pieces.push(piece);
        }
        // Two constants are left: the shaft as a whole goes where a and b are.
        let [(a, at_a), (b, at_b)] = [0, 1].map(|end| {
            let (_, held) = self.base_at(end);
            let (cut, at, spring) = held.map_or((0, 0.0, None), |held| (held.cut, held.at, held.spring));
            let given = spring.map_or(0.0, |(root, row)| -forces.get(row).copied().unwrap_or(0.0) / root);
            let drawn = match pieces.get(cut) {
                Some(piece) => legendre::value(&piece.deflection, 0.0),
                None => deflection,
            };
            (at, given - drawn)
        });
        let rise = (at_b - at_a) / (b - a);
        for piece in &mut pieces {
            let middle = piece.at + 0.5 * piece.length;
            add(&mut piece.deflection, 0, at_a + rise * (middle - a));
            add(&mut piece.deflection, 1, 0.5 * piece.length * rise);
            add(&mut piece.slope, 0, rise);
        }
        DeflectionCurve::new(pieces)
    }

    /// ψ = ψ₀ + ∫ M/(EJ), y = y₀ + ∫ (ψ + Q/(κGA)).
    fn piece(&self, panel: &Panel, rows: &[f64], deflection: f64, turn: f64) -> CurvePiece {
        let (of_moment, of_force) = rows.split_at((self.order + 2).min(rows.len()));
        // M l/(EJ) and Q/(κGA), each from its scaled row.
        let bent = unscaled(of_moment, panel.length / panel.bending, panel.length / panel.bending);
        let mut slope = legendre::integral(&bent);
        add(&mut slope, 0, turn);
        let mut rise = slope.clone();
        if self.shear {
            for (k, c) in unscaled(of_force, panel.length * panel.shear, panel.shear).into_iter().enumerate() {
                add(&mut rise, k, c);
            }
        }
        let mut curve: Vec<f64> = legendre::integral(&rise).iter().map(|c| c * panel.length).collect();
        add(&mut curve, 0, deflection);
        CurvePiece { at: panel.at, length: panel.length, deflection: curve, slope }
    }
}

/// Coefficients times a factor from scaled rows.
fn unscaled(rows: &[f64], compliance: f64, factor: f64) -> Vec<f64> {
    rows.iter().enumerate().map(|(k, row)| row * factor / (compliance / odd(k)).sqrt()).collect()
}

/// Rows of one panel: M of degree order + 1, Q of degree order.
fn stride(order: usize, shear: bool) -> usize {
    order + 2 + if shear { order + 1 } else { 0 }
}

fn add(coefficients: &mut [f64], k: usize, value: f64) {
    if let Some(c) = coefficients.get_mut(k) {
        *c += value;
    }
}

/// Scaled rows of a polynomial given in two parts: Legendre coefficients and a straight line.
fn write(rows: &mut [f64], own: &[f64], mean: f64, rise: f64, compliance: f64) {
    let own = own.iter().copied().chain(std::iter::repeat(0.0));
    let line = [mean, rise].into_iter().chain(std::iter::repeat(0.0));
    for ((k, row), (own, line)) in rows.iter_mut().enumerate().zip(own.zip(line)) {
        let coefficient = own + line;
        if coefficient != 0.0 {
            *row = coefficient * (compliance / odd(k)).sqrt();
        }
    }
}

/// The two supports that hold the shaft best when the others are away, left one first: those on which it turns least under
/// a couple, (1/k_a + 1/k_b + bending)/(b − a)². Any two are right; far and stiff ones leave the others little to correct.
fn base(shaft: &Shaft, supports: &[SupportCut]) -> [usize; 2] {
    let length = shaft.length();
    let flexibility: f64 = shaft.segments().iter().map(|s| s.length / (s.modulus * s.second_moment())).sum();
    // Of the order of a pinned shaft's deflection under a force in the middle; it only distinguishes rigid pairs.
    let bending = length * length * flexibility / 48.0;
    let yielding: Vec<f64> = shaft.supports().iter().map(|s| s.stiffness.map_or(0.0, |k| 1.0 / k)).collect();
    let mut best = ([0, 1], f64::INFINITY);
    for (a, (left, left_yielding)) in supports.iter().zip(&yielding).enumerate() {
        let right = supports.iter().zip(&yielding).enumerate().filter(|(_, (right, _))| right.at > left.at);
        for (b, (right, right_yielding)) in right {
            let apart = right.at - left.at;
            let turn = (left_yielding + right_yielding + bending) / (apart * apart);
            if turn < best.1 {
                best = ([a, b], turn);
            }
        }
    }
    best.0
}
