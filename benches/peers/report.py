"""BENCHMARKS.md, its figures, and the book's table of the fastest schemes, from the rows of all peers.

A curve of a peer is the lower left edge of its rows: the least time for each error, over methods and settings.
"""

import math

TITLES = {
    "kepler": "Kepler's problem, e = 0.6, 1000 periods",
    "encounter": "Kepler's problem, e = 0.9, 100 periods",
    "henon_heiles": "Hénon–Heiles, to t = 10⁴",
    "pendulum": "A pendulum, to t = 10⁴",
    "coupled": "H = ½(q² + 1)(p² + 1), to t = 10⁴",
    "planets": "The outer solar system, 1000 years",
    "black_hole": "An orbit round a black hole, to τ = 10⁴",
    "toda": "A Toda ring of 1024 particles, to t = 20",
    "fput": "The chain of Fermi, Pasta, Ulam and Tsingou, 31 particles, to t = 1000",
    "cluster": "1000 bodies with softened gravity, to t = 0.25",
    "ensemble": "1000 pendulums, to t = 100",
}
GOALS = (1e-3, 1e-6, 1e-9, 1e-11)
# End-point errors at which the fastest peer of Taylor's method is compared in a table of its own.
ASKED = {"kepler": 1e-9, "henon_heiles": 2e-11, "pendulum": 2e-11, "coupled": 1e-10, "planets": 2e-11}
FIGURES = "benches/peers/figures"
# The chapter that names the fastest scheme for an accuracy, and the marks round its table.
CHAPTER, MARKS = "book/src/schemes.md", ("<!-- fastest -->", "<!-- end of fastest -->")
COLOURS = {"hamiltonian": "#1f4e9c", "heyoka": "#c8442c", "REBOUND": "#2c8a4b", "SciPy": "#8a6d1f", "numba": "#7a3e98",
           "diffsol": "#444444", "Julia": "#c2389a"}
# The marks round the section of BENCHMARKS.md that `tolerances.py` writes.
TOLERANCES = ("<!-- tolerances -->", "<!-- end of tolerances -->")
WIDTH, HEIGHT, LEFT, BOTTOM, TOP, RIGHT = 640, 400, 64, 48, 36, 130


def edge(rows):
    """Rows that no other row of the peer beats in error and time."""
    best, kept = math.inf, []
    for row in sorted(rows, key=lambda row: (row["seconds"], row["error"])):
        if row["error"] < best:
            best = row["error"]
            kept.append(row)
    return kept


def groups(rows):
    """Rows with an error, by problem and peer."""
    found = {}
    for row in rows:
        if "seconds" in row and row["error"] is not None and math.isfinite(row["error"]):
            found.setdefault(row["problem"], {}).setdefault(row["peer"], []).append(row)
    return found


def figure(title, peers):
    """Error of the end point against CPU time, both logarithmic."""
    points = [(row["seconds"], max(row["error"], 1e-17)) for rows in peers.values() for row in edge(rows)]
    ends = []
    for axis in (0, 1):
        logs = [math.log10(point[axis]) for point in points]
        ends.append((math.floor(min(logs)), max(math.ceil(max(logs)), math.floor(min(logs)) + 1)))
    (x0, x1), (y0, y1) = ends
    x = lambda value: LEFT + (math.log10(value) - x0) / (x1 - x0) * (WIDTH - LEFT - RIGHT)
    y = lambda value: HEIGHT - BOTTOM - (math.log10(value) - y0) / (y1 - y0) * (HEIGHT - TOP - BOTTOM)
    power = lambda n: "10<tspan dy='-5' font-size='9'>" + str(n).replace("-", "−") + "</tspan>"
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" '
           f'font-size="12"><rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>'
           f'<text x="{LEFT}" y="20" font-size="14">{title}</text>']
    for n in range(x0, x1 + 1):
        at = x(10.0**n)
        out.append(f'<path d="M{at:.1f} {TOP}V{HEIGHT - BOTTOM}" stroke="#ddd"/>'
                   f'<text x="{at:.1f}" y="{HEIGHT - BOTTOM + 16}" text-anchor="middle">{power(n)}</text>')
    every = max(1, (y1 - y0) // 8)
    for n in range(y0, y1 + 1, every):
        at = y(10.0**n)
        out.append(f'<path d="M{LEFT} {at:.1f}H{WIDTH - RIGHT}" stroke="#ddd"/>'
                   f'<text x="{LEFT - 6}" y="{at + 4:.1f}" text-anchor="end">{power(n)}</text>')
    out.append(f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 8}" text-anchor="middle">CPU seconds</text>'
               f'<text transform="translate(14 {HEIGHT / 2}) rotate(-90)" text-anchor="middle">error of the end point</text>')
    for i, (peer, rows) in enumerate(peers.items()):
        colour = COLOURS.get(peer, "black")
        places = [(x(row["seconds"]), y(max(row["error"], 1e-17))) for row in edge(rows)]
        path = "M" + "L".join(f"{a:.1f} {b:.1f}" for a, b in places)
        dots = "".join(f'<circle cx="{a:.1f}" cy="{b:.1f}" r="2.5"/>' for a, b in places)
        out.append(f'<path d="{path}" fill="none" stroke="{colour}" stroke-width="1.5"/><g fill="{colour}">{dots}</g>'
                   f'<text x="{WIDTH - RIGHT + 10}" y="{TOP + 14 + 18 * i}" fill="{colour}">{peer}</text>')
    return "\n".join(out) + "\n</svg>\n"


def fastest(rows, goal):
    reached = [row for row in rows if row["error"] <= goal]
    return min(reached, key=lambda row: row["seconds"], default=None)


def table(peers):
    head = "| | " + " | ".join(map(number, GOALS)) + " |"
    out = [head, "|---|" + "---|" * len(GOALS)]
    least = [min((row["seconds"] for rows in peers.values() if (row := fastest(rows, goal))), default=None)
             for goal in GOALS]
    for peer, rows in peers.items():
        cells = []
        for goal, best in zip(GOALS, least):
            row = fastest(rows, goal)
            if row is None:
                cells.append("–")
                continue
            text = f"{1e3 * row['seconds']:.3g} ms, {row['method']}"
            cells.append(f"**{text}**" if row["seconds"] == best else text)
        out.append(f"| {peer} | " + " | ".join(cells) + " |")
    return "\n".join(out)


def number(goal):
    return f"{goal:.0e}".replace("e-0", "e-")


def bitwise(rows):
    """This library's rows with the same bits on every CPU."""
    return [row for row in rows if not row.get("fused")]


def sentences(peers):
    """Who wins where, in words made of the numbers; this library unfused, as it is without a choice."""
    said = []
    for goal in GOALS:
        found = {peer: fastest(bitwise(rows), goal) for peer, rows in peers.items()}
        found = {peer: row for peer, row in found.items() if row}
        ours = found.pop("hamiltonian", None)
        if not found:
            continue
        peer, best = min(found.items(), key=lambda item: item[1]["seconds"])
        if ours is None:
            said.append(f"Only {peer} and not this library reaches {number(goal)} here.")
        elif best["seconds"] < ours["seconds"]:
            said.append(f"At {number(goal)} {peer} is {ours['seconds'] / best['seconds']:.1f} times as fast as this "
                        "library.")
        else:
            said.append(f"At {number(goal)} this library is {best['seconds'] / ours['seconds']:.1f} times as fast as "
                        f"{peer}.")
    return " ".join(said)


def against_taylor(found):
    """This library, unfused and fused, against heyoka's fastest tolerance with the same error."""
    out = ["## Against Taylor's method", "",
           "The least CPU time with the error or a smaller one, over heyoka's tolerances and over this library's "
           "schemes and steps. heyoka fuses products and sums.", "",
           "| problem | error ≤ | heyoka | this library | ratio | fused | ratio |", "|---|---|---|---|---|---|---|"]
    for name, goal in ASKED.items():
        rows = found.get(name, {})
        taylor = fastest(rows.get("heyoka", []), goal)
        ours = rows.get("hamiltonian", [])
        pair = [fastest(bitwise(ours), goal), fastest([row for row in ours if row.get("fused")], goal)]
        if not taylor or None in pair:
            continue
        text = [f"{1e3 * row['seconds']:.3g} ms, {row['method']}, {row['setting']} | "
                f"{taylor['seconds'] / row['seconds']:.2f}" for row in pair]
        out.append(f"| {TITLES[name]} | {number(goal)} | {1e3 * taylor['seconds']:.3g} ms, {taylor['setting']} | "
                   + " | ".join(text) + " |")
    return [*out, ""] if len(out) > 6 else []


def which_one(found, root):
    """The fastest scheme of this library, by the error of the end point and by that of H: for the chapter of the book."""
    out = ["| problem | error of | " + " | ".join(map(number, GOALS)) + " |", "|---|---|" + "---|" * len(GOALS)]
    for name, title in TITLES.items():
        rows = bitwise(found.get(name, {}).get("hamiltonian", []))
        for word, key in (("the end point", "error"), ("H", "energy")):
            known = [row for row in rows if row.get(key) is not None]
            if not known:
                continue
            best = [min((row for row in known if row[key] <= goal), key=lambda row: row["seconds"], default=None)
                    for goal in GOALS]
            cells = [f"{row['method']}, {1e3 * row['seconds']:.3g} ms" if row else "–" for row in best]
            out.append(f"| {title if key == 'error' else ''} | {word} | " + " | ".join(cells) + " |")
    replace(root / CHAPTER, MARKS, "\n".join(out))


def replace(file, marks, text):
    """Puts a text between two marks of a file."""
    before, old, after = parts(file, marks)
    assert old is not None, f"{file} has no place for a table"
    file.write_text(before + "\n".join([marks[0], text, marks[1]]) + after, encoding="utf-8")


def parts(file, marks):
    """What stands before, between and after two marks; None between where they are missing."""
    before, begin, rest = file.read_text(encoding="utf-8").partition(marks[0])
    between, end, after = rest.partition(marks[1])
    return before, between.strip("\n") if begin and end else None, after


def write(problems, rows, machine, root):
    found = groups(rows)
    versions = sorted({(row["peer"], row["version"]) for row in rows if "version" in row})
    known = {problem["problem"]: problem for problem in problems}
    (root / FIGURES).mkdir(exist_ok=True)
    out = ["# This library and its peers", "",
           "CPU time of one thread on one core against the error of the end point: the largest difference of a "
           "component from a reference in double-double arithmetic (106 bits), whose own error is given. Each time is "
           "the median of three to nine measurements, or one of a run of more than two seconds; each cell is the "
           "fastest setting of the method that reaches the error of its column. This library's curves and cells are "
           "those of its default, which has the same bits on every CPU; fused runs stand in the first table. `python3 benches/peers/run.py` makes these numbers again.", "",
           f"Machine: {machine}. " + ", ".join(f"{peer} {version}" for peer, version in versions) + "."
           + "".join(f" {peer} was not installed and is left out." for peer in COLOURS if peer not in dict(versions)),
           "",
           "Not compared: the time of compilation, of `hamiltonian!` by rustc and of heyoka and numba at run time; "
           "dense output and events; ensembles on several threads and on graphics processors; stiff "
           "problems, for which diffsol, SciPy's LSODA and Julia's solvers are made; collisions and additional forces, "
           "for which REBOUND is. SciPy calls a Python function for each evaluation, as most of its users do.", ""]
    out += against_taylor(found)
    # The section of the other program stays.
    tolerances = parts(root / "BENCHMARKS.md", TOLERANCES)[1] or ""
    out += [TOLERANCES[0], tolerances, TOLERANCES[1], ""]
    which_one(found, root)
    for name, title in TITLES.items():
        if name not in found:
            continue
        peers = {peer: bitwise(found[name][peer]) for peer in COLOURS if peer in found[name]}
        path = root / FIGURES / f"peers_{name}.svg"
        text = figure(title, peers)
        assert len(text) <= 50_000, f"{path} has {len(text)} bytes"
        path.write_text(text, encoding="utf-8")
        out += [f"## {title}", "", f"![{title}: error of the end point against CPU time]({FIGURES}/peers_{name}.svg)", "",
                table(peers), "", sentences(peers), "",
                f"The reference is known to {known[name]['uncertainty']:.0e}.", ""]
    failed = [row for row in rows if "failed" in row]
    if failed:
        out += ["## What failed", ""]
        out += sorted({f"- {row['peer']}, {row['problem']}, {row['method']}, {row['setting']}: {row['failed']}"
                       for row in failed}) + [""]
    (root / "BENCHMARKS.md").write_text("\n".join(out), encoding="utf-8")
