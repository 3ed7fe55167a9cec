"""What the program tests share: running the program, writing paths, reading traces."""
import csv
import json
import math
import os
import pathlib
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["ICOME_PROGRAM"]
SHARED_MESHES = pathlib.Path(__file__).resolve().parents[3] / "shared" / "data" / "meshes"
BUNNY = pathlib.Path("/usr/share/glmark2/models/bunny.obj")
TRACE_HEADER = "t,tip_x,tip_y,tip_z,scp_x,scp_y,scp_z,force_x,force_y,force_z,touching,object,tick_us"


def run(*arguments, **environment):
    """Runs the program and returns the finished process, with text output; `environment`: variables set for it."""
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=250,
                          env={**os.environ, **environment})


class ProgramTest(unittest.TestCase):
    """A test in a folder of its own, self.folder, that is gone afterwards."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="icome-")
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def path_file(self, points, rate=1000.0, name="path.csv"):
        """A path of one point a tick."""
        file = self.folder / name
        rows = (f"{i / rate!r},{x!r},{y!r},{z!r}" for i, (x, y, z) in enumerate(points))
        file.write_text("t,x,y,z\n" + "\n".join(rows) + "\n")
        return file

    def write(self, name, text):
        file = self.folder / name
        file.write_text(text)
        return file

    def succeeds(self, *arguments):
        done = run(*arguments)
        self.assertEqual(done.returncode, 0, f"{arguments}: {done.stderr}")
        return done

    def report(self, *arguments):
        """The JSON report of a run that must succeed."""
        return json.loads(self.succeeds("touch", *arguments, "--json").stdout)

    def trace(self, *arguments, name="trace.csv"):
        """The rows of a run's trace: dictionaries of numbers."""
        file = self.folder / name
        self.succeeds("touch", *arguments, "--trace", file)
        with file.open(newline="") as lines:
            return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(lines)]

    def fails(self, *arguments, code, saying):
        """The run must fail with that exit code and one line that contains `saying`, and print nothing else."""
        done = run(*arguments)
        self.assertEqual(done.returncode, code, f"{arguments}: {done.stdout}{done.stderr}")
        self.assertEqual(done.stdout, "")
        first = done.stderr.splitlines()[0]
        self.assertTrue(first.startswith("icome: "), first)
        self.assertIn(saying, first)
        return done


def point(row, what):
    return (row[what + "_x"], row[what + "_y"], row[what + "_z"])


def length(vector):
    return math.sqrt(sum(value * value for value in vector))


def distance(a, b):
    return math.dist(a, b)


def line(start, end, count):
    """`count` points from `start` to `end`."""
    return [tuple(a + (b - a) * i / (count - 1) for a, b in zip(start, end)) for i in range(count)]
