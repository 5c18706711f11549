//! `dalembert count`: the operations of the generated functions.

use dalembert_codegen::{GeneratedFunction, ScalarType};
use serde_json::{Map, Value, json};

use crate::args::CountArgs;
use crate::generate::report;
use crate::outcome::Outcome;
use crate::{input, output, progress};

/// Runs the subcommand.
pub fn run(args: &CountArgs) -> Outcome {
    let wanted = input::wanted(&args.robot, &args.options.0, &ScalarType::ALL)?;
    let input::Wanted {
        robot, mut request, ..
    } = wanted;
    let scene = request.scene.as_ref();
    if scene.is_none_or(|scene| scene.tolerance.is_none()) {
        // Both scalars run the same program: one is enough to count it, and a
        // constant that f32 cannot hold is no reason not to. What a tolerance
        // admits depends on the scalar.
        request.scalars.retain(|&scalar| scalar == ScalarType::F64);
        if request.scalars.is_empty() {
            request.scalars = vec![ScalarType::F32];
        }
    }
    let session = progress::watch(&mut request);
    let generated = input::generated(&args.robot, &robot, &request)?;
    drop(session);
    if args.json {
        // The first that was emitted.
        let scalar = generated.emitted.first().map(|emitted| emitted.scalar);
        let of =
            |f: &GeneratedFunction| output::counts(&scalar.map_or(f.counts(), |s| f.counts_in(s)));
        let functions = generated.functions.iter();
        let functions: Map<String, Value> =
            functions.map(|f| (f.function.to_string(), of(f))).collect();
        let scene = request.scene.as_ref().map(|scene| &scene.name);
        let input = robot.short_hash();
        return output::print_json(&match scene {
            Some(scene) => {
                json!({ "robot": robot.name, "input": input, "scene": scene, "functions": functions })
            }
            None => json!({ "robot": robot.name, "input": input, "functions": functions }),
        });
    }
    let mut text = report::head(&robot, &request);
    text += &report::counts(&generated, args.verbose);
    text += &report::sines(&generated);
    if args.verbose {
        text += &report::limits(&generated);
    }
    text += &format!("\n{}\n", report::proved(&generated));
    let warnings = report::warnings(&generated);
    if !warnings.is_empty() {
        output::note(&warnings);
    }
    output::print(&text)
}
