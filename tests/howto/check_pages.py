"""Compares the code blocks of pages with the regions of compiled files that they name.

A block follows a line `<!-- code: FILE -->`; the region of FILE lies between `// [howto]` and `// [/howto]`, and the
file's includes of the library may come first in the block.
Usage: check_pages.py ROOT [--fix]
"""
import pathlib
import re
import sys
import textwrap

BLOCK = re.compile(r"<!-- code: (\S+) -->\n```cpp\n(.*?)```\n", re.S)


def region(file):
    text = file.read_text()
    lines = re.search(r"// \[howto\]\n(.*?)[ \t]*// \[/howto\]\n", text, re.S)
    if lines is None:
        sys.exit(f"{file}: no region between // [howto] and // [/howto]")
    includes = re.findall(r'#include "[^"]+"\n', text)
    return "".join(includes) + "\n" + textwrap.dedent(lines.group(1))


def main():
    root, fix = pathlib.Path(sys.argv[1]), "--fix" in sys.argv
    wrong = []
    shown = set()
    for name in ("README.md", "docs/howto.md"):
        page = root / name
        text = page.read_text()
        for file, code in BLOCK.findall(text):
            shown.add(file)
            if code != region(root / file):
                wrong.append(f"{name}: the code of {file} differs (check_pages.py ROOT --fix mends it)")
        if fix:
            page.write_text(BLOCK.sub(
                lambda m: f"<!-- code: {m[1]} -->\n```cpp\n{region(root / m[1])}```\n", text))
    for file in (root / "tests/howto").glob("*.cpp"):
        if str(file.relative_to(root)) not in shown:
            wrong.append(f"no page shows {file}")
    if "tests/consumer/main.cpp" not in shown:
        wrong.append("README.md does not show tests/consumer/main.cpp")
    for line in wrong:
        print(line)
    return 1 if wrong and not fix else 0


sys.exit(main())
