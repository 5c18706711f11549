//! The choice: the fewest operations whose proved error is small enough.

use std::collections::BTreeMap;

use super::forms::{Centre, Form};
use super::proof::{Errors, prove};
use super::series::MinimaxFit;
use crate::program::ScalarType;
use crate::program::kernel::{Kernel, SinCosUse};
use crate::sincos::interval::Interval;
use crate::sincos::reduction;

#[derive(Clone, Debug, PartialEq)]
pub struct KernelChoice {
    pub form: Form,
    pub kernel: Kernel,
    pub errors: Errors,
}

const MAX_HALVINGS: u32 = 3;

/// Higher degrees are below the resolution of f64.
const MAX_DEGREE: usize = 27;

const MAX_UNREDUCED: f64 = 16.0;

/// The factor by which a form may turn out better than its estimate: sums
/// of bounds are larger than bounds of sums.
const HOPE: f64 = 0.2;

/// Forms to try, from cheap to dear.
#[derive(Clone, Debug)]
pub struct Candidates {
    need: SinCosUse,
    scalar: ScalarType,
    range: Interval,
    fits: Vec<MinimaxFit>,
    /// Operations, estimated error, form, and which fit it takes.
    forms: Vec<(usize, f64, Form, usize)>,
}

impl Candidates {
    pub fn new(need: SinCosUse, scalar: ScalarType, range: Interval) -> Candidates {
        let mut candidates = Candidates {
            need,
            scalar,
            range,
            fits: Vec::new(),
            forms: Vec::new(),
        };
        if range.magnitude() <= MAX_UNREDUCED {
            let (middle, radius) = (range.mid(), range.radius());
            let quarters = libm::round(middle / std::f64::consts::FRAC_PI_2) as i32;
            let mut about = vec![quarters, 0];
            about.dedup();
            for k in about {
                let off = (middle - f64::from(k) * std::f64::consts::FRAC_PI_2).abs();
                candidates.add(false, Centre::Quarter(k), radius + off);
            }
            let near = scalar.nearest(middle);
            if near != 0.0 && radius < 2.0 {
                candidates.add(false, Centre::At(near), radius + (near - middle).abs());
            }
        }
        if let Some(rest) = reduction::rest(reduction::constants(scalar), scalar, range)
            && range.magnitude() > rest.range.high()
        {
            candidates.add(true, Centre::Quarter(0), rest.range.high());
        }
        let forms = &mut candidates.forms;
        forms.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        candidates
    }

    /// Keeps only the best of the forms with the same number of operations.
    fn add(&mut self, reduced: bool, centre: Centre, radius: f64) {
        let (most, offset, step, start) = match centre {
            Centre::Quarter(_) => (MAX_HALVINGS, 0.0, 2, [1, 0]),
            Centre::At(x) => (0, x, 1, [1, 1]),
        };
        for halvings in 0..=most {
            let Some(fit) = MinimaxFit::new(offset, radius, halvings as i32) else {
                continue;
            };
            let mut best: BTreeMap<usize, (f64, Form)> = BTreeMap::new();
            for sin in (start[0]..=MAX_DEGREE).step_by(step) {
                for cos in (start[1]..=MAX_DEGREE).step_by(step) {
                    if sin.abs_diff(cos) > 3 {
                        continue;
                    }
                    let form = Form {
                        reduced,
                        centre,
                        halvings,
                        degrees: [sin, cos],
                    };
                    let cost = form.kernel(None, self.need, self.scalar).operations();
                    let estimate = form.estimate(&fit, self.need);
                    let entry = best.entry(cost).or_insert((estimate, form));
                    if estimate < entry.0 {
                        *entry = (estimate, form);
                    }
                }
            }
            let index = self.fits.len();
            self.fits.push(fit);
            for (cost, (estimate, form)) in best {
                self.forms.push((cost, estimate, form, index));
            }
        }
    }

    /// Returns each kernel that is more accurate than all cheaper ones, from cheap to dear, until
    /// one errs no more than `enough`. Those that are thought to err more than `most` are left out.
    pub fn front(&self, most: f64, enough: f64) -> Vec<KernelChoice> {
        // Far below what rounding costs, degrees bring nothing.
        let floor = self.scalar.unit_roundoff() / 16.0;
        let mut front: Vec<KernelChoice> = Vec::new();
        let mut least = f64::INFINITY;
        for &(cost, estimate, form, fit) in &self.forms {
            let idle = estimate < floor && least < 8.0 * floor;
            if estimate * HOPE > most || estimate * HOPE >= least || idle {
                continue;
            }
            let is_cheaper = |c: &KernelChoice| c.kernel.operations() < cost;
            if least <= enough && front.last().is_some_and(is_cheaper) {
                break;
            }
            let kernel = form.kernel(Some(&self.fits[fit]), self.need, self.scalar);
            let Some(errors) = prove(&kernel, self.scalar, self.range, least) else {
                continue;
            };
            if errors.worst() < least {
                least = errors.worst();
                let same = |c: &KernelChoice| c.kernel.operations() == kernel.operations();
                if front.last().is_some_and(same) {
                    front.pop();
                }
                front.push(KernelChoice {
                    form,
                    kernel,
                    errors,
                });
            }
        }
        front
    }

    /// Returns the cheapest kernel that errs no more than `enough`, else the most accurate one.
    pub fn cheapest(&self, enough: f64) -> Option<KernelChoice> {
        let fit = |choice: &KernelChoice| choice.errors.worst() <= enough;
        let choice = self.front(enough, enough).pop().filter(fit);
        choice.or_else(|| self.front(f64::INFINITY, 0.0).pop())
    }
}
