//! The functions that can be generated: names, arguments, results.

use std::fmt;

/// A generated function.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Function {
    /// τ(q, q̇, q̈): torques and forces, viscous damping included.
    InverseDynamics,
    /// c(q): the gravity load.
    Gravity,
    /// D(q): the inertia matrix.
    Inertia,
    /// h(q, q̇): the Coriolis and centripetal load.
    Coriolis,
    /// D, h and c in one function that shares their work.
    ManipulatorEquation,
    /// D, every h_ikm and c in one function.
    DynamicCoefficients,
}

/// An argument of a generated function; each is an array over the joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Argument {
    /// q
    Position,
    /// q̇
    Velocity,
    /// q̈
    Acceleration,
}

/// A quantity that a function returns: an array of rank 1 to 3 over joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Quantity {
    /// τ_i
    Torque,
    /// D_ik
    Inertia,
    /// h_i
    Coriolis,
    /// h_ikm
    Christoffel,
    /// c_i
    Gravity,
}

impl Function {
    /// Every function, in the order of generated files.
    pub const ALL: [Function; 6] = [
        Function::InverseDynamics,
        Function::Gravity,
        Function::Inertia,
        Function::Coriolis,
        Function::ManipulatorEquation,
        Function::DynamicCoefficients,
    ];

    /// Its name in generated code, on the command line and in the macro.
    pub fn name(self) -> &'static str {
        match self {
            Function::InverseDynamics => "inverse_dynamics",
            Function::Gravity => "gravity",
            Function::Inertia => "inertia",
            Function::Coriolis => "coriolis",
            Function::ManipulatorEquation => "manipulator_equation",
            Function::DynamicCoefficients => "dynamic_coefficients",
        }
    }

    /// The function of a name.
    pub fn from_name(name: &str) -> Option<Function> {
        Function::ALL.into_iter().find(|f| f.name() == name)
    }

    /// One line for its documentation.
    pub fn summary(self) -> &'static str {
        match self {
            Function::InverseDynamics => {
                "Inverse dynamics: the joint torques (forces) τ = D q̈ + h + c + b∘q̇."
            }
            Function::Gravity => "Gravity load c(q): the torques that hold the arm still.",
            Function::Inertia => "Inertia matrix D(q), symmetric; armature is on its diagonal.",
            Function::Coriolis => "Coriolis and centripetal load h(q, q̇), damping not included.",
            Function::ManipulatorEquation => "D(q), h(q, q̇) and c(q), with shared work.",
            Function::DynamicCoefficients => {
                "D(q), every Christoffel symbol h_ikm(q) and c(q), with shared work."
            }
        }
    }

    /// What it reads.
    pub fn arguments(self) -> &'static [Argument] {
        use Argument::*;
        match self {
            Function::InverseDynamics => &[Position, Velocity, Acceleration],
            Function::Gravity | Function::Inertia | Function::DynamicCoefficients => &[Position],
            Function::Coriolis | Function::ManipulatorEquation => &[Position, Velocity],
        }
    }

    /// What it returns.
    pub fn quantities(self) -> &'static [Quantity] {
        use Quantity::*;
        match self {
            Function::InverseDynamics => &[Torque],
            Function::Gravity => &[Gravity],
            Function::Inertia => &[Inertia],
            Function::Coriolis => &[Coriolis],
            Function::ManipulatorEquation => &[Inertia, Coriolis, Gravity],
            Function::DynamicCoefficients => &[Inertia, Christoffel, Gravity],
        }
    }

    /// The struct it returns, if it returns several quantities.
    pub fn structure(self) -> Option<&'static str> {
        match self {
            Function::ManipulatorEquation => Some("ManipulatorEquation"),
            Function::DynamicCoefficients => Some("DynamicCoefficients"),
            _ => None,
        }
    }

    /// How many numbers it returns for n joints.
    pub fn outputs(self, n: usize) -> usize {
        self.quantities().iter().map(|q| q.len(n)).sum()
    }
}

impl fmt::Display for Function {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl Argument {
    /// Its name in generated code.
    pub fn name(self) -> &'static str {
        match self {
            Argument::Position => "q",
            Argument::Velocity => "qd",
            Argument::Acceleration => "qdd",
        }
    }
}

impl Quantity {
    /// Array rank: 1 for a vector over the joints.
    pub fn rank(self) -> u32 {
        match self {
            Quantity::Torque | Quantity::Coriolis | Quantity::Gravity => 1,
            Quantity::Inertia => 2,
            Quantity::Christoffel => 3,
        }
    }

    /// How many numbers it has for n joints.
    pub fn len(self, n: usize) -> usize {
        n.pow(self.rank())
    }

    /// The zero-based indices of an entry for n joints, the last one first.
    pub fn indices(self, index: usize, n: usize) -> impl Iterator<Item = usize> {
        (0..self.rank()).map(move |place| index / n.pow(place) % n)
    }

    /// Its field in the structs that generated functions return.
    pub fn field(self) -> &'static str {
        match self {
            Quantity::Torque => "tau",
            Quantity::Inertia => "d",
            Quantity::Coriolis | Quantity::Christoffel => "h",
            Quantity::Gravity => "c",
        }
    }

    /// Its letter in the equations; `h_ikm` for the symbols that make up h.
    pub fn symbol(self) -> &'static str {
        match self {
            Quantity::Christoffel => "h_ikm",
            other => other.letter(),
        }
    }

    fn letter(self) -> &'static str {
        match self {
            Quantity::Torque => "τ",
            Quantity::Inertia => "D",
            Quantity::Coriolis | Quantity::Christoffel => "h",
            Quantity::Gravity => "c",
        }
    }

    /// The name of one entry, one-based: `D_12`, `h_123`, with separators
    /// where a robot has more than nine joints.
    pub fn entry(self, index: usize, n: usize) -> String {
        let rows: Vec<usize> = (0..n).collect();
        self.entry_over(index, &rows, n)
    }

    /// The name of one entry of a quantity that is over these joints of n.
    pub fn entry_over(self, index: usize, rows: &[usize], n: usize) -> String {
        let letter = self.letter();
        let width = rows.len().max(1);
        let joint = |at: usize| rows.get(at).map_or(0, |joint| joint + 1);
        let digits = self.indices(index, width).map(|at| joint(at).to_string());
        let mut digits: Vec<String> = digits.collect();
        digits.reverse();
        format!("{letter}_{}", digits.join(if n > 9 { "," } else { "" }))
    }
}
