//! The keys for forces, vibration and drive of a motion program: spring, guide, elastic train, speed fluctuation.

use super::bearing::{self, BearingData};
use camgen_kernel::document::Presence::{Default, Optional, Required};
use camgen_kernel::document::cams::MAKE;
use camgen_kernel::document::range::{LARGEST_FORCE, LONGEST, STIFFEST};
use camgen_kernel::document::{Field, Input, KeySection, Occurrence, Reader, TableReader, above, within};
use camgen_kernel::follower::FollowerData;
use camgen_kernel::motion::Quantity;
use camgen_kernel::units::Dimension::{
    self, Damping, Force, Frequency, Length, Moment, Stiffness, TorsionalDamping, TorsionalStiffness,
};

/// `[spring]`: N and m of a follower on a straight path, N·m and rad about the pivot of one that swings.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SpringData {
    /// Rate.
    pub rate: f64,
    /// Force at lift 0, in addition to the preload of the follower's own table.
    pub preload: f64,
    /// Damping: force per velocity.
    pub damping: f64,
    /// A constant load; positive where it presses the follower on.
    pub load: f64,
}

/// `[guide]`: the guide of a follower on a straight path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GuideData {
    /// Coefficient of friction.
    pub friction: f64,
    /// Distance between its two bearings, m.
    pub span: f64,
    /// Distance from the nearer bearing to the roller, the edge or the face, m.
    pub overhang: f64,
}

/// `[vibration]`: one mass on one spring, moved by the follower.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VibrationData {
    /// Natural frequency, Hz.
    pub natural_frequency: f64,
    /// Damping ratio.
    pub damping: f64,
}

/// The part against which the damping of a load on an elastic train acts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DampingAgainst {
    /// The frame: the force is proportional to the velocity of the load.
    #[default]
    Frame,
    /// The follower, as damping in the train: the force is proportional to the rate of deformation of the train.
    Follower,
}

/// What moves with the follower of a motion program.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Dynamics {
    /// The spring on it.
    pub spring: Option<SpringData>,
    /// Its guide.
    pub guide: Option<GuideData>,
    /// The elastic train behind it.
    pub vibration: Option<VibrationData>,
    /// The part against which its damping acts.
    pub damping_against: DampingAgainst,
    /// Coefficient of speed fluctuation that a flywheel on the shaft is to keep.
    pub fluctuation: Option<f64>,
    /// The bearing of its roller.
    pub bearing: Option<BearingData>,
}

impl Dynamics {
    /// Of a file whose lift is of a quantity: of a turret an angle, whatever its roller would do without it.
    pub(super) fn read(reader: &Reader<'_>, follower: &FollowerData, quantity: Quantity) -> Self {
        Self {
            spring: spring(reader, follower, quantity),
            guide: guide(reader, follower, quantity),
            vibration: vibration(reader),
            damping_against: damping_against(reader),
            fluctuation: fluctuation(reader),
            bearing: bearing::read(reader, follower),
        }
    }
}

/// The dimension of a quantity and its range, for one kind of follower: along a straight path or about a pivot.
type DimensionRange = (Dimension, camgen_kernel::document::Bounds);

const DAMPING_RANGE: camgen_kernel::document::Bounds = within(0.0, STIFFEST);
const FORCES: [DimensionRange; 2] = [(Force, within(0.0, LARGEST_FORCE)), (Moment, within(0.0, LARGEST_FORCE))];
const LOADS: [DimensionRange; 2] =
    [(Force, within(-LARGEST_FORCE, LARGEST_FORCE)), (Moment, within(-LARGEST_FORCE, LARGEST_FORCE))];

const RATE: Field<(Dimension, f64)> = Field::either(
    "rate",
    "rate: force per lift; for a swinging follower moment per angle, N*m/rad",
    Optional("8 N/mm"),
    (Stiffness, within(0.0, STIFFEST)),
    (TorsionalStiffness, within(0.0, STIFFEST)),
)
.also(&["stiffness", "constant"]);
const PRELOAD: Field<(Dimension, f64)> = Field::either(
    "preload",
    "its force, or moment, at the lowest position, in addition to the preload in the follower's table",
    Optional("120 N"),
    FORCES[0],
    FORCES[1],
);
const DAMPING: Field<(Dimension, f64)> = Field::either(
    "damping",
    "damping against the frame: force per velocity, or moment per angular velocity",
    Optional("20 N*s/m"),
    (Damping, DAMPING_RANGE),
    (TorsionalDamping, DAMPING_RANGE),
);
const LOAD: Field<(Dimension, f64)> = Field::either(
    "load",
    "constant load on the follower, a force or a moment; positive presses it onto the cam",
    Optional("50 N"),
    LOADS[0],
    LOADS[1],
);

/// `[spring]`.
pub(super) const SPRING: KeySection = KeySection {
    path: "spring",
    about: "the spring and the load on the follower of a motion program",
    occurs: Occurrence::Optional,
    cams: &[MAKE],
    keys: &[RATE.key, PRELOAD.key, DAMPING.key, LOAD.key],
};

const FRICTION: Field<f64> =
    Field::number("friction", "coefficient of friction in the guide", Required("0.1"), within(0.0, 2.0));
const SPAN: Field<f64> = Field::quantity(
    "span",
    "distance between the two bearings of the guide",
    Required("60 mm"),
    Length,
    above(0.0, LONGEST),
);
const OVERHANG: Field<f64> = Field::quantity(
    "overhang",
    "distance from the nearer bearing to the roller, the edge or the face, where it is largest",
    Default("0 mm"),
    Length,
    within(0.0, LONGEST),
);

/// `[guide]`.
pub(super) const GUIDE: KeySection = KeySection {
    path: "guide",
    about: "the guide of a follower on a straight path: its friction, and whether it jams",
    occurs: Occurrence::Optional,
    cams: &[MAKE],
    keys: &[FRICTION.key, SPAN.key, OVERHANG.key],
};

const FLUCTUATION: Field<f64> = Field::number(
    "fluctuation",
    "largest minus smallest speed of the camshaft over the mean; the report gives the moment of inertia that keeps it",
    Required("0.02"),
    above(0.0, 1.0),
);

/// `[flywheel]`.
pub(super) const FLYWHEEL: KeySection = KeySection {
    path: "flywheel",
    about: "a flywheel on the camshaft",
    occurs: Occurrence::Optional,
    cams: &[MAKE],
    keys: &[FLUCTUATION.key],
};

/// Highest natural frequency, Hz: beyond, nothing of a machine vibrates.
const HIGHEST_FREQUENCY: f64 = 1e6;

const NATURAL_FREQUENCY: Field<f64> = Field::quantity(
    "natural_frequency",
    "natural frequency of the load on its elastic train, with the cam held",
    Required("40 Hz"),
    Frequency,
    above(0.0, HIGHEST_FREQUENCY),
);
const RATIO: Field<f64> = Field::number(
    "damping",
    "damping ratio of the load, below 1 (see damping_against)",
    Default("0"),
    within(0.0, 1.0 - 1e-9),
);
const AGAINST: Field<DampingAgainst> = Field::words(
    "damping_against",
    "\"frame\": damping force 2 ζ ω m x' on the load; \"follower\": damping force 2 ζ ω m (x' - y') within the train",
    Default("frame"),
    &["frame", "follower"],
    &[DampingAgainst::Frame, DampingAgainst::Follower],
)
.also(&["against"]);

/// `[vibration]`.
pub(super) const VIBRATION: KeySection = KeySection {
    path: "vibration",
    about: "an elastic train from the follower to its load, as one mass on one spring",
    occurs: Occurrence::Optional,
    cams: &[MAKE],
    keys: &[NATURAL_FREQUENCY.key, RATIO.key, AGAINST.key],
};

/// A key of `[spring]` in the kind of the follower, or a fault that names both.
fn of_kind(
    table: &TableReader<'_>,
    field: &Field<(Dimension, f64)>,
    (follower, quantity): (&FollowerData, Quantity),
) -> Option<f64> {
    let swings = quantity == Quantity::Angle;
    let Some((dimension, value)) = table.get(field) else { return (!table.has(field)).then_some(0.0) };
    let about_pivot = matches!(dimension, Moment | TorsionalStiffness | TorsionalDamping);
    if about_pivot == swings {
        return Some(value);
    }
    let camgen_kernel::document::KeyForm::Either((straight, _), (swinging, _)) = field.key.form else { return None };
    let (moves, wanted) = if swings { ("swings", swinging) } else { ("moves on a straight path", straight) };
    let moved = if follower.shape.quantity() == quantity {
        format!("the follower of [{}] {moves}", follower.path)
    } else {
        "the turret turns".to_owned()
    };
    let message = format!("{}.{} is a {dimension}, but {moved}: it takes a {wanted}", SPRING.path, field.key.name);
    table.fail(field, message, Some(format!("give it in {}", wanted.unit_list())));
    None
}

/// The spring of a file, for its follower.
fn spring(reader: &Reader<'_>, follower: &FollowerData, quantity: Quantity) -> Option<SpringData> {
    let table = reader.find(&SPRING)?;
    let [rate, preload, damping, load] =
        [&RATE, &PRELOAD, &DAMPING, &LOAD].map(|field| of_kind(&table, field, (follower, quantity)));
    // A turret goes on turning, and a spring on it would be wound up without end.
    if quantity != follower.shape.quantity() && rate.is_some_and(|rate| rate > 0.0) {
        let message = "spring.rate is that of a spring that pulls back, but the turret goes on turning".to_owned();
        table.fail(&RATE, message, Some("leave it out; spring.load is a constant moment".into()));
        return None;
    }
    Some(SpringData { rate: rate?, preload: preload?, damping: damping?, load: load? })
}

/// The guide of a file, for its follower.
fn guide(reader: &Reader<'_>, follower: &FollowerData, quantity: Quantity) -> Option<GuideData> {
    let table = reader.find(&GUIDE)?;
    if quantity == Quantity::Angle {
        let message = format!("a guide belongs to a straight path, but the follower of [{}] swings", follower.path);
        table.fail(&FRICTION, message, Some("leave out [guide]".into()));
        return None;
    }
    Some(GuideData { friction: table.get(&FRICTION)?, span: table.get(&SPAN)?, overhang: table.get(&OVERHANG)? })
}

/// The coefficient of speed fluctuation that a flywheel is to keep.
fn fluctuation(reader: &Reader<'_>) -> Option<f64> {
    reader.find(&FLYWHEEL)?.get(&FLUCTUATION)
}

/// Refuses what acts by the speed of a cam, or by the side force on a guide: the forces on a plate are those at rest.
pub(super) fn refuse_for_plate(reader: &Reader<'_>) {
    let help =
        |section: &KeySection| Some(format!("leave [{}] out: the forces on a plate are those at rest", section.path));
    let turns = |what: &str| format!("{what} acts by the speed of the cam, and that of a plate is not known");
    if let Some(table) = reader.find(&SPRING).filter(|table| table.has(&DAMPING)) {
        let help = "remove it: the forces on a plate are those at rest";
        table.fail(&DAMPING, turns("damping"), Some(help.into()));
    }
    if let Some(table) = reader.find(&GUIDE) {
        let message = "the friction in the guide of a follower is not computed on a plate".to_owned();
        table.fail(&FRICTION, message, help(&GUIDE));
    }
    if let Some(table) = reader.find(&VIBRATION) {
        table.fail(&NATURAL_FREQUENCY, turns("vibration"), help(&VIBRATION));
    }
    if let Some(table) = reader.find(&FLYWHEEL) {
        table.fail(&FLUCTUATION, "a plate has no shaft for a flywheel".into(), help(&FLYWHEEL));
    }
}

/// The elastic train of a file.
fn vibration(reader: &Reader<'_>) -> Option<VibrationData> {
    let table = reader.find(&VIBRATION)?;
    Some(VibrationData { natural_frequency: table.get(&NATURAL_FREQUENCY)?, damping: table.get(&RATIO)? })
}

/// The part against which the damping of its load acts.
fn damping_against(reader: &Reader<'_>) -> DampingAgainst {
    reader.find(&VIBRATION).and_then(|table| table.get(&AGAINST)).unwrap_or_default()
}

/// The inputs of a file without a default `damping_against`, so that hashes from before this key stay valid.
pub(super) fn without_frame(inputs: Vec<Input>) -> Vec<Input> {
    let against = VIBRATION.path_of(&AGAINST.key);
    inputs.into_iter().filter(|input| input.key != against || input.value != "frame").collect()
}
