//! What a conoid contributes to its report.

use super::between::Residual;
use super::{Conoid, SectionCut, wheel};
use crate::press::balance::reversal_of_bed;
use crate::press::machine::{PressCams, Shift};
use crate::press::report::{BUFFERS, CylinderMeasures, LEFT_OVER};
use crate::press::scatter::other_cams::{self, LawAtSpeed};
use camgen_cams::body::part::{Part, bore};
use camgen_cams::body::{DrawingEvidence, Flank, flank_of};
use camgen_cams::report::{Fact, ReportLine, Section, Topic, degrees, lobes_words, shown};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::numeric::parallel;
use camgen_kernel::text::{DIGITS, Length, LengthKind, Text, Value, nominal, text};
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
    let mut words: Vec<ReportLine> = all.iter().map(|section| ReportLine::row(section.describe())).collect();
    if all.len() == 1 {
        let rpm = all.first().map_or(f64::NAN, |section| section.rpm);
        let alone = text!(
            "for {} rpm alone, the design speed where --rpm gives no other: every section is the same; several speeds, such as \
             --rpm 20,25,30,35, give one for each",
            shown(rpm)
        );
        words.push(alone.into());
    }
    let outlines = parts.map(Outlines::new);
    let mut sections = vec![ConoidMeasures::new(conoid, found).section()];
    sections.extend(reversal_of_bed(&conoid.machine));
    let cylinders = CylinderMeasures::new(conoid.cylinder.piston_area);
    let buffers = text!("{} cylinders, each: bore {}", cylinders.cylinders, Length::mm(cylinders.bore_mm).brief());
    sections
        .push(Section::new("cylinders", &cylinders).with_words(vec![cylinders.describe()]).with_fact(BUFFERS, buffers));
    sections.extend([
        Section::new("sections", &all).with_words(words).with_fact(SECTIONS, sections_of(&all)),
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

/// The sections of a conoid.
const SECTIONS: Topic = Topic::new(15, "sections");
/// Sections that a summary names one by one.
const MOST_NAMED: usize = 8;

fn sections_of(all: &[SectionMeasures]) -> Text {
    let speed = |section: &SectionMeasures| nominal(section.rpm, DIGITS);
    match all {
        [] => Text::default(),
        [only] => text!("one, for {} rpm: every section of this cam is the same", speed(only)),
        [first, .., last] if all.len() > MOST_NAMED => {
            text!("{} for {} to {} rpm", all.len(), speed(first), speed(last))
        }
        few => text!("{} for {} rpm", few.len(), Text::joined(few.iter().map(|s| Text::from(speed(s))), ", ")),
    }
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

    fn describe(&self) -> Text {
        let arcs = self.arcs.map(|arcs| text!(", {} arcs", arcs));
        let variable = self.v.map(|v| text!("v {}, ", shown(v)));
        text!(
            "{} rpm  {}z {}, column {}, slope at the start {}, Δx {} at x = {}{}",
            format_args!("{:>6}", shown(self.rpm)),
            variable,
            Length::mm(self.z_mm).decimals(3),
            Length::mm(self.column_length_mm).decimals(3),
            format_args!("{:.4}", self.start_slope),
            Length::mm(self.dx_max_mm).decimals(3),
            Length::mm(self.dx_max_at_x_mm).decimals(2),
            arcs
        )
    }
}

/// Volume of the solid with its bore, mm³.
fn volume(conoid: &Conoid, flank: &Flank) -> f64 {
    let (low, high) = conoid.ends();
    let hole = bore(&conoid.machine).map_or(0.0, |hole| hole.contour().area_and_centroid().0);
    flank.volume - hole * MILLIMETRES * (high - low)
}

/// Mass of a volume, mm³, in kg.
fn mass(conoid: &Conoid, volume: f64) -> f64 {
    1e-9 * volume * conoid.machine.cam.density()
}

/// Mass of the solid, kg.
pub(super) fn mass_of(conoid: &Conoid, flank: &Flank) -> f64 {
    mass(conoid, volume(conoid, flank))
}

impl ConoidMeasures {
    fn new(conoid: &Conoid, found: &DrawingEvidence<'_>) -> Self {
        let (low, high) = conoid.ends();
        let volume = flank_of(found).map(|flank| volume(conoid, flank));
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
            mass_kg: volume.map(|volume| mass(conoid, volume)),
        }
    }

    fn section(&self) -> Section {
        let smallest = self.smallest_prime_radius_mm.map_or_else(
            || "no radius keeps the limits".into(),
            |radius| text!("smallest possible {}", Length::mm(radius)),
        );
        let mut words = vec![text!(
            "base radius {}, roller Ø{}, prime radius {} ({}), lift {}, z {} to {} \
             (overhang {})",
            Length::mm(self.base_radius_mm),
            Length::mm(2.0 * self.roller_radius_mm),
            Length::mm(self.prime_radius_mm),
            smallest,
            Length::mm(self.max_lift_mm).decimals(3),
            Length::mm(self.z_min_mm).bare(),
            Length::mm(self.z_max_mm),
            Length::mm(self.overhang_mm)
        )];
        let mut figures = vec![
            text!(
                "base radius {}, roller Ø{}",
                Length::mm(self.base_radius_mm).rounded(),
                Length::mm(2.0 * self.roller_radius_mm).rounded()
            ),
            text!(
                "lift {}, z from {} to {}",
                Length::mm(self.max_lift_mm).decimals(3),
                Length::mm(self.z_min_mm).rounded().bare(),
                Length::mm(self.z_max_mm).rounded()
            ),
            text!("overhang {} at either end", Length::mm(self.overhang_mm).rounded()),
        ];
        if self.lobes > 1 {
            let lobes = lobes_words(self.lobes);
            words.push(lobes.clone().into());
            figures.push(lobes.into());
        }
        if let (Some(volume), Some(mass)) = (self.volume_mm3, self.mass_kg) {
            words.push(text!("volume {}, mass {} kg", Length::new(volume, &LengthKind::MM3), shown(mass)));
            figures.push(text!("mass {} kg", format_args!("{:.2}", mass)));
        }
        let size = text!(
            "base R{}, roller Ø{}, {} long",
            Length::mm(self.base_radius_mm).nominal(),
            Length::mm(2.0 * self.roller_radius_mm).nominal(),
            Length::mm(self.z_max_mm - self.z_min_mm).nominal()
        );
        let mass = self.mass_kg.map(|mass| Fact::new(Topic::SIZE, Value::brief(mass, "kg")));
        let lift = Fact::new(Topic::LIFT, Value::from(Length::mm(self.max_lift_mm).brief()));
        let facts = [Some(Fact::new(Topic::SIZE, size)), mass, Some(lift)].into_iter().flatten();
        Section::new("cam", self).with_words(words).with_figures(figures).with_facts(facts)
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
        let mut words = vec![text!(
            "the contact wanders {} along the axis; plane offsets would miss by {}; axial force {} N",
            Length::mm(self.axial_wander_mm).decimals(4),
            Length::mm(self.plane_offset_error_max_mm).decimals(4),
            format_args!("{:.1}", self.axial_force_max_n)
        )];
        if let (Some(patches), Some(deviation)) = (self.patches, self.deviation_max_mm) {
            words.push(text!(
                "{} spline patches, {} from the exact surface",
                patches,
                Length::new(1e3 * deviation, &LengthKind::UM).decimals(4)
            ));
        }
        let figures = vec![
            text!("contact wanders {} along the axis", Length::mm(self.axial_wander_mm).decimals(3)),
            text!("plane offsets would miss by {}", Length::mm(self.plane_offset_error_max_mm).decimals(4)),
            text!("axial force at most {} N", format_args!("{:.0}", self.axial_force_max_n)),
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
        let words = vec![text!(
            "{} N left at {} rpm, {}°, by splines in the {}; straight strips would leave {} N",
            shown(self.residual_max_n),
            format_args!("{:.3}", self.rpm),
            format_args!("{:.2}", self.cam_deg),
            self.splines_in,
            shown(self.residual_straight_strips_max_n)
        )];
        let figure = text!(
            "between sections {} N at {} rpm",
            format_args!("{:.2}", self.residual_max_n),
            format_args!("{:.2}", self.rpm)
        );
        let between =
            text!("{} at {} between sections", Value::brief(self.residual_max_n, "N"), Value::brief(self.rpm, "rpm"));
        let between = Fact::new(LEFT_OVER, between);
        Section::new("between", self).with_words(words).with_figures(vec![figure]).with_facts([between])
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
