// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/diagnose/diagnosis.hpp"

namespace faultline {

/// One row a fault under a header that is always there, so that rows of several logs can be put together. The
/// first columns are those of a labels file (file,fault,joint,onset_s,end_s). A log without faults gives one
/// row with fault "none" when it is healthy and no row when it is inconclusive. RFC 4180 quoting; NaN is
/// empty; a number is the shortest text that reads back the same.
std::string render_csv(const Diagnosis& diagnosis);
std::string csv_header();
/// The rows without the header.
std::string csv_rows(const Diagnosis& diagnosis);

}  // namespace faultline
