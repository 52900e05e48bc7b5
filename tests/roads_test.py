#!/usr/bin/env python3
"""Does what the pages of PAGES say, command by command, and compares what is printed.

In a block of ```console a line that begins with "$ " is a command, for bash, in one folder a page; what stands below it
is what it prints on stdout. With --write the pages get what is printed now.

Usage: roads_test.py PROGRAM SOURCES [--write]; exits 1 saying what is otherwise, 77 (skipped)
without xarray.
"""
import difflib
import os
import pathlib
import re
import subprocess
import sys
import tempfile

PAGES = ("scenarios/roads/*.md", "protocol/PROTOCOLS.md", "channel/PHYSICS.md")
ENVIRONMENT = {**os.environ, "PATH": "/usr/bin:" + os.environ["PATH"]}  # Debian's Python has xarray
BLOCK = re.compile(r"(?<=^```console\n).*?(?=^```$)", re.MULTILINE | re.DOTALL)


def done(block, folder):
    """The block with what its commands print now."""
    text = ""
    for command in re.findall(r"^\$ (.*)$", block, re.MULTILINE):
        outcome = subprocess.run(["bash", "-c", command], cwd=folder, text=True, check=False,
                                 stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, env=ENVIRONMENT)
        text += f"$ {command}\n{outcome.stdout}"
    return text


def pages(sources):
    """Of each pattern one or more: what names none is yielded itself, and cannot be read."""
    for pattern in PAGES:
        yield from sorted(sources.glob(pattern)) or [sources / pattern]


def page_now(page, program, sources):
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        (folder / "cosys-sim").symlink_to(program)
        for of_sources in ("scenarios", "tests"):
            (folder / of_sources).symlink_to(sources / of_sources)
        return BLOCK.sub(lambda block: done(block.group(), folder), page.read_text())


def skip_without_xarray():
    if subprocess.run(["/usr/bin/python3", "-c", "import xarray"], check=False, stderr=subprocess.DEVNULL).returncode:
        script = pathlib.Path(__file__).parent / "skip.sh"
        sys.exit(subprocess.run([script, "roads", "needs xarray (Debian: python3-xarray)"], check=False).returncode)


def main(program, sources, *options):
    skip_without_xarray()
    sources = pathlib.Path(sources).resolve()
    differ = False
    for page in pages(sources):
        before, now = page.read_text(), page_now(page, pathlib.Path(program).resolve(), sources)
        if options == ("--write",):
            page.write_text(now)
        elif before != now:
            differ = True
            sys.stdout.writelines(difflib.unified_diff(before.splitlines(True), now.splitlines(True),
                                                       str(page), "now"))
    sys.exit(1 if differ else 0)


main(*sys.argv[1:])
