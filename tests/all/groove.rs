//! A body of one's own with two flanks: a groove that guides a roller from both sides. Each flank is a cut with its own exact curve, its own
//! outline as read back and its own rolling, and a measure of its own is judged by a check of its own.

use camgen::Refusal;
use camgen::body::{Body, Cut, DrawError, DrawingEvidence, Drawn, Kind, Part, Request, WorstPlaces};
use camgen::check::{Check, CheckExplanation, CheckScope, Measures};
use camgen::follower::TranslatingRoller;
use camgen::machine::Machine;
use camgen::motion::{Jet, Motion, Piece};
use camgen::pipeline::{Cam, Spec, Writing};
use camgen::profile::Curves;
use camgen::profile::outline::{self, OutlineError};
use camgen::report::mechanism::MovingMechanism;
use camgen::report::sheet::SheetView;
use camgen::report::{Bound, Section, Speeds, Verdict};
use camgen::table::Row;
use nalgebra::Vector2;
use std::f64::consts::TAU;

const TOLERANCE: f64 = 5e-6;
const RADIUS: f64 = 0.008;
const NAMES: [&str; 2] = ["inner", "outer"];

const KIND: Kind = Kind { command: "groove", noun: "groove cam", keys: "make" };

const CLEARANCE: Check = Check {
    name: "clearance",
    on: CheckScope::Cam,
    unit: "mm",
    about: "The room that the roller has between the two flanks.",
    explained: CheckExplanation {
        bound: Bound::AtLeast,
        formula: "the width of the groove less the diameter of the roller",
        usual: "0.01 mm",
        change: "a wider groove",
    },
};

#[derive(Debug)]
struct Wave;

impl Motion for Wave {
    fn pieces(&self) -> &[Piece] {
        &[Piece { start: 0.0, end: TAU, dwell: false }]
    }

    fn jet(&self, _: usize, angle: f64) -> Jet {
        let (sin, cos) = (libm::sin(2.0 * angle), libm::cos(2.0 * angle));
        Jet { s: 0.004 * (1.0 - cos), ds: 0.008 * sin, dds: 0.016 * cos, ddds: -0.032 * sin }
    }
}

#[derive(Debug)]
struct Groove {
    machine: Machine,
    /// The roller on the flank nearer to the shaft, and on the one that lies round it.
    rollers: [TranslatingRoller; 2],
    worst: [WorstPlaces; 2],
    clearance: f64,
}

impl Groove {
    fn new(machine: &Machine, clearance: f64) -> Self {
        let roller = |radius: f64| TranslatingRoller::new(0.06, 0.002, radius);
        let (machine, worst) = (machine.clone(), Default::default());
        Self { machine, rollers: [roller(RADIUS), roller(-RADIUS)], worst, clearance }
    }

    fn curves(&self) -> [Curves<'_>; 2] {
        [0, 1].map(|flank| Curves { motion: &Wave, follower: &self.rollers[flank] })
    }
}

impl Body for Groove {
    fn kind(&self) -> &'static Kind {
        &KIND
    }

    fn machine(&self) -> &Machine {
        &self.machine
    }

    fn speeds(&self) -> Speeds {
        Speeds::Any(())
    }

    fn cuts(&self) -> Vec<Cut<'_>> {
        let [inner, outer] = self.curves();
        let cut = |flank: usize, curves| Cut { name: NAMES[flank], ..Cut::plane(curves, &[false], &self.worst[flank]) };
        vec![cut(0, inner), cut(1, outer)]
    }

    fn parameter_at(&self, point: Vector2<f64>) -> f64 {
        libm::atan2(point.y, point.x)
    }

    fn measures(&self, of: &mut Measures<'_>) {
        of.add(&CLEARANCE, |_| CLEARANCE.measure(1e3 * self.clearance, Some(0.01)));
    }

    fn draw(&self, request: &Request) -> Result<Drawn, DrawError> {
        let part = |(name, curves)| -> Result<Part, OutlineError> {
            let outline = outline::profile(curves, request.fit)?;
            Ok(Part { name, ..Part::solid_plate(outline) })
        };
        let parts = NAMES.into_iter().zip(self.curves()).map(part).collect::<Result<_, _>>()?;
        Ok(Drawn::of(parts))
    }

    fn rows(&self, _: u32) -> Vec<Row> {
        Vec::new()
    }

    fn sections(&self, found: &DrawingEvidence<'_>) -> Vec<Section> {
        vec![Section::new("rolling", &found.rolled)]
    }

    fn mechanism(&self, _: &Drawn, _: u32) -> MovingMechanism {
        MovingMechanism::default()
    }

    fn not_modelled(&self) -> Vec<&'static str> {
        Vec::new()
    }

    fn view(&self, _: &Drawn) -> Result<SheetView, OutlineError> {
        Ok(SheetView::default())
    }
}

fn groove(clearance: f64) -> Cam {
    let machine = Spec::builder("groove").roller(RADIUS).base_radius(0.05).machine().expect("in range");
    Spec::new(machine, move |machine| Ok::<_, Refusal>(Groove::new(machine, clearance))).solve().expect("a cam")
}

#[test]
fn both_flanks_of_a_groove_are_drawn_proved_and_written() {
    let cam = groove(2e-5);
    let proven = cam.draw(TOLERANCE).expect("two outlines").prove().expect("a proof");
    assert!(proven.passed(), "{:#?}", proven.findings());
    let of = |name: &str| proven.findings().iter().find(|found| found.check == name).expect("checked");
    for check in ["outline", "rolling", "tangency", "clearance"] {
        assert_eq!(of(check).verdict, Verdict::Pass, "{:?}", of(check));
    }
    assert_eq!(proven.findings().last().map(|found| &*found.check), Some("clearance"));
    let rolled = proven.report().section("rolling").cloned().expect("a section");
    assert_eq!(rolled.as_array().map(Vec::len), Some(2), "{rolled}");
    let sizes: Vec<f64> = proven.outlines().iter().map(|outline| outline.contour.area_and_centroid().0).collect();
    assert!(sizes[1] > 1.5 * sizes[0], "{sizes:?}");
    let files = proven.files(&Writing::to("nowhere", "groove").formats(&["dxf"])).expect("files");
    let names: Vec<&str> = files.outputs().iter().map(|output| output.name.as_str()).collect();
    assert_eq!(names, ["groove-inner.dxf", "groove-outer.dxf"]);
    // Each file is checked against its own cut.
    for (flank, name) in NAMES.into_iter().enumerate() {
        let own = cam.check_cut(&proven.cut_files()[flank], name, TOLERANCE).expect("a DXF file");
        assert!(own.passed(), "{name}: {:#?}", own.checks);
        let other = cam.check_cut(&proven.cut_files()[1 - flank], name, TOLERANCE).expect("a DXF file");
        assert!(!other.passed(), "{name}");
    }
    let tight = groove(1e-6).draw(TOLERANCE).expect("two outlines").prove().expect("a proof");
    assert!(!tight.passed());
}
