"""Voice commands of the window: typed, and spoken by a synthetic voice that a recording stands for."""
import shutil
import subprocess
import unittest

from desktop_program import DesktopTest


class DesktopVoiceTest(DesktopTest):
    def test_typed_sentences_make_a_scene(self):
        desktop = self.start("--theme", "light").open()
        desktop.wait_title(r"^Untitled - ICOME")
        empty = desktop.settled_scene()
        desktop.key("F8")
        for sentence in ("a large red box", "a blue cone on it", "two small green spheres left of the box"):
            desktop.type(sentence)
            desktop.key("Return")
        desktop.wait_title(r"^Untitled\* - ICOME")
        desktop.key("Escape", "Home")
        desktop.wait_scene("the things", lambda it: it.changed(empty) > 0.02)
        desktop.settled_scene()
        self.keep(desktop, "voice-typed")
        desktop.key("F8", "F8")
        desktop.type("select the green sphere")
        desktop.key("Return")
        desktop.settled_scene()
        self.keep(desktop, "voice-which")
        desktop.key("Escape", "ctrl+z", "ctrl+z", "ctrl+z")
        desktop.wait_title(r"^Untitled - ICOME")

    @unittest.skipUnless(shutil.which("espeak-ng"), "espeak-ng, which speaks here, is not installed")
    def test_a_voice_is_heard_and_done(self):
        recording = self.folder / "said.wav"
        subprocess.run(["espeak-ng", "-v", "en-us", "-w", recording, "create a small red sphere"], check=True)
        desktop = self.start("--microphone", recording).open()
        desktop.wait_title(r"^Untitled - ICOME")
        desktop.key("F8", "Tab", "space")  # the button that listens
        desktop.wait_title(r"^Untitled\* - ICOME")
        desktop.settled_scene()
        self.keep(desktop, "voice-heard")
        desktop.quit()


if __name__ == "__main__":
    unittest.main()
