//! How a cam is milled: what a program for a machining centre contains besides its path.

use camgen_kernel::document::Presence::{Default, Optional};
use camgen_kernel::document::cams::FLAT;
use camgen_kernel::document::range::{LARGEST_NUMBER, LONGEST};
use camgen_kernel::document::{Field, KeySection, NamedChoice, Occurrence, Reader, above, within};
use camgen_kernel::units::Dimension::{Length, Speed};
use camgen_kernel::units::LengthUnit;

/// A control, whose words a program is written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Controller {
    /// LinuxCNC: RS-274/NGC.
    #[default]
    LinuxCnc,
    /// FANUC 0i, 30i: ISO code.
    Fanuc,
    /// SINUMERIK 840D, 828D.
    Sinumerik,
    /// HEIDENHAIN TNC, in its dialogue (Klartext).
    Heidenhain,
}

/// The words of the controls.
const CONTROLLERS: &[&str] = &["linuxcnc", "fanuc", "sinumerik", "heidenhain"];
/// The controls, in the same order.
const ALL_CONTROLLERS: &[Controller] =
    &[Controller::LinuxCnc, Controller::Fanuc, Controller::Sinumerik, Controller::Heidenhain];

impl NamedChoice for Controller {
    const ALL: &'static [(&'static str, Self)] = &[
        ("linuxcnc", Self::LinuxCnc),
        ("fanuc", Self::Fanuc),
        ("sinumerik", Self::Sinumerik),
        ("heidenhain", Self::Heidenhain),
    ];
}

impl Controller {
    /// Decimals that it takes without another setting: the 0.001 mm or 0.0001 in of FANUC's increment system IS-B, 0.0001 mm or 0.00001 in of the
    /// others.
    #[must_use]
    pub fn decimals(self, units: LengthUnit) -> u32 {
        let of_millimetre = match self {
            Self::Fanuc => 3,
            Self::LinuxCnc | Self::Sinumerik | Self::Heidenhain => 4,
        };
        of_millimetre + u32::from(units == LengthUnit::Inch)
    }

    /// Share of the tolerance for path smoothing by the control, if its path mode takes a tolerance: CTOL of SINUMERIK, cycle 32 of HEIDENHAIN. LinuxCNC
    /// keeps its path (G61); FANUC has no such number.
    #[must_use]
    pub fn smoothing_share(self) -> f64 {
        match self {
            Self::Sinumerik | Self::Heidenhain => 0.2,
            Self::LinuxCnc | Self::Fanuc => 0.0,
        }
    }

    /// The ending that it expects of the name of a program.
    #[must_use]
    pub fn ending(self) -> &'static str {
        match self {
            Self::LinuxCnc => ".ngc",
            Self::Fanuc => ".nc",
            Self::Sinumerik => ".mpf",
            Self::Heidenhain => ".h",
        }
    }
}

/// The sense in which a flank is milled by a cutter that turns clockwise.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MillingDirection {
    /// Down: the cutter is on the left of the path, as G41 has it.
    Climb,
    /// Up: on the right, as G42 has it.
    Conventional,
}

/// Where the radius of the cutter is taken into account.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RadiusCompensation {
    /// In the program, which is the path of the cutter's centre (G40), where the cutter is known.
    Program,
    /// In the control: the program is the profile (G41 or G42).
    Control,
}

/// How a disc is cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum CuttingForm {
    /// In X and Y, by a milling cutter.
    #[default]
    Milling,
    /// In polar coordinates, by a wheel: the axis C turns the disc, X moves the wheel.
    Polar,
}

/// `[cut]`, SI, or what holds without it.
#[derive(Debug, Clone, PartialEq)]
pub struct CuttingData {
    /// The control.
    pub controller: Controller,
    /// How it is cut.
    pub form: CuttingForm,
    /// Decimals of lengths; `None`: those of the control.
    pub decimals: Option<u32>,
    /// Lines between the program's own settings and its first move to the part.
    pub preamble: Vec<String>,
    /// Lines after the last move.
    pub postamble: Vec<String>,
    /// Feed along the path, m/s.
    pub feed: f64,
    /// Feed into the material, m/s.
    pub plunge_feed: f64,
    /// Spindle speed, rpm; without it the program stops for the operator to start the spindle.
    pub spindle: Option<f64>,
    /// Tool number for the tool change; without it the program stops for the operator to load the tool.
    pub tool: Option<u32>,
    /// Number of the program, for a control that names programs by numbers.
    pub program: u32,
    /// How deep it is cut, m; `None`: through the disc, or as deep as its groove.
    pub depth: Option<f64>,
    /// Depth of a pass, m; `None`: all in one.
    pub depth_per_pass: Option<f64>,
    /// How far below its lower face a disc is cut, m.
    pub overrun: f64,
    /// Height above the upper face at which the cutter moves freely, m.
    pub clearance: f64,
    /// Z in machine coordinates to which the tool rises before the tool change and at the end, m; `None`: the control's usual height.
    pub home: Option<f64>,
    /// The sense of milling.
    pub direction: MillingDirection,
    /// Where the radius of the cutter is taken into account.
    pub compensation: RadiusCompensation,
}

/// Largest number of a tool or a program that all of the controls take.
const LARGEST_TOOL: f64 = 9999.0;
/// Fastest feed, m/s.
const FASTEST: f64 = 10.0;
/// Slowest feed, m/s: 0.1 mm/min; programs have three decimals of it.
const SLOWEST: f64 = 0.1 / 60e3;
/// Least depth of a cut or of a pass, m: below it there is no chip.
const SHALLOWEST: f64 = 1e-5;

const CONTROLLER: Field<Controller> = Field::words(
    "controller",
    "the control that a program of --format gcode is for; --controller takes precedence",
    Default("linuxcnc"),
    CONTROLLERS,
    ALL_CONTROLLERS,
)
.also(&["control", "machine", "post"]);
const FORM: Field<CuttingForm> = Field::words(
    "form",
    "\"milling\" in X and Y, or \"polar\": the axis C turns a disc, X moves the centre of the wheel of --cutter-diameter, each block with its time \
     (G93); not for heidenhain",
    Default("milling"),
    &["milling", "polar"],
    &[CuttingForm::Milling, CuttingForm::Polar],
);
const DECIMALS: Field<f64> = Field::number(
    "decimals",
    "decimals of the lengths in a program, 3 to 6; 4 when absent, 3 for fanuc (4 with increment system IS-C); one more in inches",
    Optional("4"),
    within(3.0, 6.0),
)
.also(&["digits"]);
const PREAMBLE: Field<Vec<String>> = Field::texts(
    "preamble",
    "lines between the tool change and the first move to the part, e.g. the coolant, or another datum than G54",
    Optional("[\"G55\", \"M8\"]"),
)
.also(&["header", "start"]);
const POSTAMBLE: Field<Vec<String>> = Field::texts(
    "postamble",
    "lines before the end of a program, after M9, M5 and the move to cut.home",
    Optional("[\"G0 X0 Y0\"]"),
)
.also(&["footer", "end"]);
const FEED: Field<f64> = Field::quantity(
    "feed",
    "feed of the cutter along its path",
    Default("300 mm/min"),
    Speed,
    within(SLOWEST, FASTEST),
)
.also(&["feed_rate", "f"]);
const PLUNGE_FEED: Field<f64> = Field::quantity(
    "plunge_feed",
    "feed of the cutter into the material, along its axis",
    Default("100 mm/min"),
    Speed,
    within(SLOWEST, FASTEST),
);
const SPINDLE: Field<f64> = Field::number(
    "spindle",
    "speed of the spindle in rpm, clockwise; without it a program stops (M0) for the operator to start it",
    Optional("3000"),
    above(0.0, LARGEST_NUMBER),
)
.also(&["speed", "s", "rpm"]);
const TOOL: Field<f64> = Field::number(
    "tool",
    "number of the tool for the tool change, its length, and its radius for G41 and G42; without it a program stops (M0) for the operator to load \
     the tool, and the radius has number 1",
    Optional("1"),
    within(1.0, LARGEST_TOOL),
);
const PROGRAM: Field<f64> =
    Field::number("program", "number of a program for fanuc, O0001", Default("1"), within(1.0, LARGEST_TOOL));
const DEPTH: Field<f64> = Field::quantity(
    "depth",
    "how deep is cut from the upper face; through the thickness, or as deep as the groove, when absent",
    Optional("12 mm"),
    Length,
    within(SHALLOWEST, LONGEST),
);
const DEPTH_PER_PASS: Field<f64> = Field::quantity(
    "depth_per_pass",
    "largest depth of a pass, of passes that are equally deep; one pass when absent",
    Optional("4 mm"),
    Length,
    within(SHALLOWEST, LONGEST),
)
.also(&["step", "stepdown", "pass"]);
const OVERRUN: Field<f64> = Field::quantity(
    "overrun",
    "how far a cut that goes through reaches below the lower face",
    Default("0 mm"),
    Length,
    within(0.0, LONGEST),
);
const CLEARANCE: Field<f64> = Field::quantity(
    "clearance",
    "height above the upper face at which the cutter moves freely, and to which it returns",
    Default("5 mm"),
    Length,
    above(0.0, LONGEST),
)
.also(&["safe_height", "retract"]);
const HOME: Field<f64> = Field::quantity(
    "home",
    "Z in machine coordinates to which the tool rises before the tool change and at the end; when absent 0 mm for linuxcnc and sinumerik, -1 mm for \
     heidenhain, and the reference point (G28) for fanuc",
    Optional("-1 mm"),
    Length,
    within(-LONGEST, LONGEST),
);
const DIRECTION: Field<MillingDirection> = Field::words(
    "direction",
    "\"climb\" (down milling) or \"conventional\" (up), of a cutter that turns clockwise",
    Default("climb"),
    &["climb", "conventional"],
    &[MillingDirection::Climb, MillingDirection::Conventional],
);
const COMPENSATION: Field<RadiusCompensation> = Field::words(
    "compensation",
    "where the radius of the cutter is taken into account: \"program\", the path of its centre (G40) where --cutter-diameter gives it, or \
     \"control\", the profile with G41 or G42",
    Default("program"),
    &["program", "control"],
    &[RadiusCompensation::Program, RadiusCompensation::Control],
);

/// `[cut]`.
pub(super) const SECTION: KeySection = KeySection {
    path: "cut",
    about: "how it is milled, for the programs of --format gcode",
    occurs: Occurrence::Optional,
    cams: FLAT,
    keys: &[
        CONTROLLER.key,
        FORM.key,
        DECIMALS.key,
        PREAMBLE.key,
        POSTAMBLE.key,
        FEED.key,
        PLUNGE_FEED.key,
        SPINDLE.key,
        TOOL.key,
        PROGRAM.key,
        DEPTH.key,
        DEPTH_PER_PASS.key,
        OVERRUN.key,
        CLEARANCE.key,
        HOME.key,
        DIRECTION.key,
        COMPENSATION.key,
    ],
};

/// What holds without `[cut]`: the defaults of its keys.
const USUAL_FEED: f64 = 300.0 / 60e3;
const USUAL_PLUNGE_FEED: f64 = 100.0 / 60e3;
const USUAL_CLEARANCE: f64 = 5e-3;

impl std::default::Default for CuttingData {
    fn default() -> Self {
        Self {
            controller: Controller::default(),
            form: CuttingForm::default(),
            decimals: None,
            preamble: Vec::new(),
            postamble: Vec::new(),
            feed: USUAL_FEED,
            plunge_feed: USUAL_PLUNGE_FEED,
            spindle: None,
            tool: None,
            program: 1,
            depth: None,
            depth_per_pass: None,
            overrun: 0.0,
            clearance: USUAL_CLEARANCE,
            home: None,
            direction: MillingDirection::Climb,
            compensation: RadiusCompensation::Program,
        }
    }
}

/// Longest line of a preamble or a postamble, characters: what the blocks of all of the controls take.
const LONGEST_LINE: usize = 80;

pub(super) fn read(reader: &Reader<'_>) -> Option<CuttingData> {
    let table = reader.find(&SECTION)?;
    let whole = |field: &Field<f64>| {
        let number = table.get(field)?;
        if number.fract() != 0.0 {
            table.fail(field, format!("cut.{} must be a whole number", field.key.name), None);
        }
        // Within its bounds, which are far smaller than the type.
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to 9999")]
        Some(number as u32)
    };
    let lines = |field: &Field<Vec<String>>| {
        let lines = table.get(field).unwrap_or_default();
        let fits = |line: &String| line.len() <= LONGEST_LINE && line.bytes().all(|byte| (b' '..=b'~').contains(&byte));
        if let Some(line) = lines.iter().find(|line| !fits(line)) {
            let start: String = line.chars().filter(char::is_ascii_graphic).take(20).collect();
            let help = format!("a line of a program has at most {LONGEST_LINE} ASCII characters");
            table.fail(field, format!("cut.{}: no control reads the line `{start}`", field.key.name), Some(help));
        }
        lines
    };
    Some(CuttingData {
        controller: table.get(&CONTROLLER)?,
        form: table.get(&FORM)?,
        decimals: whole(&DECIMALS),
        preamble: lines(&PREAMBLE),
        postamble: lines(&POSTAMBLE),
        feed: table.get(&FEED)?,
        plunge_feed: table.get(&PLUNGE_FEED)?,
        spindle: table.get(&SPINDLE),
        tool: whole(&TOOL),
        program: whole(&PROGRAM)?,
        depth: table.get(&DEPTH),
        depth_per_pass: table.get(&DEPTH_PER_PASS),
        overrun: table.get(&OVERRUN)?,
        clearance: table.get(&CLEARANCE)?,
        home: table.get(&HOME),
        direction: table.get(&DIRECTION)?,
        compensation: table.get(&COMPENSATION)?,
    })
}
