//! Generalized D'Alembert, eqs. 4.1–4.5: closed forms with the rotation and
//! the translation of every link apart.
//!
//! The paper treats rotary joints; the prismatic terms follow in the same way. All vectors are in
//! base axes but those that meet an inertia tensor, which are in the axes of its link.

use alloc::vec::Vec;

use super::lagrange_euler::{add_armature, assemble};
use super::matrix::*;
use super::{Arm, At, Link};
use crate::robot::{Convention, JointKind};
use crate::scalar::Scalar;

/// A part of what moves with a link: an arm, whose D and h may come from any formulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Part {
    /// Its rotation, through I_s and its angular velocity: a link without mass.
    Rotation,
    /// The translation of its centre of mass, through m_s: all mass is there.
    Translation,
}

impl Part {
    /// Returns the arm whose links have this alone; drives left out.
    pub fn of<S: Scalar>(self, arm: &Arm<S>) -> Arm<S> {
        let mut arm = arm.clone().without_friction();
        for link in &mut arm.links {
            link.armature = S::zero();
            match self {
                Part::Rotation => link.mass = S::zero(),
                Part::Translation => link.inertia = link.inertia.map(|_| S::zero()),
            }
        }
        arm
    }
}

/// Axes, levers and Jacobians at one position, which all terms share.
#[derive(Clone, Debug)]
pub struct Dalembert<'a, S> {
    arm: &'a Arm<S>,
    /// ⁰A_s for s = 0 … n.
    poses: Vec<Columns<S>>,
    /// The axis of joint i in base axes: z_{i−1}, or z_i in modified DH.
    axes: Vec<Vector<S>>,
    /// A point of that axis: p_{i−1}, or p_i in modified DH.
    points: Vec<Vector<S>>,
    /// p_s* = p_s − p_{s−1}
    levers: Vec<Vector<S>>,
    /// s̄_s in base axes.
    coms: Vec<Vector<S>>,
    /// `local[s][i]` = ˢR_0 Jω_{s,i}, i ≤ s: the axis of a rotary joint i in frame s, or zero.
    local: Vec<Vec<Vector<S>>>,
    /// `momentum[s][i]` = m_s Jv_{s,i}, i ≤ s.
    momentum: Vec<Vec<Vector<S>>>,
    /// `jv[s][i]` = Jv_{s,i}, i ≤ s.
    jv: Vec<Vec<Vector<S>>>,
}

impl<'a, S: Scalar> Dalembert<'a, S> {
    /// Returns the shared quantities at a position.
    pub fn new(arm: &'a Arm<S>, at: &'a At<S>) -> Self {
        let n = arm.links.len();
        let mut this = Dalembert {
            arm,
            poses: alloc::vec![Columns::identity()],
            axes: Vec::with_capacity(n),
            points: Vec::with_capacity(n),
            levers: Vec::with_capacity(n),
            coms: Vec::with_capacity(n),
            local: Vec::with_capacity(n),
            momentum: Vec::with_capacity(n),
            jv: Vec::with_capacity(n),
        };
        for s in 0..n {
            this.append(s, at);
        }
        this
    }

    fn append(&mut self, s: usize, at: &At<S>) {
        let (link, convention) = (&self.arm.links[s], self.arm.convention);
        let carrier = self.arm.carrier(s);
        let before = &self.poses[carrier.map_or(0, |carrier| carrier + 1)];
        let step = self.arm.step(s, at);
        let moved = step.append(&Columns::turned(before.axes.clone()));
        let (axes, origin) = (moved.axes, sum(&before.origin, &moved.origin));
        let pose = Columns { axes, origin };
        let joint = step.at_joint(before, &pose);
        self.axes.push(joint.axes[2].clone());
        self.points.push(joint.origin.clone());
        self.levers.push(moved.origin);
        let com = pose.rotate(&link.com);

        let z0 = unit_z();
        let earlier = carrier.map_or(&[][..], |carrier| &self.local[carrier][..]);
        let mut local: Vec<_> = earlier.iter().map(|z| step.to_link(z)).collect();
        // Joints on other branches do not move the link.
        local.resize(s, zero_vector());
        local.push(match (link.kind, convention) {
            (JointKind::Prismatic, _) => zero_vector(),
            (JointKind::Revolute, Convention::Standard) => step.to_link(&z0),
            (JointKind::Revolute, Convention::Modified) => z0,
        });
        // r_s, then Jv_{s,i} = z × (r_s − p), or z for a prismatic joint.
        let centre = sum(&pose.origin, &com);
        let mut jv = alloc::vec![zero_vector(); s + 1];
        for i in self.arm.way(s) {
            jv[i] = match self.arm.links[i].kind {
                JointKind::Revolute => cross(&self.axes[i], &difference(&centre, &self.points[i])),
                JointKind::Prismatic => self.axes[i].clone(),
            };
        }
        let momentum = jv.iter().map(|v| scaled(&link.mass, v));
        self.momentum.push(momentum.collect());
        self.jv.push(jv);
        self.local.push(local);
        self.coms.push(com);
        self.poses.push(pose);
    }

    /// Returns D^rot_ij = Σ_s (ˢR_0 z_{i−1})ᵀ I_s (ˢR_0 z_{j−1}) and D^tran_ij =
    /// Σ_s m_s Jv_{s,j} · Jv_{s,i}, s ≥ max(i,j) (eq. 4.2), no armature, in the order of [`Part`].
    pub fn inertia_parts(&self) -> [Matrix<S>; 2] {
        let spin = |(row, link): (&Vec<Vector<S>>, &Link<S>)| {
            row.iter().map(|z| tensor_times(&link.inertia, z)).collect()
        };
        let spins: Vec<Vec<_>> = self.local.iter().zip(&self.arm.links).map(spin).collect();
        let rotation = pair_sums(&self.local, &spins);
        [rotation, pair_sums(&self.jv, &self.momentum)]
    }

    /// Returns D = D^rot + D^tran, n×n, armature on the diagonal.
    pub fn inertia(&self) -> Matrix<S> {
        let [rotation, translation] = self.inertia_parts();
        let mut d = matrix_sum(&rotation, &translation);
        add_armature(self.arm, &mut d);
        d
    }

    /// Returns h^rot and h^tran (eqs. 4.3, 4.4), each of length n, in the order of [`Part`].
    pub fn velocity_parts(&self, qd: &[S]) -> [Vec<S>; 2] {
        let n = self.axes.len();
        // Link s adds this to every joint before it: the moment
        // I_s ˢR_0 α_s + ˢR_0 ω_s × (I_s ˢR_0 ω_s), where α_s is the printed
        // sum of q̇_j q̇_k z_{j−1} × z_{k−1} and (z × ω)·Iω = z·(ω × Iω); and a_s.
        let mut moments = Vec::with_capacity(n);
        let mut accelerations = Vec::with_capacity(n);
        let at_rest = PassedMotion {
            omega: zero_vector(),
            alpha: zero_vector(),
            acceleration: zero_vector(),
        };
        self.arm.outward(&at_rest, |s, before: &PassedMotion<S>| {
            let (link, mut motion) = (&self.arm.links[s], before.clone());
            let rate = scaled(&qd[s], &self.axes[s]);
            if link.kind == JointKind::Revolute {
                motion.alpha = sum(&motion.alpha, &cross(&motion.omega, &rate));
                motion.omega = sum(&motion.omega, &rate);
            } else {
                let sliding = scaled(&twice(&qd[s]), &self.axes[s]);
                motion.acceleration = sum(&motion.acceleration, &cross(&motion.omega, &sliding));
            }
            let lever = &self.levers[s];
            accelerations.push(match self.arm.convention {
                Convention::Standard => {
                    // c̄_s = r_s − p_{s−1}
                    let centre = sum(lever, &self.coms[s]);
                    let acceleration = sum(&motion.acceleration, &motion.of(&centre));
                    if s + 1 < n {
                        motion.acceleration = sum(&motion.acceleration, &motion.of(lever));
                    }
                    acceleration
                }
                Convention::Modified => {
                    motion.acceleration = sum(&motion.acceleration, &before.of(lever));
                    sum(&motion.acceleration, &motion.of(&self.coms[s]))
                }
            });

            let pose = &self.poses[s + 1];
            let [omega, alpha] = [&motion.omega, &motion.alpha].map(|v| pose.rotate_back(v));
            let spin = cross(&omega, &tensor_times(&link.inertia, &omega));
            moments.push(sum(&tensor_times(&link.inertia, &alpha), &spin));
            motion
        });
        let rotation = joint_sums(&self.local, &moments);
        [rotation, joint_sums(&self.momentum, &accelerations)]
    }

    /// Returns h = h^rot + h^tran.
    pub fn velocity_terms(&self, qd: &[S]) -> Vec<S> {
        let [rotation, translation] = self.velocity_parts(qd);
        sums(&rotation, &translation)
    }

    /// Returns c_i = −g·[z_{i−1} × Σ_{j≥i} m_j (r_j − p_{i−1})] for a rotary joint,
    /// −(g·z_{i−1}) Σ_{j≥i} m_j for a prismatic one (eq. 4.5).
    pub fn gravity(&self) -> Vec<S> {
        let n = self.axes.len();
        let of = |i: usize| match self.arm.links[i].kind {
            JointKind::Revolute => {
                let moments = (i..n).map(|j| &self.momentum[j][i]);
                let moment = moments.fold(zero_vector(), |total, term| sum(&total, term));
                negative(&dot(&self.arm.gravity, &moment))
            }
            JointKind::Prismatic => {
                let beyond = (i..n).filter(|&j| self.arm.way(j).any(|link| link == i));
                let mass = total(beyond.map(|j| self.arm.links[j].mass.clone()));
                negative(&times(&dot(&self.arm.gravity, &self.axes[i]), &mass))
            }
        };
        (0..n).map(of).collect()
    }

    /// Returns τ_i = Σ_k D_ik q̈_k + h_i + c_i + b_i q̇_i (eq. 4.1).
    pub fn inverse_dynamics(&self, qd: &[S], qdd: &[S]) -> Vec<S> {
        let [h, c] = [self.velocity_terms(qd), self.gravity()];
        assemble(self.arm, &self.inertia(), &h, &c, qd, qdd)
    }
}

/// The motion that a link passes on: ω, the printed sum α, and the acceleration of its origin.
#[derive(Clone)]
struct PassedMotion<S> {
    omega: Vector<S>,
    alpha: Vector<S>,
    acceleration: Vector<S>,
}

impl<S: Scalar> PassedMotion<S> {
    /// Returns ω × (ω × v) + α × v.
    fn of(&self, v: &Vector<S>) -> Vector<S> {
        sum(&centripetal(&self.omega, v), &cross(&self.alpha, v))
    }
}

/// Returns [i][j] = Σ_{s ≥ max(i,j)} a[s][i] · b[s][j], symmetric by its meaning.
fn pair_sums<S: Scalar>(a: &[Vec<Vector<S>>], b: &[Vec<Vector<S>>]) -> Matrix<S> {
    let n = a.len();
    symmetric(n, |i, j| total((i..n).map(|s| dot(&a[s][i], &b[s][j]))))
}

fn joint_sums<S: Scalar>(a: &[Vec<Vector<S>>], b: &[Vector<S>]) -> Vec<S> {
    let n = b.len();
    let of_joint = |i: usize| total((i..n).map(|s| dot(&a[s][i], &b[s])));
    (0..n).map(of_joint).collect()
}
