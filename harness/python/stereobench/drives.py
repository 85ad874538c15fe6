"""Drives that are taken step by step: look, detect, filter, score."""
import numpy as np

from stereobench import _core
from stereobench.results import Result

#: One measurement: horizontal range (m) and bearing (rad, left-positive) from the robot's origin, with the covariance of
#: both. landmark_id and colour_class are -1 where they are not known; sd_scale is 1 unless faults are simulated.
MEASUREMENT = np.dtype([("range_m", "f8"), ("bearing_rad", "f8"), ("covariance", "f8", (2, 2)), ("sd_scale", "f8", (2,)),
                        ("landmark_id", "i8"), ("colour_class", "i8")])

#: One landmark of a map, in the world frame (m, m^2). landmark_id and colour_class are -1 where they are not known.
LANDMARK = np.dtype([("landmark_id", "i8"), ("colour_class", "i8"), ("x_m", "f8"), ("y_m", "f8"),
                     ("covariance", "f8", (2, 2))])

Filter = _core.Filter


class Drive(_core.Drive):
    """A seed of a scenario, frame by frame. To iterate over it renders each frame when its turn comes.

    scenario: a Scenario; seed: of its world, noise and filters.
    A drive belongs to one thread at a time; the interpreter's lock is released while it renders and detects.
    """

    def __init__(self, scenario, seed=0):
        super().__init__(scenario, seed)
        self.scenario = scenario
        self._told = self.setup

    def __iter__(self):
        for step in range(len(self)):
            yield self.frame(step)

    def frame(self, step):
        """Renders the frame of a step (DriveFrame). Its `left` and `right` are None where the frame is lost."""
        return self._frame(step, self._told)

    def render(self, x_m, y_m, heading_rad):
        """What both cameras see from a pose in the world frame, without noise (Truth)."""
        return self._render(x_m, y_m, heading_rad)

    def filter(self, name, particles=0):
        """One of our filters at the start of this drive (Filter). particles: 0 is as the scenario says."""
        return Filter(name, self, particles)

    def score(self, filters):
        """Scores filters over this drive: a Tally of it alone."""
        tally = Tally(self.scenario)
        tally.add(self, filters)
        return tally.result()


def estimates(name, drive, poses, covariances=None, landmarks=None):
    """Estimates of a filter of one's own, to be scored beside ours.

    poses: N x 3, x_m, y_m, heading_rad in the world frame, one a step of the drive.
    covariances: N x 3 x 3 of these; without them, consistency is not meaningful.
    landmarks: the final map, an array of LANDMARK.
    """
    return _core._estimates(name, drive, poses, covariances, landmarks)


class Tally:
    """Sums drives up to what run.json says, as `run` does.

    scenario: that of the drives.
    """

    def __init__(self, scenario):
        self.scenario = scenario
        self._tally = _core.Tally(scenario)

    def add(self, drive, filters):
        """Adds a finished drive. filters: Filter or what estimates() gave, the same in each drive."""
        runs = [run.estimates() if isinstance(run, Filter) else run for run in filters]
        self._tally._add(drive, runs)

    def result(self):
        """The Result of the drives so far."""
        return Result(self._tally._json())
