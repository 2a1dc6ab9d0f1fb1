"""Pages in the frames of a notebook."""

from __future__ import annotations

import html

#: Height of the frame, pixels.
HEIGHT = 640


def framed(page: str) -> str:
    """A page in a frame of its own, which runs its script and reaches nothing else."""
    return (
        f'<iframe sandbox="allow-scripts" style="width:100%;height:{HEIGHT}px;border:0" '
        f'srcdoc="{html.escape(page, quote=True)}"></iframe>'
    )
