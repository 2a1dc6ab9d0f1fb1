//! A linkage as the table `[linkage]` of a machine file.

use crate::press::bed_motion::{Branch, DragLink, Linkage, Slider};
use crate::press::machine::LinkageData;
use camgen_kernel::geometry::MILLIMETRES;

/// The lines of the table; none for a drag link that runs behind its driving crank, which a machine file has no key for.
pub(super) fn lines(data: &LinkageData) -> Option<Vec<String>> {
    let mut lines = vec!["[linkage]".to_owned()];
    match data.linkage {
        Linkage::Yoke => lines.push("kind = \"yoke\"".into()),
        Linkage::CrankSlider(slider) => {
            lines.push("kind = \"crank-slider\"".into());
            lines.extend(of_slider(slider));
        }
        Linkage::SixBar(link, slider) => {
            if link.branch != Branch::Leading {
                return None;
            }
            lines.push("kind = \"six-bar\"".into());
            lines.extend(of_slider(slider));
            lines.extend(of_drag_link(link, data));
        }
    }
    Some(lines)
}

fn of_slider(slider: Slider) -> [String; 2] {
    [format!("rod_ratio = {}", slider.rod_ratio), format!("offset_ratio = {}", slider.offset_ratio)]
}

/// Leaves out a base along the slider's line and a driving crank without length: they are the defaults.
fn of_drag_link(link: DragLink, data: &LinkageData) -> Vec<String> {
    let (base_angle, follower_angle) = (data.base_angle.to_degrees(), (link.turn - data.base_angle).to_degrees());
    let mut lines = vec![
        format!("base_ratio = {}", link.base),
        format!("coupler_ratio = {}", link.coupler),
        format!("follower_ratio = {}", link.follower),
        // A whole turn is the most that a file may give, and rounding must not go beyond it.
        format!("follower_angle = \"{} deg\"", follower_angle.clamp(-360.0, 360.0)),
    ];
    if base_angle != 0.0 {
        lines.push(format!("base_angle = \"{base_angle} deg\""));
    }
    lines.extend(data.driving_crank.map(|crank| format!("driving_crank = \"{} mm\"", MILLIMETRES * crank)));
    lines
}
