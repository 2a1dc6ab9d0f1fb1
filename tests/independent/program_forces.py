"""What presses a follower onto its cam, from the balance of forces alone: mass, spring, load; N and m, mm and rad."""
import math
import re

import numpy as np


def number(text):
    """Of a quantity in SI units; lengths of a rate in m."""
    value, unit = re.fullmatch(r"\s*(\S+)\s*(.*)", text).groups()
    return float(value) * {"N/mm": 1e3, "lb": 0.45359237}.get(unit, 1.0)


class Load:
    """Force along the path, or moment about the pivot: m s'' ω² + c s' ω + k s + F."""

    def __init__(self, case, program):
        follower, spring = case["follower"], case["spring"]
        self.swings, self.program = case["kind"].startswith("swinging"), program
        mass = follower.get("inertia" if self.swings else "mass")
        self.moves = mass is not None
        self.mass = number(mass) if mass else 0.0
        self.rate, self.damping = (number(spring[key]) if key in spring else 0.0 for key in ("rate", "damping"))
        self.constant = sum(number(text) for text in (follower.get("preload"), spring.get("preload"), spring.get("load")) if text)
        self.pressed = bool(spring) or "preload" in follower
        # Without a speed only what does not move is known.
        self.omega = program.omega or 0.0
        self.unit = 1.0 if self.swings else 1e-3

    def at(self, lift, v, a):
        scale = self.unit
        force = self.mass * a * scale * self.omega**2 + self.damping * v * scale * self.omega
        return force + self.rate * lift * scale + self.constant

    @staticmethod
    def reach(follower, curves):
        """Distance in m over which a moment becomes a force; 1 on a straight path."""
        if follower.kind == "swinging-roller":
            return follower.arm * 1e-3
        if follower.kind == "swinging-flat":
            return np.hypot(curves["face"], follower.away) * 1e-3
        return 1.0

    def along(self, follower):
        """Of part and angle: the force along the path of the contact, and normal to the cam."""
        def function(i, t):
            s, v, a = self.program.jet(i, t, 2)
            lift = s - self.program.lowest
            curves = follower.curves(t, lift, v, a)
            force = self.at(lift, v, a) / self.reach(follower, curves)
            return force, force / np.cos(curves["alpha"])
        return function

    def torque(self, i, t):
        """Of the camshaft, N·m."""
        s, v, a = self.program.jet(i, t, 2)
        return self.at(s - self.program.lowest, v, a) * v * self.unit

    def least(self, follower):
        function = self.along(follower)
        return [-self.program.extreme(lambda i, t: -function(i, t)[which])[0] for which in (0, 1)]

    def jump(self):
        """The least speed of the cam, rad/s, at which the force is 0 somewhere."""
        scale = self.unit

        def slowness(i, t):
            """1/ω of the slowest such speed: 0 where there is none; it has no poles."""
            s, v, a = self.program.jet(i, t, 2)
            still = self.rate * (s - self.program.lowest) * scale + self.constant
            heavy, drag = self.mass * a * scale, self.damping * v * scale
            # still/ω² + drag/ω + heavy = 0: the larger root in 1/ω.
            with np.errstate(invalid="ignore", divide="ignore"):
                inside = drag**2 - 4 * still * heavy
                root = (-drag + np.sqrt(np.maximum(inside, 0))) / (2 * still)
                found = np.where((inside >= 0) & (root > 0), root, 0.0)
            return np.where(still > 0, found, np.where((still < 0) | (heavy < -1e-12 * self.mass) | (drag < 0), math.inf, 0.0))

        most = self.program.extreme(slowness)[0]
        return math.inf if most == 0 else 1 / most
