#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Benchmark of run time against error: CSV, Markdown and plots from runs of BenchmarkError (and,
for the rate of rays, of BenchmarkBake).

Each measurement is a process of its own. README.md in this folder tells what is measured and how
long it takes. Plots need python3-matplotlib; without it the rest is written all the same.
"""
import argparse
import array
import collections
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import error_benchmark_report as report

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parent.parent
SHIPPED_REFERENCES = HERE / "References"

# The levels of each method, from coarse to fine. Another method needs a line here and one in
# makeMethod() of MeasuredMethod.cxx.
METHODS = {
    "Reference": [4, 9, 16, 25, 49, 100, 196],    # samples a texel
    "Thesis": [49],                               # samples a texel, all of them traced
    "Sweep": [16, 32, 64, 128, 256, 512, 1024],   # directions
    "Embree": [32, 64, 128, 256, 512]}            # directions
TINY_LEVELS = {"Reference": [4, 49], "Thesis": [49], "Sweep": [16, 256], "Embree": [32, 256]}
USUAL_LEVELS = {"Reference": 49, "Sweep": 112, "Embree": 112}  # what the filter takes by default
SWEEP = {"Sweep": 112}
# Particles whose time is taken, where it is not the program's own number. Embree prepares its
# directions once for all: on few particles that would count for too much.
MEASURED = {"Embree": 2048}

FAMILIES = ["pack", "overlap", "gas", "shell", "foam"]
FILES = {name: SOURCE / "Data" / f"{name}.vtp" for name in ["heap", "molecule", "bullet_1000"]}

# What a sweep can be kept from leaving out, and the options that show it: a background, or the distance within which
# spheres occlude, in mean radii.
SKIPS = {"closedCells": {}, "neverSeen": {}, "offsetMasks": {}, "blackSky": {"background": "half"},
         "lonely": {"distance": 1}}
SKIP_SETS = ["pack", "overlap", "gas", "foam", "heap", "bullet_1000"]
SKIP_REPEATS = 3

# Repetitions of BenchmarkBake, of which it takes the median.
RAY_REPEATS = {"tiny": 2, "short": 3, "long": 11}

SHORT_COUNT = 30_000
LONG_COUNT = 955_000
TINY_COUNT = 400
SIZES = [10_000, 30_000, 100_000, 300_000, 955_000, 7_157_720]
LARGEST_SIZE = {"short": 100_000, "long": 7_157_720}
RESOLUTION = 16    # of all series but the one of resolutions
RESOLUTIONS = [1, 2, 4, 8, 16, 32, 64]
RADIUS_RATIOS = [1, 10, 100, 1000, 10000]
LATTICE_RADII = [0.45, 0.5, 0.56, 0.62, 0.75, 0.9]

TITLES = {
    "error": "Run time against error",
    "size": "Sweep: time and memory against the number of particles (with the stored textures)",
    "resolution": "Time against texture resolution",
    "radii": "Time and error against the ratio of radii (gas of log-uniform radii)",
    "overlap": "Time and error against overlap (jittered lattice; touching at 0.5)",
    "threads": "Threads",
    "simd": "Sweep: sets of vector instructions",
    "skips": "Sweep: what it may leave out, on and off",
    "rays": "Reference: rate of rays against bare rtcOccluded1 over the same rays",
    "thesis": "Textures of 955,000 particles"}

# Samples a texel of reference values: those that are shipped, and those made when needed.
SHIPPED_SAMPLES = 16_200
PASSING_SAMPLES = 4_050
TINY_SAMPLES = 2_048

Scene = collections.namedtuple("Scene", "label argument count")


def family(name, count):
    return Scene(name, name, count)


def judge_name(scene, conditions):
    count = f"-{scene.count}" if scene.count else ""
    special = "".join(f"-{name}-{value}" for name, value in conditions.items())
    return f"{scene.label.replace(':', '-')}{count}-T{RESOLUTION}{special}.ref"


class Benchmark:
    """Runs BenchmarkError and gathers the rows of one series."""

    def __init__(self, options):
        self.options = options
        self.tiny = options.tiny
        self.form = "tiny" if options.tiny else "long" if options.long else "short"
        self.output = pathlib.Path(options.output)
        self.references = self.output / "references"
        self.rows = []
        self.failures = 0

    # ---- processes

    def call(self, *arguments):
        """Standard output of the program; raises subprocess.CalledProcessError."""
        command = [self.options.program, *map(str, arguments)]
        return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout

    @staticmethod
    def scene_arguments(scene, resolution):
        count = ["--count", scene.count] if scene.count else []
        return ["--scene", scene.argument, "--resolution", resolution, *count]

    @staticmethod
    def option_arguments(**values):
        """Options of the program; those that are None are left out."""
        return [text for name, value in values.items() if value is not None
                for text in (f"--{name}", value)]

    def judge(self, scene, **conditions):
        """The file of reference values: the shipped one, or one made beside the results."""
        shipped = SHIPPED_REFERENCES / judge_name(scene, conditions)
        if shipped.exists():
            return shipped
        file = self.references / judge_name(scene, conditions)
        if not file.exists():
            self.references.mkdir(parents=True, exist_ok=True)
            samples = TINY_SAMPLES if self.tiny else PASSING_SAMPLES
            self.write_judge(scene, file, samples, **conditions)
        return file

    def write_judge(self, scene, file, samples, **conditions):
        print(f"reference values: {file.name}", flush=True)
        part = file.with_suffix(".part")
        self.call("judge", *self.scene_arguments(scene, RESOLUTION), "--samples", samples,
                  "--output", part, *self.option_arguments(**conditions))
        os.replace(part, file)

    def run_once(self, scene, method, level, resolution=RESOLUTION, **more):
        """What one run of the program says."""
        return json.loads(self.call(
            "measure", *self.scene_arguments(scene, resolution), "--method", method, "--level",
            level, *self.option_arguments(**more)))

    def leave_out(self, series, what, problem):
        self.failures += 1
        print(f"{series}: {what} is left out: {problem}", flush=True)

    def keep(self, series, scene, row, **more):
        """Adds a row and writes all so far, for those who interrupt."""
        row.update(series=series, scene=scene.label, **more)
        self.rows.append(row)
        report.write_csv(self.output / f"{series}.csv", self.rows)

    def measure(self, series, scene, method, level, resolution=RESOLUTION, judge=None,
                **more):
        """Measures, keeps and returns one row: of several runs the fastest.

        Where the program fails (it may have been killed for want of memory), the rest goes on.
        """
        more.setdefault("measured", MEASURED.get(method))
        try:
            runs = [self.run_once(scene, method, level, resolution, judge=judge, **more)
                    for _ in range(self.options.repeat)]
        except subprocess.CalledProcessError as problem:
            self.leave_out(series, f"{scene.label} {method} {level}", problem)
            return None
        seconds = "wall_s" if series == "threads" else "cpu_s"
        row = min(runs, key=lambda run: run[seconds])
        self.keep(series, scene, row, threads=more.get("threads", self.options.threads),
                  target=more.get("target", "best"))
        print(f"{series}: {scene.label} {row['particles']} T={resolution} {method} {level}: "
              f"{row['cpu_s']:.3g} CPU s, {row['peak_MB']:.0f} MB, RMSE {row.get('rmse', '-')}",
              flush=True)
        return row

    # ---- series

    def count(self):
        if self.tiny:
            return TINY_COUNT
        return LONG_COUNT if self.form == "long" else SHORT_COUNT

    def scenes(self, wanted=(*FAMILIES, *FILES)):
        """The families and the shipped files, or those that the user chose."""
        chosen = self.options.sets or (["gas"] if self.tiny else wanted)
        return [family(name, self.count()) if name in FAMILIES
                else Scene(name, FILES[name], None) for name in chosen]

    def some_families(self, wanted, count=None):
        chosen = self.options.sets or (["gas"] if self.tiny else wanted)
        return [family(name, count or self.count()) for name in chosen if name in FAMILIES]

    def run_error(self):
        for scene in self.scenes():
            judge = self.judge(scene)
            for method, levels in (TINY_LEVELS if self.tiny else METHODS).items():
                for level in levels:
                    self.measure("error", scene, method, level, judge=judge)

    def run_size(self):
        largest = self.options.largest or LARGEST_SIZE["long" if self.form == "long" else "short"]
        sizes = [100, 200] if self.tiny else [size for size in SIZES if size <= largest]
        for scene in self.some_families(["pack", "gas", "foam"]):
            before = None
            for size in sizes:
                if before and not fits_memory(before, size):
                    print(f"size: {scene.label} {size} would not fit into memory: left out")
                    break
                before = self.measure("size", family(scene.label, size), "Sweep", SWEEP["Sweep"],
                                      bake=1)
                if not before:
                    break

    def run_resolution(self):
        for scene in self.some_families(["gas", "foam"], None if self.tiny else SHORT_COUNT):
            for resolution in [2, 4] if self.tiny else RESOLUTIONS:
                # As many rays at all resolutions, in bounds: enough for the clock, and a sample
                # of the particles.
                measured = min(4096, max(64, 512 * RESOLUTION**2 // resolution**2))
                for method, level in USUAL_LEVELS.items():
                    self.measure("resolution", scene, method, level, resolution=resolution,
                                 measured=measured)

    def run_parameters(self, series, kind, values):
        """Scenes of one kind that differ by a number."""
        count = TINY_COUNT if self.tiny else SHORT_COUNT
        for value in values[:2] if self.tiny else values:
            scene = Scene(f"{kind}:{value}", f"{kind}:{value}", count)
            judge = self.judge(scene)
            for method, level in USUAL_LEVELS.items():
                self.measure(series, scene, method, level, judge=judge)

    def run_radii(self):
        self.run_parameters("radii", "ratio", RADIUS_RATIOS)

    def run_overlap(self):
        self.run_parameters("overlap", "lattice", LATTICE_RADII)

    def run_threads(self):
        for scene in self.some_families(["pack", "gas", "foam"]):
            for method, level in USUAL_LEVELS.items():
                for threads in [1, 2]:
                    self.measure("threads", scene, method, level, threads=threads)

    def run_simd(self):
        targets = self.call("targets").split()
        for scene in self.some_families(["pack", "gas", "foam"]):
            best = None
            for target in targets:
                row = self.measure("simd", scene, "Sweep", SWEEP["Sweep"], target=target)
                values = self.values(scene, target)
                best = best or values
                if row:
                    row["max_difference"] = max(abs(a - b) for a, b in zip(best, values))
        report.write_csv(self.output / "simd.csv", self.rows)

    def values(self, scene, target):
        """All that a sweep finds; a run that is not timed, since it writes a file."""
        with tempfile.TemporaryDirectory(dir=self.output) as folder:
            file = pathlib.Path(folder) / "values"
            self.call("measure", *self.scene_arguments(scene, RESOLUTION), "--method", "Sweep",
                      "--level", SWEEP["Sweep"], "--target", target, "--values", file)
            values = array.array("f")
            values.frombytes(file.read_bytes())
            return values

    def run_skips(self):
        for scene in self.scenes(SKIP_SETS):
            for skip, conditions in SKIPS.items():
                try:
                    self.measure_skip(scene, skip, conditions)
                except subprocess.CalledProcessError as problem:
                    self.leave_out("skips", f"{scene.label} {skip}", problem)
            # What is always spared, up to the table of textures.
            self.measure("skips", scene, "Sweep", SWEEP["Sweep"], bake=1)

    def measure_skip(self, scene, skip, conditions):
        """Two rows, one with all skips and one without this one: the fastest of runs in turns."""
        switches = {"on": None, "off": skip}
        judge = self.judge(scene, **conditions)
        runs = {state: [] for state in switches}
        for _ in range(1 if self.tiny else max(SKIP_REPEATS, self.options.repeat)):
            for state, without in switches.items():
                runs[state].append(self.run_once(
                    scene, "Sweep", SWEEP["Sweep"], judge=judge, without=without, **conditions))
        rows = {state: min(runs[state], key=lambda run: run["cpu_s"]) for state in switches}
        rows["off"]["rms_difference"] = self.difference(scene, skip, conditions)
        for state, row in rows.items():
            self.keep("skips", scene, row, threads=self.options.threads, target="best", skip=skip,
                      state=state, condition=" ".join(f"{n} {v}" for n, v in conditions.items()))
        print(f"skips: {scene.label} {skip}: {rows['on']['cpu_s']:.3g} CPU s on, "
              f"{rows['off']['cpu_s']:.3g} off", flush=True)

    def difference(self, scene, skip, conditions):
        """RMS difference of all texels without a skip; from runs that are not timed."""
        with tempfile.TemporaryDirectory(dir=self.output) as folder:
            file = pathlib.Path(folder) / "values"
            self.run_once(scene, "Sweep", SWEEP["Sweep"], values=file, **conditions)
            return self.run_once(scene, "Sweep", SWEEP["Sweep"], without=skip,
                                 compare=file, **conditions)["rms_difference"]

    def run_rays(self):
        scenes = {scene.label: scene for scene in self.some_families(FAMILIES)}
        if not scenes:
            return
        with tempfile.TemporaryDirectory(dir=self.output) as folder:
            file = pathlib.Path(folder) / "rays.json"
            command = [self.options.bake_program,
                       f"--benchmark_filter=/({'|'.join(scenes)})$",
                       f"--benchmark_repetitions={RAY_REPEATS[self.form]}",
                       f"--benchmark_out={file}", "--benchmark_out_format=json"]
            if self.tiny:
                command.append("--benchmark_min_time=0.01")
            subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
            results = json.loads(file.read_text(encoding="utf-8"))["benchmarks"]
        for label, scene in scenes.items():
            self.keep("rays", scene, report.ray_row(results, label))

    def run_thesis(self):
        for scene in self.some_families(FAMILIES, None if self.tiny else LONG_COUNT):
            self.measure("thesis", scene, "Sweep", SWEEP["Sweep"], bake=1)

    def run(self, series):
        self.rows = []
        start = time.monotonic()
        getattr(self, f"run_{series}")()
        print(f"{series} took {time.monotonic() - start:.0f} s")
        return self.rows


def fits_memory(row, particles):
    """Whether so many particles will fit, from the peak with fewer; true where nobody knows."""
    try:
        with open("/proc/meminfo", encoding="ascii") as lines:
            available = next(int(line.split()[1]) * 1024 / 1e6 for line in lines
                             if line.startswith("MemAvailable:"))
    except (OSError, StopIteration):
        return True
    return row["peak_MB"] * particles / row["particles"] < 0.95 * available


def plot(series, rows, folder):
    """Draws the plots if matplotlib is there; else tells so."""
    try:
        import error_benchmark_plots as plots
    except ImportError as problem:
        print(f"No plots: {problem}. Install python3-matplotlib, then run again with --plots-only.")
        return
    print("plots:", ", ".join(plots.plot(series, rows, folder)))


def write_report(series, rows, folder):
    if not rows:
        print(f"{series}: nothing was measured")
        return
    report.write_markdown(folder / f"{series}.md", series, TITLES[series], rows)
    plot(series, rows, folder)


def write_shipped_references(benchmark):
    """Makes the reference values of the repository anew."""
    scenes = [family(name, SHORT_COUNT) for name in FAMILIES]
    scenes += [Scene(name, file, None) for name, file in FILES.items()]
    for scene in scenes:
        benchmark.write_judge(scene, SHIPPED_REFERENCES / judge_name(scene, {}), SHIPPED_SAMPLES)


def parse_arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=SOURCE / "build" / "bin" / "BenchmarkError",
                        type=pathlib.Path, help="BenchmarkError [build/bin/BenchmarkError]")
    parser.add_argument("--bake-program", type=pathlib.Path,
                        help="BenchmarkBake, for the series rays [beside BenchmarkError]")
    parser.add_argument("--output", default=SOURCE / "build" / "benchmarks", type=pathlib.Path,
                        help="folder for the results [build/benchmarks]")
    parser.add_argument("--series", nargs="+", default=["error"], choices=["all", *TITLES],
                        metavar="NAME", help=f"what to measure [error]: {', '.join(TITLES)}, or "
                        "all (thesis only with --long)")
    parser.add_argument("--sets", nargs="+", choices=[*FAMILIES, *FILES], metavar="NAME",
                        help=f"only these sets of {', '.join([*FAMILIES, *FILES])}")
    parser.add_argument("--long", action="store_true",
                        help="families of 955,000 particles, sizes up to 7,157,720")
    parser.add_argument("--tiny", action="store_true", help="a few hundred particles, for the test")
    parser.add_argument("--largest", type=int, help="largest size of the series size")
    parser.add_argument("--repeat", type=int, default=1,
                        help="measure so often and take the run of least CPU time [1]")
    parser.add_argument("--plots-only", action="store_true",
                        help="Markdown and plots from the CSV files of an earlier run")
    parser.add_argument("--write-references", action="store_true",
                        help="only make the files in References anew")
    options = parser.parse_args()
    options.bake_program = options.bake_program or options.program.with_name("BenchmarkBake")
    options.threads = len(os.sched_getaffinity(0))
    if options.repeat < 1:
        parser.error("--repeat must be at least 1")
    return options


def chosen_series(options):
    if "all" not in options.series:
        return report.unique(options.series)
    return [name for name in TITLES if name != "thesis" or options.long or options.tiny]


def main():
    options = parse_arguments()
    benchmark = Benchmark(options)
    if options.write_references:
        write_shipped_references(benchmark)
        return
    benchmark.output.mkdir(parents=True, exist_ok=True)
    for series in chosen_series(options):
        rows = (report.read_csv(benchmark.output / f"{series}.csv") if options.plots_only
                else benchmark.run(series))
        write_report(series, rows, benchmark.output)
    print(f"Results are in {benchmark.output}")
    if benchmark.failures:
        sys.exit(f"{benchmark.failures} measurements failed")


if __name__ == "__main__":
    try:
        main()
    except (OSError, subprocess.CalledProcessError) as error:
        sys.exit(f"{sys.argv[0]}: {error}")
