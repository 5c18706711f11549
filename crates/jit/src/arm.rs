//! An arm: its functions by name, compiled in memory.

use std::path::Path;

use dalembert_codegen::workspace::{
    self, Argument, Code, Parameter, Quantity, Setup, Sizes, parse,
};
use dalembert_codegen::{
    Counts, Function as Output, Language, Plan, Request, ScalarType, generate, unreadable,
};
use dalembert_import::{OpenError, Text, is_model, open_text};
use dalembert_model::number::{Exact, Rounded};
use dalembert_model::outputs::RuntimeParameter;
use dalembert_model::robot::Robot;
use dalembert_stamp::{Comment, Stamp};

use crate::cache::{self, CachedFunction, Entry, Folder};
use crate::compile::Signature;
use crate::error::Error;
use crate::make::{make_entry, read_robot};
use crate::native::Native;
use crate::request::Load;

/// A function of an arm.
pub struct Function {
    output: Output,
    sizes: Sizes,
    proved: CachedFunction,
    native: Native,
}

impl Function {
    /// Returns its name.
    pub fn name(&self) -> &'static str {
        self.output.name()
    }

    /// Returns which output it is: its results, their shapes and units.
    pub fn output(&self) -> Output {
        self.output
    }

    /// Returns the scalar that it computes in.
    pub fn scalar(&self) -> ScalarType {
        self.native.program().scalar
    }

    /// Returns the sizes from which the lengths of its results follow.
    pub fn sizes(&self) -> Sizes {
        self.sizes
    }

    /// Returns its operations.
    pub fn counts(&self) -> Counts {
        self.native.program().counts()
    }

    /// Returns its proof, in a sentence.
    pub fn proof(&self) -> &str {
        &self.proved.proof
    }

    /// Returns the machine code.
    pub fn native(&self) -> &Native {
        &self.native
    }
}

/// An arm: its functions as machine code.
pub struct Arm {
    source: String,
    robot: Robot,
    floats: bool,
    entry: Entry,
    functions: Vec<Function>,
    load: Load,
    is_from_cache: bool,
}

impl Arm {
    /// Loads the arm of a robot file, a URDF or an MJCF with what it includes.
    ///
    /// # Errors
    /// [`Error`]: what is wrong with the file or the request, or what could not be proved.
    pub fn load(path: impl AsRef<Path>, load: &Load) -> Result<Arm, Error> {
        let path = path.as_ref();
        let source = open_text(path).map_err(|error| match error {
            OpenError::System(error) => {
                let shown = path.display().to_string();
                Error::from(unreadable(path, &shown, &error))
            }
            OpenError::Wrong(errors) => errors.into(),
        })?;
        let plan = match is_model(source.as_str().as_bytes()) {
            true => None,
            false => workspace::plan_file::beside(path)?,
        };
        Arm::of(&source, plan, load)
    }

    /// Loads the arm of a robot file's text, or of a URDF's; messages call it by a name. The
    /// programs of a [`plan`](Arm::plan) are proved, and not searched for.
    ///
    /// # Errors
    /// As [`Arm::load`].
    pub fn parse(source: &str, name: &str, plan: Option<&str>, load: &Load) -> Result<Arm, Error> {
        let plan = plan.map(Plan::parse).transpose();
        let plan = plan.map_err(|error| error.within(name))?;
        Arm::of(&Text::of(name, source.to_owned()), plan, load)
    }

    fn of(source: &Text, plan: Option<Plan>, load: &Load) -> Result<Arm, Error> {
        let (folder, note) = match Folder::of(&load.cache) {
            Ok(folder) => (folder, None),
            Err(note) => (None, Some(note)),
        };
        let plan_text = plan.as_ref().map(Plan::write);
        let text = source.as_str();
        let key = cache::key(text, source.name(), plan_text.as_deref(), load);
        let kept = folder.as_ref().and_then(|folder| folder.entry(&key));
        // A kept entry that is damaged, or of a version that reads otherwise, is made anew.
        let again = |entry| Arm::of_entry(entry, text, load, true).ok();
        if let Some(arm) = kept.and_then(again) {
            return Ok(arm);
        }
        let mut entry = make_entry(source, plan, load, folder.as_ref())?;
        entry.notes.extend(note);
        if let Some(folder) = &folder
            && !entry.ended
        {
            folder.keep(&key, &entry);
        }
        Arm::of_entry(entry, text, load, false)
    }

    fn of_entry(
        entry: Entry,
        source: &str,
        load: &Load,
        is_from_cache: bool,
    ) -> Result<Arm, Error> {
        let reading = read_robot(&entry.robot, "the arm's robot file")?;
        let scene = load.request(&reading)?.scene;
        let base = match scene {
            Some(scene) => scene.base_coordinates(&reading.robot),
            None => reading.robot.base_coordinates(),
        };
        let compile = |proved| compiled(&entry, proved);
        let functions = entry.functions.iter().map(compile);
        Ok(Arm {
            robot: reading.robot,
            floats: base > 0,
            source: source.to_owned(),
            functions: functions.collect::<Result<_, _>>()?,
            entry,
            load: load.clone(),
            is_from_cache,
        })
    }

    /// Returns the robot.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// Returns true if its base floats, and the scene does not lock it: then velocities, accelerations
    /// and torques begin with six entries of the base.
    pub fn floats(&self) -> bool {
        self.floats
    }

    /// Returns the text that it was loaded from, a robot file's or a URDF's.
    pub fn source(&self) -> &str {
        &self.source
    }

    /// Returns the functions, scalar by scalar.
    pub fn functions(&self) -> &[Function] {
        &self.functions
    }

    /// Returns the function of a name in a scalar.
    pub fn function(&self, name: &str, scalar: ScalarType) -> Option<&Function> {
        let mut functions = self.functions.iter();
        functions.find(|function| function.name() == name && function.scalar() == scalar)
    }

    /// Returns the functions as Rust: the text of a file for each scalar, without its stamp.
    pub fn rust(&self) -> &[String] {
        &self.entry.rust
    }

    /// Returns the files that the command writes beside the robot file, called after the robot: for
    /// each scalar what the file's name ends in, `_f32` of the second or nothing, and its text.
    ///
    /// # Errors
    /// [`Error`]: what is kept is damaged.
    pub fn files(&self) -> Result<Vec<(&'static str, String)>, Error> {
        let reading = read_robot(&self.entry.robot, "the arm's robot file")?;
        let request = self.load.request(&reading)?;
        let mut scalars: Vec<ScalarType> = self.functions.iter().map(Function::scalar).collect();
        scalars.dedup();
        let file = |(scalar, text): (&ScalarType, &String)| {
            let is_second = scalars.len() > 1 && *scalar == ScalarType::F32;
            let asked = Request {
                scalars: vec![*scalar],
                ..request.clone()
            };
            let stamp = Stamp {
                version: env!("CARGO_PKG_VERSION").to_owned(),
                robot: format!("{}.toml", self.robot.name),
                robot_hash: dalembert_stamp::hash(&self.entry.robot),
                chain: Vec::new(),
                asked: asked.asked(),
            };
            let suffix = if is_second { "_f32" } else { "" };
            (suffix, stamp.write(Comment::Line, text))
        };
        Ok(scalars.iter().zip(&self.entry.rust).map(file).collect())
    }

    /// Prints the functions as one header of C99, proved once more; returns it with its claim and
    /// further warnings than [`notes`](Arm::notes). Names begin with `name`, or with the robot's.
    ///
    /// # Errors
    /// [`Error`]: among others, a name that no C compiler takes.
    pub fn c(&self, name: Option<String>) -> Result<(String, String, Vec<String>), Error> {
        let reading = read_robot(&self.entry.robot, "the arm's robot file")?;
        let mut request = self.load.request(&reading)?;
        request.language = Language::C;
        request.module = name;
        request.plan = Plan::parse(&self.entry.plan).ok();
        let mut generated = generate(&reading.robot, &request)?;
        let claim = workspace::claim(&reading.robot, self.robot_file(), &request, &generated)?;
        let is_new = |warning: &String| !self.notes().contains(warning);
        generated.warnings.retain(is_new);
        let text = generated.texts.concat();
        Ok((text, claim.write(), generated.warnings))
    }

    /// Returns the robot as a robot file.
    pub fn robot_file(&self) -> &str {
        &self.entry.robot
    }

    /// Returns the plan: the programs that were found, to be kept beside the robot file.
    pub fn plan(&self) -> &str {
        &self.entry.plan
    }

    /// Returns the claim about the functions, as JSON: the document that stands beside the file of
    /// [`files`](Arm::files), under its name and with the ending `claim.json`.
    pub fn claim(&self) -> &str {
        &self.entry.claim
    }

    /// Returns the parameters of every link in its own frame, by name, as in `full_regressor`.
    ///
    /// # Errors
    /// [`Error`]: what is kept is damaged.
    pub fn parameters(&self) -> Result<Vec<(String, f64)>, Error> {
        let values = self.setup()?.arm(Exact::clone).parameters();
        let names = Parameter::of_bodies(&self.robot).map(|parameter| parameter.to_string());
        Ok(names.zip(values.iter().map(f64::nearest)).collect())
    }

    /// Returns the robot file's numbers in the place of the arguments of `load`, by their names: of
    /// `bodies` ten numbers a link of [`body_links`](Arm::body_links).
    ///
    /// # Errors
    /// [`Error`]: what is kept is damaged.
    pub fn loading(&self) -> Result<Vec<(&'static str, Vec<f64>)>, Error> {
        let setup = self.setup()?;
        let mut taken = RuntimeParameter::LOADING.to_vec();
        taken.retain(|parameter| setup.has(*parameter));
        let named = |parameter: RuntimeParameter| (parameter.name(), setup.file_values(parameter));
        Ok(taken.into_iter().map(named).collect())
    }

    /// Returns which numbers of the bodies stay zero; none if any may be another.
    ///
    /// # Errors
    /// As of [`Arm::loading`].
    pub fn kept_zeros(&self) -> Result<Vec<bool>, Error> {
        Ok(self.setup()?.zeros().to_vec())
    }

    /// Returns the links whose bodies are arguments, from one; a base that floats is zero.
    ///
    /// # Errors
    /// As of [`Arm::loading`].
    pub fn body_links(&self) -> Result<Vec<usize>, Error> {
        Ok(self.setup()?.body_links())
    }

    /// Returns the base parameters by their combinations, a column of `regressor` each.
    ///
    /// # Errors
    /// [`Error`]: among others, that there are none.
    pub fn base_parameters(&self) -> Result<Vec<(String, f64)>, Error> {
        let setup = self.setup()?;
        let base = setup.base(Quantity::BaseRegressor).map_err(Clone::clone)?;
        let values = base.values(&setup.arm(Exact::clone));
        let names = base.names().into_iter();
        Ok(names.zip(values.iter().map(f64::nearest)).collect())
    }

    /// Returns the joints of each limb of a base that floats, in the order in which `inertia_blocks` has
    /// them; empty on a fixed base.
    ///
    /// # Errors
    /// [`Error`]: the robot in its scene cannot be read again.
    pub fn limbs(&self) -> Result<Vec<Vec<usize>>, Error> {
        Ok(self.setup()?.limbs())
    }

    fn setup(&self) -> Result<Setup, Error> {
        let reading = read_robot(&self.entry.robot, "the arm's robot file")?;
        let request = self.load.request(&reading)?;
        let setup = Setup::in_scene(&reading.robot, request.scene.as_ref())?
            .taking(&request.parameters)
            .taking_bodies(&request.bodies, request.keeps_zeros);
        Ok(setup?)
    }

    /// Returns the notes about the robot and its functions.
    pub fn notes(&self) -> &[String] {
        &self.entry.notes
    }

    /// Tells whether nothing was searched for and proved, since it was kept.
    pub fn is_from_cache(&self) -> bool {
        self.is_from_cache
    }

    /// Tells whether the observer ended the search: a whole one might find cheaper functions.
    pub fn has_ended_early(&self) -> bool {
        self.entry.ended
    }
}

fn compiled(entry: &Entry, proved: &CachedFunction) -> Result<Function, Error> {
    let damaged = || Error::input(format!("`{}` cannot be read back", proved.function));
    let output = match proved.function == Output::Load.name() {
        true => Output::Load,
        false => Output::parse(&proved.function).map_err(|_| damaged())?,
    };
    let scalar = parse::<ScalarType>(&proved.scalar).map_err(|_| damaged())?;
    let text = entry.rust.get(proved.file).ok_or_else(damaged)?;
    let sizes = proved.sizes();
    let mut arguments = Vec::new();
    for name in &proved.arguments {
        arguments.push(Argument::from_name(name).ok_or_else(damaged)?);
    }
    let form = workspace::Signature {
        function: output,
        arguments: &arguments,
        sizes,
        scalar,
    };
    let program = Code::parse(text, &form).map_err(|_| damaged())?;
    let length = |argument: &Argument| (*argument, argument.length(sizes));
    let signature = Signature {
        arguments: arguments.iter().map(length).collect(),
        results: output.quantities().iter().map(|q| q.len(sizes)).collect(),
    };
    let native = Native::compile(program, signature)
        .map_err(|error| Error::Function(output.name(), Box::new(error)))?;
    Ok(Function {
        output,
        sizes,
        proved: proved.clone(),
        native,
    })
}
