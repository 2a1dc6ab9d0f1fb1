//! What a conoid contributes to its report.

use super::between::Residual;
use super::{Conoid, SectionCut, wheel};
use crate::press::balance::reversal_of_bed;
use crate::press::machine::{PressCams, Shift};
use crate::press::report::CylinderMeasures;
use crate::press::scatter::other_cams::{self, LawAtSpeed};
use camgen_cams::body::part::{Part, bore};
use camgen_cams::body::{DrawingEvidence, flank_of};
use camgen_cams::report::sheet::rounded;
use camgen_cams::report::{Section, degrees, lobes_words, shown};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::numeric::parallel;
use serde::Serialize;

/// The outlines of all sections together.
#[derive(Debug, Serialize)]
struct Outlines {
    arcs: usize,
    lines: usize,
    deviation_max_mm: f64,
    tangent_break_max_deg: f64,
}

/// Forces at the speeds of the sections, and the residual force between them.
#[derive(Debug, Serialize)]
struct Forces {
    inertia_max_n: f64,
    residual_max_n: f64,
    axial_force_max_n: f64,
}

/// Measures of a conoid.
#[derive(Debug, Serialize)]
struct ConoidMeasures {
    prime_radius_mm: f64,
    base_radius_mm: f64,
    roller_radius_mm: f64,
    /// Largest lift over all sections, from their common lowest point.
    max_lift_mm: f64,
    smallest_prime_radius_mm: Option<f64>,
    /// Equal lobes, one for each turn of the crank in a turn of the cam.
    lobes: u32,
    z_min_mm: f64,
    z_max_mm: f64,
    /// Length beyond its axial travel at either end.
    overhang_mm: f64,
    /// Volume of the metal; `None` when no flank was drawn.
    volume_mm3: Option<f64>,
    mass_kg: Option<f64>,
}

/// One section.
#[derive(Debug, Serialize)]
struct SectionMeasures {
    rpm: f64,
    /// v of the section, where the shift follows it.
    #[serde(skip_serializing_if = "Option::is_none")]
    v: Option<f64>,
    z_mm: f64,
    column_length_mm: f64,
    start_slope: f64,
    dx_max_mm: f64,
    dx_max_at_x_mm: f64,
    inertia_max_n: f64,
    arcs: Option<usize>,
    area_mm2: Option<f64>,
    deviation_max_mm: Option<f64>,
    /// By how much a plane offset of this section's pitch curve would miss the section.
    plane_offset_error_mm: f64,
}

/// The surface.
#[derive(Debug, Serialize)]
struct SurfaceMeasures {
    /// Largest distance of the contact from the roller's plane, along the axis.
    axial_wander_mm: f64,
    axial_wander_cam_deg: f64,
    axial_wander_z_mm: f64,
    /// Largest axial force that the drive of the shift must resist.
    axial_force_max_n: f64,
    plane_offset_error_max_mm: f64,
    patches: Option<usize>,
    deviation_max_mm: Option<f64>,
}

/// Between the sections.
#[derive(Debug, Serialize)]
struct Between {
    residual_max_n: f64,
    rpm: f64,
    cam_deg: f64,
    /// Residual force that straight strips from section to section would leave.
    residual_straight_strips_max_n: f64,
    /// In what the splines along the axis are cubic: "place" or "speed".
    splines_in: &'static str,
}

/// The sections of the report.
pub(super) fn sections(conoid: &Conoid, found: &DrawingEvidence<'_>) -> Vec<Section> {
    let cuts = conoid.sections_cut();
    let errors: Vec<f64> = parallel::map(&cuts, |cut| conoid.plane_offset_error(cut.z));
    let parts = found.drawn.map(|drawn| drawn.parts.as_slice());
    let mut all = Vec::new();
    for (index, (cut, error)) in cuts.iter().zip(&errors).enumerate() {
        let part = parts.and_then(|parts| parts.get(index));
        all.push(SectionMeasures::new(conoid, *cut, part, *error));
    }
    let (left, straight) = (conoid.residual_between(), conoid.residual_of_strips());
    let mut words: Vec<String> = all.iter().map(SectionMeasures::describe).collect();
    if all.len() == 1 {
        let rpm = all.first().map_or(f64::NAN, |section| section.rpm);
        words.push(format!(
            "for {} rpm alone, the design speed where --rpm gives no other: every section is the same; several speeds, such as \
             --rpm 20,25,30,35, give one for each",
            shown(rpm)
        ));
    }
    let outlines = parts.map(Outlines::new);
    let mut sections = vec![ConoidMeasures::new(conoid, found).section()];
    sections.extend(reversal_of_bed(&conoid.machine));
    let cylinders = CylinderMeasures::new(conoid.cylinder.piston_area);
    sections.push(Section::new("cylinders", &cylinders).with_words(vec![cylinders.describe()]));
    sections.extend([
        Section::new("sections", &all).with_words(words),
        SurfaceMeasures::new(conoid, found, &errors).section(),
        Between::new(left, straight, conoid.interpolates_speed()).section(),
        Section::new("outline", &outlines),
        Section::new("force", &Forces::new(conoid, left)),
    ]);
    sections.extend(wheel::section(conoid));
    let laws = conoid.all_sections().map(|cut| LawAtSpeed { rpm: cut.rpm, law: cut.section.law().bottom_law });
    let laws: Vec<LawAtSpeed> = laws.collect();
    let cams = PressCams::of(&conoid.machine);
    sections.extend(other_cams::of_conoid(cams, &conoid.cylinder, conoid.data.shift, &laws));
    sections
}

impl SectionMeasures {
    fn new(conoid: &Conoid, cut: SectionCut<'_>, part: Option<&Part>, error: f64) -> Self {
        let SectionCut { rpm, z, section } = cut;
        let law = section.law().bottom_law;
        let (dx_max_at_x, dx_max) = law.largest_displacement();
        Self {
            rpm,
            v: (conoid.data.shift == Shift::Variable).then(|| wheel::variable(conoid, rpm)),
            z_mm: MILLIMETRES * z,
            column_length_mm: MILLIMETRES * law.column(),
            start_slope: law.start_slope(),
            dx_max_mm: MILLIMETRES * dx_max,
            dx_max_at_x_mm: MILLIMETRES * dx_max_at_x,
            inertia_max_n: conoid.cylinder.largest_load(&law),
            arcs: part.map(|part| part.outline.contour.arcs()),
            area_mm2: part.map(|part| part.area_and_moment().0),
            deviation_max_mm: part.map(|part| part.outline.deviation),
            plane_offset_error_mm: MILLIMETRES * error,
        }
    }

    fn describe(&self) -> String {
        let arcs = self.arcs.map_or(String::new(), |arcs| format!(", {arcs} arcs"));
        let variable = self.v.map_or(String::new(), |v| format!("v {}, ", shown(v)));
        format!(
            "{:>6} rpm  {variable}z {:.3} mm, column {:.3} mm, slope at the start {:.4}, Δx {:.3} mm at x = {:.2} mm{arcs}",
            shown(self.rpm),
            self.z_mm,
            self.column_length_mm,
            self.start_slope,
            self.dx_max_mm,
            self.dx_max_at_x_mm
        )
    }
}

impl ConoidMeasures {
    fn new(conoid: &Conoid, found: &DrawingEvidence<'_>) -> Self {
        let (low, high) = conoid.ends();
        let volume = flank_of(found).map(|flank| {
            let hole = bore(&conoid.machine).map_or(0.0, |hole| hole.contour().area_and_centroid().0);
            flank.volume - hole * MILLIMETRES * (high - low)
        });
        Self {
            prime_radius_mm: MILLIMETRES * conoid.prime_radius(),
            base_radius_mm: MILLIMETRES * conoid.base_radius(),
            roller_radius_mm: MILLIMETRES * conoid.roller.radius,
            max_lift_mm: MILLIMETRES * conoid.max_lift(),
            smallest_prime_radius_mm: conoid.smallest_prime_radius.map(|radius| MILLIMETRES * radius),
            lobes: conoid.lobes,
            z_min_mm: MILLIMETRES * low,
            z_max_mm: MILLIMETRES * high,
            overhang_mm: MILLIMETRES * conoid.overhang(),
            volume_mm3: volume,
            mass_kg: volume.map(|volume| 1e-9 * volume * conoid.machine.cam.density()),
        }
    }

    fn section(&self) -> Section {
        let smallest = self.smallest_prime_radius_mm.map_or_else(
            || "no radius keeps the limits".into(),
            |radius| format!("smallest possible {} mm", shown(radius)),
        );
        let mut words = vec![format!(
            "base radius {} mm, roller Ø{} mm, prime radius {} mm ({smallest}), lift {:.3} mm, z {} to {} mm \
             (overhang {} mm)",
            shown(self.base_radius_mm),
            shown(2.0 * self.roller_radius_mm),
            shown(self.prime_radius_mm),
            self.max_lift_mm,
            shown(self.z_min_mm),
            shown(self.z_max_mm),
            shown(self.overhang_mm)
        )];
        let mut figures = vec![
            format!(
                "base radius {} mm, roller Ø{} mm",
                rounded(self.base_radius_mm),
                rounded(2.0 * self.roller_radius_mm)
            ),
            format!(
                "lift {:.3} mm, z from {} to {} mm",
                self.max_lift_mm,
                rounded(self.z_min_mm),
                rounded(self.z_max_mm)
            ),
            format!("overhang {} mm at either end", rounded(self.overhang_mm)),
        ];
        if self.lobes > 1 {
            let lobes = lobes_words(self.lobes);
            words.push(lobes.clone());
            figures.push(lobes);
        }
        if let (Some(volume), Some(mass)) = (self.volume_mm3, self.mass_kg) {
            words.push(format!("volume {} mm³, mass {} kg", shown(volume), shown(mass)));
            figures.push(format!("mass {mass:.2} kg"));
        }
        Section::new("cam", self).with_words(words).with_figures(figures)
    }
}

impl SurfaceMeasures {
    fn new(conoid: &Conoid, found: &DrawingEvidence<'_>, errors: &[f64]) -> Self {
        let (wander, flank) = (conoid.largest_wander(), flank_of(found));
        Self {
            axial_wander_mm: MILLIMETRES * wander.value,
            axial_wander_cam_deg: degrees(wander.at),
            axial_wander_z_mm: MILLIMETRES * wander.z,
            axial_force_max_n: conoid.axial_force().value,
            plane_offset_error_max_mm: MILLIMETRES * errors.iter().copied().fold(0.0, f64::max),
            patches: flank.map(|flank| flank.patches.len()),
            deviation_max_mm: flank.map(|flank| flank.deviation),
        }
    }

    fn section(&self) -> Section {
        let mut words = vec![format!(
            "the contact wanders {:.4} mm along the axis; plane offsets would miss by {:.4} mm; axial force {:.1} N",
            self.axial_wander_mm, self.plane_offset_error_max_mm, self.axial_force_max_n
        )];
        if let (Some(patches), Some(deviation)) = (self.patches, self.deviation_max_mm) {
            words.push(format!("{patches} spline patches, {:.4} µm from the exact surface", 1e3 * deviation));
        }
        let figures = vec![
            format!("contact wanders {:.3} mm along the axis", self.axial_wander_mm),
            format!("plane offsets would miss by {:.4} mm", self.plane_offset_error_max_mm),
            format!("axial force at most {:.0} N", self.axial_force_max_n),
        ];
        Section::new("surface", self).with_words(words).with_figures(figures)
    }
}

impl Between {
    fn new(left: Residual, straight: Residual, by_speed: bool) -> Self {
        Self {
            residual_max_n: left.force,
            rpm: left.rpm,
            cam_deg: degrees(left.angle),
            residual_straight_strips_max_n: straight.force,
            splines_in: if by_speed { "speed" } else { "place" },
        }
    }

    fn section(&self) -> Section {
        let words = vec![format!(
            "{} N left at {:.3} rpm, {:.2}°, by splines in the {}; straight strips would leave {} N",
            shown(self.residual_max_n),
            self.rpm,
            self.cam_deg,
            self.splines_in,
            shown(self.residual_straight_strips_max_n)
        )];
        let figure = format!("between sections {:.2} N at {:.2} rpm", self.residual_max_n, self.rpm);
        Section::new("between", self).with_words(words).with_figures(vec![figure])
    }
}

impl Forces {
    fn new(conoid: &Conoid, left: Residual) -> Self {
        Self {
            inertia_max_n: conoid.press.largest_inertia(conoid.speeds.last().copied().unwrap_or(0.0)),
            residual_max_n: left.force,
            axial_force_max_n: conoid.axial_force().value,
        }
    }
}

impl Outlines {
    fn new(parts: &[Part]) -> Self {
        let (segments, arcs) = parts.iter().fold((0, 0), |(segments, arcs), part| {
            let contour = &part.outline.contour;
            (segments + contour.vertices.len(), arcs + contour.arcs())
        });
        let breaks = parts.iter().flat_map(|part| part.outline.contour.tangent_breaks());
        Self {
            arcs,
            lines: segments - arcs,
            deviation_max_mm: parts.iter().map(|part| part.outline.deviation).fold(0.0, f64::max),
            tangent_break_max_deg: breaks.map(f64::abs).fold(0.0, f64::max).to_degrees(),
        }
    }
}
