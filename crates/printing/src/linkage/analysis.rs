//! The linkage that moves the bed: its motion over a turn, dead points, largest accelerations, transmission angles, torque.

use camgen_kernel::text::{DIGITS, Length, Text, Value, nominal, significant, text};
mod air;
mod described;
mod moving;
mod over_base;
mod picture;
#[cfg(test)]
mod tests;

use crate::linkage::MachineOfLinkage;
use crate::linkage::checks::{DEAD_POINTS, GRASHOF, LINK_RATIO, REVERSALS, ROD_ANGLE, TRANSMISSION_ANGLE};
use crate::linkage::machine::LinkageLimits;
use crate::linkage::synthesis;
use crate::press::MachineOfPress;
use crate::press::bed_motion::{self, Branch, Characteristics, DragLink, Linkage};
use crate::press::buffer::Bed;
use crate::press::machine::LinkageData;
use air::{AirForce, Buffers};
use camgen_cams::analysis::{Analysis, Picture};
use camgen_cams::body::Kind;
use camgen_cams::check::Measure;
use camgen_cams::machine::Machine;
use camgen_cams::report::plot::{Plot, PlotBand, PlotCurve, PlotPanel, PlotPoint, figure};
use camgen_cams::report::{Fact, Section, Speeds, Topic, degrees, shown};
use camgen_cams::table::{ListedColumn, Table};
use camgen_kernel::document::Input;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::refusal::Refusal;
use picture::LinkagePicture;
use serde::Serialize;
use serde_json::json;
use std::f64::consts::{PI, TAU};

/// Drives of the bed.
pub const KIND: Kind = Kind { command: "linkage", noun: "drive of the bed", keys: super::LINKAGE };

/// Rows of the table over a turn.
const ROWS: u32 = 720;

/// One crank angle of the turn.
struct LinkageRow {
    crank: f64,
    /// Position of the bed and its derivatives by the crank angle, m.
    motion: [f64; 6],
    speed: f64,
    inertia: f64,
    torque: f64,
    transmission: f64,
    rod: f64,
    /// Where a buffer acts.
    air: Option<AirForce>,
}

const COLUMNS: &[ListedColumn<LinkageRow>] = &[
    ("crank_deg", |row| row.crank),
    ("x_mm", |row| MILLIMETRES * row.motion[0]),
    ("velocity_mm_per_rad", |row| MILLIMETRES * row.motion[1]),
    ("acceleration_mm_per_rad2", |row| MILLIMETRES * row.motion[2]),
    ("jerk_mm_per_rad3", |row| MILLIMETRES * row.motion[3]),
    ("velocity_m_per_s", |row| row.speed * row.motion[1]),
    ("acceleration_m_per_s2", |row| row.speed * row.speed * row.motion[2]),
    ("inertia_n", |row| row.inertia),
    ("torque_nm", |row| row.torque),
    ("power_w", |row| row.torque * row.speed),
    ("transmission_deg", |row| row.transmission),
    ("rod_deg", |row| row.rod),
];

/// Further columns, with buffers that balance the bed.
const COLUMNS_OF_AIR: &[ListedColumn<LinkageRow>] = &[
    ("air_n", |row| row.air.map_or(f64::NAN, |air| air.force)),
    ("dx_mm", |row| row.air.map_or(f64::NAN, |air| MILLIMETRES * air.displacement)),
    ("residual_n", |row| row.air.map_or(f64::NAN, |air| row.inertia - air.force)),
];

/// The section `linkage`.
#[derive(Debug, Serialize)]
struct LinkageFigures {
    stroke_mm: f64,
    c_plus: f64,
    c_minus: f64,
    k_c: f64,
    k_phi: f64,
    w: f64,
    velocity_coefficient: f64,
    outer_deg: f64,
    inner_deg: f64,
    zero_deg: Vec<f64>,
    transmission_min_deg: Option<f64>,
    rod_angle_max_deg: f64,
    inertia_max_n: f64,
    torque_max_nm: f64,
    power_max_w: f64,
    compared: ComparisonFigures,
}

/// Comparison with that crank-slider without drag link, as shares.
#[derive(Debug, Serialize)]
struct ComparisonFigures {
    c: f64,
    w: f64,
    speed: f64,
}

/// What a drag link is designed for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum DragLinkGoal {
    /// The smallest base with equal largest accelerations at both ends.
    Equal,
    /// Equal accelerations and equal times out and back.
    Symmetric,
    /// The least largest acceleration within the limits of the machine.
    Least {
        /// Out and back take the same time.
        symmetric: bool,
        /// Largest peak of power / peak of the crank-slider alone.
        power: Option<f64>,
    },
}

/// Coupler and driven crank of a design where the file gives none: those that give the paper's figures.
const LINKS: (f64, f64) = (1.0, 1.1);
/// Driven crank of a symmetric design where the file gives none.
const CENTRIC: f64 = 0.6;

fn none_described() -> Refusal {
    Refusal::new("the machine file describes no linkage")
        .remedy("add the table [linkage], or take dpi-crank-slider or dpi-six-bar")
}

/// The linkage of a machine with a drag link designed for its slider.
///
/// # Errors
/// [`Refusal`] when there is no slider, or no design.
pub fn designed(machine: &Machine, goal: DragLinkGoal) -> Result<LinkageData, Refusal> {
    let data = machine.linkage().ok_or_else(none_described)?;
    let slider = data.linkage.slider().ok_or_else(|| {
        Refusal::new("a yoke has no drag link to design")
            .remedy("give linkage.kind = \"crank-slider\" and linkage.rod_ratio")
    })?;
    let given = data.linkage.drag_link();
    let plain = DragLink { base: 0.0, coupler: LINKS.0, follower: LINKS.1, turn: PI, branch: Branch::Leading };
    let linkage = match (goal, given) {
        (DragLinkGoal::Equal, given) => synthesis::equal(given.unwrap_or(plain), slider)?,
        (DragLinkGoal::Symmetric, Some(link)) => {
            synthesis::symmetric(link.coupler, link.follower, link.branch, slider)?
        }
        (DragLinkGoal::Symmetric, None) => synthesis::centric(CENTRIC, slider.rod_ratio)?,
        (DragLinkGoal::Least { symmetric, power }, _) => {
            let own = machine.linkage_limits();
            let (transmission_angle, link_ratio) = (own.transmission_angle, own.link_ratio);
            synthesis::least(slider, synthesis::SynthesisLimits { transmission_angle, link_ratio, power, symmetric })?
        }
    };
    Ok(LinkageData { linkage, base_angle: 0.0, ..*data })
}

/// A design as a table of a machine file.
fn design(data: &LinkageData) -> Option<Section> {
    let (link, slider) = (data.linkage.drag_link()?, data.linkage.slider()?);
    let angle = link.turn.to_degrees();
    let value = json!({
        "base_ratio": link.base, "coupler_ratio": link.coupler, "follower_ratio": link.follower,
        "follower_angle_deg": angle, "rod_ratio": slider.rod_ratio, "offset_ratio": slider.offset_ratio,
    });
    Some(Section::new("design", &value).with_words(described::lines(data)?))
}

/// The linkage of a machine at a speed of its main shaft, rpm, or one that is designed for its slider.
///
/// ```
/// use camgen::domains::linkage::analysis::{self, DragLinkGoal};
/// use camgen::{Judged, Machine};
///
/// let (machine, _) = Machine::load("dpi-six-bar", &[])?;
/// let judged = Judged::new(analysis::analysis(&machine, 35.0, None)?);
/// assert!(judged.report().section("linkage").is_some());
/// // A drag link with equal largest accelerations at both ends, as a table to paste into the machine file.
/// let designed = analysis::analysis(&machine, 35.0, Some(DragLinkGoal::Equal))?;
/// assert!(designed.document.is_some_and(|table| table.contains("[linkage]")));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`Refusal`] when the machine file describes none, or there is no design.
pub fn analysis(machine: &Machine, rpm: f64, goal: Option<DragLinkGoal>) -> Result<Analysis, Refusal> {
    let data = &match goal {
        Some(goal) => designed(machine, goal)?,
        None => *machine.linkage().ok_or_else(none_described)?,
    };
    let bed = machine.bed().ok_or_else(|| {
        Refusal::new("the machine file describes no bed").remedy("add the tables [bed], [buffer] and [design]")
    })?;
    let found = bed_motion::characteristics(&data.linkage);
    let lying = LinkagePicture::new(data, bed);
    let own = match data.linkage {
        Linkage::SixBar(link, slider) => Some(over_base::diagram(link, slider)),
        Linkage::Yoke | Linkage::CrankSlider(_) => None,
    };
    let (speed, linkage_figures) = (bed.crank_speed(rpm), figures(data, &found, bed, rpm));
    let buffers = machine.press().ok().and_then(|press| Buffers::new(press, data.linkage, rpm));
    let rows: Vec<LinkageRow> =
        (0..ROWS).map(|i| row(data, bed, buffers.as_ref(), speed, f64::from(i) / f64::from(ROWS))).collect();
    let of_air = if buffers.is_some() { COLUMNS_OF_AIR } else { &[] };
    let mut inputs = vec![Input::word("command", KIND.command)];
    inputs.extend(machine.inputs(KIND.keys));
    inputs.push(Input::number("rpm", rpm));
    inputs.extend(goal.map(|goal| Input::word("synthesize", format!("{goal:?}"))));
    let mut sections = vec![
        Section::new(KIND.command, &linkage_figures)
            .with_words(describe(&linkage_figures))
            .with_facts(facts(&linkage_figures)),
    ];
    sections.extend(goal.and_then(|_| design(data)));
    Ok(Analysis {
        kind: &KIND,
        variant: "",
        machine: machine.name().to_owned(),
        speeds: Speeds::One(rpm),
        inputs,
        sections,
        measures: measures(machine, data, &found),
        notes: machine.idle_key_notes(KIND.keys, KIND.noun),
        picture: Picture::Curves(Plot {
            own: own.into_iter().collect(),
            scheme: Some(picture::scheme(&lying)),
            ..curves(&LinkageCurves {
                machine,
                data,
                bed,
                outer: data.to_line(found.outer),
                rpm,
                found: &linkage_figures,
                rows: &rows,
            })
        }),
        mechanism: Some(moving::mechanism(&lying, ROWS, speed)),
        document: described::lines(data).map(|lines| lines.join("\n") + "\n"),
        tables: vec![("", Table::listed(&[COLUMNS, of_air].concat(), &rows))],
        by: &[],
        along: "crank_deg",
        diagrams: &[],
        not_modelled: NOT_MODELLED.to_vec(),
    })
}

fn facts(found: &LinkageFigures) -> Vec<Fact> {
    let stroke = text!(
        "{}; dead points at {}° (outer) and {}°",
        Length::mm(found.stroke_mm).brief(),
        nominal(found.outer_deg, DIGITS),
        nominal(found.inner_deg, DIGITS)
    );
    let coefficients = text!(
        "C⁺ {}, C⁻ {}, W {}, velocity {}",
        Value::brief_number(found.c_plus),
        Value::brief_number(found.c_minus),
        Value::brief_number(found.w),
        Value::brief_number(found.velocity_coefficient)
    );
    let transmission = found.transmission_min_deg.map(|angle| text!("at least {}°", nominal(angle, DIGITS)));
    let percent = |share: f64| format!("{}{} %", if share > 0.0 { "+" } else { "" }, significant(100.0 * share, 3));
    let compared = text!(
        "acceleration {}, power {}, speed {} at equal force",
        percent(found.compared.c),
        percent(found.compared.w),
        percent(found.compared.speed)
    );
    let facts = [
        Some(Fact::new(Topic::new(10, "stroke"), stroke)),
        Some(Fact::new(Topic::PEAKS, coefficients)),
        Some(Fact::new(Topic::FORCE, text!("inertia at most {}", Value::brief(found.inertia_max_n, "N")))),
        Some(Fact::new(
            Topic::TORQUE,
            text!("{}, peak {}", Value::brief(found.torque_max_nm, "N·m"), Value::brief(found.power_max_w, "W")),
        )),
        transmission.map(|angle| Fact::new(Topic::new(65, "transmission"), angle)),
        Some(Fact::new(Topic::new(66, "crank-slider"), text!("compared with it alone: {}", compared))),
    ];
    facts.into_iter().flatten().collect()
}

const NOT_MODELLED: &[&str] = &[
    "Masses of the links: the torque is that of the bed.",
    "Transitions of the cams of the buffers: each bottom is assumed to follow its law.",
    "Elasticity and play of the joints.",
];

/// Angle of the driving crank from the base, at an angle from the line of the slider.
fn from_base(data: &LinkageData, crank: f64) -> f64 {
    crank - data.to_line(0.0)
}

/// The row at a share of a turn, with the speed of the driving crank, rad/s.
fn row(data: &LinkageData, bed: &Bed, buffers: Option<&Buffers>, speed: f64, turn: f64) -> LinkageRow {
    let theta = from_base(data, TAU * turn);
    let motion = data.linkage.position(theta).map(|value| bed.crank_radius * value);
    let [_, first, second, ..] = motion;
    let force = bed.mass * speed * speed * second;
    LinkageRow {
        crank: 360.0 * turn,
        motion,
        speed,
        inertia: -force,
        torque: force * first,
        transmission: data.linkage.transmission_angle(theta).map_or(f64::NAN, f64::to_degrees),
        rod: data.linkage.rod_angle(theta).to_degrees(),
        air: buffers.and_then(|buffers| buffers.force_at(theta)),
    }
}

fn figures(data: &LinkageData, found: &Characteristics, bed: &Bed, rpm: f64) -> LinkageFigures {
    let linkage = &data.linkage;
    let (stroke, speed) = (bed.crank_radius * found.stroke, bed.crank_speed(rpm));
    let torque = bed.mass * speed * speed * stroke * stroke * found.power.value / (PI * PI * PI);
    let comparison = bed_motion::compared(linkage);
    LinkageFigures {
        stroke_mm: MILLIMETRES * stroke,
        c_plus: found.outer_acceleration.value,
        c_minus: found.inner_acceleration.value,
        k_c: found.acceleration_ratio,
        k_phi: found.time_ratio,
        w: found.power.value,
        velocity_coefficient: found.velocity.value,
        outer_deg: degrees(data.to_line(found.outer)),
        inner_deg: degrees(data.to_line(found.inner)),
        zero_deg: found.zeros.iter().map(|zero| degrees(data.to_line(*zero))).collect(),
        transmission_min_deg: least_transmission(linkage).map(|(angle, _)| angle.to_degrees()),
        rod_angle_max_deg: linkage.largest_rod_angle().to_degrees(),
        inertia_max_n: bed.mass * speed * speed * stroke * found.acceleration() / (PI * PI),
        torque_max_nm: torque,
        power_max_w: torque * speed,
        compared: ComparisonFigures { c: comparison.acceleration, w: comparison.power, speed: comparison.speed },
    }
}

/// Least transmission angle of a drag link, and the angle of the driving crank from the base there.
fn least_transmission(linkage: &Linkage) -> Option<(f64, f64)> {
    let Linkage::SixBar(link, _) = linkage else { return None };
    let [near, far] = link.transmission_angles();
    Some(if near <= far { (near, 0.0) } else { (far, 0.5 * TAU) })
}

fn measures(machine: &Machine, data: &LinkageData, found: &Characteristics) -> Vec<Measure> {
    let limits = machine.linkage_limits();
    let mut all = Vec::new();
    if let Linkage::SixBar(link, _) = data.linkage {
        let margins = [
            1.0 - link.base,
            1.0 - link.base - (link.coupler - link.follower).abs(),
            link.coupler + link.follower - 1.0 - link.base,
        ];
        let passing = link.remedies().base;
        let note = format!("of driving cranks; with the other links a base below {} turns", shown(passing.below));
        let margin = margins.into_iter().fold(f64::INFINITY, f64::min);
        all.push(GRASHOF.measure(margin, Some(0.0)).noted(note));
        all.push(LINK_RATIO.measure(link.coupler.min(link.follower), Some(limits.link_ratio)));
    }
    if let Some((angle, at)) = least_transmission(&data.linkage) {
        let place = format!("where the driving crank stands at {}° from the base", shown(at.to_degrees()));
        let limit = Some(limits.transmission_angle.to_degrees());
        all.push(TRANSMISSION_ANGLE.measure(angle.to_degrees(), limit).noted(place));
    }
    if data.linkage != Linkage::Yoke {
        let angle = data.linkage.largest_rod_angle().to_degrees();
        all.push(ROD_ANGLE.measure(angle, Some(limits.rod_angle.to_degrees())));
    }
    let [outer, inner] = [found.outer, found.inner].map(|at| shown(degrees(data.to_line(at))));
    let place = format!("from the outer one at {outer}° to the inner at {inner}°");
    all.push(DEAD_POINTS.measure(found.forward_angle.to_degrees(), None).noted(place));
    #[expect(clippy::cast_precision_loss, reason = "a handful")]
    let zeros = found.zeros.len() as f64;
    all.push(REVERSALS.measure(zeros, Some(2.0)));
    all
}

fn describe(linkage_figures: &LinkageFigures) -> Vec<Text> {
    let mut lines = vec![
        text!(
            "stroke {}, dead points at {}° (outer) and {}°, K_φ {}",
            Length::mm(linkage_figures.stroke_mm),
            shown(linkage_figures.outer_deg),
            shown(linkage_figures.inner_deg),
            format_args!("{:.5}", linkage_figures.k_phi)
        ),
        format!(
            "C⁺ {:.5}, C⁻ {:.5}, K_c {:.5}, W {:.5}, velocity coefficient {:.5}",
            linkage_figures.c_plus,
            linkage_figures.c_minus,
            linkage_figures.k_c,
            linkage_figures.w,
            linkage_figures.velocity_coefficient
        )
        .into(),
        format!(
            "inertia at most {} N, torque {} N·m, power {} W; rod at most {}°",
            shown(linkage_figures.inertia_max_n),
            shown(linkage_figures.torque_max_nm),
            shown(linkage_figures.power_max_w),
            shown(linkage_figures.rod_angle_max_deg)
        )
        .into(),
    ];
    if let Some(angle) = linkage_figures.transmission_min_deg {
        let comparison = &linkage_figures.compared;
        lines.push(format!(
            "transmission angle at least {angle:.3}°; compared with the crank-slider alone: C {}, W {}, speed {} at equal force",
            signed_percent(comparison.c),
            signed_percent(comparison.w),
            signed_percent(comparison.speed)
        ).into());
    }
    lines
}

fn signed_percent(share: f64) -> String {
    format!("{:+.2} %", 100.0 * share)
}

/// What the linkage makes of the motion of the bed: its largest acceleration against that of a crank-slider alone, and the angle that limits it.
fn headline(found: &LinkageFigures, limits: &LinkageLimits) -> String {
    let Some(angle) = found.transmission_min_deg else {
        let force = format!("Inertia of the bed at most {} N", figure(found.inertia_max_n));
        return if found.rod_angle_max_deg > 0.0 {
            format!("{force}, rod at most {}° from its line", figure(found.rod_angle_max_deg))
        } else {
            force
        };
    };
    let limit = limits.transmission_angle.to_degrees();
    if angle < limit {
        return format!("Transmission angle {}°: below the least of {}°", figure(angle), figure(limit));
    }
    let percent = (1e3 * found.compared.c.abs()).round() / 10.0;
    let side = if found.compared.c < 0.0 { "less" } else { "more" };
    format!(
        "{} % {side} force than a crank-slider alone; transmission angle {}°, at least {}° needed",
        figure(percent),
        figure(angle),
        figure(limit)
    )
}

/// What the curves are made from.
struct LinkageCurves<'a> {
    machine: &'a Machine,
    data: &'a LinkageData,
    bed: &'a Bed,
    outer: f64,
    rpm: f64,
    found: &'a LinkageFigures,
    rows: &'a [LinkageRow],
}

/// Share of the crank radius below which two positions of the bed are the same.
const SAME: f64 = 1e-6;

/// The motion of the bed over a turn, with that of a crank-slider alone in grey, and the angles with their limits.
fn curves(of: &LinkageCurves<'_>) -> Plot {
    let (data, rows) = (of.data, of.rows);
    let own: Vec<[f64; 6]> = rows.iter().map(|row| row.motion).collect();
    let alone: Option<Vec<[f64; 6]>> = match data.linkage {
        Linkage::SixBar(_, slider) => {
            let plain = Linkage::CrankSlider(slider);
            let [own_outer, _] = plain.dead_points();
            let cranks = rows.iter().map(|row| row.crank.to_radians() - of.outer + own_outer);
            Some(cranks.map(|crank| plain.position(crank).map(|x| of.bed.crank_radius * x)).collect())
        }
        _ => None,
    };
    // Without a base the drag link turns with the crank: there is one motion to draw.
    let alone = alone.filter(|alone| {
        alone.iter().zip(&own).any(|(one, other)| (one[0] - other[0]).abs() > SAME * of.bed.crank_radius)
    });
    let mut panels = Vec::new();
    for (order, name) in ["Position of the bed, mm", "Velocity of the bed, mm/rad", "Acceleration of the bed, mm/rad²"]
        .into_iter()
        .enumerate()
    {
        let points = by_crank(rows, &own, order);
        let mut curves: Vec<PlotCurve> = Vec::new();
        if let Some(alone) = &alone {
            curves.push(PlotCurve::grey("", by_crank(rows, alone, order)));
        }
        let extremes = if order == 2 { extremes(&points) } else { Vec::new() };
        curves.push(PlotCurve::new("", 0, points));
        let name = if alone.is_some() { format!("{name}; grey: the crank-slider alone") } else { name.to_owned() };
        panels.push(PlotPanel { points: extremes, ..PlotPanel::new(name, curves) });
    }
    let limits = of.machine.linkage_limits();
    if of.found.transmission_min_deg.is_some() {
        let limit = limits.transmission_angle.to_degrees();
        let points = rows.iter().map(|row| [row.crank, row.transmission]).collect();
        panels.push(PlotPanel {
            bands: vec![PlotBand::below(limit, format!("below the least angle of {}°", figure(limit)))],
            ..PlotPanel::new("Transmission angle of the drag link, degrees", vec![PlotCurve::new("", 0, points)])
        });
    }
    let speed = if of.rpm.is_finite() { format!(", {} rpm", figure(of.rpm)) } else { String::new() };
    Plot {
        title: headline(of.found, &limits),
        subtitle: format!(
            "{}{speed}: the bed over a turn of the driving crank, stroke {} mm",
            of.machine.name(),
            figure(of.found.stroke_mm)
        ),
        places: "crank angle from the line of the slider, degrees".into(),
        panels,
        ..Plot::default()
    }
}

/// The largest and the least point of a curve, labelled.
fn extremes(points: &[[f64; 2]]) -> Vec<PlotPoint> {
    let best = |sign: f64| {
        points.iter().copied().reduce(|best, next| if sign * next[1] > sign * best[1] { next } else { best })
    };
    [best(1.0), best(-1.0)].into_iter().flatten().map(|at| PlotPoint::dot(at, 0, figure(at[1]))).collect()
}

/// A derivative of the motion, mm, over the crank angle of the rows.
fn by_crank(rows: &[LinkageRow], motions: &[[f64; 6]], order: usize) -> Vec<[f64; 2]> {
    let values = motions.iter().map(|motion| MILLIMETRES * motion.get(order).copied().unwrap_or(f64::NAN));
    rows.iter().zip(values).map(|(row, value)| [row.crank, value]).collect()
}
