// SPDX-License-Identifier: MIT
#include "lib/log/remembered_source.hpp"

#include <utility>

#include "lib/log/log.hpp"

namespace faultline {
namespace {

std::int64_t bytes_of(const std::vector<double>& values) {
  return static_cast<std::int64_t>(values.size() * sizeof(double));
}

std::int64_t bytes_of(const Log& log) {
  std::int64_t bytes = sizeof(Log) + bytes_of(log.time);
  for_each_joint_channel(log, [&](const std::vector<double>& values, Channel) { bytes += bytes_of(values); });
  for (const ExtraChannel& channel : log.extra) bytes += bytes_of(channel.values);
  return bytes;
}

}  // namespace

bool LogMemory::take(std::int64_t bytes) {
  std::int64_t free = free_bytes_;
  do {
    if (bytes > free) return false;
  } while (!free_bytes_.compare_exchange_weak(free, free - bytes));
  return true;
}

bool RememberedSource::next(Log& segment) {
  if (from_memory()) {
    const Answer& answer = answers_[position_++];
    if (answer.more) segment = answer.segment;
    return answer.more;
  }
  if (at_end()) return false;
  return forgotten_ ? source_.next(segment) : read(segment);
}

void RememberedSource::rewind() {
  if (answers_.empty()) source_.rewind();
  position_ = 0;
}

const LogIdentity& RememberedSource::identity() const {
  return from_memory() ? answers_[position_].identity : source_.identity();
}

const Issues& RememberedSource::issues() const {
  return from_memory() ? answers_[position_].issues : source_.issues();
}

double RememberedSource::share_read() const {
  return from_memory() ? answers_[position_].share_read : source_.share_read();
}

/// Reads the next segment from the source and stores it if it fits.
bool RememberedSource::read(Log& segment) {
  Answer answer{source_.identity(), source_.issues(), source_.share_read(), false, {}};
  try {
    answer.more = source_.next(segment);
  } catch (...) {
    forget();
    throw;
  }
  const std::int64_t bytes = answer.more ? bytes_of(segment) : 0;
  if (!memory_.take(bytes)) {
    forget();
    return answer.more;
  }
  taken_bytes_ += bytes;
  if (answer.more) answer.segment = segment;
  answers_.push_back(std::move(answer));
  ++position_;
  if (at_end()) fill_in_hash();
  return !at_end();
}

/// Sets the hash in all stored identities, as it is known once the file was read to its end.
void RememberedSource::fill_in_hash() {
  for (Answer& answer : answers_) answer.identity.sha256 = source_.identity().sha256;
}

void RememberedSource::forget() {
  answers_ = {};
  position_ = 0;
  memory_.give_back(std::exchange(taken_bytes_, 0));
  forgotten_ = true;
}

}  // namespace faultline
