//! What of an MJCF is refused, by name, with its line and what to do about it; and files
//! that are meant to do harm.

use std::path::Path;

use crate::support::{has, refused, to};
use dalembert_import::{Options, Text, import, import_text};

const ARM: &str = r#"<mujoco model="arm">
  <compiler angle="radian"/>
  <default> <default class="drive"> <joint armature="0.1"/> </default> </default>
  <worldbody>
    <body name="upper" pos="0 0 0.3">
      <inertial pos="0 0 0.1" mass="2" diaginertia="0.02 0.03 0.04"/>
      <joint name="turn" class="drive" axis="0 0 1" range="-1 2"/>
      <body name="lower" pos="0.3 0 0" quat="1 0 0 0">
        <inertial pos="0 0 0" mass="1" diaginertia="0.02 0.02 0.02"/>
        <joint name="reach" type="slide" axis="1 0 0"/>
        <body name="hand" pos="0.1 0 0">
          <inertial pos="0 0 0" mass="0.1" diaginertia="1e-4 1e-4 1e-4"/>
          <site name="grip"/>
          <body name="thumb">
            <inertial pos="0 0 0.01" mass="0.1" diaginertia="1e-4 1e-4 1e-4"/>
            <joint name="finger" type="slide" axis="0 1 0" range="0 0.04"/>
          </body>
        </body>
      </body>
    </body>
  </worldbody>
</mujoco>
"#;

fn at_the_hand() -> Options {
    to("hand", &[("*", "0")])
}

fn with(what: &str, by: &str) -> String {
    assert!(ARM.contains(what), "{what}");
    ARM.replacen(what, by, 1)
}

#[test]
fn the_arm_itself_is_taken() {
    let imported = import(ARM, &at_the_hand()).unwrap();
    assert_eq!(imported.robot.joints.len(), 2);
    has(&imported.text, &["\narmature = 0.1\n"]);
    let at_the_site = import(ARM, &to("grip", &[("*", "0")]));
    has(&at_the_site.unwrap().text, &["to link grip of"]);
}

/// What of the arm is replaced by what, and below it words of what is said.
const REFUSED: &str = r#"
</mujoco> => <tendon><fixed name="pull"><joint joint="reach" coef="1"/><joint joint="turn" coef="1"/></fixed></tendon></mujoco>
joint `turn` of the chain is tied by fixed tendon `pull` | --lock turn=0
</mujoco> => <equality><joint joint1="reach" joint2="turn" polycoef="0 0.5"/></equality></mujoco>
arm.urdf:22:11 | joint `reach` of the chain mimics `turn` | --lock reach=0
</mujoco> => <equality><joint joint1="reach"/></equality></mujoco>
joint `reach` of the chain is tied by equality
</mujoco> => <equality><joint joint1="finger" joint2="reach"/></equality></mujoco>
joint `finger` hangs on the chain and follows `reach`, which moves | --lock finger=0
</mujoco> => <equality><joint joint1="rech"/></equality></mujoco>
there is no joint `rech` | did you mean `reach`?
</muj => <equality><joint joint1="reach" joint2="turn" polycoef="0 1 2 3 4 5"/></equality></muj
`polycoef` has more than 5 numbers
</mujoco> => <equality><weld body1="hand"/></equality></mujoco>
equality `weld` ties `hand` and `world`, which move apart | closed loops
</mujoco> => <equality><connect body1="upper" body2="hand" anchor="0 0 0"/></equality></mujoco>
ties `upper` and `hand`
type="slide" axis="1 0 0" => type="ball"
arm.urdf:10 | joint `reach` of the chain is a ball | --base lower
type="slide" axis="1 0 0" => type="screw"
`screw` is no type of joint | known: hinge
<body name="lower" => <body name="lower" euler="0 0 0"
an orientation by `quat` and by `euler` | one of them
quat="1 0 0 0" => quat="0 0 0 0"
arm.urdf:8: | `quat` has no direction
quat="1 0 0 0" => quat="1 0 0"
`quat` has 3 numbers, not 4
quat="1 0 0 0" => xyaxes="1 0 0 2 0 0"
`xyaxes` has no direction | parallel
mass="2" => mass="two"
arm.urdf:6: | `two` is not a decimal number
mass="2" =>
<inertial> has no `mass`
mass="2" => mass="-2"
the mass of body `upper` is negative
0.02 0.03 0.04 => 0.02 -0.03 0.04
a moment of inertia of body `upper` is negative
diaginertia="0.02 0.03 0.04" => diaginertia="1 1 1" fullinertia="1 1 1 0 0 0"
body `upper` has two inertias
range="-1 2" => range="2 -1"
the limits of joint `turn` are reversed
axis="0 0 1" => axis="0 0 0"
the axis of joint `turn` has no direction
<joint name="turn" class="drive" => <joint name="turn" class="drve"
arm.urdf:7: | there is no class `drve` | did you mean `drive`?
<default class="drive"> => <default class="drive"/> <default class="drive">
there is a class `drive` already
<joint name="turn" class="drive" => <joint name="turn" damping="-1"
the damping of joint `turn` is negative
<joint name="finger" => <joint name="turn"
there is a joint `turn` already
<body name="thumb" => <body name="hand"
there is a body `hand` already
angle="radian" => angle="grad"
`angle` is `grad` | radian or degree
angle="radian" => eulerseq="xyw"
`eulerseq` is `xyw`
angle="radian" => coordinate="global"
`coordinate` is `global`
angle="radian" => settotalmass="3" boundmass="0.5"
`settotalmass` is of bodies whose masses are not all known
</mujoco> => <tendon><fixed limited="true" range="3 4"><joint joint="turn" coef="1"/></fixed></tendon></mujoco>
the tendon leaves joint `turn` no position within its limits
</mujoco> => <tendon><fixed><joint joint="trn" coef="1"/></fixed></tendon></mujoco>
there is no joint `trn` | did you mean `turn`?
angle="radian" => boundmass="0.5"
`boundmass` of the compiler is more than body `hand` has
<site name="grip"/> => <attach model="m" body="b"/>
<attach> on body `hand` is not read
<inertial pos="0 0 0" mass="1" diaginertia="0.02 0.02 0.02"/> => <geom type="mesh" mesh="m"/>
the mass of body `lower` is that of its geoms | mj_saveLastXML
<compiler angle="radian"/> => <include file="other.xml"/>
<include> in a text without a place
"#;

#[test]
fn refusals_name_the_element_and_the_way_out() {
    let lines: Vec<&str> = REFUSED.trim().lines().collect();
    for [change, words] in lines.as_chunks::<2>().0 {
        let (what, by) = change.split_once(" =>").unwrap();
        let text = refused(&with(what, by.trim_start()), &at_the_hand());
        has(&text, &words.split(" | ").collect::<Vec<_>>());
    }
    let part = refused("<mujocoinclude/>", &at_the_hand());
    has(&part, &["this is a part of an MJCF"]);
    let several = with("mass=\"2\"", "mass=\"two\"").replace("quat=\"1 0 0 0\"", "quat=\"1 0 0\"");
    let text = refused(&several, &at_the_hand());
    assert_eq!(text.matches("error: ").count(), 2, "{text}");
}

#[test]
fn what_is_tied_beside_the_chain_is_held() {
    let second = "<body name=\"other\"> <inertial pos=\"0 0 0\" mass=\"0.1\" diaginertia=\"0 0 0\"/> \
        <joint name=\"follow\" type=\"slide\" axis=\"0 1 0\"/> </body> <body name=\"thumb\"";
    let source = with("<body name=\"thumb\"", second).replace(
        "</mujoco>",
        "<equality><joint joint1=\"follow\" joint2=\"finger\" polycoef=\"0.01 -2\"/></equality>\
         <tendon><fixed><joint joint=\"finger\" coef=\"1\"/></fixed></tendon></mujoco>",
    );
    let options = to("hand", &[("*", "0"), ("finger", "0.03")]);
    let text = import(&source, &options).unwrap().text;
    has(&text, &["`follow` at -0.05"]);
}

#[test]
fn a_tendon_over_one_joint_is_a_limit() {
    let limits = |tendon: &str| {
        let tendon = format!("<tendon><fixed {tendon}/></fixed></tendon></mujoco>");
        let source = with("</mujoco>", &tendon);
        let text = import(&source, &at_the_hand()).unwrap().text;
        let lines = text.lines();
        let limits = lines.filter_map(|line| line.strip_prefix("limits = "));
        limits.collect::<Vec<_>>().join(" ")
    };
    let own = "{ position = [-1, 2] }";
    assert_eq!(limits("name=\"a\"><joint joint=\"turn\" coef=\"1\""), own);
    let range = |coef: &str| {
        let tendon = format!("range=\"-0.5 4\"><joint joint=\"turn\" coef=\"{coef}\"");
        limits(&tendon)
    };
    assert_eq!(range("1"), "{ position = [-0.5, 2] }");
    assert_eq!(range("-2"), "{ position = [-1, 0.25] }");
    // Of a joint without limits they are the tendon's.
    let slide = limits("range=\"-1 2\"><joint joint=\"reach\" coef=\"0.5\"");
    assert_eq!(slide, format!("{own} {{ position = [-2, 4] }}"));
}

#[test]
fn ties_are_ignored_where_that_is_asked_for() {
    let ties = "<equality><weld body1=\"hand\"/><joint joint1=\"reach\" joint2=\"turn\" \
        polycoef=\"0 0.5 1\"/></equality><tendon><fixed name=\"pull\"><joint joint=\"reach\" coef=\"1\"/>\
        <joint joint=\"turn\" coef=\"1\"/></fixed></tendon></mujoco>";
    let source = with("</mujoco>", ties);
    assert!(refused(&source, &at_the_hand()).contains("--ignore-ties"));
    let options = Options {
        ignore_ties: true,
        ..at_the_hand()
    };
    let imported = import(&source, &options).unwrap();
    let plain = import(ARM, &at_the_hand()).unwrap();
    assert_eq!(imported.robot.joints, plain.robot.joints);
    let said = "equality `weld`, fixed tendon `pull`, the equality of joint `reach`";
    has(&imported.robot.notes.join("\n"), &[said]);
}

#[test]
fn the_total_mass_scales_masses_and_inertias() {
    let arm = |settings: &str| {
        let source = with("angle=\"radian\"", &format!("angle=\"radian\" {settings}"));
        import(&source, &at_the_hand()).unwrap().robot
    };
    let (plain, twice) = (arm(""), arm("settotalmass=\"6.4\""));
    let two = dalembert_model::number::Rational::from_integer(2.into());
    for (one, other) in plain.joints.iter().zip(&twice.joints) {
        assert_eq!(&one.mass * &two, other.mass);
        assert_eq!(one.com, other.com);
        assert_eq!(one.armature, other.armature);
    }
    // Of a body that is merged with no other: those are rounded to 20 digits.
    let [one, other] = [&plain, &twice].map(|robot| robot.joints[0].inertia.clone());
    assert_eq!(one.map(|moment| moment * &two), other);
    assert_eq!(arm("settotalmass=\"-1\""), plain);
}

#[test]
fn includes_are_checked() {
    let text = |main: &str, part: &'static str| {
        let read = move |path: &Path| match path.to_string_lossy().as_ref() {
            "robots/part.xml" | "robots/arm.xml" => Ok(part.to_owned()),
            _ => Err("there is no such file".to_owned()),
        };
        let main = format!("<mujoco>{main}</mujoco>");
        Text::of("robots/arm.xml", main).with_includes(Path::new("robots/arm.xml"), read)
    };
    let include = "<include file=\"part.xml\"/>";
    let twice = format!("{include}\n{include}");
    let circle = "<mujocoinclude><include file=\"part.xml\"/></mujocoinclude>";
    let whole = "<mujocoinclude><include file=\"arm.xml\"/></mujocoinclude>";
    for (main, part, says) in [
        (
            "<include file=\"prt.xml\"/>",
            "",
            "`prt.xml` cannot be read: there is no such file",
        ),
        ("<include/>", "", "<include> has no `file`"),
        (&twice, "<mujocoinclude/>", "robots/arm.xml:2:1"),
        (include, circle, "`part.xml` is included a second time"),
        (include, whole, "`arm.xml` is included a second time"),
        (include, "<mujocoinclude>", "robots/part.xml:1"),
    ] {
        let error = text(main, part).expect_err(main);
        assert!(error.contains(says), "{says}: {error}");
    }
    let part =
        "<mujocoinclude>\n  <worldbody> <body name='b' quat='0'/> </worldbody></mujocoinclude>";
    let made = text(include, part).unwrap();
    let errors = import_text(&made, &Options::default()).unwrap_err();
    let shown = made.render(&errors.0);
    let said = ["robots/part.xml:2:36", "`quat` has 1 numbers, not 4"];
    has(&shown, &said);
}

#[test]
fn hostile_files_are_refused_at_once() {
    let nested = |open: &str, close: &str, count: usize| {
        format!("{}{}", open.repeat(count), close.repeat(count))
    };
    let model = |inside: &str| format!("<mujoco><worldbody>{inside}</worldbody></mujoco>");
    let classes = (0..6000).map(|i| format!("<default class='c{i}'/>"));
    let classes: String = classes.collect();
    let body = |inside: String| model(&format!("<body>{inside}</body>"));
    let default = |inside: &str| format!("<mujoco><default>{inside}</default></mujoco>");
    let entities = "<!DOCTYPE m [<!ENTITY a \"aaaaaaaaaa\">]><mujoco>&a;</mujoco>";
    let doubled = "<joint joint1='a' joint2='b'/><joint joint1='b' joint2='a'/>";
    let joint = "<inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/><joint type='slide' name=";
    let circle = format!(
        "<mujoco><worldbody><body name='x'>{joint}'x'/><body name='p'>{joint}'a'/></body>\
         <body name='q'>{joint}'b'/></body></body></worldbody><equality>{doubled}</equality></mujoco>"
    );
    for text in [
        model(&nested("<body>", "</body>", 100_000)),
        model(&nested("<body>", "</body>", 200)),
        model(&nested("<frame>", "</frame>", 100_000)),
        model(&"<body/>".repeat(100_000)),
        body("<joint/>".repeat(50_000)),
        body("<site name='s'/>".repeat(50_000)),
        default(&classes),
        default(&nested("<default class='a'>", "</default>", 199)),
        entities.to_owned(),
        model("<body pos='1e999999999 0 0'><joint/></body>"),
    ] {
        let errors = import(&text, &Options::default()).expect_err("no robot");
        assert!(!errors.0.is_empty(), "{}", &text[..text.len().min(80)]);
    }
    let robot = import(&circle, &to("x", &[("*", "0")])).unwrap().robot;
    assert_eq!(robot.joints.len(), 1);
}
