//! A model's text: of an MJCF that includes others, all of them as one.

use std::ops::Range;

use dalembert_model::read::Diagnostic;

/// The text of a model, with what it includes in the places that include it.
#[derive(Clone, Debug)]
pub struct Text {
    pub(crate) text: String,
    pub(crate) files: Vec<(String, String)>,
    /// Parts of the text in their order: where each ends, its file, and where it is there.
    pub(crate) parts: Vec<(usize, usize, usize)>,
}

impl Text {
    /// Takes a text that a file of this name has.
    pub fn of(name: &str, text: String) -> Text {
        Text {
            parts: vec![(text.len(), 0, 0)],
            files: vec![(name.to_owned(), text.clone())],
            text,
        }
    }

    /// Returns the name of the first file, as messages call it.
    pub fn name(&self) -> &str {
        self.files.first().map_or("", |(name, _)| name)
    }

    /// Returns the whole text, for [`crate::import`].
    pub fn as_str(&self) -> &str {
        &self.text
    }

    /// Returns the name of the file of a place in the text, and its line there.
    pub fn line(&self, byte: usize) -> (&str, usize) {
        let (file, at) = self.place(byte);
        let (name, text) = &self.files[file];
        (name, place(text, at).0)
    }

    pub(crate) fn in_file(&self, byte: usize) -> Option<(&str, usize)> {
        (self.files.len() > 1).then(|| self.line(byte))
    }

    /// Returns what there is to say of the text, each at its place in its file.
    pub fn render(&self, found: &[Diagnostic]) -> String {
        let rendered = found.iter().map(|found| {
            let (file, start) = self.place(found.span.start);
            let (name, text) = &self.files[file];
            let (line, column) = place(text, start);
            let own = Diagnostic {
                span: start..start + found.span.len(),
                line,
                column,
                ..found.clone()
            };
            own.render(name, text)
        });
        rendered.collect::<Vec<_>>().join("\n")
    }

    fn place(&self, byte: usize) -> (usize, usize) {
        let index = self.parts.partition_point(|(end, ..)| *end <= byte);
        let before = index.checked_sub(1);
        let start = before.map_or(0, |before| self.parts[before].0);
        match self.parts.get(index).or(self.parts.last()) {
            Some((_, file, at)) => (*file, at + byte.saturating_sub(start)),
            None => (0, byte),
        }
    }

    pub(crate) fn take(&mut self, file: usize, span: Range<usize>) {
        let start = span.start;
        let text = self.files[file].1.get(span).unwrap_or_default();
        self.text.push_str(text);
        self.parts.push((self.text.len(), file, start));
    }
}

/// Returns line and column of a byte, both from one.
pub(crate) fn place(source: &str, byte: usize) -> (usize, usize) {
    let before = source.get(..byte).unwrap_or_default();
    let line = before.bytes().filter(|b| *b == b'\n').count() + 1;
    let start = before.rfind('\n').map_or(0, |at| at + 1);
    (line, before[start..].chars().count() + 1)
}
