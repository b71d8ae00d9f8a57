// SPDX-License-Identifier: MIT
#include "apps/work/labels.hpp"

#include "tests/fuzz/readers/feeding.hpp"
#include "tests/fuzz/readers/readers.hpp"

namespace faultline {

void feed_labels(const std::string& bytes) {
  const std::string path = file_of("labels.csv", bytes);
  read_or_refuse([&] {
    for (const LogLabel& label : read_labels(path))
      demand(label.label.joint.number() >= 0, "joints count from 1");
  });
}

}  // namespace faultline
