// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cstring>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/arrays/array_file.hpp"
#include "formats/hdf5/hdf5_dataset.hpp"
#include "formats/hdf5/hdf5_library.hpp"
#include "lib/core/issue.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

constexpr std::size_t kMostObjects = 1 << 14;
constexpr std::size_t kDeepest = 32;
constexpr std::size_t kLongestTarget = 4096;  ///< bytes of a link's text
constexpr std::size_t kLongestPath = 1 << 12;
constexpr hssize_t kMostTexts = 1 << 14;     ///< of an attribute or dataset
constexpr std::size_t kMostBytes = 1 << 24;  ///< of its texts

/// Reads texts by `read`, which takes the destination.
template <typename Read>
std::vector<std::string> texts_of(hid_t type, hid_t space, Read read) {
  std::vector<std::string> texts;
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  const std::size_t size = H5Tget_size(type);
  if (H5Tget_class(type) != H5T_STRING || count <= 0 || count > kMostTexts || size == 0 || size > kMostBytes)
    return texts;
  if (H5Tis_variable_str(type) > 0) {
    std::vector<char*> pointers(static_cast<std::size_t>(count), nullptr);
    if (read(pointers.data()) >= 0)
      for (const char* text : pointers) texts.emplace_back(text ? text : "");
    H5Dvlen_reclaim(type, space, H5P_DEFAULT, pointers.data());
    return texts;
  }
  if (size > kMostBytes / static_cast<std::size_t>(count)) return texts;
  std::string bytes(size * static_cast<std::size_t>(count), '\0');
  if (read(bytes.data()) < 0) return texts;
  for (std::size_t at = 0; at < bytes.size(); at += size) {
    std::string text = bytes.substr(at, size);
    text.resize(std::strlen(text.c_str()));
    while (H5Tget_strpad(type) == H5T_STR_SPACEPAD && !text.empty() && text.back() == ' ') text.pop_back();
    texts.push_back(text);
  }
  return texts;
}

/// Returns the texts of the first of these attributes that the object has, one or a list; empty for none.
std::vector<std::string> hdf5_attribute(hid_t object, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (H5Aexists(object, name.c_str()) <= 0) continue;
    const Hdf5Id attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose);
    if (!attribute.ok()) continue;
    const Hdf5Id type(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
    const auto texts = texts_of(type, space, [&](void* to) { return H5Aread(attribute, type, to); });
    if (!texts.empty()) return texts;
  }
  return {};
}

/// Returns the texts of a dataset of texts; empty for other datasets.
std::vector<std::string> hdf5_texts(hid_t dataset) {
  const Hdf5Id type(H5Dget_type(dataset), H5Tclose), space(H5Dget_space(dataset), H5Sclose);
  return texts_of(type, space,
                  [&](void* to) { return H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, to); });
}

/// A walk through the groups.
struct Walk {
  std::set<std::string> places;                                 ///< paths of groups and datasets
  std::vector<std::pair<std::string, std::string>> soft_links;  ///< path, and the path of the target
  hid_t file = -1;
  Hdf5Tree tree;
  std::string path;  ///< of the group that is being read, ended by '/'
  std::size_t depth = 0, objects = 0;
  std::set<haddr_t> seen;
};

void walk_group(Walk& walk, const std::string& path);

void leave_out(Walk& walk, const std::string& path, const char* why) {
  walk.tree.issues.add(make_issue("signal_left_out", Severity::warning,
                                  fmt::format("\"{}\" {}", shortened(path, kLongestName), why), path));
}

/// True for groups of internal data of MATLAB (#refs#) and PyTables (_i_table, an index).
bool is_own_affair(std::string_view name) { return name.starts_with("#") || name.starts_with("_i_"); }

void visit(Walk& walk, hid_t group, const char* name) {
  H5O_info_t facts;
  if (H5Oget_info_by_name2(group, name, &facts, H5O_INFO_BASIC, H5P_DEFAULT) < 0) {
    walk.tree.issues.add(make_issue(
        "array_damaged", Severity::severe,
        fmt::format("\"{}\" is damaged and was left out", shortened(walk.path + name, kLongestName)),
        walk.path + name));
    return;
  }
  walk.places.insert(walk.path + name);
  if (facts.type == H5O_TYPE_DATASET) {
    if (walk.path == "/" && std::string(name) == kNotesName) {
      const Hdf5Id dataset(H5Dopen2(group, name, H5P_DEFAULT), H5Dclose);
      const auto texts = dataset.ok() ? hdf5_texts(dataset) : std::vector<std::string>{};
      if (!texts.empty()) walk.tree.notes = texts.front() + " ";
      if (!texts.empty()) return;
    }
    walk.tree.datasets.push_back(walk.path + name);
  }
  if (facts.type == H5O_TYPE_GROUP && !is_own_affair(name) && walk.seen.insert(facts.addr).second)
    walk_group(walk, walk.path + name + "/");
}

/// Returns the target of a soft link as path from the root; empty when it cannot be read.
std::string soft_target(const Walk& walk, hid_t group, const char* name, std::size_t bytes) {
  std::string target(std::min(bytes, kLongestTarget), '\0');
  if (H5Lget_val(group, name, target.data(), target.size(), H5P_DEFAULT) < 0) return "";
  target.resize(std::min(target.find('\0'), target.size()));
  return target.starts_with('/') ? target : walk.path + target;
}

/// Visits a link; one that cannot be followed does not end the walk.
herr_t visit_link(hid_t group, const char* name, const H5L_info_t* link, void* walk_at) {
  Walk& walk = *static_cast<Walk*>(walk_at);
  if (++walk.objects > kMostObjects) return 1;
  if (walk.path.size() + std::strlen(name) > kLongestPath) {
    walk.tree.issues.add(make_issue("array_damaged", Severity::warning,
                                    fmt::format("an object below \"{}\" was left out: its path is too long",
                                                shortened(walk.path, kLongestName))));
    return 0;
  }
  if (link->type == H5L_TYPE_HARD) visit(walk, group, name);
  if (link->type == H5L_TYPE_SOFT)
    walk.soft_links.emplace_back(walk.path + name, soft_target(walk, group, name, link->u.val_size));
  if (link->type >= H5L_TYPE_UD_MIN)  // in the library, these are links into other files
    leave_out(walk, walk.path + name,
              "is a link into another file and was left out; copy its target into this file");
  return 0;
}

/// Reports soft links without a target in the file. One with a target is only another name of it.
void report_open_links(Walk& walk) {
  for (const auto& [link, target] : walk.soft_links)
    if (!walk.places.count(target))
      leave_out(walk, link, "is a link without a target in this file and was left out");
}

void walk_group(Walk& walk, const std::string& path) {
  if (walk.depth == kDeepest) return;
  const std::string before = walk.path;
  walk.path = path;
  ++walk.depth;
  const Hdf5Id group(H5Gopen2(walk.file, path.c_str(), H5P_DEFAULT), H5Gclose);
  hsize_t next = 0;
  if (!group.ok() || H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, &next, visit_link, &walk) < 0)
    walk.tree.issues.add(make_issue(
        "array_damaged", Severity::severe,
        fmt::format("the group \"{}\" is damaged; some of it was left out", shortened(path, kLongestName)),
        path));
  --walk.depth;
  walk.path = before;
}

/// Returns the texts of a list pickled by Python in protocol 0, as PyTables does: each in a line after a V.
std::vector<std::string> pickled_texts(const std::string& pickle) {
  std::vector<std::string> texts;
  for (std::size_t begin = 0; begin < pickle.size();) {
    const std::size_t end = std::min(pickle.find('\n', begin), pickle.size());
    std::string line = pickle.substr(begin, end - begin);
    if (!line.empty() && line[0] == 'a') line.erase(0, 1);
    if (!line.empty() && line[0] == 'V') texts.push_back(line.substr(1));
    begin = end + 1;
  }
  return texts;
}

/// Splits a single text such as "q1, q2" at its commas; returns a list unchanged.
std::vector<std::string> as_list(std::vector<std::string> texts) {
  if (texts.size() != 1) return texts;
  const std::string text = texts.front();
  texts.clear();
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find_first_of(",;", begin), text.size());
    const std::size_t first = std::min(text.find_first_not_of(' ', begin), end);
    texts.push_back(text.substr(first, end - first));
    begin = end + 1;
  }
  return texts;
}

std::vector<std::string> texts_at(hid_t file, const std::string& path) {
  if (H5Lexists(file, path.c_str(), H5P_DEFAULT) <= 0) return {};
  const Hdf5Id dataset(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose);
  return dataset.ok() ? hdf5_texts(dataset) : std::vector<std::string>{};
}

}  // namespace

Hdf5Tree hdf5_tree(hid_t file) {
  Walk walk;
  walk.file = file;
  walk_group(walk, "/");
  report_open_links(walk);
  return std::move(walk.tree);
}

void describe_hdf5_fields(hid_t file, const std::string& path, Hdf5Dataset& dataset) {
  const auto units = as_list(hdf5_attribute(dataset.id(), {"unit", "units", "Unit", "Units"}));
  const auto names = as_list(hdf5_attribute(dataset.id(), {"columns", "names", "column_names", "labels"}));
  constexpr std::string_view kPandasValues = "_values";
  for (Hdf5Field& field : dataset.fields()) {
    if (field.name.empty()) {
      if (units.size() == 1) field.unit = units.front();
      field.units = units.size() > 1 ? units : std::vector<std::string>{};
      field.names = names;
      if (names.empty() && path.ends_with(kPandasValues))
        field.names = texts_at(file, path.substr(0, path.size() - kPandasValues.size()) + "_items");
      continue;
    }
    const auto own_unit = hdf5_attribute(dataset.id(), {field.name + "_unit", field.name + "_units"});
    if (!own_unit.empty()) field.unit = own_unit.front();
    const auto kind = hdf5_attribute(dataset.id(), {field.name + "_kind"});
    if (!kind.empty()) field.names = pickled_texts(kind.front());
  }
}

bool is_text_of_matlab(hid_t dataset) {
  const auto kind = hdf5_attribute(dataset, {"MATLAB_class"});
  return !kind.empty() && (kind.front() == "char" || kind.front() == "cell");
}

}  // namespace faultline
