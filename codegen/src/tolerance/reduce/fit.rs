//! Terms fitted to the function: least squares, and the least largest error.
//!
//! The error at a position is what a certificate counts: every monomial in the rates at
//! its worst. Lawson's iteration finds the least largest one: least squares again and
//! again, each block of rows weighed by the error that it had; inside a block, whose
//! error is a sum of magnitudes, each row by the inverse of its own.

use super::terms::Terms;
use crate::tolerance::linear::{Factor, dot};

const ROUGH: usize = 12;
const FINE: usize = 24;

/// Errors of a row below this part of its block's largest weigh no more.
const FLOOR: f64 = 0.02;

pub(super) struct TermFit<'t> {
    pub terms: &'t Terms,
    block: usize,
    products: Vec<Vec<f64>>,
    sizes: Vec<f64>,
}

#[derive(Clone, Debug)]
pub(super) struct Solution {
    pub terms: Vec<usize>,
    pub factors: Vec<f64>,
    /// The largest error at the samples, one being the allowance.
    pub error: f64,
    pub saliency: Vec<f64>,
    /// (JᵀWJ)⁻¹
    pub inverse: Vec<Vec<f64>>,
}

impl<'t> TermFit<'t> {
    pub(super) fn new(terms: &'t Terms) -> TermFit<'t> {
        let (block, count) = (terms.samples.block(), terms.all.len());
        let mut columns: Vec<&[f64]> = terms.all.iter().map(|term| &term.column[..]).collect();
        columns.push(&terms.whole);
        let blocks = terms.whole.len() / block;
        let products = |index: usize| {
            let part = |column: usize| &columns[column][index * block..][..block];
            let mut products = Vec::with_capacity((count + 1) * (count + 2) / 2);
            for a in 0..=count {
                for b in 0..=a {
                    products.push(dot(part(a), part(b)));
                }
            }
            products
        };
        let products: Vec<Vec<f64>> = (0..blocks).map(products).collect();
        let size = |term: usize| {
            let place = at(term, term);
            let sum: f64 = products.iter().map(|products| products[place]).sum();
            sum.sqrt()
        };
        TermFit {
            terms,
            block,
            sizes: (0..count).map(size).collect(),
            products,
        }
    }

    pub(super) fn is_something(&self, term: usize) -> bool {
        self.sizes[term] > 1e-9 * largest(&self.sizes)
    }

    pub(super) fn solve(&self, terms: &[usize], enough: f64) -> Solution {
        let blocks = self.products.len();
        let mut weights = vec![1.0 / blocks as f64; blocks];
        let mut best: Option<Solution> = None;
        for _ in 0..ROUGH {
            let solution = self.weighed(terms, &weights);
            let errors = self.errors(terms, &solution.factors);
            let error = largest(&errors);
            if best.as_ref().is_none_or(|best| error < best.error) {
                best = Some(Solution { error, ..solution });
            }
            if error <= enough || error == 0.0 {
                break;
            }
            for (weight, block_error) in weights.iter_mut().zip(&errors) {
                *weight *= 0.02 + block_error / error;
            }
            let sum: f64 = weights.iter().sum();
            weights.iter_mut().for_each(|weight| *weight /= sum);
        }
        best.unwrap_or_else(|| self.weighed(terms, &weights))
    }

    pub(super) fn refine(&self, from: Solution, enough: f64) -> Solution {
        let terms = &from.terms.clone();
        let mut weights = vec![1.0; self.products.len()];
        let mut best = from;
        let mut now = best.factors.clone();
        for _ in 0..FINE {
            if best.error <= enough {
                break;
            }
            let residual = self.residual(terms, &now);
            let errors = self.of_blocks(&residual);
            let error = largest(&errors).max(f64::MIN_POSITIVE);
            for (weight, block_error) in weights.iter_mut().zip(&errors) {
                *weight *= 0.02 + block_error / error;
            }
            let most = largest(&weights);
            weights.iter_mut().for_each(|weight| *weight /= most);
            let rows = residual.chunks_exact(self.block).zip(&weights).zip(&errors);
            let rows: Vec<f64> = rows
                .flat_map(|((rows, weight), block_error)| {
                    let largest = rows.iter().fold(0.0, |m, x: &f64| x.abs().max(m));
                    let floor = (FLOOR * largest).max(1e-12);
                    rows.iter()
                        .map(move |x| weight * block_error.max(1e-12) / x.abs().max(floor))
                })
                .collect();
            now = self.least_squares(terms, &rows);
            let error = largest(&self.errors(terms, &now));
            if error < best.error {
                (best.factors, best.error) = (now.clone(), error);
            }
        }
        best
    }

    fn residual(&self, terms: &[usize], factors: &[f64]) -> Vec<f64> {
        let mut left = self.terms.whole.clone();
        for (&term, factor) in terms.iter().zip(factors) {
            let column = &self.terms.all[term].column;
            for (left, x) in left.iter_mut().zip(column) {
                *left -= factor * x;
            }
        }
        left
    }

    fn of_blocks(&self, residual: &[f64]) -> Vec<f64> {
        self.terms.samples.blocks(residual)
    }

    fn errors(&self, terms: &[usize], factors: &[f64]) -> Vec<f64> {
        self.of_blocks(&self.residual(terms, factors))
    }

    fn least_squares(&self, terms: &[usize], rows: &[f64]) -> Vec<f64> {
        let scale = |&term: &usize| {
            let pairs = self.terms.all[term].column.iter().zip(rows);
            pairs.map(|(x, weight)| x * weight).collect()
        };
        let scaled: Vec<Vec<f64>> = terms.iter().map(scale).collect();
        let factor = Factor::new(terms.len(), |a, b| {
            dot(&scaled[b], &self.terms.all[terms[a]].column)
        });
        let right = scaled.iter().map(|column| dot(column, &self.terms.whole));
        factor.solve(right.collect())
    }

    fn weighed(&self, terms: &[usize], weights: &[f64]) -> Solution {
        let (n, whole) = (terms.len(), self.terms.all.len());
        let mut gram = vec![0.0; n * (n + 1) / 2];
        let mut right = vec![0.0; n];
        for (products, &weight) in self.products.iter().zip(weights) {
            let mut next = gram.iter_mut();
            for (a, &row) in terms.iter().enumerate() {
                for &column in &terms[..=a] {
                    if let Some(sum) = next.next() {
                        *sum += weight * products[at(row, column)];
                    }
                }
                right[a] += weight * products[at(whole, row)];
            }
        }
        let factor = Factor::new(n, |a, b| gram[at(a, b)]);
        let inverse = factor.inverse();
        let factors = factor.solve(right);
        let saliency = |(k, x): (usize, &f64)| x * x / inverse[k][k];
        Solution {
            terms: terms.to_vec(),
            saliency: factors.iter().enumerate().map(saliency).collect(),
            error: f64::INFINITY,
            factors,
            inverse,
        }
    }
}

fn largest(values: &[f64]) -> f64 {
    values.iter().copied().fold(0.0, f64::max)
}

fn at(a: usize, b: usize) -> usize {
    let (a, b) = (a.max(b), a.min(b));
    a * (a + 1) / 2 + b
}
