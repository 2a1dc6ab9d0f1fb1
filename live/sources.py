#!/usr/bin/env python3
"""Prints the digest of the sources of which the engine is built: those of the library, without its tests, and of the engine itself.

usage: live/sources.py           the digest
       live/sources.py --check   whether it is that of the engine in templates/live; exit code 1 and the remedy if not
"""

import hashlib
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
SOURCES = ["Cargo.toml", "src/lib.rs", "crates/*/Cargo.toml", "crates/*/src/**/*.rs", "profiles/**/*.toml", "live/Cargo.lock", "live/Cargo.toml", "live/build.rs", "live/src/*.rs"]
RECORD = ROOT / "templates/live/engine.sources"


def is_test(path):
    return "tests" in path.parts or path.name == "tests.rs"


def digest():
    found = {path.relative_to(ROOT) for pattern in SOURCES for path in ROOT.glob(pattern)}
    whole = hashlib.sha256()
    for path in sorted(found, key=str):
        if not is_test(path):
            whole.update(f"{path.as_posix()} {hashlib.sha256((ROOT / path).read_bytes()).hexdigest()}\n".encode())
    return whole.hexdigest()


if sys.argv[1:] == ["--check"]:
    if RECORD.read_text().strip() != digest():
        sys.exit("templates/live/engine.wasm.zst is older than the library: live/build builds it")
else:
    print(digest())
