// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "formats/messages/joint_layout.hpp"
#include "lib/core/issue.hpp"
#include "lib/log/raw_reader.hpp"

// Checks of a recording while its messages are read.
namespace faultline {

/// Counts the messages of streams that could be rows of the log, such as those with other joint names or on
/// another topic, so that each lost one is reported.
class RivalStreams {
 public:
  RivalStreams() = default;
  RivalStreams(const std::vector<JointStream>& streams, const JointLayout& layout)
      : is_rival_(layout.is_rival), since_(streams.size(), 0) {
    const std::int64_t rows =
        std::max<std::int64_t>(1, streams[static_cast<std::size_t>(layout.main)].messages);
    for (const JointStream& stream : streams)
      most_.push_back(kAlone * std::max<std::int64_t>(1, stream.messages / rows));
  }

  /// Counts a message of the stream. If the stream continues without the main one, its messages are rows that
  /// the log lacks; returns the number of rows that this message adds.
  std::int64_t rows_lost_by(int stream) {
    const auto s = static_cast<std::size_t>(stream);
    if (!is_rival_[s]) return 0;
    any_came_ = true;
    if (++since_[s] <= most_[s]) return 0;
    return since_[s] == most_[s] + 1 ? since_[s] : 1;
  }

  /// Counts a row of the log, which takes the latest message of each stream.
  void at_row() {
    if (any_came_) count(1);
  }

  /// Adds a note about the messages that are in no row.
  void report_at_end(Issues& issues) {
    count(0);
    if (between_rows_ == 0) return;
    issues.add({"messages_between_rows", "", Severity::note,
                "messages about other joints came between those of the log; each row holds the latest of "
                "them, and the others are in no row",
                0, kNan, between_rows_});
  }

 private:
  /// A stream continues alone when so many of its messages (more if it sends several per row) follow each
  /// other without one of the main stream.
  static constexpr std::int64_t kAlone = 10;

  /// Counts the messages that are in no row, without those already counted as lost rows.
  void count(std::int64_t taken) {
    for (std::size_t s = 0; s < since_.size(); ++s) {
      if (since_[s] <= most_[s]) between_rows_ += std::max<std::int64_t>(0, since_[s] - taken);
      since_[s] = 0;
    }
    any_came_ = false;
  }

  std::vector<bool> is_rival_;       ///< by stream, as are most_ and since_
  std::vector<std::int64_t> most_;   ///< messages allowed between two rows
  std::vector<std::int64_t> since_;  ///< messages since the last row
  bool any_came_ = false;            ///< since the last row
  std::int64_t between_rows_ = 0;    ///< messages that are in no row
};

/// Tests if the positions of the rows are those of two publishers in turn: each row is near the one before
/// the last, not near the last one.
class AlternatingRows {
 public:
  /// Adds the positions of all joints, always in the same order.
  void add(const std::vector<double>& position) {
    if (!one_before_.empty()) {
      const double to_last = distance(position, last_);
      alternating_ += to_last > kApart && distance(position, one_before_) < kNear * to_last;
      ++rows_;
    }
    one_before_.swap(last_);
    last_ = position;
  }

  /// True when most of the rows so far alternate.
  bool alternate() const {
    return rows_ >= kFewestJointRows &&
           static_cast<double>(alternating_) > kMostShare * static_cast<double>(rows_);
  }

 private:
  /// rad or m. Closer positions of two publishers count as one; the codes of an encoder at rest may alternate
  /// by less.
  static constexpr double kApart = 1e-2;
  static constexpr double kNear = 0.25;                 ///< share of the distance to the last row
  static constexpr double kMostShare = 0.5;             ///< share of rows that may look like two publishers
  static constexpr std::int64_t kFewestJointRows = 20;  ///< rows that the check for two publishers needs

  static double distance(const std::vector<double>& position, const std::vector<double>& other) {
    double largest = 0.0;
    for (std::size_t j = 0; j < std::min(position.size(), other.size()); ++j)
      largest = std::fmax(largest, std::abs(position[j] - other[j]));
    return largest;
  }

  std::vector<double> last_, one_before_;
  std::int64_t rows_ = 0, alternating_ = 0;
};

/// Delay from the stamps in the headers to the receipt of the messages.
class ReceiptGap {
 public:
  void add(std::int64_t stamp_ns, std::int64_t receipt_ns) {
    if (stamp_ns == 0) return;
    const double gap_s = static_cast<double>(receipt_ns - stamp_ns) / 1e9;
    least_s_ = std::min(least_s_, gap_s);
    most_s_ = std::max(most_s_, gap_s);
    sum_s_ += gap_s;
    ++messages_;
  }

  /// Adds a note when some delay is not 0.
  void report(Issues& issues) const {
    if (messages_ == 0 || (least_s_ == 0.0 && most_s_ == 0.0)) return;
    issues.add({"receipt_gap", "t", Severity::note,
                fmt::format("the messages were received {:.4g} s after the stamps in their headers on "
                            "average, between {:.4g} and {:.4g} s. To choose the time, name it in the robot "
                            "file: [log] time = \"header\" or \"receipt\"",
                            sum_s_ / static_cast<double>(messages_), least_s_, most_s_)});
  }

 private:
  double least_s_ = std::numeric_limits<double>::infinity();
  double most_s_ = -std::numeric_limits<double>::infinity();
  double sum_s_ = 0.0;
  std::int64_t messages_ = 0;
};

}  // namespace faultline
