//! `dalembert generate`: code, written or printed.

use std::path::{Path, PathBuf};

use dalembert_codegen::workspace::{claim, keep, plan_file};
use dalembert_codegen::{Language, Request, ScalarType};
use dalembert_stamp::{beside, relative};

use crate::args::values::word_parser;
use crate::args::{CODE, TaskArgs};
use crate::code::{Detail, report};
use crate::files::{Files, Target};
use crate::output::{Context, Done, Failure, Outcome};
use crate::source::{Source, say_notes};

/// Arguments of `generate`.
#[derive(Debug, clap::Args)]
pub struct GenerateArgs {
    #[command(flatten)]
    task: TaskArgs,
    /// Write the code to this file [default: standard output, `-`], the second of two
    /// scalars in Rust beside it; its ending chooses the language (.rs, .h, .cuh). What `certify`
    /// compares the code with goes beside it into NAME.claim.json
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// The language of the code [default: that of the ending of -o, or rust]
    #[arg(long, value_name = "WORD", value_parser = word_parser::<Language>(), help_heading = CODE)]
    language: Option<Language>,
    /// Search, on from the programs of the plan beside the robot file if there is one, and keep
    /// what is found there: every later run, macro and build script replays it. Programs that are
    /// not cheaper leave the plan as it was
    #[arg(long, conflicts_with = "plan")]
    save_plan: bool,
}

pub(crate) fn run(args: &GenerateArgs, context: &Context) -> Outcome {
    let language = language(args);
    let known = language.as_ref();
    let scalars = known.map_or(&[][..], |language| language.scalars());
    let source = Source::open(context, &args.task.robot, &args.task.chain)?;
    if !source.is_model {
        say_notes(context, &source.robot);
    }
    let mut request = source.request(&args.task.options.0, scalars)?;
    request.language = *language.as_ref().unwrap_or(&Language::Rust);
    // Before the work, so that nothing is generated that cannot be written.
    let (targets, [claim_target, plan_target]) = targets(args, context, &source, &request)?;
    language?;
    let kept = request.plan.take_if(|_| args.save_plan);
    request.renewed.clone_from(&kept);
    let generated = source.generate(context, &mut request)?;
    let report = report(&source.robot, &request, &generated, Detail::Bounds);
    let mut files = Vec::new();
    let mut announced = None;
    if let Some(target) = plan_target {
        let kept = keep(&source.robot, &request, &generated, kept);
        for (function, scalar) in kept.functions {
            context.say(&format!(
                "the plan's program for `{function}` in {scalar} stays: the search ended early and found no cheaper one"
            ));
        }
        let is_first = !plan_file::path(&source.path).exists();
        announced = is_first.then(|| source.path.clone());
        files.push((target, kept.plan.write()));
    }
    if let Some(target) = claim_target {
        let claim = claim(&source.robot, &source.robot_file, &request, &generated);
        files.push((target, claim.map_err(Failure::input)?.write()));
    }
    let is_file = targets.iter().any(|target| target.file().is_some());
    let place = match args.output.as_deref().filter(|_| is_file) {
        Some(file) => relative(&source.path, file),
        // As if it were written beside the robot file.
        None => {
            let name = source.path.file_name().unwrap_or_default();
            name.to_string_lossy().into_owned()
        }
    };
    let code = generated.files(&request, &place, &source.text);
    files.extend(targets.into_iter().zip(code));
    let notes = files.iter().filter_map(|(target, _)| target.note());
    Ok(Done {
        notes: notes.collect(),
        is_aside: true,
        files,
        announced,
        ..Done::from(report)
    })
}

/// Returns where the code goes, its claim, unless the code goes into a device or a pipe, and the plan.
fn targets(
    args: &GenerateArgs,
    context: &Context,
    source: &Source,
    request: &Request,
) -> Result<(Vec<Target>, [Option<Target>; 2]), Failure> {
    let path = plan_file::path(&source.path);
    if args.save_plan && source.is_model {
        return Err(Failure::Input(format!(
            "error: --save-plan: a plan belongs to a robot file\n  = help: `dalembert import {0} -o {1}` \
             makes one",
            source.path.display(),
            source.path.with_extension("toml").display()
        )));
    }
    let mut inputs = vec![source.path.as_path()];
    if !args.save_plan && !source.is_model {
        // Even if it does not exist yet, because the next run would read it.
        inputs.push(&path);
    }
    let mut files = Files::new(context, &inputs);
    let code = code(args, &mut files, request)?;
    let file = code.first().and_then(Target::file);
    let beside = file.and(args.output.as_ref());
    let added = beside.map(|file| files.add(&file.with_extension("claim.json")));
    let claim = added.transpose()?;
    let plan = args.save_plan.then(|| files.add(&path)).transpose()?;
    Ok((code, [claim, plan]))
}

fn code(
    args: &GenerateArgs,
    files: &mut Files<'_>,
    request: &Request,
) -> Result<Vec<Target>, Failure> {
    let first = files.output(args.output.as_deref())?;
    let is_pair = request.language == Language::Rust && request.scalars.len() > 1;
    if !is_pair || request.is_scalar_open {
        return Ok(vec![first]);
    }
    let Some(path) = args.output.as_deref().filter(|_| first.file().is_some()) else {
        let why = "each scalar needs its own Rust file\n  = help: ask for one scalar, or give -o the \
             name of a file: the f32 code goes to one that ends in _f32";
        return Err(Failure::input(why));
    };
    let second = files.add(&beside(path, "_f32"))?;
    let target = |scalar: &ScalarType| match scalar {
        ScalarType::F64 => first.clone(),
        ScalarType::F32 => second.clone(),
    };
    Ok(request.scalars.iter().map(target).collect())
}

/// Returns the language of the code: that of the ending of `-o`, unless `--language` is given.
fn language(args: &GenerateArgs) -> Result<Language, Failure> {
    let path = args.output.as_deref();
    let Some(path) = path.filter(|path| path.extension().is_some()) else {
        return Ok(args.language.unwrap_or_default());
    };
    match (Language::of(path), args.language) {
        (Ok(language), asked) if asked.is_none_or(|asked| asked == language) => Ok(language),
        (Err(_), Some(asked)) => Ok(asked),
        (_, asked) => {
            // The error of a path without ending names them.
            let known = Language::of(Path::new("")).err().unwrap_or_default();
            Err(Failure::Input(format!(
                "error: `{}` does not end as a file of {} does\n  = help: the language follows from \
                 the ending: {known}",
                path.display(),
                asked.map_or("any language", Language::name),
            )))
        }
    }
}
