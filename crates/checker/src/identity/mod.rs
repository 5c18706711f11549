//! The identity: an exact program returns what the equations of motion give, at points of prime
//! fields that a hash draws from text, program and robot.
//!
//! A difference is N/M with polynomials N and M in the inputs. N does not vanish at a random point
//! of a field of more than 2¹²⁵ residues but with probability at most its degree over 2¹²⁵, unless
//! the prime divides all its coefficients, and few primes divide a number. Each point has a prime
//! of its own, of the form 24 k − 1, where √2 and √3 are residues: multiples of 15° have all their
//! relations. Constants count in the degree d, which is at most 2⁸⁰: so coefficients have at most
//! d·2¹⁸ bits, their norms d·2²⁰, and of the 2¹¹⁵ such primes of 126 bits at most d·2¹⁴ divide all
//! of them. A wrong program passes one point with a probability of at most d·2⁻¹⁰⁰, and there are so
//! many that it passes all with at most 2⁻¹⁴⁰: two for a degree of 2³⁰, four for 2⁵⁶, seven for 2⁸⁰.
//!
//! - `check`: the comparison, [`check`]; `residues`: the values of a program, and its degree
//! - [`number`]: residues with slopes, and draws from a hash; [`exact`]: constants and angles
//! - [`robot`]: the robot file as text; [`setting`]: what a scene fixes and asks for
//! - [`aligned`]: rows that stand for placed joints; [`arm`]: axes and masses in base axes
//! - [`table`]: all functions; [`state`]: their arguments; [`outputs`]: every result by
//!   the equations of Newton and Euler, with `contact`, `screw` and `matrix`
//! - [`given`]: what a function that takes a `load` is given

pub mod aligned;
pub mod arm;
mod check;
mod contact;
pub mod exact;
pub mod given;
mod matrix;
pub mod number;
pub mod outputs;
pub(crate) mod residues;
pub mod robot;
mod screw;
pub mod setting;
pub mod state;
pub mod table;

pub use self::check::{Base, Combination, Points, Statement, check};
