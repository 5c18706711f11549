//! Limbs of one structure, and the numbers in which they differ.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

use dalembert_model::equations::chain::{Chain, ChainLink};
use dalembert_model::equations::matrix::zero_vector;
use dalembert_model::number::Exact;
use dalembert_model::robot::JointKind;
use dalembert_model::scalar::Scalar;

use crate::dag::Builder;
use crate::dag::symbol::Symbol;
use crate::function::Argument;
use crate::program::Input;
use crate::setup::Setup;

/// A lane's place: the class of its limb, the limb among those of the class, and the link in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct LanePlace {
    pub class: usize,
    pub lane: usize,
    pub link: usize,
}

/// Limbs of one structure: of each the places of its links in the chain.
pub(super) type Class = Vec<Vec<usize>>;

/// Lists limbs that hang on one link, with the same joints in order, and zeros in the same places.
pub(super) fn classes(chain: &Chain<Exact>) -> Vec<Class> {
    let mut classes: Vec<Class> = Vec::new();
    let mut inside = vec![false; chain.links.len()];
    let carriers = [None].into_iter().chain((0..chain.links.len()).map(Some));
    for carrier in carriers {
        if carrier.is_some_and(|link| inside[link]) {
            continue;
        }
        let mut groups: Vec<(Structure, Class)> = Vec::new();
        for root in (0..chain.links.len()).filter(|&i| chain.links[i].parent == carrier) {
            let limb = limb(chain, root);
            let structure = structure(chain, &limb);
            match groups.iter_mut().find(|(known, _)| *known == structure) {
                Some((_, limbs)) => limbs.push(limb),
                None => groups.push((structure, vec![limb])),
            }
        }
        let alike = groups.into_iter().map(|(_, limbs)| limbs);
        for class in alike.filter(|limbs| limbs.len() > 1) {
            class.iter().flatten().for_each(|&link| inside[link] = true);
            classes.push(class);
        }
    }
    classes
}

fn limb(chain: &Chain<Exact>, root: usize) -> Vec<usize> {
    let is_carried = |&i: &usize| chain.way(i).any(|link| link == root);
    (0..chain.links.len()).filter(is_carried).collect()
}

/// Lists the links of limbs, each with its place.
fn places(classes: &[Class]) -> Vec<(usize, LanePlace)> {
    let mut places = Vec::new();
    for (class, limbs) in classes.iter().enumerate() {
        for (lane, limb) in limbs.iter().enumerate() {
            let links = limb.iter().enumerate();
            places.extend(links.map(|(link, &i)| (i, LanePlace { class, lane, link })));
        }
    }
    places
}

/// Each link's joint, the place of the link that carries it, whether its frame may stay behind, the
/// turns of its axes, and which of its numbers are zero.
type Structure = Vec<(JointKind, Option<usize>, bool, i32, Vec<bool>)>;

fn structure(chain: &Chain<Exact>, limb: &[usize]) -> Structure {
    let of_link = |&i: &usize| {
        let link = &chain.links[i];
        let place = |parent: usize| limb.binary_search(&parent).ok();
        let parent = link.parent.and_then(place);
        let zeros = numbers(link).iter().map(Scalar::is_zero).collect();
        (link.kind, parent, link.spins_freely, link.axes, zeros)
    };
    limb.iter().map(of_link).collect()
}

/// The numbers of a link, in the order in which its chain has them.
fn numbers(link: &ChainLink<Exact>) -> Vec<Exact> {
    let alone = Chain {
        gravity: zero_vector(),
        base: None,
        base_probes: Vec::new(),
        links: vec![link.clone()],
        per_unit: Exact::one(),
        columns: 0,
    };
    let mut numbers = Vec::new();
    alone.map(|number| numbers.push(number.clone()));
    // Gravity stands before the links, the unit of length behind them.
    numbers.pop();
    numbers.split_off(3)
}

/// The limbs of a chain; numbers of links that differ from lane to lane are entries of tuples.
pub(super) struct Limbs {
    pub classes: Vec<Class>,
    /// Numbers that differ, one a lane, with the class of the lanes.
    pub tuples: Vec<(usize, Vec<Exact>)>,
    /// The place of the link that a joint moves first.
    joints: BTreeMap<usize, LanePlace>,
}

/// More limbs are not lanes of one loop.
pub(super) const MAX_LANES: usize = 64;

impl Limbs {
    pub(super) fn of(chain: &Chain<Exact>, setup: &Setup) -> Limbs {
        let mut classes = classes(chain);
        classes.retain(|class| class.len() <= MAX_LANES);
        let (robot, rows) = (setup.robot(), setup.chained_rows());
        let base = robot.base_coordinates();
        let mut joints = BTreeMap::new();
        for (i, place) in places(&classes) {
            let joint = robot.mover_of(rows[base + i] - base);
            joints.entry(joint).or_insert(place);
        }
        Limbs {
            classes,
            tuples: Vec::new(),
            joints,
        }
    }

    fn joint(&self, place: LanePlace) -> Option<usize> {
        let mut joints = self.joints.iter();
        joints.find_map(|(joint, other)| (*other == place).then_some(*joint))
    }

    /// Returns the input in which lane 0 of a class reads what a lane reads as this one, with the lane;
    /// none of what all lanes share.
    pub(super) fn lane_of(&self, input: Input, base: usize) -> Option<(LanePlace, Input)> {
        let joint = match input {
            Input::Sin(joint) | Input::Cos(joint) => joint,
            Input::PerSpeed(coordinate) => coordinate.checked_sub(base)?,
            Input::Entry(Argument::Position, joint) => joint,
            Input::Entry(Argument::Load, entry) => {
                let (tuple, lane) = (entry / MAX_LANES, entry % MAX_LANES);
                let (class, link) = (self.tuples[tuple].0, 0);
                return Some((LanePlace { class, lane, link }, tuple_input(tuple, 0)));
            }
            Input::Entry(argument, _) if is_shared(argument) => return None,
            Input::Entry(_, coordinate) => coordinate.checked_sub(base)?,
        };
        let place = *self.joints.get(&joint)?;
        // Lane 0 need not have a joint there, where joints follow others.
        self.joint(LanePlace { lane: 0, ..place })?;
        Some((place, self.in_lane(input, place.class, 0, base)))
    }

    /// Returns the input of a lane that is read as this one in lane 0.
    pub(super) fn in_lane(&self, input: Input, class: usize, lane: usize, base: usize) -> Input {
        let moved = |joint: usize| {
            let place = self.joints.get(&joint).filter(|place| place.class == class);
            let fellow = place.and_then(|place| self.joint(LanePlace { lane, ..*place }));
            fellow.unwrap_or(joint)
        };
        let coordinate = |coordinate: usize| match coordinate.checked_sub(base) {
            Some(joint) => base + moved(joint),
            None => coordinate,
        };
        match input {
            Input::Sin(joint) => Input::Sin(moved(joint)),
            Input::Cos(joint) => Input::Cos(moved(joint)),
            Input::PerSpeed(index) => Input::PerSpeed(coordinate(index)),
            Input::Entry(Argument::Position, joint) => {
                Input::Entry(Argument::Position, moved(joint))
            }
            Input::Entry(Argument::Load, _) => match self.tuple_of(input) {
                Some(tuple) => tuple_input(tuple, lane),
                None => input,
            },
            Input::Entry(argument, _) if is_shared(argument) => input,
            Input::Entry(argument, index) => Input::Entry(argument, coordinate(index)),
        }
    }

    /// Returns the place of the tuple that an input is an entry of, if it is one.
    pub(super) fn tuple_of(&self, input: Input) -> Option<usize> {
        match input {
            Input::Entry(Argument::Load, entry) if entry < OPAQUE => Some(entry / MAX_LANES),
            _ => None,
        }
    }

    /// Returns the number that an input stands for, if it is an entry of a tuple.
    pub(super) fn number(&self, input: Input) -> Option<&Exact> {
        let Input::Entry(_, entry) = input else {
            return None;
        };
        Some(&self.tuples[self.tuple_of(input)?].1[entry % MAX_LANES])
    }

    /// Returns the place of numbers, one a lane, and if they have the other sign.
    pub(super) fn tuple(&mut self, class: usize, numbers: Vec<Exact>) -> (usize, bool) {
        let opposite: Vec<Exact> = numbers.iter().map(Scalar::neg).collect();
        for (is_negative, numbers) in [(false, &numbers), (true, &opposite)] {
            let same = |tuple: &(usize, Vec<Exact>)| tuple.0 == class && tuple.1 == *numbers;
            if let Some(place) = self.tuples.iter().position(same) {
                return (place, is_negative);
            }
        }
        self.tuples.push((class, numbers));
        (self.tuples.len() - 1, false)
    }

    pub(super) fn symbols(
        &mut self,
        chain: &Chain<Exact>,
        builder: &Rc<RefCell<Builder>>,
    ) -> Chain<Symbol> {
        let of_links: Vec<Vec<Exact>> = chain.links.iter().map(numbers).collect();
        let mut count = 0;
        chain.map(|_| count += 1);
        let of_base = count - 1 - of_links.iter().map(Vec::len).sum::<usize>();
        let lane_places: BTreeMap<usize, LanePlace> = places(&self.classes).into_iter().collect();
        let links = of_links.iter().enumerate().flat_map(|(link, numbers)| {
            let numbers = 0..numbers.len();
            numbers.map(move |number| (link, number))
        });
        let mut links = std::iter::repeat_n(None, of_base).chain(links.map(Some));
        chain.map(|number| {
            let entry = links.next().flatten();
            let in_lane = entry.and_then(|(link, index)| Some((*lane_places.get(&link)?, index)));
            let Some((lane_place, index)) = in_lane else {
                return Symbol::constant(number);
            };
            let of_limb = |limb: &Vec<usize>| of_links[limb[lane_place.link]][index].clone();
            let lanes: Vec<Exact> = self.classes[lane_place.class].iter().map(of_limb).collect();
            if lanes.iter().all(|other| other == number) {
                return Symbol::constant(number);
            }
            let (tuple, is_negative) = self.tuple(lane_place.class, lanes);
            let entry = Symbol::input(builder, tuple_input(tuple, lane_place.lane));
            if is_negative { entry.neg() } else { entry }
        })
    }
}

/// True of arguments that have no entries for joints: every lane reads the same ones.
fn is_shared(argument: Argument) -> bool {
    use Argument::{Damping, Gravity, Payload, Wrench};
    matches!(argument, Gravity | Payload | Wrench | Damping)
}

/// From here on entries are values of other parts of a program.
pub(super) const OPAQUE: usize = 1 << 32;

/// While a program is searched for, numbers of lanes are entries of a load, which no task here has.
pub(super) fn tuple_input(tuple: usize, lane: usize) -> Input {
    Input::Entry(Argument::Load, tuple * MAX_LANES + lane)
}
