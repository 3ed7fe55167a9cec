"""`icome study` writes study files, says what they mean and what they lack."""
import json
import pathlib
import re
import unittest

from icome_program import ProgramTest, run

STUDIES = pathlib.Path(__file__).resolve().parents[2] / "data" / "studies"


class StudyTest(ProgramTest):
    def new(self, name, *arguments):
        file = self.folder / name
        self.succeeds("study", "new", file, *arguments)
        return file

    def check(self, file, code=0):
        done = run("study", "check", file, "--json")
        self.assertEqual(done.returncode, code, done.stderr)
        return json.loads(done.stdout)

    def test_a_new_study_can_be_run_as_it_is(self):
        file = self.new("pointing.toml")
        report = self.check(file)
        self.assertEqual(report["name"], "pointing")
        self.assertTrue(report["runnable"])
        self.assertEqual(report["orders"], [[0, 1], [1, 0]])
        self.assertEqual(report["conditions"], [{"technique": "old"}, {"technique": "new"}])
        text = self.succeeds("study", "check", file).stdout
        self.assertIn("2. person: new | old", text)
        self.assertTrue(text.endswith("It can be run.\n"))

    def test_nothing_is_overwritten(self):
        file = self.write("mine.toml", "precious")
        self.fails("study", "new", file, code=1, saying="is there already")
        self.assertEqual(file.read_text(), "precious")
        self.fails("study", "new", self.folder / "no" / "x.toml", code=1, saying="cannot be written")
        self.fails("study", "new", self.folder / "study.txt", code=1, saying=".toml")

    def test_templates_are_the_files_of_data(self):
        for template, name in (("head-tracking", "head-tracking"), ("menu", "menu-selection"), ("blank", "blank")):
            file = self.new(name + ".toml", "--template", template)
            self.assertEqual(file.read_text(), (STUDIES / (name + ".toml")).read_text())
        self.fails("study", "new", "x.toml", "--template", "menus", code=2, saying="--template")

    def test_head_tracking_can_be_run(self):
        report = self.check(STUDIES / "head-tracking.toml")
        self.assertTrue(report["runnable"])
        self.assertEqual(report["reasons"], [])
        self.assertEqual(report["participants"], 22)
        self.assertEqual(report["trials"], 16)
        self.assertEqual(report["languages"], ["en", "nl"])

    def test_menu_selection_can_be_run(self):
        report = self.check(STUDIES / "menu-selection.toml")
        self.assertTrue(report["runnable"])
        self.assertEqual(report["reasons"], [])
        self.assertEqual(report["groups"], [{"interaction": "click"}, {"interaction": "push"}])
        self.assertEqual(report["balanced_by"], 4)
        self.assertEqual(report["trials"], 30)
        self.assertEqual([c["id"] for c in report["control"] if c["balanced"]], ["sex", "age", "experience"])
        done = run("study", "check", STUDIES / "menu-selection.toml")
        self.assertEqual(done.returncode, 0)
        self.assertIn("It can be run", done.stdout)

    def test_all_mistakes_are_told_with_file_line_and_column(self):
        file = self.new("bad.toml")
        file.write_text(file.read_text().replace("measured = 10 ", "measured = 0 ").replace('kind = "within"', 'kind = "inside"')
                        .replace("participants = 16", "participant = 16"))
        done = self.fails("study", "check", file, code=1, saying="bad.toml:")
        lines = done.stderr.splitlines()
        self.assertEqual(len(lines), 3, done.stderr)
        for line in lines:
            self.assertRegex(line, r"bad\.toml:\d+:\d+: ")
        self.assertIn("did you mean 'participants'?", lines[0])
        self.assertIn("kind cannot be 'inside'", lines[1])
        self.assertIn("measured is 0", lines[2])

    def test_scenes_must_be_there(self):
        file = self.new("rooms.toml")
        file.write_text(re.sub(r"scenes = .*", 'scenes = [{ id = "a", file = "a.wrl" }, { id = "b", file = "b.wrl" }]',
                               file.read_text()))
        self.write("a.wrl", "#VRML V2.0 utf8\nDEF target Transform { children Shape { geometry Box { size 0.1 0.1 0.1 } } }\n")
        (reason,) = self.check(file, code=1)["reasons"]
        self.assertEqual(reason["sentence"], "scene 'b': there is no file b.wrl beside the study.")
        self.assertGreater(reason["line"], 1)

    def test_scenes_must_have_what_trials_ask_for(self):
        file = self.new("pointing.toml")
        text = file.read_text()
        file.write_text(text.replace('target = "target"', 'target = "goal"'))
        report = self.check(file, code=1)
        self.assertFalse(report["runnable"])
        (reason,) = report["reasons"]
        self.assertTrue(reason["sentence"].startswith("scene 'room': the task's target is 'goal', and nothing"))
        self.assertEqual(file.read_text().split("\n")[reason["line"] - 1], "[task]")
        done = run("study", "check", file)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stdout, r"It cannot be run as it is\n  .*pointing\.toml:\d+:1: scene 'room': ")
        file.write_text(text)
        for broken in (bytes(range(200, 256)) * 9, b"#VRML V2.0 utf8\nTransform {", b"hello", b""):
            (self.folder / "scenes" / "pointing-room.wrl").write_bytes(broken)
            (reason,) = self.check(file, code=1)["reasons"]
            self.assertIn("scenes/pointing-room.wrl: ", reason["sentence"])

    def test_scenes_must_have_a_target_for_every_value(self):
        file = self.new("menu.toml", "--template", "menu")
        file.write_text(file.read_text().replace('id = "red"', 'id = "pink"'))
        report = self.check(file, code=1)
        self.assertEqual(len(report["reasons"]), 1)
        self.assertIn("the task's target is 'menu/pink'", report["reasons"][0]["sentence"])
        self.assertTrue(any("'cube-pink'" in warning["sentence"] for warning in report["warnings"]))

    def test_a_microphone_that_cannot_be_heard_is_told_before_anybody_begins(self):
        file = self.new("spoken.toml", "--template", "blank")
        self.fails("study", "run", file, "--microphone", "nosuch.wav", code=1,
                   saying="for studies that need speech")
        text = file.read_text()
        self.assertIn('needs = ["pointer"]', text)
        file.write_text(text.replace('needs = ["pointer"]', 'needs = ["pointer", "speech"]', 1))
        self.fails("study", "run", file, "--microphone", "nosuch.wav", code=1, saying="nosuch.wav")

    def test_what_nobody_comes_to_is_told(self):
        file = self.new("menu.toml", "--template", "menu")
        report = self.check(file)
        self.assertFalse([it for it in report["warnings"] if "simulated person" in it["sentence"]])
        file.write_text(file.read_text().replace("centre = [0.06, 0.003, -0.037]", "centre = [2.06, 0.003, -0.037]"))
        (warning,) = [it for it in self.check(file)["warnings"] if "simulated person" in it["sentence"]]
        self.assertEqual(len(re.findall("'menu/([a-z]+)'", warning["sentence"])), 7, "out of reach")
        file.write_text(file.read_text().replace("centre = [2.06, 0.003, -0.037]", "centre = [0.06, 0.003, -0.037]"))
        # The menu half below the floor.
        file.write_text(file.read_text().replace("centre = [0.06, 0.003, -0.037]", "centre = [0.06, -0.09, -0.037]"))
        (warning,) = [it for it in self.check(file)["warnings"] if "simulated person" in it["sentence"]]
        # The floor is 10 mm thick, its top at -80 mm; the rows are 16.8 mm high, the third one above the centre. The hand
        # comes round the floor to those that lie below it.
        self.assertEqual(re.findall("'menu/([a-z]+)'", warning["sentence"]), ["yellow"], warning["sentence"])
        self.assertEqual(file.read_text().split("\n")[warning["line"] - 1], "[task]")

    def test_scenes_of_templates_stand_beside_them(self):
        self.new("head.toml", "--template", "head-tracking")
        room = self.folder / "scenes" / "room-1.wrl"
        self.assertEqual(room.read_text(), (STUDIES / "scenes" / "room-1.wrl").read_text())
        self.new("again.toml", "--template", "head-tracking")  # which has the same scenes
        room.write_text("mine")
        self.fails("study", "new", self.folder / "third.toml", "--template", "head-tracking", code=1,
                   saying="room-1.wrl is there already")
        self.assertEqual(room.read_text(), "mine")

    def test_what_is_no_study_is_told(self):
        self.fails("study", "check", self.write("a.toml", "[="), code=1, saying="a.toml:1:2")
        self.fails("study", "check", self.folder / "none.toml", code=1, saying="none.toml")
        self.fails("study", "check", self.folder, code=1, saying=str(self.folder))
        self.fails("study", "ran", code=2, saying='there is no command "ran"; choose from new, check, run')
        self.fails("study", code=2, saying="say which command")

    def test_the_hash_is_of_what_is_said(self):
        file = self.new("one.toml")
        before = self.check(file)["hash"]
        self.assertRegex(before, r"^[0-9a-f]{16}$")
        text = file.read_text()
        file.write_text(re.sub(r"#.*", "", text))
        self.assertEqual(self.check(file)["hash"], before)
        file.write_text(text.replace("seed = 1", "seed = 2"))
        self.assertNotEqual(self.check(file)["hash"], before)


if __name__ == "__main__":
    unittest.main()
