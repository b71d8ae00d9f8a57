// SPDX-License-Identifier: MIT
// Writes a log as CSV, or reads one and prints the processor time that took.
// Usage: faultline_csv_speed write FILE ROWS shortest|fixed
//        faultline_csv_speed read FILE table|log|hashed|ahead
#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include "formats/open_log.hpp"
#include "lib/core/random.hpp"
#include "lib/log/prefetch.hpp"

namespace faultline {
namespace {

constexpr int kColumns = 9;
constexpr int kSegmentRows = 4096;

double processor_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double wall_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void write_log_file(const char* path, int rows, bool fixed) {
  std::FILE* file = std::fopen(path, "wb");
  Random random(1);
  double state[kColumns] = {};
  std::string text = "t,q1,q2,q3,dq1,dq2,dq3,tau1,tau2,tau3\n";
  for (int row = 0; row < rows; ++row) {
    text += fixed ? fmt::format("{:.3f}", 0.001 * row) : fmt::format("{}", row / 1000.0);
    for (int i = 0; i < kColumns; ++i) {
      // Slow positions, noisy velocities, torques with the weight of an axis in the last.
      state[i] = i < 3 ? std::remainder(state[i] + 1e-3 * random.normal(), 3.0) : 0.1 * random.normal();
      const double value = state[i] + (i == kColumns - 1 ? 4.9 : 0.0);
      text += fixed ? fmt::format(",{:.6f}", value) : fmt::format(",{}", value);
    }
    text += '\n';
    if (text.size() > 1 << 20 || row + 1 == rows) {
      std::fwrite(text.data(), 1, text.size(), file);
      text.clear();
    }
  }
  std::fclose(file);
}

struct Sum {
  long rows = 0;
  double values = 0.0;
};

Sum read_table(const char* path) {
  const auto reader = open_raw(path, false);
  RawBlock block;
  Sum sum;
  while (reader->next(block, kSegmentRows)) {
    sum.rows += block.rows;
    for (const auto& column : block.columns) sum.values += column[0];
  }
  return sum;
}

Sum read_log(const char* path, bool hashed, bool ahead) {
  OpenLogOptions options;
  options.parts.hashed = hashed;
  auto source = open_log(path, options);
  if (ahead) source = prefetched(std::move(source));
  Log segment;
  Sum sum;
  while (source->next(segment)) {
    sum.rows += segment.rows();
    sum.values += segment.q[0][0];
  }
  return sum;
}

/// Prints processor time, wall time, rows and the most memory taken.
void time_reading(const char* path, const std::string& how) {
  const double begin = processor_s(), wall = wall_s();
  const Sum sum = how == "table" ? read_table(path) : read_log(path, how != "log", how == "ahead");
  const double took = processor_s() - begin, waited = wall_s() - wall;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  fmt::print("{:.4f} {:.4f} {} {:.1f} {}\n", took, waited, sum.rows,
             static_cast<double>(usage.ru_maxrss) / 1024.0, sum.values);
}

}  // namespace
}  // namespace faultline

int main(int count, char** words) {
  const std::string what = count > 1 ? words[1] : "";
  if (what == "write" && count == 5) {
    faultline::write_log_file(words[2], std::atoi(words[3]), std::string(words[4]) == "fixed");
    return 0;
  }
  if (what == "read" && count == 4) {
    faultline::time_reading(words[2], words[3]);
    return 0;
  }
  fmt::print(stderr, "give write FILE ROWS shortest|fixed, or read FILE table|log|hashed|ahead\n");
  return 2;
}
