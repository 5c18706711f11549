//! Words of a clause, and numbers.

// A word twice in a list.
dalembert::dynamics! {
    mod duplicate_output = "robots/planar2r.toml";
    outputs: gravity, inertia, gravity;
    scalar: f32, f32;
}

// A slip in a choice.
dalembert::dynamics! {
    mod unknown_entries = "robots/planar2r.toml";
    outputs: gravity, manipulator_equation;
    batch: onn;
}

dalembert::dynamics! {
    mod unknown_entries_other = "robots/planar2r.toml";
    outputs: gravity;
    batch: simd;
}

// A word that is no choice.
dalembert::dynamics! {
    mod unknown_fma = "robots/planar2r.toml";
    outputs: gravity;
    fma: yes;
}

// Clauses that take one word of a few.
dalembert::dynamics! {
    mod unknown_formulation = "robots/planar2r.toml";
    outputs: gravity;
    formulation: newton;
    effort: quick, thorough;
}

// The word that was meant is suggested.
dalembert::dynamics! {
    mod unknown_output = "robots/planar2r.toml";
    outputs: inverse_dynamics, gravty;
}

// Slips in the parameters.
dalembert::dynamics! {
    mod unknown_parameter = "robots/planar2r.toml";
    outputs: gravity;
    parameters: paylod, gravity;
}

dalembert::dynamics! {
    mod unknown_parameter_other = "robots/planar2r.toml";
    outputs: gravity, reaction_wrenches;
    parameters: payload;
}

// A scalar that there is not.
dalembert::dynamics! {
    mod unknown_scalar = "robots/planar2r.toml";
    outputs: gravity;
    scalar: f46;
}

// Where sines come from, and how exact they are.
dalembert::dynamics! {
    mod sincos_near = r#"
        name = "sincos_near"
        convention = "standard"
        gravity = [0, -9.81, 0]
        [[joint]]
        kind = "revolute"
        a = 1
        mass = 1
        com = [-0.5, 0, 0]
        inertia = [0, "1/12", "1/12", 0, 0, 0]
    "#;
    outputs: gravity;
    sincos: polynomials;
    sincos_error: 2;
}

dalembert::dynamics! {
    mod sincos_far = r#"
        name = "sincos_far"
        convention = "standard"
        gravity = [0, -9.81, 0]
        [[joint]]
        kind = "revolute"
        a = 1
        mass = 1
        com = [-0.5, 0, 0]
        inertia = [0, "1/12", "1/12", 0, 0, 0]
    "#;
    outputs: gravity;
    sincos: table;
    sincos_error: 1e-6;
}

dalembert::dynamics! {
    mod sincos_exact = r#"
        name = "sincos_exact"
        convention = "standard"
        gravity = [0, -9.81, 0]
        [[joint]]
        kind = "revolute"
        a = 1
        mass = 1
        com = [-0.5, 0, 0]
        inertia = [0, "1/12", "1/12", 0, 0, 0]
    "#;
    outputs: gravity;
    sincos: polynomial;
    sincos_error: 1e-30;
}

fn main() {}
