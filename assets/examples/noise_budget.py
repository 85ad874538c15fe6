# %% [markdown]
# # How noisy may a detector be?
#
# A map shall be good to 5 mm. How exact must the centres of balls be? The same drives are run with more and more noise in
# the detector's answers. Run this from the folder that has `assets`, with `stereobench` on Python's path.

# %%
import stereobench as sb

LIMIT_M = 0.005
scenario = sb.Scenario("assets/scenarios/ball_circle.yaml", {"path.laps": 0.1, "gates": []}, seeds="0..3",
                       filters="smoother")
swept = sb.sweep(scenario, {"detector_noise.centre_sd_px": [0, 0.1, 0.2, 0.5, 1]})

# %% [markdown]
# The mean error over the seeds, with its 95 % interval, at each level.

# %%
levels = []
for cell in swept["cells"]:
    ate = cell["run"]["filters"]["smoother"]["ate_rms_m"]
    level = float(cell["values"]["detector_noise.centre_sd_px"])
    levels.append((level, ate["mean"] + ate["ci95_half_width"]))
    print(f"centres off by {level:g} px: ATE {1e3 * ate['mean']:.2f} +- {1e3 * ate['ci95_half_width']:.2f} mm")

# %% [markdown]
# The budget is the last level before the interval crosses the limit. `stereobench budget` says it with confidence for a
# share of all worlds.

# %%
budget_px = None
for level, worst in levels:
    if worst > LIMIT_M:
        break
    budget_px = level
print(f"a detector may be off by {budget_px:g} px in each centre for {1e3 * LIMIT_M:g} mm" if budget_px is not None else
      "no detector is good enough")
