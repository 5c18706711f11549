//! D of a robot whose base floats in blocks: all entries of the matrix but zeros.

use dalembert_codegen::Plan;

use crate::certified::Certified;
use crate::limbs::TRUNK;
use crate::support::{Case, says};

/// Joints and what carries them: limbs a and b alternate, d follows c.
const JOINTS: [(&str, &str, &str); 7] = [
    ("a1", "trunk", ""),
    ("b1", "trunk", ""),
    ("a2", "a1", ""),
    ("c1", "trunk", ""),
    ("c2", "c1", ""),
    ("d1", "trunk", "mimic = { joint = \"c1\", multiplier = -1 }"),
    ("e1", "trunk", ""),
];

fn robot(scene: &str) -> String {
    let mut text = format!("name = \"blocks\"\ngravity = [0, 0, -9.81]\n{TRUNK}");
    for ((name, parent, more), number) in JOINTS.into_iter().zip(1..) {
        text += &format!(
            r#"
[[joint]]
name = "{name}"
parent = "{parent}"
kind = "revolute"
placement = {{ xyz = [0.1, 0.0{number}, 0] }}
axis = [0.6, 0, 0.8]
mass = 0.{number}
com = [0.01, 0.02, -0.0{number}]
inertia = [0.002, 0.003, 0.002, 1e-4, 0, 2e-4]
{more}
"#
        );
    }
    // A carrier that is the link before is the default.
    text = text.replace("parent = \"c1\"\n", "");
    text = text.replacen("parent = \"trunk\"\n", "", 1);
    match scene {
        "" => text,
        lines => format!("{text}\n[scene.test]\n{lines}\n"),
    }
}

/// The lines of a scene, and the coordinates of each limb in the order of results.
const SCENES: [(&str, &[&[usize]]); 4] = [
    ("", &[&[6, 7, 8], &[9, 10], &[11]]),
    ("lock = { b1 = 0.3 }", &[&[6, 8], &[9, 10], &[11]]),
    ("lock = { e1 = 0.3, c2 = 0.1 }", &[&[6, 7, 8], &[9]]),
    (
        "joints = [\"e1\", \"c2\", \"a2\", \"c1\"]",
        &[&[8], &[10, 9], &[11]],
    ),
];

#[test]
fn blocks_are_the_entries_of_the_matrix() {
    for (scene, limbs) in SCENES {
        let has_scene = !scene.is_empty();
        let in_scene = if has_scene { "scene: test; " } else { "" };
        let asked = format!("{in_scene}outputs: inertia, inertia_blocks; scalar: f64");
        let case = Case::read(&robot(scene), &asked);
        let generated = case.generated();
        let rows = &generated.functions[0].program.rows;
        let place = |row: usize| rows.iter().position(|other| *other == row).unwrap();
        let (_, states) = case.runtime(5, 3);
        for state in &states {
            let [d, blocks] = [0, 1].map(|index| generated.emitted[index].run(state));
            let entry = |i: usize, k: usize| d[place(i) * rows.len() + place(k)];
            let of_base = (0..6).flat_map(|i| (0..6).map(move |k| (i, k)));
            let joints = &rows[6..];
            let coupling = (0..6).flat_map(|i| joints.iter().map(move |k| (i, *k)));
            let of_limb =
                |limb: &'static [usize]| limb.iter().flat_map(|i| limb.iter().map(|k| (*i, *k)));
            let of_limbs = limbs.iter().copied().flat_map(of_limb);
            let places = of_base.chain(coupling).chain(of_limbs);
            let expected: Vec<f64> = places.map(|(i, k)| entry(i, k)).collect();
            assert_eq!(blocks.len(), expected.len(), "{scene}");
            for (found, expected) in blocks.iter().zip(&expected) {
                let off = (found - expected).abs();
                assert!(off <= 1e-15 * (1.0 + expected.abs()), "{scene}");
            }
            // Nothing else of D is more than zero.
            let left: usize = d.iter().filter(|entry| **entry != 0.0).count();
            let coupling = 6 * joints.len();
            let blocks = expected[36 + coupling..].iter();
            let within = blocks.filter(|entry| **entry != 0.0).count();
            assert!(left <= 36 + 2 * coupling + within, "{scene}");
        }
    }
}

/// The checker shows blocks of limbs of any length, in scenes, too, and none in another's place.
#[test]
fn blocks_are_shown() {
    for (scene, _) in SCENES {
        for language in ["rust", "c"] {
            let (in_scene, name) = match scene {
                "" => ("", None),
                _ => ("scene: test; ", Some("test")),
            };
            let asked =
                format!("{in_scene}outputs: inertia_blocks; scalar: f64; language: {language}");
            Certified::shown(&robot(scene), name, &asked, 1);
        }
    }
    let asked = "outputs: inertia_blocks; scalar: f64; language: c";
    let file = Certified::of(&robot(""), None, asked).remove(0);
    let table = "
#define BLOCKS_LIMBS {0, 3, 5, 6} → #define BLOCKS_LIMBS {0, 2, 5, 6}
#define BLOCKS_LIMBS {0, 3, 5, 6} → #define BLOCKS_LIMBS {0, 3, 5}
limbs[13] = → limbs[12] =
double limbs[BLOCKS_RESTRICT 14] → double limbs[BLOCKS_RESTRICT 13]
";
    file.refuses(table);
}

#[test]
fn a_plan_says_where_limbs_begin() {
    let case = Case::read(&robot(""), "outputs: inertia_blocks; scalar: f64");
    let generated = case.searched();
    let plan = case.plan(&generated);
    let again = case.by(&plan);
    assert_eq!(again.functions[0].program, generated.functions[0].program);
    let text = plan.write();
    says(&text, "\"limbs\":[1,4,6]");
    let other = text.replace("\"limbs\":[1,4,6]", "\"limbs\":[1,6]");
    assert!(Plan::parse(&other).is_err());
}
