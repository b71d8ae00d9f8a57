// SPDX-License-Identifier: MIT
#include "apps/exit_status.hpp"

#include <exception>
#include <new>
#include <string>

#include "apps/terminal.hpp"
#include "lib/core/error.hpp"

namespace faultline {
namespace {

int status_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::usage:
      return kUsageError;
    case ErrorCode::input:
    case ErrorCode::output:
      return kFileError;
    case ErrorCode::internal:
      return kInternalError;
  }
  return kInternalError;
}

int fail(int status, const std::string& sentence) {
  tell(sentence);
  return status;
}

}  // namespace

int guarded(const std::function<int()>& work) {
  try {
    return work();
  } catch (const Error& error) {
    return fail(status_of(error.code()), error.what());
  } catch (const std::bad_alloc&) {
    return fail(kInternalError,
                "the machine has too little free memory for this; use a shorter log, or free some memory");
  } catch (const std::exception& error) {
    return fail(kInternalError,
                std::string("internal error, please report it with the command line: ") + error.what());
  }
}

}  // namespace faultline
