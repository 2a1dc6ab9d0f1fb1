"""Changes designs in the live page in Chromium, without a network, and holds what the page gives against the command line.

Random moves of sliders on embedded designs: nothing on the console; after each the verdict is that of the command line for the TOML that the
page gives, the JSON report has the same bytes, and DXF, SVG, STEP and CSV that are downloaded have the same bytes as the files of `camgen` and
pass `camgen check`. Every field shows the value of the file, and one step of its slider writes the next value to the same key in the same
unit. A value out of range names its key and leaves the cam in grey; undo leads back to the text as sent, byte for byte. Then the
job of a packaging designer as a script of clicks, the motion editor, a measured table, a design that names a file, tabs, two designs next to each
other, the keyboard alone, the second language, light and dark, and widths from 390 px to 4K. Frames per second while a slider moves, time to proof,
start time and memory are printed, not judged: they are those of the machine.

usage: live.py CAMGEN_BINARY DIRECTORY [--moves N] [--designs NAME,…|all] [--checked-every N] [--pictures]
"""
import argparse
import json
import random
import re
import shutil
import subprocess
import sys
import time
import tomllib
from pathlib import Path

from playwright.sync_api import sync_playwright

from page_tools import CONTRAST, FLAGS, browser_path

# Every embedded design with the commands that make its cams; the first is the one of its name alone.
DESIGNS = {
    **{name: ["make"] for name in ("feeder", "lever", "valve", "groove", "conjugate", "yoke", "wedge", "barrel", "indexer")},
    "dpi": ["rotary", "conoid", "translating"],
    "dpi-paper": ["rotary", "conoid"],
    "dpi-crank-slider": ["rotary", "conoid", "translating"],
    "dpi-six-bar": ["rotary", "conoid"],
    "dpi-shaft": ["rotary", "conoid", "translating"],
}
# Of this one the contact stress is above the customary limit as it is.
FAILING = ("dpi-crank-slider", "conoid")
LARGEST = 3_100_000
FORMATS = ("dxf", "svg", "step", "csv", "json")
# The outside of a hollow cam cannot be developed.
WITHOUT = {"indexer": ("dxf",)}
WIDTHS = ((390, 844), (800, 900), (1440, 900), (3840, 2160))
# What is left of the English report in buttons, labels, headings and messages; what camgen says of keys and checks stays English.
ENGLISH = """[...document.querySelectorAll('button, h1 ~ *, h2, h3, label > span, legend, summary, option, #state, #faults .muted, .muted')].filter((e) => e.checkVisibility() && !e.closest('.field, [lang=en], #rows, #results, #missing, #fields, #title, #laws'))
  .map((e) => [...e.childNodes].filter((n) => n.nodeType === 3).map((n) => n.data.trim()).join(' ')).filter((t) => /\\b(the|of|and|with|add|remove|lift|show|file|play|speed|from|checks|passed|cycle|time)\\b/i.test(t))"""
# Most clicks and typed values for the job of the packaging designer.
MOST_ACTS = 10


class Live:
    """A live page, with what it said and what it asked for."""

    def __init__(self, browser, address, allowed="file:", **options):
        self.context = browser.new_context(viewport={"width": 1440, "height": 900}, accept_downloads=True, **options)
        self.page, self.said, self.acts = self.context.new_page(), [], 0
        self.page.on("console", lambda message: self.said.append(f"{message.type}: {message.text}"))
        self.page.on("pageerror", lambda error: self.said.append(f"error: {error}"))
        self.page.on("request", lambda request: request.url.startswith((allowed, "blob:")) or self.said.append(f"asks for {request.url}"))
        started = time.time()
        self.page.goto(address)
        self.until("document.documentElement.dataset.live !== undefined && document.documentElement.dataset.ready !== undefined", 120)
        self.start = time.time() - started

    def until(self, condition, seconds=60):
        for _ in range(50 * seconds):
            if self.page.evaluate(condition):
                return
            self.page.wait_for_timeout(20)
        raise AssertionError(f"never: {condition}; {self.page.inner_text('#state')}; {self.said}")

    def settled(self):
        return int(self.page.evaluate("document.documentElement.dataset.settled ?? 0"))

    def after(self, act, seconds=120):
        """Does something and waits until the page has answered."""
        before = self.settled()
        act()
        self.until(f"Number(document.documentElement.dataset.settled) > {before}", seconds)

    def toml(self):
        return self.page.input_value("#toml")

    def show(self, key):
        """Opens the tables around a field."""
        self.page.evaluate("(id) => { for (let e = document.getElementById(id); e; e = e.parentElement) if (e.tagName === 'DETAILS') e.open = true; }", f"key-{key}")

    def type(self, key, value):
        self.show(key)
        self.acts += 2

        def typed():
            # Key by key: a blank in a field is not the key that plays.
            self.page.fill(f"[id='key-{key}']", "")
            self.page.keyboard.type(value)
            self.page.keyboard.press("Tab")

        self.after(typed)

    def click(self, selector):
        self.acts += 1
        self.page.click(selector)

    def sliders(self):
        return self.page.evaluate("[...document.querySelectorAll('.field > input[type=range]:not([hidden])')].map((e) => [e.parentElement.querySelector('input, select').id, Number(e.min), Number(e.max)])")

    def slide(self, key, value):
        """Moves a slider as a hand would: some values on the way, then rest."""
        move = """([id, value]) => { const e = document.getElementById(id).parentElement.querySelector('input[type=range]'); const from = Number(e.value);
          for (const share of [0.3, 0.7, 1]) { e.value = from + share * (value - from); e.dispatchEvent(new Event('input')); } e.dispatchEvent(new Event('change')); }"""
        self.after(lambda: self.page.evaluate(move, [key, value]))

    def download(self, name, count):
        """The files of a format: one at a click, or a button for each."""
        found = []
        button = f"[data-format={name}]"
        if count > 1:
            self.page.click(button)
            self.until(f"document.querySelectorAll('#files-list [data-file$=\".{name}\"]').length === {count}")
            buttons = [f"#files-list [data-file='{one}']" for one in self.page.locator("#files-list [data-file]").all_inner_texts()]
        for each in buttons if count > 1 else [button]:
            with self.page.expect_download(timeout=120_000) as download:
                self.page.click(each)
            found.append((download.value.suggested_filename, Path(download.value.path()).read_bytes()))
        return found

    def refused(self):
        return self.page.is_visible("#faults")

    def close(self):
        assert not self.said, self.said
        self.context.close()


def run(binary, directory, *words):
    return subprocess.run([binary, *words], cwd=directory, capture_output=True, text=True)


def same_file(binary, directory, command, name, suggested, bytes_):
    """A downloaded file is that of the command line, and passes `check`."""
    expected = (directory / f"{name}-{command}-files" / suggested).read_bytes()
    if suggested.endswith(".json"):
        # Every figure is the same; the report also names the files of its run.
        own, other = json.loads(bytes_), json.loads(expected)
        assert own.pop("files") and other.pop("files") and own == other, f"{name}: other figures than those of the command line"
        return
    assert bytes_ == expected, f"{name}: {suggested} differs from that of the command line"
    if suggested.endswith((".dxf", ".step")) and not suggested.endswith(("-counter.dxf", "-counter.step", "-pair.step")):
        (directory / suggested).write_bytes(bytes_)
        design = ["--design", f"{name}.toml"] if command == "make" else [f"{name}.toml", "--cam", command]
        checked = run(binary, directory, "check", suggested, *design)
        assert checked.returncode == 0, (suggested, checked.stdout, checked.stderr)


def same_files(live, binary, directory, command, name):
    """What the page gives is what the command line writes for the same text."""
    (directory / f"{name}.toml").write_text(live.toml())
    out = directory / f"{name}-{command}-files"
    # The names of files have the speed in them, which may have been another one before.
    shutil.rmtree(out, ignore_errors=True)
    formats = [kind for kind in FORMATS if kind not in WITHOUT.get(name, ())]
    # The sheet of a conoid also shows its flank where the STEP file, which needs it, is made with it; every drawing names the files that are made with it.
    sheets = [kind for kind in formats if command == "conoid" or kind in ("svg", "pdf")]
    for kinds in [[kind for kind in formats if kind not in sheets], *[[kind] for kind in sheets]]:
        if not kinds:
            continue
        made = run(binary, directory, command, f"{name}.toml", "--format", ",".join(kinds), "--name", name, "--out", out.name, "--overwrite", "--quiet")
    if live.refused():
        # What cannot be drawn is a failed check for the command line.
        assert made.returncode in (1, 2), (name, made.stderr, live.page.inner_text("#faults"))
        return "refused"
    failed = live.page.is_visible(".broken")
    assert made.returncode == (1 if failed else 0), (name, made.returncode, made.stderr, live.toml())
    if failed:
        assert live.page.is_disabled("[data-format=dxf]"), f"{name}: files of a cam that breaks a limit"
        return "failed"
    for kind in formats:
        for suggested, bytes_ in live.download(kind, len(list(out.glob(f"{name}*.{kind}")))):
            same_file(binary, directory, command, name, suggested, bytes_)
    return "passed"


def moves(live, binary, directory, command, name, count, every, generator):
    found = {}
    for number in range(count):
        key, low, high = generator.choice(live.sliders())
        live.slide(key, generator.uniform(low, high))
        if number % every == every - 1 or number == count - 1:
            outcome = same_files(live, binary, directory, command, name)
            found[outcome] = found.get(outcome, 0) + 1
        if live.refused() or live.page.is_visible(".broken"):
            live.after(lambda: live.page.click("#undo"))
    return found


def keys_of(toml):
    """The keys of a text with their values as typed."""
    def walk(path, value):
        if isinstance(value, dict):
            for name, inside in value.items():
                yield from walk(f"{path}.{name}" if path else name, inside)
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            for index, inside in enumerate(value):
                yield from walk(f"{path}[{index}]", inside)
        else:
            yield path, str(value).lower() if isinstance(value, bool) else value

    found = dict(walk("", tomllib.loads(toml)))
    # A word given instead of a table stands for two of its keys.
    if word := found.pop("cam.keyway", None):
        found |= {"cam.keyway.width": word, "cam.keyway.depth": word}
    return found


def number_of(typed):
    """The number and the unit of a value."""
    match = re.fullmatch(r"Ø?\s*([+-]?[\d.]+(?:[eE][+-]?\d+)?)\s*(.*)", str(typed))
    return (float(match[1]), match[2]) if match else (None, str(typed))


def values_shown(live, count, generator):
    """Every field shows the value of the file, and one step of a slider changes only this value, to the next number in the same unit."""
    fields = live.page.evaluate("Object.fromEntries([...document.querySelectorAll('.field')].map((e) => e.querySelector('input, select')).map((e) => [e.id.slice(4), e.value]))")
    given = keys_of(live.toml())
    for key, value in given.items():
        if key in fields and not isinstance(value, list):
            assert number_of(fields[key]) == number_of(value) or fields[key].lower() == str(value).lower(), (key, fields[key], value)
    sliders = [key.removeprefix("key-") for key, *_ in live.sliders()]
    doubled = [key for key in sliders if "diameter" in key or "radius" in key]
    for key in doubled + generator.sample(sliders, min(count, len(sliders))):
        before, typed = keys_of(live.toml()), live.page.input_value(f"[id='key-{key}']")
        step = """(id) => { const e = document.getElementById(id).parentElement.querySelector('input[type=range]'); const by = Number(e.max) > Number(e.value) ? 1 : -1;
          const before = Number(e.value); if (by > 0) e.stepUp(); else e.stepDown(); e.dispatchEvent(new Event('input')); e.dispatchEvent(new Event('change')); return [before, Number(e.step) * by]; }"""
        result = []
        live.after(lambda: result.extend(live.page.evaluate(step, f"key-{key}")))
        after, (number, unit) = keys_of(live.toml()), number_of(typed)
        changed = {one for one in before.keys() | after.keys() if before.get(one) != after.get(one)}
        assert changed == {key}, (key, changed)
        start = result[0] if number is None else number
        assert abs(number_of(after[key])[0] - start - result[1]) < 1e-9 * abs(start) + 1e-12, (key, typed, after[key], result)
        assert number is None or number_of(after[key])[1] == unit, (key, typed, after[key])
        live.after(lambda: live.page.click("#undo"))
    return len(fields)


# Diameters for all radii, a body given as its default, words in capitals, inches, a list of inline tables.
FORMS = """name = "forms"
motion = { rpm = 120, start = "0 in", segment = [{ law = "cycloidal", over = "90°", to = "0.4 in" }, { law = "Dwell", over = "90 deg" }, { law = "3-4-5", to = "0 in" }] }
[follower.roller]
diameter = "0.75 in"
[cam]
body = "Disc"
base_diameter = "3.15 in"
bore_diameter = "20 mm"
thickness = "15 mm"
keyway = "auto"
[limits]
cutter_diameter = "12 mm"
pressure_angle = "40 deg"
"""


def forms(browser, binary, directory, generator):
    """A design with values in other forms than the embedded designs, and empty limits that show the usual ones."""
    (directory / "forms.toml").write_text(FORMS)
    with Serving(binary, directory, "forms.toml") as address:
        live = Live(browser, address, "http://127.0.0.1:")
        values_shown(live, 100, generator)
        shown = lambda key: live.page.evaluate("(id) => { const e = document.getElementById(id); return [e.value, e.placeholder]; }", f"key-{key}")
        assert live.page.input_value("[id='key-cam.body']") == "disc" and shown("cam.bore_radius") == ["", "10 mm"], shown("cam.bore_radius")
        assert shown("follower.roller.radius") == ["", "0.375 in"] and shown("limits.size") == ["", "2000 mm"] and shown("limits.wall") == ["", "3 mm"]
        live.page.click("#designs")
        live.until("document.getElementById('new-limit-size')?.placeholder === '2000 mm'")
        limits = {key: live.page.get_attribute(f"#new-limit-{key}", "placeholder") for key in ("pressure_angle", "min_convex_radius", "wall", "contact_stress")}
        assert limits == {"pressure_angle": "30 deg", "min_convex_radius": "–", "wall": "3 mm", "contact_stress": "1500 MPa"}, limits
        live.page.click("#new-follower-swinging-roller", force=True)
        live.until("document.getElementById('new-limit-pressure_angle').placeholder === '45 deg'")
        live.close()


# Every field as it is shown, and the text that comes of another value in each: the form's own changes, all in one evaluation. The page asks the program
# for the changed text alone, and is told that the value is refused, so that its design stays as it was.
EVERY_KEY = """async (withAbsent) => {
  const real = window.fetch, texts = [], asked = [];
  const packed = (answer) => { const head = new TextEncoder().encode(JSON.stringify({ files: [], ...answer })); const all = new Uint8Array(4 + head.length); new DataView(all.buffer).setUint32(0, head.length, true); all.set(head, 4); return new Response(all); };
  window.fetch = async (path, options) => {
    const request = path === '/engine' ? JSON.parse(options.body) : {};
    if (!request.changes?.length) return real(path, options);
    if (request.report) return packed({ toml: request.toml, faults: [{ message: 'not now' }] });
    // The texts are made side by side, while the page goes on.
    texts.push(real(path, { ...options, body: JSON.stringify({ ...request, task: 'text', page: null }) }).then((made) => made.arrayBuffer()).then((bytes) =>
      JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, new DataView(bytes).getUint32(0, true)))).toml));
    return packed({ toml: request.toml, faults: [{ message: 'not now' }] });
  };
  const numbered = (typed) => typed.replace(/[\\d.]+/, (number) => String(Number((Number(number) * 1.25 + 1).toFixed(3))));
  for (const box of document.querySelectorAll('.field')) {
    if (!withAbsent && box.classList.contains('absent')) continue;
    const field = box.querySelector('input[type=text], select'), shown = field.value, key = field.id.slice(4);
    const options = [...(field.options ?? [])].map(({ value }) => value).filter((value) => value !== shown && value && !value.startsWith('\\0'));
    const sample = shown || (field.placeholder ?? '').replace(/^e\\.g\\. /, '');
    const value = field.options ? options.at(-1) : /\\d/.test(sample) ? numbered(sample) : `${sample}x`;
    asked.push({ key, shown, value, isGiven: !box.classList.contains('absent') });
    if (value === undefined) continue;
    field.value = value;
    field.dispatchEvent(new Event('change'));
    field.value = shown;
  }
  const count = asked.filter(({ value }) => value !== undefined).length;
  while (texts.length < count) await new Promise((resolve) => setTimeout(resolve, 5));
  window.fetch = real;
  const made = await Promise.all(texts);
  return asked.map((one) => ({ ...one, toml: one.value === undefined ? null : made.shift() }));
}"""


# Designs of which the keys that the file does not give are written too: of a cam, and of a press.
WITH_ABSENT = ("lever", "dpi")


def twin(key):
    """The other name of a radius or a diameter, of which a file has one."""
    return key.replace("diameter", "radius") if "diameter" in key else key.replace("radius", "diameter")


def every_key(browser, binary, directory):
    """All keys of all embedded designs and their commands: each field shows the value of the file, and another value changes this key alone; of some also all absent keys."""
    shown = written = 0
    for name, commands in DESIGNS.items():
        with Serving(binary, directory, name) as address:
            live = Live(browser, address, "http://127.0.0.1:")
            for command in commands:
                if command != commands[0]:
                    live.after(lambda: live.page.select_option("#command", command))
                before = keys_of(live.toml())
                fields = live.page.evaluate(EVERY_KEY, name in WITH_ABSENT and command == commands[0])
                for one in fields:
                    key, what = one["key"], (name, command, one)
                    given = str(before.get(key, ""))
                    if isinstance(before.get(key), list):
                        assert re.sub(r"[^\w.+-]", "", given) == re.sub(r"[^\w.+-]", "", one["shown"].replace('"', "'")), what
                    elif one["isGiven"]:
                        assert number_of(one["shown"]) == number_of(given) or one["shown"].lower() == given.lower(), what
                    shown += one["isGiven"]
                    if one["toml"] is None:
                        continue
                    after = keys_of(one["toml"])
                    changed = {other for other in before.keys() | after.keys() if before.get(other) != after.get(other)}
                    assert key in changed and changed <= {key, twin(key)}, (changed, what)
                    assert number_of(after[key]) == number_of(one["value"]) or re.sub(r"[^\w.+-]", "", str(after[key])).lower() == re.sub(r"[^\w.+-]", "", one["value"]).lower(), (after[key], what)
                    written += 1
                # A key that has no field is one of other commands, or of no cam at all.
                lacking = (set(before) if command == commands[0] else lacking) - {one["key"] for one in fields}
            live.close()
            assert all(key.startswith("translating.") for key in lacking) and (not lacking or "translating" not in commands), (name, lacking)
    return shown, written


def undone(live, sent):
    """Undo leads back to the text as it was sent."""
    while live.page.is_enabled("#undo"):
        live.after(lambda: live.page.click("#undo"))
    assert live.toml() == sent, "undo does not lead back"
    assert not live.refused()


def named(live):
    """A value out of range names its key, and leaves the last cam in grey."""
    fields = live.page.evaluate("[...document.querySelectorAll('.field:not(.absent) > input[type=text]')].map((e) => e.id.slice(4))")
    key = next(key for key in ("cam.thickness", "cam.groove_depth", "follower.roller.radius") if key in fields)
    live.type(key, "-3 mm")
    text = live.page.inner_text("#faults")
    assert key in text and ("at least" in text or "above" in text), text
    assert live.page.evaluate("document.getElementById('shown').classList.contains('stale')")
    assert live.page.evaluate("(id) => document.getElementById(id).closest('.field').classList.contains('wrong')", f"key-{key}")
    live.after(lambda: live.page.click("#undo"))
    assert not live.refused()


def remedied(live):
    """A check that fails offers what would pass, and that passes."""
    live.type("limits.pressure_angle", "20 deg")
    live.type("cam.base_radius", "13 mm")
    if live.page.is_visible(".broken") or live.refused():
        assert live.page.locator("button.remedy").count(), live.page.inner_text("#verdict")
        live.after(lambda: live.page.locator("button.remedy").first.click())
        assert not live.page.is_visible(".broken"), live.page.inner_text("#verdict")[:400]
        return True
    return False


def frames(live):
    """Frames a second and answers a second while a slider moves for two seconds, and the time from its rest until the proof can be seen, ms: the median of seven rests."""
    drag = """async (id) => { const e = document.getElementById(id).parentElement.querySelector('input[type=range]'); const from = Number(e.value); const wide = (Number(e.max) - Number(e.min)) / 20;
      const answers = () => Number(document.documentElement.dataset.answers); const before = answers(); const begin = performance.now(); let count = 0;
      while (performance.now() - begin < 2000) { await new Promise(requestAnimationFrame); count += 1; e.value = from + wide * Math.sin(count / 10); e.dispatchEvent(new Event('input')); }
      const result = [count / 2, (answers() - before) / 2]; e.value = from; e.dispatchEvent(new Event('change')); return result; }"""
    key, low, high = next(slider for slider in live.sliders() if "radius" in slider[0] and "bore" not in slider[0])
    result, proofs = [], []
    live.page.evaluate("window.scrollTo(0, 0)")
    live.after(lambda: result.extend(live.page.evaluate(drag, key)))
    rest = float(live.page.evaluate("(id) => document.getElementById(id).parentElement.querySelector('input[type=range]').value", key))
    for step in range(7):
        live.slide(key, rest + (step % 3) * (high - low) / 40)
        proofs.append(int(live.page.evaluate("document.documentElement.dataset.proof")))
    return (*result, sorted(proofs)[len(proofs) // 2])


def memory(live):
    """The heap of the page after its garbage is collected, and the memory of the engine, bytes."""
    session = live.context.new_cdp_session(live.page)
    session.send("HeapProfiler.collectGarbage")
    heap = session.send("Runtime.getHeapUsage")["usedSize"]
    session.detach()
    return int(heap), live.page.evaluate("Number(document.documentElement.dataset.engineMemory)")


def warmed(live):
    """Some changes and back again."""
    for key, low, high in live.sliders()[:3]:
        # Ends are round numbers, and so may be a third of the way.
        live.slide(key, low + 0.37 * (high - low))
        live.after(lambda: live.page.click("#undo"))


def second_disc(live):
    """A check that only the counter disc fails is shown with the name of that disc."""
    live.type("cam.counter.radius", "45 mm")
    assert not live.refused(), live.page.inner_text("#faults")
    broken = live.page.inner_text("#verdict .banner")
    assert "FAIL" in broken and "counter" in broken, broken
    assert live.page.locator(".other[data-disc=counter] tbody tr.fail").count(), live.page.inner_text("#verdict")[:400]
    live.after(lambda: live.page.click("#undo"))
    assert not live.page.locator(".other").count() and not live.page.is_visible(".broken")


def edited(live):
    """The motion editor: a node by the keyboard and by hand, a dwell, a law, a removal; each changes the text as it should."""
    live.page.locator(".node").first.focus()
    live.after(lambda: live.page.keyboard.press("ArrowRight"))
    assert 'over = "121 deg"' in live.toml() and live.page.evaluate("document.activeElement.dataset.node") == "0"
    node = live.page.locator(".node").first
    node.scroll_into_view_if_needed()
    box = node.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    live.page.mouse.move(x, y)
    live.page.mouse.down()
    live.page.mouse.move(x + 20, y, steps=5)
    live.after(live.page.mouse.up)
    assert 'over = "121 deg"' not in live.toml() and not live.refused(), live.page.inner_text("#faults")
    live.page.locator(".segment").nth(1).click(position={"x": 4, "y": 150})
    live.after(lambda: live.page.click("#addDwell"))
    assert live.toml().count("[[motion.segment]]") == 7 and not live.refused(), live.page.inner_text("#faults")
    live.after(lambda: live.page.click("#removeSegment"))
    assert live.toml().count("[[motion.segment]]") == 6 and not live.refused(), live.page.inner_text("#faults")
    live.page.locator(".segment").nth(0).click(position={"x": 4, "y": 150})
    live.page.click("#law-now")
    live.after(lambda: live.page.click("[data-law=cycloidal]"))
    assert 'law = "cycloidal"' in live.toml() and not live.refused()
    # The largest velocity of a cycloid is twice the mean one.
    picture = live.page.inner_text("[data-law=cycloidal]")
    travel, width, rpm = 30, *live.page.evaluate("[Number(document.querySelector('[data-row=\"0-0\"]').value), Number(document.getElementById('rpm').value)]")
    assert "v 2, a 6.28" in picture and f"v {2 * travel / width * 6 * rpm:.3g} mm/s" in picture, picture
    live.after(lambda: live.page.keyboard.press("ArrowRight"))
    assert 'law = "cycloidal"' not in live.toml() and live.page.evaluate("document.activeElement.dataset.law") != "cycloidal"
    live.after(lambda: (live.page.fill("[data-row='0-1']", "24"), live.page.keyboard.press("Tab")))
    assert 'to = "24 mm"' in live.toml() and not live.refused()
    live.type("motion.rpm", "90")
    assert "rpm = 90 " in live.toml() and "90 rpm" in live.page.inner_text("#title"), live.toml()[:200]


def segment_ends(live):
    """Velocity and acceleration at the end of a segment are typed, and the choices of its keys are lists; each changes only its keys."""
    def changed(act):
        before = keys_of(live.toml())
        live.after(act)
        assert not live.refused(), live.page.inner_text("#faults")
        after = keys_of(live.toml())
        return {key.removeprefix("motion."): after.get(key) for key in before.keys() | after.keys() if before.get(key) != after.get(key)}

    def typed(place, value):
        return changed(lambda: (live.page.fill(f"[data-end='{place}']", value), live.page.keyboard.press("Tab")))

    def chosen(place, value):
        return changed(lambda: live.page.select_option(f"[data-end='{place}']", value))

    assert live.page.get_attribute("[data-end='0-velocity']", "placeholder") == "0 mm/deg" and live.page.input_value("[data-end='2-velocity']") == "-0.3 mm/deg"
    assert typed("2-velocity", "-0.25") == {"segment[2].velocity": "-0.25 mm/deg"}
    assert typed("3-velocity", "-0,25") == {"segment[3].velocity": "-0.25 mm/deg"}
    assert typed("2-acceleration", "5") == {"segment[2].acceleration": "5 mm/rad2"}
    assert chosen("2-start", "free") == {"segment[2].start": "free"} and chosen("2-start", "") == {"segment[2].start": None}
    assert chosen("0-end", "turn") == {"segment[0].end": "turn"} and typed("0-inflection", "0.4") == {"segment[0].inflection": 0.4}
    assert live.page.is_disabled("[data-end='1-velocity']") and live.page.is_disabled("[data-end='0-start']")


def measured(live, binary, directory):
    """A table over the lift: the largest difference and its place, to a micrometre; what is no table is named, and one is taken away."""
    (directory / "measured.toml").write_text(live.toml())
    made = run(binary, directory, "make", "measured.toml", "--format", "csv", "--samples", "97", "--name", "measured", "--out", ".", "--overwrite", "--quiet")
    assert made.returncode == 0, made.stderr
    lines = (directory / "measured.csv").read_text().splitlines()
    head = next(line for line in lines if line.startswith("cam_deg")).split(",")
    rows = [line.split(",") for line in lines if line[:1].isdigit()]
    table = [(float(row[0]), float(row[head.index("lift_mm")])) for row in rows]
    at, lift = table[40]
    # With decimal commas, as a measuring room writes it, between the rows that the page has.
    written = [(place, value - 0.0437 if place == at else value) for place, value in table]
    (directory / "lift.csv").write_text("Winkel;Hub\n" + "".join(f"{place};{value}\n".replace(".", ",") for place, value in written))
    live.page.set_input_files("#measured", str(directory / "lift.csv"))
    live.until("document.getElementById('measured-said').textContent.includes('97')")
    said = live.page.inner_text("#measured-said")
    assert "largest difference of the measured lift −0.0437 mm" in said and f"at {at:.6g} °" in said, said
    live.page.set_input_files("#measured", {"name": "none.csv", "mimeType": "text/csv", "buffer": b"a;b\nc;d\n"})
    live.until("document.getElementById('measured-said').textContent.includes('none.csv')")
    live.page.set_input_files("#measured", str(directory / "lift.csv"))
    live.until("document.querySelector('#motion-diagram .measured').getAttribute('d').length > 100")
    live.page.click("#measured-remove")
    assert live.page.inner_text("#measured-said") == "" and lift > 0


def extremes(live, report):
    """The extremes beside the cam are those of the report, to four digits: rates between rows of the page, at changes of a law, and torques."""
    labels = live.page.evaluate("Object.fromEntries([...document.querySelectorAll('.stack .lane')].map((e) => [e.querySelector('.lane-name').textContent, [...e.querySelectorAll('.extreme-label')].map((f) => f.textContent)]))")
    peaks = [segment["peaks"] for segment in report["motion"]["segments"]]
    rate = lambda name: max(peak[name] for peak in peaks)
    dynamics = report["dynamics"]
    expected = {"velocity": rate("velocity_per_s"), "acceleration": rate("acceleration_per_s2"), "jerk": rate("jerk_per_s3") / 1e3, "shaft torque": dynamics["torque_max_nm"]}
    for lane, value in expected.items():
        assert labels[lane][0].lstrip("−") == f"{value:.4g}", (lane, labels[lane], value)
    assert labels["acceleration"][1] == f"−{expected['acceleration']:.4g}" and labels["shaft torque"][1] == f"−{-dynamics['torque_min_nm']:.4g}", labels


def dimensions(live):
    """Dimensions in the picture: a click and a value change one key, a drag too; no box lies on another or beyond the picture, wherever the cam is."""
    def changed(act):
        before = keys_of(live.toml())
        live.after(act)
        assert not live.refused(), live.page.inner_text("#faults")
        after = keys_of(live.toml())
        return {key: after.get(key) for key in before.keys() | after.keys() if before.get(key) != after.get(key)}

    def typed(kind, value):
        live.page.click(f"[data-dimension={kind}]")
        live.page.keyboard.type(value)
        live.page.keyboard.press("Enter")

    live.page.evaluate("window.scrollTo(0, 0)")
    shown = live.page.evaluate("Object.fromEntries([...document.querySelectorAll('[data-dimension]')].map((e) => [e.dataset.dimension, e.value]))")
    assert shown == {"base": "R30", "roller": "R16", "arm": "110", "pivot": "140"}, shown
    assert changed(lambda: typed("roller", "R17")) == {"follower.swinging-roller.radius": "17 mm"}
    assert changed(lambda: typed("base", "34")) == {"cam.base_radius": "34 mm"}
    box = live.page.locator("[data-dimension=pivot]").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    def drag():
        live.page.mouse.move(x, y)
        live.page.mouse.down()
        live.page.mouse.move(x + 8, y - 10, steps=4)
        live.page.mouse.up()
    found = changed(drag)
    assert set(found) == {"follower.swinging-roller.pivot_distance"} and 142 < number_of(*found.values())[0] < 150, found
    overlaps = """() => { const area = document.querySelector('#mechanisms svg').getBoundingClientRect(); const boxes = [...document.querySelectorAll('[data-dimension]')].map((e) => e.getBoundingClientRect());
      return boxes.filter((a, i) => a.left < area.left || a.right > area.right || a.top < area.top || a.bottom > area.bottom || boxes.some((b, j) => j > i && a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom)).length; }"""
    for width, height in ((1440, 900), (1024, 768)):
        live.page.set_viewport_size({"width": width, "height": height})
        live.page.wait_for_timeout(300)
        for cycle in range(0, 360, 40):
            live.page.evaluate("(at) => { const e = document.getElementById('scrub'); e.value = at; e.dispatchEvent(new Event('input')); }", cycle)
            assert live.page.evaluate(overlaps) == 0, (width, cycle)
    live.page.set_viewport_size({"width": 1440, "height": 900})


def inches(live, binary, directory):
    """The switch of units sets a key of the file: fields, figures and labels in inches, files as those of the command line; and back to the file as it was."""
    before, field = live.toml(), "[id='key-follower.swinging-roller.arm']"
    assert live.page.input_value(field) == "110 mm"
    live.after(lambda: live.page.click("[data-lengths=inch]"))
    changed = {key for key, value in keys_of(live.toml()).items() if keys_of(before).get(key) != value}
    assert changed == {"output.units"} and live.page.input_value(field) == "4.3307 in", (changed, live.page.input_value(field))
    assert "1.564 of at least 1.26 in" in live.page.inner_text("#answer"), live.page.inner_text("#answer")
    results = live.page.text_content("#results")
    assert "base radius1.1811in" in results and "0.811485kg" in results, results[:400]
    live.page.fill(field, "")
    live.after(lambda: (live.page.type(field, "4.4"), live.page.keyboard.press("Tab")))
    assert keys_of(live.toml())["follower.swinging-roller.arm"] == "4.4 in" and not live.refused(), live.page.inner_text("#faults")
    assert same_files(live, binary, directory, "make", "lever") == "passed"
    live.after(lambda: live.page.click("#undo"))
    live.after(lambda: live.page.click("[data-lengths=mm]"))
    assert live.toml() == before and live.page.input_value(field) == "110 mm"


def ghosts(live):
    """Behind changed curves and outline those of the design as sent, and every figure that differs."""
    curve, outline = "#motion-diagram .curve", "#mechanisms .part.{} path"
    before = live.page.get_attribute(curve, "d"), live.page.get_attribute(outline.format("cam"), "d")
    live.type("cam.base_radius", "70 mm")
    sent, now = (live.page.get_attribute(outline.format(role), "d") for role in ("sent", "cam"))
    assert sent == before[1] != now, (sent[:60], before[1][:60], now[:60])
    numbers = lambda path: [float(number) for number in re.findall(r"-?[\d.]+", path)]
    pairs = list(zip(numbers(before[0]), numbers(live.page.get_attribute("#motion-diagram .ghost", "d")), strict=True))
    # Coordinates are written in tenths.
    assert len(pairs) > 600 and max(abs(a - b) for a, b in pairs) < 0.11, "the motion as it was"
    text = live.page.text_content("#differences")
    assert "base radius" in text and "pressure angle" in text.lower() and "as sent" in text, text[:400]
    live.after(lambda: live.page.click("#reset"))
    assert live.page.locator(outline.format("sent")).count() == 1 and live.page.get_attribute(outline.format("cam"), "d") == before[1]


def by_keys(live):
    """Without a pointer: from the head of the page to a slider, and a change of it."""
    live.page.evaluate("document.activeElement.blur(); window.scrollTo(0, 0)")
    seen = []
    for _ in range(200):
        live.page.keyboard.press("Tab")
        name = live.page.evaluate("(() => { const e = document.activeElement; return e.type === 'range' && e.id !== 'scrub' ? 'slider ' + e.getAttribute('aria-label') : e.id || e.textContent.slice(0, 20); })()")
        seen.append(name)
        if name.startswith("slider"):
            break
    assert seen[-1].startswith("slider"), seen
    before = live.toml()
    live.after(lambda: live.page.keyboard.press("ArrowRight"))
    assert live.toml() != before, "an arrow key does not move a slider"
    live.after(lambda: live.page.keyboard.press("Control+z"))
    assert live.toml() == before
    return len(seen)


def tabled(browser, binary, directory):
    """A design that names a file: its text is in the page, and the files are those of the command line."""
    rise = lambda x: 10 * x**3 - 15 * x**4 + 6 * x**5
    lift = lambda at: 20 * (rise(at / 150) if at < 150 else rise((360 - at) / 210))
    (directory / "table.csv").write_text("deg;mm\n" + "".join(f"{at};{lift(at):.9f}\n" for at in range(360)))
    text = run(binary, directory, "machines", "show", "feeder").stdout
    own = text[: text.index("[motion]")] + '[motion]\nrpm = 120\nstart = "0 mm"\ntable = "table.csv"\n\n' + text[text.index("[follower") :]
    (directory / "tabled.toml").write_text(own)
    made = run(binary, directory, "make", "tabled.toml", "--format", "html", "--live", "--name", "tabled", "--out", ".", "--overwrite", "--quiet")
    assert made.returncode == 0, made.stderr
    live = Live(browser, (directory / "tabled.html").as_uri())
    assert live.page.input_value("[id='key-motion.table']") == "table.csv"
    live.type("cam.base_radius", "47 mm")
    outcome = same_files(live, binary, directory, "make", "tabled")
    assert outcome == "passed", (outcome, live.page.inner_text("#faults"))
    live.close()


def designed(browser, address, binary, directory, allowed="file:"):
    """A packaging designer: rise 30 mm in 120 deg, dwell 60 deg, return in 100 deg, a roller on an arm, 250 rpm, a spring, the smallest cam, its drawing."""
    begun = time.time()
    live = Live(browser, address, allowed)
    if not live.page.is_visible("#gallery"):
        live.click("#designs")
    live.until("document.getElementById('new-make') !== null")
    live.click("#new-follower-swinging-roller")
    for name, value in (("rise", 30), ("riseOver", 120), ("dwellOver", 60), ("returnOver", 100), ("rpm", 250), ("moving", 0.01), ("rate", 40), ("preload", 25)):
        live.page.fill(f"#new-{name}", str(value))
        live.acts += 1
    # The last value is ended by Enter, which makes the cam.
    live.after(lambda: live.page.keyboard.press("Enter"))
    assert not live.refused(), live.page.inner_text("#faults")
    made = keys_of(live.toml())
    assert [made[key] for key in ("follower.swinging-roller.inertia", "spring.rate", "spring.preload")] == ["0.01 kg*m2", "40 N*m/rad", "25 N*m"], made
    if live.page.is_visible(".broken"):
        live.click("button.remedy")
    assert not live.refused(), live.page.inner_text("#faults")
    outcome = same_files(live, binary, directory, "make", "new-cam")
    assert outcome == "passed", (outcome, live.page.inner_text("#verdict")[:600], live.toml())
    live.page.locator("#sheet summary").click()
    live.until("document.getElementById('sheet-picture').complete && document.getElementById('sheet-picture').naturalWidth > 100")
    assert live.acts <= MOST_ACTS, live.acts
    acts = live.acts
    live.close()
    return acts, time.time() - begun


# Numbers of the form for a new cam beside those that it begins with, by body.
NUMBERS = {
    "yoke": [{"riseOver": 180}], "wedge": [{"returnOver": 0}, {"dwellOver": 0, "riseOver": 110.5}],
    "globoid": [{"stations": 4, "riseOver": 200}, {"stations": 6, "riseOver": 200}, {"stations": 24, "riseOver": 90}],
}
# What the form refuses, with what it says.
WRONG = [("yoke", {"riseOver": 181}, "180"), ("globoid", {"stations": 2.5}, "4 to 60"), ("disc", {"returnOver": 200}, "380"), ("wedge", {"rise": 0}, "above 0")]


def begun(browser, address, binary, directory, allowed="file:"):
    """Every follower with every body that the form has for it: each begins a cam that passes its checks, for the command line too."""
    live = Live(browser, address, allowed)
    filled, count = {"stations": 8, "rise": 30, "riseOver": 120, "dwellOver": 60, "returnOver": 100}, 0

    def asked(body, numbers, follower=None):
        if not live.page.is_visible("#gallery"):
            live.click("#designs")
        live.until("document.getElementById('new-make') !== null")
        if follower:
            live.page.check(f"#new-follower-{follower}")
        live.page.check(f"#new-body-{body}")
        for name, value in {**filled, **numbers}.items():
            if live.page.is_visible(f"#new-{name}"):
                live.page.fill(f"#new-{name}", str(value))

    def made(body, numbers, follower):
        asked(body, numbers, follower)
        live.after(lambda: live.page.click("#new-make"))
        what = f"{follower}, {body}, {numbers}"
        assert not live.refused(), (what, live.page.inner_text("#faults"), live.toml())
        assert not live.page.is_visible(".broken"), (what, live.page.inner_text("#verdict")[:600], live.toml())
        (directory / "begun.toml").write_text(live.toml())
        same = run(binary, directory, "make", "begun.toml", "--format", "csv", "--out", "begun", "--overwrite", "--quiet")
        assert same.returncode == 0, (what, same.stderr, live.toml())

    asked("disc", {})
    bodies = set()
    for follower in live.page.evaluate("[...document.querySelectorAll('[name=new-follower]')].map((e) => e.value)"):
        asked("disc", {}, follower)
        of = live.page.evaluate("[...document.querySelectorAll('[name=new-body]:enabled')].map((e) => e.value)")
        for body in of:
            for numbers in [{}, *(NUMBERS.get(body, []) if follower in ("roller", "knife") else [])]:
                made(body, numbers, follower)
                count += 1
        bodies.update(of)
    assert bodies == {"disc", "ring", "groove", "conjugate", "rib", "yoke", "wedge", "barrel", "globoid"}, bodies
    for body, numbers, words in WRONG:
        asked(body, numbers, "roller")
        live.page.click("#new-make")
        said = live.page.inner_text("#new-fault")
        assert live.page.is_visible("#new-fault") and words in said, (body, numbers, said)
    live.close()
    return count


class Serving:
    """A running `camgen serve` with its address."""

    def __init__(self, binary, directory, *words):
        self.process = subprocess.Popen([binary, "serve", *words], cwd=directory, stdout=subprocess.PIPE, text=True)
        self.address = self.process.stdout.readline().strip()

    def __enter__(self):
        return self.address

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait(10)


def served(browser, binary, directory):
    """The served page: the file is written with its comments, read again when it changes, and files are written; then a new cam from the gallery."""
    path = directory / "served.toml"
    text = run(binary, directory, "machines", "show", "feeder").stdout
    path.write_text(text)
    with Serving(binary, directory, "served.toml", "--out", "served-files", "--overwrite") as address:
        live = Live(browser, address, "http://127.0.0.1:")
        assert live.toml() == text
        live.type("cam.thickness", "17 mm")
        live.page.click("#save")
        live.until("document.getElementById('state').textContent.includes('served.toml')")
        assert path.read_text() == text.replace('thickness = "15 mm"', 'thickness = "17 mm"')
        live.page.click("#write")
        live.until("document.getElementById('state').textContent.includes('.step')")
        assert {file.name for file in (directory / "served-files").glob("served*")} == {"served.dxf", "served.svg", "served-review.svg", "served.step", "served.csv"}
        # Every file that was written can be taken by its name.
        names = live.page.locator("#files-list [data-file]").all_inner_texts()
        assert set(names) == {file.name for file in (directory / "served-files").glob("served*")}, names
        for name in names:
            with live.page.expect_download(timeout=120_000) as download:
                live.page.click(f"#files-list [data-file='{name}']")
            # The drawing names the files that are made with it: taken alone it names the profile only.
            if name != "served.svg":
                assert Path(download.value.path()).read_bytes() == (directory / "served-files" / name).read_bytes(), name
        at_once(live, binary, directory, path)
        live.after(lambda: path.write_text(text.replace('"15 mm"', '"18 mm"')))
        assert '"18 mm"' in live.toml()
        # A text that is wrong is named, with the last cam in grey, and a right one is shown again.
        live.after(lambda: path.write_text(text.replace('"15 mm"', '"wide"')))
        assert live.refused()
        live.after(lambda: path.write_text(text))
        assert not live.refused() and live.toml() == text
        rate, answers, proof = frames(live)
        live.close()
    several(browser, binary, directory)
    with Serving(binary, directory) as address:
        acts, seconds = designed(browser, address, binary, directory, "http://127.0.0.1:")
    return f"{rate:.0f} frames and {answers:.0f} cams a second, the proof after {proof} ms, a new cam after {acts} clicks and {seconds:.0f} s"


def at_once(live, binary, directory, path):
    """A click right behind a change writes the design with that change: the machine file, and the files of the cam."""
    field = "[id='key-cam.thickness']"
    live.page.fill(field, "19 mm")
    live.page.click("#save")
    for _ in range(500):
        if '"19 mm"' in path.read_text():
            break
        live.page.wait_for_timeout(20)
    assert '"19 mm"' in path.read_text(), live.page.inner_text("#state")
    # The state names the file since it was written before.
    live.until("document.getElementById('toml').value.includes('\"19 mm\"')")
    live.until("document.getElementById('state').textContent.includes('served.toml')")
    solid = directory / "served-files" / "served.step"
    before = solid.read_bytes()
    live.page.fill(field, "20 mm")
    live.page.click("#write")
    for _ in range(500):
        if solid.read_bytes() != before:
            break
        live.page.wait_for_timeout(20)
    live.until("document.getElementById('toml').value.includes('\"20 mm\"')")
    live.until("document.getElementById('state').textContent.includes('.step')")
    (directory / "twenty.toml").write_text(live.toml())
    checked = run(binary, directory, "check", str(solid), "--design", "twenty.toml")
    assert '"20 mm"' in live.toml() and checked.returncode == 0, checked.stdout + checked.stderr


def usual_names(browser, binary, directory):
    """Without a name of its own a page names its files as the command line does, by the speed that the design has now."""
    made = run(binary, directory, "make", "feeder", "--format", "html", "--live", "--out", ".", "--overwrite", "--quiet")
    assert made.returncode == 0, made.stderr
    live = Live(browser, (directory / "feeder-make-120rpm.html").as_uri())
    live.type("motion.rpm", "90")
    (name, bytes_), = live.download("dxf", 1)
    (directory / "feeder.toml").write_text(live.toml())
    made = run(binary, directory, "make", "feeder.toml", "--format", "dxf", "--out", "usual", "--overwrite", "--quiet")
    assert made.returncode == 0 and bytes_ == (directory / "usual" / name).read_bytes() and name == "feeder-make-90rpm.dxf", name
    # A design in its box applies when the box is left, and a straight line that is made longer has the velocity that follows.
    live.page.evaluate("document.getElementById('file').open = true")
    live.page.locator("#toml").click()
    live.page.keyboard.press("Control+Home")
    live.page.keyboard.type("# a word of the designer\n")
    live.after(lambda: live.page.keyboard.press("Tab"))
    live.type("cam.thickness", "16 mm")
    assert live.toml().startswith("# a word of the designer\n") and '"16 mm"' in live.toml()
    line = live.page.evaluate("[...document.querySelectorAll('#motion-rows tbody tr')].findIndex((row) => ['line', 'constant-velocity'].includes(row.children[1].textContent))")
    assert line >= 0
    live.page.focus(f"[data-node='{line}']")
    live.after(lambda: live.page.keyboard.press("ArrowRight"))
    assert "contradict" not in live.page.inner_text("#faults"), live.page.inner_text("#faults")
    live.close()


def several(browser, binary, directory):
    """Two files in tabs, each with its own changes, its own history and its own file; then next to each other."""
    for name in ("first", "second"):
        (directory / f"{name}.toml").write_text(run(binary, directory, "machines", "show", "feeder").stdout)
    with Serving(binary, directory, "first.toml", "second.toml") as address:
        live = Live(browser, address, "http://127.0.0.1:")
        live.type("cam.thickness", "21 mm")
        live.after(lambda: live.page.click("[data-tab=second]"))
        assert '"15 mm"' in live.toml() and live.page.is_disabled("#undo")
        live.type("cam.base_radius", "66 mm")
        live.page.click("#save")
        live.until("document.getElementById('state').textContent.includes('second.toml')")
        assert '"66 mm"' in (directory / "second.toml").read_text() and '"66 mm"' not in (directory / "first.toml").read_text()
        live.after(lambda: live.page.select_option("#beside", label="first"))
        assert live.page.locator("#mechanisms figure > svg").count() == 2
        figures = live.page.text_content("#results")
        assert "B − A" in figures and "base radius" in figures, figures[:300]
        live.after(lambda: live.page.select_option("#beside", ""))
        assert live.page.locator("#mechanisms figure > svg").count() == 1
        live.after(lambda: live.page.click("[data-tab=first]"))
        assert '"21 mm"' in live.toml() and live.page.is_enabled("#undo")
        live.close()


def looks(live, name, directory, pictures):
    """Texts in two languages, contrast in light and dark, nothing wider than the window."""
    english = live.page.inner_text("main")
    live.page.select_option("#language", "de")
    live.page.wait_for_timeout(300)
    german = live.page.inner_text("main")
    assert "Getriebe" in german and "Mechanism" not in german.split("\n"), "the second language"
    live.page.click("#play")
    assert live.page.inner_text("#play") == "Anhalten" and "Umlauf" in live.page.inner_text("#speed")
    live.page.click("#play")
    left = live.page.evaluate(ENGLISH)
    assert not left, f"English in the German page: {left}"
    live.page.select_option("#language", "en")
    live.page.wait_for_timeout(300)
    assert live.page.inner_text("main").split("\n")[0] == english.split("\n")[0]
    for theme in ("light", "dark"):
        poor = live.page.evaluate(CONTRAST)
        assert not poor, f"{name}, {theme}: {poor[:5]}"
        live.page.click("#look")
        live.page.wait_for_timeout(200)
    for width, height in WIDTHS:
        live.page.set_viewport_size({"width": width, "height": height})
        live.page.wait_for_timeout(400)
        wide = live.page.evaluate("document.documentElement.scrollWidth")
        assert wide <= width, f"{name} at {width} px is {wide} px wide"
        if pictures:
            live.page.screenshot(path=str(directory / f"{name}-{width}.png"))
    live.page.set_viewport_size({"width": 1440, "height": 900})
    unnamed = live.page.evaluate("[...document.querySelectorAll('button, input, select, textarea, [role=slider]')].filter((e) => e.checkVisibility() && !(e.labels?.length || e.textContent.trim() || e.getAttribute('aria-label'))).map((e) => e.outerHTML.slice(0, 80))")
    assert not unnamed, unnamed


def outdated(browser, directory, name):
    """A page whose engine finds other results than the program that wrote it says so."""
    text = page_of(directory, name).read_text()
    words = '"words":["'
    assert words in text
    altered = directory / f"outdated-{name}.html"
    altered.write_text(text.replace(words, words + "as an older engine says: ", 1))
    live = Live(browser, altered.as_uri())
    assert live.page.is_visible("#older"), "the page does not say that its engine is older"
    live.close()
    altered.unlink()


def page_of(directory, name):
    """The live page of a design: of a pair of cams that of the first."""
    return next(path for path in sorted(directory.glob(f"{name}*.html")) if b"wasm-unsafe-eval" in path.read_bytes())


def judge(browser, options, directory, name, command, generator):
    binary = options.binary
    # A file of the user, as the command line will be given it.
    text = run(binary, directory, "machines", "show", name).stdout
    (directory / f"{name}.toml").write_text(text)
    for old in directory.glob(f"{name}*.html"):
        old.unlink()
    made = run(binary, directory, command, f"{name}.toml", "--format", "html", "--live", "--name", name, "--out", ".", "--overwrite", "--quiet", "--force")
    # A forced file of a cam that breaks a limit is written with the exit code of the check.
    assert made.returncode == ((name, command) == FAILING), made.stderr
    path = page_of(directory, name)
    size = path.stat().st_size
    assert size < LARGEST, f"{name}: {size} bytes"
    live = Live(browser, path.as_uri())
    assert live.page.is_hidden("#older"), f"{name}: the page says that its engine is older"
    sent = live.toml()
    assert sent == text, f"{name}: another text than the file"
    first = same_files(live, binary, directory, command, name)
    assert first == ("failed" if (name, command) == FAILING else "passed"), first
    if name == "lever":
        extremes(live, json.loads((directory / f"{name}-{command}-files" / f"{name}.json").read_text()))
        dimensions(live)
        undone(live, sent)
        inches(live, binary, directory)
        undone(live, sent)
    values_shown(live, 4, generator)
    begin = memory(live)
    # What the page keeps of the last cam is there after the first change.
    warmed(live)
    warm = memory(live)
    found = moves(live, binary, directory, command, name, options.moves, options.checked_every, generator)
    end = memory(live)
    undone(live, sent)
    named(live)
    extra = ""
    if name == "conjugate":
        second_disc(live)
    if name == "feeder":
        extra = f", a remedy {'clicked' if remedied(live) else 'not needed'}"
        undone(live, sent)
        segment_ends(live)
        undone(live, sent)
        edited(live)
        undone(live, sent)
        measured(live, binary, directory)
        ghosts(live)
        extra += f", a slider after {by_keys(live)} times Tab"
        undone(live, sent)
        looks(live, name, directory, options.pictures)
    rate, answers, proof = frames(live)
    live.close()
    return (f"{name}: {size // 1000} kB, live after {live.start:.2f} s, proof at rest {proof} ms, {rate:.0f} frames and {answers:.0f} cams a second while a slider moves, {options.moves} moves {found}, "
            f"memory {begin[0] / 1e6:.1f}+{begin[1] / 1e6:.1f} MB to {end[0] / 1e6:.1f}+{end[1] / 1e6:.1f} MB, the heap of the page {(end[0] - warm[0]) / 1e3 / max(1, options.moves):.1f} kB a move{extra}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary", type=Path)
    parser.add_argument("directory", type=Path)
    parser.add_argument("--moves", type=int, default=8)
    parser.add_argument("--designs", default="feeder,lever,valve,groove,conjugate,yoke,wedge,dpi,dpi-six-bar")
    parser.add_argument("--checked-every", type=int, default=4, help="moves between two comparisons with the command line")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--pictures", action="store_true")
    options = parser.parse_args()
    options.binary = options.binary.resolve()
    directory = (options.directory / "live").resolve()
    directory.mkdir(parents=True, exist_ok=True)
    generator = random.Random(options.seed)
    known = {(name if command == commands[0] else f"{name}:{command}"): command for name, commands in DESIGNS.items() for command in commands}
    names = list(known) if options.designs == "all" else options.designs.split(",")
    if unknown := [name for name in names if name not in known]:
        sys.exit(f"no such design: {unknown}")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=browser_path(), args=FLAGS)
        for name in names:
            print("live:", judge(browser, options, directory, name.split(":")[0], known[name], generator), flush=True)
        outdated(browser, directory, names[0].split(":")[0])
        print("live: {} values shown as in their files, {} keys written, each alone".format(*every_key(browser, options.binary, directory)), flush=True)
        forms(browser, options.binary, directory, generator)
        tabled(browser, options.binary, directory)
        usual_names(browser, options.binary, directory)
        acts, seconds = designed(browser, page_of(directory, names[0].split(":")[0]).as_uri(), options.binary, directory)
        print(f"live: {begun(browser, page_of(directory, names[0].split(':')[0]).as_uri(), options.binary, directory)} new cams of every follower and body pass at once", flush=True)
        print("live: served,", served(browser, options.binary, directory), flush=True)
        print(f"live: the packaging designer is done after {acts} clicks and {seconds:.0f} s", flush=True)
        browser.close()


main()
