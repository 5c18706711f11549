//! Large entries by rows of the axes, as eqs. 4.2 and 4.3 have them: products of a body's moments with
//! the axes of the joints, all seen from the body's link.
//!
//! With w_si and v_si the turn and the shift of joint i seen from link s, about the point that the
//! moments of link s are taken about,
//!
//! - D_ik = Σ_s m v_i·v_k + S·(v_i × w_k + v_k × w_i) + w_i·I w_k,
//! - h_ikm = Σ_s m v_i·b_km + S·(w_m × b_ki + b_km × w_i) + (w_m × w_i)·Σ w_k for k ≤ m, with
//!   b_km = w_k × v_m and Σ = ½ tr(I) 1 − I: joint k, which carries joint m, turns its motion,
//! - c_i = −Σ_s m v_i·g_s + S·(g_s × w_i).

use std::collections::BTreeMap;

use dalembert_model::equations::chain::Chain;
use dalembert_model::equations::chain::composite::Composite;
use dalembert_model::scalar::Scalar;

use crate::arm::PosedChain;
use crate::bodies::{MOMENTS, moments_of};
use crate::expression::{Factor, Sum, Term, collected};
use crate::number::Number;
use crate::ring::Polynomial;
use crate::symbol::Symbol;

/// A component of a row: zero, a number, or a name with a definition.
#[derive(Clone, Debug)]
enum Component {
    Zero,
    Number(Number),
    Named(Symbol),
}

type Vector = [Component; 3];

/// The definition of a name: a polynomial, or products of earlier names.
#[derive(Clone, Debug)]
pub enum Meaning {
    /// In sines, cosines and lengths.
    Polynomial(Polynomial),
    /// In other rows.
    Products(Sum),
}

/// The moments of each link, with the factor that writes each; those that are zero are left out.
pub struct Moments {
    links: Vec<BTreeMap<&'static str, (bool, Factor)>>,
    armatures: Vec<Option<Factor>>,
}

impl Moments {
    /// Lists the moments of bodies that are base parameters; `factor` writes one of them.
    pub fn new(
        bodies: &Chain<Polynomial>,
        factor: impl Fn(&Polynomial) -> Option<(bool, Factor)>,
    ) -> Moments {
        let (mut links, mut armatures) = (Vec::new(), Vec::new());
        for link in &bodies.links {
            let moments = MOMENTS.into_iter().zip(moments_of(&link.body));
            let written = moments.filter_map(|(name, value)| Some((name, factor(&value)?)));
            links.push(written.collect());
            armatures.push(factor(&link.armature).map(|(_, factor)| factor));
        }
        Moments { links, armatures }
    }

    /// Multiplies the moments of a link, each by its sum of products.
    fn weighed(&self, s: usize, sums: Vec<(&'static str, Sum)>) -> Sum {
        let mut weighed = Sum::new();
        for (name, sum) in sums {
            let mut sum = collected(sum);
            let Some((is_negative, factor)) = self.links[s].get(name) else {
                continue;
            };
            let (sign, factors) = match sum.len() {
                0 => continue,
                1 => {
                    let only = sum.remove(0);
                    (only.is_negative, only.factors)
                }
                _ => (false, vec![Factor::Sum(sum)]),
            };
            let is_number = |factor: &Factor| matches!(factor, Factor::Exact(_));
            let (mut product, rest): (Vec<_>, Vec<_>) = factors.into_iter().partition(is_number);
            product.push(factor.clone());
            product.extend(rest);
            weighed.push(Term::new(sign != *is_negative, product));
        }
        weighed
    }
}

/// The rows that entries use, with their definitions.
pub struct Rows<'a> {
    chain: &'a Chain<Polynomial>,
    composite: Composite<'a, Polynomial>,
    /// The links that each coordinate drives, the joints that follow it too, with what each moves for a
    /// unit of it.
    driven: Vec<Vec<(usize, Number)>>,
    gravity: Vec<[Polynomial; 3]>,
    /// By what they are made of, link and joints, and name.
    definitions: BTreeMap<(bool, Vec<usize>, Symbol), Meaning>,
}

impl<'a> Rows<'a> {
    /// Makes the rows of a chain, whose coordinates drive these links.
    pub fn new(chain: &'a PosedChain<Polynomial>, driven: Vec<Vec<(usize, Number)>>) -> Rows<'a> {
        let frames = &chain.chain;
        let mut gravity: Vec<[Polynomial; 3]> = Vec::new();
        for (link, at) in frames.links.iter().zip(&chain.at) {
            let before = link
                .parent
                .map_or(&frames.gravity, |parent| &gravity[parent]);
            gravity.push(link.inward(at, before));
        }
        Rows {
            chain: frames,
            composite: Composite::new(frames, &chain.at),
            driven,
            gravity,
            definitions: BTreeMap::new(),
        }
    }

    /// Lists the names that were used: rows of the joints seen from each link, then products of them.
    pub fn definitions(self) -> Vec<(Symbol, Meaning)> {
        let definitions = self.definitions.into_iter();
        definitions
            .map(|((_, _, symbol), meaning)| (symbol, meaning))
            .collect()
    }

    /// Returns the links that the joints of all these links move.
    fn moved(&self, joints: &[usize]) -> Vec<usize> {
        let moves = |s: usize, i: usize| self.chain.way(s).any(|link| link == i);
        let is_moved = |s: &usize| joints.iter().all(|&i| moves(*s, i));
        (0..self.chain.links.len()).filter(is_moved).collect()
    }

    /// Names a component of a row by what it means.
    fn component(
        &mut self,
        letter: &str,
        axis: &str,
        indices: &[usize],
        meaning: Meaning,
    ) -> Component {
        let symbol = Symbol::row(letter, axis, indices);
        let is_product = matches!(meaning, Meaning::Products(_));
        let key = (is_product, indices.to_vec(), symbol.clone());
        self.definitions.entry(key).or_insert(meaning);
        Component::Named(symbol)
    }

    fn named(&mut self, letter: &str, indices: &[usize], values: [Polynomial; 3]) -> Vector {
        let [x, y, z] = values;
        [("x", x), ("y", y), ("z", z)].map(|(axis, value)| match value.to_constant() {
            Some(number) if number.is_zero() => Component::Zero,
            Some(number) => Component::Number(number),
            None => self.component(letter, axis, indices, Meaning::Polynomial(value)),
        })
    }

    fn turn(&mut self, s: usize, i: usize) -> Vector {
        let [turn, _] = self.composite.motion(i, s);
        self.named("w", &[s, i], turn)
    }

    fn shift(&mut self, s: usize, i: usize) -> Vector {
        let [_, shift] = self.composite.motion(i, s);
        self.named("v", &[s, i], shift)
    }

    /// Returns a × b, each component a name.
    fn cross(&mut self, letter: &str, indices: &[usize], factors: [&Vector; 2]) -> Vector {
        let [x, y, z] = cross_products(&[factors]).map(collected);
        [("x", x), ("y", y), ("z", z)].map(|(axis, sum)| match sum.is_empty() {
            true => Component::Zero,
            false => self.component(letter, axis, indices, Meaning::Products(sum)),
        })
    }

    /// Returns b_km = w_k × v_m.
    fn bent(&mut self, s: usize, k: usize, m: usize) -> Vector {
        let (w, v) = (self.turn(s, k), self.shift(s, m));
        self.cross("b", &[s, k, m], [&w, &v])
    }

    /// Writes D_ik.
    pub fn inertia(&mut self, of: &Moments, i: usize, k: usize) -> Sum {
        let mut sum = Sum::new();
        for (a, x) in self.driven[i].clone() {
            for (b, y) in self.driven[k].clone() {
                sum.extend(scaled(self.inertia_of(of, a, b), &x.mul(&y)));
            }
        }
        sum
    }

    /// Writes h_ikm.
    pub fn christoffel(&mut self, of: &Moments, [i, k, m]: [usize; 3]) -> Sum {
        let mut sum = Sum::new();
        for (a, x) in self.driven[i].clone() {
            for (b, y) in self.driven[k].clone() {
                for (c, z) in self.driven[m].clone() {
                    let part = self.christoffel_of(of, [a, b.min(c), b.max(c)]);
                    sum.extend(scaled(part, &x.mul(&y).mul(&z)));
                }
            }
        }
        sum
    }

    /// Writes c_i.
    pub fn gravity(&mut self, of: &Moments, i: usize) -> Sum {
        let mut sum = Sum::new();
        for (a, x) in self.driven[i].clone() {
            sum.extend(scaled(self.gravity_of(of, a), &x));
        }
        sum
    }

    fn inertia_of(&mut self, of: &Moments, i: usize, k: usize) -> Sum {
        let mut sum = Sum::new();
        for s in self.moved(&[i, k]) {
            let [w, v] = [self.turn(s, i), self.shift(s, i)];
            let [x, y] = [self.turn(s, k), self.shift(s, k)];
            let firsts = cross_products(&[[&v, &x], [&y, &w]]);
            let term = |a: usize, b: usize, factor: &Number| product(factor, [&w[a], &x[b]]);
            sum.extend(of.weighed(s, moments(dot_products(&v, &y), firsts, term)));
        }
        if i == k
            && let Some(factor) = of.armatures[i].clone()
        {
            sum.push(Term::new(false, vec![factor]));
        }
        sum
    }

    /// Joint k carries joint m, or is the same.
    fn christoffel_of(&mut self, of: &Moments, [i, k, m]: [usize; 3]) -> Sum {
        let mut sum = Sum::new();
        for s in self.moved(&[i, k, m]) {
            let [w_i, w_k, w_m] = [i, k, m].map(|joint| self.turn(s, joint));
            let v_i = self.shift(s, i);
            let [b_km, b_ki] = [self.bent(s, k, m), self.bent(s, k, i)];
            let u = self.cross("u", &[s, m, i], [&w_m, &w_i]);
            let firsts = cross_products(&[[&w_m, &b_ki], [&b_km, &w_i]]);
            let term = |a: usize, b: usize, factor: &Number| product(factor, [&u[a], &w_k[b]]);
            sum.extend(of.weighed(s, seconds(dot_products(&v_i, &b_km), firsts, term)));
        }
        sum
    }

    fn gravity_of(&mut self, of: &Moments, i: usize) -> Sum {
        let mut sum = Sum::new();
        for s in self.moved(&[i]) {
            let gravity = self.gravity[s].clone();
            let g = self.named("g", &[s], gravity);
            let [w, v] = [self.turn(s, i), self.shift(s, i)];
            let none = |_: usize, _: usize, _: &Number| None;
            let firsts = cross_products(&[[&g, &w]]);
            let terms = of.weighed(s, moments(dot_products(&v, &g), firsts, none));
            sum.extend(scaled(terms, &Number::one().neg()));
        }
        sum
    }
}

/// Writes a product of components with a factor; `None` if one of them is zero.
fn product(factor: &Number, components: [&Component; 2]) -> Option<Term> {
    let mut number = *factor;
    let mut factors: Vec<Factor> = Vec::new();
    for component in components {
        match component {
            Component::Zero => return None,
            Component::Number(x) => number = number.mul(x),
            Component::Named(symbol) => match factors.last_mut() {
                Some(Factor::Symbol(last, power)) if last == symbol => *power += 1,
                _ => factors.push(Factor::Symbol(symbol.clone(), 1)),
            },
        }
    }
    Some(Term::times(&number, factors))
}

/// Multiplies each term by a number.
fn scaled(sum: Sum, factor: &Number) -> Sum {
    let term = |mut term: Term| {
        term.is_negative ^= factor.is_negative();
        if !factor.abs().is_one() {
            term.factors.insert(0, Factor::Exact(factor.abs()));
        }
        term
    };
    match factor.is_one() {
        true => sum,
        false => sum.into_iter().map(term).collect(),
    }
}

fn dot_products(a: &Vector, b: &Vector) -> Sum {
    let one = Number::one();
    let products = a.iter().zip(b).filter_map(|(a, b)| product(&one, [a, b]));
    products.collect()
}

/// Lists the products of a × b, of all pairs together.
fn cross_products(pairs: &[[&Vector; 2]]) -> [Sum; 3] {
    let [plus, minus] = [Number::one(), Number::one().neg()];
    [0, 1, 2].map(|axis| {
        let (y, z) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut sum = Sum::new();
        for [a, b] in pairs {
            sum.extend(product(&plus, [&a[y], &b[z]]));
            sum.extend(product(&minus, [&a[z], &b[y]]));
        }
        sum
    })
}

/// Lists the sums that moments are multiplied by, of a tensor between two vectors.
fn moments(
    mass: Sum,
    firsts: [Sum; 3],
    term: impl Fn(usize, usize, &Number) -> Option<Term>,
) -> Vec<(&'static str, Sum)> {
    let one = Number::one();
    let squares = [0, 2].map(|axis| term(axis, axis, &one).into_iter().collect());
    by_name(mass, firsts, squares, |a, b| term(a, b, &one))
}

/// Lists them of the tensor ½ tr(I) 1 − I.
fn seconds(
    mass: Sum,
    firsts: [Sum; 3],
    term: impl Fn(usize, usize, &Number) -> Option<Term>,
) -> Vec<(&'static str, Sum)> {
    let half = Number::one().half();
    let minus = Number::one().neg();
    let squares = [0, 2].map(|negative| {
        let factor = |axis: usize| if axis == negative { half.neg() } else { half };
        (0..3)
            .filter_map(|axis| term(axis, axis, &factor(axis)))
            .collect()
    });
    by_name(mass, firsts, squares, |a, b| term(a, b, &minus))
}

/// Names the sums that moments are multiplied by; `squares` are those of XX and ZZ.
fn by_name(
    mass: Sum,
    [x, y, z]: [Sum; 3],
    [xx, zz]: [Sum; 2],
    term: impl Fn(usize, usize) -> Option<Term>,
) -> Vec<(&'static str, Sum)> {
    let both = |a: usize, b: usize| [term(a, b), term(b, a)].into_iter().flatten().collect();
    vec![
        ("M", mass),
        ("MX", x),
        ("MY", y),
        ("MZ", z),
        ("XX", xx),
        ("ZZ", zz),
        ("XY", both(0, 1)),
        ("XZ", both(0, 2)),
        ("YZ", both(1, 2)),
    ]
}
