// SPDX-License-Identifier: MIT
#pragma once

#include <hdf5.h>

#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace faultline {

/// Whoever calls the HDF5 library holds one: calls come one after another, as the library has state of its
/// own, and it prints nothing.
class Hdf5Turn {
 public:
  Hdf5Turn();
  /// From now on this process has one thread, and waits for no other: for a copy made by fork().
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
  /// Closes it now; whether that went well.
  bool reset() { return id_ < 0 || close_(std::exchange(id_, -1)) >= 0; }

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// What could not be written to a file. The library cannot close a file whose writing failed, and would try
/// once more when the program ends, with what is gone by then. So it never sees a failure: from the first one
/// on everything is kept here instead, until the file is closed.
struct Hdf5Failure {
  int reason = 0;  ///< errno of the first failure; 0: all was written
  std::vector<std::pair<haddr_t, std::string>> unwritten;
};

/// Properties by which the library reads the open file `descriptor`, which stays open. Reading past the end
/// of the file fails, so that a cut file can be read up to there.
Hdf5Id hdf5_read_access(int descriptor);

/// The same for writing; `failure` outlives the file.
Hdf5Id hdf5_write_access(int descriptor, Hdf5Failure& failure);

}  // namespace faultline
