// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "formats/log_writer.hpp"
#include "formats/native/native_layout.hpp"
#include "formats/open_log.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/hash.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

constexpr int kRows = 10000;  // many chunks and a shorter one

Log sample_log(int rows = kRows) {
  Log log;
  log.q.resize(2);
  log.tau.resize(2);
  log.extra.resize(1);
  log.extra[0] = {"motor temperature", "K", {}};
  for (int i = 0; i < rows; ++i) {
    log.time.push_back(0.001 * i);
    for (int j = 0; j < 2; ++j) {
      log.q[j].push_back(std::sin(0.01 * i + j) / 3.0);
      log.tau[j].push_back(i % 10 == j ? std::nan("") : 1e-300 * i);
    }
    log.extra[0].values.push_back(300.0 + i);
  }
  return log;
}

constexpr std::size_t kChannels = 6;

/// Rows of the first chunk and bytes that it takes.
const int kFirst = static_cast<int>(native_chunk_rows(0));
const std::size_t kChunkBytes = sizeof(NativeChunkHeader) + kFirst * kChannels * sizeof(double);

struct ReadLog {
  Log log;
  LogIdentity identity;
  Issues issues;
};

ReadLog read(const std::string& path, int segment_rows = 4096) {
  OpenLogOptions options;
  options.segment_rows = segment_rows;
  const auto source = open_log(path, options);
  ReadLog result;
  result.log = read_all(*source);
  result.identity = source->identity();
  result.issues = source->issues();
  EXPECT_EQ(result.identity.rows_read, result.log.rows() + result.issues.rows_dropped());
  EXPECT_EQ(result.identity.sha256, sha256_of_file(path));
  return result;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

/// The bytes of the sample log, and a place to write a damaged copy.
class NativeFormat : public testing::Test {
 protected:
  void SetUp() override {
    write_log(folder_.file("whole.flog"), sample_log());
    bytes_ = read_file(folder_.file("whole.flog"));
    list_ = bytes_.find("CHNK");
  }

  ReadLog read_damaged(const std::string& bytes) { return read(folder_.write("damaged.flog", bytes)); }
  std::string without(std::size_t begin, std::size_t count) const {
    return std::string(bytes_).erase(begin, count);
  }
  std::string why_refused(const std::string& bytes) {
    try {
      read_damaged(bytes);
    } catch (const Error& error) {
      return error.what();
    }
    return "was read";
  }

  TemporaryFolder folder_;
  std::string bytes_;
  std::size_t list_ = 0;  ///< where the first chunk begins
};

TEST_F(NativeFormat, RoundTripIsExact) {
  const auto [log, identity, issues] = read(folder_.file("whole.flog"));
  const Log wanted = sample_log();
  EXPECT_TRUE(issues.empty());
  EXPECT_EQ(identity.format, "native");
  EXPECT_TRUE(same_bits(log.time, wanted.time));
  for (int j = 0; j < 2; ++j) {
    EXPECT_TRUE(same_bits(log.q[j], wanted.q[j]));
    EXPECT_EQ(log.tau[j].size(), wanted.tau[j].size());
    for (int i = 0; i < kRows; ++i)
      ASSERT_TRUE(log.tau[j][i] == wanted.tau[j][i] ||
                  (std::isnan(log.tau[j][i]) && std::isnan(wanted.tau[j][i])));
  }
  ASSERT_EQ(log.extra.size(), 1u);
  EXPECT_EQ(log.extra[0].name, "motor temperature");
  EXPECT_EQ(log.extra[0].unit, "K");
  EXPECT_TRUE(log.dq.empty());
}

TEST_F(NativeFormat, CsvAndBackIsExact) {
  write_log(folder_.file("text.csv"), sample_log());
  const Log from_text = read(folder_.file("text.csv")).log;
  write_log(folder_.file("again.flog"), from_text);
  const Log log = read(folder_.file("again.flog")).log;
  EXPECT_TRUE(same_bits(log.q[1], sample_log().q[1]));
  EXPECT_TRUE(same_bits(log.extra[0].values, sample_log().extra[0].values));
  EXPECT_EQ(log.extra[0].unit, "K");
  EXPECT_EQ(read_file(folder_.file("again.flog")), bytes_);
}

TEST_F(NativeFormat, SegmentsChangeNoByteOfTheFile) {
  for (const int segment_rows : {1, 7, 5000}) {
    const auto source = open_log(folder_.file("whole.flog"), {.segment_rows = segment_rows});
    const auto writer = create_log(folder_.file("copy.flog"));
    Log segment;
    while (source->next(segment)) writer->write(segment);
    writer->commit();
    EXPECT_EQ(read_file(folder_.file("copy.flog")), bytes_) << segment_rows;
  }
}

TEST_F(NativeFormat, ColumnMapDoesNotApply) {
  OpenLogOptions options;
  options.columns["q1"] = {.name = "encoder 1", .unit = "deg"};
  const auto source = open_log(folder_.file("whole.flog"), options);
  EXPECT_TRUE(same_bits(read_all(*source).q[0], sample_log().q[0]));
}

TEST_F(NativeFormat, ChecksumMismatchSkipsTheChunk) {
  bytes_[list_ + kChunkBytes + 100] ^= 1;
  const auto [log, identity, issues] = read_damaged(bytes_);
  EXPECT_EQ(log.rows(), kRows - kFirst);
  EXPECT_EQ(log.time[kFirst], 0.001 * (2 * kFirst));
  ASSERT_NE(issues.find("chunk_damaged"), nullptr);
  EXPECT_EQ(issues.find("chunk_damaged")->rows_dropped, kFirst);
  EXPECT_EQ(issues.find("chunk_damaged")->severity, Severity::severe);
  EXPECT_EQ(issues.find("chunk_damaged")->first_row, kFirst + 1);
  EXPECT_EQ(identity.rows_read, kRows);
}

TEST_F(NativeFormat, ReadingContinuesAtTheNextChunkAfterADamagedHeader) {
  bytes_[list_ + 5] ^= 1;
  const auto [log, identity, issues] = read_damaged(bytes_);
  EXPECT_EQ(log.rows(), kRows - kFirst);
  EXPECT_EQ(issues.rows_dropped(), kFirst);
  EXPECT_EQ(identity.rows_read, kRows);
}

TEST_F(NativeFormat, MissingBytesLoseOnlyTheirChunk) {
  const std::size_t second = list_ + kChunkBytes;
  for (const std::size_t missing : {1, 31, 33, 100}) {
    const auto [log, identity, issues] = read_damaged(without(second + 50, missing));
    EXPECT_EQ(log.rows(), kRows - kFirst) << missing;
    EXPECT_EQ(issues.rows_dropped(), kFirst) << missing;
    EXPECT_EQ(issues.find("file_truncated"), nullptr) << missing;
  }
}

TEST_F(NativeFormat, MissingBytesInTheLastChunkKeepTheEndMark) {
  const auto [log, identity, issues] = read_damaged(without(bytes_.size() - 500, 100));
  ASSERT_NE(issues.find("chunk_damaged"), nullptr);
  EXPECT_EQ(issues.find("file_truncated"), nullptr);
  EXPECT_LE(issues.rows_dropped(), 256);
  EXPECT_EQ(identity.rows_read, kRows);
}

TEST_F(NativeFormat, AMissingChunkIsReported) {
  const auto [log, identity, issues] = read_damaged(without(list_, kChunkBytes));
  EXPECT_EQ(log.rows(), kRows - kFirst);
  ASSERT_NE(issues.find("chunk_damaged"), nullptr);
  EXPECT_NE(issues.find("chunk_damaged")->message.find("chunks are missing"), std::string::npos);
  EXPECT_EQ(identity.rows_read, kRows);
}

TEST_F(NativeFormat, TruncatedTailKeepsWholeChunks) {
  const auto [log, identity, issues] = read_damaged(bytes_.substr(0, list_ + kChunkBytes + 200));
  EXPECT_EQ(log.rows(), kFirst);
  ASSERT_NE(issues.find("file_truncated"), nullptr);
  EXPECT_EQ(issues.find("file_truncated")->rows_dropped, kFirst);
  EXPECT_NE(issues.find("file_truncated")->message.find("its 8 rows"), std::string::npos);
}

TEST_F(NativeFormat, TruncationBetweenChunksIsReported) {
  const auto [log, identity, issues] = read_damaged(bytes_.substr(0, list_ + kChunkBytes));
  EXPECT_EQ(log.rows(), kFirst);
  EXPECT_NE(issues.find("file_truncated"), nullptr);
}

TEST_F(NativeFormat, TruncatedEndMarkKeepsAllRows) {
  const auto [log, identity, issues] = read_damaged(bytes_.substr(0, bytes_.size() - 5));
  EXPECT_EQ(log.rows(), kRows);
  ASSERT_NE(issues.find("file_truncated"), nullptr);
  EXPECT_NE(issues.find("file_truncated")->message.find("27 bytes"), std::string::npos);
}

TEST_F(NativeFormat, BytesAfterTheEndMarkAreReported) {
  const auto [log, identity, issues] = read_damaged(bytes_ + "more");
  EXPECT_EQ(log.rows(), kRows);
  EXPECT_NE(issues.find("trailing_bytes"), nullptr);
}

TEST_F(NativeFormat, NewerVersionIsRefused) {
  bytes_[8] = bytes_[list_ / 2 + 8] = 3;
  const std::string why = why_refused(bytes_);
  EXPECT_NE(why.find("version 3"), std::string::npos) << why;
  EXPECT_NE(why.find("newer faultline"), std::string::npos) << why;
}

TEST_F(NativeFormat, OneDamagedFileHeaderIsReadFromItsCopy) {
  for (const std::size_t place :
       {std::size_t{0}, std::size_t{8}, std::size_t{14}, std::size_t{20}, list_ - 30}) {
    std::string bytes = bytes_;
    bytes[place] ^= 1;
    const auto [log, identity, issues] = read_damaged(bytes);
    EXPECT_EQ(log.rows(), kRows) << place;
    EXPECT_TRUE(same_bits(log.q[1], sample_log().q[1])) << place;
    ASSERT_NE(issues.find("header_damaged"), nullptr) << place;
    EXPECT_EQ(issues.all().size(), 1u) << place;
  }
}

TEST_F(NativeFormat, BytesMissingInAFileHeaderLoseNoRow) {
  for (const std::size_t place : {std::size_t{4}, std::size_t{30}, list_ / 2 + 2, list_ - 40})
    for (const std::size_t missing : {1, 33}) {
      const auto [log, identity, issues] = read_damaged(without(place, missing));
      EXPECT_EQ(log.rows(), kRows) << place;
      EXPECT_NE(issues.find("header_damaged"), nullptr) << place;
    }
}

TEST_F(NativeFormat, DamageInBothFileHeadersIsRefused) {
  bytes_[20] ^= 1;
  bytes_[list_ / 2 + 20] ^= 1;
  EXPECT_NE(why_refused(bytes_).find("damaged header"), std::string::npos);
  bytes_[14] = '\x7f';
  EXPECT_NE(why_refused(bytes_).find("damaged header"), std::string::npos);
}

TEST_F(NativeFormat, FileCutInsideItsHeaderIsRefused) {
  EXPECT_NE(why_refused(bytes_.substr(0, 12)).find("cut inside its header"), std::string::npos);
}

TEST_F(NativeFormat, RewindReadsTheSameAgain) {
  bytes_[list_ + 100] ^= 1;
  const auto source = open_log(folder_.write("damaged.flog", bytes_));
  const Log first = read_all(*source);
  source->rewind();
  EXPECT_TRUE(source->issues().empty());
  EXPECT_TRUE(same_bits(read_all(*source).time, first.time));
  EXPECT_EQ(source->identity().rows_read, kRows);
}

TEST(WriteLog, UnknownExtensionIsAUsageError) {
  try {
    create_log("x.xyz");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    EXPECT_NE(error.message().find(".flog"), std::string::npos);
  }
}

}  // namespace
}  // namespace faultline
