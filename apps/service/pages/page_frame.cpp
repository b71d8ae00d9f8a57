// SPDX-License-Identifier: MIT
#include "apps/service/pages/page_frame.hpp"

#include <fmt/format.h>

#include <array>
#include <ctime>

#include "lib/core/text.hpp"
#include "lib/report/html/elements.hpp"

namespace faultline {

std::string safe_text(const std::string& text) { return escaped_markup(printable(text)); }

std::string hidden_field(const std::string& name, const std::string& value) {
  return fmt::format("<input type=\"hidden\" name=\"{}\" value=\"{}\">", name, safe_text(value));
}

std::string moment_text(std::int64_t seconds_since_1970) {
  const auto seconds = static_cast<std::time_t>(seconds_since_1970);
  std::tm moment{};
  ::gmtime_r(&seconds, &moment);
  std::array<char, 32> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M UTC", &moment)};
}

std::string robot_address(const std::string& model) {
  std::string address = "/robots/";
  for (const char c : model) {
    const auto byte = static_cast<unsigned char>(c);
    address += std::isalnum(byte) ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return address;
}

std::string job_address(std::int64_t id) { return fmt::format("/jobs/{}", id); }

std::string page_policy() {
  return fmt::format(
      "default-src 'none'; script-src {}; style-src {} {}; connect-src 'self'; form-action 'self'; base-uri "
      "'none'; frame-ancestors 'none'",
      source_hash(service_script()), source_hash(page_style()), source_hash(service_style()));
}

std::string report_policy() {
  return "sandbox allow-scripts allow-downloads allow-popups; frame-ancestors 'none'";
}

std::string service_page(const PageContext& context, const std::string& title, const std::string& content) {
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\">\n<title>{} - faultline</title>\n<style>{}</style>\n"
      "<style>{}</style>\n</head>\n<body>\n<nav aria-label=\"Pages\"><a href=\"/\">Robots</a> <a "
      "href=\"/learn\">New robot</a>",
      safe_text(title), page_style(), service_style());
  if (context.can_log_out)
    text += "<form method=\"post\" action=\"/logout\">" + hidden_field("key", context.form_key) +
            "<button>Log out</button></form>";
  return text + fmt::format("</nav>\n<main>\n{}</main>\n<script>{}</script>\n</body>\n</html>\n", content,
                            service_script());
}

std::string message_page(const PageContext& context, const std::string& title, const std::string& sentence,
                         const std::string& back) {
  return service_page(
      context, title,
      fmt::format("<h1>{}</h1>\n<p role=\"alert\">{}</p>\n<p><a href=\"{}\">{}</a></p>\n", safe_text(title),
                  safe_text(sentence), back, back == "/" ? "To the robots" : "Back to the job"));
}

}  // namespace faultline
