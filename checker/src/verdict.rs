//! The audit of one claim, and what it found.

use crate::certificate::Claim;
use crate::fault::Fault;
use crate::maximum;
use crate::number::{Number, Work};
use crate::quantity::Quantity;
use crate::ring::Ring;
use crate::sample::{self, Seen};
use crate::scene::{self, Setting};
use crate::text;
use crate::values;
use crate::witness;

/// At how many states the text is run.
const STATES: usize = 1000;
/// By how much a box may be smaller than the file's: decimals were rounded to doubles.
pub(crate) const BOX_SLACK: f64 = 1e-9;
/// By how much T may be above the largest value that was found. What is tolerated is
/// relative to what was found.
const SCALE_SLACK: f64 = 1e-4;
/// What an output that is always zero may be off, relative to the largest T: the checker's
/// own numbers are doubles.
const ZERO: f64 = 1e-12;

/// The findings about one output, in its own unit.
#[derive(Clone, Debug)]
pub struct Output {
    /// Its joints, from zero: of an entry of D its row and its column.
    pub joints: Vec<usize>,
    /// T
    pub scale: f64,
    /// What was found.
    pub found: Found,
    /// The claim, E·T.
    pub claimed: f64,
    /// The user's tolerance times T, if the scene has one.
    pub tolerated: Option<f64>,
}

impl Output {
    /// Returns whether E is shown, but for one part in 10⁹ of it.
    pub fn holds(&self) -> bool {
        self.found.bound() <= self.claimed * (1.0 + 1e-9)
    }

    /// Returns whether the user's tolerance is shown; of a scene without one, whether E is. What
    /// errs more than E at a state is not.
    pub fn is_shown(&self) -> bool {
        let is_none = self.claimed == 0.0 && !self.holds();
        let is_within = |tolerated| self.found.bound() <= tolerated;
        let is_bounded = self.tolerated.map_or(self.holds(), is_within);
        !is_none && is_bounded && self.found.seen.off <= self.claimed
    }
}

/// The findings about a claim.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// The name of the function.
    pub name: String,
    /// `f64` or `f32`
    pub scalar: String,
    /// One an output.
    pub outputs: Vec<Output>,
}

impl Verdict {
    /// Returns whether every output is shown to be within the user's tolerance, and of a scene
    /// that has none within its E.
    pub fn is_shown(&self) -> bool {
        self.outputs.iter().all(Output::is_shown)
    }
}

/// Audits one claim about a robot of which the file is given. Nothing but the claim's
/// text, box, T and E is taken from it.
/// `tolerance` is another than the scene's, if there is one.
///
/// # Errors
/// A file or text that this checker does not know, a claim that is not about this robot
/// or is contradicted, or more work than it does.
pub fn audit(claim: &Claim, robot: &str, tolerance: Option<f64>) -> Result<Verdict, Fault> {
    let mut setting = scene::read(robot, claim.scene.as_deref())?;
    if let Some(tolerance) = tolerance {
        setting.tolerance = Some(vec![tolerance; setting.joints.len()]);
        setting.relative_to.clone_from(&claim.relative_to);
    }
    let is_open = claim.scene.is_none() && tolerance.is_none() && setting.has_tolerances;
    let why =
        "it names no scene, and the robot file has scenes with tolerances: name one (--scene)";
    Fault::unless(!is_open, why)?;
    claim.whole()?;
    let why = format!("`{}` is only tried, in a whole file", claim.function);
    Fault::unless(!claim.function()?.is_tried(), &why)?;
    about(claim, &setting)?;
    let claimed = |index: usize| claim.total[index].unwrap_or(f64::NAN) * claim.scale[index];
    let searched = &mut Work::default();
    let found = measure(claim, &setting, claimed, searched)?;
    let places = claim.function()?.places(claim.rows.len());
    let most = attainable(claim, &setting, &places, searched)?;
    let largest = claim.scale.iter().copied().fold(0.0, f64::max);
    let rows = claim.rows();
    let mut outputs = Vec::new();
    for (index, (found, (_, place))) in found.into_iter().zip(&places).enumerate() {
        let joints: Vec<usize> = place.iter().map(|&place| rows[place]).collect();
        let scale = claim.scale[index];
        let is_zero = scale == 0.0 && most[index] == 0.0;
        // What is of no joint, such as an energy, is held to the strictest tolerance.
        let held = if joints.is_empty() { &rows } else { &joints };
        let tolerated = setting.tolerance.as_ref().filter(|_| !is_zero).map(|all| {
            let each = held.iter().map(|&joint| all[joint]);
            below(each.fold(f64::INFINITY, f64::min) * scale.min(most[index]))
        });
        let own = below(claimed(index));
        let own = if is_zero { ZERO * largest } else { own };
        outputs.push(Output {
            joints,
            scale,
            found,
            claimed: own,
            tolerated,
        });
    }
    Ok(Verdict {
        name: claim.function.clone(),
        scalar: claim.scalar.clone(),
        outputs,
    })
}

/// The findings about one output, in its own unit.
#[derive(Clone, Copy, Debug)]
pub struct Found {
    /// Bound of what the text differs from the function in real numbers.
    pub edits: f64,
    /// Bound of what rounding and library sines cost.
    pub rounding: f64,
    /// The largest error seen at states.
    pub seen: Seen,
}

impl Found {
    /// Returns the bound of both.
    pub fn bound(&self) -> f64 {
        let sum = self.edits + self.rounding;
        if sum == 0.0 { 0.0 } else { sum.next_up() }
    }
}

/// Bounds how far a text is from the function over the box of a claim, one an output; no
/// smaller bound is looked for than what is wanted of an output.
///
/// # Errors
/// A text that is not of the grammar or is contradicted by a state, or too much work.
pub fn measure(
    claim: &Claim,
    setting: &Setting,
    wanted: impl Fn(usize) -> f64,
    searched: &mut Work,
) -> Result<Vec<Found>, Fault> {
    let program = text::read(claim, setting)?;
    let work = &mut Work::default();
    let ring = Ring::new(setting, claim, work)?;
    let texts = values::outputs(&program, setting, claim, &ring, work)?;
    let (function, rows) = (claim.function()?, claim.rows());
    let formulas = function.outputs(setting, &ring.states, &rows, work)?;
    let seen = sample::worst(claim, setting, &program, STATES)?;
    let mut all = Vec::new();
    for (index, (value, formula)) in texts.iter().zip(&formulas).enumerate() {
        let difference = value.exact.plus(&formula.negated());
        let claimed = wanted(index);
        let most = (claimed - value.error).next_down().next_down();
        let mut found = Found {
            edits: maximum::bound(&difference, &ring, most),
            rounding: value.error,
            seen: seen[index],
        };
        if found.bound() > claimed && found.seen.off <= claimed {
            let off = witness::error(claim, setting, &program, (index, claimed), searched)?;
            found.seen.off = found.seen.off.max(off);
        }
        if !(found.seen.off <= found.bound()) {
            let (place, off) = (index + 1, found.seen.off);
            let why = format!("output {place} is off by {off:.3e} at a state");
            let why = format!("{why}, more than the checker's own bound");
            return Err(Fault::certificate(why));
        }
        all.push(found);
    }
    Ok(all)
}

/// Returns whether a claim is about this robot in its scene: the same rows, a box that has all
/// states of the file's, a scale of the same kind.
fn about(claim: &Claim, setting: &Setting) -> Result<(), Fault> {
    let has_rows = setting.rows == claim.rows();
    Fault::unless(has_rows, "`rows` are not those of the scene")?;
    let is_relative = setting.tolerance.is_none() || claim.relative_to == setting.relative_to;
    Fault::unless(is_relative, "`relative_to` is not that of the scene")?;
    let arguments = claim.function()?.arguments();
    let inside = |(own, claimed): (&[f64; 2], &[f64; 2])| {
        let slack = BOX_SLACK * (own[0].abs() + own[1].abs());
        // What the file does not limit is NaN, and in nothing.
        claimed[0] - slack <= own[0] && own[1] <= claimed[1] + slack
    };
    let lists = [&claim.position, &claim.velocity, &claim.acceleration];
    let mut lists = setting.ranges.iter().zip(lists).take(arguments);
    let has_all = |(own, claimed): (&Vec<[f64; 2]>, &Vec<[f64; 2]>)| {
        own.len() == claimed.len() && own.iter().zip(claimed.iter()).all(inside)
    };
    let why = "the box lacks states of the scene, or of the joints' limits";
    Fault::unless(lists.all(has_all), why)
}

/// Returns a number that a rounded one is not below; zero is exact.
fn below(value: f64) -> f64 {
    if value > 0.0 {
        value.next_down()
    } else {
        value
    }
}

/// Returns what T may be at most, one an output: the actuators' limits, or what the output
/// reaches at a state of the box. Refuses a T that is above it: E would look smaller than
/// it is.
fn attainable(
    claim: &Claim,
    setting: &Setting,
    places: &[(Quantity, Vec<usize>)],
    work: &mut Work,
) -> Result<Vec<f64>, Fault> {
    let row = |place: usize| claim.rows[place] - 1;
    let rate = |which: usize, place: usize| setting.ranges[which][row(place)][1];
    let torque = |place: usize| setting.torques[row(place)];
    let actuator = |(quantity, place): &(Quantity, Vec<usize>)| match (quantity, place.as_slice()) {
        (Quantity::Inertia, &[i, k]) => Ok((torque(i) / rate(2, k)).min(torque(k) / rate(2, i))),
        (Quantity::Christoffel, &[i, k, m]) => Ok(torque(i) / (rate(1, k) * rate(1, m))),
        (Quantity::Torque | Quantity::Gravity | Quantity::Coriolis, &[i]) => Ok(torque(i)),
        _ => Err(Fault::certificate(
            "`relative_to`: the actuators' limits are no measure of this function",
        )),
    };
    let most: Vec<f64> = match claim.relative_to.as_deref() {
        Some("actuator") => places.iter().map(actuator).collect::<Result<_, Fault>>()?,
        Some("range") => witness::reached(claim, setting, work)?,
        _ => {
            return Err(Fault::certificate(
                "`relative_to` is neither actuator nor range",
            ));
        }
    };
    for (scale, most) in claim.scale.iter().zip(&most) {
        let is_reached = *scale >= 0.0 && *scale <= most * (1.0 + SCALE_SLACK);
        let why = format!("`scale` {scale:e} is above {most:e}, the largest that is reached");
        Fault::unless(is_reached || *scale == 0.0, &why)?;
    }
    Ok(most)
}
