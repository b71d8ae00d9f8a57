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


class Comparing(InFolder):
    FIRST, SECOND = LOGS / "healthy_quintic.csv", LOGS / "locked_1.csv"

    def test_a_comparison_has_the_bytes_of_the_programs(self):
        for options, model in (((), None), (("--model", MODEL), MODEL)):
            made = faultline.compare(self.FIRST, self.SECOND, model=model)
            for option, text in (("--json", made.to_json()), ("--html", made.to_html())):
                theirs = program("compare", self.FIRST, self.SECOND, *options, option, "-")
                self.assertEqual(text.encode(), theirs, option)
            self.assertEqual(made.text().encode(), program("compare", self.FIRST, self.SECOND, *options))
            self.assertFalse(made.same)
        self.assertIn("residual", set(made.to_dataframe()["quantity"]))

    def test_a_run_is_the_same_as_itself_as_a_frame(self):
        self.assertTrue(faultline.compare(self.FIRST, columns(self.FIRST), model=load_model()).same)

    def test_an_unknown_alignment_is_refused(self):
        with self.assertRaisesRegex(faultline.UsageError, "auto, time or motion"):
            faultline.compare(self.FIRST, self.SECOND, align="phase")


class Converting(InFolder):
    def test_a_converted_log_has_the_bytes_of_the_programs(self):
        log = LOGS / "locked_1.csv"
        report = self.folder / "report.json"
        report.write_bytes(program("diagnose", log, "--model", MODEL, "--cases", CASES, "--json", "-"))
        for name, options in (("run.flog", {}), ("run.mcap", {"diagnosis": report})):
            mine, theirs = self.folder / f"mine_{name}", self.folder / f"theirs_{name}"
            made = faultline.convert(log, mine, **options)
            given = [word for option, value in options.items() for word in (f"--{option}", value)]
            program("convert", log, theirs, *given)
            self.assertEqual(mine.read_bytes(), theirs.read_bytes(), name)
            self.assertEqual((made.path, made.rows_read, made.rows_written), (str(mine), *[made.rows_read] * 2))
            self.assertFalse(made.lost_values)

    def test_a_frame_with_missing_values_is_written_with_what_was_lost(self):
        frame = columns(LOGS / "locked_1.csv")
        frame["t"][5] = float("nan")
        made = faultline.convert(frame, self.folder / "run.csv")
        self.assertTrue(made.lost_values)
        self.assertEqual(made.rows_written, made.rows_read - 1)

    def test_a_log_is_not_replaced_by_its_copy(self):
        log = self.folder / "run.csv"
        shutil.copy(LOGS / "locked_1.csv", log)
        before = log.read_bytes()
        with self.assertRaisesRegex(faultline.UsageError, "run.csv"):
            faultline.convert(log, log)
        with self.assertRaisesRegex(faultline.UsageError, "only a .mcap"):
            faultline.convert(log, self.folder / "out.csv", diagnosis=self.report_of(log))
        self.assertEqual(log.read_bytes(), before)
        self.assertFalse((self.folder / "out.csv").exists())

    def report_of(self, log):
        report = self.folder / "report.json"
        report.write_text(load_model().diagnose(log).to_json())
        return report


class Histories(InFolder):
    def test_a_history_has_the_bytes_of_the_programs_and_grows(self):
        model = load_model()
        first, second = self.folder / "first.json", self.folder / "second.json"
        first.write_text(model.diagnose(LOGS / "healthy_quintic.csv").to_json())
        second.write_text(model.diagnose(LOGS / "locked_1.csv").to_json())
        mine, theirs = self.folder / "mine.sqlite", self.folder / "theirs.sqlite"
        made = faultline.history(mine, [first])
        self.assertEqual((made.added, made.replaced, made.known), (1, 0, 0))
        made = faultline.history(mine, [first, second])
        self.assertEqual((made.added, made.replaced, made.known), (1, 0, 1))
        json = program("history", first, second, "--db", theirs, "--json", "-")
        self.assertEqual(made.to_json().encode(), json)
        self.assertEqual(made.to_html().encode(), program("history", "--db", theirs, "-o", "-"))
        self.assertEqual(made.text().encode(), program("history", "--db", theirs))
        self.assertEqual(list(made.to_dataframe()["robot"]), [model.name])
        self.assertEqual(faultline.history(mine).to_json(), made.to_json())
        with self.assertRaisesRegex(faultline.UsageError, "nobody"):
            faultline.history(mine, robots="nobody")


class Signing(InFolder):
    def test_an_edited_model_is_accepted_with_the_reason(self):
        mine, theirs = self.folder / "mine.json", self.folder / "theirs.json"
        for model in (mine, theirs):
            model.write_text(MODEL.read_text().replace('"q_noise": [', '"q_noise":  ['))
        with self.assertRaises(faultline.InputError):
            faultline.load_model(mine, cases=CASES)
        self.assertTrue(faultline.sign_model(mine, why="a space for the test"))
        program("model", "sign", theirs, "--why", "a space for the test")
        self.assertEqual(mine.read_bytes(), theirs.read_bytes())
        self.assertFalse(faultline.sign_model(mine))


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
