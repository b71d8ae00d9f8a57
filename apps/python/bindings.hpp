// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "apps/work/file_use.hpp"
#include "formats/log_formats.hpp"
#include "lib/cases/case_base.hpp"
#include "lib/core/error.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// A model with its case base, read once for any number of logs and never changed.
struct LoadedModel {
  ModelPaths paths;  ///< files that it was read from; empty for one that was learned and not written
  Model model;
  CaseBase cases;
};
using SharedModel = std::shared_ptr<const LoadedModel>;

/// Returns the value of `all` with this name. Throws Error(usage).
template <typename Enum, std::size_t kCount>
Enum named(const char* option, const std::string& name, const std::array<Enum, kCount>& all) {
  std::vector<std::string> names;
  for (const Enum one : all) {
    if (name == to_string(one)) return one;
    names.push_back(to_string(one));
  }
  throw Error(ErrorCode::usage, option, "\"" + name + "\" is not known; expected " + either_of(names));
}

// One function per concept, each in its own file: adds its types and functions to the module.
void bind_log(pybind11::module_& module);
void bind_model(pybind11::module_& module);
void bind_networks(pybind11::module_& module);
void bind_diagnosis(pybind11::module_& module);
void bind_learn(pybind11::module_& module);
void bind_identify(pybind11::module_& module);
void bind_inspect(pybind11::module_& module);
void bind_compare(pybind11::module_& module);
void bind_convert(pybind11::module_& module);
void bind_batch(pybind11::module_& module);
void bind_golden(pybind11::module_& module);
void bind_history(pybind11::module_& module);
void bind_cases(pybind11::module_& module);
void bind_simulate(pybind11::module_& module);

}  // namespace faultline
