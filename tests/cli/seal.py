"""The seal of checkpoints and of run.h5, for tests that change what is behind it."""

import contextlib
import zlib

import h5py


def seal_again(path):
    """Makes length and checksums right, as io/seal.cpp does."""
    content = path.read_bytes()
    checksum = 0xcbf29ce484222325
    for byte in content[512:]:
        checksum = (checksum ^ byte) * 0x100000001b3 & 0xffffffffffffffff
    lines = content[:512].rstrip(b"\0").split(b"\n")
    lines[2:5] = [b"bytes in all: %d" % len(content),
                  b"FNV-1a of those behind the block: %016x" % checksum,
                  b"CRC-32 of those behind the block: %08x" % zlib.crc32(content[512:])]
    path.write_bytes(b"\n".join(lines).ljust(512, b"\0") + content[512:])


@contextlib.contextmanager
def changed_behind_seal(path):
    """The HDF5 file, open for changes; sealed again after the `with` block."""
    with h5py.File(path, "r+") as file:
        yield file
    seal_again(path)
