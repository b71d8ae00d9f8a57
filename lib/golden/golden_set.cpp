// SPDX-License-Identifier: MIT
#include "lib/golden/golden_set.hpp"

#include <filesystem>

namespace faultline {

std::string GoldenLog::name() const { return std::filesystem::path(log.path).filename().string(); }

ToleranceChain GoldenSet::chain(const GoldenLog& log) const { return {&log.tolerances, &tolerances}; }

ToleranceChain GoldenSet::chain(const GoldenIdentification& identified) const {
  return {&identified.tolerances, &tolerances};
}

ToleranceChain GoldenSet::chain() const { return {&tolerances}; }

}  // namespace faultline
