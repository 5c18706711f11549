//! What the text of a generated function shows, in Rust and in C.

use std::collections::BTreeSet;

/// What begins a branch or a loop in one of the languages.
const BRANCHES: [&str; 10] = [
    "if", "else", "match", "switch", "while", "for", "loop", "do", "goto", "break",
];

/// What is in the lines of a function.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Body {
    /// Products, sums and differences, quotients, and products fused with a sum.
    pub operations: [usize; 4],
    /// The functions that it calls.
    pub calls: BTreeSet<String>,
    /// `true` if it has no branch and no loop.
    pub is_straight: bool,
}

impl Body {
    /// Reads the text of a function, of which the head is the first line that opens a bracket.
    pub fn of(text: &str) -> Body {
        let mut lines = text.lines().map(str::trim);
        let is_head = |line: &str| line.contains("fn ") || line.starts_with("static ");
        lines.find(|line| is_head(line));
        let mut body = Body {
            is_straight: true,
            ..Body::default()
        };
        for line in lines {
            let of = |symbol| line.matches(symbol).count();
            let calls = calls(line);
            let fused = calls.iter().filter(|call| is_fused(call)).count();
            let counts = [of(" * "), of(" + ") + of(" - "), of(" / "), fused];
            for (sum, count) in body.operations.iter_mut().zip(counts) {
                *sum += count;
            }
            let mut words = line.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
            body.is_straight &= !words.any(|word| BRANCHES.contains(&word));
            body.is_straight &= !line.contains(['?', '|']);
            let others = calls.into_iter().filter(|call| !is_fused(call));
            body.calls.extend(others.map(str::to_owned));
        }
        body
    }
}

fn is_fused(call: &str) -> bool {
    ["mul_add", "fma", "fmaf"].contains(&call)
}

/// Returns the paths behind which a bracket opens.
fn calls(line: &str) -> Vec<&str> {
    let is_part = |c: char| c.is_ascii_alphanumeric() || "_:".contains(c);
    let before = line.match_indices('(').map(|(place, _)| &line[..place]);
    let words = before.map(|text| text.rsplit(|c: char| !is_part(c)).next().unwrap_or(""));
    words.filter(|word| !word.is_empty()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn operations_calls_and_branches() {
        let rust = Body::of(
            "pub fn gravity(q: &[f64; 1]) -> [f64; 1] {\n    let (s1, c1) = libm::sincos(q[0]);\n    \
             let t1 = c1 * -2.0;\n    let t2 = s1.mul_add(t1, -c1);\n    [t2]\n}\n",
        );
        assert_eq!(rust.operations, [1, 0, 0, 1]);
        assert_eq!(rust.calls, BTreeSet::from(["libm::sincos".to_owned()]));
        assert!(rust.is_straight);
        let c = Body::of(
            "typedef struct {\ndouble c[1];\n} arm_b_t;\nstatic inline void arm_b(const double q[A 1])\n{\n\
             const double t1 = 1.0 / sqrt(q[0] * q[0] + 2.0);\nif (t1) {\n}\n}\n",
        );
        assert_eq!(c.operations, [1, 1, 1, 0]);
        assert_eq!(c.calls, BTreeSet::from(["sqrt".to_owned()]));
        assert!(!c.is_straight);
    }
}
