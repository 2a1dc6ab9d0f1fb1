//! What the names of files begin with where nobody names them: the machine, the command and the speeds.

use super::{Cam, Judged};
use crate::report::Speeds;
use crate::write::number::names;

/// More speeds of a cam than this are named by the first and the last.
const MOST_NAMED: usize = 6;

/// The longest stem that names every speed of an analysis, bytes: what is added to it still fits a file system.
const LONGEST: usize = 200;

impl Cam {
    /// The usual start of the names of its files, MACHINE-COMMAND-SPEEDSrpm; of a conoid for a range of speeds, that range, rpm.
    ///
    /// ```
    /// # use camgen_cams as camgen;
    /// use camgen::{Machine, Spec};
    ///
    /// let (machine, name) = Machine::load("feeder", &[])?;
    /// let cam = Spec::of_program(machine, Some(120.0)).ok_or("no motion")?.solve()?;
    /// assert_eq!(cam.stem(&name, None), "feeder-make-120rpm");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn stem(&self, machine: &str, range: Option<[f64; 2]>) -> String {
        let command = self.body().kind().command;
        let speeds = match self.body().speeds() {
            Speeds::Any(()) => return format!("{machine}-{command}"),
            Speeds::One(rpm) => names(&[rpm]).concat(),
            Speeds::Several(speeds) => {
                let sections = names(&speeds);
                match (range, sections.as_slice()) {
                    (Some(range), _) => names(&range).join("-"),
                    (None, [first, .., last]) if sections.len() > MOST_NAMED => format!("{first}-{last}"),
                    (None, _) => sections.join("-"),
                }
            }
        };
        format!("{machine}-{command}-{speeds}rpm")
    }
}

impl Judged {
    /// The usual start of the names of its files, MACHINE-COMMAND-SPEEDSrpm; a variant of a command has its name behind that of the command.
    #[must_use]
    pub fn stem(&self, machine: &str) -> String {
        let variant = self.analysis().variant;
        let between = if variant.is_empty() { "" } else { "-" };
        let command = format!("{}{between}{variant}", self.analysis().kind.command);
        let of = |speeds: &[String]| format!("{machine}-{command}-{}rpm", speeds.join("-"));
        match &self.analysis().speeds {
            Speeds::Any(()) => format!("{machine}-{command}"),
            Speeds::One(rpm) => of(&names(&[*rpm])),
            Speeds::Several(speeds) => match (of(&names(speeds)), speeds.as_slice()) {
                (long, [first, .., last]) if long.len() > LONGEST => of(&names(&[*first, *last])),
                (stem, _) => stem,
            },
        }
    }
}
