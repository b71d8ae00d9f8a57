// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lib/log/log.hpp"

namespace faultline {

/// One channel of an overview: least and largest value of each stretch of rows; NaN if it has none.
struct OverviewChannel {
  std::string name;
  std::string unit;  ///< of an extra channel
  bool canonical = true;
  std::vector<float> low, high;
};

/// A log of any length in at most 1024 stretches of equally many rows: enough for a picture.
struct LogOverview {
  std::vector<double> from_s, to_s;  ///< first and last time of each stretch, s
  std::vector<OverviewChannel> channels;
  std::size_t channels_left_out = 0;
};

/// Makes an overview from the segments of a log; the result does not depend on how it is divided.
class OverviewPass {
 public:
  void add(const Log& segment);
  const LogOverview& result() const { return overview_; }

 private:
  void begin(const Log& segment);
  void add_values(OverviewChannel& channel, const std::vector<double>& values) const;
  void halve();

  LogOverview overview_;
  std::int64_t rows_ = 0;
  std::int64_t rows_a_stretch_ = 1;
};

}  // namespace faultline
