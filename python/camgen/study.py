"""Studies on many processes, or on a cluster with Dask: ``camgen.study.run("study.toml", client=Client("tcp://…"))``.

The rows are divided into shards. Each shard is written by the worker that made it, under the number of its first row, whole or not at all,
and a manifest lists the shards with their hashes. A run that was stopped continues with the shards that are missing. The table that is put
together of the shards has the bytes of the one that ``camgen study`` writes by itself.
"""

from __future__ import annotations

import contextlib
import functools
import hashlib
import json
import math
import multiprocessing
import os
import pathlib
import socket
import stat
import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from importlib import import_module
from multiprocessing import get_context
from typing import Any, NamedTuple, Optional, Union

from ._camgen import Study, __version__, write_shard
from ._errors import CamgenError

__all__ = ["Result", "StudyRunError", "run"]

#: Fewest designs of a shard, and the time that one should take, s: a scheduler spends about a thousandth of a second on each.
FEWEST, SECONDS = 1000, 10.0
#: Designs with which the cost of a row is measured.
MEASURED = 32
#: Least time between two writes of the manifest, s: it lists all shards, and with many of them one write for each would take the most of a run.
BETWEEN_SAVES = 1.0
#: The name of the list of shards.
MANIFEST = "manifest.json"
#: How often a shard is given to another worker after its worker was lost.
RETRIES = 5

_Path = Union[str, "os.PathLike[str]"]


class StudyRunError(CamgenError):
    """A study that cannot go on: a worker of another version, a full disk, a shard that no worker finishes."""


class WorkerMismatch(Exception):
    """A worker that would make other rows. Its arguments are texts, so that it can be sent between processes."""


class Result(NamedTuple):
    """A study that is complete."""

    #: The summary, as ``camgen study --json`` prints it.
    summary: dict[str, Any]
    #: The files written.
    files: list[pathlib.Path]
    #: The shards: first row, row after the last, SHA-256, bytes, seconds, worker.
    shards: list[dict[str, Any]]
    #: The workers that were refused, and why.
    refused: dict[str, str]


def _worker() -> tuple[str, int]:
    """The name of this worker, and its threads."""
    try:
        worker: Any = import_module("distributed").get_worker()
        return str(worker.address), int(worker.state.nthreads)
    except (ImportError, ValueError):
        return f"{socket.gethostname()}:{os.getpid()}", 1


#: The study that this process has read last, by its digest.
_READ: dict[str, Study] = {}


def _study(source: tuple[Optional[str], str, str], digest: str) -> Study:
    """The study of a file, or of a text; read again where another one is wanted, so that a worker outlives a change of the file."""
    study = _READ.get(digest)
    if study is None:
        path, text, name = source
        study = Study.from_toml(text, name=name) if path is None else Study.load(path)
        _READ.clear()
        _READ[study.digest] = study
    return study


def _filesystem(place: str) -> tuple[Any, str]:
    """The file system of a place by fsspec, and the place on it; None for a folder of this machine without fsspec."""
    if "://" not in place:
        return None, place
    try:
        fsspec: Any = import_module("fsspec")
    except ImportError as error:
        raise StudyRunError(f"the place {place} needs the package fsspec: pip install fsspec") from error
    found: tuple[Any, str] = fsspec.core.url_to_fs(place)
    return found


def _write(place: str, name: str, data: bytes, alone: bool = False) -> None:
    """Writes a file whole or not at all."""
    system, folder = _filesystem(place)
    if system is None:
        write_shard(folder, name, data, alone)
        return
    system.makedirs(folder, exist_ok=True)
    # An object is there when its upload ends; on other file systems a rename puts it in place.
    temporary = f"{folder}/{name}.{socket.gethostname()}.{os.getpid()}.tmp"
    with system.open(temporary, "wb") as file:
        file.write(data)
    system.mv(temporary, f"{folder}/{name}")


def _read(place: str, name: str) -> Optional[bytes]:
    """The bytes of a file; None where there is none."""
    system, folder = _filesystem(place)
    try:
        if system is not None:
            data: bytes = system.cat_file(f"{folder}/{name}")
            return data
        path = os.path.join(folder, name)
        if not stat.S_ISREG(os.lstat(path).st_mode):
            # A link may lead anywhere, and opening a pipe may never end.
            raise StudyRunError(f"{path} is not a regular file: remove it, or give another place with shards=")
        with open(path, "rb") as file:
            return file.read()
    except (FileNotFoundError, NotADirectoryError):
        return None


def _name(start: int) -> str:
    return f"rows-{start:015d}.csv"


def _kept(place: str) -> Optional[dict[str, Any]]:
    """The manifest of a place; None where there is none yet."""
    data = _read(place, MANIFEST)
    if data is None:
        return None
    try:
        kept = json.loads(data)
        shards = [{**shard, "start": int(shard["start"]), "end": int(shard["end"]), "sha256": str(shard["sha256"])} for shard in kept["shards"]]
        found: dict[str, Any] = {"digest": str(kept["digest"]), "size": int(kept["size"]), "shards": shards}
    except (ValueError, KeyError, TypeError) as error:
        what = f"{place}/{MANIFEST} is damaged, or is not the manifest of a study ({type(error).__name__}: {error})"
        raise StudyRunError(f"{what}: remove it with its shards, or give another place with shards=") from error
    if found["size"] < 1:
        raise StudyRunError(f"{place}/{MANIFEST} has shards of {found['size']} designs: remove it with its shards, or give another place with shards=")
    return found


def _refuse_strangers(place: str) -> None:
    """Refuses a folder without a manifest in which there are files with names of shards: they are not of a study."""
    system, folder = _filesystem(place)
    if system is None and os.path.isdir(folder):
        strangers = sorted(name for name in os.listdir(folder) if name.startswith("rows-") and name.endswith(".csv"))
        if strangers:
            raise StudyRunError(f"{folder} has {strangers[0]} and no {MANIFEST}: give another place with shards=")


def _shard(source: tuple[Optional[str], str, str], expected: tuple[str, str], stretch: tuple[int, int], place: str) -> dict[str, Any]:
    """Makes and writes the rows of a shard; runs on a worker."""
    worker, threads = _worker()
    os.environ.setdefault("RAYON_NUM_THREADS", str(threads))
    version, digest = expected
    if __version__ != version:
        raise WorkerMismatch(worker, f"it has camgen {__version__}, and the study is run by {version}")
    try:
        study = _study(source, digest)
    except CamgenError as error:
        raise WorkerMismatch(worker, f"it cannot read the study: {error}") from error
    if study.digest != digest:
        raise WorkerMismatch(worker, "the study or its base is another one there")
    start, end = stretch
    began = time.perf_counter()
    data = study.rows(start, end)
    seconds = time.perf_counter() - began
    _write(place, _name(start), data)
    return {
        "start": start,
        "end": end,
        "sha256": hashlib.sha256(data).hexdigest(),
        "bytes": len(data),
        "seconds": seconds,
        "worker": worker,
    }


def _size(study: Study) -> int:
    """Designs of a shard, by the measured cost of a row."""
    count = len(study)
    step = max(1, count // MEASURED)
    began = time.perf_counter()
    rows = range(0, count, step)
    for row in rows:
        study.rows(row, row + 1)
    seconds = (time.perf_counter() - began) / max(1, len(rows))
    return max(FEWEST, math.ceil(SECONDS / max(seconds, 1e-9)))


class _Manifest:
    """The shards that are done."""

    def __init__(self, study: Study, place: str, size: Optional[int]) -> None:
        self.place = place
        self.digest = study.digest
        self.saved = -math.inf
        self.shards: dict[int, dict[str, Any]] = {}
        kept = _kept(place)
        if kept is None:
            _refuse_strangers(place)
        elif kept["digest"] == study.digest:
            size = kept["size"]
            for shard in kept["shards"]:
                data = _read(place, _name(shard["start"]))
                if data is not None and hashlib.sha256(data).hexdigest() == shard["sha256"]:
                    self.shards[shard["start"]] = shard
        self.size = size or _size(study)
        self.stretches = [(start, min(start + self.size, len(study))) for start in range(0, len(study), self.size)]

    def missing(self) -> list[tuple[int, int]]:
        return [stretch for stretch in self.stretches if stretch[0] not in self.shards]

    def add(self, shard: dict[str, Any]) -> None:
        self.shards[shard["start"]] = shard
        if time.monotonic() - self.saved >= BETWEEN_SAVES:
            self.save()

    def save(self, alone: bool = False) -> None:
        shards = [self.shards[start] for start in sorted(self.shards)]
        data = {"schema": 1, "camgen": __version__, "digest": self.digest, "size": self.size, "shards": shards}
        try:
            _write(self.place, MANIFEST, json.dumps(data, indent=1).encode(), alone)
        except OSError as error:
            raise StudyRunError(f"cannot write the manifest to {self.place}: {error}; make room and run again: what is done is kept") from error
        self.saved = time.monotonic()

    def proved(self) -> Iterator[bytes]:
        """The bytes of the shards in their order, each as its hash says: every row once."""
        for start, end in self.stretches:
            shard, data = self.shards[start], _read(self.place, _name(start))
            if data is None or hashlib.sha256(data).hexdigest() != shard["sha256"] or data.count(b"\n") != end - start:
                raise StudyRunError(f"the shard {_name(start)} in {self.place} was changed: remove it and run again")
            yield data


def _told(stretch: tuple[int, int], error: BaseException, place: str) -> StudyRunError:
    text = f"rows {stretch[0]} to {stretch[1] - 1}: {error}"
    if isinstance(error, OSError):
        text = f"rows {stretch[0]} to {stretch[1] - 1} cannot be written to {place}: {error}; make room and run again: what is done is kept"
    return StudyRunError(text)


def _end_with_parent() -> None:
    """Ends this worker when the process that started it has ended, even if that was killed."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_wait_and_end, args=(parent,), daemon=True).start()


def _wait_and_end(parent: Any) -> None:
    parent.join()
    os._exit(1)


def _on_processes(manifest: _Manifest, job: Callable[..., Any], workers: Optional[int], told: Callable[[int, int], None]) -> None:
    """The missing shards, on processes of this machine."""
    missing = manifest.missing()
    # A fresh interpreter: threads of this one are not copied.
    with ProcessPoolExecutor(workers or os.cpu_count(), mp_context=get_context("spawn"), initializer=_end_with_parent) as pool:
        pending: dict[Future[Any], tuple[int, int]] = {pool.submit(job, stretch): stretch for stretch in missing}
        while pending:
            for future in wait(pending, return_when=FIRST_COMPLETED).done:
                stretch = pending.pop(future)
                try:
                    manifest.add(future.result())
                except Exception as error:
                    pool.shutdown(wait=False, cancel_futures=True)
                    raise _told(stretch, error, manifest.place) from error
                told(len(manifest.shards), len(manifest.stretches))


def _version() -> str:
    return __version__


def _on_cluster(client: Any, manifest: _Manifest, job: Callable[..., Any], told: Callable[[int, int], None]) -> dict[str, str]:
    """The missing shards, on the workers of a Dask scheduler. Returns the workers that were refused."""
    as_completed: Any = import_module("distributed").as_completed
    refused: dict[str, str] = {}
    for worker, version in client.run(_version, on_error="return").items():
        if version != __version__:
            refused[worker] = f"it has camgen {version!r}, and the study is run by {__version__!r}"
    if refused and not set(client.scheduler_info(n_workers=-1)["workers"]) - set(refused):
        raise StudyRunError("every worker is refused: " + "; ".join(f"{worker}: {why}" for worker, why in refused.items()))

    def submit(stretch: tuple[int, int]) -> Any:
        if not refused:
            return client.submit(job, stretch, pure=False)
        able = [worker for worker in client.scheduler_info(n_workers=-1)["workers"] if worker not in refused]
        return client.submit(job, stretch, pure=False, workers=able, allow_other_workers=False)

    tries = {stretch[0]: 0 for stretch in manifest.missing()}
    pending = {submit(stretch): stretch for stretch in manifest.missing()}
    queue = as_completed(list(pending))
    for future in queue:
        stretch = pending.pop(future)
        error = future.exception()
        if error is None:
            manifest.add(future.result())
            told(len(manifest.shards), len(manifest.stretches))
            continue
        if isinstance(error, WorkerMismatch):
            worker, why = error.args
            refused[worker] = why
        tries[stretch[0]] += 1
        lost = isinstance(error, WorkerMismatch) or type(error).__name__ in ("KilledWorker", "CommClosedError", "FutureCancelledError")
        if not lost or tries[stretch[0]] > RETRIES:
            client.cancel(list(pending))
            raise _told(stretch, error, manifest.place) from error
        again = submit(stretch)
        pending[again] = stretch
        queue.add(again)
    return refused


def run(
    study: _Path,
    client: Any = None,
    *,
    out: _Path = "output",
    name: Optional[str] = None,
    shards: Optional[str] = None,
    size: Optional[int] = None,
    workers: Optional[int] = None,
    page: bool = False,
    overwrite: bool = False,
    progress: Optional[Callable[[int, int], None]] = None,
) -> Result:
    """Runs a study file (or an embedded study) on the workers of ``client``, a ``distributed.Client``, or on ``workers`` local processes.

    ``shards`` is the place of the shards, which every worker must reach: a folder, or an address of fsspec (``s3://…``); by default
    ``OUT/NAME-shards``. ``size`` is the number of designs of a shard, by default what takes some ten seconds, and at least 1000. The study
    file and its base must be found by every worker under the same path; a study of an embedded base is sent as it is. ``progress`` is
    called with the number of shards that are done and of all.

    Raises MachineError for a study file with faults, StudyRunError for a study that cannot go on.
    """
    path: Optional[str] = os.fspath(study)
    loaded = Study.load(os.fspath(study))
    text = ""
    if os.path.exists(os.fspath(study)):
        text = pathlib.Path(study).read_text("utf-8")
        try:
            # Without its folder it is the same study: it can be sent to workers that do not have the file.
            alone = Study.from_toml(text, name=loaded.stem).digest == loaded.digest
        except CamgenError:
            alone = False
        path = None if alone else os.path.abspath(os.fspath(study))
    stem = loaded.file_stem(name)
    place = shards or os.path.join(os.path.abspath(os.fspath(out)), f"{stem}-shards")
    manifest = _Manifest(loaded, place, size)
    # From now on the place is known as one of this study, whatever happens to this process; what a killed one left half written is removed.
    manifest.save(alone=True)
    source = (path, text, loaded.stem)
    job = functools.partial(_job, source, (__version__, loaded.digest), place)
    told = progress or (lambda _done, _all: None)
    refused: dict[str, str] = {}
    try:
        if client is None:
            _on_processes(manifest, job, workers, told)
        else:
            refused = _on_cluster(client, manifest, job, told)
    except BaseException:
        # What is done is kept, and the first error is the one that is told.
        with contextlib.suppress(StudyRunError):
            manifest.save()
        raise
    manifest.save()
    summary, files = loaded.collect(manifest.proved(), out, name=name, page=page, overwrite=overwrite)
    done = [manifest.shards[start] for start, _ in manifest.stretches]
    return Result(json.loads(summary), [pathlib.Path(file) for file in files], done, refused)


def _job(source: tuple[Optional[str], str, str], expected: tuple[str, str], place: str, stretch: tuple[int, int]) -> dict[str, Any]:
    return _shard(source, expected, stretch, place)
