// SPDX-License-Identifier: MIT
#include "lib/cases/case_file.hpp"
#include "tests/fuzz/readers/feeding.hpp"
#include "tests/fuzz/readers/readers.hpp"

namespace faultline {

void feed_cases(const std::string& bytes) {
  const std::string path = file_of("cases.db", bytes);
  read_or_refuse([&] { to_cases_json(read_case_base(path)); });
  read_or_refuse([&] { to_cases_json(from_cases_json(bytes, "cases.json")); });
}

}  // namespace faultline
