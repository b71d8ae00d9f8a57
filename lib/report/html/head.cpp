// SPDX-License-Identifier: MIT
#include "lib/report/html/head.hpp"

#include <fmt/format.h>

#include "lib/core/markup.hpp"
#include "lib/report/html/assets.hpp"
#include "lib/report/html/source_hash.hpp"

namespace faultline {
namespace {

std::string policy(bool with_script) {
  std::string scripts = "'none'";
  if (with_script) scripts = source_hash(dygraphs_script()) + " " + source_hash(page_script());
  return fmt::format(
      "default-src 'none'; script-src {}; style-src {} {}; base-uri 'none'; form-action 'none'", scripts,
      source_hash(page_style()), source_hash(dygraphs_style()));
}

}  // namespace

std::string html_head(const std::string& title, bool with_script) {
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
      "http-equiv=\"Content-Security-Policy\" content=\"{}\">\n<meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n",
      policy(with_script), escaped_markup(title));
  if (with_script) text += fmt::format("<style>{}</style>\n", dygraphs_style());
  text += fmt::format("<style>{}</style>\n", page_style());  // after it, so that ours stands
  return text + "</head>\n";
}

}  // namespace faultline
