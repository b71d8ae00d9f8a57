// SPDX-License-Identifier: MIT
#include "apps/python/bindings.hpp"
#include "lib/core/version.hpp"

/// The compiled part of the package faultline: wrappers of the functions that the program uses.
PYBIND11_MODULE(_faultline, module) {
  module.doc() = "Compiled part of faultline; use the package faultline.";
  module.attr("version") = faultline::program_version();
  faultline::bind_errors(module);
  faultline::bind_log(module);
  faultline::bind_model(module);
  faultline::bind_networks(module);
  faultline::bind_diagnosis(module);
  faultline::bind_learn(module);
  faultline::bind_identify(module);
  faultline::bind_inspect(module);
  faultline::bind_batch(module);
  faultline::bind_golden(module);
  faultline::bind_cases(module);
  faultline::bind_simulate(module);
}
