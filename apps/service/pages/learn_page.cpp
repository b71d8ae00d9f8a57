// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "apps/service/pages/pages.hpp"

namespace faultline {

std::string learn_page(const PageContext& context) {
  return service_page(
      context, "New robot",
      "<h1>New robot</h1>\n<p>A model is learned from logs of healthy runs: three or more, of different days, with "
      "much motion of every joint. First a robot file is suggested from the first log; you look at it, and "
      "then the model is learned.</p>\n<form class=\"drop\" method=\"post\" action=\"/jobs\" "
      "enctype=\"multipart/form-data\">\n" +
          hidden_field("key", context.form_key) + hidden_field("kind", "suggest") +
          "<label for=\"logs\">Logs of healthy runs: drop them here, or choose files</label>\n<input id=\"logs\" "
          "name=\"log\" type=\"file\" multiple required>\n<button class=\"main\">Suggest a robot file</button>\n"
          "<progress max=\"1\" value=\"0\" hidden aria-label=\"Sending\"></progress>\n<p role=\"status\"></p>\n"
          "</form>\n");
}

std::string login_page(const std::string& sentence) {
  std::string text = "<h1>Log in</h1>\n";
  if (!sentence.empty()) text += fmt::format("<p role=\"alert\">{}</p>\n", safe_text(sentence));
  return service_page(
      {}, "Log in",
      text +
          "<form class=\"case\" method=\"post\" action=\"/login\">\n<input name=\"username\" autocomplete=\"username\" value=\"faultline\" hidden><label for=\"token\">Token, as "
          "faultline serve printed it</label>\n<input id=\"token\" name=\"token\" type=\"password\" "
          "autocomplete=\"current-password\" required>\n<p><button class=\"main\">Log in</button></p>\n"
          "</form>\n");
}

}  // namespace faultline
