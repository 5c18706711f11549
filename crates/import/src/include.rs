//! The files that an MJCF includes, in the places that include them.

use std::collections::BTreeSet;
use std::ops::Range;
use std::path::Path;

use crate::problems::Problems;
use crate::text::Text;
use crate::{MAX_BYTES, MAX_MIB, guard};

const MAX_FILES: usize = 256;

struct Open {
    file: usize,
    rest: Range<usize>,
    /// The files that it includes, the last first: where, and their names.
    inner: Vec<(Range<usize>, String)>,
}

impl Text {
    /// Returns the text, with what it includes of files beside this one; `read` gives the
    /// text of a file, or says why there is none.
    ///
    /// # Errors
    /// An include that is wrong, as [`Text::render`] prints it.
    pub fn with_includes(
        self,
        path: &Path,
        read: impl Fn(&Path) -> Result<String, String>,
    ) -> Result<Text, String> {
        if !self.text.contains("<include") || !self.text.contains("<mujoco") {
            return Ok(self);
        }
        let mut made = Text {
            text: String::new(),
            files: self.files,
            parts: Vec::new(),
        };
        let folder = path.parent().unwrap_or(Path::new(""));
        let mut seen = BTreeSet::from([path.to_owned()]);
        let mut open = vec![made.open(0)?];
        while let Some(file) = open.last_mut() {
            let (index, at) = (file.file, file.rest.start);
            let Some((span, name)) = file.inner.pop() else {
                let rest = file.rest.clone();
                open.pop();
                made.take(index, rest);
                continue;
            };
            file.rest.start = span.end;
            made.take(index, at..span.start);
            // As MuJoCo looks for it: beside the first file, then beside this one.
            let own = Path::new(&made.files[index].0).parent();
            let beside = [folder, own.unwrap_or(folder)].map(|folder| folder.join(&name));
            let found = read(&beside[0]).map(|text| (&beside[0], text));
            let found = found.or_else(|why| {
                let own = read(&beside[1]).map(|text| (&beside[1], text));
                own.map_err(|_| why)
            });
            let (whole, text) = match found {
                Ok(found) => found,
                Err(why) => {
                    let message = format!("`{name}` cannot be read: {why}");
                    let help = "a name is relative to the folder of the file that is imported";
                    return Err(made.error(index, span, message, help));
                }
            };
            if !seen.insert(whole.clone()) || made.files.len() == MAX_FILES {
                let message = format!(
                    "`{name}` is included a second time, or among more than {MAX_FILES} files"
                );
                return Err(made.error(index, span, message, "each file is included once"));
            }
            let others: usize = made.files.iter().map(|(_, text)| text.len()).sum();
            if others + text.len() > MAX_BYTES {
                let message = format!("with this, the model is longer than {MAX_MIB} MiB");
                return Err(made.error(index, span, message, "is this a model of a robot?"));
            }
            made.files.push((whole.display().to_string(), text));
            open.push(made.open(made.files.len() - 1)?);
        }
        Ok(made)
    }

    /// Leaves away the root of an included file.
    fn open(&self, file: usize) -> Result<Open, String> {
        let text = &self.files[file].1;
        let mut problems = Problems::new(text);
        let Some(document) = guard::parse(text, &mut problems) else {
            return Err(self.rendered(file, problems));
        };
        let root = document.root_element();
        let end = root.range().end;
        let rest = match (root.first_child(), root.last_child()) {
            _ if file == 0 => 0..text.len(),
            (Some(first), Some(last)) => first.range().start..last.range().end,
            _ => end..end,
        };
        let mut inner = Vec::new();
        let nodes = root.descendants();
        for node in nodes.filter(|node| node.has_tag_name("include")) {
            let Some(name) = node.attribute("file") else {
                let help = "<include file=\"arm.xml\"/>";
                let message = "<include> has no `file`".to_owned();
                return Err(self.error(file, node.range(), message, help));
            };
            inner.push((node.range(), name.to_owned()));
        }
        inner.reverse();
        Ok(Open { file, rest, inner })
    }

    fn error(&self, file: usize, span: Range<usize>, message: String, help: &str) -> String {
        let mut problems = Problems::new(&self.files[file].1);
        problems.error(&span, message, help);
        self.rendered(file, problems)
    }

    fn rendered(&self, file: usize, problems: Problems) -> String {
        let (name, text) = &self.files[file];
        let errors = problems.finish().err();
        errors.map_or_else(String::new, |errors| errors.render(name, text))
    }
}
