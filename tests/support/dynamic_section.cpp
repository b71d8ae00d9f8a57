// SPDX-License-Identifier: MIT
#include "tests/support/dynamic_section.hpp"

#include <regex>
#include <sstream>
#include <stdexcept>

#include "tests/support/run_program.hpp"

namespace faultline {
namespace {

/// Also the empty part at the end.
std::vector<std::string> parts_of(const std::string& list) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(':', begin), list.size());
    parts.push_back(list.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

}  // namespace

DynamicSection dynamic_section(const std::string& binary) {
  static const std::regex entry(R"(\((NEEDED|RPATH|RUNPATH)\).*\[(.*)\])");
  const ProgramRun read =
      run_command({"readelf", "--wide", "--dynamic", binary}, {.environment = {"LC_ALL=C"}});
  if (read.status != 0) throw std::runtime_error("readelf " + binary + ": " + read.err);
  DynamicSection section;
  std::istringstream lines(read.out);
  for (std::string line; std::getline(lines, line);) {
    std::smatch found;
    if (!std::regex_search(line, found, entry)) continue;
    if (found[1] == "NEEDED")
      section.libraries.push_back(found[2]);
    else
      for (std::string& part : parts_of(found[2])) section.search_folders.push_back(std::move(part));
  }
  return section;
}

std::vector<std::string> relative_search_folders(const std::string& binary) {
  std::vector<std::string> relative;
  for (const std::string& folder : dynamic_section(binary).search_folders)
    if (!folder.starts_with("/") && !folder.starts_with("$ORIGIN") && !folder.starts_with("${ORIGIN}"))
      relative.push_back("\"" + folder + "\"");
  return relative;
}

}  // namespace faultline
