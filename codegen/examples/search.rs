use dalembert_codegen::{emit::ScalarType, function::Function, generate::*, simplify::Effort};
use dalembert_model::read;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let effort = Effort::from_name(&args[3]).unwrap();
    for r in args[1].split(',') {
        let src = std::fs::read_to_string(format!("/work/main/generated/robots/{r}.toml"))
            .or_else(|_| std::fs::read_to_string(r))
            .unwrap();
        let robot = read::parse(&src, &Default::default())
            .unwrap_or_else(|e| panic!("{e}"))
            .robot;
        for f in args[2].split(',').map(|x| Function::from_name(x).unwrap()) {
            let t0 = std::time::Instant::now();
            let g = generate(
                &robot,
                &Request {
                    functions: vec![f],
                    scalars: vec![ScalarType::F64],
                    effort,
                    ..Default::default()
                },
            )
            .unwrap_or_else(|e| panic!("{e}"));
            let f = &g.functions[0];
            println!(
                "{r} {} {} | {} {} | {:?}",
                f.function,
                f.stages
                    .iter()
                    .map(|s| s.counts.operations().to_string())
                    .collect::<Vec<_>>()
                    .join(" "),
                f.counts.operations(),
                f.counts,
                t0.elapsed()
            );
        }
    }
}
