// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/diagnose/diagnosis.hpp"

namespace faultline {

/// The diagnosis for an issue tracker or a merge request, in the Markdown of GitHub and GitLab: verdict, a
/// table of the faults, what to check next, what was wrong with the log, hashes. Texts from outside cannot
/// become markup, mentions or links.
std::string render_markdown(const Diagnosis& diagnosis);

/// Text that Markdown shows as it is, also in a cell of a table; one line.
std::string escaped_markdown(const std::string& text);

}  // namespace faultline
