// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "lib/core/error.hpp"

namespace faultline {

/// Limits the work that a file may cause before it is rejected. The time for a log is bounded by the size of
/// its file: compression, fill values and repeated rows could make hours of work from a few kB. The budget
/// counts the work by its usual cost, not by a clock, so that the result for a file is the same everywhere.
class WorkBudget {
 public:
  explicit WorkBudget(std::string path) : path_(std::move(path)) {}

  /// Throws Error(input) when the work so far is more than a log of `file_bytes` needs.
  void spend(std::int64_t work_ns, std::int64_t file_bytes) {
    spent_ns_ += work_ns;
    if (spent_ns_ > kFreeWork_ns + kWorkOfAByte_ns * file_bytes) refuse();
  }
  /// Restarts the count for another pass through the file.
  void start() { spent_ns_ = 0; }

 private:
  /// Work that every file may cause, ns.
  static constexpr std::int64_t kFreeWork_ns = 500'000'000;
  /// A row has a time of its own, so it takes at least a byte of the file at the best compression, and its
  /// values take some us.
  static constexpr std::int64_t kWorkOfAByte_ns = 2000;

  [[noreturn]] void refuse() const {
    throw Error(
        ErrorCode::input, path_,
        "holds far more rows or unpacked bytes than a log of its size (over 2 us of work for each byte of "
        "the file), so reading stopped. If it is a log, unpack it first, or write it again without "
        "compression and without parts that hold no log");
  }

  std::string path_;
  std::int64_t spent_ns_ = 0;
};

/// Usual costs of reading, ns, including the later processing of a row.
inline constexpr std::int64_t kRowWork_ns = 250, kValueWork_ns = 30, kMessageWork_ns = 500;

/// Returns the work, ns, to unpack so many bytes; `byte_ns` is one of the constants below.
constexpr std::int64_t unpack_work_ns(double byte_ns, std::int64_t bytes) {
  return static_cast<std::int64_t>(byte_ns * static_cast<double>(bytes));
}
inline constexpr double kZstdByte_ns = 1.0, kLz4Byte_ns = 1.0, kDeflateByte_ns = 3.0, kBz2Byte_ns = 10.0;
inline constexpr double kUtf16Byte_ns = 5.0;

/// Returns the work, ns, of handing on a table.
constexpr std::int64_t table_work_ns(std::int64_t rows, std::int64_t columns) {
  return rows * (kRowWork_ns + kValueWork_ns * columns);
}

}  // namespace faultline
