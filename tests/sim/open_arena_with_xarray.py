#!/usr/bin/python3
"""Opens an arena's result file with xarray and compares it with the JSON report.

usage: open_arena_with_xarray.py RESULT.h5 EXPECTED.json
Each xarray engine runs in its own process, as the two bring their own copies of the HDF5 library.
"""
import json
import math
import subprocess
import sys

ENGINES = ("netcdf4", "h5netcdf")


def same(got, expected):
    return math.isnan(got) if expected is None else got == expected


def check_variable(variable, expected):
    assert list(variable.dims) == expected["dimensions"], variable
    values = variable.values.ravel().tolist()
    assert len(values) == len(expected["values"]), variable
    texts = variable.attrs.get("flag_meanings", "").split()
    for got, wanted in zip(values, expected["values"]):
        if isinstance(wanted, str):
            wanted = texts.index(wanted)
        assert same(got, wanted), (variable.name, got, wanted)
    assert variable.attrs["units"] and variable.attrs["long_name"], variable


def check(data, expected):
    assert sorted(data.data_vars) == sorted(expected["variables"]), data
    for name, variable in expected["variables"].items():
        check_variable(data[name], variable)
    for name, values in expected["dimensions"].items():
        assert data.coords[name].values.tolist() == values, name
    for axis in expected["axes"]:
        coordinate = data.coords[axis["key"].replace(".", "_")]
        assert coordinate.values.tolist() == axis["values"], coordinate
    for name in ("title", "experiment", "seed", "result_digest", "command"):
        assert data.attrs[name] == expected[name], name
    assert data.attrs["filetype"] == "cosys-sim experiment"
    assert "[devices.gate]" in data.attrs["scenario_toml"]
    gate = data.sel(device="gate")
    assert (gate.n_messages > 0).all() and (gate.n_delivered <= gate.n_messages).all()


def main():
    path, expected_path = sys.argv[1:3]
    if len(sys.argv) > 3:
        import xarray

        with open(expected_path, encoding="utf-8") as file:
            expected = json.load(file)
        with xarray.open_dataset(path, engine=sys.argv[3]) as data:
            check(data, expected)
        return
    for engine in ENGINES:
        subprocess.run([sys.executable, __file__, path, expected_path, engine], check=True)
    print("all readers agree")


main()
