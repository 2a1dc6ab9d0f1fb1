"""Studies from Python: the bytes of the command line, on processes and on a Dask cluster with a real scheduler and workers over TCP."""

import json
import os
import pathlib
import signal
import subprocess
import sys
import time

import pytest

import camgen
from camgen import study as studies

STUDY = """
name = "shards"
base = "feeder"
kind = "monte-carlo"
rows = 3000
set = ["cam.base_radius=60mm"]
columns = ["cam.prime_radius_mm", "checks.pressure_angle.value"]
[[parameter]]
key = "follower.roller.radius"
from = "-1 mm"
to = "20 mm"
[[constraint]]
column = "checks.pressure_angle.value"
at_most = 16
"""


@pytest.fixture
def whole(tmp_path, program):
    """The study file, and the table and summary of the command line."""
    path = tmp_path / "shards.toml"
    path.write_text(STUDY, "utf-8")
    program("study", path, "--quiet", "--out", tmp_path / "whole", cwd=tmp_path, expected=(0,))
    return path, (tmp_path / "whole" / "shards.csv").read_bytes(), (tmp_path / "whole" / "shards.json").read_bytes()


def written(result, whole):
    """The files of a run are those of the command line; every row is in one shard."""
    path, table, summary = whole
    by_ending = {file.suffix: file.read_bytes() for file in result.files}
    assert by_ending[".csv"] == table
    assert by_ending[".json"] == summary
    assert result.summary == json.loads(summary)
    ends = [(shard["start"], shard["end"]) for shard in result.shards]
    assert ends[0][0] == 0 and ends[-1][1] == 3000
    assert all(a[1] == b[0] for a, b in zip(ends, ends[1:]))


def test_rows_are_those_of_the_command_line(whole):
    path, table, _ = whole
    study = camgen.Study.load(path)
    assert len(study) == 3000 and study.kind == "monte-carlo" and not study.proves
    assert study.header + study.rows(0, 7) + study.rows(7, 3000) == table
    overrides, rpm = study.design(5)
    assert overrides[0] == "cam.base_radius=60mm" and overrides[1].startswith("follower.roller.radius=") and rpm is None
    with pytest.raises(camgen.OptionError):
        study.rows(0, 3001)


def test_faults_of_a_study_file_have_their_places(tmp_path):
    with pytest.raises(camgen.MachineError) as raised:
        camgen.Study.from_toml(STUDY.replace("rows = 3000", "row = 3000"), name="mine.toml")
    assert any(fault.place and fault.place.startswith("mine.toml:5:") for fault in raised.value.faults)


def test_collect_wants_every_row_once(whole, tmp_path):
    study = camgen.Study.load(whole[0])
    for stretches in ([study.rows(0, 10)], [study.rows(0, 10), study.rows(11, 3000)], [study.rows(0, 10), study.rows(0, 3000)]):
        with pytest.raises(camgen.OptionError):
            study.collect(stretches, tmp_path / "out")
        assert not (tmp_path / "out" / "shards.csv").exists()


def test_local_processes_and_a_stopped_run(whole, tmp_path):
    result = studies.run(whole[0], out=tmp_path / "out", workers=2, size=1000)
    written(result, whole)
    # Without one shard, and with a changed one, both are made again.
    folder = tmp_path / "out" / "shards-shards"
    (folder / "rows-000000000001000.csv").unlink()
    (folder / "rows-000000000002000.csv").write_bytes(b"wrong\n")
    done = []
    result = studies.run(whole[0], out=tmp_path / "out", workers=1, progress=lambda *counts: done.append(counts))
    assert done == [(2, 3), (3, 3)]
    written(result, whole)


def test_a_place_that_cannot_be_written_is_told(whole, tmp_path):
    folder = tmp_path / "file"
    folder.write_text("")
    with pytest.raises(studies.StudyRunError, match="cannot write the manifest to .*shards") as raised:
        studies.run(whole[0], out=tmp_path / "out", shards=str(folder / "shards"), size=1000, workers=1)
    assert "run again" in str(raised.value)


@pytest.fixture
def cluster(tmp_path):
    """A scheduler, and a function that starts a worker over TCP."""
    distributed = pytest.importorskip("distributed")
    processes = []
    environment = {**os.environ, "DASK_DISTRIBUTED__COMM__TIMEOUTS__CONNECT": "60s"}
    log = (tmp_path / "cluster.log").open("wb")

    def start(*words, **more):
        process = subprocess.Popen([sys.executable, "-m", *words], cwd=tmp_path, env={**environment, **more}, stdout=log, stderr=log)
        processes.append(process)
        return process

    place = tmp_path / "scheduler.json"
    start("distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--scheduler-file", str(place))
    began = time.monotonic()
    while not place.exists():
        assert time.monotonic() - began < 60, (tmp_path / "cluster.log").read_text()
        time.sleep(0.1)

    def worker(**more):
        return start("distributed.cli.dask_worker", "--scheduler-file", str(place), "--nworkers", "1", "--nthreads", "1", "--no-nanny",
                     "--no-dashboard", "--host", "127.0.0.1", **more)

    client = distributed.Client(scheduler_file=str(place), timeout=60)
    yield client, worker
    client.close()
    for process in processes:
        process.kill()
        process.wait()
    log.close()


def test_a_cluster_loses_a_worker_and_gains_one(whole, cluster, tmp_path):
    client, worker = cluster
    workers = [worker() for _ in range(3)]
    client.wait_for_workers(3, timeout=60)
    seen = []

    def progress(done, count):
        seen.append((done, count))
        if done == 2:
            os.kill(workers[0].pid, signal.SIGKILL)
            worker()

    result = studies.run(whole[0], client, out=tmp_path / "out", size=200, progress=progress)
    assert seen[-1] == (15, 15) and result.refused == {}
    written(result, whole)
    assert len({shard["worker"] for shard in result.shards}) > 1
    kept = json.loads((tmp_path / "out" / "shards-shards" / "manifest.json").read_text("utf-8"))
    assert [shard["start"] for shard in kept["shards"]] == list(range(0, 3000, 200))


def test_a_worker_outlives_a_change_of_the_base(cluster, program, tmp_path):
    client, worker = cluster
    worker()
    client.wait_for_workers(1, timeout=60)
    base = (pathlib.Path(__file__).parents[2] / "crates" / "cams" / "profiles" / "feeder.toml").read_text("utf-8")
    path = tmp_path / "own.toml"
    path.write_text(STUDY.replace('"feeder"', '"base.toml"').replace("rows = 3000", "rows = 40"), "utf-8")
    tables = []
    for name in ("Feeder", "Another"):
        (tmp_path / "base.toml").write_text(base.replace('name = "Feeder"', f'name = "{name}"'), "utf-8")
        program("study", path, "--quiet", "--overwrite", "--restart", "--out", tmp_path / "whole", cwd=tmp_path)
        result = studies.run(path, client, out=tmp_path / f"out-{name}", size=20)
        assert result.files[0].read_bytes() == (tmp_path / "whole" / "own.csv").read_bytes() and result.refused == {}
        tables.append(result.summary)
    assert tables[0] != tables[1]


OTHER = """
import sys
import camgen, camgen._camgen
camgen.__version__ = camgen._camgen.__version__ = "0.0.0"
import camgen.study
camgen.study.__version__ = "0.0.0"
from distributed.cli.dask_worker import main
sys.argv[0] = "dask-worker"
main()
"""


def test_a_worker_of_another_version_is_refused_and_named(whole, cluster, tmp_path):
    client, worker = cluster
    module = tmp_path / "other_worker.py"
    module.write_text(OTHER, "utf-8")
    own = worker()
    client.wait_for_workers(1, timeout=60)
    address = next(iter(client.scheduler_info(n_workers=-1)["workers"]))
    place = str(tmp_path / "scheduler.json")
    other = subprocess.Popen([sys.executable, str(module), "--scheduler-file", place, "--nthreads", "1", "--no-nanny", "--no-dashboard",
                              "--host", "127.0.0.1"], cwd=tmp_path, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        client.wait_for_workers(2, timeout=60)
        result = studies.run(whole[0], client, out=tmp_path / "out", size=500)
        assert len(result.refused) == 1 and address not in result.refused
        assert "0.0.0" in next(iter(result.refused.values()))
        assert {shard["worker"] for shard in result.shards} == {address}
        written(result, whole)
        os.kill(own.pid, signal.SIGKILL)
        began = time.monotonic()
        while len(client.scheduler_info(n_workers=-1)["workers"]) > 1 and time.monotonic() - began < 60:
            time.sleep(0.1)
        with pytest.raises(studies.StudyRunError, match="0.0.0"):
            studies.run(whole[0], client, out=tmp_path / "again", size=500)
    finally:
        other.kill()
        other.wait()


@pytest.mark.parametrize("text", ["", "{", "[]", "null", "{}", '{"digest": 1, "size": "x", "shards": []}', '{"digest": "a", "size": 5, "shards": [{}]}',
                                  '{"name": "an app", "start_url": "/"}'])
def test_a_manifest_that_is_none_is_told_and_kept(whole, tmp_path, text):
    place = tmp_path / "place"
    place.mkdir()
    (place / "manifest.json").write_text(text)
    with pytest.raises(studies.StudyRunError, match="manifest.json is damaged, or is not the manifest of a study"):
        studies.run(whole[0], out=tmp_path / "out", shards=str(place), size=1000, workers=1)
    assert (place / "manifest.json").read_text() == text and len(list(place.iterdir())) == 1


def test_a_manifest_that_was_cut_off_is_told(whole, tmp_path):
    studies.run(whole[0], out=tmp_path / "out", workers=1, size=1500)
    path = tmp_path / "out" / "shards-shards" / "manifest.json"
    data = path.read_bytes()
    for length in range(0, len(data) - 1, 40):
        path.write_bytes(data[:length])
        with pytest.raises(studies.StudyRunError, match="is damaged"):
            studies.run(whole[0], out=tmp_path / "out", workers=1)
        assert path.read_bytes() == data[:length]


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="links and pipes of Unix")
@pytest.mark.parametrize("kind", ["link", "dangling", "pipe", "directory", "file"])
@pytest.mark.parametrize("name", ["manifest.json", "rows-000000000000000.csv", "rows-000000000001500.csv"])
def test_what_a_user_has_in_the_place_of_shards_stays(whole, tmp_path, kind, name):
    place, victim = tmp_path / "place", tmp_path / "victim"
    place.mkdir()
    victim.write_text("mine\n")
    path = place / name
    {"link": lambda: path.symlink_to(victim), "dangling": lambda: path.symlink_to(tmp_path / "none"), "pipe": lambda: os.mkfifo(path),
     "directory": path.mkdir, "file": lambda: path.write_text("mine\n")}[kind]()
    before = os.lstat(path).st_ino
    with pytest.raises(studies.StudyRunError):
        studies.run(whole[0], out=tmp_path / "out", shards=str(place), size=1500, workers=1)
    assert victim.read_text() == "mine\n" and os.lstat(path).st_ino == before and not (tmp_path / "none").exists()
    assert list(place.iterdir()) == [path]


PARENT = """
import sys
from camgen import study
if __name__ == "__main__":
    study.run(sys.argv[1], out=sys.argv[2], size=1000, workers=4, progress=lambda done, count: print(done, flush=True))
"""


def test_workers_end_with_their_parent(whole, tmp_path):
    """Killed, the parent can tell its workers nothing: they notice it, and the next run finishes."""
    psutil = pytest.importorskip("psutil")
    module, path = tmp_path / "parent.py", tmp_path / "long.toml"
    module.write_text(PARENT, "utf-8")
    path.write_text(STUDY.replace("rows = 3000", "rows = 200000"), "utf-8")
    parent = subprocess.Popen([sys.executable, str(module), str(path), str(tmp_path / "long")], stdout=subprocess.PIPE)
    assert parent.stdout is not None and parent.stdout.readline()
    children = psutil.Process(parent.pid).children(recursive=True)
    assert len(children) >= 4
    parent.kill()
    parent.wait()
    _, alive = psutil.wait_procs(children, timeout=10)
    assert not alive, [process.cmdline() for process in alive]


def test_a_base_elsewhere_is_refused(tmp_path):
    secret = tmp_path / "secret"
    secret.write_text("root:x:secret:0\n")
    folder = tmp_path / "folder"
    folder.mkdir()
    path = folder / "study.toml"
    path.write_text(STUDY.replace('"feeder"', f'"{secret}"'), "utf-8")
    with pytest.raises(camgen.MachineError) as raised:
        camgen.Study.load(path)
    assert "root:x" not in str(raised.value) and "lies outside of the folder" in str(raised.value)
    with pytest.raises(camgen.MachineError):
        camgen.Study.from_toml(STUDY.replace('"feeder"', f'"{secret}"'))


@pytest.mark.parametrize("name", ["../x", "a/b", ".x", ""])
def test_a_name_that_files_cannot_have_is_refused_before_the_work(whole, tmp_path, name):
    with pytest.raises(camgen.OptionError):
        studies.run(whole[0], out=tmp_path / "out" / "deep", name=name)
    assert not (tmp_path / "out").exists() and not (tmp_path / "x-shards").exists()
