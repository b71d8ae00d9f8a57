// SPDX-License-Identifier: MIT
#include "lib/reproduce/protocol/reproduce_options.hpp"

#include <string>

#include "lib/core/error.hpp"

namespace faultline {

void ReproduceOptions::check() const {
  if (seeds < 1 || seeds > 100)
    throw Error(ErrorCode::usage, "ReproduceOptions.seeds",
                "is " + std::to_string(seeds) + ", must be from 1 to 100");
  if (threads < 0)
    throw Error(ErrorCode::usage, "ReproduceOptions.threads",
                "is " + std::to_string(threads) + ", must not be negative");
}

}  // namespace faultline
