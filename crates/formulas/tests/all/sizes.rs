//! The number of terms of formulas, and their text.

use dalembert_formulas::{Digits, Formulas, Layout, Quantity, Request, Style, products};
use dalembert_model::read::parse;
use dalembert_model::robot::Robot;

use crate::values::read;

const COEFFICIENTS: [Quantity; 3] = [Quantity::Inertia, Quantity::Christoffel, Quantity::Gravity];

fn formulas(robot: &Robot, style: Style, quantities: &[Quantity]) -> Formulas {
    let quantities = quantities.to_vec();
    Formulas::new(robot, None, &Request { quantities, style }).unwrap()
}

/// Returns the terms of D_11, and of all distinct entries of D, h and c.
fn terms(path: &str) -> [usize; 4] {
    let (robot, _) = read(path);
    let formulas = formulas(&robot, Style::Numbers, &COEFFICIENTS);
    let lengths = |section: usize| {
        let lines = formulas.sections[section].lines.iter();
        lines.map(|line| line.sum.len())
    };
    let [d, h, c] = [0, 1, 2].map(|section| lengths(section).sum());
    [lengths(0).next().unwrap(), d, h, c]
}

/// The fewest terms of seven bases that were compared.
#[test]
fn entries_are_short() {
    let limits = [
        ("generated/robots/planar2r", [2, 5, 1, 3]),
        ("generated/robots/puma560", [20, 98, 181, 13]),
        ("generated/robots/stanford", [17, 77, 150, 10]),
        ("generated/robots/ur10", [18, 99, 157, 10]),
        ("codegen/tests/data/scara", [7, 27, 10, 1]),
    ];
    for (name, limit) in limits {
        assert_eq!(terms(&format!("{name}.toml")), limit, "{name}");
    }
}

#[test]
fn large_entries_are_written_by_rows() {
    let (robot, _) = read("generated/robots/panda.toml");
    let formulas = formulas(&robot, Style::Names, &COEFFICIENTS[..1]);
    assert!(formulas.sections[0].title.starts_with("Rows of the axes"));
    let lines = formulas.sections.iter().flat_map(|section| &section.lines);
    let sizes = lines.map(|line| products(&line.sum));
    let (total, largest) = (sizes.clone().sum::<usize>(), sizes.max());
    // Expanded they have 3069.
    assert!(total < 1313, "{total}");
    assert!(largest < Some(80), "{largest:?}");
}

const CRAIG: &str = r#"
name = "craig"
convention = "standard"
gravity = [0, -9.81, 0]
joint = [
    { kind = "revolute", a = 0.5, mass = 4.6, com = [0, 0, 0], inertia = [0, 0, 0, 0, 0, 0] },
    { kind = "revolute", a = 0.4, mass = 2.3, com = [0, 0, 0], inertia = [0, 0, 0, 0, 0, 0] },
]
"#;

/// Craig, Introduction to Robotics, section 6.7: point masses at the ends of two links.
#[test]
fn a_textbooks_arm_reads_as_in_the_book() {
    let robot = parse(CRAIG).unwrap().robot;
    let energies = [Quantity::Torque, Quantity::KineticEnergy];
    let quantities = [COEFFICIENTS.as_slice(), &energies].concat();
    let text = formulas(&robot, Style::Names, &quantities).write(Layout::Text, Digits::Six);
    let wanted = [
        "D_11 = a1²·m1 + a1²·m2 + 2·a1·a2·m2·C2 + a2²·m2",
        "D_12 = a1·a2·m2·C2 + a2²·m2",
        "D_22 = a2²·m2",
        "h_112 = h_122 = −h_211 = −a1·a2·m2·S2",
        "c_1 = g·a1·m1·C1 + g·a1·m2·C1 + g·a2·m2·C12",
        "c_2 = g·a2·m2·C12",
        "τ_2 = (a1·a2·m2·C2 + a2²·m2)·q̈1 + a2²·m2·q̈2 + a1·a2·m2·S2·q̇1² + g·a2·m2·C12",
        "joint 2: a2 = 0.4, m2 = 2.3",
    ];
    for line in wanted {
        assert!(text.lines().any(|other| other == line), "{line}\n{text}");
    }
}

/// Armstrong, Khatib and Burdick 1986 give 2·I5 = 0.744, I6 = 0.333, I7 = 0.298, I8 = 0.134,
/// I10 = −0.0213 and g2 = 8.44 for this arm; they follow with the centre of link 4 on the other side of its
/// frame, where the file has y = +0.019.
#[test]
fn constants_of_the_puma_are_the_published_ones() {
    let (mut robot, _) = read("generated/robots/puma560.toml");
    robot.joints[3].com[1] = -robot.joints[3].com[1].clone();
    let quantities = [Quantity::Inertia, Quantity::Gravity];
    let formulas = formulas(&robot, Style::Constants, &quantities);
    let constants = formulas.legend.constants.iter();
    let values: Vec<f64> = constants.map(|constant| constant.value.to_f64()).collect();
    assert_eq!(values.len(), 27);
    for published in [0.744, 0.333, 0.298, -0.0213 * 0.5, 8.44] {
        let near = |constant: &f64| {
            let ratio = constant.abs() / f64::abs(published);
            [0.5, 1.0, 2.0]
                .iter()
                .any(|x| (x * ratio - 1.0).abs() < 4e-3)
        };
        assert!(values.iter().any(near), "{published}: {values:?}");
    }
}

#[test]
fn every_format_and_style_is_deterministic() {
    let (robot, _) = read("generated/robots/stanford.toml");
    for style in Style::ALL {
        for layout in Layout::ALL {
            let write = |_| formulas(&robot, style, &Quantity::ALL).write(layout, Digits::All);
            let texts = [0, 1].map(write);
            assert_eq!(texts[0], texts[1]);
            assert!(!texts[0].contains("NaN"));
        }
    }
}
