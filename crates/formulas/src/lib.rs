//! The closed forms of a robot's dynamics, to read: D_ik, h_ikm, c_i, energies, the hand's pose and
//! Jacobian as text, Markdown, LaTeX and SymPy.
//!
//! The equations are those of [`dalembert_model::equations`], over a ring of polynomials:
//!
//! - `number`: coefficients; `ring`: polynomials; `symbol`: names of quantities
//! - `arm`: a robot over the ring; `naming`: symbols for its numbers; `bodies`: base parameters as symbols; `entries`: its coefficients
//! - `canonical`: few products of sines and cosines for a polynomial
//! - `rows`: large entries by rows of the axes; `expression`, `names`, `line`, `legend`: sums as they are printed, and what their symbols mean
//! - `formulas`: all of it together; `write`: the parts of a formula in each format; `document`: the whole
//!
//! ```
//! use dalembert_formulas::{Digits, Formulas, Layout, Quantity, Request, Style};
//!
//! let rod = r#"
//! name = "pendulum"
//! convention = "standard"
//! gravity = [0, -9.81, 0]
//! joint = [{ kind = "revolute", a = 0.5, mass = 2, com = [-0.25, 0, 0], inertia = [0, 0.04, 0.04, 0, 0, 0] }]
//! "#;
//! let robot = dalembert_model::read::parse(rod).unwrap().robot;
//! let request = Request {
//!     quantities: vec![Quantity::Inertia, Quantity::Gravity],
//!     style: Style::Names,
//! };
//! let text = Formulas::new(&robot, None, &request)?.write(Layout::Text, Digits::Six);
//! assert!(text.contains("D_11 = a1²·m1 + 2·a1·x̄1·m1 + x̄1²·m1 + I1zz\n"));
//! assert!(text.contains("c_1 = g·a1·m1·C1 + g·x̄1·m1·C1\n"));
//! # Ok::<(), dalembert_codegen::Diagnostic>(())
//! ```
#![forbid(unsafe_code)]
#![warn(missing_docs, clippy::missing_errors_doc)]

mod arm;
mod bodies;
mod canonical;
pub mod couplings;
mod document;
mod entries;
mod error;
mod expression;
mod formulas;
mod legend;
mod line;
mod names;
mod naming;
mod number;
mod quantity;
mod ring;
mod rows;
mod symbol;
mod write;

pub use arm::{Offset, Variable};
pub use document::{Layout, escaped, written};
pub use expression::{Factor, Sum, Term, Trig, products};
pub use formulas::{Formulas, Request, Style};
pub use legend::{Frames, Group, Legend, SymbolEntry};
pub use line::{Line, List, Section};
pub use number::{Number, rounded as significant};
pub use quantity::Quantity;
pub use symbol::Symbol;
pub use write::Digits;
