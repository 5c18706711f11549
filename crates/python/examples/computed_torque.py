"""Follow a motion by computed torque, with a model that is right and one that is light.

python examples/computed_torque.py [picture.png]
"""

import sys
from pathlib import Path

import numpy as np

import dalembert

ROBOT = Path(__file__).resolve().parents[3] / "generated" / "robots" / "planar3r.toml"
STEP, STEPS = 1e-3, 2000
STIFF, DAMP = 400.0, 40.0


def wanted(t: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Positions, velocities and accelerations of the motion at a time."""
    rate = np.array([1.0, 2.0, 3.0])
    return 0.6 * np.sin(rate * t), 0.6 * rate * np.cos(rate * t), -0.6 * rate**2 * np.sin(rate * t)


def follow(arm: dalembert.Arm, believed: float) -> np.ndarray:
    """Return the error of every step, where the controller believes in so much torque."""
    q, qd = np.zeros(3), np.zeros(3)
    errors = np.empty((STEPS, 3))
    for step in range(STEPS):
        at, rate, change = wanted(step * STEP)
        command = change + DAMP * (rate - qd) + STIFF * (at - q)
        tau = believed * arm.inverse_dynamics(q, qd, command)
        qd = qd + STEP * arm.forward_dynamics(q, qd, tau)
        q = q + STEP * qd
        errors[step] = wanted((step + 1) * STEP)[0] - q
    return errors


def main(picture: str | None) -> tuple[float, float]:
    arm = dalembert.load(ROBOT, outputs=["inverse_dynamics", "forward_dynamics"])
    right, light = follow(arm, 1.0), follow(arm, 0.8)
    late = slice(STEPS // 2, None)
    ends = float(np.abs(right[late]).max()), float(np.abs(light[late]).max())
    print(f"largest error: {ends[0]:.1e} rad with the model, {ends[1]:.1e} with 80 % of it")
    if picture:
        import matplotlib

        matplotlib.use("Agg")
        import matplotlib.pyplot as plt

        t = STEP * np.arange(STEPS)
        plt.figure(figsize=(8, 4))
        plt.semilogy(t, np.abs(right).max(axis=1) + 1e-12, label="the model")
        plt.semilogy(t, np.abs(light).max(axis=1) + 1e-12, label="80 % of it")
        plt.xlabel("s")
        plt.ylabel("largest error, rad")
        plt.legend()
        plt.savefig(picture, dpi=120)
    return ends


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "computed_torque.png")
