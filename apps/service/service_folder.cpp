// SPDX-License-Identifier: MIT
#include "apps/service/service_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "lib/cases/case_file.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/files/inner_file.hpp"
#include "lib/core/files/temporary_file.hpp"
#include "lib/core/hash.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kSecretBytes = 32;
constexpr mode_t kOwnerOnly = 0700;      // of folders
constexpr mode_t kOwnerOnlyFile = 0600;  // of files

void create_private_folder(const std::string& path) {
  if (::mkdir(path.c_str(), kOwnerOnly) != 0 && errno != EEXIST) fail_to_write(path, "created");
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0) fail_to_write(path, "read");
  if (!S_ISDIR(status.st_mode))
    throw Error(ErrorCode::input, path, "is not a folder; faultline serve keeps its uploads there");
  if (::chmod(path.c_str(), kOwnerOnly) != 0) fail_to_write(path, "protected");
}

/// Makes the names in a folder survive a loss of power.
void sync_folder(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) fail_to_write(path, "read");
  const bool done = ::fsync(descriptor) == 0;
  ::close(descriptor);
  if (!done) fail_to_write(path, "written");
}

int lock_of(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kOwnerOnlyFile);
  if (descriptor < 0) fail_to_write(path, "created");
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
  ::close(descriptor);
  throw Error(
      ErrorCode::input, path,
      "is locked: another faultline serve works on this folder; stop it first, or give another folder");
}

void write_private_file(const std::string& path, const std::string& text) {
  write_file(path, text);
  if (::chmod(path.c_str(), kOwnerOnlyFile) != 0) fail_to_write(path, "protected");
}

std::string kept_secret(const std::string& path) {
  if (!fs::exists(path)) write_private_file(path, random_hex(kSecretBytes) + "\n");
  const std::string secret = read_file(path);
  if (secret.size() != 2 * kSecretBytes + 1)
    throw Error(
        ErrorCode::input, path,
        "is damaged; delete it: the service makes a new one, and pages that are open have to be loaded again");
  return secret.substr(0, 2 * kSecretBytes);
}

/// The number of the last job that was removed, so that no number is used twice; 0 if there is none.
std::int64_t kept_number(const std::string& path) {
  if (!fs::exists(path)) return 0;
  const std::string text = read_file(path);
  std::int64_t number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

/// Throws Error(usage) if a file of that name is there with other bytes.
void refuse_other_file(const std::string& from, const std::string& to, const std::string& name) {
  if (fs::exists(to) && sha256_of_file(from) != sha256_of_file(to))
    throw Error(ErrorCode::usage, name, "exists already; choose another name");
}

/// Moves a file to a name that no other file has; the same bytes there are those of an earlier, interrupted
/// call.
void move_new(const std::string& from, const std::string& to, const std::string& name) {
  if (::link(from.c_str(), to.c_str()) != 0) {
    if (errno != EEXIST) fail_to_write(to, "created");
    refuse_other_file(from, to, name);
  }
  fs::remove(from);
}

bool is_file(const std::string& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

}  // namespace

std::string random_hex(std::size_t bytes) {
  std::string text;
  for (std::size_t i = 0; i < bytes; ++i) {
    unsigned char byte = 0;
    if (::getrandom(&byte, 1, 0) != 1)
      throw Error(ErrorCode::internal, "random numbers", "cannot be read from the system");
    text += fmt::format("{:02x}", byte);
  }
  return text;
}

ServiceFolder::ServiceFolder(std::string folder) : folder_(std::move(folder)) {
  std::error_code error;
  const std::string given = folder_;
  folder_ = fs::canonical(given, error).string();
  if (error || !fs::is_directory(folder_))
    throw Error(ErrorCode::input, given,
                "is not a folder; make it, or give the folder that holds the models");
  state_ = folder_ + "/serve";
  create_private_folder(state_);
  lock_ = lock_of(state_ + "/lock");
  create_private_folder(jobs_path());
  fs::remove_all(state_ + "/incoming", error);
  create_private_folder(state_ + "/incoming");
  secret_ = kept_secret(state_ + "/secret");
}

ServiceFolder::~ServiceFolder() {
  if (lock_ >= 0) ::close(lock_);
}

std::vector<std::string> ServiceFolder::models() const {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator at(folder_, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (has_model(name)) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> ServiceFolder::models_without_cases() const {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator at(folder_, error), end; !error && at != end; at.increment(error)) {
    const std::string ending = at->path().extension().string(), path = at->path().string();
    if ((ending == ".model" || ending == ".json") && is_file(path) && !is_file(case_base_path(path)))
      names.push_back(at->path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

bool ServiceFolder::is_free_name(const std::string& name) const {
  const std::string path = folder_ + "/" + name;
  return !fs::exists(path) && !fs::exists(case_base_path(path));
}

bool ServiceFolder::has_model(const std::string& name) const {
  const std::string path = folder_ + "/" + name;
  return is_plain_name(name) && is_file(path) && is_file(case_base_path(path));
}

std::string ServiceFolder::model_path(const std::string& name) const {
  if (!has_model(name)) throw Error(ErrorCode::usage, name, "is no model of this service");
  return folder_ + "/" + name;
}

void ServiceFolder::publish_model(const std::string& learned, const std::string& name) const {
  const std::string path = folder_ + "/" + name;
  refuse_other_file(learned, path, name);
  refuse_other_file(case_base_path(learned), case_base_path(path), name);
  // The model last: a case base alone is no model of the service.
  move_new(case_base_path(learned), case_base_path(path), name);
  move_new(learned, path, name);
  sync_folder(folder_);
}

std::string ServiceFolder::job_path(std::int64_t id) const {
  return fmt::format("{}/{:06}", jobs_path(), id);
}

std::vector<std::int64_t> ServiceFolder::job_ids() const {
  std::vector<std::int64_t> ids;
  std::error_code error;
  for (fs::directory_iterator at(jobs_path(), error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    std::int64_t id = 0;
    const auto [stop, problem] = std::from_chars(name.data(), name.data() + name.size(), id);
    if (problem == std::errc() && stop == name.data() + name.size() && id > 0) ids.push_back(id);
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

std::int64_t ServiceFolder::last_used_id() const {
  const std::vector<std::int64_t> ids = job_ids();
  return std::max(ids.empty() ? 0 : ids.back(), kept_number(state_ + "/last_removed"));
}

void ServiceFolder::remove_job(std::int64_t id) const {
  if (id > kept_number(state_ + "/last_removed"))
    write_private_file(state_ + "/last_removed", std::to_string(id) + "\n");
  // Renamed first, so that a kill in between leaves no half job.
  const std::string doomed = new_incoming() + "/removed";
  fs::rename(job_path(id), doomed);
  sync_folder(jobs_path());
  fs::remove_all(fs::path(doomed).parent_path());
}

std::string ServiceFolder::new_incoming() const {
  std::string path = state_ + "/incoming/XXXXXX";
  if (!::mkdtemp(path.data())) fail_to_write(path, "created");
  return path;
}

void ServiceFolder::take_in(const std::string& incoming, std::int64_t id) const {
  sync_folder(incoming);
  const std::string path = job_path(id);
  if (::rename(incoming.c_str(), path.c_str()) != 0) fail_to_write(path, "created");
  sync_folder(jobs_path());
}

std::string ServiceFolder::token_sha256() const {
  const std::string path = state_ + "/token.sha256";
  if (!fs::exists(path)) return "";
  std::string text = read_file(path);
  text.resize(std::min(text.size(), text.find('\n')));
  return text;
}

void ServiceFolder::set_token(const std::string& token) const {
  write_private_file(state_ + "/token.sha256", sha256_hex(token) + "\n");
}

std::vector<std::string> ServiceFolder::ended_sessions() const {
  std::vector<std::string> sessions;
  std::ifstream lines(state_ + "/ended_sessions");
  for (std::string line; std::getline(lines, line);) sessions.push_back(line);
  return sessions;
}

void ServiceFolder::add_ended_session(const std::string& session) const {
  std::string text;
  for (const std::string& one : ended_sessions()) text += one + "\n";
  write_private_file(state_ + "/ended_sessions", text + session + "\n");
}

}  // namespace faultline
