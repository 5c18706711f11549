//! What goes where, and what is there already.

use std::path::{Path, PathBuf};

use dalembert_codegen::workspace::plan_file;
use dalembert_codegen::{Language, Request, ScalarType};

use crate::args::GenerateArgs;
use crate::files::distinct::distinct;
use crate::files::target::Target;
use crate::files::write::write;
use crate::outcome::{Failure, Outcome};
use crate::output;

/// Where the code, the certificates and the plan go.
pub struct Files {
    /// One for each file.
    code: Vec<Target>,
    /// With a tolerance, unless the code goes into a device or a pipe.
    certificates: Option<Target>,
    /// If it is to be kept.
    plan: Option<Target>,
    /// The robot file of a plan that was not there before.
    first: Option<PathBuf>,
}

impl Files {
    /// Returns what the arguments say, looked at before the work.
    ///
    /// # Errors
    /// Something cannot be written, or would be written over something else.
    pub fn of(args: &GenerateArgs, request: &Request) -> Result<Files, Failure> {
        let code = code(args, request)?;
        let scene = request.scene.as_ref();
        let certified = scene.is_some_and(|scene| scene.tolerance.is_some());
        if args.certificate.is_some() && !certified {
            return Err(Failure::Input(
                "error: there is nothing to certify: --certificate is for a scene with a tolerance"
                    .into(),
            ));
        }
        let file = code.first().and_then(Target::file);
        let beside = file.and(args.output.as_ref());
        let beside = beside.map(|file| file.with_extension("certificate.json"));
        let certificates = args.certificate.clone().or(beside);
        let certificates = certificates.filter(|_| certified);
        let certificates = certificates.map(|file| Target::at(&file)).transpose()?;
        let path = plan_file::path(&args.robot);
        let plan = args.save_plan.then(|| Target::at(&path)).transpose()?;
        let first = (args.save_plan && !path.exists()).then(|| args.robot.clone());
        let files = Files {
            code,
            certificates,
            plan,
            first,
        };
        files.check(args, &path)?;
        if !args.force {
            let written = files.code.iter().chain(&files.certificates);
            written.into_iter().try_for_each(Target::ours)?;
        }
        Ok(files)
    }

    fn check(&self, args: &GenerateArgs, plan: &Path) -> Outcome {
        let mut inputs = vec![("the robot file", args.robot.as_path())];
        if self.plan.is_none() {
            // Whether it is there or not: the next run would read it.
            inputs.push(("the plan beside the robot file", plan));
        }
        let certificates = match args.certificate {
            Some(_) => "--certificate",
            None => "the certificate beside the code",
        };
        let code = self.code.iter().map(|target| ("--output", target));
        let others = [
            (certificates, self.certificates.as_ref()),
            ("--save-plan", self.plan.as_ref()),
        ];
        let others = others.into_iter().filter_map(|(w, t)| Some((w, t?)));
        let outputs: Vec<_> = code.chain(others).collect();
        distinct(&inputs, &outputs)?;
        outputs.iter().try_for_each(|(_, target)| target.check())
    }

    /// Returns `true` if the code goes into a file.
    pub fn has_file(&self) -> bool {
        self.code.iter().any(|target| target.file().is_some())
    }

    /// Writes all of it, or nothing.
    pub fn write(
        &self,
        code: &[String],
        certificates: Option<&str>,
        plan: Option<&str>,
    ) -> Outcome {
        let all = [
            (self.plan.as_ref(), plan),
            (self.certificates.as_ref(), certificates),
        ];
        let mut outputs = Vec::new();
        for (target, text) in all {
            outputs.extend(target.zip(text));
        }
        outputs.extend(self.code.iter().zip(code.iter().map(String::as_str)));
        write(&outputs)?;
        if let Some(robot) = &self.first
            && let Err(error) = plan_file::announce(robot)
        {
            let name = robot.display();
            output::note(&format!(
                "\nwarning: {name} cannot be given a new time ({error}): macros and build scripts \
                 that were built without the plan notice it once the robot file is saved again"
            ));
        }
        for (target, _) in outputs {
            let name = target.name.display();
            match self
                .plan
                .as_ref()
                .is_some_and(|plan| std::ptr::eq(plan, target))
            {
                true => output::note(&format!("\nkept the programs in {name}")),
                false if target.file().is_some() => output::note(&format!("\nwrote {name}")),
                false => {}
            }
        }
        Ok(())
    }
}

/// Returns where the code goes: the second of two scalars in Rust beside the first.
fn code(args: &GenerateArgs, request: &Request) -> Result<Vec<Target>, Failure> {
    let first = Target::output(args.output.as_deref(), args.json)?;
    let is_pair = request.language == Language::Rust && request.scalars.len() > 1;
    if !is_pair || request.cheapest_scalar {
        return Ok(vec![first]);
    }
    let Some(path) = args.output.as_deref().filter(|_| first.file().is_some()) else {
        return Err(Failure::Input(
            "error: each scalar has a file of its own in Rust\n  = help: ask for one scalar, or give -o the \
             name of a file: the f32 code goes to one that ends in _f32"
                .into(),
        ));
    };
    let target = |scalar: &ScalarType| match scalar {
        ScalarType::F64 => Target::at(path),
        ScalarType::F32 => Target::at(&second(path)),
    };
    request.scalars.iter().map(target).collect()
}

/// Returns the file of the second of two scalars: `arm_f32.rs` beside `arm.rs`.
fn second(path: &Path) -> PathBuf {
    let base = path.file_stem().unwrap_or_default().to_string_lossy();
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{base}_f32.{ending}"))
}
