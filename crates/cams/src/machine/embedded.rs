//! The machine files carried in the binary.

/// A machine file in the binary.
#[derive(Debug, Clone, Copy)]
pub struct Embedded {
    /// Its name on the command line.
    pub name: &'static str,
    /// The command that it is first of all for.
    pub command: &'static str,
    /// Its text.
    pub toml: &'static str,
}

/// The embedded machines of the core; those of domains stand before them in the catalogue.
pub const EMBEDDED: &[Embedded] = &[
    Embedded { name: "barrel", command: "make", toml: include_str!("../../profiles/barrel.toml") },
    Embedded { name: "conjugate", command: "make", toml: include_str!("../../profiles/conjugate.toml") },
    Embedded { name: "feeder", command: "make", toml: include_str!("../../profiles/feeder.toml") },
    Embedded { name: "lever", command: "make", toml: include_str!("../../profiles/lever.toml") },
    Embedded { name: "groove", command: "make", toml: include_str!("../../profiles/groove.toml") },
    Embedded { name: "indexer", command: "make", toml: include_str!("../../profiles/indexer.toml") },
    Embedded { name: "yoke", command: "make", toml: include_str!("../../profiles/yoke.toml") },
    Embedded { name: "wedge", command: "make", toml: include_str!("../../profiles/wedge.toml") },
    Embedded { name: "valve", command: "make", toml: include_str!("../../profiles/valve.toml") },
];

impl Embedded {
    /// What its file calls the machine.
    #[must_use]
    pub fn title(&self) -> &'static str {
        let name = self.toml.lines().find_map(|line| line.strip_prefix("name = \""));
        name.and_then(|rest| rest.split('"').next()).unwrap_or(self.name)
    }
}
