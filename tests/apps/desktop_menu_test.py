"""The haptic menu of the window: opened by Space over the scene, used by keys and by the mouse, seen over the design."""
import unittest

from desktop_program import DEMO, DesktopTest, wait_for


class DesktopMenuTest(DesktopTest):
    def test_keys_make_a_shape_and_it_is_seen(self):
        desktop = self.start("--theme", "light").open()
        desktop.wait_title(r"^Untitled - ICOME")
        desktop.settled_scene()
        left, top, width, height = desktop.scene_place()
        desktop.screen.ask("mousemove", left + width // 2, top + height // 2)
        before = desktop.settled_scene()
        desktop.key("space")
        desktop.wait_scene("the menu", lambda it: it.changed(before) > 0.015)
        desktop.key("Down", "Right")
        desktop.settled_scene()
        self.keep(desktop, "menu-keys")
        desktop.key("Return")
        desktop.wait_title(r"^Untitled\* - ICOME")
        desktop.settled_scene()
        desktop.key("ctrl+z")
        desktop.wait_title(r"^Untitled - ICOME")

    def test_it_colours_what_is_selected_in_both_themes(self):
        for theme in ("light", "dark"):
            desktop = self.start("--theme", theme, DEMO).open()
            desktop.wait_title(r"demo")
            desktop.settled_scene()
            _, _, width, height = desktop.scene_place()
            desktop.click((0.37 * width, 0.37 * height))  # the bunny
            desktop.point((0.62 * width, 0.3 * height))
            desktop.settled_scene()
            desktop.key("space")
            desktop.settled_scene()
            desktop.key("Down", "Down", "Right", "Down", "Down")
            desktop.settled_scene()
            self.keep(desktop, "menu-demo-" + theme)
            desktop.key("Return")
            desktop.wait_title(r"^demo\.wrl\* - ICOME")
            desktop.key("ctrl+z")
            desktop.wait_title(r"^demo\.wrl - ICOME")
            desktop.quit()
            self.assertEqual(desktop.wait_end(), 0)


if __name__ == "__main__":
    unittest.main()
