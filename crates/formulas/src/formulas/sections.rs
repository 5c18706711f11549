//! Polynomials as lines, large ones by rows of the axes.

use dalembert_model::scalar::Scalar;

use super::{Builder, OF_FILE, Source};
use crate::canonical::Splits;
use crate::expression::{Sum, products};
use crate::line::{Line, Section, list, pairs};
use crate::quantity::Quantity;
use crate::ring::Polynomial;
use crate::rows::{Meaning, Moments, Rows};
use crate::symbol::Symbol;

/// Entries of more terms are written by rows of the axes.
const LARGE: usize = 100;
/// Entries of more terms are written by rows where rows are defined anyway.
const LARGE_BESIDE_ROWS: usize = 40;
/// Entries that have so many terms before splits are chosen are large whatever the choice.
const SURELY_LARGE: usize = 200;
/// So are entries of so many monomials: runs save a factor of ten at most.
const MANY_MONOMIALS: usize = 1000;

const ROWS: &str = "Rows of the axes: w_si and v_si are the angular and the linear velocity of link s when joint i moves at \
                    unit speed, in the axes of the link, at the point that its moments are taken about; u_smi = w_sm × \
                    w_si, b_skm = w_sk × v_sm; g_s is gravity in these axes";

impl Builder<'_> {
    /// Writes the definitions of rows.
    pub(super) fn rows(&mut self, definitions: Vec<(Symbol, Meaning)>) -> Section {
        let mut polynomials = Vec::new();
        for (_, meaning) in &definitions {
            if let Meaning::Polynomial(polynomial) = meaning {
                polynomials.push(polynomial.clone());
            }
        }
        let mut sums = self.sums(&polynomials, OF_FILE).into_iter();
        let line = |(name, meaning)| match meaning {
            Meaning::Polynomial(_) => Line::new(name, sums.next().unwrap_or_default()),
            Meaning::Products(sum) => Line::new(name, sum),
        };
        Section {
            title: ROWS.to_owned(),
            lines: definitions.into_iter().map(line).collect(),
            zeros: Vec::new(),
            list: None,
        }
    }

    /// Writes polynomials as lines, equal and opposite ones once.
    pub(super) fn section(&mut self, source: &Source, rows: &mut Rows<'_>) -> Section {
        let mut section = Section {
            title: source.quantity.title().to_owned(),
            lines: Vec::new(),
            zeros: Vec::new(),
            list: list(source.quantity, self.setup.rows().len()),
        };
        let mut distinct: Vec<Polynomial> = Vec::new();
        for (name, polynomial) in &source.entries {
            if polynomial.is_zero() {
                section.zeros.push(name.clone());
                continue;
            }
            let mut known = distinct.iter().zip(&mut section.lines);
            let repeated =
                known.find_map(|(earlier, line)| Some((line, earlier.sign_against(polynomial)?)));
            match repeated {
                Some((line, sign)) => line.others.push((sign < 0, name.clone())),
                None => {
                    distinct.push(polynomial.clone());
                    section.lines.push(Line::new(name.clone(), Sum::new()));
                }
            }
        }
        let sums = self.sums_or_rows(&distinct, source, rows, &section);
        for (line, sum) in section.lines.iter_mut().zip(sums) {
            line.sum = sum;
        }
        section
    }

    /// Writes polynomials as sums, and large ones by rows of the axes.
    fn sums_or_rows(
        &mut self,
        polynomials: &[Polynomial],
        source: &Source,
        rows: &mut Rows<'_>,
        section: &Section,
    ) -> Vec<Sum> {
        let Some(moments) = &source.moments else {
            return self.sums(polynomials, source.table);
        };
        let is_large = |place: &usize| {
            let entry = &polynomials[*place];
            entry.motions() > MANY_MONOMIALS || {
                let entry = std::slice::from_ref(entry);
                Splits::start(&self.runs, entry).terms(0).len() > SURELY_LARGE
            }
        };
        let (large, small): (Vec<usize>, Vec<usize>) = (0..polynomials.len()).partition(is_large);
        let kept = small.iter().map(|&place| polynomials[place].clone());
        let expanded = self.sums(&kept.collect::<Vec<_>>(), source.table);
        let has_rows = !large.is_empty() || expanded.iter().any(|sum| products(sum) > LARGE);
        let most = if has_rows { LARGE_BESIDE_ROWS } else { LARGE };
        let mut sums: Vec<Sum> = vec![Sum::new(); polynomials.len()];
        for (&place, sum) in small.iter().zip(expanded) {
            sums[place] = sum;
        }
        for (place, sum) in sums.iter_mut().enumerate() {
            if products(sum) > most || large.contains(&place) {
                *sum = self.by_rows(source, moments, &section.lines[place].name, rows);
            }
        }
        sums
    }

    fn by_rows(
        &self,
        source: &Source,
        moments: &Moments,
        name: &Symbol,
        rows: &mut Rows<'_>,
    ) -> Sum {
        let n = self.setup.rows().len();
        let mut names = source.entries.iter().map(|(other, _)| other);
        let place = names.position(|other| other == name).unwrap_or_default();
        match source.quantity {
            Quantity::Gravity => rows.gravity(moments, place),
            Quantity::Inertia | Quantity::InertiaRotation | Quantity::InertiaTranslation => {
                let (i, k) = pairs(n).nth(place).unwrap_or_default();
                rows.inertia(moments, i, k)
            }
            _ => {
                let of_joint = n * (n + 1) / 2;
                let (k, m) = pairs(n).nth(place % of_joint).unwrap_or_default();
                rows.christoffel(moments, [place / of_joint, k, m])
            }
        }
    }
}
