use super::*;

/// y' = y: eˣ; and y' = y/(x + 1)·…: known series of every operation.
#[test]
fn series_are_known_ones() {
    let mut tape = Tape::default();
    let y = tape.state();
    let exponential = tape.finish(y).expand(0.0, 1.0, 12);
    let mut factorial = 1.0;
    for (n, coefficient) in exponential.coefficients.iter().enumerate() {
        assert!((coefficient * factorial - 1.0).abs() < 1e-15, "{n}");
        factorial *= f64::from(u32::try_from(n).expect("small")) + 1.0;
    }
    // y' = √(1 − y²) is the sine; y' = 1 + y² the tangent, written with a product; y' = y/x a straight line.
    let mut tape = Tape::default();
    let (y, one) = (tape.state(), tape.constant(1.0));
    let square = tape.product(y, y);
    let less = tape.scaled(square, -1.0);
    let inside = tape.sum(one, less);
    let root = tape.root(inside);
    let sine = tape.finish(root).expand(0.3, libm::sin(0.3), 20);
    let [value, first, second, third] = sine.at(0.45);
    let (sin, cos) = (libm::sin(0.45), libm::cos(0.45));
    for (got, exact) in [(value, sin), (first, cos), (second, -sin), (third, -cos)] {
        assert!((got - exact).abs() < 2e-12, "{got} {exact}");
    }
    let mut tape = Tape::default();
    let (x, y) = (tape.abscissa(), tape.state());
    let quotient = tape.quotient(y, x);
    let line = tape.finish(quotient).expand(2.0, 3.0, 6);
    assert!(line.coefficients.iter().skip(2).all(|c| c.abs() < 1e-15), "{line:?}");
    assert!((line.value(5.0) - 7.5).abs() < 1e-14);
}

#[test]
fn a_power_keeps_the_digits_of_a_small_argument() {
    let mut tape = Tape::default();
    let x = tape.abscissa();
    let power = tape.power_less_one(x, 1.35);
    let tape = tape.finish(power);
    assert!((tape.value(1e-12, 0.0) / 1.35e-12 - 1.0).abs() < 2e-12);
    // ∫ ((1 − x)^−1.35 − 1) dx = ((1 − x)^−0.35 − 1)/0.35 − x.
    let got = tape.expand(0.1, 0.0, 24).value(0.2);
    let exact = |x: f64| libm::expm1(-0.35 * libm::log1p(-x)) / 0.35 - x;
    assert!((got - (exact(0.2) - exact(0.1))).abs() < 1e-16);
}

/// y' = x/y·2 − … with y = x w: f = 2/w − w has w = 1 and the straight line y = x; with a power mixed in, the
/// series from the origin continues what an ordinary expansion gives.
#[test]
fn a_removable_singularity_is_started_from() {
    // f = x/P(x + y) with P(a) = (1 − a)^−1.35 − 1.
    let mut start = Tape::default();
    let (w, one) = (start.state(), start.constant(1.0));
    let both = start.sum(one, w);
    let argument = start.times_abscissa(both);
    let power = start.power_less_one(argument, 1.35);
    let over = start.over_abscissa(power);
    let f = start.quotient(one, over);
    let start = start.finish(f);
    // w = 1/(1.35 (1 + w)).
    let slope = 0.5 * (-1.0 + (1.0_f64 + 4.0 / 1.35).sqrt());
    assert!((start.value(0.0, slope) - slope).abs() < 1e-15);
    let first = start.expand_from_origin(slope, 24);

    let mut tape = Tape::default();
    let (x, y) = (tape.abscissa(), tape.state());
    let both = tape.sum(x, y);
    let power = tape.power_less_one(both, 1.35);
    let f = tape.quotient(x, power);
    let tape = tape.finish(f);
    let mut y = first.value(0.02);
    for step in 0..3 {
        let x = 0.02 + 0.01 * f64::from(step);
        assert!((first.value(x) - y).abs() < 1e-15, "{x}");
        assert!((first.at(x)[1] - tape.value(x, y)).abs() < 1e-13);
        y = tape.expand(x, y, 24).value(x + 0.01);
    }
}

#[test]
fn the_reach_keeps_the_tolerance() {
    let mut tape = Tape::default();
    let y = tape.state();
    let tape = tape.finish(y);
    for tolerance in [1e-4, 1e-8, 1e-14] {
        let series = tape.expand(0.0, 1.0, order(tolerance));
        let x = series.reach(tolerance);
        assert!(x > 0.3 && (series.value(x) - libm::exp(x)).abs() <= tolerance, "{tolerance} {x}");
    }
}
