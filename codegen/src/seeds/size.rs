//! The sizes of the moments of links. A regrouping that makes an entry vanish by a number that is
//! almost zero, such as the sine between axes that are almost parallel, adds large moments to one
//! link and takes them from another: exact, and lost to rounding.

use dalembert_model::equations::chain::{Chain, Skeleton};
use dalembert_model::number::{Exact, Rounded};

/// A moment may be so many times as large as those of what a link carries.
const MOST: f64 = 1024.0;

/// The moments that a link carries, with its own, as far as a tolerance has left them there.
#[derive(Clone, Copy, Debug, Default)]
struct LinkMoments {
    /// The sum of masses, kg.
    mass: f64,
    /// The sum of the first moments of links about their origins, kg·m.
    first: f64,
    /// The sum of their second moments about them, kg·m².
    second: f64,
    /// The largest distance from the link's origin to that of another, m.
    reach: f64,
}

impl LinkMoments {
    /// The sizes of mass, first and second moments about the link's origin.
    fn sizes(&self) -> [f64; 3] {
        let levers = self.mass * self.reach;
        let second = self.second + (2.0 * self.first + levers) * self.reach;
        // (Σ m r)² is at most Σ m times Σ m r².
        let first = (self.first + levers).max((self.mass * second).sqrt());
        let mass = match second > 0.0 {
            true => self.mass.max(first * first / second),
            false => self.mass,
        };
        [mass, first, second]
    }
}

/// The sizes of what each link carries.
#[derive(Clone, Debug)]
pub(super) struct Sizes(Vec<[f64; 3]>);

impl Sizes {
    pub(super) fn of(arm: &Skeleton<Exact>) -> Sizes {
        let length = |x: &[f64; 3]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
        let mut moments = vec![LinkMoments::default(); arm.links.len()];
        for (i, segment) in arm.links.iter().enumerate().rev() {
            let body = segment.link.body.map(f64::nearest);
            moments[i].mass += body.mass.abs();
            moments[i].first += length(&body.first);
            moments[i].second += (body.second.xx + body.second.yy + body.second.zz).abs();
            let carried = moments[i];
            if let Some(carrier) = segment.link.parent {
                let offset = segment.link.offset.each_ref().map(f64::nearest);
                let away = length(&offset) + f64::nearest(&segment.d).abs();
                let carrier = &mut moments[carrier];
                carrier.mass += carried.mass;
                carrier.first += carried.first;
                carrier.second += carried.second;
                carrier.reach = carrier.reach.max(away + carried.reach);
            }
        }
        Sizes(moments.iter().map(LinkMoments::sizes).collect())
    }

    /// Returns false if a link of a chain in metres has larger moments.
    pub(super) fn admits(&self, chain: &Chain<Exact>) -> bool {
        let mut links = chain.links.iter().zip(&self.0);
        links.all(|(link, [mass, first, second])| {
            let body = link.body.map(|x| f64::nearest(x).abs());
            let is_small = |size: &f64, moment: &f64| *moment <= MOST * size;
            is_small(mass, &body.mass)
                && body.first.iter().all(|moment| is_small(first, moment))
                && (body.second.entries().iter()).all(|moment| is_small(second, moment))
        })
    }
}

#[cfg(test)]
mod tests {
    use dalembert_model::equations::chain::{HandChoice, MetricChain, Regrouping};
    use dalembert_model::number::Rational;
    use dalembert_model::read::parse;

    use super::*;
    use crate::seeds::chain::skeleton;
    use crate::seeds::{Form, tune};
    use crate::setup::Setup;

    fn two(alpha: &str) -> Skeleton<Exact> {
        let joint = |alpha: &str, mass: i32| {
            format!(
                "[[joint]]\nkind = \"revolute\"\nd = 0.1\na = 0.5\nalpha = {alpha}\nmass = {mass}\n\
                 com = [-0.2, 0.1, 0.03]\ninertia = [0.1, 0.1, 0.1, 0.01, 0.02, 0.03]\n"
            )
        };
        let head = "name = \"two\"\nconvention = \"standard\"\ngravity = [0, 0, -9.81]\n";
        let text = [head, &joint(alpha, 3), &joint("0", 2)].concat();
        skeleton(&Setup::whole(&parse(&text).unwrap().robot))
    }

    #[test]
    fn a_mass_far_beyond_those_that_are_carried_is_refused() {
        let arm = two("\"pi/2\"");
        let sizes = Sizes::of(&arm);
        let mut regrouping = Regrouping::base(&arm);
        let mut is_admitted = |mass: i64| {
            regrouping.links[1].mass = Rational::from_integer(mass.into()).into();
            sizes.admits(&MetricChain::new(&arm, &regrouping).chain)
        };
        assert!([-2000, 0, 2, 2000].into_iter().all(&mut is_admitted));
        assert!(![-2100, 2100, 1_000_000].into_iter().any(is_admitted));
    }

    /// The second moment that makes Σxz of the first link vanish is 500 000 times as large as Σxz.
    #[test]
    fn axes_that_are_almost_parallel_do_not_tempt() {
        let arm = two("\"2*atan(1/500000)\"");
        // The larger the second moments are, the cheaper.
        let price = |chain: &Chain<Exact>, _: Form, _: u64| {
            let size = |x: &Exact| f64::nearest(x).abs();
            let links = chain.links.iter();
            let total: f64 = links.map(|link| size(&link.body.second.zz)).sum();
            1_000_000 - total.min(900_000.0) as u64
        };
        let forms = Form::all(false, false, false, HandChoice::None);
        let choice = tune::tune(&arm, Regrouping::base(&arm), &forms, 3, price);
        let chain = MetricChain::new(&arm, &choice.regrouping).chain;
        assert!(Sizes::of(&arm).admits(&chain));
    }
}
