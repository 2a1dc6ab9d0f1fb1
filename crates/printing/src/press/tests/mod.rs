//! Tests of the press over the rooms of the core.

mod checks;
mod counter_torque;
mod cutter_path;
mod envelope;
mod motions;
mod outline;
mod rotary;
mod solid;
