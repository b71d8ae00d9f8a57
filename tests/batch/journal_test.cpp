// SPDX-License-Identifier: MIT
#include "lib/batch/journal.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/batch/appended_lines.hpp"
#include "lib/batch/batch_index.hpp"
#include "lib/core/atomic_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

JournalEntry entry(const std::string& key, int position) {
  JournalEntry made;
  made.key = key;
  made.position = position;
  made.json_sha = "abc";
  made.row.log = "runs/" + key + " \"x\", \n.csv";
  made.row.result = "runs_" + key;
  made.row.verdict = "faulty";
  made.row.residual_rms = {1.0 / 3.0, std::nan("")};
  made.row.faults = {{{FaultKind::locked, 2_joint}, 0.1, 0.2, std::nan(""), 0.75}};
  return made;
}

TEST(Journal, EntriesAreReadBackUnchanged) {
  const TemporaryFolder folder;
  {
    AppendedLines journal(folder.file("journal"));
    journal.add(to_journal_line(entry("a", 0)));
    journal.add(to_journal_line(entry("b", 1)));
  }
  const auto read = read_journal(folder.file("journal"));
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(to_journal_line(read.at("a")), to_journal_line(entry("a", 0)));
  EXPECT_EQ(read.at("b").row.result, "runs_b");
}

TEST(Journal, ACutLineIsIgnoredAndAffectsNoOtherLine) {
  const TemporaryFolder folder;
  const std::string first = to_journal_line(entry("a", 0)), second = to_journal_line(entry("b", 1));
  for (std::size_t cut = 0; cut + 1 < second.size(); cut += 7) {
    const std::string path = folder.write("journal", "\n" + first + second.substr(0, cut));
    AppendedLines(path).add(to_journal_line(entry("c", 2)));
    const auto read = read_journal(path);
    EXPECT_EQ(read.count("a"), 1u) << cut;
    EXPECT_EQ(read.count("b"), 0u) << cut;
    EXPECT_EQ(read.count("c"), 1u) << cut;
  }
}

TEST(Journal, ALineWithAChangedByteIsIgnored) {
  const TemporaryFolder folder;
  std::string line = to_journal_line(entry("a", 0));
  line[line.find("faulty")] = 'F';
  EXPECT_TRUE(read_journal(folder.write("journal", line)).empty());
}

TEST(GrowingFile, KeepsEqualLinesAndRewritesFromTheFirstDifference) {
  const TemporaryFolder folder;
  const std::string path = folder.write("index", "one\ntwo\nthree\nfour\nto");
  GrowingFile file(path);
  file.append("one\n");
  EXPECT_EQ(read_file(path), "one\ntwo\nthree\nfour\nto");
  file.append("2\n");
  EXPECT_EQ(read_file(path), "one\n2\n");
  file.append("three\n");
  file.finish();
  EXPECT_EQ(read_file(path), "one\n2\nthree\n");
  GrowingFile shorter(path);
  shorter.append("one\n");
  shorter.finish();
  EXPECT_EQ(read_file(path), "one\n");
}

}  // namespace
}  // namespace faultline
