// SPDX-License-Identifier: MIT
#include "lib/golden/check.hpp"
#include "lib/golden/golden_set.hpp"
#include "lib/golden/observation.hpp"
#include "tests/fuzz/readers/feeding.hpp"
#include "tests/fuzz/readers/readers.hpp"

namespace faultline {

void feed_golden(const std::string& bytes) {
  read_or_refuse([&] { golden_from_text(bytes, "golden.toml"); });
  read_or_refuse([&] { trace_from_csv(bytes, "trace.csv"); });
  read_or_refuse([&] { run_from_json(bytes, "run.json"); });
}

}  // namespace faultline
