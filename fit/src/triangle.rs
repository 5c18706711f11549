//! R of A = Q R, row after row, in memory that does not grow.
//!
//! A triangle and the next rows below it are reduced to a triangle by Householder's
//! reflections (Golub and Van Loan, *Matrix Computations*, 5.2; Demmel, Grigori, Hoemmen and
//! Langou 2012 on merging, TSQR). Normal equations would square the condition: of a
//! regressor with 1e8, which excitation gives easily, they know nothing any more.
//!
//! R is unique up to the signs of its rows. So the same rows in another order, in other
//! batches or merged from parts give the same R up to rounding.

/// Rows that are reduced at once: with 40 columns they stay in the first cache.
const ROWS: usize = 64;
/// Sums are taken in as many parts, whatever vectors a processor has: the bits are the same.
const LANES: usize = 8;

/// The triangular factor of a matrix that is given row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct Triangle {
    columns: usize,
    /// R, row by row, whole rows.
    r: Vec<f64>,
    /// Rows to come, column by column.
    block: Vec<f64>,
    filled: usize,
}

impl Triangle {
    /// The factor of a matrix that has no rows yet.
    pub fn new(columns: usize) -> Triangle {
        Triangle {
            columns,
            r: vec![0.0; columns * columns],
            block: vec![0.0; columns * ROWS],
            filled: 0,
        }
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Adds a row; of missing values zeros, surplus ones are not read.
    pub fn push(&mut self, row: impl IntoIterator<Item = f64>) {
        let places = self.block[self.filled..].iter_mut().step_by(ROWS);
        for (place, value) in places.zip(row) {
            *place = value;
        }
        self.filled += 1;
        if self.filled == ROWS {
            self.absorb();
        }
    }

    /// Adds the rows of another factor, which stand for all that it was given.
    pub fn merge(&mut self, other: &Triangle) {
        let other = other.clone().reduced();
        for (i, row) in other.chunks(self.columns.max(1)).enumerate() {
            if row.iter().skip(i).any(|x| *x != 0.0) {
                self.push(row.iter().copied());
            }
        }
    }

    /// Returns R, row by row and whole rows, with a diagonal that is not negative.
    pub fn reduced(mut self) -> Vec<f64> {
        self.absorb();
        for (i, row) in self.r.chunks_mut(self.columns.max(1)).enumerate() {
            if row[i] < 0.0 {
                row.iter_mut().for_each(|x| *x = -*x);
            }
        }
        self.r
    }

    /// The factor of which R is this, row by row and whole rows.
    pub fn of(columns: usize, r: Vec<f64>) -> Triangle {
        Triangle {
            r,
            ..Triangle::new(columns)
        }
    }

    fn absorb(&mut self) {
        if self.filled > 0 {
            pulp::Arch::new().dispatch(|| reflect(self.columns, &mut self.r, &mut self.block));
            self.block.fill(0.0);
            self.filled = 0;
        }
    }
}

/// Reduces a triangle over a block of rows to a triangle; the block is left without meaning.
#[inline(always)]
fn reflect(columns: usize, r: &mut [f64], block: &mut [f64]) {
    let (block, _) = block.as_chunks_mut::<ROWS>();
    for j in 0..columns {
        let (own, rest) = block.split_at_mut(j + 1);
        let own = &own[j];
        let row = &mut r[j * columns + j..(j + 1) * columns];
        let square = dot(own, own);
        if square == 0.0 {
            continue;
        }
        let size = libm::sqrt(row[0] * row[0] + square);
        let head = if row[0] > 0.0 {
            row[0] + size
        } else {
            row[0] - size
        };
        row[0] -= head;
        // H = 1 − 2 v vᵀ / vᵀv with v = (head, own).
        let scale = 2.0 / (head * head + square);
        let entries = row[1..].iter_mut().zip(rest);
        for (entry, column) in entries {
            let weight = scale * (head * *entry + dot(own, column));
            *entry -= weight * head;
            for (x, v) in column.iter_mut().zip(own) {
                *x -= weight * v;
            }
        }
    }
}

#[inline(always)]
fn dot(a: &[f64; ROWS], b: &[f64; ROWS]) -> f64 {
    let mut sums = [0.0; LANES];
    let pairs = a
        .as_chunks::<LANES>()
        .0
        .iter()
        .zip(b.as_chunks::<LANES>().0);
    for (a, b) in pairs {
        for ((sum, a), b) in sums.iter_mut().zip(a).zip(b) {
            *sum += a * b;
        }
    }
    let [a, b, c, d, e, f, g, h] = sums;
    ((a + e) + (c + g)) + ((b + f) + (d + h))
}
