// SPDX-License-Identifier: MIT
// The tests of the Python module, each file a process of Python's own unittest.
#include "tests/support/python_module.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>
#include <string>

namespace faultline {
namespace {

namespace fs = std::filesystem;

const fs::path kTests = fs::path(FAULTLINE_SOURCE_DIR) / "tests/apps/python";

class PythonModule : public testing::TestWithParam<const char*> {};

TEST_P(PythonModule, PassesItsPythonTests) {
  SKIP_UNLESS_PYTHON_MODULE();
  const std::string command = "cd '" + kTests.string() +
                              "' && PYTHONDONTWRITEBYTECODE=1 PYTHONPATH='" FAULTLINE_PYTHON_DIR
                              "' FAULTLINE_PROGRAM='" FAULTLINE_PROGRAM
                              "' FAULTLINE_VERSION='" FAULTLINE_VERSION "' '" FAULTLINE_PYTHON_PROGRAM
                              "' -m unittest -v " +
                              GetParam() + " 2>&1";
  std::FILE* const run = popen(command.c_str(), "r");
  ASSERT_NE(run, nullptr);
  std::string text;
  char part[4096];
  while (std::fgets(part, sizeof part, run) != nullptr) text += part;
  const int status = pclose(run);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << text;
  EXPECT_NE(text.find("\nRan "), std::string::npos) << text;
  EXPECT_EQ(text.find("Ran 0 tests"), std::string::npos) << text;
  if (all_packages_are_installed()) {
    EXPECT_EQ(text.find("(skipped="), std::string::npos) << text;
  }
}

INSTANTIATE_TEST_SUITE_P(Files, PythonModule,
                         testing::Values("test_cells", "test_commands", "test_diagnosis", "test_documented",
                                         "test_errors", "test_example", "test_frames", "test_import",
                                         "test_interrupt", "test_learn", "test_lerobot", "test_networks",
                                         "test_notebook", "test_onnx", "test_page", "test_pickle",
                                         "test_robots", "test_threads", "test_wheel"),
                         [](const auto& file) { return std::string(file.param).substr(5); });

}  // namespace
}  // namespace faultline
