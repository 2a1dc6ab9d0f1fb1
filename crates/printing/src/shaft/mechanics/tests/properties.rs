//! What must hold of every shaft, on shafts by chance: none of it shares a formula with the method.

use super::super::exact::{Statics, response};
use super::super::paper::first_critical;
use super::*;
use camgen_kernel::numeric::quadrature::integrate;

/// SplitMix64 (G. L. Steele et al. 2014).
struct Random(u64);

impl Random {
    /// In [low, high).
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        let bits = u32::try_from((z ^ (z >> 31)) >> 32).expect("32 bits");
        low + (high - low) * (f64::from(bits) / 4_294_967_296.0)
    }

    fn count(&mut self, most: u32) -> usize {
        (1..most).filter(|_| self.between(0.0, 1.0) < 0.6).count() + 1
    }

    fn segments(&mut self) -> Vec<ShaftSegment> {
        let count = self.count(5);
        (0..count)
            .map(|_| {
                let diameter = self.between(0.03, 0.12);
                let bore = if self.between(0.0, 1.0) < 0.5 { 0.0 } else { diameter * self.between(0.1, 0.8) };
                ShaftSegment { bore, poisson: self.between(0.2, 0.35), ..steel(self.between(0.05, 0.5), diameter) }
            })
            .collect()
    }

    /// Two or three, rigid or from 1e6 to 1e9 N/m.
    fn supports(&mut self, length: f64) -> Vec<Support> {
        let mut support = |low, high| {
            let at = length * self.between(low, high);
            let soft = self.between(0.0, 1.0) < 0.6;
            let stiffness = libm::exp10(self.between(6.0, 9.0));
            Support { at, stiffness: soft.then_some(stiffness) }
        };
        let ends = vec![support(0.0, 0.2), support(0.7, 1.0)];
        let inner = support(0.3, 0.6);
        if self.between(0.0, 1.0) < 0.3 { [ends, vec![inner]].concat() } else { ends }
    }

    fn disc(&mut self, length: f64) -> ShaftDisc {
        let mass = self.between(1.0, 30.0);
        let diametral_inertia = mass * self.between(0.001, 0.01);
        ShaftDisc {
            at: length * self.between(0.0, 1.0),
            mass,
            diametral_inertia,
            polar_inertia: diametral_inertia * self.between(0.2, 2.0),
            unbalance: [self.between(-1e-3, 1e-3), self.between(-1e-3, 1e-3)],
        }
    }

    fn shaft(&mut self, beam: Beam, discs: bool) -> Shaft {
        let segments = self.segments();
        let length: f64 = segments.iter().map(|s| s.length).sum();
        let supports = self.supports(length);
        let discs = if discs { vec![self.disc(length), self.disc(length)] } else { Vec::new() };
        shaft(&segments, supports, &discs, beam)
    }
}

/// Shafts by chance, of both theories.
fn each(seed: u64, discs: bool, mut judge: impl FnMut(&Shaft, &mut Random)) {
    let mut random = Random(seed);
    for round in 0..24 {
        let beam = if round % 2 == 0 { Beam::Timoshenko } else { Beam::Euler };
        let shaft = random.shaft(beam, discs);
        judge(&shaft, &mut random);
    }
}

const WHIRLS: [Whirl; 3] = [Whirl::Backward, Whirl::Planar, Whirl::Forward];

/// Rounding of an eigenvalue is ε of the largest, so that of a speed ε (ω_j/ω_1)²; three modes here are within 1e3.
#[track_caller]
fn same(got: &[f64], want: &[f64], factor: f64) {
    let first = want.first().copied().expect("modes");
    for (got, want) in got.iter().zip(want) {
        let ratio = want / first;
        close(*got, want * factor, 2e-13 + 200.0 * f64::EPSILON * ratio * ratio);
    }
}

#[test]
fn a_mirrored_shaft_has_the_same_speeds() {
    each(1, true, |shaft, _| {
        let length = shaft.length();
        let segments = shaft.segments().iter().rev().copied().collect();
        let supports = shaft.supports().iter().map(|s| Support { at: length - s.at, ..*s }).collect();
        let discs = shaft.discs().iter().map(|d| ShaftDisc { at: length - d.at, ..*d }).collect();
        let mirrored = Shaft::new(segments, supports, discs, shaft.beam()).expect("in order");
        for whirl in WHIRLS {
            same(&speeds(&mirrored, whirl, 2), &speeds(shaft, whirl, 2), 1.0);
        }
    });
}

/// A massless, inertia-less disc cuts a panel and changes nothing.
#[test]
fn a_segment_cut_in_two_is_the_same() {
    each(2, true, |shaft, random| {
        let mut discs = shaft.discs().to_vec();
        discs.push(disc(shaft.length() * random.between(0.0, 1.0), 0.0, 0.0, 0.0));
        let cut = shaft.with_discs(discs).expect("in order");
        for whirl in WHIRLS {
            same(&speeds(&cut, whirl, 2), &speeds(shaft, whirl, 2), 1.0);
        }
    });
}

#[test]
fn stiffness_raises_and_mass_lowers() {
    // What rounding may do to a speed that does not change.
    let slack = 1.0 + 1e-11;
    each(3, true, |shaft, random| {
        let before = speeds(shaft, Whirl::Planar, 3);
        let stiffer = shaft.supports().iter().map(|s| Support { stiffness: s.stiffness.map(|k| 2.0 * k), ..*s });
        let stiffer = Shaft::new(shaft.segments().to_vec(), stiffer.collect(), shaft.discs().to_vec(), shaft.beam());
        for (after, before) in speeds(&stiffer.expect("in order"), Whirl::Planar, 3).iter().zip(&before) {
            assert!(after * slack >= *before, "{after} {before}");
        }
        let mut discs = shaft.discs().to_vec();
        discs[0].mass *= 1.0 + random.between(0.1, 2.0);
        let heavier = shaft.with_discs(discs).expect("in order");
        for (after, before) in speeds(&heavier, Whirl::Planar, 3).iter().zip(&before) {
            assert!(*after <= before * slack, "{after} {before}");
        }
    });
}

/// Four times modulus, density and stiffness is the same shaft in other units of force.
#[test]
fn units_of_force_do_not_matter() {
    each(4, false, |shaft, _| {
        let segments = shaft.segments().iter();
        let segments =
            segments.map(|s| ShaftSegment { modulus: 4.0 * s.modulus, density: 4.0 * s.density, ..*s }).collect();
        let supports = shaft.supports().iter().map(|s| Support { stiffness: s.stiffness.map(|k| 4.0 * k), ..*s });
        let other = Shaft::new(segments, supports.collect(), Vec::new(), shaft.beam()).expect("in order");
        for whirl in WHIRLS {
            same(&speeds(&other, whirl, 3), &speeds(shaft, whirl, 3), 1.0);
        }
    });
}

#[test]
fn a_larger_copy_on_rigid_supports_is_slower_in_proportion() {
    each(5, false, |shaft, random| {
        let c = random.between(0.1, 10.0);
        let supports = |c: f64| rigid(&shaft.supports().iter().map(|s| c * s.at).collect::<Vec<f64>>());
        let small = Shaft::new(shaft.segments().to_vec(), supports(1.0), Vec::new(), shaft.beam()).expect("in order");
        let grown =
            |s: &ShaftSegment| ShaftSegment { length: c * s.length, diameter: c * s.diameter, bore: c * s.bore, ..*s };
        let segments = shaft.segments().iter().map(grown).collect();
        let large = Shaft::new(segments, supports(c), Vec::new(), shaft.beam()).expect("in order");
        for whirl in WHIRLS {
            same(&speeds(&large, whirl, 3), &speeds(&small, whirl, 3), 1.0 / c);
        }
    });
}

#[test]
fn forward_runs_before_planar_before_backward() {
    each(6, true, |shaft, _| {
        let [backward, planar, forward] = WHIRLS.map(|whirl| speeds(shaft, whirl, 1));
        for ((backward, planar), forward) in backward.iter().zip(&planar).zip(&forward) {
            assert!(*backward <= planar * (1.0 + 1e-12) && *planar <= forward * (1.0 + 1e-12), "{shaft:?}");
        }
    });
}

/// Maxwell: the deflection here under 1 N there is that there under 1 N here; the supports carry the load and its moment.
#[test]
fn deflections_are_mutual_and_reactions_balance() {
    each(7, false, |shaft, random| {
        let place = |random: &mut Random| shaft.length() * random.between(0.0, 1.0);
        let (a, b) = (place(random), place(random));
        let (at_a, at_b) = (Statics::new(shaft, a).expect("on it"), Statics::new(shaft, b).expect("on it"));
        let size = at_a.own_compliance().max(at_b.own_compliance());
        assert!((at_a.compliance(b) - at_b.compliance(a)).abs() < 1e-13 * size);
        close(at_a.compliance(a), at_a.own_compliance(), 1e-12);
        close(at_a.reactions.iter().sum(), 1.0, 1e-12);
        let moment: f64 = at_a.reactions.iter().zip(shaft.supports()).map(|(r, s)| r * s.at).sum();
        assert!((moment - a).abs() < 1e-12 * shaft.length(), "{moment} {a}");
        for (force, support) in at_a.reactions.iter().zip(shaft.supports()) {
            let stands = at_a.compliance(support.at);
            let yields = support.stiffness.map_or(0.0, |k| force / k);
            assert!((stands - yields).abs() < 1e-13 * size, "{stands} {yields}");
        }
    });
}

/// Rayleigh: ω² ∫ ρA y² + … is the energy of the bent shaft, here of the curve itself by its work on the static shaft: the
/// deflection under the inertia forces ω² ρA y, by [`Statics`], is y again.
#[test]
fn a_mode_is_bent_by_its_own_inertia() {
    each(8, false, |shaft, random| {
        if shaft.beam() == Beam::Timoshenko {
            return;
        }
        let all = found(shaft, Whirl::Planar, 2).modes;
        let x = shaft.length() * random.between(0.1, 0.9);
        let statics = Statics::new(shaft, x).expect("on it");
        for mode in &all {
            let mut sum = 0.0;
            let mut left = 0.0;
            for segment in shaft.segments() {
                let right = left + segment.length;
                // The influence line has a kink at the load and third derivatives that jump at the supports.
                let mut ends = vec![left, x, right];
                ends.extend(shaft.supports().iter().map(|s| s.at));
                ends.retain(|at| (left..=right).contains(at));
                ends.sort_by(f64::total_cmp);
                for pair in ends.windows(2) {
                    let load = |x: f64| segment.density * segment.area() * mode.shape.evaluate(x)[0];
                    sum += integrate(|x| load(x) * statics.compliance(x), (pair[0], pair[1]), 2);
                }
                left = right;
            }
            let [y, _] = mode.shape.evaluate(x);
            assert!((mode.speed * mode.speed * sum - y).abs() < 1e-11, "{} {y}", mode.speed * mode.speed * sum);
            let (at, largest) = mode.shape.largest();
            assert!((largest - 1.0).abs() < 1e-14 && (0.0..=shaft.length()).contains(&at));
        }
    });
}

/// The response by its modes is that by its matrix: here near the first critical speed, where one mode is all of it, and far
/// below, where the inertia of the shaft does nothing.
#[test]
fn the_response_is_that_of_the_modes_and_of_statics() {
    each(9, true, |shaft, _| {
        let first = found(shaft, Whirl::Forward, 1).modes.remove(0);
        let x = shaft.length() * 0.45;
        let slow = response(shaft, 1e-4 * first.speed).expect("slow");
        for direction in 0..2 {
            let under = |d: &ShaftDisc| {
                Statics::new(shaft, d.at).expect("on it").compliance(x)
                    * d.unbalance[direction]
                    * first.speed.powi(2)
                    * 1e-8
            };
            let still: f64 = shaft.discs().iter().map(under).sum();
            let size: f64 = shaft.discs().iter().map(|d| under(d).abs()).sum();
            assert!((slow.deflection_at(x)[direction] - still).abs() < 1e-7 * size);
        }
        // Just below the critical speed the forces go through the mode: the curve is the mode's.
        let near = response(shaft, first.speed * (1.0 - 1e-9)).expect("near");
        let (at, _) = first.shape.largest();
        let scale = near.deflection_at(at)[0];
        let got = near.deflection_at(x)[0] / scale;
        assert!((got - first.shape.evaluate(x)[0]).abs() < 1e-5, "{got} {}", first.shape.evaluate(x)[0]);
    });
}

/// The supports carry what the unbalances and the bent masses throw outward, and its moment: sums over the curve alone.
#[test]
fn the_response_is_in_equilibrium() {
    each(11, true, |shaft, random| {
        let speed = random.between(0.3, 3.0) * found(shaft, Whirl::Forward, 1).modes[0].speed;
        let turning = response(shaft, speed).expect("between critical speeds");
        let square = speed * speed;
        let mut cuts: Vec<f64> = shaft.steps();
        cuts.extend([0.0, shaft.length()]);
        cuts.extend(shaft.supports().iter().map(|s| s.at).chain(shaft.discs().iter().map(|d| d.at)));
        cuts.sort_by(f64::total_cmp);
        for direction in 0..2 {
            let y = |x: f64| turning.deflection_at(x)[direction];
            let slope = |x: f64| turning.slope_at(x)[direction];
            let (mut force, mut moment, mut size) = (0.0, 0.0, 0.0);
            for disc in shaft.discs() {
                let out = square * (disc.unbalance[direction] + disc.mass * y(disc.at));
                let turn = square * (disc.diametral_inertia - disc.polar_inertia) * slope(disc.at);
                (force, moment, size) = (force + out, moment + out * disc.at + turn, size + out.abs());
            }
            let mut left = 0.0;
            for segment in shaft.segments() {
                let right = left + segment.length;
                let within: Vec<f64> = cuts.iter().copied().filter(|at| (left..=right).contains(at)).collect();
                // In forward whirl ρJ − 2ρJ of the sections turns with the slope; an Euler beam has none.
                let rotary = match shaft.beam() {
                    Beam::Timoshenko => -segment.density * segment.second_moment(),
                    Beam::Euler => 0.0,
                };
                let mass = square * segment.density * segment.area();
                for pair in within.windows(2) {
                    let over = |f: &dyn Fn(f64) -> f64| integrate(f, (pair[0], pair[1]), 4);
                    let out = mass * over(&y);
                    size += out.abs();
                    force += out;
                    moment += mass * over(&|x| x * y(x)) + square * rotary * over(&slope);
                }
                left = right;
            }
            let held: f64 = turning.support_forces.iter().map(|f| f[direction]).sum();
            let about: f64 =
                turning.support_forces.iter().zip(shaft.supports()).map(|(f, s)| f[direction] * s.at).sum();
            // Between critical speeds the sums are of terms larger than themselves.
            assert!((held - force).abs() < 1e-10 * size, "{held} {force} {size}");
            assert!((about - moment).abs() < 1e-10 * size * shaft.length(), "{about} {moment} {size}");
        }
    });
}

/// The paper's method comes to the exact Euler speeds as the square of the station's length; discs are points to it.
#[test]
fn stations_come_to_the_exact_speeds() {
    each(10, false, |shaft, random| {
        if shaft.beam() == Beam::Timoshenko || shaft.supports().len() != 2 {
            return;
        }
        let point = disc(shaft.length() * random.between(0.0, 1.0), random.between(1.0, 20.0), 0.0, 0.0);
        let shaft = shaft.with_discs(vec![point]).expect("in order");
        let exact = speeds(&shaft, Whirl::Planar, 1)[0];
        let error = |stations| first_critical(&shaft, stations).expect("converges").speed / exact - 1.0;
        assert!(error(1800).abs() < 2e-5 && error(18_000).abs() < 2e-7, "{:e} {:e}", error(1800), error(18_000));
    });
}

#[test]
fn sections_steps_and_mass_are_those_of_the_segments() {
    let min_concave_radius = ShaftSegment { bore: 0.02, ..steel(0.2, 0.06) };
    let shaft = shaft(
        &[steel(0.1, 0.05), steel(0.2, 0.05), min_concave_radius],
        rigid(&[0.0, 0.5]),
        &[disc(0.1, 3.0, 0.0, 0.0)],
        Beam::Euler,
    );
    assert_eq!(shaft.segments().len(), 2);
    assert_eq!(shaft.steps(), [0.1 + 0.2]);
    assert_eq!(shaft.section_at(0.3, StepSide::Left), (0.05, 0.0));
    assert_eq!(shaft.section_at(0.3, StepSide::Right), (0.06, 0.02));
    assert_eq!(shaft.section_at(0.0, StepSide::Left), (0.05, 0.0));
    assert_eq!(shaft.section_at(0.5, StepSide::Right), (0.06, 0.02));
    let area = |d: f64| 0.25 * PI * d * d;
    close(shaft.mass(), 7850.0 * (0.3 * area(0.05) + 0.2 * (area(0.06) - area(0.02))) + 3.0, 1e-14);
    let thick = shaft.scaled(2.0).expect("in order");
    assert_eq!(thick.section_at(0.4, StepSide::Left), (0.12, 0.04));
    close(thick.twist_compliance(0.0, 0.5), shaft.twist_compliance(0.0, 0.5) / 16.0, 1e-14);
    let soft = shaft.with_stiffness(1e6).expect("in order");
    assert_eq!(soft.supports(), shaft.supports());
    let stiffer = uniform(springs(&[0.0, 1.0], 1e3), Beam::Euler).with_stiffness(1e7).expect("in order");
    runs(&stiffer, Whirl::Planar, &[5_413.510_214_810_984], 1e-11);
}

/// A, J and κ of a tube: the difference of two circles, and Cowper's limits 6(1 + ν)/(7 + 6ν) and 2(1 + ν)/(4 + 3ν).
#[test]
fn the_section_of_a_tube() {
    let tube = ShaftSegment { bore: 0.03, ..steel(1.0, 0.05) };
    let circle = |d: f64| (0.25 * PI * d * d, PI * d.powi(4) / 64.0);
    close(tube.area(), circle(0.05).0 - circle(0.03).0, 1e-14);
    close(tube.second_moment(), circle(0.05).1 - circle(0.03).1, 1e-14);
    close(steel(1.0, 0.05).shear_coefficient(), 6.0 * 1.3 / (7.0 + 6.0 * 0.3), 1e-15);
    let thin = ShaftSegment { bore: 0.05 * (1.0 - 1e-9), ..tube };
    close(thin.shear_coefficient(), 2.0 * 1.3 / (4.0 + 3.0 * 0.3), 1e-9);
    close(tube.shear_modulus(), 210e9 / 2.6, 1e-15);
}

/// Crests that differ little hide between samples; the largest of all is 1, wherever it is.
#[test]
fn no_place_of_a_mode_is_beyond_one() {
    each(12, true, |shaft, _| {
        for mode in found(shaft, Whirl::Planar, 6).modes {
            let places = (0..=4000_u32).map(|k| shaft.length() * f64::from(k) / 4000.0);
            let most = places.map(|x| mode.shape.evaluate(x)[0].abs()).fold(0.0, f64::max);
            // A thousandth of a wave between the samples.
            assert!(most <= 1.0 + 1e-12 && most > 1.0 - 1e-3, "{most}");
            close(mode.shape.largest().1, 1.0, 1e-12);
        }
    });
}
