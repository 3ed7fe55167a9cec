"""What tests of shared designs have in common: a server in a folder of its own, links, and people who edit."""
import json
import os
import pathlib
import queue
import re
import signal
import subprocess
import threading

from icome_program import PROGRAM

PATIENCE = 90.0  # s, for the next line of somebody who watches
SECRET = re.compile(r"token=[\w-]+")


def line(**fields):
    return json.dumps(fields)


BOX = line(op="create", shape="box", size=[0.1, 0.1, 0.1], name="box")


class Server:
    """`icome serve` on a free port, for as long as a `with` lasts; may be killed and started again at the same port."""

    def __init__(self, store, *arguments, listen="127.0.0.1:0", program=PROGRAM):
        self.store = store if "://" in str(store) else pathlib.Path(store)
        self.arguments = arguments
        self.listen = listen
        self.program = program
        self.start()

    def start(self):
        self.process = subprocess.Popen([self.program, "serve", "--store", str(self.store), "--listen", self.listen,
                                         "--json", *self.arguments],
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        said = self.process.stdout.readline()
        if not said:
            raise AssertionError(f"the server did not start: {self.process.stderr.read()}")
        self.said = json.loads(said)
        self.listen = self.said["listening"]

    def kill(self):
        self.process.kill()
        self.process.communicate()

    def end(self, how=signal.SIGTERM):
        self.process.send_signal(how)
        out, error = self.process.communicate(timeout=60)
        return self.process.returncode, error

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.kill()

    def invite(self, design="table", role="own", *more):
        done = subprocess.run([PROGRAM, "invite", design, "--role", role, "--store", str(self.store), *more],
                              capture_output=True, text=True, timeout=60)
        if done.returncode != 0:
            raise AssertionError(done.stderr)
        return done.stdout.strip()


class Watcher:
    """`icome edit ADDRESS --watch --json`, perhaps behind a script: its lines are read one by one."""

    def __init__(self, link, script=None, name="Ann"):
        arguments = ["--apply", "-"] if script is not None else []
        self.process = subprocess.Popen([PROGRAM, "edit", link, *arguments, "--watch", "--json"],
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                        text=True, env={**os.environ, "ICOME_NAME": name})
        if script is not None:
            self.process.stdin.write(script)
        self.process.stdin.close()
        self._lines = queue.Queue()
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self):
        for text in self.process.stdout:
            self._lines.put(text)
        self._lines.put("")

    def next(self):
        try:
            text = self._lines.get(timeout=PATIENCE)
        except queue.Empty:
            raise AssertionError(f"nothing was told for {PATIENCE:.0f} s") from None
        if not text:
            raise AssertionError(f"it ended: {self.process.stderr.read()}")
        return json.loads(text)

    def until(self, holds):
        """The first line for which it holds; lines before are skipped."""
        while True:
            told = self.next()
            if holds(told):
                return told

    def end(self):
        self.process.send_signal(signal.SIGINT)
        self._reader.join()
        error = self.process.stderr.read()
        code = self.process.wait(timeout=60)
        self.process.stdout.close()
        self.process.stderr.close()
        return code, error

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        self._reader.join()
        self.process.stdout.close()
        self.process.stderr.close()
