"""How far two pictures are apart: the channels of EXR files as vpm writes them, and the largest difference between
those of two."""
import array
import itertools
import math
import struct
import sys
import zlib

ROWS_AT_ONCE = {b"\0": 1, b"\x03": 16}  # in a block: without compression, and with ZIP


def undo_zip(packed, size):
    """The bytes of a block that OpenEXR compressed by ZIP: zlib's bytes are differences, of the even bytes and then
    of the odd ones."""
    if len(packed) == size:  # a block that compression would have made longer is stored as it is
        return packed
    summed = bytes(itertools.accumulate(zlib.decompress(packed), lambda last, step: (last + step - 128) & 255))
    half = (size + 1) // 2
    block = bytearray(size)
    block[0::2], block[1::2] = summed[:half], summed[half:]
    return bytes(block)


def read_header(data):
    """The attributes of a file of one part, and where its table of offsets begins."""
    long_names = 4  # of channels, beyond 31 bytes: the one flag that changes nothing else
    if data[:4] != b"v/1\x01" or data[5] & ~long_names != 0:
        raise ValueError("it is no EXR picture of one part")
    at, header = 8, {}
    while data[at] != 0:
        name_end = data.index(0, at)
        type_end = data.index(0, name_end + 1)
        (size,) = struct.unpack_from("<i", data, type_end + 1)
        header[data[at:name_end].decode()] = data[type_end + 5 : type_end + 5 + size]
        at = type_end + 5 + size
    return header, at + 1


def channel_names(channels):
    """The names in the attribute of that name, in the order in which a row holds them."""
    names = []
    while channels[0] != 0:
        name, _, channels = channels.partition(b"\0")
        if struct.unpack_from("<i", channels) != (2,):
            raise ValueError(f"channel {name.decode()} is not of floats")
        names.append(name.decode())
        channels = channels[16:]
    return names


def read_exr(file):
    """The width and height of a picture, and the bytes of each of its channels.

    Python's own library reads no EXR, and `vpm error` would look at red, green and blue alone. Throws ValueError, or
    what reading past the end throws, where the file is not one that vpm or write_exr() wrote.
    """
    data = file.read_bytes()
    header, table = read_header(data)
    left, top, right, bottom = struct.unpack("<4i", header["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    names = channel_names(header["channels"])
    if header["compression"] not in ROWS_AT_ONCE:
        raise ValueError("it is compressed by something else than ZIP")
    channels = {name: bytearray() for name in names}
    rows_at_once, row = ROWS_AT_ONCE[header["compression"]], 4 * width
    for offset in struct.unpack_from(f"<{-(-height // rows_at_once)}Q", data, table):
        y, size = struct.unpack_from("<2i", data, offset)
        rows = min(rows_at_once, bottom + 1 - y)
        block = undo_zip(data[offset + 8 : offset + 8 + size], rows * row * len(names))
        for i in range(rows * len(names)):
            channels[names[i % len(names)]] += block[i * row : (i + 1) * row]
    return (width, height), {name: bytes(values) for name, values in channels.items()}


def floats(values):
    """The numbers of a channel, which are little-endian in the file."""
    numbers = array.array("f", values)
    if sys.byteorder == "big":
        numbers.byteswap()
    return numbers


def channel_difference(before, after):
    """The largest difference of two channels of one size, infinite where there is none.

    It is relative to the mean magnitude of the first channel or, where that is more, to the pixel's: the last bit of a
    pixel that is a thousand times as bright as the mean is no fault, nor is any noise in one that should be black.
    """
    if before == after:
        return 0.0
    before, after = floats(before), floats(after)
    mean = math.fsum(map(abs, before)) / len(before)
    largest = 0.0
    for a, b in zip(before, after):
        if a != b:
            scale = max(mean, abs(a))
            apart = abs(a - b) / scale if scale > 0 else math.inf
            largest = max(largest, apart if math.isfinite(apart) else math.inf)
    return largest


def picture_difference(before, after):
    """The largest difference of any channel of two pictures, and which channel that is."""
    (size, channels), (other_size, other_channels) = before, after
    if size != other_size or channels.keys() != other_channels.keys():
        return math.inf, f"{size} of {' '.join(channels)}, and {other_size} of {' '.join(other_channels)}"
    return max((channel_difference(values, other_channels[name]), name) for name, values in channels.items())


def write_exr(file, size, channels):
    """Writes a picture of floats without compression: a dictionary of the numbers of each channel, row by row."""
    width, height = size
    box = struct.pack("<4i", 0, 0, width - 1, height - 1)
    names = sorted(channels)
    described = b"".join(name.encode() + b"\0" + struct.pack("<4i", 2, 0, 1, 1) for name in names) + b"\0"
    attributes = [("channels", "chlist", described), ("compression", "compression", b"\0"),
                  ("dataWindow", "box2i", box), ("displayWindow", "box2i", box), ("lineOrder", "lineOrder", b"\0"),
                  ("pixelAspectRatio", "float", struct.pack("<f", 1)),
                  ("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0)),
                  ("screenWindowWidth", "float", struct.pack("<f", 1))]
    header = b"v/1\x01" + struct.pack("<i", 2)
    for name, kind, value in attributes:
        header += name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value
    header += b"\0"
    row = 4 * width * len(names)
    first = len(header) + 8 * height
    table = struct.pack(f"<{height}Q", *(first + y * (8 + row) for y in range(height)))
    rows = (struct.pack(f"<2i{width * len(names)}f", y, row, *(value for name in names
                                                                for value in channels[name][y * width : (y + 1) * width]))
            for y in range(height))
    file.write_bytes(header + table + b"".join(rows))
