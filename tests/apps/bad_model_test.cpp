// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "lib/cases/case_file.hpp"
#include "lib/core/atomic_file.hpp"
#include "tests/learn/small_robot.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

/// The slide at rest, held against gravity.
const std::string kLog =
    "t,q1,dq1,tau1\n0,-0.1,0.0004,19.62\n0.01,-0.10001,-0.0002,19.63\n0.02,-0.1,0.0001,19.61\n"
    "0.03,-0.09999,-0.0003,19.62\n";

void expect_one_sentence(const ProgramRun& run, int status, const std::vector<std::string>& words) {
  EXPECT_EQ(run.status, status) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  for (const std::string& word : words)
    EXPECT_NE(run.err.find(word), std::string::npos) << word << " in: " << run.err;
}

/// Files given as a model that are none. Nothing is left behind whatever happens.
class BadModel : public testing::Test {
 protected:
  void expect_refused(const std::string& model, const std::vector<std::string>& words) {
    const std::string log = folder_.write("log.csv", kLog), path = folder_.write("robot.model", model);
    const ProgramRun run =
        run_program({"diagnose", log, "--model", path, "--json", folder_.file("out.json")});
    expect_one_sentence(run, 3, words);
    EXPECT_FALSE(std::filesystem::exists(folder_.file("out.json")));
    EXPECT_EQ(read_file(path), model);
  }

  TemporaryFolder folder_;
};

TEST_F(BadModel, DiagnoseRefusesAMissingModel) {
  const std::string log = folder_.write("log.csv", kLog);
  expect_one_sentence(run_program({"diagnose", log, "--model", folder_.file("no.model")}), 3,
                      {"no.model", "No such file"});
}

TEST_F(BadModel, DiagnoseRefusesAnEmptyModel) { expect_refused("", {"robot.model", "faultline learn"}); }

TEST_F(BadModel, DiagnoseRefusesAJsonObjectThatIsNotAModel) {
  expect_refused("{\"a\": [1, 2]}", {"robot.model", "not a faultline model"});
}

TEST_F(BadModel, DiagnoseRefusesAJsonArrayAsModel) {
  expect_refused("[1, 2]", {"robot.model", "not a faultline model"});
}

TEST_F(BadModel, DiagnoseRefusesANumberAsSchema) {
  expect_refused("{\"schema\": 3}", {"robot.model", "not a faultline model"});
}

TEST_F(BadModel, DiagnoseRefusesANewerSchema) {
  expect_refused("{\"schema\": \"faultline/model/7\"}", {"robot.model", "faultline/model/7", "newer"});
}

TEST_F(BadModel, DiagnoseRefusesAnEarlierSchema) {
  expect_refused("{\"schema\": \"faultline/model/3\"}",
                 {"robot.model", "earlier program", "learn the model again"});
}

TEST_F(BadModel, DiagnoseRefusesABinaryFileAsModel) {
  expect_refused(std::string("\x7f\x45\x4c\x46\0\0\0\0", 8), {"robot.model", "faultline learn"});
}

/// One learned model for all that needs a whole one, since learning takes seconds.
TEST_F(BadModel, DiagnoseRefusesTruncatedModelsBadCaseBasesAndUnwritableOutputs) {
  const Learned learned = learn_small();
  const std::string text = model_to_json(learned.model);
  const std::string model = folder_.write("good.model", text), cases = case_base_path(model);
  write_case_base(cases, learned.cases);
  const std::string base = read_file(cases);
  std::vector<std::string> arguments = {"diagnose", folder_.write("log.csv", kLog), "--model", model};
  const ProgramRun few = run_program(arguments);
  EXPECT_EQ(few.status, 1) << few.err;
  EXPECT_NE(few.out.find("No verdict"), std::string::npos) << "four rows prove nothing: " << few.out;

  for (const double share : {0.1, 0.5, 0.99})
    expect_refused(text.substr(0, static_cast<std::size_t>(share * static_cast<double>(text.size()))),
                   {"robot.model", "truncated"});

  const auto diagnose_log = [&](const std::string& log) {
    arguments[1] = folder_.write("other.csv", log);
    return run_program(arguments);
  };
  EXPECT_EQ(diagnose_log("t,q1,dq1,tau1\n0,0,1,2\n").status, 1) << "one row is inconclusive";
  expect_one_sentence(diagnose_log("t,q1,q2,tau1,tau2\n0,0,1,2,3\n1,0,1,2,3\n"), 3,
                      {"other.csv", "another robot", "2 joints"});
  expect_one_sentence(diagnose_log("t,q1,dq1\n0,0,1\n1,0,1\n"), 3, {"other.csv", "no torque"});
  arguments[1] = folder_.file("log.csv");

  const auto with_cases = [&](const std::string& bytes, const std::vector<std::string>& words) {
    std::vector<std::string> all = arguments;
    all.insert(all.end(), {"--cases", folder_.write("bad.db", bytes)});
    expect_one_sentence(run_program(all), 3, words);
  };
  with_cases("", {"bad.db"});
  with_cases("no database at all, only a few words of text", {"bad.db"});
  with_cases(base.substr(0, base.size() / 2), {"bad.db"});
  std::string newer = base;
  newer[63] = 9;  // SQLite keeps user_version big-endian at byte 60
  with_cases(newer, {"bad.db", "newer"});
  arguments.insert(arguments.end(), {"--cases", folder_.file("none.db")});
  expect_one_sentence(run_program(arguments), 3, {"none.db"});
  EXPECT_EQ(read_file(model), text) << "diagnosing changes neither model";
  EXPECT_EQ(read_file(cases), base) << "nor case base";

  arguments.resize(4);
  arguments.insert(arguments.end(), {"--json", folder_.file("no/out.json")});
  expect_one_sentence(run_program(arguments), 3, {"out.json", "cannot be created"});
  arguments.back() = folder_.file("out.json");
  expect_one_sentence(run_program(arguments, {.file_size_limit = 600}), 3, {"out.json", "cannot be written"});
  EXPECT_FALSE(std::filesystem::exists(folder_.file("out.json")));
  arguments.back() = "/dev/full";
  EXPECT_EQ(run_program(arguments).status, 3);
}

/// Before, the row-by-row look at the log ahead of the diagnosis took it for the model's robot and crashed.
TEST_F(BadModel, DiagnoseRefusesALogWithFewerOrMoreJointsThanTheModel) {
  std::string model;
  for (const auto& entry : std::filesystem::directory_iterator(FAULTLINE_SOURCE_DIR "/sample_logs/golden")) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("model-", 0) == 0) model = entry.path().string();
    if (name.rfind("cases-", 0) == 0) std::filesystem::copy_file(entry.path(), folder_.file("cases.db"));
  }
  std::string two = "t,q1,q2,dq1,dq2,tau1,tau2\n", four = "t,q1,q2,q3,q4,tau1,tau2,tau3,tau4\n";
  for (int k = 0; k < 200; ++k) {
    const std::string time = std::to_string(0.073 * k);
    two += time + ",0.1,0.2,0,0,1,1\n";
    four += time + ",0.1,0.2,0.3,0.4,1,1,1,1\n";
  }
  for (const auto& [log, joints] : {std::pair{&two, "2 joints"}, {&four, "4 joints"}})
    expect_one_sentence(run_program({"diagnose", folder_.write("log.csv", *log), "--model", model, "--cases",
                                     folder_.file("cases.db")}),
                        3, {"log.csv", "another robot", joints});
}

TEST_F(BadModel, DiagnoseNamesAMissingPositionAndDoesNotReportAnotherRobot) {
  std::string model;
  for (const auto& entry : std::filesystem::directory_iterator(FAULTLINE_SOURCE_DIR "/sample_logs/golden")) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("model-", 0) == 0) model = entry.path().string();
    if (name.rfind("cases-", 0) == 0) std::filesystem::copy_file(entry.path(), folder_.file("cases.db"));
  }
  const std::string rows = "0,.1,.3,1,2,3\n.073,.1,.3,1,2,3\n.146,.1,.3,1,2,3\n";
  const auto diagnose_log = [&](const std::string& header) {
    const ProgramRun run = run_program({"diagnose", folder_.write("log.csv", header + rows), "--model", model,
                                        "--cases", folder_.file("cases.db")});
    EXPECT_EQ(run.err.find("another robot"), std::string::npos) << run.err;
    return run;
  };
  expect_one_sentence(diagnose_log("t,q1,q3,tau1,tau2,tau3\n"), 3,
                      {"log.csv", "position of joint 2 (q2)", "\"q3\"", "[log.columns] q2"});
  expect_one_sentence(diagnose_log("t,q1,q2,tau1,tau2,tau3\n"), 3,
                      {"log.csv", "position of joint 3 (q3)", "\"tau3\"", "[log.columns] q3"});
}

TEST_F(BadModel, DiagnoseOfTwoLogsNamesBatch) {
  expect_one_sentence(run_program({"diagnose", "a.csv", "b.csv", "--model", "robot.model"}), 2,
                      {"takes one log", "faultline batch", "--then", "see 'faultline diagnose --help'"});
}

}  // namespace
}  // namespace faultline
