//! The machine files carried in the binary.

/// A machine file in the binary.
#[derive(Debug, Clone, Copy)]
pub struct Embedded {
    /// Its name on the command line.
    pub name: &'static str,
    /// Its text.
    pub toml: &'static str,
}

/// Every embedded machine; the first is the default.
pub const EMBEDDED: &[Embedded] = &[
    Embedded { name: "dpi", toml: include_str!("../../profiles/dpi.toml") },
    Embedded { name: "dpi-paper", toml: include_str!("../../profiles/dpi-paper.toml") },
    Embedded { name: "dpi-crank-slider", toml: include_str!("../../profiles/dpi-crank-slider.toml") },
    Embedded { name: "dpi-six-bar", toml: include_str!("../../profiles/dpi-six-bar.toml") },
    Embedded { name: "dpi-shaft", toml: include_str!("../../profiles/dpi-shaft.toml") },
    Embedded { name: "press-cylinder", toml: include_str!("../../profiles/press-cylinder.toml") },
    Embedded { name: "dp", toml: include_str!("../../profiles/dp.toml") },
    Embedded { name: "feeder", toml: include_str!("../../profiles/feeder.toml") },
    Embedded { name: "lever", toml: include_str!("../../profiles/lever.toml") },
    Embedded { name: "valve", toml: include_str!("../../profiles/valve.toml") },
    Embedded { name: "roll", toml: include_str!("../../profiles/roll.toml") },
    Embedded { name: "roll-level", toml: include_str!("../../profiles/roll-level.toml") },
];

impl Embedded {
    /// What its file calls the machine.
    #[must_use]
    pub fn title(&self) -> &'static str {
        let name = self.toml.lines().find_map(|line| line.strip_prefix("name = \""));
        name.and_then(|rest| rest.split('"').next()).unwrap_or(self.name)
    }
}

/// Their names in one list for a message.
pub(crate) fn names() -> String {
    EMBEDDED.iter().map(|machine| machine.name).collect::<Vec<_>>().join(", ")
}
