// SPDX-License-Identifier: MIT
#include "apps/python/bindings.hpp"
#include "lib/core/error.hpp"

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

}  // namespace

void bind_errors(py::module_&) {
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

}  // namespace faultline
