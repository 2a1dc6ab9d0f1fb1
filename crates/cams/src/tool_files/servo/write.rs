//! Tables for servo drives: a CSV file, a cam of CODESYS SoftMotion, and a motion function of TwinCAT. All have the same nodes.

use super::super::tool_file::WrittenFile;
use super::plan::{ServoTable, advance};
use crate::body::{Body, LoadAsCut};
use crate::write::number::{plain, shortest};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::Quantity;
use camgen_kernel::refusal::Refusal;
use camgen_kernel::units::LengthUnit;

/// Units of a table of the controls of ISG in a millimetre or a degree, and the decimals of its numbers.
const TEN_THOUSANDTHS: f64 = 1e4;
const ISG_DECIMALS: usize = 6;

/// Rows of master, slave, velocity and acceleration.
pub(super) const CSV: &str = "servo-csv";
/// The declaration of an `MC_CAM_REF` of CODESYS SoftMotion with its `SMC_CAMXYVA` points.
pub(super) const XYVA: &str = "servo-xyva";
/// The declaration of the `MC_MotionFunctionPoint` points of a cam of TwinCAT.
pub(super) const TWINCAT: &str = "servo-twincat";
/// The table of a cam of the controls of ISG and of TwinCAT CNC, in their ASCII form.
pub(super) const ISG: &str = "servo-isg";

/// All of them.
pub(super) const FORMATS: [&str; 4] = [CSV, XYVA, TWINCAT, ISG];

/// A table in each of the formats, under a mark.
pub(super) fn write(body: &dyn Body, table: &ServoTable, mark: &str) -> Vec<WrittenFile> {
    let units = if table.swings { LengthUnit::Millimetre } else { body.machine().units() };
    let head = [vec![mark.to_owned()], statements(body, table.nodes.len(), units)].concat();
    // The drive of a table in inches has positions in inches; of a swinging follower they are angles.
    let nodes: Vec<[f64; 4]> =
        table.nodes.iter().map(|[x, y, v, a]| [*x, units.of_mm(*y), units.of_mm(*v), units.of_mm(*a)]).collect();
    let scaled = ServoTable { nodes, ..table.clone() };
    let file = |format: &'static str, ending: &str, text: String| WrittenFile {
        format,
        ending: ending.to_owned(),
        bytes: Ok(text.into_bytes()),
    };
    let equal_parts = match &table.equal {
        Some(positions) => Ok(isg(body, table.swings, positions, mark).into_bytes()),
        None => Err(no_equal_parts(table)),
    };
    vec![
        file(CSV, "-servo.csv", csv(&scaled, units, &head)),
        file(XYVA, "-xyva.st", xyva(body, &scaled, &head)),
        file(TWINCAT, "-twincat.st", twincat(body, &scaled, &head)),
        WrittenFile { format: ISG, ending: "-isg.txt".to_owned(), bytes: equal_parts },
    ]
}

/// Why a table has no form with straight lines between equal parts of the turn.
fn no_equal_parts(table: &ServoTable) -> Refusal {
    if table.advance != 0.0 {
        let refusal = Refusal::new("the table closes the turn, and the slave goes on in each turn of the master");
        return refusal.remedy("give a table with polynomials, servo-csv, servo-xyva or servo-twincat");
    }
    let refusal = Refusal::new("straight lines between equal parts of a turn would be more than 100000");
    refusal.remedy("give a coarser --tolerance, or a table with polynomials, servo-xyva or servo-twincat")
}

/// A table of one column, whatever the unit of other files in ten thousandths of a millimetre or a degree: the position at the beginning of each of so many equal parts of the
/// turn, with straight lines between them (<https://infosys.beckhoff.com/content/1033/tccncmcplatform_fb/15306147467.html>).
fn isg(body: &dyn Body, swings: bool, positions: &[f64], mark: &str) -> String {
    let rows: String =
        positions.iter().map(|position| plain(TEN_THOUSANDTHS * position, ISG_DECIMALS) + "\n").collect();
    let [master, kind, function, slave] = isg_statements(swings);
    format!(
        "Tablename = {} # {mark}\nTable-ID = 1 # {master}\nTabletype = 3 # {kind}\nFunctiontype = 1 # {function}\nLines = {} # {slave}\nBegintable\n\
         {rows}EndTable\n",
        variable(body),
        positions.len()
    )
}

/// What a table of the controls of ISG says of itself, behind its settings.
pub(super) fn isg_statements(swings: bool) -> [String; 4] {
    let unit = if swings { "deg" } else { "mm" };
    [
        "master: one turn of the cam in equal parts, the first line at 0 deg".to_owned(),
        "TABLE_ONE_COLUMN_REAL64".to_owned(),
        "LINEAR".to_owned(),
        format!("slave: {unit}, in 0.0001 {unit}"),
    ]
}

/// What a table with so many nodes says of itself, line by line.
pub(super) fn statements(body: &dyn Body, nodes: usize, units: LengthUnit) -> Vec<String> {
    let plain: String = body.machine().name().chars().filter(|c| c.is_ascii() && !"(*)".contains(*c)).collect();
    let swings = body.follower_motion().is_some_and(|motion| motion.quantity() == Quantity::Angle);
    let advance = body.follower_motion().map_or(0.0, advance);
    let advance = if swings { advance.to_degrees() } else { units.of_mm(MILLIMETRES * advance) };
    let unit = if swings { "deg" } else { units.symbol() };
    let upside_down = "counter disc of a pair: the motion is upside down; a drive in the place of the cam takes the table of the main disc";
    let of_counter = is_of_another_disc(body).then(|| upside_down.to_owned());
    let lines = vec![
        format!("machine: {plain}"),
        "master: deg of the cam, one turn".to_owned(),
        format!("slave: {unit}; velocity and acceleration by the master, {unit}/deg and {unit}/deg2"),
        "interpolation: between two nodes the polynomial of degree 5 with position, velocity and acceleration of both"
            .to_owned(),
        format!("nodes: {nodes}"),
    ];
    let goes_on = (advance != 0.0).then(|| {
        format!(
            "the slave goes on by {} {unit} in each turn of the master: run the table relative to its end",
            shortest(advance)
        )
    });
    lines.into_iter().chain(of_counter).chain(goes_on).collect()
}

fn csv(table: &ServoTable, units: LengthUnit, head: &[String]) -> String {
    let head: Vec<String> = head.iter().map(|line| format!("# {line}\n")).collect();
    let mut text = head.concat();
    let unit = if table.swings { "deg" } else { units.symbol() };
    text.push_str(&format!("master_deg,slave_{unit},velocity_{unit}_per_deg,acceleration_{unit}_per_deg2\n"));
    for node in &table.nodes {
        text.push_str(&format!("{}\n", node.map(shortest).join(",")));
    }
    text
}

fn is_of_another_disc(body: &dyn Body) -> bool {
    body.load().is_some_and(LoadAsCut::is_of_another_disc)
}

/// The machine's name as a variable.
fn variable(body: &dyn Body) -> String {
    let kept = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    let name: String = body.machine().name().chars().map(kept).take(24).collect();
    let which = if is_of_another_disc(body) { "_counter" } else { "" };
    format!("Cam_{}{which}", name.trim_matches('_'))
}

fn comment(head: &[String]) -> String {
    let mark = |line: &String| format!("   {}\n", line.replace("(*", "(").replace("*)", ")"));
    format!("(*\n{}*)\n", head.iter().map(mark).collect::<String>())
}

/// A number of structured text: with a point and without a plus sign in the exponent.
fn real(value: f64) -> String {
    let text = shortest(value);
    match text.split_once('e') {
        Some((digits, exponent)) if !digits.contains('.') => format!("{digits}.0E{exponent}"),
        Some((digits, exponent)) => format!("{digits}E{exponent}"),
        None if text.contains('.') => text,
        None => text + ".0",
    }
}

fn xyva(body: &dyn Body, table: &ServoTable, head: &[String]) -> String {
    let (name, count) = (variable(body), table.nodes.len());
    let point = |node: &[f64; 4]| {
        let [x, y, v, a] = node.map(real);
        format!("        (dX := {x}, dY := {y}, dV := {v}, dA := {a})")
    };
    let points: Vec<String> = table.nodes.iter().map(point).collect();
    format!(
        "{}VAR_GLOBAL\n    {name}_Nodes : ARRAY[0..{}] OF SMC_CAMXYVA := [\n{}\n    ];\n    {name} : MC_CAM_REF := (byType := SMC_CAM_TYPE.XYVA, \
         xStart := 0.0, xEnd := 360.0, nElements := {count}, strCAMName := '{name}');\nEND_VAR\n(* Once before MC_CamTableSelect: \
         {name}.pce := ADR({name}_Nodes); *)\n",
        comment(head),
        count.saturating_sub(1),
        points.join(",\n")
    )
}

fn twincat(body: &dyn Body, table: &ServoTable, head: &[String]) -> String {
    let (name, count) = (variable(body), table.nodes.len());
    let point = |(index, node): (usize, &[f64; 4])| {
        let [x, y, v, a] = node.map(real);
        // The last point ends the last polynomial.
        let next = usize::from(index + 1 < count);
        format!(
            "        (PointIndex := {}, FunctionType := MOTIONFUNCTYPE_POLYNOM5_MM, PointType := MOTIONPOINTTYPE_MOTION, RelIndexNextPoint := {next}, \
             MasterPos := {x}, SlavePos := {y}, SlaveVelo := {v}, SlaveAcc := {a}, SlaveJerk := 0.0)",
            index + 1
        )
    };
    let points: Vec<String> = table.nodes.iter().enumerate().map(point).collect();
    format!(
        "{}VAR_GLOBAL\n    {name} : ARRAY[1..{count}] OF MC_MotionFunctionPoint := [\n{}\n    ];\nEND_VAR\n",
        comment(head),
        points.join(",\n")
    )
}
