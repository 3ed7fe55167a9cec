"""The window of drawings as people use it: drawn in with the mouse, undone, saved, and closed."""
import json
import time
import unittest

from desktop_program import DesktopTest, wait_for
from icome_program import run


class PaperTest(DesktopTest):
    """What windows of drawings have in common."""

    def open_page(self, *arguments):
        """The window, with all of its paper in sight."""
        desktop = self.start("sketch", "open", *arguments, "--theme", "light").open()
        wait_for("white paper", lambda: desktop.whole().pixel(*self.middle(desktop)) == (255, 255, 255))
        return desktop

    @staticmethod
    def middle(desktop):
        """A place on the paper, left of the panels."""
        _, _, width, height = desktop.place()
        return round(0.4 * width), round(0.5 * height)

    def draw(self, desktop, ways):
        """Drags the mouse along ways, from the middle of the paper; pixels."""
        left, top, _, _ = desktop.place()
        x, y = self.middle(desktop)
        for i, (dx, dy) in enumerate(ways):
            desktop.screen.ask("mousemove", "--sync", left + x + dx, top + y + dy)
            if i == 0:
                desktop.screen.ask("mousedown", 1)
        desktop.screen.ask("mouseup", 1)

    @staticmethod
    def ink(desktop):
        """The share of dark pixels on the paper; those of the pointer, which is in the picture, count too."""
        _, _, width, height = desktop.place()
        box = (0.05 * width, 0.28 * height, 0.55 * width, 0.55 * height)
        paper = desktop.whole().part(*map(round, box))
        return paper.share(lambda red, green, blue: red < 120 and green < 120 and blue < 120)

    def draw_and_see(self, desktop, ways):
        """Gives the ink after it, which is more than before."""
        before = self.ink(desktop)
        self.draw(desktop, ways)
        wait_for("the line", lambda: self.ink(desktop) > before + 0.0005)
        desktop.wait_title(r"\*")
        return self.ink(desktop)


class SketchWindowTest(PaperTest):
    def test_a_line_is_drawn_undone_and_saved(self):
        desktop = self.open_page()
        one = self.draw_and_see(desktop, [(-150, 0), (-50, 60), (50, -60), (150, 0)])
        two = self.draw_and_see(desktop, [(-150, 100), (0, 120), (150, 100)])
        self.keep(desktop, "sketch-two-lines")
        desktop.key("ctrl+z")
        wait_for("one line less", lambda: self.ink(desktop) < 0.5 * (one + two))
        file = self.folder / "drawing.svg"
        desktop.key("ctrl+s")
        desktop.find_window("Save the Drawing As")
        desktop.key("ctrl+a")
        desktop.type(str(file))
        desktop.key("Return")
        desktop.wait_title(r"^drawing\.svg - ICOME")
        listed = run("sketch", "list", file, "--json")
        self.assertEqual(listed.returncode, 0, listed.stderr)
        strokes = [it for layer in json.loads(listed.stdout)["layers"] for it in layer["strokes"]]
        self.assertEqual(len(strokes), 1)
        self.assertGreater(strokes[0]["length_mm"], 50)
        desktop.quit()
        self.assertEqual(desktop.wait_end(), 0, desktop.printed())

    def test_the_mouse_moves_a_simulated_pen_that_pushes_back(self):
        desktop = self.open_page("--device", "Touch", "--paper", "glass")
        before = self.ink(desktop)
        left, top, _, _ = desktop.place()
        x, y = self.middle(desktop)
        place = (left + x - 120, top + y)
        desktop.screen.ask("mousemove", "--sync", *place)
        time.sleep(0.5)  # the hand goes there
        desktop.screen.ask("mousedown", 1)
        time.sleep(0.5)  # and down
        for step in range(1, 49):
            desktop.screen.ask("mousemove", "--sync", place[0] + 5 * step, place[1] + step)
            time.sleep(0.01)
        time.sleep(0.3)
        desktop.screen.ask("mouseup", 1)
        wait_for("the line", lambda: self.ink(desktop) > before + 0.0005)
        self.keep(desktop, "sketch-felt-pen")
        desktop.wait_title(r"\*")
        desktop.key("ctrl+z")
        wait_for("no line", lambda: self.ink(desktop) < before + 0.0005)
        desktop.wait_title(r"^Untitled drawing - ICOME")
        desktop.quit()
        self.assertEqual(desktop.wait_end(), 0, desktop.printed())

    def test_closing_asks_while_a_drawing_is_not_saved(self):
        desktop = self.open_page()
        self.draw_and_see(desktop, [(-150, 0), (0, 40), (150, 20)])
        desktop.quit()
        desktop.find_window("Save Changes")
        desktop.key("Escape")
        desktop.screen.ask("windowactivate", "--sync", desktop.window)
        desktop.key("ctrl+z")
        desktop.wait_title(r"^Untitled drawing - ICOME")
        desktop.quit()
        self.assertEqual(desktop.wait_end(), 0, desktop.printed())

    def test_a_file_that_is_not_there_is_told_above_the_paper(self):
        desktop = self.open_page(self.folder / "missing.svg")
        bad = (0xd1, 0x2f, 0x2a)  # the mark of an error in the light theme
        wait_for("the message", lambda: desktop.whole().longest_column(bad) >= 16)
        desktop.quit()
        self.assertEqual(desktop.wait_end(), 0, desktop.printed())


class DesignDrawingTest(PaperTest):
    """A drawing that is an object of the design, drawn on in a window of its own."""

    def strokes_in(self, design):
        listed = run("sketch", "list", design, "--json")
        self.assertEqual(listed.returncode, 0, listed.stderr)
        return sum(len(layer["strokes"]) for layer in json.loads(listed.stdout)["layers"])

    def open_design(self):
        edits = self.folder / "edits.jsonl"
        edits.write_text('{"op": "draw", "way": [[20, 180], [280, 180]]}\n')
        svg, design = self.folder / "paper.svg", self.folder / "paper.icome"
        for words in (("edit", "new", "--apply", edits, "--out", svg), ("model", svg, design, "--drawing")):
            done = run("sketch", *words)
            self.assertEqual(done.returncode, 0, done.stderr)
        desktop = self.start("--theme", "light", design).open()
        desktop.wait_title(r"^paper\.icome - ICOME")
        return desktop, design

    def save(self, desktop, design, strokes):
        desktop.screen.ask("windowactivate", "--sync", desktop.window)
        desktop.key("ctrl+s")
        wait_for(f"{strokes} strokes in the file", lambda: self.strokes_in(design) == strokes)

    def test_what_is_drawn_is_in_the_design_at_once_and_undone_there(self):
        desktop, design = self.open_design()
        main = desktop.window
        desktop.key("ctrl+a")
        desktop.command("draw on it")
        desktop.window = desktop.find_window("in the design")
        self.draw_and_see_in_design(desktop)
        self.keep(desktop, "sketch-in-design")
        desktop.key("ctrl+s")  # it is kept in the design: nothing to ask
        desktop.window = main
        desktop.wait_title(r"\*")
        self.save(desktop, design, 2)
        desktop.key("ctrl+z")
        self.save(desktop, design, 1)
        desktop.quit()
        self.assertEqual(desktop.wait_end(), 0, desktop.printed())

    def draw_and_see_in_design(self, desktop):
        wait_for("white paper", lambda: desktop.whole().pixel(*self.middle(desktop)) == (255, 255, 255))
        before = self.ink(desktop)
        self.draw(desktop, [(-150, 0), (-50, 60), (50, -60), (150, 0)])
        wait_for("the line", lambda: self.ink(desktop) > before + 0.0005)


if __name__ == "__main__":
    unittest.main()
