// SPDX-License-Identifier: MIT
#pragma once

#include <hdf5.h>

#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace faultline {

/// A lock for calls of the HDF5 library, which has global state; it also turns off the library's messages.
class Hdf5Turn {
 public:
  Hdf5Turn();
  /// Declares that this process has one thread and needs no lock: for a copy made by fork().
  static void be_alone();

 private:
  std::unique_lock<std::recursive_mutex> lock_;
};

/// An object of the library that is closed with this one; negative when it could not be opened.
class Hdf5Id {
 public:
  using Close = herr_t (*)(hid_t);

  Hdf5Id() = default;
  Hdf5Id(hid_t id, Close close) : id_(id), close_(close) {}
  ~Hdf5Id() { reset(); }
  Hdf5Id(Hdf5Id&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Hdf5Id& operator=(Hdf5Id&& other) noexcept {
    reset();
    id_ = std::exchange(other.id_, -1);
    close_ = other.close_;
    return *this;
  }

  operator hid_t() const { return id_; }
  bool ok() const { return id_ >= 0; }
  /// Closes it now; returns true on success.
  bool reset() { return id_ < 0 || close_(std::exchange(id_, -1)) >= 0; }

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// Bytes that could not be written to a file. The library cannot close a file after a failed write, and would
/// try again when the program ends, with objects that no longer exist. So failures are hidden from it: from
/// the first one on all bytes are kept here until the file is closed.
struct Hdf5Failure {
  int reason = 0;  ///< errno of the first failure; 0: all was written
  std::vector<std::pair<haddr_t, std::string>> unwritten;
};

/// Returns the access properties to read the open file `descriptor`, which stays open. Reading past the end
/// of the file fails, so that a cut file can be read up to its end.
Hdf5Id hdf5_read_access(int descriptor);

/// Does the same for writing; `failure` must outlive the file.
Hdf5Id hdf5_write_access(int descriptor, Hdf5Failure& failure);

}  // namespace faultline
