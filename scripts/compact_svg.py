#!/usr/bin/env python3
"""Makes a picture of the examples small enough for the book.

Dots of one colour and size become one path of dots, polylines become paths of relative steps; both
are rounded to a little over half a pixel, and what coincides then is written once. Many dots become
an embedded raster. Usage: compact_svg.py IN OUT
"""

import base64
import re
import struct
import sys
import zlib

UNIT = 5  # A little over half a pixel: the examples write eight units to a pixel.


def number(tag, name):
    return float(re.search(rf'\b{name}="([^"]*)"', tag).group(1))


def attribute(tag, name):
    found = re.search(rf'\b{name}="([^"]*)"', tag)
    return found.group(1) if found else None


def step(dx, dy):
    """Two relative coordinates, without a space before a minus."""
    return f"{dx}{'' if dy < 0 else ' '}{dy}"


def dots(points):
    """A path of dots, row by row so that steps are short."""
    path, at = "", (0, 0)
    for y, x in sorted({(y, x) for x, y in points}):
        path += f"m{step(x - at[0], y - at[1])}h0"
        at = (x, y)
    return path


def simplified(points):
    """The points without those that lie on the line between their neighbours, to half a unit
    (D. Douglas, T. Peucker, Cartographica 10 (1973) 112, doi:10.3138/FM57-6770-U75U-7727)."""
    keep, open_ranges = {0, len(points) - 1}, [(0, len(points) - 1)]
    while open_ranges:
        first, last = open_ranges.pop()
        (x, y), (u, v) = points[first], points[last]
        length = max(((u - x) ** 2 + (v - y) ** 2) ** 0.5, 1e-9)
        closed = (x, y) == (u, v)
        farthest, distance = first, 0.5
        for k in range(first + 1, last):
            a, b = points[k]
            apart = abs((u - x) * (b - y) - (v - y) * (a - x)) / length
            apart = ((a - x) ** 2 + (b - y) ** 2) ** 0.5 if closed else apart
            if apart > distance:
                farthest, distance = k, apart
        if farthest != first:
            keep.add(farthest)
            open_ranges += [(first, farthest), (farthest, last)]
    return [points[k] for k in sorted(keep)]


def line(points):
    """A path through the points."""
    points = simplified(points)
    path = f"M{step(*points[0])}l"
    steps = []
    for (x, y), (u, v) in zip(points, points[1:]):
        if (x, y) != (u, v):
            steps.append(step(u - x, v - y))
    for k, one in enumerate(steps):
        path += one if k == 0 or one.startswith("-") else f" {one}"
    return path if steps else ""


MANY = 8000  # Dots beyond which a raster is smaller.


def raster(clouds, order, width, height):
    """All dots as an embedded image of a palette, transparent elsewhere."""
    columns, rows = -(-width // UNIT), -(-height // UNIT)
    pixels = [bytearray(columns) for _ in range(rows)]
    palette = bytearray(3)
    for k, key in enumerate(order, start=1):
        palette += bytes.fromhex(key[0].lstrip("#"))
        for x, y in clouds[key]:
            for row in pixels[y : y + 2]:
                row[x : x + 2] = bytes([k]) * len(row[x : x + 2])

    def chunk(name, data):
        check = struct.pack(">I", zlib.crc32(name + data))
        return struct.pack(">I", len(data)) + name + data + check

    image = (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", struct.pack(">IIBBBBB", columns, rows, 8, 3, 0, 0, 0))
        + chunk(b"PLTE", bytes(palette))
        + chunk(b"tRNS", b"\0")
        + chunk(b"IDAT", zlib.compress(b"".join(b"\0" + bytes(row) for row in pixels), 9))
        + chunk(b"IEND", b"")
    )
    data = base64.b64encode(image).decode()
    return (
        f'<image x="0" y="0" width="{columns * UNIT}" height="{rows * UNIT}" '
        f'href="data:image/png;base64,{data}"/>\n'
    )


def main(source, target):
    with open(source, encoding="utf-8") as file:
        text = file.read()
    clouds, order = {}, []

    def take_circle(match):
        tag = match.group(0)
        if attribute(tag, "fill") == "none":
            return tag
        key = (attribute(tag, "fill"), number(tag, "r"), attribute(tag, "opacity"))
        first = key not in clouds
        place = (round(number(tag, "cx") / UNIT), round(number(tag, "cy") / UNIT))
        clouds.setdefault(key, []).append(place)
        if first:
            order.append(key)
            return f"<dots {len(order) - 1}>"
        return ""

    def take_line(match):
        tag = match.group(0)
        if attribute(tag, "fill") != "none":
            return tag
        places = [pair.split(",") for pair in attribute(tag, "points").split()]
        points = [(round(float(x) / UNIT), round(float(y) / UNIT)) for x, y in places]
        width = number(tag, "stroke-width") / UNIT
        return (
            f'<path transform="scale({UNIT})" fill="none" stroke="{attribute(tag, "stroke")}" '
            f'stroke-width="{width:g}" opacity="{attribute(tag, "opacity")}" d="{line(points)}"/>'
        )

    text = re.sub(r"<circle[^>]*/>\n?", take_circle, text)
    text = re.sub(r"<polyline[^>]*/>", take_line, text)
    if sum(len(set(cloud)) for cloud in clouds.values()) > MANY:
        width, height = map(int, attribute(text, "viewBox").split()[2:])
        # A legend's few dots stay what they are.
        dense = [key for key in order if len(clouds[key]) > 50]
        image = raster(clouds, dense, width, height)
        text = text.replace(f"<dots {order.index(dense[0])}>", image)
        for key in dense:
            text = text.replace(f"<dots {order.index(key)}>", "")
            clouds[key] = []
    for k, key in enumerate(order):
        fill, radius, opacity = key
        path = (
            f'<path transform="scale({UNIT})" fill="none" stroke="{fill}" stroke-linecap="round" '
            f'stroke-width="{2 * radius / UNIT:g}" opacity="{opacity}" d="{dots(clouds[key])}"/>\n'
        )
        text = text.replace(f"<dots {k}>", path)
    text = re.sub(r'(font-size="\d+)\.\d+', r"\1", text)
    # A page of the API that is narrower than the picture shows all of it.
    text = text.replace("<svg width=", '<svg style="max-width:100%;height:auto" width=', 1)
    # An empty line would end the picture where it stands in Markdown.
    text = re.sub(r"\n\s*\n", "\n", text)
    with open(target, "w", encoding="utf-8") as file:
        file.write(text)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
