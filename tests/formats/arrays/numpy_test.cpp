// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "formats/log_writer.hpp"
#include "lib/core/atomic_file.hpp"
#include "tests/formats/arrays/npy_bytes.hpp"
#include "tests/formats/arrays/read_bytes.hpp"
#include "tests/support/run_python.hpp"
#include "tests/support/skip_unless_installed.hpp"

namespace faultline {
namespace {

/// Of an .npy of three rows, in which the first column is t and the second q1.
const OpenLogOptions kMapped{.columns = {{"t", {.name = "column1"}}, {"q1", {.name = "column2"}}}};

using Values = std::vector<double>;

TEST(Numpy, AMatrixWithoutNamesIsReadAsColumns) {
  const ReadArrays read =
      read_bytes(npy("'<f8'", "(3, 2)", elements<double>({0, 10, 1, 11, 2, 12})), kMapped);
  EXPECT_EQ(read.refused, "");
  EXPECT_EQ(read.identity.format, "npy");
  EXPECT_EQ(read.log.time, (Values{0, 1, 2}));
  EXPECT_EQ(read.log.q[0], (Values{10, 11, 12}));
}

TEST(Numpy, FortranOrderIsReadAsColumns) {
  const ReadArrays read =
      read_bytes(npy("'<f8'", "(3, 2)", elements<double>({0, 1, 2, 10, 11, 12}), true), kMapped);
  EXPECT_EQ(read.log.q[0], (Values{10, 11, 12}));
}

TEST(Numpy, AChannelMajorArrayIsReadAsColumns) {
  const ReadArrays read =
      read_bytes(npy("'<f8'", "(2, 3)", elements<double>({0, 1, 2, 10, 11, 12})), kMapped);
  EXPECT_EQ(read.log.time, (Values{0, 1, 2}));
  EXPECT_EQ(read.log.q[0], (Values{10, 11, 12}));
}

template <typename Element>
void expect_read(const std::string& kind) {
  for (const bool big : {false, true}) {
    const std::string descr = "'" + std::string(big ? ">" : "<") + kind + "'";
    const ReadArrays read =
        read_bytes(npy(descr, "(3, 2)", elements<Element>({0, 10, 1, 11, 2, 12}, big)), kMapped);
    EXPECT_EQ(read.refused, "") << descr;
    EXPECT_EQ(read.log.q[0], (Values{10, 11, 12})) << descr;
  }
}

TEST(Numpy, EveryNumberOfEitherByteOrderIsRead) {
  expect_read<float>("f4");
  expect_read<double>("f8");
  expect_read<std::int8_t>("i1");
  expect_read<std::int16_t>("i2");
  expect_read<std::int32_t>("i4");
  expect_read<std::int64_t>("i8");
  expect_read<std::uint8_t>("u1");
  expect_read<std::uint16_t>("u2");
  expect_read<std::uint32_t>("u4");
  expect_read<std::uint64_t>("u8");
}

TEST(Numpy, EveryVersionOfTheHeaderIsRead) {
  for (const char version : {char{1}, char{2}, char{3}}) {
    const std::string bytes = npy("'<f8'", "(3, 2)", elements<double>({0, 10, 1, 11, 2, 12}), false, version);
    EXPECT_EQ(read_bytes(bytes, kMapped).log.rows(), 3);
  }
}

TEST(Numpy, FieldsOfRecordsAreColumnsUnderTheirNames) {
  std::string data;
  for (int i = 0; i < 4; ++i)
    data += elements<float>({0.5F * static_cast<float>(i)}) + "xx" + elements<double>({10.0 + i, 20.0 + i}) +
            elements<std::int16_t>({static_cast<std::int16_t>(i)}, true);
  const ReadArrays read = read_bytes(
      npy("[('t', '<f4'), ('', '|V2'), ('q', '<f8', (2,)), (('the mode', 'mode'), '>i2')]", "(4,)", data));
  EXPECT_EQ(read.refused, "");
  EXPECT_EQ(read.log.time, (Values{0, 0.5, 1, 1.5}));
  ASSERT_EQ(read.log.joints(), 2);
  EXPECT_EQ(read.log.q[1], (Values{20, 21, 22, 23}));
  EXPECT_EQ(read.extra("mode"), (Values{0, 1, 2, 3}));
}

TEST(Numpy, ADateTimeIsReadInSeconds) {
  std::string data;
  for (const std::int64_t ns : {1500000000LL, 2500000000LL})
    data += elements<std::int64_t>({ns}) + elements<double>({7});
  const ReadArrays read = read_bytes(npy("[('t', '<M8[ns]'), ('q1', '<f8')]", "(2,)", data));
  EXPECT_EQ(read.log.time, (Values{1.5, 2.5}));
}

TEST(Numpy, ACutArrayGivesItsCompleteRowsAndReportsTheOthers) {
  const std::string bytes = npy("'<f8'", "(3, 2)", elements<double>({0, 10, 1, 11, 2, 12}));
  const ReadArrays read = read_bytes(bytes.substr(0, bytes.size() - 9), kMapped);
  EXPECT_EQ(read.log.rows(), 2);
  ASSERT_TRUE(read.issues.find("file_truncated"));
  EXPECT_EQ(read.issues.find("file_truncated")->severity, Severity::severe);
  EXPECT_EQ(read.issues.rows_dropped(), 1);
}

TEST(Numpy, AnImpossibleShapeTakesNoMemory) {
  for (const char* shape : {"(1000000000000000, 2)", "(4503599627370496, 2)", "(2, 1000000000000000)"}) {
    const ReadArrays read = read_bytes(npy("'<f8'", shape, elements<double>({0, 10, 1, 11})), kMapped);
    EXPECT_LE(read.log.rows(), 4) << shape;
    EXPECT_TRUE(!read.refused.empty() || read.issues.rows_dropped() > 1000000) << shape;
  }
}

TEST(Numpy, AnInvalidHeaderIsRefused) {
  for (const char* shape : {"(9000000000000000000, 9000000000000000000)", "(-1, 2)", "((", "('a',)", "()"})
    EXPECT_NE(read_bytes(npy("'<f8'", shape, "12345678")).refused, "") << shape;
  for (const char* descr : {"'<f8", "'|O'", "[('t',)]", "'<c16'", "[[[[[[[[[[[[[[[[[[[[[[", "'x'", "12"})
    EXPECT_NE(read_bytes(npy(descr, "(3, 2)", "12345678")).refused, "") << descr;
}

class Npz : public testing::Test {
 protected:
  std::string written(const Log& log) {
    write_log(folder_.file("log.npz"), log);
    return read_file(folder_.file("log.npz"));
  }

  TemporaryFolder folder_;
};

Log log_with_extra() {
  Log log = numbered_log(50, 3);
  log.tau[1][7] = std::nan("");
  log.tau_meas = {log.tau[0], log.tau[1], log.tau[2]};
  log.extra = {{"motor temp_ms", "", log.q[0]},
               {"q", "degC", log.q[1]},
               {"a/b", "V", log.q[2]},
               {"a b", "", log.q[0]}};
  return log;
}

TEST_F(Npz, AWrittenLogIsReadBackToTheLastBit) {
  const Log log = log_with_extra();
  const ReadArrays read = read_bytes(written(log));
  EXPECT_EQ(read.refused, "");
  EXPECT_TRUE(read.issues.empty());
  EXPECT_EQ(read.log.time, log.time);
  EXPECT_EQ(read.log.q, log.q);
  EXPECT_TRUE(std::isnan(read.log.tau[1][7]));
  EXPECT_EQ(read.log.tau[2], log.tau[2]);
  EXPECT_EQ(read.log.tau_meas[0], log.tau_meas[0]);
  ASSERT_EQ(read.log.extra.size(), log.extra.size());
  for (std::size_t i = 0; i < log.extra.size(); ++i) {
    EXPECT_EQ(read.log.extra[i].name, log.extra[i].name);
    EXPECT_EQ(read.log.extra[i].unit, log.extra[i].unit);
    EXPECT_EQ(read.log.extra[i].values, log.extra[i].values);
  }
}

TEST_F(Npz, ALogOfOneRowIsReadBack) {
  const ReadArrays read = read_bytes(written(numbered_log(1, 3)));
  EXPECT_EQ(read.log.q, numbered_log(1, 3).q);
}

TEST_F(Npz, SegmentsChangeNoByte) {
  const Log log = log_with_extra();
  const std::string whole = written(log);
  const auto writer = create_log(folder_.file("cut.npz"));
  for (int row = 0; row < log.rows(); row += 7) writer->write(slice(log, row, std::min(log.rows(), row + 7)));
  writer->commit();
  EXPECT_EQ(read_file(folder_.file("cut.npz")), whole);
}

TEST_F(Npz, ACutFileIsReadUpToTheCut) {
  const Log log = numbered_log(50, 2);
  const std::string bytes = written(log);
  int most = 0;
  for (std::size_t size = 1; size < bytes.size(); size += 29) {
    const ReadArrays read = read_bytes(bytes.substr(0, size));
    if (!read.refused.empty()) continue;
    most = std::max(most, read.log.rows());
    EXPECT_TRUE(read.issues.find("file_truncated")) << size;
    for (int i = 0; i < read.log.rows(); ++i)
      ASSERT_EQ(read.log.time[static_cast<std::size_t>(i)], 0.01 * i) << size;
  }
  EXPECT_EQ(most, 50);
}

TEST_F(Npz, AFlippedBitIsReportedOrChangesNoValue) {
  const std::string bytes = written(numbered_log(50, 2));
  for (std::size_t place = 100; place < bytes.size(); place += 111) {
    std::string bad = bytes;
    bad[place] = static_cast<char>(bad[place] ^ 4);
    const ReadArrays read = read_bytes(bad);
    EXPECT_TRUE(!read.refused.empty() || !read.issues.empty() || read.log.q == numbered_log(50, 2).q)
        << place;
  }
}

TEST_F(Npz, FilesOfNumpyAreRead) {
  const char* script = R"(
import numpy as np
t = np.arange(1000) * 0.01
q = np.stack([np.sin(t), np.cos(t), t], axis=1)
np.savez('stored.npz', t=t, q=q, dq=q.T, note='text', one=3.0)
np.savez_compressed('packed.npz', t=t, q=np.asfortranarray(q), dq=q.T, odd=np.zeros((4, 5)))
)";
  SKIP_UNLESS_INSTALLED(run_python(folder_, "import numpy\n"), "python3-numpy is missing");
  ASSERT_TRUE(run_python(folder_, script));
  for (const char* name : {"stored.npz", "packed.npz"}) {
    const ReadArrays read = read_array_file(folder_.file(name));
    EXPECT_EQ(read.refused, "") << name;
    ASSERT_EQ(read.log.rows(), 1000) << name;
    ASSERT_EQ(read.log.joints(), 3) << name;
    EXPECT_EQ(read.log.q, read.log.dq) << name;
    EXPECT_NEAR(read.log.q[1][100], std::cos(1.0), 1e-12);
  }
  EXPECT_TRUE(read_array_file(folder_.file("packed.npz")).issues.find("array_left_out"));
}

TEST_F(Npz, NumpyReadsWhatIsWritten) {
  written(log_with_extra());
  const char* script = R"(
import numpy as np
a = np.load('log.npz')
assert a['t'].shape == (50,) and a['q'].shape == (50, 3) and a['q'][4, 2] == 4.2
assert a['extra/q'].shape == (50,)
)";
  SKIP_UNLESS_INSTALLED(run_python(folder_, "import numpy\n"), "python3-numpy is missing");
  EXPECT_TRUE(run_python(folder_, script));
}

}  // namespace
}  // namespace faultline
