//! Tables on standard output.

pub(super) fn table<const N: usize>(head: [&str; N], rows: Vec<[String; N]>) -> String {
    let mut all = vec![head.map(str::to_owned)];
    all.extend(rows);
    let width = |k: usize| all.iter().map(|row| row[k].chars().count()).max();
    let widths: Vec<usize> = (0..N).map(|k| width(k).unwrap_or(0)).collect();
    let mut text = String::new();
    for row in &all {
        let cells = row.iter().zip(&widths).enumerate();
        let cells: Vec<String> = cells
            .map(|(k, (cell, width))| match k {
                0 => format!("{cell:width$}"),
                _ => format!("{cell:>width$}"),
            })
            .collect();
        text += cells.join("  ").trim_end();
        text.push('\n');
    }
    text
}

pub(super) fn number(x: f64) -> String {
    let size = x.abs();
    match size {
        _ if !x.is_finite() => x.to_string(),
        0.0 => "0".to_owned(),
        _ if !(1e-4..1e6).contains(&size) => format!("{x:.3e}"),
        _ => {
            let digits = (3 - libm::floor(libm::log10(size)) as i32).clamp(0, 7);
            format!("{x:.*}", digits as usize)
        }
    }
}
