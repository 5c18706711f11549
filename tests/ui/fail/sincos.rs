//! Where sines come from, and how exact they are.
dalembert::dynamics! {
    mod near {
        convention: standard;
        gravity: [0, -9.81, 0];
        joint { kind: revolute, a: 1, mass: 1, com: [-0.5, 0, 0], inertia: [0, 1/12, 1/12, 0, 0, 0] }
    }
    outputs: gravity;
    sincos: polynomials;
    sincos_error: 2;
}

dalembert::dynamics! {
    mod far {
        convention: standard;
        gravity: [0, -9.81, 0];
        joint { kind: revolute, a: 1, mass: 1, com: [-0.5, 0, 0], inertia: [0, 1/12, 1/12, 0, 0, 0] }
    }
    outputs: gravity;
    sincos: table;
    sincos_error: 1e-6;
}

dalembert::dynamics! {
    mod exact {
        convention: standard;
        gravity: [0, -9.81, 0];
        joint { kind: revolute, a: 1, mass: 1, com: [-0.5, 0, 0], inertia: [0, 1/12, 1/12, 0, 0, 0] }
    }
    outputs: gravity;
    sincos: polynomial;
    sincos_error: 1e-30;
}

fn main() {}
