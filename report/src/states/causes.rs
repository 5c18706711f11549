//! The usual mistakes, as changes of the robot or of the states.

use core::f64::consts::PI;

use dalembert_codegen::workspace::function::{Quantity, Sizes};
use dalembert_model::number::{Angle, Rational};
use dalembert_model::robot::{Convention, Inertia, Joint, JointKind, Robot};
use num_traits::{Signed, Zero};

use super::case::Case;
use super::float;

/// A mistake that may have been made.
pub(super) struct Cause {
    /// Completes "every state agrees if …".
    pub text: String,
    /// True if it concerns the whole robot, or a single joint.
    pub of_all: bool,
    pub change: Box<dyn Fn(&mut Case)>,
}

fn whole(number: i64) -> Rational {
    Rational::from_integer(number.into())
}

/// Returns every usual mistake that can be made with this robot.
pub(super) fn causes(robot: &Robot) -> Vec<Cause> {
    let mut causes = Causes(Vec::new());
    causes.of_units(robot);
    causes.of_signs(robot);
    causes.of_gravity(robot);
    causes.of_inertia();
    causes.of_parameters();
    for (index, joint) in robot.joints.iter().enumerate() {
        causes.of_joint(index, joint, &robot.joint_label(index));
    }
    causes.0
}

struct Causes(Vec<Cause>);

impl Causes {
    fn add(&mut self, text: impl Into<String>, change: impl Fn(&mut Case) + 'static) {
        self.0.push(Cause {
            text: text.into(),
            of_all: true,
            change: Box::new(change),
        });
    }

    /// Makes a change of every joint.
    fn joints(&mut self, text: impl Into<String>, change: impl Fn(&mut Joint) + 'static) {
        self.add(text, move |case| {
            case.robot.joints.iter_mut().for_each(&change);
        });
    }

    fn of_units(&mut self, robot: &Robot) {
        const DEGREES: f64 = PI / 180.0;
        let has = |kind| robot.joints.iter().any(|joint| joint.kind == kind);
        for (kind, unit, factor) in [
            (JointKind::Revolute, "degrees", DEGREES),
            (JointKind::Prismatic, "mm", 1e-3),
        ] {
            if !has(kind) {
                continue;
            }
            let joints = match kind {
                JointKind::Revolute => "revolute joints",
                JointKind::Prismatic => "prismatic joints",
            };
            self.add(
                format!("`q`, `qd` and `qdd` of {joints} are taken as {unit}"),
                move |case| scale_motion(case, kind, [factor; 3]),
            );
            self.add(format!("`q` of {joints} is taken as {unit}"), move |case| {
                scale_motion(case, kind, [factor, 1.0, 1.0])
            });
            self.add(
                format!("`qd` and `qdd` of {joints} are taken as {unit}"),
                move |case| scale_motion(case, kind, [1.0, factor, factor]),
            );
        }
        let milli = || Rational::new(1.into(), 1000.into());
        self.joints("the robot file's `com` is taken as mm", move |joint| {
            joint.com.iter_mut().for_each(|x| *x *= milli());
        });
        self.joints(
            "the robot file's `a` and `d` are taken as mm",
            move |joint| {
                joint.a *= milli();
                joint.d *= milli();
            },
        );
        self.joints(
            "the robot file's `a`, `d` and `com` are taken as mm",
            move |joint| {
                joint.com.iter_mut().for_each(|x| *x *= milli());
                joint.a *= milli();
                joint.d *= milli();
            },
        );
        self.joints("the robot file's `mass` is taken as g", move |joint| {
            joint.mass *= milli();
        });
        for (unit, parts) in [
            ("kg·mm²", 1_000_000),
            ("kg·cm²", 10_000),
            ("g·mm²", 1_000_000_000),
            ("g·cm²", 10_000_000),
        ] {
            self.joints(
                format!("the robot file's `inertia` is taken as {unit}"),
                move |joint| joint.inertia = joint.inertia.map(|x| x / whole(parts)),
            );
        }
        self.joints(
            "the robot file's `alpha` and `theta` are taken as degrees",
            |joint| {
                for angle in [&mut joint.alpha, &mut joint.theta] {
                    if let Angle::Radians(value) = angle {
                        *angle = Angle::PiTimes(&*value / whole(180)).canonical();
                    }
                }
            },
        );
        self.add("`tau`, `h` and `c` are taken as N·mm", |case| {
            for quantity in [Quantity::Torque, Quantity::Coriolis, Quantity::Gravity] {
                scale_known(case, quantity, 1e-3);
            }
        });
    }

    fn of_signs(&mut self, robot: &Robot) {
        self.add("the sign of `tau` is changed", |case| {
            scale_known(case, Quantity::Torque, -1.0);
        });
        self.add("the sign of `c` is changed", |case| {
            scale_known(case, Quantity::Gravity, -1.0);
        });
        self.add("`h` is taken to include the gravity load c", |case| {
            case.load.gravity = true;
        });
        if robot.joints.iter().all(|joint| joint.viscous.is_zero()) {
            return;
        }
        self.add("`h` is taken to include the damping b∘q̇", |case| {
            case.load.damping = true;
        });
        self.add(
            "`h` is taken to include the gravity load c and the damping b∘q̇",
            |case| {
                case.load.gravity = true;
                case.load.damping = true;
            },
        );
    }

    fn of_gravity(&mut self, robot: &Robot) {
        let own = robot.gravity.clone();
        let mut others: Vec<(String, [Rational; 3])> = Vec::new();
        others.push((
            "the sign of the robot file's `gravity` is changed".into(),
            own.each_ref().map(|x| -x),
        ));
        others.push((
            "the robot file's `gravity` is [0, 0, 0]".into(),
            [(); 3].map(|()| Rational::zero()),
        ));
        let along: Vec<usize> = (0..3).filter(|axis| !own[*axis].is_zero()).collect();
        let mut sizes: Vec<Rational> = match along.as_slice() {
            [axis] => vec![own[*axis].abs()],
            _ => Vec::new(),
        };
        let standard = [981_000, 980_665, 980_000, 978_000, 1_000_000];
        sizes.extend(standard.map(|g| Rational::new(g.into(), 100_000.into())));
        for (index, size) in sizes.iter().enumerate() {
            for axis in 0..3 {
                for sign in [-1, 1] {
                    let mut vector = [(); 3].map(|()| Rational::zero());
                    vector[axis] = size * whole(sign);
                    let new = vector != own && others.iter().all(|(_, other)| *other != vector);
                    // Another size along another axis is two mistakes.
                    let likely =
                        index == 0 || (along == [axis] && (own[axis].is_negative() == (sign < 0)));
                    if new && (likely || along.is_empty()) {
                        let shown = vector.each_ref().map(|x| float(x).to_string()).join(", ");
                        others.push((format!("the robot file's `gravity` is [{shown}]"), vector));
                    }
                }
            }
        }
        for (text, vector) in others.into_iter().filter(|(_, vector)| *vector != own) {
            self.add(text, move |case| case.robot.gravity.clone_from(&vector));
        }
    }

    fn of_inertia(&mut self) {
        self.joints(
            "the robot file's `inertia` is taken about the origin of the link's frame \
             instead of the centre of mass",
            |joint| shift(joint, -1),
        );
        self.joints(
            "the other program takes `inertia` about the centre of mass, and was given it about \
             the origin of the link's frame",
            |joint| shift(joint, 1),
        );
        self.joints(
            "the robot file's products of inertia xy, yz, xz change their sign \
             (here they are entries of the tensor)",
            |joint| {
                let Inertia { xy, yz, xz, .. } = &mut joint.inertia;
                [xy, yz, xz].into_iter().for_each(|x| *x = -&*x);
            },
        );
        // Each entry is what stands at its place of [xx, yy, zz, xy, yz, xz].
        let orders = [
            ("xx, yy, zz, xy, xz, yz", [0, 1, 2, 3, 5, 4]),
            ("xx, xy, xz, yy, yz, zz", [0, 3, 5, 1, 4, 2]),
            ("xx, xy, yy, xz, yz, zz", [0, 2, 5, 1, 4, 3]),
        ];
        for (order, places) in orders {
            self.joints(
                format!("the robot file's `inertia` is in the order {order}"),
                move |joint| {
                    let given = joint.inertia.entries();
                    joint.inertia = Inertia::of(places.map(|place| given[place].clone()));
                },
            );
        }
        self.joints("the sign of the robot file's `com` is changed", |joint| {
            joint.com.iter_mut().for_each(|x| *x = -&*x);
        });
    }

    fn of_parameters(&mut self) {
        self.add("the robot file's `convention` is the other one", |case| {
            case.robot.convention = match case.robot.convention {
                Convention::Standard => Convention::Modified,
                Convention::Modified => Convention::Standard,
            };
        });
        self.joints("the sign of the robot file's `alpha` is changed", |joint| {
            joint.alpha = joint.alpha.negate();
        });
        self.joints("the robot file's `theta` is left out", |joint| {
            joint.theta = Angle::default();
        });
        self.joints("the robot file's `viscous` is left out", |joint| {
            joint.viscous = Rational::zero();
        });
        self.joints("the robot file's `coulomb` is left out", |joint| {
            joint.coulomb = Rational::zero();
        });
        self.joints("the robot file's `armature` is left out", |joint| {
            joint.armature = Rational::zero();
        });
    }

    fn of_joint(&mut self, index: usize, joint: &Joint, label: &str) {
        let mut add = |text: String, change: Box<dyn Fn(&mut Case)>| {
            self.0.push(Cause {
                text,
                of_all: false,
                change,
            });
        };
        add(
            format!("the axis of {label} is reversed"),
            Box::new(move |case| reverse(case, index)),
        );
        if joint.kind == JointKind::Revolute {
            for (name, turns) in [("π/2", 1), ("-π/2", -1), ("π", 2)] {
                add(
                    format!("{name} is added to `q` of {label}"),
                    Box::new(move |case| {
                        let angle = f64::from(turns) * (PI / 2.0);
                        case.states
                            .iter_mut()
                            .for_each(|s| s.state.q[index] += angle);
                    }),
                );
            }
        }
    }
}

/// Scales position, velocity and acceleration of the joints of a kind.
fn scale_motion(case: &mut Case, kind: JointKind, factors: [f64; 3]) {
    for given in &mut case.states {
        let state = &mut given.state;
        for (values, factor) in [&mut state.q, &mut state.qd, &mut state.qdd]
            .into_iter()
            .zip(factors)
        {
            for (value, joint) in values.iter_mut().zip(&case.robot.joints) {
                if joint.kind == kind {
                    *value *= factor;
                }
            }
        }
    }
}

fn scale_known(case: &mut Case, quantity: Quantity, factor: f64) {
    for given in &mut case.states {
        if let Some(values) = given.known.get_mut(&quantity) {
            values.iter_mut().for_each(|x| *x *= factor);
        }
    }
}

/// Moves the inertia between centre of mass and origin: ± m (r² 1 − r rᵀ).
fn shift(joint: &mut Joint, sign: i64) {
    let mass = &joint.mass * whole(sign);
    let [x, y, z] = &joint.com;
    let Inertia {
        xx,
        yy,
        zz,
        xy,
        yz,
        xz,
    } = &mut joint.inertia;
    *xx += &mass * (y * y + z * z);
    *yy += &mass * (x * x + z * z);
    *zz += &mass * (x * x + y * y);
    *xy -= &mass * (x * y);
    *yz -= &mass * (y * z);
    *xz -= &mass * (x * z);
}

/// Makes a joint count the other way.
fn reverse(case: &mut Case, joint: usize) {
    let joints: Vec<usize> = (0..case.robot.joints.len()).collect();
    for given in &mut case.states {
        let state = &mut given.state;
        for values in [&mut state.q, &mut state.qd, &mut state.qdd] {
            values[joint] = -values[joint];
        }
        for (quantity, values) in &mut given.known {
            let sizes = Sizes::whole(joints.len());
            for (index, value) in values.iter_mut().enumerate() {
                let over = quantity.joints(index, &joints, sizes);
                let times = over.filter(|at| *at == joint).count();
                if times % 2 == 1 {
                    *value = -*value;
                }
            }
        }
    }
}
