# SPDX-License-Identifier: MIT
"""Learning and identifying are those of the program."""
import json as json_text
import pickle

import numpy

import faultline
from small_robots import HEALTHY as RUNS, OfRobots
from support import BENCH, InFolder, columns, program, without_origin

HEALTHY = sorted(BENCH.glob("healthy_*.csv"))
ROBOT = BENCH / "robot.toml"
RUNS_PER_LABEL = 2


class Learning(OfRobots):
    def test_a_model_learned_from_files_has_the_bytes_of_the_programs(self):
        robot, bad = self.files["cell-1"], self.made / "cell-1/bad.csv"
        healthy = [self.made / f"cell-1/{run}.csv" for run in RUNS]
        mine, theirs = self.folder / "mine.json", self.folder / "theirs.json"
        labels = self.folder / "labels.csv"
        labels.write_text(f"file,fault,joint,onset_s\n{bad},locked,1,5.0\n")
        options = ("--robot", robot, "--labels", labels, "--runs-per-label", RUNS_PER_LABEL)
        json = program("learn", *healthy, bad, *options, "-o", theirs, "--json", "-")
        label = ("locked", numpy.int64(1), numpy.float32(5.0))
        learned = faultline.learn(
            [*healthy, bad], robot, output=mine, labels={bad: label}, runs_per_label=RUNS_PER_LABEL
        )
        self.assertEqual(mine.read_bytes(), theirs.read_bytes())
        self.assertEqual(learned.to_json().encode(), json)
        self.assertEqual(learned.model.to_json().encode(), theirs.read_bytes())
        self.assertIn('Learned "two joints"', learned.text())
        found = set()
        for log in (healthy[1], bad):
            diagnosis = learned.model.diagnose(log)
            self.assertEqual(
                diagnosis.to_json().encode(), program("diagnose", log, "--model", theirs, "--json", "-")
            )
            found.add(diagnosis.verdict)
        self.assertEqual(found, {"healthy", "faulty"})

        self.assertEqual(
            [(source.path, source.fault) for source in learned.sources],
            [(log.name, "none") for log in healthy] + [("bad.csv", "locked")],
        )

        frames = [columns(log) for log in (*healthy, bad)]
        in_memory = faultline.learn(frames, robot, labels={"frame 4": label}, runs_per_label=RUNS_PER_LABEL)
        of_file, of_frames = (without_origin(m.model.diagnose(bad)) for m in (learned, in_memory))
        named = json_text.dumps(of_frames["faults"]).replace("frame 4", bad.name)  # it may be a precedent
        self.assertEqual(json_text.loads(named), of_file["faults"])
        self.expect_file_of(in_memory.model, self.folder / "memory.json")
        again = pickle.loads(pickle.dumps(learned.model))
        self.assertEqual(again.diagnose(bad).to_json(), learned.model.diagnose(bad).to_json())

    def expect_file_of(self, model, path):
        """Of a model in memory only."""
        self.assertEqual(model.path, "")
        for call in (
            lambda: pickle.dumps(model),
            model.reload,
            lambda: faultline.cases.list(model),
            lambda: faultline.batch(BENCH, model, self.folder / "batch"),
            lambda: faultline.golden.record(HEALTHY, model, self.folder / "golden"),
        ):
            with self.assertRaisesRegex(faultline.UsageError, "save it first"):
                call()
        model.save(path)
        self.assertEqual((model.path, model.name), (str(path), "two joints"))
        self.assertEqual(faultline.load_model(path).name, "two joints")
        self.assertEqual(pickle.loads(pickle.dumps(model)).to_json(), path.read_text())
        self.assertTrue(faultline.cases.list(model))


class Labels(InFolder):
    def test_what_is_no_label_is_refused_before_the_work(self):
        for label in (1, "locked", ("none", None, None), ("locked", 1), ("locked", 1.5, 2.0), (None, 1, 2.0)):
            with self.assertRaisesRegex(
                faultline.UsageError,
                r'labels, healthy_1.csv: .* is not a label; a label is \(fault, joint, onset_s\), such as',
            ):
                faultline.learn(HEALTHY, ROBOT, labels={"healthy_1.csv": label})
        with self.assertRaisesRegex(faultline.UsageError, '"lokced" is not a fault name; expected one of'):
            faultline.learn(HEALTHY, ROBOT, labels={"healthy_1.csv": ("lokced", 1, 2.0)})

    def test_a_label_of_a_log_that_is_not_there_is_refused(self):
        with self.assertRaisesRegex(
            faultline.UsageError, "labels, healthy_9.csv: is not one of the logs, which are: healthy_1.csv, "
        ):
            faultline.learn(HEALTHY, ROBOT, labels={"healthy_9.csv": ("locked", 1, 2.0)})
        frames = [columns(log) for log in HEALTHY]
        with self.assertRaisesRegex(faultline.UsageError, "which are: frame 1, frame 2"):
            faultline.learn(frames, ROBOT, labels={"run 1": ("locked", 1, 2.0)})


class Identifying(InFolder):
    def test_an_identification_has_the_bytes_of_the_programs(self):
        theirs, page = self.folder / "robot.toml", self.folder / "page.html"
        json = program("identify", *HEALTHY, "--robot", ROBOT, "-o", theirs, "--json", "-", "--html", page)
        identified = faultline.identify(HEALTHY, ROBOT)
        self.assertEqual(identified.to_json().encode(), json)
        self.assertEqual(identified.robot_text().encode(), theirs.read_bytes())
        self.assertEqual(identified.to_html().encode(), page.read_bytes())
        self.assertIn("<robot", identified.robot_text(urdf=True))
        self.assertEqual(
            list(identified.to_dataframe()["name"]), [p.name for p in identified.base_parameters]
        )

    def test_frames_identify_the_same_parameters(self):
        of_files = faultline.identify(HEALTHY, ROBOT)
        of_frames = faultline.identify([columns(log) for log in HEALTHY], ROBOT)
        self.assertEqual(of_frames.base_parameters, of_files.base_parameters)
