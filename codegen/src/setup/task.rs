//! A function of a robot in its scene: its formula in any scalar, with the arm and the motion that
//! it takes, and its program.

use dalembert_model::equations::load::{BODY, LoadArguments, carried};
use dalembert_model::equations::matrix::{Columns, opposite, transposed};
use dalembert_model::equations::regressor::Column;
use dalembert_model::equations::{Arm, DhVariables, Formulation, Link, exact_pose};
use dalembert_model::number::{Exact, Rounded};
use dalembert_model::outputs::{Motion, RuntimeParameter, Sizes, Written};
use dalembert_model::scalar::{Divide, Scalar};

use super::Setup;
use crate::dag::{Dag, Leaves};
use crate::function::{Argument, Function, Quantity};
use crate::program::{Input, Literal, Program, ScalarType};

/// A function of a robot in its scene.
#[derive(Clone, Copy, Debug)]
pub struct Task<'a> {
    pub setup: &'a Setup,
    pub function: Function,
}

/// The arm and motion that a formula is evaluated with.
#[derive(Clone, Debug)]
pub struct TaskArm<'a, S> {
    task: Task<'a>,
    /// The arm: gravity, bodies and drives as the arguments say, and the payload on the last link, where
    /// the function takes them.
    pub arm: Arm<S>,
    pub motion: Motion<S>,
    /// The columns of the regressor.
    pub columns: Vec<Column<S>>,
    /// The rows that results are over before the scene's are selected: with a payload
    /// one more, behind the last, which does not move.
    rows: Vec<usize>,
}

impl<'a> Task<'a> {
    /// Creates the program of a graph of the function.
    pub fn program(&self, graph: &Dag) -> Program {
        let Task { setup, function } = *self;
        let empty = Program {
            rows: setup.rows().to_vec(),
            arguments: setup.arguments(function),
            load: setup.sizes(function).load,
            bodies: setup.sizes(function).bodies,
            speeds: setup.speeds(),
            ..Program::empty(function, Sizes::of(setup.robot()))
        };
        empty.with_graph(graph)
    }

    /// Evaluates the function by a textbook's formula, in the scalar of the leaves, over the whole
    /// arm: a locked joint has a constant pair or position, and rates that are zero. Returns the
    /// results over the scene's rows, flat.
    pub fn textbook<L: Leaves>(&self, by: Formulation, leaves: &L) -> Vec<L::Value> {
        self.posed(leaves).results(by)
    }

    /// Returns the scene's arm and its motion as the function takes them.
    pub fn posed<L: Leaves>(&self, leaves: &L) -> TaskArm<'a, L::Value> {
        self.posed_arm(self.setup.arm(|constant| leaves.constant(constant)), leaves)
    }

    /// Returns the arm and its motion as the function takes them, from the scene's arm in the scalar.
    pub fn posed_arm<L: Leaves>(&self, arm: Arm<L::Value>, leaves: &L) -> TaskArm<'a, L::Value> {
        let constant = |constant: &Exact| leaves.constant(constant);
        let columns = self.setup.columns(self.function, constant);
        self.posed_over(arm, leaves, columns)
    }

    pub(super) fn posed_over<L: Leaves>(
        &self,
        mut arm: Arm<L::Value>,
        leaves: &L,
        columns: Vec<Column<L::Value>>,
    ) -> TaskArm<'a, L::Value> {
        let Task { setup, function } = *self;
        let input = |input| leaves.input(input);
        let constant = |constant: &Exact| leaves.constant(constant);
        let mut motion = setup.motion(input, constant);
        if setup.takes_load(function) {
            setup.drive(&mut arm, input);
        }
        arm = arm.at_speeds(&motion.per_speed);
        let mut rows: Vec<usize> = (0..arm.links.len()).collect();
        if setup.takes(function, RuntimeParameter::Gravity) {
            let entry = |axis| input(Input::Entry(Argument::Gravity, axis));
            arm = arm.with_gravity(&[0, 1, 2].map(entry));
        }
        if function == Function::Load {
            motion.loading = Some(setup.loading(input, constant));
        } else if setup.takes_load(function) {
            for (row, body) in setup.bodies.iter().zip(setup.given_bodies(input, constant)) {
                let link = &mut arm.links[*row];
                (link.mass, link.com, link.inertia) = (body.mass, body.com, body.inertia);
            }
            if let Some(body) = setup.given_payload(input, constant) {
                arm.links.push(body);
                motion = motion.with_still_link();
                rows.push(rows.len());
            }
        }
        TaskArm {
            task: *self,
            arm,
            motion,
            columns,
            rows,
        }
    }
}

impl Setup {
    pub fn task(&self, function: Function) -> Task<'_> {
        Task {
            setup: self,
            function,
        }
    }

    /// Returns the scene's arm in a scalar, with all its joints.
    pub fn arm<S: Scalar>(&self, mut constant: impl FnMut(&Exact) -> S) -> Arm<S> {
        Arm::from_robot(self.robot(), &mut constant)
    }

    pub(crate) fn loading<S: Scalar>(
        &self,
        mut input: impl FnMut(Input) -> S,
        mut constant: impl FnMut(&Exact) -> S,
    ) -> LoadArguments<S> {
        let loads = self.load().map_or(&[][..], |load| &load.rows).iter();
        let rows = loads.map(|row| row.map(&mut constant)).collect();
        let mut bodies = self.given_bodies(&mut input, &mut constant);
        bodies.extend(self.given_payload(&mut input, &mut constant));
        let drive = |(argument, place)| input(Input::Entry(argument, place));
        LoadArguments::new(&bodies, self.drives().map(drive).collect(), rows)
    }

    /// Returns the bodies that are arguments, each in the frame of its row.
    pub(super) fn given_bodies<S: Scalar>(
        &self,
        mut input: impl FnMut(Input) -> S,
        mut constant: impl FnMut(&Exact) -> S,
    ) -> Vec<Link<S>> {
        if self.bodies.is_empty() {
            return Vec::new();
        }
        let frames = self.arm(Exact::clone).frames;
        let body = |(place, row): (usize, &usize)| {
            let frame = frames.of_link(*row).map(|frame| frame.map(&mut constant));
            let mut numbers = numbers(Argument::Bodies, BODY * place, &mut input);
            for (number, is_zero) in numbers.iter_mut().zip(self.zeros.iter().skip(BODY * place)) {
                if *is_zero {
                    *number = S::zero();
                }
            }
            carried(&numbers, frame.as_ref())
        };
        self.bodies.iter().enumerate().map(body).collect()
    }

    fn given_payload<S: Scalar>(
        &self,
        input: impl FnMut(Input) -> S,
        constant: impl FnMut(&Exact) -> S,
    ) -> Option<Link<S>> {
        if !self.has(RuntimeParameter::Payload) {
            return None;
        }
        let placement = self.robot().payload_frame.as_ref();
        let frame = placement.map(|placement| exact_pose(placement).map(constant));
        let numbers = numbers(Argument::Payload, 0, input);
        Some(carried(&numbers, frame.as_ref()))
    }

    /// Lists the entries of drives that are arguments: armatures, then viscous friction, row by row.
    pub(super) fn drives(&self) -> impl Iterator<Item = (Argument, usize)> {
        let rows = self.robot().rows().len();
        let drives = [RuntimeParameter::Armature, RuntimeParameter::Viscous].into_iter();
        let taken = drives.filter(|parameter| self.has(*parameter));
        let arguments = taken.filter_map(RuntimeParameter::given);
        arguments.flat_map(move |argument| (0..rows).map(move |row| (argument, row)))
    }

    /// Returns the values that the robot file has for a parameter that `load` takes, rounded: bodies
    /// are in the frames of their links.
    pub(crate) fn defaults(&self, parameter: RuntimeParameter, scalar: ScalarType) -> Vec<Literal> {
        let literal = |value: &Exact| match is_nothing(value) {
            true => Literal(0.0),
            false => Literal(scalar.round(value)),
        };
        self.exact_defaults(parameter).iter().map(literal).collect()
    }

    /// Returns the values that the robot file has for a parameter that `load` takes, as doubles.
    pub fn file_values(&self, parameter: RuntimeParameter) -> Vec<f64> {
        let values = self.defaults(parameter, ScalarType::F64);
        values.into_iter().map(|Literal(value)| value).collect()
    }

    pub(super) fn exact_defaults(&self, parameter: RuntimeParameter) -> Vec<Exact> {
        let arm = self.arm(Exact::clone);
        let rows = arm.links.iter().skip(self.robot().base_coordinates());
        match parameter {
            RuntimeParameter::Bodies => {
                let of_row = |&row: &usize| numbers_of(&arm.links[row], arm.frames.of_link(row));
                self.bodies.iter().flat_map(of_row).collect()
            }
            RuntimeParameter::Armature => rows.map(|link| link.armature.clone()).collect(),
            RuntimeParameter::Viscous => rows.map(|link| link.friction.viscous.clone()).collect(),
            RuntimeParameter::Payload | RuntimeParameter::Gravity => Vec::new(),
        }
    }

    /// Returns the arm with nothing in the place of arguments.
    pub(crate) fn without_given<S: Scalar>(&self, mut arm: Arm<S>) -> Arm<S> {
        for &row in &self.bodies {
            let (link, body) = (&mut arm.links[row], Link::still());
            (link.mass, link.com, link.inertia) = (body.mass, body.com, body.inertia);
        }
        self.drive(&mut arm, |_| S::zero());
        arm
    }

    fn drive<S>(&self, arm: &mut Arm<S>, mut input: impl FnMut(Input) -> S) {
        let base = self.robot().base_coordinates();
        for (argument, row) in self.drives() {
            let link = &mut arm.links[base + row];
            let place = match argument {
                Argument::Armature => &mut link.armature,
                _ => &mut link.friction.viscous,
            };
            *place = input(Input::Entry(argument, row));
        }
    }
}

/// A placement makes 1e-20 of a zero, there and back.
pub(super) fn is_nothing(value: &Exact) -> bool {
    f64::nearest(value).abs() < 1e-18
}

/// Returns the numbers of a link's body in a frame: the inverse of [`carried`].
fn numbers_of(link: &Link<Exact>, frame: Option<&Columns<Exact>>) -> Vec<Exact> {
    let back = frame.map(|frame| Columns {
        axes: transposed(&frame.axes),
        origin: opposite(&frame.rotate_back(&frame.origin)),
    });
    let listed = |link: &Link<Exact>| -> Vec<Exact> {
        let inertia = link.inertia.entries().into_iter();
        let numbers = [&link.mass].into_iter().chain(&link.com).chain(inertia);
        numbers.cloned().collect()
    };
    listed(&carried(&listed(link), back.as_ref()))
}

fn numbers<S>(argument: Argument, from: usize, mut input: impl FnMut(Input) -> S) -> Vec<S> {
    let entry = |index| input(Input::Entry(argument, index));
    (from..from + BODY).map(entry).collect()
}

impl<S: Divide> TaskArm<'_, S> {
    fn written<'p>(
        &'p self,
        formulation: Formulation,
        at: &'p [DhVariables<S>],
        columns: &'p [Column<S>],
    ) -> Written<'p, S> {
        Written {
            formulation,
            arm: &self.arm,
            at,
            motion: &self.motion,
            columns,
        }
    }

    pub(crate) fn regressor(
        &self,
        by: Formulation,
        quantity: Quantity,
        columns: &[Column<S>],
    ) -> Vec<Vec<S>> {
        let at = self.arm.at(&self.motion.q);
        let entries = quantity.written(&self.written(by, &at, columns));
        let (setup, following) = (self.task.setup, &self.arm.following);
        let rows: Vec<usize> = (0..self.arm.links.len()).collect();
        let mut sizes = Sizes::of(setup.robot());
        sizes.base = columns.len();
        let matrix = setup.select(quantity, sizes, &rows, following, entries);
        let chunks = matrix.chunks(sizes.base.max(1));
        chunks.map(<[S]>::to_vec).collect()
    }

    /// Returns the results over all joints there are.
    pub fn all(&self, by: Formulation) -> Vec<S> {
        let function = self.task.function;
        function.evaluate(by, &self.arm, &self.motion, &self.columns)
    }

    /// Returns the matrix that each quantity of the function inverts beside D.
    pub fn divisors(&self) -> Vec<Vec<S>> {
        let at = self.arm.at(&self.motion.q);
        let written = self.written(Formulation::NewtonEulerLink, &at, &self.columns);
        let divisor = |quantity: &Quantity| quantity.divisor(&written);
        let quantities = self.task.function.quantities().iter();
        quantities.map(divisor).collect()
    }

    /// Returns the results over the scene's rows, from those over all.
    pub fn select(&self, values: Vec<S>) -> Vec<S> {
        let Task { setup, function } = self.task;
        let (rows, following) = (&self.rows, &self.arm.following);
        let sizes = setup.sizes(function);
        let mut rest = values.into_iter();
        let mut selected = Vec::with_capacity(function.outputs(sizes));
        for &quantity in function.quantities() {
            let entries = rest.by_ref().take(quantity.len(sizes.over_all(rows.len())));
            selected.extend(setup.select(quantity, sizes, rows, following, entries.collect()));
        }
        selected
    }

    /// Returns the results over the scene's rows.
    pub fn results(&self, by: Formulation) -> Vec<S> {
        self.select(self.all(by))
    }
}
