# SPDX-License-Identifier: BSD-3-Clause
"""How well colour maps and lines can be told apart in grey and by colour-blind readers: prints two tables.

    pvpython Testing/Benchmarks/measure_contrast.py [FOLDER]

Colour-blind readers see as Machado, Oliveira and Fernandes (2009) model full deuteranopia and protanopia, in linear RGB;
grey is the luminance. A colour map is cut into 16 steps: the least difference of neighbours, and of any two steps that
are not, in CIELAB (1976; 2.3 is just noticeable). Lines are drawn around the disc of Data/: the contrast of line and
what is in front of it is the ratio of luminances, (a + 0.05) / (b + 0.05), of WCAG 2, in the median over the pixels that
become more than half a line; 3 is what it asks of graphics. With a folder, pictures as each reader sees them go there.
"""
import os
import sys
import tempfile

import numpy
from paraview.simple import *
from PIL import Image

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, "..", "..", "Data"), os.path.join(HERE, "..", "Python")]
import demo  # noqa: E402
import images  # noqa: E402
import plugin  # noqa: E402
import scene  # noqa: E402

LUMINANCE = numpy.array([0.2126, 0.7152, 0.0722])
READERS = {
    "all colours": numpy.eye(3),
    "deuteranopia": numpy.array([[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413],
                                 [-0.011820, 0.042940, 0.968881]]),
    "protanopia": numpy.array([[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216],
                               [-0.003882, -0.048116, 1.051998]]),
    "grey": numpy.tile(LUMINANCE, (3, 1)),
}
MAPS = ("Viridis (matplotlib)", "Inferno (matplotlib)", "Cool to Warm")
SIZE = [600, 420]


def linear(srgb):
    return numpy.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def encoded(rgb):
    return numpy.where(rgb <= 0.0031308, 12.92 * rgb, 1.055 * numpy.maximum(rgb, 0.0031308) ** (1 / 2.4) - 0.055)


def seen_by(reader, srgb):
    """Linear RGB, 0 to 1, of colours in sRGB."""
    return numpy.clip(linear(srgb) @ READERS[reader].T, 0, 1)


def lab(rgb):
    xyz = rgb @ numpy.array([[0.4124564, 0.2126729, 0.0193339], [0.3575761, 0.7151522, 0.1191920],
                             [0.1804375, 0.0721750, 0.9503041]]) / numpy.array([0.95047, 1, 1.08883])
    f = numpy.where(xyz > (6 / 29) ** 3, numpy.cbrt(xyz), xyz / (3 * (6 / 29) ** 2) + 4 / 29)
    return numpy.stack([116 * f[:, 1] - 16, 500 * (f[:, 0] - f[:, 1]), 200 * (f[:, 1] - f[:, 2])], axis=1)


def colours_of(preset, steps=16):
    table = CreateLookupTable()
    table.ApplyPreset(preset, True)
    table.RescaleTransferFunction(0, 1)
    client = table.SMProxy.GetClientSideObject()
    client.Build()
    colours = numpy.empty((steps, 3))
    for colour, value in zip(colours, numpy.linspace(0, 1, steps)):
        rgb = [0, 0, 0]
        client.GetColor(value, rgb)
        colour[:] = rgb
    Delete(table)
    return colours


def print_maps():
    print("| colour map | reader | neighbours, least | any others, least | lightness |\n| --- | --- | ---: | ---: | --- |")
    for preset in MAPS:
        for reader in READERS:
            values = lab(seen_by(reader, colours_of(preset)))
            apart = numpy.linalg.norm(values[:, None] - values[None], axis=2)
            others = apart[numpy.triu_indices(len(values), 2)].min()
            rises = "grows" if (numpy.diff(values[:, 0]) > 0).all() else "rises and falls"
            print(f"| {preset} | {reader} | {numpy.diagonal(apart, 1).min():.1f} | {others:.1f} | "
                  f"{rises}, {values[:, 0].min():.0f} to {values[:, 0].max():.0f} |")


def take(view, folder, name):
    path = os.path.join(folder, name + ".png")
    SaveScreenshot(path, view, ImageResolution=SIZE)
    return images.read(path) / 255


def save_as_seen(picture, path):
    """Beside the picture at `path`, one as each reader sees it."""
    for reader in list(READERS)[1:]:
        seen = encoded(seen_by(reader, picture.reshape(-1, 3))).reshape(picture.shape)[::-1]
        Image.fromarray((255 * seen).round().astype("uint8")).save(path.replace(".png", f"-{reader}.png"))


def contrast(reader, plain, lined, solid):
    """Of line and surroundings, where a line covers more than half of a pixel, as `solid` red and blue lines tell."""
    covered = numpy.abs(solid[0] - solid[1]).max(axis=2) > 0.5
    before, after = (seen_by(reader, picture[covered]) @ LUMINANCE + 0.05 for picture in (plain, lined))
    return numpy.median(numpy.maximum(before, after) / numpy.minimum(before, after))


def print_lines(folder):
    view = demo.make_view()
    baked = SphereAmbientOcclusion(Input=OpenDataFile(os.path.join(demo.ROOT, "Data", "bullet_1000.vtp")))
    display = scene.show_spheres(baked, view, ambient=0.55, diffuse=0.6)
    demo.aim_camera(view)
    demo.colour_by_damage(display, view)
    display.SetScalarBarVisibility(view, False)
    styles = {"Black": dict(SilhouetteColor=[0, 0, 0], SilhouetteDarken=0),
              "White": dict(SilhouetteColor=[1, 1, 1], SilhouetteDarken=0), "Darkened": dict(SilhouetteDarken=1)}
    print("\n| line style | background | " + " | ".join(READERS) + " |\n| --- | --- |" + " ---: |" * len(READERS))
    for background, grey in (("white", 1), ("ParaView's grey", None), ("black", 0)):
        view.Background = [0.32, 0.34, 0.43] if grey is None else [grey] * 3
        view.SilhouetteVisibility = 0
        plain = take(view, folder, f"{background}-none")
        view.SilhouetteVisibility, view.SilhouetteDarken = 1, 0
        solid = []
        for view.SilhouetteColor in ([1, 0, 0], [0, 0, 1]):
            solid.append(take(view, folder, "solid"))
        for style, settings in styles.items():
            for key, value in settings.items():
                setattr(view, key, value)
            lined = take(view, folder, f"{background}-{style}")
            save_as_seen(lined, os.path.join(folder, f"{background}-{style}.png"))
            ratios = [contrast(reader, plain, lined, solid) for reader in READERS]
            print(f"| {style} | {background} | " + " | ".join(f"{ratio:.1f}" for ratio in ratios) + " |")


def main():
    plugin.load(globals())
    print_maps()
    with tempfile.TemporaryDirectory() as scratch:
        folder = sys.argv[1] if len(sys.argv) > 1 else scratch
        os.makedirs(folder, exist_ok=True)
        print_lines(folder)


main()
