"""Screenshots as pictures that can be asked what is on them: plain Python, no numpy."""
import struct
import zlib


class Picture:
    """What a screen showed: three planes of bytes, red, green and blue, row after row."""

    def __init__(self, width, height, red, green, blue):
        self.width, self.height = width, height
        self.planes = (red, green, blue)

    @classmethod
    def of_xwd(cls, data):
        """Of an X window dump of 32 bits a pixel, as Xvfb keeps its screen."""
        fields = struct.unpack(">25I", data[:100])
        header, width, height, order, bits = fields[0], fields[4], fields[5], fields[7], fields[11]
        row, colours = fields[12], fields[19]
        if bits != 32:
            raise ValueError(f"a screen of {bits} bits a pixel is not understood")
        start = header + 12 * colours
        body = data[start:start + row * height]
        if row != 4 * width:
            body = b"".join(body[y * row:y * row + 4 * width] for y in range(height))
        red, green, blue = (2, 1, 0) if order == 0 else (1, 2, 3)
        return cls(width, height, body[red::4], body[green::4], body[blue::4])

    def part(self, left, top, width, height):
        """The rectangle, as far as it lies within the picture."""
        left, top = max(0, int(left)), max(0, int(top))
        right, bottom = min(self.width, left + int(width)), min(self.height, top + int(height))
        rows = range(top, bottom)
        planes = (b"".join(plane[y * self.width + left:y * self.width + right] for y in rows)
                  for plane in self.planes)
        return Picture(right - left, len(rows), *planes)

    def pixel(self, x, y):
        at = int(y) * self.width + int(x)
        return tuple(plane[at] for plane in self.planes)

    def places(self, is_wanted, stride=2):
        """Where the pixels are for which is_wanted(red, green, blue) holds, among every stride-th."""
        red, green, blue = self.planes
        found = []
        for y in range(0, self.height, stride):
            begin, end = y * self.width, (y + 1) * self.width
            row = zip(red[begin:end:stride], green[begin:end:stride], blue[begin:end:stride])
            found += [(i * stride, y) for i, (r, g, b) in enumerate(row) if is_wanted(r, g, b)]
        return found

    def share(self, is_wanted, stride=2):
        """The share of the pixels for which that holds."""
        looked_at = len(range(0, self.width, stride)) * len(range(0, self.height, stride))
        return len(self.places(is_wanted, stride)) / max(1, looked_at)

    def middle(self, is_wanted, stride=2):
        """The mean place of such pixels; None where there are none."""
        found = self.places(is_wanted, stride)
        if not found:
            return None
        return (sum(x for x, _ in found) / len(found), sum(y for _, y in found) / len(found))

    def longest_column(self, colour):
        """The longest vertical run of exactly this colour, in pixels."""
        same = [bytes(255 if i == value else 0 for i in range(256)) for value in colour]
        marks = [plane.translate(table) for plane, table in zip(self.planes, same)]
        hits = (int.from_bytes(marks[0], "big") & int.from_bytes(marks[1], "big") &
                int.from_bytes(marks[2], "big")).to_bytes(len(marks[0]), "big")
        best = 0
        for x in range(self.width):
            column = hits[x::self.width]
            if best < 255 and 255 not in column:
                continue
            best = max([best] + [len(run) for run in column.split(b"\0")])
        return best

    def difference(self, other, stride=2):
        """The mean difference of the channels, 0 to 255."""
        total = count = 0
        for mine, its in zip(self.planes, other.planes):
            total += sum(abs(a - b) for a, b in zip(mine[::stride], its[::stride]))
            count += len(mine[::stride])
        return total / max(1, count)

    def changed(self, other, by=24, stride=2):
        """The share of pixels of which a channel differs by more than that."""
        pairs = zip(*(plane[::stride] for plane in self.planes + other.planes))
        differ = sum(max(abs(r - a), abs(g - b), abs(c - d)) > by for r, g, c, a, b, d in pairs)
        return differ / max(1, len(self.planes[0][::stride]))

    def save(self, path):
        """As a PNG."""
        rows = bytearray()
        pixels = bytearray(3 * len(self.planes[0]))
        for i, plane in enumerate(self.planes):
            pixels[i::3] = plane
        above = bytes(3 * self.width)
        for y in range(self.height):
            row = pixels[3 * y * self.width:3 * (y + 1) * self.width]
            # As the difference to the row above, which packs well.
            rows += b"\2" + bytes((a - b) & 255 for a, b in zip(row, above))
            above = row
        with open(path, "wb") as file:
            file.write(b"\x89PNG\r\n\x1a\n")
            for kind, body in ((b"IHDR", struct.pack(">IIBBBBB", self.width, self.height, 8, 2, 0, 0, 0)),
                               (b"IDAT", zlib.compress(bytes(rows), 9)), (b"IEND", b"")):
                checked = kind + body
                file.write(struct.pack(">I", len(body)) + checked + struct.pack(">I", zlib.crc32(checked)))
