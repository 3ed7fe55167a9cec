"""The help teaches: what the program is, its commands, and examples that work."""
import re
import unittest

from icome_program import ProgramTest, TRACE_HEADER, run


class HelpTest(ProgramTest):
    def test_help_names_the_command_and_gives_three_examples(self):
        text = self.succeeds("--help").stdout
        self.assertRegex(text, r"\n  touch +\S")
        self.assertGreaterEqual(len(re.findall(r"^  icome touch ", text, re.M)), 3)

    def test_help_tells_of_the_window(self):
        text = self.succeeds("--help").stdout
        self.assertIn("window", text)
        self.assertIn("--theme", text)
        self.assertRegex(text, r"(?m)^  icome +the window")

    def test_touch_help_tells_every_option_the_units_and_the_formats(self):
        text = self.succeeds("touch", "--help").stdout
        for option in ("--path", "--device", "--seconds", "--rate", "--fit", "--radius", "--sides", "--stiffness",
                       "--friction", "--check", "--trace", "--picture", "--json", "--unit", "--up", "--shading"):
            self.assertIn(option + " ", text)
        self.assertIn("metres", text)
        self.assertIn(TRACE_HEADER, text)

    def test_what_stands_beside_options_is_wrapped(self):
        for command in ([], ["touch"], ["edit"], ["shot"], ["info"], ["convert"], ["csg"], ["study", "run"],
                        ["stats", "anova"], ["techniques"]):
            for line in self.succeeds(*command, "--help").stdout.splitlines():
                if re.match(r".{28}  \S", line):
                    self.assertLessEqual(len(line), 100, line)

    def test_the_first_example_works(self):
        example = re.search(r"^  icome (touch sphere:\S+)", self.succeeds("--help").stdout, re.M).group(1)
        done = run(*example.split(), "--seconds", "0.05")
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
