// SPDX-License-Identifier: MIT
// The rules of the house that a program can check: short files, short functions, small folders, and no number
// without a name where numbers decide.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/python_module.hpp"

namespace {

namespace fs = std::filesystem;

constexpr int kLongestFile = 400;
constexpr int kLongFile = 300;
constexpr double kLongFileShare = 0.05;
constexpr int kLongestFunction = 60;
constexpr int kMostFiles = 40;
constexpr int kMostWithOneUser = 29;  // headers

const fs::path kRoot(FAULTLINE_SOURCE_DIR);

std::vector<fs::path> sources(const std::vector<std::string>& folders) {
  std::vector<fs::path> found;
  for (const std::string& folder : folders)
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder))
      if (entry.path().extension() == ".cpp" || entry.path().extension() == ".hpp")
        found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::string> lines_of(const fs::path& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

std::string place(const fs::path& path, std::size_t line) {
  return fs::relative(path, kRoot).string() + ":" + std::to_string(line + 1);
}

TEST(SourceRules, NoFileIsTooLongAndFewAreLong) {
  const std::vector<fs::path> all = sources({"lib", "formats", "apps"});
  int long_ones = 0;
  for (const fs::path& path : all) {
    const auto count = static_cast<int>(lines_of(path).size());
    EXPECT_LE(count, kLongestFile) << path;
    long_ones += count > kLongFile;
  }
  EXPECT_LE(long_ones, kLongFileShare * static_cast<double>(all.size()));
}

/// In formatted sources a function outside a class begins at the margin and ends with a brace at the margin.
TEST(SourceRules, NoFunctionIsTooLong) {
  for (const fs::path& path : sources({"lib", "formats", "apps"})) {
    const std::vector<std::string> lines = lines_of(path);
    std::size_t begin = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const bool at_margin = !lines[i].empty() && std::isalpha(static_cast<unsigned char>(lines[i][0]));
      const bool named = lines[i].rfind("namespace", 0) == 0 || lines[i].rfind("extern", 0) == 0;
      const bool of_a_type = lines[i].rfind("class", 0) == 0 || lines[i].rfind("struct", 0) == 0;
      if (at_margin) begin = named || of_a_type ? 0 : i + 1;
      if (lines[i] != "}" || begin == 0) continue;
      EXPECT_LE(static_cast<int>(i + 2 - begin), kLongestFunction) << place(path, begin - 1);
    }
  }
}

/// A header that one source includes, and no test, belongs into the file of that source, unless it is a
/// concept that is read on its own. May the number only fall.
TEST(SourceRules, FewHeadersAreIncludedByOnlyOneFile) {
  static const std::regex include("#include \"([^\"]+)\"");
  std::map<std::string, int> users;
  for (const fs::path& path : sources({"lib", "formats", "apps", "tests"})) {
    fs::path own = fs::relative(path, kRoot);
    own.replace_extension(".hpp");
    for (const std::string& line : lines_of(path)) {
      std::smatch found;
      if (std::regex_search(line, found, include) && found[1] != own.string()) ++users[found[1]];
    }
  }
  int with_one = 0;
  for (const fs::path& path : sources({"lib", "formats", "apps"}))
    with_one += path.extension() == ".hpp" && users[fs::relative(path, kRoot).string()] <= 1;
  EXPECT_LE(with_one, kMostWithOneUser);
}

TEST(SourceRules, NoFolderHasTooManyFiles) {
  std::map<fs::path, int> files;
  for (const fs::path& path : sources({"lib", "formats", "apps"})) ++files[path.parent_path()];
  for (const auto& [folder, count] : files) EXPECT_LE(count, kMostFiles) << folder;
}

/// Two types of one name in one program share their compiled members by chance of the linker.
TEST(SourceRules, NoTwoTypesHaveTheSameName) {
  static const std::regex type(R"(^(struct|class|enum class) (\w+)( final)?( : .*)? \{)");
  std::map<std::string, std::string> known;
  for (const fs::path& path : sources({"lib", "formats", "apps"})) {
    if (path.extension() != ".hpp") continue;
    const std::vector<std::string> lines = lines_of(path);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      std::smatch match;
      if (!std::regex_search(lines[i], match, type)) continue;
      const auto [before, fresh] = known.emplace(match[2], place(path, i));
      EXPECT_TRUE(fresh) << match[2] << " in " << before->second << " and " << place(path, i);
    }
  }
}

/// A literal is named where it initialises a constant, a member or a parameter of an options struct.
bool is_named(const std::string& line) {
  static const std::regex named(
      R"(constexpr|^\s*(double|float|int|std::array<.*>|DrawRange) \w+(\{| = )|\.\w+ = )");
  return std::regex_search(line, named);
}

bool says_itself(double value) {
  if (value == 0.0 || value == 2.0 || value == 0.5) return true;
  const double power = std::log10(value);
  return std::abs(power - std::round(power)) < 1e-12;
}

std::string code_of(const std::string& line) {
  static const std::regex text("\"([^\"\\\\]|\\\\.)*\"");
  return std::regex_replace(line.substr(0, line.find("//")), text, "\"\"");
}

/// Constants that run over several lines are named in their first.
/// So that the builds that compile each file alone prove that each header needs nothing before it.
TEST(SourceRules, ASourceIncludesItsOwnHeaderFirst) {
  static const std::regex include("#include [<\"]([^>\"]+)[>\"]");
  int checked = 0;
  for (const fs::path& path : sources({"lib", "formats"})) {
    fs::path header = path;
    header.replace_extension(".hpp");
    if (path.extension() != ".cpp" || !fs::exists(header)) continue;
    for (const std::string& line : lines_of(path)) {
      std::smatch first;
      if (!std::regex_search(line, first, include)) continue;
      EXPECT_EQ(first[1].str(), fs::relative(header, kRoot).string()) << path;
      break;
    }
    ++checked;
  }
  EXPECT_GT(checked, 200);
}

TEST(SourceRules, NumbersInDecisionsAreNamedConstants) {
  static const std::regex literal(R"((^|[^\w.])(\d+\.\d*(e[-+]?\d+)?|\d+e[-+]?\d+))");
  int checked = 0;
  for (const fs::path& path : sources({"lib/classify", "lib/model", "lib/diagnose", "lib/learn"})) {
    const std::vector<std::string> lines = lines_of(path);
    bool in_constant = false;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const std::string code = code_of(lines[i]);
      const bool wrapped = i > 0 && lines[i - 1].ends_with("=") && is_named(lines[i - 1] + " ");
      const bool named = in_constant || wrapped || is_named(code);
      if (code.find("constexpr") != std::string::npos || in_constant)
        in_constant = code.find(';') == std::string::npos;
      if (named) continue;
      for (std::sregex_iterator it(code.begin(), code.end(), literal), end; it != end; ++it, ++checked)
        EXPECT_TRUE(says_itself(std::stod((*it)[2]))) << place(path, i) << ": " << lines[i];
    }
  }
  EXPECT_GT(checked, 50);
}

/// `python3 tests/list_constants.py FOLDER...` lists them.
TEST(SourceRules, EachNumericConstantHasAComment) {
  static const std::regex number(R"(constexpr (double|int|std::int64_t|std::size_t) k\w+ = -?[\d.]+)");
  int checked = 0;
  for (const fs::path& path :
       sources({"lib/balance", "lib/identify", "lib/explain", "lib/diagnose", "lib/learn"})) {
    const std::vector<std::string> lines = lines_of(path);
    for (std::size_t i = 1; i < lines.size(); ++i) {
      if (!std::regex_search(lines[i], number)) continue;
      std::string said = lines[i - 1].find("//") != std::string::npos ? "//" : "";
      for (std::size_t k = i; k < lines.size(); ++k) {
        said += lines[k];
        if (lines[k].find(';') != std::string::npos) break;
      }
      EXPECT_NE(said.find("//"), std::string::npos) << place(path, i) << ": " << lines[i];
      ++checked;
    }
  }
  EXPECT_GT(checked, 300);
}

/// Text leaves the program at one place, which keeps names and cells of others from commanding a terminal.
TEST(SourceRules, OnlyTerminalAndAtomicFileWriteToStreams) {
  static const std::regex writing(
      R"(\b(fprintf|printf|fputs|puts|fwrite|fputc|putchar)\(|fmt::print\(|std::c(out|err))");
  const std::vector<std::string> gates{"apps/terminal.cpp", "lib/core/atomic_file.cpp"};
  for (const fs::path& path : sources({"lib", "formats", "apps"})) {
    const std::string name = fs::relative(path, kRoot).string();
    if (std::find(gates.begin(), gates.end(), name) != gates.end()) continue;
    const std::vector<std::string> lines = lines_of(path);
    for (std::size_t i = 0; i < lines.size(); ++i)
      EXPECT_FALSE(std::regex_search(code_of(lines[i]), writing))
          << place(path, i) << ": use print_message() or print()";
  }
}

/// The C library computes these in another way where a processor can fuse operations, and Eigen's arrays take
/// what is left over from its vectors from there.
TEST(SourceRules, SourcesCallOnlyElementaryFunctionsOfTheProject) {
  static const std::string functions =
      "(sin|cos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|asinh|acosh|atanh|sincos|exp|exp2|expm1|log|log2|"
      "log10|log1p|pow|hypot|cbrt|erf|erfc|lgamma|tgamma|polar|arg|fma)";
  static const std::regex named("\\b(std|ceres|Eigen|numext)::" + functions + R"(\b)");
  static const std::regex global(
      R"((^|[^\w.:>~])(sin|cos|tan|tanh|sincos|exp|expm1|log1p|log10|log2|pow|atan|atan2|hypot|erfc?)\()");
  static const std::regex of_an_array(
      R"((\)|array|prior|\])\.(sin|cos|tan|tanh|asinh|exp|log|log1p|pow|erf)\(\))");
  for (const fs::path& path : sources({"lib", "formats", "apps"})) {
    if (fs::relative(path, kRoot).string().starts_with("lib/core/elementary/")) continue;
    const std::vector<std::string> lines = lines_of(path);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const std::string code = code_of(lines[i]);
      for (const std::regex* rule : {&named, &global, &of_an_array})
        EXPECT_FALSE(std::regex_search(code, *rule)) << place(path, i) << ": use elementary::";
    }
  }
}

/// How many symbols were looked at.
int expect_exact_functions(const std::string& binary) {
  static const std::regex inexact(
      "(a?(sin|cos|tan)h?|atan2|sincos|exp(2|10|m1)?|log(2|10|1p|b)?|pow|hypot|cbrt|erfc?|[lt]gamma|fma|"
      "c(abs|exp|log|pow|sqrt|sin|cos))(f|l)?(@.*)?");
  std::FILE* symbols = popen(("nm --dynamic --undefined-only '" + binary + "'").c_str(), "r");
  if (symbols == nullptr) return 0;
  char line[4096];
  int count = 0;
  while (std::fgets(line, sizeof line, symbols) != nullptr) {
    std::istringstream words{line};
    std::string kind, name;
    if (!(words >> kind >> name)) continue;
    ++count;
    EXPECT_FALSE(std::regex_match(name, inexact))
        << name << " in " << binary << ": see lib/core/elementary/for_libraries.cpp";
  }
  EXPECT_EQ(pclose(symbols), 0) << "nm, of binutils, reads the program";
  return count;
}

/// Whatever is linked in, Ceres and templates of Eigen among it, takes from outside only functions that have
/// one right result: roots, rounding, remainders.
TEST(SourceRules, TheProgramImportsNoInexactFunctionOfTheCLibrary) {
  EXPECT_GT(expect_exact_functions(FAULTLINE_PROGRAM), 100);
}

TEST(SourceRules, ThePythonModuleImportsNoInexactFunctionOfTheCLibrary) {
  SKIP_UNLESS_PYTHON_MODULE();
  EXPECT_GT(expect_exact_functions(faultline::compiled_python_module()), 100);
}

}  // namespace
