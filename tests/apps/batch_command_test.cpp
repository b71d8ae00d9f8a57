// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "lib/model/model_files.hpp"
#include "tests/batch/batch_world.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

int done_before(const ProgramRun& run) {
  int done = 0;
  std::sscanf(run.err.c_str(), "faultline: %d of", &done);
  return done;
}

TEST(BatchCommand, WritesARowForEachLogAndExitsWithTheWorstStatus) {
  const BatchWorld world;
  world.add_logs(4);
  const std::string out = world.file("out");
  const std::string junit = world.file("batch.xml");
  const ProgramRun run = run_program(world.command(out, {"--html", "--junit", junit}));
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_NE(read_file(junit).find("tests=\"4\" failures=\"2\" errors=\"0\" skipped=\"0\""),
            std::string::npos);
  EXPECT_EQ(Json::parse(read_file(out + "/faultline_mqc.json")).at("data").size(), 4u);
  EXPECT_NE(run.out.find("4 logs: 2 healthy, 2 faulty"), std::string::npos) << run.out;
  const Json summary = Json::parse(read_file(out + "/summary.json"));
  EXPECT_EQ(summary["all"]["logs"], 4);
  EXPECT_EQ(summary["folders"].size(), 2u);
  std::istringstream lines(read_file(out + "/index.ndjson"));
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    const Json row = Json::parse(line);
    const Json diagnosis = Json::parse(read_file(out + "/" + row["report"].get<std::string>()));
    EXPECT_EQ(diagnosis["log"]["path"], row["log"]);
    EXPECT_EQ(diagnosis["verdict"], row["verdict"]);
    EXPECT_EQ(diagnosis["faults"].size(), row["faults"].size());
  }
  EXPECT_EQ(count, 4);
  const ProgramRun healthy =
      run_program({"batch", world.logs() + "/day_1", "--model", world.model(), "-o", world.file("healthy")});
  EXPECT_EQ(healthy.status, 0) << healthy.err;
}

TEST(BatchCommand, IdentifiesTheRobotFromEachHealthyLogForTrends) {
  const BatchWorld world;
  world.add_logs(4, 8.0);
  const std::string out = world.file("out");
  EXPECT_EQ(run_program(world.command(out, {"--identify"})).status, 1);
  std::istringstream lines(read_file(out + "/index.ndjson"));
  const double mass = small_robot().chain.links[0].mass;
  int identified = 0;
  for (std::string line; std::getline(lines, line);) {
    const Json row = Json::parse(line);
    const Json& parameters = row["parameters"];
    EXPECT_EQ(parameters.empty(), row["verdict"] != "healthy") << line;
    if (parameters.empty()) continue;
    ++identified;
    EXPECT_NEAR(parameters["m1"]["value"].get<double>(), mass, 0.02 * mass) << line;
  }
  EXPECT_EQ(identified, 2);
  EXPECT_NE(read_file(out + "/index.html").find("% from median"), std::string::npos);
}

TEST(BatchCommand, ALogIsReadAgainWhenItsDataFileHasChanged) {
  const BatchWorld world;
  write_file(world.logs() + "/trace.dat",
             "DIAEXTENDED\n#BEGINCHANNELHEADER\n200,q1\n210,EXPLIZIT\n211,trace.r64\n213,BLOCK\n"
             "214,REAL64\n220,2\n221,1\n#ENDCHANNELHEADER\n");
  const std::string out = world.file("out");
  EXPECT_EQ(run_program(world.command(out)).status, 3);
  EXPECT_NE(read_file(out + "/index.ndjson").find("is not in the folder of the header"), std::string::npos);
  write_file(world.logs() + "/trace.r64", "0123456789abcdef");
  EXPECT_EQ(run_program(world.command(out)).status, 3);
  EXPECT_NE(read_file(out + "/index.ndjson").find("no column for the time"), std::string::npos);
}

TEST(BatchCommand, ABadLogGetsARowWithItsReasonAndTheBatchContinues) {
  const BatchWorld world;
  world.add_logs(2);
  write_file(world.logs() + "/day_1/empty.csv", "");
  write_file(world.logs() + "/day_1/words.csv", "one,two\nthree,four\n");
  fs::create_symlink("/nowhere/at/all.csv", world.logs() + "/gone.csv");
  ASSERT_EQ(::mkfifo((world.logs() + "/pipe.csv").c_str(), 0600), 0);
  const std::string out = world.file("out");
  const ProgramRun run = run_program(world.command(out));
  EXPECT_EQ(run.status, 3) << run.err;
  EXPECT_NE(run.out.find("1 healthy, 1 faulty, 0 inconclusive, 4 unusable"), std::string::npos) << run.out;
  const std::string index = read_file(out + "/index.ndjson");
  EXPECT_NE(index.find("is empty"), std::string::npos) << index;
  for (const auto& [name, bytes] : bytes_below(out))
    EXPECT_EQ(bytes.find(world.file("")), std::string::npos) << name << " holds a path of this machine";
}

TEST(BatchCommand, ThreadsShardsAndCopiesOfTheLogsChangeNoByte) {
  const BatchWorld world;
  world.add_logs(7);
  write_file(world.logs() + "/day_1/empty.csv", "");
  run_program(world.command(world.file("one"), {"--html", "--threads", "1"}));
  run_program(world.command(world.file("two"), {"--html", "--threads", "2"}));
  EXPECT_EQ(differences(world.file("one"), world.file("two")), std::vector<std::string>{});
  std::vector<std::string> merge{"batch", "merge", "-o", world.file("all")};
  for (const char* part : {"3/3", "1/3", "2/3"}) {
    const std::string folder = world.file(std::string("part_") + part[0]);
    run_program(world.command(folder, {"--html", "--shard", part}));
    merge.push_back(folder);
  }
  const ProgramRun merged = run_program(merge);
  EXPECT_EQ(merged.status, 3) << merged.err;
  EXPECT_EQ(differences(world.file("one"), world.file("all")), std::vector<std::string>{});
  const ProgramRun again = run_program(world.command(world.file("all"), {"--html"}));
  EXPECT_EQ(done_before(again), 8) << again.err;
  merge.pop_back();
  const ProgramRun missing = run_program(merge);
  EXPECT_EQ(missing.status, 3);
  EXPECT_NE(missing.err.find("are missing"), std::string::npos) << missing.err;
}

/// The same robot under another name, which is another model.
std::string second_model(const BatchWorld& world) {
  const std::string path = world.file("second.model");
  auto [model, cases] = load_model_files(world.model(), case_base_path(world.model()));
  model.name = "second";
  bind_cases(model, cases);
  write_file(path, model_to_json(model));
  write_case_base(case_base_path(path), cases);
  return path;
}

TEST(BatchCommand, EachFolderIsDiagnosedWithItsOwnModel) {
  const BatchWorld world;
  world.add_logs(4);
  const std::string second = second_model(world), out = world.file("out");
  const std::vector<std::string> both{"--model", "day_2=" + second};
  const ProgramRun first = run_program(world.command(out, both));
  EXPECT_EQ(first.status, 1) << first.err;
  const Json summary = Json::parse(read_file(out + "/summary.json"));
  ASSERT_EQ(summary["models"].size(), 2u);
  EXPECT_EQ(summary["models"][0]["healthy"], 2);
  EXPECT_EQ(summary["models"][1]["faulty"], 2);
  std::istringstream lines(read_file(out + "/index.ndjson"));
  for (std::string line; std::getline(lines, line);) {
    const Json row = Json::parse(line);
    const std::string name = row["log"].get<std::string>();
    const bool is_second = name.find("day_2") != std::string::npos;
    EXPECT_EQ(row["model_sha256"], summary["models"][is_second ? 1 : 0]["sha256"]) << name;
    const Json diagnosis = Json::parse(read_file(out + "/" + row["report"].get<std::string>()));
    EXPECT_EQ(diagnosis["model"]["sha256"], row["model_sha256"]);
  }
  EXPECT_NE(read_file(out + "/index.html").find("By model"), std::string::npos);
  EXPECT_EQ(done_before(run_program(world.command(out, both))), 4);
  EXPECT_EQ(done_before(run_program(world.command(out))), 2) << "the logs of the first model were done";
  for (const char* part : {"1/2", "2/2"}) {
    std::vector<std::string> more = both;
    more.insert(more.end(), {"--shard", part});
    run_program(world.command(world.file(std::string("part_") + part[0]), more));
  }
  run_program({"batch", "merge", world.file("part_1"), world.file("part_2"), "-o", world.file("all")});
  run_program(world.command(out, both));
  EXPECT_EQ(differences(out, world.file("all")), std::vector<std::string>{});
}

TEST(BatchCommand, ALogWithoutAModelIsRefusedBeforeAnyLogIsDiagnosed) {
  const BatchWorld world;
  world.add_logs(4);
  const std::string out = world.file("out");
  const auto refused = [&](std::vector<std::string> models) {
    std::vector<std::string> command{"batch", world.logs(), "-o", out};
    for (const std::string& model : models) command.insert(command.end(), {"--model", model});
    const ProgramRun run = run_program(command);
    EXPECT_EQ(run.status, 2) << run.err;
    EXPECT_FALSE(fs::exists(out));
    return run.err;
  };
  EXPECT_NE(refused({"day_1=" + world.model()}).find("runs/day_2/run_1.csv: 2 of 4 logs have no model"),
            std::string::npos);
  EXPECT_NE(refused({world.model(), "day_3=" + world.model()}).find("no log is below a folder of that name"),
            std::string::npos);
  EXPECT_NE(refused({world.model(), world.model()}).find("twice"), std::string::npos);
  EXPECT_NE(refused({"=" + world.model()}).find("give DIR=MODEL"), std::string::npos);
}

TEST(BatchCommand, ARepeatedBatchRedoesOnlyTheLogsThatAChangeAffects) {
  const BatchWorld world;
  world.add_logs(4);
  const std::string out = world.file("out");
  EXPECT_EQ(done_before(run_program(world.command(out))), 0);
  EXPECT_EQ(done_before(run_program(world.command(out))), 4);
  world.add_log("day_1/run_0.csv", 4.0, true, 7);
  EXPECT_EQ(done_before(run_program(world.command(out))), 3);
  fs::remove(world.logs() + "/day_2/run_1.csv");
  EXPECT_EQ(done_before(run_program(world.command(out))), 3);
  run_program(world.command(world.file("fresh")));
  EXPECT_EQ(differences(out, world.file("fresh")), std::vector<std::string>{});
  const auto results = bytes_below(out + "/logs");
  write_file(out + "/logs/" + results.begin()->first, "{}");
  EXPECT_EQ(done_before(run_program(world.command(out))), 2) << "a damaged result was kept";
  EXPECT_EQ(done_before(run_program(world.command(out, {"--classify", "samples"}))), 0);
  std::string model = read_file(world.model());
  write_file(world.model(), model + "\n");
  EXPECT_EQ(done_before(run_program(world.command(out))), 0) << "results of another model were kept";
}

TEST(BatchCommand, ASecondBatchIntoAFolderInUseIsRefused) {
  const BatchWorld world;
  world.add_logs(1);
  const std::string out = world.file("out");
  run_program(world.command(out));
  const int lock = ::open((out + "/.batch/lock").c_str(), O_RDWR);
  ASSERT_EQ(::flock(lock, LOCK_EX | LOCK_NB), 0);
  const ProgramRun second = run_program(world.command(out));
  EXPECT_EQ(second.status, 3);
  EXPECT_NE(second.err.find("another batch is writing to this folder"), std::string::npos) << second.err;
  ::close(lock);
  EXPECT_EQ(run_program(world.command(out, {"--wait"})).status, 0);
}

TEST(BatchCommand, AFullDiskIsReportedAndFinishedResultsAreKept) {
  const BatchWorld world;
  world.add_logs(6);
  run_program(world.command(world.file("fresh")));
  const std::string out = world.file("out");
  for (const long long limit : {400, 1200, 3000, 6000, 9000}) {
    RunOptions full;
    full.file_size_limit = limit;
    const ProgramRun run = run_program(world.command(out), full);
    EXPECT_EQ(run.status, 3) << limit;
    EXPECT_NE(run.err.find("cannot be"), std::string::npos) << run.err;
  }
  const ProgramRun run = run_program(world.command(out));
  EXPECT_GT(done_before(run), 0) << run.err;
  EXPECT_EQ(differences(out, world.file("fresh")), std::vector<std::string>{});
}

TEST(BatchCommand, UnusableOutputFoldersAndShardsAreRefused) {
  const BatchWorld world;
  world.add_logs(1);
  write_file(world.file("file"), "x");
  EXPECT_EQ(run_program(world.command(world.file("file") + "/below")).status, 3);
  const ProgramRun holds_logs = run_program(world.command(world.logs()));
  EXPECT_EQ(holds_logs.status, 2);
  EXPECT_NE(holds_logs.err.find("holds other files"), std::string::npos) << holds_logs.err;
  EXPECT_EQ(run_program(world.command(world.file("o"), {"--shard", "4/3"})).status, 2);
  EXPECT_EQ(run_program({"batch", world.logs(), "-o", world.file("o")}).status, 2);
  EXPECT_EQ(run_program({"batch", "merge", world.logs(), "-o", world.file("o")}).status, 3);
  EXPECT_EQ(
      run_program({"batch", world.file("none"), "--model", world.model(), "-o", world.file("o")}).status, 3);
  if (::geteuid() == 0) return;  // root may write everywhere
  fs::create_directory(world.file("locked"));
  fs::permissions(world.file("locked"), fs::perms::owner_read | fs::perms::owner_exec);
  const ProgramRun locked = run_program(world.command(world.file("locked")));
  EXPECT_EQ(locked.status, 3) << locked.err;
}

TEST(BatchCommand, ThePageEscapesMarkupInNamesOfLogs) {
  const BatchWorld world;
  world.add_log("<img src=x onerror=alert(1)>\"'&.csv", 4.0, true, 3);
  world.add_log("</script><b>.csv", 4.0, false, 4);
  const std::string out = world.file("out");
  run_program(world.command(out));
  const std::string page = read_file(out + "/index.html");
  EXPECT_EQ(page.find("<img"), std::string::npos);
  EXPECT_EQ(page.find("<b>."), std::string::npos);
  EXPECT_NE(page.find("&lt;img src=x"), std::string::npos);
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
}

}  // namespace
}  // namespace faultline
