// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cerrno>
#include <optional>

#include "formats/arrays/written_arrays.hpp"
#include "formats/hdf5/hdf5_library.hpp"
#include "formats/known_formats.hpp"
#include "lib/core/error.hpp"
#include "lib/core/files/output_place.hpp"
#include "lib/core/files/temporary_file.hpp"

namespace faultline {
namespace {

constexpr hsize_t kChunkRows = 1024;
constexpr int kRowsAtOnce = 4096;

class Hdf5Writer : public LogWriter {
 public:
  explicit Hdf5Writer(const std::string& path) : path_(path), arrays_(path, "extra/") {
    if (output_place(path).special)
      throw Error(ErrorCode::output, path,
                  "is a pipe or a device, but HDF5 can be written to a file only; name a file, or write .csv "
                  "there");
    temporary_.emplace(path);
    const Hdf5Turn turn;
    const Hdf5Id access = hdf5_write_access(temporary_->descriptor(), failure_);
    file_ = {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose};
    demand(file_.ok());
  }
  ~Hdf5Writer() override {
    const Hdf5Turn turn;
    datasets_.clear();
    file_.reset();
  }
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  void write(const Log& segment) override {
    for (int row = 0; row < segment.rows();) {
      const int end = std::min(segment.rows(), row + kRowsAtOnce - static_cast<int>(arrays_.rows()));
      arrays_.add(segment, row, end);
      row = end;
      if (arrays_.rows() == kRowsAtOnce) flush();
    }
    if (segment.rows() == 0) arrays_.add(segment, 0, 0);
  }

  void note_provenance(const std::string& provenance) override { arrays_.note_provenance(provenance); }

  void commit() override {
    flush();
    const Hdf5Turn turn;
    if (const std::string notes = arrays_.notes(); !notes.empty()) write_notes(notes);
    bool closed = true;
    for (Hdf5Id& dataset : datasets_) closed = dataset.reset() && closed;
    demand(file_.reset() && closed);
    temporary_->commit();
  }

 private:
  void demand(bool good) {
    if (good && failure_.reason == 0) return;
    errno = failure_.reason != 0 ? failure_.reason : EIO;
    fail_to_write(path_, "written");
  }

  /// Creates properties without times, so that the same log gives the same bytes.
  static Hdf5Id plain(hid_t kind) {
    Hdf5Id properties(H5Pcreate(kind), H5Pclose);
    H5Pset_obj_track_times(properties, 0);
    return properties;
  }

  Hdf5Id create(const WrittenArray& array) {
    const hsize_t none[2] = {0, static_cast<hsize_t>(array.width)};
    const hsize_t most[2] = {H5S_UNLIMITED, none[1]}, chunk[2] = {kChunkRows, none[1]};
    const int rank = array.vector ? 1 : 2;
    const Hdf5Id space(H5Screate_simple(rank, none, most), H5Sclose);
    const Hdf5Id properties = plain(H5P_DATASET_CREATE);
    H5Pset_chunk(properties, rank, chunk);
    H5Pset_fletcher32(properties);
    Hdf5Id dataset(
        H5Dcreate2(file_, array.name.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, properties, H5P_DEFAULT),
        H5Dclose);
    demand(dataset.ok());
    if (!array.unit.empty()) write_unit(dataset, array.unit);
    return dataset;
  }

  void write_unit(hid_t dataset, const std::string& unit) {
    const Hdf5Id type(H5Tcopy(H5T_C_S1), H5Tclose), space(H5Screate(H5S_SCALAR), H5Sclose);
    H5Tset_size(type, unit.size());
    H5Tset_cset(type, H5T_CSET_UTF8);
    const Hdf5Id attribute(H5Acreate2(dataset, "unit", type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    demand(attribute.ok() && H5Awrite(attribute, type, unit.data()) >= 0);
  }

  void write_notes(const std::string& notes) {
    const Hdf5Id type(H5Tcopy(H5T_C_S1), H5Tclose), space(H5Screate(H5S_SCALAR), H5Sclose);
    H5Tset_size(type, notes.size());
    const Hdf5Id properties = plain(H5P_DATASET_CREATE);
    const Hdf5Id dataset(H5Dcreate2(file_, kNotesName, type, space, H5P_DEFAULT, properties, H5P_DEFAULT),
                         H5Dclose);
    demand(dataset.ok() && H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, notes.data()) >= 0);
  }

  void create_all() {
    for (const WrittenArray& array : arrays_.arrays()) {
      if (array.name.starts_with("extra/") && !has_extra_) {
        const Hdf5Id properties = plain(H5P_GROUP_CREATE);
        const Hdf5Id group(H5Gcreate2(file_, "extra", H5P_DEFAULT, properties, H5P_DEFAULT), H5Gclose);
        has_extra_ = group.ok();
        demand(has_extra_);
      }
      datasets_.push_back(create(array));
    }
  }

  void append(hid_t dataset, const WrittenArray& array, hsize_t rows) {
    const int rank = array.vector ? 1 : 2;
    const hsize_t width = static_cast<hsize_t>(array.width);
    const hsize_t size[2] = {rows_ + rows, width}, start[2] = {rows_, 0}, count[2] = {rows, width};
    demand(H5Dset_extent(dataset, size) >= 0);
    const Hdf5Id space(H5Dget_space(dataset), H5Sclose),
        memory(H5Screate_simple(rank, count, nullptr), H5Sclose);
    demand(H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, count, nullptr) >= 0 &&
           H5Dwrite(dataset, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, array.values.data()) >= 0);
  }

  void flush() {
    const Hdf5Turn turn;
    if (datasets_.empty()) create_all();
    const auto rows = static_cast<hsize_t>(arrays_.rows());
    for (std::size_t i = 0; i < datasets_.size() && rows > 0; ++i)
      append(datasets_[i], arrays_.arrays()[i], rows);
    rows_ += rows;
    arrays_.clear();
  }

  std::string path_;
  std::optional<TemporaryFile> temporary_;
  WrittenArrays arrays_;
  Hdf5Failure failure_;  ///< outlives the file
  Hdf5Id file_;
  std::vector<Hdf5Id> datasets_;
  bool has_extra_ = false;
  hsize_t rows_ = 0;  ///< in the file
};

}  // namespace

std::unique_ptr<LogWriter> create_hdf5(const std::string& path) { return std::make_unique<Hdf5Writer>(path); }

}  // namespace faultline
