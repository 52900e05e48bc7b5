"""Validates answers of --json: validate_answers.py SCHEMA NAME FILE NAME FILE..., each an object or one a line, by the
definition of that name. Prints what is wrong, a line each."""

import json
import sys

import jsonschema


def objects(text):
    try:
        return [json.loads(text)]
    except json.JSONDecodeError:
        return [json.loads(line) for line in text.splitlines()]


with open(sys.argv[1], encoding="utf-8") as file:
    schema = json.load(file)
for name, path in zip(sys.argv[2::2], sys.argv[3::2]):
    validator = jsonschema.Draft202012Validator({**schema, "$ref": f"#/$defs/{name}"})
    with open(path, encoding="utf-8") as file:
        for answer in objects(file.read()):
            for error in validator.iter_errors(answer):
                print(f"{name} in {path}: {'/'.join(map(str, error.path))}: {error.message[:200]}")
