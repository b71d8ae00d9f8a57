// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>

#include "lib/core/error.hpp"
#include "lib/core/hash.hpp"
#include "lib/golden/record.hpp"
#include "tests/apps/golden_copy.hpp"

namespace faultline {
namespace {

/// A golden folder, and a run over it that says all that is expected but for two logs.
class AcceptGolden : public testing::Test {
 protected:
  AcceptGolden() : set_(load_golden(golden_.path())) {
    run_.program_version = "next";
    for (const GoldenLog& log : set_.logs) run_.logs.push_back({log.name(), log.expected});
    run_.identification = set_.identification->expected;
    observed("locked_1.csv").events.clear();
    observed("locked_1.csv").trace.values[0][0] += 1.0;
    observed("collision_1.csv").rows = 7;
  }

  Observation& observed(const std::string& name) {
    for (GoldenRun::Log& log : run_.logs)
      if (log.name == name) return log.observation;
    throw std::logic_error(name);
  }

  GoldenLog stored(const std::string& name) const {
    for (const GoldenLog& log : load_golden(golden_.path()).logs)
      if (log.name() == name) return log;
    throw std::logic_error(name);
  }

  GoldenCopy golden_;
  GoldenSet set_;
  GoldenRun run_;
};

TEST_F(AcceptGolden, OnlyTheNamedLogIsAcceptedWithANewTrace) {
  const GoldenLog before = stored("locked_1.csv");
  accept_golden(golden_.path(), set_, run_, {"locked_1.csv"});
  const GoldenLog after = stored("locked_1.csv");
  EXPECT_TRUE(after.expected.events.empty());
  EXPECT_NE(after.trace.path, before.trace.path);
  EXPECT_NEAR(after.expected.trace.values[0][0], before.expected.trace.values[0][0] + 1.0, 1e-6);
  EXPECT_FALSE(std::filesystem::exists(golden_.path() + "/" + before.trace.path)) << "outdated";
  EXPECT_NE(stored("collision_1.csv").expected.rows, 7);
  EXPECT_EQ(load_golden(golden_.path()).program_version, "next");
}

TEST_F(AcceptGolden, ALogThatCannotBeProcessedIsRefusedAndNothingChanges) {
  observed("collision_1.csv").verdict = kUnusable;
  observed("collision_1.csv").reason = "has no time";
  const auto before = golden_.snapshot();
  try {
    accept_golden(golden_.path(), set_, run_, {"locked_1.csv", "collision_1.csv"});
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::input);
    EXPECT_NE(std::string(error.what()).find("has no time"), std::string::npos);
  }
  EXPECT_EQ(golden_.snapshot(), before);
}

TEST_F(AcceptGolden, ANamedLogWithAChangedFileIsAcceptedWithItsNewContent) {
  const std::string path = golden_.path() + "/logs/locked_1.csv";
  write_file(path, read_file(path) + "\n");
  EXPECT_NE(stored("locked_1.csv").damage, "");
  accept_golden(golden_.path(), load_golden(golden_.path()), run_, {"locked_1.csv"});
  EXPECT_EQ(stored("locked_1.csv").damage, "");
  EXPECT_EQ(stored("locked_1.csv").log.sha256, sha256_of_file(path));
}

TEST_F(AcceptGolden, TheIdentificationIsAcceptedByItsName) {
  run_.identification->parameters.at(0).value = 42.0;
  accept_golden(golden_.path(), set_, run_, {"locked_1.csv"});
  EXPECT_NE(load_golden(golden_.path()).identification->expected.parameters.at(0).value, 42.0);
  accept_golden(golden_.path(), load_golden(golden_.path()), run_, {kIdentification});
  EXPECT_EQ(load_golden(golden_.path()).identification->expected.parameters.at(0).value, 42.0);
}

}  // namespace
}  // namespace faultline
