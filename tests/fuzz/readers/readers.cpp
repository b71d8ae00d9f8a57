// SPDX-License-Identifier: MIT
#include "tests/fuzz/readers/readers.hpp"

namespace faultline {

const std::vector<FedReader>& fed_readers() {
  static const std::vector<FedReader> all{
      {"log", feed_log},       {"robot", feed_robot}, {"spec", feed_spec},       {"golden", feed_golden},
      {"labels", feed_labels}, {"model", feed_model}, {"network", feed_network}, {"cases", feed_cases},
  };
  return all;
}

}  // namespace faultline
