# SPDX-License-Identifier: BSD-3-Clause
"""The program that writes synthetic particles: ParaView reads its files, mistakes are told.

usage: pvpython test_generate.py PATH_TO_GenerateParticles
"""
import hashlib
import pathlib
import subprocess
import sys
import tempfile
import unittest

from paraview.simple import Delete, OpenDataFile

PROGRAM = None


def generate(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)


class Generate(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_paraview_reads_every_family(self):
        for family in ("pack", "overlap", "gas", "shell", "foam"):
            with self.subTest(family=family):
                file = self.folder / f"{family}.vtp"
                done = generate(family, 3000, file)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                reader = OpenDataFile(str(file))
                reader.UpdatePipeline()
                info = reader.GetDataInformation()
                self.assertEqual(info.GetNumberOfPoints(), 3000)
                self.assertEqual(info.GetNumberOfCells(), 3000)
                low, high = reader.PointData["radius"].GetRange()
                self.assertTrue(0 < low <= high < 1, (low, high))
                Delete(reader)

    def test_same_seed_gives_the_same_file(self):
        digests = []
        for name, seed in (("a", 5), ("b", 5), ("c", 6)):
            file = self.folder / f"{name}.vtp"
            self.assertEqual(generate("foam", 5000, file, seed).returncode, 0)
            digests.append(hashlib.sha256(file.read_bytes()).hexdigest())
        self.assertEqual(digests[0], digests[1])
        self.assertNotEqual(digests[0], digests[2])

    def test_mistakes_are_told_and_leave_no_file(self):
        good = self.folder / "x.vtp"
        for arguments, word in (
            ((), "arguments"),
            (("sponge", 10, good), "sponge"),
            (("foam", 0, good), "COUNT"),
            (("foam", "ten", good), "COUNT"),
            (("foam", "-1", good), "COUNT"),
            (("foam", 10**12, good), "at most"),
            (("foam", 10, self.folder / "x.csv"), ".vtp"),
            (("foam", 10, good, "one"), "SEED"),
            (("foam", 10, self.folder / "missing" / "x.vtp"), "missing"),
        ):
            with self.subTest(arguments=arguments):
                done = generate(*arguments)
                self.assertEqual(done.returncode, 1)
                self.assertIn(word, done.stderr)
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
