//! What is cut beside the outline is the part: bore, keyway and balance holes, and nothing else.

use super::{Bound, Check, Evidence, Explained, On, WrittenOutline, place};
use crate::body::Request;
use crate::geometry::contour::{Contour, Edge, Segment};
use crate::geometry::mismatch::{Farthest, farthest};
use crate::geometry::track::Track;
use crate::geometry::{Entity, MILLIMETRES};
use crate::reading::Chain;
use crate::report::{Finding, Verdict};
use nalgebra::Vector2;

pub(super) const CHECK: Check = Check {
    name: "bore",
    on: On::Outline,
    about: "How far what is cut beside the outline is from the bore with its keyway and the balance holes of the machine file, \
            measured from every point of either; it fails, too, where one of them is missing and where more is cut.",
    explained: Explained {
        bound: Bound::AtMost,
        formula: "max distance between what is cut beside the outline and bore, keyway and holes, both ways",
        usual: "the tolerance",
        change: "set `cam.bore_radius`, `cam.keyway` and `cam.balance` as in the file, or mend the file",
    },
    run: check,
};

/// Distances are told apart down to this share of the tolerance.
const FINE_SHARE: f64 = 1e-4;
/// Faults that are told one by one.
const MOST_TOLD: usize = 5;

/// What is wrong with what is cut beside an outline.
#[derive(Default)]
struct Judged {
    /// Largest distance, mm; infinite where something is missing or more is cut.
    value: f64,
    faults: Vec<String>,
    /// Where the first of them is.
    place: Option<Vector2<f64>>,
}

impl Judged {
    fn fault(&mut self, value: f64, words: String, place: Vector2<f64>) {
        self.value = self.value.max(value);
        self.faults.push(words);
        self.place.get_or_insert(place);
    }
}

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let judged = evidence.outlines.iter().enumerate().map(|(index, outline)| of_outline(evidence, index, outline));
    let worst = judged.max_by(|a, b| a.faults.len().cmp(&b.faults.len()).then(a.value.total_cmp(&b.value)))?;
    let verdict = Verdict::of(worst.faults.is_empty());
    let mut words: Vec<String> = worst.faults.iter().take(MOST_TOLD).cloned().collect();
    words.extend((worst.faults.len() > MOST_TOLD).then(|| format!("and {} more", worst.faults.len() - MOST_TOLD)));
    Some(Finding {
        note: (!words.is_empty()).then(|| words.join("; ")),
        place: worst.place.map(|point| place(evidence.body, point)).unwrap_or_default(),
        ..CHECK.found(worst.value, Some(evidence.tolerance_mm), "mm", verdict)
    })
}

fn of_outline(evidence: &Evidence<'_>, index: usize, outline: &WrittenOutline) -> Judged {
    let own = evidence.drawn.and_then(|drawn| drawn.parts.get(index)).map(crate::body::Part::holes);
    let balanced = evidence.body.machine().cam.balance.is_some();
    let expected = match own {
        Some(holes) => holes,
        None => evidence.body.holes_within(&outline.contour),
    };
    let judged = judge(&expected, &outline.beside, evidence.tolerance_mm);
    if judged.faults.is_empty() || !balanced || evidence.drawn.is_some() {
        return judged;
    }
    // Holes balance the outline they were drawn with; this one may be another within the tolerance.
    let request = Request::within(evidence.tolerance_mm / MILLIMETRES);
    let drawn = evidence.body.draw(&request).ok().and_then(|drawn| drawn.parts.first().map(crate::body::Part::holes));
    let again = drawn.map(|holes| judge(&holes, &outline.beside, evidence.tolerance_mm));
    again.filter(|again| again.faults.is_empty()).unwrap_or(judged)
}

/// What is cut against what should be.
fn judge(expected: &[Entity], found: &[Chain], tolerance: f64) -> Judged {
    let mut judged = Judged::default();
    let mut free: Vec<&Chain> = found.iter().collect();
    let mut missing = Vec::new();
    for (index, hole) in expected.iter().enumerate() {
        let wanted = hole.contour();
        let fits = |chain: &Chain| like(chain, &wanted, tolerance).then(|| apart(chain, &wanted, tolerance));
        let best = free
            .iter()
            .enumerate()
            .filter_map(|(place, chain)| fits(chain).map(|far| (place, far)))
            .min_by(|a, b| a.1.distance.total_cmp(&b.1.distance));
        match best {
            Some((place, far)) if far.distance <= tolerance => {
                let chain = free.remove(place);
                judged.value = judged.value.max(far.distance);
                if !runs_once(chain, &wanted, tolerance) {
                    judged.fault(far.distance, format!("{} runs to and fro", located(chain)), far.place);
                }
            }
            _ => missing.push((name(index), hole, wanted)),
        }
    }
    for (name, hole, wanted) in missing {
        // What stands in its place, if anything does.
        let near = free.iter().enumerate().filter(|(_, chain)| in_place_of(chain, &wanted));
        let near = near.map(|(place, chain)| (place, apart(chain, &wanted, tolerance)));
        match near.min_by(|a, b| a.1.distance.total_cmp(&b.1.distance)) {
            Some((place, far)) => {
                let chain = free.remove(place);
                let words = format!("{}: {}", located(chain), difference(name, hole, chain, far.distance));
                judged.fault(far.distance, words, far.place);
            }
            None => judged.fault(f64::INFINITY, format!("{name} is missing: {}", what(hole)), start(&wanted)),
        }
    }
    for chain in free {
        let words = format!("{} would be cut and is no part of the cam", located(chain));
        judged.fault(f64::INFINITY, words, centre(chain));
    }
    judged
}

fn name(index: usize) -> &'static str {
    if index == 0 { "the bore" } else { "a balance hole" }
}

fn start(contour: &Contour) -> Vector2<f64> {
    contour.vertices.first().map_or_else(Vector2::zeros, |vertex| vertex.point)
}

/// A chain for a message: what it is and where it lies.
fn located(chain: &Chain) -> String {
    let at = centre(chain);
    let kind = if chain.closed { "" } else { " (open)" };
    format!("{} at ({:.3}, {:.3}) mm{kind}", chain.names(), at.x, at.y)
}

/// The middle of what a closed chain encloses, or of the first segment of an open one.
fn centre(chain: &Chain) -> Vector2<f64> {
    let middle = chain.edges.first().map_or_else(Vector2::zeros, Edge::middle);
    let enclosed = chain.closed.then(|| chain.contour().area_and_centroid().1);
    enclosed.filter(|centre| centre.x.is_finite() && centre.y.is_finite()).unwrap_or(middle)
}

/// Whether a chain may be a contour within the tolerance: it is closed, and as large, where that is.
fn like(chain: &Chain, wanted: &Contour, tolerance: f64) -> bool {
    let (a, b) = (chain.contour().extents(), wanted.extents());
    let reach = 2.0 * tolerance;
    chain.closed && (a.least - b.least).amax() <= reach && (a.largest - b.largest).amax() <= reach
}

/// Whether a chain stands where a contour should.
fn in_place_of(chain: &Chain, wanted: &Contour) -> bool {
    let (a, b) = (chain.contour().extents(), wanted.extents());
    let apart = ((a.least + a.largest) - (b.least + b.largest)) * 0.5;
    chain.closed && apart.amax() <= 0.5 * b.size().amax()
}

/// How far a closed chain and a contour are apart, measured from every point of either.
fn apart(chain: &Chain, wanted: &Contour, tolerance: f64) -> Farthest {
    let (contour, fine) = (chain.contour(), FINE_SHARE * tolerance);
    let (there, back) = (farthest(&contour, wanted, fine), farthest(wanted, &contour, fine));
    if there.distance >= back.distance { there } else { back }
}

/// Whether a chain near a contour goes round it once without turning back.
fn runs_once(chain: &Chain, wanted: &Contour, tolerance: f64) -> bool {
    let contour = chain.contour();
    let left = if contour.area_and_centroid().0 < 0.0 { contour.reversed() } else { contour };
    let track = Track::new(wanted);
    let forwards = |edge: Edge| {
        let (middle, tangent) = edge.at(0.5);
        let along = track.nearest_segment(middle).map(|(_, nearest)| nearest.tangent);
        edge.length() <= 2.0 * tolerance || along.is_some_and(|along| along.dot(&tangent) > 0.0)
    };
    left.turns() == 1.0 && left.edges().all(forwards)
}

/// Centre and radius of a chain that is a circle.
fn circle(chain: &Chain) -> Option<(Vector2<f64>, f64)> {
    /// Of the radius: decimals of a file.
    const SAME: f64 = 1e-6;
    let segments: Vec<Segment> = chain.edges.iter().map(Edge::segment).collect::<Option<_>>()?;
    let first = segments.first().filter(|first| first.bulge != 0.0)?;
    let (centre, radius) = (first.centre(), first.radius().abs());
    let same = segments.iter().all(|segment| {
        segment.bulge != 0.0
            && (segment.centre() - centre).norm() <= SAME * radius
            && (segment.radius().abs() - radius).abs() <= SAME * radius
    });
    (chain.closed && same).then_some((centre, radius))
}

fn what(hole: &Entity) -> String {
    match hole {
        Entity::Circle(centre, radius) => {
            format!("radius {radius:.4} mm at ({:.3}, {:.3}) mm", centre.x, centre.y)
        }
        Entity::Polyline(_) => "with its keyway".into(),
    }
}

/// How what stands in the place of a hole differs from it.
fn difference(name: &str, hole: &Entity, chain: &Chain, distance: f64) -> String {
    match (hole, circle(chain)) {
        (Entity::Circle(centre, radius), Some((found, of))) => {
            let by = found - centre;
            let mut words = Vec::new();
            if (of - radius).abs() > 1e-3 * distance {
                words.push(format!("has a radius of {of:.4} mm, not {radius:.4} mm"));
            }
            if by.norm() > 1e-3 * distance {
                words.push(format!("is moved by ({:.4}, {:.4}) mm", by.x, by.y));
            }
            format!("{name} {}", words.join(" and "))
        }
        (Entity::Polyline(_), Some(_)) => format!("{name} has no keyway"),
        (Entity::Circle(..), None) => format!("{name} is no circle: up to {distance:.4} mm off"),
        (Entity::Polyline(_), None) => format!("{name} with its keyway is up to {distance:.4} mm off"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::contour::Vertex;
    use crate::reading::Source;

    fn chain(contour: &Contour) -> Chain {
        let sources = vec![Source { kind: "CIRCLE".into(), layer: "BORE".into() }];
        Chain { edges: contour.edges().collect(), closed: true, sources }
    }

    fn keyed(angle: f64, half: f64) -> Contour {
        let (radius, bottom): (f64, f64) = (25.0, 28.3);
        let edge = (radius * radius - half * half).sqrt();
        let round = (0.25 * (std::f64::consts::PI - (half / radius).asin())).tan();
        let (sin, cos) = angle.sin_cos();
        let at = |x: f64, y: f64, bulge| Vertex::new(Vector2::new(cos * x - sin * y, sin * x + cos * y), bulge);
        let far = |y| at(bottom, y, 0.0);
        Contour {
            vertices: vec![at(edge, half, round), at(-radius, 0.0, round), at(edge, -half, 0.0), far(-half), far(half)],
        }
    }

    fn words(expected: &[Entity], found: &[Chain]) -> String {
        judge(expected, found, 0.005).faults.join("; ")
    }

    #[test]
    fn each_fault_of_a_bore_is_told_by_its_name() {
        let origin = Vector2::zeros();
        let bore = [Entity::Circle(origin, 25.0)];
        let circle = |x: f64, radius: f64| chain(&Contour::circle(Vector2::new(x, 0.0), radius));
        assert_eq!(words(&bore, &[circle(0.0, 25.0)]), "");
        assert_eq!(words(&bore, &[circle(0.0049, 25.0)]), "");
        for (found, told) in [
            (vec![], "the bore is missing"),
            (vec![circle(0.0051, 25.0)], "is moved by (0.0051, 0.0000) mm"),
            (vec![circle(1.0, 25.0)], "is moved by (1.0000, 0.0000) mm"),
            (vec![circle(5.0, 25.0)], "is moved by (5.0000, 0.0000) mm"),
            (vec![circle(0.0, 60.0)], "has a radius of 60.0000 mm, not 25.0000 mm"),
            (vec![circle(0.0, 10.0)], "has a radius of 10.0000 mm"),
            (vec![circle(0.0, 25.0), circle(150.0, 60.0)], "CIRCLE on layer BORE at (150.000, 0.000) mm would be cut"),
            (vec![chain(&keyed(0.0, 4.0))], "is no circle"),
        ] {
            assert!(words(&bore, &found).contains(told), "{told}: {}", words(&bore, &found));
        }
        let keyway = [Entity::Polyline(keyed(0.3, 4.0))];
        assert_eq!(words(&keyway, &[chain(&keyed(0.3, 4.0).reversed())]), "");
        for (found, told) in [
            (circle(0.0, 25.0), "has no keyway"),
            (chain(&keyed(0.301, 4.0)), "mm off"),
            (chain(&keyed(0.3, 4.006)), "mm off"),
        ] {
            assert!(words(&keyway, &[found]).contains(told), "{told}");
        }
    }

    /// A bore that is run to and fro on its own circle is near it everywhere.
    #[test]
    fn a_bore_is_run_once() {
        let bore = [Entity::Circle(Vector2::zeros(), 25.0)];
        let arc = |from: f64, to: f64| Segment {
            start: Vector2::new(from.cos(), from.sin()) * 25.0,
            end: Vector2::new(to.cos(), to.sin()) * 25.0,
            bulge: (0.25 * (to - from)).tan(),
        };
        let segments = vec![arc(0.0, 3.0), arc(3.0, 2.9), arc(2.9, 5.0), arc(5.0, std::f64::consts::TAU)];
        let edges = segments.into_iter().map(Edge::Segment).collect();
        let to_and_fro = Chain { edges, ..chain(&Contour::circle(Vector2::zeros(), 25.0)) };
        assert!(words(&bore, &[to_and_fro]).contains("to and fro"));
    }
}
