// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace faultline {

inline const std::string kServedSamples = std::string(FAULTLINE_SOURCE_DIR) + "/sample_logs/";

/// The built program as `faultline serve` on a folder of its own, with the model of the golden logs as
/// "bench.model".
class ServedFolder {
 public:
  /// `options` follow the folder on the command line.
  explicit ServedFolder(std::vector<std::string> options = {});
  ~ServedFolder();
  ServedFolder(const ServedFolder&) = delete;
  ServedFolder& operator=(const ServedFolder&) = delete;

  /// Starts the program and waits until it listens.
  void start();
  /// Ends it by a signal and waits for its end.
  void end(int signal);

  int port() const { return port_; }
  std::string address() const { return "http://127.0.0.1:" + std::to_string(port_); }
  std::string messages() const;  ///< on standard error since it was started
  std::string file(const std::string& name) const { return folder_.file("robots/" + name); }
  const TemporaryFolder& folder() const { return folder_; }

 private:
  TemporaryFolder folder_;
  std::vector<std::string> options_;
  pid_t process_ = -1;
  int port_ = 0;
};

/// A file to send.
struct SentFile {
  std::string name, bytes;
};

/// An answer of the service; status 0 if there was none.
struct ServiceAnswer {
  int status = 0;
  std::string body{}, location{}, set_cookie{};
};

using Headers = std::vector<std::pair<std::string, std::string>>;

/// A browser without pages: keeps its cookie.
class Visitor {
 public:
  explicit Visitor(const ServedFolder& service) : service_(service) {}

  ServiceAnswer get(const std::string& path, const Headers& headers = {});
  /// Sends a form, with the key of its session unless `fields` has one.
  ServiceAnswer post(const std::string& path, std::vector<std::pair<std::string, std::string>> fields,
                     const std::vector<SentFile>& files = {}, const Headers& headers = {});
  /// Uploads a sample log to diagnose and returns the address of the job; empty if it was refused.
  std::string diagnose(const std::string& log);
  /// Waits until a job has ended and returns its page.
  std::string result_of(const std::string& job);
  std::string key();

  std::string cookie{};  ///< value of the Cookie header

 private:
  const ServedFolder& service_;
};

/// Bytes of a file of the sample logs.
SentFile sample_log(const std::string& path);

}  // namespace faultline
