//! Outputs that are one value: D is symmetric, and a third of all h_ikm have a
//! twin. What bounds one of them bounds all.

use std::collections::BTreeMap;

#[derive(Clone, Debug)]
pub(super) struct Distinct {
    firsts: Vec<usize>,
    places: Vec<usize>,
}

impl Distinct {
    /// Outputs with the same key are one; one without a key is like no other.
    pub(super) fn by<K: Ord>(keys: impl Iterator<Item = Option<K>>) -> Distinct {
        let mut known = BTreeMap::new();
        let (mut firsts, mut places) = (Vec::new(), Vec::new());
        for (index, key) in keys.enumerate() {
            let next = firsts.len();
            let place = key.map_or(next, |key| *known.entry(key).or_insert(next));
            if place == next {
                firsts.push(index);
            }
            places.push(place);
        }
        Distinct { firsts, places }
    }

    pub(super) fn pick<T: Clone>(&self, all: &[T]) -> Vec<T> {
        debug_assert_eq!(all.len(), self.places.len());
        let firsts = self.firsts.iter();
        firsts
            .filter_map(|&index| all.get(index).cloned())
            .collect()
    }

    pub(super) fn scatter<T: Clone>(&self, found: &[T]) -> Vec<T> {
        debug_assert_eq!(found.len(), self.firsts.len());
        let places = self.places.iter();
        places
            .filter_map(|&place| found.get(place).cloned())
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::Distinct;

    #[test]
    fn each_value_once_and_back() {
        let keys = [Some(3), None, Some(1), Some(3), None, Some(1)];
        let distinct = Distinct::by(keys.into_iter());
        assert_eq!(
            distinct.pick(&["a", "b", "c", "d", "e", "f"]),
            ["a", "b", "c", "e"]
        );
        assert_eq!(distinct.scatter(&[1, 2, 3, 4]), [1, 2, 3, 1, 4, 3]);
    }
}
