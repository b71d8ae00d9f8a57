// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "lib/log/log.hpp"

namespace faultline::testing {

/// Folder of the public and independent logs; empty when it is not there.
inline std::string shared_data() {
  const char* from_environment = std::getenv("FAULTLINE_SHARED_DATA");
  const std::string folder = from_environment ? from_environment : FAULTLINE_SOURCE_DIR "/../shared/data";
  if (std::filesystem::is_directory(folder)) return folder;
  std::cout << "no shared data at " << folder << ": passed without them\n";
  return "";
}

/// Columns of a plain CSV by position: time, then q, dq (may be none), tau of every joint.
inline Log read_plain_csv(const std::string& path, const std::vector<int>& q, const std::vector<int>& dq,
                          const std::vector<int>& tau, double tau_scale = 1.0) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  Log log;
  log.q.resize(q.size());
  log.dq.resize(dq.size());
  log.tau.resize(tau.size());
  while (std::getline(file, line)) {
    std::vector<double> row;
    std::stringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
    if (!log.time.empty() && row[0] <= log.time.back()) continue;
    log.time.push_back(row[0]);
    for (std::size_t j = 0; j < q.size(); ++j) log.q[j].push_back(row[q[j]]);
    for (std::size_t j = 0; j < dq.size(); ++j) log.dq[j].push_back(row[dq[j]]);
    for (std::size_t j = 0; j < tau.size(); ++j) log.tau[j].push_back(tau_scale * row[tau[j]]);
  }
  return log;
}

inline Log read_rrp_csv(const std::string& path) {
  return read_plain_csv(path, {1, 2, 3}, {4, 5, 6}, {7, 8, 9});
}

}  // namespace faultline::testing
