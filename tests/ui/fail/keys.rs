//! Keys and blocks of a robot.

// Joints are blocks called `joint`.
dalembert::dynamics! {
    mod joint_by_colon {
        convention: standard;
        gravity: [0, 0, -9.81];
        joint: { kind: revolute, a: 1, mass: 1, com: [-0.5, 0, 0], inertia: [0, 1/12, 1/12, 0, 0, 0] };
        link { kind: revolute, a: 1, mass: 1, com: [-0.5, 0, 0], inertia: [0, 1/12, 1/12, 0, 0, 0] }
    }
    outputs: gravity;
}

// At the name of the robot that lacks it.
dalembert::dynamics! {
    mod missing_gravity {
        convention: standard;
        joint { kind: revolute, a: 1, mass: 1, com: [-0.5, 0, 0], inertia: [0, 1/12, 1/12, 0, 0, 0] }
    }
    outputs: gravity;
}

// Commas and colons of a joint.
dalembert::dynamics! {
    mod missing_key_comma {
        convention: standard;
        gravity: [0, -9.81, 0];
        joint { kind: revolute a: 1, mass = 1, com: [0, 0, 0]; inertia: [0, 0, 1, 0, 0, 0] }
    }
    outputs: gravity;
}

// At the joint that lacks it; two joints for its callers.
dalembert::dynamics! {
    mod missing_mass {
        convention: standard;
        gravity: [0, -9.81, 0];
        joint { kind: revolute, a: 1, mass: 1, com: [-0.5, 0, 0], inertia: [0, 1/12, 1/12, 0, 0, 0] }
        joint { kind: revolute, com: [0, 0, 0], inertia: [0, 0, 1, 0, 0, 0] }
    }
    outputs: gravity;
}

// A robot without joints.
dalembert::dynamics! {
    mod no_joints {
        convention: standard;
        gravity: [0, -9.81, 0];
    }
    outputs: gravity;
}

// Clauses and robot: all of it at once.
dalembert::dynamics! {
    mod two_errors {
        convention: standard;
        gravity: [0, -9.81, 0];
        joint { kind: revolte, mass: 1, com: [0, 0, 0], inertia: [0, 0, 1, 0, 0, 0] }
        joint { kind: revolute, mass: -1, com: [0, 0, 0], inertia: [0, 0, 0, 0, 0, 0] }
    }
    outputs: gravitation;
    scalar: f16;
}

// Keys that a robot or a joint does not have.
dalembert::dynamics! {
    mod unknown_key {
        convention: standard;
        colour: red;
        gravity: [0, -9.81, 0];
        joint { kind: revolute, lenght: 1, mas: 1, com: [0, 0, 0], inertia: [0, 0, 1, 0, 0, 0] }
    }
    outputs: gravity;
}

fn main() {
    let _: [f64; 2] = missing_mass::gravity(&[0.0, 0.0]);
}
