"""A PostgreSQL database and a NATS bus for tests, each in a folder of its own on the loopback."""
import os
import pathlib
import pwd
import re
import shutil
import signal
import subprocess
import time
import unittest


def postgres_programs():
    found = sorted(pathlib.Path("/usr/lib/postgresql").glob("*/bin/initdb"))
    return found[-1].parent if found else None


def skip_without_servers():
    if postgres_programs() is None or shutil.which("nats-server") is None:
        raise unittest.SkipTest("PostgreSQL or nats-server not there: tools/install-packages test")


class Database:
    """A PostgreSQL server with one database, `icome`, reached by a socket in its folder."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.folder.mkdir()
        self.user = {}
        if os.geteuid() == 0:  # which PostgreSQL refuses to run as
            user = pwd.getpwnam("postgres")
            os.chown(self.folder, user.pw_uid, user.pw_gid)
            self.user = {"user": user.pw_uid, "group": user.pw_gid, "extra_groups": []}
        self._run("initdb", "-D", "data", "-U", "icome", "--auth=trust", "-E", "UTF8", "--locale=C", "-N")
        self.start()
        self._run("createdb", "-h", self.folder, "-U", "icome", "icome")

    def _run(self, program, *arguments):
        subprocess.run([postgres_programs() / program, *map(str, arguments)], check=True, cwd=self.folder,
                       stdout=subprocess.DEVNULL, timeout=120, **self.user)

    def start(self):
        self._run("pg_ctl", "-D", "data", "-w", "-l", "log", "-o",
                  f"-k {self.folder} -c listen_addresses= -c shared_buffers=32MB", "start")

    def stop(self, how="immediate"):
        self._run("pg_ctl", "-D", "data", "-w", "-m", how, "stop")

    @property
    def address(self):
        return f"postgresql://icome@/icome?host={self.folder}"


class Bus:
    """A NATS server on a free port."""

    def __init__(self, folder):
        self.log = pathlib.Path(folder) / "nats.log"
        self.port = -1
        self.start()

    def start(self):
        self.log.unlink(missing_ok=True)
        self.process = subprocess.Popen(["nats-server", "-a", "127.0.0.1", "-p", str(self.port), "-l", str(self.log)],
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        end = time.monotonic() + 60
        while True:
            said = self.log.read_text() if self.log.exists() else ""
            found = re.search(r"client connections on 127\.0\.0\.1:(\d+)", said)
            if found and "Server is ready" in said:
                break
            if time.monotonic() > end or self.process.poll() is not None:
                raise AssertionError(f"nats-server did not start: {said}")
            time.sleep(0.05)
        self.port = int(found[1])

    def stop(self):
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()

    @property
    def address(self):
        return f"nats://127.0.0.1:{self.port}"
