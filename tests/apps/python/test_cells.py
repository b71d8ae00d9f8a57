# SPDX-License-Identifier: MIT
"""Results as the cells of a notebook show them: the sentence, a table, and names that are text."""
import re

import numpy

import faultline
from faultline import _html
from read_html import Read
from small_robots import make_robots, named
from support import BENCH, LOGS, InFolder, columns, load_model

LOCKED = LOGS / "locked_1.csv"
HEALTHY = LOGS / "healthy_quintic.csv"
HOSTILE = "<script>alert(1)</script>&\"'"


def hostile_log(path):
    arrays = {name: numpy.array(values) for name, values in columns(path).items()}
    return faultline.Log({**arrays, HOSTILE: arrays["t"]}, name=HOSTILE)


class Cells(InFolder):
    @classmethod
    def setUpClass(cls):
        cls.model = load_model()

    def shown(self, result):
        text = result._repr_html_()
        self.assertNotRegex(text, "<(script|link|img|iframe)|https?:")
        return Read(text)

    def test_a_diagnosis_shows_what_was_imperfect_in_the_log(self):
        good = self.model.diagnose(LOCKED)
        self.assertNotIn("What is imperfect", good._repr_html_())
        rows = columns(LOCKED)
        rows["t"][20] = rows["t"][19]
        shown = self.model.diagnose(rows)._repr_html_()
        self.assertIn("<details open><summary>What is imperfect in this log</summary>", shown)
        self.assertIn("row 21: repeats the time", shown)
        self.assertEqual(self.shown(good).rows[1][:3], ["locked", "1", f"{good.faults[0].onset_s:.3f}"])
        rows["t"] = [t + 1714557600 for t in columns(LOCKED)["t"]]
        self.assertEqual(self.shown(self.model.diagnose(rows)).rows[1][2][:7], "1714557")

    def test_what_was_learned_is_a_table_of_simulated_faults(self):
        files, frames = make_robots(self.folder)
        learned = faultline.learn(named(frames, "cell-1"), files["cell-1"], runs_per_label=2)
        shown = self.shown(learned)
        self.assertRegex(shown.bold, '^Learned "two joints" from 3 logs at 20 Hz')
        rows = learned.validation.rows
        self.assertEqual([row[0] for row in shown.rows[1:]], [row.kind.replace("_", " ") for row in rows])
        self.assertEqual([row[2] for row in shown.rows[1:]], [str(row.detected) for row in rows])

    def test_a_model_without_torque_shows_its_summary(self):
        robot = self.folder / "robot.toml"
        robot.write_text(f"name = '''<b>{HOSTILE}'''\naxes = \"R\"\n")
        t = numpy.arange(0, 60, 0.05)
        log = {"t": t, "q1": numpy.sin(t), "q_ref1": numpy.sin(t)}
        noise = numpy.random.default_rng(1).normal(0, 1e-3, (3, len(t)))
        learned = faultline.learn([dict(log, q1=log["q1"] + each) for each in noise], robot)
        self.assertIn("only whether each joint follows its reference", learned._repr_html_())
        self.assertIn("&lt;b&gt;&lt;script&gt;", learned._repr_html_())
        self.shown(learned)

    def test_an_identification_has_a_row_a_parameter(self):
        found = faultline.identify(sorted(BENCH.glob("healthy_*.csv")), BENCH / "robot.toml")
        shown = self.shown(found)
        self.assertRegex(shown.bold, "^bench: converged")
        self.assertEqual([row[0] for row in shown.rows[1:]], [one.name for one in found.base_parameters])
        for row, one in zip(shown.rows[1:], found.base_parameters):
            self.assertEqual(row[1] == "", not one.identifiable)
            self.assertEqual("not identifiable" in row[5], not one.identifiable)
            if one.identifiable:
                self.assertLessEqual(float(row[2]), float(row[1]))
                self.assertLessEqual(float(row[1]), float(row[3]))

    def test_a_comparison_has_a_row_a_signal(self):
        made = faultline.compare(HEALTHY, hostile_log(LOCKED), model=self.model)
        shown = self.shown(made)
        self.assertEqual(shown.bold, made.verdict)
        signals = [[signal.quantity, str(signal.joint)] for signal in made.signals]
        self.assertEqual([row[:2] for row in shown.rows[1:]], signals)
        judged = [row[7] != "not judged" for row in shown.rows[1:]]
        self.assertEqual(judged, [signal.judged for signal in made.signals])

    def test_an_inspection_has_a_row_a_channel(self):
        seen = faultline.inspect(hostile_log(LOCKED))
        shown = self.shown(seen)
        self.assertIn(HOSTILE, shown.bold)
        self.assertEqual([row[0] for row in shown.rows[1:]], [channel.name for channel in seen.channels])
        self.assertIn([HOSTILE], [row[1:2] for row in shown.rows])

    def test_a_batch_and_a_history_have_a_row_a_log_and_a_row_a_robot(self):
        logs = self.folder / "logs <b>"
        logs.mkdir()
        for log in (LOCKED, HEALTHY):
            (logs / f"{log.stem}<b>.csv").write_bytes(log.read_bytes())
        done = faultline.batch(logs, self.model, self.folder / "out")
        shown = self.shown(done)
        self.assertEqual(shown.bold, "2 logs: 1 healthy, 1 faulty, 0 inconclusive, 0 unusable")
        self.assertEqual(
            [(row[0], row[2], row[4]) for row in shown.rows[1:]],
            [
                ("logs <b>/healthy_quintic<b>.csv", "healthy", ""),
                ("logs <b>/locked_1<b>.csv", "faulty", "locked, joint 1"),
            ],
        )
        robots = self.shown(faultline.history(self.folder / "robots.sqlite", self.folder / "out"))
        self.assertEqual(robots.rows[1:], [["bench", "2", "1", "1", "0", "locked, joint 1"]])

    def test_a_long_table_says_how_much_more_there_is(self):
        rows = [(number, f"log {number}") for number in range(_html.MOST_ROWS + 3)]
        text = _html.table(("number", "log"), rows)
        self.assertEqual(len(Read(text).rows), 1 + _html.MOST_ROWS)
        self.assertTrue(text.endswith("<p>and 3 more rows: to_dataframe()</p>"))
        self.assertEqual(re.findall('<th style="text-align:left[^"]*">(.*?)</th>', text), ["log"])
        self.assertEqual(_html.table(("number",), []), "")
