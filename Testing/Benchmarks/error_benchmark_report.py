# SPDX-License-Identifier: BSD-3-Clause
"""Rows of the error benchmark as CSV and Markdown, and what is derived from them."""
import collections
import csv
import math
import os

COLUMNS = [
    "series", "scene", "particles", "resolution", "method", "level", "threads", "target",
    "measured_particles", "cpu_s", "wall_s", "scene_cpu_s", "scene_wall_s", "peak_MB", "scene_MB",
    "rmse", "bias", "p99", "judge_noise", "judged_particles", "max_difference",
    "skip", "state", "condition", "rms_difference",
    "spheresClosed", "spheresNeverSeen", "directionsBlack", "texelsInside", "particlesBuried",
    "particlesAlone", "texturesStored",
    "rays", "bake_ms", "generate_ms", "bare_ms", "share", "ray_rate"]
TEXT_COLUMNS = {"series", "scene", "method", "target", "skip", "state", "condition"}
WHOLE_COLUMNS = {
    "particles", "resolution", "level", "threads", "measured_particles", "judged_particles",
    "spheresClosed", "spheresNeverSeen", "directionsBlack", "texelsInside", "particlesBuried",
    "particlesAlone", "texturesStored", "rays"}

BASELINE = ("Reference", 49)
ALL_RAYS = ("Thesis", 49)  # the same, but for samples inside other particles: those are traced too

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


# CPU seconds and level of a method at an error, and "at most" where it is an upper bound, or "".
Crossing = collections.namedtuple("Crossing", "cpu_s level bound")


def at_error(rows, error):
    """The crossing of an RMSE by a method, between two levels on a log-log line.

    If even the coarsest level is better, that level and "at most"; nothing if no level is good
    enough. Where the error goes up and down, the last crossing counts.
    """
    rows = [row for row in sorted(rows, key=lambda row: row["level"]) if row["rmse"] > 0]
    for coarse, fine in reversed(list(zip(rows, rows[1:]))):
        if coarse["rmse"] >= error >= fine["rmse"]:
            span = math.log(fine["rmse"] / coarse["rmse"])
            t = math.log(error / coarse["rmse"]) / span if span else 0
            return Crossing(*(coarse[name] * (fine[name] / coarse[name]) ** t
                              for name in ["cpu_s", "level"]), "")
    if rows and rows[0]["rmse"] < error:
        return Crossing(rows[0]["cpu_s"], rows[0]["level"], "at most")
    return None


def equal_error_ratios(rows):
    """For each scene and method but the baselines': how many times less CPU time at the RMSE of
    BASELINE, and how many times less than ALL_RAYS, if that was measured."""
    ratios = []
    for scene in unique(row["scene"] for row in rows):
        baseline = pick(rows, scene=scene, method=BASELINE[0], level=BASELINE[1])
        if not baseline or "rmse" not in baseline[0]:
            continue
        all_rays = pick(rows, scene=scene, method=ALL_RAYS[0], level=ALL_RAYS[1])
        all_rays_s = all_rays[0]["cpu_s"] if all_rays else None
        for method in unique(row["method"] for row in pick(rows, scene=scene)):
            found = at_error(pick(rows, scene=scene, method=method), baseline[0]["rmse"])
            if method not in (BASELINE[0], ALL_RAYS[0]) and found:
                ratios.append({
                    "scene": scene, "method": method, "rmse": baseline[0]["rmse"],
                    "baseline_s": baseline[0]["cpu_s"], **found._asdict(),
                    "ratio": baseline[0]["cpu_s"] / found.cpu_s, "all_rays_s": all_rays_s,
                    "all_rays_ratio": all_rays_s and all_rays_s / found.cpu_s})
    return ratios


def thread_ratios(rows):
    """Wall-clock seconds with one thread over those with more."""
    ratios = []
    for row in rows:
        single = pick(rows, scene=row["scene"], method=row["method"], threads=1)
        if single and row["threads"] != 1:
            ratios.append({**row, "ratio": single[0]["wall_s"] / row["wall_s"]})
    return ratios


def skip_pairs(rows):
    """For each scene and skip the rows with and without it."""
    pairs = []
    for off in pick(rows, state="off"):
        on = pick(rows, scene=off["scene"], skip=off["skip"], state="on")
        if on:
            pairs.append({"scene": off["scene"], "skip": off["skip"], "on": on[0], "off": off,
                          "ratio": off["cpu_s"] / on[0]["cpu_s"]})
    return pairs


def spared(row):
    """What a sweep left out by the skip that the row is about, in words."""
    directions = row["level"] - row["directionsBlack"]
    counts = {"closedCells": "spheresClosed", "neverSeen": "spheresNeverSeen"}
    if row["skip"] in counts:
        share = row[counts[row["skip"]]] / (row["particles"] * max(1, directions))
        return f"{100 * share:.1f} % of visits"
    if row["skip"] == "lonely":
        return f"{row['particlesAlone']} of {row['particles']} particles"
    if row["skip"] == "blackSky":
        return f"{row['directionsBlack']} of {row['level']} directions"
    return "not counted"


def ray_row(results, family):
    """The fastest of BenchmarkBake for a family, and what it makes of them itself."""
    fastest = {result["run_name"].split("/")[0]: result for result in results
               if result.get("aggregate_name") == "fastest"
               and result["run_name"].split("/")[1] == family}
    bake, generate, bare = (
        fastest[name]["cpu_time"] for name in ["Bake", "Generate", "Bare"])
    return {"rays": round(fastest["Bare"]["rays"]), "bake_ms": bake, "generate_ms": generate,
            "bare_ms": bare, "share": (generate + bare) / bake,
            "ray_rate": bare / (bake - generate)}


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


def scene_and_condition(row):
    condition = row.get("condition")
    return f"{row['scene']} ({condition})" if condition else row["scene"]


def noise_line(rows):
    noises = {scene_and_condition(row): row["judge_noise"] for row in rows if "judge_noise" in row}
    if not noises:
        return ""
    listed = ", ".join(f"{scene} {number(noise, 2)}" for scene, noise in noises.items())
    return f"\nRMS noise of the reference values themselves: {listed}.\n"


def scaled_line(rows):
    scaled = [row for row in rows if row["measured_particles"] < row["particles"]]
    if not scaled:
        return ""
    methods = " and ".join(unique(row["method"] for row in scaled))
    return (f"\nThe seconds of {methods} were measured on "
            f"{min(row['measured_particles'] for row in scaled)} particles or more, drawn at "
            "random, and are scaled to all; their memory is that of the measured ones.\n")


def error_extra(rows):
    ratios = equal_error_ratios(rows)
    if not ratios:
        return ""
    lines = [[r["scene"], r["method"], r["rmse"], r["baseline_s"], r["all_rays_s"],
              f"{r['bound']} {round(r['level'])}".strip(),
              f"{r['bound']} {number(r['cpu_s'])}".strip(),
              *(f"{'at least ' if r['bound'] else ''}{number(ratio)}"
                for ratio in (r["ratio"], r["all_rays_ratio"]))] for r in ratios]
    return (f"\n## At the RMSE of {BASELINE[0]} {BASELINE[1]}\n\n"
            "Interpolated between levels, log-log; CPU seconds. All rays: the thesis' way to the "
            "letter, which\ntraces samples inside other particles too.\n\n" +
            table(["scene", "method", "RMSE", f"{BASELINE[0]} {BASELINE[1]}, s", "all rays, s",
                   "directions", "s", "ratio", "ratio to all rays"], lines))


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


def skips_body(rows):
    lines = [[p["scene"], p["skip"], p["on"]["cpu_s"], p["off"]["cpu_s"], p["ratio"],
              p["on"]["rmse"], p["off"]["rmse"], p["off"]["rms_difference"], spared(p["on"])]
             for p in skip_pairs(rows)]
    return ("Each skip is switched off alone. blackSky: under a background that is black below the "
            "horizon.\nlonely: spheres occlude within one mean radius only. A visit is one sphere in one direction.\n\n" +
            table(["scene", "skip", "CPU s on", "off", "off / on", "RMSE on", "off",
                   "RMS difference", "spared"], lines) + stored_table(rows))


def stored_table(rows):
    """What needs no switch, from the rows that go on to the table of stored textures."""
    lines = [[row["scene"], row["particles"], row["particlesBuried"],
              f"{100 * row['texelsInside'] / (row['particles'] * row['resolution']**2):.1f} %",
              row["texturesStored"], row["cpu_s"]]
             for row in rows if "texturesStored" in row]
    return "\n## Always spared\n\n" + table(
        ["scene", "particles", "buried", "texels inside others", "textures stored",
         "CPU s with the table"], lines)


def rays_body(rows):
    lines = [[row["scene"], row["rays"], row["bake_ms"], row["generate_ms"], row["bare_ms"],
              f"{100 * row['share']:.0f} %", f"{100 * row['ray_rate']:.0f} %"] for row in rows]
    return ("One thread, CPU milliseconds, fastest repetitions. Share = (generate + bare) / bake; ray rate = "
            "bare /\n(bake - generate), the rate of tracing against the bare loop's.\n\n" +
            table(["family", "rays", "bake, ms", "generate", "bare Embree", "share", "ray rate"],
                  lines))


# Series whose rows are no plain measurements.
BODIES = {"skips": skips_body, "rays": rays_body}
EXTRAS = {"error": error_extra, "threads": threads_extra, "thesis": thesis_extra}


def write_markdown(file, series, title, rows):
    """The whole report of one series."""
    if series in BODIES:
        body = BODIES[series](rows) + noise_line(rows)
    else:
        extra = EXTRAS[series](rows) if series in EXTRAS else ""
        body = rows_table(rows) + noise_line(rows) + scaled_line(rows) + extra
    file.write_text(f"# {title}\n\n{body}", encoding="utf-8")
