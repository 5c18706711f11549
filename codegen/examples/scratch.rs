use dalembert_codegen::generate::*;
use dalembert_model::read;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    for r in args[1].split(',') {
        let src = std::fs::read_to_string(format!("generated/robots/{r}.toml")).unwrap();
        let robot = read::parse(&src, &Default::default())
            .unwrap_or_else(|e| panic!("{e}"))
            .robot;
        let t0 = std::time::Instant::now();
        let g = generate(&robot, &Request::default()).unwrap_or_else(|e| panic!("{e}"));
        eprintln!("{r} {:?}", t0.elapsed());
        for f in &g.functions {
            eprintln!("{} {:?} {}", f.function, f.formulation, f.counts);
            for s in &f.stages {
                eprint!("{s}; ");
            }
            eprintln!();
        }
        println!("{}", g.text);
    }
}
