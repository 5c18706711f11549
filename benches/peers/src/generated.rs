//! The generated functions.

use std::hint::black_box;

use crate::{Ready, timed};

include!(concat!(env!("OUT_DIR"), "/puma560.rs"));
include!(concat!(env!("OUT_DIR"), "/stanford.rs"));
include!(concat!(env!("OUT_DIR"), "/ur10.rs"));
include!(concat!(env!("OUT_DIR"), "/panda.rs"));
include!(concat!(env!("OUT_DIR"), "/puma560_fma.rs"));
include!(concat!(env!("OUT_DIR"), "/stanford_fma.rs"));
include!(concat!(env!("OUT_DIR"), "/ur10_fma.rs"));
include!(concat!(env!("OUT_DIR"), "/panda_fma.rs"));

fn joints<const N: usize>(x: &[f64]) -> [f64; N] {
    std::array::from_fn(|i| x[i])
}

fn with<const N: usize, R>(
    function: fn(&[f64; N], &[f64; N], &[f64; N]) -> R,
    flat: fn(&R, &mut Vec<f64>),
) -> Ready
where
    R: 'static,
{
    Ready {
        compute: Box::new(move |q, qd, x, out| {
            flat(&function(&joints(q), &joints(qd), &joints(x)), out);
        }),
        batch: Box::new(move |states| {
            let states: Vec<[[f64; N]; 3]> = states
                .iter()
                .map(|s| [joints(s), joints(&s[N..]), joints(&s[2 * N..])])
                .collect();
            timed(&states, |[q, qd, x]| {
                black_box(function(q, qd, x));
            })
        }),
    }
}

fn rows<const N: usize>(matrix: &[[f64; N]; N], out: &mut Vec<f64>) {
    out.extend(matrix.as_flattened());
}

macro_rules! robot {
    ($robot:ident, $function:expr) => {
        match $function {
            "inverse_dynamics" => Some(with($robot::inverse_dynamics, |tau, out| out.extend(tau))),
            "forward_dynamics" => Some(with($robot::forward_dynamics, |qdd, out| out.extend(qdd))),
            "inverse_dynamics_derivatives" => {
                Some(with($robot::inverse_dynamics_derivatives, |slopes, out| {
                    rows(&slopes.dtau_dq, out);
                    rows(&slopes.dtau_dqd, out);
                    rows(&slopes.d, out);
                }))
            }
            "forward_dynamics_derivatives" => {
                Some(with($robot::forward_dynamics_derivatives, |slopes, out| {
                    rows(&slopes.dqdd_dq, out);
                    rows(&slopes.dqdd_dqd, out);
                    rows(&slopes.dqdd_dtau, out);
                }))
            }
            _ => None,
        }
    };
}

pub fn ready(robot: &str, function: &str, fma: bool) -> Option<Ready> {
    match (robot, fma) {
        ("puma560", false) => robot!(puma560, function),
        ("puma560", true) => robot!(puma560_fma, function),
        ("stanford", false) => robot!(stanford, function),
        ("stanford", true) => robot!(stanford_fma, function),
        ("ur10", false) => robot!(ur10, function),
        ("ur10", true) => robot!(ur10_fma, function),
        ("panda", false) => robot!(panda, function),
        ("panda", true) => robot!(panda_fma, function),
        _ => None,
    }
}
