// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace faultline {

/// SHA-256 over bytes that are added in pieces.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(Sha256&&) noexcept;
  Sha256& operator=(Sha256&&) noexcept;

  void update(std::string_view bytes);
  /// Returns the hexadecimal digest of all bytes so far; more may follow.
  std::string hex() const;

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

std::string sha256_hex(std::string_view bytes);
/// Throws Error(input) if the file cannot be read.
std::string sha256_of_file(const std::string& path);
/// Returns the hash of a log of several files: of their hashes one after another; of one file its own. Throws
/// as sha256_of_file().
std::string sha256_of_files(const std::vector<std::string>& paths);

}  // namespace faultline
