//! The cheapest regrouping of a chain: coordinate descent.
//!
//! Each candidate is traced and merged by fingerprint, about a millisecond. The candidates for a
//! link come from what its parameters and its parent's would become: nothing kept, everything kept,
//! or just as much as makes an entry vanish that would cost operations.

use dalembert_model::equations::chain::{
    Chain, ChainLink, LinkRegrouping, MetricChain, MomentBody, Regrouping, Skeleton,
};
use dalembert_model::equations::matrix::{Vector, zero_vector};
use dalembert_model::number::Exact;
use dalembert_model::robot::JointKind;
use dalembert_model::scalar::Scalar;

use super::Form;
use super::size::Sizes;
use crate::dag::signed;

/// Regrouping through many different odd angles would multiply the monomials of constants.
const MAX_TERMS: usize = 100;

/// A price takes time in proportion to the links, and so does the number of prices.
const MAX_TUNED: usize = 64;

#[derive(Clone, Debug)]
pub struct ChainChoice {
    pub regrouping: Regrouping<Exact>,
    pub form: Form,
    pub price: u64,
}

/// Returns where a descent starts: base parameters; where regrouping through odd
/// angles would make the constants too large, a link keeps what it has.
pub fn start(arm: &Skeleton<Exact>) -> Regrouping<Exact> {
    let mut regrouping = Regrouping::base(arm);
    for (i, segment) in arm.links.iter().enumerate().rev() {
        let carrier = segment.link.parent;
        if carrier.is_none() && arm.base.is_none() {
            continue;
        }
        let (part, links) = carried_by(arm, carrier);
        let choice = Regrouping {
            links: (links.iter().map(|&link| regrouping.links[link].clone())).collect(),
            ..regrouping.clone()
        };
        let chain = Chain::new(&part, &choice);
        let arrived = carrier.map_or_else(|| base_terms(&chain), |_| terms(&chain.links[0]));
        if arrived > MAX_TERMS {
            let place = links.partition_point(|&link| link < i);
            let [mass, first, second] = chain.links[place].free.clone();
            let link = &mut regrouping.links[i];
            (link.mass, link.first, link.second) = (mass, first, second);
            link.keep_seconds = true;
        }
    }
    regrouping
}

/// Returns a link (or the base that floats) with all that it carries, and the places of these links:
/// what lies before does not matter, and must not be reached by constants that may be too large.
fn carried_by(arm: &Skeleton<Exact>, root: Option<usize>) -> (Skeleton<Exact>, Vec<usize>) {
    let mut part = Skeleton {
        gravity: arm.gravity.clone(),
        base: arm.base.clone().filter(|_| root.is_none()),
        base_probes: Vec::new(),
        columns: arm.columns,
        links: Vec::new(),
    };
    let mut places: Vec<usize> = Vec::new();
    for (i, segment) in arm.links.iter().enumerate() {
        let parent = (segment.link.parent).and_then(|carrier| places.binary_search(&carrier).ok());
        if root.is_none() || root == Some(i) || parent.is_some() {
            let mut segment = segment.clone();
            segment.link.parent = parent;
            part.links.push(segment);
            places.push(i);
        }
    }
    (part, places)
}

/// `price` must not depend on anything else; above its last argument it need not be exact.
pub(crate) fn tune(
    arm: &Skeleton<Exact>,
    from: Regrouping<Exact>,
    forms: &[Form],
    rounds: usize,
    price: impl Fn(&Chain<Exact>, Form, u64) -> u64,
) -> ChainChoice {
    let mut descent = RegroupingDescent {
        arm,
        sizes: Sizes::of(arm),
        price,
        metric: MetricChain::new(arm, &from),
        best: ChainChoice {
            regrouping: from,
            form: forms[0],
            price: u64::MAX,
        },
    };
    descent.forms(forms);
    for _ in 0..rounds {
        let before = descent.best.price;
        descent.units();
        if arm.links.len() <= MAX_TUNED {
            for i in (0..arm.links.len()).rev() {
                descent.link(i);
            }
        }
        descent.forms(forms);
        if descent.best.price >= before {
            break;
        }
    }
    descent.best
}

struct RegroupingDescent<'a, P> {
    arm: &'a Skeleton<Exact>,
    sizes: Sizes,
    price: P,
    best: ChainChoice,
    /// The chain in the best regrouping.
    metric: MetricChain<Exact>,
}

impl<P: Fn(&Chain<Exact>, Form, u64) -> u64> RegroupingDescent<'_, P> {
    fn attempt(&mut self, regrouping: Regrouping<Exact>, metric: MetricChain<Exact>) {
        let chain = metric.in_unit(&regrouping);
        if is_large(&chain) || !self.sizes.admits(&metric.chain) {
            return;
        }
        let price = (self.price)(&chain, self.best.form, self.best.price);
        if price < self.best.price {
            self.best.price = price;
            self.best.regrouping = regrouping;
            self.metric = metric;
        }
    }

    /// First the forms that see the hand as the best does, then those that differ in that alone.
    fn forms(&mut self, forms: &[Form]) {
        let chain = self.metric.in_unit(&self.best.regrouping);
        let mut among = |is_tried: &dyn Fn(Form, Form) -> bool| {
            let best = self.best.form;
            for &form in forms.iter().filter(|form| is_tried(**form, best)) {
                let price = (self.price)(&chain, form, self.best.price);
                if price < self.best.price {
                    self.best.price = price;
                    self.best.form = form;
                }
            }
        };
        among(&|form, best| form.hand == best.hand);
        among(&|form, best| {
            let hand = form.hand;
            form != best && form == Form { hand, ..best }
        });
    }

    /// Metres, and every length of the chain.
    fn units(&mut self) {
        let metric = self.metric.clone();
        let mut units = vec![Exact::one()];
        for length in metric.chain.links.iter().flat_map(|link| &link.offset) {
            let length = signed(length, length.leads_negative());
            if !length.is_zero() && !units.contains(&length) {
                units.push(length);
            }
        }
        for unit in units {
            if let Some(per_unit) = quotient(&Exact::one(), &unit) {
                let mut regrouping = self.best.regrouping.clone();
                (regrouping.unit, regrouping.per_unit) = (unit, per_unit);
                self.attempt(regrouping, metric.clone());
            }
        }
    }

    fn link(&mut self, i: usize) {
        let now = &self.best.regrouping.links[i];
        for link in alternatives(self.arm, &self.metric.chain, now, i) {
            let mut regrouping = self.best.regrouping.clone();
            // The best may have changed since.
            regrouping.links[i] = link;
            let metric = self.metric.changed(self.arm, &regrouping, i);
            self.attempt(regrouping, metric);
        }
    }
}

type Link = LinkRegrouping<Exact>;

/// `chain` is in metres.
fn alternatives(arm: &Skeleton<Exact>, chain: &Chain<Exact>, now: &Link, i: usize) -> Vec<Link> {
    let mut links = match arm.links[i].link.kind {
        JointKind::Revolute => revolute(arm, chain, now, i),
        JointKind::Prismatic => prismatic(chain, now, i),
    };
    let [less, more] = chain.freedoms()[i];
    let axes = (less..=more).filter(|&axes| axes != now.axes);
    links.extend(axes.map(|axes| changed(now, |link| link.axes = axes)));
    links
}

fn changed(now: &Link, change: impl FnOnce(&mut Link)) -> Link {
    let mut link = now.clone();
    change(&mut link);
    link
}

fn is_large(chain: &Chain<Exact>) -> bool {
    base_terms(chain) > MAX_TERMS || chain.links.iter().any(|link| terms(link) > MAX_TERMS)
}

fn base_terms(chain: &Chain<Exact>) -> usize {
    chain.base.as_ref().map_or(0, body_terms)
}

fn terms(link: &ChainLink<Exact>) -> usize {
    let free = link.free.iter().map(Exact::terms).max().unwrap_or(0);
    body_terms(&link.body).max(free)
}

fn body_terms(body: &MomentBody<Exact>) -> usize {
    let constants = body.second.entries().into_iter().chain(&body.first);
    constants.map(Exact::terms).max().unwrap_or(0)
}

fn quotient(a: &Exact, b: &Exact) -> Option<Exact> {
    a.divide(b.as_rational()?)
}

/// A moment that a revolute link may keep: of its regrouping, of a body, and the amounts.
type AxisMoment = (
    fn(&mut Link) -> &mut Exact,
    fn(&mut MomentBody<Exact>) -> &mut Exact,
    Vec<Exact>,
);

fn revolute(arm: &Skeleton<Exact>, chain: &Chain<Exact>, now: &Link, i: usize) -> Vec<Link> {
    let link = &chain.links[i];
    let body = &link.body;
    let [mass, first, second] = link.free.clone();
    let seconds = vec![second, body.second.xx.neg(), body.second.yy.neg()];
    let moments: [AxisMoment; 3] = [
        (|link| &mut link.mass, |body| &mut body.mass, vec![mass]),
        (
            |link| &mut link.first,
            |body| &mut body.first[2],
            vec![first],
        ),
        (|link| &mut link.second, |body| &mut body.second.zz, seconds),
    ];
    let mut links = Vec::new();
    for (kept, of_body, free_amounts) in moments {
        let mut amounts = vec![Exact::zero()];
        amounts.extend(free_amounts);
        let of_base = || chain.base.as_ref();
        let carrier = link
            .parent
            .map_or_else(of_base, |parent| Some(&chain.links[parent].body));
        if let Some(carrier) = carrier {
            // Moments that a link keeps do not arrive at what carries it.
            let parent = costly(carrier);
            let mut unit = MomentBody::zero();
            *of_body(&mut unit) = Exact::one();
            let effect = costly(&unit.carried(&link.rotation, &link.offset));
            let pairs = parent.iter().zip(&effect);
            let needed = pairs.filter_map(|(entry, slope)| quotient(entry, slope));
            amounts.extend(needed.map(|more| kept(&mut now.clone()).add(&more)));
        }
        let amounts = amounts.into_iter();
        links.extend(amounts.map(|x| changed(now, |link| *kept(link) = x)));
    }
    let mut origins = vec![Exact::zero(), arm.links[i].d.clone()];
    for (moment, slope) in [
        (&body.second.xz, &body.first[0]),
        (&body.second.yz, &body.first[1]),
    ] {
        if let Some(further) = quotient(moment, slope) {
            origins.push(now.origin[2].add(&further));
        }
    }
    for next in chain.links.iter().filter(|next| next.parent == Some(i)) {
        origins.push(now.origin[2].add(&next.offset[2]));
    }
    links.extend(origins.into_iter().map(|z| {
        let origin = [Exact::zero(), Exact::zero(), z];
        changed(now, |link| link.origin = origin)
    }));
    links
}

fn prismatic(chain: &Chain<Exact>, now: &Link, i: usize) -> Vec<Link> {
    let link = &chain.links[i];
    let shifted = |by: &Vector<Exact>| -> Vector<Exact> {
        core::array::from_fn(|axis| now.origin[axis].add(&by[axis]))
    };
    let back = link.offset.each_ref().map(|x| x.neg());
    let mut origins = vec![zero_vector(), shifted(&back)];
    for next in chain.links.iter().filter(|next| next.parent == Some(i)) {
        origins.push(shifted(&next.offset));
    }
    let centre = |moment: &Exact| quotient(moment, &link.body.mass);
    let centre: Vec<Exact> = link.body.first.iter().filter_map(centre).collect();
    if let Ok(centre) = <Vector<Exact>>::try_from(centre) {
        origins.push(shifted(&centre));
    }
    let moved = |origin| changed(now, |link| link.origin = origin);
    let kept = [false, true].map(|kept| changed(now, |link| link.keep_seconds = kept));
    origins.into_iter().map(moved).chain(kept).collect()
}

fn costly(body: &MomentBody<Exact>) -> Vec<Exact> {
    let second = &body.second;
    let [x, y, _] = &body.first;
    let entries = [
        x, y, &second.xx, &second.yy, &second.xy, &second.yz, &second.xz,
    ];
    let difference = second.xx.sub(&second.yy);
    entries.into_iter().cloned().chain([difference]).collect()
}
