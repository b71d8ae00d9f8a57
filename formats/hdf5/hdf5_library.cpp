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

/// What a file of this driver is opened with.
struct Hdf5Descriptor {
  int file = -1;
  bool writing = false;
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

/// Bytes that were not asked for may lie behind the end of a cut file, so nothing is read ahead.
herr_t query(const H5FD_t* file, unsigned long* features) {
  *features = H5FD_FEAT_SUPPORTS_SWMR_IO;
  if (file && file_of(file)->descriptor.writing)
    *features |= H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

haddr_t get_end_of_addresses(const H5FD_t* file, H5FD_mem_t) { return file_of(file)->end_of_addresses; }

herr_t set_end_of_addresses(H5FD_t* file, H5FD_mem_t, haddr_t end) {
  file_of(file)->end_of_addresses = end;
  return 0;
}

/// Of a file that is read, no end before that which it promises.
haddr_t get_end_of_file(const H5FD_t* file, H5FD_mem_t) {
  const Hdf5Descriptor& descriptor = file_of(file)->descriptor;
  struct stat facts {};
  if (::fstat(descriptor.file, &facts) != 0) return HADDR_UNDEF;
  return descriptor.writing ? static_cast<haddr_t>(facts.st_size) : kFarEnd;
}

/// Calls read or write until all bytes are done.
template <typename Transfer, typename Byte>
herr_t transfer(Transfer once, int file, haddr_t at, std::size_t size, Byte* bytes) {
  while (size > 0) {
    const ssize_t done = once(file, bytes, size, static_cast<off_t>(at));
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return -1;
    bytes += done;
    at += static_cast<haddr_t>(done);
    size -= static_cast<std::size_t>(done);
  }
  return 0;
}

herr_t read_bytes(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, std::size_t size, void* to) {
  if (at > kFarEnd) return -1;
  return transfer(::pread, file_of(file)->descriptor.file, at, size, static_cast<char*>(to));
}

herr_t write_bytes(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, std::size_t size, const void* from) {
  return transfer(::pwrite, file_of(file)->descriptor.file, at, size, static_cast<const char*>(from));
}

herr_t cut_to_addresses(H5FD_t* file, hid_t, hbool_t) {
  const Hdf5File* mine = file_of(file);
  if (!mine->descriptor.writing) return 0;
  return ::ftruncate(mine->descriptor.file, static_cast<off_t>(mine->end_of_addresses));
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

std::recursive_mutex& library_mutex() {
  static std::recursive_mutex mutex;
  return mutex;
}

bool& is_alone() {
  static bool alone = false;
  return alone;
}

}  // namespace

void Hdf5Turn::be_alone() { is_alone() = true; }

Hdf5Turn::Hdf5Turn() {
  if (!is_alone()) lock_ = std::unique_lock(library_mutex());
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Hdf5Id hdf5_access(int descriptor, bool writing) {
  static const H5FD_class_t driver = make_driver();
  static const hid_t id = H5FDregister(&driver);
  Hdf5Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  const Hdf5Descriptor opened{descriptor, writing};
  H5Pset_driver(access, id, &opened);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  H5Pset_metadata_read_attempts(access, 1);  // nobody writes meanwhile; the library would wait for it
  return access;
}

}  // namespace faultline
