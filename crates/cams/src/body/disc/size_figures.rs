//! The section of the report on a size that was to be chosen.

use super::Disc;
use crate::report::Section;
use camgen_kernel::follower::FollowerPlacement;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::text::{Length, Text, text};
use serde::Serialize;

/// The section `size`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SizeFigures {
    /// The sizes that were to be chosen.
    pub free: Vec<&'static str>,
    /// The limit that a smaller cam breaks; `bore` for the metal about the bore, `reach` where the follower would not reach.
    pub binding: Option<&'static str>,
    /// Cam angle of the place where it is broken, degrees.
    pub binding_cam_deg: Option<f64>,
    /// Prime radius of the smallest cam with the follower in its place.
    pub smallest_prime_radius_mm: Option<f64>,
    /// Base radius of that cam.
    pub smallest_base_radius_mm: Option<f64>,
    /// The chosen offset.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub offset_mm: Option<f64>,
    /// The chosen pivot distance.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pivot_distance_mm: Option<f64>,
    /// Before it was rounded, with the prime radius there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub best: Option<BestPlace>,
}

/// A choice of the follower's place and the size with it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct BestPlace {
    /// Offset of its path.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub offset_mm: Option<f64>,
    /// From the shaft to its pivot.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pivot_distance_mm: Option<f64>,
    /// Prime radius of the cam.
    pub prime_radius_mm: f64,
}

impl BestPlace {
    /// A choice and the prime radius with it, m.
    #[must_use]
    pub fn of(place: FollowerPlacement, (choice, prime_radius): (f64, f64)) -> Self {
        let [offset_mm, pivot_distance_mm] = by_key(place, choice);
        Self { offset_mm, pivot_distance_mm, prime_radius_mm: MILLIMETRES * prime_radius }
    }
}

/// A choice (m) in millimetres, as offset or as pivot distance.
fn by_key(place: FollowerPlacement, choice: f64) -> [Option<f64>; 2] {
    let mm = MILLIMETRES * choice;
    match place {
        FollowerPlacement::Offset { .. } => [Some(mm), None],
        FollowerPlacement::Pivot { .. } => [None, Some(mm)],
    }
}

impl Disc {
    /// The section on its size, where that was to be chosen.
    pub(super) fn size_section(&self) -> Option<Section> {
        let free_base = self.machine.cam.base_radius.is_none();
        if !self.is_of_program() || !(free_base || self.placed().is_some()) {
            return None;
        }
        let figures = self.size();
        let words = self.size_words(&figures);
        Some(Section::new("size", &figures).with_words(words))
    }

    /// The figures of its smallest size.
    #[must_use]
    pub fn size(&self) -> SizeFigures {
        let placed = self.placed();
        let binding = self.binding();
        let [offset_mm, pivot_distance_mm] = placed.map_or([None; 2], |placed| by_key(placed.place, placed.chosen));
        let free = self.machine.cam.base_radius.is_none().then_some("base_radius");
        SizeFigures {
            free: free.into_iter().chain(placed.map(|placed| placed.place.key())).collect(),
            binding: binding.map(|binding| binding.limit),
            binding_cam_deg: binding.and_then(|binding| binding.at).map(|at| at.at.to_degrees().rem_euclid(360.0)),
            smallest_prime_radius_mm: self.smallest_prime_radius().map(|radius| MILLIMETRES * radius),
            smallest_base_radius_mm: self
                .smallest_prime_radius()
                .map(|radius| MILLIMETRES * (radius - self.curves().offset())),
            offset_mm,
            pivot_distance_mm,
            best: placed.map(|placed| BestPlace::of(placed.place, placed.best)),
        }
    }

    /// These figures in words.
    #[must_use]
    pub fn size_words(&self, figures: &SizeFigures) -> Vec<Text> {
        let mut words = Vec::new();
        if let (Some(radius), Some(binding)) = (figures.smallest_base_radius_mm, figures.binding) {
            let why = match (binding, figures.binding_cam_deg) {
                ("bore", _) => "leaves too little metal about the bore".to_owned(),
                ("reach", _) => "is out of the follower's reach".to_owned(),
                (limit, Some(at)) => format!("breaks limits.{limit} at {at:.3}°"),
                (limit, None) => format!("breaks limits.{limit}"),
            };
            words.push(text!("smallest base radius {}: a smaller one {}", Length::mm(radius).decimals(4), why));
        }
        if let (Some(placed), Some(best)) = (self.placed(), figures.best) {
            let name =
                if matches!(placed.place, FollowerPlacement::Offset { .. }) { "offset" } else { "pivot distance" };
            let (chosen, exact) = (MILLIMETRES * placed.chosen, MILLIMETRES * placed.best.0);
            let of = best.prime_radius_mm;
            let exactly = if self.machine.cam.base_radius.is_some() {
                text!("the least pressure angle is at {}", Length::mm(exact).decimals(4))
            } else {
                text!(
                    "the best is {} with a prime radius of {}",
                    Length::mm(exact).decimals(4),
                    Length::mm(of).decimals(4)
                )
            };
            words.push(text!("{} {} chosen; {}", name, Length::mm(chosen), exactly));
        }
        words
    }
}
