"""Operands of solids and projectors of pictures are dragged in the window by the outlines that they are seen by."""
import pathlib
import shutil
import unittest

from desktop_program import DesktopTest, wait_for
from icome_program import run

WOOD = pathlib.Path(__file__).resolve().parents[2] / "examples" / "wood.png"
PLATE = """
{"op": "create", "shape": "box", "name": "plate", "size": [0.3, 0.04, 0.2]}
{"op": "create", "shape": "cylinder", "name": "drill", "radius": 0.03, "height": 0.12, "at": [0.08, 0, 0]}
{"op": "combine", "objects": ["plate", "drill"], "how": "difference"}
"""
SHEET = """
{"op": "create", "shape": "square", "name": "sheet", "side": 0.2, "turn": [-90, 0, 0]}
{"op": "subdivide", "object": "sheet", "levels": 2}
{"op": "texture", "object": "sheet", "file": "wood.png", "size": [0.1, 0.1, 0.1]}
"""


def is_ghost(red, green, blue):
    """Of an operand that is selected."""
    return 70 < red < 150 and green < 110 and blue > 150 and blue > 1.5 * green


def is_projector(red, green, blue):
    return red > 160 and green < 100 and 90 < blue < 180


class DesktopPartsTest(DesktopTest):
    def open_made(self, script, name):
        """The window with what a script makes, all of it selected."""
        shutil.copy(WOOD, self.folder / "wood.png")
        lines = self.folder / "script.jsonl"
        lines.write_text(script)
        design = self.folder / name
        done = run("edit", "new", "--apply", lines, "--out", design)
        self.assertEqual(done.returncode, 0, done.stderr)
        desktop = self.start(design, "--theme", "light").open()
        desktop.wait_title("^" + name.replace(".", r"\."))
        desktop.settled_scene()
        desktop.key("s", "ctrl+a")
        return desktop

    def drag_and_undo(self, desktop, is_line, name):
        """Drags what is seen of an outline uppermost, and takes that back."""
        before = desktop.wait_scene("the outline", lambda it: len(it.places(is_line, 1)) > 60)
        before = desktop.settled_scene()
        grip = min(before.places(is_line, 1), key=lambda it: it[1])
        self.keep(desktop, name)
        desktop.drag(grip, (grip[0] - 60, grip[1] + 15))
        desktop.wait_title(r"\.icome\*")
        moved = desktop.wait_scene("it elsewhere", lambda it: it.changed(before) > 0.003)
        desktop.point((5, 5))
        desktop.settled_scene()
        self.keep(desktop, name + "-moved")
        desktop.key("ctrl+z")
        desktop.wait_title(r"\.icome - ICOME")
        desktop.wait_scene("it back", lambda it: it.changed(moved) > 0.003 and it.changed(before) < 0.003)
        return desktop

    def test_a_hole_is_dragged_by_its_ghost(self):
        self.drag_and_undo(self.open_made(PLATE, "plate.icome"), is_ghost, "part-hole")

    def test_a_picture_is_moved_by_its_projector(self):
        desktop = self.drag_and_undo(self.open_made(SHEET, "sheet.icome"), is_projector, "part-picture")
        desktop.quit()
        wait_for("the end", lambda: not desktop.is_running())


if __name__ == "__main__":
    unittest.main()
