// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>

/// The frame of a model file: JSON whose last member is the SHA-256 of all that stands before it, byte by
/// byte.
namespace faultline {

inline constexpr int kModelVersion = 4;

/// "faultline/model/4"
std::string model_schema(int version);

/// A model as file text. `content` has no digest.
std::string sealed_model_text(const nlohmann::ordered_json& content);

/// Throws Error(input) when the text is no JSON, no model, of another schema version, or not what its digest
/// was made of.
nlohmann::json read_model_text(const std::string& text, const std::string& where);

/// The same text with a digest that fits, and with a note in it that it was edited and `why`; the same text
/// where the digest fits as it is. Throws Error(input) when it is no JSON or no model; whether the content
/// can be read is to be asked of model_from_json().
std::string signed_model_text(const std::string& text, const std::string& why, const std::string& where);

}  // namespace faultline
