# SPDX-License-Identifier: MIT
"""What is done from files to files is done as the program does it."""
import json
import shutil

import faultline
from support import CASES, GOLDEN, LOGS, MODEL, InFolder, columns, load_model, program


class Inspecting(InFolder):
    def test_inspection_has_the_bytes_of_the_programs(self):
        log = LOGS / "locked_1.csv"
        seen = faultline.inspect(log)
        self.assertEqual(seen.to_json().encode(), program("inspect", log, "--json", "-"))
        self.assertEqual(seen.to_html().encode(), program("inspect", log, "--html", "-"))
        self.assertEqual(seen.joints, 3)
        self.assertEqual(seen.channels[0].name, "q1")
        self.assertEqual(list(seen.to_dataframe()["name"])[:2], ["q1", "q2"])

    def test_a_frame_is_inspected_as_its_file(self):
        of_file, of_frame = faultline.inspect(LOGS / "locked_1.csv"), faultline.inspect(
            columns(LOGS / "locked_1.csv")
        )
        self.assertEqual(of_frame.channels, of_file.channels)
        self.assertEqual(of_frame.verdict, of_file.verdict)

    def test_a_table_that_is_no_log_says_so(self):
        self.assertEqual(faultline.inspect({"a": [1.0, 2.0]}).verdict, "no_joint_log")


class Simulating(InFolder):
    def test_simulated_logs_have_the_bytes_of_the_programs(self):
        spec = self.folder / "spec.toml"
        shutil.copy(GOLDEN / "spec.toml", spec)
        told = program("simulate", spec, "-o", self.folder / "theirs", "--seed", 7, "--json")
        made = faultline.simulate(spec, self.folder / "mine", seed=7)
        self.assertEqual(made.to_json().encode(), told)
        names = sorted(path.name for path in (self.folder / "theirs").iterdir())
        self.assertEqual(sorted(path.name for path in (self.folder / "mine").iterdir()), names)
        for name in names:
            self.assertEqual(
                (self.folder / "mine" / name).read_bytes(), (self.folder / "theirs" / name).read_bytes()
            )
        self.assertEqual(len(made.runs), len(names) - 1)


class Batches(InFolder):
    def test_a_batch_has_the_bytes_of_the_programs_and_goes_on(self):
        told = []
        mine = faultline.batch(LOGS, load_model(), self.folder / "mine", progress=lambda *at: told.append(at))
        json = program(
            "batch", LOGS, "--model", MODEL, "--cases", CASES, "-o", self.folder / "theirs", "--json", "-"
        )
        self.assertEqual(mine.to_json().encode(), json)
        for name in ("index.csv", "index.ndjson", "index.html", "summary.json"):
            self.assertEqual(
                (self.folder / "mine" / name).read_bytes(), (self.folder / "theirs" / name).read_bytes()
            )
        logs = len(list(LOGS.glob("*.csv")))
        self.assertEqual((mine.diagnosed, len(mine.rows), len(mine.to_dataframe())), (logs, logs, logs))
        self.assertTrue(told)
        again = faultline.batch([LOGS], MODEL, self.folder / "mine", cases=CASES)
        self.assertEqual(again.diagnosed, 0)

    def test_shards_merge_to_the_whole(self):
        model = load_model()
        for part in (1, 2):
            faultline.batch(LOGS, model, self.folder / f"part-{part}", shard=f"{part}/2")
        merged = faultline.merge_batches(
            [self.folder / "part-1", self.folder / "part-2"], self.folder / "all"
        )
        whole = faultline.batch(LOGS, model, self.folder / "whole")
        self.assertEqual(merged.to_json(), whole.to_json())

    def test_folders_have_models_of_their_own(self):
        mine = faultline.batch(LOGS, {LOGS.name: MODEL}, self.folder / "mine", cases=CASES)
        theirs = program(
            "batch", LOGS, "--model", f"{LOGS.name}={MODEL}", "--cases", CASES, "-o", self.folder / "theirs",
            "--json", "-"
        )
        self.assertEqual(mine.to_json().encode(), theirs)
        with self.assertRaisesRegex(faultline.UsageError, "elsewhere"):
            faultline.batch(LOGS, {"elsewhere": load_model()}, self.folder / "none")

    def test_a_model_that_is_nowhere_is_refused(self):
        with self.assertRaisesRegex(faultline.Error, "missing.json"):
            faultline.batch(LOGS, self.folder / "missing.json", self.folder / "out")


class GoldenLogs(InFolder):
    def test_a_folder_is_recorded_checked_and_accepted(self):
        logs = [LOGS / "locked_1.csv", LOGS / "healthy_quintic.csv"]
        folder = self.folder / "golden"
        made = faultline.golden.record(logs, MODEL, folder, cases=CASES, identify=False)
        self.assertEqual(
            [(log.name, log.verdict) for log in made.logs],
            [("locked_1.csv", "faulty"), ("healthy_quintic.csv", "healthy")],
        )
        by_model = self.folder / "by_model"
        faultline.golden.record(logs, load_model(), by_model, identify=False)
        for name in ("golden.toml", MODEL.name, CASES.name):
            self.assertEqual((by_model / name).read_bytes(), (folder / name).read_bytes())
        self.assertEqual(faultline.golden.check(by_model, model=load_model()).result, "same")
        check = faultline.golden.check(folder, junit=self.folder / "junit.xml")
        self.assertEqual(check.to_json().encode(), program("golden", "check", folder, "--json", "-"))
        self.assertEqual(check.result, "same")
        self.assertIn("<testsuite", (self.folder / "junit.xml").read_text())
        text = (folder / "golden.toml").read_text()
        (folder / "golden.toml").write_text(text.replace('"locked"', '"free_swinging"'))
        changed = faultline.golden.check(folder)
        self.assertEqual(changed.result, "different")
        self.assertIn("locked_1.csv", changed.text())
        left = faultline.golden.accept(folder, same_verdict=True)
        self.assertEqual((left.accepted, left.left), ([], ["locked_1.csv"]))
        self.assertEqual(faultline.golden.accept(folder, ["locked_1"]).accepted, ["locked_1.csv"])
        self.assertEqual(faultline.golden.check(folder).result, "same")
        with self.assertRaisesRegex(faultline.UsageError, "exactly one of"):
            faultline.golden.accept(folder)


class CaseBases(InFolder):
    def setUp(self):
        super().setUp()
        self.base = self.folder / "cases.db"
        shutil.copy(CASES, self.base)

    def test_cases_are_listed_as_by_the_program(self):
        told = json.loads(program("cases", "list", "--cases", self.base, "--json"))
        self.assertEqual([case.to_dict() for case in faultline.cases.list(cases=self.base)], told)
        locked = faultline.cases.list(cases=self.base, fault="locked", joint=1)
        self.assertTrue(0 < len(locked) < len(told))
        shown = faultline.cases.show(locked[0].id, cases=self.base)
        self.assertEqual(shown.id, locked[0].id)

    def test_a_diagnosis_becomes_a_case_that_the_next_one_finds(self):
        model = faultline.load_model(MODEL, cases=self.base)
        diagnosis = model.diagnose(LOGS / "locked_1.csv")
        case = faultline.cases.add(
            diagnosis,
            model,
            fault="locked",
            joint=1,
            done="changed the brake relay",
            by="Weber",
            date="2026-01-02",
        )
        self.assertEqual((case.note, case.what_was_done), ("", "changed the brake relay"))
        again = faultline.cases.add(diagnosis, model, fault="locked", joint=1, date="2026-01-02")
        self.assertEqual(again.id, case.id)
        self.assertIn("already", again.note)
        found = faultline.load_model(MODEL, cases=self.base).diagnose(LOGS / "locked_1.csv").faults[0]
        self.assertIn("changed the brake relay", [p.what_was_done for p in found.precedents])
        rejected = faultline.cases.reject(case.id, model, fault="torque_loss", joint=1)
        self.assertEqual(rejected.outcome, "rejected")
        confirmed = faultline.cases.confirm(case.id, model)
        self.assertEqual(confirmed.outcome, "confirmed")
        exported = self.folder / "cases.json"
        faultline.cases.export(exported, model)
        self.assertEqual(exported.read_bytes(), program("cases", "export", "--cases", self.base))
        faultline.cases.delete(case.id, model)
        with self.assertRaises(faultline.Error):
            faultline.cases.show(case.id, model)
        merged = faultline.cases.import_(exported, cases=self.base, merge=True)
        self.assertEqual(merged.added, 1)
