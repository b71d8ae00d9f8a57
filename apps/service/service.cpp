// SPDX-License-Identifier: MIT
#include "apps/service/service.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <nlohmann/json.hpp>
#include <regex>

#include "apps/service/http.hpp"
#include "lib/core/error.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

using httplib::Request;
using httplib::Response;
using Handled = httplib::Server::HandlerResponse;

constexpr std::size_t kTokenBytes = 16;     // of a random token
constexpr int kMostWrites = 600;            // forms of an address
constexpr double kWritesWithin_s = 60.0;    // in this time
constexpr int kMostLogins = 10;             // tries of an address to log in
constexpr double kLoginsWithin_s = 60.0;    // in this time
constexpr std::size_t kThreads = 256;       // so that slow connections leave room for others
constexpr std::size_t kKeptRequests = 100;  // on one connection
constexpr int kPatience_s = 30;             // for a connection that sends nothing

bool is_loopback(const std::string& address) {
  return address == "localhost" || address == "::1" || address.starts_with("127.");
}

std::vector<std::string> host_names(const ServiceOptions& options) {
  std::vector<std::string> names = options.hosts;
  names.push_back(machine_name());
  return names;
}

bool wants_json(const Request& request) { return request.get_header_value("Accept") == "application/json"; }

/// Refuses what does not come from a page of this service.
bool is_admitted(ServiceState& state, const Request& request, Response& response) {
  const std::string host = request.get_header_value("Host");
  const auto refuse = [&](int status, const std::string& sentence) {
    send_refusal(state, request, response, status, sentence);
    response.set_header("Connection", "close");  // the body was not read
    return false;
  };
  if (request.get_header_value_count("Host") != 1 || !state.access.is_own_host(host)) {
    const std::string name = shortened(host.substr(0, host.rfind(':')), kLongestName);
    return refuse(
        421, fmt::format("{0} is no name of this service; start it with --host {0} if it should be.", name));
  }
  const bool writes = request.method != "GET" && request.method != "HEAD";
  if (writes && !state.access.is_own_origin(request.get_header_value("Origin"), host))
    return refuse(403, "The form comes from a page of another site.");
  if (writes && !state.writes.allows(request.remote_addr))
    return refuse(429, "Too many requests from this address; wait a minute.");
  if (!state.access.needs_token() || request.path == "/login") return true;
  if (state.access.is_session(sent_session(state, request))) return true;
  if (writes || wants_json(request)) return refuse(401, "Log in first.");
  response.set_redirect("/login", 303);
  return false;
}

void set_up(httplib::Server& server, ServiceState& state) {
  server.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
  server.set_keep_alive_max_count(kKeptRequests);
  server.set_read_timeout(kPatience_s);
  server.set_write_timeout(kPatience_s);
  server.set_tcp_nodelay(true);
  server.set_socket_options(
      [](socket_t socket) {  // without SO_REUSEPORT, which lets two programs share a port
        const int on = 1;
        ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
      });
  server.set_default_headers({{"X-Content-Type-Options", "nosniff"},
                              {"X-Frame-Options", "DENY"},
                              {"Referrer-Policy", "same-origin"},
                              {"Cross-Origin-Resource-Policy", "same-origin"},
                              {"Cross-Origin-Opener-Policy", "same-origin"},
                              {"Cache-Control", "no-store"}});
  server.set_pre_routing_handler([&state](const Request& request, Response& response) {
    return is_admitted(state, request, response) ? Handled::Unhandled : Handled::Handled;
  });
  server.set_exception_handler([&state](const Request& request, Response& response, std::exception_ptr) {
    send_refusal(state, request, response, 500, "This failed inside the service; load the page again.");
  });
  server.set_error_handler([&state](const Request& request, Response& response) {
    if (response.body.empty() && response.status >= 400)
      send_refusal(state, request, response, response.status,
                   response.status == 404 ? "There is no such page."
                                          : "The service does not understand this request.");
  });
  add_reading_routes(server, state);
  add_form_routes(server, state);
}

QueueLimits with_ended(QueueLimits limits, ConditionView& condition) {
  limits.ended = [&condition](const Job& job) { condition.note(job); };
  return limits;
}

}  // namespace

std::string machine_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "localhost";
}

ServiceState::ServiceState(const ServiceOptions& given, const std::string& token)
    : options(given),
      folder(given.folder),
      condition(folder),
      queue(folder, with_ended(given.queue, condition)),
      access(folder.secret(), token.empty() ? "" : token, host_names(given)),
      writes(kMostWrites, kWritesWithin_s),
      logins(kMostLogins, kLoginsWithin_s) {
  for (const std::string& session : folder.ended_sessions()) access.end_session(session);
}

void set_session(const ServiceState& state, Response& response, const std::string& session) {
  response.set_header(
      "Set-Cookie",
      fmt::format("{}={}; Path=/; HttpOnly; SameSite=Strict{}{}", state.access.cookie_name(), session,
                  state.options.https ? "; Secure" : "", session.empty() ? "; Max-Age=0" : ""));
}

std::string sent_session(const ServiceState& state, const Request& request) {
  return cookie_value(request.get_header_value("Cookie"), state.access.cookie_name());
}

std::string session_for(const ServiceState& state, const Request& request, Response& response) {
  std::string session = sent_session(state, request);
  if (state.access.is_session(session)) return session;
  if (state.access.needs_token()) return "";
  session = state.access.new_session();
  set_session(state, response, session);
  return session;
}

PageContext context_for(const ServiceState& state, const Request& request, Response& response) {
  const std::string session = session_for(state, request, response);
  return {session.empty() ? "" : state.access.form_key(session),
          state.access.needs_token() && !session.empty()};
}

void send_page(Response& response, const std::string& html, int status) {
  response.status = status;
  response.set_header("Content-Security-Policy", page_policy());
  response.set_content(html, "text/html; charset=utf-8");
}

void send_refusal(const ServiceState& state, const Request& request, Response& response, int status,
                  const std::string& sentence) {
  if (wants_json(request)) {
    response.status = status;
    const nlohmann::json json{{"sentence", sentence}};
    response.set_content(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace),
                         "application/json");
    return;
  }
  static const std::regex of_a_job("(/jobs/[0-9]{1,12})/.*");
  std::smatch job;
  const std::string back = std::regex_match(request.path, job, of_a_job) ? job[1].str() : "/";
  send_page(response,
            message_page(context_for(state, request, response), "This did not work", sentence, back), status);
}

Service::Service(const ServiceOptions& options) {
  std::string token_sha256;
  if (!is_loopback(options.address)) {
    const ServiceFolder folder(options.folder);
    token_sha256 = folder.token_sha256();
    if (token_sha256.empty() || options.new_token) {
      new_token_ = random_hex(kTokenBytes);
      folder.set_token(new_token_);
      token_sha256 = folder.token_sha256();
    }
  }
  state_ = std::make_unique<ServiceState>(options, token_sha256);
  server_ = std::make_unique<httplib::Server>();
  set_up(*server_, *state_);
  if (options.port == 0)
    port_ = server_->bind_to_any_port(options.address);
  else
    port_ = server_->bind_to_port(options.address, options.port) ? options.port : -1;
  if (port_ <= 0)
    throw Error(
        ErrorCode::usage, fmt::format("{} port {}", options.address, options.port),
        "cannot be used: another program may listen there, or the address is not of this machine; give "
        "another --port or --address");
}

Service::~Service() = default;

bool Service::needs_token() const { return state_->access.needs_token(); }

void Service::run() { server_->listen_after_bind(); }

}  // namespace faultline
