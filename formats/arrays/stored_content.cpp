// SPDX-License-Identifier: MIT
#include "formats/arrays/stored_content.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <vector>

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

struct ContentStream::Inflater {
  Inflater(const RandomFile& from, const StoredContent& what) : file(from), content(what) {
    input.resize(kInputBytes);
    ok = ::inflateInit2(&stream, window_bits()) == Z_OK;
    begun = ok;
  }
  ~Inflater() {
    if (begun) ::inflateEnd(&stream);
  }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  int window_bits() const { return content.packing == Packing::deflate ? -MAX_WBITS : MAX_WBITS; }

  void restart() {
    ok = begun && ::inflateReset(&stream) == Z_OK;
    stream.avail_in = 0;
    taken = position = 0;
    crc = 0;
    ended = wrong = false;
  }

  void fill() {
    const auto left = static_cast<std::size_t>(content.bytes - taken);
    const std::size_t got = file.read(content.offset + taken, input.data(), std::min(input.size(), left));
    taken += static_cast<std::int64_t>(got);
    stream.next_in = reinterpret_cast<Bytef*>(input.data());
    stream.avail_in = static_cast<uInt>(got);
  }

  /// Unpacks the next bytes; returns fewer if the stream ends.
  std::size_t next(char* to, std::size_t count) {
    std::size_t got = 0;
    while (ok && !ended && got < count) {
      if (stream.avail_in == 0) fill();
      const uInt room = static_cast<uInt>(std::min<std::size_t>(count - got, 1U << 30));
      stream.next_out = reinterpret_cast<Bytef*>(to + got);
      stream.avail_out = room;
      const uInt before = stream.avail_in;
      const int state = ::inflate(&stream, Z_NO_FLUSH);
      const std::size_t more = room - stream.avail_out;
      got += more;
      ended = state == Z_STREAM_END;
      wrong = wrong || state == Z_DATA_ERROR;
      const bool stuck = more == 0 && before == stream.avail_in;
      ok = state == Z_STREAM_END || (state == Z_OK && !stuck) || (state == Z_BUF_ERROR && !stuck);
    }
    crc = crc32_of({to, got}, crc);
    position += static_cast<std::int64_t>(got);
    file.spend(unpack_work_ns(kDeflateByte_ns, static_cast<std::int64_t>(got)));
    return got;
  }

  const RandomFile& file;
  const StoredContent content;
  z_stream stream{};
  std::vector<char> input, passed;
  std::int64_t taken = 0;     ///< bytes of the content in the file
  std::int64_t position = 0;  ///< unpacked bytes
  std::uint32_t crc = 0;
  bool begun = false, ok = false, ended = false;
  bool wrong = false;  ///< compressed bytes or zlib checksum are damaged
};

ContentStream::ContentStream(const RandomFile& file, const StoredContent& content)
    : file_(&file), content_(content) {
  if (content.packing != Packing::plain) inflater_ = std::make_unique<Inflater>(file, content);
}

ContentStream::~ContentStream() = default;
ContentStream::ContentStream(ContentStream&&) noexcept = default;

std::size_t ContentStream::read(std::int64_t at, char* to, std::size_t count) {
  if (!inflater_) {
    const std::int64_t left = std::max<std::int64_t>(0, content_.bytes - at);
    return file_->read(content_.offset + at, to, std::min(count, static_cast<std::size_t>(left)));
  }
  Inflater& inflater = *inflater_;
  if (at < inflater.position) inflater.restart();
  if (at > inflater.position) inflater.passed.resize(kInputBytes);
  while (inflater.position < at) {
    const auto skip = std::min<std::int64_t>(at - inflater.position, kInputBytes);
    if (inflater.next(inflater.passed.data(), static_cast<std::size_t>(skip)) == 0) return 0;
  }
  return inflater.next(to, count);
}

bool ContentStream::mismatch() {
  if (!inflater_) return false;
  if (content_.packing == Packing::deflate)
    return content_.crc && inflater_->ended && inflater_->crc != *content_.crc;
  // The zlib checksum is at the end, after the last number.
  inflater_->passed.resize(kInputBytes);
  while (inflater_->next(inflater_->passed.data(), kInputBytes) > 0) {
  }
  return inflater_->wrong;
}

}  // namespace faultline
