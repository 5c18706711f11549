"""The algorithms of the peers over CasADi's SX, as a careful user writes them.

Newton–Euler recursion about the centre of mass and about the joint's origin, there
with regrouped parameters too; articulated bodies, composite bodies; derivatives by CasADi's own differentiation.
Of several ways to one function the one of fewest operations is kept, after
CasADi's `cse`: what is reported is the best that these tools give.
"""

import casadi as ca
import numpy as np

MUL = {ca.OP_MUL, ca.OP_SQ, ca.OP_TWICE}
ADD = {ca.OP_ADD, ca.OP_SUB}
FREE = {ca.OP_INPUT, ca.OP_OUTPUT, ca.OP_CONST, ca.OP_NEG, ca.OP_ASSIGN}


def counts(function):
    """[multiplications, additions, divisions, sines and cosines]."""
    result = [0, 0, 0, 0]
    for k in range(function.n_instructions()):
        op = function.instruction_id(k)
        if op in MUL:
            result[0] += 1
        elif op in ADD:
            result[1] += 1
        elif op in (ca.OP_DIV, ca.OP_INV):
            result[2] += 1
        elif op in (ca.OP_SIN, ca.OP_COS):
            result[3] += 1
        elif op not in FREE:
            raise ValueError(f"operation {op} is not counted")
    return result


def made(name, inputs, *matrices):
    """A function, after the common subexpressions are merged: row by row, like ours."""
    flat = ca.vertcat(*(ca.vec(ca.densify(m).T) for m in matrices))
    return ca.Function(name, inputs, [ca.cse(flat)])


def best(*functions):
    """The one of fewest multiplications and additions."""
    return min(functions, key=lambda f: sum(counts(f)[:3]))


def const(matrix):
    """A constant whose zeros are structural, so that nothing is computed with them."""
    return ca.sparsify(ca.SX(ca.DM(np.asarray(matrix, dtype=float))))


def cross(a, b):
    return ca.vertcat(
        a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
    )


def skew(p):
    return ca.vertcat(
        ca.horzcat(0, -p[2], p[1]), ca.horzcat(p[2], 0, -p[0]), ca.horzcat(-p[1], p[0], 0)
    )


class Chain:
    def __init__(self, arm):
        self.arm, self.n = arm, arm.n
        self.q, self.qd, self.qdd, self.tau = (
            ca.SX.sym(name, arm.n) for name in ("q", "qd", "qdd", "tau")
        )
        self.rotation, self.offset = [], []
        self.links = len(arm.mass)
        for i in range(self.links):
            r, p = (const(x) for x in arm.place[i])
            q = self.rate(self.q, i) + arm.shift[i]
            if arm.prismatic[i]:
                p = p + r @ ca.vertcat(0, 0, q)
            else:
                s, c = ca.sin(q), ca.cos(q)
                turned = ca.vertcat(ca.horzcat(c, -s, 0), ca.horzcat(s, c, 0), ca.horzcat(0, 0, 1))
                r = r @ ca.sparsify(turned)
            self.rotation.append(r)
            self.offset.append(p)

    def rate(self, rates, i):
        """The entry of joint i, from a vector over the joints that follow none."""
        return self.arm.factor[i] * rates[self.arm.coordinate[i]]

    def gathered(self, torques):
        """The torques of the joints that follow none, from the torque of every joint."""
        felt = [0] * self.n
        for i, torque in enumerate(torques):
            felt[self.arm.coordinate[i]] += self.arm.factor[i] * torque
        return ca.vertcat(*felt)

    def friction(self, i):
        return self.arm.viscous[i] * self.rate(self.qd, i)

    def newton_euler(self, qd, qdd, gravity, links):
        """Inverse dynamics; moments about joints' origins, of these links, or about the
        centres of mass."""
        return self.recursion(qd, qdd, (ca.SX.zeros(3), ca.SX.zeros(3), const(-gravity)), links)[0]

    def body(self, motion, links, i):
        """The force and the moment that a body in motion needs."""
        w, dw, a = motion
        if links is None:
            m, c, about = (const(x) for x in (self.arm.mass[i], self.arm.com[i], self.arm.inertia[i]))
            f = m * (a + cross(dw, c) + cross(w, cross(w, c)))
            return f, about @ dw + cross(w, about @ w) + cross(c, f)
        m, mc, about = (const(x) for x in links[i])
        f = m * a + cross(dw, mc) + cross(w, cross(w, mc))
        return f, about @ dw + cross(w, about @ w) + cross(mc, a)

    def recursion(self, qd, qdd, base, links):
        """Torques on a base in motion (rate of turn, its rate, acceleration), and what it feels."""
        motion = [None] * self.links + [base]
        forces = []
        for i in range(self.links):
            w, dw, a = motion[self.arm.parent[i]]
            r, p = self.rotation[i], self.offset[i]
            a = r.T @ (a + cross(dw, p) + cross(w, cross(w, p)))
            w, dw = r.T @ w, r.T @ dw
            z, zd = (ca.vertcat(0, 0, self.rate(x, i)) for x in (qd, qdd))
            if self.arm.prismatic[i]:
                a = a + zd + 2 * cross(w, z)
            else:
                dw = dw + zd + cross(w, z)
                w = w + z
            motion[i] = w, dw, a
            forces.append(self.body(motion[i], links, i))
        forces.append((ca.SX(3, 1), ca.SX(3, 1)))
        tau = [None] * self.links
        for i in reversed(range(self.links)):
            f, k = forces[i]
            tau[i] = (f if self.arm.prismatic[i] else k)[2]
            if self.arm.armature[i]:
                tau[i] = tau[i] + self.arm.armature[i] * self.rate(qdd, i)
            before = forces[self.arm.parent[i]]
            f = self.rotation[i] @ f
            k = self.rotation[i] @ k + cross(self.offset[i], f)
            forces[self.arm.parent[i]] = before[0] + f, before[1] + k
        return self.gathered(tau), forces[-1]

    def damped(self, tau):
        return tau + self.gathered([self.friction(i) for i in range(self.links)])

    def potential_energy(self, links):
        """−gᵀ Σ m p, from the tips to the base."""
        whole = [(m, const(mc)) for m, mc, _ in links] + [(0, ca.SX(3, 1))]
        for i in reversed(range(self.links)):
            m, mc = whole[i]
            before = whole[self.arm.parent[i]]
            mc = self.rotation[i] @ mc + m * self.offset[i]
            whole[self.arm.parent[i]] = before[0] + m, before[1] + mc
        return -ca.dot(const(self.arm.gravity), whole[-1][1])

    def composite(self, links):
        """The inertia matrix, by composite bodies."""
        d = ca.SX.zeros(self.n, self.n)
        whole = [(m, const(mc), const(about)) for m, mc, about in links]
        whole.append((0, ca.SX.zeros(3), ca.SX.zeros(3, 3)))
        for i in reversed(range(self.links)):
            m, mc, about = whole[i]
            if self.arm.prismatic[i]:
                f, k = ca.vertcat(0, 0, m), ca.vertcat(mc[1], -mc[0], 0)
            else:
                f, k = ca.vertcat(-mc[1], mc[0], 0), about[:, 2]
            j = i
            while j >= 0:
                own, other = self.arm.coordinate[i], self.arm.coordinate[j]
                entry = (f if self.arm.prismatic[j] else k)[2]
                if i == j:
                    entry += self.arm.armature[i]
                entry = self.arm.factor[i] * self.arm.factor[j] * entry
                d[own, other] += entry
                if i != j:
                    d[other, own] += entry
                p, r = self.offset[j], self.rotation[j]
                f = r @ f
                k = r @ k + cross(p, f)
                j = self.arm.parent[j]
            # The body as the link before it sees it.
            r, p = self.rotation[i], self.offset[i]
            turned = r @ mc
            mp = m * p
            cp = skew(turned) @ skew(p)
            about = r @ about @ r.T - cp - cp.T - skew(mp) @ skew(p)
            before = whole[self.arm.parent[i]]
            whole[self.arm.parent[i]] = before[0] + m, before[1] + turned + mp, before[2] + about
        return d

    def articulated(self):
        """Forward dynamics, by articulated bodies over 6-vectors, where no joint follows another."""
        n, x, bias = self.n, [], []
        inertia, force = [], []
        speed = [None] * n + [ca.SX.zeros(6)]
        for i in range(n):
            r, p = self.rotation[i], self.offset[i]
            motion = ca.SX(6, 6)
            motion[:3, :3] = r.T
            motion[3:, 3:] = r.T
            motion[3:, :3] = -r.T @ ca.sparsify(skew(p))
            x.append(motion)
            v = motion @ speed[self.arm.parent[i]]
            k = 5 if self.arm.prismatic[i] else 2
            s = ca.SX(6, 1)
            s[k] = self.qd[i]
            bias.append(ca.vertcat(cross(v[:3], s[:3]), cross(v[3:], s[:3]) + cross(v[:3], s[3:])))
            v = speed[i] = v + s
            m, c = self.arm.mass[i], self.arm.com[i]
            about = self.arm.inertia[i] + m * (c @ c * np.eye(3) - np.outer(c, c))
            hat = m * np.array([[0, -c[2], c[1]], [c[2], 0, -c[0]], [-c[1], c[0], 0]])
            body = const(np.block([[about, hat], [hat.T, m * np.eye(3)]]))
            inertia.append(body)
            h = body @ v
            force.append(ca.vertcat(cross(v[:3], h[:3]) + cross(v[3:], h[3:]), cross(v[:3], h[3:])))
        u, d, column = [None] * n, [None] * n, [None] * n
        for i in reversed(range(n)):
            k = 5 if self.arm.prismatic[i] else 2
            column[i] = inertia[i][:, k]
            d[i] = column[i][k] + self.arm.armature[i]
            u[i] = self.tau[i] - self.friction(i) - force[i][k]
            before = self.arm.parent[i]
            if before >= 0:
                gain = column[i] / d[i]
                reduced = inertia[i] - gain @ column[i].T
                rest = force[i] + reduced @ bias[i] + gain * u[i]
                inertia[before] = inertia[before] + x[i].T @ reduced @ x[i]
                force[before] = force[before] + x[i].T @ rest
        moved = [None] * n + [ca.vertcat(ca.SX(3, 1), const(-self.arm.gravity))]
        result = []
        for i in range(n):
            k = 5 if self.arm.prismatic[i] else 2
            a = x[i] @ moved[self.arm.parent[i]] + bias[i]
            result.append((u[i] - ca.dot(column[i], a)) / d[i])
            a[k] += result[-1]
            moved[i] = a
        return ca.vertcat(*result)

    def factored(self, d, rhs):
        """D x = rhs by LDLᵀ from the last joint on, which keeps the zeros of an arm."""
        n = d.shape[0]
        a = [[d[i, j] for j in range(n)] for i in range(n)]
        low = [[0] * n for _ in range(n)]
        inverse = [None] * n
        for k in reversed(range(n)):
            inverse[k] = 1 / a[k][k]
            for i in range(k):
                low[k][i] = a[k][i] * inverse[k]
            for i in range(k):
                for j in range(i + 1):
                    a[i][j] = a[i][j] - low[k][i] * a[k][j]
        x = [rhs[i] for i in range(n)]
        for k in reversed(range(n)):
            for i in range(k):
                x[i] = x[i] - low[k][i] * x[k]
        for k in range(n):
            x[k] = x[k] * inverse[k]
            for i in range(k):
                x[k] = x[k] - low[k][i] * x[i]
        return ca.vertcat(*x)

    def functions(self):
        """name → function, its inputs in the order of ours."""
        q, qd, qdd, tau = self.q, self.qd, self.qdd, self.tau
        zero, g = ca.SX(self.n, 1), self.arm.gravity
        ways = (None, self.arm.about_origins(), self.arm.regrouped())
        torque = [self.damped(self.newton_euler(qd, qdd, g, way)) for way in ways]
        state = [q, qd, qdd]
        result = {"inverse_dynamics": best(*(made("inverse_dynamics", state, t) for t in torque))}
        still = [self.newton_euler(zero, zero, g, way) for way in ways]
        still += [ca.gradient(self.potential_energy(way), q) for way in ways[1:]]
        result["gravity"] = best(*(made("gravity", [q], c) for c in still))
        matrices = [self.composite(way) for way in ways[1:]] + [ca.jacobian(t, qdd) for t in torque]
        result["inertia"] = best(*(made("inertia", [q], d) for d in matrices))
        load = [self.damped(self.newton_euler(qd, zero, g, way)) for way in ways]
        solved = [self.factored(d, tau - b) for d in matrices for b in load]
        if self.links == self.n:
            solved.append(self.articulated())
        given = [q, qd, tau]
        forward = [made("forward_dynamics", given, x) for x in solved]
        result["forward_dynamics"] = best(*forward)
        slopes = [
            made(
                "inverse_dynamics_derivatives",
                state,
                *(ca.jacobian(t, x) for x in (q, qd, qdd)),
            )
            for t in torque
        ]
        result["inverse_dynamics_derivatives"] = best(*slopes)
        short = solved[min(range(len(solved)), key=lambda i: sum(counts(forward[i])[:3]))]
        # By differentiation of the whole, and from −D⁻¹ ∂τ/∂x at the solution.
        name = "forward_dynamics_derivatives"
        tries = [made(name, given, *(ca.jacobian(short, x) for x in (q, qd, tau)))]
        unit = ca.SX.eye(self.n)
        solve = [self.factored(matrices[1], unit[:, k]) for k in range(self.n)]
        inverse = ca.horzcat(*solve)
        for t in torque:
            slopes = [ca.substitute(ca.jacobian(t, x), qdd, short) for x in (q, qd)]
            tries.append(made(name, given, *(-(inverse @ s) for s in slopes), inverse))
        result[name] = best(*tries)
        return result

    def hand(self):
        """The last frame of a serial arm: its Jacobian in base axes, linear over angular, by axes and levers."""
        r, origin, axes = ca.SX.eye(3), ca.SX(3, 1), []
        for i in range(self.n):
            origin = origin + r @ self.offset[i]
            r = r @ self.rotation[i]
            axes.append((r[:, 2], origin))
        column = [
            ca.vertcat(z, ca.SX(3, 1))
            if self.arm.prismatic[i]
            else ca.vertcat(cross(z, origin - p), z)
            for i, (z, p) in enumerate(axes)
        ]
        return ca.horzcat(*column)

    def solved(self, matrix, *columns):
        """matrix X = columns, whose factors are one after `cse`."""
        return ca.horzcat(*(self.factored(matrix, column) for column in columns))

    def operational(self):
        """name → function of the hand's dynamics, from D of fewest operations."""
        q, qd, damping = self.q, self.qd, ca.SX.sym("damping")
        zero, g = ca.SX(self.n, 1), self.arm.gravity
        ways = (None, self.arm.about_origins(), self.arm.regrouped())
        d = self.composite(ways[2])
        j = self.hand()
        rate = ca.jtimes(j @ qd, q, qd)
        loads = [self.newton_euler(qd, zero, g, way) for way in ways]
        driven = ca.horzcat(*(self.factored(d, j[k, :].T) for k in range(6)))
        mobility = j @ driven
        damped = mobility + damping * ca.SX.eye(6)
        unit = ca.SX.eye(6)
        inertia = self.solved(damped, *(unit[:, k] for k in range(6)))
        by_inertia = driven @ inertia
        by_solving = self.solved(damped, *(driven[k, :].T for k in range(self.n))).T
        with_damping, still = [q, damping], [q, qd, damping]
        one = ca.SX.eye(self.n)
        bias = []
        for load in loads:
            for falling in (driven.T @ load, j @ self.factored(d, load)):
                bias.append(self.solved(damped, falling - rate))
                bias.append(inertia @ (falling - rate))
        return {
            "operational_inertia_inverse": made("a", [q], mobility),
            "operational_inertia": made("a", with_damping, inertia),
            "consistent_inverse": best(
                *(made("a", with_damping, x) for x in (by_inertia, by_solving))
            ),
            "operational_bias": best(*(made("a", still, x) for x in bias)),
            "null_space_projector": best(
                *(made("a", with_damping, one - x @ j) for x in (by_inertia, by_solving))
            ),
            "task": best(
                *(
                    made("a", still, inertia, x, y, one - x @ j)
                    for x in (by_inertia, by_solving)
                    for y in bias
                )
            ),
        }

    def second_derivatives(self):
        """name → function of the second derivatives of λᵀτ and λᵀq̈ for a given λ: by
        differentiation of the whole, and those of q̈ from those of τ at the solution."""
        q, qd, qdd, tau = self.q, self.qd, self.qdd, self.tau
        multiplier, raised = (ca.SX.sym(name, self.n) for name in ("multiplier", "raised"))
        zero, g = ca.SX(self.n, 1), self.arm.gravity
        ways = (None, self.arm.about_origins(), self.arm.regrouped())
        torques = [self.damped(self.newton_euler(qd, qdd, g, way)) for way in ways]

        def parts(value, driven):
            by_q = ca.gradient(value, q)
            by_driven = ca.jacobian(ca.gradient(value, driven), q)
            return ca.hessian(value, q)[0], ca.jacobian(by_q, qd), ca.hessian(value, qd)[0], by_driven

        def at_once(value):
            n, all_of = self.n, ca.hessian(value, ca.vertcat(q, qd, qdd))[0]
            return all_of[:n, :n], all_of[:n, n : 2 * n], all_of[n : 2 * n, n : 2 * n], all_of[2 * n :, :n]

        name, given = "inverse_dynamics_second_derivatives", [q, qd, qdd, multiplier]
        weighed = [ca.dot(multiplier, torque) for torque in torques]
        tries = [made(name, given, *parts(value, qdd)) for value in weighed]
        result = {name: best(*tries, *(made(name, given, *at_once(value)) for value in weighed))}
        name, given = "forward_dynamics_second_derivatives", [q, qd, tau, multiplier]
        d = self.composite(ways[2])
        solved = self.factored(d, tau - self.damped(self.newton_euler(qd, zero, g, ways[2])))
        accelerations = [ca.dot(multiplier, solved)]
        if self.links == self.n:
            accelerations.append(ca.dot(multiplier, self.articulated()))
        tries = [made(name, given, *parts(value, tau)) for value in accelerations]
        for torque in torques:
            matrices = [*parts(ca.dot(raised, torque), qdd), ca.jacobian(torque, q), ca.jacobian(torque, qd)]
            own = [ca.substitute(x, raised, self.factored(d, multiplier)) for x in matrices]
            by_qq, by_qv, by_vv, driven, *slopes = (ca.substitute(x, qdd, solved) for x in own)
            x = ca.horzcat(*(self.factored(d, driven[:, k]) for k in range(self.n))).T
            bent = x @ slopes[0]
            all_of = bent + bent.T - by_qq, x @ slopes[1] - by_qv, -by_vv, -x.T
            tries.append(made(name, given, *all_of))
        return result | {name: best(*tries)}
