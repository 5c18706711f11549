use dalembert_codegen::{
    function::Function, graph::Folding, schedule::Program, trace::trace, verify::exact::prove,
};
use dalembert_model::{equations::Formulation, read};
fn main() {
    for r in [
        "puma560", "stanford", "ur10", "panda", "planar3r", "planar2r",
    ] {
        let src = std::fs::read_to_string(format!("generated/robots/{r}.toml")).unwrap();
        let robot = read::parse(&src, &Default::default())
            .unwrap_or_else(|e| panic!("{e}"))
            .robot;
        for f in Function::ALL {
            for form in [
                Formulation::LagrangeEuler,
                Formulation::Dalembert,
                Formulation::NewtonEulerLink,
            ] {
                let t0 = std::time::Instant::now();
                let t = trace(&robot, f, form);
                let t1 = t0.elapsed();
                let s = t.graph.rebuild(Folding::Semantic);
                let t2 = t0.elapsed();
                let p = Program::new(f, robot.joints.len(), &s);
                let proof = prove(&robot, &p);
                println!(
                    "{r} {f} {form:?} traced {} folded {} sem {} ({:?} {:?} {:?}) {}",
                    t.traced,
                    t.graph.counts(),
                    s.counts(),
                    t1,
                    t2,
                    t0.elapsed(),
                    match proof {
                        Ok(p) => p.to_string(),
                        Err(e) => e.to_string(),
                    }
                );
            }
        }
    }
}
