//! The linkage of a bed put together in code.

use super::machine::LinkageLimits;
use crate::press::bed_motion::{DragLink, Linkage, Slider};
use crate::press::machine::LinkageData;
use camgen_cams::pipeline::Builder;

/// A linkage put together in code: methods of the [`Builder`].
pub trait BuilderOfLinkage: Sized {
    /// What moves the bed of a press: a yoke, a crank-slider, or a drag link before the crank-slider.
    ///
    /// ```
    /// use camgen::domains::linkage::analysis;
    /// use camgen::domains::press::BufferData;
    /// use camgen::domains::press::bed_motion::{Linkage, Slider};
    /// use camgen::domains::press::buffer::{Bed, bottom_law::ColumnRule};
    /// use camgen::domains::press::machine::{AirColumn, LinkageData};
    /// use camgen::{BuilderOfLinkage, BuilderOfPress, Judged, Spec};
    ///
    /// let slider = Slider { rod_ratio: 3.0, offset_ratio: 0.0 };
    /// let machine = Spec::builder("bed")
    ///     .bed(Bed { mass: 978.2, crank_radius: 0.180, crank_turns_per_main_shaft_turn: 3.0 })
    ///     .buffer(BufferData {
    ///         polytropic_exponent: 1.35,
    ///         ambient_pressure: 1e5,
    ///         end_pressure: 2e5,
    ///         column: AirColumn::Of(ColumnRule::Matched),
    ///         lead: 0.0,
    ///     })
    ///     .linkage(LinkageData { linkage: Linkage::CrankSlider(slider), driving_crank: None, base_angle: 0.0 })
    ///     .roller(0.030)
    ///     .machine()?;
    /// assert!(Judged::new(analysis::analysis(&machine, 35.0, None)?).passed());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    fn linkage(self, data: LinkageData) -> Self;

    /// What the linkage must keep.
    #[must_use]
    fn linkage_limits(self, limits: LinkageLimits) -> Self;
}

impl BuilderOfLinkage for Builder {
    fn linkage(self, data: LinkageData) -> Self {
        let builder =
            self.angle("linkage.base_angle", data.base_angle).length("linkage.driving_crank", data.driving_crank);
        match data.linkage {
            Linkage::Yoke => builder.set("linkage.kind", "yoke"),
            Linkage::CrankSlider(slider) => with_slider(builder.set("linkage.kind", "crank-slider"), slider),
            Linkage::SixBar(link, slider) => {
                let DragLink { base, coupler, follower, turn, branch: _ } = link;
                let builder = builder
                    .set("linkage.kind", "six-bar")
                    .number("linkage.base_ratio", base)
                    .number("linkage.coupler_ratio", coupler)
                    .number("linkage.follower_ratio", follower)
                    .angle("linkage.follower_angle", turn - data.base_angle);
                with_slider(builder, slider)
            }
        }
    }

    fn linkage_limits(self, limits: LinkageLimits) -> Self {
        let LinkageLimits { transmission_angle, rod_angle, link_ratio } = limits;
        self.angle("limits.transmission_angle", transmission_angle)
            .angle("limits.rod_angle", rod_angle)
            .number("limits.link_ratio", link_ratio)
    }
}

fn with_slider(builder: Builder, slider: Slider) -> Builder {
    builder.number("linkage.rod_ratio", slider.rod_ratio).number("linkage.offset_ratio", slider.offset_ratio)
}
