# SPDX-License-Identifier: MIT
"""A LeRobot data set as logs, one CSV an episode: lerobot_logs.py DATASET FOLDER

DATASET is a folder of LeRobot v2.0 to v3.0 (meta/info.json, data/chunk-*/*.parquet). observation.state becomes the
positions q1.., action the commanded positions q_ref1.., frame_index over fps the time. A gripper is no joint of the
arm: it stays under its name. The program prints which joint has which name. Needs pandas with pyarrow or fastparquet.
"""
import json
import pathlib
import sys

import numpy
import pandas

COLUMNS = ["observation.state", "action", "frame_index", "episode_index"]


def read_info(dataset):
    """What meta/info.json states: frames a second, and the names of state and action in their order."""
    info = json.loads((pathlib.Path(dataset) / "meta" / "info.json").read_text(encoding="utf-8"))
    names = {}
    for feature in ("observation.state", "action"):
        names[feature] = info["features"][feature].get("names")
        if isinstance(names[feature], dict):  # {"motors": [...]}
            names[feature] = next(iter(names[feature].values()))
        if not names[feature]:
            names[feature] = [f"joint {i + 1}" for i in range(info["features"][feature]["shape"][0])]
    return info["fps"], names


def channels_of(names, prefix):
    """The columns of a log for these names: q1, q2, .., and "q gripper" for a gripper."""
    channels, joints = [], 0
    for name in names:
        joints += "gripper" not in name
        channels.append(f"{prefix} {name}" if "gripper" in name else f"{prefix}{joints}")
    return channels


def episodes(dataset):
    """Yields number and frame of each episode; an episode never lies in two files."""
    fps, names = read_info(dataset)
    for path in sorted(pathlib.Path(dataset).glob("data/chunk-*/*.parquet")):
        rows = pandas.read_parquet(path, columns=COLUMNS)
        for number, episode in rows.groupby("episode_index"):
            columns = {"t": episode["frame_index"].to_numpy() / fps}
            for feature, prefix in (("observation.state", "q"), ("action", "q_ref")):
                values = numpy.stack(episode[feature].to_numpy())
                columns.update(zip(channels_of(names[feature], prefix), values.T))
            yield number, pandas.DataFrame(columns)


def main(dataset, folder):
    fps, names = read_info(dataset)
    print(f"{fps} frames a second")
    for channel, name in zip(channels_of(names["observation.state"], "q"), names["observation.state"]):
        print(f"{channel} is {name}")
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    for number, frame in episodes(dataset):
        frame.to_csv(folder / f"episode_{number:06d}.csv", index=False)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
