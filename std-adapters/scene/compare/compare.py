"""Renders scenes with ratiocv and with Mitsuba 3 in turns; see `mitsuba` beside this file."""

import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import time

import mitsuba
import numpy

SPP = 64
ROUNDS = 7
REFERENCE_SPP = 4096
# Plain Monte Carlo, samples per second relative to Mitsuba's.
BARS = {"S1": 1.5, "S2": 1.0, "S3": 1.5, "S4g": 0.8}
MEDIA = {"S3", "S3m", "S4d", "S4e"}
SCENES = pathlib.Path(__file__).parent.parent / "scenes"


def ours(binary, scene, folder, spp, seed, *options):
    """The image, the seconds that rendering took, and its path."""
    path = os.path.join(folder, "ours.exr")
    command = [binary, "render", scene, "--spp", str(spp), "--seed", str(seed), "--out", path, *options]
    said = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    seconds = float(re.search(r"samples in ([0-9.]+) s", said)[1])
    rate = float(re.search(r"([0-9.]+) M samples/s", said)[1]) * 1e6
    image = read(path)
    # The printed seconds have two digits; the rate has more.
    return image, image.shape[0] * image.shape[1] * spp / rate if rate > 0 else seconds


def read(path):
    return numpy.array(mitsuba.Bitmap(path))[:, :, :3].astype(numpy.float64)


def theirs(scene, integrator, seed):
    begun = time.perf_counter()
    image = numpy.array(mitsuba.render(scene, integrator=integrator, spp=SPP, seed=seed))
    seconds = time.perf_counter() - begun
    return image[:, :, :3].astype(numpy.float64), seconds


def main():
    binary, *names = sys.argv[1:]
    mitsuba.set_variant(os.environ.get("VARIANT", "llvm_ad_rgb"))
    names = names or ["S1", "S1b", "S2", "S2w", "S3", "S3m", "S4g"]
    print(f"Mitsuba {mitsuba.__version__}, {mitsuba.variant()}; {SPP} samples per pixel, medians of {ROUNDS} rounds.\n")
    print("| scene | M samples/s: plain | ratio | Mitsuba | ratio over plain | plain / Mitsuba | bar | MSE·s: plain | ratio | Mitsuba | Mitsuba / ratio |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    failed = False
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            failed |= not compare(binary, name, folder)
    sys.exit(failed)


def compare(binary, name, folder):
    reference, _ = ours(binary, name, folder, REFERENCE_SPP, 999, "--layer", "error")
    error = read(os.path.join(folder, "ours-error.exr"))
    own = float(numpy.nanmean(error**2))
    scene = mitsuba.load_file(str(SCENES / f"{name.lower()}.xml"))
    kind = "volpathmis" if name in MEDIA else "path"
    depth = int(re.search(r'name="max_depth" value="(-?\d+)"', (SCENES / f"{name.lower()}.xml").read_text())[1])
    integrator = mitsuba.load_dict({"type": kind, "max_depth": depth, "rr_depth": 1000})
    theirs(scene, integrator, 0)
    results = {"plain": [], "ratio": [], "mitsuba": []}
    for seed in range(1, ROUNDS + 1):
        for contender, result in (
            ("plain", lambda: ours(binary, name, folder, SPP, seed, "--estimator", "mc")),
            ("mitsuba", lambda: theirs(scene, integrator, seed)),
            ("ratio", lambda: ours(binary, name, folder, SPP, seed)),
        ):
            # Mitsuba's threads wait for more work for a while, and would take time from who is next.
            time.sleep(0.3)
            image, seconds = result()
            results[contender].append((float(numpy.mean((image - reference) ** 2)) - own, seconds))
    samples = reference.shape[0] * reference.shape[1] * SPP / 1e6
    seconds = {key: statistics.median(seconds for _, seconds in runs) for key, runs in results.items()}
    mse = {key: statistics.fmean(mse for mse, _ in runs) for key, runs in results.items()}
    rate = {key: samples / value for key, value in seconds.items()}
    # Of each round, so that what disturbs one disturbs both.
    faster = statistics.median(b[1] / a[1] for a, b in zip(results["plain"], results["mitsuba"]))
    over = statistics.median(b[1] / a[1] - 1 for a, b in zip(results["plain"], results["ratio"]))
    cost = {key: mse[key] * seconds[key] for key in mse}
    bar = BARS.get(name)
    holds = bar is None or faster >= bar
    verdict = "" if bar is None else f"{bar} {'holds' if holds else '**no**'}"
    print(
        f"| {name} | {rate['plain']:.2f} | {rate['ratio']:.2f} | {rate['mitsuba']:.2f} | {over:+.0%} | {faster:.2f} | {verdict} "
        f"| {cost['plain']:.2e} | {cost['ratio']:.2e} | {cost['mitsuba']:.2e} | {cost['mitsuba'] / cost['ratio']:.1f} |",
        flush=True,
    )
    return holds


if __name__ == "__main__":
    main()
