// SPDX-License-Identifier: MIT
// What strangers and foreign pages cannot do.
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <regex>

#include "apps/service/access.hpp"
#include "apps/service/form.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/hash.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/served_folder.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

/// A connection whose request never ends.
class SlowConnection {
 public:
  explicit SlowConnection(int port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
      throw std::runtime_error("no connection");
    constexpr std::string_view kBegin = "GET / HTTP/1.1\r\nHost: localhost\r\nX: ";
    if (::send(socket_, kBegin.data(), kBegin.size(), 0) < 0) throw std::runtime_error("nothing sent");
  }
  SlowConnection(SlowConnection&& other) noexcept : socket_(other.socket_) { other.socket_ = -1; }
  SlowConnection& operator=(SlowConnection&&) = delete;
  ~SlowConnection() {
    if (socket_ >= 0) ::close(socket_);
  }

 private:
  int socket_;
};

bool is_empty_folder(const std::string& path) { return fs::is_empty(path); }

TEST(ServiceAccess, AFormWithoutTheKeyOfItsSessionIsRefusedAndNothingIsKept) {
  const ServedFolder service;
  Visitor visitor(service), stranger(service);
  const std::string foreign_key = stranger.key();
  const SentFile log = sample_log("bench/locked_1.csv");
  for (const std::string& key : {std::string("0"), foreign_key}) {
    visitor.key();
    const ServiceAnswer answer =
        visitor.post("/jobs", {{"key", key}, {"kind", "diagnose"}, {"model", "bench.model"}}, {log});
    EXPECT_EQ(answer.status, 403);
  }
  EXPECT_TRUE(is_empty_folder(service.file("serve/incoming")));
  EXPECT_TRUE(is_empty_folder(service.file("serve/jobs")));
}

TEST(ServiceAccess, ForeignHostsAndOriginsAreRefused) {
  const ServedFolder service;
  Visitor visitor(service);
  EXPECT_EQ(visitor.get("/", {{"Host", "evil.example"}}).status, 421);
  EXPECT_EQ(visitor.get("/", {{"Host", "localhost:80"}}).status, 200);
  const ServiceAnswer answer = visitor.post("/jobs", {{"key", visitor.key()}, {"kind", "compare"}}, {},
                                            {{"Origin", "http://evil.example"}});
  EXPECT_EQ(answer.status, 403);
}

TEST(ServiceAccess, FortySlowConnectionsLeavePagesToOthers) {
  const ServedFolder service;
  std::vector<SlowConnection> slow;
  for (int i = 0; i < 40; ++i) slow.emplace_back(service.port());
  Visitor visitor(service);
  EXPECT_EQ(visitor.get("/").status, 200);
}

TEST(ServiceAccess, ADamagedSecretIsRefused) {
  ServedFolder service;
  service.end(SIGKILL);
  write_file(service.file("serve/secret"), "");
  const ProgramRun run = run_program({"serve", service.file(""), "--port", "0"});
  EXPECT_EQ(run.status, 3);
  EXPECT_NE(run.err.find("is damaged; delete it"), std::string::npos) << run.err;
}

TEST(ServiceForms, OnlyDigitsAreAWholeNumber) {
  EXPECT_EQ(whole_number("0042"), 42);
  EXPECT_EQ(whole_number("999999999999"), 999999999999);
  for (const char* text : {"", "-1", "+1", "1.0", " 1", "1e3", "0x1", "1000000000000"})
    EXPECT_EQ(whole_number(text), std::nullopt) << text;
}

TEST(ServiceAccess, NoAddressLeadsToAnotherFile) {
  const ServedFolder service;
  Visitor visitor(service);
  visitor.result_of(visitor.diagnose("bench/locked_1.csv"));
  for (const char* path :
       {"/jobs/1/..%2f..%2fsecret", "/jobs/1/../../secret", "/serve/secret", "/robots/..%2fserve%2fsecret",
        "/robots/bench.model.cases.db", "/jobs/1/logs", "/jobs/1/request.json", "/jobs/01/learned.model",
        "/jobs/999999999999", "/jobs/1/%00", "/robots/%2e%2e"}) {
    const int status = visitor.get(path).status;
    EXPECT_TRUE(status == 404 || status == 400) << path << ": " << status;
  }
}

TEST(ServiceAccess, UploadsLieInAFolderOfTheOwnerAlone) {
  const ServedFolder service;
  struct stat status {};
  ASSERT_EQ(::stat(service.file("serve").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0700u);
  ASSERT_EQ(::stat(service.file("serve/secret").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600u);
}

TEST(ServiceAccess, AnUploadBeyondTheLimitIsRefusedAndNotKept) {
  const ServedFolder service({"--most-mb", "1"});
  Visitor visitor(service);
  const ServiceAnswer answer =
      visitor.post("/jobs", {{"key", visitor.key()}, {"kind", "diagnose"}, {"model", "bench.model"}},
                   {{"big.csv", std::string(std::size_t{3} << 20, '1')}});
  EXPECT_EQ(answer.status, 413);
  EXPECT_TRUE(is_empty_folder(service.file("serve/jobs")));
  EXPECT_TRUE(is_empty_folder(service.file("serve/incoming")));
}

TEST(ServiceAccess, AHostileFileNameIsInert) {
  EXPECT_EQ(stored_name("../../etc/passwd"), "passwd");
  EXPECT_EQ(stored_name("C:\\logs\\run 1.csv"), "run 1.csv");
  EXPECT_EQ(stored_name("-rf"), "log-rf");
  EXPECT_EQ(stored_name(".."), "log..");
  EXPECT_EQ(stored_name("a\x1b[2J<b>.csv"), "a__2J_b_.csv");
  EXPECT_EQ(stored_name(""), "log");
  EXPECT_TRUE(stored_name(std::string(500, 'a') + ".csv").ends_with("a.csv"));
  const ServedFolder service;
  Visitor visitor(service);
  SentFile log = sample_log("bench/locked_1.csv");
  log.name = "<script>alert(1)</script>.csv";
  const ServiceAnswer sent =
      visitor.post("/jobs", {{"key", visitor.key()}, {"kind", "diagnose"}, {"model", "bench.model"}}, {log});
  ASSERT_EQ(sent.status, 303);
  visitor.result_of(sent.location);
  EXPECT_EQ(visitor.get("/").body.find("<script>alert"), std::string::npos);
}

TEST(ServiceAccess, OtherMachinesNeedTheToken) {
  ServedFolder service({"--address", "0.0.0.0"});
  const std::string messages = service.messages();
  std::smatch found;
  ASSERT_TRUE(std::regex_search(messages, found, std::regex("shown only now: ([0-9a-f]{32})"))) << messages;
  const std::string token = found[1];
  Visitor visitor(service);
  EXPECT_EQ(visitor.get("/").status, 303);
  EXPECT_EQ(visitor.get("/jobs/1/report.json").status, 303);
  EXPECT_EQ(visitor.post("/jobs", {{"key", "0"}, {"kind", "compare"}}).status, 401);
  EXPECT_EQ(visitor.post("/login", {{"key", ""}, {"token", "wrong"}}).status, 403);
  const ServiceAnswer in = visitor.post("/login", {{"key", ""}, {"token", token}});
  ASSERT_EQ(in.status, 303);
  const std::string set = in.set_cookie;
  EXPECT_TRUE(set.find("HttpOnly") != std::string::npos && set.find("SameSite=Strict") != std::string::npos)
      << set;
  visitor.cookie = set.substr(0, set.find(';'));
  EXPECT_EQ(visitor.get("/").status, 200);
  EXPECT_EQ(visitor.diagnose("bench/locked_1.csv"), "/jobs/1");
  service.end(SIGTERM);
  service.start();
  EXPECT_EQ(service.messages().find(token), std::string::npos) << "the token is shown once";
  EXPECT_EQ(visitor.get("/").status, 200) << "a session outlives the service";
  EXPECT_EQ(visitor.post("/logout", {{"key", visitor.key()}}).status, 303);
  for (int start = 0; start < 2; ++start) {
    visitor.cookie = set.substr(0, set.find(';'));
    EXPECT_EQ(visitor.get("/").status, 303) << "a copy of the cookie of a session that ended";
    service.end(SIGTERM);
    service.start();
  }
}

TEST(ServiceAccess, GuessingTheTokenIsSlowedDown) {
  const ServedFolder service({"--address", "0.0.0.0"});
  Visitor visitor(service);
  int refused = 0;
  for (int i = 0; i < 12; ++i)
    refused += visitor.post("/login", {{"key", ""}, {"token", "wrong"}}).status == 429;
  EXPECT_EQ(refused, 2);
}

TEST(ServiceAccess, ANewTokenEndsAllSessions) {
  const Access before("secret", sha256_hex("one"), {}), after("secret", sha256_hex("two"), {});
  const std::string session = before.new_session();
  EXPECT_TRUE(before.is_session(session));
  EXPECT_FALSE(after.is_session(session));
  EXPECT_FALSE(before.is_session(session + "0"));
  EXPECT_FALSE(before.is_session(""));
  EXPECT_TRUE(before.is_form_key(session, before.form_key(session)));
  EXPECT_FALSE(before.is_form_key(before.new_session(), before.form_key(session)));
}

TEST(ServiceAccess, OnlyNamesOfTheServiceAreHosts) {
  const Access access("secret", "", {"cell.example"});
  for (const char* host : {"localhost", "127.0.0.1:8080", "[::1]:8080", "192.168.0.7", "Cell.Example:80"})
    EXPECT_TRUE(access.is_own_host(host)) << host;
  for (const char* host : {"", "evil.example", "127.0.0.1.evil.example", "localhost.evil.example", "[::1",
                           "[::1].evil.example", "127.0.0.1:80@evil.example", "127.0.0.1:abc", "999.1.1.1"})
    EXPECT_FALSE(access.is_own_host(host)) << host;
}

TEST(ServiceAccess, ARateLimitCountsEachAddress) {
  RateLimit limit(2, 60.0);
  EXPECT_TRUE(limit.allows("a") && limit.allows("a"));
  EXPECT_FALSE(limit.allows("a"));
  EXPECT_TRUE(limit.allows("b"));
}

}  // namespace
}  // namespace faultline
