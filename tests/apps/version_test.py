"""`icome --version` prints the version that CMakeLists.txt states."""
import os
import subprocess
import unittest


class VersionTest(unittest.TestCase):
    def test_version_is_that_of_the_project(self):
        printed = subprocess.run([os.environ["ICOME_PROGRAM"], "--version"], check=True, capture_output=True, text=True)
        self.assertIn(os.environ["ICOME_VERSION"], printed.stdout.split())


if __name__ == "__main__":
    unittest.main()
