//! The extremes: robots made out of the user's and states where robots are not, a row of a table
//! each.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use dalembert_codegen::Function;
use dalembert_codegen::workspace::{JointState, Random, Runtime, Setup};
use dalembert_model::number::{Angle, Rational};
use dalembert_model::robot::{Convention, Inertia, Joint, JointKind, Robot};
use dalembert_model::scene::{Payload, Scene};
use num_traits::{Zero, pow};

use super::BoundKind;

/// A change of the robot.
#[derive(Clone, Copy, Debug)]
pub enum Change {
    /// The robot as it is.
    None,
    /// No gravity.
    Weightless,
    /// Masses grow from base to hand, or to the tips of limbs, by 10^e in all.
    Masses(i32),
    /// All lengths times 10^e.
    Lengths(i32),
    /// Lengths times 10⁻⁶ to 10⁶ from base to hand; with −1 in the other direction, with 1 in this.
    Mixed(i32),
    /// The last links, of each limb, have no mass, inertia or rotor.
    Massless(usize),
    /// All of the last link's mass, of each limb, in the origin of its frame.
    PointMass,
    /// The last link of each limb has a gram.
    LightTips,
    /// A base that floats has no mass and no inertia.
    MasslessBase,
    /// 10^e kg more in the hand.
    Payload(i32),
    /// The base 10⁶ m away.
    FarBase,
    /// A million turns more on every offset.
    Turns,
    /// Right angles as 1.5708.
    Typed,
    /// The joints again and again.
    Repeated(usize),
}

/// Positions and rates of the joints.
#[derive(Clone, Copy, Debug)]
pub enum Motion {
    /// Inside the limits.
    Inside,
    /// Joints that turn anywhere up to this angle, rad.
    Angles(f64),
    /// Positions, velocities and accelerations times these.
    Times([f64; 3]),
    /// The last bend straight or folded.
    WristSingular,
    /// All joints but the first at multiples of a right angle.
    Stretched,
    /// At rest, and no joint loaded by gravity where that is possible.
    Balanced,
}

/// A row of the table.
pub type Case = (&'static str, BoundKind, Change, Motion);

use BoundKind::{Both, Entries, Vector, Weight};
use Motion::{Angles, Balanced, Inside, Stretched, Times, WristSingular};

/// The extremes that torques are measured at.
#[rustfmt::skip]
pub const CASES: [Case; 33] = [
    ("normal", Both, Change::None, Inside),
    ("angles 1e2", Both, Change::None, Angles(1e2)),
    ("angles 1e4", Both, Change::None, Angles(1e4)),
    ("angles 1e6", Both, Change::None, Angles(1e6)),
    ("angles 1e8", Both, Change::None, Angles(1e8)),
    ("velocities 1e3", Both, Change::None, Times([1.0, 1e3, 1.0])),
    ("velocities 1e6", Both, Change::None, Times([1.0, 1e6, 1.0])),
    ("accelerations 1e6", Both, Change::None, Times([1.0, 1.0, 1e6])),
    ("wrist singular", Both, Change::None, WristSingular),
    ("stretched", Both, Change::None, Stretched),
    ("tiny", Weight, Change::None, Times([1e-8; 3])),
    ("tiny, no gravity", Entries, Change::Weightless, Times([1.0, 1e-8, 1e-8])),
    ("static near balance", Entries, Change::None, Balanced),
    ("mass ratio 1e-9", Vector, Change::Masses(-9), Inside),
    ("mass ratio 1e-3", Vector, Change::Masses(-3), Inside),
    ("mass ratio 1e3", Vector, Change::Masses(3), Inside),
    ("mass ratio 1e9", Vector, Change::Masses(9), Inside),
    ("lengths 1e-6", Vector, Change::Lengths(-6), Inside),
    ("lengths 1e6", Vector, Change::Lengths(6), Inside),
    ("lengths, long hand", Vector, Change::Mixed(1), Inside),
    ("lengths, long base", Vector, Change::Mixed(-1), Inside),
    ("massless last link", Both, Change::Massless(1), Inside),
    ("massless wrist", Both, Change::Massless(3), Inside),
    ("point mass at tip", Entries, Change::PointMass, Inside),
    ("tips of 1 g", Both, Change::LightTips, Inside),
    ("massless base", Both, Change::MasslessBase, Inside),
    ("payload 1 kg", Both, Change::Payload(0), Inside),
    ("payload 1e3 kg", Both, Change::Payload(3), Inside),
    ("payload 1e6 kg", Both, Change::Payload(6), Inside),
    ("base offset 1e6 m", Both, Change::FarBase, Inside),
    ("offset 1e6 turns", Both, Change::Turns, Inside),
    ("right angles 1.5708", Both, Change::Typed, Inside),
    ("chain of 20 joints", Vector, Change::Repeated(20), Inside),
];

fn power(e: i32) -> Rational {
    let size = pow(Rational::from_integer(10.into()), e.unsigned_abs() as usize);
    if e < 0 { size.recip() } else { size }
}

impl Change {
    /// Returns the changed robot; `None` if the robot has nothing to change.
    pub fn apply(self, robot: &Robot) -> Option<Robot> {
        let n = robot.joints.len();
        let places = Places::of(robot);
        let last = places.depth.iter().copied().max().unwrap_or_default();
        let share = |e: i32, depth: usize| e * depth as i32 / last.max(1) as i32;
        let mut made = robot.clone();
        let has_right_angle = robot.joints.iter().any(|joint| right(joint).is_some());
        match self {
            Change::Repeated(most) if n >= most => return None,
            Change::Typed if !has_right_angle => return None,
            // Where it is has no effect.
            Change::FarBase if robot.floating.is_some() => return None,
            Change::LightTips if !robot.is_tree() => return None,
            Change::MasslessBase if robot.floating.is_none() => return None,
            Change::Weightless => made.gravity = Default::default(),
            Change::Payload(e) => {
                // At (0.1, 0, 0.1) m in the hand.
                let payload = Payload {
                    mass: power(e),
                    com: [power(-1), Rational::zero(), power(-1)],
                    inertia: Inertia::default(),
                };
                let carrying = Scene {
                    payload: Some(payload),
                    ..Scene::default()
                };
                made = carrying.apply(robot);
            }
            Change::Repeated(most) => {
                made.joints.iter_mut().for_each(|joint| joint.name = None);
                let joints = made.joints.iter().cycle().cloned();
                made.joints = joints.take(most.min(Robot::MAX_JOINTS)).collect();
            }
            _ => {}
        }
        if let Some(base) = &mut made.floating {
            let mut body = base.body();
            match self {
                Change::Lengths(e) => scale_length(&mut body, &power(e)),
                Change::Mixed(sign) => scale_length(&mut body, &power(sign * -6)),
                Change::MasslessBase => scale_mass(&mut body, &Rational::zero()),
                _ => {}
            }
            (base.mass, base.com, base.inertia) = (body.mass, body.com, body.inertia);
        }
        for (index, joint) in made.joints.iter_mut().enumerate() {
            let place = index % n;
            let (depth, height) = (places.depth[place], places.height[place]);
            match self {
                Change::Masses(e) => scale_mass(joint, &power(share(e, depth))),
                Change::Lengths(e) => scale_length(joint, &power(e)),
                Change::Mixed(sign) => {
                    scale_length(joint, &power(sign * (share(12, depth) - 6)));
                }
                Change::Massless(links) if height < links => {
                    scale_mass(joint, &Rational::zero());
                    joint.armature = Rational::zero();
                }
                Change::LightTips if height == 0 && !joint.mass.is_zero() => {
                    let factor = power(-3) / &joint.mass;
                    scale_mass(joint, &factor);
                }
                Change::PointMass if height == 0 => {
                    (joint.com, joint.inertia) = Default::default();
                    joint.armature = Rational::zero();
                    if joint.mass.is_zero() {
                        joint.mass = power(0);
                    }
                }
                Change::FarBase if index == 0 => {
                    joint.d += power(6);
                    if robot.convention == Convention::Modified {
                        joint.a += power(6);
                    }
                }
                Change::Turns if joint.kind == JointKind::Revolute => {
                    let turned = Rational::from_float(joint.theta.to_f64() + 1e6 * TAU)?;
                    joint.theta = Angle::Radians(turned);
                }
                Change::Typed => joint.alpha = right(joint).unwrap_or(joint.alpha.clone()),
                _ => {}
            }
        }
        made.has_mass().then_some(made)
    }
}

/// The number of links between each joint's link and the base, and between it and the farthest tip
/// beyond it.
struct Places {
    depth: Vec<usize>,
    height: Vec<usize>,
}

impl Places {
    fn of(robot: &Robot) -> Places {
        let n = robot.joints.len();
        if !robot.is_tree() {
            return Places {
                depth: (0..n).collect(),
                height: (0..n).rev().collect(),
            };
        }
        let rows = robot.rows().len();
        let (mut depth, mut height) = (vec![0; rows], vec![0; rows]);
        for row in 0..rows {
            depth[row] = robot.carrier(row).map_or(0, |carrier| depth[carrier] + 1);
        }
        for row in (0..rows).rev() {
            if let Some(carrier) = robot.carrier(row) {
                height[carrier] = height[carrier].max(height[row] + 1);
            }
        }
        let of_joints =
            |levels: Vec<usize>| (0..n).map(|joint| levels[robot.row_of(joint)]).collect();
        Places {
            depth: of_joints(depth),
            height: of_joints(height),
        }
    }
}

fn right(joint: &Joint) -> Option<Angle> {
    let typed = Rational::new(15708.into(), 10000.into());
    match joint.alpha.quarter_turns() {
        Some(1) => Some(Angle::Radians(typed)),
        Some(3) => Some(Angle::Radians(-typed)),
        _ => None,
    }
}

fn scale_mass(joint: &mut Joint, factor: &Rational) {
    joint.mass *= factor;
    joint.inertia = joint.inertia.map(|entry| entry * factor);
}

fn scale_length(joint: &mut Joint, factor: &Rational) {
    let lengths = [&mut joint.a, &mut joint.d].into_iter();
    let places = joint.place.iter_mut();
    let placed = places.flat_map(|place| &mut place.placement.xyz);
    let lengths = lengths.chain(placed).chain(&mut joint.com);
    lengths.for_each(|x| *x *= factor);
    joint.inertia = joint.inertia.map(|entry| entry * factor * factor);
}

impl Motion {
    /// Draws states with values for all arguments, the same on every machine.
    pub fn draw(self, setup: &Setup, count: usize, seed: u64) -> Vec<JointState> {
        let robot = setup.robot();
        let turning = |i: &usize| robot.joints[*i].kind == JointKind::Revolute;
        let turning: Vec<usize> = (0..robot.joints.len()).filter(turning).collect();
        let straight = |joint: usize| -robot.joints[joint].theta.to_f64();
        let mut random = Random::new(seed);
        let mut states = setup.states(count, seed);
        for (index, state) in states.iter_mut().enumerate() {
            match self {
                Motion::Inside | Motion::Balanced => {}
                Motion::Angles(size) => {
                    for &i in &turning {
                        state.q[i] = size * (2.0 * random.unit() - 1.0);
                    }
                }
                Motion::Times(factors) => {
                    let rows = [&mut state.q, &mut state.qd, &mut state.qdd];
                    for (row, factor) in rows.into_iter().zip(factors) {
                        row.iter_mut().for_each(|x| *x *= factor);
                    }
                }
                Motion::WristSingular => {
                    if let Some(&bend) = turning.iter().rev().nth(1).or(turning.last()) {
                        state.q[bend] = straight(bend) + (index % 2) as f64 * PI;
                    }
                }
                Motion::Stretched => {
                    for &i in turning.iter().skip(1) {
                        let quarters = random.below(8).saturating_sub(4);
                        state.q[i] = straight(i) + quarters as f64 * FRAC_PI_2;
                    }
                }
            }
        }
        if let Motion::Balanced = self {
            let runtime = Runtime::in_scene(setup.clone());
            for state in &mut states {
                state.qd.fill(0.0);
                state.qdd.fill(0.0);
                balance(&runtime, robot.base_coordinates(), &turning, state);
            }
        }
        states
    }

    /// Returns the motion that sizes are taken from: near balance, every torque is dust, and next to
    /// zero those of joints that feel no weight there. They count relative to the arm's weight.
    pub fn scales(self) -> Motion {
        match self {
            Motion::Balanced => Times([1.0, 0.0, 0.0]),
            Times([at, velocity, acceleration]) if at < 1.0 => Times([1.0, velocity, acceleration]),
            other => other,
        }
    }
}

/// Brings each joint, from the hand to the base, to the zero of its own load by bisection.
fn balance(runtime: &Runtime, base: usize, turning: &[usize], state: &mut JointState) {
    for &joint in turning.iter().rev().chain(turning.iter().rev()) {
        let start = state.q[joint];
        let mut load = |at: f64| {
            state.q[joint] = at;
            runtime.run(Function::Gravity, state)[base + joint]
        };
        let mut low = start;
        let first = load(low);
        let mut high = low + PI;
        // Half a turn away the load is the opposite, unless gravity does not reach the axis.
        if first != 0.0 && load(high) * first < 0.0 {
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                match load(middle) * first > 0.0 {
                    true => low = middle,
                    false => high = middle,
                }
            }
        }
        state.q[joint] = low;
    }
}
