// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace faultline {

// Readers of files that come from outside, fed with any bytes. They may refuse them as a wrong input or
// option file; whatever else they throw, and whatever they give that breaks their word, ends the program that
// fuzzes.
void feed_log(const std::string& bytes);
void feed_robot(const std::string& bytes);
void feed_spec(const std::string& bytes);
void feed_golden(const std::string& bytes);
void feed_labels(const std::string& bytes);
void feed_model(const std::string& bytes);
void feed_network(const std::string& bytes);
void feed_cases(const std::string& bytes);

struct FedReader {
  const char* name;
  void (*feed)(const std::string& bytes);
};
/// All of them.
const std::vector<FedReader>& fed_readers();

}  // namespace faultline
