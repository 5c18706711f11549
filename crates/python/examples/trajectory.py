"""Find the motion between two positions that takes the least torque, by our derivatives.

python examples/trajectory.py [picture.png]
"""

import sys
from pathlib import Path

import numpy as np
from scipy.optimize import minimize

import dalembert

ROBOT = Path(__file__).resolve().parents[3] / "generated" / "robots" / "planar3r.toml"
KNOTS, TIME = 40, 1.0


def main(picture: str | None) -> tuple[float, float]:
    arm = dalembert.load(
        ROBOT, outputs=["inverse_dynamics", "inverse_dynamics_derivatives"]
    )
    n, h = len(arm.joints), TIME / (KNOTS - 1)
    begin, end = np.array([-1.2, 0.3, 0.2]), np.array([0.8, -0.4, 0.6])
    # Differences of positions: velocities and accelerations at the inner knots.
    inner = np.arange(1, KNOTS - 1)
    first = np.zeros((KNOTS - 2, KNOTS))
    first[inner - 1, inner + 1], first[inner - 1, inner - 1] = 0.5 / h, -0.5 / h
    second = np.zeros((KNOTS - 2, KNOTS))
    second[inner - 1, inner + 1] = second[inner - 1, inner - 1] = 1 / h**2
    second[inner - 1, inner] = -2 / h**2
    # At rest at both ends: the first and last two knots are fixed.
    free = np.arange(2, KNOTS - 2)

    def whole(x: np.ndarray) -> np.ndarray:
        q = np.empty((KNOTS, n))
        q[:2], q[-2:] = begin, end
        q[free] = x.reshape(-1, n)
        return q

    def effort(x: np.ndarray) -> tuple[float, np.ndarray]:
        q = whole(x)
        motion = q[inner], first @ q, second @ q
        tau = arm.inverse_dynamics(*motion)
        slopes = arm.inverse_dynamics_derivatives(
            *motion[: len(arm.inverse_dynamics_derivatives.arguments)]
        )
        by_q, by_qd, by_qdd = (np.einsum("ki,kij->kj", 2 * h * tau, slope) for slope in slopes)
        gradient = first.T @ by_qd + second.T @ by_qdd
        gradient[inner] += by_q
        return h * float((tau**2).sum()), gradient[free].ravel()

    s = np.linspace(0, 1, KNOTS)[free, None]
    straight = (begin + (10 * s**3 - 15 * s**4 + 6 * s**5) * (end - begin)).ravel()
    found = minimize(effort, straight, jac=True, method="L-BFGS-B", options={"maxiter": 2000})
    before, after = effort(straight)[0], float(found.fun)
    print(f"∫τ² dt: {before:.2f} by a polynomial, {after:.2f} after {found.nit} steps")
    if picture:
        import matplotlib

        matplotlib.use("Agg")
        import matplotlib.pyplot as plt

        t = np.linspace(0, TIME, KNOTS)
        plt.figure(figsize=(8, 4))
        for joint in range(n):
            line = plt.plot(t, whole(found.x)[:, joint], label=arm.joints[joint].name)
            plt.plot(t, whole(straight)[:, joint], "--", color=line[0].get_color())
        plt.xlabel("s")
        plt.ylabel("position, rad (dashed: before)")
        plt.legend()
        plt.savefig(picture, dpi=120)
    return before, after


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "trajectory.png")
