"""Packs a WebAssembly module for the page: without custom sections, which only tools read, and compressed.

usage: pack.py MODULE PACKED
"""
import os
import subprocess
import sys


def number(data, at):
    """A number in LEB128, and where it ends."""
    value, shift = 0, 0
    while True:
        value |= (data[at] & 127) << shift
        at, shift = at + 1, shift + 7
        if not data[at - 1] & 128:
            return value, at


def plain(data):
    kept, at = data[:8], 8
    while at < len(data):
        size, start = number(data, at + 1)
        if data[at] != 0:
            kept += data[at : start + size]
        at = start + size
    return kept


def main():
    module, packed = sys.argv[1:]
    kept = plain(open(module, "rb").read())
    # A fifth smaller than gzip makes it. From a file, so that the size of the module is in the head of the result.
    plain_module = f"{packed}.plain"
    open(plain_module, "wb").write(kept)
    subprocess.run(["zstd", "--ultra", "-22", "--no-check", "--quiet", "--force", plain_module, "-o", packed], check=True)
    print(f"engine: {len(kept)} bytes, compressed {os.path.getsize(packed)}")


main()
