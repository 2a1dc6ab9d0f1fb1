"""The program ``camgen``, of the same sources as the package."""

from __future__ import annotations

import os
import signal
import sys

from ._camgen import command


def main() -> int:
    """Runs the command line of this process and returns its exit code."""
    # As a program without an interpreter has them: an interrupt ends it, and removes what is half written. One that is ignored from the
    # start, as behind nohup, stays so.
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    if hasattr(signal, "SIGXFSZ"):
        signal.signal(signal.SIGXFSZ, signal.SIG_DFL)
    code = command([os.path.basename(sys.argv[0]), *sys.argv[1:]])
    sys.stdout.flush()
    return code


if __name__ == "__main__":
    sys.exit(main())
