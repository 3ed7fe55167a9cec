"""Designs on a server: `icome serve`, `invite`, `revoke`, `store`, and links wherever a command takes a file."""
import hashlib
import json
import os
import pathlib
import shutil
import signal
import sqlite3
import subprocess
import sys
import time
import unittest
import urllib.error
import urllib.request

from icome_program import PROGRAM, ProgramTest, run
from shared_design import BOX, SECRET, Server, Watcher, line

DEMO = pathlib.Path(__file__).resolve().parents[2] / "data" / "demo.wrl"


class SharedTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.store = self.folder / "store"

    def serve(self, *arguments, **options):
        server = Server(self.store, *arguments, **options)
        self.addCleanup(server.__exit__)
        return server

    def watch(self, *arguments, **options):
        watcher = Watcher(*arguments, **options)
        self.addCleanup(watcher.__exit__)
        return watcher

    def edit(self, link, *lines, code=0):
        script = self.write("script.jsonl", "\n".join(lines) + "\n")
        done = run("edit", link, "--apply", script, "--json")
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return json.loads(done.stdout)

    def info(self, link):
        done = run("info", link, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotRegex(done.stdout + done.stderr, SECRET)
        return json.loads(done.stdout)

    def names(self, link):
        """Of all objects, without those that lie in others."""
        text = self.succeeds("info", link, "--objects", "0").stdout.split("  tree\n")[1]
        return sorted(row.split()[0] for row in text.splitlines())


class ServeTest(SharedTest):
    def test_it_says_where_it_listens_and_ends_when_asked(self):
        for how in (signal.SIGTERM, signal.SIGINT):
            server = self.serve()
            self.assertEqual(set(server.said), {"listening", "fingerprint", "store"})
            self.assertRegex(server.said["fingerprint"], "^sha256:[0-9a-f]{64}$")
            self.assertEqual(server.said["store"], str(self.store))
            self.assertEqual(server.end(how), (0, ""))

    def test_with_nothing_given_it_prints_a_link_that_works(self):
        process = subprocess.Popen([PROGRAM, "serve", "--store", str(self.store), "--listen", "127.0.0.1:0"],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        link = ""
        while "icome://" not in link:
            link = process.stdout.readline()
        self.assertEqual(self.info(link.split("'")[1])["objects"], 0)

    def test_a_store_is_served_by_one_server(self):
        self.serve()
        self.fails("serve", "--store", self.store, "--listen", "127.0.0.1:0", code=1, saying=str(self.store))

    def test_a_store_that_is_taken_away_ends_it(self):
        server = self.serve()
        shutil.rmtree(self.store)
        _, error = server.process.communicate(timeout=60)
        self.assertEqual(server.process.returncode, 1)
        self.assertIn(str(self.store), error)

    def test_without_tls_it_serves_this_machine_only(self):
        self.fails("serve", "--store", self.store, "--listen", "0.0.0.0:0", "--insecure", code=1, saying="0.0.0.0")
        server = self.serve("--insecure")
        link = server.invite()
        self.assertIn("key=none", link)
        self.edit(link, BOX)
        self.fails("info", link.replace("127.0.0.1", "192.0.2.1"), code=1, saying="encryption")

    def test_health_and_metrics_have_a_port_of_their_own(self):
        server = self.serve("--health", "127.0.0.1:0")
        self.edit(server.invite(), BOX)
        at = "http://" + server.said["health"]
        self.assertEqual(json.load(urllib.request.urlopen(at + "/health", timeout=60)), {"status": "ok"})
        metrics = urllib.request.urlopen(at + "/metrics", timeout=60).read().decode()
        self.assertIn("# TYPE icome_edits_committed_total counter", metrics)
        self.assertRegex(metrics, r"(?m)^icome_edits_committed_total 1$")
        self.assertRegex(metrics, r"(?m)^icome_edits_accepted_total 1$")
        with self.assertRaises(urllib.error.HTTPError):
            urllib.request.urlopen(at + "/else", timeout=60)

    def test_who_came_is_in_the_audit_log_without_secrets(self):
        server = self.serve()
        link = server.invite()
        self.edit(link, BOX)
        server.end()
        text = (self.store / "audit.jsonl").read_text()
        rows = [json.loads(row) for row in text.splitlines()]
        self.assertEqual([row["what"] for row in rows], ["join", "leave"])
        self.assertEqual(rows[0]["design"], "table")
        self.assertNotIn(link.split("token=")[1].split("&")[0], text)

    def test_what_cannot_be_printed_is_told(self):
        server = self.serve()
        link = server.invite()
        for arguments in (["invite", "table", "--store", self.store], ["edit", link, "--watch", "--json"]):
            with open("/dev/full", "w") as full:
                done = subprocess.run([PROGRAM, *arguments], stdout=full, stderr=subprocess.PIPE, text=True, timeout=60)
            self.assertEqual(done.returncode, 1, arguments)
            self.assertIn("standard output cannot be written", done.stderr)

    def test_an_audit_log_that_was_moved_away_begins_anew(self):
        server = self.serve()
        link = server.invite()
        self.edit(link, BOX)
        log = self.store / "audit.jsonl"
        log.rename(self.store / "audit.jsonl.1")
        self.edit(link, line(op="create", shape="sphere"))
        server.end()
        for part in (log, self.store / "audit.jsonl.1"):
            self.assertEqual([json.loads(row)["what"] for row in part.read_text().splitlines()], ["join", "leave"])


class ServerProgramTest(SharedTest):
    """icome-server, the program for machines without a display."""
    SERVER = pathlib.Path(PROGRAM).with_name("icome-server")

    def test_it_needs_no_library_of_displays_and_devices(self):
        linked = subprocess.run(["ldd", self.SERVER], capture_output=True, text=True, check=True).stdout
        for library in ("Qt6", "libX11", "libxcb", "wayland", "libGL", "libEGL", "OpenCSG", "GLEW", "cairo", "asound",
                        "spnav", "evdev"):
            self.assertNotIn(library, linked)
        self.assertIn("libsqlite3", linked)

    def test_it_serves_as_icome_does(self):
        server = self.serve(program=str(self.SERVER))
        link = server.invite()
        self.edit(link, BOX)
        self.assertEqual(self.names(link), ["box"])
        invited = subprocess.run([self.SERVER, "invite", "table", "--role", "view", "--store", self.store],
                                 capture_output=True, text=True, check=True).stdout
        self.assertEqual(self.names(invited.strip()), ["box"])
        self.assertEqual(server.end()[0], 0)

    def test_its_help_teaches(self):
        for words in ([], ["serve"], ["invite"], ["store"]):
            done = subprocess.run([self.SERVER, *words, "--help"], capture_output=True, text=True, check=True)
            self.assertIn("icome", done.stdout)
        self.assertEqual(subprocess.run([self.SERVER], capture_output=True).returncode, 2)


class LinkTest(SharedTest):
    def test_an_invitation_is_a_link_and_nothing_else(self):
        server = self.serve()
        done = self.succeeds("invite", "my table", "--role", "own", "--store", self.store)
        self.assertRegex(done.stdout, r"^icome://127\.0\.0\.1:\d+/my%20table#token=[\w-]+&key=sha256:[0-9a-f]{64}\n$")
        self.assertIn(server.said["fingerprint"], done.stdout)
        self.fails("invite", "other", "--role", "edit", "--store", self.store, code=1, saying='no design "other"')
        self.fails("invite", "../x", "--role", "own", "--store", self.store, code=1, saying="name")
        self.fails("invite", "x", "--role", "own", "--for", "8", "--store", self.store, code=1, saying="--for")
        other = self.succeeds("invite", "x", "--role", "own", "--server", "example.org:7", "--store", self.store)
        self.assertTrue(other.stdout.startswith("icome://example.org:7/x#token="))

    def test_links_that_are_not_good_let_nobody_in(self):
        server = self.serve()
        link = server.invite()
        server.invite("lamp")
        token = link.split("token=")[1].split("&")[0]
        for bad in (link.replace(token, token[:-1]), link.replace(token, token[::-1]), link.replace(token, ""),
                    link.replace("/table#", "/lamp#"), link.replace(token, "none")):
            done = self.fails("info", bad, code=1, saying="icome://")
            self.assertNotIn(token[:12], done.stderr)
        short = server.invite("table", "edit", "--for", "1s")
        time.sleep(1.2)
        self.fails("info", short, code=1, saying="expired")
        self.fails("info", link.replace(server.said["fingerprint"][-4:], "0000"), code=1, saying="certificate")
        self.fails("info", link.split("#")[0], code=1, saying="icome://")
        self.fails("info", link[:-3], code=1, saying="fingerprint")

    def test_no_message_shows_the_secret_of_a_link(self):
        link = self.serve().invite()
        for arguments in (("shot", link, link), ("convert", link, self.folder / "x.unknown"), ("info", link + "&x=1"),
                          ("edit", "new", "--apply", "/dev/null", "--out", link), ("info", link.replace("icome", "ICOME", 1) + "x")):
            done = run(*arguments)
            self.assertNotEqual(done.returncode, 0, arguments)
            self.assertNotRegex(done.stdout + done.stderr, SECRET)

    def test_the_secret_may_come_by_the_environment(self):
        link = self.serve().invite()
        token = link.split("token=")[1].split("&")[0]
        done = run("info", link.replace(f"token={token}&", ""), "--json", ICOME_TOKEN=token)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_store_that_lost_something_is_not_taken_for_a_new_one(self):
        server = self.serve()
        link = server.invite()
        self.edit(link, BOX)
        server.end()
        key, designs = self.store / "key.pem", self.store / "designs.sqlite"
        lost, aside = key.read_bytes(), designs.read_bytes()
        key.unlink()
        self.fails("serve", "--store", self.store, code=1, saying="key.pem: is not there, but")
        key.write_bytes(lost)
        key.chmod(0o600)
        designs.write_bytes(b"")
        for command in (["serve"], ["store", "list"], ["store", "check"], ["store", "backup", self.folder / "b"]):
            self.fails(*command, "--store", self.store, code=1, saying="is empty, though")
        designs.unlink()
        self.fails("serve", "--store", self.store, code=1, saying="is not there, though")
        designs.write_bytes(aside)
        self.assertIn("1 design", self.succeeds("store", "list", "--store", self.store).stdout)
        (self.folder / "empty").mkdir(mode=0o700)
        self.fails("store", "list", "--store", self.folder / "empty", code=1, saying="is no store")
        self.assertEqual(list((self.folder / "empty").iterdir()), [])

    def test_who_only_reads_leaves_nothing_in_the_store(self):
        server = self.serve()
        link = server.invite()
        for _ in range(3):
            self.info(link)
        server.end()
        with sqlite3.connect(self.store / "designs.sqlite") as store:
            self.assertEqual(store.execute("SELECT count(*) FROM authors").fetchone(), (0,))

    def test_a_kept_design_is_read_without_its_server(self):
        os.environ["XDG_DATA_HOME"] = str(self.folder / "data")
        self.addCleanup(os.environ.pop, "XDG_DATA_HOME")
        server = self.serve()
        link = server.invite()
        self.edit(link, BOX)
        self.assertIn("No design", self.succeeds("keep", "--list").stdout)
        kept = json.loads(self.succeeds("keep", link, "--json").stdout)
        self.assertEqual((kept["sequence"], kept["objects"]), (1, 1))
        self.edit(link, line(op="create", shape="box", name="later"))
        self.assertEqual(json.loads(self.succeeds("keep", link, "--json").stdout)["objects"], 2)
        server.end()
        done = self.succeeds("info", link, "--json")
        self.assertEqual(json.loads(done.stdout)["objects"], 2)
        self.assertIn("kept here", done.stderr)
        self.assertNotRegex(done.stdout + done.stderr, SECRET)
        self.succeeds("convert", link, self.folder / "offline.wrl")
        rows = json.loads(self.succeeds("keep", "--list", "--json").stdout)["kept"]
        self.assertEqual([(it["objects"], it["unsent"]) for it in rows], [(2, 0)])
        self.assertNotRegex(json.dumps(rows), SECRET)
        folder = self.folder / "data" / "icome" / "kept"
        self.assertEqual(folder.stat().st_mode & 0o077, 0)
        self.succeeds("keep", link, "--forget")
        self.fails("keep", link, "--forget", code=1, saying="not kept")
        self.fails("keep", link, code=1, saying=server.listen)
        self.assertEqual(list(folder.iterdir()), [])
        self.fails("info", link, code=1, saying=server.listen)
        self.fails("keep", code=2, saying="--list")

    def test_shapes_and_pictures_are_fetched_once(self):
        os.environ["XDG_CACHE_HOME"] = str(self.folder / "cache")
        self.addCleanup(os.environ.pop, "XDG_CACHE_HOME")
        link = self.serve().invite()
        self.succeeds("convert", DEMO, link)
        self.succeeds("convert", link, self.folder / "one.wrl")
        contents = self.folder / "cache" / "icome" / "contents"
        files = {it.name: it.stat().st_size for it in contents.iterdir()}
        self.assertTrue(files)
        for name, size in files.items():
            self.assertEqual(hashlib.sha256((contents / name).read_bytes()).hexdigest(), name)
            self.assertGreaterEqual(size, 1 << 14)
        # A damaged one is fetched again.
        broken = contents / min(files)
        broken.write_bytes(b"damaged")
        self.succeeds("convert", link, self.folder / "other.wrl")
        self.assertEqual((self.folder / "one.wrl").read_bytes(), (self.folder / "other.wrl").read_bytes())
        self.assertEqual({it.name: it.stat().st_size for it in contents.iterdir()}, files)

    def test_a_server_that_is_not_there_is_told(self):
        server = self.serve()
        link = server.invite()
        server.end()
        began = time.monotonic()
        self.fails("info", link, code=1, saying=server.listen)
        self.assertLess(time.monotonic() - began, 60)

    def test_revoking_a_link_ends_it_also_for_who_is_connected(self):
        server = self.serve()
        mine, theirs = server.invite(), server.invite("table", "edit")
        watcher = self.watch(theirs)
        watcher.until(lambda told: told.get("state") == "live")
        self.succeeds("revoke", theirs, "--store", self.store)
        watcher.until(lambda told: told.get("state") == "ended")
        self.fails("info", theirs, code=1, saying="revoked")
        self.info(mine)

    def test_who_may_look_may_not_change(self):
        server = self.serve()
        self.edit(server.invite(), BOX)
        report = self.edit(server.invite("table", "view"), line(op="move", objects="box", by=[1, 0, 0]), code=1)
        self.assertEqual(report["applied"], 0)
        self.assertIn("look", report["refused"][0]["why"])


class EditTest(SharedTest):
    def test_a_script_is_told_line_by_line(self):
        link = self.serve().invite()
        report = self.edit(link, BOX, "", "# a word", line(op="nonsense"), line(op="move", objects="none", by=[1, 0, 0]),
                           line(op="undo"), line(op="redo"), code=1)
        self.assertEqual(set(report), {"applied", "refused", "sequence"})
        self.assertEqual(report["applied"], 3)
        self.assertEqual(report["sequence"], 3)
        self.assertEqual([it["line"] for it in report["refused"]], [4, 5])
        self.assertEqual(self.names(link), ["box"])

    def test_an_interrupted_script_tells_what_is_done(self):
        server = self.serve()
        link = server.invite()
        script = self.write("long.jsonl", "\n".join(line(op="create", shape="box", name=f"b{i}") for i in range(50_000)))
        editor = subprocess.Popen([PROGRAM, "edit", link, "--apply", str(script), "--json"], stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, text=True)
        watcher = self.watch(link)
        watcher.until(lambda told: told["event"] == "edit")
        editor.send_signal(signal.SIGINT)
        out, error = editor.communicate(timeout=60)
        self.assertEqual(editor.returncode, 130, error)
        report = json.loads(out)
        self.assertGreater(report["applied"], 0)
        self.assertEqual(report["refused"], [])
        self.assertIn("stays done", error)
        there = len(self.names(link))
        self.assertLessEqual(report["applied"], there)
        self.assertLessEqual(there, report["applied"] + report.get("unknown", 0))

    def test_a_design_goes_up_and_down(self):
        link = self.serve().invite()
        up = json.loads(self.succeeds("convert", DEMO, link, "--json").stdout)
        self.assertEqual(up["sequence"], 1)
        self.assertNotIn("token", up["out"])
        self.succeeds("convert", link, self.folder / "down.wrl")
        above, below = self.info(DEMO), self.info(self.folder / "down.wrl")
        for figure in ("objects", "triangles", "shapes", "bounds"):
            self.assertEqual(above[figure], below[figure], figure)
        self.edit(link, line(op="create", shape="box", name="shelf"))
        model = self.folder / "model.jsonl"
        model.write_text(BOX.replace('"box"}', '"inner"}') + "\n")
        self.succeeds("edit", "new", "--apply", model, "--out", self.folder / "model.wrl")
        self.succeeds("convert", self.folder / "model.wrl", link, "--into", "shelf")
        self.fails("convert", self.folder / "model.wrl", link, "--into", "nothing", code=1, saying="--into")
        self.fails("convert", DEMO, self.folder / "x.wrl", "--into", "shelf", code=1, saying="--into")

    def test_a_link_stands_wherever_a_file_does(self):
        link = self.serve().invite()
        self.edit(link, BOX)
        self.succeeds("shot", link, self.folder / "box.png")
        self.assertEqual((self.folder / "box.png").read_bytes()[:4], b"\x89PNG")
        done = self.succeeds("touch", link, "--seconds", "0.5", "--json")
        self.assertNotRegex(done.stdout + done.stderr, SECRET)

    def test_two_people_shape_one_design(self):
        """Two scripts at once, with conflicts: both see what both did, and the same as who comes later."""
        server = self.serve()
        link = server.invite()
        self.edit(link, BOX)
        scripts = []
        for who in ("a", "b"):
            lines = [line(op="create", shape="box", name=f"{who}{i}") for i in range(100)]
            lines += [line(op="move", objects="box", by=[0.001, 0, 0]) for _ in range(100)]
            scripts.append(self.write(f"{who}.jsonl", "\n".join(lines) + "\n"))
        running = [subprocess.Popen([PROGRAM, "edit", link, "--apply", str(script), "--json"], stdout=subprocess.PIPE,
                                    text=True) for script in scripts]
        reports = [json.loads(it.communicate(timeout=120)[0]) for it in running]
        self.assertEqual([it["refused"] for it in reports], [[], []])
        self.assertEqual(sum(it["applied"] for it in reports), 400)
        self.assertEqual(len(self.names(link)), 201)
        server.end()
        server = self.serve(listen=server.listen)
        self.assertEqual(len(self.names(link)), 201)

    def test_an_owner_takes_away_what_another_holds(self):
        server = self.serve()
        link = server.invite()
        self.edit(link, BOX)
        holder = self.watch(link, script=line(op="select", object="box") + "\n", name="Ann")
        holder.until(lambda told: told.get("event") == "state" and told["state"] == "live")
        take = line(op="take-away", object="box")
        self.assertIn("own", self.edit(server.invite("table", "edit"), take, code=1)["refused"][0]["why"])
        self.edit(link, take, line(op="select", object="box"), line(op="move", objects="box", by=[1, 0, 0]))
        told = holder.until(lambda told: told["event"] == "floor" and told["holder"] is None)
        self.assertIsNotNone(told["taken_by"])

    def test_what_somebody_holds_nobody_else_changes(self):
        server = self.serve()
        link = server.invite()
        self.edit(link, line(op="create", shape="box", name="table"), BOX)
        holder = self.watch(link, script=line(op="select", object="table") + "\n", name="Ann")
        holder.until(lambda told: told.get("event") == "state" and told["state"] == "live")
        watcher = self.watch(link, name="Eve")
        watcher.until(lambda told: told.get("state") == "live")
        refused = self.edit(link, line(op="move", objects="table", by=[1, 0, 0]), line(op="move", objects="box", by=[1, 0, 0]),
                            line(op="select", object="table"), code=1)
        self.assertEqual(refused["applied"], 1)
        self.assertEqual([it["line"] for it in refused["refused"]], [1, 3])
        for it in refused["refused"]:
            self.assertIn('Ann holds "table"', it["why"])
        seen = watcher.until(lambda told: told["event"] == "edit")
        self.assertEqual(seen["kind"], "translate")
        self.assertEqual(seen["items"][0]["name"], "box")
        self.assertEqual(holder.end()[0], 0)
        freed = watcher.until(lambda told: told["event"] == "floor")
        self.assertIsNone(freed["holder"])
        self.assertEqual(self.edit(link, line(op="move", objects="table", by=[1, 0, 0]))["applied"], 1)


class DurabilityTest(SharedTest):
    KILLS = int(os.environ.get("ICOME_SERVER_KILLS", "5"))

    def test_a_killed_server_loses_nothing_that_it_acknowledged(self):
        """kill -9 under load, again and again: whoever was told "applied" finds it after the restart, and those who
        were connected go on by themselves."""
        server = self.serve()
        link = server.invite()
        watcher = self.watch(link)
        watcher.until(lambda told: told.get("state") == "live")
        expected = set()
        for turn in range(self.KILLS):
            lines = [line(op="create", shape="box", name=f"{turn}-{i}") for i in range(300)]
            script = self.write(f"{turn}.jsonl", "\n".join(lines) + "\n")
            editor = subprocess.Popen([PROGRAM, "edit", link, "--apply", str(script), "--json"],
                                      stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            # Somewhere between the first edits and the last, a little later each time.
            watcher.until(lambda told: told["event"] == "edit" and told["sequence"] > len(expected) + 1 + 40 * (turn % 7))
            server.kill()
            server.start()
            out, error = editor.communicate(timeout=120)
            self.assertEqual(editor.returncode, 0, error)
            report = json.loads(out)
            self.assertEqual(report["refused"], [])
            self.assertEqual(report["applied"], 300)
            expected.update(f"{turn}-{i}" for i in range(300))
        self.assertEqual(set(self.names(link)), expected)
        self.assertEqual(server.end()[0], 0)
        self.succeeds("store", "check", "--store", self.store)


class StoreTest(SharedTest):
    def test_a_backup_brings_a_store_back(self):
        server = self.serve()
        link = server.invite()
        self.edit(link, BOX)
        backup = self.folder / "backup"
        self.succeeds("store", "backup", backup, "--store", self.store)
        self.fails("store", "backup", backup, "--store", self.store, code=1, saying=str(backup))
        self.edit(link, line(op="create", shape="box", name="late"))
        self.fails("store", "restore", backup, "--store", self.store, code=1, saying=str(self.store))
        server.end()
        listed = json.loads(self.succeeds("store", "list", "--json", "--store", self.store).stdout)
        self.assertEqual([(it["name"], it["sequence"]) for it in listed["designs"]], [("table", 2)])
        self.succeeds("store", "restore", backup, "--store", self.store)
        out = self.folder / "table.icome"
        self.succeeds("store", "export", "table", out, "--store", self.store)
        self.assertEqual(json.loads(self.succeeds("info", out, "--json").stdout)["objects"], 1)
        self.assertEqual(json.loads(self.succeeds("store", "check", "--json", "--store", self.store).stdout)["findings"],
                         [])
        self.fails("store", "export", "none", out, "--store", self.store, code=1, saying='"none"')

    def test_a_store_that_is_none_is_told(self):
        self.fails("store", "list", "--store", self.folder / "nowhere", code=1, saying="nowhere")
        self.fails("invite", "x", "--role", "own", "--store", self.folder / "nowhere", code=1, saying="nowhere")


if __name__ == "__main__":
    unittest.main()
