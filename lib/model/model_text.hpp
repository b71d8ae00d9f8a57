// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>

/// The frame of a model file: JSON whose last member is the SHA-256 of all bytes before it.
namespace faultline {

inline constexpr int kModelVersion = 4;

/// "faultline/model/4"
std::string model_schema(int version);

/// Returns a model as file text with its digest. `content` has no digest.
std::string sealed_model_text(const nlohmann::ordered_json& content);

/// Throws Error(input) if the text is no JSON, no model, of another schema, or does not fit its digest.
nlohmann::json read_model_text(const std::string& text, const std::string& where);

/// Returns the text with a digest that fits and a note that it was edited and `why`; returns a text with a
/// fitting digest unchanged. Throws Error(input) if it is no JSON or no model; model_from_json() checks the
/// content.
std::string signed_model_text(const std::string& text, const std::string& why, const std::string& where);

}  // namespace faultline
