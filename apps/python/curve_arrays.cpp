// SPDX-License-Identifier: MIT
#include "apps/python/curve_arrays.hpp"

#include <pybind11/stl.h>

#include <string>

#include "apps/python/owned_array.hpp"
#include "lib/fault/label_text.hpp"

namespace faultline {
namespace {

namespace py = pybind11;

py::array_t<double> times(const CurveWindow& window, std::size_t count) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = window.time_s(i, count);
  return owned_array(std::move(values));
}

void put(py::dict& signals, const std::string& name, const std::vector<float>& values) {
  if (!values.empty()) signals[name.c_str()] = owned_array(std::vector<double>(values.begin(), values.end()));
}

py::dict window_arrays(const CurveWindow& window) {
  py::dict out;
  out["fault_id"] = window.fault_id;
  out["start_s"] = window.start_s;
  out["end_s"] = window.end_s;
  const auto bins = static_cast<std::size_t>(window.bins);
  out["t"] = times(window, 2 * bins);
  out["t_residual"] = times(window, bins);
  for (std::size_t j = 0; j < window.joints.size(); ++j) {
    const JointCurves& joint = window.joints[j];
    const std::string number = std::to_string(j + 1);
    put(out, "q" + number, joint.q.values);
    put(out, "q" + number + "_predicted", joint.q_predicted.values);
    put(out, "dq" + number, joint.dq.values);
    put(out, "dq" + number + "_predicted", joint.dq_predicted.values);
    put(out, "tau" + number, joint.tau.values);
    put(out, "tau" + number + "_required", joint.tau_required.values);
    put(out, "residual" + number, joint.residual);
  }
  for (const NetworkCurves& network : window.networks) {
    put(out, "mlp " + label_text(network.label), network.mlp.values);
    put(out, "rbfn " + label_text(network.label), network.rbfn.values);
  }
  return out;
}

}  // namespace

py::dict curve_arrays(const RunCurves& curves) {
  py::dict out;
  out["whole"] = curves.empty() ? py::dict() : window_arrays(curves.whole);
  py::list faults;
  for (const CurveWindow& window : curves.details) faults.append(window_arrays(window));
  out["faults"] = faults;
  out["healthy_residual"] = curves.healthy_residual;
  out["by_reference"] = curves.by_reference;
  out["alarm_ratio"] = curves.alarm_ratio;
  return out;
}

}  // namespace faultline
