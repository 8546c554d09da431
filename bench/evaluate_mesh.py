#!/usr/bin/python3
"""The tessellator's evaluation in one command: the paper's tables 1 and 2, and speed beside OpenSubdiv's and Open CASCADE's, as Markdown."""

import argparse
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.dont_write_bytecode = True
sys.path[:0] = [str(ROOT / "bench"), str(ROOT / "bench/mesh")]

import mesh_runs  # noqa: E402
import mesh_tables  # noqa: E402
import report_document  # noqa: E402

# Name, which is the function's in mesh_tables.py, and heading.
SECTIONS = [
    ("mesh_machine", "Where it was measured"),
    ("mesh_table_1", "Schwarz and Stamminger, table 1: rational Bezier patches"),
    ("mesh_table_2", "Schwarz and Stamminger, table 2: PN triangles"),
    ("mesh_speed", "Vertices per second"),
    ("mesh_opensubdiv", "Beside OpenSubdiv"),
    ("mesh_opencascade", "Beside Open CASCADE"),
]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, allow_abbrev=False,
                                     epilog="Other options go to tessera_mesh_bench: --scenes, --device, --cache-dir; see its --help.")
    parser.add_argument("--from", dest="source", type=pathlib.Path, metavar="FOLDER",
                        help="measure nothing: take mesh_tables.json and mesh_comparisons.json of this folder")
    parser.add_argument("--out", type=pathlib.Path, metavar="FOLDER", help="where those and mesh.md go [build/mesh_evaluation]")
    parser.add_argument("--document", type=pathlib.Path, metavar="FILE",
                        help="also put the tables between this file's markers, <!-- begin NAME --> and <!-- end NAME -->")
    parser.add_argument("--programs", type=pathlib.Path, default=ROOT / "build/release/bench/mesh", metavar="FOLDER",
                        help="of tessera_mesh_bench and the comparators, built [%(default)s]")
    parser.add_argument("--runs", type=int, default=5, help="measured runs a turn [%(default)s]")
    parser.add_argument("--rounds", type=int, default=3, help="turns of each program in comparisons [%(default)s]")
    parser.add_argument("--only", choices=["tables", "comparisons"], help="measure just these")
    known, rest = parser.parse_known_args()
    if known.runs < 1 or known.rounds < 1:
        parser.error("--runs and --rounds: at least 1")
    if known.source and rest:
        parser.error(f"{rest[0]} means nothing with --from: nothing is measured")
    return known, rest


def measure(known, options, out):
    programs = mesh_runs.Programs(known.programs, known.runs, options)
    if known.only != "comparisons":
        mesh_runs.measure_tables(programs, out)
    if known.only != "tables":
        for name in ("opensubdiv_sheet", "opencascade_sheet"):
            if not programs.has(name):
                print(f"evaluate_mesh.py: {name} is not built: its comparison is left out (tools/setup.sh --with-bench)", file=sys.stderr)
        mesh_runs.measure_comparisons(programs, out, known.rounds)


def main():
    known, options = arguments()
    out = known.out or known.source or ROOT / "build/mesh_evaluation"
    out.mkdir(parents=True, exist_ok=True)
    if not known.source:
        measure(known, options, out)
    try:
        results = mesh_tables.MeshResults(known.source or out)
    except FileNotFoundError as missing:
        sys.exit(f"evaluate_mesh.py: error: {missing}")

    def section(name):
        return getattr(mesh_tables, name)(results)

    report_document.write_report(out / "mesh.md", "Tessellation", SECTIONS, section)
    if known.document:
        report_document.update_document("evaluate_mesh.py", known.document, SECTIONS, section)
    print(f"{out / 'mesh.md'}")


if __name__ == "__main__":
    main()
