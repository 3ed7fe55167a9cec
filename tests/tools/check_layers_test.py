"""The layer check itself: small projects with one fault each must be refused for that fault."""
import importlib.util
import pathlib
import tempfile
import unittest

ROOT = pathlib.Path(__file__).parents[2]
specification = importlib.util.spec_from_file_location("check_layers", ROOT / "tools/check_layers.py")
check_layers = importlib.util.module_from_spec(specification)
specification.loader.exec_module(check_layers)


class CheckLayersTest(unittest.TestCase):
    def complaints(self, files):
        """What the check says of a project that has these files ({path: text}) and the real table."""
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in {**files, "tools/layers.txt": (ROOT / "tools/layers.txt").read_text()}.items():
                path = root / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            return check_layers.check_project(root)

    def test_listed_edges_pass(self):
        self.assertEqual([], self.complaints({
            "src/haptics/a.h": '#pragma once\n#include <vector>\n#include <Eigen/Core>\n#include "base/vector.h"\n'
                               '#include "geometry/a.h"\n#include "haptics/servo/b.h"\n',
            "src/haptics/a.cpp": '#include <fmt/format.h>\n#include "devices/pointer_device.h"\n',
            "src/apps/a.h": '#include "study/a.h"\n',
            "src/apps/a.cpp": '#include <CLI/CLI.hpp>\n',
        }))

    def test_an_edge_that_is_not_listed_is_refused(self):
        self.assertEqual(["src/geometry/a.cpp:2: \"haptics/a.h\": `geometry` may not use `haptics`"],
                         self.complaints({"src/geometry/a.cpp": '#include <vector>\n#include "haptics/a.h"\n'}))

    def test_edges_are_not_inherited(self):
        # ui may use study, and study stats and session; session uses haptics, but ui may not.
        (complaint,) = self.complaints({"src/ui/a.h": '#include "study/a.h"\n  #  include "haptics/a.h"\n'})
        self.assertIn("src/ui/a.h:2:", complaint)

    def test_a_back_end_is_not_an_interface(self):
        for folder in ("haptics", "interaction", "speech", "cutout"):
            (complaint,) = self.complaints({f"src/{folder}/a.cpp": '#include "devices/simulated/hand.h"\n'})
            self.assertIn("only the interfaces of `devices`", complaint)
        self.assertEqual([], self.complaints({"src/session/a.cpp": '#include "devices/simulated/hand.h"\n'}))

    def test_a_third_party_header_stays_in_a_source_file(self):
        (complaint,) = self.complaints({"src/files/a.h": "#include <assimp/scene.h>\n",
                                        "src/files/a.cpp": "#include <assimp/scene.h>\n"})
        self.assertIn("src/files/a.h:1: <assimp/scene.h> belongs in a source file", complaint)

    def test_windows_are_made_of_qt(self):
        self.assertEqual([], self.complaints({"src/ui/a.h": "#include <QWidget>\n"}))
        (complaint,) = self.complaints({"src/session/a.h": "#include <QWidget>\n"})
        self.assertIn("<QWidget> belongs in a source file", complaint)

    def test_a_room_of_its_own_library_keeps_its_headers_to_itself(self):
        wire = {"src/collab/link/wire/a.h": "#include <boost/asio/buffer.hpp>\n"}
        self.assertEqual([], self.complaints({**wire, "src/collab/link/wire/a.cpp": '#include "collab/link/wire/a.h"\n'}))
        (complaint,) = self.complaints({**wire, "src/collab/link/b.cpp": '#include "collab/link/wire/a.h"\n'})
        self.assertIn('src/collab/link/b.cpp:1: "collab/link/wire/a.h" is for the sources beside it only', complaint)
        (complaint,) = self.complaints({"src/collab/link/b.h": "#include <boost/asio/buffer.hpp>\n"})
        self.assertIn("belongs in a source file", complaint)

    def test_a_wide_folder_is_refused(self):
        headers = {f"src/geometry/a{i}.h": "#pragma once\n" for i in range(40)}
        self.assertEqual([], self.complaints(headers))
        self.assertEqual([], self.complaints({**headers, "src/geometry/mesh/b.h": "#pragma once\n"}))
        self.assertEqual(["src/geometry: 41 sources and headers side by side, 40 are the most"],
                         self.complaints({**headers, "src/geometry/b.cpp": ""}))

    def test_an_include_names_its_folder(self):
        (complaint,) = self.complaints({"src/files/a.cpp": '#include "mesh.h"\n'})
        self.assertIn("does not begin with a folder", complaint)

    def test_a_folder_without_a_row_is_refused(self):
        (complaint,) = self.complaints({"src/misc/a.h": "#pragma once\n"})
        self.assertIn("no row for `misc`", complaint)

    def test_linking_is_held_to_the_same_table(self):
        (complaint,) = self.complaints(
            {"src/geometry/CMakeLists.txt": "icome_folder(geometry\n  USES realtime\n  LINKS fmt::fmt)\n"})
        self.assertEqual("src/geometry/CMakeLists.txt:1: `geometry` may not use `realtime`", complaint)
        self.assertEqual([], self.complaints(
            {"src/haptics/CMakeLists.txt": "icome_folder(haptics USES geometry devices LINKS fmt::fmt)\n"}))


if __name__ == "__main__":
    unittest.main()
