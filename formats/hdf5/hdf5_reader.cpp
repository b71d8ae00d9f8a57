// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <exception>
#include <functional>
#include <map>
#include <utility>

#include "formats/arrays/array_file.hpp"
#include "formats/arrays/array_table.hpp"
#include "formats/hdf5/hdf5_dataset.hpp"
#include "formats/hdf5/hdf5_library.hpp"
#include "formats/known_formats.hpp"
#include "lib/core/error.hpp"
#include "lib/core/issue.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

constexpr std::string_view kSignature{"\x89HDF\r\n\x1a\n", 8};
/// Total bytes of chunks that are unpacked at once, and least bytes of the chunk cache of HDF5.
constexpr std::int64_t kMostChunks = 96 << 20, kLeastCache = 1 << 20;
constexpr std::size_t kMostDescription = 16 << 20;
constexpr std::size_t kFirstBlock = 512;  ///< second place of the signature; the next ones double
constexpr rlim_t kLongest_s = 10;         ///< of a trial in a copy of this process

/// Runs `work` and ends the process. Messages of the HDF5 and C libraries about a crash are not shown.
[[noreturn]] void try_in_copy(const std::function<void()>& work) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGALRM}) std::signal(signal, SIG_DFL);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  const rlimit no_core{0, 0}, time{kLongest_s, kLongest_s};
  ::setrlimit(RLIMIT_CORE, &no_core);
  ::setrlimit(RLIMIT_CPU, &time);
  Hdf5Turn::be_alone();
  ::alarm(static_cast<unsigned>(kLongest_s));
  try {
    work();
  } catch (const std::exception&) {
    ::_exit(0);
  }
  ::_exit(0);
}

/// True when `work` ends, also by an Error, in a copy of this process, or no copy can be made. The HDF5
/// library crashes on some damaged files; work that crashes there is not done here.
bool survives(const std::function<void()>& work) {
  const Hdf5Turn turn;  // so that no other thread is in the library when the copy is made
  const pid_t copy = ::fork();
  if (copy < 0) return true;
  if (copy == 0) try_in_copy(work);
  int status = 0;
  while (::waitpid(copy, &status, 0) < 0)
    if (errno != EINTR) return true;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

class Hdf5Arrays : public ArrayFile {
 public:
  Hdf5Arrays(const std::string& path, MatlabNaming matlab, bool with_attributes)
      : path_(path), matlab_(matlab), with_attributes_(with_attributes) {
    descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    struct stat facts {};
    if (descriptor_ >= 0 && ::fstat(descriptor_, &facts) == 0) bytes_ = facts.st_size;
    try {
      open();
    } catch (...) {
      close();
      throw;
    }
  }
  ~Hdf5Arrays() override { close(); }
  Hdf5Arrays(const Hdf5Arrays&) = delete;
  Hdf5Arrays& operator=(const Hdf5Arrays&) = delete;

  /// Chunks are unpacked whole, and those of a row are cached until later rows no longer need them.
  void will_read(const std::vector<ArrayBand>& bands) override {
    const Hdf5Turn turn;
    std::map<std::size_t, std::int64_t> bytes_of;
    for (const ArrayBand& band : bands) {
      const std::size_t dataset = sources_[band.array].first;
      bytes_of[dataset] = datasets_[dataset].row_chunk_bytes(band.channel_major);
    }
    std::int64_t all = 0;
    for (const auto& [dataset, bytes] : bytes_of) all += bytes;
    if (all > kMostChunks)
      throw Error(
          ErrorCode::input, path_,
          fmt::format(
              "stores its numbers in chunks of which {} MiB must be unpacked at once, more than the limit "
              "of {} MiB; write it again in smaller chunks, as with h5repack -l CHUNK=1000",
              all >> 20, kMostChunks >> 20));
    for (const auto& [dataset, bytes] : bytes_of)
      if (bytes > 0)
        datasets_[dataset].set_chunk_cache(file_,
                                           2 * all > kMostChunks ? bytes : std::max(2 * bytes, kLeastCache));
  }

  void read(const ArrayBand& band, BandValues& values) override {
    const Hdf5Turn turn;
    const auto& [dataset, field] = sources_[band.array];
    datasets_[dataset].read(datasets_[dataset].fields()[field], band, values);
  }

  /// Reads the first and the last row of each dataset that is part of the log.
  void touch() {
    const std::vector<ArrayBand> bands = bands_of(table_of(arrays_, path_));
    will_read(bands);
    for (const ArrayBand& band : bands)
      for (const std::int64_t row : {std::int64_t{0}, band.rows - 1}) {
        BandValues values{{{0.0}}, {}};
        if (row >= 0 && row < band.rows) read({band.array, band.channel_major, row, 1, {0}}, values);
      }
  }

 private:
  void close() {
    const Hdf5Turn turn;
    datasets_.clear();
    file_.reset();
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
  }

  void open() {
    const Hdf5Turn turn;
    const Hdf5Id access = hdf5_read_access(descriptor_);
    for (const unsigned flags : {H5F_ACC_RDONLY, H5F_ACC_RDONLY | H5F_ACC_SWMR_READ})
      if (!file_.ok()) file_ = {H5Fopen(path_.c_str(), flags, access), H5Fclose};
    if (!file_.ok())
      throw Error(
          ErrorCode::input, path_,
          "is an HDF5 file whose beginning is damaged or cut; nothing can be read from it. If a program is "
          "still writing the file, close it there first");
    Hdf5Tree tree = hdf5_tree(file_);
    if (!with_attributes_)
      issues_.add(
          make_issue("array_damaged", Severity::severe,
                     "the attributes of the datasets are damaged; units and names of columns were not read"));
    issues_.merge(tree.issues);
    notes_ = tree.notes;
    for (const std::string& path : tree.datasets) add(path);
    if (arrays_.empty() && !no_numbers_.empty())
      issues_.add(make_issue(
          "array_left_out", Severity::note,
          "its datasets hold no numbers (" + no_numbers_ + "); a log needs times and positions as numbers"));
  }

  void add(const std::string& path) {
    std::string why;
    auto dataset = Hdf5Dataset::open(file_, path, bytes_, why);
    if (!dataset) {
      if (why.empty() && no_numbers_.size() < kLongestName)
        no_numbers_ += (no_numbers_.empty() ? "" : ", ") + shortened(path, kLongestName);
      if (!why.empty())
        issues_.add(make_issue("array_damaged", Severity::severe,
                               fmt::format("\"{}\" was left out: {}", shortened(path, kLongestName), why),
                               path));
      return;
    }
    if (matlab_ && with_attributes_ && is_text_of_matlab(dataset->id())) return;
    if (with_attributes_ && described_bytes_ <= kMostDescription) describe(path, *dataset);
    if (matlab_) dataset->turn();
    datasets_.push_back(std::move(*dataset));
    const std::size_t index = datasets_.size() - 1;
    for (std::size_t field = 0; field < datasets_[index].fields().size(); ++field)
      add_array(path, index, field);
  }

  void describe(const std::string& path, Hdf5Dataset& dataset) {
    describe_hdf5_fields(file_, path, dataset);
    for (const Hdf5Field& field : dataset.fields()) {
      described_bytes_ += field.unit.size();
      for (const auto* texts : {&field.names, &field.units})
        for (const std::string& text : *texts) described_bytes_ += text.size();
    }
    if (described_bytes_ > kMostDescription)
      issues_.add(
          make_issue("array_damaged", Severity::warning,
                     "the attributes of the datasets hold more text than names and units need; those of "
                     "later datasets were not read"));
  }

  void add_array(const std::string& path, std::size_t index, std::size_t field) {
    const Hdf5Field& about = datasets_[index].fields()[field];
    NamedArray array;
    array.name = about.name.empty() ? path.substr(1) : path.substr(1) + "/" + about.name;
    if (matlab_) array.name = matlab_(array.name);
    array.shape = datasets_[index].shape();
    if (about.width > 1) array.shape.push_back(about.width);
    array.unit = about.unit;
    array.unwritten = datasets_[index].unwritten();
    array.records = !about.name.empty();
    array.names = about.names;
    array.units = about.units;
    array.rows_held = [this, index](bool by_columns) { return datasets_[index].rows_held(by_columns); };
    array.columns_held = [this, index](bool by_columns) { return datasets_[index].columns_held(by_columns); };
    arrays_.push_back(std::move(array));
    sources_.emplace_back(index, field);
  }

  std::string path_;
  MatlabNaming matlab_;
  bool with_attributes_;
  int descriptor_ = -1;
  std::int64_t bytes_ = 0;
  Hdf5Id file_;
  std::vector<Hdf5Dataset> datasets_;
  std::vector<std::pair<std::size_t, std::size_t>> sources_;  ///< dataset and field of each array
  std::string no_numbers_;                                    ///< names of the first datasets without numbers
  std::size_t described_bytes_ = 0;                           ///< of names and units
};

std::unique_ptr<ArrayFile> open_plain(const std::string& path) { return open_hdf5_arrays(path, nullptr); }

}  // namespace

bool looks_like_hdf5(std::string_view head) {
  if (head.starts_with(kSignature)) return true;
  for (std::size_t at = kFirstBlock; at < head.size(); at *= 2)
    if (head.substr(at).starts_with(kSignature)) return true;
  return false;
}

std::unique_ptr<RawReader> open_hdf5(std::unique_ptr<ByteSource> bytes) {
  return read_arrays(std::move(bytes), "hdf5", open_plain);
}

std::unique_ptr<ArrayFile> open_hdf5_arrays(const std::string& path, MatlabNaming matlab) {
  for (const bool with_attributes : {true, false})
    if (survives([&] { Hdf5Arrays(path, matlab, with_attributes).touch(); }))
      return std::make_unique<Hdf5Arrays>(path, matlab, with_attributes);
  throw Error(
      ErrorCode::input, path,
      "is damaged in a way that crashes or stalls the HDF5 library; nothing can be read from it. Try to "
      "copy its datasets with h5repack or h5dump");
}

}  // namespace faultline
