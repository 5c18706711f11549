//! Outputs at a frame, in chosen axes and components: `jacobian@camera:local:linear`.
//!
//! A text is an output's name, `@` and a frame's, or those of several in contact with `,` between,
//! then words with `:` before each: the [`Axes`], and the [`Rows`] if not all six are wanted. In generated code the signs are `_`,
//! `jacobian_camera_local_linear`. The frame is a part of the output's identity, so code that asks
//! for its name, its shape or its formula need not know that it has one.

use alloc::boxed::Box;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::cmp::Ordering;
use core::hash::{Hash, Hasher};

use super::bundle::{camel, check_name, kept, unknown_output};
use super::function::{Definition, NamedFunction};
use super::quantity::{Facts, FrameChoice};
use super::{Axis, Function, Quantity, Regrouped, Shape, Written};
use crate::diagnostic::Diagnostic;
use crate::equations::frames::{Axes, Rows, View};
use crate::robot::{HAND, suggested_name};
use crate::scalar::Divide;

const AT: char = '@';
const OF: char = ':';
const MAX_FRAMES: usize = 8;

/// A quantity at a frame, kept for as long as the process runs, as a [`NamedFunction`] function is.
#[derive(Clone, Copy, Debug)]
pub struct QuantityAt(&'static FrameOutput);

#[derive(Debug)]
struct FrameOutput {
    quantity: Quantity,
    view: View,
    facts: Facts,
}

impl QuantityAt {
    fn key(self) -> (Quantity, View) {
        (self.0.quantity, self.0.view)
    }

    /// Returns the quantity of the hand.
    pub fn quantity(self) -> Quantity {
        self.0.quantity
    }

    /// Returns the frame, and what is asked of it.
    pub fn view(self) -> View {
        self.0.view
    }

    /// Returns the frame and what is asked of it as words: `camera:local:linear`.
    pub fn words(self) -> String {
        words(self.0.view)
    }

    pub(super) fn facts(self) -> &'static Facts {
        &self.0.facts
    }

    /// Empty if the robot has no such frame, which generation refuses before.
    pub(super) fn of_frame<S: Divide>(
        self,
        at: &Written<'_, S>,
        compute: impl Fn(Quantity, &Written<'_, S>) -> Vec<S>,
    ) -> Vec<S> {
        let arm = at.arm.seen(&self.0.view);
        arm.map_or_else(Vec::new, |arm| {
            compute(self.0.quantity, &Written { arm: &arm, ..*at })
        })
    }

    pub(super) fn regrouped<S: Divide>(self, at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let textbook = at.textbook.as_ref()?;
        let arm = textbook.arm.seen(&self.0.view)?;
        let mut at_view = at.clone();
        at_view.textbook = Some(Written {
            arm: &arm,
            ..*textbook
        });
        self.0.quantity.regrouped(&at_view)
    }
}

impl PartialEq for QuantityAt {
    fn eq(&self, other: &Self) -> bool {
        self.key() == other.key()
    }
}

impl Eq for QuantityAt {}

impl Hash for QuantityAt {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.key().hash(state);
    }
}

impl PartialOrd for QuantityAt {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for QuantityAt {
    fn cmp(&self, other: &Self) -> Ordering {
        self.key().cmp(&other.key())
    }
}

impl Function {
    fn at(self, frame: &str, axes: Axes, rows: Rows) -> Result<Function, Diagnostic> {
        let function = self;
        let choice = |quantity: &Quantity| quantity.facts().frame;
        let most = function.quantities().iter().map(choice).min();
        let frames: Vec<&str> = frame.split(',').map(str::trim).collect();
        let frame = frames.join(",");
        let asked = match (axes, rows) {
            (Axes::Mixed, Rows::ALL) if frames.len() > 1 => FrameChoice::Frames,
            (Axes::Mixed, Rows::ALL) => FrameChoice::Frame,
            (_, Rows::ALL) => FrameChoice::Axes,
            _ => FrameChoice::Rows,
        };
        let suffix = |sign| suffix(axes, rows, sign);
        let most = most.unwrap_or(FrameChoice::None);
        if most == FrameChoice::None {
            let message = format!("`{function}` is of no frame");
            return Err(Diagnostic::error(message).with_help("leave `@` and what follows out"));
        }
        if asked == FrameChoice::Frames && most != FrameChoice::Frames {
            let message = format!("`{function}` is of one frame");
            return Err(Diagnostic::error(message).with_help("`contact_jacobians` takes several"));
        }
        if most < asked || most == FrameChoice::Frames && asked > FrameChoice::Frames {
            let message = format!("`{function}` has no choice of `{}`", suffix(OF));
            return Err(Diagnostic::error(message).with_help("it takes a frame alone"));
        }
        for (place, frame) in frames.iter().enumerate() {
            let name = format!("{function}_{frame}{}", suffix('_'));
            check_name(&name).map_err(|_| {
                let frame: String = frame.chars().take(64).collect();
                let other = suggested_name(&frame).filter(|name| *name != frame);
                let suggested = other.as_deref().unwrap_or("camera_2");
                let help = format!(
                    "small letters, digits and single `_` between them, such as `{suggested}`"
                );
                Diagnostic::error(format!("`{frame}` cannot name a frame")).with_help(help)
            })?;
            if frames[..place].contains(frame) {
                let message = format!("the frame `{frame}` is there twice");
                return Err(Diagnostic::error(message).with_help("leave one of them out"));
            }
        }
        if frames.len() > MAX_FRAMES {
            let message = format!("{} frames in contact", frames.len());
            return Err(Diagnostic::error(message).with_help(format!("at most {MAX_FRAMES}")));
        }
        let name = format!("{function}_{}{}", frame.replace(',', "_"), suffix('_'));
        let text = format!("{function}{AT}{frame}{}", suffix(OF));
        Ok(Function::At(NamedFunction::once(text, || {
            let frame = kept(frame.to_string());
            let view = View { frame, axes, rows };
            let quantities = function.quantities().iter();
            let results: Vec<Quantity> = quantities.map(|quantity| seen(*quantity, view)).collect();
            let of = function.definition();
            let structure = of.structure.map(|_| kept(camel(&name)));
            Definition {
                name: kept(name),
                summary: kept(format!("{} {}", of.summary, described(view))),
                results: Box::leak(results.into_boxed_slice()),
                structure,
                by_default: false,
                parts: &[],
            }
        })))
    }

    pub(super) fn parse_at(text: &str) -> Result<Function, Diagnostic> {
        let (name, rest) = text.split_once(AT).unwrap_or((text, ""));
        let name = name.trim();
        let function = Function::from_name(name).ok_or_else(|| unknown_output(name))?;
        let mut words = rest.split(OF).map(str::trim);
        let frame = words.next().unwrap_or_default();
        let (mut axes, mut rows) = (None, None);
        for word in words {
            let mut choices = Axes::WORDS.into_iter();
            let named = choices.find(|(candidate, _)| *candidate == word);
            let is_taken = match (named, Rows::of(word)) {
                (Some((_, choice)), _) => axes.replace(choice).is_some(),
                (None, Some(choice)) => rows.replace(choice).is_some(),
                (None, None) => true,
            };
            if is_taken {
                let word: String = word.chars().take(64).collect();
                let message = format!("`{word}` is no choice of axes or components");
                let help = "`mixed`, `local` or `world`; `linear`, `angular`, or some of \
                            x, y, z, rx, ry and rz, such as `x_y_rz`";
                return Err(Diagnostic::error(message).with_help(help));
            }
        }
        function.at(frame, axes.unwrap_or_default(), rows.unwrap_or(Rows::ALL))
    }

    /// Returns the outputs of a list parted at its commas, which part frames in contact, too.
    ///
    /// ```
    /// use dalembert_model::outputs::Function;
    ///
    /// let items = Function::with_frames(["gravity", "contact_bias@left", "right"]);
    /// assert_eq!(items, ["gravity", "contact_bias@left,right"]);
    /// ```
    pub fn with_frames<'i>(items: impl IntoIterator<Item = &'i str>) -> Vec<String> {
        let mut outputs: Vec<String> = Vec::new();
        for item in items {
            let word = item.split('+').next().unwrap_or_default().trim();
            let is_word = Function::from_name(word).is_none() && !word.contains([AT, OF, '=']);
            let last = outputs.last_mut().filter(|_| is_word);
            let longer = last.and_then(|last| {
                let part = last.rsplit(['=', '+']).next()?;
                let has_frame = Function::parse_at(&format!("{part},{word}")).is_ok();
                has_frame.then_some(last)
            });
            match longer {
                Some(last) => *last += &format!(",{item}"),
                None => outputs.push(String::from(item)),
            }
        }
        outputs
    }

    pub(super) fn is_at(text: &str) -> bool {
        text.contains([AT, OF])
    }

    pub(super) fn text_at(self) -> Option<String> {
        let Some(Quantity::At(at)) = self.quantities().first() else {
            return None;
        };
        let function = at.quantity().function();
        Some(format!("{function}{AT}{}", at.words()))
    }

    /// Returns true if a result of it is of the robot's hand.
    pub fn is_of_hand(self) -> bool {
        self.quantities().iter().any(|quantity| match quantity {
            Quantity::At(at) => at.view().frames().any(|frame| frame == HAND),
            quantity => quantity.facts().frame != FrameChoice::None,
        })
    }

    /// Returns the frames that it is at, each once.
    pub fn frames(self) -> Vec<&'static str> {
        let mut frames: Vec<&'static str> = Vec::new();
        for quantity in self.quantities() {
            if let Quantity::At(at) = quantity {
                let others = at.view().frames().filter(|frame| !frames.contains(frame));
                frames.extend(others.collect::<Vec<_>>());
            }
        }
        frames
    }
}

fn words(view: View) -> String {
    format!("{}{}", view.frame, suffix(view.axes, view.rows, OF))
}

fn suffix(axes: Axes, rows: Rows, sign: char) -> String {
    let axes: Option<String> = (axes != Axes::Mixed).then(|| axes.word().to_string());
    let rows = (rows != Rows::ALL).then(|| rows.word());
    let words = axes.into_iter().chain(rows);
    words.map(|word| format!("{sign}{word}")).collect()
}

fn described(view: View) -> String {
    let axes = match view.axes {
        Axes::Mixed => "",
        Axes::Local => ", in its own axes",
        Axes::World => ", in base axes at the base's origin",
    };
    let rows = match view.rows {
        Rows::ALL => String::new(),
        rows => {
            let names: Vec<&str> = rows.indices().map(|row| Rows::NAMES[row]).collect();
            format!(", components {}", names.join(", "))
        }
    };
    let frames = view.frames().map(|frame| format!("`{frame}`"));
    let several = view.frames().count() > 1;
    let word = if several { "frames" } else { "frame" };
    let frames = frames.collect::<Vec<String>>().join(", ");
    format!("At {word} {frames}{axes}{rows}.")
}

fn seen(quantity: Quantity, view: View) -> Quantity {
    let of = quantity.facts();
    let at = words(view);
    let name = suffix(view.axes, view.rows, '_');
    let components = |axis: &Axis| match axis {
        Axis::Fixed(6) if of.frame >= FrameChoice::Rows => Axis::Fixed(view.rows.count()),
        Axis::Fixed(3) if of.frame == FrameChoice::Frames => Axis::Fixed(3 * view.frames().count()),
        other => *other,
    };
    let axes: Vec<Axis> = of.shape.0.iter().map(components).collect();
    let frames = view.frame.replace(',', "_");
    let facts = Facts {
        field: kept(format!("{}_{frames}{name}", of.field)),
        symbol: kept(format!("{} at {at}", of.symbol())),
        summary: kept(format!("{} {}", of.summary, described(view))),
        shape: Shape(Box::leak(axes.into_boxed_slice())),
        given: of.given.map(|key| kept(format!("{key}{AT}{at}"))),
        ..*of
    };
    Quantity::At(QuantityAt(Box::leak(Box::new(FrameOutput {
        quantity,
        view,
        facts,
    }))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_a_name_and_reads_back() {
        for (text, name) in [
            ("jacobian@camera", "jacobian_camera"),
            ("forward_kinematics@tool0", "forward_kinematics_tool0"),
            ("jacobian@hand:local", "jacobian_hand_local"),
            (
                "jacobian_rate@tip:world:x_rz",
                "jacobian_rate_tip_world_x_rz",
            ),
        ] {
            let function = Function::parse(text).unwrap();
            assert_eq!(function.text(), text);
            assert_eq!(function.name(), name);
            assert_eq!(Function::parse(text), Ok(function));
        }
        let spaced = Function::parse(" jacobian @ camera : angular : local ").unwrap();
        assert_eq!(spaced.text(), "jacobian@camera:local:angular");
        assert_eq!(spaced.quantities()[0].shape().0[0], Axis::Fixed(3));
        assert_eq!(
            Function::parse("jacobian@a:mixed:x_y_z_rx_ry_rz").map(Function::text),
            Ok("jacobian@a".to_string())
        );
        let bundle = Function::parse("see=jacobian@camera+jacobian@hand+gravity").unwrap();
        assert_eq!(bundle.text(), "see=jacobian@camera+jacobian@hand+gravity");
        assert_eq!(bundle.frames(), ["camera", "hand"]);
        let fields: Vec<&str> = bundle.quantities().iter().map(|q| q.field()).collect();
        assert_eq!(fields, ["jacobian_camera", "jacobian_hand", "c"]);
    }
}
