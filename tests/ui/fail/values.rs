//! Values in a robot.

// Angles of no form that there is.
dalembert::dynamics! {
    mod bad_angle {
        convention: standard;
        gravity: [0, -9.81, 0];
        joint { kind: revolute, alpha: pi/0, offset: 90rad, mass: 1, com: [-0.5, 0, 0], inertia: [0, 1/12, 1/12, 0, 0, 0] }
        joint { kind: revolute, alpha: pie/2, offset: pi*2, mass: 1, com: [-0.5, 0, 0], inertia: [0, 1/12, 1/12, 0, 0, 0] }
    }
    outputs: gravity;
}

// A block in a joint.
dalembert::dynamics! {
    mod limits {
        convention: standard;
        gravity: [0, -9.81, 0];
        joint { kind: revolute, mass: 1, com: [-0.5, 0, 0], inertia: [0, 1/12, 1/12, 0, 0, 0], limits: { position: [1, -1], speed: 3 } }
    }
    outputs: gravity;
}

// A word that robot files have.
dalembert::dynamics! {
    mod misspelt_kind {
        convention: standard;
        gravity: [0, -9.81, 0];
        joint { kind: revolut, a: 1, mass: 1, com: [-0.5, 0, 0], inertia: [0, 1/12, 1/12, 0, 0, 0] }
    }
    outputs: gravity;
}

// What no robot may be is said at its token.
dalembert::dynamics! {
    mod negative_mass {
        convention: standard;
        gravity: [0, -9.81, 0];
        joint { kind: revolute, mass: -17.4, com: [0, 0, 0], inertia: [0, 0, 0, 0, 0, 0] }
    }
    outputs: gravity;
}

// Numbers that are none, infinite, hexadecimal, too large.
dalembert::dynamics! {
    mod not_finite {
        convention: standard;
        gravity: [0, -9.81, 0];
        joint { kind: revolute, mass: NaN, com: [-inf, 0, 0], inertia: [0, 0, 0x10, 0, 1e999, 0] }
    }
    outputs: gravity;
}

// The variable of a joint has no constant of its own name.
dalembert::dynamics! {
    mod prismatic_with_d {
        convention: standard;
        gravity: [0, -9.81, 0];
        joint { kind: prismatic, d: 0.3, mass: 1, com: [-0.5, 0, 0], inertia: [0, 1/12, 1/12, 0, 0, 0] }
    }
    outputs: gravity;
}

// Numbers as Rust has them, but not robots.
dalembert::dynamics! {
    mod typed_number {
        convention: standard;
        gravity: [0, -9.81, 0];
        joint { kind: revolute, mass: 1.5f64, com: [1., 0, .5], inertia: [0, 0, 0, 0, 0, 0] }
    }
    outputs: gravity;
}

// Arrays too short.
dalembert::dynamics! {
    mod wrong_length {
        convention: standard;
        gravity: [-9.81];
        joint { kind: revolute, mass: 1, com: [-0.5, 0], inertia: [0, 1, 1] }
    }
    outputs: gravity;
}

fn main() {
    let _: [f64; 1] = misspelt_kind::gravity(&[0.0]);
}
