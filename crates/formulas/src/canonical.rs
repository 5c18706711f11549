//! The canonical form: a polynomial as a sum of few products of sines and cosines.
//!
//! A *run* is a set of joints that turn about parallel axes, one carried by the other, whatever slides
//! between them. Inside a run, products become sines and cosines of sums of angles, which are a
//! basis (Fourier); across runs they stay products. An angle with a multiple of two may be split,
//! f = u + v with u = sign f and w = u − v:
//!
//! - cos f = 2 cos u cos v − cos w = cos w − 2 sin u sin v
//! - sin f = 2 sin u cos v − sin w = 2 cos u sin v + sin w
//!
//! [`Splits::choose`] takes whichever leaves the fewest terms of all entries together, one angle after
//! the other in a fixed order: the same robot has the same text.

use std::collections::{BTreeMap, HashMap};

use dalembert_codegen::workspace::Setup;
use dalembert_model::robot::JointKind;
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::{Field, Points};

use crate::arm::{PosedChain, SymbolicArm, Variable};
use crate::number::Number;
use crate::ring::{Monomial, Polynomial, Symbols, part, powers};
use crate::symbol::Symbol;

/// The sine or the cosine of a combination of a run's angles. The first multiple is positive.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Wave {
    /// A sine, or else a cosine.
    pub is_sine: bool,
    /// The multiple of each angle of the run.
    pub multiples: Vec<i32>,
}

/// The factors of a term beside its coefficient: powers of slides and, for each run, waves.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Shape {
    /// The number of factors, by which terms are sorted first.
    pub degree: usize,
    /// The power of each slide.
    pub slides: Vec<usize>,
    /// The waves of each run, sorted; a square has its wave twice.
    pub waves: Vec<Vec<Wave>>,
}

/// A coefficient that is linear in symbols.
pub type Form = BTreeMap<Symbols, Number>;

/// The terms of an entry in the order in which they are printed.
pub type Terms = BTreeMap<Shape, Form>;

/// The joints of each run and those that slide.
#[derive(Clone, Debug)]
pub struct Runs {
    /// The joints of each run, ascending.
    pub runs: Vec<Vec<usize>>,
    /// The joints that slide.
    pub slides: Vec<usize>,
    /// Their symbols: d of one with an offset, else q.
    pub slide_symbols: Vec<Symbol>,
}

/// Finds the joints that turn about parallel axes, one carried by the other.
pub fn runs(setup: &Setup, arm: &SymbolicArm, chain: &PosedChain<Polynomial>) -> Runs {
    let robot = setup.robot();
    let is_free = |joint: usize| arm.variables.iter().any(|variable| variable.joint == joint);
    let mut runs: Vec<Vec<usize>> = Vec::new();
    let mut run_of_link: Vec<Option<usize>> = Vec::new();
    for (link, row) in chain.chain.links.iter().zip(&chain.rows) {
        let before = link.parent.and_then(|parent| run_of_link[parent]);
        if link.kind == JointKind::Prismatic {
            run_of_link.push(before);
            continue;
        }
        let is_parallel = link.rotation[0][2].is_zero() && link.rotation[1][2].is_zero();
        let run = before.filter(|_| is_parallel).unwrap_or(runs.len());
        if run == runs.len() {
            runs.push(Vec::new());
        }
        run_of_link.push(Some(run));
        let joint = robot.mover_of(*row);
        let is_new = runs.iter().all(|run| !run.contains(&joint));
        if is_new && is_free(joint) {
            runs[run].push(joint);
        }
    }
    for run in &mut runs {
        run.sort_unstable();
    }
    runs.retain(|run| !run.is_empty());
    let is_slide = |variable: &&Variable| variable.kind == JointKind::Prismatic;
    let slides = arm.variables.iter().filter(is_slide);
    Runs {
        runs,
        slide_symbols: slides.clone().map(Variable::slide_symbol).collect(),
        slides: slides.map(|variable| variable.joint).collect(),
    }
}

/// A product of waves, one of each run, with its coefficient.
type Products = BTreeMap<(Vec<usize>, Vec<Wave>), Form>;

/// A way to write a wave: products of waves, each with its factor.
type Alternative = Vec<(f64, Vec<Wave>)>;

impl Wave {
    fn none(length: usize) -> Wave {
        Wave {
            is_sine: false,
            multiples: vec![0; length],
        }
    }

    fn is_none(&self) -> bool {
        !self.is_sine && self.multiples.iter().all(|x| *x == 0)
    }

    /// True if an angle occurs more than once.
    fn is_multiple(&self) -> bool {
        self.multiples.iter().any(|x| x.abs() > 1)
    }

    /// Makes the first multiple positive: returns the sign, zero for the sine of zero.
    fn normal(is_sine: bool, multiples: Vec<i32>) -> (f64, Wave) {
        match multiples.iter().find(|x| **x != 0) {
            None if is_sine => (0.0, Wave { is_sine, multiples }),
            Some(first) if *first < 0 => {
                let multiples = multiples.iter().map(|x| -x).collect();
                let sign = if is_sine { -1.0 } else { 1.0 };
                (sign, Wave { is_sine, multiples })
            }
            _ => (1.0, Wave { is_sine, multiples }),
        }
    }

    /// Lists the ways to write it; the first one is the start of the search.
    fn alternatives(&self) -> [Alternative; 3] {
        let f = &self.multiples;
        let u: Vec<i32> = f.iter().map(|x| x.signum()).collect();
        let v: Vec<i32> = f.iter().zip(&u).map(|(f, u)| f - u).collect();
        let w: Vec<i32> = u.iter().zip(&v).map(|(u, v)| u - v).collect();
        let is_sine = self.is_sine;
        // sin(u + v) = 2 sin u cos v − sin(u − v), cos(u + v) = cos(u − v) − 2 sin u sin v.
        let sign = if is_sine { 1.0 } else { -1.0 };
        let product = |factor: f64, parts: &[(bool, &Vec<i32>)]| {
            let mut factor = factor;
            let mut waves = Vec::new();
            for (is_sine, multiples) in parts {
                let (wave_sign, wave) = Wave::normal(*is_sine, (*multiples).clone());
                factor *= wave_sign;
                if !wave.is_none() {
                    waves.push(wave);
                }
            }
            waves.sort();
            (factor, waves)
        };
        let split = |factor: f64, of_u: bool, of_v: bool, of_w: f64| {
            let both = product(factor, &[(of_u, &u), (of_v, &v)]);
            vec![both, product(of_w, &[(is_sine, &w)])]
        };
        let mut alternatives = [
            split(2.0 * sign, true, !is_sine, -sign),
            vec![product(1.0, &[(is_sine, f)])],
            split(2.0, false, is_sine, sign),
        ];
        for terms in &mut alternatives {
            terms.retain(|(factor, _)| *factor != 0.0);
        }
        alternatives
    }
}

impl Runs {
    /// Writes products of powers inside each run as sums of waves.
    fn products(&self, polynomial: &Polynomial, memory: &mut Memory) -> Products {
        let mut products = Products::new();
        for (Monomial { symbols, motion }, x) in polynomial.terms() {
            let slides = self.slides.iter().map(|&joint| powers(*motion, joint)[0]);
            let slides: Vec<usize> = slides.collect();
            let mut partial = vec![(1.0, Vec::new())];
            for run in &self.runs {
                partial = lengthened(&partial, &memory.of_run(run, *motion));
            }
            for (factor, waves) in partial {
                let form = products.entry((slides.clone(), waves)).or_default();
                add(form, *symbols, x.mul(&Number::of_dyadic(factor)));
            }
        }
        products.retain(|_, form| !form.is_empty());
        products
    }
}

/// Adds a number to that of a key; zeros are left out.
pub(crate) fn add<K: Ord>(numbers: &mut BTreeMap<K, Number>, key: K, x: Number) {
    let sum = numbers.get(&key).map_or(x, |old| old.add(&x));
    match sum.is_zero() {
        true => numbers.remove(&key),
        false => numbers.insert(key, sum),
    };
}

/// Multiplies each product by each factor, which stands at its end.
fn lengthened<W: Clone>(products: &[(f64, Vec<W>)], factors: &[(f64, W)]) -> Vec<(f64, Vec<W>)> {
    let mut longer = Vec::with_capacity(products.len() * factors.len());
    for (x, before) in products {
        for (y, factor) in factors {
            let mut after = before.clone();
            after.push(factor.clone());
            longer.push((x * y, after));
        }
    }
    longer
}

/// Lists the waves of a product with a multiple angle, each with its run.
fn multiples(waves: &[Wave]) -> impl Iterator<Item = (usize, Wave)> {
    let waves = waves.iter().cloned().enumerate();
    waves.filter(|(_, wave)| wave.is_multiple())
}

/// The waves of each product of powers that occurred, by the bits of a run's joints.
#[derive(Default)]
struct Memory(HashMap<(usize, u128), Vec<(f64, Wave)>>);

impl Memory {
    fn of_run(&mut self, run: &[usize], motion: u128) -> Vec<(f64, Wave)> {
        let bits = run.iter().map(|&joint| part(motion, joint)).sum();
        let known = self.0.entry((run[0], bits));
        known.or_insert_with(|| waves_of(run, motion)).clone()
    }
}

fn waves_of(run: &[usize], motion: u128) -> Vec<(f64, Wave)> {
    let mut sum = BTreeMap::from([(Wave::none(run.len()), 1.0)]);
    for (place, &joint) in run.iter().enumerate() {
        let [cosines, sines] = powers(motion, joint);
        let factors = std::iter::repeat_n(false, cosines).chain(std::iter::repeat_n(true, sines));
        for is_sine in factors {
            sum = times(&sum, place, is_sine);
        }
    }
    sum.into_iter().map(|(wave, x)| (x, wave)).collect()
}

/// Multiplies waves by the sine or the cosine of one angle.
fn times(sum: &BTreeMap<Wave, f64>, place: usize, is_sine: bool) -> BTreeMap<Wave, f64> {
    let mut product: BTreeMap<Wave, f64> = BTreeMap::new();
    for (wave, x) in sum {
        let shifted = |by: i32| {
            let mut multiples = wave.multiples.clone();
            multiples[place] += by;
            multiples
        };
        let (more, less) = (shifted(1), shifted(-1));
        let half = x / 2.0;
        let parts = match (wave.is_sine, is_sine) {
            (kind, false) => [(half, kind, more), (half, kind, less)],
            (false, true) => [(half, true, more), (-half, true, less)],
            (true, true) => [(half, false, less), (-half, false, more)],
        };
        for (y, kind, multiples) in parts {
            let (sign, wave) = Wave::normal(kind, multiples);
            if sign != 0.0 {
                *product.entry(wave).or_insert(0.0) += sign * y;
            }
        }
    }
    product.retain(|_, x| *x != 0.0);
    product
}

/// Entries as products of waves, and how each multiple angle is split in all of them.
pub struct Splits {
    entries: Vec<Products>,
    choices: Choices,
}

type Choices = BTreeMap<(usize, Wave), usize>;

/// Above so many products no search is made: entries of such arms are printed by rows.
const MOST_PRODUCTS: usize = 60_000;
const SWEEPS: usize = 2;

impl Splits {
    /// Writes entries by the choice of splits that the search starts from.
    pub fn start(runs: &Runs, entries: &[Polynomial]) -> Splits {
        let mut memory = Memory::default();
        let products = |entry| runs.products(entry, &mut memory);
        let entries: Vec<Products> = entries.iter().map(products).collect();
        let mut choices = Choices::new();
        for (_, waves) in entries.iter().flat_map(BTreeMap::keys) {
            choices.extend(multiples(waves).map(|multiple| (multiple, 0)));
        }
        Splits { entries, choices }
    }

    /// Writes entries by one choice of splits, which leaves few terms.
    pub fn choose(runs: &Runs, entries: &[Polynomial]) -> Splits {
        let mut splits = Splits::start(runs, entries);
        let products: usize = splits.entries.iter().map(BTreeMap::len).sum();
        if products <= MOST_PRODUCTS {
            let mut descent = Descent::new(&splits);
            let waves: Vec<(usize, Wave)> = splits.choices.keys().cloned().collect();
            for _ in 0..SWEEPS {
                let mut is_better = false;
                for wave in &waves {
                    is_better |= descent.improve(&mut splits.choices, wave);
                }
                if !is_better {
                    break;
                }
            }
        }
        splits
    }

    /// Returns the terms of an entry.
    pub fn terms(&self, entry: usize) -> Terms {
        let mut terms = Terms::new();
        for ((slides, waves), form) in &self.entries[entry] {
            for (factor, waves) in expanded(&self.choices, waves) {
                let degree =
                    slides.iter().sum::<usize>() + waves.iter().map(Vec::len).sum::<usize>();
                let shape = Shape {
                    degree,
                    slides: slides.clone(),
                    waves,
                };
                let sum = terms.entry(shape).or_default();
                let factor = Number::of_dyadic(factor);
                for (symbols, x) in form {
                    add(sum, *symbols, x.mul(&factor));
                }
            }
        }
        terms.retain(|_, form| !form.is_empty());
        terms
    }
}

/// Lists the products that a product of waves becomes.
fn expanded(choices: &Choices, waves: &[Wave]) -> Vec<(f64, Vec<Vec<Wave>>)> {
    let mut partial = vec![(1.0, Vec::new())];
    for (run, wave) in waves.iter().enumerate() {
        let alternative: Alternative = match choices.get(&(run, wave.clone())) {
            Some(&choice) => wave.alternatives()[choice].clone(),
            None if wave.is_none() => vec![(1.0, Vec::new())],
            None => vec![(1.0, vec![wave.clone()])],
        };
        partial = lengthened(&partial, &alternative);
    }
    partial
}

/// An entry, and the powers of slides and the waves of each run of one of its terms.
type Place = (usize, Vec<usize>, Vec<Vec<Wave>>);

/// The terms of all entries under the choices so far. A coefficient is a residue here, with a random
/// one for each symbol: only the number of terms matters.
#[derive(Default)]
struct Descent {
    /// Each product: its entry, slides, waves and coefficient.
    products: Vec<(usize, Vec<usize>, Vec<Wave>, Field)>,
    /// The products with a multiple angle.
    with: HashMap<(usize, Wave), Vec<usize>>,
    sums: HashMap<Place, Field>,
    terms: usize,
}

impl Descent {
    fn new(splits: &Splits) -> Descent {
        let mut points = Points::new(0x7370_6c69);
        let mut weights: BTreeMap<Symbols, Field> = BTreeMap::new();
        let mut descent = Descent::default();
        for (entry, products) in splits.entries.iter().enumerate() {
            for ((slides, waves), form) in products {
                let weighed = form.iter().map(|(symbols, x)| {
                    let weight = weights.entry(*symbols).or_insert_with(|| points.field());
                    x.residue().mul(weight)
                });
                let residue = weighed.fold(Field::ZERO, |sum, x| sum.add(&x));
                let place = descent.products.len();
                for multiple in multiples(waves) {
                    descent.with.entry(multiple).or_default().push(place);
                }
                let product = (entry, slides.clone(), waves.clone(), residue);
                descent.products.push(product);
                descent.enter(&splits.choices, place, false);
            }
        }
        descent
    }

    /// Adds what a product becomes, or takes it away.
    fn enter(&mut self, choices: &Choices, product: usize, removes: bool) {
        let (entry, slides, waves, residue) = self.products[product].clone();
        let sign = if removes { -1.0 } else { 1.0 };
        for (factor, waves) in expanded(choices, &waves) {
            let x = residue.mul(&Number::of_dyadic(sign * factor).residue());
            let place = self.sums.entry((entry, slides.clone(), waves));
            let sum = place.or_insert(Field::ZERO);
            let was = *sum != Field::ZERO;
            *sum = sum.add(&x);
            match (was, *sum != Field::ZERO) {
                (false, true) => self.terms += 1,
                (true, false) => self.terms -= 1,
                _ => {}
            }
        }
    }

    fn set(&mut self, choices: &mut Choices, wave: &(usize, Wave), choice: usize) {
        let products = self.with.get(wave).cloned().unwrap_or_default();
        for &product in &products {
            self.enter(choices, product, true);
        }
        choices.insert(wave.clone(), choice);
        for &product in &products {
            self.enter(choices, product, false);
        }
    }

    /// Takes the split of one angle that leaves the fewest terms, the first of equals: returns true if
    /// that is another than before.
    fn improve(&mut self, choices: &mut Choices, wave: &(usize, Wave)) -> bool {
        let before = choices.get(wave).copied().unwrap_or(0);
        let (mut best, mut fewest) = (before, self.terms);
        let order = if wave.1.is_sine { [0, 1, 2] } else { [1, 0, 2] };
        for choice in order {
            if choice == before {
                continue;
            }
            self.set(choices, wave, choice);
            if self.terms < fewest {
                (best, fewest) = (choice, self.terms);
            }
        }
        self.set(choices, wave, best);
        best != before
    }
}
