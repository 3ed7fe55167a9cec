"""Modelling in the window: operations from the menu and by their names, seen before they are applied, undone, redone and
saved; and the worked examples of the thesis, built with keyboard and mouse."""
import json
import pathlib
import unittest

from desktop_form import Form, perform
from desktop_program import DEMO, DesktopTest, is_clay, shows_banner, wait_for
from icome_program import run

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"


def lines_of(obj):
    """An OBJ file's lines: numbers of points and corners, and all the rest as text."""
    for line in obj.read_text().splitlines():
        words = line.split()
        if words[:1] == ["#"]:
            continue
        is_place = words[:1] in (["v"], ["vn"])
        yield (words[0], *map(float, words[1:])) if is_place else line


class ModelTest(DesktopTest):
    def open_empty(self, theme="dark"):
        desktop = self.start("--theme", theme).open()
        desktop.wait_title(r"^Untitled - ICOME")
        desktop.scene_place()
        return desktop

    @staticmethod
    def save_as(desktop, design):
        desktop.key("ctrl+shift+s")
        desktop.find_window("Save the Design As")
        desktop.key("ctrl+a")
        desktop.type(str(design))
        desktop.key("Return")
        desktop.wait_title(rf"^{design.name} - ICOME")


class DesktopModelTest(ModelTest):
    @staticmethod
    def make_box(desktop):
        """Through the menu, with the keyboard."""
        empty = desktop.screen.picture()
        desktop.key("alt+m", "s", "c")
        wait_for("the panel of the operation", lambda: desktop.screen.picture().changed(empty) > 0.005)
        desktop.type("box")
        desktop.key("ctrl+Return")
        desktop.wait_title(r"^Untitled\* - ICOME")

    def test_operations_are_performed_undone_redone_and_saved(self):
        desktop = self.open_empty()
        self.make_box(desktop)
        self.keep(desktop, "model-create")
        desktop.key("Escape")
        # The box is selected: it is what goes.
        desktop.command("delete", look=lambda: self.keep(desktop, "model-palette"))
        design = self.folder / "made.wrl"
        desktop.screen.ask("windowactivate", "--sync", desktop.window)
        desktop.key("ctrl+z", "ctrl+z")
        desktop.wait_title(r"^Untitled - ICOME")
        desktop.key("ctrl+shift+z")
        desktop.wait_title(r"^Untitled\* - ICOME")
        self.save_as(desktop, design)
        self.assertIn("DEF box Transform", design.read_text())
        desktop.key("ctrl+shift+z")
        desktop.wait_title(r"^made\.wrl\* - ICOME")
        desktop.key("ctrl+s")
        desktop.wait_title(r"^made\.wrl - ICOME")
        self.assertNotIn("DEF box", design.read_text())
        desktop.quit()
        self.assertEqual(desktop.wait_end(), 0, desktop.printed())

    def test_what_would_be_done_is_seen_and_taken_back(self):
        desktop = self.open_empty("light")
        empty = desktop.settled_scene()
        form = Form(desktop, "create", "Create").say(shape="torus", radius="300", tube="90")
        desktop.wait_scene("the torus before it is made", lambda it: it.changed(empty) > 0.05)
        desktop.wait_title(r"^Untitled\* - ICOME")
        form.say(radius="30 yards")
        desktop.wait_title(r"^Untitled - ICOME")
        desktop.wait_scene("no torus", lambda it: it.changed(empty) < 0.01)
        self.keep(desktop, "model-wrong")
        form.say(radius="300")
        desktop.wait_title(r"^Untitled\* - ICOME")
        self.keep(desktop, "model-preview")
        # Once for what is typed, once for the form.
        form.cancel()
        form.cancel()
        desktop.wait_title(r"^Untitled - ICOME")
        desktop.quit()
        self.assertEqual(desktop.wait_end(), 0, desktop.printed())


class TechniqueTest(ModelTest):
    def test_the_miniature_is_seen(self):
        desktop = self.start("--theme", "dark", DEMO).open()
        desktop.wait_title(r"^demo\.wrl - ICOME")
        desktop.wait_scene("the demo", lambda it: it.share(is_clay) > 0.005)
        desktop.key("t")

        def low_clay(picture):
            """How much of the scan's colour is in the lower half, where not the scan is but its copy."""
            return sum(y > 0.53 * picture.height for _, y in picture.places(is_clay))
        before = low_clay(desktop.settled_scene())
        desktop.command("world in miniature")
        desktop.screen.ask("windowactivate", "--sync", desktop.window)
        _, _, width, height = desktop.scene_place()
        desktop.point((0.5 * width, 0.7 * height))
        desktop.wait_scene("the copy of the scan", lambda it: low_clay(it) > before + 100)
        self.keep(desktop, "technique-miniature")
        desktop.quit()
        self.assertEqual(desktop.wait_end(), 0, desktop.printed())

    def test_what_was_recorded_is_done_once_more(self):
        begun, recording, saved = (self.folder / it for it in ("begun.icome", "lamp.recording", "saved.icome"))
        script = self.folder / "begun.jsonl"
        script.write_text('{"op": "create", "shape": "box", "size": [0.3, 0.3, 0.3], "name": "lamp"}\n')
        self.assertEqual(run("edit", "new", "--apply", script, "--out", begun).returncode, 0)
        desktop = self.start("--theme", "light", begun).open()
        desktop.wait_title(r"^begun\.icome - ICOME")
        desktop.key("t", "h")
        desktop.command("ray")
        desktop.command("record")
        dialog = desktop.find_window("Record What Is Done Into")
        desktop.screen.ask("windowactivate", "--sync", dialog)
        desktop.key("ctrl+a")
        desktop.type(str(recording))
        desktop.key("Return")
        wait_for("the message that it records", lambda: shows_banner(desktop, "news"))
        desktop.screen.ask("windowactivate", "--sync", desktop.window)
        before = desktop.settled_scene()
        _, _, width, height = desktop.scene_place()
        middle = (width / 2, height / 2)
        desktop.point(middle)
        desktop.drag(middle, (width / 2 + 120, height / 2 - 40), steps=30)
        desktop.wait_title(r"^begun\.icome\* - ICOME")
        desktop.wait_scene("the lamp elsewhere", lambda it: it.changed(before) > 0.02)
        self.keep(desktop, "technique-recording")
        desktop.command("stop recording")
        wait_for("the recording", recording.exists)
        self.keep(desktop, "technique-recorded")
        desktop.screen.ask("windowactivate", "--sync", desktop.window)
        self.save_as(desktop, saved)
        desktop.quit()
        self.assertEqual(desktop.wait_end(), 0, desktop.printed())
        again = self.folder / "again.icome"
        done = run("edit", f"{recording}.icome", "--replay", recording, "--out", again, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(done.stdout)["operations"], 1)
        shapes = []
        for design in (saved, again, begun):
            obj = self.folder / "lamp.obj"
            self.assertEqual(run("convert", design, obj).returncode, 0)
            shapes.append([line for line in obj.read_text().splitlines() if line.startswith("v ")])
        self.assertEqual(shapes[0], shapes[1])
        self.assertNotEqual(shapes[0], shapes[2])


class ExampleInWindowTest(ModelTest):
    """Each is the same as what its script makes."""

    def keep_from_home(self, desktop, name):
        """What is in the form just now, with all of it in sight."""
        if not self.PICTURES:
            return
        desktop.command("home")
        desktop.screen.ask("windowactivate", "--sync", desktop.window)
        desktop.settled_scene()
        self.keep(desktop, name)

    def compare(self, desktop, name):
        """Saves what was built and holds it against the script's."""
        made, meant = self.folder / "made.icome", self.folder / "meant.icome"
        desktop.key("Escape")
        desktop.key("h")
        self.save_as(desktop, made)
        if self.PICTURES:
            desktop.settled_scene()
            self.keep(desktop, f"example-{name}")
        desktop.quit()
        self.assertEqual(desktop.wait_end(), 0, desktop.printed())
        self.assertEqual(run("edit", "new", "--apply", EXAMPLES / f"{name}.jsonl", "--out", meant).returncode, 0)
        reports = [json.loads(run("info", it, "--json").stdout) for it in (made, meant)]
        for key in ("objects", "clones", "triangles", "materials", "shapes", "depth"):
            self.assertEqual(reports[0][key], reports[1][key], key)
        shapes = []
        for design in (made, meant):
            obj = design.with_suffix(".obj")
            self.assertEqual(run("convert", design, obj).returncode, 0)
            shapes.append(list(lines_of(obj)))
        self.assertEqual(len(shapes[0]), len(shapes[1]))
        for one, other in zip(*shapes):
            if isinstance(one, str):
                self.assertEqual(one.replace("made", "meant"), other)
            else:
                self.assertEqual(one[0], other[0])
                for got, want in zip(one[1:], other[1:]):
                    self.assertAlmostEqual(got, want, delta=1e-9)

    def test_two_tables(self):
        desktop = self.open_empty("light")
        perform(desktop, "create", "Create", shape="group", name="table")
        perform(desktop, "create", "Create", shape="box", size=("800", "30", "500"), name="top", at=("0", "705", "0"),
                parent="table")
        perform(desktop, "create", "Create", shape="cylinder", radius="25", height="690", name="leg 1",
                at=("360", "345", "210"), parent="table")
        for number, by in ((2, ("-720", "0", "0")), (3, ("0", "0", "-420")), (4, ("-720", "0", "-420"))):
            perform(desktop, "clone", "Clone", object="leg 1", name=f"leg {number}", by=by)
        perform(desktop, "material", "Material", objects="table", name="wood")
        form = Form(desktop, "copy", "Copy").say(object="table", name="second table", by=("1200", "0", "0"))
        self.keep_from_home(desktop, "model-tables")
        form.apply()
        perform(desktop, "reshape", "Reshape", object="second table/leg 1", radius="40")
        self.keep(desktop, "model-reshape")
        perform(desktop, "material", "Material", objects="second table", name="metal")
        self.compare(desktop, "tables")

    def test_stairs(self):
        desktop = self.open_empty()
        perform(desktop, "create", "Create", shape="box", size=("900", "170", "300"), name="step 1", at=("0", "85", "0"))
        perform(desktop, "material", "Material", name="stone")
        # What was made or changed last is selected, and so what is repeated.
        form = Form(desktop, "repeat", "Repeat").say(count="9", move=("0", "170", "-280"), into="straight stairs")
        self.keep_from_home(desktop, "model-stairs")
        form.apply()
        perform(desktop, "create", "Create", shape="box", size=("800", "40", "260"), name="tread 1",
                at=("2500", "20", "0"))
        perform(desktop, "material", "Material", name="wood")
        perform(desktop, "repeat", "Repeat", count="17", pivot=("2 m", "0", "0"), move=("0", "160", "0"),
                turn=("0", "22.5", "0"), into="spiral stairs")
        perform(desktop, "create", "Create", shape="cylinder", radius="100", height="3.2 m", name="pole",
                at=("2000", "1600", "0"))
        perform(desktop, "material", "Material", name="metal")
        self.compare(desktop, "stairs")

    def test_a_square_becomes_a_sheet(self):
        desktop = self.open_empty()
        perform(desktop, "create", "Create", shape="square", side="400", name="sheet")
        perform(desktop, "subdivide", "Subdivide", levels="5")
        moves = [{"point": [1, 1, z], "by": [0, 0, 0.3]} for z in (1, 0)]
        moves += [{"point": [2, 2, z], "by": [0, 0, -0.3]} for z in (1, 0)]
        form = Form(desktop, "ffd", "Deform").say(cells="3, 3, 1", moves=json.dumps(moves))
        self.keep_from_home(desktop, "model-sheet")
        form.apply()
        perform(desktop, "turn", "Turn", turn=("-90", "0", "0"))
        perform(desktop, "colour", "Colour", colour="#4a7fc1")
        self.compare(desktop, "sheet")

    def test_a_torus_and_a_cone(self):
        desktop = self.open_empty("light")
        script = [json.loads(line) for line in (EXAMPLES / "torus-and-cone.jsonl").read_text().splitlines()
                  if not line.startswith("#")]
        torus, cone = ({key: json.dumps(it[key]) for key in ("points", "steps")} for it in script[:2])
        perform(desktop, "extrude", "Extrude", **torus, ends="joined", name="torus", at=("0", "30", "0"))
        self.keep(desktop, "model-torus")
        perform(desktop, "extrude", "Extrude", **cone, ends="joined", name="cone", at=("260", "0", "0"))
        perform(desktop, "material", "Material", objects="torus", name="rubber")
        perform(desktop, "material", "Material", objects="cone", name="ice")
        self.compare(desktop, "torus-and-cone")


if __name__ == "__main__":
    unittest.main()
