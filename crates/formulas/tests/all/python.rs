//! Runs the Python text of formulas: assignments of sums, products, powers, sines and cosines.

use std::collections::HashMap;

/// A step of a calculation on a stack.
enum Step {
    Push(f64),
    Load(usize),
    Add,
    Multiply,
    Negate,
    Raise(i32),
    Call(fn(f64) -> f64),
}

/// A module, read once.
pub struct Module {
    places: HashMap<String, usize>,
    lines: Vec<(usize, Vec<Step>)>,
}

impl Module {
    /// Reads the text of a module; `D[3]` is the fourth entry of the list `D`, whatever its nesting.
    pub fn read(text: &str) -> Module {
        let mut module = Module {
            places: HashMap::new(),
            lines: Vec::new(),
        };
        module.place("pi");
        // Values first: what they are of is used before them.
        let (formulas, values) = text.split_once("values = {").unwrap_or((text, ""));
        for line in values.lines() {
            if let Some((name, right)) = line.trim().trim_end_matches(',').split_once(": ") {
                module.assign(name, right);
            }
        }
        for line in formulas.lines().filter(|line| !line.starts_with(' ')) {
            let is_code = !line.starts_with('#') && !line.starts_with("from");
            let Some((name, right)) = line.split_once(" = ").filter(|_| is_code) else {
                continue;
            };
            if right.starts_with("symbols(") {
                for name in name.trim_matches(['[', ']']).split(", ") {
                    module.place(name);
                }
            } else if right == "{" {
                continue;
            } else if right.starts_with('[') {
                let entries = right.split(|c: char| "[], ".contains(c));
                for (place, entry) in entries.filter(|entry| !entry.is_empty()).enumerate() {
                    let from = module.places[entry];
                    let to = module.place(&format!("{name}[{place}]"));
                    module.lines.push((to, vec![Step::Load(from)]));
                }
            } else {
                module.assign(name, right);
            }
        }
        module
    }

    fn assign(&mut self, name: &str, right: &str) {
        let mut steps = Vec::new();
        let mut reader = Reader {
            rest: right,
            places: &self.places,
            steps: &mut steps,
        };
        reader.sum();
        assert!(reader.rest.is_empty(), "{name} = {right}");
        let to = self.place(name);
        self.lines.push((to, steps));
    }

    fn place(&mut self, name: &str) -> usize {
        let next = self.places.len();
        *self.places.entry(name.to_owned()).or_insert(next)
    }

    /// Runs the module from these values of its symbols.
    pub fn run(&self, inputs: &HashMap<String, f64>) -> Values<'_> {
        let mut values = vec![f64::NAN; self.places.len()];
        values[self.places["pi"]] = std::f64::consts::PI;
        for (name, value) in inputs {
            if let Some(place) = self.places.get(name) {
                values[*place] = *value;
            }
        }
        let mut stack: Vec<f64> = Vec::new();
        for (to, steps) in &self.lines {
            for step in steps {
                let mut pop = || stack.pop().unwrap();
                let value = match step {
                    Step::Push(value) => *value,
                    Step::Load(place) => values[*place],
                    Step::Add => pop() + pop(),
                    Step::Multiply => pop() * pop(),
                    Step::Negate => -pop(),
                    Step::Raise(power) => f64::powi(pop(), *power),
                    Step::Call(function) => function(pop()),
                };
                stack.push(value);
            }
            values[*to] = stack.pop().unwrap();
        }
        Values {
            module: self,
            values,
        }
    }
}

/// The values of a module's names.
pub struct Values<'m> {
    module: &'m Module,
    values: Vec<f64>,
}

impl Values<'_> {
    pub fn of(&self, name: &str) -> f64 {
        self.values[self.module.places[name]]
    }
}

struct Reader<'t> {
    rest: &'t str,
    places: &'t HashMap<String, usize>,
    steps: &'t mut Vec<Step>,
}

impl Reader<'_> {
    fn takes(&mut self, sign: &str) -> bool {
        let rest = self.rest.trim_start().strip_prefix(sign);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }

    fn sum(&mut self) {
        let mut is_negative = self.takes("-");
        for first in [true].into_iter().chain(std::iter::repeat(false)) {
            self.product();
            if is_negative {
                self.steps.push(Step::Negate);
            }
            if !first {
                self.steps.push(Step::Add);
            }
            is_negative = self.takes("-");
            if !is_negative && !self.takes("+") {
                return;
            }
        }
    }

    fn product(&mut self) {
        self.power();
        while self.takes("*") {
            self.power();
            self.steps.push(Step::Multiply);
        }
    }

    fn power(&mut self) {
        self.atom();
        if self.takes("**") {
            let power = self.word().parse().unwrap();
            self.steps.push(Step::Raise(power));
        }
    }

    fn inside(&mut self) {
        self.sum();
        assert!(self.takes(")"), "{}", self.rest);
    }

    fn atom(&mut self) {
        if self.takes("(") {
            return self.inside();
        }
        let word = self.word();
        let function: fn(f64) -> f64 = match word.as_str() {
            "sin" => f64::sin,
            "cos" => f64::cos,
            "atan" => f64::atan,
            "R" => return self.rational(),
            _ => {
                let step = match word.parse() {
                    Ok(number) => Step::Push(number),
                    Err(_) => Step::Load(self.places[&word]),
                };
                return self.steps.push(step);
            }
        };
        assert!(self.takes("("), "{}", self.rest);
        self.inside();
        self.steps.push(Step::Call(function));
    }

    /// `R('0.25')`, `R('1/3')`, `R(1, 3)` or `R(0)`.
    fn rational(&mut self) {
        let (inside, rest) = self.rest[1..].split_once(')').unwrap();
        self.rest = rest;
        let parts = inside.trim_matches('\'').split([',', '/']);
        let mut numbers = parts.map(|x| x.trim().parse::<f64>().unwrap());
        let value = numbers.next().unwrap() / numbers.next().unwrap_or(1.0);
        self.steps.push(Step::Push(value));
    }

    fn word(&mut self) -> String {
        let rest = self.rest.trim_start();
        let is_exponent =
            |at: usize| rest[..at].ends_with('e') && rest.starts_with(|c: char| c.is_ascii_digit());
        let end = rest.char_indices().find(|(at, c)| {
            let is_sign = *c == '-' && is_exponent(*at);
            !(c.is_alphanumeric() || "._".contains(*c) || is_sign)
        });
        let (word, rest) = rest.split_at(end.map_or(rest.len(), |(at, _)| at));
        self.rest = rest;
        word.to_owned()
    }
}
