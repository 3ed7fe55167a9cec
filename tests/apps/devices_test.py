"""`icome devices` lists, tests and calibrates devices."""
import json
import os
import signal
import subprocess
import tempfile
import unittest

from icome_program import PROGRAM, ProgramTest, run


class DevicesTest(ProgramTest):
    def test_the_list_is_one_document_and_says_why(self):
        answer = json.loads(self.succeeds("devices", "--json").stdout)
        self.assertEqual(set(answer), {"devices"})
        for entry in answer["devices"]:
            self.assertEqual(set(entry), {"name", "family", "backend", "present", "why"})
            self.assertIn(entry["family"], ("pointer", "navigation", "head"))
            self.assertTrue(entry["present"] or entry["why"])
        simulated = [it for it in answer["devices"] if it["backend"] == "simulated"]
        self.assertTrue(simulated and simulated[0]["present"])

    def test_the_list_in_words_names_each(self):
        names = [it["name"] for it in json.loads(self.succeeds("devices", "--json").stdout)["devices"]]
        text = self.succeeds("devices").stdout
        for name in names:
            self.assertIn(name, text)

    def test_a_device_is_measured(self):
        with tempfile.TemporaryDirectory() as folder:
            picture = os.path.join(folder, "test.png")
            answer = json.loads(self.succeeds("devices", "test", "simulated", "--yes", "--seconds", "0.5", "--picture",
                                              picture, "--json").stdout)
            with open(picture, "rb") as file:
                self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")
        self.assertEqual(answer["address"], "simulated")
        self.assertGreater(answer["readings"], 100)
        self.assertLessEqual(answer["force"]["strongest_n"], 0.5)
        self.assertGreater(answer["force"]["moved_mm"], 0.1)
        self.assertEqual(len(answer["noise_um"]), 3)

    def test_nobody_is_pushed_unasked(self):
        result = self.succeeds("devices", "test", "simulated", "--seconds", "0.5", "--json")
        self.assertIsNone(json.loads(result.stdout)["force"])
        self.assertIn("--yes", result.stderr)

    def test_a_device_that_does_not_move_gets_no_profile(self):
        with tempfile.TemporaryDirectory() as folder:
            result = run("devices", "calibrate", "simulated", "--seconds", "0.5", XDG_CONFIG_HOME=folder)
            self.assertEqual(result.returncode, 1)
            self.assertIn("no profile was written", result.stderr)
            self.assertEqual(os.listdir(folder), [])

    def test_the_question_can_be_left_by_ctrl_c(self):
        keyboard, terminal = os.openpty()
        self.addCleanup(os.close, keyboard)
        with subprocess.Popen([PROGRAM, "devices", "test", "simulated", "--seconds", "0.5"], stdin=terminal,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as asking:
            os.close(terminal)
            said = ""
            while not said.endswith("[y/N] "):
                said += asking.stderr.read(1)
            asking.send_signal(signal.SIGINT)
            self.assertEqual(asking.wait(timeout=60), 130)

    def test_a_limit_holds_however_the_device_is_spelled(self):
        profile = self.folder / "icome" / "devices" / "simulated.toml"
        profile.parent.mkdir(parents=True)
        profile.write_text("max_force_n = 0.1\n")
        for name in ("simulated", "simulated:", "simulated:Touch"):
            answer = json.loads(run("devices", "test", name, "--yes", "--seconds", "0.5", "--json",
                                    XDG_CONFIG_HOME=self.folder).stdout)
            self.assertLessEqual(answer["force"]["strongest_n"], 0.1, name)

    def test_what_is_no_number_is_refused(self):
        for arguments in (("test", "simulated", "--rate"), ("test", "simulated", "--force"),
                          ("calibrate", "simulated", "--scale"), ("calibrate", "simulated", "--max-force")):
            result = run("devices", *arguments, "nan", XDG_CONFIG_HOME=self.folder)
            self.assertEqual(result.returncode, 2, arguments)
            self.assertIn("nan is not a number", result.stderr)
        self.assertEqual(run("touch", "sphere:0.05", "--hand-scale", "nan").returncode, 2)
        self.assertEqual(run("devices", "calibrate", "simulated", "--axes", "y,z,-x").returncode, 2)

    def test_errors_say_what_there_is(self):
        result = run("devices", "test", "feather")
        self.assertEqual(result.returncode, 1)
        self.assertIn("icome devices", result.stderr)
        self.assertEqual(run("devices", "test", "").returncode, 1)
        self.assertEqual(run("devices", "tset", "simulated").returncode, 2)
        self.assertEqual(run("touch", "sphere:0.05", "--device", "feather").returncode, 1)


if __name__ == "__main__":
    unittest.main()
