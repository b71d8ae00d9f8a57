// SPDX-License-Identifier: MIT
#include "apps/service/form.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>

#include "apps/service/http.hpp"
#include "lib/core/error.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

constexpr std::size_t kLongestStoredName = 150;  // bytes
constexpr double kUploadPatience_s = 20.0;       // before a rate counts
constexpr double kLeastBytesPerS = 1000.0;       // of an upload
constexpr const char* kUnreadable = "The form cannot be read; load the page again and repeat.";

/// Value of two hexadecimal digits; -1 if they are none.
int byte_of(const std::string& text, std::size_t at) {
  if (at + 2 > text.size() || !std::isxdigit(static_cast<unsigned char>(text[at])) ||
      !std::isxdigit(static_cast<unsigned char>(text[at + 1])))
    return -1;
  return std::stoi(text.substr(at, 2), nullptr, 16);
}

std::string decoded(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const int byte = text[i] == '%' ? byte_of(text, i + 1) : -1;
    if (byte >= 0) i += 2;
    out += byte >= 0 ? static_cast<char>(byte) : text[i] == '+' ? ' ' : text[i];
  }
  return out;
}

std::map<std::string, std::string> urlencoded_fields(const std::string& body) {
  std::map<std::string, std::string> fields;
  for (std::size_t begin = 0; begin < body.size();) {
    const std::size_t end = std::min(body.find('&', begin), body.size());
    const std::string pair = body.substr(begin, end - begin);
    const std::size_t middle = std::min(pair.find('='), pair.size());
    fields[decoded(pair.substr(0, middle))] = middle < pair.size() ? decoded(pair.substr(middle + 1)) : "";
    begin = end + 1;
  }
  return fields;
}

bool is_kept(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-' || c == '_' || c == ' ' ||
         (static_cast<unsigned char>(c) & 0x80u);
}

}  // namespace

std::string stored_name(const std::string& foreign) {
  std::string name = valid_utf8(foreign.substr(foreign.find_last_of("/\\") + 1));
  name = printable(name);
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !is_kept(c); }, '_');
  if (name.size() > kLongestStoredName) name = valid_utf8(name.substr(name.size() - kLongestStoredName));
  if (name.empty() || name.front() == '.' || name.front() == '-') name.insert(0, "log");
  return name;
}

std::optional<std::int64_t> whole_number(const std::string& text) {
  constexpr std::size_t kMostDigits = 12;
  if (text.empty() || text.size() > kMostDigits || text.find_first_not_of("0123456789") != std::string::npos)
    return {};
  return std::stoll(text);
}

std::string SentForm::field(const std::string& name) const {
  const auto found = fields_.find(name);
  return found == fields_.end() ? "" : found->second;
}

/// Receives the parts of a form one after another.
class FormReader {
 public:
  FormReader(const ServiceFolder& folder, const FormLimits& limits,
             const std::function<bool(const SentForm&)>& allows, SentForm& form)
      : folder_(folder), limits_(limits), allows_(allows), form_(form) {}
  ~FormReader() { close_file(); }

  bool begin_part(const std::string& field, const std::string& file) {
    if (!close_file()) return false;
    field_ = field;
    field_bytes_ += field.size();
    is_file_ = !file.empty();
    return !is_file_ || begin_file(stored_name(file));
  }

  bool add(const char* bytes, std::size_t count) {
    if (!is_fast_enough(count)) return false;
    return is_file_ ? add_to_file(bytes, count) : add_to_field(bytes, count);
  }

  bool add_to_body(const char* bytes, std::size_t count) {
    if (!is_fast_enough(count)) return false;
    body_.append(bytes, count);
    return body_.size() <= limits_.most_field_bytes || refuse(413, "The form is too long.");
  }

  /// What read_form() answers when the library read everything, or stopped.
  FormAnswer end(bool complete) {
    if (!body_.empty()) form_.fields_ = urlencoded_fields(body_);
    if (answer_.status == 200 && complete) close_file();
    if (answer_.status == 200 && !complete)
      answer_ = {400, "The upload was interrupted, and nothing of it was kept; send it again."};
    if (answer_.status == 200 && !allows_(form_)) refuse(403, kUnreadable);
    return answer_;
  }

 private:
  /// A sender that keeps a connection open with a byte now and then would keep others out.
  bool is_fast_enough(std::size_t count) {
    received_ += static_cast<double>(count);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin_;
    return taken.count() < kUploadPatience_s || received_ / taken.count() > kLeastBytesPerS ||
           refuse(408, "The upload was too slow and was ended; nothing of it was kept.");
  }

  bool refuse(int status, const std::string& sentence) {
    if (answer_.status == 200) answer_ = {status, sentence};
    return false;
  }

  bool begin_file(const std::string& name) {
    if (form_.files_.empty() && !allows_(form_)) return refuse(403, kUnreadable);
    if (form_.files_.size() >= limits_.most_files)
      return refuse(
          413, fmt::format("These are more than {} files; send them in several steps.", limits_.most_files));
    if (std::count(form_.files_.begin(), form_.files_.end(), name))
      return refuse(422, fmt::format("Two files have the name {}; rename one of them.", name));
    if (!form_.incoming_) form_.incoming_.emplace(folder_);
    file_ = ::open(form_.incoming_->log(name).c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC,
                   S_IRUSR | S_IWUSR);
    if (file_ < 0) return refuse(507, "The file cannot be stored; the disk of the service may be full.");
    form_.files_.push_back(name);
    return true;
  }

  bool add_to_file(const char* bytes, std::size_t count) {
    stored_ += count;
    if (stored_ > limits_.most_file_bytes)
      return refuse(413, fmt::format("The files are larger than the limit of {} MB of this service.",
                                     limits_.most_file_bytes >> 20));
    while (count > 0) {
      const ssize_t written = ::write(file_, bytes, count);
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) return refuse(507, "The disk of the service is full; nothing was kept.");
      bytes += written;
      count -= static_cast<std::size_t>(written);
    }
    return true;
  }

  bool add_to_field(const char* bytes, std::size_t count) {
    std::string& value = form_.fields_[field_];
    value.append(bytes, count);
    field_bytes_ += count;
    return field_bytes_ <= limits_.most_field_bytes || refuse(413, "The form is too long.");
  }

  /// Returns false if the file did not reach the disk.
  bool close_file() {
    if (file_ < 0) return true;
    const bool is_safe = ::fsync(file_) == 0;
    ::close(file_);
    file_ = -1;
    return is_safe || refuse(507, "The disk of the service is full; nothing was kept.");
  }

  const ServiceFolder& folder_;
  const FormLimits& limits_;
  const std::function<bool(const SentForm&)>& allows_;
  SentForm& form_;
  FormAnswer answer_;
  std::string field_, body_;
  bool is_file_ = false;
  int file_ = -1;
  std::size_t stored_ = 0, field_bytes_ = 0;
  double received_ = 0.0;  // bytes
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

FormAnswer read_form(const httplib::Request& request, const httplib::ContentReader& reader,
                     const ServiceFolder& folder, const FormLimits& limits,
                     const std::function<bool(const SentForm&)>& allows, SentForm& form) {
  FormReader parts(folder, limits, allows, form);
  bool complete = false;
  if (request.is_multipart_form_data())
    complete = reader(
        [&](const httplib::MultipartFormData& part) { return parts.begin_part(part.name, part.filename); },
        [&](const char* bytes, std::size_t count) { return parts.add(bytes, count); });
  else
    complete = reader([&](const char* bytes, std::size_t count) { return parts.add_to_body(bytes, count); });
  return parts.end(complete);
}

}  // namespace faultline
