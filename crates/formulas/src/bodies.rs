//! Base parameters as symbols: the moments of each link that torques feel.
//!
//! Moments of a link that no joint feels move to its carrier, from the tips inward (Gautier and
//! Khalil 1990): of a link that turns its mass, its first moment along the axis and YY, of one that
//! slides its second moments. Seven numbers of a link stay, or four:
//! MX, MY, XX (which is XX − YY), ZZ, XY, XZ, YZ; M, MX, MY, MZ. They are taken about a point of the
//! joint's axis, in axes that turn with the link, z along the joint's axis.

use dalembert_model::equations::chain::{Chain, MomentBody};
use dalembert_model::robot::{Inertia, JointKind};
use dalembert_model::scalar::Scalar;

use crate::arm::{PosedChain, SymbolicArm};
use crate::number::Number;
use crate::ring::{Polynomial, Symbols};
use crate::symbol::{Definition, Symbol};

/// The moments of a link that can be base parameters.
pub const MOMENTS: [&str; 9] = ["M", "MX", "MY", "MZ", "XX", "ZZ", "XY", "XZ", "YZ"];

/// The link and the moment of each base parameter, as places in the chain and in [`MOMENTS`].
pub type BaseMoments = Vec<(usize, usize)>;

/// A chain whose bodies are symbols.
pub struct BaseBodies {
    pub chain: Chain<Polynomial>,
    /// The symbols, each with its value as a polynomial in the file's numbers.
    pub parameters: Vec<Definition<Polynomial>>,
    pub values: Vec<Number>,
    /// The moments that they are; none of an armature.
    pub moments: BaseMoments,
}

/// Returns the body that has these of [`MOMENTS`], YY zero.
pub fn body_of<S: Scalar>(kind: JointKind, moments: [S; MOMENTS.len()]) -> MomentBody<S> {
    let [m, x, y, z, xx, zz, xy, xz, yz] = moments;
    MomentBody {
        mass: m,
        first: [x, y, z],
        second: match kind {
            JointKind::Revolute => Inertia {
                xx: zz.sub(&xx).half(),
                yy: zz.add(&xx).half(),
                zz: xx.sub(&zz).half(),
                xy: xy.neg(),
                yz: yz.neg(),
                xz: xz.neg(),
            },
            JointKind::Prismatic => Inertia::symmetric(|_, _| S::zero()),
        },
    }
}

/// Returns the moments of a body in the order of [`MOMENTS`].
pub fn moments_of<S: Scalar>(body: &MomentBody<S>) -> [S; MOMENTS.len()] {
    let Inertia {
        xx, zz, xy, xz, yz, ..
    } = body.tensor();
    let (m, [x, y, z]) = (body.mass.clone(), body.first.clone());
    [m, x, y, z, xx, zz, xy, xz, yz]
}

fn is_kept(kind: JointKind, moment: usize) -> bool {
    let name = MOMENTS[moment];
    match kind {
        JointKind::Revolute => name != "M" && name != "MZ",
        JointKind::Prismatic => name.starts_with('M'),
    }
}

impl BaseBodies {
    /// Makes symbols of the base parameters that are not zero; `mark` stands behind the letters of each.
    pub fn new(arm: &SymbolicArm, posed: &PosedChain<Polynomial>, mark: &str) -> BaseBodies {
        BaseBodies::with(arm, posed, mark, |value, _| !value.is_zero())
    }

    /// Makes symbols of all base parameters that an arm with these joints has, but for armatures.
    pub fn whole(arm: &SymbolicArm, posed: &PosedChain<Polynomial>) -> BaseBodies {
        BaseBodies::with(arm, posed, "", |_, is_moment| is_moment)
    }

    fn with(
        arm: &SymbolicArm,
        posed: &PosedChain<Polynomial>,
        mark: &str,
        is_symbol: impl Fn(&Number, bool) -> bool,
    ) -> BaseBodies {
        let mut bodies = BaseBodies {
            chain: posed.whole.clone(),
            parameters: Vec::new(),
            values: Vec::new(),
            moments: Vec::new(),
        };
        for (link, body) in kept_bodies(&posed.whole).iter().enumerate() {
            let (kind, row) = (posed.whole.links[link].kind, posed.rows[link]);
            let mut moment = 0;
            let moments = moments_of(body).map(|value| {
                let place = moment;
                moment += 1;
                let number = arm.evaluate(&value);
                if !is_kept(kind, place) || !is_symbol(&number, true) {
                    return Polynomial::constant(number);
                }
                bodies.moments.push((link, place));
                let symbol = Symbol::marked(MOMENTS[place], mark, row + 1);
                bodies.symbol(symbol, value, number, row)
            });
            bodies.chain.links[link].body = body_of(kind, moments);
            let armature = posed.whole.links[link].armature.clone();
            let number = arm.evaluate(&armature);
            bodies.chain.links[link].armature = match is_symbol(&number, false) {
                true => bodies.symbol(Symbol::inertia(row + 1, "a"), armature, number, row),
                false => Polynomial::constant(number),
            };
        }
        bodies
    }

    fn symbol(
        &mut self,
        symbol: Symbol,
        value: Polynomial,
        number: Number,
        row: usize,
    ) -> Polynomial {
        let Some(symbols) = Symbols::parameter(self.parameters.len()) else {
            return Polynomial::constant(number);
        };
        let row = Some(row);
        self.parameters.push(Definition { symbol, value, row });
        self.values.push(number);
        Polynomial::symbol(symbols)
    }
}

/// Moves inward all that can: returns the bodies that links keep.
fn kept_bodies(chain: &Chain<Polynomial>) -> Vec<MomentBody<Polynomial>> {
    let n = chain.links.len();
    let mut arriving: Vec<MomentBody<Polynomial>> = vec![MomentBody::zero(); n];
    let mut kept: Vec<MomentBody<Polynomial>> = vec![MomentBody::zero(); n];
    for i in (0..n).rev() {
        let link = &chain.links[i];
        let mut body = link.body.with(&arriving[i]);
        // The model moves ∫ z² dm; with ∫ x² dm more of it, YY moves.
        let more = match link.kind {
            JointKind::Revolute => body.second.xx.clone(),
            JointKind::Prismatic => Polynomial::zero(),
        };
        body.second.zz = body.second.zz.add(&more);
        let (mut stays, moves) = link.split_base(&body);
        stays.second.zz = stays.second.zz.sub(&more);
        kept[i] = stays;
        if let Some(parent) = link.parent {
            arriving[parent] = arriving[parent].with(&moves);
        }
    }
    kept
}
