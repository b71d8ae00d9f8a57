// SPDX-License-Identifier: MIT
// Models and case bases that were edited, mixed or learned again, as their user meets them; a robot without
// torque, since it is learned at once.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "lib/cases/case_file.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/model/model.hpp"
#include "tests/residual/relation/stepped_joint.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

std::string csv_of(const Log& log) {
  std::string text = "t,q1,dq1,q_ref1,dq_ref1\n";
  for (int k = 0; k < log.rows(); ++k)
    text += fmt::format("{:.3f},{:.6f},{:.5f},{:.6f},{:.6f}\n", log.time[k], log.q[0][k], log.dq[0][k],
                        log.q_ref[0][k], log.dq_ref[0][k]);
  return text;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

class ModelCommand : public testing::Test {
 protected:
  ModelCommand() {
    for (const std::uint64_t seed : {1, 2, 3})
      logs_.push_back(
          folder_.write(fmt::format("healthy_{}.csv", seed), csv_of(SteppedJoint{.seed = seed}.log(30.0))));
    EXPECT_EQ(learn({logs_[0], logs_[1]}).status, 0);
  }

  ProgramRun learn(std::vector<std::string> logs, std::vector<std::string> more = {}) const {
    logs.insert(logs.begin(), "learn");
    logs.insert(logs.end(), {"--robot", "R", "-o", model_});
    logs.insert(logs.end(), more.begin(), more.end());
    return run_program(logs);
  }

  ProgramRun diagnose(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"diagnose", logs_[2], "--model", model_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(arguments);
  }

  ProgramRun cases(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "cases");
    arguments.insert(arguments.end(), {"--model", model_});
    return run_program(arguments);
  }

  /// The range of a relation as it was learned, doubled in the text.
  void edit_model() const {
    std::string text = read_file(model_);
    const std::size_t at = text.find("\"high\": ") + 8;
    text.insert(at, "1");
    write_file(model_, text);
  }

  TemporaryFolder folder_;
  std::vector<std::string> logs_;
  std::string model_ = folder_.file("stepper.model"), base_ = case_base_path(model_);
};

TEST_F(ModelCommand, AnEditedModelIsRefusedUntilItIsSignedAndThenMarkedInEachReport) {
  edit_model();
  const ProgramRun refused = diagnose();
  EXPECT_EQ(refused.status, 3);
  EXPECT_TRUE(has(refused.err, "faultline model sign")) << refused.err;
  const ProgramRun sign = run_program({"model", "sign", model_, "--why", "wider range"});
  EXPECT_EQ(sign.status, 0) << sign.err;
  const std::string html = folder_.file("r.html"), json = folder_.file("r.json"), md = folder_.file("r.md");
  const ProgramRun run = diagnose({"--html", html, "--json", json, "--md", md});
  EXPECT_NE(run.status, 3) << run.err;
  for (const std::string& report : {run.out, read_file(html), read_file(json), read_file(md)})
    EXPECT_TRUE(has(report, "edited by hand") && has(report, "wider range")) << report;
  EXPECT_TRUE(has(run_program({"model", "sign", model_}).out, "nothing to sign"));
}

TEST_F(ModelCommand, ACaseBaseOfAnotherModelIsRefused) {
  const std::string before = read_file(model_);
  ASSERT_EQ(learn({logs_[0], logs_[2]}).status, 0);
  EXPECT_NE(diagnose().status, 3);
  write_file(model_, before);  // as a kill between the two renames of learn leaves it
  const ProgramRun run = diagnose();
  EXPECT_EQ(run.status, 3) << run.out;
  EXPECT_TRUE(has(run.err, "belongs to another model") && has(run.err, "learn again")) << run.err;
  ASSERT_EQ(learn({logs_[0], logs_[1]}).status, 0);
  EXPECT_NE(diagnose().status, 3) << "learning again mends it";
}

TEST_F(ModelCommand, ImportWithTheModelBindsExportedCasesToIt) {
  const std::string exported = folder_.file("cases.json");
  ASSERT_EQ(cases({"export", "-o", exported}).status, 0);
  ASSERT_EQ(learn({logs_[0], logs_[2]}).status, 0);
  ASSERT_EQ(cases({"import", exported, "--replace"}).status, 0);
  EXPECT_NE(diagnose().status, 3) << diagnose().err;
}

TEST_F(ModelCommand, CasesOfARobotOfAnotherKindAreNotBoundToTheModel) {
  const std::string exported = folder_.file("cases.json"), other = folder_.file("other.db");
  CaseBase base = read_case_base(base_);
  EXPECT_EQ(base.robot().axes, "R") << "learn tells it";
  base.describe_robot({"gantry", "PPR"});
  write_case_base(other, base);
  ASSERT_EQ(run_program({"cases", "export", "-o", exported, "--cases", other}).status, 0);
  for (const char* how : {"--replace", "--merge"}) {
    const ProgramRun run = cases({"import", exported, how});
    EXPECT_EQ(run.status, 2) << how;
    EXPECT_TRUE(has(run.err, "PPR")) << run.err;
  }
}

TEST_F(ModelCommand, LearningAgainKeepsAndReportsConfirmedCases) {
  ASSERT_EQ(cases({"add", "--fault", "locked", "--joint", "1", "--done", "new brake"}).status, 0);
  const std::string json = folder_.file("learned.json");
  const ProgramRun run = learn({logs_[0], logs_[2]}, {"--json", json});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(has(run.out, "1 other carried over")) << run.out;
  EXPECT_EQ(nlohmann::json::parse(read_file(json)).at("carried_over").at("carried"), 1);
  const CaseBase base = read_case_base(base_);
  ASSERT_EQ(base.cases().size(), 1u);
  EXPECT_EQ(base.at(1).what_was_done, "new brake");
  EXPECT_FALSE(base.at(1).features_by.empty());
  EXPECT_EQ(base.model_identity(), load_model(model_).identity);
}

TEST_F(ModelCommand, LearningIsRefusedIfItWouldLoseCases) {
  EXPECT_EQ(cases({"add", "--fault", "locked", "--joint", "3"}).status, 2) << "the robot has one joint";
  change_case_base(base_, [](CaseBase& base) {
    base.describe_robot({"gantry", "PPR"});
    Case c;
    c.decision = c.label = {FaultKind::locked, 3_joint};
    c.origin = kByHandOrigin;
    base.retain(c);
  });
  const std::string model = read_file(model_), base = read_file(base_);
  const ProgramRun joint = learn({logs_[0], logs_[2]});
  EXPECT_EQ(joint.status, 3);
  EXPECT_TRUE(has(joint.err, "joint 3")) << joint.err;
  EXPECT_EQ(read_file(base_), base);
  write_file(base_, base.substr(0, base.size() / 2));
  const ProgramRun damaged = learn({logs_[0], logs_[2]});
  EXPECT_EQ(damaged.status, 3);
  EXPECT_TRUE(has(damaged.err, "cannot be carried over")) << damaged.err;
  EXPECT_EQ(read_file(model_), model);
}

TEST_F(ModelCommand, AnEndlessDeviceIsRefusedWithinLittleMemory) {
  constexpr long long kMemory = 600LL << 20;
  const ProgramRun run =
      run_program({"diagnose", logs_[0], "--model", "/dev/zero"}, {.memory_limit = kMemory});
  EXPECT_EQ(run.status, 3) << run.err;
  EXPECT_TRUE(has(run.err, "without end")) << run.err;
}

}  // namespace
}  // namespace faultline
