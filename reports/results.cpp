#include "reports/results.h"

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "reports/results_fields.h"

namespace volumark {
namespace {

using Json = nlohmann::json;

constexpr std::array<std::pair<Outcome, const char*>, 5> kOutcomes = {{{Outcome::Ok, "ok"},
                                                                       {Outcome::Unsupported, "unsupported"},
                                                                       {Outcome::Failed, "failed"},
                                                                       {Outcome::Timeout, "timeout"},
                                                                       {Outcome::WrongImage, "wrong_image"}}};

template <class T>
concept HoldsNulls = std::is_same_v<T, Result> || std::is_same_v<T, Results>;
// Any other struct with a list of fields.
template <class T>
concept Plain = std::is_class_v<T> && !HoldsNulls<T>;

// ---- Writing --------------------------------------------------------------------------------------------------------

class Writer {
 public:
  Json json = Json::object();

  template <class T>
  void field(const char* key, T& value) {
    json[key] = convert(value);
  }
  template <class T>
  void field(const char* key, std::optional<T>& value) {
    if (value) json[key] = convert(*value);
  }
  template <class T>
  void later(const char* key, T& value) {
    field(key, value);
  }

 private:
  static Json convert(std::string& value) { return value; }
  static Json convert(bool value) { return value; }
  static Json convert(int64_t value) { return value; }
  static Json convert(double value) { return value; }
  static Json convert(Outcome value) { return to_string(value); }
  static Json convert(ParamValue& value) {
    return std::visit([](const auto& v) { return Json(v); }, value);
  }
  template <class T>
  static Json convert(std::vector<T>& values) {
    Json out = Json::array();
    for (T& value : values) out.push_back(convert(value));
    return out;
  }
  template <class T, size_t N>
  static Json convert(std::array<T, N>& values) {
    Json out = Json::array();
    for (T& value : values) out.push_back(convert(value));
    return out;
  }
  template <class T, class C>
  static Json convert(std::map<std::string, T, C>& values) {
    Json out = Json::object();
    for (auto& [name, value] : values) out[name] = convert(value);
    return out;
  }
  template <class T>
  requires std::is_class_v<T>
  static Json convert(T& value) {
    Writer writer;
    fields(writer, value);
    if constexpr (HoldsNulls<T>) writer.extract_nulls();
    return std::move(writer.json);
  }

  // JSON has no NaN and no infinity: null in the place, the reason in `nulls`.
  void extract_nulls() {
    Json nulls = Json::object();
    extract(json, "", nulls);
    if (!nulls.empty()) json["nulls"] = std::move(nulls);
  }
  static void extract(Json& node, const std::string& pointer, Json& nulls) {
    if (node.is_number_float()) {
      const double value = node.get<double>();
      if (std::isfinite(value)) return;
      nulls[pointer] = std::isnan(value) ? "nan" : value > 0 ? "infinity" : "-infinity";
      node = nullptr;
    } else if (node.is_array()) {
      for (size_t i = 0; i < node.size(); ++i) extract(node[i], pointer + "/" + std::to_string(i), nulls);
    } else if (node.is_object()) {
      for (auto& [key, child] : node.items()) extract(child, (Json::json_pointer(pointer) / key).to_string(), nulls);
    }
  }
};

// ---- Reading --------------------------------------------------------------------------------------------------------

class Reader {
 public:
  Reader(const Json& json, std::string pointer) : json_(json), pointer_(std::move(pointer)) {
    if (!json.is_object()) fail(pointer_, "an object", json);
  }

  template <class T>
  void field(const char* key, T& value) {
    const auto found = json_.find(key);
    const std::string where = pointer_ + "/" + key;
    if (found == json_.end())
      throw ResultsError((pointer_.empty() ? "/" : pointer_) + ": key '" + key + "' is missing");
    read(*found, where, value);
  }
  template <class T>
  void later(const char* key, T& value) {
    if (json_.contains(key)) field(key, value);
  }
  template <class T>
  void field(const char* key, std::optional<T>& value) {
    const auto found = json_.find(key);
    value.reset();
    if (found == json_.end()) return;
    read(*found, pointer_ + "/" + key, value.emplace());
  }

 private:
  [[noreturn]] static void fail(const std::string& where, const char* wanted, const Json& found) {
    throw ResultsError((where.empty() ? "/" : where) + ": expected " + wanted + ", found " + found.type_name());
  }
  static void read(const Json& json, const std::string& where, std::string& value) {
    if (!json.is_string()) fail(where, "a string", json);
    value = json.get<std::string>();
  }
  static void read(const Json& json, const std::string& where, bool& value) {
    if (!json.is_boolean()) fail(where, "true or false", json);
    value = json.get<bool>();
  }
  static void read(const Json& json, const std::string& where, int64_t& value) {
    if (!json.is_number_integer()) fail(where, "an integer", json);
    value = json.get<int64_t>();
  }
  static void read(const Json& json, const std::string& where, double& value) {
    if (json.is_null())
      value = std::numeric_limits<double>::quiet_NaN();
    else if (json.is_number())
      value = json.get<double>();
    else
      fail(where, "a number", json);
  }
  static void read(const Json& json, const std::string& where, Outcome& value) {
    if (!json.is_string()) fail(where, "an outcome", json);
    for (const auto& [outcome, name] : kOutcomes)
      if (json.get<std::string>() == name) {
        value = outcome;
        return;
      }
    throw ResultsError(where + ": '" + json.get<std::string>() + "' is no outcome");
  }
  static void read(const Json& json, const std::string& where, ParamValue& value) {
    if (json.is_boolean())
      value = json.get<bool>();
    else if (json.is_number_integer())
      value = json.get<int64_t>();
    else if (json.is_number())
      value = json.get<double>();
    else if (json.is_string())
      value = json.get<std::string>();
    else
      fail(where, "a parameter's value", json);
  }
  template <class T>
  static void read(const Json& json, const std::string& where, std::vector<T>& values) {
    if (!json.is_array()) fail(where, "an array", json);
    values.clear();
    values.reserve(json.size());
    for (size_t i = 0; i < json.size(); ++i) {
      T value{};
      read(json[i], where + "/" + std::to_string(i), value);
      values.push_back(std::move(value));
    }
  }
  template <class T, size_t N>
  static void read(const Json& json, const std::string& where, std::array<T, N>& values) {
    if (!json.is_array() || json.size() != N)
      throw ResultsError(where + ": expected an array of " + std::to_string(N) + ", found " +
                         (json.is_array() ? std::to_string(json.size()) + " elements" : json.type_name()));
    for (size_t i = 0; i < N; ++i) read(json[i], where + "/" + std::to_string(i), values[i]);
  }
  template <class T, class C>
  static void read(const Json& json, const std::string& where, std::map<std::string, T, C>& values) {
    if (!json.is_object()) fail(where, "an object", json);
    values.clear();
    for (const auto& [name, child] : json.items()) read(child, where + "/" + name, values[name]);
  }
  template <class T>
  requires HoldsNulls<T>
  static void read(const Json& json, const std::string& where, T& value) {
    const auto nulls = json.is_object() ? json.find("nulls") : json.end();
    if (!json.is_object() || nulls == json.end()) {
      Reader reader(json, where);
      fields(reader, value);
      return;
    }
    const Json restored = restore_nulls(json, *nulls, where);
    Reader reader(restored, where);
    fields(reader, value);
  }
  static Json restore_nulls(Json json, const Json& nulls, const std::string& where) {
    if (!nulls.is_object()) fail(where + "/nulls", "an object", nulls);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const auto& [pointer, reason] : nulls.items()) {
      const bool positive = reason == "infinity", negative = reason == "-infinity";
      try {
        json.at(Json::json_pointer(pointer)) = positive   ? infinity
                                               : negative ? -infinity
                                                          : std::numeric_limits<double>::quiet_NaN();
      } catch (const Json::exception&) {
        throw ResultsError(where + "/nulls: '" + pointer + "' points to nothing");
      }
    }
    return json;
  }
  template <class T>
  requires Plain<T>
  static void read(const Json& json, const std::string& where, T& value) {
    Reader reader(json, where);
    fields(reader, value);
  }

  const Json& json_;
  std::string pointer_;

  friend Result volumark::result_from_json(const Json& json);
  friend Results volumark::results_from_json(const Json& json);
};

// The archives take mutable references; a Writer does not change what it is given.
template <class T>
Json write(const T& value) {
  struct Holder {
    T& value;
  };
  Writer writer;
  Holder holder{const_cast<T&>(value)};
  writer.field("value", holder.value);
  return std::move(writer.json["value"]);
}

void check_schema(const Json& json) {
  const auto schema = json.find("schema");
  if (schema == json.end() || !schema->is_object() || !schema->contains("name") || !schema->contains("version") ||
      !schema->at("name").is_string() || !schema->at("version").is_string())
    throw ResultsError("/schema: name and version are missing: this is not a results file");
  const std::string name = schema->at("name"), version = schema->at("version");
  if (name != kResultsSchemaName)
    throw ResultsError("/schema/name: '" + name + "', expected '" + kResultsSchemaName + "'");
  int major = 0;
  char dot = 0;
  if (!(std::istringstream(version) >> major >> dot) || dot != '.')
    throw ResultsError("/schema/version: '" + version + "' is no version");
  if (major != kResultsSchemaMajor)
    throw ResultsError("/schema/version: " + version + " cannot be read: this program knows version " +
                       std::to_string(kResultsSchemaMajor) + ".x (use the volumark that wrote the file)");
}

}  // namespace

const char* to_string(Outcome outcome) {
  for (const auto& [value, name] : kOutcomes)
    if (value == outcome) return name;
  return "?";
}

Json to_json(const Result& result) { return write(result); }

Json to_json(const Results& results) {
  Json json = write(results);
  json["schema"] = {{"name", results.schema_name}, {"version", results.schema_version}};
  return json;
}

Result result_from_json(const Json& json) {
  Result result;
  Reader::read(json, "", result);
  return result;
}

Results results_from_json(const Json& json) {
  if (!json.is_object()) throw ResultsError("/: expected an object: this is not a results file");
  check_schema(json);
  Results results;
  results.schema_version = json["schema"]["version"].get<std::string>();
  Reader::read(json, "", results);
  return results;
}

Results read_results(const std::filesystem::path& path) {
  const std::filesystem::path file = std::filesystem::is_directory(path) ? path / "results.json" : path;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw ResultsError(file.string() + ": cannot be read: no such file, or no permission");
  std::stringstream text;
  text << stream.rdbuf();
  try {
    return results_from_json(Json::parse(text.str()));
  } catch (const Json::exception& error) {
    throw ResultsError(file.string() + ": " + error.what());
  } catch (const ResultsError& error) {
    throw ResultsError(file.string() + ": " + error.what());
  }
}

void write_results(const Results& results, const std::filesystem::path& file) {
  write_file_atomically(file, to_json(results).dump(1) + "\n");
}

}  // namespace volumark
