"""Markdown tables of the evaluation, one function a figure: each takes the results and returns the lines, none when nothing was measured."""

from evaluation.results_csv import unique


def cell(value, digits=3):
    """A number with so many significant digits, in full where it is a count; a dash for what is missing."""
    if value is None:
        return "–"
    if isinstance(value, str):
        return value.replace("|", "\\|")
    if isinstance(value, int):
        return str(value)
    if value == 0:
        return "0"
    text = f"{value:.{digits}g}"
    return f"{value:.0f}" if "e" in text else text


def table(heads, rows):
    lines = ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    lines += ["| " + " | ".join(cell(value) for value in row) + " |" for row in rows]
    return lines


def failure(row, before, width):
    """A row of a trial that failed: its error stands where its numbers would."""
    return before + [f"failed: {row.error}"] + [""] * (width - len(before) - 1)


def batch_text(row):
    """Breadth has no batch size; of the others what the plan chose where none was asked for."""
    if row["method"] == "breadth":
        return "–"
    return row["asked_batch"] if row["asked_batch"] != "0" else f"auto ({row['batch'] or '–'})"


def machine(results):
    told = results.machine
    lines = [f"Device: {results.device}, {told['memory_MiB']} MiB. Tessera {told['version']}. Up to {told['runs']} frames a trial, in turn, "
             f"no further round after {told['limit_s']} s; times are medians."]
    if told["quick"] == "1":
        lines.append("")
        lines.append("**Small pictures and scenes (--quick): a trial of the program, no measurement.**")
    return lines


def thesis_table_7_2(results):
    heads = ["scene", "method", "batch", "split ms", "queues MiB", "device MiB", "largest stack", "processed", "M ranges/s", "frame ms"]
    lines = []
    rows = results.rows("thesis_table_7_2")
    for mode in unique(row["mode"] for row in rows):
        body = []
        for row in rows:
            if row["mode"] != mode:
                continue
            before = [row.view, row.method, batch_text(row)]
            if row.failed:
                body.append(failure(row, before, len(heads)))
                continue
            body.append(before + [row.number("split_ms"), row.mebibytes("queue_bytes"), row.mebibytes("device_bytes"),
                                  row.count("stack_peak"), row.count("processed"), row.per_second("processed", "split_ms"),
                                  row.number("frame_ms")])
        lines += ["", f"{mode.capitalize()} mode:", ""] + table(heads, body)
    return lines[1:]


def thesis_figure_7_1(results):
    rows = results.rows("thesis_figure_7_1")
    body = []
    for mode, method in unique((row["mode"], row.method) for row in rows):
        series = [row for row in rows if row["mode"] == mode and row.method == method]
        drawn = [row for row in series if not row.failed]
        failed = [row for row in series if row.failed]
        for column, what in (("queue_bytes", "queues"), ("device_bytes", "all")):
            sizes = [size for size in (row.mebibytes(column) for row in drawn) if size is not None]
            body.append([mode, method, what] + ([min(sizes), max(sizes)] if sizes else [None, None]) +
                        [len(failed), failed[0].error if failed else ""])
    heads = ["mode", "method", "memory", "least MiB", "most MiB", "steps that failed", "why"]
    return table(heads, body) if rows else []


def batch_sizes(results, methods):
    """Rates over batch size: a row a view and method, a column a batch size."""
    rows = results.rows("thesis_figure_7_2_3")
    sizes = sorted({row.count("asked_batch") for row in rows} - {0})
    body = []
    for view in unique(row.view for row in rows):
        for method in methods:
            rates = {row.count("asked_batch"): "failed" if row.failed else row.per_second("processed", "split_ms")
                     for row in rows if row.view == view and row["method"] == method}
            if rates:
                values = [rates.get(0)] * len(sizes) if method == "breadth" else [rates.get(size) for size in sizes]
                body.append([view, method.upper()] + values)
    errors = unique(f"{row.method}: {row.error}" for row in rows if row.failed and row["method"] in methods)
    lines = table(["scene", "M ranges/s"] + [str(size) for size in sizes], body) if body else []
    return lines + ([""] + [f"* failed: {error}" for error in errors] if errors else [])


def thesis_figure_7_2(results):
    return batch_sizes(results, ["breadth", "bounded"])


def thesis_figure_7_3(results):
    return batch_sizes(results, ["bounded", "local"])


def thesis_figure_7_4(results):
    rows = results.rows("thesis_figure_7_4")
    loads = results.loads("thesis_figure_7_4")
    body = []
    for row in rows:
        load = loads.get((row.view, row["mode"]))
        if row.failed:
            body.append(failure(row, [row.view, row["mode"]], 7))
        elif load and sum(load):
            mean = sum(load) / len(load)
            body.append([row.view, row["mode"], len(load), row.count("launches"), mean, max(load), max(load) / mean])
    heads = ["scene", "mode", "work-groups", "launches", "average ranges", "most", "most / average"]
    return table(heads, body) if body else []


STAGES = ["place", "split", "dice", "resolve", "shade", "other", "idle"]


def thesis_figure_7_5(results):
    rows = results.rows("thesis_figure_7_5")
    body = []
    for row in rows:
        before = [row.view, row["mode"], row.method]
        if row.failed:
            body.append(failure(row, before, len(before) + 1 + len(STAGES)))
            continue
        frame = row.number("frame_ms")
        body.append(before + [frame] + [f"{100 * row.number(stage + '_ms') / frame:.0f} %" for stage in STAGES])
    return table(["scene", "mode", "method", "frame ms"] + STAGES, body) if rows else []


def host_waits(results):
    rows = results.rows("thesis_figure_7_5")
    heads = ["scene", "mode", "method", "host waits a frame", "iterations", "launches", "batches"]
    body = []
    for row in rows:
        before = [row.view, row["mode"], row.method]
        if row.failed:
            body.append(failure(row, before, len(heads)))
        else:
            body.append(before + [row.count(column) for column in ("host_waits", "iterations", "launches", "batches")])
    return table(heads, body) if rows else []


def patney(results, figure, heads, columns):
    """Split and dice rates of a figure by Patney and Owens; `columns`: what it varies."""
    rows = results.rows(figure)
    rest = ["grids", "split ms", "dice ms", "M ranges/s", "M micropolygons/s", "frame ms"]
    body = []
    for row in rows:
        before = [column(row) for column in columns] + [row.method]
        if row.failed:
            body.append(failure(row, before, len(before) + len(rest)))
            continue
        body.append(before + [row.count("diced"), row.number("split_ms"), row.number("dice_ms"), row.per_second("processed", "split_ms"),
                              row.per_second("micropolygons", "dice_ms"), row.number("frame_ms")])
    return table(heads + ["method"] + rest, body) if rows else []


def patney_figure_6(results):
    return patney(results, "patney_figure_6", ["patches"], [lambda row: row["scene"].removeprefix("random_")])


def patney_figure_7(results):
    return patney(results, "patney_figure_7", ["scene", "picture"], [lambda row: row.view, lambda row: f"{row['width']}x{row['height']}"])


def patney_figure_8(results):
    heads = ["scene", "bucket", "method", "buckets", "frame ms", "M ranges/s", "device MiB", "queues MiB", "film MiB", "processed",
             "patches skipped"]
    body = []
    for row in results.rows("patney_figure_8"):
        before = [row.view, f"{row['asked_bucket_width']}x{row['asked_bucket_height']}", row.method]
        if row.failed:
            body.append(failure(row, before, len(heads)))
            continue
        body.append(before + [row.count("buckets"), row.number("frame_ms"), row.per_second("processed", "split_ms"),
                              row.mebibytes("device_bytes"), row.mebibytes("queue_bytes"), row.mebibytes("film_bytes"),
                              row.count("processed"), row.count("patches_skipped")])
    return table(heads, body) if body else []


def occlusion(results):
    heads = ["scene", "frame ms without", "with", "gain", "processed without", "with", "occluded", "micropolygons without", "with"]
    rows = results.rows("occlusion")
    body = []
    for view in unique(row.view for row in rows):
        pair = {row["occlusion"]: row for row in rows if row.view == view}
        if len(pair) < 2:
            continue
        without, within = pair["0"], pair["1"]
        if without.failed or within.failed:
            body.append(failure(without if without.failed else within, [view], len(heads)))
            continue
        times = [without.number("frame_ms"), within.number("frame_ms")]
        body.append([view] + times + [times[0] / times[1], without.count("processed"), within.count("processed"), within.count("occluded"),
                                      without.count("micropolygons"), within.count("micropolygons")])
    return table(heads, body) if body else []


def budget(results):
    heads = ["budget MiB", "method", "frame ms", "device MiB", "batch", "buckets", "chunks", "uploaded MiB", "growths"]
    body = []
    for row in results.rows("budget"):
        before = [row["asked_MiB"], row.method]
        if row.failed:
            body.append(failure(row, before, len(heads)))
            continue
        batch = None if row["method"] == "breadth" else row.count("batch")
        body.append(before + [row.number("frame_ms"), row.mebibytes("device_bytes"), batch, row.count("buckets"), row.count("chunks"),
                              row.number("streamed_bytes") / 2**20, row.count("stack_growths")])
    return table(heads, body) if body else []
