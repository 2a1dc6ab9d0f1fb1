//! The keys of a machine file for the cams of a press.

use super::compensator::{self, CompensatorData};
use super::conoid::{self, ConoidData};
use super::losses::{self, PLAY, TRAIN_STIFFNESS};
use super::scatter;
use super::settings::{self, RegimesData, SpringBodyData};
use super::transition;
use super::translating::{self, TranslatingData};
use super::{bed, buffer};
use crate::press::cams::{CONOID, OF_A_COLUMN_LIMIT, OF_A_PRESS, REGIMES, ROTARY};
use crate::press::motion::Transition;
use crate::press::scatter::error::ScatterError;
use crate::press::scatter::losses::Losses;
use crate::press::scatter::monte_carlo::{CUSTOMARY, Sampling};
use camgen_cams::machine::Machine;
use camgen_kernel::document::Presence::{Default, Optional};
use camgen_kernel::document::range::{LARGEST_FORCE, LARGEST_NUMBER, LONGEST};
use camgen_kernel::document::{Field, KeySection, Occurrence, Reader, TableReader, above, within};
use camgen_kernel::units::Dimension::{Force, Length};

/// The cams of a press.
#[derive(Debug, Clone, PartialEq)]
pub struct PressCams {
    /// Equal lobes, which is also the crank's turns for one turn of the cam: so it is in position at every reversal.
    pub lobes: u32,
    /// Roller travel per bottom travel.
    pub lever: f64,
    /// Transition between dwell and reversal.
    pub transition: Transition,
    /// The wedge on the bed, when described.
    pub translating: Option<TranslatingData>,
    /// The conoid, when described.
    pub conoid: Option<ConoidData>,
    /// The compensating cam, when described.
    pub compensator: Option<CompensatorData>,
    /// Speeds for which the preload of the compensating cam is reported, rpm; none where the report chooses them.
    pub compensator_speeds: Vec<f64>,
    /// Other speeds.
    pub regimes: RegimesData,
    /// Stiffness of springs under the bottoms, N/m.
    pub spring_stiffness: Option<f64>,
    /// Brinell hardness of the surface of the cam.
    pub hardness: Option<f64>,
    /// Least turns before it pits.
    pub life: Option<f64>,
    /// Dynamic load rating C of the roller, N.
    pub load_rating: Option<f64>,
    /// The springs themselves, when described.
    pub spring_body: Option<SpringBodyData>,
    /// What the press loses in a reversal.
    pub losses: Losses,
    /// How far presses differ from the one a cam is cut for.
    pub scatter: Sampling,
    /// Largest residual force over the largest inertia force; where it is absent it must stay below a fixed bottom's.
    pub residual_share: Option<f64>,
    /// Longest air column, m; where it is absent the customary one holds.
    pub largest_column: Option<f64>,
}

/// The cams of a machine that was made without reading a press.
static WITHOUT_PRESS: PressCams = PressCams {
    lobes: 1,
    lever: 1.0,
    transition: Transition::None,
    translating: None,
    conoid: None,
    compensator: None,
    compensator_speeds: Vec::new(),
    regimes: RegimesData { speeds: Vec::new(), reset: None },
    spring_stiffness: None,
    hardness: None,
    life: None,
    load_rating: None,
    spring_body: None,
    losses: Losses::NONE,
    scatter: CUSTOMARY,
    residual_share: None,
    largest_column: None,
};

impl PressCams {
    /// The cams of a machine; every machine that was read has them, with defaults.
    #[must_use]
    pub fn of(machine: &Machine) -> &Self {
        machine.part().unwrap_or(&WITHOUT_PRESS)
    }
}

const TURNS: Field<f64> = Field::number(
    "cam_turns_per_crank_turn",
    "turns of the cam per turn of the crank: 1, or 1/n for n lobes",
    Default("1"),
    above(0.0, LARGEST_NUMBER),
)
.only(&[ROTARY, CONOID, REGIMES]);
const LEVER: Field<f64> = Field::number(
    "lever",
    "roller travel per travel of the cylinder's bottom",
    Default("1"),
    above(0.0, LARGEST_NUMBER),
)
.only(&[ROTARY, CONOID]);
const RESIDUAL_SHARE: Field<f64> = Field::number(
    "residual_share",
    "for the check `residual`: largest residual force over the largest inertia; when absent, less than a fixed bottom leaves",
    Optional("0.01"),
    above(0.0, LARGEST_NUMBER),
)
.only(OF_A_PRESS);

const HARDNESS: Field<f64> = Field::number(
    "hardness",
    "Brinell hardness of the surface of the cam: for the check contact_life",
    Optional("600"),
    within(100.0, 1000.0),
)
.only(&[ROTARY, CONOID]);
const LIFE: Field<f64> = Field::number(
    "life",
    "least turns of the cam before its surface pits, 1e4 to 1e10; for the check contact_life",
    Optional("1e9"),
    within(1e4, 1e10),
)
.only(&[ROTARY, CONOID]);

const COLUMN: Field<f64> = Field::quantity(
    "column",
    "longest air column; 2 m when absent, the room behind the bed of a flat-bed press",
    Optional("1 m"),
    Length,
    above(0.0, LONGEST),
)
.only(OF_A_COLUMN_LIMIT);

/// The keys that are added to `[cam]`.
pub(super) const CAM: KeySection = KeySection {
    path: "cam",
    about: "",
    occurs: Occurrence::Once,
    cams: &[],
    keys: &[TURNS.key, LEVER.key, TRAIN_STIFFNESS.key, losses::COMPENSATE_TRAIN.key, PLAY.key, HARDNESS.key],
};

const LOAD_RATING: Field<f64> = Field::quantity(
    "load_rating",
    "dynamic load rating C of the roller, of its catalogue: for its life (ISO 281)",
    Optional("100 kN"),
    Force,
    above(0.0, LARGEST_FORCE),
)
.only(&[ROTARY]);

/// The key that is added to `[follower.roller]`.
pub(super) const ROLLER: KeySection = KeySection {
    path: "follower.roller",
    about: "",
    occurs: Occurrence::Optional,
    cams: &[],
    keys: &[LOAD_RATING.key],
};

/// The keys that are added to `[limits]`.
pub(super) const LIMITS: KeySection = KeySection {
    path: "limits",
    about: "",
    occurs: Occurrence::Once,
    cams: &[],
    keys: &[RESIDUAL_SHARE.key, COLUMN.key, LIFE.key],
};

/// The cams, whose wedge has a roller of this radius (m) unless its table gives one.
pub(super) fn read(reader: &Reader<'_>, roller_radius: Option<f64>) -> Option<PressCams> {
    let table = reader.table(&CAM);
    let (regimes, spring_stiffness) = settings::read(reader);
    let (lobes, scatter) = (read_lobes(&table), scatter::read(reader));
    let (translating, conoid) = (translating::read(reader, roller_radius), conoid::read(reader));
    Some(PressCams {
        lobes: lobes?,
        lever: table.get(&LEVER)?,
        transition: transition::read(reader)?,
        translating,
        conoid,
        compensator: compensator::read(reader),
        compensator_speeds: compensator::speeds(reader),
        regimes,
        spring_stiffness,
        hardness: table.get(&HARDNESS),
        life: reader.table(&LIMITS).get(&LIFE),
        load_rating: reader.find(&ROLLER).and_then(|table| table.get(&LOAD_RATING)),
        spring_body: settings::read_body(reader),
        losses: read_losses(reader),
        scatter: scatter?,
        residual_share: reader.table(&LIMITS).get(&RESIDUAL_SHARE),
        largest_column: reader.table(&LIMITS).get(&COLUMN),
    })
}

/// Stiffness of the train for which the cam is compensated.
pub(super) fn compensated_train(reader: &Reader<'_>) -> Option<f64> {
    let table = reader.table(&CAM);
    let (wanted, stiffness) = (table.get(&losses::COMPENSATE_TRAIN)?, table.get(&TRAIN_STIFFNESS));
    if wanted && stiffness.is_none() {
        let help = "add cam.train_stiffness, e.g. \"100 kN/mm\"".to_owned();
        table.fail(
            &losses::COMPENSATE_TRAIN,
            "a cam cannot be cut for a train of unknown stiffness".into(),
            Some(help),
        );
    }
    stiffness.filter(|_| wanted)
}

/// What is given of losses; what is not is no loss.
fn read_losses(reader: &Reader<'_>) -> Losses {
    let (buffer, bed, cam) = (reader.table(&buffer::SECTION), reader.table(&bed::SECTION), reader.table(&CAM));
    let (compression, expansion) = (buffer.get(&buffer::POLYTROPIC_EXPONENT), buffer.get(&losses::EXPANSION_EXPONENT));
    if let Some((expansion, compression)) = expansion.zip(compression).filter(|(back, inward)| back < inward) {
        let why = ScatterError::ExpansionBelowCompression { expansion, compression };
        let help = format!("give {compression} or more");
        buffer.fail(&losses::EXPANSION_EXPONENT, why.to_string(), Some(help));
    }
    Losses {
        expansion_exponent: expansion,
        leak: buffer.get(&losses::LEAK).unwrap_or(0.0),
        piston_friction: buffer.get(&losses::PISTON_FRICTION).unwrap_or(0.0),
        bed_friction: bed.get(&losses::BED_FRICTION).unwrap_or(0.0),
        train_stiffness: cam.get(&TRAIN_STIFFNESS),
        is_compensated: cam.get(&losses::COMPENSATE_TRAIN).unwrap_or(false),
        play: cam.get(&PLAY).unwrap_or(0.0),
    }
}

/// Most lobes: more would be teeth.
const MOST_LOBES: f64 = 100.0;
/// How far a ratio may be from 1/n to be taken for it, as a share: 0.3333 means a third, since gears are exact. Slightly
/// more, for the rounding of that number.
const RATIO_ROUNDING: f64 = 1e-4 * (1.0 + 1e-9);

/// The lobes of a cam of 1/n turns for one of the crank.
fn read_lobes(table: &TableReader<'_>) -> Option<u32> {
    let turns = table.get(&TURNS)?;
    let lobes = (1.0 / turns).round().clamp(1.0, MOST_LOBES);
    if (turns * lobes - 1.0).abs() > RATIO_ROUNDING {
        let typed = table.typed(&TURNS);
        let message = format!(
            "with {typed} turns of the cam for one turn of the crank the cam would be in the wrong position at the next reversal; \
             1, or 1/n with n equal lobes (0.5, 0.3333, 0.25, … 0.01), is in the right position at each"
        );
        let nearest = (1e6 / lobes).round() / 1e6;
        table.fail(&TURNS, message, Some(format!("the nearest of these is {nearest}")));
        return None;
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number from 1 to 100")]
    Some(lobes as u32)
}
