"""The page of --json's fields, made of their schema: answers_page.py SCHEMA."""

import json
import sys

PAGES = [
    ("run and find", ["run_link", "run_experiment"]),
    ("check", ["check"]),
    ("compare", ["compare"]),
    ("decode", ["decode_message", "decode_line", "decode_file"]),
    ("locate", ["locate"]),
    ("parts", ["parts", "part"]),
    ("fit", ["fit"]),
]


def resolved(schema, field):
    reference = field.get("$ref")
    if reference is None:
        return field
    return {**schema["$defs"][reference.split("/")[-1]], **field}


def kind(field):
    if "enum" in field:
        return ", ".join(field["enum"])
    if "const" in field:
        return f'"{field["const"]}"'
    kinds = field.get("type", "any")
    return kinds if isinstance(kinds, str) else " or ".join(kinds)


def rows(schema, definition, prefix):
    needed = definition.get("required", [])
    for name, field in definition.get("properties", {}).items():
        field = resolved(schema, field)
        always = "" if name in needed else ", may lack"
        yield f"| `{prefix}{name}` | {kind(field)}{always} | {field['description']} |"
        yield from rows(schema, field, f"{prefix}{name}.")
        if isinstance(field.get("additionalProperties"), dict):
            yield from rows(schema, resolved(schema, field["additionalProperties"]), f"{prefix}{name}.NAME.")
        if "items" in field:
            yield from rows(schema, resolved(schema, field["items"]), f"{prefix}{name}[].")


def page(schema):
    yield "# What --json prints"
    yield ""
    yield "Made of [answers.schema.json](answers.schema.json) by `tests/sim/answers_page.py`; a test validates what the"
    yield "commands print. `decode` prints a line for each object. Numbers that are not known are null."
    for commands, names in PAGES:
        yield ""
        yield f"## {commands}"
        for name in names:
            definition = schema["$defs"][name]
            if "description" in definition:
                yield ""
                yield f"{definition['description'][0].upper()}{definition['description'][1:]}:"
            yield ""
            yield "| field | is | what |"
            yield "|---|---|---|"
            yield from rows(schema, definition, "")


if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8") as file:
        print("\n".join(page(json.load(file))))
