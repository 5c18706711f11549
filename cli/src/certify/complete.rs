//! What a certificate says besides what its check reads.

use dalembert_codegen::certify::certificate::Certificate;
use serde_json::Value;

/// Characters of a field that a message shows.
const MOST_SHOWN: usize = 160;

/// Whether every field is what it is to be: those that follow from others, like
/// E, and those that every certificate has alike.
pub(super) fn complete(certificate: &Certificate, json: &Value) -> Result<(), String> {
    let again = serde_json::from_str::<Value>(&certificate.to_json());
    let again = again.map_err(|error| error.to_string())?;
    let empty = serde_json::Map::new();
    let (given, again) = (
        json.as_object().unwrap_or(&empty),
        again.as_object().unwrap_or(&empty),
    );
    for key in again.keys().chain(given.keys()) {
        if key == "method" && given.get(key).is_some_and(Value::is_string) {
            // How its maker found the bounds; here they were found anew.
            continue;
        }
        match (given.get(key), again.get(key)) {
            (Some(given), Some(again)) if alike(given, again) => {}
            (Some(given), Some(again)) => {
                return Err(format!(
                    "`{key}` is {}; from the rest of the certificate follows {}",
                    shown(given),
                    shown(again)
                ));
            }
            (None, _) => return Err(format!("`{key}` is missing")),
            (_, None) => return Err(format!("`{key}` is none of a certificate's fields")),
        }
    }
    Ok(())
}

/// Numbers by their values: 0 is 0.0.
fn alike(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => a.as_f64() == b.as_f64(),
        (Value::Array(a), Value::Array(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| alike(a, b))
        }
        (Value::Object(a), Value::Object(b)) => {
            let same = |(key, a): (&String, &Value)| b.get(key).is_some_and(|b| alike(a, b));
            a.len() == b.len() && a.iter().all(same)
        }
        _ => a == b,
    }
}

/// A value, or the beginning of it.
fn shown(value: &Value) -> String {
    let text = value.to_string();
    match text.char_indices().nth(MOST_SHOWN) {
        None => text,
        Some((end, _)) => format!("{}…", &text[..end]),
    }
}
