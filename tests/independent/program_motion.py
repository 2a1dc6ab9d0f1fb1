"""Motion programs of `camgen make` from the specification alone: quantities, laws, segments, jets and jumps.

A law is a pattern of its acceleration, integrated piece by piece and scaled to its ends by two linear conditions, or a textbook formula, or
the polynomial of its end conditions; splines, tables and formulas of their own are those of program_spline. mm and rad.
"""
import math
import re

import numpy as np
from program_spline import Driven, Formula, Interval, Joined, periodic, solved, through_table

PI, TAU = math.pi, 2 * math.pi
LENGTHS = {"um": 1e-3, "mm": 1.0, "cm": 10.0, "in": 25.4, "m": 1000.0}
ANGLES = {"deg": PI / 180, "rad": 1.0}


class Illegal(Exception):
    """The file asks for something that the specification refuses."""


class Piece:
    """Σ c (x − ref)^k + Σ A sin(ω (x − ref) + φ) on [low, high]."""

    def __init__(self, low, high, coefficients, waves=(), ref=None):
        self.low, self.high, self.ref = low, high, low if ref is None else ref
        self.waves = list(waves)
        self.coefficients = [[float(c) for c in coefficients]]
        for _ in range(6):
            self.coefficients.append([k * c for k, c in enumerate(self.coefficients[-1])][1:])

    def at(self, x, order):
        t = x - self.ref
        value = np.zeros_like(t)
        for c in reversed(self.coefficients[order]):
            value = value * t + c
        for amplitude, pace, phase in self.waves:
            value = value + amplitude * pace**order * np.sin(pace * t + phase + order * PI / 2)
        return value


def integrated(patterns, velocity, value):
    """Twice integrates accelerations (low, high, polynomial, (amplitude, pace, phase) or None) from a state on; pieces and the end state."""
    pieces = []
    for low, high, poly, wave in patterns:
        coefficients = [value, velocity] + [c / ((k + 1) * (k + 2)) for k, c in enumerate(poly)]
        waves = []
        if wave:
            amplitude, pace, phase = wave
            waves = [(-amplitude / pace**2, pace, phase)]
            coefficients[0] += amplitude / pace**2 * math.sin(phase)
            coefficients[1] += amplitude / pace * math.cos(phase)
        piece = Piece(low, high, coefficients, waves)
        end = np.array([high])
        value, velocity = float(piece.at(end, 0)[0]), float(piece.at(end, 1)[0])
        pieces.append(piece)
    return pieces, value, velocity


def half_patterns(ramp, fractions, origin, width, sign):
    """Acceleration of one half of height 1: grows, stays, falls, rests from its outer end; `sign` −1 runs back from there."""
    found, y = [], 0.0
    for kind, share in zip(("grows", "stays", "falls", "rests"), fractions):
        if share == 0:
            continue
        size = share * width
        near, far = origin + sign * y * width, origin + sign * (y + share) * width
        low, high = min(near, far), max(near, far)
        # Backwards in y, a growing ramp falls in x.
        rises = (kind == "grows") == (sign > 0)
        if kind in ("grows", "falls"):
            if ramp == "sine":
                found.append((low, high, [], (1.0, PI / 2 / size, 0.0 if rises else PI / 2)))
            else:
                found.append((low, high, [0.0, 1 / size] if rises else [1.0, -1 / size], None))
        else:
            found.append((low, high, [1.0 if kind == "stays" else 0.0], None))
        y += share
    return found if sign > 0 else found[::-1]


def scaled(patterns, factor):
    return [(low, high, [c * factor for c in poly], wave and (wave[0] * factor, *wave[1:])) for low, high, poly, wave in patterns]


def halves(ramp, first, second, inflection, v0, v1):
    """Two halves whose heights follow from travel 1 and the end velocity: two linear conditions."""
    lower = half_patterns(ramp, first, 0.0, inflection, 1)
    upper = half_patterns(ramp, second, 1.0, 1 - inflection, -1)
    _, s0, w0 = integrated(scaled(lower + upper, 0.0), v0, 0.0)
    _, s1, w1 = integrated(lower + scaled(upper, 0.0), 0.0, 0.0)
    _, s2, w2 = integrated(scaled(lower, 0.0) + upper, 0.0, 0.0)
    p, q = np.linalg.solve([[s1, s2], [w1, w2]], [1 - s0, v1 - w0])
    return integrated(scaled(lower, p) + scaled(upper, q), v0, 0.0)[0]


def hermite(start, end):
    """The polynomial with these derivatives at x = 0 and x = 1, about the middle."""
    count = len(start) + len(end)
    rows, right = [], []
    for t, given in ((-1.0, start), (1.0, end)):
        for order, value in enumerate(given):
            rows.append([math.perm(k, order) * t ** (k - order) if k >= order else 0.0 for k in range(count)])
            right.append(value / 2**order)
    rows, right = np.array(rows), np.array(right)
    c = np.linalg.solve(rows, right)
    c += np.linalg.solve(rows, right - rows @ c)
    return [Piece(0.0, 1.0, c * 2.0 ** np.arange(count), ref=0.5)]


def sines(terms, v):
    """v x + (1 − v)(x − Σ b sin(2πk x)) of terms (b, k)."""
    return [Piece(0.0, 1.0, [0.0, 1.0], [(-(1 - v) * b, TAU * k, 0.0) for b, k in terms])]


HALVES = {
    "cycloidal": ("sine", (0.5, 0, 0.5, 0)),
    "modified-sine": ("sine", (0.25, 0, 0.75, 0)),
    "harmonic": ("sine", (0, 0, 1, 0)),
    "modified-trapezoid": ("sine", (0.25, 0.5, 0.25, 0)),
    "modified-sine-cv20": ("sine", (0.2, 0, 0.6, 0.2)),
    "modified-sine-cv33": ("sine", (1 / 6, 0, 0.5, 1 / 3)),
    "modified-sine-cv50": ("sine", (1 / 8, 0, 3 / 8, 0.5)),
    "modified-sine-cv66": ("sine", (1 / 12, 0, 0.25, 2 / 3)),
    "cycloidal-cv50": ("sine", (0.25, 0, 0.25, 0.5)),
    "scca": ("sine", None),
    "parabola": ("sine", (0, 1, 0, 0)),
    "parabola-line": ("sine", None),
    "sine-line": ("sine", None),
    "s-curve": ("straight", None),
    "constant-jerk": ("straight", (0.5, 0, 0.5, 0)),
}
POLYNOMIALS = {"cubic": 2, "3-4-5": 3, "4-5-6-7": 4, "5-6-7-8-9": 5}
SINES = {
    "gutman-1-3": [(15 / (32 * PI), 1), (1 / (96 * PI), 3)],
    "freudenstein-1-3": [(27 / 28 / TAU, 1), (1 / 84 / TAU, 3)],
    "freudenstein-1-3-5": [(1125 / 1192 / TAU, 1), (1125 / 1192 / 54 / TAU, 3), (1125 / 1192 / 1250 / TAU, 5)],
    "triple-harmonic": None,
}
ALIASES = {"line": "constant-velocity", "poly1": "constant-velocity", "2-3": "cubic", "poly5": "3-4-5", "poly7": "4-5-6-7", "poly9": "5-6-7-8-9"}
NAMES = [*HALVES, *POLYNOMIALS, *SINES, "double-harmonic", "constant-velocity"]


def half_of(law, own):
    ramp, fractions = HALVES[law]
    if law == "scca":
        fractions = tuple(own.get("fractions", (0.25,) * 4))
        if abs(sum(fractions) - 1) > 1e-12 or any(0 < share < 1e-6 for share in fractions) or not sum(fractions[:3]) > 0:
            raise Illegal("parameter")
    if law == "parabola-line":
        fractions = (0, 1 - own.get("line", 0.5), 0, own.get("line", 0.5))
    if law == "sine-line":
        fractions = (0, 0, 1 - own.get("line", 0.5), own.get("line", 0.5))
    if law in ("parabola-line", "sine-line") and own.get("line", 0.5) > 1 - 1e-6:
        raise Illegal("parameter")
    if law == "s-curve":
        a = own.get("ramp", 0.25)
        if a < 1e-6:
            raise Illegal("parameter")
        fractions = (a, 1 - 2 * a, a, 0)
    return ramp, fractions


def turned(law, ramp, fractions):
    """The half at a turn: a full acceleration from the start."""
    a, b, c, _ = fractions
    if a == 0:
        return fractions
    return (0, a + b, c, 0) if ramp == "straight" or law == "modified-trapezoid" or fractions == (0.25, 0.5, 0.25, 0) else (0, 0, 1, 0)


def slope_at_inflection(ramp, fractions):
    """Of the acceleration of a half of velocity 1, or None where it is 0 or jumps."""
    a, b, c, d = fractions
    if c == 0 or d > 0:
        return None
    area, steep = (2 / PI, PI / 2) if ramp == "sine" else (0.5, 1.0)
    return steep / c / (area * (a + c) + b)


def law_pieces(law, own, start, end, inflection, beside):
    """Pieces of a law between two ends, each ("R", 0), ("G", velocity in units of travel over width) or ("U", 0)."""
    kinds, (v0, v1) = start[0] + end[0], (start[1], end[1])
    if law in HALVES:
        ramp, plain = half_of(law, own)
        first, second = (turned(law, ramp, plain) if kind == "U" else plain for kind in kinds)
        if inflection == "match":
            at = matched(lambda x: halves(ramp, first, second, x, v0, v1), kinds, beside)
        elif inflection == "smooth":
            slopes = slope_at_inflection(ramp, first), slope_at_inflection(ramp, second)
            at = 0.5 if first == second or None in slopes else 1 / (1 + math.sqrt(slopes[1] / slopes[0]))
        else:
            at = inflection
            if not 1e-6 <= at <= 1 - 1e-6:
                raise Illegal("inflection")
        return halves(ramp, first, second, at, v0, v1)
    unequal = abs(v0 - v1) > 1e-9
    if law == "double-harmonic":
        if kinds not in ("RU", "UR"):
            raise Illegal("serve")
        pieces = [Piece(0.0, 1.0, [0.375], [(-0.5, PI, PI / 2), (0.125, TAU, PI / 2)])]
        if kinds == "UR":
            # 1 − s(1 − x), with cos π(1 − x) = −cos πx.
            pieces = [Piece(0.0, 1.0, [0.625], [(-0.5, PI, PI / 2), (-0.125, TAU, PI / 2)])]
    elif "U" in kinds or (law in SINES and unequal):
        raise Illegal("serve")
    elif law in POLYNOMIALS:
        rest = [0.0] * (POLYNOMIALS[law] - 2)
        pieces = hermite([0.0, v0, *rest], [1.0, v1, *rest])
    else:
        terms = SINES[law]
        if terms is None:
            amplitudes = own.get("amplitudes", (9 * PI / 4, 0, -3 * PI / 4))
            whole = sum(a / (TAU * k) for k, a in enumerate(amplitudes, 1))
            if abs(whole) < 1e-9 * max(map(abs, amplitudes), default=0) or whole == 0:
                raise Illegal("parameter")
            terms = [(a / whole / (TAU * k) ** 2, k) for k, a in enumerate(amplitudes, 1)]
        pieces = sines(terms, v0)
    if inflection != "smooth":
        raise Illegal("inflection")
    return pieces


def matched(curve, kinds, wanted):
    """The inflection whose acceleration at the turn, of two the later, is the one wanted; nearest to half-way."""
    if "U" not in kinds or wanted is None:
        raise Illegal("inflection")
    x, side = (1.0, -1) if kinds[1] == "U" else (0.0, 0)

    def off(at):
        return float(curve(at)[side].at(np.array([x]), 2)[0]) - wanted

    grid = np.concatenate([10.0 ** np.linspace(-9, -2, 29), np.linspace(0.011, 0.989, 160), 1 - 10.0 ** np.linspace(-2, -9, 29)])
    values = np.array([off(at) for at in grid])
    roots = []
    for i in np.nonzero(values[:-1] * values[1:] <= 0)[0]:
        low, high = grid[i], grid[i + 1]
        for _ in range(80):
            middle = 0.5 * (low + high)
            low, high = (low, middle) if (off(middle) > 0) != (values[i] > 0) else (middle, high)
        roots.append(0.5 * (low + high))
    if not roots:
        raise Illegal("inflection")
    return min(roots, key=lambda root: abs(root - 0.5))


# ---------------------------------------------------------------- programs


STILL = {"auto": set(), "v": 0.0, "a": 0.0, "j": None, "turn": False}
# Laws that are not named but given.
OWN = ("spline", "formula", "table")


def read_table(text):
    """Columns of a table."""
    return np.array([[float(cell) for cell in re.split(r"[,;\s]+", line.strip())] for line in text.split("\n") if re.match(r"\s*[-+.0-9]", line)]).T


def quantity(text):
    number, unit = re.fullmatch(r"\s*([-+0-9.eE]*[0-9.])\s*([a-z]+)\s*", text).groups()
    return float(number) * (LENGTHS | ANGLES)[unit]


def rate(text, order, omega):
    """By the cam angle, mm or rad per rad to the order."""
    number, unit = text.split(" ")
    of, by = unit.split("/")
    each = ANGLES.get(by.rstrip("23"))
    if each is None and omega is None:
        raise Illegal("rpm")
    return float(number) * (LENGTHS | ANGLES)[of] / (each if each else omega) ** order


class Segment:
    """Between two cam angles and positions; its pieces over x in [0, 1] are multiplied by `scale`."""

    def __init__(self, law, start, width, source, begin, to, state):
        self.law, self.start, self.width, self.source, self.begin, self.to, self.state = law, start, width, source, begin, to, state
        self.pieces, self.scale, self.whole = [], 0.0, False


class Program:
    """Reads `[motion]` as the specification says and solves every segment."""

    def __init__(self, motion, segments, files=None):
        self.files = files or {}
        self.omega = motion["rpm"] * TAU / 60 if "rpm" in motion else None
        self.first, self.at = quantity(motion["start"]), quantity(motion.get("at", "0 deg"))
        self.lobes = motion.get("repeat", 1)
        self.fill = TAU / self.lobes
        self.segments, self.noise, self.driven, self.near = [], np.zeros(7), "polydyne" in motion, False
        forms = [key for key in ("formula", "points", "table", "fourier") if key in motion]
        if forms:
            self.whole(forms[0], motion)
            self.drive(motion)
            self.finish()
            return
        angle, position = 0.0, self.first
        for index, given in enumerate(segments):
            segment = self.read(given, index + 1 == len(segments), angle, position)
            angle, position = angle + segment.width, segment.to
            self.segments.append(segment)
        if abs(angle - self.fill) > 1e-9 * PI / 180:
            raise Illegal("sum")
        size = max([abs(self.first)] + [abs(s.to) for s in self.segments])
        if abs(position - self.first) > 1e-12 * size:
            raise Illegal("return")
        self.size = size
        self.solve()
        self.drive(motion)
        self.finish()

    def finish(self):
        """Parts, and where the position is lowest."""
        self.parts = []
        for segment in self.segments:
            for piece in segment.pieces:
                self.parts.append((segment.start + piece.low * segment.width, segment.start + piece.high * segment.width, segment, piece))
        self.ends = np.array([high for _, high, _, _ in self.parts])
        low, _ = self.extreme(lambda i, t: -self.jet(i, t, 0)[0])
        self.lowest = -low

    def whole(self, form, motion):
        """A formula, series, points or table over the turn or lobe."""
        unit = (LENGTHS | ANGLES)[motion["start"].split()[-1]]
        segment = Segment(form, self.at, self.fill, {}, self.first, self.first, STILL)
        segment.scale, segment.whole = 1.0, True
        if form == "formula":
            piece = Formula(motion["formula"], "th", 0.0, self.fill, 0.25 / (3 * self.lobes), unit)
            segment.pieces = [piece]
            self.noise = np.maximum(self.noise, piece.noise())
        elif form == "fourier":
            waves = [(a * unit, TAU * k, PI / 2) for k, a in enumerate(motion["fourier"].get("cos", []), 1)]
            waves += [(b * unit, TAU * k, 0.0) for k, b in enumerate(motion["fourier"].get("sin", []), 1)]
            piece = Piece(0.0, 1.0, [0.0], waves)
            piece.cells = 512
            segment.pieces = [piece]
        else:
            degree = motion.get("degree", 5) if form == "points" else 5
            if form == "points":
                knots = np.array([[quantity(a), quantity(p)] for a, p in motion["points"]]).T
            else:
                knots = read_table(self.files[motion["table"]]) * [[PI / 180], [unit]]
                knots = knots[:, :-1] if abs(knots[0, -1] - self.fill) < 1e-9 else knots
            # Both are counted from `at`; points are described from the first one on.
            if form == "points":
                if not knots[0, 0] < knots[0, -1] < knots[0, 0] + self.fill - 1e-12:
                    raise Illegal("range")
                segment.start = self.at = self.at + float(knots[0, 0])
            parts = periodic((knots[0] - knots[0, 0]) / self.fill, knots[1], 1.0, degree)
            segment.pieces = self.spline_pieces(parts, degree == 3)
            self.rounding(knots[1], np.diff(knots[0]).min())
        self.segments = [segment]
        self.size = max(abs(self.first), np.abs(self.first + np.concatenate([p.at(np.linspace(p.low, p.high, 500), 0) for p in segment.pieces])).max())

    def rounding(self, values, step):
        """What the rounding of positions makes of each derivative of a spline."""
        self.noise = np.maximum(self.noise, 2e-16 * np.abs(values).max() * 10.0 ** np.arange(7) / step ** np.arange(7))

    def spline_pieces(self, parts, apart):
        """One piece where the jerk is continuous; an elastic load asks for more."""
        apart |= self.driven
        return [Piece(low, high, c) for low, high, c in parts] if apart else [Joined(parts)]

    def drive(self, motion):
        """The cam whose elastic load moves as the program says."""
        polydyne = motion.get("polydyne")
        if polydyne is None:
            return
        rpm = polydyne.get("rpm", motion.get("rpm"))
        if rpm is None:
            raise Illegal("speed")
        self.finish()
        self.jumped = max(self.jump())
        if self.jumped > 1e-7:
            raise Illegal("impact")
        share = rpm / 60 / float(polydyne["natural_frequency"].split()[0])
        # The cam is the load's motion with two of its derivatives, and so is what rounding leaves.
        velocity, acceleration = 2 * polydyne.get("damping", 0.0) * share * self.noise[1:6], share**2 * self.noise[2:]
        self.noise[:5] += velocity + acceleration
        for segment in self.segments:
            if segment.law != "dwell":
                first, second = 2 * polydyne.get("damping", 0.0) * share / segment.width, (share / segment.width) ** 2
                segment.pieces = [Driven(piece, first, second) for piece in segment.pieces]

    def read(self, given, last, angle, position):
        law = given.get("law", "cycloidal").lower()
        law = ALIASES.get(law, law)
        if law not in NAMES and law not in ("dwell", "polynomial", *OWN):
            raise Illegal("name")
        auto = {letter for letter, key in (("v", "velocity"), ("a", "acceleration")) if given.get(key) == "auto"}
        if "v" in auto and "acceleration" not in given:
            # C4 there, as splines are; an acceleration of 0 has to be said.
            auto.add("a")
        given = {key: value for key, value in given.items() if value != "auto"}
        if law in ("formula", "table") and (auto or {"velocity", "acceleration", "jerk", "end"} & set(given)):
            raise Illegal("own state")
        state = {"auto": auto, "v": rate(given["velocity"], 1, self.omega) if "velocity" in given else 0.0,
                 "a": rate(given["acceleration"], 2, self.omega) if "acceleration" in given else 0.0,
                 "j": rate(given["jerk"], 3, self.omega) if "jerk" in given else None, "turn": given.get("end") == "turn"}
        moves = state["v"] != 0 or state["a"] != 0 or bool(auto)
        if moves and given.get("end") in ("turn", "rest"):
            raise Illegal("end")
        by_velocity = law == "constant-velocity" and state["v"] != 0
        to = position + quantity(given["by"]) if "by" in given else quantity(given["to"]) if "to" in given else None
        if "over" in given:
            width = quantity(given["over"])
        elif "until" in given:
            width = quantity(given["until"]) - self.at - angle
        elif by_velocity and to is not None:
            width = (to - position) / state["v"]
        else:
            width = self.fill - angle
            if not last:
                raise Illegal("over")
        if width <= 0:
            raise Illegal("sum")
        if law == "dwell" and (to is not None or moves or state["turn"]):
            raise Illegal("dwell")
        if to is None:
            to = position if law == "dwell" else position + state["v"] * width
        if law == "constant-velocity":
            if by_velocity and abs((to - position) / width - state["v"]) > 1e-6 * abs(state["v"]):
                raise Illegal("line")
            state = {"auto": set(), "v": (to - position) / width, "a": 0.0, "j": None, "turn": False}
        return Segment(law, self.at + angle, width, given, position, to, state)

    def following(self, segment):
        return self.segments[(self.segments.index(segment) + 1) % len(self.segments)]

    def meet(self):
        """A turn has the acceleration of the segment before it, else of that behind it, once one of them is known; rests and lines have none."""
        for segment in self.segments:
            if segment.state["turn"] and segment.state.get("turning") is None:
                for beside, side in ((segment, -1), (self.following(segment), 0)):
                    if beside.pieces and beside.law not in ("dwell", "constant-velocity"):
                        segment.state["turning"] = self.end_acceleration(beside, side)
                        break

    def solve(self):
        self.own_states()
        faults, later = set(), [s for s in self.segments if s.source.get("inflection") == "match" and s.law in NAMES]
        alone = [s for s in self.segments if s not in later and not s.pieces and s.law not in ("polynomial", "spline")]
        # A half without an inflection takes the acceleration of a formula or table behind its turn, where it can.
        adapts = lambda s: s.law in HALVES and "inflection" not in s.source and s.state["turn"] and self.following(s).law in ("formula", "table")
        self.chain_faults()
        for segment in sorted(alone, key=adapts):
            try:
                if adapts(segment):
                    try:
                        self.solve_one(segment, self.end_acceleration(self.following(segment), 0), "match")
                        continue
                    except Illegal:
                        pass
                self.solve_one(segment, None)
            except Illegal as fault:
                faults.add(str(fault))
        self.meet()
        chain = self.least_jerk()
        for segment in [s for s in self.segments if s not in later + chain and not s.pieces] + later:
            self.meet()
            wanted = None
            if segment in later:
                index = self.segments.index(segment)
                before, after = self.segments[index - 1], self.segments[(index + 1) % len(self.segments)]
                beside, side = (after, 0) if segment.state["turn"] else (before, -1)
                turns = segment.state["turn"] or before.state["turn"]
                wanted = self.end_acceleration(beside, side) if turns and beside not in later and beside.pieces else None
            try:
                self.solve_one(segment, wanted)
            except Illegal as fault:
                faults.add(str(fault))
                # Where there is nothing to match, that is a fault beside any other.
                if segment in later and wanted is None:
                    faults.add("inflection")
        if faults:
            raise Illegal(", ".join(sorted(faults)))

    @staticmethod
    def end_acceleration(segment, side):
        return float(segment.pieces[side].at(np.array([0.0 if side == 0 else 1.0]), 2)[0]) * segment.scale / segment.width**2

    def own_states(self):
        """Formulas and tables have the states at their ends themselves."""
        for segment in self.segments:
            if segment.law not in ("formula", "table"):
                continue
            travel = segment.to - segment.begin
            if abs(travel) <= 1e-12 * self.size:
                raise Illegal("travel")
            if segment.law == "formula":
                segment.pieces = [Formula(segment.source["formula"], "x", 0.0, 1.0, 0.1)]
            else:
                x, y = read_table(self.files[segment.source["table"]])
                segment.pieces = self.spline_pieces(through_table(x, y, segment.source.get("ends") == "rest"), False)
                self.rounding(y * abs(travel), np.diff(x).min() * segment.width)
            segment.scale = travel
            last = segment.pieces[-1]
            v, a = (float(last.at(np.array([1.0]), order)[0]) * travel / segment.width**order for order in (1, 2))
            # What rounding leaves of a state that is none may be told either way.
            least = [1e-9 * abs(travel) / segment.width**order for order in (1, 2)]
            near = segment.law == "table" and segment.source.get("ends") != "rest" and (abs(v) < least[0] or abs(a) < least[1])
            self.near |= near
            v, a = (0.0 if abs(d) < size else d for d, size in zip((v, a), least))
            segment.state = {"auto": set(), "v": v, "a": a, "j": None, "turn": False, "near": near}

    def chain_faults(self):
        self.least_jerk_chain()

    def least_jerk_chain(self):
        count = len(self.segments)
        chain = []
        for i, segment in enumerate(self.segments):
            if segment.state["auto"] and not {segment.law, self.segments[(i + 1) % count].law} <= {"polynomial", "spline"}:
                raise Illegal("auto")
            if segment.law == "spline" or segment.law == "polynomial" and (segment.state["auto"] or self.segments[i - 1].state["auto"]):
                chain.append(segment)
        if any(s.state["j"] is not None or self.segments[self.segments.index(s) - 1].state["j"] is not None for s in chain):
            raise Illegal("jerk beside")
        for segment in self.segments:
            if segment.source.get("start") == "free" and segment.law not in ("polynomial", "spline"):
                raise Illegal("start")
            if segment.source.get("start") == "free" and segment in chain and self.segments[self.segments.index(segment) - 1] in chain:
                raise Illegal("start")
        return chain

    def least_jerk(self):
        """Splines, and polynomials beside a state that is to be found: quintics of least ∫(s‴)²; the segments that are done."""
        count, chain = len(self.segments), self.least_jerk_chain()
        unknowns, at_end, intervals = 0, {}, []
        for segment in chain:
            i = self.segments.index(segment)
            after = self.segments[(i + 1) % count]
            known, states = segment.state, []
            for letter in "va":
                turning = known.get("turning") if letter == "a" and known["turn"] else None
                free = letter in known["auto"] or letter == "a" and known["turn"] and turning is None
                states.append(unknowns if free else known[letter] if turning is None else turning)
                unknowns += free
            at_end[i] = states
            # A turn beside what is not of the chain is free for itself.
            known["shared"] = after in chain
        for segment in chain:
            i = self.segments.index(segment)
            before = (i - 1) % count
            if before in at_end:
                states = at_end[before]
            else:
                known = self.segments[before].state
                states = [known["v"], known["a"]]
                if known["turn"] and known.get("turning") is not None:
                    states[1] = known["turning"]
                if known["turn"] and known.get("turning") is None or segment.source.get("start") == "free":
                    states[1], unknowns = unknowns, unknowns + 1
            knots = [(quantity(a) - segment.start, quantity(p)) for a, p in segment.source.get("points", [])]
            knots.append((segment.width, segment.to))
            if any(angle <= behind for angle, behind in zip([k[0] for k in knots], [0.0] + [k[0] for k in knots])):
                raise Illegal("range")
            low, first = 0.0, segment.begin
            segment.intervals = []
            for angle, position in knots:
                ends = at_end[i] if angle == segment.width else [unknowns, unknowns + 1]
                unknowns += 2 * (angle != segment.width)
                segment.intervals.append(Interval(low, angle, first, position, states + ends))
                low, first, states = angle, position, ends
            intervals += segment.intervals
        found = solved(intervals, unknowns) if chain else []
        for segment in chain:
            width = segment.width
            parts = [(k.low / width, k.high / width, k.coefficients(found) * width ** np.arange(6.0)) for k in segment.intervals]
            for part in parts:
                part[2][0] -= segment.begin
            segment.pieces, segment.scale = self.spline_pieces(parts, True), 1.0
            self.rounding(np.array([segment.begin, segment.to]), min(k.high - k.low for k in segment.intervals))
            v, a = (s if not isinstance(s, int) else float(found[s]) for s in at_end[self.segments.index(segment)])
            if segment.state["auto"]:
                near = any(abs(d) < 1e-9 * max(self.size, abs(v) * width, abs(a) * width**2) / width**order for order, d in ((1, v), (2, a)))
                segment.state |= {"v": v, "a": a, "near": near}
        return chain

    def solve_one(self, segment, wanted, usual="smooth"):
        begin, end = self.segments[self.segments.index(segment) - 1].state, segment.state
        travel, width = segment.to - segment.begin, segment.width
        if segment.law == "dwell":
            segment.pieces, segment.scale = [Piece(0.0, 1.0, [0.0])], 1.0
            return
        if segment.law == "polynomial":
            ends = []
            for state, value in ((begin, 0.0), (end, travel)):
                given = [value, state["v"] * width]
                if value == 0.0 and state is begin and segment.source.get("start") == "free":
                    pass
                elif state["turn"]:
                    given += [] if state.get("turning") is None else [state["turning"] * width**2]
                else:
                    given.append(state["a"] * width**2)
                    given += [state["j"] * width**3] if state["j"] is not None else []
                ends.append(given)
            segment.pieces, segment.scale = hermite(*ends), 1.0
            return
        if abs(travel) <= 1e-12 * self.size:
            raise Illegal("travel")
        segment.scale = travel
        if segment.law == "constant-velocity":
            segment.pieces = [Piece(0.0, 1.0, [0.0, 1.0])]
            return
        ends = []
        for state in (begin, end):
            if state["a"] != 0 and not state["turn"]:
                raise Illegal("accelerated")
            ends.append(("U", 0.0) if state["turn"] else ("G" if state["v"] else "R", state["v"] * width / travel))
        inflection = segment.source.get("inflection", usual)
        inflection = inflection if inflection in ("smooth", "match") else float(inflection)
        own = {key: segment.source[key] for key in ("fractions", "line", "amplitudes", "ramp") if key in segment.source}
        beside = None if wanted is None else wanted * width**2 / travel
        segment.pieces = law_pieces(segment.law, own, *ends, inflection, beside)

    def jet(self, index, theta, orders=3):
        """Position and derivatives of part `index` at angles of its own lobe."""
        _, _, segment, piece = self.parts[index]
        x = np.clip((theta - segment.start) / segment.width, piece.low, piece.high)
        jets = [piece.at(x, order) * segment.scale / segment.width**order for order in range(orders + 1)]
        jets[0] = jets[0] + segment.begin
        return jets

    def derivative(self, index, theta, order):
        """One of them, without the position."""
        _, _, segment, piece = self.parts[index]
        x = np.clip((theta - segment.start) / segment.width, piece.low, piece.high)
        return piece.at(x, order) * segment.scale / segment.width**order

    def everywhere(self, theta, nudge=0.0):
        """The four jets at any angles; `nudge` chooses the side of a joint."""
        local = self.at + np.mod(theta - self.at, self.fill)
        chosen = self.at + np.mod(theta + nudge - self.at, self.fill)
        index = np.minimum(np.searchsorted(self.ends, chosen, side="right"), len(self.parts) - 1)
        found = np.empty((4, len(theta)))
        for i in np.unique(index):
            inside = index == i
            found[:, inside] = self.jet(i, local[inside])
        # A nudge over the end of the lobe is the other end of the turn.
        for i, side in ((0, self.at), (len(self.parts) - 1, self.at + self.fill)):
            crossed = (index == i) & (np.abs(local - chosen) > self.fill / 2)
            if crossed.any():
                found[:, crossed] = np.array(self.jet(i, np.array([side]))).reshape(4, 1)
        return found

    def extreme(self, function, parts=None, cells=128):
        """Largest of function(part, angles) over parts, and where: a grid, then ever finer ones about the best places of each: three, and more
        of what has many humps alike."""
        best, place = -math.inf, None
        for i in range(len(self.parts)) if parts is None else parts:
            low, high, segment, _ = self.parts[i]
            if high <= low:
                continue
            own = max(cells, getattr(self.parts[i][3], "cells", 0))
            coarse = np.array([low]) if segment.law == "dwell" else np.linspace(low, high, own + 1)
            values = function(i, coarse)
            values[np.isnan(values)] = math.inf
            padded = np.concatenate([[-math.inf], values, [-math.inf]])
            tops = np.nonzero((values >= padded[:-2]) & (values >= padded[2:]))[0]
            for top in tops[np.argsort(-values[tops])][: max(3, own // 16) if own > cells else 3]:
                if values[top] > best:
                    best, place = float(values[top]), float(coarse[top])
                grid, at = coarse, top
                for _ in range(6 if len(coarse) > 1 and math.isfinite(values[top]) else 0):
                    grid = np.linspace(grid[max(at - 1, 0)], grid[min(at + 1, len(grid) - 1)], 25)
                    near = function(i, grid)
                    near[np.isnan(near)] = math.inf
                    at = int(np.argmax(near))
                    if near[at] > best:
                        best, place = float(near[at]), float(grid[at])
        return best, place

    def jump(self):
        """Largest jumps of velocity, acceleration and jerk, each over the largest value."""
        shares = []
        for order in (1, 2, 3):
            size = max(self.extreme(lambda i, t: np.abs(self.derivative(i, t, order)))[0], 1e-300)
            shares.append(max(abs(before - after) for before, after in self.across(order)) / size)
        return shares

    def across(self, order):
        """A derivative before and behind every joint."""
        at = lambda i, theta: float(self.jet(i, np.array([theta]), order)[order][0])
        following = [(i + 1) % len(self.parts) for i in range(len(self.parts))]
        return [(at(i, self.parts[i][1]), at(j, self.parts[j][0])) for i, j in enumerate(following)]
