// SPDX-License-Identifier: MIT
#include <algorithm>

#include "formats/messages/joint_layout.hpp"
#include "formats/missing.hpp"

namespace faultline {
namespace {

/// A stream continues alone when so many of its messages (more if it sends several per row) follow each other
/// without one of the main stream.
constexpr std::int64_t kAlone = 10;

}  // namespace

RivalStreams::RivalStreams(const std::vector<JointStream>& streams, const JointLayout& layout)
    : is_rival_(layout.is_rival), since_(streams.size(), 0) {
  const std::int64_t rows =
      std::max<std::int64_t>(1, streams[static_cast<std::size_t>(layout.main)].messages);
  for (const JointStream& stream : streams)
    most_.push_back(kAlone * std::max<std::int64_t>(1, stream.messages / rows));
}

std::int64_t RivalStreams::rows_lost_by(int stream) {
  const auto s = static_cast<std::size_t>(stream);
  if (!is_rival_[s]) return 0;
  any_came_ = true;
  if (++since_[s] <= most_[s]) return 0;
  return since_[s] == most_[s] + 1 ? since_[s] : 1;
}

/// Counts the messages that are in no row, without those already counted as lost rows.
void RivalStreams::count(std::int64_t taken) {
  for (std::size_t s = 0; s < since_.size(); ++s) {
    if (since_[s] <= most_[s]) between_rows_ += std::max<std::int64_t>(0, since_[s] - taken);
    since_[s] = 0;
  }
  any_came_ = false;
}

void RivalStreams::report_at_end(Issues& issues) {
  count(0);
  if (between_rows_ == 0) return;
  issues.add({"messages_between_rows", "", Severity::note,
              "messages about other joints came between those of the log; each row holds the latest of "
              "them, and the others are in no row",
              0, kNan, between_rows_});
}

}  // namespace faultline
