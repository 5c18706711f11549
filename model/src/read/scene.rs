//! The `[scene.NAME]` tables.

use alloc::collections::BTreeMap;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::ops::Range;

use toml_span::Value;

use super::outputs;
use super::places::Places;
use super::report::quote;
use super::suggest;
use super::table::Keys;
use super::value::{Context, first_line};
use crate::number::Rational;
use crate::outputs::Function;
use crate::robot::{Field, Follower, Inertia, Joint, JointKind, Place, Position, Robot};
use crate::scene::{Float, MotionBox, Part, Payload, Scale, Scene, Tolerance};

const KEYS: [&str; 10] = [
    "outputs",
    "joints",
    "lock",
    "gravity",
    "velocity",
    "acceleration",
    "payload",
    "box",
    "tolerance",
    "scalar",
];

/// The reader of one scene's tables.
struct Reader<'r, 's, 'k> {
    cx: &'r mut Context<'s, 'k>,
    robot: &'r Robot,
    spans: BTreeMap<Part, Range<usize>>,
    /// True if something could not be read: what seems to be missing then
    /// may be that.
    incomplete: bool,
}

/// Reads all scenes of a file.
pub(super) fn read(cx: &mut Context, robot: &Robot, places: &Places, scenes: &Value) -> Vec<Scene> {
    let Some(table) = cx.table(scenes, "each scene is a [scene.NAME] table") else {
        return Vec::new();
    };
    let mut entries: Vec<_> = table.iter().collect();
    entries.sort_by_key(|(key, _)| key.span.start);
    let mut read = Vec::new();
    for (key, value) in entries {
        let head = key.span.start..key.span.end.max(key.span.start);
        let Some(table) = cx.table(value, "each scene is a [scene.NAME] table") else {
            continue;
        };
        let keys = Keys {
            table,
            span: head.clone(),
            what: format!("scene {}", quote(&key.name)),
        };
        let mut reader = Reader {
            cx: &mut *cx,
            robot,
            spans: BTreeMap::from([(Part::Name, head.clone())]),
            incomplete: false,
        };
        let scene = reader.scene(&key.name, &keys);
        for finding in scene.validate(robot) {
            if reader.incomplete && is_of_absence(finding.part) {
                continue;
            }
            let span = match finding.part {
                Part::Limit(joint, field) => {
                    let place = Place::Joint(joint, field);
                    if !places.was_read(place) {
                        continue;
                    }
                    places.span(place)
                }
                part => reader.spans.get(&part).cloned(),
            };
            let span = span.unwrap_or_else(|| head.clone());
            let sink = &mut reader.cx.sink;
            sink.found(finding.warning, span, finding.message, &finding.help);
        }
        read.push(scene);
    }
    read
}

/// Returns the joint of a number, from one, or of a name.
pub(super) fn find_joint(joints: &[Joint], text: &str) -> Option<usize> {
    match text.parse::<i64>() {
        Ok(number) => usize::try_from(number)
            .ok()
            .and_then(|number| number.checked_sub(1))
            .filter(|joint| *joint < joints.len()),
        Err(_) => {
            let mut names = joints.iter().map(|joint| joint.name.as_deref());
            names.position(|name| name == Some(text))
        }
    }
}

/// Returns the likely fix of a text that is no joint.
pub(super) fn for_joint(joints: &[Joint], text: &str) -> String {
    let n = joints.len();
    let names: Vec<&str> = joints.iter().filter_map(|j| j.name.as_deref()).collect();
    match (text.parse::<i64>(), suggest::closest(text, &names)) {
        (Err(_), Some(meant)) => format!("did you mean `{meant}`?"),
        (Err(_), None) if names.is_empty() => {
            format!("the joints have no names: count them from 1 to {n}")
        }
        _ if names.is_empty() => format!("joints are counted from 1 to {n}"),
        _ => format!("joints are counted from 1 to {n}: {}", names.join(", ")),
    }
}

/// Returns whether a finding here may come from what could not be read.
fn is_of_absence(part: Part) -> bool {
    matches!(
        part,
        Part::Joint(usize::MAX)
            | Part::Tolerance(usize::MAX)
            | Part::Box(_, usize::MAX)
            | Part::Lock(usize::MAX)
    )
}

impl Reader<'_, '_, '_> {
    fn scene(&mut self, name: &str, keys: &Keys) -> Scene {
        keys.reject_unknown(&KEYS, self.cx.sink);
        Scene {
            name: name.to_string(),
            outputs: self.outputs(keys),
            joints: self.joints(keys),
            lock: self.lock(keys),
            gravity: self.gravity(keys),
            velocity_zero: self.zero(keys, "velocity"),
            acceleration_zero: self.zero(keys, "acceleration"),
            payload: self.payload(keys),
            bounds: self.bounds(keys).unwrap_or_default(),
            tolerance: self.tolerance(keys),
            scalar: keys
                .get("scalar")
                .and_then(|value| self.cx.word(value, &Float::WORDS)),
        }
    }

    /// Returns what was read, noting if it could not be.
    fn noted<T>(&mut self, read: Option<T>) -> Option<T> {
        self.incomplete |= read.is_none();
        read
    }

    fn mark(&mut self, part: Part, value: &Value) {
        let span = first_line(self.cx.source, Context::span(value));
        self.spans.insert(part, span);
    }

    /// Reads the items of a list; `None` after saying that it is none.
    fn list<'v, 'de>(&mut self, value: &'v Value<'de>, help: &str) -> Option<&'v [Value<'de>]> {
        let items = value.as_array().map(Vec::as_slice);
        if items.is_none() {
            self.cx.wanted(value, "a list", help);
        }
        self.noted(items)
    }

    fn inner<'v, 'de>(
        &mut self,
        keys: &Keys<'v, 'de>,
        key: &str,
        known: &[&str],
        help: &str,
    ) -> Option<Keys<'v, 'de>> {
        let value = keys.get(key)?;
        let table = self.cx.table(value, help);
        let inner = Keys {
            table: self.noted(table)?,
            span: first_line(self.cx.source, Context::span(value)),
            what: format!("`{key}`"),
        };
        inner.reject_unknown(known, self.cx.sink);
        Some(inner)
    }

    fn outputs(&mut self, keys: &Keys) -> Vec<Function> {
        let Some(value) = keys.get("outputs") else {
            return Vec::new();
        };
        self.mark(Part::Outputs, value);
        let read = outputs::read(self.cx, value, "a scene");
        self.incomplete |= read.is_none();
        read.unwrap_or_default()
    }

    fn joints(&mut self, keys: &Keys) -> Option<Vec<usize>> {
        const HELP: &str = "joints = [1, 2, \"elbow\"]: numbers from 1, or names";
        let value = keys.get("joints")?;
        self.mark(Part::Joint(usize::MAX), value);
        let items = self.list(value, HELP)?;
        let mut joints = Vec::new();
        for item in items {
            let text = match item.as_str() {
                Some(name) => Some(name.to_string()),
                None => item.as_integer().map(|number| number.to_string()),
            };
            let Some(text) = text else {
                self.cx.wanted(item, "a joint", HELP);
                self.incomplete = true;
                continue;
            };
            let span = Context::span(item);
            if let Some(joint) = self.joint(&text, span) {
                self.mark(Part::Joint(joints.len()), item);
                joints.push(joint);
            }
        }
        Some(joints)
    }

    /// Reads a joint by its number, from one, or its name.
    fn joint(&mut self, text: &str, span: Range<usize>) -> Option<usize> {
        let found = find_joint(&self.robot.joints, text);
        let name = |follower: &&Follower| follower.joint.name.as_deref() == Some(text);
        let follower = self.robot.followers.iter().find(name);
        let (message, help) = match follower {
            Some(follower) => (
                format!("joint {} follows another", quote(text)),
                format!(
                    "name {}, by which it moves",
                    self.robot.joint_label(follower.leader)
                ),
            ),
            None => (
                format!("there is no joint {}", quote(text)),
                for_joint(&self.robot.joints, text),
            ),
        };
        if found.is_none() {
            self.cx.sink.error(span, message, &help);
        }
        self.noted(found)
    }

    fn lock(&mut self, keys: &Keys) -> Vec<(usize, Position)> {
        let Some(value) = keys.get("lock") else {
            return Vec::new();
        };
        self.mark(Part::Lock(usize::MAX), value);
        let help = self.lock_of(value.as_str());
        let table = self.cx.table(value, &help);
        let Some(table) = self.noted(table) else {
            return Vec::new();
        };
        let mut entries: Vec<_> = table.iter().collect();
        entries.sort_by_key(|(key, _)| key.span.start);
        let mut locks = Vec::new();
        for (key, value) in entries {
            let span = key.span.start..key.span.end.max(key.span.start);
            let Some(joint) = self.joint(&key.name, span.clone()) else {
                continue;
            };
            let read = self.position(joint, value);
            if let Some(position) = self.noted(read) {
                let end = Context::span(value).end;
                let whole = first_line(self.cx.source, span.start..end);
                self.spans.insert(Part::Lock(locks.len()), whole);
                locks.push((joint, position));
            }
        }
        locks
    }

    /// Returns how a lock is written: of the joint with this name or number, if there
    /// is one.
    fn lock_of(&self, word: Option<&str>) -> String {
        let joints = self.robot.joints.iter().enumerate();
        let names = joints.map(|(i, joint)| (format!("{}", i + 1), joint.name.as_deref()));
        let names: Vec<(String, Option<&str>)> = names.collect();
        let is_meant = |(number, name): &&(String, Option<&str>)| {
            word.is_some() && (*name == word || Some(number.as_str()) == word)
        };
        let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
        let key = |(number, name): &(String, Option<&str>)| match name {
            Some(name) if name.chars().all(plain) => (*name).to_string(),
            _ => number.clone(),
        };
        let meant = names.iter().find(is_meant).or(names.last());
        let joint = meant.map_or_else(|| "1".to_string(), key);
        format!("lock = {{ {joint} = 0 }}: each joint, by its name or number, with its position")
    }

    /// Reads an angle or a length, as the joint has it.
    fn position(&mut self, joint: usize, value: &Value) -> Option<Position> {
        match self.robot.joints.get(joint).map(|joint| joint.kind) {
            Some(JointKind::Prismatic) => self.cx.length(value).map(Position::Length),
            _ => self.cx.angle(value).map(Position::Angle),
        }
    }

    fn gravity(&mut self, keys: &Keys) -> Option<[Rational; 3]> {
        const HELP: &str = "gravity = [0, 0, -9.81], or [0, 0, 0] for none";
        let value = keys.get("gravity")?;
        self.cx.array(value, HELP, Context::number)
    }

    fn zero(&mut self, keys: &Keys, key: &str) -> bool {
        let value = keys.get(key);
        let help = format!(
            "{key} = \"zero\" for an arm without any; a range goes into the box: box = {{ {key} = [1, …] }}"
        );
        let read = value.and_then(|value| self.cx.word_or(value, &[("zero", ())], &help));
        self.incomplete |= value.is_some() && read.is_none();
        read.is_some()
    }

    fn payload(&mut self, keys: &Keys) -> Option<Payload> {
        const HELP: &str = "payload = { mass = 2.5, com = [0, 0, 0.05], inertia = [0.01, 0.01, 0.01, 0, 0, 0] }, in the last link's frame";
        const COM: &str = "com = [x, y, z], in the frame of the last link, m";
        let inner = self.inner(keys, "payload", &["mass", "com", "inertia"], HELP)?;
        let mass = inner.require("mass", HELP, self.cx.sink);
        let com = inner.require("com", COM, self.cx.sink);
        if let Some(mass) = mass {
            self.mark(Part::Payload(Field::Mass), mass);
        }
        let mass = mass.and_then(|value| self.cx.number(value));
        let com = com.and_then(|value| self.cx.array(value, COM, Context::number));
        let inertia = match inner.get("inertia") {
            Some(value) => {
                self.mark(Part::Payload(Field::Inertia), value);
                self.cx.inertia(value)
            }
            // A point mass.
            None => Some(Inertia::default()),
        };
        Some(Payload {
            mass: mass?,
            com: com?,
            inertia: inertia?,
        })
    }

    fn bounds(&mut self, keys: &Keys) -> Option<MotionBox> {
        const HELP: &str =
            "box = { position = [[-3.1, 3.1], …], velocity = [2, …], acceleration = [10, …] }";
        let known = ["position", "velocity", "acceleration"];
        let inner = self.inner(keys, "box", &known, HELP)?;
        Some(MotionBox {
            position: self.each(&inner, Field::Position, |reader, joint, item| {
                let help = "[lowest, highest]";
                reader.cx.array::<_, 2>(item, help, |cx, end| {
                    match reader.robot.joints.get(joint) {
                        Some(j) if j.kind == JointKind::Prismatic => {
                            cx.length(end).map(Position::Length)
                        }
                        _ => cx.angle(end).map(Position::Angle),
                    }
                })
            }),
            velocity: self.each(&inner, Field::Velocity, |reader, joint, item| {
                reader.rate(joint, item, "velocity")
            }),
            acceleration: self.each(&inner, Field::Acceleration, |reader, joint, item| {
                reader.rate(joint, item, "acceleration")
            }),
        })
    }

    /// Reads an entry of the box's velocities or accelerations.
    fn rate(&mut self, joint: usize, item: &Value, what: &str) -> Option<Rational> {
        match self.robot.joints.get(joint).map(|joint| joint.kind) {
            Some(JointKind::Prismatic) => self.cx.number(item),
            _ => self.cx.rate(item, what),
        }
    }

    /// Reads a list of the box: an entry a joint.
    fn each<T>(
        &mut self,
        keys: &Keys,
        field: Field,
        mut item: impl FnMut(&mut Self, usize, &Value) -> Option<T>,
    ) -> Option<Vec<T>> {
        let value = keys.get(field.key())?;
        self.mark(Part::Box(field, usize::MAX), value);
        let items = self.list(value, "one entry a joint")?;
        let mut read = Vec::new();
        for (joint, value) in items.iter().enumerate() {
            self.mark(Part::Box(field, joint), value);
            let one = item(self, joint, value);
            read.push(self.noted(one));
        }
        read.into_iter().collect()
    }

    fn tolerance(&mut self, keys: &Keys) -> Option<Tolerance> {
        const HELP: &str = "tolerance = { value = 1e-3, relative_to = \"actuator\" }";
        const SCALE: &str = "relative_to = \"actuator\" (torque limits) or \"range\" (the largest torque that was found of the model)";
        let inner = self.inner(keys, "tolerance", &["value", "relative_to"], HELP)?;
        let value = inner.require("value", HELP, self.cx.sink);
        let scale = inner.require("relative_to", SCALE, self.cx.sink);
        let scale = scale.and_then(|value| self.cx.word(value, &Scale::WORDS));
        self.spans
            .insert(Part::Tolerance(usize::MAX), inner.span.clone());
        let value = value?;
        let values = match value.as_array() {
            Some(items) => {
                let mut read = Vec::new();
                for (index, item) in items.iter().enumerate() {
                    self.mark(Part::Tolerance(index), item);
                    read.push(self.cx.part(item));
                }
                read.into_iter().collect::<Option<Vec<_>>>()
            }
            None => {
                self.mark(Part::Tolerance(0), value);
                self.cx.part(value).map(|one| [one].into())
            }
        };
        Some(Tolerance {
            value: values?,
            relative_to: scale?,
        })
    }
}
