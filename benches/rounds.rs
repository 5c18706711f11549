//! Variants of one thing, timed in turn: what slows the machine down for a while slows
//! all of them down, so that their ratios hold on a busy machine, too.

use std::time::Instant;

pub struct Rounds {
    units: usize,
    variants: Vec<(&'static str, Vec<f64>)>,
}

impl Rounds {
    pub fn of(units: usize) -> Rounds {
        let variants = Vec::new();
        Rounds { units, variants }
    }

    pub fn time(&mut self, name: &'static str, run: impl FnOnce()) {
        let start = Instant::now();
        run();
        self.note(name, start.elapsed().as_secs_f64() * 1e9);
    }

    /// The nanoseconds that one run of a variant took, once a round.
    pub fn note(&mut self, name: &'static str, time: f64) {
        let time = time / self.units as f64;
        match self.variants.iter_mut().find(|(known, _)| *known == name) {
            Some((_, times)) => times.push(time),
            None => self.variants.push((name, vec![time])),
        }
    }

    /// Prints medians: of the times, and of the speed relative to the first variant in the same
    /// round.
    #[allow(dead_code)] // Every bench compiles this file for itself.
    pub fn print(&self, what: &str) {
        println!("\n{what}: ns each, times as fast as the first");
        for (name, times) in &self.variants {
            let pairs = self.variants[0].1.iter().zip(times);
            let ratios = pairs.map(|(first, time)| first / time);
            let (time, ratio) = (median(times.clone()), median(ratios.collect()));
            println!("{name:40} {time:12.2} {ratio:8.2}");
        }
    }

    /// The least times are also multiples of the least that is possible, where that is known.
    #[allow(dead_code)]
    pub fn print_limits(&self, what: &str, limit: impl Fn(&str) -> Option<f64>) {
        println!("\n{what}: ns each, median and least; port limit, times that");
        for (name, times) in &self.variants {
            let least = times.iter().copied().fold(f64::MAX, f64::min);
            print!("{name:32} {:10.2} {least:10.2}", median(times.clone()));
            match limit(name) {
                Some(limit) => println!(" {limit:10.2} {:8.2}", least / limit),
                None => println!(),
            }
        }
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
