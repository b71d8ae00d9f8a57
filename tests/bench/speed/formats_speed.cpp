// SPDX-License-Identifier: MIT
// Writes logs for tests/bench/speed/formats_speed.sh, and reads them: processor time in s.
#include <cstdio>
#include <cstring>
#include <ctime>
#include <string>
#include <vector>

#include "formats/log_writer.hpp"
#include "formats/mcap/mcap_file.hpp"
#include "formats/messages/encode_joint_state.hpp"
#include "formats/messages/message_source.hpp"
#include "formats/open_log.hpp"
#include "lib/core/random.hpp"

using namespace faultline;

namespace {

constexpr int kJoints = 3;
constexpr double kPeriod_s = 1e-3;

double processor_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

Log random_log(int rows) {
  Random random(1);
  Log log;
  for (int i = 0; i < rows; ++i) log.time.push_back(kPeriod_s * i);
  for (JointSignals* signals : {&log.q, &log.dq, &log.tau}) {
    signals->resize(kJoints);
    for (auto& joint : *signals)
      for (int i = 0; i < rows; ++i) joint.push_back(random.uniform());
  }
  return log;
}

/// The same rows as messages in chunks that are not compressed.
void write_plain_mcap(const std::string& path, const Log& log) {
  McapFile file(path, McapPacking::none);
  const auto channel = file.add_topic(
      {kStatesTopic, JointStateEncoder::kType, "ros2msg", JointStateEncoder::kDefinition, "cdr"});
  const JointStateEncoder encoder({"joint1", "joint2", "joint3"});
  std::string message;
  for (int i = 0; i < log.rows(); ++i) {
    JointRow row;
    for (int j = 0; j < kJoints; ++j) {
      row[0].push_back(log.q[j][i]);
      row[1].push_back(log.dq[j][i]);
      row[2].push_back(log.tau[j][i]);
    }
    message.clear();
    const std::int64_t stamp = 1'000'000LL * i;
    encoder.append(stamp, row, message);
    file.message(channel, static_cast<std::uint64_t>(stamp), message);
  }
  file.finish();
}

/// All columns one after the other, as a memory map wants them.
void write_raw(const std::string& path, const Log& log) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (!file) return;
  const auto write = [&](const std::vector<double>& values) {
    std::fwrite(values.data(), sizeof(double), values.size(), file);
  };
  write(log.time);
  for (const JointSignals* signals : {&log.q, &log.dq, &log.tau})
    for (const auto& joint : *signals) write(joint);
  std::fclose(file);
}

double read_s(const std::string& path) {
  const double before = processor_s();
  const auto raw = open_raw(path, false);
  RawBlock block;
  while (raw->next(block, 4096)) {
  }
  return processor_s() - before;
}

/// Of as many bytes as the file has, within memory that is there.
double copy_s(const std::string& path) {
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (!file) return 0.0;
  std::fseek(file, 0, SEEK_END);
  const auto size = static_cast<std::size_t>(std::ftell(file));
  std::fclose(file);
  std::vector<char> from(size, 'a'), to(size, 'b');
  const double before = processor_s();
  std::memcpy(to.data(), from.data(), size);
  return to[size / 2] == 'a' ? processor_s() - before : 0.0;
}

}  // namespace

/// write FOLDER ROWS | read FILE | copy FILE
int main(int count, char** arguments) {
  if (count < 3) return 2;
  const std::string what = arguments[1], path = arguments[2];
  if (what == "write" && count > 3) {
    const Log log = random_log(std::stoi(arguments[3]));
    write_log(path + "/log.flog", log);
    write_log(path + "/log.h5", log);
    write_plain_mcap(path + "/log.mcap", log);
    write_raw(path + "/raw", log);
    return 0;
  }
  std::printf("%.4f\n", what == "copy" ? copy_s(path) : read_s(path));
  return 0;
}
