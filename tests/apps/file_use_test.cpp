// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "tests/apps/golden_copy.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

const std::string kSpec =
    "robot = \"arm.csv\"\nduration_s = 1.0\n[[run]]\nname = \"arm\"\n[[run]]\nname = \"other\"\n";

const std::string kLog = "t,q1,dq1,tau1\n0,0.1,0.25,1\n0.1,0.125,0.25,2\n0.2,0.15,0.25,0.1\n";

/// Files that hold one word each, so that only a check before all work can be the first to speak.
class FileUseOfCommands : public testing::Test {
 protected:
  FileUseOfCommands() {
    for (const char* folder : {"runs", "out/.batch", "spec", "specs", "made", "pictures"})
      fs::create_directories(folder_.path() / folder);
    for (const char* name :
         {"a.csv", "b.csv", "robot.toml", "labels.csv", "m", "m.cases.db", "c.db", "cases.json",
          "report.json", "runs/a.csv", "out/summary.json", "out/index.csv", "made/golden.toml"})
      folder_.write(name, std::string("bytes of ") + name);
    folder_.write("spec/labels.csv", "robot = \"RRP\"\nduration_s = 1.0\n[[run]]\nname = \"a\"\n");
    folder_.write("specs/spec.toml", kSpec);
    folder_.write("specs/arm.csv", "axes = \"RRP\"\n");
    fs::create_symlink("a.csv", folder_.path() / "link.csv");
    fs::create_symlink("not_yet.json", folder_.path() / "link_to_nothing.json");
    fs::create_hard_link(folder_.path() / "a.csv", folder_.path() / "hard.csv");
  }

  std::map<std::string, std::string> bytes() const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path()))
      all[entry.path().string()] = entry.is_regular_file() ? read_file(entry.path().string()) : "";
    return all;
  }

  /// @NAME stands for the file of this name in the folder.
  ProgramRun run(std::vector<std::string> arguments, const RunOptions& options = {}) const {
    for (std::string& argument : arguments)
      if (argument.starts_with("@")) argument = folder_.file(argument.substr(1));
    return run_program(arguments, options);
  }

  void expect_refused(const std::vector<std::string>& arguments,
                      const std::vector<std::string>& words) const {
    const auto before = bytes();
    const ProgramRun result = run(arguments);
    std::string line;
    for (const std::string& argument : arguments) line += argument + " ";
    EXPECT_EQ(result.status, 2) << line << result.err;
    EXPECT_EQ(result.out, "") << line;
    for (const std::string& word : words)
      EXPECT_NE(result.err.find(word), std::string::npos) << line << "\n" << word << " in: " << result.err;
    EXPECT_EQ(bytes(), before) << line;
  }

  TemporaryFolder folder_;
};

TEST_F(FileUseOfCommands, ConvertAndInspectKeepTheirInputs) {
  for (const char* out : {"@a.csv", "@link.csv", "@hard.csv", "@runs/../a.csv"})
    expect_refused({"convert", "@a.csv", out}, {"OUT", "would overwrite the log", "a.csv"});
  expect_refused({"convert", "@a.csv", "@robot.toml", "--robot", "@robot.toml"}, {"the robot file"});
  expect_refused({"inspect", "@a.csv", "@b.csv", "--json", "@b.csv"}, {"--json", "the log", "b.csv"});
}

TEST_F(FileUseOfCommands, TheDataFileBesideAHeaderIsAnInput) {
  folder_.write("trace.dat",
                "DIAEXTENDED\n#BEGINCHANNELHEADER\n200,q1\n210,EXPLIZIT\n211,Trace.csv\n213,BLOCK\n"
                "214,REAL64\n220,2\n221,1\n#ENDCHANNELHEADER\n");
  folder_.write("trace.csv", "0123456789abcdef");
  expect_refused({"convert", "@trace.dat", "@trace.csv"},
                 {"OUT", "would overwrite the data file of the log", "trace.csv"});
  expect_refused({"inspect", "@trace.dat", "--json", "@trace.csv"}, {"--json", "the data file of the log"});
}

TEST_F(FileUseOfCommands, DiagnoseKeepsTheLogTheModelAndItsCases) {
  const std::vector<std::string> diagnose = {"diagnose", "@a.csv", "--model", "@m"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), diagnose.begin(), diagnose.end());
    return more;
  };
  expect_refused(with({"--json", "@a.csv"}), {"--json", "the log"});
  expect_refused(with({"--csv", "@m"}), {"--csv", "the model"});
  expect_refused(with({"--html", "@m.cases.db"}), {"--html", "the case base"});
  expect_refused(with({"--junit", "@m.cases.db-journal"}), {"--junit", "the case base's journal"});
  expect_refused(with({"--json", "@m.cases.db-wal"}), {"the case base's journal"});
  expect_refused(with({"--json", "@c.db", "--cases", "@c.db"}), {"the case base"});
  expect_refused(with({"--json", "@new", "--csv", "@new"}), {"is also the file of --json"});
  expect_refused(with({"--json", "@link_to_nothing.json", "--html", "@not_yet.json"}),
                 {"is also the file of --json"});
  expect_refused(with({"--json", "-", "--csv", "-"}), {"is also the file of --json"});
}

TEST_F(FileUseOfCommands, IdentifyKeepsItsInputs) {
  const std::vector<std::string> identify = {"identify", "@a.csv", "@b.csv", "--robot", "@robot.toml", "-o"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), identify.begin(), identify.end());
    return more;
  };
  expect_refused(with({"@b.csv"}), {"-o", "the log", "b.csv"});
  expect_refused(with({"@robot.toml"}), {"-o", "the robot file"});
  expect_refused(with({"@new", "--json", "@new"}), {"--json", "is also the file of -o"});
  expect_refused(with({"@new", "--suggest", "@a.csv"}), {"--suggest", "the log"});
  expect_refused(with({"@new", "--html", "@pictures/a.svg", "--pictures", "@pictures"}), {"--pictures"});
}

TEST_F(FileUseOfCommands, LearnKeepsItsInputs) {
  const std::vector<std::string> learn = {"learn",       "@a.csv",   "--robot",
                                          "@robot.toml", "--labels", "@labels.csv"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), learn.begin(), learn.end());
    return more;
  };
  expect_refused(with({"-o", "@a.csv"}), {"-o", "the log"});
  expect_refused(with({"-o", "@robot.toml"}), {"-o", "the robot file"});
  expect_refused(with({"-o", "@labels.csv"}), {"-o", "the labels"});
  expect_refused(with({"-o", "@new", "--cases", "@a.csv"}), {"--cases", "the log"});
  expect_refused(with({"-o", "@new", "--cases", "@new"}), {"--cases", "is also the file of -o"});
  expect_refused(with({"-o", "@new", "--json", "@new.cases.db"}), {"--json", "is also the file of --cases"});
  expect_refused(with({"-o", "@new", "--json", "@new.cases.db-journal"}), {"--json", "--cases"});
}

TEST_F(FileUseOfCommands, CasesKeepTheCaseBaseTheModelAndTheirInputs) {
  expect_refused({"cases", "export", "--cases", "@c.db", "-o", "@c.db"}, {"-o", "the case base"});
  expect_refused({"cases", "export", "--cases", "@c.db", "-o", "@c.db-wal"}, {"the case base's journal"});
  expect_refused({"cases", "export", "--model", "@m", "-o", "@m"}, {"-o", "the model"});
  expect_refused({"cases", "import", "@cases.json", "--cases", "@cases.json", "--replace"}, {"the export"});
  expect_refused({"cases", "add", "@report.json", "--cases", "@report.json"}, {"the report"});
}

TEST_F(FileUseOfCommands, BatchKeepsItsInputsAndItsOwnResults) {
  const auto batch = [](const std::string& json) {
    return std::vector<std::string>{"batch", "@runs", "--model", "@m", "-o", "@out", "--json", json};
  };
  expect_refused(batch("@m"), {"--json", "the model"});
  expect_refused(batch("@runs/a.csv"), {"--json", "the log"});
  expect_refused(batch("@out/index.csv"), {"--json", "is also the file of -o"});
  expect_refused(batch("@out/logs/a.json"), {"--json", "lies among the files that -o writes"});
  expect_refused({"batch", "merge", "@out", "-o", "@out"}, {"-o", "the results of a shard"});
  expect_refused({"batch", "merge", "@out", "-o", "@all", "--json", "@out/summary.json"},
                 {"--json", "shard"});
}

/// Each command with each of its options that name a file to write, which stands for @@.
const std::vector<std::vector<std::string>> kWritingCommands = {
    {"inspect", "@a.csv", "--json", "@@"},
    {"inspect", "@a.csv", "--html", "@@"},
    {"inspect", "@a.csv", "--suggest", "@@"},
    {"convert", "@a.csv", "@@"},
    {"compare", "@a.csv", "@b.csv", "--model", "@m", "--html", "@@"},
    {"compare", "@a.csv", "@b.csv", "--model", "@m", "--json", "@@"},
    {"compare", "@a.csv", "@b.csv", "--html", "@@"},
    {"diagnose", "@a.csv", "--model", "@m", "--json", "@@"},
    {"diagnose", "@a.csv", "--model", "@m", "--html", "@@"},
    {"diagnose", "@a.csv", "--model", "@m", "--csv", "@@"},
    {"diagnose", "@a.csv", "--model", "@m", "--junit", "@@"},
    {"diagnose", "@a.csv", "--model", "@m", "--mcap", "@@"},
    {"identify", "@a.csv", "--robot", "@robot.toml", "-o", "@@"},
    {"identify", "@a.csv", "--robot", "@robot.toml", "-o", "@new.toml", "--json", "@@"},
    {"identify", "@a.csv", "--robot", "@robot.toml", "-o", "@new.toml", "--html", "@@"},
    {"identify", "@a.csv", "--robot", "@robot.toml", "-o", "@new.toml", "--suggest", "@@"},
    {"learn", "@a.csv", "--robot", "@robot.toml", "-o", "@@"},
    {"learn", "@a.csv", "--robot", "@robot.toml", "-o", "@new", "--json", "@@"},
    {"batch", "@runs", "--model", "@m", "-o", "@new", "--json", "@@"},
    {"batch", "merge", "@out", "-o", "@new", "--json", "@@"},
    {"cases", "export", "--model", "@m", "-o", "@@"},
    {"golden", "check", "@golden", "--json", "@@"},
    {"golden", "check", "@golden", "--junit", "@@"},
    {"golden", "compare", "@golden", "@m", "--json", "@@"},
};

/// Of the model that a command reads, of another model, of a batch and of golden logs.
const std::vector<std::string> kKeptFiles = {"m.cases.db", "other.cases.db-wal", "out/.batch/journal",
                                             "made/logs/a.csv"};

TEST_F(FileUseOfCommands, NoCommandOverwritesFilesOfAModelABatchOrGoldenLogs) {
  fs::copy(FAULTLINE_SOURCE_DIR "/sample_logs/golden", folder_.path() / "golden",
           fs::copy_options::recursive);
  fs::create_directories(folder_.path() / "made/logs");
  for (const char* name : {"m.cases.db-journal", "out/.batch/journal", "made/logs/a.csv"})
    folder_.write(name, std::string("bytes of ") + name);
  for (const std::vector<std::string>& command : kWritingCommands)
    for (const std::string& kept : kKeptFiles) {
      std::vector<std::string> arguments = command;
      std::replace(arguments.begin(), arguments.end(), std::string("@@"), "@" + kept);
      expect_refused(arguments, {folder_.file(kept)});
    }
  for (const char* kept : {"made/golden.toml", "made/model-01234567.json", "made/cases-01234567.db",
                           "made/cases-01234567.db-wal", "out/.batch/finished.json", "new.cases.db"}) {
    if (std::string(kept) != "new.cases.db") folder_.write(kept, "x");
    expect_refused({"convert", "@a.csv", std::string("@") + kept}, {"would replace"});
  }
}

TEST_F(FileUseOfCommands, ANewFileMayLieAmongGoldenLogs) {
  folder_.write("log.csv", kLog);
  fs::create_directories(folder_.path() / "made/logs");
  EXPECT_EQ(run({"convert", "@log.csv", "@made/logs/new.csv"}).status, 0);
  EXPECT_EQ(run({"inspect", "@log.csv", "--json", "@made/report.json"}).status, 0);
  EXPECT_EQ(run({"inspect", "@log.csv", "--json", "@made/report.json"}).status, 0);
}

TEST_F(FileUseOfCommands, SimulateKeepsItsSpecAndItsRobot) {
  expect_refused({"simulate", "@spec/labels.csv", "-o", "@spec"}, {"the labels", "the spec"});
  expect_refused({"simulate", "@specs/spec.toml", "-o", "@specs"}, {"the run arm", "the robot file"});
}

TEST_F(FileUseOfCommands, GoldenKeepsItsFolderAndItsInputs) {
  expect_refused({"golden", "record", "@a.csv", "--model", "@made/golden.toml", "-o", "@made"},
                 {"the model"});
  const GoldenCopy golden;
  const auto before = golden.snapshot();
  for (const std::string& out :
       {golden.toml(), golden.file("logs", "locked"), golden.file("traces", "locked"),
        golden.file("", "model-"), golden.file("", "cases-") + "-journal"})
    for (const char* option : {"--json", "--junit"}) {
      const ProgramRun check = golden.run("check", {option, out});
      EXPECT_EQ(check.status, 2) << check.err;
      EXPECT_NE(check.err.find("would overwrite"), std::string::npos) << check.err;
    }
  const std::string side = golden.outside("side.json");
  write_file(side, "{}");
  EXPECT_EQ(golden.run("compare", {side, "--json", side}).status, 2);
  EXPECT_EQ(read_file(side), "{}");
  EXPECT_EQ(golden.snapshot(), before);
}

TEST_F(FileUseOfCommands, StandardOutputDirectedIntoAFileOfTheCommandIsRefused) {
  const std::string out = folder_.file("out.json");
  const ProgramRun result = run({"inspect", "@a.csv", "--json", "@out.json"}, {.stdout_path = out});
  EXPECT_EQ(result.status, 2) << result.err;
  EXPECT_NE(result.err.find("standard output"), std::string::npos) << result.err;
}

TEST_F(FileUseOfCommands, DevicesAndExistingOutputFilesAreAccepted) {
  folder_.write("log.csv", kLog);
  folder_.write("old.csv", "old");
  EXPECT_EQ(run({"inspect", "@log.csv", "--json", "/dev/null"}).status, 0);
  EXPECT_EQ(run({"convert", "@log.csv", "@old.csv"}).status, 0);
  EXPECT_EQ(read_file(folder_.file("old.csv")), kLog);
}

TEST_F(FileUseOfCommands, TheOpenFileBehindDevStdoutIsWrittenNotReplaced) {
  folder_.write("log.csv", kLog);
  const ProgramRun result = run({"inspect", "@log.csv", "--json", "/dev/stdout"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out.rfind("{", 0), 0u) << result.out;
  EXPECT_TRUE(fs::is_symlink("/dev/stdout"));
}

}  // namespace
}  // namespace faultline
