//! R of A = Q R, row after row, in memory that does not grow.
//!
//! A triangle and the next rows below it are reduced to a triangle by Householder's
//! reflections (Golub and Van Loan, *Matrix Computations*, 5.2; Demmel, Grigori, Hoemmen and
//! Langou 2012 on merging, TSQR). Normal equations would square the condition: of a
//! regressor with 1e8, which excitation gives easily, they know nothing any more.
//!
//! R is unique up to the signs of its rows. So the same rows in another order, in other
//! batches or merged from parts give the same R up to rounding.

use pulp::{Arch, Simd, WithSimd};

/// Rows that are reduced at once: with 40 columns they stay in the first cache.
const ROWS: usize = 64;
/// Sums are taken in as many parts, whatever vectors a processor has: the bits are the same.
const LANES: usize = 8;

/// Aligned: with vectors as wide as lines of a cache, a load that begins within a line takes two.
#[derive(Clone, Debug, PartialEq)]
#[repr(align(64))]
struct Rows([f64; ROWS]);

/// The triangular factor of a matrix that is given row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct Triangle {
    columns: usize,
    /// R, row by row, whole rows.
    r: Vec<f64>,
    /// Rows to come, column by column.
    block: Vec<Rows>,
    filled: usize,
}

impl Triangle {
    /// Returns the factor of a matrix that has no rows yet.
    pub fn new(columns: usize) -> Triangle {
        Triangle {
            columns,
            r: vec![0.0; columns * columns],
            block: vec![Rows([0.0; ROWS]); columns],
            filled: 0,
        }
    }

    /// Returns the number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Adds a row; of missing values zeros, surplus ones are not read.
    pub fn push(&mut self, row: impl IntoIterator<Item = f64>) {
        for (column, value) in self.block.iter_mut().zip(row) {
            column.0[self.filled] = value;
        }
        self.filled += 1;
        if self.filled == ROWS {
            self.absorb();
        }
    }

    /// Adds rows that are given column by column, all columns of one length.
    pub fn push_columns(&mut self, columns: &[&[f64]]) {
        let rows = columns.first().map_or(0, |column| column.len());
        let mut next = 0;
        while next < rows {
            let count = (ROWS - self.filled).min(rows - next);
            for (block, column) in self.block.iter_mut().zip(columns) {
                let place = &mut block.0[self.filled..self.filled + count];
                place.copy_from_slice(&column[next..next + count]);
            }
            next += count;
            self.filled += count;
            if self.filled == ROWS {
                self.absorb();
            }
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

    /// Returns the factor of which R is this, row by row and whole rows.
    pub fn of(columns: usize, r: Vec<f64>) -> Triangle {
        Triangle {
            r,
            ..Triangle::new(columns)
        }
    }

    fn absorb(&mut self) {
        if self.filled > 0 {
            Arch::new().dispatch(Reflection {
                columns: self.columns,
                r: &mut self.r,
                block: &mut self.block,
            });
            self.block.fill(Rows([0.0; ROWS]));
            self.filled = 0;
        }
    }
}

/// A call of [`reflect`] that is inlined into code for the vectors of the processor: a closure
/// is too large for it, and stays as narrow as all processors have it.
struct Reflection<'a> {
    columns: usize,
    r: &'a mut [f64],
    block: &'a mut [Rows],
}

impl WithSimd for Reflection<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        reflect(self.columns, self.r, self.block);
    }
}

/// The block is left without meaning. Loops are over places of arrays and not over iterators, whose
/// calls are not always inlined into code for wider vectors.
#[inline(always)]
fn reflect(columns: usize, r: &mut [f64], block: &mut [Rows]) {
    for j in 0..columns {
        let (front, rest) = block.split_at_mut(j + 1);
        let tail = &front[j].0;
        let row = &mut r[j * columns + j..(j + 1) * columns];
        let square = dot(tail, tail);
        if square == 0.0 {
            continue;
        }
        let size = libm::sqrt(row[0] * row[0] + square);
        let head = row[0] + if row[0] > 0.0 { size } else { -size };
        row[0] -= head;
        // H = 1 − 2 v vᵀ / vᵀv with v = (head, tail).
        let scale = 2.0 / (head * head + square);
        for k in 0..columns - j - 1 {
            let (entry, column) = (&mut row[k + 1], &mut rest[k].0);
            let weight = scale * (head * *entry + dot(tail, column));
            *entry -= weight * head;
            let mut i = 0;
            while i < ROWS {
                column[i] -= weight * tail[i];
                i += 1;
            }
        }
    }
}

#[inline(always)]
fn dot(a: &[f64; ROWS], b: &[f64; ROWS]) -> f64 {
    let mut sums = [0.0; LANES];
    let mut i = 0;
    while i < ROWS {
        let mut lane = 0;
        while lane < LANES {
            sums[lane] += a[i + lane] * b[i + lane];
            lane += 1;
        }
        i += LANES;
    }
    let [a, b, c, d, e, f, g, h] = sums;
    ((a + e) + (c + g)) + ((b + f) + (d + h))
}
