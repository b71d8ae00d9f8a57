// SPDX-License-Identifier: MIT
// apps/quickstart.sh and tests/run.sh in either order, on a machine where the first has not installed yet
// what the second needs.
#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "lib/core/atomic_file.hpp"
#include "tests/support/python_module.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/skip_unless_installed.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

constexpr const char* kInstalled = "FAULTLINE_PACKAGES_INSTALLED";

void fail_without_a_package() {
  const bool was_set = std::getenv(kInstalled) != nullptr;
  ::setenv(kInstalled, "1", 1);
  [] { SKIP_UNLESS_INSTALLED(false, "Chromium is missing"); }();
  if (!was_set) ::unsetenv(kInstalled);
}

TEST(InstallAndRunScripts, AMissingPackageFailsTheTestsThatRunShStarts) {
  EXPECT_FATAL_FAILURE(fail_without_a_package(),
                       "Chromium is missing; tests/run.sh should have installed that");
}

TEST(InstallAndRunScripts, RunShInstallsThePackagesAndExportsThatBeforeItStartsTheTests) {
  const std::string script = read_file(FAULTLINE_SOURCE_DIR "/tests/run.sh");
  const std::size_t install = script.find("\nbash apps/install.sh --tests\n"),
                    known = script.find(std::string("export ") + kInstalled + "=1\n"),
                    tests = script.find("\nctest ");
  ASSERT_NE(tests, std::string::npos);
  EXPECT_LT(install, known);
  EXPECT_LT(known, tests);
}

TEST(InstallAndRunScripts, AnEarlierBuildFolderBuildsThePythonModuleAfterTheInstallation) {
  SKIP_UNLESS_PYTHON_MODULE();
  const TemporaryFolder folder;
  const auto configure = [&](const std::string& option) {
    return run_command({"sh", "-c",
                        "cd '" FAULTLINE_SOURCE_DIR "' && cmake --preset release -B '" +
                            folder.file("build") + "' -DFAULTLINE_TESTS=OFF " + option});
  };
  const ProgramRun before = configure("-DCMAKE_DISABLE_FIND_PACKAGE_pybind11=ON");
  EXPECT_EQ(before.status, 0) << before.err;
  EXPECT_NE(before.out.find("Python module: not built"), std::string::npos) << before.out;
  const ProgramRun after = configure("-DCMAKE_DISABLE_FIND_PACKAGE_pybind11=OFF");
  EXPECT_EQ(after.status, 0) << after.err;
  EXPECT_NE(after.out.find("Python module: built for"), std::string::npos) << after.out;
}

}  // namespace
}  // namespace faultline
