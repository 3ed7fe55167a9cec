"""Several servers before one PostgreSQL database, with a NATS bus between them."""
import json
import pathlib
import re
import subprocess
import tempfile
import time
import unittest

from icome_program import PROGRAM, run
from shared_database import Bus, Database, skip_without_servers
from shared_design import BOX, Server, Watcher, line


class DatabaseServer(Server):
    """A server before the database; all have the certificate of the first."""

    def __init__(self, database, files, *arguments):
        self.files = pathlib.Path(files)
        super().__init__(database.address, "--files", str(self.files), *arguments)

    def reached_at(self, link):
        """The link, for whoever comes by this server."""
        return re.sub(r"//[^/]+/", f"//{self.listen}/", link)


class ManyServersTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        skip_without_servers()
        holder = tempfile.TemporaryDirectory(prefix="icome-", ignore_cleanup_errors=True)
        cls.addClassCleanup(holder.cleanup)
        cls.folder = pathlib.Path(holder.name)
        cls.folder.chmod(0o755)  # PostgreSQL's user goes through it
        cls.database = Database(cls.folder / "database")
        cls.addClassCleanup(cls.database.stop)
        cls.bus = Bus(cls.folder)
        cls.addClassCleanup(cls.bus.stop)

    def start(self, name, *more):
        """One more server of the database."""
        first = self.folder / self.id() / "a"
        files = first.parent / name
        files.parent.mkdir(exist_ok=True)
        same = [] if name == "a" else ["--certificate", str(first / "certificate.pem"), "--key", str(first / "key.pem")]
        server = DatabaseServer(self.database, files, "--bus", self.bus.address, *same, *more)
        self.addCleanup(server.__exit__)
        return server

    def invite(self, design, role="own"):
        done = run("invite", design, "--role", role, "--store", self.database.address)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.strip()

    def edit(self, link, script):
        done = subprocess.run([PROGRAM, "edit", link, "--apply", "-", "--json"], input=script, capture_output=True,
                              text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr + done.stdout)
        return json.loads(done.stdout)

    def test_clients_of_all_servers_work_on_one_design(self):
        one, two = self.start("a"), self.start("b")
        self.assertEqual(one.said["fingerprint"], two.said["fingerprint"])
        self.assertNotIn("icome@", one.said["store"], "nor is a user shown")
        link = self.invite("table")
        at_one, at_two = one.reached_at(link), two.reached_at(link)
        with Watcher(at_one, BOX + "\n", name="Ann") as ann, Watcher(at_two, name="Bob") as bob:
            ann.until(lambda it: it.get("applied") == 1)
            bob.until(lambda it: it["event"] == "person" and it["name"] == "Ann")
            done = self.edit(at_two, line(op="move", objects=["box"], by=[1, 0, 0]) + "\n")
            self.assertEqual((done["applied"], done["refused"]), (1, []))
            for who in (ann, bob):
                moved = who.until(lambda it: it["event"] == "edit" and it["kind"] == "translate")
                self.assertEqual(moved["sequence"], 2)
                who.until(lambda it: it["event"] == "durable" and it["sequence"] == 2)
        for at in (at_one, at_two):
            self.assertEqual(json.loads(run("info", at, "--json").stdout)["objects"], 1)
        held = self.edit(at_one, line(op="select", object="box") + "\n" + line(op="rename", object="box", name="a") + "\n")
        self.assertEqual(held["refused"], [])
        large = "".join(line(op="create", shape="sphere", radius=0.1, name=f"ball {i}", at=[i, 0, 0]) + "\n"
                        for i in range(2_000))
        self.assertEqual(self.edit(at_two, large)["applied"], 2_000)
        self.assertEqual(json.loads(run("info", at_one, "--json").stdout)["objects"], 2_001)

    def test_a_server_that_dies_is_taken_over(self):
        one, two, three = self.start("a"), self.start("b"), self.start("c")
        link = self.invite("chair")
        at_one, at_two, at_three = one.reached_at(link), two.reached_at(link), three.reached_at(link)
        self.edit(at_one, BOX + "\n")  # `one` has the design
        with Watcher(at_two, name="Bob") as bob, Watcher(at_three, name="Cid") as cid:
            bob.until(lambda it: it["event"] == "person" and it["name"] == "Cid")
            began = time.monotonic()
            one.kill()
            for who in (bob, cid):
                who.until(lambda it: it["event"] == "state" and it["state"] == "away")
                who.until(lambda it: it["event"] == "state" and it["state"] == "live")
            print(f"taken over after {time.monotonic() - began:.1f} s")  # for docs/collaboration.md
            self.edit(at_three, line(op="rename", object="box", name="of three") + "\n")
            bob.until(lambda it: it["event"] == "edit" and it["sequence"] == 2)
            one.start()
            self.edit(one.reached_at(link), line(op="rename", object="of three", name="of one again") + "\n")
            cid.until(lambda it: it["event"] == "edit" and it["sequence"] == 3)

    def test_nothing_acknowledged_is_lost_whoever_dies(self):
        servers = [self.start(name) for name in "ab"]
        link = self.invite("desk")
        script = "".join(line(op="create", shape="box", size=[0.1, 0.1, 0.1], name=f"box {i}") + "\n"
                         for i in range(400))
        for turn, victim in enumerate((0, 1, 0)):
            at = servers[1 - victim].reached_at(link)
            self.edit(servers[victim].reached_at(link), line(op="create", shape="box", size=[1, 1, 1], name="x") + "\n")
            writer = subprocess.Popen([PROGRAM, "edit", at, "--apply", "-", "--json"], stdin=subprocess.PIPE,
                                      stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            writer.stdin.write(script)
            writer.stdin.close()
            time.sleep(0.05 * turn)
            servers[victim].kill()
            out, error = writer.stdout.read(), writer.stderr.read()
            self.assertEqual(writer.wait(120), 0, error + out)
            writer.stdout.close()
            writer.stderr.close()
            self.assertEqual(json.loads(out)["applied"], 400)
            servers[victim].start()
            self.assertEqual(json.loads(run("info", at, "--json").stdout)["objects"], (turn + 1) * 401)
        done = run("store", "check", "--store", self.database.address)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_a_bus_that_goes_and_comes_back(self):
        one, two = self.start("a"), self.start("b")
        link = self.invite("lamp")
        self.edit(one.reached_at(link), BOX + "\n")
        with Watcher(two.reached_at(link), name="Bob") as bob:
            bob.until(lambda it: it["event"] == "person" and it["name"] == "Bob")
            self.bus.stop()
            bob.until(lambda it: it["event"] == "state" and it["state"] == "away")
            self.bus.start()
            bob.until(lambda it: it["event"] == "state" and it["state"] == "live")

    def test_the_store_of_a_database_is_looked_after(self):
        self.start("a")
        link = self.invite("shelf")
        self.edit(link, BOX + "\n")
        listed = json.loads(run("store", "list", "--store", self.database.address, "--json").stdout)
        self.assertIn("shelf", [it["name"] for it in listed["designs"]])
        out = self.folder / "shelf.wrl"
        self.assertEqual(run("store", "export", "shelf", out, "--store", self.database.address).returncode, 0)
        self.assertIn("Box", out.read_text())
        done = run("store", "backup", self.folder / "x", "--store", self.database.address)
        self.assertEqual(done.returncode, 1)
        self.assertIn("pg_dump", done.stderr)
        self.assertEqual(run("revoke", link, "--store", self.database.address).returncode, 0)
        done = run("info", link)
        while done.returncode == 0:  # a server looks some times a second
            done = run("info", link)
        self.assertIn("revoked", done.stderr)

    def test_wrong_places_are_told(self):
        for arguments, word in (
                (["--store", "postgresql://nobody@127.0.0.1:1/x"], "postgresql://127.0.0.1:1/x"),
                (["--store", self.database.address, "--files", self.folder / "f", "--bus", "nats://127.0.0.1:1"],
                 "nats://127.0.0.1:1"),
                (["--store", self.database.address, "--files", self.folder / "f", "--bus", "127.0.0.1"], "nats://"),
                (["--store", self.folder / "folder", "--bus", self.bus.address], "--bus"),
                (["--store", self.folder / "folder", "--files", self.folder / "f"], "--files")):
            done = run("serve", "--listen", "127.0.0.1:0", *arguments)
            self.assertEqual(done.returncode, 1)
            self.assertIn(word, done.stderr)


if __name__ == "__main__":
    unittest.main()
