// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/service/access.hpp"
#include "apps/service/condition_view.hpp"
#include "apps/service/form.hpp"
#include "apps/service/job_queue.hpp"
#include "apps/service/pages/pages.hpp"
#include "apps/service/service_folder.hpp"

namespace httplib {
class Server;
struct Request;
struct Response;
}  // namespace httplib

namespace faultline {

struct ServiceOptions {
  std::string folder;
  std::string address = "127.0.0.1";  ///< on which the service listens
  int port = 8080;                    ///< 0: any that is free
  std::vector<std::string> hosts{};   ///< names under which browsers reach it, besides localhost
  bool new_token = false;             ///< replace the token, which ends all sessions
  bool https = false;                 ///< browsers reach it through HTTPS: cookies are sent only there
  QueueLimits queue{};
  FormLimits form{};
};

/// Name of this machine, under which others may reach it.
std::string machine_name();

/// What the handlers of requests share.
struct ServiceState {
  ServiceState(const ServiceOptions& options, const std::string& token);

  ServiceOptions options;
  ServiceFolder folder;
  ConditionView condition;
  JobQueue queue;
  Access access;
  RateLimit writes, logins;
};

/// Gives a session to the browser; an empty one ends it.
void set_session(const ServiceState& state, httplib::Response& response, const std::string& session);
/// The session that a request came with; empty without one.
std::string sent_session(const ServiceState& state, const httplib::Request& request);
/// The session of a request; a new one if it has none, which `response` then gives to the browser.
std::string session_for(const ServiceState& state, const httplib::Request& request,
                        httplib::Response& response);
PageContext context_for(const ServiceState& state, const httplib::Request& request,
                        httplib::Response& response);

void send_page(httplib::Response& response, const std::string& html, int status = 200);
/// Answers that a request was refused: as JSON to a script, else as a page.
void send_refusal(const ServiceState& state, const httplib::Request& request, httplib::Response& response,
                  int status, const std::string& sentence);

/// Answers what changes nothing: pages, reports, states of jobs.
void add_reading_routes(httplib::Server& server, ServiceState& state);
/// Answers forms.
void add_form_routes(httplib::Server& server, ServiceState& state);

/// The pages of a folder of models over HTTP: logs are dropped, diagnosed and answered with reports.
///
/// Nothing from the network names a file. A service that other machines can reach needs a token. Each form
/// holds a key of its session. Requests under a foreign host name are refused.
class Service {
 public:
  /// Opens the folder, starts the queue and listens. Throws Error(usage) for an address or a port that cannot
  /// be used, and as ServiceFolder.
  explicit Service(const ServiceOptions& options);
  ~Service();

  int port() const { return port_; }
  /// The token that opens the service, if this start made a new one; it cannot be read again.
  const std::string& new_token() const { return new_token_; }
  bool needs_token() const;

  /// Answers requests until the program ends.
  void run();

 private:
  std::string new_token_;
  std::unique_ptr<ServiceState> state_;
  std::unique_ptr<httplib::Server> server_;
  int port_ = 0;
};

}  // namespace faultline
