// The results file: what is written is valid and reads back the same; what is damaged is refused, with its place.
#include "reports/results.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "reports/json_schema.h"
#include "tests/unit/reports/sample_results.h"

namespace volumark {
namespace {

using Json = nlohmann::json;

std::string faults_text(const std::vector<SchemaFault>& faults) {
  std::string text;
  for (const SchemaFault& fault : faults) text += fault.pointer + ": " + fault.message + "\n";
  return text;
}

TEST(Results, WrittenFileIsValid) { EXPECT_EQ(faults_text(validate_results(to_json(sample_results()))), ""); }

TEST(Results, RoundTripKeepsEveryField) {
  const Json once = to_json(sample_results());
  EXPECT_EQ(to_json(results_from_json(Json::parse(once.dump()))).dump(1), once.dump(1));
}

TEST(Results, NonFiniteNumbersBecomeNullAndComeBack) {
  const Json json = to_json(sample_results());
  const Json& result = json["results"][0];
  EXPECT_TRUE(result["views"][0]["error"]["psnr"].is_null());
  EXPECT_EQ(result["nulls"]["/views/0/error/psnr"], "infinity");
  EXPECT_EQ(result["nulls"]["/views/0/error/ssim"], "nan");
  EXPECT_EQ(json["nulls"]["/parity/0/interior_max"], "infinity");
  const Results back = results_from_json(json);
  EXPECT_TRUE(std::isinf(back.results[0].views[0].error->psnr));
  EXPECT_TRUE(std::isnan(back.results[0].views[0].error->ssim));
  EXPECT_TRUE(std::isinf(back.parity[0].interior_max));
}

TEST(Results, JournalLineRoundTrip) {
  const Result result = sample_results().results[0];
  EXPECT_EQ(to_json(result_from_json(Json::parse(to_json(result).dump()))), to_json(result));
}

TEST(Results, UnknownMajorIsRefusedNewerMinorIsRead) {
  Json json = to_json(sample_results());
  json["schema"]["version"] = "2.0.0";
  EXPECT_THROW(results_from_json(json), ResultsError);
  json["schema"]["version"] = "1.7.0";
  json["results"][0]["added_later"] = 1;
  EXPECT_EQ(results_from_json(json).results.size(), 2U);
  json["schema"]["name"] = "other";
  EXPECT_THROW(results_from_json(json), ResultsError);
  EXPECT_THROW(results_from_json(Json::array()), ResultsError);
}

// Every key of the file in turn: taken away, given a wrong type, or misspelt. Reading and validating notice each where
// it matters.
void collect(const Json& node, const std::string& pointer, std::vector<std::string>& pointers) {
  if (!pointer.empty()) pointers.push_back(pointer);
  if (node.is_object())
    for (const auto& [key, child] : node.items())
      collect(child, (Json::json_pointer(pointer) / key).to_string(), pointers);
  if (node.is_array() && !node.empty()) collect(node[0], pointer + "/0", pointers);
}

TEST(Results, WrongTypeAnywhereIsRefusedByTheSchema) {
  const Json valid = to_json(sample_results());
  std::vector<std::string> pointers;
  collect(valid, "", pointers);
  ASSERT_GT(pointers.size(), 200U);
  for (const std::string& pointer : pointers) {
    Json damaged = valid;
    damaged[Json::json_pointer(pointer)] = Json::array({Json::array({1, 2, 3, 4, 5})});
    EXPECT_FALSE(validate_results(damaged).empty()) << pointer;
  }
}

TEST(Results, UnknownKeyAnywhereIsRefusedByTheSchema) {
  const Json valid = to_json(sample_results());
  std::vector<std::string> pointers;
  collect(valid, "", pointers);
  for (const std::string& pointer : pointers) {
    if (!valid[Json::json_pointer(pointer)].is_object()) continue;
    Json damaged = valid;
    damaged[Json::json_pointer(pointer)]["Zz"] = Json::object({{"a", Json::array()}});
    EXPECT_FALSE(validate_results(damaged).empty()) << pointer;
  }
}

TEST(Results, MissingRequiredKeyIsRefusedWithItsPlace) {
  Json json = to_json(sample_results());
  json["results"][0]["metrics"]["frame_wall"].erase("samples");
  const auto faults = validate_results(json);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].pointer, "/results/0/metrics/frame_wall");
  try {
    results_from_json(json);
    FAIL();
  } catch (const ResultsError& error) {
    EXPECT_NE(std::string(error.what()).find("/results/0/metrics/frame_wall: key 'samples' is missing"),
              std::string::npos)
        << error.what();
  }
}

struct Damage {
  const char* name;
  std::function<void(Json&)> apply;
};

TEST(Results, SemanticDamageIsRefused) {
  const std::vector<Damage> damages = {
      {"two results with one key", [](Json& j) { j["results"].push_back(j["results"][0]); }},
      {"ok without metrics", [](Json& j) { j["results"][0].erase("metrics"); }},
      {"unsupported without reason", [](Json& j) { j["results"][1]["reason"] = ""; }},
      {"unknown outcome", [](Json& j) { j["results"][0]["outcome"] = "fine"; }},
      {"a sample lost", [](Json& j) { j["results"][0]["metrics"]["frame_wall"]["samples"].erase(0); }},
      {"negative time", [](Json& j) { j["results"][0]["metrics"]["frame_wall"]["samples"][0] = -1; }},
      {"null without reason", [](Json& j) { j["results"][0]["views"][0]["error"]["rmse"] = nullptr; }},
      {"reason without null", [](Json& j) { j["results"][0]["nulls"]["/width"] = "nan"; }},
      {"reason that points nowhere", [](Json& j) { j["results"][0]["nulls"]["width"] = "nan"; }},
      {"short checksum", [](Json& j) { j["results"][0]["views"][0]["rendered"]["sha256"] = "abc"; }},
      {"unknown major", [](Json& j) { j["schema"]["version"] = "2.0.0"; }},
      {"bad date", [](Json& j) { j["run"]["started_at"] = "yesterday"; }},
      {"two bias channels", [](Json& j) { j["results"][0]["views"][0]["error"]["bias"].erase(0); }},
  };
  for (const Damage& damage : damages) {
    Json json = to_json(sample_results());
    damage.apply(json);
    EXPECT_FALSE(validate_results(json).empty()) << damage.name;
  }
}

TEST(Results, WriteReplacesWholeFileAndReadsBack) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "vm_results_test";
  std::filesystem::create_directories(folder);
  const auto file = folder / "results.json";
  write_file_atomically(file, "old");
  write_results(sample_results(), file);
  EXPECT_EQ(to_json(read_results(folder)), to_json(sample_results()));
  size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++files;
  EXPECT_EQ(files, 1U) << "a temporary file was left";
  std::filesystem::remove_all(folder);
}

TEST(Results, UnwritableAndFullFoldersAreErrorsAndKeepTheOldFile) {
  EXPECT_THROW(write_file_atomically("/nonexistent/folder/results.json", "x"), ResultsError);
  EXPECT_THROW(write_file_atomically("/proc/results.json", "x"), ResultsError);
  EXPECT_THROW(read_results("/nonexistent/results.json"), ResultsError);
}

TEST(Results, FullDiskIsAnErrorAndKeepsTheOldFile) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "vm_full_disk";
  std::filesystem::create_directories(folder);
  const auto file = folder / "results.json";
  write_file_atomically(file, "old");
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{64, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_THROW(write_results(sample_results(), file), ResultsError);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  std::ifstream stream(file);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(stream), {}), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1) << "a temporary file was left";
  std::filesystem::remove_all(folder);
}

TEST(Results, TruncatedFileIsRefused) {
  const auto file = std::filesystem::path(testing::TempDir()) / "vm_truncated.json";
  const std::string text = to_json(sample_results()).dump();
  for (const size_t length : {size_t{0}, size_t{1}, text.size() / 2, text.size() - 1}) {
    std::ofstream(file) << text.substr(0, length);
    EXPECT_THROW(read_results(file), ResultsError) << length;
  }
  std::filesystem::remove(file);
}

TEST(JsonSchema, KeywordsOfTheSubset) {
  const auto valid = [](const char* schema, const char* value) {
    return validate_json(Json::parse(schema), Json::parse(value)).empty();
  };
  EXPECT_TRUE(valid(R"({"type":"integer"})", "3"));
  EXPECT_TRUE(valid(R"({"type":"integer"})", "3.0"));
  EXPECT_FALSE(valid(R"({"type":"integer"})", "3.5"));
  EXPECT_FALSE(valid(R"({"type":["string","null"]})", "1"));
  EXPECT_TRUE(valid(R"({"enum":[1,"a"]})", "\"a\""));
  EXPECT_FALSE(valid(R"({"const":2})", "3"));
  EXPECT_FALSE(valid(R"({"exclusiveMinimum":0})", "0"));
  EXPECT_FALSE(valid(R"({"maximum":1})", "1.5"));
  EXPECT_FALSE(valid(R"({"minLength":3})", "\"éé\""));
  EXPECT_TRUE(valid(R"({"pattern":"b+"})", "\"abbc\""));
  EXPECT_FALSE(valid(R"({"items":{"minimum":0},"minItems":1})", "[1,-1]"));
  EXPECT_FALSE(valid(R"({"minItems":1})", "[]"));
  EXPECT_FALSE(valid(R"({"propertyNames":{"minLength":2}})", R"({"a":1})"));
  EXPECT_FALSE(valid(R"({"additionalProperties":{"type":"string"}})", R"({"a":1})"));
  EXPECT_FALSE(valid(R"({"anyOf":[{"type":"string"},{"minimum":5}]})", "3"));
  EXPECT_FALSE(valid(R"({"allOf":[{"minimum":1},{"maximum":2}]})", "3"));
  EXPECT_TRUE(valid(R"({"if":{"minimum":5},"then":{"maximum":9},"else":{"const":1}})", "7"));
  EXPECT_FALSE(valid(R"({"if":{"minimum":5},"then":{"maximum":9},"else":{"const":1}})", "2"));
  EXPECT_FALSE(valid(R"({"$ref":"#/$defs/a","$defs":{"a":{"type":"string"}}})", "2"));
  EXPECT_FALSE(valid("false", "1"));
  EXPECT_THROW(valid(R"({"multipleOf":2})", "3"), std::invalid_argument);
}

}  // namespace
}  // namespace volumark
