//! The files that an MJCF includes, in the places that include them.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use dalembert_model::diagnostic::Diagnostics;

use crate::problems::Problems;
use crate::text::{MAX_BYTES, MAX_MIB, Text};
use crate::xml::{Element, parse};

const MAX_FILES: usize = 256;

impl Text {
    /// Appends the files that an MJCF includes; `read` returns the text of a file, or why there is
    /// none.
    ///
    /// # Errors
    /// An include that is wrong.
    pub fn with_includes(
        mut self,
        path: &Path,
        read: impl Fn(&Path) -> Result<String, String>,
    ) -> Result<Text, Diagnostics> {
        if !self.as_str().contains("<include") || !self.as_str().contains("<mujoco") {
            return Ok(self);
        }
        let folder = path.parent().unwrap_or(Path::new(""));
        let mut paths = BTreeSet::from([path.to_owned()]);
        // The includes that are still to be read, the next one last, each with its file.
        let mut open = Vec::new();
        loop {
            let file = self.count() - 1;
            let mut problems = Problems::of(&self);
            if let Some(root) = parse(&self, file, 0, &mut problems) {
                if file == 0 && root.tag != "mujoco" {
                    return Ok(self);
                }
                let includes = root.all_inside("include").into_iter().rev();
                open.extend(includes.map(|include| (file, include.clone())));
            } else {
                problems.finish()?;
            }
            let Some((file, include)) = open.pop() else {
                return Ok(self);
            };
            let source = self.included(folder, file, &include, &mut paths, &read);
            let (path, text) = source?;
            self.add_file(&path.display().to_string(), &text);
        }
    }

    /// Reads a file, which MuJoCo looks for beside the first file, then beside the one that
    /// includes it.
    fn included(
        &self,
        folder: &Path,
        file: usize,
        include: &Element,
        paths: &mut BTreeSet<PathBuf>,
        read: impl Fn(&Path) -> Result<String, String>,
    ) -> Result<(PathBuf, String), Diagnostics> {
        let mut problems = Problems::of(self);
        let (at, name) = (&include.at, include.value("file").unwrap_or_default());
        let beside = Path::new(self.file(file).0).parent().unwrap_or(folder);
        let [first, second] = [folder, beside].map(|folder| folder.join(name));
        let source = read(&first)
            .map(|text| (first, text))
            .or_else(|why| read(&second).map(|text| (second, text)).map_err(|_| why));
        match source {
            _ if name.is_empty() => problems.report("include_without_file", at, &[]),
            Err(why) => problems.report("include_unread", at, &[&name, &why]),
            Ok((path, _)) if paths.contains(&path) || self.count() == MAX_FILES => {
                problems.report("include_twice", at, &[&name, &MAX_FILES]);
            }
            Ok((_, text)) if self.as_str().len() + text.len() > MAX_BYTES => {
                problems.report("include_too_long", at, &[&name, &MAX_MIB]);
            }
            Ok((path, text)) => {
                paths.insert(path.clone());
                return Ok((path, text));
            }
        }
        Err(problems.finish().map_or_else(|errors| errors, Diagnostics))
    }

    /// Parses the model with the included elements in the places of the `<include>` elements.
    pub(crate) fn elements(&self, problems: &mut Problems) -> Option<Element> {
        let mut root = parse(self, 0, 0, problems)?;
        if root.tag == "mujoco" {
            self.expand(&mut root.inside, 1, &mut 1, problems)?;
        }
        Some(root)
    }

    fn expand(
        &self,
        elements: &mut Vec<Element>,
        depth: usize,
        next: &mut usize,
        problems: &mut Problems,
    ) -> Option<()> {
        let mut place = 0;
        while let Some(element) = elements.get_mut(place) {
            if element.tag != "include" {
                self.expand(&mut element.inside, depth + 1, next, problems)?;
                place += 1;
            } else if *next < self.count() {
                let included = parse(self, *next, depth, problems)?;
                *next += 1;
                elements.splice(place..=place, included.inside);
            } else {
                return problems.refuse("include_in_text", &element.at, &[]);
            }
        }
        Some(())
    }
}
