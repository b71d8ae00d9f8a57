// SPDX-License-Identifier: MIT
// The reader in Python that docs/formats-native.md prints.
#include <gtest/gtest.h>

#include <cstdlib>

#include "formats/log_writer.hpp"
#include "lib/core/atomic_file.hpp"
#include "tests/support/skip_unless_installed.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

TEST(NativePythonReader, ReadsAWrittenLog) {
  SKIP_UNLESS_INSTALLED(std::system("python3 -c '' 2>/dev/null") == 0, "python3 is missing");
  const std::string page = read_file(std::string(FAULTLINE_SOURCE_DIR) + "/docs/formats-native.md");
  const std::string fence = "```python\n";
  const auto begin = page.find(fence) + fence.size(), end = page.find("```", begin);
  const TemporaryFolder folder;
  Log log;
  log.q.resize(1);
  for (int i = 0; i < 1000; ++i) {
    log.time.push_back(i / 8.0);
    log.q[0].push_back(i * 0.5);
  }
  log.extra = {{"mode", "degC", log.q[0]}};
  write_log(folder.file("log.flog"), log);
  const std::string reader = folder.write("reader.py", page.substr(begin, end - begin));
  const std::string out = folder.file("out.txt");
  ASSERT_EQ(std::system(("python3 " + reader + " " + folder.file("log.flog") + " > " + out).c_str()), 0);
  EXPECT_EQ(read_file(out), "t  1000 0.0 124.875\nq1  1000 0.0 499.5\nmode degC 1000 0.0 499.5\n");
}

}  // namespace
}  // namespace faultline
