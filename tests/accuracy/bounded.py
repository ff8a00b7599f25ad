"""Least squares within [0, 1] by scipy: takes come on standard input, their curves leave on standard output.

A take is three unsigned integers (rows, muscles, frames), the basis by rows, and one row of displacements a frame, NaN
where a marker was not seen; all in 8 bytes, little-endian. A frame that shows nothing keeps the values before.
"""

import struct
import sys

import numpy as np
from scipy.optimize import lsq_linear


def read(count):
    return np.frombuffer(sys.stdin.buffer.read(8 * count), "<f8")


def main():
    write = sys.stdout.buffer
    write.write(b"\n")
    write.flush()
    while len(sizes := sys.stdin.buffer.read(24)) == 24:
        rows, muscles, frames = struct.unpack("<3Q", sizes)
        basis = read(rows * muscles).reshape(rows, muscles)
        displacements = read(frames * rows).reshape(frames, rows)
        curves = np.zeros((frames, muscles))
        x = np.zeros(muscles)
        for frame, d in enumerate(displacements):
            seen = ~np.isnan(d)
            if seen.any():
                x = lsq_linear(basis[seen], d[seen], bounds=(0, 1), method="bvls").x
            curves[frame] = x
        write.write(curves.astype("<f8").tobytes())
        write.flush()


main()
