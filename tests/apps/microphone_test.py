"""icome listen at a microphone: a sink of PulseAudio that plays to nobody is one."""
import array
import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

PROGRAM = os.environ["ICOME_PROGRAM"]
NEEDED = ("pulseaudio", "pactl", "paplay", "parec", "espeak-ng")
PATIENCE = 120  # s


def wait_for(what, condition):
    end = time.monotonic() + PATIENCE
    while not (answer := condition()):
        if time.monotonic() > end:
            raise AssertionError(f"waited in vain for {what}")
        time.sleep(0.05)
    return answer


class MicrophoneTest(unittest.TestCase):
    def setUp(self):
        missing = [it for it in NEEDED if shutil.which(it) is None]
        if missing:
            self.skipTest(f"{', '.join(missing)} not there: tools/install-packages test")
        # A short path: the name of a socket is at most 107 bytes long.
        self.folder = tempfile.TemporaryDirectory(prefix="mic-", dir="/tmp")
        self.at = pathlib.Path(self.folder.name)
        self.addCleanup(self.folder.cleanup)
        (self.at / ".asoundrc").write_text("pcm.!default pulse\nctl.!default pulse\n")
        self.environment = dict(os.environ, HOME=str(self.at), XDG_RUNTIME_DIR=str(self.at),
                                XDG_CONFIG_HOME=str(self.at / "config"))
        for name in ("PULSE_SERVER", "DISPLAY"):
            self.environment.pop(name, None)
        self.start_sound()
        self.addCleanup(self.ask, "pulseaudio", "--kill", may_fail=True)

    def ask(self, *words, may_fail=False):
        done = subprocess.run(words, capture_output=True, text=True, env=self.environment, timeout=PATIENCE)
        if done.returncode != 0 and not may_fail:
            raise AssertionError(f"{words}: {done.stderr}")
        return done.returncode == 0

    def start_sound(self):
        started = self.ask("pulseaudio", "-n", "--daemonize=yes", "--exit-idle-time=-1",
                           "--load=module-native-protocol-unix", "--load=module-null-sink sink_name=ears", may_fail=True)
        if not started or not self.ask("pactl", "set-default-source", "ears.monitor", may_fail=True):
            self.skipTest("PulseAudio does not start here")

    def say(self, sentence):
        recording = self.at / "said.wav"
        self.ask("espeak-ng", "-v", "en-us", "-w", str(recording), sentence)
        self.ask("paplay", str(recording))

    def test_what_is_said_is_done_also_after_the_microphone_was_lost(self):
        out, errors = self.at / "out.jsonl", self.at / "errors"
        with out.open("w") as answers, errors.open("w") as told:
            listening = subprocess.Popen([PROGRAM, "listen", "--json", "--apply", "--out", "heard.icome"], stdout=answers,
                                         stderr=told, env=self.environment, cwd=self.at)
        self.addCleanup(listening.kill)

        def heard():
            return [json.loads(line) for line in out.read_text().splitlines(keepends=True) if line.endswith("\n")]

        def times_told(what):
            return errors.read_text().count(what)

        wait_for("listening", lambda: times_told("listening"))
        self.say("create a small red sphere")
        wait_for("the sphere", lambda: heard() and heard()[0]["accepted"])
        self.assertEqual(heard()[0]["heard"], "create a small red sphere")
        self.ask("pulseaudio", "--kill")
        wait_for("the loss", lambda: times_told("lost"))
        self.start_sound()
        wait_for("listening again", lambda: times_told("listening") == 2)
        self.say("undo that")
        wait_for("the undo", lambda: len(heard()) == 2)
        self.assertEqual(heard()[1]["heard"], "undo that")
        listening.send_signal(signal.SIGINT)
        self.assertEqual(listening.wait(PATIENCE), 0)
        self.assertTrue((self.at / "heard.icome").exists())

    def test_it_is_called_by_a_word_and_does_not_hear_its_own_answers(self):
        # The sink that it speaks to is the one that it listens to.
        out, errors = self.at / "out.jsonl", self.at / "errors"
        with out.open("w") as answers, errors.open("w") as told:
            listening = subprocess.Popen([PROGRAM, "listen", "--json", "--apply", "--wake-word", "computer", "--speak"],
                                         stdout=answers, stderr=told, env=self.environment, cwd=self.at)
        self.addCleanup(listening.kill)

        def heard():
            return [json.loads(line) for line in out.read_text().splitlines(keepends=True) if line.endswith("\n")]

        wait_for("listening", lambda: "listening" in errors.read_text())
        sound = self.at / "all.raw"
        with sound.open("wb") as kept:
            recording = subprocess.Popen(["parec", "--device=ears.monitor", "--rate=16000", "--channels=1",
                                          "--format=s16le"], stdout=kept, env=self.environment)
        self.addCleanup(recording.kill)
        self.say("create a small red sphere")
        wait_for("what is not meant", lambda: heard())
        self.assertFalse(heard()[0]["accepted"])
        self.assertIn("not said to me", heard()[0]["said"])
        self.say("computer, create a small red sphere")
        wait_for("the sphere", lambda: len(heard()) > 1)
        self.assertTrue(heard()[1]["accepted"], heard()[1])
        self.assertEqual(heard()[1]["objects"], ["sphere"])
        before = sound.stat().st_size
        time.sleep(4)  # in which it answers "Small red sphere."
        recording.terminate()
        recording.wait(PATIENCE)
        spoken = array.array("h", sound.read_bytes()[before // 2 * 2:][: 2 * 16000 * 4])
        self.assertGreater(max(map(abs, spoken)), 1000, "nothing was spoken")
        self.assertEqual(len(heard()), 2, heard()[2:])
        self.assertNotIn("lost", errors.read_text())
        listening.send_signal(signal.SIGINT)
        self.assertEqual(listening.wait(PATIENCE), 0)

    def test_a_suspended_output_is_told_and_holds_nothing_up(self):
        self.ask("pactl", "load-module", "module-null-sink", "sink_name=mouth")
        self.ask("pactl", "set-default-sink", "mouth")
        self.ask("pactl", "suspend-sink", "mouth", "1")
        out, errors = self.at / "out.jsonl", self.at / "errors"
        with out.open("w") as answers, errors.open("w") as told:
            listening = subprocess.Popen([PROGRAM, "listen", "--json", "--apply", "--speak"], stdout=answers, stderr=told,
                                         env=self.environment, cwd=self.at)
        self.addCleanup(listening.kill)
        recording = self.at / "said.wav"
        self.ask("espeak-ng", "-v", "en-us", "-w", str(recording), "create a small red sphere")
        wait_for("listening", lambda: "listening" in errors.read_text())
        for count in (1, 2):  # it hears again
            self.ask("paplay", "--device=ears", str(recording))
            wait_for("the sphere", lambda: out.read_text().count("\n") >= count)
            wait_for("what is wrong", lambda: errors.read_text().count("sound output was lost") >= count)
            time.sleep(1)  # what was spoken may come back until then
        listening.send_signal(signal.SIGINT)
        self.assertEqual(listening.wait(PATIENCE), 0)


if __name__ == "__main__":
    unittest.main()
