//! `dalembert count`: the operations of the generated functions.

use dalembert_codegen::ScalarType;

use crate::args::TaskArgs;
use crate::code::{Detail, report};
use crate::output::{Context, Outcome};
use crate::source::Source;

/// Arguments of `count`.
#[derive(Debug, clap::Args)]
pub struct CountArgs {
    #[command(flatten)]
    task: TaskArgs,
    /// Print also the longest chain of operations of each program, the calls of its code, the
    /// formulation that it was found from, its proof, the counts after each stage, and what
    /// rounding costs
    #[arg(short, long)]
    verbose: bool,
}

pub(crate) fn run(args: &CountArgs, context: &Context) -> Outcome {
    let source = Source::open(context, &args.task.robot, &args.task.chain)?;
    let mut request = source.request(&args.task.options.0, &ScalarType::ALL)?;
    let scene = request.scene.as_ref();
    if scene.is_none_or(|scene| scene.tolerance.is_none()) {
        // Both scalars run the same program: one is enough to count it, and a
        // constant that f32 cannot hold is no reason not to. The programs
        // that a tolerance admits depend on the scalar.
        request.scalars.retain(|&scalar| scalar == ScalarType::F64);
        if request.scalars.is_empty() {
            request.scalars = vec![ScalarType::F32];
        }
    }
    let generated = source.generate(context, &mut request)?;
    let detail = match args.verbose {
        true => Detail::Whole,
        false => Detail::Counts,
    };
    Ok(report(&source.robot, &request, &generated, detail).into())
}
