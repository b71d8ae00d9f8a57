// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/identify/identification.hpp"

/// The tables of the identification page, as HTML.
namespace faultline {

std::string parameter_tables(const Identification& identification);
std::string fit_tables(const Identification& identification);
std::string excitation_tables(const Identification& identification);
std::string trend_table(const Identification& identification);
std::string log_tables(const Identification& identification);

}  // namespace faultline
