//! Outputs that are generated only if they are named, in a scene.

use dalembert_codegen::workspace::{Runtime, testing::seeded};
use dalembert_codegen::{Function, Request, generate};
use dalembert_model::scene::Scene;

use crate::robots as support;

#[test]
fn scenes_select_along_axes_over_joints() {
    let robot = support::robot("planar3r");
    let scene = Scene {
        name: "pick".into(),
        joints: Some(vec![2, 0]),
        ..Scene::default()
    };
    let request = Request {
        functions: Function::of(&robot)[6..].to_vec(),
        scene: Some(scene),
        ..Request::default()
    };
    let generated = generate(&robot, &request).unwrap_or_else(|error| panic!("{error}"));
    let whole = Runtime::new(&robot);
    let state = &seeded(&robot, 1, 7)[0];
    for emitted in &generated.emitted {
        let full = whole.run(emitted.function, state);
        let results = emitted.run(state);
        let (mut start, mut at) = (0, 0);
        for quantity in emitted.function.quantities() {
            let sizes = emitted.sizes;
            let full_sizes = sizes.over_all(3);
            for index in 0..quantity.len(sizes) {
                let name = quantity.entry(index, &[2, 0], sizes);
                let same = |i: &usize| quantity.entry(*i, &[0, 1, 2], full_sizes) == name;
                let i = (0..quantity.len(full_sizes)).find(same).unwrap();
                let (a, b) = (results[at + index], full[start + i]);
                let u = emitted.scalar.unit_roundoff();
                let error = (a - b).abs() / full.iter().fold(1.0f64, |m, x| m.max(x.abs()));
                assert!(error < 100.0 * u, "{} {name}: {a} {b}", emitted.function);
            }
            (start, at) = (start + quantity.len(full_sizes), at + quantity.len(sizes));
        }
    }
}
