//! Reads from a crate's text which file uses which.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// The files of a crate by their module's path, `bound::grid`.
pub struct Crate {
    pub name: String,
    /// The files that each file uses.
    pub files: BTreeMap<String, BTreeSet<String>>,
}

/// A file: its code without comments, texts and tests, and its imports.
struct Source {
    code: String,
    /// Absolute paths of what it imports, by the name that it has here.
    imports: Vec<(String, Vec<String>)>,
}

impl Crate {
    pub fn read(src: &Path) -> Crate {
        let mut sources = BTreeMap::new();
        collect(src, &[], &mut sources);
        let names: BTreeSet<String> = sources.keys().cloned().collect();
        let mut files = BTreeMap::new();
        for (name, source) in &sources {
            let mut uses = BTreeSet::new();
            let imported = source.imports.iter().map(|(_, path)| path.clone());
            for path in imported.chain(paths(&source.code, name)) {
                if let Some(file) = resolve(&path, &sources, &names, 0)
                    && file != *name
                {
                    uses.insert(file);
                }
            }
            files.insert(name.clone(), uses);
        }
        Crate {
            name: src.display().to_string(),
            files,
        }
    }

    /// Returns the modules that have files of their own; the crate is `""`.
    pub fn folders(&self) -> BTreeSet<String> {
        let parent = |file: &String| match file.rsplit_once("::") {
            Some((parent, _)) => parent.to_owned(),
            None => String::new(),
        };
        self.files.keys().map(parent).collect()
    }

    /// Returns the children of a module, each with all that is below it, and which of
    /// them each uses.
    pub fn children(&self, module: &str) -> BTreeMap<String, BTreeSet<String>> {
        let child = |file: &str| {
            let rest = match module {
                "" => file,
                _ => file.strip_prefix(module)?.strip_prefix("::")?,
            };
            Some(top(rest).to_owned()).filter(|child| !child.is_empty())
        };
        let mut children: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
        for (file, uses) in &self.files {
            if let Some(from) = child(file) {
                let to = uses
                    .iter()
                    .filter_map(|to| child(to))
                    .filter(|to| *to != from);
                let to: Vec<String> = to.collect();
                children.entry(from).or_default().extend(to);
            }
        }
        children
    }

    /// Returns the files of a module that use another module.
    pub fn why(&self, from: &str, to: &str) -> Vec<&str> {
        let uses = |uses: &BTreeSet<String>| uses.iter().any(|file| top(file) == to);
        let files = self
            .files
            .iter()
            .filter(|(file, of)| top(file) == from && uses(of));
        files.map(|(file, _)| file.as_str()).collect()
    }
}

fn top(file: &str) -> &str {
    file.split("::").next().unwrap_or_default()
}

fn collect(folder: &Path, module: &[String], sources: &mut BTreeMap<String, Source>) {
    let Ok(entries) = fs::read_dir(folder) else {
        return;
    };
    for entry in entries {
        let path = entry.unwrap().path();
        let stem = path.file_stem().unwrap().to_str().unwrap().to_owned();
        let mut module = module.to_vec();
        if path.is_dir() {
            module.push(stem);
            collect(&path, &module, sources);
        } else if path.extension().is_some_and(|e| e == "rs") && stem != "tests" {
            if !matches!(stem.as_str(), "mod" | "lib" | "main") {
                module.push(stem);
            }
            let name = module.join("::");
            let code = code(&fs::read_to_string(&path).unwrap());
            let imports = imports(&code, &name);
            sources.insert(name, Source { code, imports });
        }
    }
}

/// Returns the text without comments, string literals and tests.
fn code(text: &str) -> String {
    let mut code = String::new();
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let skipped = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if c == '"' {
            let bytes = rest.as_bytes();
            let mut end = 1;
            while end < bytes.len() && bytes[end] != b'"' {
                end += if bytes[end] == b'\\' { 2 } else { 1 };
            }
            (end + 1).min(rest.len())
        } else if rest.starts_with("'\"'") {
            3
        } else {
            code.push(c);
            rest = &rest[c.len_utf8()..];
            continue;
        };
        rest = &rest[skipped..];
    }
    match code.find("#[cfg(test)]\nmod ") {
        Some(tests) if code[tests..].contains(" {\n") => code[..tests].to_owned(),
        _ => code,
    }
}

/// Returns what `use` brings in: the name here, and the path from the crate's root.
fn imports(code: &str, file: &str) -> Vec<(String, Vec<String>)> {
    let mut found = Vec::new();
    for line in code.split(';') {
        let line = line.rsplit(['}', '{']).next().map_or(line, |_| line);
        let Some(start) = line.find("use ").filter(|&at| {
            let before = line[..at].trim_end();
            before.is_empty() || before.ends_with(['}', '{', ']', ')']) || before.ends_with("pub")
        }) else {
            continue;
        };
        let tree: String = line[start + 4..]
            .split_whitespace()
            .collect::<Vec<_>>()
            .join(" ");
        let mut flat = Vec::new();
        flatten(&tree, &[], &mut flat);
        for (mut path, alias) in flat {
            if path.last().is_some_and(|last| last == "self") {
                path.pop();
            }
            let Some(name) = alias.or_else(|| path.last().cloned()) else {
                continue;
            };
            if let Some(path) = absolute(&path, file) {
                found.push((name, path));
            }
        }
    }
    found
}

/// Lists the paths of a tree such as `a::{b, c::{d, e as f}}`.
fn flatten(tree: &str, head: &[String], flat: &mut Vec<(Vec<String>, Option<String>)>) {
    let tree = tree.trim();
    let mut path = head.to_vec();
    match tree.split_once('{') {
        None => {
            let (tree, alias) = match tree.split_once(" as ") {
                Some((tree, alias)) => (tree, Some(alias.trim().to_owned())),
                None => (tree, None),
            };
            path.extend(tree.split("::").map(|part| part.trim().to_owned()));
            flat.push((path, alias));
        }
        Some((before, inner)) => {
            path.extend(
                before
                    .split("::")
                    .map(|part| part.trim().to_owned())
                    .filter(|p| !p.is_empty()),
            );
            let inner = inner.rsplit_once('}').map_or(inner, |(inner, _)| inner);
            let (mut depth, mut start) = (0, 0);
            for (at, c) in inner.char_indices().chain([(inner.len(), ',')]) {
                match c {
                    '{' => depth += 1,
                    '}' => depth -= 1,
                    ',' if depth == 0 => {
                        if !inner[start..at].trim().is_empty() {
                            flatten(&inner[start..at], &path, flat);
                        }
                        start = at + 1;
                    }
                    _ => {}
                }
            }
        }
    }
}

/// Returns the path from the crate's root, if it is in the crate.
fn absolute(path: &[String], file: &str) -> Option<Vec<String>> {
    let mut base: Vec<String> = file
        .split("::")
        .filter(|part| !part.is_empty())
        .map(String::from)
        .collect();
    match path.first()?.as_str() {
        "crate" => Some(path[1..].to_vec()),
        "self" => Some([base, path[1..].to_vec()].concat()),
        "super" => {
            let ups = path.iter().take_while(|part| *part == "super").count();
            base.truncate(base.len().checked_sub(ups)?);
            Some([base, path[ups..].to_vec()].concat())
        }
        // A child's path, or another crate's: what is no file is nobody's.
        _ => Some([base, path.to_vec()].concat()),
    }
}

/// Paths in the code itself that begin at the root or above.
fn paths(code: &str, file: &str) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    for start in ["crate::", "super::"] {
        for (at, _) in code.match_indices(start) {
            let before = code[..at].chars().next_back();
            if before.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == ':') {
                continue;
            }
            let end = code[at..].find(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':'));
            let path = &code[at..end.map_or(code.len(), |end| at + end)];
            let parts: Vec<String> = path
                .split("::")
                .filter(|p| !p.is_empty())
                .map(String::from)
                .collect();
            found.extend(absolute(&parts, file));
        }
    }
    found
}

/// Returns the file that has what a path names, through the imports on the way.
fn resolve(
    path: &[String],
    sources: &BTreeMap<String, Source>,
    names: &BTreeSet<String>,
    depth: usize,
) -> Option<String> {
    let longest = (0..=path.len())
        .rev()
        .find(|&n| names.contains(&path[..n].join("::")))?;
    let file = path[..longest].join("::");
    let Some(item) = path.get(longest) else {
        return Some(file);
    };
    let known = sources[&file].imports.iter().find(|(name, _)| name == item);
    match known {
        Some((_, to)) if depth < 8 && to.as_slice() != path => {
            resolve(to, sources, names, depth + 1)
        }
        // The root's own names are its modules, or another crate's.
        _ if longest == 0 => None,
        _ => Some(file),
    }
}
