//! An order in which every class comes after what its chosen way reads, kept as ways
//! change: whether a way would close a cycle is then asked only of the classes
//! between, which are few, and not of everything below.

use super::Place;

const NONE: u32 = u32::MAX;

/// The distance of labels after they are given anew.
const SPACE: u64 = 1 << 32;

/// All classes in a list, labelled ascending.
#[derive(Clone, Debug)]
pub(super) struct Order {
    labels: Vec<u64>,
    before: Vec<u32>,
    after: Vec<u32>,
    /// The first of the list.
    first: u32,
    /// Marks of the search, and what it found.
    marks: Vec<u32>,
    stamp: u32,
    found: Vec<Place>,
}

impl Order {
    /// Makes an order of so many classes, each after its operands. `operands` must be acyclic.
    pub(super) fn new(classes: usize, operands: impl Fn(Place) -> Option<[Place; 2]>) -> Order {
        let mut order = Order {
            labels: vec![0; classes],
            before: vec![NONE; classes],
            after: vec![NONE; classes],
            first: NONE,
            marks: vec![0; classes],
            stamp: 0,
            found: Vec::new(),
        };
        order.sort(operands);
        order
    }

    /// Orders all anew, after a change of many ways at once.
    pub(super) fn sort(&mut self, operands: impl Fn(Place) -> Option<[Place; 2]>) {
        self.stamp += 2;
        // Half-way: its operands are on the stack above it. Done: it is in the list.
        let (half, done) = (self.stamp - 1, self.stamp);
        let mut list: Vec<Place> = Vec::with_capacity(self.labels.len());
        let mut stack: Vec<Place> = Vec::new();
        for id in 0..self.labels.len() as Place {
            stack.push(id);
            while let Some(&top) = stack.last() {
                let mark = self.marks[top as usize];
                if mark != done && mark != half {
                    self.marks[top as usize] = half;
                    let operands = operands(top).into_iter().flatten();
                    stack.extend(operands.filter(|&id| self.marks[id as usize] != done));
                    continue;
                }
                stack.pop();
                if mark == half {
                    self.marks[top as usize] = done;
                    list.push(top);
                }
            }
        }
        self.first = list.first().copied().unwrap_or(NONE);
        for (place, &id) in list.iter().enumerate() {
            let at = |place: Option<usize>| place.and_then(|place| list.get(place)).copied();
            self.before[id as usize] = at(place.checked_sub(1)).unwrap_or(NONE);
            self.after[id as usize] = at(Some(place + 1)).unwrap_or(NONE);
        }
        self.label();
    }

    /// Labels by the list.
    fn label(&mut self) {
        let (mut id, mut label) = (self.first, SPACE);
        while id != NONE {
            self.labels[id as usize] = label;
            label += SPACE;
            id = self.after[id as usize];
        }
    }

    /// Returns whether a class may read these: none of them depends on it. If so, they come
    /// before it from now on. `operands` are those of the ways that are chosen.
    pub(super) fn admits(
        &mut self,
        class: Place,
        reads: [Place; 2],
        operands: impl Fn(Place) -> Option<[Place; 2]>,
    ) -> bool {
        self.stamp += 1;
        self.found.clear();
        // What comes before the class does not depend on it, nor does what that reads.
        let least = self.labels[class as usize];
        let mut next = 0;
        let mut reads = Some(reads);
        loop {
            for id in reads.into_iter().flatten() {
                if id == class {
                    return false;
                }
                if self.labels[id as usize] > least && self.marks[id as usize] != self.stamp {
                    self.marks[id as usize] = self.stamp;
                    self.found.push(id);
                }
            }
            let Some(&id) = self.found.get(next) else {
                break;
            };
            next += 1;
            reads = operands(id);
        }
        if !self.found.is_empty() {
            self.bring_before(class);
        }
        true
    }

    /// Moves what was found, which is all that it reads among what comes after the
    /// class, to just before it.
    fn bring_before(&mut self, class: Place) {
        let mut found = std::mem::take(&mut self.found);
        found.sort_unstable_by_key(|&id| self.labels[id as usize]);
        let steps = found.len() as u64 + 1;
        if self.room_before(class) < steps {
            self.label();
        }
        let step = self.room_before(class) / steps;
        let mut label = self.labels[class as usize] - self.room_before(class);
        for &id in &found {
            self.unlink(id);
            label += step;
            self.labels[id as usize] = label;
            let before = self.before[class as usize];
            self.link(before, id);
            self.link(id, class);
        }
        self.found = found;
    }

    /// Returns how far the label before a class is away.
    fn room_before(&self, class: Place) -> u64 {
        let before = match self.before[class as usize] {
            NONE => 0,
            before => self.labels[before as usize],
        };
        self.labels[class as usize] - before
    }

    fn unlink(&mut self, id: Place) {
        let (before, after) = (self.before[id as usize], self.after[id as usize]);
        self.link(before, after);
    }

    /// Makes two neighbours, where an end of the list is one of them.
    fn link(&mut self, first: u32, second: u32) {
        match first {
            NONE => self.first = second,
            first => self.after[first as usize] = second,
        }
        if second != NONE {
            self.before[second as usize] = first;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    /// Returns whether a class depends on another, found from nothing but the choice.
    fn reaches(chosen: &[Option<[Place; 2]>], from: Place, class: Place) -> bool {
        let (mut seen, mut stack) = (vec![false; chosen.len()], vec![from]);
        while let Some(id) = stack.pop() {
            if !std::mem::replace(&mut seen[id as usize], true) {
                stack.extend(chosen[id as usize].into_iter().flatten());
            }
        }
        seen[class as usize]
    }

    #[test]
    fn says_what_a_search_of_everything_says() {
        const CLASSES: usize = 40;
        let mut random = Random::new(5);
        let mut chosen: Vec<Option<[Place; 2]>> = vec![None; CLASSES];
        let mut order = Order::new(CLASSES, |id| chosen[id as usize]);
        let mut said = [0; 2];
        for round in 0..20_000 {
            let mut draw = || random.below(CLASSES) as Place;
            let (class, reads) = (draw(), [draw(), draw()]);
            if round % 7 == 0 {
                // Few ways, so that most of those that are asked for are none.
                chosen[class as usize] = None;
                continue;
            }
            let expected = !reads.iter().any(|&id| reaches(&chosen, id, class));
            let admitted = order.admits(class, reads, |id| chosen[id as usize]);
            assert_eq!(admitted, expected, "round {round}");
            said[usize::from(admitted)] += 1;
            if admitted {
                chosen[class as usize] = Some(reads);
            }
            for (id, reads) in chosen.iter().enumerate() {
                for read in reads.iter().flatten() {
                    assert!(order.labels[*read as usize] < order.labels[id]);
                }
            }
        }
        assert!(said.iter().all(|&count| count > 1_000), "{said:?}");
    }
}
