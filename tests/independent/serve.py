"""A hostile client for `camgen serve`: nothing is read, written or hung, and only the page itself is answered.

Wrong and missing tokens, other hosts and origins, paths that climb, methods and heads that are not HTTP, bodies that are huge, slow, shorter or
longer than they say, 200 connections at a time: none gets more than a refusal, the files of the directory stay as they are, and the page answers
as before. Then what the page may do: the engine's answer has the bytes of the command line's files, the machine file is written with its comments
and not over somebody else's change, files are written all or none, and the program listens on the loopback address alone. It is killed at random
moments of a save and at the calls of the system that save: the file has the old text or the new one, and the next save finds nothing in its way.
The long run is --requests 100000 --kills 200.

usage: serve.py CAMGEN_BINARY DIRECTORY [--requests N] [--kills N]
"""
import argparse
import hashlib
import http.client
import json
import os
import random
import re
import shutil
import signal
import socket
import stat
import struct
import subprocess
import threading
import time
from pathlib import Path

DESIGN = "feeder"
LONGEST = 12.0


class Program:
    """A running `camgen serve`."""

    def __init__(self, binary, directory, *words, prefix=()):
        self.process = subprocess.Popen([*prefix, binary, "serve", *words], cwd=directory, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                        start_new_session=True)
        address = self.process.stdout.readline().strip()
        self.port, self.token = re.fullmatch(r"http://127\.0\.0\.1:(\d+)/\?token=([0-9a-f]{32})", address).groups()
        self.port, self.host, self.address = int(self.port), f"127.0.0.1:{self.port}", address

    def ask(self, method, path, body=None, **headers):
        """Status and body; headers by their names with underscores, None leaves one out."""
        sent = {"Host": self.host, "X-Camgen-Token": self.token, "Origin": f"http://{self.host}"}
        sent.update({name.replace("_", "-"): value for name, value in headers.items()})
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        connection.putrequest(method, path, skip_host=True, skip_accept_encoding=True)
        for name, value in sent.items():
            if value is not None:
                connection.putheader(name, value)
        if body is not None:
            connection.putheader("Content-Length", str(len(body)))
        connection.endheaders()
        if body is not None:
            try:
                connection.send(body)
            except (BrokenPipeError, ConnectionResetError):
                pass
        try:
            answer = connection.getresponse()
            return answer.status, answer.read()
        except (http.client.HTTPException, ConnectionError):
            return 0, b""
        finally:
            connection.close()

    def posted(self, path, **body):
        return json.loads(self.ask("POST", path, json.dumps(body).encode())[1] or b"null")

    def kill(self):
        """Kills it, whatever it does."""
        os.killpg(self.process.pid, signal.SIGKILL)
        self.process.communicate()

    def raw(self, data, wait=LONGEST):
        """What comes of raw bytes, and how long it takes until the connection ends."""
        begin, found = time.time(), b""
        with socket.create_connection(("127.0.0.1", self.port), timeout=wait) as stream:
            try:
                stream.sendall(data)
                while part := stream.recv(1 << 16):
                    found += part
            except (ConnectionError, socket.timeout):
                pass
        return found, time.time() - begin

    def engine(self, **request):
        status, body = self.ask("POST", "/engine", json.dumps(request).encode())
        assert status == 200, (status, body[:200])
        (length,) = struct.unpack("<I", body[:4])
        answer, at = json.loads(body[4 : 4 + length]), 4 + length
        for file in answer["files"]:
            file["bytes"], at = body[at : at + file["size"]], at + file["size"]
        return answer

    def end(self):
        self.process.terminate()
        self.process.wait(10)
        return self.process.stderr.read()


def digests(directory):
    return {str(path.relative_to(directory)): hashlib.sha256(path.read_bytes()).hexdigest() for path in sorted(directory.rglob("*")) if path.is_file()}


def wrong_requests(generator, token, host):
    """One hostile request: method, path, body, headers."""
    letters = "0123456789abcdef"
    other = "".join(generator.choice(letters) for _ in range(32))
    body = json.dumps({"name": "x", "toml": "", "formats": ["dxf"]}).encode()
    path = generator.choice(["/engine", "/files", "/save", "/write", "/"])
    climbing = generator.choice(["/../secret.txt", "/..%2f..%2fetc/passwd", "//etc/passwd", "/engine/../../secret.txt", "/%2e%2e/secret.txt", "/secret.txt", "http://evil.example/", "*"])
    return generator.choice([
        ("POST", path, body, {"X_Camgen_Token": None}),
        ("POST", path, body, {"X_Camgen_Token": other}),
        ("POST", path, body, {"X_Camgen_Token": token[:-1]}),
        ("POST", path, body, {"X_Camgen_Token": token + "0"}),
        ("POST", path, body, {"Host": generator.choice(["evil.example", f"evil.example:{host.split(':')[1]}", "127.0.0.1", "0.0.0.0:80", "[::1]:80", ""])}),
        ("POST", path, body, {"Host": None}),
        ("POST", path, body, {"Origin": generator.choice(["http://evil.example", "null", "https://" + host, "http://localhost", "http://" + host + ".evil.example", ""])}),
        ("GET", "/?token=" + other, None, {}),
        ("GET", "/", None, {}),
        ("GET", "/engine?token=" + token, None, {}),
        ("GET", climbing + "?token=" + token, None, {}),
        ("POST", climbing, body, {}),
        (generator.choice(["PUT", "DELETE", "OPTIONS", "TRACE", "CONNECT", "PATCH", "HEAD"]), path, None, {}),
    ])


def refuses(program, count, generator):
    """Nothing but refusals for a client without the token, of another host or origin, or for another path."""
    statuses = {}
    for _ in range(count):
        method, path, body, headers = wrong_requests(generator, program.token, program.host)
        status, answer = program.ask(method, path, body, **headers)
        assert status in (0, 400, 403, 404, 405, 411), (method, path, headers, status, answer[:200])
        assert program.token.encode() not in answer and b"secret" not in answer and len(answer) < 200, (method, path, answer[:200])
        statuses[status] = statuses.get(status, 0) + 1
    return statuses


def bounded(program):
    """Bodies and heads that are too large, not what they say, slow, or not HTTP: each connection ends in time."""
    head = f"POST /engine HTTP/1.1\r\nHost: {program.host}\r\nX-Camgen-Token: {program.token}\r\n"
    longest = 0.0
    for data, status in [
        (f"{head}Content-Length: 1000000000\r\n\r\n".encode() + b"x" * 100_000, b"413"),
        (f"{head}Content-Length: 99999999999999999999999999\r\n\r\n".encode(), b"413"),
        (f"{head}Content-Length: -1\r\n\r\n".encode(), b"400"),
        (f"{head}Content-Length: 5\r\nContent-Length: 6\r\n\r\nabcdef".encode(), b"400"),
        (f"{head}Transfer-Encoding: chunked\r\n\r\n5\r\nabcde\r\n0\r\n\r\n".encode(), b"411"),
        (f"{head}Content-Length: 2\r\n\r\n{{}}GET / HTTP/1.1\r\n\r\n".encode(), b"400"),
        (head.encode() + b"X: " + b"y" * 100_000, b"431"),
        (head.encode() + b"X: " + b"y" * 20_000 + b"\r\nContent-Length: 2\r\n\r\n{}", b"431"),
        (head.encode() + b"X: " + b"y" * 16_384 + b"\r\n\r\n", b"431"),
        (head.encode() + b"X: " + b"y" * 16_000 + b"\r\nContent-Length: 2\r\n\r\n{}", b"200"),
        (head.encode() + b"A: b\r\n" * 200 + b"\r\n", b"400"),
        (b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + bytes(200) + b"\r\n\r\n", b"400"),
        (f"{head}Content-Length: 100\r\n\r\nshort".encode(), b""),
        (b"", b""),
        (b"GET", b""),
    ]:
        found, seconds = program.raw(data)
        longest = max(longest, seconds)
        assert found.startswith(b"HTTP/1.1 " + status) if status else found == b"", (data[:200], found[:200])
        assert seconds < LONGEST, (data[:100], seconds)
    return longest


def slow(program):
    """A body that comes a byte at a time ends with its time, however steadily it comes."""
    begin = time.time()
    with socket.create_connection(("127.0.0.1", program.port), timeout=LONGEST) as stream:
        try:
            stream.sendall(f"POST /engine HTTP/1.1\r\nHost: {program.host}\r\nX-Camgen-Token: {program.token}\r\nContent-Length: 1000\r\n\r\n".encode())
            for _ in range(1000):
                stream.sendall(b" ")
                time.sleep(0.1)
                if time.time() - begin > LONGEST:
                    raise AssertionError("a slow body is waited for")
        except ConnectionError:
            pass
    return time.time() - begin


def crowded(program):
    """200 connections that say nothing: the rest of the world is answered when they have had their time."""
    streams = [socket.create_connection(("127.0.0.1", program.port), timeout=LONGEST) for _ in range(200)]
    begin = time.time()
    while time.time() - begin < LONGEST:
        status, _ = program.ask("POST", "/files", b"{}")
        if status == 200:
            break
        time.sleep(0.1)
    seconds = time.time() - begin
    for stream in streams:
        stream.close()
    assert status == 200, "200 connections hang the program"
    return seconds


def idle(program):
    """All connections are in use and none sends a request: the page is still answered at once."""
    streams = [socket.create_connection(("127.0.0.1", program.port), timeout=LONGEST) for _ in range(32)]
    time.sleep(0.2)
    begin = time.time()
    status, _ = program.ask("POST", "/files", b"{}")
    seconds = time.time() - begin
    for stream in streams:
        stream.close()
    assert status == 200 and seconds < 2.0, f"32 idle connections: {status} after {seconds:.1f} s"


def unreadable(program, path, text):
    """Text that could not be read again is not saved, and a file replaced by a link is neither read nor written through it."""
    kept = path.read_bytes()
    for toml in ("", " \n", "a = 1\n", text + "#" + "x" * (2 << 20) + "\n", text.replace("[cam]", "[cams]"), "name = ", text + "\x00", "[]", text[: len(text) // 2]):
        done = program.posted("/save", design=0, toml=toml, before=text)
        assert "faults" in done and path.read_bytes() == kept, (toml[:60], done)
    changed = text.replace('name = "Feeder"', 'name = "Changed"')
    victim = path.with_name("victim.toml")
    victim.write_text(text)
    for there in (victim, Path("/etc/hostname"), path.with_name("nothing")):
        path.unlink()
        path.symlink_to(there)
        done = program.posted("/save", design=0, toml=changed, before=text)
        assert "faults" in done and victim.read_text() == text and path.is_symlink(), done
        found = program.posted("/files")["designs"][0]
        assert "fault" in found and "toml" not in found, found
    path.unlink()
    for make in (lambda: os.mkfifo(path), path.mkdir):
        make()
        assert "faults" in program.posted("/save", design=0, toml=changed, before=text)
        assert "fault" in program.posted("/files")["designs"][0]
        path.rmdir() if path.is_dir() else path.unlink()
    path.write_bytes(kept)
    victim.unlink()
    assert "written" in program.posted("/save", design=0, toml=text, before=text)


def saves_killed(binary, directory, count, seed):
    """Kills at random moments of a save, and at each of its calls; returns the number of kills, and the calls of a save."""
    where = directory / "kills"
    where.mkdir()
    path = where / "own.toml"
    texts = [(directory / "own.toml").read_text().replace('name = "Feeder"', f'name = "Number {number}"') for number in (0, 1)]
    path.write_text(texts[0])
    path.chmod(0o600)

    def saved(program, old):
        """Asks for the other text; after a kill the file is the old text or the new one, with no remains that the next save does not remove."""
        try:
            program.ask("POST", "/save", json.dumps({"design": 0, "toml": texts[1 - old], "before": texts[old]}).encode())
        except OSError:
            pass

    def judged(what):
        there = path.read_text()
        assert there in texts and stat.S_IMODE(path.stat().st_mode) == 0o600, f"{what}: {len(there)} bytes, {path.stat().st_mode:o}"
        old = texts.index(there)
        for one in where.iterdir():
            assert stat.S_IMODE(one.stat().st_mode) & 0o077 == 0 or one.is_dir(), f"{what}: {one.name} is readable to others"
        again = Program(binary, where, "own.toml")
        try:
            done = again.posted("/save", design=0, toml=texts[1 - old], before=texts[old])
        finally:
            again.kill()
        assert "written" in done and path.read_text() == texts[1 - old], f"{what}: the next save: {done}"
        assert os.listdir(where) == ["own.toml"], f"{what}: the next save leaves {os.listdir(where)}"
        return 1 - old

    chance, old, came = random.Random(seed), 0, 0
    for number in range(count):
        program = Program(binary, where, "own.toml")
        worker = threading.Thread(target=saved, args=(program, old))
        worker.start()
        time.sleep(chance.uniform(0.0, 0.03))
        came += program.process.poll() is None
        program.kill()
        worker.join()
        old = judged(f"killed at random, {number}")
    if shutil.which("strace") is None:
        return came, None
    calls = ("open", "openat", "write", "fsync", "renameat", "unlinkat", "fchmod", "flock", "fchown")
    log = directory / "trace"
    program = Program(binary, where, "own.toml", prefix=["strace", "-f", "-o", str(log), "-e", f"trace={','.join(calls)}"])
    done = program.posted("/save", design=0, toml=texts[1 - old], before=texts[old])
    program.kill()
    assert "written" in done, done
    old = 1 - old
    counts, found, begun = {}, [], False
    for line in log.read_text(errors="replace").splitlines():
        name = line.partition(" ")[2].strip().partition("(")[0]
        if name in calls:
            counts[name] = counts.get(name, 0) + 1
            begun = begun or name == "open" and "O_DIRECTORY" in line
            if begun:
                found.append((name, counts[name]))
                assert "O_CREAT" not in line or "0600" in line, f"it is readable to others before it has its mode: {line}"
    assert found, "the calls of a save are not seen"
    for call, ordinal in found:
        program = Program(binary, where, "own.toml", prefix=["strace", "-f", "-o", os.devnull, "-e", f"trace={call}", "-e", f"inject={call}:signal=KILL:when={ordinal}"])
        saved(program, old)
        program.kill()
        old = judged(f"killed at {call} {ordinal}")
    return came, len(found)


def only_loopback(program):
    """It listens on 127.0.0.1 and on nothing else."""
    listed = Path("/proc/net/tcp").read_text() + Path("/proc/net/tcp6").read_text()
    port = f":{program.port:04X}"
    places = {line.split()[1] for line in listed.splitlines() if line.split()[1].endswith(port) and line.split()[3] == "0A"}
    assert places == {f"0100007F{port}"}, places


def works(program, binary, directory):
    """What the page may do."""
    path = directory / "own.toml"
    text = path.read_text()
    status, page = program.ask("GET", "/?token=" + program.token, X_Camgen_Token=None, Origin=None)
    assert status == 200 and b"<!doctype html>" in page[:40] and program.token.encode() in page
    made = program.engine(name="own", toml=text, formats=["dxf", "svg", "step", "csv"])
    written = subprocess.run([binary, "make", "own.toml", "--name", "own", "--out", "by-command", "--quiet", "--overwrite"], cwd=directory)
    assert written.returncode == 0 and made["passed"] and len(made["files"]) == 5
    for file in made["files"]:
        assert file["bytes"] == (directory / "by-command" / file["name"]).read_bytes(), file["name"]
    # A change keeps the comments, and is written over the text that the page has seen alone.
    changed = program.engine(task="text", toml=text, changes=[{"set": {"key": "cam.thickness", "to": "17 mm"}}])["toml"]
    assert changed == text.replace('thickness = "15 mm"', 'thickness = "17 mm"') != text
    posted = lambda path, **body: json.loads(program.ask("POST", path, json.dumps(body).encode())[1])
    assert "another program has changed the file" in posted("/save", design=0, toml=changed, before="something else")["faults"][0]["message"]
    assert "could not be read again" in posted("/save", design=0, toml="name = ", before=text)["faults"][0]["message"]
    assert path.read_text() == text
    assert "written" in posted("/save", design=0, toml=changed, before=text) and path.read_text() == changed
    assert posted("/files")["designs"][0]["toml"] == changed
    # The mark and the line ends of the file stay; a protected file is not written.
    windows = b"\xef\xbb\xbf" + changed.replace("\n", "\r\n").encode()
    path.write_bytes(windows)
    assert posted("/files")["designs"][0]["toml"] == changed
    assert "written" in posted("/save", design=0, toml=text, before=changed)
    assert path.read_bytes() == b"\xef\xbb\xbf" + text.replace("\n", "\r\n").encode()
    path.chmod(0o444)
    assert "protected" in posted("/save", design=0, toml=changed, before=text)["faults"][0]["message"]
    path.chmod(0o644)
    path.write_text(changed)
    assert "no machine file" in posted("/save", design=7, toml=changed, before=changed)["faults"][0]["message"]
    done = posted("/write", name="own", toml=changed, formats=["dxf", "csv"])
    assert sorted(Path(name).name for name in done["written"]) == ["own.csv", "own.dxf"], done
    # Without a list of formats those that a cam has: the outside of a globoid cannot be developed.
    globoid = subprocess.run([binary, "machines", "show", "indexer"], capture_output=True, text=True).stdout
    done = posted("/write", name="hollow", toml=globoid)
    endings = {Path(name).suffix for name in done["written"]}
    assert ".step" in endings and ".dxf" not in endings, done
    # An edited file is not written over, and then none is.
    (directory / "out" / "own.csv").write_text("mine\n")
    before = digests(directory)
    assert "faults" in posted("/write", name="own", toml=text, formats=["dxf", "csv"]) and digests(directory) == before
    for name in ("../own", "/own", ".own", "a/b", ""):
        assert "faults" in posted("/write", name=name, toml=text, formats=["dxf"]), name
    failing = text.replace('base_radius = "auto"', 'base_radius = "13 mm"').replace('pressure_angle = "30 deg"', 'pressure_angle = "12 deg"')
    assert "faults" in posted("/write", name="failing", toml=failing, formats=["dxf"])
    # A text that names a file reads none.
    table = 'name = "A"\n[motion]\ntable = "secret.csv"\n[follower.roller]\nradius = "5 mm"\n[cam]\n[limits]\n'
    answer = program.engine(name="a", toml=table)
    assert "faults" in answer and "secret" not in json.dumps(answer).replace("secret.csv", ""), answer
    assert digests(directory) == before


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary", type=Path)
    parser.add_argument("directory", type=Path)
    parser.add_argument("--requests", type=int, default=10_000)
    parser.add_argument("--kills", type=int, default=10)
    options = parser.parse_args()
    binary, directory = options.binary.resolve(), (options.directory / "serve").resolve()
    shutil.rmtree(directory, ignore_errors=True)
    directory.mkdir(parents=True)
    (directory / "secret.txt").write_text("secret\n")
    (directory / "secret.csv").write_text("0,1\n180,secret\n")
    text = subprocess.run([binary, "machines", "show", DESIGN], capture_output=True, text=True, check=True).stdout
    (directory / "own.toml").write_text(text)
    program = Program(binary, directory, "own.toml", "--out", "out")
    try:
        only_loopback(program)
        before = digests(directory)
        generator, begin = random.Random(7), time.time()
        found = {}
        parts = [threading.Thread(target=lambda seed=seed: found.update({seed: refuses(program, options.requests // 4, random.Random(seed))})) for seed in range(4)]
        for part in parts:
            part.start()
        for part in parts:
            part.join()
        assert len(found) == 4, "a hostile request was answered"
        seconds = time.time() - begin
        statuses = {status: sum(one.get(status, 0) for one in found.values()) for one in found.values() for status in one}
        longest, dripped, waited = bounded(program), slow(program), crowded(program)
        idle(program)
        assert digests(directory) == before, "a hostile client has written"
        unreadable(program, directory / "own.toml", text)
        works(program, binary, directory)
        assert program.process.poll() is None, "the program has ended"
    finally:
        said = program.end()
    assert "panicked" not in said and said == "", said
    (directory / "own.toml").write_text(text)
    came, calls = saves_killed(binary, directory, options.kills, 7)
    print(f"serve: {options.kills} kills at random moments of a save ({came} came), {calls or 'no'} at its calls: the next save works")
    print(f"serve: {options.requests} hostile requests in {seconds:.0f} s, answered {statuses}; the longest connection {longest:.1f} s, a slow body {dripped:.1f} s, after 200 silent connections {waited:.1f} s")


main()
