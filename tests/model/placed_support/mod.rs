//! Arms by frames, and their torques by the recursion in base axes over these
//! frames: nothing of DH, nothing of the model's equations.

use dalembert_model::outputs::{Argument, Quantity};
use dalembert_model::reference::{JointVectors, Reference};
use dalembert_model::robot::Robot;
use dalembert_model::scalar::field::Points;
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use crate::support::vector;

pub struct Body {
    mass: f64,
    com: Vector3<f64>,
    inertia: Matrix3<f64>,
}

pub struct Joint {
    xyz: [f64; 3],
    rpy: [f64; 3],
    axis: [f64; 3],
    slides: bool,
    bodies: Vec<Body>,
    viscous: f64,
    armature: f64,
}

pub struct Arm {
    gravity: Vector3<f64>,
    base: ([f64; 3], [f64; 3]),
    tool: ([f64; 3], [f64; 3]),
    joints: Vec<Joint>,
}

/// The places of the six numbers of a symmetric matrix in a file.
const PLACES: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)];

pub struct Drawn(Points);

impl Drawn {
    pub fn new(seed: u64) -> Drawn {
        Drawn(Points::new(seed))
    }

    fn below(&mut self, n: u64) -> u64 {
        self.0.bits() % n
    }

    /// Returns a decimal of three digits within ±most.
    fn number(&mut self, most: f64) -> f64 {
        let steps = (most * 1000.0) as u64;
        (self.below(2 * steps + 1) as f64 - steps as f64) / 1000.0
    }

    fn triple(&mut self, most: f64) -> [f64; 3] {
        [self.number(most), self.number(most), self.number(most)]
    }

    fn angles(&mut self) -> [f64; 3] {
        std::array::from_fn(|_| match self.below(4) {
            0 | 1 => 0.0,
            2 => (self.below(4) as f64 - 1.0) * std::f64::consts::FRAC_PI_2,
            _ => self.number(3.0),
        })
    }

    fn body(&mut self) -> Body {
        let [a, b, c] = self.triple(0.004);
        let [x, y, z] = self.triple(0.01).map(|x| 0.05 + x);
        let (mass, com) = (1.0 + self.number(0.8), Vector3::from(self.triple(0.3)));
        let inertia = Matrix3::new(x, a, b, a, y, c, b, c, z);
        Body { mass, com, inertia }
    }

    pub fn arm(&mut self, n: usize) -> Arm {
        let joint = |_| {
            let along = self.below(6) as usize;
            let mut axis = [0.0; 3];
            axis[along % 3] = if along < 3 { 1.0 } else { -1.0 };
            let lengths = [0.0, 0.0, 0.4].map(|most: f64| self.number(most));
            Joint {
                xyz: match self.below(3) {
                    0 => lengths,
                    1 => [0.0; 3],
                    _ => self.triple(0.5),
                },
                rpy: self.angles(),
                axis: match self.below(4) {
                    0 => self.triple(2.0).map(|x| x + 0.0005),
                    _ => axis,
                },
                slides: self.below(4) == 0,
                bodies: vec![self.body()],
                viscous: self.number(0.5).abs(),
                armature: self.number(0.5).abs(),
            }
        };
        let joints = (0..n).map(joint).collect();
        let mut end = || match self.below(3) {
            0 => ([0.0; 3], [0.0; 3]),
            _ => (self.triple(1.0), self.angles()),
        };
        let (base, tool) = (end(), end());
        Arm {
            gravity: Vector3::from(self.triple(10.0)),
            base,
            tool,
            joints,
        }
    }

    pub fn nearly_parallel(&mut self, n: usize, angle: f64) -> Arm {
        let mut arm = self.arm(n);
        for joint in &mut arm.joints {
            joint.xyz = self.triple(0.5);
            joint.axis = [0.0, 0.0, 1.0];
            let [roll, pitch] = [(); 2].map(|()| angle * self.number(1.0));
            joint.rpy = [roll, pitch, self.number(3.0)];
        }
        arm
    }
}

impl Arm {
    pub fn payload(&mut self) {
        self.joints.last_mut().unwrap().bodies.push(Body {
            mass: 2.5,
            com: Vector3::new(0.1, -0.2, 0.05),
            inertia: Matrix3::new(0.02, 0.001, 0.0, 0.001, 0.03, 0.0, 0.0, 0.0, 0.04),
        });
    }
}

pub fn file(arm: &Arm) -> String {
    let placed = |xyz: &[f64; 3], rpy: &[f64; 3]| format!("{{ xyz = {xyz:?}, rpy = {rpy:?} }}");
    let [base, tool] = [arm.base, arm.tool].map(|(xyz, rpy)| placed(&xyz, &rpy));
    let gravity = arm.gravity.as_slice();
    let mut text = format!("name = \"arm\"\ngravity = {gravity:?}\nbase = {base}\ntool = {tool}\n");
    for joint in &arm.joints {
        let kind = ["revolute", "prismatic"][usize::from(joint.slides)];
        let body = &joint.bodies[0];
        text += &format!(
            "[[joint]]\nkind = \"{kind}\"\nplacement = {}\naxis = {:?}\nmass = {:?}\ncom = {:?}\n\
             inertia = {:?}\nviscous = {:?}\narmature = {:?}\n",
            placed(&joint.xyz, &joint.rpy),
            joint.axis,
            body.mass,
            body.com.as_slice(),
            PLACES.map(|place| body.inertia[place]),
            joint.viscous,
            joint.armature
        );
    }
    text
}

/// Returns the turn about an axis: 1 + sin K + (1 − cos) K², K v = axis × v.
fn about(axis: Vector3<f64>, angle: f64) -> Matrix3<f64> {
    let k = axis.cross_matrix();
    Matrix3::identity() + k * angle.sin() + k * k * (1.0 - angle.cos())
}

fn rotation([roll, pitch, yaw]: [f64; 3]) -> Matrix3<f64> {
    about(Vector3::z(), yaw) * about(Vector3::y(), pitch) * about(Vector3::x(), roll)
}

type Pose = (Matrix3<f64>, Vector3<f64>);

fn then(a: &Pose, b: &Pose) -> Pose {
    (a.0 * b.0, a.1 + a.0 * b.1)
}

fn by_frames(arm: &Arm, q: &[f64], qd: &[f64], qdd: &[f64]) -> (Vec<f64>, Pose) {
    let mut at: Pose = (rotation(arm.base.1), Vector3::from(arm.base.0));
    let (mut omega, mut turning, mut moving) = (Vector3::zeros(), Vector3::zeros(), -arm.gravity);
    let mut axes = Vec::new();
    let mut loads: Vec<[Vector3<f64>; 3]> = Vec::new();
    for (i, joint) in arm.joints.iter().enumerate() {
        let before = at.1;
        let placed = (rotation(joint.rpy), Vector3::from(joint.xyz));
        let direction = Vector3::from(joint.axis);
        let unit = direction / direction.dot(&direction).sqrt();
        at = then(&at, &placed);
        let axis = at.0 * unit;
        let step = match joint.slides {
            true => (Matrix3::identity(), unit * q[i]),
            false => (about(unit, q[i]), Vector3::zeros()),
        };
        at = then(&at, &step);
        let lever = at.1 - before;
        moving += turning.cross(&lever) + omega.cross(&omega.cross(&lever));
        if joint.slides {
            moving += axis * qdd[i] + 2.0 * omega.cross(&(axis * qd[i]));
        } else {
            turning += axis * qdd[i] + omega.cross(&(axis * qd[i]));
            omega += axis * qd[i];
        }
        let (mut force, mut moment) = (Vector3::zeros(), Vector3::zeros());
        for body in &joint.bodies {
            let com = at.0 * body.com;
            let tensor = at.0 * body.inertia * at.0.transpose();
            let pull = body.mass * (moving + turning.cross(&com) + omega.cross(&omega.cross(&com)));
            force += pull;
            moment += com.cross(&pull) + tensor * turning + omega.cross(&(tensor * omega));
        }
        axes.push(axis);
        loads.push([at.1, force, moment]);
    }
    let n = arm.joints.len();
    let torque = |i: usize| {
        let (mut force, mut moment) = (Vector3::zeros(), Vector3::zeros());
        for [point, push, turn] in &loads[i..] {
            force += push;
            moment += turn + (point - loads[i][0]).cross(push);
        }
        let joint = &arm.joints[i];
        let load = if joint.slides { force } else { moment };
        axes[i].dot(&load) + joint.viscous * qd[i] + joint.armature * qdd[i]
    };
    let tool = (rotation(arm.tool.1), Vector3::from(arm.tool.0));
    ((0..n).map(torque).collect(), then(&at, &tool))
}

/// In the link's frame: the mass, first moments and the tensor about the origin.
fn parameters(arm: &Arm) -> DVector<f64> {
    let link = |joint: &Joint| {
        let mut sum = [0.0; 10];
        for Body { mass, com, inertia } in &joint.bodies {
            let tensor =
                inertia + *mass * (Matrix3::identity() * com.dot(com) - com * com.transpose());
            let (first, second) = (com * *mass, PLACES.map(|place| tensor[place]));
            let moments = [&[*mass][..], first.as_slice(), &second].concat();
            for (sum, moment) in sum.iter_mut().zip(moments) {
                *sum += moment;
            }
        }
        sum
    };
    let numbers: Vec<f64> = arm.joints.iter().flat_map(link).collect();
    DVector::from_vec(numbers)
}

/// The worst difference is relative to the largest torque; of poses, in metres.
pub fn compare(arm: &Arm, robot: &Robot, drawn: &mut Drawn) -> f64 {
    use Argument::{Acceleration, Position, Velocity};
    let runtime = Reference::<f64>::from_robot(robot);
    let mut worst: f64 = 0.0;
    for _ in 0..4 {
        let n = arm.joints.len();
        let [q, qd, qdd] =
            [3.0, 2.0, 5.0].map(|most| DVector::from_fn(n, |_, _| drawn.number(most)));
        let (torques, hand) = by_frames(arm, q.as_slice(), qd.as_slice(), qdd.as_slice());
        let torques = vector(&torques);
        let tau = runtime.inverse_dynamics(&q, &qd, &qdd).unwrap();
        worst = worst.max((tau - &torques).amax() / torques.amax());
        let pairs = [(Position, &q), (Velocity, &qd), (Acceleration, &qdd)];
        let vectors = pairs.map(|(argument, vector)| (argument, vector.clone()));
        let y = runtime.entries(Quantity::LinkRegressor, &JointVectors::new(vectors));
        let y = DMatrix::from_row_slice(n, 10 * n, &y.unwrap());
        let pi = parameters(arm);
        let drive = |(i, joint): (usize, &Joint)| joint.viscous * qd[i] + joint.armature * qdd[i];
        let drives = arm.joints.iter().enumerate().map(drive);
        let product = &y * &pi + DVector::from_iterator(n, drives);
        let size = (y.abs() * pi.abs()).amax().max(torques.amax());
        worst = worst.max((product - &torques).amax() / size);
        let pose = runtime.hand(&q).unwrap();
        for k in 0..3 {
            worst = worst.max((Vector3::from(pose.axes[k]) - hand.0.column(k)).amax());
        }
        worst = worst.max((Vector3::from(pose.origin) - hand.1).amax());
    }
    worst
}
