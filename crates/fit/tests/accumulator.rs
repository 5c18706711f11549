//! Parts that merge give what the whole gives, and bytes come back.

use dalembert_fit::random::{Random, normal};
use dalembert_fit::{Accumulator, Error, Model, fit};

use crate::support::{ARMS, State, accumulated, arm, file, model, states, torques};

type Logged<'a> = (&'a State, &'a Vec<f64>);

fn in_parts(model: &Model, both: &[Logged], parts: usize, batch: usize) -> Accumulator {
    let mut total = Accumulator::new(model);
    for part in both.chunks(both.len().div_ceil(parts)) {
        let mut subtotal = Accumulator::new(model);
        for batch in part.chunks(batch) {
            let mut partial = Accumulator::new(model);
            for (state, tau) in batch {
                partial.add_rows(model, &state.y, tau).unwrap();
            }
            subtotal.merge(&partial).unwrap();
        }
        // As it travels between machines.
        let read = Accumulator::from_bytes(model, &subtotal.to_bytes()).unwrap();
        total.merge(&read).unwrap();
    }
    total
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    let norm = |x: &mut dyn Iterator<Item = f64>| x.map(|x| x * x).sum::<f64>().sqrt();
    norm(&mut a.iter().zip(b).map(|(a, b)| a - b)) / norm(&mut b.iter().copied())
}

/// Rows of rounding, as dependent columns of the PUMA leave them, must not count as fitted.
#[test]
fn partitions_do_not_matter() {
    for name in ARMS {
        let (model, right) = arm(name);
        let states = states(&model, 1500, 1);
        let mut random = Random::new(2);
        let mut noisy = |state: &State| -> Vec<f64> {
            let exact = torques(&state.y, &right).into_iter();
            exact.map(|x| x + normal(&mut random)).collect()
        };
        let tau: Vec<Vec<f64>> = states.iter().map(&mut noisy).collect();
        let both: Vec<_> = states.iter().zip(&tau).collect();
        let reversed: Vec<_> = both.iter().rev().copied().collect();
        let whole = in_parts(&model, &both, 1, 1500);
        let wanted = fit(&model, &whole).unwrap();
        for (of, parts, batch) in [
            (&both, 1, 333),
            (&both, 2, 1500),
            (&both, 3, 97),
            (&both, 7, 333),
            (&both, 7, 41),
            (&reversed, 3, 97),
        ] {
            let merged = in_parts(&model, of, parts, batch);
            assert_eq!(merged.states(), 1500);
            let found = fit(&model, &merged).unwrap();
            for (what, a, b) in [
                ("noise", &found.noise, &wanted.noise),
                ("residuals", &found.after, &wanted.after),
                ("parameters", &found.parameters, &wanted.parameters),
                ("errors", &found.standard_errors, &wanted.standard_errors),
            ] {
                let off = distance(a, b);
                assert!(off < 1e-12, "{name}, {parts} parts, {what}: {off:e}");
            }
        }
        let again = in_parts(&model, &both, 3, 97).to_bytes();
        assert_eq!(again, in_parts(&model, &both, 3, 97).to_bytes());
    }
}

#[test]
fn residuals_need_no_second_look() {
    let (model, right) = arm("puma560");
    let states = states(&model, 300, 3);
    let data = accumulated(&model, &states, &right, Some(4));
    let residuals = data.residual(&model, model.parameters()).unwrap();
    let mut random = Random::new(4);
    let mut squares = [0.0; 6];
    for state in &states {
        let [tau, model_tau] = [&right[..], model.parameters()].map(|p| torques(&state.y, p));
        for (i, square) in squares.iter_mut().enumerate() {
            let noise = crate::support::noise(i) * normal(&mut random);
            *square += (tau[i] + noise - model_tau[i]).powi(2);
        }
    }
    for (residual, square) in residuals.iter().zip(squares) {
        let wanted = (square / 300.0).sqrt();
        let off = (residual - wanted).abs();
        assert!(off < 1e-11 * wanted, "{residual} {wanted}");
    }
}

#[test]
fn bytes_are_refused_that_are_not_its_own() {
    let model = model(&file("puma560"));
    let data = accumulated(&model, &states(&model, 90, 1), model.parameters(), None);
    let bytes = data.to_bytes();
    let refused = |bytes: &[u8]| match Accumulator::from_bytes(&model, bytes) {
        Err(Error::Bytes(why)) => why,
        other => panic!("{} bytes: {other:?}", bytes.len()),
    };
    // Whatever the number of states.
    assert!(bytes.len() < 25_000, "{}", bytes.len());
    for length in (0..bytes.len()).filter(|length| length % 97 == 0 || *length < 60) {
        refused(&bytes[..length]);
    }
    refused(&[&bytes[..], &[0]].concat());
    let mut newer = bytes.clone();
    newer[6] = 2;
    assert!(refused(&newer).contains("version"));
    let (finite, _) = bytes.split_last_chunk::<8>().unwrap();
    refused(&[finite, &f64::NAN.to_le_bytes()].concat());
    let other = Model::new(&file("stanford")).unwrap();
    let read = Accumulator::from_bytes(&other, &bytes);
    assert_eq!(read, Err(Error::OtherModel));
    let merged = Accumulator::new(&other).merge(&data);
    assert_eq!(merged, Err(Error::OtherModel));
}

#[test]
fn a_state_that_is_refused_changes_nothing() {
    let model = model(&file("puma560"));
    let mut data = Accumulator::new(&model);
    let six = [0.1; 6];
    let bad = [0.1, 0.1, f64::INFINITY, 0.1, 0.1, 0.1];
    assert!(data.add(&model, [&six, &six, &six], &bad).is_err());
    assert!(data.add(&model, [&six, &bad, &six], &six).is_err());
    assert_eq!(data, Accumulator::new(&model));
    let few = fit(&model, &data).unwrap_err();
    assert!(few.to_string().contains("there are 0 states"), "{few}");
}

#[test]
fn columns_give_what_rows_give() {
    let (model, _) = arm("puma560");
    let (n, base, width) = (model.joints(), model.base(), model.columns().len());
    let states = states(&model, 300, 7);
    let mut rows = Accumulator::new(&model);
    for state in &states {
        rows.add_rows(&model, &state.y, &state.qdd).unwrap();
    }
    for count in [1, 7, 64, 129, 300] {
        let mut columns = Accumulator::new(&model);
        for part in states.chunks(count) {
            let columns_of = |entry: &dyn Fn(&State, usize) -> f64, entries: usize| -> Vec<f64> {
                let of = |e: usize| part.iter().map(move |state| entry(state, e));
                (0..entries).flat_map(of).collect()
            };
            let y = columns_of(&|state, e| state.y[e / base * width + e % base], n * base);
            let qd = columns_of(&|state, i| state.qd[i], n);
            let tau = columns_of(&|state, i| state.qdd[i], n);
            let added = columns.add_columns(&model, &y, &qd, &tau, part.len());
            added.unwrap();
        }
        assert_eq!(columns, rows, "{count} at once");
    }
    let mut columns = Accumulator::new(&model);
    let (y, one) = (vec![0.0; n * base], vec![0.0; n]);
    let short = columns.add_columns(&model, &y[1..], &one, &one, 1);
    let is_short = matches!(short, Err(Error::Length { argument: "y", .. }));
    assert!(is_short, "{short:?}");
    assert_eq!(columns.states(), 0);
}
