//! Names of quantities, as each format writes them.

/// A quantity's name.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Symbol {
    /// In plain text: `x̄2`.
    pub text: String,
    /// In LaTeX: `\bar{x}_{2}`.
    pub latex: String,
    /// As an identifier of Python: `x2`.
    pub code: String,
}

impl Symbol {
    /// Makes a symbol of letters with an index: `a` and `2`.
    pub fn indexed(letters: &str, index: impl ToString) -> Symbol {
        let index = index.to_string();
        let latex = match letters.chars().count() {
            1 => letters.to_owned(),
            _ => format!("\\mathit{{{letters}}}"),
        };
        Symbol {
            text: format!("{letters}{index}"),
            latex: match index.as_str() {
                "" => latex,
                _ => format!("{latex}_{{{index}}}"),
            },
            code: format!("{letters}{index}"),
        }
    }

    /// Makes the coordinate of a centre of mass: x̄_2.
    pub fn centre(axis: char, link: usize) -> Symbol {
        Symbol {
            text: format!("{axis}\u{304}{link}"),
            latex: format!("\\bar{{{axis}}}_{{{link}}}"),
            code: format!("{axis}{link}"),
        }
    }

    /// Makes the moment of inertia of a link about its centre of mass: I_2zz.
    pub fn inertia(link: usize, entry: &str) -> Symbol {
        Symbol::indexed("I", format!("{link}{entry}"))
    }

    /// Makes the name of an entry of a matrix: `D_11`, with commas where a number has two digits. The
    /// mark is a superscript: `rot`.
    pub fn entry(letters: &str, mark: &str, indices: &[usize]) -> Symbol {
        let from_one = indices.iter().map(|index| (index + 1).to_string());
        let numbers: Vec<String> = from_one.collect();
        let is_short = numbers.iter().all(|number| number.len() == 1);
        let joined = numbers.join(if is_short { "" } else { "," });
        let words = numbers.join(if is_short { "" } else { "_" });
        let (hat, superscript) = match mark {
            "" => ("", String::new()),
            mark => ("^", format!("^{{\\mathrm{{{mark}}}}}")),
        };
        let (under, subscript) = match numbers.is_empty() {
            true => ("", String::new()),
            false => ("_", format!("_{{{joined}}}")),
        };
        let [latex, code] = match letters {
            "τ" => ["\\tau", "tau"],
            letters => [letters; 2],
        };
        Symbol {
            text: format!("{letters}{hat}{mark}{under}{joined}"),
            latex: format!("{latex}{superscript}{subscript}"),
            code: format!("{code}{mark}{under}{words}"),
        }
    }

    /// Makes a component of a row: `wx_31` is x of the axis of joint 1 seen from link 3.
    pub fn row(letter: &str, axis: &str, indices: &[usize]) -> Symbol {
        let entry = Symbol::entry(letter, axis, indices);
        Symbol {
            text: entry.text.replace('^', ""),
            latex: entry.latex.replace("\\mathrm", ""),
            ..entry
        }
    }

    /// Makes a rate of change of a joint's position: q̇_2 with one dot, q̈_2 with two.
    pub fn rate(dots: usize, joint: usize) -> Symbol {
        let (mark, command, code) = match dots {
            1 => ('\u{307}', "dot", "dq"),
            _ => ('\u{308}', "ddot", "ddq"),
        };
        Symbol {
            text: format!("q{mark}{joint}"),
            latex: format!("\\{command}{{q}}_{{{joint}}}"),
            code: format!("{code}{joint}"),
        }
    }

    /// Marks a symbol as that of a part: `XX2` of the rotation is `XXr2`, in LaTeX with `r` as a
    /// superscript.
    #[must_use]
    pub fn marked(letters: &str, mark: &str, index: usize) -> Symbol {
        if mark.is_empty() {
            return Symbol::indexed(letters, index);
        }
        Symbol {
            text: format!("{letters}{mark}{index}"),
            latex: format!("\\mathit{{{letters}}}^{{{mark}}}_{{{index}}}"),
            code: format!("{letters}{mark}{index}"),
        }
    }
}

/// A symbol with its value and where it is from.
#[derive(Clone, Debug)]
pub struct Definition<V> {
    pub symbol: Symbol,
    pub value: V,
    /// The row of the joint that it belongs to; none of the whole robot's.
    pub row: Option<usize>,
}
