//! Where sines and cosines are computed: in a function of one state, or in a
//! loop over the lanes of one of several.

use crate::program::{AngleSum, LoweredTrig};

/// How lines of a scope begin and what they call a value.
#[derive(Clone, Copy)]
pub(crate) struct Scope {
    /// Before every line.
    pub(super) indent: &'static str,
    /// How a value gets its name: a lane's is an entry of an array that is there.
    pub(super) binding: &'static str,
    /// After the name of every argument, sine and cosine.
    pub(super) lane: &'static str,
}

impl Scope {
    /// In a function of one state.
    pub(crate) const STATE: Scope = Scope {
        indent: "    ",
        binding: "let ",
        lane: "",
    };

    /// In a loop over lanes.
    pub(super) const LANE: Scope = Scope {
        indent: "        ",
        binding: "",
        lane: "[l]",
    };

    /// Returns how the scope names the angle that sines are taken of, whose sum stands
    /// in a line of its own.
    pub(super) fn angle(self, angle: AngleSum) -> String {
        match (angle.additions(), angle.terms().next()) {
            (0, Some((joint, _))) => format!("q[{joint}]{}", self.lane),
            _ => format!("a{angle}"),
        }
    }

    /// Returns a sum of angles, term by term.
    pub(crate) fn sum(self, angle: AngleSum) -> String {
        let mut sum = String::new();
        for (index, (joint, negative)) in angle.terms().enumerate() {
            sum += match (index, negative) {
                (0, false) => "",
                (0, true) => "-",
                (_, false) => " + ",
                (_, true) => " - ",
            };
            sum += &format!("q[{joint}]{}", self.lane);
        }
        sum
    }

    /// Returns what a line gives values to: the sine, the cosine or both.
    pub(super) fn pair(self, trig: &LoweredTrig) -> String {
        let (angle, lane) = (trig.angle, self.lane);
        match (trig.sin, trig.cos) {
            (true, false) => format!("s{angle}{lane}"),
            (false, true) => format!("c{angle}{lane}"),
            _ => format!("(s{angle}{lane}, c{angle}{lane})"),
        }
    }
}
