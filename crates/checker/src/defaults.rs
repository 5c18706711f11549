//! The items by which a file says what its robot has in the place of arguments of `load`.

use crate::compare::is_literal;
use crate::file::{Item, between};
use crate::identity::exact::Exact;

/// An argument's name, and the robot's numbers.
pub(crate) type Default = (&'static str, Vec<Exact>);

/// True if an item is the constant, in C the function, of one of these, and has its numbers.
pub(crate) fn is_default(item: &Item, is_c: bool, is_single: bool, defaults: &[Default]) -> bool {
    let words = item.text.split_whitespace();
    let text: String = words.map(|word| format!("{word} ")).collect();
    defaults.iter().any(|(name, values)| {
        let list = match is_c {
            true => c_numbers(&text, item, name, is_single),
            false => rust_numbers(&text, name, is_single),
        };
        let is = |(literal, value): (&&str, &Exact)| is_literal(literal, value, is_single);
        list.is_some_and(|literals| {
            literals.len() == values.len() && literals.iter().zip(values).all(is)
        })
    })
}

fn rust_numbers<'t>(text: &'t str, name: &str, is_single: bool) -> Option<Vec<&'t str>> {
    if name == "bodies" {
        let list = between(text, "pub const BODIES: Bodies = Bodies([ ", ", ]); ")?;
        return Some(list.split(", ").collect());
    }
    let (kind, list) = text.split_once("] = [")?;
    let list: Vec<&str> = list.strip_suffix("]; ")?.split(", ").collect();
    let real = if is_single { "f32" } else { "f64" };
    let (constant, count) = (name.to_ascii_uppercase(), list.len());
    (kind == format!("pub const {constant}: [{real}; {count}")).then_some(list)
}

fn c_numbers<'t>(text: &'t str, item: &Item, name: &str, is_single: bool) -> Option<Vec<&'t str>> {
    let prefix = item.name.strip_suffix(&format!("_{name}"))?;
    let (head, body) = text.split_once(" { ")?;
    let lines: Vec<&str> = body.strip_suffix("; } ")?.split("; ").collect();
    let [real, end] = match is_single {
        true => ["float", "F"],
        false => ["double", ""],
    };
    let (kind, entry, count) = match name {
        "bodies" => (format!("{prefix}_bodies_t"), "into->bodies", 1),
        _ => (real.to_owned(), "into", lines.len()),
    };
    let macros = &item.symbols.macros;
    let parameter = format!("{kind} into[{macros}_RESTRICT {count}]");
    if head != format!("static inline void {prefix}_{name}({parameter})") {
        return None;
    }
    let number = |(place, line): (usize, &&'t str)| -> Option<&'t str> {
        between(line, &format!("{entry}[{place}] = "), end)
    };
    lines.iter().enumerate().map(number).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_have_the_robots_numbers() {
        let exact = |text: &str| Exact::read(text).unwrap();
        let defaults = [
            ("bodies", vec![exact("0"), exact("1.5")]),
            ("armature", vec![exact("0.1"), exact("0")]),
        ];
        let item = |text: &str| Item {
            text: text.to_owned(),
            ..Item::default()
        };
        let is = |text: &str, is_single| is_default(&item(text), false, is_single, &defaults);
        let constant = |list: &str| format!("pub const BODIES: Bodies = Bodies([\n{list}]);");
        let bodies = |list: &str| is(&constant(list), false);
        assert!(bodies("    0.0,\n    1.5,\n"));
        assert!(!bodies("    0.0,\n    1.6,\n") && !bodies("    0.0,\n"));
        let armature = |real: &str, number: &str, is_single| {
            let text = format!("pub const ARMATURE: [{real}; 2] = [{number}, 0.0];\n");
            is(&text, is_single)
        };
        assert!(armature("f64", "0.1", false) && armature("f32", "0.1", true));
        assert!(!armature("f32", "0.1", false) && !armature("f64", "0.1", true));
        let others = "0.10 00.1 +0.1 1e-1 -0.1 0.0 0.10000001 0.10000000000000002";
        for other in others.split(' ') {
            assert!(!armature("f64", other, false), "{other}");
        }
        assert!(!is("pub const VISCOUS: [f64; 2] = [0.1, 0.0];\n", false));
        let mut header = item(
            "static inline void arm_armature(double into[ARM_RESTRICT 2])\n{\n    into[0] = 0.1;\n    \
             into[1] = 0.0;\n}\n",
        );
        header.name = "arm_armature";
        header.symbols.macros = "ARM".to_owned();
        assert!(is_default(&header, true, false, &defaults));
        let armature_defaults = [("armature", vec![exact("12"), exact("0")])];
        for number in ["12.0", "012", "12", "13.0"] {
            let mut other = header.clone();
            other.text = header.text.replace("0.1", number);
            let is_it = is_default(&other, true, false, &armature_defaults);
            assert_eq!(is_it, number == "12.0", "{number}");
        }
    }
}
