// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cctype>
#include <map>

#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/random.hpp"
#include "lib/model/model_files.hpp"
#include "lib/model/model_text.hpp"
#include "tests/learn/small_robot.hpp"
#include "tests/support/resealed_model.hpp"

namespace faultline {
namespace {

/// Learned once, since that takes seconds.
const std::string& model_text() {
  static const std::string text = model_to_json(learn_small().model);
  return text;
}

std::string refusal(const std::string& text) {
  try {
    model_from_json(text, "robot.model");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::input);
    return error.what();
  }
  return "it was read";
}

/// The first number at every place of the JSON.
void numbers_of(nlohmann::ordered_json& json, const std::string& place,
                std::map<std::string, nlohmann::ordered_json*>& numbers) {
  if (json.is_number()) numbers.emplace(place, &json);
  if (!json.is_structured()) return;
  for (auto& [key, value] : json.items())
    numbers_of(value, place + "/" + (json.is_array() ? "*" : key), numbers);
}

TEST(ModelDamage, AChangedDigitIsRefused) {
  Random random(1);
  for (int i = 0; i < 120; ++i) {
    std::string text = model_text();
    std::size_t at = random.below(text.size());
    while (!std::isdigit(static_cast<unsigned char>(text[at]))) at = random.below(text.size());
    text[at] = static_cast<char>('0' + (text[at] - '0' + 1 + random.below(9)) % 10);
    EXPECT_NE(refusal(text), "it was read") << "byte " << at;
  }
}

TEST(ModelDamage, AFlippedBitIsRefused) {
  Random random(2);
  for (int i = 0; i < 120; ++i) {
    std::string text = model_text();
    const std::size_t at = random.below(text.size());
    text[at] ^= static_cast<char>(1 << random.below(8));
    EXPECT_NE(refusal(text), "it was read") << "byte " << at;
  }
}

TEST(ModelDamage, AModelWithoutItsDigestOrOfAnEarlierSchemaIsRefused) {
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(model_text());
  json.erase("digest");
  EXPECT_NE(refusal(json.dump(1) + "\n").find("model sign"), std::string::npos);
  std::string text = model_text();
  text.replace(text.find("faultline/model/4"), 17, "faultline/model/3");
  EXPECT_NE(refusal(text).find("learn the model again"), std::string::npos) << "an older version";
}

TEST(ModelDamage, AMissingMemberOfAModelIsNamed) {
  for (const char* member :
       {"identity", "identification", "twin", "explain", "motion", "residual", "judges", "confidence"}) {
    nlohmann::ordered_json json = nlohmann::ordered_json::parse(model_text());
    json.erase(member);
    const std::string why = refusal(resealed_model_text(json));
    EXPECT_NE(why.find(member), std::string::npos) << why;
    EXPECT_NE(why.find("learn it again"), std::string::npos) << why;
  }
}

TEST(ModelDamage, EveryNumberHasARangeThatRefusesExtremeValues) {
  nlohmann::ordered_json json =
      nlohmann::ordered_json::parse(resealed_model_text(nlohmann::ordered_json::parse(model_text())));
  std::map<std::string, nlohmann::ordered_json*> numbers;
  numbers_of(json, "", numbers);
  EXPECT_GT(numbers.size(), 80u);
  for (const auto& [place, number] : numbers) {
    EXPECT_TRUE(has_model_range(place)) << place;
    const nlohmann::ordered_json was = *number;
    for (const double wild : {1e308, -1e308}) {
      *number = wild;
      EXPECT_THROW(check_model_ranges(nlohmann::json(json), "robot.model"), Error) << place;
    }
    *number = was;
  }
  EXPECT_NO_THROW(check_model_ranges(nlohmann::json(json), "robot.model"));
}

TEST(ModelDamage, ImpossibleNumbersAreRefusedInModelsWithoutDigest) {
  const auto with = [](const char* place, double number) {
    nlohmann::ordered_json json = nlohmann::ordered_json::parse(model_text());
    json[nlohmann::ordered_json::json_pointer(place)] = number;
    return refusal(resealed_model_text(json));
  };
  nlohmann::ordered_json heavy = nlohmann::ordered_json::parse(model_text());
  std::string robot = heavy["robot"];
  robot.replace(robot.find("mass = ") + 7, 1, "1e300 # ");
  heavy["robot"] = robot;
  EXPECT_NE(refusal(resealed_model_text(heavy)).find("mass of joint 1"), std::string::npos)
      << refusal(resealed_model_text(heavy));
  EXPECT_NE(with("/explain/limits/locked", 1e308).find("/locked is 1e+308"), std::string::npos);
  EXPECT_NE(with("/motion/q_std/0", -1e-5).find("/q_std/"), std::string::npos);
  EXPECT_NE(with("/residual/healthy/velocity_rms/0", -1.0), "it was read");
  EXPECT_NE(with("/motion/q_low/0", 5.0), "it was read") << "above q_high";
  EXPECT_NE(with("/samples/consecutive/g", 1e12), "it was read");
  EXPECT_NE(with("/twin/quintic_share", 3.0), "it was read");
}

TEST(ModelDamage, ASignedEditIsReadAndMarked) {
  std::string text = model_text();
  text.replace(text.find("\"name\": \"slide\""), 15, "\"name\": \"glide\"");
  EXPECT_NE(refusal(text).find("model sign"), std::string::npos);
  const std::string accepted = signed_model_text(text, "another name", "robot.model");
  const Model model = model_from_json(accepted, "robot.model");
  EXPECT_EQ(model.name, "glide");
  EXPECT_EQ(model.identity, model_from_json(model_text(), "robot.model").identity) << "its cases stay bound";
  ASSERT_EQ(notes_of(model).size(), 1u);
  EXPECT_NE(notes_of(model)[0].find("another name"), std::string::npos);
  EXPECT_TRUE(signed_model_text(accepted, "", "robot.model") == accepted) << "nothing left to sign";
  EXPECT_TRUE(model_to_json(model) == accepted);
}

TEST(ModelDamage, ASignatureDoesNotPermitAnExtremeNumber) {
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(model_text());
  json["evidence"]["trigger"] = 1e308;
  EXPECT_NE(refusal(signed_model_text(json.dump(1), "", "robot.model")), "it was read");
}

}  // namespace
}  // namespace faultline
