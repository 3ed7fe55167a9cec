"""Two people at their windows, on two displays, shape one design on a server; a third one without a window tells
what the server says."""
import json
import unittest

from desktop_program import Desktop, DesktopTest, Screen, shows_banner, wait_for
from icome_program import run
from shared_design import Server, Watcher, line

LEG = line(op="create", shape="box", name="leg", size=[0.2, 0.2, 0.2])


def is_ann(red, green, blue):
    """Of a line in the colour of the second author, who comes after the script."""
    return red < 60 and 130 < green < 190 and 90 < blue < 140


class DesktopSharingTest(DesktopTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.other = Screen(*cls.SIZE)

    @classmethod
    def tearDownClass(cls):
        cls.other.close()
        super().tearDownClass()

    def setUp(self):
        super().setUp()
        self.server = Server(self.folder / "store")
        self.addCleanup(self.server.__exit__)
        self.link = self.server.invite()

    def sit_down(self, screen, name):
        """Somebody's window with the design."""
        home = self.folder / name
        home.mkdir(exist_ok=True)
        desktop = Desktop(screen, home, self.link, "--theme", "light", environment={"ICOME_NAME": name})
        self.addCleanup(self.clear_away, desktop)
        desktop.open()
        desktop.wait_title("^table - ICOME$")
        desktop.settled_scene()
        desktop.key("s")
        return desktop

    @staticmethod
    def middle(desktop):
        _, _, width, height = desktop.scene_place()
        return width / 2, height / 2

    def drag_middle(self, desktop):
        x, y = self.middle(desktop)
        desktop.drag((x, y), (x + 60, y + 10))

    def kept(self, *arguments):
        """`icome keep` as Ann."""
        return run("keep", *arguments, XDG_DATA_HOME=str(self.folder / "Ann" / "data"))

    def apply(self, edit):
        script = self.folder / "script.jsonl"
        script.write_text(edit + "\n")
        self.assertEqual(run("edit", self.link, "--apply", script, ICOME_NAME="Cid").returncode, 0)

    def unsent(self):
        return [it["unsent"] for it in json.loads(self.kept("--list", "--json").stdout)["kept"]]

    def work_alone(self, picture):
        """Ann opens the kept design without the server, drags the leg and leaves: nothing is asked."""
        ann = self.sit_down(self.screen, "Ann")
        wait_for("the word that the server is away", lambda: shows_banner(ann, "warning"))
        bare = ann.settled_scene()
        ann.click(self.middle(ann))
        ann.wait_scene("the outline of the leg", lambda it: it.changed(bare) > 0.003)
        before = ann.settled_scene()
        self.drag_middle(ann)
        ann.wait_scene("the leg elsewhere", lambda it: it.changed(before) > 0.003)
        self.keep(ann, picture)
        ann.quit()
        self.assertEqual(ann.wait_end(), 0)

    def objects(self):
        return json.loads(run("info", self.link, "--json").stdout)["objects"]

    def leg_bounds(self):
        return json.loads(run("info", self.link, "--json").stdout)["bounds"]

    def test_a_kept_design_is_worked_on_without_its_server(self):
        self.apply(LEG)
        first = self.leg_bounds()
        self.assertEqual(self.kept(self.link).returncode, 0)
        self.server.kill()
        self.work_alone("sharing-alone")
        self.assertEqual(self.unsent(), [1])
        self.server.start()
        self.assertEqual(self.leg_bounds(), first)
        sent = self.kept(self.link)
        self.assertEqual(sent.returncode, 0, sent.stderr)
        self.assertIn("was sent", sent.stderr)
        second = self.leg_bounds()
        self.assertNotEqual(second, first)
        self.assertEqual(self.unsent(), [0])

        self.server.kill()
        self.work_alone("sharing-alone-again")
        self.server.start()
        self.apply(line(op="move", objects="leg", by=[1, 0, 0]))
        third = self.leg_bounds()
        refused = self.kept(self.link)
        self.assertEqual(refused.returncode, 1, "there is something to choose")
        self.assertRegex(refused.stderr, r"by others \(\"leg\", by Cid\)")
        self.assertIn("nothing was sent", refused.stderr)
        self.assertEqual(self.leg_bounds(), third)
        self.assertEqual(self.unsent(), [1], "it is not lost either")

        ann = self.sit_down(self.screen, "Ann")
        ann.find_window("Yours and Theirs")
        self.keep(ann, "sharing-choices")
        ann.key("Return")  # both, unless somebody chooses otherwise
        wait_for("Ann's leg beside the other one", lambda: self.objects() == 2)
        ann.quit()
        self.assertEqual(ann.wait_end(), 0)
        self.assertEqual(self.unsent(), [0])

    def test_two_windows_on_two_displays(self):
        with Watcher(self.link, LEG + "\n", name="Script") as third:
            third.until(lambda it: it.get("applied") == 1)
            ann, bob = self.sit_down(self.screen, "Ann"), self.sit_down(self.other, "Bob")
            third.until(lambda it: it["event"] == "person" and it["name"] == "Bob")

            ann.click(self.middle(ann))
            hold = third.until(lambda it: it["event"] == "floor")
            self.assertEqual((hold["holder"], hold["item"]["name"]), ("Ann", "leg"))
            bob.wait_scene("a line in Ann's colour", lambda it: len(it.places(is_ann, 1)) > 60)
            self.keep(bob, "sharing-held")

            self.drag_middle(bob)
            wait_for("the refusal", lambda: shows_banner(bob, "error"))
            self.keep(bob, "sharing-refused")

            before = bob.settled_scene()
            self.drag_middle(ann)
            moved = third.until(lambda it: it["event"] == "edit")
            self.assertEqual((moved["name"], moved["kind"]), ("Ann", "translate"), "Bob's drag went nowhere")
            there = bob.wait_scene("the leg elsewhere", lambda it: it.changed(before) > 0.003)

            ann.key("ctrl+z")
            undone = third.until(lambda it: it["event"] == "edit" and it["name"] == "Ann" and it["sequence"]
                                 > moved["sequence"])
            self.assertEqual(undone["items"][0]["name"], "leg")
            bob.wait_scene("the leg back", lambda it: it.changed(there) > 0.003)
            ann.key("ctrl+shift+a")  # selects nothing: Bob, who has it selected, gets it
            third.until(lambda it: it["event"] == "floor" and it["holder"] == "Bob")
            self.drag_middle(bob)
            third.until(lambda it: it["event"] == "edit" and it["name"] == "Bob")

            self.server.kill()
            wait_for("the word that the server is gone", lambda: shows_banner(bob, "warning"))
            ann.point((5, 5))
            lonely = ann.settled_scene()
            bob.key("ctrl+z")
            self.server.start()
            third.until(lambda it: it["event"] == "edit" and it["name"] == "Bob")
            ann.wait_scene("what Bob did without the server", lambda it: it.changed(lonely) > 0.003)

            self.say(bob, "Hello all")
            said = third.until(lambda it: it["event"] == "chat")
            self.assertEqual((said["name"], said["text"]), ("Bob", "Hello all"))
            self.keep(ann, "sharing-ann")
            self.keep(bob, "sharing-bob")

            bob.quit()
            self.assertEqual(bob.wait_end(), 0)
            third.until(lambda it: it["event"] == "person" and it["name"] == "Bob" and not it["here"])
            ann.quit()
            self.assertEqual(ann.wait_end(), 0)
        whole = json.loads(run("info", self.link, "--json").stdout)
        self.assertEqual(whole["objects"], 1)

    def say(self, desktop, text):
        """In the panel of people, by keyboard: its last stop is the line for words."""
        desktop.command("people")
        desktop.key("Tab", "Tab")
        desktop.type(text)
        desktop.key("Return")


if __name__ == "__main__":
    unittest.main()
