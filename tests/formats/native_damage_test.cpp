// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "formats/log_writer.hpp"
#include "formats/native/native_layout.hpp"
#include "formats/open_log.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "tests/formats/native_bytes.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

constexpr int kShort = 274;
const std::string kList = "t\t\nq1\t\n";

double time_of(int row) { return 0.01 * row; }
double position_of(int row, int joint) { return std::sin(0.1 * row + joint); }

Log short_log() {
  Log log;
  for (JointSignals* signals : {&log.q, &log.dq, &log.tau}) signals->resize(3);
  for (int i = 0; i < kShort; ++i) {
    log.time.push_back(time_of(i));
    for (int j = 0; j < 3; ++j) {
      log.q[j].push_back(position_of(i, j));
      log.dq[j].push_back(1.0 + i);
      log.tau[j].push_back(2.0 + i);
    }
  }
  return log;
}

/// What was read, or why nothing was.
struct Outcome {
  Log log;
  Issues issues;
  std::int64_t rows_read = 0;
  std::string refused;
};

class NativeDamage : public testing::Test {
 protected:
  void SetUp() override {
    write_log(folder_.file("whole.flog"), short_log());
    bytes_ = read_file(folder_.file("whole.flog"));
  }

  Outcome read(const std::string& bytes) {
    Outcome outcome;
    try {
      const auto source = open_log(folder_.write("damaged.flog", bytes));
      Log segment;
      while (source->next(segment)) append(outcome.log, segment);
      outcome.issues = source->issues();
      outcome.rows_read = source->identity().rows_read;
    } catch (const Error& error) {
      outcome.refused = error.what();
    }
    return outcome;
  }

  /// No number that was not written, no row lost in silence.
  void expect_honest(const Outcome& outcome, const std::string& what) {
    EXPECT_EQ(outcome.rows_read, outcome.log.rows() + outcome.issues.rows_dropped()) << what;
    EXPECT_TRUE(outcome.log.rows() == kShort || !outcome.issues.empty()) << what;
    for (int i = 0; i < outcome.log.rows(); ++i) {
      const int row = static_cast<int>(std::lround(outcome.log.time[i] / 0.01));
      ASSERT_EQ(outcome.log.time[i], time_of(row)) << what;
      for (int j = 0; j < 3; ++j) ASSERT_EQ(outcome.log.q[j][i], position_of(row, j)) << what;
    }
  }

  TemporaryFolder folder_;
  std::string bytes_;
};

TEST_F(NativeDamage, OneFlippedBitKeepsNineTenthsOfAShortLog) {
  std::mt19937 random(1);
  for (std::size_t place = 0; place < bytes_.size(); place += place < 400 ? 1 : 23) {
    std::string bytes = bytes_;
    bytes[place] = static_cast<char>(bytes[place] ^ (1 << random() % 8));
    const Outcome outcome = read(bytes);
    ASSERT_EQ(outcome.refused, "") << place;
    EXPECT_GE(outcome.log.rows(), kShort * 9 / 10) << place;
    EXPECT_FALSE(outcome.issues.empty()) << place;
    expect_honest(outcome, "bit at byte " + std::to_string(place));
  }
}

TEST_F(NativeDamage, ThirtyThreeMissingBytesKeepNineTenthsOfAShortLog) {
  for (std::size_t place = 0; place + 33 <= bytes_.size(); place += 41) {
    const std::size_t copy = bytes_.find(kNativeMagic, 1);
    if (place < copy && place + 33 > copy) continue;  // bytes of both copies of the header
    const Outcome outcome = read(std::string(bytes_).erase(place, 33));
    ASSERT_EQ(outcome.refused, "") << place;
    EXPECT_GE(outcome.log.rows(), kShort * 9 / 10) << place;
    EXPECT_FALSE(outcome.issues.empty()) << place;
    expect_honest(outcome, "missing at byte " + std::to_string(place));
  }
}

TEST_F(NativeDamage, ACutFileKeepsAllRowsButTheLastFew) {
  const std::size_t row_bytes = bytes_.size() / kShort;
  for (std::size_t size = 1000; size < bytes_.size(); size += 61) {
    const Outcome outcome = read(bytes_.substr(0, size));
    ASSERT_EQ(outcome.refused, "") << size;
    EXPECT_GE(outcome.log.rows() + 16, static_cast<int>(size / row_bytes)) << size;
    EXPECT_NE(outcome.issues.find("file_truncated"), nullptr) << size;
    expect_honest(outcome, "cut at byte " + std::to_string(size));
  }
}

TEST_F(NativeDamage, VersionOneIsRefusedWithAdvice) {
  const Outcome outcome = read(native_preface_of(1, kList) + native_chunk_of(2, 0, {0.5, 0.6, 1, 2}) +
                               native_header_of(kEndMarker, 0, 2));
  EXPECT_NE(outcome.refused.find("damaged.flog"), std::string::npos) << outcome.refused;
  EXPECT_NE(outcome.refused.find("version 1 of an earlier program"), std::string::npos) << outcome.refused;
  EXPECT_NE(outcome.refused.find("record it again"), std::string::npos) << outcome.refused;
}

TEST_F(NativeDamage, DecreasingRowNumbersAreRejected) {
  const std::vector<double> two{0.5, 0.6, 1, 2}, later{0.7, 0.8, 3, 4};
  const Outcome outcome =
      read(native_prefaces(kList) + native_chunk_of(2, 100, two) + native_chunk_of(2, 50, later) +
           native_chunk_of(2, 102, later) + native_header_of(kEndMarker, 0, 104));
  EXPECT_EQ(outcome.log.rows(), 4);
  EXPECT_EQ(outcome.issues.rows_dropped(), 100);
  EXPECT_EQ(outcome.rows_read, 104);
  for (const Issue& issue : outcome.issues.all())
    EXPECT_EQ(issue.message.find("-"), std::string::npos) << issue.message;
}

TEST_F(NativeDamage, ImpossiblyLargeRowNumbersAreRejected) {
  const std::vector<double> two{0.5, 0.6, 1, 2};
  for (const std::uint64_t row :
       {std::uint64_t{1} << 63, ~std::uint64_t{0} - 1, (std::uint64_t{1} << 63) - 1}) {
    const Outcome outcome = read(native_prefaces(kList) + native_chunk_of(2, 0, two) +
                                 native_chunk_of(2, row, two) + native_header_of(kEndMarker, 0, row + 2));
    EXPECT_EQ(outcome.log.rows(), 2);
    EXPECT_EQ(outcome.rows_read, 2);
    EXPECT_NE(outcome.issues.find("file_truncated"), nullptr);
  }
}

TEST_F(NativeDamage, MemoryDependsOnTheBytesOfTheFileNotOnItsHeader) {
  std::string list = "t\t\nq1\t\n";
  for (int c = 2; c < 4000; ++c) list += "c" + std::to_string(c) + "\t\n";
  const std::string numbers(1000, '\0');
  const std::string log = folder_.write(
      "promises.flog",
      native_prefaces(list) + native_header_of(kChunkMarker, kMostChunkRows, 0, numbers) + numbers);
  const ProgramRun run = run_program({"inspect", log}, {.memory_limit = 400LL << 20});
  EXPECT_EQ(run.status, 3) << run.err;
  EXPECT_NE(run.err.find("promises.flog"), std::string::npos) << run.err;
}

TEST_F(NativeDamage, MoreChannelsThanAnyLogHasAreRefused) {
  std::string list = "t\t\nq1\t\n";
  for (int c = 2; c < 150000; ++c) list += "c" + std::to_string(c) + "\t\n";
  const std::string numbers(1000, '\0');
  const Outcome outcome =
      read(native_prefaces(list) + native_header_of(kChunkMarker, kMostChunkRows, 0, numbers));
  EXPECT_NE(outcome.refused.find("declares 150000 channels"), std::string::npos) << outcome.refused;
}

TEST_F(NativeDamage, NestedDamagedChunksTakeNoQuadraticTime) {
  std::string headers;
  const std::uint32_t rows = kMostChunkRows;
  for (int i = 0; i < 400000; ++i)
    headers += native_header_of(kChunkMarker, rows, rows * std::uint64_t(i), "x");
  const Outcome outcome = read(native_prefaces(kList) + headers);
  EXPECT_NE(outcome.refused.find("usable time"), std::string::npos) << outcome.refused;
}

TEST_F(NativeDamage, MoreColumnsThanCanBeReadAreNotWritten) {
  Log log;
  log.time = {0.0, 1.0};
  log.q = {{1.0, 2.0}};
  log.extra.resize(kMostChannels);
  for (std::size_t i = 0; i < log.extra.size(); ++i) log.extra[i] = {"x" + std::to_string(i), "", {1.0, 2.0}};
  EXPECT_THROW(write_log(folder_.file("wide.flog"), log), Error);
  log.extra.resize(kMostChannels - 2);
  write_log(folder_.file("wide.flog"), log);
  EXPECT_EQ(read(read_file(folder_.file("wide.flog"))).log.rows(), 2);
}

}  // namespace
}  // namespace faultline
