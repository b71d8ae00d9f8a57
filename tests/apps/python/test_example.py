# SPDX-License-Identifier: MIT
"""The example and the page do what they say."""
import importlib.util
import re
import subprocess
import sys

from support import BENCH, CASES, LOGS, MODEL, ROOT, InFolder

EXAMPLE = ROOT / "apps/python/examples/residuals.py"
PNG = b"\x89PNG\r\n\x1a\n"


class Example(InFolder):
    def test_the_example_finds_the_fault_and_draws_it(self):
        picture = self.folder / "residuals.png"
        run = subprocess.run(
            [sys.executable, EXAMPLE, LOGS / "locked_1.csv", MODEL, CASES, picture],
            capture_output=True,
            text=True,
            env=None,
        )
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("joint 1 is locked", run.stdout)
        if importlib.util.find_spec("matplotlib") is None:
            self.skipTest("the picture needs python3-matplotlib; the rest of the example ran")
        self.assertEqual(picture.read_bytes()[:8], PNG)
        self.assertGreater(picture.stat().st_size, 20_000)

    def test_the_ten_lines_of_the_page_run(self):
        page = (ROOT / "docs/python.md").read_text()
        code = re.search(r"```python\n(.*?)```", page, re.S).group(1)
        self.assertIn('output="bench.json")', code)
        code = code.replace('output="bench.json")', 'output="bench.json", runs_per_label=2)')  # saves some time
        for name in BENCH.iterdir():
            (self.folder / name.name).write_bytes(name.read_bytes())
        run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=self.folder)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("locked", run.stdout)
