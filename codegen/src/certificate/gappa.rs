//! A second opinion on rounding: scripts for Gappa, a tool of others that
//! bounds rounding errors and proves what it says.
//!
//! A script has the emitted arithmetic of one output twice, once rounded
//! (`t1`, by `rnd`) and once exact (`T1`), with what is known of the inputs, and
//! asks how far the two results are apart: arithmetic, constants and sines
//! together. Gappa takes a sine and a cosine as two numbers from −1 to 1; that
//! their squares add up to one it does not know, nor do we use it for rounding.

use std::collections::BTreeSet;
use std::fmt::Write;

use dalembert_model::number::Exact;

use crate::certificate::Certificate;
use crate::interval::Interval;
use crate::program::{AngleSum, Input, Operand, Operation, Program, ScalarType, Step};

/// The script for an output of a certificate's emitted program; none if the
/// output takes no operation.
pub fn script(certificate: &Certificate, output: usize) -> Option<String> {
    let program = &certificate.emitted;
    let Operand::Step(result) = program.outputs.get(output)?.value else {
        return None;
    };
    let live = live(program, result);
    let steps = || live.iter().map(|&index| (index, &program.steps[index]));
    let format = match certificate.scalar {
        ScalarType::F64 => 64,
        ScalarType::F32 => 32,
    };
    let mut writer = Writer {
        certificate,
        constants: Vec::new(),
        text: format!(
            "# Rounding of {} of `{}` of {} in {}.\n@rnd = float<ieee_{format}, ne>;\n",
            program.entry(output),
            program.function,
            certificate.robot,
            certificate.scalar,
        ),
    };
    let operands = steps().flat_map(|(_, step)| [&step.left, &step.right]);
    let inputs: BTreeSet<Input> = operands
        .filter_map(|operand| match operand {
            Operand::Input(input) => Some(*input),
            _ => None,
        })
        .collect();
    for input in inputs.iter().filter(|input| input.angle().is_none()) {
        let name = computed_input(*input);
        writer.line(&format!("{name} = rnd({name}_);"));
    }
    for (index, step) in steps() {
        writer.computed(index, step);
    }
    for (index, step) in steps() {
        writer.exact(index, step);
    }
    writer.question(&inputs, result);
    for index in &live {
        let number = index + 1;
        writer.line(&format!("t{number} ~ T{number};"));
    }
    Some(writer.text)
}

/// The steps that a step is made of, in order, itself among them.
fn live(program: &Program, result: usize) -> Vec<usize> {
    let mut live = BTreeSet::from([result]);
    for index in (0..=result).rev() {
        if live.contains(&index) {
            let step = &program.steps[index];
            for operand in [&step.left, &step.right] {
                if let Operand::Step(before) = operand {
                    live.insert(*before);
                }
            }
        }
    }
    live.into_iter().collect()
}

struct Writer<'c> {
    certificate: &'c Certificate,
    /// Constants that are no rationals: known by an enclosure.
    constants: Vec<Exact>,
    text: String,
}

impl Writer<'_> {
    fn line(&mut self, line: &str) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.text, "{line}");
    }

    fn computed(&mut self, index: usize, step: &Step) {
        let scalar = self.certificate.scalar;
        let operand = |operand: &Operand| match operand {
            Operand::Input(input) => computed_input(*input),
            Operand::Constant(constant) => dyadic(scalar.round(constant)),
            Operand::Step(before) => format!("t{}", before + 1),
        };
        let (left, right) = (operand(&step.left), operand(&step.right));
        let (rounded, symbol) = match step.operation {
            // The sum that takes it rounds, and rounds the exact product.
            Operation::Fused => ("=", '*'),
            operation => ("rnd=", operation.symbol()),
        };
        self.line(&format!(
            "t{} {rounded} {left} {symbol} {right};",
            index + 1
        ));
    }

    fn exact(&mut self, index: usize, step: &Step) {
        let (left, right) = (
            self.exact_operand(&step.left),
            self.exact_operand(&step.right),
        );
        let symbol = match step.operation {
            Operation::Fused => '*',
            operation => operation.symbol(),
        };
        self.line(&format!("T{} = {left} {symbol} {right};", index + 1));
    }

    fn exact_operand(&mut self, operand: &Operand) -> String {
        match operand {
            Operand::Input(input) => exact_input(*input),
            Operand::Step(before) => format!("T{}", before + 1),
            Operand::Constant(constant) => match constant.as_rational() {
                Some(value) => format!("({value})"),
                None => {
                    let known = self.constants.iter().position(|known| known == constant);
                    let at = known.unwrap_or_else(|| {
                        self.constants.push(constant.clone());
                        self.constants.len() - 1
                    });
                    format!("K{}", at + 1)
                }
            },
        }
    }

    /// What is known, and what is asked.
    fn question(&mut self, inputs: &BTreeSet<Input>, result: usize) {
        let limits = &self.certificate.limits;
        let mut known = Vec::new();
        for &input in inputs {
            let name = computed_input(input);
            let range = limits.input(input);
            match input.angle() {
                None => known.push(format!("{name} in {}", interval(range))),
                Some(angle) => {
                    let error = self.sine(input, angle);
                    let exact = exact_input(input);
                    known.push(format!("{exact} in {}", interval(range)));
                    known.push(format!("{name} in {}", interval(range.widened(error))));
                    known.push(format!("|{name} - {exact}| <= {}", dyadic(error)));
                }
            }
        }
        for (index, constant) in self.constants.iter().enumerate() {
            let range = interval(Interval::exact(constant));
            known.push(format!("K{} in {range}", index + 1));
        }
        let (known, number) = (known.join("\n/\\ "), result + 1);
        self.line(&format!("{{ {known}\n-> t{number} - T{number} in ? }}"));
    }

    /// How far a computed sine or cosine is off, rounded up.
    fn sine(&self, input: Input, angle: AngleSum) -> f64 {
        let Certificate {
            scalar,
            limits,
            sines,
            ..
        } = self.certificate;
        let u = scalar.unit_roundoff();
        let own = sines.iter().find(|sine| sine.angle == angle);
        let error = match (own, input) {
            (Some(own), Input::Sin(_)) => own.errors.sin,
            (Some(own), _) => own.errors.cos,
            // Within one ulp; below one, an ulp is at most u.
            (None, _) => u,
        };
        if angle.additions() == 0 {
            return error;
        }
        // The sum of angles is rounded; a sine moves no more than its angle.
        let reach: f64 = angle
            .terms()
            .map(|(joint, _)| limits.position[joint].magnitude())
            .sum();
        (error + 1.01 * angle.additions() as f64 * u * reach).next_up()
    }
}

fn computed_input(input: Input) -> String {
    match input {
        Input::Sin(angle) => format!("s{angle}"),
        Input::Cos(angle) => format!("c{angle}"),
        Input::PerSpeed(joint) => format!("r{}", joint + 1),
        Input::Entry(argument, joint) => format!("{}{joint}", argument.name()),
    }
}

/// Sines are approximated; other inputs are exact.
fn exact_input(input: Input) -> String {
    match input.angle() {
        Some(_) => computed_input(input).to_uppercase(),
        None => computed_input(input),
    }
}

fn interval(range: Interval) -> String {
    format!("[{}, {}]", dyadic(range.low()), dyadic(range.high()))
}

/// A finite double, exactly: an integer times a power of two.
fn dyadic(value: f64) -> String {
    let bits = value.abs().to_bits();
    let (field, fraction) = ((bits >> 52) as i64, bits & ((1 << 52) - 1));
    let (significand, exponent) = match field {
        0 => (fraction, -1074),
        _ => (fraction | 1 << 52, field - 1075),
    };
    if significand == 0 {
        return "0".to_owned();
    }
    let zeros = significand.trailing_zeros();
    let sign = if value < 0.0 { "-" } else { "" };
    let exponent = exponent + i64::from(zeros);
    format!("{sign}{}b{exponent}", significand >> zeros)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn doubles_are_written_exactly() {
        for (value, text) in [
            (0.0, "0"),
            (1.0, "1b0"),
            (-0.75, "-3b-2"),
            (9.81, "5522539043063071b-49"),
            (5e-324, "1b-1074"),
            (1e300, "1681218273811815b946"),
        ] {
            assert_eq!(dyadic(value), text);
        }
        let (m, e) = (1681218273811815u64, 946);
        assert_eq!(libm::ldexp(m as f64, e), 1e300);
    }
}
