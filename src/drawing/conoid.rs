//! The drawings of a conoid: a cut for each section, and the flank.
