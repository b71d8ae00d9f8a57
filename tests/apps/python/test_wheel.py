# SPDX-License-Identifier: MIT
"""The wheel is one: complete, the same each time, and it runs from where it is unpacked."""
import base64
import csv
import hashlib
import io
import os
import pathlib
import subprocess
import sys
import zipfile

import faultline
from support import ROOT, InFolder

PACKAGE = pathlib.Path(faultline.__file__).parent


class Wheel(InFolder):
    def wheel(self, name):
        script = ROOT / "apps/python/make_wheel.py"
        out = subprocess.run(
            [sys.executable, script, PACKAGE, faultline.__version__, ROOT, self.folder / name],
            capture_output=True,
            text=True,
            check=True,
        )
        return pathlib.Path(out.stdout.strip())

    def test_a_wheel_holds_what_its_record_says_and_runs(self):
        path = self.wheel("a")
        self.assertRegex(path.name, r"^faultline-[\d.]+-cp3\d+-cp3\d+-linux_\w+\.whl$")
        self.assertEqual(path.read_bytes(), self.wheel("b").read_bytes())
        with zipfile.ZipFile(path) as wheel:
            names = wheel.namelist()
            record = wheel.read(names[-1]).decode()
            rows = {row[0]: row[1:] for row in csv.reader(io.StringIO(record))}
            self.assertEqual(set(rows), set(names))
            for name in names[:-1]:
                digest = (
                    base64.urlsafe_b64encode(hashlib.sha256(wheel.read(name)).digest()).rstrip(b"=").decode()
                )
                self.assertEqual(rows[name], [f"sha256={digest}", str(wheel.getinfo(name).file_size)])
            metadata = wheel.read(f"faultline-{faultline.__version__}.dist-info/METADATA").decode()
            self.assertIn(f"\nVersion: {faultline.__version__}\n", metadata)
            wheel.extractall(self.folder / "site")
        for needed in ("__init__.py", "py.typed", "_faultline.pyi"):
            self.assertIn(f"faultline/{needed}", names)
        told = subprocess.run(
            [sys.executable, "-c", "import faultline; print(faultline.__file__, faultline.__version__)"],
            capture_output=True,
            text=True,
            check=True,
            env=dict(os.environ, PYTHONPATH=str(self.folder / "site")),
        ).stdout.split()
        self.assertEqual(told, [str(self.folder / "site/faultline/__init__.py"), faultline.__version__])
