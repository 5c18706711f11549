//! Draws the tracking error as SVG.

use example_shared::chart::{Chart, Line, Panel, Scale};

use crate::Run;

/// Returns the chart of the arm that the controller knows, and of that with a payload.
pub fn svg(nominal: &Run, loaded: &Run) -> String {
    let line = |name, run: &Run| Line {
        name,
        points: run.tracking.clone(),
    };
    let chart = Chart {
        title: "Computed torque, PUMA 560",
        panels: vec![Panel {
            title: "largest error of a joint, rad",
            scale: Scale::Logarithmic,
            lines: vec![
                line("the arm of the model", nominal),
                line("with 50 g that it does not know", loaded),
            ],
        }],
    };
    chart.svg()
}
