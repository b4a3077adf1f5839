// A look at a scene file's text before toml++ gets it.
//
// toml++ limits how deep values nest, but not the parts of a key: each is a table in the last one, and tables are taken
// apart by recursion, for which the stack may not suffice. And of letters that only strings may hold it does not say
// what to do about them.
#include <algorithm>
#include <string_view>

#include "vpm/input/node.h"

namespace vpm {
namespace {

class TomlChecker {
 public:
  TomlChecker(std::string_view text, const Source* source) : rest_(text), place_{source, 1, 1} {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
  }

  void check() {
    while (!rest_.empty()) {
      const char c = rest_[0];
      if (c == '"' || c == '\'')
        skip_string(rest_.substr(0, rest_.starts_with("\"\"\"") || rest_.starts_with("'''") ? 3 : 1));
      else if (c == '#')
        skip_comment();
      else
        check_character(c);
    }
  }

 private:
  void advance(size_t bytes) {
    for (const char c : rest_.substr(0, bytes)) {
      const bool continues = (static_cast<unsigned char>(c) & 0xc0u) == 0x80u;
      if (c == '\n') place_ = {place_.source, place_.line + 1, 1};
      if (c != '\n' && !continues) ++place_.column;
    }
    rest_.remove_prefix(std::min(bytes, rest_.size()));
  }

  void skip_comment() {
    while (!rest_.empty() && rest_[0] != '\n') advance(1);
  }

  /// Up to the closing quotes. One without them is not TOML, which toml++ says better.
  void skip_string(std::string_view quotes) {
    advance(quotes.size());
    while (!rest_.empty() && !rest_.starts_with(quotes)) {
      if (rest_[0] == '\n' && quotes.size() == 1) return;
      advance(rest_[0] == '\\' && quotes[0] == '"' ? 2 : 1);
    }
    advance(quotes.size());
    while (quotes.size() == 3 && rest_.starts_with(quotes[0])) advance(1);  // the string may end with quotes
  }

  void check_character(char c) {
    constexpr int kMostDots = 32;
    constexpr std::string_view kEndOfKeys = "=,[{\n";
    if (static_cast<unsigned char>(c) >= 0x80u)
      fail_at(place_, "not valid TOML: a character beyond ASCII, outside of strings and comments", "put it in quotes");
    if (kEndOfKeys.find(c) != std::string_view::npos) dots_ = 0;
    if (c == '.' && ++dots_ > kMostDots)
      fail_at(place_, "a key of more than " + std::to_string(kMostDots) + " parts",
              "no key of a scene has more than four");
    advance(1);
  }

  std::string_view rest_;
  Place place_;
  int dots_ = 0;  // between parts of the present key
};

}  // namespace

void check_toml(const std::string& text, const Source* source) { TomlChecker(text, source).check(); }

}  // namespace vpm
