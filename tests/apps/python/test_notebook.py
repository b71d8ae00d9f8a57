# SPDX-License-Identifier: MIT
"""The notebook is stored without outputs, runs from top to bottom, and finds the faults that it simulates."""
import ast
import base64
import importlib.util
import json
import os
import pathlib
import re
import struct
import tempfile
import unittest
import unittest.mock

from read_html import Read
from support import ROOT

NOTEBOOK = ROOT / "apps/python/examples/first_diagnosis.ipynb"
NEEDED = ("nbformat", "nbclient", "ipykernel", "matplotlib", "pandas")
MISSING = [name for name in NEEDED if importlib.util.find_spec(name) is None]
LONGEST_CODE, LONGEST_TEXT = 110, 125
SECONDS_A_CELL = 120
LARGEST_ERROR_S = 0.1
"""Of an onset."""
LEAST_FIGURE, LARGEST_FIGURE = 250, 1000
"""Pixels, width and height."""
FAULT = re.compile(r'\{kind = "(\w+)", joint = (\d), onset_s = ([\d.]+)')


def stored():
    return json.loads(NOTEBOOK.read_text("utf-8"))


def source(cell):
    return "".join(cell["source"])


class Stored(unittest.TestCase):
    def test_no_cell_has_outputs_or_was_counted(self):
        cells = [cell for cell in stored()["cells"] if cell["cell_type"] == "code"]
        self.assertGreater(len(cells), 10)
        for cell in cells:
            self.assertEqual((cell["outputs"], cell["execution_count"]), ([], None), cell["id"])
            self.assertEqual(cell["metadata"], {})
        self.assertEqual(sorted(stored()["metadata"]), ["kernelspec", "language_info"])

    def test_the_first_line_names_the_licence(self):
        first = source(stored()["cells"][0])
        self.assertRegex(first, "^<!-- SPDX-License-Identifier: MIT -->\n# A first diagnosis\n")

    def test_no_line_is_long_and_none_names_a_machine(self):
        for cell in stored()["cells"]:
            longest = LONGEST_CODE if cell["cell_type"] == "code" else LONGEST_TEXT
            for line in source(cell).splitlines():
                self.assertLessEqual(len(line), longest, line)
                self.assertNotRegex(line, r"(?:^|[\s\"'(])/(?:home|root|tmp|usr|work|Users|mnt)\b|[A-Z]:\\")
                self.assertEqual(line, line.rstrip())

    def test_every_cell_of_code_is_plain_python(self):
        for cell in stored()["cells"]:
            self.assertTrue(source(cell).strip(), cell["id"])
            if cell["cell_type"] == "code":
                ast.parse(source(cell))

    def test_headings_are_numbered_and_links_lead_to_files(self):
        text = "\n".join(source(cell) for cell in stored()["cells"] if cell["cell_type"] == "markdown")
        numbers = [int(number) for number in re.findall(r"^## (\d+)\. ", text, re.M)]
        self.assertEqual(numbers, list(range(1, len(numbers) + 1)))
        links = re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", text)
        self.assertGreater(len(links), 3)
        for link in links:
            self.assertTrue((NOTEBOOK.parent / link).is_file(), link)

    @unittest.skipIf("nbformat" in MISSING, "needs python3-nbformat")
    def test_it_is_valid_and_written_as_jupyter_writes_it(self):
        import nbformat

        notebook = nbformat.read(NOTEBOOK, as_version=4)
        nbformat.validate(notebook)
        ids = [cell["id"] for cell in notebook.cells]
        self.assertEqual(len(set(ids)), len(ids))
        self.assertEqual(NOTEBOOK.read_text("utf-8"), nbformat.writes(notebook) + "\n")


def executed(folder):
    """The notebook with its outputs. What Jupyter, IPython and matplotlib keep is below the folder."""
    import nbclient
    import nbformat
    from traitlets.config import Config

    work = folder / "work"
    work.mkdir()
    places = "HOME IPYTHONDIR JUPYTER_RUNTIME_DIR JUPYTER_DATA_DIR MPLCONFIGDIR TMPDIR".split()
    settings = {**dict.fromkeys(places, str(folder)), "PYTHONDONTWRITEBYTECODE": "1"}
    settings["PYDEVD_DISABLE_FILE_VALIDATION"] = "1"  # else its debugger warns
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    client = nbclient.NotebookClient(
        notebook,
        timeout=SECONDS_A_CELL,
        kernel_name="python3",
        resources={"metadata": {"path": str(work)}},
        config=Config({"KernelManager": {"transport": "ipc", "ip": str(folder / "socket")}}),  # takes no port
    )
    with unittest.mock.patch.dict(os.environ, settings):
        client.execute()  # raises where a cell fails
    return notebook


def files_below(folder):
    return {path: path.stat().st_mtime_ns for path in folder.rglob("*")}


@unittest.skipIf(MISSING, f"not there: {', '.join(MISSING)}; bash apps/install.sh --tests installs them")
class Executed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.before = files_below(NOTEBOOK.parent)
        cls.notebook = executed(cls.folder)
        cls.outputs = {cell["id"]: cell.get("outputs", []) for cell in cls.notebook.cells}

    def data(self, cell, kind):
        found = [output["data"][kind] for output in self.outputs[cell] if kind in output.get("data", {})]
        self.assertEqual(len(found), 1, f"{kind} of {cell}")
        return found[0]

    def test_all_cells_of_code_ran_once_in_their_order(self):
        counts = [cell["execution_count"] for cell in self.notebook.cells if cell["cell_type"] == "code"]
        self.assertEqual(counts, list(range(1, len(counts) + 1)))

    def test_nothing_is_written_to_the_checkout_or_left_in_the_folder_of_the_notebook(self):
        self.assertEqual(files_below(NOTEBOOK.parent), self.before)
        self.assertEqual(list((self.folder / "work").iterdir()), [])

    def test_no_cell_wrote_a_warning(self):
        for name, outputs in self.outputs.items():
            self.assertEqual([o["text"] for o in outputs if o.get("name") == "stderr"], [], name)

    def expect_fault(self, cell, spec):
        """The cell shows the one fault that the cell `spec` simulates."""
        (kind, joint, onset_s), = FAULT.findall(next(source(c) for c in stored()["cells"] if c["id"] == spec))
        read = Read(self.data(cell, "text/html"))
        self.assertRegex(read.bold, "^1 fault: ")
        (_, row) = read.rows
        self.assertEqual(row[:2], [kind.replace("_", " "), joint])
        self.assertAlmostEqual(float(row[2]), float(onset_s), delta=LARGEST_ERROR_S)

    def test_the_faults_that_were_simulated_are_found(self):
        self.expect_fault("diagnosis", "simulate")
        self.expect_fault("try", "try")
        self.assertIn("joint 2 lost a part of its torque", self.data("units", "text/plain"))
        self.assertRegex(Read(self.data("good", "text/html")).bold, "^No fault found")
        compared = Read(self.data("comparison", "text/html"))
        self.assertRegex(compared.bold, r"^The runs differ from 8\.\d+ s on")
        self.assertIn("torque_loss", self.data("truth", "text/html"))
        learned = Read(self.data("learned", "text/html"))
        self.assertRegex(learned.bold, '^Learned "bench" from 3 logs')
        self.assertEqual(len(learned.rows), 11)

    def test_every_plot_is_a_figure_of_a_size_that_fits_the_page(self):
        for cell in ("positions", "plot", "curves"):
            picture = base64.b64decode(self.data(cell, "image/png"))
            self.assertEqual(picture[:8], b"\x89PNG\r\n\x1a\n", cell)
            for side in struct.unpack(">II", picture[16:24]):
                self.assertTrue(LEAST_FIGURE <= side <= LARGEST_FIGURE, f"{cell}: {side} pixels")
            self.assertGreater(len(picture), 10_000, cell)

    def test_progress_is_one_line(self):
        text = "".join(output.get("text", "") for output in self.outputs["learned"])
        self.assertNotIn("\n", text.strip())
        shares = [int(share) for share in re.findall(r"(\d+)% \w", text)]
        self.assertGreater(len(shares), 2)
        self.assertGreater(shares[-1], shares[0])


if __name__ == "__main__":
    unittest.main()
