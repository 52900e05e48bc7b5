#!/usr/bin/python3
"""Opens a traced trial in HDF5 with both xarray engines and compares it with the CSV of that trial.

usage: open_trace_with_xarray.py TRACE.h5 TRACE.csv EXPECTED.json
Each engine runs in its own process, as the two bring their own copies of the HDF5 library. The
spectra are compared with SciPy's.
"""
import json
import subprocess
import sys

ENGINES = ("netcdf4", "h5netcdf")
SEGMENT = 1 << 14
TAPS = {"tx": ("uint8", "1"), "irradiance_mw_per_m2": ("float32", "mW m-2"),
        "band_pass_mw_per_m2": ("float32", "mW m-2"), "threshold_mw_per_m2": ("float32", "mW m-2"),
        "integrator_samples": ("float32", "1"), "agc_gain": ("float32", "1"), "rx": ("uint8", "1")}
SPECTRA = {"irradiance_spectrum": "irradiance_mw_per_m2", "band_pass_spectrum": "band_pass_mw_per_m2"}


def check_taps(data, csv_path):
    import numpy

    with open(csv_path, encoding="ascii") as file:
        names = file.readline().strip().split(",")
        rows = numpy.loadtxt(file, delimiter=",", unpack=True)
    assert names == ["time_s", *TAPS], names
    assert data.sizes["time_s"] == rows.shape[1]
    assert numpy.allclose(data.time_s, rows[0], rtol=0, atol=1e-9)
    assert data.time_s.attrs["units"] == "s" and data.time_s.dtype == "float64"
    for name, row in zip(names[1:], rows[1:]):
        variable = data[name]
        assert variable.dims == ("time_s",), variable
        assert (str(variable.dtype), variable.attrs["units"]) == TAPS[name], variable
        assert numpy.allclose(variable, row, rtol=1e-5, atol=0), name
        assert len(numpy.unique(variable)) > 1, name


def check_spectra(data):
    import numpy
    from scipy import signal

    frequency = data.frequency_hz
    assert frequency.attrs["units"] == "Hz" and frequency.size == SEGMENT // 2 + 1
    for name, tap in SPECTRA.items():
        samples = data[tap].values.astype("float64")
        f, density = signal.welch(samples, data.attrs["sample_rate_hz"], nperseg=SEGMENT)
        assert data[name].dims == ("frequency_hz",) and data[name].attrs["units"] == "mW2 m-4 Hz-1"
        assert numpy.allclose(frequency, f)
        assert numpy.allclose(data[name], density, rtol=1e-6, atol=1e-9 * density.max()), name


def check_attributes(data, expected):
    for name, variable in data.variables.items():
        assert variable.attrs["long_name"], name
    assert sorted(data.data_vars) == sorted([*TAPS, *SPECTRA]), data
    root = data.attrs
    assert root["Conventions"] == "CF-1.10" and root["filetype"] == "cosys-sim trace"
    for name, value in expected.items():
        assert root[name] == value, (name, root[name])


def check_engine(engine, path, csv_path, expected_path):
    import xarray

    with open(expected_path, encoding="utf-8") as file:
        expected = json.load(file)
    with xarray.open_dataset(path, engine=engine) as data:
        check_taps(data, csv_path)
        check_spectra(data)
        check_attributes(data, expected)


def main():
    if len(sys.argv) > 4:
        check_engine(sys.argv[4], *sys.argv[1:4])
        return
    for engine in ENGINES:
        subprocess.run([sys.executable, __file__, *sys.argv[1:4], engine], check=True)
    dump = subprocess.run(["h5dump", "-pH", sys.argv[1]], check=True, capture_output=True, text=True)
    assert dump.stdout.count("COMPRESSION DEFLATE") >= 1 + len(TAPS), dump.stdout
    assert dump.stdout.count("PREPROCESSING SHUFFLE") >= 1 + len(TAPS), dump.stdout
    print("all readers agree")


main()
