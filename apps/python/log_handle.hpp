// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/python/watched_work.hpp"
#include "formats/open_log.hpp"
#include "lib/log/raw_reader.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// A column of numbers in memory that the caller owns.
struct ColumnView {
  RawColumn column;
  std::span<const double> values;
  bool is_text = false;  ///< a column without numbers; `values` is empty and each cell is missing
};

/// A log as given by Python: a file with its parts, or columns in memory.
class LogHandle {
 public:
  LogHandle(std::string path, LogSelection parts) : name_(std::move(path)), parts_(std::move(parts)) {}
  /// Keeps the arrays alive; None stands for a column of text.
  LogHandle(std::string name, const std::vector<std::string>& names, const std::vector<std::string>& units,
            const pybind11::list& arrays, int run);

  const std::string& name() const { return name_; }
  bool is_file() const { return arrays_.empty(); }
  const LogSelection& parts() const { return parts_; }
  /// Returns all files of the log; none for columns.
  std::vector<std::string> files() const;

  /// Opens the columns without mapping. Throws as open_parts() does.
  std::unique_ptr<RawReader> open_columns(const RecordingChoice& choice = {}) const;
  /// Opens all channels of the log in SI: with the columns of a robot file (null: none), with columns without
  /// a meaning if `extra`. It ends with the work and reports its progress.
  std::unique_ptr<LogSource> open_channels(const Robot* robot, bool extra, ProgressRelay& watch) const;
  /// Opens a log of this robot as open_robot_log() does; it ends with the work and does not read ahead.
  /// Reports the progress if `reports_progress` is set.
  std::unique_ptr<LogSource> open(const Robot& robot, ProgressRelay& watch, bool reports_progress) const;

 private:
  std::string name_;
  LogSelection parts_;
  std::vector<ColumnView> columns_;
  std::vector<pybind11::object> arrays_;  ///< owners of the memory of the columns
};

/// Returns the robot of a robot file or of an order of axes; nullopt for an empty name.
std::optional<Robot> robot_named(const std::string& robot);

/// Returns an array that owns the values, which are not copied.
template <typename Value>
pybind11::array_t<Value> owned_array(std::vector<Value>&& values) {
  auto kept = std::make_unique<std::vector<Value>>(std::move(values));
  const auto size = static_cast<pybind11::ssize_t>(kept->size());
  const Value* const data = kept->data();
  const pybind11::capsule owner(kept.release(),
                                [](void* vector) { delete static_cast<std::vector<Value>*>(vector); });
  return pybind11::array_t<Value>(size, data, owner);
}

}  // namespace faultline
