# SPDX-License-Identifier: MIT
"""The module is there at once and alone."""
import os
import subprocess
import sys
import unittest

import faultline

MOST_SECONDS = 0.2


def python(code):
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout


def processor_seconds(code):
    """The least of several, so that a busy machine does not count."""
    measured = (
        "import resource; "
        + code
        + "; u = resource.getrusage(resource.RUSAGE_SELF); print(u.ru_utime + u.ru_stime)"
    )
    return min(float(python(measured)) for _ in range(5))


class Import(unittest.TestCase):
    def test_nothing_optional_is_imported(self):
        loaded = python(
            "import sys, faultline; print(*sorted(m.partition('.')[0] for m in sys.modules))"
        ).split()
        for name in ("numpy", "pandas", "matplotlib", "onnx"):
            self.assertNotIn(name, loaded)

    def test_a_diagnosis_of_a_file_needs_no_numpy(self):
        from support import CASES, LOGS, MODEL

        paths = [str(LOGS / "locked_1.csv"), str(MODEL), str(CASES)]
        code = (
            f"import sys, faultline; log, model, cases = {paths!r}; "
            "diagnosis = faultline.diagnose(log, model, cases=cases); "
            "print('numpy' in sys.modules, diagnosis.verdict)"
        )
        self.assertEqual(python(code).split(), ["False", "faulty"])

    def test_import_is_short(self):
        nothing = processor_seconds("pass")
        self.assertLess(processor_seconds("import faultline") - nothing, MOST_SECONDS)

    def test_the_version_is_the_projects(self):
        self.assertEqual(faultline.__version__, os.environ["FAULTLINE_VERSION"])
