//! Functions of many states, by the clause.
dalembert::dynamics! {
    mod arm = "robots/planar2r.toml";
    outputs: gravity;
    batch: on;
}

fn main() {
    let q = [[0.5, 0.1, -1.0], [-0.3, 2.0, 0.0]];
    let [mut shoulder, mut elbow] = [[0.0; 3]; 2];
    arm::gravity_columns(&[&q[0], &q[1]], &mut [&mut shoulder, &mut elbow]).unwrap();
    for s in 0..3 {
        assert_eq!([shoulder[s], elbow[s]], arm::gravity(&[q[0][s], q[1][s]]));
    }
}
