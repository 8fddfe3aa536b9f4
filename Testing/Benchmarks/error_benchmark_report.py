# SPDX-License-Identifier: BSD-3-Clause
"""Rows of the error benchmark as CSV and Markdown, and what is derived from them."""
import csv
import math
import os

COLUMNS = [
    "series", "scene", "particles", "resolution", "method", "level", "threads", "target",
    "measured_particles", "cpu_s", "wall_s", "scene_cpu_s", "scene_wall_s", "peak_MB", "scene_MB",
    "rmse", "bias", "p99", "judge_noise", "judged_particles", "max_difference"]
TEXT_COLUMNS = {"series", "scene", "method", "target"}
WHOLE_COLUMNS = {
    "particles", "resolution", "level", "threads", "measured_particles", "judged_particles"}

BASELINE = ("Reference", 49)

# Bigler 2004, table 3.1: 955,000 particles, 16 x 16 texels, 49 samples a texel.
THESIS_PARTICLES = 955_000
THESIS_MINUTES = (66, 261)
THESIS_MACHINE = "20 processors, SGI Origin 3800, 600 MHz"


def write_csv(file, rows):
    """Replaces the file as a whole: an interrupted run leaves the rows that it had."""
    part = file.with_suffix(".part")
    with open(part, "w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, COLUMNS, restval="")
        writer.writeheader()
        writer.writerows(rows)
    os.replace(part, file)


def read_csv(file):
    with open(file, newline="", encoding="utf-8") as stream:
        return [parse_row(row) for row in csv.DictReader(stream)]


def parse_row(row):
    """Numbers as numbers; what was not measured is left out."""
    parsed = {}
    for name, value in row.items():
        if value == "":
            continue
        if name in TEXT_COLUMNS:
            parsed[name] = value
        else:
            parsed[name] = int(value) if name in WHOLE_COLUMNS else float(value)
    return parsed


def unique(values):
    """In the order in which they came first."""
    return list(dict.fromkeys(values))


def pick(rows, **wanted):
    return [row for row in rows if all(row.get(name) == value for name, value in wanted.items())]


def seconds_at_error(rows, error):
    """CPU seconds of a method at an RMSE, between two levels on a log-log line.

    Returns the seconds and "" or, if even the coarsest level is better, its seconds and "at most";
    nothing if no level is good enough. Where the error goes up and down, the last crossing counts.
    """
    rows = [row for row in sorted(rows, key=lambda row: row["level"]) if row["rmse"] > 0]
    for coarse, fine in reversed(list(zip(rows, rows[1:]))):
        if coarse["rmse"] >= error >= fine["rmse"]:
            span = math.log(fine["rmse"] / coarse["rmse"])
            t = math.log(error / coarse["rmse"]) / span if span else 0
            return coarse["cpu_s"] * (fine["cpu_s"] / coarse["cpu_s"]) ** t, ""
    if rows and rows[0]["rmse"] < error:
        return rows[0]["cpu_s"], "at most"
    return None


def equal_error_ratios(rows):
    """For each scene and method but the baseline's: how many times less CPU time at its RMSE."""
    ratios = []
    for scene in unique(row["scene"] for row in rows):
        baseline = pick(rows, scene=scene, method=BASELINE[0], level=BASELINE[1])
        if not baseline or "rmse" not in baseline[0]:
            continue
        for method in unique(row["method"] for row in pick(rows, scene=scene)):
            found = seconds_at_error(pick(rows, scene=scene, method=method), baseline[0]["rmse"])
            if method != BASELINE[0] and found:
                ratios.append({
                    "scene": scene, "method": method, "rmse": baseline[0]["rmse"],
                    "baseline_s": baseline[0]["cpu_s"], "cpu_s": found[0],
                    "ratio": baseline[0]["cpu_s"] / found[0], "bound": found[1]})
    return ratios


def thread_ratios(rows):
    """Wall-clock seconds with one thread over those with more."""
    ratios = []
    for row in rows:
        single = pick(rows, scene=row["scene"], method=row["method"], threads=1)
        if single and row["threads"] != 1:
            ratios.append({**row, "ratio": single[0]["wall_s"] / row["wall_s"]})
    return ratios


# ---- Markdown

def number(value, digits=3):
    """Three significant digits, without an exponent where a number is not extreme."""
    if value is None:
        return ""
    if isinstance(value, (int, str)):
        return f"{value}"
    if value == 0 or 1e-5 <= abs(value) < 1e6:
        decimals = 0 if value == 0 else max(0, digits - 1 - math.floor(math.log10(abs(value))))
        return f"{value:.{decimals}f}"
    return f"{value:.{digits}g}"


def table(headings, lines):
    """Lines of cells as a Markdown table; columns of numbers to the right."""
    right = [all(not isinstance(line[i], str) for line in lines) for i in range(len(headings))]
    rule = ["---:" if flag else "---" for flag in right]
    rows = [headings, rule] + [[number(cell) for cell in line] for line in lines]
    return "\n".join("| " + " | ".join(row) + " |" for row in rows) + "\n"


MARKDOWN_COLUMNS = {
    "scene": "scene", "particles": "particles", "resolution": "T", "method": "method",
    "level": "level", "threads": "threads", "target": "instructions", "cpu_s": "CPU s",
    "wall_s": "wall s", "peak_MB": "peak MB", "rmse": "RMSE", "bias": "bias",
    "p99": "99 % of errors below", "max_difference": "largest difference"}


def rows_table(rows):
    """All rows, with the columns that any of them has."""
    names = [name for name in MARKDOWN_COLUMNS if any(name in row for row in rows)]
    return table([MARKDOWN_COLUMNS[name] for name in names],
                 [[row.get(name) for name in names] for row in rows])


def noise_line(rows):
    noises = {row["scene"]: row["judge_noise"] for row in rows if "judge_noise" in row}
    if not noises:
        return ""
    listed = ", ".join(f"{scene} {number(noise, 2)}" for scene, noise in noises.items())
    return f"\nRMS noise of the reference values themselves: {listed}.\n"


def scaled_line(rows):
    scaled = [row for row in rows if row["measured_particles"] < row["particles"]]
    if not scaled:
        return ""
    methods = ", ".join(unique(row["method"] for row in scaled))
    return (f"\nThe seconds of {methods} were measured on "
            f"{min(row['measured_particles'] for row in scaled)} particles or more, drawn at "
            "random, and are scaled to all; its memory is that of the measured ones.\n")


def error_extra(rows):
    ratios = equal_error_ratios(rows)
    if not ratios:
        return ""
    lines = [[r["scene"], r["method"], r["rmse"], r["baseline_s"],
              f"{r['bound']} {number(r['cpu_s'])}".strip(),
              f"{'at least ' if r['bound'] else ''}{number(r['ratio'])}"] for r in ratios]
    return (f"\n## At the RMSE of {BASELINE[0]} {BASELINE[1]}\n\n"
            "Interpolated between levels, log-log; CPU seconds.\n\n" +
            table(["scene", "method", "RMSE", f"{BASELINE[0]} {BASELINE[1]}, s", "s", "ratio"],
                  lines))


def threads_extra(rows):
    lines = [[r["scene"], r["method"], r["threads"], r["ratio"]] for r in thread_ratios(rows)]
    return "\n## Times faster than one thread, wall-clock\n\n" + table(
        ["scene", "method", "threads", "ratio"], lines)


def thesis_extra(rows):
    low, high = THESIS_MINUTES
    lines = [["Bigler 2004, table 3.1", THESIS_PARTICLES, THESIS_MACHINE, f"{low} to {high}"]]
    for row in rows:
        lines.append([f"{row['scene']}, {row['method']} {row['level']}", row["particles"],
                      f"{row['threads']} threads", number(row["wall_s"] / 60)])
    return ("\n## Beside the thesis\n\n"
            "16 x 16 texels; the thesis took 49 samples a texel, and Sweep as many directions as the "
            "filter\ntakes for 49 samples.\n\n" +
            table(["data", "particles", "machine", "minutes, wall-clock"], lines))


EXTRAS = {"error": error_extra, "threads": threads_extra, "thesis": thesis_extra}


def write_markdown(file, series, title, rows):
    """The whole report of one series."""
    extra = EXTRAS[series](rows) if series in EXTRAS else ""
    text = (f"# {title}\n\n" + rows_table(rows) + noise_line(rows) + scaled_line(rows) + extra)
    file.write_text(text, encoding="utf-8")
