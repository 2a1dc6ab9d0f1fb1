//! Tests of the press over the rooms of the core.

mod checks;
mod counter_torque;
mod motions;
mod rotary;
