//! The errors of both controllers, as SVG.

use example_shared::chart::{Chart, Line, Panel, Scale};

use crate::{Run, Sample};

/// Returns the chart of a controller that learns and of one that does not.
pub fn svg(adaptive: &Run, fixed: &Run) -> String {
    let panel = |title, of: fn(&Sample) -> f64| {
        let line = |name, run: &Run| Line {
            name,
            points: run.samples.iter().map(|s| [s.time, of(s)]).collect(),
        };
        Panel {
            title,
            scale: Scale::Logarithmic,
            lines: vec![line("learns", adaptive), line("keeps the empty arm", fixed)],
        }
    };
    let chart = Chart {
        title: "Adaptive control with 1.5 kg that the controller does not know",
        panels: vec![
            panel("largest error of a joint, rad", |sample| sample.error),
            panel("largest error of the model's torques, N·m", |sample| {
                sample.torque_error
            }),
        ],
    };
    chart.svg()
}
