//! The static unbalance of a disc and the holes that cancel it.

use crate::geometry::contour::Contour;
use nalgebra::Vector2;
use std::f64::consts::PI;

/// Most holes that are tried.
const MOST_HOLES: u32 = 12;
/// Metal between neighbouring holes, over their radius.
const BETWEEN: f64 = 0.25;
/// Halvings of the radius of a hole: to rounding.
const HALVINGS: u32 = 60;

/// The result of balancing, in the drawing plane, mm.
#[derive(Debug, Clone, PartialEq)]
pub struct Balancing {
    /// Holes, centre and radius; none when it could not be done.
    pub holes: Vec<(Vector2<f64>, f64)>,
    /// Area moment about the shaft before, mm³.
    pub before: f64,
    /// Area moment about the shaft after, mm³.
    pub after: f64,
}

/// First moment of a face about the shaft, mm³.
#[must_use]
pub fn moment(contour: &Contour) -> Vector2<f64> {
    let (area, centroid) = contour.area_and_centroid();
    centroid * area
}

/// The fewest equal holes within a band of radii (mm) that cancel the moment of the face, symmetric about the heavy
/// side, with `wall` (mm) of metal to the outline. `bore` is the bore with its keyway, if any.
///
/// n holes of radius a at the distance ρ = outer − a, Δ apart, take away π a² ρ sin(nΔ/2)/sin(Δ/2).
#[must_use]
pub fn balance(outline: &Contour, bore: Option<&Contour>, band: (f64, f64), wall: f64) -> Balancing {
    let moment = moment(outline) - bore.map_or_else(Vector2::zeros, moment);
    let before = moment.norm();
    let none = Balancing { holes: Vec::new(), before, after: before };
    if before == 0.0 {
        return none;
    }
    let (inner, outer) = band;
    let heavy = moment / before;
    for count in 1..=MOST_HOLES {
        let spread = |a: f64| {
            let distance = outer - a;
            let half = libm::asin(((a * (1.0 + 0.5 * BETWEEN)) / distance).min(1.0));
            (distance, 2.0 * half)
        };
        let taken = |a: f64| {
            let (distance, apart) = spread(a);
            let sum = if count == 1 { 1.0 } else { libm::sin(0.5 * f64::from(count) * apart) / libm::sin(0.5 * apart) };
            PI * a * a * distance * sum
        };
        let mut high = 0.5 * (outer - inner);
        // Holes on more than a half circle work against each other.
        if f64::from(count) * spread(high).1 > PI {
            high = outer / (1.0 + (1.0 + 0.5 * BETWEEN) / libm::sin(0.5 * PI / f64::from(count)));
        }
        if taken(high) < before {
            continue;
        }
        let mut low = 0.0;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if taken(middle) < before { low = middle } else { high = middle }
        }
        let (distance, apart) = spread(high);
        let holes: Vec<(Vector2<f64>, f64)> = (0..count)
            .map(|i| {
                let angle = (f64::from(i) - 0.5 * f64::from(count - 1)) * apart;
                let (sin, cos) = (libm::sin(angle), libm::cos(angle));
                (Vector2::new(cos * heavy.x - sin * heavy.y, sin * heavy.x + cos * heavy.y) * distance, high)
            })
            .collect();
        let fits = |(centre, radius): &(Vector2<f64>, f64)| {
            let nearest =
                outline.segments().map(|s| s.nearest(*centre).left).min_by(|a, b| a.abs().total_cmp(&b.abs()));
            nearest.is_some_and(|left| left >= radius + wall)
        };
        if holes.iter().all(fits) {
            let left = holes.iter().fold(moment, |m, (centre, radius)| m - centre * (PI * radius * radius));
            return Balancing { holes, before, after: left.norm() };
        }
    }
    none
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_eccentric_disc_is_balanced_within_its_band() {
        let disc = Contour::circle(Vector2::new(3.0, 4.0), 100.0);
        assert!((moment(&disc).norm() - 5.0 * PI * 1e4).abs() < 1e-8);
        for (band, count) in [((10.0, 80.0), 1), ((20.0, 80.0), 2)] {
            let balancing = balance(&disc, None, band, 2.0);
            assert_eq!(balancing.holes.len(), count, "{balancing:?}");
            assert!(balancing.after < 1e-9 * balancing.before);
            for (centre, radius) in &balancing.holes {
                assert!(centre.norm() + radius <= band.1 + 1e-9 && centre.norm() - radius >= band.0 - 1e-9);
                assert!(centre.dot(&Vector2::new(3.0, 4.0)) > 0.0, "on the heavy side");
            }
        }
        let narrow = balance(&disc, None, (60.0, 61.0), 2.0);
        assert!(narrow.holes.is_empty() && narrow.after == narrow.before);
        assert_eq!(balance(&Contour::circle(Vector2::zeros(), 100.0), None, (20.0, 80.0), 2.0).holes.len(), 0);
    }
}
