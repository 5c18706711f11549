//! The formulas of a robot: coefficients as polynomials, then as lines in the style that is asked for.

use std::collections::BTreeSet;
use std::rc::Rc;

use dalembert_codegen::workspace::{Setup, Word};
use dalembert_model::equations::dalembert::Part;
use dalembert_model::robot::{JointKind, Robot};
use dalembert_model::scalar::Scalar;
use dalembert_model::scene::Scene;

use crate::arm::{Symbolic, SymbolicArm, SymbolicChain, Variable};
use crate::bodies::BaseBodies;
use crate::canonical::{Runs, Splits, Terms};
use crate::entries::{Coefficients, hand, jacobian, potential_energy};
use crate::error::FormulaError;
use crate::expression::{Factor, Sum, Term, by_symbols, products, with_numbers};
use crate::legend::{Entry, Legend};
use crate::line::{Line, List, Section};
use crate::names::{Names, SharedConstants, form_of};
use crate::number::Number;
use crate::quantity::Quantity;
use crate::ring::Polynomial;
use crate::rows::{Meaning, Moments, Rows};
use crate::symbol::{Definition, Symbol};

/// The symbols that formulas are written in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Style {
    /// Numbers alone.
    #[default]
    Numbers,
    /// Lengths and base parameters; of a small arm masses, centres of mass and inertias.
    Names,
    /// Constants K1, K2, … that coefficients share.
    Constants,
}

impl Word for Style {
    const WHAT: &'static str = "style of formulas";

    fn all() -> Vec<(&'static str, Style)> {
        vec![
            ("numbers", Style::Numbers),
            ("names", Style::Names),
            ("constants", Style::Constants),
        ]
    }
}

/// The formulas that are asked for.
#[derive(Clone, Debug)]
pub struct Request {
    /// The quantities, in the order in which they are written.
    pub quantities: Vec<Quantity>,
    /// The symbols.
    pub style: Style,
}

/// The closed forms of a robot's dynamics.
#[derive(Clone, Debug)]
pub struct Formulas {
    /// The robot's name.
    pub robot: String,
    /// The variables of the joints that move.
    pub variables: Vec<Variable>,
    /// The formulas of each quantity.
    pub sections: Vec<Section>,
    /// The symbols that occur.
    pub legend: Legend,
    /// The number of joints of the robot.
    pub joints: usize,
}

/// A small arm's entries have at most so many products in the file's symbols.
const SMALL: usize = 12;
/// And it has at most so many joints.
const FEW_JOINTS: usize = 4;
/// Entries of more terms are written by rows of the axes.
const LARGE: usize = 100;
/// The same, where rows are defined anyway.
const LARGE_BESIDE_ROWS: usize = 40;
/// Entries that have so many terms before splits are chosen are large whatever the choice.
const SURELY_LARGE: usize = 200;
/// So are entries of so many monomials: runs save a factor of ten at most.
const MANY_MONOMIALS: usize = 1000;
/// Sums of so many products or less stand for an entry inside of an energy or a torque.
const SHORT: usize = 24;

/// Polynomials of one quantity, in symbols of one table.
struct Source {
    quantity: Quantity,
    names: Vec<Symbol>,
    polynomials: Vec<Polynomial>,
    table: usize,
    /// The moments that rows of the axes are multiplied by, of coefficients that may be large.
    moments: Option<Rc<Moments>>,
}

/// Symbols of inertial parameters with their values; base parameters have definitions.
struct Table {
    parameters: Vec<(Symbol, Number)>,
    definitions: Vec<Definition<Polynomial>>,
}

impl Formulas {
    /// Writes the formulas of a robot, whole or in a scene.
    ///
    /// # Errors
    /// The robot has none ([`FormulaError`]).
    pub fn new(
        robot: &Robot,
        scene: Option<&Scene>,
        request: &Request,
    ) -> Result<Formulas, FormulaError> {
        let setup = Setup::in_scene(robot, scene);
        let setup = setup.map_err(|why| FormulaError::Scene(why.to_string()))?;
        Builder::new(&setup, request)?.build()
    }
}

struct Builder<'a> {
    setup: &'a Setup,
    request: &'a Request,
    arm: SymbolicArm,
    runs: Runs,
    tables: Vec<Table>,
    sources: Vec<Source>,
    coefficients: Coefficients,
    shared: SharedConstants,
}

/// Coefficients, the table of their symbols, and the moments that rows are multiplied by.
type InSymbols = (Coefficients, usize, Option<Rc<Moments>>);

const ROWS: &str = "Rows of the axes: w_si and v_si are the turn and the shift of joint i as seen from link s, \
                    u_smi = w_sm × w_si, b_skm = w_sk × v_sm, g_s is gravity";

/// The place of the table of the robot file's own symbols.
const OF_FILE: usize = 0;

impl<'a> Builder<'a> {
    fn new(setup: &'a Setup, request: &'a Request) -> Result<Self, FormulaError> {
        let symbolic = match request.style {
            Style::Numbers => Symbolic::Nothing,
            Style::Names | Style::Constants => Symbolic::Everything,
        };
        let arm = SymbolicArm::new(setup, symbolic)?;
        if setup.rows().is_empty() {
            return Err(FormulaError::Nothing);
        }
        let chain = arm.chain(&arm.arm);
        let of_file = arm.parameters.iter();
        let of_file = of_file.map(|own| (own.symbol.clone(), own.value));
        let tables = vec![Table {
            parameters: of_file.collect(),
            definitions: Vec::new(),
        }];
        let mut builder = Builder {
            setup,
            request,
            runs: runs(setup, &arm, &chain),
            tables,
            sources: Vec::new(),
            coefficients: Coefficients {
                inertia: Vec::new(),
                christoffel: Vec::new(),
                gravity: Vec::new(),
            },
            shared: SharedConstants::default(),
            arm,
        };
        let (coefficients, table, moments) = builder.whole(&chain);
        builder.coefficients = coefficients;
        builder.collect(table, moments);
        Ok(builder)
    }

    /// Computes the coefficients of the robot, in the symbols of the file if they stay short, else in
    /// base parameters.
    fn whole(&mut self, chain: &SymbolicChain) -> InSymbols {
        if self.request.style != Style::Numbers && self.arm.variables.len() <= FEW_JOINTS {
            let coefficients = self.in_file(chain);
            let entries = coefficients.inertia.iter().flatten();
            let entries = entries.chain(coefficients.christoffel.iter().flatten().flatten());
            let mut entries = entries.chain(&coefficients.gravity);
            if entries.all(|entry| entry.terms().len() <= SMALL) {
                return (coefficients, OF_FILE, None);
            }
        }
        self.in_base_parameters(chain, "")
    }

    fn in_file(&self, chain: &SymbolicChain) -> Coefficients {
        Coefficients::new(self.setup, &self.arm, &chain.chain, &chain.at, &chain.rows)
    }

    fn in_base_parameters(&mut self, chain: &SymbolicChain, mark: &str) -> InSymbols {
        let bodies = BaseBodies::new(&self.arm, chain, mark);
        let symbols = bodies.parameters.iter().map(|own| own.symbol.clone());
        let parameters: Vec<(Symbol, Number)> = symbols.zip(bodies.values).collect();
        let is_numeric = self.request.style == Style::Numbers;
        let factor = |value: &Polynomial| {
            let (monomial, sign) = value.terms().first()?;
            let (symbol, value) = &parameters[monomial.symbols.parameter_index()?];
            Some(match is_numeric {
                true => (value.is_negative(), Factor::Number(value.abs())),
                false => (sign.is_negative(), Factor::Symbol(symbol.clone(), 1)),
            })
        };
        let moments = Some(Rc::new(Moments::new(&bodies.chain, factor)));
        if is_numeric {
            return (self.in_file(chain), OF_FILE, moments);
        }
        let coefficients =
            Coefficients::new(self.setup, &self.arm, &bodies.chain, &chain.at, &chain.rows);
        self.tables.push(Table {
            parameters,
            definitions: bodies.parameters,
        });
        (coefficients, self.tables.len() - 1, moments)
    }

    /// Lists the polynomials of all quantities that are asked for.
    fn collect(&mut self, table: usize, moments: Option<Rc<Moments>>) {
        let n = self.setup.rows().len();
        for &quantity in &self.request.quantities {
            match quantity {
                Quantity::Inertia | Quantity::Christoffel | Quantity::Gravity => {
                    let (names, polynomials) = coefficients_of(&self.coefficients, quantity);
                    let source = self.source(quantity, names, polynomials, table);
                    source.moments = moments.clone();
                }
                Quantity::InertiaRotation
                | Quantity::InertiaTranslation
                | Quantity::ChristoffelRotation
                | Quantity::ChristoffelTranslation => self.part(quantity),
                Quantity::PotentialEnergy => {
                    let potential = vec![potential_energy(&self.arm)];
                    self.source(quantity, vec![quantity.entry(&[])], potential, OF_FILE);
                }
                Quantity::Pose => {
                    let pose = hand(&self.arm);
                    let entries = (0..3).flat_map(|r| (0..3).map(move |c| (r, c)));
                    let mut names: Vec<Symbol> = entries
                        .clone()
                        .map(|(r, c)| quantity.entry(&[r, c]))
                        .collect();
                    let mut entries: Vec<Polynomial> =
                        entries.map(|(r, c)| pose.axes[c][r].clone()).collect();
                    names.extend(["x", "y", "z"].map(|axis| Symbol::indexed("p", axis)));
                    entries.extend(pose.origin);
                    self.source(quantity, names, entries, OF_FILE);
                }
                Quantity::Jacobian => {
                    let entries = jacobian(self.setup, &self.arm);
                    let places = (0..6).flat_map(|r| (0..n).map(move |c| (r, c)));
                    let names = places.map(|(r, c)| quantity.entry(&[r, c])).collect();
                    let entries = entries.into_iter().flatten().collect();
                    self.source(quantity, names, entries, OF_FILE);
                }
                Quantity::Torque | Quantity::KineticEnergy => {
                    self.source(quantity, Vec::new(), Vec::new(), table);
                }
            }
        }
    }

    fn source(
        &mut self,
        quantity: Quantity,
        names: Vec<Symbol>,
        polynomials: Vec<Polynomial>,
        table: usize,
    ) -> &mut Source {
        self.sources.push(Source {
            quantity,
            names,
            polynomials,
            table,
            moments: None,
        });
        let last = self.sources.len() - 1;
        &mut self.sources[last]
    }

    /// Adds a part of generalized D'Alembert: the coefficients of an arm that has it alone.
    fn part(&mut self, quantity: Quantity) {
        let (part, mark) = match quantity {
            Quantity::InertiaRotation | Quantity::ChristoffelRotation => (Part::Rotation, "r"),
            _ => (Part::Translation, "t"),
        };
        let arm = part.of(&self.arm.arm);
        let chain = self.arm.chain(&arm);
        let is_small = self.request.style != Style::Numbers && self.tables.len() == 1;
        let (coefficients, table, moments) = match is_small {
            true => (self.in_file(&chain), OF_FILE, None),
            false => self.in_base_parameters(&chain, mark),
        };
        let (names, polynomials) = coefficients_of(&coefficients, quantity);
        let source = self.source(quantity, names, polynomials, table);
        source.moments = moments;
    }

    fn build(mut self) -> Result<Formulas, FormulaError> {
        let sources = std::mem::take(&mut self.sources);
        let chain = self.arm.chain(&self.arm.arm);
        let mut rows = Rows::new(&chain, self.driven(&chain));
        let sections = sources.iter().map(|source| match source.quantity {
            Quantity::Torque => self.torques(source.table),
            Quantity::KineticEnergy => self.kinetic_energy(source.table),
            _ => self.section(source, &mut rows),
        });
        let mut sections: Vec<Section> = sections.collect();
        let definitions = rows.definitions();
        if !definitions.is_empty() {
            sections.insert(0, self.rows(definitions));
        }
        let legend = self.legend(&sections);
        Ok(Formulas {
            robot: self.setup.robot().name.clone(),
            variables: self.arm.variables,
            sections,
            legend,
            joints: self.setup.joints(),
        })
    }

    /// Returns the links that each coordinate drives, with what each moves for a unit of it.
    fn driven(&self, chain: &SymbolicChain) -> Vec<Vec<(usize, Number)>> {
        let robot = self.setup.robot();
        let drives = |&joint: &usize| {
            let leader = robot.row_of(joint);
            let links = chain.rows.iter().enumerate();
            let driven = links.filter_map(|(link, &row)| {
                let mut following = self.arm.following().iter();
                let follower = following.find(|own| own.row == row && own.leader == leader);
                match follower {
                    Some(own) => Some((link, own.multiplier.to_constant()?)),
                    None => (row == leader).then(|| (link, Number::one())),
                }
            });
            driven.collect()
        };
        self.setup.rows().iter().map(drives).collect()
    }

    /// Writes the definitions of rows.
    fn rows(&mut self, definitions: Vec<(Symbol, Meaning)>) -> Section {
        let mut polynomials = Vec::new();
        for (_, meaning) in &definitions {
            if let Meaning::Polynomial(polynomial) = meaning {
                polynomials.push(polynomial.clone());
            }
        }
        let mut sums = self.sums(&polynomials, OF_FILE).into_iter();
        let line = |(name, meaning)| Line {
            name,
            others: Vec::new(),
            sum: match meaning {
                Meaning::Polynomial(_) => sums.next().unwrap_or_default(),
                Meaning::Products(sum) => sum,
            },
        };
        Section {
            title: ROWS.to_owned(),
            lines: definitions.into_iter().map(line).collect(),
            zeros: Vec::new(),
            list: None,
        }
    }

    /// Writes polynomials as lines, equal and opposite ones once.
    fn section(&mut self, source: &Source, rows: &mut Rows<'_>) -> Section {
        let mut section = Section {
            title: source.quantity.title().to_owned(),
            lines: Vec::new(),
            zeros: Vec::new(),
            list: list(source.quantity, self.setup.rows().len()),
        };
        let mut distinct: Vec<Polynomial> = Vec::new();
        for (name, polynomial) in source.names.iter().zip(&source.polynomials) {
            if polynomial.is_zero() {
                section.zeros.push(name.clone());
                continue;
            }
            let known = distinct.iter().map(|own| own.sign_against(polynomial));
            match known
                .enumerate()
                .find_map(|(place, sign)| Some((place, sign?)))
            {
                Some((place, sign)) => {
                    section.lines[place].others.push((sign < 0, name.clone()));
                }
                None => {
                    distinct.push(polynomial.clone());
                    section.lines.push(Line {
                        name: name.clone(),
                        others: Vec::new(),
                        sum: Sum::new(),
                    });
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
        let kept: Vec<Polynomial> = small
            .iter()
            .map(|&place| polynomials[place].clone())
            .collect();
        let splits = Splits::choose(&self.runs, &kept);
        let expanded: Vec<Sum> = (0..small.len())
            .map(|index| self.sum(&splits.terms(index), source.table))
            .collect();
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
        let place = source
            .names
            .iter()
            .position(|own| own == name)
            .unwrap_or_default();
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

    /// Writes polynomials as sums, all with the same splits.
    fn sums(&mut self, polynomials: &[Polynomial], table: usize) -> Vec<Sum> {
        let splits = Splits::choose(&self.runs, polynomials);
        let places = 0..polynomials.len();
        places
            .map(|place| self.sum(&splits.terms(place), table))
            .collect()
    }

    fn sum(&mut self, terms: &Terms, table: usize) -> Sum {
        match self.request.style {
            Style::Numbers => with_numbers(terms, &self.runs),
            Style::Constants if table == self.constants_table() => {
                self.shared.sum(terms, &self.runs)
            }
            Style::Names | Style::Constants => {
                let names = self.names(table);
                by_symbols(terms, &self.runs, |symbols| names.factors(symbols))
            }
        }
    }

    /// The table whose symbols constants are made of: that of D, h and c.
    fn constants_table(&self) -> usize {
        usize::from(self.tables.len() > 1)
    }

    fn names(&self, table: usize) -> Names<'_> {
        Names {
            arm: &self.arm,
            parameters: self.tables[table].parameters.clone(),
        }
    }

    /// Returns an entry as a factor: its sum, if that is short, else its name; `None` if it is zero.
    fn entry(&mut self, quantity: Quantity, indices: &[usize], table: usize) -> Option<Factor> {
        let polynomial = match *indices {
            [i] => &self.coefficients.gravity[i],
            [i, k] => &self.coefficients.inertia[i][k],
            [i, k, m] => &self.coefficients.christoffel[i][k][m],
            _ => return None,
        };
        if polynomial.is_zero() {
            return None;
        }
        let name = Factor::Symbol(quantity.entry(indices), 1);
        if polynomial.terms().len() > SHORT || self.arm.variables.len() > FEW_JOINTS {
            return Some(name);
        }
        let polynomial = polynomial.clone();
        let sum = self.sums(&[polynomial], table).pop()?;
        Some(Factor::Sum(sum))
    }

    fn kinetic_energy(&mut self, table: usize) -> Section {
        let mut sum = Sum::new();
        for (i, k) in pairs(self.setup.rows().len()) {
            let Some(factor) = self.entry(Quantity::Inertia, &[i, k], table) else {
                continue;
            };
            let mut factors = Vec::new();
            if i == k {
                factors.push(Factor::Exact(Number::one().half()));
            }
            factors.push(factor);
            factors.extend(self.rates([i, k]));
            sum.push(flat(Term::new(false, factors)));
        }
        self.single(
            Quantity::KineticEnergy,
            vec![(Quantity::KineticEnergy.entry(&[]), sum)],
        )
    }

    fn torques(&mut self, table: usize) -> Section {
        let n = self.setup.rows().len();
        let mut lines = Vec::new();
        for i in 0..n {
            let mut sum = Sum::new();
            for k in 0..n {
                let indices = [i.min(k), i.max(k)];
                if let Some(factor) = self.entry(Quantity::Inertia, &indices, table) {
                    let rate = Symbol::rate(2, self.joint(k));
                    let factors = vec![factor, Factor::Symbol(rate, 1)];
                    sum.push(flat(Term::new(false, factors)));
                }
            }
            for (k, m) in pairs(n) {
                let Some(factor) = self.entry(Quantity::Christoffel, &[i, k, m], table) else {
                    continue;
                };
                let mut factors = vec![factor];
                if k != m {
                    factors.insert(0, Factor::Exact(Number::of_dyadic(2.0)));
                }
                factors.extend(self.rates([k, m]));
                sum.push(flat(Term::new(false, factors)));
            }
            match self.entry(Quantity::Gravity, &[i], table) {
                Some(Factor::Sum(terms)) => sum.extend(terms),
                Some(factor) => sum.push(Term::new(false, vec![factor])),
                None => {}
            }
            lines.push((Quantity::Torque.entry(&[i]), sum));
        }
        self.single(Quantity::Torque, lines)
    }

    /// The name of a row's joint, or of the robot.
    fn label(&self, row: Option<usize>) -> String {
        let rows = self.setup.robot().rows();
        match row.map(|row| (row + 1, rows.get(row).and_then(|joint| joint.name.as_ref()))) {
            None => "robot".to_owned(),
            Some((number, Some(name))) => format!("joint {number} ({name})"),
            Some((number, None)) => format!("joint {number}"),
        }
    }

    /// The number of a joint of the results, counted from one.
    fn joint(&self, place: usize) -> usize {
        self.setup.rows()[place] + 1
    }

    fn rates(&self, [k, m]: [usize; 2]) -> Vec<Factor> {
        let rate = |place: usize| Symbol::rate(1, self.joint(place));
        match k == m {
            true => vec![Factor::Symbol(rate(k), 2)],
            false => vec![Factor::Symbol(rate(k), 1), Factor::Symbol(rate(m), 1)],
        }
    }

    fn single(&self, quantity: Quantity, lines: Vec<(Symbol, Sum)>) -> Section {
        let (zeros, lines): (Vec<_>, Vec<_>) =
            lines.into_iter().partition(|(_, sum)| sum.is_empty());
        let line = |(name, sum)| Line {
            name,
            others: Vec::new(),
            sum,
        };
        Section {
            title: quantity.title().to_owned(),
            lines: lines.into_iter().map(line).collect(),
            zeros: zeros.into_iter().map(|(name, _)| name).collect(),
            list: list(quantity, self.setup.rows().len()),
        }
    }

    /// Lists the symbols that occur, constants first, then base parameters, then the file's.
    fn legend(&self, sections: &[Section]) -> Legend {
        let mut legend = Legend::default();
        let mut seen: BTreeSet<String> = BTreeSet::new();
        for line in sections.iter().flat_map(|section| &section.lines) {
            see(&line.sum, &mut seen);
        }
        let names = self.names(self.constants_table());
        for (place, form) in self.shared.forms.iter().enumerate() {
            let sum = names.form(form);
            see(&sum, &mut seen);
            legend.constants.push(Entry {
                symbol: SharedConstants::symbol(place),
                sum,
                value: names.value(form),
            });
        }
        let of_file = self.names(OF_FILE);
        for table in &self.tables[1..] {
            for (own, (_, value)) in table.definitions.iter().zip(&table.parameters) {
                if seen.contains(&own.symbol.code) {
                    let sum = of_file.form(&form_of(&own.value));
                    see(&sum, &mut seen);
                    legend.parameters.push(Entry {
                        symbol: own.symbol.clone(),
                        sum,
                        value: *value,
                    });
                }
            }
        }
        let mut entries: Vec<_> = self
            .arm
            .lengths
            .iter()
            .chain(&self.arm.parameters)
            .collect();
        entries.sort_by_key(|own| own.row);
        for own in entries
            .into_iter()
            .filter(|own| seen.contains(&own.symbol.code))
        {
            legend.entry(self.label(own.row), own);
        }
        legend.is_placed = self.setup.robot().is_tree();
        legend.has_numeric_centres = self.arm.has_numeric_centres;
        legend
    }
}

/// Puts a sum of one term beside its factors, and makes one number of all numbers.
fn flat(term: Term) -> Term {
    let mut term = spliced(term);
    let mut measured = false;
    let mut number = Number::one();
    term.factors.retain(|factor| match factor {
        Factor::Number(x) => {
            measured = true;
            number = number.mul(x);
            false
        }
        Factor::Exact(x) => {
            number = number.mul(x);
            false
        }
        _ => true,
    });
    if !number.is_one() {
        let number = if measured {
            Factor::Number(number)
        } else {
            Factor::Exact(number)
        };
        term.factors.insert(0, number);
    }
    term
}

fn spliced(mut term: Term) -> Term {
    let place = term
        .factors
        .iter()
        .position(|factor| matches!(factor, Factor::Sum(sum) if sum.len() == 1));
    let Some(place) = place else { return term };
    let Factor::Sum(mut sum) = term.factors.remove(place) else {
        return term;
    };
    if let Some(inner) = sum.pop() {
        term.is_negative ^= inner.is_negative;
        term.factors.splice(place..place, inner.factors);
    }
    term
}

/// Notes the symbols of a sum, by their identifiers.
fn see(sum: &[Term], seen: &mut BTreeSet<String>) {
    for factor in sum.iter().flat_map(|term| &term.factors) {
        match factor {
            Factor::Symbol(symbol, _) => {
                seen.insert(symbol.code.clone());
            }
            Factor::Sum(sum) => see(sum, seen),
            Factor::Number(_) | Factor::Exact(_) | Factor::Wave(..) => {}
        }
    }
}

fn pairs(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(move |i| (i..n).map(move |k| (i, k)))
}

/// Lists the names and the polynomials of D, h or c, symmetric ones once.
fn coefficients_of(
    coefficients: &Coefficients,
    quantity: Quantity,
) -> (Vec<Symbol>, Vec<Polynomial>) {
    let n = coefficients.gravity.len();
    match quantity {
        Quantity::Gravity => {
            let names = (0..n).map(|i| quantity.entry(&[i]));
            (names.collect(), coefficients.gravity.clone())
        }
        Quantity::Inertia | Quantity::InertiaRotation | Quantity::InertiaTranslation => {
            let names = pairs(n).map(|(i, k)| quantity.entry(&[i, k]));
            let entries = pairs(n).map(|(i, k)| coefficients.inertia[i][k].clone());
            (names.collect(), entries.collect())
        }
        _ => {
            let all = || (0..n).flat_map(|i| pairs(n).map(move |(k, m)| (i, k, m)));
            let names = all().map(|(i, k, m)| quantity.entry(&[i, k, m]));
            let entries = all().map(|(i, k, m)| coefficients.christoffel[i][k][m].clone());
            (names.collect(), entries.collect())
        }
    }
}

/// Returns the nested list of a quantity's entries.
fn list(quantity: Quantity, n: usize) -> Option<List> {
    let [letters, mark] = quantity.letters();
    let name = match quantity {
        Quantity::Torque => "tau".to_owned(),
        _ => format!("{letters}{mark}"),
    };
    let (entries, lengths): (Vec<Symbol>, Vec<usize>) = match quantity {
        Quantity::Gravity | Quantity::Torque => {
            ((0..n).map(|i| quantity.entry(&[i])).collect(), vec![n])
        }
        Quantity::Inertia | Quantity::InertiaRotation | Quantity::InertiaTranslation => {
            let all = (0..n).flat_map(|i| (0..n).map(move |k| [i.min(k), i.max(k)]));
            (
                all.map(|indices| quantity.entry(&indices)).collect(),
                vec![n, n],
            )
        }
        Quantity::Christoffel
        | Quantity::ChristoffelRotation
        | Quantity::ChristoffelTranslation => {
            let all = (0..n).flat_map(move |i| {
                (0..n).flat_map(move |k| (0..n).map(move |m| [i, k.min(m), k.max(m)]))
            });
            (
                all.map(|indices| quantity.entry(&indices)).collect(),
                vec![n, n, n],
            )
        }
        Quantity::Pose => {
            let all = (0..3).flat_map(|r| (0..3).map(move |c| [r, c]));
            (
                all.map(|indices| quantity.entry(&indices)).collect(),
                vec![3, 3],
            )
        }
        Quantity::Jacobian => {
            let all = (0..6).flat_map(|r| (0..n).map(move |c| [r, c]));
            (
                all.map(|indices| quantity.entry(&indices)).collect(),
                vec![6, n],
            )
        }
        Quantity::KineticEnergy | Quantity::PotentialEnergy => return None,
    };
    Some(List {
        name,
        entries,
        lengths,
    })
}

/// Finds the joints that turn about parallel axes, one carried by the other.
fn runs(setup: &Setup, arm: &SymbolicArm, chain: &SymbolicChain) -> Runs {
    let robot = setup.robot();
    let variable = |joint: usize| arm.variables.iter().find(|own| own.joint == joint);
    let mut runs: Vec<Vec<usize>> = Vec::new();
    let mut run_of_link: Vec<Option<usize>> = Vec::new();
    for (link, row) in chain.chain.links.iter().zip(&chain.rows) {
        let before = link.parent.and_then(|parent| run_of_link[parent]);
        if link.kind == JointKind::Prismatic {
            run_of_link.push(before);
            continue;
        }
        let is_parallel = link.rotation[0][2].is_zero() && link.rotation[1][2].is_zero();
        let run = match before.filter(|_| is_parallel) {
            Some(run) => run,
            None => {
                runs.push(Vec::new());
                runs.len() - 1
            }
        };
        run_of_link.push(Some(run));
        let joint = robot.mover_of(*row);
        let is_new = runs.iter().all(|run| !run.contains(&joint));
        if is_new && variable(joint).is_some() {
            runs[run].push(joint);
        }
    }
    for run in &mut runs {
        run.sort_unstable();
    }
    runs.retain(|run| !run.is_empty());
    let slides = arm
        .variables
        .iter()
        .filter(|own| own.kind == JointKind::Prismatic);
    Runs {
        runs,
        slides: slides.map(|own| own.joint).collect(),
    }
}
