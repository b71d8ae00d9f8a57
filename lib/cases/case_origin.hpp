// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/cases/case.hpp"

namespace faultline {

/// How a case is known, the best first: the order in which reports show similar cases.
enum class CaseOrigin {
  field,      ///< seen on the robot at work, and a person said what it was
  labelled,   ///< a log that was given to `learn` with its label
  diagnosed,  ///< seen on the robot at work; what it was is this program's word alone, or not known
  simulated,
};
/// The name used in JSON and options, such as "field".
const char* to_string(CaseOrigin origin);
/// Throws Error(usage) that lists the names when `name` is none of them.
CaseOrigin case_origin_from(const std::string& name);

CaseOrigin origin_of(const Case& c);

/// True for what people added: neither simulated nor of a labelled log.
bool is_of_field(const Case& c);

/// Name of the log that the case was seen in; empty where there is none or it is not known.
std::string log_name_of(const Case& c);

/// Where the case comes from and who says what it was, such as "confirmed in the field by A. Weber on
/// 2026-03-02, robot bench 7, log night.csv". `robot` is the robot of the base.
std::string origin_words(const Case& c, const std::string& robot = "");

}  // namespace faultline
