//! A file that reads, of a body that cannot be, under a gravity in feet: said at
//! the file's name, to whoever lets no warning pass.
#![deny(deprecated)]
dalembert::dynamics! {
    mod arm = "robots/odd.toml";
    outputs: gravity;
}

fn main() {}
