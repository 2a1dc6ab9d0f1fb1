//! Reads lists of places for a measuring machine.

use nalgebra::Vector2;

/// A place as it was read, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReadPlace {
    /// Cam angle, degrees.
    pub cam_deg: f64,
    /// The place.
    pub point: Vector2<f64>,
    /// The normal.
    pub normal: Vector2<f64>,
    /// The centre of the ball.
    pub ball: Vector2<f64>,
}

/// What the header of a list begins with.
const HEAD: &str = "no,cam_deg,polar_deg,radius_mm,x_mm,y_mm,normal_x,normal_y,ball_x_mm,ball_y_mm,";

/// Reads a list.
///
/// # Errors
/// A sentence when it is not one.
pub fn read(bytes: &[u8]) -> Result<Vec<ReadPlace>, String> {
    let text = std::str::from_utf8(bytes).map_err(|error| error.to_string())?;
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    if !lines.next().is_some_and(|line| line.starts_with(HEAD)) {
        return Err("the line that names the columns is missing".into());
    }
    let row = |(index, line): (usize, &str)| {
        let numbers: Option<Vec<f64>> = line.split(',').map(|cell| cell.parse().ok()).collect();
        let numbers = numbers.unwrap_or_default();
        let [number, cam_deg, polar, radius, x, y, normal_x, normal_y, ball_x, ball_y, ..] = numbers.as_slice() else {
            return Err(format!("row {} has not the numbers of a place", index + 1));
        };
        let (sin, cos) = libm::sincos(polar.to_radians());
        let point = Vector2::new(*x, *y);
        let counted = u32::try_from(index + 1).is_ok_and(|own| f64::from(own) == *number);
        if !counted || (Vector2::new(cos, sin) * *radius - point).norm() > 1e-6 {
            return Err(format!("row {} contradicts itself", index + 1));
        }
        let (normal, ball) = (Vector2::new(*normal_x, *normal_y), Vector2::new(*ball_x, *ball_y));
        Ok(ReadPlace { cam_deg: *cam_deg, point, normal, ball })
    };
    lines.enumerate().map(row).collect()
}
