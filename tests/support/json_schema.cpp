// SPDX-License-Identifier: MIT
#include "tests/support/json_schema.hpp"

#include <sys/wait.h>

#include <cstdlib>
#include <sstream>

#include "lib/core/atomic_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

constexpr int kCannotJudge = 77;

std::string quoted(const std::string& text) { return " '" + text + "'"; }

}  // namespace

SchemaVerdict judge_by_schema(const std::vector<SchemaAndDocument>& documents) {
  const TemporaryFolder folder;
  const std::string root = FAULTLINE_SOURCE_DIR, out = folder.file("out.txt");
  std::string command = "PATH=/usr/bin:$PATH python3" + quoted(root + "/tests/support/check_schema.py") +
                        quoted(root + "/docs/schemas");
  for (const auto& [name, file] : documents) command += quoted(name + "=" + file);
  const int status = std::system((command + " >" + quoted(out) + " 2>&1").c_str());
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 1;
  SchemaVerdict verdict{code != kCannotJudge, code == 0, "", {}};
  std::istringstream lines(read_file(out));
  for (std::string line; std::getline(lines, line);)
    if (line.rfind("open ", 0) == 0)
      verdict.is_open.push_back(line.substr(5));
    else
      verdict.text += line + "\n";
  return verdict;
}

}  // namespace faultline
