"""Checks a file by each engine that xarray reads it with.

Each engine runs in its own process, as the two bring their own copies of the HDF5 library.
"""
import json
import subprocess
import sys

ENGINES = ("netcdf4", "h5netcdf")


def check_with_each(check_data, check_file):
    """Arguments of the program: RESULT.h5 EXPECTED.json, and an engine where one is to check."""
    path, expected_path = sys.argv[1:3]
    with open(expected_path, encoding="utf-8") as file:
        expected = json.load(file)
    if len(sys.argv) > 3:
        import xarray  # a second of work, which the program that starts the engines does not need

        with xarray.open_dataset(path, engine=sys.argv[3]) as data:
            check_data(data, expected)
        return
    for engine in ENGINES:
        subprocess.run([sys.executable, sys.argv[0], path, expected_path, engine], check=True)
    check_file(path, expected)
    print("all readers agree")
