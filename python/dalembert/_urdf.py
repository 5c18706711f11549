"""The joints beside a chain of a URDF."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ElementTree

_MOVABLE = ("revolute", "continuous", "prismatic")


def beside(source: str, tip: str) -> dict[str, float]:
    """Return every joint that is not between the root and ``tip``, at zero, or at the limit
    nearest to zero; one that mimics another where that takes it."""
    joints = ElementTree.fromstring(source).findall("joint")
    above = {_link(joint, "child"): joint for joint in joints}
    chain, link = set(), tip
    while link in above and link not in chain:
        chain.add(link)
        link = _link(above[link], "parent")
    others = [
        joint
        for joint in joints
        if joint.get("type") in _MOVABLE and _link(joint, "child") not in chain
    ]
    found = {joint.get("name", ""): _nearest_zero(joint) for joint in others}
    for joint in others:
        mimic = joint.find("mimic")
        if mimic is not None and mimic.get("joint", "") in found:
            times, plus = float(mimic.get("multiplier", "1")), float(mimic.get("offset", "0"))
            found[joint.get("name", "")] = times * found[mimic.get("joint", "")] + plus
    return found


def _link(joint: ElementTree.Element, end: str) -> str:
    found = joint.find(end)
    return "" if found is None else found.get("link", "")


def _nearest_zero(joint: ElementTree.Element) -> float:
    limit = joint.find("limit")
    if limit is None or joint.get("type") == "continuous":
        return 0.0
    try:
        lower, upper = (float(limit.get(end, "0")) for end in ("lower", "upper"))
    except ValueError:
        # What is wrong with the file, the reader says.
        return 0.0
    is_limit = math.isfinite(lower) and math.isfinite(upper) and lower < upper
    return min(max(0.0, lower), upper) if is_limit else 0.0
