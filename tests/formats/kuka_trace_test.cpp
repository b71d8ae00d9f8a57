// SPDX-License-Identifier: MIT
// Recordings of KUKA Trace and of DIAdem, written here byte by byte: a header (.dat) and data files beside
// it.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "formats/open_log.hpp"
#include "lib/core/error.hpp"
#include "lib/core/hash.hpp"
#include "lib/robot/robot_file.hpp"
#include "tests/formats/arrays/npy_bytes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

using Values = std::vector<double>;

constexpr double kDegree = std::numbers::pi / 180.0;  // rad

/// Lines of a channel; `more` are further ones.
std::string channel(const std::string& name, const std::string& unit, const std::string& more) {
  return "#BEGINCHANNELHEADER\r\n200," + name + "\r\n201,\r\n202," + unit + "\r\n" + more +
         "#ENDCHANNELHEADER\r\n";
}

/// A clock that is not stored, as a KUKA controller writes it.
std::string clock_channel(std::int64_t values, const std::string& step, const std::string& name = "Zeit") {
  return channel(name, "s",
                 "210,IMPLIZIT\r\n220," + std::to_string(values) + "\r\n240,0\r\n241," + step + "\r\n");
}

struct Stored {
  std::string file = "trace.r64", storage = "BLOCK", type = "REAL64", offset = "0", factor = "1";
  std::string more{};
};

std::string stored_channel(const std::string& name, const std::string& unit, std::int64_t values,
                           std::int64_t first, const Stored& how = {}) {
  return channel(name, unit,
                 "210,EXPLIZIT\r\n211," + how.file + "\r\n213," + how.storage + "\r\n214," + how.type +
                     "\r\n220," + std::to_string(values) + "\r\n221," + std::to_string(first) + "\r\n240," +
                     how.offset + "\r\n241," + how.factor + "\r\n" + how.more);
}

std::string header(const std::string& channels, const std::string& global = "112,High -> Low\r\n") {
  return "DIAEXTENDED  {@:ENGLISH\r\n\r\n#BEGINGLOBALHEADER\r\n  1,WINDOWS\r\n" + global +
         "#ENDGLOBALHEADER\r\n\r\n" + channels;
}

struct TraceReading {
  Log log;
  LogIdentity identity;
  Issues issues;
  std::vector<std::string> names;
  std::string refused;

  std::string said(const std::string& code, const std::string& of = "") const {
    const Issue* issue = issues.find(code, of);
    return issue ? issue->message : "";
  }
};

TraceReading read_trace(const std::string& path, const OpenLogOptions& options = {}) {
  TraceReading reading;
  try {
    const auto raw = open_raw(path);
    for (const RawColumn& column : raw->columns()) reading.names.push_back(column.name);
    const auto source = open_log(path, options);
    reading.log = read_all(*source);
    reading.identity = source->identity();
    reading.issues = source->issues();
    EXPECT_EQ(reading.identity.rows_read, reading.log.rows() + reading.issues.rows_dropped());
    source->rewind();
    EXPECT_EQ(read_all(*source).rows(), reading.log.rows());
    EXPECT_EQ(source->identity().sha256, reading.identity.sha256);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::input);
    reading.refused = error.what();
  }
  return reading;
}

void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

class KukaTrace : public testing::Test {
 protected:
  TraceReading read(const std::string& text, const std::string& data, const OpenLogOptions& options = {}) {
    folder_.write("trace.r64", data);
    return read_trace(folder_.write("trace.dat", text), options);
  }

  /// Positions and torques of two axes, 3 rows of 4 values.
  std::string two_axes(std::int64_t values = 3) const {
    return header(clock_channel(values, "0.004") + stored_channel("Istposition A1", "\xb0", values, 1) +
                  stored_channel("Istposition A2", "\xb0", values, 2) +
                  stored_channel("Istmoment A1", "Nm", values, 3) +
                  stored_channel("Istmoment A2", "Nm", values, 4));
  }
  const Values rows_{10, 20, 1, 2, 11, 21, 3, 4, 12, 22, 5, 6};

  TemporaryFolder folder_;
};

TEST_F(KukaTrace, BlocksOfGermanChannelsAreJointsInSi) {
  const TraceReading read = this->read(two_axes(), elements(rows_));
  EXPECT_EQ(read.refused, "");
  EXPECT_EQ(read.identity.format, "diadem");
  ASSERT_EQ(read.log.q.size(), 2u);
  EXPECT_EQ(read.log.time, (Values{0, 0.004, 0.008}));
  EXPECT_DOUBLE_EQ(read.log.q[0][1], 11 * kDegree);
  EXPECT_DOUBLE_EQ(read.log.q[1][2], 22 * kDegree);
  EXPECT_EQ(read.log.tau[0], (Values{1, 3, 5}));
  EXPECT_EQ(read.log.tau[1], (Values{2, 4, 6}));
  EXPECT_TRUE(read.issues.empty()) << read.issues.all().front().message;
}

TEST_F(KukaTrace, CommandedAndMeasuredSignalsAreDistinguished) {
  std::string channels = clock_channel(2, "0.012");
  const char* names[] = {"Sollposition",       "Istposition", "Sollgeschwindigkeit",
                         "Istgeschwindigkeit", "Sollmoment",  "Istmoment"};
  for (int i = 0; i < 6; ++i) channels += stored_channel(std::string(names[i]) + "_1", "", 2, i + 1);
  channels += stored_channel("Positionsschleppfehler_1", "", 2, 7);
  channels += stored_channel("Motorstrom_1", "A", 2, 8);
  const TraceReading read = this->read(header(channels), elements<double>({1, 2, 3, 4, 5, 6, 7, 8,  //
                                                                           11, 12, 13, 14, 15, 16, 17, 18}));
  EXPECT_EQ(read.refused, "");
  EXPECT_EQ(read.log.q_ref, (JointSignals{{1, 11}}));
  EXPECT_EQ(read.log.q, (JointSignals{{2, 12}}));
  EXPECT_EQ(read.log.dq_ref, (JointSignals{{3, 13}}));
  EXPECT_EQ(read.log.dq, (JointSignals{{4, 14}}));
  EXPECT_EQ(read.log.tau, (JointSignals{{5, 15}}));
  EXPECT_EQ(read.log.tau_meas, (JointSignals{{6, 16}}));
  ASSERT_EQ(read.log.extra.size(), 2u);
}

TEST_F(KukaTrace, EachFileOfAMotorAddsItsAxisToTheNames) {
  OpenLogOptions options;
  for (int axis = 1; axis <= 3; ++axis) {
    const std::string name = "run_NextGenDrive#" + std::to_string(axis);
    const Stored how{.file = name + ".r64"};
    folder_.write(name + ".r64", elements<double>({axis + 0.1, axis + 0.2, axis + 0.3, axis + 0.4}));
    const std::string path = folder_.write(
        name + ".dat", header(clock_channel(2, "0.012") + stored_channel("Istposition", "\xb0", 2, 1, how) +
                              stored_channel("Istmoment", "Nm", 2, 2, how)));
    if (axis > 1) options.parts.join.push_back(path);
  }
  const TraceReading read = read_trace(folder_.file("run_NextGenDrive#1.dat"), options);
  EXPECT_EQ(read.names, (std::vector<std::string>{"Zeit", "Istposition_A1", "Istmoment_A1"}));
  ASSERT_EQ(read.log.q.size(), 3u) << read.refused;
  for (int j = 0; j < 3; ++j) {
    EXPECT_DOUBLE_EQ(read.log.q[j][1], (j + 1.3) * kDegree);
    EXPECT_DOUBLE_EQ(read.log.tau[j][0], j + 1.2);
  }
}

TEST_F(KukaTrace, ThePresetUsesTheTorqueOfTheDriveAsACurrent) {
  const Robot robot = robot_from_toml("axes = \"RR\"\n[log]\npreset = \"kuka-trace\"\n", "robot.toml");
  const std::string text =
      header(clock_channel(2, "0.004") + stored_channel("Sollmoment_A1", "Nm", 2, 1) +
             stored_channel("Istmoment_A1", "Nm", 2, 2) + stored_channel("Istposition_A1", "\xb0", 2, 3) +
             stored_channel("Sollmoment_A2", "Nm", 2, 4) + stored_channel("Istmoment_A2", "Nm", 2, 5) +
             stored_channel("Istposition_A2", "\xb0", 2, 6));
  OpenLogOptions options;
  options.columns = robot.log.columns;
  const TraceReading read =
      this->read(text, elements<double>({1, 2, 3, 4, 5, 6, 11, 12, 13, 14, 15, 16}), options);
  EXPECT_EQ(read.log.tau, (JointSignals{{2, 12}, {5, 15}})) << read.refused;
  EXPECT_DOUBLE_EQ(read.log.q[1][1], 16 * kDegree);
}

TEST_F(KukaTrace, ChannelsThatAreStoredOneAfterAnotherAreRead) {
  const Stored how{.storage = "CHANNEL"};
  const std::string text =
      header(stored_channel("time", "ms", 3, 1, how) + stored_channel("q1", "rad", 3, 4, how) +
             stored_channel("q2", "rad", 3, 7, how));
  const TraceReading read = this->read(text, elements<double>({0, 4, 8, 10, 11, 12, 20, 21, 22}));
  EXPECT_EQ(read.log.time, (Values{0, 0.004, 0.008})) << read.refused;
  EXPECT_EQ(read.log.q, (JointSignals{{10, 11, 12}, {20, 21, 22}}));
}

TEST_F(KukaTrace, SmallerTypesAreReadWithFactorAndOffset) {
  const Stored real{.file = "a.r32", .storage = "CHANNEL", .type = "REAL32", .offset = "1", .factor = "0.5"};
  const Stored word{.file = "b.i16", .storage = "BLOCK", .type = "INT16", .offset = "-3", .factor = "0.25"};
  const Stored whole{.file = "c.i32", .storage = "CHANNEL", .type = "INT32", .factor = "0,5"};
  folder_.write("a.r32", elements<float>({2, 4, 8}));
  folder_.write("b.i16", elements<std::int16_t>({4, 8, -12}));
  folder_.write("c.i32", elements<std::int32_t>({100000, -1, 3}));
  const TraceReading read = read_trace(folder_.write(
      "trace.dat",
      header(clock_channel(3, "0.004") + stored_channel("q1", "rad", 3, 1, real) +
             stored_channel("q2", "rad", 3, 1, word) + stored_channel("q3", "rad", 3, 1, whole))));
  EXPECT_EQ(read.log.q, (JointSignals{{2, 3, 5}, {-2, -1, -6}, {50000, -0.5, 1.5}})) << read.refused;
}

TEST_F(KukaTrace, TheOtherByteOrderAndTheMarkOfMissingValuesAreHeeded) {
  const std::string text = header(clock_channel(3, "0.004") + stored_channel("q1", "rad", 3, 1),
                                  "111,9.9E+34\r\n112,Low -> High\r\n");
  const TraceReading read = this->read(text, elements<double>({1, 9.9e34, 3}, true));
  ASSERT_EQ(read.log.rows(), 3) << read.refused;
  EXPECT_EQ(read.log.q[0][0], 1);
  EXPECT_TRUE(std::isnan(read.log.q[0][1]));
  EXPECT_EQ(read.log.q[0][2], 3);
}

TEST_F(KukaTrace, TheNameOfADataFileMayDifferInCapitals) {
  folder_.write("TRACE.R64", elements(rows_));
  const TraceReading read = read_trace(folder_.write("trace.dat", two_axes()));
  EXPECT_EQ(read.log.rows(), 3) << read.refused;
}

TEST_F(KukaTrace, TwoDataFilesThatDifferInCapitalsOnlyAreRefused) {
  folder_.write("TRACE.R64", elements(rows_));
  folder_.write("Trace.r64", elements(rows_));
  expect_contains(read_trace(folder_.write("trace.dat", two_axes())).refused,
                  "2 files beside it have this name");
}

TEST_F(KukaTrace, TheHashIsThatOfHeaderAndData) {
  const TraceReading one = read(two_axes(), elements(rows_));
  Values other = rows_;
  other[3] = 7;
  const TraceReading two = read(two_axes(), elements(other));
  EXPECT_NE(one.identity.sha256, two.identity.sha256);
  EXPECT_EQ(two.identity.sha256, sha256_of_files({folder_.file("trace.dat"), folder_.file("trace.r64")}));
  EXPECT_EQ(files_beside(folder_.file("trace.dat")), (std::vector<std::string>{folder_.file("trace.r64")}));
  EXPECT_TRUE(files_beside(folder_.file("trace.r64")).empty());
}

TEST_F(KukaTrace, AMissingDataFileIsRefusedByName) {
  const TraceReading read = read_trace(folder_.write("trace.dat", two_axes()));
  expect_contains(read.refused, "names the data file \"trace.r64\" (line 211), which is not in the folder");
}

TEST_F(KukaTrace, OneOfTwoMissingDataFilesCostsItsChannels) {
  const TraceReading read = this->read(header(clock_channel(2, "0.004") + stored_channel("q1", "rad", 2, 1) +
                                              stored_channel("q2", "rad", 2, 1, {.file = "other.r64"})),
                                       elements<double>({1, 2}));
  EXPECT_EQ(read.log.q, (JointSignals{{1, 2}})) << read.refused;
  expect_contains(read.said("data_file_missing", "other.r64"), "\"q2\" was left out");
}

TEST_F(KukaTrace, APathInsteadOfANameIsRefused) {
  for (const char* name : {"../trace.r64", "/etc/passwd", "C:\\KRC\\TRACE\\trace.r64", ".."}) {
    const TraceReading read =
        this->read(header(clock_channel(2, "0.004") + stored_channel("q1", "rad", 2, 1, {.file = name})),
                   "0123456789abcdef");
    expect_contains(read.refused, "which is a path");
    EXPECT_TRUE(files_beside(folder_.file("trace.dat")).empty());
  }
}

TEST_F(KukaTrace, ACutDataFileIsReadToTheCut) {
  const std::string data = elements(rows_);
  const TraceReading read = this->read(two_axes(), data.substr(0, data.size() - 5 * sizeof(double)));
  ASSERT_EQ(read.log.rows(), 2) << read.refused;
  EXPECT_EQ(read.log.tau[0], (Values{1, 3}));
  EXPECT_TRUE(std::isnan(read.log.tau[1][1]));
  ASSERT_NE(read.issues.find("file_truncated", "tau2"), nullptr);
  ASSERT_NE(read.issues.find("file_truncated"), nullptr);
  EXPECT_EQ(read.issues.find("file_truncated", "tau2")->count, 1);
  EXPECT_EQ(read.issues.find("file_truncated")->rows_dropped, 1);
  EXPECT_EQ(read.issues.find("file_truncated")->severity, Severity::severe);
}

TEST_F(KukaTrace, ACountBeyondTheFileDropsTheRowsItLacks) {
  const TraceReading read = this->read(two_axes(1'000'000'000'000), elements(rows_));
  EXPECT_EQ(read.log.rows(), 3) << read.refused;
  EXPECT_EQ(read.issues.rows_dropped(), 999'999'999'997);
}

TEST_F(KukaTrace, BytesBehindTheLastValueAreReported) {
  const TraceReading read = this->read(two_axes(2), elements(rows_));
  EXPECT_EQ(read.log.rows(), 2) << read.refused;
  expect_contains(read.said("trailing_bytes", "trace.r64"), "holds 32 bytes behind the last value");
}

TEST_F(KukaTrace, AnEmptyDataFileIsRefused) {
  expect_contains(read(two_axes(), "").refused, "end before their first row");
}

TEST_F(KukaTrace, ChannelsOfAnotherLengthOrStepAreLeftOutByName) {
  const Stored slow{.file = "slow.r64"};
  folder_.write("slow.r64", elements<double>({7, 8}));
  const std::string text = header(clock_channel(3, "0.004") + stored_channel("q1", "rad", 3, 1) +
                                  stored_channel("q2", "rad", 3, 2) + clock_channel(2, "0.012", "Zeit 2") +
                                  stored_channel("slow", "", 2, 1, slow) +
                                  clock_channel(3, "0.001", "Zeit 3") + stored_channel("fast", "", 3, 3));
  const TraceReading read = this->read(text, elements<double>({1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(read.log.q, (JointSignals{{1, 4, 7}, {2, 5, 8}})) << read.refused;
  EXPECT_EQ(read.log.time, (Values{0, 0.004, 0.008}));
  EXPECT_EQ(read.names, (std::vector<std::string>{"Zeit", "q1", "q2"}));
  expect_contains(read.said("signal_left_out"), "\"slow\", \"fast\" were left out");
}

TEST_F(KukaTrace, RepeatedNamesAreNumberedInTheirOrder) {
  const TraceReading read =
      this->read(header(clock_channel(2, "0.004") + stored_channel("Istposition", "\xb0", 2, 1) +
                        stored_channel("Istposition", "\xb0", 2, 2)),
                 elements<double>({1, 2, 3, 4}));
  EXPECT_EQ(read.names, (std::vector<std::string>{"Zeit", "Istposition_1", "Istposition_2"}));
  EXPECT_DOUBLE_EQ(read.log.q[1][1], 4 * kDegree);
  expect_contains(read.said("names_repeated"), "several channels are called \"Istposition\"");
}

TEST_F(KukaTrace, AnotherTypeCostsItsChannelAndIsNamed) {
  const Stored odd{.file = "b.w48", .storage = "CHANNEL", .type = "REAL48"};
  folder_.write("b.w48", "123456123456");
  const TraceReading read = this->read(header(clock_channel(2, "0.004") + stored_channel("q1", "rad", 2, 1) +
                                              stored_channel("status", "", 2, 1, odd)),
                                       elements<double>({1, 2}));
  EXPECT_EQ(read.log.q, (JointSignals{{1, 2}})) << read.refused;
  ASSERT_FALSE(read.issues.empty());
  expect_contains(read.issues.all().front().message,
                  "\"status\" was left out: its values are of type \"REAL48\"");
}

TEST_F(KukaTrace, BlocksOfUnequalTypesAreRefused) {
  const TraceReading read = this->read(header(clock_channel(2, "0.004") + stored_channel("q1", "rad", 2, 1) +
                                              stored_channel("q2", "rad", 2, 2, {.type = "INT16"})),
                                       elements<double>({1, 2}));
  expect_contains(read.refused, "values of 8 and of 2 bytes in the blocks of one file");
}

TEST_F(KukaTrace, TheWidthOfARowMayBeStatedOrFollowFromTheFile) {
  const Values wide{1, 2, 0, 3, 4, 0};  // rows of 3 values, of which the header has 2
  const auto text = [](const std::string& line) {
    return header(clock_channel(2, "0.004") + stored_channel("q1", "rad", 2, 1, {.more = line}) +
                  stored_channel("q2", "rad", 2, 2, {.more = line}));
  };
  EXPECT_EQ(read(text("222,3\r\n"), elements(wide)).log.q, (JointSignals{{1, 3}, {2, 4}}));
  EXPECT_EQ(read(text("222,0\r\n"), elements<double>({1, 2, 3, 4})).log.q, (JointSignals{{1, 3}, {2, 4}}));
  expect_contains(read(text("222,3\r\n"), elements<double>({1, 2, 3, 4, 5})).refused,
                  "blocks of unknown width");
  const std::string third = header(clock_channel(2, "0.004") + stored_channel("q1", "rad", 2, 3));
  EXPECT_EQ(read(third, elements(wide)).log.q, (JointSignals{{0, 0}}));
}

TEST_F(KukaTrace, HostileHeadersAreRefusedWithASentence) {
  expect_contains(read("DIAEXTENDED\r\n", "").refused, "without channels");
  expect_contains(read(header(std::string(1 << 20, 'x')), "").refused,
                  "more than any line of a DIAdem header");
  std::string many;
  for (int i = 0; i < 17000; ++i) many += "#BEGINCHANNELHEADER\n#ENDCHANNELHEADER\n";
  expect_contains(read(header(many), "").refused, "more than 16384 channels");
  expect_contains(read(header(std::string(20 << 20, '\n')), "").refused, "more than the 16 MiB");
  for (const char* count : {"-1", "1e300", "9223372036854775807", "x", "2.5", ""}) {
    const TraceReading read = this->read(
        header(clock_channel(2, "0.004") + channel("q1", "",
                                                   std::string("210,EXPLICIT\n211,trace.r64\n213,BLOCK\n"
                                                               "214,REAL64\n220,") +
                                                       count + "\n")),
        elements<double>({1, 2}));
    expect_contains(read.refused, "no channel with values");
  }
}

TEST_F(KukaTrace, ManyChannelsOverTheSameValuesAreRefused) {
  std::string channels = clock_channel(100'000, "0.001");
  for (int i = 0; i < 4000; ++i)
    channels += stored_channel("c" + std::to_string(i), "", 100'000, 1, {.storage = "CHANNEL"});
  expect_contains(read(header(channels), std::string(800'000, '\0')).refused,
                  "far more rows or unpacked bytes");
}

TEST_F(KukaTrace, AHeaderThatIsCutInsideAChannelGivesTheOthers) {
  std::string text = two_axes();
  text.resize(text.size() - 40);
  const TraceReading read = this->read(text, elements(rows_));
  EXPECT_EQ(read.log.tau[0], (Values{1, 3, 5})) << read.refused;
  ASSERT_FALSE(read.issues.empty());
  expect_contains(read.issues.all().front().message,
                  "\"Istmoment A2\" was left out: its header is not complete");
}

TEST_F(KukaTrace, ANameInTheRobotFileChoosesAColumn) {
  OpenLogOptions options;
  options.columns = {{"q1", {.name = "Winkelgeber", .unit = "rad"}}};
  const TraceReading read =
      this->read(header(clock_channel(2, "0.004") + stored_channel("Winkelgeber", "?", 2, 1)),
                 elements<double>({1, 2}), options);
  EXPECT_EQ(read.log.q, (JointSignals{{1, 2}})) << read.refused;
}

}  // namespace
}  // namespace faultline
