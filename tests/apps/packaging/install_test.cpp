// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>

#include "lib/core/atomic_file.hpp"
#include "tests/support/dynamic_section.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

const std::string kSource = FAULTLINE_SOURCE_DIR;
const std::string kBuild = fs::path(FAULTLINE_PROGRAM).parent_path().string();

/// Flags with which a program must be built to link the libraries.
#ifdef __SANITIZE_ADDRESS__
const std::string kFlags = "-fsanitize=address,undefined";
#else
const std::string kFlags;
#endif

/// The tree installed once for all tests of this file.
class InstalledTree : public testing::Test {
 protected:
  void SetUp() override {
    const ProgramRun run = run_command({"cmake", "--install", kBuild, "--prefix", prefix()});
    ASSERT_EQ(run.status, 0) << run.err;
  }
  std::string prefix() const { return folder_.file("usr"); }
  bool has(const std::string& path) const { return fs::exists(fs::path(prefix()) / path); }

  TemporaryFolder folder_;
};

TEST_F(InstalledTree, HoldsProgramManualCompletionPresetsSamplesAndLicence) {
  for (const char* path :
       {"bin/faultline", "share/man/man1/faultline.1.gz", "share/man/man1/faultline-golden-check.1.gz",
        "share/bash-completion/completions/faultline", "share/zsh/vendor-completions/_faultline",
        "share/fish/vendor_completions.d/faultline.fish", "share/faultline/presets/ur-rtde.toml",
        "share/faultline/sample_logs/bench/robot.toml", "share/doc/faultline/copyright"})
    EXPECT_TRUE(has(path)) << path;
}

TEST_F(InstalledTree, TheProgramHasNoRelativeFolderInItsRunPath) {
  EXPECT_EQ(relative_search_folders(prefix() + "/bin/faultline"), std::vector<std::string>());
}

TEST_F(InstalledTree, TheInstalledProgramWorksAndFindsItsPresets) {
  const std::string program = prefix() + "/bin/faultline";
  EXPECT_EQ(run_command({program, "--version"}).out, "faultline " FAULTLINE_VERSION "\n");
  const std::string log =
      folder_.write("run.csv", "timestamp actual_q_0 actual_qd_0 actual_current_0\n0.1 1 2 3\n0.2 1.2 2 3\n");
  const std::string robot = folder_.write("robot.toml", "axes = \"R\"\n[log]\npreset = \"ur-rtde\"\n");
  const std::string out = folder_.file("out.csv");
  const ProgramRun run = run_command({program, "convert", log, out, "--robot", robot});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(read_file(out).find("q1"), std::string::npos);
}

TEST_F(InstalledTree, AThirdPartyProgramFindsLinksAndUsesTheLibrary) {
  const std::string build = folder_.file("example");
  const ProgramRun configured =
      run_command({"cmake", "-G", "Ninja", "-S", kSource + "/tests/apps/packaging/example", "-B", build,
                   "-DCMAKE_PREFIX_PATH=" + prefix(), "-DCMAKE_CXX_FLAGS=" + kFlags});
  ASSERT_EQ(configured.status, 0) << configured.err;
  const ProgramRun built = run_command({"cmake", "--build", build});
  ASSERT_EQ(built.status, 0) << built.out;
  const std::string model = folder_.file("bench.json");
  ASSERT_EQ(run_command({"sh", "-c",
                         "cp '" + kSource + "'/sample_logs/golden/model-*.json '" + model + "' && cp '" +
                             kSource + "'/sample_logs/golden/cases-*.db '" + model + ".cases.db'"})
                .status,
            0);
  const std::string log = kSource + "/sample_logs/bench/torque_loss_1.csv";
  const ProgramRun run = run_command({build + "/diagnose_example", log, model});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.out.find("faulty\ntorque_loss 1 7.9"), 0u) << run.out;
}

}  // namespace
}  // namespace faultline
