//! Which arms there are, where they come from and under which licence.
//!
//! What may be here is under a BSD, Apache or MIT licence, in the words of whoever
//! holds the rights: a package's description is not enough where the file itself says
//! otherwise.

/// An arm of the gallery.
#[derive(Debug)]
pub struct Arm {
    /// The name of its files.
    pub name: &'static str,
    /// The name that people use.
    pub title: &'static str,
    /// The source that it is made from.
    pub source: Source,
    /// Where that was published.
    pub from: &'static str,
    /// The licence of that.
    pub licence: &'static str,
    /// Where the joints are in the picture; at zero if empty.
    pub at: &'static [f64],
    /// Multiplications/additions of the best peer for τ, c and D.
    pub peer: [&'static str; 3],
}

/// The source of an arm.
#[derive(Debug)]
pub enum Source {
    /// A chain of a URDF.
    Urdf(Chain),
    /// A robot file, relative to the gallery.
    RobotFile(&'static str),
}

/// A chain of a URDF: what `dalembert import` is told.
#[derive(Debug)]
pub struct Chain {
    /// The URDF, relative to the gallery.
    pub path: &'static str,
    /// The link that stands still; the root if empty.
    pub base: &'static str,
    /// The link whose frame is the hand; the only one there is if empty.
    pub tip: &'static str,
    /// Joints that stay at zero.
    pub lock: &'static [&'static str],
    /// Links that are left away.
    pub without: &'static [&'static str],
}

impl Arm {
    /// Returns what it is made from, relative to the gallery.
    pub fn path(&self) -> &'static str {
        match &self.source {
            Source::Urdf(chain) => chain.path,
            Source::RobotFile(path) => path,
        }
    }

    /// Returns its robot file, relative to the gallery.
    pub fn robot_file(&self) -> String {
        match self.source {
            Source::Urdf(_) => format!("robots/{}.toml", self.name),
            Source::RobotFile(path) => path.to_owned(),
        }
    }

    /// Returns its picture, relative to the gallery.
    pub fn picture(&self) -> String {
        format!("pictures/{}.svg", self.name)
    }
}

const fn urdf(path: &'static str, base: &'static str, tip: &'static str) -> Source {
    without(path, base, tip, &[], &[])
}

const fn without(
    path: &'static str,
    base: &'static str,
    tip: &'static str,
    lock: &'static [&'static str],
    without: &'static [&'static str],
) -> Source {
    Source::Urdf(Chain {
        path,
        base,
        tip,
        lock,
        without,
    })
}

const UR: &str = "ur_description of github.com/ros-industrial/universal_robot, as in the Python package example-robot-data 6.0.0";
const KORTEX: &str = "github.com/Kinovarobotics/ros_kortex at 6cd75d45f4";
const DOOSAN: &str = "github.com/doosan-robotics/doosan-robot at ab24968ebb";
const TECHMAN: &str = "github.com/TechmanRobotInc/tmr_ros1 at 3075175aff";
const OWN: &str = "MIT or Apache-2.0, as the rest of dalembert";

/// All of them, by the number of their joints.
pub const ARMS: [Arm; 25] = [
    Arm {
        name: "qarm",
        title: "Quanser QArm",
        source: urdf("urdf/qarm.urdf", "", ""),
        from: "qarm_description of Quanser, as in github.com/Daniella1/urdf_files_dataset at 81f4cdac42",
        licence: "BSD-3-Clause, Copyright 2020 Quanser Inc",
        at: &[0.0, 0.4, -0.8, 0.0],
        peer: ["225/163", "44/22", "129/108"],
    },
    Arm {
        name: "open_manipulator",
        title: "ROBOTIS OpenMANIPULATOR-X without its gripper",
        source: without(
            "urdf/open_manipulator.urdf",
            "",
            "end_effector_link",
            &[],
            &["gripper_link", "gripper_link_sub"],
        ),
        from: "open_manipulator_description of ROBOTIS, as in github.com/Daniella1/urdf_files_dataset at 81f4cdac42",
        licence: "Apache-2.0, ROBOTIS",
        at: &[0.0, -0.6, 0.4, 0.7],
        peer: ["187/137", "16/9", "79/72"],
    },
    Arm {
        name: "scara",
        title: "A SCARA with a slide, made up",
        source: Source::RobotFile("../codegen/tests/data/scara.toml"),
        from: "this project: no real arm, everything in general position",
        licence: OWN,
        at: &[0.4, -0.9, 0.3, 0.1],
        peer: ["64/43", "0/0", "15/20"],
    },
    Arm {
        name: "so101",
        title: "TheRobotStudio SO-101, gripper closed",
        source: without(
            "../import/tests/data/so101.urdf",
            "",
            "gripper_frame_link",
            &["gripper"],
            &[],
        ),
        from: "github.com/TheRobotStudio/SO-ARM100, as in the Python package example-robot-data 6.0.0",
        licence: "Apache-2.0, TheRobotStudio",
        at: &[],
        peer: ["309/232", "42/22", "169/146"],
    },
    Arm {
        name: "puma560",
        title: "Unimation PUMA 560",
        source: Source::RobotFile("../generated/robots/puma560.toml"),
        from: "measurements of Armstrong, Khatib and Burdick 1986, as its robot file says",
        licence: OWN,
        at: &[0.0, 0.6, -0.4, 0.0, 0.5, 0.0],
        peer: ["195/143", "28/12", "124/93"],
    },
    Arm {
        name: "stanford",
        title: "Stanford arm",
        source: Source::RobotFile("../generated/robots/stanford.toml"),
        from: "Paul 1981, as its robot file says",
        licence: OWN,
        at: &[0.3, 0.8, 0.5, 0.0, 0.4, 0.0],
        peer: ["162/120", "20/6", "85/64"],
    },
    Arm {
        name: "gantry",
        title: "A gantry with a wrist, made up",
        source: Source::RobotFile("../codegen/tests/data/gantry.toml"),
        from: "this project: no real arm, everything in general position",
        licence: OWN,
        at: &[0.5, 0.4, 0.3, 0.2, 0.5, 0.0],
        peer: ["179/129", "28/16", "79/59"],
    },
    Arm {
        name: "ur3",
        title: "Universal Robots UR3",
        source: urdf("urdf/ur3.urdf", "base_link", "tool0"),
        from: UR,
        licence: "BSD, as the description's package.xml says",
        at: &[0.0, -1.0, 1.2, -1.5, -1.57, 0.0],
        peer: ["200/137", "11/5", "123/85"],
    },
    Arm {
        name: "ur5",
        title: "Universal Robots UR5",
        source: urdf("../import/tests/data/ur5.urdf", "base_link", "tool0"),
        from: UR,
        licence: "BSD, as the description's package.xml says",
        at: &[0.0, -1.0, 1.2, -1.5, -1.57, 0.0],
        peer: ["200/137", "11/5", "123/85"],
    },
    Arm {
        name: "ur10",
        title: "Universal Robots UR10",
        source: Source::RobotFile("../generated/robots/ur10.toml"),
        from: "Robotics Toolbox (roboticstoolbox-python 1.5.0, models.DH.UR10), as its robot file says",
        licence: OWN,
        at: &[0.0, -1.0, 1.2, -1.5, -1.57, 0.0],
        peer: ["209/154", "28/12", "138/103"],
    },
    Arm {
        name: "gen3_lite",
        title: "Kinova Gen3 lite",
        source: urdf("urdf/gen3_lite.urdf", "", ""),
        from: KORTEX,
        licence: "BSD-3-Clause, Copyright 2018 Kinova inc",
        at: &[0.0, 0.4, 1.2, 0.0, 0.5, 0.0],
        peer: ["287/214", "37/20", "149/131"],
    },
    Arm {
        name: "tm5_900",
        title: "Techman TM5-900",
        source: urdf("urdf/tm5_900.urdf", "", "tool0"),
        from: TECHMAN,
        licence: "BSD-3-Clause, Copyright 2019-2024 Techman Robot Inc",
        at: &[0.0, 0.4, 1.0, 0.2, 1.57, 0.0],
        peer: ["201/139", "28/12", "135/93"],
    },
    Arm {
        name: "tm14",
        title: "Techman TM14",
        source: urdf("urdf/tm14.urdf", "", "tool0"),
        from: TECHMAN,
        licence: "BSD-3-Clause, Copyright 2019-2024 Techman Robot Inc",
        at: &[0.0, 0.4, 1.0, 0.2, 1.57, 0.0],
        peer: ["201/139", "28/12", "135/93"],
    },
    Arm {
        name: "m1013",
        title: "Doosan M1013",
        source: urdf("urdf/m1013.urdf", "", ""),
        from: DOOSAN,
        licence: "BSD-3-Clause, Copyright 2019 Doosan Robotics Inc",
        at: &[0.0, 0.3, 1.2, 0.0, 1.0, 0.0],
        peer: ["431/313", "96/57", "377/288"],
    },
    Arm {
        name: "e0509",
        title: "Doosan E0509",
        source: urdf("urdf/e0509.urdf", "", ""),
        from: DOOSAN,
        licence: "BSD-3-Clause, Copyright 2019 Doosan Robotics Inc",
        at: &[0.0, 0.3, 1.2, 0.0, 1.0, 0.0],
        peer: ["310/232", "49/27", "178/148"],
    },
    Arm {
        name: "elfin5",
        title: "Han's Robot Elfin 5",
        source: urdf("urdf/elfin5.urdf", "", "elfin_end_link"),
        from: "github.com/hans-robot/elfin_robot at 4f4ba13a26, its xacro expanded by xacro 2.1",
        licence: "BSD-3-Clause, Copyright 2017 Han's Robot Co., Ltd",
        at: &[0.0, 0.5, 1.0, 0.0, 0.6, 0.0],
        peer: ["393/298", "60/34", "264/232"],
    },
    Arm {
        name: "panda",
        title: "Franka Emika Panda",
        source: Source::RobotFile("../generated/robots/panda.toml"),
        from: "Robotics Toolbox (roboticstoolbox-python 1.5.0, models.DH.Panda), as its robot file says",
        licence: OWN,
        at: &[0.0, -0.6, 0.0, -2.0, 0.0, 1.6, 0.8],
        peer: ["365/293", "64/37", "275/232"],
    },
    Arm {
        name: "fr3",
        title: "Franka Research 3",
        source: urdf("urdf/fr3.urdf", "", ""),
        from: "github.com/frankarobotics/franka_description at 566ba44abc, its xacro expanded by xacro 2.1 with hand:=false",
        licence: "Apache-2.0, Franka Robotics GmbH",
        at: &[0.0, -0.6, 0.0, -2.0, 0.0, 1.6, 0.8],
        peer: ["396/300", "64/37", "271/226"],
    },
    Arm {
        name: "iiwa14",
        title: "KUKA LBR iiwa 14",
        source: urdf("urdf/iiwa14.urdf", "", "iiwa_link_ee"),
        from: "iiwa_description of github.com/RobotLocomotion/models at 4723170e1c, after iiwa_stack",
        licence: "BSD-2-Clause, Copyright 2015 Robert Krug and Todor Stoyanov; BSD-3-Clause, Copyright 2016 Salvatore Virga and Marco Esposito",
        at: &[0.0, 0.5, 0.0, -1.4, 0.0, 0.8, 0.0],
        peer: ["295/216", "42/22", "198/158"],
    },
    Arm {
        name: "gen3",
        title: "Kinova Gen3, 7 joints",
        source: urdf("urdf/gen3.urdf", "", ""),
        from: KORTEX,
        licence: "BSD-3-Clause, Copyright 2018 Kinova inc",
        at: &[0.0, 0.5, 0.0, 1.6, 0.0, 0.8, 0.0],
        peer: ["455/347", "62/38", "323/294"],
    },
    Arm {
        name: "j2s7s300",
        title: "Kinova Jaco 2, 7 joints, spherical wrist",
        source: urdf("urdf/j2s7s300.urdf", "", ""),
        from: "jaco_description of github.com/RobotLocomotion/models at 4723170e1c",
        licence: "BSD-3-Clause, Copyright 2015-2016 Kinova Robotics, 2017-2020 Toyota Research Institute",
        at: &[0.0, 3.7, 0.0, 1.6, 0.0, 3.9, 0.0],
        peer: ["277/193", "39/19", "219/166"],
    },
    Arm {
        name: "xarm7",
        title: "UFACTORY xArm 7",
        source: urdf("../import/tests/data/xarm7.urdf", "", ""),
        from: "xarm_description of UFACTORY, as in the Python package example-robot-data 6.0.0",
        licence: "BSD-3-Clause, Copyright 2018 UFACTORY Inc",
        at: &[0.0, -0.4, 0.0, 1.2, 0.0, 0.8, 0.0],
        peer: ["386/291", "58/34", "257/211"],
    },
    Arm {
        name: "sawyer",
        title: "Rethink Sawyer, the head left away",
        source: without("urdf/sawyer.urdf", "", "right_hand", &[], &["head"]),
        from: "github.com/RethinkRobotics/sawyer_robot at d1ef3d0ca8, its xacro expanded by xacro 2.1",
        licence: "Apache-2.0, Rethink Robotics",
        at: &[0.0, -0.7, 0.0, 1.4, 0.0, 0.8, 0.0],
        peer: ["469/358", "70/42", "356/310"],
    },
    Arm {
        name: "baxter",
        title: "Rethink Baxter, left arm with its gripper",
        source: without(
            "urdf/baxter.urdf",
            "left_arm_mount",
            "left_gripper",
            &["l_gripper_l_finger_joint", "l_gripper_r_finger_joint"],
            &[],
        ),
        from: "baxter_description of github.com/RethinkRobotics/baxter_common, as in the Python package example-robot-data 6.0.0",
        licence: "BSD-3-Clause, Copyright 2013-2015 Rethink Robotics",
        at: &[0.0, -0.5, 0.0, 1.2, 0.0, 0.6, 0.0],
        peer: ["428/325", "64/37", "288/248"],
    },
    Arm {
        name: "g1_left_arm",
        title: "Unitree G1, left arm with its rubber hand",
        source: urdf("urdf/g1_dual_arm.urdf", "", "left_rubber_hand"),
        from: "github.com/unitreerobotics/unitree_ros at d6f13aad60",
        licence: "BSD-3-Clause, Copyright 2016-2022 HangZhou YuShu Technology Co., Ltd (Unitree Robotics)",
        at: &[0.4, 0.2, 0.0, 0.6, 0.0, 0.0, 0.0],
        peer: ["453/345", "84/52", "328/292"],
    },
];
