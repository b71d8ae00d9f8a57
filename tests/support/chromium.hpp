// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace faultline {

/// The installed Chromium; empty when there is none.
std::string chromium_program();

struct BrowserOptions {
  int width = 1200, height = 900;  ///< px
  bool script = true;              ///< false: as for a reader who has switched it off
  bool dark = false;               ///< prefers-color-scheme
};

class Browser;

/// A page of a headless Chromium, with cookies and storage of its own. The first page starts the browser,
/// which all pages of a process share. Throws std::runtime_error when the browser does not answer.
class BrowserPage {
 public:
  explicit BrowserPage(const BrowserOptions& options = {});
  ~BrowserPage();
  BrowserPage(const BrowserPage&) = delete;
  BrowserPage& operator=(const BrowserPage&) = delete;

  void resize(int width, int height);
  void prefer_dark(bool dark);
  /// Loads a file and waits until it is there.
  void open(const std::string& path);
  /// The same for an address, such as of a service.
  void open_address(const std::string& url);
  /// Chooses files in the file field of this selector, as a person would.
  void choose_files(const std::string& selector, const std::vector<std::string>& paths);
  /// Value of an expression in the page; a promise is waited for.
  nlohmann::json evaluate(const std::string& expression);
  void move_mouse(double x, double y);
  void click(double x, double y);
  void drag(double from_x, double to_x, double y);
  /// A key by its DOM name, such as "ArrowLeft" or "+".
  void press(const std::string& key);
  void emulate_print();
  std::string screenshot();  ///< PNG
  std::string print();       ///< PDF on A4

  /// Console messages, exceptions and violations of the page's policy since it was opened.
  const std::vector<std::string>& complaints() const { return complaints_; }
  /// Addresses that the page asked for, itself among them.
  const std::vector<std::string>& requests() const { return requests_; }

 private:
  nlohmann::json call(const std::string& method, const nlohmann::json& parameters = nlohmann::json::object());
  void take_event(const nlohmann::json& message);
  void mouse(const char* type, double x, double y, int buttons);

  std::shared_ptr<Browser> browser_;
  std::string context_, target_, session_;
  bool loaded_ = false;
  std::vector<std::string> complaints_, requests_;
};

}  // namespace faultline
