//! Compares one robot by every way in: from a file, written in the macro, checked in as source,
//! and by the generic runtime.

use dalembert::number::Angle;
use dalembert::reference::Reference;
use nalgebra::DVector;

dalembert::dynamics! {
    mod file = "generated/robots/planar2r.toml";
    outputs: inverse_dynamics;
}

dalembert::dynamics! {
    mod alone = "generated/robots/planar2r.toml";
    outputs: inverse_dynamics;
    sincos: libm;
}

dalembert::dynamics! {
    mod planar2r = r#"
        name = "planar2r"
        convention = "standard"
        gravity = [0, -9.81, 0]
        [[joint]]
        name = "shoulder"
        kind = "revolute"
        a = 1
        mass = 1
        com = [-0.5, 0, 0]
        inertia = [0, 0.08333333333333333, 0.08333333333333333, 0, 0, 0]
        limits = { position = ["-pi", "pi"] }
        [[joint]]
        name = "elbow"
        kind = "revolute"
        a = 1
        mass = 1
        com = [-0.5, 0, 0]
        inertia = [0, 0.08333333333333333, 0.08333333333333333, 0, 0, 0]
        limits = { position = ["-180deg", "180deg"] }
    "#;
    outputs: inverse_dynamics;
}

#[test]
fn one_robot_by_every_way() {
    let source = include_str!("../generated/robots/planar2r.toml");
    let robot = dalembert::read::parse(source).unwrap().robot;
    assert_eq!(robot.joints[0].alpha, Angle::default());
    let runtime = Reference::<f64>::from_robot(&robot);
    for step in 0..100 {
        let at = |factor: f64| {
            let x = f64::from(step) * factor;
            [x.sin(), (1.3 * x).cos()]
        };
        let (q, qd, qdd) = (at(0.7), at(1.1), at(1.9));
        let tau = file::inverse_dynamics(&q, &qd, &qdd);
        let others = [
            planar2r::inverse_dynamics(&q, &qd, &qdd),
            dalembert_generated::planar2r::inverse_dynamics(&q, &qd, &qdd),
        ];
        // The files that are checked in call libm, too.
        assert_eq!(alone::inverse_dynamics(&q, &qd, &qdd), others[1]);
        let [q, qd, qdd] = [q, qd, qdd].map(|x| DVector::from_row_slice(&x));
        let reference = runtime.inverse_dynamics(&q, &qd, &qdd).unwrap();
        for (i, &torque) in tau.iter().enumerate() {
            for other in others {
                assert!((torque - other[i]).abs() < 1e-13 * (1.0 + torque.abs()));
            }
            assert!((torque - reference[i]).abs() < 1e-13 * (1.0 + torque.abs()));
        }
    }
}
