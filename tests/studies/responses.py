"""What errors of a detector do to the filters: ten sweeps, their tables and two pictures of their curves.

usage: responses.py PROGRAM SCENARIO_FOLDER OUT [--jobs N] [--seeds A..B]

OUT keeps finished sweeps, for a study that is stopped and goes on. Other seeds or another program need another OUT.
"""

import argparse
import json
import pathlib
import subprocess

from PIL import Image

SEEDS = {"ball_circle": "0..9", "corridor": "0..4"}
SEEDS_OF_ONE = {("corridor", "centre_noise"): "0..9"}  # with large noise some drives go astray
SWEEPS = {
    "image_noise": ["camera.noise_sd_levels=0,1,2,4,8"],
    "centre_noise": ["detector_noise.centre_sd_px=0,0.125,0.25,0.5,1,2"],
    "lost_balls": ["detector_noise.miss_probability=0,0.05,0.1,0.2,0.35,0.5"],
    "baseline": ["believed_rig.baseline_m=0.12,0.1203,0.1206,0.1212,0.1224", "--paired-to", "0.12"],
    "delay": ["shutter.right_delay_s=0,0.005,0.01,0.02,0.05"],
}
FILTERS = ["ekf", "fastslam2", "ufastslam", "smoother"]
CURVES_PX = 676  # height of a response's curves; its sentences are below
WIDTH_PX = 640   # of a response in the picture


def sweep(arguments, scenario, name, out):
    if (out / "sweep.json").exists():
        return
    seeds = arguments.seeds or SEEDS_OF_ONE.get((scenario, name), SEEDS[scenario])
    subprocess.run([arguments.program, "sweep", f"{arguments.scenarios}/{scenario}.yaml", "--vary", *SWEEPS[name],
                    "--filters", ",".join(FILTERS), "--seeds", seeds, "--set", "gates=[]", "--jobs", str(arguments.jobs),
                    "--out", out], check=True, stdout=subprocess.DEVNULL)


def millimetres(summary):
    mean, half_width = 1e3 * summary["mean"], 1e3 * summary["ci95_half_width"]
    digits = 3 if half_width < 0.01 else 2 if half_width < 1 else 1
    return f"{mean:.{digits}f} +- {half_width:.{digits}f}"


def table(out):
    """Recall, the bound and each filter's ATE [mm] with its 95 % interval, by level."""
    lines = ["| level | recall | bound | " + " | ".join(FILTERS) + " |", "|---" * (3 + len(FILTERS)) + "|"]
    for cell in json.loads((out / "sweep.json").read_text())["cells"]:
        run = cell["run"]
        ates = " | ".join(millimetres(run["filters"][name]["ate_rms_m"]) for name in FILTERS)
        bound = 1e3 * run["bound"]["pose_rms_m"]["mean"]
        lines.append(f"| {', '.join(cell['values'].values())} | {run['vision']['recall']:.3f} | "
                     f"{bound:.{4 if bound >= 1000 else 3}g} | {ates} |")
    return "\n".join(lines)


def tiled(files):
    """Curves of responses, two in a row, in few colours."""
    tiles = []
    for file in files:
        picture = Image.open(file)
        curves = picture.crop((0, 0, picture.width, CURVES_PX))
        tiles.append(curves.resize((WIDTH_PX, round(CURVES_PX * WIDTH_PX / picture.width)), Image.Resampling.LANCZOS))
    height = max(tile.height for tile in tiles)
    sheet = Image.new("RGB", (2 * WIDTH_PX, height * ((len(tiles) + 1) // 2)), "white")
    for i, tile in enumerate(tiles):
        sheet.paste(tile, (i % 2 * WIDTH_PX, i // 2 * height))
    return sheet.quantize(128)


def main():
    parser = argparse.ArgumentParser(description="Responses of the filters to errors of a detector.")
    parser.add_argument("program")
    parser.add_argument("scenarios")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--seeds", help="of all sweeps; default: 0..9 of ball_circle, 0..4 of corridor, 0..9 with its centre noise")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    for scenario in SEEDS:
        folders = [arguments.out / f"{scenario}_{name}" for name in SWEEPS]
        for folder, name in zip(folders, SWEEPS):
            sweep(arguments, scenario, name, folder)
            print(f"\n{scenario}, {name}\n\n{table(folder)}", flush=True)
        sheet = tiled([folder / "response.png" for folder in folders])
        sheet.save(arguments.out / f"response_{scenario}.png", optimize=True)


if __name__ == "__main__":
    main()
