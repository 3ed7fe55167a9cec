"""The window when things go wrong: the reason stands where people look, and the work is still there."""
import os
import pathlib
import shutil
import struct
import subprocess
import unittest

from desktop_program import DEMO, DesktopTest, is_rubber, shows_banner, wait_for
from icome_program import PROGRAM

BALL = """#VRML V2.0 utf8
DEF Front Viewpoint { position 0 0.05 0.5 fieldOfView 0.6 description "Front" }
DEF Ball Transform { translation 0 0.05 0 children Shape {
  appearance Appearance { material DEF Green Material { diffuseColor 0.02 0.27 0.24 } }
  geometry Sphere { radius 0.06 } } }
"""


def write_large_stl(file, side=708):
    """A bumpy plate of 2 side^2 triangles: a million."""
    rows = [[(0.001 * x, 0.001 * y, 0.0005 * ((x * 7 + y * 13) % 11)) for x in range(side + 1)]
            for y in range(side + 1)]
    with file.open("wb") as out:
        out.write(b"\0" * 80 + struct.pack("<I", 2 * side * side))
        for y in range(side):
            below, above = rows[y], rows[y + 1]
            out.write(b"".join(struct.pack("<12fH12fH", 0, 0, 0, *below[x], *below[x + 1], *above[x], 0,
                                           0, 0, 0, *below[x + 1], *above[x + 1], *above[x], 0)
                               for x in range(side)))


class DesktopTroubleTest(DesktopTest):
    def open_ball(self, design=None, **options):
        design = design or self.write("ball.wrl", BALL)
        desktop = self.start(design, "--theme", "dark", **options).open()
        desktop.wait_title(r"^ball\.wrl - ICOME")
        return desktop

    def write(self, name, text):
        file = self.folder / name
        file.write_text(text)
        return file

    @staticmethod
    def wait_ball(desktop):
        return desktop.wait_scene("the ball", lambda it: it.share(is_rubber) > 0.01)

    def nudge(self, desktop):
        """Moves the ball a little, by keys."""
        self.wait_ball(desktop)
        desktop.key("ctrl+a", "shift+Right")
        desktop.wait_title(r"\*")

    def test_a_broken_file_is_told_and_the_work_stays(self):
        broken = self.write("broken.wrl", "#VRML V2.0 utf8\nShape { geometry Box { size 1 1\n")
        desktop = self.open_ball()
        self.wait_ball(desktop)
        self.assertFalse(shows_banner(desktop, "error"))
        desktop.key("ctrl+o")
        desktop.find_window("Open a Design")
        desktop.type(str(broken))
        desktop.key("Return")
        wait_for("the reason", lambda: shows_banner(desktop, "error"))
        self.wait_ball(desktop)
        self.keep(desktop, "broken-file")
        self.assertIn("ball.wrl", desktop.title())

    def test_a_broken_file_on_the_command_line(self):
        desktop = self.start(self.write("broken.obj", "v 1 2\n"), "--theme", "dark").open()
        wait_for("the reason", lambda: shows_banner(desktop, "error"))
        desktop.quit()
        self.assertEqual(desktop.wait_end(), 0, desktop.printed())

    def test_a_full_disk_loses_nothing(self):
        disk = self.small_disk("disk", "256k")
        design = disk / "ball.wrl"
        design.write_text(BALL)
        desktop = self.open_ball(design)
        self.nudge(desktop)
        filler = self.fill(disk)
        desktop.key("ctrl+s")
        wait_for("the reason", lambda: shows_banner(desktop, "error"))
        self.keep(desktop, "full-disk")
        self.assertIn("*", desktop.title())
        self.assertEqual(design.read_text(), BALL, "the old file")
        self.wait_ball(desktop)
        filler.unlink()
        desktop.key("ctrl+s")
        desktop.wait_title(r"^ball\.wrl - ICOME")
        self.assertNotEqual(design.read_text(), BALL)

    def test_a_folder_that_is_gone(self):
        place = self.folder / "place"
        place.mkdir()
        design = place / "ball.wrl"
        design.write_text(BALL)
        desktop = self.open_ball(design)
        self.nudge(desktop)
        shutil.rmtree(place)
        desktop.key("ctrl+s")
        wait_for("the reason", lambda: shows_banner(desktop, "error"))
        self.assertIn("*", desktop.title())
        place.mkdir()
        desktop.key("ctrl+s")
        desktop.wait_title(r"^ball\.wrl - ICOME")
        self.assertTrue(design.exists())

    def test_closing_while_a_large_design_is_read(self):
        large = self.folder / "large.stl"
        write_large_stl(large)
        desktop = self.start(large).open()
        desktop.quit()
        self.assertEqual(desktop.wait_end(), 0, desktop.printed())

    def test_without_opengl_the_rest_works(self):
        desktop = self.open_ball(environment={"LIBGL_DRIVERS_PATH": "/nonexistent", "LIBGL_ALWAYS_SOFTWARE": "1"})
        self.keep(desktop, "no-opengl")
        window = desktop.whole()
        page = window.part(window.width // 4, window.height // 4, window.width // 2, window.height // 3)
        self.assertEqual(page.share(is_rubber), 0.0, "nothing is drawn")
        self.assertGreater(page.share(lambda red, green, blue: min(red, green, blue) > 150), 0.002, "the reason")
        desktop.key("ctrl+a")
        desktop.key("Delete")
        desktop.wait_title(r"\*")
        desktop.key("ctrl+s")
        desktop.wait_title(r"^ball\.wrl - ICOME")
        self.assertNotIn("Sphere", (self.folder / "ball.wrl").read_text())
        desktop.quit()
        self.assertEqual(desktop.wait_end(), 0, desktop.printed())


class NoDisplayTest(unittest.TestCase):
    """Needs no display, of course."""

    def run_without(self, **more):
        bare = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM")}
        return subprocess.run([PROGRAM, str(DEMO)], capture_output=True, text=True, timeout=120, env={**bare, **more})

    def test_there_is_none(self):
        self.check(self.run_without())

    def test_it_cannot_be_reached(self):
        self.check(self.run_without(DISPLAY=":9999"))

    def check(self, done):
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(done.stdout, "")
        for words in ("display", "icome touch", "icome shot"):
            self.assertIn(words, done.stderr)


if __name__ == "__main__":
    unittest.main()
