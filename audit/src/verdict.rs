//! The audit of one claim, and what it found.

use std::fmt;

use crate::certificate::{Claim, Function};
use crate::fault::Fault;
use crate::maximum;
use crate::number::{Ball, Number};
use crate::polynomial::{Polynomial, Work};
use crate::ring::Ring;
use crate::sample;
use crate::scene::{self, Ranges, Setting};
use crate::text;
use crate::values;

/// At how many states the text is run.
const STATES: usize = 2000;
/// By how much a box may be smaller than the file's: decimals were rounded to doubles.
const BOX_SLACK: f64 = 1e-9;

/// What was found of one output; all in its own unit.
#[derive(Clone, Debug)]
pub struct Output {
    /// T
    pub scale: f64,
    /// Bound of what the text differs from the function in real numbers.
    pub edits: f64,
    /// Bound of what rounding and library sines cost.
    pub rounding: f64,
    /// The claim, E·T.
    pub claimed: f64,
    /// The user's tolerance times T, if the scene has one.
    pub tolerated: Option<f64>,
    /// The largest difference at the states that were run.
    pub seen: f64,
}

impl Output {
    /// The own bound.
    pub fn bound(&self) -> f64 {
        (self.edits + self.rounding).next_up()
    }

    /// Whether E is shown.
    pub fn holds(&self) -> bool {
        self.bound() <= self.claimed
    }

    /// Whether the user's tolerance is shown.
    pub fn is_tolerated(&self) -> bool {
        self.tolerated.is_some_and(|tolerated| self.bound() <= tolerated)
    }
}

/// What was found of a claim.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// The name of the function.
    pub name: String,
    /// Whether it is in f32; else it is in f64.
    pub is_single: bool,
    /// One an output.
    pub outputs: Vec<Output>,
}

impl Verdict {
    /// Whether every output is shown to be within its E, or within the user's tolerance.
    pub fn is_shown(&self) -> bool {
        self.outputs.iter().all(|output| output.holds() || output.is_tolerated())
    }
}

/// Audits one claim about a robot of which the file is given. Nothing but the claim's
/// text, box, T and E is taken from it.
///
/// # Errors
/// A file or text that this checker does not know, a claim that is not about this robot
/// or is contradicted, or more work than it does.
pub fn audit(claim: &Claim, robot: &str) -> Result<Verdict, Fault> {
    let setting = scene::read(robot, claim.scene.as_deref())?;
    about(claim, &setting)?;
    let program = text::read(&claim.text, setting.locks.len(), claim.rows.len())?;
    if program.name != claim.name || program.is_single != claim.is_single {
        return Err(Fault::certificate("the text is of another function or scalar"));
    }
    let work = &mut Work::default();
    let ring = Ring::new(&setting, &claim.ranges, work)?;
    let texts = values::outputs(&program, &setting, &claim.ranges, &ring, work)?;
    let one = <Polynomial as Number>::constant(Ball::exact(1.0));
    let formulas = sample::outputs(claim, &setting, &ring.states, work, &Polynomial::default(), &one)?;
    if texts.len() != formulas.len() {
        return Err(Fault::certificate("the text returns another number of results"));
    }
    let seen = sample::worst(claim, &setting, &program, STATES)?;
    let mut outputs = Vec::new();
    for (index, (value, formula)) in texts.iter().zip(&formulas).enumerate() {
        let (scale, size) = (claim.scale[index], ring.size(formula));
        attainable(claim, &setting, index, size)?;
        let claimed = (claim.total[index] * scale).next_down();
        let tolerance = setting.tolerance.as_ref().map(|all| {
            joints(claim, index).into_iter().map(|joint| all[joint]).fold(f64::INFINITY, f64::min)
        });
        let tolerated = tolerance.map(|tolerance| (tolerance * scale).next_down());
        let difference = value.exact.plus(&formula.negated());
        let wanted = claimed - value.error.next_up();
        let output = Output {
            scale,
            edits: maximum::bound(&difference, &ring, wanted.next_down()),
            rounding: value.error,
            claimed,
            tolerated,
            seen: seen[index],
        };
        // What is seen is rounded as well, of the recursion by far less than this.
        if !(output.seen <= output.bound() + 1e-9 * size) {
            let why = format!("output {} is off by {:.3e} at a state", index + 1, output.seen);
            return Err(Fault::certificate(format!("{why}, more than the audit's own bound")));
        }
        outputs.push(output);
    }
    Ok(Verdict { name: claim.name.clone(), is_single: claim.is_single, outputs })
}

/// The joints of an output: one, of an entry of D two.
fn joints(claim: &Claim, index: usize) -> Vec<usize> {
    let rows = &claim.rows;
    match claim.function {
        Function::Inertia => vec![rows[index / rows.len()], rows[index % rows.len()]],
        _ => vec![rows[index]],
    }
}

/// Whether a claim is about this robot in its scene: the same rows, a box that has all
/// states of the file's, a scale of the same kind.
fn about(claim: &Claim, setting: &Setting) -> Result<(), Fault> {
    if claim.rows != setting.rows {
        return Err(Fault::certificate("`rows` are not those of the scene"));
    }
    if setting.tolerance.is_some() && claim.relative_to != setting.relative_to {
        return Err(Fault::certificate("`relative_to` is not that of the scene"));
    }
    let Ranges { position, velocity, acceleration } = &setting.ranges;
    let inside = |own: &[f64; 2], claimed: &[f64; 2]| {
        let slack = BOX_SLACK * (own[0].abs() + own[1].abs());
        // What the file does not limit has no numbers here, and is in nothing.
        claimed[0] - slack <= own[0] && own[1] <= claimed[1] + slack
    };
    let holds = |claimed: &[[f64; 2]], own: &[[f64; 2]]| {
        claimed.len() == own.len() && own.iter().zip(claimed).all(|(own, claimed)| inside(own, claimed))
    };
    let ranges = &claim.ranges;
    let rates = match claim.function {
        Function::InverseDynamics => [true, true],
        Function::Coriolis => [true, false],
        Function::Gravity | Function::Inertia => [false, false],
    };
    let all = holds(&ranges.position, position)
        && (!rates[0] || holds(&ranges.velocity, velocity))
        && (!rates[1] || holds(&ranges.acceleration, acceleration));
    all.then_some(()).ok_or_else(|| {
        Fault::certificate("the box does not have all states of the scene, or of the joints' limits")
    })
}

/// Refuses a T that makes E look smaller than it is: above the actuators' limits, or
/// above any value that the output takes.
fn attainable(claim: &Claim, setting: &Setting, index: usize, size: f64) -> Result<(), Fault> {
    let limit = |joint: usize, which: usize| {
        setting.robot.joints[joint].limits[which].unwrap_or(f64::NAN)
    };
    let pair = joints(claim, index);
    let (i, k) = (pair[0], pair[pair.len() - 1]);
    let most = match (claim.relative_to.as_deref(), claim.function) {
        (Some("actuator"), Function::Inertia) => {
            let alone = |i: usize, k: usize| limit(i, 2) / setting.ranges.acceleration[k][1];
            alone(i, k).min(alone(k, i))
        }
        (Some("actuator"), _) => limit(i, 2),
        (Some("range"), _) => size,
        _ => return Err(Fault::certificate("`relative_to` is neither actuator nor range")),
    };
    let why = || format!("`scale` of output {} is not at most {most:.4e}", index + 1);
    let good = claim.scale[index] >= 0.0 && claim.scale[index] <= most * (1.0 + BOX_SLACK);
    good.then_some(()).ok_or_else(|| Fault::certificate(why()))
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let scalar = if self.is_single { "f32" } else { "f64" };
        writeln!(f, "`{}` in {scalar}, errors relative to T", self.name)?;
        writeln!(f, "  output           T     edits  rounding     bound         E      seen")?;
        for (index, output) in self.outputs.iter().enumerate() {
            let of = |x: f64| if x == 0.0 { 0.0 } else { x / output.scale };
            let verdict = match (output.holds(), output.is_tolerated()) {
                (true, _) => "holds".to_owned(),
                (false, true) => "E not shown; within the tolerance".to_owned(),
                (false, false) => format!("not shown (own bound {:.3e})", of(output.bound())),
            };
            writeln!(
                f,
                "  {:<6} {:>11.4e} {:>9.3e} {:>9.3e} {:>9.3e} {:>9.3e} {:>9.3e}  {verdict}",
                index + 1,
                output.scale,
                of(output.edits),
                of(output.rounding),
                of(output.bound()),
                of(output.claimed),
                of(output.seen),
            )?;
        }
        Ok(())
    }
}
