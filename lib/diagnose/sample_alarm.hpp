// SPDX-License-Identifier: MIT
#pragma once

#include "lib/classify/fault_criterion.hpp"
#include "lib/fault/opinion.hpp"

namespace faultline {

/// A stretch of a log that the paper's fault criterion calls faulty, with the opinion of each network alone.
struct SampleAlarm {
  SampleEpisode episode;
  Opinions opinions;
};

}  // namespace faultline
