#include <sys/stat.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "helpers.h"
#include "scenes/scene_io.h"
#include "scenes/sha256.h"

namespace volumark {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

const test::Bytes kVoxels = test::bytes_of("abcdefgh");  // 2 x 2 x 2

json file_scene(const std::string& file) {
  return {{"volumark_scene", 1},
          {"title", "t"},
          {"volume", {{"file", file}, {"raw", {{"size", 2}, {"type", "u8"}}}}},
          {"transfer", {{"points", {{{"value", 0}, {"colour", {1, 1, 1}}, {"extinction", 1}}}}}},
          {"views", {{{"orbit", {{"count", 2}, {"distance", 3}, {"fov_y", 30}}}}}}};
}
json checked_scene(const std::string& file) {
  json document = file_scene(file);
  document["volume"]["sha256"] = sha256_hex(kVoxels);
  document["volume"]["bytes"] = kVoxels.size();
  return document;
}

class DataSearch : public testing::Test {
 protected:
  Scene load(const json& document, const DataOptions& options = {}) {
    const std::string path = dir_.write("scenes/s.json", test::bytes_of(document.dump()));
    return load_scene(path, options);
  }
  test::TempDir dir_;
};

TEST_F(DataSearch, BesideTheSceneFile) {
  dir_.write("scenes/v.raw", kVoxels);
  const Scene s = load(file_scene("v.raw"));
  EXPECT_EQ(s.volume->at(1, 1, 1), 'h');
  EXPECT_EQ(s.source.origin, "file");
  EXPECT_EQ(s.source.sha256, sha256_hex(kVoxels));
  EXPECT_EQ(s.hash.size(), 64u);
  EXPECT_EQ(s.views.size(), 2u);
}

// Without a stated checksum the hash is known once the data are; with one, from the start.
TEST_F(DataSearch, HashFollowsTheData) {
  dir_.write("scenes/v.raw", kVoxels);
  EXPECT_EQ(parse_scene(file_scene("v.raw").dump(), "x.json").hash, "");
  EXPECT_EQ(parse_scene(checked_scene("v.raw").dump(), "x.json").hash, load(checked_scene("v.raw")).hash);
  const std::string before = load(file_scene("v.raw")).hash;
  dir_.write("scenes/w.raw", test::bytes_of("abcdefgX"));
  EXPECT_NE(load(file_scene("w.raw")).hash, before);
}

TEST_F(DataSearch, DirectoriesAreSearchedDeepByName) {
  dir_.write("data/a/b/v.raw", kVoxels);
  const DataOptions options{{dir_ / "data"}, {}, false};
  EXPECT_EQ(load(file_scene("v.raw"), options).source.path, (dir_ / "data/a/b/v.raw").string());
}

TEST_F(DataSearch, AnotherNameIsFoundByChecksum) {
  dir_.write("data/decoy.bin", test::bytes_of("ABCDEFGH"));
  dir_.write("data/sub/renamed.bin", kVoxels);
  const DataOptions options{{dir_ / "data"}, {}, false};
  EXPECT_EQ(load(checked_scene("v.raw"), options).source.path, (dir_ / "data/sub/renamed.bin").string());
}

TEST_F(DataSearch, WrongChecksumIsPassedOverForARightOne) {
  dir_.write("scenes/v.raw", test::bytes_of("wrong!!!"));
  dir_.write("data/v.raw", kVoxels);
  EXPECT_EQ(load(checked_scene("v.raw"), {{dir_ / "data"}, {}, false}).volume->at(0, 0, 0), 'a');
}

TEST_F(DataSearch, WrongChecksumAloneIsAnError) {
  dir_.write("scenes/v.raw", test::bytes_of("wrong!!!"));
  EXPECT_THAT(test::message_of<DataError>([&] { load(checked_scene("v.raw")); }),
              AllOf(HasSubstr("wrong checksum"), HasSubstr("v.raw"), HasSubstr(sha256_hex(kVoxels)),
                    HasSubstr(sha256_hex(std::string_view("wrong!!!")))));
}

TEST_F(DataSearch, PackageCache) {
  json document = checked_scene("v.raw");
  document["volume"]["package"] = "some-data";
  document["volume"]["package_path"] = "/usr/share/some-data/v.raw";
  const DataOptions options{{}, dir_ / "cache", true};
  EXPECT_THAT(test::message_of<DataMissing>([&] { load(document, options); }),
              AllOf(HasSubstr("\"v.raw\" is missing"), HasSubstr("fetch_data.sh"), HasSubstr("some-data")));
  dir_.write("cache/some-data/usr/share/some-data/v.raw", kVoxels);
  const Scene s = load(document, options);
  EXPECT_EQ(s.source.origin, "debian:some-data");
  EXPECT_EQ(s.volume->at(0, 0, 0), 'a');
}

TEST_F(DataSearch, MissingSaysHowToGetIt) {
  json document = file_scene("v.raw");
  document["volume"]["source"] = "https://example.org/v";
  try {
    load(document);
    FAIL() << "nothing was thrown";
  } catch (const DataMissing& missing) {
    EXPECT_THAT(missing.how_to_get, AllOf(HasSubstr("https://example.org/v"), HasSubstr("--data")));
  }
}

TEST_F(DataSearch, WrongSizeSaysExpectedAndFound) {
  dir_.write("scenes/v.raw", test::bytes_of("abc"));
  EXPECT_THAT(test::message_of<DataError>([&] { load(file_scene("v.raw")); }),
              AllOf(HasSubstr("v.raw"), HasSubstr("expected 8 bytes, found 3")));
}

TEST_F(DataSearch, UnknownFormat) {
  dir_.write("scenes/v.vtk", kVoxels);
  json document = file_scene("v.vtk");
  document["volume"].erase("raw");
  EXPECT_THAT(test::message_of<DataError>([&] { load(document); }), HasSubstr(".nrrd, .nhdr, .nii"));
}

TEST_F(DataSearch, DetachedNrrdFile) {
  const std::string head = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nspacings: 1 1 2\nencoding: raw\n";
  dir_.write("scenes/v.nhdr", test::bytes_of(head + "data file: v.raw\n"));
  json document = file_scene("v.nhdr");
  document["volume"].erase("raw");
  EXPECT_THAT(test::message_of<DataError>([&] { load(document); }),
              AllOf(HasSubstr("v.raw"), HasSubstr("cannot be read")));
  dir_.write("scenes/v.raw", kVoxels);
  const Scene s = load(document);
  EXPECT_EQ(s.volume->spacing, glm::dvec3(1, 1, 2));
  // The hash covers the voxels too, not the header alone.
  dir_.write("scenes/v.raw", test::bytes_of("ABCDEFGH"));
  EXPECT_NE(load(document).hash, s.hash);
}

TEST_F(DataSearch, SceneReplacesTheGeometryOfTheFile) {
  dir_.write("scenes/v.raw", kVoxels);
  json document = file_scene("v.raw");
  document["volume"]["spacing"] = {1, 2, 4};
  document["volume"]["axes"] = {{0, 1, 0}, {-1, 0, 0}, {0, 0, -3}};
  const Scene s = load(document);
  EXPECT_EQ(s.volume->spacing, glm::dvec3(1, 2, 4));
  EXPECT_EQ(s.volume->axes[2], glm::dvec3(0, 0, -1));
  const glm::dvec3 centre(s.volume->box_to_world() * glm::dvec4(0.5, 0.5, 0.5, 1));
  EXPECT_EQ(centre, glm::dvec3(0));
  document["volume"]["origin"] = {7, 8, 9};
  EXPECT_EQ(load(document).volume->origin, glm::dvec3(7, 8, 9));
}

TEST(SceneNames, UnknownNameAndMissingFile) {
  EXPECT_THAT(
      test::message_of<SceneError>([] { load_scene("engin"); }),
      AllOf(HasSubstr("unknown scene \"engin\""), HasSubstr("did you mean \"engine\""), HasSubstr("marschner_lobb")));
  EXPECT_THAT(test::message_of<SceneError>([] { load_scene("no/such.json"); }),
              HasSubstr("no/such.json: no such file"));
}

TEST(DataOptionsTest, EnvironmentIsRead) {
  setenv("VOLUMARK_DATA", "/a:/b c::", 1);
  setenv("VOLUMARK_CACHE", "/cache", 1);
  const DataOptions options = data_options_from_environment();
  unsetenv("VOLUMARK_DATA");
  unsetenv("VOLUMARK_CACHE");
  EXPECT_EQ(options.directories, (std::vector<std::filesystem::path>{"/a", "/b c"}));
  EXPECT_EQ(options.cache, "/cache");
}

}  // namespace
}  // namespace volumark
