//! Where proofs evaluate: primes and points drawn from what is to be proved.
//!
//! Everything that decides whether a statement is true (robot, scene,
//! programs) goes into a [`Transcript`], and its SHA-256 is the seed of a
//! [`Challenge`]: who changes a digit of the statement gets other primes and
//! other points. The same statement gets the same ones on every machine.
//!
//! Every proof of this crate draws here, with a purpose of its own; the
//! search's fingerprints do not.

use hmac_sha256::Hash;

use dalembert_model::equations::SinCosPair;
use dalembert_model::number::{Angle, Exact, Rational};
use dalembert_model::outputs::RuntimeParameter;
use dalembert_model::robot::write as write_robot;
use dalembert_model::scalar::prime::Prime;
use dalembert_model::scalar::residue::Residue;
use dalembert_model::scene::write as write_scene;

use crate::program::{Input, Operand, Program};
use crate::scene::SceneRobot;

/// The first text of every hash of this crate's proofs; another way to draw is another version.
const DOMAIN: &str = "dalembert proof 1";

/// Numbers to try before a prime is given up: one in 22 is prime.
const MAX_TRIES: u64 = 1 << 14;

/// A statement, written so that two of them never have the same bytes: every
/// text goes in behind its length, every list behind the number of its items.
pub(crate) struct Transcript(Hash);

impl Transcript {
    /// Returns an empty statement with a purpose.
    pub(crate) fn new(purpose: &str) -> Transcript {
        let mut transcript = Transcript(Hash::new());
        transcript.text(DOMAIN);
        transcript.text(purpose);
        transcript
    }

    /// Adds a number.
    pub(crate) fn number(&mut self, x: usize) {
        self.0.update((x as u64).to_le_bytes());
    }

    /// Adds a text.
    pub(crate) fn text(&mut self, text: &str) {
        self.number(text.len());
        self.0.update(text.as_bytes());
    }

    fn numbers(&mut self, list: &[usize]) {
        self.number(list.len());
        list.iter().for_each(|&x| self.number(x));
    }

    /// Adds the robot with its payload and gravity, what is locked, the results.
    pub(crate) fn scene_robot(&mut self, scene_robot: &SceneRobot) {
        self.text(&write_robot(scene_robot.robot()));
        self.text(&scene_robot.scene().map(write_scene).unwrap_or_default());
        self.numbers(scene_robot.rows());
        // Of settings without any nothing is added: their points stay.
        for parameter in RuntimeParameter::ALL {
            if scene_robot.has(parameter) {
                self.text("argument");
                self.text(parameter.name());
            }
        }
    }

    /// Adds a program with its exact constants.
    pub(crate) fn program(&mut self, program: &Program) {
        self.text(&program.function.text());
        self.number(program.joints);
        self.numbers(&program.rows);
        self.number(program.arguments.len());
        for argument in &program.arguments {
            self.text(argument.name());
        }
        // Of programs without any nothing is added: their points stay.
        for speed in &program.speeds {
            self.text("speed");
            self.number(speed.joint);
            self.text(&speed.square.to_string());
        }
        self.number(program.steps.len());
        for step in &program.steps {
            self.text(step.operation.symbol().encode_utf8(&mut [0; 4]));
            self.operand(&step.left);
            self.operand(&step.right);
        }
        self.number(program.outputs.len());
        for output in &program.outputs {
            self.number(usize::from(output.negative));
            self.operand(&output.value);
        }
    }

    fn operand(&mut self, operand: &Operand) {
        match operand {
            Operand::Input(input) => {
                self.text("input");
                self.input(*input);
            }
            Operand::Constant(constant) => {
                self.text("constant");
                self.text(&constant.to_string());
            }
            Operand::Step(index) => {
                self.text("step");
                self.number(*index);
            }
        }
    }

    fn input(&mut self, input: Input) {
        match input {
            Input::Sin(angle) => self.text(&format!("sin {angle}")),
            Input::Cos(angle) => self.text(&format!("cos {angle}")),
            Input::PerSpeed(joint) => {
                self.text("per speed");
                self.number(joint);
            }
            Input::Entry(argument, joint) => {
                self.text(argument.noun());
                self.number(joint);
            }
        }
    }

    /// Ends the statement; its hash decides the points of evaluation.
    pub(crate) fn seal(self) -> Challenge {
        Challenge(self.0.finalize())
    }
}

/// The seed of primes and points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Challenge([u8; 32]);

impl Challenge {
    /// Returns a prime with its point, the same for the same index; `None` if there is
    /// no prime among [`MAX_TRIES`] numbers, which never happens.
    pub(crate) fn draw(&self, index: usize) -> Option<Point> {
        let words = (0..MAX_TRIES / 4).flat_map(|counter| self.words(index, "prime", "", counter));
        // From 2⁶² to 2⁶³, and 3 modulo 4, where −1 is no square.
        let mut odd = words.map(|word| (word >> 2) | (1 << 62) | 3);
        let prime = odd.find_map(Prime::new)?;
        let seed = *self;
        let state = 0;
        Some(Point {
            seed,
            index,
            prime,
            state,
        })
    }

    /// Words of the stream of a value: its kind and name, block after block.
    fn words(&self, index: usize, kind: &str, name: &str, block: u64) -> [u64; 4] {
        let mut transcript = Transcript(Hash::new());
        transcript.0.update(self.0);
        transcript.number(index);
        transcript.text(kind);
        transcript.text(name);
        transcript.0.update(block.to_le_bytes());
        let hash = transcript.0.finalize();
        std::array::from_fn(|i| {
            let bytes = hash[8 * i..8 * i + 8].iter().rev();
            bytes.fold(0, |word, &byte| (word << 8) | u64::from(byte))
        })
    }
}

/// A prime, and a residue for every input and every constant angle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point {
    seed: Challenge,
    index: usize,
    prime: Prime,
    /// Which of the states modulo this prime.
    state: usize,
}

impl Point {
    /// Returns the prime.
    pub(crate) fn prime(&self) -> Prime {
        self.prime
    }

    /// Returns another state, with the same prime and the same constants.
    pub(crate) fn with_state(self, state: usize) -> Point {
        Point { state, ..self }
    }

    /// Returns a residue, each equally likely.
    fn residue(&self, kind: &str, name: &str) -> u64 {
        let below = |block| {
            let words = self.seed.words(self.index, kind, name, block);
            // At least every second one is below the prime.
            let mut words = words.into_iter().map(|word| word >> 1);
            words.find(|&word| word < self.prime.modulus())
        };
        (0..MAX_TRIES).find_map(below).unwrap_or_default()
    }

    fn circle(&self, kind: &str, name: &str) -> SinCosPair<Residue> {
        Residue::circle_point(self.prime, self.residue(kind, name))
    }

    /// Returns the value of an input.
    pub(crate) fn input(&self, input: Input) -> Residue {
        let free = |kind: &str, joint: usize| {
            Residue::new(self.prime, self.residue(kind, &self.name(joint)))
        };
        match input {
            Input::Sin(angle) => angle.pair(|joint| self.joint(joint)).sin,
            Input::Cos(angle) => angle.pair(|joint| self.joint(joint)).cos,
            Input::PerSpeed(joint) => free("per speed", joint),
            Input::Entry(argument, joint) => free(argument.noun(), joint),
        }
    }

    fn joint(&self, joint: usize) -> SinCosPair<Residue> {
        self.circle("joint", &self.name(joint))
    }

    /// Returns what tells an entry of a state from those of others.
    fn name(&self, entry: usize) -> String {
        match self.state {
            0 => entry.to_string(),
            state => format!("{entry} of state {state}"),
        }
    }

    /// Returns the value of a constant; `None` if the prime divides a denominator or a
    /// coefficient that is not zero: it is unfit then.
    pub(crate) fn constant(&self, value: &Exact) -> Option<Residue> {
        value.map(
            &mut |x: &Rational| Residue::of_rational(self.prime, x),
            &mut |angle| match angle {
                Angle::PiTimes(x) => self.circle("multiple of pi", &x.to_string()),
                Angle::Radians(x) => self.circle("radians", &x.to_string()),
            },
        )
    }
}
