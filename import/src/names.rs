//! The names of links and joints that the file and the options speak of.

use std::collections::BTreeSet;

use crate::Options;
use crate::lock::OTHERS;
use crate::problems::{Problems, instead};
use crate::urdf::Urdf;

/// Reports every name of a link or a joint that the file does not have.
pub(crate) fn check(urdf: &Urdf, options: &Options, problems: &mut Problems) {
    let [links, joints] = &urdf.names;
    let meant =
        |name: &str, names: &BTreeSet<String>| instead(name, names.iter().map(String::as_str));
    for (name, span) in urdf
        .joints
        .iter()
        .flat_map(|joint| [&joint.parent, &joint.child])
    {
        if !links.contains(name) {
            problems.error(
                span,
                format!("there is no link `{name}`"),
                &meant(name, links),
            );
        }
    }
    let ends = [("--base", &options.base), ("--tip", &options.tip)];
    let ends = ends
        .into_iter()
        .filter_map(|(option, name)| Some((option, name.as_ref()?)));
    let without = options.without.iter().map(|name| ("--without", name));
    for (option, name) in ends.chain(without) {
        if links.contains(name) {
            continue;
        }
        let message = format!("{option}: there is no link `{name}`");
        let help = match urdf.joints.iter().find(|joint| joint.name == *name) {
            Some(joint) => format!("`{name}` is a joint; its link is `{}`", joint.child.0),
            None => meant(name, links),
        };
        problems.error(&urdf.span, message, &help);
    }
    for (name, _) in &options.lock {
        if name == OTHERS || joints.contains(name) || urdf.joint(name).is_some() {
            continue;
        }
        let message = format!("--lock: there is no joint `{name}`");
        let help = match (name.parse::<usize>(), urdf.moving().len()) {
            (Ok(_), count @ 1..) => {
                format!("those that move are 1 to {count}, from the root outwards")
            }
            _ => meant(name, joints),
        };
        problems.error(&urdf.span, message, &help);
    }
}
