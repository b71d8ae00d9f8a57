// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <concepts>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "lib/core/joint.hpp"
#include "lib/core/json/json_matrix.hpp"
#include "lib/core/json_values.hpp"
#include "lib/core/text.hpp"

/// Structs as JSON, both ways from one description of their members, so that each key stands once. The
/// description of a struct is a function in the namespace of the struct:
///
///   void fields(auto& v, MaybeConst<Thing> auto& thing) {
///     v("key", thing.member);
///   }
///
/// fields_to_json() writes the members in this order, fields_from_json() reads them. A member can be a bool,
/// a number, a text, a Joint (its number), a std::vector, a std::array, a std::optional (null if empty), an
/// Eigen vector or matrix, a struct with a description, or JSON itself. A struct has one description in the
/// whole program.
namespace faultline {

template <typename T, typename Thing>
concept MaybeConst = std::same_as<std::remove_const_t<T>, Thing>;

/// Returns the part of `thing` that its base class has, for the description of the base class.
template <typename Base, typename Thing>
auto& base_part(Thing& thing) {
  return static_cast<std::conditional_t<std::is_const_v<Thing>, const Base, Base>&>(thing);
}

template <typename T>
inline constexpr bool kIsOptional = false;
template <typename T>
inline constexpr bool kIsOptional<std::optional<T>> = true;

template <typename T>
concept EigenValues = requires {
  typename T::Scalar;
};
template <typename T>
concept EigenVector = EigenValues<T> && std::same_as<typename T::Scalar, double> && T::ColsAtCompileTime == 1;
template <typename T>
concept EigenMatrix = EigenValues<T> && std::same_as<typename T::Scalar, double> && !EigenVector<T>;

/// Writes the members of a struct into an object; `Json` is either kind of nlohmann::json.
template <typename Json>
class FieldWriter {
 public:
  const Json& json() const { return json_; }

  /// A number that is not finite is null.
  template <typename T>
  void operator()(const char* key, const T& value) {
    json_[key] = value_of(value);
  }
  /// A member that must not be null.
  template <typename T>
  void finite(const char* key, const T& value) {
    (*this)(key, value);
  }
  /// A member that is left out if it is an empty text or list, false, the whole number 0, or NaN.
  template <typename T>
  void unless_empty(const char* key, const T& value) {
    bool empty = false;
    if constexpr (std::is_same_v<T, double>)
      empty = std::isnan(value);
    else if constexpr (std::is_arithmetic_v<T>)
      empty = value == T{};
    else
      empty = value.empty();
    if (!empty) (*this)(key, value);
  }
  /// Null for an empty text, or for a count below 1.
  void or_null(const char* key, const std::string& text) { json_[key] = text_or_null(text); }
  void or_null(const char* key, int count) { json_[key] = count_or_null(count); }
  /// Null for no joint.
  void or_null(const char* key, Joint joint) { json_[key] = count_or_null(joint.number()); }
  /// An index from 0, which is stored as a number from 1.
  void from_one(const char* key, int index) { (*this)(key, index + 1); }
  /// A text of a user, in which bytes that are not UTF-8 are replaced.
  void text(const char* key, const std::string& value) { (*this)(key, valid_utf8(value)); }
  /// A value that is stored as to_string(value); `from` returns the value of a name.
  template <typename T, typename From>
  void named(const char* key, const T& value, From) {
    json_[key] = to_string(value);
  }
  /// A member that is stored as to(value); `from` returns the value of what is stored. The reader calls
  /// from(stored) or from(stored, where).
  template <typename T, typename To, typename From>
  void as(const char* key, const T& value, To to, From) {
    (*this)(key, to(value));
  }
  /// An object whose members `describe` gives to the visitor that is its argument.
  template <typename Describe>
  void object(const char* key, Describe describe) {
    FieldWriter inner;
    describe(inner);
    json_[key] = std::move(inner.json_);
  }
  /// A list of objects; describe(visitor, item) gives the members of each.
  template <typename T, typename Describe>
  void list(const char* key, const std::vector<T>& items, Describe describe) {
    json_[key] = list_of<Json>(items, [&](const T& item) {
      FieldWriter inner;
      describe(inner, item);
      return std::move(inner.json_);
    });
  }

  /// Returns `value` as a member.
  template <typename T>
  static Json value_of(const T& value) {
    if constexpr (std::is_same_v<T, double>) {
      return std::isfinite(value) ? Json(value) : Json(nullptr);
    } else if constexpr (std::is_arithmetic_v<T> || std::is_convertible_v<T, std::string> ||
                         std::is_same_v<T, Json>) {
      return Json(value);
    } else if constexpr (std::is_same_v<T, Joint>) {
      return Json(value.number());
    } else if constexpr (kIsOptional<T>) {
      return value ? value_of(*value) : Json(nullptr);
    } else if constexpr (EigenMatrix<T>) {
      return matrix_to_json(value);
    } else if constexpr (requires { value.begin(); }) {
      return list_of<Json>(value, [](const auto& item) { return value_of(item); });
    } else {
      FieldWriter inner;
      fields(inner, value);
      return std::move(inner.json_);
    }
  }

 private:
  Json json_ = Json::object();
};

/// Reads the members of a struct from an object. A member that is missing or has another type throws what
/// nlohmann::json throws; null is NaN for a number. With `kFinite` a number, and always a number of an Eigen
/// vector or matrix, is read as by number_from_json(): Error(input), which names `where` and the key, unless
/// it is finite.
template <typename Json, bool kFinite = false>
class FieldReader {
 public:
  /// `json` and `where` must outlive the reader.
  FieldReader(const Json& json, const std::string& where) : json_(json), where_(where) {}

  template <typename T>
  void operator()(const char* key, T& value) {
    if constexpr (EigenVector<T>) {
      static_assert(T::RowsAtCompileTime == Eigen::Dynamic, "the list may have another length");
      value = vector_from_json(json_, key, where_);
    } else if constexpr (EigenMatrix<T>) {
      value = matrix_from_json(json_, key, where_);
    } else if constexpr (kFinite && std::is_same_v<T, double>) {
      value = number_from_json(json_, key, where_);
    } else {
      read(json_.at(key), value);
    }
  }
  template <typename T>
  void finite(const char* key, T& value) {
    value = json_.at(key).template get<T>();
  }
  template <typename T>
  void unless_empty(const char* key, T& value) {
    value = T{};
    if constexpr (std::is_same_v<T, double>) value = std::numeric_limits<double>::quiet_NaN();
    if (json_.contains(key)) (*this)(key, value);
  }
  template <typename T>
  void or_null(const char* key, T& value) {
    const Json& member = json_.at(key);
    value = T{};
    if (!member.is_null()) read(member, value);
  }
  void from_one(const char* key, int& index) { index = json_.at(key).template get<int>() - 1; }
  void text(const char* key, std::string& value) { (*this)(key, value); }
  template <typename T, typename From>
  void named(const char* key, T& value, From from) {
    value = converted(from, json_.at(key).template get<std::string>());
  }
  template <typename T, typename To, typename From>
  void as(const char* key, T& value, To, From from) {
    std::remove_cvref_t<std::invoke_result_t<To, const T&>> stored{};
    (*this)(key, stored);
    value = converted(from, stored);
  }
  template <typename Describe>
  void object(const char* key, Describe describe) {
    FieldReader inner(json_.at(key), where_);
    describe(inner);
  }
  template <typename T, typename Describe>
  void list(const char* key, std::vector<T>& items, Describe describe) {
    items.clear();
    for (const Json& item : checked(json_.at(key))) {
      FieldReader inner(item, where_);
      describe(inner, items.emplace_back());
    }
  }
  /// Reads a value that `json` itself is.
  template <typename T>
  void read(const Json& json, T& value) const {
    if constexpr (std::is_same_v<T, double> && !kFinite) {
      value = number_or_nan(json);
    } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
      value = json.template get<T>();
    } else if constexpr (std::is_same_v<T, Joint>) {
      value = Joint::numbered(json.template get<int>());
    } else if constexpr (std::is_same_v<T, Json>) {
      value = json;
    } else if constexpr (kIsOptional<T>) {
      value.reset();
      if (!json.is_null()) read(json, value.emplace());
    } else if constexpr (requires { value.emplace_back(); }) {
      value.clear();
      for (const Json& item : checked(json)) read(item, value.emplace_back());
    } else if constexpr (EigenValues<T>) {
      value.resize(static_cast<Eigen::Index>(checked(json).size()));
      for (Eigen::Index i = 0; i < value.size(); ++i) read(json[static_cast<std::size_t>(i)], value[i]);
    } else if constexpr (requires { value.begin(); }) {
      for (std::size_t i = 0; i < value.size(); ++i) read(json.at(i), value[i]);
    } else {
      FieldReader inner(json, where_);
      fields(inner, value);
    }
  }

 private:
  /// Throws what nlohmann::json throws if `json` is no list.
  static const Json& checked(const Json& json) {
    if (!json.is_array()) static_cast<void>(json.template get<typename Json::array_t>());
    return json;
  }

  template <typename From, typename Stored>
  auto converted(From from, const Stored& stored) const {
    if constexpr (std::is_invocable_v<From, const Stored&, const std::string&>)
      return from(stored, where_);
    else
      return from(stored);
  }

  const Json& json_;
  const std::string& where_;
};

/// Returns what `value` is as a member: an object for a struct, a list for a vector.
template <typename Json, typename T>
Json fields_to_json(const T& value) {
  return FieldWriter<Json>::value_of(value);
}

/// Returns the value that fields_to_json() has written. Throws what FieldReader throws.
template <typename T, bool kFinite = false, typename Json>
T fields_from_json(const Json& json, const std::string& where) {
  T value{};
  FieldReader<Json, kFinite>(json, where).read(json, value);
  return value;
}

}  // namespace faultline
