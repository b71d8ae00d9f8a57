# SPDX-License-Identifier: MIT
"""Models of several robots from one table are those of each robot alone."""
import json
import unittest

import pandas

import faultline
from small_robots import FAULTS, HEALTHY, OfRobots, named, table_of

ONSET_S, LARGEST_ERROR_S = 5.0, 0.1

class Learning(OfRobots):
    def test_mixed_rows_give_the_bytes_of_each_robot_alone(self):
        label = ("torque_loss", 2, ONSET_S)
        table = table_of(self.frames, (*HEALTHY, "bad"))
        table = table[(table["run"] != "bad") | (table["robot"] == "cell-2")]
        self.assertEqual(list(table["robot"].iloc[:5]), ["cell-1"] * 3 + ["cell-2"] * 2)
        learned = faultline.learn_robots(
            table, self.files, by="robot", run="run", output=self.folder / "models",
            labels={"cell-2 run bad": label}, runs_per_label=2,
        )
        self.assertEqual(list(learned), list(FAULTS))
        for robot, runs in (("cell-1", HEALTHY), ("cell-2", (*HEALTHY, "bad"))):
            labels = {"cell-2 run bad": label} if "bad" in runs else None
            alone = faultline.learn(
                named(self.frames, robot, runs), self.files[robot], output=self.folder / f"{robot}.model",
                labels=labels, runs_per_label=2,
            )
            for suffix in ("", ".cases.db"):
                mine, theirs = (self.folder / part / f"{robot}.model{suffix}" for part in ("models", "."))
                self.assertEqual(mine.read_bytes(), theirs.read_bytes())
            self.assertEqual(learned[robot].to_json(), alone.to_json())
            self.assertIn(f"models/{robot}.model", learned[robot].text())
        self.assertEqual([s.fault for s in learned["cell-2"].sources], ["none"] * 3 + ["torque_loss"])
        self.expect_faults_of_each(learned)

    def expect_faults_of_each(self, learned):
        table = table_of(self.frames, ("1", "bad"))
        for robot, logs in faultline.logs_by_robot(table, "robot", run="run").items():
            healthy, bad = (learned[robot].model.diagnose(log) for log in logs)
            self.assertEqual(healthy.verdict, "healthy")
            self.assertEqual(bad.log.path, f"{robot} run bad")
            self.assertEqual([(fault.kind, fault.joint) for fault in bad.faults], [FAULTS[robot]])
            self.assertAlmostEqual(bad.faults[0].onset_s, ONSET_S, delta=LARGEST_ERROR_S)

    def test_robots_may_be_given_in_every_form_that_holds_their_rows(self):
        expected = {robot: one.model.to_json() for robot, one in self.learn_coarse().items()}
        self.assertEqual(len(set(expected.values())), 2)
        table = table_of(self.coarse)
        half = len(table) // 2
        for form in (
            table.set_index(["robot", "run"]),
            table.set_index("robot"),
            table.set_index("t"),
            table.set_index(["robot", "run", "t"]),
            table.assign(robot=table["robot"].astype("category"), run=table["run"].astype("string")),
            {name: table[name].to_numpy() for name in table},
            [table.iloc[:half], table.iloc[half:]],
            iter([table]),
        ):
            found = self.learn_coarse(form)
            self.assertEqual({robot: one.model.to_json() for robot, one in found.items()}, expected)
        logs = {robot: named(self.coarse, robot) for robot in self.coarse}
        found = faultline.learn_robots(logs, self.files)
        self.assertEqual({robot: one.model.to_json() for robot, one in found.items()}, expected)

    def test_a_table_without_a_column_of_runs_is_one_run_of_each_robot(self):
        tables = [table_of(self.coarse, (run,)).drop(columns="run") for run in HEALTHY]
        found = self.learn_coarse(tables, run=None)
        self.assertEqual(
            [source.path for source in found["cell-2"].sources], [f"cell-2 frame {n}" for n in (1, 2, 3)]
        )
        found = self.learn_coarse(tables[0], run=None)
        self.assertEqual([source.path for source in found["cell-1"].sources], ["cell-1"])

    def test_robots_with_more_joints_or_other_channels_share_a_table(self):
        expected = {robot: one.model.to_json() for robot, one in self.learn_coarse().items()}
        table = table_of(self.coarse)
        is_first = table["robot"] == "cell-1"
        table["q3"] = table["q1"].where(~is_first)
        table["tau1"] = table["q2"].where(~is_first)
        with self.assertRaisesRegex(faultline.InputError, "^robot cell-2, .* another robot: it has 3 joints"):
            self.learn_coarse(table, output=self.folder)
        self.assertEqual((self.folder / "cell-1.model").read_text(), expected["cell-1"])
        empty = table_of(self.coarse).assign(q3=float("nan"))
        with self.assertRaisesRegex(faultline.InputError, "^robot cell-1, .* it has 3 joints"):
            self.learn_coarse(empty)

    def test_numbers_are_ids_and_one_file_serves_all(self):
        ids = {"cell-1": 7.0, "cell-2": 12.0}
        table = table_of(self.coarse)
        table["robot"] = table["robot"].map(ids)
        found = self.learn_coarse(table, robot=self.files["cell-1"], output=self.folder)
        self.assertEqual([(type(robot), robot) for robot in found], [(int, 7), (int, 12)])
        self.assertEqual(
            self.files_below(), ["12.model", "12.model.cases.db", "7.model", "7.model.cases.db"]
        )
        by_text = {str(int(ids[robot])): file for robot, file in self.files.items()}
        self.assertEqual(list(self.learn_coarse(table, robot=by_text)), [7, 12])

    def test_progress_is_that_of_all_robots(self):
        seen = []
        self.learn_coarse(progress=lambda what, share: seen.append((what.split(": ")[0], share)))
        self.assertEqual({robot for robot, _ in seen}, set(FAULTS))
        for robot, share in seen:
            self.assertTrue(0 <= share <= 0.5 if robot == "cell-1" else 0.5 <= share <= 1, (robot, share))

    def test_work_that_is_ended_leaves_the_finished_models(self):
        class Enough(Exception):
            pass

        def stop(what, share):
            if what.startswith("cell-2"):
                raise Enough

        tables = [table_of({"cell-1": self.coarse["cell-1"]}), table_of({"cell-2": self.frames["cell-2"]})]
        with self.assertRaises(Enough):
            self.learn_coarse(tables, output=self.folder / "models", progress=stop)
        self.assertEqual(
            self.files_below(), ["models", "models/cell-1.model", "models/cell-1.model.cases.db"]
        )


class Refusals(OfRobots):
    def expect(self, kind, words, table=None, **options):
        """Nothing is written, the folder neither."""
        with self.assertRaisesRegex(kind, words):
            self.learn_coarse(table, **{"output": self.folder / "new/models", **options})
        self.assertEqual(self.files_below(), [])

    def test_columns_that_are_not_there_are_named(self):
        usage = faultline.UsageError
        self.expect(usage, '^by: "robt" is not a column; there are t, q1, .*, robot, run$', by="robt")
        self.expect(usage, '^run: "episode" is not a column; there are t, ', run="episode")
        self.expect(usage, '^run: "robot" is the column of the robots', run="robot")
        table = table_of(self.coarse)
        self.expect(usage, '^by: "robot" is in two columns', pandas.concat([table, table[["robot"]]], axis=1))
        self.expect(usage, "^by: names the column of the robots' ids; without it give a dict of", by=None)
        self.expect(usage, "^frame: str is not a table", [table, "more.csv"])
        self.expect(usage, "^frame: int is not a table", 17)
        uneven = {"t": [1.0], "robot": [1, 2], "run": [1, 2]}
        self.expect(faultline.InputError, "^frame: is not a table: ", uneven)
        self.expect(faultline.InputError, "^frame: has no rows", table.iloc[:0])

    def test_rows_without_robot_or_run_are_counted(self):
        for column in ("robot", "run"):
            table = table_of(self.coarse)
            table.loc[[6, 20], column] = None
            words = rf"^column {column}: is empty in 2 of {len(table)} rows, first in row 7; fill it, or"
            self.expect(faultline.InputError, words, table)

    def test_runs_without_a_column_of_their_own_are_noticed(self):
        one_after_another = pandas.concat([self.coarse["cell-2"][run] for run in HEALTHY])
        one_after_another["robot"] = "cell-2"
        mixed = table_of({"cell-2": self.coarse["cell-2"]})
        for table, why in ((one_after_another, "the clock goes back"), (mixed, "repeats the time")):
            self.expect(
                faultline.InputError,
                f"^robot cell-2, cell-2: the time does not increase .*{why}.*"
                'these are probably several runs: name the column that numbers them, such as run="episode"',
                table,
                run=None,
            )
        with self.assertRaisesRegex(faultline.InputError, "these are probably several runs"):
            faultline.logs_by_robot(mixed, "robot")
        wrong, words = mixed.assign(shift="early"), 'cell-2 shift early: .*column "shift" does not separate'
        self.expect(faultline.InputError, words, wrong, run="shift")

    def test_a_robot_with_too_few_rows_is_named_before_the_work(self):
        table = table_of(self.coarse)
        table = table[(table["robot"] == "cell-1") | (table["robot"] == "cell-2").cumsum().lt(50)]
        self.expect(faultline.InputError, "^robot cell-2: has 49 rows .*: add healthy runs of it", table)
        with self.assertRaisesRegex(faultline.InputError, "^robot b: has no log; add"):
            faultline.learn_robots({"a": named(self.coarse, "cell-1"), "b": []}, self.files["cell-1"])

    def test_an_error_in_learning_names_its_robot(self):
        table = table_of(self.coarse)
        table.loc[table["robot"] == "cell-1", ["q1", "q2", "dq1", "dq2"]] = 0.0
        with self.assertRaisesRegex(faultline.InputError, "^robot cell-1, ") as caught:
            self.learn_coarse(table, output=self.folder / "models")
        self.assertTrue(caught.exception.where.startswith("robot cell-1, "))
        self.assertEqual(self.files_below(), [])

    def test_a_robot_needs_a_file(self):
        only = {"cell-1": self.files["cell-1"]}
        words = "^robot: has no robot file for cell-2; there are those of cell-1$"
        self.expect(faultline.UsageError, words, robot=only)

    def test_ids_that_cannot_name_a_file_are_refused_if_files_are_wanted(self):
        for name in ("line/1", "..", ".hidden", "", " a", "a\nb", "a\\b", "x" * 201):
            table = table_of(self.coarse)
            table["robot"] = table["robot"].replace("cell-2", name)
            words = "^robot '.*': cannot be the name of a file; rename it in the table"
            self.expect(faultline.InputError, words, table, robot=self.files["cell-1"])
        self.assertIn("x" * 201, self.learn_coarse(table, robot=self.files["cell-1"]))
        table["robot"] = table["robot"].replace({"cell-1": 1, "x" * 201: "1"})
        self.expect(faultline.InputError, "^robot 1: is the id of two", table, robot=self.files["cell-1"])

    def test_a_label_of_no_log_is_refused(self):
        words = "^labels, cell-1 run 9: is not one of the logs, which are: cell-1 run 1, .*, cell-2 run 3$"
        self.expect(faultline.UsageError, words, labels={"cell-1 run 9": ("none", 0, 0)})

    def test_a_file_in_the_place_of_the_folder_is_left(self):
        taken = self.folder / "taken"
        taken.write_text("mine")
        with self.assertRaisesRegex(faultline.OutputError, "taken: is no folder and cannot be made one"):
            self.learn_coarse(output=taken)
        self.assertEqual(taken.read_text(), "mine")


class Splitting(OfRobots):
    def test_columns_that_a_robot_file_defines_are_read_with_it(self):
        table = table_of(self.coarse).rename(columns={"t": "clock", "q1": "a", "q2": "b"})
        mapped = self.folder / "mapped.toml"
        mapped.write_text(
            'axes = "RR"\n[log.columns]\nt = {name = "clock", unit = "ms"}\nq1 = "a"\nq2 = "b"\n'
        )
        logs = faultline.logs_by_robot(table, "robot", run="run", robot=mapped)
        self.assertEqual(sorted(logs), sorted(FAULTS))
        self.assertEqual([log.name for log in logs["cell-1"]], [f"cell-1 run {run}" for run in HEALTHY])
        read = logs["cell-1"][0].to_dict(robot=mapped)
        self.assertAlmostEqual(read["t"][-1] * 1000, self.coarse["cell-1"]["1"]["t"].iloc[-1])
        with self.assertRaisesRegex(faultline.InputError, "^robot cell-1, cell-1: the time does not incr"):
            faultline.logs_by_robot(table, "robot", robot={robot: mapped for robot in FAULTS})
        unread = faultline.logs_by_robot(table, "robot")  # only a model can find the columns
        self.assertEqual(len(unread["cell-1"]), 1)

    def test_robots_and_runs_are_in_the_order_of_their_first_rows(self):
        parts = [self.coarse[robot][run].assign(robot=robot, run=run) for robot, run in
                 (("cell-2", "3"), ("cell-1", "2"), ("cell-2", "1"), ("cell-1", "1"))]
        logs = faultline.logs_by_robot(pandas.concat(parts), "robot", run="run")
        self.assertEqual(
            [log.name for of_it in logs.values() for log in of_it],
            ["cell-2 run 3", "cell-2 run 1", "cell-1 run 2", "cell-1 run 1"],
        )

    def test_the_columns_of_ids_are_no_channels(self):
        log = faultline.logs_by_robot(table_of(self.coarse), "robot", run="run")["cell-2"][0]
        self.assertEqual(log.columns, list(self.coarse["cell-2"]["1"]))
        facts, alone = log.facts(), faultline.Log(self.coarse["cell-2"]["1"]).facts()
        self.assertEqual((facts.sha256, facts.rows), (alone.sha256, alone.rows))
        self.assertEqual(json.loads(facts.to_json())["issues"], [])


if __name__ == "__main__":
    unittest.main()
