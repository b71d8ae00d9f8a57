// SPDX-License-Identifier: MIT
#include "tests/support/served_folder.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <regex>
#include <stdexcept>
#include <thread>

#include "apps/service/http.hpp"
#include "lib/core/atomic_file.hpp"
#include "tests/support/signalled_program.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

constexpr int kTries = 3000;      // at 10 ms: half a minute
constexpr int kJobTries = 30000;  // at 10 ms: five minutes, for a robot that is learned on a busy machine

void pause() { std::this_thread::sleep_for(std::chrono::milliseconds(10)); }

/// The first group of an expression in a text; empty if it is not there.
std::string found_in(const std::string& text, const std::string& expression) {
  std::smatch found;
  return std::regex_search(text, found, std::regex(expression)) ? found[1].str() : "";
}

httplib::Client client_of(const ServedFolder& service) {
  httplib::Client client("127.0.0.1", service.port());
  client.set_read_timeout(60);
  return client;
}

httplib::Headers with_cookie(const Headers& headers, const std::string& cookie) {
  httplib::Headers all(headers.begin(), headers.end());
  if (!cookie.empty()) all.emplace("Cookie", cookie);
  return all;
}

ServiceAnswer answer_of(const httplib::Result& result) {
  if (!result) return {};
  return {result->status, result->body, result->get_header_value("Location"),
          result->get_header_value("Set-Cookie")};
}

}  // namespace

SentFile sample_log(const std::string& path) {
  return {fs::path(path).filename().string(), read_file(kServedSamples + path)};
}

ServedFolder::ServedFolder(std::vector<std::string> options) : options_(std::move(options)) {
  fs::create_directory(file(""));
  fs::copy_file(kServedSamples + "golden/model-749d7413.json", file("bench.model"));
  fs::copy_file(kServedSamples + "golden/cases-18392bf9.db", file("bench.model.cases.db"));
  start();
}

ServedFolder::~ServedFolder() { end(SIGTERM); }

std::string ServedFolder::messages() const { return read_file(folder_.file("stderr")); }

void ServedFolder::start() {
  const std::string robots = folder_.file("robots"), err = folder_.file("stderr");
  process_ = ::fork();
  if (process_ == 0) {
    heed_signals();
    std::vector<std::string> words{FAULTLINE_PROGRAM, "serve", robots, "--port", "0"};
    words.insert(words.end(), options_.begin(), options_.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const int file = ::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (file < 0 || ::dup2(file, 2) < 0) ::_exit(126);
    ::execv(argv.front(), argv.data());
    ::_exit(127);
  }
  for (int i = 0; i < kTries; ++i) {
    pause();
    const std::string port = fs::exists(err) ? found_in(messages(), R"(http://[^ ]*:([0-9]+)/)") : "";
    if (!port.empty()) {
      port_ = std::stoi(port);
      return;
    }
  }
  throw std::runtime_error("faultline serve does not listen: " + messages());
}

void ServedFolder::end(int signal) {
  if (process_ < 0) return;
  ::kill(process_, signal);
  int status = 0;
  ::waitpid(process_, &status, 0);
  process_ = -1;
  fs::remove(folder_.file("stderr"));
}

ServiceAnswer Visitor::get(const std::string& path, const Headers& headers) {
  ServiceAnswer answer = answer_of(client_of(service_).Get(path.c_str(), with_cookie(headers, cookie)));
  const std::string fresh = found_in(answer.set_cookie, "^(faultline_[0-9a-f]+=[^;]*)");
  if (!fresh.empty()) cookie = fresh;
  return answer;
}

std::string Visitor::key() { return found_in(get("/learn").body, R"(name="key" value="([0-9a-f]+)\")"); }

ServiceAnswer Visitor::post(const std::string& path, std::vector<std::pair<std::string, std::string>> fields,
                            const std::vector<SentFile>& files, const Headers& headers) {
  httplib::MultipartFormDataItems items;
  if (fields.empty() || fields[0].first != "key") fields.insert(fields.begin(), {"key", key()});
  for (const auto& [name, value] : fields) items.push_back({name, value, "", ""});
  for (const SentFile& file : files)
    items.push_back({"log", file.bytes, file.name, "application/octet-stream"});
  return answer_of(client_of(service_).Post(path.c_str(), with_cookie(headers, cookie), items));
}

std::string Visitor::diagnose(const std::string& log) {
  return post("/jobs", {{"key", key()}, {"kind", "diagnose"}, {"model", "bench.model"}}, {sample_log(log)})
      .location;
}

std::string Visitor::result_of(const std::string& job) {
  for (int i = 0; i < kJobTries; ++i) {
    const ServiceAnswer state = get(job + "/state.json");
    if (state.status == 200 && nlohmann::json::parse(state.body).at("ended") == true) return get(job).body;
    pause();
  }
  return "";
}

}  // namespace faultline
