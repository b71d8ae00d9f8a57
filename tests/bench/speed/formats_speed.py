# SPDX-License-Identifier: MIT
"""Processor time in s of reading a log: memmap FILE COLUMNS (the sum of a raw array), or h5py FILE."""
import sys
import time

import numpy

what, path = sys.argv[1:3]
if what == "memmap":
    columns = int(sys.argv[3])
    before = time.process_time()
    total = numpy.memmap(path, dtype="f8", mode="r").reshape(columns, -1).sum()
else:
    import h5py

    before = time.process_time()
    with h5py.File(path, "r") as file:
        read = [file[name][...] for name in ("t", "q", "dq", "tau")]
print(f"{time.process_time() - before:.4f}")
