//! From logs to a robot file, and logs that the fit has not seen.

use std::fs;
use std::path::Path;

use dalembert_fit::robot_file::save;
use dalembert_fit::{Error, consistent, cross_validation, disagreeing, identified};
use dalembert_model::read::parse;
use dalembert_model::robot::write;

use crate::support::{ARMS, TREES, accumulated, arm, fitted, near, noise, states};

#[test]
fn a_file_that_was_edited_stays() {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("saved.toml");
    let _ = fs::remove_file(&path);
    let robot = arm("puma560").0.robot().clone();
    // A file that is there is replaced as long as nobody edited it.
    for _ in 0..2 {
        save(&path, &robot).unwrap();
    }
    let text = fs::read_to_string(&path).unwrap();
    assert!(parse(&text).is_ok(), "{text}");
    for (contents, why) in [
        (text.clone() + "# mine\n", "edited"),
        (write(&robot), "no identification"),
    ] {
        fs::write(&path, &contents).unwrap();
        let error = save(&path, &robot).unwrap_err().to_string();
        assert!(error.contains(why), "{error}");
        assert_eq!(fs::read_to_string(&path).unwrap(), contents);
    }
    fs::write(&path, "").unwrap();
    save(&path, &robot).unwrap();
}

#[test]
fn the_new_robot_file_has_the_parameters() {
    for name in ARMS.into_iter().chain(["puma560_placed"]).chain(TREES) {
        let (model, right) = arm(name);
        let (data, free) = fitted(&model, &right, 400, [42, 41]);
        let bodies = consistent(&model, &free).unwrap();
        let text = write(&identified(&model, &bodies).unwrap());
        let read = parse(&text).unwrap();
        let again = crate::support::model(&read.robot);
        // Other masses: logs of one arm may be fitted from any file of it.
        assert_eq!(again.fingerprint(), model.fingerprint());
        for (k, wanted) in bodies.parameters.iter().enumerate() {
            let parameter = model.name(k);
            if !parameter.starts_with("offset") {
                near(again.parameters()[k], *wanted, 1e-9, &parameter);
            }
        }
        let after = data.residual(&model, &bodies.parameters).unwrap();
        for (i, after) in after.iter().enumerate() {
            assert!(*after < 1.15 * noise(i), "{name}: {after}");
        }
    }
}

#[test]
fn logs_that_were_left_out_are_predicted() {
    let (model, right) = arm("panda");
    let logged = |file: u64, parameters: &[f64]| {
        let states = states(&model, 300, 60 + file);
        accumulated(&model, &states, parameters, Some(50 + file))
    };
    let files: Vec<_> = (0..4).map(|file| logged(file, &right)).collect();
    let residuals = cross_validation(&model, &files).unwrap();
    assert_eq!(residuals.len(), 4);
    for file in &residuals {
        for (i, after) in file.after.iter().enumerate() {
            let part = after / noise(i);
            assert!((0.8..1.2).contains(&part), "{part}");
            assert!(file.before[i] > 2.0 * after);
        }
    }
    assert_eq!(disagreeing(&model, &files, &residuals), Ok(Vec::new()));
    // The third arm carries something that the others do not.
    let mut other = files.clone();
    let carrying: Vec<f64> = right.iter().map(|x| 1.2 * x).collect();
    other[2] = logged(2, &carrying);
    let other_residuals = cross_validation(&model, &other).unwrap();
    let named = disagreeing(&model, &other, &other_residuals).unwrap();
    assert_eq!(named.iter().map(|one| one.file).collect::<Vec<_>>(), [2]);
    assert!(named[0].others > 2.0 * named[0].self_fit, "{named:?}");
    let pair_residuals = cross_validation(&model, &other[1..3]).unwrap();
    let named = disagreeing(&model, &other[1..3], &pair_residuals).unwrap();
    assert_eq!(named.len(), 2, "of two, either may be wrong");
    let one = cross_validation(&model, &files[..1]);
    assert_eq!(one, Err(Error::OneFile));
}
