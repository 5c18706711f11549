//! Products of 3-vectors and of the matrices of a chain, aware of structural zeros.
//!
//! A product with a factor that is zero or one *by structure* is not made ([`Scalar::is_zero`],
//! [`Scalar::is_one`]), and shapes known beforehand are never spelled out as numbers: the last row
//! of a homogeneous matrix, the permutation Q_i, a rotation about one axis. A general matrix
//! product would pay for all of them and falsify every operation count.

use alloc::vec::Vec;

use super::SinCosPair;
use crate::robot::{Inertia, JointKind};
use crate::scalar::Scalar;
pub use crate::scalar::structural::{halved, minus, negative, over, plus, times, twice};

/// A vector of three components.
pub type Vector<S> = [S; 3];

/// The rows of a matrix.
pub type Matrix<S> = Vec<Vec<S>>;

/// As `core::array::from_fn`, whose machinery takes ten times as long to compile.
pub(crate) fn three<T>(mut component: impl FnMut(usize) -> T) -> [T; 3] {
    [component(0), component(1), component(2)]
}

/// Returns the zero vector.
pub fn zero_vector<S: Scalar>() -> Vector<S> {
    [S::zero(), S::zero(), S::zero()]
}

/// Returns the axis z_0.
pub fn unit_z<S: Scalar>() -> Vector<S> {
    [S::zero(), S::zero(), S::one()]
}

/// Returns the matrix 1.
pub fn identity<S: Scalar>() -> [Vector<S>; 3] {
    three(|i| three(|k| if i == k { S::one() } else { S::zero() }))
}

/// Returns Mᵀ
pub fn transposed<S: Clone>(matrix: &[Vector<S>; 3]) -> [Vector<S>; 3] {
    three(|i| three(|k| matrix[k][i].clone()))
}

/// Returns `n` zeros.
pub fn zeros<S: Scalar>(n: usize) -> Vec<S> {
    (0..n).map(|_| S::zero()).collect()
}

pub(super) fn unit<S: Scalar>(n: usize, k: usize) -> Vec<S> {
    let mut e = zeros(n);
    e[k] = S::one();
    e
}

/// Returns the first three and the last three components of six.
pub(super) fn parts<S: Clone>(six: &[S]) -> [Vector<S>; 2] {
    [0, 3].map(|from| three(|i| six[from + i].clone()))
}

pub(super) fn product<S: Scalar>(a: &[S], b: &[S]) -> S {
    total(a.iter().zip(b).map(|(a, b)| times(a, b)))
}

/// Returns a x for each row a.
pub fn products<S: Scalar>(rows: &[Vec<S>], x: &[S]) -> Vec<S> {
    rows.iter().map(|row| product(row, x)).collect()
}

pub(crate) fn sums<S: Scalar>(a: &[S], b: &[S]) -> Vec<S> {
    a.iter().zip(b).map(|(a, b)| plus(a, b)).collect()
}

pub(crate) fn differences<S: Scalar>(a: &[S], b: &[S]) -> Vec<S> {
    a.iter().zip(b).map(|(a, b)| minus(a, b)).collect()
}

pub(crate) fn matrix<S>(n: usize, m: usize, entry: impl Fn(usize, usize) -> S) -> Matrix<S> {
    let row = |i: usize| (0..m).map(|k| entry(i, k)).collect();
    (0..n).map(row).collect()
}

pub(super) fn matrix_sum<S: Scalar>(a: &[Vec<S>], b: &[Vec<S>]) -> Matrix<S> {
    a.iter().zip(b).map(|(a, b)| sums(a, b)).collect()
}

pub(super) fn zero_matrix<S: Scalar>(n: usize) -> Matrix<S> {
    alloc::vec![zeros(n); n]
}

/// Makes an entry a joint from the hand inward, and returns them from the base on.
pub(super) fn from_hand<J, T>(
    joints: impl DoubleEndedIterator<Item = J>,
    make: impl FnMut(J) -> T,
) -> Vec<T> {
    let mut entries: Vec<T> = joints.rev().map(make).collect();
    entries.reverse();
    entries
}

pub(crate) fn columns_of<S: Clone>(rows: &[Vec<S>]) -> Matrix<S> {
    let length = rows.first().map_or(0, Vec::len);
    matrix(length, rows.len(), |k, i| rows[i][k].clone())
}

/// Returns the sum of terms, the first two first.
pub fn total<S: Scalar>(terms: impl Iterator<Item = S>) -> S {
    terms.fold(S::zero(), |total, term| plus(&total, &term))
}

/// Returns an n×n matrix from its lower half: each entry (i, k), k ≤ i, is made once.
pub fn symmetric<S: Clone>(n: usize, entry: impl Fn(usize, usize) -> S) -> Matrix<S> {
    of_lower_half(n, &entry)
}

// Compiled once for each scalar, not for each entry's formula.
fn of_lower_half<S: Clone>(n: usize, entry: &dyn Fn(usize, usize) -> S) -> Matrix<S> {
    let row = |i: usize| (0..=i).map(|k| entry(i, k)).collect();
    let lower: Matrix<S> = (0..n).map(row).collect();
    matrix(n, n, |i, k| lower[i.max(k)][i.min(k)].clone())
}

/// Returns `[i][m][k]`, symmetric in m and k.
pub(super) fn symmetric_each<S: Clone>(
    n: usize,
    entry: impl Fn(usize, usize, usize) -> S,
) -> Vec<Matrix<S>> {
    let slice = |i: usize| symmetric(n, |m, k| entry(i, m, k));
    (0..n).map(slice).collect()
}

/// Returns a + b
pub fn sum<S: Scalar>(a: &Vector<S>, b: &Vector<S>) -> Vector<S> {
    three(|i| plus(&a[i], &b[i]))
}

/// Returns a − b
pub fn difference<S: Scalar>(a: &Vector<S>, b: &Vector<S>) -> Vector<S> {
    three(|i| minus(&a[i], &b[i]))
}

/// Returns −a
pub fn opposite<S: Scalar>(a: &Vector<S>) -> Vector<S> {
    three(|i| negative(&a[i]))
}

/// Returns s a
pub fn scaled<S: Scalar>(s: &S, a: &Vector<S>) -> Vector<S> {
    three(|i| times(s, &a[i]))
}

/// Returns a · b
pub fn dot<S: Scalar>(a: &Vector<S>, b: &Vector<S>) -> S {
    let xy = plus(&times(&a[0], &b[0]), &times(&a[1], &b[1]));
    plus(&xy, &times(&a[2], &b[2]))
}

/// Returns a × b
pub fn cross<S: Scalar>(a: &Vector<S>, b: &Vector<S>) -> Vector<S> {
    let component = |i: usize, j: usize| minus(&times(&a[i], &b[j]), &times(&a[j], &b[i]));
    [component(1, 2), component(2, 0), component(0, 1)]
}

/// Returns a × (s z_0), z_0 = (0, 0, 1)ᵀ.
pub fn cross_z<S: Scalar>(a: &Vector<S>, s: &S) -> Vector<S> {
    [times(&a[1], s), negative(&times(&a[0], s)), S::zero()]
}

pub(super) fn across_z<S: Scalar>(a: &Vector<S>) -> Vector<S> {
    [a[1].clone(), negative(&a[0]), S::zero()]
}

pub(super) fn z_across<S: Scalar>(a: &Vector<S>) -> Vector<S> {
    [negative(&a[1]), a[0].clone(), S::zero()]
}

/// Returns ω × (ω × a), the centripetal acceleration of the point a.
pub fn centripetal<S: Scalar>(omega: &Vector<S>, a: &Vector<S>) -> Vector<S> {
    cross(omega, &cross(omega, a))
}

/// Returns I a for a symmetric tensor.
pub fn tensor_times<S: Scalar>(tensor: &Inertia<S>, a: &Vector<S>) -> Vector<S> {
    let rows = tensor.rows();
    three(|i| dot(&rows[i], a))
}

/// The two axes that a turn about x moves, the first towards the second.
pub(super) const ABOUT_X: [usize; 2] = [1, 2];
pub(super) const ABOUT_Y: [usize; 2] = [2, 0];
pub(super) const ABOUT_Z: [usize; 2] = [0, 1];

impl<S: Scalar> SinCosPair<S> {
    /// Returns the pair of no turn.
    pub fn straight() -> Self {
        let (sin, cos) = (S::zero(), S::one());
        SinCosPair { sin, cos }
    }

    /// Returns the pair of the opposite angle.
    pub fn reversed(&self) -> Self {
        let (sin, cos) = (self.sin.neg(), self.cos.clone());
        SinCosPair { sin, cos }
    }

    pub(super) fn turn_in(&self, [i, j]: [usize; 2], mut v: Vector<S>) -> Vector<S> {
        [v[i], v[j]] = self.turn(&v[i], &v[j]);
        v
    }

    pub(super) fn turn_back_in(&self, [i, j]: [usize; 2], mut v: Vector<S>) -> Vector<S> {
        [v[i], v[j]] = self.turn_back(&v[i], &v[j]);
        v
    }

    /// Returns the plane rotation by this angle: (c x − s y, s x + c y).
    pub fn turn(&self, x: &S, y: &S) -> [S; 2] {
        [
            minus(&times(&self.cos, x), &times(&self.sin, y)),
            plus(&times(&self.sin, x), &times(&self.cos, y)),
        ]
    }

    /// Returns the inverse of [`SinCosPair::turn`]: (c x + s y, c y − s x).
    pub fn turn_back(&self, x: &S, y: &S) -> [S; 2] {
        [
            plus(&times(&self.cos, x), &times(&self.sin, y)),
            minus(&times(&self.cos, y), &times(&self.sin, x)),
        ]
    }
}

/// The first three rows of a 4×4 matrix of the chain, as four columns.
///
/// The last row is constant: (0 0 0 1) for a pose ⁰A_i, zero for a derivative U_ij or U_ijk.
/// Everything below multiplies **from the right**, by a homogeneous matrix or by Q_i, where both
/// obey the same formulas, so that the last row need not be kept.
#[derive(Clone, Debug)]
pub struct Columns<S> {
    /// Columns 1 to 3, the rotation of a pose.
    pub axes: [Vector<S>; 3],
    /// Column 4, the origin of a pose.
    pub origin: Vector<S>,
}

impl<S> Columns<S> {
    /// Returns every entry through `f`.
    pub fn map<T>(&self, mut f: impl FnMut(&S) -> T) -> Columns<T> {
        let mut of = |[x, y, z]: &Vector<S>| [f(x), f(y), f(z)];
        let axes = self.axes.each_ref().map(&mut of);
        let origin = of(&self.origin);
        Columns { axes, origin }
    }
}

impl<S: Scalar> Columns<S> {
    /// Returns the pose 1.
    pub fn identity() -> Self {
        Columns::turned(identity())
    }

    /// Returns the matrix 0.
    pub(super) fn nothing() -> Self {
        Columns::turned(three(|_| zero_vector()))
    }

    pub(super) fn turned(axes: [Vector<S>; 3]) -> Self {
        let origin = zero_vector();
        Columns { axes, origin }
    }

    /// Returns · Rz(θ)
    pub fn turn_z(self, theta: &SinCosPair<S>) -> Self {
        self.turn_in(theta, ABOUT_Z)
    }

    /// Returns · Rx(α)
    pub fn turn_x(self, alpha: &SinCosPair<S>) -> Self {
        self.turn_in(alpha, ABOUT_X)
    }

    /// Returns · Ry(β)
    pub fn turn_y(self, beta: &SinCosPair<S>) -> Self {
        self.turn_in(beta, ABOUT_Y)
    }

    /// Returns two columns x and y times a plane rotation: (c x + s y, c y − s x).
    fn turn_in(mut self, angle: &SinCosPair<S>, [x, y]: [usize; 2]) -> Self {
        for row in 0..3 {
            let turned = angle.turn_back(&self.axes[x][row], &self.axes[y][row]);
            [self.axes[x][row], self.axes[y][row]] = turned;
        }
        self
    }

    /// Returns · Tz(d)
    pub fn shift_z(self, d: &S) -> Self {
        let origin = sum(&self.origin, &scaled(d, &self.axes[2]));
        Columns { origin, ..self }
    }

    /// Returns · Tx(a)
    pub fn shift_x(self, a: &S) -> Self {
        let origin = sum(&self.origin, &scaled(a, &self.axes[0]));
        Columns { origin, ..self }
    }

    /// Returns · Q_i, the derivative by the joint here: (y, −x, 0, 0) if it turns, or (0, 0, 0, z).
    pub fn derive(&self, kind: JointKind) -> Self {
        let [x, y, z] = &self.axes;
        match kind {
            JointKind::Revolute => Columns::turned([y.clone(), opposite(x), zero_vector()]),
            JointKind::Prismatic => Columns {
                axes: three(|_| zero_vector()),
                origin: z.clone(),
            },
        }
    }

    /// Returns · the pose of a frame that is fixed in the last one.
    pub fn then(&self, next: &Self) -> Self {
        let axes = three(|i| self.rotate(&next.axes[i]));
        let origin = self.apply(&next.origin, &S::one());
        Columns { axes, origin }
    }

    /// Returns the entries row by row, 3×4.
    pub fn rows(&self) -> Vec<S> {
        let columns = || self.axes.iter().chain([&self.origin]);
        let row = |row: usize| columns().map(move |column| column[row].clone());
        (0..3).flat_map(row).collect()
    }

    /// Returns the rotation's columns applied to a vector of the last frame.
    pub fn rotate(&self, a: &Vector<S>) -> Vector<S> {
        let [x, y, z] = &self.axes;
        let xy = sum(&scaled(&a[0], x), &scaled(&a[1], y));
        sum(&xy, &scaled(&a[2], z))
    }

    /// Returns the rotation's inverse applied: components along the three columns.
    pub fn rotate_back(&self, a: &Vector<S>) -> Vector<S> {
        three(|i| dot(&self.axes[i], a))
    }

    /// Returns the matrix times (a, s)ᵀ: s = 1 takes a point of the last frame along.
    pub fn apply(&self, a: &Vector<S>, s: &S) -> Vector<S> {
        sum(&self.rotate(a), &scaled(s, &self.origin))
    }

    /// Returns R T Rᵀ: a symmetric tensor of the last frame, in the axes of this one.
    pub fn turn_tensor(&self, tensor: &Inertia<S>) -> Inertia<S> {
        let rows = tensor.rows();
        let half = transposed(&three(|i| self.rotate(&rows[i])));
        // (R T) Rᵀ, row by row: T is symmetric, so its rows were its columns.
        let turned = three(|i| self.rotate(&half[i]));
        Inertia::symmetric(|i, k| turned[i][k].clone())
    }

    /// Returns the sum of matrices, each times a number.
    pub fn combination<'a>(terms: impl Iterator<Item = (S, &'a Self)>) -> Self
    where
        S: 'a,
    {
        terms.fold(Columns::nothing(), |total, (s, columns)| Columns {
            axes: three(|i| sum(&total.axes[i], &scaled(&s, &columns.axes[i]))),
            origin: sum(&total.origin, &scaled(&s, &columns.origin)),
        })
    }

    /// Tr(M Nᵀ), the sum of the products of equal entries.
    pub fn trace_with(&self, other: &Self) -> S {
        let axes = self.axes.iter().zip(&other.axes);
        axes.fold(dot(&self.origin, &other.origin), |trace, (a, b)| {
            plus(&trace, &dot(a, b))
        })
    }
}
