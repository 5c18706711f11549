//! A joint, its limits, and what drives it.

use std::collections::BTreeMap;

use dalembert_model::number::Rational;
use num_traits::Zero;

use super::{only, origin};
use crate::model::{Joint, Kind, Mimic, Number, least, or_zero};
use crate::read::Reader;
use crate::xml::{Attribute, Element};

/// Names of a rotor's inertia with those of the reduction that belongs to it, the likeliest first.
const ROTORS: [([&str; 2], [&str; 3]); 2] = [
    (
        ["rotor_inertia", "motor_inertia"],
        ["gear_ratio", "gearRatio", "mechanicalReduction"],
    ),
    (
        ["rotorInertia", "motorInertia"],
        ["gearRatio", "mechanicalReduction", "gear_ratio"],
    ),
];
/// Parts of the types of transmissions whose motors turn several joints together.
const COUPLED: [&str; 3] = ["ifferential", "ourBar", "rist"];
pub(super) fn joint(element: &Element, reader: &mut Reader) -> Joint {
    let (name, _) = reader.required(element, "name");
    let [parent, child] = ["parent", "child"].map(|tag| match element.first(tag) {
        Some(end) => reader.required(end, "link"),
        None => {
            reader.report("joint_without_end", &element.at, &[&name, &tag]);
            (String::new(), element.at.clone())
        }
    });
    let around = reader.problems.enter(&element.at);
    reader.check("robot", element, &format!("joint `{name}`"));
    reader.required(element, "type");
    let word = reader.word(element, "type", &Kind::WORDS);
    let kind = word.unwrap_or_default();
    let axis = only(element, "axis", reader)
        .and_then(|axis| reader.numbers(axis, "xyz"))
        .unwrap_or_else(|| Number::constants(["1", "0", "0"], &element.at));
    let moves = !matches!(kind, Kind::Fixed | Kind::Floating);
    if moves && axis.iter().all(|x| x.value.is_zero()) {
        let help = "<axis xyz=\"0 0 1\"/>";
        reader.report("no_direction", &axis[0].at, &[&name, &help]);
    }
    let limit = only(element, "limit", reader);
    let mut of_limit = |key| limit.and_then(|limit| reader.number(limit, key));
    let [lower, upper, effort, velocity] =
        ["lower", "upper", "effort", "velocity"].map(&mut of_limit);
    // There is one limit for both directions.
    let bounds = ["acceleration", "drake:acceleration", "deceleration"].map(&mut of_limit);
    let acceleration = least(bounds);
    let has_range = lower.is_some() || upper.is_some();
    let ranged = limit.filter(|_| has_range && moves && kind != Kind::Continuous);
    let range = ranged.map(|limit| {
        [lower, upper].map(|end| end.unwrap_or_else(|| Number::constant("0", &limit.at)))
    });
    let position = reader.range(&name, range);
    let drive = drive(element, &name, reader);
    for (key, load) in [
        ("effort", &effort),
        ("velocity", &velocity),
        ("acceleration", &acceleration),
        ("damping", &drive.damping),
    ] {
        let help = "a limit bounds the size, and damping takes energy out: zero or more";
        reader.not_negative(load.as_ref(), &format!("`{key}` of joint `{name}`"), help);
    }
    let mimic = only(element, "mimic", reader).map(|mimic| {
        let mut number = |key, or: i64| match mimic.get(key) {
            None => Some(Rational::from_integer(or.into())),
            Some(_) => reader.number(mimic, key).map(|number| number.value),
        };
        let line = number("multiplier", 1).zip(number("offset", 0));
        Mimic {
            line: line.map(|(multiplier, offset)| [multiplier, offset]),
            leader: reader.required(mimic, "joint").0,
            at: mimic.at.clone(),
        }
    });
    let origin = origin(element, reader);
    reader.problems.leave(around);
    Joint {
        at: element.at.clone(),
        kind,
        origin,
        parent,
        child,
        axis,
        position: position.map(|range| range.map(|end| end.map(|value| kind.position(value)))),
        effort,
        velocity,
        acceleration,
        mimic,
        name,
        ..drive
    }
}

/// Reads damping, friction and armature, which files have under several names.
fn drive(element: &Element, name: &str, reader: &mut Reader) -> Joint {
    let of = format!("joint `{name}`");
    let older = only(element, "joint_properties", reader);
    let dynamics = match (only(element, "dynamics", reader), older) {
        (Some(dynamics), Some(older)) => {
            reader.report("beside_properties", &older.at, &[&of]);
            dynamics
        }
        (Some(dynamics), None) => dynamics,
        (None, Some(older)) => {
            reader.report("older_dynamics", &older.at, &[&of]);
            older
        }
        (None, None) => return Joint::default(),
    };
    // The first of two names counts, unless it says nothing.
    let mut load = |[first, second]: [&str; 2]| {
        let [first, other] = [first, second].map(|key| {
            let number = reader.number(dynamics, key);
            number.filter(|number| !number.value.is_zero())
        });
        if let (Some(_), Some(other)) = (&first, &other) {
            reader.report("beside_dynamics", &other.at, &[&of, &second]);
        }
        first.or(other)
    };
    let damping = load(["damping", "mu_viscous"]);
    let friction = load(["friction", "mu_coulomb"]);
    let armature = load(["armature", "rotor_inertia"]);
    let what = format!("the armature of {of}");
    reader.not_negative(armature.as_ref(), &what, "it adds inertia: zero or more");
    Joint {
        damping,
        friction,
        armature: or_zero(armature),
        ..Joint::default()
    }
}

/// Adds the rotors of a transmission, inertia times the square of the reduction, to the armature of
/// every joint that it drives.
pub(super) fn transmission(element: &Element, joints: &mut [Joint], reader: &mut Reader) {
    let of = element.named("transmission");
    reader.check("robot", element, &of);
    let is_actuator = |inside: &&Element| local(&inside.tag) == "actuator";
    let actuators: Vec<&Element> = element.inside.iter().filter(is_actuator).collect();
    let mut named: BTreeMap<&str, &Element> = BTreeMap::new();
    for joint in element.all("joint") {
        named.extend(joint.value("name").map(|name| (name, joint)));
    }
    let inside = element.first("type").and_then(Element::content);
    let kind = element.get("type").or(inside);
    let kind = kind.map_or("", |kind| &kind.value);
    for place in actuators.iter().copied().chain([element]) {
        let mut rotors = ROTORS.iter();
        let rotor = rotors.find_map(|(keys, ratios)| Some((number_named(place, keys)?, ratios)));
        let Some((inertia, ratios)) = rotor else {
            continue;
        };
        if COUPLED.iter().any(|word| kind.contains(word)) {
            reader.report("rotors_coupled", &inertia.at, &[&of, &kind]);
            continue;
        }
        if named.is_empty() {
            reader.report("rotor_without_joint", &inertia.at, &[&of]);
        }
        let Some(rotor) = reader.parse(inertia.value.trim(), &inertia.at) else {
            continue;
        };
        let what = format!("the rotor of {of}");
        reader.not_negative(Some(&rotor), &what, "it adds inertia: zero or more");
        for (name, driven) in &named {
            // Files that were written for several tools have several reductions: the rotor's is in
            // the spelling of its name, and may stand in the joint, or beside joint and actuator.
            let mut places = vec![place, driven, element];
            places.extend(actuators.iter().filter(|_| actuators.len() == 1));
            let ratio = places.iter().find_map(|place| number_named(place, ratios));
            let one = || Some(Number::constant("1", &inertia.at));
            let ratio = ratio.map_or_else(one, |ratio| reader.parse(ratio.value.trim(), &ratio.at));
            match (joints.iter_mut().find(|joint| joint.name == **name), ratio) {
                (Some(joint), Some(ratio)) => joint.add_rotor(rotor.clone(), ratio),
                (None, _) => reader.report("rotor_of_nothing", &driven.at, &[&of, name]),
                (Some(_), None) => {}
            }
        }
    }
}

/// Returns a name without its prefix, as files have `drake:gear_ratio`.
fn local(name: &str) -> &str {
    name.rsplit(':').next().unwrap_or(name)
}

/// Finds a number by its names: the `value` or the text of an element inside, or an attribute.
fn number_named<'e>(place: &'e Element, names: &[&str]) -> Option<&'e Attribute> {
    names.iter().find_map(|name| {
        let is_named = |inside: &&Element| local(&inside.tag) == *name;
        let inside = place.inside.iter().find(is_named);
        let prefixed = || place.get(&format!("drake:{name}"));
        let attribute = || place.get(name).or_else(prefixed);
        inside.and_then(Element::content).or_else(attribute)
    })
}
