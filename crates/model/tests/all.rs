//! One program of all test files: they share what they link, and both cores.

mod equations_axes;
mod equations_counts;
mod equations_extremes;
mod equations_golden;
mod equations_identities;
mod equations_shoulder;
mod equations_slips;
mod equations_support;
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
