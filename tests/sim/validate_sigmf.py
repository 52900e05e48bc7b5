"""Whether a SigMF recording is as the standard says: by JSON schemas, and by its data, which no schema sees.

Usage: validate_sigmf.py RECORDING.sigmf-meta SCHEMA...; prints what is wrong, a line each, and exits 1 if anything is.
"""
import hashlib
import json
import re
import sys
from pathlib import Path

import jsonschema

meta_path, schemas = Path(sys.argv[1]), sys.argv[2:]
meta = json.loads(meta_path.read_text(encoding="utf-8"))
data = meta_path.with_suffix(".sigmf-data").read_bytes()
problems = []

for schema in schemas:
    validator = jsonschema.Draft202012Validator(json.loads(Path(schema).read_text(encoding="utf-8")))
    for error in validator.iter_errors(meta):
        problems.append(f"{Path(schema).name}: /{'/'.join(map(str, error.absolute_path))}: {error.message[:200]}")

if not problems:
    top = meta["global"]
    if hashlib.sha512(data).hexdigest() != top["core:sha512"].lower():
        problems.append("core:sha512 is not that of the data")
    parts, bits = re.match(r"([cr])[fiu](\d+)", top["core:datatype"]).groups()
    size = int(bits) // 8 * (2 if parts == "c" else 1) * top.get("core:num_channels", 1)
    if len(data) % size:
        problems.append("the data ends within a sample")
    samples = len(data) // size
    for segments in ("captures", "annotations"):
        starts = [segment["core:sample_start"] for segment in meta[segments]]
        if starts != sorted(starts):
            problems.append(f"{segments} are not in the order of their starts")
        for segment in meta[segments]:
            if segment["core:sample_start"] + segment.get("core:sample_count", 0) > samples:
                problems.append(f"one of the {segments} ends behind the data")
            if segment.get("core:freq_lower_edge", 0) > segment.get("core:freq_upper_edge", 0):
                problems.append(f"one of the {segments} has its frequencies turned round")

print("\n".join(problems))
sys.exit(1 if problems else 0)
