//! A robot file with more tables, and what is asked of it in the words of the macro: a row of a
//! table of tests.

use std::path::Path;

use dalembert_codegen::workspace::{JointState, Runtime};
use dalembert_codegen::{Generated, Plan, Request, ScalarType, generate};
use dalembert_model::read::{self, Reading};
use dalembert_model::robot::Robot;
use serde_json::Value;

/// Where robot files are.
const FOLDERS: [&str; 4] = [
    "../generated/robots",
    "tests/data",
    "../model/tests/data",
    "../gallery/robots",
];

/// A robot with its scenes, and a request.
pub struct Case {
    pub reading: Reading,
    pub request: Request,
}

impl Case {
    /// Reads a robot file by its name, with more at its end, and what is asked.
    pub fn new(name: &str, more: &str, asked: &str) -> Case {
        Case::of(&Case::source(name, more), asked)
    }

    /// Returns the text of a robot file, with more at its end; `frames/NAME` is a robot with the
    /// frames of the files that it is compared with.
    pub fn source(name: &str, more: &str) -> String {
        if let Some(name) = name.strip_prefix("frames/") {
            return with_frames_and(name, more);
        }
        let folders = FOLDERS.iter();
        let folders = folders.map(|folder| Path::new(env!("CARGO_MANIFEST_DIR")).join(folder));
        let mut files = folders.map(|folder| folder.join(format!("{name}.toml")));
        let file = files.find(|file| file.exists());
        let file = file.unwrap_or_else(|| panic!("there is no {name}.toml"));
        std::fs::read_to_string(file).unwrap() + more
    }

    /// Reads the text of a robot file, and what is asked.
    pub fn of(source: &str, asked: &str) -> Case {
        let reading = read::parse(source, &read::Options::default());
        let reading = reading.unwrap_or_else(|errors| panic!("{errors}"));
        let words = asked
            .parse()
            .unwrap_or_else(|error| panic!("{asked}: {error:?}"));
        let request = Request::parse(&words, &ScalarType::ALL, &[], &reading.scenes);
        let request = request.unwrap_or_else(|problems| panic!("{asked}: {problems:?}"));
        Case { reading, request }
    }

    pub fn robot(&self) -> &Robot {
        &self.reading.robot
    }

    /// Generates what is asked.
    pub fn generated(&self) -> Generated {
        generate(self.robot(), &self.request).unwrap_or_else(|error| panic!("{error}"))
    }

    /// Generates what is asked by a plan.
    pub fn by(&self, plan: &Plan) -> Generated {
        let request = Request {
            plan: Some(plan.clone()),
            ..self.request.clone()
        };
        generate(self.robot(), &request).unwrap_or_else(|error| panic!("{error}"))
    }

    /// Returns what is said of what cannot be had.
    pub fn refusal(&self) -> String {
        match generate(self.robot(), &self.request) {
            Ok(_) => panic!("generated"),
            Err(error) => error.to_string(),
        }
    }

    /// Returns the runtime of the robot in its scene, and states of it. Where there is Coulomb
    /// friction it has its full force at some, is within its width at others, and at rest.
    pub fn runtime(&self, count: usize, seed: u64) -> (Runtime, Vec<JointState>) {
        let setup = self.request.setup(self.robot()).unwrap();
        let mut states = setup.states(count, seed);
        if self.robot().joints.iter().any(|joint| joint.has_coulomb()) {
            slowed(&mut states);
        }
        (Runtime::in_scene(setup), states)
    }

    /// Holds the code, which was proved and read back, in its scalars against the runtime of the
    /// robot in its scene at so many states.
    #[track_caller]
    pub fn rounds_well(&self, count: usize, what: &str) -> Generated {
        let generated = self.generated();
        let (runtime, states) = self.runtime(count, 11);
        assert!(!generated.emitted.is_empty(), "{what}");
        super::rounds_well(&generated.emitted, &runtime, &states, what);
        generated
    }
}

/// Returns the file of what others give at the frames of a robot.
pub fn frames(name: &str) -> Value {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/frames");
    let text = std::fs::read_to_string(folder.join(format!("{name}.json"))).unwrap();
    serde_json::from_str(&text).unwrap()
}

/// Returns the tables of a file's frames.
fn tables(frames: &Value) -> String {
    let keys = ["name", "link", "xyz", "rpy"];
    let table = |frame: &Value| {
        let lines = keys.map(|key| format!("{key} = {}\n", frame[key]));
        format!("\n[[frame]]\n{}", lines.concat())
    };
    frames.as_array().unwrap().iter().map(table).collect()
}

/// Returns the file of such a robot, with more at its end.
fn with_frames_and(name: &str, more: &str) -> String {
    let source = super::source(name, "");
    let rows = source.split("\n[scene").next().unwrap();
    rows.to_owned() + &tables(&frames(name)["frames"]) + more
}

/// Slows most of some states down, to within the width of Coulomb friction and to rest.
pub fn slowed(states: &mut [JointState]) {
    for (index, state) in states.iter_mut().enumerate() {
        let factor = [1.0, 1e-2, 1e-4, 0.0][index % 4];
        state.qd.iter_mut().for_each(|qd| *qd *= factor);
    }
}
