# %% [markdown]
# # How noisy may a detector be?
#
# A robot shall know where it is to 5 mm, in nine of ten worlds. How exact must a detector's centres of balls be? Run this
# from the folder that has `assets`, with `stereobench` on Python's path.

# %%
import textwrap

import stereobench as sb

scenario = sb.Scenario("assets/scenarios/ball_circle.yaml", {"path.laps": 0.1})

# %% [markdown]
# `budget` adds noise to what the detector answers, on the same drives at every level. It looks for the largest level with
# which the limit holds, and runs as few drives as the answer needs. With `detector=` it is yours that is made worse.

# %%
answer = sb.budget(scenario, {"detector_noise.centre_sd_px": (0, 0.5)}, "filters.smoother.ate_rms_m", limit=0.005,
                   share=0.9, confidence=0.9, out="out/noise_budget")
found = answer["budgets"][0]
print(textwrap.fill(found["says"], 100))

# %% [markdown]
# Each disc is a drive. The dashed line is the limit, the upright one is the budget.
#
# ![The error over the noise: all drives that were run at the budget are below the limit](out/noise_budget/budget.png)
#
# At most levels a few drives are enough: one world in which the limit is broken too often ends the search there.

# %%
for level in sorted({run["level"] for run in found["runs"]}):
    errors_mm = [1e3 * run["value"] for run in found["runs"] if run["level"] == level]
    print(f"centres off by {level:5.3f} px, drives: {len(errors_mm):2}, ATE up to {max(errors_mm):5.2f} mm")
