//! Base parameters as symbols: the moments of each link that torques feel.
//!
//! What no joint feels of a link moves to the link that carries it, from the tips inward (Gautier and
//! Khalil 1990): of a link that turns its mass, its first moment along the axis and YY, of one that
//! slides its second moments. Seven numbers of a link stay, or four:
//! MX, MY, XX (which is XX − YY), ZZ, XY, XZ, YZ; M, MX, MY, MZ. They are taken about a point of the
//! joint's axis, in axes that turn with the link, z along the joint's axis.

use dalembert_model::equations::chain::{Body, Chain};
use dalembert_model::robot::{Inertia, JointKind};
use dalembert_model::scalar::Scalar;

use crate::arm::{SymbolicArm, SymbolicChain};
use crate::number::Number;
use crate::ring::{Polynomial, Symbols};
use crate::symbol::{Definition, Symbol};

/// A chain whose bodies are symbols.
pub struct BaseBodies {
    /// The chain; what is zero in this robot is not a symbol.
    pub chain: Chain<Polynomial>,
    /// The symbols, each with its value as a polynomial in the file's numbers.
    pub parameters: Vec<Definition<Polynomial>>,
    /// Their values.
    pub values: Vec<Number>,
}

impl BaseBodies {
    /// Makes the symbols of a chain; `mark` stands behind the letters of each.
    pub fn new(arm: &SymbolicArm, chain: &SymbolicChain, mark: &str) -> BaseBodies {
        let mut bodies = BaseBodies {
            chain: chain.whole.clone(),
            parameters: Vec::new(),
            values: Vec::new(),
        };
        let mut carried: Vec<Body<Polynomial>> = vec![Body::zero(); chain.rows.len()];
        let mut kept: Vec<Body<Polynomial>> = vec![Body::zero(); chain.rows.len()];
        for i in (0..chain.rows.len()).rev() {
            let link = &chain.whole.links[i];
            let body = link.body.with(&carried[i]);
            let yy = match link.kind {
                JointKind::Revolute => body.second.xx.clone(),
                JointKind::Prismatic => Polynomial::zero(),
            };
            let mut shifted = body;
            shifted.second.zz = shifted.second.zz.add(&yy);
            let (mut stays, moves) = link.split_base(&shifted);
            stays.second.zz = stays.second.zz.sub(&yy);
            kept[i] = stays;
            if let Some(parent) = link.parent {
                carried[parent] = carried[parent].with(&moves);
            }
        }
        for (i, body) in kept.into_iter().enumerate() {
            let number = chain.rows[i] + 1;
            let tensor = body.tensor();
            let turns = chain.whole.links[i].kind == JointKind::Revolute;
            let all = [
                ("M", body.mass),
                ("MX", body.first[0].clone()),
                ("MY", body.first[1].clone()),
                ("MZ", body.first[2].clone()),
                ("XX", tensor.xx),
                ("ZZ", tensor.zz),
                ("XY", tensor.xy),
                ("XZ", tensor.xz),
                ("YZ", tensor.yz),
            ];
            let [m, x, y, z, xx, zz, xy, xz, yz] = all.map(|(letters, value)| {
                let symbol = Symbol::marked(letters, mark, number);
                bodies.symbol(arm, symbol, value, chain.rows[i])
            });
            let link = &mut bodies.chain.links[i];
            link.body = Body {
                mass: m,
                first: [x, y, z],
                second: match turns {
                    true => Inertia {
                        xx: zz.sub(&xx).half(),
                        yy: zz.add(&xx).half(),
                        zz: xx.sub(&zz).half(),
                        xy: xy.neg(),
                        yz: yz.neg(),
                        xz: xz.neg(),
                    },
                    false => Inertia::symmetric(|_, _| Polynomial::zero()),
                },
            };
            let (armature, row) = (chain.whole.links[i].armature.clone(), chain.rows[i]);
            let symbol = Symbol::inertia(number, "a");
            bodies.chain.links[i].armature = bodies.symbol(arm, symbol, armature, row);
        }
        bodies
    }

    fn symbol(
        &mut self,
        arm: &SymbolicArm,
        symbol: Symbol,
        value: Polynomial,
        row: usize,
    ) -> Polynomial {
        let number = arm.evaluate(&value);
        if number.is_zero() {
            return Polynomial::zero();
        }
        let place = Symbols::parameter(self.parameters.len());
        let Some(symbols) = place else {
            return Polynomial::constant(number);
        };
        let row = Some(row);
        self.parameters.push(Definition { symbol, value, row });
        self.values.push(number);
        Polynomial::symbol(symbols)
    }
}
