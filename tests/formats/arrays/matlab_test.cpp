// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "formats/log_writer.hpp"
#include "lib/core/atomic_file.hpp"
#include "tests/formats/arrays/read_bytes.hpp"
#include "tests/support/run_python.hpp"
#include "tests/support/shared_data.hpp"

namespace faultline {
namespace {

class Matlab : public testing::Test {
 protected:
  std::string written(const Log& log) {
    write_log(folder_.file("log.mat"), log);
    return read_file(folder_.file("log.mat"));
  }

  TemporaryFolder folder_;
};

Log log_with_extra() {
  Log log = numbered_log(60, 3);
  log.tau[1][7] = std::nan("");
  log.extra = {{"motor temp_ms", "", log.q[0]}, {"q", "degC", log.q[1]}, {"a/b", "V", log.q[2]}};
  return log;
}

TEST_F(Matlab, AWrittenLogIsReadBackToTheLastBit) {
  const Log log = log_with_extra();
  const ReadArrays read = read_bytes(written(log));
  EXPECT_EQ(read.refused, "");
  EXPECT_TRUE(read.issues.empty());
  EXPECT_EQ(read.identity.format, "matlab");
  EXPECT_EQ(read.log.time, log.time);
  EXPECT_EQ(read.log.q, log.q);
  EXPECT_TRUE(std::isnan(read.log.tau[1][7]));
  EXPECT_EQ(read.log.tau[2], log.tau[2]);
  ASSERT_EQ(read.log.extra.size(), log.extra.size());
  for (std::size_t i = 0; i < log.extra.size(); ++i) {
    EXPECT_EQ(read.log.extra[i].name, log.extra[i].name);
    EXPECT_EQ(read.log.extra[i].unit, log.extra[i].unit);
    EXPECT_EQ(read.log.extra[i].values, log.extra[i].values);
  }
}

TEST_F(Matlab, SegmentsChangeNoByte) {
  const Log log = log_with_extra();
  const std::string whole = written(log);
  const auto writer = create_log(folder_.file("cut.mat"));
  for (int row = 0; row < log.rows(); row += 7) writer->write(slice(log, row, std::min(log.rows(), row + 7)));
  writer->commit();
  EXPECT_TRUE(read_file(folder_.file("cut.mat")) == whole);
}

TEST_F(Matlab, ACutFileIsReadUpToTheCut) {
  const Log log = numbered_log(60, 2);
  const std::string bytes = written(log);
  int most = 0;
  for (std::size_t size = 1; size < bytes.size(); size += 23) {
    const ReadArrays read = read_bytes(bytes.substr(0, size));
    if (!read.refused.empty()) continue;
    EXPECT_TRUE(read.issues.find("file_truncated")) << size;
    most = std::max(most, read.log.rows());
    for (std::size_t i = 0; i < read.log.time.size(); ++i) ASSERT_EQ(read.log.time[i], log.time[i]) << size;
  }
  EXPECT_EQ(most, 60);
}

TEST_F(Matlab, AnImpossibleSizeTakesNoMemory) {
  std::string bytes = written(numbered_log(60, 2));
  const std::string rows("\x3c\0\0\0\x02\0\0\0", 8), many("\xff\xff\xff\x7f\x02\0\0\0", 8);
  for (std::size_t at; (at = bytes.find(rows)) != std::string::npos;) bytes.replace(at, many.size(), many);
  const ReadArrays read = read_bytes(bytes);
  EXPECT_TRUE(!read.refused.empty() || !read.issues.empty());
}

constexpr const char* kScript = R"(
import numpy as np, scipy.io as io
t = np.arange(500) * 0.01
q = np.stack([np.sin(t), np.cos(t)], axis=1)
for name, packed in (('plain', False), ('packed', True)):
    io.savemat(name + '.mat', {'t': t, 'q': q, 'dq': q.T.astype('f4'), 'Ts': 0.01, 'about': 'text',
                               'cells': np.array([1, 'a'], dtype=object)}, do_compression=packed)
    io.savemat(name + '_struct.mat', {'data': {'t': t, 'q': q, 'dq': q}}, do_compression=packed)
    signals = {'values': q, 'dimensions': 2.0, 'label': 'pos'}
    io.savemat(name + '_simulink.mat', {'q': {'time': t[:, None], 'signals': signals, 'blockName': 'x'},
                                        'dq': {'time': t[:, None], 'signals': {'values': q}}}, do_compression=packed)
)";

TEST_F(Matlab, FilesOfScipyAreRead) {
  if (!run_python(folder_, kScript)) GTEST_SKIP() << "no Python with scipy";
  for (const char* name : {"plain", "packed"})
    for (const char* kind : {".mat", "_struct.mat", "_simulink.mat"}) {
      const std::string file = std::string(name) + kind;
      const ReadArrays read = read_array_file(folder_.file(file));
      ASSERT_EQ(read.refused, "") << file;
      ASSERT_EQ(read.log.rows(), 500) << file;
      ASSERT_EQ(read.log.joints(), 2) << file;
      EXPECT_NEAR(read.log.q[1][100], std::cos(1.0), 1e-12) << file;
      ASSERT_FALSE(read.log.dq.empty()) << file;
      EXPECT_NEAR(read.log.dq[0][100], std::sin(1.0), 1e-6) << file;
    }
}

TEST_F(Matlab, ACutCompressedFileIsReadUpToTheCut) {
  if (!run_python(folder_, kScript)) GTEST_SKIP() << "no Python with scipy";
  const std::string bytes = read_file(folder_.file("packed.mat"));
  int read_some = 0;
  for (std::size_t size = 1; size < bytes.size(); size += 211) {
    const ReadArrays read = read_bytes(bytes.substr(0, size));
    if (!read.refused.empty()) continue;
    ++read_some;
    EXPECT_FALSE(read.issues.empty()) << size;
  }
  EXPECT_GT(read_some, 5);
}

TEST_F(Matlab, ScipyReadsWhatIsWritten) {
  if (!run_python(folder_, "import scipy.io\n")) GTEST_SKIP() << "no Python with scipy";
  written(log_with_extra());
  EXPECT_TRUE(run_python(folder_, R"(
import scipy.io as io
a = io.loadmat('log.mat')
assert a['t'].shape == (60, 1) and a['q'].shape == (60, 3) and a['q'][4, 2] == 4.2
assert 'extra_a_b' in a and a['faultline'][0].startswith('{')
)"));
}

TEST_F(Matlab, Version73IsRecognisedByTheBlockBeforeItsHdf5Data) {
  const char* script = R"(
import numpy as np, h5py
t = np.arange(50) * 0.01
with h5py.File('v73.mat', 'w', userblock_size=512) as f:
    for name, a in (('run/t', t[None, :]), ('run/q', np.stack([t, 2 * t]))):
        f[name] = a
        f[name].attrs['MATLAB_class'] = np.bytes_('double')
    f['about'] = np.frombuffer(b'text', dtype='u1').astype('u2')[:, None]
    f['about'].attrs['MATLAB_class'] = np.bytes_('char')
with open('v73.mat', 'r+b') as f:
    f.write(b'MATLAB 7.3 MAT-file, Platform: any'.ljust(116) + b' ' * 8 + b'\x00\x02IM')
)";
  if (!run_python(folder_, script)) GTEST_SKIP() << "no Python with h5py";
  const ReadArrays read = read_array_file(folder_.file("v73.mat"));
  EXPECT_EQ(read.refused, "");
  EXPECT_EQ(read.identity.format, "matlab");
  ASSERT_EQ(read.log.joints(), 2);
  EXPECT_EQ(read.log.q[1][30], 0.6);
}

TEST_F(Matlab, AFlippedBitOfACompressedFileIsReported) {
  const char* script = R"(
import numpy as np
from scipy.io import savemat
t = np.arange(400) * 0.01
savemat('whole.mat', {'t': t, 'q': np.random.default_rng(1).random((400, 2))}, do_compression=True)
)";
  if (!run_python(folder_, script)) GTEST_SKIP() << "no Python with scipy";
  const std::string whole = read_file(folder_.file("whole.mat"));
  for (std::size_t at = whole.size() / 3; at + 1 < whole.size(); at += whole.size() / 40) {
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ 64);
    const ReadArrays read = read_array_file(folder_.write("flipped.mat", flipped));
    EXPECT_TRUE(!read.refused.empty() || !read.issues.empty()) << at;
  }
}

TEST_F(Matlab, FilesOfMeasuredRobotsAreRead) {
  const std::filesystem::path data = shared_data();
  if (data.empty()) GTEST_SKIP();
  const OpenLogOptions emps{.columns = {{"t", {.name = "t"}}, {"q1", {.name = "qm"}}}};
  const ReadArrays one = read_array_file(data / "emps/DATA_EMPS.mat", emps);
  EXPECT_EQ(one.refused, "");
  EXPECT_EQ(one.log.rows(), 24841);
  OpenLogOptions of_ur3{.columns = {{"t", {.name = "mt"}}}};
  for (int joint = 1; joint <= 6; ++joint)
    of_ur3.columns["q" + std::to_string(joint)].name = "mq" + std::to_string(joint);
  const ReadArrays ur3 = read_array_file(data / "ur3-rosbag1/id1.mat", of_ur3);
  EXPECT_EQ(ur3.refused, "");
  EXPECT_EQ(ur3.identity.rows_read, 5200);
  EXPECT_EQ(ur3.log.joints(), 6);
}

}  // namespace
}  // namespace faultline
