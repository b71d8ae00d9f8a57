// SPDX-License-Identifier: MIT
#include "apps/python/bindings.hpp"
#include "lib/core/error.hpp"
#include "lib/core/version.hpp"

namespace faultline {
namespace {

namespace py = pybind11;

/// Returns the name of the class in faultline.errors.
const char* class_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::usage:
      return "UsageError";
    case ErrorCode::input:
      return "InputError";
    case ErrorCode::output:
      return "OutputError";
    case ErrorCode::internal:
      return "InternalError";
  }
  return "InternalError";
}

/// Makes Python raise the classes of faultline.errors.
void bind_errors() {
  // NOLINTNEXTLINE(performance-unnecessary-value-param)
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Error& error) {
      const py::object type = py::module_::import("faultline.errors").attr(class_of(error.code()));
      PyErr_SetObject(type.ptr(), type(error.where(), error.message(), error.what()).ptr());
    }
  });
}

}  // namespace
}  // namespace faultline

/// The compiled part of the package faultline: wrappers of the functions that the program uses.
PYBIND11_MODULE(_faultline, module) {
  module.doc() = "Compiled part of faultline; use the package faultline.";
  module.attr("version") = faultline::program_version();
  faultline::bind_errors();
  using namespace faultline;
  for (const auto add_part :
       {bind_log, bind_model, bind_networks, bind_diagnosis, bind_learn, bind_identify, bind_inspect,
        bind_compare, bind_convert, bind_batch, bind_history, bind_golden, bind_cases, bind_simulate})
    add_part(module);
}
