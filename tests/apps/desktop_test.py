"""The window as people use it: a design is opened, looked at, touched, changed, saved, and recovered after a crash."""
import re
import shutil
import unittest

from desktop_program import DEMO, DesktopTest, MainThreadWatch, is_clay, is_rubber, is_water, shows_banner, wait_for
from icome_program import BUNNY


def is_selection(red, green, blue):
    """The line around what is selected, of the dark theme."""
    return red > 225 and 110 < green < 190 and blue < 90


def knot_place(design):
    """Where the file says that the knot is."""
    found = re.search(r"DEF Rubber-knot Transform \{\s*translation ([^\n]*?)\s*(?:\n|rotation)", design.read_text())
    return tuple(float(number) for number in found.group(1).split()[:3])


class DesktopUseTest(DesktopTest):
    def setUp(self):
        super().setUp()
        if not BUNNY.exists():
            self.skipTest(f"{BUNNY} is not there: install glmark2-data")
        self.design = self.folder / "desk.wrl"
        shutil.copy(DEMO, self.design)

    def open_desk(self, *arguments):
        """The demo's copy, in the window."""
        desktop = self.start(*(arguments or (self.design, "--theme", "dark"))).open()
        desktop.wait_title(r"^desk\.wrl")
        self.wait_desk(desktop)
        return desktop

    @staticmethod
    def wait_desk(desktop):
        """Waits until all of it is there, and the news that it was opened, which takes room, is gone."""
        def is_there(picture):
            return (picture.share(is_clay) > 0.004 and picture.share(is_rubber) > 0.002 and
                    picture.share(is_water) > 0.002)
        desktop.wait_scene("bunny, knot and sea in sight", is_there)
        wait_for("the end of passing news", lambda: not shows_banner(desktop, "news"))
        # What the news covered is black until it is drawn.
        return desktop.wait_scene("all of the scene", lambda it: it.pixel(5, 5) != (0, 0, 0) and is_there(it))

    @staticmethod
    def knot_in_sight(desktop):
        return desktop.settled_scene().middle(is_rubber)

    def wait_knot(self, desktop, place, near):
        """Waits until the knot is (or is no more) where it was."""
        def look(picture):
            middle = picture.middle(is_rubber)
            return middle and (abs(middle[0] - place[0]) + abs(middle[1] - place[1]) < 6) == near
        return desktop.wait_scene("the knot " + ("back" if near else "elsewhere"), look)

    def move_knot(self, desktop):
        """Selects the knot and drags it; gives where it was and where it is, in the scene."""
        before = self.knot_in_sight(desktop)
        grip = self.a_place(desktop, is_rubber)
        desktop.key("s")
        desktop.click(grip)
        desktop.wait_scene("the line around the knot", lambda it: len(it.places(is_selection)) > 40)
        # Not where it was clicked: soon after, that would be a double click, which zooms.
        desktop.drag((grip[0] + 8, grip[1]), (grip[0] + 78, grip[1] + 30))
        desktop.wait_title(r"desk\.wrl\*")
        self.wait_knot(desktop, before, near=False)
        return before, self.knot_in_sight(desktop)

    @staticmethod
    def a_place(desktop, is_wanted):
        """A place in the scene well within something of that look."""
        picture = desktop.settled_scene()
        places = set(picture.places(is_wanted))
        inner = [(x, y) for x, y in places
                 if all((x + dx, y + dy) in places for dx in (-8, 0, 8) for dy in (-8, 0, 8))]
        middle = picture.middle(is_wanted)
        return min(inner, key=lambda it: (it[0] - middle[0]) ** 2 + (it[1] - middle[1]) ** 2)

    def test_a_design_is_seen_and_looked_at_from_elsewhere(self):
        desktop = self.open_desk()
        before = desktop.settled_scene()
        self.keep(desktop, "demo-dark")
        middle = (before.width / 2, before.height / 2)
        desktop.drag(middle, (middle[0] + 120, middle[1] - 40), button=3)
        desktop.wait_scene("another picture", lambda it: it.changed(before) > 0.05)
        self.wait_desk(desktop)
        self.keep(desktop, "orbited")
        # Closing something that was only looked at asks nothing.
        desktop.quit()
        self.assertEqual(desktop.wait_end(), 0, desktop.printed())

    def test_the_mouse_touches(self):
        desktop = self.open_desk()
        desktop.key("t")
        bunny = self.a_place(desktop, is_clay)
        desktop.point(bunny)
        hovering = desktop.settled_scene()
        desktop.press(bunny)
        left, top, width, height = desktop.scene_place()

        def under_the_scene():
            window = desktop.place()
            return desktop.screen.picture().part(left, top + height, width, window[1] + window[3] - top - height)
        idle = under_the_scene()
        desktop.wait_scene("the hand at another place", lambda it: it.changed(hovering, by=12) > 0.0002)
        wait_for("the force in the strip", lambda: under_the_scene().changed(idle) > 0.001)
        self.keep(desktop, "touching")
        desktop.release()
        self.assertTrue(desktop.is_running())

    def test_moving_is_undone_saved_and_opened_again(self):
        desktop = self.open_desk()
        before, _ = self.move_knot(desktop)
        self.keep(desktop, "moved")
        desktop.key("ctrl+z")
        self.wait_knot(desktop, before, near=True)
        # Not by where it was seen before it was undone: the drag may not have come to its end by then.
        desktop.key("ctrl+shift+z")
        self.wait_knot(desktop, before, near=False)
        after = self.knot_in_sight(desktop)
        desktop.key("ctrl+z")
        self.wait_knot(desktop, before, near=True)
        desktop.key("ctrl+shift+z")
        self.wait_knot(desktop, after, near=True)
        copy = self.folder / "copy.wrl"
        desktop.key("ctrl+shift+s")
        desktop.find_window("Save the Design As")
        desktop.key("ctrl+a")
        desktop.type(str(copy))
        desktop.key("Return")
        desktop.wait_title(r"^copy\.wrl - ICOME")
        self.assertEqual(knot_place(self.design), (-0.075, 0.0245, 0.085))
        self.assertNotEqual(knot_place(copy), knot_place(self.design))
        saved = copy.read_text()
        desktop.quit()
        self.assertEqual(desktop.wait_end(), 0, desktop.printed())
        again = self.start(copy, "--theme", "dark").open()
        again.wait_title(r"^copy\.wrl - ICOME")
        self.wait_desk(again)
        self.keep(again, "opened-again")
        first = copy.stat().st_ino  # a file that is saved is a new one, put in the old one's place
        again.key("ctrl+s")
        wait_for("the file, written again", lambda: copy.stat().st_ino != first)
        self.assertEqual(copy.read_text(), saved, "what was opened is what was saved")
        again.quit()
        self.assertEqual(again.wait_end(), 0, again.printed())

    def test_a_drag_between_many_triangles_does_not_stop_the_window(self):
        """The plinth of the bunny, which has 69,666 triangles, sidewise and down into the desk."""
        desktop = self.open_desk()
        clay = desktop.settled_scene().places(is_clay)
        middle = sum(x for x, _ in clay) / len(clay)
        grip = (middle, max(y for x, y in clay if abs(x - middle) < 8) + 10)
        desktop.key("s")
        desktop.click(grip)
        desktop.wait_scene("the line around the plinth", lambda it: len(it.places(is_selection)) > 40)
        before = desktop.settled_scene()
        watch = MainThreadWatch(desktop.process.pid)
        desktop.press((grip[0] + 8, grip[1]))
        for way in ((20, 4), (40, 10), (60, 30), (20, 40), (-40, 20), (-60, -20), (-90, 10)):
            desktop.point((grip[0] + way[0], grip[1] + way[1]))
            desktop.settled_scene()
        desktop.release()
        desktop.wait_title(r"desk\.wrl\*")
        desktop.wait_scene("the plinth elsewhere", lambda it: it.changed(before) > 0.002)
        self.keep(desktop, "plinth-moved")
        desktop.key("ctrl+z")
        desktop.wait_title(r"^desk\.wrl - ICOME")
        self.assertLess(watch.end(), 2.0, "s that the main thread worked without a pause")
        self.assertTrue(desktop.is_running())

    def test_a_crash_loses_nothing(self):
        desktop = self.open_desk()
        self.move_knot(desktop)
        kept = self.home / "state" / "icome" / "autosave"
        sizes = []

        def is_on_disk():
            sizes.append(sum(file.stat().st_size for file in kept.rglob("*") if file.is_file()))
            return len(sizes) > 10 and sizes[-1] > 0 and len(set(sizes[-10:])) == 1
        wait_for("the work on the disk", is_on_disk)
        desktop.kill()
        again = self.start("--theme", "dark").open()
        again.wait_title(r"desk\.wrl\*")
        again.wait_scene("the knot", lambda it: it.share(is_rubber) > 0.001)
        wait_for("the news that work was recovered", lambda: shows_banner(again, "news"))
        self.keep(again, "recovered")
        again.key("ctrl+s")
        again.wait_title(r"^desk\.wrl - ICOME")
        self.assertNotEqual(knot_place(self.design), (-0.075, 0.0245, 0.085))
        again.quit()
        self.assertEqual(again.wait_end(), 0, again.printed())

    def test_closing_asks_only_when_something_would_be_lost(self):
        desktop = self.open_desk()
        before, _ = self.move_knot(desktop)
        desktop.quit()
        desktop.find_window("Save Changes")
        self.keep(desktop, "asking")
        desktop.key("Escape")
        desktop.screen.ask("windowactivate", "--sync", desktop.window)
        desktop.key("ctrl+z")
        self.wait_knot(desktop, before, near=True)
        desktop.quit()
        self.assertEqual(desktop.wait_end(), 0, desktop.printed())


if __name__ == "__main__":
    unittest.main()
