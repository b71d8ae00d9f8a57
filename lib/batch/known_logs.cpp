// SPDX-License-Identifier: MIT
#include "lib/batch/known_logs.hpp"

#include <array>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "lib/core/atomic_file.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

Json stamps_json(const std::vector<FileStamp>& stamps) {
  Json all = Json::array();
  for (const FileStamp& stamp : stamps)
    all.push_back({stamp.bytes, stamp.written_ns, stamp.changed_ns, stamp.number});
  return all;
}

std::vector<FileStamp> stamps_from(const Json& json) {
  std::vector<FileStamp> stamps;
  for (const Json& one : json) {
    const auto values = one.get<std::array<std::int64_t, 4>>();
    stamps.push_back({values[0], values[1], values[2], values[3]});
  }
  return stamps;
}

/// [log, sha256, stamps of its files, stamps of its results].
std::string line_of(const KnownLog& known) {
  const Json json{known.log, known.sha256, stamps_json(known.files), stamps_json(known.results)};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::map<std::string, KnownLog> read_lines(const std::string& path) {
  std::map<std::string, KnownLog> all;
  std::ifstream lines(path);
  for (std::string line; std::getline(lines, line);) try {
      const Json json = Json::parse(line);
      KnownLog known{json.at(0), json.at(1), stamps_from(json.at(2)), stamps_from(json.at(3))};
      all[known.log] = std::move(known);
    } catch (const nlohmann::json::exception&) {
      // A line that a kill has cut: its log is read again.
    }
  return all;
}

}  // namespace

KnownLogs::KnownLogs(std::string path) : path_(std::move(path)), before_(read_lines(path_)), lines_(path_) {}

const KnownLog* KnownLogs::find(const std::string& log) const {
  const auto found = before_.find(log);
  return found == before_.end() ? nullptr : &found->second;
}

void KnownLogs::keep(const std::string& log) {
  const auto found = before_.find(log);
  if (found == before_.end()) return;
  const std::lock_guard lock(mutex_);
  now_[log] = found->second;
}

void KnownLogs::note(KnownLog known) {
  if (!are_settled(known.files)) return;
  const std::lock_guard lock(mutex_);
  lines_.add(line_of(known));
  std::string name = known.log;
  now_[std::move(name)] = std::move(known);
}

void KnownLogs::finish() {
  std::string text;
  for (const auto& [log, known] : now_) text += line_of(known);
  write_file(path_, text);
}

}  // namespace faultline
