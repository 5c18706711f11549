#![deny(warnings)]
//! The module is as visible as it says, and has the attributes above it.

mod robots {
    dalembert::dynamics! {
        pub(crate) mod visible = "robots/planar2r.toml";
        outputs: gravity;
        scalar: f32;
    }

    dalembert::dynamics! {
        #[cfg(any())]
        mod absent = "robots/planar2r.toml";
        outputs: gravity;
    }

    /// A function of a private module.
    pub fn load(q: f64) -> f64 {
        private::gravity(&[q, 0.0])[0]
    }

    dalembert::dynamics! {
        mod private = "robots/planar2r.toml";
        outputs: gravity;
    }
}

fn main() {
    // Asked for alone, an f32 module keeps the plain name.
    let load: [f32; 2] = robots::visible::gravity(&[0.0, 0.0]);
    assert!((f64::from(load[0]) - robots::load(0.0)).abs() < 1e-5);
}
