// SPDX-License-Identifier: MIT
#include "tests/support/chromium.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <stdexcept>
#include <thread>

#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

using Json = nlohmann::json;
constexpr int kTimeout_ms = 60000;  // machines that test are busy

std::string from_base64(const std::string& text) {
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char* at = std::char_traits<char>::find(digits, 64, c);
    if (!at) break;
    bits = bits << 6 | static_cast<std::uint32_t>(at - digits);
    if ((count += 6) >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 255);
  }
  return bytes;
}

/// In the child: the browser reads commands from descriptor 3 and answers on 4.
[[noreturn]] void become_browser(const std::vector<std::string>& arguments, int commands, int answers) {
  const int in = fcntl(commands, F_DUPFD, 10), out = fcntl(answers, F_DUPFD, 10);
  dup2(in, 3);
  dup2(out, 4);
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (const int stream : {0, 1, 2}) dup2(nowhere, stream);
  setpgid(0, 0);
  std::vector<char*> words;
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  execv(words[0], words.data());
  _exit(127);
}

}  // namespace

std::string chromium_program() {
  for (const char* path : {"/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"})
    if (std::filesystem::exists(path)) return path;
  return "";
}

/// A headless Chromium, driven over a pipe by the DevTools protocol.
class Browser {
 public:
  Browser();
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  /// Returns the answer to a command of a page (`session`; empty: of the browser), and hands the events that
  /// come before it to their pages.
  Json call(const std::string& session, const std::string& method, const Json& parameters = Json::object());
  /// Waits for one message, which must be an event, and hands it to its page.
  void wait_for_event() { dispatch(read_message()); }

  /// By session: what takes the events of a page.
  std::map<std::string, std::function<void(const Json&)>> listeners;

  bool has_ended() const { return has_ended_; }

 private:
  [[noreturn]] void end(const char* why);
  Json read_message();
  void dispatch(const Json& message);

  TemporaryFolder profile_;
  int process_ = -1;
  int to_browser_ = -1, from_browser_ = -1;
  int last_id_ = 0;
  bool has_ended_ = false;
  std::string unread_;
};

Browser::Browser() {
  std::array<int, 2> commands{}, answers{};
  if (pipe2(commands.data(), O_CLOEXEC) != 0 || pipe2(answers.data(), O_CLOEXEC) != 0)
    throw std::runtime_error("no pipe");
  const std::vector<std::string> arguments = {chromium_program(),
                                              "--headless=new",
                                              "--no-sandbox",
                                              "--disable-gpu",
                                              "--no-first-run",
                                              "--hide-scrollbars",
                                              "--disable-background-networking",
                                              "--disable-extensions",
                                              "--disable-dev-shm-usage",
                                              "--remote-debugging-pipe",
                                              "--user-data-dir=" + profile_.path().string()};
  process_ = fork();
  if (process_ == 0) become_browser(arguments, commands[0], answers[1]);
  close(commands[0]);
  close(answers[1]);
  to_browser_ = commands[1];
  from_browser_ = answers[0];
}

Browser::~Browser() {
  close(to_browser_);  // the browser ends when its pipe does
  close(from_browser_);
  int status = 0;
  for (int i = 0; i < 100 && waitpid(process_, &status, WNOHANG) == 0; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  kill(-process_, SIGKILL);
  waitpid(process_, &status, 0);
}

void Browser::end(const char* why) {
  has_ended_ = true;
  throw std::runtime_error(why);
}

Json Browser::read_message() {
  for (std::size_t end_of_message; (end_of_message = unread_.find('\0')) == std::string::npos;) {
    pollfd waiting{from_browser_, POLLIN, 0};
    if (poll(&waiting, 1, kTimeout_ms) <= 0) end("Chromium does not answer");
    std::array<char, 65536> buffer{};
    const ssize_t count = read(from_browser_, buffer.data(), buffer.size());
    if (count <= 0) end("Chromium ended");
    unread_.append(buffer.data(), static_cast<std::size_t>(count));
  }
  const std::size_t end_of_message = unread_.find('\0');
  Json message = Json::parse(unread_.substr(0, end_of_message));
  unread_.erase(0, end_of_message + 1);
  return message;
}

void Browser::dispatch(const Json& message) {
  const auto listener = listeners.find(message.value("sessionId", ""));
  if (listener != listeners.end()) listener->second(message);
}

Json Browser::call(const std::string& session, const std::string& method, const Json& parameters) {
  Json command = {{"id", ++last_id_}, {"method", method}, {"params", parameters}};
  if (!session.empty()) command["sessionId"] = session;
  const std::string text = command.dump() + '\0';
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t count = write(to_browser_, text.data() + sent, text.size() - sent);
    if (count <= 0) end("Chromium ended");
    sent += static_cast<std::size_t>(count);
  }
  for (;;) {
    Json message = read_message();
    if (message.value("id", 0) != last_id_) {
      dispatch(message);
      continue;
    }
    if (message.contains("error")) throw std::runtime_error(method + ": " + message["error"].dump());
    return message.at("result");
  }
}

namespace {

/// Returns the browser of this process, started anew if it has ended.
std::shared_ptr<Browser> shared_browser() {
  static std::shared_ptr<Browser> browser;
  if (!browser || browser->has_ended()) browser = std::make_shared<Browser>();
  return browser;
}

}  // namespace

BrowserPage::BrowserPage(const BrowserOptions& options) : browser_(shared_browser()) {
  context_ = browser_->call("", "Target.createBrowserContext").at("browserContextId").get<std::string>();
  target_ = browser_
                ->call("", "Target.createTarget",
                       {{"url", "about:blank"}, {"browserContextId", context_}, {"newWindow", true}})
                .at("targetId")
                .get<std::string>();
  session_ = browser_->call("", "Target.attachToTarget", {{"targetId", target_}, {"flatten", true}})
                 .at("sessionId")
                 .get<std::string>();
  browser_->listeners[session_] = [this](const Json& event) { take_event(event); };
  for (const char* domain : {"Page.enable", "Runtime.enable", "Log.enable", "Network.enable"}) call(domain);
  resize(options.width, options.height);
  call("Emulation.setScriptExecutionDisabled", {{"value", !options.script}});
  prefer_dark(options.dark);
}

BrowserPage::~BrowserPage() {
  browser_->listeners.erase(session_);
  if (browser_->has_ended()) return;
  try {
    browser_->call("", "Target.disposeBrowserContext", {{"browserContextId", context_}});
  } catch (const std::exception&) {  // the test has its result
  }
}

void BrowserPage::resize(int width, int height) {
  call("Emulation.setDeviceMetricsOverride",
       {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}});
}

void BrowserPage::prefer_dark(bool dark) {
  const Json scheme = {{"name", "prefers-color-scheme"}, {"value", dark ? "dark" : "light"}};
  call("Emulation.setEmulatedMedia", {{"features", Json::array({scheme})}});
}

void BrowserPage::take_event(const Json& message) {
  const std::string method = message.value("method", "");
  const Json& parameters = message.value("params", Json::object());
  if (method == "Page.loadEventFired") loaded_ = true;
  if (method == "Runtime.consoleAPICalled") complaints_.push_back(parameters.at("args").dump());
  if (method == "Runtime.exceptionThrown") complaints_.push_back(parameters.at("exceptionDetails").dump());
  if (method == "Log.entryAdded") complaints_.push_back(parameters.at("entry").at("text").get<std::string>());
  if (method == "Network.requestWillBeSent")
    requests_.push_back(parameters.at("request").at("url").get<std::string>());
}

Json BrowserPage::call(const std::string& method, const Json& parameters) {
  return browser_->call(session_, method, parameters);
}

void BrowserPage::open(const std::string& path) { open_address("file://" + path); }

void BrowserPage::open_address(const std::string& url) {
  loaded_ = false;
  call("Page.navigate", {{"url", url}});
  while (!loaded_) browser_->wait_for_event();
}

void BrowserPage::choose_files(const std::string& selector, const std::vector<std::string>& paths) {
  const Json root = call("DOM.getDocument").at("root").at("nodeId");
  const Json node = call("DOM.querySelector", {{"nodeId", root}, {"selector", selector}}).at("nodeId");
  call("DOM.setFileInputFiles", {{"nodeId", node}, {"files", paths}});
}

Json BrowserPage::evaluate(const std::string& expression) {
  const Json result =
      call("Runtime.evaluate", {{"expression", expression}, {"returnByValue", true}, {"awaitPromise", true}});
  if (result.contains("exceptionDetails")) throw std::runtime_error(result["exceptionDetails"].dump());
  return result.at("result").value("value", Json());
}

void BrowserPage::mouse(const char* type, double x, double y, int buttons) {
  call("Input.dispatchMouseEvent", {{"type", type},
                                    {"x", x},
                                    {"y", y},
                                    {"button", buttons ? "left" : "none"},
                                    {"buttons", std::string(type) == "mouseReleased" ? 0 : buttons},
                                    {"clickCount", buttons ? 1 : 0}});
}

void BrowserPage::move_mouse(double x, double y) { mouse("mouseMoved", x, y, 0); }

void BrowserPage::click(double x, double y) {
  move_mouse(x, y);
  mouse("mousePressed", x, y, 1);
  mouse("mouseReleased", x, y, 1);
}

void BrowserPage::drag(double from_x, double to_x, double y) {
  move_mouse(from_x, y);
  mouse("mousePressed", from_x, y, 1);
  mouse("mouseMoved", 0.5 * (from_x + to_x), y, 1);
  mouse("mouseMoved", to_x, y, 1);
  mouse("mouseReleased", to_x, y, 1);
}

void BrowserPage::press(const std::string& key) {
  Json event = {{"type", "keyDown"}, {"key", key}};
  if (key.size() == 1) event["text"] = key;
  call("Input.dispatchKeyEvent", event);
  call("Input.dispatchKeyEvent", {{"type", "keyUp"}, {"key", key}});
}

void BrowserPage::emulate_print() { call("Emulation.setEmulatedMedia", {{"media", "print"}}); }

std::string BrowserPage::screenshot() {
  return from_base64(call("Page.captureScreenshot", {{"format", "png"}}).at("data").get<std::string>());
}

std::string BrowserPage::print() {
  const Json options = {{"preferCSSPageSize", true}, {"printBackground", true}};
  return from_base64(call("Page.printToPDF", options).at("data").get<std::string>());
}

}  // namespace faultline
