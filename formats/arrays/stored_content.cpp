// SPDX-License-Identifier: MIT
#include "formats/arrays/stored_content.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "formats/bytes/little_endian.hpp"
#include "lib/core/error.hpp"

namespace faultline {
namespace {

constexpr std::int64_t kMostExpansion = 1032;  ///< upper limit of the compression ratio of deflate
constexpr std::size_t kInputBytes = 1 << 16;

}  // namespace

RandomFile::RandomFile(const std::string& path) : path_(path), budget_(path) {
  file_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file_ < 0)
    throw Error(ErrorCode::input, path,
                std::string("cannot be opened for reading (") + std::strerror(errno) + ")");
  struct stat facts {};
  if (::fstat(file_, &facts) == 0) size_ = facts.st_size;
}

void RandomFile::fail(const std::string& what) const { throw Error(ErrorCode::input, path_, what); }

RandomFile::~RandomFile() { ::close(file_); }

std::size_t RandomFile::read(std::int64_t at, char* to, std::size_t count) const {
  std::size_t got = 0;
  while (got < count) {
    const ssize_t more =
        ::pread(file_, to + got, count - got, static_cast<off_t>(at) + static_cast<off_t>(got));
    if (more < 0 && errno == EINTR) continue;
    if (more < 0)
      throw Error(ErrorCode::input, path_, std::string("cannot be read (") + std::strerror(errno) + ")");
    if (more == 0) break;
    got += static_cast<std::size_t>(more);
  }
  return got;
}

std::string RandomFile::text(std::int64_t at, std::size_t count) const {
  const auto left = static_cast<std::size_t>(std::max<std::int64_t>(0, size_ - at));
  std::string bytes(std::min(count, left), '\0');
  bytes.resize(read(at, bytes.data(), bytes.size()));
  return bytes;
}

std::int64_t most_bytes(const StoredContent& content) {
  if (content.packing == Packing::plain) return content.bytes;
  const std::int64_t most = (content.bytes + 1) * kMostExpansion;
  return content.unpacked ? std::min(most, *content.unpacked) : most;
}

ContentStream::ContentStream(const RandomFile& file, const StoredContent& content)
    : file_(file), content_(content) {
  if (!is_packed()) return;
  input_.resize(kInputBytes);
  begun_ = ok_ =
      ::inflateInit2(&stream_, content.packing == Packing::deflate ? -MAX_WBITS : MAX_WBITS) == Z_OK;
}

ContentStream::~ContentStream() {
  if (begun_) ::inflateEnd(&stream_);
}

void ContentStream::restart() {
  ok_ = begun_ && ::inflateReset(&stream_) == Z_OK;
  stream_.avail_in = 0;
  taken_ = position_ = 0;
  crc_ = 0;
  ended_ = wrong_ = false;
}

void ContentStream::fill() {
  const auto left = static_cast<std::size_t>(content_.bytes - taken_);
  const std::size_t got = file_.read(content_.offset + taken_, input_.data(), std::min(input_.size(), left));
  taken_ += static_cast<std::int64_t>(got);
  stream_.next_in = reinterpret_cast<Bytef*>(input_.data());
  stream_.avail_in = static_cast<uInt>(got);
}

/// Unpacks the next bytes; returns fewer if the stream ends.
std::size_t ContentStream::unpack(char* to, std::size_t count) {
  std::size_t got = 0;
  while (ok_ && !ended_ && got < count) {
    if (stream_.avail_in == 0) fill();
    const uInt room = static_cast<uInt>(std::min<std::size_t>(count - got, 1U << 30));
    stream_.next_out = reinterpret_cast<Bytef*>(to + got);
    stream_.avail_out = room;
    const uInt before = stream_.avail_in;
    const int state = ::inflate(&stream_, Z_NO_FLUSH);
    const std::size_t more = room - stream_.avail_out;
    got += more;
    ended_ = state == Z_STREAM_END;
    wrong_ = wrong_ || state == Z_DATA_ERROR;
    const bool stuck = more == 0 && before == stream_.avail_in;
    ok_ = state == Z_STREAM_END || (state == Z_OK && !stuck) || (state == Z_BUF_ERROR && !stuck);
  }
  crc_ = crc32_of({to, got}, crc_);
  position_ += static_cast<std::int64_t>(got);
  file_.spend(unpack_work_ns(kDeflateByte_ns, static_cast<std::int64_t>(got)));
  return got;
}

/// Unpacks and discards up to `count` of the next bytes; returns their number.
std::size_t ContentStream::pass(std::size_t count) {
  passed_.resize(kInputBytes);
  return unpack(passed_.data(), std::min(count, kInputBytes));
}

std::size_t ContentStream::read(std::int64_t at, char* to, std::size_t count) {
  if (!is_packed()) {
    const std::int64_t left = std::max<std::int64_t>(0, content_.bytes - at);
    return file_.read(content_.offset + at, to, std::min(count, static_cast<std::size_t>(left)));
  }
  if (at < position_) restart();
  while (position_ < at)
    if (pass(static_cast<std::size_t>(at - position_)) == 0) return 0;
  return unpack(to, count);
}

bool ContentStream::mismatch() {
  if (!is_packed()) return false;
  if (content_.packing == Packing::deflate) return content_.crc && ended_ && crc_ != *content_.crc;
  // The zlib checksum is at the end, after the last number.
  while (pass(kInputBytes) > 0) {
  }
  return wrong_;
}

}  // namespace faultline
