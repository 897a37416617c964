#!/usr/bin/env python3
"""Do the tests notice? Plants the faults of faults.py one at a time and runs the tests on each.

    tests/mutation/mutate.py [--only PATTERN] [--new] [--from NUMBER] [--table FILE] [--check]

Works on a copy of what is committed, in build/mutation, and takes one to three minutes per fault, after the
tests have all passed once on the copy as it is: a test that fails anyway notices nothing. Ends with status 1
if a fault goes unnoticed. The test that noticed a fault before (result.md) comes first, then those of the
fault's own room; those that drive the command, and the kept velocities, only where the others notice nothing.
A fault that the compiler refuses counts as noticed, and is told apart.
"""

import argparse
import io
import pathlib
import re
import subprocess
import sys
import tarfile

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from faults import FAULTS  # noqa: E402

HOME = pathlib.Path(__file__).resolve().parents[2]
COPY = HOME / "build/mutation/source"
BUILD = HOME / "build/mutation/build"
ROOMS = ["engine", "physics", "scenarios", "io", "properties"]  # tests_ROOM is the program, ROOM the label
REST = ["reliability", "cli|fuzz|package|python|manual", "regression"]  # labels, after the room's own programs
RESULT = HOME / "tests/mutation/result.md"
COMPILER = "the compiler, not a test"


def run(*command, **options):
    return subprocess.run(command, text=True, capture_output=True, **options)


def build(targets):
    return run("cmake", "--build", BUILD, "--target", *targets).returncode == 0


def first_failure(*selection):
    """The name of a test that fails, or None."""
    tests = run("ctest", "--test-dir", BUILD, *selection, "--stop-on-failure", "-j2", "--timeout", "200")
    failed = re.findall(r"^\s*\d+ - (.*?) \((?!Skipped)(?:\S+\s?)+\)", tests.stdout, re.M)
    return failed[0] if failed else (None if tests.returncode == 0 else "?")


def noticed_before():
    """{fault: beginning of the name of the test} by the kept tables"""
    rows = re.findall(r"^\| (.+?) \| `.+?` \| (\w+/.+?)(?: \(since .*)? \|$", RESULT.read_text(), re.M)
    return dict(rows)


def stages(file, test):
    """[(what to build, which tests to run)]; `test` has noticed the fault before, or is None."""
    own = file.split("/")[0]
    if test:
        room = test.split("/")[0]
        yield [f"tests_{room}" if room in ROOMS else "all"], ("-R", "^" + re.escape(test))
    for room in sorted(ROOMS, key=lambda room: room != own):
        yield [f"tests_{room}"], ("-L", f"^{room}$")
    for labels in REST:
        yield ["all"], ("-L", f"^({labels})$")


def noticed_by(file, test=None):
    for targets, selection in stages(file, test):
        name = first_failure(*selection) if build(targets) else COMPILER
        if name:
            return name
    return None


def plant(path, text, replacement):
    source = path.read_text()
    path.write_text(source.replace(text, replacement))
    return source


def check_texts(sources):
    for what, file, text, _ in FAULTS:
        if (sources / file).read_text().count(text) != 1:
            raise SystemExit(f"{what}: its text does not stand in {file} exactly once")


def check_rows():
    """Of the kept table: each names a fault that there is, and the file in which it is now."""
    files = {what: file for what, file, _, _ in FAULTS}
    for what, file in re.findall(r"^\| (.+?) \| `(.+?)` \| ", RESULT.read_text(), re.M):
        if files.get(what) != file:
            where = f"is in {files[what]}" if what in files else "is gone"
            raise SystemExit(f"{RESULT.name}: {what} ({file}): this fault {where}")


def update_copy():
    """Only files that differ are written: a build of before is used, and forgets a fault that was left in. What is not
    committed any more goes."""
    files = subprocess.run(["git", "-C", HOME, "archive", "HEAD"], stdout=subprocess.PIPE, check=True)
    with tarfile.open(fileobj=io.BytesIO(files.stdout)) as archive:
        committed = {COPY / name for name in archive.getnames()}
        for path in COPY.rglob("*"):
            if path.is_file() and path not in committed:
                path.unlink()
        for member in filter(tarfile.TarInfo.isfile, archive):
            path, content = COPY / member.name, archive.extractfile(member).read()
            if not path.exists() or path.read_bytes() != content:
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(content)
                path.chmod(member.mode)


def prepare():
    update_copy()
    subprocess.run(["cmake", "-S", COPY, "-B", BUILD, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Debug",
                    "-DCMAKE_CXX_FLAGS_DEBUG=-O1", "-DRIESEL_BENCH=OFF",
                    "-DCMAKE_UNITY_BUILD=ON"],  # a header that changes costs half the time
                   check=True, stdout=subprocess.DEVNULL)
    check_texts(COPY)


def require_passing_tests():
    """All that may be asked, and all that is to be built."""
    print("The tests without a fault", flush=True)
    name = noticed_by("")
    if name == COMPILER:
        raise SystemExit("what is committed does not build")
    if name:
        raise SystemExit(f"{name} fails without any fault: as long as it does, it notices nothing")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="", metavar="PATTERN",
                        help="faults whose name or file has this regular expression in it")
    parser.add_argument("--new", action="store_true", help=f"only those that {RESULT.name} does not have")
    parser.add_argument("--from", dest="first", type=int, default=1, metavar="NUMBER",
                        help="leave the first faults out: begin with this one")
    parser.add_argument("--table", type=pathlib.Path, help="the result as a Markdown table")
    parser.add_argument("--check", action="store_true",
                        help=f"only look whether all of them can be planted, and the rows of {RESULT.name} are of them")
    options = parser.parse_args()

    if options.check:
        check_texts(HOME)
        check_rows()
        return 0
    prepare()
    require_passing_tests()
    before, rows, unnoticed, refused = noticed_before(), [], 0, 0
    for what, file, text, replacement in FAULTS[options.first - 1:]:
        if not re.search(options.only, f"{what} {file}") or (options.new and what in before):
            continue
        original = plant(COPY / file, text, replacement)
        try:
            noticed = noticed_by(file, before.get(what))
        finally:
            (COPY / file).write_text(original)
        unnoticed += noticed is None
        refused += noticed == COMPILER
        rows.append(f"| {what} | `{file}` | {noticed or '**nobody**'} |")
        print(rows[-1], flush=True)
        if options.table:
            options.table.write_text("\n".join(["| fault | file | noticed first by |", "|---|---|---|",
                                                *rows]) + "\n")
    print(f"{len(rows)} faults, {unnoticed} of them unnoticed, {refused} noticed by the compiler only")
    # What does not compile is a mistake in the table of faults: it shows nothing of the tests.
    return 1 if unnoticed or refused else 0


if __name__ == "__main__":
    sys.exit(main())
