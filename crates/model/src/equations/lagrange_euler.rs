//! Lagrange–Euler, eqs. 2.2–2.15: D, h_ikm and c from the derivatives of the poses.
//!
//! The formulas stand as written: every h_ikm with k ≤ m is a sum of traces, also those that are
//! zero for every arm. That makes this form the reference that everything else is proved against.
//!
//! Products with ʲ⁻¹A_i are taken one link at a time, U_ij = U_{i−1,j} ⁱ⁻¹A_i,
//! and U_ij J_i is kept: the same products, each made once.

use alloc::vec::Vec;

use super::matrix::*;
use super::{Arm, At, Link};
use crate::robot::Convention;
use crate::scalar::Scalar;

/// The derivatives of the poses at one position.
#[derive(Clone, Debug)]
pub struct LagrangeEuler<'a, S> {
    arm: &'a Arm<S>,
    at: &'a At<S>,
    /// ⁰A_i for i = 0 … n.
    poses: Vec<Columns<S>>,
    /// `u[i][j]` = U_ij for j ≤ i.
    u: Vec<Vec<Columns<S>>>,
    /// `uj[i][j]` = U_ij J_i for j ≤ i.
    uj: Vec<Vec<Columns<S>>>,
}

impl<'a, S: Scalar> LagrangeEuler<'a, S> {
    /// Returns the poses ⁰A_i, their derivatives U_ij and the products U_ij J_i.
    pub fn new(arm: &'a Arm<S>, at: &'a At<S>) -> Self {
        let n = arm.links.len();
        let mut poses = alloc::vec![Columns::identity()];
        let mut u: Vec<Vec<Columns<S>>> = Vec::with_capacity(n);
        for (i, step) in arm.steps(at).enumerate() {
            let append = |before: &Columns<S>| step.append(before);
            let carrier = arm.carrier(i);
            let before = &poses[carrier.map_or(0, |carrier| carrier + 1)];
            let pose = append(before);
            let earlier = carrier.map_or(&[][..], |carrier| &u[carrier][..]);
            let mut row: Vec<_> = earlier.iter().map(append).collect();
            // Joints on other branches do not move the link.
            row.resize(i, Columns::nothing());
            row.push(match step.convention {
                Convention::Standard => append(&before.derive(step.link.kind)),
                Convention::Modified => pose.derive(step.link.kind),
            });
            poses.push(pose);
            u.push(row);
        }
        let links = arm.links.iter().zip(&u);
        let uj = links.map(|(link, row)| {
            let j = PseudoInertia::of(link);
            row.iter().map(|u| j.after(u)).collect()
        });
        LagrangeEuler {
            arm,
            at,
            poses,
            uj: uj.collect(),
            u,
        }
    }

    /// Returns D_ik = Σ_{j ≥ max(i,k)} Tr(U_jk J_j U_jiᵀ), n×n, armature on the diagonal.
    pub fn inertia(&self) -> Matrix<S> {
        let n = self.arm.links.len();
        let mut d = symmetric(n, |i, k| {
            total((i..n).map(|j| self.u[j][k].trace_with(&self.uj[j][i])))
        });
        add_armature(self.arm, &mut d);
        d
    }

    /// Returns `h[i][k][m]` = h_ikm = Σ_{j ≥ max(i,k,m)} Tr(U_jkm J_j U_jiᵀ), n×n×n.
    pub fn christoffel(&self) -> Vec<Matrix<S>> {
        let n = self.arm.links.len();
        let second = self.second_derivatives();
        symmetric_each(n, |i, m, k| {
            total((i.max(m)..n).map(|j| second[j][m][k].trace_with(&self.uj[j][i])))
        })
    }

    /// Returns c_i = Σ_{j ≥ i} −m_j g U_ji s̃_j: what holds the arm against gravity.
    pub fn gravity(&self) -> Vec<S> {
        let n = self.arm.links.len();
        let load = |i: usize| {
            // The column of U_ji J_j that belongs to m_j s̃_j is U_ji m_j s̃_j.
            let moments = (i..n).map(|j| &self.uj[j][i].origin);
            let total = moments.fold(zero_vector(), |total, term| sum(&total, term));
            negative(&dot(&self.arm.gravity, &total))
        };
        (0..n).map(load).collect()
    }

    /// Returns λᵀ(D q̈ + h + c), with the sums over joints taken before those over links: of link j
    /// Tr(A J_j Vᵀ) − m_j g V s̃_j, A = Σ U_jk q̈_k + Σ U_jkm q̇_k q̇_m and V = Σ U_ji λ_i.
    pub fn virtual_power(&self, qd: &[S], qdd: &[S], multiplier: &[S]) -> S {
        let second = self.second_derivatives();
        let of_link = |(j, link): (usize, &Link<S>)| {
            let hessian = &second[j];
            let pairs = (0..=j).flat_map(|k| (0..=k).map(move |m| (k, m)));
            let centripetal = pairs.map(|(k, m)| {
                let rates = times(&qd[k], &qd[m]);
                let rates = if k == m { rates } else { twice(&rates) };
                (rates, &hessian[k][m])
            });
            let direct = qdd.iter().cloned().zip(&self.u[j]);
            let acceleration = Columns::combination(direct.chain(centripetal));
            let weights = multiplier.iter().cloned().zip(&self.uj[j]);
            let moved = Columns::combination(weights);
            let rotor = times(&link.armature, &times(&multiplier[j], &qdd[j]));
            let weight = dot(&self.arm.gravity, &moved.origin);
            plus(&minus(&acceleration.trace_with(&moved), &weight), &rotor)
        };
        total(self.arm.links.iter().enumerate().map(of_link))
    }

    /// Returns τ_i = Σ_k D_ik q̈_k + h_i + c_i + b_i q̇_i (eq. 2.3).
    pub fn inverse_dynamics(&self, qd: &[S], qdd: &[S]) -> Vec<S> {
        let h = velocity_terms(&self.christoffel(), qd);
        assemble(self.arm, &self.inertia(), &h, &self.gravity(), qd, qdd)
    }

    /// Returns `[i][k][j]` = U_ijk = U_ikj for j ≤ k ≤ i.
    fn second_derivatives(&self) -> Vec<Vec<Vec<Columns<S>>>> {
        let mut derivatives: Vec<Vec<Vec<Columns<S>>>> = Vec::with_capacity(self.u.len());
        for (i, step) in self.arm.steps(self.at).enumerate() {
            let append = |before: &Columns<S>| step.append(before);
            let appended = |row: &Vec<Columns<S>>| row.iter().map(append).collect();
            let carrier = self.arm.carrier(i);
            let earlier = carrier.map_or(&[][..], |carrier| &derivatives[carrier][..]);
            let mut of_link: Vec<Vec<Columns<S>>> = earlier.iter().map(appended).collect();
            let between = of_link.len()..i;
            of_link.extend(between.map(|k| alloc::vec![Columns::nothing(); k + 1]));
            // k = i: Q_i enters at the joint itself.
            let kind = step.link.kind;
            of_link.push(match step.convention {
                Convention::Standard => {
                    let derivative = self.poses[i].derive(kind);
                    let earlier = carrier.map_or(&[][..], |carrier| &self.u[carrier][..]);
                    let at_joint = earlier.iter().chain([&derivative]);
                    at_joint.map(|u| append(&u.derive(kind))).collect()
                }
                Convention::Modified => self.u[i].iter().map(|u| u.derive(kind)).collect(),
            });
            derivatives.push(of_link);
        }
        derivatives
    }
}

/// J_i = ∫ r̃ r̃ᵀ dm about the origin of frame i, r̃ = (x, y, z, 1)ᵀ.
///
/// In blocks [[S, m s̄], [m s̄ᵀ, m]] with S = ½tr(I_O)·1 − I_O and
/// I_O = I + m(s̄·s̄ 1 − s̄ s̄ᵀ), hence S = ½tr(I)·1 − I + m s̄ s̄ᵀ.
pub(super) struct PseudoInertia<S> {
    /// Columns of S.
    second: [Vector<S>; 3],
    /// m s̄
    first: Vector<S>,
    mass: S,
}

impl<S: Scalar> PseudoInertia<S> {
    pub(super) fn of(link: &Link<S>) -> Self {
        let i = &link.inertia;
        let first = scaled(&link.mass, &link.com);
        let half_trace = halved(&plus(&plus(&i.xx, &i.yy), &i.zz));
        let entry = |tensor: &S, r: usize, c: usize| {
            let central_moment = match r == c {
                true => minus(&half_trace, tensor),
                false => negative(tensor),
            };
            plus(&central_moment, &times(&first[r], &link.com[c]))
        };
        let [xy, yz, xz] = [entry(&i.xy, 0, 1), entry(&i.yz, 1, 2), entry(&i.xz, 0, 2)];
        let second = [
            [entry(&i.xx, 0, 0), xy.clone(), xz.clone()],
            [xy, entry(&i.yy, 1, 1), yz.clone()],
            [xz, yz, entry(&i.zz, 2, 2)],
        ];
        PseudoInertia {
            second,
            first,
            mass: link.mass.clone(),
        }
    }

    pub(super) fn after(&self, u: &Columns<S>) -> Columns<S> {
        let axes = three(|i| u.apply(&self.second[i], &self.first[i]));
        let origin = u.apply(&self.first, &self.mass);
        Columns { axes, origin }
    }
}

/// Returns h_i = Σ_k Σ_m h_ikm q̇_k q̇_m, the full double sum: a pair k < m counts twice.
pub fn velocity_terms<S: Scalar>(h: &[Matrix<S>], qd: &[S]) -> Vec<S> {
    let n = qd.len();
    let doubled: Vec<S> = qd.iter().map(twice).collect();
    let pairs = (0..n).flat_map(|k| (k..n).map(move |m| (k, m)));
    let products = pairs.map(|(k, m)| {
        let second = if m == k { &qd[m] } else { &doubled[m] };
        (k, m, times(&qd[k], second))
    });
    let rates: Vec<(usize, usize, S)> = products.collect();
    let of_joint = |h: &Matrix<S>| total(rates.iter().map(|(k, m, rate)| times(&h[*k][*m], rate)));
    h.iter().map(of_joint).collect()
}

/// Returns D q̈ + h + c + b∘q̇ from its parts.
pub(super) fn assemble<S: Scalar>(
    arm: &Arm<S>,
    d: &[Vec<S>],
    h: &[S],
    c: &[S],
    qd: &[S],
    qdd: &[S],
) -> Vec<S> {
    let torque = |i: usize| {
        let inertial = product(&d[i], qdd);
        let passive = plus(&h[i], &c[i]);
        let damping = arm.links[i].friction.torque(&qd[i]);
        plus(&plus(&inertial, &passive), &damping)
    };
    (0..arm.links.len()).map(torque).collect()
}

pub(super) fn add_armature<S: Scalar>(arm: &Arm<S>, d: &mut [Vec<S>]) {
    for (i, (row, link)) in d.iter_mut().zip(&arm.links).enumerate() {
        row[i] = plus(&row[i], &link.armature);
    }
}
