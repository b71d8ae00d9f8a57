// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "apps/service/service_folder.hpp"

namespace httplib {
class ContentReader;
struct Request;
}  // namespace httplib

namespace faultline {

/// What a form of a page sent. Its files lie in an incoming folder of the service, in the subfolder `logs`,
/// until the folder is taken in; else they are removed with the object.
class SentForm {
 public:
  SentForm() = default;
  ~SentForm();
  SentForm(const SentForm&) = delete;
  SentForm& operator=(const SentForm&) = delete;

  /// Value of a field; empty if it was not sent.
  std::string field(const std::string& name) const;
  /// Folder of the files; empty without files. Whoever takes it in calls forget_folder().
  const std::string& folder() const { return folder_; }
  void forget_folder() { folder_.clear(); }
  const std::vector<std::string>& files() const { return files_; }

 private:
  friend class FormReader;
  std::map<std::string, std::string> fields_;
  std::string folder_;
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

/// Returns a name for a file of this foreign name that is safe in a folder and on a command line, with the
/// same ending.
std::string stored_name(const std::string& foreign);

}  // namespace faultline
