//! Composite Gauss–Legendre quadrature.

/// Positive nodes and weights of the eight-point Gauss–Legendre rule on [−1, 1] (Abramowitz & Stegun, table 25.4).
const GAUSS_8: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_29),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_47),
    (0.960_289_856_497_536_2, 0.101_228_536_290_376_26),
];

/// The integral of `f` over `[low, high]`, divided into `panels` equal panels of eight points.
///
/// Exact for polynomials of degree 15 in each panel; an integrand with a cusp inside loses accuracy in its panel only.
pub fn integrate(mut f: impl FnMut(f64) -> f64, (low, high): (f64, f64), panels: u32) -> f64 {
    let half = 0.5 * (high - low) / f64::from(panels);
    let integrals = (0..panels).map(|panel| {
        let middle = low + half * f64::from(2 * panel + 1);
        half * GAUSS_8.iter().map(|(x, w)| w * (f(middle - half * x) + f(middle + half * x))).sum::<f64>()
    });
    integrals.sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrates_closed_forms() {
        let cases: [(f64, f64); 3] = [
            (integrate(|x| x.powi(15), (0.0, 1.0), 1), 1.0 / 16.0),
            (integrate(libm::sin, (0.0, std::f64::consts::PI), 4), 2.0),
            (integrate(libm::exp, (-1.0, 2.0), 4), libm::exp(2.0) - libm::exp(-1.0)),
        ];
        for (got, exact) in cases {
            assert!((got - exact).abs() < 1e-14 * exact.abs().max(1.0), "{got} is not {exact}");
        }
    }
}
