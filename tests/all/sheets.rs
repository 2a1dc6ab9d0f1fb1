//! The review sheets as somebody looks at them: every text is measured against every other text, every line and the frame.

use camgen::analysis::laws::{self, LawsOptions};
use camgen::analysis::{Picture, size};
use camgen::domains::linkage::analysis::{self, DragLinkGoal};
use camgen::domains::press::SpecOfPress;
use camgen::domains::press::analysis::{plain, regimes, spring};
use camgen::domains::press::buffer::regime::Reset;
use camgen::domains::press::scatter::analysis as scatter;
use camgen::domains::press::scatter::monte_carlo::{CUSTOMARY, Sampling};
use camgen::domains::press::scatter::reset::ScrewRule;
use camgen::geometry::contour::{Edge, Extents, Segment};
use camgen::report::sheet::{Sheet, SheetShape, font, paper};
use camgen::write::{pdf, svg};
use camgen::{ExactOn, Machine, Solver, Spec};
use nalgebra::Vector2;

/// How far two texts, or a text and a line, must be apart at the least, mm: less is a touch for the eye.
const APART: f64 = 0.05;

struct Drawn {
    /// The drawing of the part.
    sheet: Sheet,
    review: Sheet,
    passed: bool,
}

fn solved(command: &str, machine: &str, overrides: &[&str], rpm: &[f64]) -> Drawn {
    let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
    let machine = Machine::load(machine, &overrides).expect("valid").0;
    let spec = match command {
        "rotary" => Spec::rotary(machine, rpm[0]),
        "translating" => Spec::translating(machine, rpm[0], Solver::Ode { tolerance: 1e-12 }, ExactOn::Braking),
        "conoid" => Spec::conoid(machine, rpm.to_vec(), None),
        _ => {
            let (motion, told) = machine.motion().expect("a program");
            Spec::of_motion(machine, motion, told)
        }
    };
    let cam = spec.solve().expect("a cam");
    let proven = cam.draw(5e-6).expect("drawn").prove().expect("proved");
    let report = proven.lazy_report();
    let rendering = proven.rendering(&report, 72, svg::TEMPLATE).expect("an outline");
    Drawn {
        sheet: svg::drawing(&rendering, "1/2").expect("a drawing"),
        review: svg::review(&rendering, "2/2").expect("a review sheet"),
        passed: proven.passed(),
    }
}

fn overlap(a: &Extents, b: &Extents) -> bool {
    let apart = -APART;
    a.least.x < b.largest.x + apart
        && b.least.x < a.largest.x + apart
        && a.least.y < b.largest.y + apart
        && b.least.y < a.largest.y + apart
}

/// Whether a straight line meets a field (Liang and Barsky).
fn crosses(field: &Extents, from: Vector2<f64>, to: Vector2<f64>) -> bool {
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        let (start, way) = (from[axis], to[axis] - from[axis]);
        let (low, high) = (field.least[axis] + APART, field.largest[axis] - APART);
        if way.abs() < 1e-12 {
            if start < low || start > high {
                return false;
            }
            continue;
        }
        let (a, b) = ((low - start) / way, (high - start) / way);
        enter = enter.max(a.min(b));
        leave = leave.min(a.max(b));
    }
    enter <= leave
}

fn fields(sheet: &Sheet) -> Vec<(Extents, String)> {
    let shapes = sheet.groups.iter().flat_map(|group| &group.shapes);
    shapes
        .filter_map(|shape| match shape {
            SheetShape::Text { text, .. } => shape.text_field().map(|field| (field, text.clone())),
            _ => None,
        })
        .collect()
}

/// Distance of two points of a curve, mm.
const STEP: f64 = 0.25;
/// Most points of a curve: one far larger than any paper is not followed closer.
const MOST: f64 = 4000.0;

/// The lines of a shape as chains of points.
fn chains(shape: &SheetShape) -> Vec<Vec<Vector2<f64>>> {
    match shape {
        SheetShape::Entity(entity) => entity.contour().edges().map(|edge| along(&edge)).collect(),
        SheetShape::Line(a, b) => vec![vec![*a, *b]],
        SheetShape::Path(points) => vec![points.clone()],
        SheetShape::Arc(start, end, bulge) => {
            vec![along(&Edge::Segment(Segment { start: *start, end: *end, bulge: *bulge }))]
        }
        SheetShape::Triangle([a, b, c]) => vec![vec![*a, *b, *c, *a]],
        SheetShape::Area(_) | SheetShape::Text { .. } => Vec::new(),
    }
}

fn along(edge: &Edge) -> Vec<Vector2<f64>> {
    let straight = edge.segment().is_some_and(|segment| segment.bulge == 0.0);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most a few thousand")]
    let pieces = if straight { 1 } else { (edge.length() / STEP).ceil().clamp(1.0, MOST) as u32 };
    (0..=pieces).map(|index| edge.point_and_tangent(f64::from(index) / f64::from(pieces)).0).collect()
}

/// A4 lengthwise, mm.
const A4: Vector2<f64> = Vector2::new(297.0, 210.0);
/// Classes of lines that lie behind texts with a halo.
const BEHIND: [&str; 2] = ["tick", "hatch"];

/// Everything that is wrong with a sheet for the eye.
pub(crate) fn faults(sheet: &Sheet) -> Vec<String> {
    let mut found = Vec::new();
    let texts = fields(sheet);
    let size = sheet.extents.size();
    // A picture of an analysis is an A4 lengthwise.
    let is_paper = |paper: Vector2<f64>| (paper - size).norm() < 1e-9;
    if !paper::PAPERS.iter().any(|paper| is_paper(paper.size)) && !is_paper(A4) {
        found.push(format!("{size:?} is no sheet of ISO 5457"));
    }
    for (index, (field, text)) in texts.iter().enumerate() {
        if text.trim().is_empty() {
            found.push("an empty text".into());
        }
        let inside = |least: Vector2<f64>, largest: Vector2<f64>| {
            field.least.x >= least.x
                && field.least.y >= least.y
                && field.largest.x <= largest.x
                && field.largest.y <= largest.y
        };
        if !inside(sheet.extents.least, sheet.extents.largest) {
            found.push(format!("`{text}` is cut off"));
        }
        for (other, words) in texts.iter().skip(index + 1) {
            if overlap(field, other) {
                found.push(format!("`{text}` over `{words}`"));
            }
        }
    }
    for group in sheet.groups.iter().filter(|group| !BEHIND.contains(&group.class)) {
        for chain in group.shapes.iter().flat_map(chains) {
            for (from, to) in chain.iter().zip(chain.iter().skip(1)) {
                for (field, text) in &texts {
                    if crosses(field, *from, *to) {
                        found.push(format!("`{text}` is struck by {}", group.id));
                    }
                }
            }
        }
    }
    found.sort();
    found.dedup();
    found
}

fn looks_right(what: &str, drawn: &Drawn) {
    for (name, sheet) in [("drawing", &drawn.sheet), ("review", &drawn.review)] {
        let found = faults(sheet);
        assert!(found.is_empty(), "{name}, {what}: {found:#?}");
        // What somebody gives for the title block may be longer than its field.
        let measured = sheet.groups.iter().filter(|group| group.class != "title-values");
        let shapes = measured.flat_map(|group| &group.shapes);
        let small = shapes.filter_map(|shape| match shape {
            SheetShape::Text { height, text, .. } if *height < font::SMALLEST - 1e-9 => Some(text),
            _ => None,
        });
        let small: Vec<&String> = small.collect();
        assert!(small.is_empty(), "{name}, {what}: letters below 2.5 mm: {small:?}");
    }
}

#[test]
fn nothing_overlaps_on_the_sheet_of_a_disc() {
    let long = "name=A printing press whose name has sixty characters, as some do";
    let cyrillic = "name=Плоскопечатная машина ДПИ с воздушными буферами";
    let cases: [&[&str]; 8] = [
        &[],
        &["cam.rotation=ccw"],
        &["follower.roller.offset=20mm"],
        &["cam.base_radius=1000mm"],
        &["cam.base_radius=40mm"],
        &[long],
        &[cyrillic],
        &["cam.balance=30mm .. 217mm", "cam.base_radius=140mm", "cam.keyway.width=8mm", "cam.keyway.depth=3.3mm"],
    ];
    for case in cases {
        looks_right(&format!("{case:?}"), &solved("rotary", "dpi", case, &[35.0]));
    }
}

#[test]
fn nothing_overlaps_on_other_sheets() {
    looks_right("plate", &solved("translating", "dpi", &[], &[35.0]));
    looks_right("conoid", &solved("conoid", "dpi", &[], &[20.0, 25.0, 30.0, 35.0]));
    let ten: Vec<f64> = (0..10).map(|index| 20.0 + 1.5 * f64::from(index)).collect();
    looks_right("ten sections", &solved("conoid", "dpi", &["cam.rotation=ccw"], &ten));
}

/// The sheet of a linkage: letters and names keep clear of links and paths, at every size and in every shape.
#[test]
fn nothing_overlaps_on_the_sheet_of_a_linkage() {
    let cases: [(&str, &[&str]); 9] = [
        ("dpi-six-bar", &[]),
        ("dpi-six-bar", &["linkage.base_angle=30 deg", "linkage.offset_ratio=-0.4", "linkage.driving_crank=140 mm"]),
        ("dpi-six-bar", &["linkage.base_ratio=0"]),
        ("dpi-six-bar", &["bed.crank_radius=2.5 mm", "linkage.rod_ratio=7"]),
        ("dpi-six-bar", &["bed.crank_radius=40 m"]),
        ("dpi-six-bar", &["name=Плоскопечатная машина ДПИ с воздушными буферами и шестизвенным приводом талера"]),
        ("dpi-crank-slider", &[]),
        ("dpi-crank-slider", &["linkage.offset_ratio=1.2"]),
        ("dpi", &["linkage.kind=yoke"]),
    ];
    for (name, overrides) in cases {
        let owned: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
        let machine = Machine::load(name, &owned).expect("valid").0;
        let goals = [
            None,
            Some(DragLinkGoal::Equal),
            Some(DragLinkGoal::Symmetric),
            Some(DragLinkGoal::Least { symmetric: true, power: None }),
        ];
        let designed = name == "dpi-crank-slider" && overrides.is_empty();
        for goal in goals.into_iter().take(if designed { 4 } else { 1 }) {
            let found = analysis::analysis(&machine, 35.0, goal).expect("a linkage");
            let sheet = found.picture.sheet("camgen 0.2.0, inputs 0123456789ab");
            let mut faults = faults(&sheet);
            // A PDF has no other font.
            faults.extend(
                fields(&sheet).iter().flat_map(|(_, text)| font::missing(text)).map(|c| format!("no glyph {c}")),
            );
            assert!(faults.is_empty(), "{name} {overrides:?} {goal:?}: {faults:#?}");
            // Every letter finds its place, beside the head of its stand.
            let Picture::Curves(plot) = &found.picture else { panic!("curves") };
            for (index, stand) in plot.scheme.iter().flat_map(|scheme| &scheme.poses).enumerate() {
                let id = format!("letters-{index}");
                let texts = sheet.groups.iter().filter(|group| group.id == id).flat_map(|group| &group.shapes);
                let count = texts.filter(|shape| shape.text_field().is_some()).count();
                assert_eq!(count, stand.joints.len() + 1, "{name} {overrides:?} {}", stand.name);
            }
            let mut ids: Vec<&str> = sheet.groups.iter().map(|group| &*group.id).collect();
            ids.sort_unstable();
            ids.dedup();
            assert_eq!(ids.len(), sheet.groups.len(), "{name}: a name twice");
        }
    }
}

/// The pictures of analyses: labels keep clear of curves, of each other and of the edge, whatever the machine.
#[test]
fn nothing_overlaps_on_the_pictures_of_analyses() {
    let press = |overrides: &[&str]| {
        let owned: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
        Machine::load("dpi", &owned).expect("valid").0
    };
    let named = |name: &str| Machine::load(name, &[]).expect("valid").0;
    let mut pictures = Vec::new();
    for machine in [press(&[]), press(&["buffer.column=return"]), press(&["limits.column=700 mm"])] {
        for reset in [Reset::End, Reset::Level] {
            pictures.push(("regimes", regimes::analysis(&machine, 35.0, &[20.0, 25.0, 30.0, 35.0], reset)));
            pictures.push(("fixed", plain::analysis(&machine, &[12.0, 35.0], reset)));
        }
        pictures.push(("spring", spring::analysis(&machine, &[], &[], None)));
        for rule in [ScrewRule::None, ScrewRule::End, ScrewRule::Level] {
            let sampling = Sampling { samples: 200, rule, ..CUSTOMARY };
            pictures.push(("scatter", scatter::analysis(&machine, 35.0, &[], &sampling)));
        }
    }
    pictures.push(("regimes of a linkage", regimes::analysis(&named("dpi-six-bar"), 35.0, &[25.0, 35.0], Reset::End)));
    for name in ["lever", "feeder", "valve"] {
        pictures.push(("laws", laws::analysis(Some(&named(name)), &LawsOptions::default())));
        pictures.push(("size", size::analysis(&named(name), &[], None)));
    }
    pictures.push(("laws alone", laws::analysis(None, &LawsOptions::default())));
    for (name, found) in pictures {
        let found = found.unwrap_or_else(|why| panic!("{name}: {why}"));
        let (_, sheet) = found.sheets("camgen 0.2.0, inputs 0123456789ab").swap_remove(0);
        let faults = faults(&sheet);
        assert!(faults.is_empty(), "{name} of {}: {faults:#?}", found.machine);
        let (Picture::Curves(plot) | Picture::CurvesWithCard(plot, _)) = &found.picture else { panic!("curves") };
        assert!(!plot.title.is_empty() && !plot.subtitle.is_empty(), "{name}");
        assert!(plot.panels.iter().all(|panel| panel.curves.len() <= 8), "{name}: too many lines");
    }
}

/// The smallest standard sheet is taken, at true size or enlarged wherever an A1 holds it, and the outline has its scale.
#[test]
fn paper_and_scale_are_standard() {
    for (overrides, scale) in [(&["cam.base_radius=40mm"][..], 1.0), (&[], 1.0), (&["cam.base_radius=1000mm"], 0.2)] {
        let drawn = solved("rotary", "dpi", overrides, &[35.0]);
        assert_eq!(drawn.sheet.scale, scale, "{overrides:?}");
        let text = String::from_utf8(svg::write(&drawn.sheet, svg::TEMPLATE).expect("filled")).expect("UTF-8");
        assert!(text.contains(&format!("data-scale=\"{scale}\"")), "{overrides:?}");
    }
}

/// A cam of some centimetres is enlarged, on a larger sheet than it needs at true size.
#[test]
fn a_small_cam_is_enlarged() {
    let mut file = tempfile::NamedTempFile::with_suffix(".toml").expect("a file");
    std::io::Write::write_all(
        &mut file,
        b"name = \"valve lifter\"\n[motion]\nrpm = 300\nstart = \"0 mm\"\n[[motion.segment]]\nover = \"120 deg\"\n\
          to = \"6 mm\"\n[[motion.segment]]\nto = \"0 mm\"\n[follower.roller]\nradius = \"5 mm\"\n[cam]\nbore_radius = \"4 mm\"\n\
          [limits]\nwall = \"1 mm\"\n",
    )
    .expect("written");
    let path = file.path().to_str().expect("UTF-8").to_owned();
    let drawn = solved("make", &path, &[], &[]);
    assert_eq!((drawn.sheet.extents.size().x, drawn.sheet.scale), (420.0, 5.0));
    looks_right("small", &drawn);
    // Under a roller larger than what the motion allows the profile is undercut, and the sheet shows where motion is lost.
    let sharp = ["motion.segment[0].over=50deg", "motion.segment[0].to=14mm", "cam.base_radius=20mm"];
    let lost = solved("make", &path, &[&sharp[..], &["follower.roller.radius=25mm"]].concat(), &[]);
    let marked = |drawn: &Drawn| drawn.review.groups.iter().any(|group| group.class == "lost-motion");
    assert!(marked(&lost) && !marked(&drawn) && !lost.passed);
    looks_right("lost motion", &lost);
}

/// A cam that breaks a limit cannot be taken for a good one.
#[test]
fn a_cam_that_breaks_a_limit_is_stamped() {
    let has = |drawn: &Drawn, words: &str| fields(&drawn.sheet).iter().any(|(_, text)| text.contains(words));
    let good = solved("rotary", "dpi", &[], &[35.0]);
    assert!(good.passed && !has(&good, "NOT FOR MANUFACTURE"));
    let bad = solved("rotary", "dpi", &["cam.base_radius=30mm", "cam.bore_radius=10mm"], &[35.0]);
    assert!(!bad.passed && has(&bad, "NOT FOR MANUFACTURE") && has(&bad, "pressure_angle"));
    looks_right("stamped", &bad);
}

/// `[title]` stands in the block as it was given, and no text is too long for it.
#[test]
fn the_title_block_tells_what_was_given() {
    let given = [
        ("owner", "Полиграфмаш, Завод тяжёлых печатных машин имени всех инженеров"),
        ("part_number", "PM-0417-000-000-12"),
        ("revision", "C"),
        ("date", "2026-11-22"),
        ("designer", "N. N. Designer"),
        ("approved", "M. M."),
        ("general_tolerance", "ISO 2768-mK"),
        ("surface_roughness", "Ra 0.8"),
    ];
    let overrides: Vec<String> = given.iter().map(|(key, value)| format!("title.{key}={value}")).collect();
    let overrides: Vec<&str> = overrides.iter().map(String::as_str).collect();
    let drawn = solved("rotary", "dpi", &overrides, &[35.0]);
    let all: Vec<String> = fields(&drawn.sheet).into_iter().map(|(_, text)| text).collect();
    let all = all.join(" ");
    let squeezed = |text: &str| text.split_whitespace().collect::<String>();
    for (key, value) in given {
        assert!(squeezed(&all).contains(&squeezed(value)), "{key}: {all}");
    }
    looks_right("title", &drawn);
}

/// What a shop machines the bore, the keyway and the profile by: fits with their deviations, datums, the zone of the profile, hardness.
#[test]
fn the_sheet_has_fits_datums_and_tolerances() {
    let overrides = [
        "cam.bore_fit=H7",
        "cam.keyway=auto",
        "cam.keyway.fit=JS9",
        "cam.keyway.angle=45deg",
        "title.profile_tolerance=0.03mm",
        "title.hardness=58+4 HRC",
        "title.case_depth=CHD 0.8+0.4",
        "title.heat_treatment=case-hardened and tempered",
        "title.edges=0.3 x 45°",
    ];
    let drawn = solved("make", "feeder", &overrides, &[]);
    let all: Vec<String> = fields(&drawn.sheet).into_iter().map(|(_, text)| text).collect();
    for wanted in [
        "Ø24 H7 +0.021/0",
        "8 JS9 ±0.018 at ψ 45°",
        "27.3 +0.2/0 over the bore",
        "keyway DIN 6885-1, through",
        "0.03",
        "A",
        "B",
        "case-hardened and tempered, 58+4 HRC, CHD 0.8+0.4",
        "0.3 x 45°",
        "start of cut (climb)",
        "15 ±0.1 *",
        "A–A",
    ] {
        assert!(all.iter().any(|text| text == wanted), "{wanted}: {all:?}");
    }
    looks_right("fits", &drawn);
    // What nobody has given is proposed, and says so.
    let has = |drawn: &Drawn, words: &str| fields(&drawn.sheet).iter().any(|(_, text)| text == words);
    let of_lift = solved("make", "feeder", &["title.lift_tolerance=0.015mm"], &[]);
    assert!(has(&of_lift, "0.026"), "2 · 0.015 · cos 29.55°, rounded down");
    let bare = solved("make", "feeder", &[], &[]);
    assert!(
        has(&bare, "Ø24 H7 +0.021/0 *")
            && has(&bare, "hardened, 58+4 HRC *")
            && has(&bare, "steel for hardening *")
            && has(&bare, "0.04")
    );
    assert!(has(&bare, "* and the frames of tolerances: proposed by camgen, to be confirmed at release"));
}

/// A swinging follower is shown with its pivot, its arm and both ends of its swing.
#[test]
fn the_sheet_of_a_lever_has_its_pivot_and_its_ends() {
    let drawn = solved("make", "lever", &[], &[]);
    let all: Vec<String> = fields(&drawn.review).into_iter().map(|(_, text)| text).collect();
    for wanted in ["pivot, 140 from the shaft", "arm 110", "lowest", "highest"] {
        assert!(all.iter().any(|text| text == wanted), "{wanted}: {all:?}");
    }
    looks_right("lever", &drawn);
}

/// The page of the PDF is the sheet, and the font is in the file.
#[test]
fn the_pdf_has_the_size_of_the_sheet_and_its_font() {
    let drawn = solved("rotary", "dpi", &[], &[35.0]);
    let bytes = pdf::write(&drawn.sheet, svg::TEMPLATE).expect("a PDF");
    assert_eq!(bytes, pdf::write(&drawn.sheet, svg::TEMPLATE).expect("a PDF"), "the same bytes again");
    let text = String::from_utf8_lossy(&bytes);
    let page = text.split("/MediaBox").nth(1).expect("a page");
    let numbers: Vec<f64> = page
        .split([' ', '[', ']', '\n', '/'])
        .filter(|word| !word.is_empty())
        .map_while(|word| word.parse().ok())
        .collect();
    let size = drawn.sheet.extents.size() * (72.0 / 25.4);
    assert!((numbers[2] - size.x).abs() < 0.01 && (numbers[3] - size.y).abs() < 0.01, "{numbers:?} {size:?}");
    assert!(text.contains("/FontFile") && text.contains("LiberationSans"));
}

#[test]
fn a_text_of_the_font_has_the_width_that_is_told() {
    let drawn = solved("rotary", "dpi", &[], &[35.0]);
    let text = String::from_utf8(svg::write(&drawn.sheet, svg::TEMPLATE).expect("filled")).expect("UTF-8");
    assert!(text.contains("textLength"));
    assert!((font::width("Scale", 10.0) - 10.0 * (1366.0 + 1024.0 + 1139.0 + 455.0 + 1139.0) / 2048.0).abs() < 1e-9);
}

/// A shop that cuts the keyway by hand needs its sizes and its place: they are on the sheet wherever it lies.
#[test]
fn a_keyway_is_on_every_sheet() {
    let texts = |drawn: &Drawn| -> String {
        let shapes = drawn.sheet.groups.iter().flat_map(|group| &group.shapes);
        shapes
            .filter_map(|shape| if let SheetShape::Text { text, .. } = shape { Some(text.as_str()) } else { None })
            .collect()
    };
    let keyway = ["cam.keyway.width=8mm", "cam.keyway.depth=3.3mm"];
    for degrees in (-180..180).step_by(20) {
        let angle = format!("cam.keyway.angle={degrees} deg");
        for design in ["groove", "conjugate", "feeder"] {
            let drawn = solved("make", design, &[&keyway[..], &[&angle, "cam.bore_diameter=25mm"]].concat(), &[]);
            assert!(texts(&drawn).contains("8 P9") && texts(&drawn).contains("28.3 +0.2/0"), "{design} {degrees}");
        }
    }
    for design in ["barrel", "indexer"] {
        let drawn = solved("make", design, &keyway, &[]);
        assert!(texts(&drawn).contains("8 P9") && texts(&drawn).contains("over the bore"), "{design}");
    }
}
