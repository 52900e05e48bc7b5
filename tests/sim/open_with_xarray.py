#!/usr/bin/python3
"""Opens a result file with everything that users open it with and compares it with the JSON report.

usage: open_with_xarray.py RESULT.h5 EXPECTED.json
"""
import math
import subprocess

from xarray_engines import check_with_each

REASONS = ["max_frames", "max_frame_errors", "interrupted", "rel_ci", "target_flr"]
UNITS = {"n_bits": "1", "ber": "1", "irradiance_mw_per_m2": "mW m-2", "ambient_w_per_m2": "W m-2",
         "snr_db": "dB", "ebn0_db": "dB", "elapsed_s": "s", "stop_reason": "1"}


def same(got, expected):
    if expected is None:
        return math.isnan(got)
    if isinstance(expected, str):
        return got == REASONS.index(expected)
    return got == expected


def check_axes(data, expected):
    dims = [axis["key"].replace(".", "_") for axis in expected["axes"]]
    assert sorted(data.dims) == sorted(dims), data.dims
    for name, axis in zip(dims, expected["axes"]):
        coordinate = data.coords[name]
        assert coordinate.values.tolist() == axis["values"], coordinate
        texts = isinstance(axis["values"][0], str)
        facts = {"long_name": axis["long_name"]}
        assert coordinate.attrs == {"units": "1" if texts else axis["unit"], **facts}, coordinate
        first = data.sel({name: axis["values"][0]}), data.isel({name: 0})
        assert first[0].equals(first[1]), "select by value"
    return tuple(dims)


def check_values(data, expected, dims):
    words = ("outside", "alarm_names")  # for the bits of outside_validity and alarms
    names = [key for key in expected["points"][0] if "." not in key and key not in words]
    assert sorted(data.data_vars) == sorted(names), data
    for name in names:
        variable = data[name]
        assert variable.dims == dims, variable
        assert variable.dtype.kind == "f", (name, variable.dtype)  # not times, not text
        got = variable.values.ravel().tolist()
        assert len(got) == len(expected["points"])
        for value, point in zip(got, expected["points"]):
            assert same(value, point[name]), (name, value, point[name])


def check_attributes(data, expected):
    for name, variable in data.data_vars.items():
        assert variable.attrs["units"] == UNITS.get(name, variable.attrs["units"]), name
        assert variable.attrs["units"] and variable.attrs["long_name"], name
        assert "_FillValue" in variable.encoding, name
    assert data.ebn0_db.attrs["eb_convention"] == "average"
    assert data.stop_reason.attrs["flag_values"].tolist() == list(range(len(REASONS)))
    assert data.stop_reason.attrs["flag_meanings"].split() == REASONS
    bandwidths = {p["snr_bandwidth_hz"] for p in expected["points"]} - {None}
    stated = data.snr_db.attrs.get("bandwidth_hz")
    assert stated == (bandwidths.pop() if len(bandwidths) == 1 else None), stated


def check_root(data, expected):
    root = data.attrs
    for name in ("title", "command", "seed", "ci_level", "result_digest", "scenario_toml"):
        assert root[name] == expected[name], (name, root[name])
    assert root["Conventions"] == "CF-1.10"
    assert root["filetype"] == "cosys-sim result"
    assert root["format_version"] == "1.3"
    assert root["shards"] == "1/1"
    assert (root["program"], root["version"], root["commit"]) == ("cosys-sim", "0.1.0", "abc123")
    assert len(root["created"]) == 20 and root["created"][10] == "T" and root["created"][19] == "Z"
    assert "Clopper-Pearson" in root["ci_method"]


def check_data(data, expected):
    dims = check_axes(data, expected)
    check_values(data, expected, dims)
    check_attributes(data, expected)
    check_root(data, expected)


def output_of(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def check_dumps(path, expected):
    header, dump = output_of("ncdump", "-h", path), output_of("h5dump", "-H", path)
    shape = [str(len(axis["values"])) for axis in expected["axes"]]
    for text in (v for axis in expected["axes"] for v in axis["values"] if isinstance(v, str)):
        assert f'"{text}"' in output_of("ncdump", path), text
    dims = [axis["key"].replace(".", "_") for axis in expected["axes"]]
    for name, size in zip(dims, shape):
        assert f"\t{name} = {size} ;" in header, header
        assert f'DATASET "{name}"' in dump, dump
    assert f"int64 n_bits({', '.join(dims)}) ;".replace("()", "") in header, header
    n_bits = dump[dump.index('DATASET "n_bits"'):]
    space = f"SIMPLE {{ ( {', '.join(shape)} )" if shape else "SCALAR"
    assert n_bits.split("DATASPACE", 1)[1].lstrip().startswith(space), n_bits


check_with_each(check_data, check_dumps)
