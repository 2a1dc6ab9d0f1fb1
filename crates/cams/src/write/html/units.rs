//! Names that end in their unit, split into name and unit for people.

/// The end of a name, the unit as people write it, and how often it is divided by the angle of the shaft.
type ColumnUnit = (&'static str, &'static str, u8);

/// Longer endings before the shorter ones they contain.
const UNITS: &[ColumnUnit] = &[
    ("n_per_mm", "N/mm", 0),
    ("n_per_m", "N/m", 0),
    ("um_per_kn", "µm/kN", 0),
    ("urad_per_kn", "µrad/kN", 0),
    ("kg_m2", "kg·m²", 0),
    ("mm_per_mm3", "mm/mm³", 0),
    ("mm_per_mm2", "mm/mm²", 0),
    ("mm_per_mm", "mm/mm", 0),
    ("per_mm", "1/mm", 0),
    ("mm_per_rad3", "mm/rad³", 3),
    ("mm_per_rad2", "mm/rad²", 2),
    ("mm_per_rad", "mm/rad", 1),
    ("rad_per_rad3", "rad/rad³", 3),
    ("rad_per_rad2", "rad/rad²", 2),
    ("rad_per_rad", "rad/rad", 1),
    ("rad_per_s3", "rad/s³", 0),
    ("rad_per_s2", "rad/s²", 0),
    ("mm_per_s2", "mm/s²", 0),
    ("mm_per_s", "mm/s", 0),
    ("m_per_s3", "m/s³", 0),
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
    ("us", "µs", 0),
    ("per_s3", "per s³", 0),
    ("per_s2", "per s²", 0),
    ("per_s", "per s", 0),
    ("s", "s", 0),
    ("j", "J", 0),
];

/// A name split into its parts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct ColumnName<'a> {
    /// The name without its unit.
    pub(super) stem: &'a str,
    /// The unit as people write it; empty where there is none.
    pub(super) unit: &'static str,
    /// How often it is divided by the angle of the shaft.
    pub(super) order: u8,
}

/// The parts of a name.
pub(super) fn named(name: &str) -> ColumnName<'_> {
    let of = |(end, unit, order): &ColumnUnit| {
        let stem = name.strip_suffix(end)?;
        // A single letter is a quantity, such as W of a linkage.
        let bare = stem.is_empty() && name.len() > 1;
        let stem = if bare { stem } else { stem.strip_suffix('_')? };
        Some(ColumnName { stem, unit, order: *order })
    };
    UNITS.iter().find_map(of).unwrap_or(ColumnName { stem: name, unit: "", order: 0 })
}

/// Names that are not their own words: of columns, and of values of a report. A name with its unit stands before the same one without.
const WORDS: &[(&str, &str)] = &[
    ("rpm", "speed"),
    ("cam_deg", "cam angle θ"),
    ("crank_deg", "crank angle"),
    ("from_deg", "from"),
    ("to_deg", "to"),
    ("frame_deg", "angle of the frame"),
    ("wrap_deg", "wrap of the belt"),
    ("rod_deg", "angle of the rod"),
    ("transmission_deg", "transmission angle"),
    ("rod_angle", "angle of the rod"),
    ("motor_rpm", "speed of the motor"),
    ("x", "place x"),
    ("dx", "Δx of the bottom"),
    ("z", "place z along the axis"),
    ("position", "position of the follower"),
    ("pitch_x", "pitch curve, x"),
    ("pitch_y", "pitch curve, y"),
    ("profile_x", "profile, x"),
    ("profile_y", "profile, y"),
    ("contact_x", "contact, x"),
    ("contact_y", "contact, y"),
    ("contact_z", "contact, z"),
    ("pitch_curvature_radius", "radius of curvature, pitch curve"),
    ("profile_curvature_radius", "radius of curvature, profile"),
    ("principal_curvature_radius", "sharpest radius of curvature"),
    ("face", "contact from the stem or pivot"),
    ("psi", "angle ψ of the bell crank"),
    ("alpha", "slope angle α of the flank"),
    ("slope_urad_per_kn", "slope of the shaft"),
    ("slope", "slope dΔx/dx of the bottom"),
    ("lift_per_z", "slope of the lift along the axis"),
    ("axial_angle", "lean of the normal along the axis"),
    ("axial_force", "force along the axis"),
    ("roller_force", "force along the path"),
    ("contact_force", "force along the normal"),
    ("torque", "torque of the shaft"),
    ("inertia", "inertia force"),
    ("air", "force of the air"),
    ("air_fixed_bottom", "force of the air, fixed bottom"),
    ("residual", "residual force"),
    ("residual_braking", "residual force, braking"),
    ("residual_return", "residual force, return stroke"),
    ("residual_fixed_bottom", "residual force, fixed bottom"),
    ("omega", "angular velocity of the crank"),
    ("k", "coefficient K"),
    ("weight_arm", "arm of the weight"),
    ("press_arm", "arm of the press force"),
    ("tight_arm", "arm of the tight span"),
    ("slack_arm", "arm of the slack span"),
    ("tension", "web tension"),
    ("tension_printed", "web tension, printed moment"),
    ("tension_share", "share of the wanted tension"),
    ("belt_slack", "tension of the slack span"),
    ("belt_tight", "tension of the tight span"),
    ("belt_speed_ratio", "speed ratio V_z/V"),
    ("friction_sensitivity", "change of tension over that of friction"),
    ("mode1", "shape of mode 1"),
    ("outer_x", "outer flank, x"),
    ("outer_y", "outer flank, y"),
    ("inner_x", "inner flank, x"),
    ("inner_y", "inner flank, y"),
    ("mode2", "shape of mode 2"),
    ("mode3", "shape of mode 3"),
    ("cv", "velocity factor C_v"),
    ("ca", "acceleration factor C_a"),
    ("cj", "jerk factor C_j"),
    ("c_va", "torque factor C_va"),
    ("rms_acceleration", "effective acceleration"),
    ("jump", "jump speed"),
    ("min_convex_radius", "smallest convex radius"),
    ("continuity", "continuous derivatives"),
    ("dxf_us", "DXF"),
    ("svg_us", "SVG"),
    ("step_us", "STEP"),
    ("csv_us", "CSV"),
    ("total_low", "total, lower quartile"),
    ("total_high", "total, upper quartile"),
    ("rolled", "gap by rolling"),
    ("k_phi", "K_φ"),
    ("k_c", "K_c"),
    ("c_plus", "C⁺"),
    ("c_minus", "C⁻"),
    ("w", "W"),
];

/// The end of a name and how it is said; `{}` stands for the rest.
const ENDS: &[(&str, &str)] = &[
    ("_cut", "{} as cut"),
    ("_max", "largest {}"),
    ("_min", "smallest {}"),
    ("_least", "least {}"),
    ("_largest", "largest {}"),
    ("_mean", "mean {}"),
    ("_q99", "{} in 99 of 100 places"),
    ("_share", "{} as a share"),
    ("_at_x", "place x of the {}"),
    ("_x", "place x of the {}"),
    ("_z", "place z of the {}"),
    ("_cam", "cam angle of the {}"),
    ("_at", "place of the {}"),
];

/// A name as words; one that consists of its unit alone is called by it.
pub(super) fn words(name: &str) -> String {
    let ColumnName { stem, unit, .. } = named(name);
    let known = |name: &str| WORDS.iter().find(|(known, _)| *known == name).map(|(_, words)| (*words).to_owned());
    if let Some(words) = known(name).or_else(|| known(stem)) {
        return words;
    }
    let said = |(end, words): &(&str, &str)| Some(words.replace("{}", &self::words(stem.strip_suffix(end)?)));
    let plain = || if stem.is_empty() { unit.to_owned() } else { stem.replace('_', " ") };
    ENDS.iter().find_map(said).unwrap_or_else(plain)
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
        assert_eq!(words("dx_max_at_x_mm"), "place x of the largest Δx of the bottom");
        assert_eq!(words("acceleration_error_max_cam_deg"), "cam angle of the largest acceleration error");
        assert_eq!(words("velocity_cut_mm_per_rad"), "velocity as cut");
        assert_eq!((words("rpm"), words("dxf_us"), words("step_deg")), ("speed".into(), "DXF".into(), "step".into()));
    }
}
