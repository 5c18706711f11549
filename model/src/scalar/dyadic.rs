//! Numbers that are made of zero and one alone, by sums, products and halves:
//! what a scalar knows without context. Every scalar has them.

/// units / 2^halvings, exactly.
#[derive(Clone, Copy, Debug)]
pub struct Dyadic {
    units: i64,
    halvings: u32,
}

impl Dyadic {
    /// 0
    pub const ZERO: Dyadic = Dyadic {
        units: 0,
        halvings: 0,
    };
    /// 1
    pub const ONE: Dyadic = Dyadic {
        units: 1,
        halvings: 0,
    };

    /// Returns the integer that is halved.
    pub fn units(self) -> i64 {
        self.units
    }

    /// Returns the number of halvings.
    pub fn halvings(self) -> u32 {
        self.halvings
    }

    /// Returns whether it is zero.
    pub fn is_zero(self) -> bool {
        self.units == 0
    }

    /// Returns whether it is one.
    pub fn is_one(self) -> bool {
        self.units == 1 && self.halvings == 0
    }

    /// Returns a + b; like everything here none beyond its range.
    pub fn checked_add(self, other: Dyadic) -> Option<Dyadic> {
        let halvings = self.halvings.max(other.halvings);
        let scaled = |x: Dyadic| {
            let factor = 1i64.checked_shl(halvings - x.halvings)?;
            x.units.checked_mul(factor)
        };
        let units = scaled(self)?.checked_add(scaled(other)?)?;
        Some(Dyadic { units, halvings })
    }

    /// Returns a b
    pub fn checked_mul(self, other: Dyadic) -> Option<Dyadic> {
        let halvings = self.halvings + other.halvings;
        let units = self.units.checked_mul(other.units)?;
        (halvings < 63).then_some(Dyadic { units, halvings })
    }

    /// Returns −a
    pub fn checked_neg(self) -> Option<Dyadic> {
        let units = self.units.checked_neg()?;
        Some(Dyadic { units, ..self })
    }

    /// Returns a/2
    pub fn half(self) -> Option<Dyadic> {
        let halvings = match self.units {
            0 => 0,
            _ => self.halvings + 1,
        };
        (halvings < 63).then_some(Dyadic { halvings, ..self })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(x: Option<Dyadic>) -> Option<f64> {
        x.map(|x| x.units as f64 / 2f64.powi(x.halvings as i32))
    }

    #[test]
    fn is_exact_or_nothing() {
        let one = Dyadic::ONE;
        let quarter = one.half().unwrap().half().unwrap();
        let five = one.checked_add(
            one.checked_add(one)
                .unwrap()
                .checked_mul(one.checked_add(one).unwrap())
                .unwrap(),
        );
        let five = five.unwrap();
        assert_eq!(of(five.checked_add(quarter)), Some(5.25));
        assert_eq!(
            of(quarter.checked_mul(quarter.checked_neg().unwrap())),
            Some(-0.0625)
        );
        assert!(
            one.checked_add(one.checked_neg().unwrap())
                .unwrap()
                .is_zero()
        );
        let most = |x: Dyadic, of: fn(Dyadic) -> Option<Dyadic>| {
            core::iter::successors(Some(x), |x| of(*x)).count()
        };
        // 2⁶² is the last power of two, and 2⁻⁶² the last half.
        assert_eq!(most(one, |x| x.checked_add(x)), 63);
        assert_eq!(most(one, Dyadic::half), 63);
    }
}
