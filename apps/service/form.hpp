// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/service/incoming.hpp"

namespace httplib {
class ContentReader;
struct Request;
}  // namespace httplib

namespace faultline {

/// What a form of a page sent.
class SentForm {
 public:
  /// Value of a field; empty if it was not sent.
  std::string field(const std::string& name) const;
  /// Names of the files.
  const std::vector<std::string>& files() const { return files_; }
  /// Where the files are, as logs; only if there are files.
  Incoming& incoming() { return *incoming_; }
  const Incoming& incoming() const { return *incoming_; }

 private:
  friend class FormReader;
  std::map<std::string, std::string> fields_;
  std::optional<Incoming> incoming_;
  std::vector<std::string> files_;
};

/// Why a form was refused, as an HTTP status and a sentence for the user; 200: it was read.
struct FormAnswer {
  int status = 200;
  std::string sentence{};
};

struct FormLimits {
  std::size_t most_file_bytes = std::size_t{2} << 30;  ///< of all files together
  std::size_t most_field_bytes = std::size_t{1} << 20;
  std::size_t most_files = 100;
};

/// Reads a form (multipart or urlencoded) into `form`. Fields stand before files, so that `allows`, which
/// looks at the fields before the first file is stored, keeps strangers from filling the disk.
FormAnswer read_form(const httplib::Request& request, const httplib::ContentReader& reader,
                     const ServiceFolder& folder, const FormLimits& limits,
                     const std::function<bool(const SentForm&)>& allows, SentForm& form);

/// The number that a text of one to twelve digits is; nothing for other text.
std::optional<std::int64_t> whole_number(const std::string& text);

/// Returns a name for a file of this foreign name that is safe in a folder and on a command line, with the
/// same ending.
std::string stored_name(const std::string& foreign);

}  // namespace faultline
