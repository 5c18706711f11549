//! The equations over every scalar, and the readers of robot files: one program, so that both cores
//! run it. It is not among the model's tests, since there it would be optimised, which takes three
//! times as long as the tests run.

mod equations_axes;
mod equations_counts;
mod equations_extremes;
mod equations_identities;
mod equations_shoulder;
mod equations_slips;
mod equations_support;
mod floating;
mod friction;
mod outputs;
mod placed;
mod placed_support;
mod read_angles;
mod read_errors;
mod read_fuzz;
mod read_placements;
mod read_robots;
mod read_warnings;
mod scene_read;
mod support;
mod trees;
