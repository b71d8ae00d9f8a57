# SPDX-License-Identifier: MIT
"""The example that makes logs of a LeRobot data set. Debian has no pyarrow, so frames stand in for its files."""
import contextlib
import io
import json
import sys
import unittest.mock

import numpy
import pandas

import faultline
from support import ROOT, InFolder

sys.path.insert(0, str(ROOT / "apps/python/examples"))
import lerobot_logs  # noqa: E402

NAMES = ["shoulder_pan.pos", "gripper.pos", "shoulder_lift.pos"]


def rows(*lengths, first=0):
    """Episodes as pandas reads them from Parquet: joint 1 at 10 times the frame plus the episode, joint 2 at -1.

    The gripper between them is at 7."""
    table = []
    for episode, length in enumerate(lengths, first):
        for frame in range(length):
            state = numpy.array([10 * frame + episode, 7, -1], dtype="float32")
            table.append([state, state + 0.5, frame, episode])
    return pandas.DataFrame(table, columns=lerobot_logs.COLUMNS)


class LeRobot(InFolder):
    def make(self, names, files):
        for path in files:
            (self.folder / path).parent.mkdir(parents=True, exist_ok=True)
            (self.folder / path).touch()
        (self.folder / "meta").mkdir()
        feature = {"dtype": "float32", "shape": [3], "names": names}
        info = {"fps": 30, "features": {"observation.state": feature, "action": feature}}
        (self.folder / "meta/info.json").write_text(json.dumps(info))
        read = {self.folder / path: frame for path, frame in files.items()}
        patch = unittest.mock.patch.object(pandas, "read_parquet", lambda path, columns: read[path][columns])
        patch.start()
        self.addCleanup(patch.stop)

    def test_a_file_an_episode_as_in_version_2(self):
        self.make(NAMES, {"data/chunk-000/episode_000000.parquet": rows(3),
                          "data/chunk-000/episode_000001.parquet": rows(2, first=1)})
        found = dict(lerobot_logs.episodes(self.folder))
        self.assertEqual(sorted(found), [0, 1])
        log = faultline.open_log(found[1]).to_dict()
        self.assertEqual(list(log["q1"]), [1, 11])
        self.assertEqual(list(log["q_ref2"]), [-0.5, -0.5])
        self.assertAlmostEqual(log["t"][1], 1 / 30)
        self.assertNotIn("tau1", log)
        self.assertNotIn("q3", log)
        self.assertEqual(list(log["q gripper.pos"]), [7, 7])

    def test_several_episodes_in_a_file_as_in_version_3(self):
        self.make({"motors": NAMES}, {"data/chunk-000/file-000.parquet": rows(3, 4)})
        self.assertEqual([len(frame) for _, frame in lerobot_logs.episodes(self.folder)], [3, 4])
        self.assertEqual(lerobot_logs.read_info(self.folder), (30, {"observation.state": NAMES, "action": NAMES}))

    def test_without_names_all_are_joints(self):
        self.make(None, {"data/chunk-000/file-000.parquet": rows(3)})
        ((_, frame),) = lerobot_logs.episodes(self.folder)
        self.assertEqual(list(frame), ["t", "q1", "q2", "q3", "q_ref1", "q_ref2", "q_ref3"])

    def test_the_program_writes_one_log_an_episode_and_names_the_joints(self):
        self.make(NAMES, {"data/chunk-000/file-000.parquet": rows(3, 4)})
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            lerobot_logs.main(self.folder, self.folder / "logs")
        self.assertIn("q2 is shoulder_lift.pos", printed.getvalue())
        log = faultline.open_log(self.folder / "logs/episode_000001.csv").to_dict()
        self.assertEqual(list(log["q1"]), [1, 11, 21, 31])


if __name__ == "__main__":
    unittest.main()
