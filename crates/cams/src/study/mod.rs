//! Studies: many designs of one machine file, a row of figures for each.
//!
//! A study file names a base, the keys that vary and the figures that are wanted. Row i is a function of the study and of i alone:
//! [`Study::rows`] makes any stretch of rows by itself, in any process, with the same bytes. Only what the wanted columns need is computed.
//!
//! ```
//! # use camgen_cams as camgen;
//! use camgen::study::Study;
//!
//! let study = Study::from_toml("quick.toml", r#"
//! name = "roller"
//! base = "valve"
//! kind = "sweep"
//! columns = ["cam.base_radius_mm", "checks.pressure_angle.value"]
//! [[parameter]]
//! key = "cam.base_radius"
//! from = "30 mm"
//! to = "40 mm"
//! steps = 3
//! "#)?;
//! assert_eq!(study.header(), "row,set.cam.base_radius_mm,cam.base_radius_mm,checks.pressure_angle.value,fault\n");
//! let rows = String::from_utf8(study.rows(0, 3))?;
//! assert_eq!(rows.lines().count(), 3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod figures;
mod journal;
mod keys;
mod kind;
#[cfg(feature = "html")]
mod page;
mod parameter;
#[cfg(feature = "parquet")]
mod parquet;
mod parts;
mod row;
mod run;
pub mod sampling;
mod specification;
mod summary;
mod table;

pub use crate::domain::DesignCommand;
pub use journal::{CompleteStudy, Journal, StudyFiles};
pub use keys::SECTIONS;
pub use kind::{Constraint, Goal, Objective, StudyKind};
pub use parameter::{Parameter, ParameterValue, Scale, Values};
pub use specification::{Study, StudyError, embedded};
pub use summary::{Distribution, Summary};
