// SPDX-License-Identifier: MIT
#include "formats/provenance.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "formats/log_writer.hpp"
#include "formats/native/native_layout.hpp"
#include "formats/open_log.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/hash.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

Log long_log() {
  Log log;
  log.q.resize(1);
  for (int i = 0; i < 10000; ++i) {
    log.time.push_back(0.001 * i);
    log.q[0].push_back(i / 3.0);
  }
  return log;
}

struct ReadLog {
  Log log;
  LogIdentity identity;
  Issues issues;
};

ReadLog read(const std::string& path) {
  const auto source = open_log(path);
  ReadLog result{read_all(*source), {}, {}};
  result.identity = source->identity();
  result.issues = source->issues();
  return result;
}

/// A native log with a flipped bit in its middle.
class DamagedLog : public testing::Test {
 protected:
  DamagedLog() {
    write_log(damaged_, long_log());
    std::string bytes = read_file(damaged_);
    bytes[bytes.size() / 2] ^= 1;
    write_file(damaged_, bytes);
  }

  TemporaryFolder folder_;
  std::string damaged_ = folder_.file("damaged.flog");
};

TEST_F(DamagedLog, EachCopyAndItsCopiesReportTheLossesOfTheOriginal) {
  const ReadLog original = read(damaged_);
  ASSERT_GT(original.issues.rows_dropped(), 0);
  std::string from = damaged_;
  for (const char* name : {"copy.csv", "copy.flog", "again.csv"}) {
    const std::string to = folder_.file(name), before_sha = sha256_of_file(from);
    const ProgramRun run = run_program({"convert", from, to});
    EXPECT_EQ(run.status, 1) << run.err;
    const ReadLog copy = read(to);
    EXPECT_EQ(copy.log.q[0], original.log.q[0]);
    EXPECT_EQ(copy.identity.rows_read, copy.log.rows());
    EXPECT_EQ(copy.identity.sha256, sha256_of_file(to));
    const Issue* told = copy.issues.find("source_damaged");
    ASSERT_TRUE(told) << name;
    EXPECT_EQ(told->severity, Severity::severe);
    EXPECT_NE(told->message.find(before_sha), std::string::npos) << told->message;
    EXPECT_NE(told->message.find("left out"), std::string::npos) << told->message;
    EXPECT_EQ(run_program({"inspect", to}).status, 1);
    from = to;
  }
}

TEST_F(DamagedLog, TheCopyReadsAgainAfterRewinding) {
  ASSERT_EQ(run_program({"convert", damaged_, folder_.file("copy.flog")}).status, 1);
  const auto source = open_log(folder_.file("copy.flog"));
  const int rows = read_all(*source).rows();
  source->rewind();
  EXPECT_EQ(read_all(*source).rows(), rows);
  ASSERT_TRUE(source->issues().find("source_damaged"));
  EXPECT_EQ(source->issues().find("source_damaged")->count, 1);
}

TEST_F(DamagedLog, DamagedProvenanceIsReported) {
  ASSERT_EQ(run_program({"convert", damaged_, folder_.file("copy.csv")}).status, 1);
  const std::string bytes = read_file(folder_.file("copy.csv"));
  folder_.write("cut.csv", bytes.substr(0, bytes.size() - 20));
  const ReadLog copy = read(folder_.file("cut.csv"));
  ASSERT_TRUE(copy.issues.find("provenance_damaged"));
  EXPECT_EQ(copy.issues.find("provenance_damaged")->severity, Severity::severe);
}

/// Whatever becomes of the block in a native log, all rows are read and the damage is told.
TEST_F(DamagedLog, AFlippedBitInNativeProvenanceLosesNoRowAndIsReported) {
  ASSERT_EQ(run_program({"convert", damaged_, folder_.file("copy.flog")}).status, 1);
  const std::string bytes = read_file(folder_.file("copy.flog"));
  const std::size_t block = bytes.find("PROV"), text = block + sizeof(NativeChunkHeader);
  ASSERT_NE(block, std::string::npos);
  const int rows = read(folder_.file("copy.flog")).log.rows();
  for (const std::size_t at : {block, block + 5, text - 1, text, bytes.size() - 40}) {
    std::string bad = bytes;
    bad[at] ^= 1;
    folder_.write("bad.flog", bad);
    const ReadLog copy = read(folder_.file("bad.flog"));
    EXPECT_EQ(copy.log.rows(), rows) << at;
    EXPECT_EQ(copy.identity.sha256, sha256_of_file(folder_.file("bad.flog"))) << at;
    ASSERT_TRUE(copy.issues.find("chunk_damaged")) << at;
    EXPECT_EQ(copy.issues.find("provenance_damaged") != nullptr, at >= text) << at;
    EXPECT_FALSE(copy.issues.find("file_truncated")) << at;
  }
}

TEST_F(DamagedLog, CutNativeProvenanceIsReported) {
  ASSERT_EQ(run_program({"convert", damaged_, folder_.file("copy.flog")}).status, 1);
  const std::string bytes = read_file(folder_.file("copy.flog"));
  folder_.write("cut.flog", bytes.substr(0, bytes.size() - sizeof(NativeChunkHeader) - 20));
  const ReadLog copy = read(folder_.file("cut.flog"));
  EXPECT_EQ(copy.log.rows(), read(folder_.file("copy.flog")).log.rows());
  EXPECT_TRUE(copy.issues.find("provenance_damaged"));
  EXPECT_TRUE(copy.issues.find("file_truncated"));
}

/// Chunks that were lost before the block are counted as before any other header.
TEST_F(DamagedLog, LostChunksBeforeTheProvenanceAreCounted) {
  ASSERT_EQ(run_program({"convert", damaged_, folder_.file("copy.flog")}).status, 1);
  std::string bytes = read_file(folder_.file("copy.flog"));
  const std::size_t last = bytes.rfind("CHNK"), block = bytes.find("PROV");
  folder_.write("less.flog", bytes.erase(last, block - last));
  const ReadLog copy = read(folder_.file("less.flog"));
  EXPECT_GT(copy.issues.rows_dropped(), 0);
  EXPECT_EQ(copy.identity.rows_read, read(folder_.file("copy.flog")).identity.rows_read);
  EXPECT_TRUE(copy.issues.find("source_damaged"));
}

TEST(Provenance, ACompleteLogHasNoProvenance) {
  const TemporaryFolder folder;
  write_log(folder.file("a.flog"), long_log());
  ASSERT_EQ(run_program({"convert", folder.file("a.flog"), folder.file("b.csv")}).status, 0);
  EXPECT_EQ(read_file(folder.file("b.csv")).find("provenance"), std::string::npos);
}

TEST(Provenance, LostValuesAreReported) {
  const TemporaryFolder folder;
  const std::string log = folder.write("a.csv", "t,q1\n0,1\n1,2x\n2,3\n");
  EXPECT_EQ(run_program({"convert", log, folder.file("b.csv")}).status, 1);
  const ReadLog copy = read(folder.file("b.csv"));
  ASSERT_TRUE(copy.issues.find("source_damaged"));
  EXPECT_EQ(copy.issues.find("source_damaged")->severity, Severity::warning);
}

TEST(Provenance, HostileNamesAndTextsStayOneShortLine) {
  const TemporaryFolder folder;
  const std::string bad(70000, '\x1b');
  const std::string log = folder.write("a\nb.csv", "t,q1\n0,1\n1," + bad + "\n2,3\n");
  ASSERT_EQ(run_program({"convert", log, folder.file("b.csv")}).status, 1);
  const std::string text = read_file(folder.file("b.csv"));
  const std::string line = text.substr(text.find('#'));
  EXPECT_EQ(line.find('\n'), line.size() - 1);
  EXPECT_LT(line.size(), 60000u);
  EXPECT_EQ(line.find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace faultline
