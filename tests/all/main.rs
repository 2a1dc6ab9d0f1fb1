//! The library and the program from outside: one program of tests, a module each.

#![allow(
    clippy::expect_used,
    clippy::panic,
    clippy::print_stdout,
    clippy::indexing_slicing,
    missing_docs,
    reason = "a test fails loudly, and its tables are printed"
)]

mod common;

mod analyses;
mod architecture;
mod arcs;
mod as_made;
mod as_returned;
mod barrels;
mod bounds;
#[cfg(feature = "printing")]
mod brake;
mod check_kinds;
mod circles;
mod cli;
mod cli_kinds;
mod conjugate;
mod diagnosis;
mod diagram;
mod entry_points;
mod examples;
mod faults;
mod felt;
mod following;
mod forces;
mod gcode;
mod groove;
mod groove_cam;
mod heads;
mod holes;
mod html;
mod importing;
mod inches;
mod inputs;
mod laws;
mod linkage_cams;
mod live;
mod lobes;
mod milling;
mod mistakes;
mod mutations;
mod oracle;
mod part_features;
mod pipeline;
mod points;
mod programs;
mod properties;
mod readback;
mod reading;
// The book describes every domain and format.
#[cfg(all(feature = "brake", feature = "html", feature = "pdf"))]
mod readme;
mod remedies;
mod rib_and_yoke;
mod rows;
// What is stored is made by every domain and format.
#[cfg(all(feature = "brake", feature = "html", feature = "pdf"))]
mod same_bytes;
mod scatter;
mod servo;
mod shaft;
mod sheets;
mod shop;
mod size;
mod solids;
mod speeds;
mod spline;
mod spline_solids;
mod stability;
mod starts;
mod step;
mod study;
mod summaries;
mod supply;
mod surface;
mod tables;
mod terminal;
mod translating;
mod two_sided;
mod verdicts;
mod walls;
mod wedge;
mod words;
