// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

namespace faultline {

/// How much work a file may ask for before it is refused. The time for a log is bounded by what its file
/// holds: compression, fill values and rows that repeat could make hours of work from a few kB. The budget
/// counts the work by its usual cost, not by a clock, so that the same file gives the same answer everywhere.
class WorkBudget {
 public:
  explicit WorkBudget(std::string path) : path_(std::move(path)) {}

  /// Throws Error(input) when all that was spent is more than a log of `file_bytes` needs.
  void spend(std::int64_t work_ns, std::int64_t file_bytes) {
    spent_ns_ += work_ns;
    if (spent_ns_ > kFreeWork_ns + kWorkOfAByte_ns * file_bytes) refuse();
  }
  /// For another pass through the file.
  void start() { spent_ns_ = 0; }

 private:
  /// What any file may ask for.
  static constexpr std::int64_t kFreeWork_ns = 500'000'000;
  /// A row bears a time of its own, so it takes a byte of the file at the best compression, and its values
  /// some us.
  static constexpr std::int64_t kWorkOfAByte_ns = 2000;

  [[noreturn]] void refuse() const;

  std::string path_;
  std::int64_t spent_ns_ = 0;
};

/// Usual costs of reading, ns, with what follows on a row until it is judged.
inline constexpr std::int64_t kRowWork_ns = 250, kValueWork_ns = 30, kMessageWork_ns = 500;

/// Work to unpack so many bytes; `byte_ns` is one of those below.
constexpr std::int64_t unpack_work_ns(double byte_ns, std::int64_t bytes) {
  return static_cast<std::int64_t>(byte_ns * static_cast<double>(bytes));
}
inline constexpr double kZstdByte_ns = 1.0, kLz4Byte_ns = 1.0, kDeflateByte_ns = 3.0, kBz2Byte_ns = 10.0;

/// Work of handing on a table.
constexpr std::int64_t table_work_ns(std::int64_t rows, std::int64_t columns) {
  return rows * (kRowWork_ns + kValueWork_ns * columns);
}

}  // namespace faultline
