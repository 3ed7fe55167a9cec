"""The window in both themes, on small and large screens and at high resolution."""
import unittest

from desktop_program import DEMO, DesktopTest, is_rubber, is_water, wait_for

GROUNDS = {"dark": (0x25, 0x28, 0x2d), "light": (0xf1, 0xf2, 0xf4)}


class LooksTest:
    """What holds on any screen."""

    def look_at(self, theme, name, environment=None, title="demo"):
        desktop = self.start(DEMO, "--theme", theme, environment=environment).open()
        desktop.wait_title(r"^demo\.wrl")
        desktop.wait_scene("knot and sea", lambda it: it.share(is_rubber) > 0.002 and it.share(is_water) > 0.002)
        desktop.settled_scene()
        self.keep(desktop, name)
        ground = GROUNDS[theme]
        whole = desktop.whole()
        self.assertGreater(whole.share(lambda *pixel: pixel == ground, 4), 0.05, "panels in the theme's colour")
        other = GROUNDS["light" if theme == "dark" else "dark"]
        self.assertLess(whole.share(lambda *pixel: pixel == other, 4), 0.02)
        _, _, width, height = desktop.scene_place()
        self.assertGreater(width * height, 0.3 * whole.width * whole.height, "the scene has most of the room")
        desktop.quit()
        self.assertEqual(desktop.wait_end(), 0, desktop.printed())
        self.assertEqual(desktop.printed(), "")


class SmallScreenTest(LooksTest, DesktopTest):
    def test_dark(self):
        self.look_at("dark", "dark-1280x800")

    def test_light(self):
        self.look_at("light", "light-1280x800")


class LargeScreenTest(LooksTest, DesktopTest):
    SIZE = (2560, 1440)

    def test_dark(self):
        self.look_at("dark", "dark-2560x1440")

    def test_light_at_high_resolution(self):
        self.look_at("light", "light-2560x1440-double", environment={"QT_SCALE_FACTOR": "2"})


if __name__ == "__main__":
    unittest.main()
