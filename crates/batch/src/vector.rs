//! Floats side by side, as a generated function computes with them.

use dalembert_sines::text::{Floats, Products};

/// The states of a pass: first their sines, then the rest, so that neither takes registers.
pub(crate) const BLOCK: usize = 64;

/// A vector of floats, one for each state.
pub trait Vector<T>: Floats<T> {
    /// Proof that the processor has these vectors.
    type Token: Copy;
    /// The number of states.
    const LANES: usize;

    /// Returns the vector that stands after so many others.
    fn load(token: Self::Token, from: &[T; BLOCK], after: usize) -> Self;

    /// Writes the vector from an entry on.
    fn store(self, to: &mut [T], from: usize);

    /// Returns the square roots, correctly rounded.
    #[must_use]
    fn sqrt(self) -> Self;

    /// Returns the products plus the addends, rounded once.
    #[inline(always)]
    #[must_use]
    fn mul_add(self, factor: Self, addend: Self) -> Self {
        self.fused(factor, addend)
    }

    /// Returns a function's value for each.
    #[must_use]
    fn each(self, function: impl Fn(T) -> T) -> Self;

    /// Returns both values of a function for each.
    fn both(self, function: impl Fn(T) -> (T, T)) -> (Self, Self);

    /// Computes sines and cosines; the flag is true if they hold for all angles, none being far.
    fn sincos<P: Products<T>, const K: usize>(angles: &[Self; K]) -> ([Self; K], [Self; K], bool);
}

/// Returns the roots, as generated code calls them.
#[doc(hidden)]
#[inline(always)]
pub fn sqrt<V: Vector<f64>>(vector: V) -> V {
    vector.sqrt()
}

/// Returns the roots, as generated code calls them.
#[doc(hidden)]
#[inline(always)]
pub fn sqrtf<V: Vector<f32>>(vector: V) -> V {
    vector.sqrt()
}

macro_rules! lanes {
    ($float:ident, $lanes:literal; |$vector:ident| $array:expr; |$own:ident| $shown:expr;
     |$token:ident, $from:ident| $made:expr) => {
        const LANES: usize = $lanes;

        #[inline(always)]
        fn load($token: Self::Token, from: &[$float; BLOCK], after: usize) -> Self {
            let ($from, _) = from.as_chunks::<$lanes>();
            let $from = $from.get(after).copied().unwrap_or_default();
            $made
        }

        #[inline(always)]
        fn store(self, to: &mut [$float], from: usize) {
            let $vector = self;
            if let Some(rest) = to.get_mut(from..)
                && let Some(place) = rest.first_chunk_mut::<$lanes>()
            {
                *place = $array;
            }
        }

        #[inline(always)]
        fn each(self, function: impl Fn($float) -> $float) -> Self {
            self.both(|x| (function(x), x)).0
        }

        #[inline(always)]
        fn both(self, function: impl Fn($float) -> ($float, $float)) -> (Self, Self) {
            let $vector = self;
            let array: [$float; $lanes] = $array;
            let (mut first, mut second) = (array, array);
            let mut lane = 0;
            while lane < $lanes {
                (first[lane], second[lane]) = function(array[lane]);
                lane += 1;
            }
            let $own = $vector;
            let $token = $shown;
            let make = |$from: [$float; $lanes]| $made;
            (make(first), make(second))
        }

        #[inline(always)]
        fn sincos<P: Products<$float>, const K: usize>(
            angles: &[Self; K],
        ) -> ([Self; K], [Self; K], bool) {
            text::together::<$float, P, Self, K>(angles)
        }
    };
}
pub(crate) use lanes;
