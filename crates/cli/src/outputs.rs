//! `dalembert outputs`: lists the functions that can be generated, from the model's table.

use dalembert_codegen::Function;
use dalembert_codegen::workspace::{Argument, Quantity, Sizes};
use dalembert_model::outputs::Axis;
use dalembert_model::robot::{Joint, Robot};
use serde_json::json;

use crate::output::Outcome;
use crate::report::{Cell, Report, Table, WIDTH, broken, cells};

pub(crate) fn run() -> Outcome {
    let mut report = Report::default();
    let mut functions = Table::keyed("function|takes|returns|unit|meaning|results");
    for function in Function::ALL {
        let taken = function.arguments().into_iter();
        let arguments: Vec<&str> = taken.map(Argument::name).collect();
        let quantities = function.quantities().iter();
        let results: Vec<[String; 3]> = quantities.map(|&quantity| result(quantity)).collect();
        let of_each = |text: fn(&[String; 3]) -> String| results.iter().map(text);
        let json = results
            .iter()
            .map(|[symbol, shape, unit]| json!({ "symbol": symbol, "shape": shape, "unit": unit }));
        let returned = of_each(|[symbol, shape, _]| format!("{symbol} [{shape}]"));
        let units: Vec<&str> = results.iter().map(|result| result[2].as_str()).collect();
        let (name, taken) = (function.name(), arguments.join(", "));
        report.line(format!("{name}({taken})"));
        let texts = of_each(|[symbol, shape, unit]| format!("{symbol} [{shape}] in {unit}"));
        let described = Vec::from_iter(texts).join("; ");
        for text in [&*described, function.summary()] {
            for line in broken(text, WIDTH - 4) {
                report.line(format!("    {line}"));
            }
        }
        functions.row(cells![
            name,
            Cell::of(taken, arguments),
            returned.collect::<Vec<_>>().join(", "),
            units.join("; "),
            function.summary(),
            Cell::json(json.collect::<Vec<_>>()),
        ]);
    }
    report.value("functions", functions.json());
    let mut arguments = Table::keyed("argument|symbol|meaning");
    for argument in Argument::ALL {
        let mut functions = Function::ALL.into_iter();
        if functions.any(|function| function.arguments().contains(&argument)) {
            let (name, symbol) = (argument.name(), argument.symbol());
            arguments.row(cells![name, symbol, argument.meaning()]);
        }
    }
    report.line(
        "\nn joints, k those of a limb, p base parameters. Units are for revolute joints; for a prismatic\n\
         joint read N for N·m and m for rad. `NAME@FRAME` is an output at a frame, `NAME=A+B` a function\n\
         with the results of A and B.",
    );
    report.table("arguments", "", arguments);
    Ok(report.into())
}

/// Returns symbol, shape and unit of a quantity.
fn result(quantity: Quantity) -> [String; 3] {
    let axis = |axis: &Axis| match axis {
        Axis::Coordinates | Axis::Links => "n".to_owned(),
        Axis::Limbs => "Σk²".to_owned(),
        Axis::Fixed(length) => length.to_string(),
        Axis::LinkParameters => "10n".to_owned(),
        Axis::BaseParameters => "p".to_owned(),
        Axis::Load => "l".to_owned(),
    };
    let axes: Vec<String> = quantity.shape().0.iter().map(axis).collect();
    let shape = match axes.is_empty() {
        true => "1".to_owned(),
        false => axes.join("×"),
    };
    let robot = Robot {
        joints: vec![Joint::default(); 2],
        ..Robot::default()
    };
    let sizes = Sizes {
        base: 1,
        load: 1,
        ..Sizes::floating(0, 2, 1)
    };
    let mut units: Vec<&str> = Vec::new();
    for unit in (0..quantity.len(sizes)).map(|i| quantity.unit(i, &[0, 1], sizes, &robot)) {
        if !unit.is_empty() && !units.contains(&unit) {
            units.push(unit);
        }
    }
    // Each column of base parameters has its own unit.
    let unit = match units.is_empty() {
        true => "mixed".to_owned(),
        false => units.join(", "),
    };
    [quantity.symbol().to_owned(), shape, unit]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::width;

    #[test]
    fn the_list_fits_a_terminal() {
        let text = run().unwrap().report.to_string();
        let gravity = "gravity(q)\n    c [n] in N·m\n    Gravity load";
        assert!(text.contains(gravity), "{text}");
        let wide: Vec<&str> = text.lines().filter(|line| width(line) > WIDTH).collect();
        assert!(wide.is_empty(), "{wide:#?}");
    }
}
