//! An order in which every class comes after what its chosen way reads, kept as ways change.
//!
//! Only the few classes between are then asked if a way would close a circle.

const NONE: u32 = u32::MAX;
const SPACE: u64 = 1 << 32;

/// All classes in a linked list, labelled ascending.
pub(super) struct Order {
    labels: Vec<u64>,
    /// The neighbours of each class; those of the ends are the last entry.
    before: Vec<u32>,
    after: Vec<u32>,
    marks: Vec<u32>,
    stamp: u32,
    queue: Vec<u32>,
}

impl Order {
    pub(super) fn new(classes: usize) -> Order {
        Order {
            labels: vec![0; classes + 1],
            before: vec![NONE; classes + 1],
            after: vec![NONE; classes + 1],
            marks: vec![0; classes],
            stamp: 0,
            queue: Vec::new(),
        }
    }

    pub(super) fn sort(&mut self, reads: impl Fn(u32) -> [u32; 2]) {
        self.stamp += 2;
        // Half-way: what it reads is above it on the stack. Done: it is in the list.
        let (half, done) = (self.stamp - 1, self.stamp);
        let end = self.marks.len() as u32;
        let mut last = end;
        let mut stack: Vec<u32> = Vec::new();
        for id in 0..end {
            stack.push(id);
            while let Some(&top) = stack.last() {
                let mark = std::mem::replace(&mut self.marks[top as usize], half);
                if mark != done && mark != half {
                    let reads = reads(top).into_iter();
                    stack.extend(reads.filter(|&id| self.marks[id as usize] < half));
                    continue;
                }
                stack.pop();
                self.marks[top as usize] = done;
                if mark == half {
                    self.link(last, top);
                    last = top;
                }
            }
        }
        self.link(last, end);
        self.label();
    }

    fn link(&mut self, first: u32, second: u32) {
        self.after[first as usize] = second;
        self.before[second as usize] = first;
    }

    fn label(&mut self) {
        let end = self.marks.len();
        let (mut id, mut label) = (self.after[end], SPACE);
        while id as usize != end {
            self.labels[id as usize] = label;
            label += SPACE;
            id = self.after[id as usize];
        }
    }

    /// If none of these depends on the class, they come before it from now on.
    pub(super) fn admits(
        &mut self,
        class: u32,
        new: [u32; 2],
        reads: impl Fn(u32) -> [u32; 2],
    ) -> bool {
        self.stamp += 1;
        self.queue.clear();
        // The classes before this one do not depend on it, nor do the classes that they read.
        let least = self.labels[class as usize];
        let (mut next, mut pending) = (0, new);
        loop {
            for id in pending {
                if id == class {
                    return false;
                }
                if self.labels[id as usize] > least && self.marks[id as usize] != self.stamp {
                    self.marks[id as usize] = self.stamp;
                    self.queue.push(id);
                }
            }
            match self.queue.get(next) {
                Some(&id) => pending = reads(id),
                None => break,
            }
            next += 1;
        }
        // Moves the queue before the class: the later ones among the new reads and what they read.
        let mut queue = std::mem::take(&mut self.queue);
        queue.sort_unstable_by_key(|&id| self.labels[id as usize]);
        let steps = queue.len() as u64 + 1;
        if self.room(class) < steps {
            self.label();
        }
        let room = self.room(class);
        let mut label = self.labels[class as usize] - room;
        for &id in &queue {
            self.link(self.before[id as usize], self.after[id as usize]);
            label += room / steps;
            self.labels[id as usize] = label;
            self.link(self.before[class as usize], id);
            self.link(id, class);
        }
        self.queue = queue;
        true
    }

    fn room(&self, class: u32) -> u64 {
        self.labels[class as usize] - self.labels[self.before[class as usize] as usize]
    }
}
