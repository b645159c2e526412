"""Holds the pages against the tree.

Links lead to files and headings that are there. So do paths in `code`, and names of files without a path. Of a table of
files, as in docs/crowd.md, each name is that of a unit in the folder that the page is about. The architecture names every
target of src.
Usage: check_names.py ROOT
"""
import pathlib
import re
import sys

FOLDERS = ("src", "tests", "tools", "bench", "docs", "assets", "python", "cmake")
# Of Godot, which docs/export.md names.
ELSEWHERE = {"physical_bone_3d.cpp", "godot_generic_6dof_joint_3d.cpp", "jolt_generic_6dof_joint_3d.cpp"}
TABLES = {"docs/crowd.md": "src/physics/crowd"}  # page → the folder of its table of files


def prose(text):
    """The page without its blocks of code, whose lines stay as empty ones."""
    return re.sub(r"^```.*?^```", lambda block: "\n" * block.group().count("\n"), text, flags=re.M | re.S)


def anchors(page):
    """The anchors that GitHub gives the headings of a page."""
    found = set()
    for heading in re.findall(r"^#+ +(.*)$", prose(page.read_text()), flags=re.M):
        words = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").strip().lower()
        anchor = re.sub(r"[^\w\- ]", "", words).replace(" ", "-")
        number = 1
        while anchor in found and f"{anchor}-{number}" in found:
            number += 1
        found.add(f"{anchor}-{number}" if anchor in found else anchor)
    return found


def wrong_links(root, page, text):
    for target in re.findall(r"\]\(([^)\s]+)\)", text):
        if re.match(r"[a-z]+:", target):
            continue
        name, _, anchor = target.partition("#")
        file = (page.parent / name).resolve() if name else page
        if not file.exists():
            yield f"leads to {target}, which is not there"
        elif anchor and file.suffix == ".md" and anchor not in anchors(file):
            yield f"leads to {target}, and there is no such heading"


def wrong_paths(root, page, text):
    for path in re.findall(r"`((?:%s)/[\w./*-]+)`" % "|".join(FOLDERS), text):
        if not any(root.glob(path.rstrip("/"))):
            yield f"names {path}, which is not there"


def wrong_files(root, page, text):
    for name in re.findall(r"`(\w+\.(?:hpp|cpp|py))`", text):
        if name not in ELSEWHERE and not any(any((root / folder).rglob(name)) for folder in FOLDERS):
            yield f"names {name}, and no file is called so"


def wrong_units(root, page, text):
    folder = TABLES.get(page.relative_to(root).as_posix())
    rows = re.findall(r"^\| (`.*?`) \|", text, flags=re.M) if folder else []
    for name in re.findall(r"`([\w.*]+)`", " ".join(rows)):
        pattern = name if name.endswith((".hpp", ".cpp")) else name + ".*"
        if not any((root / folder).glob(pattern)):
            yield f"names {name}, which is no file of {folder}"


def unnamed_rooms(root):
    """Targets of src that the architecture leaves out."""
    page = (root / "docs/architecture.md").read_text()
    for target in sorted((root / "src").rglob("CMakeLists.txt")):
        room = target.parent.relative_to(root).as_posix()
        if f"`{room}`" not in page:
            yield f"docs/architecture.md leaves out {room}"


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    pages = [page for page in root.glob("*.md") if page.name != "CHANGELOG.md"] + sorted((root / "docs").glob("*.md"))
    wrong = list(unnamed_rooms(root))
    for page in pages:
        text = prose(page.read_text())
        for check in (wrong_links, wrong_paths, wrong_files, wrong_units):
            wrong += [f"{page.relative_to(root)} {one}" for one in check(root, page, text)]
    print("\n".join(wrong) or f"{len(pages)} pages agree with the tree")
    return 1 if wrong else 0


sys.exit(main())
