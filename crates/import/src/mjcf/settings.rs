//! Units, orders of angles, what is limited without saying so, and gravity.

use num_traits::{Signed, Zero};
use roxmltree::Node;

use super::Mjcf;
use crate::urdf::{Number, constant};

#[derive(Clone, Debug)]
pub(super) struct Settings {
    pub(super) degrees: bool,
    pub(super) euler: [Turn; 3],
    pub(super) auto_limits: bool,
    pub(super) from_geoms: FromGeoms,
    /// The lowest and the highest group of geoms that have mass.
    pub(super) groups: [i64; 2],
    /// The least mass and the least moment of inertia.
    pub(super) least: [Option<Number>; 2],
    pub(super) total: Option<Number>,
    gravity: Option<[Number; 3]>,
    has_gravity: bool,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Turn {
    pub(super) axis: usize,
    /// About an axis that stays, not one that turned with the angles before.
    pub(super) stays: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FromGeoms {
    None,
    /// Those without an `inertial`.
    Some,
    All,
}

impl Settings {
    pub(super) fn new() -> Self {
        let turn = |axis| Turn { axis, stays: false };
        Settings {
            degrees: true,
            euler: [turn(0), turn(1), turn(2)],
            auto_limits: true,
            from_geoms: FromGeoms::Some,
            groups: [0, 5],
            least: [None, None],
            total: None,
            gravity: None,
            has_gravity: true,
        }
    }

    /// Returns gravity in the axes of the world.
    pub(super) fn gravity(&self, root: Node) -> [Number; 3] {
        match &self.gravity {
            _ if !self.has_gravity => constant(root, ["0", "0", "0"]),
            Some(gravity) => gravity.clone(),
            None => constant(root, ["0", "0", "-9.81"]),
        }
    }
}

impl<'a> Mjcf<'a, '_, '_> {
    /// Reads the settings of the whole file: where there are several, the last one counts.
    pub(super) fn settings(&mut self, root: Node<'a, '_>) {
        for node in root.children().filter(Node::is_element) {
            match node.tag_name().name() {
                "compiler" => self.compiler(node),
                "option" => self.option(node),
                "include" => {
                    let help = "give import the file by its name: what it includes is read with it";
                    self.error(node, "<include> in a text without a place".to_owned(), help);
                }
                _ => {}
            }
        }
    }

    fn compiler(&mut self, node: Node<'a, '_>) {
        let word = |this: &mut Self, key: &str, known: &[&str]| {
            let word = node.attribute(key)?;
            let found = known.iter().position(|known| *known == word);
            if found.is_none() {
                let message = format!("`{key}` is `{word}`");
                this.error(node, message, &known.join(" or "));
            }
            found
        };
        if let Some(unit) = word(self, "angle", &["radian", "degree"]) {
            self.settings.degrees = unit == 1;
        }
        if let Some(limited) = word(self, "autolimits", &["false", "true"]) {
            self.settings.auto_limits = limited == 1;
        }
        let all = [FromGeoms::None, FromGeoms::All, FromGeoms::Some];
        if let Some(which) = word(self, "inertiafromgeom", &["false", "true", "auto"]) {
            self.settings.from_geoms = all[which];
        }
        if word(self, "coordinate", &["local", "global"]) == Some(1) {
            let help =
                "MuJoCo has no global coordinates since 2.3.4: save the model anew by an older one";
            self.error(node, "`coordinate` is `global`".to_owned(), help);
        }
        if let Some(order) = node.attribute("eulerseq") {
            self.order(node, order);
        }
        for (index, key) in ["boundmass", "boundinertia"].into_iter().enumerate() {
            let bound = self.problems.number(node, key);
            self.settings.least[index] = bound.filter(|bound| bound.value.is_positive());
        }
        let total = self.problems.number(node, "settotalmass");
        self.settings.total = total.filter(|total| total.value.is_positive());
        if let Some([low, high]) = node.attribute_node("inertiagrouprange").and_then(|own| {
            self.problems
                .list("inertiagrouprange", own.value(), own.range_value())
        }) {
            let whole = |number: &Number| i64::try_from(number.value.to_integer()).unwrap_or(0);
            self.settings.groups = [whole(&low), whole(&high)];
        }
    }

    fn order(&mut self, node: Node, order: &str) {
        let turn = |letter: char| {
            let axis = "xyz".find(letter.to_ascii_lowercase())?;
            let stays = letter.is_ascii_uppercase();
            Some(Turn { axis, stays })
        };
        let turns: Option<Vec<Turn>> = order.chars().map(turn).collect();
        match turns.and_then(|turns| <[Turn; 3]>::try_from(turns).ok()) {
            Some(turns) => self.settings.euler = turns,
            None => {
                let message = format!("`eulerseq` is `{order}`");
                let help =
                    "three letters of xyz, for axes that turn along, or XYZ, for axes that stay";
                self.error(node, message, help);
            }
        }
    }

    fn option(&mut self, node: Node<'a, '_>) {
        if node.has_attribute("gravity") {
            self.settings.gravity = self.problems.triple(node, "gravity");
        }
        let flags = node.children().filter(|child| child.has_tag_name("flag"));
        for flag in flags.filter_map(|flag| flag.attribute("gravity")) {
            self.settings.has_gravity = flag != "disable";
        }
        for key in ["density", "viscosity"] {
            let medium = self.problems.number(node, key);
            if medium.is_some_and(|medium| !medium.value.is_zero()) {
                let message = format!("the {key} of the medium is left out");
                self.difference(node, message, "the arm moves as in a vacuum");
            }
        }
    }
}
