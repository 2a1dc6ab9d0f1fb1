"""Packs a WebAssembly module for the page: without custom sections, which only tools read, and compressed.

usage: pack.py MODULE PACKED
"""
import gzip
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
    # Without a time, so that the same module gives the same bytes.
    compressed = gzip.compress(kept, 9, mtime=0)
    open(packed, "wb").write(compressed)
    print(f"engine: {len(kept)} bytes, compressed {len(compressed)}")


main()
