// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>

#include "lib/core/files/temporary_file.hpp"
#include "lib/core/random.hpp"
#include "tests/batch/batch_world.hpp"
#include "tests/support/signalled_program.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

constexpr int kKills = 8;

/// A command that writes into the folder of its results only.
class KilledCommands : public testing::Test {
 protected:
  KilledCommands() {
    world_.add_log("log.csv", 30.0, true, 5);
    world_.add_log("healthy.csv", 30.0, false, 6);
    for (const char* folder : {"whole", "out"}) fs::create_directories(world_.file(folder));
  }

  std::string log(const std::string& name) const { return world_.logs() + "/" + name; }

  /// Runs `command(folder)` to its end, then kills it again and again over old results in another folder: at
  /// every moment each result is the old or the new one, and after one more run all is as it should be.
  template <typename Command>
  void expect_nothing_lost(Command command) {
    const std::string whole = world_.file("whole"), out = world_.file("out");
    const auto start = std::chrono::steady_clock::now();
    const int status = run_program(command(whole)).status;
    const double whole_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    ASSERT_LE(status, 1);
    const auto expected = bytes_below(whole);
    for (const auto& [name, bytes] : expected) write_old(out + "/" + name);
    const int signals[] = {SIGKILL, SIGTERM, SIGINT, SIGHUP};
    for (int i = 0; i < kKills; ++i) {
      const int number = signals[i % 4];
      const auto before = bytes_below(out);  // with what SIGKILL left, if the next one comes before all else
      ended_by(number, whole_s * random_.uniform(0.05, 1.05), command(out));
      for (const auto& [name, bytes] : bytes_below(out))
        if (number == SIGKILL || before.count(name) || !is_temporary_name(name))
          expect_old_or_new(name, bytes, expected);
        else
          ADD_FAILURE() << name << " was left by signal " << number;
    }
    EXPECT_EQ(run_program(command(out)).status, status);
    EXPECT_EQ(differences(whole, out), std::vector<std::string>{});
  }

  static void write_old(const std::string& path) {
    fs::create_directories(fs::path(path).parent_path());
    write_file(path, "old");
  }

  static void expect_old_or_new(const std::string& name, const std::string& bytes,
                                const std::map<std::string, std::string>& expected) {
    if (is_temporary_name(name)) return;
    ASSERT_TRUE(expected.count(name)) << name;
    EXPECT_TRUE(bytes == "old" || bytes == expected.at(name)) << name;
  }

  BatchWorld world_;
  Random random_{11};
};

TEST_F(KilledCommands, AKilledConvertLeavesNoPartialFile) {
  world_.add_log("long.csv", 600.0, false, 7);
  expect_nothing_lost([&](const std::string& out) {
    return std::vector<std::string>{"convert", log("long.csv"), out + "/log.csv"};
  });
}

TEST_F(KilledCommands, AKilledDiagnoseLeavesNoPartialReport) {
  expect_nothing_lost([&](const std::string& out) {
    return std::vector<std::string>{"diagnose", log("log.csv"),  "--model", world_.model(),
                                    "--json",   out + "/j",      "--csv",   out + "/c",
                                    "--html",   out + "/h.html", "--junit", out + "/x"};
  });
}

TEST_F(KilledCommands, AKilledIdentifyLeavesNoPartialFile) {
  const std::string robot = world_.file("robot.toml");
  write_file(robot, "axes = \"P\"\n");
  expect_nothing_lost([&](const std::string& out) {
    return std::vector<std::string>{"identify", log("healthy.csv"), "--robot",    robot,
                                    "-o",       out + "/r.toml",    "--json",     out + "/j",
                                    "--html",   out + "/h.html",    "--pictures", out + "/p"};
  });
}

TEST_F(KilledCommands, AKilledSimulateLeavesNoPartialFile) {
  const std::string spec = world_.file("spec.toml");
  write_file(spec, "robot = \"RRP\"\nduration_s = 20.0\n[[run]]\nname = \"a\"\n[[run]]\nname = \"b\"\n");
  expect_nothing_lost([&](const std::string& out) {
    return std::vector<std::string>{"simulate", spec, "-o", out};
  });
}

TEST_F(KilledCommands, AKilledCasesExportLeavesNoPartialFile) {
  expect_nothing_lost([&](const std::string& out) {
    return std::vector<std::string>{"cases", "export", "--model", world_.model(), "-o", out + "/cases.json"};
  });
}

TEST_F(KilledCommands, AKilledLearnLeavesNoPartialModel) {
  const std::string out = world_.file("out"), robot = world_.file("robot.toml");
  write_file(robot, "axes = \"P\"\n");
  const std::vector<std::string> learn = {"learn", log("healthy.csv"), "--robot",          robot,
                                          "-o",    out + "/m",         "--runs-per-label", "4"};
  const auto start = std::chrono::steady_clock::now();
  ASSERT_EQ(run_program(learn).status, 0);
  const double whole_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  for (int i = 0; i < 3; ++i) {
    ended_by(i % 2 ? SIGTERM : SIGKILL, whole_s * random_.uniform(0.8, 1.0), learn);
    EXPECT_EQ(load_model(out + "/m").robot.joints(), 1);
    EXPECT_FALSE(read_case_base(out + "/m.cases.db").cases().empty());
  }
  ASSERT_EQ(run_program(learn).status, 0);
  for (const auto& entry : fs::directory_iterator(out))
    EXPECT_FALSE(is_temporary_name(entry.path().filename().string())) << entry.path();
}

}  // namespace
}  // namespace faultline
