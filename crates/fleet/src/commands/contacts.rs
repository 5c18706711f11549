//! When residuals change: contacts, as intervals.

use dalembert_fit::Watch;

use crate::dynamics::Dynamics;
use crate::error::Error;
use crate::logs::Log;
use crate::progress::Going;
use crate::walk::walk;

/// Half of the change that is found soonest, in units of the noise.
const DRIFT: f64 = 1.0;
/// Alarms that are closer than this, s, are of one contact.
const APART: f64 = 0.5;

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Contact {
    pub(super) start: f64,
    pub(super) end: f64,
    pub(super) joint: usize,
    pub(super) largest: f64,
}

/// Returns the largest sum, too, in units of the noise.
pub(super) fn contacts(
    robot: &dyn Dynamics,
    log: &Log,
    noise: &[f64],
    bar: f64,
    going: &Going,
) -> Result<(Vec<Contact>, f64), Error> {
    let mut watch = Watch::new(noise, DRIFT, bar)?;
    let (mut found, mut level): (Vec<Contact>, f64) = (Vec::new(), 0.0);
    let mut state = vec![0.0; noise.len()];
    walk(robot, log, going, |block, residuals| {
        for (s, time) in block.time.iter().enumerate() {
            for (i, value) in state.iter_mut().enumerate() {
                *value = residuals[i * block.len() + s];
            }
            let alarm = watch.push(&state)?;
            level = level.max(watch.level());
            let last = found.last_mut().filter(|last| time - last.end < APART);
            if let Some(last) = last {
                if alarm.is_some() {
                    last.end = *time;
                }
                last.largest = last.largest.max(state[last.joint].abs());
            } else if let Some(joint) = alarm {
                found.push(Contact {
                    start: *time,
                    end: *time,
                    joint,
                    largest: state[joint].abs(),
                });
            }
        }
        Ok(())
    })?;
    Ok((found, level))
}
