//! What is left of a press cam in practice: machines that differ from the one the cam was cut for, and what the screw takes back.

pub mod analysis;
pub mod bed_path;
mod card;
pub mod error;
pub mod fault;
pub mod losses;
pub mod monte_carlo;
pub mod normal;
pub mod other_cams;
pub mod parameter;
mod plot;
pub mod propagation;
pub mod report;
pub mod reset;
pub mod section;
pub mod settings;
pub mod tables;
pub mod typed;

#[cfg(test)]
mod tests;
