//! The items by which a file says what its robot has in the place of arguments of `load`.

use crate::file::{Found, between};

/// An argument's name, and the robot's numbers.
pub(crate) type Default = (&'static str, Vec<f64>);

/// True if an item is the constant, in C the function, of one of these, and has its numbers.
pub(crate) fn is_default(item: &Found, is_c: bool, all: &[Default]) -> bool {
    let lines = item
        .text
        .lines()
        .map(str::trim)
        .filter(|line| !line.is_empty());
    let text: String = lines.map(|line| format!("{line} ")).collect();
    all.iter().any(|(name, values)| {
        let kinds = [false, true].into_iter();
        kinds
            .filter_map(|is_single| Some((numbers(&text, item, is_c, name, is_single)?, is_single)))
            .any(|(numbers, is_single)| are_near(&numbers, values, is_single))
    })
}

/// Returns the numbers of an item with the head of such a constant.
fn numbers(text: &str, item: &Found, is_c: bool, name: &str, is_single: bool) -> Option<Vec<f64>> {
    if is_c {
        return c_numbers(text, item, name, is_single);
    }
    let (real, capitals) = (
        if is_single { "f32" } else { "f64" },
        name.to_ascii_uppercase(),
    );
    let list = match name {
        "bodies" => between(text, "pub const BODIES: Bodies = Bodies([ ", ", ]); ")?,
        _ => {
            let (kind, list) = text.split_once("] = [")?;
            let count = list.split(',').count();
            let is_head = kind == format!("pub const {capitals}: [{real}; {count}");
            list.strip_suffix("]; ").filter(|_| is_head)?
        }
    };
    list.split(", ").map(|own| own.parse().ok()).collect()
}

fn c_numbers(text: &str, item: &Found, name: &str, is_single: bool) -> Option<Vec<f64>> {
    // Of bodies nothing in the text says which scalar's they are but the names.
    let prefix = item.name.strip_suffix(&format!("_{name}"))?;
    let macros = &item.symbols.macros;
    let (real, suffix) = if is_single {
        ("float", "F")
    } else {
        ("double", "")
    };
    let (head, body) = text.split_once(" { ")?;
    let lines: Vec<&str> = body.strip_suffix("; } ")?.split("; ").collect();
    let count = lines.len();
    let (kind, entry) = match name {
        "bodies" => (
            format!("{prefix}_bodies_t into[{macros}_RESTRICT 1]"),
            "into->bodies",
        ),
        _ => (format!("{real} into[{macros}_RESTRICT {count}]"), "into"),
    };
    if head != format!("static inline void {prefix}_{name}({kind})") {
        return None;
    }
    let number = |(place, line): (usize, &&str)| {
        let number = between(line, &format!("{entry}[{place}] = "), suffix)?;
        number.parse().ok()
    };
    lines.iter().enumerate().map(number).collect()
}

/// Both are the nearest of the same decimals, or next to these.
fn are_near(numbers: &[f64], values: &[f64], is_single: bool) -> bool {
    let part = if is_single { 1.2e-7 } else { 4.5e-16 };
    let is_near = |(own, value): (&f64, &f64)| (own - value).abs() <= part * value.abs();
    numbers.len() == values.len() && numbers.iter().zip(values).all(is_near)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_have_the_robots_numbers() {
        let all = [("bodies", vec![0.0, 1.5]), ("armature", vec![0.1, 0.0])];
        let item = |text: &str| Found {
            text: text.to_owned(),
            ..Found::default()
        };
        let is = |text: &str| is_default(&item(text), false, &all);
        assert!(is(
            "pub const BODIES: Bodies = Bodies([\n    0.0,\n    1.5,\n]);\n"
        ));
        assert!(!is(
            "pub const BODIES: Bodies = Bodies([\n    0.0,\n    1.6,\n]);\n"
        ));
        assert!(!is("pub const BODIES: Bodies = Bodies([\n    0.0,\n]);\n"));
        assert!(is("pub const ARMATURE: [f64; 2] = [0.1, 0.0];\n"));
        assert!(is("pub const ARMATURE: [f32; 2] = [0.1, 0.0];\n"));
        assert!(!is("pub const ARMATURE: [f64; 2] = [0.1, 0.0000001];\n"));
        assert!(!is("pub const VISCOUS: [f64; 2] = [0.1, 0.0];\n"));
        let mut header = item(
            "static inline void arm_armature(double into[ARM_RESTRICT 2])\n{\n    into[0] = 0.1;\n    \
             into[1] = 0.0;\n}\n",
        );
        header.name = "arm_armature";
        header.symbols.macros = "ARM".to_owned();
        assert!(is_default(&header, true, &all));
        header.text = header.text.replace("0.1", "0.2");
        assert!(!is_default(&header, true, &all));
    }
}
