//! What is not known is refused, by name, and nothing panics.

use dalembert_checker::{audit, read};

use crate::support::{claim, file};

const CLAIM: &str = "checker/tests/data/planar2r-pick.json";
const ROBOT: &str = "cli/tests/data/attacks/r2_conf.toml";

fn fault_of_robot(robot: &str) -> String {
    audit(&claim(CLAIM), robot, None).unwrap_err().to_string()
}

#[test]
fn keys_that_are_not_audited() {
    let robot = file(ROBOT);
    for key in ["springs = {}", "gear = 2", "mimic = { joint = 1 }"] {
        let with = robot.replacen("mass = 1\n", &format!("mass = 1\n{key}\n"), 1);
        let name = key.split(' ').next().unwrap();
        assert!(
            fault_of_robot(&with).contains(&format!("unknown field `{name}`")),
            "{key}"
        );
    }
    let with = format!("flange = {{}}\n{robot}");
    assert!(fault_of_robot(&with).contains("unknown field `flange`"));
    // A row's second twist is the standard convention's, and an axis that of a placement.
    for key in ["placement = {}", "axis = [0, 0, 1]"] {
        let with = robot.replacen("mass = 1\n", &format!("mass = 1\n{key}\n"), 1);
        assert!(fault_of_robot(&with).contains("`placement`"), "{key}");
    }
    let twisted = robot.replacen("mass = 1\n", "mass = 1\nbeta = 0.1\n", 1);
    let modified = twisted.replace("standard", "modified");
    assert!(fault_of_robot(&modified).contains("`placement`"));
    let with = robot.replace("[scene.pick]\n", "[scene.pick]\nwind = 1\n");
    assert!(fault_of_robot(&with).contains("unknown field `wind`"));
}

#[test]
fn values_that_are_none() {
    let robot = file(ROBOT);
    for (from, to) in [
        ("mass = 1\n", "mass = nan\n"),
        ("mass = 1\n", "mass = \"heavy\"\n"),
        ("mass = 1\n", "mass = 1\nalpha = \"pi/0\"\n"),
        ("mass = 1\n", "mass = 1\nalpha = \"right\"\n"),
        ("mass = 1\n", "mass = 1\ntheta = 1\n"),
        ("standard", "denavit"),
        ("com = [-0.5, 0, 0]\n", ""),
        ("[scene.pick]", "[scene.other]"),
    ] {
        assert!(robot.contains(from), "{from}");
        assert!(
            fault_of_robot(&robot.replacen(from, to, 1)).starts_with("robot file"),
            "{to}"
        );
    }
}

#[test]
fn claims_about_other_states_rows_and_scales() {
    let robot = file(ROBOT);
    let refused = |change: &dyn Fn(&mut dalembert_checker::Claim)| {
        let mut claim = claim(CLAIM);
        change(&mut claim);
        audit(&claim, &robot, None).unwrap_err().to_string()
    };
    assert!(refused(&|c| c.velocity[0] = [-1.0, 1.0]).contains("the box lacks"));
    assert!(refused(&|c| c.position[1] = [0.0, 1.0]).contains("the box lacks"));
    assert!(refused(&|c| c.position[1] = [1.0, f64::NAN]).contains("the box lacks"));
    assert!(refused(&|c| c.velocity[0] = [f64::NEG_INFINITY, 9.0]).contains("finite ranges"));
    assert!(refused(&|c| c.rows = vec![2, 1]).contains("`rows`"));
    assert!(refused(&|c| c.rows = vec![0, 1]).contains("`rows`"));
    assert!(refused(&|c| c.rows = vec![1]).contains("`scale`"));
    assert!(refused(&|c| c.scale[0] = 1e3).contains("`scale`"));
    assert!(refused(&|c| c.scale[0] = f64::NAN).contains("`scale`"));
    assert!(refused(&|c| c.relative_to = Some("range".into())).contains("`relative_to`"));
}

#[test]
fn files_that_are_cut_or_garbled() {
    let (certificate, robot) = (file(CLAIM), file(ROBOT));
    for cut in (0..certificate.len()).step_by(37) {
        assert!(read(&certificate[..cut]).is_err());
    }
    for cut in (0..robot.len()).step_by(11) {
        // Cut behind the scene, what is left may be whole.
        let _ = audit(&claim(CLAIM), &robot[..cut], None);
    }
    let text = claim(CLAIM).text;
    for cut in (0..text.trim_end().len() - 1).step_by(5) {
        let mut claim = claim(CLAIM);
        claim.text.truncate(cut);
        assert!(audit(&claim, &robot, None).is_err(), "{cut}");
    }
    assert!(read(&"[".repeat(100_000)).is_err());
    assert!(fault_of_robot(&"a = [".repeat(20_000)).starts_with("robot file"));
    assert!(fault_of_robot(&format!("a{} = 1", ".a".repeat(50_000))).starts_with("robot file"));
}

#[test]
fn functions_that_are_not_audited() {
    let other = file(CLAIM).replace("\"inverse_dynamics\"", "\"forward_dynamics\"");
    let fault = audit(&read(&other).unwrap()[0], &file(ROBOT), None).unwrap_err();
    assert!(
        fault
            .to_string()
            .contains("`forward_dynamics` is only tried"),
        "{fault}"
    );
}

/// Products that grow with every line end with a fault, not with all memory.
#[test]
fn texts_that_grow_without_end() {
    let mut claim = claim(CLAIM);
    let mut lines: Vec<String> = vec!["    let t900 = qd[0] + c1;".into()];
    for k in 900..960 {
        lines.push(format!("    let t{} = t{k} * t{k};", k + 1));
    }
    let head = claim.text.find("    let t1").unwrap();
    claim.text.insert_str(head, &(lines.join("\n") + "\n"));
    let fault = audit(&claim, &file(ROBOT), None).unwrap_err().to_string();
    assert!(fault.contains("power"), "{fault}");
}
