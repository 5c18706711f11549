//! The largest magnitude of a polynomial over the box.
//!
//! Rates and errors enter monomial by monomial, each at its worst: with the middle μ and half the
//! length ρ of a monomial's range, and g its coefficient, a trigonometric polynomial in the
//! angles, |P| ≤ F = |Σ μ g| + Σ ρ |g|; but products of velocities, and what is linear in one, at
//! the worst corner of their box together (`corners`).
//!
//! That F ≤ B everywhere is shown angle by angle (`search`). At given other angles let F be
//! largest, M, at x in a cell of middle c and half width δ, and let d be the degree in this angle.
//! F is the maximum of finitely many trigonometric polynomials ±g ± …, and of the one that is M at
//! x:
//!
//! - if the angle goes all the way round, M. Riesz: its value at c is at least M·cos(d·δ), for
//!   d·δ ≤ π/2. So M ≤ B if F(c) ≤ B·cos(d·δ).
//! - either x is an end of the range, and ends are looked at; or its slope at x is 0, and M ≤
//!   F(c) + ½δ²·W, where W is at least the second derivative.
//!
//! F(c) is shown to be small by the same means over the other angles. Cells where that fails are
//! cut in three; a point where F is above B refutes it. Sums of sines and cosines of multiples
//! (`terms`) are bounded by Σ √(Σ c²), over the phases of each multiple; so is W, times the square
//! of the multiple: at first monomial by monomial, and where that does not do, at each corner of the
//! velocities. The same shows that a matrix is positive definite (`definite`).
//!
//! A climb (`climb`) finds what F reaches, and from where a bound was refuted it goes on.

mod climb;
mod corners;
mod definite;
mod search;
mod terms;

pub use self::corners::corners;
pub use self::definite::is_definite;
use self::search::{Search, Verdict};
use self::terms::Terms;
use crate::polynomial::Polynomial;
use crate::ring::Ring;
use crate::work::Work;

/// The multiplications for the wanted bound, and for each that is tighter: one purse a result, so
/// that no result depends on another.
const PURSE: u64 = 1_000_000_000;
const PURSE_TIGHTER: u64 = 40_000_000;
/// The starts of climbs to a bound, and before a wanted one is decided.
const STARTS: usize = 16;
const DECISION_STARTS: usize = 8;
/// Bounds relative to what is reached, where none is wanted, or the wanted one is refuted.
const LOOSE: [f64; 5] = [1.5, 2.0, 4.0, 16.0, 256.0];
/// Tighter ones, tried one after the other as long as they are shown.
const TIGHTER: [f64; 4] = [1.5, 1.2, 1.1, 1.05];
/// The times that a bound is tried from a state that refutes it.
const RETRIES: usize = 20;

/// Bounds the largest magnitude without looking at any angle, by lengths over phases.
pub fn length(polynomial: &Polynomial, ring: &Ring) -> f64 {
    Terms::new(polynomial, ring, 0.0).length()
}

/// The finding about a wanted bound of the largest magnitude.
#[derive(Clone, Debug, Default)]
pub struct Decision {
    /// `true` if the bound is shown.
    pub is_shown: bool,
    /// `true` if it is not refuted either: there were too few multiplications.
    pub is_open: bool,
    /// The size that is reached at these angles, one a joint: zero where none had to be looked at.
    pub reached: f64,
    /// The multiplications that it took.
    pub steps: u64,
    /// The angles, rad; empty where none was looked at.
    pub angles: Vec<f64>,
}

/// Decides whether the magnitude is at most `wanted`, by so many multiplications at most: if they do
/// not do, it is not shown.
pub fn decide(polynomial: &Polynomial, ring: &Ring, wanted: f64, purse: u64) -> Decision {
    let terms = Terms::new(polynomial, ring, wanted);
    let mut search = Search::new(&terms, ring);
    let plain = search.plain_bound();
    if search.is_constant() || !plain.is_finite() || plain <= wanted {
        return Decision {
            is_shown: plain <= wanted,
            ..Decision::default()
        };
    }
    search.steps = purse;
    let mut reached = search.climb(DECISION_STARTS);
    let [mut is_shown, mut is_open] = [false; 2];
    if reached <= wanted {
        match search.shows_all(wanted) {
            Verdict::Yes => is_shown = true,
            Verdict::Refuted => reached = search.climb_on(),
            Verdict::Unknown => is_open = true,
        }
    }
    let mut angles = vec![0.0; ring.angles.len()];
    for (level, angle) in search.levels.iter().zip(&search.top) {
        angles[level.joint] = *angle;
    }
    Decision {
        is_shown,
        is_open,
        steps: purse - search.steps,
        reached,
        angles,
    }
}

/// Bounds the largest magnitude: by at most `wanted` if that can be shown, and then as tightly as
/// small purses allow.
pub fn largest(polynomial: &Polynomial, ring: &Ring, wanted: f64, work: &Work) -> f64 {
    let terms = Terms::new(polynomial, ring, wanted);
    let mut search = Search::new(&terms, ring);
    let plain = search.plain_bound();
    if search.is_constant() || !plain.is_finite() || plain == 0.0 {
        return plain;
    }
    let purse = |search: &mut Search, most: u64| {
        search.steps = most.min(work.left());
        search.steps
    };
    let spent = |search: &Search, purse: u64| {
        // Where all is spent, the next purse is empty.
        let _ = work.spend((purse - search.steps) as usize, 1);
    };
    let budget = purse(&mut search, PURSE);
    let mut reached = search.climb(STARTS);
    spent(&search, budget);
    let mut bound = plain;
    // Shows B, or climbs on from where it is refuted.
    let shows = |search: &mut Search, reached: &mut f64, factor: f64, most: u64| {
        let budget = purse(search, most);
        let mut shown = false;
        for _ in 0..RETRIES {
            let goal = *reached * factor + 2.0 * search.slack;
            match search.shows_all(goal) {
                Verdict::Yes => shown = true,
                // Else it is above an inner B alone.
                Verdict::Refuted => {
                    let height = search.climb_on();
                    if height > *reached {
                        *reached = height;
                        continue;
                    }
                }
                Verdict::Unknown => {}
            }
            break;
        }
        spent(search, budget);
        shown.then_some(*reached * factor + 2.0 * search.slack)
    };
    if reached <= wanted && wanted < plain {
        let budget = purse(&mut search, PURSE);
        match search.shows_all(wanted.next_down()) {
            Verdict::Yes => bound = wanted,
            Verdict::Refuted => reached = reached.max(search.climb_on()),
            Verdict::Unknown => {}
        }
        spent(&search, budget);
    }
    if bound == plain && wanted < plain {
        let loose = LOOSE.into_iter();
        let mut limits =
            loose.filter_map(|factor| shows(&mut search, &mut reached, factor, PURSE / 4));
        bound = limits.next().map_or(plain, |limit| limit.min(plain));
    }
    for factor in TIGHTER {
        if reached * factor >= bound {
            continue;
        }
        match shows(&mut search, &mut reached, factor, PURSE_TIGHTER) {
            Some(limit) => bound = bound.min(limit),
            None => break,
        }
    }
    bound
}
