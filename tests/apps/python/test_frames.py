# SPDX-License-Identifier: MIT
"""Columns in memory are logs as files are."""
import gc
import weakref

import numpy
import pandas

import faultline
from support import LOGS, InFolder, columns, load_model, without_origin

LOCKED = LOGS / "locked_1.csv"


class Frames(InFolder):
    @classmethod
    def setUpClass(cls):
        cls.model = load_model()
        cls.expected = without_origin(cls.model.diagnose(LOCKED))
        cls.arrays = {name: numpy.array(values) for name, values in columns(LOCKED).items()}

    def expect_same(self, log):
        diagnosis = self.model.diagnose(log)
        self.assertEqual(without_origin(diagnosis), self.expected)
        return diagnosis

    def test_a_dict_of_arrays_is_diagnosed_as_the_file(self):
        diagnosis = self.expect_same(self.arrays)
        self.assertEqual(diagnosis.log.path, "frame")
        self.assertEqual(diagnosis.log.format, "arrays")
        self.assertEqual(len(diagnosis.log.sha256), 64)
        self.assertIn("plot-run-residual", diagnosis.to_html())

    def test_a_data_frame_is_diagnosed_as_the_file(self):
        frame = pandas.read_csv(LOCKED, float_precision="round_trip")
        self.expect_same(frame)
        self.expect_same(frame.set_index("t"))
        frame["operator"] = "Weber"
        self.expect_same(frame)

    def test_contiguous_columns_are_not_copied(self):
        frame = pandas.DataFrame(self.arrays)
        for values in (self.arrays["q1"], frame["q1"].to_numpy()):
            taken = faultline._log.columns_of({"q1": values}, {}).arrays[0]
            self.assertTrue(numpy.shares_memory(taken, values))

    def test_strided_and_reversed_columns_are_read_right(self):
        table = numpy.array(list(self.arrays.values())).T.copy()
        self.assertFalse(table[:, 0].flags.c_contiguous)
        self.expect_same({name: table[:, i] for i, name in enumerate(self.arrays)})
        backwards = {name: values[::-1].copy()[::-1] for name, values in self.arrays.items()}
        self.expect_same(backwards)

    def test_other_types_of_numbers_are_converted(self):
        self.expect_same({name: values.astype(">f8") for name, values in self.arrays.items()})
        self.expect_same({name: list(values) for name, values in self.arrays.items()})
        self.expect_same({name: values.astype(object) for name, values in self.arrays.items()})
        whole = {"t": range(5), "q1": numpy.arange(5, dtype="int16"), "q2": numpy.ones(5, dtype="float32")}
        read = faultline.Log(whole).to_dict()
        self.assertEqual(read["q1"].dtype, numpy.float64)
        self.assertEqual(list(read["q1"]), [0, 1, 2, 3, 4])

    def expect_second_missing(self, values):
        read = faultline.Log({"t": [0.0, 1.0, 2.0], "q1": values}).to_dict()["q1"]
        numpy.testing.assert_array_equal(read, [1.0, numpy.nan, 3.0])

    def test_what_a_mask_covers_is_missing(self):
        mask = [False, True, False]
        for kind in ("float64", "int16", "float32", object, "U2"):
            self.expect_second_missing(numpy.ma.array([1, 99, 3], mask=mask).astype(kind))
        masked = {name: numpy.ma.array(values) for name, values in self.arrays.items()}
        self.expect_same(masked)
        taken = faultline._log.columns_of(masked, {}).arrays[1]
        self.assertTrue(numpy.shares_memory(taken, self.arrays["q1"]))
        masked["tau2"] = numpy.ma.array(self.arrays["tau2"], copy=True)
        masked["tau2"][5:9] = numpy.ma.masked
        holed = numpy.where(masked["tau2"].mask, numpy.nan, self.arrays["tau2"])
        self.assertEqual(
            without_origin(self.model.diagnose(masked)),
            without_origin(self.model.diagnose(dict(self.arrays, tau2=holed))),
        )
        dates = numpy.ma.array(["2024-05-01", "2024-05-02", "2024-05-03"], dtype="M8[s]", mask=[0, 0, 1])
        read = faultline.Log({"t": dates, "q1": [1.0, 2.0, 3.0]}).to_dict()
        self.assertEqual(list(read["q1"]), [1.0, 2.0])

    def test_values_missing_in_pandas_types_are_missing(self):
        for kind in ("Float64", "Int64", "Float32", "UInt8", "string", object):
            column = pandas.Series([1, pandas.NA, 3], dtype=kind)
            for values in (column, column.array, column.to_numpy()):
                self.expect_second_missing(values)
            read = faultline.Log(pandas.DataFrame({"t": [0.0, 1.0, 2.0], "q1": column})).to_dict()["q1"]
            numpy.testing.assert_array_equal(read, [1.0, numpy.nan, 3.0])
        frame = pandas.read_csv(LOCKED, float_precision="round_trip")
        self.expect_same(frame.convert_dtypes(convert_integer=False))

    def test_dates_and_durations_are_times(self):
        dates = pandas.to_datetime(["2024-05-01T10:00:00.25", "2024-05-01T10:00:00.50"])
        durations = pandas.to_timedelta([250, 500], unit="ms")
        for times, first in ((dates, 1714557600.25), (durations, 0.25)):
            self.assertEqual(faultline.Log({"t": times.to_numpy(), "q1": [0, 1]}).to_dict()["t"][0], first)
            indexed = pandas.DataFrame({"q1": [0.0, 1.0]}, index=times)
            self.assertEqual(faultline.Log(indexed).to_dict()["t"][0], first)

    def test_dates_with_a_zone_are_times(self):
        dates = pandas.to_datetime(["2024-05-01T10:00:00.25", "2024-05-01T10:00:00.50"])
        for zone in ("UTC", "Europe/Berlin", "Asia/Kolkata"):
            times = dates.tz_localize("UTC").tz_convert(zone)
            logs = [{"t": values, "q1": [0, 1]} for values in (times, pandas.Series(times), times.to_numpy())]
            logs.append({"t": list(times.to_pydatetime()), "q1": [0, 1]})
            logs.append(pandas.DataFrame({"t": times, "q1": [0, 1]}))
            for name in (None, "t"):
                logs.append(pandas.DataFrame({"q1": [0, 1]}, index=times.rename(name)))
            for log in logs:
                read = faultline.Log(log).to_dict()["t"]
                self.assertEqual(list(read), [1714557600.25, 1714557600.5])

    def test_columns_are_found_by_the_usual_names_and_units(self):
        named = {"timestamp": self.arrays["t"]}
        for joint in (1, 2, 3):
            named[f"actual_q_{joint}"] = self.arrays[f"q{joint}"]
            named[f"actual_qd_{joint}"] = self.arrays[f"dq{joint}"]
            named[f"torque_{joint}"] = self.arrays[f"tau{joint}"]
        self.expect_same(named)
        degrees = dict(self.arrays, t=self.arrays["t"] * 1000)
        log = faultline.Log(degrees, units={"t": "ms"})
        numpy.testing.assert_allclose(log.to_dict()["t"], self.arrays["t"], rtol=1e-15)

    def test_units_name_columns_that_are_there(self):
        frame = pandas.DataFrame({"q1": [0.0, 1.0], 7: [0.0, 1.0]}, index=pandas.Index([0.0, 1.0], name="t"))
        for units, words in [
            ({"q9": "deg"}, 'units: "q9" is not a column; there are t, q1, 7$'),
            ({"q1": 7}, 'units, q1: 7 is not a unit; give its symbol, such as "deg"'),
            (["q1"], r"units: \['q1'\] is not a dict of units by column"),
        ]:
            with self.assertRaisesRegex(faultline.UsageError, words):
                faultline.Log(frame, units=units)
        read = faultline.Log(frame, units={"t": "ms", 7: "deg"}).to_dict()
        self.assertEqual(read["t"][1], 0.001)

    def test_a_robot_file_maps_columns(self):
        robot = self.folder / "robot.toml"
        robot.write_text('axes = "R"\n[log.columns]\nq1 = {name = "shoulder", unit = "deg", sign = -1}\n')
        log = faultline.Log({"t": [0.0, 1.0, 2.0], "shoulder": [0.0, 90.0, 180.0]})
        read = log.to_dict(robot=robot)
        numpy.testing.assert_allclose(read["q1"], [0, -numpy.pi / 2, -numpy.pi])

    def test_a_file_becomes_arrays_and_a_frame_and_a_log_again(self):
        log = faultline.open_log(LOCKED)
        read = log.to_dict()
        self.assertEqual(list(read), list(self.arrays))
        for name, values in self.arrays.items():
            numpy.testing.assert_array_equal(read[name], values)
        self.expect_same(log.to_dataframe())
        self.assertEqual(log.columns, list(self.arrays))

    def test_arrays_live_as_long_as_their_log(self):
        values = numpy.array(self.arrays["q1"])
        gone = weakref.ref(values)
        log = faultline.Log(dict(self.arrays, q1=values), name="kept")
        del values
        gc.collect()
        self.assertIsNotNone(gone())
        diagnosis = self.expect_same(log)
        del log
        gc.collect()
        self.assertIn("plot-run-residual", diagnosis.to_html())
        del diagnosis
        gc.collect()
        self.assertIsNone(gone())

    def test_arrays_that_were_read_outlive_their_log(self):
        read = faultline.open_log(LOCKED).to_dict()
        gc.collect()
        numpy.testing.assert_array_equal(read["tau3"], self.arrays["tau3"])

    def test_what_is_no_log_is_refused_in_words(self):
        for value, kind, words in [
            ({"t": [0, 1], "q1": [0.0]}, faultline.InputError, "has 1 values, but the columns before it"),
            ({"q1": [0.0, 1.0]}, faultline.InputError, "time"),
            ({"t": ["a", "b"], "q1": ["c", "d"]}, faultline.InputError, "no column of numbers"),
            ({"t": numpy.zeros((2, 2))}, faultline.InputError, "has 2 dimensions"),
            ({"t": numpy.zeros(2, dtype=complex)}, faultline.InputError, "complex"),
            ({}, faultline.InputError, "has no column"),
            (17, faultline.UsageError, "int is not a log"),
        ]:
            with self.assertRaisesRegex(kind, words):
                self.model.diagnose(value)
        twice = pandas.DataFrame([[0.0, 0.0]], columns=["t", "t"])
        with self.assertRaisesRegex(faultline.InputError, "appears twice"):
            faultline.Log(twice)
