# SPDX-License-Identifier: BSD-3-Clause
"""Plots of the error benchmark, as PNG and SVG. Importing needs matplotlib (python3-matplotlib)."""
import math

import matplotlib

matplotlib.use("Agg")  # no display
import matplotlib.pyplot as plt

from error_benchmark_report import (
    BASELINE, THESIS_MINUTES, equal_error_ratios, pick, skip_pairs, thread_ratios, unique)

# The same input gives the same file, without dates and random names.
plt.rcParams["svg.hashsalt"] = "ParticleOcclusion"
COLORS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"]
MARKERS = "osD^vP"


def save(figure, folder, name):
    figure.savefig(folder / f"{name}.png", dpi=130)
    figure.savefig(folder / f"{name}.svg", metadata={"Date": None})
    plt.close(figure)
    return [f"{name}.png", f"{name}.svg"]


def panels(count, width=4.2, height=3.6):
    """Axes for so many panels, at most four a row."""
    columns = min(4, count)
    lines = math.ceil(count / columns)
    figure, axes = plt.subplots(
        lines, columns, figsize=(width * columns, height * lines), squeeze=False,
        constrained_layout=True)
    flat = list(axes.flat)
    for unused in flat[count:]:
        unused.set_visible(False)
    return figure, flat[:count]


def log_log(axis, x, y):
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.set_xlabel(x)
    axis.set_ylabel(y)
    axis.grid(True, which="both", alpha=0.25)


def line(axis, rows, x, y, label, index):
    rows = [row for row in rows if row.get(x, 0) > 0 and row.get(y, 0) > 0]
    axis.plot([row[x] for row in rows], [row[y] for row in rows],
              marker=MARKERS[index % len(MARKERS)], color=COLORS[index % len(COLORS)],
              markersize=5, label=label)
    return rows


def bars(axis, groups, names, value_of, label="{:.3g}"):
    """Bars of several names side by side in each group, with their values on top."""
    width = 0.8 / len(names)
    for i, name in enumerate(names):
        values = [value_of(group, name) for group in groups]
        places = [j + (i - (len(names) - 1) / 2) * width for j in range(len(groups))]
        drawn = axis.bar(places, [value or 0 for value in values], width, label=name,
                         color=COLORS[i % len(COLORS)])
        axis.bar_label(drawn, [label.format(value) if value else "" for value in values],
                       fontsize=8)
    axis.set_xticks(range(len(groups)), groups, rotation=20)
    axis.grid(True, axis="y", alpha=0.25)
    axis.set_axisbelow(True)
    if len(names) > 1:
        axis.legend(loc="upper left", bbox_to_anchor=(1.01, 1), borderaxespad=0)


def first_of(rows, name):
    return rows[0].get(name) if rows else None


def plot_error(rows, folder):
    scenes = unique(row["scene"] for row in rows)
    figure, axes = panels(len(scenes))
    for axis, scene in zip(axes, scenes):
        for i, method in enumerate(unique(row["method"] for row in rows)):
            drawn = line(axis, pick(rows, scene=scene, method=method), "cpu_s", "rmse", method, i)
            for row in drawn:
                axis.annotate(row["level"], (row["cpu_s"], row["rmse"]), fontsize=7,
                              xytext=(3, 3), textcoords="offset points")
        log_log(axis, "CPU seconds", "RMSE of visibility")
        axis.set_title(f"{scene}, {pick(rows, scene=scene)[0]['particles']:,} particles")
    axes[0].legend()
    return save(figure, folder, "error") + plot_ratios(rows, folder)


def plot_ratios(rows, folder):
    ratios = equal_error_ratios(rows)
    if not ratios:
        return []
    figure, (axis,) = panels(1, 8, 4)
    bars(axis, unique(r["scene"] for r in ratios), unique(r["method"] for r in ratios),
         lambda scene, method: first_of(pick(ratios, scene=scene, method=method), "ratio"))
    axis.axhline(1, color="black", linewidth=0.8)
    axis.set_ylabel("times less CPU time")
    axis.set_title(f"At the RMSE of {BASELINE[0]} {BASELINE[1]}")
    return save(figure, folder, "ratio")


def plot_against(rows, folder, name, x, label, quantities, lines):
    """One panel a quantity over x, log-log, one line for each value of the column `lines`."""
    quantities = {q: text for q, text in quantities.items() if any(q in row for row in rows)}
    figure, axes = panels(len(quantities), 5, 4)
    for axis, (quantity, text) in zip(axes, quantities.items()):
        for i, key in enumerate(unique(tuple(row[c] for c in lines) for row in rows)):
            chosen = pick(rows, **dict(zip(lines, key)))
            line(axis, sorted(chosen, key=lambda row: row[x]), x, quantity, " ".join(key), i)
        log_log(axis, label, text)
    axes[0].legend()
    return save(figure, folder, name)


def plot_size(rows, folder):
    return plot_against(rows, folder, "size", "particles", "particles",
                        {"cpu_s": "CPU seconds", "peak_MB": "peak memory, MB"}, ["scene"])


def plot_resolution(rows, folder):
    return plot_against(rows, folder, "resolution", "resolution", "texture resolution T",
                        {"cpu_s": "CPU seconds", "peak_MB": "peak memory, MB"},
                        ["scene", "method"])


def with_parameter(rows):
    """Rows with the number behind the colon of the scene's name."""
    return [{**row, "parameter": float(row["scene"].rsplit(":", 1)[1])} for row in rows]


def plot_ratio_gas(rows, folder):
    return plot_against(with_parameter(rows), folder, "radii", "parameter",
                        "largest radius over smallest",
                        {"cpu_s": "CPU seconds", "rmse": "RMSE of visibility"}, ["method"])


def plot_overlap(rows, folder):
    return plot_against(with_parameter(rows), folder, "overlap", "parameter",
                        "radius over lattice spacing",
                        {"cpu_s": "CPU seconds", "rmse": "RMSE of visibility"}, ["method"])


def plot_threads(rows, folder):
    ratios = thread_ratios(rows)
    figure, (axis,) = panels(1, 7, 4)
    if ratios:
        bars(axis, unique(r["scene"] for r in ratios), unique(r["method"] for r in ratios),
             lambda scene, method: first_of(pick(ratios, scene=scene, method=method), "ratio"))
    axis.set_ylabel("wall-clock, times faster than one thread")
    return save(figure, folder, "threads")


def plot_simd(rows, folder):
    figure, (axis,) = panels(1, 7, 4)
    bars(axis, unique(row["scene"] for row in rows), unique(row["target"] for row in rows),
         lambda scene, target: first_of(pick(rows, scene=scene, target=target), "cpu_s"))
    axis.set_ylabel("CPU seconds")
    return save(figure, folder, "simd")


def plot_skips(rows, folder):
    pairs = skip_pairs(rows)
    if not pairs:
        return []
    figure, (axis,) = panels(1, 10, 4)
    bars(axis, unique(p["scene"] for p in pairs), unique(p["skip"] for p in pairs),
         lambda scene, skip: first_of(pick(pairs, scene=scene, skip=skip), "ratio"))
    axis.axhline(1, color="black", linewidth=0.8)
    axis.set_ylabel("CPU time without the skip / with it")
    return save(figure, folder, "skips")


def plot_rays(rows, folder):
    figure, (axis,) = panels(1, 7, 4)
    bars(axis, [row["scene"] for row in rows], ["ray rate"],
         lambda scene, _: 100 * first_of(pick(rows, scene=scene), "ray_rate"))
    axis.set_ylabel("rate of tracing, % of bare rtcOccluded1")
    return save(figure, folder, "rays")


def plot_thesis(rows, folder):
    figure, (axis,) = panels(1, 8, 4)
    names = ["thesis, fastest", "thesis, slowest"] + [row["scene"] for row in rows]
    minutes = list(THESIS_MINUTES) + [row["wall_s"] / 60 for row in rows]
    bars(axis, names, ["minutes"], lambda name, _: minutes[names.index(name)])
    axis.set_yscale("log")
    axis.set_ylabel("minutes, wall-clock")
    return save(figure, folder, "thesis")


PLOTS = {
    "error": plot_error, "size": plot_size, "resolution": plot_resolution,
    "radii": plot_ratio_gas, "overlap": plot_overlap, "threads": plot_threads,
    "simd": plot_simd, "skips": plot_skips, "rays": plot_rays, "thesis": plot_thesis}


def plot(series, rows, folder):
    """Draws what there is to draw of a series; returns the names of the files."""
    return PLOTS[series](rows, folder)
