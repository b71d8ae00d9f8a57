// SPDX-License-Identifier: MIT
// Small files that ask for much memory or time are refused, or read without the part that asks for it, with a
// sentence. How much they take is measured by tests/bench/hostile_files.sh.
#include <gtest/gtest.h>
#include <hdf5.h>
#include <sqlite3.h>
#include <zlib.h>

#include <ctime>

#include "formats/log_writer.hpp"
#include "tests/formats/messages/made_recordings.hpp"

namespace faultline {
namespace {

constexpr std::size_t kMiB = 1 << 20;
constexpr const char* kTooMuch = "far more rows or unpacked bytes";
/// Processor time of reading any of the files, s; it took 20 to 60 without bounds.
constexpr double kMostTime_s = 8.0;

const std::vector<std::string> kTwo{"joint_1", "joint_2"};

/// Reads what was made, in bounded time.
made::Reading read_soon(const std::string& path) {
  const std::clock_t begin = std::clock();
  made::Reading reading = made::read_file(path);
  EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, kMostTime_s) << path;
  return reading;
}

class HostileFile : public testing::Test {
 protected:
  made::Reading reading_of(const std::string& bytes) { return read_soon(folder_.write("log", bytes)); }

  std::string database(const std::string& sql) {
    const std::string path = folder_.file("run.db3");
    sqlite3* db = nullptr;
    sqlite3_open(path.c_str(), &db);
    EXPECT_EQ(sqlite3_exec(db, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(db);
    sqlite3_close(db);
    return path;
  }

  TemporaryFolder folder_;
};

std::string refusal(const made::Reading& reading) { return reading.refused; }

void expect_says(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

std::string gz_packed(const std::string& bytes) {
  z_stream stream{};
  deflateInit2(&stream, 6, Z_DEFLATED, 15 + 16, 9, Z_DEFAULT_STRATEGY);
  std::string out(compressBound(bytes.size()) + 64, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

/// A chunk of one large message that is no joint state.
std::string image_chunk(std::size_t bytes) {
  return made::chunk(made::topic(2, "/image", "sensor_msgs/msg/Image") +
                     made::message(2, 0, std::string(bytes, '\0')));
}

TEST_F(HostileFile, AnMcapChunkThatUnpacksBeyondTheLimitIsSkipped) {
  const made::Reading reading =
      reading_of(made::mcap(made::topic(1, "/joint_states") + made::states(1, 0, 50, kTwo) +
                            image_chunk(100 * kMiB) + made::states(1, 50, 50, kTwo)));
  EXPECT_EQ(reading.log.rows(), 100);
  expect_says(reading.message_of("chunk_damaged"), "more than the 64 MiB");
}

TEST_F(HostileFile, McapChunksThatUnpackToMuchForeignDataAreRefused) {
  const std::string part = image_chunk(50 * kMiB);
  std::string all = made::topic(1, "/joint_states") + made::states(1, 0, 50, kTwo);
  for (int i = 0; i < 40; ++i) all += part;
  expect_says(refusal(reading_of(made::mcap(all))), kTooMuch);
}

TEST_F(HostileFile, BagChunksThatUnpackToMuchForeignDataAreRefused) {
  std::string all = made::connection(0, "/joint_states");
  for (int k = 0; k < 50; ++k) all += made::bag_state(0, k, kTwo, 0.0);
  const std::string part =
      made::bag_chunk(made::connection(1, "/image", "sensor_msgs/Image") +
                      made::bag_record({{"conn", made::word(1)}, {"op", "\x02"}, {"time", "12345678"}},
                                       std::string(20 * kMiB, '\0')));
  for (int i = 0; i < 40; ++i) all += part;
  expect_says(refusal(reading_of(made::bag(all))), kTooMuch);
}

TEST_F(HostileFile, MillionsOfRepeatedMessagesAreRefused) {
  std::string same;
  for (int i = 0; i < 100'000; ++i) same += made::states(1, 0, 1, kTwo);
  const std::string part = made::chunk(same);
  std::string all = made::topic(1, "/joint_states");
  for (int i = 0; i < 60; ++i) all += part;
  expect_says(refusal(reading_of(made::mcap(all))), kTooMuch);
}

TEST_F(HostileFile, NewJointNamesInEachMessageMakeABoundedNumberOfColumns) {
  std::string all = made::topic(1, "/joint_states") + made::states(1, 0, 50, kTwo);
  for (int k = 0; k < 1000; ++k) {
    std::vector<std::string> names;
    for (int j = 0; j < 100; ++j) names.push_back("j" + std::to_string(k) + "_" + std::to_string(j));
    all += made::message(1, 50, made::joint_state(50, names, std::vector<double>(100, 0.5)));
  }
  const made::Reading reading = reading_of(made::mcap(made::chunk(all)));
  EXPECT_EQ(reading.log.rows(), 50);
  EXPECT_LE(reading.log.extra.size(), 1024u);
  expect_says(reading.message_of("streams_left_out"), "at most 1024 columns");
  EXPECT_EQ(reading.rows_read, reading.log.rows() + reading.issues.rows_dropped());
}

TEST_F(HostileFile, AHundredThousandTopicsTakeNoQuadraticTime) {
  std::string all = made::connection(0, "/joint_states");
  for (int k = 0; k < 50; ++k) all += made::bag_state(0, k, kTwo, 0.0);
  for (std::uint32_t id = 1; id < 100'000; ++id) all += made::connection(id, "/t" + std::to_string(id));
  EXPECT_EQ(reading_of(made::bag(made::bag_chunk(all))).log.rows(), 50);
}

TEST_F(HostileFile, AJsonMessageWithAVeryLongListIsRefused) {
  ByteBuilder schema, channel;
  schema.put(std::uint16_t{1}).put_text("sensor_msgs/msg/JointState").put_text("jsonschema").put_text("");
  channel.put(std::uint16_t{1}).put(std::uint16_t{1}).put_text("/joint_states").put_text("json").put_text("");
  std::string list = "{\"position\":[0";
  for (std::size_t i = 0; i < 4 * kMiB; ++i) list += ",0";
  const made::Reading reading = reading_of(made::mcap(
      made::chunk(made::record(McapOp::schema, schema.bytes()) +
                  made::record(McapOp::channel, channel.bytes()) + made::message(1, 0, list + "]}"))));
  expect_says(refusal(reading), "has no message with joint states that can be read");
}

constexpr const char* kTopicsTable =
    "CREATE TABLE topics(id INTEGER PRIMARY KEY, name, type, serialization_format);"
    "INSERT INTO topics VALUES(1, '/joint_states', 'sensor_msgs/msg/JointState', 'cdr');";

TEST_F(HostileFile, AComputedColumnIsRefused) {
  const std::string path = database(
      std::string(kTopicsTable) +
      "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id, timestamp, data AS (hex(zeroblob(100000000))));"
      "WITH RECURSIVE c(x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM c WHERE x < 500) "
      "INSERT INTO messages(id, topic_id, timestamp) SELECT x, 1, x FROM c");
  expect_says(refusal(read_soon(path)), "the table \"messages\" has a computed column");
}

TEST_F(HostileFile, AViewInPlaceOfATableIsRefused) {
  const std::string path =
      database(std::string(kTopicsTable) +
               "CREATE VIEW messages AS WITH RECURSIVE c(x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM c) "
               "SELECT x AS id, 1 AS topic_id, x AS timestamp, x'00' AS data FROM c");
  expect_says(refusal(read_soon(path)), "\"messages\" is not a plain table");
}

TEST_F(HostileFile, ADefaultValueOfManyRowsIsRefused) {
  const std::string path =
      database(std::string(kTopicsTable) +
               "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id, timestamp);"
               "WITH RECURSIVE c(x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM c WHERE x < 60000) "
               "INSERT INTO messages SELECT x, 1, x FROM c;"
               "ALTER TABLE messages ADD COLUMN data DEFAULT x'" +
               std::string(400'000, '0') + "'");
  expect_says(refusal(read_soon(path)), kTooMuch);
}

TEST_F(HostileFile, PackedBlankLinesAreRefused) {
  const std::string few = "t,q1\n0,0\n1,1\n2,2\n";
  expect_says(refusal(reading_of(gz_packed(few + std::string(100 * kMiB, '\n')))), kTooMuch);
}

TEST_F(HostileFile, PackedRowsThatRepeatAreRefused) {
  std::string rows = "t,q1\n0,0\n1,1\n2,2\n";
  for (std::size_t i = 0; i < 6 * kMiB; ++i) rows += "9,9\n";
  expect_says(refusal(reading_of(made::zstd_packed(rows))), kTooMuch);
}

/// The other side: what the best compression makes of a robot that rests for long is a log.
std::string resting(int rows) {
  std::string text = "t";
  for (const char* quantity : {"q", "dq", "tau"})
    for (int joint = 1; joint <= 6; ++joint) text += "," + std::string(quantity) + std::to_string(joint);
  text += "\n";
  std::string rest;
  for (int column = 0; column < 18; ++column) rest += ",0.12345";
  for (int k = 0; k < rows; ++k)
    text += std::to_string(k / 1000) + "." + std::to_string(1000 + k % 1000).substr(1) + rest + "\n";
  return text;
}

TEST_F(HostileFile, APackedLogOfARobotAtRestForMinutesIsRead) {
  constexpr int kRows = 300'000;
  const std::string text = resting(kRows);
  EXPECT_EQ(reading_of(gz_packed(text)).log.rows(), kRows);
  EXPECT_EQ(reading_of(made::zstd_packed(text)).log.rows(), kRows);
}

// ---- arrays

/// A file of datasets of doubles by HDF5 itself.
class Hdf5Made {
 public:
  explicit Hdf5Made(const std::string& path)
      : file_(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT)) {}
  ~Hdf5Made() { H5Fclose(file_); }
  Hdf5Made(const Hdf5Made&) = delete;
  Hdf5Made& operator=(const Hdf5Made&) = delete;

  /// Writes `values` from row `at` on; in chunks with gzip unless `chunk` is 0.
  void add(const char* name, hsize_t rows, hsize_t chunk, const std::vector<double>& values, hsize_t at = 0,
           std::vector<hsize_t> more = {}) {
    std::vector<hsize_t> shape{rows}, chunks{chunk};
    for (const hsize_t size : more) shape.push_back(size), chunks.push_back(size);
    const int rank = static_cast<int>(shape.size());
    std::vector<hsize_t> most = shape;
    if (chunk > 0) most[0] = H5S_UNLIMITED;
    const hid_t space = H5Screate_simple(rank, shape.data(), most.data()),
                creation = H5Pcreate(H5P_DATASET_CREATE);
    if (chunk > 0) H5Pset_chunk(creation, rank, chunks.data());
    if (chunk > 0) H5Pset_deflate(creation, 9);
    const hid_t dataset =
        H5Dcreate2(file_, name, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    if (!values.empty()) {
      const hsize_t count = values.size();
      const hid_t memory = H5Screate_simple(1, &count, nullptr);
      std::vector<hsize_t> start(shape.size(), 0), size = shape;
      start[0] = at;
      size[0] = count;
      H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr);
      H5Dwrite(dataset, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, values.data());
      H5Sclose(memory);
    }
    H5Dclose(dataset);
    H5Pclose(creation);
    H5Sclose(space);
  }

  /// Writes so many chunks of 1 Mi zeros, which are packed once.
  void add_zeros(const char* name, hsize_t chunks) {
    add(name, chunks * kMiB, kMiB, std::vector<double>(kMiB));
    const hid_t dataset = H5Dopen2(file_, name, H5P_DEFAULT);
    hsize_t at = 0, size = 0;
    H5Dget_chunk_storage_size(dataset, &at, &size);
    std::vector<char> packed(size);
    std::uint32_t skipped_filters = 0;
    H5Dread_chunk(dataset, H5P_DEFAULT, &at, &skipped_filters, packed.data());
    for (hsize_t chunk = 1; chunk < chunks; ++chunk) {
      at = chunk * kMiB;
      H5Dwrite_chunk(dataset, H5P_DEFAULT, skipped_filters, &at, size, packed.data());
    }
    H5Dclose(dataset);
  }

 private:
  hid_t file_;
};

std::vector<double> counted(std::size_t rows) {
  std::vector<double> values(rows);
  for (std::size_t i = 0; i < rows; ++i) values[i] = 1e-3 * static_cast<double>(i);
  return values;
}

class HostileHdf5 : public HostileFile {
 protected:
  std::string path_ = folder_.file("run.h5");
};

TEST_F(HostileHdf5, ADatasetOutsideTheLogIsNotRead) {
  {
    Hdf5Made file(path_);
    file.add("t", 1000, 1000, counted(1000));
    file.add("q1", 1000, 1000, counted(1000));
    file.add("image", 40 * kMiB, 40 * kMiB, std::vector<double>(40 * kMiB));
  }
  const made::Reading reading = read_soon(path_);
  EXPECT_EQ(reading.log.rows(), 1000);
  EXPECT_EQ(reading.message_of("array_damaged"), "");
  EXPECT_NE(reading.message_of("array_left_out") + reading.message_of("signal_left_out"), "");
}

TEST_F(HostileHdf5, RowsWithoutBytesInTheFileAreRefused) {
  for (const bool zeros : {true, false}) {
    {
      Hdf5Made file(path_);
      constexpr hsize_t kRows = hsize_t{1} << 31;
      for (const char* name : {"t", "q1"})
        if (zeros)
          file.add_zeros(name, 40);
        else
          file.add(name, kRows, kMiB, std::vector<double>(kMiB), kRows - kMiB);
    }
    expect_says(refusal(read_soon(path_)), kTooMuch);
  }
}

TEST_F(HostileHdf5, ALogInOneHugeChunkIsRefusedWithAdvice) {
  {
    Hdf5Made file(path_);
    file.add("t", 1000, 1000, counted(1000));
    file.add("q1", 1000, 13 * kMiB, counted(1000));
  }
  expect_says(refusal(read_soon(path_)), "h5repack");
}

TEST_F(HostileHdf5, IntactFilesWithoutATableAreRefusedWithTheReason) {
  const auto made_of = [&](auto add) {
    {
      Hdf5Made file(path_);
      add(file);
    }
    return refusal(read_soon(path_));
  };
  expect_says(made_of([](Hdf5Made& file) {
                file.add("image", 4, 0, {}, 0, {5, 6});
              }),
              "three dimensions or more, but a log needs a vector of times");
  expect_says(made_of([](Hdf5Made& file) { file.add("t", 0, 0, {}), file.add("q1", 0, 0, {}); }),
              "nothing was recorded");
  for (const hsize_t chunk : {hsize_t{0}, hsize_t{100}})
    expect_says(
        made_of([&](Hdf5Made& file) { file.add("t", 100, chunk, {}), file.add("q1", 100, chunk, {}); }),
        "has space for rows, but none was written");
}

}  // namespace
}  // namespace faultline
