// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace faultline {

/// What the built program did: its two streams in full, and the exit status (128 + signal when it was
/// killed).
struct ProgramRun {
  int status = -1;
  std::string out;
  std::string err;
};

struct RunOptions {
  std::string stdout_path{};               ///< write standard output there instead of capturing it
  std::vector<std::string> environment{};  ///< NAME=value, added to the present one
  long long file_size_limit = -1;          ///< bytes a file may grow to (RLIMIT_FSIZE); -1 = no limit
  /// Bytes of address space (RLIMIT_AS); -1 = no limit. None is set under the address sanitizer.
  long long memory_limit = -1;
};

/// Runs the built program `faultline` with these arguments and waits for its end.
ProgramRun run_program(const std::vector<std::string>& arguments, const RunOptions& options = {});

/// The same of any program that the shell would find; status 127 when there is none.
ProgramRun run_command(const std::vector<std::string>& words, const RunOptions& options = {});

}  // namespace faultline
