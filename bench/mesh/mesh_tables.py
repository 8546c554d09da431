"""Markdown tables of the mesh evaluation: each function takes the results and returns the lines, none where nothing was measured."""

import csv
import json
import pathlib
from statistics import median

from evaluation.tables import table

PAPER = pathlib.Path(__file__).resolve().parent / "paper.csv"
STAGES = ["factors", "offsets", "vertex", "index"]
PAPER_COLUMNS = ["triangles", "vertices", "indices", "factors_ms", "offsets_ms", "vertex_ms", "index_ms", "fps"]


class MeshResults:
    """What mesh_runs.py wrote into `folder`; either file may be missing."""

    def __init__(self, folder):
        self.tables = self._read(folder / "mesh_tables.json")
        self.comparisons = self._read(folder / "mesh_comparisons.json")
        if self.tables is None and self.comparisons is None:
            raise FileNotFoundError(f"{folder} has neither mesh_tables.json nor mesh_comparisons.json")

    @staticmethod
    def _read(path):
        return json.loads(path.read_text(encoding="utf-8")) if path.exists() else None


def number(text):
    return None if text == "" else float(text) if "." in text else int(text)


def paper_figures():
    """Scene -> column -> number, None for what is not known."""
    with PAPER.open(encoding="utf-8", newline="") as file:
        return {row["scene"]: {name: number(value) for name, value in row.items() if name != "scene"} for row in csv.DictReader(file)}


def rate_of(measured):
    return (measured["triangles"] / 2 / measured["patches"]) ** 0.5


def rounds_of(taken, rate, program, name):
    """A measurement over all rounds of a rate, without those that failed."""
    return [one for turn in taken if turn["rate"] == rate for one in turn[program] if one["name"] == name and "error" not in one]


def per_second(measured, stage):
    """Millions of vertices a second: the median of all rounds' runs. None where there are none."""
    rates = [one["vertices"] / milliseconds / 1e3 for one in measured for milliseconds in one["ms"][stage] if milliseconds > 0]
    return median(rates) if rates else None


def points_per_second(measured, count):
    rates = [one[count] / seconds / 1e6 for one in measured for seconds in one["seconds"]]
    return median(rates) if rates else None


def ratio(ours, theirs):
    return f"{ours / theirs:.1f}" if ours and theirs else None


def errors_of(turns):
    """Lines of what failed, once each."""
    seen = {}
    for turn in turns:
        for one in turn["tessera"]:
            if "error" in one:
                seen[f"* {one['name']} failed: {one['error']}"] = True
    return [""] + list(seen) if seen else []


def mesh_machine(results):
    lines = []
    if results.tables:
        told = results.tables
        lines.append(f"Device: {told['device']}. Tessera {told['version']}. Tables: medians of {told['runs']} frames.")
    if results.comparisons:
        told = results.comparisons
        manner = "with real-time priority" if told["real_time"] else "without real-time priority"
        lines.append(f"Comparisons: {told['rounds']} rounds in turn of {told['runs']} runs each, {manner}; medians over all.")
    return lines


def paper_table(results, which):
    if not results.tables:
        return []
    heads = ["scene", "on", "patches", "culled", "triangles", "vertices", "indices", "factors ms", "offsets ms", "vertex data ms",
             "index data ms", "frames/s"]
    paper = paper_figures()
    body = []
    for measured in results.tables["measurements"]:
        kind, scene = measured["name"].split("/", 1)
        if kind != f"table{which}":
            continue
        if "error" in measured:
            body.append([scene, "Tessera", f"failed: {measured['error']}"] + [""] * (len(heads) - 3))
            continue
        times = measured["ms"]
        body.append([scene, "Tessera", measured["patches"], measured["patches_culled"], measured["triangles"], measured["vertices"],
                     3 * measured["triangles"]] + [median(times[stage]) for stage in STAGES] + [1000 / median(times["all"])])
        theirs = paper.get(scene, {})
        if any(theirs.get(column) is not None for column in PAPER_COLUMNS):
            body.append(["", "8800 GTS", theirs["patches"], None] + [theirs[column] for column in PAPER_COLUMNS])
    return table(heads, body) if body else []


def mesh_table_1(results):
    return paper_table(results, 1)


def mesh_table_2(results):
    return paper_table(results, 2)


def mesh_speed(results):
    if not results.comparisons:
        return []
    turns = results.comparisons["sheet"]
    heads = ["mean rate", "patches", "vertices", "M vertices/s: all, full", "vertex data, full", "all, positions", "vertex data, positions",
             "index data, M triangles/s"]
    body = []
    for rate in sorted({turn["rate"] for turn in turns}):
        full = rounds_of(turns, rate, "tessera", f"sheet/{rate}/full")
        bare = rounds_of(turns, rate, "tessera", f"sheet/{rate}/positions")
        if not full or not bare:
            continue
        triangles = [one["triangles"] / time / 1e3 for one in full for time in one["ms"]["index"] if time > 0]
        body.append([rate_of(full[0]), full[0]["patches"], full[0]["vertices"], per_second(full, "all"), per_second(full, "vertex"),
                     per_second(bare, "all"), per_second(bare, "vertex"), median(triangles) if triangles else None])
    return (table(heads, body) if body else []) + errors_of(turns)


def mesh_opensubdiv(results):
    if not results.comparisons:
        return []
    turns = results.comparisons["sheet"]
    heads = ["mean rate", "evaluated", "M points/s: OpenSubdiv CPU", "OpenMP", "Tessera, vertex data", "over CPU", "over OpenMP",
             "Tessera, all stages", "over CPU", "over OpenMP"]
    body = []
    for rate in sorted({turn["rate"] for turn in turns}):
        for ours_name, theirs_name in (("positions", "positions"), ("full", "derivatives")):
            ours = rounds_of(turns, rate, "tessera", f"sheet/{rate}/{ours_name}")
            cpu = points_per_second(rounds_of(turns, rate, "opensubdiv", f"cpu_{theirs_name}"), "points")
            omp = points_per_second(rounds_of(turns, rate, "opensubdiv", f"omp_{theirs_name}"), "points")
            if not ours or cpu is None:
                continue
            vertex, everything = per_second(ours, "vertex"), per_second(ours, "all")
            what = "positions" if ours_name == "positions" else "positions and normals; derivatives"
            body.append([rate, what, cpu, omp, vertex, ratio(vertex, cpu), ratio(vertex, omp), everything, ratio(everything, cpu),
                         ratio(everything, omp)])
    return table(heads, body) if body else []


def mesh_opencascade(results):
    if not results.comparisons:
        return []
    turns = results.comparisons["equal"]
    heads = ["tolerance", "program", "greatest distance seen", "vertices", "triangles", "ms", "M vertices/s", "its time over Tessera's", "Tessera's vertices/s over it"]
    body = []
    for rate in sorted({turn["rate"] for turn in turns}):
        ours = rounds_of(turns, rate, "tessera", f"equal/{rate}/full")
        if not ours:
            continue
        our_ms = median([time for one in ours for time in one["ms"]["all"]])
        our_speed = per_second(ours, "all")
        body.append([ours[0]["tolerance"], "Tessera", ours[0]["distance"], ours[0]["vertices"], ours[0]["triangles"], our_ms, our_speed, None, None])
        for name in ("single", "parallel"):
            theirs = rounds_of(turns, rate, "opencascade", name)
            if theirs:
                their_ms = 1e3 * median([second for one in theirs for second in one["seconds"]])
                speed = points_per_second(theirs, "nodes")
                body.append([None, f"Open CASCADE, {name}", theirs[0]["distance"], int(theirs[0]["nodes"]), int(theirs[0]["triangles"]),
                             their_ms, speed,
                             ratio(their_ms, our_ms), ratio(our_speed, speed)])
    return (table(heads, body) if body else []) + errors_of(turns)
