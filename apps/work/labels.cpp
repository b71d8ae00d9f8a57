// SPDX-License-Identifier: MIT
#include "apps/work/labels.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"

namespace faultline {
namespace {

constexpr std::size_t kLongestLabelHeader = 4096;  // bytes

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else if (c != '\r') {
      cells.back() += c;
    }
  }
  return cells;
}

/// Indices of the columns.
struct LabelColumns {
  std::size_t file, fault, joint, onset;
};

std::size_t column(const std::vector<std::string>& header, const char* name, const std::string& path) {
  const auto found = std::find(header.begin(), header.end(), name);
  if (found == header.end())
    throw Error(ErrorCode::input, path,
                std::string("has no column \"") + name + "\"; expected the header file,fault,joint,onset_s");
  return static_cast<std::size_t>(found - header.begin());
}

double number(const std::string& cell, const std::string& where) {
  if (cell.empty()) return 0.0;
  std::size_t used = 0;
  double value = 0.0;
  try {
    value = std::stod(cell, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used != cell.size() || std::isinf(value))
    throw Error(ErrorCode::input, where, "\"" + cell + "\" is not a number");
  return value;
}

Joint joint_from(const std::string& cell, const std::string& where) {
  const double value = number(cell, where);
  if (!(value >= 0.0 && value <= 1000.0 && value == std::floor(value)))
    throw Error(ErrorCode::input, where,
                "\"" + cell + "\" is not a joint; joints count from 1, and 0 means no joint");
  return Joint::numbered(static_cast<int>(value));
}

LogLabel label_from(const std::vector<std::string>& cells, const LabelColumns& at, const std::string& where) {
  if (cells.size() <= std::max({at.file, at.fault, at.joint, at.onset}))
    throw Error(ErrorCode::input, where, "has only " + std::to_string(cells.size()) + " cells");
  LogLabel label;
  label.file = cells[at.file];
  try {
    label.label.kind = fault_kind_from(cells[at.fault]);
  } catch (const Error& error) {
    throw Error(ErrorCode::input, where + ", column fault", error.message());
  }
  label.label.joint = joint_from(cells[at.joint], where + ", column joint");
  label.onset_s = number(cells[at.onset], where + ", column onset_s");
  return label;
}

}  // namespace

std::vector<LogLabel> read_labels(const std::string& path) {
  const std::string bytes = read_file(path);
  refuse_open_number(bytes, path);
  std::istringstream text(bytes);
  std::string line;
  std::getline(text, line);
  const std::vector<std::string> header = cells_of(line);
  const LabelColumns at{column(header, "file", path), column(header, "fault", path),
                        column(header, "joint", path), column(header, "onset_s", path)};
  std::vector<LogLabel> labels;
  for (int row = 2; std::getline(text, line); ++row)
    if (line.find_first_not_of(" \r\t,") != std::string::npos)
      labels.push_back(label_from(cells_of(line), at, path + ", row " + std::to_string(row)));
  return labels;
}

bool is_label_table(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string head(kLongestLabelHeader, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  const std::vector<std::string> header = cells_of(head.substr(0, head.find('\n')));
  return std::find(header.begin(), header.end(), "file") != header.end() &&
         std::find(header.begin(), header.end(), "fault") != header.end();
}

const LogLabel* label_of(const std::vector<LogLabel>& labels, const std::string& log) {
  const auto name = std::filesystem::path(log).filename();
  for (const LogLabel& label : labels)
    if (std::filesystem::path(label.file).filename() == name) return &label;
  return nullptr;
}

}  // namespace faultline
