//! As the cheapest, where the sines of sums of angles of parallel joints may be
//! evaluated instead of formed.

use super::{Approach, Beginning, Problem, auto};
use crate::graph::Graph;
use crate::portfolio::{Sums, angle_sums};
use crate::scene::SceneRobot;

/// The start `angle_sums`.
pub(super) struct AngleSums;

impl Beginning for AngleSums {
    fn name(&self) -> &'static str {
        "angle_sums"
    }

    fn approaches(&self, problem: &Problem<'_>) -> Vec<Approach> {
        auto::approaches(problem)
    }

    fn helpers(&self, scene_robot: &SceneRobot) -> Vec<Graph> {
        vec![angle_sums(scene_robot, Sums::Inputs)]
    }

    fn has_chain(&self) -> bool {
        true
    }
}
