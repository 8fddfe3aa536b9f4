# SPDX-License-Identifier: BSD-3-Clause
"""The benchmark of run time against error: its results have the form that README.md tells.

usage: python3 test_error_benchmark.py PATH_TO_BenchmarkError PATH_TO_BenchmarkBake
"""
import csv
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

import error_benchmark_report as report

PROGRAM = None
BAKE_PROGRAM = None
SCRIPT = pathlib.Path(__file__).with_name("run_error_benchmark.py")

POSITIVE = ["particles", "resolution", "level", "threads", "measured_particles", "cpu_s", "wall_s",
            "peak_MB", "scene_MB"]
OF_ERROR = ["rmse", "p99", "judge_noise", "judged_particles"]


def run(*arguments):
    return subprocess.run([sys.executable, str(SCRIPT), "--program", PROGRAM, "--bake-program",
                           BAKE_PROGRAM, *map(str, arguments)], capture_output=True, text=True)


def has_matplotlib():
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        return False
    return True


class TinyForm(unittest.TestCase):
    """One set of a few hundred particles, two levels."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.done = run("--tiny", "--series", "error", "simd", "skips", "rays", "--output",
                       cls.folder)

    def rows(self, series):
        self.assertEqual(self.done.returncode, 0, self.done.stdout + self.done.stderr)
        with open(self.folder / f"{series}.csv", newline="", encoding="utf-8") as file:
            self.assertEqual(next(csv.reader(file)), report.COLUMNS)
        return report.read_csv(self.folder / f"{series}.csv")

    def assert_positive(self, row, names):
        for name in names:
            self.assertTrue(math.isfinite(row[name]) and row[name] > 0, (name, row))

    def test_rows_have_finite_positive_numbers(self):
        rows = self.rows("error")
        self.assertEqual(len(rows), 7)
        for row in rows:
            self.assert_positive(row, POSITIVE + OF_ERROR)
            self.assertTrue(math.isfinite(row["bias"]))
            self.assertLess(abs(row["bias"]), row["rmse"])
            self.assertLess(row["judge_noise"], row["rmse"])

    def test_error_decreases_from_coarse_to_fine(self):
        rows = self.rows("error")
        for method in ["Reference", "Sweep", "Embree"]:
            with self.subTest(method=method):
                coarse, fine = sorted(report.pick(rows, method=method), key=lambda r: r["level"])
                self.assertLess(fine["rmse"], coarse["rmse"])
                self.assertLess(fine["p99"], coarse["p99"])

    def test_thesis_way_traces_all_rays(self):
        rows = self.rows("error")
        reference, = report.pick(rows, method="Reference", level=49)
        thesis, = report.pick(rows, method="Thesis")
        # The gas hardly overlaps: both estimate the same.
        self.assertLess(abs(thesis["rmse"] - reference["rmse"]), 0.3 * reference["rmse"])

    def test_sets_of_instructions_agree(self):
        for row in self.rows("simd"):
            self.assert_positive(row, POSITIVE)
            self.assertLess(row["max_difference"], 0.05, row["target"])

    def test_skips_that_are_off_spare_nothing(self):
        rows = self.rows("skips")
        counters = {"closedCells": "spheresClosed", "neverSeen": "spheresNeverSeen",
                    "blackSky": "directionsBlack", "lonely": "particlesAlone"}
        pairs = report.skip_pairs(rows)
        self.assertEqual([pair["skip"] for pair in pairs],
                         ["closedCells", "neverSeen", "offsetMasks", "blackSky", "lonely"])
        for pair in pairs:
            with self.subTest(skip=pair["skip"]):
                self.assert_positive(pair["on"], POSITIVE + OF_ERROR)
                self.assert_positive(pair["off"], POSITIVE + OF_ERROR)
                self.assertLess(pair["off"]["rms_difference"], 0.1)
                if pair["skip"] in counters:
                    self.assertEqual(pair["off"][counters[pair["skip"]]], 0)
        # Directions come with their opposites, of which one is below the horizon.
        black = pairs[-2]["on"]
        self.assertEqual(black["directionsBlack"], black["level"] / 2)

    def test_stored_textures_are_counted(self):
        stored = [row for row in self.rows("skips") if "texturesStored" in row]
        self.assertEqual(len(stored), 1)
        self.assertTrue(0 < stored[0]["texturesStored"] <= stored[0]["particles"])

    def test_rate_of_rays(self):
        rows = self.rows("rays")
        self.assertEqual([row["scene"] for row in rows], ["gas"])
        self.assert_positive(rows[0], ["rays", "bake_ms", "generate_ms", "bare_ms", "share",
                                       "ray_rate"])

    def test_equal_error_tells_directions(self):
        self.rows("error")
        text = (self.folder / "error.md").read_text(encoding="utf-8")
        self.assertIn("| directions | s | ratio | ratio to all rays |", text)
        for method in ["Sweep", "Embree"]:
            self.assertIn(f"| gas | {method} |", text.split("## At the RMSE")[1])

    def test_report_and_plots_are_written(self):
        self.rows("error")
        self.assertIn("| gas |", (self.folder / "error.md").read_text(encoding="utf-8"))
        if not has_matplotlib():
            self.assertIn("python3-matplotlib", self.done.stdout)
            return
        for name in ["error", "ratio", "simd", "skips", "rays"]:
            for kind in ["png", "svg"]:
                file = self.folder / f"{name}.{kind}"
                self.assertGreater(file.stat().st_size, 1000, file.name)


class Mistakes(unittest.TestCase):
    def test_unknown_scene_is_told(self):
        done = subprocess.run([PROGRAM, "measure", "--scene", "none", "--method", "Sweep",
                               "--level", "16"], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("'none'", done.stderr)

    def test_unknown_skip_is_told(self):
        done = subprocess.run([PROGRAM, "measure", "--scene", "gas", "--method", "Sweep", "--level",
                               "16", "--without", "none"], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("'none'", done.stderr)

    def test_reference_values_of_another_background_are_refused(self):
        file = SCRIPT.with_name("References") / "heap-T16.ref"
        data = SCRIPT.parent.parent.parent / "Data" / "heap.vtp"
        done = subprocess.run([PROGRAM, "measure", "--scene", data, "--background", "half",
                               "--method", "Sweep", "--level", "16", "--judge", file],
                              capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("another background", done.stderr)

    def test_reference_values_of_other_spheres_are_refused(self):
        file = next(SCRIPT.with_name("References").glob("gas-*.ref"))
        done = subprocess.run([PROGRAM, "measure", "--scene", "gas", "--count", "100", "--method",
                               "Sweep", "--level", "16", "--judge", file],
                              capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("other spheres", done.stderr)


class EqualError(unittest.TestCase):
    """Time is interpolated on a log-log line."""

    @staticmethod
    def rows(*levels):
        return [{"level": level, "cpu_s": seconds, "rmse": rmse} for level, seconds, rmse in levels]

    def test_between_two_levels(self):
        rows = self.rows((1, 1.0, 0.4), (4, 4.0, 0.1))
        found = report.at_error(rows, 0.2)
        self.assertAlmostEqual(found.cpu_s, 2.0)
        self.assertAlmostEqual(found.level, 2.0)
        self.assertEqual(found.bound, "")

    def test_coarsest_level_is_good_enough(self):
        self.assertEqual(report.at_error(self.rows((1, 1.0, 0.1)), 0.2), (1.0, 1, "at most"))

    def test_no_level_is_good_enough(self):
        self.assertIsNone(report.at_error(self.rows((1, 1.0, 0.4)), 0.2))

    def test_last_crossing_counts(self):
        rows = self.rows((1, 1.0, 0.4), (2, 2.0, 0.1), (4, 4.0, 0.4), (8, 8.0, 0.1))
        self.assertAlmostEqual(report.at_error(rows, 0.2).cpu_s, 4 * math.sqrt(2))


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    BAKE_PROGRAM = sys.argv.pop(1)
    unittest.main()
