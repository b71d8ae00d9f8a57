// SPDX-License-Identifier: MIT
#include "lib/core/json/json_fields.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "lib/core/error.hpp"

namespace faultline {
namespace {

enum class Colour { red, green };

const char* to_string(Colour colour) { return colour == Colour::red ? "red" : "green"; }

Colour colour_from(const std::string& name, const std::string& where) {
  if (name == "red") return Colour::red;
  if (name == "green") return Colour::green;
  throw Error(ErrorCode::input, where, "\"" + name + "\" is no colour");
}

struct Part {
  int joint = 0;
  double size = 1.0;
};

void fields(auto& v, MaybeConst<Part> auto& part) {
  v.from_one("joint", part.joint);
  v("size", part.size);
}

struct Thing {
  Colour colour = Colour::red;
  bool flag = false;
  double number = 1.0, onset_s = std::nan("");
  std::string name, note, why;
  std::vector<double> values;
  std::array<double, 2> interval{};
  std::vector<Part> parts;
  std::optional<Part> spare;
};

void fields(auto& v, MaybeConst<Thing> auto& thing) {
  v.named("colour", thing.colour, colour_from);
  v("flag", thing.flag);
  v("number", thing.number);
  v.unless_empty("onset_s", thing.onset_s);
  v("name", thing.name);
  v.unless_empty("note", thing.note);
  v.or_null("why", thing.why);
  v("values", thing.values);
  v("interval", thing.interval);
  v.object("below", [&](auto& below) { below("parts", thing.parts); });
  v("spare", thing.spare);
}

struct Matrices {
  Eigen::VectorXd vector;
  Eigen::VectorXi counts;
  Eigen::MatrixXd matrix;
  double scale = 0.0;
};

void fields(auto& v, MaybeConst<Matrices> auto& m) {
  v("vector", m.vector);
  v("counts", m.counts);
  v("matrix", m.matrix);
  v("scale", m.scale);
}

using Json = nlohmann::ordered_json;

/// All but onset_s, note, why and spare, which are empty.
Thing thing() {
  Thing out;
  out.colour = Colour::green;
  out.number = 0.1;
  out.name = "a";
  out.values = {1.5, std::nan("")};
  out.interval = {2.0, 3.0};
  out.parts = {{0, 0.5}, {1, std::nan("")}};
  return out;
}

TEST(JsonFields, AreWrittenInTheirOrder) {
  EXPECT_EQ(fields_to_json<Json>(thing()).dump(),
            "{\"colour\":\"green\",\"flag\":false,\"number\":0.1,\"name\":\"a\",\"why\":null,"
            "\"values\":[1.5,null],\"interval\":[2.0,3.0],"
            "\"below\":{\"parts\":[{\"joint\":1,\"size\":0.5},{\"joint\":2,\"size\":null}]},\"spare\":null}");
}

TEST(JsonFields, AreReadBackUnchanged) {
  Thing whole = thing();
  whole.onset_s = 0.0;
  whole.note = "n";
  whole.why = "w";
  whole.spare = Part{2, 4.0};
  for (const Thing& written : {thing(), whole}) {
    const Json json = fields_to_json<Json>(written);
    const Thing read = fields_from_json<Thing>(json, "file");
    EXPECT_EQ(fields_to_json<Json>(read).dump(), json.dump());
    EXPECT_EQ(read.parts[1].joint, 1);
    EXPECT_TRUE(std::isnan(read.parts[1].size)) << "null";
    EXPECT_EQ(read.spare.has_value(), written.spare.has_value());
  }
}

TEST(JsonFields, AMissingMemberIsRefusedByItsKey) {
  const Json whole = fields_to_json<Json>(thing());
  for (const char* key :
       {"colour", "flag", "number", "name", "why", "values", "interval", "below", "spare"}) {
    Json json = whole;
    json.erase(key);
    try {
      fields_from_json<Thing>(json, "file");
      ADD_FAILURE() << "it was read without " << key;
    } catch (const nlohmann::json::exception& error) {
      EXPECT_NE(std::string(error.what()).find(key), std::string::npos) << error.what();
    }
  }
}

TEST(JsonFields, AWrongTypeOrNameIsRefused) {
  const auto with = [](const char* key, const Json& value) {
    Json json = fields_to_json<Json>(thing());
    json[key] = value;
    return fields_from_json<Thing>(json, "file");
  };
  EXPECT_THROW(with("colour", "blue"), Error);
  EXPECT_THROW(with("number", "1"), nlohmann::json::exception);
  EXPECT_THROW(with("values", nullptr), nlohmann::json::exception) << "null is no list";
  EXPECT_THROW(with("interval", Json::array({1.0})), nlohmann::json::exception);
}

TEST(JsonFields, NullInAMatrixOrInPlaceOfAFiniteNumberIsRefused) {
  Matrices m{Eigen::VectorXd::LinSpaced(3, 0.0, 0.3), Eigen::VectorXi::LinSpaced(3, 1, 3),
             Eigen::MatrixXd::Identity(2, 3), 0.1};
  const auto json = fields_to_json<nlohmann::json>(m);
  const auto read = fields_from_json<Matrices, true>(json, "file");
  EXPECT_EQ(read.vector, m.vector);
  EXPECT_EQ(read.counts, m.counts);
  EXPECT_EQ(read.matrix, m.matrix);
  for (const char* place : {"/vector/1", "/matrix/0/2", "/scale"}) {
    nlohmann::json bad = json;
    bad[nlohmann::json::json_pointer(place)] = nullptr;
    EXPECT_THROW((fields_from_json<Matrices, true>(bad, "file")), Error) << place;
  }
}

}  // namespace
}  // namespace faultline
