"""Hold an SO-101 against gravity, and draw the torques that it takes along a motion.

python examples/gravity_compensation.py [picture.png]
"""

import sys
from pathlib import Path

import numpy as np

import dalembert

URDF = Path(__file__).resolve().parents[3] / "crates" / "import" / "tests" / "data" / "so101.urdf"


def main(picture: str | None) -> float:
    arm = dalembert.load(
        URDF, tip="gripper_frame_link", lock="*", outputs=["gravity", "forward_dynamics"]
    )
    names = [joint.name for joint in arm.joints]
    n, steps = len(names), 200
    # From one end of the joints' limits to the other and back.
    lower, upper = arm.limits.lower, arm.limits.upper
    phase = 0.5 - 0.5 * np.cos(np.linspace(0, 2 * np.pi, steps))[:, None]
    q = lower + (0.1 + 0.8 * phase) * (upper - lower)
    tau = arm.gravity(q)
    # With these torques the arm at rest stays at rest.
    rest = arm.forward_dynamics(q, np.zeros(n), tau)
    print(f"{arm.name}: largest acceleration while held {np.abs(rest).max():.1e} rad/s²")
    if picture:
        import matplotlib

        matplotlib.use("Agg")
        import matplotlib.pyplot as plt

        plt.figure(figsize=(8, 4))
        plt.plot(tau, label=names)
        plt.xlabel("step")
        plt.ylabel("torque that holds the arm, N·m")
        plt.legend()
        plt.savefig(picture, dpi=120)
    return float(np.abs(rest).max())


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "gravity_compensation.png")
