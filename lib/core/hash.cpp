// SPDX-License-Identifier: MIT
#include "lib/core/hash.hpp"

#include <openssl/evp.h>

#include <array>
#include <cstdio>
#include <vector>

#include "lib/core/error.hpp"

namespace faultline {

struct Sha256::Context {
  EVP_MD_CTX* evp = EVP_MD_CTX_new();
  ~Context() { EVP_MD_CTX_free(evp); }
};

Sha256::Sha256() : context_(std::make_unique<Context>()) {
  EVP_DigestInit_ex(context_->evp, EVP_sha256(), nullptr);
}
Sha256::~Sha256() = default;
Sha256::Sha256(Sha256&&) noexcept = default;
Sha256& Sha256::operator=(Sha256&&) noexcept = default;

void Sha256::update(std::string_view bytes) { EVP_DigestUpdate(context_->evp, bytes.data(), bytes.size()); }

std::string Sha256::hex() const {
  Context copy;
  EVP_MD_CTX_copy_ex(copy.evp, context_->evp);
  std::array<unsigned char, 32> digest{};
  EVP_DigestFinal_ex(copy.evp, digest.data(), nullptr);
  std::string text;
  for (const unsigned char byte : digest) {
    text += "0123456789abcdef"[byte >> 4];
    text += "0123456789abcdef"[byte & 15];
  }
  return text;
}

std::string sha256_hex(std::string_view bytes) {
  Sha256 hash;
  hash.update(bytes);
  return hash.hex();
}

std::string sha256_of_file(const std::string& path) {
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (!file) throw Error(ErrorCode::input, path, "cannot be opened for reading; check that it exists");
  Sha256 hash;
  std::vector<char> block(1 << 16);
  for (std::size_t got; (got = std::fread(block.data(), 1, block.size(), file)) > 0;)
    hash.update({block.data(), got});
  const bool failed = std::ferror(file) != 0;
  std::fclose(file);
  if (failed)
    throw Error(
        ErrorCode::input, path,
        "cannot be read to its end; check that it is not a directory and that the disk has no errors");
  return hash.hex();
}

std::string sha256_of_files(const std::vector<std::string>& paths) {
  if (paths.size() == 1) return sha256_of_file(paths.front());
  std::string hashes;
  for (const std::string& path : paths) hashes += sha256_of_file(path);
  return sha256_hex(hashes);
}

}  // namespace faultline
