//! Builds the formulas of a robot: coefficients as polynomials, then as lines in the style that is asked for.

mod legend;
mod motion;
mod sections;

use std::rc::Rc;

use dalembert_codegen::Diagnostic;
use dalembert_codegen::workspace::Setup;
use dalembert_model::equations::dalembert::Part;
use dalembert_model::scalar::Scalar;

use crate::arm::{PosedChain, Symbolic, SymbolicArm};
use crate::bodies::BaseBodies;
use crate::canonical::{Runs, Splits, Terms};
use crate::entries::{Coefficients, hand, jacobian, potential_energy};
use crate::error;
use crate::expression::{Factor, Sum, by_symbols, with_numbers};
use crate::formulas::{Formulas, Request, Style};
use crate::line::Section;
use crate::lists::coefficients_of;
use crate::names::{Names, SharedConstants};
use crate::number::Number;
use crate::quantity::Quantity;
use crate::ring::Polynomial;
use crate::rows::{Moments, Rows};
use crate::runs::runs;
use crate::symbol::{Definition, Symbol};

/// A small arm's entries have at most so many products in the file's symbols.
const SMALL: usize = 12;
/// And it has at most so many joints.
const FEW_JOINTS: usize = 4;

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

/// The builder of the formulas of one robot.
pub struct Builder<'a> {
    setup: &'a Setup,
    request: &'a Request,
    arm: SymbolicArm,
    runs: Runs,
    tables: Vec<Table>,
    sources: Vec<Source>,
    coefficients: Coefficients<Polynomial>,
    shared: SharedConstants,
}

/// Coefficients, the table of their symbols, and the moments that rows are multiplied by.
type InSymbols = Result<(Coefficients<Polynomial>, usize, Option<Rc<Moments>>), Diagnostic>;

/// The place of the table of the robot file's own symbols.
const OF_FILE: usize = 0;

impl<'a> Builder<'a> {
    /// Computes the polynomials that are asked for.
    pub fn new(setup: &'a Setup, request: &'a Request) -> Result<Self, Diagnostic> {
        let symbolic = match request.style {
            Style::Numbers => Symbolic::Nothing,
            _ => Symbolic::Everything,
        };
        let arm = SymbolicArm::new(setup, symbolic)?;
        if setup.rows().is_empty() {
            return Err(error::nothing());
        }
        let moving = arm.variables.iter().map(|variable| variable.joint);
        let has_motion = [Quantity::Torque, Quantity::KineticEnergy];
        if request
            .quantities
            .iter()
            .any(|quantity| has_motion.contains(quantity))
            && !moving.eq(setup.rows().iter().copied())
        {
            return Err(error::rows());
        }
        let chain = arm.chain(&arm.arm);
        let of_file = arm
            .parameters
            .iter()
            .map(|definition| (definition.symbol.clone(), definition.value));
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
        let is_of_hand = |quantity: &Quantity| {
            matches!(
                quantity,
                Quantity::Pose | Quantity::Jacobian | Quantity::PotentialEnergy
            )
        };
        let (table, moments) = match request.quantities.iter().all(is_of_hand) {
            true => (OF_FILE, None),
            false => {
                let (coefficients, table, moments) = builder.whole(&chain)?;
                builder.coefficients = coefficients;
                (table, moments)
            }
        };
        builder.collect(table, moments)?;
        Ok(builder)
    }

    /// Computes the coefficients of the robot, in the symbols of the file if they stay short, else in
    /// base parameters.
    fn whole(&mut self, chain: &PosedChain<Polynomial>) -> InSymbols {
        if self.request.style == Style::File {
            return Ok((self.in_file(chain)?, OF_FILE, None));
        }
        if self.request.style != Style::Numbers && self.arm.variables.len() <= FEW_JOINTS {
            let coefficients = self.in_file(chain)?;
            let mut entries = coefficients
                .inertia
                .iter()
                .flatten()
                .chain(coefficients.christoffel.iter().flatten().flatten())
                .chain(&coefficients.gravity);
            if entries.all(|entry| entry.terms().len() <= SMALL) {
                return Ok((coefficients, OF_FILE, None));
            }
        }
        self.in_base_parameters(chain, "")
    }

    fn in_file(
        &self,
        chain: &PosedChain<Polynomial>,
    ) -> Result<Coefficients<Polynomial>, Diagnostic> {
        self.arm.coefficients(self.setup, chain, &chain.chain)
    }

    fn in_base_parameters(&mut self, chain: &PosedChain<Polynomial>, mark: &str) -> InSymbols {
        let bodies = BaseBodies::new(&self.arm, chain, mark);
        let symbols = bodies
            .parameters
            .iter()
            .map(|parameter| parameter.symbol.clone());
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
            return Ok((self.in_file(chain)?, OF_FILE, moments));
        }
        let coefficients = self.arm.coefficients(self.setup, chain, &bodies.chain)?;
        self.tables.push(Table {
            parameters,
            definitions: bodies.parameters,
        });
        Ok((coefficients, self.tables.len() - 1, moments))
    }

    /// Lists the polynomials of all quantities that are asked for.
    fn collect(&mut self, table: usize, moments: Option<Rc<Moments>>) -> Result<(), Diagnostic> {
        let n = self.setup.rows().len();
        for &quantity in &self.request.quantities {
            match quantity {
                Quantity::Inertia | Quantity::Christoffel | Quantity::Gravity => {
                    let (names, polynomials) = named(&self.coefficients, quantity);
                    let source = self.source(quantity, names, polynomials, table);
                    source.moments = moments.clone();
                }
                Quantity::InertiaRotation
                | Quantity::InertiaTranslation
                | Quantity::ChristoffelRotation
                | Quantity::ChristoffelTranslation => self.part(quantity)?,
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
        let mut polynomials = self.sources.iter().flat_map(|source| &source.polynomials);
        match polynomials.any(Polynomial::is_lost) {
            true => Err(error::large()),
            false => Ok(()),
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
    fn part(&mut self, quantity: Quantity) -> Result<(), Diagnostic> {
        let (part, mark) = match quantity {
            Quantity::InertiaRotation | Quantity::ChristoffelRotation => (Part::Rotation, "r"),
            _ => (Part::Translation, "t"),
        };
        let arm = part.of(&self.arm.arm);
        let chain = self.arm.chain(&arm);
        let is_small = self.request.style != Style::Numbers && self.tables.len() == 1;
        let (coefficients, table, moments) = match is_small {
            true => (self.in_file(&chain)?, OF_FILE, None),
            false => self.in_base_parameters(&chain, mark)?,
        };
        let (names, polynomials) = named(&coefficients, quantity);
        let source = self.source(quantity, names, polynomials, table);
        source.moments = moments;
        Ok(())
    }

    /// Writes the formulas.
    pub fn build(mut self) -> Result<Formulas, Diagnostic> {
        let sources = std::mem::take(&mut self.sources);
        let chain = self.arm.chain(&self.arm.arm);
        let mut rows = Rows::new(&chain, self.driven(&chain));
        let mut sections: Vec<Section> = sources
            .iter()
            .map(|source| match source.quantity {
                Quantity::Torque => self.torques(source.table),
                Quantity::KineticEnergy => self.kinetic_energy(source.table),
                _ => self.section(source, &mut rows),
            })
            .collect();
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
            rows: self.setup.robot().rows().len(),
            results: self.setup.rows().to_vec(),
        })
    }

    /// Returns the links that each coordinate drives, with what each moves for a unit of it.
    fn driven(&self, chain: &PosedChain<Polynomial>) -> Vec<Vec<(usize, Number)>> {
        let robot = self.setup.robot();
        let drives = |&joint: &usize| {
            let leader = robot.row_of(joint);
            let links = chain.rows.iter().enumerate();
            let driven = links.filter_map(|(link, &row)| {
                let mut following = self.arm.arm.following.iter();
                let follower = following.find(|other| other.row == row && other.leader == leader);
                match follower {
                    Some(follower) => Some((link, follower.multiplier.to_constant()?)),
                    None => (row == leader).then(|| (link, Number::one())),
                }
            });
            driven.collect()
        };
        self.setup.rows().iter().map(drives).collect()
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
            _ => {
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
}

/// Lists the names and the polynomials of D, h or c.
fn named(
    coefficients: &Coefficients<Polynomial>,
    quantity: Quantity,
) -> (Vec<Symbol>, Vec<Polynomial>) {
    let entries = coefficients_of(coefficients, quantity).into_iter();
    entries
        .map(|(indices, polynomial)| (quantity.entry(&indices), polynomial.clone()))
        .unzip()
}
