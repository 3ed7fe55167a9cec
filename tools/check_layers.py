#!/usr/bin/env python3
"""Fails on any #include under src/ that tools/layers.txt does not list.

usage: check_layers.py [ROOT]      ROOT is the project, by default the one this script lies in

Checked are the #include lines of every source and header, the folders that CMake is told to link
(`icome_folder(... USES ...)`), and that headers bring in no third-party header but the few that every
folder shares: a library that hides behind its folder can be replaced, and costs nobody else its parsing.
A folder of src/ or tests/ that holds more than MOST_FILES sources and headers must get rooms.
"""
import pathlib
import re
import sys

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.MULTILINE)
CMAKE_FOLDER = re.compile(r"^\s*icome_folder\(\s*(\w+)([^)]*)\)", re.MULTILINE)

# In headers: the standard library (no dot in the name), the clock of POSIX, the processor's vector
# instructions, and what `base` is made of.
SHARED_HEADERS = re.compile(r"[a-z0-9_]+|time\.h|[a-z]+intrin\.h|Eigen/.+|tl/expected\.hpp")

# Sources and headers that lie side by side; more than these nobody finds their way in.
MOST_FILES = 40

# What the headers of a folder may bring in besides, as it is made of nothing else: windows derive from Qt's.
OWN_HEADERS = {"ui": re.compile(r"Q[A-Za-z]+")}

# Rooms whose headers may bring in a library, as only the sources of the room itself include them.
OWN_ROOMS = {"collab/link/wire": re.compile(r"boost/.+|netinet/.+|sys/socket\.h")}


def read_table(text):
    """Returns {folder: {folder it may use: whether its subfolders too}} from the text of layers.txt."""
    table = {}
    for line in text.splitlines():
        line = line.split("#")[0].strip()
        if line:
            folder, _, uses = line.partition(":")
            table[folder.strip()] = {use.strip("()"): not use.startswith("(") for use in uses.split()}
    return table


def why_not(table, folder, target):
    """Says why a file of `folder` may not include src/`target`; None when it may."""
    used, _, rest = target.partition("/")
    allowed = table[folder]
    if used in (folder, "base") or "*" in allowed:
        return None
    if used not in allowed:
        return f"`{folder}` may not use `{used}`"
    if "/" in rest and not allowed[used]:
        return f"`{folder}` may use only the interfaces of `{used}`, the headers directly in src/{used}"
    return None


def check_includes(path, text, table, source_root):
    """Yields (line number, complaint) for the #include lines of the file at `path` under src/."""
    folder = path.relative_to(source_root).parts[0]
    room = path.relative_to(source_root).parent.as_posix()
    for match in INCLUDE.finditer(text):
        bracket, target = match.groups()
        line = text.count("\n", 0, match.start(2)) + 1
        if bracket == "<":
            own = OWN_ROOMS.get(room) or OWN_HEADERS.get(folder)
            is_free = SHARED_HEADERS.fullmatch(target) or (own and own.fullmatch(target))
            if path.suffix == ".h" and not is_free:
                yield line, f"<{target}> belongs in a source file, hidden behind this header"
        elif target.split("/")[0] not in table:
            yield line, f'"{target}" does not begin with a folder of src/'
        elif target.rpartition("/")[0] in OWN_ROOMS and target.rpartition("/")[0] != room:
            yield line, f'"{target}" is for the sources beside it only'
        else:
            complaint = why_not(table, folder, target)
            if complaint:
                yield line, f'"{target}": {complaint}'


def check_links(text, table):
    """Yields (line number, complaint) for the USES of the icome_folder calls in a CMakeLists.txt."""
    for match in CMAKE_FOLDER.finditer(text):
        folder, arguments = match.groups()
        uses = re.search(r"\bUSES\b(.*?)(?:\b(?:LINKS|EXCEPT)\b|$)", arguments, re.DOTALL)
        for used in uses.group(1).split() if uses else []:
            complaint = why_not(table, folder, used)
            if complaint:
                yield text.count("\n", 0, match.start(1)) + 1, complaint


def check_widths(root):
    """Yields a complaint for each folder of src/ and tests/ that holds too many sources and headers."""
    for area in ("src", "tests"):
        for folder in sorted(path for path in (root / area).rglob("*") if path.is_dir()):
            files = sum(path.suffix in (".h", ".cpp") for path in folder.iterdir())
            if files > MOST_FILES:
                yield f"{folder.relative_to(root)}: {files} sources and headers side by side, {MOST_FILES} are the most"


def check_project(root):
    """Returns every complaint about the project at `root` as `file:line: sentence`, in file order."""
    source_root = root / "src"
    table = read_table((root / "tools/layers.txt").read_text())
    complaints = []
    for path in sorted(source_root.rglob("*")):
        if path.parent == source_root or path.is_dir():
            continue
        if path.suffix in (".h", ".cpp", ".in"):
            folder = path.relative_to(source_root).parts[0]
            if folder in table:
                found = check_includes(path, path.read_text(), table, source_root)
            else:
                found = [(1, f"tools/layers.txt has no row for `{folder}`")]
        elif path.name == "CMakeLists.txt":
            found = check_links(path.read_text(), table)
        else:
            continue
        complaints += [f"{path.relative_to(root)}:{line}: {complaint}" for line, complaint in found]
    return complaints + list(check_widths(root))


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parents[1])
    complaints = check_project(root)
    for complaint in complaints:
        print(complaint)
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
