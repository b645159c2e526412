#!/usr/bin/env python3
"""Compares the lines of lutka_hashes of several builds (tools/determinism): COMPILER-KIND-PORTABLE.txt each."""

import pathlib
import sys


def lines_of(file):
    """{(solver, instruction set, threads): hashes} of a build, and the profile's hash."""
    rows = [line.split() for line in file.read_text().splitlines()]
    return {tuple(row[:3]): " ".join(row[3:]) for row in rows}


def groups_that_must_agree(build, key):
    """What else has to give the same hashes: a label a promise."""
    compiler, kind, portable = build
    solver, instruction_set, _ = key
    if solver == "profile":
        yield "profile"
        return
    yield f"{solver} {instruction_set}, threads: {compiler} {kind} {portable}"
    if solver != "crowd":
        yield f"{solver}, all builds"
        return
    if portable == "ON" or instruction_set == "sse2":
        yield "crowd, nothing fused: all builds, all instruction sets"
    else:
        yield f"crowd, fused: {compiler}, release and debug, AVX2 and AVX-512"


def first_difference(hashes):
    rounds = [each.split() for each in hashes]
    for index, column in enumerate(zip(*rounds)):
        if len(set(column)) > 1:
            return f"from {0.25 * (index + 1)} s on"
    return "in length"


def main():
    promises = {}
    for name in sys.argv[1:]:
        file = pathlib.Path(name)
        build = tuple(file.stem.rsplit("-", 2))
        for key, hashes in lines_of(file).items():
            for promise in groups_that_must_agree(build, key):
                promises.setdefault(promise, {}).setdefault(hashes, []).append((build, key))
    failed = False
    for promise, found in sorted(promises.items()):
        runs = sum(len(who) for who in found.values())
        good = len(found) == 1
        failed = failed or not good
        print(f"{'same' if good else 'DIFFER'}  {runs:3} runs  {promise}")
        if good:
            continue
        print("        " + first_difference(list(found)))
        for who in found.values():
            print("        " + "; ".join(f"{'-'.join(build)} {' '.join(key)}" for build, key in who[:6]))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
