"""Opens the moving report in Chromium without a network, and uses it as a person would.

No message on the console; play moves the roller and the numbers; the keyboard works; nothing plays by itself; the legend has the
values of the place that the mechanism shows; text has the contrast of WCAG AA in light and dark. Mechanism and first diagram are
wholly visible in a window of 1440 x 900 without scrolling; nothing is wider than the window at 1440, 1024, 800 and 390 px; the
checks are one line, which is open where one failed or warns, these first. Printing gives A4 pages, none of them nearly empty, no
figure on two of them. The curves of a mechanism are one
stack over one axis. A name full of HTML stays a name. The time to the first paint is printed, not judged.

usage: page.py CAMGEN_BINARY DIRECTORY [--pictures]
"""
import argparse
import re
import shutil
import subprocess
from pathlib import Path

from playwright.sync_api import sync_playwright

from page_tools import CONTRAST, FLAGS, browser_path

LIFTER = Path(__file__).parent.parent / "all" / "common" / "lifter.toml"
HOSTILE = 'name = "</script><b id=planted>Ролик</b><script>document.title=1</script>"'
SWINGING = '[follower.swinging-roller]\nradius = "16 mm"\narm = "110 mm"\npivot_distance = "140 mm"\n'
CASES = {
    "rotary": ["rotary"],
    "ccw": ["rotary", "--set", "cam.rotation=ccw"],
    "offset": ["rotary", "--set", "follower.roller.offset=20mm"],
    "failed": ["rotary", "--set", "cam.base_radius=40mm", "--force"],
    "translating": ["translating"],
    "conoid": ["conoid", "--rpm", "20,25,30,35"],
    "lifter": ["make", "lifter.toml"],
    "flat": ["make", "flat.toml"],
    "swinging": ["make", "swinging.toml"],
    "hostile": ["make", "hostile.toml"],
    "beside": ["side-by-side", "dpi", "lifter.toml"],
    "linkage": ["linkage", "dpi-six-bar"],
    "crank-slider": ["linkage", "dpi-crank-slider"],
    "feeder": ["make", "feeder"],
    "lever": ["make", "lever"],
    "valve": ["make", "valve"],
    "brake": ["brake", "roll-level"],
    "drive": ["drive"],
    "shaft": ["shaft"],
    "laws": ["laws", "lifter.toml"],
    "size": ["size", "lifter.toml"],
    "regimes": ["regimes"],
    "spring": ["spring"],
}
# Pages of what does not move.
STILL = {"drive", "shaft", "laws", "size", "regimes", "spring"}
WITH_SPRING = {"lever", "valve"}
LARGEST = 1_000_000
WINDOWS = ((1440, 900), (1024, 768), (800, 900), (390, 844))
FOLD = WINDOWS[0]

CHECKS = """() => {
  const box = document.querySelector('#verdict > details');
  if (!box || document.getElementById('verdict').hidden) return null;
  const cams = JSON.parse(document.getElementById('data').textContent).cams;
  const verdicts = cams.flatMap((cam) => cam.checks.map((check) => check.verdict));
  return {
    open: box.open, bad: verdicts.some((verdict) => verdict === 'fail' || verdict === 'warn'), high: box.getBoundingClientRect().height,
    rows: new Set(cams.flatMap((cam) => cam.checks.map((check) => check.check))).size,
    first: [...box.querySelectorAll(':scope > .wide tbody td:nth-child(2) .badge')].map((badge) => badge.textContent),
  };
}"""
LEGENDS = """() => {
  const text = (e) => e.textContent.replace(/\\s+/g, ' ').trim();
  const readout = [...document.querySelectorAll('.readout dd')].map((dd) => [...dd.children].map(text).join(' ').trim());
  const stack = document.querySelector('.stacked #stack');
  if (stack) {
    const middle = (e) => e.getBoundingClientRect().left + e.getBoundingClientRect().width / 2;
    const [cursor, bead] = [stack.querySelector('.cursor'), [...stack.querySelectorAll('.bead')].find((e) => e.getAttribute('visibility') === 'visible')];
    return [{ place: null, values: [...stack.querySelectorAll('.value')].filter((e, i) => stack.querySelectorAll('.lane-unit')[i].textContent.indexOf('10') < 0 && stack.querySelectorAll('.lane-unit')[i].textContent.indexOf('1/') < 0).map(text), readout, cursor: middle(cursor), dot: bead ? middle(bead) : middle(cursor) }];
  }
  const first = document.querySelector('#lead .plot');
  const [place, ...values] = [...first.querySelectorAll('.legend .value')].map(text);
  const left = (e) => e.getBoundingClientRect().left + e.getBoundingClientRect().width / 2;
  return [{ place, values, readout, cursor: left(first.querySelector('.cursor')), dot: left(first.querySelector('.dot')) }];
}"""
CUT_NAMES = """() => [...document.querySelectorAll('#mechanisms svg')].flatMap((svg) => {
  const all = svg.getBoundingClientRect();
  const inside = (box) => box.left >= all.left - 1 && box.right <= all.right + 1 && box.top >= all.top - 1 && box.bottom <= all.bottom + 1;
  return [...svg.querySelectorAll('text')].filter((name) => !inside(name.getBoundingClientRect())).map((name) => name.textContent);
})"""
STATE = """() => ({
  roller: [...document.querySelectorAll('.part.normal, .part.follower')].map((p) => p.getAttribute('transform')).join(),
  cam: (document.querySelector('.part.cam, .part.crank') ?? document.querySelector('.part.bed')).getAttribute('transform'),
  numbers: document.querySelector('.readout').innerText,
  legend: (document.querySelector('.legend') ?? document.querySelector('.stack')).textContent,
  scrub: Number(document.getElementById('scrub').value),
})"""


def written(binary, directory):
    lifter = LIFTER.read_text()
    head = lifter.split("[follower.roller]")[0]
    (directory / "lifter.toml").write_text(lifter)
    (directory / "flat.toml").write_text(head + "[follower.flat]\n")
    (directory / "swinging.toml").write_text(head.replace(" mm", " deg") + SWINGING)
    (directory / "hostile.toml").write_text(lifter.replace('name = "lifter"', HOSTILE))
    for name, command in CASES.items():
        html = [] if command[0] == "side-by-side" else ["--format", "html"]
        flags = [*html, "--name", name, "--out", ".", "--quiet"]
        made = subprocess.run([binary, *command, *flags], cwd=directory, capture_output=True, text=True)
        assert made.returncode == (1 if name == "failed" else 0), made.stderr
        size = (directory / f"{name}.html").stat().st_size
        assert size < LARGEST, f"{name}: {size} bytes"


class Page:
    """A page that remembers what it was told and what it asked for."""

    def __init__(self, browser, path, **options):
        self.context = browser.new_context(viewport=dict(zip(("width", "height"), FOLD)), **options)
        self.page, self.said = self.context.new_page(), []
        self.page.on("console", lambda message: self.said.append(f"{message.type}: {message.text}"))
        self.page.on("pageerror", lambda error: self.said.append(f"error: {error}"))
        self.page.on("request", lambda request: request.url.startswith("file:") or self.said.append(f"asks for {request.url}"))
        self.page.goto(path.as_uri())
        self.until("document.documentElement.dataset.ready !== undefined")

    def until(self, condition, seconds=10):
        """The page lets no text be evaluated, so that this looks again and again from outside."""
        for _ in range(20 * seconds):
            if self.page.evaluate(condition):
                return
            self.page.wait_for_timeout(50)
        raise AssertionError(f"never: {condition}")

    def state(self):
        return self.page.evaluate(STATE)

    def close(self):
        assert not self.said, self.said
        self.context.close()


def uses(page):
    """Play, pause, keys, the slider, a curve under the pointer: each moves the roller, or the links, and the numbers."""
    start = page.state()
    page.page.wait_for_timeout(150)
    assert page.state() == start, "it plays by itself"
    page.page.click("#play")
    page.until(f"Number(document.getElementById('scrub').value) > {start['scrub'] + 45}")
    page.page.click("#play")
    moved = page.state()
    for what in ("roller", "cam", "numbers", "legend"):
        assert moved[what] != start[what], f"play does not move {what}"
    page.page.wait_for_timeout(150)
    assert page.state() == moved, "pause does not stop it"
    page.page.evaluate("document.activeElement.blur()")
    for key, expected in (("Home", 0), ("ArrowRight", 1), ("Shift+ArrowRight", 11), ("ArrowLeft", 10)):
        page.page.keyboard.press(key)
        assert abs(page.state()["scrub"] - expected) < 1e-6, (key, page.state()["scrub"])
    before = page.page.inner_text("#speed")
    page.page.keyboard.press("+")
    assert page.page.inner_text("#speed") != before, "+ does not change the speed"
    page.page.keyboard.press("-")
    assert page.page.inner_text("#speed") == before, "- does not change it back"
    page.page.keyboard.press("Space")
    page.until("Number(document.getElementById('scrub').value) > 12")
    page.page.keyboard.press("Space")
    page.page.keyboard.press("End")
    assert page.state()["scrub"] > 90
    stacked = page.page.locator(".stacked").count() > 0
    area = page.page.locator(".stack .frame" if stacked else ".u-over").first
    area.scroll_into_view_if_needed()
    box = area.bounding_box()
    page.page.mouse.move(box["x"] + 0.25 * box["width"], box["y"] + 20)
    if stacked:
        page.page.mouse.down()
        page.page.mouse.up()
    hovered = page.state()
    assert abs(hovered["scrub"] - 90) < 25 or "returns" in page.page.content(), hovered["scrub"]
    agrees(page)
    page.page.mouse.move(2, 2)


def agrees(page):
    """The first values of a diagram's legend are those of the readout at the same place, in the same units."""
    for legend in page.page.evaluate(LEGENDS):
        assert legend["place"] is None or legend["place"] in legend["readout"], legend
        assert all(any(one == value or one.startswith(f"{value} ") for one in legend["readout"]) for value in legend["values"]), legend
        assert abs(legend["cursor"] - legend["dot"]) < 1, legend


def opens(page, name):
    """The checks are a line; open are those that failed or warn, these first, and the rest by a click."""
    found = page.page.evaluate(CHECKS)
    if not found:
        return
    assert found["open"] == found["bad"], f"{name}: open {found['open']}, something failed or warns: {found['bad']}"
    if found["bad"]:
        assert set(found["first"]) <= {"FAIL", "WARN"} and found["first"] == sorted(found["first"]), found
    else:
        assert found["high"] < 60, f"{name}: the line of checks is {found['high']} px high"
        page.page.click("#verdict summary")
        assert page.page.is_visible("#verdict table")
        page.page.click("#verdict summary")
    assert page.page.evaluate("document.querySelectorAll('#verdict tbody tr').length") == found["rows"], name


def above_the_fold(page, name):
    """Mechanism and first diagram are visible without scrolling; what has no mechanism has its diagram there."""
    for selector in ("#mechanisms svg", "#lead .plot", ".stacked #stack"):
        for box in page.page.evaluate("(selector) => [...document.querySelectorAll(selector)].map((e) => e.getBoundingClientRect().toJSON())", selector):
            if box["width"]:
                assert box["top"] >= 0 and box["bottom"] <= FOLD[1] and box["height"] > 80, f"{name}: {selector} {box}"


def named(page, name):
    """No name in a mechanism is cut at the edge of the picture."""
    cut = page.page.evaluate(CUT_NAMES)
    assert not cut, f"{name}: {cut}"


def units(page):
    if not page.page.is_visible("#unit-choice"):
        return
    curves = ".stacked .stack" if page.page.locator(".stacked").count() else "#plots"
    assert "/s" not in page.page.text_content(curves)
    page.page.select_option("#unit", "time")
    text = page.page.text_content(curves)
    assert "m/s²" in text or "rad/s²" in text, text[:400]
    assert "/s" in page.page.inner_text("#readouts")
    page.page.select_option("#unit", "angle")


def folded(page):
    """The curves are one stack; all diagrams with their legends are folded below it, and drawn when they are opened."""
    assert page.page.locator("#stack .lane").count() >= 4 and page.page.locator(".u-over").count() == 0
    page.page.click("#curves summary")
    page.until("document.querySelectorAll('#plots .u-over').length >= 4")
    page.page.click("#curves summary")
    page.until("document.querySelectorAll('.u-over').length === 0")


def fits(page, name):
    """Nothing is wider than the window."""
    for width, height in (*WINDOWS, FOLD):
        page.page.set_viewport_size({"width": width, "height": height})
        # The page is laid out anew once the size rests, which takes longer on a busy machine.
        for _ in range(40):
            page.page.wait_for_timeout(120)
            wide = page.page.evaluate("document.documentElement.scrollWidth")
            if wide <= width:
                break
        assert wide <= width, f"{name} at {width} px is {wide} px wide"
        named(page, name)


def prints(page, path):
    page.page.pdf(path=str(path), prefer_css_page_size=True)
    bytes_ = path.read_bytes()
    boxes = re.findall(rb"/MediaBox\s*\[([\d. ]+)\]", bytes_)
    sizes = {tuple(round(float(v)) for v in box.split()) for box in boxes}
    assert sizes == {(0, 0, 595, 842)}, f"{path.name}: {sizes}, not A4"
    pages = len(re.findall(rb"/Type\s*/Page\b", bytes_))
    assert 1 <= pages <= (7 if path.stem == "beside" else 5), f"{path.name} has {pages} pages"
    if shutil.which("pdftoppm"):
        filled = [filled_share(path, number) for number in range(1, pages + 1)]
        assert all(share > 0.5 for share in filled[:-1]) and filled[-1] > 0.15, f"{path.name}: pages filled to {filled}"
    return pages


def filled_share(path, number):
    """How far down a printed page there is something."""
    page = subprocess.run(["pdftoppm", "-r", "20", "-gray", "-f", str(number), "-l", str(number), str(path)], capture_output=True, check=True).stdout
    head = re.match(rb"P5\s+(\d+)\s+(\d+)\s+255\s", page)
    width, height = map(int, head.groups())
    rows = [page[head.end() + width * row : head.end() + width * (row + 1)] for row in range(height)]
    return max((row for row, pixels in enumerate(rows) if min(pixels) < 200), default=0) / height


def judge(browser, directory, name, pictures):
    path = directory / f"{name}.html"
    page = Page(browser, path)
    paint = page.page.evaluate("performance.getEntriesByName('first-paint')[0]?.startTime ?? NaN")
    opens(page, name)
    above_the_fold(page, name)
    if name not in STILL:
        uses(page)
        units(page)
    if page.page.locator(".stacked").count():
        folded(page)
    fits(page, name)
    assert page.page.locator(".part.spring").count() == (1 if name in WITH_SPRING else 0), f"{name}: springs"
    poor = page.page.evaluate(CONTRAST)
    assert not poor, f"{name}, light: {poor[:5]}"
    page.page.click("#theme")
    poor = page.page.evaluate(CONTRAST)
    assert not poor, f"{name}, dark by the button: {poor[:5]}"
    pages = prints(page, directory / f"{name}.pdf")
    if pictures:
        page.page.screenshot(path=str(directory / f"{name}.png"), full_page=True)
    failed = page.page.is_visible(".broken")
    assert failed == (name == "failed"), f"{name}: stamped {failed}"
    assert page.page.locator("#planted").count() == 0, "a name became an element"
    if name == "conoid":
        canvas = page.page.locator("#solid canvas")
        before = canvas.screenshot()
        canvas.focus()
        page.page.keyboard.press("ArrowRight")
        assert canvas.screenshot() != before, "the solid does not turn"
        numbers = page.state()["numbers"]
        page.page.select_option("#section", "0")
        assert page.state()["numbers"] != numbers, "another section has the same numbers"
    page.close()
    dark = Page(browser, path, color_scheme="dark", reduced_motion="reduce")
    poor = dark.page.evaluate(CONTRAST)
    assert not poor, f"{name}, dark: {poor[:5]}"
    dark.close()
    return f"{name}: {path.stat().st_size // 1000} kB, first paint {paint:.0f} ms, {pages} pages"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary", type=Path)
    parser.add_argument("directory", type=Path)
    parser.add_argument("--pictures", action="store_true")
    options = parser.parse_args()
    directory = (options.directory / "html").resolve()
    directory.mkdir(parents=True, exist_ok=True)
    written(options.binary.resolve(), directory)
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=browser_path(), args=FLAGS)
        for name in CASES:
            print("html:", judge(browser, directory, name, options.pictures), flush=True)
        browser.close()


main()
