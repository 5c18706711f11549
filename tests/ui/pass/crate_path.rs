#![deny(warnings)]
//! The facade under another name, as a library that re-exports it has it.

mod library {
    pub use dalembert as dynamics;
}

dalembert::dynamics! {
    mod arm = "robots/planar2r.toml";
    outputs: gravity;
    crate = crate::library::dynamics;
}

fn main() {
    assert!(arm::gravity(&[0.0, 0.0])[0] > 0.0);
}
