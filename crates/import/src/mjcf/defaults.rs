//! Defaults: each element gets the values of its class that it does not have.

use std::collections::BTreeMap;

use super::place::ORIENTATIONS;
use crate::keywords::{MJCF, Verdict};
use crate::problems::instead;
use crate::read::Reader;
use crate::xml::{Attribute, Element};

/// The attributes of a class by kinds of elements.
type Values = BTreeMap<&'static str, Vec<Attribute>>;
type Classes = BTreeMap<String, Values>;

/// No value that is read is longer.
const MAX_LENGTH: usize = 1024;
/// The outermost class, which is that of elements that name none, under whichever name.
const MAIN: &str = "main";

/// Returns a file with the values of its classes in all elements.
pub(super) fn filled(root: &Element, reader: &mut Reader) -> Element {
    let mut classes = Classes::from([(MAIN.to_owned(), Values::new())]);
    let mut names = Vec::new();
    for top in root.all("default") {
        reader.check_class(root, top);
        names.extend(top.value("class"));
        let values = classes.entry(MAIN.to_owned()).or_default();
        take(top, values);
        let values = values.clone();
        inner(top, &values, &mut classes, reader);
    }
    let main = classes[MAIN].clone();
    for name in names {
        classes.insert(name.to_owned(), main.clone());
    }
    let mut root = root.clone();
    root.inside.retain(|part| part.tag != "default");
    fill(&mut root, "", &main, &classes, reader);
    root
}

/// Takes the values of a class that mean something for the robot.
fn take(class: &Element, values: &mut Values) {
    for element in &class.inside {
        let kind = kind("default", &element.tag);
        let Some((kind, row)) = kind.zip(MJCF.row("default", &element.tag)) else {
            continue;
        };
        let values = values.entry(kind).or_default();
        values.retain(|old| !has(element, old));
        let verdicts = [Verdict::Read, Verdict::LeftOut];
        let more = element.attributes.iter().filter(|value| {
            let is_short = value.value.len() < MAX_LENGTH;
            is_short && value.key != "class" && verdicts.contains(&row.verdict(&value.key))
        });
        values.extend(more.cloned());
    }
}

/// Adds the classes inside one, each with what the outer one has.
fn inner(outer: &Element, around: &Values, classes: &mut Classes, reader: &mut Reader) {
    for class in outer.all("default") {
        let (name, at) = reader.required(class, "class");
        let mut values = around.clone();
        take(class, &mut values);
        inner(class, &values, classes, reader);
        if !name.is_empty() && classes.insert(name.clone(), values).is_some() {
            let help = "each class has its settings in one place: give it another name";
            reader.report("twice", &at, &[&"class", &name, &help]);
        }
    }
}

/// Returns the kind under which classes have an element: actuators, and equalities, share one.
fn kind(parent: &str, tag: &str) -> Option<&'static str> {
    let kinds = ["joint", "geom", "site", "tendon", "equality", "actuator"];
    let is_actuator = MJCF.row("actuator", tag).is_some();
    let kind = match (parent, tag) {
        ("actuator" | "tendon" | "equality", _) => parent,
        ("fixed" | "spatial", _) => return None,
        ("default", _) if is_actuator => "actuator",
        (_, "tendon" | "equality" | "actuator") if parent != "default" => return None,
        _ => tag,
    };
    kinds.into_iter().find(|known| *known == kind)
}

/// True if an element has a value by itself: an orientation in any of its forms.
fn has(element: &Element, value: &Attribute) -> bool {
    let has = |key: &&str| element.get(key).is_some();
    let is_orientation = ORIENTATIONS.contains(&value.key.as_str());
    has(&value.key.as_str()) || is_orientation && ORIENTATIONS.iter().any(has)
}

fn fill(
    element: &mut Element,
    parent: &str,
    around: &Values,
    classes: &Classes,
    reader: &mut Reader,
) {
    let mut named = |key: &str| {
        let class = element.get(key)?;
        let defaults = classes.get(&class.value);
        if defaults.is_none() {
            let help = instead(&class.value, classes.keys());
            reader.report("no_class", &class.at, &[&class.value, &help]);
        }
        defaults
    };
    let kind = kind(parent, &element.tag);
    let values = kind.and_then(|_| named("class")).unwrap_or(around);
    let has_children = matches!(element.tag.as_str(), "body" | "frame" | "worldbody");
    let child_class = has_children.then(|| named("childclass")).flatten();
    let inside = child_class.unwrap_or(around);
    let of_class = kind.and_then(|kind| values.get(kind)).into_iter();
    let missing = of_class.flatten().filter(|value| !has(element, value));
    let more: Vec<Attribute> = missing.cloned().collect();
    element.attributes.extend(more);
    for below in &mut element.inside {
        fill(below, &element.tag, inside, classes, reader);
    }
}
