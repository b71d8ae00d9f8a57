// SPDX-License-Identifier: MIT
#include "apps/service/access.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>

#include <algorithm>
#include <array>
#include <regex>

#include "apps/service/service_folder.hpp"
#include "lib/core/hash.hpp"

namespace faultline {
namespace {

constexpr std::size_t kSessionBytes = 16;      // of a random session
constexpr std::size_t kMostAddresses = 10000;  // that a rate limit remembers

/// In a time that does not depend on where they differ.
bool are_equal(const std::string& a, const std::string& b) {
  return a.size() == b.size() && CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// The host without its port, in small letters; empty if it is not of that form.
std::string name_of(const std::string& host) {
  static const std::regex form(R"((\[[0-9a-f:.]+\]|[a-z0-9_.-]+)(:[0-9]{1,5})?)");
  const std::string small = lower(host);
  std::smatch parts;
  return std::regex_match(small, parts, form) ? parts[1].str() : "";
}

bool is_address(const std::string& name) {
  std::array<unsigned char, sizeof(in6_addr)> bytes;
  if (name.starts_with("["))
    return ::inet_pton(AF_INET6, name.substr(1, name.size() - 2).c_str(), bytes.data()) == 1;
  return ::inet_pton(AF_INET, name.c_str(), bytes.data()) == 1;
}

}  // namespace

Access::Access(std::string secret, std::string token_sha256, std::vector<std::string> hosts)
    : secret_(std::move(secret)), token_sha256_(std::move(token_sha256)) {
  for (const std::string& host : hosts) hosts_.push_back(lower(host));
}

bool Access::is_own_host(const std::string& host) const {
  const std::string name = name_of(host);
  return name == "localhost" || is_address(name) || std::count(hosts_.begin(), hosts_.end(), name) > 0;
}

bool Access::is_own_origin(const std::string& origin, const std::string& host) const {
  return origin.empty() || origin == "http://" + host || origin == "https://" + host;
}

bool Access::is_token(const std::string& token) const { return are_equal(sha256_hex(token), token_sha256_); }

std::string Access::signature(const std::string& text) const {
  std::array<unsigned char, EVP_MAX_MD_SIZE> bytes;
  unsigned int size = 0;
  HMAC(EVP_sha256(), secret_.data(), static_cast<int>(secret_.size()),
       reinterpret_cast<const unsigned char*>(text.data()), text.size(), bytes.data(), &size);
  std::string hex;
  constexpr const char* kDigits = "0123456789abcdef";
  for (unsigned int i = 0; i < size; ++i) {
    hex += kDigits[bytes[i] >> 4u];
    hex += kDigits[bytes[i] & 15u];
  }
  return hex;
}

std::string Access::cookie_name() const {
  constexpr std::size_t kDigits = 8;
  return "faultline_" + signature("cookie").substr(0, kDigits);
}

// The token is part of what is signed: a new token ends all sessions.
std::string Access::new_session() const {
  const std::string random = random_hex(kSessionBytes);
  return random + "." + signature("session " + token_sha256_ + " " + random);
}

bool Access::is_session(const std::string& session) const {
  const std::size_t middle = session.find('.');
  if (middle != 2 * kSessionBytes) return false;
  const std::lock_guard lock(mutex_);
  return !ended_.count(session) &&
         are_equal(session.substr(middle + 1),
                   signature("session " + token_sha256_ + " " + session.substr(0, middle)));
}

void Access::end_session(const std::string& session) {
  const std::lock_guard lock(mutex_);
  ended_.insert(session);
}

std::string Access::form_key(const std::string& session) const { return signature("form " + session); }

bool Access::is_form_key(const std::string& session, const std::string& key) const {
  return is_session(session) && are_equal(key, form_key(session));
}

bool RateLimit::allows(const std::string& address) {
  const auto now = Clock::now();
  const std::lock_guard lock(mutex_);
  if (times_.size() > kMostAddresses) times_.clear();
  std::deque<Clock::time_point>& times = times_[address];
  while (!times.empty() && std::chrono::duration<double>(now - times.front()).count() > within_s_)
    times.pop_front();
  if (static_cast<int>(times.size()) >= most_) return false;
  times.push_back(now);
  return true;
}

std::string cookie_value(const std::string& header, const std::string& name) {
  for (std::size_t begin = 0; begin < header.size();) {
    const std::size_t end = std::min(header.find(';', begin), header.size());
    std::string pair = header.substr(begin, end - begin);
    pair.erase(0, pair.find_first_not_of(' '));
    if (pair.starts_with(name + "=")) return pair.substr(name.size() + 1);
    begin = end + 1;
  }
  return "";
}

}  // namespace faultline
