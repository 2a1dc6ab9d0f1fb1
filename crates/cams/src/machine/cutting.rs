//! How a cam is milled: what a program for a machining centre contains besides its path.

use camgen_kernel::document::Presence::{Default, Optional};
use camgen_kernel::document::cams::FLAT;
use camgen_kernel::document::range::{LARGEST_NUMBER, LONGEST};
use camgen_kernel::document::{Field, KeySection, NamedChoice, Occurrence, Reader, above, within};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::text::shown;
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
    /// grbl and grblHAL: a subset of RS-274 without tool change, tool length and radius compensation.
    Grbl,
    /// Mach3: RS-274, with G91.1 stated because arc centres are absolute or relative by its set-up.
    Mach3,
}

/// The words of the controls.
const CONTROLLERS: &[&str] = &["linuxcnc", "fanuc", "sinumerik", "heidenhain", "grbl", "mach3"];
/// The controls, in the same order.
const ALL_CONTROLLERS: &[Controller] = &[
    Controller::LinuxCnc,
    Controller::Fanuc,
    Controller::Sinumerik,
    Controller::Heidenhain,
    Controller::Grbl,
    Controller::Mach3,
];

impl NamedChoice for Controller {
    const ALL: &'static [(&'static str, Self)] = &[
        ("linuxcnc", Self::LinuxCnc),
        ("fanuc", Self::Fanuc),
        ("sinumerik", Self::Sinumerik),
        ("heidenhain", Self::Heidenhain),
        ("grbl", Self::Grbl),
        ("mach3", Self::Mach3),
    ];
}

impl Controller {
    /// Decimals that it takes without another setting: the 0.001 mm or 0.0001 in of FANUC's increment system IS-B, 0.0001 mm or 0.00001 in of the
    /// others.
    #[must_use]
    pub fn decimals(self, units: LengthUnit) -> u32 {
        let of_millimetre = match self {
            Self::Fanuc => 3,
            Self::LinuxCnc | Self::Sinumerik | Self::Heidenhain | Self::Grbl | Self::Mach3 => 4,
        };
        of_millimetre + u32::from(units == LengthUnit::Inch)
    }

    /// Share of the tolerance for path smoothing by the control, if its path mode takes a tolerance: CTOL of SINUMERIK, cycle 32 of HEIDENHAIN. LinuxCNC
    /// and Mach3 keep their path (G61), grbl always does; FANUC has no such number.
    #[must_use]
    pub fn smoothing_share(self) -> f64 {
        match self {
            Self::Sinumerik | Self::Heidenhain => 0.2,
            Self::LinuxCnc | Self::Fanuc | Self::Grbl | Self::Mach3 => 0.0,
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
            Self::Grbl => ".gcode",
            Self::Mach3 => ".tap",
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

/// The coolant during the cuts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Coolant {
    /// Off: M9 at the end.
    #[default]
    Off,
    /// M7.
    Mist,
    /// M8.
    Flood,
}

impl Coolant {
    /// The word that switches it on.
    #[must_use]
    pub fn word(self) -> Option<&'static str> {
        match self {
            Self::Off => None,
            Self::Mist => Some("M7"),
            Self::Flood => Some("M8"),
        }
    }
}

/// How the cutter reaches its depth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum CutterEntry {
    /// Down outside the blank of an outer profile, down a ramp in a groove and in a hollow outline.
    #[default]
    Auto,
    /// Straight down at the start of the pass.
    Plunge,
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
    /// Lines before the first block after the modal words.
    pub header: Vec<String>,
    /// Lines after each tool change.
    pub after_tool: Vec<String>,
    /// Lines before the end, before coolant and spindle are switched off.
    pub footer: Vec<String>,
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
    /// Height above the upper face from which the cutter moves at its feed, m.
    pub clearance: f64,
    /// Height above part and clamps at which the cutter moves in X and Y, m.
    pub safe_height: f64,
    /// Coolant.
    pub coolant: Coolant,
    /// Whether arcs are written as arcs, rather than as chords.
    pub arcs: bool,
    /// How the cutter reaches its depth.
    pub entry: CutterEntry,
    /// Stock of the blank beyond the bounding circle or rectangle of the outline, m; `None`: the usual 3 mm.
    pub blank_margin: Option<f64>,
    /// Stock that the roughing passes keep on the flanks, m; 0: no roughing passes.
    pub allowance: f64,
    /// Passes at size and full depth behind the roughing passes, or behind the passes of each depth.
    pub finish_passes: u32,
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
.also(&["start"]);
const POSTAMBLE: Field<Vec<String>> = Field::texts(
    "postamble",
    "lines before the end of a program, after M9, M5 and the move to cut.home",
    Optional("[\"G0 X0 Y0\"]"),
)
.also(&["end"]);
const HEADER: Field<Vec<String>> = Field::texts(
    "header",
    "lines before the first block of a program, after its comments and its modal words",
    Optional("[\"G55\"]"),
);
const AFTER_TOOL: Field<Vec<String>> = Field::texts(
    "after_tool",
    "lines directly after each tool change, or after the stop at which the operator loads the tool",
    Optional("[\"M1\"]"),
);
const FOOTER: Field<Vec<String>> = Field::texts(
    "footer",
    "lines after the last pass, before coolant and spindle are switched off",
    Optional("[\"M1\"]"),
);
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
    "height above the upper face to which the cutter comes down fast, and from which it moves at its feed",
    Default("5 mm"),
    Length,
    above(0.0, LONGEST),
)
.also(&["retract"]);
const SAFE_HEIGHT: Field<f64> = Field::quantity(
    "safe_height",
    "height above the upper face, clear of part and clamps, at which the cutter moves in X and Y before it comes down to cut.clearance; the larger of 50 mm \
     and cut.clearance when absent",
    Optional("60 mm"),
    Length,
    above(0.0, LONGEST),
)
.also(&["rapid_height", "safe_z"]);
const COOLANT: Field<Coolant> = Field::words(
    "coolant",
    "\"flood\" (M8) or \"mist\" (M7) from the start of the spindle to the end, or \"off\"",
    Default("off"),
    &["off", "mist", "flood"],
    &[Coolant::Off, Coolant::Mist, Coolant::Flood],
);
const ARCS: Field<bool> = Field::boolean(
    "arcs",
    "whether arcs are written as arcs (G2, G3); with false as chords within the tolerance, for a control or a cam that needs lines",
    Default("true"),
);
const ENTRY: Field<CutterEntry> = Field::words(
    "entry",
    "how the cutter reaches its depth: \"auto\", down outside the blank of an outer profile, and down a ramp of 3 deg along the path in grooves and hollow \
     outlines; or \"plunge\", straight down at the start of the pass, into metal unless it was drilled before",
    Default("auto"),
    &["auto", "plunge"],
    &[CutterEntry::Auto, CutterEntry::Plunge],
);
const BLANK_MARGIN: Field<f64> = Field::quantity(
    "blank_margin",
    "stock of the blank beyond the circle about the shaft, or the rectangle of a plate, that holds the outline: the cutter goes down outside it; 3 mm when \
     absent",
    Optional("5 mm"),
    Length,
    within(0.0, LONGEST),
)
.also(&["stock", "blank"]);
const ALLOWANCE: Field<f64> = Field::quantity(
    "allowance",
    "stock that roughing passes at every depth keep on the flanks for the finishing passes at full depth; without it no pass is a roughing pass",
    Default("0 mm"),
    Length,
    within(0.0, LONGEST),
)
.also(&["stock_to_leave", "finish_allowance"]);
const FINISH_PASSES: Field<f64> = Field::number(
    "finish_passes",
    "passes at size and full depth, 1 to 10: those after the first are spring passes, without infeed",
    Default("1"),
    within(1.0, 10.0),
)
.also(&["spring_passes"]);
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
        HEADER.key,
        AFTER_TOOL.key,
        FOOTER.key,
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
        SAFE_HEIGHT.key,
        HOME.key,
        COOLANT.key,
        DIRECTION.key,
        COMPENSATION.key,
        ARCS.key,
        ENTRY.key,
        BLANK_MARGIN.key,
        ALLOWANCE.key,
        FINISH_PASSES.key,
    ],
};

/// What holds without `[cut]`: the defaults of its keys.
const USUAL_FEED: f64 = 300.0 / 60e3;
const USUAL_PLUNGE_FEED: f64 = 100.0 / 60e3;
const USUAL_CLEARANCE: f64 = 5e-3;
/// Height that clears the clamps of a vice or a strap, m.
const USUAL_SAFE_HEIGHT: f64 = 50e-3;
/// Stock of a blank beyond its outline, m: what a saw or a torch needs.
const USUAL_BLANK_MARGIN: f64 = 3e-3;

impl CuttingData {
    /// Stock of the blank beyond the bounding circle or rectangle of the outline, m.
    #[must_use]
    pub fn blank_margin(&self) -> f64 {
        self.blank_margin.unwrap_or(USUAL_BLANK_MARGIN)
    }
}

impl std::default::Default for CuttingData {
    fn default() -> Self {
        Self {
            controller: Controller::default(),
            form: CuttingForm::default(),
            decimals: None,
            header: Vec::new(),
            after_tool: Vec::new(),
            footer: Vec::new(),
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
            safe_height: USUAL_SAFE_HEIGHT,
            coolant: Coolant::Off,
            arcs: true,
            entry: CutterEntry::Auto,
            blank_margin: None,
            allowance: 0.0,
            finish_passes: 1,
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
    let clearance = table.get(&CLEARANCE)?;
    let safe_height = table.get(&SAFE_HEIGHT).unwrap_or(USUAL_SAFE_HEIGHT.max(clearance));
    if safe_height < clearance {
        let [safe, clear] = [safe_height, clearance].map(|height| shown(MILLIMETRES * height));
        let what = format!("cut.safe_height of {safe} mm is below cut.clearance of {clear} mm");
        table.fail(&SAFE_HEIGHT, what, Some(format!("give a cut.safe_height of at least {clear} mm")));
    }
    let (controller, compensation) = (table.get(&CONTROLLER)?, table.get(&COMPENSATION)?);
    if controller == Controller::Grbl && compensation == RadiusCompensation::Control {
        let what = "cut.compensation = \"control\": grbl has no compensation of the cutter's radius (G41, G42)";
        table.fail(
            &COMPENSATION,
            what.to_owned(),
            Some("give cut.compensation = \"program\" and --cutter-diameter".into()),
        );
    }
    Some(CuttingData {
        controller,
        form: table.get(&FORM)?,
        decimals: whole(&DECIMALS),
        header: lines(&HEADER),
        after_tool: lines(&AFTER_TOOL),
        footer: lines(&FOOTER),
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
        clearance,
        safe_height,
        home: table.get(&HOME),
        coolant: table.get(&COOLANT)?,
        direction: table.get(&DIRECTION)?,
        compensation,
        arcs: table.get(&ARCS)?,
        entry: table.get(&ENTRY)?,
        blank_margin: table.get(&BLANK_MARGIN),
        allowance: table.get(&ALLOWANCE)?,
        finish_passes: whole(&FINISH_PASSES)?,
    })
}
