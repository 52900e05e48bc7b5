#!/usr/bin/python3
"""Opens the result file of an experiment that is no link and compares it with the JSON report.

usage: open_dataset_with_xarray.py RESULT.h5 EXPECTED.json
Each xarray engine runs in its own process, as the two bring their own copies of the HDF5 library.
"""
import json
import math
import subprocess
import sys

ENGINES = ("netcdf4", "h5netcdf")


def same(got, expected):
    if expected is None:  # JSON knows neither NaN nor infinity
        return not math.isfinite(got)
    return got == expected


def check_coordinates(data, expected):
    coordinates = {axis["key"].replace(".", "_"): axis["values"] for axis in expected["axes"]}
    coordinates.update(expected["dimensions"])
    assert set(data.dims) == set(coordinates), data.dims
    for name, values in coordinates.items():
        assert data.coords[name].values.tolist() == values, name
        assert data.coords[name].attrs["long_name"], name
        assert data.sel({name: values[0]}).equals(data.isel({name: 0})), "select by value"


def check_variables(data, expected):
    assert set(data.data_vars) == set(expected["variables"]), data
    for name, variable in expected["variables"].items():
        assert list(data[name].dims) == variable["dimensions"], name
        assert data[name].attrs["long_name"] == variable["long_name"], name
        assert data[name].attrs["units"], name
        got = data[name].values.ravel().tolist()
        assert len(got) == len(variable["values"]), name
        assert all(map(same, got, variable["values"])), name


def check_engine(engine, path, expected):
    import xarray

    with xarray.open_dataset(path, engine=engine) as data:
        check_coordinates(data, expected)
        check_variables(data, expected)
        for name in ("title", "experiment", "result_digest", "seed"):
            assert data.attrs[name] == expected[name], (name, data.attrs[name])


def main():
    path, expected_path = sys.argv[1:3]
    with open(expected_path, encoding="utf-8") as file:
        expected = json.load(file)
    if len(sys.argv) > 3:
        check_engine(sys.argv[3], path, expected)
        return
    for engine in ENGINES:
        subprocess.run([sys.executable, __file__, path, expected_path, engine], check=True)
    print("all readers agree")


main()
