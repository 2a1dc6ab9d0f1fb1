//! Keyways of hubs for parallel keys: DIN 6885-1, which agrees with ISO 773.

/// Bore up to, width, depth in the hub t2 and its upper deviation, mm. Sizes above 440 mm are not tabulated.
const KEYWAYS: [(f64, f64, f64, f64); 25] = [
    (8.0, 2.0, 1.0, 0.1),
    (10.0, 3.0, 1.4, 0.1),
    (12.0, 4.0, 1.8, 0.1),
    (17.0, 5.0, 2.3, 0.1),
    (22.0, 6.0, 2.8, 0.1),
    (30.0, 8.0, 3.3, 0.2),
    (38.0, 10.0, 3.3, 0.2),
    (44.0, 12.0, 3.3, 0.2),
    (50.0, 14.0, 3.8, 0.2),
    (58.0, 16.0, 4.3, 0.2),
    (65.0, 18.0, 4.4, 0.2),
    (75.0, 20.0, 4.9, 0.2),
    (85.0, 22.0, 5.4, 0.2),
    (95.0, 25.0, 5.4, 0.2),
    (110.0, 28.0, 6.4, 0.2),
    (130.0, 32.0, 7.4, 0.2),
    (150.0, 36.0, 8.4, 0.3),
    (170.0, 40.0, 9.4, 0.3),
    (200.0, 45.0, 10.4, 0.3),
    (230.0, 50.0, 11.4, 0.3),
    (260.0, 56.0, 12.4, 0.3),
    (290.0, 63.0, 12.4, 0.3),
    (330.0, 70.0, 14.4, 0.3),
    (380.0, 80.0, 15.4, 0.3),
    (440.0, 90.0, 17.4, 0.3),
];
/// Bores from here on have a keyway, mm.
pub const SMALLEST_BORE: f64 = 6.0;
/// Largest bore of the table, mm.
pub const LARGEST_BORE: f64 = 440.0;

/// A standard keyway in the hub.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HubKeyway {
    /// Width, m.
    pub width: f64,
    /// Depth t2 beyond the bore, m.
    pub depth: f64,
    /// By how much it may be deeper, m.
    pub deeper: f64,
}

/// The keyway of a hub with a bore (diameter, m); `None` for bores that the standard does not have.
#[must_use]
pub fn of_bore(diameter: f64) -> Option<HubKeyway> {
    // A diameter that was typed as a radius in inches differs in its last digit.
    const ROUNDING: f64 = 1e-9;
    let bore = 1e3 * diameter;
    if bore <= SMALLEST_BORE - ROUNDING {
        return None;
    }
    let (_, width, depth, deeper) = KEYWAYS.iter().find(|(end, ..)| bore <= end + ROUNDING)?;
    Some(HubKeyway { width: 1e-3 * width, depth: 1e-3 * depth, deeper: 1e-3 * deeper })
}

/// The standard keyway of a bore, where a keyway is one.
#[must_use]
pub fn standard(diameter: f64, width: f64, depth: f64) -> Option<HubKeyway> {
    const SAME: f64 = 1e-9;
    of_bore(diameter).filter(|standard| (standard.width - width).abs() < SAME && (standard.depth - depth).abs() < SAME)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bore, width and depth in the hub as printed: Berger, Standard Parts Catalogue, page 2079 (to 44 mm), and Siemens MD 10.1 (2015), 15/3.
    #[test]
    fn keyways_are_those_of_the_printed_tables() {
        let known = [
            (6.0, 2.0, 1.0),
            (7.0, 2.0, 1.0),
            (8.0, 2.0, 1.0),
            (9.0, 3.0, 1.4),
            (10.0, 3.0, 1.4),
            (11.0, 4.0, 1.8),
            (12.0, 4.0, 1.8),
            (13.0, 5.0, 2.3),
            (14.0, 5.0, 2.3),
            (15.0, 5.0, 2.3),
            (16.0, 5.0, 2.3),
            (17.0, 5.0, 2.3),
            (18.0, 6.0, 2.8),
            (20.0, 6.0, 2.8),
            (22.0, 6.0, 2.8),
            (24.0, 8.0, 3.3),
            (25.0, 8.0, 3.3),
            (26.0, 8.0, 3.3),
            (28.0, 8.0, 3.3),
            (30.0, 8.0, 3.3),
            (32.0, 10.0, 3.3),
            (34.0, 10.0, 3.3),
            (35.0, 10.0, 3.3),
            (36.0, 10.0, 3.3),
            (38.0, 10.0, 3.3),
            (40.0, 12.0, 3.3),
            (42.0, 12.0, 3.3),
            (44.0, 12.0, 3.3),
            (45.0, 14.0, 3.8),
            (50.0, 14.0, 3.8),
            (51.0, 16.0, 4.3),
            (58.0, 16.0, 4.3),
            (60.0, 18.0, 4.4),
            (65.0, 18.0, 4.4),
            (70.0, 20.0, 4.9),
            (75.0, 20.0, 4.9),
            (80.0, 22.0, 5.4),
            (85.0, 22.0, 5.4),
            (90.0, 25.0, 5.4),
            (95.0, 25.0, 5.4),
            (100.0, 28.0, 6.4),
            (110.0, 28.0, 6.4),
            (120.0, 32.0, 7.4),
            (130.0, 32.0, 7.4),
            (140.0, 36.0, 8.4),
            (150.0, 36.0, 8.4),
            (160.0, 40.0, 9.4),
            (170.0, 40.0, 9.4),
            (180.0, 45.0, 10.4),
            (200.0, 45.0, 10.4),
            (220.0, 50.0, 11.4),
            (250.0, 56.0, 12.4),
            (280.0, 63.0, 12.4),
            (320.0, 70.0, 14.4),
            (360.0, 80.0, 15.4),
            (400.0, 90.0, 17.4),
        ];
        for (bore, width, depth) in known {
            let found = of_bore(1e-3 * bore).expect("in the table");
            assert!((1e3 * found.width - width).abs() < 1e-9 && (1e3 * found.depth - depth).abs() < 1e-9, "{bore}");
            assert_eq!(standard(1e-3 * bore, found.width, found.depth), Some(found));
            assert_eq!(standard(1e-3 * bore, found.width, 0.9 * found.depth), None);
        }
        assert_eq!((of_bore(0.0059), of_bore(0.441)), (None, None));
    }
}
