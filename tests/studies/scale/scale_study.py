"""What happens to a million runs on a thousand cores: a simulation from measured costs.

Cores take shards from a queue. A shard takes its overhead and the time of its drives; some cores are slow; processes
are killed, lose the drive that they were at, and are put back into the queue after Slurm's pause. The file system
takes so many operations a second, and all cores wait where that is too few.

usage: scale_study.py [--runs N] [--cores N] [--seed N]    prints two tables in Markdown
"""
import argparse
import heapq
import random

# Measured on one core (docs/results.md, "Scale"): seconds and bytes.
DRIVE_S = 2.8            # ball_circle, one lap, five filters
DRIVE_SPREAD = 0.2       # standard deviation over the mean
SHARD_S = 0.3            # overhead of a shard: start, plan, fingerprint
DRIVE_BYTES = 5_200      # of a result of `sweep` in the store
PAIRS = 145              # of a drive

# Assumed of a cluster: to be replaced by what yours has.
SLOW_SHARE, SLOW_FACTOR = 0.05, 2.0  # of cores, and how much longer they take
KILLS_PER_CORE_HOUR = 0.02           # preemption and faults
REQUEUE_S = 120.0                    # Slurm's pause before a task that was put back may run
DISPATCH_S = 0.02                    # between two tasks that the scheduler starts
OPERATIONS_PER_S = 10_000.0          # of a shared file system: create, rename, sync


def operations(runs, shards, files_per_frame):
    """Of the file system: create, sync and rename of each file; a sync of each result."""
    if files_per_frame > 0:
        return runs * PAIRS * files_per_frame * 3
    return shards * 6 * 3 + runs


class Shard:
    def __init__(self, drives):
        self.left = drives


def simulate(runs, cores, shards, seed):
    """@return seconds until the last shard ends, seconds of work that kills lost"""
    chance = random.Random(seed)
    slow = [SLOW_FACTOR if chance.random() < SLOW_SHARE else 1.0 for _ in range(cores)]
    queue = [(0.0, number, Shard(runs // shards + (number < runs % shards))) for number in range(shards)]
    heapq.heapify(queue)
    free = [(0.0, core) for core in range(cores)]
    dispatcher, end, lost = 0.0, 0.0, 0.0
    while queue:
        ready, number, shard = heapq.heappop(queue)
        core_free, core = heapq.heappop(free)
        dispatcher = max(dispatcher + DISPATCH_S, ready, core_free)
        now = dispatcher + SHARD_S
        kill = dispatcher + chance.expovariate(KILLS_PER_CORE_HOUR / 3600.0)
        mean = shard.left * DRIVE_S * slow[core]
        spread = (shard.left ** 0.5) * DRIVE_S * DRIVE_SPREAD * slow[core]  # drives are many: a normal
        took = max(0.0, chance.gauss(mean, spread))
        if now + took <= kill:
            now += took
        else:
            done = int(max(0.0, kill - now) / (DRIVE_S * slow[core]))
            lost += max(0.0, kill - now) - done * DRIVE_S * slow[core] + SHARD_S
            shard.left = max(0, shard.left - done)
            now = max(kill, now)
            heapq.heappush(queue, (now + REQUEUE_S, number, shard))
        heapq.heappush(free, (now, core))
        end = max(end, now)
    return end, lost


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", type=int, default=1_000_000)
    parser.add_argument("--cores", type=int, default=1_000)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    runs, cores = arguments.runs, arguments.cores
    ideal = runs * DRIVE_S / (cores * (1.0 - SLOW_SHARE + SLOW_SHARE / SLOW_FACTOR))
    print(f"{runs:,} runs of {DRIVE_S:g} s on {cores:,} cores, {SLOW_SHARE:.0%} of which are slow: "
          f"{ideal / 60:.0f} min at best.\n")
    print("| shards | time [min] | of the best | lost to kills | results |\n|---|---|---|---|---|")
    for factor in [1, 2, 4, 10, 40, 100]:
        shards = min(runs, factor * cores)
        time_s, lost = simulate(runs, cores, shards, arguments.seed)
        print(f"| {shards:,} | {time_s / 60:.0f} | {ideal / time_s:.0%} | {lost / (runs * DRIVE_S):.2%} | "
              f"{runs * DRIVE_BYTES / shards / 1e6:.2g} MB a file |")
    print("\n| files | operations | time of the file system alone [min] |\n|---|---|---|")
    shards = 10 * cores
    for name, per_frame in [("one a shard", 0), ("two a frame (pictures)", 2), ("six a frame (pictures, ids, depth)", 6)]:
        count = operations(runs, shards, per_frame)
        print(f"| {name} | {count:,} | {count / OPERATIONS_PER_S / 60:,.1f} |")


if __name__ == "__main__":
    main()
