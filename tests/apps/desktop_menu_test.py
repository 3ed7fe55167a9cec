"""The haptic menu of the window: opened by Space over the scene, used by keys and by the mouse, seen over the design."""
import json
import pathlib
import subprocess
import unittest

from desktop_program import DEMO, DesktopTest, wait_for
from icome_program import PROGRAM

PROPERTIES = pathlib.Path(__file__).resolve().parents[2] / "data" / "menus" / "properties.toml"
SEEN = 0.24  # m of a menu that the scene's shorter side is long


class DesktopMenuTest(DesktopTest):
    def saved_as(self, desktop, name):
        """The design as VRML, of a file that keeps all of it, so that the window asks nothing when it is closed."""
        self.save_as(desktop, name)
        text = self.folder / (name + ".wrl")
        subprocess.run([PROGRAM, "convert", self.folder / name, text], check=True, capture_output=True)
        return text.read_text()

    def save_as(self, desktop, name):
        path = self.folder / name
        desktop.key("ctrl+shift+s")
        desktop.find_window("Save the Design As")
        desktop.key("ctrl+a")
        desktop.type(str(path))
        desktop.key("Return")
        wait_for("the design on the disk", path.exists)
        desktop.wait_title("^" + name.replace(".", r"\.") + " - ICOME")
        return path.read_text(errors="replace")

    def test_a_row_is_chosen_alike_by_keys_mouse_and_wheel(self):
        tabs = json.loads(subprocess.run([PROGRAM, "menu", PROPERTIES, "--json"], capture_output=True, text=True,
                                         check=True).stdout)["items"][0]
        header = tabs["items"][2]
        shapes = header["items"][0]
        self.assertEqual(shapes["scroll"]["count"], 13)
        saved = set()
        for way, theme in (("keys", "light"), ("mouse", "dark"), ("wheel", "light")):
            desktop = self.start("--menu", PROPERTIES, "--theme", theme).open()
            desktop.wait_title(r"^Untitled - ICOME")
            desktop.settled_scene()
            _, _, width, height = desktop.scene_place()
            scale = min(width, height) / SEEN

            def pixel(place):
                return 0.5 * width + scale * place[0], 0.5 * height - scale * place[1]
            desktop.point((width // 2, height // 2))
            before = desktop.settled_scene()
            desktop.key("space")
            desktop.wait_scene("the menu", lambda it: it.changed(before) > 0.015)
            desktop.settled_scene()
            self.keep(desktop, "menu-colour-" + way)
            if way == "keys":
                desktop.point((3, 3))
                desktop.key("Down", "Right", "Right", *["Down"] * 10)
                desktop.settled_scene()
                self.keep(desktop, "menu-rows-" + way)
                desktop.key("Return")
            else:
                desktop.click(pixel(header["centre"]))
                desktop.settled_scene()
                if way == "mouse":
                    for _ in range(6):
                        desktop.click(pixel(shapes["scroll"]["more"]))
                else:
                    for _ in range(3):
                        desktop.click(pixel(shapes["items"][3]["centre"]), button=5)
                desktop.settled_scene()
                self.keep(desktop, "menu-rows-" + way)
                first = 6 if way == "mouse" else 7
                desktop.click(pixel(shapes["items"][9 - first]["centre"]))
            desktop.wait_title(r"^Untitled\* - ICOME")
            desktop.key("space")
            saved.add(self.saved_as(desktop, way + ".icome"))
            desktop.quit()
            self.assertEqual(desktop.wait_end(), 0)
        self.assertEqual(len(saved), 1, saved)
        self.assertIn("polygon", saved.pop())

    def test_digits_are_typed_into_a_number(self):
        desktop = self.start("--menu", PROPERTIES, "--theme", "dark", DEMO).open()
        desktop.wait_title(r"demo")
        desktop.settled_scene()
        _, _, width, height = desktop.scene_place()
        desktop.click((0.37 * width, 0.37 * height))  # the bunny
        desktop.point((0.62 * width, 0.3 * height))
        before = desktop.settled_scene()
        desktop.key("space")
        desktop.wait_scene("the menu", lambda it: it.changed(before) > 0.015)
        desktop.point((3, 3))
        desktop.key("Down", "Right", "Down", "7", "3")  # 7 and 3 are views else
        desktop.settled_scene()
        self.keep(desktop, "menu-number")
        desktop.key("Return")
        desktop.wait_title(r"^demo\.wrl\* - ICOME")
        desktop.settled_scene()
        desktop.key("space")
        desktop.key("ctrl+z")
        desktop.wait_title(r"^demo\.wrl - ICOME")

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
