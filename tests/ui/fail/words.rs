//! Words of a clause, and numbers.

// A word twice in a list.
dalembert::dynamics! {
    mod duplicate_output = "robots/planar2r.toml";
    outputs: gravity, inertia, gravity;
    scalar: f32, f32;
}

// Slips, of which the word that was meant is suggested; a list where one word stands; a number.
dalembert::dynamics! {
    mod slips = "robots/planar2r.toml";
    outputs: inverse_dynamics, gravty;
    effort: quick, thorough;
    fma: yes;
    sincos: polynomials;
    sincos_error: 2;
    parameters: paylod, gravity;
}

// What is wrong with a clause as a whole.
dalembert::dynamics! {
    mod sincos_far = "robots/planar2r.toml";
    outputs: gravity;
    sincos: table;
    sincos_error: 1e-6;
}

// What cannot be generated, at the item that asks for it.
dalembert::dynamics! {
    mod unknown_parameter = "robots/planar2r.toml";
    outputs: gravity, reaction_wrenches;
    parameters: payload;
}

dalembert::dynamics! {
    mod sincos_exact = "robots/planar2r.toml";
    outputs: inverse_dynamics;
    sincos: polynomial;
    sincos_error: 1e-20;
}

fn main() {}
