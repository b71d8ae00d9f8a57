// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/dynamic_section.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/skip_unless_installed.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

/// A script that stands for cmake as cpack calls it, `cmake -E env NAME=value file PATH` for each of the 300
/// files of the package: the start of cmake itself takes longer than all else that cpack does.
std::string quick_environment(const TemporaryFolder& folder) {
  const std::string path = folder.write("cmake", "#!/bin/sh\nshift 2\nexec env \"$@\"\n");
  fs::permissions(path, fs::perms::owner_all);
  return path;
}

TEST(DebianPackage, HoldsTheProgramAndNamesTheLibrariesItNeeds) {
  SKIP_UNLESS_INSTALLED(run_command({"sh", "-c", "command -v dpkg-shlibdeps"}).status == 0,
                        "dpkg-shlibdeps of dpkg-dev is missing");
  const TemporaryFolder folder;
  const std::string build = fs::path(FAULTLINE_PROGRAM).parent_path().string();
  const std::string as_cmake = quick_environment(folder);
  const ProgramRun made =
      run_command({"cpack", "--config", build + "/CPackConfig.cmake", "-G", "DEB", "-B",
                   folder.path().string(), "-D", "CPACK_COMPONENTS_ALL=program", "-D",
                   "CPACK_DEBIAN_COMPRESSION_TYPE=gzip", "-D", "CMAKE_COMMAND=" + as_cmake});
  ASSERT_EQ(made.status, 0) << made.out << made.err;
  const std::string package = folder.file("faultline_" FAULTLINE_VERSION "-1_amd64.deb");
  ASSERT_TRUE(fs::exists(package)) << made.out;

  const std::string depends = run_command({"dpkg-deb", "-f", package, "Depends"}).out;
  for (const char* library : {"libcholmod3", "libhdf5", "libsqlite3", "libc6"})
    EXPECT_NE(depends.find(library), std::string::npos) << depends;
  const std::string content = run_command({"dpkg-deb", "-c", package}).out;
  for (const char* path : {"./usr/bin/faultline\n", "./usr/share/man/man1/faultline-diagnose.1.gz\n",
                           "./usr/share/faultline/sample_logs/bench/healthy_1.csv\n"})
    EXPECT_NE(content.find(path), std::string::npos) << path;
  EXPECT_EQ(content.find("/include/"), std::string::npos) << "headers belong to libfaultline-dev";
  ASSERT_EQ(run_command({"dpkg-deb", "-x", package, folder.file("content")}).status, 0);
  EXPECT_EQ(relative_search_folders(folder.file("content/usr/bin/faultline")), std::vector<std::string>());
}

}  // namespace
}  // namespace faultline
