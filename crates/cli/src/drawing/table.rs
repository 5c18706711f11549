//! The DH rows, masses and centres of mass as lines of text.

use dalembert_model::number::parse::write_decimal;
use dalembert_model::number::{Angle, Rational, Rounded};

use dalembert_model::robot::{
    Convention, FloatingBase, Inertia, Joint, JointKind, Placed, Placement, Robot,
};

use crate::report::{Cell, Table};

/// Lists the rows of the robot, and what is wrong with its bodies.
pub(crate) fn lines(robot: &Robot, q: &[f64]) -> Vec<String> {
    let convention = match robot.convention {
        _ if robot.is_tree() => "joints are placed on the links that carry them",
        Convention::Standard => "standard DH",
        Convention::Modified => "modified DH (Craig)",
    };
    let gravity = list(&robot.gravity);
    let values = q.iter().map(|&q| short(Some(q.to_string()), 7, q));
    let at = Vec::from_iter(values).join(", ");
    let axes = match robot.floating {
        Some(_) => " of the world",
        None => "",
    };
    let mut lines = vec![
        format!("{convention}, gravity{axes} {gravity} m/s², lengths in m, masses in kg"),
        format!("drawn at q = ({at})"),
    ];
    for (what, end) in robot.placements() {
        lines.extend(end.map(|end| placement(what, end)));
    }
    let heads = match robot.is_tree() {
        true => "joint|carried by|xyz|rpy|axis|mass|centre of mass",
        false => "joint|theta|d|a|alpha|mass|centre of mass",
    };
    let joints = robot.joints.iter().enumerate();
    let base = robot.floating.iter();
    let base = base.map(|base| floating(base).map(Cell::from).to_vec());
    let rows = joints.map(|(i, joint)| match &joint.place {
        None => row(i, joint).map(Cell::from).to_vec(),
        Some(place) => placed(robot, i, place).map(Cell::from).to_vec(),
    });
    let rows = base.chain(rows);
    let table = Table::new(heads).with(rows).unbroken().to_string();
    lines.extend(table.lines().map(|line| line.trim_start().to_owned()));
    // Below the table, because such a sentence does not fit beside it.
    let defect = |label: &str, inertia: &Inertia<Rational>, mass: &Rational| {
        let why = inertia.defect(mass)?.message();
        Some(format!("{label}: {why}"))
    };
    let base = robot.floating.as_ref();
    lines.extend(base.and_then(|base| defect("the base", &base.inertia, &base.mass)));
    for (label, joint) in (1..).zip(&robot.joints) {
        lines.extend(defect(
            &format!("joint {label}"),
            &joint.inertia,
            &joint.mass,
        ));
    }
    lines
}

fn row(index: usize, joint: &Joint) -> [String; 7] {
    let plus = |constant: String| match constant.as_str() {
        "0" => format!("q{}", index + 1),
        constant => format!("q{} + {constant}", index + 1),
    };
    let (theta, d) = match joint.kind {
        JointKind::Revolute => (plus(angle(&joint.theta)), number(&joint.d)),
        JointKind::Prismatic => (angle(&joint.theta), plus(number(&joint.d))),
    };
    let name = joint.name.as_deref().unwrap_or_default();
    let twist = match joint.beta.is_zero() {
        true => angle(&joint.alpha),
        false => format!("{}, beta {}", angle(&joint.alpha), angle(&joint.beta)),
    };
    [
        format!("{} {name}", index + 1).trim_end().to_owned(),
        theta,
        d,
        number(&joint.a),
        twist,
        number(&joint.mass),
        list(&joint.com),
    ]
}

fn floating(base: &FloatingBase) -> [String; 7] {
    let name = base.name.as_deref().unwrap_or("base");
    let [xyz, rpy, axis] = [""; 3].map(str::to_owned);
    [
        name.to_owned(),
        "nothing: it floats".to_owned(),
        xyz,
        rpy,
        axis,
        number(&base.mass),
        list(&base.com),
    ]
}

fn placed(robot: &Robot, index: usize, place: &Placed) -> [String; 7] {
    let joint = &robot.joints[index];
    let name = joint.name.as_deref().unwrap_or_default();
    let row = robot.carrier(robot.row_of(index));
    let carrier = row.map(|row| robot.rows()[row].name.clone());
    [
        format!("{} {name}", index + 1).trim_end().to_owned(),
        carrier.map_or_else(|| "base".to_owned(), Option::unwrap_or_default),
        list(&place.placement.xyz),
        angles(&place.placement.rpy),
        list(&place.axis),
        number(&joint.mass),
        list(&joint.com),
    ]
}

fn placement(what: &str, placement: &Placement) -> String {
    let (xyz, rpy) = (list(&placement.xyz), angles(&placement.rpy));
    format!("{what}: xyz {xyz}, rpy {rpy}")
}

fn list(numbers: &[Rational; 3]) -> String {
    format!("({})", numbers.each_ref().map(number).join(", "))
}

fn angles(angles: &[Angle; 3]) -> String {
    format!("({})", angles.each_ref().map(angle).join(", "))
}

fn number(value: &Rational) -> String {
    short(write_decimal(value), 10, f64::nearest_rational(value))
}

fn angle(value: &Angle) -> String {
    short(Some(value.to_string()), 10, value.to_f64())
}

fn short(text: Option<String>, most: usize, value: f64) -> String {
    let short = text.filter(|text| text.len() <= most);
    short.unwrap_or_else(|| six(value))
}

fn six(value: f64) -> String {
    let text = format!("{value:.5e}");
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let digits = digits.trim_end_matches('0').trim_end_matches('.');
    match exponent {
        "0" => digits.to_owned(),
        "-1" | "-2" | "-3" | "1" | "2" | "3" => format!("{value:.6}"),
        _ => format!("{digits}e{exponent}"),
    }
}
