"""Runs the programs of the mesh evaluation in turns, and keeps what they print as JSON."""

import json
import pathlib
import shutil
import subprocess
import sys

# Mean rate -> patches along the sheet, as in mesh_measure.cpp: a million cells.
RATES = {4: 256, 8: 128, 16: 64, 32: 32, 64: 16}
EQUAL_ALONG = 32


def real_time():
    """Words before a command that keep other programs off its cores, where that is allowed."""
    words = ["chrt", "-f", "5"]
    if shutil.which("chrt") and subprocess.run(words + ["true"], check=False, capture_output=True).returncode == 0:
        return words
    return []


class Programs:
    """The executables of `folder`, and what they are run with."""

    def __init__(self, folder, runs, options):
        self.folder = folder
        self.runs = runs
        self.options = options
        self.before = real_time()

    def path(self, name):
        return self.folder / name

    def has(self, name):
        return self.path(name).exists()

    def _run(self, words, **how):
        outcome = subprocess.run(self.before + [str(word) for word in words], check=False, text=True, **how)
        return outcome.returncode, outcome.stdout

    def tessera(self, name_filter, out, runs=None):
        """The JSON of tessera_mesh_bench. Failures of single measurements stand in it."""
        if not self.has("tessera_mesh_bench"):
            sys.exit(f"evaluate_mesh.py: error: {self.path('tessera_mesh_bench')} is not there; build it or name its folder with --programs")
        out.unlink(missing_ok=True)
        words = [self.path("tessera_mesh_bench"), "--filter", name_filter, "--runs", runs or self.runs, "--json", out, *self.options]
        code, _ = self._run(words)
        if not out.exists():
            sys.exit(code or 1)
        return json.loads(out.read_text(encoding="utf-8"))

    def comparator(self, name, **numbers):
        """The lines of JSON that a comparator prints; none where it is not built."""
        if not self.has(name):
            return []
        words = [self.path(name)]
        for option, value in numbers.items():
            words += [f"--{option}", value]
        code, text = self._run(words, stdout=subprocess.PIPE)
        if code != 0:
            sys.exit(code)
        return [json.loads(line) for line in text.splitlines()]


def measure_tables(programs, out):
    programs.tessera("^table", out / "mesh_tables.json")


def compare_rates(programs, out, rounds):
    """Tessera and OpenSubdiv take turns at each rate, round by round: a machine whose speed drifts is as fast for one as for the other."""
    taken = []
    for rate, along in RATES.items():
        for _ in range(rounds):
            ours = programs.tessera(f"^sheet/{rate}/", out / "turn.json")
            theirs = programs.comparator("opensubdiv_sheet", along=along, rate=rate, runs=programs.runs)
            taken.append({"rate": rate, "along": along, "tessera": ours["measurements"], "opensubdiv": theirs})
    return taken


def compare_tolerances(programs, out, rounds):
    """Tessera and Open CASCADE at the tolerance that gave Tessera its rate."""
    taken = []
    for rate in (8, 16):
        for _ in range(rounds):
            ours = programs.tessera(f"^equal/{rate}/", out / "turn.json")["measurements"]
            made = [one for one in ours if "error" not in one]
            theirs = programs.comparator("opencascade_sheet", along=EQUAL_ALONG, tolerance=repr(made[0]["tolerance"]), runs=1) if made else []
            taken.append({"rate": rate, "tessera": ours, "opencascade": theirs})
    return taken


def measure_comparisons(programs, out, rounds):
    comparisons = {
        "rounds": rounds,
        "runs": programs.runs,
        "real_time": bool(programs.before),
        "sheet": compare_rates(programs, out, rounds),
        "equal": compare_tolerances(programs, out, rounds),
    }
    pathlib.Path(out / "turn.json").unlink(missing_ok=True)
    (out / "mesh_comparisons.json").write_text(json.dumps(comparisons, indent=1), encoding="utf-8")
