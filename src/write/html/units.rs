//! Names that end in their unit, taken apart for people.

/// The end of a name, the unit as people write it, and how often it is divided by the angle of the shaft.
type Unit = (&'static str, &'static str, u8);

/// Longer ends before those that they end in.
const UNITS: &[Unit] = &[
    ("n_per_mm", "N/mm", 0),
    ("per_mm", "1/mm", 0),
    ("mm_per_rad3", "mm/rad³", 3),
    ("mm_per_rad2", "mm/rad²", 2),
    ("mm_per_rad", "mm/rad", 1),
    ("rad_per_rad3", "rad/rad³", 3),
    ("rad_per_rad2", "rad/rad²", 2),
    ("rad_per_rad", "rad/rad", 1),
    ("mm_per_s2", "mm/s²", 0),
    ("mm_per_s", "mm/s", 0),
    ("m_per_s2", "m/s²", 0),
    ("m_per_s", "m/s", 0),
    ("g_mm", "g·mm", 0),
    ("mm2", "mm²", 0),
    ("mm3", "mm³", 0),
    ("mm", "mm", 0),
    ("deg", "°", 0),
    ("rad_per_s", "rad/s", 0),
    ("nm", "N·m", 0),
    ("n", "N", 0),
    ("w", "W", 0),
    ("mpa", "MPa", 0),
    ("kg", "kg", 0),
    ("rpm", "rpm", 0),
    ("pa", "Pa", 0),
];

/// A name taken apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Named<'a> {
    /// The name without its unit.
    pub(super) stem: &'a str,
    /// The unit as people write it; empty where there is none.
    pub(super) unit: &'static str,
    /// How often it is divided by the angle of the shaft.
    pub(super) order: u8,
}

/// The parts of a name.
pub(super) fn named(name: &str) -> Named<'_> {
    let of = |(end, unit, order): &Unit| {
        let stem = name.strip_suffix(end)?;
        // A single letter is a quantity, as W of a linkage.
        let bare = stem.is_empty() && name.len() > 1;
        let stem = if bare { stem } else { stem.strip_suffix('_')? };
        Some(Named { stem, unit, order: *order })
    };
    UNITS.iter().find_map(of).unwrap_or(Named { stem: name, unit: "", order: 0 })
}

/// A stem as words; a name that is nothing but its unit is called by it.
pub(super) fn words(name: &str) -> String {
    let Named { stem, unit, .. } = named(name);
    if stem.is_empty() { unit.to_owned() } else { stem.replace("dx", "Δx").replace('_', " ") }
}

/// A unit of a finding as people write it.
pub(super) fn shown(unit: &str) -> String {
    match unit {
        "1" => String::new(),
        "deg" => "°".into(),
        other => other.replace("rad2", "rad²").replace("rad3", "rad³"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_taken_apart() {
        let apart = |name| (named(name).stem, named(name).unit, named(name).order);
        assert_eq!(apart("acceleration_cut_mm_per_rad2"), ("acceleration_cut", "mm/rad²", 2));
        assert_eq!(apart("velocity_rad_per_rad"), ("velocity", "rad/rad", 1));
        assert_eq!(apart("torque_nm"), ("torque", "N·m", 0));
        assert_eq!(apart("inertia_n"), ("inertia", "N", 0));
        assert_eq!(apart("power_w"), ("power", "W", 0));
        assert_eq!(apart("w"), ("w", "", 0));
        assert_eq!(apart("slope"), ("slope", "", 0));
        assert_eq!(apart("rpm"), ("", "rpm", 0));
        assert_eq!(words("dx_max_at_x_mm"), "Δx max at x");
        assert_eq!(words("rpm"), "rpm");
    }
}
