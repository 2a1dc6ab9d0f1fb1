//! The law against 60-digit arithmetic, over the whole domain and both of its delicate ends.
//!
//! The oracle takes q, k, r, x and L as the `f64` values they are and evaluates equation (10) as printed; with 200 bits
//! its own cancellation (1e-15 of the size at x = 1e-12 mm) leaves 45 digits.

use crate::common::big::{Big, big, number, ulp};
use camgen::domains::press::buffer::bottom_law::{BottomLaw, ColumnRule};

/// Crank radius of the reference machine, m.
const R: f64 = 0.18;
const RATIOS: [f64; 8] = [1.000_001, 1.000_1, 1.01, 1.25, 2.0, 5.0, 20.0, 100.0];
const EXPONENTS: [f64; 5] = [1.0001, 1.2, 1.35, 1.4, 2.0];

/// A, and (1+A x)^(−1/k).
fn parts(q: f64, k: f64, x: f64) -> (Big, Big) {
    let loading = (big(q) - big(1.0)) / big(R);
    let shrink = (-(big(1.0) + &loading * big(x)).ln() / big(k)).exp();
    (loading, shrink)
}

fn exact(q: f64, k: f64, x: f64, column: ColumnRule) -> Big {
    let (loading, shrink) = parts(q, k, x);
    let length = match column {
        ColumnRule::Matched => big(k) / loading,
        ColumnRule::Return => big(R) / (big(1.0) - parts(q, k, R).1),
        ColumnRule::Length(length) => big(length),
    };
    length * (big(1.0) - shrink) - big(x)
}

/// Overruns from 1e-12 mm to r, and r less as little.
fn overruns() -> Vec<f64> {
    let mut list: Vec<f64> = (0..=30).map(|i| R * libm::pow(10.0, -f64::from(i) * 14.26 / 30.0)).collect();
    let near_end: Vec<f64> = list.iter().map(|y| R - y).filter(|x| *x > 0.0).collect();
    list.extend([1e-15, R - 1e-15]);
    list.extend(near_end);
    list
}

/// Worst relative error over the domain; printed, so that a change is seen before the bound is.
fn worst_relative(column: ColumnRule) -> (f64, String) {
    let mut worst = (0.0, String::new());
    for q in RATIOS {
        for k in EXPONENTS {
            let bottom_law = BottomLaw::new((q - 1.0) / R, k, R, column, 0.0);
            for x in overruns() {
                let got = bottom_law.displacement(x);
                let exact = exact(q, k, x, column);
                if x == R && column == ColumnRule::Return {
                    assert_eq!(got, 0.0, "the bottom is back at x = r");
                    continue;
                }
                let error = number(&((big(got) - &exact) / &exact)).abs();
                if error > worst.0 {
                    worst = (error, format!("q = {q}, k = {k}, x = {x:e}, r − x = {:e}", R - x));
                }
            }
        }
    }
    worst
}

/// The promise is 1e-13; the form has a few roundings, each amplified fivefold at the most.
#[test]
fn matched_and_return_keep_relative_accuracy() {
    for (name, column, bound) in [("matched", ColumnRule::Matched, 2e-15), ("return", ColumnRule::Return, 1e-14)] {
        let (error, place) = worst_relative(column);
        println!("{name}: worst relative error {error:.2e} at {place}");
        assert!(error <= bound, "{name}: {error:e} at {place}");
    }
}

/// Any other column: 2 ulp of L, beside half an ulp of the result. Where q is large L is a hundred times shorter than
/// the stroke, and Δx near −x has no neighbour within 2 ulp of L.
#[test]
fn a_given_column_keeps_two_ulp_of_its_length() {
    let mut worst = (0.0, String::new());
    for q in RATIOS {
        for k in EXPONENTS {
            let loading = (q - 1.0) / R;
            for share in [0.7, 0.999, 1.000_001, 1.3, 4.0] {
                let length = share * k / loading;
                let bottom_law = BottomLaw::new(loading, k, R, ColumnRule::Length(length), 0.0);
                for x in overruns() {
                    let exact = exact(q, k, x, ColumnRule::Length(length));
                    let rounding = 0.5 * ulp(number(&exact).abs());
                    let off = number(&(big(bottom_law.displacement(x)) - exact)).abs();
                    let error = (off - rounding).max(0.0) / ulp(length);
                    if error > worst.0 {
                        worst = (error, format!("q = {q}, k = {k}, L = {length}, x = {x:e}"));
                    }
                }
            }
        }
    }
    println!("given column: worst error {:.2} ulp of L at {}", worst.0, worst.1);
    assert!(worst.0 <= 2.0, "{:.2} ulp at {}", worst.0, worst.1);
}

/// Slope and curvature of the law, relative where they do not vanish and absolute to the start slope otherwise.
#[test]
fn derivatives_are_exact() {
    for q in RATIOS {
        for k in EXPONENTS {
            for column in [ColumnRule::Matched, ColumnRule::Return] {
                let bottom_law = BottomLaw::new((q - 1.0) / R, k, R, column, 0.0);
                for x in overruns() {
                    let (loading, shrink) = parts(q, k, x);
                    let base = big(1.0) + &loading * big(x);
                    let length = match column {
                        ColumnRule::Matched => big(k) / &loading,
                        _ => big(R) / (big(1.0) - parts(q, k, R).1),
                    };
                    let c = length * &loading / big(k);
                    let slope = &c * &shrink / &base - big(1.0);
                    let steeper = big(1.0) / big(k) + big(1.0);
                    let second = -(&c * &loading * &steeper * &shrink) / (&base * &base);
                    let got = bottom_law.bottom(x, R - x);
                    let slope_error = number(&(big(got.slope) - &slope)).abs();
                    let bound =
                        if column == ColumnRule::Matched { 1e-15 * number(&slope).abs() } else { 1e-15 * number(&c) };
                    assert!(slope_error <= 4.0 * bound, "slope {column:?} q {q} k {k} x {x:e}: {slope_error:e}");
                    let second_error = number(&((big(got.second) - &second) / &second)).abs();
                    // An exponent of up to 10 carries its roundings into the power tenfold.
                    assert!(second_error <= 6e-15, "second {column:?} q {q} k {k} x {x:e}: {second_error:e}");
                }
            }
        }
    }
}
