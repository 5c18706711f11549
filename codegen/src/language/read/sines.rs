//! Sines and cosines: by a call for one angle or for all.

use super::block::by_library;
use super::reader::Reader;
use super::{expect, index_of};
use crate::language::angles;
use crate::language::dialect::holes;
use crate::program::{Library, Need};

impl Reader {
    /// Takes sines and cosines and their names.
    pub(super) fn sines(&mut self, names: &str, value: &str) -> Result<(), String> {
        if self.library == Library::Together {
            return Err("a call after that of all angles together".into());
        }
        if let Some((function, argument)) = self.called(Library::Together, value)
            && let Some([angles]) = holes("&[{}]", argument)
        {
            return self.together(names, function, angles);
        }
        let (function, argument) = self
            .called(Library::Libm, value)
            .ok_or_else(|| format!("`{value}` is no sine or cosine of this library and scalar"))?;
        let joint = joint(argument)?;
        let (sin, cos) = match function {
            "sin" => (true, false),
            "cos" => (false, true),
            "sincos" => (true, true),
            _ => return Err(format!("`{function}` is no sine or cosine")),
        };
        let need = Need { sin, cos };
        expect(names, &angles::names(joint, need))?;
        self.pairs.push(by_library(joint, need));
        Ok(())
    }

    /// Reads one call for all angles: `let ([s1, _], [c1, c2]) = …::sincos(&[q[0], q[1]]);`
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
            let joint = joint(word)?;
            let taken = |name: &str, letter: char| match name {
                "_" => Ok(false),
                name => expect(name, &format!("{letter}{}", joint + 1)).map(|()| true),
            };
            let (sin, cos) = (taken(sine, 's')?, taken(cosine, 'c')?);
            if !sin && !cos {
                return Err(format!("neither sine nor cosine of `{word}` is taken"));
            }
            self.pairs.push(by_library(joint, Need { sin, cos }));
        }
        self.library = Library::Together;
        Ok(())
    }
}

/// Reads the position of a joint, which sines are taken of.
fn joint(word: &str) -> Result<usize, String> {
    index_of(word, "q").ok_or_else(|| format!("`{word}` is no angle"))
}
