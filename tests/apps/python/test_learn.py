# SPDX-License-Identifier: MIT
"""Learning and identifying are those of the program."""

import faultline
from support import BENCH, InFolder, columns, program, without_origin

HEALTHY = sorted(BENCH.glob("healthy_*.csv"))
ROBOT = BENCH / "robot.toml"
RUNS = 4


class Learning(InFolder):
    def test_a_model_learned_from_files_has_the_bytes_of_the_programs(self):
        mine, theirs = self.folder / "mine.json", self.folder / "theirs.json"
        options = ("--robot", ROBOT, "--runs-per-label", RUNS)
        json = program("learn", *HEALTHY, *options, "-o", theirs, "--json", "-")
        learned = faultline.learn(HEALTHY, ROBOT, output=mine, runs_per_label=RUNS)
        self.assertEqual(mine.read_bytes(), theirs.read_bytes())
        self.assertEqual(learned.to_json().encode(), json)
        self.assertEqual(learned.model.to_json().encode(), theirs.read_bytes())
        self.assertIn('Learned "bench"', learned.text())
        logs = sorted(set(BENCH.glob("*.csv")) - {BENCH / "labels.csv"})
        found = set()
        for log in logs:
            diagnosis = learned.model.diagnose(log)
            self.assertEqual(
                diagnosis.to_json().encode(), program("diagnose", log, "--model", theirs, "--json", "-")
            )
            found.add(diagnosis.verdict)
        self.assertEqual(found, {"healthy", "faulty"})

        in_memory = faultline.learn([columns(log) for log in HEALTHY], ROBOT, runs_per_label=RUNS)
        log = BENCH / "locked_1.csv"
        of_file, of_frames = (without_origin(m.model.diagnose(log)) for m in (learned, in_memory))
        self.assertEqual(of_frames["faults"], of_file["faults"])
        self.assertEqual(in_memory.model.path, "")
        in_memory.model.save(self.folder / "memory.json")
        self.assertEqual(faultline.load_model(self.folder / "memory.json").name, "bench")


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
