//! The module of a robot.
