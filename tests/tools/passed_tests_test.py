"""What has passed is run again exactly where something has changed that it is made of."""
import importlib.util
import pathlib
import tempfile
import unittest

ROOT = pathlib.Path(__file__).parents[2]
specification = importlib.util.spec_from_file_location("passed_tests", ROOT / "tools/passed_tests.py")
passed_tests = importlib.util.module_from_spec(specification)
specification.loader.exec_module(passed_tests)

class PassedTestsTest(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.root = pathlib.Path(scratch.name, "project")
        self.build = self.root / "build/release"
        for name in ("haptics_tests", "world_tests", "icome", "icome-vrml-worker"):
            self.write(f"build/release/bin/{name}", name)
        for name in ("tests/apps/touch_test.py", "tests/apps/icome_program.py", "data/demo.wrl", "tests/touch_test.cpp"):
            self.write(name, name)
        self.write("../shared/data/cow.obj", "cow")
        self.tests = [
            self.listed("haptics/1of2", [self.build / "bin/haptics_tests"], ["GTEST_SHARD_INDEX=0"]),
            self.listed("world", [self.build / "bin/world_tests"]),
            self.listed("apps/touch_test", ["python3", self.root / "tests/apps/touch_test.py"],
                      [f"ICOME_PROGRAM={self.build}/bin/icome"]),
            self.listed("tools/layers", ["python3", self.root / "tools/check_layers.py"]),
        ]

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def listed(self, name, command, environment=()):
        return {"name": name, "command": [str(word) for word in command],
                "properties": [{"name": "ENVIRONMENT", "value": list(environment)}]}

    def memory(self):
        return passed_tests.PassedTests(self.root, self.build, self.tests)

    def run_all(self, failed=()):
        self.memory().add({test["name"]: test["name"] not in failed for test in self.tests})

    def test_a_fresh_build_runs_all(self):
        self.assertEqual([test["name"] for test in self.tests], self.memory().changed())

    def test_what_cannot_be_told_is_run_each_time(self):
        self.run_all()
        self.assertEqual(["tools/layers"], self.memory().changed())

    def test_what_failed_is_run_again(self):
        self.run_all(failed=["world"])
        self.assertEqual(["world", "tools/layers"], self.memory().changed())

    def test_what_fails_after_it_passed_is_run_again(self):
        self.run_all()
        self.run_all(failed=["world"])
        self.assertEqual(["world", "tools/layers"], self.memory().changed())

    def test_changes(self):
        everything = [test["name"] for test in self.tests]
        for name, changed in {
                "build/release/bin/world_tests": ["world", "tools/layers"],
                "build/release/bin/icome": ["apps/touch_test", "tools/layers"],
                "build/release/bin/icome-vrml-worker": everything,
                "tests/apps/icome_program.py": ["apps/touch_test", "tools/layers"],
                "tests/stats/anova_in_r.R": everything,
                "data/demo.wrl": everything,
                "tools/lsan.supp": everything,
                "tools/check_layers.py": everything,
                "CMakePresets.json": everything,
                "../shared/data/cow.obj": everything,
                "tests/touch_test.cpp": ["tools/layers"],  # the program that it is compiled into tells
        }.items():
            with self.subTest(name):
                self.run_all()
                self.write(name, "something else")
                self.assertEqual(changed, self.memory().changed())

    def test_another_environment_is_another_test(self):
        self.run_all()
        self.tests[0]["properties"][0]["value"] = ["GTEST_SHARD_INDEX=1"]
        self.assertEqual(["haptics/1of2", "tools/layers"], self.memory().changed())

    def test_a_damaged_memory_is_none(self):
        self.run_all()
        for text in ("", "{", "[1]", '{"world": 3}'):
            with self.subTest(text):
                (self.build / "passed-tests.json").write_text(text)
                self.assertEqual([test["name"] for test in self.tests], self.memory().changed())


if __name__ == "__main__":
    unittest.main()
