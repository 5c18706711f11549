"""Identify an arm's base parameters from noisy torques, by the regressor.

python examples/identification.py [picture.png]
"""

import sys
from pathlib import Path

import numpy as np

import dalembert

ROBOT = Path(__file__).resolve().parents[3] / "generated" / "robots" / "planar3r.toml"
NOISE = 0.05


def main(picture: str | None) -> float:
    arm = dalembert.load(ROBOT, outputs=["inverse_dynamics", "regressor"])
    rng = np.random.default_rng(3)
    train, test = ([rng.normal(size=(count, 3)) for _ in range(3)] for count in (500, 200))
    measured = arm.inverse_dynamics(*train)
    measured = measured + NOISE * rng.normal(size=measured.shape)
    y = arm.regressor(*train)
    parameters, *_ = np.linalg.lstsq(y.reshape(-1, y.shape[-1]), measured.ravel(), rcond=None)
    predicted = arm.regressor(*test) @ parameters
    true = arm.inverse_dynamics(*test)
    error = float(np.sqrt(((predicted - true) ** 2).mean()))
    print(f"{len(parameters)} base parameters; noise {NOISE} N·m, error after it {error:.4f} N·m")
    if picture:
        import matplotlib

        matplotlib.use("Agg")
        import matplotlib.pyplot as plt

        plt.figure(figsize=(5, 5))
        plt.plot(true, predicted, ".")
        plt.xlabel("torque, N·m")
        plt.ylabel("predicted, N·m")
        plt.savefig(picture, dpi=120)
    return error


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "identification.png")
