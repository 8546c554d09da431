"""Plots of the evaluation, one function a figure: each takes the results and returns a figure, or None when nothing was measured."""

import matplotlib

matplotlib.use("Agg")

from matplotlib import pyplot
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from evaluation.results_csv import unique
from evaluation.tables import STAGES

# Text stays text, and the same results give the same bytes.
matplotlib.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "tessera", "font.size": 9, "axes.grid": True, "grid.alpha": 0.3,
                            "axes.axisbelow": True, "figure.constrained_layout.use": True, "legend.fontsize": 8, "lines.markersize": 4})

COLORS = pyplot.get_cmap("tab10").colors
METHOD_COLORS = {"BREADTH": COLORS[3], "BOUNDED": COLORS[0], "LOCAL": COLORS[2]}


def panels(results, count, width=4.6, height=3.4, **options):
    """A row of axes under the device's name."""
    figure, axes = pyplot.subplots(1, count, figsize=(width * count, height), squeeze=False, **options)
    figure.suptitle(results.machine["device"], fontsize=8, color="0.4")
    return figure, list(axes[0])


def plain_log(axis):
    """A logarithmic axis with numbers a person reads. Comes after the lines, for it labels 1, 2 and 5 where they have room."""
    axis.axes.set_xscale("log") if axis.axis_name == "x" else axis.axes.set_yscale("log")
    low, high = axis.get_view_interval()
    axis.set_major_locator(LogLocator(subs=(1, 2, 5) if high < 200 * low else (1,)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}" if value < 10000 else f"{value / 1000:g}k"))
    axis.set_minor_formatter(NullFormatter())


def from_zero(axes):
    """So that lengths can be compared, and a flat line does not lie on the edge."""
    high = axes.dataLim.y1
    axes.set_ylim(0, 1.08 * high if high > 0 else 1)


def line(axes, points, **style):
    """A line through the points that have both coordinates; whether there was one."""
    whole = [(x, y) for x, y in points if x is not None and y is not None]
    if whole:
        axes.plot(*zip(*whole), **style)
    return bool(whole)


def drawn(results, figure):
    return [row for row in results.rows(figure) if not row.failed]


def thesis_figure_7_1(results):
    rows = drawn(results, "thesis_figure_7_1")
    modes = unique(row["mode"] for row in rows)
    if not rows:
        return None
    figure, axes = panels(results, len(modes), sharey=True)
    for panel, mode in zip(axes, modes):
        for method in unique(row.method for row in rows if row["mode"] == mode):
            series = [row for row in rows if row["mode"] == mode and row.method == method]
            color = METHOD_COLORS[method]
            line(panel, [(row.number("along"), row.mebibytes("queue_bytes")) for row in series], color=color, label=f"{method}, queues")
            line(panel, [(row.number("along"), row.mebibytes("device_bytes")) for row in series], color=color, linestyle="--",
                 label=f"{method}, all")
        panel.set_title(f"{mode} mode", fontsize=9)
        panel.set_xlabel("camera path")
        panel.set_xticks([0, 0.5, 1], ["average", "spike", "eyesplit"])
        for label, side in zip(panel.get_xticklabels(), ("left", "center", "right")):
            label.set_horizontalalignment(side)
        from_zero(panel)
        panel.legend()
    axes[0].set_ylabel("device memory, MiB")
    return figure


def thesis_figure_7_2(results):
    rows = drawn(results, "thesis_figure_7_2_3")
    if not any(row["method"] == "bounded" for row in rows):
        return None
    figure, (by_batch, by_memory) = panels(results, 2, height=4.0, sharey=True)
    for color, view in zip(COLORS, unique(row.view for row in rows)):
        bounded = [row for row in rows if row.view == view and row["method"] == "bounded"]
        line(by_batch, [(row.number("asked_batch"), row.per_second("processed", "split_ms")) for row in bounded], color=color, marker="o",
             label=view)
        line(by_memory, [(row.mebibytes("queue_bytes"), row.per_second("processed", "split_ms")) for row in bounded], color=color,
             marker="o")
        for row in rows:
            if row.view == view and row["method"] == "breadth":
                for panel in (by_batch, by_memory):
                    panel.axhline(row.per_second("processed", "split_ms"), color=color, linestyle="--", linewidth=0.9)
    by_batch.set_xlabel("batch size, ranges")
    by_memory.set_xlabel("memory of the queues, MiB")
    for panel in (by_batch, by_memory):
        plain_log(panel.xaxis)
        from_zero(panel)
    by_batch.set_ylabel("split rate, M ranges/s")
    figure.legend(loc="lower center", ncols=4, title="BOUNDED; dashed: BREADTH", bbox_to_anchor=(0.5, -0.16))
    return figure


def thesis_figure_7_3(results):
    rows = drawn(results, "thesis_figure_7_2_3")
    if not any(row["method"] == "local" for row in rows):
        return None
    figure, (panel,) = panels(results, 1, width=6.5, height=4.2)
    for color, view in zip(COLORS, unique(row.view for row in rows)):
        for method, style in (("local", "-"), ("bounded", "--")):
            series = [row for row in rows if row.view == view and row["method"] == method]
            line(panel, [(row.number("asked_batch"), row.per_second("processed", "split_ms")) for row in series], color=color,
                 linestyle=style, marker="o", label=view if method == "local" else None)
    plain_log(panel.xaxis)
    from_zero(panel)
    panel.set_xlabel("batch size, ranges")
    panel.set_ylabel("split rate, M ranges/s")
    figure.legend(loc="lower center", ncols=4, title="LOCAL; dashed: BOUNDED", bbox_to_anchor=(0.5, -0.16))
    return figure


def thesis_figure_7_4(results):
    loads = {key: load for key, load in results.loads("thesis_figure_7_4").items() if sum(load)}
    if not loads:
        return None
    views = unique(view for view, _ in loads)
    modes = unique(mode for _, mode in loads)
    figure, grid = pyplot.subplots(len(modes), len(views), figsize=(1.9 * len(views) + 0.6, 2.1 * len(modes) + 0.4), squeeze=False)
    figure.suptitle(results.machine["device"], fontsize=8, color="0.4")
    for across, view in enumerate(views):
        for down, mode in enumerate(modes):
            panel = grid[down][across]
            load = loads.get((view, mode), [])
            if not load:
                panel.set_axis_off()
                continue
            mean = sum(load) / len(load)
            panel.bar(range(len(load)), [ranges / 1000 for ranges in load], width=0.9, color=METHOD_COLORS["LOCAL"])
            panel.axhline(mean / 1000, color="red", linewidth=1)
            panel.set_title(f"{view}\n{mode}, most {max(load) / mean:.2f} x mean", fontsize=7)
            panel.tick_params(labelsize=7)
            from_zero(panel)
            panel.xaxis.get_major_locator().set_params(integer=True)
    for row in grid:
        row[0].set_ylabel("ranges bounded, thousands", fontsize=7)
    for panel in grid[-1]:
        panel.set_xlabel("work-group", fontsize=7)
    return figure


def thesis_figure_7_5(results):
    rows = drawn(results, "thesis_figure_7_5")
    if not rows:
        return None
    modes = unique(row["mode"] for row in rows)
    most = max(sum(row["mode"] == mode for row in rows) for mode in modes)
    figure, axes = panels(results, len(modes), width=5.2, height=1.2 + 0.26 * most)
    colors = dict(zip(STAGES, [*COLORS[:6], "0.85"]))
    for panel, mode in zip(axes, modes):
        series = [row for row in rows if row["mode"] == mode]
        left = [0.0] * len(series)
        for stage in STAGES:
            shares = [max(0.0, 100 * row.number(f"{stage}_ms") / row.number("frame_ms")) for row in series]
            panel.barh(range(len(series)), shares, left=left, color=colors[stage], label=stage if panel is axes[0] else None)
            left = [start + share for start, share in zip(left, shares)]
        panel.set_yticks(range(len(series)), [f"{row.view} {row.method}" for row in series], fontsize=7)
        panel.invert_yaxis()
        panel.set_xlim(0, max(100, *left))
        panel.set_xlabel("share of the frame, %")
        panel.set_title(f"{mode} mode", fontsize=9)
        panel.grid(axis="y", visible=False)
    figure.legend(loc="lower center", ncols=len(STAGES), bbox_to_anchor=(0.5, -0.3 / (0.3 * most)))
    return figure


def two_rates(results, name, horizontal, label, log):
    """Rates of splitting and of dicing, a line a method."""
    rows = drawn(results, name)
    if not rows:
        return None
    figure, (split, dice) = panels(results, 2)
    for method in unique(row.method for row in rows):
        series = [row for row in rows if row.method == method]
        style = {"color": METHOD_COLORS[method], "marker": "o", "label": method}
        line(split, [(horizontal(row), row.per_second("processed", "split_ms")) for row in series], **style)
        line(dice, [(horizontal(row), row.per_second("micropolygons", "dice_ms")) for row in series], **style)
    split.set_ylabel("split rate, M ranges/s")
    dice.set_ylabel("dice rate, M micropolygons/s")
    for panel in (split, dice):
        panel.set_xlabel(label)
        from_zero(panel)
        panel.legend()
        if log:
            plain_log(panel.xaxis)
    return figure


def patney_figure_6(results):
    return two_rates(results, "patney_figure_6", lambda row: row.number("diced"), "input size, grids", log=True)


def patney_figure_7(results):
    return two_rates(results, "patney_figure_7", lambda row: row.number("width"), "picture's width and height, pixels", log=False)


def patney_figure_8(results):
    rows = drawn(results, "patney_figure_8")
    if not rows:
        return None
    figure, axes = panels(results, 4, width=3.2)
    values = [("split rate, M ranges/s", lambda row: row.per_second("processed", "split_ms")), ("frame, ms", lambda row: row.number("frame_ms")),
              ("device memory, MiB", lambda row: row.mebibytes("device_bytes")),
              ("ranges bounded, thousands", lambda row: row.number("processed") / 1000)]
    for panel, (label, value) in zip(axes, values):
        for method in unique(row.method for row in rows):
            series = [row for row in rows if row.method == method]
            line(panel, [(row.number("asked_bucket_width"), value(row)) for row in series], color=METHOD_COLORS[method], marker="o",
                 label=method)
        panel.set_xlabel("bucket's width and height, pixels")
        panel.set_ylabel(label)
        from_zero(panel)
    axes[0].legend()
    return figure


def budget(results):
    rows = drawn(results, "budget")
    if not rows:
        return None
    figure, (time, memory) = panels(results, 2)
    for method in unique(row.method for row in rows):
        series = [row for row in rows if row.method == method]
        style = {"color": METHOD_COLORS[method], "marker": "o", "label": method}
        line(time, [(row.number("asked_MiB"), row.number("frame_ms")) for row in series], **style)
        line(memory, [(row.number("asked_MiB"), row.mebibytes("device_bytes")) for row in series], **style)
    asked = sorted({row.number("asked_MiB") for row in results.rows("budget")})
    memory.plot(asked, asked, color="0.5", linestyle=":", label="budget")
    plain_log(memory.yaxis)
    time.set_ylabel("frame, ms")
    from_zero(time)
    memory.set_ylabel("device memory, most at once, MiB")
    for panel in (time, memory):
        plain_log(panel.xaxis)
        panel.set_xticks(asked, [f"{value:.0f}" for value in asked])
        panel.set_xlabel("budget, MiB")
        panel.legend()
    return figure
