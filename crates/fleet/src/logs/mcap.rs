//! ROS 2's recordings: `sensor_msgs/JointState` in MCAP files, CDR decoded.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use ::mcap::io::MessageReader;

use super::block::{Block, ROWS};
use super::mapping::{Columns, QUANTITIES};
use crate::error::Error;

const SCHEMAS: [&str; 2] = ["sensor_msgs/msg/JointState", "sensor_msgs/JointState"];

/// Reads blocks of the joints' states.
pub struct Messages<'a> {
    messages: MessageReader<BufReader<File>>,
    columns: &'a Columns,
    topic: Option<String>,
    row: u64,
    ended: bool,
}

impl<'a> Messages<'a> {
    pub fn open(path: &Path, columns: &'a Columns) -> Result<Messages<'a>, Error> {
        Ok(Messages {
            messages: MessageReader::new(BufReader::new(File::open(path)?)),
            columns,
            topic: columns.topic.clone(),
            row: 0,
            ended: false,
        })
    }

    fn next_state(&mut self) -> Result<Option<JointState>, Error> {
        for message in self.messages.by_ref() {
            let message = message.map_err(Error::new)?;
            let channel = &message.channel;
            let schema = channel.schema.as_ref().map_or("", |schema| &schema.name);
            if !SCHEMAS.contains(&schema) {
                if self.columns.topic.as_deref() == Some(&channel.topic) {
                    return Err(Error::new(format!(
                        "topic `{}` has `{schema}`: {} was expected",
                        channel.topic, SCHEMAS[0]
                    )));
                }
                continue;
            }
            let topic = self.topic.get_or_insert_with(|| channel.topic.clone());
            if *topic != channel.topic {
                if self.columns.topic.is_some() {
                    continue;
                }
                return Err(Error::new(format!(
                    "`{topic}` and `{}` both have joint states: choose one with `--topic`",
                    channel.topic
                )));
            }
            let encoding = &channel.message_encoding;
            if encoding != "cdr" {
                let why = format!("messages are encoded as `{encoding}`, not as cdr");
                return Err(Error::new(why));
            }
            self.row += 1;
            let place = |why: Error| why.at(format!("message {}", self.row));
            let mut state = decode(&message.data).map_err(place)?;
            if state.time == 0.0 {
                state.time = message.log_time as f64 * 1e-9;
            }
            return Ok(Some(state));
        }
        Ok(None)
    }

    fn block(&mut self) -> Result<Option<Block>, Error> {
        let n = self.columns.joints;
        let mut block = Block::default();
        let mut states: [Vec<f64>; 4] = Default::default();
        while block.len() < ROWS {
            let Some(state) = self.next_state()? else {
                self.ended = true;
                break;
            };
            let place = |why: Error| why.at(format!("message {}", self.row));
            let order = state.order(self.columns).map_err(place)?;
            block.rows.push(self.row);
            block.time.push(state.time);
            let none = Vec::new();
            let values = [&state.position, &state.velocity, &none, &state.effort];
            for (quantity, (values, states)) in values.into_iter().zip(&mut states).enumerate() {
                let is_rate = quantity == 1 || quantity == 2;
                if values.is_empty() && is_rate && states.is_empty() {
                    continue;
                }
                if values.len() != state.joints() || states.len() != n * (block.len() - 1) {
                    let name = QUANTITIES[quantity];
                    if quantity == 3 && values.is_empty() {
                        let why = "has no efforts: residuals need measured torques";
                        return Err(Error::new(format!("message {} {why}", self.row)));
                    }
                    let (count, joints) = (values.len(), state.joints());
                    let why = format!("{count} values of {name} for {joints} joints");
                    return Err(place(Error::new(why)));
                }
                let factors = &self.columns.factors[quantity];
                let sources = order.iter().zip(factors);
                states.extend(sources.map(|(from, factor)| values[*from] * factor));
            }
        }
        let count = block.len();
        for (states, columns) in states.iter().zip(&mut block.quantities) {
            if !states.is_empty() {
                let entry = |place: usize| states[place % count * n + place / count];
                *columns = (0..n * count).map(entry).collect();
            }
        }
        Ok((count > 0).then_some(block))
    }
}

impl Iterator for Messages<'_> {
    type Item = Result<Block, Error>;

    fn next(&mut self) -> Option<Result<Block, Error>> {
        if self.ended {
            return None;
        }
        let block = self.block().transpose();
        self.ended |= !matches!(block, Some(Ok(_)));
        if block.is_none() && self.row == 0 {
            let why = format!("there is no message of {}", SCHEMAS[0]);
            return Some(Err(Error::new(why)));
        }
        block
    }
}

struct JointState {
    time: f64,
    names: Vec<String>,
    position: Vec<f64>,
    velocity: Vec<f64>,
    effort: Vec<f64>,
}

impl JointState {
    /// The message may have no names.
    fn joints(&self) -> usize {
        match self.names.len() {
            0 => self.position.len(),
            count => count,
        }
    }

    /// By name, or in order if the message or the robot has no names.
    fn order(&self, columns: &Columns) -> Result<Vec<usize>, Error> {
        let wanted = &columns.joint_names;
        let names = self.names.join(", ");
        if wanted.is_empty() || self.names.is_empty() {
            let count = self.joints();
            if count == columns.joints {
                return Ok((0..count).collect());
            }
            return Err(Error::new(format!(
                "it is of {count} joints ({names}), and the robot has {}: name the robot joints with \
                 `--joint-names`",
                columns.joints
            )));
        }
        let is_lost = |name: &&String| !self.names.contains(name);
        let lost: Vec<&str> = wanted.iter().filter(is_lost).map(String::as_str).collect();
        if !lost.is_empty() {
            return Err(Error::new(format!(
                "it has no joint {}: its joints are {names}, those of the robot {}; say which of its joints \
                 are the robot's, in the robot's order, by `--joint-names`",
                lost.join(", "),
                wanted.join(", ")
            )));
        }
        let place = |name: &String| self.names.iter().position(|joint| joint == name);
        Ok(wanted.iter().filter_map(place).collect())
    }
}

/// Decodes a message: XCDR1, little or big endian.
fn decode(bytes: &[u8]) -> Result<JointState, Error> {
    let mut reader = Cdr {
        body: bytes.get(4..).ok_or_else(short)?,
        place: 0,
        is_little: match bytes.get(1) {
            Some(0) => false,
            Some(1) => true,
            _ => return Err(Error::new("it is not plain CDR")),
        },
    };
    let seconds = reader.word()? as i32;
    let nanoseconds = reader.word()?;
    reader.text()?;
    let count = reader.word()?;
    let names = (0..count).map(|_| reader.text());
    Ok(JointState {
        time: f64::from(seconds) + f64::from(nanoseconds) * 1e-9,
        names: names.collect::<Result<_, _>>()?,
        position: reader.floats()?,
        velocity: reader.floats()?,
        effort: reader.floats()?,
    })
}

fn short() -> Error {
    Error::new("it ends too early")
}

struct Cdr<'a> {
    body: &'a [u8],
    place: usize,
    is_little: bool,
}

impl Cdr<'_> {
    fn take<const N: usize>(&mut self) -> Result<[u8; N], Error> {
        self.place = self.place.next_multiple_of(N);
        let rest = self.body.get(self.place..).ok_or_else(short)?;
        let mut taken = *rest.first_chunk::<N>().ok_or_else(short)?;
        if !self.is_little {
            taken.reverse();
        }
        self.place += N;
        Ok(taken)
    }

    fn word(&mut self) -> Result<u32, Error> {
        Ok(u32::from_le_bytes(self.take()?))
    }

    fn text(&mut self) -> Result<String, Error> {
        let length = self.word()? as usize;
        let end = self.place.checked_add(length).ok_or_else(short)?;
        let bytes = self.body.get(self.place..end).ok_or_else(short)?;
        self.place = end;
        let bytes = bytes.strip_suffix(b"\0").unwrap_or(bytes);
        Ok(String::from_utf8_lossy(bytes).into_owned())
    }

    fn floats(&mut self) -> Result<Vec<f64>, Error> {
        let count = self.word()?;
        let values = (0..count).map(|_| Ok(f64::from_le_bytes(self.take()?)));
        values.collect()
    }
}
