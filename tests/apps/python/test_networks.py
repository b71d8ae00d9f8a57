# SPDX-License-Identifier: MIT
"""The networks on arrays are those that the diagnosis asks."""
import json

import numpy

import faultline
from support import CASES, LOGS, MODEL, InFolder, columns, load_model
from variants import varied_model


class Networks(InFolder):
    @classmethod
    def setUpClass(cls):
        cls.model = load_model()
        cls.members = json.loads(MODEL.read_text())

    def test_the_evidence_networks_have_the_opinions_of_the_diagnosis(self):
        labels = self.members["judges"]["labels"]
        seen = 0
        for log in sorted(LOGS.glob("*.csv")):
            faults = [fault for fault in self.model.diagnose(log).faults if "mlp" in fault.opinions]
            inputs = self.model.network_inputs("evidence_mlp", log)
            outputs = [self.model.network_outputs(f"evidence_{kind}", inputs) for kind in ("mlp", "rbfn")]
            said = []
            for pair in zip(*outputs):
                shares = [numpy.maximum(row, 0) / numpy.maximum(row, 0).sum() for row in pair]
                said.append([(*labels[share.argmax()], share.max()) for share in shares])
            for fault in faults:
                theirs = [fault.opinions.mlp, fault.opinions.rbfn]
                named = [(one.kind, one.joint) for one in theirs]
                mine = [two for two in said if [one[:2] for one in two] == named]
                self.assertTrue(mine, (log.name, named, said))
                for ours, one in zip(mine[0], theirs):
                    self.assertAlmostEqual(ours[2], one.confidence, delta=1e-14)
                seen += 1
        self.assertGreater(seen, 3)

    def test_the_residual_network_has_the_residuals_of_the_diagnosis(self):
        step_s = self.members["residual"]["shape"]["step_s"]
        log = {name: numpy.array(values) for name, values in columns(LOGS / "torque_loss_2.csv").items()}
        channels = {
            name: numpy.stack([log[f"{name}{joint}"] for joint in (1, 2, 3)], axis=1)[:-1]
            for name in ("q", "dq", "tau")
        }
        inputs = self.model.network_inputs("residual_mlp", LOGS / "torque_loss_2.csv")
        for name, values in channels.items():
            numpy.testing.assert_array_equal(inputs[name], values)
        change = self.model.network_outputs("residual_mlp", inputs)[:, 3:]
        change = change * (numpy.diff(log["t"]) / step_s)[:, None]
        measured = numpy.diff(numpy.stack([log[f"dq{joint}"] for joint in (1, 2, 3)], axis=1), axis=0)
        rms = numpy.sqrt(((measured - change) ** 2).mean(axis=0))
        diagnosis = self.model.diagnose(LOGS / "torque_loss_2.csv", classify="samples")
        theirs = [joint.velocity_rms for joint in diagnosis.residuals]
        healthy = self.members["residual"]["healthy"]["velocity_rms"]
        numpy.testing.assert_allclose(rms / healthy, theirs, rtol=1e-10)

    def test_a_model_of_other_features_is_refused(self):
        def with_one_less(members):
            judges = members["judges"]
            first = judges["mlp"]["layers"][0]
            first["weights"] = [row[:-1] for row in first["weights"]]
            for values in (*judges["scaler"].values(), judges["rbfn"]["centres"], judges["rbfn"]["inverse_radii"]):
                del values[-1]

        path, _ = varied_model(self.folder / "less.json", with_one_less)
        model = faultline.load_model(path, cases=CASES)
        collected = len(self.members["judges"]["mlp"]["layers"][0]["weights"][0])
        for use in (lambda: model.networks, lambda: model.to_onnx(self.folder / "nets")):
            with self.assertRaisesRegex(
                faultline.InputError, f"take {collected - 1} features, but this program collects {collected}"
            ):
                use()
        self.assertFalse((self.folder / "nets").exists())

    def test_inputs_that_do_not_fit_are_told(self):
        three = numpy.zeros((5, 3))
        for network, inputs, words in [
            ("mlp", {}, '"mlp" is not a network of this model; its networks are: residual_mlp, evidence_mlp'),
            ("sample_mlp", {"torque": three}, "takes torque_residual, torque, but was given torque"),
            ("sample_mlp", {"torque": three, "torque_residual": three[:, :2]}, "not a matrix of 3 columns"),
            ("sample_mlp", {"torque": three, "torque_residual": three[0]}, "not a matrix of 3 columns"),
            ("sample_mlp", {"torque": three, "torque_residual": three[:4]}, "the same number of rows"),
            ("sample_mlp", {"torque": three, "torque_residual": "x"}, "is not a matrix of numbers"),
        ]:
            with self.assertRaisesRegex(faultline.UsageError, words):
                self.model.network_outputs(network, inputs)
        with self.assertRaisesRegex(faultline.InputError, "missing.csv"):
            self.model.network_inputs("sample_mlp", self.folder / "missing.csv")
