#!/usr/bin/env python3
"""Do the scenarios of scenarios/gate find decoders that are broken, and none that is sound?

The baseline is the built-in mid-bit. Each decoder of tests/mutants, sigrok's UART and an AVR's firmware are checked
against it. It fails where a broken one is caught by no scenario, where a sound one does not pass all, or where the
table in sim/check/README.md says otherwise. With --write that table gets what is found now. With --few each broken
decoder is checked by the first scenario alone that the table names, and of the sound ones ours.

Usage: mutants_test.py PROGRAM SOURCES [FIRMWARE.elf] [--few | --write]; exits 1 saying what is otherwise, 77 (skipped)
where a sound decoder's program is not there.
"""
import json
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

HEADING = "## What the gate scenarios catch\n"
TABLE = re.compile(r"(?<=^" + re.escape(HEADING) + r").*?(^\|.*?\n)(?!\|)", re.MULTILINE | re.DOTALL)
MARKS = {"passed": "", "inconclusive": "?", "worse": "x", "failed": "f"}
CAUGHT = {"x", "f"}
SIGROK = "sigrok-cli -i {vcd} -I vcd -P uart:rx=rx:baudrate=600 -B uart=rx"


class Gate:
    """The gate scenarios, and what check says of a decoder by them."""

    def __init__(self, program, scenarios, folder):
        self.program, self.scenarios, self.baseline = program, scenarios, folder / "gate.h5"
        self.run("baseline", *scenarios, "--decoder", "mid-bit", "-o", self.baseline)

    def run(self, *words):
        return subprocess.run([self.program, *words, "-q"], text=True, check=False, stdout=subprocess.PIPE)

    def marks(self, command, output, names=None):
        """A mark for each scenario, or for those of these names: the worst of its points."""
        chosen = [path for path in self.scenarios if names is None or path.stem in names]
        outcome = self.run("check", *chosen, "--baseline", self.baseline, "--json", "--decoder", command,
                           "--decoder-output", output)
        marks = {path.stem: "" for path in chosen}
        for point in json.loads(outcome.stdout)["points"]:
            name = pathlib.Path(point["scenario"]).stem
            marks[name] = max(marks[name], MARKS[point["verdict"]], key=list(MARKS.values()).index)
        return marks


def mutant_command(sources, name):
    script = shlex.quote(str(sources / "tests/mutants/mutants.py"))
    return f"/usr/bin/python3 -B {script} --mutant {name} {{vcd}}"


def mutant_names(sources):
    listed = subprocess.run(["/usr/bin/python3", "-B", sources / "tests/mutants/mutants.py", "--list"], text=True,
                            check=True, stdout=subprocess.PIPE)
    return [name for name in listed.stdout.split() if name != "sound"]


def sound_decoders(sources, firmware):
    """Name to command and what it prints."""
    by_firmware = shlex.join([str(sources / "tests/mutants/by_firmware"), firmware or ""])
    return {"sound": (mutant_command(sources, "sound"), "frames"),
            "sigrok-cli": (SIGROK, "bytes"),
            "receiver.c": (by_firmware + " {vcd}", "frames")}


def table_of(rows):
    """As text: a row a decoder, a column a scenario."""
    columns = list(next(iter(rows.values())))
    lines = [["decoder", *(column.removeprefix("gate_").replace("_", " ") for column in columns)],
             ["---"] * (len(columns) + 1),
             *([name, *(marks[column] for column in columns)] for name, marks in rows.items())]
    return "".join("|" + "|".join(f" {cell} " if cell else " " for cell in line) + "|\n" for line in lines)


def rows_of(table, columns):
    """The same read back."""
    lines = [[cell.strip() for cell in line.split("|")[1:-1]] for line in table.splitlines()[2:]]
    return {name: dict(zip(columns, marks)) for name, *marks in lines}


def complaints(rows, sound):
    for name, marks in rows.items():
        if name in sound:
            yield from (f"{name} is sound, and {gate} says otherwise ({mark})" for gate, mark in marks.items() if mark)
            continue
        if CAUGHT.isdisjoint(marks.values()):
            yield f"{name} is broken, and no gate scenario catches it"


def all_rows(gate, sources, sound):
    decoders = dict(sound)
    decoders.update({name: (mutant_command(sources, name), "frames") for name in mutant_names(sources)})
    return {name: gate.marks(*decoder) for name, decoder in decoders.items()}


def few_rows(gate, sources, stored):
    """Of the sound decoder all, of each other the first scenario that is known to catch it."""
    rows = {"sound": gate.marks(mutant_command(sources, "sound"), "frames")}
    for name in mutant_names(sources):
        first = [column for column, mark in stored.get(name, {}).items() if mark in CAUGHT][:1]
        rows[name] = gate.marks(mutant_command(sources, name), "frames", first) if first else {}
    return rows


def skip_without_programs(firmware):
    missing = [tool for tool in ("sigrok-cli", "simavr") if not shutil.which(tool)]
    if not firmware:
        missing.append("avr-gcc, avr-libc")
    if missing:
        script = pathlib.Path(__file__).parent / "skip.sh"
        sys.exit(subprocess.run([script, "mutants", "needs " + ", ".join(missing)], check=False).returncode)


def main(program, sources, *rest):
    sources = pathlib.Path(sources).resolve()
    firmware = next((word for word in rest if not word.startswith("--")), None)
    is_few = "--few" in rest
    if not is_few:
        skip_without_programs(firmware)
    page = sources / "sim/check/README.md"
    stored = TABLE.search(page.read_text())
    scenarios = sorted((sources / "scenarios/gate").glob("*.toml"))
    sound = sound_decoders(sources, firmware)
    with tempfile.TemporaryDirectory() as folder:
        gate = Gate(pathlib.Path(program).resolve(), scenarios, pathlib.Path(folder))
        if is_few:
            columns = [path.stem for path in scenarios]
            rows = few_rows(gate, sources, rows_of(stored.group(1), columns))
        else:
            rows = all_rows(gate, sources, sound)
    wrong = list(complaints(rows, sound))
    if not is_few:
        table = table_of(rows)
        print(table, end="")
        if "--write" in rest:
            text = page.read_text()
            page.write_text(text[:stored.start(1)] + table + text[stored.end(1):])
        elif stored.group(1) != table:
            wrong.append(f"{page} has another table")
    print("\n".join(wrong))
    sys.exit(1 if wrong else 0)


main(*sys.argv[1:])
