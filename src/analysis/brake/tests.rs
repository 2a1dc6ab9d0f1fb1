//! The report of the embedded brakes against the numbers of the specification.
