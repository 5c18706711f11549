use dalembert_codegen::{function::Function, graph::Folding, portfolio::*, schedule::Program, simplify::*, trace::trace, verify::exact::prove};
use dalembert_model::{equations::Formulation, read};
fn main() {
    let args: Vec<String> = std::env::args().collect();
    for r in args[1].split(',') {
        let src = std::fs::read_to_string(format!("/work/main/generated/robots/{r}.toml")).unwrap();
        let robot = read::parse(&src, &Default::default()).unwrap_or_else(|e| panic!("{e}")).robot;
        for f in Function::ALL {
            let t0 = std::time::Instant::now();
            let graphs = tuned(&robot, f, 3);
            let t1 = t0.elapsed();
            let s = graphs[0].rebuild(Folding::Semantic);
            for g in &graphs { let p = Program::new(f, robot.joints.len(), &g.rebuild(Folding::Semantic)); if let Err(e) = prove(&robot, &p) { println!("  {e}"); } }
            let g = simplify(&graphs, Effort::Quick).unwrap();
            println!("{r} {f} tuned {} ({}) {:?} -> {} ({}) {:?}", s.counts(), s.counts().operations(), t1, g.graph.counts(), g.graph.counts().operations(), t0.elapsed());
            let _ = (trace, Formulation::ALL);
        }
    }
}
