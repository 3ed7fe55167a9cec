"""A surface whose formula has a t is seen moving in the window."""
import pathlib
import unittest

from desktop_program import DEMO, DesktopTest, is_rubber, is_water, wait_for

CLEARLY = 24  # of 255: more than refining a picture at rest changes
STEP = 7  # of so many pixels one is looked at: all of them take seconds


def changed_share(one, other):
    """The share of pixels that differ clearly."""
    looked = [[plane[::STEP] for plane in picture.planes] for picture in (one, other)]
    pixels = sum(max(abs(a - b) for a, b in zip(before, after)) > CLEARLY
                 for before, after in zip(*(zip(*planes) for planes in looked)))
    return pixels / len(looked[0][0])


class DesktopWavesTest(DesktopTest):
    def show(self, name, phase):
        """The window with the demo, the sea of which has this phase."""
        text = pathlib.Path(DEMO).read_text()
        self.assertIn("sin(75*x + 28*z)", text)
        design = self.folder / name
        design.write_text(text.replace("sin(75*x + 28*z)", f"sin(75*x + 28*z + {phase})"))
        desktop = self.start(design).open()
        desktop.wait_title("^" + name.replace(".", r"\."))
        desktop.wait_scene("knot and sea", lambda it: it.share(is_rubber) > 0.002 and it.share(is_water) > 0.002)
        return desktop

    def test_the_sea_moves_and_goes_on_moving(self):
        desktop = self.show("waves.wrl", "4*t")
        for _ in range(3):
            before = desktop.scene()
            wait_for("the sea to look different", lambda: changed_share(before, desktop.scene()) > 0.003)
        self.keep(desktop, "waves")
        desktop.quit()
        self.assertEqual(desktop.wait_end(), 0, desktop.printed())
        self.assertEqual(desktop.printed(), "")


if __name__ == "__main__":
    unittest.main()
