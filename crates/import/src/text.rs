//! The text of a model: its file, followed by the files that an MJCF includes.

use std::ops::Range;
use std::path::Path;

use dalembert_model::diagnostic::Excerpt;

/// The largest model that is read, in bytes: meshes are not in it.
pub const MAX_BYTES: usize = 1 << 24;
pub(crate) const MAX_MIB: usize = MAX_BYTES >> 20;

/// Bytes of a [`Text`].
pub(crate) type Span = Range<usize>;

/// Begins each file that is included, in the order in which the `<include>` elements are expanded.
const MARK: &str = "\n<?included ";

/// The text of a model, with the files that it includes.
///
/// Places are bytes of the whole text; [`Text::line`] gives the file and the line.
///
/// ```
/// use dalembert_import::{Options, Text, import_text};
///
/// let text = Text::of("arm.urdf", "<robot><link name='base'/></robot>".to_owned());
/// let errors = import_text(&text, &Options::default()).unwrap_err();
/// assert!(errors.to_string().contains("--> arm.urdf:1:"));
/// ```
#[derive(Clone, Debug)]
pub struct Text {
    text: String,
    /// The name of each file, and where its text is.
    files: Vec<(String, Range<usize>)>,
}

impl Text {
    /// Takes the text of a file of this name, or what [`Text::as_str`] returned.
    pub fn of(name: &str, text: String) -> Text {
        let (mut files, mut name, mut from) = (Vec::new(), name, 0);
        while let Some((before, rest)) = text[from..].split_once(MARK)
            && let Some((next, _)) = rest.split_once("?>\n")
        {
            files.push((name.to_owned(), from..from + before.len()));
            from += before.len() + MARK.len() + next.len() + "?>\n".len();
            name = next;
        }
        files.push((name.to_owned(), from..text.len()));
        Text { text, files }
    }

    /// Takes the text of one file: what looks like the begin of an included one is none.
    pub(crate) fn of_file(name: &str, text: &str) -> Text {
        Text::of(name, unmarked(text))
    }

    /// Returns the name of the first file, as messages call it.
    pub fn name(&self) -> &str {
        &self.files[0].0
    }

    /// Returns the whole text, from which [`Text::of`] makes the same again.
    pub fn as_str(&self) -> &str {
        &self.text
    }

    /// Returns the name of the file of a place, and its line there, from one.
    pub fn line(&self, byte: usize) -> (&str, usize) {
        let (name, range) = self.file_of(byte);
        let before = self.text.get(range.start..byte).unwrap_or_default();
        (name, before.matches('\n').count() + 1)
    }

    /// Returns bytes of the text with their file and line.
    pub(crate) fn excerpt(&self, span: &Span) -> Excerpt {
        let (name, range) = self.file_of(span.start);
        let [start, end] = [span.start, span.end].map(|byte| byte.saturating_sub(range.start));
        let source = &self.text[range.clone()];
        let before = source.get(..start).unwrap_or_default();
        let line = before.matches('\n').count() + 1;
        let begin = before.rfind('\n').map_or(0, |at| at + 1);
        let mut excerpt = Excerpt::new(source, start..end.max(start), line, begin);
        excerpt.file.clone_from(name);
        excerpt
    }

    /// Returns a place as comments of robot files call it.
    pub(crate) fn place(&self, byte: usize) -> String {
        let (name, line) = self.line(byte);
        let name = Path::new(name).file_name().unwrap_or_default();
        match self.files.len() {
            1 => format!("line {line}"),
            _ => format!("{}, line {line}", name.to_string_lossy()),
        }
    }

    /// Returns the name of a file, its text, and where that begins.
    pub(crate) fn file(&self, index: usize) -> (&str, &str, usize) {
        let (name, range) = &self.files[index];
        (name, &self.text[range.clone()], range.start)
    }

    fn file_of(&self, byte: usize) -> &(String, Range<usize>) {
        let after = self.files.partition_point(|(_, range)| range.start <= byte);
        &self.files[after.saturating_sub(1)]
    }

    pub(crate) fn count(&self) -> usize {
        self.files.len()
    }

    pub(crate) fn add_file(&mut self, name: &str, text: &str) {
        let name = name.replace("?>", "");
        self.text += &format!("{MARK}{name}?>\n");
        let start = self.text.len();
        self.text += &unmarked(text);
        self.files.push((name, start..self.text.len()));
    }
}

/// Returns a text without marks of included files; its bytes stay where they are.
fn unmarked(text: &str) -> String {
    text.replace("<?included ", "<?Included ")
}
