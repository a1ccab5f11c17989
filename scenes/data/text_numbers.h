// Words and numbers of a text, taken from its front.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>

namespace volumark {

inline bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

// The next word of a line; empty at its end.
inline std::string_view take_word(std::string_view& line) {
  size_t from = 0;
  while (from < line.size() && is_blank(line[from])) ++from;
  size_t to = from;
  while (to < line.size() && !is_blank(line[to])) ++to;
  const std::string_view word = line.substr(from, to - from);
  line.remove_prefix(to);
  return word;
}

// The whole word as a number; nothing where it is none. Unlike strtod, it knows no locale.
template <typename T>
std::optional<T> number_of(std::string_view word) {
  if (word.size() > 1 && word.front() == '+' && word[1] != '-') word.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

}  // namespace volumark
