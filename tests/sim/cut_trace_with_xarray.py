#!/usr/bin/python3
"""Cuts a traced trial in HDF5 as its users do, and writes what the pin has there as raw bytes too.

usage: cut_trace_with_xarray.py TRACE.h5 ENGINE CUT.h5 CUT.bin
"""
import sys

import xarray

path, engine, cut_path, raw_path = sys.argv[1:]
with xarray.open_dataset(path, engine=engine) as data:
    cut = data.isel(time_s=slice(data.sizes["time_s"] // 50, None))
    cut.to_netcdf(cut_path, engine=engine)
    cut.rx.values.astype("uint8").tofile(raw_path)
    print(data.attrs["sample_rate_hz"], end="")
