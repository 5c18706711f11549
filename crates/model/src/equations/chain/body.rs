//! Rigid bodies by their moments about a frame's origin.

use super::{Rotation, apply};
use crate::equations::matrix::*;
use crate::equations::{Link, SinCosPair};
use crate::robot::Inertia;
use crate::scalar::Scalar;

/// ∫ dm, ∫ r dm and ∫ r rᵀ dm, a pseudo-inertia by its parts; a regrouped mass may be negative.
#[derive(Clone, Debug)]
pub struct MomentBody<S> {
    /// ∫ dm
    pub mass: S,
    /// ∫ r dm
    pub first: Vector<S>,
    /// ∫ r rᵀ dm
    pub second: Inertia<S>,
}

impl<S> MomentBody<S> {
    /// Returns every number through `f`.
    pub fn map<T>(&self, mut f: impl FnMut(&S) -> T) -> MomentBody<T> {
        MomentBody {
            mass: f(&self.mass),
            first: self.first.each_ref().map(&mut f),
            second: self.second.map(&mut f),
        }
    }
}

impl<S: Scalar> MomentBody<S> {
    /// Returns nothing.
    pub fn zero() -> Self {
        MomentBody {
            mass: S::zero(),
            first: zero_vector(),
            second: Inertia::symmetric(|_, _| S::zero()),
        }
    }

    /// Returns a link about its frame's origin: ∫ r rᵀ dm = ½ tr(I)·1 − I + m s̄ s̄ᵀ, I about s̄.
    pub fn of(link: &Link<S>) -> Self {
        let tensor = &link.inertia;
        let half = plus(&plus(&tensor.xx, &tensor.yy), &tensor.zz).half();
        let first = scaled(&link.mass, &link.com);
        let second = Inertia::symmetric(|i, j| {
            let about_centre = match i == j {
                true => minus(&half, entry(tensor, i, i)),
                false => negative(entry(tensor, i, j)),
            };
            plus(&about_centre, &times(&first[i], &link.com[j]))
        });
        MomentBody {
            mass: link.mass.clone(),
            first,
            second,
        }
    }

    /// Returns the tensor about the same origin: I = tr(Σ)·1 − Σ.
    pub fn tensor(&self) -> Inertia<S> {
        let sigma = &self.second;
        Inertia {
            xx: plus(&sigma.yy, &sigma.zz),
            yy: plus(&sigma.xx, &sigma.zz),
            zz: plus(&sigma.xx, &sigma.yy),
            xy: negative(&sigma.xy),
            yz: negative(&sigma.yz),
            xz: negative(&sigma.xz),
        }
    }

    /// True if turning it about z changes nothing, by structure.
    pub fn is_axisymmetric(&self) -> bool {
        let ([x, y, _], second) = (&self.first, &self.second);
        let across = minus(&second.xx, &second.yy);
        let odd = [x, y, &second.xy, &second.yz, &second.xz, &across];
        odd.into_iter().all(S::is_zero)
    }

    /// Returns both together, about the same origin and in the same axes.
    pub fn with(&self, other: &MomentBody<S>) -> Self {
        let both = |i: usize, j: usize| plus(entry(&self.second, i, j), entry(&other.second, i, j));
        MomentBody {
            mass: plus(&self.mass, &other.mass),
            first: sum(&self.first, &other.first),
            second: Inertia::symmetric(both),
        }
    }

    /// Returns the body with the opposite sign.
    pub fn negated(&self) -> Self {
        self.map(negative)
    }

    /// Returns it as seen from a frame in which this one is turned, then moved.
    pub fn carried(&self, rotation: &Rotation<S>, offset: &Vector<S>) -> Self {
        self.turned(rotation).moved(offset)
    }

    /// Returns it in other axes: r → R r.
    pub fn turned(&self, rotation: &Rotation<S>) -> Self {
        let second = match rotation.iter().flatten().any(S::is_zero) {
            true => turned_by_rows(&self.second, rotation),
            false => turned_by_products(&self.second, rotation),
        };
        MomentBody {
            mass: self.mass.clone(),
            first: apply(rotation, &self.first),
            second,
        }
    }

    /// Returns it about another origin: r → r + p.
    pub fn moved(&self, offset: &Vector<S>) -> Self {
        let first = sum(&self.first, &scaled(&self.mass, offset));
        MomentBody {
            mass: self.mass.clone(),
            // ∫ (r + p)(r + p)ᵀ = Σ + s pᵀ + p (s + m p)ᵀ
            second: Inertia::symmetric(|i, j| {
                let term = times(&self.first[i], &offset[j]);
                let mixed = plus(&term, &times(&offset[i], &first[j]));
                plus(entry(&self.second, i, j), &mixed)
            }),
            first,
        }
    }

    /// Returns it turned about z by a variable angle. With k = s·(Σxx − Σyy) + 2c·Σxy: Σxx′ = Σxx
    /// − s·k, Σyy′ = Σyy + s·k, Σxy′ = c·k − Σxy.
    pub fn turned_z(&self, theta: &SinCosPair<S>) -> Self {
        let (s, c, old) = (&theta.sin, &theta.cos, &self.second);
        let [x, y] = theta.turn(&self.first[0], &self.first[1]);
        let [xz, yz] = theta.turn(&old.xz, &old.yz);
        let across = times(s, &minus(&old.xx, &old.yy));
        let k = plus(&across, &times(c, &twice(&old.xy)));
        let shift = times(s, &k);
        MomentBody {
            mass: self.mass.clone(),
            first: [x, y, self.first[2].clone()],
            second: Inertia {
                xx: minus(&old.xx, &shift),
                yy: plus(&old.yy, &shift),
                zz: old.zz.clone(),
                xy: minus(&times(c, &k), &old.xy),
                yz,
                xz,
            },
        }
    }

    /// Returns Σ v
    pub fn second_times(&self, v: &Vector<S>) -> Vector<S> {
        tensor_times(&self.second, v)
    }

    /// Returns it in another unit of length: torques keep their numbers, masses get its square.
    pub fn in_unit(&self, unit: &S) -> Self {
        MomentBody {
            mass: times(unit, &times(unit, &self.mass)),
            first: scaled(unit, &self.first),
            second: self.second.clone(),
        }
    }
}

/// Returns R Σ Rᵀ.
fn turned_by_rows<S: Scalar>(tensor: &Inertia<S>, rotation: &Rotation<S>) -> Inertia<S> {
    let columns = tensor.rows();
    let row = |axis: &Vector<S>| columns.each_ref().map(|column| dot(axis, column));
    let half = rotation.each_ref().map(row);
    Inertia::symmetric(|i, j| dot(&half[i], &rotation[j]))
}

/// Returns R Σ Rᵀ by products of R's entries, which are constants where R is: of Σ − Σzz·1, which has
/// five entries, and whose trace says the last one.
fn turned_by_products<S: Scalar>(tensor: &Inertia<S>, rotation: &Rotation<S>) -> Inertia<S> {
    let zz = &tensor.zz;
    let across = [minus(&tensor.xx, zz), minus(&tensor.yy, zz)];
    let mixed = [(0, 1), (0, 2), (1, 2)];
    let part = |p: usize, q: usize| {
        let (p, q) = (&rotation[p], &rotation[q]);
        let [x, y] = [0, 1].map(|a| times(&times(&p[a], &q[a]), &across[a]));
        mixed.iter().fold(plus(&x, &y), |total, &(a, b)| {
            let both = plus(&times(&p[a], &q[b]), &times(&p[b], &q[a]));
            plus(&total, &times(&both, entry(tensor, a, b)))
        })
    };
    let [x, y] = [part(0, 0), part(1, 1)];
    let trace = plus(&across[0], &across[1]);
    let last = minus(&minus(&trace, &x), &y);
    let diagonal = [x, y, last].map(|excess| plus(&excess, zz));
    Inertia::symmetric(|i, j| match i == j {
        true => diagonal[i].clone(),
        false => part(i, j),
    })
}

/// Returns the entry (i, j) of a symmetric tensor.
pub fn entry<S>(tensor: &Inertia<S>, i: usize, j: usize) -> &S {
    match (i.min(j), i.max(j)) {
        (0, 0) => &tensor.xx,
        (1, 1) => &tensor.yy,
        (2, 2) => &tensor.zz,
        (0, 1) => &tensor.xy,
        (1, 2) => &tensor.yz,
        _ => &tensor.xz,
    }
}
