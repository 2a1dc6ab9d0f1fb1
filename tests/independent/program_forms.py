"""Motions given in one, laws given by formula, table or points, states that are found, elastic loads, and files that are broken."""
import math

from program_motion import ANGLES, LENGTHS, PI, TAU, Illegal, Program

SHAPES = [
    "x^3*(10-15*x+6*x^2)", "35*x^4-84*x^5+70*x^6-20*x^7", "x-sin(2*pi*x)/(2*pi)", "(1-cos(pi*x))/2", "x", "x^2*(3-2*x)", "sin(pi*x/2)", "x^2",
    "(exp(x)-1)/(e-1)", "log(1+x)/log(2)", "tan(pi*x/4)", "((1+x)^2.5-1)/(2^2.5-1)", "126*x^5-420*x^6+540*x^7-315*x^8+70*x^9", "4*atan(x)/pi",
    "1-(1-x)^3*(1+3*x+6*x^2)", "(2^x - 1)", "x - sin(2*pi*x)*27/28/(2*pi) - sin(6*pi*x)/84/2/pi", "sqrt(1+3*x)-1", "6*asin(x/2)/pi",
]
SAMPLED = [
    lambda x: x**3 * (10 - 15 * x + 6 * x * x), lambda x: x - math.sin(TAU * x) / TAU, lambda x: (1 - math.cos(PI * x)) / 2,
    lambda x: x, lambda x: x * x, lambda x: x**4 * (35 - 84 * x + 70 * x * x - 20 * x**3),
]


def term(rng, lobes):
    """A periodic term of size about 1; every singular place is farther than 0.8 from the real line over the pace."""
    k = lobes * rng.choice([1, 1, 1, 2, 2, 3])
    phase = rng.choice(["", "", f"+{rng.uniform(-3, 3):.3f}".replace("+-", "-"), "-pi/3"])
    argument = ("th" if k == 1 else f"{k}*th") + phase
    wave = f"{rng.choice(['sin', 'cos'])}({argument})"
    form = rng.random()
    if form < 0.4:
        return wave
    if form < 0.55:
        return f"{wave}^{rng.choice([2, 3])}"
    if form < 0.62:
        return f"{wave}*cos({lobes}*th)"
    return rng.choice([
        f"exp({rng.choice(['', '-'])}{wave})/2", f"1/(1.8+0.5*{wave})", f"log(2.5+{wave})", f"sqrt(2 + {wave})", f"atan({wave})", f"asin(0.5*{wave})",
        f"acos({wave}/2.5)", f"tan(0.6*{wave})", f"(2+{wave})^1.7/4", f"2^{wave}/2", f"2^-{wave}/2", f"-{wave}^2", f"(1-{wave})/2", f"pi*{wave}/e",
    ])


def periodic_formula(rng, lobes, size):
    terms = [f"{rng.uniform(0.2, 0.5) * size:.4g}*{term(rng, lobes)}" for _ in range(rng.choice([1, 2, 2, 3]))]
    text = terms[0]
    for other in terms[1:]:
        text += rng.choice([" + ", "-", "+", " - "]) + (f"({other})" if rng.random() < 0.2 else other)
    if rng.random() < 0.1:
        # A corner at the end of the turn.
        text += f" + {0.1 * size:.4g}*sin({lobes}*th/2)"
    return text


def rows(rng, pairs):
    """Text of a table, with one of the separators."""
    gap = rng.choice([",", ";", "\t", " ", ", "])
    header = rng.choice(["", "", "# from the old machine\n", "angle;position\n"])
    return header + "".join(f"{x!r}{gap}{y!r}\n" for x, y in pairs)


def knots(rng, count, size):
    shares = [rng.uniform(0.4, 1) for _ in range(count)]
    # The last gap closes the turn and is no wider than the others.
    shares[-1] = min(shares)
    at = [sum(shares[:i]) / sum(shares) for i in range(count)]
    values = [size * (rng.uniform(0.5, 1) if i % 2 else rng.uniform(0, 0.5)) for i in range(count)]
    return at, values


def draw_form(rng, motion, size, text, files, rounded):
    """One of formula, series, points and table in place of segments; `size` in mm or rad."""
    lobes = motion.get("repeat", 1)
    start = motion["start"]
    unit = (LENGTHS | ANGLES)[start.split()[-1]]
    form = rng.choice(["formula", "formula", "fourier", "points", "points", "table"])
    if form == "formula":
        motion["formula"] = periodic_formula(rng, lobes, size / unit)
    elif form == "fourier":
        count = rng.choice([1, 2, 3, 5])
        waves = [[round(rng.uniform(-0.5, 0.5) * size / unit / k**2, 6) for k in range(1, count + 1)] for _ in range(2)]
        motion["fourier"] = {"cos": waves[0], "sin": waves[1]}
        if rng.random() < 0.3:
            motion["fourier"].pop(rng.choice(["cos", "sin"]))
    elif form == "points":
        at, values = knots(rng, rng.choice([3, 3, 4, 5, 6, 8]), size)
        first = rng.choice([0.0, 0.0, rng.uniform(0, 0.2) / len(at)])
        motion["points"] = [[rounded(rng, (share + first) * TAU / lobes), text(value)] for share, value in zip(at, values)]
        if rng.random() < 0.7:
            motion["degree"] = rng.choice([3, 5])
    else:
        step = rng.choice([1, 2, 2.5, 5, 10, 10])
        count = round(360 / lobes / step)
        if abs(count * step - 360 / lobes) > 1e-9:
            step = 360 / lobes / count
        law = rng.choice(SAMPLED[:3] + SAMPLED[5:])
        top, dwell = rng.uniform(0.3, 0.6), rng.uniform(0, 0.2)

        def known(share):
            if share < top:
                return law(share / top)
            return 1.0 if share < top + dwell else 1 - law((share - top - dwell) / (1 - top - dwell))

        digits = rng.choice([3, 6, 15])
        pairs = [(round(i * step, 12), round(known(i / count) * size / unit, digits)) for i in range(count + (rng.random() < 0.3))]
        name = f"lift-{rng.randrange(16**6):06x}.csv"
        motion["table"], files[name] = name, rows(rng, pairs)


def vary(rng, motion, segments, text, files, rounded):
    """Some segments of a legal program become splines, formulas or tables, some states are to be found."""
    try:
        program = Program(motion, segments)
    except Illegal:
        return
    begins = [s.state for s in program.segments[-1:] + program.segments[:-1]]
    still = lambda state: state["v"] == 0 and state["a"] == 0 and state["j"] is None and not state["turn"]
    for i, (segment, solved, begin) in enumerate(zip(segments, program.segments, begins)):
        law, travel = solved.law, solved.to - solved.begin
        after = program.segments[(i + 1) % len(segments)].law
        smooth = law == "polynomial" or after == "polynomial"
        if law in ("dwell", "constant-velocity") or abs(travel) < 1e-9 or rng.random() < 0.4:
            continue
        own = rng.random()
        if own < 0.5 and still(solved.state) or smooth and own < 0.2:
            for key in ("velocity", "acceleration", "jerk", "end", "inflection", "fractions", "line", "amplitudes", "ramp"):
                segment.pop(key, None)
            # What rests at both ends, or bends where the neighbours can follow.
            rests = not smooth and rng.random() < 0.97
            if rng.random() < 0.6:
                segment["law"], shapes = "formula", [SHAPES[j] for j in (0, 1, 2, 12, 14, 16)]
                segment["formula"] = rng.choice(shapes if rests else SHAPES)
                if rng.random() < 0.3:
                    share = rng.choice([0.25, 0.5, 0.75])
                    segment["formula"] = f"{share}*({segment['formula']}) + {1 - share}*({rng.choice(shapes)})"
            else:
                count = rng.choice([2, 4, 5, 6, 7, 10, 20, 36])
                law = rng.choice(SAMPLED)
                at = [j / count for j in range(count + 1)]
                if rng.random() < 0.4:
                    at = [0.0, *sorted(round(rng.uniform(0.15 / count, 0.85 / count) + j / count, 4) for j in range(1, count)), 1.0]
                name = f"law-{rng.randrange(16**6):06x}.csv"
                segment["law"], segment["table"] = "table", name
                at_rest = rests or rng.random() < 0.3
                # Rounded shares may begin at rest where they are free to move.
                digits = rng.choice([6, 12]) if at_rest else 17
                files[name] = rows(rng, [(x, round(law(x), digits)) if 0 < x < 1 else (x, x) for x in at])
                if at_rest:
                    segment["ends"] = "rest"
                elif rng.random() < 0.3:
                    segment["ends"] = "free"
        elif own < 0.75 or law == "polynomial":
            for key in ("inflection", "fractions", "line", "amplitudes", "ramp"):
                segment.pop(key, None)
            if rng.random() < 0.95:
                segment.pop("jerk", None)
                segments[i - 1].pop("jerk", None)
            if rng.random() < 0.7 and still(begin | {"j": None}) or law == "polynomial":
                segment["law"] = "spline"
                count = rng.choice([1, 1, 2, 3])
                shares = sorted(rng.uniform(0.1, 0.9) for _ in range(count))
                if all(b - a > 0.05 for a, b in zip(shares, shares[1:])):
                    wander = lambda: rng.uniform(-0.1, 0.1)
                    points = [(solved.start + share * solved.width, solved.begin + travel * (share**2 * (3 - 2 * share) + wander())) for share in shares]
                    segment["points"] = [[rounded(rng, angle), text(place)] for angle, place in points]
                else:
                    segment["law"] = "polynomial"
    laws = [segment.get("law") for segment in segments]
    for i, segment in enumerate(segments):
        around = {laws[i], laws[(i + 1) % len(segments)]}
        if rng.random() < (0.5 if around <= {"polynomial", "spline"} else 0.01) and laws[i] in ("polynomial", "spline") and segment.get("end") is None:
            segment["velocity"] = "auto"
            segment.pop("jerk", None)
            if rng.random() < 0.7:
                segment["acceleration"] = rng.choice(["auto", "auto", "0 deg/rad2" if text(1.0).split()[1] in ANGLES else "0 mm/rad2"])
            if rng.random() < 0.95:
                segments[i - 1].pop("jerk", None)
                segments[(i + 1) % len(segments)].pop("jerk", None)


def elastic(rng, motion, segments):
    """A load on an elastic train, mostly under laws whose jerk is continuous."""
    motion.setdefault("rpm", round(rng.uniform(20, 600), 1))
    share = rng.choice([0.02, 0.05, 0.1, 0.2])
    motion["polydyne"] = {"natural_frequency": f"{motion['rpm'] / 60 / share:.4g} Hz"}
    if rng.random() < 0.6:
        motion["polydyne"]["damping"] = rng.choice([0, 0.02, 0.1])
    if rng.random() < 0.3:
        motion["polydyne"]["rpm"] = round(motion["rpm"] * rng.choice([0.5, 1, 1.2]), 2)
    for segment in segments:
        if segment.get("law") != "dwell" and rng.random() < 0.9:
            for key in ("velocity", "acceleration", "jerk", "end", "inflection", "fractions", "line", "amplitudes", "ramp"):
                segment.pop(key, None)
            segment["law"] = rng.choice(["4-5-6-7", "poly9", "formula"])
            if segment["law"] == "formula":
                segment["formula"] = rng.choice([SHAPES[1], SHAPES[12]])


# ---------------------------------------------------------------- broken files


def broken(rng, case, rounded, text):
    """Breaks a file in one way; the words that its message must have, or that the line it shows must have."""
    motion, segments, files = case["motion"], case["segments"], case["files"]
    whole = {k: motion[k] for k in ("rpm", "start", "at") if k in motion}
    points = [[rounded(rng, a), text(v)] for a, v in ((0.0, 0.0), (1.0, 3e-2), (2.0, 1e-2), (4.0, 2e-2))]
    name = f"broken-{rng.randrange(16**6):06x}.csv"

    def formula(value):
        return {"formula": value}, [], {}, "formula"

    def table(value):
        return {"table": name}, [], {name: value}, "table|row|behind|turn|lobe|two numbers"

    def pair(first, second=None):
        """Two segments that go up and come back."""
        up = {"over": "100 deg", "to": text(3e-2), **first}
        back = {"to": motion["start"], **(second or {})}
        whole["start"] = back["to"] = text(0.0)
        return {}, [{k: v for k, v in one.items() if v is not None} for one in (up, back)]

    kind = rng.randrange(7)
    if kind == 0:
        given = formula(rng.choice([
            "10*sin(th", "10*sin th", "3*cos(th))", "cos(x)", "abs(th)", "2 th", "3*", "*3", "sin()", "1..5*sin(th)", "2**sin(th)", "cos(th)+", "$", "sin(th", "th th",
            "1/(th-1)", "1/sin(th)", "sqrt(sin(th))", "log(cos(th))", "asin(2*sin(th))", "th", "th^2", "exp(th)", "(cos(th)-0.5)^2.5", "exp(1000*sin(th))",
            "sqrt(1-cos(th))", "tan(th)", "cos(th)/0", "1e400*cos(th)", "", " ", "((((((cos(th)", "0^-1*cos(th)", "acos(1.5+0*cos(th))",
        ]))
    elif kind == 1:
        choice = rng.randrange(6)
        if choice == 0:
            points[2][0] = points[1][0]
        elif choice == 1:
            points = points[: rng.choice([0, 1, 2])]
        elif choice == 2:
            points[3][0] = rng.choice(["360 deg", "7 rad", "-10 deg"])
        elif choice == 3:
            points[1], points[2] = points[2], points[1]
        elif choice == 4:
            points[1][1] = "1 kg"
        else:
            points[1] = rng.choice([["10 deg"], [], ["10 deg", "1 mm", "2 mm"], "10 deg", ["ten", "1 mm"]])
        given = {"points": points}, [], {}, "points|point"
    elif kind == 2:
        given = table(rng.choice([
            "0,0\n100,4\n100,5\n300,1\n", "0 0\n100 x\n200 5\n", "0;0\n100;2\n", "", "# nothing\n", "10 0.5\n100 4\n200 3\n", "300 1\n0 0\n100 4\n", "0 0 1\n100 2 4\n200 5 3\n",
            "0 0\n100 2\n370 3\n", "0 0\n100 2\n200 3\n360 1\n", "0 0\n100 nan\n200 3\n", "0 0\n100 inf\n200 3\n", "0\n1\n2\n", "0,0\n1e3 mm,4\n200,2\n",
        ]))
        if rng.random() < 0.2:
            given = {"table": name}, [], {}, "table"
    elif kind == 3:
        more, keys = rng.choice([
            ({"fourier": {}}, "fourier|position"), ({"fourier": {"cos": [0, 0]}}, "fourier|position"), ({"fourier": {"cos": [1]}, "formula": "cos(th)"}, "formula"),
            ({"points": points, "formula": "cos(th)"}, "formula"), ({"points": points, "degree": 4}, "degree|point"), ({"fourier": {"cos": ["a"]}}, "cos"),
            ({"fourier": {"tan": [1]}}, "tan"), ({"formula": "2"}, "position|formula"), ({"formula": "cos(th)", "polydyne": {"damping": 0.1}}, "natural_frequency"),
            ({"formula": "cos(th)", "rpm": 100, "polydyne": {"natural_frequency": "-3 Hz"}}, "natural_frequency"),
            ({"formula": "cos(th)", "rpm": 100, "polydyne": {"natural_frequency": "3 Hz", "damping": 2}}, "damping"),
        ])
        given = more, [], {}, keys
    elif kind == 4:
        middle = ["50 deg", text(1e-2)]
        first, second, keys = rng.choice([
            ({"law": "formula"}, None, "formula"), ({"law": "table"}, None, "table"), ({"law": "spline"}, None, "points"),
            *(({"law": "formula", "formula": wrong}, None, "formula") for wrong in ("x+0.1", "2*x", "sin(th)", "x/(x-0.5)/2", "x^0.5", "log(x)")),
            ({"law": "spline", "points": [["-130 deg", middle[1]]]}, None, "point"), ({"law": "spline", "points": [middle, middle]}, None, "point"),
            ({"law": "spline", "points": [["1 mm", "50 deg"]]}, None, "point"),
            ({"law": "polynomial", "velocity": "auto"}, {"law": "cycloidal"}, "auto"), ({"law": "cycloidal", "velocity": "auto"}, None, "auto"),
            ({"law": "formula", "formula": "x", "velocity": "auto"}, None, "velocity"), ({"law": "dwell", "to": None, "velocity": "auto"}, None, "velocity|dwell"),
            ({"law": "spline", "points": [middle], "velocity": "auto", "end": "turn"}, {"law": "polynomial"}, "turn|end"),
        ])
        given = (*pair(first, second), {}, keys)
    elif kind == 5:
        given = (*pair({"law": "table", "table": name}), {name: rng.choice([
            "0.1 0\n0.5 0.4\n1 1\n", "0 0\n0.5 0.4\n0.9 1\n", "0 0\n0.5 0.4\n1 0.9\n", "0 0\n0.5 0.4\n0.5 0.6\n1 1\n", "0 0\n0.6 0.4\n0.5 0.6\n1 1\n", "0 0\n50 40\n100 100\n", "",
        ])}, "table|behind|row")
    else:
        law = rng.choice(["3-4-5", "cycloidal", "modified-sine", "harmonic"])
        polydyne = {"natural_frequency": "40 Hz"}
        given = (*pair({"law": law}, {"law": "4-5-6-7"}), {}, "polydyne|natural_frequency|rpm")
        whole.pop("rpm", None)
        if rng.random() < 0.6:
            whole["rpm"] = 100
        given[0]["polydyne"] = polydyne
    more, case["segments"], case["files"], keys = given
    case["motion"] = {**whole, **more}
    return keys
