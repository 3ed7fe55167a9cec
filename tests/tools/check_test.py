"""What `make test` tells of itself: how many tests ran, what each stage and folder cost, which stage failed."""
import contextlib
import importlib.machinery
import importlib.util
import io
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "tools"))
loader = importlib.machinery.SourceFileLoader("check", str(ROOT / "tools/check"))
specification = importlib.util.spec_from_loader("check", loader)
check = importlib.util.module_from_spec(specification)
sys.modules["check"] = check
loader.exec_module(check)

RESULTS = """<testsuite>
  <testcase name="haptics/1of2" time="2.5" status="run"><system-out>
[==========] 41 tests from 7 test suites ran. (2400 ms total)
[  PASSED  ] 41 tests.</system-out></testcase>
  <testcase name="haptics/2of2" time="1.5" status="run"><system-out>[==========] 1 test ran. (9 ms total)
</system-out></testcase>
  <testcase name="apps/touch_test" time="30" status="run"><system-out>Ran 9 tests in 30 s</system-out></testcase>
</testsuite>"""


class CheckTest(unittest.TestCase):
    def setUp(self):
        self.check = check.Check(2)

    def results(self, text):
        file = tempfile.NamedTemporaryFile("w", suffix=".xml")
        self.addCleanup(file.close)
        file.write(text)
        file.flush()
        return file.name

    def printed(self, work):
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            work()
        return out.getvalue()

    def runs(self, text, units=("haptics/1of2", "haptics/2of2")):
        return self.check.test_runs(self.results(text), units)

    def test_tests_within_programs_are_counted_and_scripts_as_one(self):
        self.assertEqual([41, 1, 1], [run.ran for run in self.runs(RESULTS)])
        self.assertTrue(all(run.passed and run.complete and run.skipped == 0 for run in self.runs(RESULTS)))
        self.check.folders.clear()
        self.runs(RESULTS)
        self.assertEqual(4.0, self.check.folders["tests/haptics"].testing)
        self.assertEqual(30.0, self.check.folders["tests/apps"].testing)

    def test_results_that_cannot_be_read_are_told(self):
        for text in ("", "<testsuite>"):
            with self.subTest(text):
                self.assertIn("cannot be counted", self.printed(lambda: self.assertEqual([], self.runs(text))))

    def test_a_program_that_ends_before_its_tests_do_is_not_complete(self):
        (run,) = self.runs('<t><testcase name="haptics/1of2" time="1" status="run"><system-out>[ RUN ]</system-out>'
                           '</testcase></t>')
        self.assertTrue(run.passed)
        self.assertFalse(run.complete)

    def test_tests_that_were_skipped_are_counted(self):
        (run,) = self.runs('<t><testcase name="haptics/1of2" time="1" status="run"><system-out>'
                           '[==========] 20 tests from 1 test suite ran. (0 ms total)\n[  PASSED  ] 1 test.\n'
                           '[  SKIPPED ] 19 tests, listed below:\n</system-out></testcase></t>')
        self.assertEqual((20, 19), (run.ran, run.skipped))

    def test_a_program_in_which_no_test_runs_is_named(self):
        none = '[==========] 0 tests from 0 test suites ran. (0 ms total)'
        runs = self.runs(RESULTS.replace("[==========] 41 tests from 7 test suites ran. (2400 ms total)", none))
        self.assertEqual([], check.programs_without_tests(runs))  # its other share has one
        self.assertEqual(["haptics"], check.programs_without_tests(runs[:1]))

    def test_a_stage_that_fails_is_in_the_table(self):
        def fail():
            raise check.Failure("ctest")

        with contextlib.redirect_stdout(io.StringIO()):
            self.check.stage("layout", lambda: "12 files")
            self.assertRaises(check.Failure, self.check.stage, "names", fail)
        table = self.printed(self.check.print_costs).splitlines()
        self.assertRegex(table[2], r"^  layout +0:00 +0:00  12 files$")
        self.assertRegex(table[3], r"^  names +0:00 +0:00  failed$")

    def test_a_command_that_fails_ends_its_stage(self):
        self.assertEqual("", self.check.command("true"))
        self.assertRaises(check.Failure, self.check.command, "false")

    def test_times_read_as_minutes_and_seconds(self):
        self.assertEqual(["0:00", "1:05", "72:51"], [check.clock_text(s) for s in (0.9, 65.2, 4371)])


if __name__ == "__main__":
    unittest.main()
