//! `dalembert table3`: the paper's Table 3 beside what the formulas cost as
//! written and what is generated ([`dalembert_report::table3`]), printed.

use dalembert_codegen::workspace::function::Function;
use dalembert_codegen::workspace::portfolio::{Source, Start};
use dalembert_codegen::workspace::program::Counts;
use dalembert_codegen::workspace::simplify::Pass;
use dalembert_model::robot::Robot;
use dalembert_report::table3::{self, FORMULATIONS, JOINTS, Pair, Row};
use serde_json::{Map, Value, json};

use crate::args::Table3Args;
use crate::outcome::Outcome;
use crate::{input, output};

/// Runs the subcommand.
pub fn run(args: &Table3Args) -> Outcome {
    match &args.robot {
        Some(file) => robot(&input::robot(file)?, args.json),
        None => table(args.json),
    }
}

fn table(as_json: bool) -> Outcome {
    let rows: Vec<Row> = JOINTS.map(table3::row).collect::<Result<_, _>>()?;
    if as_json {
        let rows: Vec<Value> = rows.iter().map(row_json).collect();
        return output::print_json(&json!({ "table3": rows }));
    }
    let mut text = String::from(
        "Table 3: inverse dynamics of n revolute joints, mul add.\n\
         paper: its polynomials. as written: the formula, no number special.\n\
         generated: for an arm of random numbers, quick search; auto: from regrouped chains.\n",
    );
    for (index, (_, name)) in FORMULATIONS.into_iter().enumerate() {
        let head = ["n", "paper", "as written", "generated"];
        let mut lines = vec![head.map(String::from).to_vec()];
        for row in &rows {
            let cell = &row.cells[index];
            lines.push(vec![
                row.n.to_string(),
                pair_text(cell.paper),
                pair_text(cell.written),
                counts_text(&cell.generated),
            ]);
        }
        text += &format!("\n{name}\n{}", output::table(&lines, 0));
    }
    let lines: Vec<_> = rows
        .iter()
        .map(|row| vec![row.n.to_string(), counts_text(&row.auto)])
        .collect();
    text += &format!("\nauto\n{}", output::table(&lines, 0));
    output::print(&text)
}

/// For one robot: the paper at its n, the formula with its numbers, and the
/// counts after every stage, from each formulation and from all.
fn robot(robot: &Robot, as_json: bool) -> Outcome {
    let n = robot.joints.len();
    let mut starts = Vec::new();
    for (formulation, name) in FORMULATIONS {
        let found = table3::comparison(robot, formulation)?;
        let key = Source::Textbook(formulation).name();
        starts.push((key, name, Some([found.paper, found.written]), found.passes));
    }
    starts.push((
        "auto",
        "the best start (auto)",
        None,
        table3::passes(robot, Start::Auto)?,
    ));
    if as_json {
        let formulations: Map<String, Value> = starts
            .iter()
            .map(|(key, _, formula, passes)| {
                let mut value = json!({});
                if let Some([paper, written]) = formula {
                    value["paper"] = pair_json(*paper);
                    value["as_written"] = pair_json(*written);
                }
                value["stages"] = passes.iter().map(stage_json).collect();
                ((*key).to_owned(), value)
            })
            .collect();
        return output::print_json(&json!({
            "robot": robot.name,
            "input": robot.short_hash(),
            "function": Function::InverseDynamics.name(),
            "joints": n,
            "formulations": formulations,
        }));
    }
    let mut text = format!(
        "robot {}, {n} joints, input {}\ninverse dynamics, mul add\n",
        robot.name,
        robot.short_hash()
    );
    for (_, name, formula, passes) in &starts {
        text += &format!("\nfrom {name}\n");
        let mut lines = Vec::new();
        if let Some([paper, written]) = formula {
            lines.push(vec!["Table 3".to_owned(), pair_text(*paper)]);
            lines.push(vec!["formula as written".to_owned(), pair_text(*written)]);
        }
        for Pass { name, counts } in passes {
            lines.push(vec![(*name).to_owned(), counts_text(counts)]);
        }
        text += &output::table(&lines, 0);
    }
    output::print(&text)
}

fn row_json(row: &Row) -> Value {
    let mut value = json!({ "n": row.n });
    for ((formulation, _), cell) in FORMULATIONS.into_iter().zip(&row.cells) {
        value[Source::Textbook(formulation).name()] = json!({
            "paper": pair_json(cell.paper),
            "as_written": pair_json(cell.written),
            "generated": output::counts(&cell.generated),
        });
    }
    value["auto"] = json!({ "generated": output::counts(&row.auto) });
    value
}

fn stage_json(stage: &Pass) -> Value {
    let mut value = json!({ "stage": stage.name });
    if let (Value::Object(value), Value::Object(counts)) =
        (&mut value, output::counts(&stage.counts))
    {
        value.extend(counts);
    }
    value
}

fn pair_json(pair: Pair) -> Value {
    json!({ "mul": pair.mul, "add": pair.add })
}

fn pair_text(pair: Pair) -> String {
    format!("{} {}", pair.mul, pair.add)
}

fn counts_text(counts: &Counts) -> String {
    format!("{} {}", counts.mul, counts.add)
}
