// SPDX-License-Identifier: MIT
#include "lib/identify/quiet_solver.hpp"

#include <glog/logging.h>
#include <suitesparse/SuiteSparse_config.h>

namespace faultline {

void quiet_solver() {
  static const bool done = [] {
    FLAGS_minloglevel = google::GLOG_FATAL;
    SuiteSparse_config.printf_func = nullptr;  // by which CHOLMOD warns of matrices it cannot factor
    return true;
  }();
  (void)done;
}

}  // namespace faultline
