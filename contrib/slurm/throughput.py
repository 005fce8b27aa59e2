#!/usr/bin/env python3
"""Prints the frames a second of each shard and of each node, from Slurm's completion records.

    throughput.py FOLDER SHARDS JOB... < COMPLETIONS

FOLDER       folder of the export, merged or not
SHARDS       number of shards
JOB          job numbers that sbatch printed for the array and for resubmitted parts of it
COMPLETIONS  the file of the plug-in jobcomp/filetxt (JobCompLoc), or, if slurmdbd keeps the
             accounts, the output of sacct --duplicates --parsable2 --jobs=JOB,...
             --format=JobID,State,NodeList,Start,End

A shard's seconds are those of all its runs, including lost runs, from the start to the end that
Slurm recorded; Slurm counts whole seconds. A node's seconds are those with at least one run on it.
A shard that moved counts for the node that completed it.
"""
import argparse
import collections
import datetime
import json
import pathlib
import re
import sys

Run = collections.namedtuple("Run", "shard start end state node")


def fields_of(lines):
    """Yields each record as a dictionary with JobID (ARRAY_TASK), State, NodeList, Start and End.
    """
    columns = None
    for line in lines:
        if line.startswith("JobId="):
            record = dict(word.split("=", 1) for word in line.split() if "=" in word)
            if "ArrayJobId" in record:
                yield {"JobID": f"{record['ArrayJobId']}_{record['ArrayTaskId']}", "State": record["JobState"],
                       "NodeList": record["NodeList"], "Start": record["StartTime"], "End": record["EndTime"]}
        elif columns is None:
            columns = line.strip().split("|")
        else:
            yield dict(zip(columns, line.strip().split("|")))


def runs_of(lines, jobs):
    """Returns the runs of the array's tasks in order. A run that was requeued after its end occurs
    twice: the first counts."""
    runs = {}
    for fields in fields_of(lines):
        task = re.fullmatch(r"(\d+)_(\d+)", fields["JobID"])  # sacct's steps are 12_3.batch
        if not task or task[1] not in jobs:
            continue
        try:
            start, end = (datetime.datetime.fromisoformat(fields[key]) for key in ("Start", "End"))
        except ValueError:  # never ran, or is still running
            continue
        state = "REQUEUED" if fields["State"] == "PENDING" else fields["State"].split()[0]
        runs.setdefault((fields["JobID"], start), Run(int(task[2]), start, end, state, fields["NodeList"]))
    return sorted(runs.values(), key=lambda run: (run.shard, run.start))


def frames_of_shards(folder, shards):
    """Returns the number of frames of each shard: for a merged export those of its range, else
    those of its record."""
    frames_in = lambda record: len(json.loads(record.read_text())["frames"])
    merged = folder / "sea.json"
    if merged.exists():
        frames = frames_in(merged)
        return {shard: shard * frames // shards - (shard - 1) * frames // shards for shard in range(1, shards + 1)}
    records = {shard: folder / f"sea.{shard}-of-{shards}.json" for shard in range(1, shards + 1)}
    return {shard: frames_in(record) for shard, record in records.items() if record.exists()}


def seconds_of(run):
    return (run.end - run.start).total_seconds()


def busy_seconds(runs):
    """Returns the seconds during which at least one of the runs was running."""
    total_s, until = 0.0, datetime.datetime.min
    for run in sorted(runs, key=lambda run: run.start):
        total_s += max(0.0, (run.end - max(run.start, until)).total_seconds())
        until = max(until, run.end)
    return total_s


def rate(frames, seconds):
    return f"{frames / seconds:.2f}" if seconds else "-"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("shards", type=int)
    parser.add_argument("job", nargs="+")
    arguments = parser.parse_args()
    runs = runs_of(sys.stdin, arguments.job)
    frames = frames_of_shards(arguments.folder, arguments.shards)
    if not runs:
        sys.exit(f"no run of the array {' or '.join(arguments.job)} in the completion records")

    print(f"{'shard':>5} {'frames':>6} {'seconds':>7} {'frames/s':>8}  runs")
    shards = collections.defaultdict(list)
    nodes = collections.defaultdict(list)
    for run in runs:
        shards[run.shard].append(run)
        nodes[run.node].append(run)
    for shard, of_shard in sorted(shards.items()):
        made, seconds = frames.get(shard, 0), sum(map(seconds_of, of_shard))
        print(f"{shard:>5} {made:>6} {seconds:>7.0f} {rate(made, seconds):>8}  "
              + ", ".join(f"{run.node} {run.state}" for run in of_shard))

    print(f"\n{'node':>5} {'frames':>6} {'seconds':>7} {'frames/s':>8}")
    for node, on_node in sorted(nodes.items()):
        made = sum(frames.get(run.shard, 0) for run in on_node if run.state == "COMPLETED")
        print(f"{node:>5} {made:>6} {busy_seconds(on_node):>7.0f} {rate(made, busy_seconds(on_node)):>8}")

    made = sum(frames.values())
    wall_s = (max(run.end for run in runs) - min(run.start for run in runs)).total_seconds()
    print(f"\n{made} frames in {wall_s:.0f} s, {rate(made, wall_s)} a second")


if __name__ == "__main__":
    main()
