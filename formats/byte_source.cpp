// SPDX-License-Identifier: MIT
#include "formats/byte_source.hpp"

#include <algorithm>
#include <cstring>

namespace faultline {
namespace {

constexpr std::size_t kHeadBytes = 1 << 16;
constexpr std::size_t kPassedAtOnce = 1 << 16;

}  // namespace

ByteSource::ByteSource(const std::string& path, bool hashed)
    : file_(path, hashed), unpacker_(unpacker_of(file_)), budget_(path) {
  if (unpacker_) fill_head(kHeadBytes);
}

void ByteSource::fill_head(std::size_t bytes) {
  std::size_t got = head_.size();
  head_.resize(bytes);
  for (std::size_t more; got < bytes && (more = unpacker_->read(head_.data() + got, bytes - got)) > 0;)
    got += more;
  head_.resize(got);
  file_.pause();
}

bool ByteSource::extend_head() {
  if (!unpacker_) return file_.extend_head();
  const std::size_t before = head_.size();
  fill_head(2 * before);
  return head_.size() > before;
}

std::size_t ByteSource::read(char* to, std::size_t size) {
  if (!unpacker_) return file_.read(to, size);
  const std::size_t got = std::min(size, head_.size() - head_given_);
  if (got > 0) {
    std::memcpy(to, head_.data() + head_given_, got);
    head_given_ += got;
    return got;
  }
  const std::size_t more = unpacker_->read(to, size);
  spend(unpack_work_ns(unpacker_->byte_ns(), static_cast<std::int64_t>(more)));
  if (more == 0 && size > 0) note_end();
  return more;
}

void ByteSource::note_end() {
  read_to_end();
  const std::string damage = unpacker_->damage();
  if (damage.empty() || issues_.find("compression_damaged")) return;
  issues_.add({"compression_damaged", "", Severity::severe, damage});
}

void ByteSource::read_to_end() {
  std::string passed(kPassedAtOnce, '\0');
  while (file_.read(passed.data(), passed.size()) > 0) {
  }
}

void ByteSource::rewind() {
  file_.rewind();
  issues_ = {};
  budget_.start();
  if (!unpacker_) return;
  unpacker_ = unpacker_of(file_);
  head_given_ = 0;
  // read() hands out the head from head_; skip these bytes in the fresh unpacker.
  std::string again(head_.size(), '\0');
  for (std::size_t got = 0, more; got < again.size(); got += more)
    if ((more = unpacker_->read(again.data() + got, again.size() - got)) == 0) break;
}

}  // namespace faultline
