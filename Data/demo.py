# SPDX-License-Identifier: BSD-3-Clause
"""The main job, without a screen: bakes ambient occlusion onto particles of a real simulation, ray-traces
them in four ways, and leaves pictures and files in demo-output/.

Run it by `bash Data/demo.sh`, which builds the plugin and starts a virtual display.
"""
import os
import sys

from paraview.simple import *

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "Examples"))
import plugin  # noqa: E402
import scene  # noqa: E402

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
OUTPUT = os.path.join(ROOT, "demo-output")
SIZE = [1000, 700]


def output(name):
    return os.path.join(OUTPUT, name)


def bake(particles):
    baked = SphereAmbientOcclusion(registrationName="Baked", Input=particles)
    baked.UpdatePipeline()
    baked.UpdatePropertyInformation()
    return baked


def make_view():
    view = scene.make_view(SIZE, "RenderViewWithSilhouettes")
    view.SilhouetteVisibility = 0
    scene.light_from_the_side(view)
    return view


def aim_camera(view):
    """Obliquely onto the struck face."""
    scene.aim_camera(view, -52, 18, 1.5)


def colour_by_damage(display, view):
    damage = scene.color_by(display, "damage")
    damage.RescaleTransferFunction(0, 1)
    display.SetScalarBarVisibility(view, True)
    bar = GetScalarBar(damage, view)
    bar.Title = "damage"
    bar.ComponentTitle = ""
    bar.TitleColor = bar.LabelColor = [0, 0, 0]


def save_pictures(display, view):
    """The same view: (a) direct light, (b) occlusion, (c) all with shadows and colours, (d) outlined."""
    display.ShadingMode = "Direct Light"
    SaveScreenshot(output("direct.png"), view, ImageResolution=SIZE)

    display.ShadingMode = "Ambient Occlusion"
    SaveScreenshot(output("ambient-occlusion.png"), view, ImageResolution=SIZE)

    display.ShadingMode = "Direct Light and Ambient Occlusion"
    display.OcclusionOnDiffuse = 0
    display.Ambient = 0.55
    display.Diffuse = 0.6
    display.Shadows = 1
    colour_by_damage(display, view)
    SaveScreenshot(output("combined.png"), view, ImageResolution=SIZE)

    view.SilhouetteVisibility = 1
    SaveScreenshot(output("silhouettes.png"), view, ImageResolution=SIZE)


def save_files(baked, display):
    display.LayersFile = output("layers.exr")
    display.SMProxy.InvokeCommand("WriteLayers")
    SaveData(output("textures.exr"), baked)
    # Binary: ParaView 5.11 of Debian cannot read appended data everywhere.
    SaveData(output("baked.vtp"), baked, DataMode="Binary")
    SaveState(output("state.pvsm"))


def print_table(baked, display):
    bake_of = baked.GetPropertyValue
    display.UpdatePropertyInformation()
    frame_of = display.GetPropertyValue
    rows = [
        ("particles", f"{bake_of('NumberOfParticles'):,}"),
        ("texels", f"{bake_of('NumberOfTexels'):,}"),
        ("method", f"{bake_of('MethodUsed')}, {bake_of('NumberOfDirections'):,} directions"),
        ("RMS error, estimated", f"{bake_of('EstimatedError'):.4f}"),
        ("occlusion rays", f"{bake_of('NumberOfRays'):,}"),
        ("skipped: samples inside", f"{bake_of('NumberOfSamplesInside'):,}"),
        ("skipped: texels inside", f"{bake_of('NumberOfTexelsInside'):,}"),
        ("skipped: particles buried", f"{bake_of('NumberOfParticlesBuried'):,}"),
        ("textures stored", f"{bake_of('NumberOfTextures'):,}"),
        ("bytes of textures", f"{bake_of('NumberOfTextureBytes'):,}"),
        ("seconds to bake", f"{bake_of('BakeSeconds'):.1f} on {bake_of('NumberOfThreads')} threads"),
        ("primary rays a frame", f"{frame_of('NumberOfRays'):,}"),
        ("shadow rays a frame", f"{frame_of('NumberOfShadowRays'):,}"),
        ("seconds to trace, shadow, shade",
         " ".join(f"{frame_of(name):.3f}" for name in ("TraceSeconds", "ShadowSeconds", "ShadeSeconds"))),
    ]
    width = max(len(name) for name, _ in rows)
    for name, value in rows:
        print(f"{name:<{width}}  {value}")


def main():
    plugin.load(globals())
    os.makedirs(OUTPUT, exist_ok=True)
    particles = OpenDataFile(os.path.join(ROOT, "Data", "bullet_1000.vtp"))
    baked = bake(particles)
    view = make_view()
    display = scene.show_spheres(baked, view)
    aim_camera(view)
    save_pictures(display, view)
    save_files(baked, display)
    print_table(baked, display)


if __name__ == "__main__":
    main()
