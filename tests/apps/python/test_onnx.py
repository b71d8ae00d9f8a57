# SPDX-License-Identifier: MIT
"""The exported graphs are the networks: the same numbers, described, and the same bytes each time."""
import importlib.util
import json
import os
import subprocess
import sys
import unittest

import numpy

import faultline
from random_rows import ROWS, random_inputs
from support import CASES, LOGS, MODEL, InFolder, load_model
from variants import VARIANTS, varied_model

HAS_ONNX = importlib.util.find_spec("onnx") is not None
if HAS_ONNX:
    import onnx
    import onnx_numpy

NETWORKS = ["residual_mlp", "evidence_mlp", "evidence_rbfn", "sample_mlp", "sample_rbfn"]
LARGEST_DIFFERENCE = 1e-12
"""Of the sum of magnitudes that an output is the sum of; of a probability, of itself."""
LARGEST_IN_FLOAT32 = 5e-5


@unittest.skipUnless(HAS_ONNX, "ONNX for Python is not there: apt-get install python3-onnx")
class Export(InFolder):
    @classmethod
    def setUpClass(cls):
        cls.model = load_model()
        cls.members = json.loads(MODEL.read_text())

    def expect_same(self, model, written, inputs):
        graph = onnx.load(written.path)
        given = model.network_outputs(written.network, inputs)
        computed = onnx_numpy.run(graph, inputs)
        self.assertEqual(computed.shape, given.shape)
        if given.size == 0:
            return 0.0
        complete = numpy.all([numpy.isfinite(one).all(axis=1) for one in inputs.values()], axis=0)
        self.assertTrue(numpy.isfinite(given[complete]).all())
        numpy.testing.assert_array_equal(numpy.isnan(computed), numpy.isnan(given))
        largest = onnx_numpy.magnitudes(graph, inputs)
        share = numpy.abs(computed - given)[complete] / largest[complete]
        self.assertLessEqual(share.max(initial=0.0), LARGEST_DIFFERENCE, written.network)
        return share.max(initial=0.0)

    def test_every_network_is_written_and_passes_the_checker(self):
        written = self.model.to_onnx(self.folder / "new/nets")
        self.assertEqual([one.network for one in written], NETWORKS)
        self.assertEqual(self.model.networks, NETWORKS)
        names = sorted(path.name for path in (self.folder / "new/nets").iterdir())
        self.assertEqual(names, sorted(f"{name}.onnx" for name in NETWORKS))
        for one in written:
            graph = onnx.load(one.path)
            onnx.checker.check_model(graph, full_check=True)
            self.assertEqual([(o.domain, o.version) for o in graph.opset_import], [("", 15)])
            ports = [*zip(graph.graph.input, one.inputs), (graph.graph.output[0], one.output)]
            self.assertEqual(len(graph.graph.input) + len(graph.graph.output), len(ports))
            for port, told in ports:
                self.assertEqual(port.name, told.name)
                self.assertEqual(port.type.tensor_type.elem_type, onnx.TensorProto.DOUBLE)
                batch, wide = port.type.tensor_type.shape.dim
                self.assertEqual((batch.dim_param, wide.dim_value), ("samples", len(told.columns)))
                self.assertIn(told.columns[-1], port.doc_string)
            kinds = {initializer.data_type for initializer in graph.graph.initializer}
            self.assertLessEqual(kinds, {onnx.TensorProto.DOUBLE, onnx.TensorProto.INT64})

    def test_files_say_what_goes_in_and_comes_out(self):
        for one in self.model.to_onnx(self.folder):
            graph = onnx.load(one.path)
            told = {entry.key: entry.value for entry in graph.metadata_props}
            self.assertEqual((told["network"], told["robot"]), (one.network, "bench"))
            self.assertEqual(told["model_sha256"], self.model.sha256)
            self.assertEqual(json.loads(told["inputs"]), [port.to_dict() for port in one.inputs])
            self.assertEqual(json.loads(told["output"]), one.output.to_dict())
            self.assertIn("needs more than its networks", graph.doc_string)
            part = self.members["judges" if one.network.startswith("evidence") else "samples"]
            if one.network == "residual_mlp":
                self.assertEqual(float(told["step_s"]), self.members["residual"]["shape"]["step_s"])
                self.assertEqual(one.inputs[0].units, ["rad", "rad", "m"])
                self.assertEqual(one.output.units, ["rad", "rad", "m", "rad/s", "rad/s", "m/s"])
                continue
            labels = part.get("labels") or [
                (label["fault"], label["joint"]) for label in part["classifier"]["classes"]
            ]
            classes = [f"{kind} {joint}" if joint else kind for kind, joint in labels]
            self.assertEqual(json.loads(told["classes"]), classes)
            self.assertEqual(one.output.columns, classes)

    def test_graphs_give_what_the_networks_give_for_logs_and_at_random(self):
        generator = numpy.random.default_rng(7)
        logs = sorted(LOGS.glob("*.csv"))
        self.assertGreater(len(logs), 5)
        for one in self.model.to_onnx(self.folder):
            rows, worst = 0, 0.0
            for log in logs:
                inputs = self.model.network_inputs(one.network, log)
                rows += len(next(iter(inputs.values())))
                worst = max(worst, self.expect_same(self.model, one, inputs))
            self.assertGreater(rows, 3 if one.network.startswith("evidence") else 800)
            inputs = random_inputs(one.network, one.inputs, self.members, generator)
            worst = max(worst, self.expect_same(self.model, one, inputs))
            print(f"{one.network}: {rows} rows of logs, {ROWS} at random, differ by at most {worst:.1e}")

    def test_in_float32_the_graphs_stay_near(self):
        for one in self.model.to_onnx(self.folder):
            for log in sorted(LOGS.glob("*.csv")):
                inputs = self.model.network_inputs(one.network, log)
                given = self.model.network_outputs(one.network, inputs)
                rough = onnx_numpy.run(onnx.load(one.path), inputs, numpy.float32)
                numpy.testing.assert_allclose(rough, given, rtol=0, atol=LARGEST_IN_FLOAT32)

    def test_other_kinds_of_networks_are_exported_as_well(self):
        generator = numpy.random.default_rng(8)
        for name, change in VARIANTS.items():
            with self.subTest(name):
                path, members = varied_model(self.folder / f"{name}.json", change)
                model = faultline.load_model(path, cases=CASES)
                written = model.to_onnx(self.folder / name)
                self.assertEqual([one.network for one in written], model.networks)
                for one in written:
                    inputs = random_inputs(one.network, one.inputs, members, generator)
                    self.expect_same(model, one, inputs)

    def test_a_model_that_predicts_by_physics_has_no_residual_network(self):
        def by_physics(members):
            for name in ("inputs", "outputs", "mlp"):
                del members["residual"][name]
            members["residual"]["kind"] = "physics"

        path, _ = varied_model(self.folder / "physics.json", by_physics)
        model = faultline.load_model(path, cases=CASES)
        self.assertEqual([one.network for one in model.to_onnx(self.folder / "nets")], NETWORKS[1:])
        with self.assertRaisesRegex(faultline.UsageError, "not a network of this model"):
            model.network_inputs("residual_mlp", LOGS / "locked_1.csv")

    def test_no_row_one_row_and_missing_numbers(self):
        generator = numpy.random.default_rng(9)
        for one in self.model.to_onnx(self.folder):
            inputs = random_inputs(one.network, one.inputs, self.members, generator)
            whole = self.model.network_outputs(one.network, inputs)
            for count in (0, 1, 17):
                few = {name: values[:count] for name, values in inputs.items()}
                numpy.testing.assert_array_equal(
                    self.model.network_outputs(one.network, few), whole[:count]
                )
                self.expect_same(self.model, one, few)
            for values in inputs.values():
                values[3, 0] = numpy.nan
            self.assertTrue(numpy.isnan(self.model.network_outputs(one.network, inputs)[3]).all())
            self.expect_same(self.model, one, inputs)

    def test_the_same_model_gives_the_same_bytes(self):
        first = self.model.to_onnx(self.folder / "first")
        self.model.save(self.folder / "copy.json")
        code = (
            "import sys, faultline; model = faultline.load_model(sys.argv[1]); "
            "print(*(one.sha256 for one in model.to_onnx(sys.argv[2])))"
        )
        for seed in ("1", "2"):
            told = subprocess.run(
                [sys.executable, "-c", code, self.folder / "copy.json", self.folder / seed],
                capture_output=True,
                text=True,
                check=True,
                env=dict(os.environ, PYTHONHASHSEED=seed),
            ).stdout.split()
            self.assertEqual(told, [one.sha256 for one in first])
            for one in first:
                name = os.path.basename(one.path)
                with open(one.path, "rb") as file:
                    self.assertEqual((self.folder / seed / name).read_bytes(), file.read())

class Refusals(InFolder):
    def setUp(self):
        super().setUp()
        self.model = load_model()

    def test_missing_onnx_is_told_with_its_package(self):
        code = (
            "import sys; sys.modules['onnx'] = None; import faultline\n"
            "try: faultline.load_model(sys.argv[1], cases=sys.argv[2]).to_onnx(sys.argv[3])\n"
            "except faultline.UsageError as error: print(error)"
        )
        told = subprocess.run(
            [sys.executable, "-c", code, MODEL, CASES, self.folder / "nets"],
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        self.assertRegex(told, r"^to_onnx: needs ONNX for Python .*; install it: apt-get install python3-onnx")
        self.assertFalse((self.folder / "nets").exists())

    def test_a_model_without_mechanics_has_none(self):
        log = self.folder / "steps.csv"
        rows = ["t,q1,q_ref1"]
        for k in range(3000):
            at = k % 200 if k % 200 < 100 else 200 - k % 200
            rows.append(f"{k}e-2,{at - k % 2}e-2,{at}e-2")
        log.write_text("\n".join(rows) + "\n")
        model = faultline.learn(log, "R", output=self.folder / "tracking.json", force=True).model
        self.assertFalse(model.has_mechanics)
        self.assertEqual(model.networks, [])
        with self.assertRaisesRegex(
            faultline.InputError, "tracking.json: was learned from logs without torque; such a model has no"
        ):
            model.to_onnx(self.folder / "nets")
        self.assertFalse((self.folder / "nets").exists())

    @unittest.skipUnless(HAS_ONNX, "ONNX for Python is not there: apt-get install python3-onnx")
    def test_a_folder_that_cannot_be_is_told_and_nothing_is_left(self):
        file = self.folder / "file"
        file.write_text("a file")
        for folder in (file, file / "below"):
            with self.assertRaisesRegex(
                faultline.OutputError, f"^{folder}: cannot be created as a folder for the results"
            ):
                self.model.to_onnx(folder)
        self.assertEqual(file.read_text(), "a file")
        nets = self.folder / "nets"
        (nets / "sample_rbfn.onnx").mkdir(parents=True)
        (nets / "sample_rbfn.onnx/kept").write_text("kept")
        with self.assertRaisesRegex(faultline.OutputError, "sample_rbfn.onnx: cannot be"):
            self.model.to_onnx(nets)
        self.assertEqual([path.name for path in nets.iterdir()], ["sample_rbfn.onnx"])

    @unittest.skipUnless(HAS_ONNX, "ONNX for Python is not there: apt-get install python3-onnx")
    def test_no_network_takes_the_place_of_the_model(self):
        path = self.folder / "model.json"
        path.write_bytes(MODEL.read_bytes())
        model = faultline.load_model(path, cases=CASES)
        nets = self.folder / "nets"
        nets.mkdir()
        (nets / "sample_mlp.onnx").symlink_to(path)
        with self.assertRaisesRegex(faultline.UsageError, "would overwrite the model"):
            model.to_onnx(nets)
        self.assertEqual(path.read_bytes(), MODEL.read_bytes())
