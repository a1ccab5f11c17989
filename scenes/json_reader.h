// Strict reading of a parsed JSON document: every access states what is allowed, every error says where (file and JSON
// pointer), what was expected and what was found. A key that nobody asked for is an error.
#pragma once

#include <glm/vec3.hpp>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace volumark {

// Parses text; SceneError with path:line:column for syntax errors, duplicate keys, nesting deeper than 32.
nlohmann::json parse_json(std::string_view text, const std::string& path);

class JsonNode {
 public:
  JsonNode(const nlohmann::json& value, std::string pointer, const std::string& file)
      : value_(&value), pointer_(std::move(pointer)), file_(&file) {}

  [[noreturn]] void fail(const std::string& message) const;  // SceneError: "file: /pointer: message"

  // Numbers within [lo, hi]; `above` excludes lo.
  double number(double lo = -std::numeric_limits<double>::max(), double hi = std::numeric_limits<double>::max(),
                bool above = false) const;
  int integer(int lo, int hi) const;
  bool boolean() const;
  std::string string(bool may_be_empty = false) const;
  std::string one_of(std::initializer_list<const char*> names) const;
  glm::dvec3 vec3(double lo = -std::numeric_limits<double>::max(),
                  double hi = std::numeric_limits<double>::max()) const;
  glm::dvec3 direction() const;  // normalised; not zero
  std::vector<JsonNode> array(size_t least = 0, size_t most = 100000) const;
  bool is_number() const { return value_->is_number(); }
  const nlohmann::json& json() const { return *value_; }
  const std::string& pointer() const { return pointer_; }
  const std::string& file() const { return *file_; }

 private:
  friend class JsonObject;
  std::string found() const;
  const nlohmann::json* value_;
  std::string pointer_;
  const std::string* file_;
};

// An object with exactly these keys allowed; checked when made.
class JsonObject {
 public:
  JsonObject(const JsonNode& node, std::initializer_list<const char*> keys);
  JsonObject(const JsonNode& node, std::span<const char* const> keys);
  bool has(const char* key) const { return node_.value_->contains(key); }
  JsonNode at(const char* key) const;  // must be there
  std::optional<JsonNode> find(const char* key) const;
  double number_or(const char* key, double fallback, double lo, double hi, bool above = false) const;
  [[noreturn]] void fail(const std::string& message) const { node_.fail(message); }
  // Exactly one of the keys is there; which.
  std::string exactly_one(std::initializer_list<const char*> keys) const;

 private:
  JsonNode node_;
};

}  // namespace volumark
