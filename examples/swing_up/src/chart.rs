//! Angles and torque of a run, as SVG.

use example_shared::chart::{Chart, Line, Panel, Scale};

use crate::Run;
use crate::model::State;

/// Returns the chart of a run.
pub fn svg(run: &Run) -> String {
    let line = |name, of: fn(&State, f64) -> f64| Line {
        name,
        points: (run.samples.iter())
            .map(|(time, state, torque)| [*time, of(state, *torque)])
            .collect(),
    };
    let chart = Chart {
        title: "An acrobot swings up with 6 N·m at the elbow",
        panels: vec![
            Panel {
                title: "angle, degrees",
                scale: Scale::Linear,
                lines: vec![
                    line("first link from the horizontal", |state, _| {
                        state[0].to_degrees()
                    }),
                    line("elbow", |state, _| state[1].to_degrees()),
                ],
            },
            Panel {
                title: "torque, N·m",
                scale: Scale::Linear,
                lines: vec![line("elbow", |_, torque| torque)],
            },
        ],
    };
    chart.svg()
}
