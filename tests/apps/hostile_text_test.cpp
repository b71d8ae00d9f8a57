// SPDX-License-Identifier: MIT
// What a log, a robot file or a path is called must not reach the terminal as commands, nor fill it.
#include <gtest/gtest.h>

#include <string>

#include "lib/core/atomic_file.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

const std::string kCommand =
    "\x1b]0;owned\x07\x1b[2J\xc2\x9b"
    "31m\xe2\x80\xae";
constexpr std::size_t kLongName = 1 << 16;
constexpr std::size_t kMostShown = 12000;

void expect_harmless(const ProgramRun& run) {
  for (const std::string& text : {run.out, run.err}) {
    for (const char* command : {"\x1b", "\x07", "\x7f", "\xc2\x9b", "\xe2\x80\xae", "\r"})
      EXPECT_EQ(text.find(command), std::string::npos) << text;
    EXPECT_LT(text.size(), kMostShown);
  }
}

TEST(HostileText, ColumnNamesAndCellsCannotControlATerminal) {
  const TemporaryFolder folder;
  const std::string log =
      folder.write("run.csv", "t,q1,tau1 [" + kCommand + "],x" + kCommand + ",s\n0,1," + kCommand +
                                  ",2,3\n1,2,3,4," + kCommand + "\n2,3\n3,3,4,5,6,7" + kCommand + "\n");
  const ProgramRun inspected = run_program({"inspect", log});
  EXPECT_NE(inspected.out.find("]0;owned"), std::string::npos) << "it is shown, without its effect";
  expect_harmless(inspected);
  expect_harmless(run_program({"inspect", log, "--json", "-"}));
  expect_harmless(run_program({"convert", log, "-"}));
  expect_harmless(run_program({"convert", log, folder.file("a.flog")}));
  expect_harmless(run_program({"inspect", folder.file("a.flog")}));
}

TEST(HostileText, PathsAndOptionsCannotControlATerminal) {
  const TemporaryFolder folder;
  const std::string log = folder.write("run" + kCommand + "\n.csv", "t,q1\n0,1\n1,2\n");
  expect_harmless(run_program({"inspect", log}));
  expect_harmless(run_program({"convert", log, folder.file("out" + kCommand + ".csv")}));
  expect_harmless(run_program({"inspect", folder.file("missing" + kCommand)}));
  expect_harmless(run_program({"inspect", log, "--" + kCommand}));
  expect_harmless(run_program({kCommand}));
}

TEST(HostileText, KeysOfARobotFileCannotControlATerminal) {
  const TemporaryFolder folder;
  const std::string log = folder.write("run.csv", "t,q1\n0,1\n1,2\n");
  const std::string escaped = "\\u001b]0;owned\\u0007\\u009b";
  for (const std::string& robot : {"axes = \"R\"\n\"" + escaped + "\" = 1\n", "axes = \"" + escaped + "\"\n",
                                   "axes = \"R\"\n[log.columns]\nq1 = {name = \"" + escaped + "\"}\n",
                                   "axes = \"R\"\n[log.columns]\nq1 = {unit = \"" + escaped + "\"}\n"})
    expect_harmless(run_program({"inspect", log, "--robot", folder.write("robot.toml", robot)}));
}

TEST(HostileText, LongNamesAreShortened) {
  const TemporaryFolder folder;
  const std::string name(kLongName, 'n');
  for (const std::string& header : {"t,q1," + name, "t," + name, name + ",q1,q1", "t,q1,q2 [" + name + "]",
                                    "t,q1," + name + "," + name, "q1," + name + " t"}) {
    const std::string log = folder.write("run.csv", header + "\n0,1,2\n1,2,x" + name + "\n2,3,4\n");
    expect_harmless(run_program({"inspect", log}));
    expect_harmless(run_program({"convert", log, folder.file("a.flog")}));
  }
}

TEST(HostileText, NamesOfAConvertedTableAreNotFormulas) {
  const TemporaryFolder folder;
  const std::string log = folder.write("run.csv", "t,q1,=cmd|' /C calc'!A0,-x\n0,1,2,3\n1,2,3,4\n");
  const ProgramRun run = run_program({"convert", log, folder.file("a.csv")});
  EXPECT_EQ(run.status, 0) << run.err;
  const std::string table = read_file(folder.file("a.csv"));
  EXPECT_EQ(table.substr(0, table.find('\n')), "t,q1,\"'=cmd|' /C calc'!A0\",'-x");
  EXPECT_NE(run_program({"inspect", folder.file("a.csv")}).out.find(" =cmd|"), std::string::npos)
      << "read again it has the name it had";
  run_program({"convert", folder.file("a.csv"), folder.file("b.csv")});
  EXPECT_EQ(read_file(folder.file("b.csv")), table);
}

}  // namespace
}  // namespace faultline
