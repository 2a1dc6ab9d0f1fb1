"""Tables of numbers: columns by their names, which end in their units."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Optional

import numpy as np
import numpy.typing as npt


class Table(Mapping[str, npt.NDArray[np.float64]]):
    """A table: ``table["lift_mm"]`` is a column of shape (rows,), a view of ``array``.

    ``dict(table)`` and ``pandas.DataFrame(dict(table))`` take it as it is. A value that a row lacks is NaN.
    """

    #: The names of the columns, in the order of the CSV file.
    columns: tuple[str, ...]
    #: All numbers, of shape (columns, rows).
    array: npt.NDArray[np.float64]
    #: A column of words before the others: its name, and a word for each row; None without one.
    words: Optional[tuple[str, list[str]]]

    def __init__(
        self, columns: tuple[str, ...], array: npt.NDArray[np.float64], words: Optional[tuple[str, list[str]]] = None
    ) -> None:
        self.columns = columns
        self.array = array
        self.words = words
        self._places = {name: place for place, name in enumerate(columns)}

    def __getitem__(self, name: str) -> npt.NDArray[np.float64]:
        column: npt.NDArray[np.float64] = self.array[self._places[name]]
        return column

    def __iter__(self) -> Iterator[str]:
        return iter(self.columns)

    def __len__(self) -> int:
        return len(self.columns)

    def __repr__(self) -> str:
        return f"<camgen.Table, {self.array.shape[1]} rows of {', '.join(self.columns)}>"
