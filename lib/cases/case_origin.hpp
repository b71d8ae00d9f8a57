// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/cases/case.hpp"

namespace faultline {

/// Origin of a case and of its label, the best first: the order in which reports list similar cases.
enum class CaseOrigin {
  field,      ///< seen on the robot in operation, with a label that a person gave
  labelled,   ///< from a log that was given to `learn` with its label
  diagnosed,  ///< seen on the robot in operation; labelled by this program only, or not known
  simulated,
};
/// Returns the name used in JSON and options, such as "field".
const char* to_string(CaseOrigin origin);
/// Throws Error(usage) that lists the names if `name` is none of them.
CaseOrigin case_origin_from(const std::string& name);

CaseOrigin origin_of(const Case& c);

/// Whether people added the case: neither simulated nor of a labelled log.
bool is_of_field(const Case& c);

/// Returns the name of the log of the case; empty if there is none or it is not known.
std::string log_name_of(const Case& c);

/// Returns in words the origin of the case and of its label, such as "confirmed in the field by A. Weber on
/// 2026-03-02, robot bench 7, log night.csv". `robot` is the robot of the base.
std::string origin_words(const Case& c, const std::string& robot = "");

}  // namespace faultline
