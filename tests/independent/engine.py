"""The engine of the live page before the program: the same files for the same machine file, byte for byte.

The engine is taken out of a live page and run in Chromium as WebAssembly. Designs are the embedded ones and random changes of their numbers. Files are
DXF, SVG, STEP, CSV, JSON, the motion diagram and the moving report; a cam that breaks a limit, or that cannot be, must be so for both.

usage: engine.py CAMGEN_BINARY DIRECTORY [--count N] [--seed N]
"""
import argparse
import base64
import json
import random
import re
import subprocess
from pathlib import Path

from playwright.sync_api import sync_playwright

from page_tools import FLAGS, browser_path

COMMANDS = {
    "feeder": "make", "lever": "make", "valve": "make", "groove": "make", "conjugate": "make", "yoke": "make", "wedge": "make", "dpi": "rotary", "dpi-paper": "rotary",
    "dpi-crank-slider": "rotary", "dpi-six-bar": "rotary", "dpi-shaft": "translating", "barrel": "make",
}
FORMATS = ["dxf", "svg", "step", "csv", "json", "diagram", "html"]
# A barrel has no motion diagram.
OTHER_FORMATS = {"barrel": ["dxf", "svg", "step", "csv", "json", "html"]}
# Numbers that are changed, with how far: a share of the number.
CHANGED = r'^(radius|diameter|mass|thickness|bore_radius|bore_diameter|pressure_angle|rpm|to|over|arm|pivot_distance|preload|rate|face_width) = "?(\d+(?:\.\d+)?)'
START = """async () => {
  // Five characters for four bytes, behind the number of those that are too many.
  const text = document.getElementById('engine').textContent;
  const digits = '0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz!#$%()*+,-./:;=?@[]^_|~';
  const view = new DataView(new ArrayBuffer((text.length - 1) / 5 * 4));
  for (let at = 1; at < text.length; at += 5) {
    const value = [...text.slice(at, at + 5)].reduce((all, digit) => all * 85 + digits.indexOf(digit), 0);
    view.setUint32((at - 1) / 5 * 4, value);
  }
  const packed = new Uint8Array(view.buffer, 0, view.byteLength - Number(text[0]));
  const plain = fzstd.decompress(packed);
  const compiled = await WebAssembly.compile(plain);
  const imports = {};
  for (const { module, name } of WebAssembly.Module.imports(compiled)) (imports[module] ??= {})[name] = () => { throw new Error(name); };
  const begin = performance.now();
  window.engineUnderTest = new WebAssembly.Instance(compiled, imports).exports;
  return [plain.byteLength, WebAssembly.Module.imports(compiled).length];
}"""
CALL = """(request) => {
  const engine = window.engineUnderTest;
  const asked = new TextEncoder().encode(request);
  const room = engine.room(asked.length);
  new Uint8Array(engine.memory.buffer, room, asked.length).set(asked);
  const begin = performance.now();
  const size = engine.run();
  const seconds = performance.now() - begin;
  const bytes = new Uint8Array(engine.memory.buffer, engine.answer(), size).slice();
  let text = '';
  for (let at = 0; at < bytes.length; at += 32768) text += String.fromCharCode(...bytes.subarray(at, at + 32768));
  return [btoa(text), seconds];
}"""


def changed(text, generator):
    """A text with some of its numbers changed by up to a fifth."""
    def other(match):
        if generator.random() > 0.4:
            return match[0]
        return match[0].replace(match[2], f"{float(match[2]) * generator.uniform(0.85, 1.2):.4g}")

    return re.sub(CHANGED, other, text, flags=re.MULTILINE)


def answered(page, request):
    packed, milliseconds = page.evaluate(CALL, json.dumps(request))
    data = base64.b64decode(packed)
    length = int.from_bytes(data[:4], "little")
    answer, at = json.loads(data[4 : 4 + length]), 4 + length
    for file in answer["files"]:
        file["bytes"], at = data[at : at + file["size"]], at + file["size"]
    return answer, milliseconds


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary", type=Path)
    parser.add_argument("directory", type=Path)
    parser.add_argument("--count", type=int, default=50)
    parser.add_argument("--seed", type=int, default=3)
    options = parser.parse_args()
    binary, directory = options.binary.resolve(), (options.directory / "engine").resolve()
    directory.mkdir(parents=True, exist_ok=True)
    run = lambda *words: subprocess.run([binary, *words], cwd=directory, capture_output=True, text=True)
    made = run("make", "feeder", "--format", "html", "--live", "--name", "page", "--out", ".", "--overwrite", "--quiet")
    assert made.returncode == 0, made.stderr
    generator, found, slowest, files = random.Random(options.seed), {}, {}, 0
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=browser_path(), args=FLAGS)
        page = browser.new_page()
        page.goto((directory / "page.html").as_uri())
        page.add_script_tag(content=page.text_content("#unpack"))
        size, imports = page.evaluate(START)
        for number in range(options.count):
            name = list(COMMANDS)[number % len(COMMANDS)]
            command, stem = COMMANDS[name], f"design-{number}"
            text = run("machines", "show", name).stdout
            text = text if number < len(COMMANDS) else changed(text, generator)
            (directory / f"{stem}.toml").write_text(text)
            formats = OTHER_FORMATS.get(name, FORMATS)
            native = run(command, f"{stem}.toml", "--format", ",".join(formats), "--name", stem, "--quiet", "--overwrite")
            answer, milliseconds = answered(page, {"name": stem, "toml": text, "command": command, "formats": formats})
            slowest[name] = max(slowest.get(name, 0), milliseconds)
            if native.returncode == 2:
                assert "faults" in answer, (stem, native.stderr, answer.keys())
                outcome = "refused"
            elif native.returncode == 1:
                assert answer["passed"] is False and not answer["files"], (stem, native.stderr)
                outcome = "failed"
            else:
                assert answer.get("passed"), (stem, answer.get("faults"))
                names = {file["name"] for file in answer["files"]}
                assert names == {path.name for path in (directory / "output").glob(f"{stem}[.-]*")}, (stem, names)
                for file in answer["files"]:
                    assert file["bytes"] == (directory / "output" / file["name"]).read_bytes(), f"{name}: {file['name']} has other bytes"
                files += len(names)
                outcome = "passed"
            found[outcome] = found.get(outcome, 0) + 1
        browser.close()
    assert found["passed"] > options.count / 2, found
    times = ", ".join(f"{name} {time_:.0f} ms" for name, time_ in slowest.items())
    print(f"engine: {size} bytes with {imports} imports, {options.count} designs {found}, {files} files with the same bytes; slowest {times}")


main()
