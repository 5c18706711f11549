"""Dynamics of robot arms: searched for, proved and compiled in memory for one arm.

>>> import dalembert
>>> arm = dalembert.load("generated/robots/planar2r.toml")
>>> arm.inverse_dynamics(q=[0.0, 0.0], qd=[0.0, 0.0], qdd=[1.0, 0.0])
array([22.28666667,  5.73833333])

Angles are in rad, lengths in m, masses in kg, torques in N·m, forces in N.
"""

from . import pose
from ._arm import Arm, Joint, Limits, load
from ._dalembert import Function, Load

__all__ = ["Arm", "Function", "Joint", "Limits", "Load", "load", "outputs", "pose"]
__version__ = "0.1.0"


def outputs() -> dict[str, str]:
    """Return the names of all outputs that ``load`` can be asked for, with a line each."""
    from . import _dalembert

    return dict(_dalembert.outputs())
