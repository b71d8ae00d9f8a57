// SPDX-License-Identifier: MIT
#include "lib/identify/quiet_solver.hpp"

#include <glog/logging.h>

namespace faultline {

void quiet_solver() {
  static const bool done = [] {
    FLAGS_minloglevel = google::GLOG_FATAL;
    return true;
  }();
  (void)done;
}

}  // namespace faultline
