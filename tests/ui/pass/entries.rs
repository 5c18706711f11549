//! More ways to call a function, by the clause.
dalembert::dynamics! {
    mod arm = "robots/planar2r.toml";
    outputs: gravity;
    entries: batch;
}

fn main() {
    let q = [[0.5, -0.3], [0.1, 2.0], [-1.0, 0.0]];
    let mut load = [[0.0; 2]; 3];
    arm::gravity_batch(&q, &mut load).unwrap();
    let lanes = arm::gravity_lanes(&[[0.5, 0.1, -1.0], [-0.3, 2.0, 0.0]]);
    for (l, (q, load)) in q.iter().zip(load).enumerate() {
        let (sin, cos) = (q.map(f64::sin), q.map(f64::cos));
        let given = arm::gravity_with_sincos(q, &sin, &cos);
        assert_eq!(load, arm::gravity(q));
        assert_eq!(load, [lanes[0][l], lanes[1][l]]);
        assert!(load.iter().zip(given).all(|(a, b)| (a - b).abs() < 1e-13));
    }
}
