"""The window of cut-out animations as people use it: cells dragged by the mouse, keyed by Space, played, saved."""
import json
import time
import unittest

from desktop_program import DesktopTest, wait_for
from icome_program import run

SQUARE = ('<svg xmlns="http://www.w3.org/2000/svg" width="120" height="120">'
          '<rect width="120" height="120" fill="#ff0000"/></svg>')


class CutoutWindowTest(DesktopTest):
    def make_project(self):
        (self.folder / "square.svg").write_text(SQUARE)
        edits = self.folder / "edits.jsonl"
        edits.write_text('{"op": "stage", "background": "#0000ff", "length": 24}\n'
                         '{"op": "add-cell", "pictures": "square.svg"}\n')
        project = self.folder / "small.cutout"
        done = run("animate", "new", "--apply", edits, "--save", project)
        self.assertEqual(done.returncode, 0, done.stderr)
        return project

    def open_window(self, project):
        desktop = self.start("animate", project, "--open", "--theme", "light").open()
        wait_for("the red square", lambda: self.square(desktop))
        return desktop

    @staticmethod
    def square(desktop):
        """The middle of what is red in the window, pixels; none where nothing is."""
        return desktop.whole().middle(lambda red, green, blue: (red, green, blue) == (255, 0, 0))

    def drag_square(self, desktop, by):
        left, top, _, _ = desktop.place()
        x, y = self.square(desktop)
        ask = desktop.screen.ask
        ask("mousemove", "--sync", round(left + x), round(top + y))
        ask("mousedown", 1)
        for part in range(1, 9):
            ask("mousemove", round(left + x + by[0] * part / 8), round(top + y + by[1] * part / 8))
        ask("mouseup", 1)
        wait_for("the square elsewhere", lambda: abs((self.square(desktop) or (x, y))[0] - x - by[0]) < 12)

    def told(self, project):
        done = run("animate", project, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def keys_in(self, project):
        return self.told(project)["layers"][0]["cells"][0]["keys"]

    def test_poses_are_keyed_by_space_and_saved(self):
        project = self.make_project()
        desktop = self.open_window(project)
        self.drag_square(desktop, (-150, 60))
        desktop.key("space")
        desktop.wait_title(r"\*")
        self.drag_square(desktop, (200, -30))
        desktop.key("space")
        self.keep(desktop, "cutout-poses")
        wait_for("keys in the journal", lambda: self.told(project)["recovered"] > 0)
        desktop.key("ctrl+s")
        wait_for("a saved project", lambda: self.told(project)["recovered"] == 0 and self.keys_in(project) >= 4)
        text = project.read_text()
        self.assertRegex(text, r"keys\.x = \[\[0, .*\], \[1, ")
        desktop.key("ctrl+z")
        desktop.wait_title(r"\*")
        desktop.quit()
        desktop.find_window("Save Changes")
        desktop.key("Escape")
        desktop.screen.ask("windowactivate", "--sync", desktop.window)
        desktop.key("ctrl+shift+z")
        desktop.wait_title(r"^small\.cutout - ICOME|^small\.cutout [^*]*$")
        desktop.quit()
        self.assertEqual(desktop.wait_end(), 0, desktop.printed())
        self.assertFalse((self.folder / ".small.cutout.journal").exists())

    def test_a_crash_loses_nothing(self):
        project = self.make_project()
        desktop = self.open_window(project)
        self.drag_square(desktop, (-150, 60))
        desktop.key("space")
        wait_for("keys in the journal", lambda: self.told(project)["recovered"] > 0)
        desktop.kill()
        self.assertGreaterEqual(self.keys_in(project), 2)
        desktop = self.open_window(project)
        desktop.wait_title(r"\*")
        desktop.key("ctrl+s")
        wait_for("a saved project", lambda: self.told(project)["recovered"] == 0)
        self.assertGreaterEqual(self.keys_in(project), 2)
        desktop.quit()
        self.assertEqual(desktop.wait_end(), 0, desktop.printed())

    def test_it_plays_and_goes_back(self):
        project = self.make_project()
        edits = self.folder / "more.jsonl"
        edits.write_text('{"op": "stage", "length": 600}\n'
                         '{"op": "key", "cell": "square", "frame": 0, "x": 200}\n'
                         '{"op": "key", "cell": "square", "frame": 599, "x": 1000}\n')
        self.assertEqual(run("animate", project, "--apply", edits, "--save", project).returncode, 0)
        desktop = self.open_window(project)
        start = self.square(desktop)[0]
        desktop.key("p")
        wait_for("a square that moves", lambda: (self.square(desktop) or (start,))[0] > start + 20)
        desktop.key("Escape")

        def stands():
            before = self.square(desktop)
            time.sleep(0.3)
            return before is not None and self.square(desktop) == before
        wait_for("a square that stands", stands)
        stopped = self.square(desktop)[0]
        desktop.key("End")
        wait_for("the last frame", lambda: (self.square(desktop) or (stopped,))[0] > stopped)
        desktop.quit()
        self.assertEqual(desktop.wait_end(), 0, desktop.printed())

    def test_saving_asks_where_the_file_was_changed_elsewhere(self):
        project = self.make_project()
        desktop = self.open_window(project)
        self.drag_square(desktop, (-150, 60))
        desktop.key("space")
        desktop.wait_title(r"\*")
        others = project.read_text() + "# by another program\n"
        project.write_text(others)
        desktop.key("ctrl+s")
        desktop.find_window("Overwrite the File")
        self.keep(desktop, "cutout-overwrite")
        desktop.key("Escape")
        self.assertEqual(project.read_text(), others)
        desktop.screen.ask("windowactivate", "--sync", desktop.window)
        desktop.key("ctrl+s")
        desktop.find_window("Overwrite the File")
        desktop.key("alt+o")
        wait_for("a saved project", lambda: "another program" not in project.read_text())
        self.assertGreaterEqual(self.keys_in(project), 2)
        desktop.screen.ask("windowactivate", "--sync", desktop.window)
        desktop.quit()
        self.assertEqual(desktop.wait_end(), 0, desktop.printed())


if __name__ == "__main__":
    unittest.main()
