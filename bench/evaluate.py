#!/usr/bin/python3
"""The papers' evaluation in one command: measures with tessera_evaluate, then makes tables (Markdown) and plots (SVG) of its CSV files."""

import argparse
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "bench"))

import report_document  # noqa: E402

try:
    from evaluation import plots, tables
    from evaluation.results_csv import Results
except ModuleNotFoundError as missing:
    if missing.name != "matplotlib":
        raise
    sys.exit(f"evaluate.py: error: {sys.executable} has no matplotlib; run tools/setup.sh --with-bench, then this with /usr/bin/python3")

# Name, which is the function's in tables.py and plots.py, and heading.
SECTIONS = [
    ("machine", "Where it was measured"),
    ("thesis_table_7_2", "Thesis, table 7.2: BREADTH and BOUNDED"),
    ("thesis_figure_7_1", "Thesis, figure 7.1: memory along a camera path through the city"),
    ("thesis_figure_7_2", "Thesis, figure 7.2: rate over batch size and memory"),
    ("thesis_figure_7_3", "Thesis, figure 7.3: LOCAL against BOUNDED"),
    ("thesis_figure_7_4", "Thesis, figure 7.4: load of LOCAL's work-groups"),
    ("thesis_figure_7_5", "Thesis, figures 7.5 and 7.6: shares of the frame"),
    ("host_waits", "Host waits"),
    ("patney_figure_6", "Patney and Owens, figure 6: rate over primitive count"),
    ("patney_figure_7", "Patney and Owens, figure 7: rate over screen size"),
    ("patney_figure_8", "Patney and Owens, figure 8: buckets"),
    ("occlusion", "Occlusion culling"),
    ("budget", "Budgets"),
]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, epilog="Other options go to tessera_evaluate: --runs, --limit, --filter, --quick, "
                                     "--city, --scenes, --device, --cache-dir; see its --help.", allow_abbrev=False)
    parser.add_argument("--from", dest="source", type=pathlib.Path, metavar="FOLDER",
                        help="measure nothing: take the CSV files of this folder, measured here or on another machine")
    parser.add_argument("--out", type=pathlib.Path, metavar="FOLDER",
                        help="CSV files, evaluation.md and plots go here [build/evaluation, or the folder of --from]")
    parser.add_argument("--document", type=pathlib.Path, metavar="FILE",
                        help="also put the tables between this file's markers, <!-- begin NAME --> and <!-- end NAME -->, "
                        "and the plots into images/evaluation beside it")
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/release/bench/evaluation/tessera_evaluate", metavar="FILE",
                        help="tessera_evaluate, built [%(default)s]")
    known, rest = parser.parse_known_args()
    if known.source and rest:
        parser.error(f"{rest[0]} means nothing with --from: nothing is measured")
    return known, rest


def measure(program, out, options):
    if not program.exists():
        sys.exit(f"evaluate.py: error: {program} is not there; build it (cmake --build --preset release) or name it with --program")
    outcome = subprocess.run([program, "--out", out, *options], check=False)
    if outcome.returncode != 0:
        sys.exit(outcome.returncode)


def section(name, results, folder, images):
    """The lines of a section. Its plot is written into `folder`, and linked under the path `images`."""
    lines = getattr(tables, name)(results)
    make_plot = getattr(plots, name, None)
    figure = make_plot(results) if make_plot else None
    if figure:
        folder.mkdir(parents=True, exist_ok=True)
        figure.savefig(folder / f"{name}.svg", bbox_inches="tight", metadata={"Date": None})
        plots.pyplot.close(figure)
        lines = [f"![{dict(SECTIONS)[name]}]({images}{name}.svg)", ""] + lines
    return lines


def main():
    known, options = arguments()
    out = known.out or known.source or ROOT / "build/evaluation"
    if not known.source:
        measure(known.program, out, options)
        if {"--list", "--help", "-h"} & set(options):
            return
    try:
        results = Results(known.source or out)
    except FileNotFoundError as missing:
        sys.exit(f"evaluate.py: error: {missing}")
    out.mkdir(parents=True, exist_ok=True)
    report_document.write_report(out / "evaluation.md", "Evaluation", SECTIONS, lambda name: section(name, results, out, ""))
    if known.document:
        images = known.document.parent / "images/evaluation"
        report_document.update_document("evaluate.py", known.document, SECTIONS,
                                        lambda name: section(name, results, images, "images/evaluation/"))
    print(f"{out / 'evaluation.md'}")


if __name__ == "__main__":
    main()
