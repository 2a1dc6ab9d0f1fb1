//! What applies to a whole program, however its motion is given.

use super::keys::{MEASURED_AT, MeasuredAt, OUTPUT_ARM, START};
use crate::document::{Field, LengthOrAngle, TableReader};
use crate::motion::Quantity;
use crate::units::{self, Dimension};
use std::f64::consts::PI;

/// Stands for the value of a key whose fault has been reported already.
pub(super) struct FaultReported;

/// Largest difference between the sum of the segments and a whole turn, rad, or the stroke of a plate, m: rounding of typed angles and lengths.
/// Every segment is longer.
pub(super) const WHOLE_TURN: f64 = 1e-9 * PI / 180.0;

/// How the follower of a file moves, which its motion must fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FollowerMovement {
    /// The path of its table.
    pub table: &'static str,
    /// What its position is measured in.
    pub quantity: Quantity,
    /// The arm of its roller, m.
    pub arm: Option<f64>,
}

/// Over what a program goes, as the body of its cam has it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ProgramSpan {
    /// A turn, in equal lobes.
    Turn,
    /// A turn or one half of it: the other half is the first one upside down, as between the two faces of a yoke.
    HalfTurn,
    /// The travel of a plate, once out and back.
    Stroke,
    /// A turn, after which the follower is farther by this, rad, and goes on in the same way.
    Index(f64),
}

/// What applies to the whole program.
#[derive(Clone, Copy)]
pub(super) struct ProgramContext {
    pub(super) quantity: Quantity,
    /// The radius of the arc along which lengths of a swinging follower are measured, m.
    pub(super) arc: Option<f64>,
    /// The arm of the roller, m, for messages.
    pub(super) arm: Option<f64>,
    /// Angular speed of the cam, rad/s.
    pub(super) speed: Option<f64>,
    /// Whether `motion.rpm` has a fault that is already reported.
    pub(super) has_faulty_speed: bool,
    /// First cam angle, and the angle the segments fill, rad; 0 and the stroke of a plate, m.
    pub(super) at: f64,
    pub(super) fill: f64,
    /// It goes over the stroke of a plate: what is an angle of a turn is a length of it.
    pub(super) by_travel: bool,
}

impl ProgramContext {
    /// A position as typed.
    pub(super) fn value_of(&self, position: LengthOrAngle) -> (Quantity, f64) {
        value_of(position, self.arc)
    }

    /// In which quantity bare numbers of positions are typed, and by what they are divided: the arc (m) along which lengths of a
    /// swinging follower are measured.
    pub(super) fn typed(&self, table: &TableReader<'_>) -> (Quantity, f64) {
        match self.arc {
            Some(arc) if units::parse(&table.typed(&START), Dimension::Length).is_ok() => (Quantity::Length, arc),
            _ => (self.quantity, 1.0),
        }
    }

    /// An angle of the program, or a length of that of a plate, as typed in a key; `None` where the key is absent.
    pub(super) fn place(
        &self,
        table: &TableReader<'_>,
        key: &Field<LengthOrAngle>,
    ) -> Result<Option<f64>, FaultReported> {
        if !table.has(key) {
            return Ok(None);
        }
        let typed = table.get(key).ok_or(FaultReported)?;
        self.along(typed).map(Some).map_err(|found| {
            let (message, help) = self.wrong_place(key.key.name, found);
            table.fail(key, message, Some(help));
            FaultReported
        })
    }

    /// The number of a place; what it is instead where it is of the other kind.
    pub(super) fn along(&self, place: LengthOrAngle) -> Result<f64, Quantity> {
        match place {
            LengthOrAngle::Angle(angle) if !self.by_travel => Ok(angle),
            LengthOrAngle::Length(length) if self.by_travel => Ok(length),
            LengthOrAngle::Angle(_) => Err(Quantity::Angle),
            LengthOrAngle::Length(_) => Err(Quantity::Length),
        }
    }

    /// What is wrong with a place of the other kind, under this name, and what would be right.
    pub(super) fn wrong_place(&self, name: &str, found: Quantity) -> (String, String) {
        let found = found.words();
        if self.by_travel {
            let message =
                format!("`{name}` is {found}, but a plate travels: its program goes over the length motion.stroke");
            return (message, "give a length, such as \"40 mm\"".into());
        }
        let message = format!("`{name}` is {found}, but the cam turns");
        (message, "give an angle, such as \"90 deg\"; lengths are those of a plate, cam.body = \"wedge\"".into())
    }

    /// A place for a message.
    pub(super) fn shown(&self, place: f64) -> String {
        if self.by_travel { format!("{:.6} mm", 1e3 * place) } else { format!("{:.6} deg", place.to_degrees()) }
    }

    /// What the segments fill, for a message.
    pub(super) fn whole(&self) -> &'static str {
        if self.by_travel { "stroke" } else { "turn" }
    }

    /// What to write in the place of a position of the wrong kind.
    pub(super) fn remedy(&self, position: f64) -> String {
        match self.arm {
            Some(arm) if self.quantity == Quantity::Angle => conversion(position, arm) + WITH_LENGTHS,
            _ => "give both as lengths, or both as angles".to_owned(),
        }
    }
}

/// What keeps lengths for a swinging follower.
const WITH_LENGTHS: &str = "; or keep lengths and add measured_at = \"roller\", or output_arm, to [motion]";

/// A position as typed; a length along an arc of this radius (m) as the angle that it is.
pub(super) fn value_of(position: LengthOrAngle, arc: Option<f64>) -> (Quantity, f64) {
    match (position, arc) {
        (LengthOrAngle::Length(value), Some(arc)) => (Quantity::Angle, value / arc),
        (LengthOrAngle::Length(value), None) => (Quantity::Length, value),
        (LengthOrAngle::Angle(value), _) => (Quantity::Angle, value),
    }
}

/// A length (m) along the arc of a roller at the end of an arm (m), as an angle.
fn conversion(length: f64, arm: f64) -> String {
    let angle = (length / arm).to_degrees();
    let (length, arm) = (1e3 * length, 1e3 * arm);
    let [length, arm, angle] =
        [(length, 1e6), (arm, 1e6), (angle, 1e4)].map(|(value, digits)| (value * digits).round() / digits);
    format!("{length} mm along the arc of the roller (arm {arm} mm) is \"{angle} deg\"")
}

/// The radius of the arc along which positions are measured, m; a fault where keys or follower do not fit. Without a follower only its own
/// fault is reported.
pub(super) fn arc(table: &TableReader<'_>, follower: Option<FollowerMovement>) -> Option<f64> {
    let follower = follower?;
    let word = table.has(&MEASURED_AT).then(|| table.get(&MEASURED_AT)).flatten();
    let path = follower.table;
    if follower.quantity == Quantity::Length {
        for (given, name) in [(table.has(&MEASURED_AT), "measured_at"), (table.has(&OUTPUT_ARM), "output_arm")] {
            if given {
                let message = format!("`{name}` is for a swinging follower, but [{path}] moves along a straight path");
                let help = Some("remove it: positions are lengths along that path".to_owned());
                if name == "measured_at" {
                    table.fail(&MEASURED_AT, message, help);
                } else {
                    table.fail(&OUTPUT_ARM, message, help);
                }
            }
        }
        return None;
    }
    match word {
        Some(MeasuredAt::Pivot) => None,
        Some(MeasuredAt::Roller) => {
            if follower.arm.is_none() {
                let message = format!("[{path}] has no roller along whose arc positions could be measured");
                table.fail(&MEASURED_AT, message, Some("give output_arm in its place, or angles".into()));
            }
            follower.arm
        }
        Some(MeasuredAt::Output) if !table.has(&OUTPUT_ARM) => {
            let help = Some("add output_arm = \"150 mm\", the arm at whose end they are measured".into());
            table.fail(&MEASURED_AT, "positions at the output need its arm".into(), help);
            None
        }
        Some(MeasuredAt::Output) | None => table.get(&OUTPUT_ARM),
    }
}

/// Reports positions that are not of the kind that the follower moves by; `lengths` are those of the file, m.
pub(super) fn report_mismatch(
    table: &TableReader<'_>,
    quantity: Quantity,
    follower: FollowerMovement,
    lengths: &[f64],
) {
    let path = follower.table;
    if quantity == Quantity::Angle {
        let message = format!("motion.start is an angle, but [{path}] moves along a straight path");
        table.fail(&START, message, Some("give lengths, start = \"0 mm\"; or a swinging follower".into()));
        return;
    }
    let message = format!("motion.start is a length, but [{path}] swings: its positions are angles");
    let mut told: Vec<f64> = Vec::new();
    for length in lengths.iter().copied().filter(|length| *length != 0.0) {
        if !told.contains(&length) && told.len() < MOST_CONVERTED {
            told.push(length);
        }
    }
    let help = match follower.arm {
        Some(arm) if !told.is_empty() => {
            let all: Vec<String> = told.iter().map(|length| conversion(*length, arm)).collect();
            format!("give angles: {}{WITH_LENGTHS}", all.join(", "))
        }
        Some(_) => format!("give angles{WITH_LENGTHS}"),
        None => {
            "give angles; or keep lengths and add output_arm to [motion], the arm at whose end they are measured".into()
        }
    };
    table.fail(&START, message, Some(help));
}

/// Most positions that a message converts.
const MOST_CONVERTED: usize = 4;
