//! A robot whose motion, and on request whose lengths, masses and inertias, are symbols.

use dalembert_codegen::Diagnostic;
use dalembert_codegen::workspace::Setup;
use dalembert_model::equations::chain::{Chain, Displacement, MomentBody, Regrouping, Skeleton};
use dalembert_model::equations::{Arm, JointPosition};
use dalembert_model::number::{Angle, Exact, Rational, Wide};
use dalembert_model::robot::{Joint, JointKind, Robot};
use dalembert_model::scalar::{Scalar, SinCosPair};

use crate::error;
use crate::naming::SymbolTable;
use crate::number::{Constants, Number};
use crate::ring::{MAX_JOINTS, MAX_POWER, Polynomial, Symbols};
use crate::symbol::Symbol;

/// The variable of a joint: θ_i of one that turns, d_i of one that slides.
#[derive(Clone, Debug)]
pub struct Variable {
    /// The joint, counted from zero.
    pub joint: usize,
    /// Turns or slides.
    pub kind: JointKind,
    /// The constant that is added to q_i.
    pub offset: Offset,
}

impl Variable {
    /// The symbol of a slide: d_i, or q_i where nothing is added to that.
    pub(crate) fn slide_symbol(&self) -> Symbol {
        match self.offset {
            Offset::None => Symbol::indexed("q", self.joint + 1),
            _ => Symbol::indexed("d", self.joint + 1),
        }
    }
}

/// The constant part of a joint's variable.
#[derive(Clone, Debug, PartialEq)]
pub enum Offset {
    /// The variable is q_i.
    None,
    /// θ_i = q_i + this.
    Angle(Angle),
    /// d_i = q_i + this, m.
    Length(Rational),
}

/// The numbers of the robot file that are symbols.
#[derive(Clone, Copy, Debug)]
pub enum Symbolic {
    Nothing,
    /// Lengths, gravity, masses, centres of mass, inertias.
    Everything,
}

/// An arm over polynomials.
#[derive(Clone, Debug)]
pub struct SymbolicArm {
    /// The parameters, with the offsets of the joints moved into their variables.
    pub arm: Arm<Polynomial>,
    /// The joints that move, in the order of results.
    pub variables: Vec<Variable>,
    /// The position of each row.
    pub position: Vec<JointPosition<Polynomial>>,
    /// The joints that stay where a lock says and are merged into the link before.
    pub locks: Vec<Option<JointPosition<Polynomial>>>,
    pub symbols: SymbolTable,
}

impl SymbolicArm {
    /// Reads a robot in its scene.
    ///
    /// # Errors
    /// Its base floats, or it has more joints than monomials hold.
    pub fn new(setup: &Setup, symbolic: Symbolic) -> Result<SymbolicArm, Diagnostic> {
        let robot = setup.robot();
        check(robot)?;
        let mut constants = Constants::new();
        let mut constant = |x: &Exact| Polynomial::constant(constants.number(x));
        let mut arm = setup.arm(&mut constant);
        let mut locks = Vec::new();
        for lock in setup.merged() {
            locks.push(lock.map(|lock| mapped(&lock, &mut constant)));
        }
        let mut position: Vec<Option<JointPosition<Polynomial>>> = vec![None; arm.links.len()];
        let mut variables = Vec::new();
        for (joint, line) in robot.joints.iter().enumerate() {
            let row = robot.row_of(joint);
            if let Some(lock) = setup.lock(joint) {
                position[row] = Some(mapped(lock, &mut constant));
                continue;
            }
            variables.push(Variable {
                joint,
                kind: line.kind,
                offset: take_offset(&mut arm, row, line),
            });
            position[row] = Some(match line.kind {
                JointKind::Revolute => JointPosition::Revolute(Polynomial::turn(joint)),
                JointKind::Prismatic => JointPosition::Prismatic(Polynomial::slide(joint)),
            });
        }
        for follower in &arm.following {
            let leader = position[follower.leader].as_ref();
            position[follower.row] = leader.map(|leader| leader.followed_by(follower));
        }
        if !constants.fits {
            return Err(error::unfit());
        }
        let symbols = match symbolic {
            Symbolic::Nothing => SymbolTable::default(),
            Symbolic::Everything => SymbolTable::new(&mut arm)?,
        };
        Ok(SymbolicArm {
            arm,
            variables,
            position: position.into_iter().flatten().collect(),
            locks,
            symbols,
        })
    }

    pub fn chain(&self, arm: &Arm<Polynomial>) -> PosedChain<Polynomial> {
        posed(arm, &self.locks, &self.position)
    }

    /// Returns the value of a polynomial without motion, whose parameters are the file's.
    pub fn evaluate(&self, polynomial: &Polynomial) -> Number {
        let terms = polynomial.terms().iter();
        terms.fold(Number::zero(), |sum, (monomial, x)| {
            sum.add(&self.value(monomial.symbols).mul(x))
        })
    }

    /// Returns the value of a product of symbols, whose parameter is the file's.
    pub fn value(&self, symbols: Symbols) -> Number {
        self.value_of(symbols, |index| self.symbols.parameters[index].value)
    }

    /// Returns the value of a product of symbols, whose parameter has this value.
    pub fn value_of(&self, symbols: Symbols, parameter: impl Fn(usize) -> Number) -> Number {
        let index = symbols.parameter_index();
        let start = index.map_or_else(Number::one, parameter);
        symbols.lengths().fold(start, |product, (index, power)| {
            let value = &self.symbols.lengths[index].value;
            (0..power).fold(product, |product, _| product.mul(value))
        })
    }
}

/// A chain at a position.
#[derive(Clone, Debug)]
pub struct PosedChain<S> {
    /// Regrouped.
    pub chain: Chain<S>,
    /// A chain with these frames whose links keep all of their bodies.
    pub whole: Chain<S>,
    pub at: Vec<Displacement<S>>,
    /// The row of each link.
    pub rows: Vec<usize>,
}

/// Returns the chain of an arm at a position; joints with a lock stay where that says.
pub fn posed<S: Scalar>(
    arm: &Arm<S>,
    locks: &[Option<JointPosition<S>>],
    position: &[JointPosition<S>],
) -> PosedChain<S> {
    let skeleton = Skeleton::new(arm, locks);
    let chain = Chain::new(&skeleton, &Regrouping::base(&skeleton));
    let rows: Vec<usize> = skeleton.links.iter().map(|segment| segment.joint).collect();
    let links = rows.iter().zip(&chain.links);
    let at = links.map(|(&row, link)| match &position[row] {
        JointPosition::Revolute(pair) => Displacement::Turn(pair.compose(&link.theta)),
        JointPosition::Prismatic(q) => Displacement::Slide(q.clone()),
    });
    PosedChain {
        at: at.collect(),
        whole: unmoved(&skeleton),
        chain,
        rows,
    }
}

/// Returns the chain with the frames of base parameters and all of each body on its link.
fn unmoved<S: Scalar>(skeleton: &Skeleton<S>) -> Chain<S> {
    let mut empty = skeleton.clone();
    for segment in &mut empty.links {
        segment.link.body = MomentBody::zero();
    }
    let mut chain = Chain::new(&empty, &Regrouping::base(skeleton));
    for (link, segment) in chain.links.iter_mut().zip(&skeleton.links) {
        let along = match segment.link.kind {
            JointKind::Revolute => segment.d.neg(),
            JointKind::Prismatic => S::zero(),
        };
        link.body = segment.link.body.moved(&[S::zero(), S::zero(), along]);
    }
    chain
}

fn check(robot: &Robot) -> Result<(), Diagnostic> {
    if robot.floating.is_some() {
        return Err(error::floating());
    }
    let joints = robot.joints.len();
    if joints > MAX_JOINTS {
        return Err(error::many_joints(joints));
    }
    for joint in 0..joints {
        let mut turns = 0;
        for follower in &robot.followers {
            if follower.leader == joint {
                turns += follower.turns().unsigned_abs();
            }
        }
        if 2 * (1 + turns as usize) > MAX_POWER {
            return Err(error::far_follower(joint));
        }
    }
    Ok(())
}

/// Returns a position with its numbers through `change`.
pub fn mapped<S, T>(at: &JointPosition<S>, mut change: impl FnMut(&S) -> T) -> JointPosition<T> {
    match at {
        JointPosition::Revolute(pair) => JointPosition::Revolute(pair.map(change)),
        JointPosition::Prismatic(q) => JointPosition::Prismatic(change(q)),
    }
}

/// Moves the constant part of a joint's θ or d into its variable; none of a joint that others follow.
/// A turn of a placed joint by right angles stays: it makes no terms, and the variable is q_i.
fn take_offset(arm: &mut Arm<Polynomial>, row: usize, joint: &Joint) -> Offset {
    let link = &mut arm.links[row];
    if arm.following.iter().any(|follower| follower.leader == row) {
        return Offset::None;
    }
    if joint.kind == JointKind::Prismatic {
        // A row's d has the number of its row, a slide that of its coordinate.
        if link.place.is_some() || link.d.is_zero() || !arm.following.is_empty() {
            return Offset::None;
        }
        link.d = Polynomial::zero();
        return Offset::Length(joint.d.clone());
    }
    let [sin, cos] = [&link.theta.sin, &link.theta.cos];
    if sin.is_zero() && cos.is_one() {
        return Offset::None;
    }
    let angle = match link.place {
        None => joint.theta.clone(),
        Some(_) if sin.is_zero() || cos.is_zero() => return Offset::None,
        Some(_) => {
            let wide = |x: &Polynomial| {
                let value = x.to_constant().map(Number::to_rational);
                value.map_or_else(Wide::zero, |x| Wide::from_rational(&x))
            };
            Angle::recovered(&wide(sin), &wide(cos))
        }
    };
    link.theta = SinCosPair::straight();
    Offset::Angle(angle)
}
