//! Defaults: each element gets the values of its class that it does not have.

use std::collections::BTreeMap;

use super::place::ORIENTATIONS;
use crate::problems::instead;
use crate::read::Reader;
use crate::xml::{Attribute, Element};

const ACTUATORS: [&str; 11] = [
    "general",
    "motor",
    "position",
    "velocity",
    "intvelocity",
    "damper",
    "cylinder",
    "muscle",
    "adhesion",
    "dcmotor",
    "plugin",
];

/// The attributes of a class by kinds of elements.
type Values = BTreeMap<&'static str, Vec<Attribute>>;
type Classes = BTreeMap<String, Values>;

/// The outermost class, which is that of elements that name none, under whichever name.
const MAIN: &str = "main";

/// Returns a file with the values of its classes in all elements.
pub(super) fn filled(root: &Element, reader: &mut Reader) -> Element {
    let mut classes = Classes::from([(MAIN.to_owned(), Values::new())]);
    for top in root.all("default") {
        check(root, top, reader);
        let name = top.get("class").map_or(MAIN, |class| &class.value);
        let mut values = classes[MAIN].clone();
        take(top, &mut values);
        for class in [MAIN, name] {
            classes.insert(class.to_owned(), values.clone());
        }
        inner(top, &values, &mut classes, reader);
    }
    let mut root = root.clone();
    root.inside.retain(|part| part.tag != "default");
    fill(&mut root, "", &classes[MAIN].clone(), &classes, reader);
    root
}

/// Says unknown names; what is left out is said at the elements that have it.
fn check(parent: &Element, class: &Element, reader: &mut Reader) {
    let count = reader.problems.count();
    reader.check(&parent.tag, class, "a class");
    reader.problems.since(count);
}

fn take(class: &Element, values: &mut Values) {
    for element in &class.inside {
        let Some(kind) = kind("default", &element.tag) else {
            continue;
        };
        let values = values.entry(kind).or_default();
        values.retain(|old| !has(element, old));
        values.extend(
            element
                .attributes
                .iter()
                .filter(|own| own.key != "class")
                .cloned(),
        );
    }
}

/// Adds the classes inside one, each with what the outer one has.
fn inner(outer: &Element, around: &Values, classes: &mut Classes, reader: &mut Reader) {
    for class in outer.all("default") {
        let (name, at) = reader.required(class, "class");
        let mut values = around.clone();
        take(class, &mut values);
        inner(class, &values, classes, reader);
        if classes.insert(name.clone(), values).is_some() {
            let help = "each class has its settings in one place: give it another name";
            reader.problems.say("twice", &at, &[&"class", &name, &help]);
        }
    }
}

/// Returns the kind under which classes have an element: actuators, and equalities, share one.
fn kind(parent: &str, tag: &str) -> Option<&'static str> {
    let kinds = ["joint", "geom", "site", "tendon", "equality", "actuator"];
    let kind = match (parent, tag) {
        ("actuator" | "tendon" | "equality", _) => parent,
        ("fixed" | "spatial", _) => return None,
        ("default", tag) if ACTUATORS.contains(&tag) => "actuator",
        (_, "tendon" | "equality" | "actuator") if parent != "default" => return None,
        _ => tag,
    };
    kinds.into_iter().find(|own| *own == kind)
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
        let found = classes.get(&class.value);
        if found.is_none() {
            let help = instead(&class.value, classes.keys());
            reader
                .problems
                .say("no_class", &class.at, &[&class.value, &help]);
        }
        found
    };
    let kind = kind(parent, &element.tag);
    let own = kind.and_then(|_| named("class")).unwrap_or(around);
    let has_children = matches!(element.tag.as_str(), "body" | "frame");
    let inside = has_children.then(|| named("childclass")).flatten();
    let inside = inside.unwrap_or(around);
    let more = kind.and_then(|kind| own.get(kind)).into_iter().flatten();
    let more = more.filter(|value| !has(element, value));
    let more: Vec<Attribute> = more.cloned().collect();
    element.attributes.extend(more);
    for below in &mut element.inside {
        fill(below, &element.tag, inside, classes, reader);
    }
}
