// SPDX-License-Identifier: MIT
#include "formats/hdf5/hdf5_library.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <limits>
#include <memory>

namespace faultline {
namespace {

constexpr haddr_t kFarEnd = haddr_t{1} << 62;

/// The data with which a file of this driver is opened.
struct Hdf5Descriptor {
  int file = -1;
  Hdf5Failure* failure = nullptr;  ///< of a file that is written; null for reading

  bool is_written() const { return failure != nullptr; }
};

/// A file of this driver. The library casts pointers to its first member.
struct Hdf5File {
  H5FD_t base{};
  Hdf5Descriptor descriptor;
  haddr_t end_of_addresses = 0;
};

Hdf5File* file_of(H5FD_t* file) { return reinterpret_cast<Hdf5File*>(file); }
const Hdf5File* file_of(const H5FD_t* file) { return reinterpret_cast<const Hdf5File*>(file); }

H5FD_t* open_file(const char*, unsigned flags, hid_t access, haddr_t) {
  const auto* descriptor = static_cast<const Hdf5Descriptor*>(H5Pget_driver_info(access));
  if (!descriptor) return nullptr;
  if ((flags & H5F_ACC_TRUNC) && ::ftruncate(descriptor->file, 0) != 0) return nullptr;
  auto file = std::make_unique<Hdf5File>();
  file->descriptor = *descriptor;
  return &file.release()->base;
}

herr_t close_file(H5FD_t* file) {
  delete file_of(file);
  return 0;
}

int compare(const H5FD_t* a, const H5FD_t* b) { return a == b ? 0 : a < b ? -1 : 1; }

/// Disables read-ahead for reading, as the end of a cut file may be before bytes that were not requested.
herr_t query(const H5FD_t* file, unsigned long* features) {
  *features = H5FD_FEAT_SUPPORTS_SWMR_IO;
  if (file && file_of(file)->descriptor.is_written())
    *features |= H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

haddr_t get_end_of_addresses(const H5FD_t* file, H5FD_mem_t) { return file_of(file)->end_of_addresses; }

herr_t set_end_of_addresses(H5FD_t* file, H5FD_mem_t, haddr_t end) {
  file_of(file)->end_of_addresses = end;
  return 0;
}

/// Returns, for a file that is read, an end after every address that it states.
haddr_t get_end_of_file(const H5FD_t* file, H5FD_mem_t) {
  const Hdf5Descriptor& descriptor = file_of(file)->descriptor;
  if (!descriptor.is_written()) return kFarEnd;
  struct stat facts {};
  if (descriptor.failure->reason != 0 || ::fstat(descriptor.file, &facts) != 0)
    return file_of(file)->end_of_addresses;
  return static_cast<haddr_t>(facts.st_size);
}

/// Calls read or write until all bytes are done.
template <typename Transfer, typename Byte>
herr_t transfer(Transfer once, int file, haddr_t at, std::size_t size, Byte* bytes) {
  while (size > 0) {
    const ssize_t done = once(file, bytes, size, static_cast<off_t>(at));
    if (done < 0 && errno == EINTR) continue;
    if (done == 0) errno = ENOSPC;
    if (done <= 0) return -1;
    bytes += done;
    at += static_cast<haddr_t>(done);
    size -= static_cast<std::size_t>(done);
  }
  return 0;
}

/// Overlays the bytes that were read with those that could not be written.
void lay_over(const Hdf5Failure& failure, haddr_t at, std::size_t size, char* to) {
  for (const auto& [begin, bytes] : failure.unwritten) {
    const haddr_t first = std::max(at, begin), last = std::min(at + size, begin + bytes.size());
    if (first < last) std::copy_n(bytes.data() + (first - begin), last - first, to + (first - at));
  }
}

herr_t read_bytes(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, std::size_t size, void* to) {
  if (at > kFarEnd) return -1;
  const Hdf5Descriptor& descriptor = file_of(file)->descriptor;
  char* const bytes = static_cast<char*>(to);
  const bool has_failed = descriptor.is_written() && descriptor.failure->reason != 0;
  if (has_failed) std::fill_n(bytes, size, '\0');
  const herr_t done = transfer(::pread, descriptor.file, at, size, bytes);
  if (!has_failed) return done;
  lay_over(*descriptor.failure, at, size, bytes);
  return 0;
}

herr_t write_bytes(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, std::size_t size, const void* from) {
  const Hdf5Descriptor& descriptor = file_of(file)->descriptor;
  const char* const bytes = static_cast<const char*>(from);
  if (!descriptor.is_written()) return -1;
  Hdf5Failure& failure = *descriptor.failure;
  if (failure.reason == 0 && transfer(::pwrite, descriptor.file, at, size, bytes) == 0) return 0;
  if (failure.reason == 0) failure.reason = errno;
  failure.unwritten.emplace_back(at, std::string(bytes, size));
  return 0;
}

herr_t cut_to_addresses(H5FD_t* file, hid_t, hbool_t) {
  const Hdf5File* mine = file_of(file);
  if (!mine->descriptor.is_written() || mine->descriptor.failure->reason != 0) return 0;
  if (::ftruncate(mine->descriptor.file, static_cast<off_t>(mine->end_of_addresses)) != 0)
    mine->descriptor.failure->reason = errno;
  return 0;
}

H5FD_class_t make_driver() {
  H5FD_class_t driver{};
  driver.name = "faultline";
  driver.maxaddr = static_cast<haddr_t>(std::numeric_limits<std::int64_t>::max());
  driver.fc_degree = H5F_CLOSE_STRONG;
  driver.fapl_size = sizeof(Hdf5Descriptor);
  driver.open = open_file;
  driver.close = close_file;
  driver.cmp = compare;
  driver.query = query;
  driver.get_eoa = get_end_of_addresses;
  driver.set_eoa = set_end_of_addresses;
  driver.get_eof = get_end_of_file;
  driver.read = read_bytes;
  driver.write = write_bytes;
  driver.truncate = cut_to_addresses;
  std::fill(std::begin(driver.fl_map), std::end(driver.fl_map), H5FD_MEM_SUPER);
  return driver;
}

Hdf5Id access_by(const Hdf5Descriptor& opened) {
  static const H5FD_class_t driver = make_driver();
  static const hid_t id = H5FDregister(&driver);
  Hdf5Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_driver(access, id, &opened);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  H5Pset_metadata_read_attempts(access, 1);  // there is no concurrent writer for which the library would wait
  return access;
}

bool is_alone = false;

}  // namespace

void Hdf5Turn::be_alone() { is_alone = true; }

Hdf5Turn::Hdf5Turn() {
  static std::recursive_mutex library_mutex;
  if (!is_alone) lock_ = std::unique_lock(library_mutex);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Hdf5Id hdf5_read_access(int descriptor) { return access_by({descriptor, nullptr}); }

Hdf5Id hdf5_write_access(int descriptor, Hdf5Failure& failure) { return access_by({descriptor, &failure}); }

}  // namespace faultline
