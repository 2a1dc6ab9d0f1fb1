use super::tape::{ElementaryFunction, Tape, TapeNumber};
use super::*;

#[track_caller]
fn near(found: &[f64], wanted: &[f64], share: f64) {
    assert!(found.len() >= wanted.len());
    for (found, wanted) in found.iter().zip(wanted) {
        assert!((found - wanted).abs() < share * (1.0 + wanted.abs()), "{found} is not {wanted}");
    }
}

/// x = 2 + t, y = 3 − t + t²: quotient, root and angle against their derivatives by hand.
#[test]
fn series_of_the_second_order_are_known_ones() {
    let (x, y) = (PowerSeries([2.0, 1.0, 0.0]), PowerSeries([3.0, -1.0, 1.0]));
    let close = |got: PowerSeries<3>, want: [f64; 3]| near(&got.0, &want, 1e-15);
    close((y / x) * x, y.0);
    close(y.sqrt() * y.sqrt(), y.0);
    close(x - x * 1.0, [0.0; 3]);
    // e^t − 1 = t + t²/2 + …, and e^(2x) − 1 = (e^x − 1)(e^x + 1).
    close(PowerSeries([0.0, 1.0, 0.0]).exp_m1(), [0.0, 1.0, 0.5]);
    let half = (x * 0.05).exp_m1();
    close((x * 0.1).exp_m1(), (half * (half + 2.0)).0);
    // d atan(y/x) = (x y' − y x')/(x² + y²) = −5/13 at t = 0; its slope from the quotient rule is 110/169.
    close(y.atan2(x), [libm::atan2(3.0, 2.0), -5.0 / 13.0, 0.5 * (4.0 * 13.0 - (-5.0) * (-2.0)) / 169.0]);
}

#[test]
fn series_undo_each_other() {
    let (cos, sin) = PowerSeries::<6>::cos_sin(0.7);
    near(&(cos * cos + sin * sin).0, &PowerSeries::<6>::constant(1.0).0, 1e-15);
    let a = cos + 2.0;
    let close = |x: PowerSeries<6>, y: PowerSeries<6>| near(&x.0, &y.0, 1e-15);
    close(a.sqrt() * a.sqrt(), a);
    close(sin / a * a, sin);
    close(a * 2.0 - a, a);
    let (s, c) = (libm::sin(0.7), libm::cos(0.7));
    near(&sin.derivatives(), &[s, c, -s, -c, s, c], 1e-15);
    near(&sin.slope().0[..5], &cos.0[..5], 1e-15);
}

/// A function of t on a tape, about 0 to the sixth order.
fn of_t(function: impl for<'t> FnOnce(TapeNumber<'t>) -> TapeNumber<'t>) -> Vec<f64> {
    Tape::recorded(|t, _| function(t)).rows(0.0, 7).result().to_vec()
}

/// 0.3 − 0.7 t + 0.4 t² + 0.2 t³ − 0.1 t⁴ + 0.05 t⁵ + 0.3 t⁶.
fn polynomial(t: TapeNumber<'_>) -> TapeNumber<'_> {
    [0.05, -0.1, 0.2, 0.4, -0.7, 0.3].into_iter().fold(t.constant(0.3), |sum, coefficient| sum * t + coefficient)
}

/// Each function by its identities with the others.
#[test]
fn identities_hold_to_the_sixth_order() {
    use ElementaryFunction::{
        ArcCosine, ArcSine, ArcTangent, Cosine, Exponential, Logarithm, Power, PowerLessOne, Root, Scaled, Sine,
        Tangent,
    };
    let itself = of_t(polynomial);
    for functions in [[Sine, ArcSine], [Cosine, ArcCosine], [Tangent, ArcTangent], [Exponential, Logarithm]] {
        near(&of_t(|t| functions.into_iter().fold(polynomial(t), TapeNumber::apply)), &itself, 1e-13);
    }
    let same = |one: Vec<f64>, other: Vec<f64>| near(&one, &other, 1e-13);
    same(of_t(|t| polynomial(t).apply(Sine) / polynomial(t).apply(Cosine)), of_t(|t| polynomial(t).apply(Tangent)));
    same(
        of_t(|t| polynomial(t).apply(Power(2.5))),
        of_t(|t| polynomial(t).apply(Logarithm).apply(Scaled(2.5)).apply(Exponential)),
    );
    for root in [Root, Power(0.5)] {
        same(of_t(|t| polynomial(t).apply(root) * polynomial(t).apply(root)), itself.clone());
    }
    let power = of_t(|t| (polynomial(t) * -1.0 + 1.0).apply(Power(-1.35)) + -1.0);
    same(of_t(|t| polynomial(t).apply(PowerLessOne(1.35))), power);
    // a t under the power, and over t again.
    let over = of_t(|t| polynomial(t).apply(ElementaryFunction::PowerLessOneOverAbscissa(1.35)));
    near(&of_t(|t| (polynomial(t) * t).apply(PowerLessOne(1.35)))[1..], &over[..6], 1e-13);
}

/// e^t, sin t, ln(1 + t), arctan t, √(1 + t) by their textbook series.
#[test]
fn series_are_those_of_textbooks() {
    let of = |function| of_t(|t| t.apply(function));
    let exponential = [1.0, 1.0, 0.5, 1.0 / 6.0, 1.0 / 24.0, 1.0 / 120.0, 1.0 / 720.0];
    near(&of(ElementaryFunction::Exponential), &exponential, 1e-13);
    near(
        &of_t(|t| (t + 1.0).apply(ElementaryFunction::Logarithm)),
        &[0.0, 1.0, -0.5, 1.0 / 3.0, -0.25, 0.2, -1.0 / 6.0],
        1e-13,
    );
    near(&of(ElementaryFunction::ArcTangent), &[0.0, 1.0, 0.0, -1.0 / 3.0, 0.0, 0.2, 0.0], 1e-13);
    near(&of(ElementaryFunction::Tangent), &[0.0, 1.0, 0.0, 1.0 / 3.0, 0.0, 2.0 / 15.0, 0.0], 1e-13);
    near(&of(ElementaryFunction::ArcSine), &[0.0, 1.0, 0.0, 1.0 / 6.0, 0.0, 3.0 / 40.0, 0.0], 1e-13);
    near(&of_t(|t| (t + 1.0).apply(ElementaryFunction::Power(0.5))), &[1.0, 0.5, -0.125, 0.0625, -5.0 / 128.0], 1e-13);
    // t^2.5 is 0 with its first two derivatives, and its third has no bound.
    assert_eq!(of(ElementaryFunction::Power(2.5))[..5], [0.0, 0.0, 0.0, f64::INFINITY, f64::INFINITY]);
}

/// y' = y: eˣ; y' = √(1 − y²) the sine; y' = y/x a straight line.
#[test]
fn solutions_are_known_ones() {
    let exponential = Tape::recorded(|_, y| y).expand(0.0, 1.0, 12);
    let mut factorial = 1.0;
    for (n, coefficient) in exponential.coefficients.iter().enumerate() {
        factorial *= number(n.max(1));
        assert!((coefficient * factorial - 1.0).abs() < 1e-15, "{n}");
    }
    let sine =
        Tape::recorded(|_, y| (y * y * -1.0 + 1.0).apply(ElementaryFunction::Root)).expand(0.3, libm::sin(0.3), 20);
    let (sin, cos) = (libm::sin(0.45), libm::cos(0.45));
    near(&sine.values_at(0.45), &[sin, cos, -sin, -cos], 1e-12);
    let line = Tape::recorded(|x, y| y / x).expand(2.0, 3.0, 6);
    assert!(line.coefficients.iter().skip(2).all(|c| c.abs() < 1e-15), "{line:?}");
    assert!((line.value(5.0) - 7.5).abs() < 1e-14);
}

#[test]
fn a_power_keeps_the_digits_of_a_small_argument() {
    let tape = Tape::recorded(|x, _| x.apply(ElementaryFunction::PowerLessOne(1.35)));
    assert!((tape.value(1e-12, 0.0) / 1.35e-12 - 1.0).abs() < 2e-12);
    // ∫ ((1 − x)^−1.35 − 1) dx = ((1 − x)^−0.35 − 1)/0.35 − x.
    let got = tape.expand(0.1, 0.0, 24).value(0.2);
    let exact = |x: f64| libm::expm1(-0.35 * libm::log1p(-x)) / 0.35 - x;
    assert!((got - (exact(0.2) - exact(0.1))).abs() < 1e-16);
}

/// f = x/P(x + y) with P(a) = (1 − a)^−1.35 − 1 and y = x w: the series from the origin continues what an ordinary expansion gives.
#[test]
fn a_removable_singularity_is_started_from() {
    let start =
        Tape::recorded(|x, w| x.constant(1.0) / (w + 1.0).apply(ElementaryFunction::PowerLessOneOverAbscissa(1.35)));
    // w = 1/(1.35 (1 + w)).
    let slope = 0.5 * (-1.0 + (1.0_f64 + 4.0 / 1.35).sqrt());
    assert!((start.value(0.0, slope) - slope).abs() < 1e-15);
    let first = start.expand_from_origin(slope, 24);
    let tape = Tape::recorded(|x, y| x / (x + y).apply(ElementaryFunction::PowerLessOne(1.35)));
    let mut y = first.value(0.02);
    for step in 0..3 {
        let x = 0.02 + 0.01 * f64::from(step);
        assert!((first.value(x) - y).abs() < 1e-15, "{x}");
        assert!((first.values_at(x)[1] - tape.value(x, y)).abs() < 1e-13);
        y = tape.expand(x, y, 24).value(x + 0.01);
    }
}

#[test]
fn the_reach_keeps_the_tolerance() {
    let tape = Tape::recorded(|_, y| y);
    for tolerance in [1e-4, 1e-8, 1e-14] {
        let series = tape.expand(0.0, 1.0, taylor::order(tolerance));
        let x = series.reach(tolerance);
        assert!(x > 0.3 && (series.value(x) - libm::exp(x)).abs() <= tolerance, "{tolerance} {x}");
    }
}
