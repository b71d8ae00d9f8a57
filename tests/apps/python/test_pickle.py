# SPDX-License-Identifier: MIT
"""What goes to other processes arrives, or says why it does not go."""
import copy
import functools
import multiprocessing
import pickle
import shutil

import faultline
from support import BENCH, CASES, LOGS, MODEL, InFolder, columns, load_model, program

LOCKED = LOGS / "locked_1.csv"


def through_pickle(thing):
    return pickle.loads(pickle.dumps(thing))


class Pickles(InFolder):
    def setUp(self):
        super().setUp()
        self.path, self.base = self.folder / "bench.json", self.folder / "mine.db"
        shutil.copy(MODEL, self.path)
        shutil.copy(CASES, self.base)
        self.model = faultline.load_model(self.path, cases=self.base)

    def test_processes_diagnose_as_this_one_does(self):
        logs = sorted(LOGS.glob("*.csv"))
        here = [self.model.diagnose(log).to_json() for log in logs]
        with multiprocessing.get_context("spawn").Pool(2) as pool:
            for work in (self.model.diagnose, functools.partial(faultline.diagnose, model=self.model)):
                there = pool.map_async(work, logs).get(timeout=120)
                self.assertEqual([diagnosis.to_json() for diagnosis in there], here)

    def test_a_pickled_model_is_its_files(self):
        again = through_pickle(through_pickle(self.model))
        self.assertEqual((again.path, again.cases), (str(self.path), str(self.base)))
        self.assertEqual(again.to_json(), self.model.to_json())
        self.assertEqual(again.diagnose(LOCKED).to_json(), self.model.diagnose(LOCKED).to_json())

    def test_a_model_whose_files_changed_is_refused_in_the_process_not_with_it(self):
        case = faultline.cases.list(self.model)[0]
        sent = pickle.dumps(self.model)
        faultline.cases.confirm(case.id, self.model, done="changed the brake relay")
        with multiprocessing.get_context("spawn").Pool(1) as pool:
            with self.assertRaisesRegex(
                faultline.InputError, "mine.db: was changed since the pickled model was"
            ):
                pool.map_async(pickle.loads(sent).diagnose, [LOCKED]).get(timeout=120)
        self.model.reload()
        sent = pickle.dumps(self.model)
        pickle.loads(sent).diagnose(LOCKED)
        self.path.write_text(self.path.read_text() + "\n")
        program("model", "sign", self.path, "--why", "another text")
        with self.assertRaisesRegex(faultline.InputError, "bench.json: was changed since the pickled model was read"):
            pickle.loads(sent).diagnose(LOCKED)
        again = pickle.loads(sent)
        shutil.copy(MODEL, self.path)
        shutil.copy(CASES, self.base)
        again.reload()
        self.assertEqual(again.diagnose(LOCKED).verdict, "faulty")
        self.path.unlink()
        with self.assertRaisesRegex(faultline.InputError, "bench.json: "):
            pickle.loads(sent).path

    def test_a_diagnosis_keeps_what_needs_no_log(self):
        made = self.model.diagnose(LOCKED)
        kept = through_pickle(through_pickle(made))
        self.assertIsInstance(kept, faultline.Diagnosis)
        self.assertEqual(kept, made)
        self.assertIsInstance(kept.faults[0], faultline.Fault)
        self.assertEqual((kept.faults[0].kind, kept.sentence), ("locked", made.sentence))
        for part in ("to_json", "to_dict", "text", "to_csv", "to_markdown", "to_junit", "_repr_html_"):
            self.assertEqual(getattr(kept, part)(), getattr(made, part)(), part)
        self.assertTrue(kept.to_dataframe().equals(made.to_dataframe()))
        for refused, words in [
            (kept.to_html, "to_html: a pickle holds neither the log nor the model; make the page where"),
            (kept.curves, "curves: a pickle holds neither the log nor the model; take them where"),
            (lambda: kept.text(width=100), "text: of a pickled diagnosis"),
        ]:
            with self.assertRaisesRegex(faultline.UsageError, words):
                refused()
        case = faultline.cases.add(kept, self.model, fault="locked", joint=1, date="2026-01-02")
        self.assertEqual((case.label.kind, case.label.joint), ("locked", 1))

    def test_what_cannot_be_pickled_says_so(self):
        for thing, words in [
            (faultline.inspect(LOCKED), "Inspection: cannot be pickled; send its to_json"),
            (faultline.Log(columns(LOCKED)), "Log: of columns in memory cannot be pickled; send the columns"),
        ]:
            with self.assertRaisesRegex(faultline.UsageError, words):
                pickle.dumps(thing)
        log = through_pickle(faultline.Log(BENCH / "locked_1.csv", run=1))
        self.assertEqual(log.name, str(BENCH / "locked_1.csv"))

    def test_copies_need_no_pickle(self):
        made = self.model.diagnose(columns(LOCKED))
        for copied in (copy.copy(made), copy.deepcopy([made])[0]):
            self.assertEqual(copied.to_html(), made.to_html())
        self.path.unlink()
        for copied in (copy.copy(self.model), copy.deepcopy(self.model)):
            self.assertEqual(copied.to_json(), self.model.to_json())


class Reloading(InFolder):
    def test_cases_that_were_added_are_seen_after_reload(self):
        base = self.folder / "cases.db"
        shutil.copy(CASES, base)
        model = faultline.load_model(MODEL, cases=base)
        diagnosis = model.diagnose(LOCKED)
        faultline.cases.add(diagnosis, model, fault="locked", joint=1, done="changed the brake relay")

        def done():
            return [p.what_was_done for p in model.diagnose(LOCKED).faults[0].precedents]

        self.assertNotIn("changed the brake relay", done())
        model.reload()
        self.assertIn("changed the brake relay", done())
        self.assertEqual(load_model().name, model.name)
