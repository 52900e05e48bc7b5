#!/usr/bin/python3
"""Opens the result file of an experiment that is no link and compares it with the JSON report.

usage: open_dataset_with_xarray.py RESULT.h5 EXPECTED.json
"""
import math

from xarray_engines import check_with_each


def same(got, expected):
    if expected is None:  # JSON knows neither NaN nor infinity
        return not math.isfinite(got)
    return got == expected


def wanted(variable, attributes):
    """The values of the JSON, where they are texts as the file has them: by their numbers."""
    texts = attributes.get("flag_meanings", "").split()
    return [texts.index(v) if isinstance(v, str) else v for v in variable["values"]]


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
        assert all(map(same, got, wanted(variable, data[name].attrs))), name


def check_data(data, expected):
    check_coordinates(data, expected)
    check_variables(data, expected)
    for name in ("title", "experiment", "result_digest", "seed"):
        assert data.attrs[name] == expected[name], (name, data.attrs[name])


check_with_each(check_data, lambda path, expected: None)
