//! The first difference between two pieces of code.

use dalembert_model::diagnostic::Diagnostic;

use super::{Code, Steps};

impl Code {
    /// Returns the first difference from other code, but for the order of constants and inputs.
    pub fn difference(&self, other: &Code) -> Option<Diagnostic> {
        let (a, b) = (self, other);
        let counts = [a, b].map(|code| code.dag.operations().count());
        let results = [a, b].map(|code| code.dag.outputs.len());
        let parts = [
            (a.scalar == b.scalar, "the scalars differ"),
            (a.library == b.library, "the libraries of sines differ"),
            (a.pairs == b.pairs, "the sines and cosines differ"),
            (a.speeds == b.speeds, "what is read of speeds differs"),
            (counts[0] == counts[1], "the number of operations differs"),
            (results[0] == results[1], "the number of results differs"),
        ];
        let different = parts.into_iter().find(|(is_equal, _)| !is_equal);
        let part = different.map(|(_, what)| what.to_owned());
        let what = part.or_else(|| self.first_difference(other));
        what.map(Diagnostic::error)
    }

    /// Compares operations and results one by one: equal operations read equal ones before them.
    fn first_difference(&self, other: &Code) -> Option<String> {
        let [ours, theirs] = [&self.dag, &other.dag]
            .map(|dag| Steps::new(dag, |constant| *constant, |input| *input));
        let mut steps = ours.steps.iter().zip(&theirs.steps);
        let operation = steps.position(|(a, b)| a != b);
        let mut outputs = ours.outputs.iter().zip(&theirs.outputs);
        let result = outputs.position(|(a, b)| a != b);
        let operation = operation.map(|index| format!("operation t{} differs", index + 1));
        operation.or(result.map(|index| format!("result {index} differs")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dag::{Dag, Edge, Input, Node, Operation};
    use crate::function::Argument;
    use crate::program::{Library, Literal, ScalarType};

    /// −((q̇₁ − 0) − q̈₂).
    fn code() -> Code {
        let input = |argument, joint| Node::Input(Input::Entry(argument, joint));
        let nodes = vec![
            input(Argument::Velocity, 0),
            Node::Constant(Literal(0.0)),
            Node::Apply(Operation::Sub, [0, 1]),
            input(Argument::Acceleration, 1),
            Node::Apply(Operation::Sub, [2, 3]),
        ];
        let outputs = vec![Edge::from(4).negated_if(true)];
        Code {
            scalar: ScalarType::F64,
            library: Library::Libm,
            pairs: Vec::new(),
            speeds: Vec::new(),
            dag: Dag { nodes, outputs },
            loops: Vec::new(),
        }
    }

    #[test]
    fn other_code_differs() {
        type Change = (fn(&mut Code), &'static str);
        let changes: [Change; 8] = [
            (|c| c.scalar = ScalarType::F32, "the scalars differ"),
            (
                |c| c.library = Library::Together,
                "the libraries of sines differ",
            ),
            (
                |c| c.dag.nodes[1] = Node::Constant(Literal(-0.0)),
                "operation t1 differs",
            ),
            (
                |c| c.dag.nodes[4] = Node::Apply(Operation::Add, [2, 3]),
                "operation t2 differs",
            ),
            (
                |c| c.dag.nodes[4] = Node::Apply(Operation::Sub, [3, 2]),
                "operation t2 differs",
            ),
            (
                |c| c.dag.nodes.push(Node::Apply(Operation::Mul, [4, 4])),
                "the number of operations differs",
            ),
            (|c| c.dag.outputs[0].negative = false, "result 0 differs"),
            (|c| c.dag.outputs.clear(), "the number of results differs"),
        ];
        for (change, words) in changes {
            let mut other = code();
            change(&mut other);
            let difference = code().difference(&other).unwrap();
            assert_eq!(difference.to_string(), words);
        }
        let mut other = code();
        other.dag.nodes.swap(0, 1);
        other.dag.nodes[2] = Node::Apply(Operation::Sub, [1, 0]);
        assert!(other != code());
        assert_eq!(code().difference(&other), None);
    }
}
