// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

namespace faultline {

enum class ErrorCode {
  usage,     ///< the command line or an option file (robot file, spec) is wrong; exit status 2
  input,     ///< this log, model, case base or label file cannot be processed; exit status 3
  output,    ///< a result cannot be written (disk full, no permission); exit status 3
  internal,  ///< a defect of the program; exit status 4
};

/// The only exception of the project. `where` is the file, and row or key inside it ("run.csv, row 17, column
/// tau2"); `message` states what was found, what was expected and what to do.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, std::string where, const std::string& message);

  ErrorCode code() const { return code_; }
  const std::string& where() const { return where_; }
  const std::string& message() const { return message_; }

 private:
  ErrorCode code_;
  std::string where_;
  std::string message_;
};

}  // namespace faultline
