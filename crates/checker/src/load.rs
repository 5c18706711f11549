//! The load: the numbers that the function `load` makes of a payload, over all bodies that one may be.

use crate::fault::Fault;
use crate::identity::exact::Exact;
use crate::identity::setting::Setting;
use crate::interval::Interval;
use crate::program::{ARGUMENTS, Operand, Program, Step, argument};
use crate::read;
use crate::rounding::{Ranges, Rounding, Value};
use crate::written::at;

/// The name of the function, and of the argument that takes what it returns.
pub(crate) const LOAD: &str = "load";
/// The points of which a body is made: fewer have no inertia about some axis.
const POINTS: usize = 5;

/// The bodies that a payload may be: all of the mass is within a radius of the origin of its frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// The range of the mass, kg.
    pub mass: [f64; 2],
    /// The radius, m.
    pub radius: f64,
}

impl Default for Body {
    fn default() -> Body {
        let (mass, radius) = ([0.0, 5.0], 0.3);
        Body { mass, radius }
    }
}

impl Body {
    /// Returns bodies beyond what decimals lose in doubles, and numbers in f32.
    fn outward(self, is_single: bool) -> Body {
        let up = |x: f64| match is_single {
            _ if x == 0.0 => x,
            true => f64::from((x as f32).next_up()),
            false => x.next_up(),
        };
        let [low, high] = self.mass;
        Body {
            mass: [(2.0 * low - up(low)).max(0.0), up(high)],
            radius: up(self.radius),
        }
    }

    /// Returns the ranges of the ten numbers: mass, centre of mass, and inertia about that as xx,
    /// yy, zz, xy, yz, xz.
    pub(crate) fn ranges(self) -> Vec<[f64; 2]> {
        let Body { mass, radius } = self;
        // Rounded up: zero stays zero.
        let up = |x: f64| if x == 0.0 { x } else { x.next_up() };
        let most = up(up(mass[1] * radius) * radius);
        let symmetric = |most: f64| [-most, most];
        [
            vec![mass],
            vec![symmetric(radius); 3],
            vec![[0.0, most]; 3],
            // |∫ x y dm| ≤ ½ ∫ (x² + y²) dm
            vec![symmetric(0.5 * most); 3],
        ]
        .concat()
    }

    /// Draws one as points of mass, from numbers of zero to one: mass, centre of mass, and inertia about
    /// that as xx, yy, zz, xy, yz, xz.
    pub fn draw(self, share: &mut impl FnMut() -> f64) -> Vec<f64> {
        let Body { mass, radius } = self;
        let mass = mass[0] + (mass[1] - mass[0]) * share();
        let mut points = [([0.0; 3], 0.0); POINTS];
        let mut sum = 0.0;
        for (at, weight) in &mut points {
            // In the cube inside the ball, not beyond it.
            let side = radius / 3f64.sqrt();
            *at = [(); 3].map(|()| side * (2.0 * share() - 1.0));
            *weight = share() + 1e-3;
            sum += *weight;
        }
        let mean = |f: &dyn Fn([f64; 3]) -> f64| -> f64 {
            let parts = points.iter().map(|(at, weight)| f(*at) * weight / sum);
            parts.sum()
        };
        let com = [0, 1, 2].map(|k| mean(&|at| at[k]));
        let moment = |i: usize, k: usize| mass * mean(&|at| (at[i] - com[i]) * (at[k] - com[k]));
        let about = |i: usize, k: usize| moment(i, i) + moment(k, k);
        let [x, y, z] = com;
        let inertia = [about(1, 2), about(2, 0), about(0, 1)];
        let products = [-moment(0, 1), -moment(1, 2), -moment(0, 2)];
        [vec![mass, x, y, z], inertia.to_vec(), products.to_vec()].concat()
    }
}

impl Setting<'_> {
    /// Returns the box of a function's states, with that of its load and the load's entries; of a
    /// function that takes none they are empty.
    pub(crate) fn loaded_box(
        &self,
        places: &[usize],
        is_single: bool,
        load: Option<&Program<Exact>>,
    ) -> Result<(Ranges, Vec<Value>), Fault> {
        let of_robot = |why| Fault::Robot("limits".into(), why);
        let mut ranges = self.state_box(places, is_single)?;
        let (Some(load), Some(place), Some(payload)) = (load, argument(LOAD), argument("payload"))
        else {
            return Ok((ranges, Vec::new()));
        };
        let body = self.body().map_err(of_robot)?.unwrap_or_default();
        ranges[payload] = body.outward(is_single).ranges();
        let text = literals(load);
        let values = Rounding::new(&text, is_single, &ranges).bounds(&ranges, None);
        let values = values.results;
        let entries = values.iter().map(|own| [own.exact.low, own.exact.high]);
        ranges[place] = entries.collect();
        Ok((ranges, values))
    }
}

pub(crate) fn load_of_point(
    load: &Program<Exact>,
    mass: f64,
    at_point: [f64; 3],
) -> Result<Vec<Interval>, Fault> {
    let numbers = [&[mass][..], &at_point, &[0.0; 6]].concat();
    let mut given = vec![Vec::new(); ARGUMENTS.len()];
    let numbers = numbers.into_iter().map(Interval::point);
    given[argument("payload").unwrap_or_default()] = numbers.collect();
    let values = at(load, &given);
    values.ok_or_else(|| Fault::Claim("`load` reads what is not a payload".into()))
}

/// Returns a program with the nearest double in place of each constant.
pub(crate) fn literals(own: &Program<Exact>) -> read::Function {
    let operand = |own: &Operand<Exact>| match own {
        // An angle beyond the series' range is not a number.
        Operand::Constant(own) => Operand::Constant(own.double().map_or(f64::NAN, |own| own[0])),
        Operand::Step(step) => Operand::Step(*step),
        Operand::Entry(place, index) => Operand::Entry(*place, *index),
        Operand::Sine(joint, is_sine) => Operand::Sine(*joint, *is_sine),
        Operand::Speed(joint) => Operand::Speed(*joint),
    };
    let step = |(operation, both): &Step<Exact>| (*operation, both.each_ref().map(operand));
    let output = |(negative, own): &(bool, Operand<Exact>)| (*negative, operand(own));
    read::Function {
        program: Program {
            steps: own.steps.iter().map(step).collect(),
            outputs: own.outputs.iter().map(output).collect(),
        },
        ..read::Function::default()
    }
}
