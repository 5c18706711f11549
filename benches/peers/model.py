"""A robot file as a tree of joints that turn or slide along their own z.

`placement` and rows of the DH table alike become: the constant place (rotation,
translation) of each joint's frame in the frame of the link before it, and the
link's mass, centre of mass and inertia about it in the frame that moves with
the joint. Cosines of right angles become exactly 0, as careful users of the
peers see to, for their generators count what is not.
"""

import math
import tomllib
from fractions import Fraction

import numpy as np


def number(value):
    """A number of a robot file: TOML's own, "pi/2", "-2*pi", "90deg" or "2*atan(1/3)"."""
    if not isinstance(value, str):
        return float(value)
    if value.startswith("2*atan("):
        return 2 * math.atan(Fraction(value[7:-1]))
    if value.endswith("deg"):
        return math.radians(float(value[:-3]))
    result = 1.0
    text = value.replace(" ", "")
    if text.startswith("-"):
        result, text = -1.0, text[1:]
    for i, factor in enumerate(text.split("*")):
        top, *under = factor.split("/")
        result *= math.pi if top == "pi" else float(top)
        for below in under:
            result /= float(below)
    return result


def snapped(matrix):
    """What is within 1e-14 of 0, 1 or -1 is that."""
    rounded = np.round(matrix)
    return np.where(np.abs(matrix - rounded) < 1e-14, rounded, matrix) + 0.0


def turn(axis, angle):
    """The rotation about a coordinate axis."""
    c, s = math.cos(angle), math.sin(angle)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    r = np.eye(3)
    r[i, i] = r[j, j] = c
    r[i, j], r[j, i] = -s, s
    return snapped(r)


def fixed_axes(rpy):
    """Roll, pitch and yaw about fixed axes, as URDF has them."""
    r, p, y = (number(x) for x in rpy)
    return snapped(turn(2, y) @ turn(1, p) @ turn(0, r))


def placed(table):
    """A constant place: `xyz` and `rpy`, each of which may be left out."""
    xyz = np.array([number(x) for x in table.get("xyz", [0, 0, 0])])
    return fixed_axes(table.get("rpy", [0, 0, 0])), xyz


def along_z(axis):
    """A rotation that carries z to an axis."""
    a = np.array([number(x) for x in axis])
    a = a / np.linalg.norm(a)
    if abs(a[2] - 1) < 1e-14:
        return np.eye(3)
    if abs(a[2] + 1) < 1e-14:
        return turn(0, math.pi)
    v = np.cross([0, 0, 1], a)
    k = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
    return snapped(np.eye(3) + k + k @ k / (1 + a[2]))


def after(first, second):
    """One place in another."""
    (r1, p1), (r2, p2) = first, second
    return snapped(r1 @ r2), p1 + r1 @ p2


NOWHERE = (np.eye(3), np.zeros(3))


class Arm:
    """Joints, each after the one that carries it; gravity in base axes.

    `parent` is the place of the joint before, −1 at the base; the position of joint i is
    `factor[i] * q[coordinate[i]] + shift[i]`, where q has an entry for each joint that follows none.
    """

    def __init__(self, path):
        with open(path, "rb") as file:
            robot = tomllib.load(file)
        self.name = robot["name"]
        self.gravity = np.array([number(x) for x in robot["gravity"]])
        self.prismatic, self.place = [], []
        self.mass, self.com, self.inertia = [], [], []
        self.viscous, self.armature = [], []
        self.parent, self.coordinate, self.factor, self.shift = [], [], [], []
        self.base = self.floating(robot["joint"])
        standard = robot.get("convention") == "standard"
        names = [joint.get("name") for joint in robot["joint"]]
        # From each joint's own frame to the one that the file's numbers are in; the base's last.
        frames = [None] * len(names) + [placed(robot.get("base", {}))]
        follows = [joint.get("mimic") for joint in robot["joint"]]
        free = [i for i, mimic in enumerate(follows) if mimic is None]
        for i, joint in enumerate(robot["joint"]):
            parent = joint.get("parent", i)
            if isinstance(parent, str):
                parent = names.index(parent) + 1 if parent in names else 0
            self.parent.append(parent - 1)
            mimic = follows[i] or {}
            leader = mimic.get("joint", i + 1)
            leader = names.index(leader) if isinstance(leader, str) else leader - 1
            self.coordinate.append(free.index(leader))
            self.factor.append(number(mimic.get("multiplier", 1)))
            self.shift.append(number(mimic.get("offset", 0)))
            kind = joint["kind"] == "prismatic"
            get = lambda key: number(joint.get(key, 0))
            link = NOWHERE
            if "placement" in joint:
                align = (along_z(joint.get("axis", [0, 0, 1])), np.zeros(3))
                place = after(placed(joint["placement"]), align)
                link = (align[0].T, np.zeros(3))
            else:
                x = (turn(0, get("alpha")), np.array([get("a"), 0, 0]))
                z = (turn(2, get("theta")), np.array([0, 0, get("d")]))
                z = after(z, (NOWHERE[0], np.array([0, 0, get("offset")])) if kind
                          else (turn(2, get("offset")), np.zeros(3)))
                if standard:
                    place, link = z, x
                else:
                    place = after(x, z)
            self.place.append(after(frames[self.parent[i]], place))
            frames[i] = link
            self.prismatic.append(kind)
            com = np.array([number(x) for x in joint.get("com", [0, 0, 0])])
            xx, yy, zz, xy, yz, xz = (number(x) for x in joint.get("inertia", [0] * 6))
            about = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
            self.mass.append(get("mass"))
            self.com.append(link[0] @ com + link[1])
            self.inertia.append(link[0] @ about @ link[0].T)
            self.viscous.append(get("viscous"))
            self.armature.append(get("armature"))
        self.n = len(free)
        self.is_serial = self.parent == list(range(-1, self.n - 1))

    @staticmethod
    def floating(joints):
        """Mass, centre of mass and inertia of a base that floats, which is no longer among the joints."""
        if joints[0]["kind"] != "floating":
            return None
        base = joints.pop(0)
        com = np.array([number(x) for x in base["com"]])
        xx, yy, zz, xy, yz, xz = (number(x) for x in base["inertia"])
        return number(base["mass"]), com, np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])

    def about_origins(self):
        """Of each link: mass, first moments, inertia about the joint's origin; last of a base that floats."""
        bodies = list(zip(self.mass, self.com, self.inertia)) + ([self.base] if self.base else [])
        result = []
        for m, c, i in bodies:
            result.append([m, m * c, i + m * (c @ c * np.eye(3) - np.outer(c, c))])
        return result

    def regrouped(self):
        """The same torques from fewer numbers, as Gautier and Khalil regroup them.

        What a joint cannot tell from the link before it is moved there: about an
        axis that turns, the mass, its moment along the axis and an inertia that is
        round about it; along one that slides, the whole inertia.
        """
        links = self.about_origins()
        for k in reversed(range(len(self.mass))):
            m, mc, i = links[k]
            if self.prismatic[k]:
                moved = [0.0, np.zeros(3), i]
            else:
                moved = [m, np.array([0, 0, mc[2]]), np.diag([i[1, 1], i[1, 1], 0])]
            links[k] = [m - moved[0], mc - moved[1], i - moved[2]]
            if self.parent[k] >= 0 or self.base:
                (r, p), (m, mc, i) = self.place[k], moved
                turned = r @ mc
                other = np.outer(turned, p) + np.outer(p, turned)
                about = r @ i @ r.T + 2 * (turned @ p) * np.eye(3) - other
                about = about + m * (p @ p * np.eye(3) - np.outer(p, p))
                before = links[self.parent[k]]
                links[self.parent[k]] = [before[0] + m, before[1] + turned + m * p, before[2] + about]
        return links

    def pinocchio(self):
        """The same arm for Pinocchio; friction and armature are added outside."""
        import pinocchio as pin

        model = pin.Model()
        model.gravity = pin.Motion(np.concatenate([self.gravity, np.zeros(3)]))
        first = 0
        if self.base:
            first = model.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), "base")
            model.appendBodyToJoint(first, pin.Inertia(*self.base), pin.SE3.Identity())
        for i in range(len(self.mass)):
            kind = pin.JointModelPZ() if self.prismatic[i] else pin.JointModelRZ()
            parent = self.parent[i] + 1 + first
            own = model.addJoint(parent, kind, pin.SE3(*self.place[i]), f"j{i + 1}")
            body = pin.Inertia(self.mass[i], self.com[i], self.inertia[i])
            model.appendBodyToJoint(own, body, pin.SE3.Identity())
        return model

    def urdf(self):
        """The same arm as a URDF, for libraries that take no other."""
        rows = [f'<robot name="{self.name}">', '<link name="l0"/>']
        for i in range(len(self.mass)):
            r, p = self.place[i]
            text = lambda v: " ".join(repr(float(x)) for x in v)
            names = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
            moments = zip(names, self.inertia[i][np.triu_indices(3)])
            inertia = " ".join(f'{name}="{text([x])}"' for name, x in moments)
            roll, pitch = math.atan2(r[2, 1], r[2, 2]), math.asin(max(-1, min(1, -r[2, 0])))
            yaw = math.atan2(r[1, 0], r[0, 0])
            if abs(abs(r[2, 0]) - 1) < 1e-14:
                roll, yaw = 0.0, math.atan2(-r[0, 1], r[1, 1])
            kind = "prismatic" if self.prismatic[i] else "revolute"
            rows += [
                f'<link name="l{i + 1}"><inertial><origin xyz="{text(self.com[i])}"/>'
                f'<mass value="{text([self.mass[i]])}"/><inertia {inertia}/></inertial></link>',
                f'<joint name="j{i + 1}" type="{kind}"><parent link="l{self.parent[i] + 1}"/>'
                f'<child link="l{i + 1}"/>'
                f'<origin xyz="{text(p)}" rpy="{text([roll, pitch, yaw])}"/><axis xyz="0 0 1"/>'
                '<limit lower="-7" upper="7" velocity="100" effort="1000"/></joint>',
            ]
        return "\n".join(rows + ["</robot>", ""])
