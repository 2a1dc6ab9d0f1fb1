//! Energy of a bed braked by plain buffers alone: the integral the drive-speed method rests on (Voloshchak & Denis).

use super::{Cylinder, PlainBuffer};

/// Work W(x) of the pair of cylinders over the overrun x, J:
/// 2 p0 F [ L/(k−1) ((L/(L−x))^(k−1) − 1) − x ], with its limit −L ln(1 − x/L) − x at k = 1.
#[must_use]
pub fn plain_work(cylinder: &Cylinder, plain: &PlainBuffer, x: f64) -> f64 {
    let (column, power) = (plain.column, cylinder.exponent - 1.0);
    let log = -libm::log1p(-x / column);
    let integral = if power == 0.0 { log } else { libm::expm1(power * log) / power };
    cylinder.unit_force() * (column * integral - x)
}

/// Speed of a bed of the given mass after it has done `work`, m/s; `None` when it has less energy than that.
#[must_use]
pub fn speed_after(mass: f64, start_speed: f64, work: f64) -> Option<f64> {
    let square = start_speed * start_speed - 2.0 * work / mass;
    (square >= 0.0).then(|| square.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::press::buffer::tests::reference;
    use camgen_kernel::numeric::quadrature;

    #[test]
    fn work_is_the_integral_of_the_force() {
        let (bed, cylinder) = reference(2.0);
        let plain = PlainBuffer::new(cylinder.loading(35.0), cylinder.exponent, bed.crank_radius);
        for x in [0.02, 0.09, 0.18] {
            let by_force = cylinder.unit_force() * quadrature::integrate(|x| plain.air(x), (0.0, x), 16);
            let work = plain_work(&cylinder, &plain, x);
            assert!((work / by_force - 1.0).abs() < 1e-12, "{x}: {work} and {by_force}");
        }
    }

    /// Table 1 of Voloshchak & Denis: m = 1.28 kgf·s²/cm, r = 18 cm, v0 = 160 cm/s, x = r φ before the crank turns the
    /// bed; buffer force and speed every 10°. Slide-rule figures: ±0.5 %.
    #[test]
    fn the_paper_s_table_of_speeds() {
        let force = [0.0, 30.0, 66.0, 106.0, 157.0, 219.0, 297.0];
        let speed = [160.0, 160.0, 159.0, 157.7, 155.6, 152.6, 149.0];
        let step = 18.0 * 10.0_f64.to_radians();
        let mut work = 0.0;
        for i in 0..speed.len() {
            if i > 0 {
                work += 0.5 * (force[i - 1] + force[i]) * step;
            }
            let got = speed_after(1.28, 160.0, work).expect("the bed moves on");
            assert!((got / speed[i] - 1.0).abs() < 5e-3, "{}°: {got} is not {}", 10 * i, speed[i]);
        }
        assert_eq!(speed_after(1.28, 160.0, 1e6), None);
    }
}
