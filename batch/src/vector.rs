//! Floats side by side, as a generated function computes with them.

use dalembert_sines::text::Floats;

/// The states that are computed before any other: first their sines, then all the rest, so that
/// neither takes registers from the other.
pub(crate) const BLOCK: usize = 64;

/// A vector of floats, one for each state.
pub trait Vector<T>: Floats<T> {
    /// Proof that the processor has these vectors.
    type Token: Copy;
    /// The number of states.
    const LANES: usize;

    /// Returns the vector that stands after so many others.
    fn load(token: Self::Token, from: &[T; BLOCK], after: usize) -> Self;

    /// Writes the vector after so many others.
    fn store(self, to: &mut [T; BLOCK], after: usize);

    /// Returns the roots.
    #[must_use]
    fn sqrt(self) -> Self;

    /// Returns the products plus the addends, rounded once.
    #[must_use]
    fn mul_add(self, factor: Self, addend: Self) -> Self;

    /// Returns a function's value for each.
    #[must_use]
    fn each(self, function: impl Fn(T) -> T) -> Self;

    /// Returns both values of a function for each.
    fn both(self, function: impl Fn(T) -> (T, T)) -> (Self, Self);

    /// Computes sines and cosines, and returns whether they are those of all angles: of far
    /// ones they are not.
    fn sincos<const K: usize>(angles: &[Self; K]) -> ([Self; K], [Self; K], bool);
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

/// Implements the methods of [`Vector`] that need only conversions from and to an array.
macro_rules! lanes {
    ($float:ident, $lanes:literal, |$vector:ident| $array:expr, |$own:ident| $shown:expr,
     |$token:ident, $from:ident| $made:expr) => {
        const LANES: usize = $lanes;

        #[inline(always)]
        fn load($token: Self::Token, from: &[$float; BLOCK], after: usize) -> Self {
            let ($from, _) = from.as_chunks::<$lanes>();
            let $from = $from.get(after).copied().unwrap_or_default();
            $made
        }

        #[inline(always)]
        fn store(self, to: &mut [$float; BLOCK], after: usize) {
            let $vector = self;
            let (places, _) = to.as_chunks_mut::<$lanes>();
            if let Some(place) = places.get_mut(after) {
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
        fn sincos<const K: usize>(angles: &[Self; K]) -> ([Self; K], [Self; K], bool) {
            by_pairs::<$float, Self, K>(angles)
        }
    };
}
pub(crate) use lanes;
