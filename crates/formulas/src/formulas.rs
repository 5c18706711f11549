//! The formulas of a robot: coefficients as polynomials, then as lines in the style that is asked for.

mod legend;
mod motion;
mod sections;

use std::rc::Rc;

use dalembert_codegen::Diagnostic;
use dalembert_codegen::words;
use dalembert_codegen::workspace::Setup;
use dalembert_model::equations::dalembert::Part;
use dalembert_model::equations::matrix::Columns;
use dalembert_model::robot::Robot;
use dalembert_model::scalar::Scalar;
use dalembert_model::scene::Scene;

use crate::arm::{PosedChain, Symbolic, SymbolicArm, Variable};
use crate::bodies::BaseBodies;
use crate::canonical::{Runs, Splits, Terms, runs};
use crate::entries::{Coefficients, hand, jacobian, potential_energy};
use crate::error;
use crate::expression::{Factor, Sum, by_symbols, with_numbers};
use crate::legend::Legend;
use crate::line::{Section, coefficients_of};
use crate::names::{Names, SharedConstants};
use crate::number::Number;
use crate::quantity::Quantity;
use crate::ring::Polynomial;
use crate::rows::{Moments, Rows};
use crate::symbol::{Definition, Symbol};

words! {
    /// The symbols that formulas are written in.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    pub enum Style: "style of formulas" {
        /// Numbers alone.
        #[default]
        Numbers = "numbers",
        /// Lengths and base parameters; of a small arm masses, centres of mass and inertias.
        Names = "names",
        /// Constants K1, K2, … that coefficients share.
        Constants = "constants",
        /// Lengths, masses, centres of mass and inertias, whatever the size of the arm.
        File = "file",
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
    /// The number of its rows: joints that follow others have rows too.
    pub rows: usize,
    /// The joints of the results, counted from zero.
    pub results: Vec<usize>,
}

/// The most products in the file's symbols that an entry of a small arm has.
const SMALL: usize = 12;
/// The most joints of a small arm.
const FEW_JOINTS: usize = 4;

type Entries = Vec<(Symbol, Polynomial)>;

/// Polynomials of one quantity, in symbols of one table.
struct Source {
    quantity: Quantity,
    entries: Entries,
    table: usize,
    /// The moments that rows of the axes are multiplied by, of coefficients that may be large.
    moments: Option<Rc<Moments>>,
}

/// Symbols of inertial parameters with their values; base parameters have definitions.
#[derive(Default)]
struct Table {
    parameters: Vec<(Symbol, Number)>,
    definitions: Vec<Definition<Polynomial>>,
}

/// The builder of the formulas of one robot.
struct Builder<'a> {
    setup: &'a Setup,
    quantities: Vec<Quantity>,
    style: Style,
    arm: SymbolicArm,
    runs: Runs,
    tables: Vec<Table>,
    sources: Vec<Source>,
    coefficients: PolynomialCoefficients,
    shared: SharedConstants,
}

type PolynomialCoefficients = Coefficients<Polynomial>;

/// Coefficients, the table of their symbols, and the moments that rows are multiplied by.
type WithSymbols<C> = (C, usize, Option<Rc<Moments>>);

/// The place of the table of the robot file's own symbols.
const OF_FILE: usize = 0;

impl Formulas {
    /// Writes the formulas of a robot, whole or in a scene.
    ///
    /// # Errors
    /// The robot has none.
    pub fn new(
        robot: &Robot,
        scene: Option<&Scene>,
        request: &Request,
    ) -> Result<Formulas, Diagnostic> {
        Builder::new(&Setup::in_scene(robot, scene)?, request)?.build()
    }
}

/// Puts the coefficients that torques and energies name before them, and each quantity once.
fn with_needed(asked: &[Quantity]) -> Vec<Quantity> {
    let needed = match () {
        () if asked.contains(&Quantity::Torque) => {
            &[Quantity::Inertia, Quantity::Christoffel, Quantity::Gravity][..]
        }
        () if asked.contains(&Quantity::KineticEnergy) => &[Quantity::Inertia],
        () => &[],
    };
    let mut quantities: Vec<Quantity> = Vec::new();
    for quantity in needed.iter().chain(asked) {
        if !quantities.contains(quantity) {
            quantities.push(*quantity);
        }
    }
    quantities
}

impl<'a> Builder<'a> {
    /// Computes the polynomials that are asked for.
    fn new(setup: &'a Setup, request: &Request) -> Result<Self, Diagnostic> {
        use Quantity::{Jacobian, KineticEnergy, Pose, PotentialEnergy, Torque};
        let (quantities, style) = (with_needed(&request.quantities), request.style);
        let symbolic = match style {
            Style::Numbers => Symbolic::Nothing,
            _ => Symbolic::Everything,
        };
        let arm = SymbolicArm::new(setup, symbolic)?;
        if setup.rows().is_empty() {
            return Err(error::nothing());
        }
        let moving = arm.variables.iter().map(|variable| variable.joint);
        let has_motion = quantities.contains(&Torque) || quantities.contains(&KineticEnergy);
        if has_motion && !moving.eq(setup.rows().iter().copied()) {
            return Err(error::rows());
        }
        let chain = arm.chain(&arm.arm);
        let mut of_file = Table::default();
        for Definition { symbol, value, .. } in &arm.symbols.parameters {
            of_file.parameters.push((symbol.clone(), *value));
        }
        let mut builder = Builder {
            setup,
            quantities,
            style,
            runs: runs(setup, &arm, &chain),
            tables: vec![of_file],
            sources: Vec::new(),
            coefficients: Coefficients::default(),
            shared: SharedConstants::default(),
            arm,
        };
        let (mut table, mut moments) = (OF_FILE, None);
        let is_of_arm = |quantity| !matches!(quantity, Pose | Jacobian | PotentialEnergy);
        if builder.quantities.iter().copied().any(is_of_arm) {
            (builder.coefficients, table, moments) = builder.whole(&chain)?;
        }
        builder.collect(table, moments)?;
        Ok(builder)
    }

    /// Computes the coefficients of the robot, in the symbols of the file if they stay short, else in
    /// base parameters.
    fn whole(
        &mut self,
        chain: &PosedChain<Polynomial>,
    ) -> Result<WithSymbols<PolynomialCoefficients>, Diagnostic> {
        let is_few = self.style != Style::Numbers && self.arm.variables.len() <= FEW_JOINTS;
        if is_few || self.style == Style::File {
            let coefficients = self.in_file(chain)?;
            let (d, h) = (&coefficients.inertia, &coefficients.christoffel);
            let entries = d.iter().chain(h.iter().flatten()).flatten();
            let mut entries = entries.chain(&coefficients.gravity);
            if self.style == Style::File || entries.all(|entry| entry.terms().len() <= SMALL) {
                return Ok((coefficients, OF_FILE, None));
            }
        }
        self.in_base_parameters(chain, "")
    }

    fn in_file(
        &self,
        chain: &PosedChain<Polynomial>,
    ) -> Result<PolynomialCoefficients, Diagnostic> {
        self.arm.coefficients(self.setup, chain, &chain.chain)
    }

    fn in_base_parameters(
        &mut self,
        chain: &PosedChain<Polynomial>,
        mark: &str,
    ) -> Result<WithSymbols<PolynomialCoefficients>, Diagnostic> {
        let bodies = BaseBodies::new(&self.arm, chain, mark);
        let mut parameters = Vec::new();
        for (parameter, value) in bodies.parameters.iter().zip(bodies.values) {
            parameters.push((parameter.symbol.clone(), value));
        }
        let is_numeric = self.style == Style::Numbers;
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
        for quantity in self.quantities.clone() {
            let (entries, table, moments) = match quantity {
                Quantity::Inertia | Quantity::Christoffel | Quantity::Gravity => {
                    (named(&self.coefficients, quantity), table, moments.clone())
                }
                Quantity::InertiaRotation
                | Quantity::InertiaTranslation
                | Quantity::ChristoffelRotation
                | Quantity::ChristoffelTranslation => self.part(quantity)?,
                Quantity::PotentialEnergy => {
                    let entry = (quantity.entry(&[]), potential_energy(&self.arm));
                    (vec![entry], OF_FILE, None)
                }
                Quantity::Pose => {
                    let Columns { axes, origin } = hand(&self.arm);
                    let rows = (0..3).map(|r| axes.each_ref().map(|axis| axis[r].clone()));
                    let mut entries = in_rows(quantity, rows);
                    let names = ["x", "y", "z"].map(|axis| Symbol::indexed("p", axis));
                    entries.extend(names.into_iter().zip(origin));
                    (entries, OF_FILE, None)
                }
                Quantity::Jacobian => {
                    let rows = jacobian(self.setup, &self.arm);
                    (in_rows(quantity, rows), OF_FILE, None)
                }
                Quantity::Torque | Quantity::KineticEnergy => (Vec::new(), table, None),
            };
            if entries.iter().any(|(_, entry)| entry.is_lost()) {
                return Err(error::large());
            }
            self.sources.push(Source {
                quantity,
                entries,
                table,
                moments,
            });
        }
        Ok(())
    }

    /// Computes a part of generalized D'Alembert: the coefficients of an arm that has it alone.
    fn part(&mut self, quantity: Quantity) -> Result<WithSymbols<Entries>, Diagnostic> {
        let (part, mark) = match quantity {
            Quantity::InertiaRotation | Quantity::ChristoffelRotation => (Part::Rotation, "r"),
            _ => (Part::Translation, "t"),
        };
        let arm = part.of(&self.arm.arm);
        let chain = self.arm.chain(&arm);
        let is_small = self.style != Style::Numbers && self.tables.len() == 1;
        let (coefficients, table, moments) = match is_small {
            true => (self.in_file(&chain)?, OF_FILE, None),
            false => self.in_base_parameters(&chain, mark)?,
        };
        Ok((named(&coefficients, quantity), table, moments))
    }

    fn build(mut self) -> Result<Formulas, Diagnostic> {
        let sources = std::mem::take(&mut self.sources);
        let chain = self.arm.chain(&self.arm.arm);
        let mut rows = Rows::new(&chain, self.driven(&chain));
        let mut sections: Vec<Section> = Vec::new();
        for source in &sources {
            sections.push(match source.quantity {
                Quantity::Torque => self.torques(source.table),
                Quantity::KineticEnergy => self.kinetic_energy(source.table),
                _ => self.section(source, &mut rows),
            });
        }
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
                match following.find(|other| other.row == row && other.leader == leader) {
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
        let sum = |place| self.sum(&splits.terms(place), table);
        (0..polynomials.len()).map(sum).collect()
    }

    fn sum(&mut self, terms: &Terms, table: usize) -> Sum {
        match self.style {
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

/// Lists the entries of D, h or c.
fn named(coefficients: &PolynomialCoefficients, quantity: Quantity) -> Entries {
    let entries = coefficients_of(coefficients, quantity).into_iter();
    let named = entries.map(|(indices, entry)| (quantity.entry(&indices), entry.clone()));
    named.collect()
}

/// Lists the entries of a matrix, row by row.
fn in_rows<R>(quantity: Quantity, rows: impl IntoIterator<Item = R>) -> Entries
where
    R: IntoIterator<Item = Polynomial>,
{
    let mut entries = Entries::new();
    for (r, row) in rows.into_iter().enumerate() {
        let named = row.into_iter().enumerate();
        entries.extend(named.map(|(c, entry)| (quantity.entry(&[r, c]), entry)));
    }
    entries
}
