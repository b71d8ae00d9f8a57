// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace faultline {

/// The folder that faultline serve works on. It holds the models as faultline learn writes them: each model
/// has its case base beside it. The subfolder `serve`, with mode 0700, holds what users uploaded and what the
/// service made of it; a lock allows one service a folder.
///
/// No path comes from outside: a caller selects among the names and numbers that are there.
class ServiceFolder {
 public:
  /// Throws Error(input) if `folder` is missing, is no folder, or another service works on it; Error(output)
  /// if `serve` cannot be created. Removes uploads that a killed service left incomplete.
  explicit ServiceFolder(std::string folder);
  ~ServiceFolder();
  ServiceFolder(const ServiceFolder&) = delete;
  ServiceFolder& operator=(const ServiceFolder&) = delete;

  /// Names of the models, sorted.
  std::vector<std::string> models() const;
  bool has_model(const std::string& name) const;
  /// Names of files that look like models but have no case base beside them, sorted.
  std::vector<std::string> models_without_cases() const;
  /// Whether a new model can have this name.
  bool is_free_name(const std::string& name) const;
  /// Path of a model of models(). Throws Error(usage) for another name.
  std::string model_path(const std::string& name) const;
  /// Moves a learned model and its case base into the folder. Throws Error(usage) if another file of that
  /// name is there.
  void publish_model(const std::string& learned, const std::string& name) const;

  std::string jobs_path() const { return state_ + "/jobs"; }
  std::string job_path(std::int64_t id) const;
  /// The largest number that a job has or had.
  std::int64_t last_used_id() const;
  /// Numbers of all jobs, sorted.
  std::vector<std::int64_t> job_ids() const;
  /// Removes the folder of a job completely.
  void remove_job(std::int64_t id) const;

  /// Creates a folder for an upload that is not yet complete, and returns its path.
  std::string new_incoming() const;
  /// Turns a complete upload into the job: afterwards it survives a loss of power. Throws Error(output).
  void take_in(const std::string& incoming, std::int64_t id) const;

  /// A secret of 32 random bytes that stays the same over restarts.
  const std::string& secret() const { return secret_; }
  /// SHA-256 of the token that opens the service from other machines; empty before set_token().
  std::string token_sha256() const;
  void set_token(const std::string& token) const;
  /// Sessions that users have ended; they stay ended over restarts.
  std::vector<std::string> ended_sessions() const;
  /// Throws Error(output).
  void add_ended_session(const std::string& session) const;

 private:
  std::string folder_, state_, secret_;
  int lock_ = -1;
};

/// Random bytes of the system as hexadecimal digits, two a byte. Throws Error(internal).
std::string random_hex(std::size_t bytes);

}  // namespace faultline
