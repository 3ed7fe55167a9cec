"""Which tests of a build have passed, so that nothing is tested again that nothing has changed for.

A test counts as having passed by all that it is made of: its command, its environment, the bytes of the programs it
runs, the files that tests read, the project's tools and presets, and the installed packages. They are kept in the
build folder, in passed-tests.json, so a fresh clone runs every test, as the continuous integration does.
"""
import hashlib
import json
import pathlib
import subprocess

# What tests read, run or are run with, beside their programs.
READ_BY_TESTS = ("data", "examples", "tests", "tools", "CMakePresets.json")
CODE = (".cpp", ".h", ".py")  # of tests: compiled into the programs, or told with the scripts


def hash_of(*parts):
    digest = hashlib.sha256()
    for part in parts:
        part = part if isinstance(part, bytes) else str(part).encode()
        digest.update(f"{len(part)} ".encode())
        digest.update(part)
    return digest.hexdigest()


def hash_of_files(root, paths):
    return hash_of(*(part for path in sorted(paths) for part in (path.relative_to(root), path.read_bytes())))


def surroundings(root):
    """What every test may depend on besides its program, in one hash."""
    packages = subprocess.run(["dpkg-query", "--show"], check=True, capture_output=True).stdout
    named = (path for name in READ_BY_TESTS for path in (root / name, *(root / name).rglob("*")) if path.is_file())
    ours = (path for path in named if "__pycache__" not in path.parts
            and not (path.is_relative_to(root / "tests") and path.suffix in CODE))
    shared = (root.parent / "shared" / "data").rglob("*")
    times = [(str(path), path.stat().st_size, path.stat().st_mtime_ns) for path in sorted(shared) if path.is_file()]
    return hash_of(packages, hash_of_files(root, ours), times)


class Programs:
    """Hashes of the programs of a build: each is read once."""

    def __init__(self, folder):
        self.folder = folder
        self.hashes = {}

    def hash_of(self, path):
        if path not in self.hashes:
            self.hashes[path] = hash_of(path.read_bytes())
        return self.hashes[path]

    def run_by(self, test):
        """The programs that a test of `ctest --show-only=json-v1` runs; None where that cannot be told."""
        command = pathlib.Path(test["command"][0])
        worker = self.folder / "icome-vrml-worker"  # which the others start to read VRML
        if command.parent == self.folder:
            programs = [command, worker]
        elif any(word.startswith("ICOME_PROGRAM=") for word in environment_of(test)):
            programs = [self.folder / "icome", worker]
        else:
            return None
        return [path for path in programs if path.exists()]


def environment_of(test):
    return next((row["value"] for row in test.get("properties", ()) if row["name"] == "ENVIRONMENT"), [])


def scripts_of(test):
    """The script that a test runs, with the others of its folder, which it may import."""
    scripts = [pathlib.Path(word) for word in test["command"] if word.endswith(".py")]
    return sorted({path for script in scripts for path in script.parent.glob("*.py")})


def keys(tests, root, programs):
    """{name: the hash of all that it is made of} of those tests that this can be told of."""
    around = surroundings(root)
    found = {}
    for test in tests:
        run = programs.run_by(test)
        if run is not None:
            found[test["name"]] = hash_of(around, test["command"], environment_of(test),
                                          hash_of_files(root, scripts_of(test)), *map(programs.hash_of, run))
    return found


class PassedTests:
    """The tests of one build folder."""

    def __init__(self, root, build, tests):
        """`tests`: as `ctest --show-only=json-v1` lists them."""
        self.path = build / "passed-tests.json"
        self.names = [test["name"] for test in tests]
        self.keys = keys(tests, root, Programs(build / "bin"))
        try:
            self.passed = dict(json.loads(self.path.read_text()))
        except (OSError, ValueError, TypeError):  # none yet, or damaged: nothing has passed
            self.passed = {}

    def changed(self):
        """Names of the tests to run."""
        return [name for name in self.names if name not in self.keys or self.passed.get(name) != self.keys[name]]

    def add(self, passed):
        """Remembers {name: whether it has passed} of the tests that were run."""
        for name, has_passed in passed.items():
            if has_passed and name in self.keys:
                self.passed[name] = self.keys[name]
            else:
                self.passed.pop(name, None)
        self.path.write_text(json.dumps(self.passed, indent=1))
