// SPDX-License-Identifier: MIT
// Where the dynamic loader looks for the libraries of what is built: never in the folder where a user happens
// to be, which holds files of other people.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/dynamic_section.hpp"
#include "tests/support/python_module.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kNone;

TEST(LibrarySearch, TheProgramAndItsTestsHaveNoRelativeFolderInTheirRunPath) {
  EXPECT_EQ(relative_search_folders(FAULTLINE_PROGRAM), kNone);
  EXPECT_EQ(relative_search_folders(fs::read_symlink("/proc/self/exe").string()), kNone);
}

TEST(LibrarySearch, ThePythonModuleHasNoRelativeFolderInItsRunPath) {
  SKIP_UNLESS_PYTHON_MODULE();
  EXPECT_EQ(relative_search_folders(compiled_python_module()), kNone);
}

/// A library that is no library ends every program that loads it.
TEST(LibrarySearch, TheProgramLoadsNoLibraryFromTheCurrentFolder) {
  const TemporaryFolder folder;
  const std::vector<std::string> libraries = dynamic_section(FAULTLINE_PROGRAM).libraries;
  EXPECT_GT(libraries.size(), 10u);
  for (const std::string& library : libraries) folder.write(library, "planted by somebody else");
  const std::string command = "cd '" + folder.path().string() + "' && '" FAULTLINE_PROGRAM "' --version";
  const ProgramRun run = run_command({"sh", "-c", command});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.out, "faultline " FAULTLINE_VERSION "\n");
}

TEST(LibrarySearch, TheCheckFindsEmptyAndRelativePartsOfARunPath) {
  const TemporaryFolder folder;
  const std::string source = folder.write("main.c", "int main(void) { return 0; }\n");
  const auto built = [&](const std::string& parts) {
    const std::string binary = folder.file("main");
    EXPECT_EQ(run_command({"gcc", source, "-o", binary, "-Wl,-rpath," + parts}).status, 0);
    return relative_search_folders(binary);
  };
  EXPECT_EQ(built("/usr/lib:"), std::vector<std::string>{"\"\""});
  EXPECT_EQ(built("/usr/lib:lib"), std::vector<std::string>{"\"lib\""});
  EXPECT_EQ(built("/usr/lib:$ORIGIN/../lib"), kNone);
}

}  // namespace
}  // namespace faultline
