//! Sines and cosines: by polynomials in a block, by a call for one angle or for all, or
//! from a caller.

use super::reader::{Reader, one_operation, output};
use super::{expect, index_of};
use crate::language::dialect::{Dialect, holes};
use crate::program::kernel::{ANGLE, Kernel, Term};
use crate::program::{AngleSum, Library, LoweredTrig, Operation};

/// The open block of an angle's polynomials.
pub(super) struct Block {
    pub(super) trig: LoweredTrig,
    /// How its lines name the angle.
    argument: String,
    /// How its lines name their steps, before the number.
    prefix: String,
    pub(super) kernel: Kernel,
    /// Whether the result was read.
    done: bool,
}

impl Block {
    /// Opens the block of an angle by the names in its lines.
    pub(super) fn new(trig: LoweredTrig, argument: String, prefix: String) -> Block {
        Block {
            trig,
            argument,
            prefix,
            kernel: Kernel::default(),
            done: false,
        }
    }

    /// Returns what was read.
    pub(super) fn done(self) -> LoweredTrig {
        LoweredTrig {
            kernel: Some(self.kernel),
            ..self.trig
        }
    }

    /// Returns the block that a line opens: `let (s1, c1) = {`. A sum of angles is the one
    /// that the line before formed.
    pub(super) fn begin(line: &str, sums: &mut Vec<AngleSum>) -> Option<Block> {
        let names = line.strip_prefix("let ")?.strip_suffix(" = {")?;
        let name = list(names)[0];
        let angle: AngleSum = name.strip_prefix(['s', 'c'])?.parse().ok()?;
        let trig = pair(names, angle)?;
        let argument = match angle.additions() {
            0 => format!("q[{}]", angle.terms().next()?.0),
            _ => format!("a{}", sums.pop_if(|sum| *sum == angle)?),
        };
        Some(Block::new(trig, argument, "x".to_owned()))
    }

    /// Takes a line; whether it ends the block.
    pub(super) fn line(&mut self, line: &str, dialect: Dialect) -> Result<bool, String> {
        if self.done {
            expect(line, "};")?;
            return Ok(true);
        }
        match holes(dialect.declaration, line) {
            Some([name, value]) => self.step(name, value, dialect)?,
            None => {
                let mut values = list(line).into_iter();
                let mut next = |taken: bool| match (taken, &mut values) {
                    (false, _) => Ok(None),
                    (true, values) => {
                        let word = values.next().unwrap_or_default();
                        output(word, |word| self.term(word, dialect)).map(Some)
                    }
                };
                let (sin, cos) = (next(self.trig.sin)?, next(self.trig.cos)?);
                if let Some(more) = values.next() {
                    return Err(format!("`{more}` is of no name"));
                }
                (self.kernel.sin, self.kernel.cos) = (sin, cos);
                self.done = true;
            }
        }
        Ok(false)
    }

    /// Takes an operation and its name.
    pub(super) fn step(&mut self, name: &str, value: &str, dialect: Dialect) -> Result<(), String> {
        expect(
            name,
            &format!("{}{}", self.prefix, self.kernel.steps.len() + 1),
        )?;
        let step = one_operation(value, |word| self.term(word, dialect))?;
        if matches!(step.operation, Operation::Div | Operation::Fused) {
            return Err(format!("`{value}` is no operation of a polynomial"));
        }
        self.kernel.steps.push(step);
        Ok(())
    }

    pub(super) fn term(&self, word: &str, dialect: Dialect) -> Result<Term, String> {
        if word == self.argument {
            return Ok(ANGLE);
        }
        if let Some(step) = word.strip_prefix(self.prefix.as_str()) {
            let step = step.parse::<usize>().ok().and_then(|n| n.checked_sub(1));
            let step = step.filter(|&step| step < self.kernel.steps.len());
            return match step {
                Some(step) => Ok(Term::Step(step)),
                None => Err(format!("`{word}` is not computed yet")),
            };
        }
        let literal = dialect.read_literal(word).map(Term::Constant);
        literal.ok_or_else(|| format!("`{word}` is neither the angle, a value nor a literal"))
    }
}

impl Reader<'_> {
    /// Whether a value is one that [`sines`](Self::sines) reads.
    pub(super) fn is_of_sines(&self, value: &str) -> bool {
        value.contains('(') || value.starts_with("sin[") || value.starts_with("cos[")
    }

    /// Takes sines and cosines and their names.
    pub(super) fn sines(&mut self, names: &str, value: &str) -> Result<(), String> {
        if let Some(angles) = self.given {
            let name = list(names)[0];
            let angle = name.strip_prefix(['s', 'c']).and_then(|n| n.parse().ok());
            let trig = angle.and_then(|angle| pair(names, angle));
            let place = trig.as_ref().and_then(|trig| angles.place(trig.angle));
            let (trig, place) = trig
                .zip(place)
                .ok_or_else(|| format!("`{names}` are no sine and cosine of a caller's"))?;
            let [sin, cos] = ["sin", "cos"].map(|array| format!("{array}[{place}]"));
            expect(value, &shown(&trig, &sin, &cos))?;
            self.program.trig.push(trig);
            return Ok(());
        }
        if self.program.library == Library::Together {
            return Err("a call after that of all angles together".into());
        }
        let (function, argument) = self
            .called(value)
            .ok_or_else(|| format!("`{value}` is no sine or cosine of this scalar"))?;
        if let Some([angles]) = holes("&[{}]", argument) {
            return self.together(names, function, angles);
        }
        let angle = self.angle(argument, |sums| sums.pop())?;
        let (sin, cos) = match function {
            "sin" => (true, false),
            "cos" => (false, true),
            "sincos" => (true, true),
            _ => return Err(format!("`{function}` is no sine or cosine")),
        };
        let trig = trig(angle, sin, cos);
        expect(
            names,
            &shown(&trig, &format!("s{angle}"), &format!("c{angle}")),
        )?;
        self.program.trig.push(trig);
        Ok(())
    }

    /// One call for all angles: `let ([s1, _], [c1, c1p2]) = …::sincos(&[q[0], a1p2]);`
    fn together(&mut self, names: &str, function: &str, angles: &str) -> Result<(), String> {
        expect(function, "sincos")?;
        let [sines, cosines] = holes("([{}], [{}])", names)
            .ok_or_else(|| format!("`{names}` are no sines and cosines"))?;
        let [sines, cosines, angles] =
            [sines, cosines, angles].map(|list| list.split(", ").collect::<Vec<&str>>());
        if sines.len() != angles.len() || cosines.len() != angles.len() {
            return Err("as many sines, cosines and angles are expected".into());
        }
        for ((word, sine), cosine) in angles.into_iter().zip(sines).zip(cosines) {
            let first = |sums: &mut Vec<AngleSum>| (!sums.is_empty()).then(|| sums.remove(0));
            let angle = self.angle(word, first)?;
            let taken = |name: &str, letter: char| match name {
                "_" => Ok(false),
                name => expect(name, &format!("{letter}{angle}")).map(|()| true),
            };
            let trig = trig(angle, taken(sine, 's')?, taken(cosine, 'c')?);
            if !trig.sin && !trig.cos {
                return Err(format!("neither sine nor cosine of `{word}` is taken"));
            }
            self.program.trig.push(trig);
        }
        self.program.library = Library::Together;
        match self.sums.first() {
            Some(sum) => Err(format!("the sine of `a{sum}` is not called")),
            None => Ok(()),
        }
    }

    /// Reads an angle that sines are taken of: a position, or the next of the sums.
    fn angle(
        &mut self,
        word: &str,
        next: impl Fn(&mut Vec<AngleSum>) -> Option<AngleSum>,
    ) -> Result<AngleSum, String> {
        if let Some(joint) = index_of(word, "q") {
            return Ok(AngleSum::joint(joint));
        }
        let sum = next(&mut self.sums).filter(|sum| word == format!("a{sum}"));
        sum.ok_or_else(|| format!("`{word}` is no angle"))
    }
}

pub(super) fn trig(angle: AngleSum, sin: bool, cos: bool) -> LoweredTrig {
    LoweredTrig {
        angle,
        sin,
        cos,
        kernel: None,
    }
}

/// The entries of `(a, b)`, or `a`.
fn list(words: &str) -> Vec<&str> {
    let inner = words.strip_prefix('(').and_then(|w| w.strip_suffix(')'));
    inner.map_or(vec![words], |inner| inner.split(", ").collect())
}

/// The sine, the cosine or both, by these names of an angle.
fn pair(names: &str, angle: AngleSum) -> Option<LoweredTrig> {
    let (sine, cosine) = (format!("s{angle}"), format!("c{angle}"));
    let all = [(true, true), (true, false), (false, true)];
    let mut all = all.into_iter().map(|(sin, cos)| trig(angle, sin, cos));
    all.find(|trig| names == shown(trig, &sine, &cosine))
}

/// The sine, the cosine or both, as they are written.
fn shown(trig: &LoweredTrig, sine: &str, cosine: &str) -> String {
    match (trig.sin, trig.cos) {
        (true, false) => sine.to_owned(),
        (false, true) => cosine.to_owned(),
        _ => format!("({sine}, {cosine})"),
    }
}
