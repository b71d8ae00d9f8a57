// SPDX-License-Identifier: MIT
// Every JSON that the program writes, against its schema in docs/schemas. What reproduce writes is judged in
// reproduce_command_test, which runs it anyway.
#include "tests/support/json_schema.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>

#include "lib/core/atomic_file.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

const std::string kRoot = FAULTLINE_SOURCE_DIR;
const std::string kSamples = kRoot + "/sample_logs/";
const std::string kLogs = kSamples + "golden/logs/";

/// The header and every second row, as a logger of half the rate writes it.
std::string every_second_row(const std::string& table) {
  std::istringstream lines(table);
  std::string kept;
  int row = 0;
  for (std::string line; std::getline(lines, line); ++row)
    if (row == 0 || row % 2 == 1) kept += line + "\n";
  return kept;
}

/// A copy of the golden folder's model with its case base.
class JsonSchemas : public testing::Test {
 protected:
  JsonSchemas() {
    for (const auto& entry : fs::directory_iterator(kSamples + "golden")) {
      const std::string name = entry.path().filename().string();
      if (name.rfind("model-", 0) == 0) fs::copy_file(entry.path(), model_);
      if (name.rfind("cases-", 0) == 0) fs::copy_file(entry.path(), model_ + ".cases.db");
    }
  }

  std::string file(const std::string& name) const { return folder_.file(name); }

  /// Writes to a file what the command prints, for commands that print JSON.
  std::string printed(const std::string& name, const std::vector<std::string>& arguments) {
    const ProgramRun run = run_program(arguments);
    EXPECT_EQ(run.status, 0) << run.err;
    return folder_.write(name, run.out);
  }

  std::string cases(const std::string& name, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "cases");
    arguments.insert(arguments.end(), {"--model", model_, "--json"});
    return printed(name, arguments);
  }

  void diagnose(const std::string& log, const std::string& json, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"diagnose", kLogs + log, "--model", model_, "--json", json};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_LE(run_program(arguments).status, 1);
  }

  TemporaryFolder folder_;
  const std::string model_ = folder_.file("bench.model");
};

TEST_F(JsonSchemas, DiagnosesOfFaultyHealthyAndInconclusiveLogsFollowTheSchema) {
  diagnose("locked_1.csv", file("faulty.json"));
  diagnose("healthy_quintic.csv", file("healthy.json"));
  diagnose("locked_1.csv", file("samples.json"), {"--classify", "samples"});
  const std::string sparse = folder_.write("sparse.csv", every_second_row(read_file(kLogs + "locked_1.csv")));
  EXPECT_EQ(run_program({"diagnose", sparse, "--model", model_, "--json", file("sparse.json")}).status, 1);
  EXPECT_NE(read_file(file("sparse.json")).find("\"inconclusive\""), std::string::npos);
  EXPECT_FOLLOWS_SCHEMA({"diagnosis-1", file("faulty.json")}, {"diagnosis-1", file("healthy.json")},
                        {"diagnosis-1", file("samples.json")}, {"diagnosis-1", file("sparse.json")});
}

TEST_F(JsonSchemas, InspectionsOfGoodAndDamagedLogsFollowTheSchema) {
  const std::string odd = folder_.write("odd.csv", "a,b\n1,x\n2,3\n3,4\n"), json = file("inspection.json");
  const std::string gap = folder_.write("gap.csv", "t,q1,dq1\n0,0,0\n1,1,1\n2,2,x\n9,2,1\n8,1,1\n10,nan,1\n");
  run_program({"inspect", kLogs + "locked_1.csv", odd, gap, "--json", json});
  EXPECT_FOLLOWS_SCHEMA({"inspection-1", json});
}

TEST_F(JsonSchemas, IdentificationsWithMuchAndLittleExcitationFollowTheSchema) {
  const std::string robot = kSamples + "bench/robot.toml";
  EXPECT_EQ(run_program({"identify", kSamples + "bench/healthy_2.csv", kSamples + "bench/healthy_3.csv",
                         "--robot", robot, "-o", file("a.toml"), "--json", file("two.json")})
                .status,
            0);
  run_program({"identify", kLogs + "locked_1.csv", "--robot", robot, "-o", file("b.toml"), "--json",
               file("one.json")});
  EXPECT_FOLLOWS_SCHEMA({"identification-1", file("two.json")}, {"identification-1", file("one.json")});
}

TEST_F(JsonSchemas, ModelsAndReportsOfLearnFollowTheirSchemas) {
  const std::string bench = kSamples + "bench/", model = file("learned.model");
  fs::copy_file(model_ + ".cases.db", model + ".cases.db");
  const ProgramRun run =
      run_program({"learn", bench + "healthy_2.csv", bench + "healthy_3.csv", "--robot", bench + "robot.toml",
                   "--runs-per-label", "2", "-o", model, "--json", file("learned.json"), "--force"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(read_file(file("learned.json")).find("\"carried_over\""), std::string::npos);
  const std::string edited = file("edited.model");
  write_file(edited,
             std::regex_replace(read_file(model), std::regex("\"name\": \"bench\""), "\"name\": \"b\""));
  EXPECT_EQ(run_program({"model", "sign", edited, "--why", "another name"}).status, 0);
  const std::string twin = printed("twin.json", {"learn", "--show-twin", "--json", "-"});
  EXPECT_FOLLOWS_SCHEMA({"learning-1", file("learned.json")}, {"model-4", model}, {"model-4", edited},
                        {"twin-1", twin});
}

TEST_F(JsonSchemas, AModelOfLogsWithoutTorqueFollowsTheSchema) {
  std::string log = "t,q1,q_ref1\n";
  for (int k = 0; k < 3000; ++k) {
    const int phase = k % 200, at = phase < 100 ? phase : 200 - phase;
    log += std::to_string(k) + "e-2," + std::to_string(at - k % 2) + "e-2," + std::to_string(at) + "e-2\n";
  }
  const std::string path = folder_.write("steps.csv", log), model = file("tracking.model");
  const ProgramRun run =
      run_program({"learn", path, "--robot", "R", "-o", model, "--json", file("tracking.json"), "--force"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(read_file(model).find("\"learned_from\""), std::string::npos);
  EXPECT_FOLLOWS_SCHEMA({"learning-1", file("tracking.json")}, {"model-4", model});
}

TEST_F(JsonSchemas, ABatchAndItsMergedShardsFollowTheirSchemas) {
  fs::create_directory(file("runs"));
  folder_.write("runs/broken.csv", "");
  fs::copy_file(kLogs + "locked_1.csv", file("runs/locked.csv"));
  fs::copy_file(kLogs + "healthy_quintic.csv", file("runs/healthy.csv"));
  for (const char* shard : {"1", "2"})
    run_program({"batch", file("runs"), "--model", model_, "-o", file(std::string("part") + shard), "--shard",
                 std::string(shard) + "/2", "--identify"});
  EXPECT_EQ(run_program({"batch", "merge", file("part1"), file("part2"), "-o", file("all"), "--json",
                         file("summary.json")})
                .status,
            3);
  std::vector<SchemaAndDocument> documents = {{"batch-summary-2", file("summary.json")},
                                              {"batch-row-1", file("all/index.ndjson")},
                                              {"batch-2", file("part1/.batch/finished.json")}};
  for (const auto& entry : fs::directory_iterator(file("all/logs")))
    if (entry.path().extension() == ".json") documents.push_back({"diagnosis-1", entry.path().string()});
  ASSERT_GE(documents.size(), 5u);
  const SchemaVerdict verdict = judge_by_schema(documents);
  SKIP_UNLESS_INSTALLED(verdict.can_judge, verdict.text);
  EXPECT_TRUE(verdict.valid) << verdict.text;
}

TEST_F(JsonSchemas, ComparisonsByTimeByMotionAndOfOneRunWithItselfFollowTheSchema) {
  const std::string bench = kSamples + "bench/", robot = bench + "robot.toml";
  const auto compare = [&](const std::string& first, const std::string& second, const std::string& json,
                           std::vector<std::string> more) {
    more.insert(more.begin(), {"compare", bench + first, bench + second, "--json", json});
    EXPECT_LE(run_program(more).status, 1);
  };
  compare("healthy_2.csv", "torque_loss_1.csv", file("faulty.json"), {"--model", model_});
  compare("healthy_2.csv", "healthy_3.csv", file("warped.json"), {"--align", "motion"});
  compare("healthy_2.csv", "healthy_2.csv", file("same.json"), {"--align", "time"});
  EXPECT_FOLLOWS_SCHEMA({"comparison-1", file("faulty.json")}, {"comparison-1", file("warped.json")},
                        {"comparison-1", file("same.json")});
}

TEST_F(JsonSchemas, GoldenChecksWithAndWithoutDifferencesFollowTheSchema) {
  const std::string golden = kSamples + "golden";
  EXPECT_EQ(run_program({"golden", "check", golden, "--json", file("same.json")}).status, 0);
  const std::string spec = read_file(golden + "/golden.toml");
  fs::copy(golden, file("changed"), fs::copy_options::recursive);
  write_file(file("changed/golden.toml"),
             std::regex_replace(spec, std::regex("\"locked\""), "\"free_swinging\""));
  EXPECT_EQ(run_program({"golden", "check", file("changed"), "--json", file("different.json")}).status, 1);
  EXPECT_EQ(
      run_program({"golden", "compare", golden, file("same.json"), "--json", file("compared.json")}).status,
      0);
  EXPECT_FOLLOWS_SCHEMA({"golden-check-1", file("same.json")}, {"golden-check-1", file("different.json")},
                        {"golden-check-1", file("compared.json")});
}

TEST_F(JsonSchemas, CasesAndTheirListsFollowTheirSchemas) {
  diagnose("locked_1.csv", file("faulty.json"));
  const std::string added =
      cases("added.json", {"add", file("faulty.json"), "--fault", "locked", "--joint", "1", "--by", "Weber",
                           "--date", "2026-03-02", "--robot", "cell 4"});
  const std::string list = cases("list.json", {"list"}), shown = cases("shown.json", {"show", "1"});
  const std::string confirmed =
      cases("confirmed.json", {"confirm", "1", "--done", "changed the brake relay"});
  EXPECT_EQ(run_program({"cases", "export", "--model", model_, "-o", file("cases.json")}).status, 0);
  const std::string imported = cases("imported.json", {"import", file("cases.json"), "--merge"});
  EXPECT_FOLLOWS_SCHEMA({"case-1", added}, {"case-1", shown}, {"case-1", confirmed}, {"case-list-1", list},
                        {"cases-1", file("cases.json")}, {"case-import-1", imported});
}

TEST_F(JsonSchemas, SimulationsFollowTheSchema) {
  const std::string spec =
      folder_.write("spec.toml",
                    "format = \"csv\"\nduration_s = 4.0\nsample_period_s = 0.01\n"
                    "[robot]\naxes = \"RR\"\n[[run]]\nname = \"healthy\"\n[[run]]\n"
                    "name = \"push\"\nfault = {kind = \"collision\", joint = 1, onset_s = 1.0, "
                    "duration_s = 0.2, size = 5.0}\n[[run]]\nname = \"locked\"\n"
                    "fault = {kind = \"locked\", joint = 2, onset_s = 1.0}\n");
  const std::string json = printed("made.json", {"simulate", spec, "-o", file("made"), "--json"});
  EXPECT_FOLLOWS_SCHEMA({"simulation-1", json});
}

TEST_F(JsonSchemas, ProvenanceOfAConvertedLogFollowsItsSchema) {
  const std::string log = folder_.write("lossy.csv", "t,q1,spare\n0,0,1\n1,x,2\n2,1,3\n1,1,3\n3,1,5\n");
  EXPECT_EQ(run_program({"convert", log, file("copy.csv")}).status, 1);
  EXPECT_EQ(run_program({"convert", log, file("copy.h5")}).status, 1);
  const std::string text = read_file(file("copy.csv")), mark = "# faultline provenance: ";
  const std::size_t begin = text.find(mark);
  ASSERT_NE(begin, std::string::npos) << text;
  const std::string provenance = folder_.write("provenance.json", text.substr(begin + mark.size()));
  const std::string arrays = read_file(file("copy.h5"));
  const std::size_t notes = arrays.find("{\"schema\":\"faultline/arrays/1\"");
  ASSERT_NE(notes, std::string::npos);
  const std::string note =
      folder_.write("notes.json", arrays.substr(notes, arrays.find('\0', notes) - notes));
  EXPECT_FOLLOWS_SCHEMA({"provenance-1", provenance}, {"arrays-1", note});
}

TEST_F(JsonSchemas, ADocumentThatIsBrokenIsRefused) {
  diagnose("locked_1.csv", file("good.json"));
  const std::string good = read_file(file("good.json"));
  const auto judged = [&](const char* what, const char* with) {
    const std::string broken = std::regex_replace(good, std::regex(what), with);
    EXPECT_NE(broken, good) << what;
    return judge_by_schema({{"diagnosis-1", folder_.write("broken.json", broken)}});
  };
  SKIP_UNLESS_INSTALLED(judge_by_schema({{"diagnosis-1", file("good.json")}}).can_judge,
                        "python3-jsonschema is missing");
  EXPECT_FALSE(judged("\"verdict\": \"faulty\"", "\"verdict\": \"broken\"").valid);
  EXPECT_FALSE(judged("\"onset_s\"", "\"onset\"").valid);
  EXPECT_FALSE(judged("\"could_also_be\"", "\"more\": 1, \"could_also_be\"").valid);
  EXPECT_FALSE(judged("\"rows\": ", "\"rows\": -").valid);
  EXPECT_FALSE(judged("faultline/diagnosis/1", "faultline/diagnosis/2").valid);
}

/// The check itself tries a member too many in every object.
TEST_F(JsonSchemas, OnlyObjectsOfFeaturesTakeAdditionalMembers) {
  diagnose("locked_1.csv", file("faulty.json"));
  EXPECT_EQ(run_program({"cases", "export", "--model", model_, "-o", file("cases.json")}).status, 0);
  const SchemaVerdict verdict =
      judge_by_schema({{"diagnosis-1", file("faulty.json")}, {"cases-1", file("cases.json")}});
  SKIP_UNLESS_INSTALLED(verdict.can_judge, verdict.text);
  EXPECT_TRUE(verdict.valid) << verdict.text;
  const std::vector<std::string> expected = {"diagnosis-1 .faults[].episode.features",
                                             "cases-1 .cases[].features"};
  EXPECT_EQ(verdict.is_open, expected);
}

/// "faultline/diagnosis/1" in the sources is docs/schemas/diagnosis-1.json; texts that are no JSON are named.
TEST(SchemaFiles, EachSchemaOfTheSourcesHasAFile) {
  static const std::regex named("\"faultline/([a-z-]+)/([0-9]+)\"");
  const std::set<std::string> no_json = {"cases-3", "golden-2"};
  std::set<std::string> found;
  for (const char* folder : {"/lib", "/apps", "/formats"})
    for (const auto& entry : fs::recursive_directory_iterator(kRoot + folder)) {
      if (entry.path().extension() != ".cpp") continue;
      const std::string text = read_file(entry.path().string());
      for (std::sregex_iterator it(text.begin(), text.end(), named), end; it != end; ++it)
        found.insert((*it)[1].str() + "-" + (*it)[2].str());
    }
  EXPECT_GE(found.size(), 10u);
  for (const std::string& name : no_json) found.erase(name);
  for (const std::string& name : found)
    EXPECT_TRUE(fs::exists(kRoot + "/docs/schemas/" + name + ".json")) << "docs/schemas/" << name << ".json";
}

TEST(SchemaFiles, ThePageOnSchemasNamesEachSchemaFile) {
  const std::string page = read_file(kRoot + "/docs/reference/json-schemas.md");
  int checked = 0;
  for (const auto& entry : fs::directory_iterator(kRoot + "/docs/schemas")) {
    const std::string name = entry.path().filename().string();
    EXPECT_NE(page.find("(../schemas/" + name + ")"), std::string::npos) << name;
    ++checked;
  }
  EXPECT_GE(checked, 15);
}

}  // namespace
}  // namespace faultline
