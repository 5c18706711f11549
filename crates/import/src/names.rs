//! The names of links and joints that the file and the options speak of.

use crate::Options;
use crate::lock::OTHERS;
use crate::problems::{Problems, instead};
use crate::urdf::Urdf;

pub(crate) fn check(urdf: &Urdf, options: &Options, problems: &mut Problems) {
    let [links, joints] = &urdf.names;
    let ends = urdf.joints.iter();
    for (name, span) in ends.flat_map(|joint| [&joint.parent, &joint.child]) {
        if !links.contains(name) {
            let message = format!("there is no link `{name}`");
            problems.error(span, message, &instead(name, links));
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
            None => instead(name, links),
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
            _ => instead(name, joints),
        };
        problems.error(&urdf.span, message, &help);
    }
}
