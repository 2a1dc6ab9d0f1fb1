use super::*;
use std::f64::consts::{PI, TAU};

fn formula(text: &str) -> Formula {
    Formula::parse(text, "x").unwrap_or_else(|error| panic!("{text}: {error}"))
}

#[track_caller]
fn near(found: f64, wanted: f64) {
    assert!((found - wanted).abs() <= 1e-13 * (1.0 + wanted.abs()), "{found} is not {wanted}");
}

#[test]
fn values_are_those_of_the_rules_of_arithmetic() {
    for (text, value) in [
        ("1+2*3", 7.0),
        ("(1+2)*3", 9.0),
        ("2^3^2", 512.0),
        ("-2^2", -4.0),
        ("2^-2", 0.25),
        ("8/4/2", 1.0),
        ("8-4-2", 2.0),
        ("1e-3 + .5 + 2.", 2.501),
        ("2*-x", -1.4),
        ("+x", 0.7),
        ("x^1", 0.7),
        ("x^0", 1.0),
        ("pi*e", PI * std::f64::consts::E),
        ("log(exp(x))", 0.7),
        ("x^x", 0.7_f64.powf(0.7)),
        ("5", 5.0),
    ] {
        let found = formula(text).values_at(0.7)[0];
        assert!((found - value).abs() < 1e-10, "{text}: {found}");
    }
}

/// Value and derivatives against those by hand.
#[test]
fn derivatives_are_exact() {
    let x = 0.7_f64;
    let (s, c) = x.sin_cos();
    for (text, wanted) in [
        ("x^4", [x.powi(4), 4.0 * x.powi(3), 12.0 * x * x, 24.0 * x]),
        ("1/x", [1.0 / x, -1.0 / (x * x), 2.0 / x.powi(3), -6.0 / x.powi(4)]),
        ("sin(2*x)", [(2.0 * x).sin(), 2.0 * (2.0 * x).cos(), -4.0 * (2.0 * x).sin(), -8.0 * (2.0 * x).cos()]),
        ("x*sin(x)", [x * s, s + x * c, 2.0 * c - x * s, -3.0 * s - x * c]),
        ("exp(x^2)", {
            let e = (x * x).exp();
            [e, 2.0 * x * e, (2.0 + 4.0 * x * x) * e, (12.0 * x + 8.0 * x.powi(3)) * e]
        }),
        ("log(x)", [x.ln(), 1.0 / x, -1.0 / (x * x), 2.0 / x.powi(3)]),
        ("sqrt(x)", [x.sqrt(), 0.5 * x.powf(-0.5), -0.25 * x.powf(-1.5), 0.375 * x.powf(-2.5)]),
        ("x^2.5", [x.powf(2.5), 2.5 * x.powf(1.5), 3.75 * x.sqrt(), 1.875 / x.sqrt()]),
        ("atan(x)", {
            let q = 1.0 + x * x;
            [x.atan(), 1.0 / q, -2.0 * x / (q * q), (6.0 * x * x - 2.0) / (q * q * q)]
        }),
        ("asin(x)", {
            let q = 1.0 - x * x;
            [x.asin(), q.powf(-0.5), x * q.powf(-1.5), (1.0 + 2.0 * x * x) * q.powf(-2.5)]
        }),
        ("tan(x)", {
            let t = x.tan();
            let d = 1.0 + t * t;
            [t, d, 2.0 * t * d, 2.0 * d * (1.0 + 3.0 * t * t)]
        }),
    ] {
        let found = formula(text);
        for ((found, wanted), order) in found.values_at(x).iter().zip(wanted).zip(0..) {
            near(*found, wanted);
            near(formula(text).derivative(x, order), wanted);
        }
    }
    near(formula("sin(x)").derivative(0.7, 9), c);
}

#[test]
fn what_does_not_read_is_told_at_its_character() {
    for (text, at, part) in [
        ("", 1, "ends where a value"),
        ("1+", 3, "ends where a value"),
        ("2*(x", 3, "not closed"),
        ("2*x)", 4, "`)` does not belong"),
        ("2 x", 3, "`x` does not belong"),
        ("1,5", 2, "`,` does not belong"),
        ("sen(x)", 1, "unknown name `sen`"),
        ("2*theta", 3, "unknown name `theta`"),
        ("sin x", 5, "needs its argument in parentheses"),
        ("2**x", 3, "`**` is not an operator"),
        ("1..5", 1, "is not a number"),
        ("2e", 2, "`e` does not belong"),
        ("1/(1-1)", 2, "no finite value"),
        ("1/0", 2, "no finite value"),
        ("log(0)", 1, "no finite value"),
        ("x + $", 5, "`$` does not belong"),
    ] {
        let error = Formula::parse(text, "x").expect_err(text);
        assert_eq!(error.at, at, "{text}: {error}");
        assert!(error.message.contains(part), "{text}: {error}");
    }
    let error = Formula::parse("2*cs(th)", "th").expect_err("no cs");
    assert!(error.help.is_some_and(|help| help.contains("did you mean `cos`?") && help.contains("variable is `th`")));
}

/// Poles and edges are found on the grid and between its places.
#[test]
fn places_without_a_value_are_found() {
    for (text, place, part) in [
        ("1/(x-1)", 1.0, "division by 0"),
        ("1/(x-sqrt(2))", 2.0_f64.sqrt(), "division by 0"),
        ("1/(x-sqrt(2))^2", 2.0_f64.sqrt(), "division by 0"),
        ("log(x)", 0.0, "logarithm of 0"),
        ("log(x-2)", 0.0, "logarithm of -2"),
        ("sqrt(1-x)", 1.0, "square root of"),
        ("sqrt(x)", 0.0, "no finite derivative up to the third"),
        ("sqrt((x-0.9999)^2-1e-8)", 0.9998, "square root of"),
        ("asin(2*x)", 0.5, "arcsine of"),
        ("acos(x/3)", 3.0, "arccosine of"),
        ("tan(x)", PI / 2.0, "tangent of"),
        ("exp(exp(x*2))", 3.269, "is infinite"),
        ("x^2.5", 0.0, "no finite derivative"),
    ] {
        let singular = formula(text).scanned(0.0, TAU).expect_err(text);
        assert!(singular.what.contains(part), "{text}: {singular:?}");
        assert!((singular.place - place).abs() < 0.01, "{text}: {singular:?}");
    }
    for text in ["1/(1.1+cos(x))", "x^3.5", "sqrt(1.001+sin(x))", "tan(x/5)", "exp(-1/(1e-3+x))", "asin(cos(x)*0.999)"]
    {
        let found = formula(text).scanned(0.0, TAU);
        assert!(found.is_ok(), "{text}: {found:?}");
    }
    let waves = formula("3*sin(12*x)").scanned(0.0, TAU).expect("finite");
    assert!((23..=25).contains(&waves.turns), "{waves:?}");
    assert!(waves.range.0 < -2.99 && waves.range.1 > 2.99, "{waves:?}");
}

/// A generator of numbers that are the same on every run (Marsaglia, "Xorshift RNGs", 2003).
struct FormulaRandom(u64);

impl FormulaRandom {
    fn below(&mut self, count: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        usize::try_from(self.0 >> 33).expect("small") % count
    }
}

/// Any text either reads or is refused at a character of it.
#[test]
fn any_text_is_read_or_refused() {
    let words = [
        "sin(",
        "cos(",
        "tan(",
        "asin(",
        "acos(",
        "atan(",
        "sqrt(",
        "exp(",
        "log(",
        "pi",
        "e",
        "x",
        "(",
        ")",
        ")",
        "+",
        "-",
        "*",
        "/",
        "^",
        "2",
        "0.5",
        "1e3",
        "9",
        " ",
        "th",
        "é",
        "\u{1F600}",
        ".",
        ",",
        "0",
        "1e-400",
        "^2",
        "\n",
    ];
    let (mut random, mut read) = (FormulaRandom(0x2545_F491_4F6C_DD1D), 0);
    for _ in 0..20_000 {
        let text: String = (0..random.below(14)).map(|_| words[random.below(words.len())]).collect();
        match Formula::parse(&text, "x") {
            Ok(formula) => {
                read += 1;
                let _ = (formula.values_at(0.0), formula.derivative(1.0, 6));
                if read % 40 == 0 {
                    let _ = formula.scanned(0.0, 1.0);
                }
            }
            Err(error) => assert!((1..=text.chars().count() + 1).contains(&error.at), "{text:?}: {error}"),
        }
    }
    assert!(read > 200, "{read}");
}

#[test]
fn deep_and_long_texts_are_refused_at_once() {
    for text in ["(".repeat(1_000_000), "-".repeat(4000), "2^".repeat(2000), "sin(".repeat(1000), "x+".repeat(3000)] {
        let error = Formula::parse(&text, "x").expect_err("too deep");
        assert!(error.message.contains("deeper than 100") || error.message.contains("at most 4096"), "{error}");
    }
    assert!(Formula::parse(&format!("{}x{}", "(".repeat(100), ")".repeat(100)), "x").is_ok());
    let many = vec!["x^1023"; 580].join("+");
    assert!(Formula::parse(&many, "x").expect_err("too many").message.contains("more than 3000 operations"));
}
