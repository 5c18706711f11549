//! What goes where, and what is there already.

use std::path::{Path, PathBuf};

use dalembert_codegen::workspace::plan;
use dalembert_codegen::workspace::task::Request;

use crate::args::GenerateArgs;
use crate::files::distinct::distinct;
use crate::files::target::Target;
use crate::files::write::write;
use crate::outcome::{Failure, Outcome};
use crate::{input, output};

/// Where the code, the certificates and the plan go.
pub struct Files {
    /// Unless a report is what was asked for.
    code: Option<Target>,
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
        let code = Some(Target::output(args.output.as_deref(), args.json)?);
        let scene = request.scene.as_ref();
        let certified = scene.is_some_and(|scene| scene.tolerance.is_some());
        if args.certificate.is_some() && !certified {
            return Err(Failure::Input(
                "error: there is nothing to certify: --certificate is for a scene with a tolerance"
                    .into(),
            ));
        }
        let file = code.as_ref().and_then(Target::file);
        let beside = file.and(args.output.as_ref());
        let beside = beside.map(|file| file.with_extension("certificate.json"));
        let certificates = args.certificate.clone().or(beside);
        let certificates = certificates.filter(|_| certified);
        let certificates = certificates.map(|file| Target::at(&file)).transpose()?;
        let path = plan::file::path(&args.robot);
        let plan = args.save_plan.then(|| Target::at(&path)).transpose()?;
        let first = (args.save_plan && !path.exists()).then(|| args.robot.clone());
        let files = Files {
            code,
            certificates,
            plan,
            first,
        };
        match args.check {
            true => files.comparable()?,
            false => {
                files.check(args, &path)?;
                if !args.force {
                    let written = [&files.code, &files.certificates];
                    written.into_iter().flatten().try_for_each(Target::ours)?;
                }
            }
        }
        Ok(files)
    }

    fn comparable(&self) -> Outcome {
        match &self.code {
            Some(code) if code.file().is_none() => Err(Failure::Input(format!(
                "error: `{}` is no file that --check could compare",
                code.name.display()
            ))),
            _ => Ok(()),
        }
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
        let outputs = [
            ("--output", self.code.as_ref()),
            (certificates, self.certificates.as_ref()),
            ("--save-plan", self.plan.as_ref()),
        ];
        let outputs = outputs.into_iter();
        let outputs: Vec<_> = outputs.filter_map(|(w, t)| Some((w, t?))).collect();
        distinct(&inputs, &outputs)?;
        outputs.iter().try_for_each(|(_, target)| target.check())
    }

    /// Writes all of it, or nothing.
    pub fn write(&self, code: &str, certificates: Option<&str>, plan: Option<&str>) -> Outcome {
        let all = [
            (self.plan.as_ref(), plan),
            (self.certificates.as_ref(), certificates),
            (self.code.as_ref(), Some(code)),
        ];
        let mut outputs = Vec::new();
        for (target, text) in all {
            outputs.extend(target.zip(text));
        }
        write(&outputs)?;
        if let Some(robot) = &self.first
            && let Err(error) = plan::file::announce(robot)
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

    /// Compares instead of writing.
    pub fn compare(&self, code: &str, certificates: Option<&str>) -> Outcome {
        if let Some((target, text)) = self.certificates.as_ref().zip(certificates) {
            compare(target, text)?;
        }
        self.code
            .as_ref()
            .map_or(Ok(()), |file| compare(file, code))
    }
}

fn compare(target: &Target, text: &str) -> Outcome {
    let name = target.name.display();
    let fail = |why: String| Failure::Check(format!("\nerror: {name} cannot be compared: {why}"));
    let Some(file) = target.file() else {
        return Err(fail("it is no file".into()));
    };
    // One more byte than wanted is a difference.
    let bytes = input::first(file, text.len() as u64 + 1);
    let bytes = bytes.map_err(|error| fail(error.to_string()))?;
    if bytes == text.as_bytes() {
        output::note(&format!("\n{name} is up to date"));
        return Ok(());
    }
    let line = first_difference(&bytes, text);
    Err(Failure::Check(format!(
        "\nerror: {name}:{line}: the file is not what would be generated; run without --check to write it"
    )))
}

/// Returns the first line, from one, in which a file differs from a text.
fn first_difference(bytes: &[u8], text: &str) -> usize {
    let same = bytes
        .iter()
        .zip(text.as_bytes())
        .take_while(|(a, b)| a == b)
        .filter(|(byte, _)| **byte == b'\n');
    same.count() + 1
}
