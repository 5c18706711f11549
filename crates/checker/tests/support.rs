//! Files of the repository.

use std::fs;

use dalembert_checker::certify::Demand;

pub fn file(path: &str) -> String {
    let path = format!("{}/../../{path}", env!("CARGO_MANIFEST_DIR"));
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// Returns a function of an arm of two joints, its claim and its robot, in whose scene `pick` it is
/// shown: an attack without the multiples of 2⁶¹ − 1 that were planted.
pub fn honest() -> [String; 3] {
    let names = ["A.rs.txt", "B.claim.json", "r2.toml"];
    let [text, claim, robot] =
        names.map(|name| file(&format!("crates/checker/tests/data/attacks/{name}")));
    let planted = ["230.5843009213694", "2305843009213693951/10000000000000000"];
    assert!(text.contains(planted[0]) && claim.contains(planted[1]));
    let text = text.replace(planted[0], "0.0");
    [text, claim.replace(planted[1], "0"), robot]
}

/// Demands of a user who names a scene.
pub fn in_scene(scene: &str) -> Demand<'_> {
    Demand {
        scene: Some(scene),
        ..Demand::default()
    }
}

/// A line of a table has words of the text, those in their place, and what is expected; `&` stands
/// for the words, and `; ` for the end of a line.
pub fn changed<'t>(text: &str, table: &'t str) -> Vec<(String, &'t str)> {
    let change = |row: &'t str| {
        let mut cells = row.split(" | ");
        let [from, to, expected] = std::array::from_fn(|_| cells.next().unwrap());
        assert!(text.contains(from), "{from}");
        let to = to.replace('&', from).replace("; ", "\n");
        (text.replacen(from, &to, 1), expected)
    };
    table.trim().lines().map(change).collect()
}
