//! Settings of the whole file: where there are several, the last one counts.

use dalembert_model::number::Rational;
use num_traits::Zero;

use crate::bounds::Bounds;
use crate::model::Number;
use crate::read::Reader;
use crate::xml::Element;

pub(crate) struct Settings {
    pub(super) degrees: bool,
    pub(super) euler: [Turn; 3],
    pub(super) auto_limits: bool,
    pub(super) from_geoms: FromGeoms,
    /// The lowest and the highest group of geoms that have mass.
    pub(super) groups: [Rational; 2],
    pub(super) bounds: Bounds,
    off: Vec<&'static str>,
    gravity: Option<[Number; 3]>,
}

#[derive(Clone, Copy)]
pub(super) struct Turn {
    pub(super) axis: usize,
    /// About an axis that stays, not one that turned with the angles before.
    pub(super) stays: bool,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum FromGeoms {
    None,
    /// Those without an `inertial`.
    Some,
    All,
}

const FROM_GEOMS: [(&str, FromGeoms); 3] = [
    ("false", FromGeoms::None),
    ("true", FromGeoms::All),
    ("auto", FromGeoms::Some),
];
/// Each flag, with one that stands for it and others.
const FLAGS: [[&str; 2]; 7] = [
    ["constraint", "constraint"],
    ["damper", "passive"],
    ["equality", "constraint"],
    ["frictionloss", "constraint"],
    ["gravity", "gravity"],
    ["passive", "passive"],
    ["spring", "passive"],
];

impl Settings {
    pub(super) fn read(root: &Element, reader: &mut Reader) -> Settings {
        let turn = |axis| Turn { axis, stays: false };
        let mut settings = Settings {
            degrees: true,
            euler: [turn(0), turn(1), turn(2)],
            auto_limits: true,
            from_geoms: FromGeoms::Some,
            groups: [0, 5].map(|group| Rational::from_integer(group.into())),
            bounds: Bounds::default(),
            off: Vec::new(),
            gravity: None,
        };
        root.all("compiler")
            .for_each(|element| settings.compiler(element, reader));
        root.all("option")
            .for_each(|element| settings.option(element, reader));
        settings
    }

    /// Returns the settings of a `<mujoco>` element in a URDF: bounds of masses, and gravity.
    pub(crate) fn of_urdf(root: &Element, reader: &mut Reader) -> (Bounds, Option<[Number; 3]>) {
        let settings = Settings::read(root, reader);
        for flag in settings.off.iter().filter(|flag| **flag != "gravity") {
            reader.report("flag_off", &root.at, &[flag]);
        }
        if settings.from_geoms == FromGeoms::All {
            reader.report("compiler inertiafromgeom", &root.at, &[]);
        }
        let is_said = settings.gravity.is_some() || settings.is_off("gravity");
        let gravity = is_said.then(|| settings.gravity(root));
        (settings.bounds, gravity)
    }

    pub(super) fn is_off(&self, flag: &str) -> bool {
        let flags = FLAGS.iter().find(|[name, _]| *name == flag);
        flags.is_some_and(|flags| flags.iter().any(|flag| self.off.contains(flag)))
    }

    /// Returns gravity in the axes of the world.
    pub(super) fn gravity(&self, root: &Element) -> [Number; 3] {
        let z = if self.is_off("gravity") { "0" } else { "-9.81" };
        let gravity = self.gravity.clone().filter(|_| z != "0");
        gravity.unwrap_or_else(|| Number::constants(["0", "0", z], &root.at))
    }

    fn compiler(&mut self, element: &Element, reader: &mut Reader) {
        let mut is = |key, words: [&str; 2], before| {
            let choice = reader.word(element, key, &[(words[0], false), (words[1], true)]);
            choice.unwrap_or(before)
        };
        self.degrees = is("angle", ["radian", "degree"], self.degrees);
        self.auto_limits = is("autolimits", ["false", "true"], self.auto_limits);
        if is("coordinate", ["local", "global"], false) {
            reader.report("global", &element.at, &[]);
        }
        let from_geoms = reader.word(element, "inertiafromgeom", &FROM_GEOMS);
        self.from_geoms = from_geoms.unwrap_or(self.from_geoms);
        if let Some(order) = element.get("eulerseq") {
            let turns = order.value.chars().map(|letter| {
                let axis = "xyz".find(letter.to_ascii_lowercase())?;
                let stays = letter.is_ascii_uppercase();
                Some(Turn { axis, stays })
            });
            let turns: Option<Vec<Turn>> = turns.collect();
            match turns.and_then(|turns| turns.try_into().ok()) {
                Some(turns) => self.euler = turns,
                None => reader.report("eulerseq", &order.at, &[&order.value]),
            }
        }
        self.bounds.read(element, reader);
        if let Some(range) = reader.numbers::<2>(element, "inertiagrouprange") {
            self.groups = range.map(|end| end.value);
        }
    }

    fn option(&mut self, element: &Element, reader: &mut Reader) {
        self.gravity = reader.numbers(element, "gravity").or(self.gravity.take());
        for flags in element.all("flag") {
            for [flag, _] in FLAGS {
                let words = [("disable", true), ("enable", false)];
                if let Some(is_off) = reader.word(flags, flag, &words) {
                    self.off.retain(|off| *off != flag);
                    self.off.extend(is_off.then_some(flag));
                }
            }
        }
        for key in ["density", "viscosity"] {
            let medium = reader.number(element, key);
            if let Some(medium) = medium.filter(|medium| !medium.value.is_zero()) {
                reader.report("medium", &medium.at, &[&key]);
            }
        }
    }
}
