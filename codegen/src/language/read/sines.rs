//! Sines and cosines: by a call for one angle or for all.

use super::block::{shown, trig};
use super::reader::Reader;
use super::{expect, index_of};
use crate::language::dialect::holes;
use crate::program::{AngleSum, Library};

impl Reader {
    /// Takes sines and cosines and their names.
    pub(super) fn sines(&mut self, names: &str, value: &str) -> Result<(), String> {
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

    /// Reads one call for all angles: `let ([s1, _], [c1, c1p2]) = …::sincos(&[q[0], a1p2]);`
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
