# SPDX-License-Identifier: BSD-3-Clause
"""Bakes a time series: each step's textures are written beside its data, step.vtp -> step.occlusion.exr.

    pvbatch Data/Examples/bake_series.py [options] step_*.vtp

Steps that have a texture file newer than their data are skipped: what was interrupted goes on where it was.
A step that fails is reported and the others go on; the script then ends with code 1. One process: several
can each take a part of the files. A file that holds several times gets one texture file a time.

"Load Occlusion Textures (EXR)" puts the textures back onto a step. With --set ReuseUnchanged=1
MaximumDistance=D (D in the units of the data) particles near which nothing has moved keep their textures
from the step before. With --cache, the filter "Sphere Ambient
Occlusion" with the same parameters, "Use Cache" and that folder finds each step there.
"""
import argparse
import os
import sys
import time

from paraview.simple import *

import plugin


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", help="data files, a step each, in the order of time")
    parser.add_argument("--output", help="folder for the texture files; default: beside the data")
    parser.add_argument("--again", action="store_true", help="bake also what has a texture file already")
    parser.add_argument("--precision", choices=["Float", "Half"], default="Half", help="of the texture files")
    parser.add_argument("--cache", help="also keep the bakes in this cache folder")
    parser.add_argument("--set", nargs="*", default=[], metavar="PROPERTY=VALUE",
                        help="properties of Sphere Ambient Occlusion, such as TextureResolution=8 Method=Embree")
    return parser.parse_args(arguments)


def properties(options):
    """The filter's properties: numbers where they look like numbers."""
    chosen = {}
    for assignment in options.set:
        name, equals, text = assignment.partition("=")
        if not equals:
            raise SystemExit(f"--set {assignment}: write PROPERTY=VALUE.")
        try:
            chosen[name] = float(text) if "." in text or "e" in text.lower() else int(text)
        except ValueError:
            chosen[name] = text
    if options.cache:
        chosen.update(UseCache=1, CacheDirectory=os.path.abspath(options.cache))
    return chosen


def texture_file(options, path, number, count):
    """Of time `number` of a file that has `count` of them."""
    folder, name = os.path.split(os.path.abspath(path))
    suffix = f".{number:04d}" if count > 1 else ""
    return os.path.join(options.output or folder, os.path.splitext(name)[0] + suffix + ".occlusion.exr")


def is_done(options, path, target):
    return not options.again and os.path.exists(target) and os.path.getmtime(target) >= os.path.getmtime(path)


class Series:
    """One filter for all steps, so that it can reuse the textures of the step before."""

    def __init__(self, chosen):
        self.chosen = chosen
        self.baked = None

    def attach(self, reader):
        if self.baked is None:
            self.baked = SphereAmbientOcclusion(Input=reader, **self.chosen)
            return
        before = self.baked.Input
        self.baked.Input = reader
        if before != reader:
            Delete(before)

    def bake(self, reader, instant, target, precision):
        """Returns what was baked, in words; raises RuntimeError where there is no bake."""
        if instant is not None:
            GetAnimationScene().AnimationTime = instant
        self.attach(reader)
        self.baked.UpdatePipeline(instant) if instant is not None else self.baked.UpdatePipeline()
        self.baked.UpdatePropertyInformation()
        particles = self.baked.GetPropertyValue("NumberOfParticles")
        if not particles:
            raise RuntimeError("it was not baked; the message above says why")
        SaveData(target, self.baked, Precision=precision)
        if not os.path.exists(target):
            raise RuntimeError("its textures were not written; the message above says why")
        reused = self.baked.GetPropertyValue("NumberOfParticlesReused")
        return f"{particles} particles" + (f", {reused} as before" if reused else "")


def bake_file(path, options, series, report):
    """Bakes all times of a file; returns the number of failures."""
    failures = 0
    try:
        if not os.path.isfile(path):
            raise RuntimeError("there is no such file")
        reader = OpenDataFile(path)
        if reader is None:
            raise RuntimeError("ParaView has no reader for it")
    except RuntimeError as error:
        report(path, f"failed: {error}")
        return 1
    times = list(getattr(reader, "TimestepValues", None) or [])
    instants = times if len(times) > 1 else [None]
    for number, instant in enumerate(instants):
        target = texture_file(options, path, number, len(instants))
        if is_done(options, path, target):
            report(target, "is there")
            continue
        start = time.time()
        try:
            baked = series.bake(reader, instant, target, options.precision)
            report(target, f"{baked}, {time.time() - start:.1f} s")
        except (RuntimeError, ValueError, AttributeError) as error:
            report(target, f"failed: {error}")
            failures += 1
    return failures


def main(arguments):
    options = parse(arguments)
    plugin.load(globals())
    series = Series(properties(options))
    start = time.time()
    failures = 0
    for index, path in enumerate(options.files):
        def report(name, what):
            share = (index + 1) / len(options.files)
            left = (time.time() - start) * (1 - share) / share
            print(f"[{index + 1}/{len(options.files)}] {name}: {what}; {left:.0f} s left", flush=True)
        failures += bake_file(path, options, series, report)
    if failures:
        sys.exit(f"{failures} steps were not baked.")


if __name__ == "__main__":
    main(sys.argv[1:])
