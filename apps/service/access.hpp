// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <deque>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace faultline {

/// Who may use the service. A browser has a session, a cookie that the service signed; with a token, only
/// whoever knows it gets one. Each form holds a key made of the session, so that a foreign page cannot send
/// it.
class Access {
 public:
  /// `hosts` are names under which the service is reached, besides localhost and addresses; `token_sha256` is
  /// empty if no token is needed.
  Access(std::string secret, std::string token_sha256, std::vector<std::string> hosts);

  /// Whether a Host header names this service and not a foreign name that resolves to it. Addresses are no
  /// names, so they pass.
  bool is_own_host(const std::string& host) const;
  /// Whether an Origin header, which browsers send with forms, is that of the host; an empty one is.
  bool is_own_origin(const std::string& origin, const std::string& host) const;

  bool needs_token() const { return !token_sha256_.empty(); }
  bool is_token(const std::string& token) const;

  /// Name of the cookie of this folder's service: browsers send one machine the cookies of all its ports.
  std::string cookie_name() const;
  std::string new_session() const;
  bool is_session(const std::string& session) const;
  /// From now on the session is none, for whoever has a copy of its cookie. Safe to call from several
  /// threads.
  void end_session(const std::string& session);
  std::string form_key(const std::string& session) const;
  bool is_form_key(const std::string& session, const std::string& key) const;

 private:
  std::string signature(const std::string& text) const;

  std::string secret_, token_sha256_;
  std::vector<std::string> hosts_;
  mutable std::mutex mutex_;
  std::set<std::string> ended_;  ///< sessions
};

/// Limits how often an address may do something. Safe to call from several threads.
class RateLimit {
 public:
  RateLimit(int most, double within_s) : most_(most), within_s_(within_s) {}
  /// Counts one more and returns whether it is within the limit.
  bool allows(const std::string& address);

 private:
  using Clock = std::chrono::steady_clock;
  int most_;
  double within_s_;
  std::mutex mutex_;
  std::map<std::string, std::deque<Clock::time_point>> times_;
};

/// Value of a cookie in a Cookie header; empty if it is not there.
std::string cookie_value(const std::string& header, const std::string& name);

}  // namespace faultline
