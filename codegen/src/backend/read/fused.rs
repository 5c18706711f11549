//! The lines with a product that a sum takes.

use super::error::{Kind, TextFault};

/// What `(-t3).mul_add(s2, t1)` says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Words<'a> {
    /// The factors.
    pub(super) left: &'a str,
    pub(super) right: &'a str,
    /// Whether their product is subtracted.
    pub(super) negative: bool,
    /// What it is added to.
    pub(super) addend: &'a str,
    /// Whether that is subtracted.
    pub(super) minus: bool,
}

/// The words of a value; `None` if it is none of a fused product.
pub(super) fn words(value: &str) -> Option<Result<Words<'_>, TextFault>> {
    let (factor, rest) = value.split_once(".mul_add(")?;
    let (left, negative) = match factor.strip_prefix("(-") {
        Some(inside) => (inside.strip_suffix(')').unwrap_or(factor), true),
        None => (factor, false),
    };
    let operands = rest.strip_suffix(')').and_then(|all| all.split_once(", "));
    let words = operands.map(|(right, addend)| {
        let positive = addend.strip_prefix('-');
        Words {
            left,
            right,
            negative,
            addend: positive.unwrap_or(addend),
            minus: positive.is_some(),
        }
    });
    // No program subtracts both: its result would be negated instead.
    let words = words.filter(|words| !(words.negative && words.minus));
    Some(words.ok_or_else(|| Kind::Fused.not(value).into()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_words_of_a_fused_product() {
        let read = |value| words(value).map(|words| words.map_err(|fault| fault.to_string()));
        let plain = Words {
            left: "t3",
            right: "s2p3",
            negative: false,
            addend: "t1",
            minus: false,
        };
        let negative = Words {
            negative: true,
            ..plain
        };
        let minus = Words {
            minus: true,
            ..plain
        };
        assert_eq!(read("t3.mul_add(s2p3, t1)"), Some(Ok(plain)));
        assert_eq!(read("(-t3).mul_add(s2p3, t1)"), Some(Ok(negative)));
        assert_eq!(read("t3.mul_add(s2p3, -t1)"), Some(Ok(minus)));
        assert_eq!(read("libm::sin(q[0])"), None);
        for bad in [
            "(-t3).mul_add(s2p3, -t1)",
            "t3.mul_add(s2p3)",
            "t3.mul_add(s2p3, t1) + t2",
        ] {
            let message = format!("`{bad}` is not one fused multiply-add");
            assert_eq!(read(bad), Some(Err(message)));
        }
    }
}
