# SPDX-License-Identifier: MIT
"""Diagnoses are those of the program, byte for byte."""
import pickle

import faultline
from support import CASES, LOGS, MODEL, InFolder, columns, load_model, program


class Reports(InFolder):
    @classmethod
    def setUpClass(cls):
        cls.model = load_model()

    def by_program(self, log, *options):
        return program("diagnose", log, "--model", MODEL, "--cases", CASES, *options)

    def test_every_golden_log_gives_the_bytes_of_the_program(self):
        logs = sorted(LOGS.glob("*.csv"))
        self.assertGreater(len(logs), 4)
        verdicts = set()
        for log in logs:
            diagnosis = self.model.diagnose(log)
            self.assertEqual(diagnosis.to_json().encode(), self.by_program(log, "--json", "-"), log)
            verdicts.add(diagnosis.verdict)
        self.assertEqual(verdicts, {"healthy", "faulty"})

    def test_every_report_format_gives_the_bytes_of_the_program(self):
        log = LOGS / "locked_1.csv"
        diagnosis = self.model.diagnose(log)
        for option, text in [
            ("--html", diagnosis.to_html()),
            ("--csv", diagnosis.to_csv()),
            ("--md", diagnosis.to_markdown()),
            ("--junit", diagnosis.to_junit()),
        ]:
            self.assertEqual(text.encode(), self.by_program(log, option, "-"), option)
        self.assertEqual(diagnosis.text().encode(), self.by_program(log))

    def test_the_papers_way_gives_the_bytes_of_the_program(self):
        log = LOGS / "locked_1.csv"
        diagnosis = self.model.diagnose(log, classify="samples", criterion="consecutive", g=3)
        options = ("--classify", "samples", "--criterion", "consecutive", "--g", "3", "--json", "-")
        self.assertEqual(diagnosis.to_json().encode(), self.by_program(log, *options))

    def test_a_recording_has_the_bytes_of_the_programs(self):
        log, mine, theirs = LOGS / "locked_1.csv", self.folder / "mine.mcap", self.folder / "theirs.mcap"
        self.model.diagnose(log, mcap=mine)
        self.by_program(log, "--mcap", theirs)
        self.assertEqual(mine.read_bytes(), theirs.read_bytes())
        with self.assertRaisesRegex(faultline.UsageError, "locked_1.csv"):
            self.model.diagnose(log, mcap=log)

    def test_a_stop_is_answered_as_the_program_does(self):
        log = LOGS / "locked_1.csv"
        asked = self.model.diagnose(log, at=9)
        self.assertEqual(asked.to_json().encode(), self.by_program(log, "--at", "9", "--json", "-"))
        self.assertEqual(asked.stop.time_s, 9)
        frame = columns(log)
        frame["estop"] = [float(t >= 9) for t in frame["t"]]
        self.assertAlmostEqual(self.model.diagnose(frame, stop="estop").stop.time_s, 9, delta=0.1)
        with self.assertRaisesRegex(faultline.UsageError, "no moment"):
            self.model.diagnose(log, at="noon")

    def test_a_notebook_shows_the_verdict_and_a_table_of_faults(self):
        faulty = self.model.diagnose(LOGS / "locked_1.csv")
        shown = faulty._repr_html_()
        self.assertEqual(shown.count("<tr>"), 1 + len(faulty.faults))
        self.assertRegex(shown, "<td[^>]*>locked</td><td>1</td>")
        self.assertNotIn("<table", self.model.diagnose(LOGS / "healthy_quintic.csv")._repr_html_())

    def test_names_in_a_notebook_are_text(self):
        frame = faultline.Log(columns(LOGS / "locked_1.csv"), name="<script>alert(1)</script>")
        self.assertNotIn("<script>", self.model.diagnose(frame)._repr_html_())

    def test_a_plot_has_an_axis_for_each_joint_and_marks_the_fault(self):
        try:
            import matplotlib  # noqa: F401
        except ImportError:
            self.skipTest("needs python3-matplotlib")
        diagnosis = self.model.diagnose(LOGS / "locked_1.csv")
        figure = diagnosis.plot()
        axes = figure.get_axes()
        self.assertEqual([axis.get_ylabel() for axis in axes], ["joint 1", "joint 2", "joint 3"])
        marked = [line.get_xdata()[0] for line in axes[0].get_lines() if line.get_label() == "locked"]
        self.assertEqual(marked, [diagnosis.faults[0].onset_s])
        self.assertFalse([line for line in axes[1].get_lines() if line.get_label() == "locked"])
        self.assertEqual(figure._repr_png_()[:4], b"\x89PNG")

    def test_attributes_have_the_names_of_the_json(self):
        diagnosis = faultline.diagnose(LOGS / "locked_1.csv", MODEL, cases=CASES)
        self.assertEqual(diagnosis.verdict, "faulty")
        fault = diagnosis.faults[0]
        self.assertIsInstance(fault, faultline.Fault)
        self.assertEqual((fault.kind, fault.joint), ("locked", 1))
        self.assertEqual(fault.onset_s, diagnosis.to_dict()["faults"][0]["onset_s"])
        self.assertEqual(diagnosis["log"].rows, len(columns(LOGS / "locked_1.csv")["t"]))
        self.assertIn("locked", diagnosis.sentence)
        with self.assertRaisesRegex(AttributeError, "has no colour; there are .*verdict"):
            diagnosis.colour

    def test_the_dict_is_a_copy(self):
        diagnosis = self.model.diagnose(LOGS / "locked_1.csv")
        diagnosis.to_dict()["faults"].clear()
        self.assertEqual(len(diagnosis.faults), 1)

    def test_faults_become_a_frame(self):
        frame = self.model.diagnose(LOGS / "locked_1.csv").to_dataframe()
        self.assertEqual(list(frame["kind"]), ["locked"])
        self.assertIn("onset_s", frame.columns)

    def test_curves_show_the_fault(self):
        diagnosis = self.model.diagnose(LOGS / "locked_1.csv")
        curves = diagnosis.curves(bins=50)
        whole = curves.whole
        self.assertEqual(len(whole["t_residual"]), len(whole["residual1"]))
        self.assertLessEqual(len(whole["t_residual"]), 50)
        self.assertEqual(len(whole["t"]), len(whole["q1"]))
        onset = diagnosis.faults[0].onset_s
        after = whole["residual1"][whole["t_residual"] > onset].max()
        before = whole["residual1"][whole["t_residual"] < onset - 1].max()
        self.assertGreater(after, 3 * before)
        self.assertEqual([part["fault_id"] for part in curves.faults], [1])
        self.assertEqual(list(curves.to_dataframe().columns), ["t", "residual1", "residual2", "residual3"])

    def test_a_log_that_changed_since_gives_no_page(self):
        log = self.folder / "run.csv"
        log.write_bytes((LOGS / "locked_1.csv").read_bytes())
        diagnosis = self.model.diagnose(log)
        log.write_bytes((LOGS / "healthy_quintic.csv").read_bytes())
        with self.assertRaisesRegex(faultline.InputError, "was changed since it was diagnosed"):
            diagnosis.to_html()

    def test_a_saved_model_is_the_same_model(self):
        path = self.folder / "copy.json"
        self.model.save(path)
        self.assertEqual(path.read_bytes(), MODEL.read_bytes())
        again = faultline.load_model(path).diagnose(LOGS / "locked_1.csv")
        mine, theirs = again.to_dict(), self.model.diagnose(LOGS / "locked_1.csv").to_dict()
        self.assertEqual(mine["faults"], theirs["faults"])
        self.assertEqual(mine["model"]["cases_sha256"], theirs["model"]["cases_sha256"])

    def test_records_can_be_pickled(self):
        fault = self.model.diagnose(LOGS / "locked_1.csv").faults[0]
        self.assertEqual(pickle.loads(pickle.dumps(fault)), fault)
