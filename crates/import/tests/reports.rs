//! Small files with one fault each, after public reports. `data/reports/expected.json` has for each
//! the torques at one state, computed by an independent program, its `source`: `mj_inverse` of
//! MuJoCo without constraints and springs, or `rnea` of Pinocchio plus damping times velocity and
//! armature times acceleration. Where a fault cannot be expressed, a message has to name it.

use dalembert_import::{Import, Options, open};
use dalembert_model::read::Diagnostic;
use dalembert_model::reference::Reference;
use serde_json::Value;

use crate::support::{data, flat, path, relative, vector, words};

fn options(case: &Value) -> Options {
    let mut options = Options::default();
    let mut words = words(&case["options"]).into_iter().map(str::to_owned);
    while let Some(option) = words.next() {
        match option.as_str() {
            "--exact" => options.exact = true,
            "--tip" => options.tips.extend(words.next()),
            "--without" => options.without.extend(words.next()),
            _ => panic!("{option}"),
        }
    }
    options
}

fn off(imported: &Import, case: &Value) -> f64 {
    let runtime = Reference::<f64>::from_robot(&imported.robot);
    let [q, qd, qdd] = ["q", "qd", "qdd"].map(|key| vector(case, key));
    let torques = runtime.inverse_dynamics(&q, &qd, &qdd).unwrap();
    relative(torques.as_slice(), &flat(&case["tau"]))
}

fn names(messages: &[Diagnostic], case: &Value) -> bool {
    words(&case["words"]).into_iter().any(|word| {
        let says = |text: &str| text.contains(word);
        let help = |message: &Diagnostic| message.help.as_deref().is_some_and(says);
        let mut messages = messages.iter();
        messages.any(|message| says(&message.message) || help(message))
    })
}

#[test]
fn what_a_file_says_is_read_or_said_to_be_left_out() {
    let cases: Value = serde_json::from_str(&data("reports/expected.json")).unwrap();
    let mut wrong = Vec::new();
    for case in cases.as_array().unwrap() {
        let file = case["file"].as_str().unwrap();
        let opened = open(&path(&format!("reports/{file}")), &options(case));
        let imported = opened.map(|opened| opened.imported.unwrap());
        let is_right = match (case["want"].as_str().unwrap(), imported) {
            ("value", Ok(imported)) => off(&imported, case) < 1e-12,
            ("toml", Ok(imported)) => imported.text.contains(case["pattern"].as_str().unwrap()),
            ("word", Ok(imported)) => names(&imported.notes, case),
            ("word", Err(error)) => {
                let text = format!("{error:?}");
                words(&case["words"]).iter().any(|word| text.contains(word))
            }
            (_, Ok(_)) => false,
            (_, Err(error)) => panic!("{file}: {error:?}"),
        };
        if !is_right {
            wrong.push(file);
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}
