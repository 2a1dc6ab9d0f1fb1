"""Cases of programs.py: random motions, followers, cams and limits as text, legal ones and ones at the walls."""
import json
import math

from program_forms import broken, draw_form, elastic, vary
from program_motion import ALIASES, ANGLES, HALVES, LENGTHS, NAMES, PI, POLYNOMIALS, SINES, TAU, quantity


def number(rng, value, exact=False):
    return repr(value) if exact or rng.random() < 0.2 else f"{value:.{rng.choice([3, 4, 6])}g}"


def length(rng, value, exact=False):
    unit = rng.choice(["mm", "mm", "mm", "cm", "in", "m"])
    return f"{number(rng, value / LENGTHS[unit], exact)} {unit}"


def angle(rng, value, exact=False):
    unit = rng.choice(["deg", "deg", "deg", "rad"])
    return f"{number(rng, value / ANGLES[unit], exact)} {unit}"


def rate_text(rng, value, order, swings, omega):
    of = rng.choice(["deg", "rad"] if swings else ["mm", "mm", "in", "m"])
    by = rng.choice(["deg", "rad", "rad"] + (["s"] if omega else []))
    each = omega if by == "s" else ANGLES[by]
    power = "" if order == 1 else str(order)
    return f"{value / (LENGTHS | ANGLES)[of] * each**order!r} {of}/{by}{power}"


def serving(start, end, equal):
    """Laws for two kinds of ends, R at rest, G moving, U turning, B and A accelerated."""
    both = start + end
    if "B" in both or "A" in both:
        return ["polynomial"]
    laws = list(HALVES) + ["polynomial"]
    if "U" in both:
        return laws + ["double-harmonic"] * 3 if both in ("RU", "UR") else laws
    laws += list(POLYNOMIALS)
    return laws + list(SINES) if both == "RR" or equal else laws


def own_numbers(rng, law):
    if law == "scca" and rng.random() < 0.8:
        shares = [rng.choice([0, rng.random(), rng.random(), rng.random()]) for _ in range(4)]
        shares[2] += 0.05
        shares = [share / sum(shares) for share in shares]
        return {"fractions": [*shares[:3], max(1 - sum(shares[:3]), 0.0)]}
    if law in ("parabola-line", "sine-line") and rng.random() < 0.7:
        return {"line": rng.choice([0.0, 0.25, 0.5, round(rng.uniform(0, 0.95), 3), 0.9999995])}
    if law == "s-curve" and rng.random() < 0.7:
        return {"ramp": rng.choice([0.5, 0.25, round(rng.uniform(0.02, 0.5), 3), 0.0])}
    if law == "triple-harmonic" and rng.random() < 0.7:
        return {"amplitudes": rng.choice([[7, 0, -2.4], [1, 0, 0], [round(rng.uniform(4, 8), 2), round(rng.uniform(-1, 1), 2), round(rng.uniform(-3, 3), 2)]])}
    return {}


def draw_motion(rng, swings):
    """`[motion]` and its segments, keys as text."""
    lobes = rng.choice([1] * 9 + [2, 3, 5])
    size = math.radians(rng.choice([rng.uniform(2, 12), rng.uniform(5, 40)])) if swings else rng.choice([rng.uniform(1, 8), rng.uniform(4, 40)])
    count = rng.choice([1, 2, 2, 3, 3, 4, 4, 5, 6]) if lobes == 1 else rng.choice([2, 2, 3])
    fill = TAU / lobes
    shares = [rng.uniform(0.3, 1) for _ in range(count)]
    if rng.random() < 0.12:
        shares[rng.randrange(count)] = rng.choice([0.1, 0.02, 0.003, 0.0005])
    widths = [fill * share / sum(shares) for share in shares]
    start = size * rng.choice([0, 0, 0, rng.uniform(-1, 1)])
    positions, high = [], rng.random() < 0.8
    for _ in range(count - 1):
        positions.append(start + size * (rng.uniform(0.5, 1) if high else rng.uniform(0, 0.3)))
        high = not high if rng.random() < 0.8 else high
    positions.append(start)
    kinds = [rng.choice("RRRRRRGUUBA") for _ in range(count)]
    if rng.random() < 0.35:
        kinds = ["R"] * count
    speeds = [rng.uniform(-0.3, 1.4) * (positions[i] - positions[i - 1]) / widths[i] if kinds[i] in "GB" else 0.0 for i in range(count)]
    fixed = [None] * count
    for i in range(count):
        chance = rng.random()
        if chance < 0.25 and count > 1 and not (i == count - 1 and fixed[i - 1]):
            fixed[i] = "dwell"
            if i == count - 1:
                positions[i - 1] = positions[i]
            elif i:
                positions[i] = positions[i - 1]
            else:
                positions[0] = start
            kinds[i] = kinds[i - 1] = "R"
            speeds[i] = speeds[i - 1] = 0.0
    for i in range(count):
        free = all(fixed[j] is None for j in (i - 1, i, (i + 1) % count)) and count > 2
        if free and rng.random() < 0.25 and abs(positions[i] - positions[i - 1]) > 0.05 * size:
            fixed[i] = "line"
            kinds[i] = kinds[i - 1] = "G"
            speeds[i] = speeds[i - 1] = (positions[i] - positions[i - 1]) / widths[i]
    motion = {}
    if rng.random() < 0.8:
        motion["rpm"] = rng.choice([60, 300, 1500, round(rng.uniform(1, 900), 1)])
    omega = motion["rpm"] * TAU / 60 if "rpm" in motion else None
    text = (lambda v, exact=False: angle(rng, v, exact)) if swings else (lambda v, exact=False: length(rng, v, exact))
    motion["start"] = text(start)
    at = 0.0
    if rng.random() < 0.25:
        at = rng.uniform(-PI, PI)
        motion["at"] = angle(rng, at)
        at = quantity(motion["at"])
    if lobes > 1:
        motion["repeat"] = lobes
    segments, behind, now = [], 0.0, quantity(motion["start"])
    for i in range(count):
        last = i == count - 1
        segment = {}
        if fixed[i] is None and abs(positions[i] - positions[i - 1]) < 1e-9 * size and rng.random() < 0.97:
            fixed[i] = "dwell" if kinds[i] + kinds[i - 1] == "RR" else "polynomial"
        equal = kinds[i - 1] == kinds[i] == "G" and speeds[i] == speeds[i - 1]
        law = fixed[i] or rng.choice(serving(kinds[i - 1], kinds[i], equal))
        if fixed[i] is None and rng.random() < 0.03:
            law = rng.choice(NAMES + ["dwell"])
        aliases = [alias for alias, name in ALIASES.items() if name == law]
        if not (law == "cycloidal" and rng.random() < 0.3):
            segment["law"] = rng.choice([law, law, *aliases]) if aliases else law
        if not last or rng.random() < 0.15:
            exact = last or law == "line"
            if rng.random() < 0.75:
                segment["over"] = angle(rng, fill - behind if last else widths[i], exact)
                width = quantity(segment["over"])
            else:
                segment["until"] = angle(rng, at + (fill if last else behind + widths[i]), exact)
                width = quantity(segment["until"]) - at - behind
        else:
            width = fill - behind
        if law == "line":
            speed = speeds[i] if last else (positions[i] - now) / width if width > 0 else 1.0
            form = 0 if last else rng.choice([0, 1, 2])
            if form:
                segment["velocity"] = rate_text(rng, speed, 1, swings, omega)
                if form == 2:
                    segment.pop("over", None)
                    segment.pop("until", None)
            if form != 1:
                segment["to"] = motion["start"] if last or positions[i] == start else text(positions[i], True)
            previous = segments[-1] if segments else None
            target = quantity(segment["to"]) if "to" in segment else now + speed * width
            exact_speed = (target - now) / width if width > 0 else 1.0
            if previous is not None and rng.random() < 0.95:
                previous["velocity"] = rate_text(rng, exact_speed, 1, swings, omega)
            now = target
        elif law != "dwell":
            if last:
                segment["to"] = motion["start"]
            elif positions[i] == start:
                segment["to"], now = motion["start"], quantity(motion["start"])
            elif rng.random() < 0.7:
                segment["to"] = text(positions[i])
                now = quantity(segment["to"])
            else:
                segment["by"] = text(positions[i] - now)
                now += quantity(segment["by"])
            if kinds[i] in "GB":
                segment["velocity"] = rate_text(rng, speeds[i], 1, swings, omega)
            if kinds[i] in "BA":
                segment["acceleration"] = rate_text(rng, rng.uniform(-3, 3) * size / max(widths) ** 2, 2, swings, omega)
            if kinds[i] == "U":
                segment["end"] = "turn"
            if law == "polynomial" and kinds[i] != "U" and rng.random() < 0.3:
                segment["jerk"] = rate_text(rng, rng.choice([0.0, rng.uniform(-5, 5) * size / max(widths) ** 3]), 3, swings, omega)
            segment.update(own_numbers(rng, law))
            if law in HALVES and rng.random() < 0.3:
                turns = "U" in (kinds[i], kinds[i - 1])
                odd = ["smooth", f"{rng.uniform(0.2, 0.8):.3f}", f"{rng.uniform(0.02, 0.98):.4f}", "0.9999995"]
                usual = [f"{rng.uniform(0.3, 0.7):.2f}"]
                segment["inflection"] = "match" if turns and rng.random() < 0.6 else rng.choice(odd if rng.random() < 0.3 else usual)
        behind += width
        segments.append(segment)
    return motion, segments, size


def other_forms(rng, motion, segments, size, swings):
    """Motions given in one, segments of other laws, elastic loads; and the tables beside the file."""
    text = (lambda v, exact=False: angle(rng, v, exact)) if swings else (lambda v, exact=False: length(rng, v, exact))
    files, chance = {}, rng.random()
    if chance < 0.25:
        motion, segments = {k: v for k, v in motion.items() if k in ("rpm", "start", "at", "repeat")}, []
        draw_form(rng, motion, size, text, files, angle)
    elif chance < 0.6:
        vary(rng, motion, segments, text, files, angle)
    if chance < 0.02 or 0.6 < chance < 0.66:
        elastic(rng, motion, segments)
    return motion, segments, files


def draw_forces(rng, swings, follower):
    """`[spring]`, and mass and preload of the follower, each now and then."""
    spring = {}
    if swings:
        if rng.random() < 0.9:
            follower["inertia"] = f"{10 ** rng.uniform(-4, 0):.3g} kg*m2"
        given = {"rate": f"{rng.uniform(0.1, 50):.3g} N*m/rad", "preload": f"{10 ** rng.uniform(-1, 2.5):.3g} N*m", "load": f"{rng.uniform(-2, 10):.3g} N*m"}
        given["damping"] = f"{10 ** rng.uniform(-3, 0):.3g} N*m*s/rad"
    else:
        if rng.random() < 0.9:
            follower["mass"] = rng.choice([f"{rng.uniform(0.1, 5):.2f} kg", f"{rng.uniform(0.2, 9):.1f} lb"])
        if rng.random() < 0.7:
            follower["preload"] = f"{rng.uniform(10, 2000):.0f} N"
        given = {"rate": f"{10 ** rng.uniform(-1, 2):.3g} N/mm", "preload": f"{10 ** rng.uniform(0, 3.5):.3g} N", "load": f"{rng.uniform(-20, 200):.3g} N"}
        given["damping"] = f"{10 ** rng.uniform(0, 2):.3g} N*s/m"
    for key, often in (("rate", 0.6), ("preload", 0.7), ("load", 0.2), ("damping", 0.1)):
        if rng.random() < (often if swings or rng.random() < 0.5 else 0.0):
            spring[key] = given[key]
    return spring


def draw(rng):
    kind = rng.choice(["roller", "roller", "knife", "swinging-roller", "swinging-roller", "flat", "swinging-flat"])
    swings = kind.startswith("swinging")
    motion, segments, size = draw_motion(rng, swings)
    motion, segments, files = other_forms(rng, motion, segments, size, swings)
    radius = rng.uniform(3, 20)
    follower, cam, limits = {}, {}, {}
    scale = max(size * 100 if swings else size, 4.0)
    base = scale * rng.choice([rng.uniform(0.3, 1.5), rng.uniform(1, 4), rng.uniform(2, 8)])
    if kind in ("roller", "swinging-roller"):
        follower["radius"] = length(rng, radius)
    if kind in ("roller", "knife") and rng.random() < 0.6:
        prime = base + (radius if kind == "roller" else 0)
        follower["offset"] = length(rng, rng.choice([rng.uniform(-0.4, 0.4), rng.uniform(-0.4, 0.4), rng.choice([-1, 1]) * rng.uniform(0.9, 1.02)]) * prime)
    if kind == "swinging-roller":
        arm = rng.uniform(40, 160)
        follower["arm"] = length(rng, arm)
        prime = base + radius
        low, high = max(abs(prime - arm), arm * 0.2), prime + arm
        follower["pivot_distance"] = length(rng, rng.choice([rng.uniform(low, high), math.hypot(arm, prime), math.hypot(arm, prime) * 1.1, low * 1.01, high * 0.99]))
    if kind == "flat":
        if rng.random() < 0.5:
            follower["tilt"] = angle(rng, math.radians(rng.choice([rng.uniform(-25, 25), rng.uniform(-60, 60)])))
        if rng.random() < 0.4:
            follower["offset"] = length(rng, rng.uniform(-0.5, 0.5) * base)
    if kind == "swinging-flat":
        follower["pivot_distance"] = length(rng, base * rng.choice([rng.uniform(1.2, 4), rng.uniform(2, 5), rng.uniform(0.9, 1.3)]))
        if rng.random() < 0.6:
            follower["face_offset"] = length(rng, base * rng.uniform(-0.7, 0.5))
    if swings and rng.random() < 0.6:
        follower["side"] = rng.choice(["trailing", "leading"])
    if kind.endswith("flat") and rng.random() < 0.5:
        follower["width"] = length(rng, scale * rng.uniform(0.5, 4))
    spring = draw_forces(rng, swings, follower) if rng.random() < 0.35 else {}
    cam["base_radius"] = "auto" if rng.random() < 0.3 else length(rng, base)
    if rng.random() < 0.4:
        cam["rotation"] = rng.choice(["cw", "ccw", "ccw"])
    if rng.random() < 0.3:
        cam["bore_radius"] = length(rng, base * rng.uniform(0.1, 1.02))
    if rng.random() < 0.6:
        limits["pressure_angle"] = angle(rng, math.radians(rng.choice([rng.uniform(15, 60), rng.uniform(40, 89), 75])))
    if rng.random() < 0.5:
        limits["min_convex_pitch_radius_over_roller"] = rng.choice([0, 0.5, 1, 1.5])
    if rng.random() < 0.15:
        limits["continuity"] = rng.choice([0, 1, 2, 3])
    if rng.random() < 0.15:
        limits["cutter_radius"] = length(rng, rng.uniform(2, 40))
    if spring and rng.random() < 0.2:
        limits["jump_margin"] = rng.choice([1.2, 1.5, 2])
    if {"points", "table"} & motion.keys() or any(segment.get("law") in ("spline", "table") for segment in segments):
        # How far a curve leaves its rows is judged in tables.py.
        limits["overshoot"] = "90 deg" if swings else "5 m"
    words = ["--tolerance", rng.choice(["1um", "5um", "5um", "50um"]), "--samples", str(rng.choice([181, 240, 360]))]
    words += ["--tolerance-acceleration", "none"] if rng.random() < 0.5 else []
    words += ["--force"] if rng.random() < 0.5 else []
    case = {"kind": kind, "motion": motion, "segments": segments, "follower": follower, "cam": cam, "limits": limits, "words": words}
    case |= {"spring": spring, "files": files, "broken": None}
    if rng.random() < 0.06:
        case["broken"] = broken(rng, case, angle, (lambda v: angle(rng, v)) if swings else (lambda v: length(rng, 100 * v)))
    return case


def written(case):
    show = lambda v: json.dumps(v)
    motion = case["motion"]
    lines = ['name = "random"', "[motion]"] + [f"{k} = {show(v)}" for k, v in motion.items() if not isinstance(v, dict)]
    for title in [k for k, v in motion.items() if isinstance(v, dict)]:
        lines += [f"[motion.{title}]"] + [f"{k} = {show(v)}" for k, v in motion[title].items()]
    for segment in case["segments"]:
        lines += ["[[motion.segment]]"] + [f"{k} = {show(v)}" for k, v in segment.items()]
    tables = [(f"follower.{case['kind']}", case["follower"]), ("cam", case["cam"]), ("limits", case["limits"])]
    for title, table in tables + [("spring", case["spring"])] * bool(case["spring"]):
        lines += [f"[{title}]"] + [f"{k} = {show(v)}" for k, v in table.items()]
    return "\n".join(lines) + "\n"
