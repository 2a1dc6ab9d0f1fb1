//! Everything that is cut apart from the outline belongs to the part: bore, keyway and balance holes, and nothing else.

use super::check::{Evidence, FileCheck, WrittenOutline, place};
use super::lead_in;
use crate::body::Request;
use crate::check::{Check, CheckExplanation, CheckScope};
use crate::reading::Chain;
use crate::report::{Bound, Finding, Verdict};
use camgen_kernel::geometry::chain_distance::{FarthestPlace, farthest_place};
use camgen_kernel::geometry::contour::{Contour, Edge, Segment};
use camgen_kernel::geometry::edge_tree::EdgeTree;
use camgen_kernel::geometry::{Entity, MILLIMETRES};
use camgen_kernel::text::{Length, LengthKind, Text, text};
use nalgebra::Vector2;

pub(super) const CHECK: FileCheck = FileCheck {
    check: Check {
        name: "bore",
        on: CheckScope::Outline,
        unit: "mm",
        about: "How far the other contours of the file are from the bore with its keyway and the balance holes of the machine file, \
                measured from every point of either. The check also fails where a hole is missing or something else would be cut.",
        explained: CheckExplanation {
            bound: Bound::AtMost,
            formula: "max distance between the contours inside the outline and bore, keyway and holes, in both directions",
            usual: "the tolerance",
            change: "set `cam.bore_radius`, `cam.keyway` and `cam.balance` as in the file, or correct the file",
        },
    },
    run: check,
};

/// Distances are distinguished down to this share of the tolerance.
const FINE_SHARE: f64 = 1e-4;
/// Most faults that are reported one by one.
const MOST_LISTED: usize = 5;

/// What is wrong with what is cut in addition to an outline.
#[derive(Default)]
struct ExtraCuts {
    /// Largest distance, mm; infinite where something is missing or something else is cut.
    value: f64,
    faults: Vec<Text>,
    /// Where the first fault is.
    place: Option<Vector2<f64>>,
    /// How many contours would be cut that are not the part, and how many of the part would not.
    more: usize,
    missing: usize,
}

/// How many contours would be cut that are not the part, and how many of the part would not, of the worst outline.
pub(crate) fn counted(evidence: &Evidence<'_>) -> Option<[usize; 2]> {
    let judged = evidence.outlines.iter().enumerate().map(|(index, outline)| of_outline(evidence, index, outline));
    judged.max_by_key(|found| found.faults.len()).map(|found| [found.more, found.missing])
}

impl ExtraCuts {
    fn fault(&mut self, value: f64, words: Text, place: Vector2<f64>) {
        self.value = self.value.max(value);
        self.faults.push(words);
        self.place.get_or_insert(place);
    }
}

fn check(evidence: &Evidence<'_>) -> Option<Finding> {
    let judged = evidence.outlines.iter().enumerate().map(|(index, outline)| of_outline(evidence, index, outline));
    let worst = judged.max_by(|a, b| a.faults.len().cmp(&b.faults.len()).then(a.value.total_cmp(&b.value)))?;
    let verdict = Verdict::of(worst.faults.is_empty());
    let mut words: Vec<Text> = worst.faults.iter().take(MOST_LISTED).cloned().collect();
    words.extend((worst.faults.len() > MOST_LISTED).then(|| text!("and {} more", worst.faults.len() - MOST_LISTED)));
    Some(Finding {
        note: (!words.is_empty()).then(|| Text::joined(words, "; ")),
        place: worst.place.map(|point| place(evidence.body, point)).unwrap_or_default(),
        ..CHECK.found(worst.value, Some(evidence.tolerance_mm), verdict)
    })
}

fn of_outline(evidence: &Evidence<'_>, index: usize, outline: &WrittenOutline) -> ExtraCuts {
    let own = evidence.drawn.and_then(|drawn| drawn.outlines().nth(index)).map(|(part, ..)| part.beside_outlines());
    let balanced = evidence.body.machine().cam.balance.is_some();
    let expected = match own {
        Some(holes) => holes,
        None => evidence.body.holes_within(&outline.contour),
    };
    let others: Vec<&Chain> = outline.others.iter().filter(|chain| !lead_in::is_lead_in(chain)).collect();
    let judged = judge(&expected, &others, evidence.tolerance_mm);
    if judged.faults.is_empty() || !balanced || evidence.drawn.is_some() {
        return judged;
    }
    // Holes balance the outline they were drawn with; the outline checked here may differ from it within the tolerance.
    let request = Request::within(evidence.tolerance_mm / MILLIMETRES);
    let drawn =
        evidence.body.draw(&request).ok().and_then(|drawn| drawn.parts.first().map(crate::body::Part::beside_outlines));
    let again = drawn.map(|holes| judge(&holes, &others, evidence.tolerance_mm));
    again.filter(|again| again.faults.is_empty()).unwrap_or(judged)
}

/// Compares what is cut with what should be.
fn judge(expected: &[Entity], found: &[&Chain], tolerance: f64) -> ExtraCuts {
    let mut judged = ExtraCuts::default();
    let mut free = found.to_vec();
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
                    judged.fault(far.distance, text!("{} runs back and forth", located(chain)), far.place);
                }
            }
            _ => missing.push((name(index, hole, expected), hole, wanted)),
        }
    }
    for (name, hole, wanted) in missing {
        // What is cut in its place, if anything.
        let near = free.iter().enumerate().filter(|(_, chain)| in_place_of(chain, &wanted));
        let near = near.map(|(place, chain)| (place, apart(chain, &wanted, tolerance)));
        if let Some((place, far)) = near.min_by(|a, b| a.1.distance.total_cmp(&b.1.distance)) {
            let chain = free.remove(place);
            let words = text!("{}: {}", located(chain), difference(name, hole, chain, far.distance));
            judged.fault(far.distance, words, far.place);
        } else {
            judged.missing += 1;
            judged.fault(f64::INFINITY, text!("{} is missing: {}", name, what(hole)), start(&wanted));
        }
    }
    for chain in free {
        judged.more += 1;
        let words = text!("{} would be cut and does not belong to the cam", located(chain));
        judged.fault(f64::INFINITY, words, centre(chain));
    }
    judged
}

fn name(index: usize, hole: &Entity, all: &[Entity]) -> &'static str {
    let larger = |radius: f64| all.first().is_some_and(|first| first.extents().largest.x < radius);
    match hole {
        Entity::Circle(centre, radius) if *centre == Vector2::zeros() && larger(*radius) => "the blank",
        _ if index == 0 => "the bore",
        _ => "a balance hole",
    }
}

fn start(contour: &Contour) -> Vector2<f64> {
    contour.vertices.first().map_or_else(Vector2::zeros, |vertex| vertex.point)
}

/// A chain for a message: what it is and where it lies.
fn located(chain: &Chain) -> Text {
    let at = centre(chain);
    let kind = if chain.closed { "" } else { " (open)" };
    let [x, y] = [at.x, at.y].map(|at| Length::mm(at).decimals(3).bare());
    let names = Some(chain.names()).filter(|names| !names.is_empty()).unwrap_or_else(|| "the contour".to_owned());
    text!("{} at ({}, {}) {}{}", names, x, y, &LengthKind::MM, kind)
}

/// The centroid of a closed chain, or the middle of the first segment of an open one.
fn centre(chain: &Chain) -> Vector2<f64> {
    let middle = chain.edges.first().map_or_else(Vector2::zeros, Edge::middle);
    let enclosed = chain.closed.then(|| chain.contour().area_and_centroid().1);
    enclosed.filter(|centre| centre.x.is_finite() && centre.y.is_finite()).unwrap_or(middle)
}

/// Whether a chain may be this contour within the tolerance: it is closed, about as large, and in the same place.
fn like(chain: &Chain, wanted: &Contour, tolerance: f64) -> bool {
    let (a, b) = (chain.contour().extents(), wanted.extents());
    let reach = 2.0 * tolerance;
    chain.closed && (a.least - b.least).amax() <= reach && (a.largest - b.largest).amax() <= reach
}

/// Whether a chain is where a contour should be.
fn in_place_of(chain: &Chain, wanted: &Contour) -> bool {
    let (a, b) = (chain.contour().extents(), wanted.extents());
    let apart = ((a.least + a.largest) - (b.least + b.largest)) * 0.5;
    chain.closed && apart.amax() <= 0.5 * b.size().amax()
}

/// Largest distance between a closed chain and a contour, measured from every point of either.
fn apart(chain: &Chain, wanted: &Contour, tolerance: f64) -> FarthestPlace {
    let (contour, fine) = (chain.contour(), FINE_SHARE * tolerance);
    let (there, back) = (farthest_place(&contour, wanted, fine), farthest_place(wanted, &contour, fine));
    if there.distance >= back.distance { there } else { back }
}

/// Whether a chain near a contour goes round it once without turning back.
fn runs_once(chain: &Chain, wanted: &Contour, tolerance: f64) -> bool {
    let contour = chain.contour();
    let left = if contour.area_and_centroid().0 < 0.0 { contour.reversed() } else { contour };
    let tree = EdgeTree::new(wanted);
    let forwards = |edge: Edge| {
        let (middle, tangent) = edge.point_and_tangent(0.5);
        let along = tree.nearest_segment(middle).map(|(_, nearest)| nearest.tangent);
        edge.length() <= 2.0 * tolerance || along.is_some_and(|along| along.dot(&tangent) > 0.0)
    };
    left.turns() == 1.0 && left.edges().all(forwards)
}

/// Centre and radius of a chain that is a circle.
fn circle(chain: &Chain) -> Option<(Vector2<f64>, f64)> {
    /// Decimals of the radius in a file.
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

fn what(hole: &Entity) -> Text {
    match hole {
        Entity::Circle(centre, radius) => {
            text!(
                "radius {} at ({}, {}) {}",
                Length::mm(*radius).decimals(4),
                Length::mm(centre.x).decimals(3).bare(),
                Length::mm(centre.y).decimals(3).bare(),
                &LengthKind::MM
            )
        }
        Entity::Polyline(_) | Entity::Segment(_) => "with its keyway".into(),
    }
}

/// How the contour found in the place of a hole differs from it.
fn difference(name: &str, hole: &Entity, chain: &Chain, distance: f64) -> Text {
    match (hole, circle(chain)) {
        (Entity::Circle(centre, radius), Some((found, of))) => {
            let by = found - centre;
            let mut words = Vec::new();
            if (of - radius).abs() > 1e-3 * distance {
                words.push(text!(
                    "has a radius of {}, not {}",
                    Length::mm(of).decimals(4),
                    Length::mm(*radius).decimals(4)
                ));
            }
            if by.norm() > 1e-3 * distance {
                let [x, y] = [by.x, by.y].map(|by| Length::mm(by).decimals(4).bare());
                words.push(text!("is moved by ({}, {}) {}", x, y, &LengthKind::MM));
            }
            text!("{} {}", name, Text::joined(words, " and "))
        }
        (Entity::Polyline(_) | Entity::Segment(_), Some(_)) => text!("{} has no keyway", name),
        (Entity::Circle(..), None) => {
            text!("{} is not a circle: it deviates by up to {}", name, Length::mm(distance).decimals(4))
        }
        (Entity::Polyline(_) | Entity::Segment(_), None) => {
            text!("{} with its keyway deviates by up to {}", name, Length::mm(distance).decimals(4))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reading::EntitySource;
    use camgen_kernel::geometry::contour::Vertex;

    fn chain(contour: &Contour) -> Chain {
        let sources = vec![EntitySource { kind: "CIRCLE".into(), layer: "BORE".into() }];
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
        Text::joined(judge(expected, &found.iter().collect::<Vec<_>>(), 0.005).faults, "; ").to_string()
    }

    #[test]
    fn each_fault_of_a_bore_is_reported_by_its_name() {
        let origin = Vector2::zeros();
        let bore = [Entity::Circle(origin, 25.0)];
        let circle = |x: f64, radius: f64| chain(&Contour::circle(Vector2::new(x, 0.0), radius));
        assert_eq!(words(&bore, &[circle(0.0, 25.0)]), "");
        assert_eq!(words(&bore, &[circle(0.0049, 25.0)]), "");
        for (found, wanted) in [
            (vec![], "the bore is missing"),
            (vec![circle(0.0051, 25.0)], "is moved by (0.0051, 0.0000) mm"),
            (vec![circle(1.0, 25.0)], "is moved by (1.0000, 0.0000) mm"),
            (vec![circle(5.0, 25.0)], "is moved by (5.0000, 0.0000) mm"),
            (vec![circle(0.0, 60.0)], "has a radius of 60.0000 mm, not 25.0000 mm"),
            (vec![circle(0.0, 10.0)], "has a radius of 10.0000 mm"),
            (vec![circle(0.0, 25.0), circle(150.0, 60.0)], "CIRCLE on layer BORE at (150.000, 0.000) mm would be cut"),
            (vec![chain(&keyed(0.0, 4.0))], "is not a circle"),
        ] {
            assert!(words(&bore, &found).contains(wanted), "{wanted}: {}", words(&bore, &found));
        }
        let keyway = [Entity::Polyline(keyed(0.3, 4.0))];
        assert_eq!(words(&keyway, &[chain(&keyed(0.3, 4.0).reversed())]), "");
        for (found, wanted) in [
            (circle(0.0, 25.0), "has no keyway"),
            (chain(&keyed(0.301, 4.0)), "deviates by up to"),
            (chain(&keyed(0.3, 4.006)), "deviates by up to"),
        ] {
            assert!(words(&keyway, &[found]).contains(wanted), "{wanted}");
        }
    }

    /// A bore that runs back and forth on its own circle is near it everywhere.
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
        let back_and_forth = Chain { edges, ..chain(&Contour::circle(Vector2::zeros(), 25.0)) };
        assert!(words(&bore, &[back_and_forth]).contains("back and forth"));
    }
}
