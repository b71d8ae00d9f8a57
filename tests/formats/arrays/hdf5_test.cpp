// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>
#include <csignal>
#include <functional>

#include "formats/log_writer.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "tests/formats/arrays/read_bytes.hpp"
#include "tests/support/limits.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/run_python.hpp"

namespace faultline {
namespace {

using Values = std::vector<double>;

class Hdf5 : public testing::Test {
 protected:
  std::string written(const Log& log) {
    write_log(folder_.file("log.h5"), log);
    return read_file(folder_.file("log.h5"));
  }

  TemporaryFolder folder_;
};

Log log_with_extra(int rows) {
  Log log = numbered_log(rows, 3);
  log.tau[1][7] = std::nan("");
  log.q_ref = log.q;
  log.extra = {{"motor temp_ms", "", log.q[0]},
               {"q", "degC", log.q[1]},
               {"a/b", "V", log.q[2]},
               {"a b", "\xC2\xB5m", log.q[0]}};
  return log;
}

TEST_F(Hdf5, AWrittenLogIsReadBackToTheLastBit) {
  const Log log = log_with_extra(5000);
  const ReadArrays read = read_bytes(written(log));
  EXPECT_EQ(read.refused, "");
  EXPECT_TRUE(read.issues.empty());
  EXPECT_EQ(read.identity.format, "hdf5");
  EXPECT_EQ(read.log.time, log.time);
  EXPECT_EQ(read.log.q, log.q);
  EXPECT_EQ(read.log.q_ref, log.q);
  EXPECT_TRUE(std::isnan(read.log.tau[1][7]));
  EXPECT_EQ(read.log.tau[2], log.tau[2]);
  ASSERT_EQ(read.log.extra.size(), log.extra.size());
  for (std::size_t i = 0; i < log.extra.size(); ++i) {
    EXPECT_EQ(read.log.extra[i].name, log.extra[i].name);
    EXPECT_EQ(read.log.extra[i].unit, log.extra[i].unit);
    EXPECT_EQ(read.log.extra[i].values, log.extra[i].values);
  }
}

TEST_F(Hdf5, ALogOfOneRowIsReadBack) {
  EXPECT_EQ(read_bytes(written(numbered_log(1, 3))).log.q, numbered_log(1, 3).q);
}

TEST_F(Hdf5, SegmentsChangeNoByte) {
  const Log log = log_with_extra(5000);
  const std::string whole = written(log);
  const auto writer = create_log(folder_.file("cut.h5"));
  for (int row = 0; row < log.rows(); row += 777)
    writer->write(slice(log, row, std::min(log.rows(), row + 777)));
  writer->commit();
  EXPECT_TRUE(read_file(folder_.file("cut.h5")) == whole);
}

TEST_F(Hdf5, AFlippedBitLosesOneChunkAndIsReported) {
  std::string bytes = written(numbered_log(5000, 3));
  const double value = 2500.1;
  const std::size_t place = bytes.find(std::string(reinterpret_cast<const char*>(&value), sizeof value));
  ASSERT_NE(place, std::string::npos);
  bytes[place] = static_cast<char>(bytes[place] ^ 1);
  const ReadArrays read = read_bytes(bytes);
  ASSERT_EQ(read.log.rows(), 5000);
  EXPECT_TRUE(std::isnan(read.log.q[1][2500]));
  EXPECT_EQ(std::count_if(read.log.q[0].begin(), read.log.q[0].end(), [](double v) { return std::isnan(v); }),
            1024);
  EXPECT_EQ(read.log.dq, numbered_log(5000, 3).dq);
  ASSERT_TRUE(read.issues.find("array_damaged", "q1"));
  EXPECT_EQ(read.issues.find("array_damaged", "q1")->severity, Severity::severe);
  EXPECT_EQ(read.issues.find("array_damaged", "q1")->first_row, 2049);
}

TEST_F(Hdf5, ALostTimeLosesItsRows) {
  Log log = numbered_log(5000, 1);
  std::string bytes = written(log);
  const double value = log.time[4500];
  const std::size_t place = bytes.find(std::string(reinterpret_cast<const char*>(&value), sizeof value));
  bytes[place] = static_cast<char>(bytes[place] ^ 1);
  const ReadArrays read = read_bytes(bytes);
  EXPECT_EQ(read.log.rows(), 4096);
  EXPECT_EQ(read.issues.rows_dropped(), 904);
}

TEST_F(Hdf5, ACutFileNeverLosesRowsWithoutAReport) {
  const Log log = numbered_log(3000, 2);
  const std::string bytes = written(log);
  int most = 0;
  for (std::size_t size = 1; size < bytes.size(); size += size < 3000 ? 101 : 4999) {
    const ReadArrays read = read_bytes(bytes.substr(0, size));
    if (!read.refused.empty()) continue;
    EXPECT_FALSE(read.issues.empty()) << size;
    most = std::max(most, read.log.rows());
    for (int i = 0; i < read.log.rows(); ++i) {
      const auto row =
          static_cast<std::size_t>(std::lround(read.log.time[static_cast<std::size_t>(i)] / 0.01));
      const double q = read.log.q[0][static_cast<std::size_t>(i)];
      ASSERT_TRUE(std::isnan(q) || q == log.q[0][row]) << size;
    }
  }
  EXPECT_GT(most, 1000);
}

/// Wherever the disk is full: at the first byte, in the tables of the file, in the values, at its end.
TEST_F(Hdf5, AFullDiskIsReportedAndTheLibraryKeepsWorking) {
  const Log log = log_with_extra(9000);
  const auto whole = static_cast<rlim_t>(written(log).size());
  std::signal(SIGXFSZ, SIG_IGN);
  int refused = 0;
  for (rlim_t room = 0; room < whole; room += 1 + whole / 25) {
    const Limit limit(RLIMIT_FSIZE, room);
    try {
      write_log(folder_.file("full.h5"), log);
      ADD_FAILURE() << "written where only " << room << " of " << whole << " bytes fit";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::output);
      EXPECT_NE(error.message().find("cannot be written (File too large)"), std::string::npos)
          << error.message();
      ++refused;
    }
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
      EXPECT_EQ(entry.path().filename(), "log.h5");
  }
  EXPECT_GE(refused, 20);
  std::signal(SIGXFSZ, SIG_DFL);
  EXPECT_EQ(read_bytes(written(log)).log.q, log.q);
}

/// A file with a time and positions of 300 rows, made by `more`.
std::string file_with(const std::string& path, const std::function<void(hid_t)>& more) {
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  more(file);
  H5Fclose(file);
  return path;
}

void add_vector(hid_t file, const char* name, int rows) {
  std::vector<double> values;
  for (int i = 0; i < rows; ++i) values.push_back(0.01 * i);
  const hsize_t size = values.size();
  const hid_t space = H5Screate_simple(1, &size, nullptr);
  const hid_t dataset =
      H5Dcreate2(file, name, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  H5Dclose(dataset);
  H5Sclose(space);
}

void add_time_and_position(hid_t file) {
  add_vector(file, "t", 300);
  add_vector(file, "q1", 300);
}

TEST_F(Hdf5, ALinkIntoAnotherFileIsNamed) {
  const std::string other =
      file_with(folder_.file("other.h5"), [](hid_t file) { add_vector(file, "tau1", 300); });
  const ReadArrays read = read_array_file(file_with(folder_.file("log.h5"), [&](hid_t file) {
    add_time_and_position(file);
    H5Lcreate_external(other.c_str(), "/tau1", file, "tau1", H5P_DEFAULT, H5P_DEFAULT);
  }));
  EXPECT_TRUE(read.log.tau.empty());
  const Issue* issue = read.issues.find("signal_left_out", "/tau1");
  ASSERT_NE(issue, nullptr);
  EXPECT_EQ(issue->severity, Severity::warning);
  EXPECT_NE(issue->message.find("link into another file"), std::string::npos) << issue->message;
}

TEST_F(Hdf5, ASoftLinkIsNamedOnlyIfItsTargetIsMissing) {
  const ReadArrays read = read_array_file(file_with(folder_.file("log.h5"), [](hid_t file) {
    add_time_and_position(file);
    H5Lcreate_soft("/q1", file, "position", H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_soft("q1", file, "beside", H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_soft("/tau", file, "tau1", H5P_DEFAULT, H5P_DEFAULT);
  }));
  ASSERT_EQ(read.issues.all().size(), 1u);
  EXPECT_EQ(read.issues.all()[0].channel, "/tau1");
}

TEST_F(Hdf5, ASignalOfAnotherLengthIsNamed) {
  const ReadArrays read = read_array_file(file_with(folder_.file("log.h5"), [](hid_t file) {
    add_time_and_position(file);
    add_vector(file, "tau1", 299);
    add_vector(file, "gains", 7);
  }));
  EXPECT_TRUE(read.log.tau.empty());
  const Issue* lost = read.issues.find("signal_left_out");
  ASSERT_NE(lost, nullptr);
  EXPECT_NE(lost->message.find("\"tau1\" (299) does not fit a table of 300 rows"), std::string::npos)
      << lost->message;
  const Issue* constants = read.issues.find("array_left_out");
  ASSERT_NE(constants, nullptr);
  EXPECT_EQ(constants->severity, Severity::note);
}

TEST_F(Hdf5, ConvertingALogThatLosesASignalEndsWithStatusOneAndNamesIt) {
  const std::string other =
      file_with(folder_.file("other.h5"), [](hid_t file) { add_vector(file, "tau1", 300); });
  file_with(folder_.file("whole.h5"), add_time_and_position);
  file_with(folder_.file("short.h5"), [](hid_t file) {
    add_time_and_position(file);
    add_vector(file, "tau1", 299);
  });
  file_with(folder_.file("link.h5"), [&](hid_t file) {
    add_time_and_position(file);
    H5Lcreate_external(other.c_str(), "/tau1", file, "tau1", H5P_DEFAULT, H5P_DEFAULT);
  });
  const auto convert = [&](const char* name) {
    return run_program({"convert", folder_.file(name), folder_.file("out.csv")});
  };
  EXPECT_EQ(convert("whole.h5").status, 0);
  for (const char* name : {"short.h5", "link.h5"}) {
    const ProgramRun run = convert(name);
    EXPECT_EQ(run.status, 1) << name << run.err;
    EXPECT_NE(run.err.find("tau1\""), std::string::npos) << run.err;
    EXPECT_NE(read_file(folder_.file("out.csv")).find("tau1"), std::string::npos) << "the log says it, too";
  }
}

TEST_F(Hdf5, TheSignatureIsFoundAfterAUserBlock) {
  const std::string bytes = written(numbered_log(20, 1));
  EXPECT_EQ(read_bytes(std::string(512, 'x') + bytes).identity.format, "hdf5");
}

constexpr const char* kScript = R"(
import numpy as np, h5py
n = 3000
t = np.arange(n) * 0.01
q = np.stack([np.sin(t), np.cos(t)], axis=1)
def h5(name): return h5py.File(name, 'w')
with h5('groups.h5') as f:
    f['run/t'] = t
    f['run/q'] = (q * 180 / np.pi).astype('>f4')
    f['run/q'].attrs['unit'] = 'deg'
    f['run/dq'] = q.T
    f['run/name'] = 'text'
    f['run/dt'] = 0.01
    f['run/image'] = np.zeros((4, 5, 6))
with h5('table.h5') as f:
    a = np.zeros(n, dtype=[('t', '<f8'), ('q', '<f4', (2,)), ('label', 'S4'), ('mode', '<i2')])
    a['t'] = t; a['q'] = q; a['mode'] = 3
    f.create_dataset('table', data=a, chunks=(256,), compression='gzip', shuffle=True)
with h5('named.h5') as f:
    d = f.create_dataset('data', data=np.column_stack([t, q]), chunks=(100, 2), compression='gzip')
    d.attrs['columns'] = ['time', 'pos_1', 'pos_2']
    d.attrs['units'] = ['s', 'rad', 'rad']
with h5('holes.h5') as f:
    f['t'] = t
    d = f.create_dataset('q', shape=(n, 2), chunks=(500, 2), dtype='f8')
    d[:1000] = q[:1000]
    d[2000:2500] = q[2000:2500]
with h5('lzf.h5') as f:
    f.create_dataset('t', data=t, compression='lzf')
with h5py.File('late.h5', 'w', libver='latest', userblock_size=1024) as f:
    f['t'] = t
    f.create_dataset('q', data=q, chunks=(64, 1), fletcher32=True)
)";

TEST_F(Hdf5, FilesOfH5pyAreRead) {
  if (!run_python(folder_, kScript)) GTEST_SKIP() << "no Python with h5py";
  for (const char* name : {"groups.h5", "table.h5", "named.h5", "late.h5"}) {
    const ReadArrays read = read_array_file(folder_.file(name));
    ASSERT_EQ(read.refused, "") << name;
    ASSERT_EQ(read.log.rows(), 3000) << name;
    ASSERT_EQ(read.log.joints(), 2) << name;
    for (std::size_t i = 0; i < 3000; i += 7) {
      ASSERT_NEAR(read.log.q[0][i], std::sin(0.01 * static_cast<double>(i)), 1e-6) << name;
      ASSERT_NEAR(read.log.q[1][i], std::cos(0.01 * static_cast<double>(i)), 1e-6) << name;
    }
  }
  EXPECT_TRUE(read_array_file(folder_.file("groups.h5")).issues.find("array_left_out"));
  EXPECT_EQ(read_array_file(folder_.file("table.h5")).extra("mode")[5], 3.0);
}

TEST_F(Hdf5, AnUnsupportedFilterIsNamedAsTheReason) {
  if (!run_python(folder_, kScript)) GTEST_SKIP() << "no Python with h5py";
  EXPECT_NE(read_array_file(folder_.file("lzf.h5")).refused.find("its compression is not gzip"),
            std::string::npos);
}

TEST_F(Hdf5, ValuesThatWereNeverWrittenAreMissingAndNotZero) {
  if (!run_python(folder_, kScript)) GTEST_SKIP() << "no Python with h5py";
  const ReadArrays read = read_array_file(folder_.file("holes.h5"));
  ASSERT_EQ(read.log.rows(), 3000);
  for (const std::size_t row : {1000, 1999, 2500, 2999}) EXPECT_TRUE(std::isnan(read.log.q[0][row])) << row;
  for (const std::size_t row : {0, 999, 2000, 2499}) EXPECT_FALSE(std::isnan(read.log.q[0][row])) << row;
  EXPECT_TRUE(read.issues.find("array_damaged", "q1"));
}

TEST_F(Hdf5, TablesOfPandasAreRead) {
  const char* script = R"(
import numpy as np, pandas as pd
f = pd.DataFrame({'t': np.arange(50) * 0.01, 'q1': np.arange(50.0), 'q2': -np.arange(50.0)})
f.to_hdf('table.h5', 'log', format='table')
f.to_hdf('fixed.h5', 'log', format='fixed')
)";
  if (!run_python(folder_, script)) GTEST_SKIP() << "no Python with pandas and tables";
  for (const char* name : {"table.h5", "fixed.h5"}) {
    const ReadArrays read = read_array_file(folder_.file(name));
    EXPECT_EQ(read.refused, "") << name;
    ASSERT_EQ(read.log.joints(), 2) << name;
    EXPECT_EQ(read.log.q[1][7], -7.0) << name;
  }
}

}  // namespace
}  // namespace faultline
