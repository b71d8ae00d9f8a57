// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace faultline {

/// What every page of the service needs of the request.
struct PageContext {
  std::string form_key{};    ///< of the session, in each form
  bool can_log_out = false;  ///< the service needs a token
};

/// Returns a whole page: head, links to the other pages, `content` (HTML) and the script. The page works
/// without the script.
std::string service_page(const PageContext& context, const std::string& title, const std::string& content);

/// Returns a page about one message, such as why a request was refused, with a link back to `back`.
std::string message_page(const PageContext& context, const std::string& title, const std::string& sentence,
                         const std::string& back);

/// Content-Security-Policy of the pages: nothing but their own style and script, forms to this service only.
std::string page_policy();
/// The same of reports, whose own policy stands in them: they are documents of no origin, so that nothing in
/// one reaches the service.
std::string report_policy();

/// Returns text that is safe in a page: printable() and escaped_markup().
std::string safe_text(const std::string& text);
/// A hidden field of a form.
std::string hidden_field(const std::string& name, const std::string& value);
/// "2026-11-30 18:20 UTC".
std::string moment_text(std::int64_t seconds_since_1970);
/// Address of a robot's page: its name with everything but letters and digits as %XX.
std::string robot_address(const std::string& model);
std::string job_address(std::int64_t id);

std::string_view service_style();
std::string_view service_script();

}  // namespace faultline
